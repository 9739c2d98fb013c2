"""The pace of a walk: what detail is drawn, given how long frames take. No OpenGL here."""

import itertools
from collections.abc import Callable
from types import SimpleNamespace

import pytest

from landscape.frame import FULL, Pose
from landscape.scene.scene import Moment
from landscape.walk import steady
from landscape.walk.pace import FIXED, STANDING, WALKING, Level, Pace

BUDGET = 1 / 30


def cost(level: Level, fixed: float = FIXED) -> float:
    """Return what a frame takes, in times of a full one, of which a part is ``fixed``."""
    return fixed + (1 - fixed) * level.load


def walked(
    pace: Pace,
    seconds: float,
    full: Callable[[float], float],
    moved: bool = True,
    fixed: float = FIXED,
) -> list[int]:
    """Walk for some seconds where a full frame takes ``full(time)``; return the levels."""
    levels, time = [], 0.0
    while time < seconds:
        ladder = STANDING if pace.still else WALKING
        spent = full(time) * cost(ladder[pace.level], fixed)
        pace.frame(spent, spent, moved)
        time += spent
        levels.append(pace.level)
    return levels


def changes(levels: list[int]) -> int:
    return sum(a != b for a, b in itertools.pairwise(levels))


def test_each_level_draws_less_than_the_one_before() -> None:
    for ladder in (WALKING, STANDING):
        assert ladder[0].detail == FULL
        for finer, coarser in itertools.pairwise(ladder):
            assert coarser.load < finer.load
            assert coarser.detail.scale <= finer.detail.scale
            fewer_blades = coarser.detail.grass < finer.detail.grass
            fewer_images = coarser.detail.mirror_frames > finer.detail.mirror_frames
            assert fewer_blades or fewer_images or coarser.detail.scale < finer.detail.scale
            assert coarser.detail.mirror_frames >= finer.detail.mirror_frames


def test_a_fast_opengl_never_loses_detail() -> None:
    pace = Pace(30)
    # Every hundredth frame is late: a collection of garbage, or another program.
    frames = itertools.cycle([0.008] * 99 + [0.2])
    assert set(walked(pace, 60, lambda _: next(frames))) == {0}


def test_a_slow_start_alone_loses_no_detail() -> None:
    pace = Pace(30)
    frames = itertools.chain([0.8, 0.3, 0.2], itertools.repeat(0.01))
    assert set(walked(pace, 5, lambda _: next(frames))) == {0}


@pytest.mark.parametrize("full", [0.04, 0.05, 0.06])
@pytest.mark.parametrize("fixed", [0.1, FIXED])
def test_a_slow_one_soon_keeps_the_rate_and_then_stays_where_it_is(
    full: float, fixed: float
) -> None:
    pace = Pace(30)
    levels = walked(pace, 20, lambda _: full, fixed=fixed)
    settled = levels[20:]
    assert full * cost(WALKING[settled[-1]], fixed) < BUDGET
    assert changes(settled) <= 4


@pytest.mark.parametrize("fixed", [0.05, 0.2, 0.6])
def test_it_learns_what_a_level_saves_here_and_draws_no_less_than_it_must(fixed: float) -> None:
    pace = Pace(30)
    level = walked(pace, 10, lambda _: 0.045, fixed=fixed)[-1]
    assert 0.045 * cost(WALKING[level], fixed) < BUDGET
    # Two levels finer would take too long.
    assert 0.045 * cost(WALKING[max(level - 2, 0)], fixed) > 0.75 * BUDGET


def test_a_new_rung_is_found_within_half_a_second() -> None:
    pace = Pace(30)
    walked(pace, 10, lambda _: 0.07)
    assert pace.level > 3
    walked(pace, 1.0, lambda _: 0.02)
    assert pace.level == 0
    walked(pace, 0.5, lambda _: 0.06)
    assert 0.06 * cost(WALKING[pace.level]) < BUDGET


