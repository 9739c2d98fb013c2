"""The sea: water with waves and a rippling mirror image, one grid around the eye (R16, R17).

It replaces WaterSurface, and has the same methods. Sections 11.2 and 12 of the report.
Technique: instead of 25 equal patches, a grid whose lines are equal steps of angle as the eye sees
them (eye_grid.py). A sum of small waves gives each vertex its normal, its height
(``water.relief``), and with ``reflection.rippled`` the place where it looks up the mirror image
(mirror_image.py). With ``water.fresnel`` the alpha of each vertex follows the angle of view: the
water's own colour from above, a mirror in the distance. With ``water.sheltered`` the waves are
lower near land (shelter.py). ``water.shallow`` shows the bottom through shallow water
(shallows.py), ``water.glitter`` adds the sun's glints (glitter.py), ``water.run_up`` lets waves
climb the sand (run_up.py).
Without ``reflection.rippled`` the mirror image is in the framebuffer, and the grid is blended over
it as the patches are. Where there are too few texture units for water and image at once, the image
is drawn first, too (mirror_pass.py).
State used: GL_LIGHTING, up to four texture units with GL_COMBINE (OpenGL 1.3) and crossbar (1.4),
texture matrix, GL_BLEND.
"""

import math
from collections.abc import Hashable, Iterator
from contextlib import contextmanager
from typing import Self

import numpy as np

from framelens.gl.seam import drawing, drawn_now, gl
from framelens.gl.state import attrib, client_arrays
from landscape.elements.best.sea import ripples, serpent_wash
from landscape.elements.best.sea.eye_grid import EyeGrid, eye_grid
from landscape.elements.best.sea.foam import Foam
from landscape.elements.best.sea.glitter import Glitter
from landscape.elements.best.sea.mirror_image import MirrorImage, Taken, mirror_unit
from landscape.elements.best.sea.mirror_pass import draw_mirror
from landscape.elements.best.sea.ripples import Ripples
from landscape.elements.best.sea.run_up import RunUp
from landscape.elements.best.sea.serpent_wash import rings_around
from landscape.elements.best.sea.shallows import (
    TEXELS,
    Shallows,
    cut_level,
    draw_floor,
    hidden_bottom,
    sea_depths,
)
from landscape.elements.best.sea.shelter import wave_heights
from landscape.elements.best.sea.waves import (
    facing,
    mirror_places,
    opacity,
    surface_normals,
    unfolded,
    waves,
)
from landscape.elements.element import Element, Site
from landscape.elements.ground import Ground
from landscape.elements.reflection import inside_water
from landscape.elements.settings import Settings
from landscape.elements.sun import lit
from landscape.elements.water_surface import (
    WaterSurface,
    water_square,
    water_texture,
    wave_coordinates,
    wave_time,
)
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.geometry.height_field import HeightField
from landscape.gl.draw import level_square
from landscape.gl.features import possible

SHOAL = 0.15  # chosen: units of depth below which the relief fades out towards the beach
SOFT = 8.0  # chosen: mip levels by which the mirrored sky is blurred, times water.ripples


def fog_depths(grid: EyeGrid, density: float, least: float, power: int) -> np.ndarray:
    """Return the depth in fog of each vertex, float32 (n,), units, never past a certain depth.

    Nearby it is the distance from the eye; far away the fog leaves the fraction ``least``.
    ``power`` is 1 or 2, the power of density x depth in the fog's equation.
    """
    most = (-math.log(least)) ** (1.0 / power) / density
    sight = grid.sight[:, 0]
    depth = sight / (1.0 + (sight / most) ** 4) ** 0.25
    return np.ascontiguousarray(np.repeat(depth.astype(np.float32), grid.x.shape[1]))


@contextmanager
def reflected(
    frame: Frame, settings: Settings, water: "WaterSurface | Sea | None"
) -> Iterator[Frame]:
    """Let the block draw the mirrored scene where it belongs; yield the frame to draw it by.

    That is the sea's mirror texture, or the framebuffer: with ``reflection.stencil`` only where
    the water is, if there is any.
    """
    if isinstance(water, Sea) and settings.reflection.rippled:
        outside = drawn_now()
        with drawing("reflection"), water.mirror.drawing(frame) as smaller, drawing(*outside):
            yield smaller
    else:
        with inside_water(water.mark if water and settings.reflection.stencil else None):
            yield frame


def kept(frame: Frame, settings: Settings, water: "WaterSurface | Sea | None") -> bool:
    """Return whether the last mirror image serves this frame too (``Detail.mirror_frames``)."""
    return isinstance(water, Sea) and settings.reflection.rippled and water.mirror.keep(frame)


