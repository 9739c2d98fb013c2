"""Rules about draws outside the view volume: the planes they lie beyond, and what put them there.

Behind the eye, before the near plane, beyond the far one, beside; and what a near plane cuts.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from framelens.gl.seam import Call, GluCall
from framelens.program.past import MATRIX
from framelens.why.mends import always, undone
from framelens.why.survey import Drawn, Survey
from framelens.why.suspects import (
    Suspect,
    at_of,
    is_identity,
    lens,
    matrix_of,
    near_far,
    ortho,
    perspective,
    surrounds,
    with_matrix,
    with_planes,
    written,
)
from framelens.why.trial import Change


def outside(survey: Survey) -> Iterator[Suspect]:
    """Draws that lie outside the view volume: behind the eye, too near, too far, beside."""
    for group in survey.hidden():
        mine = [d for d in group if not d.covered and d.placed is not None and d.placed.faces]
        if not mine:
            continue
        finite = [d for d in mine if d.placed is not None and d.placed.finite]
        if not finite:
            yield from _infinite(survey, mine)
            continue
        yield from _placed(survey, finite)


def _infinite(survey: Survey, mine: list[Drawn]) -> Iterator[Suspect]:
    for mode in ("GL_MODELVIEW", "GL_PROJECTION"):
        if not np.isfinite(matrix_of(mine[0], mode)).all():
            call = mine[0].setter(f"{mode}_MATRIX")
            yield Suspect(
                "nan-matrix",
                at=at_of(survey, call),
                change=with_matrix(mode, lambda d: np.eye(4), mine),
                strength=90,
                state=f"{mode}_MATRIX",
                values={"matrix": f"{mode}_MATRIX"},
                draws=mine,
            )


def _placed(survey: Survey, mine: list[Drawn]) -> Iterator[Suspect]:
    placed = [d.placed for d in mine if d.placed is not None]
    count = sum(p.count for p in placed)
    behind = sum(p.behind for p in placed)
    nearest = min(p.distances[0] for p in placed)
    farthest = max(p.distances[1] for p in placed)
    near, far = near_far(mine[0].state["GL_PROJECTION_MATRIX"])
    values = {"n": count, "behind": behind, "nearest": nearest, "farthest": farthest}
    values |= {"near": near, "far": far}
    if is_identity(mine[0].state["GL_PROJECTION_MATRIX"]):
        if abs(mine[0].state["GL_MODELVIEW_MATRIX"][11]) > 1e-6:
            # The projection stands in the modelview matrix, as in many short programs: w tells.
            w = np.concatenate([p.clip[:, 3] for p in placed])
            values |= {"behind": int((w < 0).sum()), "nearest": w.min(), "farthest": w.max()}
            if (w < 0).all():
                yield from _turned_round(survey, mine, values)
            return
        yield from _units(survey, mine, values)
        return

    lensed = perspective(mine[0].state["GL_PROJECTION_MATRIX"])
    if lensed and behind == count:
        yield from _behind(survey, mine, values, farthest - nearest)
    between = sum(int(((p.eye[:, 2] < 0) & (-p.eye[:, 2] < near)).sum()) for p in placed)
    if lensed and between * 3 >= count and all("near" in p.outside for p in placed):
        yield _other_plane(survey, mine, "near", max(nearest, farthest / 50, 1e-4) / 4, values)
    if all("far" in p.outside for p in placed):
        yield _other_plane(survey, mine, "far", farthest * 2 + 1, values)
    if not lensed and all("near" in p.outside for p in placed):
        yield _other_plane(survey, mine, "near", nearest - abs(nearest) - 1, values)
    yield from _beside(survey, mine, values)


def _behind(
    survey: Survey, mine: list[Drawn], values: dict[str, float], size: float
) -> Iterator[Suspect]:
    tried = False
    for suspect in _turned_round(survey, mine, values):
        tried = True
        yield suspect
    if tried:
        return

    chain = mine[0].setters.chained.get("GL_MODELVIEW_MATRIX", [])
    away = values["nearest"] - 1.5 * max(size, 1.0) - values["near"]
    moved = np.eye(4)
    moved[3, 2] = away
    camera = at_of(survey, chain[-1]) if chain else None
    yield Suspect(
        "behind",
        at=camera or mine[0].call,
        change=with_matrix("GL_MODELVIEW", lambda d: matrix_of(d, "GL_MODELVIEW") @ moved, mine),
        strength=80,
        state="GL_MODELVIEW_MATRIX",
        value=values["farthest"],
        values=values | {"call": written(camera or mine[0].call)},
        draws=mine,
    )


def _turned_round(survey: Survey, mine: list[Drawn], values: dict[str, float]) -> Iterator[Suspect]:
    """Yield the translations towards the eye that would be right with the other sign."""
    chain = mine[0].setters.chained.get("GL_MODELVIEW_MATRIX", [])
    for call in reversed(chain):
        if not call.name.startswith("glTranslate") or float(call.args[2]) <= 0:
            continue
        x, y, z = (float(a) for a in call.args)
        if call.number < survey.tape.begin or survey.tape.calls[call.number] is not call:
            continue
        if isinstance(at_of(survey, call), GluCall):
            continue

        yield Suspect(
            "behind",
            at=call,
            change=Change(instead={str(call.number): [(call.name, (x, y, -z))]}),
            strength=86,
            state="GL_MODELVIEW_MATRIX",
            value=z,
            values=values | {"call": written(call)},
            draws=mine,
            appear=True,
        )


def _other_plane(
    survey: Survey, mine: list[Drawn], plane: str, new: float, values: dict[str, float]
) -> Suspect:
    call = mine[0].setter("GL_PROJECTION_MATRIX")
    at = at_of(survey, call)
    planes = _planes(mine[0])
    alike = [d for d in survey.shapes if np.allclose(_planes(d), planes)]

    return Suspect(
        f"beyond-{plane}",
        at=at or mine[0].call,
        change=with_matrix(
            "GL_PROJECTION",
            lambda d: with_planes(
                d.state["GL_PROJECTION_MATRIX"],
                new if plane == "near" else None,
                new if plane == "far" else None,
            ),
            alike,
        ),
        strength=84,
        state="GL_PROJECTION_MATRIX",
        value=values[plane],
        values=values | {"call": written(at) if at else ""},
        draws=mine,
        appear=True,
    )


def _planes(draw: Drawn) -> tuple[bool, float, float]:
    """Return whether a draw is in perspective, and its near and far plane."""
    projection = draw.state["GL_PROJECTION_MATRIX"]
    return perspective(projection), *near_far(projection)


def _units(survey: Survey, mine: list[Drawn], values: dict[str, float]) -> Iterator[Suspect]:
    """Yield that pixels are given where OpenGL, without a projection, has -1 to 1."""
    width, height = survey.tape.size
    points = np.concatenate([d.placed.eye for d in mine if d.placed is not None])[:, :3]
    if np.abs(points).max() <= 1.0:
        return
    projections = [ortho(0, width, 0, height), ortho(0, width, height, 0)]
    if points[:, 2].max() < 0 and np.abs(points[:, :2]).max() < 100:
        projections = [lens(45.0, width / height, 0.1, 1000.0)]
    for projection in projections:
        yield Suspect(
            "no-projection",
            at=mine[0].call,
            change=with_matrix("GL_PROJECTION", always(projection), mine),
            strength=83,
            state="GL_PROJECTION_MATRIX",
            value="identity",
            values=values,
            draws=mine,
        )


def _not_undone(mine: list[Drawn], name: str, change: Change, values: dict[str, float]) -> Suspect:
    """Suspect that the transformations of the function ``name`` are not undone."""
    chain = mine[0].setters.chained["GL_MODELVIEW_MATRIX"]
    return Suspect(
        "not-undone",
        at=next(call for call in chain if call.site.function == name),
        change=change,
        strength=72,
        state="GL_MODELVIEW_MATRIX",
        values=values | {"function": name},
        draws=mine,
        appear=True,
    )


def _into_view(mine: Sequence[Drawn]) -> np.ndarray:
    """Return the matrix that moves what is drawn in front of the eye, (4, 4), for rows."""
    moved = np.eye(4)
    points = np.concatenate([d.placed.eye[:, :3] for d in mine if d.placed is not None])
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    size = float(np.ptp(points, axis=0).max())
    moved[3, :3] = [-middle[0], -middle[1], -middle[2] - max(size, 1.0) * 2.0]
    return moved


def _beside(survey: Survey, mine: list[Drawn], values: dict[str, float]) -> Iterator[Suspect]:
    """Yield that a function's transformations are not undone, and push others out of the view."""
    chain = mine[0].setters.chained.get("GL_MODELVIEW_MATRIX", [])
    loading = {call.site.function for call in chain if call.name.startswith("glLoad")}
    names = {
        call.site.function
        for call in chain
        if call.number >= survey.tape.begin and isinstance(at_of(survey, call), Call)
    }
    for name in sorted(names - loading):
        change = undone(survey, name)
        if change is not None:
            yield _not_undone(mine, name, change, values)

    if survey.empty:
        moved = _into_view(mine)
        chain = mine[0].setters.chained.get("GL_MODELVIEW_MATRIX", [])
        at = at_of(survey, chain[-1]) if chain else mine[0].call
        yield Suspect(
            "beside",
            at=at,
            change=with_matrix(
                "GL_MODELVIEW", lambda d: matrix_of(d, "GL_MODELVIEW") @ moved, mine
            ),
            strength=55,
            state="GL_MODELVIEW_MATRIX",
            values=values | {"sides": ", ".join(_sides(mine))},
            draws=mine,
        )


