"""The seam: every OpenGL call of the program goes through the namespace :data:`gl`.

Off, it costs nothing: once looked up, an attribute of ``gl`` is PyOpenGL's function itself, but for
a few (window_framebuffer.py). Inside :func:`noting` they are functions that note a call and then
make it. Three things need that. A :func:`recording` collects the calls, with their arguments, the
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
from typing import Any

import numpy as np

from framelens.gl.client import ClientArrays, concerns_arrays, frozen, list_base
from framelens.gl.drawing import drawing, drawn_now
from framelens.gl.notes import Brief, Call, Edits, GluCall, Site, caller, known_files, shown

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
    "unnoted",
    "unrecorded",
    "use_lists",
]


class Calls:
    """OpenGL's functions and enumerants as attributes; PyOpenGL is imported at the first use."""

    def __getattr__(self, name: str) -> Any:
        # Code that inspects any object it meets, as pytest does, must not import OpenGL before a
        # platform is chosen.
        if not name.startswith(("gl", "GL")):
            raise AttributeError(name)
        from framelens.gl.foreign import original

        value = original(name)
        if self.__dict__ is _noted and callable(value) and name.startswith("gl"):
            value = noting_function(name, value)
        self.__dict__[name] = value
        return value


gl: Any = Calls()
# The attributes of ``gl`` outside noting() and inside it. Switching is one assignment.
_plain: dict[str, Any] = gl.__dict__
_noted: dict[str, Any] = {}
_depth = 0  # how many noting() blocks are open


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
        self._notes: list[Any] = []
        self._calls: list[Call] | None = None

    def note(self, name: str, args: tuple[Any, ...], where: tuple[Any, ...]) -> None:
        """Add a call; ``where`` holds the next fields of a Call, as many as FIELDS."""
        self._notes += (name, len(args), *args, *where)

    def calls(self) -> list[Call]:
        """Return the calls, each with the calls of the display lists that it executes."""
        if self._calls is None:
            self._calls, notes = [], iter(self._notes)
            for name in notes:
                args = tuple(islice(notes, next(notes)))
                call = Call(name, args, *islice(notes, FIELDS))
                call.executed = _executed(call)
                self._calls.append(call)
        return self._calls

    def put(self, calls: list[Call]) -> None:
        """Note that the list has been compiled again, from these calls."""
        self._calls = calls


Lists = dict[int, Listing]
"""The display lists of one context, by their numbers."""


class Recorder:
    """What a recording has collected; calls compiled into a list are listed under it.

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
            call.compiled = _open
        if self.after is not None:
            self.after(call)

    @property
    def lists(self) -> dict[int, list[Call]]:
        """The display lists of the current context: number to the calls it was compiled from."""
        return {number: listing.calls() for number, listing in _lists.items()}


_recorder: Recorder | None = None
_edits: Edits | None = None
_lists: Lists = {}
_open: Listing | None = None  # the display list that is being compiled
_again: tuple[tuple[str, ...], str, Site] | None = None  # what made the call that is made again
_inside = False  # whether a call of a program that does not know the seam is being made
# Told of such calls while there is no recording: name, arguments, result and line.
unrecorded: list[Callable[[str, tuple[Any, ...], Any, Site], None]] = []
_begun: Counter[tuple[Site, str]] = Counter()  # lists, by line and element
current_pass = "setup"


@contextmanager
def recording(complete: bool = False) -> Iterator[Recorder]:
    """Record every call made inside the block; ``complete`` copies arrays, to replay the calls.

    A recording inside another one collects its own calls; the outer one does not see them.
    """
    global _recorder, current_pass
    before = _recorder, current_pass
    recorder = Recorder(complete)
    _recorder, current_pass = recorder, "setup"
    try:
        with noting():
            yield recorder
    finally:
        _recorder, current_pass = before


@contextmanager
def edited(edits: Edits | None) -> Iterator[None]:
    """Let ``edits`` change the calls of the block; None changes nothing, and costs nothing."""
    global _edits
    before, _edits = _edits, edits
    try:
        with noting() if edits is not None else nullcontext():
            yield
    finally:
        _edits = before


@contextmanager
def unnoted() -> Iterator[None]:
    """Make the block's calls without a note of them and without edits: a tool's own calls."""
    global _recorder, _edits, _open, _lists
    before = _recorder, _edits, _open, _lists
    _recorder = None
    _edits = None
    _open = None
    _lists = {}
    namespace, gl.__dict__ = gl.__dict__, _plain
    try:
        yield
    finally:
        gl.__dict__ = namespace
        _recorder, _edits, _open, _lists = before


@contextmanager
def noting() -> Iterator[None]:
    """Note the block's calls, for display lists and for the recording, if there is one."""
    global _depth
    _depth += 1
    gl.__dict__ = _noted
    try:
        yield
    finally:
        _depth -= 1
        if _depth == 0:
            gl.__dict__ = _plain


@contextmanager
def replacing(name: str, function: Callable[..., Any]) -> Iterator[Callable[..., Any]]:
    """Note the calls of the block, in which ``gl.name`` is ``function``; yield what it was."""
    with noting():
        original = getattr(gl, name)
        _noted[name] = function
        try:
            yield original
        finally:
            _noted[name] = original


def begin_pass(name: str) -> None:
    """Say which pass of the frame begins; setup while building."""
    global current_pass
    current_pass = name
    if name == "setup":
        _begin_counting()


def frame_begins() -> None:
    """Say that a frame begins, with its main pass."""
    begin_pass("main")
    _begin_counting()


def _begin_counting() -> None:
    """Count lists, and the calls that edits look for, from 0 again."""
    _begun.clear()
    if _edits is not None:
        _edits.begin()


