"""Digging and building in a walk: how often a held button acts, the bar, the file of the world."""

from collections.abc import Callable, Collection, Hashable
from pathlib import Path
from typing import NoReturn

import numpy as np

from framelens.base.errors import InputError, reason
from framelens.base.output import check_writable, next_free, write_whole
from framelens.base.texts import said, translator
from framelens.system import locked
from landscape.geometry.digging import Diggable, read_world
from landscape.walk import words
from landscape.walk.recording import Tick
from landscape.walk.walker import Intent, Walker

# Chosen: seconds from a press to its first repetition, and between two repetitions.
FIRST, AGAIN = 0.35, 0.2
AUTOSAVE = 30.0  # chosen: seconds after a change until it is saved
SLOTS = tuple(f"slot_{n}" for n in range(1, 10))
SWITCHES = (*SLOTS, "next_slot", "previous_slot")


class WorldFile:
    """The file that keeps what a walker changes; it is written whole or not at all.

    Other walks may have the same file: what they save in the meantime is kept.
    """

    def __init__(self, path: Path, keep: bool = True) -> None:
        """Read the file if there is one; InputError. Only with ``keep`` is it written later."""
        self._path, self._keep = path, keep
        self._saved = b""  # the scene as it was when it was opened, or saved last
        self._saved_changes = False  # whether that has any
        if keep:
            check_writable(path, "world ")
        self._content = self._read()
        if self._content is None and not keep:
            self._content = read_world(path)

    @property
    def _name(self) -> str:
        return f"world {self._path}"

    def _read(self) -> bytes | None:
        """Return the content of the file; None if there is none."""
        return read_world(self._path) if self._path.exists() else None

    def opened(self, scene: Diggable | None) -> Diggable:
        """Change a scene that has been opened as the file says, and return it; InputError."""
        if scene is None:
            raise InputError(
                "world {path}: expected a scene of blocks, such as voxel", path=self._path
            )
        if self._content is not None:
            scene.restore(self._content, self._name)
        self._saved, self._saved_changes = scene.saved(), scene.is_changed
        return scene

    def save(self, scene: Diggable) -> bool:
        """Write the file if there is anything new; InputError if that is impossible.

        If another walk has changed the same blocks, this one is saved in a file of another name,
        which the InputError tells.
        """
        if not self._keep or not (scene.is_changed or self._saved_changes):
            return False
        data = scene.saved()
        if data == self._saved:
            return False
        try:
            with locked(self._path):
                self._write(scene, data)
        except TimeoutError:
            raise InputError("{name}: is being saved by another walk", name=self._name) from None
        except OSError as error:  # its folder is gone
            raise InputError(
                "{name}: cannot be written ({reason})", name=self._name, reason=reason(error)
            ) from None
        self._saved_changes = scene.is_changed
        return True

    def _write(self, scene: Diggable, data: bytes) -> None:
        """Write the scene's ``data``, with what other walks have saved in the meantime."""
        content, theirs = data, None
        try:
            theirs = self._read()
            if theirs is not None and theirs != self._content:
                content = scene.merged(self._saved, theirs, self._name)
        except InputError as error:
            self._keep_beside(data, error)
        write_whole(self._path, content)
        self._content, self._saved = content, data

    def _keep_beside(self, data: bytes, error: InputError) -> NoReturn:
        """Save the scene in a new file, to which the walk keeps from now on; InputError."""
        other = next_free(self._path.stem, self._path.suffix, self._path.parent)
        write_whole(other, data)
        former = self._path
        self._path = other
        self._content = self._saved = data
        raise InputError(
            "{error}; {former} stays as it is, and this walk is saved in {other}",
            error=error,
            former=former,
            other=other,
        ) from None


