"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

RETURN = "    return math.cos(v) * math.cos(u), math.cos(v) * math.sin(u), math.sin(v)\n"
CALLS = "                glNormal3f(*normal(u, v))\n                glVertex3f(*point(u, v))\n"

MUTANTS = {
    "of_a_ball": Mutant(
        "takes the direction from the centre",
        "direction",
        [
            (
                RETURN,
                "    x, y, z = point(u, v)\n    length = math.hypot(x, y, z)\n"
                "    return x / length, y / length, z / length\n",
            )
        ],
    ),
    "inward": Mutant(
        "lets the normals point inward",
        "direction",
        [(RETURN, RETURN.replace("return ", "return -").replace(", math", ", -math"))],
    ),
    "only_u": Mutant(
        "forgets the angle v", "direction", [(RETURN, "    return math.cos(u), math.sin(u), 0\n")]
    ),
    "swapped_v": Mutant(
        "swaps sine and cosine of v",
        "direction",
        [
            (
                RETURN,
                "    return math.sin(v) * math.cos(u), math.sin(v) * math.sin(u), math.cos(v)\n",
            )
        ],
    ),
    "swapped_u": Mutant(
        "swaps sine and cosine of u",
        "direction",
        [
            (
                RETURN,
                "    return math.cos(v) * math.sin(u), math.cos(v) * math.cos(u), math.sin(v)\n",
            )
        ],
    ),
    "after_the_vertex": Mutant(
        "calls glNormal after glVertex",
        "direction",
        [(CALLS, "".join(reversed(CALLS.splitlines(keepends=True))))],
    ),
    "length_of_the_tube": Mutant(
        "does not divide by the radius",
        "length",
        [
            (
                RETURN,
                RETURN.replace("return ", "x, y, z = ")
                + "    return TUBE * x, TUBE * y, TUBE * z\n",
            )
        ],
    ),
    "other_points": Mutant(
        "changes the points as well", "lit", [("TUBE * math.sin(v)\n", "-TUBE * math.sin(v)\n")]
    ),
    "uneven": Mutant(
        "gives each normal another length",
        "length",
        [
            (
                RETURN,
                RETURN.replace("return ", "x, y, z = ")
                + "    k = 1.3 + 0.3 * math.cos(v)\n    return k * x, k * y, k * z\n",
            )
        ],
    ),
}
