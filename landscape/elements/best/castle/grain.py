"""The grain of the weathered castle's stones within an arm's length: one more pass over the walls.

Technique: a small tile of pits and grain, its mean mid grey, is blended over the lit walls by
glBlendFunc(GL_DST_COLOR, GL_SRC_COLOR): twice the product, so mid grey changes nothing. Farther
away its mip levels are all but mid grey, so it fades out by itself; the fog's colour is mid grey
meanwhile. No OpenGL here but in :func:`grained`.
"""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, matrix
from framelens.gl.texture import Texture

SIDE = 128  # texels of the tile, a power of two
FINER = 7.0  # chosen: tiles per tile of the walls' own picture
CONTRAST = 0.07  # chosen: standard deviation, of 1


def grain() -> np.ndarray:
    """Return the tile, uint8 (SIDE, SIDE, 1), which repeats without a seam."""
    rng = np.random.default_rng(5)
    k = np.fft.fftfreq(SIDE) * SIDE
    far = np.hypot(k[:, None], k[None, :])
    rough = np.where(far >= 4, np.maximum(far, 1.0) ** -0.9, 0.0)
    noise = np.fft.ifft2(np.fft.fft2(rng.standard_normal((SIDE, SIDE))) * rough).real
    noise /= noise.std()
    # Lit from the upper left, like the picture of the walls; deep places are dark.
    relief = noise - np.roll(noise, (1, 1), (0, 1))
    shade = 0.6 * relief / relief.std() + 0.6 * np.minimum(noise, 0.8)
    shade -= shade.mean()
    return np.asarray(np.clip(0.5 + CONTRAST * shade, 0, 1) * 255 + 0.5, np.uint8)[..., None]


@contextmanager
def grained(tile: Texture) -> Iterator[None]:
    """Give the walls that the block draws again the grain; unit 0 has their coordinates."""
    groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_FOG_BIT
    groups |= gl.GL_CURRENT_BIT | gl.GL_POLYGON_BIT | gl.GL_TEXTURE_BIT
    with attrib(groups):
        gl.glDisable(gl.GL_LIGHTING)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_DST_COLOR, gl.GL_SRC_COLOR)
        gl.glDepthFunc(gl.GL_LEQUAL)
        gl.glDepthMask(gl.GL_FALSE)
        gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glPolygonOffset(-0.5, -1.0)
        gl.glFogfv(gl.GL_FOG_COLOR, np.full(4, 0.5, np.float32))
        gl.glColor3f(1.0, 1.0, 1.0)
        gl.glEnable(gl.GL_TEXTURE_2D)
        tile.bind()
        gl.glMatrixMode(gl.GL_TEXTURE)
        with matrix():
            gl.glScalef(FINER, FINER, 1.0)
            gl.glMatrixMode(gl.GL_MODELVIEW)
            yield
            gl.glMatrixMode(gl.GL_TEXTURE)

        gl.glMatrixMode(gl.GL_MODELVIEW)
