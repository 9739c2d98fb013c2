"""The sun's glints on the sea: sharp sparks instead of the specular light's milky spots.

Technique: a second, additive pass (GL_SRC_ALPHA, GL_ONE) over the rows of the grid where the sun
may be mirrored. Each vertex' alpha says how near the water's slope there comes to the one that
mirrors the sun; two units add sparks that drift against each other, and the combiner keeps only
the sum's peaks (GL_ADD, then GL_ADD_SIGNED with GL_ALPHA_SCALE 4; OpenGL 1.3): dense in the
path's middle, single sparks at its borders, twinkling with kt.
State used: two texture units with their matrices, GL_BLEND, no lighting, fog or depth writes.
"""

import numpy as np

from landscape.elements import sun
from landscape.elements.fog import visibility
from landscape.elements.sea.waves import EyeGrid
from landscape.frame import Frame
from landscape.gl.calls import gl
from landscape.gl.state import attrib, client_arrays, combine, matrix
from landscape.gl.texture import Texture
from landscape.settings import Settings

ELEMENT = "water"

SPREAD = 0.15  # chosen: slope by which the ripples too small for the grid scatter the sun
FAINT = 0.22  # chosen: share of the sun under which even the strongest sparks stay dark
PEAK = 0.42  # chosen: alpha in the middle of the path
TILES = (2.6, 3.7)  # chosen: tiles of sparks per unit, of either layer
DRIFT = (0.0031, -0.0043)  # chosen: tiles per kt
SIZE = 256  # chosen: texels per side of the sparks
FINE = 42.0  # chosen: sparks along a side of the tile


def sparks(size: int = SIZE, seed: int = 2006) -> np.ndarray:
    """Return a tile of sparks as a white picture, uint8 (size, size, 4); alpha up to 0.3."""
    noise = np.fft.fft2(np.random.default_rng(seed).standard_normal((size, size)))
    k = np.hypot(*np.meshgrid(*[np.fft.fftfreq(size) * size] * 2))
    wave = np.fft.ifft2(noise * np.exp(-np.square((k - FINE) / (0.5 * FINE)))).real
    picture = np.full((size, size, 4), 255, np.uint8)
    picture[..., 3] = np.clip(0.06 + 0.08 * wave / wave.std(), 0.0, 0.3) * 255 + 0.5
    return picture


def sun_share(
    grid: EyeGrid, slope_x: np.ndarray, slope_z: np.ndarray, towards: np.ndarray
) -> np.ndarray:
    """Return 0..1, (rows, columns): how near each place comes to mirroring the sun at the eye.

    The normal that does is half-way between the sun (3,) and the line of sight.
    """
    away = np.hypot(grid.ring, grid.height)[:, None]
    half_x = towards[0] - grid.ring[:, None] / away * grid.east
    half_z = towards[2] - grid.ring[:, None] / away * grid.south
    half_y = towards[1] + grid.height / away
    off = np.square(slope_x + half_x / half_y) + np.square(slope_z + half_z / half_y)
    return np.exp(off * np.float32(-0.5 / SPREAD**2))


def bright_part(triangles: np.ndarray, share: np.ndarray) -> np.ndarray:
    """Return a grid's triangles (m, 3) in the least rectangle that holds all of FAINT and more."""
    bright = share > FAINT
    rows, columns = (np.flatnonzero(bright.any(axis=axis)) for axis in (1, 0))
    if not len(rows):
        return triangles[:0]
    cells = triangles.reshape(share.shape[0] - 1, share.shape[1] - 1, 2, 3)
    first, left = max(rows[0] - 1, 0), max(columns[0] - 1, 0)
    part = cells[first : rows[-1] + 1, left : columns[-1] + 1]
    return np.ascontiguousarray(part.reshape(-1, 3))


class Glitter:
    """The sparks over the sea."""

    def __init__(self) -> None:
        """Make the tile of sparks."""
        self._texture = Texture(sparks())

    def draw(
        self,
        frame: Frame,
        settings: Settings,
        grid: EyeGrid,
        sea: tuple[np.ndarray, np.ndarray],
        slopes: tuple[np.ndarray, np.ndarray],
    ) -> None:
        """Add the glints to a ``sea`` of vertices (n, 3) at places x, z (n, 2), with slopes."""
        vertices, places = sea
        share = sun_share(grid, *slopes, sun.direction(settings.sun))
        if settings.fog.enabled and settings.fog.mode == "exp2":
            away = np.hypot(grid.ring, grid.height)
            share *= visibility(away, settings.fog.density).astype(np.float32)[:, None]
        triangles = bright_part(grid.triangles, share)
        if not len(triangles):
            return
        colors = np.empty((len(vertices), 4), np.float32)
        colors[:, :3] = 2.4 * settings.water.glitter * np.array(settings.sun.diffuse)
        colors[:, 3] = PEAK * share.ravel()
        groups = gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT
        with attrib(groups | gl.GL_DEPTH_BUFFER_BIT):
            for cap in (gl.GL_LIGHTING, gl.GL_FOG):
                gl.glDisable(cap)
            gl.glDepthMask(gl.GL_FALSE)
            gl.glDepthFunc(gl.GL_LEQUAL)
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE)
            self._layer(1, "ADD_SIGNED", 4.0)
            self._layer(0, "ADD", 1.0)
            with client_arrays(vertices, None, colors, [places, places]):
                gl.glMatrixMode(gl.GL_TEXTURE)
                with matrix():
                    self._move(0, frame.kt)
                    gl.glActiveTexture(gl.GL_TEXTURE1)
                    with matrix():
                        self._move(1, frame.kt)
                        gl.glDrawElements(
                            gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles
                        )
                    gl.glActiveTexture(gl.GL_TEXTURE0)
                gl.glMatrixMode(gl.GL_MODELVIEW)

    def _layer(self, unit: int, mode: str, scale: float) -> None:
        gl.glActiveTexture(getattr(gl, f"GL_TEXTURE{unit}"))
        gl.glEnable(gl.GL_TEXTURE_2D)
        self._texture.bind()
        combine({"COMBINE_RGB": "REPLACE", "SRC0_RGB": "PRIMARY_COLOR", "COMBINE_ALPHA": mode})
        combine({"SRC0_ALPHA": "PREVIOUS", "SRC1_ALPHA": "TEXTURE"})
        gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_ALPHA_SCALE, scale)

    def _move(self, layer: int, kt: float) -> None:
        """Give the active unit's matrix the layer's scale and drift, less whole tiles."""
        gl.glTranslatef(kt * DRIFT[layer] % 1.0, kt * DRIFT[1 - layer] % 1.0, 0.0)
        gl.glScalef(TILES[layer], TILES[layer], 1.0)

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        self._texture.release()
