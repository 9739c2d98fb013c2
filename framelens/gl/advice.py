"""What to do where OpenGL does not work: the packages of each system, by backend and by reason.

The end of an error line: "install libegl1, ... (Debian, Ubuntu)". A system is known by
/etc/os-release, by its relatives (ID_LIKE) where it is not known itself.
"""

import os
import platform
import sys
from collections.abc import Mapping
from pathlib import Path

# OSMesa left Mesa in 25.1. The drivers of libgl1-mesa-dri are moving into mesa-libgallium, on which
# libegl-mesa0 and libglx-mesa0 depend where it exists.
GONE = "where the system still has it, or use --backend egl"
PACKAGES: dict[str, dict[str, str]] = {
    "osmesa": {
        "debian": f"libosmesa6 (Debian, Ubuntu) {GONE}",
        "fedora": f"mesa-libOSMesa (Fedora) {GONE}",
        "alpine": f"mesa-osmesa (Alpine) {GONE}",
        "conda": f"mesalib (conda-forge) {GONE}",
    },
    "egl": {
        "debian": "libegl1, libegl-mesa0, libopengl0 and, where it exists, libgl1-mesa-dri "
        "(Debian, Ubuntu)",
        "fedora": "mesa-libEGL, mesa-dri-drivers and libglvnd-opengl (Fedora)",
        "arch": "mesa and libglvnd (Arch)",
        "alpine": "mesa-egl, mesa-gl and mesa-dri-gallium (Alpine)",
        "conda": "Mesa's EGL by the system's package manager, or libegl and libopengl "
        "(conda-forge)",
    },
    "glfw": {
        "debian": "libgl1 and libglx-mesa0 (Debian, Ubuntu), and a screen or xvfb",
        "fedora": "mesa-libGL and mesa-dri-drivers (Fedora), and a screen or xorg-x11-server-Xvfb",
        "arch": "mesa and libglvnd (Arch), and a screen or xorg-server-xvfb",
        "alpine": "mesa-gl and mesa-dri-gallium (Alpine), and a screen or xvfb",
        "conda": "Mesa's libGL by the system's package manager, or libgl (conda-forge), and a "
        "screen or Xvfb",
    },
    "glut": {
        "debian": "libglut3.12 or freeglut3 (Debian, Ubuntu)",
        "fedora": "freeglut (Fedora)",
        "arch": "freeglut (Arch)",
        "alpine": "freeglut (Alpine)",
        "conda": "freeglut (conda-forge)",
    },
}
# Where packages are not installed but listed in a configuration.
CONFIGURED = {
    "nixos": "set hardware.graphics.enable = true, and have libglvnd{more} in LD_LIBRARY_PATH "
    "(NixOS)",
    "guix": "add mesa{more} to the profile, and its lib folder to LD_LIBRARY_PATH (Guix)",
}
UNKNOWN = {
    "osmesa": f"Mesa's libOSMesa.so {GONE}",
    "egl": "libEGL.so.1, libOpenGL.so.0 or libGL.so.1, and Mesa's drivers",
    "glfw": "libGL.so.1 and Mesa's drivers, and a screen or Xvfb",
    "glut": "freeglut, libglut.so.3",
}
MACOS = {
    "osmesa": "macOS has none: use --backend cgl",
    "egl": "macOS has none: use --backend cgl",
    "glfw": "windows need a session at the screen; pictures do not: --backend cgl",
    "cgl": "macOS has OpenGL itself; where it is refused, use --backend glfw at a screen",
    "glut": "macOS has GLUT itself: expected /System/Library/Frameworks/GLUT.framework",
}
WINDOWS = {
    "osmesa": "put Mesa's osmesa.dll beside python.exe, or use --backend glfw",
    "egl": "use --backend glfw",
    "glfw": "install the driver of the graphics card, or put opengl32.dll and libgallium_wgl.dll "
    "of Mesa's build for Windows beside python.exe",
    "glut": f"put freeglut{'64' if sys.maxsize > 2**32 else '32'}.vc14.dll in a folder of PATH",
}
KNOWN = ("debian", "fedora", "arch", "alpine", "nixos", "guix")
RELATIVES = {"ubuntu": "debian", "rhel": "fedora", "centos": "fedora"}


def system() -> str:
    """Return the system: windows, macos, conda, one of KNOWN, or "" for another Linux."""
    if sys.platform == "win32":
        return "windows"
    if sys.platform == "darwin":
        return "macos"
    if Path(sys.prefix, "conda-meta").is_dir():
        return "conda"
    try:
        return distribution(platform.freedesktop_os_release())
    except OSError:
        return ""


def distribution(release: Mapping[str, str]) -> str:
    """Return which of KNOWN an /etc/os-release describes, or ""."""
    names = [release.get("ID", ""), *release.get("ID_LIKE", "").split()]
    names = [RELATIVES.get(name, name) for name in names]
    return next((name for name in names if name in KNOWN), "")


def install(backend: str, reason: str = "", on: str | None = None) -> str:
    """Return what to do so that a backend, or "glut", works; ``reason`` is the loader's.

    ``on`` is the system, by default this one.
    """
    on = system() if on is None else on
    if on == "macos":
        return MACOS[backend]
    if backend == "cgl":
        return "only macOS has it; use --backend auto"
    if on == "windows":
        return WINDOWS[backend]
    if "GLIBCXX" in reason:
        # The system's Mesa, in a Python that has loaded an older C++ library of its own.
        return "install libstdcxx-ng (conda install -c conda-forge libstdcxx-ng)"
    if on in CONFIGURED:
        return CONFIGURED[on].format(more=" and freeglut" if backend == "glut" else "")
    return f"install {PACKAGES[backend].get(on, UNKNOWN[backend])}"


def window(reason: str, environment: Mapping[str, str] = os.environ, on: str | None = None) -> str:
    """Return what to do where GLFW opens no window; ``reason``: why there is no display, or ""."""
    on = system() if on is None else on
    if on == "macos":
        return MACOS["glfw"]
    if on == "windows":
        return WINDOWS["glfw"]
    if not reason and ("DISPLAY" in environment or "WAYLAND_DISPLAY" in environment):
        return install("glfw", on=on)
    return "set DISPLAY or WAYLAND_DISPLAY, or install xvfb and use xvfb-run"


def software(renderer: str, on: str | None = None) -> str:
    """Return what to do where ``renderer`` is the only OpenGL, and not software."""
    on = system() if on is None else on
    if on == "windows":
        return (
            f"this OpenGL is {renderer}: for software, put opengl32.dll and libgallium_wgl.dll of "
            "Mesa's build for Windows beside python.exe"
        )
    return f"this OpenGL is {renderer}: for software, {install('egl', on=on)}"
