"""The castle: walls, towers, a gate lit by torches (Castle, section 6).

Techniques: a few meshes built once and drawn several times; a door texture with a transparent
surround, blended over the bricks; a light texture multiplied over both by
glBlendFunc(GL_ZERO, GL_SRC_COLOR), whose texture coordinates move at two edges, so that the light
flickers; torches as a parametric cylinder and cone; fire as an animated 4x4 sprite sheet on a quad.
The castle's own frame: the unit square x, z in 0..1, the gate wall at z = 0, y up from the ground.
State used: GL_TEXTURE_2D, GL_LIGHTING, GL_BLEND, polygon offset, the depth mask.
What is wrong with it: a flame is flat, and vanishes from the side (switch ``castle.flame_faces``,
R2); the gate's three layers are fogged three times, so that it is darker than the other walls in
fog (switch ``castle.multitexture``, R11, best/ornate/gate.py). The castle of the preset ``best`` is
best/ornate/ornate_castle.py.
"""

import math

import numpy as np

from landscape.elements.best.terrain.shadows import ShadowMap, cast_outlines, shade_foot
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.height_field import HeightField
from landscape.geometry.masonry import (
    CORNERS,
    MERLON,
    TOWER_RADIUS,
    TOWER_TOP,
    WALL,
    on_edges,
    outlines,
    tower_mesh,
    walls_mesh,
)
from landscape.geometry.mesh import Mesh, revolve
from landscape.geometry.obstacles import Obstacle, courtyard
from landscape.gl.calls import gl
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh
from landscape.gl.state import attrib, matrix
from landscape.gl.texture import Texture
from landscape.settings import Settings

TORCHES = (0.27, 0.75)  # section 6.1: 0.27, and 0.48 farther
TORCH_BASE, TORCH_TOP = 0.10, 0.215  # chosen: the flame starts at 0.21
FLAME_Z = -0.07  # section 6.1
FOOT_SHADE = 0.22  # chosen: units from the walls within which they block part of the sky


