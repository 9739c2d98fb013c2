"""The tests of the exercise matrix_stack."""

import numpy as np

from landscape.course.grader.grading import _, between, compare, hint, test

FRAMES = (0, 2)
EVENTS = [{"frame": 2, "key": key} for key in ("LEFT", "LEFT", "LEFT", "UP")]
UPPER_ARM = (0.6, 2.2, 0.6)  # width, height, depth
FOREARM = (0.5, 1.8, 0.5)
WRIST = (1, 0.15, 0.5)
FINGER = (0.18, 0.9, 0.4)
LAMP = (0.15, 1.3, 0.15)
BASE = (1.8, 0.4, 1.8)
FLOOR = (6.5, 0.2, 4.5)
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
    return frames_of(work, number, WRIST)[0]


def same(a, b):
    return np.abs(a - b).max() < NEAR


def depth_at_end(work, number):
    """Return by how many the pushes of a frame exceed its pops."""
    frame = work.frame(number)
    return len(frame.find("glPushMatrix")) - len(frame.find("glPopMatrix"))


def lamp_first(work):
    """Return whether the lamp is drawn before the arm."""
    draws = work.frame(0).draws
    found = [draws.index(each) for size in (LAMP, BASE) for each in parts(work, 0, size)[:1]]
    return len(found) == 2 and found[0] < found[1]


def left_open(calls):
    """Return the glPushMatrix calls that no glPopMatrix has taken back, in order."""
    found = []
    for call in calls:
        if call.name == "glPushMatrix":
            found.append(call)
        elif call.name == "glPopMatrix":
            del found[-1:]
    return found


