"""Rules about lighting, in the order of its formula: lights, normals, materials.

Is a light on at all, and where is it? Has each vertex a normal, of length 1, to the side of the
light? Which colour does the material have: that of glColor, or one left by something else?
"""

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from framelens.gl.named import gl_constant
from framelens.gl.seam import Call, GluCall, gl
from framelens.program.past import Past
from framelens.why.geometry import Vertices
from framelens.why.survey import Drawn, Survey
from framelens.why.suspects import (
    Suspect,
    closed,
    in_frame,
    matrix_of,
    off,
    on,
    perspective,
    with_state,
    written,
)
from framelens.why.trial import Action, Around, Change

AHEAD = np.array((0.0, 0.0, -1.0))  # where the eye looks
AWAY = "away"
FACING = "facing"  # the eye
LIGHTS = tuple(f"GL_LIGHT{k}" for k in range(8))


def lit(survey: Survey) -> list[Drawn]:
    """Return the draws that are lit and have fragments."""
    return [d for d in survey.shapes if d.state["GL_LIGHTING"] and d.passed]


def lights(survey: Survey) -> Iterator[Suspect]:
    """No light is on, the one that is set is not, or it is behind what it should light."""
    mine = lit(survey)
    dark = [d for d in mine if not any(d.state[name] for name in LIGHTS)]
    if dark and len(dark) == len(mine):
        setters = dark[0].setters.last
        named = [name for name in LIGHTS if any(v.startswith(f"{name}.") for v in setters)]
        for name in (*named, "GL_LIGHT0"):
            set_by = next((c for v, c in setters.items() if v.startswith(f"{name}.")), None)
            yield Suspect(
                "light-off",
                at=set_by or dark[0].setter("GL_LIGHTING"),
                change=on(name, dark),
                strength=90,
                state=name,
                value=False,
                values={"light": name},
                draws=dark,
            )
        return

    yield from _set_and_off(survey, mine)
    yield from _unlit(survey)
    if mine and _dark(survey, mine):
        yield from _weakened(mine)
        yield from _far_side(survey, mine)
    elif mine:
        yield from _moved_away(mine)


def _weakened(mine: Sequence[Drawn]) -> Iterator[Suspect]:
    """Yield that a light's cone does not reach what is dark, or that it fades before it does."""
    state = mine[0].state
    for name in LIGHTS:
        if not state.get(name):
            continue
        cutoff = float(state[f"{name}.GL_SPOT_CUTOFF"])
        if cutoff < 180.0:
            yield Suspect(
                "spot",
                at=mine[0].setter(f"{name}.GL_SPOT_DIRECTION")
                or mine[0].setter(f"{name}.GL_SPOT_CUTOFF"),
                change=_of_light(name, [("GL_SPOT_CUTOFF", 180.0)], mine),
                strength=84,
                state=f"{name}.GL_SPOT_CUTOFF",
                value=cutoff,
                values={"light": name, "cutoff": cutoff},
                draws=mine,
            )

        fading = [kind for kind in FADING if state[f"{name}.{kind}"] > 0.0]
        if fading or state[f"{name}.GL_CONSTANT_ATTENUATION"] > 1.0:
            kind = fading[-1] if fading else "GL_CONSTANT_ATTENUATION"
            even = [("GL_CONSTANT_ATTENUATION", 1.0), *((each, 0.0) for each in FADING)]
            yield Suspect(
                "attenuation",
                at=mine[0].setter(f"{name}.{kind}"),
                change=_of_light(name, even, mine),
                strength=83,
                state=f"{name}.{kind}",
                value=state[f"{name}.{kind}"],
                values={"light": name, "kind": kind},
                draws=mine,
            )


FADING = ("GL_LINEAR_ATTENUATION", "GL_QUADRATIC_ATTENUATION")


def _of_light(name: str, values: Sequence[tuple[str, float]], draws: Sequence[Drawn]) -> Change:
    """Return the change that gives a light other numbers."""
    actions: list[Action] = [
        ("glLightf", (gl_constant(name), gl_constant(key), value)) for key, value in values
    ]
    return with_state(["LIGHTING"], actions, draws)


