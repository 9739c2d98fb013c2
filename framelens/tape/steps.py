"""The calls of a frame one by one, those that display lists execute among them.

A place says which call is meant: "12" is the frame's call 12, "12.3" the call 3 of the display list
that call 12 executes, "12.3.0" the first of a list that that one executes.
"""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from framelens.base.errors import InputError, short
from framelens.gl.client import POINTERS
from framelens.gl.named import gl_constant, gl_function
from framelens.gl.seam import Call, gl
from framelens.spec import spec

CLIENT = {*POINTERS, "glEnableClientState", "glDisableClientState", "glClientActiveTexture"}
FRAME = ("frame",)  # what calls draw where the code names no element
ARRAYS = (
    *("VERTEX", "NORMAL", "COLOR", "SECONDARY_COLOR", "TEXTURE_COORD", "FOG_COORD", "INDEX"),
    "EDGE_FLAG",
)


@dataclass(frozen=True, slots=True)
class Step:
    """A call and its place; ``place`` is empty for a call that the replay itself adds.

    ``top`` is the frame's own call: the same one, or the one that executes the display list.
    """

    place: str
    call: Call
    top: Call

    @property
    def number(self) -> int:
        """The number of the frame's call that this is, or that executes it."""
        return int(self.place.partition(".")[0]) if self.place else -1

    @property
    def elements(self) -> tuple[str, ...]:
        """What is drawn: of a display list, what the call that executes it draws.

        Where that call names nothing, it is what was drawn when the list was compiled; and so it is
        in a program, which names nothing but its functions.
        """
        named = self.top.shared_by
        return self.call.shared_by if named in (FRAME, (self.top.site.function,)) else named


def steps(calls: Sequence[Call]) -> Iterator[Step]:
    """Yield the calls in the order in which they take effect: for a display list its own calls."""
    for call in calls:
        yield from _expanded(Step(str(call.number), call, call))


def _expanded(step: Step) -> Iterator[Step]:
    call = step.call
    if not call.listed:
        if call.name not in ("glCallList", "glCallLists"):
            yield step
        return

    inner = [
        each
        for index, listed in enumerate(call.listed)
        for each in _expanded(Step(f"{step.place}.{index}", listed, step.top))
    ]

    # A list has its arrays in itself. Its pointer calls were made when it was compiled, so making
    # them here must leave the client state alone.
    guarded = any(each.call.name in CLIENT or each.call.arrays for each in inner)
    if guarded:
        yield _added(call, "glPushClientAttrib", gl.GL_CLIENT_VERTEX_ARRAY_BIT)
        for name in ARRAYS:
            yield _added(call, "glDisableClientState", gl_constant(f"GL_{name}_ARRAY"))

    yield from inner
    if guarded:
        yield _added(call, "glPopClientAttrib")


def _added(call: Call, name: str, *args: object) -> Step:
    made = replace(call, name=name, args=args, executed=(), arrays=(), kept=None)
    return Step("", made, made)


# How the names of functions begin that make, build or delete objects, and how they go on. Those of
# OpenGL after 1.5, shaders among them, have no entry in the specification.
BUILDS = re.compile("gl(?:Create|Gen|Delete|Attach|Detach|Link|Compile|Shader)[A-Z]")


def repeatable(name: str) -> bool:
    """Whether a replay makes calls of this name again.

    It asks nothing, and objects keep their names, stay alive and stay as they were built.
    """
    asking = spec.is_query(name) or name in ("glFinish", "glFlush")
    if spec.function(name) is None:
        return not BUILDS.match(name)
    return not (asking or spec.creates(name) or spec.deletes(name))


def binds_shaders(name: str) -> bool:
    """Whether a call says which shaders draw, by the number of their object."""
    return name.startswith("glUse")


def bind_again(calls: Iterable[Call], number: int) -> None:
    """Let the object ``number`` draw, 0 for fixed function, as one of the program's calls does."""
    binding = next((call for call in calls if binds_shaders(call.name)), None)
    if binding is not None:
        gl_function(binding.name)(number)


def issue(call: Call) -> None:
    """Make a call again, with the arrays it had; a glNewList with all that it compiles."""
    if call.skipped or not repeatable(call.name):
        return
    for name, args in call.arrays:
        gl_function(name)(*args)
    gl_function(call.name)(*call.args)
    if call.compiled is not None:
        for inner in call.compiled.calls():
            issue(inner)


def _no_call(place: str, outer: str, count: int) -> InputError:
    """Return the error of a place that does not exist in the frame, or in the call ``outer``."""
    if outer and count:
        return InputError(
            "call {place}: call {outer} executes {count} calls, expected 0 to {last}",
            place=short(place),
            outer=outer,
            count=count,
            last=count - 1,
        )
    if outer:
        return InputError(
            "call {place}: call {outer} executes no calls", place=short(place), outer=outer
        )
    if not count:
        return InputError("call {place}: the frame has no calls", place=short(place))
    return InputError(
        "call {place}: the frame has {count} calls, expected 0 to {last}",
        place=short(place),
        count=count,
        last=count - 1,
    )


def find(calls: Sequence[Call], place: str) -> Step:
    """Return the step at a place; InputError names the places there are."""
    parts = place.split(".")
    if not all(part.isascii() and part.isdigit() for part in parts):
        raise InputError(
            "call {place}: expected a number such as 12, or 12.3 in a list", place=short(place)
        )
    among, step = calls, None
    for depth, part in enumerate(parts):
        index = int(part[:20])
        if index >= len(among):
            raise _no_call(place, ".".join(parts[:depth]), len(among))
        call = among[index]
        step = Step(".".join(parts[: depth + 1]), call, step.top if step else call)
        among = call.listed
    assert step is not None
    return step
