"""Bounding volumes: the lowest and highest vertex of each tile of the terrain.

A tile is drawn at its own level, or on its way to the next one, or divided into smaller tiles: its
box contains all of these. Boxes depend on the terrain only and are cached.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from landscape.files.cache import recall
from landscape.flyover.height_field import HeightField


@dataclass(frozen=True)
class Bounds:
    """The lowest and highest z of tiles in units, level l (T, T) where T = N / 2^l / patch.

    ``values`` float32 (n, 2) are those of all levels, one after the other, and the whole terrain's
    for tiles that are larger than the image.
    """

    values: np.ndarray
    sides: np.ndarray
    offsets: np.ndarray

    def at(self, level: np.ndarray, row: np.ndarray, column: np.ndarray) -> np.ndarray:
        """Return the lowest and highest z of tiles anywhere on the plane, float32 (n, 2)."""
        which = np.minimum(level, len(self.sides) - 1)
        side = self.sides[which]
        return np.asarray(
            self.values[self.offsets[which] + mirrored(row, side) * side + mirrored(column, side)]
        )


def mirrored(tile: np.ndarray, side: np.ndarray) -> np.ndarray:
    """Return the tile from 0 to ``side - 1``, a power of two less one, that a tile repeats."""
    repeated = tile & (2 * side - 1)
    return np.minimum(repeated, 2 * side - 1 - repeated)


@lru_cache(maxsize=2)
def bounds(field: HeightField, patch: int) -> Bounds:
    """Return the bounds of a terrain's tiles of ``patch`` x ``patch`` quads."""
    count = max((field.side // patch).bit_length(), 0)  # of levels whose tiles are in the image
    sides = np.append(field.side >> np.arange(count), patch) // patch
    offsets = np.cumsum(sides**2) - sides**2
    (values,) = recall(
        ("fly-over bounds", field.name, str(patch)), lambda: (_measured(field, patch, count),)
    )
    return Bounds(values, sides, offsets)


def _measured(field: HeightField, patch: int, count: int) -> np.ndarray:
    """Return ``Bounds.values``."""
    found: list[np.ndarray] = []
    for level in range(count):
        own = _range(field.levels[level], patch)
        next_level = _range(field.levels[level + 1], patch // 2)
        both = [own, next_level]
        if found:
            tiles = len(own)
            children = found[-1].reshape(tiles, 2, tiles, 2, 2)
            both.append(np.stack([children[..., 0].min((1, 3)), children[..., 1].max((1, 3))], -1))
        low, high = np.min(both, axis=0)[..., 0], np.max(both, axis=0)[..., 1]
        found.append(np.stack([low, high], axis=-1))
    # The averages of the coarser levels are between the extremes of the image.
    found.append(np.array([[[field.lowest, field.highest]]], np.float32))
    return np.concatenate([each.reshape(-1, 2) for each in found])


def _range(heights: np.ndarray, patch: int) -> np.ndarray:
    """Return the lowest and highest of heights (M + 1, M + 1) by tiles, (M / patch, M / patch, 2).

    The vertices next to a tile count, too: vertices glide to their neighbours.
    """
    low = high = np.pad(heights, 1, "reflect")
    for _axis in (0, 1):
        low, high = (
            reduced(np.lib.stride_tricks.sliding_window_view(each, patch + 3, 0)[::patch], -1).T
            for each, reduced in ((low, np.min), (high, np.max))
        )
    return np.stack([low, high], axis=-1)
