"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

EYE = "    east = x - eye[0]\n    north = y - eye[1]\n    above = z - eye[2]\n"
TURN = [(f"math.{f}(math.radians(turned))", f"math.{f}(turned)") for f in ("cos", "sin")]
TILT = [(f"math.{f}(math.radians(tilted))", f"math.{f}(tilted)") for f in ("cos", "sin")]
LEVEL = "    level = cos * east + sin * north\n"
RIGHT = "    right = sin * east - cos * north\n"
AHEAD = "    ahead = cos * level + sin * above\n"
UP = "    up = cos * above - sin * level\n"
BEHIND = "    if ahead < NEAR:\n        return None\n"
COLUMN = "    column = WIDTH / 2 + FOCAL * right / ahead\n"
ROW = "    row = HEIGHT / 2 - FOCAL * up / ahead\n"

NO_EYE = "    east = x\n    north = y\n    above = z\n"

MUTANTS = {
    "no_eye": Mutant("forgets the eye", "from_eye", [(EYE, NO_EYE)]),
    "eye_added": Mutant("adds the eye", "from_eye", [(EYE, EYE.replace(" - ", " + "))]),
    "on_ground": Mutant(
        "forgets the height of the eye", "from_eye", [(EYE, EYE.replace("z - eye[2]", "z"))]
    ),
    "not_turned": Mutant(
        "does not turn", "turns", [(LEVEL, "    level = east\n"), (RIGHT, "    right = -north\n")]
    ),
    "turned_away": Mutant(
        "turns the other way",
        "turns",
        [(LEVEL, LEVEL.replace("+", "-")), (RIGHT, "    right = -sin * east - cos * north\n")],
    ),
    "turned_radians": Mutant("takes degrees for radians", "turns", TURN),
    "left": Mutant(
        "counts to the left", "turns", [(RIGHT, "    right = cos * north - sin * east\n")]
    ),
    "to_north": Mutant(
        "looks to the north",
        "turns",
        [
            (LEVEL, "    level = cos * north - sin * east\n"),
            (RIGHT, "    right = cos * east + sin * north\n"),
        ],
    ),
    "not_tilted": Mutant(
        "does not tilt", "tilts", [(AHEAD, "    ahead = level\n"), (UP, "    up = above\n")]
    ),
    "tilted_down": Mutant(
        "tilts the other way",
        "tilts",
        [(AHEAD, AHEAD.replace("+", "-")), (UP, UP.replace("-", "+"))],
    ),
    "tilted_radians": Mutant("takes degrees for radians", "tilts", TILT),
    "east_tilted": Mutant(
        "tilts by the way to the east",
        "tilts",
        [(AHEAD, AHEAD.replace("level", "east")), (UP, UP.replace("level", "east"))],
    ),
    "new_ahead": Mutant("tilts with the new value", "tilts", [(UP, UP.replace("level", "ahead"))]),
    "undivided": Mutant(
        "does not divide",
        "pixels",
        [(COLUMN, "    column = WIDTH / 2 + right\n"), (ROW, "    row = HEIGHT / 2 - up\n")],
    ),
    "by_distance": Mutant(
        "divides by the distance",
        "pixels",
        [(COLUMN, "    ahead = math.hypot(ahead, right, up)\n" + COLUMN)],
    ),
    "upside_down": Mutant(
        "counts rows upwards", "pixels", [(ROW, "    row = HEIGHT / 2 + FOCAL * up / ahead\n")]
    ),
    "corner": Mutant(
        "begins at the corner",
        "pixels",
        [
            (COLUMN, "    column = FOCAL * right / ahead\n"),
            (ROW, "    row = -FOCAL * up / ahead\n"),
        ],
    ),
    "behind": Mutant(
        "keeps what is behind", "pixels", [(BEHIND, "    if ahead == 0:\n        return None\n")]
    ),
    "both_sides": Mutant(
        "takes the amount of the distance",
        "pixels",
        [(BEHIND, "    ahead = abs(ahead)\n" + BEHIND)],
    ),
    "rounded": Mutant(
        "rounds", "pixels", [("math.floor(column), math.floor(row)", "round(column), round(row)")]
    ),
    "stretched": Mutant(
        "scales rows as the picture is scaled",
        "pixels",
        [(ROW, "    row = HEIGHT / 2 - FOCAL * HEIGHT / WIDTH * up / ahead\n")],
    ),
}
