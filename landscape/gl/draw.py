"""Drawing a mesh from its arrays."""

from landscape.geometry.mesh import Mesh
from landscape.gl.calls import gl
from landscape.gl.state import client_arrays


def draw_mesh(mesh: Mesh) -> None:
    """Send a mesh with one glDrawElements."""
    with client_arrays(mesh.vertices, mesh.normals, mesh.colors, mesh.coordinates):
        gl.glDrawElements(gl.GL_TRIANGLES, mesh.triangles.size, gl.GL_UNSIGNED_INT, mesh.triangles)
