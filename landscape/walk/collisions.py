"""Where a walker may be: pushed out of obstacles, within the map's border. No OpenGL."""

import math
from collections.abc import Sequence

from landscape.geometry.obstacle_grid import ObstacleGrid, Obstacles
from landscape.geometry.obstacles import MARGIN, RADIUS, Obstacle
from landscape.scene.scene import Terrain

FLOOR = 0.05  # chosen: units a flying eye keeps above the ground, the water and obstacles
SIGHT = 0.4  # chosen: units within which obstacles of a grid are known
STEP = SIGHT / 2 - RADIUS  # units, the longest step among obstacles of a grid
RINGS, POINTS = 60, 12  # chosen: circles, a RADIUS apart, searched for a free place; points on each

Place = tuple[float, float]


class Surroundings:
    """The obstacles near a moving walker: of a grid those within SIGHT, otherwise all."""

    def __init__(self, obstacles: Obstacles) -> None:
        """Look nothing up yet."""
        self._grid = obstacles if isinstance(obstacles, ObstacleGrid) else None
        self._near: Sequence[Obstacle] = () if isinstance(obstacles, ObstacleGrid) else obstacles
        self._centre = math.inf, math.inf
        self.step = STEP if self._grid else math.inf

    def at(self, x: float, z: float) -> Sequence[Obstacle]:
        """Return the obstacles around x, z in units; after a move of ``step``, ask again."""
        if self._grid and math.dist((x, z), self._centre) > SIGHT / 2:
            self._near, self._centre = self._grid.near(x, z, SIGHT), (x, z)
        return self._near


def gap_to(x: float, z: float, obstacles: Sequence[Obstacle]) -> tuple[float, float, float]:
    """Return the distance to the nearest obstacle and the direction away; infinity if none."""
    return min((o.gap(x, z) for o in obstacles), default=(math.inf, 1.0, 0.0))


def push_out(x: float, z: float, obstacles: Sequence[Obstacle]) -> Place:
    """Return the point nearest to x, z, in units, where the walker touches no obstacle.

    Where a wall meets a tower, a push out of one may lead into the other; eight are enough.
    """
    for _ in range(8):
        gap, nx, nz = gap_to(x, z, obstacles)
        if gap >= RADIUS:
            break
        x, z = x + (RADIUS - gap) * nx, z + (RADIUS - gap) * nz
    return x, z


def solid(obstacles: Sequence[Obstacle], y: float) -> list[Obstacle]:
    """Return the obstacles that an eye at ``y`` can pass neither over nor under."""
    return [o for o in obstacles if o.bottom < y < o.top + FLOOR]


def inside(x: float, z: float, ground: Terrain) -> Place:
    """Return x, z clamped to the map."""
    last = ground.size - MARGIN
    return min(max(x, MARGIN), last), min(max(z, MARGIN), last)


def is_free(at: Place, obstacles: Sequence[Obstacle]) -> bool:
    """Return whether a walker there touches no obstacle."""
    return gap_to(*at, obstacles)[0] >= RADIUS - 1e-6


def reachable(start: Place, to: Place, ground: Terrain, obstacles: Sequence[Obstacle]) -> Place:
    """Return where a short move ends: it slides along obstacles, and stops in a corner."""
    at = inside(*push_out(*inside(*to, ground), obstacles), ground)
    return at if start == to or is_free(at, obstacles) else start


def freed(at: Place, y: float, ground: Terrain, around: Surroundings) -> Place:
    """Return the place itself, or one near it where an eye at ``y`` touches no obstacle.

    Pushed out of what he is in, a walker may be in the next obstacle: then the nearest free place
    on a circle around him is taken.
    """
    obstacles = solid(around.at(*at), y)
    pushed = reachable(at, at, ground, obstacles)
    if is_free(pushed, obstacles):
        return pushed
    for ring in range(1, RINGS):
        for point in range(POINTS):
            angle, radius = 2 * math.pi * point / POINTS, ring * RADIUS
            x, z = at[0] + radius * math.cos(angle), at[1] + radius * math.sin(angle)
            if (x, z) == inside(x, z, ground) and is_free((x, z), solid(around.at(x, z), y)):
                return x, z
    return pushed
