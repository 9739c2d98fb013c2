"""Trees: oak, birch, spruce and hawthorn, no two alike.

A crown is a handful of rounded masses around the top of a bare trunk one block thick; at their
edges they thin out. No branch leaves the crown: a log is as thick as a trunk, and one that stuck
out would look like a beam. All sizes are chosen, in blocks.
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
    """A deep, round crown of several masses on a bare trunk; the limbs are within the leaves."""
    log, leaves = block("oak log"), block("oak leaves")
    big = rng.random() < BIG
    trunk = int(rng.integers(5, 7)) if big else int(rng.integers(3, 6))
    limbs = int(rng.integers(4, 6)) if big else 3
    turn = rng.random() * 2 * np.pi
    size = rng.uniform(3.4, 4.0) if big else rng.uniform(2.5, 3.1)
    x, z = MIDDLE + rng.uniform(-0.5, 0.5, 2)
    middle = trunk + 0.8 * size
    blob(model, (x, z, middle), (size, size, 1.05 * size), leaves, 2.0)
    for number in range(limbs):
        angle = turn + 2 * np.pi * (number + rng.uniform(-0.2, 0.2)) / limbs
        far = (3.4 if big else 1.9) * rng.uniform(0.8, 1.15)
        wide = 0.62 * size * rng.uniform(0.9, 1.15)
        x, z = MIDDLE + far * np.cos(angle), MIDDLE + far * np.sin(angle)
        y = middle + rng.uniform(-0.25, 0.3) * size
        blob(model, (x, z, y), (wide, wide, 0.8 * wide), leaves, 2.0)

    _thin(model, leaves, rng, 0.4)
    for number in range(limbs if big else 0):
        angle = turn + 2 * np.pi * number / limbs
        x, z = MIDDLE + 2.6 * np.cos(angle), MIDDLE + 2.6 * np.sin(angle)
        _limb(model, (MIDDLE, MIDDLE, trunk + 1), (x, z, middle + 0.5), log)

    model[MIDDLE, MIDDLE, : int(middle) + 1] = log


def _birch(model: np.ndarray, rng: np.random.Generator) -> None:
    """Slender and light: clumps all around a white trunk that shows below and between them."""
    log, leaves = block("birch log"), block("birch leaves")
    height = int(rng.integers(8, 13))
    low = int(rng.integers(3, 5))
    y = low + 0.8
    turn = rng.random() * 2 * np.pi
    while y < height + 1:
        up = (y - low) / (height - low)
        # Rings around the trunk, widest below the middle, each a little out of true.
        size = (1.6 + 0.75 * np.sin(np.pi * min(0.25 + 0.65 * up, 0.95))) * rng.uniform(0.9, 1.1)
        turn += 2.2
        x, z = MIDDLE + 0.45 * np.cos(turn), MIDDLE + 0.45 * np.sin(turn)
        blob(model, (x, z, y), (size, size, 1.3), leaves, 2.0)
        y += rng.uniform(1.7, 2.5)

    blob(model, (MIDDLE, MIDDLE, height + 0.6), (1.2, 1.2, 1.7), leaves, 2.0)
    _thin(model, leaves, rng, 0.3)

    # Twigs hang one or two blocks from the outermost leaves.
    for twig_x, twig_z, end in _undersides(model, leaves, rng, 5):
        model[twig_x, twig_z, max(end - int(rng.integers(1, 3)), 3) : end] = leaves
    model[MIDDLE, MIDDLE, :height] = log


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
    """Low, wide and round on a short stem; half of them are in blossom, in clouds on the top."""
    log, leaves = block("hawthorn log"), block("hawthorn leaves")
    turn = rng.random() * 2 * np.pi
    stem = int(rng.integers(3, 5))
    size = rng.uniform(1.9, 2.5)
    blob(model, (MIDDLE, MIDDLE, stem + 0.7 * size), (size, size, size), leaves, 2.0)
    masses = int(rng.integers(3, 5))
    for number in range(masses):
        angle = turn + 2 * np.pi * (number + 0.3 * rng.random()) / masses
        far = rng.uniform(1.3, 2.3)
        x, z = MIDDLE + far * np.cos(angle), MIDDLE + far * np.sin(angle)
        wide = rng.uniform(1.4, 2.0)
        y = stem + rng.uniform(0.7, 2.0)
        blob(model, (x, z, y), (wide, wide, 0.85 * wide), leaves, 2.0)
    _thin(model, leaves, rng, 0.35)
    model[MIDDLE, MIDDLE, : stem + 2] = log
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
    for _ in range(4):
        at = int(rng.integers(len(x)))
        near = (x - x[at]) ** 2 + (z - z[at]) ** 2 + (y - y[at]) ** 2 < 3.2
        share[near] = 0.75
    top = y >= np.quantile(y, 0.6)
    flowers = rng.random(len(x)) < np.maximum(share, np.where(top, 0.3, 0.08))
    cells = tuple(axis[flowers].astype(int) for axis in (x, z, y))
    model[cells] = block("hawthorn blossom")


def _limb(
    model: np.ndarray,
    start: tuple[float, float, float],
    end: tuple[float, float, float],
    log: int,
) -> None:
    """Make leaves along a line to logs, as far as leaves are on all sides of them."""
    limb = np.zeros_like(model)
    line(limb, start, end, log)
    inside = (model > 0) & (_neighbours(model > 0) == 6)
    model[joined((limb > 0) & inside, _column(model))] = log


def _column(model: np.ndarray) -> np.ndarray:
    """Return where the trunk is or will be, bool [x, z, y]."""
    found = np.zeros(model.shape, bool)
    found[MIDDLE, MIDDLE] = True
    return found


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
