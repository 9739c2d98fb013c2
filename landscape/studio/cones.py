"""Bodies made of round cones, and the sphere tracer that renders them.

A body is a signed distance field of round cones (Quilez, "Distance functions"): one chain per
muscle, bone or tine, joined by the polynomial smooth union. It is sphere traced (Hart 1996). A
coarse grid of the same distances is used for soft shadows and ambient occlusion.

Model space: x right, y up, z towards the viewer.
"""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numba import njit

TILE = 16  # chosen: side of a screen tile in samples; each tile has its own list of cones
CHAIN_BLEND = 0.3  # chosen: blend inside a chain, as a fraction of its blend with the rest
CELL = 0.02  # chosen: cell size of the shadow grid; unit: height of the withers
Point = tuple[float, float, float]
Joint = tuple[float, float, float, float]  # position and radius


class Skin(NamedTuple):
    """Properties of a chain: linear colour, blend length with other chains, z scale of the cross
    section (1 is round), and length of the hair (0 to 1)."""

    colour: tuple[float, float, float]
    blend: float
    flat: float = 1.0
    hair: float = 1.0


@dataclass
class Model:
    """Round cones: rows of a (3), radius at a, b (3), radius at b, blend, flatness, hair, chain."""

    cones: list[list[float]] = field(default_factory=list)
    colours: list[tuple[float, float, float]] = field(default_factory=list)
    chains: int = 0
    stretch: float = 0.90  # chosen: scale of the body along x

    def limb(
        self, skin: Skin, *joints: Joint, last: tuple[float, float, float] | None = None
    ) -> None:
        """Add a chain of cones through the joints; hair points from the first to the last.

        ``last`` is the colour of the last cone, if it differs.
        """
        self.chains += 1
        path = [(x * self.stretch, y, z, r) for x, y, z, r in joints]
        for a, b in zip(path, path[1:], strict=False):
            self.cones.append([*a, *b, skin.blend, skin.flat, skin.hair, self.chains])
            self.colours.append(skin.colour)
        self.colours[-1] = last or skin.colour

    def ball(self, skin: Skin, at: Point, radius: float) -> None:
        """Add a ball as a chain of one very short cone."""
        x, y, z = at
        self.limb(skin, (x, y, z, radius), (x + 1e-3, y - 5e-4, z, radius))


@njit
def round_cone(cone, x, y, z):  # type: ignore[no-untyped-def]
    """Return the distance to one round cone; a flatness under 1 narrows it along z."""
    flat = cone[9]
    bx = cone[4] - cone[0]
    by = cone[5] - cone[1]
    bz = cone[6] - cone[2]

    # Flatten about the cone's own axis, so that left and right limbs stay in place.
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
    ex = px * l2 - bx * yy
    ey = py * l2 - by * yy
    ez = pz * l2 - bz * yy
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
    """Return Quilez's polynomial smooth minimum of two distances with blend length ``k``."""
    h = min(1.0, max(0.0, 0.5 + 0.5 * (d - e) / k))
    return d + (e - d) * h - k * h * (1.0 - h)


@njit
def distance(cones, selected, count, x, y, z):  # type: ignore[no-untyped-def]
    """Return the smooth union of the cones ``selected[:count]`` at a point, cut by the ground.

    A smooth union bulges where two cones overlap. Cones of one chain share their ends, so they are
    joined more sharply than different chains; otherwise every joint would be a knob.
    """
    d = 1e3
    chain_d = 1e3
    chain = -1.0
    chain_k = 1.0
    for i in range(count):
        cone = cones[selected[i]]
        e = round_cone(cone, x, y, z)
        if cone[11] != chain:
            d = smooth_union(d, chain_d, chain_k)
            chain_d = e
            chain = cone[11]
            chain_k = cone[8]
        else:
            chain_d = smooth_union(chain_d, e, CHAIN_BLEND * chain_k)

    return max(smooth_union(d, chain_d, chain_k), -y)


