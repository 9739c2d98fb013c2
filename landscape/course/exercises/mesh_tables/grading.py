"""The tests of the exercise mesh_tables."""

from itertools import product

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.mistakes import balanced, silent
from landscape.course.grader.triangles import triangles

FRAMES = (0, 1, 2, 3, 4)
EVENTS = [
    {"frame": frame, "key": key, "action": action}
    for frame, keys in {1: "RRR", 2: "RRRU", 3: "RRR", 4: "LD"}.items()
    for key in ({"R": "RIGHT", "L": "LEFT", "U": "UP", "D": "DOWN"}[letter] for letter in keys)
    for action in ("press", "release")
]
VERTICES = np.array(((1, 0, 0), (0, 0, -1), (-1, 0, 0), (0, 0, 1), (0, 1.3, 0), (0, -1.3, 0)))
RIGHT = {frozenset(face) for face in product((0, 2), (1, 3), (4, 5))}
NEAR = 0.01  # chosen: units by which a corner may be elsewhere
MODES = ("GL_LINES", "GL_LINE_STRIP", "GL_LINE_LOOP", "GL_POINTS")


def faces(work):
    """Return the triangles of the first frame as numbers of corners; -1 for other places."""
    found = []
    for draw in work.frame(0).draws:
        apart = np.abs(draw.vertices[:, None, :3] - VERTICES).max(axis=-1)
        numbers = np.where(apart.min(axis=1) < NEAR, apart.argmin(axis=1), -1)
        found += [tuple(int(n) for n in numbers[each]) for each in triangles(draw)]
    return found


def outward(face):
    """Return whether the corners of a face are counter-clockwise from outside."""
    a, b, c = VERTICES[list(face)]
    return bool(np.cross(b - a, c - a) @ (a + b + c) > 0)


def named(face):
    """Return a face as one writes it in the table."""
    return "(" + ", ".join(map(str, face)) + ")"


@test(
    _("The corners of each face are neighbours"),
    _("A face joins an end of the axis above or below with two corners in between."),
)
def corners(work, solution):
    if silent(work, solution):
        return None
    draws, found = work.frame(0).draws, faces(work)
    if draws and all(draw.mode in MODES for draw in draws):
        return hint(
            _("The faces are not filled: {mode} in line {line} makes no triangles."),
            mode=draws[0].mode,
            line=draws[0].line,
        )

    if len(found) == 1:
        return hint(_("The gem has only one of its eight faces yet."))
    one = draws[0].mode if len(draws) == 1 else ""
    if one == "GL_TRIANGLE_STRIP" and len(draws[0].vertices) > 6:
        return hint(
            _(
                "In a strip the faces are joined: line {line} also makes triangles of the last "
                "corners of a face and the first ones of the next."
            ),
            line=draws[0].line,
        )

    if one in ("GL_POLYGON", "GL_TRIANGLE_FAN") and len(draws[0].vertices) > 6:
        return hint(
            _(
                "Line {line} makes one face of all corners together: each face is a triangle of "
                "its own."
            ),
            line=draws[0].line,
        )

    if found == [(0, 1, 2), (3, 4, 5)]:
        return hint(
            _(
                "What is drawn are the vertices in the order of their table, three by three. Which "
                "three belong together, only FACES says."
            )
        )

    if {frozenset((n + 1) % 6 for n in face) for face in found} == RIGHT:
        return hint(
            _(
                "Each corner is the one before the one that is meant in VERTICES: 1 is taken from "
                "the numbers of FACES, which count from 0, as Python does."
            )
        )

    shifted = [face for face in found if frozenset(face) not in RIGHT]
    if len(shifted) > len(found) / 2:
        return hint(
            _("{count} of {all} faces do not lie on the gem, the first of them is {face}."),
            count=len(shifted),
            all=len(found),
            face=named(shifted[0]),
        )

    for face in shifted:
        if len(set(face)) < 3:
            return hint(
                _("The face {face} has a corner twice, so that it is only a line."),
                face=named(face),
            )
        pair = next((p for p in ((0, 2), (1, 3), (4, 5)) if set(p) <= set(face)), None)
        if pair:
            return hint(
                _(
                    "The face {face} goes right through the gem: the corners {a} and {b} lie "
                    "opposite each other."
                ),
                face=named(face),
                a=pair[0],
                b=pair[1],
            )
        return hint(_("A face has a corner that is not in VERTICES."))

    return None


