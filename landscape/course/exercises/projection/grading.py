"""The tests of the exercise projection."""

from functools import lru_cache

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.mistakes import colors, explained

FRAMES = (0, 1, 2, 3, 4)
PRESSED = {1: "LL", 2: "RRRU", 3: "SD", 4: "RRRRRRUS"}
KEYS = {"L": "LEFT", "R": "RIGHT", "U": "UP", "D": "DOWN", "S": "SPACE"}
EVENTS = [
    {"frame": frame, "key": KEYS[letter], "action": action}
    for frame, letters in PRESSED.items()
    for letter in letters
    for action in ("press", "release")
]
WIDTH, HEIGHT, FOCAL, NEAR = 80, 60, 50, 1  # the picture of start.py, and its camera
COLORS = ((80, 140, 190), (235, 215, 160), (110, 160, 90), (70, 115, 70), (240, 240, 245))
FEWEST = 6  # chosen: pixels that may differ, as sums may be rounded in other ways


def cameras():
    """Return the eye, and the degrees of turn and tilt, of each frame."""
    height = 4.2
    turned = 9
    tilted = -11
    found = {}
    for number in FRAMES:
        letters = PRESSED.get(number, "")
        turned += 15 * (letters.count("L") - letters.count("R"))
        tilted += 7 * (letters.count("U") - letters.count("D"))
        height += 1.5 * letters.count("S")
        found[number] = np.array((1.3, 0.37, height)), turned, tilted
    return found


def island():
    """Return x, y, z of the points, (n, 3), and the numbers of their colours, (n,)."""
    points, levels = [], []
    for x in range(30, -12, -1):
        for y in range(-14, 15):
            z = 5 * np.exp(-((x - 16) ** 2 + (y - 3) ** 2) / 40) + 0.6 * np.sin(x + 2 * y) - 0.5
            points.append((x, y, max(z, 0)))
            levels.append(int(np.searchsorted((0, 0.5, 2, 4), z)))
    points += [(9, -6, z / 4) for z in range(16)]
    return np.array(points, float), np.array(levels + [4] * 16)


CAMERAS = cameras()
POINTS, LEVELS = island()

EYES = (
    (lambda eye: -eye, None),
    (
        lambda eye: 0 * eye,
        _(
            "The island is seen from the origin: the eye's place has to be subtracted from the "
            "point."
        ),
    ),
    (
        lambda eye: eye,
        _(
            "The camera goes down where it should go up: the eye's place is added, and should be "
            "subtracted."
        ),
    ),
    (
        lambda eye: -eye * (1, 1, 0),
        _(
            "The camera lies on the water, and Space does not lift it: the third coordinate of the "
            "eye has to be subtracted, too."
        ),
    ),
)
TURNS = (
    (lambda c, s, x, y: (c * x + s * y, s * x - c * y), None),
    (
        lambda c, s, x, y: (x, -y),
        _("The camera always looks to the east: Left and Right have no effect."),
    ),
    (
        lambda c, s, x, y: (c * x - s * y, -s * x - c * y),
        _("Left turns the camera to the right: the camera's turn has to be taken back."),
    ),
    (
        "radians",
        _(
            "The camera turns by far too much: cosine and sine want radians, and `turned` is in "
            "degrees."
        ),
    ),
    (
        lambda c, s, x, y: (c * x + s * y, c * y - s * x),
        _(
            "The picture is mirrored: points to the left of the camera are treated as if they "
            "were to the right."
        ),
    ),
    (
        lambda c, s, x, y: (c * y - s * x, c * x + s * y),
        _("The camera looks to the north where it should look to the east: x leads to the east."),
    ),
)
TILTS = (
    (lambda c, s, ahead, up, x: (c * ahead + s * up, c * up - s * ahead), None),
    (
        lambda c, s, ahead, up, x: (ahead, up),
        _("The camera always looks level: Up and Down have no effect."),
    ),
    (
        lambda c, s, ahead, up, x: (c * ahead - s * up, c * up + s * ahead),
        _("The camera is tilted upwards where it should be tilted downwards."),
    ),
    (
        "radians",
        _(
            "The camera is tilted by far too much: `tilted` is in degrees, and cosine and sine "
            "want radians."
        ),
    ),
    (
        lambda c, s, ahead, up, x: (c * x + s * up, c * up - s * x),
        _(
            "If the camera is turned, the tilt goes wrong: after the turn, it must change the "
            "distance ahead of the camera, not the distance to the east."
        ),
    ),
    (
        "new",
        _(
            "The tilt computes the height from the distance ahead after the tilt: compute both "
            "numbers from those before it."
        ),
    ),
)


def over(change, kept=lambda ahead: ahead >= NEAR, whole=np.floor):
    """Return what makes columns, rows and whether they are seen, from the camera's frame."""

    def pixels(ahead, right, up):
        with np.errstate(all="ignore"):
            column, row = change(ahead, right, up)
            return whole(column), whole(row), kept(ahead)

    return pixels


