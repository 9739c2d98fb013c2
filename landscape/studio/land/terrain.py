"""The island's height field: an outline placed by hand, shaped by simulated erosion.

The coast line, a few ridges with their heights, a valley, a hill and some islets are given as
points, because the named views rely on them. Everything between them comes from
:mod:`landscape.studio.land.erosion`: the mountains rise slowly while rivers cut them down, steep
slopes slide, and rain drops carve the small gullies.

Arrays are [z, x]: row 0 is north, column 0 is west. Lengths are in island units.
"""

import math
from collections.abc import Callable
from functools import cache

import numpy as np
from scipy import ndimage
from scipy.interpolate import splev, splprep
from skimage.draw import polygon2mask

from landscape.studio.images import shrink, smoothstep, spectral_noise
from landscape.studio.land.erosion import rain, rivers, slide_once

SIZE = 512  # size of the report's height image
WORLD = 40.0  # side of the report's map, in units
CELL = WORLD / SIZE
SCALE_Y = 6.0  # chosen
WATER_LEVEL = 0.6  # chosen
SEA_FLOOR = 0.08  # chosen: y of the floor of the open sea
PEAK = 4.98  # chosen: the highest point

# Chosen: the coast as (x, z), clockwise from the north-west corner; the bay is at (11, 29).
COAST = [
    (5.6, 8.6),
    (5.2, 6.9),
    (6.9, 5.9),
    (8.6, 5.9),
    (9.8, 4.3),
    (11.8, 3.6),
    (13.4, 4.6),
    (15.4, 4.5),
    (17.0, 3.1),
    (19.6, 2.9),
    (21.0, 4.2),
    (22.8, 4.6),
    (24.6, 3.9),
    (26.6, 5.4),
    (27.0, 7.2),
    (28.6, 8.4),
    (30.2, 9.2),
    (29.8, 11.2),
    (30.2, 13.2),
    (30.9, 15.0),
    (31.2, 17.2),
    (31.4, 19.2),
    (30.5, 21.0),
    (29.8, 22.8),
    (30.4, 24.8),
    (30.0, 26.6),
    (28.6, 28.0),
    (28.9, 29.8),
    (27.4, 31.2),
    (25.0, 31.6),
    (23.0, 32.8),
    (20.6, 33.2),
    (18.4, 32.2),
    (16.8, 32.7),
    (15.2, 31.5),
    (13.9, 30.0),
    (14.2, 28.4),
    (13.2, 26.8),
    (11.3, 26.2),
    (9.4, 26.6),
    (8.2, 27.8),
    (7.6, 29.2),
    (6.2, 29.0),
    (5.0, 27.0),
    (4.9, 24.6),
    (4.0, 22.6),
    (4.8, 20.6),
    (5.5, 18.8),
    (4.4, 16.8),
    (3.7, 14.6),
    (4.5, 12.6),
    (4.6, 10.5),
]

# Chosen: crests as (x, z, y). The first five are the massif; the last joins the castle hill to it.
RIDGES = [
    [(13.0, 10.0, 5.0), (15.8, 9.3, 3.6), (19.0, 7.0, 3.75), (22.5, 7.2, 2.6), (25.8, 7.4, 1.9)],
    [(13.0, 10.0, 5.0), (10.6, 8.6, 3.6), (8.4, 7.6, 2.4), (6.6, 7.0, 1.4)],
    [(13.0, 10.0, 5.0), (10.9, 12.3, 3.7), (9.2, 15.4, 2.8), (7.4, 17.6, 2.1), (7.0, 20.0, 1.3)],
    [(13.0, 10.0, 5.0), (14.4, 12.4, 3.8), (15.2, 15.2, 2.7), (16.6, 17.2, 1.6)],
    [(19.0, 7.0, 3.75), (19.9, 9.6, 3.0), (19.6, 12.2, 1.8)],
    [(27.0, 17.0, 1.6), (28.2, 13.2, 1.7), (27.8, 10.2, 1.8), (25.8, 7.4, 1.9)],
]
RIDGES_OF_MASSIF = 5

# Chosen: the floor of the shallow valley that runs north-north-east from the meadow, as (x, z, y).
VALLEY = [(19.8, 21.5, 1.0), (20.6, 17.5, 1.1), (21.5, 14.0, 1.2), (23.0, 11.2, 1.32)]

