"""The tests of the exercise light_position."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.triangles import covered

FRAMES = (0, 5)
LAMP = np.array((1.2, 3.2, 0.6, 1))
NEAR = 0.02  # chosen: units by which the light may be elsewhere


def lit(work, number):
    """Return the draws of a frame that are lit."""
    return [draw for draw in work.frame(number).draws if draw.state["GL_LIGHTING"]]


def view(work, number):
    """Return the modelview matrix of the table, (4, 4): the eye's."""
    return lit(work, number)[0].modelview


def position(draw):
    """Return the light's position in eye coordinates, (4,); its last number is 1 or 0."""
    found = np.array(draw.state["GL_LIGHT0.GL_POSITION"])
    return found / found[3] if abs(found[3]) > NEAR else found


def settings(work):
    """Return the calls that set the position."""
    return work.find("glLight", "GL_LIGHT0", "GL_POSITION")


def near(a, b):
    return np.abs(a - b).max() < NEAR


@test(
    _("The table is lit by GL_LIGHT0"),
    _("Everything but the lamp itself is drawn with light."),
)
def light(work, solution):
    for number in FRAMES:
        if not lit(work, number) or not lit(work, number)[0].state["GL_LIGHT0"]:
            return hint(_("GL_LIGHTING or GL_LIGHT0 is off while the table is drawn."))
        moved = np.linalg.inv(view(solution, number)) @ view(work, number)
        if near(moved[:3, :3], np.eye(3)) and near(moved[:3, 3], LAMP[:3]):
            return hint(
                _(
                    "The table is moved by LAMP as well: glTranslatef affects everything drawn "
                    "later, unless glPushMatrix and glPopMatrix limit it."
                )
            )
        if not near(moved, np.eye(4)):
            return hint(_("The eye has moved: change only the light."))
    return None


@test(
    _("The light is a lamp in a place, and not a direction"),
    _("The fourth number of the position is 1 for a place; with 0 it is a direction."),
    needs=light,
)
def place(work, solution):
    calls = settings(work)
    if not calls:
        others = [call for call in work.find("glLight") if call.args[1] == "GL_POSITION"]
        if others:
            return hint(
                _("Line {line} sets the position of {light}, and it is GL_LIGHT0 that is on."),
                line=others[-1].line,
                light=others[-1].args[0],
            )
        return hint(_("There is no glLightfv(GL_LIGHT0, GL_POSITION, ...) any more."))

    given = calls[-1].args[2]
    if isinstance(given, list) and len(given) < 4:
        return hint(
            _(
                "The position in line {line} has {count} numbers, and OpenGL reads four: the "
                "fourth "
                "says whether it is a place, 1, or a direction, 0."
            ),
            line=calls[-1].line,
            count=len(given),
        )

    found = position(lit(work, FRAMES[-1])[-1])
    if abs(found[3]) < NEAR:
        return hint(
            _(
                "The fourth number of the position is 0 in line {line}, so the light comes from "
                "infinitely far away: it must be 1."
            ),
            line=calls[-1].line,
        )

    return None


