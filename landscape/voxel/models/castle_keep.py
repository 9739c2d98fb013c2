"""The castle's keep, with stairs inside up to its top, and the hall beside it."""

import numpy as np

from landscape.voxel.blocks import block
from landscape.voxel.models.shapes import disc

KEEP = (18, 11)  # x and z of its north-western corner
SIDE = (12, 12)  # outer size along x and z; the walls are two blocks thick
DOOR = 7  # from the western side to the door in the south
HEIGHT = 21  # from the court to its top
HALL = (8, 11, 10, 7)  # x, z and size of the hall, which ends at the keep's wall


def keep(model: np.ndarray, floor: int) -> None:
    """Build the keep into the castle, in place; ``floor`` is the court's first free level."""
    (x, z), (wide, deep) = KEEP, SIDE
    top = floor + HEIGHT
    body = (slice(x, x + wide), slice(z, z + deep))
    room = (slice(x + 2, x + wide - 2), slice(z + 2, z + deep - 2))
    model[(*body, slice(0, top))] = block("brick")
    model[(*body, slice(floor - 1, floor + 2))] = block("dark brick")
    _buttresses(model, floor, top)
    model[(*room, slice(floor, top - 1))] = 0
    model[(*room, slice(floor - 1, floor))] = block("planks")
    _windows(model, floor, top)
    _top(model, top)
    _stairs_inside(model, floor, top)
    _door(model, floor)
    _furniture(model, floor, top)


