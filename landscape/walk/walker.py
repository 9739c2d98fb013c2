"""The walker: where the eye stands and how it moves (Position in 2006, section 8.2). No OpenGL.

The report moves the walker a fixed dL per key event: x += dL sin(yaw), z -= dL cos(yaw) plus
0.0005 cos(step/4), eye = height(x, z) + 0.006 cos(step/3) + 0.1. Here speeds are per second, so
that the motion does not depend on the frame rate, and the walker stops at the map's border and at
obstacles such as the castle. In 2006 he walked on the water's surface, the least that height(x, z)
returns; with ``walk.swim`` he wades, and swims where it is deep. In a scene that gives him a body
(geometry/bodies.py), that scene moves it. A :class:`Walker` is a plain value: :func:`advance`
returns the next one from the user's input.
"""

import math
from dataclasses import dataclass, replace

from landscape.elements.sword import STROKES
from landscape.frame import Pose
from landscape.geometry.bodies import Body, Embodied, Wish
from landscape.geometry.obstacle_grid import Obstacles
from landscape.geometry.obstacles import MARGIN, RADIUS
from landscape.scene.scene import Diveable, SceneSettings, Terrain, Watery
from landscape.walk.collisions import FLOOR, Surroundings, freed, gap_to, reachable, solid

STRIDE = 0.02  # chosen: units, the longest step near a wall; far less than a wall's thickness
WANDER = 0.0005  # section 8.2: units of drift to the north per step, times cos(step / 4)
FLY = 2.0  # chosen: times the walking speed
FALL = 6.0  # chosen: units per second, falling after a flight
DROP = 0.4  # chosen: units; one who has a body falls from up to there when he arrives
SWEEP = 360.0  # chosen: degrees of yaw across the window's width
AFLOAT = 0.055  # chosen: units, a swimming eye above the water; the waves rise 0.016
SWIM = 0.5  # chosen: times the walking speed
WADE = 0.1  # chosen: units, the longest step where there may be water; in it, STRIDE
RIPPLE = 0.004  # chosen: units, amplitude of the water's rise and fall under a swimmer
RIPPLE_SECONDS = 2.6  # chosen: one rise and fall
DEEP, SHALLOW = 1.1, 0.8  # chosen: times the depth at which one floats: where swimming begins, ends
LEAP, GRAVITY = 0.32, 1.0  # chosen: units per second and per second squared: 0.05 units high
MAX_PITCH = 89.0  # degrees; at 90 "forward" would have no direction on the map


@dataclass(frozen=True)
class Intent:
    """The user's intent for one frame.

    ``forward``, ``right``, ``up`` and ``turn`` (to the right) are -1 to 1; ``look`` is how far the
    mouse moved, in pixels right and down. ``strike`` and ``fly`` are events: a stroke of the sword
    begins; flying begins or ends. So are ``dig``, ``place`` and ``pick``, one click each in a scene
    of blocks; ``digging`` and ``placing`` say that the button is held.
    """

    forward: float = 0.0
    right: float = 0.0
    up: float = 0.0
    turn: float = 0.0
    look: tuple[float, float] = (0.0, 0.0)
    run: bool = False
    strike: bool = False
    fly: bool = False
    dig: bool = False
    place: bool = False
    pick: bool = False
    digging: bool = False
    placing: bool = False

    @property
    def walks(self) -> bool:
        """Whether a step is asked for."""
        return bool(self.forward or self.right)

    @property
    def way(self) -> float:
        """The way that is asked for, in degrees to the right of where he looks."""
        return math.degrees(math.atan2(self.right, self.forward))


@dataclass(frozen=True)
class Walker:
    """The eye's position in units, yaw and pitch in degrees, and the state of the body.

    ``step`` is the report's k_step; ``drop`` is the height in units still to fall after a flight or
    in a jump, ``rise`` the speed upwards in units per second of one who jumps;
    ``stroke`` is 0 at rest and 1 to 4 during a stroke of the sword, which began ``struck`` kt ago.
    ``afloat`` are the seconds spent in the water, which move the eye up and down; ``swimming`` says
    that the water is deep, ``at_edge`` that the map ends here. ``body`` is his body, None where he
    has none, or has not moved yet. ``spot`` is x, z in units of where he is held, if he is, for
    ``held`` seconds; ``escapes`` counts how often he was let out (escape.py).
    """

    x: float
    y: float
    z: float
    yaw: float = 0.0
    pitch: float = 0.0
    step: float = 0.0
    flying: bool = False
    drop: float = 0.0
    rise: float = 0.0
    stroke: int = 0
    struck: float = 0.0
    afloat: float = 0.0
    swimming: bool = False
    at_edge: bool = False
    body: Body | None = None
    spot: tuple[float, float] | None = None
    held: float = 0.0
    escapes: int = 0

    @property
    def pose(self) -> Pose:
        """Where the eye is."""
        return Pose(self.x, self.y, self.z, self.yaw, self.pitch)


