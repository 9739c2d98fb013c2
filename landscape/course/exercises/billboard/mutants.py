"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

ANGLE = "math.degrees(math.atan2(z - eye_z, eye_x - x))"
EYE = "    eye_x, eye_z = eye()\n"
TURN = f"    glRotatef({ANGLE}, 0, 1, 0)\n"
MOVE = "    glTranslatef(x, 0, z)\n"

MUTANTS = {
    "turned_first": Mutant(
        "turns before the translation", "places", [(EYE + TURN, ""), (MOVE, EYE + TURN + MOVE)]
    ),
    "no_pop": Mutant(
        "forgets glPushMatrix and glPopMatrix",
        "places",
        [("    glPushMatrix()\n", ""), ("    glPopMatrix()\n", "")],
    ),
    "parallel": Mutant(
        "takes the whole rotation away",
        "upright",
        [
            (
                EYE + TURN,
                "    matrix = glGetFloatv(GL_MODELVIEW_MATRIX)\n"
                "    matrix[:3, :3] = ((0, 0, 1), (0, 1, 0), (-1, 0, 0))\n"
                "    glLoadMatrixf(matrix)\n",
            )
        ],
    ),
    "leaning": Mutant(
        "tilts the trees by the eye's pitch",
        "upright",
        [(TURN, TURN + "    glRotatef(pitch, 0, 0, 1)\n")],
    ),
    "by_the_camera": Mutant(
        "turns all by the camera's angle",
        "facing",
        [(TURN, "    glRotatef(-turn - 90, 0, 1, 0)\n")],
    ),
    "lesson": Mutant(
        "takes the formula for a quad that looks along z",
        "facing",
        [(ANGLE, "math.degrees(math.atan2(eye_x - x, eye_z - z))")],
    ),
    "backs": Mutant(
        "takes the vector from the eye to the tree",
        "facing",
        [(ANGLE, "math.degrees(math.atan2(eye_z - z, x - eye_x))")],
    ),
    "wrong_way": Mutant(
        "takes the wrong sign",
        "facing",
        [(ANGLE, "math.degrees(math.atan2(eye_z - z, eye_x - x))")],
    ),
    "swapped": Mutant(
        "swaps the arguments of atan2",
        "facing",
        [(ANGLE, "math.degrees(math.atan2(eye_x - x, z - eye_z))")],
    ),
    "radians": Mutant(
        "gives radians to glRotatef", "facing", [(ANGLE, "math.atan2(z - eye_z, eye_x - x)")]
    ),
    "once": Mutant(
        "computes the eye's place once",
        "facing",
        [
            (EYE, "    eye_x, eye_z = FIRST\n"),
            ("def make_texture", "FIRST = eye()\n\n\ndef make_texture"),
        ],
    ),
    "arctangent": Mutant(
        "takes atan, which knows half a turn only",
        "facing",
        [(ANGLE, "math.degrees(math.atan((z - eye_z) / (eye_x - x)))")],
    ),
}
