"""Trees: oak, birch, spruce and hawthorn, no two alike.

A crown is a handful of flattened blobs around branches, with the underside cut flat, so that one
sees the trunk and the branches below it; a few blocks are broken out of its corners. All sizes are
chosen, in blocks.
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
    """A round, broad crown in several masses; big ones fork into branches that show."""
    log, leaves = block("oak log"), block("oak leaves")
    big = rng.random() < BIG
    trunk = int(rng.integers(4, 6)) if big else int(rng.integers(3, 5))
    reach, size = (4.4, 2.9) if big else (1.9, 2.35)
    line(model, (MIDDLE, MIDDLE, 0), (MIDDLE, MIDDLE, trunk + 2), log)
    if big:
        model[MIDDLE : MIDDLE + 2, MIDDLE : MIDDLE + 2, : trunk + 1] = log
    limbs = 5 if big else 4
    turn = rng.random() * 2 * np.pi
    for number in range(limbs):
        angle = turn + 2 * np.pi * (number + 0.25 * rng.random()) / limbs
        far = reach * rng.uniform(0.75, 1.05)
        x, z = MIDDLE + far * np.cos(angle), MIDDLE + far * np.sin(angle)
        y = trunk + rng.uniform(1.2, 3.2 if big else 2.4)
        line(model, (MIDDLE, MIDDLE, trunk - int(rng.integers(0, 2))), (x, z, y), log)
        blob(model, (x, z, y + 0.6), (size, size, size * 0.62), leaves)
    top = trunk + (4.2 if big else 3.2)
    blob(model, (MIDDLE, MIDDLE, top), (size + 0.5, size + 0.5, size * 0.85), leaves)
    _break(model, leaves, rng, 0.30)


def _birch(model: np.ndarray, rng: np.random.Generator) -> None:
    """Slender and light: a narrow crown in uneven steps, with twigs that hang from it."""
    log, leaves = block("birch log"), block("birch leaves")
    height = int(rng.integers(7, 11))
    model[MIDDLE, MIDDLE, :height] = log
    low = int(rng.integers(3, 5))
    side = rng.uniform(-0.35, 0.35, 2)
    for y in range(low, height + 2):
        up = (y - low) / (height + 1 - low)
        radius = 0.7 + 1.45 * np.sin(np.pi * min(0.16 + 0.84 * up, 0.97)) + rng.uniform(-0.25, 0.3)
        x, z = MIDDLE + side + rng.uniform(-0.35, 0.35, 2)
        blob(model, (x, z, y), (radius, radius, 0.6), leaves, 2.0)
    model[MIDDLE, MIDDLE, height - 1 : height + 2] = leaves
    _break(model, leaves, rng, 0.32)
    # Twigs hang one or two blocks from the outermost leaves.
    for x, z, y in _undersides(model, leaves, rng, 4):
        model[x, z, max(y - int(rng.integers(1, 3)), 2) : y] = leaves


def _spruce(model: np.ndarray, rng: np.random.Generator) -> None:
    """A cone in tiers: each is a wide layer below a narrower one, and there is a tip."""
    log, needles = block("spruce log"), block("spruce needles")
    tiers = int(rng.integers(3, 6))
    y = int(rng.integers(1, 3))
    widest = 1.5 + 0.55 * tiers + rng.uniform(-0.2, 0.3)
    for tier in range(tiers):
        radius = widest * (1 - 0.78 * tier / tiers)
        for part, high in ((1.0, 1), (0.62, 1 + (tier % 2 == 0 and tiers < 5))):
            for level in range(y, y + high):
                x, z = np.ogrid[: ROOM[0], : ROOM[1]]
                dx, dz = np.abs(x - MIDDLE), np.abs(z - MIDDLE)
                r = max(radius * part, 0.8)
                plan = (dx + dz <= 1.28 * r) & (np.maximum(dx, dz) <= r)
                model[..., level][plan] = needles
            y += high
    model[MIDDLE, MIDDLE, :y] = log
    model[MIDDLE, MIDDLE, y - 3 : y + 2] = needles
    _break(model, needles, rng, 0.22)


def _hawthorn(model: np.ndarray, rng: np.random.Generator) -> None:
    """Low and wide on two crooked stems; half of them are in blossom, in clouds on the top."""
    log, leaves = block("hawthorn log"), block("hawthorn leaves")
    turn = rng.random() * 2 * np.pi
    model[MIDDLE, MIDDLE, :2] = log
    for number in range(3):
        angle = turn + 2 * np.pi * (number + 0.3 * rng.random()) / 3
        far = rng.uniform(1.5, 2.4)
        x, z = MIDDLE + far * np.cos(angle), MIDDLE + far * np.sin(angle)
        y = rng.uniform(2.6, 3.6)
        line(model, (MIDDLE, MIDDLE, 1), (x, z, y), log)
        blob(model, (x, z, y + 0.5), (2.2, 2.2, 1.25), leaves)
    blob(model, (MIDDLE, MIDDLE, 4.1), (2.3, 2.3, 1.5), leaves)
    _break(model, leaves, rng, 0.3)
    if rng.random() < 0.5:
        _blossom(model, leaves, rng)


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


def _break(model: np.ndarray, leaves: int, rng: np.random.Generator, chance: float) -> None:
    """Take away some of the leaves that have three neighbours or fewer: corners, never logs."""
    corners = (model == leaves) & (_neighbours(model > 0) <= 3)
    model[corners & (rng.random(model.shape) < chance)] = 0


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
