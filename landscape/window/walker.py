"""Where the walker stands and how he moves (Position, section 8.2). No OpenGL here.

The report moves the walker a fixed dL per key event: x += dL sin(yaw), z -= dL cos(yaw) plus
0.0005 cos(step/4), eye = height(x, z) + 0.006 cos(step/3) + 0.1. Here the same is said per second,
so that it does not depend on the frame rate, and the walker minds the map's border and the castle.
A :class:`Walker` is a plain value: :func:`advance` makes the next one from what the user asks for.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from landscape.elements.sword import STROKES
from landscape.frame import Pose
from landscape.geometry.height_field import HeightField
from landscape.geometry.masonry import MERLON, TOWER_RADIUS, TOWER_TOP, WALL
from landscape.geometry.obstacles import Obstacle, Tower, Wall
from landscape.settings import Castle, Dragon, Rabbit, Settings

RABBIT_ROUND = 0.6  # chosen, times its scale: the radius of a ring round haunches and chest
DRAGON_LONG = (0.85, 0.16)  # chosen, times its scale: half its length and half its thickness
RADIUS = 0.05  # chosen: units, half the walker's width; 2.5 times the near plane's distance
MARGIN = 0.1  # chosen: units kept from the map's border
STRIDE = (
    0.02  # chosen: units moved at once near a wall, far less than a wall and a walker are thick
)
WANDER = 0.0005  # section 8.2: units a step drifts to the north, times cos(step / 4)
FLY = 2.0  # chosen: times the walking speed
FLOOR = 0.05  # chosen: units a flyer keeps above the ground, the water and the castle
FALL = 6.0  # chosen: units per second, from where flying ends to the ground
SWEEP = 360.0  # chosen: degrees of yaw across the window's width
MAX_PITCH = 89.0  # degrees; at 90 "forward" would have no direction on the map


@dataclass(frozen=True)
class Intent:
    """What the user asks for in one frame.

    ``forward``, ``right``, ``up`` and ``turn`` (to the right) are -1 to 1; ``look`` is how far the
    mouse went, pixels to the right and down. ``strike`` and ``fly`` are events: the sword's stroke
    begins, flying begins or ends.
    """

    forward: float = 0.0
    right: float = 0.0
    up: float = 0.0
    turn: float = 0.0
    look: tuple[float, float] = (0.0, 0.0)
    run: bool = False
    strike: bool = False
    fly: bool = False


@dataclass(frozen=True)
class Walker:
    """The eye's place in units, yaw and pitch in degrees, and what the body does.

    ``step`` is the report's k_step; ``drop`` the height in units still to fall after a flight;
    ``stroke`` is 0 at rest and 1 to 4 in a stroke of the sword, ``struck`` kt ago.
    """

    x: float
    y: float
    z: float
    yaw: float = 0.0
    pitch: float = 0.0
    step: float = 0.0
    flying: bool = False
    drop: float = 0.0
    stroke: int = 0
    struck: float = 0.0

    @property
    def pose(self) -> Pose:
        """Where the eye is."""
        return Pose(self.x, self.y, self.z, self.yaw, self.pitch)


def castle_obstacles(castle: Castle, base: float) -> tuple[Obstacle, ...]:
    """Return the castle's four walls and four towers; ``base`` is its foot's height in units."""
    yaw = math.radians(castle.yaw)
    c, s = math.cos(yaw), math.sin(yaw)

    def place(u: float, w: float) -> tuple[float, float]:
        """Turn as glRotatef(yaw, 0, 1, 0) does, about the centre of the unit square."""
        return castle.x + c * u + s * w, castle.z - s * u + c * w

    edge, half = 0.5 - WALL / 2, WALL / 2
    walls = [Wall(*place(0, side), 0.5, half, yaw, base + 1 + MERLON) for side in (-edge, edge)]
    walls += [Wall(*place(side, 0), half, 0.5, yaw, base + 1 + MERLON) for side in (-edge, edge)]
    corners = [place(u, w) for u in (-0.5, 0.5) for w in (-0.5, 0.5)]
    return (*walls, *(Tower(*corner, TOWER_RADIUS, base + TOWER_TOP) for corner in corners))


def animal_obstacles(
    rabbit: Rabbit | None, dragon: Dragon | None, field: HeightField
) -> tuple[Obstacle, ...]:
    """Return what the walker must go round of the animals that are there: a round and a long one.

    The meshes fill -1..1 times their scale: the dragon is long along its own x axis.
    """
    found: list[Obstacle] = []
    if rabbit is not None:
        top = float(field.height(rabbit.x, rabbit.z)) + 2 * rabbit.scale
        found.append(Tower(rabbit.x, rabbit.z, RABBIT_ROUND * rabbit.scale, top))
    if dragon is not None:
        length, thickness = (part * dragon.scale for part in DRAGON_LONG)
        top, yaw = field.water_level + dragon.scale, math.radians(dragon.yaw)
        found.append(Wall(dragon.x, dragon.z, length, thickness, yaw, top))
    return tuple(found)


def _gap(x: float, z: float, obstacles: Sequence[Obstacle]) -> tuple[float, float, float]:
    """Return the nearest obstacle's gap and way out; infinity where there is none."""
    return min((o.gap(x, z) for o in obstacles), default=(math.inf, 1.0, 0.0))


