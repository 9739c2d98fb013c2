"""Which herb grows where: the five kinds of ``plants.species``, each in its own habitat.

Ferns grow in woods, ox-eyes in drifts on meadows, willow-herb at the edge of woods, marram on sand,
heather on stony slopes. No OpenGL here.
"""

from collections.abc import Callable

import numpy as np

from landscape.elements.best.sprites.woods import drifts_of, outside_glades, woodland
from landscape.elements.ground import Ground
from landscape.elements.planting import COURT
from landscape.elements.settings import Plants, Settings
from landscape.elements.sprite_names import HERB
from landscape.geometry.height_field import greenness

# Chosen, for each herb in the order of its cells: the range of its heights as fractions of the
# range of plants' sizes, and its picture's width over its height.
HERB_LOOKS = np.array(
    [
        (0.10, 0.50, 1.55),
        (0.00, 0.25, 1.15),
        (0.50, 1.00, 0.80),
        (0.05, 0.80, 1.15),
        (0.00, 0.25, 1.70),
    ]
)
DRIFTS = 101  # chosen: number of the first pattern of drifts, one for each herb


def herb_chances(
    settings: Settings, ground: Ground, seed: int
) -> Callable[[np.ndarray, np.ndarray], np.ndarray]:
    """Return a function x, z -> (n, ``plants.species``): how well a place suits each herb, 0..1.

    Flowers and heather come in drifts of a unit or two; a place that suits no herb stays bare.
    """
    field = ground.field.broad
    level = settings.water.level
    species = settings.plants.species
    woods = woodland(seed)
    drifts = [drifts_of(seed, DRIFTS + k) for k in range(species)]

    def chances(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        height, slope = field.terrain_height(x, z) - level, field.slope(x, z)
        green = greenness(ground.colour(x, z))

        # The woods as planted: no tree is near the castle, in a glade, or on a steep slope.
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
            # On the beach marram grows in clumps, on dunes that it holds, with few between them.
            shore * np.maximum(1.0 - green, damp) * (slope < 0.6) * clump(drift[3])
            if species > 3
            else 0 * x,
            stony * (height > 0.5) * (1.0 - 0.8 * shade) * drift[4] if species > 4 else 0 * x,
        ]
        return np.stack(kinds[:species], axis=1)

    return chances


def clump(drift: np.ndarray) -> np.ndarray:
    """Return how likely marram grows by its drift (n,): all or almost nothing."""
    return np.asarray(0.008 + 0.992 * np.clip(2.2 * (drift - 0.42), 0.0, 1.0) ** 1.5)


def herbs_by_place(
    chances: np.ndarray, plants: Plants, rng: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """Return a random atlas cell (n,), weighted by ``chances`` (n, k), and a size (n, 2) for it."""
    steps = np.cumsum(chances, axis=1)
    draw = rng.random(len(chances)) * steps[:, -1]
    kind = np.minimum((steps <= draw[:, None]).sum(axis=1), chances.shape[1] - 1)
    low, high, aspect = HERB_LOOKS[kind].T
    fraction = low + (high - low) * rng.random(len(kind))
    heights = plants.size_min + fraction * max(plants.size_max - plants.size_min, 0.0)
    widths = heights * aspect * rng.uniform(0.85, 1.15, len(kind))
    return HERB + kind, np.stack([widths, heights], axis=1)
