"""The mirror image in a pass of its own, where there are too few texture units for one pass.

The sea's grid is drawn with the mirror image alone; the water is then blended over it, as in 2006
over an image in the framebuffer. Where the sea is shallow the vertices' alpha lets the bottom show.
What is wrong with it: each place shows one image, so far ripples break it up less.
State used: one texture unit and its matrix, GL_BLEND.
"""

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays
from landscape.elements.best.sea.mirror_image import Taken, projected


def draw_mirror(
    mirror: Taken,
    vertices: np.ndarray,
    places: np.ndarray,
    hidden: np.ndarray | float,
    triangles: np.ndarray,
) -> None:
    """Blend the image, looked up at places (n, 3), over what is below vertices (n, 3).

    ``hidden`` is how much of the bottom the water hides, 0..1, at each vertex (n,) or everywhere.
    """
    colors = np.ones((len(vertices), 4), np.float32)
    colors[:, 3] = hidden
    with (
        attrib(gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT | gl.GL_DEPTH_BUFFER_BIT),
        client_arrays(vertices, None, colors, [places]),
        projected(mirror, 0),
    ):
        gl.glDisable(gl.GL_LIGHTING)
        gl.glDepthMask(gl.GL_FALSE)  # the water comes next, at the same depths
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
        gl.glDrawElements(gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles)
