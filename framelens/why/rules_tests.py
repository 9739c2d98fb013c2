"""Rules about fragments: what keeps those of a draw from the picture.

For draws that show nothing each test is lifted alone: culling, the alpha, stencil, scissor and
depth tests, the masks, blending, fog, clip planes. Then come tests that are missing, or that let
the wrong fragments pass.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from framelens.gl.named import gl_constant
from framelens.gl.seam import Call, gl
from framelens.tape.textures import completeness
from framelens.why.geometry import against_neighbours
from framelens.why.survey import Drawn, Survey
from framelens.why.suspects import (
    Suspect,
    closed,
    in_frame,
    load,
    matrix_of,
    near_far,
    off,
    on,
    perspective,
    shows_elsewhere,
    surrounds,
    textured,
    with_matrix,
    with_planes,
    with_state,
)
from framelens.why.trial import Action, Around, Change, changed

INVERT = [
    ("glDisable", (0x0BE2,)),  # GL_BLEND
    ("glEnable", (0x0BF2,)),  # GL_COLOR_LOGIC_OP
    ("glLogicOp", (0x150A,)),  # GL_INVERT
]


def groups(survey: Survey) -> list[list[Drawn]]:
    """Return the draws that show nothing, by function or line, and have fragments to show."""
    return [
        found for group in survey.hidden() if (found := [draw for draw in group if draw.covered])
    ]


def _of(draws: Sequence[Drawn], name: str, value: object = True) -> list[Drawn]:
    return [draw for draw in draws if draw.state.get(name) == value]


def _setter(draws: Sequence[Drawn], name: str) -> Call | None:
    return draws[0].setter(name)


def lifted(survey: Survey) -> Iterator[Suspect]:
    """Draws that show nothing, and the test that stops them."""
    for group in groups(survey):
        yield from _culled(group)
        yield from _tested(survey, group)
        yield from _depth(survey, group)
        yield from _blended(group)
        yield from _fogged(survey, group)


def _tested(survey: Survey, group: list[Drawn]) -> Iterator[Suspect]:
    """Yield each test that may stop what has fragments, and lets none of them pass."""
    stopped = [draw for draw in group if not draw.passed]
    yield from _alpha_tested(stopped)
    yield from _stencil_tested(survey, stopped)
    yield from _scissored(stopped)
    yield from _clipped(stopped)
    yield from _color_masked(survey, group)
    yield from _stippled(stopped)


def _lift(
    cause: str, test: str, draws: list[Drawn], strength: float, **values: str
) -> Iterator[Suspect]:
    """Yield that a test stops those of the draws for which it is on; the change disables it."""
    mine = _of(draws, test)
    if mine:
        yield Suspect(
            cause,
            at=_setter(mine, test),
            change=off(test, mine),
            strength=strength,
            state=test,
            value=True,
            values={key: mine[0].state[name] for key, name in values.items()},
            draws=mine,
        )


def _alpha_tested(draws: list[Drawn]) -> Iterator[Suspect]:
    names = {"function": "GL_ALPHA_TEST_FUNC", "reference": "GL_ALPHA_TEST_REF"}
    yield from _lift("alpha-test", "GL_ALPHA_TEST", draws, 84, **names)


def _stencil_tested(survey: Survey, draws: list[Drawn]) -> Iterator[Suspect]:
    names = {"function": "GL_STENCIL_FUNC", "reference": "GL_STENCIL_REF"}
    mine = [draw for draw in _of(draws, "GL_STENCIL_TEST") if not _marks(draw)]
    marking = [draw for draw in survey.shapes if _sets_stencil(draw)]
    if marking and not any(draw.covered for draw in marking):
        return  # what it is to be seen in, such as a mirror, is not in the view
    yield from _lift("stencil-test", "GL_STENCIL_TEST", mine, 84, **names)


def _scissored(draws: list[Drawn]) -> Iterator[Suspect]:
    yield from _lift("scissor-test", "GL_SCISSOR_TEST", draws, 86, box="GL_SCISSOR_BOX")


def _clipped(draws: list[Drawn]) -> Iterator[Suspect]:
    for plane in range(6):
        for suspect in _lift("clip-plane", f"GL_CLIP_PLANE{plane}", draws, 78):
            yield replace(suspect, values={**suspect.values, "plane": plane})


def _color_masked(survey: Survey, draws: list[Drawn]) -> Iterator[Suspect]:
    masked = [draw for draw in draws if _colorless(draw) and not _meant(survey, draw)]
    if masked and not any(draw.state["GL_STENCIL_TEST"] for draw in masked):
        yield Suspect(
            "color-mask",
            at=_setter(masked, "GL_COLOR_WRITEMASK"),
            change=with_state(["COLOR_BUFFER"], [("glColorMask", (True,) * 4)], masked),
            strength=74,
            state="GL_COLOR_WRITEMASK",
            value=[bool(shown) for shown in masked[0].state["GL_COLOR_WRITEMASK"]],
            draws=masked,
        )


def _stippled(draws: list[Drawn]) -> Iterator[Suspect]:
    lines = [draw for draw in draws if draw.vertices and draw.vertices.mode in LINES]
    for suspect in _lift("line-stipple", "GL_LINE_STIPPLE", lines, 84):
        suspect.at = _setter(lines, "GL_LINE_STIPPLE_PATTERN") or suspect.at
        yield suspect
    yield from _lift("stipple", "GL_POLYGON_STIPPLE", draws, 70)


LINES = ("GL_LINES", "GL_LINE_STRIP", "GL_LINE_LOOP")


def _colorless(draw: Drawn) -> bool:
    return not any(draw.state["GL_COLOR_WRITEMASK"][:3])


def _meant(survey: Survey, draw: Drawn) -> bool:
    """Return whether a draw without colours is there for its depths, or to be counted."""
    return _for_depth(survey, draw) or _counted(survey, draw)


def _counted(survey: Survey, draw: Drawn) -> bool:
    """Return whether a query counts a draw's fragments."""
    before = survey.tape.calls[survey.tape.begin : draw.number]
    queries = [call for call in before if call.name.startswith(("glBeginQuery", "glEndQuery"))]
    return bool(queries) and queries[-1].name.startswith("glBegin")


