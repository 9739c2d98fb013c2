"""Individuals: several pictures of each species of tree and of the deer, and who stands where.

With ``trees.variety`` a tree is one of several of its species, young or grown, and groups have
saplings and bushes at their edges; with ``deer.variety`` deer also graze, and stay on grass. The
cells of :mod:`planting` still say which species a sprite is; its picture has a cell of its own. No
OpenGL here.
"""

import numpy as np

from landscape.elements.atlas import CELLS, COLUMNS
from landscape.elements.best.sprites.woods import drifts_of, outward
from landscape.elements.planting import DEER, Chance
from landscape.elements.settings import Settings
from landscape.elements.sprite_names import HERBS, MORE, MORE_FILES

# The cells of trees and deer have the first individual; the others follow the herbs.
FIRST = ("oak_old.png", "spruce_old.png", "birch_twin.png", "thorn.png", "stag.png", "doe.png")
CONTACT = 15  # a cell that no picture has: the soft shadow at the feet
ROWS = 8
CELL_COUNT = COLUMNS * ROWS
(
    OAK_LEANING,
    OAK_TALL,
    OAK_YOUNG,
    HAZEL,
    BIRCH_TALL,
    BIRCH_YOUNG,
    PINE,
    SPRUCE_YOUNG,
    BRAMBLE,
    STAG_WALKING,
    DOE_GRAZING,
) = range(MORE, MORE + len(MORE_FILES))
OAK, SPRUCE, BIRCH, THORN = range(4)

# Chosen, by species: its grown individuals, and what stands around them.
GROWN = (
    (OAK, OAK_LEANING, OAK_TALL, OAK),
    (SPRUCE, SPRUCE, PINE, SPRUCE_YOUNG),
    (BIRCH, BIRCH_TALL, BIRCH_TALL, BIRCH),
    (THORN, THORN, HAZEL, THORN),
)
AROUND = (
    (OAK_YOUNG, HAZEL, BRAMBLE, HAZEL),
    (SPRUCE_YOUNG, SPRUCE_YOUNG, BRAMBLE, BIRCH_YOUNG),
    (BIRCH_YOUNG, HAZEL, BRAMBLE, BIRCH_YOUNG),
    (BRAMBLE, HAZEL, BRAMBLE, BRAMBLE),
)
POSES = ((DEER, STAG_WALKING), (DEER + 1, DOE_GRAZING, DOE_GRAZING))
# Chosen, times trees.size_max: the least and greatest height of a grown tree and of a young one,
# and of the cells of bushes, whose pictures leave room above.
TALL = (0.62, 1.12)
YOUNG = (0.32, 0.72)
BUSHY = (0.30, 0.62)
STATURE = {PINE: 1.06, BIRCH_TALL: 1.0, OAK_TALL: 1.1, THORN: 0.66, BRAMBLE: 0.9}  # chosen
UNDERGROWTH = 0.34  # chosen: fraction of all trees that are young, or bushes
NEAR = (0.05, 0.34)  # units, chosen: how far these are from the tree that they are beside
GROUPS = 131  # chosen: number of the pattern of groups within woods, see woods.drifts_of


def files(settings: Settings) -> tuple[str, ...]:
    """Return the names of the atlas's pictures in the order of :func:`cells_of`."""
    trees_vary = settings.trees.variety and settings.trees.grouped
    variety = trees_vary or settings.deer.variety
    herbs = HERBS if variety or settings.plants.species > 1 else ()
    trees = FIRST[:DEER] if trees_vary else CELLS[:DEER]
    deer = FIRST[DEER:] if settings.deer.variety else CELLS[DEER : len(FIRST)]
    return (*trees, *deer, *CELLS[len(FIRST) :], *herbs, *(MORE_FILES if variety else ()))


