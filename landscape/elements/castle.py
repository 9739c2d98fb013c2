"""The castle: walls, towers, a gate lit by torches (Castle, section 6).

Techniques: a few meshes built once and drawn several times from one display list; torches as a
parametric cylinder and cone; door and light in layers over the gate wall (castle_gate.py); fire as
an animated sprite sheet (castle_fire.py).
The castle's own frame: the unit square x, z in 0..1, the gate wall at z = 0, y up from the ground.
State used: GL_TEXTURE_2D, GL_LIGHTING, GL_BLEND, polygon offset, the depth mask.
What is wrong with it: a flame is flat, and vanishes from the side (switch ``castle.flame_faces``,
R2); the gate's three layers are fogged three times, so that it is darker than the other walls in
fog (switch ``castle.multitexture``, R11, best/castle/gate.py). The castle of the preset ``best`` is
best/castle/ornate_castle.py.
"""

import math
from collections.abc import Hashable, Iterator
from contextlib import contextmanager
from typing import Self

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, matrix
from framelens.gl.texture import Texture
from landscape.elements.castle_fire import FLAME_Z, TORCHES, draw_fire
from landscape.elements.castle_gate import draw_gate_in_layers
from landscape.elements.element import Element, Site
from landscape.elements.ground import Ground
from landscape.elements.settings import Settings
from landscape.elements.sun import lit
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.doors import Door
from landscape.geometry.height_field import HeightField
from landscape.geometry.masonry import (
    CORNERS,
    MERLON,
    TOWER_RADIUS,
    TOWER_TOP,
    WALL,
    outlines,
    tower_mesh,
    walls_mesh,
)
from landscape.geometry.mesh import Mesh, revolve
from landscape.geometry.obstacles import Obstacle, courtyard
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh

TORCH_BASE, TORCH_TOP = 0.10, 0.215  # chosen: the flame starts at 0.21
DOOR = 0.1, 0.36  # of the door's picture: half its width, and its height


