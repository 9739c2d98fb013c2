"""Trials: a program that is right where an exercise looks, and wrong where it does not."""

import random
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest
from solved import solved

from landscape.commands.exercise_check import as_text
from landscape.course.exercise import Grader, Report
from landscape.course.grader.grading import UNFOLLOWED, Hint
from landscape.course.grader.trial import HIGH, LAST, trial
from landscape.course.shelf import exercise
from landscape.course.solutions import ways, whole

PATIENCE = 100.0  # seconds a program may take here: the machine may be busy with other tests
END = "        glfw.swap_buffers(window)\n"
# Right in the frames that grading.py names: what is changed, and what the hint speaks of.
WRONG = {
    "a matrix more each frame": ("transform_order", END, f"        glPushMatrix()\n{END}", "stack"),
    "an attribute more each frame": (
        "fog",
        END,
        f"        glPushAttrib(GL_FOG_BIT)\n{END}",
        "stack",
    ),
    "the smaller side of the window": (
        "perspective",
        "    right = top * width / height\n",
        "    shape = max(width, height) / min(width, height)\n    right = top * shape\n",
        "in a window of",
    ),
    "the window's first size": (
        "clip_plane",
        "glViewport(0, 0, width, height)",
        "glViewport(0, 0, 640, 480)",
        "in a window of",
    ),
    "an angle of less than half a turn": (
        "blending_order",
        "sorted(TUBES, key=lambda tube: -math.dist(tube[:2], eye()))",
        "sorted(TUBES, key=lambda tube: -math.dist(tube[:2], eye()), reverse=abs(turn) > 120)",
        "after these keys: ",
    ),
    "a key that no test presses": (
        "normals",
        "            direction = normal(u, v)\n",
        "            direction = [3 * each for each in normal(u, v)]\n",
        "after these keys: SPACE",
    ),
}
COLOR = "    glFogfv(GL_FOG_COLOR, (*FOG, 1))\n"
# Right pictures made in other ways than the tests look for: what is changed, and by which test.
OTHERWISE = {
    "no buffer is drawn into": (
        "stencil_mirror",
        [
            ("glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE)", "glDrawBuffer(GL_NONE)"),
            ("glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE)", "glDrawBuffer(GL_BACK)"),
        ],
        ["unseen"],
    ),
    "enumerants are plain numbers": (
        "clip_plane",
        [("glEnable(GL_CLIP_PLANE0)", "glEnable(0x3000)")],
        [],
    ),
    "the state is set in a display list": (
        "fog",
        [
            ("    glEnable(GL_FOG)\n", "    glNewList(1, GL_COMPILE)\n    glEnable(GL_FOG)\n"),
            (COLOR, f"{COLOR}    draw_bay()\n    glDisable(GL_FOG)\n    glEndList()\n"),
            ("        draw_bay()\n", "        glCallList(1)\n"),
        ],
        ["fogged"],
    ),
}


@pytest.fixture(scope="module")
def grader() -> Iterator[Grader]:
    with Grader(PATIENCE, seed=12) as grader:
        yield grader


def checked(grader: Grader, folder: Path, name: str, changes: Sequence[tuple[str, str]]) -> Report:
    code = solved(name)
    for old, new in changes:
        assert code.count(old) == 1
        code = code.replace(old, new)
    path = folder / "mine.py"
    path.write_text(code, encoding="utf-8")
    return grader.check(path)


def failures(report: Report) -> dict[str, Hint]:
    return {result.test.key: result.hint for result in report.results if result.hint is not None}


@pytest.mark.seldom(14, first=12)
@pytest.mark.parametrize("mistake", WRONG)
def test_a_mistake_that_no_announced_frame_shows_is_found_elsewhere(
    mistake: str, grader: Grader, tmp_path: Path
) -> None:
    name, old, new, words = WRONG[mistake]
    report = checked(grader, tmp_path, name, [(old, new)])
    assert report.error is None
    (failed,) = [result for result in report.results if not result.passed]
    assert failed is report.results[-1] and failed.test.key == "elsewhere"
    assert failed.hint is not None and words in failed.hint.written(str)


@pytest.mark.seldom(13, first=6)
@pytest.mark.parametrize("way", OTHERWISE)
def test_another_way_to_a_right_picture_passes(way: str, grader: Grader, tmp_path: Path) -> None:
    name, changes, tests = OTHERWISE[way]
    report = checked(grader, tmp_path, name, changes)
    assert report.passed, failures(report)
    assert [result.test.key for result in report.results if result.otherwise] == tests
    text = "\n".join(as_text(report, lambda text, context="": text))
    assert text.count("in another way") == len(tests)


@pytest.mark.seldom(7, first=3)
def test_rounding_that_grows_with_each_key_is_allowed_for(tmp_path: Path) -> None:
    path = tmp_path / "mine.py"
    folder = exercise("bezier_path").folder
    path.write_text(whole(ways(folder)[2], folder), encoding="utf-8")
    with Grader(PATIENCE, seed=3) as grader:  # whose trial differs by 0.18 % of the pixels
        assert grader.check(path).passed


@pytest.mark.seldom(10, first=6)
def test_state_that_is_set_in_a_display_list_is_not_told_of(grader: Grader, tmp_path: Path) -> None:
    changes = [("glFogi(GL_FOG_MODE, GL_EXP2)", "glFogi(GL_FOG_MODE, GL_EXP)")]
    _name, more, _tests = OTHERWISE["the state is set in a display list"]
    report = checked(grader, tmp_path, "fog", [*more, *changes])
    assert failures(report) and all(hint.text == UNFOLLOWED for hint in failures(report).values())


@pytest.mark.seldom(14, first=7)
def test_what_the_task_names_is_asked_for_though_the_picture_is_right(
    grader: Grader, tmp_path: Path
) -> None:
    call = "    glDrawElements(GL_TRIANGLES, TRIANGLES.size, GL_UNSIGNED_INT, TRIANGLES)\n"
    loop = (
        "    for three in TRIANGLES.reshape(-1, 3):\n"
        "        glDrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_INT, three)\n"
    )
    report = checked(grader, tmp_path, "vertex_arrays", [(call, loop)])
    assert report.error is None and list(failures(report)) == ["one_call"]


def test_a_trial_presses_each_key_and_looks_at_a_high_window_and_a_late_frame() -> None:
    code = "KEY_LEFT KEY_RIGHT KEY_SPACE KEY_ESCAPE"
    for seed in range(20):
        made = trial(code, random.Random(seed))
        keys = [event["key"] for event in made.events if event.get("action") == "press"]
        assert set(keys) == {"LEFT", "RIGHT", "SPACE"} and all(keys.count(key) > 12 for key in keys)
        assert made.frames[-1] >= LAST
        sizes = [event["resize"] for event in made.events if "resize" in event]
        assert [width < height for width, height in sizes] == [True, False]
        assert HIGH[0][0] <= sizes[0][0] <= HIGH[0][1]
        # A key that switches something has switched it in some frame.
        assert any(counts["SPACE"] % 2 for counts in made.presses.values())
        assert made == trial(code, random.Random(seed)) != trial(code, random.Random(seed + 1))
