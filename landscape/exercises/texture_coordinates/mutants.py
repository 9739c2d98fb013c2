"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.mutants import Mutant

RIGHT = "((0, 1), (3, 1), (3, 0), (0, 0))"
REPEAT = "GL_TEXTURE_WRAP_S, GL_REPEAT"

MUTANTS = {
    "on_its_side": Mutant("swaps s and t", "upright", [
        (RIGHT, "((1, 0), (1, 3), (0, 3), (0, 0))")]),
    "mirrored": Mutant("lets s grow to the left", "direction", [
        (RIGHT, "((3, 1), (0, 1), (0, 0), (3, 0))")]),
    "once": Mutant("draws the picture once", "three", [
        (RIGHT, "((0, 1), (1, 1), (1, 0), (0, 0))")]),
    "a_third": Mutant("divides by three", "three", [
        (RIGHT, "((0, 1), (1 / 3, 1), (1 / 3, 0), (0, 0))")]),
    "both_directions": Mutant("repeats the picture upwards, too", "three", [
        (RIGHT, "((0, 3), (3, 3), (3, 0), (0, 0))")]),
    "clamped": Mutant("does not repeat the texture", "repeated", [
        (REPEAT, "GL_TEXTURE_WRAP_S, GL_CLAMP")]),
    "wrong_axis": Mutant("repeats t", "repeated", [
        (REPEAT, "GL_TEXTURE_WRAP_S, GL_CLAMP"),
        ("GL_TEXTURE_WRAP_T, GL_CLAMP", "GL_TEXTURE_WRAP_T, GL_REPEAT")]),
    "mirrored_repeat": Mutant("mirrors every second picture", "repeated", [
        (REPEAT, "GL_TEXTURE_WRAP_S, GL_MIRRORED_REPEAT")]),
    "half_a_boat": Mutant("begins in the middle of a boat", "picture", [
        (RIGHT, "((0.5, 1), (3.5, 1), (3.5, 0), (0.5, 0))")]),
}  # fmt: skip
