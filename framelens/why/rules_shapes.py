"""Rules about shapes that are wrong wherever they stand.

Not a number, no area, crossed, concave, too few vertices or none; and calls that make no shape.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from framelens.gl.named import gl_constant
from framelens.gl.seam import Call, gl
from framelens.why.geometry import LEAST, MODES, Vertices, concave, crossed_faces
from framelens.why.mends import instead_of_glu
from framelens.why.survey import MAPS, Drawn, Survey
from framelens.why.suspects import (
    Suspect,
    line_of,
    matrix_of,
    with_matrix,
    with_state,
    written,
)
from framelens.why.trial import Action, Change


def shapes(survey: Survey) -> Iterator[Suspect]:
    """Shapes that are wrong by themselves."""
    yield from _of_nothing(survey)
    yield from _without_vertices(survey)
    yield from _too_few(survey)
    yield from _left_over(survey)
    yield from _tiny(survey)
    for draw in survey.shapes:
        found = draw.vertices
        if found is None:
            continue
        count = len(found.positions)
        if not np.isfinite(found.positions).all():
            yield from _not_numbers(draw, found)
        elif not draw.covered and count and not _lacking(draw):
            yield from _flat(draw, found)

        if bad := crossed_faces(found):
            yield _crossed(survey, draw, found, bad)
        elif bad := concave(found):
            yield _concave(survey, draw, found, bad)


QUADRICS = {"gluSphere": 1, "gluCylinder": 3, "gluDisk": 2, "gluPartialDisk": 2}
"""GLU's shapes, and how many lengths stand between the quadric and the number of slices."""


def _of_nothing(survey: Survey) -> Iterator[Suspect]:
    """Yield that a shape of GLU has too few slices or a length that is none, and draws nothing."""
    for note in survey.glu:
        lengths = QUADRICS.get(note.name)
        if lengths is None or note.end != note.begin or note.pass_ == "setup":
            continue

        quadric, *numbers = note.args
        sizes = [abs(float(size)) for size in numbers[:lengths]]
        slices, stacks = (max(int(number), 8) for number in numbers[lengths : lengths + 2])
        if note.name in ("gluDisk", "gluPartialDisk"):
            sizes.sort()
        if not any(sizes):
            sizes = [1.0] * lengths

        better = (quadric, *sizes, slices, stacks, *numbers[lengths + 2 :])
        yield Suspect(
            "glu-nothing",
            at=note,
            change=instead_of_glu(survey, note, better),
            strength=88,
            value=numbers,
            values={"call": f"{note.name}(..., {', '.join(f'{n:g}' for n in numbers)})"},
        )


def _without_vertices(survey: Survey) -> Iterator[Suspect]:
    """Yield that a glBegin gets no vertices: of an evaluator that is off, or none at all."""
    empty = [d for d in survey.shapes if d.call.name == "glBegin" and _bare(d)]
    for draw in empty:
        evaluating = any(step.call.name.startswith("glEval") for step in draw.steps)
        if evaluating and not any(draw.state.get(name) for name in MAPS):
            yield from _map_off(survey, draw)
            return

    if empty and len(empty) == len(survey.shapes):
        yield Suspect(
            "no-vertices",
            at=empty[0].call,
            change=None,
            strength=70,
            values={"mode": MODES[int(empty[0].call.args[0])]},
            draws=empty,
            pixels=survey.base.shape[0] * survey.base.shape[1],
        )


def _bare(draw: Drawn) -> bool:
    found = draw.vertices
    return found is not None and not len(found.positions) and not draw.covered


def _map_off(survey: Survey, draw: Drawn) -> Iterator[Suspect]:
    """Yield that points of a curve or a surface are asked for, and its map is not enabled."""
    maps = [c for c in survey.tape.calls if c.name.startswith(("glMap1", "glMap2"))]
    for call in reversed(maps):
        name = getattr(call.args[0], "name", "")
        if name in MAPS:
            yield Suspect(
                "map-not-enabled",
                at=call,
                change=with_state(["ENABLE", "EVAL"], [("glEnable", (gl_constant(name),))], [draw]),
                strength=90,
                state=name,
                value=False,
                values={"map": name, "line": draw.call.site.line},
                draws=[draw],
            )
            return


