"""A safeguard of the voxel island: one that knows the island's views."""

from dataclasses import dataclass

from landscape.scene import safeguard
from landscape.scene.safeguard import pair
from landscape.voxel.views import STANDING, VIEWS

__all__ = ["Safeguard", "pair"]


@dataclass(frozen=True)
class Safeguard(safeguard.Safeguard):
    """One safeguard of the voxel island."""

    VIEWS = VIEWS
    STANDING = STANDING
