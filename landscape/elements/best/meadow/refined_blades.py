"""Blades of the meadow as arrays: bent further, thinned out and tinted.

The blade of 2006 and its wind are in ``elements/grass.py``; facing.py turns blades to the viewer.
No OpenGL here.
"""

import math
from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np

from landscape.frame import Frame

NEAR = 0.28  # chosen: units within which, with grass.fade, every blade of a dense meadow is drawn
DENSE = 3_600.0  # chosen: blades per square unit; 1,500,000 on the island
THINNING = 2.0  # chosen: the number of blades per pixel then stays the same
SPARSE = 0.4  # chosen: with k times fewer blades, NEAR is multiplied by k**SPARSE
WIDENING = 0.5  # chosen: blades that are drawn k times as far away are k**WIDENING times as wide
THICKER = (
    0.25  # chosen: if only a fraction of the blades is drawn, they are fraction**-THICKER wide
)
ORDERED = 65_535  # steps of distance by which blades are ordered
SWAYING = 0.02  # chosen: units that wind and its lean may take a blade's tip aside
FOOT = 0.75  # chosen: brightness of a tinted blade at its foot, times the ground's
LUSH = np.array([-0.16, -0.03, -0.10])  # chosen: change of the ground's colour for tall grass


def arched(corners: np.ndarray, arch: float) -> np.ndarray:
    """Return blades (n, 5, 3) at the origin whose tips bend ``arch`` times as far.

    The report bends the tip alone; the shoulders get a third of what is added.
    """
    more = np.zeros_like(corners)
    more[:, 4, ::2] = (arch - 1.0) * corners[:, 4, ::2]
    more[:, 2:4] = more[:, 4:] / 3.0
    return np.asarray(corners + more)


def nearness(density: float) -> float:
    """Return the units within which every blade is drawn, by the blades per square unit.

    Thinning out begins farther away in a sparse meadow than in a dense one, so that distant grass
    is visible in both; but not so far away that the sparse one would look as dense and cost as
    much.
    """
    return NEAR * max(DENSE / max(density, 1e-9), 1.0) ** SPARSE


def thinned_ranges(
    count: int, near: float, first: int, last: int, thinning: float = THINNING
) -> np.ndarray:
    """Return how far away the blades ``first`` to ``last`` of a cell's ``count`` would be drawn.

    In units, (last - first,).

    All up to ``near`` units; beyond, the fraction left at distance d is (near / d)**thinning. The
    blades with the longest range come first. The
    radius of the grass, which is not applied here, limits all of them.
    """
    fraction = (np.arange(first, last) + 1.0) / max(count, 1)
    return np.asarray(near * fraction ** (-1.0 / thinning))


def count_at(
    count: np.ndarray,
    near: float,
    distance: np.ndarray,
    fraction: float = 1.0,
    thinning: float = THINNING,
) -> np.ndarray:
    """Return how many of the cells' ``count`` (n,) blades are drawn at ``distance`` (n,) units.

    Of these only the ``fraction`` with the longest ranges.
    """
    left = np.minimum(near / np.maximum(distance, 1e-6), 1.0) ** thinning
    return np.ceil(count * (left * fraction)).astype(int)


def shortened(
    ranges: np.ndarray, radius: float, fraction: float, thinning: float = THINNING
) -> np.ndarray:
    """Return how far away blades are drawn, float32 (n,) in units, if ``fraction`` of them are.

    The ranges shrink by a root of the fraction, so at each distance that fraction is left.
    """
    shorter = np.minimum(ranges * np.float32(fraction ** (1.0 / thinning)), np.float32(radius))
    return np.maximum(shorter, np.float32(1e-6))  # a range is divided by


def wider_by(fraction: float) -> float:
    """Return how many times as wide blades are drawn of which only a ``fraction`` is."""
    return float(fraction**-THICKER)


def widened(patch: "Patch", fraction: float) -> "Patch":
    """Return blades wide enough to cover more of the ground for those that are left out."""
    grown = np.array([wider_by(fraction), 1.0, wider_by(fraction)], np.float32)
    feet = patch.positions[:, None]
    vertices = (patch.vertices - feet) * grown + feet
    return replace(patch, vertices=vertices, sizes=patch.sizes * grown[0])


