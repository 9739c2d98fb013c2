"""The castle: walls, towers, a gate lit by torches (Castle, section 6).

Techniques: a few meshes built once and drawn several times; a door texture with transparent
surround laid over the bricks; a light texture multiplied over both with
glBlendFunc(GL_ZERO, GL_SRC_COLOR), whose far texture coordinates flicker; torches as parametric
cylinder and cone; fire as a 4x4 sprite sheet on a quad.
The ornate castle's bricks are multiplied by a light map in a second unit (castle_light.py).
Fixes: flames that turn to the viewer about the y axis (R2); bricks, door and light in one pass of
three texture units, fogged and lit once (R11, section 11.2.4).
Own frame: the unit square x, z in 0..1, the gate wall at z = 0, y up from the ground.
State used: GL_TEXTURE_2D, GL_LIGHTING, GL_BLEND, polygon offset; for R11 the combiners and three
texture units of OpenGL 1.3, and ARB_texture_env_crossbar (OpenGL 1.4).
"""

import math
from dataclasses import replace

import numpy as np

from landscape.elements.ornate.castle_light import light_map
from landscape.elements.ornate.castle_meshes import (
    CORNERS,
    MASTS,
    TORCHES,
    loopholes,
    ornate_masonry,
    pennant,
    quads_mesh,
    rings,
    roofs,
    tower_mesh,
    walls_mesh,
    without_gate,
)
from landscape.elements.terrain.shadows import SKY_HIDDEN, ShadowMap, cast_points, on_edges
from landscape.files.assets import Assets
from landscape.files.cache import recall
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.camera import ball_in_view
from landscape.geometry.height_field import HeightField
from landscape.geometry.mesh import revolve
from landscape.gl.calls import gl
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh
from landscape.gl.state import attrib, combine, matrix
from landscape.gl.texture import Texture
from landscape.settings import Settings

ELEMENT = "castle"

# Radius of the ball about the middle of the walls that holds them, and of the ornate ones.
BALL, ORNATE_BALL = 1.4, 1.8
SLATE, DARK, WOOD = (0.56, 0.59, 0.68), (0.07, 0.06, 0.06), (0.35, 0.25, 0.16)  # chosen
PENNANT = (0.75, 0.12, 0.10)  # chosen
BEFORE, AFTER = np.array([0, 0, 1, 2, 3, 4]), np.array([1, 2, 3, 4, 5, 5])  # of a pennant's pairs
PENNANT_QUADS = (np.arange(0, 10, 2)[:, None] + (0, 1, 3, 2)).ravel()  # of a strip of pairs
NEUTRAL = 127.5  # of the halo: doubled, it leaves the wall as it is
BY_DAY = 0.5  # chosen: part of the torches' glow that is seen beside the sun's light
FOOT_SHADE = 0.22  # chosen: units from the walls over which they hide the sky
FLAME_Z = -0.07  # section 6.1
GATE_CORNERS = ((1.0, 0.0), (0.0, 0.0), (0.0, 1.0), (1.0, 1.0))  # x, y, as the bricks have them
TORCH_BASE, TORCH_TOP = 0.10, 0.215  # chosen: the flame starts at 0.21


def halo(light: np.ndarray) -> np.ndarray:
    """Return the light texture (h, w, 3) scaled so that twice its darkest colour leaves all as is.

    In 2006 the light only darkened: by its grey of two thirds, where no torch shines.
    """
    darkest = np.maximum(light.reshape(-1, 3).min(axis=0), 1)
    return np.ascontiguousarray(np.clip(light * (127.5 / darkest) + 0.5, 0, 255), np.uint8)


def flame_across(eye: tuple[float, float], x: float, faces: bool) -> tuple[float, float]:
    """Return where a flame at ``x`` extends to, a unit vector (x, z) in the castle's own frame.

    Along the wall; or, if it ``faces`` the eye at (x, z), across the line from there.
    """
    away_x, away_z = x - eye[0], FLAME_Z - eye[1]
    far = math.hypot(away_x, away_z)
    if not faces or far < 1e-6:
        return 1.0, 0.0
    return away_z / far, -away_x / far


