"""The sea: the water's fixed form, one grid laid before the eye (R16, R17; section 11.2, 12).

Technique: instead of 25 equal patches, a grid whose lines are equal steps of angle as the eye sees
them: cells stay about as large on the screen from the feet to the horizon, there are no borders,
and nothing out of view is sent. A sum of small waves gives each vertex its height
(``water.relief``), its normal, and with ``reflection.rippled`` the place where it looks up the
mirror image: the texture matrix holds bias x projection x camera, so that a vertex given its own
place as texture coordinate falls on its own pixel; the ripples move that place by the angle by
which they tilt the mirror. Waves too short for a far cell are damped: the far water is calm.
``water.shallow`` lays a texture of the sea's depth over the map: clear and turquoise at the beach.
State used: GL_LIGHTING, up to three texture units with GL_COMBINE (OpenGL 1.3) and crossbar (1.4),
texture matrix, GL_BLEND.
"""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from landscape.elements.sea.glitter import Glitter
from landscape.elements.sea.waves import (
    EyeGrid,
    cut_level,
    eye_grid,
    facing,
    mirror_places,
    opacity,
    surface_normals,
    wave_coordinates,
    waves,
)
from landscape.frame import Frame
from landscape.geometry.height_field import HeightField
from landscape.gl.calls import gl
from landscape.gl.state import attrib, client_arrays, combine, matrix
from landscape.gl.texture import Texture
from landscape.gl.texture_target import TextureTarget
from landscape.settings import Settings

ELEMENT = "water"

SHOAL = 0.15  # chosen: units of depth under which the relief dies down towards the beach
CLEAR = 0.085  # chosen: units of depth that hide two thirds of the bottom
BOTTOM = (0.13, 0.29, 0.31)  # chosen: the deep bottom, where the ground is cut
BED_SIZE = 512  # chosen: texels per side of the texture of depths
TURQUOISE = np.array([1.05, 1.5, 1.3])  # chosen: times the water's colour where it is shallow


def bed_picture(depths: np.ndarray) -> np.ndarray:
    """Return depths (n, n) in units, row along z, as a texture, uint8 (n, n, 4), over the map.

    Alpha is what the water hides of the bottom; the colour, half of what multiplies the water's
    own, turns from TURQUOISE to none as it grows deep. The border is opaque: beyond is open sea.
    """
    depth = np.maximum(depths, 0.0)
    hidden = 1.0 - np.exp(-depth / CLEAR)
    hidden[[0, -1], :] = hidden[:, [0, -1]] = 1.0
    tint = 1.0 + (TURQUOISE - 1.0) * np.exp(-depth / (3 * CLEAR))[..., None]
    picture = np.concatenate([np.clip(tint / 2, 0, 1), hidden[..., None]], axis=2)
    return np.ascontiguousarray(picture * 255 + 0.5, np.uint8)


