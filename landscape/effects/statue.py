"""The statue: the sea dragon, in bronze, on its plinth.

Technique: a lit mesh in a display list. Later effects draw the same list: its shadows, its
reflections of the hall. Its mirror image is a coarser mesh (vertex clustering) of side 2, which
glScalef brings to its size: that scales the normals, too, and GL_NORMALIZE makes them unit vectors
again.
State used: GL_LIGHTING, GL_CULL_FACE, GL_NORMALIZE.
"""

from landscape.effects import plan
from landscape.effects.settings import Settings
from landscape.elements.animal import read_animal
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.geometry.clustering import clustered
from landscape.geometry.mesh import gathered, scaled
from landscape.gl.calls import gl
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh
from landscape.gl.state import attrib, front_faces, matrix

YAW = -62.0  # degrees, chosen: the head looks past the viewer at the door
BRONZE = (0.72, 0.50, 0.22)  # chosen
COARSE = 0.02  # chosen: side of the cubes whose vertices are merged, of a mesh of 2


class Statue:
    """The statue."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the mesh and compile its display list."""
        self._settings = settings
        unit = read_animal(assets, "dragon.ply", "dragon.mesh")
        mesh, coarse = scaled(gathered(unit), plan.STATUE_SCALE), gathered(clustered(unit, COARSE))
        lowest = float(mesh.vertices[:, 1].min())
        (x, z), (_, top) = plan.STATUE, plan.PLINTH
        self._place = x, top - lowest, z
        self._list = DisplayList(lambda: draw_mesh(mesh))
        self._coarse = DisplayList(lambda: draw_mesh(coarse))

    def apply(self, settings: Settings) -> bool:
        """Apply new settings; nothing built depends on them."""
        self._settings = settings
        return True

    def draw(self, frame: Frame) -> None:
        """Draw the statue, lit."""
        with attrib(gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT), front_faces():
            gl.glEnable(gl.GL_LIGHTING)
            gl.glEnable(gl.GL_COLOR_MATERIAL)
            gl.glColor3f(*BRONZE)
            if frame.mirrored:
                if self._settings.mirror.normals:
                    gl.glEnable(gl.GL_NORMALIZE)
                self.send_coarse()
            else:
                self.send()

    def send(self) -> None:
        """Send the mesh at its place, whatever the state."""
        with matrix():
            gl.glTranslatef(*self._place)
            gl.glRotatef(YAW, 0.0, 1.0, 0.0)
            self._list.call()

    def send_coarse(self) -> None:
        """Send a coarser mesh at its place, its normals longer than 1."""
        with matrix():
            gl.glTranslatef(*self._place)
            gl.glRotatef(YAW, 0.0, 1.0, 0.0)
            gl.glScalef(*(plan.STATUE_SCALE,) * 3)
            self._coarse.call()

    def release(self) -> None:
        """Delete the lists; may be called twice."""
        self._list.release()
        self._coarse.release()
