"""A walker's body, for scenes in which it meets solid things in all directions. No OpenGL.

On the island a walker is an eye above the ground. In a scene that is :class:`Embodied` he has a
body, which falls, jumps, climbs steps and keeps out of what is solid.
"""

from dataclasses import dataclass, replace
from typing import Protocol, runtime_checkable


@dataclass(frozen=True)
class Body:
    """Where a body stands: the middle between its feet, in units or in blocks; and its state.

    ``rising`` is its speed upwards per second. ``lag`` is how far the eye is still below its place
    over the feet after a step up (above it, if negative, after a step down). ``grounded`` says that
    it stands on something, ``swimming`` that the water is too deep for that.
    """

    x: float
    y: float
    z: float
    rising: float = 0.0
    lag: float = 0.0
    grounded: bool = False
    swimming: bool = False

    def scaled(self, by: float) -> "Body":
        """Return the body in other units of length."""
        lengths = self.x * by, self.y * by, self.z * by, self.rising * by, self.lag * by
        return replace(
            self, x=lengths[0], y=lengths[1], z=lengths[2], rising=lengths[3], lag=lengths[4]
        )


@dataclass(frozen=True)
class Wish:
    """Where a body wants to go: its velocity east, up and south per second; to jump, dive or fly.

    ``eye`` is the height of its eye above its feet, which says how large it is.
    """

    east: float
    up: float
    south: float
    jump: bool
    flying: bool
    eye: float
    dive: bool = False

    def scaled(self, by: float) -> "Wish":
        """Return the wish in other units of length."""
        lengths = self.east * by, self.up * by, self.south * by, self.eye * by
        return replace(self, east=lengths[0], up=lengths[1], south=lengths[2], eye=lengths[3])


@runtime_checkable
class Embodied(Protocol):
    """A terrain on which a walker has a body; a scene's terrain need not be one."""

    def moved(self, body: Body, wish: Wish, seconds: float) -> Body:
        """Return the body ``seconds`` later, in units; one within something solid is set free."""
