"""The castle of the preset `best`: a keep, roofs, bands, loopholes, pennants and a light map.

The bricks are multiplied by a light map in a second texture unit (baked_light.py); the gate is
drawn in one pass as in gate.py, with the light map in a fourth unit. Slates are the same bricks in
another colour. In a mirror image that ripples, flames and pennants are left out: they are too small
to be recognised there. Not in the report.
State used: as gate.py, with four texture units.
"""

import math
from collections.abc import Hashable
from dataclasses import replace

import numpy as np

from framelens.gl.extensions import has_stencil
from framelens.gl.seam import gl
from framelens.gl.state import attrib, combine, front_faces, matrix
from framelens.gl.texture import Texture
from landscape.elements.best.castle.baked_light import light_map
from landscape.elements.best.castle.doorway import Doorway
from landscape.elements.best.castle.gate import TIMES, CastleInOnePass, Unit
from landscape.elements.best.castle.gate_layers import draw_layers
from landscape.elements.best.castle.loopholes import loopholes
from landscape.elements.best.castle.open_door import HALF, send_open_door, send_opening
from landscape.elements.best.castle.ornate_masonry import KEEP, ornate_masonry
from landscape.elements.best.castle.pennants import draw_pennants
from landscape.elements.best.castle.roofs import MASTS, ornate_outlines, roofs
from landscape.elements.best.castle.torch_glow import TorchGlow
from landscape.elements.settings import Settings
from landscape.elements.sun import direction, painted
from landscape.files.assets import Assets
from landscape.files.cache import recall
from landscape.frame import Frame
from landscape.geometry.culling import ball_in_view
from landscape.geometry.height_field import HeightField, mirrored_height
from landscape.geometry.masonry import WALL, quads_mesh
from landscape.geometry.mesh import Mesh, revolve
from landscape.geometry.obstacles import Obstacle, Wall
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh
from landscape.gl.features import possible

REACH = 1.8  # chosen: radius of the castle's bounding sphere, centred in the walls
# Chosen.
SLATE = (0.56, 0.59, 0.68)
DARK = (0.07, 0.06, 0.06)
WOOD = (0.35, 0.25, 0.16)

BY_DAY = 0.5  # chosen: fraction of the flickering glow that is visible; torches add to it
SHADE = (0.42, 0.42, 0.45)  # chosen: of the door within; the yard is in the shadow of its walls
WARM = np.array([1.1, 0.62, 0.3])  # chosen: the light of larger flames is less yellow
HALL_PIXELS = 5.2  # chosen: half width of the door from which the hall behind it is seen
GATE = 2  # triangles: the gate wall, which comes first in the bricks
NEUTRAL = 127.5  # of the halo: doubled, it leaves the wall as it is


