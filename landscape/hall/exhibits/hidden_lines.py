"""The dragon as an engraving: lines without those that it hides (SIGGRAPH 1997, hidden lines).

Technique: the triangles are filled with the paper's colour, which hides what is behind them. Then
they are drawn again as lines, with GL_LEQUAL. The fill is pushed back a little by
GL_POLYGON_OFFSET_FILL (OpenGL 1.1): by ``FACTOR`` times its slope, as the depth of a line's pixel
may lie that much off the triangle, and ``STEPS`` of the depth buffer.
What is wrong without its safeguard: without ``exhibits.lines_offset`` line and fill have almost the
same depth, and roundings decide which is in front: lines are broken as a seam is stitched.
State used: GL_POLYGON_OFFSET_FILL, the polygon mode, depth test, culling.
"""

from collections.abc import Callable

from framelens.gl.seam import gl
from framelens.gl.state import attrib, matrix
from landscape.elements.animal import read_animal
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.geometry.clustering import clustered
from landscape.geometry.mesh import scaled
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh
from landscape.hall import plan
from landscape.hall.exhibits.exhibit import Exhibit
from landscape.hall.exhibits.niche import LINES, MIDDLE, TOP
from landscape.hall.settings import Settings

FACTOR, STEPS = 1.0, 2.0  # chosen: see glPolygonOffset
SIZE = 0.070  # chosen: half the dragon's length
CELL, FAR_CELL = 0.07, 0.11  # chosen: side of the merged cubes, of a mesh of 2, near and far
FAR = 1.25  # chosen: units from which lines are so close that fewer look the same
YAW, TURN = 100.0, 0.25  # chosen: degrees, and degrees in a kt
# Chosen.
PAPER = (0.86, 0.79, 0.64)
INK = (0.20, 0.12, 0.07)
FRAME = (0.24, 0.15, 0.09)

# Chosen: x, half the width, lower and upper edge, and border of the sheet of paper behind it.
SHEET = (0.822, 0.098, TOP - 0.03, TOP + 0.122, 0.005)


def draw_lines(send: Callable[[], None], offset: bool) -> None:
    """Draw what ``send`` sends as INK lines on PAPER, without hidden ones."""
    with attrib(gl.GL_POLYGON_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_CURRENT_BIT):
        gl.glDepthFunc(gl.GL_LEQUAL)
        if offset:
            gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
            gl.glPolygonOffset(FACTOR, STEPS)
        gl.glColor3f(*PAPER)
        send()
        gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_LINE)
        gl.glColor3f(*INK)
        send()
    gl.glColor4f(1.0, 1.0, 1.0, 1.0)


class HiddenLines(Exhibit):
    """The engraved dragon before its sheet of paper."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Compile dragon and paper."""
        self.settings = settings
        unit = read_animal(assets, "dragon.ply", "dragon.mesh")
        mesh, simple = (scaled(clustered(unit, cell), SIZE) for cell in (CELL, FAR_CELL))
        self._lowest = float(mesh.vertices[:, 1].min())
        self._dragon = DisplayList(lambda: draw_mesh(mesh))
        self._far = DisplayList(lambda: draw_mesh(simple))
        self._sheet = DisplayList(send_sheet)

    def draw_plain(self, frame: Frame) -> None:
        """Draw it from afar, or mirrored: as from near."""
        self.draw(frame)

    def draw(self, frame: Frame) -> None:
        """Draw the paper and the dragon in front of it."""
        x, z = frame.pose.x - MIDDLE, frame.pose.z - plan.ALCOVES[LINES]
        dragon = self._far if x * x + z * z > FAR * FAR else self._dragon
        with attrib(gl.GL_CURRENT_BIT):
            self._sheet.call()
        with matrix():
            gl.glTranslatef(MIDDLE, TOP - self._lowest, plan.ALCOVES[LINES])
            gl.glRotatef(YAW + TURN * frame.kt, 0.0, 1.0, 0.0)
            draw_lines(dragon.call, self.settings.exhibits.lines_offset)

    def release(self) -> None:
        """Delete the lists; may be called twice."""
        self._dragon.release()
        self._far.release()
        self._sheet.release()


def send_sheet() -> None:
    """Send the sheet of paper, seen from the east, and its frame."""
    x, half, low, high, border = SHEET
    z = plan.ALCOVES[LINES]
    gl.glBegin(gl.GL_QUADS)
    for colour, forward, edge in ((FRAME, 0.0, border), (PAPER, 0.0015, 0.0)):
        gl.glColor3f(*colour)
        for side, top in ((1, False), (-1, False), (-1, True), (1, True)):
            y = high + edge if top else low - edge
            gl.glVertex3f(x + forward, y, z + side * (half + edge))
    gl.glEnd()