def _left_over(survey: Survey) -> Iterator[Suspect]:
    """Yield that the last vertices of a glBegin make no primitive: its mode is another one."""
    lines: dict[str, list[Drawn]] = {}
    for draw in survey.shapes:
        found = draw.vertices
        size = WHOLE.get(found.mode, 0) if found is not None else 0
        if found is None or draw.call.name != "glBegin" or not size:
            continue
        if len(found.positions) > size and len(found.positions) % size:
            lines.setdefault(draw.call.source, []).append(draw)

    for draws in lines.values():
        found = draws[0].vertices
        assert found is not None
        count, size = len(found.positions), WHOLE[found.mode]
        better = OTHERWISE.get((found.mode, count % 4 == 0), "GL_LINE_STRIP")
        yield Suspect(
            "left-over",
            at=draws[0].call,
            change=Change(
                instead={draw.place: [("glBegin", (gl_constant(better),))] for draw in draws}
            ),
            strength=82,
            values={"mode": found.mode, "n": count, "size": size, "left": count % size},
            draws=draws,
        )


WHOLE = {"GL_LINES": 2, "GL_TRIANGLES": 3, "GL_QUADS": 4}
OTHERWISE = {
    ("GL_TRIANGLES", True): "GL_QUADS",
    ("GL_TRIANGLES", False): "GL_POLYGON",
    ("GL_QUADS", False): "GL_POLYGON",
}
"""What else so many vertices may be meant to be: of a mode, and of a number that 4 divides."""


def _tiny(survey: Survey) -> Iterator[Suspect]:
    """Yield that a shape in the view is smaller than a pixel, in a picture that shows nothing."""
    if not survey.empty:
        return
    small = [draw for draw in survey.shapes if 0.0 < _extent(survey, draw) < 0.9]
    small = [draw for draw in small if not draw.passed]
    if not small:
        return

    extent = max(_extent(survey, draw) for draw in small)
    larger = np.diag([100.0 / extent] * 3 + [1.0])
    chain = small[0].setters.chained.get("GL_MODELVIEW_MATRIX", [])
    scales = [call for call in chain if call.name.startswith("glScale")]
    yield Suspect(
        "tiny",
        at=scales[-1] if scales else small[0].call,
        change=with_matrix("GL_MODELVIEW", lambda d: larger @ matrix_of(d, "GL_MODELVIEW"), small),
        strength=72,
        state="GL_MODELVIEW_MATRIX",
        value=extent,
        values={"extent": extent},
        draws=small,
    )


def _extent(survey: Survey, draw: Drawn) -> float:
    """Return how many pixels wide or high the picture of a draw is, 0 where that is not known."""
    placed, found = draw.placed, draw.vertices
    if placed is None or found is None or not placed.finite or found.mode == "GL_POINTS":
        return 0.0
    if (placed.clip[:, 3] <= 0.0).any() or placed.outside:
        return 0.0
    points = placed.clip[:, :2] / placed.clip[:, 3:]
    return float((np.ptp(points, axis=0) / 2.0 * np.array(draw.state["GL_VIEWPORT"][2:])).max())


def _lacking(draw: Drawn) -> bool:
    """Return whether a glBegin gets vertices, and too few for a primitive."""
    found = draw.vertices
    if found is None or draw.call.name != "glBegin":
        return False
    return 0 < len(found.positions) < LEAST[found.mode]


