"""A window drawn with fewer pixels than it has: for walking smoothly where pixels are expensive.

Technique: the frame is drawn into a texture of the size ``Frame.viewport``, through a framebuffer
object, and one textured quad, filtered, stretches it over the window.

A picture that stands still is drawn *interlaced*, at a half or a quarter of the pixels along each
side. Each frame is shifted by some pixels of the window, so that its own pixels lie where every
second (or fourth) pixel of every second row of the window is; glPolygonStipple lets the quad write
only those. After 4 (or 16) frames each pixel of the window has been drawn exactly where it would be
in a frame of full size. Texture mip levels are chosen as for a full frame, by a bias in every
texture unit (GL_TEXTURE_FILTER_CONTROL, OpenGL 1.4).

State used: a framebuffer object, viewport, both matrices, GL_TEXTURE_2D, GL_POLYGON_STIPPLE; depth
test, fog and lighting off.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace

import numpy as np

from framelens.gl.extensions import texture_units
from framelens.gl.seam import drawing, gl
from framelens.gl.state import attrib, flat_projection
from landscape.frame import scaled
from landscape.gl.features import possible
from landscape.gl.texture_target import TextureTarget
from landscape.scene.scene import Moment

# The pixels of a block of 2 by 2 in the order in which frames draw them: the diagonal first.
BLOCK = ((0, 0), (1, 1), (1, 0), (0, 1))


def phases(side: int) -> list[tuple[int, int]]:
    """Return the pixels x, y of a block of 2 by 2 or 4 by 4 in the order of the frames.

    Each frame's pixel is far from those of the frames just before it (Bayer's order).
    """
    if side == 2:
        return list(BLOCK)
    return [(2 * x + right, 2 * y + up) for right, up in BLOCK for x, y in BLOCK]


def phase_shift(pixel: tuple[int, int], side: int) -> tuple[float, float]:
    """Return how far to shift the picture, right and up, to draw that pixel of a block.

    In pixels of the window. A small pixel shows what is in the middle of its block.
    """
    x, y = pixel
    return (side - 1) / 2 - x, (side - 1) / 2 - y


def stipple(pixel: tuple[int, int], side: int) -> np.ndarray:
    """Return the pattern, uint8 (128,), of 32 by 32 that lets only that pixel of blocks through."""
    x, y = pixel
    rows = np.zeros((32, 32), np.uint8)
    rows[y::side, x::side] = 1
    return np.packbits(rows)


class Stretch:
    """Owner of the textures; they are made when first needed, and again when a size changes."""

    def __init__(self) -> None:
        """Create nothing yet."""
        self._small: TextureTarget | None = None  # what was drawn last
        self._whole: TextureTarget | None = None  # what interlaced frames add up to
        self._part: tuple[float, ...] = (1.0, 1.0)  # the small picture's pixels in the window
        self._frame = 0  # of the interlaced ones

    def draw(self, moment: Moment, draw: Callable[[Moment], None], interlaced: bool) -> None:
        """Let ``draw`` draw a moment by its detail, and show it in the whole window.

        ``interlaced`` frames have a scale of a half or a quarter, and follow each other with the
        same pose.
        """
        if moment.detail.scale < 1.0 and not possible("pictures of fewer pixels in a walk"):
            moment = replace(moment, detail=replace(moment.detail, scale=1.0))
        if moment.detail.scale >= 1.0:
            self._frame = 0
            self.release()
            draw(moment)
        elif interlaced:
            self._interlace(moment, draw)
        else:
            self._frame = 0
            small = self._draw_small(moment, draw)
            with drawing("stretch"):
                gl.glViewport(0, 0, *moment.size)
                _cover(small, self._part)

    def _draw_small(
        self, moment: Moment, draw: Callable[[Moment], None], bias: float = 0.0
    ) -> TextureTarget:
        """Draw the small picture, with ``bias`` on the mip levels of its textures."""
        scale = moment.detail.scale
        width, height = (scaled(side, scale) for side in moment.size)
        self._part = tuple(side * scale for side in moment.size)
        self._small = _sized(self._small, (width, height))
        # The frame clears what it draws to.
        with self._small.drawing(clear=False), _biased(bias):
            draw(moment)
        return self._small

    def _interlace(self, moment: Moment, draw: Callable[[Moment], None]) -> None:
        """Draw some of the window's pixels, and show them among those of the last frames."""
        side = round(1 / moment.detail.scale)
        order = phases(side)
        pixel = order[self._frame % len(order)]
        self._whole = whole = _sized(self._whole, moment.size)
        stands_in = self._frame == 0 and self._small is not None
        if stands_in:
            # Until it is complete, the picture's other pixels are those that were stretched last.
            assert self._small is not None
            with drawing("stretch"), whole.drawing(clear=False):
                _cover(self._small, self._part)

        detail = replace(moment.detail, shift=phase_shift(pixel, side))
        small = self._draw_small(replace(moment, detail=detail), draw, -math.log2(side))
        with drawing("stretch"):
            with whole.drawing(clear=False):
                if self._frame == 0 and not stands_in:
                    _cover(small, self._part)
                _cover(small, self._part, stipple(pixel, side))
            gl.glViewport(0, 0, *moment.size)
            _cover(whole, moment.size, exact=True)

        self._frame += 1

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
    if not bias or not possible("sharper textures"):
        yield
        return
    units = range(texture_units())

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
    part: Sequence[float],
    pattern: np.ndarray | None = None,
    exact: bool = False,
) -> None:
    """Cover the viewport with the lower left ``part`` pixels of a texture, by the pattern.

    Neighbouring texels are mixed, unless there is a pattern or each is ``exact``ly a pixel.
    """
    s, t = (pixels / side for pixels, side in zip(part, target.size, strict=True))
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
        _filter(gl.GL_NEAREST if near else gl.GL_LINEAR)

        # Not modulated by a colour: that would cost another third.
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_REPLACE)
        _draw_unit_square(s, t)
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)


def _filter(kind: int) -> None:
    """Filter the texture that is bound by ``kind``, magnified and reduced."""
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAG_FILTER, kind)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, kind)


def _draw_unit_square(s: float, t: float) -> None:
    """Draw a square from 0 to 1 whose upper right corner has the texture coordinates s, t."""
    gl.glBegin(gl.GL_QUADS)
    for x, y in ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)):
        gl.glTexCoord2f(s * x, t * y)
        gl.glVertex2f(x, y)
    gl.glEnd()
