"""Frames of programs that know nothing of the seam: replayed, asked for pixels, edited."""

import json
from pathlib import Path

import pytest
from commands import TESTS, environment, landscape, need_library, python, refused

LANTERN = TESTS / "programs" / "lantern.py"
CHILD = """
import sys
from pathlib import Path

sys.path.insert(0, sys.argv[1])
import program_checks

getattr(program_checks, sys.argv[2])(Path(sys.argv[3]), *eval(sys.argv[4]))
"""


def check(name: str, path: Path, *more: object) -> None:
    """Run one of program_checks in a process of its own."""
    done = python(CHILD, str(TESTS), name, str(path), repr(more))
    assert done.status == 0, done.err


@pytest.mark.parametrize(("frame", "backend"), [(0, "auto"), (4, "egl")])
@pytest.mark.sweep(14, first=7)
def test_a_programs_frame_is_replayed_and_every_pixel_explained(frame: int, backend: str) -> None:
    if backend == "egl":
        need_library("EGL")
    check("every_pixel_is_explained", LANTERN, frame, backend)


@pytest.mark.seldom(10, first=7)
def test_an_edit_in_a_programs_list_is_the_program_with_that_constant_changed(
    tmp_path: Path,
) -> None:
    check("an_edit_in_a_list_is_the_program_changed", tmp_path)


@pytest.mark.seldom(10, first=7)
def test_a_frame_that_begins_without_a_clear_is_replayed_over_what_was_there(
    tmp_path: Path,
) -> None:
    check("a_frame_without_a_clear_is_replayed", tmp_path)


@pytest.mark.seldom(10, first=7)
def test_the_frame_in_which_shaders_are_built_is_replayed(tmp_path: Path) -> None:
    check("shaders_draw_again_what_they_drew", tmp_path)


@pytest.mark.seldom(10, first=7)
def test_a_structured_array_is_shown_as_its_numbers(tmp_path: Path) -> None:
    path = tmp_path / "structured.py"
    path.write_text(
        """
import glfw, numpy as np
from OpenGL.GL import *
glfw.init()
window = glfw.create_window(64, 48, "structured", None, None)
glfw.make_context_current(window)
data = np.zeros(2, [("position", np.float32, 3), ("shade", np.uint8)])
data["position"] = (1, 2, 3), (4, 5, 6)
data["shade"] = 7, 8
glBindBuffer(GL_ARRAY_BUFFER, glGenBuffers(1))
glBufferData(GL_ARRAY_BUFFER, data.nbytes, data, GL_STATIC_DRAW)
glfw.swap_buffers(window)
"""
    )
    assert "26, [1, 2, 3, 7, 4, 5, 6, 8], GL_STATIC_DRAW)" in landscape("trace", path).out
    (call,) = [c for c in landscape("trace", path, "--json").json() if c["name"] == "glBufferData"]
    assert call["args"][2]["values"] == [1.0, 2.0, 3.0, 7, 4.0, 5.0, 6.0, 8]


def test_a_program_that_calls_opengl_past_pyopengl_is_told_so(tmp_path: Path) -> None:
    path = tmp_path / "past.py"
    (tmp_path / "moderngl.py").touch()
    path.write_text(
        """
import glfw, moderngl
glfw.init()
window = glfw.create_window(64, 48, "past", None, None)
glfw.make_context_current(window)
glfw.swap_buffers(window)
"""
    )
    said = landscape("trace", path).err
    assert f"{path}: calls of OpenGL by moderngl, past PyOpenGL, are not seen" in said
    assert f"{path}: has called nothing of OpenGL through PyOpenGL" in said


@pytest.mark.seldom(10, first=7)
def test_files_are_named_by_the_way_from_the_program(tmp_path: Path) -> None:
    folder = tmp_path / "project"
    for name in ("project", "project/a", "project/b", "common"):
        (tmp_path / name).mkdir()
    draw = "from OpenGL.GL import *\ndef draw():\n    glColor3f(1, 0, 0)\n"
    for file in (folder / "a" / "draw.py", folder / "b" / "draw.py", tmp_path / "common/draw.py"):
        file.write_text(draw)
    (folder / "program.py").write_text(
        """
import glfw, sys
from a.draw import draw as first
from b.draw import draw as second
sys.path.append(sys.path[0] + "/../common")
from draw import draw as third
glfw.init()
window = glfw.create_window(64, 48, "files", None, None)
glfw.make_context_current(window)
for draw in (first, second, third):
    draw()
glfw.swap_buffers(window)
"""
    )

    names = ["a/draw.py:3", "b/draw.py:3", "../common/draw.py:3"]
    assert [
        call["source"] for call in landscape("trace", folder / "program.py", "--json").json()
    ] == names

    link = tmp_path / "link"
    link.symlink_to(folder, target_is_directory=True)
    assert [
        call["source"] for call in landscape("trace", link / "program.py", "--json").json()
    ] == names


METHOD = """
import glfw
from OpenGL.GL import *
class Scene:
    def draw(self):
        glColor3f(1, 0, 0)
        glColor3f(0, 1, 0)
glfw.init()
window = glfw.create_window(64, 48, "method", None, None)
glfw.make_context_current(window)
Scene().draw()
glfw.swap_buffers(window)
"""
BY_HAND = {
    "only its name": ({"name": "glColor3f"}, [0.5, 0, 0]),
    "its method": ({"name": "glColor3f", "function": "draw"}, [0.5, 0, 0]),
    "its whole name": ({"name": "glColor3f", "element": "Scene.draw"}, [0.5, 0, 0]),
    "its line": ({"name": "glColor3f", "text": "glColor3f(0, 1, 0)"}, [0.5, 1, 0]),
    "which one": ({"name": "glColor3f", "file": "method.py", "occurrence": 1}, [0.5, 1, 0]),
    "another function": ({"name": "glColor3f", "function": "paint"}, None),
}


