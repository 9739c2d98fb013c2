"""The entrance: daylight, a path through a meadow, trees and the sky, seen through the open door.

Technique: a stage set, unlit. A picture of the sky stands behind a meadow that rises to the height
of the eye, so that it ends at the horizon; the colours of its vertices, of grass, of the path and
of the haze far away, multiply a texture of detail, doubled by GL_RGB_SCALE (OpenGL 1.3). Trees are
upright quads, cut out by GL_ALPHA_TEST, which needs no order.
State used: GL_TEXTURE_2D, GL_COMBINE, GL_ALPHA_TEST, GL_LIGHTING.
What is wrong with it: what one sees there is a few steps away, not miles.
"""

import numpy as np

from framelens.base.texts import Texts
from framelens.gl.seam import gl
from framelens.gl.state import attrib, multiply
from framelens.gl.texture import Texture
from landscape.elements.element import Element
from landscape.elements.sky_box import FACES, set_files
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.files.smooth import read_smooth
from landscape.frame import Frame
from landscape.geometry.doors import Door
from landscape.gl.display_list import DisplayList
from landscape.hall import plan
from landscape.hall.settings import Settings

SIGNS: Texts = {"door": "the door leads out to the island"}
# All chosen.
# The picture of the sky.
FAR = 0.5  # behind the door
WIDE = 0.7  # half its width
HIGH = 0.75  # its top
HORIZON = 0.1  # its lower edge: the height of a walker's eye

MEADOW = (0.40, 0.50, 0.20)
PATH = (0.78, 0.68, 0.48)
HAZE = (0.66, 0.74, 0.66)
ROWS = (0.0, 0.12, 0.25, 0.4, 0.55, 0.7, 0.85, 1.0)  # of the meadow, from the door to the horizon
HALF_PATH = 0.030, 0.003  # half the path's width at the door and at the horizon
BEND = 0.045  # how far the path bends to the east on its way
VERGE = 1.6  # half widths of the path where the grass beside it is whole
BLADES = 9.0  # textures of detail per unit
# Trees: texture, x from the axis, how far towards the horizon, height.
TREES = (
    ("tree_broadleaf.png", -0.46, 0.97, 0.15),
    ("tree_birch.png", -0.30, 0.90, 0.17),
    ("tree_broadleaf.png", -0.13, 0.97, 0.10),
    ("tree_birch.png", -0.07, 0.99, 0.06),
    ("tree_broadleaf.png", 0.075, 0.98, 0.07),
    ("tree_birch.png", 0.12, 0.93, 0.13),
    ("tree_broadleaf.png", 0.24, 0.92, 0.16),
    ("tree_broadleaf.png", 0.47, 0.96, 0.14),
)
CUT = 0.4  # alpha below which a tree's texel is left out


def door() -> Door:
    """Return the door of the hall, which leads out of the castle."""
    place = plan.AXIS, plan.INSIDE.south, 180.0, plan.DOOR_HALF
    return Door("door", *place, -1.0, plan.DOOR_TOP, "island", "castle", SIGNS["door"])


def _meadow_columns(t: np.ndarray) -> np.ndarray:
    """Return how far from the door's middle the columns are, in rows (n, 1) of 0..1: (n, 6).

    A path with verges leads through the meadow, and bends.
    """
    near, far = HALF_PATH
    half = near + (far - near) * t
    wide = np.full_like(half, WIDE)
    x = np.concatenate([-wide, -VERGE * half, -half, half, VERGE * half, wide], axis=1)
    x[:, 1:-1] += BEND * np.sin(np.pi * t)
    return x


def meadow() -> tuple[np.ndarray, np.ndarray]:
    """Return the meadow's vertices (rows, columns, 3), from the door to the horizon, and colours.

    Columns run from the west to the east; the colours (rows, columns, 3) are RGB.
    """
    t = np.array(ROWS)[:, None]
    x = _meadow_columns(t)
    points = np.stack(
        [
            plan.AXIS + x,
            np.broadcast_to(HORIZON * t, x.shape),
            np.broadcast_to(plan.INSIDE.south + plan.WALL + (FAR - plan.WALL) * t, x.shape),
        ],
        axis=-1,
    )
    on_path = np.array([0, 0, 1, 1, 0, 0])[None, :, None]
    ground = np.array(MEADOW) + on_path * (np.array(PATH) - np.array(MEADOW))
    colours = ground + (t[..., None] ** 2) * (np.array(HAZE) - ground)
    return points, colours


class Entrance(Element[Settings]):
    """What is seen through the door."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the pictures and compile the display list."""
        self.settings = settings
        south = set_files("day", True, assets)[FACES.index("south")]
        self._sky = Texture(read_smooth(south), repeat=False)
        self._detail = Texture(read_image(assets.path("ground_detail.png"), "RGB"))
        self._trees = {
            name: Texture(read_image(assets.path(name), "RGBA"), repeat=False)
            for name in sorted({tree[0] for tree in TREES})
        }
        self._list = DisplayList(self._send)

    def _send(self) -> None:
        """Send sky, meadow and trees."""
        gl.glDisable(gl.GL_LIGHTING)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glColor3f(1.0, 1.0, 1.0)
        self._send_sky()
        self._send_meadow()
        gl.glEnable(gl.GL_ALPHA_TEST)
        gl.glAlphaFunc(gl.GL_GREATER, CUT)
        gl.glColor3f(1.0, 1.0, 1.0)
        for tree in TREES:
            self._send_tree(*tree)
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def _send_meadow(self) -> None:
        points, colours = meadow()
        self._detail.bind()
        multiply(2.0)
        for row in range(len(points) - 1):
            gl.glBegin(gl.GL_QUAD_STRIP)
            for column in range(points.shape[1]):
                for r in (row + 1, row):
                    x, y, z = points[r, column].tolist()
                    gl.glColor3f(*colours[r, column].tolist())
                    gl.glTexCoord2f(BLADES * x, BLADES * z)
                    gl.glVertex3f(x, y, z)
            gl.glEnd()
        multiply()

    def _send_tree(self, name: str, aside: float, along: float, high: float) -> None:
        self._trees[name].bind()
        x, z = plan.AXIS + aside, plan.INSIDE.south + plan.WALL + (FAR - plan.WALL) * along
        gl.glBegin(gl.GL_QUADS)
        for s, t, east, up in ((0, 1, 1, 0), (1, 1, -1, 0), (1, 0, -1, 1), (0, 0, 1, 1)):
            gl.glTexCoord2f(float(s), float(t))
            gl.glVertex3f(x + east * high / 2, HORIZON * along + up * high, z)
        gl.glEnd()

    def _send_sky(self) -> None:
        west = plan.AXIS - WIDE
        east = plan.AXIS + WIDE
        end = plan.INSIDE.south + FAR
        self._sky.bind()
        gl.glBegin(gl.GL_QUADS)
        # Someone who looks south has the west at his right.
        for s, t, x, y in (
            (0.0, 0.0, east, HIGH),
            (0.0, 1.0, east, HORIZON),
            (1.0, 1.0, west, HORIZON),
            (1.0, 0.0, west, HIGH),
        ):
            gl.glTexCoord2f(s, t)
            gl.glVertex3f(x, y, end)
        gl.glEnd()

    def draw(self, frame: Frame) -> None:
        """Draw what is seen through the door."""
        groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_TEXTURE_BIT | gl.GL_COLOR_BUFFER_BIT
        with attrib(groups):
            self._list.call()

    def release(self) -> None:
        """Delete the list and the textures; may be called twice."""
        self._list.release()
        for texture in (self._sky, self._detail, *self._trees.values()):
            texture.release()
