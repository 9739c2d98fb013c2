"""The voxel island's safeguards: each has a view, and its two pictures differ as a caption says."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from folded import each
from stage import SIZE, Stage

from landscape.files.assets import Assets
from landscape.scene.scene import Moment, find_view, placed
from landscape.settings.declare import with_settings
from landscape.voxel.safeguard import Safeguard
from landscape.voxel.safeguards import SAFEGUARDS
from landscape.voxel.voxel import SCENE, Voxel

LEAST = 150  # pixels of 160 x 120 that differ clearly between the two pictures
# The same island in larger blocks, which is built in a quarter of the time.
COARSE: dict[str, Any] = {
    "voxel.regions": 5,
    "voxel.region_size": 50,
    "voxel.block": 0.16,
    "voxel.levels": 48,
    "voxel.sea": 5,
}


@pytest.fixture(scope="module")
def opened(the_stage: Stage) -> Iterator[list[Voxel]]:
    """The island that was opened last, in a list."""
    kept: list[Voxel] = []
    yield kept
    the_stage.enter()
    for island in kept:
        island.release()


def picture(stage: Stage, opened: list[Voxel], safeguard: Safeguard, after: bool) -> np.ndarray:
    """Return one picture of a pair, int64 (h, w, 3)."""
    settings = with_settings(SCENE.settings, {**COARSE, **safeguard.settings(after)})
    with stage.borrowed():
        if not opened or not opened[0].apply(settings):
            while opened:
                opened.pop().release()
            opened.append(Voxel(settings, Assets(), 0))
        pose = placed(safeguard.pose(after), opened[0], settings.walk.eye)
        opened[0].draw(Moment(pose, SIZE, safeguard.kt))
        return stage.read()


@pytest.mark.parametrize("safeguard", SAFEGUARDS, ids=lambda each: each.name)
@pytest.mark.sweep(12, first=11)
def test_a_safeguard_s_two_pictures_differ(
    stage: Stage, opened: list[Voxel], safeguard: Safeguard
) -> None:
    before, after = (picture(stage, opened, safeguard, each) for each in (False, True))
    assert (np.abs(before - after).max(axis=2) > 15).sum() > LEAST


@each("safeguard", SAFEGUARDS, ids=lambda pair: pair.name)
def test_a_safeguard_s_name_is_a_view_with_it(safeguard: Safeguard) -> None:
    kind, view = find_view(safeguard.name)
    assert kind is SCENE and view.pose == safeguard.pose(True)
    assert view.settings == safeguard.on
    assert safeguard.on.keys() == safeguard.off.keys() and safeguard.on != safeguard.off
    for text in (safeguard.flaw, safeguard.look, safeguard.how, *safeguard.seen):
        assert text.strip()
