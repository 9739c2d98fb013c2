"""What a safeguard of the hall is: one that knows the hall's views."""

from dataclasses import dataclass

from landscape.hall.views import STANDING, VIEWS
from landscape.scene import safeguard
from landscape.scene.safeguard import pair

__all__ = ["Safeguard", "pair"]


@dataclass(frozen=True)
class Safeguard(safeguard.Safeguard):
    """One safeguard of the hall."""

    VIEWS = VIEWS
    STANDING = STANDING
