"""How the meadow grows: blades by cell of the map, in tufts and layers, made when they are needed.

A cell's blades are random, from the cell's own generators: they are the same whichever way the
walker came. With ``grass.fade`` they come in layers, each as large as all before it, and a far cell
has only the first ones. A blade of the layers beyond FAR_LAYERS is seen from close by only, so
these do not grow in a whole cell at once but in the PARTS by PARTS squares of it that are near.

A layer is *sown* first, which is quick: where its tufts stand, and all its random numbers. What is
sown then takes *shape*: vertices, tints and kinds. No OpenGL here.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from landscape.elements.best.meadow import sward
from landscape.elements.best.meadow.refined_blades import (
    LUSH,
    NEAR,
    NOTHING,
    THINNING,
    WIDENING,
    Patch,
    arched,
    blade_tints,
    count_at,
    hues,
    joined,
    lushness,
    nearness,
    sizes_of,
    thinned_ranges,
)
from landscape.elements.best.meadow.sowing import OF_TUFTS, Sown, between, lots_of, together
from landscape.elements.best.terrain.tone import turf_toned
from landscape.elements.grass import blade_corners, blade_vertices
from landscape.elements.grass_cells import (
    CELL,
    HALF_DIAGONAL,
    bears_grass,
    cover,
    places_in_cells,
    shared_out,
    visible_cells,
)
from landscape.elements.ground import Ground
from landscape.elements.settings import Settings
from landscape.frame import Frame
from landscape.geometry.height_field import greenness

LAYER = 64  # chosen: blades in the first layer of a cell
FAR_LAYERS = 1024  # chosen: blades of a cell that grow in all of it; the ends of a layer
PARTS = 4  # chosen: squares along a cell's side; in each the further blades grow by themselves
PART = CELL / PARTS
TUFT_RADIUS = 0.017  # chosen: units, how far apart the roots of a tuft's blades are
KEPT = 12  # chosen: blades kept in memory, times those in view, for when the walker turns around
LEAST = 40_000  # chosen: the number of blades that are kept in any case, 4 MB


@dataclass
class Cell:
    """What has grown in a cell: its first blades, and parts of its further layers.

    ``layers`` are by their first blade: what is sown, and in which square (t,) each tuft stands.
    ``parts`` are by layer and square. ``blades`` are those that it keeps in memory.
    """

    patch: Patch = NOTHING
    layers: dict[int, tuple[Sown, np.ndarray]] = field(default_factory=dict)
    parts: dict[tuple[int, int], Patch] = field(default_factory=dict)
    blades: int = 0

    def sown_in(self, first: int, part: int) -> Sown:
        """Return what is sown of a layer in a square."""
        sown, squares = self.layers[first]
        return sown.only(squares == part)


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
        self._settings = settings
        self._ground = ground
        self._seed = seed
        self._ends = ends
        self.across = int(np.ceil(ground.field.size / CELL))
        share, count = cover(self._painted, self.across), settings.grass.count
        self.near = nearness(count / (share.sum() * CELL**2)) if share.any() else NEAR
        self.tuft_radius, self.thinning = TUFT_RADIUS, THINNING
        if settings.grass.sward:
            self.near *= sward.NEARER
            self.tuft_radius, self.thinning = sward.TUFT, sward.THINNING
        self.counts = shared_out(count, share, seed)
        self.shared = self.counts.copy()
        self._cells: dict[int, Cell] = {}  # the most recently used last
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
        for number, least in zip(cells, wanted, strict=True):
            total, have = int(self.counts[number]), 0
            if number in self._cells:
                have = len(self._cells[number].patch.positions)
            while have < min(least, total) or (have == 0 and number not in self._cells):
                end = self._layer(total, have)
                missing.append((number, have, end))
                have = end
                if total == 0:
                    break

        made = self._shape(self._sow(missing)) if missing else []
        for (number, first, end), more in zip(missing, made, strict=True):
            cell = self._cells.setdefault(number, Cell())
            if len(cell.patch.positions) < first:
                continue
            cell.patch = joined([cell.patch, more]) if first else more
            self._count(cell, len(more.positions))
            if len(more.positions) < end - first:
                # Few places here are suitable: the cell keeps the blades that have one.
                self.counts[number] = first + len(more.positions)

        found = []
        for number in cells:
            # Put back last, as the most recently used.
            cell = self._cells[number] = self._cells.pop(number)
            found.append(cell.patch)

        return found

    def parts(
        self, frame: Frame, numbers: np.ndarray, radius: float, margin: float, angle: float
    ) -> list[Patch]:
        """Return the blades beyond FAR_LAYERS of some cells, of their squares that may be seen.

        Their numbers (n,) are those of cells of which the first blades have grown. The eye may
        still move ``margin`` units and turn ``angle`` radians.
        """
        wanted = self._wanted(frame, numbers, radius, margin, angle)
        chosen, shapeless = [], []
        first = FAR_LAYERS
        while (wanted > first).any():
            for row in np.flatnonzero((wanted > first).any(axis=1)).tolist():
                number = int(numbers[row])
                cell, total = self._cells[number], int(self.counts[number])
                if total <= first:
                    continue
                if first not in cell.layers:
                    self._sow_layer(number, cell, first, total)
                for part in np.flatnonzero(wanted[row] > first).tolist():
                    chosen.append((cell, first, part))
                    if (first, part) not in cell.parts:
                        shapeless.append((cell, first, part))
            first *= 2

        if shapeless:
            made = self._shape([cell.sown_in(first, part) for cell, first, part in shapeless])
            for (cell, first, part), patch in zip(shapeless, made, strict=True):
                cell.parts[first, part] = patch

        return [cell.parts[first, part] for cell, first, part in chosen]

    def _wanted(
        self, frame: Frame, numbers: np.ndarray, radius: float, margin: float, angle: float
    ) -> np.ndarray:
        """Return how many blades of each cell would be seen in its squares, int (n, squares)."""
        rows, columns = np.divmod(np.arange(PARTS * PARTS), PARTS)
        x = ((numbers % self.across)[:, None] + (columns + 0.5) / PARTS).ravel() * CELL
        z = ((numbers // self.across)[:, None] + (rows + 0.5) / PARTS).ravel() * CELL
        centres = np.stack([x, self._ground.field.terrain_height(x, z), z], axis=1)
        near = np.hypot(x - frame.pose.x, z - frame.pose.z)
        near -= PART * HALF_DIAGONAL + self.tuft_radius + margin
        shared = np.repeat(self.shared[numbers], PARTS * PARTS)
        wanted = count_at(shared, self.near, near, frame.detail.grass, self.thinning)
        wanted *= visible_cells(frame, centres, radius, margin, angle, PART)
        return np.asarray(wanted.reshape(len(numbers), PARTS * PARTS))

    def _sow_layer(self, number: int, cell: "Cell", first: int, total: int) -> None:
        """Sow the layer of a cell that begins at a blade."""
        end = self._layer(total, first)
        sown = self._sow([(number, first, end)])[0]
        corner = np.array(divmod(number, self.across)[::-1]) * CELL
        column, row = np.clip(((sown.roots - corner) / PART).astype(int), 0, PARTS - 1).T
        cell.layers[first] = sown, row * PARTS + column
        self._count(cell, len(sown.tuft))
        if len(sown.tuft) < end - first:
            self.counts[number] = first + len(sown.tuft)

    def _count(self, cell: "Cell", blades: int) -> None:
        """Take note of blades that a cell keeps."""
        cell.blades += blades
        self.grown += blades

    def forget(self, in_view: int) -> None:
        """Drop the least recently used cells while too many blades are kept.

        The same blades grow again when they come into view. ``in_view`` blades would be drawn now
        with all their detail.
        """
        most = max(KEPT * in_view, LEAST)
        while self.grown > most:
            number = next(iter(self._cells))
            self.grown -= self._cells.pop(number).blades
            self.counts[number] = self.shared[number]

    def _layer(self, total: int, have: int) -> int:
        """Return the end of the layer that begins at blade ``have``; each doubles the blades."""
        return min(max(LAYER, 2 * have), total) if self._settings.grass.fade else total

    def _ranges(self, cell: int, first: int, last: int) -> np.ndarray:
        """Return how far away the blades ``first`` to ``last`` of a cell would be drawn."""
        return thinned_ranges(int(self.shared[cell]), self.near, first, last, self.thinning)

    def _sow(self, layers: Sequence[tuple[int, int, int]]) -> list[Sown]:
        """Return what is sown in several layers, each given by cell, first blade and last."""
        grass, seed = self._settings.grass, self._seed
        rngs = [
            np.random.default_rng([seed, 7, cell, *([first] if first else [])])
            for cell, first, _ in layers
        ]
        each, names = max(grass.tufts, 1), lots_of(grass)
        found = places_in_cells(
            [cell for cell, _, _ in layers],
            self.across,
            [-(-(last - first) // each) for _, first, last in layers],
            rngs,
            self.suits,
        )
        sown = []
        for roots, (cell, first, last), rng in zip(found, layers, rngs, strict=True):
            # The blades of a tuft follow each other; the last tuft of a layer may have fewer.
            count = min(each * len(roots), last - first)
            lots = {name: rng.random(len(roots) if name in OF_TUFTS else count) for name in names}
            ranges = np.full(count, grass.radius)
            if grass.fade:
                ranges = self._ranges(cell, first, first + count)
            sown.append(Sown(roots, np.arange(count) // each, ranges, lots))

        return sown

    def _shape(self, layers: Sequence[Sown]) -> list[Patch]:
        """Return the blades of what is sown in several layers."""
        grass, whole = self._settings.grass, together(layers)
        tuft, lots = whole.tuft, whole.lots
        angles = lots["angle"] * 2 * np.pi
        xz = whole.roots[tuft]
        if grass.tufts:
            # Outwards, the way a blade leans: its tip bends to (sin, cos) of its angle.
            away = self.tuft_radius * np.sqrt(lots["outwards"])
            xz = xz + away[:, None] * np.stack([np.sin(angles), np.cos(angles)], axis=1)

        positions = np.insert(xz, 1, self._ground.field.terrain_height(xz[:, 0], xz[:, 1]), axis=1)
        grow = self._cards if grass.sward else self._blades
        vertices, tints, kinds = grow(positions, angles, whole)
        places, ranges = positions.astype(np.float32), whole.ranges.astype(np.float32)
        patch = Patch(places, vertices, tints, ranges, kinds, sizes_of(places, vertices))
        ends = np.cumsum([len(layer.tuft) for layer in layers]).tolist()

        # Copies: a part of an array would keep all of it in memory.
        return [
            patch.only(np.arange(end - len(layer.tuft), end))
            for end, layer in zip(ends, layers, strict=True)
        ]

    def _blades(
        self, positions: np.ndarray, angles: np.ndarray, sown: Sown
    ) -> tuple[np.ndarray, ...]:
        """Return vertices, tints and kinds of blades, all of them of the report's shape."""
        grass = self._settings.grass
        roots = sown.roots
        tuft = sown.tuft
        lots = sown.lots
        vertices = blade_vertices(positions, arched(blade_corners(angles), grass.arch), grass.scale)
        if grass.fade:
            grown = np.empty((len(positions), 1, 3))
            drawn = np.minimum(sown.ranges, grass.radius)
            wider = np.maximum(drawn / self.near, 1.0) ** WIDENING
            grown[..., 0] = grown[..., 2] = wider[:, None]
            grown[..., 1] = between(0.6, 1.25, lots["height"])[:, None]
            grown[:, 0, 1] *= 1.0 + grass.variety * tallness(roots, lots["size"])[tuft]
            feet = positions[:, None]
            vertices = ((vertices - feet) * grown + feet).astype(np.float32)

        tints = np.full((len(positions), 5, 4), 255, np.uint8)
        if grass.tinted:
            colour = self._ground.drawn_colour(roots[:, 0], roots[:, 1])
            hue = hues(lots["green"], lots["straw"], lots["pale"])
            colour *= 1.0 + grass.variety * (hue - 1.0)
            colour *= 1.0 + grass.variety * lushness(roots[:, 0], roots[:, 1])[:, None] * LUSH
            colour *= self._ground.light(roots[:, 0], roots[:, 1])
            brightness = between(0.92, 1.28, lots["brightness"])
            tints[..., :3] = blade_tints(colour[tuft], brightness, *self._ends)

        return vertices, tints, np.zeros(len(positions), np.uint8)

    def _cards(
        self, positions: np.ndarray, angles: np.ndarray, sown: Sown
    ) -> tuple[np.ndarray, ...]:
        """Return vertices, tints and kinds of the sward's cards."""
        grass = self._settings.grass
        tuft = sown.tuft
        lots = sown.lots
        x, z = sown.roots.T
        bold = np.minimum(sown.ranges / self.near, 40.0) ** sward.BOLD
        kinds = sward.kinds_at(x, z, tuft, lots["kind"], bold, grass.flowers)
        corners = sward.card_corners(angles, kinds, grass.arch * between(-2.2, 2.2, lots["lean"]))
        size = 0.80 + 0.85 * lots["size"] ** 3  # most are small, a few tall
        tall = 1.0 + grass.variety * (sward.tallness(x, z) * size - 1.0)
        corners *= (tall[tuft] * between(0.6, 1.25, lots["height"]))[:, None, None]
        vertices = blade_vertices(positions, corners, sward.card_scale(grass.scale))
        tints = np.full((len(positions), 5, 4), 255, np.uint8)
        if grass.tinted:
            feet, tops = self._card_colours(sown, kinds)
            tints[:, :2, :3] = feet[:, None]
            tints[:, 2:, :3] = tops[:, None]

        return vertices, tints, kinds

    def _card_colours(self, sown: Sown, kinds: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the tints, uint8 (n, 3), of cards at their feet, and above."""
        grass = self._settings.grass
        tuft = sown.tuft
        lots = sown.lots
        x, z = sown.roots.T
        colour, light = self._ground.drawn_colour(x, z), self._ground.light(x, z)
        tone = between(0.84, 1.16, lots["tone"]) * (1.0 + 0.10 * sward.waves(x, z, 1.3, 28))
        colour, tone = colour[tuft], tone[tuft]

        # Half of a tuft's cards have its hue, the others their own.
        own_hue = lots["own_hue"]
        hue = sward.hues(np.where(own_hue < 0.5, lots["hue"][tuft], 2 * own_hue - 1), tone, colour)
        bare = colour * tone[:, None]
        colour = colour + grass.variety * (hue - colour)
        brightness = between(0.88, 1.38, lots["brightness"])[:, None]
        strength = self._settings.ground.tone
        brightness += strength * between(-0.06, 0.14, lots["brightness"])[:, None]
        own = (kinds >= sward.GREEN_KINDS)[:, None]
        if strength:
            bare, colour = turf_toned(bare, strength), turf_toned(colour, strength)
        low = (kinds == sward.FLOOR)[:, None]
        colour = np.where(low, 0.6 * bare + 0.4 * colour, colour)
        shade = np.where(own, 0.5, colour / (2.0 * self._ends[0][kinds]))
        shade *= light[tuft] * np.where(own, 0.45 + 0.5 * brightness, brightness)

        # In the thick of the sward roots are dark; where a card stands alone, it has light.
        alone = np.clip(np.log(sown.ranges / self.near) / 2.0, 0.0, 1.0)[:, None]
        foot = np.where(own, shade, (1.0 + sward.ROOTS * alone) * shade)
        foot *= 1.0 - strength * sward.SHADED * (1.0 - alone)
        feet, tops = (np.clip(colours, 0, 1) * 255 for colours in (foot, shade))
        return feet.astype(np.uint8), tops.astype(np.uint8)


def tallness(roots: np.ndarray, lots: np.ndarray) -> np.ndarray:
    """Return how much taller than the mean tufts at roots (n, 2) are: fractions above -1.

    ``lots`` (n,) are random numbers in 0..1.
    """
    own = between(-0.35, 0.45, lots)
    return np.asarray(own + 0.45 * lushness(roots[:, 0], roots[:, 1]))
