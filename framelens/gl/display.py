"""Which display there is to open a window on: an X server, a Wayland compositor, or none.

The Python package glfw holds two libraries on Linux, one for X11 and one for Wayland, and loads the
one that XDG_SESSION_TYPE names. That variable describes the login, not the terminal: it is "tty"
in a compositor started by hand, and may be "wayland" where only an X server can be reached. So the
displays themselves are asked, before glfw is imported, by connecting to them.
"""

import ctypes
import functools
import importlib.util
import os
import socket
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from framelens.base.errors import NoOpenGLError
from framelens.gl import advice

# What GLFW loads at run time, without which it opens no window there, and the packages of Debian
# and Ubuntu that have it.
LIBRARIES = {
    "x11": {"libX11.so.6": "libx11-6"},
    "wayland": {
        "libwayland-client.so.0": "libwayland-client0",
        "libwayland-cursor.so.0": "libwayland-cursor0",
        "libwayland-egl.so.1": "libwayland-egl1",
        "libxkbcommon.so.0": "libxkbcommon0",
        "libEGL.so.1": "libegl1",
    },
}
# Read by the package glfw when it is imported.
CHOICE, LIBRARY = "PYGLFW_LIBRARY_VARIANT", "PYGLFW_LIBRARY"


def problem(kind: str, environment: Mapping[str, str]) -> str:
    """Return why no window can be opened on "x11" or "wayland"; "" if one can."""
    if kind == "x11" and not environment.get("DISPLAY"):
        return "DISPLAY is not set"
    if kind == "wayland":
        path = _wayland_socket(environment)
        if path is None:
            return "XDG_RUNTIME_DIR, where Wayland has its socket, is not set"
        if not _reaches(path):
            return f"no Wayland compositor at {path}"
    missing = {name: package for name, package in LIBRARIES[kind].items() if not _loads(name)}
    if missing:
        display = "DISPLAY" if kind == "x11" else "the Wayland compositor"
        if advice.system() == "debian":
            return f"{display} needs the packages {', '.join(missing.values())} (Debian, Ubuntu)"
        return f"{display} needs {', '.join(missing)}"
    if kind == "x11" and not _x_answers(environment["DISPLAY"]):
        return f"no X server at DISPLAY={environment['DISPLAY']}"
    return ""


def choose(environment: Mapping[str, str]) -> tuple[str, str]:
    """Return the kind of display to open a window on, and "", or "" and why there is none.

    Wayland comes first where XDG_SESSION_TYPE says so, X11 otherwise; the other is taken if that
    one cannot be reached.
    """
    kinds = ["x11", "wayland"]
    if environment.get("XDG_SESSION_TYPE") == "wayland":
        kinds.reverse()
    reasons = []
    for kind in kinds:
        reason = problem(kind, environment)
        if not reason:
            return kind, ""
        reasons.append(reason)
    return "", ", and ".join(reasons)


def import_glfw() -> Any:
    """Import the package glfw with its library for the display there is; NoOpenGLError without it.

    A choice that the user made with the package's own variables is left alone.
    """
    own = {CHOICE, LIBRARY} & os.environ.keys()
    given: dict[str, str] = {}
    if not own and sys.platform == "linux" and "glfw" not in sys.modules:
        given = _choice(choose(os.environ)[0])
    os.environ.update(given)
    try:
        import glfw
    except ImportError as error:
        raise NoOpenGLError(
            "GLFW cannot be loaded ({error}): install the Python package glfw", error=error
        ) from None
    finally:
        for name in given:
            # A program started from here may have another display.
            del os.environ[name]
    return glfw


def _choice(kind: str) -> dict[str, str]:
    """Return the variables by which glfw takes its library for "x11", "wayland" or ""; {} for "".

    The library is named where the package has it inside: to look for others, it starts a Python
    for each, to ask it for its version.
    """
    found = importlib.util.find_spec("glfw")
    inside = found.submodule_search_locations if kind and found is not None else None
    library = Path(inside[0], kind, "libglfw.so") if inside else None
    if library is not None and library.is_file():
        return {LIBRARY: str(library)}
    return {CHOICE: kind} if kind else {}


def _wayland_socket(environment: Mapping[str, str]) -> Path | None:
    """Return the socket that libwayland connects to; "wayland-0" is its default."""
    path = Path(environment.get("XDG_RUNTIME_DIR", ""), environment.get("WAYLAND_DISPLAY", ""))
    path = path if environment.get("WAYLAND_DISPLAY") else path / "wayland-0"
    return path if path.is_absolute() else None


def _reaches(path: Path) -> bool:
    """Return whether somebody listens at a socket, of a kind that Windows lacks in Python."""
    if sys.platform == "win32":
        return False
    try:
        with socket.socket(socket.AF_UNIX) as tried:
            tried.connect(os.fspath(path))
    except (OSError, ValueError):
        return False
    return True


def _loads(library: str) -> bool:
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


@functools.cache
def _x_answers(name: str) -> bool:
    """Return whether the X server of a display accepts a connection.

    The connection stays open: a server such as Xvfb resets itself when its last client leaves, and
    for a moment takes no other.
    """
    x11 = ctypes.CDLL("libX11.so.6")
    x11.XOpenDisplay.restype = ctypes.c_void_p
    return bool(x11.XOpenDisplay(os.fsencode(name)))
