"""The frustum seen from outside, with the regions that it leaves ("l" in the TP).

Technique: a second viewport, in which the map is seen from above and behind the eye. Its land is a
height field with few points and the map's picture as texture, since a block would be smaller than a
pixel; only the regions that are drawn are in it, so that what is culled is missing. Over them are
the upper edges of all regions' boxes, and the edges of the frustum.
State used: glViewport and GL_SCISSOR_TEST, both matrices, GL_TEXTURE_2D, GL_LINES; fog off.
What is not drawn: blocks that change while it is shown; off and on again, it has them.
"""

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays, flat_projection
from framelens.gl.texture import Texture
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.voxel.land import Choice, Land
from landscape.voxel.map import highest, map_picture
from landscape.voxel.regions_view import LINE, draw_tops
from landscape.voxel.world import World

VIEW = (1.0, 0.95, 0.4)  # chosen: colour of the frustum
PART = 0.42  # chosen: side of the viewport, as a fraction of the window's height
BACKGROUND = (0.08, 0.10, 0.13, 1.0)  # chosen
# Chosen: where the map is seen from.
ABOVE, BEHIND = 34.0, 30.0  # units
LEAN = 48.0  # degrees
FAINT = 0.4  # chosen: opacity of the boxes, which are close together
FAR = 30.0  # units, chosen: how much of the frustum is shown
CELLS = 3  # chosen: cells of the height field on each side of a region


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


def relief(world: World) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return a height field of the world: points in units, texture coordinates, and quads.

    Points are float32 (n, 3), coordinates (n, 2); quads, uint32 (regions, m, 4), are indices of
    points. A point's height is the mean of the columns around it, with what stands on them.
    """
    cells = min(CELLS, world.region_size)
    within = np.arange(cells) * world.region_size // cells
    starts = (np.arange(world.regions)[:, None] * world.region_size + within).ravel()
    ends = np.append(starts, world.side)
    rows = np.add.reduceat(highest(world.blocks), starts, axis=0, dtype=np.int32)
    total = np.add.reduceat(rows, starts, axis=1)
    mean = np.pad(total / np.outer(np.diff(ends), np.diff(ends)), 1, mode="edge")
    height = (mean[:-1, :-1] + mean[1:, :-1] + mean[:-1, 1:] + mean[1:, 1:]) / 4 + 1
    x, z = np.meshgrid(ends, ends, indexing="ij")
    points = np.stack([x, height, z], axis=-1).reshape(-1, 3) * world.block
    coordinates = np.stack([x, z], axis=-1).reshape(-1, 2) / world.side
    index = np.arange(len(points)).reshape(height.shape)
    corners = index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]
    quads = np.stack(corners, axis=-1).reshape(world.regions, cells, world.regions, cells, 4)
    quads = quads.swapaxes(1, 2).reshape(world.regions**2, -1, 4)
    return points.astype(np.float32), coordinates.astype(np.float32), quads.astype(np.uint32)


class OutsideView:
    """Owner of the height field and its texture, which are made when they are first shown."""

    def __init__(self, assets: Assets) -> None:
        """Make nothing yet: few want to see it."""
        self._assets = assets
        self._texture: Texture | None = None
        self._points = self._coordinates = self._quads = np.empty(0)

    def draw(self, land: Land, choice: Choice, frame: Frame, clip: np.ndarray) -> None:
        """Draw the regions of a choice, and the frustum ``clip`` (4, 4) that they are chosen by."""
        if self._texture is None:
            self._texture = Texture(map_picture(land.world, self._assets), repeat=False)
            self._points, self._coordinates, self._quads = relief(land.world)
        width, height = frame.viewport
        side = round(PART * height)
        left, bottom = frame.corner
        at = left + width - side - side // 20, bottom + height - side - side // 20
        groups = gl.GL_VIEWPORT_BIT | gl.GL_SCISSOR_BIT | gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT
        groups |= gl.GL_LINE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_TEXTURE_BIT

        with attrib(groups), flat_projection():
            gl.glViewport(*at, side, side)
            gl.glScissor(*at, side, side)
            gl.glEnable(gl.GL_SCISSOR_TEST)
            gl.glClearColor(*BACKGROUND)
            gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
            gl.glDisable(gl.GL_FOG)
            self._look(land.world.size / 2, frame)
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._texture.bind()
            quads = self._quads[choice.regions]
            with client_arrays(self._points, coordinates=[self._coordinates]):
                gl.glDrawElements(gl.GL_QUADS, quads.size, gl.GL_UNSIGNED_INT, quads)
            gl.glDisable(gl.GL_TEXTURE_2D)
            draw_tops(land, choice, FAINT)
            gl.glLineWidth(LINE)
            gl.glColor3f(*VIEW)
            ends = frustum_lines(clip, frame.eye)
            with client_arrays(ends):
                gl.glDrawArrays(gl.GL_LINES, 0, len(ends))

    def _look(self, middle: float, frame: Frame) -> None:
        """Set the camera that looks at the map, whose middle is there in x and z."""
        gl.glMatrixMode(gl.GL_PROJECTION)
        gl.glFrustum(-0.5, 0.5, -0.5, 0.5, 1.0, 200.0)
        gl.glMatrixMode(gl.GL_MODELVIEW)
        gl.glRotatef(LEAN, 1.0, 0.0, 0.0)
        gl.glRotatef(frame.pose.yaw, 0.0, 1.0, 0.0)
        back = np.array([frame.back[0], 0.0, frame.back[2]])
        back = back / max(np.linalg.norm(back), 1e-9) * BEHIND
        gl.glTranslatef(*(-(np.array([middle, ABOVE, middle]) + back)).tolist())

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        if self._texture is not None:
            self._texture.release()
            self._texture = None
