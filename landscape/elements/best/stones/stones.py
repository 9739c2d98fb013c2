"""Crags, boulders, stones, pebbles and driftwood on bare ground (``ground.stones``).

Not in the report. Technique: a few meshes, thousands of instances, placed by rules (scattering.py),
whose vertices lie in one vertex buffer with their light painted in (bodies.py). A frame draws those
in view with one glDrawElements, each as long as it is a few pixels large: the number falls with the
distance little by little, as the limit varies from stone to stone. The choice is made with a
margin, and kept for the frames in which the eye stays near. Far away, large stones have a coarser
mesh. The texture is the ground's rock, doubled, as it is on the ground.
State used: a vertex buffer (OpenGL 1.5), or a vertex array where there are none; texture unit 0
with GL_COMBINE; GL_CULL_FACE.
"""

import ctypes
from collections.abc import Hashable
from typing import Self

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, front_faces, multiply
from framelens.gl.texture import Texture
from landscape.elements.best.stones import FILE, wanted
from landscape.elements.best.stones.bodies import VERTEX, Bodies, bodies
from landscape.elements.best.stones.scattering import strewn
from landscape.elements.best.stones.shapes import KINDS, LOG, first_shape, kept_shapes
from landscape.elements.best.terrain.shadows import ShadowMap, cast_points
from landscape.elements.element import Element, Site
from landscape.elements.ground import Ground
from landscape.elements.settings import Settings
from landscape.elements.sun import direction
from landscape.files.assets import Assets
from landscape.files.cache import content, recall
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.culling import REUSE_ANGLE, REUSE_DISTANCE, in_view, is_near
from landscape.geometry.height_field import mirrored_height
from landscape.gl.features import possible

# All chosen.
# Diameter in pixels below which a stone is not drawn, by kind, times LIMITS; what is large stands
# among its like, on rock of its colour, where a small one is not missed.
LEAST_PIXELS = (12.0, 8.0, 5.0, 4.0, 6.0)
LIMITS = (0.7, 1.5)
MIRRORED = 3.0  # times that is the limit in the mirror image
EDGE_PIXELS = 11.0  # a level of n triangles is fine enough for a stone of this times sqrt(n) pixels
SOLID = 0.045  # units: a stone that sticks out less does not stop the walker
BROAD = 0.72  # of the radius, within which it stops him
SHADED = 0.02  # units: a smaller stone casts no shadow
FOOT_SHADE = 2.1  # times the radius: how far around its foot the ground is darker
DARK = 0.25  # fraction of the sky that a stone hides at its foot
AHEAD = 1.5  # times the radius: how far towards the sun the light on a stone is looked up


def made_from(settings: Settings) -> tuple[object, ...]:
    """Return the settings that the stones and their light depend on."""
    ground = settings.ground
    castle = settings.castle
    rabbit = settings.rabbit
    return (
        *(ground.scale_x, ground.scale_z),
        *(ground.height_image, ground.resolution, ground.size, ground.scale_y, ground.smooth),
        *(
            ground.subdivide,
            ground.exact_height,
            ground.ledges,
            ground.large_texture,
            ground.texture_size,
        ),
        *(ground.stones, ground.rock_texture, ground.tone, settings.water.level, settings.sun),
        *(castle.x, castle.z, rabbit.x, rabbit.z, rabbit.scale),
    )


