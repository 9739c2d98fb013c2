"""The tests of the exercise light_position."""

import numpy as np

from landscape.course.grading import _, compare, hint, test

FRAMES = (0, 15)
LAMP = np.array((1.2, 3.2, 0.6, 1))
NEAR = 0.02  # chosen: units by which the light may be elsewhere


def lit(work, number):
    """Return the draws of a frame that are lit."""
    return [draw for draw in work.frame(number).draws if draw.state["GL_LIGHTING"]]


def view(work, number):
    """Return the modelview matrix of the table, (4, 4): the eye's."""
    return lit(work, number)[0].modelview


def position(draw):
    return np.array(draw.state["GL_LIGHT0.GL_POSITION"])


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
        if not near(view(work, number), view(solution, number)):
            return hint(_("The eye is elsewhere than before: only the light is to be changed."))
    return None


@test(
    _("The light is a lamp in a place, and not a direction"),
    _("The fourth number of the position is 1 for a place; with 0 it is a direction."),
    needs=light,
)
def place(work, solution):
    found = position(lit(work, FRAMES[-1])[-1])
    if abs(found[3]) < NEAR:
        return hint(
            _("The fourth number of the position is 0 in line {line}, so the light comes from "
              "infinitely far away: it must be 1."),
            line=(work.find("glLight", "GL_LIGHT0", "GL_POSITION") or work.frame(0).top)[-1].line,
        )  # fmt: skip
    return None


@test(
    _("The light comes from the lamp in every frame"),
    _("glLightfv must be called in each frame, after the eye's transformation, and before that of "
      "anything else."),
    needs=place,
)  # fmt: skip
def at_the_lamp(work, solution):
    calls = work.find("glLight", "GL_LIGHT0", "GL_POSITION")
    if not calls:
        return hint(_("There is no glLightfv(GL_LIGHT0, GL_POSITION, ...) any more."))
    line = calls[-1].line
    last = FRAMES[-1]
    first, later = position(lit(work, 0)[-1]), position(lit(work, last)[-1])
    wanted = {number: view(work, number) @ LAMP for number in FRAMES}
    if near(first, LAMP) and near(later, LAMP):
        if work.frame(last).find("glLight", "GL_LIGHT0", "GL_POSITION"):
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


def _twice(work, first):
    """Return whether the light is as far from the lamp as the lamp is from the origin."""
    return near((np.linalg.inv(view(work, 0)) @ first)[:3], 2 * LAMP[:3])


@test(
    _("The picture is right"),
    _("From two sides, the light falls from where the lamp is drawn."),
    needs=at_the_lamp,
)
def picture(work, solution):
    return compare(work, solution)