def push_out(x: float, z: float, obstacles: Sequence[Obstacle]) -> tuple[float, float]:
    """Return the place nearest to x, z in units where the walker touches no obstacle.

    Where a wall meets a tower each push may lead into the other: eight come close enough.
    """
    for _ in range(8):
        gap, nx, nz = _gap(x, z, obstacles)
        if gap >= RADIUS:
            break
        x, z = x + (RADIUS - gap) * nx, z + (RADIUS - gap) * nz
    return x, z


def aimed(
    walker: Walker, cursor: tuple[float, float], size: tuple[int, int], mouse: float
) -> tuple[float, float]:
    """Return the look, pixels to the right and down, that turns the head where the cursor points.

    In 2006 the mouse's place set the rotation (R13): here the window's width is SWEEP degrees of
    yaw with north in its middle, its height as many of pitch as fit. ``cursor`` and ``size`` are in
    pixels, ``mouse`` in degrees per pixel.
    """
    if mouse <= 0.0 or 0 in size:
        return 0.0, 0.0
    across, down = (
        min(max(at / side, 0.0), 1.0) - 0.5 for at, side in zip(cursor, size, strict=True)
    )
    turn = (across * SWEEP - walker.yaw + 180.0) % 360.0 - 180.0
    return turn / mouse, (down * 2 * MAX_PITCH + walker.pitch) / mouse


def start(pose: Pose, field: HeightField, settings: Settings) -> Walker:
    """Return a walker at a pose; one well above the eye's height flies, y = NaN means walking."""
    at_eye = float(field.height(pose.x, pose.z)) + settings.walk.eye
    flying = pose.y > at_eye + settings.walk.bob + FLOOR
    walker = Walker(pose.x, pose.y if flying else at_eye, pose.z, pose.yaw, pose.pitch, 0.0, flying)
    return advance(walker, Intent(), 0.0, field, (), settings)


def advance(
    walker: Walker,
    intent: Intent,
    seconds: float,
    field: HeightField,
    obstacles: Sequence[Obstacle],
    settings: Settings,
) -> Walker:
    """Return the walker ``seconds`` later; however long that is, he goes through no wall."""
    walk = settings.walk
    walker = _strike(walker, intent, seconds * settings.clock.kt_per_second, settings)
    turned = intent.turn * walk.turn * seconds + intent.look[0] * walk.mouse
    pitch = walker.pitch - intent.look[1] * walk.mouse
    # Walking on a curve: the direction half-way is right at any frame rate, nearly.
    heading = walker.yaw + turned / 2
    walker = replace(
        walker,
        yaw=(walker.yaw + turned) % 360.0,
        pitch=max(-MAX_PITCH, min(pitch, MAX_PITCH)),
        drop=max(walker.drop - FALL * seconds, 0.0),
    )
    if intent.fly:
        walker = _take_off_or_land(walker, field, settings)
    reach = walk.speed * (walk.run if intent.run else 1.0) * seconds
    if walker.flying:
        return _fly(walker, intent, heading, FLY * reach, field, obstacles)
    return _walk(walker, intent, heading, reach, field, obstacles, settings)


def _strike(walker: Walker, intent: Intent, kt: float, settings: Settings) -> Walker:
    """Go on with the sword's stroke, or begin one; one that runs is not begun again."""
    if walker.stroke == 0:
        return replace(walker, stroke=1, struck=0.0) if intent.strike else walker
    struck = walker.struck + kt
    stroke = 1 + int(struck / settings.overlay.stroke_kt)
    if stroke > STROKES:
        return replace(walker, stroke=0, struck=0.0)
    return replace(walker, stroke=stroke, struck=struck)


def eye_height(x: float, z: float, step: float, field: HeightField, settings: Settings) -> float:
    """Return the walking eye's y in units: the ground or the water, the bob, and the body."""
    walk = settings.walk
    return float(field.height(x, z)) + walk.bob * math.cos(step / 3) + walk.eye


