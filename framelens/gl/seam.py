"""The seam: every OpenGL call of the program goes through the namespace :data:`gl`.

Off, it costs nothing: once looked up, an attribute of ``gl`` is PyOpenGL's function itself, but for
a few (redirected.py). Inside :func:`noting` they are functions that note a call and then make it:
where it comes from, how edits change it, what its arrays hold now, whom it is told.
One object, :data:`seam`, owns all that; what it does with a call is its frozen :class:`State`.

Three things need notes. A :func:`recording` collects the calls, with their arguments, the
element that draws, the pass and the source line. Edits (:func:`edited`) change arguments or leave
calls out. And a display list remembers the calls it was compiled from, recording or not, so that a
recording of any later frame can look inside it.

The element is the one that the code names: ``with drawing("water"): water.draw(frame)``.
Tests, ``landscape trace`` and the lessons are built on this module. One thread draws at a time.
"""

import sys
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, nullcontext
from itertools import islice
from types import FrameType
from typing import Any, NamedTuple

import numpy as np

from framelens.gl.client import ClientArrays, concerns_arrays, frozen, list_base
from framelens.gl.drawing import drawing, drawn_now
from framelens.gl.notes import Brief, Call, Edits, GluCall, Site, caller, known_files, shown
from framelens.gl.originals import original

__all__ = [
    "Call",
    "Edits",
    "GluCall",
    "Listing",
    "Lists",
    "Recorder",
    "Site",
    "begin_pass",
    "briefly",
    "drawing",
    "drawn_now",
    "edited",
    "frame_begins",
    "gl",
    "glu_noted",
    "lists_now",
    "make_again",
    "noting",
    "outermost",
    "recording",
    "replacing",
    "seam",
    "unnoted",
    "unrecorded",
    "use_lists",
]


FIELDS = 7  # of a Call, from ``shared_by`` on: what a note of it holds


class Listing:
    """The calls that one display list was compiled from.

    ``site`` is the line that began it, ``element`` what was drawn then. ``occurrence`` counts from
    0 the lists that the same line began before it, in the same frame or setup.

    They are kept as one flat list of values, and become :class:`Call` objects when a recording asks
    for them: thousands of small objects would slow down the start, by garbage collections.
    """

    def __init__(self, site: Site, element: str, occurrence: int) -> None:
        self.site = site
        self.element = element
        self.occurrence = occurrence
        self.glu: list[GluCall] = []
        self.length = 0  # how many calls are noted
        self._notes: list[Any] = []
        self._calls: list[Call] | None = None
        self._listing = False  # whether they are just being listed

    def note(self, name: str, args: tuple[object, ...], where: tuple[object, ...]) -> None:
        """Add a call; ``where`` holds the next fields of a Call, as many as FIELDS."""
        self.length += 1
        self._notes += (name, len(args), *args, *where)

    def calls(self) -> list[Call]:
        """Return the calls, each with the calls of the display lists that it executes.

        Without those that execute this one again: OpenGL stops after so many, a walk of the calls
        would not.
        """
        if self._calls is None:
            self._calls, self._listing = [], True
            notes = iter(self._notes)
            for name in notes:
                args = tuple(islice(notes, next(notes)))
                call = Call(name, args, *islice(notes, FIELDS))
                call.executed = [each for each in _executed(call) if each._ends()]
                self._calls.append(call)
            self._listing = False
        return self._calls

    def _ends(self) -> bool:
        """Return whether the list ends: not if its own calls are just being listed."""
        if self._listing:
            return False
        self.calls()
        return True

    def put(self, calls: list[Call]) -> None:
        """Note that the list has been compiled again, from these calls."""
        self._calls = calls
        self.length = len(calls)


Lists = dict[int, Listing]
"""The display lists of one context, by their numbers."""


