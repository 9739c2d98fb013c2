"""The hall's safeguards: each has a view, and its two pictures differ where its caption says."""

from collections.abc import Iterator

import numpy as np
import pytest
from folded import each
from stage import SIZE, Stage

from landscape.files.assets import Assets
from landscape.hall import plan
from landscape.hall.hall import SCENE, Ground, Hall, obstacles
from landscape.hall.safeguard import Safeguard
from landscape.hall.safeguards import SAFEGUARDS
from landscape.scene.scene import Moment, find_view, placed
from landscape.settings.declare import fields, get, with_settings
from landscape.walk.walker import Intent, advance, start

LEAST = 150  # pixels of 160 x 120 that differ clearly between the two pictures


@pytest.fixture(scope="module")
def opened(the_stage: Stage) -> Iterator[list[Hall]]:
    """The hall that was opened last, in a list."""
    kept: list[Hall] = []
    yield kept
    the_stage.enter()
    for hall in kept:
        hall.release()


def picture(stage: Stage, opened: list[Hall], safeguard: Safeguard, after: bool) -> np.ndarray:
    """Return one picture of a pair, int64 (h, w, 3)."""
    settings = with_settings(SCENE.settings, safeguard.settings(after))
    with stage.borrowed():
        if not opened or not opened[0].apply(settings):
            while opened:
                opened.pop().release()
            opened.append(Hall(settings, Assets(), 0))
        pose = placed(safeguard.pose(after), opened[0], settings.walk.eye)
        opened[0].draw(Moment(pose, SIZE, safeguard.kt))
        return stage.read()


@pytest.mark.parametrize("safeguard", SAFEGUARDS, ids=lambda each: each.name)
@pytest.mark.sweep(14)
def test_a_safeguard_s_two_pictures_differ(
    stage: Stage, opened: list[Hall], safeguard: Safeguard
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


def test_every_safeguard_of_mirror_and_shadow_has_a_pair() -> None:
    kinds = fields(type(SCENE.settings))
    groups = ("mirror.", "shadow.")
    switches = {
        key
        for key in kinds
        if key.startswith(groups) and isinstance(get(SCENE.settings, key), bool)
    }
    paired = {key for each in SAFEGUARDS for key in each.on if each.on[key] != each.off[key]}
    assert switches - paired == {
        "mirror.enabled",
        "mirror.fresnel",
        "mirror.fades",
        "shadow.enabled",
        "shadow.sunlit",
    }


@each("safeguard", SAFEGUARDS, ids=lambda pair: pair.name)
def test_who_goes_to_a_safeguard_sees_its_picture_or_stands_where_one_can(
    safeguard: Safeguard,
) -> None:
    pose = placed(safeguard.pose(False), Ground(), SCENE.settings.walk.eye)
    who = start(pose, Ground(), SCENE.settings)
    for _ in range(3):
        who = advance(who, Intent(), 0.05, Ground(), obstacles(), SCENE.settings)
    assert (who.yaw, who.pitch) == (pose.yaw % 360, pose.pitch)
    moved = np.hypot(who.x - pose.x, who.z - pose.z)
    if who.flying:
        assert (moved, who.y) == (0.0, pose.y)
        return
    pool, eye = plan.POOL, SCENE.settings.walk.eye
    assert abs(who.y - eye) <= SCENE.settings.walk.bob + 1e-9 and moved < 0.2
    assert not (pool.west < who.x < pool.east and pool.north < who.z < pool.south)
    assert pose.y is not None and abs(pose.y - who.y) < 0.1
