"""Crags, boulders, stones and driftwood, as one mesh: they stand in a row along x, 3 units apart.

Behind one that may be large in the window are coarser ones, for drawing it farther away, every 3
units along z.

A stone is the union of blocks, each the intersection of half spaces: rock breaks along planes.
Noise weathers the faces, and layers stand out as ledges; both are signed distances
(:mod:`landscape.studio.animals.sculpture`). Simplification by quadric error puts the few triangles
that remain where the edges are. Colours are no colours but what light and moss need: red is how
open a vertex is to the sky around it, 255 on a ridge, and less in a cleft; green and blue are 0.
"""

import itertools
import math
from collections.abc import Callable

import fast_simplification
import numpy as np
from numba import njit

from landscape.studio.animals.sculpture import (
    Data,
    Field,
    PaintedMesh,
    is_closed,
    largest_piece,
    point_normals,
    relax,
    triangulate,
    unpinch,
)
from landscape.studio.shapes import limb, noise, union

APART = 3.0  # chosen: units from one shape to the next; each is 2 wide at most
STEP = 0.045  # chosen: grid step of the distance field
RATES = (7.0, 6.0, 5.0, 4.0, 3.0, 2.0)  # chosen: of the simplification, until one leaves it closed
LAYERS = 2.6  # chosen: layers per unit of height
# Chosen: faces of each shape, and of the coarser ones. Crags stand in slopes, and may be close.
Counts = tuple[int, ...]
CRAGS: tuple[Counts, ...] = ((260, 110, 30),) * 4
BOULDERS: tuple[Counts, ...] = ((120, 38),) * 3
STONES: tuple[Counts, ...] = ((48, 18),) * 3
PEBBLES: tuple[Counts, ...] = ((16,),) * 2
LOGS: tuple[Counts, ...] = ((110, 30),) * 2

Shape = tuple[np.ndarray, np.ndarray, np.ndarray]  # planes (m, 4), first plane of each block, noise


def block(rng: np.random.Generator, middle: np.ndarray, half: np.ndarray, chips: int) -> np.ndarray:
    """Return the planes (6 + chips, 4) of a box with its corners broken off: normals and offsets.

    ``half`` (3,) are half its sides; it is turned a little at random.
    """
    yaw, lean = rng.normal(0.0, 0.09), rng.normal(0.0, 0.05, 2)
    c, s = math.cos(yaw), math.sin(yaw)
    turned = np.array([[c, lean[0], s], [-lean[0], 1.0, -lean[1]], [-s, lean[1], c]])
    normals, offsets = [], []
    for axis in range(3):
        for sign in (-1.0, 1.0):
            normals.append(sign * turned[axis] + rng.normal(0.0, 0.06, 3))
            offsets.append(half[axis])

    for _ in range(chips):
        way = rng.choice([-1.0, 1.0], 3) * rng.uniform(0.3, 1.0, 3)
        normals.append(turned.T @ way)
        offsets.append(float(np.abs(way) @ half) * rng.uniform(0.66, 0.9))

    n = np.array(normals)
    length = np.linalg.norm(n, axis=1)
    n, d = n / length[:, None], np.array(offsets) / np.where(np.arange(len(n)) < 6, 1.0, length)
    return np.column_stack([n, d + n @ middle])


def crag(seed: int) -> Shape:
    """Return an outcrop: three steps of jointed bedrock, each farther back than the one below."""
    rng = np.random.default_rng(seed)
    blocks = []
    level, front = -0.62, 0.72
    for step in range(3):
        high = rng.uniform(0.34, 0.5) * (1.0 - 0.12 * step)
        left, right = -1.02 + 0.24 * step + rng.uniform(0, 0.2), 1.02 - rng.uniform(0, 0.5) * step
        joints = np.array((0.36, 0.66) if step < 2 else (0.5,))
        joints += rng.uniform(-0.1, 0.1, len(joints))
        edges = left + (right - left) * np.array([0.0, *joints, 1.0])
        for west, east in itertools.pairwise(edges):
            out = front + rng.uniform(-0.16, 0.1)
            top = level + high + rng.uniform(-0.09, 0.07)
            half = np.array([0.53 * (east - west), 0.5 * (top + 0.75), 0.5 * (out + 0.8)])
            middle = np.array([(west + east) / 2, top - half[1], out - half[2]])
            blocks.append(block(rng, middle, half, 4))
        level, front = level + high, front - rng.uniform(0.22, 0.42)

    starts = np.cumsum([0, *(len(each) for each in blocks)])
    return np.concatenate(blocks), starts, np.array([0.022, 0.016, float(seed)])


def boulder(seed: int, flat: float, planes: int, rough: float) -> Shape:
    """Return one block of ``planes`` faces, ``flat`` times as high as wide."""
    rng = np.random.default_rng(seed)
    golden = math.pi * (3.0 - math.sqrt(5.0))
    k = np.arange(planes)
    y = 1.0 - 2.0 * (k + 0.5) / planes
    ring = np.sqrt(1.0 - y * y)
    n = np.stack([ring * np.cos(golden * k), y, ring * np.sin(golden * k)], axis=1)
    n += rng.normal(0.0, 0.24, n.shape)
    n *= np.array([1.0 / rng.uniform(0.85, 1.1), 1.0 / flat, 1.0 / rng.uniform(0.62, 0.85)])
    offsets = rng.uniform(0.66, 0.92, planes)
    length = np.linalg.norm(n, axis=1)
    shape = np.column_stack([n / length[:, None], offsets / length])
    return shape, np.array([0, planes]), np.array([rough, 0.25 * rough, float(seed)])