class Recorder:
    """The calls that a recording has collected; those compiled into a list are listed under it.

    ``complete``: arrays are copied, so that the calls can be made again later
    (framelens/tape/tape.py). ``before`` and ``after`` are told of each call that is recorded, when
    it is made. ``brief``, if it is a list, takes short notes of calls that only give numbers: most
    calls of many programs.
    """

    def __init__(self, complete: bool = False) -> None:
        self.calls: list[Call] = []
        self.brief: list[Brief] | None = None
        self.complete = complete
        self.client = ClientArrays()
        self.glu: list[GluCall] = []
        self.before: Callable[[Call], None] | None = None
        self.after: Callable[[Call], None] | None = None

    @property
    def length(self) -> int:
        """How many calls are recorded."""
        return len(self.calls)

    def add(self, call: Call) -> Call:
        """Add a call that is about to be made."""
        call.number = len(self.calls)
        if call.name in ("glCallList", "glCallLists"):
            call.executed = _executed(call, list_base(call.name, self.calls))
        self.calls.append(call)
        if self.before is not None:
            self.before(call)
        return call

    def made(self, call: Call) -> None:
        """Take note that a call has been made."""
        if call.name == "glNewList":
            call.compiled = seam.state.open_list
        if self.after is not None:
            self.after(call)

    @property
    def lists(self) -> dict[int, list[Call]]:
        """The display lists of the current context: number to the calls it was compiled from."""
        return {number: listing.calls() for number, listing in seam.state.lists.items()}


GLFunction = Callable[..., object]
Origin = tuple[tuple[str, ...], str, Site]  # of a call: the elements that draw, the pass, the line


class State(NamedTuple):
    """The seam's current mode: how it treats each call; ``lists`` are the current context's."""

    lists: Lists
    recorder: Recorder | None = None
    edits: Edits | None = None
    open_list: Listing | None = None  # the display list that is being compiled
    pass_: str = "setup"
    again: Origin | None = None  # of the call that is made again


