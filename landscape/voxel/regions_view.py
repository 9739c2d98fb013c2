"""The regions shown: their bounding boxes, and the view frustum seen from outside ("l" in the TP).

Boxes of regions that are drawn are green, those outside the frustum or too far away red. In a
second viewport the whole map is seen from above and behind the eye, with the frustum's edges: what
is culled is missing there.
State used: GL_LINES, GL_BLEND, glViewport and GL_SCISSOR_TEST for the second viewport, the depth
range.
"""

from contextlib import AbstractContextManager

import numpy as np

from landscape.frame import Frame
from landscape.gl.calls import gl
from landscape.gl.state import attrib, flat_projection
from landscape.voxel.land import Choice, Land
from landscape.voxel.visibility import CORNERS

SEEN, CULLED, VIEW = (0.35, 1.0, 0.45), (1.0, 0.30, 0.25), (1.0, 0.95, 0.4)  # chosen
# The edges of a box, as pairs of its corners in the order of CORNERS.
EDGES = np.array([(a, b) for a in range(8) for b in range(a) if (a ^ b) in (1, 2, 4)])
TOPS = EDGES[(CORNERS[EDGES][..., 1] == 1).all(axis=1)]  # those of the upper side
PART = 0.42  # chosen: side of the second viewport, as a fraction of the window's height
ABOVE, BEHIND, LEAN = 34.0, 30.0, 48.0  # units and degrees, chosen: where the map is seen from
LINE = 1.0  # pixels, chosen
FAINT = 0.4  # chosen: opacity of the boxes in the second viewport, where they are close together
FAR = 30.0  # units, chosen: how much of the frustum is shown


def box_lines(low: np.ndarray, high: np.ndarray, edges: np.ndarray = EDGES) -> np.ndarray:
    """Return the ends, float32 (2 m n, 3), of the edges (m, 2) of boxes (n, 3)."""
    corners = low[:, None] + CORNERS * (high - low)[:, None]
    return np.ascontiguousarray(corners[:, edges].reshape(-1, 3), np.float32)


def frustum_lines(clip: np.ndarray, eye: np.ndarray) -> np.ndarray:
    """Return the ends, float32 (16, 3), of the edges of a frustum, cut off at FAR units."""
    inverse = np.linalg.inv(clip)
    corners = []
    for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        far = inverse @ (x, y, 1.0, 1.0)
        ray = far[:3] / far[3] - eye
        corners.append(eye + ray * (FAR / np.linalg.norm(ray)))
    rays = [end for corner in corners for end in (eye, corner)]
    rim = [corners[k % 4] for side in range(4) for k in (side, side + 1)]
    return np.array([*rays, *rim], np.float32)


def send_lines(ends: np.ndarray, colour: tuple[float, float, float], opacity: float = 1.0) -> None:
    """Send lines, two ends (n, 3) each."""
    gl.glColor4f(*colour, opacity)
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, ends)
    gl.glDrawArrays(gl.GL_LINES, 0, len(ends))
    gl.glDisableClientState(gl.GL_VERTEX_ARRAY)


def draw_boxes(land: Land, choice: Choice, edges: np.ndarray = EDGES, opacity: float = 1.0) -> None:
    """Draw the bounding boxes of all regions, in the colour of those that are drawn, or not."""
    seen = np.zeros(len(land.low), bool)
    seen[choice.regions] = True
    groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_LINE_BIT | gl.GL_COLOR_BUFFER_BIT
    with attrib(groups):
        gl.glDisable(gl.GL_FOG)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        gl.glLineWidth(LINE)
        send_lines(box_lines(land.low[~seen], land.high[~seen], edges), CULLED, opacity)
        send_lines(box_lines(land.low[seen], land.high[seen], edges), SEEN, opacity)


def draw_from_outside(
    land: Land, choice: Choice, frame: Frame, clip: np.ndarray, lit: AbstractContextManager[None]
) -> None:
    """Draw the regions of a choice in a second viewport, with the frustum they are chosen by.

    ``lit`` is the state in which land is drawn.
    """
    width, height = frame.viewport
    side = round(PART * height)
    at = width - side - side // 20, height - side - side // 20
    groups = gl.GL_VIEWPORT_BIT | gl.GL_SCISSOR_BIT | gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT
    middle = land.world.size / 2
    with attrib(groups | gl.GL_LINE_BIT | gl.GL_COLOR_BUFFER_BIT), flat_projection():
        gl.glViewport(*at, side, side)
        gl.glScissor(*at, side, side)
        gl.glEnable(gl.GL_SCISSOR_TEST)
        gl.glClearColor(0.08, 0.10, 0.13, 1.0)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
        gl.glDisable(gl.GL_FOG)
        gl.glMatrixMode(gl.GL_PROJECTION)
        gl.glFrustum(-0.5, 0.5, -0.5, 0.5, 1.0, 200.0)
        gl.glMatrixMode(gl.GL_MODELVIEW)
        gl.glRotatef(LEAN, 1.0, 0.0, 0.0)
        gl.glRotatef(frame.pose.yaw, 0.0, 1.0, 0.0)
        back = np.array([frame.back[0], 0.0, frame.back[2]])
        back = back / max(np.linalg.norm(back), 1e-9) * BEHIND
        eye = np.array([middle, ABOVE, middle]) + back
        gl.glTranslatef(*(-eye).tolist())
        with lit:
            land.draw(land.from_afar(choice, eye))
        draw_boxes(land, choice, TOPS, FAINT)
        gl.glLineWidth(LINE)
        send_lines(frustum_lines(clip, frame.eye), VIEW)