def _for_depth(survey: Survey, draw: Drawn) -> bool:
    """Return whether a draw without colours is there for its depths: the mask is set back."""
    if not (draw.state["GL_DEPTH_TEST"] and draw.state["GL_DEPTH_WRITEMASK"]):
        return False
    later = survey.tape.calls[draw.number :]
    return any(call.name == "glColorMask" and any(map(bool, call.args[:3])) for call in later)


def _marks(draw: Drawn) -> bool:
    """Return whether a draw is there to mark pixels in the stencil buffer."""
    return bool(draw.state["GL_STENCIL_FAIL"] != "GL_KEEP")


def _sets_stencil(draw: Drawn) -> bool:
    """Return whether a draw writes into the stencil buffer."""
    names = ("GL_STENCIL_FAIL", "GL_STENCIL_PASS_DEPTH_FAIL", "GL_STENCIL_PASS_DEPTH_PASS")
    return bool(draw.state["GL_STENCIL_TEST"]) and any(draw.state[n] != "GL_KEEP" for n in names)


def _culled(group: list[Drawn]) -> Iterator[Suspect]:
    mine = [d for d in _of(group, "GL_CULL_FACE") if not d.passed]
    mine = [d for d in mine if any(d.state["GL_COLOR_WRITEMASK"])]
    if mine:
        yield from _culling(mine, 80)


def _culling(mine: list[Drawn], strength: float) -> Iterator[Suspect]:
    """Yield why draws are culled: the camera inside, a mirrored matrix, or the winding."""
    yield from _other_faces(mine, strength)
    if _mirroring(mine[0]):
        yield _mirrored(mine, strength + 7)
    elif surrounds(mine):
        yield _seen_from_inside(mine, strength + 4)
    else:
        yield _culled_by_winding(mine, strength)


def _other_faces(mine: list[Drawn], strength: float) -> Iterator[Suspect]:
    """Yield that front faces are culled, or that the front is where the back is for most."""
    for name, plain, cause, function, likelier in (
        ("GL_CULL_FACE_MODE", "GL_BACK", "cull-front", "glCullFace", 6),
        ("GL_FRONT_FACE", "GL_CCW", "front-face", "glFrontFace", 5),
    ):
        value = mine[0].state[name]
        if value != plain:
            yield Suspect(
                cause,
                at=_setter(mine, name),
                change=with_state(["POLYGON"], [(function, (gl_constant(plain),))], mine),
                strength=strength + likelier,
                state=name,
                value=value,
                draws=mine,
            )


def _mirrored(mine: list[Drawn], strength: float) -> Suspect:
    return Suspect(
        "mirrored",
        at=_negative_scale(mine[0]) or mine[0].call,
        change=off("GL_CULL_FACE", mine),
        strength=strength,
        state="GL_FRONT_FACE",
        value=mine[0].state["GL_FRONT_FACE"],
        draws=mine,
    )