def aimed(
    walker: Walker, cursor: tuple[float, float], size: tuple[int, int], mouse: float
) -> tuple[float, float]:
    """Return the look, in pixels right and down, that turns the view to where the cursor points.

    In 2006 the position of the mouse set the rotation (R13). Here the window's width covers SWEEP
    degrees of yaw, with north in the middle, and its height covers the whole range of pitch.
    ``cursor`` and ``size`` are in pixels, ``mouse`` in degrees per pixel.
    """
    if mouse <= 0.0 or 0 in size:
        return 0.0, 0.0
    across, down = (
        min(max(at / side, 0.0), 1.0) - 0.5 for at, side in zip(cursor, size, strict=True)
    )
    turn = (across * SWEEP - walker.yaw + 180.0) % 360.0 - 180.0
    return turn / mouse, (down * 2 * MAX_PITCH + walker.pitch) / mouse


def start(pose: Pose, ground: Terrain, settings: SceneSettings) -> Walker:
    """Return a walker at a pose: flying if well above eye height, else (or with no y) on foot."""
    y = at_eye = float(ground.height(pose.x, pose.z)) + settings.walk.eye
    if (
        isinstance(ground, Diveable)
        and not isinstance(ground, Embodied)
        and pose.y is not None
        and ground.bed(pose.x, pose.z) < pose.y < float(ground.height(pose.x, pose.z))
    ):
        walker = Walker(pose.x, pose.y, pose.z, pose.yaw, pose.pitch, 0.0, True)
        return advance(walker, Intent(), 0.0, ground, (), settings)
    over = DROP if isinstance(ground, Embodied) else settings.walk.bob + FLOOR
    flying = pose.y is not None and pose.y > at_eye + over
    if flying:
        assert pose.y is not None
        y = pose.y
    elif pose.y is not None and isinstance(ground, Embodied):
        y = pose.y
    walker = Walker(pose.x, y, pose.z, pose.yaw, pose.pitch, 0.0, flying)
    return advance(walker, Intent(), 0.0, ground, (), settings)


def _turned(
    walker: Walker, intent: Intent, seconds: float, settings: SceneSettings
) -> tuple[Walker, float]:
    """Return the walker looking where he is to look, and his heading on the way, in degrees."""
    walk = settings.walk
    turned = intent.turn * walk.turn * seconds + intent.look[0] * walk.mouse
    pitch = walker.pitch - intent.look[1] * walk.mouse

    # In a turn, the heading half-way through the frame makes the path depend least on its length.
    heading = walker.yaw + turned / 2
    yaw = (walker.yaw + turned) % 360.0
    return replace(walker, yaw=yaw, pitch=max(-MAX_PITCH, min(pitch, MAX_PITCH))), heading


def advance(
    walker: Walker,
    intent: Intent,
    seconds: float,
    ground: Terrain,
    obstacles: Obstacles,
    settings: SceneSettings,
) -> Walker:
    """Return the walker ``seconds`` later; a long frame never takes it through a wall."""
    walk = settings.walk
    walker = _strike(walker, intent, seconds * settings.clock.kt_per_second, settings)
    walker, heading = _turned(walker, intent, seconds, settings)
    walker = _jump_or_fall(walker, intent, seconds, settings)
    if intent.fly:
        walker = _take_off_or_land(walker, ground, settings)
    reach = walk.speed * (walk.run if intent.run else 1.0) * seconds
    if isinstance(ground, Embodied):
        walker = _move_body(walker, intent, heading, seconds, ground, settings)
    elif walker.flying:
        walker = _fly(walker, intent, heading, FLY * reach, ground, obstacles)
    else:
        afloat = walker.afloat + seconds if _sunk(walker.x, walker.z, ground, settings) else 0.0
        walker = replace(walker, afloat=afloat)
        walker = _walk(walker, intent, heading, reach, ground, obstacles, settings)

    return _placed(walker, ground, settings)


def _jump_or_fall(
    walker: Walker, intent: Intent, seconds: float, settings: SceneSettings
) -> Walker:
    """Return the walker with his height over the ground after a leap, or a fall after a flight.

    Where a scene gives him a body, that jumps by itself.
    """
    stands = walker.drop == 0.0 and not (walker.flying or walker.swimming)
    rise = walker.rise
    if settings.walk.jump and stands and intent.up > 0 and walker.body is None:
        rise = LEAP
    elif rise == 0.0:
        return replace(walker, drop=max(walker.drop - FALL * seconds, 0.0))

    drop = walker.drop + rise * seconds - GRAVITY * seconds**2 / 2
    if walker.flying or drop <= 0.0:
        return replace(walker, drop=0.0, rise=0.0)
    return replace(walker, drop=drop, rise=rise - GRAVITY * seconds)