@test(
    _("The light comes from the lamp in every frame"),
    _(
        "glLightfv must be called in each frame, after the eye's transformation, and before "
        "that of "
        "anything else."
    ),
    needs=place,
)
def at_the_lamp(work, solution):
    calls = settings(work)
    line = calls[-1].line
    last = FRAMES[-1]
    first, later = position(lit(work, 0)[-1]), position(lit(work, last)[-1])
    wanted = {number: view(work, number) @ LAMP for number in FRAMES}
    if near(first, LAMP) and near(later, LAMP):
        if work.frame(last).find("glLight", "GL_LIGHT0", "GL_POSITION"):
            if identity := _emptied(work, calls):
                return hint(
                    _(
                        "Line {line} is called right after glLoadIdentity in line {identity}, "
                        "which "
                        "takes the eye's transformation away: so LAMP counts from the eye."
                    ),
                    line=line,
                    identity=identity,
                )
            return hint(
                _(
                    "Line {line} is called in each frame, but before the eye's transformation: "
                    "glTranslatef and glRotatef do not hold for it yet."
                ),
                line=line,
            )
        return hint(
            _(
                "Line {line} is called once, before the loop, with the modelview matrix still the "
                "identity: so LAMP counts from the eye."
            ),
            line=line,
        )

    if near(first, wanted[0]) and near(later, wanted[0]):
        return hint(
            _(
                "In the first frame it is right. But line {line} is not called again, so the light "
                "stays where the lamp was then, as seen from the eye."
            ),
            line=line,
        )

    if all(near(position(draw), wanted[n]) for n in FRAMES for draw in lit(work, n)):
        return None
    order = work.frame(last).calls
    drawn = [order.index(draw.call) for draw in lit(work, last)]
    set_at = max(order.index(call) for call in order if call in calls)
    if set_at > drawn[-1]:
        return hint(
            _(
                "Line {line} sets the position after everything has been drawn, with the light of "
                "the frame before: set it before the first thing that it shines on."
            ),
            line=line,
        )

    if set_at < drawn[0] and not _twice(work, first):
        if identity := _left_over(order[set_at : drawn[0]]):
            return hint(
                _(
                    "Line {line} is called before glLoadIdentity in line {identity}: there the "
                    "modelview matrix is still the one of the frame before."
                ),
                line=line,
                identity=identity,
            )
        inside = [np.linalg.inv(view(work, n)) @ position(lit(work, n)[-1]) for n in FRAMES]
        if near(inside[0], inside[1]):
            x, y, z, _w = np.round(inside[0], 1) + 0.0
            return hint(
                _(
                    "Line {line} is called at the right moment, but puts the light at ({x:.1f}, "
                    "{y:.1f}, {z:.1f}) of the table, and the lamp hangs at (1.2, 3.2, 0.6)."
                ),
                line=line,
                x=x,
                y=y,
                z=z,
            )
        return hint(
            _(
                "Line {line} is called while only a part of the eye's transformation holds: it "
                "must stand after the last glRotatef."
            ),
            line=line,
        )

    if _twice(work, first):
        return hint(
            _(
                "Line {line} moves the light twice: the modelview matrix is moved by LAMP already, "
                "so the position there is (0, 0, 0, 1)."
            ),
            line=line,
        )

    return hint(
        _(
            "Line {line} is called while the modelview matrix is that of a piece, or moved in "
            "another way: the light goes with it, for what is drawn later."
        ),
        line=line,
    )


def _emptied(work, calls):
    """Return the line of the glLoadIdentity that has taken the eye's transformation away, or 0."""
    moved = identity = 0
    for call in work.last.calls:
        if call.base in ("glTranslate", "glRotate"):
            moved, identity = call.line, 0
        elif call.name == "glLoadIdentity" and moved:
            identity = call.line
        elif call in calls:
            return identity
    return 0


def _left_over(calls):
    """Return the line of the last glLoadIdentity among some calls; 0 without one."""
    return next((call.line for call in calls[::-1] if call.name == "glLoadIdentity"), 0)


def _twice(work, first):
    """Return whether the light is as far from the lamp as the lamp is from the origin."""
    return near((np.linalg.inv(view(work, 0)) @ first)[:3], 2 * LAMP[:3])


def regions(solution, number):
    """Return the parts of a frame's picture."""
    height, width = solution.frame(number).picture.shape[:2]
    draws = solution.frame(number).draws
    lamp = covered([draw for draw in draws if not draw.state["GL_LIGHTING"]], height, width)
    pieces = [draw for draw in lit(solution, number) if draw.mode == "GL_QUAD_STRIP"]
    pieces = covered(pieces, height, width) & ~lamp
    return {_("the lamp"): lamp, _("the pieces"): pieces, _("the table"): ~pieces & ~lamp}


@test(
    _("The picture is right"),
    _("From two sides, the light falls from where the lamp is drawn."),
    needs=at_the_lamp,
)
def picture(work, solution):
    return compare(work, solution, regions=lambda number: regions(solution, number))
