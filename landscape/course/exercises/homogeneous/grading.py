"""The tests of the exercise homogeneous."""

from functools import lru_cache

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.mistakes import balanced, close, explained

FRAMES = (0, 1, 2, 3)
PRESSED = {1: ("RIGHT",) * 2, 2: ("UP", "LEFT"), 3: ("DOWN",) * 3}
EVENTS = [
    {"frame": frame, "key": key, "action": action}
    for frame, keys in PRESSED.items()
    for key in keys
    for action in ("press", "release")
]
TURNED = {0: 0, 1: 30, 2: 15, 3: 15}
WALKED = {0: 0, 1: 0, 2: 0.5, 3: -1}

PROJECTION = np.array(((1.6, 0, 0, 0), (0, 2, 0, 0), (0, 0, 1, 0), (0, 0, -1, 1)))
FAR = np.array((0, 0, -1, 0))
HOUSES = (((-2.2, -1, -6), 20), ((2.3, -1, -5), -30), ((-1.9, -1, -3.5), 70))
OUTLINE = ((-0.7, 0), (0.7, 0), (0.7, 1), (0, 1.6), (-0.7, 1))


def lines():
    """Return the points of a house, (n, 3), two for each line."""
    found = []
    for number, (x, y) in enumerate(OUTLINE):
        next_x, next_y = OUTLINE[(number + 1) % 5]
        for z in (-0.6, 0.6):
            found += [(x, y, z), (next_x, next_y, z)]
        found += [(x, y, -0.6), (x, y, 0.6)]
    return np.array(found)


HOUSE = lines()


def columns(numbers):
    """Return what gives the homogeneous coordinates of points, from x, y, z and a row of ones."""
    return lambda points: np.stack(numbers(*np.asarray(points, float).T), axis=-1)


POINTS = (
    (columns(lambda x, y, z: (x, y, z, x * 0 + 1)), None),
    (
        columns(lambda x, y, z: (x, y, z, x * 0)),
        _(
            "The houses stand in the same place: with a fourth number of 0, a point is a "
            "direction, and no translation moves it. See what point returns."
        ),
    ),
    (
        columns(lambda x, y, z: (x * 0 + 1, x, y, z)),
        _(
            "The houses are torn to pieces: the 1 stands in front of x, y and z, and all numbers "
            "are taken for the next ones."
        ),
    ),
    (
        columns(lambda x, y, z: (x, y, z, z)),
        _(
            "Each point is moved by z times the translation: the fourth number of a point is 1, "
            "and not its depth."
        ),
    ),
    (
        columns(lambda x, y, z: (x, y, z, x * 0 - 1)),
        _(
            "The fourth number is -1: all translations go the other way, and everything that "
            "should be in front of the camera is behind it."
        ),
    ),
)


def shift(place, at=((0, 3), (1, 3), (2, 3)), begin=np.identity):
    matrix = begin(4)
    for number, where in zip(place, at):
        matrix[where] = number
    return matrix


MOVES = (
    (shift, None),
    (
        lambda place: np.identity(4),
        _(
            "translation moves nothing: the houses stand in one place, and walking does not "
            "change the picture. In which column of the matrix does the 1 of a point multiply?"
        ),
    ),
    (
        lambda place: shift(place).T,
        _(
            "x, y and z stand in the last row of the translation: there they change w, and not the "
            "place. For columns they belong into the last column."
        ),
    ),
    (
        lambda place: np.identity(4) + np.diag((*place, 0)),
        _("x, y and z are added on the diagonal, where they stretch what they should move."),
    ),
    (
        lambda place: shift(np.negative(place)),
        _(
            "translation moves everything the opposite way: the houses are behind the camera, "
            "and Up walks backward."
        ),
    ),
    (
        lambda place: shift((*place[:2], 0)),
        _(
            "translation moves nothing along z: the houses stand beside the camera, out of the "
            "picture."
        ),
    ),
    (
        lambda place: shift(place[::-1]),
        _("translation moves along x by z, and along z by x: the rows have changed places."),
    ),
)


def turn(rows):
    """Return what gives the matrix of a rotation from rows, of the cosine and the sine."""

    def matrix(angle):
        cos, sin = np.cos(np.radians(angle)), np.sin(np.radians(angle))
        found = np.identity(4)
        found[:3, :3] = rows(cos, sin)
        return found

    return matrix


