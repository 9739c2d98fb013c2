"""A PNG file written from its top down: a picture of any height need not be held in memory.

As the PNG specification (2003) has it: each row is stored as its difference to the row above it,
and all rows are one stream of zlib, cut into chunks.
"""

import struct
import zlib
from collections.abc import Callable

import numpy as np

SIGNATURE = b"\x89PNG\r\n\x1a\n"
LEVEL = 6  # of zlib, chosen
UP = 2  # the filter: less the byte above
RGB, GREY = 2, 0  # colour types


class PngStrips:
    """A PNG of RGB or, with 16 bits, of grey levels, that is handed on in pieces."""

    def __init__(
        self, write: Callable[[bytes], object], size: tuple[int, int], grey16: bool = False
    ) -> None:
        """Write the header; ``size`` is in pixels."""
        self._write = write
        self._stream = zlib.compressobj(LEVEL)
        self._bytes = 2 if grey16 else 3  # of a pixel
        self._above = np.zeros(size[0] * self._bytes, np.uint8)
        kind = (16, GREY) if grey16 else (8, RGB)
        write(SIGNATURE)
        self._chunk(b"IHDR", struct.pack(">IIBBBBB", *size, *kind, 0, 0, 0))

    def add(self, pixels: np.ndarray) -> None:
        """Write the next rows: uint8 (h, w, 3), or uint16 (h, w)."""
        if self._bytes == 2:
            pixels = pixels.astype(">u2")[..., None].view(np.uint8)
        rows = np.ascontiguousarray(pixels).reshape(len(pixels), -1)
        filtered = np.empty((len(rows), 1 + rows.shape[1]), np.uint8)
        filtered[:, 0] = UP
        filtered[0, 1:] = rows[0] - self._above
        np.subtract(rows[1:], rows[:-1], out=filtered[1:, 1:])
        self._above = rows[-1].copy()
        self._chunk(b"IDAT", self._stream.compress(filtered.data))

    def finish(self) -> None:
        """Write the end."""
        self._chunk(b"IDAT", self._stream.flush())
        self._chunk(b"IEND", b"")

    def _chunk(self, name: bytes, data: bytes) -> None:
        if data or name == b"IEND":
            check = zlib.crc32(data, zlib.crc32(name))
            self._write(struct.pack(">I", len(data)) + name + data + struct.pack(">I", check))
