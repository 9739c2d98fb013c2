"""Texture coordinates that OpenGL generates from the places of vertices."""

import numpy as np

from framelens.gl.named import gl_constant
from framelens.gl.seam import gl


def generate_by_planes(*planes: tuple[float, float, float, float]) -> None:
    """Let the active unit generate s and t from the place in the world, by two planes."""
    for name, plane in zip("ST", planes, strict=True):
        coordinate = gl_constant(f"GL_{name}")
        gl.glTexGeni(coordinate, gl.GL_TEXTURE_GEN_MODE, gl.GL_OBJECT_LINEAR)
        gl.glTexGenfv(coordinate, gl.GL_OBJECT_PLANE, np.array(plane, np.float32))
        gl.glEnable(gl_constant(f"GL_TEXTURE_GEN_{name}"))
