"""The list of a lecture's steps: keys, letters and the mouse choose one of them."""

import time

import numpy as np

from framelens.program.program_run import Library
from landscape.course.lecture import texts
from landscape.course.lecture.image import Listed, steps_image
from landscape.course.lecture.plan import Lecture

TYPING = 1.5  # chosen: seconds after which letters begin a new word


class StepList:
    """The list, while it is ``open``. ``chosen`` is the index of the chosen step."""

    def __init__(self, lecture: Lecture) -> None:
        """Begin closed."""
        self.open = False
        self.chosen = 0
        self._lecture = lecture
        self._rows = texts.listed(lecture)
        self._typed, self._typed_at = "", 0.0
        self._picture: Listed | None = None

    def toggle(self, index: int) -> None:
        """Open the list with the step shown now as the chosen one; or close it."""
        self.open = not self.open
        self.chosen = index
        self._typed = ""

    @property
    def foot(self) -> str:
        """The line below the list: the number typed so far, and the keys."""
        return f"{self._typed}  {texts.word('list')}".strip()

    def image(self, size: tuple[int, int], now: int) -> np.ndarray:
        """Return the picture for a window of ``size``; ``now`` is the index of the step shown."""
        title = texts.heading(self._lecture)
        self._picture = steps_image(size, title, self._rows, self.chosen, now, self.foot)
        return self._picture.image

    def at(self, x: float, y: float) -> int | None:
        """Return the index of the step at a place in pixels from the top left."""
        return self._picture.at(x, y) if self._picture is not None else None

    def press(self, glfw: Library, key: int) -> bool:
        """Take a key; return whether it is one of the list's."""
        last = len(self._rows) - 1
        boxes = self._picture.boxes if self._picture is not None else []
        column = sum(box[0] == boxes[0][0] for box in boxes) or 1
        to = {
            glfw.KEY_UP: self.chosen - 1,
            glfw.KEY_DOWN: self.chosen + 1,
            glfw.KEY_LEFT: self.chosen - column,
            glfw.KEY_RIGHT: self.chosen + column,
            glfw.KEY_PAGE_UP: self.chosen - column,
            glfw.KEY_PAGE_DOWN: self.chosen + column,
            glfw.KEY_HOME: 0,
            glfw.KEY_END: last,
        }
        if key in to:
            self.chosen, self._typed = min(max(to[key], 0), last), ""
        elif key == glfw.KEY_BACKSPACE:
            self._look_for(self._typed[:-1])
        else:
            return False

        return True

    def type(self, letter: str) -> None:
        """Take a letter that was typed."""
        if letter.isprintable():
            fresh = time.monotonic() - self._typed_at > TYPING
            self._look_for(letter if fresh else self._typed + letter)

    def _look_for(self, typed: str) -> None:
        """Choose the step of a number, or whose name or title begins so, or has it in it."""
        self._typed, self._typed_at = typed, time.monotonic()
        wanted = typed.strip().lower()
        rows = [(n.strip(), name.lower(), title.lower()) for n, title, name in self._rows]
        tests = (
            lambda row: row[0] == wanted,
            lambda row: row[1].startswith(wanted) or row[2].startswith(wanted),
            lambda row: wanted in row[1] or wanted in row[2],
        )
        for test in tests if wanted else ():
            found = next((index for index, row in enumerate(rows) if test(row)), None)
            if found is not None:
                self.chosen = found
                return
