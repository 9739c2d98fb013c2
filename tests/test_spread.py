"""Pictures drawn in parts, over several frames, and shown for several."""

import itertools
from collections.abc import Iterator
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from stage import SIZE, SMALL_BEST, Stage

from framelens.gl.seam import gl
from landscape.elements.settings import preset
from landscape.files.assets import Assets
from landscape.frame import Detail
from landscape.island.island import Island
from landscape.scene.scene import Moment, find_view, placed
from landscape.settings.declare import with_settings
from landscape.walk.spread import TRIED
from landscape.walk.stretch import Stretch

TWICE = Detail(scale=0.6, coarser=1 / 0.6, spread=2)


@pytest.fixture
def stretch(stage: Stage) -> Iterator[Stretch]:
    created = Stretch()
    yield created
    created.release()
    created.release()


@pytest.fixture(scope="module")
def island(the_stage: Stage, shipped: Assets) -> Iterator[Island]:
    the_stage.enter()
    opened = Island(with_settings(preset("best"), SMALL_BEST), shipped)
    yield opened
    opened.release()


@pytest.fixture(autouse=True)
def without_overlay(stage: Stage, island: Island) -> Iterator[None]:
    """Leave out sword and map, which are sharper than what is behind them.

    A picture that grows needs its state in the next frame: it is restored after the test.
    """
    shown = set(island.shown)
    island.shown -= {"sword", "map"}
    with stage.borrowed():
        yield
    island.shown = shown


def at(island: Island, yaw: float = 0.0, aside: float = 0.0) -> Moment:
    """Return the moment of fig35a, turned and moved a little."""
    view = find_view("fig35a")[1]
    pose = placed(view.pose, island, island.settings.walk.eye)
    return Moment(replace(pose, x=pose.x + aside, yaw=pose.yaw + yaw), SIZE, view.kt, detail=TWICE)


def shown(stage: Stage, stretch: Stretch, island: Island, moment: Moment) -> np.ndarray:
    stretch.draw(moment, island.draw, interlaced=False, opened=island)
    return stage.read()


def difference(a: np.ndarray, b: np.ndarray) -> float:
    return float(np.abs(a.astype(int) - b).mean())


def test_a_frame_in_parts_is_the_frame_drawn_at_once(stage: Stage, island: Island) -> None:
    moment = replace(at(island), detail=Detail())
    island.shown |= {"sword", "map"}
    island.draw(moment)
    at_once = stage.read()
    depth = gl.glGetIntegerv(gl.GL_ATTRIB_STACK_DEPTH)
    parts = list(island.parts(moment))
    island.draw_overlay(parts[-1])
    assert len(parts) >= 4
    assert (stage.read() == at_once).all()
    assert gl.glGetIntegerv(gl.GL_ATTRIB_STACK_DEPTH) == depth


def test_standing_each_frame_shows_the_stretched_picture(
    stage: Stage, stretch: Stretch, island: Island
) -> None:
    moment = at(island)
    once = shown(stage, stretch, island, replace(moment, detail=replace(TWICE, spread=1)))
    stretch.release()
    for _ in range(5):
        assert difference(shown(stage, stretch, island, moment), once) < 1.0


def test_walking_each_frame_shows_what_is_seen_from_there(
    stage: Stage, stretch: Stretch, island: Island
) -> None:
    moments = [at(island, 0.8 * n, 0.01 * n) for n in range(7)]
    frames = [shown(stage, stretch, island, moment) for moment in moments]
    stretch.release()
    once = replace(TWICE, spread=1)
    for n in range(2, 7):
        alone = replace(moments[n], detail=once)
        true = shown(stage, stretch, island, alone)
        # Not what the frame before showed, nor the one before that.
        assert difference(frames[n], true) < difference(frames[n - 1], true) / 2
        assert (np.abs(frames[n].astype(int) - true).max(axis=2) > 16).mean() < 0.12


def test_the_next_picture_is_drawn_in_two_frames(
    stage: Stage, stretch: Stretch, island: Island, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn: list[str] = []
    ticks = itertools.count()
    draw = island.elements.draw

    def noted(name: str, *rest: object, **more: object) -> None:
        drawn.append(name)
        draw(name, *rest, **more)

    monkeypatch.setattr(island.elements, "draw", noted)
    # All parts take as long, whatever else the machine does.
    clock = SimpleNamespace(perf_counter=lambda: float(next(ticks)))
    monkeypatch.setattr("landscape.walk.spread.time", clock)
    numbers = []
    for n in range(9):
        drawn.clear()
        shown(stage, stretch, island, at(island, 0.5 * n))
        numbers.append(len(drawn))
    whole, *later = numbers
    # Each two frames together draw what the first did, and each of them a part.
    assert min(later) > 0 and max(later) < whole
    pairs = [a + b for a, b in zip(later[::2], later[1::2], strict=True)]
    assert all(abs(together - whole) <= 2 for together in pairs)


def test_who_is_put_elsewhere_sees_it_at_once(
    stage: Stage, stretch: Stretch, island: Island
) -> None:
    for n in range(4):
        shown(stage, stretch, island, at(island, 0.5 * n))
    elsewhere = at(island, 120.0)
    frame = shown(stage, stretch, island, elsewhere)
    stretch.release()
    true = shown(stage, stretch, island, replace(elsewhere, detail=replace(TWICE, spread=1)))
    assert difference(frame, true) < 1.0


def test_other_elements_are_shown_at_once(stage: Stage, stretch: Stretch, island: Island) -> None:
    for n in range(4):
        shown(stage, stretch, island, at(island, 0.5 * n))
    island.shown -= {"sky"}
    frame = shown(stage, stretch, island, at(island, 2.0))
    stretch.release()
    alone = replace(at(island, 2.0), detail=replace(TWICE, spread=1))
    assert difference(frame, shown(stage, stretch, island, alone)) < 1.0


def test_a_picture_is_given_up_without_a_trace(
    stage: Stage, stretch: Stretch, island: Island
) -> None:
    before = gl.glGetIntegerv(gl.GL_ATTRIB_STACK_DEPTH)
    for n in range(2):
        shown(stage, stretch, island, at(island, 0.5 * n))
    # The second one has begun the next picture, which holds a state of its own.
    stretch.release()
    assert gl.glGetIntegerv(gl.GL_ATTRIB_STACK_DEPTH) == before


def test_how_much_is_wrong_is_tried_now_and_then(
    stage: Stage, stretch: Stretch, island: Island
) -> None:
    """Standing nothing is; where a step changes all that one sees, much is."""
    for spread in (1, 2):
        wrong = []
        for step in (0.0, 0.3):
            stretch.release()
            for n in range(2 * spread * TRIED):
                moment = at(island, 0.0, step * n)
                detail = replace(TWICE, spread=spread)
                shown(stage, stretch, island, replace(moment, detail=detail))
                answer = stretch.wrong()
                if answer is not None:
                    wrong.append(answer)
            assert stretch.wrong() is None
        assert len(wrong) >= 2 and wrong[0] < 0.01 < wrong[-1]


def test_a_standing_picture_begins_with_the_one_that_moved(
    stage: Stage, stretch: Stretch, island: Island
) -> None:
    for n in range(3):
        moved = shown(stage, stretch, island, at(island, 0.2 * n))
    still = replace(at(island, 0.4), detail=Detail(scale=0.5))
    stretch.draw(still, island.draw, interlaced=True, opened=island)
    frame = stage.read()
    # Three pixels of four are as they were.
    assert (np.abs(frame.astype(int) - moved).max(axis=2) == 0).mean() > 0.7
