"""The tests of the exercise stencil_mirror."""

import numpy as np

from landscape.course.grader.grading import _, between, compare, hint, test
from landscape.course.grader.triangles import covered

FRAMES = (0, 2)
EVENTS = [{"frame": 2, "key": "LEFT"} for _press in range(4)]
RADIUS, CENTER = 1.3, 1.4  # of the glass
NEAR = 0.01  # chosen: by which a number may be off
STENCIL = 0x400  # GL_STENCIL_BUFFER_BIT


def is_image(draw):
    """Return whether a draw is mirrored."""
    return len(draw.vertices) > 0 and np.linalg.det(draw.modelview[:3, :3]) < 0


def is_glass(draw):
    """Return whether a draw is the disc of the glass, whatever it is made of."""
    if not len(draw.vertices) or is_image(draw):
        return False
    x, y, z = draw.vertices[:, :3].T
    spread = max(abs(x.max() - RADIUS), abs(y.max() - CENTER - RADIUS), abs(z).max())
    return spread < NEAR


def images(work, number):
    return [draw for draw in work.frame(number).draws if is_image(draw)]


def marks(work, number):
    """Return the draws of the glass before the image."""
    draws = work.frame(number).draws
    first = next((index for index, draw in enumerate(draws) if is_image(draw)), 0)
    return [draw for draw in draws[:first] if is_glass(draw)]


def later(work, number):
    draws = work.frame(number).draws
    last = max(index for index, draw in enumerate(draws) if is_image(draw))
    return draws[last + 1 :]


def line(work, number, name, draw):
    """Return the line of the last call of a function before a draw; 0 without one."""
    found = 0
    for call in work.frame(number).calls:
        if call is draw.call:
            break
        if call.is_(name):
            found = call.line
    return found


def passes(state, value):
    """Return whether the stencil test passes where the buffer holds a value."""
    mask = state["GL_STENCIL_VALUE_MASK"] & 255
    one, two = state["GL_STENCIL_REF"] & mask, value & mask
    return {
        "GL_NEVER": False,
        "GL_ALWAYS": True,
        "GL_EQUAL": one == two,
        "GL_NOTEQUAL": one != two,
        "GL_LESS": one < two,
        "GL_LEQUAL": one <= two,
        "GL_GREATER": one > two,
        "GL_GEQUAL": one >= two,
    }[state["GL_STENCIL_FUNC"]]


def written(state, value):
    """Return what becomes of a value of the stencil buffer where the glass is drawn."""
    operation = state["GL_STENCIL_FAIL"]
    if passes(state, value):
        operation = state["GL_STENCIL_PASS_DEPTH_PASS"]
    mask = state["GL_STENCIL_WRITEMASK"] & 255
    new = {
        "GL_KEEP": value,
        "GL_ZERO": 0,
        "GL_REPLACE": state["GL_STENCIL_REF"],
        "GL_INCR": min(value + 1, 255),
        "GL_DECR": max(value - 1, 0),
        "GL_INVERT": ~value,
        "GL_INCR_WRAP": value + 1,
        "GL_DECR_WRAP": value - 1,
    }[operation]
    return (value & ~mask) | (new & mask & 255)


def cleared(work, number):
    """Return the value that the stencil buffer is cleared with, before the glass; else None."""
    first = marks(work, number)[0].call if marks(work, number) else None
    for call in work.frame(number).calls:
        if call is first:
            break
        if call.is_("glClear") and "GL_STENCIL_BUFFER_BIT" in str(call.args):
            values = work.find("glClearStencil")
            return int(values[0].args[0]) & 255 if values else 0
    return None


@test(
    _("The glass is drawn before the image, too"),
    _("The stencil buffer is written by drawing: draw the mirror itself to mark it."),
)
def drawn(work, solution):
    for number in FRAMES:
        if not images(work, number):
            return hint(_("The image is not drawn any more: draw_image does that."))
        if not marks(work, number):
            if images(work, number)[0].state["GL_STENCIL_TEST"]:
                return hint(
                    _(
                        "The stencil test is on while the image is drawn, but no glass has been "
                        "drawn before it, and so there is no mark to compare with."
                    )
                )
            return hint(
                _(
                    "When the image is drawn, nothing has marked the glass: draw_glass does "
                    "not come "
                    "until afterwards."
                )
            )

    return None


@test(
    _("The glass marks its pixels"),
    _("glStencilFunc gives the value and the test, glStencilOp what to write."),
    needs=drawn,
)
def marked(work, solution):
    for number in FRAMES:
        glass = marks(work, number)[0]
        state = glass.state
        if not state["GL_STENCIL_TEST"]:
            return hint(
                _(
                    "GL_STENCIL_TEST is not enabled when the glass of line {line} is drawn: "
                    "without "
                    "the test nothing is written either."
                ),
                line=line_of(glass),
            )
        before = cleared(work, number) or 0
        if written(state, before) == before:
            if not passes(state, before) and state["GL_STENCIL_FAIL"] == "GL_KEEP":
                return hint(
                    _(
                        "The glass fails the stencil test everywhere, and for that glStencilOp in "
                        "line {line} says GL_KEEP: look at the order of its three arguments."
                    ),
                    line=line(work, number, "glStencilOp", glass),
                )
            if state["GL_STENCIL_PASS_DEPTH_PASS"] == "GL_REPLACE":
                return hint(
                    _(
                        "glStencilFunc gives {value} to be written, the value that the stencil "
                        "buffer holds anyway."
                    ),
                    value=before,
                )
            return hint(
                _(
                    "The stencil buffer keeps its value where the glass is drawn: for passed "
                    "tests, glStencilOp must say something other than GL_KEEP."
                )
            )

    return None


