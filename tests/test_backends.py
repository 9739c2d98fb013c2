"""The backends: each opens, all give the same pixels, and a missing one says what to install.

PyOpenGL binds to one platform per process, so each backend is tested in its own process.
"""

import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from commands import TESTS, end, environment, has_library, landscape, need_library, python

from framelens.gl import advice, libraries
from landscape.commands import doctor

SCENE = (
    "fig35a",
    "--preset",
    "2006",
    "--size",
    "96x72",
    "--only",
    "ground,water,sky,castle,map,fog",
)
WINDOWS = sys.platform == "win32"
BACKENDS = ("osmesa", "glfw", "egl") if WINDOWS else ("osmesa", "egl", "glfw")
ABORTED = 3 if WINDOWS else -6  # the exit status after os.abort()
NO_GLFW = "install the Python package glfw"

# Renders an image without and one with antialiasing; prints the renderer and their hashes.
DRAW = (
    f"TESTS = {str(TESTS)!r}"
    + """
import hashlib, json, sys
sys.path.insert(0, TESTS)
import landscape
from framelens.gl import ownership
from framelens.gl.seam import gl
from framelens.gl.contexts.glfw import GLFWContext

backend, null = sys.argv[1].removeprefix("null "), sys.argv[1].startswith("null ")
if null:
    ownership.open_context = lambda name: GLFWContext(size=(40, 30), backend=name)
if backend == "cgl":
    import fake_cgl
    fake_cgl.install()
only = ("ground", "water", "sky", "castle", "trees", "map", "fog", "reflection")
found = {}
for samples in (0, 4):
    few = {"trees.count": 90, "ground.texture_size": 256}
    options = {"preset": "2006", "only": only, "samples": samples, "settings": few}
    with landscape.Offscreen((96, 72), backend=backend, **options) as view:
        view.look("fig35a")
        pixels = view.draw()
        assert len({tuple(p) for p in pixels.reshape(-1, 3).tolist()}) > 500, "hardly a picture"
        found[str(samples)] = hashlib.sha256(pixels).hexdigest()
        found["renderer"] = gl.glGetString(gl.GL_RENDERER).decode()
print(json.dumps(found))
"""
)

# Runs a command line as if the libraries in the first argument were not installed.
WITHOUT = """
import sys
from landscape.cli import main
from framelens.gl import libraries

hidden, load = sys.argv[1].split(","), libraries.load

def load_others(name):
    if name in hidden:
        raise OSError("none found")
    return load(name)

libraries.load = load_others
if "glfw" in hidden:
    sys.modules["glfw"] = None
sys.exit(main(sys.argv[2:]))
"""


def one_line(text: str) -> bool:
    return text.startswith("landscape: ") and text.count("\n") == 1


@pytest.fixture(scope="module")
def screen() -> Iterator[dict[str, str]]:
    """The environment of a user with a display, which is Xvfb except on Windows."""
    if WINDOWS:
        yield environment()
        return
    if shutil.which("Xvfb") is None:
        pytest.skip("Xvfb is not installed")
    need_library("GL")
    read, write = os.pipe()
    command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "640x480x24", "-nolisten", "tcp"]
    server = subprocess.Popen(command, pass_fds=[write], stderr=subprocess.DEVNULL)
    os.close(write)

    try:
        with os.fdopen(read) as pipe:
            number = pipe.readline().strip()
        if not number:
            pytest.skip("Xvfb does not start")
        yield environment(DISPLAY=f":{number}")
    finally:
        end(server)


@pytest.fixture(scope="module")
def reference() -> dict[str, str]:
    """The result of OSMesa, or of what every user has if OSMesa is not installed."""
    backend = "osmesa" if has_library("OSMesa") else "glfw" if WINDOWS else "egl"
    done = python(DRAW, backend)
    assert done.status == 0, done.err
    found: dict[str, str] = json.loads(done.out)
    assert found["0"] != found["4"], "antialiasing changes nothing"
    return found


