"""A red deer stag and a doe in profile, for the billboards.

Each animal is a signed distance field of round cones (Quilez, "Distance functions"), one chain of
them per muscle, bone or tine, joined by the polynomial smooth union, and sphere traced (Hart 1996)
at three times the final size. The coat is a line integral convolution of white noise (Cabral and
Leedom 1993) along the direction of the hair, which every cone carries. A coarse grid of the same
distances serves the soft shadows and the ambient occlusion.

Frame of the model: x right, y up, z towards the viewer; unit: the height of the withers.
"""

import functools
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numba import njit
from scipy import ndimage
from scipy.interpolate import CubicSpline

from landscape.studio.images import shrink, smoothstep
from landscape.studio.light import GROUND_BOUNCE, SKY_COLOR, SPRITE_SUN, SUN_COLOR
from landscape.studio.plants import sprite

SIZE = 512
SUPERSAMPLING = 3
TILE = 16  # chosen: samples per side of the tiles that share a list of cones
CHAIN_BLEND = 0.3  # chosen: the blend inside a chain, as a part of the chain's own
CELL = 0.02  # chosen: cell of the shadow grid, in withers' heights
SUN_GAIN = 2.2  # chosen: as the trees
SKY_GAIN = 0.95  # chosen

# Linear colours of the summer coat of Cervus elaphus, chosen by eye.
COAT = (0.148, 0.068, 0.029)
MANE = (0.058, 0.034, 0.022)
LEG = (0.100, 0.058, 0.034)
PALE = (0.33, 0.235, 0.145)
TAIL = (0.160, 0.082, 0.038)
RUMP = (0.46, 0.34, 0.19)
STRIPE = (0.110, 0.058, 0.030)
FACE = (0.130, 0.074, 0.042)
DARK = (0.018, 0.015, 0.013)
HOOF = (0.028, 0.024, 0.021)
HORN = (0.125, 0.085, 0.052)
IVORY = (0.50, 0.43, 0.32)
EYE = (0.010, 0.007, 0.005)

Point = tuple[float, float, float]
Joint = tuple[float, float, float, float]  # a place and the radius there


class Skin(NamedTuple):
    """What covers a chain: linear colour, blend with the rest (a length), flatness across the
    animal (1 is round), and the length of its hair (0 to 1)."""

    colour: tuple[float, float, float]
    blend: float
    flat: float = 1.0
    hair: float = 1.0


SHANK = Skin(LEG, 0.02)
HOOVES = Skin(HOOF, 0.006, hair=0.0)
SKULL = Skin(FACE, 0.03, hair=0.7)
ANTLER = Skin(HORN, 0.003, hair=0.0)

# Chosen: the antler of a twelve-pointer. x forward is negative, y up, z out from the middle; in
# front of each tine stands its radius.
BEAM = (
    (0, 0, 0.035),
    (0.045, 0.11, 0.10),
    (0.115, 0.25, 0.19),
    (0.135, 0.37, 0.24),
    (0.09, 0.48, 0.25),
)
TINES = (
    (0.018, (0.01, 0.03, 0.045), (-0.08, 0.055, 0.08), (-0.15, 0.12, 0.09), (-0.165, 0.21, 0.075)),
    (
        0.0135,
        (0.035, 0.09, 0.085),
        (-0.035, 0.13, 0.13),
        (-0.085, 0.2, 0.15),
        (-0.095, 0.25, 0.145),
    ),
    (0.016, (0.115, 0.25, 0.19), (0.05, 0.28, 0.24), (-0.005, 0.35, 0.255), (-0.015, 0.41, 0.25)),
    (0.0155, (0.095, 0.465, 0.25), (0.03, 0.53, 0.24), (0, 0.58, 0.22), (-0.005, 0.62, 0.20)),
    (0.016, (0.09, 0.47, 0.25), (0.10, 0.55, 0.265), (0.085, 0.65, 0.26)),
    (0.0145, (0.13, 0.40, 0.245), (0.19, 0.47, 0.29), (0.215, 0.53, 0.305), (0.215, 0.58, 0.305)),
)


