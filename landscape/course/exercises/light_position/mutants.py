"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

CALL = "        glLightfv(GL_LIGHT0, GL_POSITION, LAMP)\n"
EYE = "        glTranslatef(0, -0.9, -12.5)\n"
TURN = "        glRotatef(40 + 90 * glfw.get_time(), 0, 1, 0)\n"

MUTANTS = {
    "before_the_eye": Mutant(
        "sets it before the eye's transformation", "at_the_lamp", [(CALL, ""), (EYE, CALL + EYE)]
    ),
    "between": Mutant(
        "sets it before the last rotation", "at_the_lamp", [(CALL, ""), (TURN, CALL + TURN)]
    ),
    "after_the_scene": Mutant(
        "sets it after the scene",
        "at_the_lamp",
        [(CALL + "        draw_scene()\n", "        draw_scene()\n" + CALL)],
    ),
    "once": Mutant(
        "sets it in the first frame only",
        "at_the_lamp",
        [(CALL, "        if glfw.get_time() == 0:\n    " + CALL)],
    ),
    "direction": Mutant(
        "makes it a direction", "place", [(CALL, CALL.replace("LAMP", "LAMP[:3] + (0,)"))]
    ),
    "in_a_piece": Mutant(
        "sets it in the frame of each piece",
        "at_the_lamp",
        [(CALL, ""), ("        draw_piece()\n", CALL + "        draw_piece()\n")],
    ),
    "twice": Mutant(
        "moves the light twice",
        "at_the_lamp",
        [
            (
                CALL,
                "        glPushMatrix()\n        glTranslatef(*LAMP[:3])\n"
                + CALL
                + "        glPopMatrix()\n",
            )
        ],
    ),
    "before_the_identity": Mutant(
        "sets it with the matrix of the frame before",
        "at_the_lamp",
        [
            (CALL, ""),
            ("        glMatrixMode(GL_MODELVIEW)\n", "        glMatrixMode(GL_MODELVIEW)\n" + CALL),
        ],
    ),
    "emptied": Mutant(
        "empties the matrix before",
        "at_the_lamp",
        [
            (
                CALL,
                "        glPushMatrix()\n        glLoadIdentity()\n"
                + CALL
                + "        glPopMatrix()\n",
            )
        ],
    ),
    "origin": Mutant(
        "puts the light into the table",
        "at_the_lamp",
        [(CALL, CALL.replace("LAMP", "(0, 0, 0, 1)"))],
    ),
    "table_as_well": Mutant(
        "moves the table to the lamp",
        "light",
        [(CALL, "        glTranslatef(*LAMP[:3])\n" + CALL.replace("LAMP", "(0, 0, 0, 1)"))],
    ),
    "three_numbers": Mutant(
        "gives three numbers", "place", [(CALL, CALL.replace("LAMP", "LAMP[:3]"))]
    ),
    "left_out": Mutant("leaves the call out", "place", [(CALL, "")]),
    "other_light": Mutant(
        "places another light", "place", [(CALL, CALL.replace("GL_LIGHT0", "GL_LIGHT1"))]
    ),
    "no_light": Mutant("turns the light off", "light", [("    glEnable(GL_LIGHT0)\n", "")]),
}