def _seen_from_inside(mine: list[Drawn], strength: float) -> Suspect:
    chain = mine[0].setters.chained.get("GL_MODELVIEW_MATRIX", [])
    moves = [call for call in chain if call.name.startswith("glTranslate")]
    return Suspect(
        "inside",
        at=moves[-1] if moves else mine[0].call,
        change=off("GL_CULL_FACE", mine),
        strength=strength,
        state="GL_CULL_FACE",
        value=True,
        values={"cull": _line(_setter(mine, "GL_CULL_FACE"))},
        draws=mine,
    )


def _culled_by_winding(mine: list[Drawn], strength: float) -> Suspect:
    return Suspect(
        "culled",
        at=_setter(mine, "GL_CULL_FACE"),
        change=off("GL_CULL_FACE", mine),
        strength=strength,
        state="GL_CULL_FACE",
        value=True,
        values={"winding": mine[0].state["GL_FRONT_FACE"], "drawn": mine[0].call.site.line},
        draws=mine,
    )


def _line(call: Call | None) -> int:
    return call.site.line if call is not None else 0


def _negative_scale(draw: Drawn) -> Call | None:
    for call in reversed(draw.setters.chained.get("GL_MODELVIEW_MATRIX", [])):
        if call.name.startswith("glScale") and np.prod([float(a) for a in call.args[:3]]) < 0:
            return call
    return None


def odd_faces(survey: Survey) -> Iterator[Suspect]:
    """Front faces that are culled in all of a frame: what is seen of the shapes is their inside.

    Only where a pixel is asked about; who culls back faces in one pass and front faces in another,
    or draws a mirrored scene, means it so.
    """
    culled = [draw for draw in survey.shapes if draw.state["GL_CULL_FACE"] and draw.covered]
    settings = {(d.state["GL_CULL_FACE_MODE"], d.state["GL_FRONT_FACE"]) for d in culled}
    if survey.pixel is None or len(settings) != 1 or any(_mirroring(draw) for draw in culled):
        return
    mode, front = settings.pop()
    if (mode == "GL_BACK") != (front == "GL_CCW"):
        yield from _other_faces(culled, 70)


def _mirroring(draw: Drawn) -> bool:
    """Return whether a draw's modelview matrix turns the winding round."""
    matrix = matrix_of(draw, "GL_MODELVIEW")
    affine = np.allclose(matrix[:, 3], (0.0, 0.0, 0.0, 1.0))
    return bool(affine and np.linalg.det(matrix[:3, :3]) < 0)


def holes(survey: Survey) -> Iterator[Suspect]:
    """Faces of a closed shape that are culled though nothing is in front of them."""
    for draw in survey.shapes:
        if not draw.state["GL_CULL_FACE"] or draw.vertices is None or not draw.covered:
            continue

        bad = against_neighbours(draw.vertices)
        if bad and draw.vertices.places:
            face = draw.vertices.faces[bad[0]]
            first = draw.vertices.places[face[0]]
            call = next(step.call for step in draw.steps if step.place == first)
            yield Suspect(
                "winding",
                at=call,
                change=off("GL_CULL_FACE", [draw]),
                strength=92,
                state="GL_CULL_FACE",
                value=True,
                values={"faces": len(bad), "face": bad[0] + 1},
                draws=[draw],
            )
        elif closed(draw) and draw.state["GL_DEPTH_TEST"] and not surrounds([draw]):
            # Lifting culling adds nothing to a closed shape that is wound the right way.
            lifted_ = survey.trial.picture(off("GL_CULL_FACE", [draw]))
            if lifted_ is None or changed(survey.base, lifted_).sum() < draw.covered // 8:
                continue
            for suspect in _culling([draw], 84):
                if suspect.cause == "culled":
                    suspect.cause = "inside-out"
                suspect.least = draw.covered // 8
                yield suspect


ODD = ("GL_NEVER", "GL_GREATER", "GL_GEQUAL", "GL_EQUAL", "GL_NOTEQUAL")


def _cleared_nearer(survey: Survey, mine: list[Drawn]) -> Iterator[Suspect]:
    """Yield that the depth buffer is cleared to something nearer than the far plane."""
    cleared = [d for d in survey.draws if d.call.name == "glClear"]
    clear = next((d for d in cleared if d.state["GL_DEPTH_CLEAR_VALUE"] < 0.999), None)
    if clear is not None:
        yield Suspect(
            "clear-depth",
            at=clear.setter("GL_DEPTH_CLEAR_VALUE"),
            change=with_state(["DEPTH_BUFFER"], [("glClearDepth", (1.0,))], cleared),
            strength=90,
            state="GL_DEPTH_CLEAR_VALUE",
            value=clear.state["GL_DEPTH_CLEAR_VALUE"],
            draws=mine,
        )


