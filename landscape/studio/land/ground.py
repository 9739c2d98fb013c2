"""The ground textures: the large colour texture over the island, and the repeated detail.

The large texture is an albedo chosen by height, slope, curvature and water flow (the usual rules of
procedural terrain since Musgrave) with the lighting baked in: the sun with soft cast shadows, and
the sky with ambient occlusion from a horizon search (Max 1988). The detail texture is grass drawn
blade by blade over pebbles and soil; drawing wraps around, so it tiles.
"""

import math
from collections.abc import Callable

import numpy as np
from numba import njit
from scipy import ndimage
from scipy.interpolate import splev, splprep

from landscape.studio import light
from landscape.studio.images import smoothstep, spectral_noise, to_linear, to_srgb, to_uint8
from landscape.studio.land import terrain

LARGE = 2048  # chosen: 51 texels per unit, a third of a metre each
DETAIL = 512  # chosen: repeated every half unit, 1.5 centimetres per texel

# Chosen: sRGB colours in full sun, after photographs of the Hebrides.
COLORS = {
    "lush": (92, 106, 60),
    "grass": (107, 114, 69),
    "olive": (126, 123, 77),
    "dark": (77, 90, 54),
    "dry": (147, 137, 98),
    "heath": (112, 96, 79),
    "bracken": (128, 100, 66),
    "soil": (104, 86, 66),
    "rock": (134, 127, 117),
    "slate": (103, 99, 95),
    "lichen": (142, 139, 120),
    "cleft": (70, 66, 64),
    "scree": (150, 142, 129),
    "sand": (210, 194, 157),
    "wet": (148, 131, 102),
    "shingle": (141, 134, 122),
    "path": (163, 141, 106),
    "shallow": (126, 147, 123),
    "deep": (30, 66, 79),
    "weed": (70, 86, 64),
    "snow": (234, 237, 240),
}

# Chosen: a footpath as (x, z), from the beach of the bay over the meadow to the castle court.
PATH = [
    (14.4, 27.3),
    (15.8, 26.4),
    (17.6, 26.5),
    (19.6, 26.0),
    (21.4, 24.6),
    (23.2, 23.6),
    (24.1, 21.9),
    (25.2, 20.2),
    (26.1, 18.9),
    (26.9, 17.4),
]
COURT = (27.0, 17.0)
COURT_RADIUS = 1.0  # chosen: bare ground around the castle
SUN_WEIGHT = 0.66  # chosen: with SKY_WEIGHT, level ground in the sun keeps its albedo
SKY_WEIGHT = 0.50  # chosen
ROCK_RELIEF = 0.017  # chosen: a third of a metre
SUN_BLUR = 0.07  # chosen: penumbra width per distance, softer than the real sun's


@njit(cache=True)
def sun_shadow(h: np.ndarray, cell: float, sun: np.ndarray, blur: float) -> np.ndarray:
    """Return the fraction of the sun (0..1) visible from each cell of heights ``h`` (n, n)."""
    n = h.shape[0]
    out = np.ones((n, n))
    level = math.hypot(sun[0], sun[2])
    ux = sun[0] / level
    uz = sun[2] / level
    rise = sun[1] / level
    top = h.max()
    for j in range(n):
        for i in range(n):
            clear = 1.0
            t = 1.5
            while h[j, i] + rise * t * cell < top:
                x, z = i + ux * t, j + uz * t
                if x < 0 or z < 0 or x >= n - 1 or z >= n - 1:
                    break
                a, b = int(x), int(z)
                u, v = x - a, z - b
                ground = (h[b, a] * (1 - u) + h[b, a + 1] * u) * (1 - v) + (
                    h[b + 1, a] * (1 - u) + h[b + 1, a + 1] * u
                ) * v
                over = h[j, i] + rise * t * cell - ground
                clear = min(clear, over / (blur * t * cell + 0.012))
                if clear < -1.0:
                    break
                t += max(1.0, 0.03 * t)
            out[j, i] = min(1.0, max(0.0, 0.5 + 0.5 * clear))

    return out