def check_same(kind: str, env: dict[str, str], reference: dict[str, str]) -> None:
    done = python(DRAW, kind, env=env)
    assert done.status == 0, done.err
    found = json.loads(done.out)
    if found["renderer"] != reference["renderer"]:
        pytest.skip(f"{kind} uses another renderer: {found['renderer']}")
    assert found == reference


@pytest.mark.seldom(10, first=3)
def test_egl_without_a_surface_gives_the_same_pixels(reference: dict[str, str]) -> None:
    need_library("EGL")
    check_same("egl", environment(), reference)


@pytest.mark.window
@pytest.mark.seldom(10, first=3)
def test_a_hidden_window_gives_the_same_pixels(
    reference: dict[str, str], screen: dict[str, str]
) -> None:
    check_same("glfw", screen, reference)


@pytest.mark.window
@pytest.mark.parametrize(("backend", "library"), [("osmesa", "OSMesa"), ("egl", "EGL")])
@pytest.mark.sweep(12, first=9)
def test_the_null_platform_of_glfw_gives_the_same_pixels(
    backend: str, library: str, reference: dict[str, str]
) -> None:
    need_library(library)
    check_same(f"null {backend}", environment(), reference)


@pytest.mark.seldom(10, first=3)
def test_software_asked_for_gives_the_same_pixels(reference: dict[str, str]) -> None:
    check_same("software", environment(), reference)


@pytest.mark.skipif(sys.platform != "linux", reason="EGL stands in for macOS's CGL on Linux")
@pytest.mark.seldom(10, first=3)
def test_a_context_without_a_framebuffer_of_its_own_gives_the_same_pixels(
    reference: dict[str, str],
) -> None:
    need_library("EGL")
    check_same("cgl", environment(), reference)


@pytest.mark.window
@pytest.mark.seldom(10, first=3)
def test_render_in_a_hidden_window_writes_the_same_file(
    tmp_path: Path, screen: dict[str, str]
) -> None:
    need_library("OSMesa")
    for backend in ("glfw", "osmesa"):
        out = tmp_path / f"{backend}.png"
        done = landscape("render", *SCENE, "--backend", backend, "--out", out, env=screen)
        assert (done.status, done.err) == (0, "")
    assert (tmp_path / "glfw.png").read_bytes() == (tmp_path / "osmesa.png").read_bytes()


@pytest.mark.posix_only("every process has a screen there")
@pytest.mark.window
def test_the_glfw_backend_without_a_display_ends_with_status_3() -> None:
    done = landscape("render", *SCENE, "--backend", "glfw")
    assert done.status == 3 and done.out == ""
    assert done.err.startswith("landscape: GLFW found no screen") and done.err.count("\n") == 1
    assert "xvfb" in done.err


@pytest.mark.parametrize(
    ("backend", "hidden", "package"),
    [
        ("osmesa", "OSMesa", advice.install("osmesa")),
        ("egl", "EGL", advice.install("egl")),
        ("glfw", "glfw", NO_GLFW),
        ("auto", "OSMesa,EGL,GL,glfw", NO_GLFW if WINDOWS else advice.install("egl")),
    ],
)
@pytest.mark.sweep(2)
def test_a_missing_library_ends_with_status_3_and_names_the_package(
    backend: str, hidden: str, package: str, tmp_path: Path
) -> None:
    out = tmp_path / "out.png"
    done = python(WITHOUT, hidden, "render", *SCENE, "--backend", backend, "--out", str(out))
    assert done.status == 3 and done.out == ""
    assert one_line(done.err)
    assert package in done.err
    assert not out.exists()


@pytest.mark.posix_only("OpenGL's library is part of it")
@pytest.mark.window
def test_a_missing_libgl_is_named_by_its_package(screen: dict[str, str]) -> None:
    done = python(WITHOUT, "GL", "render", *SCENE, "--backend", "glfw", env=screen)
    assert done.status == 3
    assert one_line(done.err) and advice.install("glfw") in done.err