def _take_off_or_land(walker: Walker, field: HeightField, settings: Settings) -> Walker:
    """Begin to fly where the eye is, or begin to fall from there."""
    if not walker.flying:
        return replace(walker, flying=True, drop=0.0)
    height = walker.y - eye_height(walker.x, walker.z, walker.step, field, settings)
    return replace(walker, flying=False, drop=max(height, 0.0))


def _solid(obstacles: Sequence[Obstacle], y: float) -> list[Obstacle]:
    """Return the obstacles that an eye at y cannot pass over."""
    return [o for o in obstacles if y < o.top + FLOOR]


def _inside(x: float, z: float, field: HeightField) -> tuple[float, float]:
    """Return x, z moved on to the map."""
    last = field.size - MARGIN
    return min(max(x, MARGIN), last), min(max(z, MARGIN), last)


def _reachable(
    start: tuple[float, float],
    to: tuple[float, float],
    field: HeightField,
    solid: Sequence[Obstacle],
) -> tuple[float, float]:
    """Return where a short move ends: slid along a wall, or not made at all in a corner."""
    x, z = _inside(*push_out(*_inside(*to, field), solid), field)
    free = _gap(x, z, solid)[0] >= RADIUS - 1e-6
    return (x, z) if free or start == to else start


def _walk(
    walker: Walker,
    intent: Intent,
    heading: float,
    reach: float,
    field: HeightField,
    obstacles: Sequence[Obstacle],
    settings: Settings,
) -> Walker:
    """Walk up to ``reach`` units towards ``heading`` in degrees, on the ground or in the water."""
    long = math.hypot(intent.forward, intent.right)
    # Both keys at once go no faster than one.
    left = min(reach * min(long, 1.0), 2 * field.size)
    c, s = math.cos(math.radians(heading)), math.sin(math.radians(heading))
    ux = (intent.forward * s + intent.right * c) / (long or 1.0)
    uz = (-intent.forward * c + intent.right * s) / (long or 1.0)
    x, z, step = walker.x, walker.z, walker.step
    solid = _solid(obstacles, eye_height(x, z, step, field, settings) + walker.drop)
    x, z = _reachable((x, z), (x, z), field, solid)
    while left > 1e-12:
        # Far from any wall the rest is one move; near it none is longer than a STRIDE.
        stride = min(left, max(_gap(x, z, obstacles)[0] - RADIUS, STRIDE))
        after = step + stride * settings.walk.steps_per_unit
        # The sum of the report's small term over the steps made.
        drift = 4 * WANDER * (math.sin(after / 4) - math.sin(step / 4))
        to = x + stride * ux, z + stride * uz - drift
        there = _reachable((x, z), to, field, solid)
        moved = 1.0 if there == to else math.hypot(there[0] - x, there[1] - z) / stride
        if moved < 1e-6:
            break
        step += stride * min(moved, 1.0) * settings.walk.steps_per_unit
        x, z = there
        left -= stride
    y = eye_height(x, z, step, field, settings) + walker.drop
    return replace(walker, x=x, y=y, z=z, step=step)


def _fly(
    walker: Walker,
    intent: Intent,
    heading: float,
    reach: float,
    field: HeightField,
    obstacles: Sequence[Obstacle],
) -> Walker:
    """Fly up to ``reach`` units along the line of sight, aside and up, over the walls at most."""
    fx, fy, fz = Pose(0.0, 0.0, 0.0, heading, walker.pitch).forward
    c, s = math.cos(math.radians(heading)), math.sin(math.radians(heading))
    vx = intent.forward * fx + intent.right * c
    vy = intent.forward * fy + intent.up
    vz = intent.forward * fz + intent.right * s
    speed = max(math.sqrt(vx * vx + vy * vy + vz * vz), 1.0)
    x, y, z = walker.x, walker.y, walker.z
    x, z = _reachable((x, z), (x, z), field, _solid(obstacles, y))
    left = min(reach, 3 * field.size) if vx or vy or vz else 0.0
    while True:
        stride = min(left, max(_gap(x, z, obstacles)[0] - RADIUS, STRIDE)) / speed
        to = x + stride * vx, z + stride * vz
        x, z = _reachable((x, z), to, field, _solid(obstacles, y))
        under = [o.top for o in obstacles if o.gap(x, z)[0] < RADIUS - 1e-6 and y >= o.top + FLOOR]
        floor = max([float(field.height(x, z)), *under]) + FLOOR
        # As high as the map is wide: from there the whole island is in view.
        y = min(max(y + stride * vy, floor), max(field.size, floor))
        left -= stride * speed
        if left <= 1e-12:
            return replace(walker, x=x, y=y, z=z)
