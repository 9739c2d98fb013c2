"""Clips of named views: a moment in one of them, or a flight through several.

The flight's path keeps clear of ground and obstacles (geometry/camera_path.py). Its orientation is
SLERP between the views' own, with a level horizon: what roll SLERP would give is left out.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import ClassVar, Protocol, runtime_checkable

import numpy as np

from landscape.film.clip import Pictures
from landscape.film.stage import Stage
from landscape.frame import Pose
from landscape.geometry.camera_path import HOLD, Heights, Travel, through
from landscape.geometry.quaternion import from_angles, to_angles
from landscape.scene.scene import Moment, OpenScene, SceneSettings, placed, raised, scene
from landscape.sound.score import Heard
from landscape.sound.soundscape import Ear

FLIGHT = 2.0  # chosen: times the walking speed; as fast as one flies in a walk
TURNING = 28.0  # chosen: degrees per second, the mean that sets how long a turn takes
LEAST = 2.5  # chosen: seconds from one view to the next
FAST_ENOUGH = 14.0  # chosen: the most seconds that takes


@dataclass(frozen=True)
class Look:
    """How a scene is looked at: its name, settings, elements, and animation time at the start."""

    scene: str
    values: SceneSettings
    shown: tuple[str, ...]
    kt: float = 0.0
    wireframe: bool = False
    stroke: int = 0

    def open(self, stage: Stage) -> OpenScene:
        """Return the scene, open on a stage."""
        return stage.scene(self.scene, self.values, self.shown)

    def draw(self, stage: Stage, pose: Pose, seconds: float) -> np.ndarray:
        """Return the picture from a pose, so many seconds after the start."""
        kt = self.kt + seconds * self.values.clock.kt_per_second
        moment = Moment(pose, stage.size, kt, 0.0, self.stroke, self.wireframe)
        return stage.draw(self.open(stage), moment)

    def hearing(self, opened: OpenScene) -> Callable[[Pose, float], Heard]:
        """Return what there is to hear from a pose in the open scene, by seconds, as of draw."""
        soundscape = scene(self.scene).sounds(self.values, opened)

        def heard(pose: Pose, seconds: float) -> Heard:
            kt = self.kt + seconds * self.values.clock.kt_per_second
            assert pose.y is not None
            ear = Ear(pose.x, pose.y, pose.z, pose.yaw, kt)
            return Heard(soundscape, ear, volume=self.values.sound.volume)

        return heard


@runtime_checkable
class Roofed(Protocol):
    """An open scene that knows what stands on its ground by its height, not as obstacles."""

    def roof(self, x: float, z: float) -> float:
        """Return the height in units of what is highest at x, z."""


def roof(opened: OpenScene) -> Heights:
    """Return the heights of a scene that a camera stays above."""
    return opened.roof if isinstance(opened, Roofed) else opened.height


def standing(pose: Pose, opened: OpenScene) -> Pose:
    """Return a view's pose in an open scene: with a height, and above the ground."""
    eye = opened.settings.walk.eye
    return raised(placed(pose, opened, eye), opened, eye)


@dataclass(frozen=True)
class Still:
    """A moment: the camera stands, and time runs."""

    look: Look
    pose: Pose
    seconds: float

    needs_opengl: ClassVar[bool] = True

    def lasting(self, seconds: float) -> "Still":
        """Return it as long as this."""
        return replace(self, seconds=seconds)

    def open(self, stage: Stage) -> Pictures:
        """Return what draws it."""
        pose = standing(self.pose, self.look.open(stage))
        return lambda seconds: self.look.draw(stage, pose, seconds)

    def listen(self, stage: Stage) -> Callable[[float], Heard]:
        """Return what there is to hear there."""
        opened = self.look.open(stage)
        heard, pose = self.look.hearing(opened), standing(self.pose, opened)
        return lambda seconds: heard(pose, seconds)


@dataclass(frozen=True)
class Flight:
    """A flight through two or more poses of one scene, ``spans`` seconds from each to the next."""

    look: Look
    poses: tuple[Pose, ...]
    spans: tuple[float, ...]
    seconds: float = field(init=False)

    needs_opengl: ClassVar[bool] = True

    def __post_init__(self) -> None:
        """Know how long it is before anything is opened."""
        object.__setattr__(self, "seconds", sum(self.spans) + 2 * HOLD)

    def lasting(self, seconds: float) -> "Flight":
        """Return it as long as this, but for its rests at both ends if that is too short."""
        factor = max(seconds - 2 * HOLD, 0.05) / sum(self.spans)
        return Flight(self.look, self.poses, tuple(factor * span for span in self.spans))

    def travel(self, opened: OpenScene) -> Travel:
        """Return the camera's travel in an open scene."""
        poses = [standing(pose, opened) for pose in self.poses]
        places = np.array([(pose.x, pose.y, pose.z) for pose in poses])
        path = through(places, roof(opened), opened.obstacles)
        turns = [from_angles(pose.yaw, pose.pitch, pose.roll) for pose in poses]
        return Travel(path, turns, np.array(self.spans))

    def open(self, stage: Stage) -> Pictures:
        """Return what draws it."""
        travel = self.travel(self.look.open(stage))
        return lambda seconds: self.look.draw(stage, posed(travel, seconds), seconds)

    def listen(self, stage: Stage) -> Callable[[float], Heard]:
        """Return what there is to hear on the way."""
        opened = self.look.open(stage)
        heard, travel = self.look.hearing(opened), self.travel(opened)
        return lambda seconds: heard(posed(travel, seconds), seconds)


def posed(travel: Travel, seconds: float) -> Pose:
    """Return the camera's pose on its way, with a level horizon."""
    (x, y, z), turn = travel.at(seconds)
    yaw, pitch, _ = to_angles(turn)
    return Pose(float(x), float(y), float(z), yaw, pitch)


def spans(poses: tuple[Pose, ...], speed: float) -> tuple[float, ...]:
    """Return how many seconds a flight takes from each pose to the next, at a walk's speed."""
    found = []
    for here, there in zip(poses, poses[1:], strict=False):
        away = math.hypot(there.x - here.x, there.z - here.z)
        if here.y is not None and there.y is not None:
            away = math.hypot(away, there.y - here.y)
        turn = abs((there.yaw - here.yaw + 180.0) % 360.0 - 180.0)
        seconds = max(away / max(FLIGHT * speed, 1e-3), turn / TURNING, LEAST)
        found.append(min(seconds, FAST_ENOUGH))
    return tuple(found)
