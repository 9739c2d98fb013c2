"""Edits: other arguments for single calls of a frame, in display lists too, or calls left out.

A call is found again by what it is, not by its number: function, element, pass, the text of its
line of code and the function around it, the arguments that say what it sets (the light, the
parameter's name), and, where all these agree, by which of them it is. So an edit survives calls
that come or go elsewhere, and lines that move. An edit written by hand may leave out what it need
not say.
"""

import functools
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from itertools import islice
from typing import Any

import numpy as np

from framelens.base.arguments import is_number
from framelens.base.errors import InputError, short
from framelens.gl.notes import plain
from framelens.gl.seam import Call, Listing, Site, gl
from framelens.spec import spec
from framelens.tape.safe import may_be_changed, most

PLACES = 3  # chosen: places named where a call was made, for an edit that found none
WHOLE = ("int", "count", "object", "bits", "enum", "mask", "boolean")

# How many first arguments say what a call sets, by the beginning of its name.
SELECTORS = (
    (("glTexParameter", "glTexEnv", "glTexGen", "glLight", "glMaterial"), 2),
    (("glLightModel", "glFog", "glEnable", "glDisable", "glHint", "glClipPlane"), 1),
    (("glPixelStore", "glPixelTransfer", "glPointParameter", "glPolygonMode"), 1),
    (("glActiveTexture", "glClientActiveTexture", "glBindTexture", "glMatrixMode"), 1),
)


def selectors(name: str, args: Sequence[object]) -> tuple[str, ...]:
    """Return the arguments that say what a call sets, as text: ("GL_LIGHT0", "GL_AMBIENT")."""
    counts = [
        (len(start), count)
        for starts, count in SELECTORS
        for start in starts
        if name.startswith(start)
    ]
    count = max(counts, default=(0, 0))[1]
    return tuple(str(plain(value)) for value in args[:count])


@dataclass(frozen=True)
class ListKey:
    """How a display list is found again: by the line that began it, and which of those it is."""

    element: str
    file: str
    function: str
    text: str
    occurrence: int

    @classmethod
    def of(cls, listing: Listing) -> "ListKey":
        """Return the key of a list."""
        site = listing.site
        return cls(listing.element, site.file, site.function, site.text, listing.occurrence)

    def finds(self, other: "ListKey") -> bool:
        """Whether this is the key of a list with the key ``other``, whose file has its folder."""
        return other == replace(self, file=other.file) and _same_file(self.file, other.file)


@dataclass(frozen=True)
class Key:
    """How a call is found again, all but which of several calls that agree in this.

    That of an edit may have "" for what may be anything, and no ``select`` if it has such a "".
    """

    name: str
    element: str
    pass_: str
    file: str
    function: str
    text: str
    select: tuple[str, ...]
    list: ListKey | None = None

    def loose(self) -> "Key":
        """Return the key without the line's text, which an author may have changed."""
        return Key(
            self.name,
            self.element,
            self.pass_,
            self.file,
            self.function,
            "",
            self.select,
            self.list,
        )

    def finds(self, other: "Key") -> bool:
        """Whether this, the key of an edit, is one of a call with the key ``other``."""
        if self in (other, other.loose()):
            return True
        open_ = "" in (self.element, self.pass_, self.file, self.function)
        return (
            self.name == other.name
            and self.element in ("", other.element, _last(other.element))
            and self.pass_ in ("", other.pass_)
            and _same_file(self.file, other.file)
            and self.function in ("", other.function, _last(other.function))
            and self.text in ("", other.text)
            and (self.select == other.select or (open_ and not self.select))
            and self._same_list(other.list, open_)
        )

    def _same_list(self, other: ListKey | None, open_: bool) -> bool:
        if self.list is None or other is None:
            return self.list is other or (self.list is None and open_)
        return self.list.finds(other)


def _last(function: str) -> str:
    """Return the name of a function without the class or function that it is in."""
    return function.rpartition(".")[2]


def _same_file(given: str, file: str) -> bool:
    """Whether a file of an edit is the one that a call comes from; it may lack its folders."""
    return given in ("", file) or file.endswith(f"/{given}")


def key_of(
    name: str,
    args: Sequence[object],
    element: str,
    pass_: str,
    site: Site,
    listing: ListKey | None,
) -> Key:
    """Return the key of a call by what the seam knows of it; ``args`` are the program's own."""
    return Key(
        name, element, pass_, site.file, site.function, site.text, selectors(name, args), listing
    )