def plain(ahead, right, up):
    return WIDTH / 2 + FOCAL * right / ahead, HEIGHT / 2 - FOCAL * up / ahead


def by_distance(ahead, right, up):
    return plain(np.sqrt(ahead**2 + right**2 + up**2), right, up)


def always(ahead):
    return ahead != 0


PIXELS = (
    (over(plain), None),
    (
        over(lambda a, r, u: (WIDTH / 2 + r, HEIGHT / 2 - u)),
        _("Far things are as large as near ones: divide by the distance ahead."),
    ),
    (
        over(by_distance),
        _(
            "Near the borders the picture is bent: it is divided by the distance from the eye, and "
            "not by how far the point is ahead."
        ),
    ),
    (
        over(lambda a, r, u: (WIDTH / 2 + FOCAL * r / a, HEIGHT / 2 + FOCAL * u / a)),
        _("The picture is upside down: rows are counted from the top."),
    ),
    (
        over(lambda a, r, u: (FOCAL * r / a, -FOCAL * u / a)),
        _("The point straight ahead is in the upper left corner, not in the middle."),
    ),
    (
        over(plain, always),
        _(
            "Points from behind the camera are in the picture, too, upside down: for them ahead is "
            "negative."
        ),
    ),
    (
        over(lambda a, r, u: plain(np.abs(a), r, u), lambda a: np.abs(a) >= NEAR),
        _("Points behind the camera are seen as if they were in front of it."),
    ),
    (
        over(plain, whole=np.round),
        _(
            "The picture lies half a pixel too far to the right and down: fractions are rounded, "
            "and should be cut off."
        ),
    ),
    (
        over(
            lambda a, r, u: (WIDTH / 2 + FOCAL * r / a, HEIGHT / 2 - FOCAL * HEIGHT / WIDTH * u / a)
        ),
        _(
            "The picture is squeezed in height: FOCAL holds for the columns and for the rows "
            "alike, as pixels are squares."
        ),
    ),
)


def picture_of(number, eye, turn, tilt, pixels):
    """Return the number of the colour of each pixel of a frame, (HEIGHT, WIDTH), or -1."""
    place, turned, tilted = CAMERAS[number]
    x, y, z = (POINTS + eye(place)).T
    angle = turned if turn == "radians" else np.radians(turned)
    way = TURNS[0][0] if turn == "radians" else turn
    level, right = way(np.cos(angle), np.sin(angle), x, y)
    angle = tilted if tilt == "radians" else np.radians(tilted)
    cos, sin = np.cos(angle), np.sin(angle)
    if tilt == "new":
        ahead = cos * level + sin * z
        up = cos * z - sin * ahead
    else:
        ahead, up = (TILTS[0][0] if tilt == "radians" else tilt)(cos, sin, level, z, x)
    column, row, seen = pixels(ahead, right, up)
    seen = seen & (column >= 0) & (column < WIDTH) & (row >= 0) & (row < HEIGHT)
    found = np.full((HEIGHT, WIDTH), -1)
    found[row[seen].astype(int), column[seen].astype(int)] = LEVELS[seen]
    return found


def shown(work, number):
    return colors(work.frame(number), WIDTH, HEIGHT, COLORS)


def same(one, other):
    """Compare two pictures; int cuts off otherwise than floor in the first column and row."""
    return (one != other)[1:, 1:].sum() <= FEWEST


@lru_cache(maxsize=2)
def mistakes(work, solution):
    """Return the hints for the eye, the turn, the tilt and the pixels."""
    if compare(work, solution) is None:
        return (None,) * 4
    return (
        explained(
            (EYES, TURNS, TILTS, PIXELS),
            picture_of,
            lambda number: shown(work, number),
            FRAMES,
            same,
        )
        or (None,) * 4
    )


def told(work, solution, part):
    text = mistakes(work, solution)[part]
    return hint(text) if text else None


@test(
    _("The camera is at the eye"),
    _("The eye's position is subtracted from all points."),
)
def from_eye(work, solution):
    if all((shown(work, number) >= 0).sum() == 1 for number in FRAMES):
        return hint(
            _(
                "All points come to the same pixel. Begin with to_pixel: without turn and tilt, "
                "and from the origin, something of the island should be seen then."
            )
        )
    return told(work, solution, 0)


@test(
    _("The camera is turned"),
    _("Around the vertical: sine and cosine mix the distances ahead and to the right."),
    needs=from_eye,
)
def turns(work, solution):
    return told(work, solution, 1)


@test(
    _("The camera is tilted"),
    _("Around the axis to its right: the distances ahead and above are mixed."),
    needs=turns,
)
def tilts(work, solution):
    return told(work, solution, 2)


@test(
    _("Each point is in its pixel"),
    _("Divided by how far it is ahead, from the middle of the picture on."),
    needs=tilts,
)
def pixels(work, solution):
    return told(work, solution, 3)


@test(
    _("The picture is right"),
    _("Turned to all sides, tilted and lifted."),
    needs=pixels,
)
def picture(work, solution):
    return compare(work, solution)
