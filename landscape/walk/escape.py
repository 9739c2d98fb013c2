"""Nobody stays stuck: who is held between obstacles is put beside them. No OpenGL.

A walker slides along what he walks into, but not out of a crack that gets narrower, as between two
boulders, and not out of a pit of blocks. Who asks to move for PATIENCE seconds, and comes no
further than his body is wide, is put on the nearest free place from which his way goes on.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

from landscape.frame import Pose
from landscape.geometry.bodies import Embodied
from landscape.geometry.obstacle_grid import Obstacles
from landscape.geometry.obstacles import RADIUS, Obstacle, Tower, Wall
from landscape.scene.scene import SceneSettings, Terrain
from landscape.walk.collisions import Place, Surroundings, inside, is_free, solid
from landscape.walk.walker import Intent, Walker, advance, start

PATIENCE = 2.0  # seconds of asking, without coming further than the body is wide
TOUCHING = 0.005  # chosen: units, a gap as narrow as this is none
RINGS, POINTS = 40, 16  # chosen: circles, half a body apart, searched for a place; points on each
TRIAL = 0.6  # chosen: seconds of walking that show whether a way goes on
FRAMES = 6  # chosen: frames of a trial
ONWARD = 4 * RADIUS  # chosen: units that one comes in a trial if the way goes on
WAYS = tuple(
    Intent(forward, right, up=1.0)
    for forward, right in ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1))
)


def moved(
    walker: Walker,
    intent: Intent,
    seconds: float,
    ground: Terrain,
    obstacles: Obstacles,
    settings: SceneSettings,
) -> Walker:
    """Return the walker ``seconds`` later, as :func:`advance` does, but let out if he is stuck."""
    after = advance(walker, intent, seconds, ground, obstacles, settings)
    after = _noted(after, intent, seconds)
    if after.held < PATIENCE:
        return after
    after = replace(after, spot=None, held=0.0)
    if not stuck(after, intent, ground, obstacles, settings):
        return after
    return _let_out(after, intent, ground, obstacles, settings)


def _noted(walker: Walker, intent: Intent, seconds: float) -> Walker:
    """Return the walker, knowing for how long he has asked in vain to leave a spot."""
    here = walker.x, walker.z
    busy = intent.dig or intent.digging or intent.place or intent.placing
    if walker.flying or busy or walker.spot is None or math.dist(here, walker.spot) > 2 * RADIUS:
        return replace(walker, spot=here, held=0.0)
    asked = bool(intent.forward or intent.right)
    return replace(walker, held=walker.held + seconds * asked)


def stuck(
    walker: Walker,
    intent: Intent,
    ground: Terrain,
    obstacles: Obstacles,
    settings: SceneSettings,
) -> bool:
    """Return whether one is in a crack where he wants to go, or can go nowhere at all.

    Before a wall, or in the corner of a room, one stands because one wants to.
    """
    if not isinstance(ground, Embodied):
        near = solid(Surroundings(obstacles).at(walker.x, walker.z), walker.y)
        touching = [o for o in near if o.gap(walker.x, walker.z)[0] < RADIUS + TOUCHING]
        if _is_crack(touching):
            return not _goes_on(walker, intent, ground, obstacles, settings)
    return not any(_goes_on(walker, way, ground, obstacles, settings) for way in WAYS)


def _is_crack(touching: Sequence[Obstacle]) -> bool:
    """Return whether one is between obstacles: two round ones, or a round one beside a wall.

    One that adjoins the wall, as the tower of a castle, makes a corner with it, and no crack.
    """
    towers = [o for o in touching if isinstance(o, Tower)]
    walls = [o for o in touching if isinstance(o, Wall)]
    beside = (wall.gap(tower.x, tower.z)[0] > tower.radius for tower in towers for wall in walls)
    return len(towers) > 1 or any(beside)


def _goes_on(
    walker: Walker,
    intent: Intent,
    ground: Terrain,
    obstacles: Obstacles,
    settings: SceneSettings,
) -> bool:
    """Return whether one comes away from where he is by an intent."""
    asked = Intent(intent.forward, intent.right, intent.up)
    if settings.walk.speed * TRIAL < ONWARD:
        return True  # so slow that nothing shows
    tried = walker
    for _ in range(FRAMES):
        tried = advance(tried, asked, TRIAL / FRAMES, ground, obstacles, settings)
    return math.dist((tried.x, tried.z), (walker.x, walker.z)) > ONWARD


def _let_out(
    walker: Walker,
    intent: Intent,
    ground: Terrain,
    obstacles: Obstacles,
    settings: SceneSettings,
) -> Walker:
    """Return the walker at the nearest free place from which he can go where he wants to.

    If there is none, it is the nearest one from which he can go anywhere.
    """
    somewhere: Walker | None = None
    way = math.radians(walker.yaw + intent.way)
    ahead = math.sin(way), -math.cos(way)
    for x, z in _around(walker, ground, Surroundings(obstacles)):
        there = start(Pose(x, None, z, walker.yaw, walker.pitch), ground, settings)
        there = replace(there, step=walker.step, stroke=walker.stroke, struck=walker.struck)
        near = solid(Surroundings(obstacles).at(x, z), there.y)
        if not is_free((x, z), near):
            continue
        there = replace(there, escapes=walker.escapes + 1)
        # From behind, his way would lead into the same crack again.
        behind = (x - walker.x) * ahead[0] + (z - walker.z) * ahead[1] < -TOUCHING
        if not behind and _goes_on(there, intent, ground, obstacles, settings):
            return there
        if somewhere is None and any(
            _goes_on(there, way, ground, obstacles, settings) for way in WAYS
        ):
            somewhere = there
    return somewhere or walker


def _around(walker: Walker, ground: Terrain, around: Surroundings) -> Iterator[Place]:
    """Yield the places around a walker, the nearest first, on his side of all walls."""
    for ring in range(2, RINGS):
        for point in range(POINTS):
            angle, radius = 2 * math.pi * point / POINTS, ring * RADIUS
            x, z = walker.x + radius * math.cos(angle), walker.z + radius * math.sin(angle)
            if (x, z) == inside(x, z, ground) and not _walled_off(walker, (x, z), around):
                yield x, z


def _walled_off(walker: Walker, to: Place, around: Surroundings) -> bool:
    """Return whether a wall stands between a walker and a place."""
    steps = math.ceil(math.dist((walker.x, walker.z), to) / (RADIUS / 2))
    for k in range(1, steps + 1):
        x = walker.x + (to[0] - walker.x) * k / steps
        z = walker.z + (to[1] - walker.z) * k / steps
        walls = (o for o in solid(around.at(x, z), walker.y) if isinstance(o, Wall))
        if any(wall.gap(x, z)[0] < 0.0 for wall in walls):
            return True
    return False
