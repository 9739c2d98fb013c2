"""The tests of the exercise floating_horizon."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test

FRAMES = (0, 1)
EVENTS = [{"frame": 1, "key": "RIGHT"}]

WIDTH, HEIGHT, ROWS = 80, 60, 22  # the picture of start.py, and its terrain
NEAR, FAR = np.array((250, 230, 190)), np.array((40, 104, 169))
COLORS = np.array([NEAR + (FAR - NEAR) * row // (ROWS - 1) for row in range(ROWS)])
NOTHING = -1  # where no row is drawn
BELOW = -1000  # a height under all lines


def make_rows(number):
    """Return low and high of each row of a frame, each (ROWS, WIDTH), as start.py makes them."""
    x, moved = np.arange(WIDTH + 1), 6 * number
    lines = []
    for row in range(ROWS):
        ground = 2.0 * row + 6 - 22 * (row == 12) + 5 * np.sin(0.11 * (x + moved) + 0.45 * row)
        peak = 75 * np.exp(-(((x + moved - 22) / 5.5) ** 2) - (row - 5) ** 2 / 3)
        hill = 22 * np.exp(-(((x + moved - 58) / 9) ** 2) - (row - 9) ** 2 / 8)
        lines.append(np.round(ground + peak + hill).astype(int))
    line = np.array(lines)
    return np.minimum(line[:, :-1], line[:, 1:]), np.maximum(line[:, :-1], line[:, 1:])


ALL = {number: make_rows(number) for number in FRAMES}


def whole(low, high, horizon):
    """Return the heights, first and last, that are drawn of a line if nothing is hidden."""
    return low, high


def above(low, high, horizon):
    """Return the heights that are drawn of a line, first and last: those above the horizon."""
    return np.maximum(low, horizon + 1), high


def raised(low, high, horizon):
    """Return the horizon after a line."""
    return np.maximum(horizon, high)


def drawn(number, seen=above, after=raised, begin=BELOW, order=1):
    """Return which row each pixel shows, (HEIGHT, WIDTH), if lines are drawn and hide like this."""
    heights, shown = np.arange(HEIGHT)[:, None], np.full((HEIGHT, WIDTH), NOTHING)
    horizon = np.full(WIDTH, BELOW)
    if not isinstance(begin, int):
        horizon = begin(*ALL[number])
    elif begin != BELOW:
        horizon[:] = begin
    for row, (low, high) in list(enumerate(zip(*ALL[number], strict=True)))[::order]:
        first, last = seen(low, high, horizon)
        shown[(heights >= first) & (heights <= last)] = row
        horizon = after(low, high, horizon)
    return shown


def found(work, number):
    """Return which row each pixel of a frame shows, (HEIGHT, WIDTH), the lowest height first."""
    shown = work.frame(number).picture
    high, wide = shown.shape[0] // HEIGHT, shown.shape[1] // WIDTH
    blocks = shown[high // 2 :: high, wide // 2 :: wide][::-1].astype(int)
    apart = np.abs(blocks[:, :, None] - COLORS).sum(axis=-1)
    return np.where(apart.min(axis=-1) < 6, apart.argmin(axis=-1), NOTHING)


def told(work, mistakes):
    """Return the hint of the first mistake that makes the pictures of all frames, or None."""
    pictures = {number: found(work, number) for number in FRAMES}
    for mistake, text in mistakes:
        if all(np.array_equal(pictures[number], mistake(number)) for number in FRAMES):
            return hint(text)
    return None


def any_or_none(test):
    """Return what draws a line whole or not at all, by a test of its pixels above the horizon."""

    def seen(low, high, horizon):
        return low, np.where(test(high > horizon), high, low - 1)

    return seen


def to_first_hidden(low, high, horizon):
    hidden = np.logical_or.accumulate(high <= horizon)
    first, last = above(low, high, horizon)
    return first, np.where(hidden, first - 1, last)


def after_previous():
    """Return what raises the horizon by the row before, one row too late."""
    waiting = []

    def after(low, high, horizon):
        waiting.append(high)
        return np.maximum(horizon, waiting[-2]) if len(waiting) > 1 else horizon

    return after


def from_top(low, high, horizon):
    return low, np.minimum(high, horizon - 1)


def beside(step):
    def seen(low, high, horizon):
        at = np.clip(np.arange(WIDTH) + step, 0, WIDTH - 1)
        return above(low, high, horizon[at])

    return seen


OF_FRONT = (
    (
        lambda number: np.full((HEIGHT, WIDTH), NOTHING),
        _(
            "Nothing is drawn: the horizon is at every line's height, or higher, before the "
            "line is "
            "compared with it."
        ),
    ),
    (
        lambda number: drawn(number, order=-1),
        _(
            "The farthest row is drawn first, and hides the nearer ones: rows comes in the right "
            "order."
        ),
    ),
    (
        lambda number: drawn(number, begin=lambda low, high: high[0]),
        _(
            "The nearest row is missing, and hides others nevertheless: before it, the horizon "
            "must "
            "lie below all lines."
        ),
    ),
    (
        lambda number: drawn(number, lambda *of: (above(*of)[0], of[1] - 1)),
        _("The highest pixel of each line is missing in each column: high[x] belongs to the line."),
    ),
    (
        lambda number: drawn(number, lambda *of: (np.maximum(*above(*of)), of[1])),
        _(
            "Each line has only one pixel in each column, and gaps where it is steep: all heights "
            "from low[x] to high[x] belong to it."
        ),
    ),
    (
        lambda number: drawn(
            number, lambda low, high, horizon: (low, np.minimum(high, horizon)), begin=-1
        ),
        _(
            "Only the hidden pixels are drawn: the comparison with the horizon is the wrong way "
            "round."
        ),
    ),
)
HIDDEN = (
    (
        lambda number: drawn(number, whole),
        _(
            "Nothing is hidden: farther rows are drawn over nearer ones. Which height must be "
            "remembered for each column from row to row?"
        ),
    ),
    (
        lambda number: drawn(number, after=lambda low, high, horizon: high),
        _(
            "Each row is hidden only by the row before it: the horizon goes down again where a "
            "line "
            "is lower than it."
        ),
    ),
    (
        lambda number: drawn(number, after=lambda low, high, horizon: np.maximum(low, horizon)),
        _(
            "The horizon is raised only to the lowest pixel of each line: where the line is steep, "
            "farther rows are seen through it."
        ),
    ),
    (
        lambda number: drawn(number, any_or_none(np.asarray)),
        _(
            "Where a part of a line is seen in a column, all of it is drawn there, also its pixels "
            "below the horizon."
        ),
    ),
    (
        lambda number: drawn(number, lambda low, high, horizon: (np.maximum(low, horizon), high)),
        _("Where a farther row is just as high as the horizon, it is drawn over the nearer one."),
    ),
    (
        lambda number: drawn(
            number,
            after=lambda low, high, horizon: np.where(
                high < HEIGHT, np.maximum(horizon, high), horizon
            ),
        ),
        _(
            "Far rows show through the mountain whose summit is above the picture: a line hides "
            "others even where it is outside the picture."
        ),
    ),
    (
        lambda number: drawn(number, after=after_previous()),
        _(
            "Each row is hidden by all nearer ones but the one just before it: the horizon is "
            "raised "
            "one row too late."
        ),
    ),
    (
        lambda number: drawn(
            number, from_top, lambda low, high, horizon: np.minimum(horizon, low), begin=HEIGHT
        ),
        _(
            "You see the undersides of the hills: here a greater height is higher up, so the "
            "horizon must rise, not sink."
        ),
    ),
    *(
        (
            lambda number, step=step: drawn(number, beside(step)),
            _("A column is compared with the horizon of the column beside it."),
        )
        for step in (1, -1)
    ),
    (
        lambda number: drawn(number, any_or_none(np.any)),
        _(
            "A line is drawn as a whole as soon as one of its pixels is seen: each column has "
            "to be "
            "compared for itself."
        ),
    ),
)
MISSING = (
    (
        lambda number: drawn(
            number, after=lambda low, high, horizon: np.full(WIDTH, max(horizon.max(), high.max()))
        ),
        _(
            "There is one horizon for the whole picture, so that one summit hides all that is "
            "lower "
            "beside it. Each column needs its own."
        ),
    ),
    (
        lambda number: drawn(
            number, lambda low, high, horizon: (low, np.where(low > horizon, high, low - 1))
        ),
        _(
            "Where the horizon cuts a line within a column, the line's pixels above it are missing "
            "as well."
        ),
    ),
    (
        lambda number: drawn(
            number, after=lambda low, high, horizon: np.maximum(horizon, high + 1)
        ),
        _(
            "Directly above the horizon one pixel is always missing: is it raised by one too much, "
            "or does the comparison leave out one too many?"
        ),
    ),
    (
        lambda number: drawn(number, to_first_hidden),
        _(
            "Each line ends at its first hidden column, though it may be seen again farther to the "
            "right."
        ),
    ),
    (
        lambda number: drawn(number, any_or_none(np.all)),
        _(
            "Only lines that nothing hides are drawn: a line may be hidden in one column and seen "
            "in the next."
        ),
    ),
)


def place(mask):
    """Return the first column and height of a mask, as values of a hint."""
    x, height = np.argwhere(mask.T)[0]
    return {"x": int(x), "height": int(height), "count": int(mask.sum())}


@test(
    _("The nearest row is drawn whole"),
    _("Nothing is in front of it, so nothing hides it, in any frame."),
)
def front(work, solution):
    known = told(work, OF_FRONT)
    if known:
        return known
    for number in FRAMES:
        shown, right = found(work, number), drawn(number)
        lacking = (right == 0) & (shown == NOTHING)
        if not lacking.any():
            continue
        if number and np.array_equal(found(work, 0), drawn(0)):
            return hint(
                _(
                    "The first frame is right; in the next one the nearest row is hidden: the "
                    "horizon is still the one of the frame before."
                )
            )
        rows = np.flatnonzero((shown != NOTHING).any(axis=1))
        if len(rows) and rows[0] > 0 and lacking[: rows[0]].sum() == lacking.sum():
            return hint(
                _(
                    "Nothing is drawn below height {height}: how low must the horizon be "
                    "before the "
                    "first row?"
                ),
                height=int(rows[0]),
            )
        return hint(
            _(
                "In frame {frame} {count} pixels of the nearest row are missing, such as "
                "column {x}, "
                "height {height}."
            ),
            frame=number,
            **place(lacking),
        )

    return None


@test(
    _("Nothing below the horizon is drawn"),
    _("All that is not higher than a nearer row is behind it."),
    needs=front,
)
def hidden(work, solution):
    known = told(work, HIDDEN)
    if known:
        return known
    if told(work, MISSING):
        return None  # less is drawn, and what that would have hidden is seen
    for number in FRAMES:
        shown, right = found(work, number), drawn(number)
        wrong = (shown != NOTHING) & (shown != right) & ((right == NOTHING) | (shown > right))
        if wrong.any():
            at = place(wrong)
            row = int(shown[at["height"], at["x"]])
            return hint(
                _(
                    "In frame {frame} {count} pixels are drawn that nearer rows hide. The first is "
                    "at column {x}, height {height}, of row {row}."
                ),
                frame=number,
                row=row,
                **at,
            )

    return None


@test(
    _("Everything above the horizon is drawn"),
    _("A row may be seen in some columns and hidden in others, and also within a column."),
    needs=hidden,
)
def seen(work, solution):
    known = told(work, MISSING)
    if known:
        return known
    for number in FRAMES:
        shown, right = found(work, number), drawn(number)
        lacking = (right != NOTHING) & (shown != right)
        if lacking.any():
            at = place(lacking)
            return hint(
                _(
                    "In frame {frame} {count} pixels are missing that no nearer row hides. The "
                    "first "
                    "is at column {x}, height {height}, of row {row}."
                ),
                frame=number,
                row=int(right[at["height"], at["x"]]),
                **at,
            )

    return None


@test(
    _("The picture is right"),
    _("With the hills in two places."),
    needs=seen,
)
def picture(work, solution):
    return compare(work, solution)
