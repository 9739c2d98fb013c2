"""Contexts behind one interface: OSMesa, EGL with no window, a GLFW window, GLFW's null platform.

PyOpenGL binds to one platform for the life of a process, and the platform must be chosen before
PyOpenGL is first imported: :func:`open_context` does both. A context belongs to the thread that
opened it, and knows the calls that its display lists were compiled from (see calls.py).
"""

import ctypes
import ctypes.util
import os
import sys
from collections.abc import Callable
from functools import cache
from typing import Any, Protocol

from landscape.errors import NoOpenGLError
from landscape.gl import display
from landscape.gl.calls import Lists, use_lists
from landscape.gl.raw import raw

BACKENDS = ("osmesa", "egl", "glfw")

# OSMesa left Mesa in 25.1. The drivers of libgl1-mesa-dri are moving into mesa-libgallium, on which
# libegl-mesa0 and libglx-mesa0 depend where it exists.
PACKAGES = {
    "osmesa": "libosmesa6 (Debian, Ubuntu) or mesa-libOSMesa (Fedora) where the system still has "
    "it, or use --backend egl",
    "egl": "libegl1, libegl-mesa0 and, where it exists, libgl1-mesa-dri (Debian, Ubuntu) or "
    "mesa-libEGL (Fedora)",
    "glfw": "libgl1 and libglx-mesa0 (Debian, Ubuntu), and a screen or Xvfb",
}


class Context(Protocol):
    """What every backend offers; ``release`` may be called twice. ``lists`` belong to calls.py."""

    backend: str
    lists: Lists

    def make_current(self) -> None:
        """Direct this thread's GL calls here."""

    def release(self) -> None:
        """Destroy the context and what it draws to."""


_platform: str | None = None


def use_platform(name: str, checked: bool | None = None) -> None:
    """Bind PyOpenGL to ``osmesa``, ``egl``, ``glx`` or ``wayland``, once for the process.

    Checking for errors after each call costs more than most calls do, so it is done only if the
    environment has LANDSCAPE_GL_CHECKS=1, as in the tests; then PyOpenGL also raises an error where
    it would silently copy an array. A program that is not ours is given what it expects: with
    ``checked``, errors raise exceptions and copies do not.
    """
    global _platform
    if _platform is not None:
        if _platform != name:
            raise NoOpenGLError(
                f"OpenGL runs on {_platform} in this process and cannot change to {name}"
            )
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
            # PyOpenGL stores arrays by the current context. Without this type every call returns a
            # new pointer object, equal to no other, so no array would ever be freed.
            platform.PLATFORM.OSMesa.OSMesaGetCurrentContext.restype = ctypes.c_void_p
        import OpenGL.GL
    except (ImportError, AttributeError, OSError, TypeError) as error:
        package = PACKAGES.get(name, PACKAGES["glfw"])
        reason = f"PyOpenGL cannot load the {name} platform ({error})"
        raise NoOpenGLError(f"{reason}: install {package}") from error
    _platform = name


@cache  # finding a library starts other programs
def require(library: str, backend: str) -> None:
    """Load a system library before PyOpenGL binds to it; NoOpenGLError if that fails."""
    path = ctypes.util.find_library(library)
    try:
        if path:
            ctypes.CDLL(path)
            return
        reason = "none found"
    except OSError as error:
        reason = str(error)
    raise NoOpenGLError(f"no {library} library ({reason}): install {PACKAGES[backend]}")


def finish_drawing(context: Any, current: Any) -> None:
    """Draw what still waits in a context that is about to be destroyed, if it is current.

    OSMesa crashes when it is destroyed between a glBitmap and the drawing of the bitmap.
    """
    addresses = [ctypes.cast(each, ctypes.c_void_p).value for each in (context, current)]
    if addresses[0] == addresses[1]:
        raw.glFlush()


