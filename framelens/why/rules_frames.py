"""Rules about the frame as a whole: clears, and what one frame leaves to the next.

In this order: a clear that wipes what was drawn, a clear that is missing, a mask in force while the
buffers are cleared, state that the frame before has left, and matrices that grow from frame to
frame.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from framelens.gl.named import gl_constant
from framelens.gl.seam import Call, gl
from framelens.program.past import Past
from framelens.why.survey import Drawn, Survey
from framelens.why.suspects import Suspect, is_identity, load, with_state, written
from framelens.why.trial import Action, Change

READS = ("glReadPixels", "glCopyTex", "glCopyPixels", "glBlitFramebuffer", "glAccum")
FLAGS = (
    *("GL_STENCIL_TEST", "GL_SCISSOR_TEST", "GL_ALPHA_TEST", "GL_BLEND", "GL_LIGHTING"),
    *("GL_CULL_FACE", "GL_DEPTH_TEST", "GL_FOG", "GL_COLOR_LOGIC_OP", "GL_LINE_STIPPLE"),
    *("GL_POLYGON_STIPPLE", "GL_COLOR_MATERIAL", *(f"GL_CLIP_PLANE{k}" for k in range(6))),
)


def _bits(draw: Drawn) -> int:
    return int(draw.call.args[0]) if draw.call.name == "glClear" else 0


def late_clear(survey: Survey) -> Iterator[Suspect]:
    """A clear that wipes what the frame has drawn before it."""
    if survey.past is not None and survey.past.showing.way == "never":
        return  # without a swap, the next picture is drawn in the same frame
    color = int(gl.GL_COLOR_BUFFER_BIT)
    drawn = 0
    read = False
    index = 0

    for step in survey.tape.steps():
        if step.call.name.startswith(READS):
            read = True
        if index < len(survey.draws) and survey.draws[index].place == step.place:
            draw = survey.draws[index]
            index += 1
            if not draw.clears:
                drawn += bool(draw.passed and draw.changed != 0)
                continue
            wipes = _bits(draw) & color and not draw.state["GL_SCISSOR_TEST"]
            if wipes and drawn and not read:
                yield Suspect(
                    "late-clear",
                    at=draw.call,
                    change=Change(instead={draw.place: ()}),
                    strength=93,
                    values={"draws": drawn},
                )
            if wipes:
                drawn, read = 0, False


def no_clear(survey: Survey) -> Iterator[Suspect]:
    """A frame that begins on what the frame before has left in the buffers."""
    if survey.tape.before is None or not survey.shapes:
        return
    first = survey.shapes[0]

    for name, bit, cause in (
        ("GL_COLOR_BUFFER_BIT", "COLOR", "no-clear"),
        ("GL_DEPTH_BUFFER_BIT", "DEPTH", "no-depth-clear"),
    ):
        cleared = any(_bits(draw) & int(gl_constant(name)) for draw in survey.draws)
        if cleared or (bit == "DEPTH" and not any(d.state["GL_DEPTH_TEST"] for d in survey.shapes)):
            continue
        yield Suspect(
            cause,
            at=first.call,
            change=Change(first=[("glClear", (gl_constant(name),))]),
            strength=92,
            state="GL_COLOR_CLEAR_VALUE" if bit == "COLOR" else "GL_DEPTH_CLEAR_VALUE",
        )


def masked_clear(survey: Survey) -> Iterator[Suspect]:
    """A mask that keeps glClear from clearing."""
    for draw in survey.draws:
        bits = _bits(draw)
        if bits & int(gl.GL_DEPTH_BUFFER_BIT) and not draw.state["GL_DEPTH_WRITEMASK"]:
            yield Suspect(
                "clear-masked",
                at=draw.setter("GL_DEPTH_WRITEMASK"),
                change=with_state(["DEPTH_BUFFER"], [("glDepthMask", (True,))], [draw]),
                strength=94,
                state="GL_DEPTH_WRITEMASK",
                value=False,
                values={"mask": "glDepthMask(GL_TRUE)", "clear": draw.call.site.line},
            )

        if bits & int(gl.GL_COLOR_BUFFER_BIT) and not all(draw.state["GL_COLOR_WRITEMASK"]):
            yield Suspect(
                "clear-masked",
                at=draw.setter("GL_COLOR_WRITEMASK"),
                change=with_state(["COLOR_BUFFER"], [("glColorMask", (True,) * 4)], [draw]),
                strength=94,
                state="GL_COLOR_WRITEMASK",
                value=list(draw.state["GL_COLOR_WRITEMASK"]),
                values={
                    "mask": "glColorMask(True, True, True, True)",
                    "clear": draw.call.site.line,
                },
            )


def _flag(name: str, value: object) -> list[Action]:
    return [("glEnable" if value else "glDisable", (gl_constant(name),))]


def _texture(name: str, value: object) -> list[Action]:
    return [("glActiveTexture", (gl.GL_TEXTURE0,)), *_flag("GL_TEXTURE_2D", value)]


LEAKING: dict[str, Callable[[str, Any], Sequence[Action]]] = {
    **dict.fromkeys(FLAGS, _flag),
    "GL_TEXTURE0.GL_TEXTURE_2D": _texture,
    "GL_VIEWPORT": lambda n, v: [("glViewport", tuple(int(each) for each in v))],
    "GL_COLOR_WRITEMASK": lambda n, v: [("glColorMask", tuple(v))],
    "GL_DEPTH_WRITEMASK": lambda n, v: [("glDepthMask", (v,))],
    "GL_POLYGON_MODE": lambda n, v: [
        ("glPolygonMode", (face, gl_constant(mode)))
        for face, mode in zip((gl.GL_FRONT, gl.GL_BACK), v, strict=False)
    ],
    "GL_CURRENT_COLOR": lambda n, v: [("glColor4f", tuple(v))],
    "GL_DEPTH_FUNC": lambda n, v: [("glDepthFunc", (gl_constant(v),))],
    "GL_FRONT_FACE": lambda n, v: [("glFrontFace", (gl_constant(v),))],
    "GL_CULL_FACE_MODE": lambda n, v: [("glCullFace", (gl_constant(v),))],
    "GL_COLOR_CLEAR_VALUE": lambda n, v: [("glClearColor", tuple(v))],
    "GL_MATRIX_MODE": lambda n, v: [("glMatrixMode", (gl_constant(v),))],
    "GL_FRONT.GL_EMISSION": lambda n, v: [
        ("glMaterialfv", (gl.GL_FRONT_AND_BACK, gl.GL_EMISSION, tuple(v)))
    ],
    "GL_DRAW_FRAMEBUFFER_BINDING": lambda n, v: [
        ("glBindFramebuffer", (gl.GL_FRAMEBUFFER, int(v)))
    ],
    "GL_POINT_SIZE": lambda n, v: [("glPointSize", (v,))],
    "GL_LINE_WIDTH": lambda n, v: [("glLineWidth", (v,))],
}
WEAK = {"GL_CURRENT_COLOR": 70, "GL_POINT_SIZE": 60, "GL_LINE_WIDTH": 60, "GL_DEPTH_TEST": 85}


def leaks(survey: Survey) -> Iterator[Suspect]:
    """State in which this frame begins to draw and the first one did not: the last one left it."""
    past = survey.past
    if past is None or past.frame == 0 or not past.now:
        return
    before = _made_before(survey)

    for name, actions in LEAKING.items():
        former, now = _plain(past.first.get(name)), _plain(past.now.get(name))
        if former is None or former == now or name in before:
            continue
        setter = past.setters.last.get(name)
        yield Suspect(
            "leak",
            at=setter,
            change=Change(first=actions(name, past.first[name])),
            strength=WEAK.get(name, 91),
            state=name,
            value=past.now[name],
            values={"former": past.first[name], "value": past.now[name]},
        )


def _made_before(survey: Survey) -> Mapping[str, Call]:
    """Return what this frame itself sets before its first draw."""
    from framelens.program.past import Setters

    setters = Setters()
    until = survey.draws[0].number if survey.draws else len(survey.tape.calls)
    for call in survey.tape.frame:
        if call.number >= until:
            break
        setters.follow(call)
    return setters.last


def _plain(value: object) -> object:
    return list(value) if isinstance(value, (list, tuple)) else value


CAMERAS = ("gluLookAt", "gluPerspective", "gluOrtho2D", "glOrtho", "glFrustum", "gluPickMatrix")


def accumulated(survey: Survey) -> Iterator[Suspect]:
    """A matrix that every frame multiplies once more, because nothing loads it first."""
    past = survey.past
    if past is None or past.frame == 0:
        return
    cameras = [note for note in survey.glu if note.name in CAMERAS and note.pass_ != "setup"]
    numbers = {number for note in cameras for number in range(note.begin, note.end)}
    found: list[Any] = [
        (survey.tape.calls[note.begin], note) for note in cameras if note.end > note.begin
    ]
    found += [
        (call, call) for call in survey.calls if call.name in CAMERAS and call.number not in numbers
    ]
    for call, at in found:
        matrix = _matrix_at(survey, call)
        if matrix is None:
            continue
        name, loaded = matrix
        if loaded or _same(past, name):
            continue
        yield Suspect(
            "accumulated",
            at=at,
            change=Change(before={str(call.number): [("glLoadIdentity", ())]}),
            strength=95,
            state=name,
            values={"frames": past.frame + 1, "matrix": name},
        )

    yield from _drifted(survey)


def _same(past: Past, name: str) -> bool:
    first, now = past.first.get(name), past.now.get(name)
    return first is None or now is None or list(first) == list(now)


def _drifted(survey: Survey) -> Iterator[Suspect]:
    """Objects that have left the picture because the modelview matrix grows with each frame."""
    past = survey.past
    name = "GL_MODELVIEW_MATRIX"
    if past is None or _same(past, name) or not survey.shapes:
        return
    if name in _made_before(survey):
        return
    hidden = [draw for group in survey.hidden() for draw in group]
    if not hidden and not survey.empty:
        return
    chain = past.setters.chained.get(name, [])
    yield Suspect(
        "accumulated",
        at=chain[-1] if chain else None,
        change=Change(first=[load("GL_MODELVIEW", past.first[name])]),
        strength=80,
        state=name,
        values={"frames": past.frame + 1, "matrix": name},
    )


def _matrix_at(survey: Survey, call: Call) -> tuple[str, bool] | None:
    """Return which matrix a call multiplies, and whether the frame has loaded it before."""
    past = survey.past
    if past is None:
        return None
    setters = past.setters.copied()
    loaded: set[str] = set()
    for each in survey.calls:
        if each.number == call.number:
            return setters.matrix, setters.matrix in loaded
        if each.name.startswith("glLoad"):
            loaded.add(setters.matrix)
        if each.name in ("glPushMatrix",):
            loaded.add(setters.matrix)
        setters.follow(each)
    return None


# GL_ACCUM and its like.
ACCUM = 0x0100
LOAD = 0x0101
RETURN = 0x0102


def accumulation(survey: Survey) -> Iterator[Suspect]:
    """An accumulation buffer that takes nothing in, or that is never returned to the picture."""
    calls = [call for call in survey.calls if call.name == "glAccum"]
    takes = [call for call in calls if int(call.args[0]) in (ACCUM, LOAD)]
    returns = [call for call in calls if int(call.args[0]) == RETURN]
    nothing = [call for call in takes if float(call.args[1]) == 0.0]

    if takes and len(nothing) == len(takes):
        share = 1.0 / len(takes)
        yield Suspect(
            "accum-zero",
            at=takes[0],
            change=Change(
                instead={str(c.number): [("glAccum", (c.args[0], share))] for c in takes}
            ),
            strength=93,
            value=0.0,
            values={"call": written(takes[0]), "n": len(takes)},
        )
    elif takes and not returns:
        yield Suspect(
            "accum-no-return",
            at=takes[-1],
            change=Change(after={str(takes[-1].number): [("glAccum", (RETURN, 1.0))]}),
            strength=88,
            values={"n": len(takes)},
        )


RULES = (accumulation, late_clear, no_clear, masked_clear, leaks, accumulated)
__all__ = ["RULES", "is_identity"]
