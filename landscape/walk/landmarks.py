"""What there is to find on a walk, and which of it has been found.

The landmarks (scene/landmarks.py) stand where the scenes have them: in a view's pose, an element's
settings, a door. What has been found is kept in ``found.toml`` beside the preferences, for the next
walk. Nothing else depends on it: a recording neither reads nor changes it, and a replay has it as
messages of its frames. No OpenGL here.
"""

import json
import math
import os
import textwrap
import tomllib
from collections.abc import Collection
from pathlib import Path

from framelens.base.arguments import are_texts
from framelens.base.errors import InputError, Message
from framelens.base.input import read_bounded
from framelens.base.output import write_whole
from framelens.base.texts import said, translator
from landscape.scene.landmarks import FAR_SHORE, LANDMARKS, NAMES, Landmark
from landscape.scene.scene import Watery, scene
from landscape.settings import declare
from landscape.walk import words
from landscape.walk.place import Place
from landscape.walk.preferences import Said, folder, kept_aside
from landscape.walk.walker import Walker

FILE = "found.toml"
MOST_BYTES = 16 << 10  # chosen: many times what all names take
HEAD = Message(
    "What you have found on your walks through landscape; B in the walk lists it. A name that is "
    "deleted can be found again."
)
LOW = 1.0  # chosen: units above the ground up to which one who flies has come to what is below
SHORES = 6.0  # chosen: units, about 100 m, between a shore and one that is far from it
LEAP = 1.0  # chosen: units; who is that much further after a frame has not come on foot


def title_of(landmark: Landmark, language: str) -> str:
    """Return what a landmark is called: what the view shows, where it is one."""
    view = scene(landmark.scene).views.get(landmark.name)
    if view is None:
        return words.text(language, f"landmark.{landmark.name}")
    return translator(language, "gallery")(view.shows)


def place_of(landmark: Landmark, place: Place) -> tuple[float, float] | None:
    """Return its x and z in units in an open scene; None in another, or where it has none."""
    if place.kind.name != landmark.scene:
        return None
    view = place.kind.views.get(landmark.name)
    if view is not None:
        return view.pose.x, view.pose.z
    if landmark.name == "gate":
        return next(((door.x, door.z) for door in place.doors), None)
    if f"{landmark.name}.x" not in declare.fields(type(place.settings)):
        return None
    x, z = (declare.get(place.settings, f"{landmark.name}.{axis}") for axis in "xz")
    assert isinstance(x, int | float) and isinstance(z, int | float)
    return float(x), float(z)


class Found:
    """The names of the landmarks that have been found, and the file that keeps them, if any."""

    def __init__(self, names: Collection[str] = (), path: Path | None = None) -> None:
        """Begin with some names; without a ``path`` nothing is kept."""
        self.names = {name for name in NAMES if name in names}
        self._path = path

    @classmethod
    def read(cls) -> tuple["Found", list[Said]]:
        """Return what the user's file has, and what is to be said about it.

        A file that is no TOML, or has no list of names, is renamed: it is not written over.
        """
        place = folder()
        if place is None:
            return cls(), []
        path = place / FILE
        try:
            return cls(_names(path), path), []
        except (ValueError, RecursionError) as error:
            return cls((), path), [kept_aside(path, error)]
        except InputError as error:
            return cls(), [error]

    def add(self, name: str, language: str) -> Said | None:
        """Note that a landmark is found, and keep it; return what is to be said about the file.

        What another walk has found meanwhile is kept as well.
        """
        self.names.add(name)
        if self._path is None:
            return None
        damaged = None
        try:
            self.names |= set(_names(self._path)) & set(NAMES)
        except (ValueError, RecursionError) as error:
            damaged = kept_aside(self._path, error)
        except InputError as error:
            return error
        try:
            write_whole(self._path, written(self.names, language).encode())
        except InputError as error:
            return error
        return damaged


def _names(path: Path) -> list[str]:
    """Return the names in a file, none if there is no file; ValueError if it is damaged."""
    if not os.path.lexists(path):
        return []
    text = read_bounded(path, MOST_BYTES).decode("utf-8-sig")
    names = tomllib.loads(text).get("found", [])
    if not are_texts(names):
        raise ValueError("found: expected a list of names")
    return names


def written(names: Collection[str], language: str) -> str:
    """Return the file's text."""
    head = textwrap.wrap(said(HEAD, language), 98)
    kept = [name for name in NAMES if name in names]
    listed = "".join(f"    {json.dumps(name)},\n" for name in kept)
    return "".join(f"# {line}\n" for line in head) + f"found = [\n{listed}]\n"


class Search:
    """Follows a walker from frame to frame, and says what he comes to."""

    def __init__(self) -> None:
        """Nobody has walked yet."""
        self._shore: tuple[float, float] | None = None  # where he went into the water
        self._last: tuple[str, float, float] | None = None

    def reached(self, place: Place, walker: Walker) -> list[str]:
        """Return the names of the landmarks at which the walker stands."""
        at = walker.x, walker.z
        ground = float(place.scene.height(*at))
        low = walker.y < ground + place.settings.walk.eye + LOW
        found = [
            each.name
            for each in LANDMARKS
            if low
            and (where := place_of(each, place)) is not None
            and math.dist(where, at) < each.near
        ]
        return [*found, FAR_SHORE.name] if self._crossed(place, walker) else found

    def _crossed(self, place: Place, walker: Walker) -> bool:
        """Return whether the walker has come through water to a shore far from where he went in."""
        here = place.kind.name, walker.x, walker.z
        last, self._last = self._last, here
        leapt = last is None or last[0] != here[0] or math.dist(last[1:], here[1:]) > LEAP
        terrain = place.scene
        if leapt or walker.flying or here[0] != FAR_SHORE.scene or not isinstance(terrain, Watery):
            self._shore = None
            return False
        assert last is not None
        if float(terrain.depth(*here[1:])) > 0.0:
            if float(terrain.depth(*last[1:])) == 0.0:
                self._shore = last[1], last[2]
            return False
        shore, self._shore = self._shore, None
        return shore is not None and math.dist(shore, here[1:]) > SHORES
