"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

ABOVE = "*((3, 0, 4), (0, 1, 4), (1, 2, 4), (2, 3, 4)),"
BELOW = "*((0, 3, 5), (1, 0, 5), (2, 1, 5), (3, 2, 5)),"
FACES = f"FACES = (\n    {ABOVE}\n    {BELOW}\n)\n"
BEGIN = "glBegin(GL_TRIANGLES)"
COLOR = "        glColor3f(*color_of(corners))\n"
LOOP = "    for face in FACES:\n"
DRAW = """\
        for corner in corners:
            glVertex3f(*corner)
    glEnd()
"""

MUTANTS = {
    "from_one": Mutant(
        "counts the corners from 1",
        "corners",
        [("[VERTICES[number] for number in face]", "[VERTICES[number - 1] for number in face]")],
    ),
    "through": Mutant("takes two opposite corners", "corners", [("(0, 1, 4)", "(0, 2, 4)")]),
    "degenerate": Mutant("takes a corner twice", "corners", [("(1, 2, 4)", "(1, 1, 4)")]),
    "in_order": Mutant(
        "draws the table of vertices",
        "corners",
        [(LOOP, "    for face in ((0, 1, 2), (3, 4, 5)):\n")],
    ),
    "strip": Mutant("draws one strip", "corners", [(BEGIN, "glBegin(GL_TRIANGLE_STRIP)")]),
    "polygon": Mutant("draws one polygon", "corners", [(BEGIN, "glBegin(GL_POLYGON)")]),
    "lines": Mutant("draws outlines", "corners", [(BEGIN, "glBegin(GL_LINE_STRIP)")]),
    "only_above": Mutant("lists the upper half", "all_faces", [(BELOW, "")]),
    "one_missing": Mutant("forgets a face", "all_faces", [("(2, 3, 4)", "(1, 2, 4)")]),
    "last_missing": Mutant(
        "stops before the last face", "all_faces", [(LOOP, "    for face in FACES[:-1]:\n")]
    ),
    "one_left_out": Mutant("leaves a face out of the table", "all_faces", [("(2, 1, 5), ", "")]),
    "one_clockwise": Mutant("lists a face clockwise", "order", [("(3, 2, 5)", "(2, 3, 5)")]),
    "below_alike": Mutant(
        "lists the lower half as the upper one",
        "order",
        [(BELOW, "*((3, 0, 5), (0, 1, 5), (1, 2, 5), (2, 3, 5)),")],
    ),
    "all_clockwise": Mutant(
        "lists all faces clockwise",
        "order",
        [(DRAW, DRAW.replace("in corners", "in corners[::-1]"))],
    ),
    "two_clockwise": Mutant(
        "lists some faces clockwise", "order", [("(0, 1, 4), (1, 2, 4)", "(1, 0, 4), (2, 1, 4)")]
    ),
    "no_color": Mutant("sets no colour", "picture", [(COLOR, "")]),
    "color_late": Mutant(
        "sets the color behind the vertices",
        "picture",
        [(COLOR + DRAW, DRAW.replace("    glEnd()\n", COLOR + "    glEnd()\n"))],
    ),
    "one_color": Mutant(
        "sets the first color only",
        "picture",
        [(COLOR, "        if face == FACES[0]:\n    " + COLOR)],
    ),
}