def test_a_meadow_loses_its_blades_only_where_a_walk_would_become_a_slide_show() -> None:
    """Frames of over twice their time keep all blades, those of over three times it do not."""
    good = max(n for n, level in enumerate(WALKING) if not level.resort)
    least = cost(WALKING[good])
    pace = Pace(30)
    walked(pace, 5, lambda _: 2.4 * BUDGET / least)
    assert pace.level == good and pace.detail.grass == 1.0
    walked(pace, 5, lambda _: 3.3 * BUDGET / least)
    assert pace.level > good and pace.detail.grass < 1.0
    walked(pace, 5, lambda _: 1.1 * BUDGET / least)
    assert pace.level == good
    assert all(level.detail.grass == 1.0 for level in WALKING[: good + 1])


def test_detail_comes_back_where_there_is_less_to_draw() -> None:
    pace = Pace(30)
    before = walked(pace, 5, lambda _: 0.07)[-1]
    assert before > 2 and walked(pace, 30, lambda _: 0.02)[-1] == 0


def test_where_a_finer_level_costs_more_than_expected_it_is_tried_less_and_less_often() -> None:
    pace = Pace(30)

    # The second level costs four times what the ladder says, so each rise to it is a mistake.
    def spent() -> float:
        return 0.05 if pace.level <= 1 else 0.015

    levels = []
    for _ in range(3600):
        pace.frame(spent(), spent(), True)
        levels.append(pace.level)
    halves = changes(levels[:1800]), changes(levels[1800:])
    assert halves[1] < halves[0] / 2


def test_who_stands_still_is_shown_every_pixel_and_who_walks_on_is_not() -> None:
    pace = Pace(30)
    walked(pace, 5, lambda _: 0.08)
    assert pace.detail.scale < 1 and not pace.interlaced
    walked(pace, 2, lambda _: 0.06, moved=False)
    assert pace.interlaced and pace.detail.scale in (0.5, 0.25) and pace.detail.coarser == 1.0
    pace.frame(0.02, 0.02, True)
    assert not pace.interlaced and pace.detail.scale < 1


def test_a_meadow_at_rest_has_all_its_blades_where_it_had_them_in_motion() -> None:
    for full in (0.04, 0.06, 0.08, 0.09):
        pace = Pace(30)
        walked(pace, 3, lambda _, full=full: full)
        assert pace.detail.grass == 1.0, full
        walked(pace, 3, lambda _, full=full: full, moved=False)
        assert pace.still and pace.detail.grass == 1.0, full


def test_without_a_rate_everything_is_drawn_however_long_it_takes() -> None:
    pace = Pace(0)
    assert not pace.active
    for _ in range(100):
        pace.frame(2.0, 2.0, True)
    assert pace.detail == FULL and not pace.interlaced


def test_what_changes_in_the_scene_does_not_fade_in(monkeypatch: pytest.MonkeyPatch) -> None:
    """A frame after a changed setting or block is drawn as one in motion: not interlaced."""
    clock = iter(itertools.count(0.0, 0.04))
    quiet = SimpleNamespace(get_time=lambda: next(clock), swap_buffers=lambda window: None)
    monkeypatch.setattr(steady, "glfw", quiet)
    monkeypatch.setattr(steady, "gl", SimpleNamespace(glFinish=lambda: None))
    interlaced: list[bool] = []

    class Noted:
        def draw(self, moment: Moment, draw: object, lines: bool) -> None:
            interlaced.append(lines)

    shown = steady.Steady(30)
    shown._stretch = Noted()  # type: ignore[assignment]
    still = Moment(Pose(1.0, 1.0, 1.0), (8, 8))

    def frames(count: int, blocks: int) -> list[bool]:
        interlaced.clear()
        for _ in range(count):
            shown.draw(still, lambda moment: None, scene=("settings", blocks))
            shown.show(None)
        return list(interlaced)

    assert all(frames(200, 0)[-20:])
    first, *rest = frames(60, 1)
    assert first and not any(rest[:3]) and all(rest[-10:])
