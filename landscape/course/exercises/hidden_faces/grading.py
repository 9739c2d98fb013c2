"""The tests of the exercise hidden_faces."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.triangles import covered

FRAMES = (0, 1, 2)
EVENTS = [{"frame": frame, "key": "RIGHT"} for frame in (1, 2) for _press in range(8)]
AXES = "xyz"
NEAR = 0.01  # chosen: by which a corner may be off

SOLID = np.zeros((7, 6, 4), bool)  # the gate of start.py
SOLID[:, 0] = True
SOLID[:2, :, 1:3] = True
SOLID[5:, :5, 1:3] = True
SOLID[2:5, 4, 1:3] = True
SOLID[3, 1, 3] = True
CUBES = {tuple(map(int, cube)) for cube in np.argwhere(SOLID)}


def moved(cube, axis, step):
    """Return the place beside a cube."""
    return (*cube[:axis], cube[axis] + step, *cube[axis + 1 :])


def side(cube, axis, step):
    """Return the side of a cube in a direction: its axis, and its corner nearest to the origin."""
    return axis, moved(cube, axis, 1) if step == 1 else cube


def sides(kept, of=side):
    """Return the sides of all cubes for which kept(cube, axis, step) holds."""
    return {
        of(cube, axis, step)
        for cube in CUBES
        for axis in range(3)
        for step in (1, -1)
        if kept(cube, axis, step)
    }


def exposed(cube, axis, step):
    """Return whether there is air beside a cube."""
    return moved(cube, axis, step) not in CUBES


def at_border(cube, axis, step):
    """Return whether the place beside a cube is outside of the array."""
    return not 0 <= moved(cube, axis, step)[axis] < SOLID.shape[axis]


def opposite(cube, axis):
    """Return the place at the other end of a cube's row."""
    return moved(cube, axis, SOLID.shape[axis] - 1 - 2 * cube[axis])


EXPOSED = sides(exposed)
BORDER = sides(at_border)
WRAPPED = sides(
    lambda cube, axis, step: at_border(cube, axis, step) and opposite(cube, axis) in CUBES
)
MISTAKES = (  # what is drawn by each, and what is said of it
    (
        sides(lambda *_side: True),
        _(
            "No face is left out: each cube is drawn with all six sides. Compare SOLID with "
            "itself, moved by one, to find the sides that have air in front of them."
        ),
    ),
    (
        sides(lambda *side: not exposed(*side)),
        _(
            "Only the faces between two cubes are drawn: the test of a cube's neighbour is the "
            "wrong way round."
        ),
    ),
    (
        sides(lambda cube, axis, step: exposed(cube, axis, -step)),
        _(
            "A cube's side is drawn where there is air on the opposite side of the cube. In "
            "which direction does np.roll move an array, and where does the neighbour end up?"
        ),
    ),
    *(
        (
            sides(lambda cube, axis, step, more=more: exposed(cube, (axis + more) % 3, step)),
            _(
                "A cube's side is drawn where there is air beside it in another direction: the "
                "array "
                "is moved along another axis than that of the side."
            ),
        )
        for more in (1, 2)
    ),
    (
        sides(exposed, lambda cube, axis, step: (axis, cube)),
        _(
            "The sides that look to +x, +y and +z are drawn where the opposite sides of the same "
            "cubes are. Where do the corners of the far side of a cube lie?"
        ),
    ),
)


