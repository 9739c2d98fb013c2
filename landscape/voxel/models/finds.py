"""Small things to come upon: a ruined tower, a jetty with a boat, a stone circle, a beacon, a well.

Each has a foundation, so that it may stand on uneven ground: the ground's first free level is the
floor given with it. The jetty runs from the middle of the model to the east, +x. All sizes are
chosen, in blocks.
"""

import numpy as np

from landscape.voxel.blocks import block
from landscape.voxel.models.shapes import blob, disc, line

FLOOR = 4  # the level of the ground in the ruin, the stone circle, the beacon and the well
DECK = 6  # the level just above the sea in the jetty, whose posts go below it
BOAT = 12  # columns that the boat takes from the land end on


def _jagged(plan: tuple[int, int], rng: np.random.Generator) -> np.ndarray:
    """Return how high a ruined wall stands in each column [x, z], in blocks.

    It is highest in one direction, and falls off on either side of it in jagged steps.
    """
    x, z = np.ogrid[: plan[0], : plan[1]]
    turn = rng.uniform(-0.5, 0.5)
    angle = np.arctan2(z - 7.0, x - 7.0) - turn
    return np.asarray(5.5 + 4.5 * np.cos(angle) + rng.uniform(-0.9, 0.9, plan))


def ruin(rng: np.random.Generator) -> np.ndarray:
    """Return a round tower, its top fallen in, with ivy, rubble and half a flight of stairs."""
    model = np.zeros((15, 15, FLOOR + 14), np.uint8)
    plan, middle = (15, 15), (7, 7)
    wall = disc(plan, middle, 4.4) & ~disc(plan, middle, 3.1)
    model[..., : FLOOR - 1][disc(plan, middle, 4.4)] = block("rock")
    model[..., FLOOR - 1][disc(plan, middle, 3.1)] = block("gravel")
    tops = _jagged(plan, rng)
    level = np.arange(model.shape[2])
    standing = wall[..., None] & (level < FLOOR + np.rint(tops)[..., None])
    model[standing] = block("brick")
    model[standing & (rng.random(model.shape) < 0.22)] = block("dark brick")
    model[..., : FLOOR + 1][wall] = block("dark brick")

    # A door to the west, where it is lowest, and a window high up in the east.
    model[2:5, 6:8, FLOOR : FLOOR + 3] = 0
    model[10:12, 7, FLOOR + 5 : FLOOR + 7] = 0
    way = [(5, 9), (6, 10), (7, 10), (8, 10), (9, 9), (10, 8), (10, 7), (10, 6)]
    for step, (cx, cz) in enumerate(way[:6]):
        model[cx, cz, FLOOR : FLOOR + step + 1] = block("brick")

    _let_ivy_hang(model, disc(plan, middle, 5.4) & ~disc(plan, middle, 4.4), rng)

    # What has fallen lies around.
    for cx, cz in np.argwhere(~disc(plan, middle, 5.4) & disc(plan, middle, 7.3)):
        if rng.random() < 0.14:
            model[cx, cz, FLOOR - 2 : FLOOR + int(rng.integers(0, 2))] = block("brick")
    model[7, 7, FLOOR - 1] = block("lamp")
    return model


def _let_ivy_hang(model: np.ndarray, outer: np.ndarray, rng: np.random.Generator) -> None:
    """Let ivy hang down the wall in some of the columns ``outer`` [x, z], in place."""
    plan, middle = outer.shape, (7, 7)
    for cx, cz in np.argwhere(outer & (rng.random(plan) < 0.4)):
        inward = np.rint((np.array(middle) - (cx, cz)) / 5.0).astype(int)
        behind = np.flatnonzero(model[cx + inward[0], cz + inward[1]] > 0)
        if len(behind) and behind[-1] > FLOOR + 1:
            top = int(behind[-1]) + 1
            model[cx, cz, max(top - int(rng.integers(2, 6)), FLOOR) : top] = block("oak leaves")


def jetty(length: int = 13) -> np.ndarray:
    """Return a jetty of planks on posts, with a lamp at its end, and a boat moored beside it.

    The land end is at the middle of the model, a block above DECK, the sea's first free level.
    """
    start, z = max(length, BOAT), 7
    model = np.zeros((2 * start + 1, 15, DECK + 12), np.uint8)
    model[start - 2 : start + length, z - 1 : z + 1, DECK] = block("planks")
    model[start + length - 4 : start + length, z - 2 : z + 2, DECK] = block("planks")
    for cx in range(start + 1, start + length, 4):
        for cz in (z - 2, z + 1):
            model[cx, cz, : DECK + 2] = block("oak log")
    end = start + length - 1
    model[end, z - 2, : DECK + 4] = block("spruce log")
    model[end, z - 2, DECK + 4] = block("lamp")
    # Fish boxes, and a coil of rope.
    model[end, z + 1, DECK + 1] = block("spruce log")
    _boat(model, start + 3, z + 4)
    return model


