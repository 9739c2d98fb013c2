"""The tests of the exercise shadow_map."""

import numpy as np

from landscape.course.grader.evidence import state_matrix
from landscape.course.grader.grading import _, between, compare, hint, test
from landscape.course.grader.triangles import covered

FRAMES = (0, 2)
EVENTS = [{"frame": 2, "key": "LEFT"} for _press in range(6)]
LAMPS = {0: -35.0, 2: -65.0}  # degrees
SIDES = 24  # vertices of a box
COUNT = 6  # boxes of the scene
SIZE = 256
NEAR = 0.003  # chosen: by which a number of a matrix of length 1 may be off
BIAS = np.array(((0.5, 0, 0, 0.5), (0, 0.5, 0, 0.5), (0, 0, 0.5, 0.5), (0, 0, 0, 1)))
COPIES = "glCopyTexImage2D", "glCopyTexSubImage2D"
DEPTHS = (
    "GL_DEPTH_COMPONENT",
    "GL_DEPTH_COMPONENT16",
    "GL_DEPTH_COMPONENT24",
    "GL_DEPTH_COMPONENT32",
)


def lamp_matrix(degrees):
    """Return P V of the lamp."""
    tilt, turn = np.radians(42), np.radians(-degrees)
    projection = np.zeros((4, 4))
    projection[[0, 1], [0, 1]] = 1 / 0.42
    projection[2, 2:], projection[3, 2] = (-21 / 19, -40 / 19), -1
    back = np.eye(4)
    down = np.eye(4)
    around = np.eye(4)
    back[2, 3] = -10
    down[1:3, 1:3] = (np.cos(tilt), -np.sin(tilt)), (np.sin(tilt), np.cos(tilt))
    around[::2, ::2] = (np.cos(turn), np.sin(turn)), (-np.sin(turn), np.cos(turn))
    return projection @ back @ down @ around


def boxes(work, number):
    return [draw for draw in work.frame(number).draws if len(draw.vertices) == SIDES]


def copies(work, number):
    """Return the calls that copy the frame into a texture."""
    return [call for call in work.frame(number).calls if call.name in COPIES]


def places(work, number):
    """Return the places of the frame's calls, by the number of the object."""
    return {id(call): place for place, call in enumerate(work.frame(number).calls)}


def from_lamp(work, number):
    """Return the boxes that are drawn before the last copy."""
    at = places(work, number)
    last = at[id(copies(work, number)[-1])]
    return [draw for draw in boxes(work, number) if at[id(draw.call)] < last]


def lit(work, number):
    """Return the boxes that are drawn for the camera, those with the texture last."""
    return boxes(work, number)[-2 * COUNT :]


def camera(solution, number):
    """Return the camera's projection and modelview matrices."""
    last = lit(solution, number)[-1]
    return last.projection, last.modelview


def alike(a, b):
    """Return whether two matrices are the same up to a factor."""
    length_a, length_b = np.linalg.norm(a), np.linalg.norm(b)
    if min(length_a, length_b) == 0:
        return False
    return min(np.abs(a / length_a - sign * b / length_b).max() for sign in (1, -1)) < NEAR


def line(work, *names):
    """Return the line of the last call of one of some functions; 0 without."""
    for number in reversed(FRAMES):
        found = [call.line for call in work.frame(number).calls if call.base in names]
        if found:
            return found[-1]
    return 0


def first_lit(work, number):
    return lit(work, number)[0]


@test(
    _("The depths are copied into the texture once the scene has been drawn for the lamp"),
    _("glCopyTexImage2D takes the format first, then the lower left corner and the size."),
)
def copied(work, solution):
    for number in FRAMES:
        clear = work.frame(number).find("glClear")
        if len(boxes(work, number)) <= 2 * COUNT and not copies(work, number):
            return hint(
                _(
                    "In frame {frame} the scene is drawn only for the camera. The call that "
                    "draws it for the lamp is missing {place}."
                ),
                frame=number,
                place=between(clear[0] if clear else None, first_lit(work, number)),
            )
        if not copies(work, number):
            return hint(
                _("In frame {frame} nothing is copied from the window into the texture."),
                frame=number,
            )
        copy = copies(work, number)[-1]
        if copy.name == "glCopyTexImage2D" and copy.args[2] not in DEPTHS:
            return hint(
                _(
                    "Line {line} copies into a texture of the format {format}, and that holds no "
                    "depths."
                ),
                line=copy.line,
                format=copy.args[2],
            )
        if len(from_lamp(work, number)) < COUNT:
            return hint(
                _(
                    "When line {line} copies the depths, the scene has not been drawn for the lamp "
                    "yet."
                ),
                line=copy.line,
            )
        width, height = copy.args[-3:-1] if copy.name == "glCopyTexImage2D" else copy.args[-2:]
        if (width, height) != (SIZE, SIZE):
            return hint(
                _(
                    "Line {line} copies {width} x {height} pixels, and the lamp's picture has "
                    "{size} x {size}."
                ),
                line=copy.line,
                width=width,
                height=height,
                size=SIZE,
            )

    return None


