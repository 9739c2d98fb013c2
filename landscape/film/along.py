"""Clips along a path drawn in Inkscape: over the map of a scene, or by the software fly-over.

Where the camera is and where it looks is up to :mod:`landscape.flyover`. Over a scene it flies at
twice the height of a walker's eyes, and over what stands there (geometry/roofs.py).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar

import numpy as np

from landscape.film.clip import Pictures
from landscape.film.stage import Stage
from landscape.film.views import Look
from landscape.flyover.environment import Environment
from landscape.flyover.flight import Flight
from landscape.flyover.frame import draw
from landscape.flyover.height_field import HeightField
from landscape.flyover.scene_flight import SceneFlight
from landscape.flyover.settings import Settings
from landscape.frame import Pose
from landscape.geometry.roofs import Roofs
from landscape.scene.scene import OpenScene
from landscape.sound.score import Heard

EYES_UP = 2.0  # chosen: heights of a walker's eye above the ground


@dataclass(frozen=True)
class Along:
    """A flight over a scene; it takes as long as over the drawing's own terrain, or ``seconds``."""

    environment: Environment
    look: Look
    seconds: float
    speed: float

    needs_opengl: ClassVar[bool] = True

    def open(self, stage: Stage) -> Pictures:
        """Return what draws it."""
        pose = self._way(self.look.open(stage))
        return lambda seconds: self.look.draw(stage, pose(seconds), seconds)

    def listen(self, stage: Stage) -> Callable[[float], Heard]:
        """Return what there is to hear on the way."""
        opened = self.look.open(stage)
        heard, pose = self.look.hearing(opened), self._way(opened)
        return lambda seconds: heard(pose(seconds), seconds)

    def _way(self, opened: OpenScene) -> Callable[[float], Pose]:
        """Return the camera's pose by seconds."""
        eye = EYES_UP * opened.settings.walk.eye
        settings = replace(Settings().flyover, speed=self.speed)
        flight = SceneFlight(self.environment, Roofs(opened), eye, settings)
        # At the very end it would begin again.
        last = math.nextafter(flight.duration, 0.0)
        return lambda seconds: flight.pose(min(seconds, last))


@dataclass(frozen=True)
class Software:
    """A flight of the software fly-over, without OpenGL, from ``begin`` seconds after its start."""

    environment: Environment
    settings: Settings
    seconds: float
    begin: float = 0.0

    needs_opengl: ClassVar[bool] = False

    @cached_property
    def flight(self) -> tuple[HeightField, Flight]:
        """The terrain, and the flight over it."""
        field = self.environment.field(self.settings.flyover)
        return field, self.environment.flight(field, self.settings.flyover)

    def open(self, stage: Stage) -> Pictures:
        """Return what draws it."""
        field, flight = self.flight

        def picture(seconds: float) -> np.ndarray:
            at = min(self.begin + seconds, math.nextafter(flight.duration, 0.0))
            return draw(field, flight.camera(at), self.settings, stage.size).picture

        return picture
