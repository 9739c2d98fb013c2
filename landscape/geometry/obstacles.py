"""What a walker goes round: towers and walls, seen from above. No OpenGL."""

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
        """Return the distance in units from the surface, negative inside, and the way out."""
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
        """Return the distance in units from the surface, negative inside, and the way out."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        dx, dz = x - self.x, z - self.z
        u, w = c * dx - s * dz, s * dx + c * dz
        over_u, over_w = abs(u) - self.half_length, abs(w) - self.half_thickness
        if over_u <= 0.0 and over_w <= 0.0:
            # Inside: the nearest face is the one that is least far behind.
            distance = max(over_u, over_w)
            nu, nw = (1.0, 0.0) if over_u > over_w else (0.0, 1.0)
        else:
            nu, nw = max(over_u, 0.0), max(over_w, 0.0)
            distance = math.hypot(nu, nw)
            nu, nw = nu / distance, nw / distance
        nu, nw = math.copysign(nu, u), math.copysign(nw, w)
        return distance, c * nu + s * nw, -s * nu + c * nw


Obstacle = Tower | Wall
