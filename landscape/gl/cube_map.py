"""Cube maps: six square images around a place, looked up by a direction (OpenGL 1.3).

OpenGL generates the direction at each vertex: GL_REFLECTION_MAP is the line of sight mirrored by
the normal, GL_NORMAL_MAP the normal itself, both in eye space. The texture matrix can turn them to
the axes of the world.
"""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from framelens.gl.named import gl_constant
from framelens.gl.seam import gl
from framelens.gl.texture import edge, mip_levels

FACES = ("POSITIVE_X", "NEGATIVE_X", "POSITIVE_Y", "NEGATIVE_Y", "POSITIVE_Z", "NEGATIVE_Z")


def face_directions(side: int) -> np.ndarray:
    """Return the unit vectors (6, side, side, 3) through the texels of the faces, row 0 at t = 0.

    The faces are in the order of FACES (OpenGL 1.5, section 3.8.6).
    """
    return np.stack([directions_through(face, side, slice(None)) for face in range(6)])


def directions_through(face: int, side: int, rows: slice) -> np.ndarray:
    """Return those (rows, side, 3) through some rows of texels of one face."""
    middles = (np.arange(side) + 0.5) / side * 2 - 1
    s, t = np.meshgrid(middles, middles[rows])
    one = np.ones_like(s)
    faces = [(one, -t, -s), (-one, -t, s), (s, one, t), (s, -one, -t), (s, -t, one), (-s, -t, -one)]
    found = np.stack(faces[face], axis=-1)
    return np.asarray(found / np.linalg.norm(found, axis=-1, keepdims=True))


class CubeMap:
    """Owner of one cube map."""

    def __init__(self, faces: np.ndarray, trilinear: bool = True, mipmaps: bool = True) -> None:
        """Upload six images, uint8 (6, n, n, 1, 3 or 4), in the order of FACES, n a power of two.

        One channel is alpha.

        They have mip levels: a bent surface mirrors much in few pixels, and would glitter. Smooth
        images do without ``mipmaps``, and without ``trilinear`` only the nearer of two levels is
        sampled, which is cheaper.
        """
        self.name = int(gl.glGenTextures(1))
        kind = gl.GL_TEXTURE_CUBE_MAP
        gl.glBindTexture(kind, self.name)
        minified = gl.GL_LINEAR_MIPMAP_LINEAR if trilinear else gl.GL_LINEAR_MIPMAP_NEAREST
        gl.glTexParameteri(kind, gl.GL_TEXTURE_MIN_FILTER, minified if mipmaps else gl.GL_LINEAR)
        gl.glTexParameteri(kind, gl.GL_TEXTURE_MAG_FILTER, gl.GL_LINEAR)
        gl.glTexParameteri(kind, gl.GL_TEXTURE_WRAP_S, edge())
        gl.glTexParameteri(kind, gl.GL_TEXTURE_WRAP_T, edge())
        forms = {1: (gl.GL_ALPHA8, gl.GL_ALPHA), 3: (gl.GL_RGB8, gl.GL_RGB)}
        kept, form = (forms | {4: (gl.GL_RGBA8, gl.GL_RGBA)})[faces.shape[-1]]
        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
        for face, image in zip(FACES, faces, strict=True):
            target = gl_constant(f"GL_TEXTURE_CUBE_MAP_{face}")
            for level, part in enumerate(mip_levels(image) if mipmaps else [image]):
                sides = len(part), len(part), 0
                pixels = np.ascontiguousarray(part)
                gl.glTexImage2D(target, level, kept, *sides, form, gl.GL_UNSIGNED_BYTE, pixels)

        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 4)
        gl.glBindTexture(kind, 0)

    def bind(self) -> None:
        """Make this the cube map of the active unit."""
        gl.glBindTexture(gl.GL_TEXTURE_CUBE_MAP, self.name)

    def release(self) -> None:
        """Delete the cube map; may be called twice."""
        if self.name:
            gl.glDeleteTextures(np.array([self.name], np.uint32))
            self.name = 0


def generate(mode: str, coordinates: str = "STR") -> None:
    """Let the active unit generate texture coordinates by a mode, as in "REFLECTION_MAP"."""
    for name in coordinates:
        gl.glTexGeni(gl_constant(f"GL_{name}"), gl.GL_TEXTURE_GEN_MODE, gl_constant(f"GL_{mode}"))
        gl.glEnable(gl_constant(f"GL_TEXTURE_GEN_{name}"))


@contextmanager
def texture_matrix(turn: np.ndarray) -> Iterator[None]:
    """Multiply the block's texture coordinates, in the active unit, by a rotation (3, 3)."""
    wide = np.eye(4, dtype=np.float32)
    wide[:3, :3] = turn
    gl.glMatrixMode(gl.GL_TEXTURE)
    gl.glPushMatrix()
    gl.glLoadMatrixf(np.ascontiguousarray(wide.T))
    gl.glMatrixMode(gl.GL_MODELVIEW)
    try:
        yield
    finally:
        gl.glMatrixMode(gl.GL_TEXTURE)
        gl.glPopMatrix()
        gl.glMatrixMode(gl.GL_MODELVIEW)
