"""The tests of the exercise bezier_path."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.mistakes import balanced, close, known

FRAMES = (0, 1, 2)
EVENTS = [
    {"frame": frame, "key": key, "action": action}
    for frame, keys in {1: ("RIGHT",) * 4, 2: ("LEFT",) * 6 + ("DOWN",) * 3}.items()
    for key in keys
    for action in ("press", "release")
]
# Where keys have pulled the path long, its points lie pixels apart: one may take the nearest, or
# the first that is far enough.
ELSEWHERE = 0.004
MOVED = {0: (70, 250), 1: (150, 250), 2: (30, 190)}
COUNT, STEPS = 12, 400
NEAR = 1.5  # chosen: pixels by which a point may be elsewhere


def controls(number):
    """Return the control points of both curves in a frame, (7, 2)."""
    return np.array(
        ((20, 40), (30, 230), MOVED[number], (120, 150), (170, 50), (320, -20), (300, 215)), float
    )


def points(number, curve):
    """Return the points of the path in a frame, (2 * STEPS + 1, 2), if a curve is computed so."""
    t = np.arange(STEPS + 1)[:, None] / STEPS
    both = [curve(*places, 1 - t, t) for places in (controls(number)[:4], controls(number)[3:])]
    shape = np.zeros((STEPS + 1, 2))
    return np.concatenate([(both[0] + shape)[:-1], both[1] + shape])


def bernstein(a, b, c, d, s, t):
    return s**3 * a + 3 * s**2 * t * b + 3 * s * t**2 * c + t**3 * d


CURVES = (
    (
        lambda a, b, c, d, s, t: a,
        _("Each curve is a single point: bezier returns its first control point for each t."),
    ),
    (
        lambda a, b, c, d, s, t: s * a + t * d,
        _(
            "The path goes straight from the first control point of a curve to the last one: those "
            "in the middle have no effect."
        ),
    ),
    (
        lambda a, b, c, d, s, t: bernstein(a, b, c, d, t, s),
        _(
            "Each curve is flown backward, and so the path jumps between the two: for t = 0 the "
            "point should be a."
        ),
    ),
    (
        lambda a, b, c, d, s, t: s**3 * a + s**2 * t * b + s * t**2 * c + t**3 * d,
        _(
            "The path is drawn towards the lower left, to the origin: the four weights have to add "
            "up to 1 for each t. Two of them have a factor."
        ),
    ),
    (
        lambda a, b, c, d, s, t: s**3 * a + 3 * s * t * b + 3 * s * t * c + t**3 * d,
        _(
            "The path leads far away in the middle of each curve: the weights add up to more than "
            "1 there. In each of them the exponents of t and of 1 - t add up to 3."
        ),
    ),
    (
        lambda a, b, c, d, s, t: bernstein(a, c, b, d, s, t),
        _(
            "The two control points in the middle have changed places: the path should leave the "
            "first point towards the second."
        ),
    ),
    (
        lambda a, b, c, d, s, t: s**2 * a + 2 * s * t * b + t**2 * d,
        _("The third control point of each curve has no effect."),
    ),
    (
        lambda a, b, c, d, s, t: s**2 * a + 2 * s * t * c + t**2 * d,
        _("The second control point of each curve has no effect."),
    ),
    (
        lambda a, b, c, d, s, t: s**2 * a + 2 * s * t * b + t**2 * c,
        _(
            "Each curve ends at its third control point: the last division is missing, that "
            "between the two points of the second step."
        ),
    ),
    (
        lambda a, b, c, d, s, t: s * a + t * b,
        _(
            "Each curve is the line from its first control point to the second: this is only one "
            "of three lines that are divided."
        ),
    ),
    (
        lambda a, b, c, d, s, t: (
            (s**2 * a + 2 * s * t * b + t**2 * c + s**2 * b + 2 * s * t * c + t**2 * d) / 2
        ),
        _(
            "The curves do not begin at their first control points: in one of the three steps "
            "the lines are divided in the middle, and should be divided in the ratio t."
        ),
    ),
    (
        lambda a, b, c, d, s, t: s * (s * a + t * b) + t * (s * c + t * d),
        _(
            "The second step is missing: after the first one there are three points, and two lines "
            "between them."
        ),
    ),
)


def path(number):
    return points(number, bernstein)


def at(values, wanted):
    """Return the numbers of the first points whose value is as large as wanted."""
    return np.searchsorted(values, np.asarray(wanted) - 1e-6).clip(0, 2 * STEPS)


def along(number, step=lambda way: np.hypot(*way.T)):
    """Return how far each point is along the path, by the length of a step."""
    return np.concatenate([[0], np.cumsum(step(np.diff(path(number), axis=0)))])


def spread(number, step=lambda way: np.hypot(*way.T), parts=None):
    """Return the places of COUNT points, (COUNT, 2)."""
    values = along(number, step)
    parts = np.linspace(0, 1, COUNT) if parts is None else parts
    return path(number)[at(values, values[-1] * parts)]


def each_curve(number):
    values = along(number)
    half = values[STEPS]
    parts = [*np.linspace(0, half, COUNT // 2), *np.linspace(half, values[-1], COUNT // 2)]
    return path(number)[at(values, parts)]


def from_start(number):
    values = np.hypot(*(path(number) - path(number)[0]).T)
    return path(number)[at(values, np.linspace(0, values[-1], COUNT))]


PHOTOGRAPHS = (
    (
        lambda number: np.repeat(path(number)[:1], COUNT, axis=0),
        _("The plane stands at the beginning of the path."),
    ),
    (
        lambda number: path(number)[np.linspace(0, 2 * STEPS, COUNT).round().astype(int)],
        _(
            "The plane crawls where the control points are close, and rushes where they are far "
            "apart: these are equal steps of t, and not of the way."
        ),
    ),
    (
        lambda number: spread(number, parts=np.arange(COUNT) / COUNT),
        _(
            "The plane does not get to the end of the path: COUNT points have one interval less "
            "between them."
        ),
    ),
    (
        lambda number: spread(number, parts=np.arange(1, COUNT + 1) / COUNT),
        _(
            "The plane is not photographed at the beginning of the path: the first point is number "
            "0."
        ),
    ),
    (
        lambda number: spread(number, lambda way: np.abs(way[:, 0])),
        _("Where the path climbs, the plane is too fast: only the way to the right is measured."),
    ),
    (
        lambda number: spread(number, lambda way: np.abs(way[:, 1])),
        _("Where the path is level, the plane is too fast: only the way upwards is measured."),
    ),
    (
        lambda number: spread(number, lambda way: (way**2).sum(axis=1)),
        _(
            "The squares of the steps are added up: the length of a step is the root of the sum of "
            "two squares."
        ),
    ),
    (
        lambda number: spread(number, lambda way: np.abs(way).sum(axis=1)),
        _(
            "The plane is too slow where it flies obliquely: the ways in x and in y are added, as "
            "if it flew around two sides of a triangle."
        ),
    ),
    (
        from_start,
        _(
            "This measures the straight distance from the beginning of the path, not the "
            "distance along it."
        ),
    ),
    (
        each_curve,
        _("Both curves get the same number of photographs, though they are not equally long."),
    ),
)


def right(work, solution):
    return compare(work, solution) is None


def drawn(work, mode, number):
    """Return where the last draw of a kind has its vertices, (n, 2), in pixels of the map."""
    draws = [draw for draw in work.frame(number).draws if draw.mode == mode]
    if not draws:
        return np.zeros((0, 2))
    size = draws[-1].state["GL_VIEWPORT"][2:]
    return draws[-1].window / size * (320, 240)


@test(
    _("The path consists of two Bezier curves"),
    _("Each begins at its first control point, towards the second, and ends at its last one."),
)
def curve(work, solution):
    if right(work, solution):
        return None

    def found(number):
        return drawn(work, "GL_LINE_STRIP", number)

    made = [(lambda number, form=form: points(number, form)[::20], text) for form, text in CURVES]
    if told := known(made, found, FRAMES, close(NEAR)):
        return told
    for number in FRAMES:
        wanted = path(number)[::20]
        if found(number).shape != wanted.shape:
            return None
        wrong = np.abs(found(number) - wanted).max(axis=1) > NEAR
        if wrong.any():
            first = int(np.argmax(wrong))
            x, y = found(number)[first]
            return hint(
                _(
                    "In frame {frame} the path is at ({x:.0f}, {y:.0f}) for t = {t:.2f} of its "
                    "{which}, and should be at ({right_x:.0f}, {right_y:.0f})."
                ),
                frame=number,
                x=x,
                y=y,
                t=first * 20 % STEPS / STEPS,
                which=_("first curve") if first * 20 < STEPS else _("second curve"),
                right_x=wanted[first, 0],
                right_y=wanted[first, 1],
            )
    return None


@test(
    _("The plane flies at one speed"),
    _("The distance along the path is the same between any two photographs."),
    needs=curve,
)
def speed(work, solution):
    if right(work, solution):
        return None

    def found(number):
        return drawn(work, "GL_POINTS", number)

    if told := known(PHOTOGRAPHS, found, FRAMES, close(NEAR)):
        return told
    for number in FRAMES:
        places, wanted = found(number), spread(number)
        if places.shape != wanted.shape:
            return hint(
                _("There are {count} photographs, and {wanted} are wanted."),
                count=len(places),
                wanted=COUNT,
            )
        wrong = np.abs(places - wanted).max(axis=1) > 2 * NEAR
        if wrong.any():
            first = int(np.argmax(wrong))
            x, y = places[first]
            return hint(
                _(
                    "In frame {frame} photograph {number} is at ({x:.0f}, {y:.0f}), and should be "
                    "at ({right_x:.0f}, {right_y:.0f})."
                ),
                frame=number,
                number=first,
                x=x,
                y=y,
                right_x=wanted[first, 0],
                right_y=wanted[first, 1],
            )
    return None


@test(
    _("The picture is right"),
    _("Also after a control point has been moved."),
    needs=speed,
)
def picture(work, solution):
    return compare(work, solution)


stacks = balanced(needs=picture)
