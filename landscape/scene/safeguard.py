"""Pairs of pictures, without something and with it: settings, pose and captions.

Each scene that has some derives a class of its own, which knows the scene's views.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from landscape.frame import Pose
from landscape.scene.scene import View
from landscape.settings.declare import Value


@dataclass(frozen=True)
class Comparison:
    """Two pictures: where to see them, the settings without and with something, and captions.

    ``view`` is a pose, or the name of the view whose pose to take. ``flaw`` says what goes wrong
    without it, ``look`` what to compare, ``how`` what changes in OpenGL; ``seen`` describes the two
    pictures for readers who cannot see them.
    """

    name: str
    title: str
    view: str | Pose
    kt: float
    off: Mapping[str, Value]
    on: Mapping[str, Value]
    flaw: str
    look: str
    how: str
    seen: tuple[str, str]


@dataclass(frozen=True)
class Safeguard(Comparison):
    """A picture without a safeguard of a scene, and one with it."""

    VIEWS: ClassVar[Mapping[str, View]] = {}
    STANDING: ClassVar[tuple[str, ...]] = ()
    """The names of the elements that both pictures show."""

    def settings(self, after: bool) -> Mapping[str, Value]:
        """Return the settings of one picture: without the safeguard, or with it."""
        return self.on if after else self.off

    def pose(self, after: bool) -> Pose:
        """Return the pose of both pictures; its y may be None."""
        return self.VIEWS[self.view].pose if isinstance(self.view, str) else self.view

    def as_view(self) -> View:
        """Return the view with the safeguard, under its name."""
        return View(
            self.name, self.title, self.pose(True), self.kt, shown=self.STANDING, settings=self.on
        )


def pair(key: str, **beside: Mapping[str, Value]) -> dict[str, dict[str, Value]]:
    """Return the settings without and with a safeguard; groups of ``beside`` hold others."""
    others = {f"{group}.{k}": v for group, values in beside.items() for k, v in values.items()}
    return {"off": {**others, key: False}, "on": {**others, key: True}}
