"""The accumulation buffer (Haeberli and Akeley 1990), as a texture of floating-point numbers.

glAccum adds pictures in a buffer of more than 8 bits. Few contexts still have one, and no
framebuffer object has, so here the buffer is a texture: each sample is drawn into a tile of a
sheet, and a quad for each tile then adds it, divided by the number of samples (GL_ONE, GL_ONE).
The samples are moved by parts of a pixel, which smooths their edges, too. Where a sample has drawn
nothing, alpha is 0, so that the mean can be laid over the picture: (GL_ONE,
GL_ONE_MINUS_SRC_ALPHA).
What is wrong without its safeguard: in 8 bits, each sample is rounded to a multiple of 1/255 after
it was divided by n, and the n roundings add up: colours come in steps, and are too bright or dark.
State used: framebuffer objects, GL_BLEND, GL_TEXTURE_2D, viewport, both matrices.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

import numpy as np

from framelens.gl.extensions import tell
from framelens.gl.named import gl_constant
from framelens.gl.seam import gl
from framelens.gl.state import attrib, flat_projection
from landscape.frame import Frame
from landscape.gl.accumulating import clear, quad, shifts
from landscape.gl.features import possible
from landscape.gl.texture_target import TextureTarget
from landscape.hall.exhibits.picture import Part, part_of, projection

SHEET, SIDE = 1024, 512  # chosen: sides of the sheet of samples and of the mean, in pixels


def cut(part: Part, size: tuple[int, int]) -> np.ndarray:
    """Return the matrix (4, 4) that enlarges a part of a picture of ``size`` to all of it."""
    scale = np.array(size) / (part.width, part.height)
    middle = (np.array([part.x, part.y]) + np.array([part.width, part.height]) / 2) / size * 2 - 1
    wide = np.diag([*scale, 1.0, 1.0])
    wide[:2, 3] = -middle * scale
    return wide


class Accumulation:
    """The sheet of samples and their mean. Needs framebuffer objects and textures of any size."""

    def __init__(self, deep: bool = True) -> None:
        """Make both; ``deep`` keeps sums in floating point, where this OpenGL can."""
        self._sheet = TextureTarget((SHEET, SHEET), "RGBA8")
        # A tile's texels are the mean's pixels.
        self._sheet.bind()
        for name in (gl.GL_TEXTURE_MIN_FILTER, gl.GL_TEXTURE_MAG_FILTER):
            gl.glTexParameteri(gl.GL_TEXTURE_2D, name, gl.GL_NEAREST)
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
        self.deep = deep
        self.mean = self._made(deep)

    @staticmethod
    def _made(deep: bool) -> TextureTarget:
        """Return the mean's texture: of floating-point numbers, where this OpenGL can draw them."""
        if deep and possible("exhibits.deep"):
            found = TextureTarget((SIDE, SIDE), "RGBA32F")
            if found.complete:
                return found
            found.release()
            tell("exhibits.deep: off, for this OpenGL draws into no GL_RGBA32F texture")
        return TextureTarget((SIDE, SIDE), "RGBA8")

    def set_deep(self, deep: bool) -> None:
        """Keep sums in floating point or in 8 bits."""
        if deep != self.deep:
            self.mean.release()
            self.deep, self.mean = deep, self._made(deep)

    def gather(
        self,
        size: tuple[int, int],
        projections: Sequence[np.ndarray],
        draw: Callable[[int], None],
        background: tuple[float, ...] = (0.0, 0.0, 0.0, 0.0),
    ) -> None:
        """Make the mean of samples of ``size`` pixels, at most SIDE each, at its bottom left.

        Each is drawn by ``draw(number)`` under its projection (4, 4), over ``background`` (RGBA).
        """
        columns, rows = SHEET // size[0], SHEET // size[1]
        count, first = len(projections), True
        for start in range(0, count, columns * rows):
            numbers = range(start, min(start + columns * rows, count))
            corners = [(k % columns * size[0], k // columns * size[1]) for k in range(len(numbers))]
            used = max(x for x, _ in corners) + size[0], corners[-1][1] + size[1]
            with self._sheet.drawing(clear=False):
                clear(used, background)
                for number, corner in zip(numbers, corners, strict=True):
                    with looking(projections[number]):
                        gl.glViewport(*corner, *size)
                        draw(number)

            with self.mean.drawing(clear=False):
                if first:
                    clear(size, (0.0, 0.0, 0.0, 0.0))
                gl.glViewport(0, 0, *size)
                self._add(size, corners, 1.0 / count)

            first = False

    def _add(self, size: tuple[int, int], corners: list[tuple[int, int]], weight: float) -> None:
        """Add tiles of the sheet, times ``weight``."""
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT | gl.GL_TEXTURE_BIT
        with attrib(groups), flat_projection():
            for name in ("DEPTH_TEST", "LIGHTING", "CULL_FACE", "FOG", "SCISSOR_TEST"):
                gl.glDisable(gl_constant(f"GL_{name}"))
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._sheet.bind()
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
            gl.glColor4f(weight, weight, weight, weight)
            for x, y in corners:
                tile = (x / SHEET, y / SHEET, (x + size[0]) / SHEET, (y + size[1]) / SHEET)
                quad(tile, (-1.0, -1.0, 1.0, 1.0), 0.0)
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)

    def show(self, part: Part, size: tuple[int, int], viewport: tuple[int, int]) -> None:
        """Lay the mean, of ``size`` pixels, over a part of a picture of ``viewport`` pixels."""
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT | gl.GL_TEXTURE_BIT
        with attrib(groups | gl.GL_DEPTH_BUFFER_BIT), flat_projection():
            for name in ("LIGHTING", "CULL_FACE", "FOG"):
                gl.glDisable(gl_constant(f"GL_{name}"))
            gl.glDepthMask(gl.GL_FALSE)
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE_MINUS_SRC_ALPHA)
            gl.glEnable(gl.GL_TEXTURE_2D)
            self.mean.bind()
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_REPLACE)
            low = np.array([part.x, part.y]) / viewport * 2 - 1
            high = np.array([part.x + part.width, part.y + part.height]) / viewport * 2 - 1
            right, top = size[0] / SIDE, size[1] / SIDE
            quad((0.0, 0.0, right, top), (*low.tolist(), *high.tolist()), part.depth)

    def gather_view(
        self,
        frame: Frame,
        low: tuple[float, ...],
        high: tuple[float, ...],
        lenses: Sequence[np.ndarray],
        draw: Callable[[int], None],
    ) -> bool:
        """Draw a box in the hall as the mean of samples, and lay it over the frame.

        ``lenses`` (4, 4) each move a sample in eye space. Only the part of the picture that holds
        the box is drawn. False where that cannot be said, as the eye is in the box.
        """
        view = projection()
        found = part_of(frame, low, high)
        if found is None or found.depth <= -1.0:
            return found is None
        shrunk = max(found.width / SIDE, found.height / SIDE, 1.0)
        size = int(found.width / shrunk), int(found.height / shrunk)
        enlarged, shaken = cut(found, frame.viewport) @ view, []
        for lens, shift in zip(lenses, shifts(len(lenses)), strict=True):
            moved = np.eye(4)
            moved[:2, 3] = 2 * shift / size
            shaken.append(moved @ enlarged @ lens)

        self.gather(size, shaken, draw)
        self.show(found, size, frame.viewport)
        return True

    def release(self) -> None:
        """Delete sheet and mean; may be called twice."""
        self._sheet.release()
        self.mean.release()


@contextmanager
def looking(projection: np.ndarray) -> Iterator[None]:
    """Draw the block under a projection matrix (4, 4), for column vectors."""
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glPushMatrix()
    gl.glLoadMatrixd(np.ascontiguousarray(projection.T))
    gl.glMatrixMode(gl.GL_MODELVIEW)
    try:
        yield
    finally:
        gl.glMatrixMode(gl.GL_PROJECTION)
        gl.glPopMatrix()
        gl.glMatrixMode(gl.GL_MODELVIEW)