class Seam:
    """The way of every call to OpenGL, by the attributes of ``namespace``."""

    def __init__(self) -> None:
        self.state = State(lists={})
        self.namespace: Any = _Namespace()
        # The attributes of the namespace outside noting() and inside it. Switching is one
        # assignment.
        self.plain: dict[str, Any] = self.namespace.__dict__
        self.noted: dict[str, Any] = {}
        # Told of the calls of a program that does not know the seam while there is no recording:
        # name, arguments, result and line.
        self.unrecorded: list[Callable[[str, tuple[object, ...], object, Site], None]] = []
        self._depth = 0  # how many noting() blocks are open
        # Whether a call of such a program is being made. It changes with each of them, so it is no
        # field of the state.
        self._inside = False
        self._begun: Counter[tuple[Site, str]] = Counter()  # lists, by line and element

    # ---- what is done with the calls of a block

    @contextmanager
    def using(self, **changes: Any) -> Iterator[State]:
        """Change fields of the state for the block; they are put back, always."""
        before = {name: getattr(self.state, name) for name in changes}
        self.state = self.state._replace(**changes)
        try:
            yield self.state
        finally:
            self.state = self.state._replace(**before)

    @contextmanager
    def recording(self, complete: bool = False) -> Iterator[Recorder]:
        """Record every call made inside the block; ``complete`` copies arrays, to replay the calls.

        A recording inside another one collects its own calls; the outer one does not see them.
        """
        recorder = Recorder(complete)
        with self.using(recorder=recorder, pass_="setup"), self.noting():
            yield recorder

    @contextmanager
    def edited(self, edits: Edits | None) -> Iterator[None]:
        """Let ``edits`` change the block's calls; None changes nothing, and costs nothing."""
        with self.using(edits=edits), self.noting() if edits is not None else nullcontext():
            yield

    @contextmanager
    def unnoted(self) -> Iterator[None]:
        """Make the block's calls without a note of them and without edits: a tool's own calls.

        Passes that begin in the block end with it.
        """
        attributes = self.namespace.__dict__
        pass_ = self.state.pass_
        with self.using(recorder=None, edits=None, open_list=None, lists={}, pass_=pass_):
            self.namespace.__dict__ = self.plain
            try:
                yield
            finally:
                self.namespace.__dict__ = attributes

    @contextmanager
    def noting(self) -> Iterator[None]:
        """Note the block's calls, for display lists and for the recording, if there is one."""
        self._depth += 1
        self.namespace.__dict__ = self.noted
        try:
            yield
        finally:
            self._depth -= 1
            if self._depth == 0:
                self.namespace.__dict__ = self.plain

    @contextmanager
    def replacing(self, name: str, function: GLFunction) -> Iterator[GLFunction]:
        """Note the calls of the block, in which ``gl.name`` is ``function``; yield what it was."""
        with self.noting():
            original = getattr(self.namespace, name)
            self.noted[name] = function
            try:
                yield original
            finally:
                self.noted[name] = original

    # ---- what the program says of itself

    def begin_pass(self, name: str) -> None:
        """Say which pass of the frame begins; setup while building."""
        self.state = self.state._replace(pass_=name)
        if name == "setup":
            self._begin_counting()

    def frame_begins(self) -> None:
        """Say that a frame begins, with its main pass."""
        self.begin_pass("main")
        self._begin_counting()

    def _begin_counting(self) -> None:
        """Count lists, and the calls that edits look for, from 0 again."""
        self._begun.clear()
        if self.state.edits is not None:
            self.state.edits.begin()

    def use_lists(self, lists: Lists) -> None:
        """Use ``lists`` as the current context's: in another, a list's number has no meaning."""
        self.state = self.state._replace(lists=lists)

    def lists_now(self) -> Lists:
        """Return the display lists of the current context."""
        return self.state.lists

    # ---- a call

    def noting_function(
        self, name: str, function: GLFunction, by_function: bool = False
    ) -> GLFunction:
        """Return OpenGL's ``function`` with each call edited, noted, made and followed up.

        ``by_function`` calls elements what a program's own functions draw: it names none itself.
        """
        to_client = concerns_arrays(name)
        follow = self._follow(name)

        def noted(*args: object, **named: object) -> object:
            origin = self.state.again or self._origin(sys._getframe(1), by_function)
            changed = self._changed(name, args, origin)
            given = None if changed is None or changed is args else args
            args = args if changed is None else changed
            values, kept, arrays = self._frozen(name, (*args, *named.values()), to_client)
            call = self._note(name, values, (*origin, kept, given, changed is None, arrays))
            if changed is None:
                return None

            result = function(*args, **named)
            if follow is not None:
                follow(origin[-1], *args)
            if call is not None and self.state.recorder is not None:
                self.state.recorder.made(call)
            return result

        return noted

    def _origin(self, frame: FrameType, by_function: bool) -> Origin:
        """Return where a call comes from that a frame of Python makes."""
        site = caller(frame)
        elements = (site.function,) if by_function else drawn_now()
        return elements, self.state.pass_, site

    def _changed(
        self, name: str, args: tuple[object, ...], origin: Origin
    ) -> tuple[object, ...] | None:
        """Return a call's arguments as the edits want them; None if it is to be left out."""
        edits = self.state.edits
        return args if edits is None else edits.change(name, args, *origin)

    def _frozen(
        self, name: str, values: tuple[object, ...], to_client: bool
    ) -> tuple[tuple[object, ...], list[object] | None, Sequence[object]]:
        """Return arguments, their form as JSON and client arrays as far as they are kept now.

        The caller may overwrite an array later. ``to_client``: the call concerns client arrays.
        """
        recorder = self.state.recorder
        if recorder is None:
            return values, None, ()
        if recorder.complete:
            arrays = recorder.client.see(name, values) if to_client else ()
            return frozen(values), None, arrays
        if any(isinstance(value, (np.ndarray, list)) for value in values):
            return values, shown(name, values), ()
        return values, None, ()

    def _note(self, name: str, values: tuple[Any, ...], where: tuple[Any, ...]) -> Call | None:
        """Note a call in the open display list, else on the recording; return it if it is there."""
        state = self.state
        if state.open_list is not None and name != "glEndList":
            state.open_list.note(name, values, where)
            return None
        if state.recorder is None:
            return None
        return state.recorder.add(Call(name, values, *where))

    def _follow(self, name: str) -> Callable[..., None] | None:
        """Return what is told of a call once it is made: of those that concern display lists."""
        followed: dict[str, Callable[..., None]] = {
            "glNewList": self._begin_list,
            "glEndList": self._end_list,
            "glDeleteLists": self._forget_lists,
        }
        return followed.get(name)

    def _begin_list(self, site: Site, name: int, mode: int) -> None:
        element = drawn_now()[0]
        listing = Listing(site, element, self._begun[site, element])
        self._begun[site, element] += 1
        self.state.lists[int(name)] = listing
        self.state = self.state._replace(open_list=listing)
        if self.state.edits is not None:
            self.state.edits.begin_list(listing)

    def _end_list(self, _: Site) -> None:
        self.state = self.state._replace(open_list=None)
        if self.state.edits is not None:
            self.state.edits.end_list()

    def _forget_lists(self, _: Site, first: int, count: int) -> None:
        for name in range(int(first), int(first) + int(count)):
            self.state.lists.pop(name, None)

    def make_again(self, call: Call) -> None:
        """Make a recorded call again as if the same line did: noted, and edited, as then."""
        for name, args in call.arrays:
            if self.state.recorder is not None:
                self.state.recorder.client.see(name, args)
            with self.unnoted():
                getattr(self.namespace, name)(*args)

        with self.using(again=(call.shared_by, call.pass_, call.site)):
            getattr(self.namespace, call.name)(*(call.args if call.given is None else call.given))
        if call.compiled is not None:
            for inner in call.compiled.calls():
                self.make_again(inner)

    # ---- calls of programs that do not know the seam

    def outermost(self, name: str, function: GLFunction, draws: bool) -> GLFunction:
        """Return ``function`` for a program that knows nothing of the seam, with its calls noted.

        Those that PyOpenGL makes inside another call are not. The first call that ``draws``,
        outside display lists, ends the setup.
        """
        noted = self.noting_function(name, function, by_function=True)

        def called(*args: object, **named: object) -> object:
            state = self.state
            if self._inside or state.recorder is None:
                result = None
                try:
                    result = function(*args, **named)
                finally:
                    for tell in self.unrecorded:
                        tell(name, (*args, *named.values()), result, caller(sys._getframe(1)))
                return result
            if draws and state.pass_ == "setup" and state.open_list is None:
                self.begin_pass("main")
            self._inside = True
            try:
                return noted(*args, **named)
            finally:
                self._inside = False

        return called

    def briefly(self, name: str, function: GLFunction, noted: GLFunction) -> GLFunction:
        """Return ``function``, which only gives numbers, with a short note if asked for.

        ``noted`` notes a call where that does not say enough: in display lists, in the setup, with
        edits, or from a library.
        """

        def called(*args: object, **named: object) -> object:
            state = self.state
            recorder = state.recorder
            if recorder is None:
                return noted(*args, **named) if self.unrecorded else function(*args, **named)
            listed = self._inside or state.open_list is not None
            full = listed or state.edits is not None or state.pass_ == "setup"
            frame = sys._getframe(1)
            known = known_files.get(frame.f_code.co_filename)
            if recorder.brief is None or full or named or not known:
                return noted(*args, **named)
            result = function(*args)
            recorder.brief.append((len(recorder.calls), name, frame.f_code, frame.f_lasti, args))
            return result

        return called

    def glu_noted(self, name: str, function: GLFunction) -> GLFunction:
        """Return a function of GLU with a note of each call, beside those it makes of OpenGL.

        A call that has no effect is seen by that: gluPerspective with an aspect of 0, for instance.
        """

        def called(*args: object, **named: object) -> object:
            state = self.state
            if state.recorder is None:
                return function(*args, **named)
            noted = state.open_list or state.recorder
            site = caller(sys._getframe(1))
            values = (*args, *named.values())
            note = GluCall(name, values, site, state.pass_, noted.length, noted.length)
            noted.glu.append(note)
            try:
                return function(*args, **named)
            finally:
                note.end = noted.length

        called.__name__, called.__doc__ = name, function.__doc__
        return called


