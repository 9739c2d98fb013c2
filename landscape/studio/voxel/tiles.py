"""The tiles of the blocks of the island in voxels, in one strip."""

from collections.abc import Callable

import numpy as np
from PIL import Image

from landscape.studio.voxel import ground, wood, works
from landscape.studio.voxel.paint import finished
from landscape.voxel.blocks import HOLED, TILES
from landscape.voxel.tiles import FILE

COLOURS = 32  # chosen: per tile; the loss is not visible, and the file is half as large


def painter(name: str) -> Callable[[], np.ndarray]:
    """Return the function that paints the tile of this name."""
    modules = (ground, wood, works)
    found: Callable[[], np.ndarray] = next(
        getattr(module, name) for module in modules if hasattr(module, name)
    )
    return found


def tile(name: str) -> np.ndarray:
    """Return a tile, uint8 (SIDE, SIDE, 4), of at most COLOURS colours."""
    found = finished(painter(name)())
    image = Image.fromarray(np.ascontiguousarray(found[..., :3]))
    few = image.quantize(COLOURS, Image.Quantize.MEDIANCUT, kmeans=1, dither=Image.Dither.NONE)
    alpha = found[..., 3:] if name in HOLED else np.full((*found.shape[:2], 1), 255, np.uint8)
    return np.concatenate([np.asarray(few.convert("RGB")), alpha], axis=2)


def voxel_tiles() -> np.ndarray:
    """Return the strip, uint8 (SIDE * len(TILES), SIDE, 4), in the order of TILES."""
    return np.concatenate([tile(name) for name in TILES])


ASSETS: dict[str, Callable[[], np.ndarray]] = {FILE: voxel_tiles}