def _set_and_off(survey: Survey, mine: Sequence[Drawn]) -> Iterator[Suspect]:
    """Yield that a light is set and not enabled.

    Without a pixel only where the others leave all nearly dark: a light may well be switched off.
    """
    if not mine:
        return
    dark = _dark(survey, mine)
    if not dark and survey.pixel is None:
        return

    setters = mine[-1].setters.last
    for name in LIGHTS:
        set_by = next((c for v, c in setters.items() if v.startswith(f"{name}.")), None)
        switch = mine[-1].setter(name)
        if not dark and switch is not None and switch.name == "glDisable":
            continue
        if set_by is not None and not any(d.state[name] for d in mine):
            yield Suspect(
                "light-off",
                at=set_by,
                change=on(name, mine),
                strength=81 if dark else 72,
                state=name,
                value=False,
                values={"light": name},
                draws=mine,
            )


def _unlit(survey: Survey) -> Iterator[Suspect]:
    """Yield that lights are on, normals are given, and lighting is not enabled.

    Where the program disables it, a material that the frame sets tells that it is meant to be on:
    without light it has no effect.
    """
    shapes = survey.shapes
    if not shapes or any(d.state["GL_LIGHTING"] for d in shapes):
        return
    bright = [d for d in shapes if any(d.state[name] for name in LIGHTS)]
    mine = [d for d in bright if _has_normals(d) and _reflects(d)]
    switch = mine[0].setter("GL_LIGHTING") if mine else None
    asked = switch is None or switch.name != "glDisable"
    if mine and (asked or any(in_frame(survey, d.setter("GL_FRONT.GL_DIFFUSE")) for d in mine)):
        light = next(name for name in LIGHTS if mine[0].state[name])
        yield Suspect(
            "lighting-off",
            at=mine[0].setter(light),
            change=on("GL_LIGHTING", mine),
            strength=84,
            state="GL_LIGHTING",
            value=False,
            values={"light": light},
            draws=mine,
        )


def _has_normals(draw: Drawn) -> bool:
    """Return whether a draw gives normals, as what is to be lit does."""
    given = draw.vertices is not None and draw.vertices.normals is not None
    shaped = draw.call.name.startswith("glut")
    return given or shaped or draw.setter("GL_CURRENT_NORMAL") is not None


def _reflects(draw: Drawn) -> bool:
    """Return whether a draw has a material, or else nothing but the light would shade it.

    Textures and the colours of vertices may have the light painted in.
    """
    if draw.state["GL_COLOR_MATERIAL"] or draw.setter("GL_FRONT.GL_DIFFUSE") is not None:
        return True
    colored = draw.state["GL_COLOR_ARRAY"] or _within(draw, "glColor")
    return not colored and not draw.state["GL_TEXTURE0.GL_TEXTURE_2D"]


def _far_side(survey: Survey, mine: list[Drawn]) -> Iterator[Suspect]:
    """Yield that what is seen of all lit shapes faces away from every light."""
    past = survey.past
    if past is not None and past.frame and any(note.name == "gluLookAt" for note in survey.glu):
        return  # a camera that moves may well look at the dark side
    for name in LIGHTS:
        if not mine[0].state[name]:
            continue
        yield _turned_to(name, mine)


def _turned_to(name: str, mine: list[Drawn]) -> Suspect:
    """Suspect that a light is on the far side; the change puts it on the side of the eye."""
    set_by = mine[0].setter(f"{name}.GL_POSITION")
    values: dict[str, object] = {"light": name}
    if set_by is not None:
        values["call"] = written(set_by)
        values["position"] = [float(v) for v in np.ravel(np.asarray(set_by.args[2]))]

    def turned() -> None:
        distant = mine[0].state[f"{name}.GL_POSITION"][3] == 0
        gl.glPushMatrix()
        gl.glLoadIdentity()
        gl.glLightfv(gl_constant(name), gl.GL_POSITION, (0, 0, 1, 0) if distant else (0, 0, 0, 1))
        gl.glPopMatrix()

    return Suspect(
        "light-far-side",
        at=set_by or mine[0].setter(name),
        change=with_state(["LIGHTING"], [_in_modelview(turned)], mine),
        strength=78,
        state=f"{name}.GL_POSITION",
        value=values.get("position"),
        values=values,
        draws=mine,
    )


