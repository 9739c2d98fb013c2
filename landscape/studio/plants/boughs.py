"""Boughs, pads and sprays: the parts of the trees in :mod:`landscape.studio.plants.individuals`.

A crown is not one envelope: boughs leave the trunk at their own heights and carry flat pads of
foliage, with sky between them.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from landscape.studio.light import OVERHEAD
from landscape.studio.plants.foliage import SIZE, Canvas, Leaves, draw_leaves, foliage_density, unit
from landscape.studio.plants.growth import Skeleton
from landscape.studio.plants.trees import bounds, draw_skeleton

GLOW = 1.0  # chosen: see foliage.draw_leaves


class Bough(NamedTuple):
    """A bough: where on the trunk (0..1), where to (radians around it, 0 is right), how far out
    and up it ends in units of sprite space, the size of its pads, and whether it is dead."""

    at: float
    around: float
    out: float
    up: float
    pad: float
    dead: bool = False


class Form(NamedTuple):
    """The frame of a tree: the trunks' and boughs' skeleton, and the pads of foliage."""

    start: Skeleton
    centres: np.ndarray
    radii: np.ndarray
    dead: np.ndarray


def spread_boughs(
    rng: np.random.Generator,
    count: int,
    heights: tuple[float, float],
    reach: Callable[[float], float],
    rise: tuple[float, float],
    pad: tuple[float, float],
) -> list[Bough]:
    """Return boughs from the ``heights`` (low, high) of a trunk, their lengths ``reach`` times
    a random factor; ``rise`` is their slope at the low and at the high end."""
    boughs = []
    for k in range(count):
        t = (k + rng.uniform(0.1, 0.9)) / count
        at = heights[0] + (heights[1] - heights[0]) * t
        around = 2.399963 * k + rng.uniform(-0.6, 0.6)
        out = reach(t) * rng.uniform(0.62, 1.18)
        slope = rise[0] + (rise[1] - rise[0]) * t + rng.uniform(-0.15, 0.15)
        boughs.append(Bough(at, around, out, slope * out, rng.uniform(*pad)))
    return boughs


def form(
    trunks: list[np.ndarray], boughs: list[list[Bough]], rng: np.random.Generator, pads: int = 3
) -> Form:
    """Return trunks, polylines (k, 3) from the foot, with their ``boughs`` and those' pads."""
    points: list[np.ndarray] = [np.zeros(3)]
    parents = [-1]
    centres = []
    radii = []
    dead = []
    for trunk, own in zip(trunks, boughs, strict=True):
        run = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(trunk, axis=0), axis=1))])
        count = max(3, int(run[-1] / 0.035))
        places = np.linspace(0, run[-1], count + 1)[1:]
        line = np.stack([np.interp(places, run, trunk[:, k]) for k in range(3)], 1)
        nodes: list[int] = []
        for point in line:
            points.append(point)
            parents.append(nodes[-1] if nodes else 0)
            nodes.append(len(points) - 1)
        for bough in own:
            last = nodes[min(int(bough.at * count), count - 1)]
            base = points[last]
            level = np.array([np.cos(bough.around), 0.0, np.sin(bough.around)])
            # A bough sets out steeper than it ends, and is crooked.
            steps = max(3, int(np.hypot(bough.out, bough.up) / 0.035))
            bend = np.cumsum(rng.standard_normal((steps, 3)) * 0.012, axis=0)
            for j in range(1, steps + 1):
                t = j / steps
                rise = bough.up * (1.35 * t - 0.35 * t * t)
                points.append(base + level * bough.out * t + [0.0, rise, 0.0] + bend[j - 1])
                parents.append(last)
                last = len(points) - 1
            end = points[last]
            for k in range(pads):
                back = 0.20 * bough.out * k / max(pads - 1, 1) * level * 1.9
                jitter = rng.standard_normal(3) * np.array([0.55, 0.42, 0.55]) * bough.pad
                size = bough.pad * rng.uniform(0.62, 1.12) * np.array([1.2, 0.72, 1.15])
                centres.append(end - back + jitter * (0.4 + 0.6 * (k > 0)))
                radii.append(size)
                dead.append(bough.dead)

    start = Skeleton(np.array(points), np.array(parents))
    return Form(start, np.array(centres), np.array(radii), np.array(dead))


