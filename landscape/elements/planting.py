"""Where trees, deer and plants are: random places all over the land (section 5.1.2).

Places are uniform over the map, and drawn again if they are on water. The random numbers are
seeded: the same seed gives the same island. Woods, meadows and several kinds of herb are in
``elements/best/sprites/refined_planting.py``. No OpenGL here.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from landscape.elements.settings import Deer, Plants, Settings, Trees
from landscape.geometry.height_field import HeightField

KINDS = ("trees", "deer", "plants")
DEER, PLANT = 4, 6  # the first atlas cell of each kind; trees start at 0
# Chosen: radius of what stops a walker, times the picture's width, by atlas cell: trunks, the dense
# lower branches of conifers, and the bodies of deer.
THICK = (0.05, 0.12, 0.05, 0.09, 0.25, 0.25)
SHORE = 0.02  # chosen: units above the water where the first sprite may stand
CASTLE = 1.1  # chosen: units from the castle's centre to its farthest corner
COURT = 2.2  # chosen: radius in units around the castle's centre kept free of trees
BATCHES = 200  # chosen: most rounds of random places tried to place the sprites
HOPELESS = 10_000  # chosen: a batch of more places, none of them suitable, ends the search
# Chosen: x, z of the first deer. One is by the bay's plants, one on the meadow, one on an
# islet, one near the castle. Places from a file are read by places_file.py.
DEER_POSTS = ((20.26, 28.98), (21.95, 21.25), (34.55, 20.38), (25.9, 15.2), (19.98, 29.3))

Chance = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""A function of places x, z (n,) that returns how likely each is accepted, (n,) in 0..1."""


@dataclass(frozen=True)
class Sprites:
    """Positions of sprites, (n, 3); sizes (n, 2) = width, height; atlas cells; mirrored or not."""

    positions: np.ndarray
    sizes: np.ndarray
    cells: np.ndarray
    flipped: np.ndarray

    def only(self, which: np.ndarray) -> "Sprites":
        """Return some of them, selected by a mask (n,) or by indices."""
        return Sprites(*(values[which] for values in vars(self).values()))


def trunks(sprites: Sprites) -> np.ndarray:
    """Return what a walker goes around of trees and deer: x, z, radius and top (n, 4) in units."""
    some = sprites.cells < PLANT
    x, y, z = sprites.positions[some].T
    widths, heights = sprites.sizes[some].T
    return np.stack([x, z, np.array(THICK)[sprites.cells[some]] * widths, y + heights], axis=1)


def scatter(field: HeightField, count: int, rng: np.random.Generator, suits: Chance) -> np.ndarray:
    """Return ``count`` random positions (n, 3), each accepted with the chance ``suits`` gives it.

    On a map with (almost) no suitable place there are fewer.
    """
    found: list[np.ndarray] = []
    missing = count
    for _ in range(BATCHES):
        if missing <= 0:
            break
        x, z = rng.random((2, max(4 * missing, 256))) * field.size
        keep = rng.random(len(x)) < suits(x, z)
        if len(x) > HOPELESS and not keep.any():
            break
        found.append(np.stack([x[keep], z[keep]], axis=1)[:missing])
        missing -= len(found[-1])
    xz = np.concatenate(found) if found else np.empty((0, 2))
    return np.insert(xz, 1, field.height(xz[:, 0], xz[:, 1]), axis=1)


def clear_land(settings: Settings, field: HeightField, castle: float = CASTLE) -> Chance:
    """Return a function x, z -> 1 on land, 0 in the water, near the castle and in the rabbit."""

    def suits(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        free = field.broad.terrain_height(x, z) > settings.water.level + SHORE
        for thing, radius in ((settings.castle, castle), (settings.rabbit, settings.rabbit.scale)):
            free &= np.hypot(x - thing.x, z - thing.z) > radius
        return free.astype(float)

    return suits


def random_sprites(
    kind: str, settings: Settings, field: HeightField, rng: np.random.Generator, suits: Chance
) -> Sprites:
    """Return one kind of sprite, at random places of random sizes, half of them mirrored."""
    groups: dict[str, tuple[Trees | Deer | Plants, int, int]] = {
        "trees": (settings.trees, 0, settings.trees.species),
        "deer": (settings.deer, DEER, settings.deer.species),
        "plants": (settings.plants, PLANT, 1),
    }
    group, first, species = groups[kind]
    positions = scatter(field, group.count, rng, suits)
    n = len(positions)
    if kind == "deer":
        posts = np.array(DEER_POSTS)
        heights = field.terrain_height(posts[:, 0], posts[:, 1])
        on_land = np.insert(posts, 1, heights, axis=1)[heights > field.water_level][:n]
        positions[: len(on_land)] = on_land

    sizes = rng.uniform(group.size_min, max(group.size_min, group.size_max), (n, 2))

    # Of one kind of deer or of two: the other random numbers are the same.
    drawn = rng.integers(max(species, 2) if kind == "deer" else species, size=n)
    return Sprites(positions, sizes, first + drawn % species, rng.random(n) < 0.5)


def plant(settings: Settings, field: HeightField, seed: int, kinds: set[str]) -> Sprites:
    """Return all sprites of some ``kinds``, in the order of KINDS."""
    parts = []
    for number, kind in enumerate(KINDS):
        if kind in kinds:
            # Each kind has its own generator, so a kind that is shown alone does not move.
            rng = np.random.default_rng([seed, number])
            suits = clear_land(settings, field, COURT if kind == "trees" else CASTLE)
            parts.append(random_sprites(kind, settings, field, rng, suits))
    arrays = zip(*(vars(part).values() for part in parts), strict=True)
    return Sprites(*(np.concatenate(each) for each in arrays))


def counts_and_sizes(settings: Settings) -> list[tuple[int, float, float]]:
    """Return how many trees, deer and plants there are, and from which size to which."""
    groups = settings.trees, settings.deer, settings.plants
    return [(group.count, group.size_min, group.size_max) for group in groups]


def site(settings: Settings) -> tuple[object, ...]:
    """Return the settings that determine where there is land and what else stands on it."""
    ground = settings.ground
    castle = settings.castle
    rabbit = settings.rabbit
    return (
        *(ground.scale_x, ground.scale_z),
        *(ground.height_image, ground.resolution, ground.size, ground.scale_y),
        *(
            ground.smooth,
            ground.subdivide,
            ground.exact_height,
            ground.ledges,
            settings.water.level,
        ),
        *(castle.x, castle.z, rabbit.x, rabbit.z, rabbit.scale),
    )
