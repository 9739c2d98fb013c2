"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

PADDED = "    padded = np.pad(SOLID, 1)  # false all around\n"
BESIDE = "np.roll(padded, -step, axis)[1:-1, 1:-1, 1:-1]"
KEPT = "np.argwhere(SOLID & ~beside)"
STEPS = "for step in (1, -1):"
FIRST, SECOND = "side[[1, 2], (axis + 1) % 3]", "side[[2, 3], (axis + 2) % 3]"
ADDED = "faces.append(cubes[:, None] + side[::step])"

MUTANTS = {
    "no_culling": Mutant("turns culling off", "culled", [("    glEnable(GL_CULL_FACE)\n", "")]),
    "front_face": Mutant(
        "makes the clockwise side the front",
        "culled",
        [("    glEnable(GL_CULL_FACE)\n", "    glEnable(GL_CULL_FACE)\n    glFrontFace(GL_CW)\n")],
    ),
    "flat": Mutant(
        "moves the corners along one direction only",
        "squares",
        [(SECOND, "side[[2, 3], (axis + 1) % 3]")],
    ),
    "crossed": Mutant(
        "goes over the diagonal",
        "squares",
        [(SECOND, SECOND.replace("2, 3", "1, 3")), (FIRST, FIRST.replace("1, 2", "2, 3"))],
    ),
    "all": Mutant("keeps all faces", "only_exposed", [(KEPT, "np.argwhere(SOLID)")]),
    "only_hidden": Mutant(
        "keeps the hidden faces", "only_exposed", [(KEPT, KEPT.replace("~", ""))]
    ),
    "wrong_side": Mutant(
        "compares with the cube behind", "only_exposed", [(BESIDE, BESIDE.replace("-step", "step"))]
    ),
    "other_axis": Mutant(
        "moves along another axis",
        "only_exposed",
        [(BESIDE, BESIDE.replace("axis)", "(axis + 1) % 3)"))],
    ),
    "not_moved": Mutant(
        "draws all at the near side",
        "only_exposed",
        [("            side[:, axis] = step == 1\n", "")],
    ),
    "two_axes": Mutant(
        "forgets an axis", "directions", [("for axis in range(3)", "for axis in range(2)")]
    ),
    "one_side": Mutant("forgets the other side", "directions", [(STEPS, "for step in (1,):")]),
    "wrapped": Mutant(
        "lets np.roll wrap around", "whole", [(BESIDE, "np.roll(SOLID, -step, axis)")]
    ),
    "edge": Mutant(
        "takes what is around for solid",
        "whole",
        [(PADDED, PADDED.replace("1)", "1, constant_values=True)"))],
    ),
    "of_air": Mutant(
        "takes the faces of the air", "whole", [(KEPT, KEPT.replace("SOLID & ~", "~SOLID & "))]
    ),
    "underside": Mutant(
        "leaves out what lies on the table",
        "whole",
        [
            (
                ADDED,
                "if (axis, step) == (1, -1):\n                cubes = cubes[cubes[:, 1] > 0]\n"
                "            " + ADDED,
            )
        ],
    ),
    "twice": Mutant(
        "adds each face twice", "once", [(ADDED, "faces += 2 * [cubes[:, None] + side[::step]]")]
    ),
    "half": Mutant("does not turn the order round", "order", [("side[::step]", "side")]),
    "clockwise": Mutant("orders all clockwise", "order", [("side[::step]", "side[::-step]")]),
    "one_axis": Mutant(
        "swaps the two directions of one axis",
        "order",
        [("side[::step]", "side[:: -step if axis == 1 else step]")],
    ),
}
