"""Sprites in the light of a low sun (``sun.relit``): their sunny side warm, the other in the sky's.

A sprite's picture has the light of noon painted in. Here the colours of its quad's corners multiply
it: as if the quad were a quarter of a cylinder that bulges towards the viewer. All upright quads
face the viewer, so one frame has the same four colours for all of them. No OpenGL here.
"""

import numpy as np

from landscape.elements.sun import direction, painted
from landscape.frame import Frame
from landscape.settings import Sun

BULGE = np.sqrt(0.5)  # chosen: the cylinder's normals at a quad's sides are 45 degrees from its own
LOW = 0.35  # chosen: how much less the foot faces the sun, in the long shadows around it


def changes(sun: Sun) -> bool:
    """Return whether the light differs from the one that is painted in."""
    return sun.relit or sun.tint != Sun().tint


def corner_light(sun: Sun, frame: Frame) -> np.ndarray:
    """Return the light (4, 3) at the corners of an upright quad, in a billboard's order."""
    towards = direction(sun)
    level = np.array([frame.back[0], 0.0, frame.back[2]])
    if not level.any():  # the camera looks straight down: its up vector is level
        level = -np.array([frame.up[0], 0.0, frame.up[2]])
    front = BULGE * float(towards @ level) / float(np.linalg.norm(level))
    side = BULGE * float(towards @ frame.right)
    return painted(
        sun, np.array([front - side - LOW, front + side - LOW, front + side, front - side])
    )


def light_at(corners: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Return the light (n, k, 3) at points s, t (n, k, 2) of quads with corners' light (4, 3).

    s runs from left to right and t from top to bottom, 0..1.
    """
    s, t = points[..., :1], points[..., 1:]
    foot, top = (corners[a] + (corners[b] - corners[a]) * s for a, b in ((0, 1), (3, 2)))
    return np.asarray(top + (foot - top) * t)


def lit(colours: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Return colours, uint8 (..., 4), with their RGB times ``light`` (..., 3); alpha is kept."""
    out = np.broadcast_to(colours, (*np.broadcast_shapes(colours.shape[:-1], light.shape[:-1]), 4))
    out = out.copy()
    out[..., :3] = out[..., :3] * light
    return out