@pytest.mark.sweep(8, first=7)
@pytest.mark.parametrize("name", BY_HAND)
def test_an_edit_written_by_hand_needs_only_what_tells_its_call(tmp_path: Path, name: str) -> None:
    call, wanted = BY_HAND[name]
    program, edits = tmp_path / "method.py", tmp_path / "edits.json"
    program.write_text(METHOD)
    entry = {"call": call, "argument": 0, "value": 0.5}
    edits.write_text(json.dumps({"version": 1, "edits": [entry]}))
    done = landscape("trace", program, "--edits", edits, "--json")
    changed = [call["args"] for call in done.json() if call["args"][0] == 0.5]
    assert changed == ([wanted] if wanted else [])
    told = "no call glColor3f in paint was made; glColor3f is called in Scene.draw (method.py)"
    assert (told in done.err) == (wanted is None)


@pytest.mark.seldom(3)
def test_edits_that_name_a_file_without_its_folder_find_it(tmp_path: Path) -> None:
    (tmp_path / "scene").mkdir()
    (tmp_path / "scene" / "draw.py").write_text(
        "from OpenGL.GL import *\ndef draw():\n    glColor3f(1, 0, 0)\n"
    )
    program, edits = tmp_path / "program.py", tmp_path / "edits.json"
    program.write_text(METHOD.replace("Scene().draw()", "import scene.draw; scene.draw.draw()"))
    call = {"name": "glColor3f", "element": "draw", "pass": "setup", "file": "draw.py"}
    call |= {"function": "draw", "text": "glColor3f(1, 0, 0)", "select": [], "occurrence": 0}
    entry = {"call": call, "argument": 1, "value": 0.5}
    edits.write_text(json.dumps({"version": 1, "edits": [entry]}))
    done = landscape("trace", program, "--edits", edits)
    assert "glColor3f(1, 0.5, 0)" in done.out and not done.err


def test_json_has_what_an_edit_says_of_its_call(tmp_path: Path) -> None:
    path = tmp_path / "method.py"
    path.write_text(METHOD)
    (_, call) = landscape("trace", path, "--json").json()
    assert (call["function"], call["text"]) == ("Scene.draw", "glColor3f(0, 1, 0)")


@pytest.mark.seldom(10, first=9)
def test_the_lists_of_a_text_are_found_from_the_list_base(tmp_path: Path) -> None:
    check("lists_are_found_from_the_list_base", tmp_path)


@pytest.mark.seldom(10, first=9)
def test_the_setup_ends_with_the_first_call_that_draws(tmp_path: Path) -> None:
    check("the_setup_ends_with_the_first_draw", tmp_path)


@pytest.mark.seldom(13, first=11)
def test_the_tools_do_without_the_accelerator_of_pyopengl() -> None:
    without = landscape("state", LANTERN, env=environment(PYOPENGL_USE_ACCELERATE="0"))
    assert without.status == 0, without.err
    assert "GL_SELECTION_BUFFER_POINTER" in without.out
    assert without.out == landscape("state", LANTERN).out


@pytest.mark.seldom(13, first=5)
def test_the_commands_look_into_programs(tmp_path: Path) -> None:
    done = landscape("pixel", LANTERN, "200,150", "--frame", "2")
    assert done.status == 0 and "make_lantern: glBegin(GL_QUAD_STRIP)" in done.out, done.err
    refused(landscape("trace", LANTERN, "--preset", "2006"), "--preset", "program")
    refused(landscape("trace", LANTERN, "--size", "320x240"), "--size", "program")
    refused(landscape("trace", LANTERN, "--element", "fog"), "'fog'", "make_lantern")
    refused(landscape("trace", "fig35a", "--frame", "2"), "--frame", "view")
    path = tmp_path / "raises.py"
    path.write_text("import glfw\n\nraise ValueError('no such lamp')\n")
    done = landscape("trace", path)
    first, *rest = done.err.splitlines()
    assert done.status == 2 and "raises.py, line 3: the program raised ValueError" in first
    assert rest[0].startswith("Traceback") and rest[-1] == "ValueError: no such lamp"


CORE = """
import glfw
from OpenGL.GL import *

glfw.init()
glfw.window_hint(glfw.CONTEXT_VERSION_MAJOR, 3)
glfw.window_hint(glfw.CONTEXT_VERSION_MINOR, 3)
glfw.window_hint(glfw.OPENGL_PROFILE, glfw.OPENGL_CORE_PROFILE)
window = glfw.create_window(64, 48, "core", None, None)
glfw.make_context_current(window)
while not glfw.window_should_close(window):
    glClear(GL_COLOR_BUFFER_BIT)
    glfw.swap_buffers(window)
    glfw.poll_events()
"""


@pytest.mark.seldom(13, first=5)
def test_a_program_without_fixed_function_is_traced_and_no_more(tmp_path: Path) -> None:
    need_library("OSMesa")  # without a screen nothing else gives a core profile
    path = tmp_path / "core.py"
    path.write_text(CORE)
    done = landscape("trace", path)
    assert done.status == 0 and "glClear(GL_COLOR_BUFFER_BIT)" in done.out, done.err
    for words in (("pixel", path, "5,5"), ("state", path), ("strip", path)):
        done = landscape(*words)
        assert done.status == 2 and "Traceback" not in done.err
        assert "core profile" in done.err.splitlines()[-1]
