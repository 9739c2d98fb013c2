"""Contexts behind one interface, and the choice among them.

A context belongs to the thread that opened it, and knows the calls that its display lists were
compiled from (see calls.py). Each way to one is a module of contexts/. It opens the context by the
library's own functions, and binds PyOpenGL only then: so one that fails leaves the others possible.
"""

import sys
from collections.abc import Callable, Mapping
from typing import Protocol

from framelens.base.errors import NoOpenGLError
from framelens.gl.contexts.cgl import CGLContext
from framelens.gl.contexts.egl import EGLContext
from framelens.gl.contexts.glfw import GLFWContext
from framelens.gl.contexts.osmesa import OSMesaContext, asked_driver
from framelens.gl.seam import Lists


class Context(Protocol):
    """The interface of a backend; ``release`` may be called twice. ``lists`` belong to calls.py."""

    backend: str
    lists: Lists

    def make_current(self) -> None:
        """Direct this thread's GL calls here."""

    def resize(self, size: tuple[int, int]) -> None:
        """Give the default framebuffer another size, in pixels, and make the context current."""

    def release(self) -> None:
        """Destroy the context and what it draws to."""


MAKERS: dict[str, Callable[[], Context]] = {
    "osmesa": OSMesaContext,
    "egl": EGLContext,
    "glfw": GLFWContext,
    "cgl": CGLContext,
}
SOFTWARE_MAKERS: dict[str, Callable[[], Context]] = {
    "osmesa": OSMesaContext,
    "egl": lambda: EGLContext(software=True),
    "glfw": lambda: GLFWContext(backend="software"),
    "cgl": lambda: CGLContext(software=True),
}
# What `auto` tries, in this order, on each system. On macOS a context without a window comes first:
# it needs neither the main thread nor a window server, and loads no Cocoa, after which a process
# may not fork. On Windows, EGL is rarely more than what a browser has brought for its own use.
ORDER = {"darwin": ("cgl", "glfw", "osmesa", "egl"), "win32": ("osmesa", "glfw", "egl")}
BACKENDS = ORDER.get(sys.platform, ("osmesa", "egl", "glfw"))
# Where no backend works, the reason of this one is told: every user of the system can install it.
TOLD = {"darwin": "cgl", "win32": "glfw"}.get(sys.platform, "egl")


def open_context(backend: str = "auto") -> Context:
    """Open a context to draw stills in; ``auto`` takes the first of BACKENDS that works.

    ``software`` takes the first that draws by software. Raises NoOpenGLError that says what to
    install.
    """
    if backend == "auto":
        return _first({name: MAKERS[name] for name in BACKENDS})
    if backend == "software":
        return _first({name: SOFTWARE_MAKERS[name] for name in BACKENDS})
    return MAKERS[backend]()


def _first(makers: Mapping[str, Callable[[], Context]]) -> Context:
    """Return the first context that can be opened; NoOpenGLError with the reason of TOLD.

    With that of OSMesa where the environment asks for a driver.
    """
    # Not the errors: they hold the callers' frames, and what is in them, until the next collection.
    reasons: dict[str, str] = {}
    for name, make in makers.items():
        try:
            return make()
        except NoOpenGLError as error:
            reasons[name] = str(error)
    raise NoOpenGLError(reasons["osmesa" if asked_driver() and "osmesa" in reasons else TOLD])
