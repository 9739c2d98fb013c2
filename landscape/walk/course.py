"""A walk that begins with a flight along a path drawn in Inkscape (flyover/scene_flight.py).

The walker is carried along, and looks at the drawing's points. A step of his own ends the flight,
and he flies on from there as he likes.
"""

from dataclasses import replace

from landscape.flyover.environment import Environment
from landscape.flyover.scene_flight import SceneFlight
from landscape.flyover.settings import Flyover
from landscape.geometry.roofs import Roofs
from landscape.scene.scene import SceneSettings, Terrain
from landscape.walk import words
from landscape.walk.recording import Tick
from landscape.walk.walker import Intent, Walker


class Course:
    """The walker's way along the path of an environment, frame by frame."""

    def __init__(
        self, environment: Environment, terrain: Terrain, settings: SceneSettings, language: str
    ) -> None:
        """Plan the flight over an open scene and what stands there, at eye height."""
        self._flight = SceneFlight(environment, Roofs(terrain), settings.walk.eye, Flyover())
        self._seconds = 0.0
        self._flown = True
        self._language = language
        self._says = "path"

    def take(self, tick: Tick) -> Tick:
        """Return a frame's input as it counts on the way; a step ends the flight."""
        asked = tick.intent
        if self._flown and (asked.forward or asked.right or asked.up or asked.fly):
            self._flown, self._says = False, "path.left"
            tick = replace(tick, intent=replace(asked, fly=False))
        elif self._flown:
            tick = replace(tick, intent=Intent())
        says, self._says = self._says, ""
        note = words.text(self._language, says) if says else ""
        return replace(tick, note=tick.note or note)

    def carried(self, walker: Walker, seconds: float) -> Walker:
        """Return the walker on his way, ``seconds`` further; as he is, once he has left it."""
        if not self._flown:
            return walker
        pose = self._flight.pose(self._seconds)
        self._seconds += seconds
        assert pose.y is not None
        # Without a body: where that stood when he came, it does not matter any more.
        return Walker(pose.x, pose.y, pose.z, pose.yaw, pose.pitch, flying=True)
