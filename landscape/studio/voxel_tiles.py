"""The tiles of the blocks of the island in voxels, in one strip."""

from collections.abc import Callable

import numpy as np
from PIL import Image

from landscape.studio import voxel_ground, voxel_wood, voxel_works
from landscape.studio.voxel_paint import finished
from landscape.voxel.blocks import TILES
from landscape.voxel.tiles import FILE

COLOURS = 64  # chosen: per tile; the loss is not visible, and the file is half as large


def painter(name: str) -> Callable[[], np.ndarray]:
    """Return the function that paints the tile of this name."""
    modules = (voxel_ground, voxel_wood, voxel_works)
    found: Callable[[], np.ndarray] = next(
        getattr(module, name) for module in modules if hasattr(module, name)
    )
    return found


def tile(name: str) -> np.ndarray:
    """Return a tile, uint8 (SIDE, SIDE, 3), of at most COLOURS colours."""
    image = Image.fromarray(finished(painter(name)()))
    few = image.quantize(COLOURS, Image.Quantize.MEDIANCUT, kmeans=1, dither=Image.Dither.NONE)
    return np.asarray(few.convert("RGB"))


def voxel_tiles() -> np.ndarray:
    """Return the strip, uint8 (SIDE * len(TILES), SIDE, 3), in the order of TILES."""
    return np.concatenate([tile(name) for name in TILES])


ASSETS: dict[str, Callable[[], np.ndarray]] = {FILE: voxel_tiles}
