"""The tests of the exercise bresenham."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test

FRAMES = (0, 1)
EVENTS = [{"frame": 1, "key": "SPACE"}]

WIDTH, HEIGHT, CENTER = 64, 48, (32, 24)  # the picture of start.py
QUARTER = (
    ((7, 0), (30, 0)),
    ((7, 2), (30, 7)),
    ((7, 4), (30, 18)),
    ((6, 6), (23, 23)),
    ((4, 6), (15, 23)),
    ((2, 6), (6, 23)),
    ((0, 6), (0, 23)),
)
GREEN, ONE = 41, 87  # of the background, and what a pixel adds to it
RED_FIRST, RED_LAST = 223, 43  # of the first pixel of a line, and of the last
OFF = 0.1  # chosen: by which a shade may be wrong, the whole of a line being 1


def fan():
    """Return the lines, each as x0, y0, x1, y1, as Space has not been pressed."""
    x, y = CENTER
    lines = {
        (x + right * x0, y + down * y0, x + right * x1, y + down * y1): None
        for right, down in ((1, 1), (1, -1), (-1, 1), (-1, -1))
        for (x0, y0), (x1, y1) in QUARTER
    }
    return [(x, y, x, y), *lines]


def given(number):
    """Return the lines of a frame."""
    return [line[2:] + line[:2] if number else line for line in fan()]


def sides(line):
    """Return how wide and how high a line is."""
    x0, y0, x1, y1 = line
    return abs(x1 - x0), abs(y1 - y0)


def walked(line, aside):
    """Return the pixels of a line that has gone aside(k, longer, shorter) pixels after k steps."""
    x0, y0, x1, y1 = line
    right, down = (1 if x1 > x0 else -1), (1 if y1 > y0 else -1)
    shorter, longer = sorted(sides(line))
    steep = longer == sides(line)[1] and longer != shorter
    made = [(k, aside(k, longer, shorter)) for k in range(longer + 1)]
    return [(x0 + right * (s if steep else k), y0 + down * (k if steep else s)) for k, s in made]


def nearest(k, longer, shorter):
    return (2 * k * shorter + longer) // (2 * longer) if longer else 0


def cut(k, longer, shorter):
    return k * shorter // longer if longer else 0


def up(k, longer, shorter):
    return -(-k * shorter // longer) if longer else 0


def late(k, longer, shorter):
    return up(k - 1, longer, shorter) if k else 0


def floored(line):
    """Return the pixels of a line whose quotients are rounded down, whatever their sign."""
    x0, y0, x1, y1 = line
    longer = max(*sides(line), 1)
    steps = range(max(sides(line)) + 1)
    return [(x0 + k * (x1 - x0) // longer, y0 + k * (y1 - y0) // longer) for k in steps]


def pixels(line):
    """Return the pixels that a line should have, in order."""
    return walked(line, nearest)


def inside(found):
    """Return those of the pixels that are in the picture, as a set."""
    return {(x, y) for x, y in found if 0 <= x < WIDTH and 0 <= y < HEIGHT}


def made_by(number, each):
    """Return the pixels of a frame if each(line) returned those of a line."""
    return {pixel for line in given(number) for pixel in inside(each(line))}


def blocks(work, number):
    """Return the picture that is shown, (HEIGHT, WIDTH, 3): the middle of each pixel's block."""
    shown = work.frame(number).picture
    high, wide = shown.shape[0] // HEIGHT, shown.shape[1] // WIDTH
    return shown[high // 2 :: high, wide // 2 :: wide].astype(int)


def times(work, number):
    """Return how many times each pixel is returned, (HEIGHT, WIDTH); at most 2 can be told."""
    return np.round((blocks(work, number)[..., 1] - GREEN) / ONE).astype(int)


def drawn(work, number):
    """Return the pixels of a frame that are returned at least once, as a set of (x, y)."""
    return {(int(x), int(y)) for y, x in np.argwhere(times(work, number) > 0)}


def parts(work, number):
    """Return for each pixel how much of its line comes before it, from 0 to 1; by its shade."""
    return (RED_FIRST - blocks(work, number)[..., 0]) / (RED_FIRST - RED_LAST)


def named(line):
    """Return a line as a value of a hint."""
    x0, y0, x1, y1 = line
    return hint(_("from ({x0}, {y0}) to ({x1}, {y1})"), x0=x0, y0=y0, x1=x1, y1=y1)


def point(line):
    return line[:2] == line[2:]


def steep(line):
    return sides(line)[1] > sides(line)[0]


def oblique(line):
    """Return whether a line goes neither along an axis nor over the diagonals of pixels."""
    return 0 < min(sides(line)) < max(sides(line))


# What is drawn by each, and what is said of it.
LACKING_ENDS = (
    (
        lambda line: [line[:2], line[2:]],
        _(
            "Only the two ends of each line are there. The pixels between them are missing: one "
            "for each step along the longer side."
        ),
    ),
    (
        lambda line: [(y, x) for x, y in pixels(line)],
        _(
            "Rows and columns have changed places in all lines: a pixel is returned as (x, y), the "
            "column first."
        ),
    ),
    (
        lambda line: [(y, x) for x, y in pixels(line)] if steep(line) else pixels(line),
        _(
            "Lines that are taller than wide are in the wrong place: their rows and columns were "
            "swapped, and not swapped back."
        ),
    ),
    (
        lambda line: pixels(line)[:-1],
        _(
            "The last pixel of each line is missing: how many pixels has a line from column 3 "
            "to column 5?"
        ),
    ),
    (
        lambda line: [] if point(line) else pixels(line),
        _(
            "The line in the middle, which begins and ends in the same pixel, is missing: it has "
            "one pixel."
        ),
    ),
    (
        lambda line: walked(line, late),
        _(
            "Each line makes its first step aside right after the first one ahead: the error must "
            "not begin with 0. How far has the line gone aside after one step?"
        ),
    ),
)


def lacking(work, number):
    """Return the lines of a frame that have not both their ends."""
    found = drawn(work, number)
    return [line for line in given(number) if not {line[:2], line[2:]} <= found]


def ending(work, number, aside):
    """Return whether the oblique lines end where they have gone aside(longer, shorter) pixels."""
    found = drawn(work, number)
    ends = [
        walked(line, lambda k, *both: aside(*both))[-1] for line in given(number) if oblique(line)
    ]
    near = [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    seen = [any((x + i, y + j) in found for i, j in near) for x, y in inside(ends)]
    return bool(seen) and all(seen)


WAYS = (
    (
        steep,
        _(
            "Lines that are taller than wide never reach their end: they need one step for each "
            "row, not for each column."
        ),
    ),
    (
        lambda line: line[2] < line[0],
        _(
            "None of the lines that lead to the left gets to its end: "
            "in which direction do x's steps go?"
        ),
    ),
    (
        lambda line: line[3] < line[1],
        _(
            "None of the lines that lead upward gets to its end: in "
            "which direction do y's steps go?"
        ),
    ),
)
SLOPES = (
    (
        lambda longer, shorter: 0,
        _(
            "The sloping lines come out almost flat: after a step aside, or before the first, "
            "what makes the error grow to the next one?"
        ),
    ),
    (
        lambda longer, shorter: min(2 * shorter, longer),
        _(
            "The oblique lines get twice as far aside as they should: by how much does a step "
            "aside "
            "make the error smaller?"
        ),
    ),
    (
        lambda longer, shorter: longer,
        _(
            "The oblique lines go over the diagonal: after a step aside the error must become "
            "smaller, "
            "or the next step goes aside as well."
        ),
    ),
    (
        lambda longer, shorter: shorter // 2,
        _(
            "The oblique lines get only half as far aside as they should: all that the error "
            "is made "
            "of must be doubled, or nothing of it."
        ),
    ),
)


@test(
    _("Each line has both its ends"),
    _("In all directions, (x0, y0) is its first pixel and (x1, y1) its last."),
    demanded=True,
)
def ends(work, solution):
    for number in FRAMES:
        wrong = lacking(work, number)
        if not wrong and drawn(work, number) != made_by(number, LACKING_ENDS[0][0]):
            continue
        found = drawn(work, number)
        if not found:
            return hint(_("No pixel is returned for any of the lines."))
        for mistake, text in LACKING_ENDS:
            if found == made_by(number, mistake):
                return hint(text)
        if wrong == given(number) and not found & {line[:2] for line in wrong}:
            return hint(
                _(
                    "The first pixel of each line is missing: is a step made before the first "
                    "pixel "
                    "is noted?"
                )
            )
        for way, text in WAYS:
            if set(wrong) == {line for line in given(number) if way(line)}:
                return hint(text)
        if {line for line in given(number) if oblique(line)} <= set(wrong):
            for aside, text in SLOPES:
                if ending(work, number, aside):
                    return hint(text)
        line = wrong[0]
        x, y = next(end for end in (line[:2], line[2:]) if end not in found)
        return hint(
            _(
                "{count} of the {all} lines lack an end. The first is the line {line}: "
                "({x}, {y}) is not drawn."
            ),
            count=len(wrong),
            all=len(given(number)),
            line=named(line),
            x=x,
            y=y,
        )

    return None


def gaps(work, number):
    """Return the lines of a frame that have a gap, each with its first step that has no pixel."""
    found, holes = drawn(work, number), []
    for line in given(number):
        for x, y in pixels(line):
            beside = [(x + i * steep(line), y + i * (not steep(line))) for i in (-1, 0, 1)]
            if not found.intersection(beside):
                holes.append((line, (x, y)))
                break
    return holes


@test(
    _("No line has a gap"),
    _(
        "One pixel for each column of a line that is wider than tall, and otherwise one "
        "for each row."
    ),
    needs=ends,
    demanded=True,
)
def whole(work, solution):
    for number in FRAMES:
        holes = gaps(work, number)
        if not holes:
            continue
        line, (x, y) = holes[0]
        values = {"line": named(line), "x": x, "y": y}
        if all(steep(line) for line, _place in holes):
            return hint(
                _(
                    "Lines that are taller than wide have gaps: in the line {line}, row {y} is "
                    "empty. They need one pixel in each row, not in each column."
                ),
                **values,
            )
        return hint(
            _(
                "{count} lines have gaps; in the one {line}, nothing is drawn at ({x}, {y}) nor "
                "beside it."
            ),
            count=len(holes),
            **values,
        )

    return None


ROUNDED = (
    (
        lambda line: walked(line, cut),
        _(
            "Each line goes aside too late: the pixel is the nearest one if the step is made half "
            "way to the next row or column, and not when the line has got there."
        ),
    ),
    (
        lambda line: walked(line, up),
        _(
            "Each line goes aside too early: the pixel is the nearest one only if the step is made "
            "half way to the next row or column, and not at once."
        ),
    ),
    (
        floored,
        _(
            "Pixels are off by one to the left or upward, and so lines that lead to the right and "
            "to the left are not mirror images of each other: // rounds down, also below 0."
        ),
    ),
)


@test(
    _("Every pixel is the nearest to its line"),
    _(
        "Then a line is nowhere more than half a pixel away from its pixels, and nowhere thicker "
        "than one."
    ),
    needs=whole,
    demanded=True,
)
def close(work, solution):
    for number in FRAMES:
        found, wanted = drawn(work, number), made_by(number, pixels)
        if found == wanted:
            continue
        for mistake, text in ROUNDED:
            if found == made_by(number, mistake):
                return hint(text)
        more = sorted(found - wanted)
        if wanted < found:
            x, y = more[0]
            return hint(
                _(
                    "The lines have all their pixels, and {count} more, such as ({x}, {y}): a step "
                    "aside and the step ahead together lead to one new pixel, not to two."
                ),
                count=len(more),
                x=x,
                y=y,
            )
        line, (x, y) = next(
            (line, pixel) for line in given(number) for pixel in pixels(line) if pixel not in found
        )
        return hint(
            _(
                "{count} pixels are not those nearest to their lines. In the line {line}, the "
                "first "
                "of them should be ({x}, {y})."
            ),
            count=len(wanted - found),
            line=named(line),
            x=x,
            y=y,
        )

    return None


@test(
    _("No pixel is returned twice"),
    _("A line that is blended with its background would have spots there."),
    needs=close,
    demanded=True,
)
def once(work, solution):
    for number in FRAMES:
        count = times(work, number)
        twice = [(x, y) for line in given(number) for x, y in pixels(line) if count[y, x] > 1]
        if not twice:
            continue
        if twice == [line[2:] for line in given(number)]:
            return hint(_("The last pixel of each line is returned twice."))
        if twice == [line[:2] for line in given(number)]:
            return hint(_("The first pixel of each line is returned twice."))
        return hint(
            _("{count} pixels are returned twice, such as ({x}, {y})."),
            count=len(twice),
            x=twice[0][0],
            y=twice[0][1],
        )
    return None


@test(
    _("The pixels come in order"),
    _("From (x0, y0) to (x1, y1): dashes, or colors along a line, need it."),
    needs=once,
    demanded=True,
)
def order(work, solution):
    for number in FRAMES:
        found = parts(work, number)
        turned = []
        wrong = []
        lines = [line for line in given(number) if not point(line)]
        for line in lines:
            seen = np.array([found[y, x] for x, y in pixels(line)])
            wanted = np.linspace(0, 1, len(seen))
            if np.abs(seen - wanted).max() > OFF:
                wrong.append(line)
                if np.abs(seen[::-1] - wanted).max() < OFF:
                    turned.append(line)
        if not wrong:
            continue
        if turned == lines:
            return hint(_("All lines come from their ends to their beginnings."))
        if turned == wrong and all(line[2] < line[0] for line in wrong):
            return hint(
                _(
                    "The lines that lead to the left come from their ends to their beginnings: if "
                    "the ends change places, the pixels must be turned round in the end."
                )
            )
        if turned == wrong and all(line[3] < line[1] for line in wrong):
            return hint(
                _(
                    "The lines that lead upward come from their ends to their beginnings: if the "
                    "ends change places, the pixels must be turned round in the end."
                )
            )
        return hint(
            _(
                "The pixels of {count} lines are not in order, for example those of the "
                "line {line}."
            ),
            count=len(wrong),
            line=named(wrong[0]),
        )

    return None


@test(
    _("The picture is right"),
    _("The fan is drawn from its middle, and after Space from outside."),
    needs=order,
)
def picture(work, solution):
    wide, high = 1 / WIDTH, 1 / HEIGHT
    x, y = CENTER
    around = ((x - 7) * wide, (y - 6) * high, (x + 8) * wide, (y + 7) * high)
    return compare(work, solution, regions={_("the middle of the fan"): around})