def _moved_away(mine: Sequence[Drawn]) -> Iterator[Suspect]:
    """Yield that a light is placed twice, and one time on the far side of a shape.

    The other time it lights what the same line draws.
    """
    for name in LIGHTS:
        groups: dict[int, list[Drawn]] = {}
        for draw in mine:
            if draw.state[name] and (set_by := draw.setter(f"{name}.GL_POSITION")) is not None:
                groups.setdefault(id(set_by), []).append(draw)
        for key, group in groups.items():
            others = [draw for other, draws in groups.items() if other != key for draw in draws]
            bright = {d.call.source for d in others if _share(d, name) > BRIGHT}
            dark = [d for d in group if d.call.source in bright and _share(d, name) < GRAZED]
            if dark and all(_share(draw, name) < GRAZED for draw in group if draw.changed):
                yield _turned_to(name, dark)


GRAZED, BRIGHT = 0.1, 0.25  # of a light, on average over what faces the eye; chosen


def _ways(draw: Drawn, name: str, eye: np.ndarray) -> np.ndarray:
    """Return the ways to a light (n, 3) from points in eye space (n, 3)."""
    place = np.array(draw.state[f"{name}.GL_POSITION"], np.float64)
    return place[:3] / place[3] - eye if place[3] else np.tile(place[:3], (len(eye), 1))


def _share(draw: Drawn, name: str) -> float:
    """Return how much of a light falls on what faces the eye, 0 to 1; not a number if unknown."""
    found = draw.vertices
    if found is None or found.normals is None or len(found.normals) != len(found.positions):
        return float("nan")
    matrix = matrix_of(draw, "GL_MODELVIEW")
    if not np.linalg.det(matrix[:3, :3]):
        return float("nan")
    eye = (found.positions @ matrix)[:, :3]
    ways = _ways(draw, name, eye)
    turned = found.normals @ np.linalg.inv(matrix[:3, :3]).T
    lensed = perspective(draw.state["GL_PROJECTION_MATRIX"])
    sight = eye if lensed else np.tile(AHEAD, (len(eye), 1))
    facing = (turned * sight).sum(axis=1) < 0
    with np.errstate(all="ignore"):
        lengths = np.linalg.norm(turned, axis=1) * np.linalg.norm(ways, axis=1)
        cosines = np.clip((turned * ways).sum(axis=1) / lengths, 0.0, 1.0)
    return float(cosines[facing].mean()) if facing.any() else float("nan")


def _in_modelview(act: Callable[[], object]) -> Callable[[], None]:
    def acted() -> None:
        mode = int(gl.glGetIntegerv(gl.GL_MATRIX_MODE))
        gl.glMatrixMode(gl.GL_MODELVIEW)
        act()
        gl.glMatrixMode(mode)

    return acted


def _dark(survey: Survey, mine: Sequence[Drawn]) -> bool:
    """Return whether lit shapes are nearly black: only their ambient share is seen."""
    picture = survey.trial.picture(off("GL_LIGHTING", mine))
    if picture is None:
        return False
    mask = np.abs(picture.astype(int) - survey.base.astype(int)).max(axis=2) > 6
    if not mask.any():
        return False
    seen = survey.base[mask].astype(float).max(axis=1)
    return bool(np.percentile(seen, 99.5) < 70)


def no_normals(survey: Survey) -> Iterator[Suspect]:
    """Lit shapes without a normal."""
    bare = [draw for draw in lit(survey) if _bare(draw)]
    if bare:
        yield Suspect(
            "no-normals",
            at=bare[0].call,
            change=_with_normals(bare),
            strength=80,
            state="GL_CURRENT_NORMAL",
            value=[round(float(v), 3) for v in bare[0].state["GL_CURRENT_NORMAL"]],
            values={"n": sum(d.placed.count for d in bare if d.placed is not None)},
            draws=bare,
        )


def _bare(draw: Drawn) -> bool:
    """Return whether faces are drawn, and no normal was ever given for them."""
    found = draw.vertices
    if found is None or found.normals is not None or found.mode in LINES:
        return False
    if not draw.covered or draw.call.name not in WITH_VERTICES:
        return False
    return draw.setter("GL_CURRENT_NORMAL") is None and not draw.state["GL_NORMAL_ARRAY"]


