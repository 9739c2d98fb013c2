"""Blades of grass as arrays: their shape, colour and places in the wind; no OpenGL (section 5.3).

A blade is a strip of five vertices: two feet, two shoulders, a tip. With ``grass.facing`` its wide
side turns to the viewer: its direction d on the map becomes (1 - f) d + f r, where r is at right
angles to the line from the eye to the blade, both of length 1. Over f = 0.5 the sum never points
along that line, whatever d, and changes smoothly as one walks: no blade is a line, and none flips
over (section 11.2.2).
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from landscape.elements.sprites.sprite_quads import sway
from landscape.frame import Frame

NEAR = 0.28  # chosen: units within which, with grass.fade, every blade of a dense meadow is drawn
DENSE = 3_600.0  # chosen: blades on a square unit; 1,500,000 on the island
SPARSE = 0.4  # chosen: in one with k times fewer blades it is k**SPARSE as far
WIDENING = 0.5  # chosen: blades that reach k times as far are k**WIDENING as wide
FOOT = 0.75  # chosen: how light a tinted blade is at its foot, in parts of the ground's colour
TALLEST = 0.02  # section 5.3.2: height of the tip in units, before scaling
# A strip of five vertices is three triangles; the winding of the second is turned as in a strip.
STRIP_TRIANGLES = np.array([0, 1, 2, 2, 1, 3, 2, 3, 4], np.uint32)
LUSH = np.array([-0.16, -0.03, -0.10])  # chosen: what tall grass has more of the ground's colour
WIND = ((2, np.float32(0.5)), (3, np.float32(0.5)), (4, np.float32(1.0)))  # section 5.3.2:
# vertex, and the part of the wind it takes
SIDES = np.array([-1.0, 1.0, -0.5, 0.5], np.float32)  # of a blade's feet and shoulders
COORDINATES = np.array([(0, 1), (1, 1), (0.2, 0.3), (0.8, 0.3), (0.5, 0)], np.float32)


def blade_vertices(
    positions: np.ndarray,
    angles: np.ndarray,
    scale: tuple[float, ...] = (1.0, 1.0),
    arch: float = 1.0,
) -> np.ndarray:
    """Return still blades, float32 (n, 5, 3), standing at positions (n, 3), turned by angles (n,).

    ``scale`` = (sx, sy) stretches (x and z, y), as glScalef(sx, sy, sx) in section 5.3.2. The
    report bends the tip alone; an ``arch`` above 1 bends it so many times as far, and the middle
    a third of what is added.
    """
    c, s = np.cos(angles), np.sin(angles)
    zero = np.zeros_like(c)
    middle = 0.004 * (arch - 1.0) / 3.0
    corners = [
        (-0.003 * c, zero, -0.003 * s),
        (0.003 * c, zero, 0.003 * s),
        (-0.0015 * c + middle * s, zero + 0.015, -0.0015 * s + middle * c),
        (0.0015 * c + middle * s, zero + 0.015, 0.0015 * s + middle * c),
        (0.004 * arch * s, zero + TALLEST, 0.004 * arch * c),
    ]
    blades = np.stack([np.stack(corner, axis=1) for corner in corners], axis=1)
    blades *= np.array([scale[0], scale[1], scale[0]])
    return np.ascontiguousarray(blades + positions[:, None, :], np.float32)


def blade_wind(kt: float, positions: np.ndarray, scale_x: float) -> np.ndarray:
    """Return dx, dz (n, 2) of the tips: a fifth of the plants' sway (section 5.3.2)."""
    return sway(kt, positions, scale_x / 5.0)


def nearness(density: float) -> float:
    """Return the units within which every blade is drawn, by the blades on a square unit.

    A sparse meadow is thinned out later than a dense one, so that far grass is there in both; but
    not so late that it would show, and cost, as much.
    """
    return NEAR * max(DENSE / max(density, 1e-9), 1.0) ** SPARSE


def thinned_reach(count: int, near: float, radius: float) -> np.ndarray:
    """Return how far each of a cell's blades is drawn, (count,) in 0..1 times ``radius``, falling.

    All up to ``near`` units; beyond, as many as keep the number per pixel the same: the part left
    at distance d is (near / d) squared.
    """
    part = (np.arange(count) + 1.0) / max(count, 1)
    return np.asarray(np.minimum(near / np.sqrt(part) / radius, 1.0))


def drawn_at(count: int, near: float, distance: float) -> int:
    """Return how many of a cell's ``count`` blades reach ``distance`` units (thinned_reach)."""
    return int(np.ceil(count * min(near / max(distance, 1e-6), 1.0) ** 2))


