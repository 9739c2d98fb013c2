"""Ivy on the weathered castle's walls, and weeds at their foot and on ledges. No OpenGL here.

Each is a quad with one of four pictures (studio/castle/ashlar.py): the leaves' outline comes from
an alpha test. Places are in the castle's own frame. All sizes are chosen.
"""

import math

import numpy as np

from landscape.elements.best.castle.footing import Ground, outside_of_walls
from landscape.elements.best.castle.ornate_masonry import BAND, PLINTH
from landscape.geometry.masonry import TOWER_RADIUS
from landscape.geometry.mesh import Mesh

# The tower that ivy grows on, the angle of its middle in radians, width there and height; chosen
# for the views of the gate, and of the back from the north.
IVIES = (((1.0, 0.0), -1.9, 0.20, 0.74), ((1.0, 1.0), 1.1, 0.17, 0.62))
STEMS, STEP = 12, 0.034
WEEDS, ON_LEDGES = 75, 34


def stems(width: float, height: float, rng: np.random.Generator) -> np.ndarray:
    """Return places (n, 2) of ivy on a wall: along it, and upwards from the ground."""
    found = []
    for k in range(STEMS):
        part = (k + rng.uniform(0.2, 0.8)) / STEMS * 2.0 - 1.0
        u = width * part
        y = -0.02
        lean = rng.normal(0.25 * part, 0.35)
        tall = height * (1.0 - 0.75 * part * part) * rng.uniform(0.45, 1.0)
        while y < tall:
            found.append((u, y))
            lean = 0.8 * lean + rng.normal(0.0, 0.30)
            u, y = u + STEP * math.sin(lean), y + STEP * math.cos(lean)
    return np.array(found)


def inside(place: np.ndarray) -> bool:
    """Return whether a place (3,) is within the castle's walls."""
    return bool((np.abs(place[[0, 2]] - 0.5) < 0.504).all())


def quad(
    middle: np.ndarray, right: np.ndarray, up: np.ndarray, cell: tuple[int, int], flip: bool
) -> tuple[list[np.ndarray], list[tuple[float, float]]]:
    """Return corners and texture coordinates of a picture spanned by ``right`` and ``up``."""
    corners = [middle - right - up, middle + right - up, middle + right + up, middle - right + up]
    s0, t0 = cell[0] / 2 + 0.006, cell[1] / 2 + 0.006
    s1, t1 = s0 + 0.488, t0 + 0.488
    if flip:
        s0, s1 = s1, s0
    return corners, [(s0, t1), (s1, t1), (s1, t0), (s0, t0)]


def leaves(ground: Ground) -> tuple[Mesh, np.ndarray]:
    """Return all quads as a mesh, which is seen from both sides, and the tint (n, 3) of each."""
    rng = np.random.default_rng([2006, 22])
    corners: list[np.ndarray] = []
    uv: list[tuple[float, float]] = []
    normals, tints = [], []

    def put(
        middle: np.ndarray,
        right: np.ndarray,
        up: np.ndarray,
        normal: np.ndarray,
        row: int,
        tint: np.ndarray,
    ) -> None:
        places, coordinates = quad(
            middle, right, up, (int(rng.integers(2)), row), bool(rng.integers(2))
        )
        corners.extend(places)
        uv.extend(coordinates)
        normals.extend([normal] * 4)
        tints.extend([tint] * 4)

    for (x, z), angle, width, height in IVIES:
        low = float(ground(np.array([[x + TOWER_RADIUS * math.cos(angle), z]]))[0])
        for u, y in stems(width, height, rng):
            turn = angle + u / TOWER_RADIUS
            out = np.array([math.cos(turn), 0.0, math.sin(turn)])
            depth = rng.random()  # leaves that lie farther out get more light
            proud = (0.024 if y + low < PLINTH[1] + 0.02 else 0.004) + 0.016 * depth
            middle = np.array([x, low + y, z]) + (TOWER_RADIUS + proud) * out
            if inside(middle):
                continue
            size = (0.022 + 0.024 * rng.random()) * (1.0 - 0.45 * y / height)
            roll = rng.normal(0.0, 0.5)
            side = np.array([-out[2], 0.0, out[0]])
            right = size * (math.cos(roll) * side + np.array([0, math.sin(roll), 0]))
            up = size * (np.array([0, math.cos(roll), 0]) - math.sin(roll) * side + 0.25 * out)
            tint = rng.normal(1.0, 0.12) * (0.55 + 0.70 * depth) * np.array([1.0, 1.0, 0.9])
            put(middle, right, up, out + (0.0, 0.35, 0.0), 0, tint)
    weeds = outside_of_walls(WEEDS, 0.05, rng)
    ledges = outside_of_walls(ON_LEDGES, 1e-6, rng)
    for k, (x, z) in enumerate(np.concatenate([weeds, ledges])):
        on_ledge = k >= WEEDS
        size = 0.012 + 0.022 * rng.random() ** 1.5
        if on_ledge:
            y = (PLINTH[1] + 0.012) if rng.random() < 0.7 else (BAND[1] + 0.004)
            size *= 0.6
            towards = np.array([0.5 - x, 0.5 - z])
            x, z = np.array([x, z]) + 0.012 * towards / np.linalg.norm(towards)
        else:
            y = float(ground(np.array([[x, z]]))[0])
        first = rng.uniform(0.0, math.pi)
        tint = rng.normal(0.95, 0.12) * np.array([1.0, rng.uniform(0.85, 1.0), 0.9])
        for turn in (first, first + math.pi / 2):
            right = size * np.array([math.cos(turn), 0.0, math.sin(turn)])
            up = np.array([0.0, size, 0.0])
            middle = np.array([x, y + 0.92 * size, z])
            put(middle, right, up, np.array([0.0, 1.0, 0.0]), 1, tint)
    facing = np.array(normals)
    facing /= np.linalg.norm(facing, axis=1, keepdims=True)
    base = 4 * np.arange(len(corners) // 4)[:, None]
    triangles = (base + np.array([0, 1, 2, 0, 2, 3])).reshape(-1, 3)
    mesh = Mesh(
        np.ascontiguousarray(corners, np.float32),
        np.ascontiguousarray(facing, np.float32),
        np.ascontiguousarray(triangles, np.uint32),
        (np.ascontiguousarray(uv, np.float32),),
    )
    return mesh, np.array(tints)
