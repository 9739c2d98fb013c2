"""Programs in a hidden window draw into a framebuffer object, and do not notice."""

import json
import sys
from pathlib import Path

import numpy as np
import pytest
from commands import TESTS, environment, landscape, need_library, python
from PIL import Image
from watching import screen

pytestmark = [
    pytest.mark.window,
    pytest.mark.skipif(sys.platform != "linux", reason="needs Xvfb, or EGL in the place of CGL"),
]

PROGRAM = TESTS / "programs" / "framebuffers.py"
# Runs a command line with CGL, for which EGL stands: its contexts have no framebuffer of their own.
# The display is one of twice the resolution, as those of Macs are.
CGL = f"""
import sys
sys.path.insert(0, {str(TESTS)!r})
import fake_cgl, glfw
from framelens.program import program_context
from landscape.cli import main
fake_cgl.install()
get_framebuffer_size = glfw.get_framebuffer_size
glfw.get_framebuffer_size = lambda window: [2 * side for side in get_framebuffer_size(window)]
glfw.get_window_content_scale = lambda window: (2.0, 2.0)
bound = program_context.use_platform
program_context.use_platform = lambda name, checked=None: bound("egl", checked)
program_context.WITHOUT_SCREEN["cgl"] = (lambda: None, "native")
sys.exit(main(sys.argv[1:]))
"""


@pytest.fixture(scope="module")
def hidden():
    """Runs a command line with the backend glfw, or cgl, in a process of its own."""
    need_library("EGL", "GL")
    with screen() as display:

        def run(backend: str, *words: str | Path):
            words = (*map(str, words), "--backend", backend)
            if backend == "cgl":
                return python(CGL, *words)
            return landscape(*words, env=environment(DISPLAY=display))

        yield run


def red_and_green(path: Path) -> bool:
    """Whether a picture is red on the left and green on the right, in halves."""
    pixels = np.asarray(Image.open(path))
    half = pixels.shape[1] // 2
    return (pixels[:, :half] == (255, 0, 0)).all() and (pixels[:, half:] == (0, 255, 0)).all()


@pytest.mark.seldom(10, first=8)
@pytest.mark.parametrize("backend", ["glfw", "cgl"])
def test_a_program_finds_its_window_as_it_would_be(hidden, backend: str, tmp_path: Path) -> None:
    out = tmp_path / "out.png"
    done = hidden(backend, "strip", PROGRAM, "--by", "draw", "--out", out)
    assert (done.status, done.err) == (0, "")
    assert out.exists()


@pytest.mark.seldom(10, first=2)
@pytest.mark.parametrize("backend", ["glfw", "cgl"])
def test_state_and_pixels_are_told_as_of_a_window(hidden, backend: str) -> None:
    state = hidden(backend, "state", PROGRAM, "--json").json()
    assert state["GL_DRAW_FRAMEBUFFER_BINDING"] == 0
    assert (state["GL_DRAW_BUFFER"], state["GL_READ_BUFFER"]) == ("GL_BACK", "GL_BACK")
    history = hidden(backend, "pixel", PROGRAM, "48,24", "--json").json()
    assert history[-1]["color"][:3] == [0, 255, 0]


@pytest.mark.seldom(10, first=5)
@pytest.mark.parametrize("backend", ["glfw", "cgl"])
def test_a_program_is_drawn_in_the_new_size_of_its_window(
    hidden, backend: str, tmp_path: Path
) -> None:
    events = tmp_path / "events.json"
    events.write_text(json.dumps([{"frame": 0, "resize": [96, 80]}]))
    words = ("state", PROGRAM, "--frame", "1", "--events", events, "--json")
    assert hidden(backend, *words).json()["GL_VIEWPORT"] == [0, 0, 96, 80]


@pytest.mark.seldom(13, first=12)
def test_a_hidden_window_of_pygame_has_one_too(hidden) -> None:
    pytest.importorskip("pygame", reason="pygame is not installed")
    program, place = PROGRAM.with_name("waves.py"), "200,150"
    last = [
        hidden(backend, "pixel", program, place, "--frame", "2", "--json").json()[-1]["color"]
        for backend in ("glfw", "egl")
    ]
    assert np.abs(np.subtract(*last)).max() <= 4
    assert hidden("glfw", "state", program, "--json").json()["GL_DRAW_BUFFER"] == "GL_BACK"


@pytest.mark.parametrize("backend", ["glfw", "cgl"])
@pytest.mark.parametrize("name", ["triangle", "stencil_mirror", "shadow_map", "accumulation"])
@pytest.mark.sweep(14, first=11)
def test_a_lesson_has_the_picture_that_it_has_without_a_screen(
    hidden, backend: str, name: str, tmp_path: Path
) -> None:
    pictures = []
    for kind in (backend, "egl"):
        out = tmp_path / f"{kind}.png"
        words = ("lesson", name, "--out", out)
        done = landscape(*words, "--backend", kind) if kind == "egl" else hidden(kind, *words)
        assert (done.status, done.err) == (0, "")
        pictures.append(np.asarray(Image.open(out)).astype(int))
    assert pictures[0].shape == pictures[1].shape
    off = np.abs(pictures[0] - pictures[1]).max(2) > 4
    assert off.mean() < 0.001
