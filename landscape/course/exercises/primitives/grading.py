"""The tests of the exercise primitives."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.mistakes import balanced, followed

FRAMES = (0, 1, 2)
EVENTS = [{"frame": 2, "resize": [300, 360]}]
# Left, bottom, right and top of what each part covers, in units of the picture.
PARTS = {
    "trees": (21.5, 7.5, 32, 14.5),
    "fence": (0, 0, 15, 5),
    "path": (16, 0, 23.3, 7),
    "pond": (23.5, 1, 32, 6),
    "hill": (0, 6.5, 21, 16),
    "sun": (21, 15.5, 29, 23),
}
LAST = {  # vertices that only these tables have
    "trees": (23.5, 13),
    "fence": (1, 4),
    "path": (18, 3.2),
    "pond": (31, 3.5),
    "hill": (20, 7),
    "sun": (28, 19),
}
NEAR = 0.05  # chosen: units by which a vertex may be elsewhere


def box(part):
    """Return the part of the picture that something covers."""
    left, bottom, right, top = PARTS[part]
    return left / 32, 1 - top / 24, right / 32, 1 - bottom / 24


def right(work, solution, part):
    part_right = compare(work, solution, box=box(part), most=0.004) is None
    return part_right or not followed(work)


def places(draw):
    """Return the vertices of a draw in units of the picture, (n, 2)."""
    width, height = draw.state["GL_VIEWPORT"][2:]
    return draw.window / (width, height) * (32, 24)


def of(work, part):
    """Return the draw that has the vertices of a part, or None."""
    for draw in work.frame(0).draws:
        points = places(draw)
        if len(points) and np.abs(points - LAST[part]).max(axis=1).min() < NEAR:
            return draw
    return None


def line_of(work, draw):
    """Return the line in which the kind of a draw is named: that of a function that draws it."""
    lines = [line for line, _name in draw.call.way] or [draw.line]
    return next((line for line in lines[::-1] if "GL_" in work.text(line)), draw.line)


def told(work, solution, part, texts):
    """Return the hint for a part by the kind that it is drawn as; None if it is right."""
    if right(work, solution, part):
        return None
    draw = of(work, part)
    if draw is not None and draw.mode in texts:
        return hint(texts[draw.mode], line=line_of(work, draw))
    return None


@test(
    _("Each tree is a triangle"),
    _("Three vertices make a triangle, and the next three make another one."),
)
def trees(work, solution):
    return told(
        work,
        solution,
        "trees",
        {
            "GL_POINTS": _(
                "The trees are nine points: line {line} joins no vertices. Which mode takes "
                "three at a time and fills the face between them?"
            ),
            "GL_TRIANGLE_STRIP": _(
                "The trees are joined: in a strip, line {line}, each vertex makes a triangle with "
                "the two before it, also with those of the tree before."
            ),
            "GL_POLYGON": _(
                "The trees are a single face, as line {line} takes all nine vertices for the "
                "corners of one polygon."
            ),
            "GL_TRIANGLE_FAN": _(
                "All triangles of the trees begin in the same corner, that of the first tree: line "
                "{line} draws a fan."
            ),
            "GL_QUADS": _(
                "Line {line} takes four vertices for each face, and so two trees are joined."
            ),
            "GL_LINE_LOOP": _(
                "The trees are not filled: line {line} draws one line through all of their corners."
            ),
        },
    )


@test(
    _("Each picket is a line"),
    _("Two vertices make a line, and the next two make another one."),
    needs=trees,
)
def fence(work, solution):
    return told(
        work,
        solution,
        "fence",
        {
            "GL_POINTS": _("Of the fence there are only the ends of the pickets, as points."),
            "GL_LINE_STRIP": _(
                "The pickets are joined: line {line} draws one line through all vertices, also "
                "from the top of a picket down to the next one."
            ),
            "GL_LINE_LOOP": _(
                "The pickets are joined, and the last one with the first: line {line} draws one "
                "closed line."
            ),
            "GL_QUAD_STRIP": _(
                "The fence is a wall: line {line} fills the gaps between the pickets."
            ),
            "GL_TRIANGLE_STRIP": _(
                "The fence is filled: line {line} makes a triangle of each three vertices that "
                "follow each other."
            ),
            "GL_QUADS": _(
                "Line {line} makes a face of each two pickets, whose sides cross. A picket is "
                "only a line."
            ),
        },
    )


@test(
    _("The path is one line with two ends"),
    _("From each vertex to the next one."),
    needs=fence,
)
def path(work, solution):
    return told(
        work,
        solution,
        "path",
        {
            "GL_POINTS": _("Of the path there are only its bends, as points."),
            "GL_LINES": _(
                "The path has gaps: line {line} joins the first vertex with the second one, the "
                "third with the fourth, and nothing in between."
            ),
            "GL_LINE_LOOP": _(
                "The path leads back to its beginning: line {line} joins the last vertex with the "
                "first one, too."
            ),
            "GL_TRIANGLE_STRIP": _(
                "The path is filled: line {line} draws triangles, and not a line."
            ),
        },
    )


@test(
    _("The shore of the pond is closed"),
    _("From each vertex to the next one, and from the last one to the first."),
    needs=path,
)
def pond(work, solution):
    return told(
        work,
        solution,
        "pond",
        {
            "GL_POINTS": _("Of the pond there are only eight points."),
            "GL_LINE_STRIP": _(
                "The shore is open at the lower right: line {line} does not join the last vertex "
                "with the first one."
            ),
            "GL_POLYGON": _(
                "The pond is filled: line {line} draws a face, and the shore is a line."
            ),
            "GL_LINES": _(
                "Every second side of the shore is missing: line {line} takes two vertices for "
                "each line, and none of them twice."
            ),
        },
    )


@test(
    _("The hill is filled, without gaps"),
    _("Its vertices go in zigzag, which is the order of a strip."),
    needs=pond,
)
def hill(work, solution):
    return told(
        work,
        solution,
        "hill",
        {
            "GL_POINTS": _("Of the hill there are only points along its lower and upper border."),
            "GL_TRIANGLES": _(
                "The hill has gaps like missing teeth: line {line} takes three vertices for each "
                "triangle, and none of them twice. Here each triangle shares a side with the next."
            ),
            "GL_QUADS": _(
                "The hill has gaps and notches: line {line} goes around four vertices, and "
                "these follow each other in zigzag."
            ),
            "GL_TRIANGLE_FAN": _(
                "All triangles of the hill begin in its lower left corner: line {line} draws a fan."
            ),
            "GL_POLYGON": _(
                "Line {line} goes around all vertices of the hill as if they were its outline, but "
                "they follow each other in zigzag."
            ),
            "GL_LINE_STRIP": _("The hill is a zigzag line, and not filled, by line {line}."),
        },
    )


@test(
    _("The sun is round and has no gap"),
    _("A fan begins in the middle; its last triangle ends where the first one begins."),
    needs=hill,
)
def sun(work, solution):
    if right(work, solution, "sun"):
        return None
    draw = of(work, "sun")
    if draw is not None and draw.mode == "GL_TRIANGLE_FAN":
        points = places(draw)
        first = np.abs(points[-1] - points[0]).max() < NEAR
        if first and np.abs(points[0] - (25, 19)).max() < NEAR:
            return hint(
                _(
                    "A sixteenth of the sun is missing, although its middle is given once more at "
                    "the end: the last triangle needs the vertex on the rim where the first began."
                )
            )
        if len(points) == 17:
            return hint(
                _(
                    "A sixteenth of the sun is missing, below the right: 16 vertices on the rim "
                    "make 15 triangles with the middle, line {line}. Which vertex is needed twice?"
                ),
                line=line_of(work, draw),
            )

    return told(
        work,
        solution,
        "sun",
        {
            "GL_POINTS": _("Of the sun there are only points."),
            "GL_TRIANGLE_STRIP": _(
                "Of the sun there is little more than slivers at its rim: in a strip, line "
                "{line}, a vertex makes "
                "a triangle with the two before it, and not with the middle."
            ),
            "GL_TRIANGLES": _(
                "Only a part of the sun is there: line {line} takes three vertices for each "
                "triangle, so only the first triangle has the middle."
            ),
            "GL_LINE_LOOP": _("The sun is not filled: line {line} draws its rim."),
            "GL_POLYGON": _(
                "A polygon goes around its vertices, line {line}, and the middle of the sun is not "
                "on its rim."
            ),
        },
    )


@test(
    _("The picture is right"),
    _("Also in a window of another size."),
    needs=sun,
)
def picture(work, solution):
    return compare(
        work,
        solution,
        regions={
            _("the trees"): box("trees"),
            _("the fence"): box("fence"),
            _("the path"): box("path"),
            _("the pond"): box("pond"),
            _("the hill"): box("hill"),
            _("the sun"): box("sun"),
        },
    )


stacks = balanced(needs=picture)
