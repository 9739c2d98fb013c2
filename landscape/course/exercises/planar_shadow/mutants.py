"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

ROWS = "(i == j) * dot - lamp[i] * FLOOR[j]"
MATRIX = f"    glMultMatrixf([[{ROWS} for i in range(4)] for j in range(4)])\n"
DOT = "    dot = sum(a * b for a, b in zip(FLOOR, lamp))\n"
ENABLE = "    glEnable(GL_STENCIL_TEST)\n    glStencilFunc(GL_EQUAL, 1, 1)\n"
TEST = "    glStencilFunc(GL_EQUAL, 1, 1)\n"
ONCE = "    glStencilOp(GL_KEEP, GL_KEEP, GL_ZERO)\n"
DISABLE = "    draw_table(False)\n    glDisable(GL_STENCIL_TEST)\n"
FIXED = "    light = (-1.75, 3, 0.8, 1)\n" + DOT.replace("lamp", "light")

MUTANTS = {
    "transposed": Mutant(
        "gives the matrix row by row",
        "flat",
        [(MATRIX, MATRIX.replace("glMultMatrixf", "glMultTransposeMatrixf"))],
    ),
    "loaded": Mutant(
        "loads the matrix", "flat", [(MATRIX, MATRIX.replace("glMultMatrixf", "glLoadMatrixf"))]
    ),
    "sign": Mutant(
        "subtracts the other way round",
        "flat",
        [("(i == j) * dot - lamp[i] * FLOOR[j]", "lamp[i] * FLOOR[j] - (i == j) * dot")],
    ),
    "plus": Mutant("adds l p^T", "flat", [("dot - lamp[i]", "dot + lamp[i]")]),
    "without_dot": Mutant("forgets (p.l) I", "flat", [("(i == j) * dot - lamp[i]", "-lamp[i]")]),
    "ones": Mutant("has ones on the diagonal", "flat", [("(i == j) * dot -", "(i == j) -")]),
    "direction": Mutant(
        "takes the lamp as a direction",
        "flat",
        [
            (DOT, "    light = lamp[:3] + [0]\n" + DOT.replace("lamp", "light")),
            (MATRIX, MATRIX.replace("lamp", "light")),
        ],
    ),
    "at_zero": Mutant(
        "forgets the plane's fourth number",
        "flat",
        [
            (DOT, "    plane = FLOOR[:3] + (0,)\n" + DOT.replace("FLOOR", "plane")),
            (MATRIX, MATRIX.replace("FLOOR", "plane")),
        ],
    ),
    "lamp_fixed": Mutant(
        "writes the lamp's place in numbers",
        "flat",
        [(DOT, FIXED), (MATRIX, MATRIX.replace("lamp", "light"))],
    ),
    "scaled": Mutant(
        "flattens straight down",
        "flat",
        [(MATRIX, "    glTranslatef(0, -1, 0)\n    glScalef(1, 0, 1)\n")],
    ),
    "no_stencil": Mutant("forgets the stencil test", "inside", [(ENABLE, TEST)]),
    "always": Mutant("lets all pass", "inside", [(TEST, TEST.replace("EQUAL", "ALWAYS"))]),
    "zero": Mutant("compares with 0", "inside", [(TEST, TEST.replace("1, 1", "0, 1"))]),
    "two": Mutant("compares with 2", "inside", [(TEST, TEST.replace("1, 1", "2, 3"))]),
    "kept": Mutant("keeps the mark", "once", [(ONCE, "")]),
    "replaced": Mutant(
        "turns zeros into ones",
        "once",
        [(ONCE, ONCE.replace("GL_KEEP, GL_KEEP, GL_ZERO", "GL_REPLACE, GL_KEEP, GL_ZERO"))],
    ),
    "second": Mutant(
        "changes where the depth test fails",
        "once",
        [(ONCE, ONCE.replace("GL_KEEP, GL_ZERO", "GL_ZERO, GL_KEEP"))],
    ),
    "left_on": Mutant("leaves the test on", "restored", [(DISABLE, "    draw_table(False)\n")]),
}
