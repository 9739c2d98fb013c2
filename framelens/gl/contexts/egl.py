"""EGL with no window system: Mesa's surfaceless platform, the default display, or a device.

Mesa's surfaceless platform draws by the graphics card where there is one. ``software`` asks for a
device that says of itself that it is software; where none can be asked for, LIBGL_ALWAYS_SOFTWARE
has Mesa take its own. The two are never combined with a device that is hardware, as Mesa crashes.
"""

import ctypes
import os
from collections.abc import Callable, Iterator
from functools import cache, partial
from types import SimpleNamespace
from typing import Any

from framelens.base.errors import NoOpenGLError
from framelens.gl import advice, libraries
from framelens.gl.binding import check_platform, use_platform
from framelens.gl.contexts.software import check_software
from framelens.gl.libraries import functions, require
from framelens.gl.seam import Lists, use_lists

SURFACELESS_MESA, DEVICE = 0x31DD, 0x313F  # platforms
OPENGL_API = 0x30A2
EXTENSIONS = 0x3055
NONE = 0x3038
SURFACE_TYPE = 0x3033
PBUFFER_BIT = 1
RENDERABLE_TYPE = 0x3040
OPENGL_BIT = 8
RED_SIZE = 0x3024
ALPHA_SIZE = 0x3021
DEPTH_SIZE = 0x3025
STENCIL_SIZE = 0x3026
WIDTH, HEIGHT = 0x3057, 0x3056
MOST = 64  # configurations, and devices; chosen

_POINTER = ctypes.c_void_p
_INT = ctypes.c_int32
_BOOL = ctypes.c_uint
FUNCTIONS = {
    "eglBindAPI": (_BOOL, (ctypes.c_uint,)),
    "eglChooseConfig": (_BOOL, (_POINTER, _POINTER, _POINTER, _INT, _POINTER)),
    "eglCreateContext": (_POINTER, (_POINTER, _POINTER, _POINTER, _POINTER)),
    "eglCreatePbufferSurface": (_POINTER, (_POINTER, _POINTER, _POINTER)),
    "eglDestroyContext": (_BOOL, (_POINTER, _POINTER)),
    "eglDestroySurface": (_BOOL, (_POINTER, _POINTER)),
    "eglGetConfigAttrib": (_BOOL, (_POINTER, _POINTER, _INT, _POINTER)),
    "eglGetCurrentContext": (_POINTER, ()),
    "eglGetDisplay": (_POINTER, (_POINTER,)),
    "eglGetProcAddress": (_POINTER, (ctypes.c_char_p,)),
    "eglInitialize": (_BOOL, (_POINTER, _POINTER, _POINTER)),
    "eglMakeCurrent": (_BOOL, (_POINTER, _POINTER, _POINTER, _POINTER)),
}
EXTENSION_FUNCTIONS = {
    "eglGetPlatformDisplayEXT": (_POINTER, (ctypes.c_uint, _POINTER, _POINTER)),
    "eglQueryDevicesEXT": (_BOOL, (_INT, _POINTER, _POINTER)),
    "eglQueryDeviceStringEXT": (ctypes.c_char_p, (_POINTER, _INT)),
}


@cache
def library() -> Any:
    """Return EGL's functions; NoOpenGLError if there are none, or not all, or no OpenGL beside."""
    egl = functions(require("EGL", "egl"), "EGL", FUNCTIONS, "egl")
    # EGL alone has no drawing functions. Without these two PyOpenGL would take those of OpenGL ES.
    try:
        libraries.load("OpenGL")
    except OSError:
        require("GL", "egl")
    return egl


def _extensions() -> SimpleNamespace:
    """Return the functions of EXTENSION_FUNCTIONS that there are; None for the others."""
    known = {}
    for name, (result, arguments) in EXTENSION_FUNCTIONS.items():
        address = library().eglGetProcAddress(name.encode())
        known[name] = ctypes.CFUNCTYPE(result, *arguments)(address) if address else None
    return SimpleNamespace(**known)


def devices() -> list[tuple[object, bool]]:
    """Return the handle of each device, and whether it is software; none if EGL cannot say."""
    egl = _extensions()
    if not (egl.eglQueryDevicesEXT and egl.eglQueryDeviceStringEXT):
        return []
    handles, count = (ctypes.c_void_p * MOST)(), ctypes.c_int32()
    egl.eglQueryDevicesEXT(MOST, handles, ctypes.byref(count))

    def is_software(handle: object) -> bool:
        return b"EGL_MESA_device_software" in (
            egl.eglQueryDeviceStringEXT(handle, EXTENSIONS) or b""
        )

    return [(handle, is_software(handle)) for handle in handles[: count.value]]


def software_device() -> object:
    """Return the handle of a device that is software, or None."""
    return next((handle for handle, is_software in devices() if is_software), None)