class Builder:
    """The walker's work with blocks, in scenes that have any."""

    def __init__(self, file: WorldFile | None, language: str) -> None:
        """``file`` is where changes are kept, if anywhere."""
        self._file, self._language = file, language
        self._waits = {"dig": 0.0, "place": 0.0}
        self._scene: Diggable | None = None
        self._changes, self._unsaved = 0, 0.0
        self.changed = {"dig": 0, "place": 0}  # how often blocks were changed by either tool

    def opened(self, land: Diggable | None) -> None:
        """Take note of the scene in which the walk begins; InputError if the file does not fit."""
        if self._file is not None:
            self._scene = self._file.opened(land)

    def switches(self, land: Diggable | None, names: tuple[str, ...]) -> tuple[str, ...]:
        """Return switches as a scene understands them: in one of blocks, digits choose a slot."""
        if land is None:
            return tuple(name for name in names if name not in SWITCHES)
        return tuple(f"slot_{name}" if name.isdigit() else name for name in names)

    def switch(self, land: Diggable | None, name: str) -> None:
        """Choose a slot."""
        if land is not None:
            steps = {"next_slot": land.slot + 1, "previous_slot": land.slot - 1}
            land.choose(SLOTS.index(name) if name in SLOTS else steps[name])

    def advance(self, land: Diggable | None, walker: Walker, tick: Tick) -> str:
        """Dig, place and pick what is asked for in a frame; return what to say, or ""."""
        said = ""
        if land is not None:
            for tool in self._due(tick.intent, tick.seconds):
                before = land.changes
                refused = land.use(tool, walker.pose, walker.body)
                if tool in self.changed:
                    self.changed[tool] += land.changes != before
                said = translator(self._language, "scenes")(refused) if refused else said
        return said

    def _due(self, intent: Intent, seconds: float) -> list[str]:
        """Return the tools to use now: those clicked, and those held long enough."""
        due = ["pick"] if intent.pick else []
        for tool, clicked, held in (
            ("dig", intent.dig, intent.digging),
            ("place", intent.place, intent.placing),
        ):
            self._waits[tool] -= seconds
            if clicked or (held and self._waits[tool] <= 0.0):
                self._waits[tool] = FIRST if clicked else AGAIN
                due.append(tool)
        return due

    def saved(self, land: Diggable | None, seconds: float) -> str:
        """Save some time after a change, a frame of so many seconds later; return what to say.

        A replay saves nothing, so it can say this only if it is in the recording.
        """
        if self._file is None or land is None:
            return ""
        self._scene = land
        if land.changes != self._changes:
            self._changes, self._unsaved = land.changes, self._unsaved or 1e-9
        if self._unsaved:
            self._unsaved += seconds
        return self._save() if self._unsaved > AUTOSAVE else ""

    def save(self, land: Diggable | None) -> str:
        """Save the world, as the user asks for; return what to say of it."""
        if land is None:
            return words.text(self._language, "world.none")
        if self._file is None:
            return words.text(self._language, "world.no_file")
        return self._save() or words.text(self._language, "world.unchanged")

    def _save(self) -> str:
        """Save the world if there is anything new; return what to say of it, or ""."""
        self._unsaved = 0.0
        try:
            done = self._file and self._scene and self._file.save(self._scene)
        except InputError as error:
            return said(error, self._language)
        return words.text(self._language, "world.saved") if done else ""

    def covered(self, land: Diggable | None, size: tuple[int, int]) -> int:
        """Return how many rows at a window's lower edge show something that no message may hide."""
        return land.covered(size) if land is not None else 0

    def leave(self) -> None:
        """Save the world at the end of the walk; InputError if that is impossible."""
        scene, self._scene = self._scene, None
        if self._file is not None and scene is not None:
            self._file.save(scene)

    def bar(
        self, land: Diggable | None, elements: Collection[str], size: tuple[int, int]
    ) -> tuple[Hashable, Callable[[], np.ndarray]] | None:
        """Return the picture of the bar for a window: what it depends on, and how to make it.

        None unless the crosshair is among the ``elements`` that are shown.
        """
        if land is None or "crosshair" not in elements:
            return None
        shows, make = land.bar(size[1], self._language)
        return (shows, size), make
