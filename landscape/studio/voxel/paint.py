"""Tools to paint the tiles of the blocks: ramps of colour, cells, brush strokes that wrap.

Coordinates go from 0 to SIDE over a tile, x right and y down; the light comes from the upper left.
Everything is drawn OVER times larger and reduced. Colours are sRGB in 0..1: tiles are painted as
one paints by hand, with a few tones of one ramp, dark and cool to light and warm.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from scipy import ndimage
from scipy.spatial import cKDTree

from landscape.studio.images import shrink, smoothstep, spectral_noise, to_uint8
from landscape.voxel.tiles import SIDE as TEXELS

SIDE = 64  # units of painting across a tile: two to a texel
OVER = 4  # samples per unit
CRISP = 1.25  # chosen: contrast that a tile gains when it is reduced, since texels stay visible
TO_LIGHT = np.array([-0.6, -0.8])  # chosen: the direction of the light, x and y
Colours = Sequence[tuple[int, int, int]]


def axes(width: int = SIDE, height: int = SIDE) -> tuple[np.ndarray, np.ndarray]:
    """Return x and y of the samples of a picture, each (height * OVER, width * OVER), units."""
    across, down = ((np.arange(side * OVER) + 0.5) / OVER for side in (width, height))
    x, y = np.meshgrid(across, down)
    return x, y


def noise(exponent: float, seed: int, low_cut: float = 3.0) -> np.ndarray:
    """Return tiling noise of the samples of a tile, mean 0, standard deviation 1."""
    return spectral_noise(SIDE * OVER, exponent, seed, low_cut)


def smeared(values: np.ndarray, reach: int, axis: int) -> np.ndarray:
    """Return a tiling (h, w) smeared along ``axis`` by ``reach`` samples, standard deviation 1."""
    found = ndimage.uniform_filter1d(values, reach, axis=axis, mode="wrap")
    return np.asarray(found / found.std())


def ramp(colours: Colours, value: np.ndarray | float) -> np.ndarray:
    """Return the colours (..., 3) at ``value`` (...), 0 the first of a ramp of bytes, 1 the last.

    A list of two or more colours, dark to light.
    """
    table = np.array(colours) / 255.0
    at = np.linspace(0.0, 1.0, len(table))
    return np.stack([np.interp(value, at, channel) for channel in table.T], axis=-1)


def stepped(value: np.ndarray, steps: int, soft: float = 0.18) -> np.ndarray:
    """Return ``value`` reduced to flat tones, ``steps`` of them per unit, with narrow transitions.

    ``soft`` is half the width of a transition, in tones.
    """
    tone = np.floor(value * steps)
    return (tone + smoothstep(0.5 - soft, 0.5 + soft, value * steps - tone)) / steps


def spread(count: int, seed: int, stretch: float = 1.0) -> np.ndarray:
    """Return points (count, 2) spread evenly over a tile that wraps (best candidates).

    With ``stretch`` over 1, they are that many times farther apart in y.
    """
    rng = np.random.default_rng(seed)
    box = np.array([SIDE, SIDE / stretch])
    found = rng.uniform(0, box, (1, 2))
    for _ in range(count - 1):
        candidates = rng.uniform(0, box, (40, 2))
        distances, _ = cKDTree(found, boxsize=box).query(candidates)
        found = np.concatenate([found, candidates[distances.argmax()][None]])
    return found * np.array([1.0, stretch])


class Cells(NamedTuple):
    """The cells around points: at each sample, its own point and the borders to others.

    ``own`` (h, w) is the point's number, ``offset`` (h, w, 2) the way from it; the others
    are (h, w, k): the neighbours' numbers, the distance to the border with each, and the unit
    vector (h, w, k, 2) towards each.
    """

    own: np.ndarray
    offset: np.ndarray
    others: np.ndarray
    gap: np.ndarray
    towards: np.ndarray

    def light(self, width: float) -> np.ndarray:
        """Return the light, -1 to 1, on borders that are rounded over ``width`` units."""
        facing = self.towards @ TO_LIGHT
        near = np.clip(1.0 - self.gap / width, 0.0, 1.0)
        first = near.argmax(axis=-1)[..., None]
        return np.asarray(np.take_along_axis(near * facing, first, -1)[..., 0])

    def inside(self, round_off: float = 0.0) -> np.ndarray:
        """Return the distance (h, w) to the nearest border, corners rounded by ``round_off``."""
        if round_off == 0.0:
            return np.asarray(self.gap.min(axis=-1))
        return np.asarray(-round_off * np.log(np.exp(-self.gap / round_off).sum(axis=-1)))


def cells(points: np.ndarray, bend: float, seed: int, stretch: float = 1.0) -> Cells:
    """Return the cells of points (n, 2) on a tile that wraps; ``bend`` units of noise warp them.

    With ``stretch``, distances in y count for less by that factor.
    """
    x, y = axes()
    scale = np.array([1.0, 1.0 / stretch])
    box = SIDE * scale
    warped = np.stack([x + bend * noise(1.6, seed), y + bend * stretch * noise(1.6, seed + 1)], -1)
    place = warped * scale % box
    known = points * scale
    _, number = cKDTree(known, boxsize=box).query(place, k=min(9, len(points)))
    apart = place[..., None, :] - known[number]
    apart -= np.round(apart / box) * box
    own = apart[..., :1, :]
    between = own - apart[..., 1:, :]  # from the own point to each other
    length = np.linalg.norm(between, axis=-1)
    towards = between / length[..., None]
    gap = length / 2 - (own * towards).sum(axis=-1)
    return Cells(number[..., 0], own[..., 0, :], number[..., 1:], gap, towards)


class Canvas:
    """A picture being painted: colour (h, w, 3), alpha (h, w), samples; it may wrap in x and y."""

    def __init__(
        self, colour: np.ndarray | None = None, wrap_y: bool = True, wrap_x: bool = True
    ) -> None:
        """Begin with an opaque picture, or with a transparent tile."""
        side = SIDE * OVER
        self.colour = np.zeros((side, side, 3)) if colour is None else colour.copy()
        height, width, _ = self.colour.shape
        self.alpha = np.full((height, width), 0.0 if colour is None else 1.0)
        self._wraps = wrap_y, wrap_x

    def _samples(self, low: np.ndarray, high: np.ndarray) -> list[np.ndarray]:
        """Return the rows and the columns of the samples in a box, as far as the picture goes."""
        places = []
        for axis, wrap in ((1, self._wraps[0]), (0, self._wraps[1])):
            first, last = int(np.floor(low[axis] * OVER)), int(np.ceil(high[axis] * OVER))
            side = self.alpha.shape[1 - axis]
            place = np.arange(first, last + 1)
            places.append(place if wrap else place[(place >= 0) & (place < side)])
        return places

    def paint(
        self,
        low: np.ndarray,
        high: np.ndarray,
        brush: Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]],
    ) -> None:
        """Paint over the box from ``low`` to ``high`` (x, y; units).

        The brush takes x and y of samples and returns their colours (..., 3) and cover (...).
        """
        places = self._samples(low, high)
        if not all(len(place) for place in places):
            return
        x, y = np.meshgrid((places[1] + 0.5) / OVER, (places[0] + 0.5) / OVER)
        colour, cover = brush(x, y)
        spot = np.ix_(places[0] % self.alpha.shape[0], places[1] % self.alpha.shape[1])
        old = self.alpha[spot] * (1.0 - cover)
        total = old + cover
        share = np.where(total > 0, cover / np.maximum(total, 1e-9), 0.0)[..., None]
        self.colour[spot] = self.colour[spot] * (1.0 - share) + colour * share
        self.alpha[spot] = total

    def blob(
        self,
        place: np.ndarray,
        radii: tuple[float, float],
        turn: float,
        colours: Colours,
        value: float,
        relief: float,
        uneven: float = 0.12,
        seed: int = 0,
    ) -> None:
        """Paint a rounded lump at ``place`` (x, y), ``turn`` in radians.

        Its tone in the ramp ``colours`` is ``value``, more towards the light by ``relief``.
        """
        phase = np.random.default_rng(seed).uniform(0, 2 * np.pi, 2)
        reach = max(radii) * (1 + 2 * uneven) + 1.0

        def brush(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            dx, dy = x - place[0], y - place[1]
            u = (dx * np.cos(turn) + dy * np.sin(turn)) / radii[0]
            v = (dy * np.cos(turn) - dx * np.sin(turn)) / radii[1]
            angle = np.arctan2(v, u)
            bulge = uneven * (np.cos(2 * angle + phase[0]) + 0.6 * np.cos(3 * angle + phase[1]))
            radius = np.hypot(u, v) / (1.0 + bulge)
            facing = (dx * TO_LIGHT[0] + dy * TO_LIGHT[1]) / max(radii)
            tone = value + relief * facing * smoothstep(0.2, 1.0, radius)
            cover = np.clip((1.0 - radius) * min(radii) * 2.0 + 0.5, 0.0, 1.0)
            return ramp(colours, stepped(tone, 9)), cover

        self.paint(place - reach, place + reach, brush)

    def stroke(
        self,
        path: np.ndarray,
        widths: np.ndarray,
        colours: Colours,
        tones: np.ndarray,
        fold: float = 0.0,
    ) -> None:
        """Paint along a path (n, 2) whose half widths and tones in the ramp are given (n,).

        The side towards the light is lighter by ``fold``, the other darker.
        """
        reach = float(widths.max()) + 1.0
        start, end = path[:-1], path[1:]

        def brush(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            best = np.full(x.shape, 1e9)
            half, tone, side = (np.zeros(x.shape) for _ in range(3))
            for k, (a, b) in enumerate(zip(start, end, strict=True)):
                step = b - a
                length = float(np.hypot(*step)) or 1e-6
                dx, dy = x - a[0], y - a[1]
                t = np.clip((dx * step[0] + dy * step[1]) / length**2, 0.0, 1.0)
                away = np.hypot(dx - t * step[0], dy - t * step[1])
                wide = widths[k] + t * (widths[k + 1] - widths[k])
                nearer = away - wide < best
                best = np.where(nearer, away - wide, best)
                half = np.where(nearer, wide, half)
                tone = np.where(nearer, tones[k] + t * (tones[k + 1] - tones[k]), tone)
                cross = (step[0] * dy - step[1] * dx) / length
                normal = np.array([-step[1], step[0]]) / length
                lit = np.sign(normal @ TO_LIGHT) or 1.0
                side = np.where(nearer, cross * lit, side)

            edge = np.clip(side / np.maximum(half, 0.3) * 2.0, -1.0, 1.0)
            return ramp(colours, tone + fold * edge), np.clip(0.5 - best * 2.0, 0.0, 1.0)

        self.paint(path.min(axis=0) - reach, path.max(axis=0) + reach, brush)


def curve(
    start: Sequence[float], angle: float, length: float, bend: float = 0.0, points: int = 7
) -> np.ndarray:
    """Return a path (points, 2) from ``start``, first towards ``angle``, turning by ``bend``.

    Radians; 0 is to the right and a quarter turn is downward.
    """
    turn = angle + bend * np.linspace(0.0, 1.0, points - 1)
    steps = np.stack([np.cos(turn), np.sin(turn)], axis=-1) * length / (points - 1)
    return np.concatenate([[start], np.array(start) + np.cumsum(steps, axis=0)])


def blade_widths(half: float, points: int = 7, belly: float = 0.25) -> np.ndarray:
    """Return half widths along a blade of grass: widest at the fraction ``belly``, then tapered."""
    t = np.linspace(0.0, 1.0, points)
    rise = 0.6 + 0.4 * np.clip(t / max(belly, 1e-6), 0.0, 1.0)
    return np.asarray(half * rise * np.clip((1.0 - t) / (1.0 - belly), 0.0, 1.0) ** 0.7)


def leaf_widths(half: float, points: int = 9) -> np.ndarray:
    """Return half widths along a leaf, pointed at both ends."""
    t = np.linspace(0.0, 1.0, points)
    return np.asarray(half * np.sin(np.pi * t**0.85) ** 0.9 + 0.05)


def levelled(
    tile: np.ndarray, cut: float = 3.5, kept: float = 0.12, broad: float = 1.0
) -> np.ndarray:
    """Return a picture (h, w, 3) with its widest variations reduced to the fraction ``kept``.

    Variations of fewer than ``cut`` periods in a tile would show as a grid where it is repeated.
    The next wider variations, up to 10 periods, are multiplied by ``broad``: they are what is left
    of a tile from afar.
    """
    spectrum = np.fft.fft2(tile, axes=(0, 1))
    ky, kx = (np.fft.fftfreq(side) * side for side in tile.shape[:2])
    k = np.hypot(kx[None, :], ky[:, None])
    factor = 1.0 + (broad - 1.0) * smoothstep(12.0, 8.0, k)
    factor = np.where(k < cut, np.where(k > 0, kept, 1.0), factor)
    return np.asarray(np.fft.ifft2(spectrum * factor[..., None], axes=(0, 1)).real)


def finished(samples: np.ndarray) -> np.ndarray:
    """Return samples (h, w, 3 or 4) reduced to a tile, uint8 (TEXELS, TEXELS, 3 or 4).

    A texel is drawn or not: there is no alpha between.
    """
    small = shrink(samples, OVER * SIDE // TEXELS)
    middle = small[..., :3].mean(axis=(0, 1))
    small[..., :3] = middle + CRISP * (small[..., :3] - middle)
    small[..., 3:] = small[..., 3:] > 0.5
    return to_uint8(np.clip(small, 0.0, 1.0))