def line_of(draw):
    way = draw.call.way
    return way[-2][0] if len(way) > 1 else draw.line


@test(
    _("Nothing of the marking is seen"),
    _("Neither colors nor depths are written: the image is behind the glass."),
    needs=marked,
)
def unseen(work, solution):
    for number in FRAMES:
        for glass in marks(work, number):
            state = glass.state
            if not passes(state, cleared(work, number) or 0):
                continue  # nothing of it is drawn
            if state["GL_DEPTH_WRITEMASK"] and state["GL_DEPTH_TEST"]:
                return hint(
                    _(
                        "The glass of line {line} writes its depth as well: the image is "
                        "behind it, "
                        "and fails the depth test."
                    ),
                    line=line_of(glass),
                )
            if any(state["GL_COLOR_WRITEMASK"]):
                return hint(
                    _(
                        "The glass of line {line} is drawn in color, and then once more over the "
                        "image: it is darker than it should be around the image."
                    ),
                    line=line_of(glass),
                )

    return None


@test(
    _("The image is drawn where the marks are, and only there"),
    _("For that another stencil test is needed than for the marking."),
    needs=unseen,
)
def inside(work, solution):
    for number in FRAMES:
        before = cleared(work, number) or 0
        mark = written(marks(work, number)[0].state, before)
        for draw in images(work, number):
            state = draw.state
            if not state["GL_STENCIL_TEST"]:
                return hint(_("GL_STENCIL_TEST is off already while the image is drawn."))
            if not any(state["GL_COLOR_WRITEMASK"]):
                return hint(
                    _(
                        "While the image is drawn, no color is written: glColorMask is still as it "
                        "was for the marking."
                    )
                )
            if not state["GL_DEPTH_WRITEMASK"]:
                return hint(
                    _(
                        "While the image is drawn, no depth is written: later things cover "
                        "earlier ones even where they are farther away."
                    )
                )
            in_glass, beside = passes(state, mark), passes(state, before)
            if in_glass and beside:
                return hint(
                    _(
                        "The image passes the stencil test beside the glass as well: while it is "
                        "drawn, the function is {function}."
                    ),
                    function=state["GL_STENCIL_FUNC"],
                )
            if beside:
                return hint(
                    _(
                        "The image is drawn where the marks are not: {function} in line {line} is "
                        "the opposite."
                    ),
                    function=state["GL_STENCIL_FUNC"],
                    line=line(work, number, "glStencilFunc", draw),
                )
            if not in_glass:
                return hint(
                    _(
                        "The image passes the stencil test nowhere: the glass has written {mark}, "
                        "and line {line} asks for something else."
                    ),
                    mark=mark,
                    line=line(work, number, "glStencilFunc", draw),
                )
            if written(state, mark) != mark:
                return hint(
                    _(
                        "The image changes the marks that it should respect: the first thing "
                        "drawn stays, and the rest fails the test. See glStencilOp in line "
                        "{line}."
                    ),
                    line=line(work, number, "glStencilOp", draw),
                )

    return None


@test(
    _("The marks are cleared in every frame"),
    _("The stencil buffer is kept from frame to frame, as the others are."),
    needs=inside,
)
def fresh(work, solution):
    for number in FRAMES:
        if cleared(work, number) is None:
            clear, first = work.frame(number).find("glClear"), marks(work, number)[0]
            return hint(
                _(
                    "The stencil buffer is not cleared before the glass marks it: when the eye "
                    "moves, the old marks are still there. The call that clears it may stand "
                    "{place}."
                ),
                place=between(clear[0] if clear else None, first),
            )
    return None


@test(
    _("Everything drawn later is drawn as before"),
    _("Stencil test, masks and matrix are as they were."),
    needs=fresh,
)
def restored(work, solution):
    for number in FRAMES:
        for draw in later(work, number):
            state = draw.state
            if state["GL_STENCIL_TEST"]:
                return hint(
                    _(
                        "After the image the stencil test is still enabled: things and board "
                        "are cut "
                        "off at the glass, too."
                    )
                )
            if not all(state["GL_COLOR_WRITEMASK"]) or not state["GL_DEPTH_WRITEMASK"]:
                return hint(
                    _(
                        "After the image glColorMask or glDepthMask still keeps something from "
                        "being "
                        "written."
                    )
                )

    return None


def regions(solution, number):
    """Return the parts of a frame's picture."""
    height, width = solution.frame(number).picture.shape[:2]
    draws = later(solution, number)
    glass = covered([draw for draw in draws if is_glass(draw)], height, width)
    things = covered([draw for draw in draws if draw.mode == "GL_QUAD_STRIP"], height, width)
    return {
        _("in the glass"): glass & ~things,
        _("the things and the frame"): things,
        _("beside the mirror"): ~glass & ~things,
    }


@test(
    _("The picture is right"),
    _("From two sides."),
    needs=restored,
)
def picture(work, solution):
    return compare(work, solution, regions=lambda number: regions(solution, number))
