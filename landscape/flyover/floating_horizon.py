"""Hidden lines, removed with a floating horizon: one height per column of the screen, no z buffer.

Lines of a height field are drawn from front to back. Each column remembers the highest row that was
drawn in it, the horizon; what is farther away and lower is hidden by the terrain in between. Then
the horizon is raised by what was drawn (Wright, 1973). Wright's surfaces have an underside, which
needs a second horizon below; a terrain is solid down to the bottom of the picture.

The horizon is raised by surfaces, though only lines are known: a triangle's highest point in a
column is always on one of its edges. So each edge raises every column that it crosses, also where
it is above the screen, else far lines would shine through a mountain close by.

In arrays: the distances are divided into rings, and one table has a row for each ring and a column
for each column of the screen. Edges are entered where they are; a running minimum from ring to ring
makes each row of the table the horizon of all that is nearer. A pixel is seen if it is not below
the horizon at its own ring. :func:`above_one_by_one` is the loop; tests compare the two.

Columns must be vertical planes. Those of a camera that looks up or down, or rolls, are not. So all
is projected as if the camera looked level, where columns are vertical planes again. Pixels too
close to the point below the eye, or above it, have no place there, and count as seen: next to
nothing is hidden where one looks straight down.
"""

from collections.abc import Iterable, Iterator
from itertools import pairwise

import numpy as np

from landscape.flyover.bresenham import CHUNK
from landscape.flyover.camera import Frustum
from landscape.flyover.clipping import Lines
from landscape.flyover.levelled import LEAST, Levelled

# Rings for each doubling of the distance: so many leading bits of a float32's fraction. Each ring
# is 2 to 3 % of its distance thick, thinner than a triangle.
RING_BITS = 5
# Chosen. A pixel is compared with what is nearer by this many rings, else a line that leads away
# from the eye would hide its own next pixels; and it may be this many rows below the horizon, else
# lines that are rounded to pixels would hide each other.
BEFORE, SLACK = 1, 1.0
WIDEST = 6  # lines of up to 2 to the power of this columns are compared as a whole, chosen
STRIDE = 4  # of so many rings the nearest one's horizon is compared with whole lines, chosen
NEAREST = 0.4  # part of the lines, the nearest, that hide others before these are entered, chosen
NOWHERE = 1e9  # a row below all screens
Marks = tuple[np.ndarray, np.ndarray, np.ndarray]


