"""The tests of the exercise winding."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.triangles import triangles

FRAMES = (0, 1, 2, 3)  # a turn by quarters shows every face
EVENTS = [{"frame": frame, "key": "RIGHT"} for frame in (1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 3, 3, 3, 3)]
TOP, BOTTOM = 1.1, -1.9  # heights of the two tips
TIPS = {TOP: "TOP", BOTTOM: "BOTTOM"}
COLORS = ("RED", "ORANGE", "CREAM", "GREEN", "BLUE", "VIOLET")  # of the faces, round the ring
NEAR = 0.02  # chosen: by which a colour or the place of the gem may be off


def gem(work, number=0):
    """Return a frame's draws of triangles."""
    return [draw for draw in work.frame(number).draws if len(triangles(draw))]


def faces(work):
    """Return the gem's triangles, (n, 3, 3): object coordinates of their corners."""
    points = [draw.vertices[triangles(draw), :3] for draw in gem(work)]
    return np.concatenate(points) if points else np.zeros((0, 3, 3))


def colors(work):
    """Return the colour of each face, by its corners without their order."""
    found = {}
    for draw in gem(work):
        for each in triangles(draw):
            found[corner_set(draw.vertices[each, :3])] = draw.colors[each[-1], :3]
    return found


def outward(face):
    """Return whether a triangle is counter-clockwise from outside the gem, which is convex."""
    normal = np.cross(face[1] - face[0], face[2] - face[0])
    return normal @ (face.mean(axis=0) - (0, -0.2, 0)) > 0


def corners(face):
    """Return a triangle's corners in their order, such as TOP, 2, 3."""
    names = []
    for x, y, z in face:
        tip = next((name for height, name in TIPS.items() if abs(y - height) < 0.01), None)
        names.append(tip or str(round(np.degrees(np.arctan2(-z, x)) / 60) % 6))
    return names


def corner_set(face):
    return frozenset(corners(face))


# The faces by their corners without their order, each with its colour.
FACES = {
    frozenset((tip, str(number), str((number + 1) % 6))): color
    for tip in TIPS.values()
    for number, color in enumerate(COLORS)
}
AS_GIVEN = ["TOP", "3", "2"], ["BOTTOM", "4", "5"]
TO_MEND = set(map(frozenset, AS_GIVEN))


def listed(names):
    """Return a face as FACES lists it, such as (CREAM, TOP, 2, 3)."""
    color = FACES.get(frozenset(names))
    return f"({', '.join([color, *names] if color else names)})"


@test(
    _("Faces that look away are still left out"),
    _("Without culling both sides of a face are drawn, and a wrong order cannot be seen."),
    demanded=True,
)
def culled(work, solution):
    for number in FRAMES:
        if not gem(work, number):
            return hint(_("In frame {frame} the gem is not drawn."), frame=number)
        if not all(draw.state["GL_CULL_FACE"] for draw in gem(work, number)):
            return hint(
                _(
                    "GL_CULL_FACE is off while the gem is drawn: that hides the mistake and does "
                    "not mend it. Turn it on again."
                )
            )
    return None


@test(
    _("The front is still the counter-clockwise side"),
    _("The ten other faces are right as they are; the two wrong ones must become like them."),
    needs=culled,
    demanded=True,
)
def front(work, solution):
    states = [draw.state for number in FRAMES for draw in gem(work, number)]
    clockwise = [state["GL_FRONT_FACE"] != "GL_CCW" for state in states]
    if any(clockwise):
        line = work.find("glFrontFace", "GL_CW")[-1].line
        if not all(clockwise):
            return hint(
                _(
                    "Line {line} makes the clockwise side the front for some faces. That hides "
                    "the mistake: fix the order of their vertices in FACES."
                ),
                line=line,
            )
        return hint(
            _(
                "glFrontFace(GL_CW) in line {line} swaps front and back of all faces: now ten are "
                "wrong, and not two."
            ),
            line=line,
        )

    state = next((each for each in states if each["GL_CULL_FACE_MODE"] != "GL_BACK"), states[0])
    if state["GL_CULL_FACE_MODE"] != "GL_BACK":
        line = work.find("glCullFace")[-1].line
        return hint(
            _(
                "glCullFace({mode}) in line {line} leaves out the wrong faces: you see the gem "
                "from inside, or not at all."
            ),
            mode=state["GL_CULL_FACE_MODE"],
            line=line,
        )

    return None


