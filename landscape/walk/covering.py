"""Covering a window with a picture that is a texture; and pictures of other sizes than the window.

State used: both matrices, GL_TEXTURE_2D, GL_POLYGON_STIPPLE; depth test, fog and lighting off.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import numpy as np

from framelens.gl.extensions import texture_units
from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays, flat_projection
from landscape.gl.features import possible
from landscape.gl.texture_target import TextureTarget
from landscape.walk.reprojection import GRID, QUADS


def sized(target: TextureTarget | None, size: tuple[int, int]) -> TextureTarget:
    """Return the target if it has that size, else a new one in its place."""
    if target is not None and target.size == size:
        return target
    if target is not None:
        target.release()
    return TextureTarget(size)


@contextmanager
def biased(bias: float) -> Iterator[None]:
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


@contextmanager
def _flat_picture(target: TextureTarget, near: bool) -> Iterator[None]:
    """Let the block draw the texture in the window's own coordinates, -1..1, as it is.

    Neighbouring texels are mixed, unless the ``near``est one is to be taken.
    """
    groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_POLYGON_BIT | gl.GL_POLYGON_STIPPLE_BIT
    with attrib(groups), flat_projection():
        for off in (gl.GL_DEPTH_TEST, gl.GL_FOG, gl.GL_LIGHTING, gl.GL_BLEND, gl.GL_CULL_FACE):
            gl.glDisable(off)
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_FILL)
        gl.glEnable(gl.GL_TEXTURE_2D)
        target.bind()
        kind = gl.GL_NEAREST if near else gl.GL_LINEAR
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAG_FILTER, kind)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, kind)

        # Not modulated by a colour: that would cost another third.
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_REPLACE)
        try:
            yield
        finally:
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)


def cover(
    target: TextureTarget,
    part: Sequence[float],
    pattern: np.ndarray | None = None,
    exact: bool = False,
) -> None:
    """Cover the viewport with the lower left ``part`` pixels of a texture, by the pattern.

    Neighbouring texels are mixed, unless there is a pattern or each is ``exact``ly a pixel.
    """
    s, t = (pixels / side for pixels, side in zip(part, target.size, strict=True))
    with _flat_picture(target, near=exact or pattern is not None):
        if pattern is not None:
            gl.glEnable(gl.GL_POLYGON_STIPPLE)
            gl.glPolygonStipple(pattern)
        gl.glBegin(gl.GL_QUADS)
        for x, y in ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)):
            gl.glTexCoord2f(s * x, t * y)
            gl.glVertex2f(2.0 * x - 1.0, 2.0 * y - 1.0)
        gl.glEnd()


def cover_by_grid(target: TextureTarget, part: Sequence[float], vertices: np.ndarray) -> None:
    """Cover the viewport with the lower left ``part`` pixels of a texture, on a grid of vertices.

    They are those of :func:`reprojected`.
    """
    sides = [pixels / side for pixels, side in zip(part, target.size, strict=True)]
    coordinates = np.ascontiguousarray((GRID * sides).reshape(-1, 2), np.float32)
    corners = np.ascontiguousarray(vertices.reshape(-1, 3))
    with (
        _flat_picture(target, near=False),
        client_arrays(corners, coordinates=[coordinates]),
    ):
        gl.glDrawElements(gl.GL_QUADS, QUADS.size, gl.GL_UNSIGNED_INT, QUADS)