@contextmanager
def softened(settings: Settings) -> Iterator[None]:
    """Blur the textures of what the block draws for the mirror image, if the water is rippled.

    Clouds with firm edges would show that the image is smooth where the ripples are not.
    """
    rippled = settings.reflection.rippled and settings.water.ripples > 0
    if not rippled or not possible("sharper textures"):
        yield
        return
    unit = gl.GL_TEXTURE_FILTER_CONTROL, gl.GL_TEXTURE_LOD_BIAS
    gl.glTexEnvf(*unit, SOFT * settings.water.ripples)
    try:
        yield
    finally:
        gl.glTexEnvf(*unit, 0.0)


def rippling(settings: Settings) -> bool:
    """Return whether there are ripples at each pixel."""
    return settings.water.textured and settings.water.ripples > 0


class Sea(Element[Settings]):
    """The sea; ``mirror`` takes the mirrored scene before each ``draw``."""

    asked_by = (
        "reflection.rippled",
        "water.relief",
        "water.shallow",
        "water.fresnel",
        "water.glitter",
        "water.foam",
        "water.ripples",
        "water.horizon_contrast",
    )
    ignores = ("water.points",)

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        """Build it over the ground; around a dragon that may be shown there is foam."""
        return cls(site.settings, site.assets, site.elements[Ground].field, "dragon" in site.only)

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return the values that the constructor uses."""
        water = settings.water
        looks = water.trilinear, water.lod_bias, water.shallow, water.sheltered
        foam = (serpent_wash.built_from(settings), water.run_up) if water.foam else None
        rippled = ripples.built_from(settings) if rippling(settings) else None
        return water.level, *looks, foam, water.glitter > 0, rippled

    def __init__(
        self, settings: Settings, assets: Assets, field: HeightField, dragon: bool = False
    ) -> None:
        """Load the texture, and compute how deep the sea over ``field`` is.

        With ``dragon`` there is foam around the dragon, too.
        """
        self.settings = settings
        self._size = field.size
        # The mesh is read before any texture is made: if it cannot be, nothing is left behind.
        rings = rings_around(settings, assets) if settings.water.foam and dragon else None
        depths = sea_depths(field)
        self._relief = np.clip(depths / SHOAL, 0.0, 1.0).astype(np.float32)
        self._hidden = hidden_bottom(depths).astype(np.float32)
        self._waves = wave_heights(depths, field.size) if settings.water.sheltered else None
        self.mirror = MirrorImage()
        self._ripples = self._texture = self._shallows = None
        if rippling(settings):
            self._ripples = Ripples(settings, depths, field.size)
        else:
            self._texture = water_texture(settings, assets)
            if settings.water.shallow and possible("water.shallow"):
                self._shallows = Shallows(depths, field.size)

        water = settings.water
        self._foam = Foam(field, rings, water.run_up) if water.foam else None
        climbing = water.foam and water.run_up and possible("water.foam")
        self._run_up = RunUp(field) if climbing else None
        self._glitter = Glitter() if settings.water.glitter > 0 else None

    def mark(self) -> None:
        """Send the bare surface without its waves, for the stencil."""
        level_square(*water_square(self.settings.water), self.settings.water.level)

    def draw(self, frame: Frame) -> None:
        """Draw the surface, mixed with the mirror texture or blended over the framebuffer."""
        mirror = image = self.mirror.take()
        water = self.settings.water
        grid = self._grid(frame)
        if grid is None:
            return
        t = wave_time(frame.kt, water)
        heaving = waves(grid.x, grid.z, grid.cell, t, unfolded(grid))
        rough = np.ones(grid.x.shape, np.float32)
        if self._waves is not None:
            rough = self._at_vertices(self._waves, grid).reshape(rough.shape)
            heaving = tuple(rough * each for each in heaving)
        lift, slope_x, slope_z, move_x, move_z = heaving
        y = np.full(grid.x.shape, water.level, np.float32)
        if water.relief:
            y += lift * self._at_vertices(self._relief, grid).reshape(y.shape)
        vertices = np.stack([grid.x.ravel(), y.ravel(), grid.z.ravel()], axis=1)
        places = np.ascontiguousarray(vertices[:, ::2])
        tilts = slope_x, slope_z, move_x, move_z

        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT
        with attrib(groups):
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            floor = cut_level(self.settings)
            if water.shallow and floor < water.level:
                draw_floor(floor, self._size, self.settings.sun)
            with self._clearer_fog(grid):
                if mirror is not None and not self._in_one_pass:
                    looked_up = mirror_places(grid, y, move_x, move_z)
                    hidden = self._at_vertices(self._hidden, grid) if water.shallow else 1.0
                    draw_mirror(mirror, vertices, looked_up, hidden, grid.triangles)
                    mirror = None
                if self._ripples is not None:
                    self._ripples.draw(self.settings, grid, vertices, tilts, rough, t, mirror)
                else:
                    self._draw_plain(grid, vertices, places, tilts, t, mirror)
            if self._foam is not None:
                with self._clearer_fog(grid):
                    self._foam.draw(frame, self.settings, grid, vertices, places)
            if self._run_up is not None:
                self._run_up.draw(frame, self.settings, image)
            if self._glitter is not None:
                surface, slopes = (vertices, places), (slope_x, slope_z)
                self._glitter.draw(frame, self.settings, grid, surface, slopes)

    @property
    def _in_one_pass(self) -> bool:
        """Whether water and mirror image are drawn at once."""
        what = "water.ripples" if self._ripples is not None else "reflection.rippled"
        return possible(f"{what} in one pass")

    def _draw_plain(
        self,
        grid: EyeGrid,
        vertices: np.ndarray,
        places: np.ndarray,
        tilts: tuple[np.ndarray, ...],
        t: float,
        mirror: Taken | None,
    ) -> None:
        """Draw the surface without ripples at each pixel, with the texture of 2006."""
        water, (slope_x, slope_z, move_x, move_z) = self.settings.water, tilts
        normals, colors = surface_normals(slope_x, slope_z), self._colors(grid, slope_x, slope_z)
        layers = [wave_coordinates(places.T / np.float32(water.patch), t, water.repeat)]
        if self._shallows is not None:
            layers.append(self._shallows.coordinates(places))
        depths = None if self._shallows is None else 1
        lit(self.settings.shading)
        gl.glLightModeli(gl.GL_LIGHT_MODEL_LOCAL_VIEWER, gl.GL_TRUE)

        with (
            self._texture_units(),
            client_arrays(vertices, normals, colors, layers),
            mirror_unit(mirror, len(layers), depths),
        ):
            if mirror is not None:
                looked_up = mirror_places(
                    grid, vertices[:, 1].reshape(grid.x.shape), move_x, move_z
                )
                gl.glTexCoordPointer(3, gl.GL_FLOAT, 0, looked_up)
            triangles = grid.triangles
            gl.glDrawElements(gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles)

    def _grid(self, frame: Frame) -> EyeGrid | None:
        """Return the grid on all water in view; None if there is none."""
        water = self.settings.water
        low, high = water_square(water)
        corner = [max(abs(eye - low), abs(eye - high)) for eye in (frame.pose.x, frame.pose.z)]
        grid = eye_grid(frame, water.level, math.hypot(*corner))
        if grid is not None:
            grid.keep_within(low, high)
        return grid

    def _colors(self, grid: EyeGrid, slope_x: np.ndarray, slope_z: np.ndarray) -> np.ndarray:
        """Return the vertices' colours, float32 (n, 4); alpha is the opacity over the mirror."""
        water = self.settings.water
        colors = np.empty((grid.x.size, 4), np.float32)
        colors[:] = water.color
        if water.fresnel:
            colors[:, 3] = opacity(facing(grid, slope_x, slope_z), water.color[3]).ravel()
        return colors

    def _at_vertices(self, picture: np.ndarray, grid: EyeGrid) -> np.ndarray:
        """Return what a map (TEXELS, TEXELS) of the sea holds at the grid's vertices, (n,)."""
        scale = np.float32(TEXELS / self._size)
        row, column = (np.clip(a * scale, 0, TEXELS - 1).astype(int) for a in (grid.z, grid.x))
        return np.asarray(picture.take((row * TEXELS + column).ravel()))

    @contextmanager
    def _clearer_fog(self, grid: EyeGrid) -> Iterator[None]:
        """Let the fog leave ``water.horizon_contrast`` of the sea's colour at the horizon."""
        fog, least = self.settings.fog, self.settings.water.horizon_contrast
        if least <= 0 or not fog.enabled or fog.mode == "linear" or fog.density <= 0:
            yield
            return
        depths = fog_depths(grid, fog.density, least, 2 if fog.mode == "exp2" else 1)
        # Not by glPushAttrib, which in Mesa does not bring the source of the depth back.
        gl.glFogi(gl.GL_FOG_COORD_SRC, gl.GL_FOG_COORD)
        gl.glEnableClientState(gl.GL_FOG_COORD_ARRAY)
        gl.glFogCoordPointer(gl.GL_FLOAT, 0, depths)
        try:
            yield
        finally:
            gl.glDisableClientState(gl.GL_FOG_COORD_ARRAY)
            gl.glFogi(gl.GL_FOG_COORD_SRC, gl.GL_FRAGMENT_DEPTH)

    @contextmanager
    def _texture_units(self) -> Iterator[None]:
        """Unit 0: the water's texture times the light; then the depths, if any."""
        # GL_TEXTURE_BIT restores every unit's environment, and which unit is active.
        with attrib(gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT):
            if self._texture is not None and self.settings.water.textured:
                gl.glEnable(gl.GL_TEXTURE_2D)
                self._texture.bind()
            if self._shallows is not None:
                self._shallows.set_unit(1)
            yield

    def release(self) -> None:
        """Delete what was made; may be called twice."""
        owned = self._ripples, self._texture, self._shallows, self._foam, self._glitter
        for owner in (self.mirror, *owned, self._run_up):
            if owner is not None:
                owner.release()
