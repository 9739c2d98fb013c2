"""The island's heights as arrays: resampling, height queries, the mesh (section 2). No OpenGL.

In 2006 an image of 512 x 512 was resampled to 50 x 50 vertices, and heights between them were
bilinear. A smoother ground comes from bicubic patches over the same vertices (splines.py); exact
heights follow the triangles that are drawn (section 11.2.6).
"""

from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from framelens.base.errors import InputError
from landscape.elements.settings import Ground as GroundSettings
from landscape.geometry.mesh import Mesh, grid_triangles, vertex_normals
from landscape.geometry.splines import smoothed

MOST_VERTICES = 1025  # chosen: more makes over a million vertices, which take seconds to build


def lookup(image: np.ndarray, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Interpolate ``image`` (h, w[, c]) linearly at u, v in 0..1, clamped at the borders."""
    h, w = image.shape[:2]
    # np.clip is the same, but slower for few numbers.
    x = np.minimum(np.maximum(np.asarray(u, np.float64) * w, 0), w - 1)
    y = np.minimum(np.maximum(np.asarray(v, np.float64) * h, 0), h - 1)
    x0, y0 = x.astype(int), y.astype(int)
    x1, y1 = np.minimum(x0 + 1, w - 1), np.minimum(y0 + 1, h - 1)
    fx, fy = x - x0, y - y0
    if image.ndim == 3:
        fx, fy = fx[..., None], fy[..., None]
    flat = image.reshape(h * w, *image.shape[2:])  # one index is found faster than two
    y0, y1 = y0 * w, y1 * w
    top = flat[y0 + x0] * (1 - fx) + flat[y0 + x1] * fx
    bottom = flat[y1 + x0] * (1 - fx) + flat[y1 + x1] * fx
    return top * (1 - fy) + bottom * fy


Height = TypeVar("Height", float, np.ndarray)


def mirrored_height(y: Height, level: float) -> Height:
    """Return the height of the mirror image of a point at height ``y``, in water at ``level``."""
    return 2.0 * level - y


@dataclass(frozen=True)
class HeightField:
    """Heights, float32 (n, n), row along z and column along x, over ``size`` x ``size`` units.

    Between the vertices the height is bilinear, as in section 2.1.2. What is drawn are two flat
    triangles per cell, so the walker stands a little above or below them. With ``exact`` heights
    follow the triangles of :func:`grid_triangles`, the surface that is drawn (R15).
    """

    heights: np.ndarray
    size: float
    water_level: float
    exact: bool = False

    @property
    def made_from(self) -> tuple[str, bytes]:
        """All that a query depends on, for the cache of what is computed from the heights."""
        how = repr((self.heights.shape, self.size, self.water_level, self.exact))
        return how, self.heights.tobytes()

    @property
    def broad(self) -> "HeightField":
        """The field without what is finer than its cells: itself, as it has nothing finer."""
        return self

    def terrain_height(self, x: np.ndarray | float, z: np.ndarray | float) -> np.ndarray:
        """Return the ground's height at x, z in units, the sea floor included; clamped outside."""
        n = len(self.heights)
        u = np.clip(np.asarray(x, np.float64) * (n - 1) / self.size, 0, n - 1)
        v = np.clip(np.asarray(z, np.float64) * (n - 1) / self.size, 0, n - 1)
        k, r = np.minimum(u.astype(int), n - 2), np.minimum(v.astype(int), n - 2)
        tx, tz = u - k, v - r
        h = self.heights
        if self.exact:
            # The diagonal runs from (0, 0) to (1, 1): a step along one side, then along the other.
            corner, across = h[r, k], h[r + 1, k + 1]
            right, below = h[r, k + 1], h[r + 1, k]
            upper = corner + tx * (right - corner) + tz * (across - right)
            lower = corner + tz * (below - corner) + tx * (across - below)
            return np.asarray(np.where(tx > tz, upper, lower))
        near = h[r, k] * (1 - tx) + h[r, k + 1] * tx
        far = h[r + 1, k] * (1 - tx) + h[r + 1, k + 1] * tx
        return np.asarray(near * (1 - tz) + far * tz)

    def height(self, x: np.ndarray | float, z: np.ndarray | float) -> np.ndarray:
        """Return the height to stand on, never below the water (get_height in 2006)."""
        return np.maximum(self.terrain_height(x, z), self.water_level)

    def depth(self, x: np.ndarray | float, z: np.ndarray | float) -> np.ndarray:
        """Return the water's depth at x, z in units, 0 on land."""
        return np.maximum(self.water_level - self.terrain_height(x, z), 0.0)

    def slope(self, x: np.ndarray | float, z: np.ndarray | float) -> np.ndarray:
        """Return the steepness, rise over run, by central differences over half a cell."""
        return np.hypot(*self._rises(x, z)) / self._cell

    def normal(self, x: np.ndarray | float, z: np.ndarray | float) -> np.ndarray:
        """Return the ground's unit normals (..., 3) at x, z in units (get_normal in 2006)."""
        dx, dz = self._rises(x, z)
        across = np.stack([-dx, np.full_like(dx, self._cell), -dz], axis=-1)
        return np.asarray(across / np.linalg.norm(across, axis=-1, keepdims=True))

    @property
    def _cell(self) -> float:
        """The distance of two vertices, in units."""
        return self.size / (len(self.heights) - 1)

    def _rises(self, x: np.ndarray | float, z: np.ndarray | float) -> tuple[np.ndarray, np.ndarray]:
        """Return how far the ground rises over a cell around x, z, along x and along z."""
        d = self._cell / 2
        dx = self.terrain_height(np.add(x, d), z) - self.terrain_height(np.subtract(x, d), z)
        dz = self.terrain_height(x, np.add(z, d)) - self.terrain_height(x, np.subtract(z, d))
        return dx, dz


def laid_over(image: np.ndarray, settings: GroundSettings) -> np.ndarray:
    """Return an image (h, w[, c]) that covers only a part of the map, from its north-west corner.

    ``ground.scale_x`` and ``ground.scale_z`` say how much of each side. What is beyond is black:
    the floor of the sea.
    """
    height, width = image.shape[:2]
    more = [(0, round(height / settings.scale_z) - height)]
    more.append((0, round(width / settings.scale_x) - width))
    if more == [(0, 0), (0, 0)]:
        return image
    return np.pad(image, more + [(0, 0)] * (image.ndim - 2))


def height_field(image: np.ndarray, settings: GroundSettings, water_level: float) -> HeightField:
    """Resample an image (h, w) of values 0..255 to the vertices' heights.

    Vertex k of N samples the image at k/N although it is at k/(N-1), as in the report. With
    ``ground.smooth`` these vertices are the knots of bicubic patches, and the field keeps the finer
    vertices of the patches, for drawing and for height queries. ``ground.scale_x`` and ``scale_z``
    squeeze the image.
    """
    image = laid_over(image, settings)
    n = settings.resolution
    at = np.arange(n) / n
    heights = lookup(image, at[None, :], at[:, None]) / 256.0 * settings.scale_y
    if settings.smooth != "none":
        side = (settings.resolution - 1) * settings.subdivide + 1
        if side > MOST_VERTICES:
            raise InputError(
                "setting ground.subdivide: expected at most {most_vertices} vertices a "
                "side, not the {side} that ground.resolution={resolution} and "
                "ground.subdivide={subdivide} make",
                most_vertices=MOST_VERTICES,
                side=side,
                resolution=settings.resolution,
                subdivide=settings.subdivide,
            )
        heights = smoothed(heights, settings.subdivide, settings.smooth)

    field = heights.astype(np.float32)
    return HeightField(field, settings.size, water_level, settings.exact_height)


def ground_mesh(
    field: HeightField, repeats: tuple[float, ...], detail_uv: np.ndarray | None = None
) -> Mesh:
    """Return the height field as a mesh, with texture coordinates repeated ``repeats`` times.

    Vertex k of N is at k/(N-1) of the side. Textures that are repeated more than once may have
    their own coordinates, ``detail_uv`` (n*n, 2).
    """
    n = len(field.heights)
    along = np.arange(n) / (n - 1)
    u, v = np.meshgrid(along, along)
    vertices = np.stack([u * field.size, field.heights, v * field.size], axis=2).reshape(-1, 3)
    vertices = np.ascontiguousarray(vertices, np.float32)
    triangles = grid_triangles(n, n)
    uv = np.stack([u, v], axis=2).reshape(-1, 2)
    laid = uv if detail_uv is None else detail_uv
    coordinates = tuple(
        np.ascontiguousarray((laid if r > 1 else uv) * r, np.float32) for r in repeats
    )
    return Mesh(vertices, vertex_normals(vertices, triangles), triangles, coordinates)


def greenness(colour: np.ndarray) -> np.ndarray:
    """Return 0..1 (n,), how much grass grows on ground of colours (n, 3) in 0..1."""
    red, green, blue = np.asarray(colour).T
    # Relative to the green itself, so that bright sand is not taken for a pale meadow.
    excess = 1.0 - 0.5 * (red + blue) / np.maximum(green, 1e-3)
    return np.asarray(np.clip((excess - 0.07) / 0.07, 0.0, 1.0))
