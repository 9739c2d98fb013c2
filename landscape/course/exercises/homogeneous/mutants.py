"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

POINT = "return np.array((x, y, z, 1))"
MOVE = "return np.array(((1, 0, 0, x), (0, 1, 0, y), (0, 0, 1, z), (0, 0, 0, 1)))"
TURN = "return np.array(((cos, 0, sin, 0), (0, 1, 0, 0), (-sin, 0, cos, 0), (0, 0, 0, 1)))"
DIVIDE = "return x / w, y / w, z / w"


def moved(matrix):
    return [(MOVE, f"return np.array({matrix})")]


def turned(matrix):
    return [(TURN, f"return np.array({matrix})")]


MUTANTS = {
    "a_direction": Mutant(
        "makes points directions", "points", [(POINT, "return np.array((x, y, z, 0))")]
    ),
    "one_first": Mutant(
        "puts the 1 in front", "points", [(POINT, "return np.array((1, x, y, z))")]
    ),
    "z_for_w": Mutant(
        "takes z for the fourth number", "points", [(POINT, "return np.array((x, y, z, z))")]
    ),
    "minus_one": Mutant(
        "takes -1 for the fourth number", "points", [(POINT, "return np.array((x, y, z, -1))")]
    ),
    "stays": Mutant("leaves the identity", "moves", [(MOVE, "return np.identity(4)")]),
    "in_a_row": Mutant(
        "writes the translation in the last row",
        "moves",
        moved("((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (x, y, z, 1))"),
    ),
    "on_diagonal": Mutant(
        "writes the translation on the diagonal",
        "moves",
        moved("((1 + x, 0, 0, 0), (0, 1 + y, 0, 0), (0, 0, 1 + z, 0), (0, 0, 0, 1))"),
    ),
    "backward": Mutant(
        "takes the inverse translation",
        "moves",
        moved("((1, 0, 0, -x), (0, 1, 0, -y), (0, 0, 1, -z), (0, 0, 0, 1))"),
    ),
    "no_depth": Mutant(
        "forgets z", "moves", moved("((1, 0, 0, x), (0, 1, 0, y), (0, 0, 1, 0), (0, 0, 0, 1))")
    ),
    "z_row": Mutant(
        "writes z as x", "moves", moved("((1, 0, 0, z), (0, 1, 0, y), (0, 0, 1, x), (0, 0, 0, 1))")
    ),
    "not_turned": Mutant("leaves the identity", "turns", [(TURN, "return np.identity(4)")]),
    "radians": Mutant(
        "takes degrees for radians",
        "turns",
        [
            ("np.cos(np.radians(angle))", "np.cos(angle)"),
            ("np.sin(np.radians(angle))", "np.sin(angle)"),
        ],
    ),
    "clockwise": Mutant(
        "turns clockwise",
        "turns",
        turned("((cos, 0, -sin, 0), (0, 1, 0, 0), (sin, 0, cos, 0), (0, 0, 0, 1))"),
    ),
    "around_z": Mutant(
        "turns around z",
        "turns",
        turned("((cos, -sin, 0, 0), (sin, cos, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))"),
    ),
    "around_x": Mutant(
        "turns around x",
        "turns",
        turned("((1, 0, 0, 0), (0, cos, -sin, 0), (0, sin, cos, 0), (0, 0, 0, 1))"),
    ),
    "no_minus": Mutant(
        "forgets the sign",
        "turns",
        turned("((cos, 0, sin, 0), (0, 1, 0, 0), (sin, 0, cos, 0), (0, 0, 0, 1))"),
    ),
    "undivided": Mutant("does not divide", "divides", [(DIVIDE, "return x, y, z")]),
    "by_z": Mutant("divides by z", "divides", [(DIVIDE, "return x / z, y / z, 1")]),
    "multiplied": Mutant("multiplies by w", "divides", [(DIVIDE, "return x * w, y * w, z * w")]),
    "x_alone": Mutant("divides x alone", "divides", [(DIVIDE, "return x / w, y, z")]),
    "whole": Mutant(
        "divides to whole numbers", "divides", [(DIVIDE, "return x // w, y // w, z // w")]
    ),
}
