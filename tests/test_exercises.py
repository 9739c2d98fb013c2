"""The exercises: solutions pass, and each mistake gets a hint of its own."""

import json
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import jsonschema
import pytest
from folded import each
from solved import solved
from sweeps import Todays

from landscape.commands.exercise_check import as_json, as_text
from landscape.course.exercise import Grader, Report
from landscape.course.grader.grading import Hint
from landscape.course.grader.mutants import mutants
from landscape.course.rehearsal import FEWEST, Rehearsal
from landscape.course.shelf import HOLE, NAMES, exercise, start

PATIENCE = 100.0  # seconds a program may take here: the machine may be busy with other tests


@pytest.fixture(scope="module")
def grader() -> Iterator[Grader]:
    with Grader(PATIENCE) as found:
        yield found


def checked(grader: Grader, folder: Path, code: str) -> Report:
    path = folder / "mine.py"
    path.write_text(code, encoding="utf-8")
    return grader.check(path)


@cache
def of_start(grader: Grader, name: str) -> Report:
    return grader.check(exercise(name).folder / "start.py")


def failures(report: Report) -> list[str]:
    return [result.test.key for result in report.results if result.passed is False]


def hints(report: Report) -> list[Hint]:
    return [result.hint for result in report.results if result.hint is not None]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.sweep(14)
def test_all_solutions_pass_and_the_start_does_not(
    name: str, grader: Grader, todays: Todays, pytestconfig: pytest.Config
) -> None:
    first, *others = sorted(exercise(name).folder.glob("solution*.py"))
    assert first.name == "solution.py" and len(others) >= 3
    if not pytestconfig.getoption("--all"):
        others = todays(others, 2, 14)
    for file in (first, *others):
        report = grader.check(file)
        assert report.passed, as_text(report, lambda text, context="": text)
        assert report.difference is not None and report.difference < 0.0015
        if file == first:
            assert not [result.test.key for result in report.results if result.otherwise]
    report = of_start(grader, name)
    assert report.error is None and len(failures(report)) == 1


@pytest.mark.seldom(13, first=7)
def test_each_mistake_still_fits_its_solution() -> None:
    for name in NAMES:
        code = solved(name)
        for mistake, mutant in mutants(exercise(name)).items():
            compile(mutant.of(code), f"{name}: {mistake}", "exec")


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.sweep(14, first=5)
def test_each_mistake_fails_the_test_it_should_with_a_hint_of_its_own(
    name: str, grader: Grader, pytestconfig: pytest.Config
) -> None:
    found = mutants(exercise(name))
    assert len(found) >= FEWEST
    rehearsal = Rehearsal(exercise(name), grader, lambda text, context="": text)
    assert rehearsal.start().wrong is None
    # There are some 800, so most of them wait for --all.
    step = 1 if pytestconfig.getoption("--all") else 4
    for mistake, mutant in list(found.items())[::step]:
        wrong = rehearsal.mistake(mistake, mutant).wrong
        assert wrong is None, f"{mistake}: {wrong}"


CLEARED = """# exercise: {name}
import glfw
from OpenGL.GL import *
glfw.init()
window = glfw.create_window({size}, "", None, None)
glfw.make_context_current(window)
while not glfw.window_should_close(window):
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glfw.swap_buffers(window)
    glfw.poll_events()
"""
EMPTY = CLEARED.replace("    glfw.swap", "    glBegin(GL_TRIANGLES)\n    glEnd()\n    glfw.swap")
LOOP = "    while not glfw.window_should_close(window):\n"
ONLY_FIRST = """        if glfw.get_time() > 0:
            glfw.swap_buffers(window)
            glfw.poll_events()
            continue
"""


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.sweep(14, first=12)
def test_no_test_passes_for_a_program_that_draws_nothing_or_only_its_first_frame(
    name: str, grader: Grader, tmp_path: Path
) -> None:
    once = solved(name).replace(LOOP, LOOP + ONLY_FIRST)
    assert once != solved(name)
    (size,) = re.findall(r"create_window\((\d+, \d+),", once)
    empty = (code.format(name=name, size=size) for code in (CLEARED, EMPTY))
    for code in (*empty, once):
        report = checked(grader, tmp_path, code)
        assert report.error is None and report.results
        assert not any(result.passed for result in report.results)
        assert "nothing is drawn" in hints(report)[0].written(str)


