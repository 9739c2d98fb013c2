"""Where plants and trees grow: flowers in drifts, trees in groves with clearings.

Each kind has a smooth random field of its own. Where it is high, the kind is at home; so one finds
patches of poppies and glades, not white noise.
"""

import numpy as np

from landscape.voxel.blocks import block
from landscape.voxel.materials import variation

# All chosen. Kind, size of its patches in columns, how much of the land they cover, how densely it
# grows in them.
PLANTS = (
    ("tall grass", 15.0, 0.32, 0.34),
    ("fern", 12.0, 0.07, 0.28),
    ("heather", 18.0, 0.07, 0.42),
    ("buttercup", 12.0, 0.07, 0.28),
    ("cornflower", 11.0, 0.06, 0.28),
    ("poppy", 12.0, 0.07, 0.32),
    ("daisies", 10.0, 0.08, 0.28),
    ("bush", 26.0, 0.12, 0.03),
)
REEDS = ("reeds", 13.0, 0.2, 0.30)  # the same, of the shore
SPARSE = 0.008  # chosen: how many of the other columns have grass
GROVE = 46.0  # columns, size of the largest groves, chosen
WOODED = 0.34  # fraction of the places that groves cover, chosen
SPACING = {"oak": 7.5, "birch": 5.0, "spruce": 6.0, "hawthorn": 6.0}  # columns, chosen
LONE = 0.0012  # chance that a place outside the groves has a tree, chosen
HIGH = 0.55  # of the land's relief: from here up spruces prevail, chosen


def plants(places: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Return the plant in each column, uint8 (n, n) block numbers, 0 where there is none.

    ``places`` (n, n) bool says where plants may grow.
    """
    side = len(places)
    found = np.zeros(places.shape, np.uint8)
    found[rng.random(places.shape) < SPARSE] = block("tall grass")
    for kind in PLANTS:
        found[_patches(side, kind, rng)] = block(kind[0])
    found[~places] = 0
    return found


def reeds(places: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Return in which of the ``places`` (n, n) on the shore reeds grow, bool."""
    return np.asarray(places & _patches(len(places), REEDS, rng))


def _patches(
    side: int, kind: tuple[str, float, float, float], rng: np.random.Generator
) -> np.ndarray:
    """Return the columns (side, side) of a kind of PLANTS, bool."""
    _, size, cover, density = kind
    field = variation(side, size, rng)
    edge = np.quantile(field, 1 - cover)
    # Denser towards the middle of a patch, so that it thins out at its border.
    inside = np.clip((field - edge) / max(float(field.max()) - edge, 1e-6), 0, 1)
    return np.asarray(rng.random(field.shape) < density * 2 * inside**0.7)


def forest(
    places: np.ndarray, ground: np.ndarray, rng: np.random.Generator
) -> list[tuple[str, int, int]]:
    """Choose trees: (kind, x, z) of each, with room between them.

    ``places`` (n, n) bool says where a trunk may stand; ``ground`` (n, n) is the height of the
    land in blocks, by which the kinds are chosen: spruces up high, birches at the groves' edges,
    oaks within them, hawthorns alone in the open.
    """
    side = len(places)
    if not places.any():
        return []
    groves = variation(side, GROVE, rng)
    edge = np.quantile(groves[places], 1 - WOODED)
    depth = (groves - edge) / max(float(groves.max()) - edge, 1e-6)
    low, high = (float(limit) for limit in np.quantile(ground[places], (0.02, 0.995)))
    above = (ground - low) / max(high - low, 1e-6) + 0.18 * variation(side, 30.0, rng)
    chance = np.where(depth > 0, 0.06 + 0.10 * np.clip(depth, 0, 1), LONE)
    candidates = np.argwhere(places & (rng.random(places.shape) < chance))
    rng.shuffle(candidates)
    luck = rng.random(len(candidates))
    taken = np.zeros((side, side), bool)
    found = []
    for (x, z), pick in zip(candidates.tolist(), luck.tolist(), strict=True):
        kind = _kind(float(depth[x, z]), float(above[x, z]), pick)
        reach = int(np.ceil(SPACING[kind]))
        near = taken[max(x - reach, 0) : x + reach + 1, max(z - reach, 0) : z + reach + 1]
        others = np.argwhere(near) + (max(x - reach, 0), max(z - reach, 0))
        if len(others) and ((others - (x, z)) ** 2).sum(axis=1).min() < SPACING[kind] ** 2:
            continue
        taken[x, z] = True
        found.append((kind, x, z))

    return found


def _kind(depth: float, above: float, pick: float) -> str:
    """Return the kind of tree at a depth into a grove (0 is its edge), a height and a 0..1."""
    if above > HIGH:
        return "spruce" if pick < 0.85 else "birch"
    if depth < 0:
        return "hawthorn" if pick < 0.5 else "oak" if pick < 0.8 else "birch"
    if depth < 0.22:
        return "birch" if pick < 0.55 else "hawthorn" if pick < 0.72 else "oak"
    return "oak" if pick < 0.80 else "birch" if pick < 0.90 else "spruce"