def normals_length(survey: Survey) -> Iterator[Suspect]:
    """Normals whose length a scale changes, where light is computed."""
    lengths = [(draw, _normal_length(draw)) for draw in lit(survey)]
    scaled = [(draw, length) for draw, length in lengths if not 0.6 <= length <= 1.6]
    if not scaled:
        return
    first, _ = scaled[0]
    chain = first.setters.chained.get("GL_MODELVIEW_MATRIX", [])
    scale = next((call for call in reversed(chain) if call.name.startswith("glScale")), None)
    yield Suspect(
        "normals-length",
        at=scale or first.setter("GL_CURRENT_NORMAL") or first.call,
        change=on("GL_NORMALIZE", [draw for draw, _ in scaled]),
        strength=82,
        state="GL_NORMALIZE",
        value=False,
        values={"length": round(scaled[-1][1], 2)},
        draws=[draw for draw, _ in scaled],
    )


def _normal_length(draw: Drawn) -> float:
    """Return the median length of a draw's normals in the eye's space, 1 where it is not known."""
    if draw.state["GL_NORMALIZE"] or draw.state["GL_RESCALE_NORMAL"]:
        return 1.0
    matrix = matrix_of(draw, "GL_MODELVIEW")[:3, :3]
    if not np.isfinite(matrix).all() or abs(np.linalg.det(matrix)) < 1e-12:
        return 1.0

    found = draw.vertices
    vectors = np.array([draw.state["GL_CURRENT_NORMAL"][:3]], float)
    if draw.call.name.startswith("glut"):
        vectors = np.eye(3)
    elif found is not None and found.normals is not None:
        vectors = np.asarray(found.normals, float)
    lengths = np.linalg.norm(vectors @ np.linalg.inv(matrix).T, axis=1)
    lengths = lengths[np.isfinite(lengths)]
    return float(np.median(lengths)) if lengths.size else 1.0


LINES = ("GL_LINES", "GL_LINE_STRIP", "GL_LINE_LOOP", "GL_POINTS")
WITH_VERTICES = ("glBegin", "glDrawArrays", "glDrawElements", "glDrawRangeElements")


def _towards_the_eye(corners: np.ndarray, lensed: bool) -> np.ndarray | None:
    """Return the unit normal of a face, (n, 3) in eye coordinates; None if it has none.

    ``lensed``: whether the projection is a perspective.
    """
    if len(corners) < 3:
        return None
    a, b, c = corners[:3]
    normal = np.cross(b - a, c - a)
    length = float(np.linalg.norm(normal))
    if not length:
        return None
    normal = normal / length
    return -normal if normal @ (a if lensed else AHEAD) > 0 else normal


def _normals(draw: Drawn, found: Vertices) -> dict[int, tuple[float, ...]]:
    """Return for each vertex of a face the normal of the first face that it is of."""
    matrix = matrix_of(draw, "GL_MODELVIEW")
    eye = (found.positions @ matrix)[:, :3]
    lensed = perspective(draw.state["GL_PROJECTION_MATRIX"])
    normal_of: dict[int, tuple[float, ...]] = {}
    for face in found.faces:
        normal = _towards_the_eye(eye[face], lensed)
        if normal is None:
            continue
        back = normal @ matrix[:3, :3].T
        size = float(np.linalg.norm(back)) or 1.0
        for k in face:
            normal_of.setdefault(k, tuple((back / size).tolist()))
    return normal_of


def _with_normals(draws: Sequence[Drawn]) -> Change:
    """Return the change that draws each face with its own normal, towards the eye."""
    instead: dict[str, Sequence[Action]] = {}
    for draw in draws:
        found = draw.vertices
        assert found is not None
        normal_of = _normals(draw, found)
        if found.places:
            for k, normal_ in normal_of.items():
                place = found.places[k]
                call = next(step.call for step in draw.steps if step.place == place)
                instead[place] = [("glNormal3f", normal_), (call.name, call.args)]
        else:
            instead[draw.place] = [_as_triangles(draw, normal_of)]

    return Change(instead=instead)


