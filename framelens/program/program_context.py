"""Which OpenGL a program draws by: chosen, and bound, before it imports PyOpenGL."""

import os
import sys

from framelens.base.errors import NoOpenGLError
from framelens.gl import advice, display
from framelens.gl.binding import use_platform
from framelens.gl.context import BACKENDS, TOLD
from framelens.gl.contexts import cgl, egl, osmesa
from framelens.gl.contexts.software import ask_for_software
from framelens.program.program_source import Source

# The library that a context without a screen needs, and PyOpenGL's name for its platform.
WITHOUT_SCREEN = {
    "osmesa": (osmesa.library, "osmesa"),
    "egl": (egl.library, "egl"),
    "cgl": (cgl.library, "native"),
}


def bind(source: Source, backend: str) -> str:
    """Bind PyOpenGL to a backend; the first that works, if it may be any or that of software.

    On Linux the libraries of GLUT and of NURBS draw by calls of libGL, which OSMesa does not see;
    that of GLUT needs a screen, too.
    """
    if backend == "software":
        ask_for_software()
    elif backend != "auto":
        prepare(backend, source.checked)
        return backend

    order = list(BACKENDS)
    if "glut" in source.modules:
        order.sort(key=lambda name: name != "glfw")
    elif "nurbs" in source.modules:
        order.sort(key=lambda name: name == "osmesa")

    reasons: dict[str, NoOpenGLError] = {}
    for name in order:
        try:
            prepare(name, source.checked)
            return name
        except NoOpenGLError as error:
            reasons[name] = error

    raise reasons[TOLD]


def prepare(backend: str, checked: bool) -> None:
    """Bind PyOpenGL to a backend; NoOpenGLError if there is none here."""
    if backend in WITHOUT_SCREEN:
        library, platform = WITHOUT_SCREEN[backend]
        library()
        use_platform(platform, checked)
        return
    kind, reason = screen()
    if not kind:
        wanted = advice.window(reason)
        raise NoOpenGLError(
            "there is no screen to open a window on ({reason}): {wanted}",
            reason=reason,
            wanted=wanted,
        )
    use_platform({"x11": "glx"}.get(kind, kind), checked)


def screen() -> tuple[str, str]:
    """Return the kind of screen: x11, wayland, native, or "" and why there is none."""
    return display.choose(os.environ) if sys.platform == "linux" else ("native", "")
