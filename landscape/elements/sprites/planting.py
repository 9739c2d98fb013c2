"""Where the sprites stand: trees, deer and plants drawn by lot over the map (section 5.1.2).

No OpenGL here. In 2006 places are uniform and redrawn when they fall on water; with
``trees.grouped`` trees stand in woods, by height and slope, each species where it likes to grow;
so do the kinds of ``plants.species``: ferns in woods, ox-eyes in drifts on meadows, willow-herb at
the woods' edge, marram on sand, heather on stony slopes.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from landscape.elements.ground import Ground
from landscape.elements.sprites.atlas import HERB
from landscape.geometry.height_field import HeightField, greenness
from landscape.settings import Deer, Plants, Settings, Trees

DEER, PLANT = 4, 6  # first atlas cell of each kind; trees start at 0
SHRUB = 3  # the atlas cell of the fourth species
# Chosen: x, z and radius in units of open ground in the woods: round the rabbit, on the way from
# the meadow to the castle, and where the eye of the named views stands.
HOPELESS = 10_000  # chosen: candidates none of which suits tell that no place does
COURT = 2.2  # chosen: units round the castle where no tree hides it
GLADES = (
    (20.5, 24.0, 1.1), (22.5, 21.5, 1.3), (24.6, 19.6, 1.0), (13.6, 27.2, 1.2), (21.9, 9.9, 0.9),
    (22.6, 10.8, 0.6),
)  # fmt: skip
# Chosen: x, z of the first deer; the report's positions may come from a file as well. One by the
# bay's plants, one on the meadow, one on an islet, one near the castle.
DEER_POSTS = ((20.26, 28.98), (21.95, 21.25), (34.55, 20.38), (25.9, 15.2), (19.98, 29.3))
# Chosen, for each herb in the order of its cells: between which parts of the range of plants' sizes
# its height is, and how wide its picture is for its height.
HERB_LOOKS = np.array(
    [(0.10, 0.50, 1.55), (0.00, 0.25, 1.15), (0.50, 1.00, 0.80), (0.05, 0.80, 1.15),
     (0.00, 0.25, 1.70)]
)  # fmt: skip
WAVES = 11  # chosen: of which a pattern of drifts is the sum
PLAIN = 0.3  # chosen: how far the herbs but the fern differ in colour, for leaves
DRIFTS = 101  # chosen: number of the first pattern of drifts, one for each herb
Chance = Callable[[np.ndarray, np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Sprites:
    """Where each sprite stands, (n, 3); sizes (n, 2); atlas cell; mirrored; tint (n, 4).

    ``slopes`` (n, 2) is the ground's dy/dx and dy/dz under it, level by default.
    """

    positions: np.ndarray
    sizes: np.ndarray
    cells: np.ndarray
    flipped: np.ndarray
    tints: np.ndarray
    slopes: np.ndarray = field(default_factory=lambda: np.empty((0, 2)))

    def __post_init__(self) -> None:
        if len(self.slopes) != len(self.positions):
            object.__setattr__(self, "slopes", np.zeros((len(self.positions), 2)))

    def __add__(self, other: "Sprites") -> "Sprites":
        pairs = zip(vars(self).values(), vars(other).values(), strict=True)
        return Sprites(*(np.concatenate(pair) for pair in pairs))


def scatter(
    field: HeightField,
    count: int,
    rng: np.random.Generator,
    suits: Chance,
) -> np.ndarray:
    """Return positions (n, 3) drawn uniformly over the map, redrawn where ``suits`` says no.

    ``suits(x, z)`` gives the probability in 0..1 that a place is taken. A map with (almost) no
    suitable place gives fewer than ``count``.
    """
    found: list[np.ndarray] = []
    missing = count
    for _ in range(200):
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


def plant_everything(settings: Settings, ground: Ground, seed: int, kinds: set[str]) -> Sprites:
    """Draw the places, sizes and looks of all sprites by lot.

    Each kind has its own generator, so that showing one kind alone moves none of its sprites.
    """
    field, level = ground.field, settings.water.level
    woods = woodland(seed) if settings.trees.grouped else None

    def clear(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """On land and not where something else stands."""
        free = field.terrain_height(x, z) > level + 0.02
        for thing, reach in ((settings.castle, 1.1), (settings.rabbit, settings.rabbit.scale)):
            free &= np.hypot(x - thing.x, z - thing.z) > reach
        return free

    def tree_chance(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        free = clear(x, z).astype(float)
        free *= np.hypot(x - settings.castle.x, z - settings.castle.z) > COURT
        if woods is None:
            return free
        free *= outside_glades(x, z)
        height, slope = field.terrain_height(x, z) - level, field.slope(x, z)
        free *= np.clip((height - 0.12) / 0.1, 0, 1) * np.clip((2.9 - height) / 0.8, 0, 1)
        free *= np.clip((0.9 - slope) / 0.3, 0, 1)
        return np.asarray(free * woods(x, z))

    def plant_chance(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        free = clear(x, z).astype(float)
        if woods is None:
            return free
        height, slope = field.terrain_height(x, z) - level, field.slope(x, z)
        return np.asarray(
            free * (height > 0.1) * (slope < 0.8) * np.clip((2.6 - height) / 0.6, 0, 1)
        )

    def fern_chance(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        if woods is None:
            return plant_chance(x, z)
        # On green ground, and more of them in the woods' shade than on the meadows.
        green = greenness(ground.colour(x, z))
        for gx, gz, reach in GLADES:
            green *= np.hypot(x - gx, z - gz) > 0.6 * reach
        return plant_chance(x, z) * green * (0.25 + 0.75 * np.clip(2.0 * woods(x, z), 0, 1))

    herbs = herb_chances(settings, ground, seed)

    def herb_chance(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        free = clear(x, z).astype(float)
        for gx, gz, reach in GLADES:
            free *= np.hypot(x - gx, z - gz) > 0.3 * reach
        return np.asarray(free * np.minimum(herbs(x, z).sum(axis=1), 1.0))

    varied = settings.plants.species > 1
    sprites = Sprites(
        np.empty((0, 3)), np.empty((0, 2)), np.empty(0, int), np.empty(0, bool), np.empty((0, 4))
    )
    plan: list[tuple[str, Trees | Deer | Plants, Chance, int, int]] = [
        ("trees", settings.trees, tree_chance, 0, settings.trees.species),
        ("deer", settings.deer, plant_chance, DEER, 2),
        ("plants", settings.plants, herb_chance if varied else fern_chance, PLANT, 1),
    ]
    for number, (kind, group, chance, first, species) in enumerate(plan):
        if kind not in kinds:
            continue
        rng = np.random.default_rng([seed, number])
        positions = scatter(field, group.count, rng, chance)
        n = len(positions)
        if kind == "deer":
            posted = on_land(field, DEER_POSTS)[:n]
            positions[: len(posted)] = posted
        sizes = rng.uniform(group.size_min, max(group.size_min, group.size_max), (n, 2))
        cells = first + rng.integers(species, size=n)
        flipped = rng.random(n) < 0.5
        tints = np.full((n, 4), 255.0)
        if settings.trees.grouped:
            # A tree twice as wide as high is no tree: keep the report's range, tie the two sides.
            sizes[:, 0] = np.clip(sizes[:, 1] * rng.uniform(0.8, 1.1, n), 0, None)
            if kind == "trees":
                edge = 1.0 - (woods(positions[:, 0], positions[:, 2]) if woods else np.ones(n))
                cells = species_by_place(positions, level, species, rng, edge)
                sizes *= np.where(cells == SHRUB, rng.uniform(0.4, 0.75, n), 1.0)[:, None]
            if kind != "deer":
                tints[:, :3] *= leaf_tints(rng, n)
        if kind == "plants" and varied:
            cells, sizes = herbs_by_place(herbs(*positions[:, [0, 2]].T), settings.plants, rng)
            # What is white must not come out yellow or blue.
            tints[:, :3] = np.where(cells == HERB, 1.0, PLAIN)[:, None] * (tints[:, :3] - 255.0)
            tints[:, :3] += 255.0
        slopes = slopes_under(ground.field, positions, sizes[:, 0])
        sprites += Sprites(positions, sizes, cells, flipped, tints, slopes)
    return sprites


def outside_glades(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return 0 in the glades, 1 half a unit and more outside them."""
    outside = np.ones(np.shape(x))
    for gx, gz, reach in GLADES:
        outside *= np.clip((np.hypot(x - gx, z - gz) - reach) / 0.5, 0.0, 1.0)
    return outside


