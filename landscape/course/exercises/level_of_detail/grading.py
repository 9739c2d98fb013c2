"""The tests of the exercise level_of_detail."""

from functools import lru_cache

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.mistakes import colors, explained

FRAMES = (0, 1, 2, 3)
EVENTS = [
    {"frame": frame, "key": key, "action": action}
    for frame, keys in {1: ("RIGHT",), 2: ("LEFT",) * 9, 3: ("RIGHT",) * 37}.items()
    for key in keys
    for action in ("press", "release")
]
EYES = {0: 30, 1: 33, 2: 6, 3: 117}
WIDTH, HEIGHT = 160, 64  # the picture of start.py, and its mountains
COLORS = {1: (225, 160, 70), 2: (150, 180, 90), 4: (70, 160, 150), 8: (80, 130, 200)}
VERTEX = 240, 240, 245
TABLE = [
    *(np.array(color) // 2 for color in (*COLORS.values(), VERTEX)),
    *COLORS.values(),
    VERTEX,
]
X = np.arange(WIDTH + 17)
HEIGHTS = 26 + 12 * np.sin(X / 13) + 7 * np.sin(X / 4.1) + 4 * np.sin(2.3 * X) + 3 * np.sin(1.3 * X)
FEWEST = 6  # chosen: pixels that may differ, as sums may be rounded in other ways


def right_step(distance):
    return 1 if distance < 16 else 2 if distance < 32 else 4 if distance < 64 else 8


STEPS = (
    (right_step, None),
    (
        lambda distance: 1,
        _(
            "There is a vertex at each whole number, also far away: step_at returns 1 for each "
            "distance."
        ),
    ),
    (lambda distance: 8, _("There is a vertex at each multiple of 8 only, also near the camera.")),
    (
        lambda distance: 8 // right_step(distance),
        _(
            "The vertices are far apart near the camera and close far away, and it should be the "
            "other way round."
        ),
    ),
    (
        lambda distance: min(1 + distance // 16, 8),
        _(
            "There are steps of 3, 5, 6 and 7: the step doubles, so that each grid has all "
            "vertices of the next one."
        ),
    ),
    (
        lambda distance: 16 if distance >= 128 else right_step(distance),
        _("Far away there are steps of 16: 8 is the largest."),
    ),
    (
        lambda distance: right_step(distance - 1),
        _("Each grid reaches one unit too far: at the distance 16 exactly, the step is 2 already."),
    ),
    (
        lambda distance: min(2 ** (distance // 16), 8),
        _(
            "The step of 8 begins too near, at 48: not only the step doubles, but also the "
            "distance up to which it holds."
        ),
    ),
    (lambda distance: right_step(distance / 2), _("Each grid reaches twice as far as it should.")),
    (
        lambda distance: right_step(distance * 2),
        _("Each grid reaches only half as far as it should."),
    ),
)


def gliding(
    kept=lambda x, step: step == 8 or x % (2 * step) == 0,
    weight=lambda step, distance: (distance - 12 * step) / (4 * step),
    limit=lambda weight: min(max(weight, 0), 1),
    between=lambda x, step: (HEIGHTS[x - step] + HEIGHTS[x + step]) / 2,
):
    """Return what computes the height of a vertex; other values are mistakes."""

    def height_of(x, step, distance):
        if kept(x, step):
            return HEIGHTS[x]
        part = limit(weight(step, distance))
        return (1 - part) * HEIGHTS[x] + part * between(x, step)

    return height_of


HEIGHTS_OF = (
    (gliding(), None),
    (
        gliding(limit=lambda weight: 0),
        _("No vertex glides: as the camera moves, each jumps away where its grid ends."),
    ),
    (
        gliding(limit=lambda weight: 1),
        _(
            "Every second vertex lies between its neighbours at any distance, as if it were not "
            "there."
        ),
    ),
    (
        gliding(limit=lambda weight: 1 - min(max(weight, 0), 1)),
        _(
            "The vertices glide the other way: near the camera every second one lies between its "
            "neighbours, and at the end of its grid it is in its own place."
        ),
    ),
    (
        gliding(kept=lambda x, step: step == 8),
        _(
            "All vertices glide, also those that the next grid has, too: these must stay where "
            "they are."
        ),
    ),
    (
        gliding(kept=lambda x, step: step == 8 or x % (2 * step) != 0),
        _(
            "Those vertices glide that the next grid has, too, and the others stay: it should be "
            "the other way round."
        ),
    ),
    (
        gliding(kept=lambda x, step: x % (2 * step) == 0),
        _(
            "Vertices of the coarsest grid glide, too, but there is no next grid for which they "
            "would have to."
        ),
    ),
    (
        gliding(between=lambda x, step: HEIGHTS[x - step]),
        _(
            "The vertices glide to the height of their left neighbour: what the next grid shows "
            "there lies in the middle between both."
        ),
    ),
    (
        gliding(between=lambda x, step: HEIGHTS[x + step]),
        _(
            "The vertices glide to the height of their right neighbour, and not to the middle "
            "between both."
        ),
    ),
    (
        gliding(between=lambda x, step: (HEIGHTS[x - 1] + HEIGHTS[x + 1]) / 2),
        _(
            "The vertices glide to the mean of the heights at x - 1 and x + 1. Their neighbours in "
            "a grid are a step away."
        ),
    ),
    (
        gliding(between=lambda x, step: HEIGHTS[x - step] + HEIGHTS[x + step]),
        _("There are peaks at the end of each grid: the two heights are added, and not halved."),
    ),
    (
        gliding(limit=lambda weight: weight),
        _(
            "Near the camera every second vertex is pushed away from its neighbours: the weight is "
            "less than 0 there, and must not be."
        ),
    ),
    (
        gliding(weight=lambda step, distance: distance / (16 * step)),
        _("The vertices already glide at the camera, and not only from 12 * step on."),
    ),
    (
        gliding(weight=lambda step, distance: (distance - 8 * step) / (8 * step)),
        _(
            "The vertices glide from the beginning of their grid on, and not only from 12 * step "
            "on."
        ),
    ),
    (
        gliding(limit=lambda weight: round(min(max(weight, 0), 1))),
        _("The vertices do not glide, but jump half way, at 14 * step."),
    ),
)


def mountains(number, step_at, height_of):
    """Return the picture of a frame, (HEIGHT, WIDTH), by numbers of colours, as start.py makes "
    "it."""
    vertices = []
    for x in range(WIDTH + 1):
        distance = abs(x - EYES[number])
        step = step_at(distance)
        if x % step == 0:
            vertices.append((x, height_of(x, step, distance), step))

    found = np.full((HEIGHT, WIDTH), -1)
    steps = list(COLORS)
    for (x, height, step), (next_x, next_height, _step) in zip(vertices, vertices[1:]):
        color = steps.index(step) if step in steps else 4
        columns = np.arange(x, next_x)
        levels = height + (next_height - height) * (columns - x) / (next_x - x)
        rows = HEIGHT - 1 - np.clip(levels + 0.5, 0, HEIGHT - 1).astype(int)
        for column, row in zip(columns, rows):
            found[row:, column] = color
            found[row : row + 2, column] = 9 if column == x else 5 + color

    found[:4, EYES[number]] = 9
    return found


def shown(work, number):
    return colors(work.frame(number), WIDTH, HEIGHT, TABLE)


def same(one, other):
    return (one != other).sum() <= FEWEST


@lru_cache(maxsize=2)
def mistakes(work, solution):
    """Return the hints for the steps and for the heights."""
    if compare(work, solution) is None:
        return (None,) * 2
    return (
        explained((STEPS, HEIGHTS_OF), mountains, lambda number: shown(work, number), FRAMES, same)
        or (None,) * 2
    )


def columns_with_vertices(picture, number):
    """Return the columns of the vertices, without that of the camera."""
    columns = np.flatnonzero((picture == 9).any(axis=0))
    return columns[columns != EYES[number]]


@test(
    _("The farther away, the fewer vertices"),
    _("Each grid has twice the step of the one before, and reaches twice as far."),
)
def grid(work, solution):
    if compare(work, solution) is None:
        return None
    if any(mistakes(work, solution)):
        text = mistakes(work, solution)[0]
        return hint(text) if text else None
    for number in FRAMES:
        got = columns_with_vertices(shown(work, number), number)
        wanted = columns_with_vertices(mountains(number, right_step, gliding()), number)
        other = np.setxor1d(got, wanted)
        if len(other):
            x, there = int(other[0]), bool(np.isin(other[0], got))
            if there:
                return hint(
                    _(
                        "In frame {frame} there is a vertex at x = {x}, {distance} away from the "
                        "camera, and none should be."
                    ),
                    frame=number,
                    x=x,
                    distance=abs(x - EYES[number]),
                )
            return hint(
                _(
                    "In frame {frame} there is no vertex at x = {x}, {distance} away from the "
                    "camera."
                ),
                frame=number,
                x=x,
                distance=abs(x - EYES[number]),
            )

    return None


@test(
    _("Vertices glide before they go"),
    _("At the end of its grid, a vertex lies where the next grid has its line."),
    needs=grid,
)
def glide(work, solution):
    if compare(work, solution) is None:
        return None
    if text := mistakes(work, solution)[1]:
        return hint(text)
    for number in FRAMES:
        wrong = shown(work, number) != mountains(number, right_step, gliding())
        if wrong.sum() > FEWEST:
            x = int(np.flatnonzero(wrong.any(axis=0))[0])
            return hint(
                _(
                    "In frame {frame} the mountains have another height near x = {x}, {distance} "
                    "away from the camera."
                ),
                frame=number,
                x=x,
                distance=abs(x - EYES[number]),
            )
    return None


@test(
    _("The picture is right"),
    _("With the camera in four places."),
    needs=glide,
)
def picture(work, solution):
    return compare(work, solution)
