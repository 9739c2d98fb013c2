"""CGL's functions for a machine without macOS: EGL gives the contexts, with no surface.

Such a context has no default framebuffer, as one of CGL has none. Each call is noted.
"""

import ctypes
from typing import Any

NO_ERROR, BAD_PIXEL_FORMAT = 0, 10002


class Framework:
    """Stands for the OpenGL framework, loaded. ``refused`` are renderers without a pixel format."""

    def __init__(self, refused: tuple[str, ...] = ()) -> None:
        self.calls: list[tuple[str, Any]] = []
        self._refused = refused
        self._egl: Any = None
        self._display: Any = None

    def __getitem__(self, name: str) -> Any:
        method = getattr(self, name)

        def call(*args: Any) -> Any:
            return method(*args)

        return call

    def CGLChoosePixelFormat(self, attributes: Any, pixel_format: Any, count: Any) -> int:
        asked = list(attributes)
        self.calls.append(("choose", asked))
        if ("software" if 70 in asked else "any") in self._refused:
            return BAD_PIXEL_FORMAT
        pixel_format._obj.value, count._obj.value = 1, 1
        return NO_ERROR

    def CGLCreateContext(self, pixel_format: Any, shared: Any, context: Any) -> int:
        from framelens.gl.contexts import egl

        self.calls.append(("create", pixel_format.value))
        self._egl = egl.library()
        display = egl._extensions().eglGetPlatformDisplayEXT(egl.SURFACELESS_MESA, None, None)
        assert self._egl.eglInitialize(display, None, None)
        assert self._egl.eglBindAPI(egl.OPENGL_API)
        wanted = (egl.RENDERABLE_TYPE, egl.OPENGL_BIT, egl.SURFACE_TYPE, 0, egl.NONE)
        config, found = ctypes.c_void_p(), ctypes.c_int32()
        self._egl.eglChooseConfig(
            display, (ctypes.c_int32 * 5)(*wanted), ctypes.byref(config), 1, ctypes.byref(found)
        )
        none = (ctypes.c_int32 * 1)(egl.NONE)
        self._display = display
        context._obj.value = self._egl.eglCreateContext(display, config, None, none)
        return NO_ERROR

    def CGLDestroyPixelFormat(self, pixel_format: Any) -> int:
        self.calls.append(("destroy format", pixel_format.value))
        return NO_ERROR

    def CGLSetCurrentContext(self, context: Any) -> int:
        self.calls.append(("current", context is not None))
        assert self._egl.eglMakeCurrent(self._display, None, None, context)
        return NO_ERROR

    def CGLGetCurrentContext(self) -> Any:
        return self._egl.eglGetCurrentContext()

    def CGLDestroyContext(self, context: Any) -> int:
        self.calls.append(("destroy", context is not None))
        self._egl.eglDestroyContext(self._display, context)
        return NO_ERROR


def install(refused: tuple[str, ...] = ()) -> Framework:
    """Have CGLContext use this in place of macOS's framework; return it."""
    from framelens.gl.contexts import cgl
    from framelens.gl.libraries import functions

    framework = Framework(refused)
    declared = functions(framework, "OpenGL", cgl.FUNCTIONS, "cgl")  # type: ignore[arg-type]
    cgl.library = lambda: declared  # type: ignore[assignment]
    bound = cgl.use_platform
    cgl.check_platform = lambda name: None
    cgl.use_platform = lambda name, checked=None: bound("egl", checked)
    return framework
