"""The frame as a tree: passes, elements, calls, and the calls inside display lists. No OpenGL.

An element that draws twice in a pass stands there twice: the order of the calls is that of the
frame. The calls between a glBegin and its glEnd are folded under the glBegin.

Every row has an identity that outlives the frame: a call is what framelens/tape/edits.py finds
again, so a row stays chosen, and open, when the frame is recorded anew.
"""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from framelens.gl.seam import Call, Listing
from framelens.tape.edits import Located, located

Identity = tuple[object, ...]


@dataclass
class Node:
    """A row of the tree: a pass, an element, or a call (``found`` is None for the other two).

    ``place`` is the call's number, as in "12" or "12.3"; ``last`` is the number of the last call
    of a pass or an element. Calls inside a display list are read when they are first asked for.
    """

    identity: Identity
    kind: str  # pass, element or call
    name: str
    depth: int
    place: str = ""
    found: Located | None = None
    parent: "Node | None" = None
    count: int = 0  # calls inside it
    inner: "list[Node]" = field(default_factory=list)
    _listed: bool = False

    @property
    def call(self) -> Call:
        """The call of a call's row."""
        assert self.found is not None
        return self.found.call

    @property
    def folded(self) -> bool:
        """Whether there is something inside it."""
        return bool(self.inner) or (not self._listed and self.count > 0)

    @property
    def children(self) -> "list[Node]":
        """What is inside it."""
        if not self._listed and self.found is not None and self.call.executed:
            self._listed = True
            place = 0
            for listing in self.call.executed:
                assert isinstance(listing, Listing)
                calls = located(listing.calls(), listing)
                self.inner += nested(calls, self, [f"{self.place}.{place + k}" for k in _to(calls)])
                place += len(calls)
        return self.inner


def _to(items: Sequence[object]) -> range:
    return range(len(items))


def nested(calls: Sequence[Located], parent: Node, places: Sequence[str]) -> list[Node]:
    """Return the rows of calls, those up to a glEnd inside their glBegin."""
    rows: list[Node] = []
    begin: Node | None = None
    for found, place in zip(calls, places, strict=True):
        above = begin or parent
        identity = (*above.identity, found.key, found.occurrence)
        node = Node(identity, "call", found.call.name, above.depth + 1, place, found, above)
        node.count = sum(len(each.calls()) for each in found.call.executed)
        if begin is None:
            rows.append(node)
        else:
            begin.inner.append(node)
            begin.count += 1
        if found.call.name == "glBegin":
            begin = node
        elif found.call.name == "glEnd":
            begin = None
    return rows


class Tree:
    """The passes of a frame, from its calls."""

    def __init__(self, calls: Sequence[Call] = ()) -> None:
        """Group the calls of one frame, whose numbers count from 0."""
        self.passes: list[Node] = []
        self.count = len(calls)
        counts: Counter[Identity] = Counter()
        found = located(calls)
        start = 0
        while start < len(calls):
            end = start
            of = calls[start].pass_, calls[start].shared_by
            while end < len(calls) and (calls[end].pass_, calls[end].shared_by) == of:
                end += 1
            self._add(of[0], ", ".join(of[1]), found[start:end], start, counts)
            start = end

    def _add(
        self,
        pass_: str,
        element: str,
        found: Sequence[Located],
        start: int,
        counts: Counter[Identity],
    ) -> None:
        """Add calls that follow each other in one pass and of one element."""
        if not self.passes or self.passes[-1].name != pass_:
            identity: Identity = (pass_, counts[pass_,])
            counts[pass_,] += 1
            self.passes.append(Node(identity, "pass", pass_, 0, str(start)))
        above = self.passes[-1]
        identity = (*above.identity, element, counts[*above.identity, element])
        counts[*above.identity, element] += 1
        node = Node(identity, "element", element, 1, str(start), parent=above)
        node.inner = nested(found, node, [str(start + k) for k in _to(found)])
        node.count = len(found)
        above.count += len(found)
        above.inner.append(node)

    def rows(self, opened: set[Identity]) -> list[Node]:
        """Return the rows that are seen, where those in ``opened`` are open."""
        found: list[Node] = []
        _unfold(self.passes, opened, found)
        return found

    def every(self) -> Iterator[Node]:
        """Yield all rows but those inside display lists."""
        waiting = list(reversed(self.passes))
        while waiting:
            node = waiting.pop()
            yield node
            waiting += reversed(node.inner)

    def at(self, place: str) -> Node | None:
        """Return the row of the call at a place, as "12" or "12.3"; None if there is none."""
        parts = place.split(".")
        top = (each for each in self.every() if each.kind == "call" and each.place == parts[0])
        node = next(top, None)
        for depth in range(1, len(parts)):
            node = _inside(node, ".".join(parts[: depth + 1]))
        return node

    def find(self, identity: Identity) -> Node | None:
        """Return the row of this identity; None if the frame no longer has it."""
        among, found = self.passes, None
        while among:
            found = next((each for each in among if _leads(each.identity, identity)), None)
            if found is None or found.identity == identity:
                return found
            among = found.children
        return None


def _leads(identity: Identity, wanted: Identity) -> bool:
    return wanted[: len(identity)] == identity


def _inside(node: Node | None, place: str) -> Node | None:
    """Return the row at a place among what is inside a row, glBegins too."""
    for each in node.children if node else ():
        if each.place == place:
            return each
        for inner in each.inner:
            if inner.place == place:
                return inner
    return None


def _unfold(nodes: Sequence[Node], opened: set[Identity], found: list[Node]) -> None:
    for node in nodes:
        found.append(node)
        if node.identity in opened:
            _unfold(node.children, opened, found)
