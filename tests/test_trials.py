"""Trials: a program that is right where an exercise looks, and wrong where it does not."""

import random
from collections.abc import Iterator
from pathlib import Path

import pytest

from landscape.course.exercise import Grader, Report, exercise
from landscape.course.grader.trial import HIGH, LAST, trial

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
# Other ways to a right picture than the tests look for.
OTHERWISE = {
    "a wall of matrices by hand": (
        "stencil_mirror",
        "glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE)",
        "glDrawBuffer(GL_NONE)",
    ),
}


@pytest.fixture(scope="module")
def grader() -> Iterator[Grader]:
    with Grader(PATIENCE, seed=12) as grader:
        yield grader


def checked(grader: Grader, folder: Path, name: str, old: str, new: str) -> Report:
    code = (exercise(name).folder / "solution.py").read_text(encoding="utf-8")
    assert code.count(old) == 1
    path = folder / "mine.py"
    path.write_text(code.replace(old, new), encoding="utf-8")
    return grader.check(path)


@pytest.mark.parametrize("mistake", WRONG)
def test_a_mistake_that_no_announced_frame_shows_is_found_elsewhere(
    mistake: str, grader: Grader, tmp_path: Path
) -> None:
    name, old, new, words = WRONG[mistake]
    report = checked(grader, tmp_path, name, old, new)
    assert report.error is None
    (failed,) = [result for result in report.results if not result.passed]
    assert failed is report.results[-1] and failed.test.key == "elsewhere"
    assert failed.hint is not None and words in failed.hint.written(str)


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
