"""Where the refined sprites are: woods, herbs in their habitats, tints, and the ground's slope.

With ``trees.variety`` they stand in groups with undergrowth, with ``deer.variety`` deer keep to
grass (:mod:`individuals`). With ``trees.grouped`` trees stand in woods, by height and slope, each
species in its habitat, and plants grow on green ground; with ``plants.species`` over 1 plants are
several herbs. Without any of these the places are those of ``elements/planting.py``. No OpenGL
here.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from landscape.elements.atlas import CELLS
from landscape.elements.best.sprites import individuals
from landscape.elements.best.sprites.herbs import herb_chances, herbs_by_place
from landscape.elements.best.sprites.rules import is_deer
from landscape.elements.best.sprites.woods import (
    SHRUB,
    off_glades,
    outside_glades,
    species_by_place,
    woodland,
)
from landscape.elements.ground import Ground
from landscape.elements.places_file import read_places
from landscape.elements.planting import (
    CASTLE,
    COURT,
    DEER_POSTS,
    KINDS,
    PLANT,
    Chance,
    Sprites,
    clear_land,
    counts_and_sizes,
    random_sprites,
    scatter,
    site,
)
from landscape.elements.settings import Settings
from landscape.elements.sprite_names import HERB, HERBS
from landscape.geometry.height_field import HeightField, greenness

# Chosen: how green the ground is and how steep at most where deer stand, and how far in units one
# of the fixed places is moved to such ground.
GREEN = 0.6
GENTLE = 0.55
MOVES = 1.6
# Chosen: which of the fixed places is the islet's, and x, z of the edge of the water there.
ISLET, BRINK = 2, (34.17, 20.32)
SUNK = 0.025  # chosen, times a deer's height: its hooves are down in the grass
# Chosen: what ground.tone leaves of the red, green and blue of deer, and of each herb.
COATS = np.array([0.86, 0.90, 0.92])
HERB_TONES = np.array(
    [
        (0.88, 0.84, 0.80),
        (0.92, 0.90, 0.88),
        (0.74, 0.82, 0.70),
        (0.90, 0.86, 0.84),
        (0.66, 0.74, 0.64),
    ]
)
PLAIN = 0.3  # chosen: variation of the tints of herbs except the fern, as a fraction of leaves'


@dataclass(frozen=True)
class TintedSprites(Sprites):
    """Sprites with a tint (n, 4) each in 0..255, the ground's slope (n, 2) = dy/dx, dy/dz, and
    the atlas cells (n,) of their pictures, where ``cells`` say which species they are."""

    tints: np.ndarray
    slopes: np.ndarray
    pictures: np.ndarray


def planted_from(settings: Settings) -> tuple[object, ...]:
    """Return the settings that the sprites' places, sizes, kinds and tints depend on."""
    species = settings.trees.species, settings.plants.species, settings.deer.species
    variety = settings.trees.grouped, settings.trees.variety, settings.deer.variety
    colours = settings.ground.large_texture, settings.ground.texture_size
    tone = settings.ground.tone
    return (*counts_and_sizes(settings), *species, *variety, *colours, tone, *site(settings))


def planted_by_file(
    settings: Settings, path: Path, field: HeightField, kinds: set[str]
) -> TintedSprites:
    """Return the sprites of a file that are of some ``kinds``, with what these settings can show.

    A picture that the atlas of these settings does not have is the species' first.
    """
    found, pictures, tints = read_places(path, field, kinds)
    cells = found.cells if settings.plants.species > 1 else np.minimum(found.cells, PLANT)
    pictures = np.where(pictures < individuals.MORE, cells, pictures)
    if len(individuals.files(settings)) <= len(CELLS) + len(HERBS):
        pictures = cells
    positions, n = found.positions, len(cells)
    if settings.deer.variety:
        deer = is_deer(cells)
        positions[deer, 1] -= SUNK * found.sizes[deer, 1]
    slopes = slopes_under(field, positions, found.sizes[:, 0])
    opaque = np.concatenate([tints, np.full((n, 1), 255.0)], axis=1)
    return TintedSprites(
        positions, found.sizes, cells, found.flipped, opaque, slopes, np.asarray(pictures)
    )


def plant_refined(settings: Settings, ground: Ground, seed: int, kinds: set[str]) -> TintedSprites:
    """Return all sprites of some ``kinds``: random (seeded) places, sizes and looks."""
    woods = woodland(seed) if settings.trees.grouped else None
    herbs = herb_chances(settings, ground, seed) if settings.plants.species > 1 else None
    habitat = Habitat(settings, ground, seed, woods, herbs)
    parts = [
        habitat.planted(kind, np.random.default_rng([seed, number]))
        for number, kind in enumerate(KINDS)
        if kind in kinds
    ]
    arrays = zip(*(vars(part).values() for part in parts), strict=True)
    return TintedSprites(*(np.concatenate(each) for each in arrays))


