"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

PLANE = "    glClipPlane(GL_CLIP_PLANE0, (0, 0, -1, 0.3))\n"
ENABLE, DISABLE = "    glEnable(GL_CLIP_PLANE0)\n", "    glDisable(GL_CLIP_PLANE0)\n"
TURN = "    glRotatef(turn, 0, 1, 0)\n"
MOVE = "    glTranslatef(0.4, 0, -1)\n"
STAIR, WALL = "    draw_stair()\n", "    draw_wall()\n"
SETUP = "    glLightModeli("

MUTANTS = {
    "no_plane": Mutant("gives no plane", "cut", [(PLANE, "")]),
    "not_enabled": Mutant("forgets glEnable", "cut", [(ENABLE, "")]),
    "too_late": Mutant(
        "enables the plane after the wall", "cut", [(ENABLE, ""), (DISABLE, ENABLE + DISABLE)]
    ),
    "another": Mutant(
        "enables another plane",
        "cut",
        [(ENABLE, ENABLE.replace("0)", "1)")), (DISABLE, DISABLE.replace("0)", "1)"))],
    ),
    "other_side": Mutant("keeps the other side", "place", [("-1, 0.3)", "1, -0.3)")]),
    "sign_of_d": Mutant("takes the wrong sign of d", "place", [("-1, 0.3)", "-1, -0.3)")]),
    "both_signs": Mutant(
        "takes the equation of the plane z = -0.3", "place", [("-1, 0.3)", "1, 0.3)")]
    ),
    "before_the_loop": Mutant(
        "gives the plane once, for the eye", "place", [(PLANE, ""), (SETUP, PLANE + SETUP)]
    ),
    "before_the_tower": Mutant(
        "gives the plane before the tower's translation",
        "place",
        [(PLANE, ""), (MOVE, PLANE + MOVE)],
    ),
    "before_the_turn": Mutant(
        "gives the plane before the tower's rotation", "place", [(PLANE, ""), (TURN, PLANE + TURN)]
    ),
    "once": Mutant(
        "gives the plane in the first frame only",
        "place",
        [(PLANE, "    if turn == -30:\n    " + PLANE)],
    ),
    "other_axis": Mutant(
        "cuts along another axis", "place", [("(0, 0, -1, 0.3)", "(-1, 0, 0, 0.3)")]
    ),
    "stair_cut": Mutant(
        "cuts the stair as well", "whole", [(DISABLE, ""), (STAIR, STAIR + DISABLE)]
    ),
    "hill_cut": Mutant(
        "never disables the plane", "whole", [(DISABLE, ""), (STAIR, ""), (PLANE, STAIR + PLANE)]
    ),
}
