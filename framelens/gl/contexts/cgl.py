"""CGL: a context on macOS with no window, no Cocoa and no window server, in any thread.

GLFW asks for an accelerated renderer, which a machine over ssh or in a CI may not have. Here
nothing is asked for but the legacy profile, OpenGL 2.1 with the fixed functions: macOS then gives
the best renderer that there is. Apple's software renderer is named as the last resort, or first.
There is no default framebuffer: pictures go to framebuffer objects. Written after Apple's
CGLTypes.h and CGLRenderers.h; what is tested is which calls are made, not what macOS makes of them.
"""

import ctypes
from functools import cache
from typing import Any

from framelens.base.errors import NoOpenGLError
from framelens.gl.binding import check_platform, use_platform
from framelens.gl.contexts.software import check_software
from framelens.gl.libraries import functions, require
from framelens.gl.seam import Lists, use_lists

PROFILE, LEGACY = 99, 0x1000  # kCGLPFAOpenGLProfile, kCGLOGLPVersion_Legacy
OFFLINE = 96  # kCGLPFAAllowOfflineRenderers: those without a screen, too
RENDERER, SOFTWARE = 70, 0x00020400  # kCGLPFARendererID, kCGLRendererGenericFloatID
BEST_FORMAT = (PROFILE, LEGACY, OFFLINE)
SOFTWARE_FORMAT = (PROFILE, LEGACY, RENDERER, SOFTWARE)

_POINTER = ctypes.c_void_p
FUNCTIONS = {
    "CGLChoosePixelFormat": (ctypes.c_int32, (_POINTER, _POINTER, _POINTER)),
    "CGLCreateContext": (ctypes.c_int32, (_POINTER, _POINTER, _POINTER)),
    "CGLDestroyContext": (ctypes.c_int32, (_POINTER,)),
    "CGLDestroyPixelFormat": (ctypes.c_int32, (_POINTER,)),
    "CGLGetCurrentContext": (_POINTER, ()),
    "CGLSetCurrentContext": (ctypes.c_int32, (_POINTER,)),
}


@cache
def library() -> Any:
    """Return CGL's functions, which are in the OpenGL framework; NoOpenGLError without it."""
    return functions(require("OpenGL", "cgl"), "OpenGL", FUNCTIONS, "cgl")


class CGLContext:
    """A context that draws to framebuffer objects only."""

    backend = "cgl"

    def __init__(self, software: bool = False) -> None:
        check_platform("native")
        self.lists: Lists = {}
        self._cgl = library()
        self._context: int | None = None
        for attributes in (SOFTWARE_FORMAT,) if software else (BEST_FORMAT, SOFTWARE_FORMAT):
            error = self._create(attributes)
            if self._context is not None:
                break
        else:
            raise NoOpenGLError("CGL gave no context (CGLError {error})", error=error)
        self.make_current()
        use_platform("native")
        if software:
            check_software(self)

    def _create(self, attributes: tuple[int, ...]) -> int:
        """Create a context of a pixel format; return CGL's error, 0 also if there is no format."""
        flat = (ctypes.c_uint32 * (len(attributes) + 1))(*attributes, 0)
        pixel_format = _POINTER()
        count = ctypes.c_int32()
        context = _POINTER()
        error = self._cgl.CGLChoosePixelFormat(
            flat, ctypes.byref(pixel_format), ctypes.byref(count)
        )
        if pixel_format.value:
            error = self._cgl.CGLCreateContext(pixel_format, None, ctypes.byref(context))
            self._cgl.CGLDestroyPixelFormat(pixel_format)
            self._context = context.value
        return int(error)

    def make_current(self) -> None:
        """Direct this thread's GL calls here."""
        if self._cgl.CGLSetCurrentContext(self._context):
            raise NoOpenGLError("CGL refused to make its context current")
        use_lists(self.lists)

    def resize(self, size: tuple[int, int]) -> None:
        """Refuse: there is none. Every OpenGL of macOS has framebuffer objects."""
        raise NoOpenGLError("a context of CGL draws into framebuffer objects only")

    def leave(self) -> None:
        """Have no context of CGL current."""
        self._cgl.CGLSetCurrentContext(None)

    def release(self) -> None:
        """Destroy the context."""
        if self._context is not None:
            self.leave()
            self._cgl.CGLDestroyContext(self._context)
            self._context = None