def lushness(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return -1..1 at x, z in units: where grass grows tall and where it stays short (chosen)."""
    warp = 0.8 * np.sin(1.7 * z + 0.6 * x)
    return np.asarray(
        0.6 * np.sin(2.3 * x + warp) * np.sin(1.9 * z - warp) + 0.4 * np.sin(5 * x - 4 * z)
    )


def sizes_of(corners: np.ndarray) -> np.ndarray:
    """Return how far the farthest of corners (5, 3, n) is from the origin, float32 (n,)."""
    return np.sqrt((corners * corners).sum(axis=1).max(axis=0)).astype(np.float32)


def hues(green: np.ndarray, straw: np.ndarray, pale: np.ndarray) -> np.ndarray:
    """Return factors on the ground's colour (n, 3): most tufts greener, one in eight straw.

    By random numbers (n,) in 0..1: how light each would be as either, and which it is.
    """
    greens = np.array([0.90, 1.03, 0.84]) * (0.78 + (1.12 - 0.78) * green)[:, None]
    straws = np.array([1.22, 1.10, 1.00]) * (0.80 + (1.10 - 0.80) * straw)[:, None]
    return np.where(pale[:, None] < 1 / 8, straws, greens)


def blade_tints(
    colour: np.ndarray,
    brightness: np.ndarray,
    upper: np.ndarray | float = 0.4,
    foot: np.ndarray | float = 0.4,
) -> tuple[np.ndarray, np.ndarray]:
    """Return the tints (n, 3), 0..1, of blades on ground of colours (n, 3): at the foot, and above.

    ``upper`` and ``foot`` (3,) are the texture's mean colours there. Drawn at twice texture times
    tint, the upper part of a blade has the ground's own colour times its ``brightness`` (n,). Its
    foot is FOOT times as bright, so that no blade looks pasted on.
    """
    light = colour * brightness[:, None] / (2.0 * np.asarray(upper))
    return light * (FOOT * np.asarray(upper) / np.asarray(foot)), light


def packed(colours: np.ndarray) -> np.ndarray:
    """Return colours (3, n), 0..1 or clipped, as OpenGL's four bytes in one uint32 (n,), opaque."""
    out = np.full((colours.shape[1], 4), 255, np.uint8)
    out[:, :3] = (np.clip(colours, 0, 1) * 255).T
    return out.view(np.uint32)[:, 0]


@dataclass(frozen=True)
class Patch:
    """Blades: places (n, 3), vertices without wind (n, 5, 3), tints (n, 2), ranges (n,).

    Tints are a colour for the feet and one for what is above, see :func:`packed`. A blade is drawn
    up to its range in units, or the radius if that is less. ``kinds`` (n,) are those of the sward,
    see :mod:`sward`. ``sizes`` (n,) is how many units from its place a blade's farthest vertex is.
    """

    positions: np.ndarray
    vertices: np.ndarray
    tints: np.ndarray
    ranges: np.ndarray
    kinds: np.ndarray
    sizes: np.ndarray

    @cached_property
    def columns(self) -> np.ndarray:
        """The vertices as (5, 3, n), for what is computed for all blades a row at a time."""
        return np.ascontiguousarray(self.vertices.transpose(1, 2, 0))

    @cached_property
    def places(self) -> np.ndarray:
        """The places as (3, n)."""
        return np.ascontiguousarray(self.positions.T)

    def colours(self) -> np.ndarray:
        """Return the tints of all vertices, uint8 (n, 5, 4)."""
        out = np.empty((len(self.tints), 5), np.uint32)
        out[:, :2] = self.tints[:, :1]
        out[:, 2:] = self.tints[:, 1:]
        return out.view(np.uint8).reshape(-1, 5, 4)


ARRAYS = tuple(array.name for array in fields(Patch))
NOTHING = Patch(
    np.empty((0, 3), np.float32),
    np.empty((0, 5, 3), np.float32),
    np.empty((0, 2), np.uint32),
    np.empty(0, np.float32),
    np.empty(0, np.uint8),
    np.empty(0, np.float32),
)


def showing(
    frame: Frame,
    places: np.ndarray,
    ranges: np.ndarray,
    sizes: np.ndarray,
    widening: tuple[float, float] = (1.0, 0.0),
    margin: float = 0.0,
    angle: float = 0.0,
) -> np.ndarray:
    """Return the numbers (k,) of blades in range and in view; their feet are at ``places`` (3, n).

    ``ranges`` (n,) is how far away each is drawn, and ``sizes`` (n,) how far its corners are from
    its foot, close by and in still air; d units away at most ``widening`` = (a, b): a + b d times
    as far. ``margin`` units is how far the eye may still move, and ``angle`` radians how far it may
    turn.
    """
    x, y, z = places - frame.eye.astype(np.float32)[:, None]
    near = x * x + z * z
    reach = ranges + np.float32(margin)
    found = np.flatnonzero(near < reach * reach)
    x = x[found]
    y = y[found]
    z = z[found]
    near = near[found]

    def along(axis: np.ndarray) -> np.ndarray:
        a, b, c = axis.astype(np.float32)
        return np.asarray(a * x + b * y + c * z)

    top = math.tan(math.radians(frame.fov / 2))
    depth = -along(frame.back)
    # A card that is far away is widened, see the sward.
    close, more = map(np.float32, widening)
    reach = sizes[found] * (close + more * np.sqrt(near)) + np.float32(SWAYING + margin)
    seen = depth > -reach
    for axis, side in ((frame.right, top * frame.size[0] / frame.size[1]), (frame.up, top)):
        side = math.tan(min(math.atan(side) + angle, 1.5))  # less than a right angle
        seen &= np.abs(along(axis)) <= depth * np.float32(side) + reach * np.float32(
            math.hypot(1.0, side)
        )
    return np.asarray(found[seen])


def nearest_first(frame: Frame, places: np.ndarray) -> np.ndarray:
    """Return the order (n,) in which blades at ``places`` (3, n) are drawn: the nearest first.

    What is near hides much of what is far. Of blades at one depth the first is seen: the order
    depends on this frame alone, and where it leaves two equal, they stay as they are.
    """
    x, z = (places[k] - np.float32(at) for k, at in ((0, frame.pose.x), (2, frame.pose.z)))
    away = np.sqrt(x * x + z * z)
    # Whole numbers of 16 bits are sorted in a tenth of the time.
    steps = np.float32(ORDERED / max(float(away.max(initial=0.0)), 1e-6))
    return np.argsort((away * steps).astype(np.uint16), kind="stable")
