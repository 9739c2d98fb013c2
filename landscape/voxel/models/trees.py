"""Trees: oak, birch, spruce and hawthorn, no two alike.

A crown is a handful of flattened masses around the ends of branches, apart enough to let one see
the sky between them, and the trunk and the branches below; at their edges they thin out. All sizes
are chosen, in blocks.
"""

from collections.abc import Callable

import numpy as np

from landscape.voxel.blocks import block
from landscape.voxel.models.shapes import blob, joined, line, trimmed

ROOM = (21, 21, 24)  # the largest tree fits in, with its trunk in the middle
MIDDLE = 10
BIG = 0.22  # fraction of the oaks that are big


def tree(kind: str, rng: np.random.Generator) -> np.ndarray:
    """Return a tree of a kind named in ``KINDS``, uint8 [x, z, y].

    Its trunk is in the middle of its lowest level, which stands on the ground. ValueError names a
    kind that is unknown.
    """
    if kind not in KINDS:
        raise ValueError(f"tree {kind!r}: expected one of {', '.join(KINDS)}")
    model = np.zeros(ROOM, np.uint8)
    KINDS[kind](model, rng)
    logs = model == block(f"{kind} log")
    model[~joined(model > 0, logs)] = 0
    return trimmed(model)


def _oak(model: np.ndarray, rng: np.random.Generator) -> None:
    """A broad crown of several masses at the ends of branches, with the sky between them."""
    log, leaves = block("oak log"), block("oak leaves")
    big = rng.random() < BIG
    trunk = int(rng.integers(4, 7)) if big else int(rng.integers(3, 6))
    line(model, (MIDDLE, MIDDLE, 0), (MIDDLE, MIDDLE, trunk + 2), log)
    if big:
        model[MIDDLE : MIDDLE + 2, MIDDLE : MIDDLE + 2, : trunk + 1] = log
    limbs = int(rng.integers(5, 7)) if big else int(rng.integers(3, 6))
    turn = rng.random() * 2 * np.pi
    for number in range(limbs):
        angle = turn + 2 * np.pi * (number + rng.uniform(-0.2, 0.2)) / limbs
        far = (4.6 if big else 2.8) * rng.uniform(0.7, 1.1)
        size = (2.5 if big else 1.9) * rng.uniform(0.75, 1.15)
        x, z = MIDDLE + far * np.cos(angle), MIDDLE + far * np.sin(angle)
        y = trunk + rng.uniform(0.2, 3.6 if big else 2.4)
        line(model, (MIDDLE, MIDDLE, trunk - int(rng.integers(0, 2))), (x, z, y), log)
        blob(model, (x, z, y + 0.9), (size, size, 0.8 * size), leaves, 2.0)
    x, z = MIDDLE + rng.uniform(-0.8, 0.8, 2)
    size = rng.uniform(2.8, 3.4) if big else rng.uniform(2.1, 2.8)
    blob(model, (x, z, trunk + (4.8 if big else 3.6)), (size, size, 0.85 * size), leaves, 2.0)
    _thin(model, leaves, rng, 0.4)


def _birch(model: np.ndarray, rng: np.random.Generator) -> None:
    """Slender and light: small clumps around a trunk that shows, with twigs that hang from them."""
    log, leaves = block("birch log"), block("birch leaves")
    height = int(rng.integers(7, 13))
    model[MIDDLE, MIDDLE, :height] = log
    low = int(rng.integers(3, 5))
    turn = rng.random() * 2 * np.pi
    clumps = int(round((height - low) * 0.9))
    for number in range(clumps):
        up = number / max(clumps - 1, 1)
        # Clumps go around the trunk by about a third of a turn each, widest below the middle.
        angle = turn + 2.2 * number + rng.uniform(-0.4, 0.4)
        far = (0.4 + 1.0 * np.sin(np.pi * min(0.25 + 0.7 * up, 0.95))) * rng.uniform(0.7, 1.1)
        x, z = MIDDLE + far * np.cos(angle), MIDDLE + far * np.sin(angle)
        y = low + up * (height - low)
        size = 1.85 - 0.45 * up
        blob(model, (x, z, y), (size, size, 1.1), leaves, 2.0)
    model[MIDDLE, MIDDLE, height : height + 2] = leaves
    _thin(model, leaves, rng, 0.25)
    # Twigs hang one or two blocks from the outermost leaves.
    for x, z, y in _undersides(model, leaves, rng, 5):
        model[x, z, max(y - int(rng.integers(1, 3)), 2) : y] = leaves


