"""OSMesa: software rendering into memory, with no screen and no device."""

import ctypes
import os
from functools import cache
from typing import Any

import numpy as np

from framelens.base.errors import NoOpenGLError
from framelens.base.isolated import Ended, isolated
from framelens.gl.binding import check_platform, use_platform
from framelens.gl.libraries import functions, require
from framelens.gl.raw import raw
from framelens.gl.seam import Lists, use_lists

RGBA, UNSIGNED_BYTE = 0x1908, 0x1401
_POINTER, _INT = ctypes.c_void_p, ctypes.c_int
FUNCTIONS = {
    "OSMesaCreateContextExt": (_POINTER, (ctypes.c_uint, _INT, _INT, _INT, _POINTER)),
    "OSMesaMakeCurrent": (ctypes.c_ubyte, (_POINTER, _POINTER, ctypes.c_uint, _INT, _INT)),
    "OSMesaGetCurrentContext": (_POINTER, ()),
    "OSMesaDestroyContext": (None, (_POINTER,)),
    "OSMesaGetProcAddress": (_POINTER, (ctypes.c_char_p,)),
}


# The environment variable by which Mesa chooses a driver, and those that every OSMesa may have.
DRIVER = "GALLIUM_DRIVER"
DRIVERS = ("", "llvmpipe", "softpipe")
PATIENCE = 20.0  # seconds, chosen: to try a driver


@cache
def library() -> Any:
    """Return OSMesa's functions; NoOpenGLError if there are none, not all, or not the driver."""
    _check_driver()
    return _library()


def _library() -> Any:
    return functions(require("OSMesa", "osmesa"), "OSMesa", FUNCTIONS, "osmesa")


def asked_driver() -> str:
    """Return the driver that the environment asks for, if OSMesa may not have it; else ""."""
    name = os.environ.get(DRIVER, "")
    return "" if name in DRIVERS else name


def _check_driver() -> None:
    """Raise NoOpenGLError where Mesa would crash: it does so if it lacks the driver it is told."""
    if name := asked_driver():
        try:
            isolated(_try, seconds=PATIENCE)
        except Ended:
            raise NoOpenGLError(
                "OSMesa has no driver {name}: unset {variable}, or set it to {drivers}",
                name=name,
                variable=DRIVER,
                drivers=" or ".join(filter(None, DRIVERS)),
            ) from None


def _try() -> None:
    """Open a context, in a process that may crash."""
    _library().OSMesaCreateContextExt(RGBA, 24, 8, 0, None)


def leave() -> None:
    """Have no context of OSMesa current: GLFW only forgets one that is no longer current."""
    library().OSMesaMakeCurrent(None, None, UNSIGNED_BYTE, 0, 0)


def finish_drawing(context: Any, current: Any) -> None:
    """Draw what still waits in a context that is about to be destroyed, if it is current.

    OSMesa crashes when it is destroyed between a glBitmap and the drawing of the bitmap.
    """
    addresses = [ctypes.cast(each, ctypes.c_void_p).value for each in (context, current)]
    if addresses[0] == addresses[1]:
        raw.glFlush()


class OSMesaContext:
    """A context with an image of its own, which stills leave alone if they can."""

    backend = "osmesa"

    def __init__(self) -> None:
        check_platform("osmesa")
        self.lists: Lists = {}
        self._osmesa = library()
        self._image = np.zeros((16, 16, 4), np.uint8)
        self._context = self._osmesa.OSMesaCreateContextExt(RGBA, 24, 8, 0, None)
        if not self._context:
            raise NoOpenGLError("OSMesa gave no context with a 24-bit depth buffer")
        self.make_current()
        use_platform("osmesa")

    def make_current(self) -> None:
        """Direct this thread's GL calls here."""
        height, width = self._image.shape[:2]
        image = self._image.ctypes.data, UNSIGNED_BYTE, width, height
        if not self._osmesa.OSMesaMakeCurrent(self._context, *image):
            raise NoOpenGLError("OSMesa refused to make its context current")
        use_lists(self.lists)

    def resize(self, size: tuple[int, int]) -> None:
        """Give the image another size, in pixels, and make the context current."""
        before, self._image = self._image, np.zeros((size[1], size[0], 4), np.uint8)
        self.make_current()
        del before  # not earlier: until then it was drawn to

    def release(self) -> None:
        """Destroy the context; its image must outlive it."""
        if self._context:
            finish_drawing(self._context, self._osmesa.OSMesaGetCurrentContext())
            self._osmesa.OSMesaDestroyContext(self._context)
            self._context = None