def _as_triangles(draw: Drawn, normal_of: dict[int, tuple[float, ...]]) -> Action:
    found = draw.vertices
    assert found is not None

    def act() -> None:
        for face in found.faces:
            gl.glBegin(gl.GL_POLYGON)
            for k in face:
                gl.glNormal3f(*normal_of.get(k, (0.0, 0.0, 1.0)))
                gl.glVertex4d(*found.positions[k])
            gl.glEnd()

    return act


def normals_away(survey: Survey) -> Iterator[Suspect]:
    """Normals that point away from the eye on all that is seen."""
    mine = lit(survey)
    wrong: list[Drawn] = []
    for group in survey.same(mine):
        sides = [_sides(draw) for draw in group]
        away, facing = sum(a for a, _ in sides), sum(f for _, f in sides)
        if away and away > 9 * facing:
            wrong += group

    if wrong:
        call = next(
            (step.call for step in wrong[0].steps if step.call.name.startswith("glNormal")),
            wrong[0].setter("GL_NORMAL_ARRAY_POINTER") or wrong[0].call,
        )
        yield Suspect(
            "normals-away",
            at=call,
            change=with_state(["LIGHTING"], [_two_sided_turned], wrong),
            strength=79,
            state="GL_CURRENT_NORMAL",
            draws=wrong,
        )


def _sides(draw: Drawn) -> tuple[int, int]:
    """Return of how many faces the normals point away from the eye, and of how many towards it."""
    found = draw.vertices
    if found is None or found.normals is None or draw.state["GL_LIGHT_MODEL_TWO_SIDE"]:
        return 0, 0
    if len(found.normals) != len(found.positions) or found.mode in LINES:
        return 0, 0
    matrix = matrix_of(draw, "GL_MODELVIEW")
    eye = (found.positions @ matrix)[:, :3]
    try:
        turned = found.normals @ np.linalg.inv(matrix[:3, :3]).T
    except np.linalg.LinAlgError:
        return 0, 0

    solid = closed(draw)
    lensed = perspective(draw.state["GL_PROJECTION_MATRIX"])
    winding = 1.0 if draw.state["GL_FRONT_FACE"] == "GL_CCW" else -1.0
    sides = [
        _side(eye[face[:3]], turned[face[0]], winding, lensed, solid)
        for face in found.faces[:3000]
        if len(face) >= 3
    ]
    return sides.count(AWAY), sides.count(FACING)


def _side(
    corners: np.ndarray, normal: np.ndarray, winding: float, lensed: bool, solid: bool
) -> str:
    """Return whether a face's normal points AWAY from the eye or is FACING it; "" if hidden.

    ``corners`` (3, 3) are three of its corners in eye space; ``winding`` is 1 if it is seen
    counterclockwise from in front. It is ``lensed`` by a perspective, and of a ``solid`` or a
    sheet.
    """
    a, b, c = corners
    sight = a if lensed else AHEAD
    front = winding * np.cross(b - a, c - a)
    if front @ sight >= 0:
        # Turned away: of a closed shape it is hidden, of a sheet it is seen as well.
        return FACING if not solid and normal @ sight < 0 else ""
    return AWAY if front @ normal < 0 else FACING


def _two_sided_turned() -> None:
    """Light the other side: lights go through the origin of the eye's directions."""
    for k in range(8):
        if gl.glIsEnabled(gl.GL_LIGHT0 + k):
            x, y, z, w = (float(v) for v in gl.glGetLightfv(gl.GL_LIGHT0 + k, gl.GL_POSITION))
            if w:
                continue
            mode = int(gl.glGetIntegerv(gl.GL_MATRIX_MODE))
            gl.glMatrixMode(gl.GL_MODELVIEW)
            gl.glPushMatrix()
            gl.glLoadIdentity()
            gl.glLightfv(gl.GL_LIGHT0 + k, gl.GL_POSITION, (-x, -y, -z, w))
            gl.glPopMatrix()
            gl.glMatrixMode(mode)
    gl.glLightModeli(gl.GL_LIGHT_MODEL_TWO_SIDE, 1)