def _spruce(model: np.ndarray, rng: np.random.Generator) -> None:
    """A slender cone: wide whorls of branches with the trunk between them, up to a pointed tip."""
    log, needles = block("spruce log"), block("spruce needles")
    x, z = np.ogrid[: ROOM[0], : ROOM[1]]
    dx, dz = np.abs(x - MIDDLE), np.abs(z - MIDDLE)
    whorls = int(rng.integers(3, 6))
    y = int(rng.integers(1, 4))
    for whorl in range(whorls):
        wide = 0.8 + (whorls - whorl) * rng.uniform(0.62, 0.85)
        for part in (1.0, 0.66, 0.2):
            r = max(wide * part, 1.0 if part > 0.5 else 0.0)
            plan = (dx + dz <= 1.35 * r) & (np.maximum(dx, dz) <= r)
            model[..., y][plan] = needles
            y += 1
    _thin(model, needles, rng, 0.3)
    model[MIDDLE, MIDDLE, : y - 4] = log
    model[MIDDLE, MIDDLE, y - 4 : y] = needles
    model[MIDDLE, MIDDLE, y] = block("spruce tip")


def _hawthorn(model: np.ndarray, rng: np.random.Generator) -> None:
    """Low and wide on crooked stems; half of them are in blossom, in clouds on the top."""
    log, leaves = block("hawthorn log"), block("hawthorn leaves")
    turn = rng.random() * 2 * np.pi
    tall = rng.uniform(2.2, 3.6)
    model[MIDDLE, MIDDLE, :2] = log
    stems = int(rng.integers(2, 5))
    for number in range(stems):
        angle = turn + 2 * np.pi * (number + 0.3 * rng.random()) / stems
        far = rng.uniform(1.4, 2.8)
        x, z = MIDDLE + far * np.cos(angle), MIDDLE + far * np.sin(angle)
        y = tall + rng.uniform(-0.4, 0.8)
        line(model, (MIDDLE, MIDDLE, 1), (x, z, y), log)
        size = rng.uniform(1.5, 2.2)
        blob(model, (x, z, y + 0.6), (size, size, 0.75 * size), leaves, 2.0)
    blob(model, (MIDDLE, MIDDLE, tall + 1.3), (1.8, 1.8, 1.4), leaves, 2.0)
    _thin(model, leaves, rng, 0.35)
    if rng.random() < 0.5:
        _blossom(model, leaves, rng)


def bush(rng: np.random.Generator) -> np.ndarray:
    """Return a bush of a few blocks of leaves that stands on the ground, uint8 [x, z, y]."""
    model = np.zeros((7, 7, 3), np.uint8)
    leaves = block(str(rng.choice(["oak leaves", "hawthorn leaves", "birch leaves"])))
    for _ in range(int(rng.integers(1, 4))):
        x, z = 3 + rng.uniform(-1.2, 1.2, 2)
        size = rng.uniform(0.7, 1.3)
        blob(model, (x, z, 0.0), (size, size, rng.uniform(0.6, 1.3)), leaves, 2.0)
    return model


def _blossom(model: np.ndarray, leaves: int, rng: np.random.Generator) -> None:
    """Turn clouds of leaves into blossom, most of them where the sky is above."""
    x, z, y = (axis.astype(float) for axis in np.nonzero(model == leaves))
    share = np.zeros(len(x))
    for _ in range(5):
        at = int(rng.integers(len(x)))
        near = (x - x[at]) ** 2 + (z - z[at]) ** 2 + (y - y[at]) ** 2 < 3.2
        share[near] = 0.9
    top = y >= np.quantile(y, 0.6)
    flowers = rng.random(len(x)) < np.maximum(share, np.where(top, 0.35, 0.08))
    cells = tuple(axis[flowers].astype(int) for axis in (x, z, y))
    model[cells] = block("hawthorn blossom")


def _neighbours(cells: np.ndarray) -> np.ndarray:
    """Return how many of its six neighbours each cell has, int (a, b, c); the margin is empty."""
    counts = np.zeros(cells.shape, int)
    for axis in range(3):
        for step in (-1, 1):
            counts += np.roll(cells, step, axis)
    return counts


def _thin(model: np.ndarray, leaves: int, rng: np.random.Generator, chance: float) -> None:
    """Take away leaves at the edge of a crown, never logs: more of them the fewer neighbours."""
    for fewest, share in ((4, 0.3), (3, 1.0)):
        edge = (model == leaves) & (_neighbours(model > 0) <= fewest)
        model[edge & (rng.random(model.shape) < share * chance)] = 0


def _undersides(
    model: np.ndarray, leaves: int, rng: np.random.Generator, count: int
) -> list[tuple[int, int, int]]:
    """Return some cells of leaves with nothing below, away from the trunk."""
    here = model == leaves
    here[..., 1:] &= model[..., :-1] == 0
    here[MIDDLE, MIDDLE] = False
    cells = np.argwhere(here)
    chosen = rng.permutation(len(cells))[:count]
    return [(int(x), int(z), int(y)) for x, z, y in cells[chosen]]


KINDS: dict[str, Callable[[np.ndarray, np.random.Generator], None]] = {
    "oak": _oak,
    "birch": _birch,
    "spruce": _spruce,
    "hawthorn": _hawthorn,
}
