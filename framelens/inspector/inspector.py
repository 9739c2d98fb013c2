"""The inspector: what it lists, what is chosen in it, and the edits. No OpenGL, no window.

Keys and the mouse arrive as picks (see bindings.py) and as targets of the picture; what needs
OpenGL is asked for in ``wants`` and done by inspector_frame.py.
"""

from collections.abc import Mapping, Sequence
from typing import Any

from framelens.gl.seam import Call
from framelens.inspector.inspector_tree import Identity, Node, Tree
from framelens.inspector.inspector_values import Cell, cells, chosen, dragged, edit_of, stepped
from framelens.inspector.wheel import Wheel
from framelens.tape.edits import Edit, Located
from framelens.tape.effects import Effect
from framelens.tape.pixel import Row
from framelens.tape.safe import may_be_left_out

PAGE = 12  # chosen: rows that Page Up and Page Down go
WHEEL = 3  # chosen: rows that a notch of the wheel goes


def _differ(before: Row, after: Row) -> bool:
    """Whether a draw has changed the pixel's colour."""
    return after.outcome == "drawn" and before.pixel.color != after.pixel.color


class Inspector:
    """The inspector's state: the shown frame, the selection, and the user's edits.

    ``edits`` are in force. ``version`` changes with whatever can be seen. ``wants`` has "save",
    "pixel", "why", "why_all" or "close" where that is to be done; ``pixel`` is the one asked about,
    x and y from the top left, None for the middle of the window. ``said`` is a message, by its key
    in words.py; ``answer`` are lines that say why the pixel or the picture looks as it does.
    """

    def __init__(self, edits: Sequence[Edit] = ()) -> None:
        """Begin closed, with edits that are already in force."""
        self.open = False
        self.stopped = True
        self.edits = list(edits)
        self.version = 0

        self.wants: set[str] = set()
        self.pixel: tuple[int, int] | None = None
        self.said: tuple[str, dict[str, str]] = ("", {})
        self.answer: list[str] = []

        self.tree = Tree()
        self.opened: set[Identity] = set()
        self.selected: Identity = ()
        self.rows: list[Node] = []
        self.first: int | None = None  # the first row shown, None: the chosen one is in the middle

        self.place: tuple[int, int | None, str] | None = None  # the chosen cell of the call
        self.history: list[Row] | None = None  # of the pixel, while it is shown
        self.fragment = 0  # the chosen row of the history
        self.effects: Mapping[str, Effect] = {}
        self.numbers: Sequence[int] = ()  # of the calls listed, as `landscape trace` counts them
        self.frame: int | None = None  # the number of a program's frame

        self._past: list[list[Edit]] = []
        self._dragged: tuple[Cell, float] | None = None
        self._moved = False
        self._wheel = Wheel()
        self._before = 0  # calls listed that are made before the frame begins

    # What is shown.

    def show(self, calls: Sequence[Call], effects: Mapping[str, Effect]) -> None:
        """List a frame that was recorded; what was chosen and open stays so where it is there."""
        self.tree = Tree(calls)
        self.effects = effects
        frame = (k for k, call in enumerate(calls) if call.pass_ != "setup")
        self._before = next(frame, len(calls))
        if not self.opened:
            self.opened = {node.identity for node in self.tree.passes}
        self._list()

    def _list(self) -> None:
        self.version += 1
        self.rows = self.tree.rows(self.opened)
        identity = self.selected
        while identity and all(node.identity != identity for node in self.rows):
            identity = identity[:-1]
        self.selected = identity or (self.rows[0].identity if self.rows else ())

    @property
    def index(self) -> int:
        """Which row is chosen."""
        found = (k for k, node in enumerate(self.rows) if node.identity == self.selected)
        return next(found, 0)

    @property
    def node(self) -> Node | None:
        """The chosen row."""
        return self.rows[self.index] if self.rows else None

    @property
    def found(self) -> Located | None:
        """The chosen call; None where a pass or an element is chosen."""
        return self.node.found if self.node else None

    def cells(self) -> list[Cell]:
        """Return the cells of the chosen call."""
        found = self.found
        return cells(found.call, self.edits_of(found)) if found else []

    @property
    def cell(self) -> Cell | None:
        """The chosen cell; where none was chosen, the first number, or else the last enumerant."""
        free = [cell for cell in self.cells() if cell.kind != "fixed"]
        usual = next((cell for cell in free if cell.kind == "number"), free[-1] if free else None)
        return next((cell for cell in free if cell.place == self.place), usual)

    def numbered(self, place: str) -> str:
        """Return a call's place as the commands take it.

        Where the calls before the frame are unknown, "+12" counts from the frame's beginning.
        """
        first, point, rest = place.partition(".")
        if int(first) < len(self.numbers):
            return f"{self.numbers[int(first)]}{point}{rest}"
        index = int(first) - self._before
        return f"+{index}{point}{rest}" if index >= 0 else ""

    def edits_of(self, found: Located) -> list[Edit]:
        """Return the edits of a call."""
        keys = (found.key, found.key.loose())
        return [e for e in self.edits if e.occurrence == found.occurrence and e.key in keys]

    def is_off(self, found: Located) -> bool:
        """Whether a call is left out."""
        return any(edit.skip for edit in self.edits_of(found))

    def choose(self, node: Node) -> None:
        """Choose a row, and open what it is in."""
        above = node.parent
        while above is not None:
            self.opened.add(above.identity)
            above = above.parent
        self.selected = node.identity
        self.first = None
        self.place = None
        self._list()

    def go_to(self, place: str) -> None:
        """Choose the call at a place."""
        if node := self.tree.at(place):
            self.choose(node)

    def ask(self, rows: list[Row], listed: bool) -> None:
        """Choose the call that gave a pixel its colour; show all its draws if ``listed``."""
        changes = [k for k in range(len(rows)) if k == 0 or _differ(rows[k - 1], rows[k])]
        self.fragment = changes[-1] if changes else 0
        self.history = rows if listed else None
        if rows:
            call = rows[self.fragment].call
            self.go_to(rows[self.fragment].step.place)
            self.say("" if listed else "inspector.under", element=call.element, call=call.name)
        self.version += 1

    def explain(self, lines: Sequence[str], place: str) -> None:
        """Show why a pixel or the picture looks as it does, and choose the call to blame, if any.

        ``place`` is where the call stands in the list, "" where it is not listed.
        """
        self.history = None
        self.say()
        if place:
            self.go_to(place)
        self.answer = list(lines)
        self.version += 1

    def say(self, key: str = "", **values: str) -> None:
        """Show a message, "" to show none."""
        self.said = key, values
        self.version += 1

    # Keys.

    def press(self, pick: str) -> None:
        """Do what a key asks for."""
        self.version += 1
        self.said = ("", {})
        self.answer = []
        action = getattr(self, f"_{pick}", None)
        if pick in ("save", "pixel", "why", "why_all", "close"):
            self.wants.add(pick)
        elif action is not None:
            action()

    def _up(self, way: int = -1) -> None:
        if self.history is not None:
            self._fragment(self.fragment + way)
        elif self.rows:
            to = min(max(self.index + way, 0), len(self.rows) - 1)
            self.selected = self.rows[to].identity
            self.first = None
            self.place = None

    def _down(self) -> None:
        self._up(1)

    def _page_up(self) -> None:
        self._up(-PAGE)

    def _page_down(self) -> None:
        self._up(PAGE)

    def _home(self) -> None:
        self._up(-max(len(self.rows), len(self.history or ())))

    def _end(self) -> None:
        self._up(max(len(self.rows), len(self.history or ())))

    def _fragment(self, to: int) -> None:
        """Choose a row of the history, and its call."""
        if self.history:
            self.fragment = min(max(to, 0), len(self.history) - 1)
            self.go_to(self.history[self.fragment].step.place)

    def _right(self) -> None:
        node = self.node
        if node is not None and self.history is None and node.folded:
            if node.identity in self.opened:
                self._up(1)
            else:
                self.opened.add(node.identity)
                self._list()

    def _left(self) -> None:
        node = self.node
        if self.history is not None:
            self.history = None
        elif node is not None and node.identity in self.opened:
            self.opened.discard(node.identity)
            self._list()
        elif node is not None and node.parent is not None:
            self.choose(node.parent)

    def _enter(self) -> None:
        node = self.node
        if self.history is not None:
            self.history = None
        elif node is not None and node.folded:
            self.opened ^= {node.identity}
            self._list()
        else:
            self._more()

    def _next_value(self, way: int = 1) -> None:
        free = [cell for cell in self.cells() if cell.kind != "fixed"]
        if free and (now := self.cell):
            at = next(k for k, cell in enumerate(free) if cell.place == now.place)
            self.place = free[(at + way) % len(free)].place

    def _previous_value(self) -> None:
        self._next_value(-1)

    def _more(self, way: int = 1, fine: bool = False) -> None:
        cell = self.cell
        if cell is not None and self.found is not None:
            usual = next((c.value for c in cells(self.found.call) if c.place == cell.place), None)
            self.change(cell, stepped(cell, way, fine, usual))

    def _less(self) -> None:
        self._more(-1)

    def _more_fine(self) -> None:
        self._more(1, True)

    def _less_fine(self) -> None:
        self._more(-1, True)

    def _stop(self) -> None:
        self.stopped = not self.stopped

    def _switch(self) -> None:
        """Leave the chosen call out, or make it again."""
        found = self.found
        if found is None:
            return
        if self.is_off(found):
            self._put([e for e in self.edits if not (e.skip and e in self.edits_of(found))])
        elif may_be_left_out(found.call.name):
            self._put([*self.edits, found.without()])
        else:
            self.say("inspector.needed")

    def _undo(self) -> None:
        """Undo the last change."""
        if self._past:
            self.edits = self._past.pop()

    def _undo_here(self) -> None:
        """Undo the edits of the chosen call."""
        found = self.found
        if found is not None and (mine := self.edits_of(found)):
            self._put([edit for edit in self.edits if edit not in mine])

    def _undo_all(self) -> None:
        if self.edits:
            self._put([])

    # Changes.

    def change(self, cell: Cell, value: object, together: bool = False) -> None:
        """Give a cell of the chosen call a value; ``together`` with the change before, for undo."""
        found = self.found
        if found is None or value is None:
            return
        edit = edit_of(found, cell, value)
        others = [each for each in self.edits if each.place != edit.place]
        own = next((c for c in cells(found.call) if c.place == cell.place), None)
        same = own is not None and cell.kind != "bit" and own.value == value
        self.place = cell.place
        self._put(others if same else [*others, edit], together)

    def _put(self, edits: list[Edit], together: bool = False) -> None:
        if edits != self.edits:
            if not together:
                self._past.append(self.edits)
            self.edits = edits
            self.version += 1

    # The mouse.

    def click(self, target: tuple[Any, ...], x: float) -> None:
        """Take the left button going down on a target of the picture, at x in pixels."""
        self.version += 1
        self.said = ("", {})
        kind, what = target[0], target[1]
        if kind == "row":
            self._click_row(self.rows[what], target[2:] == ("sign",))
        elif kind == "fragment":
            self._fragment(what)
        elif kind == "cell":
            self.place = what
            if cell := self.cell:
                self._dragged, self._moved = (cell, x), False
        elif kind == "choice" and (cell := self.cell):
            self.change(cell, chosen(cell, what))

    def _click_row(self, node: Node, on_sign: bool) -> None:
        was = node.identity == self.selected
        first = self.first
        self.choose(node)
        self.first = first
        if node.folded and (on_sign or was):
            self.opened ^= {node.identity}
            self._list()

    def drag(self, x: float, fine: bool) -> None:
        """Take the mouse moving to x with the button down."""
        if self._dragged is not None:
            cell, start = self._dragged
            value = dragged(cell, x - start, fine)
            if value is not None and abs(x - start) >= 1:
                self.change(cell, value, together=self._moved)
                self._moved = True

    def release(self, back: bool = False) -> None:
        """Take the button going up; without a drag, an enumerant goes on to the next one."""
        if self._dragged is not None and not self._moved:
            cell = self._dragged[0]
            if cell.kind in ("enum", "bit", "boolean"):
                self.change(cell, stepped(cell, -1 if back else 1, False))
        self._dragged = None

    def wheel(self, notches: float, first: int) -> None:
        """Scroll the rows; ``first`` is the first one shown now."""
        rows = self._wheel.steps(notches * WHEEL)
        if rows:
            self.first = min(max(first - rows, 0), max(len(self.rows) - 1, 0))
            self.version += 1
