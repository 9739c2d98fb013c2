"""The island's heights as arrays: reading, resampling, smoothing, asking (section 2). No OpenGL.

In 2006 an image of 512 x 512 was resampled to 50 x 50 vertices, and heights between them were
bilinear. Smoother ground comes from bicubic patches over the same vertices, exact standing from
the triangles that are drawn (section 11.2.6).
"""

from dataclasses import dataclass

import numpy as np

from landscape.errors import InputError
from landscape.geometry.mesh import Mesh, grid_triangles, vertex_normals
from landscape.settings import Ground as GroundSettings

MOST_VERTICES = 1025  # chosen: a side of more is a million vertices and more, seconds to build

# Between the middle two of four knots a cubic is (t^3, t^2, t, 1) times one of these, times them.
SPLINES = {
    "catmull_rom": np.array([[-1, 3, -3, 1], [2, -5, 4, -1], [-1, 0, 1, 0], [0, 2, 0, 0]]) / 2.0,
    "b_spline": np.array([[-1, 3, -3, 1], [3, -6, 3, 0], [-3, 0, 3, 0], [1, 4, 1, 0]]) / 6.0,
}


def lookup(image: np.ndarray, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Interpolate ``image`` (h, w[, c]) linearly at u, v in 0..1, clamped at the borders."""
    h, w = image.shape[:2]
    x = np.clip(np.asarray(u, np.float64) * w, 0, w - 1)
    y = np.clip(np.asarray(v, np.float64) * h, 0, h - 1)
    x0, y0 = x.astype(int), y.astype(int)
    x1, y1 = np.minimum(x0 + 1, w - 1), np.minimum(y0 + 1, h - 1)
    fx, fy = x - x0, y - y0
    if image.ndim == 3:
        fx, fy = fx[..., None], fy[..., None]
    top = image[y0, x0] * (1 - fx) + image[y0, x1] * fx
    bottom = image[y1, x0] * (1 - fx) + image[y1, x1] * fx
    return top * (1 - fy) + bottom * fy


def spline_weights(count: int, parts: int, kind: str) -> np.ndarray:
    """Return the weights ((count - 1) * parts + 1, count) of a cubic over ``count`` knots.

    Each span between two knots is cut into ``parts``. "catmull_rom" goes through the knots;
    "b_spline" passes near them and bends more evenly. Beyond the ends a knot is put in line with
    the last two, so that both curves begin and end in a knot.
    """
    at = np.arange((count - 1) * parts + 1) / parts
    span = np.minimum(at.astype(int), count - 2)
    t = (at - span)[:, None] ** np.arange(3, -1, -1)  # t^3, t^2, t, 1
    weights = t @ SPLINES[kind]
    # Knots -1 and count come before and behind: 2 p[0] - p[1], and 2 p[count-1] - p[count-2].
    wide = np.zeros((len(at), count + 2))
    for k in range(4):
        wide[np.arange(len(at)), span + k] += weights[:, k]
    matrix = wide[:, 1:-1].copy()
    for end, first, second in ((wide[:, 0], 0, 1), (wide[:, -1], -1, -2)):
        matrix[:, first] += 2 * end
        matrix[:, second] -= end
    return matrix


def smoothed(heights: np.ndarray, parts: int, kind: str) -> np.ndarray:
    """Return heights (n, n) as bicubic patches, each cell cut into ``parts`` x ``parts`` (R14).

    A patch is a cubic along x of cubics along z: weights times heights times weights.
    """
    weights = spline_weights(len(heights), parts, kind)
    return np.ascontiguousarray(weights @ heights @ weights.T)


@dataclass(frozen=True)
class HeightField:
    """Heights, float32 (n, n), row along z and column along x, over ``size`` x ``size`` units.

    Between the vertices the height is bilinear, as in section 2.1.3, which is not what is drawn: a
    cell is two flat triangles, and the walker stands a little over or under them. ``exact`` follows
    the triangles of :func:`grid_triangles`, so that he stands on the surface drawn.
    """

    heights: np.ndarray
    size: float
    water_level: float
    exact: bool = False

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
        """Return what one stands on, never below the water (get_height in 2006)."""
        return np.maximum(self.terrain_height(x, z), self.water_level)

    def slope(self, x: np.ndarray | float, z: np.ndarray | float) -> np.ndarray:
        """Return the steepness, rise over run, by central differences over half a cell."""
        d = self.size / (len(self.heights) - 1) / 2
        dx = self.terrain_height(np.add(x, d), z) - self.terrain_height(np.subtract(x, d), z)
        dz = self.terrain_height(x, np.add(z, d)) - self.terrain_height(x, np.subtract(z, d))
        return np.hypot(dx, dz) / (2 * d)


def height_field(image: np.ndarray, settings: GroundSettings, water_level: float) -> HeightField:
    """Resample an image (h, w) of values 0..255 to the vertices' heights.

    Vertex k of N takes the image at k/N though it stands at k/(N-1): so in the report. With
    ``ground.smooth`` these vertices are the knots of bicubic patches, and the finer vertices of
    the patches are what is kept: drawing and walking know no others.
    """
    n = settings.resolution
    at = np.arange(n) / n
    heights = lookup(image, at[None, :], at[:, None]) / 256.0 * settings.scale_y
    if settings.smooth != "none":
        side = (settings.resolution - 1) * settings.subdivide + 1
        if side > MOST_VERTICES:
            raise InputError(
                f"setting ground.subdivide: expected at most {MOST_VERTICES} vertices a side, not "
                f"the {side} that ground.resolution={settings.resolution} and "
                f"ground.subdivide={settings.subdivide} make"
            )
        heights = smoothed(heights, settings.subdivide, settings.smooth)
    field = heights.astype(np.float32)
    return HeightField(field, settings.size, water_level, settings.exact_height)


def low_stretch_coordinates(heights: np.ndarray, cell: float) -> np.ndarray:
    """Return for each vertex of a height field (n, n) where it lies on a textile laid over it.

    (n, n, 2) in the units of ``cell``, a cell's side. A texture laid by x and z alone is drawn out
    where the ground is steep: uphill a step of 1 is sqrt(1 + slope^2) long. Steps of that length
    cannot all meet on a plane; the places are those whose steps come nearest.
    """
    dz, dx = np.gradient(heights, cell)
    steep = dx * dx + dz * dz
    longer = (np.sqrt(1.0 + steep) - 1.0) / np.maximum(steep, 1e-12)
    across = longer * dx * dz
    x = nearest_surface((1.0 + longer * dx * dx) * cell, across * cell)
    z = nearest_surface(across * cell, (1.0 + longer * dz * dz) * cell)
    return np.stack([x, z], axis=2)


def nearest_surface(right: np.ndarray, down: np.ndarray) -> np.ndarray:
    """Return values (n, n), mean 0, whose steps to the right and down are nearest to those given.

    Steps, (n, n) at the vertices, count half on either side. Least squares: a Poisson equation,
    which cosine waves solve, each by itself.
    """
    n = len(right)
    divergence = np.zeros((n, n))
    for steps, transposed in ((right, divergence), (down.T, divergence.T)):
        half = (steps[:, 1:] + steps[:, :-1]) / 2
        transposed[:, 1:] += half
        transposed[:, :-1] -= half
    number = np.arange(n)
    waves = np.cos(np.pi / n * np.outer(number, number + 0.5)) * np.sqrt(2.0 / n)
    waves[0] = np.sqrt(1.0 / n)
    stiffness = 2.0 - 2.0 * np.cos(np.pi / n * number)
    total = np.add.outer(stiffness, stiffness)
    total[0, 0] = np.inf  # the mean is free
    return np.asarray(waves.T @ ((waves @ divergence @ waves.T) / total) @ waves)


def ground_mesh(field: HeightField, repeats: tuple[float, ...], low_stretch: bool = False) -> Mesh:
    """Return the height field as a mesh, with texture coordinates repeated ``repeats`` times.

    With ``low_stretch`` those repeated more than once follow the ground's slopes.
    """
    n = len(field.heights)
    along = np.arange(n) / (n - 1)
    u, v = np.meshgrid(along, along)
    vertices = np.stack([u * field.size, field.heights, v * field.size], axis=2).reshape(-1, 3)
    vertices = np.ascontiguousarray(vertices, np.float32)
    triangles = grid_triangles(n, n)
    uv = np.stack([u, v], axis=2).reshape(-1, 2)
    laid = uv
    if low_stretch:
        textile = low_stretch_coordinates(field.heights, field.size / (n - 1))
        laid = textile.reshape(-1, 2) / np.float32(field.size)
    coordinates = tuple(
        np.ascontiguousarray((laid if r > 1 else uv) * r, np.float32) for r in repeats
    )
    return Mesh(vertices, vertex_normals(vertices, triangles), triangles, coordinates)


def colour_by_height(field: HeightField, sun: np.ndarray, size: int = 512) -> np.ndarray:
    """Return a large-scale texture, uint8 (size, size, 3), for a height image that has none.

    Sand at the shore, green low, brown and grey high (figure 3), shaded by the sun (3,).
    """
    at = (np.arange(size) + 0.5) / size * field.size
    x, z = np.meshgrid(at, at)
    h = field.terrain_height(x, z)
    above = np.clip((h - field.water_level) / max(float(h.max()) - field.water_level, 1e-6), 0, 1)
    stops = [0.0, 0.03, 0.10, 0.40, 0.65, 1.0]
    colours = np.array(
        [
            (196, 180, 140),
            (186, 172, 128),
            (104, 122, 62),
            (116, 112, 68),
            (124, 110, 92),
            (150, 148, 144),
        ]
    )
    rgb = np.stack([np.interp(above, stops, colours[:, c]) for c in range(3)], axis=2)
    step = field.size / size
    gz, gx = np.gradient(h, step)
    light = (sun[1] - gx * sun[0] - gz * sun[2]) / np.sqrt(1 + gx**2 + gz**2)
    shade = 0.55 + 0.6 * np.clip(light, 0, 1)
    return np.ascontiguousarray(np.clip(rgb * shade[..., None], 0, 255), np.uint8)


def greenness(colour: np.ndarray) -> np.ndarray:
    """Return 0..1, how much grass a ground of colours (n, 3) in 0..1 would bear."""
    red, green, blue = np.asarray(colour).T
    # In parts of the green itself, so that bright sand is not taken for a pale meadow.
    excess = 1.0 - 0.5 * (red + blue) / np.maximum(green, 1e-3)
    return np.asarray(np.clip((excess - 0.07) / 0.07, 0.0, 1.0))
