"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

BACK = "    back = eye - target\n"
UNIT_BACK = "    back = back / np.linalg.norm(back)\n"
RIGHT = "    right = np.cross(up, back)\n"
UNIT_RIGHT = "    right = right / np.linalg.norm(right)\n"
UPWARD = "    upward = np.cross(back, right)\n"
AXES = "    matrix[:3, :3] = right, upward, back\n"
TURN = "    glMultMatrixf(matrix.T)\n"
MOVE = "    glTranslatef(*-eye)\n"

MUTANTS = {
    "not_turned": Mutant("only moves the world", "place", [(TURN, "")]),
    "not_moved": Mutant("only turns the world", "place", [(MOVE, "")]),
    "moved_on": Mutant("moves by the eye", "place", [(MOVE, "    glTranslatef(*eye)\n")]),
    "moved_late": Mutant("moves the world after turning it", "place", [(TURN + MOVE, MOVE + TURN)]),
    "camera_moved": Mutant(
        "moves the camera, and not the world",
        "place",
        [(TURN + MOVE, "    glTranslatef(*eye)\n    glMultMatrixf(matrix)\n")],
    ),
    "to_target": Mutant(
        "moves the target to the eye", "place", [(MOVE, "    glTranslatef(*-target)\n")]
    ),
    "transposed": Mutant("hands the rows over", "axes", [(TURN, "    glMultMatrixf(matrix)\n")]),
    "whole_transposed": Mutant(
        "hands the rows of the whole matrix over",
        "axes",
        [(TURN + MOVE, "    matrix[:3, 3] = -matrix[:3, :3] @ eye\n    glMultMatrixf(matrix)\n")],
    ),
    "forward": Mutant("looks away from the target", "axes", [(BACK, "    back = target - eye\n")]),
    "left": Mutant(
        "swaps the factors of the first product",
        "axes",
        [(RIGHT, "    right = np.cross(back, up)\n")],
    ),
    "downward": Mutant(
        "swaps the factors of the second product",
        "axes",
        [(UPWARD, "    upward = np.cross(right, back)\n")],
    ),
    "mirrored": Mutant(
        "takes an axis to the left", "axes", [(AXES, "    matrix[:3, :3] = -right, upward, back\n")]
    ),
    "up_kept": Mutant("takes up as it is", "axes", [(UPWARD, "    upward = up\n")]),
    "right_short": Mutant("does not normalize the first product", "axes", [(UNIT_RIGHT, "")]),
    "back_long": Mutant(
        "does not normalize the line of sight",
        "axes",
        [(UNIT_BACK, ""), (AXES, "    upward = upward / np.linalg.norm(upward)\n" + AXES)],
    ),
    "nothing_normalized": Mutant("normalizes nothing", "axes", [(UNIT_BACK, ""), (UNIT_RIGHT, "")]),
    "to_origin": Mutant("looks at the origin", "axes", [(BACK, "    back = eye\n")]),
    "own_up": Mutant(
        "takes y for the direction up", "axes", [(RIGHT, "    right = np.cross((0, 1, 0), back)\n")]
    ),
    "z_up": Mutant(
        "takes z for the direction up", "axes", [(RIGHT, "    right = np.cross((0, 0, 1), back)\n")]
    ),
    "order": Mutant(
        "takes the axes in another order",
        "axes",
        [(AXES, "    matrix[:3, :3] = right, back, upward\n")],
    ),
    "pushed": Mutant(
        "pushes a matrix and does not pop it", "stacks", [(BACK, "    glPushMatrix()\n" + BACK)]
    ),
}
