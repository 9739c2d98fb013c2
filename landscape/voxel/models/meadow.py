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
    ("tall grass", 22.0, 0.45, 0.20),
    ("fern", 16.0, 0.12, 0.16),
    ("heather", 26.0, 0.12, 0.30),
    ("buttercup", 18.0, 0.14, 0.13),
    ("cornflower", 15.0, 0.10, 0.13),
    ("poppy", 17.0, 0.13, 0.16),
)
SPARSE = 0.012  # chosen: how many of the other columns have grass
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
    for name, size, cover, density in PLANTS:
        field = variation(side, size, rng)
        edge = np.quantile(field, 1 - cover)
        # Denser towards the middle of a patch, so that it thins out at its border.
        inside = np.clip((field - edge) / max(float(field.max()) - edge, 1e-6), 0, 1)
        found[rng.random(places.shape) < density * 2 * inside**0.7] = block(name)
    found[~places] = 0
    return found


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