@pytest.mark.seldom(10, first=3)
def test_an_unloadable_library_ends_with_status_3(tmp_path: Path) -> None:
    names = ["OSMesa.dll"] if WINDOWS else libraries.file_names("OSMesa")
    for name in names:
        (tmp_path / name).write_text("not a library")
    env = environment(**{"PATH" if WINDOWS else "LD_LIBRARY_PATH": str(tmp_path)})
    done = landscape("render", *SCENE, "--backend", "osmesa", env=env)
    assert done.status == 3 and one_line(done.err)
    assert str(tmp_path / names[0]) in done.err and advice.install("osmesa") in done.err


@pytest.mark.seldom(13, first=2)
def test_auto_uses_the_next_backend_if_the_first_is_missing(tmp_path: Path) -> None:
    need_library("OSMesa", "EGL")
    for name, hidden in (("first", "nothing"), ("next", "OSMesa")):
        out = str(tmp_path / f"{name}.png")
        done = python(WITHOUT, hidden, "render", *SCENE, "--out", out)
        assert (done.status, done.err) == (0, "")
    assert (tmp_path / "first.png").read_bytes() == (tmp_path / "next.png").read_bytes()


def test_a_missing_backend_keeps_nothing_alive() -> None:
    need_library("EGL")
    code = """
import gc, weakref
import landscape
from framelens.base.errors import NoOpenGLError
from framelens.gl import context

def missing():
    raise NoOpenGLError("no OSMesa library")

context.MAKERS["osmesa"] = missing
landscape.Offscreen((64, 48)).close()  # the first one imports OpenGL, whose import keeps frames
gc.disable()
view = landscape.Offscreen((64, 48))
dropped = weakref.ref(view)
del view
print(dropped())
"""
    done = python(code)
    assert (done.status, done.out, done.err) == (0, "None\n", "")


def test_a_second_platform_in_one_process_is_refused_with_an_explanation() -> None:
    need_library("OSMesa", "EGL")
    code = """
from framelens.base.errors import NoOpenGLError
from framelens.gl.context import open_context
open_context("osmesa").release()
try:
    open_context("egl")
except NoOpenGLError as error:
    print(error)
"""
    done = python(code)
    assert "runs on osmesa in this process" in done.out, done.err


@pytest.mark.seldom(3, first=2)
@pytest.mark.parametrize("backend", ["osmesa", "null"])
def test_a_context_may_be_closed_right_after_a_bitmap_was_drawn(backend: str) -> None:
    need_library("OSMesa")
    code = """
import sys
from framelens.gl.seam import gl
from framelens.gl.context import open_context
from framelens.gl.contexts.glfw import GLFWContext
null = sys.argv[1] == "null"
context = GLFWContext(size=(40, 30), backend="headless") if null else open_context("osmesa")
gl.glRasterPos2f(0.0, 0.0)
gl.glBitmap(8, 1, 0.0, 0.0, 9.0, 0.0, bytes(8))
context.release()
"""
    done = python(code, backend)
    assert (done.status, done.err) == (0, "")


@pytest.mark.seldom(3, first=2)
@pytest.mark.parametrize("backend", ["osmesa", "egl"])
def test_contexts_can_be_opened_and_closed_repeatedly_in_one_process(backend: str) -> None:
    need_library({"osmesa": "OSMesa", "egl": "EGL"}[backend])
    code = """
import sys
from framelens.gl.seam import gl
from framelens.gl.context import open_context
for _ in range(20):
    context = open_context(sys.argv[1])
    assert gl.glGetString(gl.GL_VERSION)
    context.release()
    context.release()
"""
    done = python(code, backend)
    assert (done.status, done.err) == (0, "")


# --- doctor ------------------------------------------------------------------------------------


