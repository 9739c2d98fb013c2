"""The tests of the exercise frames."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.mistakes import balanced, close, known, silent

FRAMES = (0, 1, 2, 3)
EVENTS = [
    {"frame": frame, "key": key, "action": action}
    for frame, keys in {1: ("LEFT",) * 3, 2: ("RIGHT",) * 7, 3: ("LEFT",) * 20}.items()
    for key in keys
    for action in ("press", "release")
]
ANGLES = {0: 10, 1: 40, 2: -30, 3: 170}
HUB, RADIUS = np.array((0.5, 0.4)), 3
FEET, SIZE = (0.15, -0.9), 0.45
SAME = close(0.02)


def moved(x, y):
    """Return the matrix of a translation in the plane, (3, 3)."""
    return np.array(((1, 0, x), (0, 1, y), (0, 0, 1)), float)


def turned(degrees):
    cos, sin = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array(((cos, -sin, 0), (sin, cos, 0), (0, 0, 1)))


SMALL = np.diag((SIZE, SIZE, 1))


def placed(work, mode):
    """Return what gives the matrices of a frame's draws of a kind, (n, 3, 3), in their order."""

    def matrices(number):
        found = [draw.modelview for draw in work.frame(number).draws if draw.mode == mode]
        return np.array(found).reshape(-1, 4, 4)[:, [0, 1, 3]][:, :, [0, 1, 3]]

    return matrices


def cabins(work):
    return placed(work, "GL_QUADS")


def places(work):
    """Return what gives the places of a frame's cabins, (n, 2)."""
    return lambda number: cabins(work)(number)[:, :2, 2]


def eight(change):
    """Return what makes the matrices or places of eight cabins, from an angle and a number."""
    return lambda number: np.array([change(ANGLES[number], each) for each in range(8)])


def at(x, y, degrees):
    """Return the place RADIUS away from a point, in a direction."""
    return np.array((x, y)) + RADIUS * turned(degrees)[:2, 0]


def one(change):
    return lambda number: change(ANGLES[number])[None]


RIMS = (
    (
        one(lambda angle: np.identity(3)),
        _(
            "The rim goes around the middle of the picture, and does not turn: it has no frame of "
            "its own yet."
        ),
    ),
    (
        one(turned),
        _(
            "The rim turns around the middle of the picture, which is the origin: the hub is at "
            "HUB."
        ),
    ),
    (
        one(lambda angle: moved(*HUB)),
        _("The rim is in its place, but it does not turn with `angle`."),
    ),
    (
        one(lambda angle: turned(angle) @ moved(*HUB)),
        _(
            "As the wheel turns, its hub goes around the middle of the picture: it is moved to "
            "HUB first, and then turned around the origin. The last call applies first."
        ),
    ),
    (
        one(lambda angle: moved(*HUB) @ turned(-angle)),
        _("The wheel turns clockwise when `angle` grows."),
    ),
    (
        one(lambda angle: moved(*HUB) @ turned(np.radians(angle))),
        _(
            "The wheel hardly turns, by a fifty-seventh of `angle`: has it been converted to "
            "radians?"
        ),
    ),
)


def piled(number):
    """Return the places of cabins that each begin in the frame of the one before."""
    matrix, found = moved(*HUB) @ turned(ANGLES[number]), []
    for each in range(8):
        matrix = matrix @ turned(45 * each) @ moved(RADIUS, 0)
        matrix = matrix @ turned(-45 * each - ANGLES[number])
        found.append(matrix[:2, 2])
        matrix = matrix @ moved(*FEET) @ SMALL
    return np.array(found)


PLACES = (
    (
        eight(lambda angle, each: HUB),
        _("All cabins hang from the hub: they are not moved out to the rim."),
    ),
    (
        eight(lambda angle, each: np.zeros(2)),
        _("All cabins are in the middle of the picture: the wheel's frame does not hold for them."),
    ),
    (
        eight(lambda angle, each: at(*HUB, angle)),
        _(
            "All cabins hang in one place: each has to be turned by an angle of its own, 45 "
            "degrees more than the one before, and that call comes before the one that moves it "
            "out."
        ),
    ),
    (
        eight(lambda angle, each: at(0, 0, angle)),
        _("All cabins hang in one place, and their circle goes around the origin, not around HUB."),
    ),
    (
        eight(lambda angle, each: at(*HUB, 45 * each)),
        _(
            "The wheel turns, and its cabins stay where they are: the angle of the wheel must hold "
            "for them, too."
        ),
    ),
    (
        eight(lambda angle, each: at(0, 0, 45 * each + angle)),
        _(
            "The cabins go around the middle of the picture, and the rim goes around HUB: "
            "where a cabin is placed, the frame of the wheel is forgotten."
        ),
    ),
    (
        eight(lambda angle, each: at(*HUB, angle + 40 * each)),
        _("The last cabins are too far from the first one: eight cabins on 360 degrees."),
    ),
    (
        piled,
        _(
            "Each cabin begins in the frame of the one before it: they leave the wheel, and become "
            "smaller. Keep the wheel's frame before each cabin, and return to it."
        ),
    ),
)


def hung(back):
    """Return what makes the matrices of cabins that are turned back by an angle."""
    return eight(
        lambda angle, each: (
            moved(*HUB) @ turned(angle + 45 * each) @ moved(RADIUS, 0) @ turned(back(angle, each))
        )
    )


