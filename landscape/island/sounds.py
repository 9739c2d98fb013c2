"""The sound of the island: its shore, wind, the torches at the gate, the ground underfoot."""

import math
from functools import partial
from typing import Protocol, cast

import numpy as np

from landscape.elements.best.sea.shelter import wave_heights
from landscape.elements.best.sea.shoreline import pieces
from landscape.elements.castle_fire import FLAME_Z, TORCHES
from landscape.elements.ground import Ground
from landscape.elements.settings import Settings, Water
from landscape.elements.water_surface import wave_time
from landscape.geometry.height_field import HeightField
from landscape.scene.scene import Terrain
from landscape.sound.sea import Shore, drawn_swell, gathered
from landscape.sound.soundscape import Soundscape
from landscape.sound.steps import GRASS, SAND, STONE, WATER

BEACH = 0.2  # chosen: units above the water up to which there is sand; it is painted 0.1 to 0.26
STEEP = 0.42  # chosen: slope from which ground is rock; it is painted 0.28 to 0.55
WET = 0.008  # chosen: units of water in which a step splashes
YARD = 0.62  # chosen: half the side of the square around the castle's middle that is paved
LAPPING = 0.6  # chosen: how loud the waves of 2006 are, which do not break
PATCH = 10.0  # section 4: units; the waves of 2006 repeat over a patch


class _Open(Protocol):
    """An island whose elements are built."""

    ground: Ground


def island_sounds(settings: Settings, terrain: Terrain) -> Soundscape:
    """Return what an island sounds like, open or by its heights alone."""
    field = terrain if isinstance(terrain, HeightField) else cast(_Open, terrain).ground.field
    return Soundscape(
        shore=_shore(settings, field),
        fires=_flames(settings, field),
        gusts=settings.grass.gusts,
        level=field.water_level,
        ground=partial(_ground, settings, field),
    )


def _shore(settings: Settings, field: HeightField) -> Shore:
    """Return the shore, whose waves are those that are drawn; lower in a cove if the sea's are."""
    ends, _ = pieces(field)
    middles = ends.mean(axis=1)
    lengths = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    if settings.water.sheltered:
        depths = field.water_level - field.heights
        heights = wave_heights(depths, field.size)
        column, row = np.clip(
            np.rint(middles / field.size * (len(heights) - 1)).astype(int), 0, len(heights) - 1
        ).T
        # What is half as high carries a quarter of the energy.
        lengths = lengths * np.square(heights[row, column])
    if settings.water.foam:
        return gathered(middles, lengths, field.water_level, drawn_swell, 1.0)
    swell = partial(_swell_of_2006, settings.water)
    return gathered(middles, lengths, field.water_level, swell, LAPPING)


def _swell_of_2006(water: Water, x: np.ndarray, z: np.ndarray, kt: float) -> np.ndarray:
    """Return the angle of a wave of the report, whose slope is sin(2 t - 2 pi z)^2."""
    return 4.0 * wave_time(kt, water) - 4.0 * np.pi * z / PATCH


def _flames(settings: Settings, field: HeightField) -> np.ndarray:
    """Return where the torches at the castle's gate burn, (2, 3) in units."""
    castle = settings.castle
    yaw = math.radians(castle.yaw)
    across, along = np.array(TORCHES) - 0.5, FLAME_Z - 0.5
    x = castle.x + across * math.cos(yaw) + along * math.sin(yaw)
    z = castle.z - across * math.sin(yaw) + along * math.cos(yaw)
    y = float(field.height(castle.x, castle.z)) + 0.26
    return np.stack([x, np.full(2, y), z], axis=1)


def _ground(settings: Settings, field: HeightField, x: float, y: float, z: float) -> str:
    """Return what is underfoot at x, z."""
    if float(field.depth(x, z)) > WET:
        return WATER
    castle = settings.castle
    if max(abs(x - castle.x), abs(z - castle.z)) < 2 * YARD:
        yaw = math.radians(castle.yaw)
        east, south = x - castle.x, z - castle.z
        across = east * math.cos(yaw) - south * math.sin(yaw)
        along = east * math.sin(yaw) + south * math.cos(yaw)
        if max(abs(across), abs(along)) < YARD:
            return STONE
    if float(field.slope(x, z)) > STEEP:
        return STONE
    above = float(field.terrain_height(x, z)) - field.water_level
    return SAND if above < BEACH else GRASS