DARK = "    glColorMask(0, 0, 1, 1)\n"
REGIONS = {
    "the map": (
        "second_viewport",
        (
            "    draw_maze()\n    glViewport",
            DARK + "    draw_maze()\n" + DARK.replace("0", "1") + "    glViewport",
        ),
    ),
    "in the water": ("mirror", ("glColor4f(0.12", "glColor4f(0.5")),
    "what is far, around the horizon": (
        "fog",
        ("(0.95, 0.3, 0.15)", "((0.95, 0.3, 0.15) if z > -10 else (0, 0, 1))"),
    ),
    "the tree at x = -1.8, z = -1.6": (
        "billboard",
        (
            "    glBegin(GL_QUADS)\n",
            "    glColor3f(1, 0.5 if x == -1.8 else 1, 1)\n    glBegin(GL_QUADS)\n",
        ),
    ),
    "the lamp": ("light_position", ("    draw_ball(0.16)\n", "")),
    "the stair": ("clip_plane", ("(0.25, 0.6, 0.6)", "(0.9, 0.6, 0.6)")),
    "beside the floor": ("planar_shadow", ("glClearColor(0.13, 0.16", "glClearColor(0.53, 0.16")),
    "the things and the frame": ("stencil_mirror", ("(0.85, 0.35, 0.2)", "(0.25, 0.35, 0.8)")),
    "the gate": ("hidden_faces", ("(0.95, 0.72, 0.5)", "(0.55, 0.72, 0.5)")),
    "the things": ("shadow_map", ("(0.85, 0.35, 0.2)", "(0.25, 0.35, 0.8)")),
    "the vase": ("vertex_arrays", ("TWO_SIDE, GL_TRUE", "TWO_SIDE, GL_FALSE")),
}


@pytest.mark.parametrize("region", REGIONS)
@pytest.mark.sweep(14)
def test_the_hint_of_a_wrong_picture_names_the_part_of_it(
    region: str, grader: Grader, tmp_path: Path
) -> None:
    name, (old, new) = REGIONS[region]
    code = solved(name).replace(old, new, 1)
    assert code != solved(name)
    report = checked(grader, tmp_path, code)
    assert failures(report) == ["picture"]
    assert f": {region}. " in hints(report)[0].written(str)


@pytest.mark.seldom(14, first=8)
@each("name", NAMES)
def test_an_exercise_has_a_task_a_hole_and_tests_with_rationales(name: str) -> None:
    found = exercise(name)
    assert len(found.title) < 70 and not found.title.endswith(".") and found.task
    code = (found.folder / "start.py").read_text(encoding="utf-8")
    assert code.count("\n") < 160 and HOLE in code and f"# exercise: {name}\n" in code
    for language in ("en", "fr"):
        written = start(found, language)
        compile(written, name, "exec")
        assert max(map(len, written.splitlines())) <= 100
    assert (
        start(found, "en").replace('"""', "").split()[:40] == code.replace('"""', "").split()[:40]
    )


@pytest.mark.seldom(3)
def test_tests_that_need_a_failed_one_are_not_made(grader: Grader, tmp_path: Path) -> None:
    report = of_start(grader, "missing_enable")
    assert [result.passed for result in report.results] == [False, None, None, None]
    shown = as_json(report, lambda text, context="": text)
    assert [test["hint"] != "" for test in shown["tests"]] == [True, False, False, False]
    assert shown["picture_difference"] > 0.1 and shown["passed"] is False
    schema = Path(__file__).resolve().parents[1] / "docs/exercises.schema.json"
    jsonschema.validate(shown | {"cause": None}, json.loads(schema.read_text("utf-8")))


@pytest.mark.seldom(3)
def test_a_hint_names_the_students_own_line(grader: Grader, tmp_path: Path) -> None:
    code = mutants(exercise("missing_enable"))["function_only"].of(solved("missing_enable"))
    line = code.splitlines().index("    glDepthFunc(GL_LESS)") + 1
    report = checked(grader, tmp_path, code)
    assert f"in line {line} " in "\n".join(as_text(report, lambda text, context="": text))


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.sweep(14, first=12)
def test_the_task_and_the_hints_are_in_french_as_well(name: str, grader: Grader) -> None:
    french = exercise(name).translate.to("fr")
    written = start(exercise(name), "fr")
    assert "# Votre code vient ici." in written and exercise(name).task[0][:40] not in written
    report = of_start(grader, name)
    (hint,) = hints(report)
    assert hint.written(french) != hint.written(str)
    assert as_text(report, french)[-1].startswith(f"{len(report.results) - _left(report)} test")


def _left(report: Report) -> int:
    return sum(result.passed is not True for result in report.results)


def test_the_guide_names_every_exercise() -> None:
    root = Path(__file__).parents[1]
    guide = (root / "docs" / "exercises.md").read_text(encoding="utf-8")
    listed = guide.partition("## Which there are")[2].partition("\n## ")[0]
    named = re.findall(r"`([a-z_]+)`", listed)
    assert sorted(named) == sorted(NAMES), '"Which there are" in docs/exercises.md'
