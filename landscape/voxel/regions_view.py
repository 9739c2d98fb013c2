"""The regions shown: their bounding boxes ("l" in the TP).

Boxes of regions that are drawn are green, those outside the frustum or too far away red.
State used: GL_LINES, GL_BLEND, a vertex array of all corners.
"""

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays
from landscape.voxel.land import Choice, Land
from landscape.voxel.visibility import CORNERS, visible_in_world

SEEN, CULLED = (0.35, 1.0, 0.45), (1.0, 0.30, 0.25)  # chosen
# The edges of a box, as pairs of its corners in the order of CORNERS.
EDGES = np.array([(a, b) for a in range(8) for b in range(a) if (a ^ b) in (1, 2, 4)])
# How many ends of an edge are at the top of the box.
UPPER = CORNERS[EDGES][..., 1].sum(axis=1)
TOPS = EDGES[UPPER == 2]
GROUNDED = EDGES[UPPER > 0]  # the lower edges of regions that are drawn are in the ground
LINE = 1.0  # pixels, chosen


def corners(low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Return the corners, float32 (8 n, 3), of boxes (n, 3) in the order of CORNERS."""
    found = low[:, None] + CORNERS * (high - low)[:, None]
    return np.ascontiguousarray(found.reshape(-1, 3), np.float32)


def send_edges(boxes: np.ndarray, edges: np.ndarray, colour: tuple[float, ...]) -> None:
    """Send edges (m, 2) of some ``boxes`` (n,), indices of the boxes whose corners are bound."""
    index = (len(CORNERS) * boxes[:, None] + edges.ravel()).astype(np.uint32)
    gl.glColor4f(*colour)
    gl.glDrawElements(gl.GL_LINES, index.size, gl.GL_UNSIGNED_INT, index)


def draw_boxes(land: Land, choice: Choice, clip: np.ndarray) -> None:
    """Draw the boxes of the regions in view of ``clip`` (4, 4), projection times modelview."""
    culled = visible_in_world(land.low, land.high, clip)
    culled[choice.regions] = False
    groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_LINE_BIT
    with attrib(groups), client_arrays(corners(land.low, land.high)):
        gl.glDisable(gl.GL_FOG)
        gl.glLineWidth(LINE)
        send_edges(np.flatnonzero(culled), EDGES, (*CULLED, 1.0))
        send_edges(choice.regions, GROUNDED, (*SEEN, 1.0))


def draw_tops(land: Land, choice: Choice, opacity: float) -> None:
    """Draw the upper edges of the boxes of all regions."""
    culled = np.ones(len(land.low), bool)
    culled[choice.regions] = False
    groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_LINE_BIT | gl.GL_COLOR_BUFFER_BIT
    with attrib(groups), client_arrays(corners(land.low, land.high)):
        gl.glDisable(gl.GL_FOG)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        gl.glLineWidth(LINE)
        send_edges(np.flatnonzero(culled), TOPS, (*CULLED, opacity))
        send_edges(choice.regions, TOPS, (*SEEN, opacity))
