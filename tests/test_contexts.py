"""Contexts where a library is odd: elsewhere, incomplete, without a driver, or of another system.

PyOpenGL binds to one platform per process, so each case has a process of its own.
"""

import os
import sys
import threading
from pathlib import Path

import pytest
from commands import TESTS, environment, landscape, need_library, python
from watching import screen

from framelens.base.errors import NoOpenGLError
from framelens.gl import advice, libraries
from framelens.gl.contexts import glfw

BEGIN = (
    f"""
import sys
sys.path.insert(0, {str(TESTS)!r})
"""
    + """
from framelens.base.errors import NoOpenGLError
from framelens.gl import context, libraries
from framelens.gl.seam import gl
from framelens.gl.context import open_context

load = libraries.load

def without(*names):
    def load_others(name):
        if name in names:
            raise OSError("none found")
        return load(name)
    libraries.load = load_others

def tell(opened):
    print(opened.backend, gl.glGetString(gl.GL_RENDERER).decode())
    opened.release()
"""
)
SYSTEMS = ("debian", "fedora", "arch", "alpine", "nixos", "guix", "conda", "macos", "windows", "")
linux = pytest.mark.skipif(sys.platform != "linux", reason="libraries as Linux has them")


def told(code: str, env: dict[str, str] | None = None) -> str:
    """Run code after BEGIN; return what it prints."""
    done = python(BEGIN + code, env=env)
    assert done.status == 0, done.err
    return done.out.strip()


# --- libraries ----------------------------------------------------------------------------------


@linux
def test_a_library_that_only_the_loader_finds_is_loaded(tmp_path: Path) -> None:
    need_library("GL")
    libraries.load("GL")
    mapped = [line.split()[-1] for line in Path("/proc/self/maps").read_text().splitlines()]
    place = next(path for path in mapped if Path(path).name.startswith("libGL.so"))
    (tmp_path / "libElsewhere.so.3").symlink_to(place)
    code = """
import ctypes.util
assert ctypes.util.find_library("Elsewhere") is None
print(bool(libraries.load("Elsewhere").glClear))
"""
    folders = [str(tmp_path), *os.environ.get("LD_LIBRARY_PATH", "").split(":")]
    assert told(code, environment(LD_LIBRARY_PATH=":".join(filter(None, folders)))) == "True"


@pytest.mark.seldom(3)
@linux
@pytest.mark.parametrize(("backend", "library"), [("osmesa", "OSMesa"), ("egl", "EGL")])
def test_a_context_is_opened_where_only_the_loader_knows_libraries(
    backend: str, library: str
) -> None:
    need_library(library)
    code = "import ctypes.util; ctypes.util.find_library = lambda name: None\n"
    assert told(f"{code}tell(open_context({backend!r}))").split()[0] == backend


@linux
def test_a_library_that_does_not_load_says_why(tmp_path: Path) -> None:
    for name in libraries.file_names("Elsewhere"):
        (tmp_path / name).write_text("not a library")
    code = """
try:
    libraries.require("Elsewhere", "egl")
except NoOpenGLError as error:
    print(error)
"""
    said = told(code, environment(LD_LIBRARY_PATH=str(tmp_path)))
    assert said.startswith(f"no Elsewhere library ({tmp_path}/libElsewhere.so")
    assert "none found" not in said and "install" in said


# --- auto goes on -------------------------------------------------------------------------------


@linux
@pytest.mark.seldom(3, first=1)
def test_auto_goes_on_from_an_osmesa_that_lacks_a_function() -> None:
    need_library("EGL")
    code = """
import ctypes
libraries.load = lambda name: ctypes.CDLL(None) if name == "OSMesa" else load(name)
try:
    open_context("osmesa")
except NoOpenGLError as error:
    assert "the OSMesa library has no OSMesaCreateContextExt" in str(error), error
tell(open_context())
"""
    assert told(code).split()[0] == "egl"


@pytest.mark.seldom(3)
@linux
@pytest.mark.window
def test_auto_goes_on_from_an_egl_without_a_driver() -> None:
    need_library("EGL")
    code = """
from framelens.gl.contexts.egl import EGLContext
without("OSMesa")
EGLContext._displays = lambda self: ()
tell(open_context())
"""
    with screen() as display:
        assert told(code, environment(DISPLAY=display)).split()[0] == "glfw"


@pytest.mark.seldom(3)
@linux
def test_a_driver_that_mesa_does_not_have_is_told_in_one_line() -> None:
    need_library("OSMesa")
    code = """
without("EGL", "GL")
try:
    open_context("auto")
except NoOpenGLError as error:
    print(error)
"""
    line = told(code, environment(GALLIUM_DRIVER="nosuch"))
    assert line.startswith("OSMesa has no driver nosuch: unset GALLIUM_DRIVER")


@linux
def test_egl_without_a_library_of_drawing_functions_is_refused() -> None:
    need_library("EGL")
    code = """
without("GL", "OpenGL")
try:
    open_context("egl")
except NoOpenGLError as error:
    print(error)
"""
    assert told(code).startswith("no GL library (none found): ")