class OSMesaContext:
    """Software rendering into memory; needs no screen and no device."""

    backend = "osmesa"

    def __init__(self) -> None:
        require("OSMesa", "osmesa")
        use_platform("osmesa")
        import numpy as np
        from OpenGL import osmesa

        self.lists: Lists = {}
        self._osmesa: Any = osmesa
        self._buffer: Any = np.zeros((16, 16, 4), np.uint8)
        self._context: Any = osmesa.OSMesaCreateContextExt(osmesa.OSMESA_RGBA, 24, 8, 0, None)
        if not self._context:
            raise NoOpenGLError("OSMesa gave no context with a 24-bit depth buffer")
        self.make_current()

    def make_current(self) -> None:
        """Direct this thread's GL calls here."""
        from OpenGL.GL import GL_UNSIGNED_BYTE

        ok = self._osmesa.OSMesaMakeCurrent(self._context, self._buffer, GL_UNSIGNED_BYTE, 16, 16)
        if not ok:
            raise NoOpenGLError("OSMesa refused to make its context current")
        use_lists(self.lists)

    def release(self) -> None:
        """Destroy the context; its buffer must outlive it."""
        if self._context:
            finish_drawing(self._context, self._osmesa.OSMesaGetCurrentContext())
            self._osmesa.OSMesaDestroyContext(self._context)
            self._context = None


class EGLContext:
    """EGL with no window system: Mesa's surfaceless platform, else the default display."""

    backend = "egl"
    SURFACELESS_MESA = 0x31DD

    def __init__(self, size: tuple[int, int] = (16, 16)) -> None:
        """Open the context; ``size`` in pixels is that of its default framebuffer."""
        require("EGL", "egl")
        use_platform("egl")
        # With error checking off, PyOpenGL 3.1.10 never defines the name its EGL module imports.
        import OpenGL.raw.EGL._errors as errors_module

        errors_module.__dict__.setdefault("_error_checker", None)
        from OpenGL import EGL

        self.lists: Lists = {}
        self.size = size
        self._egl: Any = EGL
        self._context: Any = None
        errors = []
        for open_display in (self._surfaceless, self._default):
            try:
                self._display = open_display()
                self._create()
                return
            except Exception as error:
                errors.append(str(error).splitlines()[0] if str(error) else type(error).__name__)
        raise NoOpenGLError(f"EGL gave no OpenGL context: install {PACKAGES['egl']} ({errors[0]})")

    def _surfaceless(self) -> Any:
        from OpenGL.EGL.EXT.platform_base import eglGetPlatformDisplayEXT

        return eglGetPlatformDisplayEXT(self.SURFACELESS_MESA, None, None)

    def _default(self) -> Any:
        return self._egl.eglGetDisplay(self._egl.EGL_DEFAULT_DISPLAY)

    def _create(self) -> None:
        egl = self._egl
        major, minor = egl.EGLint(), egl.EGLint()
        if not egl.eglInitialize(self._display, major, minor):
            raise NoOpenGLError("eglInitialize failed")
        egl.eglBindAPI(egl.EGL_OPENGL_API)
        wanted = {
            egl.EGL_SURFACE_TYPE: egl.EGL_PBUFFER_BIT,
            egl.EGL_RENDERABLE_TYPE: egl.EGL_OPENGL_BIT,
            egl.EGL_RED_SIZE: 8,
            egl.EGL_DEPTH_SIZE: 24,
            egl.EGL_STENCIL_SIZE: 8,
        }
        flat = [int(v) for pair in wanted.items() for v in pair] + [int(egl.EGL_NONE)]
        configs, count = (egl.EGLConfig * 64)(), egl.EGLint()
        egl.eglChooseConfig(
            self._display, (egl.EGLint * len(flat))(*flat), configs, 64, ctypes.byref(count)
        )
        if not count.value:
            raise NoOpenGLError("EGL has no configuration with OpenGL and a 24-bit depth buffer")
        # EGL puts configurations of 10 bits first, whose colours are not those of other backends.
        self._config = max(configs[: count.value], key=self._like_others)
        self._surface = self._buffer()
        self._context = egl.eglCreateContext(
            self._display, self._config, egl.EGL_NO_CONTEXT, (egl.EGLint * 1)(int(egl.EGL_NONE))
        )
        if not self._context:
            self._context = None
            raise NoOpenGLError("eglCreateContext failed")
        self.make_current()

    def _like_others(self, config: Any) -> tuple[bool, bool]:
        """Return whether a configuration has 8 bits of red, and of alpha."""
        egl, bits = self._egl, self._egl.EGLint()
        found = []
        for channel in (egl.EGL_RED_SIZE, egl.EGL_ALPHA_SIZE):
            egl.eglGetConfigAttrib(self._display, config, channel, ctypes.byref(bits))
            found.append(bits.value == 8)
        return found[0], found[1]

    def _buffer(self) -> Any:
        egl, (width, height) = self._egl, self.size
        wanted = (egl.EGLint * 5)(egl.EGL_WIDTH, width, egl.EGL_HEIGHT, height, egl.EGL_NONE)
        return egl.eglCreatePbufferSurface(self._display, self._config, wanted)

    def resize(self, size: tuple[int, int]) -> None:
        """Give the default framebuffer another size, in pixels, and make the context current."""
        self.size, before = size, self._surface
        self._surface = self._buffer()
        self.make_current()
        self._egl.eglDestroySurface(self._display, before)

    def make_current(self) -> None:
        """Direct this thread's GL calls here."""
        ok = self._egl.eglMakeCurrent(self._display, self._surface, self._surface, self._context)
        if not ok:
            raise NoOpenGLError("EGL refused to make its context current")
        use_lists(self.lists)

    def leave(self) -> None:
        """Have no context of EGL current."""
        none = self._egl.EGL_NO_SURFACE
        self._egl.eglMakeCurrent(self._display, none, none, self._egl.EGL_NO_CONTEXT)

    def release(self) -> None:
        """Destroy the context and its pbuffer."""
        if self._context is not None:
            self.leave()
            self._egl.eglDestroyContext(self._display, self._context)
            self._egl.eglDestroySurface(self._display, self._surface)
            self._context = None