class _Namespace:
    """OpenGL's functions and enumerants as attributes; PyOpenGL is imported at the first use."""

    def __getattr__(self, name: str) -> Any:
        # Code that inspects any object it meets, as pytest does, must not import OpenGL before a
        # platform is chosen.
        if not name.startswith(("gl", "GL")):
            raise AttributeError(name)
        value = original(name)
        if self.__dict__ is seam.noted and callable(value) and name.startswith("gl"):
            value = seam.noting_function(name, value)
        self.__dict__[name] = value
        return value


def _executed(call: Call, base: int = 0) -> list[Listing]:
    """Return the display lists that a glCallList, or a glCallLists from ``base`` on, executes."""
    if call.name not in ("glCallList", "glCallLists"):
        return []
    names = call.args if call.name == "glCallList" else call.args[-1]
    lists = seam.state.lists
    return [lists[base + int(name)] for name in names if base + int(name) in lists]


seam = Seam()
gl: Any = seam.namespace
unrecorded = seam.unrecorded

recording = seam.recording
edited = seam.edited
unnoted = seam.unnoted
noting = seam.noting
replacing = seam.replacing
begin_pass = seam.begin_pass
frame_begins = seam.frame_begins
use_lists = seam.use_lists
lists_now = seam.lists_now
make_again = seam.make_again
outermost = seam.outermost
briefly = seam.briefly
glu_noted = seam.glu_noted
