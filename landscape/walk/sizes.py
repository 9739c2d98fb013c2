"""The window's sizes: how large it opens, and how a replay keeps to the recorded ones.

Sizes of pictures are in pixels, those of windows in the window system's coordinates, which are
larger than a pixel on some displays of high resolution (Wayland, macOS).
"""

from dataclasses import dataclass, replace

from framelens.base.errors import InputError
from framelens.gl.glfw_library import glfw
from framelens.gl.seam import gl
from landscape.walk.recording import Tick

PATIENCE = 1.0  # chosen: seconds that the window system has for a new size


def check_viewport(size: tuple[int, int]) -> None:
    """Raise InputError if the current OpenGL draws no picture of ``size``."""
    limits = gl.glGetIntegerv(gl.GL_MAX_VIEWPORT_DIMS)
    if any(side > limit for side, limit in zip(size, limits, strict=True)):
        most = "x".join(map(str, limits))
        raise InputError(
            "--size {width}x{height}: expected at most {most} on this OpenGL",
            width=size[0],
            height=size[1],
            most=most,
        )


@dataclass
class Resizer:
    """Gives the window the size that a replay asks for, as far as the window system lets it.

    ``refused`` is the first size that it did not give, and what it gave instead.
    """

    asked: tuple[int, int] = (0, 0)
    since: float = 0.0
    refused: tuple[tuple[int, int], tuple[int, int]] | None = None

    def follow(self, window: object, tick: Tick, actual: tuple[int, int]) -> Tick:
        """Return the recorded frame at the size to draw; ``actual`` is the window's, in pixels.

        A full-screen window keeps its size, and so does one that has not changed in PATIENCE.
        """
        if tick.size == actual:
            return tick
        if glfw.get_window_monitor(window):
            return replace(tick, size=actual)
        if tick.size != self.asked:
            self.asked, self.since = tick.size, glfw.get_time()
            across = glfw.get_window_size(window)[0]
            # Zero while the window has no area: then pixels are taken for coordinates.
            scale = actual[0] / across if across and actual[0] else 1.0
            glfw.set_window_size(window, *(round(side / scale) for side in tick.size))
        elif glfw.get_time() - self.since > PATIENCE:
            self.refused = self.refused or (tick.size, actual)
            return replace(tick, size=actual)
        return tick