def _too_few(survey: Survey) -> Iterator[Suspect]:
    """Yield that a mode wants more vertices than there are, for all draws of a line together."""
    lines: dict[str, list[Drawn]] = {}
    for draw in survey.shapes:
        if _lacking(draw):
            lines.setdefault(draw.call.source, []).append(draw)

    for draws in lines.values():
        found = draws[0].vertices
        assert found is not None
        count = len(found.positions)
        mode = ALONE.get(count, "GL_POLYGON")
        yield Suspect(
            "too-few-vertices",
            at=draws[0].call,
            change=Change(
                instead={draw.place: [("glBegin", (gl_constant(mode),))] for draw in draws}
            ),
            strength=85,
            values={"mode": found.mode, "n": count, "needed": LEAST[found.mode]},
            draws=draws,
        )


ALONE = {1: "GL_POINTS", 2: "GL_LINES"}  # what so few vertices can be drawn as


def _not_numbers(draw: Drawn, found: Vertices) -> Iterator[Suspect]:
    bad = np.flatnonzero(~np.isfinite(found.positions).all(axis=1))
    if not found.places:
        yield Suspect(
            "nan",
            at=draw.call,
            change=Change(around=()),
            strength=50,
            values={"n": len(bad)},
            draws=[draw],
        )
        return

    place = found.places[int(bad[0])]
    call = next(step.call for step in draw.steps if step.place == place)
    fixed = {
        found.places[int(k)]: [
            ("glVertex4f", tuple(np.nan_to_num(found.positions[k], posinf=0, neginf=0)))
        ]
        for k in bad
    }

    yield Suspect(
        "nan",
        at=call,
        change=Change(instead=fixed),
        strength=95,
        values={"n": len(bad)},
        draws=[draw],
    )


def _scaled_by_zero(draw: Drawn, call: Call) -> Suspect:
    """Suspect a glScale with a factor of 0; the change makes that 1."""
    args = tuple(float(a) or 1.0 for a in call.args)
    return Suspect(
        "zero-scale",
        at=call,
        change=Change(instead={str(call.number): [(call.name, args)]}),
        strength=94,
        state="GL_MODELVIEW_MATRIX",
        value=[float(a) for a in call.args],
        values={"call": written(call)},
        draws=[draw],
    )


def _flat(draw: Drawn, found: Vertices) -> Iterator[Suspect]:
    """Yield why a draw has no area: a scale by 0, or all vertices in one point or line."""
    chain = draw.setters.chained.get("GL_MODELVIEW_MATRIX", [])
    zero = [c for c in chain if c.name.startswith("glScale") and 0.0 in [float(a) for a in c.args]]
    if zero:
        yield _scaled_by_zero(draw, zero[-1])
        return

    points = found.positions[:, :3]
    if found.mode == "GL_POINTS" or not np.isfinite(points).all():
        return
    spread = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    least = 2 if found.mode not in ("GL_LINES", "GL_LINE_STRIP", "GL_LINE_LOOP") else 1
    if len(spread) >= least and spread[least - 1] > 1e-6 * max(float(np.abs(points).max()), 1e-9):
        return
    yield Suspect(
        "no-area",
        at=draw.call,
        change=with_state(
            ["POLYGON", "POINT"],
            [("glPolygonMode", (gl.GL_FRONT_AND_BACK, gl.GL_POINT)), ("glPointSize", (9.0,))],
            [draw],
        ),
        strength=70,
        values={"n": len(points)},
        draws=[draw],
    )


def _vertex_call(draw: Drawn, found: Vertices, index: int) -> Call:
    place = found.places[index] if found.places else draw.place
    return next(step.call for step in draw.steps if step.place == place)


def _crossed(survey: Survey, draw: Drawn, found: Vertices, bad: Sequence[int]) -> Suspect:
    instead: dict[str, Sequence[Action]] = {}
    for index in bad:
        face = found.faces[index]
        a, b, c, d = (found.positions[k] for k in face)
        order = [a, b, d, c] if _area(a, b, d, c) >= _area(a, c, b, d) else [a, c, b, d]
        for k, point in zip(face, order, strict=True):
            if found.places:
                instead[found.places[k]] = [("glVertex4d", tuple(point.tolist()))]
    return Suspect(
        "crossed-quad",
        at=_vertex_call(draw, found, found.faces[bad[0]][2]),
        change=Change(instead=instead),
        strength=90,
        values={"n": len(bad)},
        draws=[draw],
        source=line_of(survey, draw),
    )


