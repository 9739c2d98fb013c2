"""The water: a transparent animated plane over the reflection (Water_surface, section 3).

Technique: one patch of 40 x 40 vertices, sent from arrays each frame and drawn 5 x 5 times by
translation, blended GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA. The plane stays flat: what moves are the
texture coordinates and, under the light, the normals. All terms have period 1 over the patch, so
patches match. ``water.fresnel`` gives each vertex its own alpha: clear when looked down at, a
mirror far off; ``water.horizon`` adds a sea round the patches, up to where the fog takes it.
``water.cull`` leaves out the patches that are not in view, ``water.query`` all of it (SeaWatch).
With ``reflection.rippled``, ``water.relief`` or ``water.shallow`` the patches make way for the Sea;
``water.foam`` comes last.
State used: GL_BLEND, GL_LIGHTING, GL_TEXTURE_2D, GL_COLOR_MATERIAL.
"""

import numpy as np

from landscape.elements.reflection import MirrorImage
from landscape.elements.sea.foam import Foam
from landscape.elements.sea.sea import Sea
from landscape.elements.sea.sea_watch import SeaWatch
from landscape.elements.sea.waves import TWO_PI, fresnel_alpha, wave_coordinates
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.camera import boxes_in_view
from landscape.geometry.height_field import HeightField
from landscape.geometry.mesh import grid_triangles
from landscape.gl.calls import gl
from landscape.gl.state import attrib, client_arrays, matrix
from landscape.gl.texture import Texture
from landscape.settings import Settings

ELEMENT = "water"

PATCHES = range(-1, 4)  # section 3.2: k from -1 to 3, on both axes
RIPPLE_SLOPE = 0.07  # chosen: steepness of one ripple
# Chosen: waves over the patch in x and z, phase in radians; the last column is their number.
RIPPLES = np.array(
    [(3, 1, 0.3), (-2, 4, 1.9), (5, -3, 4.0), (1, 6, 5.2), (-6, -4, 2.2), (8, 3, 0.9), (-3, 9, 3.1)]
)
RIPPLES = np.column_stack([RIPPLES, np.hypot(RIPPLES[:, 0], RIPPLES[:, 1])])


def patch_plane(points: int) -> np.ndarray:
    """Return px, py of the patch's vertices, float64 (2, n): 0..1, x fastest."""
    along = np.linspace(0.0, 1.0, points)
    px, py = np.meshgrid(along, along)
    return np.stack([px.ravel(), py.ravel()])


def wave_normals(plane: np.ndarray, t: float) -> np.ndarray:
    """Return the unit normals, float32 (n, 3), at time ``t`` (section 3.2)."""
    px, py = plane
    x = 0.25 * np.sin(2 * t - py * TWO_PI) ** 2
    z = 0.5 * np.sin(3 * t - px * TWO_PI) ** 2
    normals = np.stack([x, np.ones_like(x), z], axis=1)
    return (normals / np.linalg.norm(normals, axis=1, keepdims=True)).astype(np.float32)


def ripple_normals(plane: np.ndarray, t: float) -> np.ndarray:
    """Return the unit normals, float32 (n, 3), of a choppy sea: a sum of small waves.

    Each runs a whole number of times over the patch, so patches still match; no two run the same
    way, so that the sun's glints scatter where the report's two waves line them up in a grid.
    """
    phase = TWO_PI * (RIPPLES[:, :2] @ plane) + (RIPPLES[:, 2:3] - 1.2 * t * RIPPLES[:, 3:])
    slope = RIPPLE_SLOPE * np.cos(phase) / RIPPLES[:, 3:]
    x, z = slope.T @ RIPPLES[:, 0], slope.T @ RIPPLES[:, 1]
    normals = np.stack([x, np.ones_like(x), z], axis=1)
    return (normals / np.linalg.norm(normals, axis=1, keepdims=True)).astype(np.float32)


