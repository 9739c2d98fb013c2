"""Where stones lie: crags in slopes, boulders at their feet, shingle on the shore. No OpenGL.

Each kind has a rule, a function of places that says how likely one is accepted there
(``elements/planting.py``). Patches of value noise make clusters of them, with empty ground between.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from landscape.elements.best.stones.shapes import (
    BOULDER,
    CRAG,
    KINDS,
    LOG,
    PEBBLE,
    STONE,
    first_shape,
)
from landscape.elements.best.terrain.materials import rock_share
from landscape.elements.ground import Ground
from landscape.elements.planting import CASTLE, DEER_POSTS, Chance, scatter
from landscape.elements.settings import Settings
from landscape.geometry.height_field import greenness, lookup
from landscape.geometry.ramp import ramp

# Chosen: fraction of all stones that are of each kind, in the order of KINDS; the radii in units
# between which they are, and how much rarer large ones are.
SHARES = (0.085, 0.10, 0.335, 0.475, 0.005)
RADII = ((0.09, 0.24), (0.028, 0.12), (0.009, 0.028), (0.0035, 0.009), (0.05, 0.13))
RARER = (1.6, 2.6, 2.0, 1.5, 1.0)
FLATTER = (1.0, 1.0, 0.75, 0.8, 1.0)  # chosen: times the height of a shape
BESIDE = 0.5  # chosen: fraction of the stones that lie around boulders and crags
UPHILL = (0.2, 0.45, 0.8)  # chosen: units, where a boulder may have come from
DEER_ROOM = 0.3  # chosen: units around a deer's place without large stones


@dataclass(frozen=True)
class Stones:
    """Places x, z (n, 2) of stones, radii (n,) in units, kinds and shapes (n,).

    ``turns`` (n, 3, 3) rotates the shape to how it lies; ``tones`` (n,), 0..1, is which rock it is.
    """

    places: np.ndarray
    radii: np.ndarray
    kinds: np.ndarray
    shapes: np.ndarray
    turns: np.ndarray
    tones: np.ndarray


def patches(seed: int, cells: int, size: float) -> Chance:
    """Return a function of places: value noise in 0..1, ``cells`` patches along a map's side."""
    values = np.random.default_rng(seed).random((cells + 1, cells + 1))

    def noise(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        return np.asarray(
            lookup(values, x / size * cells / (cells + 1), z / size * cells / (cells + 1))
        )

    return noise


def downhill(ground: Ground, x: np.ndarray, z: np.ndarray, reach: float) -> np.ndarray:
    """Return the gradient dy/dx, dy/dz (n, 2) over ``reach`` units to each side."""
    h = ground.field.broad.terrain_height
    along_x, along_z = h(x + reach, z) - h(x - reach, z), h(x, z + reach) - h(x, z - reach)
    return np.stack([along_x, along_z], axis=1) / (2.0 * reach)


class Rules:
    """How likely a stone of each kind is accepted at places x, z (n,): 0..1, (n,)."""

    def __init__(self, settings: Settings, ground: Ground, seed: int) -> None:
        """Take the land, and make patches of it in which stones crowd."""
        self._settings, self._ground = settings, ground
        size = ground.size
        self._broad = patches(seed + 1, round(size / 1.6) or 1, size)
        self._fine = patches(seed + 2, 90, size)

    def crags(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Crags are in steep rock, and on steep coasts."""
        above, slope, bare, rock, free = self._site(x, z)
        coast = ramp(0.28, 0.5, slope) * ramp(0.3, 0.1, above)
        chance = np.maximum(ramp(0.42, 0.75, slope) * ramp(0.3, 0.8, rock), coast)
        chance *= ramp(-0.12, -0.02, above)
        chance *= bare * ramp(0.15, 0.5, self._broad(x, z)) * (0.12 + 0.88 * ramp(1.5, 0.2, above))
        return chance * free * clear_of_deer(x, z)

    def boulders(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Boulders lie at the foot of slopes from which they fell, on shores, and a few alone."""
        above, slope, bare, rock, free = self._site(x, z)
        broad, fine = self._broad(x, z), self._fine(x, z)
        foot = ramp(0.55, 0.9, self._steepest_above(x, z)) * ramp(1.1, 0.5, slope)
        shore = ramp(-0.14, -0.04, above) * ramp(0.16, 0.02, above) * ramp(0.12, 0.3, slope)

        here = np.maximum(foot * (0.25 + 0.75 * bare), np.maximum(0.7 * shore, 0.5 * rock))
        here = np.maximum(here * ramp(0.3, 0.65, broad), shore * ramp(0.1, 0.6, fine))
        here *= ramp(-0.15, -0.05, above) * (0.25 + 0.75 * ramp(1.6, 0.4, above))
        lone = 0.012 * ramp(0.6, 0.8, fine) * (above > 0.1) * ramp(0.5, 0.2, slope)
        return np.maximum(here, lone) * free * clear_of_deer(x, z)

    def stones(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Stones are scree on slopes of rock and bare earth, and shingle on shores."""
        above, slope, bare, rock, free = self._site(x, z)
        fine = self._fine(x, z)
        scree = rock * ramp(0.25, 0.5, slope) + 0.9 * bare * ramp(0.2, 0.45, slope)
        shore = ramp(-0.06, 0.0, above) * ramp(0.12, 0.04, above) * ramp(0.08, 0.25, slope)
        here = np.maximum(scree, shore) * ramp(0.35, 0.75, fine) * ramp(-0.06, -0.02, above)
        return here * free * (0.15 + 0.85 * ramp(1.6, 0.5, above))

    def pebbles(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Pebbles lie along the line that the highest waves reach, and on bare earth."""
        above, slope, bare, _, free = self._site(x, z)
        line = np.exp(-(((above - 0.045 - 0.03 * self._broad(x, z)) / 0.014) ** 2))
        line = np.maximum(line, 0.5 * np.exp(-(((above - 0.012) / 0.012) ** 2)))
        earth = 1.0 * bare * ramp(0.28, 0.6, slope) * ramp(1.4, 0.4, above)
        clumps = ramp(0.3, 0.8, self._fine(x, z))
        return np.maximum(line, earth) * (0.06 + 0.94 * clumps) * (above > -0.02) * free

    def logs(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Logs have drifted to the upper edge of flat beaches."""
        above, slope, bare, _, free = self._site(x, z)
        line = np.exp(-(((above - 0.07) / 0.02) ** 2)) * ramp(0.35, 0.2, slope)
        return line * bare * free * ramp(0.45, 0.6, self._broad(x, z)) * clear_of_deer(x, z)

    def _site(self, x: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, ...]:
        """Return height above the water, slope, bareness, rock and free ground, (n,) each."""
        ground = self._ground
        castle, rabbit = self._settings.castle, self._settings.rabbit
        colour, fall = ground.drawn_colour(x, z), downhill(ground, x, z, 0.12)
        normals = np.insert(-fall, 1, 1.0, axis=1)
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)

        free = np.hypot(x - castle.x, z - castle.z) > CASTLE
        free &= np.hypot(x - rabbit.x, z - rabbit.z) > 3.0 * rabbit.scale
        free &= np.minimum.reduce([x, z, ground.size - x, ground.size - z]) > 0.5

        above = ground.field.broad.terrain_height(x, z) - self._settings.water.level
        slope = np.hypot(*fall.T)
        return above, slope, 1.0 - greenness(colour), rock_share(normals, colour), free

    def _steepest_above(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Return the greatest slope (n,) of the ground uphill, from where a boulder may fall."""
        fall = downhill(self._ground, x, z, 0.15)
        up = fall / np.maximum(np.hypot(*fall.T), 1e-6)[:, None]
        slopes = [
            np.hypot(*downhill(self._ground, x + away * up[:, 0], z + away * up[:, 1], 0.12).T)
            for away in UPHILL
        ]
        return np.asarray(np.max(slopes, axis=0))


def clear_of_deer(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return whether places (n,) are not where a deer stands."""
    away = [np.hypot(x - post[0], z - post[1]) for post in DEER_POSTS]
    return np.asarray(np.min(away, axis=0) > DEER_ROOM)


def rules(settings: Settings, ground: Ground, seed: int) -> dict[int, Chance]:
    """Return where each kind lies."""
    place = Rules(settings, ground, seed)
    return {
        CRAG: place.crags,
        BOULDER: place.boulders,
        STONE: place.stones,
        PEBBLE: place.pebbles,
        LOG: place.logs,
    }


def strewn(settings: Settings, ground: Ground, seed: int) -> Stones:
    """Return ``ground.stones`` stones, or fewer where there is no room for them."""
    rng = np.random.default_rng([seed, 71])
    parts: list[tuple[np.ndarray, np.ndarray, np.ndarray]] = []
    for kind, rule in rules(settings, ground, seed).items():
        count = round(SHARES[kind] * settings.ground.stones)
        beside = round(BESIDE * count) if kind == STONE and parts else 0
        found = scatter(ground.field.broad, count - beside, rng, rule)[:, [0, 2]]
        if beside:
            found = np.concatenate([found, around(parts, beside, ground, settings, rng)])
        low, high = RADII[kind]
        radii = low + (high - low) * rng.random(len(found)) ** RARER[kind]
        parts.append((found, radii, np.full(len(found), kind)))

    places, radii, kinds = (np.concatenate(each) for each in zip(*parts, strict=True))
    firsts = np.array([first_shape(kind) for kind in range(len(KINDS))])
    shapes = firsts[kinds] + (rng.random(len(kinds)) * np.array(KINDS)[kinds]).astype(int)
    turns = lying(ground, places, radii, kinds, rng)
    tones = np.clip(
        patches(seed + 3, 26, ground.size)(*places.T) + rng.normal(0, 0.16, len(kinds)), 0, 1
    )
    return Stones(places, radii, kinds, shapes, turns, tones)


Parts = list[tuple[np.ndarray, np.ndarray, np.ndarray]]


def around(
    parts: Parts, count: int, ground: Ground, settings: Settings, rng: np.random.Generator
) -> np.ndarray:
    """Return places (m, 2), at most ``count``, around the large stones of ``parts``."""
    places, radii = (np.concatenate([part[k] for part in parts]) for k in (0, 1))
    if not len(places):
        return np.empty((0, 2))
    one = rng.integers(len(places), size=count)
    way, away = rng.uniform(0, 2 * np.pi, count), radii[one] * rng.uniform(0.8, 2.4, count)
    found = places[one] + away[:, None] * np.stack([np.cos(way), np.sin(way)], axis=1)
    return found[ground.field.broad.terrain_height(*found.T) > settings.water.level - 0.06]


def lying(
    ground: Ground,
    places: np.ndarray,
    radii: np.ndarray,
    kinds: np.ndarray,
    rng: np.random.Generator,
) -> np.ndarray:
    """Return the rotations (n, 3, 3) of stones: crags face downhill, trunks lie along the shore.

    Boulders and smaller stones are turned at random, and lean with the slope.
    """
    n = len(places)
    fall = np.zeros((n, 2))
    for kind in range(len(KINDS)):
        mine = kinds == kind
        reach = 0.2 if kind in (CRAG, LOG) else 0.06
        fall[mine] = downhill(ground, places[mine, 0], places[mine, 1], reach)

    face = np.arctan2(-fall[:, 0], -fall[:, 1])  # the yaw at which +z points downhill
    yaw = np.where(kinds == CRAG, face + rng.normal(0, 0.25, n), rng.uniform(-np.pi, np.pi, n))
    yaw = np.where(kinds == LOG, face + rng.normal(0, 0.35, n), yaw)

    # Bedrock has layers, which lie level; what is loose lies on the slope.
    lean = np.where(kinds == CRAG, 0.15, np.where(kinds == LOG, 1.0, 0.6))
    up = np.stack([-lean * fall[:, 0], np.ones(n), -lean * fall[:, 1]], axis=1)
    up[:, [0, 2]] += rng.normal(0, 1, (n, 2)) * np.where(kinds == LOG, 0.0, 0.12)[:, None]
    up /= np.linalg.norm(up, axis=1, keepdims=True)
    ahead = np.stack([np.sin(yaw), np.zeros(n), np.cos(yaw)], axis=1)
    right = np.cross(up, ahead)
    right /= np.linalg.norm(right, axis=1, keepdims=True)
    turns = np.stack([right, up, np.cross(right, up)], axis=2)
    return np.asarray(
        turns * np.where(np.arange(3) == 1, np.array(FLATTER)[kinds][:, None, None], 1.0)
    )


Height = Callable[[np.ndarray, np.ndarray], np.ndarray]
