"""The great hall, seen through the castle's open door (``castle.depth``).

Technique: a portal. The opening is marked in the stencil buffer, and its depth set to the farthest.
Then the hall is drawn where the mark is, as if the wall had a hole, and at last the opening's own
depth is put back and the mark removed. The hall reaches through the castle's yard: it is only seen
through the door. It is the hall that one enters (landscape/hall): the same walls, at the same size.
The studio has baked their materials and their light into one texture, so that they are drawn in one
layer, and no light of OpenGL is on.
Not in the report. Where there is no stencil buffer, the opening keeps its painted glow.
State used: stencil test and operations, depth range, depth function, colour mask; no lighting.
"""

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib
from framelens.gl.texture import Texture
from landscape.elements.best.castle.open_door import half_arch
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.files.meshes import read_textured
from landscape.frame import Frame
from landscape.geometry.mesh import Mesh, grid_triangles, vertex_normals
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh

# Units of the castle's own frame; the door is at z = 0, about x = 0.5.
MESH, PICTURE = "castle_hall.ply", "castle_hall.jpg"  # made by studio/castle/great_hall.py
THICK = 0.10  # of the wall that the door leads through
# Chosen: light in the passage from the day outside, and from the hall; and how far the day reaches.
DAY, INNER = np.array([0.66, 0.65, 0.62]), np.array([0.30, 0.26, 0.21])
REACH = 0.05


def passage() -> Mesh:
    """Return the sides and the vault of the passage through the wall, darker towards the hall."""
    half = half_arch()
    line = np.concatenate([half * (1, 1), half[-2::-1] * (-1, 1)])
    depths = np.linspace(0.0, THICK, 5)
    grid = np.stack(
        [np.column_stack([0.5 + line[:, 0], line[:, 1], 0 * line[:, 0] + z]) for z in depths]
    )
    vertices = np.ascontiguousarray(grid.reshape(-1, 3), np.float32)
    triangles = np.ascontiguousarray(grid_triangles(len(line), len(depths)))
    around = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    u, v = np.meshgrid(around, depths)
    coordinates = np.stack([v.ravel(), -u.ravel()], axis=1).astype(np.float32)
    share = np.exp(-v.ravel() / REACH)[:, None]
    colours = np.ascontiguousarray(INNER + share * (DAY - INNER), np.float32)
    return Mesh(vertices, vertex_normals(vertices, triangles), triangles, (coordinates,), colours)


def threshold() -> Mesh:
    """Return the floor of the passage, which goes a little way out of it."""
    line = np.linspace(-0.02, THICK, 6)
    x, z = np.meshgrid([0.4, 0.6], line)
    places = np.stack([x.ravel(), 0 * x.ravel(), z.ravel()], axis=1).astype(np.float32)
    triangles = np.ascontiguousarray(grid_triangles(2, len(line)))
    coordinates = np.ascontiguousarray(places[:, [0, 2]])
    share = np.exp(-np.maximum(z.ravel(), 0.0) / REACH)[:, None]
    colours = np.ascontiguousarray(INNER + share * (DAY - INNER), np.float32)
    return Mesh(places, vertex_normals(places, triangles), triangles, (coordinates,), colours)


def hall(assets: Assets) -> Mesh:
    """Return the great hall as far as it can be seen through the opening, in the castle's frame."""
    vertices, triangles, colours, coordinates = read_textured(assets.path(MESH))
    normals = np.zeros_like(vertices)  # nothing lights it: the texture has its light
    return Mesh(vertices, normals, triangles, (coordinates,), colours)


class Doorway:
    """The hall behind the door, seen through the opening."""

    def __init__(self, assets: Assets, stones: Texture, opening: DisplayList) -> None:
        """Compile the hall; ``opening`` is the list that fills the opening."""
        self._stones, self._opening = stones, opening
        self._baked = Texture(read_image(assets.path(PICTURE), "RGB"), repeat=False)
        self._mesh = hall(assets)
        self._hall = DisplayList(self._send)

    def _send(self) -> None:
        gl.glEnable(gl.GL_TEXTURE_2D)
        self._stones.bind()
        gl.glMatrixMode(gl.GL_TEXTURE)
        gl.glPushMatrix()
        gl.glScalef(2.2, 2.2, 1.0)
        draw_mesh(passage())
        draw_mesh(threshold())
        gl.glPopMatrix()
        gl.glMatrixMode(gl.GL_MODELVIEW)
        self._baked.bind()
        draw_mesh(self._mesh)

    def draw(self, frame: Frame) -> None:
        """Draw what is seen through the opening; depth and stencil are left as if it were shut."""
        groups = gl.GL_STENCIL_BUFFER_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
        groups |= gl.GL_ENABLE_BIT | gl.GL_VIEWPORT_BIT | gl.GL_POLYGON_BIT | gl.GL_CURRENT_BIT
        with attrib(groups | gl.GL_TEXTURE_BIT):
            for off in (gl.GL_BLEND, gl.GL_LIGHTING, gl.GL_COLOR_MATERIAL):
                gl.glDisable(off)
            self._draw_opening(gl.GL_LESS, gl.GL_ALWAYS, gl.GL_REPLACE, depth=False)
            gl.glDepthRange(1.0, 1.0)
            self._draw_opening(gl.GL_ALWAYS, gl.GL_EQUAL, gl.GL_KEEP)
            gl.glDepthRange(0.0, 1.0)
            gl.glDepthFunc(gl.GL_LESS)
            gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
            self._hall.call()
            self._draw_opening(gl.GL_ALWAYS, gl.GL_EQUAL, gl.GL_ZERO)

    def _draw_opening(self, passes: int, stencil: int, does: int, depth: bool = True) -> None:
        """Draw the opening into depth, if wanted, and stencil buffer where its tests pass."""
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilFunc(stencil, 1, 1)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, does)
        gl.glDepthFunc(passes)
        gl.glDepthMask(gl.GL_TRUE if depth else gl.GL_FALSE)
        gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
        self._opening.call()
        if does == gl.GL_REPLACE:
            gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)

    def release(self) -> None:
        """Delete list and texture; may be called twice."""
        self._hall.release()
        self._baked.release()
