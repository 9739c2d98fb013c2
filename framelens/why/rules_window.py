"""Rules about the window: is what is drawn ever shown, and are the calls made where they may be?

In the order of a program's life: calls before there is a context, calls that OpenGL refuses,
glBegin and glEnd, and how the frame is shown.
"""

from collections.abc import Iterator, Sequence
from functools import partial
from itertools import takewhile

import numpy as np

from framelens.gl.named import gl_constant, gl_function
from framelens.gl.seam import Call
from framelens.program.past import Past
from framelens.program.shown import FRONT
from framelens.spec import spec
from framelens.tape.steps import Step
from framelens.why.survey import Survey
from framelens.why.suspects import Suspect, written
from framelens.why.trial import Action, Change, changed

INSIDE = (
    *("glVertex", "glColor", "glSecondaryColor", "glIndex", "glNormal", "glTexCoord"),
    *("glMultiTexCoord", "glFogCoord", "glEdgeFlag", "glArrayElement", "glEval", "glMaterial"),
    *("glCallList", "glEnd", "glGetError"),
)


def _make_again(past: Past, names: dict[int, int]) -> None:
    """Make the early calls again; ``names`` gets the name of the object that they made as 0."""
    for name, args, result, _ in past.early:
        if spec.creates(name):
            made = gl_function(name)(*args)
            if result is None or int(np.ravel(result or 0)[0]) == 0:
                names[0] = int(np.ravel(made)[0])
        elif not spec.is_query(name):
            values = list(args)
            place = PLACES.get(name)
            if place is not None and int(values[place] or 0) == 0:
                values[place] = names.get(0, 0)
            gl_function(name)(*values)


def before_context(survey: Survey) -> Iterator[Suspect]:
    """Calls of OpenGL before the window's context: they have no effect."""
    past = survey.past
    if past is None or not past.early:
        return
    names: dict[int, int] = {}
    instead: dict[str, Sequence[Action]] = {}
    for call in survey.tape.frame:
        place = PLACES.get(call.name)
        if place is not None and int(call.args[place] or 0) == 0:
            instead[str(call.number)] = [_renamed(call, place, names)]
    name, _, _, site = past.early[0]
    yield Suspect(
        "before-context",
        at=None,
        change=Change(start=[partial(_make_again, past, names)], instead=instead),
        strength=97,
        values={"call": name, "opening": OPENINGS[past.window.toolkit]},
        source=f"{site.file}:{past.window.early_line or site.line}",
    )


PLACES = {"glNewList": 0, "glCallList": 0, "glBindTexture": 1}
OPENINGS = {
    "glfw": "glfw.make_context_current",
    "pygame": "pygame.display.set_mode",
    "glut": "glutCreateWindow",
}


def _renamed(call: Call, place: int, names: dict[int, int]) -> Action:
    def act() -> None:
        args = list(call.args)
        args[place] = names.get(0, 0)
        gl_function(call.name)(*args)

    return act


def list_open(survey: Survey) -> Iterator[Suspect]:
    """A glNewList without its glEndList: all calls after it are compiled, and none executed."""
    begun = None
    inside = False  # of a glBegin, where OpenGL refuses to begin a list
    for call in survey.tape.calls:
        if call.name in ("glBegin", "glEnd"):
            inside = call.name == "glBegin"
        elif call.name == "glNewList" and not inside:
            begun = call
        elif call.name == "glEndList":
            begun = None

    if begun is None:
        return
    own = begun.compiled.calls() if begun.compiled is not None else []
    inner = [call for call in own if call.site.function == begun.site.function]
    after = [call for call in own if call.site.line > begun.site.line and call in inner]

    yield Suspect(
        "no-end-list",
        at=begun,
        change=None,
        strength=98,
        state="GL_LIST_INDEX",
        value=int(begun.args[0]),
        values={"list": int(begun.args[0]), "line": after[-1].site.line if after else 0},
        pixels=survey.base.shape[0] * survey.base.shape[1],
    )


