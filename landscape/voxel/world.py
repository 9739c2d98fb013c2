"""The world of blocks: an array, its regions, and what can be asked of it. No OpenGL.

Blocks are indexed [x, z, y], east, south and up; a region is a square of columns.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from landscape.voxel.blocks import AIR, DENSITY, SOLID, block, looked_up
from landscape.voxel.faces import EDGE

Cell = tuple[int, int, int]  # [x, z, y]
ROOM = 44  # blocks, chosen: room above the highest column, for trees and towers
BELOW = 0.14  # blocks, chosen: how far the water is below the top of its block
MOST_BLOCKS = 640 << 20  # bytes, chosen: what the blocks of a world may take
# On each side, chosen: building a larger world takes more than 20 seconds of the processor.
MOST_COLUMNS = 1800
MOST_AT_ONCE = 160 << 20  # blocks of a region, chosen: meshing one takes four bytes for each


class Changes(NamedTuple):
    """Changed blocks: ``places`` (n,) in the blocks' flat array, increasing, and ``kinds`` (n,)."""

    places: np.ndarray
    kinds: np.ndarray


@dataclass
class World:
    """Blocks, uint8 [x, z, y], in regions of ``region_size`` columns a side.

    ``ground`` (n, n) is the number of blocks of bare land in each column, without what stands on
    it; ``sea`` is the lowest level of dry land, and ``block`` the side of a cube in units.
    """

    blocks: np.ndarray
    ground: np.ndarray
    region_size: int
    sea: int
    block: float
    # The former kinds of changed blocks, by their places in the flat array.
    former: dict[int, int] = field(default_factory=dict)

    @property
    def side(self) -> int:
        """The number of columns on each side of the map."""
        return len(self.blocks)

    @property
    def regions(self) -> int:
        """The number of regions on each side of the map."""
        return self.side // self.region_size

    @property
    def size(self) -> float:
        """The side of the map in units."""
        return self.side * self.block

    @property
    def water(self) -> float:
        """The height of the water's surface in blocks."""
        return self.sea - BELOW

    def region_columns(self, region: int) -> tuple[int, int]:
        """Return x and z of the first column of a region, numbered row by row along z."""
        i, k = divmod(region, self.regions)
        return i * self.region_size, k * self.region_size

    def put(self, cell: Cell, kind: int) -> None:
        """Change a block [x, z, y], and keep in mind what it was at the beginning."""
        before, place = int(self.blocks[cell]), self.place(cell)
        if self.former.setdefault(place, before) == kind:
            del self.former[place]
        self.blocks[cell] = kind

    def place(self, cell: Cell) -> int:
        """Return the place of a block [x, z, y] in the flat array."""
        x, z, y = cell
        return (x * self.side + z) * self.blocks.shape[2] + y

    def cells(self, places: np.ndarray) -> tuple[np.ndarray, ...]:
        """Return x, z and y (n,) of places (n,) in the flat array."""
        return np.unravel_index(places, self.blocks.shape)

    @property
    def changes(self) -> Changes:
        """The blocks that are not as they were at the beginning."""
        places = np.sort(np.fromiter(self.former, np.intp, len(self.former)))
        return Changes(places, self.blocks[self.cells(places)])

    def restore(self, changes: Changes) -> np.ndarray:
        """Change these blocks and no others; return the places (n,) that may be different now."""
        back = np.fromiter(self.former, np.intp, len(self.former))
        self.blocks[self.cells(back)] = np.fromiter(self.former.values(), np.uint8, len(back))
        at = self.cells(changes.places)
        before = self.blocks[at]
        differ = before != changes.kinds
        pairs = zip(changes.places[differ].tolist(), before[differ].tolist(), strict=True)
        self.former = dict(pairs)
        self.blocks[at] = changes.kinds
        return np.union1d(back, changes.places)

    def region_of(self, x: int, z: int) -> int:
        """Return the region of a column."""
        return x // self.region_size * self.regions + z // self.region_size

    def is_air(self, x: float, z: float, y: float, clear: float) -> bool:
        """Return whether nothing solid is within ``clear`` blocks of a point of the map.

        Of the box around it, that is; above the map and below it is nothing.
        """
        if not (clear <= min(x, z) and max(x, z) < self.side - clear):
            return False
        (x0, x1), (z0, z1), (y0, y1) = (
            (int(at - clear), int(at + clear) + 1) for at in (x, z, max(y, clear))
        )
        return not SOLID[self.blocks[x0:x1, z0:z1, y0:y1]].any()

    def around(self, low: Sequence[int], high: Sequence[int]) -> np.ndarray:
        """Return the blocks of a box from ``low`` to ``high`` [x, z, y], with an edge all around.

        Beyond the map and below it they are as :meth:`with_edge` says.
        """
        x, z, y = (np.arange(a - EDGE, b + EDGE) for a, b in zip(low, high, strict=True))
        x, z = (np.clip(at, 0, self.side - 1) for at in (x, z))
        height = self.blocks.shape[2]
        found = self.blocks[np.ix_(x, z, np.clip(y, 0, height - 1))]
        found[:, :, y < 0] = block("rock")
        found[:, :, y >= height] = AIR
        return found

    def with_edge(self, region: int, number: int = 1, rows: int = 1) -> tuple[np.ndarray, Cell]:
        """Return a region's blocks with an edge all around, and the place [x, z, y] within it.

        The blocks may also be those of ``number`` regions, one after the other along z, and of as
        many in the following ``rows`` along x.

        Only levels where a face may be visible are returned. Beyond the map the land goes on as at
        its border, and below it is rock.
        """
        x, z = self.region_columns(region)
        across, along = (
            np.clip(np.arange(at - EDGE, at + count * self.region_size + EDGE), 0, self.side - 1)
            for at, count in ((x, rows), (z, number))
        )
        inner = self.blocks[across[0] : across[-1] + 1, along[0] : along[-1] + 1]
        low, high = levels_in_use(inner)
        height = inner.shape[2]
        found = np.full((len(across), len(along), high - low + 2 * EDGE), AIR, np.uint8)
        bottom, top = max(low - EDGE, 0), min(high + EDGE, height)
        start = bottom - (low - EDGE)
        columns = inner[:, :, bottom:top][np.ix_(across - across[0], along - along[0])]
        found[:, :, start : start + top - bottom] = columns
        found[:, :, :start] = block("rock")
        return found, (x, z, low)


def levels_in_use(blocks: np.ndarray) -> tuple[int, int]:
    """Return the levels [low, high) of blocks [x, z, y] between which faces can be visible."""
    # A level is of no interest if all of it is opaque with opaque blocks around it, or all is air.
    # One axis after the other is faster than both at once.
    some, every = (end.reduce(end.reduce(blocks)) != AIR for end in (np.maximum, np.minimum))
    high = int(np.flatnonzero(some)[-1]) + 1 if some.any() else 1
    full = leading(every[:high])
    density = looked_up(DENSITY, blocks[:, :, :full])  # of plants and leaves, too
    opaque = np.minimum.reduce(np.minimum.reduce(density)) == DENSITY.max()
    return max(leading(opaque) - 1, 0), high


def leading(flags: np.ndarray) -> int:
    """Return how many of flags (n,) are set before the first that is not."""
    return int(np.append(flags, False).argmin())
