"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

RIGHT = "((0, 1), (3, 1), (3, 0), (0, 0))"
REPEAT = "GL_TEXTURE_WRAP_S, GL_REPEAT"

MUTANTS = {
    "on_its_side": Mutant(
        "swaps s and t", "upright", [(RIGHT, "((1, 0), (1, 3), (0, 3), (0, 0))")]
    ),
    "mirrored": Mutant(
        "lets s grow to the left", "direction", [(RIGHT, "((3, 1), (0, 1), (0, 0), (3, 0))")]
    ),
    "once": Mutant(
        "draws the picture once", "three", [(RIGHT, "((0, 1), (1, 1), (1, 0), (0, 0))")]
    ),
    "a_third": Mutant(
        "divides by three", "three", [(RIGHT, "((0, 1), (1 / 3, 1), (1 / 3, 0), (0, 0))")]
    ),
    "both_directions": Mutant(
        "repeats the picture upwards, too", "three", [(RIGHT, "((0, 3), (3, 3), (3, 0), (0, 0))")]
    ),
    "clamped": Mutant(
        "does not repeat the texture", "repeated", [(REPEAT, "GL_TEXTURE_WRAP_S, GL_CLAMP")]
    ),
    "wrong_axis": Mutant(
        "repeats t",
        "repeated",
        [
            (REPEAT, "GL_TEXTURE_WRAP_S, GL_CLAMP"),
            ("GL_TEXTURE_WRAP_T, GL_CLAMP", "GL_TEXTURE_WRAP_T, GL_REPEAT"),
        ],
    ),
    "mirrored_repeat": Mutant(
        "mirrors every second picture",
        "repeated",
        [(REPEAT, "GL_TEXTURE_WRAP_S, GL_MIRRORED_REPEAT")],
    ),
    "slanted": Mutant(
        "mistakes one corner", "upright", [(RIGHT, "((0, 1), (3, 1), (3, 0), (0, 1))")]
    ),
    "after_the_vertex": Mutant(
        "gives the coordinates after the vertex",
        "upright",
        [
            (
                "        glTexCoord2f(s, t)\n        glVertex3f(x, y, 0)\n",
                "        glVertex3f(x, y, 0)\n        glTexCoord2f(s, t)\n",
            )
        ],
    ),
    "pixels": Mutant("counts pixels", "three", [(RIGHT, "((0, 16), (48, 16), (48, 0), (0, 0))")]),
    "same_place": Mutant(
        "draws the wall three times",
        "three",
        [
            (RIGHT, "((0, 1), (1, 1), (1, 0), (0, 0))"),
            ("zip(COORDINATES, CORNERS):", "list(zip(COORDINATES, CORNERS)) * 3:"),
        ],
    ),
    "wider_wall": Mutant(
        "makes the wall three times as wide",
        "textured",
        [
            (RIGHT, "((0, 1), (1, 1), (1, 0), (0, 0))"),
            ("((-3, -1), (3, -1), (3, 1), (-3, 1))", "((-9, -1), (9, -1), (9, 1), (-9, 1))"),
        ],
    ),
    "set_again": Mutant(
        "leaves the old mode behind the new one",
        "repeated",
        [
            (
                "    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T",
                "    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP)\n"
                "    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T",
            )
        ],
    ),
    "before_binding": Mutant(
        "sets the mode before it binds the texture",
        "repeated",
        [
            (REPEAT, "GL_TEXTURE_WRAP_S, GL_CLAMP"),
            (
                "    texture = glGenTextures(1)\n",
                "    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT)\n"
                "    texture = glGenTextures(1)\n",
            ),
        ],
    ),
    "negative": Mutant(
        "lets t go from 0 to -1 where it is clamped",
        "repeated",
        [(RIGHT, "((0, 0), (3, 0), (3, -1), (0, -1))")],
    ),
    "color": Mutant("does not set the colour white", "picture", [("    glColor3f(1, 1, 1)\n", "")]),
    "rows": Mutant(
        "turns the image over as well",
        "picture",
        [("for row in IMAGE", "for row in reversed(IMAGE)")],
    ),
    "half_a_boat": Mutant(
        "begins in the middle of a boat",
        "picture",
        [(RIGHT, "((0.5, 1), (3.5, 1), (3.5, 0), (0.5, 0))")],
    ),
}
