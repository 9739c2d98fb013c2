"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

STEPS = """\
    if distance < 16:
        return 1
    if distance < 32:
        return 2
    if distance < 64:
        return 4
    return 8
"""
KEPT = "    if step == 8 or x % (2 * step) == 0:\n        return HEIGHTS[x]\n"
BETWEEN = "    between = (HEIGHTS[x - step] + HEIGHTS[x + step]) / 2\n"
WEIGHT = "    weight = (distance - 12 * step) / (4 * step)\n"
CLIPPED = "    weight = min(max(weight, 0), 1)\n"
MIXED = "    return (1 - weight) * HEIGHTS[x] + weight * between\n"

MUTANTS = {
    "coarse": Mutant("takes the coarsest grid everywhere", "grid", [(STEPS, "    return 8\n")]),
    "reversed": Mutant(
        "is coarse near the camera",
        "grid",
        [
            (
                STEPS,
                "    return 8 if distance < 16 else 4 if distance < 32 else 2 if distance < 64 "
                "else 1\n",
            )
        ],
    ),
    "evenly": Mutant(
        "lets the step grow evenly", "grid", [(STEPS, "    return min(1 + distance // 16, 8)\n")]
    ),
    "no_limit": Mutant(
        "doubles without end",
        "grid",
        [(STEPS, STEPS.replace("    return 8\n", "    return 8 if distance < 128 else 16\n"))],
    ),
    "later": Mutant("begins one unit later", "grid", [(STEPS, STEPS.replace("<", "<="))]),
    "every_16": Mutant("doubles every 16 units", "grid", [(STEPS, STEPS.replace("64", "48"))]),
    "twice_as_far": Mutant(
        "doubles twice as far away",
        "grid",
        [(STEPS, STEPS.replace("64", "128").replace("32", "64").replace("16", "32"))],
    ),
    "no_glide": Mutant("does not glide", "glide", [(CLIPPED, "    weight = 0\n")]),
    "always": Mutant("always takes the mean", "glide", [(CLIPPED, "    weight = 1\n")]),
    "other_way": Mutant(
        "swaps the weights",
        "glide",
        [(MIXED, "    return weight * HEIGHTS[x] + (1 - weight) * between\n")],
    ),
    "all_glide": Mutant(
        "lets all vertices glide",
        "glide",
        [(KEPT, "    if step == 8:\n        return HEIGHTS[x]\n")],
    ),
    "wrong_ones": Mutant(
        "lets the others glide",
        "glide",
        [(KEPT, "    if step == 8 or x % (2 * step) != 0:\n        return HEIGHTS[x]\n")],
    ),
    "last_glides": Mutant(
        "lets the coarsest grid glide",
        "glide",
        [(KEPT, "    if x % (2 * step) == 0:\n        return HEIGHTS[x]\n")],
    ),
    "left_one": Mutant(
        "glides to one neighbour", "glide", [(BETWEEN, "    between = HEIGHTS[x - step]\n")]
    ),
    "nearest": Mutant(
        "takes the heights beside it",
        "glide",
        [(BETWEEN, "    between = (HEIGHTS[x - 1] + HEIGHTS[x + 1]) / 2\n")],
    ),
    "not_halved": Mutant(
        "takes the sum",
        "glide",
        [(BETWEEN, "    between = HEIGHTS[x - step] + HEIGHTS[x + step]\n")],
    ),
    "not_limited": Mutant("does not limit the weight", "glide", [(CLIPPED, "")]),
    "too_early": Mutant(
        "begins at the camera", "glide", [(WEIGHT, "    weight = distance / (16 * step)\n")]
    ),
    "whole_grid": Mutant(
        "begins with the grid",
        "glide",
        [(WEIGHT, "    weight = (distance - 8 * step) / (8 * step)\n")],
    ),
    "half_way": Mutant(
        "jumps half way", "glide", [(CLIPPED, CLIPPED + "    weight = round(weight)\n")]
    ),
}
