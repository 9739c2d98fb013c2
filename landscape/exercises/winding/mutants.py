"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.mutants import Mutant

CULL = "    glEnable(GL_CULL_FACE)\n"

MUTANTS = {
    "no_culling": Mutant("turns culling off", "culled", [(CULL, "")]),
    "other_front": Mutant("declares the other side to be the front", "front", [
        (CULL, CULL + "    glFrontFace(GL_CW)\n")]),
    "cull_front": Mutant("culls the front faces", "front", [
        (CULL, CULL + "    glCullFace(GL_FRONT)\n")]),
    "left_out": Mutant("leaves a wrong face out", "twelve", [(" (TOP, 2, 3),", "")]),
    "both_orders": Mutant("lists the wrong faces in both orders", "twelve", [
        ("(TOP, 2, 3),", "(TOP, 2, 3), (TOP, 3, 2),")]),
    "begun_elsewhere": Mutant("begins a wrong face at another corner", "order", [
        ("(TOP, 2, 3)", "(3, 2, TOP)")]),
    "no_face": Mutant("names a point that the face does not have", "order", [
        ("(TOP, 2, 3)", "(TOP, 2, 8)")]),
    "one_of_two": Mutant("finds one of the two", "order", [("(BOTTOM, 5, 4)", "(BOTTOM, 4, 5)")]),
    "other_half": Mutant("lists the lower faces like the upper ones", "order", [
        ("(BOTTOM, 1, 0), (BOTTOM, 2, 1), (BOTTOM, 3, 2), (BOTTOM, 4, 3), (BOTTOM, 5, 4), "
         "(BOTTOM, 0, 5)",
         "(BOTTOM, 0, 1), (BOTTOM, 1, 2), (BOTTOM, 2, 3), (BOTTOM, 3, 4), (BOTTOM, 4, 5), "
         "(BOTTOM, 5, 0)")]),
    "wrong_ones": Mutant("turns two other faces round as well", "order", [
        ("(TOP, 0, 1)", "(TOP, 1, 0)"), ("(TOP, 1, 2)", "(TOP, 2, 1)"),
        ("(TOP, 2, 3)", "(TOP, 3, 2)")]),
}  # fmt: skip
