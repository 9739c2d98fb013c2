"""The map: the island from above in a corner of the window (Map, section 9).

Technique: a second viewport, a quarter of the window's width and height at the upper left, with the
identity as modelview and glOrtho as projection; a blended quad from a display list, and one
GL_POINTS of size 5 where the walker is.
State used: viewport, both matrices, GL_BLEND, GL_TEXTURE_2D; depth test and fog off.
"""

from collections.abc import Hashable
from typing import Self

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, flat_projection, point_size
from framelens.gl.texture import Texture
from landscape.elements.element import Element, Site
from landscape.elements.ground import SHIPPED_HEIGHTS, Ground
from landscape.elements.settings import Settings
from landscape.elements.sun import direction
from landscape.files.assets import Assets, shipped
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.height_colours import chart
from landscape.geometry.height_field import HeightField
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import picture_quad

MOST = 2  # chosen: in a window that is longer than so many times its other side, the map is not


def place_on_map(x: float, z: float, size: float) -> tuple[float, float]:
    """Return where (x, z) in units is on the map, -1..1 to the right and up (section 9.2)."""
    return -1.0 + x / (size / 2), 1.0 - z / (size / 2)


def map_picture(settings: Settings, assets: Assets, field: HeightField) -> np.ndarray:
    """Return the map's picture, uint8 (h, w, 3 or 4): map.png, or a chart of another island.

    The shipped map.png shows the shipped heights; with others, or squeezed, the map is drawn from
    them,
    unless the user's own folder has a map.png.
    """
    path = assets.path("map.png")
    heights = assets.path(settings.ground.height_image, "ground.height_image")
    ours = heights.parent == shipped() and heights.name in SHIPPED_HEIGHTS
    ours = ours and settings.ground.scale_x == settings.ground.scale_z == 1.0
    if ours or path.parent != shipped():
        return read_image(path)
    return chart(field, direction(settings.sun))


class Map(Element[Settings]):
    """The map and the walker's point."""

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return what the constructor uses of the settings, beside the ground."""
        return settings.overlay.map_alpha

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        """Build the map of the ground."""
        return cls(site.settings, site.assets, site.elements[Ground].field)

    def __init__(self, settings: Settings, assets: Assets, field: HeightField) -> None:
        """Load or draw the picture and compile its quad."""
        self.settings = settings
        self._texture = Texture(map_picture(settings, assets, field), repeat=False)
        alpha = settings.overlay.map_alpha

        def send() -> None:
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._texture.bind()
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            gl.glColor4f(1.0, 1.0, 1.0, alpha)
            picture_quad()
            gl.glDisable(gl.GL_BLEND)
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
            gl.glDisable(gl.GL_TEXTURE_2D)

        self._list = DisplayList(send)

    def draw(self, frame: Frame) -> None:
        """Draw the map in its own viewport."""
        width, height = frame.viewport
        x, y = place_on_map(frame.pose.x, frame.pose.z, self.settings.ground.size)
        groups = gl.GL_ENABLE_BIT | gl.GL_VIEWPORT_BIT | gl.GL_CURRENT_BIT | gl.GL_POINT_BIT
        with attrib(groups | gl.GL_COLOR_BUFFER_BIT), flat_projection(-1, 1, -1, 1, 0.1, 2):
            wide, high = min(width, MOST * height) // 4, min(height, MOST * width) // 4
            gl.glViewport(0, height - high if high < height // 4 else 3 * height // 4, wide, high)
            gl.glDisable(gl.GL_DEPTH_TEST)
            gl.glDisable(gl.GL_FOG)
            right, up = frame.detail.shift
            across, down = frame.size
            gl.glTranslatef(
                right / (min(across, MOST * down) / 8), up / (min(down, MOST * across) / 8), 0.0
            )
            self._list.call()
            gl.glColor4f(1.0, 1.0, 1.0, 1.0)
            point_size(5.0 * frame.detail.scale)
            gl.glBegin(gl.GL_POINTS)
            gl.glVertex3f(x, y, -1.0)
            gl.glEnd()

    def release(self) -> None:
        """Delete the list and the texture; may be called twice."""
        self._list.release()
        self._texture.release()