class Stones(Element[Settings]):
    """All stones."""

    @classmethod
    def serves(cls, settings: Settings) -> bool:
        """Return whether there are stones."""
        return wanted(settings)

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return the settings that the stones and their light depend on."""
        return made_from(settings)

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        """Scatter them on the ground, by the seed."""
        return cls(site.settings, site.assets, site.elements[Ground], site.seed)

    def __init__(self, settings: Settings, assets: Assets, ground: Ground, seed: int) -> None:
        """Scatter the stones on the ground by ``seed`` and upload them."""
        self.settings = settings
        self._ground = ground
        self._seed = seed
        path = assets.path(FILE)
        shapes = kept_shapes(path)
        what = "stones", repr((made_from(settings), seed)), content(path)
        files = settings.ground.height_image, settings.ground.large_texture

        def make() -> tuple[np.ndarray, ...]:
            made = bodies(settings, ground, strewn(settings, ground, seed), shapes, seed)
            return made.vertices.view(np.uint8), *list(vars(made).values())[1:]

        raw, *others = recall((*what, *assets.contents(*files)), make)
        self.bodies = Bodies(raw.view(VERTEX), *others)
        self._shapes = shapes
        firsts = [first_shape(kind) for kind in range(len(KINDS))]
        kinds = np.searchsorted(firsts, self.bodies.shapes, side="right") - 1
        limits = np.random.default_rng([seed, 74]).uniform(*LIMITS, len(kinds))
        self._limits = limits * np.array(LEAST_PIXELS)[kinds]
        self._light: np.ndarray | None = None
        self._near: dict[bool, tuple[Frame, np.ndarray]] = {}
        name = settings.ground.rock_texture
        image = read_image(
            assets.path(name, "ground.rock_texture"), largest=settings.ground.texture_size
        )
        self._texture = Texture(image, trilinear=False)
        self._name = int(gl.glGenBuffers(1)) if possible("vertex buffers") else 0
        self._upload(self.bodies.vertices)

    def _upload(self, vertices: np.ndarray) -> None:
        self._kept = vertices
        if self._name:
            data = vertices.view(np.uint8)
            gl.glBindBuffer(gl.GL_ARRAY_BUFFER, self._name)
            gl.glBufferData(gl.GL_ARRAY_BUFFER, data.nbytes, data, gl.GL_STATIC_DRAW)
            gl.glBindBuffer(gl.GL_ARRAY_BUFFER, 0)

    def stand_in(self, ground: Ground) -> None:
        """Take the light of the ground: what stands in a shadow painted there is darker.

        It is looked up beside each stone, towards the sun, where its own shadow is not.
        """
        found, sun = self.bodies, self.settings.sun
        aside = AHEAD * found.radii[:, None] * direction(sun)[[0, 2]]
        light = ground.light(*(found.middles[:, [0, 2]] + aside).T)
        if self._light is not None and np.array_equal(light, self._light):
            return
        self._light = light
        tint, shade = np.array(sun.tint), np.array(sun.shade)
        sunny = np.clip((light - shade) / np.maximum(tint - shade, 1e-3), 0.0, 1.0).min(axis=1)
        self._darken((256.0 * (1.0 - sunny)).astype(np.uint16))

    def _darken(self, hidden: np.ndarray) -> None:
        """Take from each stone the sun's light as far as it is ``hidden``, uint16 (n,) of 256."""
        found = self.bodies
        vertices = found.vertices.copy()
        colours = vertices["colour"]
        for k, levels in enumerate(self._shapes):
            mine = np.flatnonzero((found.shapes == k) & (hidden > 0))
            for level, shape in enumerate(levels):
                which = found.firsts[mine, level, None] + np.arange(len(shape.vertices))
                some = colours[which]
                left = 65535 - hidden[mine, None].astype(np.uint32) * some[..., 3]
                some[..., :3] = some[..., :3] * left[..., None] >> 16
                colours[which] = some

        vertices["colour"][:, 3] = 255
        self._upload(vertices)

    def cast(self, shadows: ShadowMap) -> None:
        """Cast the shadows of the larger stones onto the ground, and darken it at their feet."""
        found = self.bodies
        large = found.radii > SHADED
        feet = found.middles[large]
        feet[:, 1] = shadows.field.terrain_height(feet[:, 0], feet[:, 2])
        shadows.hide_sky(feet, FOOT_SHADE * found.radii[large], DARK)
        points = []
        for k, (shape, *_) in enumerate(self._shapes):
            mine = np.flatnonzero(large & (found.shapes == k))
            which = found.firsts[mine, 0, None] + np.arange(len(shape.vertices))
            corners = found.vertices["point"][which]
            middles = corners[:, shape.triangles].mean(axis=2)
            points += [corners.reshape(-1, 3), middles.reshape(-1, 3)]
        cast_points(shadows, np.concatenate(points).astype(np.float64))

    def towers(self) -> np.ndarray:
        """Return what a walker goes around: x, z, radius and top (n, 4) in units."""
        found = self.bodies
        x, _, z = found.middles.T
        solid = found.tops - self._ground.terrain_height(x, z) > SOLID
        rows = np.stack([x, z, BROAD * found.radii, found.tops], axis=1)
        return np.asarray(rows[solid & (found.shapes < first_shape(LOG))])

    def choice(self, frame: Frame) -> np.ndarray:
        """Return the corners, uint32, of the triangles to draw in a frame.

        Only the stones that the eye may see are looked at; those of the last frame serve while it
        stays near. What is drawn of them depends on this frame alone.
        """
        last = self._near.get(frame.mirrored)
        if last is None or not is_near(last[0], frame):
            last = frame, self.shown(frame, None, REUSE_DISTANCE)
            self._near[frame.mirrored] = last
        return self.select(frame, last[1])

    def shown(
        self, frame: Frame, among: np.ndarray | None = None, margin: float = 0.0
    ) -> np.ndarray:
        """Return the numbers of the stones that are in view and large enough, of ``among`` or all.

        With a ``margin`` in units, of those that may be until the eye has moved that far and turned
        by REUSE_ANGLE.
        """
        found, every = self.bodies, slice(None) if among is None else among
        middles, radii = found.middles[every], found.radii[every]
        if frame.mirrored:
            middles = middles.copy()
            middles[:, 1] = mirrored_height(middles[:, 1], self.settings.water.level)
        away = np.linalg.norm(middles - frame.eye, axis=1)
        pixels = 2.0 * frame.pixels * radii / np.maximum(away - margin, 1e-6)
        drawn = pixels > (MIRRORED if frame.mirrored else 1.0) * self._limits[every]
        if frame.mirrored:
            drawn &= found.tops[every] > self.settings.water.level
        if self.settings.camera.cull:
            turned = REUSE_ANGLE * away if margin else 0.0
            drawn &= in_view(frame, middles, 1.2 * radii + margin + turned)
        return np.flatnonzero(drawn) if among is None else among[drawn]

    def select(self, frame: Frame, among: np.ndarray | None = None) -> np.ndarray:
        """Return the corners, uint32, of the triangles to draw, of the stones ``among`` or all."""
        found, numbers = self.bodies, self.shown(frame, among)
        middles = found.middles[numbers]
        if frame.mirrored:
            middles[:, 1] = mirrored_height(middles[:, 1], self.settings.water.level)
        away = np.linalg.norm(middles - frame.eye, axis=1)
        pixels = 2.0 * frame.pixels * found.radii[numbers] / np.maximum(away, 1e-6)

        # Coarser frames of a walk have the same shapes: a slab that becomes round is seen at once.
        whole = pixels * np.float32(frame.detail.coarser)
        shapes, fine = found.shapes[numbers], (whole / EDGE_PIXELS) ** 2
        corners = [np.empty(0, np.int64)]
        for k, levels in enumerate(self._shapes):
            rest, detail = numbers[shapes == k], fine[shapes == k]
            for level, shape in enumerate(levels):
                last = level == len(levels) - 1
                now = detail >= (0 if last else len(shape.triangles))
                starts = found.firsts[rest[now], level]
                corners.append((starts[:, None] + shape.triangles.reshape(1, -1)).ravel())
                rest, detail = rest[~now], detail[~now]

        return np.concatenate(corners).astype(np.uint32)

    def draw(self, frame: Frame) -> None:
        """Draw the stones in view."""
        corners = self.choice(frame)
        if not len(corners):
            return
        whole = 0 if self._name else self._kept.ctypes.data
        with attrib(gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT):
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._texture.bind()
            multiply(2.0)
            gl.glPushClientAttrib(gl.GL_CLIENT_VERTEX_ARRAY_BIT)
            if self._name:
                gl.glBindBuffer(gl.GL_ARRAY_BUFFER, self._name)
            gl.glInterleavedArrays(gl.GL_T2F_C4UB_V3F, 0, ctypes.c_void_p(whole))
            with front_faces(self.settings.camera.cull):
                gl.glDrawElements(gl.GL_TRIANGLES, len(corners), gl.GL_UNSIGNED_INT, corners)
            if self._name:
                gl.glBindBuffer(gl.GL_ARRAY_BUFFER, 0)
            gl.glPopClientAttrib()

    def take(self, settings: Settings) -> None:
        """Take other settings, by which other stones may be in view."""
        self.settings = settings
        self._near.clear()

    def release(self) -> None:
        """Delete the texture and the buffer; may be called twice."""
        self._texture.release()
        if self._name:
            gl.glDeleteBuffers(1, np.array([self._name], np.uint32))
            self._name = 0
