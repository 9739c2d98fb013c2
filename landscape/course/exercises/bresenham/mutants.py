"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

SIDES = "    dx = abs(x1 - x0)\n    dy = abs(y1 - y0)\n"
NOTED = "        pixels.append((x, y))\n"
BEGIN = "    error = 2 * shorter - longer\n"
ASIDE = "            error -= 2 * longer\n"
AHEAD = "        error += 2 * shorter\n"
LAST = "            x += step_x\n\n    return pixels\n"
RETURN = "    return pixels\n"
TWO_STEPS = "            if steep:\n                x += step_x\n"
DIVIDED = """    count = max(abs(x1 - x0), abs(y1 - y0), 1)
    if (x0, y0) != (x1, y1):
        return [({x}, {y}) for k in range(count + 1)]
"""


def divided(x, y):
    """Return the solution's change for lines that are computed by division."""
    return [(SIDES, DIVIDED.format(x=x, y=y) + SIDES)]


MUTANTS = {
    "no_last": Mutant("leaves the loop one step early", "ends", [("longer + 1", "longer")]),
    "no_first": Mutant(
        "steps before it notes the pixel",
        "ends",
        [(NOTED, ""), (LAST, LAST.replace("    return", NOTED + "    return"))],
    ),
    "no_point": Mutant(
        "returns nothing for one pixel",
        "ends",
        [(SIDES, "    if (x0, y0) == (x1, y1):\n        return []\n" + SIDES)],
    ),
    "one_octant": Mutant(
        "knows only lines that are wider than high",
        "ends",
        [("    steep = dy > dx\n", "    steep = False\n")],
    ),
    "only_right": Mutant("goes only to the right", "ends", [("1 if x1 > x0 else -1", "1")]),
    "only_down": Mutant("goes only down", "ends", [("1 if y1 > y0 else -1", "1")]),
    "not_swapped_back": Mutant(
        "swaps x and y of steep lines, and not back",
        "ends",
        [(NOTED, "        pixels.append((y, x) if steep else (x, y))\n")],
    ),
    "row_first": Mutant("returns (y, x)", "ends", [(NOTED, "        pixels.append((y, x))\n")]),
    "never_smaller": Mutant("does not make the error smaller", "ends", [(ASIDE, "")]),
    "never_larger": Mutant("does not let the error grow", "ends", [(AHEAD, "")]),
    "half_slope": Mutant(
        "adds the shorter side only once", "ends", [(AHEAD, "        error += shorter\n")]
    ),
    "double_slope": Mutant(
        "takes the longer side off only once", "ends", [(ASIDE, "            error -= longer\n")]
    ),
    "no_half": Mutant("begins with an error of 0", "ends", [(BEGIN, "    error = 0\n")]),
    "gaps": Mutant(
        "computes a row for each column, also of steep lines",
        "whole",
        [
            (
                SIDES,
                """    if x0 != x1:
        slope, step = (y1 - y0) / (x1 - x0), (1 if x1 > x0 else -1)
        return [(x, y0 + round((x - x0) * slope)) for x in range(x0, x1 + step, step)]
"""
                + SIDES,
            )
        ],
    ),
    "too_late": Mutant(
        "cuts the fraction off",
        "close",
        divided("x0 + int(k * (x1 - x0) / count)", "y0 + int(k * (y1 - y0) / count)"),
    ),
    "too_early": Mutant(
        "begins with an error that is too large", "close", [(BEGIN, "    error = 2 * shorter\n")]
    ),
    "floored": Mutant(
        "divides by //",
        "close",
        divided("x0 + k * (x1 - x0) // count", "y0 + k * (y1 - y0) // count"),
    ),
    "stairs": Mutant(
        "notes a pixel between the two steps",
        "close",
        [(TWO_STEPS, TWO_STEPS + "                pixels.append((x, y))\n")],
    ),
    "last_twice": Mutant(
        "adds the end once more", "once", [(RETURN, "    return [*pixels, (x1, y1)]\n")]
    ),
    "first_twice": Mutant(
        "adds the beginning once more", "once", [("    pixels = []\n", "    pixels = [(x0, y0)]\n")]
    ),
    "backward": Mutant(
        "goes from the end to the beginning", "order", [(RETURN, "    return pixels[::-1]\n")]
    ),
    "left_to_right": Mutant(
        "swaps the ends of lines that lead to the left",
        "order",
        [(SIDES, "    if x0 > x1:\n        x0, y0, x1, y1 = x1, y1, x0, y0\n" + SIDES)],
    ),
}
