"""The colour of each pixel of filled mode: ground, water, haze and sky, looked up and blended.

All colours are uint32, red in the lowest byte. Red and blue are blended at once, as two numbers in
one, and green beside them: half the multiplications.
"""

import math
from dataclasses import dataclass

import numpy as np

from landscape.flyover.ground import WET
from landscape.flyover.look import Look
from landscape.flyover.rock import BITS, SIDE, THICK, WIDE
from landscape.flyover.settings import Settings
from landscape.flyover.shores import ACROSS, PLACES, STRIDE, Shores

PAIR, MIDDLE = np.uint32(0x00FF00FF), np.uint32(0x0000FF00)
OPAQUE = np.uint32(0xFF000000)
WATER, COVER = np.uint32(WET << 24), np.uint32(0x7F)  # a texel of water; how much of it is water
SLANT = 2.0  # texels that a pixel may hold before the next smaller copy is taken, chosen
FRESNEL = 1024  # entries of the table of how much water mirrors, by the angle
MIRROR = 0.9  # of the light that smooth water mirrors, chosen
RIPPLES = 0.0006  # how much they incline the water, chosen
ROCK_BELOW = 1024  # pictures of rock below the eye, chosen: deeper than any ground
GRAIN = 0.28  # how dark the darkest grains are, chosen
FOOT = np.uint32(0x7F343E44)  # the colour of rock at the water, chosen
INTO = np.float32(2.5)  # so many texels into a wall there is no water, chosen
ASHORE = 0.12  # how far above the water there is none, units, chosen
BARE = np.uint32(0x00404A4C)  # the colour of a rock that is mirrored, chosen
ROCKY = np.uint32(6 << 24)  # a texel with so much rock has layers, chosen
CLOSE = 60.0  # distance up to which the grain of the ground is seen, units, chosen


@dataclass(frozen=True)
class Scene:
    """What :mod:`.march` found: heights above the eye (s, c), which step fills each pixel (r, c).

    ``distances`` (s,) are those of the steps. ``forward`` and ``right`` (2,) span the plane;
    ``shores`` are the land that water mirrors.
    """

    heights: np.ndarray
    filled: np.ndarray
    distances: np.ndarray
    forward: np.ndarray
    right: np.ndarray
    eye: tuple[float, float, float]
    shores: Shores | None


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


