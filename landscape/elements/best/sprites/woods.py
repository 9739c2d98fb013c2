"""Woods, glades and drifts: smooth random patterns over the map, and which tree grows where.

Each pattern is a sum of a few plane waves of random (seeded) direction, length and phase. No OpenGL
here.
"""

import numpy as np

from landscape.elements.planting import Chance

SHRUB = 3  # the atlas cell of the fourth species of tree
# Chosen: x, z and radius in units of open ground in the woods: around the rabbit, on the way from
# the meadow to the castle, and where the eye of the named views is.
GLADES = (
    (20.5, 24.0, 1.1),
    (22.5, 21.5, 1.3),
    (24.6, 19.6, 1.0),
    (13.6, 27.2, 1.2),
    (21.9, 9.9, 0.9),
    (22.6, 10.8, 0.6),
)
WAVES = 11  # chosen: plane waves whose sum is a pattern of drifts


def woodland(seed: int) -> Chance:
    """Return a function x, z -> 0.02..1: how dense the woods are, waves of a few units."""
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


def drifts_of(seed: int, number: int) -> Chance:
    """Return a function x, z -> 0..1: how densely a flower grows, in patches of a unit or two."""
    rng = np.random.default_rng([seed, number])
    # The waves cover all directions; otherwise the patches would form rows.
    angle = (np.arange(WAVES) + rng.random(WAVES)) * (np.pi / WAVES)
    k, phase = rng.uniform(1.5, 5.0, WAVES), rng.uniform(0, 2 * np.pi, WAVES)

    def density(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        along = np.outer(x, np.cos(angle)) + np.outer(z, np.sin(angle))
        heights = np.cos(k * along + phase).sum(axis=1) * np.sqrt(2.0 / WAVES)
        return np.asarray(np.clip(0.6 * heights, 0.0, 1.0))

    return density


def outside_glades(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return 0 in the glades, 1 half a unit and more outside them."""
    outside = np.ones(np.shape(x))
    for gx, gz, radius in GLADES:
        outside *= np.clip((np.hypot(x - gx, z - gz) - radius) / 0.5, 0.0, 1.0)
    return outside


def off_glades(x: np.ndarray, z: np.ndarray, scale: float) -> np.ndarray:
    """Return 0 within ``scale`` times a glade's radius of its middle, 1 elsewhere."""
    outside = np.ones(np.shape(x))
    for gx, gz, radius in GLADES:
        outside *= np.hypot(x - gx, z - gz) > scale * radius
    return outside


def outward(woods: Chance, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return the direction (n,) in which woods thin out most, in radians from x to z."""
    step = 0.2  # units
    dx = woods(x + step, z) - woods(x - step, z)
    dz = woods(x, z + step) - woods(x, z - step)
    return np.asarray(np.arctan2(-dz, -dx))


def species_by_place(
    positions: np.ndarray,
    level: float,
    species: int,
    rng: np.random.Generator,
    edge: np.ndarray | float = 0.0,
) -> np.ndarray:
    """Return a species for each place: conifers high up, birches and shrubs low, some of each.

    ``edge`` (n,) is 0 deep in a wood and 1 in the open, where shrubs and birches stand.
    """
    height = positions[:, 1] - level
    draw = rng.random(len(positions)) + 0.35 * np.clip(height - 0.9, -0.6, 1.2)
    draw -= 0.35 * np.asarray(edge) ** 2
    kind = np.select([draw > 0.72, draw > 0.34, draw > 0.12], [1, 0, 2], SHRUB)
    return np.asarray(kind % species)
