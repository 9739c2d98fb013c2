"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

PUSH = "    glPushMatrix()\n    glTranslatef(*HUB, 0)\n"
TO_HUB = "    glTranslatef(*HUB, 0)\n"
TURN = "    glRotatef(angle, 0, 0, 1)\n"
RIM = "    draw_rim()\n"
INNER_PUSH = "        glPushMatrix()\n"
AROUND = "        glRotatef(45 * number, 0, 0, 1)\n"
OUT = "        glTranslatef(RADIUS, 0, 0)\n"
BACK = "        glRotatef(-45 * number - angle, 0, 0, 1)\n"
CABIN = "        draw_cabin()\n"
FEET = "        glTranslatef(0.15, -0.9, 0)\n"
SMALL = "        glScalef(0.45, 0.45, 1)\n"
PERSON = "        draw_person()\n"
POPS = "        glPopMatrix()\n    glPopMatrix()\n"

MUTANTS = {
    "no_hub": Mutant("leaves the hub at the origin", "rim", [(TO_HUB, "")]),
    "rim_still": Mutant("does not turn the rim", "rim", [(TURN + RIM, RIM + TURN)]),
    "around_origin": Mutant("turns around the origin", "rim", [(TO_HUB + TURN, TURN + TO_HUB)]),
    "clockwise": Mutant("turns clockwise", "rim", [(TURN, TURN.replace("angle", "-angle"))]),
    "radians": Mutant(
        "converts to radians", "rim", [(TURN, TURN.replace("angle", "math.radians(angle)"))]
    ),
    "axis": Mutant("turns around the y axis", "rim", [(TURN, TURN.replace("0, 0, 1", "0, 1, 0"))]),
    "at_hub": Mutant("does not move the cabins out", "on_rim", [(OUT, "")]),
    "one_place": Mutant(
        "hangs all cabins in one place",
        "on_rim",
        [(AROUND, ""), (BACK, BACK.replace("-45 * number - angle", "-angle"))],
    ),
    "no_inner_push": Mutant(
        "keeps no frame for the next cabin",
        "on_rim",
        [(INNER_PUSH, ""), (POPS, "    glPopMatrix()\n")],
    ),
    "not_with_wheel": Mutant(
        "pops the wheel's frame before the cabins",
        "on_rim",
        [(RIM, RIM + "    glRotatef(-angle, 0, 0, 1)\n"), (BACK, BACK.replace(" - angle", ""))],
    ),
    "identity": Mutant(
        "begins each cabin at the origin",
        "on_rim",
        [
            (
                INNER_PUSH,
                INNER_PUSH + "        glLoadIdentity()\n" + TURN.replace("    ", " " * 8, 1),
            )
        ],
    ),
    "wrong_angle": Mutant(
        "divides by nine",
        "on_rim",
        [(AROUND, AROUND.replace("45", "40")), (BACK, BACK.replace("45", "40"))],
    ),
    "tipped": Mutant("does not turn the cabins back", "upright", [(BACK, "")]),
    "wheel_only": Mutant(
        "turns back by the angle alone",
        "upright",
        [(BACK, BACK.replace("-45 * number - angle", "-angle"))],
    ),
    "place_only": Mutant(
        "turns back by the place alone", "upright", [(BACK, BACK.replace(" - angle", ""))]
    ),
    "twice": Mutant(
        "turns on instead of back",
        "upright",
        [(BACK, BACK.replace("-45 * number - angle", "45 * number + angle"))],
    ),
    "no_feet": Mutant("leaves the person where the cabin hangs", "people", [(FEET, "")]),
    "giant": Mutant("does not scale the person", "people", [(SMALL, "")]),
    "scaled_way": Mutant("scales, then moves", "people", [(FEET + SMALL, SMALL + FEET)]),
    "outside": Mutant(
        "leaves the cabin before its person",
        "people",
        [
            (CABIN, CABIN + "        glPopMatrix()\n"),
            (POPS, "    glPopMatrix()\n"),
            (FEET, "        glPushMatrix()\n" + FEET),
            (PERSON, PERSON + "        glPopMatrix()\n"),
        ],
    ),
    "not_popped": Mutant(
        "does not pop the wheel's frame", "stacks", [(POPS, "        glPopMatrix()\n")]
    ),
}