@dataclass(frozen=True)
class Edit:
    """Another value for an argument of a call, for one component of it, or the call left out.

    ``value`` is a number, text such as "GL_EXP2" or "GL_FOG_BIT | GL_LIGHTING_BIT", a truth value,
    or a list of numbers; ``component`` counts the numbers of a vector or a matrix.
    """

    key: Key
    occurrence: int = 0
    argument: int = 0
    value: object = None
    component: int | None = None
    skip: bool = False
    shown: str = ""  # the call as it was, for messages
    origin: str = field(default="edit", compare=False)  # "edits.json: edit 2", for messages

    @property
    def place(self) -> tuple[Key, int, int, int | None, bool]:
        """What is edited: of two edits of the same place, the later one counts."""
        return self.key, self.occurrence, self.argument, self.component, self.skip


@functools.cache
def enumerant(text: str) -> int:
    """Return the value of an enumerant, or of bits joined by "|", by name; KeyError if unknown."""
    value = 0
    for name in text.split("|"):
        found = getattr(gl, name.strip(), None) if name.strip().startswith("GL_") else None
        if found is None:
            raise KeyError(name.strip())
        if "|" not in text:
            return found
        value |= int(found)
    return value


def edited_value(former: Any, value: Any, component: int | None = None) -> Any:
    """Return the argument to use instead of ``former``, of the same type where that matters."""
    if component is not None or (isinstance(value, list) and not isinstance(former, (list, tuple))):
        array = np.array(former)
        if component is None:
            array = np.array(value, array.dtype).reshape(array.shape)
        else:
            array.reshape(-1)[component] = value
        return type(former)(array.tolist()) if isinstance(former, (list, tuple)) else array
    if isinstance(value, str):
        return enumerant(value)
    if isinstance(value, list):
        return type(former)(value)
    if isinstance(former, float) or (isinstance(value, float) and not isinstance(former, bool)):
        return float(value)
    return value


class NotAllowed(ValueError):
    """OpenGL could crash with this value."""


def fitting(edit: Edit, args: Sequence[Any]) -> object:
    """Return what an edit makes of its argument; ValueError and the like where it cannot."""
    name, index = edit.key.name, edit.argument
    former = args[index]
    value = edited_value(former, edit.value, edit.component)
    whole = spec.kind_of(name, index, args) in WHOLE and not isinstance(former, float)
    if whole and isinstance(value, float):
        if not value.is_integer():
            raise NotAllowed("expected a whole number")
        value = int(value)
    if not may_be_changed(name, index, args):
        raise NotAllowed("it says what OpenGL reads from memory, or the program needs it")
    limit = most(name, index, args)
    if limit is not None and not 0 <= value <= limit:
        raise NotAllowed(f"expected 0 to {limit:g}, as there are no more vertices")
    return value


@dataclass
class Edits:
    """The edits in force; the seam asks :meth:`change` at each call while they are installed.

    It raises InputError for a value that does not fit its argument.
    """

    edits: Sequence[Edit] = ()
    found: set[int] = field(default_factory=set)  # indices of edits that have found their call

    def __post_init__(self) -> None:
        self._counts: Counter[Key] = Counter()  # of calls that each edit's key has found
        self._finding: dict[Key, list[Key]] = {}  # a call's key: those of the edits that find it
        self._outer: list[tuple[Counter[Key], ListKey | None]] = []
        self._list: ListKey | None = None
        self.set(self.edits)

    def set(self, edits: Iterable[Edit]) -> None:
        """Put other edits in force."""
        self.edits = list(edits)
        self._by_name: dict[str, dict[Key, list[int]]] = {}
        for index, edit in enumerate(self.edits):
            keys = self._by_name.setdefault(edit.key.name, {})
            keys.setdefault(edit.key, []).append(index)
        self._finding.clear()

    def begin(self) -> None:
        """A frame begins, or the setup: calls are counted from 0 again."""
        self._counts.clear()

    def begin_list(self, listing: Listing) -> None:
        """The compiling of a display list begins: its calls are counted by themselves."""
        self._outer.append((self._counts, self._list))
        self._counts, self._list = Counter(), ListKey.of(listing)

    def end_list(self) -> None:
        """The compiling of a display list ends."""
        if self._outer:
            self._counts, self._list = self._outer.pop()

    def change(
        self, name: str, args: tuple[object, ...], elements: tuple[str, ...], pass_: str, site: Site
    ) -> tuple[object, ...] | None:
        """Return the arguments to use for a call, ``args`` itself if no edit is of it."""
        keys = self._by_name.get(name)
        if keys is None:
            return args
        key = key_of(name, args, elements[0], pass_, site, self._list)
        finding = self._finding.get(key)
        if finding is None:
            finding = self._finding[key] = [each for each in keys if each.finds(key)]
        mine: list[int] = []
        for each in finding:
            occurrence = self._counts[each]
            self._counts[each] += 1
            mine += [index for index in keys[each] if self.edits[index].occurrence == occurrence]
        return self._apply(sorted(mine), args)

    def _apply(self, indices: Sequence[int], args: tuple[object, ...]) -> tuple[object, ...] | None:
        changed = list(args)
        for index in indices:
            edit = self.edits[index]
            self.found.add(index)
            if edit.skip:
                return None
            try:
                changed[edit.argument] = fitting(edit, changed)
            except (TypeError, ValueError, IndexError) as error:
                where = f"{edit.origin}: {edit.key.name}, argument"
                reason = f": {error}" if isinstance(error, NotAllowed) else ""
                raise InputError(
                    "{where} {argument}: it cannot be {value}{reason}",
                    where=where,
                    argument=edit.argument,
                    value=short(edit.value),
                    reason=reason,
                ) from None
        return tuple(changed) if indices else args

    def missed(self) -> list[str]:
        """Return a line for each edit that has found no call."""
        return [
            f"{edit.origin}: no call {_described(edit)} was made{self._instead(edit.key.name)}"
            for index, edit in enumerate(self.edits)
            if index not in self.found
        ]

    def _instead(self, name: str) -> str:
        """Return where calls of a name were made, for an edit that has found none."""
        places = dict.fromkeys(
            f"{key.function} ({key.file})" for key in self._finding if key.name == name
        )
        some = ", ".join(islice(places, PLACES))
        return f"; {name} is called in {some}" if some else ""


