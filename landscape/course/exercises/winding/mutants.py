"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

CULL = "    glEnable(GL_CULL_FACE)\n"

MUTANTS = {
    "no_culling": Mutant("turns culling off", "culled", [(CULL, "")]),
    "other_front": Mutant(
        "declares the other side to be the front",
        "front",
        [(CULL, CULL + "    glFrontFace(GL_CW)\n")],
    ),
    "cull_front": Mutant(
        "culls the front faces", "front", [(CULL, CULL + "    glCullFace(GL_FRONT)\n")]
    ),
    "front_by_face": Mutant(
        "makes the clockwise side the front of the wrong faces",
        "front",
        [
            ("(CREAM, TOP, 2, 3)", "(CREAM, TOP, 3, 2)"),
            (
                "    glBegin(GL_TRIANGLES)\n    for color, *face in FACES:\n",
                "    for color, *face in FACES:\n"
                "        glFrontFace(GL_CW if face == [TOP, 3, 2] else GL_CCW)\n"
                "        glBegin(GL_TRIANGLES)\n",
            ),
            ("(*point(number))\n    glEnd()\n", "(*point(number))\n        glEnd()\n"),
        ],
    ),
    "left_out": Mutant("leaves a wrong face out", "twelve", [(" (CREAM, TOP, 2, 3),", "")]),
    "both_orders": Mutant(
        "lists the wrong faces in both orders",
        "twelve",
        [("(CREAM, TOP, 2, 3),", "(CREAM, TOP, 2, 3), (CREAM, TOP, 3, 2),")],
    ),
    "no_face": Mutant(
        "names a point that the face does not have",
        "twelve",
        [("(CREAM, TOP, 2, 3)", "(CREAM, TOP, 2, 4)")],
    ),
    "four_corners": Mutant(
        "lists a fourth corner", "twelve", [("(CREAM, TOP, 2, 3)", "(CREAM, TOP, 2, 3, 4)")]
    ),
    "other_face": Mutant(
        "lists another face in its place", "twelve", [("(BLUE, BOTTOM, 5, 4)", "(BLUE, TOP, 4, 5)")]
    ),
    "begun_elsewhere": Mutant(
        "begins a wrong face at another corner",
        "order",
        [("(CREAM, TOP, 2, 3)", "(CREAM, 3, 2, TOP)")],
    ),
    "one_of_two": Mutant(
        "finds one of the two", "order", [("(BLUE, BOTTOM, 5, 4)", "(BLUE, BOTTOM, 4, 5)")]
    ),
    "other_half": Mutant(
        "lists the lower faces like the upper ones",
        "order",
        [
            ("(RED, BOTTOM, 1, 0)", "(RED, BOTTOM, 0, 1)"),
            ("(ORANGE, BOTTOM, 2, 1)", "(ORANGE, BOTTOM, 1, 2)"),
            ("(CREAM, BOTTOM, 3, 2)", "(CREAM, BOTTOM, 2, 3)"),
            ("(GREEN, BOTTOM, 4, 3)", "(GREEN, BOTTOM, 3, 4)"),
            ("(BLUE, BOTTOM, 5, 4)", "(BLUE, BOTTOM, 4, 5)"),
            ("(VIOLET, BOTTOM, 0, 5)", "(VIOLET, BOTTOM, 5, 0)"),
        ],
    ),
    "wrong_ones": Mutant(
        "turns two other faces round as well",
        "order",
        [
            ("(RED, TOP, 0, 1)", "(RED, TOP, 1, 0)"),
            ("(ORANGE, TOP, 1, 2)", "(ORANGE, TOP, 2, 1)"),
            ("(CREAM, TOP, 2, 3)", "(CREAM, TOP, 3, 2)"),
        ],
    ),
    "another_one": Mutant(
        "turns another face round", "order", [("(GREEN, TOP, 3, 4)", "(GREEN, TOP, 4, 3)")]
    ),
    "other_colors": Mutant(
        "sorts the colours",
        "picture",
        [("(RED, TOP, 0, 1)", "(ORANGE, TOP, 0, 1)"), ("(ORANGE, TOP, 1, 2)", "(RED, TOP, 1, 2)")],
    ),
    "mirrored": Mutant(
        "mirrors the gem",
        "picture",
        [
            (
                "        glRotatef(18, 1, 0, 0)\n",
                "        glScalef(1, 1, -1)\n        glRotatef(18, 1, 0, 0)\n",
            )
        ],
    ),
}
