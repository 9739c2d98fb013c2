"""Building blocks of the herb sprites: curved stems that bear kites, and a clump as a sprite.

A clump is a set of stems (:func:`landscape.studio.plants.plants.midrib`) with pinnules, leaves,
petals or bells as kites. :mod:`landscape.studio.plants.foliage` lights and draws them, in its
sprite space: x right in -1..1, y up in 0..2, z towards the viewer.
"""

import numpy as np

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
from landscape.studio.plants.plants import midrib

SIDE = 256  # texels; a clump is a third of the viewer's height and is seldom seen from very near
UP = np.array([0.0, 1.0, 0.0])
VIEWER = np.array([0.0, 0.0, 1.0])
DEPTH = 0.6  # chosen: scale of a clump along z; parts that point at the viewer look like blobs

Stems = list[tuple[np.ndarray, float, float, np.ndarray]]  # path, radius at foot and tip, colour


def stem(
    foot: np.ndarray, length: float, lean: float, bend: float, azimuth: float, count: int
) -> np.ndarray:
    """Return points (count, 3) along a curve from ``foot`` (3,); angles as for ``midrib``."""
    path = midrib(length, lean, bend, azimuth, count)
    path = np.concatenate([np.zeros((1, 3)), path[:-1]])
    path[:, 2] *= DEPTH
    return np.asarray(path + foot)


def along(path: np.ndarray, fractions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return points and unit tangents (n, 3) of a path (m, 3) at ``fractions`` (n,) in 0..1."""
    at = np.clip(fractions, 0.0, 1.0) * (len(path) - 1)
    slopes = np.gradient(path, axis=0)
    axes = range(3)
    points = np.stack([np.interp(at, np.arange(len(path)), path[:, k]) for k in axes], 1)
    tangents = np.stack([np.interp(at, np.arange(len(path)), slopes[:, k]) for k in axes], 1)
    return points, unit(tangents)


def kites(
    root: np.ndarray,
    axis: np.ndarray,
    normal: np.ndarray,
    length: np.ndarray | float,
    width: np.ndarray | float,
    albedo: np.ndarray,
) -> Leaves:
    """Return leaves that start at ``root`` (n, 3) and point along ``axis`` (n, 3)."""
    n = len(root)
    axis = unit(axis)
    lengths = np.broadcast_to(np.asarray(length, float), n).copy()
    widths = np.broadcast_to(np.asarray(width, float), n).copy()
    face = unit(normal - axis * (normal * axis).sum(1, keepdims=True))
    middle = root + axis * lengths[:, None] / 2
    return Leaves(middle, axis, face, lengths, widths, np.broadcast_to(albedo, (n, 3)).copy())


def whorl(axes: np.ndarray, angles: np.ndarray) -> np.ndarray:
    """Return unit vectors (n, 3) perpendicular to ``axes`` (n, 3), rotated by ``angles`` (n,)."""
    one = unit(np.cross(axes, VIEWER + 0.01))
    other = np.cross(axes, one)
    return np.asarray(one * np.cos(angles)[:, None] + other * np.sin(angles)[:, None])


def sprite_of(leaves: Leaves, stems: Stems, extinction: float, sunk: float = 0.04) -> np.ndarray:
    """Fit a clump into the sprite, light and draw it; return uint8 (SIDE, SIDE, 4).

    ``sunk`` is the depth of the root below the last row of the sprite.
    """
    everything = np.concatenate([leaves.centre, *(path for path, *_ in stems)])
    low, high = np.quantile(everything, [0.001, 0.999], axis=0)
    scale = np.array([0.93 / max(-low[0], high[0]), (1.86 + sunk) / high[1], 1.0])
    scale[2] = scale[0]
    stretched = leaves.axis * leaves.length[:, None] * scale
    leaves.length = np.linalg.norm(stretched, axis=1)
    leaves.axis = unit(stretched)
    leaves.width = leaves.width * np.sqrt(scale[0] * scale[1])
    leaves.centre = leaves.centre * scale - sunk * UP
    paths = [path * scale - sunk * UP for path, *_ in stems]
    occluders = leaves
    if stems:
        # Stems cast shadows too: add them to the density as kites.
        points = np.concatenate(paths)
        thick = np.concatenate([np.linspace(a, b, len(p)) for p, a, b, _ in stems])
        run = np.concatenate([np.linalg.norm(np.gradient(p, axis=0), axis=1) for p in paths])
        none = np.zeros_like(points)
        occluders = join([leaves, Leaves(points, none, none, run, 4.0 * thick, none)])

    density = foliage_density(occluders)
    canvas = Canvas.blank(SIDE)
    for path, (_, foot, tip, colour) in zip(paths, stems, strict=True):
        ends = np.stack([path[:-1], path[1:]], 1)
        taper = np.linspace(foot, tip, len(path))
        radii = np.stack([taper[:-1], taper[1:]], 1)
        skin = np.broadcast_to([*colour, 0.0], (4, 4, 4)).copy()
        flat = np.zeros_like(radii)
        lights = light_on_limbs(density, ends, extinction)
        draw_limbs(canvas, ends, radii, lights, skin, colour, flat, flat[:, 0])

    draw_leaves(canvas, leaves, density, extinction, 0.08)
    return quantised(canvas.finish())


def quantised(rgba: np.ndarray) -> np.ndarray:
    """Quantise a sprite (h, w, 4): colours to steps of 6 levels, alpha to steps of 17.

    The file is a third smaller, and in foliage the loss is not visible.
    """
    colour = (rgba[..., :3].astype(int) + 3) // 6 * 6
    alpha = (rgba[..., 3:].astype(int) + 8) // 17 * 17
    alpha = np.where(rgba[..., 3:] == 0, 0, np.maximum(alpha, 17))
    return np.concatenate([np.minimum(colour, 255), alpha], -1).astype(np.uint8)
