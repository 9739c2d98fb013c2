"""The colour of each pixel of filled mode: ground, water, haze and sky, looked up and blended.

All colours are uint32, red in the lowest byte. Red and blue are blended at once, as two numbers in
one, and green beside them: half the multiplications.
"""

from dataclasses import dataclass

import numpy as np

from landscape.flyover.look import Look
from landscape.flyover.settings import Settings

PAIR, MIDDLE = np.uint32(0x00FF00FF), np.uint32(0x0000FF00)
OPAQUE = np.uint32(0xFF000000)
SLANT = 2.0  # texels that a pixel may hold before the next smaller copy is taken, chosen
CLOSE = 60.0  # distance up to which the grain of the ground is seen, units, chosen


@dataclass(frozen=True)
class Scene:
    """What :mod:`.march` found: heights above the eye (s, c), which step fills each pixel (r, c).

    ``distances`` (s,) are those of the steps. ``forward`` and ``right`` (2,) span the plane.
    """

    heights: np.ndarray
    filled: np.ndarray
    distances: np.ndarray
    forward: np.ndarray
    right: np.ndarray
    eye: tuple[float, float, float]


def blend(one: np.ndarray, other: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Return colours (n,) blended towards others by weights (n,), uint32 of 0..256."""
    rest = np.uint32(256) - weight
    pair = (one & PAIR) * rest
    pair += (other & PAIR) * weight
    pair >>= np.uint32(8)
    pair &= PAIR
    middle = ((one & MIDDLE) >> np.uint32(8)) * rest
    middle += ((other & MIDDLE) >> np.uint32(8)) * weight
    middle &= MIDDLE
    pair |= middle
    return pair


class Colouring:
    """The tables of one frame, and the colours of its pixels."""

    def __init__(self, scene: Scene, look: Look, settings: Settings, lateral: np.ndarray) -> None:
        self.scene, self.look, self.switches = scene, look, settings.filled
        visible = settings.flyover.visible
        far = scene.distances
        pyramid = look.ground
        texel = pyramid.period / (1 << pyramid.bits)
        pixel = float(lateral[1] - lateral[0])
        # The ground is seen at a slant: along the ray a pixel holds more of it than across.
        wide = SLANT * pixel * far / texel
        level = np.log2(np.maximum(wide, 1)) if self.switches.levels else far * 0
        self.level = np.minimum(level.astype(np.int64), pyramid.bits)
        haze = 1 - np.exp(-((far * (2.3 / visible)) ** 1.4))
        haze = haze / haze[-1] if self.switches.fog else far * 0
        self.haze = (haze * 256 + 0.5).astype(np.uint32)
        columns = look.sky.shape[1]
        turn = np.arctan2(
            scene.forward[1] + scene.right[1] * lateral, scene.forward[0] + scene.right[0] * lateral
        )
        self.azimuth = (turn / (2 * np.pi) % 1 * columns).astype(np.int64) % columns
        self.horizon = look.sky[0].take(self.azimuth)
        self.flat = look.sky.ravel()

    def band(self, at: np.ndarray, slope: np.ndarray, lateral: np.ndarray) -> np.ndarray:
        """Return the colours of some pixels, all arrays (n, w).

        ``at`` is their place among the scene's rows and columns, ``slope`` the rise of their rays
        and ``lateral`` their direction to the right, per unit of distance.
        """
        shape = at.shape
        at, slope, lateral = at.ravel(), slope.ravel(), lateral.ravel()
        columns = self.scene.filled.shape[1]
        step = self.scene.filled.ravel().take(at)
        ground = np.flatnonzero(step < len(self.scene.distances))
        out = np.empty(len(at), np.uint32)
        if len(ground) < len(at):
            sky = np.flatnonzero(step == len(self.scene.distances))
            out[sky] = self.sky(at[sky] % columns, slope[sky], lateral[sky])
        if len(ground):
            if len(ground) < len(at):
                at, slope, lateral, step = at[ground], slope[ground], lateral[ground], step[ground]
            out[ground] = self.ground(at % columns, step.astype(np.int64), slope, lateral)
        return (out | OPAQUE).reshape(shape)

    def sky(self, column: np.ndarray, slope: np.ndarray, lateral: np.ndarray) -> np.ndarray:
        """Return the sky's colours along rays (n,)."""
        rows, columns = self.look.sky.shape
        tangent = np.maximum(slope, 0) / np.sqrt(1 + lateral * lateral)
        row = (tangent / (1 + tangent) * rows).astype(np.int64)
        return self.flat.take(row * columns + self.azimuth.take(column), mode="clip")

    def ground(
        self, column: np.ndarray, step: np.ndarray, slope: np.ndarray, lateral: np.ndarray
    ) -> np.ndarray:
        """Return the ground's colours along rays (n,) that meet it at or just before a step."""
        scene, look = self.scene, self.look
        away = self.distance(column, step, slope)
        sideways = away * lateral
        scale = np.float32((1 << look.ground.bits) / look.ground.period)
        size = 1 << look.ground.bits
        places = []
        for axis in (0, 1):
            start = np.float32(scene.eye[axis] % look.ground.period)
            place = away * scene.forward[axis]
            place += sideways * scene.right[axis]
            place += start
            places.append(place)
        x, y = (place * scale for place in places)
        colour = self.texels(x, y, self.level.take(step))
        colour = self.close_up(colour, x, y, away, size)
        if self.switches.reflection:
            colour = self.mirror(colour, column, slope, lateral, away, places)
        if self.switches.fog:
            colour = blend(colour, self.horizon.take(column), self.haze.take(step))
        return colour

    def distance(self, column: np.ndarray, step: np.ndarray, slope: np.ndarray) -> np.ndarray:
        """Return how far along the level line of sight rays (n,) meet the ground.

        Between two steps the ground is a straight line; not smooth, it is a block.
        """
        scene = self.scene
        there = scene.distances.take(step)
        if not self.switches.smooth:
            return there
        before = np.maximum(step - 1, 0)
        columns = scene.heights.shape[1]
        heights = scene.heights.ravel()
        here = scene.distances.take(before)
        gap = slope * here - heights.take(before * columns + column)
        closing = gap - slope * there + heights.take(step * columns + column)
        part = gap / np.maximum(closing, np.float32(1e-6))
        np.clip(part, 0, 1, out=part)
        there -= here
        part *= there
        part += here
        return part

    def texels(self, x: np.ndarray, y: np.ndarray, level: np.ndarray) -> np.ndarray:
        """Return the nearest texels of the ground's picture at x, y (n,), of each pixel's level."""
        pyramid = self.look.ground
        size = 1 << pyramid.bits
        column = np.floor(x).astype(np.int64) & (size - 1)
        row = np.floor(y).astype(np.int64) & (size - 1)
        column >>= level
        row >>= level
        row <<= pyramid.bits - level
        row += column
        row += pyramid.offsets.take(level)
        return pyramid.texels.take(row, mode="clip")

    def close_up(
        self, colour: np.ndarray, x: np.ndarray, y: np.ndarray, away: np.ndarray, size: int
    ) -> np.ndarray:
        """Return colours (n,) with those close by blended between texels, and with their grain."""
        if not self.switches.smooth:
            return colour
        near = np.flatnonzero(away < CLOSE)
        if not len(near):
            return colour
        x, y, away = x[near] - np.float32(0.5), y[near] - np.float32(0.5), away[near]
        left, top = np.floor(x), np.floor(y)
        u, v = (((a - b) * 256).astype(np.uint32) for a, b in ((x, left), (y, top)))
        column, row = left.astype(np.int64), top.astype(np.int64)
        mask = size - 1
        rows = (row & mask) * size, (row + 1 & mask) * size
        places = column & mask, column + 1 & mask
        texels = self.look.ground.texels
        upper, lower = (
            blend(texels.take(r + places[0]), texels.take(r + places[1]), u) for r in rows
        )
        water = colour[near] & OPAQUE
        smooth = blend(upper, lower, v)
        grain = self.look.grain
        n = len(grain)
        dark = np.zeros(len(near), np.float32)
        for repeats, reach in ((5.0, CLOSE), (37.0, CLOSE / 5)):
            a = np.floor(x * np.float32(repeats)).astype(np.int64) & (n - 1)
            b = np.floor(y * np.float32(repeats)).astype(np.int64) & (n - 1)
            fade = np.clip(1 - away * np.float32(1 / reach), 0, 1)
            dark += fade * grain.ravel().take(b * n + a)
        wet = (water >> np.uint32(24)).astype(np.float32) * np.float32(1 / 255)
        weight = (dark * (1 - wet) * np.float32(0.28)).astype(np.uint32)
        colour[near] = blend(smooth, np.zeros_like(smooth), np.minimum(weight, 256)) | water
        return colour

    def mirror(
        self,
        colour: np.ndarray,
        column: np.ndarray,
        slope: np.ndarray,
        lateral: np.ndarray,
        away: np.ndarray,
        places: list[np.ndarray],
    ) -> np.ndarray:
        """Return colours (n,) with the sky mirrored in what is water, more so at grazing angles."""
        wet = colour >> np.uint32(24)
        water = np.flatnonzero(wet)
        if not len(water):
            return colour
        down = np.maximum(-slope[water], 0)
        grain = self.look.grain
        n = len(grain)
        ripple = np.zeros(len(water), np.float32)
        for repeats in (3.0, 13.0):
            a, b = (
                np.floor(p[water] * np.float32(repeats)).astype(np.int64) & (n - 1) for p in places
            )
            ripple += grain.ravel().take(b * n + a)
        ripple -= 255
        ripple *= np.float32(0.0006) / (1 + away[water] * np.float32(0.02))
        tangent = down / np.sqrt(1 + lateral[water] ** 2)
        fresnel = np.float32(0.02) + np.float32(0.98) * (1 - tangent / np.sqrt(1 + tangent**2)) ** 5
        sky = self.sky(column[water], np.maximum(down + ripple, np.float32(0.01)), lateral[water])
        weight = (fresnel * wet[water] * np.float32(0.9)).astype(np.uint32)
        colour[water] = blend(colour[water], sky, weight)
        return colour