# --- software -----------------------------------------------------------------------------------


@linux
@pytest.mark.parametrize("device", [True, False])
@pytest.mark.sweep(4)
def test_egl_draws_by_software_if_asked_to(device: bool) -> None:
    need_library("EGL")
    code = """
import os
from framelens.gl.contexts import egl
without("OSMesa")
if sys.argv[1] == "False":
    egl.software_device = lambda: None
tell(open_context("software"))
print(os.environ.get("LIBGL_ALWAYS_SOFTWARE"))
"""
    done = python(BEGIN + code, str(device), env=environment(LIBGL_ALWAYS_SOFTWARE=None))
    assert done.status == 0, done.err
    assert done.out.startswith("egl ")
    if not device:
        assert done.out.endswith("\n1\n")


@linux
@pytest.mark.seldom(3, first=2)
def test_egl_draws_by_a_device_where_a_driver_has_no_other_display() -> None:
    need_library("EGL")
    code = """
from framelens.base.errors import NoOpenGLError
from framelens.gl.contexts import egl
without("OSMesa")
known = egl.devices()

def missing(*_):
    raise NoOpenGLError("no display")

# Mesa's device, taken for a graphics card: the only display that is left.
egl.EGLContext._surfaceless = missing
egl.library().eglGetDisplay = missing
egl.devices = lambda: [(handle, False) for handle, _ in known]
if known:
    tell(open_context("egl"))
else:
    print("egl: no devices")
"""
    done = python(BEGIN + code)
    assert done.status == 0, done.err
    assert done.out.startswith("egl")


@pytest.mark.seldom(3)
@linux
def test_a_renderer_that_is_no_software_is_refused_where_software_is_asked_for() -> None:
    need_library("EGL")
    code = """
from framelens.gl.contexts import software
without("OSMesa")
software.NAMES = ("abacus",)
try:
    open_context("software")
except NoOpenGLError as error:
    print(error)
"""
    said = told(code)
    assert said.startswith("this OpenGL is ") and "for software, install" in said


@pytest.mark.seldom(13, first=1)
def test_every_command_takes_software_for_a_backend(tmp_path: Path) -> None:
    for words in (["render", "fig35a", "--size", "32x24", "--only", "sky"], ["lesson", "triangle"]):
        out = tmp_path / f"{words[0]}.png"
        done = landscape(*words, "--backend", "software", "--out", out)
        assert (done.status, done.err) == (0, "")
        assert out.exists()


def test_cgl_is_refused_where_there_is_none_with_what_to_use_instead() -> None:
    if sys.platform == "darwin":
        pytest.skip("macOS has it")
    done = landscape("render", "fig35a", "--backend", "cgl")
    assert done.status == 3 and done.err.count("\n") == 1
    assert "only macOS has it" in done.err and "--backend auto" in done.err


@pytest.mark.seldom(3)
@pytest.mark.window
def test_a_window_opens_on_the_screen_after_none_could_be_opened_without_one() -> None:
    code = """
from framelens.gl.contexts.glfw import GLFWContext
without("OSMesa")
try:
    GLFWContext(backend="osmesa")
except NoOpenGLError:
    tell(open_context("glfw"))
"""
    if sys.platform == "win32":
        assert told(code).split()[0] == "glfw"
        return
    need_library("GL")
    with screen() as display:
        assert told(code, environment(DISPLAY=display)).split()[0] == "glfw"


# --- CGL, with a framework that EGL stands in for -----------------------------------------------


@pytest.mark.seldom(3)
@linux
@pytest.mark.parametrize("refused", [(), ("any",)])
def test_cgl_asks_for_the_legacy_profile_and_last_for_the_software_renderer(
    refused: tuple[str, ...],
) -> None:
    need_library("EGL")
    code = f"""
import fake_cgl
framework = fake_cgl.install({refused!r})
opened = open_context("cgl")
opened.release()
opened.release()
print([call[1] for call in framework.calls if call[0] == "choose"])
print([call[0] for call in framework.calls])
"""
    formats, calls = told(code).splitlines()
    any_renderer, software = [99, 0x1000, 96, 0], [99, 0x1000, 70, 0x00020400, 0]
    assert formats == str([any_renderer, software][: 1 + len(refused)])
    tail = ["choose", "create", "destroy format", "current", "current", "destroy"]
    assert calls == str(["choose"] * len(refused) + tail)


@linux
def test_cgl_asks_for_software_alone_if_the_user_does() -> None:
    need_library("EGL")
    code = """
import fake_cgl
framework = fake_cgl.install()
context.SOFTWARE_MAKERS["cgl"]().release()
print(framework.calls[0])
"""
    assert told(code) == str(("choose", [99, 0x1000, 70, 0x00020400, 0]))