def facing(columns: np.ndarray, away: np.ndarray, part: float) -> None:
    """Turn blades in place: their wide side to the viewer by ``part``. They keep width and tip.

    ``columns``, float32 (5, 3, n), holds each coordinate of each vertex as a row of its own;
    ``away`` (2, n) is x, z from the eye to each blade.
    """
    # Directions on the map as complex numbers, x + i z: one operation for both coordinates.
    half = complexes(*(columns[1, ::2] - columns[0, ::2]) / 2)
    sight = complexes(*away)
    width = np.abs(half)
    across = sight * np.complex64(1j * part)
    turned = half * np.float32(1.0 - part) + across * (width / np.maximum(np.abs(sight), 1e-6))
    moved = turned * (width / np.maximum(np.abs(turned), 1e-9)) - half
    for vertex, side in enumerate(SIDES):
        columns[vertex, 0] += side * moved.real
        columns[vertex, 2] += side * moved.imag


def complexes(real: np.ndarray, imaginary: np.ndarray) -> np.ndarray:
    """Return complex64 (n,) of these parts."""
    out = np.empty(len(real), np.complex64)
    out.real, out.imag = real, imaginary
    return out


def meadow(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return -1..1 at x, z in units: where grass grows tall and where it stays short (chosen)."""
    warp = 0.8 * np.sin(1.7 * z + 0.6 * x)
    return np.asarray(
        0.6 * np.sin(2.3 * x + warp) * np.sin(1.9 * z - warp) + 0.4 * np.sin(5 * x - 4 * z)
    )


@dataclass(frozen=True)
class Patch:
    """The blades of one cell: places (n, 3), still blades (n, 5, 3), tints (n, 5, 4), reach (n,).

    A blade is drawn up to ``reach`` times the radius; the farthest-reaching come first.
    """

    positions: np.ndarray
    blades: np.ndarray
    tints: np.ndarray
    reach: np.ndarray

    @cached_property
    def columns(self) -> np.ndarray:
        """The still blades as (5, 3, n): what is reckoned of all is reckoned a row at a time."""
        return np.ascontiguousarray(self.blades.transpose(1, 2, 0))

    @cached_property
    def places(self) -> np.ndarray:
        """The places as (3, n)."""
        return np.ascontiguousarray(self.positions.T)


NOTHING = Patch(
    np.empty((0, 3), np.float32), np.empty((0, 5, 3), np.float32), np.empty((0, 5, 4), np.uint8),
    np.empty(0, np.float32),
)  # fmt: skip


def hues(count: int, rng: np.random.Generator) -> np.ndarray:
    """Return factors on the ground's colour (count, 3): most tufts greener, one in eight straw."""
    green = np.array([0.90, 1.03, 0.84]) * rng.uniform(0.78, 1.12, (count, 1))
    straw = np.array([1.22, 1.10, 1.00]) * rng.uniform(0.80, 1.10, (count, 1))
    return np.where(rng.random((count, 1)) < 1 / 8, straw, green)


def blade_tints(
    colour: np.ndarray,
    rng: np.random.Generator,
    upper: np.ndarray | float = 0.4,
    foot: np.ndarray | float = 0.4,
) -> np.ndarray:
    """Return tints, uint8 (n, 5, 3), for blades on ground of colours (n, 3), darker at the foot.

    ``upper`` and ``foot`` (3,) are the texture's mean colours there. Drawn at twice texture times
    tint, a blade has above the ground's own colour, a little lighter or darker by lot, and FOOT
    times as much where it meets it: none seems stuck on.
    """
    light = colour * rng.uniform(0.92, 1.28, (len(colour), 1)) / (2.0 * np.asarray(upper))
    tints = np.repeat(light[:, None, :], 5, axis=1)
    tints[:, :2] *= FOOT * np.asarray(upper) / np.asarray(foot)
    return (np.clip(tints, 0, 1) * 255).astype(np.uint8)


def within(frame: Frame, patch: Patch, radius: float, spare: float = 0.0) -> Patch:
    """Return the blades of a patch that reach the walker's place: a cell's nearest point decided.

    Blades whose foot is behind the eye go as well, as far behind as a blade is tall. ``spare`` is
    how far the eye may still move.
    """
    dx, dz = patch.positions[:, 0] - frame.pose.x, patch.positions[:, 2] - frame.pose.z
    reach = np.float32(radius) * patch.reach + np.float32(spare)
    behind = 0.1 + 1.5 * spare
    kept = np.flatnonzero(
        (dx * dx + dz * dz < reach * reach) & (frame.depth(patch.positions) < behind)
    )
    parts = (patch.positions, patch.blades, patch.tints, patch.reach)
    return Patch(*(part[kept] for part in parts))


def joined(patches: list[Patch]) -> Patch:
    """Return the blades of several patches as one."""
    names = ("positions", "blades", "tints", "reach")
    return Patch(*(np.concatenate([getattr(patch, name) for patch in patches]) for name in names))
