"""The tests of the exercise vertex_arrays."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.triangles import covered

FRAMES = (0, 7)
FROM_ARRAYS = (
    *("glDrawElements", "glDrawArrays", "glDrawRangeElements", "glMultiDrawElements"),
    *("glMultiDrawArrays", "glDrawElementsub", "glDrawElementsus", "glDrawElementsui"),
)
TABLE = 48  # vertices of the table
MESH, TRIANGLES = 672, 1280  # vertices and triangles of the vase


def calls(work):
    """Return the calls of the last frame that draw from arrays."""
    return [call for call in work.last.calls if call.name in FROM_ARRAYS]


def line(work, name, *first):
    """Return the line of the last call of a function; 0 without one."""
    found = work.find(name, *first)
    return found[-1].line if found else 0


@test(
    _("The vase is drawn from arrays"),
    _("glDrawElements takes the vertices from arrays, in the order of an array of indices."),
    demanded=True,
)
def from_arrays(work, solution):
    if calls(work):
        return None
    if at := line(work, "glArrayElement"):
        return hint(
            _(
                "glArrayElement in line {line} takes one vertex from the arrays: that is still a "
                "call for each corner."
            ),
            line=at,
        )

    if at := line(work, "glCallList"):
        return hint(
            _(
                "The display list of line {line} spares Python the calls, but it is made with "
                "glBegin. Here the arrays are to be drawn themselves."
            ),
            line=at,
        )

    return hint(
        _(
            "Nothing is drawn from arrays yet. glDrawElements draws from the arrays that are "
            "enabled, and takes the indices as its last argument."
        )
    )


@test(
    _("No glBegin is left for the vase"),
    _("Otherwise all the calls are still made, and the vase may be drawn twice."),
    needs=from_arrays,
    demanded=True,
)
def no_begin(work, solution):
    blocks = [draw for draw in work.last.draws if draw.call.name == "glBegin"]
    if sum(len(draw.vertices) for draw in blocks) > TABLE:
        largest = max(blocks, key=lambda draw: len(draw.vertices))
        return hint(
            _("The glBegin of line {line} still draws {count} vertices one by one."),
            line=largest.line,
            count=len(largest.vertices),
        )
    return None


@test(
    _("It is one call"),
    _("The indices of all triangles follow each other, so that one call draws them all."),
    needs=no_begin,
    demanded=True,
)
def one_call(work, solution):
    found = calls(work)
    if len(found) > 1:
        return hint(
            _(
                "{name} in line {line} is called {count} times in a frame: it can draw all "
                "triangles "
                "at once."
            ),
            name=found[0].name,
            line=found[0].line,
            count=len(found),
        )
    return None


@test(
    _("The three arrays are enabled"),
    _("OpenGL reads only arrays that are enabled; for the others it takes the current value."),
    needs=one_call,
)
def enabled(work, solution):
    state = calls(work)[0].state
    if not state:
        return None  # it is not known inside display lists

    told = {
        "GL_VERTEX_ARRAY": _(
            "glEnableClientState(GL_VERTEX_ARRAY) is missing: without vertices "
            "line {line} draws nothing."
        ),
        "GL_NORMAL_ARRAY": _(
            "GL_NORMAL_ARRAY is not enabled when line {line} draws: each vertex "
            "gets the last normal, so the vase is lit like a flat disc."
        ),
        "GL_COLOR_ARRAY": _(
            "GL_COLOR_ARRAY is not enabled when line {line} draws: each vertex "
            "gets the last colour."
        ),
    }

    for array, text in told.items():
        if not state[array]:
            return hint(text, line=calls(work)[0].line)
    return None


@test(
    _("The pointers describe the arrays"),
    _("How many numbers a vertex has, and of which type, OpenGL cannot see."),
    needs=enabled,
)
def described(work, solution):
    state = calls(work)[0].state
    if not state:
        return None  # it is not known inside display lists
    size = state["GL_VERTEX_ARRAY_SIZE"]
    if size != 3:
        return hint(
            _("Line {line} says that a vertex has {size} coordinates: in VERTICES it has 3."),
            line=line(work, "glVertexPointer"),
            size=size,
        )

    drawn = [draw for draw in work.last.draws if draw.call.name != "glBegin"]
    at = line(work, "glColorPointer")
    if drawn and len(drawn[0].colors) and drawn[0].colors.max() > 2:
        return hint(
            _(
                "The colours of line {line} go up to 255, but it says {type}, for which 1 is the "
                "full brightness: COLORS has a byte each."
            ),
            line=at,
            type=state["GL_COLOR_ARRAY_TYPE"],
        )

    kind, size, stride = (state[f"GL_COLOR_ARRAY_{word}"] for word in ("TYPE", "SIZE", "STRIDE"))
    if (kind, size, stride) == ("GL_UNSIGNED_BYTE", 3, 0) and compare(work, solution):
        return hint(
            _(
                "Line {line} says that a colour has 3 bytes. In COLORS it has 4, with alpha: "
                "so each "
                "colour begins in the one before it."
            ),
            line=at,
        )

    for array, call, packed in (
        ("GL_VERTEX_ARRAY", "glVertexPointer", 12),
        ("GL_NORMAL_ARRAY", "glNormalPointer", 12),
        ("GL_COLOR_ARRAY", "glColorPointer", 4),
    ):
        stride = state[f"{array}_STRIDE"]
        if stride not in (0, packed) and compare(work, solution):
            return hint(
                _(
                    "Line {line} says that a vertex begins {stride} bytes after the one before it. "
                    "In these arrays nothing lies between them, which is said by 0."
                ),
                line=line(work, call),
                stride=stride,
            )

    if drawn and len(drawn[0].normals):
        lengths = np.linalg.norm(drawn[0].normals, axis=1)
        if np.abs(lengths - 1).max() > 0.05:
            return hint(
                _(
                    "The array in line {line} does not hold the normals: its vectors are not of "
                    "length 1."
                ),
                line=line(work, "glNormalPointer"),
            )

    if kind == "GL_BYTE":
        return hint(
            _(
                "Line {line} says GL_BYTE, for which 127 is the full brightness and more is "
                "negative: the bytes of COLORS have no sign."
            ),
            line=at,
        )

    return None


@test(
    _("Every triangle is drawn"),
    _("The count is the number of indices: three for each triangle."),
    needs=described,
)
def whole(work, solution):
    call = calls(work)[0]
    if compare(work, solution) is None:
        return None
    mode = call.args[0]
    if mode not in ("GL_TRIANGLES", "GL_TRIANGLE_STRIP"):
        return hint(
            _("Line {line} draws {mode}, but the indices are for triangles."),
            line=call.line,
            mode=mode,
        )

    if mode == "GL_TRIANGLE_STRIP":
        return hint(
            _(
                "As a GL_TRIANGLE_STRIP, line {line} makes a triangle of each index and the two "
                "before it. But the indices are three for each triangle."
            ),
            line=call.line,
        )

    if call.name == "glDrawArrays":
        if call.args[2] <= MESH:
            return hint(
                _(
                    "glDrawArrays in line {line} takes the vertices as they follow each other. "
                    "They "
                    "lie in rings: which three make a triangle, only TRIANGLES says."
                ),
                line=call.line,
            )
        return None

    count = 3 * TRIANGLES
    if call.name == "glDrawElements":
        count = call.args[1]
    elif call.name.startswith("glDrawElements"):
        count = np.size(call.args[-1])

    if count == TRIANGLES:
        return hint(
            _(
                "The count of line {line} is {count}: that is the number of triangles, but the "
                "count is of indices, three for each. TRIANGLES.size is all of them."
            ),
            line=call.line,
            count=count,
        )

    if count == MESH:
        return hint(
            _(
                "The count of line {line} is {count}: so many vertices there are, but indices are "
                "counted. Each vertex is a corner of six triangles."
            ),
            line=call.line,
            count=count,
        )

    if count != 3 * TRIANGLES:
        return hint(
            _("Line {line} draws {count} indices, and there are {all}."),
            line=call.line,
            count=count,
            all=3 * TRIANGLES,
        )

    return None


def regions(solution, number):
    """Return the parts of a frame's picture."""
    height, width = solution.frame(number).picture.shape[:2]
    draws = solution.frame(number).draws
    vase = covered([d for d in draws if d.call.name != "glBegin"], height, width)
    return {_("the vase"): vase, _("the table and the background"): ~vase}


@test(
    _("The picture is as it was"),
    _("The vase, lit and coloured as before, and the table."),
    needs=whole,
)
def picture(work, solution):
    return compare(work, solution, regions=lambda number: regions(solution, number))
