"""The frame drawn again with something changed: the experiments that prove a cause.

A :class:`Change` leaves calls out, puts others in their place, adds some, or surrounds draws with
another state. :class:`Trial` holds a tape's frame ready to be drawn many times, and returns the
picture, or for each draw how many fragments pass.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field

import numpy as np

from framelens.gl.named import gl_function
from framelens.gl.raw import raw
from framelens.gl.seam import Call, gl
from framelens.tape.primitives import Draw, grouped
from framelens.tape.readback import read_color
from framelens.tape.steps import Step, repeatable, steps
from framelens.tape.tape import Tape

Action = tuple[str, tuple[object, ...]] | Callable[[], object]
"""A call, by name and arguments, or anything that makes calls."""

# Between these, OpenGL counts or selects for the program itself.
ASIDE = ("glBeginQuery", "glEndQuery")
Thunk = tuple[Callable[..., object], tuple[object, ...]]


@dataclass(frozen=True)
class Around:
    """Another state for some draws: ``places`` are those of their first calls, None for all.

    ``bits`` are the attribute groups that are saved and brought back; where these do not hold what
    is changed, ``undo`` does it.
    """

    bits: int
    actions: Sequence[Action]
    places: frozenset[str] | None = None
    undo: Sequence[Action] = ()

    def concerns(self, place: str) -> bool:
        """Return whether it surrounds the draw at a place."""
        return self.places is None or place in self.places


@dataclass(frozen=True)
class Change:
    """What is done otherwise; places are those of framelens/tape/steps.py.

    ``start`` is done before the frame's first call, ``first`` before its first draw. ``instead``
    replaces calls: by nothing, to leave one out.
    """

    start: Sequence[Action] = ()
    first: Sequence[Action] = ()
    before: Mapping[str, Sequence[Action]] = field(default_factory=dict)
    after: Mapping[str, Sequence[Action]] = field(default_factory=dict)
    instead: Mapping[str, Sequence[Action]] = field(default_factory=dict)
    around: Sequence[Around] = ()

    def __or__(self, other: "Change") -> "Change":
        """Return both changes together."""
        return Change(
            (*self.start, *other.start),
            (*self.first, *other.first),
            {**self.before, **other.before},
            {**self.after, **other.after},
            {**self.instead, **other.instead},
            (*self.around, *other.around),
        )


NOTHING = Change()


@dataclass(frozen=True)
class Item:
    """A step that draws nothing, or a draw, ready to be made: the calls of each place."""

    draw: Draw | None
    thunks: Sequence[tuple[str, Sequence[Thunk]]]
    call: Call

    @property
    def place(self) -> str:
        """The place of the first call."""
        return self.thunks[0][0]


class Trial:
    """Draws a tape's frame again and again, in its context."""

    def __init__(self, tape: Tape) -> None:
        self.tape = tape
        self.items = [_item(each) for each in grouped(_all_steps(tape))]
        self.draws = [item for item in self.items if item.draw is not None]
        self.size = tape.size
        self.times = 0
        self._queries = [int(q) for q in np.ravel(gl.glGenQueries(max(len(self.draws), 1)))]

    def release(self) -> None:
        """Delete the queries, and leave the frame as it was drawn."""
        gl.glDeleteQueries(len(self._queries), np.array(self._queries, np.uint32))
        with suppress(Exception):
            self.tape.rewind()

    def picture(self, change: Change = NOTHING) -> np.ndarray | None:
        """Return the picture, uint8 (h, w, 3), top row first; None where OpenGL refuses a call."""
        try:
            self.run(change)
        except CallFailed:
            return None
        return self.read()

    def read(self) -> np.ndarray | None:
        """Return what the window's framebuffer holds now."""
        return read_color(self._target, (0, 0, *self.size))

    def counts(self, change: Change = NOTHING) -> list[int] | None:
        """Return for each draw how many fragments pass, None where OpenGL refuses a call."""
        asked: list[int | None] = []

        def draw(item: Item, make: Callable[[], None]) -> None:
            if not counted(item.call.name):
                make()
                asked.append(None)
                return
            query = self._queries[len(asked)]
            gl.glBeginQuery(gl.GL_SAMPLES_PASSED, query)
            make()
            gl.glEndQuery(gl.GL_SAMPLES_PASSED)
            asked.append(query)

        try:
            self.run(change, draw)
        except CallFailed:
            return None
        return [
            0
            if query is None
            else int(np.ravel(gl.glGetQueryObjectuiv(query, gl.GL_QUERY_RESULT))[0])
            for query in asked
        ]

    def run(
        self,
        change: Change = NOTHING,
        draw: Callable[[Item, Callable[[], None]], object] | None = None,
        step: Callable[[Item], object] | None = None,
    ) -> None:
        """Draw the frame; ``draw`` is given each draw to make, ``step`` told of each other step.

        CallFailed if a call raises an error.
        """
        self.times += 1
        _end_list()
        self.tape.rewind()
        if self.tape.before is None:
            self._clear()  # or a frame that clears nothing would begin on its own picture
        self._target = int(gl.glGetIntegerv(gl.GL_DRAW_FRAMEBUFFER_BINDING))
        began = False

        try:
            _act(change.start)
            for item in self.items:
                if item.draw is None:
                    self._make(item, change)
                    if step is not None:
                        step(item)
                    continue
                if not began:
                    began = True
                    _act(change.first)
                self._drawn(item, change, draw)
        except Exception as error:
            raise CallFailed(str(error)) from error
        finally:
            _end_list()

    def _clear(self) -> None:
        """Clear the framebuffer to what a new one holds: black, farthest, 0."""
        raw.glPushAttrib(0xFFFFF)  # GL_ALL_ATTRIB_BITS
        raw.glDisable(0x0C11)  # GL_SCISSOR_TEST
        raw.glColorMask(1, 1, 1, 1)
        raw.glDepthMask(1)
        raw.glStencilMask(0xFF)
        raw.glClearColor(0.0, 0.0, 0.0, 0.0)
        raw.glClearDepth(1.0)
        raw.glClearStencil(0)
        raw.glClear(0x4000 | 0x0100 | 0x0400)
        raw.glPopAttrib()

    def _drawn(
        self,
        item: Item,
        change: Change,
        draw: Callable[[Item, Callable[[], None]], object] | None,
    ) -> None:
        around = [each for each in change.around if each.concerns(item.place)]

        def make() -> None:
            for each in around:
                if each.bits:
                    raw.glPushAttrib(each.bits)
                _act(each.actions)
            self._make(item, change)
            for each in reversed(around):
                _act(each.undo)
                if each.bits:
                    raw.glPopAttrib()

        if draw is None:
            make()
        else:
            draw(item, make)

    def _make(self, item: Item, change: Change) -> None:
        if not (change.before or change.after or change.instead):
            for _, thunks in item.thunks:
                for function, args in thunks:
                    function(*args)
            return
        for place, thunks in item.thunks:
            _act(change.before.get(place, ()))
            if place in change.instead:
                _act(change.instead[place])
            else:
                for function, args in thunks:
                    function(*args)
            _act(change.after.get(place, ()))


