"""A fern for the crossed quads, and the texture of a blade of grass.

The fern is a rosette of fronds. Each midrib is a curve that leans more towards its tip, like a leaf
that bends under its own weight. It carries two rows of pinnae, each a row of overlapping lobes.
:mod:`landscape.studio.plants.foliage` lights and draws them, in its sprite space: x right in -1..1,
y up in 0..2, z towards the viewer.
"""

from collections.abc import Callable

import numpy as np

from landscape.studio.images import smoothstep, spectral_noise, to_srgb, to_uint8
from landscape.studio.plants.foliage import (
    Canvas,
    Leaves,
    draw_leaves,
    draw_limbs,
    foliage_density,
    join,
    light_on_limbs,
    unit,
)

# Chosen: side (1 is right), turn from the side towards the viewer, lean at the foot and bend to the
# tip (all in radians), length, and length of the longest pinna. Ordered from back to front. No
# frond is upright in the middle, where it would reveal the crossing of the quads.
FRONDS = (
    (1, -0.6, 0.16, 1.90, 1.66, 0.20),
    (-1, -0.5, 0.18, 1.85, 1.62, 0.20),
    (-1, 0.3, 0.26, 1.90, 1.74, 0.20),
    (1, 0.4, 0.32, 1.80, 1.74, 0.20),
    (-1, -0.3, 0.52, 1.65, 1.56, 0.20),
    (1, -0.2, 0.60, 1.55, 1.54, 0.20),
    (-1, 0.2, 0.80, 1.40, 1.42, 0.19),
    (1, 0.1, 0.92, 1.25, 1.32, 0.18),
    (1, 0.9, 0.46, 1.60, 1.00, 0.17),
    (-1, 0.8, 0.64, 1.50, 0.96, 0.17),
    (-1, 0.3, 1.08, 0.95, 1.10, 0.17),
)
PITCH_RAD = 0.30  # chosen: the tuft is seen slightly from above, from the walker's height
EXTINCTION = 0.5  # chosen: the inside of the tuft is dark, the tips are light
STALK_ALBEDO = np.array([0.13, 0.14, 0.045])  # chosen: green-brown midribs
LOBES = np.array([0.20, 0.38, 0.56, 0.74])  # chosen: positions of the four kites along a pinna
BLADE_SIZE = 64


def midrib(length: float, lean: float, bend: float, azimuth: float, count: int) -> np.ndarray:
    """Return points (count, 3) along a midrib at lean + bend s**1.4 radians from the vertical."""
    s = np.linspace(0.0, 1.0, count)
    theta = lean + bend * s**1.4
    out = np.cumsum(np.sin(theta)) * length / count
    up = np.cumsum(np.cos(theta)) * length / count
    return np.stack([out * np.cos(azimuth), up, out * np.sin(azimuth)], 1)


def frond(path: np.ndarray, roll: float, size: float, rng: np.random.Generator) -> Leaves:
    """Return the kites of one frond along its midrib ``path`` (n, 3).

    ``roll`` (radians) rotates the plane of the frond about the midrib; ``size`` is the length of
    the longest pinna.
    """
    n = len(path)
    tangent = unit(np.gradient(path, axis=0))
    flat = unit(np.cross(tangent, np.array([0.0, 1.0, 0.0])) + 1e-6)
    over = np.cross(flat, tangent)
    span = flat * np.cos(roll) + over * np.sin(roll)
    face = np.cross(span, tangent)
    face *= np.where(face[:, 1:2] < 0, -1.0, 1.0)
    parts: list[Leaves] = []
    tone = rng.uniform(0.82, 1.15)
    gap = float(np.linalg.norm(path[-1] - path[-2]))
    for i in range(int(0.09 * n), n):
        s = i / (n - 1)
        reach = size * (np.sin(np.pi * min(1.0, s * 0.84 + 0.15)) ** 0.9) * (1.1 - 0.35 * s) + 0.012
        reach *= rng.uniform(0.9, 1.06)
        for side in (-1.0, 1.0):
            direction = unit(side * span[i] + tangent[i] * (0.22 + 0.75 * s * s) - 0.10 * face[i])
            # A pinna is a row of overlapping kites, so that it bends and has a toothed edge.
            t = LOBES
            k = len(t)
            root = path[i] + tangent[i] * (0.25 * side * gap)
            sag = np.outer(t, [0.0, 1.0, 0.0])
            spine = root + np.outer(t * reach, direction) - 0.20 * reach * t[:, None] * sag
            axis = unit(direction - 0.40 * sag + 0.05 * rng.standard_normal((k, 3)))
            normal = unit(
                face[i] + 0.16 * rng.standard_normal(3) + 0.05 * rng.standard_normal((k, 3))
            )
            length = np.full(k, 0.52 * reach)
            width = 1.15 * gap * np.minimum(1.0, 0.25 + reach / size) * (1.05 - 0.62 * t)
            green = np.array([0.058, 0.122, 0.028]) * (1 - s) + np.array([0.125, 0.190, 0.042]) * s
            albedo = green * tone * rng.uniform(0.84, 1.14) * (0.85 + 0.3 * t)[:, None]
            parts.append(Leaves(spine, axis, normal, length, width, albedo))

    return join(parts)