def _boat(model: np.ndarray, x: int, z: int) -> None:
    """Build a boat with its sail set and its bow to the east, in place."""
    halves = (1, 1, 1, 1, 1, 1, 0, 0)  # half widths from the stern to the bow
    for step, half in enumerate(halves):
        model[x + step, z - half : z + half + 1, DECK - 1] = block("spruce log")
        rim = (z - half - 1, z + half + 1) if 0 < step < len(halves) - 1 else (z - half, z + half)
        for cz in rim:
            model[x + step, cz, DECK] = block("planks")
    last = len(halves)
    model[x + last, z, DECK : DECK + 2] = block("planks")
    model[x, z - 1 : z + 2, DECK] = block("planks")
    model[x + 1, z - 1 : z + 2, DECK] = block("planks")
    model[x + 4, z, DECK : DECK + 8] = block("oak log")
    for up in range(5):
        model[x + 3 - (5 - up) // 2 : x + 4, z, DECK + 2 + up] = block("light fur")
    model[x + 1 : x + 4, z, DECK + 2] = block("oak log")
    model[x + 5, z, DECK + 7] = block("red cloth")


def stone_circle(rng: np.random.Generator) -> np.ndarray:
    """Return nine standing stones of unequal height, two with a lintel, around a flat one."""
    model = np.zeros((19, 19, FLOOR + 7), np.uint8)
    count = 9
    turn = rng.random() * 2 * np.pi
    tall = rng.integers(3, 6, count)
    tall[:2] = 5
    gate = []
    for k in range(count):
        angle = turn + 2 * np.pi * k / count + rng.uniform(-0.06, 0.06) * (k > 1)
        x, z = np.rint(9 + 7 * np.cos(angle)), np.rint(9 + 7 * np.sin(angle))
        cx, cz = int(x), int(z)
        # Broader along the circle, and one of them has fallen.
        ax, az = (0, 1) if abs(np.cos(angle)) > abs(np.sin(angle)) else (1, 0)
        model[cx, cz, : FLOOR + int(tall[k])] = block("rock")
        if k == 5:
            model[cx, cz, FLOOR + 1 :] = 0
            hx, hz = 9 + 0.45 * (cx - 9), 9 + 0.45 * (cz - 9)
            for level in range(FLOOR + 1):
                line(model, (cx, cz, level), (hx, hz, level), block("rock"))
            continue
        top = FLOOR + int(tall[k]) - int(rng.integers(0, 2)) * (k > 1)
        model[cx + ax, cz + az, :top] = block("rock")
        if k < 2:
            gate.append((cx, cz, FLOOR + 5))

    line(model, gate[0], gate[1], block("rock"))
    model[8:11, 8:11, : FLOOR + 1] = block("rock")
    model[9, 9, FLOOR + 1] = block("lamp")
    ring = disc((19, 19), (9, 9), 5.6)
    free = ring & (model[..., FLOOR] == 0)
    model[..., FLOOR - 1][free & (rng.random(ring.shape) < 0.25)] = block("gravel")
    model[..., FLOOR][free & (rng.random(ring.shape) < 0.2)] = block("heather")
    return model


def beacon() -> np.ndarray:
    """Return a beacon: a round shaft on a stone foot, lamps between posts under a slate roof."""
    model = np.zeros((11, 11, FLOOR + 18), np.uint8)
    plan, middle = (11, 11), (5, 5)
    model[..., : FLOOR + 1][disc(plan, middle, 4.6)] = block("rock")

    shaft = disc(plan, middle, 2.4)
    model[..., FLOOR : FLOOR + 8][shaft] = block("brick")
    model[..., FLOOR : FLOOR + 2][shaft] = block("dark brick")
    model[..., FLOOR + 7][disc(plan, middle, 3.3)] = block("dark brick")
    model[5, 7, FLOOR + 1 : FLOOR + 4] = block("planks")
    for x, z, level in ((7, 5, 4), (5, 3, 5), (3, 5, 3)):
        model[x, z, FLOOR + level : FLOOR + level + 2] = block("dark")

    model[4:7, 8:10, FLOOR + 1] = block("rock")
    model[5, 8, FLOOR + 1] = 0

    # Lamps between posts, under the roof.
    for x in (3, 7):
        for z in (3, 7):
            model[x, z, FLOOR + 8 : FLOOR + 12] = block("oak log")
    model[4:7, 4:7, FLOOR + 8] = block("dark brick")
    model[4:7, 4:7, FLOOR + 9 : FLOOR + 11] = block("lamp")
    for step, wide in enumerate((3.6, 2.9, 2.2, 1.5, 0.5)):
        model[..., FLOOR + 12 + step][disc(plan, middle, wide)] = block("slate")
    return model


def boulder(rng: np.random.Generator) -> np.ndarray:
    """Return a boulder of one to a dozen blocks, sunk a block into the ground."""
    model = np.zeros((7, 7, 4), np.uint8)
    size = rng.uniform(0.7, 1.8)
    for _ in range(2):
        x, z = 3 + rng.uniform(-0.7, 0.7, 2)
        blob(model, (x, z, 1.0), (size, size * rng.uniform(0.7, 1.0), 0.8 * size), block("rock"))
    return model


def well() -> np.ndarray:
    """Return a well with a roof of slate on two posts, and a bench beside it."""
    model = np.zeros((9, 7, FLOOR + 6), np.uint8)
    x, z = 4, 3
    model[2:7, 1:6, FLOOR - 1] = block("gravel")
    model[x - 1 : x + 2, z - 1 : z + 2, : FLOOR + 1] = block("dark brick")
    model[x, z, 1 : FLOOR + 1] = 0
    model[x, z, 0] = block("dark")
    for cx in (x - 1, x + 1):
        model[cx, z, FLOOR + 1 : FLOOR + 4] = block("oak log")
    model[x - 2 : x + 3, z - 1 : z + 2, FLOOR + 4] = block("slate")
    model[x - 1 : x + 2, z, FLOOR + 5] = block("slate")
    model[x, z, FLOOR + 3] = block("lamp")
    model[7, 2:5, FLOOR] = block("planks")
    return model
