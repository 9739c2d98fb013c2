"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

ENABLE, DISABLE = "    glEnable(GL_STENCIL_TEST)\n", "    glDisable(GL_STENCIL_TEST)\n"
MARK = "    glDepthMask(GL_FALSE)\n    draw_glass()\n"
COLORS, NO_COLORS = (
    f"    glColorMask({', '.join(4 * [value])})\n" for value in ("GL_TRUE", "GL_FALSE")
)
DEPTHS = "    glDepthMask(GL_TRUE)\n"
ALWAYS, EQUAL = "    glStencilFunc(GL_ALWAYS, 1, 1)\n", "    glStencilFunc(GL_EQUAL, 1, 1)\n"
REPLACE = "    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE)\n"
KEEP = "    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP)\n"
IMAGE = "    draw_image()\n"

MUTANTS = {
    "no_glass": Mutant(
        "does not draw the glass first", "drawn", [(MARK, "    glDepthMask(GL_FALSE)\n")]
    ),
    "no_image": Mutant("leaves out the image", "drawn", [(KEEP + IMAGE, KEEP)]),
    "late_test": Mutant(
        "enables the test after the marking", "marked", [(ENABLE, ""), (EQUAL, ENABLE + EQUAL)]
    ),
    "never_kept": Mutant(
        "has REPLACE in the wrong place",
        "marked",
        [(ALWAYS, "    glStencilFunc(GL_NEVER, 1, 1)\n")],
    ),
    "kept": Mutant("has no REPLACE", "marked", [(ALWAYS + REPLACE, ALWAYS)]),
    "replaced_by_0": Mutant(
        "marks with 0", "marked", [(ALWAYS, "    glStencilFunc(GL_ALWAYS, 0, 1)\n")]
    ),
    "depth": Mutant("writes the glass's depth", "unseen", [(MARK, "    draw_glass()\n")]),
    "color": Mutant("draws the glass in color", "unseen", [(NO_COLORS, "")]),
    "off": Mutant(
        "disables the test before the image", "inside", [(IMAGE + DISABLE, DISABLE + IMAGE)]
    ),
    "no_color": Mutant("leaves the colors masked", "inside", [(COLORS, "")]),
    "no_depth": Mutant("leaves the depth masked", "inside", [(DEPTHS, "")]),
    "always": Mutant("leaves GL_ALWAYS", "inside", [(EQUAL, "")]),
    "opposite": Mutant(
        "draws beside the marks", "inside", [(EQUAL, "    glStencilFunc(GL_NOTEQUAL, 1, 1)\n")]
    ),
    "other_mark": Mutant(
        "asks for another mark", "inside", [(EQUAL, "    glStencilFunc(GL_EQUAL, 2, 255)\n")]
    ),
    "changes": Mutant(
        "lets the image change the marks",
        "inside",
        [(EQUAL + KEEP, EQUAL + "    glStencilOp(GL_KEEP, GL_KEEP, GL_INCR)\n")],
    ),
    "not_cleared": Mutant("does not clear the marks", "fresh", [(" | GL_STENCIL_BUFFER_BIT", "")]),
    "left_on": Mutant("leaves the test on", "restored", [(DISABLE, "")]),
    "color_after": Mutant(
        "masks a color at the end",
        "restored",
        [(DISABLE, DISABLE + "    glColorMask(GL_TRUE, GL_TRUE, GL_FALSE, GL_TRUE)\n")],
    ),
}
