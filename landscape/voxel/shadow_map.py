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
stands still do not crawl, and is drawn again only when it has moved or the land has changed. In a
walk that would take too long for one frame: a second picture is drawn, some regions in each frame,
and replaces the first, which still holds all but a strip, when it is done.
State used: a framebuffer object, GL_POLYGON_OFFSET_FILL, texture units 0 to 2, GL_COMBINE.
What is wrong without: ``shadow.offset`` (faces shade themselves in stripes), ``shadow.snapped``
(edges crawl). Beyond the square there are only the shadows of far_shadows.py.
"""

from collections.abc import Callable, Hashable, Iterator, Sequence
from contextlib import contextmanager
from typing import Self

import numpy as np

from framelens.gl.named import gl_constant
from framelens.gl.seam import gl
from framelens.gl.state import attrib, combine, flat_projection
from framelens.gl.texture import Texture
from landscape.elements import sun
from landscape.elements.element import Element, Site
from landscape.gl.depth_target import DepthTarget
from landscape.gl.display_list import DisplayList
from landscape.voxel.settings import Settings
from landscape.voxel.sun_view import enlarged, light_matrix, part_of

BIAS = np.array([[0.5, 0, 0, 0.5], [0, 0.5, 0, 0.5], [0, 0, 0.5, 0.5], [0, 0, 0, 1]])
STEP = 64  # texels, chosen: the square moves by whole multiples of this
FRAMES = 12  # chosen: over how many the next picture is drawn
Share = tuple[int, int]  # k, n: every n-th of the land's regions, from k on
WHOLE: Share = 0, 1
LEFT = 3 * STEP  # texels, chosen: so far from its middle a picture is drawn whole, at once


class ShadowMap(Element[Settings]):
    """The sun's picture of depths, and the state that draws with it."""

    @classmethod
    def serves(cls, settings: Settings) -> bool:
        """Return whether the sun casts shadows."""
        return settings.shadow.enabled

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return what the constructor uses of the settings."""
        return settings.shadow.size

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        """Build it; it needs no files."""
        return cls(site.settings)

    def __init__(self, settings: Settings) -> None:
        """Make the depth texture."""
        self.settings = settings
        self.target = DepthTarget(settings.shadow.size)
        self._next: DepthTarget | None = None  # the second picture: only a walk needs it
        self._white = Texture(np.full((1, 1, 3), 255, np.uint8), mipmaps=False)
        self._state: DisplayList | None = None  # what draws with the picture, once there is one
        self._version: int | None = None  # the land's, of what is drawn
        self.matrix = np.eye(4)
        self._coming = self.matrix  # the matrix of the second picture
        self._parts = 0  # how much of the second picture is drawn

    def update(
        self,
        eye: np.ndarray,
        version: int,
        touched: Sequence[tuple[np.ndarray, np.ndarray]],
        draw: Callable[[np.ndarray, Share], None],
        walking: bool = False,
    ) -> None:
        """Draw the picture again if the eye has left its square, or ``version`` is another.

        Only the part of ``touched`` is drawn, boxes in units, if all changes were in these: one
        for each version. ``draw`` sends the land's shapes that are seen through the matrix it is
        given, of a share of its regions: k, n for every n-th from k on; the modelview is then the
        world's. When ``walking``, another square's picture is drawn over the next frames.
        """
        matrix, size = self._around(eye), self.settings.shadow.size
        known = self._version == version - len(touched)
        self._version = version
        away = np.abs(matrix - self.matrix)[:2, 3].max() / 2 * size  # texels
        if known and walking and self.settings.shadow.snapped and away <= LEFT:
            self._change(self.target, self.matrix, touched, draw)
            if self._next and self._parts:
                self._change(self._next, self._coming, touched, draw)
            self._draw_next(matrix, draw)
            return

        self._parts = 0
        if known and (matrix == self.matrix).all():
            self._change(self.target, matrix, touched, draw)
        else:
            self.matrix = matrix
            self._forget_state()
            with self._drawing(self.target, matrix):
                draw(matrix, WHOLE)

    def covers(self, low: np.ndarray, high: np.ndarray) -> np.ndarray:
        """Return which boxes from ``low`` to ``high`` (n, 3) lie wholly in the picture's square."""
        across = self.matrix[:2, :3]
        middle = (low + high) / 2 @ across.T + self.matrix[:2, 3]
        half = (high - low) / 2 @ np.abs(across).T
        return np.asarray((np.abs(middle) + half <= 1.0).all(axis=1))

    def _around(self, eye: np.ndarray) -> np.ndarray:
        """Return the sun's matrix (4, 4) for the square around an eye."""
        values = self.settings.shadow
        step = STEP * 2 * values.distance / values.size if values.snapped else 0.0
        # Towards the sun, what casts a shadow may be as far away as the shadow is long.
        depth = 2 * values.distance + 10.0
        towards = sun.direction(self.settings.sun).astype(np.float64)
        return light_matrix(towards, eye, values.distance, depth, step)

    def _change(
        self,
        target: DepthTarget,
        matrix: np.ndarray,
        touched: Sequence[tuple[np.ndarray, np.ndarray]],
        draw: Callable[[np.ndarray, Share], None],
    ) -> None:
        """Draw the part of a picture again in which boxes are, in units."""
        if touched:
            part = part_of(touched, matrix, target.side)
            with self._drawing(target, matrix, part):
                draw(enlarged(matrix, part, target.side), WHOLE)

    def _draw_next(self, matrix: np.ndarray, draw: Callable[[np.ndarray, Share], None]) -> None:
        """Begin the second picture if another square is wanted, or go on; then show it."""
        if not self._parts:
            if (matrix == self.matrix).all():
                return
            self._coming = matrix
            self._next = self._next or DepthTarget(self.target.side)
        assert self._next is not None
        with self._drawing(self._next, self._coming, clear=self._parts == 0):
            draw(self._coming, (self._parts, FRAMES))
        self._parts = (self._parts + 1) % FRAMES
        if not self._parts:
            self.target, self._next = self._next, self.target
            self.matrix = self._coming
            self._forget_state()

    @contextmanager
    def _drawing(
        self,
        target: DepthTarget,
        matrix: np.ndarray,
        part: tuple[int, int, int, int] | None = None,
        clear: bool = True,
    ) -> Iterator[None]:
        """Let the block draw into a picture, or a part of it, as the sun sees it."""
        with (
            target.drawing(part, clear),
            flat_projection(),
            attrib(gl.GL_ENABLE_BIT | gl.GL_POLYGON_BIT),
        ):
            gl.glMatrixMode(gl.GL_PROJECTION)
            gl.glLoadMatrixf(np.ascontiguousarray(matrix.T, np.float32))
            gl.glMatrixMode(gl.GL_MODELVIEW)
            gl.glDisable(gl.GL_FOG)
            if self.settings.shadow.offset:
                gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
                gl.glPolygonOffset(2.0, 4.0)
            yield

    def look_up(self) -> None:
        """Bind the picture to the active unit, and generate its coordinates.

        The modelview matrix must be the camera's, mirrored or not.
        """
        gl.glEnable(gl.GL_TEXTURE_2D)
        self.target.bind()
        planes = np.ascontiguousarray(BIAS @ self.matrix, np.float32)
        for name, plane in zip("STRQ", planes, strict=True):
            coordinate = gl_constant(f"GL_{name}")
            gl.glTexGeni(coordinate, gl.GL_TEXTURE_GEN_MODE, gl.GL_EYE_LINEAR)
            gl.glTexGenfv(coordinate, gl.GL_EYE_PLANE, plane)
            gl.glEnable(gl_constant(f"GL_TEXTURE_GEN_{name}"))

    def _set_state(self) -> None:
        """Bind the picture, generate its coordinates, and set the equations of the three units."""
        gl.glActiveTexture(gl.GL_TEXTURE1)
        self.look_up()
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

    def _forget_state(self) -> None:
        """Let the state be compiled again: the picture, its place or its colour is another."""
        if self._state is not None:
            self._state.release()
            self._state = None

    @contextmanager
    def applied(self) -> Iterator[None]:
        """Let the block draw what shadows fall on, with its tiles on unit 0.

        The modelview matrix must be the camera's, mirrored or not. All is in a display list, which
        takes the planes through the matrix that is current when it is called.
        """
        self._state = self._state or DisplayList(self._set_state)
        with attrib(gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT):
            self._state.call()
            yield

    def take(self, settings: Settings) -> None:
        """Take other settings; the picture is drawn again."""
        if settings.shadow.color != self.settings.shadow.color:
            self._forget_state()
        self.settings = settings
        self._version = None

    def release(self) -> None:
        """Delete the textures; may be called twice."""
        self._forget_state()
        self.target.release()
        if self._next is not None:
            self._next.release()
        self._white.release()
