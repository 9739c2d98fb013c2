"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

YEAR = "    glRotatef(year, 0, 1, 0)\n"
FAR = "    glTranslatef(4.2, 0, 0)\n"
MONTH = "    glRotatef(month, 0, 1, 0)\n"
NEAR = "    glTranslatef(1.3, 0, 0)\n"
PUSH, POP = "    glPushMatrix()\n", "    glPopMatrix()\n"

MUTANTS = {
    "planet_order": Mutant("moves the planet, then rotates", "planet", [(YEAR + FAR, FAR + YEAR)]),
    "moon_order": Mutant("moves the moon, then rotates", "moon", [(MONTH + NEAR, NEAR + MONTH)]),
    "moon_of_the_sun": Mutant(
        "pops the matrix before the moon", "moon", [(POP, ""), (MONTH, POP + MONTH)]
    ),
    "moon_identity": Mutant(
        "loads the identity before the moon", "moon", [(MONTH, "    glLoadIdentity()\n" + MONTH)]
    ),
    "moon_from_the_sun": Mutant(
        "moves the moon from the sun", "moon", [(NEAR, NEAR.replace("1.3", "5.5"))]
    ),
    "sign": Mutant("rotates the planet clockwise", "planet", [("f(year,", "f(-year,")]),
    "radians": Mutant("converts to radians", "planet", [("f(year,", "f(math.radians(year),")]),
    "axis": Mutant("rotates round the z axis", "planet", [("year, 0, 1, 0", "year, 0, 0, 1")]),
    "axis_x": Mutant("rotates round the x axis", "planet", [("year, 0, 1, 0", "year, 1, 0, 0")]),
    "moon_axis": Mutant("rotates the moon round x", "moon", [("month, 0, 1, 0", "month, 1, 0, 0")]),
    "angles_swapped": Mutant(
        "swaps the two angles",
        "planet",
        [
            (YEAR, YEAR.replace("year", "month")),
            (MONTH + NEAR, MONTH.replace("month", "year") + NEAR),
        ],
    ),
    "sun_too": Mutant(
        "moves the sun, too",
        "sun",
        [
            (
                "    draw_ball(1.3, (0.95, 0.62, 0.35))\n" + PUSH + YEAR + FAR,
                PUSH + YEAR + FAR + "    draw_ball(1.3, (0.95, 0.62, 0.35))\n",
            )
        ],
    ),
    "from_the_axis": Mutant(
        "takes the planet's rotation back for the moon",
        "moon",
        [(MONTH, "    glRotatef(-year, 0, 1, 0)\n" + MONTH)],
    ),
}
