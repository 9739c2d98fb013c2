"""The island's height field: drawn by hand in outline, carved by water.

A coast line, a few ridges with their heights, a valley, a hill and some islets are given as points
(that is what the named views rely on); everything between them comes from erosion. The mountains
rise slowly while rivers cut them down, by the implicit stream power law of Braun and Willett (2013)
with the drainage found by a priority flood (Barnes et al. 2014), as in Cordonnier et al. (2016);
slopes beyond the angle of repose slide (Musgrave et al. 1989); then rain drops carve the small
gullies (Beyer 2015). Axes: arrays are [z, x], row 0 north, column 0 west; lengths in island units.
"""

import heapq
import math
from collections.abc import Callable
from functools import cache

import numpy as np
from numba import njit
from scipy import ndimage
from scipy.interpolate import splev, splprep
from skimage.draw import polygon2mask

from landscape.studio.images import shrink, smoothstep, spectral_noise

SIZE = 512  # the report's height image
WORLD = 40.0  # the report's island, in units
CELL = WORLD / SIZE
SCALE_Y = 6.0  # chosen
WATER_LEVEL = 0.6  # chosen
SEA_FLOOR = 0.08  # chosen: the open sea
PEAK = 4.98  # chosen: the highest point

# Chosen: the coast from the north-west corner on, clockwise; the bay is the dent at (11, 29).
COAST = [
    (5.6, 8.6), (5.2, 6.9), (6.9, 5.9), (8.6, 5.9), (9.8, 4.3), (11.8, 3.6), (13.4, 4.6),
    (15.4, 4.5), (17.0, 3.1), (19.6, 2.9), (21.0, 4.2), (22.8, 4.6), (24.6, 3.9), (26.6, 5.4),
    (27.0, 7.2), (28.6, 8.4), (30.2, 9.2), (29.8, 11.2), (30.2, 13.2), (30.9, 15.0), (31.2, 17.2),
    (31.4, 19.2), (30.5, 21.0), (29.8, 22.8), (30.4, 24.8), (30.0, 26.6), (28.6, 28.0),
    (28.9, 29.8), (27.4, 31.2), (25.0, 31.6), (23.0, 32.8), (20.6, 33.2), (18.4, 32.2),
    (16.8, 32.7), (15.2, 31.5), (13.9, 30.0), (14.2, 28.4), (13.2, 26.8), (11.3, 26.2), (9.4, 26.6),
    (8.2, 27.8), (7.6, 29.2), (6.2, 29.0), (5.0, 27.0), (4.9, 24.6), (4.0, 22.6), (4.8, 20.6),
    (5.5, 18.8), (4.4, 16.8), (3.7, 14.6), (4.5, 12.6), (4.6, 10.5),
]  # fmt: skip

# Chosen: crests as (x, z, y). The first five are the massif, the last ties the castle's hill to it.
RIDGES = [
    [(13.0, 10.0, 5.0), (15.8, 9.3, 3.6), (19.0, 7.0, 3.75), (22.5, 7.2, 2.6), (25.8, 7.4, 1.9)],
    [(13.0, 10.0, 5.0), (10.6, 8.6, 3.6), (8.4, 7.6, 2.4), (6.6, 7.0, 1.4)],
    [(13.0, 10.0, 5.0), (10.9, 12.3, 3.7), (9.2, 15.4, 2.8), (7.4, 17.6, 2.1), (7.0, 20.0, 1.3)],
    [(13.0, 10.0, 5.0), (14.4, 12.4, 3.8), (15.2, 15.2, 2.7), (16.6, 17.2, 1.6)],
    [(19.0, 7.0, 3.75), (19.9, 9.6, 3.0), (19.6, 12.2, 1.8)],
    [(27.0, 17.0, 1.6), (28.2, 13.2, 1.7), (27.8, 10.2, 1.8), (25.8, 7.4, 1.9)],
]
RIDGES_OF_MASSIF = 5