def _sides(mine: list[Drawn]) -> list[str]:
    names: list[str] = []
    for draw in mine:
        if draw.placed is not None:
            names += [name for name in draw.placed.outside if name not in names]
    return names or ["outside"]


def around_the_eye(survey: Survey) -> Iterator[Suspect]:
    """A shape that is drawn where the camera stands, and fills the picture from inside."""
    area = survey.base.shape[0] * survey.base.shape[1]
    if not survey.empty:
        return
    filling = [draw for draw in survey.shapes if draw.passed >= 0.95 * area and surrounds([draw])]
    for draw in filling[:1]:
        placed = draw.placed
        if placed is None or np.abs(matrix_of(draw, "GL_MODELVIEW")[3, :3]).max() > 1e-6:
            return  # it has been moved, so the camera may well be meant to stand inside it

        away = np.eye(4)
        away[3, 2] = -3.0 * float(np.ptp(placed.eye[:, :3], axis=0).max())
        moves = [c for c in survey.calls if c.number < draw.number and c.name.startswith(MATRIX)]
        yield Suspect(
            "around-the-eye",
            at=at_of(survey, moves[-1]) if moves else draw.call,
            change=_moved(away, [draw]),
            strength=78,
            state="GL_MODELVIEW_MATRIX",
            value=[0.0, 0.0, 0.0],
            values={"line": draw.call.site.line},
            draws=[draw],
            reach=area,  # where it is seen, then, nobody knows
        )


