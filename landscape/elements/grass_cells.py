"""Grass by cells of the map: how many blades each cell has, where, and which cells are visible.

Python cannot test every blade of the island, 1,500,000 of them, in each frame; it can test some
hundred square cells around the walker. Blades need not exist before their cell is seen. Everything
is random but seeded. No OpenGL here.
"""

import math
from collections.abc import Callable, Sequence

import numpy as np

from landscape.elements.settings import Castle
from landscape.frame import Frame
from landscape.geometry.height_field import HeightField

CELL = 0.5  # chosen: units per side of a cell; small against the radius, large against a blade
HALF_DIAGONAL = 0.7072  # of a square, times its side
PROBES = 4  # chosen: places per side of a cell where it is tested whether grass grows
SHORE = 0.004  # chosen: units above the water where grass begins
CASTLE = 0.75  # chosen: radius in units around the castle's centre where no grass grows
MOST = 200_000  # chosen: blades of a cell
TRIES = 12  # chosen: most rounds of random places tried to place the blades of a cell

Suits = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""A function of places x, z (n,) that returns how likely a blade grows there, (n,) in 0..1."""


def bears_grass(field: HeightField, castle: Castle, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return 1 at places x, z (n,) on land, on the map and outside the castle, 0 elsewhere."""
    land = (field.terrain_height(x, z) > field.water_level + SHORE).astype(float)
    land *= np.hypot(x - castle.x, z - castle.z) > CASTLE
    land *= (x < field.size) & (z < field.size)
    return land


def cover(suits: Suits, across: int) -> np.ndarray:
    """Return the fraction of each cell that grows grass, (cells,), by rows of ``across`` cells."""
    probes = (np.arange(PROBES * across) + 0.5) * CELL / PROBES
    x, z = np.meshgrid(probes, probes)
    grid = suits(x.ravel(), z.ravel()).reshape(across, PROBES, across, PROBES)
    return np.asarray(grid.mean(axis=(1, 3)).ravel())


def shared_out(count: int, share: np.ndarray, seed: int) -> np.ndarray:
    """Return how many of ``count`` blades each cell gets, at random by its ``share`` (cells,).

    No more than MOST, which cover the ground many times over: on a tiny map there are fewer.
    """
    if not share.any():
        return np.zeros(len(share), int)
    counts = np.random.default_rng([seed, 7]).multinomial(count, share / share.sum())
    return np.minimum(counts, MOST)


def places_in(
    cell: int, across: int, count: int, rng: np.random.Generator, suits: Suits
) -> np.ndarray:
    """Return ``count`` random places x, z (count, 2) in a cell, fewer if few are suitable."""
    return places_in_cells([cell], across, [count], [rng], suits)[0]


def places_in_cells(
    cells: Sequence[int],
    across: int,
    counts: Sequence[int],
    rngs: Sequence[np.random.Generator],
    suits: Suits,
) -> list[np.ndarray]:
    """Return what :func:`places_in` does for each of several cells, in less time."""
    kept: list[list[np.ndarray]] = [[np.empty((0, 2))] for _ in cells]
    missing = list(counts)
    for _ in range(TRIES):
        wanted = [n for n, left in enumerate(missing) if left > 0]
        places, lucks = [], []
        for n in wanted:
            corner = divmod(cells[n], across)[::-1]
            places.append((rngs[n].random((4 * counts[n] + 8, 2)) + corner) * CELL)
            lucks.append(rngs[n].random(len(places[-1])))
        # Mostly the first half are enough, so the others need not be looked up.
        for part in range(2):
            again = [k for k, n in enumerate(wanted) if missing[n] > 0]
            if not again:
                break
            halves = [halved(places[k], part) for k in again]
            chance = suits(*np.concatenate(halves).T)
            end = 0
            for k, half in zip(again, halves, strict=True):
                start, end = end, end + len(half)
                some = half[halved(lucks[k], part) < chance[start:end]]
                kept[wanted[k]].append(some)
                missing[wanted[k]] -= len(some)

    return [np.concatenate(parts)[:count] for parts, count in zip(kept, counts, strict=True)]


def halved(values: np.ndarray, part: int) -> np.ndarray:
    """Return the first half of values (part 0), which is the larger one, or the second (part 1)."""
    middle = (len(values) + 1) // 2
    return values[middle:] if part else values[:middle]


def cells_around(x: float, z: float, radius: float, across: int) -> np.ndarray:
    """Return column and row (n, 2) of the cells within about ``radius`` of x, z, in units.

    The work depends on the radius alone, not on how large the map is or how much grows on it.
    """
    low = np.floor((np.array([x, z]) - radius) / CELL).astype(int)
    high = np.floor((np.array([x, z]) + radius) / CELL).astype(int)
    low, high = np.maximum(low, 0), np.minimum(high, across - 1)
    columns, rows = (np.arange(a, b + 1) for a, b in zip(low, high, strict=True))
    return np.stack(np.meshgrid(columns, rows), axis=2).reshape(-1, 2)


def cell_centres(cells: np.ndarray, field: HeightField) -> np.ndarray:
    """Return the centres (n, 3), on the ground, of cells (n, 2) = column, row."""
    x, z = ((cells + 0.5) * CELL).T
    return np.stack([x, field.terrain_height(x, z), z], axis=1)


def visible_cells(
    frame: Frame,
    centres: np.ndarray,
    radius: float,
    margin: float = 0.0,
    angle: float = 0.0,
    side: float = CELL,
) -> np.ndarray:
    """Return a mask (n,) of the squares with centres (n, 3) that may show a blade of grass.

    In front of the camera, between the left and right sides of its view, and within ``radius``.
    With ``margin`` units and ``angle`` radians, also after the eye has moved and turned that far.
    ``side`` is that of the squares, in units.
    """
    size = HALF_DIAGONAL * side + 0.1 + margin
    away = centres - frame.eye
    near = away[:, 0] ** 2 + away[:, 2] ** 2 < (radius + size) ** 2
    width, height = frame.size
    side = math.tan(math.radians(frame.fov / 2)) * max(width / height, 1.0)
    side = math.tan(min(math.atan(side) + angle, 1.5))  # less than a right angle
    depth = -frame.depth(centres)
    inside = np.abs(away @ frame.right) <= depth * side + size * math.hypot(1.0, side)
    return np.asarray(near & inside & (depth > -size))
