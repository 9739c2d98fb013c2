"""Three rabbits in a row, of which a lens shows one sharp (SIGGRAPH 1997, depth of field).

Technique: the light that meets in one point of a photograph came through all of the lens. Each
sample moves the eye to another point of the lens, and shears the frustum so that the plane of focus
stays where it is in the picture; the accumulation buffer holds the mean (accumulation.py). A point
at distance d, with the focus at f, becomes a disc: lens * |1/f - 1/d| wide at distance 1.
What is wrong without its safeguard: without ``exhibits.focus_shear`` the eye moves and the frustum
does not; then all is blurred, and what is near the most.
State used: GL_LIGHT2, the accumulation's.
"""

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import matrix
from landscape.elements.animal import read_animal
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.geometry.clustering import clustered
from landscape.geometry.mesh import gathered, scaled
from landscape.gl.accumulating import disc
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh
from landscape.hall import plan
from landscape.hall.exhibits import niche
from landscape.hall.exhibits.accumulation import Accumulation
from landscape.hall.exhibits.exhibit import Exhibit
from landscape.hall.exhibits.niche import FOCUS, MIDDLE, TOP, lit_by, shiny
from landscape.hall.settings import Settings

SIZE = 0.034  # chosen: units: half the length of a rabbit
CELL = 0.105  # chosen: side of the cubes whose vertices are merged, of a mesh of 2
# Chosen: x and z of the rabbits from the middle of the pedestal, and their colours.
ROW = ((0.026, 0.050), (-0.002, 0.0), (-0.034, -0.048))
COLOURS = ((0.78, 0.34, 0.20), (0.88, 0.70, 0.30), (0.34, 0.50, 0.62))
YAW = 20.0  # degrees, chosen


def lens(offset: tuple[float, float], focus: float, shear: bool = True) -> np.ndarray:
    """Return the matrix (4, 4) in eye space that moves the eye by ``offset`` to the right and up.

    With ``shear`` it leaves all points at the distance ``focus`` where they are, as
    glFrustum(left - dx * near / focus, ...) after glTranslatef(-dx, -dy, 0) does.
    """
    found = np.eye(4)
    for axis, moved in enumerate(offset):
        found[axis, 3] = -moved
        if shear:
            # x - dx + dx * (-z / focus)
            found[axis, 2] = -moved / focus
    return found


class DepthOfField(Exhibit):
    """The three rabbits."""

    def __init__(self, settings: Settings, assets: Assets, accumulation: Accumulation | None):
        """Compile a rabbit; without ``accumulation`` all are sharp."""
        self.settings, self._accumulation = settings, accumulation
        mesh = scaled(
            gathered(clustered(read_animal(assets, "rabbit.ply", "rabbit.mesh"), CELL)), SIZE
        )
        self._lowest = float(mesh.vertices[:, 1].min())
        self._list = DisplayList(lambda: draw_mesh(mesh))

    def draw_plain(self, frame: Frame) -> None:
        """Draw all rabbits sharp."""
        with lit_by(niche.lamp(FOCUS)):
            self._send()

    def draw(self, frame: Frame) -> None:
        """Draw the rabbits as the lens shows them."""
        values, accumulation = self.settings.exhibits, self._accumulation
        count, z = values.focus_samples, plan.ALCOVES[FOCUS]
        middle = np.array([[MIDDLE, TOP + SIZE, z]])
        focus = -float(frame.depth(middle)[0])
        if accumulation is None or count == 1 or focus < 0.05:
            self.draw_plain(frame)
            return
        offsets = (disc(count) * values.focus_lens).tolist()
        lenses = [lens((x, y), focus, values.focus_shear) for x, y in offsets]

        def draw(number: int) -> None:
            with lit_by(niche.lamp(FOCUS)):
                self._send()

        low, high = (MIDDLE - 0.06, TOP - 0.006, z - 0.09), (MIDDLE + 0.06, TOP + 0.068, z + 0.088)
        if not accumulation.gather_view(frame, low, high, lenses, draw):
            self.draw_plain(frame)

    def _send(self) -> None:
        """Send the rabbits."""
        shiny(0.35, 20.0)
        for (x, z), colour in zip(ROW, COLOURS, strict=True):
            gl.glColor3f(*colour)
            with matrix():
                gl.glTranslatef(MIDDLE + x, TOP - self._lowest, plan.ALCOVES[FOCUS] + z)
                gl.glRotatef(YAW, 0.0, 1.0, 0.0)
                self._list.call()

    def release(self) -> None:
        """Delete the list; may be called twice."""
        self._list.release()
