"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

ENABLE = "    glEnable(GL_BLEND)\n"
FUNCTION = "    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)\n"
MASK, UNMASK = "    glDepthMask(GL_FALSE)\n", "    glDepthMask(GL_TRUE)\n"
SORTED = "sorted(TUBES, key=lambda tube: -math.dist(tube[:2], eye()))"
OPAQUE = "    draw_opaque()\n"

MUTANTS = {
    "between": Mutant(
        "draws the opaque things between the tubes",
        "opaque_first",
        [
            (OPAQUE, ""),
            (
                "        draw_tube(x, z, color)\n    glDepth",
                "        draw_tube(x, z, color)\n        if color[0] < 0.5:\n        "
                + OPAQUE
                + "    glDepth",
            ),
        ],
    ),
    "not_enabled": Mutant("forgets glEnable", "blended", [(ENABLE, "")]),
    "nothing_set": Mutant("forgets blending", "blended", [(ENABLE, ""), (FUNCTION, "")]),
    "no_function": Mutant("forgets glBlendFunc", "function", [(FUNCTION, "")]),
    "sum": Mutant("adds", "function", [("GL_ONE_MINUS_SRC_ALPHA)", "GL_ONE)")]),
    "swapped": Mutant(
        "swaps the factors",
        "function",
        [(FUNCTION, "    glBlendFunc(GL_ONE_MINUS_SRC_ALPHA, GL_SRC_ALPHA)\n")],
    ),
    "product": Mutant(
        "multiplies", "function", [(FUNCTION, "    glBlendFunc(GL_ZERO, GL_SRC_COLOR)\n")]
    ),
    "no_depth_test": Mutant(
        "turns the depth test off",
        "hidden",
        [(MASK, "    glDisable(GL_DEPTH_TEST)\n"), (UNMASK, "    glEnable(GL_DEPTH_TEST)\n")],
    ),
    "fixed": Mutant("draws the tubes in a fixed order", "order", [(SORTED, "TUBES")]),
    "near_first": Mutant("sorts the other way round", "order", [("-math.dist", "math.dist")]),
    "depths": Mutant("lets the glass write depths", "no_depths", [(MASK, ""), (UNMASK, "")]),
    "too_late": Mutant(
        "turns writing off after the tubes", "no_depths", [(MASK, ""), (UNMASK, MASK + UNMASK)]
    ),
    "left_off": Mutant("never writes depths again", "restored", [(UNMASK, "")]),
    "opaque_too": Mutant(
        "turns writing off before the opaque things",
        "restored",
        [
            (OPAQUE, MASK + OPAQUE),
            ("GL_ONE_MINUS_SRC_ALPHA)\n" + MASK, "GL_ONE_MINUS_SRC_ALPHA)\n"),
        ],
    ),
}