@dataclass
class Model:
    """Round cones, rows of: a (3), its radius, b (3), its radius, blend, flatness, hair, chain."""

    cones: list[list[float]] = field(default_factory=list)
    colours: list[tuple[float, float, float]] = field(default_factory=list)
    chains: int = 0
    stretch: float = 0.90  # chosen: the length of the body against the height of the withers

    def limb(
        self, skin: Skin, *joints: Joint, last: tuple[float, float, float] | None = None
    ) -> None:
        """Add a chain of cones through the joints; the hair lies from the first to the last.
        ``last`` is the colour of the last cone, where it differs."""
        self.chains += 1
        path = [(x * self.stretch, y, z, r) for x, y, z, r in joints]
        for a, b in zip(path, path[1:], strict=False):
            self.cones.append([*a, *b, skin.blend, skin.flat, skin.hair, self.chains])
            self.colours.append(skin.colour)
        self.colours[-1] = last or skin.colour

    def ball(self, skin: Skin, at: Point, radius: float) -> None:
        """Add a ball: a chain of one short cone."""
        x, y, z = at
        self.limb(skin, (x, y, z, radius), (x + 1e-3, y - 5e-4, z, radius))


@njit
def round_cone(cone, x, y, z):  # type: ignore[no-untyped-def]
    """Distance from a point to one round cone; ``flat`` under 1 narrows it across the animal."""
    flat = cone[9]
    bx, by, bz = cone[4] - cone[0], cone[5] - cone[1], cone[6] - cone[2]
    # Flattening is about the cone's own axis, so that paired limbs keep their place.
    px, py = x - cone[0], y - cone[1]
    r1, r2 = cone[3], cone[7]
    l2 = bx * bx + by * by + bz * bz
    pz = z - cone[2]
    t = (px * bx + py * by + pz * bz) / l2
    t = min(1.0, max(0.0, t))
    pz = t * bz + (pz - t * bz) / flat
    rr = r1 - r2
    a2 = l2 - rr * rr
    il2 = 1.0 / l2
    yy = px * bx + py * by + pz * bz
    zz = yy - l2
    ex, ey, ez = px * l2 - bx * yy, py * l2 - by * yy, pz * l2 - bz * yy
    x2 = ex * ex + ey * ey + ez * ez
    y2 = yy * yy * l2
    z2 = zz * zz * l2
    k = np.sign(rr) * rr * rr * x2
    if np.sign(zz) * a2 * z2 > k:
        d = np.sqrt(x2 + z2) * il2 - r2
    elif np.sign(yy) * a2 * y2 < k:
        d = np.sqrt(x2 + y2) * il2 - r1
    else:
        d = (np.sqrt(x2 * a2 * il2) + yy * rr) * il2 - r1
    return d


@njit
def smooth_union(d, e, k):  # type: ignore[no-untyped-def]
    """Quilez's polynomial minimum of two distances, rounded over the length ``k``."""
    h = min(1.0, max(0.0, 0.5 + 0.5 * (d - e) / k))
    return d + (e - d) * h - k * h * (1.0 - h)


@njit
def distance(cones, chosen, count, x, y, z):  # type: ignore[no-untyped-def]
    """Smooth union of the cones ``chosen[:count]`` at a point, cut by the ground.

    The union swells where two cones overlap, so those of one chain, which share their ends, are
    joined more sharply than chains are to each other: else every joint would be a knob.
    """
    d, chain_d, chain, chain_k = 1e3, 1e3, -1.0, 1.0
    for i in range(count):
        cone = cones[chosen[i]]
        e = round_cone(cone, x, y, z)
        if cone[11] != chain:
            d = smooth_union(d, chain_d, chain_k)
            chain_d, chain, chain_k = e, cone[11], cone[8]
        else:
            chain_d = smooth_union(chain_d, e, CHAIN_BLEND * chain_k)
    return max(smooth_union(d, chain_d, chain_k), -y)


@njit
def bake(cones, low, shape, cell):  # type: ignore[no-untyped-def]
    """Distances on a grid of ``shape`` from the corner ``low``."""
    everything = np.arange(cones.shape[0])
    grid = np.empty(shape, np.float32)
    for i in range(shape[0]):
        for j in range(shape[1]):
            for k in range(shape[2]):
                grid[i, j, k] = distance(
                    cones,
                    everything,
                    cones.shape[0],
                    low[0] + i * cell,
                    low[1] + j * cell,
                    low[2] + k * cell,
                )
    return grid


