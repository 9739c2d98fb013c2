"""Scenes whose camera may fly by itself, wherever the walker stands. No OpenGL here."""

from typing import Protocol, runtime_checkable

from landscape.frame import Pose


@runtime_checkable
class Flown(Protocol):
    """An open scene that may choose the camera's pose; it need not be one."""

    def eye(self, walker: Pose, kt: float) -> Pose:
        """Return from where the scene is seen at time ``kt``, while the walker's eye is there."""