def _depth(survey: Survey, group: list[Drawn]) -> Iterator[Suspect]:
    mine = _of(group, "GL_DEPTH_TEST")
    if not mine:
        return
    state = mine[0].state
    if state["GL_DEPTH_FUNC"] in ODD:
        yield Suspect(
            "depth-func",
            at=_setter(mine, "GL_DEPTH_FUNC"),
            change=with_state(["DEPTH_BUFFER"], [("glDepthFunc", (gl.GL_LEQUAL,))], mine),
            strength=88,
            state="GL_DEPTH_FUNC",
            value=state["GL_DEPTH_FUNC"],
            values={"clear": state["GL_DEPTH_CLEAR_VALUE"]},
            draws=mine,
        )

    yield from _cleared_nearer(survey, mine)
    moved = list(state["GL_DEPTH_RANGE"]) != [0.0, 1.0]
    if moved and not shows_elsewhere(survey, mine, "GL_DEPTH_RANGE"):
        yield Suspect(
            "depth-range",
            at=_setter(mine, "GL_DEPTH_RANGE"),
            change=with_state(["VIEWPORT"], [("glDepthRange", (0.0, 1.0))], mine),
            strength=75,
            state="GL_DEPTH_RANGE",
            value=list(state["GL_DEPTH_RANGE"]),
            draws=mine,
        )

    if survey.empty or _laid_over(survey, mine):
        yield Suspect(
            "depth-test",
            at=_setter(mine, "GL_DEPTH_TEST"),
            change=off("GL_DEPTH_TEST", mine),
            strength=60,
            state="GL_DEPTH_TEST",
            value=True,
            values={"function": state["GL_DEPTH_FUNC"]},
            draws=mine,
        )


def _laid_over(survey: Survey, mine: Sequence[Drawn]) -> bool:
    """Return whether draws without perspective come after those with it, as a display does."""
    flat = not any(perspective(draw.state["GL_PROJECTION_MATRIX"]) for draw in mine)
    before = [draw for draw in survey.shapes if draw.index < mine[0].index and draw.passed]
    return flat and any(perspective(draw.state["GL_PROJECTION_MATRIX"]) for draw in before)


def near_zero(survey: Survey) -> Iterator[Suspect]:
    """A near plane at 0: all depths are the same, and the depth test lets nothing pass."""
    mine = []
    for draw in survey.shapes:
        projection = draw.state["GL_PROJECTION_MATRIX"]
        if perspective(projection) and draw.state["GL_DEPTH_TEST"]:
            near, far = near_far(projection)
            if not np.isfinite(near) or near <= 0 or near < abs(far) * 1e-6:
                mine.append(draw)

    if mine:
        near, far = near_far(mine[0].state["GL_PROJECTION_MATRIX"])
        far = far if np.isfinite(far) and far > 0 else 1000.0
        yield Suspect(
            "near-zero",
            at=mine[0].setter("GL_PROJECTION_MATRIX"),
            change=with_matrix(
                "GL_PROJECTION",
                lambda d: with_planes(d.state["GL_PROJECTION_MATRIX"], far / 1000, far),
                mine,
            ),
            strength=95,
            state="GL_PROJECTION_MATRIX",
            value=near,
            values={"near": abs(near) if np.isfinite(near) else 0.0},
            draws=mine,
        )


def _blended(group: list[Drawn]) -> Iterator[Suspect]:
    """Yield what leaves the pixels of fragments that pass as they were."""
    yield from _by_logic(group)
    plain = [draw for draw in group if not textured(draw)]
    yield from _without_effect(plain)
    yield from _same_color(plain)


def _by_logic(group: list[Drawn]) -> Iterator[Suspect]:
    if mine := [d for d in _of(group, "GL_COLOR_LOGIC_OP") if d.passed and not d.changed]:
        yield Suspect(
            "logic-op",
            at=_setter(mine, "GL_LOGIC_OP_MODE") or _setter(mine, "GL_COLOR_LOGIC_OP"),
            change=off("GL_COLOR_LOGIC_OP", mine),
            strength=82,
            state="GL_COLOR_LOGIC_OP",
            value=True,
            values={"operation": mine[0].state["GL_LOGIC_OP_MODE"]},
            draws=mine,
        )


