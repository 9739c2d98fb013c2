"""The tests of the exercise first_drawing."""

import numpy as np

from landscape.course.grader.grading import _, between, compare, hint, test
from landscape.course.grader.mistakes import balanced, followed

FRAMES = (0, 1)
HULL = np.array(((-0.6, -0.3), (0.6, -0.3), (0.4, -0.6), (-0.4, -0.6)))
SAIL = np.array(((0.05, -0.25), (0.05, 0.75), (0.6, -0.25)))
PENNANT = np.array(((0.05, 0.78), (0.05, 0.92), (-0.25, 0.85)))
COLORS = np.array(((0.95, 0.9, 0.8), (0.85, 0.35, 0.2), (0.3, 0.5, 0.8)))
SEA = (0.2, 0.42, 0.5)
BOXES = {
    "hull": (0.15, 0.64, 0.85, 0.82),
    "sail": (0.5, 0.1, 0.85, 0.635),
    "pennant": (0.35, 0.02, 0.55, 0.12),
}
LINES = ("GL_LINES", "GL_LINE_LOOP", "GL_LINE_STRIP")
PENNANT_COLOR = np.array((0.95, 0.62, 0.35))
NEAR = 0.01  # chosen: by which a corner may be elsewhere


def right(work, solution, part):
    part_right = compare(work, solution, box=BOXES[part], most=0.01) is None
    return part_right or not followed(work)


def places(draw):
    """Return where the vertices of a draw are in the window, (n, 2), from -1 to 1."""
    width, height = draw.state["GL_VIEWPORT"][2:]
    return draw.window / (width, height) * 2 - 1


def near(points, point):
    return bool(len(points)) and bool((np.abs(points - point).max(axis=1) < NEAR).any())


def of(work, corners):
    """Return the first draw that has all of some corners, or None."""
    for draw in work.frame(0).draws:
        if all(near(places(draw), corner) for corner in corners):
            return draw
    return None


def lacking(work, corners):
    """Return the first corner that no draw has, or None."""
    for corner in corners:
        if not any(near(places(draw), corner) for draw in work.frame(0).draws):
            return corner
    return None


def around(draw):
    """Return whether the first vertices of a draw go around the hull."""
    apart = np.abs(places(draw)[:4, None] - HULL).max(axis=-1).argmin(axis=1)
    return all(step % 4 in (1, 3) for step in np.diff(apart))


def elsewhere(work):
    """Return the hint for a hull whose coordinates are all changed in the same way, or None."""
    changes = (
        (
            HULL * (1, -1),
            _(
                "The hull hangs in the sky, upside down: y grows upwards, and everything below "
                "the middle has a negative y."
            ),
        ),
        (
            HULL[:, ::-1],
            _(
                "The hull stands at the left, on its side: a vertex begins with x, to the right, "
                "and y follows."
            ),
        ),
        (
            HULL * (150, -150) + 150,
            _(
                "The hull is far outside of the window: its corners are not counted in pixels, but "
                "from -1 to 1."
            ),
        ),
        (
            HULL / 2 + 0.5,
            _(
                "The hull is too small, and too far up and to the right: 0 is not the border of "
                "the window, but its middle."
            ),
        ),
    )

    for corners, text in changes:
        if of(work, corners):
            return hint(text)
    return None


@test(
    _("The hull has its shape and its colour"),
    _("Four corners, one after the other around it, and a colour that is set before them."),
)
def hull(work, solution):
    if right(work, solution, "hull"):
        return None
    draw = of(work, HULL)
    if not draw:
        if told := elsewhere(work):
            return told
        corner = lacking(work, HULL)
        if corner is None or len(work.frame(0).draws) == 0:
            return hint(_("There is no hull yet: draw_hull draws nothing."))
        if all(lacking(work, [each]) is not None for each in HULL):
            return hint(_("Nothing is drawn where the hull should be, nor with its corners."))
        return hint(
            _("No vertex of the hull is at ({x:.1f}, {y:.1f}): is it the sign?"),
            x=corner[0],
            y=corner[1],
        )

    if draw.mode in LINES:
        return hint(
            _("The hull is only an outline: line {line} asks for {mode}, and not for a face."),
            line=draw.line,
            mode=draw.mode,
        )

    if draw.mode == "GL_TRIANGLES" and len(draw.vertices) == 4:
        return hint(
            _(
                "A corner of the hull is missing: GL_TRIANGLES in line {line} takes three vertices "
                "for each triangle, and the fourth one is left over."
            ),
            line=draw.line,
        )

    color = draw.colors[0, :3]
    if color.max() > 2:
        return hint(
            _(
                "The hull is white. The full brightness of a channel is 1 for glColor3f, and more "
                "than that looks the same; these numbers are made for 255."
            )
        )

    if np.abs(color - SEA).max() < NEAR:
        return hint(
            _(
                "The hull has the colour of the sea: that is the one which was set last before "
                "line {line}. Set its own before its vertices."
            ),
            line=draw.line,
        )

    if np.abs(color - (0.55, 0.33, 0.2)).max() > NEAR:
        return hint(
            _(
                "The hull has the colour {red:.2f}, {green:.2f}, {blue:.2f}, and not 0.55, 0.33, "
                "0.2."
            ),
            red=color[0],
            green=color[1],
            blue=color[2],
        )

    if draw.mode == "GL_TRIANGLE_STRIP" and around(draw):
        return hint(
            _(
                "The hull has a notch. A GL_TRIANGLE_STRIP, as in line {line}, goes in zigzag from "
                "side to side; these corners go around."
            ),
            line=draw.line,
        )

    if draw.mode in ("GL_QUADS", "GL_POLYGON") and not around(draw):
        return hint(
            _(
                "The sides of the hull cross each other. Its corners are right, but they must come "
                "in the order in which one meets them going around it."
            )
        )

    return None