@test(
    _("Each of the twelve faces is drawn once"),
    _("One that is listed in both orders would never be culled."),
    needs=front,
    demanded=True,
)
def twelve(work, solution):
    found = [corners(face) for face in faces(work)]
    vertices = sum(len(draw.vertices) for draw in gem(work) if draw.mode == "GL_TRIANGLES")
    if vertices % 3:
        return hint(
            _(
                "{count} vertices are drawn: GL_TRIANGLES takes them by threes, so from the "
                "face on "
                "that lists more or fewer, all triangles are wrong."
            ),
            count=vertices,
        )

    strange = [names for names in found if frozenset(names) not in FACES]
    if strange:
        return hint(
            _(
                "{face} is drawn, which is no face of the gem: each has one tip and two "
                "neighbouring "
                "points of the ring."
            ),
            face=listed(strange[0]),
        )

    if len(found) < 12:
        return hint(
            _(
                "Only {count} triangles are drawn: turn a face with the wrong order round; do "
                "not leave it out."
            ),
            count=len(found),
        )

    if len(found) > 12:
        return hint(
            _(
                "{count} triangles are drawn: a face that is listed in both orders is always "
                "visible, from behind as well."
            ),
            count=len(found),
        )

    missing = set(FACES) - set(map(frozenset, found))
    if missing:
        known = set()
        again = next(
            names for names in found if frozenset(names) in known or known.add(frozenset(names))
        )
        return hint(
            _(
                "{face} is listed twice, in this order or in another, and one of the twelve faces "
                "is not there: change the order of a face's corners, and not the corners."
            ),
            face=listed(again),
        )

    return None


@test(
    _("Every triangle is counter-clockwise from outside"),
    _("Then the cross product of two edges points outward."),
    needs=twelve,
    demanded=True,
)
def order(work, solution):
    wrong = [corners(face) for face in faces(work) if not outward(face)]
    if not wrong:
        return None
    begun = [each for each in wrong if frozenset(each) in TO_MEND and each not in AS_GIVEN]
    if begun and len(wrong) <= 2:
        return hint(
            _(
                "{face} goes round as before and only begins at another corner. Two of its corners "
                "must change places."
            ),
            face=listed(begun[0]),
        )

    others = [each for each in wrong if frozenset(each) not in TO_MEND]
    if len(wrong) == 1 and not others:
        return hint(
            _("One face is still clockwise as seen from outside: {face}."), face=listed(wrong[0])
        )

    if len(wrong) == 12:
        return hint(
            _(
                "Now all twelve faces are clockwise: only two were wrong. Compare each with its "
                "neighbour."
            )
        )

    above = [each for each in wrong if "TOP" in each]
    if len(wrong) == 6 and len(above) in (0, 6):
        return hint(
            _(
                "The six faces of one half are clockwise: seen from below, the ring goes round the "
                "other way, so the two halves list its points in opposite orders."
            )
        )

    if not others:
        return hint(
            _(
                "Two faces are clockwise as seen from outside. Which colours are missing, "
                "above and "
                "below, where the gem is open? Compare their entries with their neighbours: those "
                "of TOP go round the ring counter-clockwise, those of BOTTOM clockwise."
            )
        )

    if len(wrong) == 1:
        return hint(
            _("One face is clockwise as seen from outside: {face}. It was right as it stood."),
            face=listed(others[0]),
        )

    return hint(
        _(
            "{count} faces are clockwise as seen from outside. {face} was right as it stood: turn "
            "only those that are missing where the gem is open."
        ),
        count=len(wrong),
        face=listed(others[0]),
    )


@test(
    _("The picture is right"),
    _("From four sides the gem is closed, and each face has its colour."),
    needs=order,
)
def picture(work, solution):
    for number in FRAMES:
        ours, found = gem(solution, number)[0], gem(work, number)[0]
        if np.abs(found.projection @ (found.modelview - ours.modelview)).max() > NEAR:
            return hint(_("The gem is seen from elsewhere than before: change only FACES."))
    for face, color in colors(solution).items():
        if np.abs(colors(work)[face] - color).max() > NEAR:
            return hint(
                _(
                    "{face} has another colour than before, or another brightness: change only the "
                    "order of the vertices."
                ),
                face=listed(sorted(face, reverse=True)),
            )
    return compare(work, solution)
