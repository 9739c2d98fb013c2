"""What sown blades look like: half widths, bends, heights, tints and kinds (see growth.py).

All that is the same for a tuft is computed once for it. No OpenGL here.
"""

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from landscape.elements.best.meadow import sward
from landscape.elements.best.meadow.refined_blades import (
    LUSH,
    WIDENING,
    Patch,
    arched,
    blade_tints,
    hues,
    lushness,
    packed,
    sizes_of,
)
from landscape.elements.best.meadow.sowing import between
from landscape.elements.best.terrain.tone import turf_toned
from landscape.elements.grass import TALLEST, blade_corners, blade_vertices
from landscape.elements.ground import Ground
from landscape.elements.settings import Settings

LEANING = 2.2  # chosen: how far a card's top may bend, times a tip's bend of section 5.3.2
SHORTEST, TALLER = 0.6, 1.25  # chosen: of the blades of a tuft, their heights by the tuft's
WHITE = np.uint32(0xFFFFFFFF)


class Sown(NamedTuple):
    """Blades before they have a shape: where they stand, and random numbers.

    ``roots`` (t, 2) are the tufts' places on the map, and ``tuft`` (n,) is each blade's; ``ranges``
    (n,) is how far away each would be drawn. ``lots`` are random numbers in 0..1 by their names,
    (n,) of the blades or (t,) of the tufts; see :func:`sowing.lots_of`.
    """

    roots: np.ndarray
    tuft: np.ndarray
    ranges: np.ndarray
    lots: Mapping[str, np.ndarray]


