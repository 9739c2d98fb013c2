"""The membranes between the spines of the dragon's fins.

They are sheets without thickness, drawn from both sides and blended: their strip of the texture
(serpent_skin.py) has the ragged edge and how much shows through. Light falls through them, so that
both sides are equally bright: their normals are turned to the side of the sun. They are drawn after
all that may be seen through them, the sea included.
State used: GL_BLEND, GL_ALPHA_TEST, and what the animal that they belong to sets (animal.py).
What is wrong with them: of two membranes behind each other only one is seen.
"""

import math

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib
from landscape.elements.settings import Settings
from landscape.elements.sun import direction
from landscape.geometry.mesh import Mesh, gathered, scaled
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh

LEAST = 0.25  # chosen: opacity below which nothing is drawn
SKYWARD = 0.45  # chosen: how far normals are turned up, as the sky's light comes through, too


def lit_through(normals: np.ndarray, towards: np.ndarray) -> np.ndarray:
    """Return normals (n, 3) on the side ``towards`` (3,) which the sun stands, and turned up."""
    side = np.where(normals @ towards < 0.0, -1.0, 1.0)[:, None]
    turned = side * normals + np.array([0.0, SKYWARD, 0.0])
    length = np.maximum(np.linalg.norm(turned, axis=1, keepdims=True), 1e-9)
    return np.ascontiguousarray(turned / length, np.float32)


class Membranes:
    """The sheets in a display list."""

    def __init__(self, mesh: Mesh, settings: Settings) -> None:
        """Compile a mesh in -1..1, of the size and the light that the settings have."""
        dragon = settings.dragon
        yaw = math.radians(dragon.yaw)
        x, y, z = direction(settings.sun)
        towards = np.array(
            [x * math.cos(yaw) - z * math.sin(yaw), y, z * math.cos(yaw) + x * math.sin(yaw)]
        )
        normals = lit_through(mesh.normals, towards)
        lit = Mesh(mesh.vertices, normals, mesh.triangles, mesh.coordinates, mesh.colors)
        sent = scaled(gathered(lit), dragon.scale)
        self.reach = dragon.scale * float(np.linalg.norm(mesh.vertices, axis=1).max(initial=0.0))
        self._list = DisplayList(lambda: draw_mesh(sent))

    def draw(self) -> None:
        """Blend the sheets; place, light and texture are set."""
        with attrib(gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT):
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            gl.glEnable(gl.GL_ALPHA_TEST)
            gl.glAlphaFunc(gl.GL_GREATER, LEAST)
            self._list.call()

    def release(self) -> None:
        """Delete the list; may be called twice."""
        self._list.release()
