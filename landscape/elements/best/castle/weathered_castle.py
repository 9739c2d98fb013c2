"""The castle that has stood for centuries: uneven stones, stains, moss, rubble, ivy.

Its wall texture has stones of many sizes; a light map of more texels holds the weathering
(weathering.py). Single stones frame the windows, carry the parapets and lie at its foot, and the
roofs have slates; their vertices' colours are the light that the light map would have there. Seen
from afar, what is smaller than a pixel is left out.
Not in the report; switch ``castle.weathered``.
State used: as ornate_castle.py; alpha test, polygon offset.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays
from framelens.gl.texture import Texture
from landscape.elements.best.castle.baked_light import arriving, noise
from landscape.elements.best.castle.blocks import (
    Blocks,
    add_copings,
    add_corbels,
    add_frames,
    add_quoins,
    add_steps,
)
from landscape.elements.best.castle.footing import Ground, ground_marks, rubble
from landscape.elements.best.castle.grain import grain, grained
from landscape.elements.best.castle.growth import leaves
from landscape.elements.best.castle.ivy import PER_LEAF, remembered_leaves, remembered_shade
from landscape.elements.best.castle.loopholes import loopholes, openings
from landscape.elements.best.castle.ornate_castle import OrnateCastle
from landscape.elements.best.castle.slates import slate_roofs
from landscape.elements.best.castle.weathering import worn_light, worn_light_map
from landscape.elements.settings import Settings
from landscape.elements.sun import direction, lit, painted
from landscape.files.assets import Assets
from landscape.files.cache import recall
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.height_field import HeightField
from landscape.geometry.mesh import Mesh
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh

# Chosen: units from its middle within which the stones' grain and single leaves are seen.
CLOSE = 2.0
NEAR, MIDDLE = 5.5, 9.0  # chosen: units from the castle within which stones, and leaves, are seen
SOLID = 0.35  # chosen: alpha from which a texel of a leaf is drawn
BEHIND = 0.55  # chosen: light that single leaves leave on the pictures of leaves behind them
# Chosen: windows that are lit, by their number; their colour by day, and what dusk adds to it.
LIT = (24, 27, 29, 31, 34, 36, 38)
DIM, BRIGHT = np.array([0.26, 0.16, 0.07]), np.array([0.74, 0.56, 0.26])
LEAST = 0.55  # chosen: light on a leaf or stone whose middle is within the wall
UNLIT = np.array([0.035, 0.034, 0.038])


def coloured(mesh: Mesh, colours: np.ndarray) -> Mesh:
    """Return a mesh with colours (n, 3), which are clamped to 0..1."""
    bytes_ = np.full((len(colours), 4), 255, np.uint8)
    bytes_[:, :3] = np.clip(colours, 0.0, 1.0) * 255 + 0.5
    return replace(mesh, colors=bytes_)


def opening_colours(torches: float) -> np.ndarray:
    """Return the colours, float32 (4 n, 3), of the corners of n openings; a few are lit.

    ``torches`` is 0 by day and 1 in the dark.
    """
    wide = np.array([opening.half > 0.012 for opening in openings()])
    glow = (np.isin(np.arange(len(wide)), LIT) & wide)[:, None]
    base = np.where(glow, DIM + torches * BRIGHT, UNLIT)
    # Light falls in from below the lintel only: the upper corners are darker.
    shade = np.where(glow, (1.0, 0.85, 0.6, 0.7), (1.5, 1.2, 0.5, 0.6))
    return (base[:, None] * shade[..., None]).reshape(-1, 3).astype(np.float32)


class WeatheredCastle(OrnateCastle):
    """The ornate castle, old."""

    BRICKS = "castle_ashlar.png"
    SPAN = 0.75  # chosen: its stones are of the bricks' size, but fill a larger picture

    @classmethod
    def serves(cls, settings: Settings) -> bool:
        """Return whether an ornate castle is to be weathered."""
        return super().serves(settings) and settings.castle.weathered

    def __init__(self, settings: Settings, assets: Assets, field: HeightField) -> None:
        """Compute the light on all of it, or take it from the cache, and compile the lists."""
        self._slates = Texture(read_image(assets.path("castle_slate.png"), "RGB"))
        self._leaves = Texture(read_image(assets.path("castle_leaves.png")), repeat=False)
        super().__init__(settings, assets, field)
        self._grain = Texture(grain())
        bare = replace(self._bricks, coordinates=self._bricks.coordinates[:1])
        self._grain_list = DisplayList(lambda: draw_mesh(bare))
        self._stones_list = DisplayList(self._send_stones)
        self._ivy = Texture(read_image(assets.path("castle_ivy.png")), repeat=False)
        growth, tints = self._kept("leaves", leaves)
        self._leaves_list = DisplayList(lambda: self._send_leaves(growth, tints))
        self._ivy_list = DisplayList(lambda: self._send_ivy(growth, tints))
        self._shade_list = DisplayList(lambda: self._send_shade(growth))
        self._marks_list = DisplayList(self._send_marks)

    def _light_on(self, mesh: Mesh, strips: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
        castle = self.settings.castle
        return worn_light_map(mesh, strips, self.settings.sun, castle.yaw, castle.torches)

    def _lit(self, name: str, mesh: Mesh, tints: np.ndarray, worn: bool = True) -> Mesh:
        """Return a mesh coloured by the light on it times tints (n, 3)."""
        return coloured(mesh, self._light_at(name, mesh.vertices, mesh.normals, worn) * tints)

    def _light_at(
        self, name: str, vertices: np.ndarray, normals: np.ndarray, worn: bool
    ) -> np.ndarray:
        """Return the light (n, 3) on vertices (n, 3), LEAST or more, or that in the cache."""
        castle, sun = self.settings.castle, self.settings.sun
        light = worn_light if worn else arriving

        def make() -> tuple[np.ndarray]:
            places, facing = vertices.astype(float), normals.astype(float)
            return (light(places, facing, sun, castle.yaw, castle.torches),)

        made_from = repr((castle.yaw, castle.torches, sun))
        (found,) = recall([name, made_from, vertices.tobytes()], make)
        return np.maximum(found, LEAST)

    def _kept(
        self, name: str, make: Callable[[Ground], tuple[Mesh, np.ndarray]]
    ) -> tuple[Mesh, np.ndarray]:
        """Return a mesh that ``make`` lays on the ground, and its tints (n, 3), from the cache."""

        def arrays() -> tuple[np.ndarray, ...]:
            mesh, tints = make(self._ground_at)
            return tints, mesh.vertices, mesh.normals, mesh.triangles, *mesh.coordinates

        where = repr((self.base, self._yaw))
        kept = recall([name, where, *self._field.made_from], arrays)
        tints, vertices, normals, triangles, *coordinates = kept
        return Mesh(vertices, normals, triangles, tuple(coordinates)), tints

    def _send_roofs(self) -> None:
        self._slates.bind()
        mesh = slate_roofs()
        # Below the eaves it is dark; a roof is a little paler and darker in places.
        places, up = mesh.vertices.astype(float), mesh.normals[:, 1:2]
        tone = np.where(up < -0.5, 0.45, 0.78 + 0.34 * noise(places, (9.0, 5.0, 9.0), 23)[:, None])
        draw_mesh(self._lit("slates", mesh, tone, worn=False))
        gl.glColor3f(1.0, 1.0, 1.0)

    def _send_openings(self) -> None:
        """Send what is behind loopholes and windows, dark but for those that are lit."""
        vertices = np.ascontiguousarray(loopholes().reshape(-1, 3), np.float32)
        colours = opening_colours(self.settings.castle.torches)
        with attrib(gl.GL_ENABLE_BIT), client_arrays(vertices, None, colours):
            gl.glDisable(gl.GL_LIGHTING)
            gl.glDrawArrays(gl.GL_QUADS, 0, len(vertices))

    def _send_stones(self) -> None:
        blocks = Blocks(4)
        for add in (add_frames, add_corbels, add_quoins, add_copings):
            add(blocks)
        built, tints = blocks.mesh(self._repeat)
        self._brick.bind()
        draw_mesh(self._lit("single stones", built, tints))
        steps = Blocks(5)
        add_steps(steps, float(self._ground_at(np.array([[0.5, -0.05]]))[0]))
        laid, tints = steps.mesh(self._repeat)
        draw_mesh(self._lit("steps", laid, tints, worn=False))
        fallen, tints = self._kept("rubble", rubble)
        gl.glShadeModel(gl.GL_FLAT)  # broken stones have facets
        draw_mesh(self._lit("rubble", fallen, tints, worn=False))

    def _send_leaves(self, growth: Mesh, tints: np.ndarray) -> None:
        self._leaves.bind()
        gl.glEnable(gl.GL_ALPHA_TEST)
        gl.glAlphaFunc(gl.GL_GREATER, SOLID)
        draw_mesh(self._lit("leaves", growth, tints, worn=False))

    def _send_ivy(self, growth: Mesh, tints: np.ndarray) -> None:
        """Send the leaves as for an arm's length: single ones before the ivy's pictures."""
        darker = tints.copy()
        darker[growth.coordinates[0][:, 1] < 0.5] *= BEHIND
        self._send_leaves(growth, darker)
        self._ivy.bind()
        mesh, own = remembered_leaves(growth, self._ground_at)
        # A leaf is small: the light at its foot is that on all of it.
        foot = slice(1, None, PER_LEAF)
        light = self._light_at("single leaves", mesh.vertices[foot], mesh.normals[foot], worn=False)
        draw_mesh(coloured(mesh, np.repeat(light, PER_LEAF, axis=0) * own))

    @staticmethod
    def _send_shade(growth: Mesh) -> None:
        """Send the shade on the wall behind the ivy."""
        vertices, colours, triangles = remembered_shade(growth)
        with client_arrays(vertices, None, colours):
            gl.glDrawElements(gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles)

    def _send_marks(self) -> None:
        """Send what darkens the ground, in the light that reaches it."""
        castle, sun = self.settings.castle, self.settings.sun
        vertices, colours, triangles = ground_marks(self._ground_at)
        up = np.tile([0.0, 1.0, 0.0], (len(vertices), 1))
        made_from = repr((castle.yaw, castle.torches, sun))
        (light,) = recall(
            ["ground marks", made_from, vertices.tobytes()],
            lambda: (arriving(vertices.astype(float), up, sun, castle.yaw, castle.torches),),
        )
        colours[:, :3] *= np.clip(light, 0.3, 1.2) * painted(sun, direction(sun)[1])
        with client_arrays(vertices, None, colours):
            gl.glDrawElements(gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles)

    def _draw_details(self, frame: Frame) -> None:
        """Draw what is seen only from nearby."""
        away = float(np.linalg.norm(frame.eye - (self.base[0], self.base[1] + 0.5, self.base[2])))
        if away > MIDDLE or frame.mirrored:
            return
        if away < CLOSE:
            with grained(self._grain):
                self._grain_list.call()
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT
        groups |= gl.GL_DEPTH_BUFFER_BIT | gl.GL_POLYGON_BIT | gl.GL_TEXTURE_BIT
        with attrib(groups):
            gl.glDepthMask(gl.GL_FALSE)
            gl.glDisable(gl.GL_TEXTURE_2D)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
            gl.glPolygonOffset(-2.0, -4.0)
            self._marks_list.call()
            if away < CLOSE:
                self._shade_list.call()

        with attrib(groups):
            gl.glDisable(gl.GL_BLEND)
            gl.glEnable(gl.GL_TEXTURE_2D)
            lit(self.settings.shading)
            if away < NEAR:
                gl.glEnable(gl.GL_CULL_FACE)
                self._stones_list.call()
                gl.glDisable(gl.GL_CULL_FACE)
            (self._ivy_list if away < CLOSE else self._leaves_list).call()

    def release(self) -> None:
        """Delete the lists and the textures; may be called twice."""
        grown = self._leaves_list, self._ivy_list, self._shade_list
        for compiled in (self._stones_list, *grown, self._marks_list, self._grain_list):
            compiled.release()
        for texture in (self._slates, self._leaves, self._ivy, self._grain):
            texture.release()
        super().release()