def _without_effect(group: list[Drawn]) -> Iterator[Suspect]:
    """Yield that blending leaves the picture as it was."""
    mine = [d for d in _of(group, "GL_BLEND") if d.passed and not d.changed]
    if mine:
        alpha = mine[0].state["GL_CURRENT_COLOR"][3]
        clear = alpha < 0.02
        yield Suspect(
            "alpha-zero" if clear else "blend",
            at=_setter(mine, "GL_CURRENT_COLOR" if clear else "GL_BLEND_SRC_RGB")
            or _setter(mine, "GL_BLEND"),
            change=off("GL_BLEND", mine),
            strength=80,
            state="GL_CURRENT_COLOR" if clear else "GL_BLEND_SRC_RGB",
            value=alpha if clear else mine[0].state["GL_BLEND_SRC_RGB"],
            values={
                "source": mine[0].state["GL_BLEND_SRC_RGB"],
                "destination": mine[0].state["GL_BLEND_DST_RGB"],
            },
            draws=mine,
        )


def _same_color(group: list[Drawn]) -> Iterator[Suspect]:
    """Yield that a shape has the colour that is behind it."""
    plain = [
        d
        for d in group
        if d.passed
        and not d.changed
        and not d.state["GL_BLEND"]
        and not d.state["GL_COLOR_LOGIC_OP"]
        and not d.state["GL_LIGHTING"]
        and any(d.state["GL_COLOR_WRITEMASK"])
    ]

    if plain:
        change = with_state(["COLOR_BUFFER", "ENABLE"], INVERT, plain)
        color = [float(f"{c:.3g}") for c in plain[0].state["GL_CURRENT_COLOR"][:3]]
        vertices = plain[0].vertices
        given = vertices.color_calls if vertices is not None else []
        yield Suspect(
            "same-color",
            at=given[0][1] if given else _setter(plain, "GL_CURRENT_COLOR"),
            change=change,
            strength=62,
            state="GL_CURRENT_COLOR",
            value=color,
            values={"n": sum(d.passed for d in plain)},
            draws=plain,
            source="" if given or _setter(plain, "GL_CURRENT_COLOR") else plain[0].call.source,
        )


def _fogged(survey: Survey, group: list[Drawn]) -> Iterator[Suspect]:
    mine = [d for d in _of(group, "GL_FOG") if d.passed]
    if mine:
        state = mine[0].state
        linear = state["GL_FOG_MODE"] == "GL_LINEAR"
        name = "GL_FOG_END" if linear else "GL_FOG_DENSITY"
        span = mine[0].placed.distances if mine[0].placed is not None else (0.0, 0.0)
        yield Suspect(
            "fog",
            at=_setter(mine, name) or _setter(mine, "GL_FOG"),
            change=off("GL_FOG", mine),
            strength=82,
            state=name,
            value=state[name],
            values={"nearest": span[0], "farthest": span[1]},
            draws=mine,
        )


def all_fogged(survey: Survey) -> Iterator[Suspect]:
    """A fog so thick that every shape in it has nothing but its colour."""
    mine = [d for d in survey.shapes if d.state["GL_FOG"] and d.passed]
    if not mine:
        return
    clear = survey.trial.picture(off("GL_FOG", mine))
    if clear is None:
        return
    mask = changed(survey.base, clear)
    haze = np.rint(np.array(mine[0].state["GL_FOG_COLOR"][:3]) * 255.0)
    if mask.any() and np.abs(survey.base[mask] - haze).max() <= 3:
        yield from _fogged(survey, mine)


def _deep(shapes: list[Drawn]) -> list[Drawn]:
    """Return what is drawn in perspective; if nothing is, what is at several depths."""
    solid = [draw for draw in shapes if perspective(draw.state["GL_PROJECTION_MATRIX"])]
    return solid or [d for d in shapes if d.placed is not None and np.ptp(d.placed.clip[:, 2]) > 0]


def _with_depth_cleared(cleared: Sequence[Drawn]) -> Change:
    """Return the change that clears the depth where colours are cleared, or as the frame begins."""
    color = int(gl.GL_COLOR_BUFFER_BIT)
    after = cleared[-1].place if cleared and int(cleared[-1].call.args[0]) & color else ""
    clear: list[Action] = [("glClear", (gl.GL_DEPTH_BUFFER_BIT,))]
    return Change(after={after: clear}) if after else Change(first=clear)


