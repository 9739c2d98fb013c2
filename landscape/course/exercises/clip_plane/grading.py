"""The tests of the exercise clip_plane."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.triangles import covered

FRAMES = (0, 2)
EVENTS = [{"frame": 2, "key": "RIGHT"} for _press in range(5)]
PLANE = np.array((0, 0, -1, 0.3))
NEAR = 0.01  # chosen: by which a number of the plane may be off


def parts(work, number, name):
    """Return the draws of the wall with the roof, of the stair or of the hill."""
    found = {"wall": [], "stair": [], "hill": []}
    for draw in work.frame(number).draws:
        if not len(draw.vertices):
            continue
        radius = np.hypot(draw.vertices[:, 0], draw.vertices[:, 2]).max()
        inner = "stair" if radius < 0.9 else "wall"
        found["hill" if draw.vertices[:, 1].max() < 0.05 else inner].append(draw)
    return found[name]


def planes(draw):
    """Return the enabled planes by name, in eye coordinates, with a normal of length 1."""
    found = {}
    for index in range(6):
        name = f"GL_CLIP_PLANE{index}"
        equation = np.array(draw.state[f"{name}.equation"])
        if draw.state[name]:
            found[name] = equation / (np.linalg.norm(equation[:3]) or 1)
    return found


def line(work, name, *first):
    """Return the line of the last call of a function; 0 without one."""
    found = work.find(name, *first)
    return found[-1].line if found else 0


def near(a, b):
    return np.abs(a - b).max() < NEAR


@test(
    _("A plane cuts the wall and the roof"),
    _("A plane must be given, by glClipPlane, and be enabled while they are drawn."),
)
def cut(work, solution):
    given = work.find("glClipPlane")
    enabled = work.find("glEnable", "GL_CLIP_PLANE0")
    if not given and enabled:
        return hint(
            _(
                "Line {line} turns a plane on, but which one is not said: its four numbers are "
                "still "
                "0, and it cuts nothing."
            ),
            line=enabled[0].line,
        )

    if not given:
        return hint(_("There is no plane yet: glClipPlane gives one to OpenGL."))
    for number in FRAMES:
        walls = parts(work, number, "wall")
        if not walls:
            return hint(_("The wall is not drawn any more."))
        found = [planes(draw) for draw in walls]
        if not any(found):
            enabled = [c for c in work.find("glEnable") if "CLIP_PLANE" in str(c.args[0])]
            if enabled:
                return hint(
                    _(
                        "{plane} is enabled in line {line}, but not while the wall is drawn in "
                        "frame "
                        "{frame}."
                    ),
                    plane=enabled[-1].args[0],
                    line=enabled[-1].line,
                    frame=number,
                )
            return hint(
                _("The plane of line {line} is not enabled: glEnable takes its name, too."),
                line=given[-1].line,
            )
        if not all(found):
            return hint(_("The plane is enabled for a part of the wall and the roof only."))
        names = {call.args[0] for call in given}
        if not names & set(found[0]):
            return hint(
                _("{enabled} is enabled, but line {line} gives another one, {plane}."),
                enabled=next(iter(found[0])),
                line=given[-1].line,
                plane=given[-1].args[0],
            )

    return None


@test(
    _("The cut is at z = 0.3 of the tower, and turns with it"),
    _("glClipPlane takes the coordinates that hold at its call: they must be the tower's."),
    needs=cut,
)
def place(work, solution):
    wrong = None
    for number in FRAMES:
        for draw in parts(work, number, "wall"):
            found = list(planes(draw).values())
            inside = [plane @ draw.modelview for plane in found]
            if not any(near(plane, PLANE) for plane in inside) and wrong is None:
                wrong = number, found[0], inside[0], draw

    if wrong is None:
        return None
    number, plane, inside, draw = wrong
    at = line(work, "glClipPlane")
    if number != FRAMES[0]:
        return hint(
            _(
                "In the first frame the cut is right, but it does not turn with the tower: line "
                "{line} must be called in each frame, with the tower's rotation."
            ),
            line=at,
        )

    flipped = {
        (0, 0, 1, -0.3): _(
            "The plane of line {line} keeps the front and leaves out the rest: "
            "points with a x + b y + c z + d >= 0 are kept."
        ),
        (0, 0, -1, -0.3): _("The plane of line {line} is z = -0.3: look at the sign of d."),
        (0, 0, 1, 0.3): _("The plane of line {line} is z = -0.3, and keeps the wrong side, too."),
    }
    for numbers, text in flipped.items():
        if near(inside, np.array(numbers)):
            return hint(text, line=at)
    if near(plane, PLANE):
        return hint(
            _(
                "When line {line} is called, the modelview matrix is still the identity: the plane "
                "counts from the eye."
            ),
            line=at,
        )

    hill = parts(work, number, "hill")[0].modelview
    if near(plane @ hill, PLANE):
        return hint(
            _(
                "Line {line} is called before the tower's glTranslatef and glRotatef: the cut "
                "is in "
                "the coordinates of the hill."
            ),
            line=at,
        )

    moved = hill.copy()
    moved[:, 3] = draw.modelview[:, 3]
    if near(plane @ moved, PLANE):
        return hint(
            _(
                "Line {line} is called before the tower's glRotatef: the tower turns, and the cut "
                "does not."
            ),
            line=at,
        )

    a, b, c, d = inside + 0.0
    return hint(
        _(
            "In the tower's coordinates, the plane of line {line} keeps the points with {a:.2f} "
            "x + {b:.2f} y + {c:.2f} z + {d:.2f} >= 0, not those with z <= 0.3."
        ),
        line=at,
        a=a,
        b=b,
        c=c,
        d=d,
    )


@test(
    _("The stair and the hill are whole"),
    _("A plane cuts everything that is drawn while it is enabled."),
    needs=place,
)
def whole(work, solution):
    for number in FRAMES:
        if any(planes(draw) for draw in parts(work, number, "stair")):
            return hint(
                _(
                    "The plane is enabled in line {line}, and still enabled when the stair is "
                    "drawn: "
                    "the stair is cut as well."
                ),
                line=[c for c in work.find("glEnable") if "CLIP_PLANE" in str(c.args[0])][-1].line,
            )
        if any(planes(draw) for draw in parts(work, number, "hill")):
            return hint(
                _(
                    "The plane is still enabled when the hill is drawn, which is cut as well, "
                    "in the "
                    "tower's plane."
                )
            )

    return None


def regions(solution, number):
    """Return the parts of a frame's picture; those of the tower overlap."""
    height, width = solution.frame(number).picture.shape[:2]
    names = {"stair": _("the stair"), "wall": _("the wall and the roof")}
    found = {
        text: covered(parts(solution, number, name), height, width) for name, text in names.items()
    }
    return {**found, _("beside the tower"): ~np.any(list(found.values()), axis=0)}


@test(
    _("The picture is right"),
    _("From two sides you look into the tower."),
    needs=whole,
)
def picture(work, solution):
    return compare(work, solution, regions=lambda number: regions(solution, number))
