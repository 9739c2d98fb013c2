"""Obstacles that a walker cannot pass: towers and walls, seen from above. No OpenGL."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

MARGIN = 0.1  # chosen: units a walker keeps from the map's border
RADIUS = 0.05  # chosen: units, half the walker's width; 2.5 times the near plane's distance


@dataclass(frozen=True)
class Tower:
    """A round obstacle: centre, radius and top in units."""

    x: float
    z: float
    radius: float
    top: float
    bottom: ClassVar[float] = -math.inf

    @property
    def extent(self) -> float:
        """How far it reaches from its centre, in units."""
        return self.radius

    def gap(self, x: float, z: float) -> tuple[float, float, float]:
        """Return the distance to the surface in units, negative inside, and the way out x, z."""
        dx, dz = x - self.x, z - self.z
        distance = math.hypot(dx, dz)
        if distance == 0.0:
            return -self.radius, 1.0, 0.0
        return distance - self.radius, dx / distance, dz / distance


@dataclass(frozen=True)
class Wall:
    """A straight obstacle: centre, half its length and thickness, top in units; ``yaw`` radians.

    One passes under a wall that has a ``bottom``.
    """

    x: float
    z: float
    half_length: float
    half_thickness: float
    yaw: float
    top: float
    bottom: float = -math.inf

    @property
    def extent(self) -> float:
        """How far it reaches from its centre, in units."""
        return math.hypot(self.half_length, self.half_thickness)

    def gap(self, x: float, z: float) -> tuple[float, float, float]:
        """Return the distance to the surface in units, negative inside, and the way out x, z."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        dx, dz = x - self.x, z - self.z
        u, w = c * dx - s * dz, s * dx + c * dz
        over_u, over_w = abs(u) - self.half_length, abs(w) - self.half_thickness
        if over_u <= 0.0 and over_w <= 0.0:
            # Inside: the nearest face is the one with the least distance behind it.
            distance = max(over_u, over_w)
            nu, nw = (1.0, 0.0) if over_u > over_w else (0.0, 1.0)
        else:
            nu, nw = max(over_u, 0.0), max(over_w, 0.0)
            distance = math.hypot(nu, nw)
            nu, nw = nu / distance, nw / distance
        nu, nw = math.copysign(nu, u), math.copysign(nw, w)
        return distance, c * nu + s * nw, -s * nu + c * nw


@dataclass(frozen=True)
class Gate(Wall):
    """A wall that opens from its back, where its own z is positive, and is shut from its front."""

    def gap(self, x: float, z: float) -> tuple[float, float, float]:
        """Return the distance as of a wall; from its back there is nothing, at infinity."""
        dx, dz = x - self.x, z - self.z
        if math.sin(self.yaw) * dx + math.cos(self.yaw) * dz > -self.half_thickness:
            return math.inf, 1.0, 0.0
        return super().gap(x, z)


Obstacle = Tower | Wall


def courtyard(
    x: float,
    z: float,
    yaw_deg: float,
    thickness: float,
    top: float,
    towers: tuple[float, float],
    door: tuple[float, float] | None = None,
) -> tuple[Obstacle, ...]:
    """Return four walls around a square of 1 x 1 units about (x, z), and a tower at each corner.

    ``yaw_deg`` turns it as glRotatef about y does. ``top`` is the walls' height, ``towers`` the
    radius of the towers and their height. ``door`` is half the width and the top of a gate in the
    middle of the first wall, which opens from within.
    """
    yaw = math.radians(yaw_deg)
    c, s = math.cos(yaw), math.sin(yaw)

    def place(u: float, w: float) -> tuple[float, float]:
        return x + c * u + s * w, z - s * u + c * w

    edge, half = 0.5 - thickness / 2, thickness / 2
    walls = [Wall(*place(0, side), 0.5, half, yaw, top) for side in (-edge, edge)]
    walls += [Wall(*place(side, 0), half, 0.5, yaw, top) for side in (-edge, edge)]
    if door is not None:
        walls[:1] = _gated(walls[0], *door, place)
    corners = [place(u, w) for u in (-0.5, 0.5) for w in (-0.5, 0.5)]
    return (*walls, *(Tower(*corner, *towers) for corner in corners))


def _gated(
    wall: Wall, wide: float, lintel: float, place: Callable[[float, float], tuple[float, float]]
) -> list[Wall]:
    """Return the parts of a courtyard's first wall with a gate, half as wide as it says."""
    half, yaw, top = wall.half_thickness, wall.yaw, wall.top
    edge = 0.5 - half
    beside, middle = (0.5 - wide) / 2, (0.5 + wide) / 2
    return [
        Gate(wall.x, wall.z, wide, half, yaw, top),
        Wall(wall.x, wall.z, wide, half, yaw, top, lintel),
        *(Wall(*place(u, -edge), beside, half, yaw, top) for u in (-middle, middle)),
    ]
