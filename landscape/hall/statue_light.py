"""How much of the hall's soft light reaches each vertex of the statue. No OpenGL.

Ambient occlusion: rays from each vertex walk through a grid of cells, of which those that hold a
part of the statue, or of the plinth below it, block the light.
"""

import math

import numpy as np

DIRECTIONS = 64  # chosen: over the whole sphere
CELL = 0.05  # chosen: side of a cell, of a statue 2 units long
STEPS = (0.11, 0.17, 0.24, 0.33, 0.44, 0.60, 0.80)  # chosen: where a ray looks, in the same units
GRAZING = 0.25  # chosen: least cosine between ray and normal; others meet the vertex's own surface
# Chosen: light from below, from above, and of the windows.
BELOW = 0.10
ABOVE = 0.55
EAST = 0.75


def directions() -> np.ndarray:
    """Return unit vectors (DIRECTIONS, 3) all around, evenly: a Fibonacci spiral."""
    number = np.arange(DIRECTIONS) + 0.5
    height = 1.0 - 2.0 * number / DIRECTIONS
    turn = math.pi * (1.0 + math.sqrt(5.0)) * number
    level = np.sqrt(1.0 - height**2)
    return np.stack([level * np.cos(turn), height, level * np.sin(turn)], axis=1)


def brightness(ways: np.ndarray) -> np.ndarray:
    """Return how bright the hall is in directions (n, 3): floor, vault, windows in the east."""
    rise, east = ways[:, 1], ways[:, 0]
    vault = BELOW + (ABOVE - BELOW) * np.clip(rise + 0.5, 0.0, 1.0)
    return np.asarray(vault + EAST * np.maximum(east, 0.0) ** 2 * (rise > -0.1))


def soft_light(points: np.ndarray, normals: np.ndarray, ground: float) -> np.ndarray:
    """Return the hall's light on a statue's vertices, (n,): 1 on a plane that faces upwards.

    ``points`` and ``normals`` (n, 3) are those of a statue 2 units long, turned as it stands;
    ``ground`` is the height of the plinth's top.
    """
    low = points.min(axis=0) - CELL
    counts = np.ceil((points.max(axis=0) + CELL - low) / CELL).astype(int) + 1
    full = np.zeros(counts, bool)
    full[tuple(np.floor((points - low) / CELL).astype(int).T)] = True
    ways = directions()
    bright = brightness(ways)
    total = np.zeros(len(points))
    for way, light in zip(ways, bright, strict=True):
        met = np.maximum(normals @ way, 0.0)
        some = np.flatnonzero(met > GRAZING)
        left = np.ones(len(some))
        for step in STEPS:
            place = points[some] + step * way
            cell = np.floor((place - low) / CELL).astype(int)
            inside = ((cell >= 0) & (cell < counts)).all(axis=1)
            blocked = place[:, 1] < ground
            blocked[inside] |= full[tuple(cell[inside].T)]
            left[blocked] = 0.0
        total[some] += light * met[some] * left

    up = np.maximum(ways[:, 1], 0.0)
    return np.asarray(total / (bright * up)[up > GRAZING].sum())
