"""The title: what `landscape walk` without a view shows first, and what Escape leads back to.

It lists the last walk, the scenes, the views with their pictures, the landmarks, the fly-over and
the course. The arrow keys and the mouse choose, Enter or a click goes there, Escape goes back, and
at last leaves; a gamepad does the same. Keys and preferences are shown as in the walk. Nothing of a
scene is loaded until one is chosen, so the title is there at once.
"""

import os
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from framelens.base.texts import choose, translator
from framelens.gl.contexts.glfw import GLFWContext
from framelens.gl.glfw_library import glfw
from framelens.gl.seam import gl
from framelens.gl.state import attrib, flat_projection
from framelens.inspector.keys import system_name
from framelens.inspector.panel import Panel, Plate, enlarged, keys_image
from landscape.scene.landmarks import LANDMARKS
from landscape.scene.scene import SCENES, find_view, scene
from landscape.walk import last, words
from landscape.walk.digits import help_rows
from landscape.walk.landmarks import Found, title_of
from landscape.walk.landmarks_list import FOUND, Teller, nothing_told, told
from landscape.walk.list_image import line_at, list_image
from landscape.walk.pad import Pad
from landscape.walk.preferences import Preferences, kept
from landscape.walk.preferences_list import PreferencesList
from landscape.walk.screen import FullScreen
from landscape.walk.settings_list import Page
from landscape.walk.start_command import start_command
from landscape.walk.thumbnails import FLIGHT, thumbnail
from landscape.walk.title_image import Drawn, Row, title_image

TO_TITLE = -1  # what a walk returns from which one goes back to the title
REST = 0.02  # chosen: seconds between two looks at the keys
FILLED = "flyover.mode=filled"
COMMANDS = {"flyover": ("flyover", "canyon", "--set", FILLED), "course": ("lecture",)}
"""What the title starts beside the walk: words of the command line."""


@dataclass(frozen=True)
class Entry:
    """Something to choose: what it is called, and what it does.

    ``kind`` is "view" (``value`` is its name, or a scene's), "last", "views" or "landmarks" (their
    lists), "landmark" (``value`` is its name), "lesson" (to be run), "command" (a key of COMMANDS),
    "back" or "quit". ``picture`` is shown while it is chosen.
    """

    text: str
    kind: str
    value: str = ""
    beside: str = ""
    picture: Path | None = None


def main_entries(language: str) -> list[Entry]:
    """Return what the title begins with."""

    def word(key: str) -> str:
        return words.text(language, f"title.{key}")

    found = []
    if last.read() is not None:
        found.append(Entry(word("last"), "last", picture=last.picture()))
    for name in SCENES:
        found.append(Entry(word(name), "view", name, picture=thumbnail(name)))
    seen = last.picture() or thumbnail(next(iter(SCENES)))
    return [
        *found,
        Entry(word("views"), "views", picture=seen),
        Entry(word("landmarks"), "landmarks", picture=thumbnail("fig35i")),
        Entry(word("flyover"), "command", "flyover", picture=thumbnail(FLIGHT)),
        Entry(word("course"), "command", "course", picture=seen),
        Entry(word("quit"), "quit", picture=seen),
    ]


def view_entries(language: str) -> list[Entry]:
    """Return the main views of all scenes."""
    said = translator(language, "gallery")
    return [
        Entry(said(kind.views[name].shows), "view", name, name, thumbnail(name))
        for kind in map(scene, SCENES)
        for name in kind.main
    ]


def landmark_entries(language: str, found: Found) -> list[Entry]:
    """Return all landmarks; a sign is beside those that have been found."""
    return [
        Entry(
            title_of(each, language),
            "landmark",
            each.name,
            FOUND if each.name in found.names else "–",
            thumbnail(each.name) or thumbnail(each.scene),
        )
        for each in LANDMARKS
    ]


@dataclass(frozen=True)
class Level:
    """A list of the title: its heading, what is said below it, and which entry was chosen."""

    heading: str
    below: str
    entries: list[Entry]
    index: int = 0