class GLFWContext:
    """A GLFW window: visible for the walk, hidden for stills, or on GLFW's null platform.

    With ``headless`` there is no window system at all and OSMesa draws: the window code runs as it
    does on a screen.
    """

    backend = "glfw"
    _windows = 0  # how many are open: terminating GLFW destroys them all

    def __init__(
        self,
        size: tuple[int, int] = (64, 64),
        title: str = "landscape",
        visible: bool = False,
        fullscreen: bool = False,
        headless: bool = False,
        enlarged: bool = False,
        checked: bool | None = None,
        monitor: int = 1,
    ) -> None:
        """Open the window; with ``enlarged`` it is as many times larger as the display is finer.

        ``self.size`` is its size when it is not full-screen, ``monitor`` the number of its screen,
        from 1, when it is. ``checked`` is as for :func:`use_platform`.
        """
        from landscape.gl.glfw_library import glfw

        self.lists: Lists = {}
        self.glfw: Any = glfw
        self.window: Any = None
        glfw.ERROR_REPORTING = "ignore"
        if headless:
            glfw.init_hint(glfw.PLATFORM, glfw.PLATFORM_NULL)
        if not glfw.init():
            why = display.choose(os.environ)[1] or self._reason()
            raise NoOpenGLError(
                f"GLFW found no screen ({why}): set DISPLAY or WAYLAND_DISPLAY, or install xvfb "
                "and use xvfb-run"
            )
        if headless:
            use_platform("osmesa")
            glfw.window_hint(glfw.CONTEXT_CREATION_API, glfw.OSMESA_CONTEXT_API)
        else:
            if sys.platform == "linux":
                require("GL", "glfw")
            wayland = glfw.get_platform() == glfw.PLATFORM_WAYLAND
            kind = "wayland" if wayland else "glx" if sys.platform == "linux" else "native"
            use_platform(kind, checked)
        glfw.window_hint(glfw.VISIBLE, visible)
        glfw.window_hint(glfw.DEPTH_BITS, 24)
        glfw.window_hint(glfw.STENCIL_BITS, 8)
        glfw.window_hint(glfw.CONTEXT_VERSION_MAJOR, 1)
        glfw.window_hint(glfw.CONTEXT_VERSION_MINOR, 5)
        self.size = size = self._enlarged(size) if enlarged else size
        screens = glfw.get_monitors() if fullscreen else []
        screen = screens[min(max(monitor, 1), len(screens)) - 1] if screens else None
        if screen is not None:
            mode = glfw.get_video_mode(screen)
            size = (mode.size.width, mode.size.height)
        self.window = glfw.create_window(*size, title, screen, None)
        if not self.window:
            reason = self._reason()
            self._terminate()
            raise NoOpenGLError(f"GLFW opened no window ({reason}): install {PACKAGES['glfw']}")
        GLFWContext._windows += 1
        self.make_current()

    def _enlarged(self, size: tuple[int, int]) -> tuple[int, int]:
        """Return a size in the window system's coordinates, times the display's content scale.

        Where those coordinates are finer than its pixels already (Wayland, macOS) it stays.
        """
        glfw = self.glfw
        monitor = glfw.get_primary_monitor()
        if not monitor or glfw.get_platform() in (glfw.PLATFORM_WAYLAND, glfw.PLATFORM_COCOA):
            return size
        scale = max(glfw.get_monitor_content_scale(monitor))
        room = glfw.get_monitor_workarea(monitor)[2:]
        scale = max(1.0, min(scale, *(a / b for a, b in zip(room, size, strict=True))))
        return round(size[0] * scale), round(size[1] * scale)

    def _reason(self) -> str:
        code, text = self.glfw.get_error()
        return text.decode() if isinstance(text, bytes) else str(text or code)

    def make_current(self) -> None:
        """Direct this thread's GL calls here."""
        self.glfw.make_context_current(self.window)
        use_lists(self.lists)

    def pixels(self) -> tuple[int, int]:
        """Return the size of what is drawn to, in pixels."""
        size: tuple[int, int] = self.glfw.get_framebuffer_size(self.window)
        return size

    def cursor(self) -> tuple[tuple[float, float], tuple[int, int]]:
        """Return where the cursor is in the picture, and the picture's size, in coordinates."""
        return self.glfw.get_cursor_pos(self.window), self.glfw.get_window_size(self.window)

    def scale(self) -> float:
        """Return how many pixels one of the window system's coordinates is."""
        return self.pixels()[0] / max(self.cursor()[1][0], 1)

    def show(self) -> None:
        """Show what was drawn."""
        self.glfw.swap_buffers(self.window)

    def release(self) -> None:
        """Close the window, and GLFW if it was the last."""
        if self.window:
            finish_drawing(self.window, self.glfw.get_current_context())
            self.glfw.destroy_window(self.window)
            self.window = None
            GLFWContext._windows -= 1
            self._terminate()

    def _terminate(self) -> None:
        if GLFWContext._windows == 0:
            self.glfw.terminate()


def open_context(backend: str = "auto") -> Context:
    """Open a context to draw stills in; ``auto`` takes the first of OSMesa, EGL, GLFW that works.

    Raises NoOpenGLError that names the package to install.
    """
    makers: dict[str, Callable[[], Context]] = {
        "osmesa": OSMesaContext,
        "egl": EGLContext,
        "glfw": GLFWContext,
    }
    if backend != "auto":
        return makers[backend]()
    # Not the errors: they hold the callers' frames, and what is in them, until the next collection.
    reasons: dict[str, str] = {}
    for name in BACKENDS:
        try:
            return makers[name]()
        except NoOpenGLError as error:
            reasons[name] = str(error)
    # EGL is the one that every system has packages for.
    raise NoOpenGLError(reasons["egl"])