@test(
    _("The arm itself is as it was"),
    _("Base, upper arm, forearm and wrist each carry the next part; nothing of that changes."),
)
def arm(work, solution):
    sizes = {
        _("the upper arm"): UPPER_ARM,
        _("the forearm"): FOREARM,
        _("the wrist"): WRIST,
    }
    for name, size in sizes.items():
        for number in FRAMES:
            ours, found = frames_of(solution, number, size), frames_of(work, number, size)
            if not found:
                return hint(_("There is a part that is not drawn any more: {part}."), part=name)
            if not same(found[0], ours[0]):
                if number == FRAMES[-1] and depth_at_end(work, 0) < 0:
                    break
                if lamp_first(work):
                    return hint(
                        _(
                            "The lamp is drawn before the arm now, so the arm stands in the lamp's "
                            "frame. Leave the order of the calls as it was."
                        )
                    )
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
        first, second = (calls.index(draw.call) for draw in draws)
        names = [call.name for call in calls[first:second]]
        if "glLoadIdentity" in names:
            return hint(
                _(
                    "glLoadIdentity goes back to the eye, and not to the wrist: the frame of the "
                    "wrist must be kept by glPushMatrix."
                )
            )
        if "glPopMatrix" in names and "glPushMatrix" not in names:
            return hint(
                _(
                    "glPopMatrix before the second finger goes back too far: the glPushMatrix that "
                    "belongs to it stands before the wrist. Push right before the first finger."
                )
            )
        if "glPopMatrix" in names:
            return hint(
                _(
                    "Between the fingers there is a pop, but a push that does not belong to "
                    "it: push "
                    "before the first finger, pop after it."
                )
            )
        wrist_drawn = parts(work, number, WRIST)[0]
        own = np.linalg.inv(wrist_drawn.modelview)
        if not any(same(found[1], found[0] @ own @ our) for our in ours):
            return hint(
                _(
                    "The second finger does not begin at the wrist: what is called {place} does "
                    "not lead back there. The stack does that without computing."
                ),
                place=between(*draws),
            )
        pushed = calls[calls.index(wrist_drawn.call) : first]
        if any(call.name == "glPushMatrix" for call in pushed):
            return hint(
                _(
                    "The second finger still stands on the first one: glPopMatrix is missing "
                    "{place}."
                ),
                place=between(*draws),
            )
        if not work.frame(number).find("glPushMatrix"):
            return hint(
                _(
                    "No matrix is kept yet. Begin with the fingers: the second one needs the "
                    "matrix "
                    "that was current before the first one. Where is it to be kept, and where "
                    "to be "
                    "taken back?"
                ),
            )
        return hint(
            _(
                "The second finger stands on the first one: glPushMatrix is missing {push}, and "
                "glPopMatrix {pop}."
            ),
            push=between(wrist_drawn, draws[0]),
            pop=between(*draws),
        )

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
    base = parts(work, 0, BASE)[0]
    inside = np.linalg.inv(base.modelview) @ found[0]
    if same(inside[:3, 3], np.array((-2.3, 0, 0.6))):
        return hint(
            _(
                "The lamp turns with the base: the glPushMatrix that belongs to the last "
                "glPopMatrix "
                "stands after the base's rotation. Push {place}."
            ),
            place=between(parts(work, 0, FLOOR)[0], base),
        )

    if work.frame(0).find("glLoadIdentity"):
        return hint(
            _(
                "glLoadIdentity before the lamp goes back to the eye, and not to where the base "
                "began."
            )
        )

    carried = [
        draw.modelview
        for size in (BASE, UPPER_ARM, FOREARM, WRIST, FINGER)
        for draw in parts(work, 0, size)
    ]
    own = np.linalg.inv(parts(work, 0, FLOOR)[0].modelview) @ ours[0]
    if not any(same(found[0], frame @ own) for frame in carried):
        return hint(
            _(
                "The lamp does not stand beside the base: what is called {place} does not lead "
                "back to where the base began. The stack does that without computing."
            ),
            place=between(parts(work, 0, FINGER)[-1], parts(work, 0, LAMP)[0]),
        )

    calls = work.frame(0).calls
    pushed = left_open(calls[: calls.index(parts(work, 0, LAMP)[0].call)])
    if pushed:
        return hint(
            _(
                "The lamp is drawn in a frame of the arm: the glPushMatrix in line {line} still "
                "waits for its glPopMatrix, {place}."
            ),
            line=pushed[0].line,
            place=between(parts(work, 0, FINGER)[-1], parts(work, 0, LAMP)[0]),
        )

    return hint(
        _(
            "The lamp is drawn in a frame of the arm: glPopMatrix is missing {place}, or it "
            "belongs "
            "to another glPushMatrix."
        ),
        place=between(parts(work, 0, FINGER)[-1], parts(work, 0, LAMP)[0]),
    )


@test(
    _("Every glPushMatrix has its glPopMatrix"),
    _("The stack has room for 32 matrices: a push too many in each frame soon fills it."),
    needs=lamp,
)
def balanced(work, solution):
    depth = depth_at_end(work, 2)
    if depth > 0:
        return hint(
            _(
                "Each frame pushes {count} more than it pops, and after some frames the stack is "
                "full: GL_STACK_OVERFLOW."
            ),
            count=depth,
        )
    return None


@test(
    _("Only pushes and pops were added"),
    _("A transformation that is taken back by its inverse adds its rounding errors in each frame."),
    needs=lamp,
    demanded=True,
)
def unchanged(work, solution):
    kinds = ("glTranslate", "glRotate", "glScale")
    for kind in kinds:
        ours, found = (each.frame(0).find(kind) for each in (solution, work))
        known = {line.strip() for line in solution.source}
        for call in found if len(found) > len(ours) else ():
            if work.text(call.line) not in known:
                return hint(
                    _(
                        "{name} in line {line} takes a transformation back. The stack does that "
                        "without computing: keep the matrix before, and take it back after."
                    ),
                    name=call.name,
                    line=call.line,
                )
    return None


@test(
    _("The picture is right"),
    _("At first, and after the base has turned and the elbow is straighter."),
    needs=balanced,
)
def picture(work, solution):
    return compare(work, solution)