class Horizon:
    """The horizon of a frame at all distances, and which pixels are seen above it."""

    def __init__(
        self, lines: Lines, levelled: Levelled, volume: Frustum, columns: range | None = None
    ) -> None:
        """Enter all lines of a frame; they must include those above the screen.

        With ``columns``, only what hides pixels of these columns of the picture.
        """
        self.levelled = levelled
        self.width = levelled.size[0]
        self.first, self.last = levelled.span(columns or range(self.width))
        farthest = max(lines.depth0.max(initial=0), lines.depth1.max(initial=0), volume.near)

        # Level distances differ from those along the line of sight.
        self.rings = rings(1 / np.array([self.levelled.least * volume.near / 1.25, 2 * farthest]))
        shape = int(np.ptp(self.rings)) + 1, self.last - self.first + 1
        self.nearness = Nearness(lines)

        # Hidden lines raise nothing. Most of them are found when only the nearest are entered.
        away = np.minimum(lines.depth0, lines.depth1)
        count = int(len(away) * NEAREST)
        near = away < np.partition(away, count)[count] if count else np.zeros(len(away), bool)
        self.table = rows_by_ring(self.marks(lines[near]), *shape)
        rest = np.flatnonzero(~near)
        rest = rest[~self.hides(lines[rest])] if count else rest
        self.table = rows_by_ring(self.marks(lines[rest]), *shape, self.table)
        found = np.concatenate([np.flatnonzero(near), rest])
        found.sort()
        self.kept = found[~self.hides(lines[found])]

    def marks(self, lines: Lines) -> Iterator[Marks]:
        """Yield the marks of lines: columns of the table, rows, and rings."""
        for column, row, near in crossings(lines, self.levelled, self.first, self.last):
            yield column - self.first, row, self.ring(near)

    def lowest(self, most: int) -> Iterator[np.ndarray]:
        """Yield the lowest horizon, the greatest row, of 2^k columns from each on, for k to most.

        Of STRIDE rings each it is that of the first, so that it holds for all of them. Columns
        from which there are not so many are left out.
        """
        found = self.table[::STRIDE]
        yield found
        for k in range(min(most, (found.shape[1]).bit_length() - 1)):
            found = np.maximum(found[:, : -(1 << k)], found[:, 1 << k :])
            yield found

    def hides(self, lines: Lines) -> np.ndarray:
        """Return lines of which no pixel is seen, bool (n,); not all such lines are found.

        That saves most of the work where hills hide what is behind them: a line's highest end is
        compared with the lowest horizon over its columns, at the distance of its nearer end. Two
        powers of two that overlap cover the columns.
        """
        levelled = self.levelled
        column0, row0, level0 = levelled.pixels(lines.x0, lines.y0)
        column1, row1, level1 = levelled.pixels(lines.x1, lines.y1)
        least: np.ndarray | float = 1.0
        if level0 is not None and level1 is not None:
            least = np.minimum(level0, level1)

        # A pixel is up to one beside the line, which may be more on the level picture.
        aside = 2 / least
        top = np.minimum(row0, row1) - (SLACK + 1) * aside * aside
        near = 1.01 / (np.minimum(lines.depth0, lines.depth1) * least)
        ring = self.ring(near) - BEFORE
        last = self.table.shape[1] - 1
        first, end = (
            np.minimum(np.maximum(each - self.first, 0), last).astype(np.int64)
            for each in (np.minimum(column0, column1) - aside, np.maximum(column0, column1) + aside)
        )
        width = (end - first + 1).astype(np.float64)
        power = np.frexp(width)[1] - 1
        may = (ring >= 0) & (power <= WIDEST) & (least > 1.1 * LEAST)
        hidden = np.zeros(len(may), bool)
        most = int(power[may].max(initial=0))
        for k, horizon in enumerate(self.lowest(most)):
            at = np.flatnonzero(may & (power == k))
            begin = ring[at] // STRIDE * horizon.shape[1]
            row = horizon.ravel().take(begin + first[at])
            begin += end[at] - ((1 << k) - 1)
            np.maximum(row, horizon.ravel().take(begin), out=row)
            hidden[at] = top[at] > row

        return hidden

    def shows(self, at: np.ndarray, owner: np.ndarray) -> np.ndarray:
        """Return which pixels of the lines are seen, bool (n,).

        ``at`` (n,) is each pixel's place in the picture and ``owner`` its line, as they come from
        :mod:`.bresenham`.
        """
        y, x = np.divmod(at, self.width)
        longer = np.where(self.nearness.steep.take(owner), y, x)
        return self.sees(x.astype(np.float32), y.astype(np.float32), longer, owner)

    def sees(
        self, x: np.ndarray, y: np.ndarray, longer: np.ndarray, owner: np.ndarray
    ) -> np.ndarray:
        """Return the same for pixels at columns x and rows y, float32 (n,).

        ``longer`` is the one of them that goes along the longer sides of the lines.
        """
        near, levelled = self.nearness.along(owner, longer.astype(np.float32)), self.levelled
        if levelled.unchanged:
            place = (x - np.float32(self.first)).astype(np.intp)
            return above((place, y - np.float32(SLACK), self.ring(near) - BEFORE), self.table)
        if levelled.rows is not None:
            place = y.astype(np.intp)
            level, column, row = (each.take(place) for each in levelled.rows)
            near *= level
            x = x * np.float32(levelled.across[1])
            x *= level
            column += x
            meaningless = level >= np.float32(1 / LEAST)
        else:
            column, row, level = levelled.pixels(x, y)
            assert level is not None
            near /= level
            row -= SLACK / (level * level)
            meaningless = level <= LEAST

        np.maximum(column, self.first, out=column)
        np.minimum(column, self.last, out=column)
        column += np.float32(0.5 - self.first)
        pixels = column.astype(np.int32), row, self.ring(near) - BEFORE
        return above(pixels, self.table) | meaningless

    def ring(self, near: np.ndarray) -> np.ndarray:
        """Return the rings, int64 (n,), of points by their inverse distances; 0 is the nearest."""
        first, last = self.rings
        found = first - rings(near)
        np.maximum(found, 0, out=found)
        np.minimum(found, first - last, out=found)
        return found.astype(np.int64)


def rings(near: np.ndarray) -> np.ndarray:
    """Return a number for each inverse distance, int32 (n,), nearly in proportion to its logarithm.

    The bits of a positive float32, its exponent and its fraction, read as a whole number, increase
    by as much from each power of two to the next.
    """
    return near.astype(np.float32, copy=False).view(np.int32) >> np.int32(23 - RING_BITS)


def rows_by_ring(
    edges: Iterable[Marks], count: int, columns: int, table: np.ndarray | None = None
) -> np.ndarray:
    """Return the horizon at each of ``count`` rings, float32 (count, columns).

    ``edges`` are columns from 0 to ``columns`` - 1, rows, and rings, some at a time. If there is a
    ``table`` already, they are entered into that.
    """
    flat = np.full(count * columns, NOWHERE, np.float32) if table is None else table.ravel()
    begin = count if table is not None else 0
    for column, row, ring in edges:
        begin = min(begin, int(ring.min()))
        ring *= columns
        ring += column
        np.minimum.at(flat, ring, row)

    table = flat.reshape(count, columns)

    # In place and row by row: eight times as fast as minimum.accumulate along columns.
    for nearer, farther in pairwise(table[begin:]):
        np.minimum(nearer, farther, out=farther)
    return table