@njit
def stone_field(x: float, y: float, z: float, data: Shape) -> float:
    """Return about the signed distance to a shape: blocks, weathered, with layers."""
    planes, starts, weather = data
    bend = 0.05 * noise(1.7 * x + weather[2], 1.7 * y, 1.7 * z)
    best = 1e9
    for b in range(len(starts) - 1):
        inside = -1e9
        for k in range(starts[b], starts[b + 1]):
            n = planes[k]
            inside = max(inside, n[0] * x + n[1] * (y + bend) + n[2] * z - n[3])
        best = min(best, inside)
    best = max(best, math.sqrt(x * x + y * y + z * z) - 1.4)
    u = x + weather[2]
    v = y + 0.37 * weather[2]
    w = z
    best += weather[0] * noise(3.1 * u, 3.1 * v, 3.1 * w)
    best += 0.5 * weather[0] * noise(8.0 * u, 8.0 * v, 8.0 * w)
    layer = (LAYERS * (y + bend + 0.1 * x)) % 1.0
    return best + weather[1] * (abs(2.0 * layer - 1.0) - 0.5)


@njit
def log_field(x: float, y: float, z: float, data: np.ndarray) -> float:
    """Return the distance to a bleached trunk that lies along x, bent, with stubs of branches."""
    bend, stub = data[0], data[1]
    d = limb(x, y, z, -1.0, 0.02, 0.0, 0.085, 0.0, 0.05 * bend, 0.12 * bend, 0.075)
    d = union(d, limb(x, y, z, 0.0, 0.05 * bend, 0.12 * bend, 0.075, 1.0, 0.0, 0.0, 0.045), 0.03)
    d = union(d, limb(x, y, z, stub, 0.03, 0.05, 0.04, stub + 0.17, 0.2, 0.2, 0.02), 0.03)
    d = union(d, limb(x, y, z, -0.55, 0.03, 0.0, 0.04, -0.4, 0.05, -0.26, 0.018), 0.03)
    return d + 0.016 * noise(5.0 * x + data[2], 14.0 * y, 14.0 * z)


@njit
def _openness(field, data, vertices, normals, out):  # type: ignore[no-untyped-def]
    for i in range(len(vertices)):
        open_ = 1.0
        for reach in (0.06, 0.14, 0.3):
            x, y, z = vertices[i] + reach * normals[i]
            open_ *= 0.45 + 0.55 * min(max(field(x, y, z, data) / reach, 0.0), 1.0)
        out[i] = open_


def openness(
    field: Field[Data], vertices: np.ndarray, normals: np.ndarray, data: Data
) -> np.ndarray:
    """Return colours, uint8 (n, 3), whose red says how much of its surroundings a vertex sees."""
    found = np.zeros(len(vertices))
    _openness(field, data, vertices, normals, found)
    colours = np.zeros((len(vertices), 3), np.uint8)
    colours[:, 0] = np.clip(255 * found / max(float(np.quantile(found, 0.9)), 1e-6), 0, 255)
    return colours


def carved(field: Field[Data], data: Data, step: float, counts: Counts) -> list[PaintedMesh]:
    """Return a shape of about each number of faces, closed; the largest extent is -1..1."""
    dense, faces = triangulate(field, data, np.full(3, -1.6), np.full(3, 1.6), step)
    dense = np.ascontiguousarray(relax(dense, faces, 1), np.float32)
    low, high = dense.min(axis=0), dense.max(axis=0)
    found = []
    for count in counts:
        points, triangles = reduced(dense, faces, count)
        colours = openness(field, points, point_normals(points, triangles), data)
        points = (points - (low + high) / 2) / ((high - low).max() / 2)
        found.append((points.astype(np.float32), triangles, colours))
    return found


def reduced(vertices: np.ndarray, faces: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return a closed mesh of about ``count`` faces; ValueError if none is found."""
    faces = np.ascontiguousarray(faces)
    for rate in RATES:
        points, triangles = fast_simplification.simplify(
            vertices, faces, target_count=count, agg=rate
        )
        points, triangles = largest_piece(*unpinch(points.astype(float), triangles))
        if is_closed(triangles) and len(triangles) < 1.25 * count:
            return points, triangles
    raise ValueError("the simplified stone is not closed, or has too many faces")


def stones() -> PaintedMesh:
    """Return all shapes, each about its place in the row."""
    made: list[list[PaintedMesh]] = []
    for k, count in enumerate(CRAGS):
        made.append(carved(stone_field, crag(411 + k), STEP, count))
    kinds = (BOULDERS, 0.72, 15, 0.035), (STONES, 0.6, 12, 0.03), (PEBBLES, 0.6, 9, 0.0)
    for first, (counts, flat, planes, rough) in enumerate(kinds):
        for k, count in enumerate(counts):
            shape = boulder(421 + 10 * first + k, flat, planes, rough)
            made.append(carved(stone_field, shape, STEP, count))

    for bend, count in zip((1.0, -1.0), LOGS, strict=True):
        bent = np.array([bend, 0.2 * bend, 6.0 - 3.0 * bend])
        made.append(carved(log_field, bent, STEP / 2, count))
    parts = []
    for k, levels in enumerate(made):
        for level, (points, faces, colours) in enumerate(levels):
            parts.append(
                (points + np.array([APART * k, 0.0, APART * level], np.float32), faces, colours)
            )

    starts = np.cumsum([0, *(len(points) for points, _, _ in parts)])
    return (
        np.concatenate([points for points, _, _ in parts]),
        np.concatenate([f + start for (_, f, _), start in zip(parts, starts, strict=False)]),
        np.concatenate([colours for _, _, colours in parts]),
    )


ASSETS: dict[str, Callable[[], PaintedMesh]] = {"stones.ply": stones}
