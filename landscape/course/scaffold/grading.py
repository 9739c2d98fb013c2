# The tests of the exercise, in the order in which they are made. Each is a function that looks at
# what the student's program (work) and the first solution (solution) have drawn. It returns None if
# all is well, or a hint. Students get this file, so a hint may say what is wrong, not what to type.
# What a test can look at stands in docs/exercises.md, "The files of an exercise".

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.mistakes import balanced

# The frames that are looked at; the first is 0. Keep them few: each is recorded whole.
FRAMES = (0, 2, 4)
# What the user does meanwhile: here the key Right once before frame 2, twice before frame 4. There
# are also "move", "button", "scroll" and "resize": [640, 480].
EVENTS = [{"frame": frame, "key": "RIGHT"} for frame in (2, 4, 4)]
TURNED = {0: 0, 2: 30, 4: 90}  # degrees, in each frame
DIAL = np.array((0.4, -0.2))
NEAR = 0.02  # how far a point may be from where it should be


def hands(work, number):
    """Return the draws of a frame that are hands."""
    # Parts are found by their shape or size, not by the order in which they are drawn.
    return [draw for draw in work.frame(number).draws if len(draw.vertices) == 3]


def hand(work, number):
    """Return where the hand begins and ends in a frame, two points."""
    left, right, tip = hands(work, number)[0].eye[:, :2]
    return (left + right) / 2, tip


def angle(points):
    """Return by how many degrees a hand is turned clockwise."""
    x, y = points[1] - points[0]
    return np.degrees(np.arctan2(x, y))


def apart(one, other):
    """Return how many degrees two angles are apart."""
    return abs((one - other + 180) % 360 - 180)


# @test has the test's name, which students read, and why it matters. `points=2` makes it worth two
# points; `demanded=True` says that the task itself names what is tested, so that a program whose
# picture is right without it fails all the same. _(...) marks a text for the French catalogue.
@test(
    _("There is one hand"),
    _("It is drawn once in each frame, by draw_hand or by triangles of your own."),
)
def drawn(work, solution):
    for number in FRAMES:
        found = hands(work, number)
        if not found:
            return hint(_("In frame {frame} there is no hand on the dial."), frame=number)
        if len(found) > 1:
            return hint(_("Line {line} draws a second hand."), line=found[1].line)
    return None


# This test is only made if `drawn` has passed: otherwise its hint would mislead.
@test(
    _("The hand begins in the dial's middle"),
    _("A rotation turns about the origin: where that is, the calls before it decide."),
    needs=drawn,
)
def placed(work, solution):
    begins = {number: hand(work, number)[0] for number in FRAMES}
    if all(np.abs(begins[number] - DIAL).max() < NEAR for number in FRAMES):
        return None
    if all(np.abs(begin).max() < NEAR for begin in begins.values()):
        return hint(_("The hand begins at the origin: something must carry it to the dial."))
    if np.abs(begins[0] - DIAL).max() < NEAR:
        return hint(
            _(
                "The hand leaves the dial when it turns: it goes around the middle of the window. "
                "In which order is it turned and moved?"
            )
        )
    return hint(_("In frame 0 the hand begins somewhere else, not in the dial's middle."))


@test(
    _("The hand turns clockwise"),
    _("A positive angle turns counter-clockwise, as seen from the side of the axis."),
    needs=placed,
    points=2,
)
def turns(work, solution):
    found = {number: angle(hand(work, number)) for number in FRAMES}
    if all(apart(found[number], TURNED[number]) < 2 for number in FRAMES):
        return None
    if all(apart(found[number], -TURNED[number]) < 2 for number in FRAMES):
        return hint(_("The hand turns counter-clockwise."))
    if all(apart(found[number], np.radians(TURNED[number])) < 2 for number in FRAMES):
        return hint(_("The hand hardly moves: the angle is in degrees already."))
    return hint(
        _("In frame {frame} the hand is turned by {angle:.0f} degrees instead of {wanted}."),
        frame=max(FRAMES),
        angle=found[max(FRAMES)],
        wanted=TURNED[max(FRAMES)],
    )


# Every exercise has this test, of the whole picture, as the last or nearly the last. Its hint says
# in which part of the picture the difference is: left, top, right, bottom, from 0 to 1.
@test(
    _("The picture is right"),
    _("Nothing else has moved, and nothing is missing."),
    needs=(drawn, placed, turns),
)
def picture(work, solution):
    marks = [draw for draw in work.last.draws if draw.mode == "GL_QUADS"]
    if marks and np.abs(marks[0].eye[0, :2] - (-0.95, 0.75)).max() > NEAR:
        return hint(
            _("Line {line} draws the mark, which has moved with the hand."), line=marks[0].line
        )
    return compare(work, solution, regions={_("the mark in the corner"): (0, 0, 0.3, 0.3)})


# A test that comes ready-made: what is pushed is popped.
stacks = balanced(picture)