def sea_ring(inner: tuple[float, float], reach: float) -> tuple[np.ndarray, np.ndarray]:
    """Return points (n, 2) of x, z and triangles (m, 3) of the sea round the patches.

    A grid whose lines stand ever farther apart, from the patches' square ``inner`` = (low, high)
    out to ``reach``; the cell the patches fill is left out.
    """
    low, high = inner
    steps = reach * np.array([0.02, 0.05, 0.12, 0.3, 1.0])
    lines = np.concatenate([low - steps[::-1], np.linspace(low, high, 6), high + steps])
    x, z = np.meshgrid(lines, lines)
    points = np.stack([x.ravel(), z.ravel()], axis=1)
    triangles = grid_triangles(len(lines), len(lines))
    centre = points[triangles].mean(axis=1)
    outside = ((centre < low) | (centre > high)).any(axis=1)
    return points, np.ascontiguousarray(triangles[outside])


class WaterSurface:
    """The water surface; ``draw`` computes the waves of the frame's kt."""

    def __init__(
        self, settings: Settings, assets: Assets, field: HeightField | None = None
    ) -> None:
        """Build the patch and load the texture; ``field`` tells the fixes how deep the sea is."""
        self._settings = settings
        water = settings.water
        self._plane = patch_plane(water.points)
        level = np.full(self._plane.shape[1], water.level)
        place = [self._plane[0] * water.patch, level, self._plane[1] * water.patch]
        self._vertices = np.ascontiguousarray(np.stack(place, axis=1), np.float32)
        self._triangles = grid_triangles(water.points, water.points)
        self._sea = self._build_sea() if water.horizon > 0 else None
        self._texture = Texture(
            read_image(assets.path("water.png"), "RGB"),
            trilinear=water.trilinear,
            lod_bias=water.lod_bias,
        )
        self.mirror = MirrorImage()
        self._field = field
        self._fixed: Sea | None = None
        self._foam: Foam | None = None
        self._watch = SeaWatch(water.level, self.square)

    def _build_sea(self) -> tuple[np.ndarray, ...]:
        water = self._settings.water
        inner = (PATCHES[0] * water.patch, (PATCHES[-1] + 1) * water.patch)
        points, triangles = sea_ring(inner, water.horizon)
        vertices = np.insert(points, 1, water.level, axis=1).astype(np.float32)
        normals = np.tile(np.array([0.0, 1.0, 0.0], np.float32), (len(points), 1))
        coordinates = (points / water.patch * water.repeat).astype(np.float32)
        return vertices, normals, coordinates, triangles

    @property
    def square(self) -> tuple[float, float]:
        """The low and high border of all water, in x and in z."""
        water = self._settings.water
        reach = max(water.horizon, 0.0)
        return PATCHES[0] * water.patch - reach, (PATCHES[-1] + 1) * water.patch + reach

    def mark(self) -> None:
        """Draw the bare surface, for the stencil: one square and the sea."""
        water = self._settings.water
        low, high = self.square
        gl.glBegin(gl.GL_QUADS)
        for x, z in ((low, low), (low, high), (high, high), (high, low)):
            gl.glVertex3f(x, water.level, z)
        gl.glEnd()

    def expected(self, frame: Frame) -> bool:
        """Return whether the mirror image must be drawn before it is known if any water shows.

        Without ``water.query``, and with a reflection that is no texture, always.
        """
        return not self._asks() or self._watch.expected(frame)

    def ask(self, frame: Frame) -> None:
        """Ask OpenGL whether any water may show over the land drawn so far (``water.query``)."""
        if self._asks():
            self._watch.ask(frame)

    def shows(self) -> bool:
        """Return the answer; always true without ``water.query``.

        And with a reflection that is no texture: then the mirrored scene is drawn already.
        """
        return not self._asks() or self._watch.shows()

    def _asks(self) -> bool:
        return self._settings.water.query and self._settings.reflection.rippled

    def draw(self, frame: Frame) -> None:
        """Blend the surface over the mirrored scene."""
        settings, water = self._settings, self._settings.water
        fixed = settings.reflection.rippled or water.relief or water.shallow
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT
        with attrib(groups | gl.GL_DEPTH_BUFFER_BIT):
            if not fixed:
                gl.glColor4f(*water.color)
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            gl.glEnable(gl.GL_LIGHTING)
            gl.glLightModeli(gl.GL_LIGHT_MODEL_LOCAL_VIEWER, gl.GL_TRUE)
            if water.glitter > 0 and not fixed:
                self._shine(water.glitter)
            if water.textured:
                gl.glEnable(gl.GL_TEXTURE_2D)
                self._texture.bind()
            mirror = self.mirror.take()
            if fixed:
                if self._fixed is None:
                    self._fixed = Sea(self._texture, self._field)
                self._fixed.draw(frame, settings, self.square, mirror)
            else:
                self._draw_patches(frame)
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
        if water.foam and self._field is not None:
            if self._foam is None:
                self._foam = Foam(self._field)
            self._foam.draw(frame)

    def _draw_patches(self, frame: Frame) -> None:
        """Draw the patches of section 3.2, and the sea round them."""
        water = self._settings.water
        t = frame.kt * water.time_step if water.animated else 0.0
        normals = (ripple_normals if water.rippled else wave_normals)(self._plane, t)
        coordinates = wave_coordinates(self._plane, t, water.repeat)
        if self._sea is not None:
            self._draw_sea(frame)
        offsets = np.array(
            [(water.patch * kx, water.patch * kz) for kx in PATCHES for kz in PATCHES]
        )
        if water.cull:
            half = np.array([water.patch / 2, 0.0, water.patch / 2])
            middles = np.insert(offsets, 1, water.level, axis=1) + half
            offsets = offsets[boxes_in_view(frame, middles, np.broadcast_to(half, middles.shape))]
        if water.fresnel:
            self._draw_fresnel(frame, offsets, normals, coordinates)
        else:
            with client_arrays(self._vertices, normals, coordinates=[coordinates]):
                for x, z in offsets.tolist():
                    self._draw_patch(x, z)

    def _draw_patch(self, x: float, z: float) -> None:
        with matrix():
            gl.glTranslatef(x, 0.0, z)
            gl.glDrawElements(
                gl.GL_TRIANGLES, self._triangles.size, gl.GL_UNSIGNED_INT, self._triangles
            )

    def _draw_fresnel(
        self,
        frame: Frame,
        offsets: np.ndarray,
        normals: np.ndarray,
        coordinates: np.ndarray,
    ) -> None:
        """Draw the patches with colours whose alpha follows the angle of view, in one pass."""
        places = self._vertices + np.insert(offsets, 1, 0.0, axis=1)[:, None, :]
        colors = np.empty((*places.shape[:2], 4), np.float32)
        colors[..., :3] = self._settings.water.color[:3]
        alpha = fresnel_alpha(places.reshape(-1, 3), frame.eye, self._settings.water.color[3])
        colors[..., 3] = alpha.reshape(places.shape[:2])
        with client_arrays(self._vertices, normals, None, [coordinates]):
            gl.glEnableClientState(gl.GL_COLOR_ARRAY)
            for (x, z), of_patch in zip(offsets.tolist(), colors, strict=True):
                gl.glColorPointer(4, gl.GL_FLOAT, 0, of_patch)
                self._draw_patch(x, z)
            gl.glDisableClientState(gl.GL_COLOR_ARRAY)

    def _draw_sea(self, frame: Frame) -> None:
        assert self._sea is not None
        vertices, normals, coordinates, triangles = self._sea
        colors = np.empty((len(vertices), 4), np.float32)
        colors[:, :3] = self._settings.water.color[:3]
        colors[:, 3] = self._settings.water.color[3]
        if self._settings.water.fresnel:
            colors[:, 3] = fresnel_alpha(vertices, frame.eye, self._settings.water.color[3])
        with client_arrays(vertices, normals, colors, [coordinates]):
            gl.glDrawElements(gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles)

    def _shine(self, strength: float) -> None:
        """Let the sun glint on the waves; added after the texture, or it would dim the glints."""
        gl.glMaterialfv(
            gl.GL_FRONT_AND_BACK,
            gl.GL_SPECULAR,
            np.array([strength, strength, strength, 1.0], np.float32),
        )
        gl.glMaterialf(gl.GL_FRONT_AND_BACK, gl.GL_SHININESS, 60.0)
        gl.glLightModeli(gl.GL_LIGHT_MODEL_COLOR_CONTROL, gl.GL_SEPARATE_SPECULAR_COLOR)

    def release(self) -> None:
        """Delete what was made; may be called twice."""
        self._texture.release()
        for owner in (self.mirror, self._watch, self._fixed, self._foam):
            if owner is not None:
                owner.release()