UPRIGHT = (
    (
        hung(lambda angle, each: 0),
        _(
            "The cabins stand out from the wheel in all directions, the upper ones on their heads: "
            "each has to be turned back at its place."
        ),
    ),
    (
        hung(lambda angle, each: -angle),
        _(
            "The first cabin is level, and each of the others is tipped by 45 degrees more: they "
            "are turned back by the angle of the wheel, but not by the angle of their place on "
            "it."
        ),
    ),
    (
        hung(lambda angle, each: -45 * each),
        _(
            "All cabins are tipped alike, by the angle of the wheel: they are turned back only "
            "by the angle of their place on it."
        ),
    ),
    (
        hung(lambda angle, each: angle + 45 * each),
        _("The cabins are turned on instead of back: by which angle is a cabin level again?"),
    ),
)


def inside(work):
    """Return what gives the matrices of people in the frames of their cabins, (n, 3, 3)."""

    def matrices(number):
        people, around = placed(work, "GL_POLYGON")(number), cabins(work)(number)
        if len(people) != len(around):
            return people
        return np.linalg.inv(around) @ people

    return matrices


def always(matrix):
    return lambda number: np.repeat(matrix[None], 8, axis=0)


def in_wheel(number):
    """Return people in the frame of the wheel, seen from the cabins."""
    wheel = moved(*HUB) @ turned(ANGLES[number]) @ moved(*FEET) @ SMALL
    around = hung(lambda angle, each: -angle - 45 * each)(number)
    return np.linalg.inv(around) @ wheel


PEOPLE = (
    (
        always(SMALL),
        _(
            "The people stand on the points from which their cabins hang: in the cabin's frame, "
            "their feet are at (0.15, -0.9)."
        ),
    ),
    (
        always(moved(*FEET)),
        _(
            "The people are giants: as they are drawn they are 1 high, and they should be 0.45 "
            "high."
        ),
    ),
    (
        always(SMALL @ moved(*FEET)),
        _(
            "The people hover: the way to their feet is scaled as well, as the scaling is called "
            "before the translation."
        ),
    ),
    (
        in_wheel,
        _(
            "All people stand at the hub, one on the other: their cabin's frame no longer holds "
            "when they are drawn."
        ),
    ),
)


@test(
    _("The wheel turns around its hub"),
    _("It is turned in its own frame, and that is moved to HUB."),
)
def rim(work, solution):
    if silent(work, solution):
        return None
    if told := known(RIMS, placed(work, "GL_LINE_LOOP"), FRAMES, SAME):
        return told

    for number in FRAMES:
        found = placed(work, "GL_LINE_LOOP")(number)
        if len(found) == 1 and not SAME(found[0, :2, 2], HUB):
            x, y = found[0, :2, 2]
            return hint(
                _("In frame {frame} the hub is at ({x:.2f}, {y:.2f}), and not at HUB."),
                frame=number,
                x=x,
                y=y,
            )

        loops = [draw for draw in work.frame(number).draws if draw.mode == "GL_LINE_LOOP"]
        away = [np.linalg.norm(draw.eye[:, :2] - HUB, axis=1) for draw in loops[:1]]
        if away and np.ptp(away[0]) > 0.02:
            return hint(
                _(
                    "In frame {frame} the rim is no circle: does the wheel turn around the z axis, "
                    "which leads to the eye?"
                ),
                frame=number,
            )
    return None


@test(
    _("The cabins are at the rim"),
    _("In the frame of the wheel, and each turned by its own angle."),
    needs=rim,
)
def on_rim(work, solution):
    if silent(work, solution):
        return None
    if told := known(PLACES, places(work), FRAMES, SAME):
        return told
    for number in FRAMES:
        for each, place in enumerate(places(work)(number)):
            distance = float(np.linalg.norm(place - HUB))
            if abs(distance - RADIUS) > 0.05:
                return hint(
                    _(
                        "In frame {frame} cabin number {number}, counted from 0, is {distance:.2f} "
                        "away from HUB, and should be at the rim, {radius} away."
                    ),
                    frame=number,
                    number=each,
                    distance=distance,
                    radius=RADIUS,
                )
        wanted = eight(lambda angle, each: at(*HUB, angle + 45 * each))(number)
        for each, place in enumerate(places(work)(number)):
            if np.abs(wanted - place).max(axis=1).min() > 0.05:
                return hint(
                    _(
                        "In frame {frame} cabin number {number}, counted from 0, is at the rim, "
                        "but at ({x:.2f}, {y:.2f}), where there should be none."
                    ),
                    frame=number,
                    number=each,
                    x=place[0],
                    y=place[1],
                )

    return None


@test(
    _("The cabins are level"),
    _("A rotation of the frame must be undone inside it."),
    needs=on_rim,
)
def upright(work, solution):
    if silent(work, solution):
        return None
    return known(UPRIGHT, cabins(work), FRAMES, SAME)


@test(
    _("A person stands in each cabin"),
    _("Its frame is in the frame of the cabin: first in its place, and smaller there."),
    needs=upright,
)
def people(work, solution):
    if silent(work, solution):
        return None
    if told := known(PEOPLE, inside(work), FRAMES, SAME):
        return told
    for number in FRAMES:
        for each, matrix in enumerate(inside(work)(number)):
            if not SAME(matrix[:2, 2], FEET):
                return hint(
                    _(
                        "In frame {frame} the feet of person number {number}, counted from 0, are "
                        "at ({x:.2f}, {y:.2f}) in the frame of its cabin."
                    ),
                    frame=number,
                    number=each,
                    x=matrix[0, 2],
                    y=matrix[1, 2],
                )
    return None


@test(
    _("The picture is right"),
    _("At several angles of the wheel."),
    needs=people,
)
def picture(work, solution):
    return compare(work, solution)


stacks = balanced(needs=picture)