def _moved(by: np.ndarray, draws: Sequence[Drawn]) -> Change:
    """Return the change that moves draws in front of the camera."""
    return with_matrix("GL_MODELVIEW", lambda d: matrix_of(d, "GL_MODELVIEW") @ by, draws)


def left_behind(survey: Survey) -> Iterator[Suspect]:
    """A function, called several times, that moves what it draws and does not move back.

    Only where a pixel is asked about: a chain of links is drawn in this way, too.
    """
    if survey.pixel is None or survey.past is None:
        return
    for function in sorted(_movers(survey)):
        change = undone(survey, function)
        chains = survey.past.chains
        call = next(c for c in survey.calls if c.site.function == function and c.number in chains)
        if change is not None:
            yield Suspect(
                "not-undone",
                at=call,
                change=change,
                strength=66,
                state="GL_MODELVIEW_MATRIX",
                values={"function": function},
            )


def _movers(survey: Survey) -> set[str]:
    """Return the functions that end with a draw, and multiply the matrix before it each time.

    Who moves on after the draw means it so: the next link begins where this one ends.
    """
    chains = survey.past.chains if survey.past else {}
    turns: dict[str, list[str]] = {}
    for call in survey.calls:
        if call.number in chains and not isinstance(at_of(survey, call), GluCall):
            turns.setdefault(call.site.function, []).append(_kind(call))
    return {
        function
        for function, kinds in turns.items()
        if not {"stack", "load"} & set(kinds)
        and "".join(kinds).count("movedraw") > 1
        and kinds[0] == "move"
        and kinds[-1] == "draw"
    }


def _kind(call: Call) -> str:
    if call.name in ("glPushMatrix", "glPopMatrix"):
        return "stack"
    if call.name.startswith("glLoad"):
        return "load"
    return "move" if call.name.startswith(MATRIX) else "draw"


def near_cuts(survey: Survey) -> Iterator[Suspect]:
    """A near plane that cuts off a part of what the pixel asked about should show."""
    if survey.pixel is None:
        return
    mine = []
    for draw in survey.shapes:
        placed = draw.placed
        if placed is None or not perspective(draw.state["GL_PROJECTION_MATRIX"]):
            continue
        near, _ = near_far(draw.state["GL_PROJECTION_MATRIX"])
        front = (placed.eye[:, 2] < 0) & (-placed.eye[:, 2] < near)
        if front.any() and near >= 0.5:
            mine.append(draw)

    if mine:
        values: dict[str, float] = {"near": near_far(mine[0].state["GL_PROJECTION_MATRIX"])[0]}
        placed = mine[0].placed
        assert placed is not None
        nearest, farthest = placed.distances
        values |= {"nearest": nearest, "farthest": farthest, "n": placed.count, "far": 0.0}
        yield _other_plane(survey, mine, "near", max(nearest, values["near"] / 50) / 4, values)


RULES = (outside, around_the_eye, left_behind, near_cuts)