def begin_and_end(survey: Survey) -> Iterator[Suspect]:
    """A glBegin without its glEnd, a call that is forbidden between them, a glVertex outside."""
    steps = [step for step in survey.tape.steps() if step.place]
    begin = last = None
    for index, step in enumerate(steps):
        name = step.call.name
        if begin is None:
            if name.startswith("glVertex") and not name.endswith("Pointer"):
                yield from _outside(steps, index)
                return
            if name == "glBegin":
                begin, last = step, step
            continue
        if name == "glEnd":
            begin = None
        elif name.startswith("glVertex"):
            last = step
        elif not name.startswith(INSIDE):
            assert last is not None
            yield from _within(survey, steps, index, begin, last)
            return

    if begin is not None and last is not None and survey.past and survey.past.error is None:
        yield Suspect(
            "no-end",
            at=last.call,
            change=Change(after={last.place: [("glEnd", ())]}),
            strength=96,
            values={"begin": begin.call.site.line, "function": last.call.site.function},
        )


def _no_end(survey: Survey, begin: Step, last: Step, broken_off: bool) -> Suspect:
    """Suspect that a glBegin has no glEnd; nothing mends it where the program was broken off."""
    return Suspect(
        "no-end",
        at=last.call,
        change=None if broken_off else Change(after={last.place: [("glEnd", ())]}),
        strength=96,
        pixels=survey.base.shape[0] * survey.base.shape[1],
        values={"begin": begin.call.site.line, "function": last.call.site.function},
    )


def _within(
    survey: Survey, steps: Sequence[Step], index: int, begin: Step, last: Step
) -> Iterator[Suspect]:
    step = steps[index]
    following = (later.call.name for later in steps[index:])
    ended = next((name for name in following if name in ("glBegin", "glEnd")), "") == "glEnd"
    if not ended or step.call.name == "glBegin":
        broken_off = survey.past is not None and survey.past.error is not None and not ended
        yield _no_end(survey, begin, last, broken_off)
        return

    until_end = takewhile(lambda later: later.call.name != "glEnd", steps[index:])
    strange = [later for later in until_end if not later.call.name.startswith(INSIDE)]
    moved = [(later.call.name, later.call.args) for later in strange]
    instead: dict[str, Sequence[Action]] = {later.place: () for later in strange}
    yield Suspect(
        "inside-begin",
        at=step.call,
        change=Change(before={begin.place: moved}, instead=instead),
        strength=96,
        values={"begin": begin.call.site.line, "call": written(step.call)},
    )


def _outside(steps: Sequence[Step], index: int) -> Iterator[Suspect]:
    step = steps[index]
    last = step
    for later in steps[index:]:
        if not later.call.name.startswith(INSIDE):
            break
        last = later
    for mode in ("GL_POLYGON", "GL_LINE_STRIP"):
        yield Suspect(
            "outside-begin",
            at=step.call,
            change=Change(
                before={step.place: [("glBegin", (gl_constant(mode),))]},
                after={last.place: [("glEnd", ())]} if last.call.name != "glEnd" else {},
            ),
            strength=94,
            values={"call": written(step.call)},
        )


def refused(survey: Survey) -> Iterator[Suspect]:
    """A call that OpenGL refuses with an error."""
    past = survey.past
    error = past.error if past else None
    if error is not None and hasattr(error, "baseOperation"):
        call = survey.calls[-1] if survey.calls else None
        said = bytes(getattr(error, "description", b"") or b"").decode(errors="replace")
        yield Suspect(
            "refused",
            at=call,
            change=None,
            strength=60,
            values={"call": written(call), "error": said or type(error).__name__},
            pixels=survey.base.shape[0] * survey.base.shape[1],
        )
        return

    for place, call, said in survey.errors[:3]:
        yield Suspect(
            "refused",
            at=call,
            change=None if survey.empty else Change(instead={place: ()}),
            strength=45,
            values={"call": written(call), "error": said},
            pixels=survey.base.shape[0] * survey.base.shape[1],
        )