def _furniture(model: np.ndarray, floor: int, top: int) -> None:
    """A lamp on a long chain, a table, and a carpet from the door."""
    (x, z), (wide, deep) = KEEP, SIDE
    model[x + wide // 2, z + deep // 2, floor + 8 : top - 1] = block("dark")
    model[x + wide // 2, z + deep // 2, floor + 7] = block("lamp")
    model[x + 4 : x + 6, z + 4 : z + 7, floor] = block("planks")
    model[x + DOOR : x + DOOR + 2, z + 3 : z + deep - 2, floor - 1] = block("red cloth")


def _buttresses(model: np.ndarray, floor: int, top: int) -> None:
    """The corners jut out by a block, up to the corbels."""
    (x, z), (wide, deep) = KEEP, SIDE
    for cx in (x - 1, x + wide):
        for cz in (z - 1, z + deep):
            inner_x, inner_z = (cx + 1 if cx < x else cx - 1), (cz + 1 if cz < z else cz - 1)
            for px, pz in ((cx, inner_z), (inner_x, cz)):
                model[px, pz, floor - 4 : top - 3] = block("dark brick")
                model[px, pz, floor + 8] = block("brick")


def _windows(model: np.ndarray, floor: int, top: int) -> None:
    """Two rows of windows a block deep, of dark panes, some with light in them."""
    (x, z), (wide, deep) = KEEP, SIDE
    lit = 0
    for low in (floor + 6, floor + 12):
        for at in (2, 5, 9):
            tall = slice(low, low + (2 if at != 5 else 3))
            for plan, inside in (
                ((x + at, z), (x + at, z + 1)),
                ((x + at, z + deep - 1), (x + at, z + deep - 2)),
                ((x, z + at), (x + 1, z + at)),
                ((x + wide - 1, z + at), (x + wide - 2, z + at)),
            ):
                lit += 1
                model[(*plan, tall)] = 0
                model[(*inside, tall)] = block("lamp" if lit % 5 == 2 else "pane")
                model[(*plan, low - 1)] = block("dark brick")


def _corbels(model: np.ndarray, level: int) -> None:
    """Stones below the platform that juts out, every second one."""
    (x, z), (wide, deep) = KEEP, SIDE
    for cx in range(x - 1, x + wide + 1, 2):
        model[cx, z - 1 : z + deep + 1 : deep + 1, level] = block("dark brick")
    for cz in range(z - 1, z + deep + 1, 2):
        model[x - 1 : x + wide + 1 : wide + 1, cz, level] = block("dark brick")


def _top(model: np.ndarray, top: int) -> None:
    """A platform that juts out, with merlons, and a watch turret on one corner."""
    (x, z), (wide, deep) = KEEP, SIDE
    outer = (slice(x - 1, x + wide + 1), slice(z - 1, z + deep + 1))
    inner = (slice(x, x + wide), slice(z, z + deep))
    _corbels(model, top - 2)
    model[(*outer, slice(top - 1, top))] = block("dark brick")
    model[(*outer, slice(top, top + 2))] = block("brick")
    model[(*inner, slice(top, top + 2))] = 0
    for cx in range(x, x + wide + 1, 3):
        model[cx, z - 1 : z + deep + 1 : deep + 1, top + 1] = 0
    for cz in range(z, z + deep + 1, 3):
        model[x - 1 : x + wide + 1 : wide + 1, cz, top + 1] = 0

    _watch_turret(model, top)


def _watch_turret(model: np.ndarray, top: int) -> None:
    """The turret, on the north-eastern corner, with a lit window and a cone."""
    (x, z), (wide, _deep) = KEEP, SIDE
    cx, cz = x + wide - 2, z + 1
    plan = model.shape[:2]
    turret = disc((plan[0], plan[1]), (cx, cz), 2.4)
    model[..., top : top + 6][turret] = block("brick")
    model[..., top + 5][turret] = block("dark brick")
    for dx, dz in ((-2, 0), (2, 0), (0, -2), (0, 2)):
        model[cx + dx, cz + dz, top + 2 : top + 4] = block("pane" if dz >= 0 else "lamp")
    for level in range(9):
        model[..., top + 6 + level][disc((plan[0], plan[1]), (cx, cz), 3.3 * (1 - level / 9))] = (
            block("slate")
        )

    flag(model, cx, cz, top + 14)


def flag(model: np.ndarray, x: int, z: int, low: int) -> None:
    """Put up a pole with a swallow-tailed flag that blows to the south, in place."""
    model[x, z, low : low + 4] = block("oak log")
    model[x, z + 1 : z + 4, low + 1 : low + 4] = block("red cloth")
    model[x, z + 4, low + 1 : low + 4 : 2] = block("red cloth")


def _stairs_inside(model: np.ndarray, floor: int, top: int) -> None:
    """Steps of planks climb along the walls, once around, and come out on the platform."""
    (x, z), (wide, deep) = KEEP, SIDE
    low_x = x + 2
    high_x = x + wide - 3
    low_z = z + 2
    high_z = z + deep - 3
    way = [(at, high_z) for at in range(low_x + 1, high_x)]
    way += [(high_x, at) for at in range(high_z, low_z, -1)]
    way += [(at, low_z) for at in range(high_x, low_x, -1)]
    way += [(low_x, at) for at in range(low_z, high_z)]
    for level, (cx, cz) in enumerate(way[: top - floor], floor):
        model[cx, cz, level + 1 : min(level + 4, top + 2)] = 0
        model[cx, cz, level] = block("planks")


def _door(model: np.ndarray, floor: int) -> None:
    """A door two blocks wide and three high in the south, with lamps and banners beside it."""
    x, z = KEEP[0] + DOOR, KEEP[1] + SIDE[1] - 1
    model[x : x + 2, z - 1 : z + 2, floor : floor + 3] = 0
    model[x : x + 2, z - 1 : z + 1, floor - 1] = block("gravel")
    model[x : x + 2, z + 1, floor + 3] = block("slate")
    for at in (x - 1, x + 2):
        model[at, z + 1, floor + 2] = block("lamp")
        model[at, z + 1, floor + 6 : floor + 11] = block("red cloth")
        model[at, z + 1, floor + 11] = block("oak log")


def hall(model: np.ndarray, floor: int) -> None:
    """Build a hall of bricks and timber with a steep roof of slate, open at the door, in place."""
    x, z, wide, deep = HALL
    model[x : x + wide, z : z + deep, floor - 1 : floor + 2] = block("dark brick")
    model[x : x + wide, z : z + deep, floor + 2 : floor + 5] = block("brick")
    for cx in (x, x + wide - 1):
        for cz in (z, z + deep - 1):
            model[cx, cz, floor : floor + 5] = block("oak log")
    _hall_roof(model, floor)
    _hall_inside(model, floor)

    # The chimney.
    model[x + 1, z + 1, floor : floor + 11] = block("dark brick")


def _hall_roof(model: np.ndarray, floor: int) -> None:
    """The steep roof of the hall, between two gables."""
    x, z, wide, deep = HALL
    for step in range(deep // 2 + 2):
        rows = (z - 1 + step, z + deep - step)
        gable = slice(rows[0] + 1, rows[1])
        model[x : x + wide, gable, floor + 5 + step] = block("brick")
        for row in rows:
            model[x - 1 : x + wide, row, floor + 4 + step : floor + 6 + step] = block("slate")


def _hall_inside(model: np.ndarray, floor: int) -> None:
    """The room of the hall: its door, its lamps and windows, a table."""
    x, z, wide, deep = HALL
    inside = (slice(x + 1, x + wide - 1), slice(z + 1, z + deep - 1))
    model[(*inside, slice(floor, floor + 5))] = 0
    model[(*inside, slice(floor - 1, floor))] = block("planks")
    south = z + deep - 1
    model[x + 3 : x + 5, south, floor : floor + 3] = 0
    for cx in (x + 1, x + wide - 3):
        model[cx, south, floor + 2 : floor + 4] = block("lamp")
    model[x + 3 : x + 5, z, floor + 2 : floor + 4] = block("pane")
    model[x + wide // 2, z + deep // 2, floor + 4] = block("lamp")
    model[x + 2 : x + 7, z + 1, floor] = block("planks")
