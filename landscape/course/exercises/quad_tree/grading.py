"""The tests of the exercise quad_tree."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.mistakes import colors, known

FRAMES = (0, 1, 2, 3)
EVENTS = [
    {"frame": frame, "key": key, "action": action}
    for frame, keys in {1: ("RIGHT",) * 2, 2: ("LEFT",) * 4, 3: ("RIGHT",) * 9}.items()
    for key in keys
    for action in ("press", "release")
]
TURNED = {0: 10, 1: 50, 2: -30, 3: 150}
WIDTH, HEIGHT, MAP, SMALLEST = 64, 72, 64, 4  # the picture of start.py, and its map
SIZES = (64, 32, 16, 8, 4)
TILES = ((120, 110, 190), (80, 130, 200), (70, 160, 150), (150, 180, 90), (225, 160, 70))
DOT = 242, 240, 230
TABLE = [*TILES, *(np.array(color) // 2 for color in (*TILES, DOT)), DOT]
BORDER, LIT = 5, 11  # the numbers of the first border's colour, and of a dot's
NOTHING = -1
OUTSIDE, INSIDE, ACROSS = range(3)
WEDGES = {}


def wedge(number):
    """Return the borders of what the camera sees in a frame, (3, 3), as start.py makes them."""
    angles = np.radians((TURNED[number] - 28, TURNED[number] + 28, TURNED[number]))
    cos, sin = np.cos(angles), np.sin(angles)
    return np.array(
        (
            (-sin[0], cos[0], 5 * sin[0] - 30 * cos[0]),
            (sin[1], -cos[1], 30 * cos[1] - 5 * sin[1]),
            (-cos[2], -sin[2], 5 * cos[2] + 30 * sin[2] + 52),
        )
    )


class Camera:
    """Answers where squares lie in a frame, and counts how often it is asked."""

    def __init__(self, number):
        self.number, self.calls = number, 0

    def look(self, x, y, size):
        self.calls += 1
        place = self.number, x, y, size
        if place not in WEDGES:
            corners = [(x + i * size, y + j * size, 1) for i in (0, 1) for j in (0, 1)]
            within = np.array(corners) @ wedge(self.number).T >= 0
            outside = not within.any(axis=0).all()
            WEDGES[place] = OUTSIDE if outside else INSIDE if within.all() else ACROSS
        return WEDGES[place]


def quarters(x, y, size):
    half = size // 2
    return [(x + right, y + down, half) for right in (0, half) for down in (0, half)]


def tree(
    camera,
    square,
    kept=(INSIDE,),
    dropped=(OUTSIDE,),
    divide=quarters,
    smallest=SMALLEST,
    at_end=lambda where: True,
    join=sum,
    parents=False,
    largest=MAP,
    looks=1,
    before=False,
):
    """Return the tiles of a square as visible should find them; other values are mistakes."""
    where = camera.look(*square)
    camera.calls += looks - 1 if where not in dropped else 0
    if where in dropped:
        return []
    if where in kept and square[2] <= largest:
        return [square]
    if square[2] <= smallest:
        return [square] if at_end(where) else []
    lists = []
    for part in divide(*square):
        if before and camera.look(*part) == OUTSIDE:
            continue
        lists.append(
            tree(
                camera,
                part,
                kept,
                dropped,
                divide,
                smallest,
                at_end,
                join,
                parents,
                largest,
                looks,
                before,
            )
        )

    return [square] * parents + list(join(lists, []))


def made(**values):
    """Return what makes the picture of a frame, (HEIGHT, WIDTH), by numbers of colours."""

    def drawn(number):
        camera = Camera(number)
        return painted(tree(camera, (0, 0, MAP), **values), camera.calls)

    return drawn


def painted(tiles, calls):
    found = np.full((HEIGHT, WIDTH), NOTHING)
    for x, y, size in tiles:
        color = SIZES.index(size) if size in SIZES else -1
        found[y : y + size, x : x + size] = BORDER + color if color >= 0 else BORDER + 5
        found[y : y + size - 1, x : x + size - 1] = color if color >= 0 else LIT
    found[MAP + 2 :].reshape(-1)[:calls] = LIT
    return found


def small_ones(number):
    """Return the picture if all small squares are asked for first."""
    camera = Camera(number)
    tiles = tree(camera, (0, 0, MAP))
    return painted(tiles, camera.calls + (MAP // SMALLEST) ** 2)


def all_small(number):
    """Return the picture if there is no tree, but only small squares."""
    camera = Camera(number)
    squares = [(x, y, SMALLEST) for x in range(0, MAP, SMALLEST) for y in range(0, MAP, SMALLEST)]
    return painted([each for each in squares if camera.look(*each) != OUTSIDE], camera.calls)


SEEN = (
    (
        lambda number: painted([(0, 0, MAP)], 0),
        _("The whole map is drawn: visible does not yet ask which part of it the camera sees."),
    ),
    (
        made(dropped=(), at_end=lambda where: True),
        _(
            "Parts that the camera does not see are drawn as well, in the smallest tiles: "
            "OUTSIDE has no effect."
        ),
    ),
    (
        made(parents=True),
        _(
            "Squares that are divided are drawn, too, under their quarters: so the whole map is "
            "covered."
        ),
    ),
    (
        made(dropped=(OUTSIDE, INSIDE)),
        _("Only the border of the wedge is drawn: its inside is left out."),
    ),
    (
        made(at_end=lambda where: False),
        _(
            "The border of the wedge is missing: squares of the smallest size are left out if they "
            "are not inside."
        ),
    ),
    (
        made(kept=(ACROSS,)),
        _("The map is drawn as one tile: divide the squares that lie across the border."),
    ),
    (
        made(dropped=(OUTSIDE, ACROSS)),
        _("Nothing is drawn: a square across the border may hold visible tiles."),
    ),
    (made(dropped=(OUTSIDE, INSIDE, ACROSS)), _("No tile is returned.")),
)
QUARTERS = (
    (
        made(divide=lambda x, y, size: [(x, y, size // 2)] * 4),
        _(
            "All four quarters are the same one, at the upper left: three of them begin in the "
            "middle of a side."
        ),
    ),
    (
        made(divide=lambda x, y, size: quarters(x, y, size)[:1]),
        _(
            "Of each square that is divided only the first quarter is treated: does the function "
            "return before the others?"
        ),
    ),
    (
        made(divide=lambda x, y, size: quarters(x, y, size)[:2]),
        _("Of each square that is divided only the left half is treated."),
    ),
    (
        made(divide=lambda x, y, size: quarters(x, y, size)[::2]),
        _("Of each square that is divided only the upper half is treated."),
    ),
    (
        made(divide=lambda x, y, size: quarters(x, y, size)[::3]),
        _("Only two quarters of each divided square are treated, those on a diagonal."),
    ),
    (
        made(join=lambda lists, begin: begin),
        _(
            "The quarters are looked at, but none of their tiles gets into the picture: add up "
            "what visible returns for them."
        ),
    ),
    (
        made(
            divide=lambda x, y, size: [
                (*each[:2], max(size // 4, SMALLEST)) for each in quarters(x, y, size)
            ]
        ),
        _(
            "Most tiles are missing: the quarters are at the right places, but their "
            "size is halved twice."
        ),
    ),
)
OF_SIZES = (
    (
        made(kept=(), at_end=lambda where: where != OUTSIDE),
        _("All tiles have the smallest size: a square that is INSIDE need not be divided."),
    ),
    (
        made(smallest=2 * SMALLEST),
        _(
            "The smallest tiles are of 8, and not of SMALLEST: the border of the wedge is too "
            "coarse."
        ),
    ),
    (
        made(smallest=SMALLEST // 2),
        _("There are tiles of 2 at the border: squares of the size SMALLEST are not divided."),
    ),
    (made(largest=16), _("No tile is larger than 16, though larger squares are INSIDE.")),
    (made(largest=8), _("No tile is larger than 8, though larger squares are INSIDE.")),
)
LOOKS = (
    (
        small_ones,
        _(
            "All squares of the smallest size are looked at, too, 256 calls more than are needed: "
            "the tree should spare them."
        ),
    ),
    (
        all_small,
        _(
            "Only squares of the smallest size are looked at, and all of them: 256 calls. A large "
            "square that is outside needs only one."
        ),
    ),
    (made(looks=2), _("Each square that is not outside is looked at twice: keep the answer.")),
    (made(looks=3), _("Squares are looked at three times: keep the answer.")),
    (
        made(before=True),
        _("The quarters are looked at before visible is called for them, and there again."),
    ),
)


def shown(work, number):
    return colors(work.frame(number), WIDTH, HEIGHT, TABLE)


def told(work, mistakes):
    return known(mistakes, lambda number: shown(work, number), FRAMES)


def right(work, solution):
    return compare(work, solution, most=0) is None


def covered(picture):
    return picture[:MAP] != NOTHING


RIGHT = made()


@test(
    _("Exactly the part that the camera sees is drawn"),
    _("Squares outside are dropped, those inside are tiles, and those across are divided."),
)
def seen(work, solution):
    if right(work, solution):
        return None
    if found := told(work, SEEN):
        return found
    if any(told(work, group) for group in (QUARTERS, OF_SIZES, LOOKS)):
        return None
    for number in FRAMES:
        more = covered(shown(work, number)) & ~covered(RIGHT(number))
        if more.any():
            y, x = np.argwhere(more)[0]
            return hint(
                _("In frame {frame} a tile is drawn that the camera does not see, at ({x}, {y})."),
                frame=number,
                x=int(x),
                y=int(y),
            )
    return None


@test(
    _("Squares are divided into four quarters"),
    _("The tiles of all four quarters together are the tiles of the square."),
    needs=seen,
)
def divided(work, solution):
    if right(work, solution):
        return None
    if found := told(work, QUARTERS):
        return found
    for number in FRAMES:
        less = covered(RIGHT(number)) & ~covered(shown(work, number))
        if less.any() and not told(work, OF_SIZES):
            y, x = np.argwhere(less)[0]
            return hint(
                _("In frame {frame} a tile is missing at ({x}, {y})."),
                frame=number,
                x=int(x),
                y=int(y),
            )
    return None


@test(
    _("The tiles are as large as possible, and not too small"),
    _("Only squares across the border are divided, and none of the smallest size."),
    needs=divided,
)
def sizes(work, solution):
    return None if right(work, solution) else told(work, OF_SIZES)


@test(
    _("No square is looked at without need"),
    _("That is what the tree is for: one answer holds for a whole square."),
    needs=sizes,
)
def looks(work, solution):
    if right(work, solution):
        return None
    if found := told(work, LOOKS):
        return found
    for number in FRAMES:
        got, wanted = (
            int((each[MAP + 2 :] == LIT).sum()) for each in (shown(work, number), RIGHT(number))
        )
        if got != wanted:
            return hint(
                _("In frame {frame} look is called {count} times, and {wanted} are enough."),
                frame=number,
                count=got,
                wanted=wanted,
            )
    return None


@test(
    _("The picture is right"),
    _("With the camera turned to four sides."),
    needs=looks,
)
def picture(work, solution):
    return compare(work, solution)
