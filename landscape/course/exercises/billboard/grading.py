"""The tests of the exercise billboard."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.triangles import covered

FRAMES = (0, 2, 4)
EVENTS = [
    *({"frame": 2, "key": "RIGHT"} for _press in range(5)),
    *({"frame": 4, "key": key} for key in ("RIGHT", "UP", "UP", "RIGHT", "RIGHT", "UP", "RIGHT")),
]
TREES = ((0, 0), (2.6, 1.2), (1, -2.6), (-2.4, 1.8), (-1.8, -1.6), (3, -2.4), (0.6, 3.2))
HEIGHT = 2.2
NEAR = 0.05  # chosen: units by which a tree may be elsewhere
CLOSE = 2.0  # chosen: degrees by which a tree may be turned otherwise


def view(solution, number):
    """Return the modelview matrix of the orchard, (4, 4)."""
    return next(d for d in solution.frame(number).draws if d.mode == "GL_TRIANGLE_FAN").modelview


def trees(work, solution, number):
    """Return the corners of each tree in the orchard's coordinates, (n, 4, 3).

    In the order lower left, lower right, upper right, upper left of its picture.
    """
    back = np.linalg.inv(view(solution, number))
    found = []
    for draw in work.frame(number).draws:
        if not draw.state["GL_TEXTURE0.GL_TEXTURE_2D"]:
            continue
        points = np.c_[draw.eye, np.ones(len(draw.eye))] @ back.T
        quads = zip(points[:, :3].reshape(-1, 4, 3), draw.texture.reshape(-1, 4, 4), strict=True)
        for corners, texture in quads:
            wanted = ((0, 1), (1, 1), (1, 0), (0, 0))
            distances = np.linalg.norm(texture[None, :, :2] - np.array(wanted)[:, None], axis=2)
            found.append(corners[distances.argmin(axis=1)])
    return np.array(found).reshape(-1, 4, 3)


def feet(corners):
    return corners[:, :2].mean(axis=1)


def headings(corners):
    """Return by which angle each tree's front is turned from the x axis, in degrees."""
    right, up = corners[:, 1] - corners[:, 0], corners[:, 3] - corners[:, 0]
    front = np.cross(right, up)
    return np.degrees(np.arctan2(-front[:, 2], front[:, 0]))


def wanted(corners, solution, number):
    """Return by which angle each should be turned."""
    eye = np.linalg.inv(view(solution, number))[:3, 3]
    to_eye = eye - feet(corners)
    return np.degrees(np.arctan2(-to_eye[:, 2], to_eye[:, 0]))


def off(angles, other):
    """Return the differences of angles in degrees, from -180 to 180."""
    return (np.asarray(angles) - other + 180) % 360 - 180


def turning(work):
    """Return the line of the last rotation of a tree; 0 without one."""
    found = [c for c in work.find("glRotate") if c.function != "main"]
    return found[-1].line if found else 0


@test(
    _("Seven trees stand in their places"),
    _("Each turns about its own vertical, which moves its foot nowhere."),
)
def places(work, solution):
    for number in FRAMES:
        found = trees(work, solution, number)
        if len(found) != len(TREES):
            return hint(
                _("In frame {frame} {count} trees are drawn, and not seven."),
                frame=number,
                count=len(found),
            )
        foot = feet(found)[:, [0, 2]]
        gaps = [np.linalg.norm(foot - place, axis=1).min() for place in TREES]
        if max(gaps) < NEAR and np.abs(feet(found)[:, 1]).max() < NEAR:
            continue
        worst = TREES[int(np.argmax(gaps))]
        calls = [c.name for c in work.frame(number).calls if c.function == "draw_tree"]
        first = calls.index("glRotatef") if "glRotatef" in calls else len(calls)
        if "glTranslatef" in calls and first < calls.index("glTranslatef"):
            return hint(
                _(
                    "Line {line} turns before glTranslatef, so the place of each tree is turned "
                    "about the middle of the orchard."
                ),
                line=turning(work),
            )
        if work.frame(number).find("glPushMatrix") == []:
            return hint(
                _(
                    "Each tree is drawn in the frame of the tree before it: glPushMatrix and "
                    "glPopMatrix are missing."
                )
            )
        return hint(
            _("In frame {frame} no tree stands at x = {x}, z = {z} any more."),
            frame=number,
            x=worst[0],
            z=worst[1],
        )

    return None


@test(
    _("The trees are upright"),
    _("Also when the eye looks down on them: they turn about the vertical only."),
    needs=places,
)
def upright(work, solution):
    for number in FRAMES:
        found = trees(work, solution, number)
        up = found[:, 2:].mean(axis=1) - feet(found)
        if np.abs(up - (0, HEIGHT, 0)).max() < NEAR:
            continue
        loads = work.frame(number).find("glLoadMatrix")
        if loads:
            return hint(
                _(
                    "Line {line} takes the whole rotation away, so the trees are parallel to the "
                    "screen: seen from above, they lie on their backs."
                ),
                line=loads[-1].line,
            )
        return hint(
            _(
                "In frame {frame} the trees lean: line {line} turns them about an axis that is not "
                "the vertical one, or by the eye's height as well."
            ),
            frame=number,
            line=turning(work),
        )

    return None


