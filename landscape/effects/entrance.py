"""The entrance: daylight, a meadow and the sky, seen from the hall through its open door.

Technique: unlit, a picture of the sky behind a meadow whose colours are interpolated up to the haze
at the horizon.
State used: GL_TEXTURE_2D, GL_LIGHTING.
What is wrong with it: what one sees there is a few steps away, not miles.
"""

from landscape.effects import plan
from landscape.effects.settings import Settings
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.doors import Door
from landscape.gl.calls import gl
from landscape.gl.display_list import DisplayList
from landscape.gl.state import attrib
from landscape.gl.texture import Texture
from landscape.languages import Texts

SIGNS: Texts = {"door": "the door leads out to the island"}
# All chosen.
FAR, WIDE, HIGH = 0.5, 0.7, 0.75  # of the picture of the sky: how far, half its width, its top
HORIZON = 0.1  # its lower edge: the height of a walker's eye
MEADOW, HAZE = (0.36, 0.42, 0.20), (0.66, 0.74, 0.72)


def door() -> Door:
    """Return the door of the hall, which leads out of the castle."""
    place = plan.AXIS, plan.INSIDE.south, 180.0, plan.DOOR_HALF
    return Door("door", *place, -1.0, plan.DOOR_TOP, "island", "castle", SIGNS["door"])


class Entrance:
    """What is seen through the door."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the sky's picture and compile the display list."""
        self._sky = Texture(read_image(assets.path("sky_south.png"), "RGB"), repeat=False)
        self._list = DisplayList(self._send)

    def _send(self) -> None:
        """Send meadow and sky."""
        west, east, end = plan.AXIS - WIDE, plan.AXIS + WIDE, plan.INSIDE.south + FAR
        gl.glDisable(gl.GL_LIGHTING)
        gl.glDisable(gl.GL_TEXTURE_2D)
        gl.glBegin(gl.GL_QUADS)
        for colour, y, z, row in (
            (MEADOW, 0.0, plan.INSIDE.south + plan.WALL, (west, east)),
            (HAZE, HORIZON, end, (east, west)),
        ):
            gl.glColor3f(*colour)
            for x in row:
                gl.glVertex3f(x, y, z)
        gl.glEnd()
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glColor3f(1.0, 1.0, 1.0)
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
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def apply(self, settings: Settings) -> bool:
        """Apply new settings; nothing depends on them."""
        return True

    def draw(self, frame: Frame) -> None:
        """Draw what is seen through the door."""
        with attrib(gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT):
            self._list.call()

    def release(self) -> None:
        """Delete the list and the texture; may be called twice."""
        self._list.release()
        self._sky.release()
