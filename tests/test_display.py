"""Which display a window is opened on, whatever XDG_SESSION_TYPE says."""

import importlib.util
import os
import shutil
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from commands import end, environment, landscape

from framelens.gl import display
from framelens.gl.display import choose, problem

pytestmark = [
    pytest.mark.window,
    pytest.mark.posix_only("it has one window system, and no choice of X11 or Wayland"),
]


@pytest.fixture(scope="module")
def x_server() -> Iterator[str]:
    """The DISPLAY of an X server."""
    if shutil.which("Xvfb") is None:
        pytest.skip("Xvfb is not installed")
    read, write = os.pipe()
    command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "320x240x24", "-nolisten", "tcp"]
    server = subprocess.Popen(command, pass_fds=[write], stderr=subprocess.DEVNULL)
    os.close(write)
    try:
        with os.fdopen(read) as pipe:
            yield f":{pipe.readline().strip()}"
    finally:
        end(server)


@pytest.fixture
def compositor(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[dict[str, str]]:
    """The environment of a socket at which somebody listens, and all libraries for it."""
    monkeypatch.setattr(display, "LIBRARIES", {**display.LIBRARIES, "wayland": {}})
    with socket.socket(socket.AF_UNIX) as listening:
        listening.bind(str(tmp_path / "wayland-0"))
        listening.listen()
        yield {"XDG_RUNTIME_DIR": str(tmp_path)}


def test_an_x_server_is_used_though_the_session_is_said_to_be_wayland(
    x_server: str, tmp_path: Path
) -> None:
    for session in ("wayland", "tty", "x11"):
        said = {"XDG_SESSION_TYPE": session, "XDG_RUNTIME_DIR": str(tmp_path), "DISPLAY": x_server}
        assert choose(said) == ("x11", "")


def test_a_compositor_is_used_though_the_session_is_said_to_be_a_terminal(
    compositor: dict[str, str],
) -> None:
    for session in ("tty", "wayland"):
        assert choose({"XDG_SESSION_TYPE": session, **compositor}) == ("wayland", "")
        assert choose({"XDG_SESSION_TYPE": session, "DISPLAY": ":9999", **compositor})[0]


def test_with_both_the_session_type_decides(x_server: str, compositor: dict[str, str]) -> None:
    both = {"DISPLAY": x_server, **compositor}
    assert choose({"XDG_SESSION_TYPE": "wayland", **both}) == ("wayland", "")
    for session in ("x11", "tty"):
        assert choose({"XDG_SESSION_TYPE": session, **both}) == ("x11", "")


def test_the_reason_names_each_display_that_is_missing(tmp_path: Path) -> None:
    assert choose({}) == (
        "",
        "DISPLAY is not set, and XDG_RUNTIME_DIR, where Wayland has its socket, is not set",
    )
    gone = {"XDG_RUNTIME_DIR": str(tmp_path), "WAYLAND_DISPLAY": "wayland-7", "DISPLAY": ":9999"}
    kind, why = choose({"XDG_SESSION_TYPE": "wayland", **gone})
    assert kind == ""
    assert f"no Wayland compositor at {tmp_path}/wayland-7" in why
    assert "no X server at DISPLAY=:9999" in why
    absolute = {"WAYLAND_DISPLAY": str(tmp_path / "own")}
    assert problem("wayland", absolute) == f"no Wayland compositor at {tmp_path}/own"


def test_a_missing_library_is_named_by_its_package(
    compositor: dict[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    needed = {"libnone.so.0": "libnone0", "libc.so.6": "libc6"}
    monkeypatch.setitem(display.LIBRARIES, "wayland", needed)
    for system, wanted in (("debian", "the packages libnone0 ("), ("fedora", "libnone.so.0")):
        monkeypatch.setattr(display.advice, "system", lambda system=system: system)
        assert f"needs {wanted}" in problem("wayland", compositor)


@pytest.mark.seldom(13, first=5)
def test_the_walk_opens_a_window_on_x_in_a_session_said_to_be_wayland(
    x_server: str, tmp_path: Path
) -> None:
    said = {"XDG_SESSION_TYPE": "wayland", "XDG_RUNTIME_DIR": str(tmp_path), "DISPLAY": x_server}
    words = ["walk", "fig35a", "--size", "64x48", "--frames", "1", "--only", "sky"]
    done = landscape(*words, env=environment(**said))
    assert (done.status, done.err) == (0, "")


def test_glfw_is_taken_from_its_package_without_starting_a_program_for_it(x_server: str) -> None:
    code = (
        "import os, subprocess\n"
        "subprocess.Popen = None\n"
        "from framelens.gl.glfw_library import glfw\n"
        "print(glfw.get_version()[0], 'PYGLFW_LIBRARY' in os.environ)\n"
        "from glfw.library import glfw as library\n"
        "print(library._name)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        env=environment(DISPLAY=x_server, XDG_SESSION_TYPE="tty"),
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    version, library = done.stdout.splitlines()
    assert version == "3 False"
    inside = Path(str(importlib.util.find_spec("glfw").origin)).parent / "x11"
    if not inside.is_dir():
        pytest.skip("the package glfw has no library inside")
    assert Path(library).parent == inside


def test_the_walk_without_a_display_says_which_one_is_missing(tmp_path: Path) -> None:
    said = environment(XDG_RUNTIME_DIR=str(tmp_path), XDG_SESSION_TYPE="tty")
    done = landscape("walk", "--frames", "1", env=said)
    assert done.status == 3 and done.err.count("\n") == 1
    assert f"DISPLAY is not set, and no Wayland compositor at {tmp_path}/wayland-0" in done.err