def materials(survey: Survey) -> Iterator[Suspect]:
    """Materials: glColor without GL_COLOR_MATERIAL, an emission left by something else, black."""
    mine = lit(survey)
    if not mine:
        return
    yield from _color_material(survey, mine)
    yield from _color_elsewhere(mine)
    yield from _back_only(survey, mine)
    yield from _emission(survey, mine)
    yield from _black(survey, mine)


MATERIALS = ("glMaterial",)


def _color_material(survey: Survey, mine: Sequence[Drawn]) -> Iterator[Suspect]:
    plain = [d for d in mine if not d.state["GL_COLOR_MATERIAL"]]
    if not plain or any(d.state["GL_COLOR_MATERIAL"] for d in mine):
        return
    diffuse = [
        d
        for d in plain
        if not any(d.setter(f"{face}.GL_DIFFUSE") for face in ("GL_FRONT", "GL_BACK"))
        and not _within(d, "glMaterial")
    ]
    colored = [
        d
        for d in diffuse
        if d.setter("GL_CURRENT_COLOR") is not None
        or _within(d, "glColor")
        or d.state["GL_COLOR_ARRAY"]
    ]
    colored = [d for d in colored if not d.state["GL_TEXTURE0.GL_TEXTURE_2D"]]
    if not any(_colorful(d) for d in colored):
        return

    first = colored[0]
    color = first.setter("GL_CURRENT_COLOR")
    if first.state["GL_COLOR_ARRAY"]:
        color = first.setter("GL_COLOR_ARRAY_POINTER") or color
    yield Suspect(
        "no-color-material",
        at=_enabled_by(survey, first, "GL_LIGHTING") or color,
        change=on("GL_COLOR_MATERIAL", colored),
        strength=87,
        state="GL_COLOR_MATERIAL",
        value=False,
        values={"color": _line(color)},
        draws=colored,
    )


def _enabled_by(survey: Survey, draw: Drawn, name: str) -> Call | None:
    """Return the call that enabled something for a draw.

    It is not the one that switched it last, where a glPopAttrib has brought it back.
    """
    setter = draw.setter(name)
    if setter is None or setter.name == "glEnable":
        return setter
    earlier = survey.tape.calls[: draw.number]
    enabling = [
        c for c in earlier if c.name == "glEnable" and int(c.args[0]) == int(gl_constant(name))
    ]
    return enabling[-1] if enabling else setter


def _color_elsewhere(mine: Sequence[Drawn]) -> Iterator[Suspect]:
    """Yield that glColor goes into the back's material, or into another part than the diffuse."""
    wrong = [
        draw
        for draw in mine
        if draw.state["GL_COLOR_MATERIAL"]
        and draw.setter("GL_FRONT.GL_DIFFUSE") is None
        and _colorful(draw)
        and (
            draw.state["GL_COLOR_MATERIAL_FACE"] == "GL_BACK"
            or draw.state["GL_COLOR_MATERIAL_PARAMETER"] in ("GL_SPECULAR", "GL_AMBIENT")
        )
    ]
    if not wrong:
        return

    state = wrong[0].state
    face, parameter = state["GL_COLOR_MATERIAL_FACE"], state["GL_COLOR_MATERIAL_PARAMETER"]
    around = [
        Around(
            int(gl.GL_LIGHTING_BIT) | int(gl.GL_CURRENT_BIT),
            [
                ("glColorMaterial", (gl.GL_FRONT_AND_BACK, gl.GL_AMBIENT_AND_DIFFUSE)),
                ("glColor4f", tuple(float(v) for v in draw.state["GL_CURRENT_COLOR"])),
            ],
            draw.places,
        )
        for draw in wrong
    ]

    yield Suspect(
        "color-material-which",
        at=wrong[0].setter("GL_COLOR_MATERIAL_PARAMETER"),
        change=Change(around=around),
        strength=86,
        state="GL_COLOR_MATERIAL_PARAMETER",
        value=parameter,
        values={"face": face, "parameter": parameter},
        draws=wrong,
    )


