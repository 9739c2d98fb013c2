"""The tests of the exercise planar_shadow."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.triangles import covered

FRAMES = (0, 2)
EVENTS = [{"frame": 2, "key": "RIGHT"} for _press in range(10)]
FLOOR = np.array((0.0, 1, 0, 1))
LAMPS = {0: np.array((-1.75, 3, 0.8, 1)), 2: np.array((0.75, 3, 0.8, 1))}
NEAR = 0.005  # chosen: by which a number of a matrix of length 1 may be off
SIDES = 24  # vertices of a box
COUNT = 6  # boxes of the table
PASSES = {
    "GL_NEVER": lambda ref, value: False,
    "GL_LESS": lambda ref, value: ref < value,
    "GL_EQUAL": lambda ref, value: ref == value,
    "GL_LEQUAL": lambda ref, value: ref <= value,
    "GL_GREATER": lambda ref, value: ref > value,
    "GL_NOTEQUAL": lambda ref, value: ref != value,
    "GL_GEQUAL": lambda ref, value: ref >= value,
    "GL_ALWAYS": lambda ref, value: True,
}
CHANGED = {
    "GL_KEEP": lambda ref, value: value,
    "GL_ZERO": lambda ref, value: 0,
    "GL_REPLACE": lambda ref, value: ref,
    "GL_INCR": lambda ref, value: min(value + 1, 255),
    "GL_INCR_WRAP": lambda ref, value: (value + 1) % 256,
    "GL_DECR": lambda ref, value: max(value - 1, 0),
    "GL_DECR_WRAP": lambda ref, value: (value - 1) % 256,
    "GL_INVERT": lambda ref, value: 255 - value,
}


def flattening(plane, light):
    """Return (p.l) I - l p^T."""
    return plane @ light * np.eye(4) - np.outer(light, plane)


def boxes(work, number):
    """Return the draws of a frame that are boxes."""
    return [draw for draw in work.frame(number).draws if len(draw.vertices) == SIDES]


def shadow(work, number):
    """Return the draws of the boxes that are half transparent."""
    return [draw for draw in boxes(work, number) if draw.colors[0, 3] < 1]


def view(solution, number):
    """Return the modelview matrix of the scene."""
    return boxes(solution, number)[-1].modelview


def alike(a, b):
    """Return whether two matrices are the same up to a positive factor."""
    length_a, length_b = np.linalg.norm(a), np.linalg.norm(b)
    return min(length_a, length_b) > 0 and np.abs(a / length_a - b / length_b).max() < NEAR


def line(work, *names):
    """Return the line of the last call of one of some functions in the last frame; 0 without."""
    found = [call.line for call in work.last.calls if call.base in names]
    return found[-1] if found else 0


def passes(state, value):
    """Return whether a value of the stencil buffer passes the stencil test."""
    mask = int(state["GL_STENCIL_VALUE_MASK"])
    ref = int(state["GL_STENCIL_REF"])
    return PASSES[state["GL_STENCIL_FUNC"]](ref & mask, value & mask)


def changed(state, name, value):
    """Return what a stencil operation makes of a value."""
    return CHANGED[state[name]](int(state["GL_STENCIL_REF"]), value)


@test(
    _("The table is drawn twice, once as its shadow"),
    _("The shadow is the table itself, in the colour (0, 0, 0, 0.5) and under a matrix."),
)
def twice(work, solution):
    for number in FRAMES:
        found = len(shadow(work, number)), len(boxes(work, number))
        if found != (COUNT, 2 * COUNT):
            return hint(
                _(
                    "In frame {frame} {shadow} boxes are drawn for the shadow and {whole} for the "
                    "table, and not {count} each."
                ),
                frame=number,
                shadow=found[0],
                whole=found[1] - found[0],
                count=COUNT,
            )
    return None


@test(
    _("The matrix flattens the table onto the floor, away from the lamp"),
    _("M = (p.l) I - l p^T moves each vertex along its ray of light to where p.v is 0."),
    needs=twice,
)
def flat(work, solution):
    at = line(work, "glMultMatrix", "glMultTransposeMatrix", "glLoadMatrix")
    for number in FRAMES:
        lamp, eye = LAMPS[number], view(solution, number)
        wanted = flattening(FLOOR, lamp)
        drawn = shadow(work, number)[0].modelview
        found = np.linalg.inv(eye) @ drawn
        if alike(found, wanted):
            continue
        if alike(found, np.eye(4)):
            return hint(
                _(
                    "The shadow is drawn where the table is: no matrix has been multiplied to the "
                    "modelview matrix before draw_table."
                )
            )
        if alike(drawn, wanted) or alike(drawn, wanted.T):
            return hint(
                _(
                    "Line {line} loads the matrix, and with that takes the eye's transformation "
                    "away: multiply it instead."
                ),
                line=at,
            )
        outer = np.outer(lamp, FLOOR)
        direction = np.append(lamp[:3], 0)
        told = (
            (
                wanted.T,
                _(
                    "Rows and columns of the matrix of line {line} are swapped: glMultMatrix "
                    "reads it column by column."
                ),
            ),
            (
                -wanted,
                _(
                    "All numbers of the matrix of line {line} have the wrong sign. The points "
                    "are the same, but their w is negative, and OpenGL clips them."
                ),
            ),
            (
                FLOOR @ lamp * np.eye(4) + outer,
                _("In the matrix of line {line}, l p^T is added and not subtracted."),
            ),
            (
                -outer,
                _(
                    "The matrix of line {line} has only the part - l p^T: all points meet in "
                    "the lamp. What is added on the diagonal?"
                ),
            ),
            (
                flattening(FLOOR, direction),
                _(
                    "The matrix in line {line} is for a light at infinity: the lamp's fourth "
                    "number is 1."
                ),
            ),
            (
                flattening(np.append(FLOOR[:3], 0), lamp),
                _(
                    "The matrix of line {line} flattens onto y = 0, and the floor is at y = "
                    "-1: what "
                    "is the fourth number of the plane?"
                ),
            ),
            (
                np.eye(4) - outer,
                _("In the matrix of line {line} there is 1 on the diagonal and not p.l."),
            ),
            (
                flattening(FLOOR, LAMPS[0]),
                _(
                    "In the first frame the matrix of line {line} is right."
                    " But the lamp has moved, and the shadow has not."
                ),
            ),
        )
        for matrix, text in told:
            if alike(found, matrix):
                return hint(text, line=at)
        with np.errstate(divide="ignore", invalid="ignore"):
            x, y, z, w = found @ (0, 0, 0, 1)
            place = np.array((x, y, z)) / w
        return hint(
            _(
                "In frame {frame} the shadow of the point (0, 0, 0) is at ({x:.2f}, {y:.2f}, "
                "{z:.2f}), and should be at ({a:.2f}, {b:.2f}, {c:.2f})."
            ),
            frame=number,
            x=place[0],
            y=place[1],
            z=place[2],
            **dict(
                zip("abc", (wanted @ (0, 0, 0, 1))[:3] / (wanted @ (0, 0, 0, 1))[3], strict=True)
            ),
        )

    return None


@test(
    _("Only the floor is darkened"),
    _("The stencil test must pass where draw_floor has written a 1, and fail where there is a 0."),
    needs=flat,
)
def inside(work, solution):
    at = line(work, "glStencilFunc")
    for number in FRAMES:
        for draw in shadow(work, number):
            state = draw.state
            if not state["GL_STENCIL_TEST"]:
                return hint(
                    _(
                        "GL_STENCIL_TEST is off while the shadow is drawn: it falls beside the "
                        "floor, too."
                    )
                )
            if passes(state, 0) and passes(state, 1):
                return hint(
                    _(
                        "{function} with {ref} lets 0 and 1 pass: the shadow falls beside the "
                        "floor, "
                        "too. Which function of glStencilFunc lets only 1 pass?"
                    ),
                    function=state["GL_STENCIL_FUNC"],
                    ref=state["GL_STENCIL_REF"],
                )
            if passes(state, 0):
                return hint(
                    _(
                        "The stencil test of line {line} lets 0 pass and 1 not: the shadow is "
                        "everywhere but on the floor."
                    ),
                    line=at,
                )
            if not passes(state, 1):
                return hint(
                    _(
                        "The stencil test of line {line} lets neither 0 nor 1 pass: there is no "
                        "shadow."
                    ),
                    line=at,
                )

    return None


@test(
    _("Each pixel is darkened once"),
    _(
        "Top and bottom of a box lie over each other in the shadow. The first one must change the "
        "1, so that all others fail."
    ),
    needs=inside,
)
def once(work, solution):
    at = line(work, "glStencilOp")
    for number in FRAMES:
        for draw in shadow(work, number):
            state = draw.state
            if passes(state, changed(state, "GL_STENCIL_FAIL", 0)):
                return hint(
                    _(
                        "The first operation of line {line} holds where the test has failed: it "
                        "turns the 0 beside the floor into a value that passes."
                    ),
                    line=at,
                )
            after = changed(state, "GL_STENCIL_PASS_DEPTH_PASS", 1)
            if not passes(state, after):
                continue
            if passes(state, changed(state, "GL_STENCIL_PASS_DEPTH_FAIL", 1)):
                return hint(
                    _(
                        "Where the shadow has been drawn, the stencil value stays {value}, and the "
                        "next side darkens the pixel again: which operation does glStencilOp need?"
                    ),
                    value=after,
                )
            return hint(
                _(
                    "The second operation of glStencilOp in line {line} holds where the depth test "
                    "fails. The third holds where the pixel is drawn."
                ),
                line=at,
            )

    return None


@test(
    _("After the shadow all is as before"),
    _("The table and the lamp are not cut off by the stencil test."),
    needs=once,
)
def restored(work, solution):
    for number in FRAMES:
        draws = work.frame(number).draws
        later = draws[draws.index(shadow(work, number)[-1]) + 1 :]
        if not np.allclose(later[0].modelview, view(solution, number), atol=NEAR):
            return hint(
                _(
                    "The table is flattened as well: the modelview matrix is not as it was before "
                    "draw_shadow."
                )
            )
        if any(draw.state["GL_STENCIL_TEST"] for draw in later):
            return hint(
                _(
                    "GL_STENCIL_TEST is still on after the shadow: only where the floor is "
                    "seen, and "
                    "outside of the shadow, is the table drawn."
                )
            )

    return None


def regions(solution, number):
    """Return the parts of a frame's picture."""
    height, width = solution.frame(number).picture.shape[:2]
    table = covered(boxes(solution, number)[COUNT:], height, width)
    floor = covered(
        [draw for draw in solution.frame(number).draws if draw.mode == "GL_POLYGON"], height, width
    )
    return {
        _("the table"): table,
        _("the floor"): floor & ~table,
        _("beside the floor"): ~floor & ~table,
    }


@test(
    _("The picture is right"),
    _("With the lamp in two places."),
    needs=restored,
)
def picture(work, solution):
    return compare(work, solution, regions=lambda number: regions(solution, number))