def _area(*corners: np.ndarray) -> float:
    points = np.array(corners)[:, :3]
    total = sum(np.cross(points[k], points[(k + 1) % 4]) for k in range(4))
    return float(np.linalg.norm(total))


def _triangles(found: Vertices, bad: Sequence[int]) -> list[tuple[float, ...]]:
    """Return the corners of the triangles that make up some faces."""
    return [
        tuple(found.positions[k].tolist())
        for index in bad
        for triangle in ears(found.positions[found.faces[index]][:, :3])
        for k in (found.faces[index][j] for j in triangle)
    ]


def _concave(survey: Survey, draw: Drawn, found: Vertices, bad: Sequence[int]) -> Suspect:
    """Suspect polygons that are not convex; the change draws them as triangles that are."""
    triangles = _triangles(found, bad)
    good = [k for k in range(len(found.faces)) if k not in set(bad)]

    def act() -> None:
        if found.mode == "GL_QUADS" and good:
            gl.glBegin(gl.GL_QUADS)
            for index in good:
                for k in found.faces[index]:
                    gl.glVertex4d(*found.positions[k])
            gl.glEnd()
        gl.glBegin(gl.GL_TRIANGLES)
        for point in triangles:
            gl.glVertex4d(*point)
        gl.glEnd()

    steps = draw.steps
    instead: dict[str, Sequence[Action]] = {step.place: () for step in steps if step.place}
    instead[steps[-1].place] = [act]
    return Suspect(
        "concave",
        at=draw.call,
        change=Change(instead=instead),
        strength=90 if not found.colors else 60,
        values={"n": len(bad), "mode": found.mode},
        draws=[draw],
        source=line_of(survey, draw),
    )


def _flattened(points: np.ndarray) -> np.ndarray:
    """Return a flat polygon, (n, 3), seen along the axis to which it is turned most, (n, 2)."""
    normal = sum(np.cross(points[k], points[(k + 1) % len(points)]) for k in range(len(points)))
    return np.delete(points, int(np.argmax(np.abs(normal))), axis=1)


def _is_ear(flat: np.ndarray, left: Sequence[int], corner: tuple[int, int, int]) -> bool:
    """Return whether a corner of a polygon is convex, and no other point of it is within."""
    a, b, c = corner
    if _turn(flat[a], flat[b], flat[c]) <= 0:
        return False
    others = (k for k in left if k not in corner)
    return not any(_within(flat[k], flat[a], flat[b], flat[c]) for k in others)


def ears(points: np.ndarray) -> list[tuple[int, int, int]]:
    """Cut a flat polygon, (n, 3), into triangles of its corners, ear by ear."""
    flat = _flattened(points)
    left = list(range(len(flat)))
    area = sum(flat[k - 1][0] * flat[k][1] - flat[k][0] * flat[k - 1][1] for k in range(len(flat)))
    if area < 0:
        left.reverse()
    found = []
    while len(left) > 3:
        corners = ((left[at - 1], left[at], left[(at + 1) % len(left)]) for at in range(len(left)))
        ear = next((each for each in corners if _is_ear(flat, left, each)), None)
        if ear is None:
            break
        found.append(ear)
        left.remove(ear[1])

    return [*found, (left[0], left[1], left[2])]


def _turn(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> float:
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def _within(p: np.ndarray, a: np.ndarray, b: np.ndarray, c: np.ndarray) -> bool:
    return _turn(a, b, p) >= 0 and _turn(b, c, p) >= 0 and _turn(c, a, p) >= 0


RULES = (shapes,)