@test(
    _("The sail has its shape and its three colours"),
    _("Each vertex takes the colour that is set when the vertex is given."),
    needs=hull,
)
def sail(work, solution):
    if right(work, solution, "sail"):
        return None
    draw = of(work, SAIL)
    if not draw:
        corner = lacking(work, SAIL)
        if corner is None or all(lacking(work, [each]) is not None for each in SAIL):
            return hint(_("There is no sail yet: draw_sail draws nothing of it."))
        return hint(_("The sail has no corner at ({x:.2f}, {y:.2f})."), x=corner[0], y=corner[1])

    if draw.mode == "GL_QUADS":
        return hint(
            _(
                "The sail cannot be seen: GL_QUADS in line {line} takes four vertices for each "
                "quad, and the sail has three."
            ),
            line=draw.line,
        )

    if draw.mode in LINES:
        return hint(
            _("The sail has no cloth: with {mode} in line {line}, only lines join its corners."),
            mode=draw.mode,
            line=draw.line,
        )

    if draw.state["GL_SHADE_MODEL"] == "GL_FLAT":
        return hint(
            _(
                "The sail has a single colour though its vertices have three: "
                "glShadeModel(GL_FLAT) takes the last one's colour for the whole face."
            )
        )

    points = places(draw)
    given = np.array(
        [draw.colors[np.abs(points - corner).max(axis=1).argmin(), :3] for corner in SAIL]
    )
    if np.abs(given - given[0]).max() < NEAR:
        return hint(
            _(
                "The sail has a single colour: the colour of its first vertex stays current "
                "until another one is set."
            )
        )

    if np.abs(given[1:] - COLORS[:-1]).max() < NEAR:
        return hint(
            _(
                "Each vertex of the sail has the colour that was meant for the one before it: "
                "glColor must come before its glVertex."
            )
        )

    wrong = int(np.abs(given - COLORS).max(axis=1).argmax())
    if np.abs(given - COLORS).max() > NEAR:
        return hint(
            _(
                "The corner of the sail at ({x:.2f}, {y:.2f}) has the colour {red:.2f}, "
                "{green:.2f}, {blue:.2f}, which is not its own."
            ),
            x=SAIL[wrong, 0],
            y=SAIL[wrong, 1],
            red=given[wrong, 0],
            green=given[wrong, 1],
            blue=given[wrong, 2],
        )

    return None


@test(
    _("The pennant has its shape and its colour"),
    _("The colour set before stays current until another one is set."),
    needs=sail,
)
def pennant(work, solution):
    if right(work, solution, "pennant"):
        return None
    draw = of(work, PENNANT)
    if not draw:
        corner = lacking(work, PENNANT)
        if corner is None or all(lacking(work, [each]) is not None for each in PENNANT):
            ends = work.frame(0).find("glEnd")
            if ends:
                return hint(_("There is no pennant yet, {place}."), place=between(ends[-1], None))
            return hint(_("There is no pennant yet: draw_pennant draws nothing."))
        return hint(_("The pennant has no corner at ({x:.2f}, {y:.2f})."), x=corner[0], y=corner[1])

    if draw.mode in (*LINES, "GL_POINTS"):
        return hint(
            _(
                "The pennant has no face: {mode} in line {line} draws only points or lines at "
                "its corners."
            ),
            mode=draw.mode,
            line=draw.line,
        )

    color = draw.colors[0, :3]
    if np.abs(color - COLORS).max(axis=1).min() < NEAR:
        return hint(
            _("The pennant has the colour of a corner of the sail: no other one was set since.")
        )
    if np.abs(draw.colors[:, :3] - color).max() < NEAR < np.abs(color - PENNANT_COLOR).max():
        return hint(
            _("The pennant is {red:.2f} red, {green:.2f} green, {blue:.2f} blue."),
            red=color[0],
            green=color[1],
            blue=color[2],
        )
    return None


@test(
    _("The picture is right"),
    _("The boat on the sea, and nothing else."),
    needs=pennant,
)
def picture(work, solution):
    return compare(
        work,
        solution,
        regions={
            _("the hull"): BOXES["hull"],
            _("the sail"): BOXES["sail"],
            _("the pennant"): BOXES["pennant"],
        },
    )


stacks = balanced(needs=picture)