def above(pixels: Marks, table: np.ndarray) -> np.ndarray:
    """Return which pixels are not below the horizon at their ring; nothing is before ring 0."""
    column, row, ring = pixels
    place = np.maximum(ring, 0)
    place *= table.shape[1]
    place += column
    seen = row <= table.ravel().take(place)
    seen |= ring < 0
    return np.asarray(seen)


def above_one_by_one(pixels: Marks, edges: Marks, count: int, columns: int) -> np.ndarray:
    """Return the same as :func:`above` by a loop from front to back, with a single horizon."""
    horizon = [NOWHERE] * columns
    seen = pixels[2] < 0
    for ring in range(count):
        for column, row, _ in zip(*(each[edges[2] == ring] for each in edges), strict=True):
            horizon[column] = min(horizon[column], row)
        for pixel in np.flatnonzero(pixels[2] == ring):
            seen[pixel] = pixels[1][pixel] <= horizon[pixels[0][pixel]]
    return seen


class Nearness:
    """The inverse distance along the line of sight of pixels of lines, which is linear on screen.

    It is followed along the longer side of each line.
    """

    def __init__(self, lines: Lines) -> None:
        dx, dy = lines.x1 - lines.x0, lines.y1 - lines.y0
        steep = np.abs(dy) > np.abs(dx)
        longer, begin = np.where(steep, dy, dx), np.where(steep, lines.y0, lines.x0)
        start, end = 1 / lines.depth0, 1 / lines.depth1
        slope = (end - start) / np.where(longer == 0, 1, longer)
        self.steep = steep
        self.start = (start - slope * begin).astype(np.float32)
        self.slope = slope.astype(np.float32)

    def __call__(self, owner: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the inverse distances of pixels (n,) at column x and row y of lines ``owner``."""
        return self.along(owner, np.where(self.steep.take(owner), y, x))

    def along(self, owner: np.ndarray, longer: np.ndarray) -> np.ndarray:
        """Return the same from the pixels' places along the longer sides of their lines."""
        found = self.slope.take(owner)
        found *= longer
        found += self.start.take(owner)
        # On the last pixel rounding may lead beyond the far end.
        return np.maximum(found, np.float32(1e-9), out=found)


def crossings(lines: Lines, levelled: Levelled, first: int, last: int) -> Iterator[Marks]:
    """Yield each level column that each line crosses: column, row there, and inverse distance.

    Only columns from ``first`` to ``last`` count. Which they are does not change the numbers: each
    line is followed from where it enters the whole picture.
    """
    ends = []
    for x, y, depth in ((lines.x0, lines.y0, lines.depth0), (lines.x1, lines.y1, lines.depth1)):
        column, row, level = levelled.pixels(x, y)
        ends.append((column, row, 1 / (depth if level is None else depth * level), level))
    (x0, y0, near0, level0), (x1, y1, near1, level1) = ends
    begin = np.ceil(np.maximum(np.minimum(x0, x1), levelled.first))
    end = np.floor(np.minimum(np.maximum(x0, x1), last))

    # A line within one column raises nothing that the other edges at its ends do not raise, too.
    crossing = (end >= np.maximum(begin, first)) & (x0 != x1)
    if level0 is not None and level1 is not None:
        crossing &= (level0 > LEAST) & (level1 > LEAST)
    kept = np.flatnonzero(crossing)
    x0, y0, near0, x1, y1, near1 = (each[kept] for each in (x0, y0, near0, x1, y1, near1))
    begin = begin[kept].astype(np.int64)
    skipped = np.maximum(first - begin, 0)
    count = end[kept].astype(np.int64) - begin - skipped + 1
    rise, approach = (y1 - y0) / (x1 - x0), (near1 - near0) / (x1 - x0)
    row, near = y0 + rise * (begin - x0), near0 + approach * (begin - x0)
    if not len(count):
        return

    # From the whole picture's first column on float32 is exact enough.
    along = [
        (a.astype(np.float32), b.astype(np.float32)) for a, b in ((rise, row), (approach, near))
    ]
    total = np.cumsum(count)
    behind = total - count - skipped
    ends_at = np.searchsorted(total, np.arange(CHUNK, total[-1], CHUNK)) + 1
    for one, other in pairwise(dict.fromkeys((0, *ends_at.tolist(), len(total)))):
        owner = np.repeat(np.arange(one, other), count[one:other])
        before = total[one] - count[one]
        step = np.arange(before, before + len(owner))
        step -= behind.take(owner)
        far = step.astype(np.float32)
        found = []
        for slope, start in along:
            value = slope.take(owner)
            value *= far
            value += start.take(owner)
            found.append(value)
        step += begin.take(owner)
        yield step, found[0], np.maximum(found[1], np.float32(1e-9), out=found[1])