def _back_only(survey: Survey, mine: Sequence[Drawn]) -> Iterator[Suspect]:
    """Yield that a material is set for the back faces alone, and the front faces are seen."""
    wrong = [
        draw
        for draw in mine
        if draw.setter("GL_BACK.GL_DIFFUSE") is not None
        and draw.setter("GL_FRONT.GL_DIFFUSE") is None
        and not draw.state["GL_LIGHT_MODEL_TWO_SIDE"]
        and not draw.state["GL_COLOR_MATERIAL"]
    ]
    if not wrong:
        return

    actions: dict[str, list[Action]] = {}
    for draw in wrong:
        setter = draw.setter("GL_BACK.GL_DIFFUSE")
        assert setter is not None
        actions[draw.place] = [(setter.name, (gl.GL_FRONT_AND_BACK, *setter.args[1:]))]

    yield Suspect(
        "material-face",
        at=wrong[0].setter("GL_BACK.GL_DIFFUSE"),
        change=Change(before=actions),
        strength=86,
        state="GL_FRONT.GL_DIFFUSE",
        value=[float(v) for v in wrong[0].state["GL_FRONT.GL_DIFFUSE"]],
        draws=wrong,
    )


def _line(call: Call | GluCall | None) -> int:
    return call.site.line if call is not None else 0


def _colorful(draw: Drawn) -> bool:
    """Return whether glColor gives a draw a colour, not a grey, which lighting may show as well."""
    given = list(draw.vertices.colors) if draw.vertices is not None else []
    colors = [*given, tuple(draw.state["GL_CURRENT_COLOR"])]
    if draw.state["GL_COLOR_ARRAY"]:
        colors += _array_colors(draw)
    return any(max(color[:3]) - min(color[:3]) > 0.1 for color in colors)


def _array_colors(draw: Drawn) -> list[tuple[float, ...]]:
    """Return colours of the array in memory that a draw reads; nothing of one in a buffer."""
    pointers = [args for name, args in draw.call.arrays if name == "glColorPointer"]
    colors = np.asarray(pointers[0][-1] if pointers else ())
    if colors.ndim != 2 or colors.shape[1] < 3:
        return []
    most = float(np.iinfo(colors.dtype).max) if colors.dtype.kind in "iu" else 1.0
    return [tuple(color / most) for color in colors[:SOME, :3].astype(np.float64)]


SOME = 1000  # colours of an array that are looked at; chosen


def _within(draw: Drawn, name: str) -> bool:
    return any(step.call.name.startswith(name) for step in draw.steps)


def _emission(survey: Survey, mine: Sequence[Drawn]) -> Iterator[Suspect]:
    """Yield that an emission set for one thing is still in force for others."""
    left = _left_glowing(mine)
    if left:
        setter = left[0].setter("GL_FRONT.GL_EMISSION")
        yield Suspect(
            "emission-left",
            at=setter,
            change=with_state(
                ["LIGHTING"],
                [("glMaterialfv", (gl.GL_FRONT_AND_BACK, gl.GL_EMISSION, (0.0, 0.0, 0.0, 1.0)))],
                left,
            ),
            strength=85,
            state="GL_FRONT.GL_EMISSION",
            value=[float(v) for v in left[0].state["GL_FRONT.GL_EMISSION"]],
            values={"later": left[0].call.site.line},
            draws=left,
        )


def _left_glowing(mine: Sequence[Drawn]) -> list[Drawn]:
    """Return the draws with an emission that another function has set for something else."""
    glowing = [d for d in mine if max(d.state["GL_FRONT.GL_EMISSION"][:3]) > 0.05]
    left = []
    for draw in glowing:
        setter = draw.setter("GL_FRONT.GL_EMISSION")
        own = draw.setter("GL_FRONT.GL_DIFFUSE")
        if setter is None or setter.site.function == draw.call.site.function:
            continue
        if draw.chain and any(name == setter.site.function for name, _ in draw.chain):
            continue
        users = [d for d in mine if d.setter("GL_FRONT.GL_EMISSION") is setter]
        first = users[0].call.site.function == setter.site.function
        if first or (own is not None and own.number > setter.number):
            left.append(draw)
    return left


