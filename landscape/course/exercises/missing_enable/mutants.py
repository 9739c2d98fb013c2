"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

ON = "    glEnable(GL_DEPTH_TEST)\n"
SHOW = "        glfw.swap_buffers(window)\n"

MUTANTS = {
    "function_only": Mutant(
        "chooses the comparison only", "enabled", [(ON, "    glDepthFunc(GL_LESS)\n")]
    ),
    "mask_only": Mutant(
        "lets depths be written only", "enabled", [(ON, "    glDepthMask(GL_TRUE)\n")]
    ),
    "culling": Mutant(
        "culls back faces instead", "enabled", [(ON, "    glEnable(GL_CULL_FACE)\n")]
    ),
    "too_late": Mutant(
        "turns it on after the first frame", "enabled", [(ON, ""), (SHOW, SHOW + "    " + ON)]
    ),
    "off_again": Mutant(
        "turns it off after the board",
        "enabled",
        [
            (
                "    for x, z, height, color in TOWERS:",
                "    glDisable(GL_DEPTH_TEST)\n    for x, z, height, color in TOWERS:",
            )
        ],
    ),
    "sorted": Mutant(
        "sorts the towers instead", "enabled", [(ON, ""), ("in TOWERS:", "in sorted(TOWERS):")]
    ),
    "left_out": Mutant("leaves a tower out", "enabled", [("in TOWERS:", "in TOWERS[1:]:")]),
    "no_clear": Mutant("no longer clears the depth", "cleared", [(" | GL_DEPTH_BUFFER_BIT", "")]),
    "always": Mutant(
        "lets everything pass", "picture", [(ON, ON + "    glDepthFunc(GL_ALWAYS)\n")]
    ),
}
