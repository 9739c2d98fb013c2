"""The walker's body among blocks: an upright box that falls, jumps, climbs steps and swims.

Technique: the box moves along one axis after another, each time as far as the first solid block in
its way, which is found over the whole way at once. So it passes through nothing, whatever its speed
and the length of the frame. All is in blocks and seconds; the z axis comes second in the array.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from landscape.geometry.bodies import Body, Wish
from landscape.voxel.blocks import SOLID

# All chosen. The body's size goes with the height of its eye, 1.6 blocks by default.
HALF = 0.2  # of the eye's height: half the body's width
HEIGHT = 1.125  # of the eye's height
AFLOAT = 0.58  # of the eye's height: what of it is under water when one swims
STEP = 1.01  # blocks, the highest step that is climbed without a jump
BANK = 1.4  # blocks, the highest bank that a swimmer climbs
GRAVITY = 28.0  # blocks per second squared
JUMP = 8.4  # blocks per second: 1.26 blocks high
FASTEST = 60.0  # blocks per second of a fall
DIP = 0.35  # blocks, how far one who falls into deep water goes down more than he swims
BUOYANCY = 7.0  # per second: how fast a swimmer comes up to his place
RISE = 2.5  # blocks per second, at most: how fast one who has dived comes up
UPWARDS, DOWNWARDS = 5.0, 4.0  # blocks per second: of one who swims up, or dives
WADE = 0.5  # times the speed, in deep water
SHALLOW = 0.05  # blocks above the level at which one swims: he counts as swimming up to there
DUCK = 0.7  # of the eye's height: the lowest that it comes to in climbing
SLICE = 1 / 60  # seconds, the longest time that is computed at once
MOST_SLICES = 120
EASE = 11.0  # per second: how fast the eye follows the feet over a step
GAP = 1e-4  # blocks left between a body and what stops it


@dataclass(frozen=True)
class Place:
    """The surroundings of a body: blocks [x, z, y], and the levels of water and border.

    ``water`` is the height of the water's surface in blocks, or minus infinity. ``margin`` is how
    far the middle of a body stays away from the border of the map. Nobody sinks below ``floor``.
    """

    blocks: np.ndarray
    water: float = -math.inf
    margin: float = 1.0
    floor: float = -math.inf


@dataclass
class Box:
    """A body's box: its corners [x, z, y]."""

    low: list[float]
    high: list[float]

    def shift(self, axis: int, way: float) -> None:
        """Move the box."""
        self.low[axis] += way
        self.high[axis] += way


def box_of(body: Body, eye: float) -> Box:
    """Return the box of a body whose eye is ``eye`` above its feet."""
    half, height = HALF * eye, HEIGHT * eye
    low = [body.x - half, body.z - half, body.y]
    return Box(low, [body.x + half, body.z + half, body.y + height])


def cells(low: float, high: float, end: int, beyond: bool) -> slice:
    """Return the cells that an interval has a part in, of 0..end; clamped if they go ``beyond``."""
    first, last = math.floor(low), math.ceil(high)
    if beyond:  # the outermost blocks go on
        first, last = min(max(first, 0), end - 1), min(max(last, 1), end)
    return slice(max(first, 0), max(min(last, end), 0))


def solid_within(blocks: np.ndarray, box: Box) -> bool:
    """Return whether a box has a part in a solid block, or in the rock below the world."""
    x, z, y = (cells(box.low[a], box.high[a], blocks.shape[a], a < 2) for a in range(3))
    return box.low[2] < 0 or bool(SOLID[blocks[x, z, y]].any())


def _solid_ahead(blocks: np.ndarray, box: Box, axis: int, way: float) -> np.ndarray:
    """Return the layers (n,) along an axis in which a box that goes ``way`` meets solid blocks."""
    end = blocks.shape[axis]
    ranges = [cells(box.low[a], box.high[a], blocks.shape[a], a < 2) for a in range(3)]
    if way > 0:
        first, last = math.ceil(box.high[axis]), math.ceil(box.high[axis] + way + GAP)
    else:
        first, last = math.floor(box.low[axis] + way - GAP), math.floor(box.low[axis])

    begin = min(max(first, 0), end)
    ranges[axis] = slice(begin, min(max(last, 0), end))
    solid = SOLID[blocks[tuple(ranges)]].any(axis=tuple(a for a in range(3) if a != axis))
    return begin + np.flatnonzero(solid)


def slide(blocks: np.ndarray, box: Box, axis: int, way: float) -> float:
    """Move a box along an axis by up to ``way``, and return how far it went.

    It stops GAP before the first solid block. Blocks that it is in already do not stop it.
    """
    if way == 0.0:
        return 0.0
    face = box.high[axis] if way > 0 else box.low[axis]
    stops = _solid_ahead(blocks, box, axis, way)
    if way > 0 and len(stops):
        way = min(way, max(int(stops[0]) - GAP - face, 0.0))
    elif way < 0 and len(stops):
        way = max(way, min(int(stops[-1]) + 1 + GAP - face, 0.0))
    elif axis == 2 and face + way < GAP:  # the rock below the world
        way = max(way, min(GAP - face, 0.0))

    box.shift(axis, way)
    return way


def freed(place: Place, body: Body, eye: float) -> Body:
    """Return the body, set on top of what it is in if it is in something solid."""
    body = within(place, body)
    box = box_of(body, eye)
    while solid_within(place.blocks, box):
        box.shift(2, math.floor(box.low[2]) + 1 + GAP - box.low[2])
    return replace(body, y=box.low[2])


def within(place: Place, body: Body) -> Body:
    """Return the body on the map."""
    last = len(place.blocks) - place.margin
    x, z = (min(max(each, place.margin), last) for each in (body.x, body.z))
    return replace(body, x=x, z=z)