@njit
def sample(grid, low, cell, x, y, z):  # type: ignore[no-untyped-def]
    """Trilinear lookup; outside the grid there is nothing."""
    fx, fy, fz = (x - low[0]) / cell, (y - low[1]) / cell, (z - low[2]) / cell
    i, j, k = int(np.floor(fx)), int(np.floor(fy)), int(np.floor(fz))
    n, m, o = grid.shape
    if i < 0 or j < 0 or k < 0 or i >= n - 1 or j >= m - 1 or k >= o - 1:
        return 1.0
    u, v, w = fx - i, fy - j, fz - k
    total = 0.0
    for di in range(2):
        for dj in range(2):
            for dk in range(2):
                weight = (u if di else 1 - u) * (v if dj else 1 - v) * (w if dk else 1 - w)
                total += weight * grid[i + di, j + dj, k + dk]
    return total


@njit
def trace(cones, colours, side, left, top, pixel, grid, low, cell, sun):  # type: ignore[no-untyped-def]
    """Trace an orthographic picture (side, side) that looks along -z.

    Returns per sample: hit (1 or 0), position, normal, colour, hair direction on the screen and
    length, and the open parts of the sun and of the sky: (side, side, 15).
    """
    out = np.zeros((side, side, 15), np.float32)
    chosen = np.empty(cones.shape[0], np.int64)
    for tile_row in range(0, side, TILE):
        for tile_column in range(0, side, TILE):
            cx = left + (tile_column + TILE / 2) * pixel
            cy = top - (tile_row + TILE / 2) * pixel
            reach = TILE * pixel * 0.75
            count = 0
            nearest = -1.0
            for i in range(cones.shape[0]):
                bx, by = cones[i, 4] - cones[i, 0], cones[i, 5] - cones[i, 1]
                t = ((cx - cones[i, 0]) * bx + (cy - cones[i, 1]) * by) / (bx * bx + by * by + 1e-9)
                t = min(1.0, max(0.0, t))
                gap = np.hypot(cx - cones[i, 0] - t * bx, cy - cones[i, 1] - t * by)
                if gap < reach + max(cones[i, 3], cones[i, 7]) + 1.3 * cones[i, 8] + 0.03:
                    chosen[count] = i
                    count += 1
                    front = max(cones[i, 2] + cones[i, 3], cones[i, 6] + cones[i, 7])
                    nearest = max(nearest, front + cones[i, 8])
            if count == 0:
                continue
            for row in range(tile_row, tile_row + TILE):
                for column in range(tile_column, tile_column + TILE):
                    x = left + (column + 0.5) * pixel
                    y = top - (row + 0.5) * pixel
                    z = nearest
                    hit = False
                    for _ in range(90):
                        d = distance(cones, chosen, count, x, y, z)
                        if d < 4e-4:
                            hit = True
                            break
                        z -= 0.75 * d
                        if z < -0.75:
                            break
                    if not hit:
                        continue
                    e = 1.5e-3
                    nx = distance(cones, chosen, count, x + e, y, z) - distance(
                        cones, chosen, count, x - e, y, z
                    )
                    ny = distance(cones, chosen, count, x, y + e, z) - distance(
                        cones, chosen, count, x, y - e, z
                    )
                    nz = distance(cones, chosen, count, x, y, z + e) - distance(
                        cones, chosen, count, x, y, z - e
                    )
                    norm = np.sqrt(nx * nx + ny * ny + nz * nz) + 1e-12
                    nx, ny, nz = nx / norm, ny / norm, nz / norm
                    total = 0.0
                    for c in range(count):
                        cone = cones[chosen[c]]
                        away = max(0.0, round_cone(cone, x, y, z))
                        # Sharp cones (eye, nose, hooves) keep their colour to themselves.
                        spread = 0.35 * cone[8] + 0.004
                        weight = np.exp(-((away / spread) ** 2))
                        if cone[10] == 0.0:
                            weight *= 40.0
                        total += weight
                        ax, ay, az = cone[4] - cone[0], cone[5] - cone[1], cone[6] - cone[2]
                        size = np.sqrt(ax * ax + ay * ay + az * az)
                        out[row, column, 10] += weight * ax / size * cone[10]
                        out[row, column, 11] += weight * ay / size * cone[10]
                        out[row, column, 12] += weight * cone[10]
                        for k in range(3):
                            out[row, column, 7 + k] += weight * colours[chosen[c], k]
                    for k in range(7, 13):
                        out[row, column, k] /= total + 1e-12
                    lit, t = 1.0, 0.03
                    for _ in range(40):
                        d = sample(
                            grid,
                            low,
                            cell,
                            x + nx * 0.02 + sun[0] * t,
                            y + ny * 0.02 + sun[1] * t,
                            z + nz * 0.02 + sun[2] * t,
                        )
                        lit = min(lit, 0.5 + 0.5 * d / (0.10 * t + 0.006))
                        if lit <= 0.0 or t > 1.2:
                            break
                        t += max(0.012, 0.8 * d)
                    lit = max(0.0, lit)
                    lit = lit * lit * (3 - 2 * lit)
                    closed = 0.0
                    for s in range(1, 7):
                        far = 0.035 * s
                        d = sample(
                            grid, low, cell, x + nx * far, y + (ny + 0.15) * far, z + nz * far
                        )
                        closed += max(0.0, far - d) * 0.72**s
                    out[row, column, 0] = 1.0
                    out[row, column, 1], out[row, column, 2], out[row, column, 3] = x, y, z
                    out[row, column, 4], out[row, column, 5], out[row, column, 6] = nx, ny, nz
                    out[row, column, 13] = lit
                    out[row, column, 14] = max(0.10, 1.0 - 6.5 * closed)
    return out


