"""The light that all assets share: one sun and one sky.

Axes are the island's: x east, y up, z south. Colours are linear RGB unless named ``_SRGB``.
"""

import math

import numpy as np

SUN_AZIMUTH_DEG = 130.0  # chosen: south-east, 0 is north and 90 east
SUN_ELEVATION_DEG = 38.0  # chosen: late morning, shadows 1.3 times as long as objects are high
SUN_COLOR = np.array([1.00, 0.93, 0.80])  # chosen: slightly warm
SKY_COLOR = np.array([0.42, 0.55, 0.75])  # chosen: the blue fill light of the shadows
GROUND_BOUNCE = np.array([0.20, 0.19, 0.13])  # chosen: light reflected by grass and soil

HORIZON_SRGB = np.array([0.66, 0.76, 0.84])  # chosen: haze at the horizon, and the fog of `best`


def sun_direction() -> np.ndarray:
    """Return the unit vector (3,) towards the sun."""
    azimuth, elevation = math.radians(SUN_AZIMUTH_DEG), math.radians(SUN_ELEVATION_DEG)
    return np.array(
        [
            math.cos(elevation) * math.sin(azimuth),
            math.sin(elevation),
            -math.cos(elevation) * math.cos(azimuth),
        ]
    )


# Billboards turn with the viewer, so the sun has a fixed direction in sprite space (x right, y up,
# z towards the viewer): from the upper left, slightly from the front.
SPRITE_SUN = np.array([-0.55, 0.68, 0.48])  # chosen
SPRITE_SUN = SPRITE_SUN / np.linalg.norm(SPRITE_SUN)
# From above and slightly from the left, for the sprites that the program itself shades on the side
# away from the sun (``transparent.sunward``).
OVERHEAD = np.array([-0.22, 0.80, 0.50])  # chosen
OVERHEAD = OVERHEAD / np.linalg.norm(OVERHEAD)
