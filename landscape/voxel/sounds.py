"""The sound of the island in cubes: its shore, wind, and the blocks that are walked on."""

from functools import partial
from typing import Protocol, cast, runtime_checkable

import numpy as np

from landscape.scene.scene import Terrain
from landscape.sound.sea import Shore, gathered
from landscape.sound.soundscape import Soundscape
from landscape.sound.steps import GRASS, SAND, STONE, WATER
from landscape.voxel.blocks import BLOCKS
from landscape.voxel.heights import Heights
from landscape.voxel.land import Land
from landscape.voxel.materials import BEACH, ROCKY
from landscape.voxel.settings import Settings

LAPPING = 0.8  # chosen: how loud waves are that are drawn as ripples and do not break
PERIOD = 150.0  # chosen: kt between two of them
FEET = 0.06  # chosen: units below the eye where the block is looked for that one stands on

# Chosen: which of four grounds a block sounds like, by what its picture shows; else like stone.
SOFT = {"grass_top": GRASS, "turf_side": GRASS, "leaves": GRASS, "needles": GRASS, "hide": GRASS}
LOOSE = {"sand": SAND, "gravel": SAND, "earth": SAND, "path": SAND, "snow": SAND}


class _High(Protocol):
    """An island in cubes, open or not."""

    heights: Heights


@runtime_checkable
class _Open(Protocol):
    """An island in cubes whose elements are built."""

    land: Land


def voxel_sounds(settings: Settings, terrain: Terrain) -> Soundscape:
    """Return what the island in cubes sounds like, open or by its heights alone.

    In an open one the blocks are looked at, so what was built sounds as what it is made of.
    """
    heights = cast(_High, terrain).heights
    values = settings.voxel
    level = values.sea * values.block
    blocks = terrain.land.world.blocks if isinstance(terrain, _Open) else None
    return Soundscape(
        shore=_shore(heights, values.sea, values.block),
        level=level,
        ground=partial(_ground, settings, heights, blocks),
        blocks=True,
    )


def _shore(heights: Heights, sea: int, block: float) -> Shore:
    """Return the shore: the sides between a column of water and one of land."""
    wet = heights.tops <= sea
    found = []
    for axis in (0, 1):
        one, other = (wet.take(range(k, len(wet) - 1 + k), axis) for k in (0, 1))
        i, k = np.nonzero(one != other)
        place = np.stack([i, k], axis=1) + 0.5
        place[:, axis] += 0.5
        found.append(place * block)
    places = np.concatenate(found)
    lengths = np.full(len(places), block)
    return gathered(places, lengths, sea * block, _swell, LAPPING)


def _swell(x: np.ndarray, z: np.ndarray, kt: float) -> np.ndarray:
    """Return the angle of the waves: not all shores at the same time."""
    return 2.0 * np.pi * kt / PERIOD + 1.9 * np.sin(0.9 * x + 0.4 * z) + 1.5 * np.sin(1.6 * z)


def _under(column: np.ndarray, top: int, sea: int) -> str:
    """Return what is underfoot in a column of blocks (levels,), at most at level ``top``."""
    solid = np.flatnonzero(column[: top + 1])
    while len(solid) and BLOCKS[column[solid[-1]]].plant:
        solid = solid[:-1]
    if not len(solid) or solid[-1] < sea - 1:
        return WATER
    tile = BLOCKS[column[solid[-1]]].top
    return SOFT.get(tile) or LOOSE.get(tile) or STONE


def _ground(
    settings: Settings, heights: Heights, blocks: np.ndarray | None, x: float, y: float, z: float
) -> str:
    """Return what is underfoot at x, z, for an eye at y."""
    block, sea = settings.voxel.block, settings.voxel.sea
    last = len(heights.field) - 1
    i, k = (int(min(max(each / block, 0), last)) for each in (x, z))

    if blocks is not None:
        return _under(blocks[i, k], int(max((y - FEET) / block, 0)), sea)
    above = (heights.field[i, k] - sea) / heights.tall
    if above <= 0.0:
        return WATER
    steep = float(np.hypot(*heights.gradient(i + 0.5, k + 0.5))) / heights.grade
    return STONE if steep > ROCKY else SAND if above < BEACH else GRASS