def contact_picture(side: int) -> np.ndarray:
    """Return the shadow at the feet, uint8 (side, side, 4): dark, opaque in the middle, soft."""
    at = (np.arange(side) + 0.5) / side * 2.0 - 1.0
    away = np.clip(np.hypot(*np.meshgrid(at, at)), 0.0, 1.0)
    picture = np.zeros((side, side, 4), np.uint8)
    picture[..., :3] = (20, 24, 12)  # chosen: the green of grass in deep shade
    picture[..., 3] = np.rint(255 * (1.0 - away) ** 1.5 * (1.0 + 0.5 * away))
    return picture


def cells_of(pictures: list[np.ndarray]) -> list[np.ndarray]:
    """Return the cells of an atlas of all ``pictures``: free ones between the herbs and MORE."""
    herbs_end = len(CELLS) + len(HERBS)
    free = np.zeros_like(pictures[0])
    cells = [*pictures[: len(CELLS)], free, *pictures[len(CELLS) : herbs_end]]
    cells += [free] * (CONTACT - len(cells))
    cells += [contact_picture(len(free)), *pictures[herbs_end:]]
    return cells + [free] * (CELL_COUNT - len(cells))


def in_groups(suits: Chance, woods: Chance, seed: int) -> Chance:
    """Return where trees stand in groups with gaps between, and few stand alone."""
    groups = drifts_of(seed, GROUPS)

    def chance(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        return np.asarray(suits(x, z) * woods(x, z) ** 0.5 * (0.10 + 0.90 * groups(x, z) ** 0.5))

    return chance


def individuals(cells: np.ndarray, young: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Return the picture (n,) of each tree of species ``cells`` (n,), ``young`` (n,) or grown."""
    choices = np.array([GROWN, AROUND])
    return np.asarray(choices[young.astype(int), cells, rng.integers(4, size=len(cells))])


def beside(
    positions: np.ndarray,
    cells: np.ndarray,
    suits: Chance,
    woods: Chance,
    rng: np.random.Generator,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Move some trees (n, 3) beside others, most of them to the outer side of the wood.

    Returns the positions, whose heights are then wrong, the species (n,) of the neighbour, and
    which were moved (n,).
    """
    n = len(positions)
    moved = np.zeros(n, bool)
    moved[n - int(UNDERGROWTH * n) :] = True
    if moved.all() or not moved.any():
        return positions, cells, np.zeros(n, bool)
    which = np.flatnonzero(moved)
    host = rng.integers(n - len(which), size=len(which))
    x, z = positions[host][:, [0, 2]].T
    angle = outward(woods, x, z) + rng.normal(0.0, 0.9, len(which))
    away = rng.uniform(*NEAR, len(which))
    there = np.stack([x + away * np.cos(angle), z + away * np.sin(angle)], axis=1)
    fits = suits(*there.T) > 0.0
    positions, cells = positions.copy(), cells.copy()
    positions[which[fits][:, None], [0, 2]] = there[fits]
    cells[which] = cells[host]
    return positions, cells, moved


def statures(
    pictures: np.ndarray,
    young: np.ndarray,
    density: np.ndarray,
    size_max: float,
    rng: np.random.Generator,
) -> np.ndarray:
    """Return sizes (n, 2) = width, height in units; trees are taller where woods are dense."""
    n = len(pictures)
    bush = np.isin(pictures, (HAZEL, BRAMBLE))
    low, high = np.array([TALL, YOUNG, BUSHY])[np.where(bush, 2, young.astype(int))].T
    depth = np.clip(1.2 * density, 0.0, 1.0)
    fraction = np.clip(rng.beta(1.8, 1.8, n) * (0.55 + 0.60 * depth), 0.0, 1.0)
    heights = size_max * (low + (high - low) * fraction)
    for picture, factor in STATURE.items():
        heights *= np.where(pictures == picture, factor, 1.0)
    return np.stack([heights * rng.uniform(0.86, 1.12, n), heights], axis=1)


def poses(cells: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Return the picture (n,) of each deer, by its atlas cell (n,)."""
    draw = rng.random(len(cells))
    out = np.empty(len(cells), np.int64)
    for cell, own in zip((DEER, DEER + 1), POSES, strict=True):
        out = np.where(cells == cell, np.array(own)[(draw * len(own)).astype(int)], out)
    return out