def moved(place: Place, body: Body, wish: Wish, seconds: float) -> Body:
    """Return the body ``seconds`` later."""
    body = freed(place, body, wish.eye)
    count = min(max(math.ceil(seconds / SLICE - 1e-9), 1), MOST_SLICES)
    for _ in range(count):
        if wish.flying:
            body = flown(place, body, wish, seconds / count)
        else:
            body = walked(place, body, wish, seconds / count)
    return body


def flown(place: Place, body: Body, wish: Wish, seconds: float) -> Body:
    """Return a flying body ``seconds`` later: nothing pulls it down, but blocks stop it."""
    box = box_of(body, wish.eye)
    for axis, way in enumerate((*level_ways(place, body, wish, seconds), wish.up * seconds)):
        slide(place.blocks, box, axis, way)
    # Not below the water, nor higher than the map is wide: from there all of it is in view.
    low = max(place.water - AFLOAT * wish.eye, place.floor)
    slide(place.blocks, box, 2, max(low - box.low[2], 0.0))
    slide(place.blocks, box, 2, min(max(float(len(place.blocks)), low) - box.low[2], 0.0))
    return settled(place, box, Body(0.0, box.low[2], 0.0, lag=eased(body.lag, seconds)), wish.eye)


def walked(place: Place, body: Body, wish: Wish, seconds: float) -> Body:
    """Return a body ``seconds`` later that walks, jumps, falls or swims."""
    blocks, box = place.blocks, box_of(body, wish.eye)
    floating = place.water - AFLOAT * wish.eye
    afloat = body.y < floating + GAP
    deep = min(max(place.water - body.y, 0.0) / (AFLOAT * wish.eye), 1.0)
    level = seconds * (1.0 - (1.0 - WADE) * deep)
    lag = eased(body.lag, seconds)

    rising = JUMP if wish.jump and body.grounded and not afloat else body.rising
    stands = (body.grounded or afloat) and rising <= 0.0
    ways = level_ways(place, body, wish, level)
    lag += walked_level(blocks, box, ways, BANK if afloat else STEP, stands)
    if body.grounded and stands and not afloat:
        lag -= stepped_down(blocks, box, place.floor)

    if afloat and rising <= 0.0:
        slide(blocks, box, 2, swum(floating - box.low[2], wish, seconds))
        rising, grounded = 0.0, False
    else:
        fall = max(rising - GRAVITY * seconds, -FASTEST)
        way = (rising + fall) / 2 * seconds
        # Water stops a fall a little below the level at which one swims.
        lowest = min(max(floating - DIP, place.floor) - box.low[2], 0.0)
        stopped = abs(slide(blocks, box, 2, max(way, lowest)) - way) > 1e-9
        grounded = stopped and way < 0.0 and box.low[2] >= floating
        rising = 0.0 if stopped else fall
    swimming = box.low[2] < floating + SHALLOW
    return settled(
        place, box, Body(0.0, box.low[2], 0.0, rising, lag, grounded, swimming), wish.eye
    )


def swum(up: float, wish: Wish, seconds: float) -> float:
    """Return how far a swimmer goes up in some seconds, whose place at the surface is ``up`` up."""
    if wish.dive:
        return -DOWNWARDS * seconds
    most = (UPWARDS if wish.jump else RISE) * seconds
    return min(up * -math.expm1(-BUOYANCY * seconds), most)


def settled(place: Place, box: Box, body: Body, eye: float) -> Body:
    """Return a body where its box is, with its eye below the roof."""
    x, z = ((box.low[axis] + box.high[axis]) / 2 for axis in (0, 1))
    lag = min(body.lag, DUCK * eye)
    body = replace(body, x=x, z=z, lag=lag)
    if body.lag < 0.0:
        body = replace(body, lag=-slide(place.blocks, box_of(body, eye), 2, -body.lag))
    return body


def eased(lag: float, seconds: float) -> float:
    """Return how far the eye is from its place some seconds later."""
    lag *= math.exp(-EASE * seconds)
    return lag if abs(lag) > 1e-3 else 0.0


def level_ways(place: Place, body: Body, wish: Wish, seconds: float) -> tuple[float, float]:
    """Return how far east and south a body wants to go in some seconds, not beyond the map."""
    to = Body(body.x + wish.east * seconds, 0.0, body.z + wish.south * seconds)
    to = within(place, to)
    return to.x - body.x, to.z - body.z


def walked_level(
    blocks: np.ndarray, box: Box, ways: tuple[float, float], step: float, stands: bool
) -> float:
    """Move a box level, up steps if it ``stands``; return how far it has climbed."""
    raised = Box(list(box.low), list(box.high))
    gone = [slide(blocks, box, axis, way) for axis, way in enumerate(ways)]
    if not stands or all(abs(g - w) < 1e-9 for g, w in zip(gone, ways, strict=True)):
        return 0.0
    slide(blocks, raised, 2, step)
    further = [slide(blocks, raised, axis, way) for axis, way in enumerate(ways)]
    if math.hypot(*further) < math.hypot(*gone) + 1e-6:
        return 0.0
    slide(blocks, raised, 2, box.low[2] - raised.low[2])
    climbed = raised.low[2] - box.low[2]
    box.low, box.high = raised.low, raised.high
    return climbed


def stepped_down(blocks: np.ndarray, box: Box, floor: float) -> float:
    """Set a box down on ground at most a step lower; return how far that was, 0 at a drop."""
    lowest = min(floor - box.low[2], 0.0)
    down = -slide(blocks, box, 2, max(-STEP, lowest))
    if down > STEP - 1e-6:
        box.shift(2, down)
        return 0.0
    return down