def use_lists(lists: Lists) -> None:
    """Use ``lists`` as the current context's: a list's number has no meaning in another context."""
    global _lists
    _lists = lists


def lists_now() -> Lists:
    """Return the display lists of the current context."""
    return _lists


def noting_function(
    name: str, function: Callable[..., Any], by_function: bool = False
) -> Callable[..., Any]:
    """Return OpenGL's ``function`` with a note taken of each call.

    ``by_function`` calls elements what a program's own functions draw: it names none itself.
    """
    follow, to_client = _FOLLOW.get(name), concerns_arrays(name)

    def noted(*args: Any, **named: Any) -> Any:
        given = None
        if _again is not None:
            elements, pass_, site = _again
        else:
            site, pass_ = caller(sys._getframe(1)), current_pass
            elements = (site.function,) if by_function else drawn_now()

        skipped = False
        if _edits is not None:
            changed = _edits.change(name, args, elements, pass_, site)
            skipped = changed is None
            if changed is not None and changed is not args:
                given, args = args, changed

        values, kept = (*args, *named.values()), None
        arrays: Sequence[Any] = ()
        if _recorder is not None:
            if _recorder.complete:
                if to_client:
                    arrays = _recorder.client.see(name, values)
                values = frozen(values)
            elif any(isinstance(value, (np.ndarray, list)) for value in values):
                kept = shown(name, values)  # now: the caller may overwrite an array later

        where = (elements, pass_, site, kept, given, skipped, arrays)
        call = None
        if _open is not None and name != "glEndList":
            _open.note(name, values, where)
        elif _recorder is not None:
            call = _recorder.add(Call(name, values, *where))

        if skipped:
            return None
        result = function(*args, **named)
        if follow is not None:
            follow(site, *args)
        if call is not None and _recorder is not None:
            _recorder.made(call)
        return result

    return noted


def make_again(call: Call) -> None:
    """Make a recorded call again as if the same line did: noted, and edited, as it was then."""
    global _again
    for name, args in call.arrays:
        if _recorder is not None:
            _recorder.client.see(name, args)
        with unnoted():
            getattr(gl, name)(*args)
    _again = call.shared_by, call.pass_, call.site
    try:
        getattr(gl, call.name)(*(call.args if call.given is None else call.given))
        if call.compiled is not None:
            for inner in call.compiled.calls():
                make_again(inner)
    finally:
        _again = None


def outermost(name: str, function: Callable[..., Any], draws: bool) -> Callable[..., Any]:
    """Return ``function`` for a program that knows nothing of the seam, with its calls noted.

    Those that PyOpenGL makes inside another call are not. The first call that ``draws``, outside
    display lists, ends the setup.
    """
    noted = noting_function(name, function, by_function=True)

    def called(*args: Any, **named: Any) -> Any:
        global _inside
        if _inside or _recorder is None:
            result = None
            try:
                result = function(*args, **named)
            finally:
                for told in unrecorded:
                    told(name, (*args, *named.values()), result, caller(sys._getframe(1)))
            return result
        if draws and current_pass == "setup" and _open is None:
            begin_pass("main")
        _inside = True
        try:
            return noted(*args, **named)
        finally:
            _inside = False

    return called


def briefly(
    name: str, function: Callable[..., Any], noted: Callable[..., Any]
) -> Callable[..., Any]:
    """Return ``function``, which only gives numbers, with a short note of each call if asked for.

    ``noted`` notes a call where that does not say enough: in display lists, in the setup, with
    edits, or from a library.
    """

    def called(*args: Any, **named: Any) -> Any:
        if _recorder is None:
            return noted(*args, **named) if unrecorded else function(*args, **named)
        brief, frame = _recorder.brief, sys._getframe(1)
        full = _inside or _open is not None or _edits is not None or current_pass == "setup"
        known = known_files.get(frame.f_code.co_filename)
        if brief is None or full or named or not known:
            return noted(*args, **named)
        result = function(*args)
        brief.append((len(_recorder.calls), name, frame.f_code, frame.f_lasti, args))
        return result

    return called


def glu_noted(name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function of GLU with a note of each call, beside those that it makes of OpenGL.

    A call that has no effect is seen by that: gluPerspective with an aspect of 0, for instance.
    """

    def called(*args: Any, **named: Any) -> Any:
        if _recorder is None or _open is not None:
            return function(*args, **named)
        calls = _recorder.calls
        site = caller(sys._getframe(1))
        note = GluCall(name, (*args, *named.values()), site, current_pass, len(calls), len(calls))
        _recorder.glu.append(note)
        try:
            return function(*args, **named)
        finally:
            note.end = len(calls)

    called.__name__, called.__doc__ = name, function.__doc__
    return called


def _begin(site: Site, name: int, mode: int) -> None:
    global _open
    element = drawn_now()[0]
    _open = _lists[int(name)] = Listing(site, element, _begun[site, element])
    _begun[site, element] += 1
    if _edits is not None:
        _edits.begin_list(_open)


def _end(_: Site) -> None:
    global _open
    _open = None
    if _edits is not None:
        _edits.end_list()


def _forget(_: Site, first: int, count: int) -> None:
    for name in range(int(first), int(first) + int(count)):
        _lists.pop(name, None)


_FOLLOW: dict[str, Callable[..., None]] = {
    "glNewList": _begin,
    "glEndList": _end,
    "glDeleteLists": _forget,
}


def _executed(call: Call, base: int = 0) -> list[Listing]:
    """Return the display lists that a glCallList, or a glCallLists from ``base`` on, executes."""
    if call.name not in ("glCallList", "glCallLists"):
        return []
    names = call.args if call.name == "glCallList" else call.args[-1]
    return [_lists[base + int(name)] for name in names if base + int(name) in _lists]