class Castle(Element[Settings]):
    """The castle on its hill."""

    BRICKS = "castle_brick.png"
    SPAN = 1.0  # how often its picture is repeated, times ``castle.brick_repeat``

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        """Build it on the ground."""
        return cls(site.settings, site.assets, site.elements[Ground].field)

    def __init__(self, settings: Settings, assets: Assets, field: HeightField) -> None:
        """Read the textures and compile one display list of everything that does not move."""
        castle = settings.castle
        corners = np.array([(-0.6, -0.6), (-0.6, 0.6), (0.6, -0.6), (0.6, 0.6), (0, 0)])
        stands = field.height(castle.x + corners[:, 0], castle.z + corners[:, 1])
        self.base = (castle.x, float(stands.min()), castle.z)
        self._yaw, self._repeat = castle.yaw, castle.brick_repeat * self.SPAN
        self.settings = settings
        names = (self.BRICKS, "torch_stone.png")
        self._brick, self._stone = (Texture(read_image(assets.path(name), "RGB")) for name in names)
        self._door, self._fire = (
            Texture(read_image(assets.path(name)), repeat=False)
            for name in ("castle_door.png", "fire.png")
        )
        # GL_REPEAT: the moving coordinates exceed 0..1 by a hundredth.
        self._light = Texture(self._light_image(read_image(assets.path("castle_light.png"), "RGB")))
        self._masonry = DisplayList(self._send)

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return the settings that are compiled into the list."""
        castle = settings.castle
        place = castle.x, castle.z, castle.yaw, castle.brick_repeat
        return *place, castle.multitexture, castle.ornate, castle.sides, castle.battlements

    def _light_image(self, image: np.ndarray) -> np.ndarray:
        """Return the light texture's image, uint8 (h, w, 3): in 2006 the file's own."""
        return image

    def _send(self) -> None:
        """Send the bricks, then the stone; a mesh is sent once for each place where it occurs."""
        gl.glEnable(gl.GL_TEXTURE_2D)
        self._brick.bind()
        self._send_bricks()
        self._stone.bind()
        holder = revolve([(0.008, 0.0), (0.008, 0.075)], 10, (1, 1))
        cone = revolve([(0.008, 0.0), (0.024, 0.04), (0.014, 0.04)], 10, (2, 1))
        for x in TORCHES:
            for mesh, y in ((holder, TORCH_BASE), (cone, TORCH_TOP - 0.04)):
                with matrix():
                    gl.glTranslatef(x, y, FLAME_Z)
                    draw_mesh(mesh)
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
        gl.glDisable(gl.GL_TEXTURE_2D)

    def _walls(self) -> Mesh:
        return walls_mesh(self._repeat, self.settings.castle.battlements)

    def _send_bricks(self) -> None:
        """Send the walls, and one tower four times."""
        draw_mesh(self._walls())
        castle = self.settings.castle
        tower = tower_mesh(self._repeat, castle.sides, castle.battlements)
        for x, z in CORNERS:
            with matrix():
                gl.glTranslatef(x, 0.0, z)
                draw_mesh(tower)

    def draw(self, frame: Frame) -> None:
        """Draw the castle, the door, the light on the wall, and the fire."""
        with self._placed():
            self._masonry.call()
            self._draw_gate(frame.kt)
            self._draw_fire(frame)

    @contextmanager
    def _placed(self) -> Iterator[None]:
        """Let the block draw in the castle's own frame, lit, and restore what it changes."""
        groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_COLOR_BUFFER_BIT
        groups |= gl.GL_DEPTH_BUFFER_BIT | gl.GL_POLYGON_BIT | gl.GL_LIGHTING_BIT
        with matrix(), attrib(groups):
            gl.glTranslatef(*self.base)
            gl.glRotatef(self._yaw, 0.0, 1.0, 0.0)
            gl.glTranslatef(-0.5, 0.0, -0.5)
            gl.glColor4f(1.0, 1.0, 1.0, 1.0)
            lit(self.settings.shading)
            yield

    def _draw_gate(self, kt: float) -> None:
        draw_gate_in_layers(self._door, self._light, kt)

    def _draw_fire(self, frame: Frame) -> None:
        draw_fire(self._fire, frame.kt, self._inside(frame.eye), self.settings.castle.flame_faces)

    def _inside(self, point: np.ndarray) -> tuple[float, float]:
        """Return x, z of a point (3,) in the castle's own frame: the inverse of draw's matrices."""
        yaw = math.radians(self._yaw)
        x, z = float(point[0]) - self.base[0], float(point[2]) - self.base[2]
        across = x * math.cos(yaw) - z * math.sin(yaw)
        return across + 0.5, x * math.sin(yaw) + z * math.cos(yaw) + 0.5

    def outside(self, points: np.ndarray) -> np.ndarray:
        """Return the island's x, z (n, 2) of places (n, 2) in the castle's own frame."""
        yaw = math.radians(self._yaw)
        turn = np.array([(math.cos(yaw), math.sin(yaw)), (-math.sin(yaw), math.cos(yaw))])
        return np.asarray((points - 0.5) @ turn.T + (self.base[0], self.base[2]))

    def door(self, scene: str, to: str, says: str) -> Door:
        """Return the castle's door, which leads to the door ``to`` of a scene; see geometry/doors.

        In 2006 it was a picture of a shut door.
        """
        before, behind = self.outside(np.array([(0.5, 0.0), (0.5, 1.0)]))
        yaw = math.degrees(math.atan2(behind[0] - before[0], before[1] - behind[1])) % 360.0
        y, (half, height) = self.base[1], DOOR
        place = float(before[0]), float(before[1]), yaw
        return Door("castle", *place, half, y, y + height, scene, to, says, self.is_open)

    @property
    def is_open(self) -> bool:
        """Whether the door is open."""
        return False

    def outlines(self, step: float) -> list[tuple[np.ndarray, float, float]]:
        """Return its outlines on the ground, from which shadows are cast: see masonry.outlines."""
        return outlines(step)

    def obstacles(self) -> tuple[Obstacle, ...]:
        """Return what the walker cannot pass: walls and towers.

        The door is shut. With ``walk.solid`` it opens to a walker in the yard, who came by flying.
        """
        x, y, z = self.base
        towers = TOWER_RADIUS, y + TOWER_TOP
        door = (DOOR[0], y + DOOR[1]) if self.settings.walk.solid else None
        return courtyard(x, z, self._yaw, WALL, y + 1 + MERLON, towers, door)

    def release(self) -> None:
        """Delete the list and the textures; may be called twice."""
        self._masonry.release()
        for texture in (self._brick, self._stone, self._door, self._fire, self._light):
            texture.release()