@njit
def comb(noise, along, steps):  # type: ignore[no-untyped-def]
    """Line integral convolution of noise (h, w) along screen directions (h, w, 2)."""
    h, w = noise.shape
    out = np.zeros((h, w))
    for row in range(h):
        for column in range(w):
            if along[row, column, 0] == 0.0 and along[row, column, 1] == 0.0:
                continue
            total = 0.0
            for sign in (-1.0, 1.0):
                x, y = column + 0.5, row + 0.5
                for _ in range(steps):
                    i, j = int(y), int(x)
                    if i < 0 or j < 0 or i >= h or j >= w:
                        break
                    total += noise[i, j]
                    x += sign * along[i, j, 0]
                    y += sign * along[i, j, 1]
            out[row, column] = total / np.sqrt(2.0 * steps)
    return out


def legs(model: Model, spread: float, fore: float, hind: float) -> None:
    """The four legs: shoulder or thigh, joints, cannon bone, pastern and cloven hoof. The far ones
    stand ``fore`` and ``hind`` further back than the near ones."""
    for side, shift, back in ((1.0, 0.0, 0.0), (-1.0, fore, hind)):
        z = side * spread
        fx = -0.35 + shift
        model.limb(
            Skin(COAT, 0.04, 0.75),
            (-0.30 + 0.3 * shift, 0.81, 0.8 * z, 0.125),
            (-0.365 + 0.5 * shift, 0.67, z, 0.100),
            (fx + 0.050, 0.545, z, 0.056),
            (fx + 0.022, 0.44, z, 0.040),
            (fx, 0.335, z, 0.031),
            last=LEG,
        )
        model.ball(Skin(LEG, 0.025), (fx - 0.006, 0.325, z), 0.033)
        cannon = ((fx + 0.004, 0.22, z, 0.0195), (fx + 0.002, 0.115, z, 0.0215))
        model.limb(SHANK, (fx, 0.33, z, 0.028), *cannon)
        model.ball(SHANK, (fx + 0.008, 0.100, z), 0.025)
        model.limb(SHANK, (fx, 0.098, z, 0.021), (fx - 0.032, 0.050, z, 0.022))
        hoof(model, fx - 0.036, z)
        hx = 0.52 + back
        top = 0.35 * back
        model.limb(
            Skin(COAT, 0.045, 0.7),
            (0.40 + top, 0.83, 0.75 * z, 0.150),
            (0.375 + top, 0.68, z, 0.128),
            (0.40 + top, 0.56, z, 0.082),
            (hx - 0.045, 0.46, z, 0.050),
            (hx + 0.025, 0.385, z, 0.034),
            last=LEG,
        )
        model.limb(
            Skin(COAT, 0.045, 0.8),
            (0.50 + top, 0.74, 0.8 * z, 0.10),
            (0.49 + 0.6 * back, 0.57, z, 0.042),
            (hx + 0.048, 0.40, z, 0.019),
        )
        model.limb(
            Skin(LEG, 0.022),
            (hx + 0.036, 0.392, z, 0.034),
            (hx + 0.030, 0.30, z, 0.0265),
            (hx + 0.008, 0.205, z, 0.0205),
            (hx - 0.014, 0.115, z, 0.0225),
        )
        model.ball(SHANK, (hx - 0.012, 0.100, z), 0.026)
        model.limb(SHANK, (hx - 0.018, 0.098, z, 0.022), (hx - 0.052, 0.050, z, 0.022))
        hoof(model, hx - 0.056, z)


