"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

VIEWPORT = "    glViewport(16, 16, side, side)\n"
SCISSOR = "    glScissor(16, 16, side, side)\n"
ENABLE, DISABLE = "    glEnable(GL_SCISSOR_TEST)\n", "    glDisable(GL_SCISSOR_TEST)\n"
CLEAR = "    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)\n    glDisable"
ORTHO = "    glOrtho(-6, 6, -6, 6, -2, 2)\n"
DOWN = "    glRotatef(90, 1, 0, 0)\n"
BACK = "    glClearColor(0.13, 0.16, 0.21, 1)\n    glMatrixMode"
WHOLE = "    draw_maze()\n    glViewport(0, 0, width, height)\n"

MUTANTS = {
    "no_viewport": Mutant("forgets glViewport", "viewport", [(VIEWPORT, "")]),
    "from_above": Mutant(
        "counts from the upper edge",
        "viewport",
        [(VIEWPORT, VIEWPORT.replace("16, 16", "16, height - 16 - side"))],
    ),
    "corner": Mutant(
        "gives the other corner",
        "viewport",
        [(VIEWPORT, VIEWPORT.replace("side, side", "16 + side, 16 + side"))],
    ),
    "constant": Mutant(
        "computes for the first size only", "viewport", [("side = height // 3", "side = 480 // 3")]
    ),
    "of_the_width": Mutant(
        "takes a third of the width", "viewport", [("side = height // 3", "side = width // 3")]
    ),
    "no_projection": Mutant(
        "forgets the projection", "projection", [("    glLoadIdentity()\n" + ORTHO, "")]
    ),
    "no_identity": Mutant(
        "forgets glLoadIdentity before glOrtho",
        "projection",
        [("    glLoadIdentity()\n" + ORTHO, ORTHO)],
    ),
    "old_view": Mutant(
        "keeps the view of the large picture", "projection", [("    glLoadIdentity()\n" + DOWN, "")]
    ),
    "turns_along": Mutant(
        "looks down, and turns with the eye",
        "projection",
        [(DOWN, DOWN + "    glRotatef(turn, 0, 1, 0)\n")],
    ),
    "from_below": Mutant("looks up", "projection", [(DOWN, DOWN.replace("90", "-90"))]),
    "from_below_again": Mutant(
        "looks up, and swaps the edges",
        "projection",
        [(DOWN, DOWN.replace("90", "-90")), (ORTHO, ORTHO.replace("-6, 6, -2", "6, -6, -2"))],
    ),
    "mirrored": Mutant(
        "swaps left and right", "projection", [(ORTHO, ORTHO.replace("(-6, 6", "(6, -6"))]
    ),
    "too_much": Mutant(
        "shows too much", "projection", [(ORTHO, "    glOrtho(-12, 12, -12, 12, -2, 2)\n")]
    ),
    "planes": Mutant(
        "takes planes beyond the maze", "projection", [(ORTHO, ORTHO.replace("-2, 2", "0, 2"))]
    ),
    "not_cleared": Mutant("does not clear the square", "cleared", [(CLEAR, "    glDisable")]),
    "all_cleared": Mutant(
        "clears the whole window", "cleared", [(ENABLE, ""), (SCISSOR, ""), (DISABLE, "")]
    ),
    "not_enabled": Mutant("forgets to enable the scissor test", "cleared", [(ENABLE, "")]),
    "no_paper": Mutant("forgets the background", "cleared", [("    glClearColor(*PAPER)\n", "")]),
    "other_box": Mutant(
        "takes another scissor box", "cleared", [(SCISSOR, "    glScissor(0, 0, side, side)\n")]
    ),
    "viewport_left": Mutant("leaves the viewport", "restored", [(WHOLE, "    draw_maze()\n")]),
    "scissor_left": Mutant("leaves the scissor test on", "restored", [(DISABLE, "")]),
    "paper_left": Mutant("leaves the background", "restored", [(BACK, "    glMatrixMode")]),
}
