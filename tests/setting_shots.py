"""Where a setting of the hall or the voxel island shows: its view, drawn without and with it."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from other_values import another

from framelens.gl.seam import recording
from landscape.frame import Pose
from landscape.offscreen import Offscreen
from landscape.scene.scene import Scene
from landscape.settings.declare import fields, get, with_settings

SIZE = (160, 120)
LEAST = 3  # levels of 255: less may be the rounding of colours


@dataclass(frozen=True)
class Shot:
    """Where a setting shows: the view, settings beside it, its other value, the animation time.

    ``only`` names the elements that are drawn, all of the view's if it is empty. What a walker
    holds is in no view, but may be drawn from a pose.
    """

    view: str | Pose
    settings: dict[str, Any] = field(default_factory=dict)
    value: Any = None
    kt: float | None = None
    only: tuple[str, ...] = ()


def in_order(keys: Iterable[str], shots: Mapping[str, Shot]) -> list[str]:
    """Return keys, those side by side whose shots share a view and its settings."""
    return sorted(keys, key=lambda key: repr(shots.get(key)))


Drawing = tuple[np.ndarray, list[str]]


class Studio:
    """A scene as it was opened last: shots that follow each other share it.

    ``base`` are settings of every shot, such as those of a smaller scene.
    """

    def __init__(self, scene: Scene, base: Mapping[str, Any]) -> None:
        self.scene = scene
        self.keys = fields(type(scene.settings))
        self.base = dict(base)
        self._opened: tuple[object, Offscreen] | None = None

    def opened(self, shot: Shot) -> Offscreen:
        """Return the scene in a shot's view."""
        wanted = shot.view, repr(shot.settings), shot.only
        if self._opened is None or self._opened[0] != wanted:
            self.close()
            self._opened = wanted, self._open(shot, {})
        return self._opened[1]

    def _open(self, shot: Shot, changes: Mapping[str, Any]) -> Offscreen:
        settings = self.base | shot.settings | changes
        place, only = self.scene.name, shot.only or None
        view = Offscreen(SIZE, samples=0, settings=settings, place=place, only=only)
        view.look(shot.view)
        return view

    def both(self, key: str, shot: Shot) -> tuple[Drawing, Drawing]:
        """Return a shot's picture and calls, without and with another value of a key."""
        view = self.opened(shot)
        assert view.scene is not None
        settings = view.scene.settings
        value = shot.value
        if value is None or value == get(settings, key):
            value = another(key, self.keys[key], get(settings, key))

        before = drawn(view, shot.kt)
        # The eye's height is the pose's, for which the view is asked again.
        if key != "walk.eye" and view.scene.apply(with_settings(settings, {key: value})):
            after = drawn(view, shot.kt)
            assert view.scene.apply(settings)
            return before, after
        other = self._open(shot, {key: value})
        try:
            return before, drawn(other, shot.kt)
        finally:
            other.close()

    def close(self) -> None:
        """Close the scene; may be called twice."""
        if self._opened is not None:
            self._opened[1].close()
            self._opened = None


def drawn(view: Offscreen, kt: float | None) -> Drawing:
    """Return the second of two pictures, and its calls: names and arguments."""
    view.draw(kt)
    with recording() as recorder:
        picture = view.draw(kt)
    # How often OpenGL is asked whether a query is answered depends on when it is.
    lasting = [call for call in recorder.calls if not call.name.startswith("glGetQueryObject")]
    # Another list of the same calls has another number.
    listed = [(call.name, "" if call.name == "glCallList" else call.args) for call in lasting]
    return picture.astype(int), [f"{name}{args}" for name, args in listed]


def change(both: tuple[Drawing, Drawing]) -> int:
    """Return by how many levels two pictures differ at most."""
    (before, _), (after, _) = both
    return int(np.abs(before - after).max())
