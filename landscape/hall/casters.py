"""What casts shadows besides the statue: pillars, and torches on their stands.

Technique: one coarse mesh of all of it in a display list, as a shadow shows only outlines
(``shadow.casters``). It has no normals, colours or coordinates, and is sent under the matrix that
flattens it.
State used: none of its own.
"""

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import client_arrays
from landscape.geometry.mesh import Mesh, merged
from landscape.gl.display_list import DisplayList
from landscape.hall import plan
from landscape.hall.levels import LEVELS
from landscape.hall.ornaments import pillar, torches
from landscape.hall.surfaces import coarser, mesh


def standing() -> Mesh:
    """Return pillars and torches as one coarse mesh."""
    surfaces = [part for x in plan.ROWS for z in plan.BAYS[1:-1] for part in pillar(x, z)]
    parts = []
    for surface in (*surfaces, *torches()):
        simple, _ = coarser(surface, surface.on_material, LEVELS[-1])
        parts.append(mesh(simple, 1.0, simple.on_material))
    return merged(parts)


class Casters:
    """The pillars and torches, as what casts a shadow."""

    def __init__(self) -> None:
        """Compile the mesh."""
        whole = standing()
        vertices = np.ascontiguousarray(whole.vertices)

        def send() -> None:
            with client_arrays(vertices):
                count = whole.triangles.size
                gl.glDrawElements(gl.GL_TRIANGLES, count, gl.GL_UNSIGNED_INT, whole.triangles)

        self._list = DisplayList(send)

    def send(self) -> None:
        """Send the mesh as it is."""
        self._list.call()

    def release(self) -> None:
        """Delete the list; may be called twice."""
        self._list.release()
