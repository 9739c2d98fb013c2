"""The few shapes that models are made of, and how a model is put into a world."""

import numpy as np


def put(blocks: np.ndarray, model: np.ndarray, at: tuple[int, int, int], floor: int = 0) -> None:
    """Place a model in a world, both uint8 [x, z, y], in place; what is outside is left out.

    ``at`` = (x, z, y) is where the middle of the model's level ``floor`` comes.
    """
    corner = np.array(at) - (model.shape[0] // 2, model.shape[1] // 2, floor)
    low = np.maximum(corner, 0)
    high = np.maximum(np.minimum(corner + model.shape, blocks.shape), low)
    there = tuple(slice(a, b) for a, b in zip(low, high, strict=True))
    part = model[tuple(slice(a, b) for a, b in zip(low - corner, high - corner, strict=True))]
    np.copyto(blocks[there], part, where=part > 0)


def trimmed(model: np.ndarray) -> np.ndarray:
    """Cut off the empty margins of a model, as many on either side of its middle, and its top."""
    x, z, y = np.nonzero(model)
    reach = [max(np.abs(v - n // 2).max(), 0) for v, n in zip((x, z), model.shape, strict=False)]
    (cx, cz), (rx, rz) = (model.shape[0] // 2, model.shape[1] // 2), reach
    return np.ascontiguousarray(model[cx - rx : cx + rx + 1, cz - rz : cz + rz + 1, : y.max() + 1])


def blob(
    model: np.ndarray,
    centre: tuple[float, float, float],
    radii: tuple[float, float, float],
    number: int,
    power: float = 2.4,
) -> None:
    """Fill the cells of a rounded box in place: ``power`` 2 is an ellipsoid, more is boxier.

    ``centre`` and ``radii`` are (x, z, y) in blocks; the middle of cell 0 is at 0. What is filled
    already stays.
    """
    grids = np.ogrid[tuple(slice(0, n) for n in model.shape)]
    distance = sum(
        (np.abs(grid - c) / r) ** power for grid, c, r in zip(grids, centre, radii, strict=True)
    )
    model[(distance <= 1) & (model == 0)] = number


def line(
    model: np.ndarray,
    start: tuple[float, float, float],
    end: tuple[float, float, float],
    number: int,
) -> None:
    """Fill the cells along a line, each joined to the next by a face, in place."""
    a, b = np.array(start, float), np.array(end, float)
    steps = 8 * int(np.ceil(np.abs(b - a).max())) + 1
    cells = np.rint(a + np.linspace(0, 1, steps)[:, None] * (b - a)).astype(int)
    for cell, following in zip(cells[:-1], cells[1:], strict=True):
        corner = cell.copy()
        for axis in (2, 0, 1):  # upwards first: branches rise before they spread
            corner[axis] = following[axis]
            model[tuple(corner)] = number
    model[tuple(cells[0])] = number


def disc(shape: tuple[int, int], centre: tuple[float, float], radius: float) -> np.ndarray:
    """Return which cells (x, z) of a plan are within ``radius`` of a point, bool ``shape``."""
    x, z = np.ogrid[: shape[0], : shape[1]]
    return np.asarray((x - centre[0]) ** 2 + (z - centre[1]) ** 2 <= radius * radius)


def octagon(shape: tuple[int, int], centre: tuple[float, float], radius: float) -> np.ndarray:
    """Return which cells (x, z) of a plan are in an octagon of this inner radius."""
    x, z = np.ogrid[: shape[0], : shape[1]]
    dx, dz = np.abs(x - centre[0]), np.abs(z - centre[1])
    return np.asarray((np.maximum(dx, dz) <= radius) & (dx + dz <= 1.45 * radius))


def joined(cells: np.ndarray, seeds: np.ndarray) -> np.ndarray:
    """Return which cells, bool (a, b, c), are joined to ``seeds`` face by face through cells."""
    found = seeds & cells
    while True:
        grown = found.copy()
        for axis in range(3):
            low, high = [slice(None)] * 3, [slice(None)] * 3
            low[axis], high[axis] = slice(None, -1), slice(1, None)
            grown[tuple(low)] |= found[tuple(high)]
            grown[tuple(high)] |= found[tuple(low)]
        grown &= cells
        if (grown == found).all():
            return found
        found = grown
