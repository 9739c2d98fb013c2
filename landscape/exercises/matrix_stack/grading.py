"""The tests of the exercise matrix_stack."""

import numpy as np

from landscape.course.grading import _, compare, hint, test

FRAMES = (0, 2)
EVENTS = [{"frame": 2, "key": key} for key in ("LEFT", "LEFT", "LEFT", "UP")]
FINGER = (0.18, 0.9, 0.4)  # width, height, depth
LAMP = (0.15, 1.3, 0.15)
NEAR = 0.03  # chosen: units by which a part may be elsewhere


def parts(work, number, size):
    """Return the draws of the boxes of a size, by their object coordinates."""
    found = []
    for draw in work.frame(number).draws:
        if len(draw.vertices):
            points = draw.vertices[:, :3]
            if np.allclose(points.max(axis=0) - points.min(axis=0), size, atol=0.01):
                found.append(draw)
    return found


def frames_of(work, number, size):
    """Return the modelview matrices of those boxes."""
    return [draw.modelview for draw in parts(work, number, size)]


def wrist(work, number):
    """Return the modelview matrix with which the wrist is drawn."""
    return frames_of(work, number, (1, 0.15, 0.5))[0]


def same(a, b):
    return np.abs(a - b).max() < NEAR


def depth_at_end(work, number):
    """Return by how many the pushes of a frame exceed its pops."""
    frame = work.frame(number)
    return len(frame.find("glPushMatrix")) - len(frame.find("glPopMatrix"))


@test(
    _("The arm itself is as it was"),
    _("Base, upper arm, forearm and wrist each carry the next part; nothing of that changes."),
)
def arm(work, solution):
    sizes = {
        _("the upper arm"): (0.6, 2.2, 0.6),
        _("the forearm"): (0.5, 1.8, 0.5),
        _("the wrist"): (1, 0.15, 0.5),
    }
    for name, size in sizes.items():
        for number in FRAMES:
            ours, found = frames_of(solution, number, size), frames_of(work, number, size)
            if not found:
                return hint(_("There is a part that is not drawn any more: {part}."), part=name)
            if not same(found[0], ours[0]):
                if number == FRAMES[-1] and depth_at_end(work, 0) < 0:
                    break
                return hint(
                    _(
                        "A part is no longer where it was: {part}. Between it and the part that "
                        "carries it there must be neither glPushMatrix nor glPopMatrix."
                    ),
                    part=name,
                )
    return None


@test(
    _("Each finger begins at the wrist"),
    _("The first finger's translation and rotation must not hold for the second one."),
    needs=arm,
)
def fingers(work, solution):
    for number in FRAMES:
        ours, found = frames_of(solution, number, FINGER), frames_of(work, number, FINGER)
        if len(found) != 2:
            return hint(_("{count} fingers are drawn, and not two."), count=len(found))
        wrong = [m for m in found if not any(same(m, our) for our in ours)]
        if not wrong:
            continue
        draws = parts(work, number, FINGER)
        calls = work.frame(number).calls
        between = calls[calls.index(draws[0].call) : calls.index(draws[1].call)]
        names = [call.name for call in between]
        if "glLoadIdentity" in names:
            return hint(
                _("glLoadIdentity goes back to the eye, and not to the wrist: the frame of the "
                  "wrist must be kept by glPushMatrix.")
            )  # fmt: skip
        if "glPopMatrix" in names and "glPushMatrix" not in names:
            return hint(
                _("glPopMatrix before the second finger goes back too far: the glPushMatrix that "
                  "belongs to it stands before the wrist. Push right before the first finger.")
            )  # fmt: skip
        if "glPopMatrix" in names:
            return hint(
                _("Between the fingers there is a pop, but a push that does not belong to it: push "
                  "before the first finger, pop after it.")
            )  # fmt: skip
        if work.frame(number).find("glPushMatrix"):
            return hint(
                _("The second finger still stands on the first one: glPopMatrix is missing between "
                  "draw_finger(-1) and draw_finger(1).")
            )  # fmt: skip
        return hint(
            _("The second finger stands on the first one: there is no glPushMatrix before "
              "draw_finger(-1), and no glPopMatrix after it.")
        )  # fmt: skip
    return None


@test(
    _("The lamp stands beside the base"),
    _("It is not a part of the arm: it must not turn with it."),
    needs=fingers,
)
def lamp(work, solution):
    ours, found = frames_of(solution, 0, LAMP), frames_of(work, 0, LAMP)
    if not found:
        return hint(_("The lamp is not drawn any more."))
    if same(found[0], ours[0]):
        return None
    base = frames_of(work, 0, (1.8, 0.4, 1.8))[0]
    inside = np.linalg.inv(base) @ found[0]
    if same(inside[:3, 3], np.array((-2.3, 0, 0.6))):
        return hint(
            _("The lamp turns with the base: the glPushMatrix that belongs to the last glPopMatrix "
              "stands after the base's rotation. Push before draw_arm().")
        )  # fmt: skip
    if work.frame(0).find("glLoadIdentity"):
        return hint(
            _("glLoadIdentity before the lamp goes back to the eye, and not to where the base "
              "began.")
        )  # fmt: skip
    return hint(
        _("The lamp is drawn in a frame of the arm: glPopMatrix is missing between draw_arm() and "
          "draw_lamp(), or it belongs to another glPushMatrix.")
    )  # fmt: skip


@test(
    _("Every glPushMatrix has its glPopMatrix"),
    _("The stack has room for 32 matrices: a push too many in each frame soon fills it."),
    needs=lamp,
)
def balanced(work, solution):
    depth = depth_at_end(work, 2)
    if depth > 0:
        return hint(
            _("Each frame pushes {count} more than it pops, and after some frames the stack is "
              "full: GL_STACK_OVERFLOW."),
            count=depth,
        )  # fmt: skip
    return None


@test(
    _("The picture is right"),
    _("At first, and after the base has turned and the elbow is straighter."),
    needs=balanced,
)
def picture(work, solution):
    return compare(work, solution)
