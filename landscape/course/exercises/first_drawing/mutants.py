"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

HULL_COLOR = "    glColor3f(0.55, 0.33, 0.2)\n"
HULL = HULL_COLOR + "    glBegin(GL_QUADS)\n"
CORNERS = """\
    glVertex2f(-0.6, -0.3)
    glVertex2f(0.6, -0.3)
    glVertex2f(0.4, -0.6)
    glVertex2f(-0.4, -0.6)
"""
SAIL = """\
    glColor3f(0.95, 0.9, 0.8)
    glVertex2f(0.05, -0.25)
    glColor3f(0.85, 0.35, 0.2)
    glVertex2f(0.05, 0.75)
    glColor3f(0.3, 0.5, 0.8)
    glVertex2f(0.6, -0.25)
"""
PENNANT = "    glColor3f(0.95, 0.62, 0.35)\n"


def after(lines):
    """Return lines of colours and vertices in turns, each colour behind its vertex."""
    rows = lines.splitlines(keepends=True)
    return "".join(vertex + color for color, vertex in zip(rows[::2], rows[1::2]))


def moved(lines, change):
    """Return lines of glVertex2f with other coordinates."""
    rows = []
    for line in lines.splitlines():
        x, y = line.strip().removeprefix("glVertex2f(").rstrip(")").split(", ")
        rows.append(f"    glVertex2f({', '.join(change(x, y))})\n")
    return "".join(rows)


MUTANTS = {
    "crossed": Mutant(
        "goes across the hull",
        "hull",
        [
            (
                "    glVertex2f(0.4, -0.6)\n    glVertex2f(-0.4, -0.6)\n",
                "    glVertex2f(-0.4, -0.6)\n    glVertex2f(0.4, -0.6)\n",
            )
        ],
    ),
    "one_lost": Mutant(
        "takes triangles for four corners", "hull", [(HULL, HULL.replace("QUADS", "TRIANGLES"))]
    ),
    "strip": Mutant(
        "takes a strip around the hull", "hull", [(HULL, HULL.replace("QUADS", "TRIANGLE_STRIP"))]
    ),
    "outline": Mutant("draws lines", "hull", [(HULL, HULL.replace("QUADS", "LINE_LOOP"))]),
    "downward": Mutant(
        "lets y grow downwards",
        "hull",
        [(CORNERS, moved(CORNERS, lambda x, y: (x, y.replace("-", ""))))],
    ),
    "y_first": Mutant("gives y first", "hull", [(CORNERS, moved(CORNERS, lambda x, y: (y, x)))]),
    "pixels": Mutant(
        "gives pixels",
        "hull",
        [(CORNERS, moved(CORNERS, lambda x, y: (f"150 + 150 * {x}", f"150 - 150 * {y}")))],
    ),
    "from_zero": Mutant(
        "lets the window reach from 0 to 1",
        "hull",
        [(CORNERS, moved(CORNERS, lambda x, y: (f"({x} + 1) / 2", f"({y} + 1) / 2")))],
    ),
    "color_late": Mutant(
        "sets the hull's color behind it",
        "hull",
        [
            (
                HULL + CORNERS + "    glEnd()\n",
                "    glBegin(GL_QUADS)\n" + CORNERS + "    glEnd()\n" + HULL_COLOR,
            )
        ],
    ),
    "bytes": Mutant("counts to 255", "hull", [(HULL_COLOR, "    glColor3f(140, 84, 51)\n")]),
    "no_sign": Mutant(
        "forgets a sign", "hull", [("glVertex2f(-0.4, -0.6)", "glVertex2f(0.4, -0.6)")]
    ),
    "one_block": Mutant(
        "draws the sail as a quad",
        "sail",
        [("    glBegin(GL_TRIANGLES)\n" + SAIL, "    glBegin(GL_QUADS)\n" + SAIL)],
    ),
    "sail_of_lines": Mutant(
        "draws the sail as a strip of lines",
        "sail",
        [("    glBegin(GL_TRIANGLES)\n" + SAIL, "    glBegin(GL_LINE_STRIP)\n" + SAIL)],
    ),
    "one_color": Mutant(
        "sets only the first color",
        "sail",
        [("    glColor3f(0.85, 0.35, 0.2)\n", ""), ("    glColor3f(0.3, 0.5, 0.8)\n", "")],
    ),
    "colors_late": Mutant("sets each colour behind its vertex", "sail", [(SAIL, after(SAIL))]),
    "colors_turned": Mutant(
        "mistakes two colors",
        "sail",
        [("(0.85, 0.35, 0.2)", "(0.3, 0.5, 0.80)"), ("(0.3, 0.5, 0.8)\n", "(0.85, 0.35, 0.2)\n")],
    ),
    "flat": Mutant(
        "turns mixing off",
        "sail",
        [
            (
                SAIL,
                SAIL.replace(
                    "    glColor3f(0.95",
                    "    glEnd()\n    glShadeModel(GL_FLAT)\n    glBegin(GL_TRIANGLES)\n"
                    "    glColor3f(0.95",
                ),
            )
        ],
    ),
    "wrong_corner": Mutant(
        "puts a corner elsewhere", "sail", [("glVertex2f(0.6, -0.25)", "glVertex2f(0.6, 0.25)")]
    ),
    "pennant_color": Mutant("sets no colour for the pennant", "pennant", [(PENNANT, "")]),
    "pennant_bytes": Mutant(
        "gives the pennant's colour in bytes",
        "pennant",
        [(PENNANT, "    glColor3ub(95, 62, 35)\n")],
    ),
    "hull_color": Mutant(
        "swaps green and blue", "hull", [(HULL_COLOR, "    glColor3f(0.55, 0.2, 0.33)\n")]
    ),
    "pushed": Mutant(
        "pushes a matrix and does not pop it",
        "stacks",
        [(PENNANT, "    glPushMatrix()\n" + PENNANT)],
    ),
    "no_end": Mutant(
        "draws the pennant as points",
        "pennant",
        [(PENNANT + "    glBegin(GL_TRIANGLES)\n", PENNANT + "    glBegin(GL_POINTS)\n")],
    ),
}