def darker(colour: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Return colours (n,) multiplied by light (n,), uint32 of 0..256; the highest byte is 0."""
    pair = (colour & PAIR) * light
    pair >>= np.uint32(8)
    pair &= PAIR
    middle = ((colour & MIDDLE) >> np.uint32(8)) * light
    middle &= MIDDLE
    pair |= middle
    return pair


class Colouring:
    """The tables of one frame, and the colours of its pixels."""

    def __init__(
        self, scene: Scene, look: Look, settings: Settings, lateral: np.ndarray, pixel: float
    ) -> None:
        """Prepare a frame whose columns go to ``lateral`` (c,), ``pixel`` apart."""
        self.scene, self.look, self.switches = scene, look, settings.filled
        visible = settings.flyover.visible
        far = scene.distances
        pyramid = look.ground
        self.texel = pyramid.period / (1 << pyramid.bits)
        # The ground is seen at a slant: along the ray a pixel holds more of it than across.
        wide = SLANT * pixel * far / self.texel
        level = np.log2(np.maximum(wide, 1)) if self.switches.levels else far * 0
        self.level = np.minimum(level.astype(np.int64), pyramid.bits)
        fine = (
            np.log2(np.maximum(THICK * pixel * far / self.texel, 1))
            if self.switches.levels
            else far * 0
        )
        self.fine = np.minimum(fine.astype(np.int64), BITS)
        haze = 1 - np.exp(-((far * (2.3 / visible)) ** 1.4))
        haze = haze / haze[-1] if self.switches.fog else far * 0
        self.haze = (haze * 256 + 0.5).astype(np.uint32)
        # Whole periods make all coordinates positive: then rounding to 0 is rounding down.
        around = math.ceil(2 * float(far[-1]) / pyramid.period * max(abs(lateral)) + 1)
        self.start = [np.float32(e % pyramid.period + around * pyramid.period) for e in scene.eye]
        place = np.arange(len(far) + 1) / (STRIDE * PLACES)
        self.place, self.part = place.astype(np.int64), (place % 1).astype(np.float32)
        self.across = np.arange(len(lateral)) // ACROSS
        self.ashore = np.float32(look.sea - scene.eye[2] + ASHORE)
        # Whole pictures of rock make heights positive, too.
        self.bottom = np.float32(scene.eye[2] * THICK / self.texel % SIDE + ROCK_BELOW * SIDE)
        columns = look.sky.shape[1]
        turn = np.arctan2(
            scene.forward[1] + scene.right[1] * lateral, scene.forward[0] + scene.right[0] * lateral
        )
        self.azimuth = (turn / (2 * np.pi) % 1 * columns).astype(np.int64) % columns
        # Rise per distance over the ground, of rays that rise by 1 per level distance.
        self.flatness = (1 / np.sqrt(1 + lateral * lateral)).astype(np.float32)
        self.horizon = look.sky[0].take(self.azimuth)
        self.flat_sky, self.flat_grain = look.sky.ravel(), look.grain.ravel()
        steep = np.arange(FRESNEL) / FRESNEL * 2
        sine = steep / np.sqrt(1 + steep * steep)
        mirrored = MIRROR * (0.02 + 0.98 * (1 - sine) ** 5)
        self.fresnel = (mirrored * 256).astype(np.uint32)

    def band(
        self, at: np.ndarray, column: np.ndarray, slope: np.ndarray, lateral: np.ndarray
    ) -> np.ndarray:
        """Return the colours of some pixels, all arrays (n, w).

        ``at`` and ``column`` are their place and column in the scene, ``slope`` the rise of their
        rays and ``lateral`` their direction to the right, per unit of level distance.
        """
        shape = at.shape
        step = self.scene.filled.ravel().take(at.ravel())
        column, slope, lateral = column.ravel(), slope.ravel(), lateral.ravel()
        last = len(self.scene.distances)
        ground = np.flatnonzero(step < last)
        if len(ground) == len(step):
            return (self.ground(column, step, slope, lateral) | OPAQUE).reshape(shape)
        out = np.empty(len(step), np.uint32)
        sky = np.flatnonzero(step == last)
        out[sky] = self.sky(column.take(sky), slope.take(sky))
        if len(ground):
            rays = (each.take(ground) for each in (column, step, slope, lateral))
            out[ground] = self.ground(*rays)
        return (out | OPAQUE).reshape(shape)

    def sky(self, column: np.ndarray, slope: np.ndarray) -> np.ndarray:
        """Return the sky's colours along rays (n,)."""
        rows, columns = self.look.sky.shape
        tangent = np.maximum(slope, 0)
        tangent *= self.flatness.take(column)
        share = tangent + 1
        np.divide(tangent, share, out=tangent)
        tangent *= np.float32(rows)
        place = tangent.astype(np.int64)
        place *= columns
        place += self.azimuth.take(column)
        return self.flat_sky.take(place, mode="clip")

    def ground(
        self, column: np.ndarray, step: np.ndarray, slope: np.ndarray, lateral: np.ndarray
    ) -> np.ndarray:
        """Return the ground's colours along rays (n,) that meet it at or just before a step."""
        step = step.astype(np.int64)
        away = self.distance(column, step, slope)
        sideways = away * lateral
        x, y = (
            away * self.scene.forward[axis] + sideways * self.scene.right[axis] + self.start[axis]
            for axis in (0, 1)
        )
        x *= np.float32(1 / self.texel)
        y *= np.float32(1 / self.texel)
        colour = self.texels(x, y, self.level.take(step))
        if self.switches.smooth:
            self.close_up(colour, x, y, away)
        up = slope * away
        self.feet(colour, x, y, up, away, step)
        self.layers(colour, x, y, up, step)
        if self.switches.reflection:
            self.mirror(colour, (column, step, slope, lateral, away), x, y)
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
        columns = scene.heights.shape[1]
        heights = scene.heights.ravel()
        place = step * columns
        place += column
        above = slope * there
        np.subtract(heights.take(place), above, out=above)
        place -= columns
        here = scene.distances.take(step - 1, mode="clip")
        gap = slope * here
        gap -= heights.take(place, mode="clip")
        # ``gap`` is how far the ray is above the ground before, ``above`` how far below it then.
        above += gap
        gap /= np.maximum(above, np.float32(1e-6), out=above)
        np.maximum(gap, 0, out=gap)
        np.minimum(gap, 1, out=gap)
        there -= here
        gap *= there
        gap += here
        return gap

    def texels(self, x: np.ndarray, y: np.ndarray, level: np.ndarray) -> np.ndarray:
        """Return the nearest texels of the ground's picture at x, y (n,), of each pixel's level."""
        pyramid = self.look.ground
        mask = (1 << pyramid.bits) - 1
        column, row = x.astype(np.int64), y.astype(np.int64)
        column &= mask
        row &= mask
        column >>= level
        row >>= level
        row <<= pyramid.bits - level
        row += column
        row += pyramid.offsets.take(level)
        return pyramid.texels.take(row, mode="clip")

    def close_up(self, colour: np.ndarray, x: np.ndarray, y: np.ndarray, away: np.ndarray) -> None:
        """Blend colours (n,) close by between texels, and add the grain of the ground, in place."""
        near = np.flatnonzero((away < CLOSE) & (colour < OPAQUE))
        if not len(near):
            return
        x, y, away = x.take(near), y.take(near), away.take(near)
        dark = self.grain(x, y, 11.0) * np.clip(1 - away * np.float32(2.5 / CLOSE), 0, 1)
        dark += self.grain(x, y, 53.0) * np.clip(1 - away * np.float32(10 / CLOSE), 0, 1)
        x -= np.float32(0.5)
        y -= np.float32(0.5)
        column, row = x.astype(np.int64), y.astype(np.int64)
        x -= column
        y -= row
        u, v = (x * 256).astype(np.uint32), (y * 256).astype(np.uint32)
        bits = self.look.ground.bits
        mask = (1 << bits) - 1
        next_column, next_row = column + 1 & mask, (row + 1 & mask) << bits
        column &= mask
        row &= mask
        row <<= bits
        texels = self.look.ground.texels
        upper = blend(texels.take(row + column), texels.take(row + next_column), u)
        lower = blend(texels.take(next_row + column), texels.take(next_row + next_column), u)
        smooth = blend(upper, lower, v)
        dark *= np.float32(GRAIN)
        own = colour.take(near)
        wet = (own >> np.uint32(24) & COVER) * (own >= WATER)
        keep = 256 - (dark.astype(np.uint32) * (COVER - wet) >> np.uint32(7))
        colour[near] = darker(smooth, keep) | own & OPAQUE

    def feet(
        self,
        colour: np.ndarray,
        x: np.ndarray,
        y: np.ndarray,
        up: np.ndarray,
        away: np.ndarray,
        step: np.ndarray,
    ) -> None:
        """Draw rock where water would rise above the water, in place; all (n,).

        Texels are wider than the foot of a wall. What is there is a little further into the wall.
        """
        if not self.look.sea > -np.inf:
            return
        at = np.flatnonzero((up > self.ashore) & (colour >= WATER))
        if not len(at):
            return
        x, y, further = x.take(at), y.take(at), INTO * self.texel / away.take(at)
        x += (x - self.start[0] / self.texel) * further
        y += (y - self.start[1] / self.texel) * further
        inside = self.texels(x, y, self.level.take(step.take(at)))
        colour[at] = np.where(inside < WATER, inside, FOOT)

    def layers(
        self, colour: np.ndarray, x: np.ndarray, y: np.ndarray, up: np.ndarray, step: np.ndarray
    ) -> None:
        """Draw the layers of rock on cliffs, in place: colours (n,), ``up`` above the eye."""
        cliff = np.flatnonzero(colour - ROCKY < WATER - ROCKY)
        if not len(cliff):
            return
        own, level = colour.take(cliff), self.fine.take(step.take(cliff))
        along = x.take(cliff) * np.float32(0.83 * WIDE)
        along += y.take(cliff) * np.float32(0.57 * WIDE)
        height = up.take(cliff) * np.float32(THICK / self.texel)
        height += self.bottom
        column, row = along.astype(np.int64), height.astype(np.int64)
        column &= SIDE - 1
        row &= SIDE - 1
        column >>= level
        row >>= level
        row <<= BITS - level
        row += column
        row += self.look.rock.offsets.take(level)
        light = self.look.rock.texels.take(row, mode="clip")
        # As much less of the layers as there is less rock.
        light = np.uint32(256) - ((np.uint32(256) - light) * (own >> np.uint32(24)) >> np.uint32(7))
        colour[cliff] = darker(own, light)

    def grain(self, x: np.ndarray, y: np.ndarray, repeats: float) -> np.ndarray:
        """Return the grain's pattern at x, y (n,) in texels, uint8 (n,)."""
        n = len(self.look.grain)
        column = (x * np.float32(repeats)).astype(np.int64)
        row = (y * np.float32(repeats)).astype(np.int64)
        column &= n - 1
        row &= n - 1
        row *= n
        row += column
        return self.flat_grain.take(row)

    def mirror(
        self,
        colour: np.ndarray,
        rays: tuple[np.ndarray, ...],
        x: np.ndarray,
        y: np.ndarray,
    ) -> None:
        """Mirror sky and land in what is water, more so at grazing angles, in place; all (n,).

        ``rays`` are columns, steps, slopes, lateral directions and distances.
        """
        water = np.flatnonzero(colour >= WATER)
        if not len(water):
            return
        x, y = x.take(water), y.take(water)
        column, step, slope, lateral, away = (each.take(water) for each in rays)
        down = np.maximum(-slope, 0)
        ripple = self.grain(x, y, 1.5).astype(np.float32)
        ripple += self.grain(x, y, 7.0)
        ripple -= 255
        ripple *= np.float32(RIPPLES) / (1 + away * np.float32(0.02))
        steep = down * self.flatness.take(column)
        steep *= FRESNEL / 2
        weight = self.fresnel.take(steep.astype(np.int64), mode="clip")
        down += ripple
        up = np.maximum(down, np.float32(0.002))
        mirrored = self.sky(column, up)
        self.land(mirrored, up, column, step, lateral)
        own = colour.take(water)
        weight *= own >> np.uint32(24) & COVER
        weight >>= np.uint32(7)
        colour[water] = blend(own, mirrored, weight)

    def land(
        self,
        mirrored: np.ndarray,
        up: np.ndarray,
        column: np.ndarray,
        step: np.ndarray,
        lateral: np.ndarray,
    ) -> None:
        """Enter the land into what water mirrors, in place, where rays that rise by ``up`` meet it.

        ``column`` and ``step`` are where the water is; all (n,).
        """
        shores, far = self.scene.shores, self.scene.distances
        assert shores is not None
        columns = shores.slope.shape[1]
        at = self.place.take(step)
        at *= columns
        at += self.across.take(column)
        part = self.part.take(step)
        slope = shores.slope.ravel().take(at)
        following = shores.slope.ravel().take(at + columns, mode="clip")
        slope += (following - slope) * part
        meets = np.flatnonzero(up < slope)
        if not len(meets):
            return
        at, column, lateral = at.take(meets), column.take(meets), lateral.take(meets)
        crest = shores.crest.ravel().take(at).astype(np.int64)
        away = far.take(shores.shore.ravel().take(at))
        away += (far.take(crest) - away) * (up.take(meets) / slope.take(meets))
        sideways = away * lateral
        x, y = (
            (away * self.scene.forward[k] + sideways * self.scene.right[k] + self.start[k])
            * np.float32(1 / self.texel)
            for k in (0, 1)
        )
        seen = self.texels(x, y, self.level.take(crest))
        # Steps are long: where one has gone past a rock into the water, rock is still seen.
        seen = np.where(seen >= WATER, BARE, seen)
        mirrored[meets] = blend(seen, self.horizon.take(column), self.haze.take(crest))
