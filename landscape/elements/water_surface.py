"""The water: a transparent, animated plane over the reflection (Water_surface, section 3).

Technique: one patch of 40 x 40 vertices, sent from arrays in each frame and drawn 5 x 5 times by
translation, blended with GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA. The plane stays flat: only the
texture coordinates and, for the lighting, the normals move. All terms have period 1 over the patch,
so neighbouring patches match.
State used: GL_BLEND, GL_LIGHTING, GL_TEXTURE_2D, GL_COLOR_MATERIAL.
What it lacks: the reflection does not ripple (``reflection.rippled``), no vertex rises
(``water.relief``), and the sea ends with the last patch (``water.horizon``). With either of the
first two the class Sea (best/sea/sea.py) replaces this one; HorizonRing (best/sea/ring.py) adds the
third.
"""

from collections.abc import Hashable

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays, matrix
from framelens.gl.texture import Texture
from landscape.elements.element import Element
from landscape.elements.settings import Settings, Water
from landscape.elements.sun import lit
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.mesh import grid_triangles
from landscape.gl.draw import level_square

PATCHES = range(-1, 4)  # section 3.2: k from -1 to 3, on both axes
TWO_PI = 2.0 * np.pi


def water_square(water: Water) -> tuple[float, float]:
    """Return the lower and upper bound of all water, in x and in z, units."""
    reach = water.horizon
    return PATCHES[0] * water.patch - reach, (PATCHES[-1] + 1) * water.patch + reach


def water_texture(settings: Settings, assets: Assets) -> Texture:
    """Load the picture that is repeated over the water."""
    water = settings.water
    image = read_image(assets.path("water.png"), "RGB")
    return Texture(image, trilinear=water.trilinear, lod_bias=water.lod_bias)


def wave_time(kt: float, water: Water) -> float:
    """Return the report's t at ``kt``."""
    return kt * water.time_step if water.animated else 0.0


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


def wave_coordinates(plane: np.ndarray, t: float, repeat: float) -> np.ndarray:
    """Return the texture coordinates, float32 (n, 2), at time ``t`` (section 3.2)."""
    px, py = plane
    s = px + 0.01 * np.cos(10 * t - px * TWO_PI * 3) + 0.1 * np.cos(2 * t - py * TWO_PI)
    r = py + 0.01 * np.cos(10 * t - py * TWO_PI * 3) + 0.05 * np.cos(8 * t - py * TWO_PI)
    return np.ascontiguousarray(repeat * np.stack([s, r], axis=1), np.float32)


class WaterSurface(Element[Settings]):
    """The water surface; ``draw`` computes the waves of the frame's kt."""

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return the values that the constructor uses."""
        water = settings.water
        return water.points, water.patch, water.level, water.trilinear, water.lod_bias

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Build the patch and load the texture."""
        self.settings = settings
        water = settings.water
        self._plane = patch_plane(water.points)
        px, py = self._plane
        place = [px * water.patch, np.full(len(px), water.level), py * water.patch]
        self._vertices = np.ascontiguousarray(np.stack(place, axis=1), np.float32)
        self._triangles = grid_triangles(water.points, water.points)
        self._texture = water_texture(settings, assets)

    def mark(self) -> None:
        """Send the bare surface, for the stencil."""
        level_square(*water_square(self.settings.water), self.settings.water.level)

    def draw(self, frame: Frame) -> None:
        """Blend the surface over the mirrored scene."""
        water = self.settings.water
        t = wave_time(frame.kt, water)
        normals = wave_normals(self._plane, t)
        coordinates = wave_coordinates(self._plane, t, water.repeat)

        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT
        with attrib(groups):
            gl.glColor4f(*water.color)
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            lit(self.settings.shading)
            gl.glLightModeli(gl.GL_LIGHT_MODEL_LOCAL_VIEWER, gl.GL_TRUE)
            if water.textured:
                gl.glEnable(gl.GL_TEXTURE_2D)
                self._texture.bind()

            # The waves are the same in each patch: only the translation differs.
            with client_arrays(self._vertices, normals, coordinates=[coordinates]):
                for kx in PATCHES:
                    for kz in PATCHES:
                        self._draw_patch(kx * water.patch, kz * water.patch)

            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def _draw_patch(self, x: float, z: float) -> None:
        with matrix():
            gl.glTranslatef(x, 0.0, z)
            gl.glDrawElements(
                gl.GL_TRIANGLES, self._triangles.size, gl.GL_UNSIGNED_INT, self._triangles
            )

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        self._texture.release()
