"""The images in the water: the land mirrored in it, and the bed below it, each in a texture.

Reflection: the land drawn from the camera mirrored at the water's plane, with the winding swapped;
a clip plane keeps what is above the water (the document has no need of one, since it draws by
material, that is by height; here cubes under water may be of any material).
Refraction: the land under the water, drawn from the same camera but nearer to the surface by the
ratio of the refractive indices, as it looks from above. It darkens with its depth: the fog
coordinate (GL_EXT_fog_coord, OpenGL 1.4) is the height of a vertex, where other fog takes its
distance from the eye. It lies in the vertices already, as their y. Without fog coordinates the
ground under water is fogged as all else, and does not darken.
What is wrong without: switches ``water.reflection`` and ``water.refraction``.
State used: framebuffer objects, GL_CLIP_PLANE0, the front face, GL_FOG_COORD_ARRAY.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, matrix
from landscape.elements import fog
from landscape.elements.settings import Fog
from landscape.gl.features import possible
from landscape.gl.texture_target import TextureTarget
from landscape.voxel.settings import Water

# Blocks, chosen: so far below the water's level the mirrored land goes on. Ripples at the shore
# show it, not a light line of sky. No block's top is so near below the water.
MIRRORED_BELOW = 0.5
FLATTER = 0.75  # 1 / 1.33: how much nearer to the surface things under water look from above


def about(level: float, times: float) -> np.ndarray:
    """Return the matrix (4, 4) that scales heights above or below ``level``; -1 mirrors them."""
    found = np.diag([1.0, times, 1.0, 1.0])
    found[1, 3] = level - times * level
    return found


@contextmanager
def clipped(level: float, above: bool) -> Iterator[None]:
    """Let the block draw only what is above ``level``, or below it; units of the current matrix."""
    sign = 1.0 if above else -1.0
    plane = np.array([0.0, sign, 0.0, -sign * level], np.float64)
    with attrib(gl.GL_TRANSFORM_BIT | gl.GL_ENABLE_BIT):
        gl.glClipPlane(gl.GL_CLIP_PLANE0, plane)
        gl.glEnable(gl.GL_CLIP_PLANE0)
        yield


class WaterImages:
    """Owner of the two textures; their size follows the window's."""

    def __init__(self, values: Water) -> None:
        """Make no texture yet: the size of the window is not known."""
        self.values = values
        self.reflection: TextureTarget | None = None
        self.refraction: TextureTarget | None = None
        self.darkens = possible("water.clear")

    def _target(self, kept: TextureTarget | None, viewport: tuple[int, int]) -> TextureTarget:
        """Return a target of the right size, the kept one if it is."""
        size = (
            max(1, round(viewport[0] * self.values.resolution)),
            max(1, round(viewport[1] * self.values.resolution)),
        )
        if kept is not None and kept.size == size:
            return kept
        if kept is not None:
            kept.release()
        return TextureTarget(size)

    def draw_reflection(
        self,
        viewport: tuple[int, int],
        level: float,
        block: float,
        draw: Callable[[np.ndarray], None],
        above: bool = True,
    ) -> None:
        """Draw what the water mirrors: ``draw`` is called under the mirror matrix, and with it.

        ``block`` is a cube's side in units. From beneath the surface mirrors what is not ``above``.
        """
        more = MIRRORED_BELOW * block
        self.reflection = self._target(self.reflection, viewport)
        with self.reflection.drawing(), matrix(), attrib(gl.GL_POLYGON_BIT):
            mirror = about(level, -1.0)
            gl.glMultMatrixf(np.ascontiguousarray(mirror.T, np.float32))
            gl.glFrontFace(gl.GL_CW)
            with clipped(level - more if above else level + more, above):
                draw(mirror)

    def draw_window(
        self,
        viewport: tuple[int, int],
        level: float,
        block: float,
        sky: Fog,
        draw: Callable[[np.ndarray], None],
    ) -> None:
        """Draw what is above the water, as it is seen from beneath, in the place of the refraction.

        ``sky`` is the fog of the air.
        """
        self.refraction = self._target(self.refraction, viewport)
        with attrib(gl.GL_FOG_BIT | gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT):
            gl.glClearColor(*sky.color, 1.0)
            with self.refraction.drawing(), matrix():
                higher = about(level, 1.0 / FLATTER)
                gl.glMultMatrixf(np.ascontiguousarray(higher.T, np.float32))
                if sky.enabled:
                    fog.enable(sky)
                else:
                    gl.glDisable(gl.GL_FOG)
                with clipped(level - block, above=True):
                    draw(higher)

    def draw_refraction(
        self,
        viewport: tuple[int, int],
        level: float,
        block: float,
        draw: Callable[[np.ndarray], None],
    ) -> None:
        """Draw what lies under the water, darker with depth; ``block`` is a cube's side in units.

        A little of the shore above the water belongs to it, where ripples may let one see it.
        """
        values = self.values
        self.refraction = self._target(self.refraction, viewport)
        groups = gl.GL_FOG_BIT | gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT

        with attrib(groups):
            gl.glClearColor(*values.color, 1.0)
            with self.refraction.drawing(), matrix():
                # By Walter's model each point of the water looks elsewhere (water_grid.py).
                flatter = about(level, FLATTER if values.bending == "flat" else 1.0)
                gl.glMultMatrixf(np.ascontiguousarray(flatter.T, np.float32))
                if self.darkens:
                    self._fog_by_depth(level / block)
                with clipped(level + block, above=False):
                    draw(flatter)
            if self.darkens:  # Mesa's glPopAttrib does not restore it.
                gl.glFogi(gl.GL_FOG_COORD_SRC, gl.GL_FRAGMENT_DEPTH)

    def _fog_by_depth(self, level: float) -> None:
        """Let fog grow from none at ``level`` to all at the depth ``clear``, both in blocks.

        The linear fog f = (end - c) / (end - start) does not mind that c sinks from start to end.
        """
        gl.glEnable(gl.GL_FOG)
        gl.glFogi(gl.GL_FOG_MODE, gl.GL_LINEAR)
        gl.glFogi(gl.GL_FOG_COORD_SRC, gl.GL_FOG_COORD)
        gl.glFogf(gl.GL_FOG_START, level)
        gl.glFogf(gl.GL_FOG_END, level - self.values.clear)
        gl.glFogfv(gl.GL_FOG_COLOR, np.array([*self.values.color, 1.0], np.float32))

    def release(self) -> None:
        """Delete the textures; may be called twice."""
        for target in (self.reflection, self.refraction):
            if target is not None:
                target.release()
        self.reflection = self.refraction = None