def quads(work):
    """Return the corners of the quads of the last frame, (n, 4, 3)."""
    drawn = [draw.vertices[:, :3] for draw in work.last.draws if draw.mode == "GL_QUADS"]
    corners = np.concatenate(drawn) if drawn else np.zeros((0, 3))
    return corners[: len(corners) // 4 * 4].reshape(-1, 4, 3)


def faces(work):
    """Return the quads as sides of cubes, in the order in which they are drawn."""
    found = quads(work)
    axes = np.ptp(found, axis=1).argmin(axis=1)
    lows = np.round(found.min(axis=1)).astype(int)
    return [(int(axis), tuple(map(int, low))) for axis, low in zip(axes, lows, strict=True)]


def outward(face):
    """Return 1 or -1: the direction along its axis in which an exposed face looks."""
    _axis, low = face
    return -1 if low in CUBES else 1


def wound(quad, axis):
    """Return 1 or -1: the direction from which a quad's corners are counter-clockwise."""
    return int(np.sign(np.cross(quad[1] - quad[0], quad[2] - quad[1])[axis]))


def inward(work):
    """Return those of the exposed faces that are clockwise as seen from outside."""
    drawn = zip(faces(work), quads(work), strict=True)
    return [face for face, quad in drawn if wound(quad, face[0]) != outward(face)]


def named(face):
    """Return an exposed face as a value of a hint: its direction and its cube."""
    axis, low = face
    cube = low if outward(face) == -1 else moved(low, axis, -1)
    return hint(
        _("the side towards {direction} of the cube at ({x}, {y}, {z})"),
        direction=direction(axis, outward(face)),
        **dict(zip(AXES, cube, strict=True)),
    )


def direction(axis, step):
    return f"{'+' if step == 1 else '-'}{AXES[axis]}"


def points(quad):
    return ", ".join(f"({', '.join(f'{number:g}' for number in point)})" for point in quad)


@test(
    _("Faces that look away are still left out"),
    _("Without culling both sides of a face are drawn, and a wrong order cannot be seen."),
    demanded=True,
)
def culled(work, solution):
    for draw in work.last.draws:
        state = draw.state
        if not state["GL_CULL_FACE"]:
            return hint(
                _(
                    "GL_CULL_FACE is off while the gate is drawn. It is to stay on: it shows which "
                    "faces have their corners in the wrong order."
                )
            )
        if (state["GL_FRONT_FACE"], state["GL_CULL_FACE_MODE"]) != ("GL_CCW", "GL_BACK"):
            return hint(
                _(
                    "Culling the back, with the counter-clockwise side as the front, must stay "
                    "as in the program you started from: change only make_faces."
                )
            )
    return None


@test(
    _("Each face is a square of side 1 on the grid of the cubes"),
    _("Its corners follow each other along its edges, and have whole coordinates."),
    needs=culled,
    demanded=True,
)
def squares(work, solution):
    for number, quad in enumerate(quads(work)):
        extent = np.sort(np.ptp(quad, axis=0))
        edges = np.abs(quad - np.roll(quad, 1, axis=0)).sum(axis=1)
        values = {"number": number, "points": points(quad)}
        if extent[1] < NEAR:
            return hint(
                _(
                    "faces[{number}] has the corners {points}: they lie on a line. Two of the "
                    "three "
                    "coordinates must take two values each."
                ),
                **values,
            )
        off = np.abs(quad - np.round(quad)).max() > NEAR
        if off or np.abs(extent - (0, 1, 1)).max() > NEAR:
            return hint(
                _("faces[{number}] has the corners {points}: that is no side of a cube of SOLID."),
                **values,
            )
        if np.abs(edges - 1).max() > NEAR:
            return hint(
                _(
                    "The corners of faces[{number}], {points}, do not follow each other along the "
                    "edges: one step goes over the diagonal."
                ),
                **values,
            )

    return None


@test(
    _("Only faces between a cube and air are drawn"),
    _("All others are hidden by the two cubes between which they lie."),
    needs=squares,
    demanded=True,
)
def only_exposed(work, solution):
    drawn = faces(work)
    wrong = [face for face in drawn if face not in EXPOSED]
    if not wrong:
        return None
    for mistake, text in MISTAKES:
        if set(drawn) == mistake:
            return hint(text)
    _axis, low = wrong[0]
    values = {"points": points(quads(work)[drawn.index(wrong[0])]), "count": len(wrong)}
    if low in CUBES:
        return hint(
            _("{count} faces lie between two cubes, the first with the corners {points}."), **values
        )
    return hint(
        _("{count} faces lie in the air, not at a cube, the first with the corners {points}."),
        **values,
    )


@test(
    _("There are faces in all six directions"),
    _("The gate is seen from all sides; so each of the three axes counts in both directions."),
    needs=only_exposed,
    demanded=True,
)
def directions(work, solution):
    seen = {(face[0], outward(face)) for face in faces(work)}
    missing = [(axis, step) for axis in range(3) for step in (1, -1) if (axis, step) not in seen]
    for axis in range(3):
        if {(axis, 1), (axis, -1)} <= set(missing):
            return hint(
                _("No face looks along {axis}, neither to +{axis} nor to -{axis}."),
                axis=AXES[axis],
            )
    if missing:
        return hint(
            _("No face looks to {directions}: each axis has two directions."),
            directions=", ".join(direction(*each) for each in missing),
        )
    return None


@test(
    _("Every face that has air in front of it is drawn"),
    _("Beside a cube at the border of the array there is air."),
    needs=directions,
    demanded=True,
)
def whole(work, solution):
    missing = EXPOSED - set(faces(work))
    if not missing:
        return None
    if missing == BORDER and len(inward(work)) == len(faces(work)):
        return hint(
            _(
                "All faces at the border of the array are missing, and all others look into the "
                "cubes: these are the sides of the air, not of the cubes."
            )
        )

    if missing == BORDER:
        return hint(
            _(
                "All faces at the border of the array are missing, as if there were more cubes "
                "outside of it. What should a cube at the border be compared with?"
            )
        )

    if missing == WRAPPED:
        return hint(
            _(
                "Faces are missing at the border of the array, exactly where there is a cube at "
                "the opposite border: np.roll brings back at one end what it moves out at the "
                "other."
            )
        )

    return hint(
        _("{count} faces are missing, such as {face}."),
        count=len(missing),
        face=named(min(missing)),
    )


@test(
    _("Each face is drawn once"),
    _("Drawn twice, it costs twice as much, and the picture does not show it."),
    needs=whole,
    demanded=True,
)
def once(work, solution):
    drawn = faces(work)
    again = [face for number, face in enumerate(drawn) if face in set(drawn[:number])]
    if again:
        return hint(
            _("{all} faces are drawn, but the gate has only {count}: {face} comes twice."),
            all=len(drawn),
            count=len(EXPOSED),
            face=named(again[0]),
        )
    return None


@test(
    _("Every face is counter-clockwise from outside"),
    _("Then the cross product of two edges points away from the cube."),
    needs=once,
    demanded=True,
)
def order(work, solution):
    wrong = inward(work)
    if not wrong:
        return None
    turned = {(axis, outward((axis, low))) for axis, low in wrong}
    complete = len(wrong) == sum((face[0], outward(face)) in turned for face in EXPOSED)
    if complete and len(turned) == 6:
        return hint(
            _("All faces are clockwise as seen from outside, so you see the gate from inside.")
        )

    if complete and len(turned) == 3 and len({axis for axis, _step in turned}) == 3:
        return hint(
            _(
                "The faces that look to {directions} are clockwise. Seen from the other side, the "
                "same order of corners goes round the other way."
            ),
            directions=", ".join(direction(*each) for each in sorted(turned)),
        )

    if complete and len({axis for axis, _step in turned}) == 1:
        return hint(
            _(
                "The faces along {axis} are clockwise, and the others are not. Which of the two "
                "other axes comes first? In the circle x, y, z, x it is the same for all."
            ),
            axis=AXES[wrong[0][0]],
        )

    return hint(
        _("{count} faces are clockwise as seen from outside, such as {face}."),
        count=len(wrong),
        face=named(wrong[0]),
    )


def regions(solution, number):
    """Return the parts of a frame's picture."""
    frame = solution.frame(number)
    gate = covered(frame.draws, *frame.picture.shape[:2])
    return {_("the gate"): gate, _("what is around the gate"): ~gate}


@test(
    _("The picture is right"),
    _("From three sides the gate is closed, and its faces have their colours."),
    needs=order,
)
def picture(work, solution):
    return compare(work, solution, regions=lambda number: regions(solution, number))
