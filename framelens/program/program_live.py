"""A window on the screen for a GLUT or pygame program that somebody uses: GLFW opens it.

The inspector listens to windows of GLFW. So a program of another toolkit is shown in one: the
toolkit's functions are replaced anyway, and what is drawn does not depend on who opened the window.
The clock stays held, frame by frame, but here waiting takes its time, and frames come no faster
than the clock says.
"""

import sys
import time
from collections.abc import Mapping

import numpy as np

from framelens.base.errors import NoOpenGLError
from framelens.gl.contexts.glfw import check_thread
from framelens.gl.named import glfw_constant
from framelens.gl.seam import unnoted
from framelens.program.program_events import KEYS
from framelens.program.program_run import Run, Window
from framelens.tape.buffers import Buffers

LONGEST = 1.0  # chosen: seconds between two frames; a clock that is further ahead has jumped
# The true ones, whatever the module holds later.
_now, _sleep = time.monotonic, time.sleep


class LiveWindow:
    """The window. ``bits`` are those of its buffers by GLFW's names: {"DEPTH_BITS": 24}.

    ``hints`` are further hints of GLFW. Without ``double_buffered`` what was drawn stays where it
    is when it is shown, although GLFW's window has two buffers.
    """

    def __init__(
        self,
        run: Run,
        size: tuple[int, int],
        title: str,
        bits: Mapping[str, int],
        double_buffered: bool = True,
        hints: Mapping[str, int] | None = None,
    ) -> None:
        """Open it; its context is current then. What is raised ends the program."""
        from framelens.gl.glfw_library import glfw

        assert run.live is not None
        self._run, self._glfw = run, glfw
        self._keeps = not double_buffered
        check_thread()
        if sys.platform == "linux" and run.source.toolkit == "glut":
            glfw.init_hint(glfw.PLATFORM, glfw.PLATFORM_X11)  # so is PyOpenGL bound
        if not glfw.init():
            raise run.stop(NoOpenGLError("GLFW cannot open the screen that DISPLAY names"))
        for name, count in {"SAMPLES": 0, **bits, **(hints or {})}.items():
            glfw.window_hint(getattr(glfw, name), count)
        self._window = glfw.create_window(*size, title, None, None)
        if not self._window:
            raise run.stop(
                NoOpenGLError("GLFW opens no window: {get_error!s}", get_error=glfw.get_error()[1])
            )
        glfw.make_context_current(self._window)
        keys = {glfw_constant(glfw, f"KEY_{key}"): key for key in KEYS}
        run.live.attach(glfw, self._window, keys)
        run.clock.waits = _sleep
        self._shown_at = _now(), run.clock.now

    def described(self, toolkit: str) -> Window:
        """Return what an observer learns of it."""
        return Window(toolkit, "glfw", self.pixels, not self._keeps)

    def pixels(self) -> tuple[int, int]:
        """Return the size of what the program draws to."""
        width, height = self._glfw.get_framebuffer_size(self._window)
        return int(width), int(height)

    def entitle(self, title: str) -> None:
        """Change the title."""
        self._glfw.set_window_title(self._window, title)

    def resize(self, size: tuple[int, int]) -> None:
        """Ask for another size."""
        self._glfw.set_window_size(self._window, *size)
        self._glfw.poll_events()  # only now it changes

    def end_frame(self, shows: bool = True) -> None:
        """End the program's frame, show it unless the program does not, and begin the next one.

        A window in which nothing was ever shown is black.
        """
        kept = self._read() if self._keeps or not shows else None
        self._run.end_frame()
        self._keep_pace()
        if kept is not None and not shows:
            with unnoted():
                _black(kept).write()  # instead of what the inspector has shown meanwhile
        self._glfw.swap_buffers(self._window)
        if kept is not None:
            with unnoted():
                kept.write()
        self._run.begin_frame()

    def _read(self) -> Buffers:
        with unnoted():
            return Buffers.read(self.pixels())

    def _keep_pace(self) -> None:
        """Wait until as much time has passed since the last frame as the program believes."""
        (then, clock), now = self._shown_at, _now()
        ahead = (self._run.clock.now - clock) - (now - then)
        _sleep(max(0.0, min(ahead, LONGEST)))
        self._shown_at = _now(), self._run.clock.now

    def close(self) -> None:
        """Close it."""
        if self._window:
            self._glfw.destroy_window(self._window)
            self._window = None
            self._glfw.terminate()


def _black(buffers: Buffers) -> Buffers:
    """Return a black picture of the same size."""
    return Buffers(np.zeros_like(buffers.color), None, None)