# Chosen: the floor of the shallow valley from the meadow to the north-north-east, as (x, z, y).
VALLEY = [(19.8, 21.5, 1.0), (20.6, 17.5, 1.1), (21.5, 14.0, 1.2), (23.0, 11.2, 1.32)]

# Chosen: (x, z, radius, height above the water, steepness): three eastern islets seen from the
# castle, the southern one, and rocks that stand in the sea off the northern cliffs.
ISLETS = [
    (33.9, 14.5, 1.35, 0.60, 2.0), (34.9, 19.0, 1.60, 0.50, 1.5), (33.4, 23.2, 1.25, 0.55, 2.2),
    (19.0, 36.3, 1.20, 0.52, 2.2), (8.0, 4.1, 0.42, 0.62, 5.0), (22.7, 3.0, 0.40, 0.50, 5.0),
    (28.9, 6.6, 0.45, 0.55, 5.0),
]  # fmt: skip

HILL_TOP = 2.3  # chosen: the castle's court
# Chosen: a grid of 50 x 50 drawn over 40 units moves x by up to 2 %, so the flat disc is larger
# than the court and a little to its north-west.
HILL_CENTRE = (26.5, 16.7)
HILL_FLAT = 2.45
BAY = (11.0, 29.0)


def axes() -> tuple[np.ndarray, np.ndarray]:
    """Return x and z, each (SIZE, SIZE), at the centres of the cells."""
    centre = (np.arange(SIZE) + 0.5) * CELL
    x, z = np.meshgrid(centre, centre)
    return x, z


