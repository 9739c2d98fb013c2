"""The classic state: read it, set a context to it again, and say what differs.

A state is a dictionary, name to value, with the names of variables.py: "GL_FOG_DENSITY",
"GL_LIGHT0.GL_AMBIENT", "GL_FRONT.GL_SHININESS", "GL_CLIP_PLANE0.equation",
"GL_TEXTURE0.GL_TEXTURE_ENV.GL_TEXTURE_ENV_MODE". Enumerants stand in it by name, vectors as lists,
matrices as 16 numbers in OpenGL's order, column by column. "GL_MODELVIEW_STACK" lists the matrices
below the top, bottom first. A dictionary without some of the names is a state, too: :func:`restore`
leaves alone what it does not name. state_text.py writes a state as JSON, which can be restored,
and as a listing.

Not part of the state are the parameters and contents of objects: textures, buffers, display lists,
framebuffers. They are bound by their names, and must exist where a state is restored.

:func:`restore` brings back everything that it can. It cannot

- fill the memory that a pointer shows: vertex arrays point where they did, and selection and
  feedback write to memory of their own;
- set the fourth component of the raster position, which becomes 1 and has no effect;
- put names on the name stack, which OpenGL does not tell: it gets as many zeros;
- continue an occlusion query: one that was in progress begins at zero;
- bind a program of shaders: GL_CURRENT_PROGRAM is only read (steps.py binds it again);
- rebuild an attribute stack that was read by its depth only: where pushes are missing, they save
  nothing. OpenGL does not tell what glPushAttrib saved, but whoever knows the masks of the open
  pushes can have it read: see :func:`read`.
"""

from collections.abc import Mapping, Sequence

from framelens.gl.raw import end_primitive, raw, raw_function
from framelens.spec.spec import parsed
from framelens.state.state_reading import State, StateError, Values, plan, read_now, whole
from framelens.state.state_setting import apply
from framelens.state.state_variables import DEFAULTS

__all__ = [
    "DEFAULTS",
    "State",
    "StateError",
    "changed",
    "difference",
    "read",
    "restore",
]

SERVER, CLIENT = "GL_ATTRIB_STACK", "GL_CLIENT_ATTRIB_STACK"
PUSH = {SERVER: "glPushAttrib", CLIENT: "glPushClientAttrib"}
POP = {SERVER: "glPopAttrib", CLIENT: "glPopClientAttrib"}
MOST_ERRORS = 100  # chosen: without a context there is no end of errors


def read(pushed: Sequence[int] | None = None, pushed_client: Sequence[int] | None = None) -> State:
    """Return the state of the current context, leaving it as it is and fetching no error.

    ``pushed`` holds the masks of the glPushAttrib that are open, the first first, and
    ``pushed_client`` those of glPushClientAttrib. Where they are given, the state has a
    "GL_ATTRIB_STACK" or "GL_CLIENT_ATTRIB_STACK": for each push its "mask", and as "saved" the
    values that the pop will change. To read them, everything is popped, pushed and set again; the
    parameters of textures that GL_TEXTURE_BIT saves are then those that they have now.

    StateError between glBegin and glEnd (which leaves an OpenGL error), while a display list is
    compiled, in a core profile, and where there are not as many pushes as masks.
    """
    state = read_now()
    for stack, masks in ((SERVER, pushed), (CLIENT, pushed_client)):
        if masks is not None:
            state[stack] = _read_pushed(stack, list(masks), state)
    return state


def _read_pushed(stack: str, masks: list[int], state: State) -> list[dict[str, object]]:
    """Read what each push has saved, by popping it, and push it again."""
    if state[f"{stack}_DEPTH"] != len(masks):
        depth = state[f"{stack}_DEPTH"]
        raise StateError(
            "{stack}_DEPTH is {depth}, and {count} masks were given",
            stack=stack,
            depth=depth,
            count=len(masks),
        )
    levels: list[dict[str, object]] = []
    above = _values(state)
    for mask in reversed(masks):
        raw_function(POP[stack])()
        below = _values(read_now())
        saved = {name: value for name, value in below.items() if value != above[name]}
        levels.insert(0, {"mask": int(mask), "saved": saved})
        above = below
    _push_again(stack, levels, above, _values(state))
    return levels


def _push_again(
    stack: str, levels: Sequence[Mapping[str, object]], now: State, target: Mapping[str, object]
) -> None:
    """Push levels that were popped; ``now`` is the state below them, ``target`` the one on top."""
    for level, state in zip(levels, _states_above(levels, target), strict=True):
        mask = level["mask"]
        if isinstance(mask, str):
            mask = parsed(PUSH[stack], 0, (0,), mask)
        raw_function(PUSH[stack])(mask)
        apply(now, state)