def sprays(
    skeleton: Skeleton,
    at: np.ndarray,
    per_node: int,
    spread: tuple[float, float],
    size: tuple[float, float],
    droop: float,
    albedos: np.ndarray,
    rng: np.random.Generator,
) -> Leaves:
    """Return ``per_node`` leaves about each node ``at``, in flat sprays.

    ``spread`` is (level, upright); otherwise as in :func:`trees.add_leaves`. The leaves of one
    spray share a hue, and lie rather than stand, so that its upper side is bright.
    """
    node = np.repeat(at, per_node)
    n = len(node)
    offset = np.clip(rng.standard_normal((n, 3)), -1.8, 1.8) * 0.6
    centre = skeleton.points[node] + offset * np.array([spread[0], spread[1], spread[0]])
    axis = unit(offset + 0.8 * rng.standard_normal((n, 3)) + np.array([0.0, -droop, 0.0]))
    normal = 0.85 * rng.standard_normal((n, 3)) + np.array([0.0, 0.75, 0.55])
    normal = unit(normal - axis * np.sum(normal * axis, 1, keepdims=True))
    scale = rng.uniform(0.65, 1.3, n)
    mix = rng.dirichlet(np.full(len(albedos), 0.8), len(skeleton.points))[node]
    albedo = mix @ albedos * rng.uniform(0.78, 1.2, (n, 1))
    return Leaves(centre, axis, normal, size[0] * scale, size[1] * scale, albedo)


def fit(skeleton: Skeleton, leaves: Leaves, width: float, height: float, lean: float) -> None:
    """Scale a tree about its foot into the given fraction of the sprite.

    ``lean`` is the part of its lean that stays, 0..1.
    """
    low, high = bounds(skeleton, leaves)
    margin = leaves.length.max()
    skeleton.points[:, 1] = np.maximum(skeleton.points[:, 1], 0.0)
    shear = -(1.0 - lean) * (low[0] + high[0]) / 2 / high[1]
    for points in (skeleton.points, leaves.centre):
        points[:, 0] += shear * points[:, 1]
    everything = np.concatenate([skeleton.points, leaves.centre])
    sx = (width - margin) / np.abs(everything[:, 0]).max()
    sy = (2 * height - margin) / everything[:, 1].max()
    for points in (skeleton.points, leaves.centre):
        points *= np.array([sx, sy, sx])


def live(skeleton: Skeleton, at: np.ndarray, frame: Form) -> np.ndarray:
    """Return those of the nodes ``at`` that are not among the pads of a dead bough."""
    if not frame.dead.any():
        return at
    away = skeleton.points[at][:, None] - frame.centres
    near = (np.square(away / frame.radii)).sum(axis=2).argmin(axis=1)
    return np.asarray(at[~frame.dead[near]])


def drawn(
    skeleton: Skeleton,
    radii: np.ndarray,
    leaves: Leaves,
    bark: np.ndarray,
    extinction: float,
    roots: int,
    rng: np.random.Generator,
    size: int = SIZE,
) -> np.ndarray:
    """Return the picture of a tree, uint8 (size, size, 4)."""
    density = foliage_density(leaves)
    canvas = Canvas.blank(size)
    draw_skeleton(canvas, skeleton, radii, bark, density, extinction, roots, rng, OVERHEAD)
    draw_leaves(canvas, leaves, density, extinction, 0.0, OVERHEAD, GLOW)
    return canvas.finish()


def line(*points: tuple[float, float, float]) -> np.ndarray:
    """Return a polyline (k, 3)."""
    return np.array(points)
