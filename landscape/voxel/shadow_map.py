"""Shadows: what the sun sees, as a picture of depths (TP2, part 4).

Technique: the land is drawn from the sun into a depth texture (ARB_depth_texture). When it is drawn
from the eye, OpenGL generates for each vertex its place in that picture (GL_EYE_LINEAR, with the
rows of bias * projection * view of the sun as planes, given while the modelview matrix is the
camera's), and the lookup compares its depth with the one stored (ARB_shadow): 1 in the light, 0 in
shadow. What remains in shadow, the light of the sky, is mixed in by the combiner:
- unit 0 has the tile, but computes light = mix(sky's colour, 1, unit 1's answer);
- unit 1 has the picture of depths, and multiplies by unit 0's tile (GL_ARB_texture_env_crossbar);
- unit 2 multiplies by the vertex colour.
The picture covers a square around the eye that moves in whole texels, so that shadows of what
stands still do not crawl, and is drawn again only when it has moved or the land has changed.
State used: a framebuffer object, GL_POLYGON_OFFSET_FILL, texture units 0 to 2, GL_COMBINE.
What is wrong without: ``shadow.offset`` (faces shade themselves in stripes), ``shadow.snapped``
(edges crawl). Beyond the square there are no shadows, only faces turned away from the sun.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

import numpy as np

from landscape.elements import sun
from landscape.gl import depth_target
from landscape.gl.calls import gl
from landscape.gl.depth_target import DepthTarget
from landscape.gl.display_list import DisplayList
from landscape.gl.extensions import COMBINE, CROSSBAR
from landscape.gl.state import attrib, combine, flat_projection
from landscape.gl.texture import Texture
from landscape.voxel.settings import Settings
from landscape.voxel.visibility import CORNERS

NEEDS = (*depth_target.NEEDS, COMBINE, CROSSBAR)
UNITS = 3
BIAS = np.array([[0.5, 0, 0, 0.5], [0, 0.5, 0, 0.5], [0, 0, 0.5, 0.5], [0, 0, 0, 1]])
AROUND = 2  # texels, chosen: drawn around what has changed
STEP = 64  # texels, chosen: the square moves by whole multiples of this


def light_axes(towards: np.ndarray) -> np.ndarray:
    """Return the rotation (3, 3) to the sun's eye space: rows right, up and towards the sun."""
    right = np.cross((0.0, 1.0, 0.0), towards)
    if np.linalg.norm(right) < 1e-6:
        right = np.array([1.0, 0.0, 0.0])
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(towards, right), towards])


def light_matrix(
    towards: np.ndarray, eye: np.ndarray, reach: float, depth: float, step: float
) -> np.ndarray:
    """Return the sun's projection times view (4, 4), for column vectors.

    It covers a square of ``reach`` units to each side of the eye and ``depth`` units towards the
    sun and away. The middle of the square is a multiple of ``step`` units; 0 leaves it at the eye.
    """
    axes = light_axes(towards)
    middle = axes @ eye
    if step:
        middle[:2] = np.round(middle[:2] / step) * step
        middle[2] = np.round(middle[2])
    scale = np.array([1 / reach, 1 / reach, -1 / depth])
    found = np.eye(4)
    found[:3, :3] = scale[:, None] * axes
    found[:3, 3] = -scale * middle
    return found


def part_of(
    boxes: Sequence[tuple[np.ndarray, np.ndarray]], matrix: np.ndarray, side: int
) -> tuple[int, int, int, int]:
    """Return the part of the picture in which boxes, in units, are: x, y, width, height in texels.

    ``matrix`` (4, 4) is the sun's, ``side`` that of the picture.
    """
    ends = np.array(boxes)[:, CORNERS.astype(int), np.arange(3)].reshape(-1, 3)
    x, y, _ = matrix[:3, :3] @ ends.T + matrix[:3, 3:]
    low, high = (
        [int(np.clip((edge(at) * 0.5 + 0.5) * side + out, 0, side)) for at in (x, y)]
        for edge, out in ((np.min, -AROUND), (np.max, AROUND + 1))
    )
    return low[0], low[1], max(high[0] - low[0], 1), max(high[1] - low[1], 1)


def enlarged(matrix: np.ndarray, part: tuple[int, int, int, int], side: int) -> np.ndarray:
    """Return a matrix that lets only a part of the picture be seen, but in the whole of it."""
    found = matrix.copy()
    for axis in (0, 1):
        scale = side / part[2 + axis]
        middle = (part[axis] + part[2 + axis] / 2) / side * 2 - 1
        found[axis] = scale * (found[axis] - middle * found[3])
    return found


