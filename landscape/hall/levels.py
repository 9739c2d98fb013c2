"""Levels of detail of the hall's stone: how far from the plan each may be, and which one is used.

Surfaces of many small triangles are grids (surfaces.py); a level leaves out rows and columns. The
hall is divided along its bays, so that each may have another level. No OpenGL.
"""

import numpy as np

from landscape.frame import Frame
from landscape.hall import plan

BAYS = len(plan.BAYS) - 1
ALONG = BAYS  # the number of what is as long as several bays
LEVELS = (1e-5, 0.0015, 0.003, 0.005)  # chosen: units by which each level may differ from the plan
SIMPLIFIED = "stone", "iron", "wood"  # materials of many small triangles; others have one level
PIXELS = 1.5  # chosen: pixels by which a level may differ from the plan


def levels_of(material: str) -> range:
    """Return the numbers of the levels that surfaces of a material have."""
    return range(len(LEVELS) if material in SIMPLIFIED else 1)


def bay_of(points: np.ndarray) -> int:
    """Return the number of the bay in which points (..., 3) lie, or ALONG."""
    if np.ptp(points[..., 2]) > 1.1 * (plan.BAYS[1] - plan.BAYS[0]):
        return ALONG
    return int(np.clip(np.searchsorted(plan.BAYS, points[..., 2].mean()) - 1, 0, BAYS - 1))


def level_for(distance: float, frame: Frame) -> int:
    """Return the number of the coarsest level that is good enough at a distance in units."""
    allowed = PIXELS * distance / frame.pixels
    return max(k for k, tolerance in enumerate(LEVELS) if k == 0 or tolerance <= allowed)
