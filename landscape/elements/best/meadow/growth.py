"""How the meadow grows: blades by cell of the map, in tufts and layers, made when they are needed.

A cell's blades are random, from the cell's own generators: they are the same whichever way the
walker came. With ``grass.fade`` they come in layers, each as large as all before it, and a far cell
has only the first ones. A layer is *sown* first, which is quick: where its tufts stand, and all its
random numbers. Tufts take *shape* when they are first seen: half of what is sown never is.
No OpenGL here.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from landscape.elements.best.meadow import sward
from landscape.elements.best.meadow.refined_blades import (
    ARRAYS,
    NEAR,
    NOTHING,
    THINNING,
    Patch,
    nearness,
    thinned_ranges,
)
from landscape.elements.best.meadow.rows import Rows, spans
from landscape.elements.best.meadow.shapes import Shapes, Sown
from landscape.elements.best.meadow.sowing import OF_TUFTS, lots_of
from landscape.elements.grass_cells import (
    CELL,
    bears_grass,
    cover,
    places_in_cells,
    shared_out,
)
from landscape.elements.ground import Ground
from landscape.elements.settings import Settings
from landscape.geometry.height_field import greenness

LAYER = 64  # chosen: blades in the first layer of a cell
TUFT_RADIUS = 0.017  # chosen: units, how far apart the roots of a tuft's blades are
KEPT = 12  # chosen: blades kept in memory, times those in view, for when the walker turns around
LEAST = 40_000  # chosen: the number of blades that are kept in any case, 7 MB


class Layer(NamedTuple):
    """A layer of a cell: its first blade, and which rows its tufts and its blades have."""

    first: int
    tufts: slice
    blades: slice


@dataclass
class Cell:
    """What is sown in a cell: its layers, and how many blades they have."""

    layers: list[Layer] = field(default_factory=list)
    blades: int = 0


class Growth:
    """The blades of all cells; ``counts`` (cells,) is how many each has when complete.

    ``shared`` (cells,) is how many each was to have, by which its blades are thinned out: that
    there are fewer is not known before they have been sown. ``tufts`` are all that are sown:
    ``places`` (t, 3) and how many units from there the farthest vertex is, ``sizes`` (t,); the
    ``ranges`` (t,) of the first of their blades, which are the longest; and how many ``blades``
    they have.
    """

    def __init__(
        self, settings: Settings, ground: Ground, seed: int, ends: tuple[np.ndarray, np.ndarray]
    ) -> None:
        """Distribute the blades over the cells at random, by ``seed``.

        ``ends`` are the mean colours (3,) of the blade's texture, at its upper part and its foot;
        of the sward's, those of each kind (kinds, 3).
        """
        self._settings = settings
        self._ground = ground
        self._seed = seed
        self.across = int(np.ceil(ground.field.size / CELL))
        share, count = cover(self._painted, self.across), settings.grass.count
        self.near = nearness(count / (share.sum() * CELL**2)) if share.any() else NEAR
        self.tuft_radius, self.thinning = TUFT_RADIUS, THINNING
        if settings.grass.sward:
            self.near *= sward.NEARER
            self.tuft_radius, self.thinning = sward.TUFT, sward.THINNING
        self.counts = shared_out(count, share, seed)
        self.shared = self.counts.copy()
        self.shapes = Shapes(settings, ground, ends, self.near, self.tuft_radius)
        self._lots = lots_of(settings.grass)
        self._of_tufts = [name for name in self._lots if name in OF_TUFTS]
        self._of_blades = [name for name in self._lots if name not in OF_TUFTS]
        self._cells: dict[int, Cell] = {}  # the most recently used last
        self.tufts, self._blades = self._bare()

    @property
    def grown(self) -> int:
        """How many blades are kept in memory."""
        return self._blades.count

    def _bare(self) -> tuple[Rows, Rows]:
        """Return the rows of tufts and of blades before any is sown.

        A tuft's blades begin at the row ``first`` of blades. ``far`` is how far away each blade
        would be drawn, which is its range in full precision. ``lots`` are random numbers in 0..1.
        """

        tufts = Rows(
            roots=np.empty((0, 2)),
            places=np.empty((0, 3), np.float32),
            sizes=np.empty(0, np.float32),
            ranges=np.empty(0, np.float32),
            first=np.empty(0, int),
            blades=np.empty(0, int),
            shaped=np.empty(0, bool),
            lots=np.empty((0, len(self._of_tufts))),
        )
        shapes = {name: getattr(NOTHING, name) for name in ARRAYS}
        blades = Rows(far=np.empty(0), lots=np.empty((0, len(self._of_blades))), **shapes)
        return tufts, blades

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

    def sown(self, cells: Sequence[int], wanted: Sequence[int]) -> np.ndarray:
        """Return the rows (t,) of tufts: of each cell those with its first ``wanted`` blades.

        The layers that are missing are all sown together, which takes much less time.
        """
        missing = []
        for number, least in zip(cells, wanted, strict=True):
            # Put back last, as the most recently used.
            cell = self._cells[number] = self._cells.pop(number, Cell())
            total, have = int(self.counts[number]), cell.blades
            while have < min(least, total):
                end = self._layer(total, have)
                missing.append((number, have, end))
                have = end
        if missing:
            self._sow(missing)

        each = max(self._settings.grass.tufts, 1)
        firsts, counts = [], []
        for number, least in zip(cells, wanted, strict=True):
            for first, tufts, _ in self._cells[number].layers:
                if first < least:
                    firsts.append(tufts.start)
                    counts.append(min(tufts.stop - tufts.start, -((first - least) // each)))

        return spans(np.array(firsts, int), np.array(counts, int))

    def blades(self, tufts: np.ndarray) -> Patch:
        """Return the blades of tufts, given by their rows (t,), one after another."""
        return self.patch(self.rows(tufts))

    def patch(self, rows: np.ndarray) -> Patch:
        """Return blades, given by their rows (n,)."""
        return Patch(*(self._blades.take(name, rows) for name in ARRAYS))

    def rows(self, tufts: np.ndarray) -> np.ndarray:
        """Return the rows (n,) of the blades of tufts (t,), which take shape if they have none."""
        shapeless = tufts[~self.tufts.take("shaped", tufts)]
        if len(shapeless):
            self._shape(shapeless)
        return self._rows(tufts)

    def _rows(self, tufts: np.ndarray) -> np.ndarray:
        return spans(self.tufts.take("first", tufts), self.tufts.take("blades", tufts))

    def of(self, name: str, rows: np.ndarray) -> np.ndarray:
        """Return one array of a :class:`Patch` of blades, given by their rows (n,)."""
        return self._blades.take(name, rows)

    def forget(self, in_view: int) -> None:
        """Drop the least recently used cells if too many blades are kept: down to half of those.

        The same blades grow again when they come into view. ``in_view`` blades would be drawn now
        with all their detail. The rows of all tufts change.
        """
        most = max(KEPT * in_view, LEAST)
        if self.grown <= most:
            return
        left = self.grown
        while left > most // 2:
            number = next(iter(self._cells))
            left -= self._cells.pop(number).blades
            self.counts[number] = self.shared[number]

        layers = [layer for cell in self._cells.values() for layer in cell.layers]
        self.tufts.keep(covered(layer.tufts for layer in layers))
        self._blades.keep(covered(layer.blades for layer in layers))
        counts = self.tufts["blades"]
        self.tufts["first"][:] = np.cumsum(counts) - counts
        at = 0, 0
        for cell in self._cells.values():
            for k, (first, tuft, blade) in enumerate(cell.layers):
                ends = at[0] + tuft.stop - tuft.start, at[1] + blade.stop - blade.start
                cell.layers[k] = Layer(first, slice(at[0], ends[0]), slice(at[1], ends[1]))
                at = ends

    def _layer(self, total: int, have: int) -> int:
        """Return the end of the layer that begins at blade ``have``; each doubles the blades."""
        return min(max(LAYER, 2 * have), total) if self._settings.grass.fade else total

    def _ranges(self, cell: int, first: int, last: int) -> np.ndarray:
        """Return how far away the blades ``first`` to ``last`` of a cell would be drawn."""
        if not self._settings.grass.fade:
            return np.full(last - first, self._settings.grass.radius)
        return thinned_ranges(int(self.shared[cell]), self.near, first, last, self.thinning)

    def _sow(self, layers: Sequence[tuple[int, int, int]]) -> None:
        """Sow several layers, each given by cell, first blade and last."""
        rngs = [
            np.random.default_rng([self._seed, 7, cell, *([first] if first else [])])
            for cell, first, _ in layers
        ]
        each = max(self._settings.grass.tufts, 1)
        found = places_in_cells(
            [cell for cell, _, _ in layers],
            self.across,
            [-(-(last - first) // each) for _, first, last in layers],
            rngs,
            self.suits,
        )
        drawn: dict[str, list[np.ndarray]] = {name: [] for name in self._lots}
        roots, ranges, counts = [], [], []
        tuft, blade = self.tufts.count, self._blades.count
        for places, (number, first, last), rng in zip(found, layers, rngs, strict=True):
            cell = self._cells[number]
            if cell.blades < first:
                continue
            # Few places here may be suitable: the cell keeps the blades that have one.
            count = min(each * len(places), last - first)
            for name, values in drawn.items():
                values.append(rng.random(len(places) if name in OF_TUFTS else count))
            if count < last - first:
                self.counts[number] = first + count
            # The blades of a tuft follow each other; the last tuft of a layer may have fewer.
            blades = np.full(len(places), each)
            blades[-1:] -= each * len(places) - count
            roots.append(places)
            counts.append(blades)
            ranges.append(self._ranges(number, first, first + count))
            rows = slice(tuft, tuft + len(places)), slice(blade, blade + count)
            tuft, blade = rows[0].stop, rows[1].stop
            cell.layers.append(Layer(first, *rows))
            cell.blades += count

        lots = {name: np.concatenate(each) for name, each in drawn.items()}
        self._add(np.concatenate(roots), np.concatenate(counts), np.concatenate(ranges), lots)

    def _add(
        self, roots: np.ndarray, counts: np.ndarray, ranges: np.ndarray, lots: dict[str, np.ndarray]
    ) -> None:
        """Add rows of tufts at ``roots`` (t, 2) and their blades, ``counts`` (t,) of each."""
        first = np.cumsum(counts) - counts
        longest = ranges[first].astype(np.float32)
        x, z = roots.T
        of_tufts = np.array([lots[name] for name in self._of_tufts])
        of_tufts = of_tufts.reshape(len(self._of_tufts), len(counts))
        of_blades = np.array([lots[name] for name in self._of_blades])
        self.tufts.add(
            len(counts),
            roots=roots,
            places=np.stack([x, self._ground.field.terrain_height(x, z), z], axis=1),
            sizes=self.shapes.sizes(longest, lots),
            ranges=longest,
            first=self._blades.count + first,
            blades=counts,
            shaped=np.zeros(len(counts), bool),
            lots=of_tufts.T,
        )
        self._blades.add(len(ranges), far=ranges, lots=of_blades.T)

    def _shape(self, tufts: np.ndarray) -> None:
        """Give the blades of tufts (t,) their shape."""
        rows = self._rows(tufts)
        counts = self.tufts.take("blades", tufts)
        lots = dict(zip(self._of_tufts, self.tufts.take("lots", tufts).T, strict=True))
        lots.update(zip(self._of_blades, self._blades.take("lots", rows).T, strict=True))
        sown = Sown(
            self.tufts.take("roots", tufts),
            np.repeat(np.arange(len(tufts)), counts),
            self._blades.take("far", rows),
            lots,
        )
        shaped = self.shapes.of(sown)
        for name in ARRAYS:
            self._blades[name][rows] = getattr(shaped, name)
        self.tufts["shaped"][tufts] = True


def covered(rows: Iterable[slice]) -> np.ndarray:
    """Return the numbers (n,) of all rows of several slices."""
    ends = np.array([(each.start, each.stop) for each in rows], int).reshape(-1, 2)
    return spans(ends[:, 0], ends[:, 1] - ends[:, 0])