class ShadowMap:
    """The sun's picture of depths, and the state that draws with it."""

    def __init__(self, settings: Settings) -> None:
        """Make the depth texture."""
        self.settings = settings
        self.target = DepthTarget(settings.shadow.size)
        self._white = Texture(np.full((1, 1, 3), 255, np.uint8), mipmaps=False)
        self._units = DisplayList(self._set_units)
        self._drawn: tuple[bytes, int] | None = None
        self.matrix = np.eye(4)

    def update(
        self,
        eye: np.ndarray,
        version: int,
        touched: Sequence[tuple[np.ndarray, np.ndarray]],
        draw: Callable[[np.ndarray], None],
    ) -> None:
        """Draw the picture again if the eye has left its square, or ``version`` is another.

        Only the part of ``touched`` is drawn, boxes in units, if all changes were in these: one
        for each version. ``draw`` sends the land's shapes that are seen through the matrix it is
        given; the modelview is then the world's.
        """
        values = self.settings.shadow
        texel = 2 * values.distance / values.size
        towards = sun.direction(self.settings.sun).astype(np.float64)
        step = STEP * texel if values.snapped else 0.0
        # Towards the sun, what casts a shadow may be as far away as the shadow is long.
        depth = 2 * values.distance + 10.0
        self.matrix = light_matrix(towards, eye, values.distance, depth, step)
        wanted = self.matrix.tobytes(), version
        if wanted == self._drawn:
            return
        former, self._drawn = self._drawn, wanted
        part, seen = None, self.matrix
        if former == (wanted[0], version - len(touched)):
            part = part_of(touched, self.matrix, values.size)
            seen = enlarged(self.matrix, part, values.size)
        with (
            self.target.drawing(part),
            flat_projection(),
            attrib(gl.GL_ENABLE_BIT | gl.GL_POLYGON_BIT),
        ):
            gl.glMatrixMode(gl.GL_PROJECTION)
            gl.glLoadMatrixf(np.ascontiguousarray(self.matrix.T, np.float32))
            gl.glMatrixMode(gl.GL_MODELVIEW)
            gl.glDisable(gl.GL_FOG)
            if values.offset:
                gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
                gl.glPolygonOffset(2.0, 4.0)
            draw(seen)

    def _set_units(self) -> None:
        """Set the equations of the three units; unit 1 is active before it, unit 0 after it."""
        combine({"COMBINE_RGB": "MODULATE", "SRC0_RGB": "PREVIOUS", "SRC1_RGB": "TEXTURE0"})
        combine({"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": "PREVIOUS"})
        gl.glActiveTexture(gl.GL_TEXTURE2)
        gl.glEnable(gl.GL_TEXTURE_2D)
        self._white.bind()
        combine({"COMBINE_RGB": "MODULATE", "SRC0_RGB": "PREVIOUS"})
        combine({"SRC1_RGB": "PRIMARY_COLOR"})
        combine({"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": "PREVIOUS"})
        gl.glActiveTexture(gl.GL_TEXTURE0)
        combine({"COMBINE_RGB": "INTERPOLATE", "SRC0_RGB": "PRIMARY_COLOR"})
        combine({"OPERAND0_RGB": "SRC_ALPHA", "SRC1_RGB": "CONSTANT", "SRC2_RGB": "TEXTURE1"})
        combine({"OPERAND2_RGB": "SRC_COLOR"})
        combine({"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": "TEXTURE"})
        shade = np.array([*self.settings.shadow.color, 1.0], np.float32)
        gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, shade)

    @contextmanager
    def applied(self) -> Iterator[None]:
        """Let the block draw what shadows fall on, with its tiles on unit 0.

        The modelview matrix must be the camera's, mirrored or not.
        """
        planes = np.ascontiguousarray(BIAS @ self.matrix, np.float32)
        with attrib(gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT):
            gl.glActiveTexture(gl.GL_TEXTURE1)
            gl.glEnable(gl.GL_TEXTURE_2D)
            self.target.bind()
            for name, plane in zip("STRQ", planes, strict=True):
                coordinate = getattr(gl, f"GL_{name}")
                gl.glTexGeni(coordinate, gl.GL_TEXTURE_GEN_MODE, gl.GL_EYE_LINEAR)
                gl.glTexGenfv(coordinate, gl.GL_EYE_PLANE, plane)
                gl.glEnable(getattr(gl, f"GL_TEXTURE_GEN_{name}"))
            self._units.call()
            yield

    def apply(self, settings: Settings) -> bool:
        """Apply settings; return False if texture or display list must be made again."""
        if settings.shadow.size != self.settings.shadow.size:
            return False
        if settings.shadow.color != self.settings.shadow.color:
            return False
        self.settings = settings
        self._drawn = None
        return True

    def release(self) -> None:
        """Delete the textures; may be called twice."""
        self._units.release()
        self.target.release()
        self._white.release()
