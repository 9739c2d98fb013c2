"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

PUSH, POP = "    glPushMatrix()\n", "    glPopMatrix()\n"
LEFT, RIGHT = "    draw_finger(-1)\n", "    draw_finger(1)\n"
WRIST = "    draw_box(0, 0, 0, 1, 0.15, 0.5, (0.25, 0.6, 0.6))\n"
ARM, LAMP = "    draw_arm()\n", "    draw_lamp()\n"

MUTANTS = {
    "fingers_forgotten": Mutant("forgets the fingers", "fingers", [(PUSH + LEFT + POP, LEFT)]),
    "no_pop": Mutant(
        "pushes before the finger and never pops", "fingers", [(PUSH + LEFT + POP, PUSH + LEFT)]
    ),
    "push_too_early": Mutant(
        "pushes before the wrist's translation",
        "fingers",
        [
            ("    glTranslatef(0, 1.8, 0)\n", PUSH + "    glTranslatef(0, 1.8, 0)\n"),
            (PUSH + LEFT, LEFT),
        ],
    ),
    "identity": Mutant(
        "goes back by glLoadIdentity",
        "fingers",
        [(PUSH + LEFT + POP, LEFT + "    glLoadIdentity()\n")],
    ),
    "inverse": Mutant(
        "takes the finger's transformations back one by one",
        "unchanged",
        [(PUSH + LEFT + POP, LEFT + "    glRotatef(-25, 0, 0, 1)\n    glTranslatef(0.35, 0, 0)\n")],
    ),
    "inverse_order": Mutant(
        "takes the finger's transformations back in their own order",
        "fingers",
        [(PUSH + LEFT + POP, LEFT + "    glTranslatef(0.35, 0, 0)\n    glRotatef(-25, 0, 0, 1)\n")],
    ),
    "lamp_turned_back": Mutant(
        "takes only the base's rotation back for the lamp",
        "lamp",
        [(PUSH + ARM + POP, ARM + "    glRotatef(-turn, 0, 1, 0)\n")],
    ),
    "lamp_first": Mutant("draws the lamp first", "arm", [(PUSH + ARM + POP + LAMP, LAMP + ARM)]),
    "lamp_never_popped": Mutant(
        "pushes before the arm and never pops", "lamp", [(PUSH + ARM + POP, PUSH + ARM)]
    ),
    "lamp_forgotten": Mutant("forgets the lamp", "lamp", [(PUSH + ARM + POP, ARM)]),
    "lamp_on_the_base": Mutant(
        "pushes after the base's rotation",
        "lamp",
        [
            (PUSH + ARM, ARM),
            ("    glRotatef(turn, 0, 1, 0)\n", "    glRotatef(turn, 0, 1, 0)\n" + PUSH),
        ],
    ),
    "lamp_identity": Mutant(
        "goes back to the eye for the lamp",
        "lamp",
        [(PUSH + ARM + POP, ARM + "    glLoadIdentity()\n")],
    ),
    "push_too_many": Mutant("pushes once more than it pops", "balanced", [(LAMP, PUSH + LAMP)]),
    "between_the_parts": Mutant(
        "pops between the upper arm and the forearm",
        "arm",
        [
            ("    glTranslatef(0, 0.4, 0)\n", PUSH + "    glTranslatef(0, 0.4, 0)\n"),
            ("    glTranslatef(0, 2.2, 0)\n", POP + "    glTranslatef(0, 2.2, 0)\n"),
        ],
    ),
}