def tilt(points: np.ndarray) -> np.ndarray:
    """Rotate points (n, 3) by PITCH_RAD about the x axis, to show some of the upper side."""
    c, s = np.cos(PITCH_RAD), np.sin(PITCH_RAD)
    x, y, z = points.T
    return np.stack([x, c * y - s * z, s * y + c * z], 1)


def plant() -> np.ndarray:
    """Return a tuft of fern fronds that arch outward, about equally on both sides."""
    rng = np.random.default_rng(5)
    fronds, paths = [], []
    for side, turn, lean, bend, length, size in FRONDS:
        # Keep the fronds close to the picture plane: foreshortened ones look like blobs.
        azimuth = (turn if side > 0 else np.pi - turn) + rng.uniform(-0.05, 0.05)
        path = midrib(length * rng.uniform(0.96, 1.04), lean, bend, azimuth, 44)
        path[:, 2] *= 0.6
        # Fronds that lean left or right would be seen edge-on: roll them towards the viewer.
        roll = -side * rng.uniform(0.45, 0.75)
        fronds.append(frond(path, roll, size, rng))
        paths.append(path)

    leaves = join(fronds)
    leaves.centre, leaves.axis, leaves.normal = map(
        tilt, (leaves.centre, leaves.axis, leaves.normal)
    )

    # The base of the tuft is below the ground, so that it already spreads at the last row.
    leaves.centre[:, 1] -= 0.05
    paths = [tilt(p) - np.array([0.0, 0.05, 0.0]) for p in paths]
    low, high = leaves.centre.min(0), leaves.centre.max(0)
    sx = 0.95 / max(-low[0], high[0])
    sy = 1.9 / high[1]
    for points in (leaves.centre, *paths):
        points *= np.array([sx, sy, sx])
    density = foliage_density(leaves)
    canvas = Canvas.blank()
    ends = np.concatenate([np.stack([p[:-1], p[1:]], 1) for p in paths])
    taper = np.linspace(0.014, 0.003, len(paths[0]))
    radii = np.tile(np.stack([taper[:-1], taper[1:]], 1), (len(paths), 1))
    lights = light_on_limbs(density, ends, EXTINCTION)
    stalk = np.broadcast_to([*STALK_ALBEDO, 0.0], (4, 4, 4)).copy()
    flat = np.zeros_like(radii)
    draw_limbs(canvas, ends, radii, lights, stalk, STALK_ALBEDO, flat, flat[:, 0])
    draw_leaves(canvas, leaves, density, EXTINCTION)
    return canvas.finish()


def blade() -> np.ndarray:
    """Return the texture of a blade, uint8 (64, 64, 3): base in the last row, tip in the first."""
    v, u = (np.mgrid[0:BLADE_SIZE, 0:BLADE_SIZE] + 0.5) / BLADE_SIZE
    tip = (1.0 - v)[..., None]
    base_colour = np.array([0.068, 0.122, 0.022])
    middle_colour = np.array([0.105, 0.185, 0.030])
    tip_colour = np.array([0.300, 0.320, 0.070])
    colour = base_colour + (middle_colour - base_colour) * smoothstep(0.0, 0.55, tip)
    colour = colour + (tip_colour - colour) * smoothstep(0.45, 1.05, tip)
    return to_uint8(to_srgb(colour * _blade_shade(u)[..., None]))


def _blade_shade(u: np.ndarray) -> np.ndarray:
    """Return the brightness of a blade across its width 0..1: midrib, veins, fold and grain."""
    # The middle of the strip is at u = 0.5 everywhere, so the midrib is straight.
    across = u - 0.5
    rib = np.exp(-((across / 0.035) ** 2)) - 0.45 * np.exp(
        -(((np.abs(across) - 0.085) / 0.04) ** 2)
    )
    veins = 0.06 * np.cos(2 * np.pi * across * 13)
    fold = np.where(across < 0, 1.10, 0.88)
    streak = spectral_noise(BLADE_SIZE, 0.8, 7).mean(axis=0)[None, :] * 0.25
    grain = 0.05 * spectral_noise(BLADE_SIZE, 0.7, 8)
    return fold * (1.0 + 0.32 * rib + veins + streak + grain)


ASSETS: dict[str, Callable[[], np.ndarray]] = {"plant.png": plant, "blade.png": blade}