class EGLContext:
    """A context with a pbuffer for its default framebuffer."""

    backend = "egl"

    def __init__(self, size: tuple[int, int] = (16, 16), software: bool = False) -> None:
        """Open the context; ``size`` in pixels is that of its default framebuffer."""
        check_platform("egl")
        self.lists: Lists = {}
        self.size = size
        self._egl = library()
        self._context: object = None
        if not self._opened(self._software_displays() if software else self._displays()):
            wanted = advice.install("egl")
            raise NoOpenGLError(
                "EGL gave no OpenGL context: {wanted} ({reason})",
                wanted=wanted,
                reason=self._reason,
            )
        use_platform("egl")
        if software:
            check_software(self)

    def _opened(self, displays: tuple[Callable[[], object], ...]) -> bool:
        """Open the context on the first display that has one."""
        self._reason = ""
        for display in displays:
            try:
                self._display = display()
                self._create()
                return True
            except NoOpenGLError as error:
                self._reason = self._reason or str(error)
        return False

    def _displays(self) -> tuple[Callable[[], object], ...]:
        return self._surfaceless, lambda: self._egl.eglGetDisplay(None), *self._hardware_devices()

    def _hardware_devices(self) -> Iterator[Callable[[], object]]:
        """Yield what opens the display of each graphics card.

        A vendor's driver without a window system may have no display but these.
        """
        for handle, is_software in devices():
            if not is_software:
                yield partial(self._platform_display, DEVICE, handle)

    def _software_displays(self) -> tuple[Callable[[], object], ...]:
        return self._software_device, self._surfaceless_software

    def _platform_display(self, platform: int, device: object = None) -> object:
        open_display = _extensions().eglGetPlatformDisplayEXT
        if open_display is None:
            raise NoOpenGLError("EGL has no eglGetPlatformDisplayEXT")
        return open_display(platform, device, None)

    def _surfaceless(self) -> object:
        return self._platform_display(SURFACELESS_MESA)

    def _software_device(self) -> object:
        device = software_device()
        if device is None:
            raise NoOpenGLError("EGL has no software device")
        return self._platform_display(DEVICE, device)

    def _surfaceless_software(self) -> object:
        os.environ["LIBGL_ALWAYS_SOFTWARE"] = "1"
        return self._surfaceless()

    def _create(self) -> None:
        egl = self._egl
        if not self._display or not egl.eglInitialize(self._display, None, None):
            raise NoOpenGLError("eglInitialize failed")
        if not egl.eglBindAPI(OPENGL_API):
            raise NoOpenGLError("EGL has no OpenGL")
        # EGL puts configurations of 10 bits first, whose colours are not those of other backends.
        self._config = max(self._configurations(), key=self._like_others)
        self._surface = self._buffer()
        none = (ctypes.c_int32 * 1)(NONE)
        self._context = egl.eglCreateContext(self._display, self._config, None, none)
        if not self._context:
            self._context = None
            raise NoOpenGLError("eglCreateContext failed")
        self.make_current()

    def _configurations(self) -> list[object]:
        """Return the configurations with OpenGL and a 24-bit depth buffer."""
        wanted = {
            SURFACE_TYPE: PBUFFER_BIT,
            RENDERABLE_TYPE: OPENGL_BIT,
            RED_SIZE: 8,
            DEPTH_SIZE: 24,
            STENCIL_SIZE: 8,
        }
        flat = [value for pair in wanted.items() for value in pair] + [NONE]
        configs, count = (ctypes.c_void_p * MOST)(), ctypes.c_int32()
        self._egl.eglChooseConfig(
            self._display, (ctypes.c_int32 * len(flat))(*flat), configs, MOST, ctypes.byref(count)
        )
        if not count.value:
            raise NoOpenGLError("EGL has no configuration with OpenGL and a 24-bit depth buffer")
        return list(configs[: count.value])

    def _like_others(self, config: object) -> tuple[bool, bool]:
        """Return whether a configuration has 8 bits of red, and of alpha."""
        return self._attribute(config, RED_SIZE) == 8, self._attribute(config, ALPHA_SIZE) == 8

    def _attribute(self, config: object, name: int) -> int:
        value = ctypes.c_int32()
        self._egl.eglGetConfigAttrib(self._display, config, name, ctypes.byref(value))
        return value.value

    def _buffer(self) -> object:
        wanted = (ctypes.c_int32 * 5)(WIDTH, self.size[0], HEIGHT, self.size[1], NONE)
        return self._egl.eglCreatePbufferSurface(self._display, self._config, wanted)

    def resize(self, size: tuple[int, int]) -> None:
        """Give the default framebuffer another size, in pixels, and make the context current."""
        self.size, before = size, self._surface
        self._surface = self._buffer()
        self.make_current()
        self._egl.eglDestroySurface(self._display, before)

    def make_current(self) -> None:
        """Direct this thread's GL calls here."""
        surface = self._surface
        if not self._egl.eglMakeCurrent(self._display, surface, surface, self._context):
            raise NoOpenGLError("EGL refused to make its context current")
        use_lists(self.lists)

    def leave(self) -> None:
        """Have no context of EGL current."""
        self._egl.eglMakeCurrent(self._display, None, None, None)

    def release(self) -> None:
        """Destroy the context and its pbuffer."""
        if self._context is not None:
            self.leave()
            self._egl.eglDestroyContext(self._display, self._context)
            self._egl.eglDestroySurface(self._display, self._surface)
            self._context = None