class OrnateCastle(CastleInOnePass):
    """The castle with all its ornaments."""

    asked_by = ("castle.ornate",)
    ignores = ("castle.sides", "castle.battlements", "castle.multitexture")

    def __init__(self, settings: Settings, assets: Assets, field: HeightField) -> None:
        """Compute the light map, or take it from the cache, and compile the lists."""
        castle, sun = settings.castle, settings.sun
        self.settings, self._field = settings, field
        bricks, strips = ornate_masonry(castle.brick_repeat * self.SPAN)
        made_from = castle.brick_repeat, castle.yaw, castle.torches, sun
        picture, lit = recall(
            ["castle's light", type(self).__name__, repr(made_from)],
            lambda: self._light_on(bricks, strips),
        )
        self._bricks = replace(bricks, coordinates=(*bricks.coordinates, lit))
        self._light_map = Texture(picture, repeat=False, mipmaps=False)
        self._one_layer = possible("the ornate castle's gate in one layer")
        super().__init__(settings, assets, field)
        self._open_door = DisplayList(lambda: send_open_door(self._door))
        self._opening = DisplayList(send_opening)
        deep = castle.depth and castle.open and has_stencil("castle.depth")
        self._hall = Doorway(assets, self._brick, self._opening) if deep else None
        self._glow = TorchGlow(self._ground_at) if castle.glow > 0.0 else None

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return the settings that the lists and the light map were made from."""
        castle = settings.castle
        place = castle.x, castle.z, castle.yaw, castle.brick_repeat
        own = castle.ornate, castle.torches, castle.depth and castle.open, castle.glow > 0.0
        return *place, *own, settings.sun

    def _light_on(self, mesh: Mesh, strips: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
        """Return the light map of the bricks and its texture coordinates."""
        castle = self.settings.castle
        return light_map(mesh, strips, self.settings.sun, castle.yaw, castle.torches)

    def _light_image(self, image: np.ndarray) -> np.ndarray:
        glow = super()._light_image(image)
        warm = WARM if self.settings.castle.glow > 0.0 else 1.0
        return np.asarray(NEUTRAL + BY_DAY * warm * (glow - NEUTRAL) + 0.5, np.uint8)

    def _send_bricks(self) -> None:
        """Send bricks without the gate wall, slates, masts and dark openings."""
        self._send_walls(slice(GATE, None))
        self._send_roofs()
        self._stone.bind()
        gl.glColor3f(*WOOD)
        for x, z, foot, length in MASTS:
            with matrix():
                gl.glTranslatef(x, foot - 0.03, z)
                draw_mesh(revolve([(0.006, 0.0), (0.003, 0.03 + 1.4 * length)], 6, (1, 1)))
        gl.glDisable(gl.GL_TEXTURE_2D)
        self._send_openings()
        gl.glEnable(gl.GL_TEXTURE_2D)
        self._send_door_within()
        gl.glColor3f(1.0, 1.0, 1.0)

    def _send_walls(self, triangles: slice) -> None:
        """Send some of the bricks' triangles times twice their light map."""
        with attrib(gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT):
            gl.glActiveTexture(gl.GL_TEXTURE1)
            self._light_map.bind()
            gl.glEnable(gl.GL_TEXTURE_2D)
            combine({"COMBINE_RGB": "MODULATE", "SRC0_RGB": "PREVIOUS", "SRC1_RGB": "TEXTURE"})
            gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, 2.0)
            draw_mesh(replace(self._bricks, triangles=self._bricks.triangles[triangles]))

    def _send_gate(self) -> None:
        if self._one_layer:
            super()._send_gate()
            return
        gl.glEnable(gl.GL_TEXTURE_2D)
        self._brick.bind()
        self._send_walls(slice(GATE))

    def _draw_gate(self, kt: float) -> None:
        if self._one_layer:
            super()._draw_gate(kt)
            return
        self._gate.call()
        draw_layers(self._door, self._light, kt)

    def _send_roofs(self) -> None:
        gl.glColor3f(*SLATE)
        draw_mesh(roofs(self._repeat))

    def _send_openings(self) -> None:
        gl.glColor3f(*DARK)
        draw_mesh(quads_mesh(loopholes(), 1.0))

    def _send_door_within(self) -> None:
        """Send the door as seen from the yard, where a walker can leave by it."""
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        self._door.bind()
        gl.glColor3f(*SHADE)
        gl.glNormal3f(0.0, 0.0, 1.0)
        gl.glBegin(gl.GL_QUADS)
        for x, y in ((0.3, 0.0), (0.7, 0.0), (0.7, 0.45), (0.3, 0.45)):
            gl.glTexCoord2f(x, 1.0 - y)
            gl.glVertex3f(x, y, WALL + 0.001)
        gl.glEnd()
        gl.glDisable(gl.GL_BLEND)

    @property
    def is_open(self) -> bool:
        """Whether the door is open."""
        return self.settings.castle.open

    def _ground_at(self, places: np.ndarray) -> np.ndarray:
        """Return the ground's height (n,) at places (n, 2) in the castle's own frame."""
        x, z = self.outside(np.asarray(places, float)).T
        return np.asarray(self._field.height(x, z) - self.base[1])

    def _draw_open_door(self, frame: Frame) -> None:
        away, (_, inwards) = math.dist(frame.eye, self.base), self._inside(frame.eye)
        seen = not frame.mirrored and inwards < 0 and frame.pixels * HALF > HALL_PIXELS * away
        if self._hall and seen:
            self._hall.draw(frame)
        else:
            self._opening.call()
        self._open_door.call()
        gl.glDisable(gl.GL_LIGHTING)

    def _units(self) -> list[Unit]:
        coordinates = self._bricks.coordinates[1][:4]
        terms = TIMES | {"SOURCE1_RGB": "TEXTURE3"}
        return [*super()._units(), (self._light_map, terms, 2.0, coordinates)]

    def outlines(self, step: float) -> list[tuple[np.ndarray, float, float]]:
        """Return the outlines that cast the shadow, see :func:`ornate_outlines`."""
        return ornate_outlines(step)

    def obstacles(self) -> tuple[Obstacle, ...]:
        """Return what the walker cannot pass: with ``walk.solid`` the keep as well."""
        walls = super().obstacles()
        if not self.settings.walk.solid:
            return walls
        x0, z0, x1, z1, top = KEEP
        middle = np.array([[(x0 + x1) / 2, (z0 + z1) / 2]])
        x, z = self.outside(middle)[0].tolist()
        sides, yaw = ((x1 - x0) / 2, (z1 - z0) / 2), math.radians(self._yaw)
        return (*walls, Wall(x, z, *sides, yaw, self.base[1] + top))

    def visible(self, frame: Frame) -> bool:
        """Return whether the bounding sphere, mirrored if the frame is, meets the view frustum."""
        x = self.base[0]
        y = self.base[1] + 0.5
        z = self.base[2]
        if frame.mirrored:
            y = mirrored_height(y, self.settings.water.level)
        return ball_in_view(frame, (x, y, z), REACH)

    def draw(self, frame: Frame) -> None:
        """Draw the castle; with ``camera.cull`` only if it is in view."""
        self.draw_solid(frame)
        self.draw_rest(frame)

    def draw_solid(self, frame: Frame) -> None:
        """Draw what is opaque: drawn before ground and sky, it hides much of them."""
        if not self.settings.camera.cull or self.visible(frame):
            with self._placed():
                # The gate wall first: who stands before it sees little else of the castle.
                with attrib(gl.GL_ENABLE_BIT):
                    self._draw_gate(frame.kt)
                with front_faces(self.settings.camera.cull and not frame.mirrored):
                    self._masonry.call()

    def draw_rest(self, frame: Frame) -> None:
        """Draw the open door, what is blended, and what lies on the ground."""
        if not self.settings.camera.cull or self.visible(frame):
            with self._placed():
                gl.glEnable(gl.GL_TEXTURE_2D)
                gl.glEnable(gl.GL_BLEND)
                gl.glDisable(gl.GL_LIGHTING)
                self._draw_fire(frame)

    def _draw_details(self, frame: Frame) -> None:
        """Draw what else stands at the castle: nothing here."""

    def _draw_fire(self, frame: Frame) -> None:
        """Draw the open door, flames and pennants."""
        if self.is_open:
            self._draw_open_door(frame)
        self._draw_details(frame)
        if frame.mirrored and self.settings.reflection.rippled:
            return
        if self._glow:
            castle = self.settings.castle
            faces = self._inside(frame.eye) if castle.flame_faces else None
            self._glow.draw(frame, self._fire, faces, castle.glow, castle.torches)
        else:
            super()._draw_fire(frame)
        gl.glDisable(gl.GL_TEXTURE_2D)
        sun = self.settings.sun
        draw_pennants(frame.kt, painted(sun, direction(sun)[1]))

    def release(self) -> None:
        """Delete the lists and the textures; may be called twice."""
        for each in (self._open_door, self._opening, self._hall, self._glow):
            if each is not None:
                each.release()
        self._light_map.release()
        super().release()
