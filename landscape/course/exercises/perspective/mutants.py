"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

TAN = "NEAR * math.tan(math.radians(OPENING / 2))"
MODE = "    glMatrixMode(GL_PROJECTION)\n"
RIGHT = "top * width / height"

MUTANTS = {
    "whole_angle": Mutant("takes the whole angle", "opening", [("OPENING / 2", "OPENING")]),
    "no_near": Mutant(
        "does not multiply by near", "opening", [(TAN, "math.tan(math.radians(OPENING / 2))")]
    ),
    "degrees": Mutant("gives degrees to tan", "opening", [(TAN, "NEAR * math.tan(OPENING / 2)")]),
    "no_aspect": Mutant("forgets the proportions", "proportions", [(RIGHT, "top")]),
    "swapped": Mutant("swaps width and height", "proportions", [(RIGHT, "top * height / width")]),
    "constant": Mutant(
        "computes for the first size only", "proportions", [(RIGHT, "top * 640 / 480")]
    ),
    "modelview": Mutant("forgets glMatrixMode", "projected", [(MODE, "")]),
    "no_identity": Mutant(
        "forgets glLoadIdentity",
        "fresh",
        [("    glLoadIdentity()\n    glFrustum", "    glFrustum")],
    ),
    "ortho": Mutant("takes glOrtho", "projected", [("glFrustum(-right", "glOrtho(-right")]),
    "upside_down": Mutant("swaps bottom and top", "opening", [("-top, top", "top, -top")]),
    "mirrored": Mutant("swaps left and right", "proportions", [("-right, right", "right, -right")]),
    "pixels": Mutant("gives pixels", "opening", [(TAN, "height / 2")]),
    "planes": Mutant("takes other planes", "depths", [("top, NEAR, FAR)", "top, NEAR, FAR / 4)")]),
}