class Title:
    """The title in a window, which it does not own."""

    def __init__(
        self,
        context: GLFWContext,
        language: str,
        pad: Pad | None = None,
        start: Callable[[Sequence[str]], int] = start_command,
        preferences: Preferences | None = None,
        found: Found | None = None,
        tells: Teller = nothing_told,
        keeps: bool = False,
    ) -> None:
        """Begin with the first entry chosen; ``start`` runs a command.

        With ``keeps`` preferences that are changed are kept. ``found`` and ``tells`` are as in the
        walk.
        """
        self._context = context
        self._pad, self._start = pad or Pad(), start
        self.wishes = PreferencesList(preferences or Preferences())
        self.language = language
        self._found = found or Found()
        self._tells = tells
        self._keeps = keeps
        self.note = ""  # what went wrong, to be said below the entries
        self._help = False
        self.level = self._main()
        self._above: list[Level] = []  # the lists from which this one was opened
        self.choice: Entry | None = None
        self.left = False
        self._drawn: Drawn | None = None
        self._shown: tuple[object, ...] = ()
        self._plate: Plate | None = None
        self._dpi = max(glfw.get_window_content_scale(context.window))
        self._panel = Panel("", (), self._dpi)
        self._full_screen = FullScreen(context.size)

    @property
    def entries(self) -> list[Entry]:
        """The entries of the open list."""
        return self.level.entries

    @property
    def index(self) -> int:
        """The number of the chosen entry."""
        return self.level.index

    def _word(self, key: str) -> str:
        return words.text(self.language, key)

    def _main(self) -> Level:
        return Level("landscape", self._word("title.keys"), main_entries(self.language))

    def key(self, key: int, action: int = glfw.PRESS) -> None:
        """Carry out a key: arrows choose, Enter goes there, Escape goes back or leaves."""
        if action == glfw.RELEASE:
            return
        if self.wishes.open:
            self._wish(key)
            return
        step = {glfw.KEY_UP: -1, glfw.KEY_DOWN: 1, glfw.KEY_TAB: 1}.get(key)
        if step is not None:
            self._go((self.index + step) % len(self.entries))
        elif key in (glfw.KEY_HOME, glfw.KEY_END):
            self._go(0 if key == glfw.KEY_HOME else len(self.entries) - 1)
        elif action != glfw.PRESS:
            return
        elif key in (glfw.KEY_ENTER, glfw.KEY_KP_ENTER, glfw.KEY_SPACE):
            self.choose()
        elif key == glfw.KEY_ESCAPE:
            self.back()
        else:
            self._obey(self.wishes.preferences.keys.owner(key, system_name))

    def _go(self, index: int) -> None:
        """Choose an entry; the list of keys, which would hide it, is shut."""
        self.level, self._help = replace(self.level, index=index), False
        self.note = ""

    def _obey(self, order: str) -> None:
        """Carry out what a key of the walk does here, too."""
        if order == "help":
            self._help = not self._help
        elif order == "preferences":
            self.wishes.toggle()
            self._help = False
        elif order == "landmarks" and not self._above:
            self._open_landmarks()
        elif order == "fullscreen":
            self._full_screen.toggle(self._context.window)

    def _wish(self, key: int) -> None:
        """Carry out a key in the list of preferences."""
        before = self.wishes.preferences
        if not self.wishes.waiting and self.wishes.preferences.keys.owner(key, system_name) == (
            "preferences"
        ):
            self.wishes.toggle()
        else:
            self.wishes.key(key, system_name)
        self._heed(before)
        self._keep()

    def _heed(self, before: Preferences) -> None:
        """Heed a language that was chosen."""
        language = self.wishes.preferences.language
        if language != before.language:
            self.language = language or choose(os.environ)
        if before != self.wishes.preferences and not self._above:
            self.level = replace(self._main(), index=self.index)

    def _keep(self) -> None:
        """Keep the preferences when their list has been shut."""
        if not self.wishes.open and self._keeps:
            self.note = kept(self.wishes.preferences, self.language)

    def heed(self, preferences: Preferences) -> None:
        """Take preferences that were changed in a walk."""
        before, self.wishes.preferences = self.wishes.preferences, preferences
        self._heed(before)

    def back(self) -> None:
        """Leave the list of keys, a list below the first one, or the program."""
        if self._help:
            self._help = False
        elif self._above:
            above = self._above.pop()
            self.level = above if self._above else replace(self._main(), index=above.index)
        else:
            self.left = True

    def _open(self, level: Level) -> None:
        self._above.append(self.level)
        self.level = level

    def choose(self) -> None:
        """Do what is chosen."""
        entry = self.entries[self.index]
        self.note, self._help = "", False
        if entry.kind == "quit":
            self.left = True
        elif entry.kind == "back":
            self.back()
        elif entry.kind == "views":
            views = view_entries(self.language)
            self._open(Level(self._word("title.views"), self._word("title.keys.views"), views))
        elif entry.kind == "landmarks":
            self._open_landmarks()
        elif entry.kind == "landmark":
            self._open_landmark(entry)
        elif entry.kind == "lesson":
            self._run(("lesson", entry.value))
        elif entry.kind == "command":
            self._run(COMMANDS[entry.value])
        else:
            self.choice = entry

    def _open_landmarks(self) -> None:
        entries = landmark_entries(self.language, self._found)
        heading = f"{self._word('landmarks.title')}  {len(self._found.names)}/{len(entries)}"
        self._open(Level(heading, self._word("title.keys.landmarks"), entries))

    def _open_landmark(self, entry: Entry) -> None:
        """Show the text of what has been found."""
        if entry.value not in self._found.names:
            self.note = self._word("title.unknown")
            return
        landmark = next(each for each in LANDMARKS if each.name == entry.value)
        heading, *text = told(landmark, self.language, self._tells)
        entries = [
            Entry(self._word("title.run"), "lesson", landmark.lesson, picture=entry.picture),
            Entry(self._word("title.back"), "back", picture=entry.picture),
        ]
        self._open(Level(heading, "\n".join(text), entries))

    def _run(self, command: Sequence[str]) -> None:
        """Run a command in a window of its own, while this one is away."""
        self.note = self._word("title.starting")
        self.draw()
        glfw.hide_window(self._context.window)
        status = self._start([*command, "--lang", self.language])
        glfw.show_window(self._context.window)
        self._context.make_current()
        self.note = self._word("title.failed") if status else ""

    def point(self, x: float, y: float) -> bool:
        """Choose the entry at a place in the window's coordinates; return whether there is one."""
        scale = self._context.scale()
        if self.wishes.open:
            line = line_at(self._page(), self._context.pixels(), self._dpi, x * scale, y * scale)
            if line is not None:
                self.wishes.point(line)
            return line is not None
        found = self._drawn.at(x * scale, y * scale) if self._drawn is not None else None
        if found is not None and found != self.index:
            self._go(found)
        return found is not None

    def wheel(self, up: float) -> None:
        """Choose an entry further up, or down for a negative number, up to the end of the list."""
        if self.wishes.open or not up:
            return
        step = -1 if up > 0 else 1
        self._go(min(max(self.index + step, 0), len(self.entries) - 1))

    def click(self, x: float, y: float) -> None:
        """Do what is at a place in the window's coordinates."""
        if not self.point(x, y):
            return
        if self.wishes.open:
            before = self.wishes.preferences
            self.wishes.choose()
            self._heed(before)
        else:
            self.choose()

    def _page(self) -> Page:
        return self.wishes.page(self.language, system_name, ())

    def _help_rows(self) -> list[tuple[str, str]]:
        """Return the keys of the walk that is chosen, or of one on the island."""
        entry = self.entries[self.index]
        kind = find_view(entry.value)[0] if entry.kind == "view" else scene()
        keymap = self.wishes.preferences.keys
        return help_rows(kind, kind.settings, self.language, system_name, keymap)

    def _image(self, size: tuple[int, int], below: str, behind: Path | None) -> Drawn:
        """Return the picture of the level that is shown, with a text below its entries."""
        lines = [Row(each.text, each.beside) for each in self.entries]
        first = self._drawn.first if self._drawn is not None else 0
        listed = self.level.heading, lines, self.index, below, size, self._dpi, behind
        return title_image(*listed, first=first)

    def draw(self) -> None:
        """Draw the title if it has changed, and show it."""
        size = self._context.pixels()
        if 0 in size:
            return

        entry = self.entries[self.index]
        below = self.note or self.level.below
        page = self._page() if self.wishes.open else None
        rows = tuple(self._help_rows()) if self._help else ()
        larger = self.wishes.preferences.text_size
        shown = size, self.level.heading, tuple(self.entries), self.index, below, page, rows, larger

        if shown == self._shown:
            return
        self._shown = shown

        self._dpi = enlarged(size, max(glfw.get_window_content_scale(self._context.window)), larger)
        self._drawn = self._image(size, below, entry.picture)
        self._context.make_current()
        self._release_plate()
        self._plate = Plate(self._drawn.image)
        show_plate(self._plate, size)
        self._draw_over(size, page, rows)
        self._context.show()

    def _draw_over(
        self, size: tuple[int, int], page: Page | None, rows: tuple[tuple[str, str], ...]
    ) -> None:
        """Draw over the title the page of preferences if there is one, or else the list of keys."""
        self._panel.dpi = dpi = self._dpi
        gl.glViewport(0, 0, *size)
        if page is not None:
            self._panel.draw(
                size, left=((page, dpi), lambda: list_image(page, size, dpi)), opaque=True
            )
        elif rows:
            keys = self._word("help.title"), rows, size, dpi
            self._panel.draw(size, left=(keys, lambda: keys_image(*keys)), opaque=True)

    def run(self) -> Entry | None:
        """Let the user choose; return what, or None if he leaves. The window stays open."""
        window = self._context.window
        self.choice = None
        self.left = False
        self._shown = ()

        if not self._above:
            # Where a walk has ended since, it can be gone on with: that comes first.
            self.level = self._main()

        glfw.set_window_title(window, "landscape")
        glfw.set_key_callback(window, lambda _, key, __, action, ___: self.key(key, action))
        glfw.set_cursor_pos_callback(window, lambda _, x, y: self.point(x, y))
        glfw.set_mouse_button_callback(window, self._clicked)
        glfw.set_scroll_callback(window, lambda _, __, up: self.wheel(up))

        try:
            while self.choice is None and not self.left:
                glfw.poll_events()
                if glfw.window_should_close(window):
                    return None
                for key in self._pad.take(True)[2]:
                    self.key(key)
                self.draw()
                time.sleep(REST)
        finally:
            glfw.set_key_callback(window, None)
            glfw.set_cursor_pos_callback(window, None)
            glfw.set_mouse_button_callback(window, None)
            glfw.set_scroll_callback(window, None)
            self.release()
        return self.choice

    def _clicked(self, window: object, button: int, action: int, _: int) -> None:
        if button == glfw.MOUSE_BUTTON_LEFT and action == glfw.PRESS:
            self.click(*glfw.get_cursor_pos(window))

    def _release_plate(self) -> None:
        if self._plate is not None:
            self._plate.release()
            self._plate = None

    def release(self) -> None:
        """Delete the textures; may be called twice."""
        self._release_plate()
        self._panel.release()


def show_plate(plate: Plate, size: tuple[int, int]) -> None:
    """Draw a picture of the window's ``size`` over all of it; the state is as it was before."""
    groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_VIEWPORT_BIT
    with attrib(groups), flat_projection(0, size[0], 0, size[1], -1, 1):
        gl.glViewport(0, 0, *size)
        for off in (gl.GL_DEPTH_TEST, gl.GL_FOG, gl.GL_LIGHTING, gl.GL_BLEND):
            gl.glDisable(off)
        gl.glEnable(gl.GL_TEXTURE_2D)
        plate.draw(0, 0, 1.0)