def hoof(model: Model, x: float, z: float) -> None:
    """Two toes side by side, and the dew claws behind."""
    for toe in (z - 0.014, z + 0.014):
        splay = z + 1.3 * (toe - z)
        model.limb(HOOVES, (x, 0.046, toe, 0.019), (x - 0.026, 0.006, splay, 0.018))
        model.limb(HOOVES, (x + 0.004, 0.03, toe, 0.020), (x + 0.004, 0.004, toe, 0.021))
    model.ball(HOOVES, (x + 0.050, 0.075, z + 0.008), 0.012)


def trunk(model: Model, girth: float) -> None:
    """Rib cage, back, rump, brisket and tail; ``girth`` scales the chest."""
    model.limb(
        Skin(COAT, 0.07, 0.82),
        (-0.36, 0.785, 0, 0.190 * girth),
        (-0.20, 0.762, 0, 0.205 * girth),
        (0.06, 0.768, 0, 0.188 * girth),
        (0.28, 0.805, 0, 0.150),
        (0.44, 0.82, 0, 0.150),
    )
    model.limb(
        Skin(COAT, 0.07, 0.8),
        (-0.40, 0.86, 0, 0.12),
        (-0.27, 0.885, 0, 0.118),
        (-0.05, 0.865, 0, 0.105),
        (0.25, 0.865, 0, 0.11),
        (0.44, 0.865, 0, 0.125),
    )
    model.limb(Skin(COAT, 0.06), (0.44, 0.865, 0, 0.125), (0.555, 0.80, 0, 0.095))
    brisket = ((-0.47, 0.80, 0, 0.135), (-0.45, 0.70, 0, 0.12), (-0.33, 0.60, 0, 0.07))
    model.limb(Skin(COAT, 0.07, 0.8), *brisket)
    tail = ((0.61, 0.875, 0, 0.034), (0.668, 0.815, 0, 0.032), (0.690, 0.705, 0, 0.013))
    model.limb(Skin(TAIL, 0.02, hair=0.9), *tail)


def head(
    model: Model, origin: Point, nod: float, yaw: float, ear: tuple[float, float]
) -> Callable[[float, float, float], Point]:
    """The head with its poll at ``origin``, turned down by ``nod`` and towards the viewer by
    ``yaw`` radians, ears reaching by ``ear``; returns the map from its frame to the model's."""
    c, s = np.cos(nod), np.sin(nod)
    model.stretch = 1.0

    def at(x: float, y: float, z: float) -> Point:
        # The head's frame: -x along the face to the nose, y up from it.
        forward, up = c * x - s * y, s * x + c * y
        return (
            float(origin[0] + np.cos(yaw) * forward + np.sin(yaw) * z),
            float(origin[1] + up),
            float(origin[2] - np.sin(yaw) * forward + np.cos(yaw) * z),
        )

    def bone(skin: Skin, *joints: Joint) -> None:
        model.limb(skin, *((*at(x, y, z), r) for x, y, z, r in joints))

    crown = ((-0.08, -0.028, 0, 0.070), (0.0, -0.045, 0, 0.080))
    bone(Skin(FACE, 0.04, 0.8, 0.7), (-0.33, -0.010, 0, 0.040), (-0.20, -0.012, 0, 0.047), *crown)
    jaw = ((-0.305, -0.048, 0, 0.024), (-0.17, -0.075, 0, 0.035), (-0.05, -0.105, 0, 0.055))
    bone(Skin(FACE, 0.035, 0.75, 0.7), *jaw)
    for side in (1.0, -1.0):
        model.ball(SKULL, at(-0.11, 0.012, side * 0.036), 0.034)
    bone(Skin(DARK, 0.012, hair=0.0), (-0.352, 0.002, 0, 0.0235), (-0.348, -0.022, 0, 0.020))
    bone(Skin(PALE, 0.014), (-0.33, -0.054, 0, 0.016), (-0.30, -0.06, 0, 0.018))
    bx, by = ear
    for side in (1.0, -1.0):
        model.ball(Skin(EYE, 0.003, hair=0.0), at(-0.123, 0.004, side * 0.060), 0.0140)
        tip = (0.012 + bx, by, side * 0.150)
        shell = [(0.012, 0.0, side * 0.055), (0.012 + 0.4 * bx, 0.4 * by, side * 0.105), tip]
        radii = [0.020, 0.031, 0.037, 0.037, 0.031, 0.019, 0.005]
        bone(Skin(FACE, 0.006, 0.8, 0.7), *smooth(shell, radii))
        inner = [
            (-0.012 + 0.2 * bx, 0.3 * by + 0.002, side * 0.088),
            (-0.010 + 0.45 * bx, 0.5 * by, side * 0.120),
            (0.8 * bx, 0.85 * by, side * 0.145),
        ]
        bone(Skin(PALE, 0.006, hair=0.7), *smooth(inner, [0.012, 0.022, 0.018, 0.006]))
    return at