@njit
def bake(cones, low, shape, cell):  # type: ignore[no-untyped-def]
    """Return the distances, float32, on a grid of ``shape`` with its corner at ``low``."""
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
    """Look up a grid trilinearly; outside it, return 1 (empty space)."""
    fx = (x - low[0]) / cell
    fy = (y - low[1]) / cell
    fz = (z - low[2]) / cell
    i = int(np.floor(fx))
    j = int(np.floor(fy))
    k = int(np.floor(fz))
    n, m, o = grid.shape
    if i < 0 or j < 0 or k < 0 or i >= n - 1 or j >= m - 1 or k >= o - 1:
        return 1.0
    u = fx - i
    v = fy - j
    w = fz - k
    total = 0.0
    for di in range(2):
        for dj in range(2):
            for dk in range(2):
                weight = (u if di else 1 - u) * (v if dj else 1 - v) * (w if dk else 1 - w)
                total += weight * grid[i + di, j + dj, k + dk]

    return total


@njit
def trace(cones, colours, side, left, top, pixel, grid, low, cell, sun):  # type: ignore[no-untyped-def]
    """Trace an orthographic view along -z; return (side, side, 15) float32.

    Per sample: hit (1 or 0), position (3), normal (3), colour (3), hair direction on the screen
    (2), hair length, and the visible fractions of the sun and of the sky.
    """
    out = np.zeros((side, side, 15), np.float32)
    selected = np.empty(cones.shape[0], np.int64)
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
                    selected[count] = i
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
                        d = distance(cones, selected, count, x, y, z)
                        if d < 4e-4:
                            hit = True
                            break
                        z -= 0.75 * d
                        if z < -0.75:
                            break
                    if not hit:
                        continue
                    e = 1.5e-3
                    nx = distance(cones, selected, count, x + e, y, z) - distance(
                        cones, selected, count, x - e, y, z
                    )
                    ny = distance(cones, selected, count, x, y + e, z) - distance(
                        cones, selected, count, x, y - e, z
                    )
                    nz = distance(cones, selected, count, x, y, z + e) - distance(
                        cones, selected, count, x, y, z - e
                    )
                    norm = np.sqrt(nx * nx + ny * ny + nz * nz) + 1e-12
                    nx = nx / norm
                    ny = ny / norm
                    nz = nz / norm
                    total = 0.0
                    for c in range(count):
                        cone = cones[selected[c]]
                        surface_distance = max(0.0, round_cone(cone, x, y, z))
                        # Hairless cones (eye, nose, hooves) do not blend with their neighbours.
                        spread = 0.35 * cone[8] + 0.004
                        weight = np.exp(-((surface_distance / spread) ** 2))
                        if cone[10] == 0.0:
                            weight *= 40.0
                        total += weight
                        ax = cone[4] - cone[0]
                        ay = cone[5] - cone[1]
                        az = cone[6] - cone[2]
                        size = np.sqrt(ax * ax + ay * ay + az * az)
                        out[row, column, 10] += weight * ax / size * cone[10]
                        out[row, column, 11] += weight * ay / size * cone[10]
                        out[row, column, 12] += weight * cone[10]
                        for k in range(3):
                            out[row, column, 7 + k] += weight * colours[selected[c], k]
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
                    occlusion = 0.0
                    for s in range(1, 7):
                        far = 0.035 * s
                        d = sample(
                            grid, low, cell, x + nx * far, y + (ny + 0.15) * far, z + nz * far
                        )
                        occlusion += max(0.0, far - d) * 0.72**s
                    out[row, column, 0] = 1.0
                    out[row, column, 1], out[row, column, 2], out[row, column, 3] = x, y, z
                    out[row, column, 4], out[row, column, 5], out[row, column, 6] = nx, ny, nz
                    out[row, column, 13] = lit
                    out[row, column, 14] = max(0.10, 1.0 - 6.5 * occlusion)

    return out
