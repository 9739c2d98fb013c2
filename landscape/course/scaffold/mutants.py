# Mistakes that students make, by which the tests are tested: `landscape exercise test` changes
# solution.py as each says, and looks at which test fails first. There must be at least four, and
# each must get a hint of its own. Students never see this file.
# A mistake is what it is, the name of the test that should fail, and the changes: (old, new). The
# old text stands in solution.py exactly once.

from landscape.course.grader.mutants import Mutant

PUSH = "    glPushMatrix()\n"
MOVE = "    glTranslatef(*DIAL, 0)\n"
TURN = "    glRotatef(-turned, 0, 0, 1)\n"
SHOW = "    draw_hand()\n"
ASIDE = "    glRotatef(90, 0, 0, 1)\n"

MUTANTS = {
    "twice": Mutant("draws two hands", "drawn", [(SHOW, SHOW + ASIDE + SHOW)]),
    "not_moved": Mutant("leaves the hand at the origin", "placed", [(MOVE, "")]),
    "order": Mutant("turns about the middle of the window", "placed", [(MOVE + TURN, TURN + MOVE)]),
    "wrong_way": Mutant("turns counter-clockwise", "turns", [("-turned", "turned")]),
    "radians": Mutant("turns by radians", "turns", [("-turned", "math.radians(-turned)")]),
    "not_popped": Mutant("leaves the mark turned", "picture", [("    glPopMatrix()\n", "")]),
    "pushed_twice": Mutant("pushes once more than it pops", "stacks", [(PUSH, PUSH + PUSH)]),
}