def antlers(model: Model, at: Callable[[float, float, float], Point]) -> None:
    """Two beams, each with brow, bez and trez tines and a crown of three."""
    for side in (1.0, -1.0):

        def place(point: Point, side: float = side) -> Point:
            # Out along the head's own sides, but upright whatever the nod.
            foot, out = at(-0.02, 0.03, 0.0), at(-0.02, 0.03, side * point[2])
            return (out[0] + point[0], foot[1] + point[1], out[2])

        beam = smooth([place(point) for point in BEAM], np.linspace(0.0275, 0.0185, 11))
        model.limb(ANTLER, *beam)
        model.ball(Skin(HORN, 0.012, hair=0.0), place((0, 0.010, 0.037)), 0.034)
        for width, *points in TINES:
            tine = smooth([place(point) for point in points], width * np.linspace(1.0, 0.30, 7))
            model.limb(ANTLER, *tine, last=IVORY)


def smooth(path: list[Point], radii: Sequence[float] | np.ndarray) -> list[Joint]:
    """Joints with the given radii, evenly along a spline through ``path``."""
    spline = CubicSpline(np.linspace(0, 1, len(path)), np.array(path))
    points = spline(np.linspace(0, 1, len(radii)))
    return [
        (float(x), float(y), float(z), float(r)) for (x, y, z), r in zip(points, radii, strict=True)
    ]


@njit
def fringe(colour, covered, starts, ways, lengths, tints):  # type: ignore[no-untyped-def]
    """Draw hairs (n, 2) long ``lengths`` along screen directions, in the colour of their roots."""
    h, w = covered.shape
    for i in range(starts.shape[0]):
        row, column = starts[i]
        y, x = row + 0.5, column + 0.5
        wx, wy = ways[i]
        for k in range(lengths[i]):
            part = k / lengths[i]
            for side in range(2 if part < 0.6 else 1):
                r, c = int(y - side * wx), int(x + side * wy)
                if r < 0 or c < 0 or r >= h or c >= w:
                    continue
                covered[r, c] = 1.0
                for j in range(3):
                    colour[r, c, j] = colour[row, column, j] * (1.0 + (tints[i] - 1.0) * part)
            wy += 0.02
            x += wx
            y += wy


@dataclass
class Traced:
    """What :func:`trace` found, one value per sample; arrays (side, side) or (side, side, k)."""

    hit: np.ndarray
    x: np.ndarray
    y: np.ndarray
    normal: np.ndarray
    albedo: np.ndarray
    along: np.ndarray  # direction of the hair on the screen, unit or 0
    hair: np.ndarray
    sun: np.ndarray  # parts of the sun and of the sky that are open
    sky: np.ndarray