def herb_chances(settings: Settings, ground: Ground, seed: int) -> Chance:
    """Return a function (x, z) -> (n, ``plants.species``): how well a place suits each herb, 0..1.

    Flowers and heather come in drifts of a unit or two; what suits nothing stays bare.
    """
    field, level, species = ground.field, settings.water.level, settings.plants.species
    woods = woodland(seed)
    drifts = [drifts_of(seed, DRIFTS + k) for k in range(species)]

    def chances(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        height, slope = field.terrain_height(x, z) - level, field.slope(x, z)
        green = greenness(ground.colour(x, z))
        # Of the woods as they stand: no tree is near the castle, in a glade, or high up.
        court = np.hypot(x - settings.castle.x, z - settings.castle.z) - COURT
        shade = np.clip(1.6 * woods(x, z), 0.0, 1.0) * outside_glades(x, z)
        shade *= np.clip(court / 0.5, 0.0, 1.0) * np.clip((0.9 - slope) / 0.3, 0, 1)
        drift = [pattern(x, z) for pattern in drifts]
        grows = green * (height > 0.12) * (slope < 0.8) * np.clip((2.6 - height) / 0.6, 0, 1)
        shore = np.clip((height - 0.03) / 0.05, 0, 1) * np.clip((0.75 - height) / 0.25, 0, 1)
        damp = np.clip((0.22 - height) / 0.1, 0, 1)
        stony = np.clip((slope - 0.30) / 0.15, 0, 1) * np.clip((1.1 - slope) / 0.3, 0, 1)
        stony = np.maximum(stony, np.clip((height - 2.2) / 0.5, 0, 1))
        edge = np.clip(4.0 * shade * (1.0 - shade), 0.0, 1.0)
        kinds = [
            grows * shade**1.5 * (0.25 + 0.75 * drift[0]),
            grows * (1.0 - shade) ** 2 * drift[1] ** 1.5 if species > 1 else 0 * x,
            grows * edge * drift[2] ** 2 if species > 2 else 0 * x,
            shore * np.maximum(1.0 - green, damp) * (slope < 0.6) * (0.04 + 0.96 * drift[3] ** 1.5)
            if species > 3
            else 0 * x,
            stony * (height > 0.5) * (1.0 - 0.8 * shade) * drift[4] if species > 4 else 0 * x,
        ]
        return np.stack(kinds[:species], axis=1)

    return chances


def herbs_by_place(
    chances: np.ndarray, plants: Plants, rng: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """Return an atlas cell (n,), drawn by ``chances`` (n, k), and the sizes (n, 2) of its herb."""
    steps = np.cumsum(chances, axis=1)
    draw = rng.random(len(chances)) * steps[:, -1]
    kind = np.minimum((steps <= draw[:, None]).sum(axis=1), chances.shape[1] - 1)
    low, high, aspect = HERB_LOOKS[kind].T
    part = low + (high - low) * rng.random(len(kind))
    heights = plants.size_min + part * max(plants.size_max - plants.size_min, 0.0)
    widths = heights * aspect * rng.uniform(0.85, 1.15, len(kind))
    return HERB + kind, np.stack([widths, heights], axis=1)


def leaf_tints(rng: np.random.Generator, count: int) -> np.ndarray:
    """Return factors (n, 3) on a sprite's colours: some darker, some yellower, some bluer."""
    light, warm = rng.uniform(0.78, 1.0, count), rng.uniform(-1.0, 1.0, count)
    tint = np.stack([1 - 0.16 * np.maximum(-warm, 0), 1 - 0.05 * np.abs(warm)], axis=1)
    tint = np.insert(tint, 2, 1 - 0.28 * np.maximum(warm, 0), axis=1)
    return np.asarray(light[:, None] * tint)


def slopes_under(ground: HeightField, positions: np.ndarray, widths: np.ndarray) -> np.ndarray:
    """Return dy/dx and dy/dz (n, 2) of the ground from one end of a sprite's foot to the other."""
    x, z, half = positions[:, 0], positions[:, 2], 0.5 * widths
    dx = ground.terrain_height(x + half, z) - ground.terrain_height(x - half, z)
    dz = ground.terrain_height(x, z + half) - ground.terrain_height(x, z - half)
    return np.stack([dx, dz], axis=1) / (2.0 * half)[:, None]


def on_land(field: HeightField, places: tuple[tuple[float, float], ...]) -> np.ndarray:
    """Return the places (x, z) that stand above the water on this map, as positions (n, 3)."""
    xz = np.array(places)
    y = field.terrain_height(xz[:, 0], xz[:, 1])
    return np.insert(xz, 1, y, axis=1)[y > field.water_level]


def drifts_of(seed: int, number: int) -> Chance:
    """Return a function (x, z) -> 0..1: how thick a flower grows, in patches of a unit or two."""
    rng = np.random.default_rng([seed, number])
    # Waves in every direction, or the patches would lie in rows.
    angle = (np.arange(WAVES) + rng.random(WAVES)) * (np.pi / WAVES)
    k, phase = rng.uniform(1.5, 5.0, WAVES), rng.uniform(0, 2 * np.pi, WAVES)

    def density(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        along = np.outer(x, np.cos(angle)) + np.outer(z, np.sin(angle))
        heights = np.cos(k * along + phase).sum(axis=1) * np.sqrt(2.0 / WAVES)
        return np.asarray(np.clip(0.6 * heights, 0.0, 1.0))

    return density


def woodland(seed: int) -> Chance:
    """Return a function (x, z) -> 0.02..1: how thick the woods are, waves of a few units."""
    rng = np.random.default_rng([seed, 99])
    angle = rng.uniform(0, 2 * np.pi, 7)
    k = rng.uniform(0.5, 1.5, 7)
    phase = rng.uniform(0, 2 * np.pi, 7)

    def density(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        waves = [
            np.cos(k[i] * (x * np.cos(angle[i]) + z * np.sin(angle[i])) + phase[i])
            for i in range(7)
        ]
        return np.asarray(np.clip(np.sum(waves, axis=0) / 2.6, 0.02, 1.0))

    return density


def species_by_place(
    positions: np.ndarray,
    level: float,
    species: int,
    rng: np.random.Generator,
    edge: np.ndarray | float = 0.0,
) -> np.ndarray:
    """Return a species for each place: conifers high, birches and shrubs low, some of each.

    ``edge`` (n,) is 0 deep in a wood and 1 in the open, where shrubs and birches stand.
    """
    height = positions[:, 1] - level
    draw = rng.random(len(positions)) + 0.35 * np.clip(height - 0.9, -0.6, 1.2)
    draw -= 0.35 * np.asarray(edge) ** 2
    kind = np.select([draw > 0.72, draw > 0.34, draw > 0.12], [1, 0, 2], SHRUB)
    return np.asarray(kind % species)
