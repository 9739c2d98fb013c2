"""Drawing a mesh from its arrays, and the two quads that several elements send."""

from contextlib import AbstractContextManager

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import client_arrays
from landscape.geometry.mesh import Mesh


def draw_mesh(mesh: Mesh) -> None:
    """Send a mesh with one glDrawElements."""
    with arrays_of(mesh):
        draw_triangles(mesh.triangles)


def arrays_of(mesh: Mesh) -> AbstractContextManager[None]:
    """Return a block in which the vertex arrays are those of a mesh."""
    return client_arrays(mesh.vertices, mesh.normals, mesh.colors, mesh.coordinates)


def draw_triangles(triangles: np.ndarray) -> None:
    """Send triangles, uint32 (n, 3): numbers in the vertex arrays."""
    gl.glDrawElements(gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles)


def level_square(low: float, high: float, y: float) -> None:
    """Send a horizontal square at height ``y``, from ``low`` to ``high`` in x and in z."""
    gl.glBegin(gl.GL_QUADS)
    for x, z in ((low, low), (low, high), (high, high), (high, low)):
        gl.glVertex3f(x, y, z)
    gl.glEnd()


def picture_quad() -> None:
    """Send an upright square, -1..1 at distance 1, with the whole texture, row 0 at the top."""
    gl.glBegin(gl.GL_QUADS)
    for s, t, x, y in ((0, 1, -1, -1), (1, 1, 1, -1), (1, 0, 1, 1), (0, 0, -1, 1)):
        gl.glTexCoord2f(float(s), float(t))
        gl.glVertex3f(float(x), float(y), -1.0)
    gl.glEnd()