def missing_depth_test(survey: Survey) -> Iterator[Suspect]:
    """No depth test in a frame with depth: what is drawn later lies on top."""
    shapes = survey.shapes
    if not shapes or any(draw.state["GL_DEPTH_TEST"] for draw in shapes):
        return
    if survey.past is not None and survey.past.first.get("GL_DEPTH_TEST"):
        return  # it was on in the first frame: an earlier one has left it off
    solid = _deep(shapes)
    if not solid:
        return
    cleared = [d for d in survey.draws if d.call.name == "glClear"]
    clears = any(int(d.call.args[0]) & int(gl.GL_DEPTH_BUFFER_BIT) for d in cleared)
    actions: list[Action] = [
        ("glEnable", (gl.GL_DEPTH_TEST,)),
        ("glDepthFunc", (gl.GL_LEQUAL,)),
        ("glDepthMask", (True,)),
    ]
    change = with_state(["ENABLE", "DEPTH_BUFFER"], actions, solid)
    if not clears:
        change |= _with_depth_cleared(cleared)

    area = survey.base.shape[0] * survey.base.shape[1]
    yield Suspect(
        "no-depth-test",
        at=None,
        change=change,
        strength=87 if clears else 66,
        state="GL_DEPTH_TEST",
        value=False,
        draws=solid,
        source=_opening(survey),
        least=0 if clears else area // 50,
    )


def _opening(survey: Survey) -> str:
    """Return the line where something could be switched on: that of the setup's first call."""
    calls = survey.tape.calls
    return calls[0].source if calls else ""


def translucent_first(survey: Survey) -> Iterator[Suspect]:
    """A translucent shape that writes depth, and hides what is drawn behind it later."""
    glasses = [
        d
        for d in survey.shapes
        if d.state["GL_BLEND"]
        and d.state["GL_DEPTH_TEST"]
        and d.state["GL_DEPTH_WRITEMASK"]
        and 0.0 < _alpha(d) < 0.99
        and d.passed
        and d.state["GL_BLEND_DST_RGB"] not in ("GL_ZERO",)
    ]

    # Objects behind a plane of water may well be hidden: a smaller share proves less.
    share = 3 if survey.pixel is None else 5
    for glass in glasses[:20]:
        later = [d for d in survey.shapes if d.index > glass.index and d.state["GL_DEPTH_TEST"]]
        opaque = [d for d in later if _alpha(d) >= 0.99 or not d.state["GL_BLEND"]]
        if not opaque:
            continue
        change = with_state(["DEPTH_BUFFER"], [("glDepthMask", (False,))], [glass])
        part = 12 if survey.pixel is None and _hides_half(survey, change, opaque) else share
        yield Suspect(
            "translucent-first",
            at=glass.call,
            change=change,
            strength=86,
            state="GL_DEPTH_WRITEMASK",
            value=True,
            values={"alpha": round(_alpha(glass), 3), "later": opaque[0].call.site.line},
            draws=[glass],
            least=sum(d.passed for d in glasses if d.chain == glass.chain) // part,
        )


def _hides_half(survey: Survey, change: Change, opaque: Sequence[Drawn]) -> bool:
    """Return whether some shape loses half of its fragments, which it has with a change."""
    counts = survey.trial.counts(change)
    return counts is not None and any(
        draw.passed * 2 < counts[draw.index] and counts[draw.index] * 3 > draw.covered
        for draw in opaque
    )


def _alpha(draw: Drawn) -> float:
    if draw.vertices is not None and draw.vertices.colors:
        given = [color[3] if len(color) > 3 else 1.0 for color in draw.vertices.colors]
        return float(np.mean(given))
    return float(draw.state["GL_CURRENT_COLOR"][3])


def blend_missing(survey: Survey) -> Iterator[Suspect]:
    """A translucent colour or image without blending."""
    shapes = [draw for draw in survey.shapes if draw.passed]
    if any(draw.state["GL_BLEND"] for draw in survey.shapes):
        yield from _function_alone(survey)
        yield from _solid_at_pixel(shapes)
        return
    if not shapes:
        return
    setter = shapes[0].setter("GL_BLEND_SRC_RGB") or shapes[0].setter("GL_BLEND_DST_RGB")
    if setter is not None:
        yield from _blending_asked_for(shapes, setter)
        return

    mine = [
        draw
        for draw in shapes
        if 0.0 <= _alpha(draw) < 0.99
        and not draw.state["GL_LIGHTING"]
        and not draw.state["GL_ALPHA_TEST"]
    ]
    if mine:
        yield _without_blending(
            mine,
            mine[0].setter("GL_CURRENT_COLOR") or mine[0].call,
            [("glBlendFunc", (gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA))],
            alpha=_alpha(mine[0]),
            strength=58,
        )


