"""The plain programs of the lessons, each with GLFW and with GLUT: pictures, tools and copies."""

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from commands import Shell, environment, landscape, need_library
from watching import Watcher, screen

from landscape.course.ladder import LESSONS, PROGRAMS, lessons, program_files

NAMES = sorted(name for lesson in lessons() for name in lesson.programs)
TEAPOTS = ("light_of_camera", "light_of_world", "wire_teapot")  # which GLUT draws by itself
each_program = pytest.mark.parametrize("name", NAMES)


@pytest.fixture(scope="module")
def glfw_watcher() -> Iterator[Watcher]:
    """Runs programs without a screen."""
    watcher = Watcher(PROGRAMS)
    yield watcher
    watcher.close()


@pytest.fixture(scope="module")
def glut_watcher(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Watcher]:
    """Runs programs on a screen."""
    need_library("glut")
    with screen() as name:
        watcher = Watcher(tmp_path_factory.mktemp("users"), DISPLAY=name)
        yield watcher
        watcher.close()


def test_each_of_the_thirteen_programs_has_two_forms_and_belongs_to_one_lesson() -> None:
    assert len(NAMES) == len({*NAMES}) == 13
    files = {file for name in NAMES for file in program_files(name)}
    assert files == {*PROGRAMS.glob("*.py")}


@each_program
def test_a_program_is_plain_and_says_what_it_is_written_with(name: str) -> None:
    allowed = {"sys", "math", "pathlib", "numpy", "PIL", "glfw", "OpenGL"}
    for file, toolkit in zip(program_files(name), ("GLFW", "GLUT"), strict=True):
        source = file.read_text(encoding="utf-8")
        assert set(re.findall(r"^(?:import|from) (\w+)", source, re.MULTILINE)) <= allowed
        assert f"with {toolkit}" in source.split('"""')[1]
        assert ("import glfw" in source) != ("OpenGL.GLUT" in source)


@each_program
@pytest.mark.sweep(12, first=11)
def test_a_program_runs_without_a_screen(name: str, glfw_watcher: Watcher) -> None:
    drawn = glfw_watcher(program_files(name)[0], 1)
    assert drawn.error == "", drawn.details


@pytest.mark.window
@each_program
@pytest.mark.sweep(12, first=11)
def test_both_forms_draw_the_same_picture(
    name: str, glfw_watcher: Watcher, glut_watcher: Watcher, tmp_path: Path
) -> None:
    pictures = []
    for file, watcher in zip(program_files(name), (glfw_watcher, glut_watcher), strict=True):
        written = tmp_path / f"{file.stem}.rgb"
        drawn = watcher(file, 1, file=str(written))
        assert drawn.error == "", drawn.details
        width, height = drawn.size
        pictures.append(np.fromfile(written, np.uint8).reshape(height, width, 3).astype(int))

    one, two = pictures
    assert one.shape == two.shape
    if name not in TEAPOTS:
        assert np.abs(one - two).max() <= 2
        return

    # GLUT divides its patches in its own way: the outlines agree, and where there is light.
    shown, expected = ((picture < 250).all(-1) for picture in pictures)
    rows, columns = (np.flatnonzero(shown.any(axis)) for axis in (1, 0))
    wanted_rows, wanted_columns = (np.flatnonzero(expected.any(axis)) for axis in (1, 0))
    assert np.abs(rows[[0, -1]] - wanted_rows[[0, -1]]).max() <= 2
    assert np.abs(columns[[0, -1]] - wanted_columns[[0, -1]]).max() <= 2
    if name != "wire_teapot":
        assert (np.abs(one - two).max(-1) > 8).mean() < 0.02


@pytest.mark.seldom(13, first=5)
@pytest.mark.window
@pytest.mark.parametrize("name", ["wire_teapot", "grey_keys"])
def test_trace_and_strip_show_a_glut_program(name: str, tmp_path: Path) -> None:
    need_library("glut")
    file = str(program_files(name)[1])
    with screen() as shown:
        env = environment(DISPLAY=shown)
        traced = landscape("trace", file, env=env)
        assert traced.status == 0, traced.err
        assert "glClear(" in traced.out
        picture = tmp_path / "strip.png"
        assert landscape("strip", file, "--out", str(picture), env=env).status == 0
        assert picture.stat().st_size > 1000


@pytest.mark.seldom(10, first=7)
def test_a_lesson_is_copied_with_its_programs_which_run_there_in_french(
    glfw_watcher: Watcher, tmp_path: Path
) -> None:
    shell = Shell()
    try:
        done = shell("lesson", "teapot", "--copy", tmp_path, "--lang", "fr")
    finally:
        shell.close()
    assert done.status == 0, done.err
    copies = [tmp_path / "programs" / file.name for file in program_files("wire_teapot")]
    assert all(copy.is_file() for copy in copies)
    assert copies[0].read_text(encoding="utf-8").startswith('"""Une théière en lignes')
    drawn = glfw_watcher(copies[0], 1)
    assert drawn.error == "", drawn.details
    assert drawn.picture == glfw_watcher(LESSONS / "programs" / "wire_teapot.py", 1).picture
