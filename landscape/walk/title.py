"""The title: what `landscape walk` without a view shows first, and what Escape leads back to.

It lists the last walk, the scenes, the views with their pictures, the fly-over and the course. The
arrow keys and the mouse choose, Enter or a click goes there, Escape goes back, and at last leaves;
a gamepad does the same. Nothing of a scene is loaded until one is chosen, so the title is there at
once.
"""

import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from framelens.base.texts import translator
from framelens.gl.contexts.glfw import GLFWContext
from framelens.gl.glfw_library import glfw
from framelens.gl.seam import gl
from framelens.gl.state import attrib, flat_projection
from framelens.inspector.panel import Plate
from landscape.scene.scene import SCENES, scene
from landscape.walk import last, words
from landscape.walk.pad import Pad
from landscape.walk.thumbnails import FLIGHT, thumbnail
from landscape.walk.title_image import Drawn, Row, title_image

SIZE = (1280, 720)  # chosen: a walk's window, in the window system's coordinates
TO_TITLE = -1  # what a walk returns from which one goes back to the title
REST = 0.02  # chosen: seconds between two looks at the keys
FILLED = "flyover.mode=filled"
COMMANDS = {"flyover": ("flyover", "canyon", "--set", FILLED), "course": ("lecture",)}
"""What the title starts beside the walk: words of the command line."""


@dataclass(frozen=True)
class Entry:
    """Something to choose: what it is called, and what it does.

    ``kind`` is "view" (``value`` is its name, or a scene's), "last", "views" (their list),
    "command" (a key of COMMANDS) or "quit". ``picture`` is shown while it is chosen.
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


def start_command(words_: Sequence[str]) -> int:
    """Run a command of the program until it ends; return its exit status."""
    return subprocess.run([sys.executable, "-m", "landscape", *words_], check=False).returncode


class Title:
    """The title in a window, which it does not own."""

    def __init__(
        self,
        context: GLFWContext,
        language: str,
        pad: Pad | None = None,
        start: Callable[[Sequence[str]], int] = start_command,
    ) -> None:
        """Begin with the first entry chosen; ``start`` runs a command."""
        self._context, self._language = context, language
        self._pad, self._start = pad or Pad(), start
        self.note = ""  # what went wrong, to be said below the entries
        self._below = False  # whether the list of views is open
        self.entries = main_entries(language)
        self.index = 0
        self._former = 0  # the entry that was chosen before the list of views was opened
        self.choice: Entry | None = None
        self.left = False
        self._drawn: Drawn | None = None
        self._shown: tuple[object, ...] = ()
        self._plate: Plate | None = None

    def key(self, key: int, action: int = glfw.PRESS) -> None:
        """Carry out a key: arrows choose, Enter goes there, Escape goes back or leaves."""
        if action == glfw.RELEASE:
            return
        step = {glfw.KEY_UP: -1, glfw.KEY_DOWN: 1, glfw.KEY_TAB: 1}.get(key)
        if step is not None:
            self.index = (self.index + step) % len(self.entries)
        elif key in (glfw.KEY_HOME, glfw.KEY_END):
            self.index = 0 if key == glfw.KEY_HOME else len(self.entries) - 1
        elif action == glfw.PRESS and key in (glfw.KEY_ENTER, glfw.KEY_KP_ENTER, glfw.KEY_SPACE):
            self.choose()
        elif action == glfw.PRESS and key == glfw.KEY_ESCAPE:
            self.back()

    def back(self) -> None:
        """Leave the list of views, or the program."""
        if not self._below:
            self.left = True
            return
        self._below, self.entries, self.index = False, main_entries(self._language), self._former

    def choose(self) -> None:
        """Do what is chosen."""
        entry = self.entries[self.index]
        self.note = ""
        if entry.kind == "quit":
            self.left = True
        elif entry.kind == "views":
            self._below, self._former = True, self.index
            self.entries, self.index = view_entries(self._language), 0
        elif entry.kind == "command":
            self._run(COMMANDS[entry.value])
        else:
            self.choice = entry

    def _run(self, command: Sequence[str]) -> None:
        """Run a command in a window of its own, while this one is away."""
        self._say("starting")
        glfw.hide_window(self._context.window)
        status = self._start([*command, "--lang", self._language])
        glfw.show_window(self._context.window)
        self._context.make_current()
        self.note = words.text(self._language, "title.failed") if status else ""

    def _say(self, key: str) -> None:
        self.note = words.text(self._language, f"title.{key}")
        self.draw()

    def point(self, x: float, y: float) -> bool:
        """Choose the entry at a place in the window's coordinates; return whether there is one."""
        scale = self._context.scale()
        found = self._drawn.at(x * scale, y * scale) if self._drawn is not None else None
        if found is not None:
            self.index = found
        return found is not None

    def click(self, x: float, y: float) -> None:
        """Do what is at a place in the window's coordinates."""
        if self.point(x, y):
            self.choose()

    def draw(self) -> None:
        """Draw the title if it has changed, and show it."""
        size = self._context.pixels()
        if 0 in size:
            return
        entry = self.entries[self.index]
        below = self.note or words.text(
            self._language, "title.keys.views" if self._below else "title.keys"
        )
        shown = size, tuple(self.entries), self.index, below
        if shown == self._shown:
            return
        self._shown = shown
        dpi = max(glfw.get_window_content_scale(self._context.window))
        heading = words.text(self._language, "title.views") if self._below else "landscape"
        rows = [Row(each.text, each.beside) for each in self.entries]
        self._drawn = title_image(heading, rows, self.index, below, size, dpi, entry.picture)
        self._context.make_current()
        self.release()
        self._plate = Plate(self._drawn.image)
        show_plate(self._plate, size)
        self._context.show()

    def run(self) -> Entry | None:
        """Let the user choose; return what, or None if he leaves. The window stays open."""
        window = self._context.window
        self.choice, self.left, self._shown = None, False, ()
        if not self._below:
            # Where a walk has ended since, it can be gone on with: that comes first.
            self.entries, self.index = main_entries(self._language), 0
        glfw.set_window_title(window, "landscape")
        glfw.set_key_callback(window, lambda _, key, __, action, ___: self.key(key, action))
        glfw.set_cursor_pos_callback(window, lambda _, x, y: self.point(x, y))
        glfw.set_mouse_button_callback(window, self._clicked)
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
            self.release()
        return self.choice

    def _clicked(self, window: object, button: int, action: int, _: int) -> None:
        if button == glfw.MOUSE_BUTTON_LEFT and action == glfw.PRESS:
            self.click(*glfw.get_cursor_pos(window))

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        if self._plate is not None:
            self._plate.release()
            self._plate = None


def show_plate(plate: Plate, size: tuple[int, int]) -> None:
    """Draw a picture of the window's ``size`` over all of it; the state is as it was before."""
    groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_VIEWPORT_BIT
    with attrib(groups), flat_projection(0, size[0], 0, size[1], -1, 1):
        gl.glViewport(0, 0, *size)
        for off in (gl.GL_DEPTH_TEST, gl.GL_FOG, gl.GL_LIGHTING, gl.GL_BLEND):
            gl.glDisable(off)
        gl.glEnable(gl.GL_TEXTURE_2D)
        plate.draw(0, 0, 1.0)
