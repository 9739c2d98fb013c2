"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

S = "                s = column / COLUMNS\n"
T = "                t = polar / math.pi\n"
GIVEN = "                glTexCoord2f(s, t)\n"
VERTEX = "                glVertex3f(x, y, z)\n"


def around(s):
    return [(S, f"                s = {s}\n")]


def down(t):
    return [(T, f"                t = {t}\n")]


MUTANTS = {
    "swapped": Mutant("swaps s and t", "north", [(GIVEN, "                glTexCoord2f(t, s)\n")]),
    "late": Mutant(
        "gives the coordinates after the vertex", "north", [(GIVEN, ""), (VERTEX, VERTEX + GIVEN)]
    ),
    "upside_down": Mutant("begins in the south", "north", down("1 - polar / math.pi")),
    "by_height": Mutant("takes the height for t", "north", down("(1 - y) / 2")),
    "polar_angle": Mutant("takes the angle for t", "north", down("polar")),
    "signed": Mutant("takes y for t", "north", down("y")),
    "whole_turn": Mutant("divides by a whole turn", "north", down("polar / (2 * math.pi)")),
    "mirrored": Mutant("goes west", "east", around("1 - column / COLUMNS")),
    "angle": Mutant("takes the angle for s", "east", around("longitude")),
    "half": Mutant("divides by half a turn", "east", around("longitude / math.pi")),
    "whole_numbers": Mutant("divides whole numbers", "east", around("column // COLUMNS")),
    "flat": Mutant("projects the map from the front", "east", around("(x + 1) / 2")),
    "degrees": Mutant("takes degrees", "east", around("15 * column")),
    "from_z": Mutant("begins at the z axis", "east", around("column / COLUMNS + 0.25")),
    "seam": Mutant("goes back to 0", "closed", around("column % COLUMNS / COLUMNS")),
    "gap": Mutant(
        "leaves the last strip out", "closed", [("range(COLUMNS + 1)", "range(COLUMNS)")]
    ),
    "one_less": Mutant("divides by one more column", "closed", around("column / (COLUMNS + 1)")),
    "stretched": Mutant("divides by one column less", "closed", around("column / (COLUMNS - 1)")),
}