# Chosen: (x, z, radius, height above the water, steepness) of the three eastern islets, seen from
# the castle, the southern islet, and the rocks off the northern cliffs.
ISLETS = [
    (33.9, 14.5, 1.35, 0.60, 2.0),
    (34.9, 19.0, 1.60, 0.50, 1.5),
    (33.4, 23.2, 1.25, 0.55, 2.2),
    (19.0, 36.3, 1.20, 0.52, 2.2),
    (8.0, 4.1, 0.42, 0.62, 5.0),
    (22.7, 3.0, 0.40, 0.50, 5.0),
    (28.9, 6.6, 0.45, 0.55, 5.0),
]

HILL_TOP = 2.3  # chosen: y of the castle court
# Chosen: resampling to 50 x 50 vertices over 40 units shifts positions by up to 2 %, so the flat
# disc is larger than the court and slightly to its north-west.
HILL_CENTRE = (26.5, 16.7)
HILL_FLAT = 2.45
BAY = (11.0, 29.0)


def axes() -> tuple[np.ndarray, np.ndarray]:
    """Return x and z at the cell centres, each (SIZE, SIZE)."""
    centre = (np.arange(SIZE) + 0.5) * CELL
    x, z = np.meshgrid(centre, centre)
    return x, z


def coast_distance(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return the signed distance to the coast, positive on land, warped by noise into coves."""
    points = np.array([*COAST, COAST[0]])
    spline, _ = splprep(points.T, s=0, per=1)
    cx, cz = splev(np.linspace(0, 1, 2000), spline)
    inside = polygon2mask((SIZE, SIZE), np.stack([cz, cx], axis=1) / CELL - 0.5)
    distance = ndimage.distance_transform_edt(inside) - ndimage.distance_transform_edt(~inside)
    distance = ndimage.gaussian_filter(distance * CELL, 2.0)
    rocky = 1.0 - 0.65 * beach_mask(x, z)
    warp_x, warp_z = (0.20 * rocky * spectral_noise(SIZE, 1.5, s, 9.0) for s in (15, 17))
    return ndimage.map_coordinates(
        distance, [(z + warp_z) / CELL - 0.5, (x + warp_x) / CELL - 0.5], order=1, mode="nearest"
    )


def beach_mask(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return 1 where the shore is a beach (south and west) and 0 where it is a cliff."""
    beach = smoothstep(16.0, 21.0, z) + smoothstep(10.0, 6.0, x) * smoothstep(9.5, 12.5, z)
    steep_east = smoothstep(27.5, 29.0, x) * smoothstep(26.5, 24.0, z)
    return np.clip(beach, 0.0, 1.0) * (1.0 - 0.75 * steep_east)


def line_distance(
    x: np.ndarray, z: np.ndarray, line: list[tuple[float, float, float]]
) -> tuple[np.ndarray, np.ndarray]:
    """Return the distance to a polyline of (x, z, y), and its y at the nearest point."""
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
    """Return the height of the mountains above the plain: concave flanks below the crests."""
    out = np.zeros_like(x)
    for line in lines:
        r, crest = line_distance(x, z, line)
        crest = np.maximum(crest - 1.0, 0.05)
        width = 1.0 + 0.6 * crest
        flank = (np.exp(-r / width) - math.exp(-2.2)) / (1.0 - math.exp(-2.2))
        out = np.maximum(out, crest * np.maximum(flank, 0.0))
    return out


def castle_hill(
    x: np.ndarray, z: np.ndarray, coast: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the weight of the hill (0..1), the distance to its centre, the weight of the path.

    The slope is long and gentle to the south-south-west, where the path climbs, and short towards
    the sea.
    """
    dx, dz = x - HILL_CENTRE[0], z - HILL_CENTRE[1]
    r = np.hypot(dx, dz)
    along = (dx * -0.42 + dz * 0.91) / np.maximum(r, 1e-6)
    east = np.maximum(dx / np.maximum(r, 1e-6), 0.0)
    slope = smoothstep(0.1, 0.85, along)
    uneven = -0.40 * np.abs(spectral_noise(SIZE, 2.2, 18, 6.0)) * (1.0 - np.maximum(east, slope))
    length = 2.7 - 0.8 * east + 3.6 * smoothstep(0.1, 0.85, along)
    weight = 1.0 - smoothstep(0.0, 1.0, (r + uneven - HILL_FLAT) / length)
    weight *= np.where(r > HILL_FLAT, smoothstep(-0.1, 1.2, coast), 1.0)
    path = smoothstep(0.75, 0.95, along) * smoothstep(8.5, 7.5, r)
    return weight, r, path


def lowland(x: np.ndarray, z: np.ndarray, coast: np.ndarray) -> np.ndarray:
    """Return y of the plain, the shore and the sea floor from the signed distance to the coast."""
    beach = beach_mask(x, z)
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
    """Return y after uplift and erosion, and the water flow (log of drops and drainage area)."""
    low = np.where(coast > 0.0, WATER_LEVEL + 0.02 + 0.75 * (plain - WATER_LEVEL), plain)
    soft = smoothstep(0.02, 0.5, massif) + 0.35 * smoothstep(0.1, 0.6, spur)
    soft = np.clip(soft, 0.0, 1.0) * (coast > 0.0)
    h = ground + 0.45 * massif * (1.0 + 0.25 * spectral_noise(SIZE, 1.2, 16, 8.0))

    # Long rivers form on a grid of half the resolution, their branches on the full grid.
    half = [shrink(g[..., None], 2)[..., 0] for g in (h, low, massif, soft)]
    rivers(half[0], half[1], 0.030 * half[2], 0.08 * half[3] + 0.004, 2.0 * CELL, 45)
    coarse = ndimage.zoom(half[0], 2, order=3, grid_mode=True, mode="nearest")
    h += (coarse - h) * np.minimum(1.0, 1.5 * soft)
    area = rivers(h, low, 0.026 * massif, 0.08 * soft + 0.002, CELL, 9)

    # Smooth gentle ground, where the eight drainage directions show as straight trenches.
    gentle = smoothstep(1.3, 0.5, massif) * smoothstep(0.0, 0.05, massif) * (coast > 0.0)
    h += (ndimage.gaussian_filter(h, 2.0) - h) * gentle
    before = h.copy()
    passes = rain(h, 130_000, np.random.default_rng(5), 3, WATER_LEVEL + 0.02)
    for _ in range(8):
        slide_once(h, 1.05 * CELL)
    h = before + (ndimage.gaussian_filter(h, 0.6) - before) * np.maximum(0.10 * (coast > 0.3), soft)
    h += (h - low) * smoothstep(0.1, 1.0, massif) * ((PEAK - 1.0) / (h.max() - 1.0) - 1.0)
    h += (ndimage.gaussian_filter(h, 1.2) - h) * smoothstep(0.6, 0.2, np.abs(coast))
    return h, np.log1p(passes) + 0.5 * np.log1p(area / CELL**2)


def islet_height(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return y of the islets, falling to the sea floor around them."""
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
    """Return the heights y and the water flow (see ``erode``), both (SIZE, SIZE)."""
    x, z = axes()
    coast = coast_distance(x, z)
    plain = ndimage.gaussian_filter(lowland(x, z, coast), 0.8)
    warped_x, warped_z = (
        g + 0.5 * spectral_noise(SIZE, 1.8, s, 4.0) for g, s in ((x, 13), (z, 14))
    )
    inland = smoothstep(-0.1, 1.6, coast)
    massif = crest_height(warped_x, warped_z, RIDGES[:RIDGES_OF_MASSIF]) * inland
    spur = crest_height(warped_x, warped_z, RIDGES[RIDGES_OF_MASSIF:]) * inland
    hill, radius, path = castle_hill(x, z, coast)
    ground = plain + 0.8 * spur
    ground += (HILL_TOP - ground) * hill
    valley_r, valley_y = line_distance(0.5 * (x + warped_x), 0.5 * (z + warped_z), VALLEY)
    margin = 3.0 * (smoothstep(0.05, 0.7, hill) + smoothstep(1.0, 0.3, coast))
    above = np.maximum(ground - valley_y - 0.12 * valley_r**2 - margin, 0.0)
    ground -= above * above / (above + 0.25)

    h, flow = erode(ground, massif, spur, plain, coast)
    # Restore the court and the path to their heights before erosion.
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
    """Return the heights as in the report, uint8 (SIZE, SIZE, 3): y = red / 256 * SCALE_Y."""
    grey = np.round(height_16() / 257.0).astype(np.uint8)
    return np.repeat(grey[..., None], 3, axis=2)


ASSETS: dict[str, Callable[[], np.ndarray]] = {"height16.png": height_16, "height.png": height_8}