def _solid_at_pixel(shapes: list[Drawn]) -> Iterator[Suspect]:
    """Yield that what is drawn at the pixel is translucent, and blending is on for others only."""
    here = [draw for draw in shapes if draw.at_pixel[0] and not draw.state["GL_BLEND"]]
    for draw in here[-1:]:
        switch = draw.setter("GL_BLEND")
        meant = switch is not None and switch.name == "glDisable"
        alpha = min(_alpha(draw), texture_alpha(draw))
        if alpha < 0.99 and not (meant or draw.state["GL_ALPHA_TEST"] or draw.state["GL_LIGHTING"]):
            yield _without_blending([draw], draw.call, [], alpha=alpha, strength=58)


def _function_alone(survey: Survey) -> Iterator[Suspect]:
    """Yield that blending has a function for some draws of a frame, and is not enabled for them.

    The function must be set in the frame, after blending was switched off for something else.
    """
    groups: dict[int, list[Drawn]] = {}
    for draw in survey.shapes:
        setter = draw.setter("GL_BLEND_SRC_RGB")
        if in_frame(survey, setter):
            groups.setdefault(id(setter), []).append(draw)

    for mine in groups.values():
        setter, switch = mine[0].setter("GL_BLEND_SRC_RGB"), mine[0].setter("GL_BLEND")
        if setter is None or any(draw.state["GL_BLEND"] for draw in mine):
            continue
        if not in_frame(survey, switch) or (switch is not None and switch.number < setter.number):
            yield from _blending_asked_for([draw for draw in mine if draw.passed], setter)


def _blending_asked_for(shapes: list[Drawn], setter: Call) -> Iterator[Suspect]:
    """Yield that the program calls glBlendFunc, and never enables blending."""
    for draw in shapes:
        alpha = min(_alpha(draw), texture_alpha(draw))
        if alpha < 0.99:
            yield _without_blending(shapes, setter, [], alpha=alpha, strength=88)
            return


def _without_blending(
    draws: list[Drawn], at: Call, actions: list[Action], *, alpha: float, strength: float
) -> Suspect:
    return Suspect(
        "no-blend",
        at=at,
        change=with_state(
            ["ENABLE", "COLOR_BUFFER"], [("glEnable", (gl.GL_BLEND,)), *actions], draws
        ),
        strength=strength,
        state="GL_BLEND",
        value=False,
        values={"alpha": round(alpha, 3)},
        draws=draws,
    )


def texture_alpha(draw: Drawn) -> float:
    """Return the least alpha of the texture that a draw uses, 1 if it uses none."""
    texture = int(draw.state["GL_TEXTURE0.GL_TEXTURE_BINDING_2D"])
    if not draw.state["GL_TEXTURE0.GL_TEXTURE_2D"] or completeness(texture) is not None:
        return 1.0
    former = int(gl.glGetIntegerv(gl.GL_TEXTURE_BINDING_2D))
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    image = np.frombuffer(
        bytes(gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)), np.uint8
    )
    gl.glBindTexture(gl.GL_TEXTURE_2D, former)
    return float(image[3::4].min(initial=255)) / 255.0


def overdrawn(survey: Survey) -> Iterator[Suspect]:
    """A draw that covers all that was drawn before it."""
    area = survey.base.shape[0] * survey.base.shape[1]
    shapes = survey.shapes
    for last in shapes[1:][-3:]:
        if last.passed < 0.9 * area or last.state["GL_BLEND"]:
            continue
        before = [d for d in shapes if d.index < last.index and d.passed and d.changed != 0]
        clears = [d for d in survey.draws if d.index < last.index and d.call.name == "glClear"]
        if not before or not clears:
            continue

        moved = Change(
            after={clears[-1].place: [_again(last)]},
            instead={step.place: () for step in last.steps if step.place},
        )
        yield Suspect(
            "overdrawn",
            at=last.call,
            change=moved,
            strength=64,
            values={"draws": len(before)},
            draws=before,
        )


