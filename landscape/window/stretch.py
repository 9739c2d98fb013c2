"""A window drawn with fewer pixels than it has: for walking smoothly where pixels are expensive.

Technique: the frame is drawn into a texture of the size ``Frame.viewport``, through a framebuffer
object, and one textured quad, filtered, stretches it over the window.

A picture that stands still is drawn *interlaced*, at half the pixels along each side. Each of four
frames is shifted by a pixel of the window, so that its pixels lie where every second pixel of every
second row of the window is; glPolygonStipple lets the quad write only those. After four frames each
pixel of the window has been drawn exactly where it would be in a frame of full size. Texture mip
levels are chosen as for a full frame, by a bias in every texture unit (GL_TEXTURE_FILTER_CONTROL,
OpenGL 1.4).

State used: a framebuffer object, viewport, both matrices, GL_TEXTURE_2D, GL_POLYGON_STIPPLE; depth
test, fog and lighting off.
"""

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace

import numpy as np

from landscape.frame import Detail, scaled
from landscape.gl.calls import drawing, gl
from landscape.gl.state import attrib, flat_projection
from landscape.gl.texture_target import TextureTarget
from landscape.scene import Moment

# The pixel of each block that the frames draw in turn; diagonal neighbours first.
PHASES = ((0, 0), (1, 1), (1, 0), (0, 1))


def phase_shift(phase: int) -> tuple[float, float]:
    """Return how far to shift the picture, in pixels right and up, for a frame of a phase.

    A pixel of half the size samples the middle of its block of 2 by 2 pixels: half a pixel from
    the middle of each of them.
    """
    x, y = PHASES[phase % len(PHASES)]
    return 0.5 - x, 0.5 - y


def stipple(phase: int) -> np.ndarray:
    """Return the pattern, uint8 (128,), that lets a phase's pixels of 32 by 32 through."""
    x, y = PHASES[phase % len(PHASES)]
    rows = np.zeros((32, 32), np.uint8)
    rows[y::2, x::2] = 1
    return np.packbits(rows)


class Stretch:
    """Owner of the textures; they are made when first needed, and again when a size changes."""

    def __init__(self) -> None:
        """Create nothing yet."""
        self._small: TextureTarget | None = None
        self._whole: TextureTarget | None = None
        self._phase = 0

    def draw(self, moment: Moment, draw: Callable[[Moment], None], interlaced: bool) -> None:
        """Let ``draw`` draw a moment by its detail, and show it in the whole window.

        ``interlaced`` frames have a scale of a half, and follow each other with the same pose.
        """
        if moment.detail.scale >= 1.0:
            self._phase = 0
            draw(moment)
            return
        if interlaced:
            shift = phase_shift(self._phase)
            moment = replace(moment, detail=replace(moment.detail, shift=shift))
        width, height = (scaled(side, moment.detail.scale) for side in moment.size)
        self._small = _sized(self._small, (width, height))
        # The frame clears what it draws to.
        bias = math.log2(moment.detail.scale) if interlaced else 0.0
        with self._small.drawing(clear=False), _biased(bias):
            draw(moment)
        with drawing("stretch"):
            self._show(moment.size, moment.detail, interlaced)

    def _show(self, size: tuple[int, int], detail: Detail, interlaced: bool) -> None:
        """Put the small picture into the window, or its pixels among those of the last frames."""
        assert self._small is not None
        small = self._small.size
        # The small picture may reach beyond the window by a fraction of a pixel.
        part = tuple(side * detail.scale / pixels for side, pixels in zip(size, small, strict=True))
        gl.glViewport(0, 0, *size)
        if not interlaced:
            self._phase = 0
            _cover(self._small, part)
            return
        self._whole = _sized(self._whole, size)
        with self._whole.drawing(clear=False):
            if self._phase == 0:
                # The first frame stands in for those to come.
                _cover(self._small, part)
            _cover(self._small, part, stipple(self._phase))
        self._phase += 1
        _cover(self._whole, (1.0, 1.0), exact=True)

    def release(self) -> None:
        """Delete the textures; may be called twice."""
        for target in (self._small, self._whole):
            if target is not None:
                target.release()
        self._small = self._whole = None


def _sized(target: TextureTarget | None, size: tuple[int, int]) -> TextureTarget:
    """Return the target if it has that size, else a new one in its place."""
    if target is not None and target.size == size:
        return target
    if target is not None:
        target.release()
    return TextureTarget(size)


@contextmanager
def _biased(bias: float) -> Iterator[None]:
    """Add ``bias`` to the mip levels that all texture units choose in the block."""
    if not bias:
        yield
        return
    units = range(int(gl.glGetIntegerv(gl.GL_MAX_TEXTURE_UNITS)))

    def add(value: float) -> None:
        for unit in units:
            gl.glActiveTexture(gl.GL_TEXTURE0 + unit)
            gl.glTexEnvf(gl.GL_TEXTURE_FILTER_CONTROL, gl.GL_TEXTURE_LOD_BIAS, value)
        gl.glActiveTexture(gl.GL_TEXTURE0)

    add(bias)
    try:
        yield
    finally:
        add(0.0)


def _cover(
    target: TextureTarget,
    part: tuple[float, ...],
    pattern: np.ndarray | None = None,
    exact: bool = False,
) -> None:
    """Cover the viewport with the lower left ``part`` of a texture, where the pattern lets it.

    Neighbouring texels are mixed, unless there is a pattern or each is ``exact``ly a pixel.
    """
    s, t = part
    groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_POLYGON_BIT | gl.GL_POLYGON_STIPPLE_BIT
    near = exact or pattern is not None
    with attrib(groups), flat_projection(0, 1, 0, 1, -1, 1):
        for off in (gl.GL_DEPTH_TEST, gl.GL_FOG, gl.GL_LIGHTING, gl.GL_BLEND, gl.GL_CULL_FACE):
            gl.glDisable(off)
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_FILL)
        if pattern is not None:
            gl.glEnable(gl.GL_POLYGON_STIPPLE)
            gl.glPolygonStipple(pattern)
        gl.glEnable(gl.GL_TEXTURE_2D)
        target.bind()
        kind = gl.GL_NEAREST if near else gl.GL_LINEAR
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAG_FILTER, kind)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, kind)
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)
        gl.glBegin(gl.GL_QUADS)
        for x, y in ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)):
            gl.glTexCoord2f(s * x, t * y)
            gl.glVertex2f(x, y)
        gl.glEnd()
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
