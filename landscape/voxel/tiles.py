"""The pictures of the blocks: a strip of square tiles, one of plants, and ripples."""

import numpy as np

from framelens.base.errors import InputError
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.voxel.blocks import HOLED, PLANT_TILES, TILES

SIDE = 32  # chosen: texels per side of a tile
RIPPLES_SIDE = 128  # chosen
FILE = "voxel_tiles.png"
PLANTS_FILE = "voxel_plants.png"
RIPPLES_FILE = "voxel_ripples.png"


def tiles(assets: Assets) -> dict[str, np.ndarray]:
    """Return the tiles of TILES by name, each uint8 (SIDE, SIDE, 3), row 0 the upper edge.

    Those of HOLED have a fourth channel, 0 in their holes. InputError names a file that is missing
    or not a strip of that many tiles.
    """
    strip = _strip(assets, FILE, "RGBA", SIDE, SIDE * len(TILES))
    parts = zip(TILES, np.split(strip, len(TILES)), strict=True)
    return {
        name: np.ascontiguousarray(part if name in HOLED else part[..., :3]) for name, part in parts
    }


def plants(assets: Assets) -> np.ndarray:
    """Return the pictures of PLANT_TILES side by side, uint8 (SIDE, SIDE * n, 4), row 0 the top.

    InputError names a file that is missing or not a strip of that many pictures.
    """
    return _strip(assets, PLANTS_FILE, "RGBA", SIDE * len(PLANT_TILES), SIDE)


def ripples(assets: Assets) -> np.ndarray:
    """Return the ripples' normals, uint8 (n, n, 3), n RIPPLES_SIDE: x right, y down the picture.

    z is up; a component c is coded as (c + 1) / 2. InputError names a file that is missing or of
    another size.
    """
    return _strip(assets, RIPPLES_FILE, "RGB", RIPPLES_SIDE, RIPPLES_SIDE)


def _strip(assets: Assets, file: str, mode: str, width: int, height: int) -> np.ndarray:
    path = assets.path(file)
    strip = read_image(path, mode)
    if strip.shape[:2] != (height, width):
        found = f"found {strip.shape[1]}x{strip.shape[0]}"
        raise InputError(
            "{path}: expected {width}x{height} pixels, {value}",
            path=path,
            width=width,
            height=height,
            value=found,
        )
    return strip
