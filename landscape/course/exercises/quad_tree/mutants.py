"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

LOOK = "    where = look(x, y, size)\n"
OUT = "    if where == OUTSIDE:\n        return []\n"
DONE = "    if where == INSIDE or size == SMALLEST:\n"
TILE = "        return [(x, y, size)]\n"
HALF = "    half = size // 2\n"
LIST = "    tiles = []\n"
RIGHT = "    for right in (0, half):\n"
DOWN = "        for down in (0, half):\n"
ADD = "            tiles += visible(x + right, y + down, half)\n"
RETURN = "    return tiles\n"

MUTANTS = {
    "out_kept": Mutant("keeps what is outside", "seen", [(OUT, "")]),
    "parents": Mutant("keeps what it divides", "seen", [(LIST, "    tiles = [(x, y, size)]\n")]),
    "inside_lost": Mutant(
        "drops what is inside",
        "seen",
        [(DONE, "    if where == INSIDE:\n        return []\n    if size == SMALLEST:\n")],
    ),
    "border_lost": Mutant(
        "drops small squares at the border",
        "seen",
        [
            (
                DONE + TILE,
                "    if where == INSIDE:\n"
                + TILE
                + "    if size == SMALLEST:\n        return []\n",
            )
        ],
    ),
    "other_way": Mutant(
        "divides what is inside", "seen", [(DONE, "    if where == ACROSS or size == SMALLEST:\n")]
    ),
    "one_place": Mutant(
        "divides without moving", "divided", [(ADD, "            tiles += visible(x, y, half)\n")]
    ),
    "returns_early": Mutant(
        "returns the first quarter", "divided", [(ADD, ADD + "            return tiles\n")]
    ),
    "one_column": Mutant(
        "takes only two quarters", "divided", [(RIGHT, "    for right in (0,):\n")]
    ),
    "diagonal": Mutant(
        "takes the quarters of a diagonal", "divided", [(DOWN, "        for down in (right,):\n")]
    ),
    "not_kept": Mutant(
        "forgets what the quarters return",
        "divided",
        [(ADD, "            visible(x + right, y + down, half)\n")],
    ),
    "eighths": Mutant(
        "halves twice",
        "divided",
        [(ADD, ADD.replace("down, half)", "down, max(half // 2, SMALLEST))"))],
    ),
    "all_small": Mutant(
        "divides what is inside, too", "sizes", [(DONE, "    if size == SMALLEST:\n")]
    ),
    "stops_early": Mutant(
        "stops a size earlier",
        "sizes",
        [(DONE, "    if where == INSIDE or size == 2 * SMALLEST:\n")],
    ),
    "too_small": Mutant(
        "goes on below the smallest size",
        "sizes",
        [(DONE, "    if where == INSIDE or size == SMALLEST // 2:\n")],
    ),
    "eight": Mutant(
        "keeps no tile larger than 8",
        "sizes",
        [(DONE, "    if (where == INSIDE and size <= 8) or size == SMALLEST:\n")],
    ),
    "no_tree": Mutant(
        "asks for all small squares",
        "looks",
        [
            (
                LOOK,
                "    if size > SMALLEST:\n"
                "        for i in range(x, x + size, SMALLEST):\n"
                "            for j in range(y, y + size, SMALLEST):\n"
                "                if size == MAP:\n"
                "                    look(i, j, SMALLEST)\n" + LOOK,
            )
        ],
    ),
    "twice": Mutant(
        "looks again before each question",
        "looks",
        [(DONE, "    if look(x, y, size) == INSIDE or size == SMALLEST:\n")],
    ),
    "before": Mutant(
        "looks at the quarters, then calls itself",
        "looks",
        [(ADD, "            if look(x + right, y + down, half) != OUTSIDE:\n    " + ADD)],
    ),
}
