"""The colour of each pixel of filled mode: ground, water, haze and sky, looked up and blended.

Colours are uint32, see :mod:`.blending`.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from landscape.flyover.blending import OPAQUE, blend, darker
from landscape.flyover.close_up import BEFORE, COVER, WATER, close_up, grain, layered
from landscape.flyover.look import Look
from landscape.flyover.reflection import ACROSS, Reflection
from landscape.flyover.rock import BITS, SIDE, THICK, WIDE
from landscape.flyover.settings import Settings

SLANT = 2.0  # texels that a pixel may hold before the next smaller copy is taken, chosen
LEVEL_BITS = 4  # of the level of a copy; the largest pictures have 14
LEVEL = (1 << LEVEL_BITS) - 1
FRESNEL = 1024  # entries of the table of how much water mirrors, by the angle
MIRROR = 1.0  # of the light that smooth water mirrors by Fresnel's equations, chosen
RIPPLES = 0.00045  # how much they incline the water, chosen
ROCK_BELOW = 1024  # pictures of rock below the eye, chosen: deeper than any ground
FOOT = np.uint32(0x7F343E44)  # the colour of rock at the water, chosen
BESIDE = 3  # pixels of water that one mirrored ray serves, chosen
INTO = np.float32(2.5)  # so many texels into a wall there is no water, chosen
ASHORE = 0.12  # how far above the water there is none, units, chosen
ROCKY = np.uint32(6 << 24)  # a texel with so much rock has layers, chosen


@dataclass(frozen=True)
class Scene:
    """What :mod:`.march` found: heights above the eye (s, c), which step fills each pixel (r, c).

    ``distances`` (s,) are those of the steps. ``forward`` and ``right`` (2,) span the plane;
    ``mirrored`` returns what water mirrors of the land, if any.
    """

    heights: np.ndarray
    filled: np.ndarray
    distances: np.ndarray
    forward: np.ndarray
    right: np.ndarray
    eye: tuple[float, float, float]
    mirrored: Callable[[], Reflection | None]


def packed_copy(level: np.ndarray, offsets: np.ndarray) -> np.ndarray:
    """Return which copy of a pyramid to look up, int32: its level, and above that its offset."""
    return np.asarray((offsets[level] << LEVEL_BITS | level).astype(np.int32))


class Colouring:
    """The tables of one frame, and the colours of its pixels."""

    def __init__(
        self,
        scene: Scene,
        look: Look,
        settings: Settings,
        lateral: np.ndarray,
        pixel: float,
        widest: np.float32,
    ) -> None:
        """Prepare a frame whose columns go to ``lateral`` (c,), ``pixel`` apart.

        ``widest`` is how far to either side those of the whole picture go.
        """
        self.scene = scene
        self.look = look
        self.switches = settings.filled
        visible = settings.flyover.visible
        far = scene.distances
        pyramid = look.ground
        self.texel = pyramid.period / (1 << pyramid.bits)

        # The ground is seen at a slant: along the ray a pixel holds more of it than across.
        wide = SLANT * pixel * far / self.texel
        thick = THICK * pixel * far / self.texel
        if not self.switches.levels:
            wide, thick = wide * 0, thick * 0
        level = np.minimum(np.log2(np.maximum(wide, 1)).astype(np.int32), pyramid.bits)
        self.copy = packed_copy(level, pyramid.offsets)
        fine = np.minimum(np.log2(np.maximum(thick, 1)).astype(np.int32), BITS)
        self.rock_copy = packed_copy(fine, look.rock.offsets)
        haze = 1 - np.exp(-((far * (2.3 / visible)) ** 1.4))
        haze = haze / haze[-1] if self.switches.fog else far * 0
        self.haze = (haze * 256 + 0.5).astype(np.uint32)

        # Both distances between which a ray meets the ground are looked up at once.
        self.between = np.empty(len(far), np.complex64)
        self.between.real, self.between.imag = far, far[np.maximum(np.arange(len(far)) - 1, 0)]

        # The plane in texels. Whole periods make all coordinates positive: then rounding to 0 is
        # rounding down.
        around = math.ceil(2 * float(far[-1]) / pyramid.period * widest + 1)
        self.start, self.forward, self.right = (
            (np.array(each) / self.texel).astype(np.float32)
            for each in (
                [e % pyramid.period + around * pyramid.period for e in scene.eye[:2]],
                scene.forward,
                scene.right,
            )
        )
        self.ashore = np.float32(look.sea - scene.eye[2] + ASHORE)

        # Whole pictures of rock make heights positive, too.
        self.bottom = np.float32(scene.eye[2] * THICK / self.texel % SIDE + ROCK_BELOW * SIDE)
        columns = look.sky.shape[1]
        turn = np.arctan2(
            scene.forward[1] + scene.right[1] * lateral, scene.forward[0] + scene.right[0] * lateral
        )
        self.azimuth = (turn / (2 * np.pi) % 1 * columns).astype(np.int32) % columns

        # Rise per distance over the ground, of rays that rise by 1 per level distance.
        self.flatness = (1 / np.sqrt(1 + lateral * lateral)).astype(np.float32)
        self.horizon = look.sky[0].take(self.azimuth)
        self.flat_sky = look.sky.ravel()
        steep = np.arange(FRESNEL) / FRESNEL * 2
        sine = steep / np.sqrt(1 + steep * steep)
        mirrored = MIRROR * (0.02 + 0.98 * (1 - sine) ** 5)
        self.fresnel = (mirrored * 256).astype(np.uint32)

    def band(
        self, step: np.ndarray, column: np.ndarray, slope: np.ndarray, lateral: np.ndarray
    ) -> np.ndarray:
        """Return the colours of some pixels, all arrays (n, w).

        ``step`` and ``column`` are what they show in the scene, ``slope`` the rise of their rays
        and ``lateral`` their direction to the right, per unit of level distance.
        """
        shape = step.shape

        # The pixels that may share a mirrored ray have a number in common.
        across = np.arange(shape[1], dtype=np.int32) // BESIDE
        beside = (np.arange(shape[0], dtype=np.int32)[:, None] * shape[1] + across).ravel()
        step = step.ravel()
        column = column.ravel()
        slope = slope.ravel()
        lateral = lateral.ravel()
        last = len(self.scene.distances)
        ground = np.flatnonzero(step < last)
        if len(ground) == len(step):
            return (self.ground(column, step, slope, lateral, beside) | OPAQUE).reshape(shape)
        out = np.empty(len(step), np.uint32)
        sky = np.flatnonzero(step == last)
        out[sky] = self.sky(column.take(sky), slope.take(sky))
        if len(ground):
            rays = (each.take(ground) for each in (column, step, slope, lateral, beside))
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
        place = tangent.astype(np.int32)
        place *= columns
        place += self.azimuth.take(column)
        return self.flat_sky.take(place, mode="clip")

    def ground(
        self,
        column: np.ndarray,
        step: np.ndarray,
        slope: np.ndarray,
        lateral: np.ndarray,
        beside: np.ndarray,
    ) -> np.ndarray:
        """Return the ground's colours along rays (n,) that meet it at or just before a step.

        Those that follow each other and have the same number ``beside`` may share a mirrored ray.
        """
        step = step.astype(np.intp)
        away = self.distance(column, step, slope)
        x, y = self.place(away, lateral)
        colour = self.texels(x, y, step)
        if self.switches.smooth:
            close_up(colour, self.look.ground, self.look.grain, x, y, away)
        up = slope * away
        self.feet(colour, x, y, up, away, step)
        self.layers(colour, x, y, up, away, step)
        if self.switches.reflection:
            self.mirror(colour, (column, step, slope, lateral, away), beside, x, y)
        if self.switches.fog:
            colour = blend(colour, self.horizon.take(column), self.haze.take(step))
        return colour

    def place(self, away: np.ndarray, lateral: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return x and y in texels where rays (n,) are at distances along the level line."""
        sideways, found = away * lateral, []
        for axis in (0, 1):
            at = away * self.forward[axis]
            at += sideways * self.right[axis]
            at += self.start[axis]
            found.append(at)
        return found[0], found[1]

    def distance(
        self, column: np.ndarray, step: np.ndarray, slope: np.ndarray, lift: float = 0.0
    ) -> np.ndarray:
        """Return how far along the level line of sight rays (n,) meet the ground.

        The rays are those of an eye that is ``lift`` below the camera. Between two steps the
        ground is a straight line; not smooth, it is a block.
        """
        scene = self.scene
        between = self.between.take(step)
        there, here = between.real, between.imag
        if not self.switches.smooth:
            return np.ascontiguousarray(there)
        columns = scene.heights.shape[1]
        heights = scene.heights.ravel()
        place = step * columns
        place += column

        # How far the ray is below the ground there, and above it here.
        below = heights.take(place)
        place -= columns
        above = slope * here
        above -= heights.take(place, mode="clip")
        if lift:
            below += np.float32(lift)
            above -= np.float32(lift)
        below -= slope * there
        below += above
        np.maximum(below, np.float32(1e-6), out=below)
        above /= below
        np.maximum(above, 0, out=above)
        np.minimum(above, 1, out=above)
        there -= here
        above *= there
        above += here
        return above

    def texels(self, x: np.ndarray, y: np.ndarray, step: np.ndarray) -> np.ndarray:
        """Return the nearest texels of the ground's picture at x, y (n,), of each step's level."""
        pyramid = self.look.ground
        mask, copy = (1 << pyramid.bits) - 1, self.copy.take(step)
        level = copy & LEVEL
        column, row = x.astype(np.int32), y.astype(np.int32)
        column &= mask
        row &= mask
        column >>= level
        row >>= level
        row <<= pyramid.bits - level
        row += column
        copy >>= LEVEL_BITS
        row += copy
        return pyramid.texels.take(row, mode="clip")

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
        if len(at):
            rays = (each.take(at) for each in (x, y, away, step))
            colour[at] = self.inside(*rays)

    def inside(
        self, x: np.ndarray, y: np.ndarray, away: np.ndarray, step: np.ndarray
    ) -> np.ndarray:
        """Return the rock a little further along rays (n,), where their own texel is of water."""
        further = INTO * self.texel / away
        x += (x - self.start[0]) * further
        y += (y - self.start[1]) * further
        found = self.texels(x, y, step)
        return np.where(found < WATER, found, FOOT)

    def layers(
        self,
        colour: np.ndarray,
        x: np.ndarray,
        y: np.ndarray,
        up: np.ndarray,
        away: np.ndarray,
        step: np.ndarray,
    ) -> None:
        """Draw the layers of rock on cliffs, in place: colours (n,), ``up`` above the eye."""
        cliff = np.flatnonzero(colour - ROCKY < WATER - ROCKY)
        if not len(cliff):
            return
        rays = (colour, x, y, up, away, step)
        own, x, y, up, away, step = (each.take(cliff) for each in rays)
        x *= np.float32(0.83 * WIDE)
        y *= np.float32(0.57 * WIDE)
        x += y
        up *= np.float32(THICK / self.texel)
        up += self.bottom
        copy = self.rock_copy.take(step)
        level = copy & LEVEL
        column, row = x.astype(np.int32), up.astype(np.int32)
        column &= SIDE - 1
        row &= SIDE - 1
        column >>= level
        row >>= level
        row <<= BITS - level
        row += column
        copy >>= LEVEL_BITS
        row += copy
        dark = self.look.rock.texels.take(row, mode="clip").astype(np.uint32)
        close = np.flatnonzero(away < BEFORE)
        if len(close) and self.switches.smooth:
            dark[close] = layered(self.look.rock.texels, SIDE, x.take(close), up.take(close))

        # As much less of the layers as there is less rock.
        np.subtract(np.uint32(256), dark, out=dark)
        dark *= own >> np.uint32(24)
        dark >>= np.uint32(7)
        colour[cliff] = darker(own, np.subtract(np.uint32(256), dark, out=dark))

    def mirror(
        self,
        colour: np.ndarray,
        rays: tuple[np.ndarray, ...],
        beside: np.ndarray,
        x: np.ndarray,
        y: np.ndarray,
    ) -> None:
        """Mirror sky and land in what is water, more so at grazing angles, in place; all (n,).

        ``rays`` are columns, steps, slopes, lateral directions and distances. Pixels that follow
        each other and have the same number ``beside`` share one mirrored ray.
        """
        water = np.flatnonzero(colour >= WATER)
        if not len(water):
            return

        group = beside.take(water)
        first = np.flatnonzero(np.append(True, group[1:] != group[:-1]))
        some, count = water.take(first), np.diff(first, append=len(water))
        x, y = x.take(some), y.take(some)
        column, step, slope, lateral, away = (each.take(some) for each in rays)

        up = np.maximum(-slope, 0)
        steep = up * self.flatness.take(column)
        steep *= FRESNEL / 2
        share = self.fresnel.take(steep.astype(np.int32), mode="clip")

        ripple = grain(self.look.grain, x, y, 1.5).astype(np.float32)
        ripple += grain(self.look.grain, x, y, 7.0)
        ripple -= 255
        away *= np.float32(0.02 / RIPPLES)
        away += np.float32(1 / RIPPLES)
        ripple /= away
        up += ripple
        np.maximum(up, np.float32(0.002), out=up)

        mirrored = self.sky(column, up)
        self.land(mirrored, up, column, step, lateral)
        mirrored, share = (np.repeat(each, count) for each in (mirrored, share))

        own = colour.take(water)
        share *= own >> np.uint32(24) & COVER
        share >>= np.uint32(7)
        colour[water] = blend(own, mirrored, share)

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
        found = self.scene.mirrored()
        if found is None:
            return
        step = found.seen(step, column, up)
        meets = np.flatnonzero(step < len(self.scene.distances))
        if not len(meets):
            return
        step = step.take(meets).astype(np.intp)
        up, column, lateral = (each.take(meets) for each in (up, column, lateral))

        # The heights are those of the column that the mirror image was made from.
        away = self.distance(column - column % ACROSS, step, up, found.lift)
        x, y = self.place(away, lateral)
        seen = self.texels(x, y, step)
        wet = np.flatnonzero(seen >= WATER)
        if len(wet):
            rays = (each.take(wet) for each in (x, y, away, step))
            seen[wet] = self.inside(*rays)
        up *= away
        up -= np.float32(found.lift)
        self.layers(seen, x, y, up, away, step)
        mirrored[meets] = blend(seen, self.horizon.take(column), self.haze.take(step))