@test(
    _("Each tree faces the eye"),
    _("In every frame the angle is the direction from the tree to the eye."),
    needs=upright,
)
def facing(work, solution):
    wrong = {}
    for number in FRAMES:
        corners = trees(work, solution, number)
        angles, right = headings(corners), wanted(corners, solution, number)
        if np.abs(off(angles, right)).max() > CLOSE:
            wrong[number] = corners, angles, right

    if not wrong:
        return None
    at = turning(work)
    number, (corners, angles, right) = next(iter(wrong.items()))
    every = np.concatenate([off(a, r) for _c, a, r in wrong.values()])
    half_turns = np.abs(every) > 180 - CLOSE
    if np.all(half_turns | (np.abs(every) < CLOSE)) and not (
        half_turns.all() and len(wrong) == len(FRAMES)
    ):
        return hint(
            _(
                "Some trees show their backs, from some sides: atan in line {line} knows half "
                "of the "
                "directions only, and math.atan2 knows all."
            ),
            line=at,
        )

    if number != FRAMES[0]:
        return hint(
            _(
                "From the first side they face the eye, but not in frame {frame}: the angle "
                "must be "
                "computed anew whenever the eye has moved."
            ),
            frame=number,
        )

    difference = off(angles, right)
    if all(np.abs(a).max() < CLOSE for _c, a, _r in wrong.values()):
        return hint(_("The trees do not turn yet: their fronts look along the x axis."))
    if half_turns.all():
        return hint(
            _(
                "Line {line} turns each tree's back to the eye, and the backs are culled: half a "
                "turn is too much."
            ),
            line=at,
        )

    if np.ptp(every) < CLOSE and abs(abs(difference[0]) - 90) < CLOSE:
        return hint(
            _(
                "Each tree shows its edge: line {line} is right for a quad that looks along the z "
                "axis. This one looks along the x axis."
            ),
            line=at,
        )

    every_angle = np.concatenate([a for _c, a, _r in wrong.values()])
    every_right = np.concatenate([r for _c, _a, r in wrong.values()])
    told = {
        _("In line {line} radians are given, and glRotatef expects degrees."): np.radians(
            every_right
        ),
        _(
            "Line {line} turns the trees the wrong way: seen from above, a positive angle "
            "leads from "
            "the x axis to the negative z axis."
        ): -every_right,
        _(
            "In line {line} the arguments of atan2 are swapped: for a quad that looks along the "
            "x axis, the first is how far away the eye is along -z, the second how far along x."
        ): 90 - every_right,
    }
    for text, angle in told.items():
        if np.median(np.abs(off(every_angle, angle))) < CLOSE:
            return hint(text, line=at)
    if np.ptp(off(angles, angles[0])) < CLOSE:
        return hint(
            _(
                "All trees are turned by the same angle, so they are parallel to each other: each "
                "must face the eye from its own place."
            )
        )

    worst = int(np.abs(difference).argmax())
    return hint(
        _(
            "In frame {frame} the tree at x = {x:.1f}, z = {z:.1f} looks {angle:.0f} degrees past "
            "the eye."
        ),
        frame=number,
        x=feet(corners)[worst, 0],
        z=feet(corners)[worst, 2],
        angle=abs(difference[worst]),
    )


def regions(solution, number):
    """Return the parts of a frame's picture: each tree, and the ground with the sky."""
    height, width = solution.frame(number).picture.shape[:2]
    drawn = [d for d in solution.frame(number).draws if d.state["GL_TEXTURE0.GL_TEXTURE_2D"]]
    found = {}
    for draw, foot in zip(drawn, feet(trees(solution, solution, number)), strict=True):
        x, z = np.round(foot[[0, 2]], 1) + 0.0
        found[hint(_("the tree at x = {x}, z = {z}"), x=x, z=z)] = covered([draw], height, width)
    return {**found, _("the ground and the sky"): ~covered(drawn, height, width)}


@test(
    _("The picture is right"),
    _("From three sides, and from above."),
    needs=facing,
)
def picture(work, solution):
    for number in FRAMES:
        corners = trees(work, solution, number)
        sizes = np.linalg.norm(corners[:, 1] - corners[:, 0], axis=1)
        if abs(sizes.max() - HEIGHT) > NEAR:
            return hint(_("The trees are {size:.1f} units wide, and not 2.2."), size=sizes.max())
    return compare(work, solution, regions=lambda number: regions(solution, number))