def look_at(model: Model) -> Traced:
    """Trace a model so that it fills the square, its hooves on the last row."""
    cones = np.array(model.cones)
    ends = np.concatenate([cones[:, 0:4], cones[:, 4:8]])
    left, right = (ends[:, 0] - ends[:, 3]).min(), (ends[:, 0] + ends[:, 3]).max()
    height = (ends[:, 1] + ends[:, 3]).max()
    span = max(height / 0.965, (right - left) / 0.95)
    left = (left + right - span) / 2
    low = np.array([left, -0.1, -0.5])
    shape = tuple(int(np.ceil(s / CELL)) for s in (span, height + 0.2, 1.0))
    grid = bake(cones, low, shape, CELL)
    side = SIZE * SUPERSAMPLING
    colours = np.array(model.colours)
    out = trace(cones, colours, side, left, span, span / side, grid, low, CELL, SPRITE_SUN)
    hit = out[..., 0] > 0
    along = np.stack([out[..., 10], 0.25 - out[..., 11]], -1)  # hair also hangs
    along *= hit[..., None] / (np.linalg.norm(along, axis=-1, keepdims=True) + 1e-9)
    return Traced(
        hit,
        out[..., 1],
        out[..., 2],
        out[..., 4:7],
        out[..., 7:10],
        along,
        out[..., 12],
        out[..., 13],
        out[..., 14],
    )


def paint_coat(seen: Traced, mane: float) -> np.ndarray:
    """Paint the coat's markings where they lie on every red deer; ``mane`` (0 to 1) is the depth
    of the neck's colour. Returns where the hair is long (side, side)."""
    x, y, up = seen.x, seen.y, seen.normal[..., 1]

    def paint(colour: tuple[float, float, float], amount: np.ndarray) -> None:
        weight = (amount * (seen.hair > 0.5))[..., None]
        seen.albedo += (np.array(colour) - seen.albedo) * weight

    body = smoothstep(-0.52, -0.38, x) * smoothstep(0.50, 0.56, y)
    belly = smoothstep(0.25, 0.85, -up) * body
    back = smoothstep(0.75, 0.98, up) * body * smoothstep(0.9, 0.97, y)
    off_rump = np.hypot((x - 0.60) * 1.2, (y - 0.79) * 0.85)
    rump = smoothstep(0.19, 0.10, off_rump) * smoothstep(0.92, 0.98, seen.hair)  # not the tail
    thigh = smoothstep(0.57, 1.02, x) * smoothstep(0.68, 0.60, y) * smoothstep(0.45, 0.55, y)
    throat = smoothstep(0.05, 0.7, -up) * smoothstep(0.84, 0.92, y) * smoothstep(-0.40, -0.46, x)
    ruff = smoothstep(-0.20, -0.37, x) * smoothstep(0.62, 0.74, y) * smoothstep(1.36, 1.22, y)
    paint(PALE, 0.75 * belly)
    paint(STRIPE, 0.6 * back)
    paint(RUMP, rump)
    paint(PALE, 0.55 * thigh)
    paint(PALE, (0.6 - 0.36 * mane) * throat)
    paint(MANE, mane * ruff)
    return mane * ruff


def grow_fur(seen: Traced, long_hair: np.ndarray, rng: np.random.Generator) -> None:
    """Vary the colour and the normals by combed noise: hairs, locks, and larger patches."""

    def noise(blur: float) -> np.ndarray:
        return ndimage.gaussian_filter(rng.standard_normal(seen.hit.shape), blur)

    fine, locks, patches = (
        comb(noise(0.8), seen.along, 9),
        comb(noise(2.5), seen.along, 24),
        noise(22),
    )
    fur = fine / fine[seen.hit].std() + (0.4 + long_hair) * 0.8 * locks / locks[seen.hit].std()
    fur *= seen.hair
    gy, gx = np.gradient(ndimage.gaussian_filter(fur, 0.8))
    seen.normal += 0.30 * np.stack([-gx, gy, np.zeros_like(gx)], -1)
    seen.normal /= np.linalg.norm(seen.normal, axis=-1, keepdims=True) + 1e-9
    tone = 0.13 * fur + 0.07 * patches / patches.std() * seen.hair
    seen.albedo *= np.clip(1.0 + tone, 0.3, 2.0)[..., None]


