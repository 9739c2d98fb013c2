"""Animated GIF files, written part by part: a film need not be held in memory.

All frames share one palette of 256 colours, so that nothing flickers that stands still. Between its
colours an ordered pattern mixes, which stays where it is: errors that spread from pixel to pixel
would swarm. The file is that of the specification of 1989; Pillow compresses the pictures.
"""

import io
import struct
from collections.abc import Sequence
from typing import Protocol

import numpy as np
from PIL import Image

COLORS = 255  # the last colour of 256 means: as in the frame before
BITS = 5  # of each colour by which the nearest of the palette is looked up: 32,768 entries
FASTEST = 50.0  # frames per second: viewers show what lasts less than 2/100 s slowly
MOST = 0xFFFF  # pixels, a side
SPREAD = 20.0  # chosen: levels between the lightest and the darkest of the pattern
END = b"\x3b"  # of a file
CONTROL = b"\x21\xf9\x04"  # a frame begins with it; five bytes follow
SAME = 3  # chosen: levels by which a pixel may change and still be as before

# The pattern of Bayer (1973), 8 x 8: thresholds -0.5 to 0.5.
_TWO = np.array([[0, 2], [3, 1]])
_FOUR = np.block([[4 * _TWO + each for each in row] for row in _TWO])
PATTERN = (np.block([[4 * _FOUR + each for each in row] for row in _TWO]) + 0.5) / 64.0 - 0.5


class Writable(Protocol):
    """The file that is written to."""

    def write(self, data: bytes) -> object:
        """Write some bytes."""


def palette_of(pictures: Sequence[np.ndarray]) -> np.ndarray:
    """Return COLORS colours, uint8 (n, 3), that suit pictures (h, w, 3) of a film."""
    sample = Image.fromarray(np.concatenate([each.reshape(-1, 3) for each in pictures])[None])
    found = sample.quantize(COLORS, Image.Quantize.MEDIANCUT).getpalette() or []
    return np.array(found, np.uint8).reshape(-1, 3)[:COLORS]


def nearest(palette: np.ndarray) -> np.ndarray:
    """Return the number of the nearest colour for each colour of BITS bits, uint8 (2**15,)."""
    levels = (np.arange(1 << BITS) + 0.5) * (256 >> BITS)
    grid = np.stack(np.meshgrid(levels, levels, levels, indexing="ij"), axis=-1).reshape(-1, 3)
    own = palette.astype(np.float64)
    # The eye tells greens apart best; |a - b|^2 without the term that is the same for all.
    weight = np.array([2.0, 4.0, 3.0])
    far = (own * own) @ weight - 2 * (grid * weight) @ own.T
    return far.argmin(axis=1).astype(np.uint8)


def header(size: tuple[int, int], palette: np.ndarray) -> bytes:
    """Return what a file begins with: ``size`` in pixels, palette uint8 (n, 3), no end."""
    colours = np.zeros((256, 3), np.uint8)
    colours[: len(palette)] = palette
    screen = b"GIF89a" + struct.pack("<HHBBB", *size, 0xF7, 0, 0) + colours.tobytes()
    return screen + b"\x21\xff\x0bNETSCAPE2.0\x03\x01\x00\x00\x00"


class GifFrames:
    """Frames that follow each other in a file; the first of them needs none before it."""

    def __init__(
        self, out: Writable, size: tuple[int, int], fps: float, palette: np.ndarray, first: int = 0
    ) -> None:
        """Write to ``out``; ``first`` is the number of the first frame in its film."""
        self._out = out
        self._fps = fps
        self._nearest = nearest(palette)
        rows, columns = -(-size[1] // 8), -(-size[0] // 8)
        pattern = np.tile(PATTERN, (rows, columns))[: size[1], : size[0], None]
        self._pattern = np.round(SPREAD * pattern).astype(np.int16)
        self._before: tuple[np.ndarray, np.ndarray] | None = None
        self._number = first

    def add(self, pixels: np.ndarray) -> None:
        """Write a frame, uint8 (h, w, 3)."""
        mixed = np.clip(pixels.astype(np.int16) + self._pattern, 0, 255) >> (8 - BITS)
        r, g, b = np.moveaxis(mixed, -1, 0)
        sent = self._changed(pixels, self._nearest[(r << (2 * BITS)) + (g << BITS) + b])

        # Rounded to where the frame begins and ends, so that the film is as long as it should be.
        begin, end = (round(100 * k / self._fps) for k in (self._number, self._number + 1))
        self._number += 1
        self._out.write(CONTROL + struct.pack("<BHBB", 0x05, end - begin, COLORS, 0))
        self._out.write(_compressed(sent))

    def _changed(self, pixels: np.ndarray, numbers: np.ndarray) -> np.ndarray:
        """Return the colours' numbers (h, w), with that of "as before" where little changes."""
        if self._before is None:
            self._before = pixels, numbers
            return numbers
        shown, was = self._before
        change = np.abs(pixels.astype(np.int16) - shown).max(axis=2)
        same = (change <= SAME) | (numbers == was)
        # What counts as the same is still what was shown, so that slow changes add up.
        still = change <= SAME
        self._before = np.where(still[..., None], shown, pixels), np.where(still, was, numbers)
        return np.where(same, np.uint8(COLORS), numbers)


def frame_count(data: bytes) -> int:
    """Return how many whole frames there are, one after another as GifFrames writes; else -1."""
    at = count = 0
    while at < len(data):
        at += len(CONTROL) + 5 + 10 + 1  # with the descriptor and the size of a code
        if data[at - 11 : at - 10] != b"," or not data.startswith(CONTROL, at - 19):
            return -1
        while (length := int.from_bytes(data[at : at + 1])) > 0:
            at += length + 1
        at += 1
        count += 1
    return count if at == len(data) else -1


def _compressed(numbers: np.ndarray) -> bytes:
    """Return a picture of palette numbers (h, w) as GIF has it: descriptor and LZW data."""
    image = Image.frombytes("P", numbers.shape[::-1], numbers.tobytes())
    image.putpalette(bytes(range(256)) * 3)
    whole = io.BytesIO()
    image.save(whole, "GIF", optimize=False, interlace=False)
    data = whole.getvalue()
    # The descriptor follows the header, its palette, and the extensions.
    at = 13 + 3 * (2 << (data[10] & 7)) if data[10] & 0x80 else 13
    while data[at] == 0x21:
        at += 2
        while data[at]:
            at += data[at] + 1
        at += 1
    return data[at:-1]