@pytest.mark.seldom(13, first=9)
def test_doctor_json_has_the_documented_fields() -> None:
    done = landscape("doctor", "--json")
    found = done.json()
    assert set(found) == {"backends", "chosen", "python", "packages", "conflict", "cache"}
    assert set(found["cache"]) == {"folder", "reason"}
    assert tuple(found["backends"]) == BACKENDS
    for state in found["backends"].values():
        if state["ok"]:
            assert set(state) == {"ok", "renderer", "version", "units", "widest_line", "off"}
            assert state["units"] >= 1 and state["widest_line"] >= 1.0
            assert all(names and why for why, names in state["off"].items())
            assert all(
                isinstance(state[key], str) and state[key] for key in ("renderer", "version")
            )
        else:
            assert set(state) == {"ok", "reason"} and state["reason"]

    usable = [name for name in BACKENDS if found["backends"][name]["ok"]]
    assert found["chosen"] == usable[0]
    assert found["packages"]["PyOpenGL"] >= "3.1.10"
    assert {"glfw", "numpy", "pillow", "platformdirs", "polib", "tqdm"} <= set(found["packages"])
    assert found["backends"]["glfw"]["ok"] == WINDOWS, "there is no display elsewhere"


@pytest.mark.seldom(13, first=9)
@pytest.mark.window
def test_doctor_finds_the_glfw_backend_if_there_is_a_display(screen: dict[str, str]) -> None:
    assert landscape("doctor", "--json", env=screen).json()["backends"]["glfw"]["ok"]


@pytest.mark.seldom(10, first=3)
def test_doctor_prints_one_line_per_backend() -> None:
    done = landscape("doctor")
    assert done.status == 0 and done.err == ""
    lines = [line for line in done.out.splitlines() if not line.startswith(" ")]
    assert [line.split()[0] for line in lines[:3]] == list(BACKENDS)
    assert lines[3].startswith("`auto` takes ")


def test_doctor_ends_with_status_3_and_names_packages_if_nothing_works() -> None:
    code = """
import sys
from landscape.commands import doctor
from framelens.gl import advice
from landscape.cli import main
doctor.probe = lambda name: {"ok": False, "reason": advice.install(name, on="debian")}
sys.exit(main(["doctor", *sys.argv[1:]]))
"""
    done = python(code)
    assert done.status == 3
    assert "libosmesa6" in done.out and "`auto` takes none" in done.out
    found = json.loads(python(code, "--json").out)
    assert found["chosen"] is None


@pytest.mark.seldom(10, first=3)
def test_doctor_survives_a_backend_that_crashes_or_hangs(
    tmp_path: Path,
) -> None:
    look_at = """
import os, time
def look_at(backend):
    os.abort() if backend == "egl" else time.sleep(600)
"""
    (tmp_path / "bad_backends.py").write_text(look_at, encoding="utf-8")
    code = f"import sys; sys.path.insert(0, {str(tmp_path)!r})"
    code += """
import json
import bad_backends
from landscape.commands import doctor
doctor.look_at = bad_backends.look_at
crashed = doctor.probe("egl")
doctor.SECONDS = 2
print(json.dumps([crashed, doctor.probe("osmesa")]))
"""
    crashed, hung = json.loads(python(code).out)
    assert not crashed["ok"] and f"ended with {ABORTED}:" in crashed["reason"]
    assert not hung["ok"] and "no answer in 2 seconds" in hung["reason"]


def test_doctor_says_where_a_backend_met_what_nobody_foresaw(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    context = "from framelens.gl import context; context.open_context = lambda name: {}['a defect']"
    (tmp_path / "sitecustomize.py").write_text(context, encoding="utf-8")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=os.pathsep)
    state = doctor.probe("osmesa")
    assert not state["ok"]
    assert re.fullmatch(r"KeyError: 'a defect', in .*sitecustomize\.py, line 1", state["reason"])
