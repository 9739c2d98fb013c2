"""The ground close to the eye, where a texel of its picture covers many pixels.

Its texels are blended with their neighbours, and so are their parts of rock: else squares of grass
and rock would be seen. Blended texels are blurred; a fine grain makes up for that, on land.
"""

import numpy as np

from landscape.flyover.blending import OPAQUE, between_four, darker
from landscape.flyover.ground import WET, Pyramid

CLOSE = 60.0  # distance up to which texels are blended, units, chosen
BEFORE = 15.0  # the same of open water, and of the layers of rock, chosen
# How often the grain's pattern is repeated for each texel, and up to which part of CLOSE it is
# seen, chosen.
GRAINS = ((11.0, 0.4), (53.0, 0.1))
DARKEST = 0.28  # how dark the darkest grains are, chosen
WATER, COVER = np.uint32(WET << 24), np.uint32(0x7F)  # a texel of water; how much of it is water


def grain(pattern: np.ndarray, x: np.ndarray, y: np.ndarray, repeats: float) -> np.ndarray:
    """Return a pattern (n, n), n a power of two, at x, y (m,) in texels of the ground."""
    side = len(pattern)
    column = (x * np.float32(repeats)).astype(np.int32)
    row = (y * np.float32(repeats)).astype(np.int32)
    column &= side - 1
    row &= side - 1
    row *= side
    row += column
    return np.asarray(pattern.ravel().take(row, mode="clip"))


def close_up(
    colour: np.ndarray,
    picture: Pyramid,
    pattern: np.ndarray,
    x: np.ndarray,
    y: np.ndarray,
    away: np.ndarray,
) -> None:
    """Blend colours (n,) close by between texels of a picture, and add grain, in place.

    ``x`` and ``y`` are in texels, ``away`` in units.
    """
    close = away < CLOSE

    # Open water has few colours: its texels are seen right before the eye only.
    close &= (colour < OPAQUE) | (away < BEFORE)
    near = np.flatnonzero(close)
    if not len(near):
        return
    x, y, away, own = (each.take(near) for each in (x, y, away, colour))
    smooth = between(picture, x, y, own)
    grained = np.flatnonzero(away < CLOSE * GRAINS[0][1])
    if len(grained):
        x, y, away = (each.take(grained) for each in (x, y, away))
        own = own.take(grained)
        dark = shade(pattern, (x, y, away), *GRAINS[0])
        closest = np.flatnonzero(away < CLOSE * GRAINS[1][1])
        if len(closest):
            at = (x.take(closest), y.take(closest), away.take(closest))
            dark[closest] += shade(pattern, at, *GRAINS[1])
        land = COVER - (own >> np.uint32(24) & COVER) * (own >= WATER)
        keep = dark.astype(np.uint32)
        keep *= land
        keep >>= np.uint32(7)
        np.subtract(np.uint32(256), keep, out=keep)
        lit = smooth.take(grained)
        smooth[grained] = darker(lit, keep) | lit & OPAQUE

    colour[near] = smooth


def shade(
    pattern: np.ndarray, at: tuple[np.ndarray, np.ndarray, np.ndarray], repeats: float, part: float
) -> np.ndarray:
    """Return how dark a grain makes the ground, float32 (n,) of 0..255: less, farther away.

    ``at`` are x and y in texels, and the distance in units.
    """
    x, y, away = at
    left = away * np.float32(-1 / (CLOSE * part))
    left += 1
    left *= np.float32(DARKEST)
    left *= grain(pattern, x, y, repeats)
    return left


def layered(texels: np.ndarray, side: int, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return numbers of 0..255 at x, y (n,) in texels of a square picture, blended between them.

    ``texels`` uint8 begin with the picture, ``side`` x ``side``, a power of two; it is repeated.
    """
    left, top = np.floor(x), np.floor(y)
    u, v = x - left, y - top
    column, right = _neighbours(left, side - 1)
    row, below = _neighbours(top, side - 1)
    row *= side
    below *= side
    upper, lower = (
        texels.take(at + column) * (1 - u) + texels.take(at + right) * u for at in (row, below)
    )
    return np.asarray((upper + (lower - upper) * v).astype(np.uint32))


def between(picture: Pyramid, x: np.ndarray, y: np.ndarray, own: np.ndarray) -> np.ndarray:
    """Return a picture's colours at x, y (n,) in texels, blended between them.

    The highest byte says how much of a texel is rock, or water. Where these meet it cannot be
    blended: it is that of ``own``, the nearest texel.
    """
    mask, bits = (1 << picture.bits) - 1, picture.bits

    u, v = x - np.float32(0.5), y - np.float32(0.5)
    left, top = np.floor(u), np.floor(v)
    u -= left
    v -= top
    u *= 256
    v *= 256

    column, right = _neighbours(left, mask)
    row, below = _neighbours(top, mask)
    row <<= bits
    below <<= bits

    take = picture.texels.take
    corners = (
        take(row + column, mode="clip"),
        take(row + right, mode="clip"),
        take(below + column, mode="clip"),
        take(below + right, mode="clip"),
    )

    wet = corners[0] | corners[1]
    wet |= corners[2]
    wet |= corners[3]
    wet = np.flatnonzero(wet >= WATER)
    found = between_four(corners, u.astype(np.uint32), v.astype(np.uint32))
    if len(wet):
        found[wet] = found.take(wet) & ~OPAQUE | own.take(wet) & OPAQUE
    return found


def _neighbours(first: np.ndarray, mask: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the numbers of texels (n,) and of those after them, in a picture that is repeated."""
    before = first.astype(np.int32)
    after = before + 1
    before &= mask
    after &= mask
    return before, after
