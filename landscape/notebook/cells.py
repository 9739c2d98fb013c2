"""Functions for notebooks: show a view or a program's frame, a lesson, the check of an exercise.

Each draws in a process of its own, so that nothing can end the notebook's kernel, and returns an
object that the notebook shows: with its picture as PNG, which stays in the file.
"""

import os
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

import numpy as np

from framelens.base import arguments
from framelens.base.errors import InputError, short
from framelens.base.texts import choose
from framelens.report.look import Look, look
from landscape.commands.target import ViewFrame
from landscape.course.ladder import lesson as find_lesson
from landscape.frame import SEED
from landscape.notebook.checking import check
from landscape.offscreen import Offscreen
from landscape.scene.scene import Scene, View, check_options, find_view
from landscape.settings import declare
from landscape.walk.recording import Plan

if TYPE_CHECKING:
    from landscape.notebook.live import LiveWalk

__all__ = ["check", "lesson", "show"]
SIZE = (640, 480)  # chosen: pixels of a picture in a cell


class ViewLook(Look):
    """A frame of a view. Its picture is drawn with antialiasing, and looked into without."""

    def _picture(self) -> np.ndarray:
        return self._asked(_still)


def _still(target: ViewFrame) -> tuple[np.ndarray, list[str]]:
    """Draw a view in this process; return its picture, and lines for the user."""
    with Offscreen(
        target.size or SIZE,
        preset=target.preset,
        settings=target.settings,
        backend=target.backend,
        only=target.only,
    ) as offscreen:
        offscreen.look(target.name)
        return offscreen.draw(), offscreen.notices


def show(
    view: str | os.PathLike[str],
    size: tuple[int, int] = SIZE,
    preset: str | None = None,
    settings: Mapping[str, object] | None = None,
    only: str | Iterable[str] | None = None,
    live: bool = False,
    backend: str = "auto",
    frame: int = 0,
    keys: str = "",
) -> "Look | LiveWalk":
    """Return a view, by its name, or a frame of a PyOpenGL program, by its path, to be looked into.

    ``size``, in pixels, ``preset``, ``settings`` and ``only`` are for a view, as of Offscreen;
    ``frame`` and ``keys`` for a program, as of framelens.look. A view that is ``live`` is walked in
    the cell, where jupyter_rfb is installed. InputError, NoOpenGLError.
    """
    name = os.fspath(view)
    if name.endswith(".py"):
        if preset is not None or settings or only is not None or live:
            raise InputError(
                "{name}: is a program; expected a view where preset, settings, only or live are "
                "given",
                name=short(name),
            )
        return look(name, frame, keys, backend=backend)

    kind, named = find_view(name)
    given = declare.flattened(settings or {})
    shown = None if only is None else arguments.names(only, "only")
    check_options(preset, given, shown)
    size = arguments.size(size)
    if live:
        from landscape.notebook.live import LiveWalk

        return LiveWalk(planned(kind, named, size, preset, given, shown), backend)
    return ViewLook(ViewFrame(name, size, backend, preset, given, shown))


def planned(
    kind: Scene,
    named: View,
    size: tuple[int, int],
    preset: str | None,
    given: Mapping[str, object],
    shown: Iterable[str] | None,
) -> Plan:
    """Return how a walk begins at a view."""
    begin = kind.as_walked(named, preset)
    preset = kind.preset_of(begin)
    return Plan(
        scene=kind.name,
        settings=kind.values(preset, begin.settings, given),
        view=begin.name,
        pose=begin.pose,
        size=size,
        kt=begin.kt,
        seed=SEED,
        only=kind.shown(begin, shown),
        wireframe=begin.wireframe,
        language=choose(os.environ),
        preset=preset,
    )


def lesson(
    name: str,
    keys: str | None = None,
    frame: int | None = None,
    size: tuple[int, int] | None = None,
    backend: str = "auto",
) -> Look:
    """Return a frame of a lesson, to be looked into.

    ``keys`` are pressed before it, by GLFW's names as in "S" or "LEFT LEFT SPACE"; without them,
    those of the lesson's own picture. ``frame`` counts from 0; by default it is that of its
    picture. ``size`` is the window's, in pixels. InputError, NoOpenGLError.
    """
    found = find_lesson(name)
    pressed = " ".join(found.pressed) if keys is None else keys
    resized = [] if size is None else [{"frame": 0, "resize": list(arguments.size(size))}]
    at = found.frame if frame is None else frame
    return look(found.file, at, pressed, resized, backend)
