"""Doors: strips on the ground through which one walks into another scene. No OpenGL."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

from landscape.frame import Pose
from landscape.geometry.obstacles import RADIUS

REACH = RADIUS + 0.02  # chosen: units, depth of the strip; whatever fills the door stops a walker
STEEP = 0.5  # chosen: least cosine between the walker's way and the door's
BEFORE = 0.16  # chosen: units from the door at which one comes out of it
SEEN_FROM = 0.55  # chosen: units within which one stands before a door
LED_FROM = 0.36  # chosen: units beside its middle from which one who walks at the wall is led to it


@dataclass(frozen=True)
class Door:
    """A door between two scenes; the other one has a door, too, which leads back.

    ``x`` and ``z`` are the middle of its threshold in units, ``yaw`` the direction in degrees of
    those who go in, ``half`` half its width, ``bottom`` and ``top`` the heights between which an
    eye passes. ``scene`` is the name of the scene behind it, ``to`` the name of the door there by
    which one comes out. ``says`` is what someone who stands before it is told, in English. One
    comes out by a door even if it is not ``open``.
    """

    name: str
    x: float
    z: float
    yaw: float
    half: float
    bottom: float
    top: float
    scene: str
    to: str
    says: str
    open: bool = True

    def local(self, x: float, z: float) -> tuple[float, float]:
        """Return how far a place is to the right of the door's middle, and how far in front."""
        s, c = math.sin(math.radians(self.yaw)), math.cos(math.radians(self.yaw))
        dx, dz = x - self.x, z - self.z
        return dx * c + dz * s, -dx * s + dz * c

    def entered(self, at: tuple[float, float, float], way: float) -> bool:
        """Return whether one at x, y, z who walks in the direction ``way``, degrees, goes in."""
        right, front = self.local(at[0], at[2])
        inside = abs(right) < self.half and 0 <= front < REACH and self.bottom < at[1] < self.top
        return self.open and inside and math.cos(math.radians(way - self.yaw)) > STEEP

    def aside(self, at: tuple[float, float, float], way: float) -> float:
        """Return how far to the left of one who walks at the wall beside the door its middle is.

        In units; 0 where he does not walk at that wall, or the door is not open.
        """
        right, front = self.local(at[0], at[2])
        near = 0 <= front < REACH and abs(right) < LED_FROM and self.bottom < at[1] < self.top
        led = self.open and near and math.cos(math.radians(way - self.yaw)) > STEEP
        return right if led else 0.0

    def faced(self, pose: Pose) -> bool:
        """Return whether one stands before the door and looks at it."""
        assert pose.y is not None
        right, front = self.local(pose.x, pose.z)
        near = 0 <= front < SEEN_FROM and abs(right) < SEEN_FROM and pose.y > self.bottom
        return near and math.cos(math.radians(pose.yaw - self.yaw)) > STEEP and pose.y < self.top

    @property
    def way_out(self) -> Pose:
        """Where one stands who has come out of the door, with his back to it."""
        return self.left_by(0.0)

    def left_by(self, way: float) -> Pose:
        """Where one stands who has come out of the door, and goes on ``way`` degrees to his right.

        Whoever goes in backwards (180) comes out backwards, too, and not in again.
        """
        s, c = math.sin(math.radians(self.yaw)), math.cos(math.radians(self.yaw))
        x, z = self.x - BEFORE * s, self.z + BEFORE * c
        return Pose(x, None, z, (self.yaw + 180.0 - way) % 360.0, 0.0)


@runtime_checkable
class Doored(Protocol):
    """A scene with doors; an open scene need not have any."""

    @property
    def doors(self) -> Sequence[Door]:
        """The doors as they are now."""