def _black(survey: Survey, mine: Sequence[Drawn]) -> Iterator[Suspect]:
    """Yield that a material reflects nothing, or that a light gives none."""
    yield from _black_material(mine)

    for name in LIGHTS:
        if not all(d.state[name] for d in mine):
            continue
        diffuse = [float(v) for v in mine[0].state[f"{name}.GL_DIFFUSE"]]
        others = [other for other in LIGHTS if other != name]
        alone = not any(d.state[other] for other in others for d in mine)
        if max(diffuse[:3]) < 0.02 and alone:
            actions: list[Action] = [
                ("glLightfv", (gl_constant(name), gl.GL_DIFFUSE, (1.0, 1.0, 1.0, 1.0)))
            ]
            yield Suspect(
                "light-black",
                at=mine[0].setter(f"{name}.GL_DIFFUSE"),
                change=with_state(["LIGHTING"], actions, mine),
                strength=80,
                state=f"{name}.GL_DIFFUSE",
                value=diffuse,
                values={"light": name},
                draws=mine,
            )


def _black_material(mine: Sequence[Drawn]) -> Iterator[Suspect]:
    """Yield that a material reflects nothing."""
    dark = [
        d
        for d in mine
        if max(d.state["GL_FRONT.GL_DIFFUSE"][:3]) < 0.02
        and not _within(d, "glMaterial")
        and not d.state["GL_COLOR_MATERIAL"]
    ]

    if dark:
        yield Suspect(
            "material-black",
            at=dark[0].setter("GL_FRONT.GL_DIFFUSE"),
            change=with_state(
                ["LIGHTING"],
                [("glMaterialfv", (gl.GL_FRONT_AND_BACK, gl.GL_DIFFUSE, (0.8, 0.8, 0.8, 1.0)))],
                dark,
            ),
            strength=76,
            state="GL_FRONT.GL_DIFFUSE",
            value=[float(v) for v in dark[0].state["GL_FRONT.GL_DIFFUSE"]],
            draws=dark,
        )


def _placed_before(survey: Survey, look: GluCall) -> list[Call]:
    """Return the calls that place a light between the matrix's last reset and a camera."""
    calls = survey.tape.calls
    loaded = 0
    for call in calls[: look.begin]:
        if call.name == "glLoadIdentity":
            loaded = call.number
    return [
        call
        for call in calls[loaded : look.begin]
        if call.name.startswith("glLight")
        and len(call.args) == 3
        and int(call.args[1]) == int(gl.GL_POSITION)
    ]


def moving_light(survey: Survey) -> Iterator[Suspect]:
    """A light placed before the camera's gluLookAt, in a picture whose camera moves."""
    past = survey.past
    if past is None or not lit(survey):
        return
    looks = [note for note in survey.glu if note.name == "gluLookAt" and note.end > note.begin]
    if not looks:
        return
    look = looks[0]
    for call in _placed_before(survey, look):
        position = [float(v) for v in np.ravel(np.asarray(call.args[2]))]
        if abs(position[0]) + abs(position[1]) < 1e-6:
            continue  # at the eye, or behind it: meant to go with the camera
        if call.pass_ == "setup" or look.pass_ == "setup" or not _moves(past, look):
            continue
        end = str(look.end - 1)
        yield Suspect(
            "light-before-camera",
            at=call,
            change=Change(instead={str(call.number): ()}, after={end: [(call.name, call.args)]}),
            strength=89,
            state=f"{getattr(call.args[0], 'name', 'GL_LIGHT0')}.GL_POSITION",
            value=position,
            values={"call": written(call), "camera": look.site.line},
        )


def _moves(past: Past, look: GluCall) -> bool:
    """Return whether the camera of an earlier frame stood elsewhere."""
    if past.frame == 0:
        return False
    matrices = [
        np.ravel(np.asarray(c.args[0], np.float64))
        for c in past.setters.chained.get("GL_MODELVIEW_MATRIX", [])
        if c.name.startswith("glMultMatrix") and c.site.line == look.site.line
    ]
    if not matrices:
        return False
    from framelens.gl.glu import gluLookAt

    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glPushMatrix()
    gl.glLoadIdentity()
    gluLookAt(*look.args)
    now = np.ravel(np.array(gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX), np.float64))
    gl.glPopMatrix()
    rotation = [0, 1, 2, 4, 5, 6, 8, 9, 10]
    return any(np.abs(m[rotation] - now[rotation]).max() > 1e-4 for m in matrices)


RULES = (
    lights,
    no_normals,
    normals_length,
    normals_away,
    materials,
    moving_light,
)