def _states_above(
    levels: Sequence[Values], target: Mapping[str, object]
) -> list[dict[str, object]]:
    """Return for each push the state that is current until the next one."""
    states: list[dict[str, object]] = []
    state = dict(target)
    for level in reversed(levels):
        states.insert(0, state)
        state = {**state, **level["saved"]}
    return states


def _values(state: Mapping[str, object]) -> State:
    """Return a state without the attribute stacks."""
    return {name: value for name, value in state.items() if "ATTRIB_STACK" not in name}


def restore(state: Values) -> None:
    """Set the current context, new or used, to ``state``; see above for what cannot be set.

    Whatever half a frame leaves open is closed first: glBegin, a display list that is compiled,
    pushes of attributes and matrices. Pending errors are dropped. Of a state that was read in a
    context with more lights, planes or texture units, those that are missing here are left out.
    StateError where OpenGL refuses a value, for instance the name of an object that does not exist.
    """
    _close()
    server, client = state.get(SERVER), state.get(CLIENT)
    for stack, levels in ((SERVER, server), (CLIENT, client)):
        kept = 0 if levels is not None else state.get(f"{stack}_DEPTH", whole(f"{stack}_DEPTH"))
        while whole(f"{stack}_DEPTH") > kept:
            raw_function(POP[stack])()

    now = _values(read_now())
    target = {**now, **{name: value for name, value in state.items() if name in now}}

    # The attribute stacks share no variable: first the one is built, then the other on top of it.
    server_bottom, client_bottom = (_bottom(levels, now) for levels in (server, client))
    apply(now, {**target, **server_bottom, **client_bottom})
    if server is not None:
        _push_again(SERVER, server, now, {**target, **client_bottom})
    if client is not None:
        _push_again(CLIENT, client, now, target)
    for stack in (SERVER, CLIENT):
        for _ in range(state.get(f"{stack}_DEPTH", 0) - whole(f"{stack}_DEPTH")):
            raw_function(PUSH[stack])(0)
    if error := raw.glGetError():
        raise _refusal(error, target)


def _bottom(levels: Sequence[Mapping[str, Values]] | None, now: Values) -> dict[str, object]:
    """Return the values at the bottom of a stack of attributes, of variables that there are now."""
    return {
        name: value
        for level in reversed(levels or ())
        for name, value in level["saved"].items()
        if name in now
    }


def _refusal(error: int, target: Values) -> StateError:
    """Return the error that names what is not as in ``target``."""
    _drop_errors()
    left = difference(target, _values(read_now()))
    what = ", ".join(name for name in left if "POINTER" not in name)
    return StateError(
        "OpenGL refused a value (error 0x{error:04X}): {what}",
        error=error,
        what=what or "unknown",
    )


def _close() -> None:
    """End a glBegin and the compiling of a display list, and drop errors."""
    try:
        plan()
    except StateError:
        end_primitive()
        raw.glEndList()
    _drop_errors()
    plan()


def _drop_errors() -> None:
    for _ in range(MOST_ERRORS):
        if not raw.glGetError():
            break


def difference(
    before: Mapping[str, object], after: Mapping[str, object]
) -> dict[str, list[object]]:
    """Return what differs, name to [before, after]; None for what one of them does not have."""
    found = {}
    for name in dict.fromkeys((*before, *after)):
        old, new = before.get(name), after.get(name)
        if old != new:
            found[name] = [old, new]
    return found


SINGLE_OR_DOUBLE = ("GL_FRONT", "GL_BACK", "GL_COLOR_ATTACHMENT0")


def changed(state: Values, size: tuple[int, int] | None = None) -> dict[str, list[object]]:
    """Return what differs from the initial state, name to [initial value, value].

    ``size`` is that of the window, in pixels: initially the viewport and the scissor box cover it.
    Without it a viewport, or a scissor box without scissor test, is as at the beginning if its
    corner is at 0, 0 and it has an area. The buffer drawn to and read from is so if it is the one
    that a window or a framebuffer starts with. GL_POINT_SIZE_MAX, initially each OpenGL's own, is
    left out.
    """
    initial = {name: value for name, value in DEFAULTS.items() if name in state}
    for name in ("GL_VIEWPORT", "GL_SCISSOR_BOX"):
        box = state.get(name)
        if box is None:
            continue
        whole_window = name == "GL_VIEWPORT" or not state.get("GL_SCISSOR_TEST")
        if size is not None:
            initial[name] = [0, 0, *size]
        elif whole_window and box[:2] == [0, 0] and all(box[2:]):
            initial[name] = box
        elif not all(box[2:]):
            initial.pop(name, None)  # no window begins with a box without area

    for name in ("GL_DRAW_BUFFER", "GL_READ_BUFFER"):
        if state.get(name) in SINGLE_OR_DOUBLE:
            initial[name] = state[name]
    found = difference(initial, state)
    found.pop("GL_POINT_SIZE_MAX", None)
    return found
