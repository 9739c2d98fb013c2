"""The ornate castle's loopholes and windows: dark quads in front of the stones. No OpenGL here."""

from typing import NamedTuple

import numpy as np

from landscape.elements.best.castle.ornate_masonry import KEEP
from landscape.geometry.masonry import TOWER_RADIUS


class Opening(NamedTuple):
    """A loophole or window: the middle of its foot, half its width, its height.

    ``facing`` is an angle from x towards z, in radians.
    """

    x: float
    y: float
    z: float
    facing: float
    half: float
    tall: float


def openings() -> list[Opening]:
    """Return all loopholes and windows, a little in front of the stones."""
    found = []

    def open_at(*numbers: float) -> None:
        found.append(Opening(*map(float, numbers)))

    east = 0.0
    south = 0.5 * np.pi
    west = np.pi
    north = 1.5 * np.pi
    for x in (0.0, 1.0):
        for z in (0.0, 1.0):
            for turn, y in ((-0.62, 0.36), (0.62, 0.62), (0.0, 0.98)):
                v = np.arctan2(z - 0.5, x - 0.5) + turn
                reach = TOWER_RADIUS + 0.002
                open_at(x + reach * np.cos(v), y, z + reach * np.sin(v), v, 0.009, 0.10)
    off = 0.002
    for u in (0.30, 0.50, 0.70):
        open_at(u, 0.52, 1.0 + off, south, 0.009, 0.10)
        open_at(-off, 0.52, u, west, 0.009, 0.10)
        open_at(1.0 + off, 0.52, u, east, 0.009, 0.10)
    for u in (0.36, 0.64):
        open_at(u, 0.60, -off, north, 0.009, 0.10)
    x0, z0, x1, z1, _ = KEEP
    for share in (0.3, 0.7):
        x, z = x0 + share * (x1 - x0), z0 + share * (z1 - z0)
        for y in (1.10, 1.28):
            open_at(x, y, z0 - off, north, 0.016, 0.06)
            open_at(x, y, z1 + off, south, 0.016, 0.06)
            open_at(x0 - off, y, z, west, 0.016, 0.06)
            open_at(x1 + off, y, z, east, 0.016, 0.06)
    return found


def loopholes() -> np.ndarray:
    """Return the dark openings of loopholes and windows, quads (n, 4, 3) in front of the stones."""
    quads = []
    for x, y, z, facing, half, tall in openings():
        ax, az = -half * np.sin(facing), half * np.cos(facing)
        p, q = (x + ax, z + az), (x - ax, z - az)
        corners = [(p[0], y, p[1]), (q[0], y, q[1])]
        corners += [(q[0], y + tall, q[1]), (p[0], y + tall, p[1])]
        quads.append(corners)
    return np.array(quads)