def coast_distance(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return the distance to the coast at x, z, positive on land, bent by noise into coves."""
    points = np.array([*COAST, COAST[0]])
    spline, _ = splprep(points.T, s=0, per=1)
    cx, cz = splev(np.linspace(0, 1, 2000), spline)
    inside = polygon2mask((SIZE, SIZE), np.stack([cz, cx], axis=1) / CELL - 0.5)
    distance = ndimage.distance_transform_edt(inside) - ndimage.distance_transform_edt(~inside)
    distance = ndimage.gaussian_filter(distance * CELL, 2.0)
    rocky = 1.0 - 0.65 * beach_share(x, z)
    bend_x, bend_z = (0.20 * rocky * spectral_noise(SIZE, 1.5, s, 9.0) for s in (15, 17))
    return ndimage.map_coordinates(
        distance, [(z + bend_z) / CELL - 0.5, (x + bend_x) / CELL - 0.5], order=1, mode="nearest"
    )


def beach_share(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return 1 where the shore is a beach (south and west), 0 where it is a cliff."""
    beach = smoothstep(16.0, 21.0, z) + smoothstep(10.0, 6.0, x) * smoothstep(9.5, 12.5, z)
    steep_east = smoothstep(27.5, 29.0, x) * smoothstep(26.5, 24.0, z)
    return np.clip(beach, 0.0, 1.0) * (1.0 - 0.75 * steep_east)


def line_distance(
    x: np.ndarray, z: np.ndarray, line: list[tuple[float, float, float]]
) -> tuple[np.ndarray, np.ndarray]:
    """Return the distance to a broken line of (x, z, y) and the line's y at the nearest point."""
    best, height = np.full_like(x, np.inf), np.zeros_like(x)
    for (ax, az, ah), (bx, bz, bh) in zip(line[:-1], line[1:], strict=True):
        dx, dz = bx - ax, bz - az
        t = np.clip(((x - ax) * dx + (z - az) * dz) / (dx * dx + dz * dz), 0.0, 1.0)
        r = np.hypot(x - ax - t * dx, z - az - t * dz)
        height = np.where(r < best, ah + (bh - ah) * t, height)
        best = np.minimum(r, best)
    return best, height


def crest_height(
    x: np.ndarray, z: np.ndarray, lines: list[list[tuple[float, float, float]]]
) -> np.ndarray:
    """Return how far the mountains stand above the plain: concave flanks below the crests."""
    out = np.zeros_like(x)
    for line in lines:
        r, crest = line_distance(x, z, line)
        crest = np.maximum(crest - 1.0, 0.05)
        width = 1.0 + 0.6 * crest
        flank = (np.exp(-r / width) - math.exp(-2.2)) / (1.0 - math.exp(-2.2))
        out = np.maximum(out, crest * np.maximum(flank, 0.0))
    return out


@njit(cache=True)
def _drain(h: np.ndarray, order: np.ndarray, receiver: np.ndarray) -> None:
    """Fill ``order`` (from the rim inwards) and ``receiver`` so that all cells drain to the rim."""
    n = h.shape[0]
    flat = h.ravel()
    seen = np.zeros(n * n, np.bool_)
    heap = [(flat[0], 0)]
    heap.pop()
    for p in range(n * n):
        row, column = p // n, p % n
        if row == 0 or column == 0 or row == n - 1 or column == n - 1:
            heapq.heappush(heap, (flat[p], p))
            seen[p] = True
            receiver[p] = p
    count = 0
    while len(heap) > 0:
        level, p = heapq.heappop(heap)
        order[count] = p
        count += 1
        row, column = p // n, p % n
        steepest = 0.0
        for dj in range(-1, 2):
            for di in range(-1, 2):
                a, b = row + dj, column + di
                if (dj == 0 and di == 0) or a < 0 or b < 0 or a >= n or b >= n:
                    continue
                q = a * n + b
                if not seen[q]:
                    seen[q] = True
                    receiver[q] = p
                    heapq.heappush(heap, (max(flat[q], level + 1e-7), q))
                elif receiver[p] != p:
                    slope = (flat[p] - flat[q]) / math.sqrt(dj * dj + di * di)
                    if slope > steepest and flat[receiver[p]] < flat[p]:
                        steepest = slope
                        receiver[p] = q


@njit(cache=True)
def rivers(
    h: np.ndarray, low: np.ndarray, uplift: np.ndarray, power: np.ndarray, cell: float, steps: int
) -> np.ndarray:
    """Raise ``h`` (n, n) by ``uplift`` and let rivers of strength ``power`` cut it, in place.

    One step solves dh/dt = uplift - power * area**0.5 * slope implicitly from the sea upwards; no
    cell is cut below ``low``. Returns the area (n, n) that drains through each cell.
    """
    n = h.shape[0]
    flat, bound, rise, k = h.ravel(), low.ravel(), uplift.ravel(), power.ravel()
    order, receiver = np.empty(n * n, np.int64), np.empty(n * n, np.int64)
    area = np.empty(n * n)
    for _ in range(steps):
        _drain(h, order, receiver)
        area[:] = cell * cell
        for c in range(n * n - 1, -1, -1):
            p = order[c]
            if receiver[p] != p:
                area[receiver[p]] += area[p]
        for c in range(n * n):
            p = order[c]
            q = receiver[p]
            if q != p and flat[p] > bound[p]:
                flat[p] += rise[p]
                across = p // n != q // n and p % n != q % n
                f = k[p] * math.sqrt(area[p]) / (cell * (1.4142 if across else 1.0))
                cut = (flat[p] + f * flat[q]) / (1.0 + f)
                flat[p] = max(bound[p], min(flat[p], cut))
        for _slide in range(2):
            _slip(h, 1.2 * cell)
    return area.reshape(n, n)


@njit(cache=True)
def _slip(h: np.ndarray, repose: float) -> None:
    """Move a fifth of what exceeds the drop ``repose`` between neighbours downhill, in place."""
    n = h.shape[0]
    change = np.zeros_like(h)
    for j in range(n):
        for i in range(n):
            for dj, di in ((0, 1), (1, 0), (1, 1), (1, -1)):
                a, b = j + dj, i + di
                if a >= n or b >= n or b < 0:
                    continue
                limit = repose * (1.4142 if dj and di else 1.0)
                drop = h[j, i] - h[a, b]
                if drop > limit:
                    change[j, i] -= 0.1 * (drop - limit)
                    change[a, b] += 0.1 * (drop - limit)
                elif drop < -limit:
                    change[j, i] -= 0.1 * (drop + limit)
                    change[a, b] += 0.1 * (drop + limit)
    h += change


@njit(cache=True)
def rain(
    h: np.ndarray, drops: int, rng: np.random.Generator, radius: int, sea: float
) -> np.ndarray:
    """Let drops carve and fill ``h`` (n, n) in place; return how much water passed each cell.

    Beyer's parameters (inertia 0.05, erosion 0.3, evaporation 0.01, gravity 4), but deposition 0.1:
    his 0.3 fills the valleys that the rivers have cut. The brush is centred on the drop, not on its
    cell: half a cell of bias carves one side of every ridge and spares the other.
    """
    n = h.shape[0]
    passes = np.zeros((n, n))
    for _ in range(drops):
        x, z = rng.random() * (n - 2), rng.random() * (n - 2)
        if h[int(z), int(x)] < sea:
            continue
        dx, dz, speed, water, load = 0.0, 0.0, 1.0, 1.0, 0.0
        for _life in range(60):
            i, j = int(x), int(z)
            u, v = x - i, z - j
            a, b, c, d = h[j, i], h[j, i + 1], h[j + 1, i], h[j + 1, i + 1]
            here = (a * (1 - u) + b * u) * (1 - v) + (c * (1 - u) + d * u) * v
            dx = dx * 0.05 - ((b - a) * (1 - v) + (d - c) * v) * 0.95
            dz = dz * 0.05 - ((c - a) * (1 - u) + (d - b) * u) * 0.95
            length = math.hypot(dx, dz)
            if length < 1e-9:
                break
            dx, dz = dx / length, dz / length
            x, z = x + dx, z + dz
            if x < 1 or z < 1 or x >= n - 2 or z >= n - 2:
                break
            i2, j2 = int(x), int(z)
            s, t = x - i2, z - j2
            there = (h[j2, i2] * (1 - s) + h[j2, i2 + 1] * s) * (1 - t) + (
                h[j2 + 1, i2] * (1 - s) + h[j2 + 1, i2 + 1] * s
            ) * t
            rise = there - here
            passes[j, i] += water
            capacity = max(-rise, 0.0008) * speed * water * 4.0
            if load > capacity or rise > 0.0:
                left = min(rise, load) if rise > 0.0 else (load - capacity) * 0.1
                load -= left
                h[j, i] += left * (1 - u) * (1 - v)
                h[j, i + 1] += left * u * (1 - v)
                h[j + 1, i] += left * (1 - u) * v
                h[j + 1, i + 1] += left * u * v
            else:
                taken = min((capacity - load) * 0.3, -rise)
                load += taken
                total = 0.0
                for turn in range(2):
                    for bj in range(-radius, radius + 2):
                        for bi in range(-radius, radius + 2):
                            weight = radius - math.hypot(bi - u, bj - v)
                            if weight > 0 and 0 <= j + bj < n and 0 <= i + bi < n:
                                if turn == 0:
                                    total += weight
                                else:
                                    h[j + bj, i + bi] -= taken * weight / total
            if there < sea:
                break
            speed = math.sqrt(max(0.0, speed * speed - rise * 4.0))
            water *= 0.99
    return passes


def castle_hill(
    x: np.ndarray, z: np.ndarray, coast: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the hill's share of each cell (0..1), the distance from its middle, the path's share.

    Long and gentle to the south-south-west, where the path climbs, short towards the sea.
    """
    dx, dz = x - HILL_CENTRE[0], z - HILL_CENTRE[1]
    r = np.hypot(dx, dz)
    along = (dx * -0.42 + dz * 0.91) / np.maximum(r, 1e-6)
    east = np.maximum(dx / np.maximum(r, 1e-6), 0.0)
    slope = smoothstep(0.1, 0.85, along)
    uneven = -0.40 * np.abs(spectral_noise(SIZE, 2.2, 18, 6.0)) * (1.0 - np.maximum(east, slope))
    length = 2.7 - 0.8 * east + 3.6 * smoothstep(0.1, 0.85, along)
    share = 1.0 - smoothstep(0.0, 1.0, (r + uneven - HILL_FLAT) / length)
    share *= np.where(r > HILL_FLAT, smoothstep(-0.1, 1.2, coast), 1.0)
    path = smoothstep(0.75, 0.95, along) * smoothstep(8.5, 7.5, r)
    return share, r, path


def lowland(x: np.ndarray, z: np.ndarray, coast: np.ndarray) -> np.ndarray:
    """Return y of the plain, the shore and the sea floor, from the distance to the coast."""
    beach = beach_share(x, z)
    inland = np.maximum(coast, 0.0)
    sand = 0.12 * inland
    soft = np.where(sand > 0.14, 0.14 + 0.40 * (1.0 - np.exp(-(sand - 0.14) / 0.40)), sand)
    cliff = 0.62 * (1.0 - np.exp(-inland / 0.30))
    rolling = 0.065 * spectral_noise(SIZE, 2.0, 12, 4.0) * smoothstep(0.8, 3.0, inland)
    knolls = 0.45 * np.exp(-((x - 7.6) ** 2 + (z - 22.8) ** 2) / 2.4)
    knolls += 0.50 * np.exp(-((x - 27.3) ** 2 + (z - 26.6) ** 2) / 2.6)
    land = np.maximum(soft * beach + cliff * (1.0 - beach), 0.015) + rolling
    land += knolls * smoothstep(0.0, 2.0, coast)
    bay = np.exp(-((np.hypot(x - BAY[0], z - BAY[1]) / 3.4) ** 4))
    reach = 0.42 + (1.1 - 0.6 * bay) * beach
    depth = (WATER_LEVEL - SEA_FLOOR) * (1.0 - np.exp(-((np.maximum(-coast, 0.0) / reach) ** 1.2)))
    return WATER_LEVEL + np.where(coast > 0.0, land, -depth)


def erode(
    ground: np.ndarray, massif: np.ndarray, spur: np.ndarray, plain: np.ndarray, coast: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return y with the massif risen and cut, and the flow of water (log of drops and area)."""
    low = np.where(coast > 0.0, WATER_LEVEL + 0.02 + 0.75 * (plain - WATER_LEVEL), plain)
    soft = smoothstep(0.02, 0.5, massif) + 0.35 * smoothstep(0.1, 0.6, spur)
    soft = np.clip(soft, 0.0, 1.0) * (coast > 0.0)
    h = ground + 0.45 * massif * (1.0 + 0.25 * spectral_noise(SIZE, 1.2, 16, 8.0))
    # Long rivers form on a grid of half the size, their branches on the full one.
    half = [shrink(g[..., None], 2)[..., 0] for g in (h, low, massif, soft)]
    rivers(half[0], half[1], 0.030 * half[2], 0.08 * half[3] + 0.004, 2.0 * CELL, 45)
    coarse = ndimage.zoom(half[0], 2, order=3, grid_mode=True, mode="nearest")
    h += (coarse - h) * np.minimum(1.0, 1.5 * soft)
    area = rivers(h, low, 0.026 * massif, 0.08 * soft + 0.002, CELL, 9)
    # On gentle ground the eight directions of the drainage show as straight trenches.
    gentle = smoothstep(1.3, 0.5, massif) * smoothstep(0.0, 0.05, massif) * (coast > 0.0)
    h += (ndimage.gaussian_filter(h, 2.0) - h) * gentle
    before = h.copy()
    passes = rain(h, 130_000, np.random.default_rng(5), 3, WATER_LEVEL + 0.02)
    for _ in range(8):
        _slip(h, 1.05 * CELL)
    h = before + (ndimage.gaussian_filter(h, 0.6) - before) * np.maximum(0.10 * (coast > 0.3), soft)
    h += (h - low) * smoothstep(0.1, 1.0, massif) * ((PEAK - 1.0) / (h.max() - 1.0) - 1.0)
    h += (ndimage.gaussian_filter(h, 1.2) - h) * smoothstep(0.6, 0.2, np.abs(coast))
    return h, np.log1p(passes) + 0.5 * np.log1p(area / CELL**2)


def islet_height(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return y of the islets, and the sea floor's depth away from them."""
    out = np.full_like(x, SEA_FLOOR)
    shape = 1.0 + 0.14 * np.clip(spectral_noise(SIZE, 2.0, 11, 14.0), -2.0, 2.0)
    for ix, iz, size, top, steep in ISLETS:
        q = np.hypot(x - ix, z - iz) * shape / size
        dome = top * (1.0 - np.minimum(q, 1.0) ** steep)
        depth = (WATER_LEVEL - SEA_FLOOR) * (1.0 - np.exp(-np.maximum(q - 1.0, 0.0) * size / 0.3))
        out = np.maximum(out, WATER_LEVEL + dome - depth)
    return out


@cache
def build() -> tuple[np.ndarray, np.ndarray]:
    """Return the heights y and the flow of water (see `erode`), both (SIZE, SIZE)."""
    x, z = axes()
    coast = coast_distance(x, z)
    plain = ndimage.gaussian_filter(lowland(x, z, coast), 0.8)
    bent_x, bent_z = (g + 0.5 * spectral_noise(SIZE, 1.8, s, 4.0) for g, s in ((x, 13), (z, 14)))
    inland = smoothstep(-0.1, 1.6, coast)
    massif = crest_height(bent_x, bent_z, RIDGES[:RIDGES_OF_MASSIF]) * inland
    spur = crest_height(bent_x, bent_z, RIDGES[RIDGES_OF_MASSIF:]) * inland
    hill, radius, path = castle_hill(x, z, coast)
    ground = plain + 0.8 * spur
    ground += (HILL_TOP - ground) * hill
    valley_r, valley_y = line_distance(0.5 * (x + bent_x), 0.5 * (z + bent_z), VALLEY)
    kept = 3.0 * (smoothstep(0.05, 0.7, hill) + smoothstep(1.0, 0.3, coast))
    above = np.maximum(ground - valley_y - 0.12 * valley_r**2 - kept, 0.0)
    ground -= above * above / (above + 0.25)

    h, flow = erode(ground, massif, spur, plain, coast)
    # The court and the path are level and even again whatever the rain did.
    h += (ground - h) * np.maximum(1.0 - smoothstep(HILL_FLAT, HILL_FLAT + 0.5, radius), path)
    h -= 0.25 * np.exp(-((np.hypot(x - BAY[0], z - BAY[1]) / 1.9) ** 2))
    h = np.maximum(h, islet_height(x, z))
    h = np.where(h < SEA_FLOOR, SEA_FLOOR + 0.2 * (h - SEA_FLOOR), h)
    edge = smoothstep(1.2, 2.8, np.minimum.reduce([x, z, WORLD - x, WORLD - z]))
    return SEA_FLOOR + (h - SEA_FLOOR) * edge, flow


def height_16() -> np.ndarray:
    """Return the heights as uint16 (SIZE, SIZE): y = value / 65536 * SCALE_Y."""
    return np.clip(np.round(build()[0] / SCALE_Y * 65536.0), 0, 65535).astype(np.uint16)


def height_8() -> np.ndarray:
    """Return the heights as the report has them, uint8 (SIZE, SIZE, 3): y = red / 256 * SCALE_Y."""
    grey = np.round(height_16() / 257.0).astype(np.uint8)
    return np.repeat(grey[..., None], 3, axis=2)


ASSETS: dict[str, Callable[[], np.ndarray]] = {"height16.png": height_16, "height.png": height_8}
