"""How the meadow grows: blades by cell of the map, in tufts and layers, made when they are needed.

A cell's blades are random, from the cell's own generators: they are the same whichever way the
walker came. With ``grass.fade`` they come in layers, each as large as all before it, and a far cell
has only the first ones. No OpenGL here.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from landscape.elements.best.meadow import sward
from landscape.elements.best.meadow.refined_blades import (
    LUSH,
    NEAR,
    THINNING,
    WIDENING,
    Dice,
    Patch,
    arched,
    blade_tints,
    hues,
    joined,
    lushness,
    nearness,
    thinned_ranges,
)
from landscape.elements.grass import blade_corners, blade_vertices
from landscape.elements.grass_cells import (
    CELL,
    bears_grass,
    cover,
    places_in_cells,
    shared_out,
)
from landscape.elements.ground import Ground
from landscape.geometry.height_field import greenness
from landscape.settings import Settings

LAYER = 64  # chosen: blades in the first layer of a cell
TUFT_RADIUS = 0.017  # chosen: units, how far apart the roots of a tuft's blades are
KEPT = 12  # chosen: blades kept in memory, times those in view, for when the walker turns around
LEAST = 40_000  # chosen: the number of blades that are kept in any case, 4 MB


class Rooted(NamedTuple):
    """Where blades stand: ``positions`` (n, 3), ``angles`` (n,) and ``ranges`` (n,).

    ``roots`` (t, 2) are the tufts' places on the map, ``tuft`` (n,) is each blade's; ``tufts`` and
    ``blades`` count those of each layer.
    """

    positions: np.ndarray
    angles: np.ndarray
    ranges: np.ndarray
    roots: np.ndarray
    tuft: np.ndarray
    tufts: list[int]
    blades: list[int]


class Growth:
    """The blades of all cells; ``counts`` (cells,) is how many each has when complete.

    ``shared`` (cells,) is how many each was to have, by which its blades are thinned out: that
    there are fewer is not known before they have grown.
    """

    def __init__(
        self, settings: Settings, ground: Ground, seed: int, ends: tuple[np.ndarray, np.ndarray]
    ) -> None:
        """Distribute the blades over the cells at random, by ``seed``.

        ``ends`` are the mean colours (3,) of the blade's texture, at its upper part and its foot;
        of the sward's, those of each kind (kinds, 3).
        """
        self._settings, self._ground, self._seed, self._ends = settings, ground, seed, ends
        self.across = int(np.ceil(ground.field.size / CELL))
        share, count = cover(self._painted, self.across), settings.grass.count
        self.near = nearness(count / (share.sum() * CELL**2)) if share.any() else NEAR
        self.tuft_radius, self.thinning = TUFT_RADIUS, THINNING
        if settings.grass.sward:
            self.near *= sward.NEARER
            self.tuft_radius, self.thinning = sward.TUFT, sward.THINNING
        self.counts = shared_out(count, share, seed)
        self.shared = self.counts.copy()
        self._patches: dict[int, Patch] = {}  # by cell, the most recently used last
        self.grown = 0

    def suits(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Return 0..1: on land, outside the castle and, if tinted, on ground that is seen green.

        The sward stands in clumps, and hardly on trails.
        """
        green = self._green(x, z, self._ground.drawn_colour)
        return green * sward.standing(x, z) if self._settings.grass.sward else green

    def _painted(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Return the same for the ground as painted, by which the blades are shared out."""
        return self._green(x, z, self._ground.colour)

    def _green(
        self, x: np.ndarray, z: np.ndarray, colour: Callable[[np.ndarray, np.ndarray], np.ndarray]
    ) -> np.ndarray:
        land = bears_grass(self._ground.field, self._settings.castle, x, z)
        if not self._settings.grass.tinted:
            return land
        green = greenness(colour(x, z))
        return land * (sward.covered(green) if self._settings.grass.sward else green)

    def patch(self, cell: int, wanted: int | None = None) -> Patch:
        """Return at least the first ``wanted`` blades of a cell, or all."""
        return self.patches([cell], [int(self.counts[cell]) if wanted is None else wanted])[0]

    def patches(self, cells: Sequence[int], wanted: Sequence[int]) -> list[Patch]:
        """Return of each cell at least the first so many blades, or all that it has.

        The layers that are missing are all made together, which takes much less time.
        """
        missing = []
        for cell, least in zip(cells, wanted, strict=True):
            total, have = int(self.counts[cell]), 0
            if cell in self._patches:
                have = len(self._patches[cell].positions)
            while have < min(least, total) or (have == 0 and cell not in self._patches):
                end = self._layer(total, have)
                missing.append((cell, have, end))
                have = end
                if total == 0:
                    break
        made = self._grow(missing) if missing else []
        for (cell, first, end), more in zip(missing, made, strict=True):
            patch = self._patches.get(cell)
            if patch is not None and len(patch.positions) < first:
                continue
            self._patches[cell] = more if patch is None else joined([patch, more])
            self.grown += len(more.positions)
            if len(more.positions) < end - first:
                # Few places here are suitable: the cell keeps the blades that have one.
                self.counts[cell] = first + len(more.positions)
        found = []
        for cell in cells:
            found.append(self._patches.pop(cell))
            self._patches[cell] = found[-1]
        return found

    def forget(self, in_view: int) -> None:
        """Drop the least recently used cells while too many blades are kept.

        The same blades grow again when they come into view. ``in_view`` blades would be drawn now
        with all their detail.
        """
        most = max(KEPT * in_view, LEAST)
        while self.grown > most:
            cell = next(iter(self._patches))
            self.grown -= len(self._patches.pop(cell).positions)
            self.counts[cell] = self.shared[cell]

    def _layer(self, total: int, have: int) -> int:
        """Return the end of the layer that begins at blade ``have``; each doubles the blades."""
        return min(max(LAYER, 2 * have), total) if self._settings.grass.fade else total

    def _ranges(self, cell: int, first: int, last: int) -> np.ndarray:
        """Return how far away the blades ``first`` to ``last`` of a cell would be drawn."""
        return thinned_ranges(int(self.shared[cell]), self.near, first, last, self.thinning)

    def _grow(self, layers: Sequence[tuple[int, int, int]]) -> list[Patch]:
        """Return the blades of several layers, each given by cell, first blade and last."""
        grass, seed = self._settings.grass, self._seed
        rngs = [
            np.random.default_rng([seed, 7, cell, *([first] if first else [])])
            for cell, first, _ in layers
        ]
        dice, each = Dice(rngs), max(grass.tufts, 1)
        found = places_in_cells(
            [cell for cell, _, _ in layers],
            self.across,
            [-(-(last - first) // each) for _, first, last in layers],
            rngs,
            self.suits,
        )
        tufts = [len(roots) for roots in found]
        blades = [
            min(each * count, last - first)
            for count, (_, first, last) in zip(tufts, layers, strict=True)
        ]
        roots = np.concatenate(found)
        # The blades of a tuft follow each other; the last tuft of a layer may have fewer.
        starts = np.cumsum([0, *tufts[:-1]])
        tuft = np.concatenate(
            [start + np.arange(n) // each for start, n in zip(starts, blades, strict=True)]
        )
        angles = dice.uniform(0.0, 1.0, blades) * 2 * np.pi
        xz = roots[tuft]
        if grass.tufts:
            # Outwards, the way a blade leans: its tip bends to (sin, cos) of its angle.
            away = self.tuft_radius * np.sqrt(dice.uniform(0.0, 1.0, blades))
            xz = xz + away[:, None] * np.stack([np.sin(angles), np.cos(angles)], axis=1)
        positions = np.insert(xz, 1, self._ground.field.terrain_height(xz[:, 0], xz[:, 1]), axis=1)
        ranges = np.full(len(xz), grass.radius)
        if grass.fade:
            ranges = np.concatenate(
                [
                    self._ranges(cell, first, first + count)
                    for (cell, first, _), count in zip(layers, blades, strict=True)
                ]
            )
        grow = self._cards if grass.sward else self._blades
        shapes = grow(Rooted(positions, angles, ranges, roots, tuft, tufts, blades), dice)
        vertices, tints, kinds = shapes
        whole = Patch(
            positions.astype(np.float32), vertices, tints, ranges.astype(np.float32), kinds
        )
        ends = np.cumsum(blades)
        return [
            whole.only(np.arange(end - count, end)) for end, count in zip(ends, blades, strict=True)
        ]

    def _blades(self, rooted: Rooted, dice: Dice) -> tuple[np.ndarray, ...]:
        """Return vertices, tints and kinds of blades, all of them of the report's shape."""
        grass, (positions, angles, ranges, roots, tuft, tufts, blades) = (
            self._settings.grass,
            rooted,
        )
        vertices = blade_vertices(positions, arched(blade_corners(angles), grass.arch), grass.scale)
        if grass.fade:
            grown = np.empty((len(positions), 1, 3))
            drawn = np.minimum(ranges, grass.radius)
            wider = np.maximum(drawn / self.near, 1.0) ** WIDENING
            grown[..., 0] = grown[..., 2] = wider[:, None]
            grown[..., 1] = dice.uniform(0.6, 1.25, blades)[:, None]
            grown[:, 0, 1] *= 1.0 + grass.variety * tallness(roots, tufts, dice)[tuft]
            feet = positions[:, None]
            vertices = ((vertices - feet) * grown + feet).astype(np.float32)
        tints = np.full((len(positions), 5, 4), 255, np.uint8)
        if grass.tinted:
            colour = self._ground.drawn_colour(roots[:, 0], roots[:, 1])
            colour *= 1.0 + grass.variety * (hues(tufts, dice) - 1.0)
            colour *= 1.0 + grass.variety * lushness(roots[:, 0], roots[:, 1])[:, None] * LUSH
            colour *= self._ground.light(roots[:, 0], roots[:, 1])
            brightness = dice.uniform(0.92, 1.28, blades)
            tints[..., :3] = blade_tints(colour[tuft], brightness, *self._ends)
        return vertices, tints, np.zeros(len(positions), np.uint8)

    def _cards(self, rooted: Rooted, dice: Dice) -> tuple[np.ndarray, ...]:
        """Return vertices, tints and kinds of the sward's cards."""
        grass, (positions, angles, ranges, roots, tuft, tufts, blades) = (
            self._settings.grass,
            rooted,
        )
        x, z = roots.T
        bold = np.minimum(ranges / self.near, 40.0) ** sward.BOLD
        draw = dice.uniform(0.0, 1.0, blades)
        kinds = sward.kinds_at(x, z, tuft, draw, bold, grass.flowers)
        lean = grass.arch * dice.uniform(-2.2, 2.2, blades)
        corners = sward.card_corners(angles, kinds, lean)
        size = 0.80 + 0.85 * dice.uniform(0.0, 1.0, tufts) ** 3  # most are small, a few tall
        tall = 1.0 + grass.variety * (sward.tallness(x, z) * size - 1.0)
        corners *= (tall[tuft] * dice.uniform(0.6, 1.25, blades))[:, None, None]
        vertices = blade_vertices(positions, corners, grass.scale)
        tints = np.full((len(positions), 5, 4), 255, np.uint8)
        if grass.tinted:
            colour, light = self._ground.drawn_colour(x, z), self._ground.light(x, z)
            tone = dice.uniform(0.84, 1.16, tufts) * (1.0 + 0.10 * sward.waves(x, z, 1.3, 28))
            colour, tone = colour[tuft], tone[tuft]
            # Half of a tuft's cards have its hue, the others their own.
            own_hue = dice.uniform(0.0, 1.0, blades)
            drawn = np.where(own_hue < 0.5, dice.uniform(0.0, 1.0, tufts)[tuft], 2 * own_hue - 1)
            hue = sward.hues(drawn, tone, colour)
            bare = colour * tone[:, None]
            colour = colour + grass.variety * (hue - colour)
            brightness = dice.uniform(0.88, 1.38, blades)[:, None]
            own = (kinds >= sward.GREEN_KINDS)[:, None]
            low = (kinds == sward.FLOOR)[:, None]
            colour = np.where(low, 0.6 * bare + 0.4 * colour, colour)
            shade = np.where(own, 0.5, colour / (2.0 * self._ends[0][kinds]))
            shade *= light[tuft] * np.where(own, 0.45 + 0.5 * brightness, brightness)
            tints[..., :3] = (np.clip(shade, 0, 1) * 255).astype(np.uint8)[:, None]
            # In the thick of the sward roots are dark; where a card stands alone, it has light.
            alone = np.clip(np.log(ranges / self.near) / 2.0, 0.0, 1.0)[:, None]
            foot = np.where(own, shade, (1.0 + sward.ROOTS * alone) * shade)
            tints[:, :2, :3] = (np.clip(foot, 0, 1) * 255).astype(np.uint8)[:, None]
        return vertices, tints, kinds


def tallness(roots: np.ndarray, tufts: Sequence[int], dice: Dice) -> np.ndarray:
    """Return how much taller than the mean tufts at roots (n, 2) are: fractions above -1."""
    own = dice.uniform(-0.35, 0.45, tufts)
    return np.asarray(own + 0.45 * lushness(roots[:, 0], roots[:, 1]))