@test(
    _("The depths are those that the lamp sees"),
    _(
        "Nothing but P V of the lamp leads to its picture: neither projection nor viewing "
        "matrix of "
        "the camera is left."
    ),
    needs=copied,
)
def seen(work, solution):
    for number in FRAMES:
        wanted = lamp_matrix(LAMPS[number])
        projection, view = camera(solution, number)
        draw = from_lamp(work, number)[-1]
        found = draw.projection @ draw.modelview
        if not alike(found, wanted):
            for matrix, text in (
                (
                    wanted @ view,
                    _(
                        "While the scene is drawn for the lamp, the camera's modelview "
                        "matrix is multiplied as well."
                    ),
                ),
                (
                    projection @ wanted,
                    _(
                        "While the scene is drawn for the lamp, the camera's "
                        "projection matrix is multiplied as well."
                    ),
                ),
                (
                    projection @ view @ wanted,
                    _(
                        "look_from_lamp multiplies the camera's matrices: "
                        "which call takes them away?"
                    ),
                ),
                (
                    projection @ view,
                    _("The scene is drawn as the camera sees it, and not the lamp."),
                ),
            ):
                if alike(found, matrix):
                    return hint(text)
            return hint(
                _(
                    "In frame {frame} the matrices that the scene is drawn with for the lamp "
                    "are not "
                    "P V of look_from_lamp."
                ),
                frame=number,
            )
        viewport = [int(value) for value in draw.state["GL_VIEWPORT"]]
        if viewport != [0, 0, SIZE, SIZE]:
            return hint(
                _(
                    "While the scene is drawn for the lamp, the viewport has {width} x {height} "
                    "pixels; only a part of the lamp's picture is copied."
                ),
                width=viewport[2],
                height=viewport[3],
            )

    return None


@test(
    _("The lamp's depths are moved away from the lamp"),
    _("A texel holds one depth for a whole piece of a face; half of it lies farther away."),
    needs=seen,
)
def offset(work, solution):
    for number in FRAMES:
        for draw in from_lamp(work, number):
            state = draw.state
            if not state["GL_POLYGON_OFFSET_FILL"]:
                return hint(
                    _(
                        "GL_POLYGON_OFFSET_FILL is off while the scene is drawn for the lamp: each "
                        "face shadows itself in stripes."
                    )
                )
            if state["GL_POLYGON_OFFSET_FACTOR"] < 0 or state["GL_POLYGON_OFFSET_UNITS"] < 0:
                return hint(
                    _(
                        "glPolygonOffset in line {line} moves the faces toward the lamp: "
                        "depths grow "
                        "with the distance."
                    ),
                    line=line(work, "glPolygonOffset"),
                )
            if state["GL_POLYGON_OFFSET_FACTOR"] == 0:
                return hint(
                    _(
                        "The offset's first number is 0, so faces that are inclined to the "
                        "lamp are "
                        "moved no farther than others; see line {line}."
                    ),
                    line=line(work, "glPolygonOffset"),
                )

    return None


@test(
    _("The texture compares"),
    _("Without the comparison it gives the depths, as shades of grey."),
    needs=offset,
)
def compared(work, solution):
    calls = work.find("glTexParameter", None, "GL_TEXTURE_COMPARE_MODE")
    if not calls or calls[-1].args[-1] in ("GL_NONE", 0):
        return hint(
            _(
                "GL_TEXTURE_COMPARE_MODE of the texture is GL_NONE: it gives its depths, and r is "
                "compared with nothing."
            )
        )
    functions = work.find("glTexParameter", None, "GL_TEXTURE_COMPARE_FUNC")
    if functions and functions[-1].args[-1] not in ("GL_LEQUAL", "GL_LESS"):
        return hint(
            _(
                "Line {line} compares by {function}: surfaces that the lamp sees get 0, "
                "and are dark."
            ),
            line=functions[-1].line,
            function=functions[-1].args[-1],
        )
    return None


OF_LAMP = _("When line {line} gives the planes, the modelview matrix is still the lamp's.")


def coordinates(draw):
    """Return the matrix (4, 4) from eye coordinates to texture coordinates."""
    planes = [draw.state[f"GL_TEXTURE0.GL_{axis}.GL_EYE_PLANE"] for axis in "STRQ"]
    return state_matrix(draw.state, "GL_TEXTURE0.GL_TEXTURE_MATRIX") @ np.array(planes, float)