def not_shown(survey: Survey) -> Iterator[Suspect]:
    """A frame that is never swapped, or of a single buffer and never flushed."""
    past = survey.past
    if past is None or past.error is not None or not survey.draws:
        return
    showing, doubled = past.showing, past.window.double_buffered
    last = _last_drawing(survey)
    function = last.site.function if last else ""

    if showing.way == "never" or (showing.way == "callback" and doubled):
        yield Suspect(
            "no-swap",
            at=last,
            change=None,
            strength=99,
            state="GL_DOUBLEBUFFER",
            value=True,
            values={"function": function, "swap": SWAPS[past.window.toolkit]},
            pixels=_drawn_pixels(survey),
        )
    elif showing.way == "callback" and not showing.flushed:
        yield Suspect(
            "no-flush",
            at=last,
            change=None,
            strength=98,
            state="GL_DOUBLEBUFFER",
            value=False,
            values={"function": function},
            pixels=_drawn_pixels(survey),
        )


def _last_drawing(survey: Survey) -> Call | None:
    """Return the frame's last call that is no flush."""
    drawing = [call for call in survey.calls if call.name not in ("glFlush", "glFinish")]
    return drawing[-1] if drawing else None


def _drawn_pixels(survey: Survey) -> int:
    """Return how many pixels the frame does not leave black."""
    return int(changed(survey.base, np.zeros_like(survey.base)).sum())


def front_buffer(survey: Survey) -> Iterator[Suspect]:
    """A frame drawn into the front buffer, which the swap then replaces."""
    past = survey.past
    if past is None or past.error is not None or past.showing.way != "swap":
        return
    setter = past.setters.last.get("GL_DRAW_BUFFER")
    for call in survey.calls:
        if call.name == "glDrawBuffer":
            setter = call

    if past.window.double_buffered and setter is not None and int(setter.args[0]) in FRONT:
        yield Suspect(
            "front-buffer",
            at=setter,
            change=None,
            strength=97,
            state="GL_DRAW_BUFFER",
            value="GL_FRONT",
            pixels=_drawn_pixels(survey) or survey.base[..., 0].size,
        )


def swapped_twice(survey: Survey) -> Iterator[Suspect]:
    """A second swap with nothing drawn before it: the window shows the other buffer."""
    past = survey.past
    if past is None or past.error is not None:
        return
    showing = past.showing
    if showing.way == "swap" and showing.again and not survey.draws and survey.tape.before:
        yield Suspect(
            "swapped-twice",
            at=None,
            change=None,
            strength=96,
            values={"line": showing.line, "swap": SWAPS[past.window.toolkit]},
            pixels=survey.base[..., 0].size,
            source=f"{past.source.rpartition('/')[2]}:{showing.line}",
        )


def no_redisplay(survey: Survey) -> Iterator[Suspect]:
    """A picture that would change, and that nothing asks to draw again."""
    past = survey.past
    if past is None or past.error is not None or survey.tape.before is None:
        return
    if not (past.showing.forced and past.showing.stirred):
        return
    former = survey.tape.before.color[::-1, :, :3]
    moved = int(changed(former, survey.base).sum()) if former.shape == survey.base.shape else 0
    if moved:
        last = _last_drawing(survey)
        yield Suspect(
            "no-redisplay",
            at=last,
            change=None,
            strength=95,
            values={"function": last.site.function if last else ""},
            pixels=moved,
        )


SWAPS = {
    "glfw": "glfw.swap_buffers(window)",
    "pygame": "pygame.display.flip()",
    "glut": "glutSwapBuffers()",
}
RULES = (
    before_context,
    list_open,
    begin_and_end,
    refused,
    not_shown,
    front_buffer,
    swapped_twice,
    no_redisplay,
)
