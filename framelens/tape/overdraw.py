"""Overdraw: how many fragments passed all tests at each pixel, a layer each.

Technique: each draw is made with linear fog that ends in front of everything, so the fog leaves
nothing of a fragment's red, green and blue but its own colour, 1/255. Its alpha stays what the
alpha test needs. Blending by GL_ONE, GL_ONE then adds 1 to the pixel for each fragment that passes.
Depth and stencil are tested and written as in the frame itself, so the count is exact, even of a
draw that covers itself: it equals what occlusion queries count, primitive by primitive. A layer
that the colour mask hides is counted: it passed. What is drawn without fragments (glClear, glAccum,
glBlitFramebuffer) is not.

Two limits: more than 255 layers of one group of draws at a pixel count as 255, and a frame
that copies its own colours into a texture copies counts, which matters where an alpha test reads
that texture.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np

from framelens.gl.seam import Call, gl
from framelens.tape.readback import read_color

LAYER = np.array((1 / 255, 1 / 255, 1 / 255, 1.0), np.float32)  # RGBA: 1 in a buffer of 8 bits
NOWHERE = (-2e9, -1e9)  # chosen: distances of the fog's start and end, in front of everything


class LayerCounter:
    """Counts layers in the framebuffer that is bound, instead of its colours."""

    def __init__(self, size: tuple[int, int]) -> None:
        """Begin to count, all pixels from 0; ``size`` is the picture's in pixels."""
        self._size = size
        self._total = np.zeros(size[::-1], np.uint16)
        self._target = int(gl.glGetIntegerv(gl.GL_DRAW_FRAMEBUFFER_BINDING))
        self._buffer = int(gl.glGetIntegerv(gl.GL_DRAW_BUFFER))
        self._clear()

    def count(self, call: Call, draw: Callable[[], object]) -> None:
        """Draw, counting layers; ``call`` is the one that draws."""
        if call.name == "glAccum":
            return
        if call.name == "glClear":
            gl.glClear(int(call.args[0]) & ~int(gl.GL_COLOR_BUFFER_BIT))
        elif call.name.startswith("glBlitFramebuffer"):
            buffers = int(call.args[8]) & ~int(gl.GL_COLOR_BUFFER_BIT)
            gl.glBlitFramebuffer(*call.args[:8], buffers, call.args[9])
        else:
            with self._counting():
                draw()

    @contextmanager
    def _counting(self) -> Iterator[None]:
        gl.glPushAttrib(gl.GL_COLOR_BUFFER_BIT | gl.GL_FOG_BIT | gl.GL_ENABLE_BIT)
        gl.glEnable(gl.GL_FOG)
        gl.glFogi(gl.GL_FOG_MODE, gl.GL_LINEAR)
        gl.glFogf(gl.GL_FOG_START, NOWHERE[0])
        gl.glFogf(gl.GL_FOG_END, NOWHERE[1])
        gl.glFogfv(gl.GL_FOG_COLOR, LAYER)
        gl.glDrawBuffer(self._buffer)
        gl.glColorMask(True, True, True, True)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendEquation(gl.GL_FUNC_ADD)
        gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)
        gl.glDisable(gl.GL_COLOR_LOGIC_OP)
        gl.glDisable(gl.GL_DITHER)
        try:
            yield
        finally:
            gl.glPopAttrib()

    def read(self) -> np.ndarray:
        """Return the layers so far, uint16 (h, w), top row first: a new array."""
        color = read_color(self._target, (0, 0, *self._size))
        if color is not None:
            self._total += color[..., 0]
        self._clear()
        return self._total.copy()

    def _clear(self) -> None:
        """Set the counts in the framebuffer to 0."""
        bound = int(gl.glGetIntegerv(gl.GL_DRAW_FRAMEBUFFER_BINDING))
        gl.glBindFramebuffer(gl.GL_DRAW_FRAMEBUFFER, self._target)
        gl.glPushAttrib(gl.GL_COLOR_BUFFER_BIT | gl.GL_SCISSOR_BIT)
        gl.glDisable(gl.GL_SCISSOR_TEST)
        gl.glDrawBuffer(self._buffer)
        gl.glColorMask(True, True, True, True)
        gl.glClearColor(0.0, 0.0, 0.0, 0.0)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT)
        gl.glPopAttrib()
        gl.glBindFramebuffer(gl.GL_DRAW_FRAMEBUFFER, bound)
