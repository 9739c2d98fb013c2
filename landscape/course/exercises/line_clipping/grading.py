"""The tests of the exercise line_clipping."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.mistakes import colors, known

FRAMES = (0, 1, 2, 3)
EVENTS = [
    {"frame": frame, "key": key, "action": action}
    for frame, keys in {1: ("RIGHT",), 2: ("LEFT",) * 3, 3: ("RIGHT",) * 8}.items()
    for key in keys
    for action in ("press", "release")
]
TURNED = {0: 0, 1: 20, 2: -40, 3: 120}
WIDTH, HEIGHT = 80, 60  # the picture of start.py, and its lines
LEFT = 22
TOP = 16
RIGHT = 58
BOTTOM = 44
COLORS = ((242, 150, 60), (225, 170, 120), (200, 200, 200), (120, 170, 215), (50, 140, 230))
LINES = (
    ((-15, -6), (12, 8)),
    ((-30, 3), (-4, 10)),
    ((2, -10), (33, -4)),
    ((-32, -12), (31, 11)),
    ((-12, 26), (-9, -25)),
    ((0, 0), (0, 27)),
    ((-36, 0), (25, 0)),
    ((6, -24), (6, 24)),
    ((-36, 8), (-14, 26)),
    ((36, -4), (10, -26)),
    ((-38, -26), (-28, -14)),
    ((22, 24), (34, 20)),
    ((14, 10), (34, 24)),
    ((-25, -18), (-8, -2)),
    ((30, -14), (30, 12)),
    ((-14, 22), (10, 22)),
)
FEWEST = 6  # chosen: pixels that may differ, as quotients may be rounded in other ways
INF = 10000


def inside(x, y):
    return LEFT <= x <= RIGHT and TOP <= y <= BOTTOM


def clipped(
    line,
    borders=(LEFT, RIGHT, TOP, BOTTOM),
    first=0.0,
    last=1.0,
    cuts=(True, True),
    misses=False,
    swap=True,
    parallel=True,
):
    """Return the part of a line in the frame, (4,), or None; other values are mistakes."""
    x0, y0, x1, y1 = line
    for begin, way, low, high in ((x0, x1 - x0, *borders[:2]), (y0, y1 - y0, *borders[2:])):
        if way == 0:
            if parallel and not low <= begin <= high:
                return None
            continue
        enters, leaves = (low - begin) / way, (high - begin) / way
        if swap and way < 0:
            enters, leaves = leaves, enters
        if cuts[0]:
            first = max(first, enters)
        if cuts[1]:
            last = min(last, leaves)

    if first > last and not misses:
        return None
    ends = np.array(line).reshape(2, 2)
    return np.concatenate([ends[0] + part * (ends[1] - ends[0]) for part in (first, last)])


def only(test):
    """Return what clips the lines that pass a test of whether their ends are inside."""
    return lambda line: clipped(line) if test(inside(*line[:2]), inside(*line[2:])) else None


def whole(test):
    return lambda line: line if test(inside(*line[:2]), inside(*line[2:])) else None


def moved(line):
    """Return the line with its ends moved to the borders, each coordinate for itself."""
    if clipped(line) is None:
        return None
    return np.clip(line, (LEFT, TOP) * 2, (RIGHT, BOTTOM) * 2)


def turned_round(line):
    found = clipped(line)
    return None if found is None else np.roll(found, 2)


def from_other(line):
    """Return the line with the last part counted from the second end to the first."""
    found = clipped(line)
    if found is None:
        return None
    return np.concatenate([found[:2], np.add(line[:2], line[2:]) - found[2:]])


def drawn(number, change):
    """Return the number of the colour of each pixel of a frame, (HEIGHT, WIDTH), or -1."""
    found = np.full((HEIGHT, WIDTH), -1)
    cos, sin = np.cos(np.radians(TURNED[number])), np.sin(np.radians(TURNED[number]))
    for line in LINES:
        ends = [(40 + cos * x - sin * y, 30 + sin * x + cos * y) for x, y in line]
        part = change((*ends[0], *ends[1]))
        if part is None:
            continue
        x0, y0, x1, y1 = part
        count = int(max(abs(x1 - x0), abs(y1 - y0))) + 1
        steps = np.arange(count + 1)
        column = np.floor(x0 + (x1 - x0) * steps / count + 0.5).astype(int)
        row = np.floor(y0 + (y1 - y0) * steps / count + 0.5).astype(int)
        seen = (column >= 0) & (column < WIDTH) & (row >= 0) & (row < HEIGHT)
        found[row[seen], column[seen]] = (5 * steps // (count + 1))[seen]
    return found


def made(change):
    return lambda number: drawn(number, change)


def limited(**values):
    return made(lambda line: clipped(line, **values))


OUTSIDE = (
    (
        made(from_other),
        _(
            "The part that is left is counted from the second end of the line, and should be "
            "counted from the first: so lines end at the wrong place."
        ),
    ),
    (
        made(lambda line: line),
        _("All lines are still drawn as a whole, also what lies outside of the frame."),
    ),
    (
        limited(borders=(LEFT, RIGHT, -INF, INF)),
        _("The lines are cut at the left and at the right, and go on above and below the frame."),
    ),
    (
        limited(borders=(-INF, INF, TOP, BOTTOM)),
        _(
            "The lines are cut above and below, and go on to the left and to the right of the "
            "frame."
        ),
    ),
    (
        limited(borders=(LEFT, INF, TOP, BOTTOM)),
        _("Lines go on beyond the right border, and are cut at the three others."),
    ),
    (
        limited(borders=(LEFT, RIGHT, TOP, INF)),
        _(
            "Lines go on beyond the lower border: rows are counted downwards, so that BOTTOM is "
            "the largest row."
        ),
    ),
    (
        limited(borders=(-INF, RIGHT, TOP, BOTTOM)),
        _("Lines go on beyond the left border, and are cut at the three others."),
    ),
    (
        limited(borders=(LEFT, RIGHT, -INF, BOTTOM)),
        _("Lines go on beyond the upper border, and are cut at the three others."),
    ),
    (
        limited(cuts=(True, False)),
        _("Only the first end of each line is cut; the second one stays where it was."),
    ),
    (
        limited(cuts=(False, True)),
        _("Only the second end of each line is cut; the first one stays where it was."),
    ),
    (
        limited(misses=True),
        _(
            "Lines that pass the frame by leave a piece beside it: they leave it at one border "
            "before they enter it at another one, and then nothing is left."
        ),
    ),
    (
        limited(parallel=False),
        _(
            "Horizontal and vertical lines beside the frame are drawn: where a line does not move "
            "towards a border, it is on one side of it as a whole."
        ),
    ),
    (
        made(whole(lambda first, second: not (first and second))),
        _("The lines that lie in the frame are missing, and the others are drawn as a whole."),
    ),
    (
        made(whole(lambda first, second: first or second)),
        _(
            "A line with one end in the frame is drawn as a whole: the other end has to be moved "
            "to the border."
        ),
    ),
)
KEPT = (
    (
        made(only(lambda first, second: first and second)),
        _(
            "Only lines that lie in the frame as a whole are left. Of the others a part may be "
            "seen, too."
        ),
    ),
    (
        made(only(lambda first, second: first or second)),
        _(
            "Lines that cross the whole frame are missing: though both of their ends are outside, "
            "their middle is in it."
        ),
    ),
    (
        made(lambda line: None if 0 in (line[2] - line[0], line[3] - line[1]) else clipped(line)),
        _(
            "Horizontal and vertical lines are missing: that one may not divide by 0 does not mean "
            "that there is nothing to be seen."
        ),
    ),
    (
        limited(swap=False),
        _(
            "Lines that lead to the left or upwards are missing: such a line enters the frame at "
            "the border at which the others leave it."
        ),
    ),
    (
        limited(borders=(LEFT + 1, RIGHT - 1, TOP + 1, BOTTOM - 1)),
        _("The lines end one pixel before each border: the borders belong to the frame."),
    ),
    (
        made(only(lambda first, second: first)),
        _("Lines that begin outside of the frame are missing."),
    ),
    (
        made(only(lambda first, second: second)),
        _("Lines that end outside of the frame are missing."),
    ),
    (made(lambda line: None), _("No line is left.")),
)
STRAIGHT = (
    (
        made(moved),
        _(
            "The lines are bent towards the corners: an end is moved to the border in x and in y, "
            "each for itself. What y belongs to the x of the border?"
        ),
    ),
    (
        limited(first=-1000.0, last=1000.0),
        _(
            "All lines reach from border to border, also those that end within the frame: a line "
            "is longer than it was."
        ),
    ),
    (
        made(turned_round),
        _(
            "The lines have changed their direction: amber, which belongs to the first end, is at "
            "the second one."
        ),
    ),
)


def shown(work, number):
    return colors(work.frame(number), WIDTH, HEIGHT, COLORS)


def same(one, other):
    return (one != other).sum() <= FEWEST


def told(work, mistakes):
    return known(mistakes, lambda number: shown(work, number), FRAMES, same)


def right(work, solution):
    return compare(work, solution) is None


AREA = np.zeros((HEIGHT, WIDTH), bool)
AREA[TOP : BOTTOM + 1, LEFT : RIGHT + 1] = True


@test(
    _("Nothing is drawn outside of the frame"),
    _("Each line ends at the borders, and lines beside the frame are not drawn."),
)
def outside(work, solution):
    if right(work, solution):
        return None
    if found := told(work, OUTSIDE):
        return found
    if told(work, KEPT) or told(work, STRAIGHT):
        return None
    for number in FRAMES:
        wrong = (shown(work, number) >= 0) & ~AREA
        if wrong.sum() > FEWEST:
            row, column = np.argwhere(wrong)[0]
            return hint(
                _(
                    "In frame {frame} {count} pixels outside of the frame belong to lines, such as "
                    "the one in column {column} and row {row}."
                ),
                frame=number,
                count=int(wrong.sum()),
                column=int(column),
                row=int(row),
            )

    return None


@test(
    _("All that lies in the frame is drawn"),
    _("A line may cross the frame though both of its ends are outside."),
    needs=outside,
)
def kept(work, solution):
    if right(work, solution):
        return None
    if found := told(work, KEPT):
        return found
    if told(work, STRAIGHT):
        return None
    for number in FRAMES:
        lacking = (drawn(number, clipped) >= 0) & (shown(work, number) < 0)
        if lacking.sum() > FEWEST:
            row, column = np.argwhere(lacking)[0]
            return hint(
                _(
                    "In frame {frame} {count} pixels of lines are missing within the frame, such "
                    "as the one in column {column} and row {row}."
                ),
                frame=number,
                count=int(lacking.sum()),
                column=int(column),
                row=int(row),
            )

    return None


@test(
    _("The lines are as they were"),
    _("A cut changes neither the direction of a line nor which of its ends is the first."),
    needs=kept,
)
def straight(work, solution):
    return None if right(work, solution) else told(work, STRAIGHT)


@test(
    _("The picture is right"),
    _("With the lines in four directions."),
    needs=straight,
)
def picture(work, solution):
    return compare(work, solution)
