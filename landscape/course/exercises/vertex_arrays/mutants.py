"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

DRAW = "    glDrawElements(GL_TRIANGLES, TRIANGLES.size, GL_UNSIGNED_INT, TRIANGLES)\n"
ARRAYS = "(GL_VERTEX_ARRAY, GL_NORMAL_ARRAY, GL_COLOR_ARRAY)"
COLORS = "glColorPointer(4, GL_UNSIGNED_BYTE, 0, COLORS)"
ONE_BY_ONE = """\
    glBegin(GL_TRIANGLES)
    for triangle in TRIANGLES:
        for index in triangle:
            glArrayElement(index)
    glEnd()
"""

MUTANTS = {
    "one_by_one": Mutant("takes glArrayElement", "from_arrays", [(DRAW, ONE_BY_ONE)]),
    "in_a_list": Mutant(
        "compiles immediate mode",
        "from_arrays",
        [
            (DRAW, "    glCallList(VASE)\n"),
            (
                "    while not glfw.window",
                "    global VASE\n    VASE = glGenLists(1)\n"
                "    glNewList(VASE, GL_COMPILE)\n    glBegin(GL_TRIANGLES)\n"
                "    for index in TRIANGLES.ravel():\n        glVertex3fv(VERTICES[index])\n"
                "    glEnd()\n    glEndList()\n    while not glfw.window",
            ),
        ],
    ),
    "both": Mutant(
        "leaves the old loop",
        "no_begin",
        [
            (
                DRAW,
                DRAW + ONE_BY_ONE.replace("glArrayElement(index)", "glVertex3fv(VERTICES[index])"),
            )
        ],
    ),
    "many_calls": Mutant(
        "calls it for each ring",
        "one_call",
        [
            (
                DRAW,
                "    for part in np.split(TRIANGLES, 20):\n        "
                "glDrawElements(GL_TRIANGLES, part.size, GL_UNSIGNED_INT, part)\n",
            )
        ],
    ),
    "no_vertices": Mutant(
        "does not enable the vertices",
        "enabled",
        [(ARRAYS, ARRAYS.replace("GL_VERTEX_ARRAY, ", ""))],
    ),
    "no_normals": Mutant(
        "does not enable the normals",
        "enabled",
        [(ARRAYS, ARRAYS.replace("GL_NORMAL_ARRAY, ", ""))],
    ),
    "no_colors": Mutant(
        "does not enable the colours", "enabled", [(ARRAYS, ARRAYS.replace(", GL_COLOR_ARRAY", ""))]
    ),
    "float_colors": Mutant(
        "says that colours are floats",
        "described",
        [(COLORS, COLORS.replace("GL_UNSIGNED_BYTE", "GL_FLOAT"))],
    ),
    "three_bytes": Mutant("forgets alpha", "described", [(COLORS, COLORS.replace("(4", "(3"))]),
    "stride": Mutant(
        "gives the size of a vertex in all arrays as the stride",
        "described",
        [(COLORS, COLORS.replace("0, COLORS", "16, COLORS"))],
    ),
    "other_array": Mutant(
        "takes the vertices for normals",
        "described",
        [("glNormalPointer(GL_FLOAT, 0, NORMALS)", "glNormalPointer(GL_FLOAT, 0, VERTICES)")],
    ),
    "two_coordinates": Mutant(
        "says that a vertex has two coordinates",
        "described",
        [("glVertexPointer(3", "glVertexPointer(2")],
    ),
    "triangles_counted": Mutant(
        "counts the triangles", "whole", [("TRIANGLES.size", "len(TRIANGLES)")]
    ),
    "vertices_counted": Mutant(
        "counts the vertices", "whole", [("TRIANGLES.size", "len(VERTICES)")]
    ),
    "no_indices": Mutant(
        "draws without indices",
        "whole",
        [(DRAW, "    glDrawArrays(GL_TRIANGLES, 0, len(VERTICES))\n")],
    ),
    "strip": Mutant("draws a strip", "whole", [("(GL_TRIANGLES, TRI", "(GL_TRIANGLE_STRIP, TRI")]),
    "quads": Mutant("draws quads", "whole", [("(GL_TRIANGLES, TRI", "(GL_QUADS, TRI")]),
}
