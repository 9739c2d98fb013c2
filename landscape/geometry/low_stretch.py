"""Low-stretch texture coordinates for a height field: detail keeps its scale on slopes.

A texture mapped by x and z alone is stretched where the ground is steep: uphill, a step of 1 is
sqrt(1 + slope^2) long. Steps of that length cannot all fit together in a plane, so the coordinates
are those whose steps come nearest in the least-squares sense. That is a Poisson equation, which a
cosine transform solves one wave at a time. Not in the report.
"""

import numpy as np

from landscape.geometry.height_field import HeightField


def low_stretch_uv(field: HeightField) -> np.ndarray:
    """Return texture coordinates (n*n, 2) of a height field's vertices, about 1 over the map."""
    cell = field.size / (len(field.heights) - 1)
    laid = low_stretch_coordinates(field.heights, cell)
    return np.asarray(laid.reshape(-1, 2) / np.float32(field.size))


def low_stretch_coordinates(heights: np.ndarray, cell: float) -> np.ndarray:
    """Return where each vertex of a height field (n, n) is when it is flattened, (n, n, 2).

    ``cell`` is the side of a cell; the result is in the same units.
    """
    dz, dx = np.gradient(heights, cell)
    steep = dx * dx + dz * dz
    longer = (np.sqrt(1.0 + steep) - 1.0) / np.maximum(steep, 1e-12)
    across = longer * dx * dz
    x = nearest_surface((1.0 + longer * dx * dx) * cell, across * cell)
    z = nearest_surface(across * cell, (1.0 + longer * dz * dz) * cell)
    return np.stack([x, z], axis=2)


def nearest_surface(right: np.ndarray, down: np.ndarray) -> np.ndarray:
    """Return values (n, n), mean 0, whose steps to the right and down are nearest to those given.

    The steps (n, n) are given at the vertices; a step between two vertices is the mean of both.
    """
    n = len(right)
    divergence = np.zeros((n, n))
    for steps, transposed in ((right, divergence), (down.T, divergence.T)):
        half = (steps[:, 1:] + steps[:, :-1]) / 2
        transposed[:, 1:] += half
        transposed[:, :-1] -= half
    number = np.arange(n)
    waves = np.cos(np.pi / n * np.outer(number, number + 0.5)) * np.sqrt(2.0 / n)
    waves[0] = np.sqrt(1.0 / n)
    stiffness = 2.0 - 2.0 * np.cos(np.pi / n * number)
    total = np.add.outer(stiffness, stiffness)
    total[0, 0] = np.inf  # the mean is free
    return np.asarray(waves.T @ ((waves @ divergence @ waves.T) / total) @ waves)
