"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

MOVE, SCALE = "    glTranslatef(0, 2 * LEVEL, 0)\n", "    glScalef(1, -1, 1)\n"
CLOCKWISE, COUNTER = "    glFrontFace(GL_CW)\n", "    glFrontFace(GL_CCW)\n"
PLANE = "    glClipPlane(GL_CLIP_PLANE0, (0, 1, 0, -LEVEL))\n"
ENABLE, DISABLE = "    glEnable(GL_CLIP_PLANE0)\n", "    glDisable(GL_CLIP_PLANE0)\n"
MIRRORED = SCALE + "    set_sun()\n"
AGAIN = "    glPopMatrix()\n    set_sun()\n"

MUTANTS = {
    "turned": Mutant(
        "turns the things round", "mirrored", [(SCALE, "    glRotatef(180, 1, 0, 0)\n")]
    ),
    "two_signs": Mutant("changes two signs", "mirrored", [(SCALE, "    glScalef(1, -1, -1)\n")]),
    "other_axis": Mutant(
        "mirrors left and right", "mirrored", [(SCALE, "    glScalef(-1, 1, 1)\n")]
    ),
    "at_zero": Mutant("mirrors at y = 0", "mirrored", [(MOVE, "")]),
    "once_the_level": Mutant(
        "moves by the level", "mirrored", [(MOVE, "    glTranslatef(0, LEVEL, 0)\n")]
    ),
    "other_order": Mutant("scales before it moves", "mirrored", [(MOVE + SCALE, SCALE + MOVE)]),
    "insides": Mutant("forgets glFrontFace", "front", [(CLOCKWISE, ""), (COUNTER, "")]),
    "no_culling": Mutant(
        "turns culling off",
        "front",
        [(CLOCKWISE, "    glDisable(GL_CULL_FACE)\n"), (COUNTER, "    glEnable(GL_CULL_FACE)\n")],
    ),
    "cull_front": Mutant(
        "culls the front faces",
        "front",
        [(CLOCKWISE, "    glCullFace(GL_FRONT)\n"), (COUNTER, "    glCullFace(GL_BACK)\n")],
    ),
    "sun_above": Mutant("forgets the sun", "sun", [(MIRRORED, SCALE)]),
    "sun_half": Mutant(
        "sets the sun mirrored in its numbers, too",
        "sun",
        [(MIRRORED, SCALE + "    glLightfv(GL_LIGHT0, GL_POSITION, (2, 2, -1.5, 0))\n")],
    ),
    "no_plane": Mutant("forgets the clip plane", "cut", [(PLANE, ""), (ENABLE, ""), (DISABLE, "")]),
    "not_enabled": Mutant("forgets to enable the plane", "cut", [(ENABLE, ""), (DISABLE, "")]),
    "other_side": Mutant(
        "gives the plane before mirroring", "cut", [(PLANE, ""), (MOVE, PLANE + MOVE)]
    ),
    "plane_at_zero": Mutant("forgets the level in the plane", "cut", [(", -LEVEL))", ", 0))")]),
    "sign_of_d": Mutant("takes the wrong sign of d", "cut", [(", -LEVEL))", ", LEVEL))")]),
    "matrix_left": Mutant("leaves the matrix", "restored", [(AGAIN, "    set_sun()\n")]),
    "front_left": Mutant("leaves the front", "restored", [(COUNTER, "")]),
    "plane_left": Mutant("leaves the plane on", "restored", [(DISABLE, "")]),
    "sun_left": Mutant("leaves the sun", "restored", [(AGAIN, "    glPopMatrix()\n")]),
}
