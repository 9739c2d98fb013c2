"""The same flight over any scene: an environment's path, laid over the scene's map.

The image covers the whole map, its top to the north. The camera goes along the path at the height
of a walker's eyes above what the walker stands on, and turns to the same points. Flying takes as
long as over the environment's own terrain, however large the scene is.
"""

import math
from dataclasses import replace
from typing import Protocol, SupportsFloat

import numpy as np

from landscape.flyover.environment import Environment
from landscape.flyover.flight import Flight
from landscape.flyover.settings import Flyover
from landscape.frame import Pose


class Map(Protocol):
    """A square of ``size`` units from (0, 0) to (size, size), and the heights to stand on."""

    @property
    def size(self) -> float:
        """The side of the square in units."""

    def height(self, x: float, z: float) -> SupportsFloat:
        """Return the height in units at x, z."""


class SceneFlight:
    """A camera in a scene as a function of time."""

    def __init__(
        self, environment: Environment, terrain: Map, eye: float, settings: Flyover
    ) -> None:
        """Plan the flight; ``eye`` is the distance above the ground, in the scene's units."""
        # The flight is planned in pixels of the image, of which each is `scale` of the scene.
        self._scale = terrain.size / environment.side
        self._terrain = terrain
        self._flight = Flight(
            environment.path,
            environment.targets,
            self._ground,
            replace(settings, height=eye / self._scale),
        )
        self.duration = self._flight.duration

    def _ground(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        last, scale = self._terrain.size, self._scale
        places = zip(np.ravel(x), np.ravel(y), strict=True)
        heights = [
            float(self._terrain.height(min(float(u) * scale, last), min(float(v) * scale, last)))
            for u, v in places
        ]
        return np.reshape(heights, np.shape(x)) / scale

    def pose(self, time_s: float) -> Pose:
        """Return where the camera is at a time in seconds; after ``duration`` it begins again."""
        camera = self._flight.camera(time_s)
        # The image's x goes east and its y south; a camera of angle 0 looks east, 90 degrees.
        x, y, z = (each * self._scale for each in (camera.x, camera.z, camera.y))
        yaw, pitch = math.degrees(camera.theta_z) + 90.0, -math.degrees(camera.theta_y)
        return Pose(x, y, z, math.remainder(yaw, 360.0), pitch)
