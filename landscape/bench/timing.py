"""Timing what OpenGL draws: in turns, and relative to a full-screen layer of the same size.

Milliseconds say little on a machine that is also doing other things. So what is to be compared is
timed in turns, one run of each per round, and a slow moment affects all of them. Every measurement
ends with glFinish.
"""

import time
from collections.abc import Callable, Mapping

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, flat_projection
from framelens.gl.texture import Texture
from landscape.frame import SEED


def timed(action: Callable[[], object]) -> float:
    """Return how long ``action`` takes in milliseconds, with glFinish before and after it."""
    gl.glFinish()
    start = time.perf_counter()
    action()
    gl.glFinish()
    return (time.perf_counter() - start) * 1e3


def in_turns(
    actions: Mapping[str, Callable[[], object]],
    rounds: int,
    before: Mapping[str, Callable[[], object]] | None = None,
) -> dict[str, list[float]]:
    """Time the actions one after the other, ``rounds`` times, each on a cleared target.

    Returns the times of each in milliseconds. Each is first run twice without being timed.
    ``before`` maps the name of an action to what is done, untimed, before each run of it.
    """
    times: dict[str, list[float]] = {name: [] for name in actions}
    for turn in range(-2, rounds):
        for name, action in actions.items():
            if before and name in before:
                before[name]()
            clear()
            spent = timed(action)
            if turn >= 0:
                times[name].append(spent)

    return times


def clear() -> None:
    """Clear the colour, depth and stencil buffers."""
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)


class Layer:
    """The yardstick: a full-screen quad, trilinear-filtered, depth-tested, in EXP2 fog."""

    SIDE = 512  # chosen: texels per side
    TEXELS = 1.4142  # chosen: texels per pixel, half-way between two mip levels

    def __init__(self, size: tuple[int, int]) -> None:
        """Make a texture of noise."""
        noise = np.random.default_rng(SEED).integers(0, 256, (self.SIDE, self.SIDE, 3), np.uint8)
        self._texture = Texture(noise)
        self._size = size

    def draw(self) -> None:
        """Cover the whole target, which must have been cleared."""
        s, t = (self.TEXELS * side / self.SIDE for side in self._size)
        groups = gl.GL_ENABLE_BIT | gl.GL_FOG_BIT | gl.GL_CURRENT_BIT | gl.GL_VIEWPORT_BIT
        with attrib(groups), flat_projection(-1, 1, -1, 1, 1, 9):
            gl.glViewport(0, 0, *self._size)
            for off in (gl.GL_LIGHTING, gl.GL_BLEND, gl.GL_CLIP_PLANE0, gl.GL_STENCIL_TEST):
                gl.glDisable(off)
            for on in (gl.GL_DEPTH_TEST, gl.GL_TEXTURE_2D, gl.GL_FOG):
                gl.glEnable(on)
            gl.glFogi(gl.GL_FOG_MODE, gl.GL_EXP2)
            gl.glFogf(gl.GL_FOG_DENSITY, 0.1)
            self._texture.bind()
            gl.glColor4f(1.0, 1.0, 1.0, 1.0)
            gl.glBegin(gl.GL_QUADS)
            for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                gl.glTexCoord2f(s * (x + 1) / 2, t * (y + 1) / 2)
                gl.glVertex3f(x, y, -5.0)
            gl.glEnd()
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        self._texture.release()
