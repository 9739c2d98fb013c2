"""The window while a scene is built: a picture, and the progress."""

from collections.abc import Callable

import numpy as np

from framelens.gl.contexts.glfw import GLFWContext
from framelens.gl.glfw_library import glfw
from framelens.gl.seam import unnoted
from framelens.inspector.panel import Panel, Plate
from landscape.walk import words
from landscape.walk.title import show_plate

OFTEN = 0.15  # chosen: seconds between two pictures


def with_alpha(pixels: np.ndarray) -> np.ndarray:
    """Return a picture, uint8 (h, w, 3), as an opaque one (h, w, 4)."""
    return np.dstack([pixels, np.full(pixels.shape[:2], 255, np.uint8)])


class Left(Exception):
    """The user has left while a scene was built."""


class Waiting:
    """Shows a picture with a message in a window; owner of the picture's texture.

    ``expected`` is about how many steps there are, ``leaves`` says whether the user has asked to
    leave, which then need not wait until all is built.
    """

    def __init__(
        self,
        context: GLFWContext,
        panel: Panel,
        message: str,
        behind: np.ndarray,
        leaves: Callable[[], bool],
    ) -> None:
        """Take a picture of the window's size, uint8 (h, w, 4)."""
        self._context = context
        self._panel = panel
        self._message = message
        self._size = behind.shape[1], behind.shape[0]
        self.expected, self._leaves = 1, leaves
        self._steps, self._shown = 0, 0.0
        with unnoted():
            self._plate: Plate | None = Plate(behind)

    def step(self, language: str, _: str) -> None:
        """Note that a part is about to be built; from time to time, show how far it is.

        Raise Left if the user has left.
        """
        self._steps += 1
        if glfw.get_time() - self._shown > OFTEN:
            self.show(language)
        glfw.poll_events()
        if self._leaves():
            raise Left

    def show(self, language: str) -> None:
        """Show the picture and the message; what is being built takes no note of it."""
        if self._plate is None or self._context.pixels() != self._size:
            return
        percent = min(100 * self._steps // self.expected, 99)
        text = words.text(language, "progress", what=self._message, percent=str(percent))
        with unnoted():
            show_plate(self._plate, self._size)
            self._panel.draw(self._size, message=text if self._steps else self._message)
            self._context.show()
        self._shown = glfw.get_time()

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        if self._plate is not None:
            with unnoted():
                self._plate.release()
            self._plate = None