TURNS = (
    (turn(lambda c, s: ((c, 0, s), (0, 1, 0), (-s, 0, c))), None),
    (
        lambda angle: np.identity(4),
        _("rotation turns nothing: the houses stand in a row, and Left and Right have no effect."),
    ),
    (
        lambda angle: turn(lambda c, s: ((c, 0, s), (0, 1, 0), (-s, 0, c)))(np.degrees(angle)),
        _(
            "The houses are turned by far too much: cosine and sine want radians, and angle is in "
            "degrees."
        ),
    ),
    (
        turn(lambda c, s: ((c, 0, -s), (0, 1, 0), (s, 0, c))),
        _("The houses are turned clockwise as seen from above: where is the minus of the sine?"),
    ),
    (
        turn(lambda c, s: ((c, -s, 0), (s, c, 0), (0, 0, 1))),
        _(
            "The houses lean over to the side: they are turned around z. Around y, it is x and z "
            "that change, and y that stays."
        ),
    ),
    (
        turn(lambda c, s: ((1, 0, 0), (0, c, -s), (0, s, c))),
        _(
            "The houses tip over to the front: they are turned around x. Around y, it is x and z "
            "that change."
        ),
    ),
    (
        turn(lambda c, s: ((c, 0, s), (0, 1, 0), (s, 0, c))),
        _(
            "The houses are crushed as they turn: one of the two sines has the opposite sign, or "
            "the columns of the matrix are not perpendicular."
        ),
    ),
)


def over(divide):
    return lambda places: np.stack(divide(*places.T)[:2], axis=-1)


DIVIDES = (
    (over(lambda x, y, z, w: (x / w, y / w)), None),
    (
        over(lambda x, y, z, w: (x, y)),
        _(
            "Nothing becomes smaller with the distance, and so the houses lie beside the picture: "
            "x, y, z and w stand for the point that one gets if one divides by w."
        ),
    ),
    (
        over(lambda x, y, z, w: (x / z, y / z)),
        _(
            "The picture is upside down: it is divided by z, and in front of the camera z is "
            "negative. Divide by the fourth number: PROJECTION makes it for that."
        ),
    ),
    (
        over(lambda x, y, z, w: (x * w, y * w)),
        _(
            "Everything grows with the distance, and so the houses lie far beside the picture: w "
            "multiplies here, and should divide."
        ),
    ),
    (
        over(lambda x, y, z, w: (x / w, y)),
        _("x is divided by w, but y is not: far things are narrow, yet as tall as near ones."),
    ),
    (
        over(lambda x, y, z, w: (x // w, y // w)),
        _("All points lie on a few places: // cuts the fraction off."),
    ),
)


def street(number, points, moved, turned, divided):
    """Return the places of all vertices of a frame, (n, 2), if they are computed like this."""
    camera = PROJECTION @ moved((0, 0, WALKED[number]))
    ends = points([(x, -1, -1.5) for x in (-1, 1)])
    places = [camera @ each for end in ends for each in (end, FAR)]
    for place, angle in HOUSES:
        matrix = camera @ moved(place) @ turned(angle + TURNED[number])
        places += list(points(HOUSE) @ matrix.T)
    with np.errstate(all="ignore"):
        return np.nan_to_num(divided(np.array(places)), posinf=1e9, neginf=-1e9)


def found(work, number):
    """Return the places of all vertices that are drawn in a frame, (n, 2)."""
    draws = work.frame(number).draws
    places = np.concatenate([draw.vertices[:, :2] for draw in draws])
    return np.nan_to_num(places, posinf=1e9, neginf=-1e9)


@lru_cache(maxsize=2)
def mistakes(work, solution):
    """Return the hints for the points, the translation, the rotation and the division."""
    if compare(work, solution) is None:
        return (None,) * 4
    return (
        explained(
            (POINTS, MOVES, TURNS, DIVIDES),
            street,
            lambda number: found(work, number),
            FRAMES,
            close(1e-3),
        )
        or (None,) * 4
    )


def told(work, solution, part):
    text = mistakes(work, solution)[part]
    return hint(text) if text else None


@test(
    _("A point has four numbers, and the fourth is 1"),
    _("It is what the translation's last column is multiplied with."),
)
def points(work, solution):
    if all(np.abs(found(work, number)).max() < 1e-6 for number in FRAMES):
        return hint(
            _(
                "All lines begin and end in the middle of the picture. Begin with point: its "
                "result must depend on x, y and z."
            )
        )
    return told(work, solution, 0)


@test(
    _("The translation moves points"),
    _("Its last column is added to x, y and z."),
    needs=points,
)
def moves(work, solution):
    return told(work, solution, 1)


@test(
    _("The rotation turns around the y axis"),
    _("Counter-clockwise as seen from above, by an angle in degrees."),
    needs=moves,
)
def turns(work, solution):
    return told(work, solution, 2)


@test(
    _("The four numbers become a place"),
    _("All multiples of x, y, z, w are one and the same point; that with w = 1 is the place."),
    needs=turns,
)
def divides(work, solution):
    return told(work, solution, 3)


@test(
    _("The picture is right"),
    _("With the houses turned, and from other places of the street."),
    needs=divides,
)
def picture(work, solution):
    return compare(work, solution)


stacks = balanced(needs=picture)
