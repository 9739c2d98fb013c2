"""Pictures drawn over a step, whatever it has left in the context, and whatever it keeps there."""

from collections.abc import Callable, Hashable

import numpy as np

from framelens.gl.objects import NAMES
from framelens.gl.seam import gl
from framelens.inspector.panel import padded

MOST = 8  # chosen: plates at a time


class Plates:
    """The pictures, each with a texture whose name is beyond those that a program takes."""

    def __init__(self) -> None:
        """Take the names, in a context without textures."""
        names = np.array(gl.glGenTextures(NAMES + MOST)).ravel()
        gl.glDeleteTextures(np.array(names[:NAMES], np.uint32))
        self._free = [int(name) for name in names[NAMES:]]
        self._shown: dict[str, tuple[Hashable, int, tuple[int, int], tuple[float, float]]] = {}

    def draw(
        self,
        name: str,
        corner: tuple[int, int],
        shows: Hashable,
        make: Callable[[], np.ndarray],
    ) -> None:
        """Draw a picture with its lower left corner at ``corner``, in pixels.

        It is made again where ``shows``, what it depends on, is not what it was.
        """
        if name not in self._shown or self._shown[name][0] != shows:
            texture = self._shown[name][1] if name in self._shown else self._free.pop()
            self._shown[name] = shows, texture, *_load(texture, make())
        _, texture, (width, height), (s, t) = self._shown[name]
        x, y = corner
        gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)
        gl.glBegin(gl.GL_QUADS)
        for right, top in ((0, 0), (1, 0), (1, 1), (0, 1)):
            gl.glTexCoord2f(right * s, (1 - top) * t)
            gl.glVertex2f(float(x + right * width), float(y + top * height))
        gl.glEnd()
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)


def _load(texture: int, image: np.ndarray) -> tuple[tuple[int, int], tuple[float, float]]:
    """Load an image (h, w, 4) into a texture; return its size, and its part of the texture."""
    canvas = padded(image)
    height, width = image.shape[:2]
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    for kind in (gl.GL_TEXTURE_MIN_FILTER, gl.GL_TEXTURE_MAG_FILTER):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, kind, gl.GL_NEAREST)
    gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 4)
    gl.glTexImage2D(
        *(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, canvas.shape[1], canvas.shape[0], 0),
        *(gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, canvas),
    )
    return (width, height), (width / canvas.shape[1], height / canvas.shape[0])