@njit(cache=True)
def sky_view(h: np.ndarray, cell: float, directions: int, reach: float) -> np.ndarray:
    """Return the fraction of the sky (0..1) visible from each cell of heights ``h`` (n, n).

    ``reach`` is the length of the horizon search in cells, ``directions`` the number of azimuths.
    """
    n = h.shape[0]
    out = np.zeros((n, n))
    for k in range(directions):
        angle = 2.0 * math.pi * (k + 0.5) / directions
        ux, uz = math.cos(angle), math.sin(angle)
        for j in range(n):
            for i in range(n):
                steepest = 0.0
                t = 1.0
                while t < reach:
                    x, z = int(i + ux * t + 0.5), int(j + uz * t + 0.5)
                    if x < 0 or z < 0 or x >= n or z >= n:
                        break
                    steepest = max(steepest, (h[z, x] - h[j, i]) / (t * cell))
                    t *= 1.35
                out[j, i] += 1.0 / (1.0 + steepest * steepest)

    return out / directions


def enlarge(field: np.ndarray, size: int) -> np.ndarray:
    """Resample (n, n) to (size, size) with cubic splines, aligned at the cell centres."""
    k = (np.arange(size) + 0.5) * field.shape[0] / size - 0.5
    rows, columns = np.meshgrid(k, k, indexing="ij")
    return ndimage.map_coordinates(field, [rows, columns], order=3, mode="nearest")


def normals(h: np.ndarray, cell: float) -> np.ndarray:
    """Return unit normals (n, n, 3) of heights ``h`` (n, n) with cells of ``cell`` units."""
    dz, dx = np.gradient(h, cell)
    n = np.stack([-dx, np.ones_like(h), -dz], axis=-1)
    return n / np.linalg.norm(n, axis=-1, keepdims=True)


def path_points() -> tuple[np.ndarray, np.ndarray]:
    """Return x and z along the footpath, a smooth curve through PATH."""
    spline, _ = splprep(np.array(PATH).T, s=0)
    x, z = splev(np.linspace(0.0, 1.0, 6000), spline)
    return np.asarray(x), np.asarray(z)


def path_distance(size: int) -> np.ndarray:
    """Return the distance (size, size) to the footpath, in units."""
    x, z = path_points()
    elsewhere = np.ones((size, size), bool)
    scale = size / terrain.WORLD
    elsewhere[(z * scale).astype(int), (x * scale).astype(int)] = False
    return ndimage.distance_transform_edt(elsewhere) / scale


class Paint:
    """A linear RGB image into which the colours of COLORS are blended by name."""

    def __init__(self, size: int, name: str) -> None:
        self.colors = {k: to_linear(np.array(v) / 255.0) for k, v in COLORS.items()}
        self.rgb = np.broadcast_to(self.colors[name], (size, size, 3)).copy()

    def blend(self, name: str, weight: np.ndarray) -> None:
        """Blend a colour in by ``weight`` (size, size), clipped to 0..1."""
        self.rgb += (self.colors[name] - self.rgb) * np.clip(weight, 0.0, 1.0)[..., None]


def rock_cracks(size: int) -> np.ndarray:
    """Return blocky noise (size, size), mean 0: sharp low clefts between rounded high blocks."""
    folds = np.zeros((size, size))
    for weight, seed, low in ((1.0, 35, 24.0), (0.5, 36, 70.0), (0.25, 37, 160.0)):
        folds += weight * np.abs(spectral_noise(size, 1.5, seed, low))
    return np.asarray((folds - folds.mean()) / folds.std())


