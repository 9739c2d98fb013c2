"""GLFW windows: visible for the walk, hidden for stills, or on GLFW's null platform."""

import os
import sys
import threading
from collections.abc import Callable, Iterable
from types import ModuleType, SimpleNamespace
from typing import Any

from framelens.base.errors import Message, NoOpenGLError
from framelens.gl import advice, display
from framelens.gl.binding import use_platform
from framelens.gl.contexts import osmesa
from framelens.gl.contexts.egl import EGLContext
from framelens.gl.contexts.osmesa import finish_drawing
from framelens.gl.contexts.software import ask_for_software, check_software
from framelens.gl.libraries import require
from framelens.gl.raw import raw
from framelens.gl.seam import Lists, use_lists

HEADLESS = ("osmesa", "egl")  # what draws where there is no window system
VERSION = 0x1F02  # GL_VERSION


def check_thread() -> None:
    """Raise NoOpenGLError where GLFW would crash: macOS has windows in the main thread only."""
    if sys.platform == "darwin" and threading.current_thread() is not threading.main_thread():
        raise NoOpenGLError(
            "GLFW works on macOS in the main thread only: open the context there, or use the "
            "backend cgl"
        )


def check_library() -> None:
    """Raise NoOpenGLError if PyOpenGL draws by another library than the one with the context.

    On Windows PyOpenGL takes the first opengl32.dll in PATH, as Conda has one, and GLFW the
    system's.
    """
    if raw.glGetString(VERSION) is None:
        raise NoOpenGLError("{why}", why=no_context())


def no_context() -> Message:
    """Return why PyOpenGL sees no context where one was made current, and what to do."""
    from OpenGL.platform import PLATFORM

    name = getattr(PLATFORM.GL, "_name", None) or Message("the OpenGL library of PyOpenGL")
    return Message(
        "{name} has no context where one is open: there are two OpenGL libraries; take the folder "
        "of this one out of PATH",
        name=name,
    )


class GLFWContext:
    """A window and its context.

    The backends auto, glfw and software open it on a screen, the last drawn by software. With
    osmesa, egl or headless, the first of these two that works, there is no window system at all:
    the window code runs on GLFW's null platform as it does on a screen.
    """

    backend = "glfw"
    _windows = 0  # how many are open: terminating GLFW destroys them all

    def __init__(
        self,
        size: tuple[int, int] = (64, 64),
        title: str = "landscape",
        visible: bool = False,
        fullscreen: bool = False,
        backend: str = "auto",
        enlarged: bool = False,
        checked: bool | None = None,
        monitor: int = 1,
    ) -> None:
        """Open the window; with ``enlarged`` it is as many times larger as the display is finer.

        ``self.size`` is its size when it is not full-screen, ``monitor`` the number of its screen,
        from 1, when it is. ``checked`` is as for :func:`framelens.gl.binding.use_platform`.
        """
        check_thread()
        if backend == "software":
            ask_for_software()
        from framelens.gl.glfw_library import glfw

        self.lists: Lists = {}
        self.glfw: Any = glfw
        self.window: object = None
        self._egl: EGLContext | None = None
        glfw.ERROR_REPORTING = "ignore"
        drawn_by = HEADLESS if backend == "headless" else {backend}.intersection(HEADLESS)
        # The hint outlasts GLFW's end: an earlier window may have had no window system.
        glfw.init_hint(glfw.PLATFORM, glfw.PLATFORM_NULL if drawn_by else glfw.ANY_PLATFORM)
        if not glfw.init():
            reason = display.choose(os.environ)[1] if sys.platform == "linux" else ""
            said = reason or self._reason()
            raise NoOpenGLError(
                "GLFW found no screen ({said}): {window}", said=said, window=advice.window(reason)
            )
        if drawn_by:
            self._draw_headless(drawn_by, size)
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
        glfw.window_hint(glfw.CONTEXT_VERSION_MINOR, 1)
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
            raise NoOpenGLError(
                "GLFW opened no window ({reason}): {window}",
                reason=reason,
                window=advice.window(""),
            )
        GLFWContext._windows += 1
        self.make_current()
        check_library()
        if backend == "software":
            check_software(self)

    def _draw_headless(self, backends: Iterable[str], size: tuple[int, int]) -> None:
        """Choose what draws where there is no window system; NoOpenGLError if nothing does."""
        glfw, reasons = self.glfw, []
        for backend in backends:
            try:
                if backend == "egl":
                    self._egl = EGLContext(size)
                    glfw.window_hint(glfw.CLIENT_API, glfw.NO_API)
                else:
                    osmesa.library()
                    use_platform("osmesa")
                    glfw.window_hint(glfw.CONTEXT_CREATION_API, glfw.OSMESA_CONTEXT_API)
                return
            except NoOpenGLError as error:
                reasons.append(str(error))
        self._terminate()
        raise NoOpenGLError(reasons[-1])

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
        if self._egl is not None:
            self._egl.make_current()
        else:
            self.glfw.make_context_current(self.window)
        use_lists(self.lists)

    def resize(self, size: tuple[int, int]) -> None:
        """Give the window another size, in pixels, and make the context current."""
        scale = self.scale()
        self.glfw.set_window_size(self.window, *(round(side / scale) for side in size))
        self.glfw.poll_events()
        self.make_current()

    def pixels(self) -> tuple[int, int]:
        """Return the size of what is drawn to, in pixels."""
        size: tuple[int, int] = self.glfw.get_framebuffer_size(self.window)
        if self._egl is not None and self._egl.size != size and 0 not in size:
            self._egl.resize(size)
        return size

    def cursor(self) -> tuple[tuple[float, float], tuple[int, int]]:
        """Return where the cursor is in the picture, and the picture's size, in coordinates."""
        return self.glfw.get_cursor_pos(self.window), self.glfw.get_window_size(self.window)

    def scale(self) -> float:
        """Return how many pixels one of the window system's coordinates is."""
        return self.pixels()[0] / max(self.cursor()[1][0], 1)

    def show(self) -> None:
        """Show what was drawn."""
        self.glfw.swap_buffers(self.window)  # without effect where EGL draws

    def release(self) -> None:
        """Close the window, and GLFW if it was the last."""
        if self.window:
            if self._egl is not None:
                self._egl.release()
            else:
                finish_drawing(self.window, self.glfw.get_current_context())
            self.glfw.destroy_window(self.window)
            self.window = None
            GLFWContext._windows -= 1
            self._terminate()

    def _terminate(self) -> None:
        if GLFWContext._windows == 0:
            self.glfw.terminate()


def call_for_pointer(
    glfw: ModuleType | SimpleNamespace,
    window: object,
    button: Callable[[int, int, int], None],
    motion: Callable[[float, float], None],
    scroll: Callable[[float, float], None],
) -> None:
    """Let functions be called for what the pointer does in a window."""
    glfw.set_mouse_button_callback(window, lambda _, *what: button(*what))
    glfw.set_cursor_pos_callback(window, lambda _, x, y: motion(x, y))
    glfw.set_scroll_callback(window, lambda _, x, y: scroll(x, y))
