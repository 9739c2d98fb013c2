"""PyOpenGL's platform: chosen once for the life of a process, before PyOpenGL is imported.

A failed choice could not be taken back. So a context is opened first, by the library's own
functions (contexts/), and PyOpenGL is bound to a library that has proved itself.
"""

import ctypes
import os

from framelens.base.errors import NoOpenGLError
from framelens.gl import advice

_platform: str | None = None


def check_platform(name: str) -> None:
    """Raise NoOpenGLError if PyOpenGL is bound to another platform."""
    if _platform not in (None, name):
        raise NoOpenGLError(
            "OpenGL runs on {platform} in this process and cannot change to {name}",
            platform=_platform,
            name=name,
        )


def use_platform(name: str, checked: bool | None = None) -> None:
    """Bind PyOpenGL to ``osmesa``, ``egl``, ``glx``, ``wayland`` or ``native``, once.

    Checking for errors after each call costs more than most calls do, so it is done only if the
    environment has LANDSCAPE_GL_CHECKS=1, as in the tests; then PyOpenGL also raises an error where
    it would silently copy an array. A program that is not ours is given what it expects: with
    ``checked``, errors raise exceptions and copies do not.
    """
    global _platform
    check_platform(name)
    if _platform is not None:
        return
    os.environ["PYOPENGL_PLATFORM"] = name
    import OpenGL

    checks = os.environ.get("LANDSCAPE_GL_CHECKS") == "1"
    OpenGL.ERROR_CHECKING = checks if checked is None else checked
    OpenGL.ERROR_ON_COPY = checks and checked is None
    OpenGL.ERROR_LOGGING = OpenGL.ERROR_DEBUG_OUTPUT = False  # the latter makes calls of its own
    try:
        from OpenGL import platform

        if name == "osmesa":
            # PyOpenGL stores arrays by the current context. Without this type every call returns
            # a new pointer object, equal to no other, so no array would ever be freed.
            platform.PLATFORM.OSMesa.OSMesaGetCurrentContext.restype = ctypes.c_void_p
        import OpenGL.GL
    except (ImportError, AttributeError, OSError, TypeError) as error:
        wanted = advice.install(name if name in ("osmesa", "egl") else "glfw", str(error))
        raise NoOpenGLError(
            "PyOpenGL cannot load the {name} platform ({error}): {wanted}",
            name=name,
            error=error,
            wanted=wanted,
        ) from error
    _platform = name