@test(
    _("The planes lead from the eye back to the lamp's picture"),
    _("s, t, r and q are the rows of B P V, given while the modelview matrix is the camera's."),
    needs=compared,
)
def planes(work, solution):
    at = line(work, "glTexGen")
    for number in FRAMES:
        lamp = lamp_matrix(LAMPS[number])
        wanted, view = BIAS @ lamp, camera(solution, number)[1]
        eye = coordinates(lit(work, number)[-1])
        found = eye @ view
        if alike(found, wanted):
            continue
        told = (
            (
                found,
                lamp,
                _(
                    "The planes of line {line} are the rows of P V, and s, t and r go from "
                    "-1 to 1. The texture goes from 0 to 1."
                ),
            ),
            (
                eye,
                wanted,
                _(
                    "When line {line} gives the planes, the modelview matrix is the "
                    "identity: the shadows stick to the eye."
                ),
            ),
            (eye, BIAS, OF_LAMP),
            (eye, np.eye(4), OF_LAMP),
            (
                found,
                wanted[[1, 0, 2, 3]],
                _("The planes of s and t in line {line} have changed places."),
            ),
            (
                found,
                wanted.T,
                _(
                    "The planes of line {line} are the columns of B P V and not its "
                    "rows: how does OpenGL store a matrix?"
                ),
            ),
            (
                found,
                BIAS @ lamp.T,
                _(
                    "The planes of line {line} are made of the columns of P V: glGetFloatv "
                    "gives the "
                    "matrix column by column."
                ),
            ),
            (
                found,
                BIAS @ lamp_matrix(LAMPS[0]),
                _(
                    "In the first frame the planes of line {line} are right. But the lamp has "
                    "moved, "
                    "and they have not."
                ),
            ),
        )
        for matrix, other, text in told:
            if alike(matrix, other):
                return hint(text, line=at)
        if alike(found[:3], wanted[:3]):
            return hint(
                _(
                    "s, t and r are right, but q is not: nothing divides them by the distance from "
                    "the lamp."
                )
            )
        for axis, row in enumerate("strq"):
            if not alike(found[[axis, 3]], wanted[[axis, 3]]):
                return hint(
                    _("In frame {frame} the plane of {row} is not the row of B P V."),
                    frame=number,
                    row=row,
                )

    return None


@test(
    _("Afterwards all is as before"),
    _("The camera draws into the whole window, with its own matrices, into a clear depth buffer."),
    needs=planes,
)
def restored(work, solution):
    for number in FRAMES:
        projection, view = camera(solution, number)
        last = copies(work, number)[-1]
        for draw in lit(work, number):
            state = draw.state
            if [int(value) for value in state["GL_VIEWPORT"]] != [0, 0, 640, 480]:
                return hint(
                    _(
                        "draw_lit draws into a viewport of {width} x {height} pixels: that is "
                        "still "
                        "the lamp's."
                    ),
                    width=int(state["GL_VIEWPORT"][2]),
                    height=int(state["GL_VIEWPORT"][3]),
                )
            if not np.allclose(draw.projection, projection, atol=NEAR):
                return hint(_("draw_lit draws with another projection matrix than the camera's."))
            if not np.allclose(draw.modelview, view, atol=NEAR):
                return hint(_("draw_lit draws with another modelview matrix than the camera's."))
            if not all(state["GL_COLOR_WRITEMASK"]):
                return hint(_("glColorMask still keeps draw_lit from writing its colors."))
            if not state["GL_DEPTH_WRITEMASK"]:
                return hint(_("glDepthMask still keeps draw_lit from writing its depths."))
        at = places(work, number)
        cleared = [
            call
            for call in work.frame(number).find("glClear")
            if at[id(last)] < at[id(call)] < at[id(first_lit(work, number).call)]
        ]
        if not any("DEPTH" in str(call.args) for call in cleared):
            return hint(
                _(
                    "When draw_lit begins, the depth buffer still holds the lamp's depths. The "
                    "call that clears it is missing {place}."
                ),
                place=between(last, first_lit(work, number)),
            )
        painted = any(any(draw.state["GL_COLOR_WRITEMASK"]) for draw in from_lamp(work, number))
        if painted and not any("COLOR" in str(call.args) for call in cleared):
            return hint(
                _(
                    "The lamp's picture has been drawn in color, and is still there at the lower "
                    "left of the window."
                )
            )

    return None


def regions(solution, number):
    """Return the parts of a frame's picture."""
    height, width = solution.frame(number).picture.shape[:2]
    drawn = lit(solution, number)[-COUNT:]
    things = covered(drawn[1:], height, width)
    floor = covered(drawn[:1], height, width)
    return {
        _("the things"): things,
        _("the floor"): floor & ~things,
        _("beside the floor"): ~floor & ~things,
    }


@test(
    _("The picture is right"),
    _("With the lamp in two places."),
    needs=restored,
)
def picture(work, solution):
    return compare(work, solution, regions=lambda number: regions(solution, number))
