"""Signed distances, noise and swept curves for modelling, as numba functions.

A shape is negative inside. Shapes are joined with the polynomial smooth union of Inigo Quilez
("smooth minimum", 2013).
"""

import math

import numpy as np
from numba import njit


@njit
def mix(a: float, b: float, t: float) -> float:
    """Interpolate linearly from a (t = 0) to b (t = 1)."""
    return a + (b - a) * t


@njit
def clamp(x: float, low: float, high: float) -> float:
    """Clamp x to low..high."""
    return min(max(x, low), high)


@njit
def step_smooth(low: float, high: float, x: float) -> float:
    """Return the cubic step from 0 at ``low`` to 1 at ``high``; ``low`` may exceed ``high``."""
    t = clamp((x - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


@njit
def union(a: float, b: float, k: float) -> float:
    """Return the smooth union of two distances with a fillet of width k."""
    h = clamp(0.5 + 0.5 * (b - a) / k, 0.0, 1.0)
    return b + (a - b) * h - k * h * (1.0 - h)


@njit
def carve(a: float, b: float, k: float) -> float:
    """Return the smooth subtraction of b from a, with the edge rounded over a width k."""
    return -union(-a, b, k)


@njit
def ellipsoid(x: float, y: float, z: float, rx: float, ry: float, rz: float) -> float:
    """Return the distance to an ellipsoid about the origin (first order, exact at the surface)."""
    k0 = math.sqrt((x / rx) ** 2 + (y / ry) ** 2 + (z / rz) ** 2)
    k1 = math.sqrt((x / rx**2) ** 2 + (y / ry**2) ** 2 + (z / rz**2) ** 2)
    if k1 < 1e-9:
        return -min(rx, ry, rz)
    return k0 * (k0 - 1.0) / k1


@njit
def part_way(px: float, py: float, pz: float, dx: float, dy: float, dz: float) -> float:
    """Return where on the segment from 0 to d the point nearest to p is, 0..1."""
    return clamp((px * dx + py * dy + pz * dz) / (dx * dx + dy * dy + dz * dz), 0.0, 1.0)


@njit
def limb(
    x: float,
    y: float,
    z: float,
    ax: float,
    ay: float,
    az: float,
    ra: float,
    bx: float,
    by: float,
    bz: float,
    rb: float,
) -> float:
    """Return the distance to a limb: a segment from a to b whose radius goes from ra to rb."""
    dx = bx - ax
    dy = by - ay
    dz = bz - az
    t = part_way(x - ax, y - ay, z - az, dx, dy, dz)
    px = x - ax - t * dx
    py = y - ay - t * dy
    pz = z - az - t * dz
    return math.sqrt(px * px + py * py + pz * pz) - mix(ra, rb, t)


@njit
def turn(a: float, b: float, angle: float) -> tuple[float, float]:
    """Rotate the pair (a, b) by ``angle`` radians from a towards b."""
    c, s = math.cos(angle), math.sin(angle)
    return c * a - s * b, s * a + c * b


@njit
def _lattice(i: int, j: int, k: int) -> float:
    """Hash three integers to -1..1."""
    h = (i * 73856093) ^ (j * 19349663) ^ (k * 83492791)
    h = ((h ^ (h >> 13)) * 1274126177) & 0x7FFFFFFF
    h = ((h ^ (h >> 15)) * 668265263) & 0x7FFFFFFF
    return ((h >> 7) & 0xFFFF) / 32767.5 - 1.0


@njit
def noise(x: float, y: float, z: float) -> float:
    """Return value noise in -1..1 with a lattice spacing of one unit."""
    i = math.floor(x)
    j = math.floor(y)
    k = math.floor(z)
    u = x - i
    v = y - j
    w = z - k
    u = u * u * (3 - 2 * u)
    v = v * v * (3 - 2 * v)
    w = w * w * (3 - 2 * w)

    i = int(i)
    j = int(j)
    k = int(k)

    low = mix(
        mix(_lattice(i, j, k), _lattice(i + 1, j, k), u),
        mix(_lattice(i, j + 1, k), _lattice(i + 1, j + 1, k), u),
        v,
    )
    high = mix(
        mix(_lattice(i, j, k + 1), _lattice(i + 1, j, k + 1), u),
        mix(_lattice(i, j + 1, k + 1), _lattice(i + 1, j + 1, k + 1), u),
        v,
    )
    return mix(low, high, w)


def catmull_rom(points: np.ndarray, samples: int) -> np.ndarray:
    """Sample a Catmull-Rom curve through points (n, c) at equal arc lengths; return (samples, c).

    The first three columns are the position; any others (a radius) are interpolated with it.
    """
    points = np.asarray(points, dtype=float)
    ends = np.vstack([2 * points[0] - points[1], points, 2 * points[-1] - points[-2]])
    t = np.linspace(0, len(points) - 1, 40 * len(points))
    i = np.minimum(t.astype(int), len(points) - 2)
    f = (t - i)[:, None]
    p0 = ends[i]
    p1 = ends[i + 1]
    p2 = ends[i + 2]
    p3 = ends[i + 3]
    fine = p1 + 0.5 * f * (
        p2 - p0 + f * (2 * p0 - 5 * p1 + 4 * p2 - p3 + f * (3 * (p1 - p2) + p3 - p0))
    )
    length = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(fine[:, :3], axis=0), axis=1)))
    wanted = np.linspace(0, length[-1], samples)
    return np.stack([np.interp(wanted, length, column) for column in fine.T], axis=1)


@njit
def nearest(curve: np.ndarray, x: float, y: float, z: float) -> tuple[int, float, float]:
    """Return the segment, the parameter in it (0..1) and the distance of the nearest point.

    ``curve`` is (n, c >= 3) with the position in its first three columns. Only the two segments at
    the nearest vertex are searched, so the vertices must be close together.
    """
    best, corner = 1e30, 0
    for i in range(curve.shape[0]):
        d = (x - curve[i, 0]) ** 2 + (y - curve[i, 1]) ** 2 + (z - curve[i, 2]) ** 2
        if d < best:
            best, corner = d, i

    best = 1e30
    best_i = 0
    best_t = 0.0
    for i in range(max(corner - 1, 0), min(corner + 1, curve.shape[0] - 1)):
        ax = curve[i, 0]
        ay = curve[i, 1]
        az = curve[i, 2]
        dx = curve[i + 1, 0] - ax
        dy = curve[i + 1, 1] - ay
        dz = curve[i + 1, 2] - az
        px = x - ax
        py = y - ay
        pz = z - az
        t = part_way(px, py, pz, dx, dy, dz)
        d = (px - t * dx) ** 2 + (py - t * dy) ** 2 + (pz - t * dz) ** 2
        if d < best:
            best = d
            best_i = i
            best_t = t

    return best_i, best_t, math.sqrt(best)


@njit
def across(
    curve: np.ndarray, i: int, t: float, x: float, y: float, z: float
) -> tuple[float, float]:
    """Return x, y, z along the two directions across a curve, from its point ``t`` after vertex i.

    The directions are in the columns 5 to 7 and 8 to 10 of ``curve``.
    """
    u = v = 0.0
    for k in range(3):
        o = (x, y, z)[k] - mix(curve[i, k], curve[i + 1, k], t)
        u += o * mix(curve[i, 5 + k], curve[i + 1, 5 + k], t)
        v += o * mix(curve[i, 8 + k], curve[i + 1, 8 + k], t)
    return u, v
