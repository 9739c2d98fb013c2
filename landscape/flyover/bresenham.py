"""Bresenham's lines (section 2.1), all of a frame at once, and clipped to the screen.

Bresenham's algorithm of 1965 goes along a line's longer side pixel by pixel; an error term says
when to go one pixel along the shorter side as well. It is a loop, and each step needs the one
before it. But what the error term counts has a closed form: k steps along a longer side of ``du``
pixels, of a line that is ``dv`` pixels high, the shorter side has made

    floor((2 k dv + du) / (2 du))

steps. So any pixel of any line can be computed alone, and all of them in a few array operations.
The part of a line that lies on the screen is a range of k, which is found by solving the same
formula for k: a clipped line has exactly those pixels of the whole line that are on the screen.

:func:`line` is the loop; tests compare the two.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

FURTHEST = 1 << 30  # the products of two coordinates must fit into 64 bits
# Up to such coordinates float64 is exact enough: 1 / (4 * 2^20) is far above its rounding errors.
NEARBY = 1 << 20
# Pixels computed at once, chosen: arrays of 128 kB stay in the processor's cache, and the system
# need not find new memory for them, which takes longer than the arithmetic.
CHUNK = 1 << 14


def line(x0: int, y0: int, x1: int, y1: int) -> list[tuple[int, int]]:
    """Return the pixels from (x0, y0) to (x1, y1), both included, as Bresenham published it."""
    dx, dy = abs(x1 - x0), abs(y1 - y0)
    step_x, step_y = (1 if x1 > x0 else -1), (1 if y1 > y0 else -1)
    steep = dy > dx
    longer, shorter = (dy, dx) if steep else (dx, dy)
    error = 2 * shorter - longer
    pixels = []
    for _ in range(longer + 1):
        pixels.append((x0, y0))
        if error >= 0 and longer:
            x0, y0 = (x0 + step_x, y0) if steep else (x0, y0 + step_y)
            error -= 2 * longer
        error += 2 * shorter
        x0, y0 = (x0, y0 + step_y) if steep else (x0 + step_x, y0)
    return pixels


@dataclass(frozen=True)
class Runs:
    """The parts of lines that are on the screen, all longer along the same side of the picture.

    For line ``index`` of those that were given, k goes from ``first`` over ``count`` steps along
    the longer side, from ``u`` up. ``v``, ``du`` and ``dv`` are the shorter side's start and the
    lengths of both. ``down`` is 1 where a pixel halfway between two goes to the lower v. All (n,)
    int64. ``slope`` and ``start`` are float64: the shorter side at k is ``start + slope * k``,
    rounded down.
    """

    index: np.ndarray
    u: np.ndarray
    v: np.ndarray
    du: np.ndarray
    dv: np.ndarray
    down: np.ndarray
    first: np.ndarray
    count: np.ndarray
    slope: np.ndarray
    start: np.ndarray

    def __getitem__(self, which: slice | np.ndarray) -> "Runs":
        """Return some of the runs."""
        return Runs(*(each[which] for each in vars(self).values()))


def pixels(
    x0: np.ndarray, y0: np.ndarray, x1: np.ndarray, y1: np.ndarray, size: tuple[int, int]
) -> tuple[np.ndarray, np.ndarray]:
    """Return the pixels of lines on a screen of ``size`` (width, height), all int64.

    Coordinates (n,) are whole numbers of at most FURTHEST, positive or negative. The result is each
    pixel's place in the picture, ``row * width + column``, and the line that it belongs to. The
    pixels of one line are together and in order, but not always from its start.
    """
    place, owner = [np.zeros(0, np.int64)], [np.zeros(0, np.int64)]
    for x, y, index, _ in chunks(x0, y0, x1, y1, size):
        place.append(y.astype(np.int64) * size[0] + x)
        owner.append(index)
    return np.concatenate(place), np.concatenate(owner)


def chunks(
    x0: np.ndarray,
    y0: np.ndarray,
    x1: np.ndarray,
    y1: np.ndarray,
    size: tuple[int, int],
    columns: range | None = None,
) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray, bool]]:
    """Yield the pixels of lines, see :func:`pixels`, some CHUNK at a time, of whole lines.

    They are columns, rows, the lines they belong to, and whether these lines are longer along the
    rows of the picture than along its columns. With ``columns``, only these columns have pixels.
    """
    wide, high = columns or range(size[0]), range(size[1])
    steep = np.abs(y1 - y0) > np.abs(x1 - x0)
    for along_x in (True, False):
        at = np.flatnonzero(~steep if along_x else steep)
        ends = x0[at], y0[at], x1[at], y1[at]
        if along_x:
            runs = clipped(at, *ends, wide, high)
        else:
            runs = clipped(at, ends[1], ends[0], ends[3], ends[2], high, wide)
        for part in divided(runs):
            near = (np.maximum(np.abs(part.u), np.abs(part.v)) + part.du).max() < NEARBY
            major, minor = fast_steps(part) if near else steps(part)
            x, y = (major, minor) if along_x else (minor, major)
            yield x, y, np.repeat(part.index, part.count), along_x


def divided(runs: Runs) -> Iterator[Runs]:
    """Yield the runs in groups of about CHUNK pixels."""
    total = np.cumsum(runs.count)
    ends = np.searchsorted(total, np.arange(CHUNK, total[-1] if len(total) else 0, CHUNK)) + 1
    for first, last in zip((0, *ends), (*ends, len(total)), strict=True):
        if last > first:
            yield runs[first:last]


def clipped(
    index: np.ndarray,
    u0: np.ndarray,
    v0: np.ndarray,
    u1: np.ndarray,
    v1: np.ndarray,
    along: range,
    across: range,
) -> Runs:
    """Return what is on the screen of lines that are longer along u than along v.

    On the screen u is in ``along`` and v in ``across``. Lines (n,) that are off it are left out.
    """
    back = u1 < u0
    u, v = np.minimum(u0, u1), np.where(back, v1, v0)
    du, dv = np.abs(u1 - u0), np.where(back, v0 - v1, v1 - v0)

    # Halfway between two pixels, the line goes on in the direction in which it was given.
    down = (v1 < v0).astype(np.int64)
    first, last = np.zeros_like(du), du.copy()
    beyond = (u < along.start) | (u + du >= along.stop)
    beyond |= (np.minimum(v, v + dv) < across.start) | (np.maximum(v, v + dv) >= across.stop)
    at = np.flatnonzero(beyond)
    first[at], last[at] = on_screen(
        u[at] - along.start, v[at] - across.start, du[at], dv[at], down[at], len(along), len(across)
    )
    seen = np.flatnonzero(last >= first)
    u, v, du, dv, down, first = (each[seen] for each in (u, v, du, dv, down, first))
    longer = np.maximum(du, 1)  # it is 0 for a line of one pixel

    # Halfway between two pixels, half of the least difference that there can be, 1 / 2 du, decides.
    start = v + 0.5 + (0.25 - 0.5 * down) / longer
    count = last[seen] - first + 1
    return Runs(index[seen], u, v, du, dv, down, first, count, dv / longer, start)


def on_screen(
    u: np.ndarray,
    v: np.ndarray,
    du: np.ndarray,
    dv: np.ndarray,
    down: np.ndarray,
    longest: int,
    highest: int,
) -> tuple[np.ndarray, np.ndarray]:
    """Return the first and the last k at which lines (n,) are on the screen, see :class:`Runs`.

    The screen reaches over 0 <= u < ``longest`` and 0 <= v < ``highest``. The last is less than the
    first for a line that is not on it.
    """
    first, last = np.maximum(-u, 0), np.minimum(longest - 1 - u, du)

    # The shorter side has made s(k) = floor((2 k dv + du - down) / 2 du) steps. It is below the
    # lower edge while s(k) < -v, and above the upper edge where s(k) >= highest - v.
    enter, leave = (2 * du * steps - du + down for steps in (-v, highest - v))
    twice = 2 * np.where(dv == 0, 1, dv)
    rising = np.maximum(first, -(-enter // twice)), np.minimum(last, -(-leave // twice) - 1)
    falling = np.maximum(first, -leave // -twice + 1), np.minimum(last, -enter // -twice)
    level = first, np.where((v < 0) | (v >= highest), first - 1, last)
    cases = [dv > 0, dv < 0]
    begin, end = (
        np.select(cases, list(each[:2]), each[2])
        for each in zip(rising, falling, level, strict=True)
    )
    return begin, end


def steps(runs: Runs) -> tuple[np.ndarray, np.ndarray]:
    """Return u and v of each pixel of all runs, by the closed form."""
    owner = np.repeat(np.arange(len(runs.count)), runs.count)
    k = np.arange(len(owner)) + (runs.first - np.cumsum(runs.count) + runs.count)[owner]
    du = runs.du[owner]
    dv = runs.dv[owner]
    down = runs.down[owner]
    made = (2 * k * dv + du - down) // np.maximum(2 * du, 1)
    return runs.u[owner] + k, runs.v[owner] + made


def fast_steps(runs: Runs) -> tuple[np.ndarray, np.ndarray]:
    """Return the same as :func:`steps`, for lines of coordinates below NEARBY.

    There, division takes longest. Here, each line has its slope, and one number counts on through
    all pixels; k is what it exceeds the number ``before`` the line by.
    """
    before = np.cumsum(runs.count) - runs.count - runs.first
    counted = np.arange(int(runs.count.sum()))
    major = np.repeat(runs.u - before, runs.count)
    major += counted
    minor = np.repeat(runs.slope, runs.count)
    minor *= counted
    minor += np.repeat(runs.start - runs.slope * before, runs.count)
    # On the screen v is not negative, so that rounding towards 0 is rounding down.
    return major, minor.astype(np.int64)