def shade(seen: Traced) -> np.ndarray:
    """Light the samples: sun, sky, ground, and the gloss of eyes, nose, hooves and horn."""
    up, front = seen.normal[..., 1], np.clip(seen.normal[..., 2], 0, 1)
    sun = np.clip((seen.normal @ SPRITE_SUN + 0.12) / 1.12, 0, 1) * seen.sun
    sky = (0.55 + 0.45 * up) * seen.sky
    ground = (0.5 - 0.5 * up) * seen.sky
    half = SPRITE_SUN + np.array([0.0, 0.0, 1.0])
    gloss = np.maximum(seen.normal @ (half / np.linalg.norm(half)), 0)
    bare = 1.0 - smoothstep(0.2, 0.6, seen.hair)
    shine = (0.05 * gloss**12 + 0.6 * bare * gloss**50) * seen.sun
    # Hair lets light through at the outline.
    shine += 0.10 * (1 - front) ** 3 * seen.hair * np.clip(0.3 + up, 0, 1) * seen.sky
    light = (
        SUN_GAIN * SUN_COLOR * sun[..., None]
        + SKY_GAIN * SKY_COLOR * sky[..., None]
        + 1.3 * GROUND_BOUNCE * ground[..., None]
    )
    return seen.albedo * light + SUN_COLOR * shine[..., None]


def render(model: Model, seed: int, mane: float) -> np.ndarray:
    """Trace, paint, comb and light a model; returns the sprite (512, 512, 4)."""
    rng = np.random.default_rng(seed)
    seen = look_at(model)
    long_hair = paint_coat(seen, mane)
    grow_fur(seen, long_hair, rng)
    colour, covered = shade(seen), seen.hit.astype(float)
    # Single hairs over the outline, and over the mane: fur has no sharp edge.
    edge = seen.hit & (ndimage.distance_transform_edt(seen.hit) < 5) & (seen.hair > 0.6)
    chance = np.maximum(0.25 * edge, 0.05 * long_hair)
    roots = np.nonzero(rng.random(chance.shape) < chance)
    ways = seen.along[roots] + 0.30 * seen.normal[roots][:, :2] * np.array([1.0, -1.0])
    ways += 0.15 * rng.standard_normal(ways.shape)
    ways /= np.linalg.norm(ways, axis=1, keepdims=True) + 1e-9
    shaggy = smoothstep(0.75, 1.0, seen.hair[roots]) * smoothstep(0.45, 0.7, seen.y[roots])
    reach = 2.0 + 4.0 * shaggy + 13.0 * long_hair[roots]
    lengths = (reach * rng.uniform(0.5, 1.2, len(reach))).astype(np.int64)
    tints = rng.uniform(0.75, 1.35, len(reach))
    fringe(colour, covered, np.stack(roots, 1), ways, lengths, tints)
    premultiplied = np.concatenate([colour * covered[..., None], covered[..., None]], -1)
    return sprite(shrink(premultiplied, SUPERSAMPLING))


@functools.cache
def stag() -> np.ndarray:
    """A stag on the look-out, head high, twelve points."""
    model = Model()
    trunk(model, 1.03)
    legs(model, 0.115, 0.075, -0.12)
    model.limb(
        Skin(COAT, 0.06, 0.80),
        (-0.645, 1.325, 0, 0.082),
        (-0.60, 1.17, 0, 0.112),
        (-0.52, 1.00, 0, 0.150),
        (-0.36, 0.84, 0, 0.19),
    )
    model.limb(
        Skin(MANE, 0.06, 0.75),
        (-0.62, 1.22, 0, 0.075),
        (-0.60, 1.05, 0, 0.10),
        (-0.53, 0.88, 0, 0.12),
        (-0.44, 0.74, 0, 0.12),
    )
    antlers(model, head(model, (-0.59, 1.40, 0.0), 0.40, 0.42, (0.11, 0.02)))
    return render(model, 3, 0.8)


@functools.cache
def doe() -> np.ndarray:
    """A doe with her neck stretched forward, listening."""
    model = Model(stretch=0.86)
    trunk(model, 0.90)
    legs(model, 0.10, -0.09, 0.09)
    model.limb(
        Skin(COAT, 0.06, 0.75),
        (-0.755, 1.20, 0, 0.062),
        (-0.70, 1.09, 0, 0.072),
        (-0.60, 0.97, 0, 0.098),
        (-0.42, 0.86, 0, 0.150),
    )
    head(model, (-0.655, 1.265, 0.0), 0.46, 0.34, (0.05, 0.125))
    return render(model, 4, 0.0)


ASSETS: dict[str, Callable[[], np.ndarray]] = {"deer_stag.png": stag, "deer_doe.png": doe}