class Sea:
    """Draws the grid; ``texture`` is the water's own, lent by the water surface."""

    def __init__(self, texture: Texture, field: HeightField | None) -> None:
        """Take what is drawn with; the texture of depths is made when first asked for."""
        self._texture = texture
        self._field = field
        self._bed: Texture | None = None
        self._glitter: Glitter | None = None
        self._depths = np.zeros((1, 1))
        if field is not None:
            at = (np.arange(BED_SIZE) + 0.5) / BED_SIZE * field.size
            self._depths = field.water_level - field.terrain_height(at[None, :], at[:, None])
        self._relief = np.clip(self._depths / SHOAL, 0.0, 1.0).astype(np.float32)

    def draw(
        self,
        frame: Frame,
        settings: Settings,
        square: tuple[float, float],
        mirror: tuple[TextureTarget, np.ndarray] | None,
    ) -> None:
        """Draw the sea inside ``square``, its low and high border; lit and blended as it stands.

        ``mirror`` is the mirror image and its matrix, or None to blend over the framebuffer.
        """
        water = settings.water
        reach = float(np.hypot(*[max(abs(frame.eye[k] - e) for e in square) for k in (0, 2)]))
        grid = eye_grid(frame, water.level, reach)
        if grid is None:
            return
        grid.keep_within(*square)
        t = frame.kt * water.time_step if water.animated else 0.0
        lift, slope_x, slope_z = waves(grid.x, grid.z, grid.cell, t)
        y = np.full(grid.x.shape, water.level, np.float32)
        if water.relief:
            y += lift * self._shoaling(grid)
        vertices = np.empty((y.size, 3), np.float32)
        vertices[:, 0], vertices[:, 1], vertices[:, 2] = grid.x.ravel(), y.ravel(), grid.z.ravel()
        colors = np.empty((len(vertices), 4), np.float32)
        colors[:] = water.color
        if water.fresnel:
            colors[:, 3] = opacity(facing(grid, slope_x, slope_z), water.color[3]).ravel()
        plane = np.stack([grid.x.ravel(), grid.z.ravel()])
        places = np.ascontiguousarray(plane.T)
        layers = [wave_coordinates(plane / np.float32(water.patch), t, water.repeat)]
        bed = self._bed_texture() if water.shallow else None
        if bed is not None and self._field is not None:
            layers.append(places / np.float32(self._field.size))
            if cut_level(settings) < water.level:
                self._draw_bottom(cut_level(settings), self._field.size)
        triangles = grid.triangles
        # GL_TEXTURE_BIT brings back every unit's environment, and which unit is active.
        with attrib(gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT):
            if water.textured:
                gl.glEnable(gl.GL_TEXTURE_2D)
                self._texture.bind()
            if bed is not None:
                self._bed_unit(bed)
            with client_arrays(vertices, surface_normals(slope_x, slope_z), colors, layers):
                with self._mirror_unit(mirror, len(layers)) as mirrored:
                    if mirrored:
                        looked = mirror_places(grid, y, slope_x, slope_z)
                        gl.glTexCoordPointer(3, gl.GL_FLOAT, 0, looked)
                    gl.glDrawElements(
                        gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles
                    )
        if water.glitter > 0:
            if self._glitter is None:
                self._glitter = Glitter()
            self._glitter.draw(frame, settings, grid, (vertices, places), (slope_x, slope_z))

    def _shoaling(self, grid: EyeGrid) -> np.ndarray:
        """Return the part of the relief left (rows, columns): none where the water ends."""
        if self._field is None:
            return np.ones_like(grid.x)
        scale = np.float32(BED_SIZE / self._field.size)
        row, column = (np.clip(a * scale, 0, BED_SIZE - 1).astype(int) for a in (grid.z, grid.x))
        return np.asarray(self._relief.take(row * BED_SIZE + column))

    def _bed_texture(self) -> Texture | None:
        if self._bed is None and self._field is not None:
            self._bed = Texture(bed_picture(self._depths), repeat=False)
        return self._bed

    def _draw_bottom(self, level: float, size: float) -> None:
        """Draw the plane that closes the sea where the ground is cut; steep coasts show it.

        Without fog: that is reckoned at the corners, which on so large a square means nothing near.
        """
        with attrib(gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_COLOR_BUFFER_BIT):
            for cap in (gl.GL_BLEND, gl.GL_LIGHTING, gl.GL_TEXTURE_2D, gl.GL_FOG):
                gl.glDisable(cap)
            gl.glColor3f(*BOTTOM)
            gl.glBegin(gl.GL_QUADS)
            for x, z in ((0.0, 0.0), (0.0, size), (size, size), (size, 0.0)):
                gl.glVertex3f(x, level, z)
            gl.glEnd()

    def _bed_unit(self, bed: Texture) -> None:
        """Unit 1: the colour times twice the tint of the depth; its alpha waits for unit 2."""
        gl.glActiveTexture(gl.GL_TEXTURE1)
        gl.glEnable(gl.GL_TEXTURE_2D)
        bed.bind()
        combine({"COMBINE_RGB": "MODULATE", "SRC0_RGB": "PREVIOUS", "SRC1_RGB": "TEXTURE"})
        combine({"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": "PREVIOUS"})
        gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, 2.0)

    @contextmanager
    def _mirror_unit(
        self, mirror: tuple[TextureTarget, np.ndarray] | None, unit: int
    ) -> Iterator[bool]:
        """Unit 1 or 2: mix the mirror image in, by the primary colour's alpha.

        Alpha comes out as 1, or with the depths on unit 1 as what is left unseen of the bottom.
        """
        if mirror is None:
            yield False
            return
        target, projection = mirror
        name = getattr(gl, f"GL_TEXTURE{unit}")
        gl.glActiveTexture(name)
        gl.glEnable(gl.GL_TEXTURE_2D)
        target.bind()
        combine({"COMBINE_RGB": "INTERPOLATE", "SRC0_RGB": "PREVIOUS", "SRC1_RGB": "TEXTURE"})
        combine({"SRC2_RGB": "PRIMARY_COLOR", "OPERAND2_RGB": "SRC_ALPHA"})
        gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, np.ones(4, np.float32))
        if unit == 1:
            combine({"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": "CONSTANT"})
        else:
            combine({"COMBINE_ALPHA": "INTERPOLATE", "SRC0_ALPHA": "TEXTURE1"})
            combine({"SRC1_ALPHA": "CONSTANT", "SRC2_ALPHA": "PRIMARY_COLOR"})
        gl.glClientActiveTexture(name)
        gl.glEnableClientState(gl.GL_TEXTURE_COORD_ARRAY)
        gl.glMatrixMode(gl.GL_TEXTURE)
        try:
            with matrix():
                gl.glLoadMatrixf(np.ascontiguousarray(projection.T, np.float32))
                yield True
        finally:
            gl.glMatrixMode(gl.GL_MODELVIEW)
            gl.glDisableClientState(gl.GL_TEXTURE_COORD_ARRAY)

    def release(self) -> None:
        """Delete what was made; may be called twice."""
        for owner in (self._bed, self._glitter):
            if owner is not None:
                owner.release()
        self._bed = self._glitter = None
