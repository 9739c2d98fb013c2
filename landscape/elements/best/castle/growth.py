"""Ivy on the weathered castle's walls, and weeds at their foot and on ledges. No OpenGL here.

Each is a quad with one of four pictures (studio/castle/ashlar.py): the leaves' outline comes from
an alpha test. Single leaves lie before the ivy's pictures where it is seen from nearby (ivy.py).
Places are in the castle's own frame. All sizes are chosen.
"""

import math

import numpy as np

from landscape.elements.best.castle.baked_light import noise
from landscape.elements.best.castle.footing import Ground, outside_of_walls
from landscape.elements.best.castle.ornate_masonry import BAND, PLINTH
from landscape.geometry.masonry import TOWER_RADIUS
from landscape.geometry.mesh import Mesh

# The tower that ivy grows on, the angle of its middle in radians, width there and height; chosen
# for the views of the gate, and of the back from the north.
IVIES = (((1.0, 0.0), -1.9, 0.20, 0.74), ((1.0, 1.0), 1.1, 0.17, 0.62))
STEMS, STEP = 12, 0.034
WEEDS, ON_LEDGES = 75, 34
FRINGE, NEAR_FOOT = 520, 0.011  # tufts of short grass along the foot, and how far from it


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


class Quads:
    """Quads with pictures of leaves, each with its normal and its tint."""

    def __init__(self, rng: np.random.Generator) -> None:
        """Begin without any; ``rng`` chooses between two pictures, and mirrors some."""
        self._rng = rng
        self._corners: list[np.ndarray] = []
        self._coordinates: list[tuple[float, float]] = []
        self._normals: list[np.ndarray] = []
        self._tints: list[np.ndarray] = []

    def add(
        self,
        middle: np.ndarray,
        right: np.ndarray,
        up: np.ndarray,
        normal: np.ndarray,
        row: int,
        tint: np.ndarray,
    ) -> None:
        """Add a picture of a row of the texture, spanned by ``right`` and ``up``."""
        column, mirrored = int(self._rng.integers(2)), bool(self._rng.integers(2))
        s0, t0 = column / 2 + 0.006, row / 2 + 0.006
        s1, t1 = s0 + 0.488, t0 + 0.488
        if mirrored:
            s0, s1 = s1, s0
        self._corners += [
            middle - right - up,
            middle + right - up,
            middle + right + up,
            middle - right + up,
        ]
        self._coordinates += [(s0, t1), (s1, t1), (s1, t0), (s0, t0)]
        self._normals += [normal] * 4
        self._tints += [tint] * 4

    def mesh(self) -> tuple[Mesh, np.ndarray]:
        """Return the quads as a mesh, and the tint (n, 3) of each vertex."""
        facing = np.array(self._normals)
        facing /= np.linalg.norm(facing, axis=1, keepdims=True)
        base = 4 * np.arange(len(self._corners) // 4)[:, None]
        triangles = (base + np.array([0, 1, 2, 0, 2, 3])).reshape(-1, 3)
        mesh = Mesh(
            np.ascontiguousarray(self._corners, np.float32),
            np.ascontiguousarray(facing, np.float32),
            np.ascontiguousarray(triangles, np.uint32),
            (np.ascontiguousarray(self._coordinates, np.float32),),
        )
        return mesh, np.array(self._tints)


def leaves(ground: Ground) -> tuple[Mesh, np.ndarray]:
    """Return all quads as a mesh, which is seen from both sides, and the tint (n, 3) of each."""
    rng = np.random.default_rng([2006, 22])
    quads = Quads(rng)
    for tower, angle, width, height in IVIES:
        add_ivy(quads, ground, tower, angle, width, height, rng)

    add_weeds(quads, ground, rng)
    add_fringe(quads, ground)
    return quads.mesh()


def add_ivy(
    quads: Quads,
    ground: Ground,
    tower: tuple[float, float],
    angle: float,
    width: float,
    height: float,
    rng: np.random.Generator,
) -> None:
    """Add the leaves of ivy on a round tower, around the direction ``angle`` from its middle."""
    x, z = tower
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
        quads.add(middle, right, up, out + (0.0, 0.35, 0.0), 0, tint)


def add_weeds(quads: Quads, ground: Ground, rng: np.random.Generator) -> None:
    """Add weeds, two crossed quads each, at the foot of the walls and on their ledges."""
    at_foot = outside_of_walls(WEEDS, 0.05, rng)
    on_ledges = outside_of_walls(ON_LEDGES, 1e-6, rng)
    for k, (x, z) in enumerate(np.concatenate([at_foot, on_ledges])):
        size = 0.012 + 0.022 * rng.random() ** 1.5
        if k < WEEDS:
            y = float(ground(np.array([[x, z]]))[0])
        else:
            y = (PLINTH[1] + 0.012) if rng.random() < 0.7 else (BAND[1] + 0.004)
            size *= 0.6
            towards = np.array([0.5 - x, 0.5 - z])
            x, z = np.array([x, z]) + 0.012 * towards / np.linalg.norm(towards)

        first = rng.uniform(0.0, math.pi)
        tint = rng.normal(0.95, 0.12) * np.array([1.0, rng.uniform(0.85, 1.0), 0.9])
        for turn in (first, first + math.pi / 2):
            right = size * np.array([math.cos(turn), 0.0, math.sin(turn)])
            up = np.array([0.0, size, 0.0])
            middle = np.array([x, y + 0.92 * size, z])
            quads.add(middle, right, up, np.array([0.0, 1.0, 0.0]), 1, tint)


def add_fringe(quads: Quads, ground: Ground) -> None:
    """Add tufts of short grass where walls meet the ground, dense in places and bare in others."""
    rng = np.random.default_rng([2006, 32])
    places = outside_of_walls(FRINGE, NEAR_FOOT, rng)
    heights = ground(places)
    spots = np.stack([places[:, 0], np.zeros(len(places)), places[:, 1]], axis=1)
    rich = noise(spots, (11.0, 1.0, 11.0), 33)
    for (x, z), y, good in zip(places, heights, rich, strict=True):
        if good < rng.uniform(0.25, 0.6):
            continue
        size = (0.0035 + 0.0085 * rng.random() ** 1.6) * (0.6 + 0.8 * good)
        first = rng.uniform(0.0, math.pi)
        dry = rng.uniform(0.0, 0.25)
        tint = rng.normal(0.80, 0.12) * np.array([1.0 + 0.5 * dry, 1.0, 0.85 - dry])
        for turn in (first, first + math.pi / 2):
            right = 1.3 * size * np.array([math.cos(turn), 0.0, math.sin(turn)])
            up = np.array([0.0, size, 0.0])
            middle = np.array([x, float(y) + 0.90 * size, z])
            quads.add(middle, right, up, np.array([0.0, 1.0, 0.0]), 1, tint)