@linux
def test_cgl_that_refuses_everything_ends_in_one_line() -> None:
    code = """
import fake_cgl
fake_cgl.install(("any", "software"))
try:
    open_context("cgl")
except NoOpenGLError as error:
    print(error)
"""
    assert told(code) == "CGL gave no context (CGLError 10002)"


# --- windows ------------------------------------------------------------------------------------


def test_glfw_on_macos_is_refused_outside_the_main_thread(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(glfw.sys, "platform", "darwin")
    glfw.check_thread()
    reasons = []

    def open_window() -> None:
        try:
            glfw.GLFWContext()
        except NoOpenGLError as error:
            reasons.append(str(error))

    thread = threading.Thread(target=open_window)
    thread.start()
    thread.join()
    assert len(reasons) == 1 and "in the main thread only" in reasons[0]


@linux
@pytest.mark.window
def test_another_opengl_than_that_of_glfw_is_told_in_one_line() -> None:
    need_library("OSMesa", "GL")
    code = """
from framelens.gl import binding
from framelens.gl.contexts import glfw
glfw.use_platform = lambda name, checked=None: binding.use_platform("glx", checked)
try:
    glfw.GLFWContext(backend="osmesa")
except NoOpenGLError as error:
    print(error)
"""
    assert "there are two OpenGL libraries" in told(code)


@pytest.mark.seldom(3)
@linux
@pytest.mark.window
def test_a_program_in_another_opengl_than_that_of_its_window_is_told_so(tmp_path: Path) -> None:
    need_library("OSMesa", "GL")
    path = tmp_path / "program.py"
    path.write_text(
        "import glfw\nglfw.init()\nwindow = glfw.create_window(64, 48, '', None, None)\n"
        "glfw.make_context_current(window)\n"
    )
    code = """
from framelens.program import program_context
from landscape.cli import main
from framelens.gl import binding
program_context.use_platform = lambda name, checked: binding.use_platform("glx", checked)
sys.exit(main(sys.argv[1:]))
"""
    done = python(BEGIN + code, "trace", str(path), "--backend", "osmesa")
    assert done.status == 2 and done.err.count("\n") == 1
    assert "its context has no OpenGL" in done.err and "two OpenGL libraries" in done.err


@linux
@pytest.mark.window
def test_a_missing_glut_is_told_with_the_file_that_it_is_on_this_system(tmp_path: Path) -> None:
    code = """
from framelens.program import program_glut
from landscape.cli import main
program_glut.display.problem = lambda kind, environment: ""
without("glut")
sys.exit(main(sys.argv[1:]))
"""
    done = python(BEGIN + code, "trace", str(TESTS / "programs" / "windmill.py"))
    assert done.status == 2 and done.err.count("\n") == 1
    assert f"needs GLUT: {advice.install('glut')}" in done.err
    assert "freeglut64.vc14.dll" in advice.install("glut", on="windows")


@pytest.mark.seldom(13, first=11)
@linux
@pytest.mark.window
def test_the_walk_needs_no_screen_where_egl_draws(tmp_path: Path) -> None:
    need_library("EGL")
    words = ["walk", "fig35a", "--size", "64x48", "--only", "sky", "--backend", "egl"]
    done = landscape(*words, "--frames", "2")
    assert (done.status, done.err) == (0, "")
    done = landscape(*words)
    assert done.status == 2 and "--frames" in done.err


# --- advice -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("release", "system"),
    [
        ({"ID": "debian"}, "debian"),
        ({"ID": "ubuntu", "ID_LIKE": "debian"}, "debian"),
        ({"ID": "linuxmint", "ID_LIKE": "ubuntu debian"}, "debian"),
        ({"ID": "fedora"}, "fedora"),
        ({"ID": "rocky", "ID_LIKE": "rhel centos fedora"}, "fedora"),
        ({"ID": "manjaro", "ID_LIKE": "arch"}, "arch"),
        ({"ID": "alpine"}, "alpine"),
        ({"ID": "nixos"}, "nixos"),
        ({"ID": "guix"}, "guix"),
        ({"ID": "void"}, ""),
        ({}, ""),
    ],
)
def test_a_system_is_known_by_its_name_or_its_relatives(release: dict, system: str) -> None:
    assert advice.distribution(release) == system


@pytest.mark.parametrize("system", SYSTEMS)
def test_each_system_has_advice_of_its_own(system: str) -> None:
    for backend in ("osmesa", "egl", "glfw", "cgl", "glut"):
        said = advice.install(backend, on=system)
        assert said and "\n" not in said
        assert ("Debian" in said) == (system == "debian" and backend != "cgl")
    for said in (advice.window("", {}, on=system), advice.software("Some GPU", on=system)):
        assert said and "\n" not in said
        if system in ("macos", "windows"):
            assert "DISPLAY" not in said and "xvfb" not in said


def test_the_end_of_a_loaders_message_about_the_c_library_of_conda_is_its_package() -> None:
    reason = "libstdc++.so.6: version `GLIBCXX_3.4.30' not found (required by libLLVM-15.so.1)"
    assert "libstdcxx-ng" in advice.install("egl", reason, on="conda")
