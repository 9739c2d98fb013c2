"""The list of landmarks in the walk (B): which have been found, where the others are. No OpenGL.

Enter opens what has been found: the text of its lesson, which comes with the program, so that it
can be read without a network; Enter once more runs the lesson in a window of its own.
"""

import math
from collections.abc import Callable, Sequence

from framelens.inspector.keys import us_name
from landscape.scene.landmarks import LANDMARKS, Landmark
from landscape.sound.captions import arrow
from landscape.walk import words
from landscape.walk.keys import pick
from landscape.walk.landmarks import Found, place_of, title_of
from landscape.walk.place import Place
from landscape.walk.settings_list import Line, Page
from landscape.walk.walker import Walker

Teller = Callable[[str, str], Sequence[str]]
"""From a lesson's name and a language to its title and paragraphs."""

METRES = 17.0  # a unit: a walker's eye is 0.1 high
ROUNDED = 10  # metres to which a distance is rounded
FOUND = "✓"


def nothing_told(lesson: str, language: str) -> Sequence[str]:
    """Return a lesson's name alone, where no texts of lessons are at hand."""
    return (lesson,)


class LandmarksList:
    """The landmarks, which row is chosen, and whether the list, or what is found, is open."""

    def __init__(self, found: Found, tells: Teller = nothing_told) -> None:
        """Begin with the first row of a list that is shut; ``tells`` has the lessons' texts."""
        self.found, self._tells = found, tells
        self.open = self.reading = False
        self.index = 0
        self.asked = ""  # a lesson that is to be run

    @property
    def row(self) -> Landmark:
        """The chosen landmark."""
        return LANDMARKS[self.index]

    def toggle(self) -> None:
        """Open or shut the list."""
        self.open, self.reading = not self.open, False

    def key(self, key: int) -> None:
        """Carry out a key that was pressed while the list was open."""
        picked = pick(key, us_name)
        if picked == "list":  # Escape
            self.back()
        elif picked == "switch":
            self.choose()
        elif picked in ("up", "down") and not self.reading:
            self.index = (self.index + (1 if picked == "down" else -1)) % len(LANDMARKS)
        elif picked in ("first", "last") and not self.reading:
            self.index = 0 if picked == "first" else len(LANDMARKS) - 1

    def back(self) -> None:
        """Leave what is read, or the list."""
        if self.reading:
            self.reading = False
        else:
            self.toggle()

    def choose(self) -> None:
        """Open what is found at the chosen row; if it is open, ask for its lesson."""
        if self.reading:
            self.asked = self.row.lesson
        elif self.row.name in self.found.names:
            self.reading = True

    def point(self, line: int) -> None:
        """Choose the row in a line of the page, if there is one."""
        row = next((k for k, at in enumerate(_lines()) if at == line), None)
        if row is not None and not self.reading:
            self.index = row

    def page(self, language: str, place: Place, walker: Walker) -> Page:
        """Return what the list shows to a walker in an open scene."""
        lines, group = [], ""
        for landmark in LANDMARKS:
            if landmark.scene != group:
                group = landmark.scene
                lines.append(Line(words.text(language, f"title.{group}")))
            here = landmark is self.row
            value = FOUND if landmark.name in self.found.names else way(landmark, place, walker)
            lines.append(Line(title_of(landmark, language), value or "–", "", here))

        known = self.row.name in self.found.names
        ways = "landmarks.read" if known else "landmarks.unknown"
        below = words.text(language, ways), words.text(language, "landmarks.leave")
        count = f"{len(self.found.names)}/{len(LANDMARKS)}"
        return Page(f"{words.text(language, 'landmarks.title')}  {count}", tuple(lines), below)

    def text(self, language: str) -> tuple[str, ...]:
        """Return what is read: a title, paragraphs, and which keys lead on."""
        texts = told(self.row, language, self._tells)
        return (*texts, words.text(language, "landmarks.run"))


def told(landmark: Landmark, language: str, tells: Teller) -> tuple[str, ...]:
    """Return a landmark's title, and the title and the paragraphs of its lesson."""
    return title_of(landmark, language), *tells(landmark.lesson, language)


def way(landmark: Landmark, place: Place, walker: Walker) -> str:
    """Return an arrow to a landmark and how far it is, "" if that is not known."""
    at = place_of(landmark, place)
    if at is None:
        return ""
    dx, dz = at[0] - walker.x, at[1] - walker.z
    metres = METRES * math.hypot(dx, dz)
    bearing = math.degrees(math.atan2(dx, -dz))
    return f"{arrow((bearing - walker.yaw) % 360.0)} {ROUNDED * max(round(metres / ROUNDED), 1)} m"


def _lines() -> list[int]:
    """Return the line of each landmark in the page: each scene's begin below a heading."""
    scenes = [landmark.scene for landmark in LANDMARKS]
    return [k + len(set(scenes[: k + 1])) for k in range(len(scenes))]
