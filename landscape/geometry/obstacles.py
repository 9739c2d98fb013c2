"""What a walker cannot pass: towers and walls, seen from above. No OpenGL."""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Tower:
    """A round obstacle: centre, radius and top in units."""

    x: float
    z: float
    radius: float
    top: float

    def gap(self, x: float, z: float) -> tuple[float, float, float]:
        """Return the distance to the surface in units, negative inside, and the way out x, z."""
        dx, dz = x - self.x, z - self.z
        distance = math.hypot(dx, dz)
        if distance == 0.0:
            return -self.radius, 1.0, 0.0
        return distance - self.radius, dx / distance, dz / distance


@dataclass(frozen=True)
class Wall:
    """A straight obstacle: centre, half its length and thickness, top in units; ``yaw`` radians."""

    x: float
    z: float
    half_length: float
    half_thickness: float
    yaw: float
    top: float

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


Obstacle = Tower | Wall


def courtyard(
    x: float, z: float, yaw_deg: float, thickness: float, top: float, towers: tuple[float, float]
) -> tuple[Obstacle, ...]:
    """Return four walls around a square of 1 x 1 units about (x, z), and a tower at each corner.

    ``yaw_deg`` turns it as glRotatef about y does. ``top`` is the walls' height, ``towers`` the
    radius of the towers and their height.
    """
    yaw = math.radians(yaw_deg)
    c, s = math.cos(yaw), math.sin(yaw)

    def place(u: float, w: float) -> tuple[float, float]:
        return x + c * u + s * w, z - s * u + c * w

    edge, half = 0.5 - thickness / 2, thickness / 2
    walls = [Wall(*place(0, side), 0.5, half, yaw, top) for side in (-edge, edge)]
    walls += [Wall(*place(side, 0), half, 0.5, yaw, top) for side in (-edge, edge)]
    corners = [place(u, w) for u in (-0.5, 0.5) for w in (-0.5, 0.5)]
    return (*walls, *(Tower(*corner, *towers) for corner in corners))
