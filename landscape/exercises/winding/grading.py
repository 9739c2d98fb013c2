"""The tests of the exercise winding."""

import numpy as np

from landscape.course.grading import _, compare, hint, test

FRAMES = (0, 1, 2, 3)  # a turn by quarters shows every face
EVENTS = [{"frame": frame, "key": "RIGHT"} for frame in (1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 3, 3, 3, 3)]
TOP, BOTTOM = 1.1, -1.9  # heights of the two tips
NAMES = {TOP: "TOP", BOTTOM: "BOTTOM"}


def triangles(work):
    """Return the gem's triangles, (n, 3, 3): object coordinates of their corners."""
    points = [draw.vertices[:, :3] for draw in work.frame(0).draws if draw.mode == "GL_TRIANGLES"]
    return np.concatenate(points).reshape(-1, 3, 3) if points else np.zeros((0, 3, 3))


def outward(triangle):
    """Return whether a triangle is counter-clockwise from outside the gem, which is convex."""
    normal = np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0])
    return normal @ (triangle.mean(axis=0) - (0, -0.2, 0)) > 0


def corners(triangle):
    """Return a triangle as FACES lists it, such as (TOP, 2, 3)."""
    names = []
    for x, y, z in triangle:
        tip = next((name for height, name in NAMES.items() if abs(y - height) < 0.01), None)
        names.append(tip or str(round(np.degrees(np.arctan2(-z, x)) / 60) % 6))
    return f"({', '.join(names)})"


def corner_set(face):
    """Return the corners of a face without their order."""
    return frozenset(face.strip("()").split(", "))


AS_GIVEN = "(TOP, 3, 2)", "(BOTTOM, 4, 5)"
TO_MEND = set(map(corner_set, AS_GIVEN))


def whole(face):
    """Return whether a face has one tip and two neighbouring points of the ring."""
    ring = [int(corner) for corner in corner_set(face) if corner.isdigit()]
    return len(corner_set(face)) == 3 and len(ring) == 2 and abs(ring[0] - ring[1]) in (1, 5)


@test(
    _("Faces that look away are still left out"),
    _("Without culling both sides of a face are drawn, and a wrong order cannot be seen."),
)
def culled(work, solution):
    for number in FRAMES:
        for draw in work.frame(number).draws:
            if draw.mode == "GL_TRIANGLES" and not draw.state["GL_CULL_FACE"]:
                return hint(
                    _(
                        "GL_CULL_FACE is off while the gem is drawn: that hides the mistake and "
                        "does not mend it. Turn it on again."
                    )
                )
    return None


@test(
    _("The front is still the counter-clockwise side"),
    _("The ten other faces are right as they are; the two wrong ones must become like them."),
    needs=culled,
)
def front(work, solution):
    state = work.frame(0).draws[-1].state
    if state["GL_FRONT_FACE"] != "GL_CCW":
        line = work.find("glFrontFace")[-1].line
        return hint(
            _(
                "glFrontFace(GL_CW) in line {line} swaps front and back of all faces: now ten are "
                "wrong, and not two."
            ),
            line=line,
        )
    if state["GL_CULL_FACE_MODE"] != "GL_BACK":
        line = work.find("glCullFace")[-1].line
        return hint(
            _(
                "glCullFace({mode}) in line {line} leaves out other faces than those that look "
                "away: one sees the gem from inside, or not at all."
            ),
            mode=state["GL_CULL_FACE_MODE"],
            line=line,
        )
    return None


@test(
    _("Twelve triangles are drawn"),
    _("Each face once: one that is listed in both orders would never be culled."),
    needs=front,
)
def twelve(work, solution):
    count = len(triangles(work))
    if count < 12:
        return hint(
            _("Only {count} triangles are drawn: a face with the wrong order is to be turned "
              "round, and not left out."),
            count=count,
        )  # fmt: skip
    if count > 12:
        return hint(
            _("{count} triangles are drawn: a face that is listed in both orders is always "
              "visible, from behind as well."),
            count=count,
        )  # fmt: skip
    return None


@test(
    _("Every triangle is counter-clockwise from outside"),
    _("Then the cross product of two edges points outward."),
    needs=twelve,
)
def order(work, solution):
    wrong = [corners(each) for each in triangles(work) if not outward(each)]
    if not wrong:
        return None
    strange = [each for each in wrong if not whole(each)]
    if strange:
        return hint(
            _("{face} is drawn, which is no face of the gem: each has one tip and two neighbouring "
              "points of the ring."),
            face=strange[0],
        )  # fmt: skip
    begun = [each for each in wrong if corner_set(each) in TO_MEND and each not in AS_GIVEN]
    if begun and len(wrong) <= 2:
        return hint(
            _("{face} goes round as before and only begins at another corner. Two of its corners "
              "must change places."),
            face=begun[0],
        )  # fmt: skip
    if len(wrong) == 1:
        return hint(_("One face is still clockwise as seen from outside: {face}."), face=wrong[0])
    if len(wrong) == 12:
        return hint(
            _("Now all twelve faces are clockwise: only two were wrong. Compare each with its "
              "neighbour.")
        )  # fmt: skip
    above = [each for each in wrong if "TOP" in each]
    if len(wrong) == 6 and len(above) in (0, 6):
        return hint(
            _("The six faces of one half are clockwise: seen from below, the ring goes round the "
              "other way, so the two halves list its points in opposite orders.")
        )  # fmt: skip
    if len(wrong) == 2:
        return hint(
            _("Two faces are clockwise as seen from outside. Each face in FACES is a tip and two "
              "neighbouring points of the ring. Those of TOP go round the ring counter-clockwise, "
              "those of BOTTOM clockwise: which of each six does not go on as the others do?")
        )  # fmt: skip
    others = [each for each in wrong if corner_set(each) not in TO_MEND]
    return hint(
        _("{count} faces are clockwise as seen from outside. {face} was right as it stood: turn "
          "only those that are missing where the gem is open."),
        count=len(wrong),
        face=others[0],
    )  # fmt: skip


@test(
    _("The picture is right"),
    _("From four sides the gem is closed, and each face has its colour."),
    needs=order,
)
def picture(work, solution):
    return compare(work, solution)