def albedo(
    h: np.ndarray, slope: np.ndarray, hollow: np.ndarray, flow: np.ndarray, cracks: np.ndarray
) -> np.ndarray:
    """Return the albedo, linear (n, n, 3), by height, slope, hollowness, water flow and cracks."""
    size = h.shape[0]
    broad, patch = spectral_noise(size, 1.8, 31, 3.0), spectral_noise(size, 1.6, 34, 9.0)
    mid, small = spectral_noise(size, 1.4, 32, 20.0), spectral_noise(size, 1.1, 33, 90.0)
    y = h + 0.05 * mid
    steep = slope + 0.06 * mid + 0.04 * small

    land = Paint(size, "grass")
    land.blend("lush", 0.75 * smoothstep(-0.2, 1.3, broad))
    land.blend("olive", 0.85 * smoothstep(0.0, 1.5, patch - 0.3 * broad))
    land.blend("dark", 0.65 * smoothstep(0.4, 1.7, 0.4 * mid - patch))
    land.blend("bracken", 0.55 * smoothstep(0.9, 2.2, patch + 0.6 * mid) * smoothstep(1.0, 1.3, y))
    land.blend("lush", 0.6 * smoothstep(3.2, 6.0, flow + 0.3 * mid))
    land.blend("dry", 0.65 * smoothstep(1.1, 2.1, y + 0.30 * patch))
    land.blend("heath", 0.70 * smoothstep(2.0, 3.0, y + 0.35 * broad + 0.15 * mid))
    land.blend("soil", 0.55 * smoothstep(0.42, 0.80, steep + 2.0 * hollow))
    land.blend("scree", 0.80 * smoothstep(2.5, 3.7, y + 0.25 * mid + 1.5 * hollow))

    x, z = np.meshgrid(*[(np.arange(size) + 0.5) * terrain.WORLD / size] * 2)
    strata = np.sin(11.0 * (h + 0.22 * x - 0.13 * z) + 1.6 * patch + 0.9 * mid)
    rock = Paint(size, "rock")
    rock.blend("slate", 0.45 + 0.24 * strata + 0.22 * mid)
    rock.blend("cleft", 0.55 * smoothstep(0.8, 2.2, -cracks))
    rock.blend("lichen", 0.45 * smoothstep(0.2, 1.5, patch) * smoothstep(3.6, 2.0, y))
    # A crest is level for a few texels but bare, so the slope of its surroundings counts too.
    around = ndimage.gaussian_filter(slope, size / 256)
    bare = np.maximum(steep, 0.95 * around + 0.06 * mid)
    bare = smoothstep(0.62, 0.98, bare + 0.10 * smoothstep(2.0, 4.0, y) - 0.8 * hollow)
    land.rgb += (rock.rgb - land.rgb) * bare[..., None]
    frost = smoothstep(4.15, 4.75, y + 0.12 * mid + 0.10 * small + 1.0 * hollow)
    land.blend("snow", 0.62 * frost * smoothstep(2.6, 1.3, steep))

    flat = smoothstep(0.50, 0.28, steep)
    land.blend("dry", 0.7 * smoothstep(0.96, 0.80, y + 0.05 * patch) * flat)
    land.blend("sand", smoothstep(0.86, 0.70, y + 0.035 * patch - 0.02 * mid) * flat)
    land.blend("shingle", 0.8 * smoothstep(0.74, 0.64, y) * smoothstep(0.22, 0.42, steep))
    land.blend("wet", 0.85 * smoothstep(0.665, 0.61, h + 0.006 * patch))
    dry_land = smoothstep(0.66, 0.75, h)
    r = path_distance(size) + 0.035 * mid + 0.02 * small
    land.blend("path", 0.85 * smoothstep(0.12, 0.03, r) * dry_land)
    land.blend("dry", 0.35 * smoothstep(0.26, 0.08, r) * dry_land)
    court = np.hypot(x - COURT[0], z - COURT[1]) + 0.10 * mid
    land.blend("path", 0.70 * smoothstep(COURT_RADIUS + 0.35, COURT_RADIUS - 0.35, court))
    grain = 1.0 + 0.05 * mid + 0.05 * small - np.clip(2.2 * hollow, -0.18, 0.22)
    land.rgb *= grain[..., None]

    depth = np.maximum(terrain.WATER_LEVEL - h, 0.0)
    sea = Paint(size, "wet")
    sea.blend("shallow", smoothstep(0.0, 0.12, depth))
    meadow = smoothstep(0.03, 0.15, depth) * smoothstep(0.42, 0.25, depth)
    sea.blend("weed", 0.7 * meadow * smoothstep(0.3, 1.9, patch + 0.3 * mid))
    sea.blend("deep", 1.0 - np.exp(-((depth / 0.24) ** 1.3)))
    return np.where((depth > 0.0)[..., None], sea.rgb, land.rgb)


