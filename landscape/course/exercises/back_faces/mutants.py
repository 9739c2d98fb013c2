"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

NORMAL = "normal = np.cross(b - a, c - a)"
SIGHT = "    sight = a\n"
RETURN = "return normal @ sight < 0"

MUTANTS = {
    "other_side": Mutant(
        "keeps the faces that are turned away", "towards", [(RETURN, "return normal @ sight > 0")]
    ),
    "nothing": Mutant(
        "takes the normal for the line of sight", "towards", [(SIGHT, "    sight = normal\n")]
    ),
    "nearer": Mutant("keeps what is near", "away", [(RETURN, "return (a + b + c)[2] > -9")]),
    "one_corner": Mutant(
        "keeps faces with a near corner", "away", [(RETURN, "return max(a[2], b[2], c[2]) > -2.7")]
    ),
    "rightward": Mutant(
        "takes x for the line of sight", "away", [(SIGHT, "    sight = np.array((-1, 0, 0))\n")]
    ),
    "upward": Mutant(
        "takes y for the line of sight", "away", [(SIGHT, "    sight = np.array((0, -1, 0))\n")]
    ),
    "wrong_product": Mutant(
        "mistakes a sign of the product",
        "away",
        [(NORMAL, "normal = np.cross(b - a, c - a) * (1, -1, 1)")],
    ),
    "steep": Mutant(
        "wants the face to be turned fully",
        "away",
        [(RETURN, "return normal @ sight < -2.2 * np.linalg.norm(normal)")],
    ),
    "middle": Mutant(
        "takes one line of sight for all", "sights", [(SIGHT, "    sight = np.array((0, 0, -1))\n")]
    ),
    "no_height": Mutant(
        "forgets the height of the line of sight",
        "sights",
        [(SIGHT, "    sight = np.array((a[0], 0, a[2]))\n")],
    ),
    "no_side": Mutant(
        "forgets the side of the line of sight",
        "sights",
        [(SIGHT, "    sight = np.array((0, a[1], a[2]))\n")],
    ),
    "eye_elsewhere": Mutant(
        "puts the camera elsewhere", "sights", [(SIGHT, "    sight = a - (2, 0, 0)\n")]
    ),
    "no_signs": Mutant(
        "forgets the signs of the line of sight", "sights", [(SIGHT, "    sight = -abs(a)\n")]
    ),
    "a_little": Mutant(
        "keeps faces that are turned away a little",
        "away",
        [(RETURN, "return normal @ sight < 1.5")],
    ),
}