def flame_frame(kt: float) -> tuple[int, int]:
    """Return column and row of the sprite sheet's frame: int(kt * 0.5) mod 16 (section 6.1)."""
    number = int(kt * 0.5)
    return number % 4, (number // 4) % 4


def light_shift(kt: float) -> tuple[float, float]:
    """Return how far the halo's far texture coordinates move in s and t (section 6.1)."""
    return 0.01 * np.sin(kt / 10.8) ** 2, 0.01 * np.cos(kt / 7.2) ** 2


def draw_pennants(kt: float) -> None:
    """Draw the pennants on their masts; both sides show, the light changes with the waves."""
    x, z, foot, length = np.array(MASTS).T
    strips = pennant(kt + 11.0 * np.arange(len(length)), length)
    wave = strips[:, ::2, 2]
    lean = (wave[:, AFTER] - wave[:, BEFORE]) / ((AFTER - BEFORE) * length[:, None])
    shades = np.clip(0.85 + 4.0 * lean, 0.5, 1.0)[:, PENNANT_QUADS // 2]
    packed = np.empty(shades.shape, [("colour", "u1", 4), ("place", "f4", 3)])
    packed["colour"][..., :3] = shades[..., None] * (255.0 * np.array(PENNANT))
    packed["colour"][..., 3] = 255
    packed["place"] = strips[:, PENNANT_QUADS]
    packed["place"] += np.stack([x, foot + 1.15 * length, z], axis=1)[:, None]
    gl.glPushClientAttrib(gl.GL_CLIENT_VERTEX_ARRAY_BIT)
    gl.glInterleavedArrays(gl.GL_C4UB_V3F, 0, packed.view(np.uint8))
    gl.glDrawArrays(gl.GL_QUADS, 0, packed.size)
    gl.glPopClientAttrib()


class Castle:
    """The castle on its hill."""

    def __init__(self, settings: Settings, assets: Assets, field: HeightField) -> None:
        """Build the meshes and the display list of all that does not move."""
        castle = settings.castle
        corners = np.array([(-0.6, -0.6), (-0.6, 0.6), (0.6, -0.6), (0.6, 0.6), (0, 0)])
        stands = field.height(castle.x + corners[:, 0], castle.z + corners[:, 1])
        self.base = (castle.x, float(stands.min()), castle.z)
        self._settings = settings
        self._yaw, self._repeat = castle.yaw, castle.brick_repeat
        names = ("castle_brick.png", "torch_stone.png")
        self._brick, self._stone = (Texture(read_image(assets.path(name), "RGB")) for name in names)
        self._door, self._fire = (
            Texture(read_image(assets.path(name)), repeat=False)
            for name in ("castle_door.png", "fire.png")
        )
        # Repeated: the light texture's moving coordinates leave 0..1 by a hair.
        self._light_image = read_image(assets.path("castle_light.png"), "RGB")
        self._light = Texture(self._light_image)
        self._ball = ORNATE_BALL if castle.ornate else BALL
        self._light_map = self._light_bricks(settings) if castle.ornate else None
        self._list = DisplayList(lambda: self._send(gate=True))
        # What only R11 needs is made when it is switched on.
        self._open: DisplayList | None = None
        self._gate: DisplayList | None = None
        self._halo_texture: Texture | None = None

    def _light_bricks(self, settings: Settings) -> Texture:
        """Make the bricks' mesh; return the light map that lies on it in a second unit."""
        bricks, strips = ornate_masonry(self._repeat)
        picture, self._lit = recall(
            ["castle's light", repr((self._repeat, self._yaw, settings.sun))],
            lambda: light_map(bricks, strips, settings.sun, self._yaw),
        )
        self._bricks = replace(bricks, coordinates=(*bricks.coordinates, self._lit))
        return Texture(picture, repeat=False, mipmaps=False)

    def _open_list(self) -> DisplayList:
        """The castle without its gate wall, compiled when it is first asked for."""
        if self._open is None:
            self._open = DisplayList(lambda: self._send(gate=False))
        return self._open

    def _halo(self) -> Texture:
        """The light as :func:`halo` has it, made when it is first asked for."""
        if self._halo_texture is None:
            glow = halo(self._light_image)
            if self._settings.castle.ornate:
                glow = np.asarray(NEUTRAL + BY_DAY * (glow - NEUTRAL) + 0.5, np.uint8)
            self._halo_texture = Texture(glow)
        return self._halo_texture

    def _send(self, gate: bool) -> None:
        """What a display list holds: bricks, then stone; each mesh drawn where it stands.

        Without the ``gate`` the gate wall's outer face is left out.
        """
        holder = revolve([(0.008, 0.0), (0.008, 0.075)], 10, (1, 1))
        cone = revolve([(0.008, 0.0), (0.024, 0.04), (0.014, 0.04)], 10, (2, 1))
        gl.glEnable(gl.GL_TEXTURE_2D)
        self._brick.bind()
        if self._light_map is not None:
            self._send_ornate(self._light_map, gate)
        else:
            walls = walls_mesh(self._repeat)
            draw_mesh(walls if gate else without_gate(walls, self._repeat))
            tower = tower_mesh(self._repeat)
            for x in (0.0, 1.0):
                for z in (0.0, 1.0):
                    with matrix():
                        gl.glTranslatef(x, 0.0, z)
                        draw_mesh(tower)
        self._stone.bind()
        for x in TORCHES:
            for mesh, y in ((holder, TORCH_BASE), (cone, TORCH_TOP - 0.04)):
                with matrix():
                    gl.glTranslatef(x, y, FLAME_Z)
                    draw_mesh(mesh)
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
        gl.glDisable(gl.GL_TEXTURE_2D)

    def _send_ornate(self, light: Texture, gate: bool) -> None:
        """Send bricks, slates of the same bricks in another colour, masts and dark openings."""
        gl.glActiveTexture(gl.GL_TEXTURE1)
        light.bind()
        gl.glEnable(gl.GL_TEXTURE_2D)
        combine({"COMBINE_RGB": "MODULATE", "SRC0_RGB": "PREVIOUS", "SRC1_RGB": "TEXTURE"})
        gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, 2.0)
        # The first quad is the gate wall.
        first = 0 if gate else 2
        draw_mesh(replace(self._bricks, triangles=self._bricks.triangles[first:]))
        gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, 1.0)
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
        gl.glDisable(gl.GL_TEXTURE_2D)
        gl.glActiveTexture(gl.GL_TEXTURE0)
        gl.glColor3f(*SLATE)
        draw_mesh(roofs(self._repeat))
        self._stone.bind()
        gl.glColor3f(*WOOD)
        for x, z, foot, length in MASTS:
            with matrix():
                gl.glTranslatef(x, foot - 0.03, z)
                draw_mesh(revolve([(0.006, 0.0), (0.003, 0.03 + 1.4 * length)], 6, (1, 1)))
        gl.glDisable(gl.GL_TEXTURE_2D)
        gl.glColor3f(*DARK)
        draw_mesh(quads_mesh(loopholes(), 1.0))
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glColor3f(1.0, 1.0, 1.0)

    def cast(self, shadows: ShadowMap) -> None:
        """Throw the shadow of walls and towers, and darken the ground along their feet."""
        yaw, step = math.radians(self._yaw), 0.7 * shadows.texel
        turn = np.array([(math.cos(yaw), math.sin(yaw)), (-math.sin(yaw), math.cos(yaw))])

        def feet(ring: np.ndarray) -> np.ndarray:
            xz = (ring - 0.5) @ turn.T + (self.base[0], self.base[2])
            return np.insert(xz, 1, shadows.field.terrain_height(*xz.T), axis=1)

        for ring, low, high in rings(step, self._settings.castle.ornate):
            heights = np.arange(low, high, step)
            points = np.repeat(feet(ring), len(heights), axis=0)
            points[:, 1] += np.tile(heights, len(ring))
            cast_points(shadows, points)
        along = feet(on_edges(CORNERS, FOOT_SHADE / 2))
        shadows.hide_sky(along, np.full(len(along), FOOT_SHADE), 0.5 * SKY_HIDDEN)

    def visible(self, frame: Frame) -> bool:
        """Tell whether the ball round the castle, mirrored if the frame is, meets the view."""
        x, y, z = self.base[0], self.base[1] + 0.5, self.base[2]
        if frame.mirrored:
            y = 2.0 * self._settings.water.level - y
        return ball_in_view(frame, (x, y, z), self._ball)

    def draw(self, frame: Frame) -> None:
        """Draw the castle, the door, the light on the wall, and the fire."""
        if self._settings.camera.cull and not self.visible(frame):
            return
        groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_COLOR_BUFFER_BIT
        groups |= gl.GL_DEPTH_BUFFER_BIT | gl.GL_POLYGON_BIT | gl.GL_LIGHTING_BIT
        with matrix(), attrib(groups):
            gl.glTranslatef(*self.base)
            gl.glRotatef(self._yaw, 0.0, 1.0, 0.0)
            gl.glTranslatef(-0.5, 0.0, -0.5)
            gl.glColor4f(1.0, 1.0, 1.0, 1.0)
            gl.glEnable(gl.GL_LIGHTING)
            if self._settings.castle.multitexture:
                self._open_list().call()
                self._draw_gate_at_once(frame.kt)
                gl.glEnable(gl.GL_TEXTURE_2D)
                gl.glEnable(gl.GL_BLEND)
                gl.glDisable(gl.GL_LIGHTING)
            else:
                self._list.call()
                gl.glEnable(gl.GL_TEXTURE_2D)
                gl.glEnable(gl.GL_BLEND)
                self._draw_gate_in_layers(frame.kt)
            if frame.mirrored and self._settings.reflection.rippled:
                return  # flames and pennants are too small to be told in the ripples
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            gl.glDepthMask(gl.GL_FALSE)
            self._fire.bind()
            self._draw_fire(frame)
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
            if self._settings.castle.ornate:
                gl.glDisable(gl.GL_TEXTURE_2D)
                draw_pennants(frame.kt)

    def _draw_gate_in_layers(self, kt: float) -> None:
        """Blend door and light over the bricks: three layers, each fogged (section 11.2.4)."""
        # The layers lie closer to the wall than the depth buffer can tell from afar.
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

    def _draw_gate_at_once(self, kt: float) -> None:
        """Draw the gate wall as one layer: bricks, door and light in three texture units.

        Unit 0 mixes door and bricks by the door's alpha, and names unit 1's texture to do so (the
        crossbar); unit 1 multiplies by the halo, twice, so that it may brighten; unit 2 by the
        sun's colour on the wall; unit 3, of the ornate castle, by its light map.
        """
        with attrib(gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT):
            shift_s, shift_t = light_shift(kt)
            gl.glActiveTexture(gl.GL_TEXTURE2)
            gl.glMatrixMode(gl.GL_TEXTURE)
            with matrix():
                # The halo's near corner, s = 0 and t = 1, stays where it is.
                gl.glTranslatef(0.0, -shift_t, 0.0)
                gl.glScalef(1.0 - shift_s, 1.0 + shift_t, 1.0)
                self._gate_wall().call()
            gl.glMatrixMode(gl.GL_MODELVIEW)

    def _gate_wall(self) -> DisplayList:
        """Return the list of the gate in three units, or four, made when first asked for.

        It ends with unit 2 active, as it was.
        """
        if self._gate is None:
            halo = self._halo()
            mix = {"COMBINE_RGB": "INTERPOLATE", "SOURCE0_RGB": "TEXTURE1"}
            mix |= {"SOURCE1_RGB": "TEXTURE0", "SOURCE2_RGB": "TEXTURE1"}
            mix |= {"OPERAND2_RGB": "SRC_ALPHA"}
            lit = {"COMBINE_RGB": "MODULATE", "SOURCE0_RGB": "PREVIOUS", "SOURCE1_RGB": "TEXTURE2"}
            shaded = {**lit, "SOURCE1_RGB": "PRIMARY_COLOR"}
            units = [(self._brick, mix, 1.0), (self._door, lit, 2.0), (halo, shaded, 1.0)]
            corners = [
                [(x * repeat, (1.0 - y) * repeat) for x, y in GATE_CORNERS]
                for repeat in (self._repeat, 1.0, 1.0)
            ]
            if self._light_map is not None:
                units.append((self._light_map, {**lit, "SOURCE1_RGB": "TEXTURE3"}, 2.0))
                corners.append(self._lit[:4].tolist())

            def send() -> None:
                for unit, (texture, terms, scale) in enumerate(units):
                    gl.glActiveTexture(getattr(gl, f"GL_TEXTURE{unit}"))
                    texture.bind()
                    gl.glEnable(gl.GL_TEXTURE_2D)
                    combine(terms)
                    gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, scale)

                gl.glActiveTexture(gl.GL_TEXTURE2)
                gl.glNormal3f(0.0, 0.0, -1.0)
                gl.glBegin(gl.GL_QUADS)
                for k, (x, y) in enumerate(GATE_CORNERS):
                    for unit, of_unit in enumerate(corners):
                        gl.glMultiTexCoord2f(getattr(gl, f"GL_TEXTURE{unit}"), *of_unit[k])
                    gl.glVertex3f(x, y, 0.0)
                gl.glEnd()

            self._gate = DisplayList(send)
        return self._gate

    def _gate_quad(self, z: float, shift_s: float, shift_t: float) -> None:
        """A layer over the gate wall; the far texture coordinates may move."""
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
        """Two quads with the sprite sheet's current frame (section 6.1)."""
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
        gl.glPushClientAttrib(gl.GL_CLIENT_VERTEX_ARRAY_BIT)
        gl.glInterleavedArrays(gl.GL_T2F_V3F, 0, np.array(corners, np.float32))
        gl.glDrawArrays(gl.GL_QUADS, 0, len(corners))
        gl.glPopClientAttrib()

    def _inside(self, point: np.ndarray) -> tuple[float, float]:
        """Return x, z of a place (3,) in the castle's own frame: the matrices of draw, undone."""
        yaw = math.radians(self._yaw)
        x, z = float(point[0]) - self.base[0], float(point[2]) - self.base[2]
        across = x * math.cos(yaw) - z * math.sin(yaw)
        return across + 0.5, x * math.sin(yaw) + z * math.cos(yaw) + 0.5

    def release(self) -> None:
        """Delete the list and the textures; may be called twice."""
        self._list.release()
        for made in (self._open, self._gate, self._halo_texture, self._light_map):
            if made is not None:
                made.release()
        for texture in (self._brick, self._stone, self._door, self._fire, self._light):
            texture.release()