def _again(draw: Drawn) -> Callable[[], None]:
    def act() -> None:
        modelview, projection = (
            np.array(gl.glGetDoublev(gl_constant(f"GL_{mode}_MATRIX"))) for mode in MODES
        )
        gl.glPushAttrib(gl.GL_ALL_ATTRIB_BITS)
        for mode in MODES:
            load(f"GL_{mode}", draw.state[f"GL_{mode}_MATRIX"])()
        gl.glColor4f(*draw.state["GL_CURRENT_COLOR"])
        for name in ("GL_DEPTH_TEST", "GL_LIGHTING", "GL_BLEND"):
            (gl.glEnable if draw.state[name] else gl.glDisable)(gl_constant(name))
        gl.glDepthMask(False)
        draw.draw.issue()
        gl.glPopAttrib()
        load("GL_MODELVIEW", modelview)()
        load("GL_PROJECTION", projection)()

    return act


MODES = ("MODELVIEW", "PROJECTION")


def viewports(survey: Survey) -> Iterator[Suspect]:
    """A viewport without area, or beside the window."""
    width, height = survey.tape.size
    mine = []
    for draw in survey.shapes:
        x, y, w, h = draw.state["GL_VIEWPORT"]
        if w <= 0 or h <= 0 or x >= width or y >= height or x + w <= 0 or y + h <= 0:
            mine.append(draw)

    if mine:
        box = [int(v) for v in mine[0].state["GL_VIEWPORT"]]
        yield Suspect(
            "viewport",
            at=mine[0].setter("GL_VIEWPORT"),
            change=with_state(["VIEWPORT"], [("glViewport", (0, 0, width, height))], mine),
            strength=96,
            state="GL_VIEWPORT",
            value=box,
            values={"box": box, "width": width, "height": height},
            draws=mine,
        )


def other_target(survey: Survey) -> Iterator[Suspect]:
    """Draws into a framebuffer that no one shows, or in a mode that draws nothing."""
    mine = [d for d in survey.shapes if d.state.get("GL_RENDER_MODE") not in (None, "GL_RENDER")]
    if mine:
        yield Suspect(
            "render-mode",
            at=mine[0].setter("GL_RENDER_MODE"),
            change=Change(before={mine[0].place: [("glRenderMode", (gl.GL_RENDER,))]}),
            strength=90,
            state="GL_RENDER_MODE",
            value=mine[0].state["GL_RENDER_MODE"],
            draws=mine,
        )

    start = survey.tape.start.get("GL_DRAW_FRAMEBUFFER_BINDING", 0)
    name = "GL_DRAW_FRAMEBUFFER_BINDING"
    aside = [d for d in survey.draws if d.state.get(name) != start]
    if aside and aside[-1] is survey.draws[-1]:
        yield Suspect(
            "framebuffer",
            at=aside[-1].setter(name),
            change=Change(
                around=(
                    Around(
                        0,
                        [("glBindFramebuffer", (gl.GL_FRAMEBUFFER, int(start)))],
                        frozenset(d.place for d in aside),
                        [("glBindFramebuffer", (gl.GL_FRAMEBUFFER, aside[-1].state[name]))],
                    ),
                )
            ),
            strength=72,
            state=name,
            value=aside[-1].state[name],
            draws=aside,
        )


def wireframe(survey: Survey) -> Iterator[Suspect]:
    """Lines or points instead of faces: the polygon mode of something else, left on."""
    outlined: dict[int, list[Drawn]] = {}
    for draw in survey.shapes:
        if tuple(draw.state["GL_POLYGON_MODE"]) != ("GL_FILL", "GL_FILL"):
            setter = draw.setter("GL_POLYGON_MODE")
            outlined.setdefault(id(setter), []).append(draw)

    for draws in outlined.values():
        setter = draws[0].setter("GL_POLYGON_MODE")
        if setter is None:
            continue
        function = setter.site.function
        others = [draw for draw in draws if function not in _functions(draw)]
        if others and others[0] is not draws[0]:
            yield Suspect(
                "wireframe",
                at=setter,
                change=with_state(
                    ["POLYGON"], [("glPolygonMode", (gl.GL_FRONT_AND_BACK, gl.GL_FILL))], others
                ),
                strength=76,
                state="GL_POLYGON_MODE",
                value=list(others[0].state["GL_POLYGON_MODE"]),
                values={"function": function, "later": others[0].call.site.line},
                draws=others,
            )


def _functions(draw: Drawn) -> set[str]:
    """Return the functions of the program in which a draw is made."""
    return {draw.call.site.function, *(name for name, _ in draw.chain)}


RULES = (
    lifted,
    all_fogged,
    odd_faces,
    holes,
    near_zero,
    missing_depth_test,
    translucent_first,
    blend_missing,
    overdrawn,
    viewports,
    other_target,
    wireframe,
)
__all__ = ["RULES", "on"]
