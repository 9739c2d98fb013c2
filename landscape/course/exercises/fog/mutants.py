"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

ENABLE = "    glEnable(GL_FOG)\n"
MODE = "    glFogi(GL_FOG_MODE, GL_EXP2)\n"
DENSITY = "math.sqrt(math.log(2)) / HALF"
COLOR = "    glFogfv(GL_FOG_COLOR, (*FOG, 1))\n"
SKY = "    glClearColor(*FOG, 1)\n"
DRAW = "        draw_bay()\n"

MUTANTS = {
    "not_enabled": Mutant("forgets glEnable", "fogged", [(ENABLE, "")]),
    "too_late": Mutant(
        "enables the fog after the bay", "fogged", [(ENABLE, ""), (DRAW, DRAW + "    " + ENABLE)]
    ),
    "a_part": Mutant(
        "enables the fog after the water",
        "fogged",
        [(ENABLE, ""), ("    for x, z in PILES:\n", ENABLE + "    for x, z in PILES:\n")],
    ),
    "no_mode": Mutant("sets no mode", "mode", [(MODE, "")]),
    "linear": Mutant("takes GL_LINEAR", "mode", [("GL_EXP2)", "GL_LINEAR)")]),
    "no_density": Mutant(
        "sets no density", "density", [(f"    glFogf(GL_FOG_DENSITY, {DENSITY})\n", "")]
    ),
    "of_exp": Mutant("solves the formula of GL_EXP", "density", [(DENSITY, "math.log(2) / HALF")]),
    "no_logarithm": Mutant(
        "takes one half for the exponent", "density", [(DENSITY, "math.sqrt(0.5) / HALF")]
    ),
    "half": Mutant("divides one half by the distance", "density", [(DENSITY, "0.5 / HALF")]),
    "inverse": Mutant("takes the inverse of the distance", "density", [(DENSITY, "1 / HALF")]),
    "base_10": Mutant("takes the logarithm to base 10", "density", [("math.log(", "math.log10(")]),
    "guessed": Mutant("guesses a density", "density", [(DENSITY, "0.05")]),
    "black": Mutant("sets no colour", "color", [(COLOR, "")]),
    "grey": Mutant("takes another colour", "color", [("(*FOG, 1))\n", "(0.5, 0.5, 0.5, 1))\n")]),
    "blue_sky": Mutant("forgets the sky", "sky", [(SKY, "    glClearColor(0.3, 0.5, 0.8, 1)\n")]),
    "no_sky": Mutant("sets no colour of the sky at all", "sky", [(SKY, "")]),
    "after_clear": Mutant(
        "sets the sky's colour after glClear",
        "sky",
        [(SKY, "    glClearColor(0.3, 0.5, 0.8, 1)\n"), (DRAW, "    " + SKY + DRAW)],
    ),
}
