"""The map: the blocks from above in a corner of the window (Map, section 9).

Technique: each column of blocks is a texel, with the mean colour of its top block's tile, brighter
where the column to its north is lower and darker where it is higher; water by its depth. Of a
large world only every second column is one. A second viewport at the upper left has the picture,
and an arrow where the walker is and looks.
State used: viewport, both matrices, GL_TEXTURE_2D; depth test and fog off.
What is not drawn: blocks that change while the map is shown; off and on again, it has them.
"""

from typing import Self

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, flat_projection
from framelens.gl.texture import Texture
from landscape.elements.element import Element, Site
from landscape.elements.map import place_on_map
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.geometry.height_colours import DEPTHS
from landscape.gl.draw import picture_quad
from landscape.voxel.blocks import BLOCKS, SOLID, looked_up
from landscape.voxel.land import Land
from landscape.voxel.settings import Settings
from landscape.voxel.tiles import tiles
from landscape.voxel.world import World

PART = 0.3  # chosen, of the window's height
GAP = 0.02  # chosen, of the window's height
STEP = 0.12  # chosen: how much brighter or darker a column is for each level of difference
STEPS = 3  # chosen: levels of difference beyond which it is no brighter or darker
AT_ONCE = 32  # columns from west to east, chosen: as many are looked at at once
MOST = 1024  # texels on each side, chosen: more would not be seen
DEEP = 12  # chosen: blocks of water from which it has its darkest colour
ARROW = ((0.0, 1.0), (0.6, -0.8), (0.0, -0.4), (-0.6, -0.8))
OUTLINE, INSIDE = (0.09, (0.1, 0.05, 0.05)), (0.06, (1.0, 0.95, 0.85))  # sizes of 1 and colours
INNER = 1.0 - OUTLINE[0]  # where the arrow is whole: beyond the map's border it waits at its edge


def highest(blocks: np.ndarray) -> np.ndarray:
    """Return the level of the uppermost solid block, int16 (n, m), of columns [x, z, y]."""
    found = np.empty(blocks.shape[:2], np.int16)
    for start in range(0, len(blocks), AT_ONCE):
        solid = looked_up(SOLID, blocks[start : start + AT_ONCE])
        found[start : start + AT_ONCE] = solid.shape[2] - 1 - solid[:, :, ::-1].argmax(axis=2)
    return found


def _colours(assets: Assets) -> np.ndarray:
    """Return the mean colours (blocks, 3) of the blocks' upper faces, 0 to 255."""
    pictures = tiles(assets)
    colours = np.zeros((len(BLOCKS), 3))
    for number, block in enumerate(BLOCKS):
        if SOLID[number]:
            colours[number] = pictures[block.top][..., :3].mean(axis=(0, 1)) * block.tint / 255.0
    return colours


def _of_water(depth: np.ndarray) -> np.ndarray:
    """Return the colours (n, m, 3) of water so many blocks deep (n, m)."""
    sea = [np.interp(depth, [1, DEEP / 3, DEEP], DEPTHS[:, c]) for c in range(3)]
    return np.stack(sea, axis=2)


def map_picture(world: World, assets: Assets) -> np.ndarray:
    """Return the map, uint8 (n, n, 3): north at the top, west at the left.

    n is the world's side, or a fraction of it if that is more than MOST.
    """
    colours = _colours(assets)
    step = -(-world.side // MOST)
    columns = world.blocks[::step, ::step]
    side = len(columns)
    whole = np.empty((side, side, 3), np.uint8)
    for start in range(0, side, AT_ONCE):
        blocks = columns[start : start + AT_ONCE]
        top = highest(blocks).T  # [z, x] from here on
        x, z = np.meshgrid(np.arange(len(blocks)), np.arange(side))
        north = np.vstack([top[:1], top[:-1]])
        slope = np.clip(top - north, -STEPS, STEPS)[..., None]
        land = colours[blocks[x, z, top]] * (1.0 + STEP * slope)
        depth = world.sea - 1 - top
        found = np.where(depth[..., None] > 0, _of_water(depth), land)
        whole[:, start : start + AT_ONCE] = np.clip(found, 0, 255)

    return whole


class Map(Element[Settings]):
    """The map and the walker's arrow."""

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        """Build the map of the land."""
        return cls(site.settings, site.assets, site.elements[Land])

    def __init__(self, settings: Settings, assets: Assets, land: Land) -> None:
        """Draw no picture yet: changed blocks may follow."""
        self.settings = settings
        self._assets = assets
        self._land = land
        self._texture: Texture | None = None
        self._shows = 0  # the land's version of which the picture is

    def take(self, settings: Settings) -> None:
        """Take other settings; an old picture of the land that is no longer shown is deleted."""
        if not settings.overlay.map and self._shows != self._land.version:
            self.release()
        self.settings = settings

    def draw(self, frame: Frame) -> None:
        """Draw the map in its own viewport, if it is on."""
        if not self.settings.overlay.map:
            return
        if self._texture is None:
            self._texture = Texture(map_picture(self._land.world, self._assets), repeat=False)
            self._shows = self._land.version
        height = frame.viewport[1]
        side, gap = round(PART * height), round(GAP * height)
        place = np.clip(
            place_on_map(frame.pose.x, frame.pose.z, self._land.world.size), -INNER, INNER
        )
        groups = gl.GL_ENABLE_BIT | gl.GL_VIEWPORT_BIT | gl.GL_CURRENT_BIT | gl.GL_TEXTURE_BIT

        with attrib(groups), flat_projection(-1, 1, -1, 1, 0.1, 2):
            gl.glViewport(gap, height - gap - side, side, side)
            gl.glDisable(gl.GL_DEPTH_TEST)
            gl.glDisable(gl.GL_FOG)
            right, up = frame.detail.shift
            gl.glTranslatef(
                2 * right / (PART * frame.size[1]), 2 * up / (PART * frame.size[1]), 0.0
            )
            gl.glColor3f(1.0, 1.0, 1.0)
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._texture.bind()
            picture_quad()
            gl.glDisable(gl.GL_TEXTURE_2D)
            gl.glTranslatef(*place, 0.0)
            gl.glRotatef(-frame.pose.yaw, 0.0, 0.0, 1.0)
            for size, colour in (OUTLINE, INSIDE):
                gl.glColor3f(*colour)
                gl.glBegin(gl.GL_TRIANGLE_FAN)
                for k in (2, 3, 0, 1):
                    gl.glVertex3f(ARROW[k][0] * size, ARROW[k][1] * size, -1.0)
                gl.glEnd()

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        if self._texture is not None:
            self._texture.release()
            self._texture = None