def relief() -> tuple[np.ndarray, np.ndarray]:
    """Return the visible fractions of the sun and of the sky, each (LARGE, LARGE) in 0..1."""
    h = terrain.build()[0]
    surface = np.maximum(h, terrain.WATER_LEVEL)
    middle = 2 * terrain.SIZE
    sun = light.sun_direction()
    shadow = sun_shadow(enlarge(surface, middle), terrain.WORLD / middle, sun, SUN_BLUR)
    sky = ndimage.gaussian_filter(sky_view(surface, terrain.CELL, 16, 60.0), 0.7)
    return np.clip(enlarge(shadow, LARGE), 0.0, 1.0), np.clip(enlarge(sky, LARGE), 0.0, 1.0)


def ground_large() -> np.ndarray:
    """Return the large ground texture, lit, uint8 (LARGE, LARGE, 3)."""
    coarse, water = terrain.build()
    h = enlarge(coarse, LARGE)
    n = normals(h, terrain.WORLD / LARGE)
    slope = np.hypot(n[..., 0], n[..., 2]) / n[..., 1]
    cracks = rock_cracks(LARGE)

    # Relief that is too small for the mesh affects the lighting only: blocks of rock, tussocks
    # elsewhere. The sea floor has none: it is seen through water, and would cost a fifth of the
    # file.
    dry = smoothstep(terrain.WATER_LEVEL - 0.20, terrain.WATER_LEVEL, h)
    bumps = h + dry * cracks * (0.0015 + ROCK_RELIEF * smoothstep(0.50, 0.95, slope))
    n = normals(bumps, terrain.WORLD / LARGE)
    hollow = enlarge(ndimage.gaussian_filter(coarse, 5.0) - coarse, LARGE)
    flow = np.maximum(enlarge(ndimage.gaussian_filter(water, 0.8), LARGE), 0.0)
    shadow, sky = relief()
    sun = light.sun_direction()
    direct = np.maximum(n @ sun, 0.0) / sun[1] * shadow

    # Under water, keep only a hint of the shading: the water surface is lit, not the floor.
    direct = np.where(h < terrain.WATER_LEVEL, 0.6 + 0.4 * direct, direct)

    # A soft shoulder, or slopes that face the sun would be overexposed.
    direct = direct * 1.35 / (1.0 + 0.35 * direct)
    blue = light.SKY_COLOR / light.SKY_COLOR.mean()

    # Brighten ribs and darken gullies, which the sun alone hides where it is perpendicular.
    fold = enlarge(ndimage.gaussian_filter(coarse, 1.8) - coarse, LARGE)
    direct = direct * (1.0 - np.clip(6.0 * fold, -0.16, 0.30))
    dome = sky * (0.6 + 0.4 * n[..., 1])
    lit = SUN_WEIGHT * direct[..., None] * light.SUN_COLOR / light.SUN_COLOR.mean()
    lit = lit + SKY_WEIGHT * dome[..., None] * (0.5 + 0.5 * blue) + 0.08 * light.GROUND_BOUNCE
    return to_uint8(to_srgb(albedo(h, slope, hollow, flow, cracks) * lit))


@njit(cache=True)
def draw_blades(
    size: int, count: int, rng: np.random.Generator, tone: np.ndarray, top: np.ndarray
) -> None:
    """Draw blades of grass into ``tone`` and their heights into ``top``, both (size, size).

    Both arrays are modified in place, and drawing wraps around at the borders.
    """
    for k in range(count):
        x, y = rng.random() * size, rng.random() * size
        angle = rng.random() * 2.0 * math.pi
        bend = (rng.random() - 0.5) * 0.16
        length = 6.0 + 10.0 * rng.random() ** 2
        own = 0.60 + 0.40 * rng.random()
        lift = 0.5 + 0.5 * k / count
        steps = int(length * 2.5)

        for s in range(steps):
            f = s / steps
            x += 0.4 * math.cos(angle)
            y += 0.4 * math.sin(angle)
            angle += bend * 0.4
            z = lift * (0.25 + f * (1.5 - 0.8 * f))
            half = 0.30 + 0.65 * (1.0 - f)
            value = own * (0.34 + 0.62 * f)

            for dj in range(-1, 2):
                for di in range(-1, 2):
                    px, py = int(math.floor(x)) + di, int(math.floor(y)) + dj
                    far = math.hypot(px + 0.5 - x, py + 0.5 - y)
                    cover = min(1.0, max(0.0, half - far + 0.5))
                    j, i = py % size, px % size
                    if cover > 0.0 and z >= top[j, i] - 0.05:
                        tone[j, i] += (value - tone[j, i]) * cover
                        top[j, i] += (max(z, top[j, i]) - top[j, i]) * cover