class Shapes:
    """Gives blades their shape."""

    def __init__(
        self,
        settings: Settings,
        ground: Ground,
        ends: tuple[np.ndarray, np.ndarray],
        near: float,
        tuft_radius: float,
    ) -> None:
        """Take the ground's colours, and those of the texture; see :class:`growth.Growth`.

        All blades are drawn up to ``near`` units; those of a tuft stand ``tuft_radius`` apart.
        """
        self._settings = settings
        self._ground = ground
        self._ends = ends
        self._near = near
        self._tuft_radius = tuft_radius

    def of(self, sown: Sown) -> Patch:
        """Return the blades of what is sown."""
        grass, tuft = self._settings.grass, sown.tuft
        angles = sown.lots["angle"] * 2 * np.pi
        x, z = sown.roots.T.take(tuft, axis=1)
        if grass.tufts:
            # Outwards, the way a blade leans: its tip bends to (sin, cos) of its angle.
            away = self._tuft_radius * np.sqrt(sown.lots["outwards"])
            x, z = x + away * np.sin(angles), z + away * np.cos(angles)

        places = np.stack([x, self._ground.field.terrain_height(x, z), z])
        grow = self._cards if grass.sward else self._blades
        vertices, sizes, kinds, tints = grow(places, angles, sown)
        ranges = sown.ranges.astype(np.float32)
        return Patch(places.T.astype(np.float32), vertices, tints, ranges, kinds, sizes)

    def sizes(self, ranges: np.ndarray, lots: Mapping[str, np.ndarray]) -> np.ndarray:
        """Return how far from its place no vertex is of any blade of tufts, float32 (t,).

        ``ranges`` (t,) are the longest of their blades', ``lots`` the tufts' random numbers.
        """
        grass = self._settings.grass
        across, up = grass.scale
        wider: np.ndarray | float = 1.0
        taller: np.ndarray | float = 1.0
        if grass.sward:
            across, up = sward.card_scale(grass.scale)
            half, height = sward.LOOKS[:, :2].max(axis=0).tolist()
            bend = sward.BEND * LEANING * grass.arch
            tallest = sward.TALLEST * _card_sizes(lots["size"])
            wider = taller = TALLER * np.maximum(1.0 + grass.variety * (tallest - 1.0), 1.0)
        else:
            half, height, bend = 0.003, TALLEST, 0.004 * max(grass.arch, 1.0)
            if grass.fade:
                wider = self._widened(ranges)
                taller = TALLER * (1.0 + grass.variety * (_own_height(lots["size"]) + 0.45))
        wide = wider * across * math.hypot(half, bend)
        tall = taller * up * height
        return np.sqrt(np.square(wide) + np.square(tall) + np.zeros(len(ranges), np.float32))

    def _widened(self, ranges: np.ndarray) -> np.ndarray:
        """Return how many times as wide blades of these ranges are: they stand for others."""
        drawn = np.minimum(ranges, self._settings.grass.radius)
        return np.asarray(np.maximum(drawn / self._near, 1.0) ** WIDENING)

    def _blades(self, places: np.ndarray, angles: np.ndarray, sown: Sown) -> tuple[np.ndarray, ...]:
        """Return vertices, sizes, kinds and tints of blades, all of the report's shape.

        They stand at ``places`` (3, n).
        """
        grass, tuft, lots = self._settings.grass, sown.tuft, sown.lots
        x, z = sown.roots.T
        feet = places.T[:, None]
        vertices = blade_vertices(places.T, arched(blade_corners(angles), grass.arch), grass.scale)
        if grass.fade:
            grown = np.empty((len(angles), 1, 3))
            grown[..., 0] = grown[..., 2] = self._widened(sown.ranges)[:, None]
            grown[..., 1] = between(SHORTEST, TALLER, lots["height"])[:, None]
            own = _own_height(lots["size"]) + 0.45 * lushness(x, z)
            grown[:, 0, 1] *= (1.0 + grass.variety * own).take(tuft)
            vertices = ((vertices - feet) * grown + feet).astype(np.float32)

        tints = np.full((len(angles), 2), WHITE)
        if grass.tinted:
            colour = self._ground.drawn_colour(x, z)
            hue = hues(lots["green"], lots["straw"], lots["pale"])
            colour *= 1.0 + grass.variety * (hue - 1.0)
            colour *= 1.0 + grass.variety * lushness(x, z)[:, None] * LUSH
            colour *= self._ground.light(x, z)
            brightness = between(0.92, 1.28, lots["brightness"])
            both = blade_tints(colour.take(tuft, axis=0), brightness, *self._ends)
            tints = np.stack([packed(colours.T) for colours in both], axis=1)

        sizes = sizes_of((vertices - feet).transpose(1, 2, 0))
        return vertices, sizes, np.zeros(len(angles), np.uint8), tints

    def _cards(self, places: np.ndarray, angles: np.ndarray, sown: Sown) -> tuple[np.ndarray, ...]:
        """Return vertices, sizes, kinds and tints of the sward's cards at ``places`` (3, n)."""
        grass, tuft, lots = self._settings.grass, sown.tuft, sown.lots
        there = sward.places_at(*sown.roots.T)
        bold = np.minimum(sown.ranges / self._near, 40.0) ** sward.BOLD
        kinds = sward.kinds_at(there.weights, tuft, lots["kind"], bold, grass.flowers)
        lean = grass.arch * between(-LEANING, LEANING, lots["lean"])
        corners = sward.card_corners(angles, kinds, lean)
        tall = 1.0 + grass.variety * (there.tall * _card_sizes(lots["size"]) - 1.0)
        corners *= tall.take(tuft) * between(SHORTEST, TALLER, lots["height"])
        across, up = sward.card_scale(grass.scale)
        corners *= np.array([[across], [up], [across]])
        tints = np.full((len(angles), 2), WHITE)
        if grass.tinted:
            tints = self._card_tints(sown, kinds, there.tone)

        vertices = np.ascontiguousarray((corners + places).transpose(2, 0, 1), np.float32)
        return vertices, sizes_of(corners), kinds, tints

    def _card_tints(self, sown: Sown, kinds: np.ndarray, light_tone: np.ndarray) -> np.ndarray:
        """Return the tints, uint32 (n, 2), of cards at their feet, and above."""
        grass, tuft, lots = self._settings.grass, sown.tuft, sown.lots
        x, z = sown.roots.T
        strength = self._settings.ground.tone
        colour, light = (
            np.ascontiguousarray(of(x, z).T, np.float32)
            for of in (self._ground.drawn_colour, self._ground.light)
        )
        tone = between(0.84, 1.16, lots["tone"]) * light_tone
        bare = colour * tone

        # Half of a tuft's cards have its hue, the others their own.
        own_hue = lots["own_hue"]
        hue = np.where(own_hue < 0.5, lots["hue"].take(tuft), 2 * own_hue - 1)
        colour = colour.take(tuft, axis=1)
        colour = colour + grass.variety * (sward.hues(hue, tone.take(tuft), colour) - colour)
        brightness = between(0.88, 1.38, lots["brightness"])
        brightness += strength * between(-0.06, 0.14, lots["brightness"])
        if strength:
            bare, colour = turf_toned(bare.T, strength).T, turf_toned(colour.T, strength).T
        low = kinds == sward.FLOOR
        colour = np.where(low, 0.6 * bare.take(tuft, axis=1) + 0.4 * colour, colour)
        own = kinds >= sward.GREEN_KINDS
        doubled = np.ascontiguousarray(2.0 * self._ends[0].T, np.float32)
        shade = np.where(own, np.float32(0.5), colour / doubled.take(kinds, axis=1))
        shade *= light.take(tuft, axis=1) * np.where(own, 0.45 + 0.5 * brightness, brightness)

        # In the thick of the sward roots are dark; where a card stands alone, it has light.
        far = (sown.ranges / self._near).astype(np.float32)
        alone = np.clip(np.log(far) / 2.0, 0.0, 1.0)
        foot = shade * np.where(own, 1.0, 1.0 + sward.ROOTS * alone)
        foot *= 1.0 - strength * sward.SHADED * (1.0 - alone)
        return np.stack([packed(foot), packed(shade)], axis=1)


def _own_height(lots: np.ndarray) -> np.ndarray:
    """Return how much taller than their neighbours tufts are, fractions; ``lots`` are in 0..1."""
    return between(-0.35, 0.45, lots)


def _card_sizes(lots: np.ndarray) -> np.ndarray:
    """Return factors on the height of tufts by ``lots`` in 0..1: most are small, a few tall."""
    return 0.80 + 0.85 * lots**3