@dataclass(frozen=True)
class Habitat:
    """The land on which sprites grow; ``woods`` and ``herbs`` are how likely they are, if any."""

    settings: Settings
    ground: Ground
    seed: int
    woods: Chance | None
    herbs: Chance | None

    def suits(self, kind: str) -> Chance:
        """Return where one kind of sprite grows."""
        settings, ground = self.settings, self.ground
        woods = self.woods
        chance = clear_land(settings, ground.field, COURT if kind == "trees" else CASTLE)
        if kind == "plants" and self.herbs is not None:
            return for_herbs(chance, self.herbs)
        if woods is not None:
            chance = in_woods(kind, settings, ground, chance, woods)
        if kind == "deer" and settings.deer.variety:
            return on_grass(chance, ground)
        if kind == "trees" and settings.trees.variety and woods is not None:
            return individuals.in_groups(chance, woods, self.seed)
        return chance

    def planted(self, kind: str, rng: np.random.Generator) -> TintedSprites:
        """Return all sprites of one kind."""
        settings, field = self.settings, self.ground.field
        chance = self.suits(kind)
        placed = random_sprites(kind, settings, field, rng, chance)
        positions, sizes = placed.positions, placed.sizes
        cells = placed.cells
        n = len(positions)
        pictures: np.ndarray | None = None  # each cell's own
        if kind == "deer" and settings.deer.variety:
            positions = at_the_water(positions, moved_to(positions, chance, field, rng), field)
            pictures = individuals.poses(cells, rng)
            positions[:, 1] -= SUNK * sizes[:, 1]

        tints = np.full((n, 4), 255.0)
        if self.woods is not None:
            # No tree is twice as wide as high: keep the report's range, tie width to height.
            sizes[:, 0] = np.clip(sizes[:, 1] * rng.uniform(0.8, 1.1, n), 0, None)
            if kind == "trees":
                positions, sizes, cells, pictures = self._wooded(
                    positions, sizes, chance, self.woods, rng
                )
            if kind != "deer":
                tints[:, :3] *= leaf_tints(rng, n)

        if kind == "plants" and self.herbs is not None:
            chances = self.herbs(*positions[:, [0, 2]].T)
            cells, sizes = herbs_by_place(chances, settings.plants, rng)
            # White flowers must not be tinted yellow or blue.
            tints[:, :3] = np.where(cells == HERB, 1.0, PLAIN)[:, None] * (tints[:, :3] - 255.0)
            tints[:, :3] += 255.0

        strength = settings.ground.tone
        if strength and kind == "deer":
            tints[:, :3] *= 1.0 + strength * (COATS - 1.0)
        if strength and kind == "plants":
            toned = HERB_TONES[np.clip(cells - HERB, 0, len(HERB_TONES) - 1)]
            tints[:, :3] *= 1.0 + strength * (toned - 1.0)

        slopes = slopes_under(field, positions, sizes[:, 0])
        pictures = cells if pictures is None else pictures
        return TintedSprites(positions, sizes, cells, placed.flipped, tints, slopes, pictures)

    def _wooded(
        self,
        positions: np.ndarray,
        sizes: np.ndarray,
        chance: Chance,
        woods: Chance,
        rng: np.random.Generator,
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Return positions, sizes, species and pictures of trees as they grow in woods."""
        trees, field = self.settings.trees, self.ground.field
        edge = 1.0 - woods(positions[:, 0], positions[:, 2])
        level = self.settings.water.level
        grown = positions.copy()
        grown[:, 1] = field.broad.height(positions[:, 0], positions[:, 2])
        cells = species_by_place(grown, level, trees.species, rng, edge)
        if not trees.variety:
            lower = np.where(cells == SHRUB, rng.uniform(0.4, 0.75, len(cells)), 1.0)
            return positions, sizes * lower[:, None], cells, cells

        positions, cells, young = individuals.beside(positions, cells, chance, woods, rng)
        x, z = positions[:, 0], positions[:, 2]
        positions[:, 1] = field.terrain_height(x, z)
        pictures = individuals.individuals(cells, young, rng)
        sizes = individuals.statures(pictures, young, woods(x, z), trees.size_max, rng)
        return positions, sizes, cells, pictures


def in_woods(kind: str, settings: Settings, ground: Ground, clear: Chance, woods: Chance) -> Chance:
    """Return where one kind of sprite grows on an island of woods and meadows."""
    field, level = ground.field.broad, settings.water.level

    def trees(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        free = clear(x, z) * outside_glades(x, z)
        height, slope = field.terrain_height(x, z) - level, field.slope(x, z)
        free *= np.clip((height - 0.12) / 0.1, 0, 1) * np.clip((2.9 - height) / 0.8, 0, 1)
        free *= np.clip((0.9 - slope) / 0.3, 0, 1)
        return np.asarray(free * woods(x, z))

    def deer(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        height, slope = field.terrain_height(x, z) - level, field.slope(x, z)
        gentle = (height > 0.1) * (slope < 0.8) * np.clip((2.6 - height) / 0.6, 0, 1)
        return np.asarray(clear(x, z) * gentle)

    def ferns(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        # On green ground, and more of them in the woods' shade than on the meadows.
        green = greenness(ground.colour(x, z)) * off_glades(x, z, 0.6)
        return deer(x, z) * green * (0.25 + 0.75 * np.clip(2.0 * woods(x, z), 0, 1))

    return {"trees": trees, "deer": deer, "plants": ferns}[kind]


def on_grass(clear: Chance, ground: Ground) -> Chance:
    """Return where a deer stands well: in grass, on gentle slopes, not on rock or sand."""

    def suits(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        green = greenness(ground.colour(x, z)) > GREEN
        gentle = ground.field.slope(x, z) < GENTLE
        return np.asarray(clear(x, z) * green * gentle)

    return suits


def at_the_water(was: np.ndarray, moved: np.ndarray, field: HeightField) -> np.ndarray:
    """Return ``moved`` positions (n, 3) with the islet's deer at the edge of the water instead.

    ``was`` (n, 3) says which one that is. It came to drink, and is mirrored from head to foot
    (fig35h); in the grass of the islet's top it would be too far from the water for that.
    """
    out, height = moved.copy(), float(field.terrain_height(*BRINK))
    if height > field.water_level:
        islet = (was[:, [0, 2]] == DEER_POSTS[ISLET]).all(axis=1)
        out[islet] = BRINK[0], height, BRINK[1]
    return out


def moved_to(
    positions: np.ndarray, suits: Chance, field: HeightField, rng: np.random.Generator
) -> np.ndarray:
    """Return positions (n, 3) of which those that do not suit are moved to one that does.

    That is one nearby if there is any.
    """
    out = positions.copy()
    for k in np.flatnonzero(suits(positions[:, 0], positions[:, 2]) <= 0.0):
        angle, away = rng.uniform(0, 2 * np.pi, 400), MOVES * np.sqrt(rng.random(400))
        x = positions[k, 0] + away * np.cos(angle)
        z = positions[k, 2] + away * np.sin(angle)
        good = np.flatnonzero(suits(x, z) > 0.0)
        if not len(good):
            out[k] = (*scatter(field, 1, rng, suits), out[k])[0]
        else:
            best = good[away[good].argmin()]
            out[k] = (
                x[best],
                field.terrain_height(x[best : best + 1], z[best : best + 1])[0],
                z[best],
            )

    return out


def for_herbs(clear: Chance, herbs: Chance) -> Chance:
    """Return where any herb grows; ``herbs`` gives the chance (n, k) of each of them."""

    def suits(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        free = clear(x, z) * off_glades(x, z, 0.3)
        return np.asarray(free * np.minimum(herbs(x, z).sum(axis=1), 1.0))

    return suits


def leaf_tints(rng: np.random.Generator, count: int) -> np.ndarray:
    """Return factors (n, 3) on a sprite's colours: some darker, some yellower, some bluer."""
    light, warm = rng.uniform(0.78, 1.0, count), rng.uniform(-1.0, 1.0, count)
    tint = np.stack([1 - 0.16 * np.maximum(-warm, 0), 1 - 0.05 * np.abs(warm)], axis=1)
    tint = np.insert(tint, 2, 1 - 0.28 * np.maximum(warm, 0), axis=1)
    return np.asarray(light[:, None] * tint)


def slopes_under(ground: HeightField, positions: np.ndarray, widths: np.ndarray) -> np.ndarray:
    """Return dy/dx and dy/dz (n, 2) of the ground from one end of a sprite's foot to the other."""
    x = positions[:, 0]
    z = positions[:, 2]
    half = 0.5 * widths
    dx = ground.terrain_height(x + half, z) - ground.terrain_height(x - half, z)
    dz = ground.terrain_height(x, z + half) - ground.terrain_height(x, z - half)
    return np.stack([dx, dz], axis=1) / (2.0 * half)[:, None]
