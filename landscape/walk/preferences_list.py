"""The list of preferences in the walk (F2): what it shows, and how its keys change it. No OpenGL.

The first rows are values, which + and - change. The others are actions with their keys: Enter
waits for the next key, which becomes the action's own.
"""

from collections.abc import Collection
from dataclasses import replace

from framelens.base.errors import InputError
from framelens.base.texts import said
from framelens.gl.glfw_library import glfw
from framelens.inspector.keys import Namer, us_name
from landscape.walk import words
from landscape.walk.keymap import ACTIONS
from landscape.walk.keys import pick
from landscape.walk.preferences import COMMENTS, LANGUAGES, LIMITS, Preferences
from landscape.walk.settings_list import Line, Page, written

VALUES = tuple(COMMENTS)
ROWS = (*VALUES, *ACTIONS)
STEPS = {"mouse_speed": 0.1, "field_of_view": 5.0, "text_size": 0.25, "volume": 0.25}
PAGE_ROWS = 8  # chosen: rows that Page Up and Page Down go


class PreferencesList:
    """The preferences, which row is chosen, and whether the list is open."""

    def __init__(self, preferences: Preferences) -> None:
        """Begin with the first row of a list that is shut."""
        self.preferences = preferences
        self.open = False
        self.waiting = False  # for the key that the chosen action gets
        self.index = 0
        self._refusal: InputError | None = None

    @property
    def row(self) -> str:
        """The chosen row: the name of a value or of an action."""
        return ROWS[self.index]

    def toggle(self) -> None:
        """Open or shut the list."""
        self.open = not self.open
        self.waiting = False
        self._refusal = None

    def key(self, key: int, name: Namer, claimed: Collection[str] = ()) -> None:
        """Carry out a key that was pressed while the list was open.

        ``name`` says what is printed on a key, ``claimed`` are the scene's own letters.
        """
        self._refusal = None
        if self.waiting:
            self.waiting = False
            if key != glfw.KEY_ESCAPE:
                self._give(key, name, claimed)
            return

        picked = pick(key, name)
        if picked == "list":  # Escape
            self.toggle()
        elif picked in ("up", "down"):
            self._go(1 if picked == "down" else -1)
        elif picked in ("previous_group", "next_group"):
            self._go(PAGE_ROWS if picked == "next_group" else -PAGE_ROWS)
        elif picked in ("first", "last"):
            self.index = 0 if picked == "first" else len(ROWS) - 1
        elif picked == "default":
            self._reset()
        elif self.row in VALUES:
            self._step({"more": 1, "less": -1, "switch": 1}.get(picked, 0))
        elif picked == "switch":
            self.waiting = True

    def point(self, line: int) -> None:
        """Choose the row in a line of the page, if there is one; no key is waited for any more."""
        number = line - 1 if line <= len(VALUES) else line - 2
        if line not in (0, len(VALUES) + 1):
            self.index, self.waiting = number, False

    def choose(self) -> None:
        """Do with the chosen row what Enter does."""
        self.key(glfw.KEY_ENTER, us_name)

    def _go(self, rows: int) -> None:
        self.index = (self.index + rows) % len(ROWS)

    def _give(self, key: int, name: Namer, claimed: Collection[str]) -> None:
        """Give the chosen action a key, unless another action has it."""
        try:
            keys = self.preferences.keys.with_key(self.row, key, name, claimed)
        except InputError as error:
            self._refusal = error
        else:
            self.preferences = replace(self.preferences, keys=keys)

    def _reset(self) -> None:
        """Bring the chosen row back to its default."""
        if self.row in VALUES:
            usual = Preferences().value(self.row)
            self.preferences = self.preferences.with_value(self.row, usual)
        else:
            keys = self.preferences.keys.without(self.row)
            self.preferences = replace(self.preferences, keys=keys)

    def _step(self, way: int) -> None:
        """Change the chosen value by a step up or down."""
        if way == 0:
            return
        value = self.preferences.value(self.row)
        after = stepped(self.row, value, way)
        self.preferences = self.preferences.with_value(self.row, after)

    def page(self, language: str, name: Namer, claimed: Collection[str]) -> Page:
        """Return what the list shows."""
        lines = [Line(words.text(language, "preferences.comfort"))]
        for row in VALUES:
            value = shown(row, self.preferences.value(row), language)
            label = words.text(language, f"preference.{row}")
            lines.append(Line(label, value, "", row == self.row))

        lines.append(Line(words.text(language, "help.title")))
        for action in ACTIONS:
            keys = self.preferences.keys.labels(action, language, name, claimed)
            here = action == self.row
            if here and self.waiting:
                keys = words.text(language, "preferences.press")
            lines.append(Line(action_text(action, language), keys or "-", "", here))

        ways = "preferences.change" if self.row in VALUES else "preferences.key"
        below = [words.text(language, ways), words.text(language, "preferences.leave")]
        if self._refusal is not None:
            below.insert(0, self._refused(language, name))
        return Page(words.text(language, "preferences.title"), tuple(lines), tuple(below))

    def _refused(self, language: str, name: Namer) -> str:
        """Return why the last key was refused; actions by what they are called in the list."""
        assert self._refusal is not None
        values = dict(self._refusal.values)
        for what in ("action", "owner"):
            if what in values:
                values[what] = action_text(str(values[what]), language)
        return said(InputError(self._refusal.args[0], **values), language)


def stepped(row: str, value: object, way: int) -> object:
    """Return the value of a row one step up (``way`` 1) or down (-1)."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, str):
        return LANGUAGES[(LANGUAGES.index(value) + way) % len(LANGUAGES)]
    assert isinstance(value, float)
    low, high = LIMITS[row]
    usual = Preferences().value(row)
    assert isinstance(usual, float)
    if usual < low and value == usual:
        return 60.0  # from the field of view of each view to one of one's own
    after = round(value + way * STEPS[row], 6)
    if after < low and usual < low:
        return usual
    return min(max(after, low), high)


def shown(row: str, value: object, language: str) -> str:
    """Return a value as the list shows it."""
    if value == "":
        return words.text(language, "preferences.system")
    if row == "field_of_view" and value == 0.0:
        return words.text(language, "preferences.by_view")
    assert isinstance(value, bool | int | float | str)
    return written(value, language)


def action_text(action: str, language: str) -> str:
    """Return what an action is called in the list."""
    return words.text(language, f"action.{action}")
