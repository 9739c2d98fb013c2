"""The tests of the exercise back_faces."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.mistakes import colors, known

FRAMES = (0, 1, 2, 3, 4)
PRESSED = {1: "RRR", 2: "UUUU", 3: "UUULL", 4: "DDDDDDDR"}
KEYS = {"L": "LEFT", "R": "RIGHT", "U": "UP", "D": "DOWN"}
EVENTS = [
    {"frame": frame, "key": KEYS[letter], "action": action}
    for frame, letters in PRESSED.items()
    for letter in letters
    for action in ("press", "release")
]
WIDTH, HEIGHT, FOCAL, SIDES = 80, 60, 28, 6  # the picture of start.py, and its crystals
CENTERS = ((-1.7, -1, -2.7), (1.8, 1.1, -2.8))
COLORS = [(100 + 25 * face, 60 + 9 * face, 220 - 30 * face) for face in range(6)]
COLORS += [(70 + 9 * face, 230 - 22 * face, 90 + 20 * face) for face in range(6)]
FEWEST = 6  # chosen: pixels that may differ, as sums may be rounded in other ways


def angles():
    """Return the turn and the tilt of each frame, in degrees."""
    turned = 12
    tilted = 20
    found = {}
    for number in FRAMES:
        letters = PRESSED.get(number, "")
        turned += 10 * (letters.count("R") - letters.count("L"))
        tilted += 10 * (letters.count("D") - letters.count("U"))
        found[number] = turned, tilted
    return found


ANGLES = angles()


def crystal(number, center):
    """Return the faces of a crystal in a frame, (12, 3, 3), as start.py makes them."""
    turn, tilt = np.radians(ANGLES[number])
    around = turn + 2 * np.pi * np.arange(SIDES) / SIDES
    ring = np.stack((np.sin(around), 0 * around, np.cos(around)), axis=-1)
    faces = []
    for side in range(SIDES):
        first, second = ring[side], ring[(side + 1) % SIDES]
        faces += [(first, second, (0, 1.3, 0)), (second, first, (0, -1.3, 0))]
    cos, sin = np.cos(tilt), np.sin(tilt)
    return np.array(faces) @ np.array(((1, 0, 0), (0, cos, sin), (0, -sin, cos))) + center


ROW, COLUMN = np.mgrid[0:HEIGHT, 0:WIDTH]


def areas(number):
    """Return the faces of a frame: their corners, their colours, and the pixels that they cover."""
    found = []
    for which, center in enumerate(CENTERS):
        for face, corners in enumerate(crystal(number, center)):
            places = [(40 - FOCAL * x / z, 30 + FOCAL * y / z) for x, y, z in corners]
            sides = [
                (x1 - x0) * (ROW - y0) - (y1 - y0) * (COLUMN - x0)
                for (x0, y0), (x1, y1) in zip(places, places[1:] + places[:1])
            ]
            inside = (np.min(sides, axis=0) >= 0) | (np.max(sides, axis=0) <= 0)
            found.append((corners, 6 * which + face % 6, inside))
    return found


AREAS = {}


def made(seen):
    """Return what makes the number of the colour of each pixel, (HEIGHT, WIDTH), or -1."""

    def drawn(number):
        if number not in AREAS:
            AREAS[number] = areas(number)
        found = np.full((HEIGHT, WIDTH), -1)
        for corners, color, inside in AREAS[number]:
            if seen(*corners):
                found[inside] = color
        return found

    return drawn


def normal(a, b, c):
    return np.cross(b - a, c - a)


def along(sight):
    """Return the test of a face by its normal and a line of sight, from its first corner."""
    return made(lambda a, b, c: normal(a, b, c) @ sight(a) < 0)


RIGHT = along(lambda a: a)
TOWARDS = (
    (
        made(lambda a, b, c: True),
        _(
            "All faces are drawn: those behind cover those in front, and the crystals seem to be "
            "open."
        ),
    ),
    (
        made(lambda a, b, c: normal(a, b, c) @ a > 0),
        _(
            "Only the faces behind are drawn, and those in front are left out: either the normal "
            "leads into the crystal, or the sign is the other one."
        ),
    ),
    (
        made(lambda a, b, c: False),
        _(
            "No face is drawn: the normal is multiplied by something that is not the line of "
            "sight from the camera to the face."
        ),
    ),
)
AWAY = (
    (
        made(lambda a, b, c: normal(a, b, c) @ a < 1.5),
        _(
            "Faces that are turned away only a little are drawn, too: the product has to be "
            "compared with 0."
        ),
    ),
    (
        made(lambda a, b, c: max(a[2], b[2], c[2]) > -2.7),
        _(
            "A face is drawn if one of its corners is near. How near it is does not say to which "
            "side it is turned."
        ),
    ),
    (
        along(lambda a: np.array((-1, 0, 0))),
        _(
            "The faces that are drawn are those which are turned to the right, and not those which "
            "are turned towards the camera."
        ),
    ),
    (
        along(lambda a: np.array((0, -1, 0))),
        _(
            "The faces that are drawn are those which are turned upwards, and not those which are "
            "turned towards the camera."
        ),
    ),
    (
        made(lambda a, b, c: (normal(a, b, c) * (1, -1, 1)) @ a < 0),
        _(
            "A component of the normal has the wrong sign: the second one of a vector product is "
            "easily mistaken."
        ),
    ),
    (
        made(lambda a, b, c: normal(a, b, c) @ a < -2.2 * np.linalg.norm(normal(a, b, c))),
        _(
            "Faces that are seen at a low angle are missing: how far a face is turned does not "
            "matter, only to which side."
        ),
    ),
    (
        made(lambda a, b, c: (a + b + c)[2] > -9),
        _(
            "The nearer faces of each crystal are drawn: but the side to which a face is turned "
            "does not depend on how near it is."
        ),
    ),
)
SIGHTS = (
    (
        along(lambda a: -np.abs(a)),
        _("The line of sight has lost its signs: it always leads to the left and down."),
    ),
    (
        along(lambda a: np.array((0, 0, -1))),
        _(
            "All faces have the same line of sight, the one to the middle of the picture: so at "
            "the sides a face is missing, or one is seen that should not be."
        ),
    ),
    (
        along(lambda a: a * (1, 0, 1)),
        _(
            "The line of sight is always level, though it leads up to one crystal and down to the "
            "other."
        ),
    ),
    (
        along(lambda a: a * (0, 1, 1)),
        _("The line of sight leads straight ahead, and neither to the left nor to the right."),
    ),
    (
        along(lambda a: a - (2, 0, 0)),
        _("The faces are seen from another place than the origin, where the camera is."),
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


@test(
    _("Faces are drawn by the side to which they are turned"),
    _("Some faces must stay, and those that turn their back to the camera must go."),
)
def towards(work, solution):
    return None if right(work, solution) else told(work, TOWARDS)


@test(
    _("The faces that are turned towards the camera are drawn, and no others"),
    _("One sign decides it: the sign of the dot product of the normal and the line of sight."),
    needs=towards,
)
def away(work, solution):
    if right(work, solution):
        return None
    if found := told(work, AWAY):
        return found
    if told(work, SIGHTS):
        return None
    for number in FRAMES:
        wrong = (shown(work, number) != RIGHT(number)).sum()
        if wrong > FEWEST:
            return hint(
                _(
                    "In frame {frame} other faces are drawn than those that are turned towards the "
                    "camera: {count} pixels differ."
                ),
                frame=number,
                count=int(wrong),
            )
    return None


@test(
    _("Each face has its own line of sight"),
    _("It leads from the camera to any point of the face."),
    needs=away,
)
def sights(work, solution):
    return None if right(work, solution) else told(work, SIGHTS)


@test(
    _("The picture is right"),
    _("With the crystals turned and tilted."),
    needs=sights,
)
def picture(work, solution):
    return compare(work, solution)