@test(
    _("All eight faces are there"),
    _("Four above and four below, each of them once."),
    needs=corners,
)
def all_faces(work, solution):
    if silent(work, solution):
        return None
    found = [frozenset(face) for face in faces(work)]
    missing = sorted(sorted(face) for face in RIGHT - set(found))
    if not missing or not found:
        return None
    twice = [face for face in set(found) if found.count(face) > 1]
    if twice:
        return hint(
            _("The face {face} is drawn twice, and {missing} is not there, in whatever order."),
            face=named(sorted(twice[0])),
            missing=named(missing[0]),
        )

    if len(missing) == 4 and all(5 in face for face in missing):
        return hint(_("The gem has no lower half: four faces meet in corner 5, too."))
    count = len(found)
    if len(missing) == 1 and frozenset((3, 2, 5)) == frozenset(missing[0]):
        return hint(
            _(
                "{count} faces are drawn; the last one is missing, that of the corners 2, 3 and 5. "
                "Is it in the table, and does the loop get there?"
            ),
            count=count,
        )

    return hint(
        _(
            "{count} faces are drawn. One of those that are missing joins the corners {a}, {b} "
            "and {c}."
        ),
        count=count,
        a=missing[0][0],
        b=missing[0][1],
        c=missing[0][2],
    )


@test(
    _("Each face is counter-clockwise from outside"),
    _("Culling leaves out the others, and one looks into the gem."),
    needs=all_faces,
)
def order(work, solution):
    if silent(work, solution):
        return None
    found = faces(work)
    wrong = [face for face in found if not outward(face)]
    if not wrong:
        return None
    if len(wrong) == len(found):
        return hint(
            _(
                "All faces are clockwise from outside: the ones in front are left out, and one "
                "sees the inside of those behind."
            )
        )

    if len(wrong) == 4 and all(5 in face for face in wrong):
        return hint(
            _(
                "The lower half shows its inside. Its faces are listed as the upper ones are, but "
                "what is counter-clockwise from above is clockwise from below."
            )
        )

    if len(wrong) == 1:
        return hint(
            _("The face {face} is clockwise from outside, so there is a hole in the gem."),
            face=named(wrong[0]),
        )

    return hint(
        _("{count} faces are clockwise from outside, so there are holes; the first one is {face}."),
        count=len(wrong),
        face=named(wrong[0]),
    )


@test(
    _("The picture is right"),
    _("From all sides, and with the colours of the faces."),
    needs=order,
)
def picture(work, solution):
    if silent(work, solution):
        return compare(work, solution)
    wanted = {}
    for draw in solution.frame(0).draws:
        for each in triangles(draw):
            wanted[tuple(np.round(draw.vertices[each, :3].mean(axis=0), 2))] = draw.colors[each[0]]
    got = {}
    for draw in work.frame(0).draws:
        for each in triangles(draw):
            got[tuple(np.round(draw.vertices[each, :3].mean(axis=0), 2))] = draw.colors[each]
    if got.keys() == wanted.keys():
        shades = np.array(list(got.values()))
        if np.abs(shades - 1).max() < NEAR:
            return hint(_("All faces are white, as no colour is set."))
        if np.abs(shades - shades[0, 0]).max() < NEAR:
            return hint(_("All faces have the colour of one of them."))
        if any(np.abs(got[key] - wanted[key]).max() > NEAR for key in got):
            return hint(
                _(
                    "Some faces have the colour of another one: set the colour of a face before "
                    "its vertices."
                )
            )

    return compare(work, solution)


stacks = balanced(needs=picture)