def _described(edit: Edit) -> str:
    """Return in words which call an edit is of, as far as it says so."""
    key = edit.key
    element = f" of {key.element}" if key.element else ""
    function = f" in {key.function}" if key.function else ""
    file = f" ({key.file})" if key.file else ""
    return f"{edit.shown or key.name}{element}{function}{file}"


@dataclass(frozen=True)
class Located:
    """A call and how it is found again."""

    call: Call
    key: Key
    occurrence: int

    def edit(self, argument: int = 0, value: object = None, component: int | None = None) -> Edit:
        """Return an edit of one of the call's arguments."""
        return Edit(self.key, self.occurrence, argument, value, component, shown=as_code(self.call))

    def without(self) -> Edit:
        """Return the edit that leaves the call out."""
        return Edit(self.key, self.occurrence, skip=True, shown=as_code(self.call))


def located(calls: Iterable[Call], listing: Listing | None = None) -> list[Located]:
    """Return how each call is found again; they are all of a frame, of a setup, or of a list."""
    counts: Counter[Key] = Counter()
    found = []
    within = None if listing is None else ListKey.of(listing)
    for call in calls:
        given = call.args if call.given is None else call.given
        key = key_of(call.name, given, call.element, call.pass_, call.site, within)
        found.append(Located(call, key, counts[key]))
        counts[key] += 1
    return found


def located_at(calls: Sequence[Call], begin: int, place: str) -> Located:
    """Return how the call at a place is found again; the frame begins with ``calls[begin]``."""
    number, *inside = map(int, place.split("."))
    among = calls[begin:] if number >= begin else calls[:begin]
    found = located(among)[number - begin if number >= begin else number]
    for index in inside:
        for listing in found.call.executed:
            inner = listing.calls()
            if index < len(inner):
                assert isinstance(listing, Listing)
                found = located(inner, listing)[index]
                break
            index -= len(inner)
    return found


def as_code(call: Call) -> str:
    """Return a call as one writes it: glFogf(GL_FOG_DENSITY, 0.12)."""
    arguments = (_argument(call, index, value) for index, value in enumerate(call.shown))
    return f"{call.name}({', '.join(arguments)})"


def _argument(call: Call, index: int, value: object) -> str:
    """Return an argument in a few characters; ``value`` is the argument as JSON.

    An enumerant that the program gave as a plain number, or as an array of one, has its name.
    """
    is_array = isinstance(value, dict) and value.get("shape") == [1]
    if is_array or is_number(value):
        name = spec.enumerant(call.name, index, call.args)
        if name:
            return f"[{name}]" if is_array else name
    return brief(value)


def brief(value: object) -> str:
    """Return an argument, given as JSON, in a few characters."""
    if isinstance(value, dict) and "values" in value:
        values = value["values"]
        if len(values) <= 16 and all(isinstance(v, (int, float)) for v in values):
            return "[" + ", ".join(f"{v:g}" for v in values) + "]"
        return f"{value['dtype']}{value['shape']}"
    return f"{value:g}" if isinstance(value, float) else str(value)
