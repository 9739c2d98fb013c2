"""The voxel island leaves OpenGL's state as found: each element, each switch, a whole frame."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from gl_state import changes, snapshot
from stage import SIZE, Stage, live_names

from framelens.gl.seam import gl, recording
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.scene.scene import Moment, begin_frame
from landscape.settings.declare import with_settings
from landscape.voxel.settings import PICTURES
from landscape.voxel.views import ELEMENTS
from landscape.voxel.voxel import SCENE, Voxel

SMALL: dict[str, Any] = {"voxel.regions": 6, "voxel.region_size": 20, "shadow.size": 128}
SHORE = Moment(Pose(4.8, 1.3, 9.3, 0.0, -12.0), SIZE, 12.0, 3.0, 2)
SWITCHES: dict[str, dict[str, Any]] = {
    "as it is": {},
    "no shadow": {"shadow.enabled": False},
    "no offset": {"shadow.offset": False, "shadow.snapped": False},
    "no reflection": {"water.reflection": False},
    "no refraction": {"water.refraction": False},
    "as much at all angles": {"water.by_angle": False},
    "regions": {"debug.regions": True},
    "textures": {"debug.textures": True},
    "edges": {"debug.edges": True},
    **{f"picture of {name}": {"debug.picture": name} for name in PICTURES},
    "everything is sent": {"voxel.cull": False, "voxel.facing": False, "voxel.horizon": False},
    "no fog": {"fog.enabled": False},
    "sunset": {"time": "sunset"},
}


@pytest.fixture(scope="module")
def islands(the_stage: Stage) -> Iterator[dict[str, Voxel]]:
    """The island that was opened last."""
    kept: dict[str, Voxel] = {}
    yield kept
    the_stage.enter()
    for island in kept.values():
        island.release()


def opened(islands: dict[str, Voxel], changed: dict[str, Any]) -> Voxel:
    """Return the island with some settings changed."""
    settings = with_settings(SCENE.settings, {**SMALL, **changed})
    if "island" not in islands or not islands["island"].apply(settings):
        if "island" in islands:
            islands.pop("island").release()
        islands["island"] = Voxel(settings, Assets(), 0, ELEMENTS)
    return islands["island"]


def begin(island: Voxel) -> None:
    values = island.settings
    begin_frame(SHORE, values.camera, values.sun, values.fog)


@pytest.mark.parametrize("name", SWITCHES)
@pytest.mark.sweep(9)
def test_a_frame_leaves_the_state_as_its_beginning_set_it(
    stage: Stage, islands: dict[str, Voxel], name: str
) -> None:
    with stage.borrowed():
        island = opened(islands, SWITCHES[name])
        island.shown = set(ELEMENTS)
        begin(island)
        found = snapshot()
        blank = stage.read()
        island.draw(SHORE)
        assert not changes(found, snapshot())
        assert (stage.read() != blank).any()
    assert int(gl.glGetError()) == 0


@pytest.mark.parametrize("name", ELEMENTS)
def test_an_element_alone_leaves_the_state_as_found(
    stage: Stage, islands: dict[str, Voxel], name: str
) -> None:
    with stage.borrowed():
        island = opened(islands, {})
        island.shown = {name}
        begin(island)
        found = snapshot()
        island.draw(SHORE)
        assert not changes(found, snapshot())


def test_release_leaves_no_name_and_may_be_called_twice(stage: Stage) -> None:
    with stage.borrowed():
        before = live_names()
        settings = with_settings(SCENE.settings, {**SMALL, "debug.textures": True})
        island = Voxel(settings, Assets(), 0, ELEMENTS)
        island.draw(SHORE)
        assert live_names() != before
        for _ in range(2):
            island.release()
            assert live_names() == before
    assert int(gl.glGetError()) == 0


def test_a_frame_after_the_first_makes_and_deletes_no_objects(
    stage: Stage, islands: dict[str, Voxel]
) -> None:
    with stage.borrowed():
        island = opened(islands, {"debug.textures": True})
        island.shown = set(ELEMENTS)
        island.draw(SHORE)  # what waits for its size or first use is made now
        with recording() as recorder:
            island.draw(SHORE)
    names = {call.name for call in recorder.calls}
    assert not {each for each in names if each.startswith(("glGen", "glDelete", "glTexImage"))}


def test_changed_settings_that_cannot_be_applied_change_nothing(
    stage: Stage, islands: dict[str, Voxel]
) -> None:
    with stage.borrowed():
        island = opened(islands, {})
        island.draw(SHORE)
        first = stage.read()
        for changed in ({"shadow.enabled": False}, {"voxel.mipmaps": False}):
            assert not island.apply(with_settings(island.settings, changed))
        island.draw(SHORE)
        assert np.array_equal(first, stage.read())


def test_another_time_of_day_is_applied_to_the_open_island_and_looks_as_if_opened_in_it(
    stage: Stage, islands: dict[str, Voxel]
) -> None:
    noon, sunset = (with_settings(SCENE.settings, {**SMALL, "time": t}) for t in ("noon", "sunset"))
    pictures = []
    with stage.borrowed():
        if "island" in islands:
            islands.pop("island").release()

        def drawn(island: Voxel) -> None:
            begin(island)
            island.draw(SHORE)
            pictures.append(stage.read().astype(int))

        island = Voxel(noon, Assets(), 0, ELEMENTS)
        drawn(island)
        for values in (sunset, noon):
            assert island.apply(values)
            drawn(island)
        island.release()
        island = Voxel(sunset, Assets(), 0, ELEMENTS)
        drawn(island)
        island.release()
    at_noon, applied, again, fresh = pictures
    assert (at_noon == again).all()
    # The light of slopes is multiplied into colours that are rounded, twice.
    assert (np.abs(applied - fresh).max(axis=-1) > 4).mean() < 0.02
    assert (np.abs(applied - at_noon).max(axis=-1) > 20).mean() > 0.3