def flame_frame(kt: float) -> tuple[int, int]:
    """Return column and row of the sprite sheet's frame: int(kt * 0.5) mod 16 (section 6.1)."""
    number = int(kt * 0.5)
    return number % 4, (number // 4) % 4


def flame_across(eye: tuple[float, float], x: float, faces: bool) -> tuple[float, float]:
    """Return the unit vector (x, z), in the castle's frame, of the width of a flame at ``x``.

    Along the wall; or perpendicular to the line to the ``eye`` (x, z), if the flame ``faces`` it.
    """
    away_x, away_z = x - eye[0], FLAME_Z - eye[1]
    far = math.hypot(away_x, away_z)
    if not faces or far < 1e-6:
        return 1.0, 0.0
    return away_z / far, -away_x / far


def light_shift(kt: float) -> tuple[float, float]:
    """Return how far the light's moving texture coordinates shift in s and t (section 6.1)."""
    return 0.01 * np.sin(kt / 10.8) ** 2, 0.01 * np.cos(kt / 7.2) ** 2


class Castle:
    """The castle on its hill."""

    def __init__(self, settings: Settings, assets: Assets, field: HeightField) -> None:
        """Read the textures and compile one display list of everything that does not move."""
        castle = settings.castle
        corners = np.array([(-0.6, -0.6), (-0.6, 0.6), (0.6, -0.6), (0.6, 0.6), (0, 0)])
        stands = field.height(castle.x + corners[:, 0], castle.z + corners[:, 1])
        self.base = (castle.x, float(stands.min()), castle.z)
        self._yaw, self._repeat = castle.yaw, castle.brick_repeat
        self._settings, self._built_from = settings, self.built_from(settings)
        names = ("castle_brick.png", "torch_stone.png")
        self._brick, self._stone = (Texture(read_image(assets.path(name), "RGB")) for name in names)
        self._door, self._fire = (
            Texture(read_image(assets.path(name)), repeat=False)
            for name in ("castle_door.png", "fire.png")
        )
        # GL_REPEAT: the moving coordinates exceed 0..1 by a hundredth.
        self._light = Texture(self._light_image(read_image(assets.path("castle_light.png"), "RGB")))
        self._masonry = DisplayList(self._send)

    @staticmethod
    def built_from(settings: Settings) -> tuple[object, ...]:
        """Return the settings that are compiled into the list."""
        castle = settings.castle
        place = castle.x, castle.z, castle.yaw, castle.brick_repeat
        return *place, castle.multitexture, castle.ornate

    def apply(self, settings: Settings) -> bool:
        """Apply new settings; return False, changing nothing, if the castle must be rebuilt."""
        if self.built_from(settings) != self._built_from:
            return False
        self._settings = settings
        return True

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
        return walls_mesh(self._repeat)

    def _send_bricks(self) -> None:
        """Send the walls, and one tower four times."""
        draw_mesh(self._walls())
        tower = tower_mesh(self._repeat)
        for x, z in CORNERS:
            with matrix():
                gl.glTranslatef(x, 0.0, z)
                draw_mesh(tower)

    def draw(self, frame: Frame) -> None:
        """Draw the castle, the door, the light on the wall, and the fire."""
        groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_COLOR_BUFFER_BIT
        groups |= gl.GL_DEPTH_BUFFER_BIT | gl.GL_POLYGON_BIT | gl.GL_LIGHTING_BIT
        with matrix(), attrib(groups):
            gl.glTranslatef(*self.base)
            gl.glRotatef(self._yaw, 0.0, 1.0, 0.0)
            gl.glTranslatef(-0.5, 0.0, -0.5)
            gl.glColor4f(1.0, 1.0, 1.0, 1.0)
            gl.glEnable(gl.GL_LIGHTING)
            self._masonry.call()
            self._draw_gate(frame.kt)
            self._draw_fire(frame)

    def _draw_gate(self, kt: float) -> None:
        """Blend door and light over the bricks: three layers, each fogged (section 11.2.4)."""
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glEnable(gl.GL_BLEND)
        # From a distance the depth buffer cannot separate the layers from the wall.
        gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glNormal3f(0.0, 0.0, -1.0)
        gl.glPolygonOffset(-1.0, -2.0)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        self._door.bind()
        self._gate_quad(-0.001, 0.0, 0.0)
        gl.glDisable(gl.GL_LIGHTING)
        gl.glPolygonOffset(-2.0, -4.0)
        gl.glBlendFunc(gl.GL_ZERO, gl.GL_SRC_COLOR)
        self._light.bind()
        self._gate_quad(-0.002, *light_shift(kt))
        gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)

    def _gate_quad(self, z: float, shift_s: float, shift_t: float) -> None:
        """Send a layer over the gate wall; s may shift at its far side, and t at its top."""
        gl.glBegin(gl.GL_QUADS)
        for s, t, x, y in (
            (0.0, 1.0, 0.0, 0.0),
            (0.0, -shift_t, 0.0, 1.0),
            (1.0 - shift_s, -shift_t, 1.0, 1.0),
            (1.0 - shift_s, 1.0, 1.0, 0.0),
        ):
            gl.glTexCoord2f(s, t)
            gl.glVertex3f(x, y, z)
        gl.glEnd()

    def _draw_fire(self, frame: Frame) -> None:
        """Blend two quads with the sprite sheet's current frame (section 6.1)."""
        column, row = flame_frame(frame.kt)
        s, t = 0.25 * column, 0.25 * row
        eye, faces = self._inside(frame.eye), self._settings.castle.flame_faces
        corners = []
        for x in TORCHES:
            across_x, across_z = flame_across(eye, x, faces)
            for ds, dt, along, y in (
                (0.0, 0.25, -0.03, 0.21),
                (0.0, 0.0, -0.03, 0.31),
                (0.25, 0.0, 0.03, 0.31),
                (0.25, 0.25, 0.03, 0.21),
            ):
                place = (x + along * across_x, y, FLAME_Z + along * across_z)
                corners.append((s + ds, t + dt, *place))
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        gl.glDepthMask(gl.GL_FALSE)
        self._fire.bind()
        gl.glPushClientAttrib(gl.GL_CLIENT_VERTEX_ARRAY_BIT)
        gl.glInterleavedArrays(gl.GL_T2F_V3F, 0, np.array(corners, np.float32))
        gl.glDrawArrays(gl.GL_QUADS, 0, len(corners))
        gl.glPopClientAttrib()
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def _inside(self, point: np.ndarray) -> tuple[float, float]:
        """Return x, z of a point (3,) in the castle's own frame: the inverse of draw's matrices."""
        yaw = math.radians(self._yaw)
        x, z = float(point[0]) - self.base[0], float(point[2]) - self.base[2]
        across = x * math.cos(yaw) - z * math.sin(yaw)
        return across + 0.5, x * math.sin(yaw) + z * math.cos(yaw) + 0.5

    def _outside(self, points: np.ndarray) -> np.ndarray:
        """Return the island's x, z (n, 2) of places (n, 2) in the castle's own frame."""
        yaw = math.radians(self._yaw)
        turn = np.array([(math.cos(yaw), math.sin(yaw)), (-math.sin(yaw), math.cos(yaw))])
        return np.asarray((points - 0.5) @ turn.T + (self.base[0], self.base[2]))

    def outlines(self, step: float) -> list[tuple[np.ndarray, float, float]]:
        """Return the outlines that cast the shadow, see the function :func:`outlines`."""
        return outlines(step)

    def cast(self, shadows: ShadowMap) -> None:
        """Cast the shadow of walls and towers, and darken the ground along their base."""
        step = 0.7 * shadows.texel
        for line, low, high in self.outlines(step):
            cast_outlines(shadows, self._outside(line), low, high, step)
        shade_foot(shadows, self._outside(on_edges(CORNERS, FOOT_SHADE / 2)), FOOT_SHADE)

    def obstacles(self) -> tuple[Obstacle, ...]:
        """Return what the walker cannot pass: walls and towers."""
        x, y, z = self.base
        return courtyard(x, z, self._yaw, WALL, y + 1 + MERLON, (TOWER_RADIUS, y + TOWER_TOP))

    def release(self) -> None:
        """Delete the list and the textures; may be called twice."""
        self._masonry.release()
        for texture in (self._brick, self._stone, self._door, self._fire, self._light):
            texture.release()
