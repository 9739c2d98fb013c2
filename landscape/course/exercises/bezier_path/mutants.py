"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

FIRST = "    ab = a + t * (b - a)\n    bc = b + t * (c - b)\n    cd = c + t * (d - c)\n"
SECOND = "    abc = ab + t * (bc - ab)\n    bcd = bc + t * (cd - bc)\n"
THIRD = "    return abc + t * (bcd - abc)\n"
STEP = "        lengths.append(lengths[-1] + np.hypot(*(other - one)))\n"
WANTED = "    wanted = np.linspace(0, lengths[-1], COUNT)\n"
RETURN = "    return np.searchsorted(lengths, wanted - 1e-6)\n"


def curve(line):
    """Return the change that computes the points of a curve in another way."""
    return [(FIRST + SECOND + THIRD, f"    s = 1 - t\n    return {line}\n")]


MUTANTS = {
    "straight": Mutant("goes straight ahead", "curve", curve("s * a + t * d")),
    "backward": Mutant(
        "begins at the end",
        "curve",
        curve("t**3 * a + 3 * t**2 * s * b + 3 * t * s**2 * c + s**3 * d"),
    ),
    "no_threes": Mutant(
        "forgets the factors 3", "curve", curve("s**3 * a + s**2 * t * b + s * t**2 * c + t**3 * d")
    ),
    "no_squares": Mutant(
        "forgets the squares", "curve", curve("s**3 * a + 3 * s * t * b + 3 * s * t * c + t**3 * d")
    ),
    "swapped": Mutant(
        "swaps the control points in the middle", "curve", [(FIRST, "    b, c = c, b\n" + FIRST)]
    ),
    "three_points": Mutant(
        "leaves a control point out", "curve", curve("s**2 * a + 2 * s * t * b + t**2 * d")
    ),
    "two_steps": Mutant("stops after two steps", "curve", [(THIRD, "    return abc\n")]),
    "one_step": Mutant("stops after one step", "curve", [(SECOND + THIRD, "    return ab\n")]),
    "halves": Mutant(
        "divides in the middle in the end", "curve", [(THIRD, "    return (abc + bcd) / 2\n")]
    ),
    "not_divided": Mutant(
        "does not divide the second lines", "curve", [(SECOND, "    abc = ab\n    bcd = cd\n")]
    ),
    "equal_steps": Mutant(
        "takes equal steps of t",
        "speed",
        [(RETURN, "    return np.linspace(0, len(points) - 1, COUNT).round().astype(int)\n")],
    ),
    "no_end": Mutant(
        "does not reach the end",
        "speed",
        [(WANTED, "    wanted = np.linspace(0, lengths[-1], COUNT, endpoint=False)\n")],
    ),
    "no_beginning": Mutant(
        "leaves the beginning out",
        "speed",
        [(WANTED, "    wanted = np.linspace(0, lengths[-1], COUNT + 1)[1:]\n")],
    ),
    "only_x": Mutant(
        "measures to the right alone",
        "speed",
        [(STEP, "        lengths.append(lengths[-1] + abs(other[0] - one[0]))\n")],
    ),
    "only_y": Mutant(
        "measures upwards alone",
        "speed",
        [(STEP, "        lengths.append(lengths[-1] + abs(other[1] - one[1]))\n")],
    ),
    "no_root": Mutant(
        "takes no root",
        "speed",
        [(STEP, "        lengths.append(lengths[-1] + (other - one) @ (other - one))\n")],
    ),
    "both_added": Mutant(
        "adds the ways in x and y",
        "speed",
        [(STEP, "        lengths.append(lengths[-1] + abs(other - one).sum())\n")],
    ),
    "from_start": Mutant(
        "measures from the beginning",
        "speed",
        [(STEP, "        lengths.append(np.hypot(*(other - points[0])))\n")],
    ),
    "each_curve": Mutant(
        "divides each curve for itself",
        "speed",
        [
            (
                RETURN,
                "    half = (len(points) - 1) // 2\n"
                "    first = np.linspace(0, lengths[half], COUNT // 2)\n"
                "    second = np.linspace(lengths[half], lengths[-1], COUNT // 2)\n"
                "    return np.searchsorted(lengths, [*first - 1e-6, *second - 1e-6])\n",
            )
        ],
    ),
}