def _placed(walker: Walker, ground: Terrain, settings: SceneSettings) -> Walker:
    """Return the walker, knowing whether he swims, and whether he is at the map's edge."""
    if walker.body is not None:
        depth = 2 * DEEP * walker.body.swimming
    else:
        depth = 0.0 if walker.flying else _sunk(walker.x, walker.z, ground, settings)
    # Two limits, so that a swimmer on the shore does not change his mind in every frame.
    swimming = depth > (SHALLOW if walker.swimming else DEEP)
    last = ground.size - MARGIN - 1e-6
    at_edge = not all(ground.size - last < at < last for at in (walker.x, walker.z))
    return replace(walker, swimming=swimming, at_edge=at_edge)


def _sunk(x: float, z: float, ground: Terrain, settings: SceneSettings) -> float:
    """Return the water's depth over that at which one floats: 0 on land, over 1 in deep water."""
    if not settings.walk.swim or not isinstance(ground, Watery):
        return 0.0
    return float(ground.depth(x, z)) / max(settings.walk.eye - AFLOAT, 1e-3)


def _strike(walker: Walker, intent: Intent, kt: float, settings: SceneSettings) -> Walker:
    """Advance the sword's stroke, or start one if none is running."""
    if walker.stroke == 0:
        return replace(walker, stroke=1, struck=0.0) if intent.strike else walker
    struck = walker.struck + kt
    stroke = 1 + int(struck / settings.walk.stroke_kt)
    if stroke > STROKES:
        return replace(walker, stroke=0, struck=0.0)
    return replace(walker, stroke=stroke, struck=struck)


def eye_height(
    x: float, z: float, step: float, ground: Terrain, settings: SceneSettings, afloat: float = 0.0
) -> float:
    """Return the walking eye's y in units: ground or water, plus the bob, plus eye height.

    In water it is lower, down to AFLOAT above the surface, and rises and falls with ``afloat``, the
    seconds spent there.
    """
    walk = settings.walk
    y = float(ground.height(x, z)) + walk.bob * math.cos(step / 3) + walk.eye
    sunk = min(_sunk(x, z, ground, settings), 1.0)
    if sunk == 0.0:
        return y
    ripple = RIPPLE * math.sin(2 * math.pi * afloat / RIPPLE_SECONDS)
    return y - sunk * (max(walk.eye - AFLOAT, 0.0) - ripple)


def _take_off_or_land(walker: Walker, ground: Terrain, settings: SceneSettings) -> Walker:
    """Start flying at the eye's position, or start falling from it."""
    if not walker.flying:
        return replace(walker, flying=True, drop=0.0, rise=0.0)
    if walker.body is not None:
        return replace(walker, flying=False)
    eye = eye_height(walker.x, walker.z, walker.step, ground, settings, walker.afloat)
    height = walker.y - eye
    return replace(walker, flying=False, drop=max(height, 0.0))


def _walk(
    walker: Walker,
    intent: Intent,
    heading: float,
    reach: float,
    ground: Terrain,
    obstacles: Obstacles,
    settings: SceneSettings,
) -> Walker:
    """Walk up to ``reach`` units towards ``heading`` in degrees, on the ground or in the water."""
    long = math.hypot(intent.forward, intent.right)

    # Two keys held together are no faster than one.
    left = min(reach * min(long, 1.0), 2 * ground.size)
    c, s = math.cos(math.radians(heading)), math.sin(math.radians(heading))
    ux = (intent.forward * s + intent.right * c) / (long or 1.0)
    uz = (-intent.forward * c + intent.right * s) / (long or 1.0)
    x = walker.x
    z = walker.z
    step = walker.step
    afloat = walker.afloat
    around = Surroundings(obstacles)
    y = eye_height(x, z, step, ground, settings, afloat) + walker.drop
    x, z = freed((x, z), y, ground, around)
    while left > 1e-12:
        # Far from obstacles the rest is one move; near them no move is longer than STRIDE.
        near = around.at(x, z)
        stride = min(left, around.step, max(gap_to(x, z, near)[0] - RADIUS, STRIDE))
        effort = 1.0
        if settings.walk.swim:
            stride = min(stride, WADE)
            sunk = _sunk(x, z, ground, settings)
            if sunk or _sunk(x + stride * ux, z + stride * uz, ground, settings):
                effort = 1.0 / (1.0 - (1.0 - SWIM) * min(sunk, 1.0))
                stride = min(stride, STRIDE, left / effort)
        after = step + stride * settings.walk.steps_per_unit
        # The report's small drift term, summed over the steps of this move.
        drift = 4 * WANDER * (math.sin(after / 4) - math.sin(step / 4))
        to = x + stride * ux, z + stride * uz - drift
        there = reachable((x, z), to, ground, solid(near, y))
        moved = 1.0 if there == to else math.hypot(there[0] - x, there[1] - z) / stride
        if moved < 1e-6:
            break
        step += stride * min(moved, 1.0) * settings.walk.steps_per_unit
        x, z = there
        left -= stride * effort

    y = eye_height(x, z, step, ground, settings, afloat) + walker.drop
    return replace(walker, x=x, y=y, z=z, step=step)


