"""Colours as uint32, red in the lowest byte, blended without taking them apart.

Red and blue are blended at once, as two numbers in one, and green beside them, with the highest
byte: half the multiplications.
"""

import numpy as np

PAIR, MIDDLE = np.uint32(0x00FF00FF), np.uint32(0x0000FF00)
OPAQUE = np.uint32(0xFF000000)
BYTE = np.uint32(8)


def blend(one: np.ndarray, other: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Return colours (n,) blended towards others by weights (n,), uint32 of 0..256.

    The highest byte is 0.
    """
    rest = np.uint32(256) - weight
    pair, more = one & PAIR, other & PAIR
    pair *= rest
    more *= weight
    pair += more
    pair >>= BYTE
    pair &= PAIR
    middle = one >> BYTE
    middle &= PAIR
    middle *= rest
    np.right_shift(other, BYTE, out=more)
    more &= PAIR
    more *= weight
    middle += more
    middle &= MIDDLE
    pair |= middle
    return pair


def darker(colour: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Return colours (n,) multiplied by light (n,), uint32 of 0..256; the highest byte is 0."""
    pair = colour & PAIR
    pair *= light
    pair >>= BYTE
    pair &= PAIR
    middle = colour & MIDDLE
    middle >>= BYTE
    middle *= light
    middle &= MIDDLE
    pair |= middle
    return pair


def between_four(
    corners: tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray], u: np.ndarray, v: np.ndarray
) -> np.ndarray:
    """Return colours between those at the corners of squares, all four bytes of them.

    The corners are upper left, upper right, lower left, lower right; ``u`` and ``v`` are how far
    to the right and down, uint32 of 0..255; all (n,). All are overwritten.
    """
    both = u * v
    both >>= BYTE

    # Rounded like this the four weights are never negative, and their sum is 256.
    u -= both
    v -= both
    rest = np.uint32(256) - both
    rest -= u
    rest -= v
    pair = corners[0] & PAIR
    other = corners[0]
    part = np.empty_like(u)
    pair *= rest
    other >>= BYTE
    other &= PAIR
    other *= rest
    for corner, weight in zip(corners[1:], (u, v, both), strict=True):
        np.bitwise_and(corner, PAIR, out=part)
        part *= weight
        pair += part
        corner >>= BYTE
        corner &= PAIR
        corner *= weight
        other += corner

    pair >>= BYTE
    pair &= PAIR
    other &= ~PAIR
    pair |= other
    return pair
