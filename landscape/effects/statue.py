"""The statue: the sea dragon, in bronze, on its plinth.

Technique: a lit mesh in a display list. Later effects draw the same list: its mirror image, its
shadows, its reflections of the hall.
State used: GL_LIGHTING, GL_CULL_FACE.
"""

from landscape.effects import plan
from landscape.effects.settings import Settings
from landscape.elements.animal import read_animal
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.geometry.mesh import gathered, scaled
from landscape.gl.calls import gl
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh
from landscape.gl.state import attrib, front_faces, matrix

YAW = -62.0  # degrees, chosen: the head looks past the viewer at the door
BRONZE = (0.72, 0.50, 0.22)  # chosen


class Statue:
    """The statue."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the mesh and compile its display list."""
        mesh = scaled(gathered(read_animal(assets, "dragon.ply", "dragon.mesh")), plan.STATUE_SCALE)
        lowest = float(mesh.vertices[:, 1].min())
        (x, z), (_, top) = plan.STATUE, plan.PLINTH
        self._place = x, top - lowest, z
        self._list = DisplayList(lambda: draw_mesh(mesh))

    def apply(self, settings: Settings) -> bool:
        """Apply new settings; nothing depends on them."""
        return True

    def draw(self, frame: Frame) -> None:
        """Draw the statue, lit."""
        with attrib(gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT), front_faces():
            gl.glEnable(gl.GL_LIGHTING)
            gl.glEnable(gl.GL_COLOR_MATERIAL)
            gl.glColor3f(*BRONZE)
            self.send()

    def send(self) -> None:
        """Send the mesh at its place, whatever the state."""
        with matrix():
            gl.glTranslatef(*self._place)
            gl.glRotatef(YAW, 0.0, 1.0, 0.0)
            self._list.call()

    def release(self) -> None:
        """Delete the list; may be called twice."""
        self._list.release()