def _wish(walker: Walker, intent: Intent, heading: float, settings: SceneSettings) -> Wish:
    """Return how the walker's body is to move."""
    walk = settings.walk
    east, north, up = _velocity(intent, heading, walker.pitch if walker.flying else 0.0)
    speed = walk.speed * (walk.run if intent.run else 1.0) * (FLY if walker.flying else 1.0)
    return Wish(
        east * speed,
        (up + intent.up) * speed * walker.flying,
        -north * speed,
        jump=intent.up > 0.0,
        flying=walker.flying,
        eye=walk.eye,
        dive=intent.up < 0.0,
    )


def _move_body(
    walker: Walker,
    intent: Intent,
    heading: float,
    seconds: float,
    ground: Embodied,
    settings: SceneSettings,
) -> Walker:
    """Let a scene move the walker's body, and put the eye where its place over the feet is."""
    walk = settings.walk
    body = walker.body or Body(walker.x, walker.y - walk.eye, walker.z)
    after = ground.moved(body, _wish(walker, intent, heading, settings), seconds)
    walked = math.hypot(after.x - walker.x, after.z - walker.z)
    on_foot = after.grounded and walker.body is not None
    step = walker.step + walked * walk.steps_per_unit * on_foot

    y = after.y + walk.eye - after.lag + walk.bob * math.cos(step / 3) * after.grounded
    afloat = walker.afloat + seconds if after.swimming else 0.0
    y += RIPPLE * math.sin(2 * math.pi * afloat / RIPPLE_SECONDS)
    return replace(walker, x=after.x, y=y, z=after.z, step=step, afloat=afloat, body=after)


def _velocity(intent: Intent, heading: float, pitch: float) -> tuple[float, float, float]:
    """Return the way east, north and up of one who walks or flies, at most 1 long."""
    ahead = Pose(0.0, 0.0, 0.0, heading, pitch).forward
    c, s = math.cos(math.radians(heading)), math.sin(math.radians(heading))
    east = intent.forward * ahead[0] + intent.right * c
    north = -intent.forward * ahead[2] - intent.right * s
    long = max(math.hypot(intent.forward, intent.right), 1.0)
    return east / long, north / long, intent.forward * ahead[1] / long


def _fly(
    walker: Walker,
    intent: Intent,
    heading: float,
    reach: float,
    ground: Terrain,
    obstacles: Obstacles,
) -> Walker:
    """Fly up to ``reach`` units along the line of sight, sideways and up, above all obstacles.

    Where one can dive, one flies down to the bed: that is swimming under water.

    Who does not move stays where he is, beyond the map and below the ground, too: a view may be
    from there.
    """
    fx, fy, fz = Pose(0.0, 0.0, 0.0, heading, walker.pitch).forward
    c, s = math.cos(math.radians(heading)), math.sin(math.radians(heading))
    vx = intent.forward * fx + intent.right * c
    vy = intent.forward * fy + intent.up
    vz = intent.forward * fz + intent.right * s
    speed = max(math.sqrt(vx * vx + vy * vy + vz * vz), 1.0)
    if not (vx or vy or vz):
        return walker
    x = walker.x
    y = walker.y
    z = walker.z
    around = Surroundings(obstacles)
    x, z = freed((x, z), y, ground, around)
    left = min(reach, 3 * ground.size)
    while True:
        near = around.at(x, z)
        gap = gap_to(x, z, near)[0] - RADIUS
        stride = min(left, around.step, max(gap, STRIDE)) / speed
        to = x + stride * vx, z + stride * vz
        x, z = reachable((x, z), to, ground, solid(near, y))
        under = [o.top for o in near if o.gap(x, z)[0] < RADIUS - 1e-6 and y >= o.top + FLOOR]
        lowest = ground.bed(x, z) if isinstance(ground, Diveable) else ground.height(x, z)
        floor = max([float(lowest), *under]) + FLOOR

        # The ceiling is as high as the map is wide: from there all of it is in view.
        y = min(max(y + stride * vy, floor), max(ground.size, floor))
        left -= stride * speed
        if left <= 1e-12:
            return replace(walker, x=x, y=y, z=z)
