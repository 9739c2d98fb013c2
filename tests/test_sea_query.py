"""The occlusion query: whether any sea can show, asked in a frame and known at the right time."""

from collections.abc import Iterator

import numpy as np
import pytest
from stage import Stage, quad, small, taken

from framelens.gl.seam import gl, recording
from landscape.elements.best.sea.occlusion_query import ABOVE, SeaQuery
from landscape.frame import Pose
from landscape.gl.display_list import DisplayList
from landscape.gl.surface_query import compiling
from landscape.offscreen import Offscreen

SETTINGS = small({"water.level": 0.6, "water.horizon": 10.0})
FEW = {"grass.count": 200_000, "trees.count": 700, "plants.count": 500}
FEW |= {"ground.texture_size": 256, "ground.stones": 2000}


def asked(stage: Stage, query: SeaQuery, wall: bool, eye_y: float = 2.0) -> tuple[bool, bool]:
    """Return whether the sea is expected, and found, to show over the sea or behind a wall."""
    with stage.frame(SETTINGS, Pose(20.0, eye_y, 20.0, 0.0, -20.0)) as frame:
        expected = query.expected(frame)
        if wall:
            x = (0.0, 40.0)
            y = (-40.0, 40.0)
            z = 19.0
            quad(np.array([(x[0], y[0], z), (x[1], y[0], z), (x[1], y[1], z), (x[0], y[1], z)]))
        before = stage.read()
        query.ask(frame)
        found = query.shows()
        assert np.array_equal(stage.read(), before)  # asking draws nothing
    return expected, found


def test_the_sea_is_seen_unless_a_wall_stands_in_front(stage: Stage) -> None:
    query = SeaQuery(SETTINGS)
    assert asked(stage, query, wall=True) == (True, True)  # the answer is read a frame later
    assert asked(stage, query, wall=True) == (False, False)
    assert asked(stage, query, wall=True) == (False, False)
    # It comes into view: found at once, for the mirror image can still be drawn.
    assert asked(stage, query, wall=False) == (False, True)
    assert asked(stage, query, wall=False) == (True, True)
    query.release()


def test_after_a_jump_to_another_place_nothing_is_expected(stage: Stage) -> None:
    query = SeaQuery(SETTINGS)
    for _ in range(2):
        assert asked(stage, query, wall=False) == (True, True)
    assert asked(stage, query, wall=True, eye_y=5.0) == (False, False)
    assert asked(stage, query, wall=False, eye_y=2.0) == (False, True)
    query.release()


def test_an_eye_among_the_waves_always_sees_them(stage: Stage) -> None:
    query = SeaQuery(SETTINGS)
    for _ in range(2):
        assert asked(stage, query, wall=True, eye_y=0.6 + ABOVE / 2) == (True, True)
    query.release()


@pytest.mark.parametrize("above", [0.001, 0.01, 0.02, 0.03, 0.05])
def test_a_swimmer_who_looks_down_sees_the_sea(stage: Stage, above: float) -> None:
    query = SeaQuery(SETTINGS)
    for pitch in (-90.0, -48.0):
        pose = Pose(20.0, 0.6 + ABOVE + above, 20.0, 30.0, pitch)
        for _ in range(2):
            with stage.frame(SETTINGS, pose) as frame:
                query.expected(frame)
                query.ask(frame)
                assert query.shows()
    query.release()


def test_while_a_list_is_compiled_the_last_answer_is_kept(stage: Stage) -> None:
    query, answers = SeaQuery(SETTINGS), []
    for _ in range(2):
        asked(stage, query, wall=True)
    assert not compiling()
    with stage.frame(small(), Pose(20.0, 2.0, 20.0)) as frame:

        def send() -> None:
            assert compiling()
            query.ask(frame)
            answers.extend([query.expected(frame), query.shows()])

        DisplayList(send).release()
    assert answers == [False, False]
    query.release()


def test_a_query_belongs_to_one_surface_and_is_deleted_on_release(stage: Stage) -> None:
    with recording() as recorder:
        query = SeaQuery(SETTINGS)
    assert [call.name for call in recorder.calls].count("glGenQueries") == 1
    assert taken(query, small({"water.level": 0.6, "water.horizon": 10.0, "fog.density": 0.3}))
    assert not taken(query, small({"water.level": 0.6, "water.horizon": 20.0}))
    assert not taken(query, small({"water.level": 0.5, "water.horizon": 10.0}))
    with recording() as recorder:
        query.release()
        query.release()
    assert [call.name for call in recorder.calls] == ["glDeleteQueries", "glDeleteLists"]
    assert int(gl.glGetError()) == 0


@pytest.fixture(scope="module")
def offscreens() -> Iterator[tuple[Offscreen, Offscreen]]:
    """The island in best, with and without the query."""
    size = (320, 240)
    with (
        Offscreen(size, "best", FEW, samples=0) as asking,
        Offscreen(size, "best", {**FEW, "water.query": False}, samples=0) as always,
    ):
        yield asking, always


@pytest.mark.seldom(14, first=11)
@pytest.mark.slow
def test_a_picture_does_not_depend_on_whether_the_sea_was_seen_before(offscreens) -> None:
    some, _ = offscreens
    pictures = []
    for before in ("fig35c", "fig35h"):
        some.look(before)
        for _ in range(3):
            some.draw()
        some.look("fig35h")
        pictures.append(some.draw())
    assert np.array_equal(*pictures)


@pytest.mark.seldom(14, first=10)
@pytest.mark.slow
def test_where_land_hides_the_sea_no_mirror_image_is_drawn(offscreens) -> None:
    counts = []
    for offscreen in offscreens:
        offscreen.look("fig35c")
        for _ in range(2):
            offscreen.draw()
        with recording() as recorder:
            offscreen.draw()
        counts.append(sum(call.name == "glBindFramebuffer" for call in recorder.calls))
    assert counts[0] < counts[1]