def _end_list() -> None:
    """End a display list that the program has left open: it would take all calls that follow."""
    if gl.glGetIntegerv(gl.GL_LIST_INDEX):
        raw.glEndList()


class CallFailed(Exception):
    """OpenGL has refused a call of a changed frame."""


def _all_steps(tape: Tape) -> Iterator[Step]:
    """Yield the frame's steps, and calls of display lists that hold nothing."""
    for call in tape.frame:
        if call.name in ("glCallList", "glCallLists") and not call.listed:
            yield Step(str(call.number), call, call)
        else:
            yield from steps([call])


def counted(name: str) -> bool:
    """Return whether a draw makes fragments that OpenGL counts."""
    return not name.startswith(("glClear", "glCopy", "glBlitFramebuffer", "glAccum"))


def _act(actions: Sequence[Action]) -> None:
    for action in actions:
        if callable(action):
            action()
        else:
            gl_function(action[0])(*map(_array, action[1]))


def _array(value: object) -> object:
    """Return numbers as the array that a function takes, anything else as it is."""
    return np.array(value, np.float32) if isinstance(value, (tuple, list)) else value


def _item(each: Step | Draw) -> Item:
    steps = each.steps if isinstance(each, Draw) else (each,)
    draw = each if isinstance(each, Draw) else None
    return Item(draw, [(step.place, list(_thunks(step.call))) for step in steps], steps[0].call)


def _thunks(call: Call) -> Iterator[Thunk]:
    if call.skipped or call.name.startswith(ASIDE) or not repeatable(call.name):
        return
    if call.name in ("glCallList", "glCallLists"):
        return  # of a list that holds nothing
    for name, args in call.arrays:
        yield gl_function(name), args
    yield gl_function(call.name), call.args
    if call.compiled is not None:
        for inner in call.compiled.calls():
            yield from _thunks(inner)


def changed(before: np.ndarray, after: np.ndarray, least: int = 6) -> np.ndarray:
    """Return which pixels two pictures differ in, by at least so many levels: bool (h, w)."""
    differs = np.maximum(before, after) - np.minimum(before, after) >= least
    red, green, blue = (differs[..., k] for k in range(3))
    return np.asarray(red | green | blue)