def draw_pebbles(
    tone: np.ndarray, top: np.ndarray, hue: np.ndarray, count: int, rng: np.random.Generator
) -> None:
    """Draw small lit stones, in place: brightness, height and warmth into tone, top and hue."""
    size = tone.shape[0]
    for _ in range(count):
        cx, cy = rng.uniform(0, size, 2)
        a = rng.uniform(1.6, 5.0)
        b = rng.uniform(0.6, 1.0)
        turn = rng.uniform(0, math.pi)
        value, warm = rng.uniform(0.45, 0.85), rng.uniform(-1.5, 1.5)

        reach = np.arange(-9, 10)
        u, v = np.meshgrid(reach, reach)
        px, py = (np.floor(cx) + u).astype(int), (np.floor(cy) + v).astype(int)
        dx, dy = px + 0.5 - cx, py + 0.5 - cy
        p = (dx * math.cos(turn) + dy * math.sin(turn)) / a
        q = (dy * math.cos(turn) - dx * math.sin(turn)) / (a * b)
        r = np.hypot(p, q)
        cover = np.clip((1.0 - r) * a * b + 0.5, 0.0, 1.0)
        shade = value * (0.75 - 0.35 * (dx + dy) / a * np.minimum(r, 1.0))
        under = np.exp(-(np.maximum(np.hypot(dx - 1.5, dy - 1.5) / a - 0.8, 0.0) ** 2) * 14.0)

        j, i = py % size, px % size
        tone[j, i] *= 1.0 - 0.55 * under * (1.0 - cover)
        tone[j, i] += (shade - tone[j, i]) * cover
        top[j, i] = np.maximum(top[j, i], 0.55 * cover)
        hue[j, i] += (warm - hue[j, i]) * cover


def ground_detail() -> np.ndarray:
    """Return turf seen from above, tileable uint8 (DETAIL, DETAIL, 3), mean 127.5 per channel."""
    n = DETAIL
    soil = 0.34 + 0.10 * spectral_noise(n, 0.5, 41, 30.0) + 0.08 * spectral_noise(n, 1.2, 42, 14.0)
    tone = np.clip(soil, 0.08, 0.75)
    hue = 0.7 * spectral_noise(n, 1.1, 44, 16.0)
    turf = spectral_noise(n, 1.5, 43, 6.0)
    top = np.where(turf > 0.45, 1.0, 0.1)
    top = ndimage.gaussian_filter(top, 3.0, mode="wrap")
    draw_pebbles(tone, top, hue, 420, np.random.default_rng(7))
    draw_blades(n, 9000, np.random.default_rng(3), tone, top)

    tone -= ndimage.gaussian_filter(tone, 22.0, mode="wrap")
    spread = np.sqrt(ndimage.gaussian_filter(tone**2, 30.0, mode="wrap"))
    tone += 0.035 * spectral_noise(n, 0.2, 45, 60.0)
    tone = np.tanh(tone / spread * 0.40) * 0.36

    green = np.clip(top - 0.6, 0.0, 0.5)
    green -= ndimage.gaussian_filter(green, 22.0, mode="wrap")
    rgb = np.stack(
        [
            tone * 1.02 + 0.010 * hue - 0.03 * green,
            tone + 0.03 * green,
            tone * 0.86 - 0.012 * hue - 0.05 * green,
        ],
        axis=-1,
    )
    return to_uint8(rgb - rgb.mean(axis=(0, 1)) + 0.5)


ASSETS: dict[str, Callable[[], np.ndarray]] = {
    "ground_large.png": ground_large,
    "ground_detail.png": ground_detail,
}
