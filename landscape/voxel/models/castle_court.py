"""The castle's court: paths over grass, a well, a stall, a tree, flowers."""

import numpy as np

from landscape.voxel.blocks import block
from landscape.voxel.models.trees import tree

WELL = (20, 26)
STALL = (9, 28)
TREE = (28, 28)


def yard(model: np.ndarray, ground: np.ndarray, floor: int, gate: int, south: int) -> None:
    """Cover the court with grass over earth, and with paths from the gate to the doors, in place.

    ``ground`` are the columns, bool [x, z]; ``gate`` is the middle of the gate passage in the wall
    at z = ``south``.
    """
    model[..., floor - 4 : floor - 1][ground] = block("earth")
    model[..., floor - 1][ground] = block("grass")
    path = _paths(ground.shape, gate, south)
    model[..., floor - 1][path & ground] = block("gravel")


def _paths(shape: tuple[int, ...], gate: int, south: int) -> np.ndarray:
    """Return in which columns, bool [x, z], paths go through the court, and around its well."""
    stops = ((gate, south), (gate, 24), WELL, (26, 24), (11, 18), (9, 27))
    branches = ((0, 1), (1, 2), (2, 3), (1, 4), (1, 5))
    x, z = np.ogrid[: shape[0], : shape[1]]
    path = np.zeros(shape, bool)
    for a, b in branches:
        for t in np.linspace(0, 1, 24):
            cx, cz = (1 - t) * np.array(stops[a]) + t * np.array(stops[b])
            wander = 0.5 * np.sin(1.7 * cz + a)
            path |= (x - cx - wander) ** 2 + (z - cz) ** 2 <= 1.7**2
    path |= (x - WELL[0]) ** 2 + (z - WELL[1]) ** 2 <= 3.3**2
    return path


def court(model: np.ndarray, floor: int) -> None:
    """Build the well, the stall and the garden into the castle, in place."""
    _well(model, floor)
    _stall(model, floor)
    rng = np.random.default_rng(3)
    crown = tree("hawthorn", rng)
    place = tuple(
        slice(at - n // 2, at - n // 2 + n) for at, n in zip(TREE, crown.shape[:2], strict=True)
    )
    part = model[(*place, slice(floor, floor + crown.shape[2]))]
    np.copyto(part, crown, where=(crown > 0) & (part == 0))
    _garden(model, floor, rng)


def _well(model: np.ndarray, floor: int) -> None:
    """Build the well, with a roof on two posts."""
    x, z = WELL
    model[x - 1 : x + 2, z - 1 : z + 2, floor - 4 : floor + 1] = block("dark brick")
    model[x, z, floor - 3 : floor + 1] = 0
    model[x, z, floor - 4] = block("dark")
    for cx in (x - 1, x + 1):
        model[cx, z, floor + 1 : floor + 4] = block("oak log")
    model[x - 2 : x + 3, z - 1 : z + 2, floor + 4] = block("slate")
    model[x - 1 : x + 2, z, floor + 5] = block("slate")


def _stall(model: np.ndarray, floor: int) -> None:
    """A market stall: posts, a striped awning, a table, barrels."""
    x, z = STALL
    for cx in (x, x + 4):
        for cz in (z, z + 2):
            model[cx, cz, floor : floor + 3] = block("oak log")
    for cx in range(x, x + 5):
        cloth = block("red cloth" if cx % 2 == x % 2 else "light fur")
        model[cx, z : z + 3, floor + 3] = cloth
    model[x + 1 : x + 4, z, floor] = block("planks")
    model[x + 4, z - 1, floor] = block("spruce log")
    model[x + 3, z + 2, floor : floor + 2] = block("planks")
    model[x + 4, z + 3, floor] = block("spruce log")


def _garden(model: np.ndarray, floor: int, rng: np.random.Generator) -> None:
    """Flowers grow on what is still grass with nothing on it."""
    free = (model[..., floor - 1] == block("grass")) & (model[..., floor] == 0)
    for name, chance in (("tall grass", 0.10), ("buttercup", 0.06), ("poppy", 0.05)):
        grows = free & (rng.random(free.shape) < chance)
        model[..., floor][grows] = block(name)
