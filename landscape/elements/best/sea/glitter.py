"""The sun's glints on the sea: sharp sparks, where specular lighting would make milky spots.

Technique: a second, additive pass (GL_SRC_ALPHA, GL_ONE) over the part of the grid that may mirror
the sun. The alpha of a vertex says how close the water's slope there is to the one that mirrors
the sun to the eye; two texture units add sparks that drift against each other, and the combiner
keeps only the peaks of the sum (GL_ADD, then GL_ADD_SIGNED with GL_ALPHA_SCALE 4; OpenGL 1.3):
dense in the middle of the sun's path, single sparks at its borders, twinkling with kt.
State used: two texture units with their matrices, GL_BLEND, no lighting, fog or depth writes.
"""

import numpy as np

from framelens.gl.named import texture_unit
from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays, combine, matrix
from framelens.gl.texture import Texture
from landscape.elements import sun
from landscape.elements.best.sea.eye_grid import EyeGrid
from landscape.elements.fog import visibility
from landscape.elements.settings import Settings
from landscape.frame import Frame

LONG = 3.0  # chosen: a strip of the grid is too long if its far side is so many times farther
FAINT = 0.22  # chosen: intensity of the sun below which even the strongest sparks stay dark
PEAK = 0.42  # chosen: alpha in the middle of the path
TILES = (2.6, 3.7)  # chosen: tiles of sparks per unit, by layer
DRIFT = (0.0031, -0.0043)  # chosen: tiles per kt
BRIGHTNESS = 2.4  # chosen: times water.glitter and the sun's colour
SIZE = 256  # chosen: texels per side of the sparks
FINE = 42.0  # chosen: sparks along a side of the tile


def sparks(size: int = SIZE, seed: int = 2006) -> np.ndarray:
    """Return a tile of sparks, a white picture, uint8 (size, size, 4), of alpha up to 0.3."""
    noise = np.fft.fft2(np.random.default_rng(seed).standard_normal((size, size)))
    k = np.hypot(*np.meshgrid(*[np.fft.fftfreq(size) * size] * 2))
    wave = np.fft.ifft2(noise * np.exp(-np.square((k - FINE) / (0.5 * FINE)))).real
    picture = np.full((size, size, 4), 255, np.uint8)
    picture[..., 3] = np.clip(0.06 + 0.08 * wave / wave.std(), 0.0, 0.3) * 255 + 0.5
    return picture


def sun_intensity(
    grid: EyeGrid,
    slope_x: np.ndarray,
    slope_z: np.ndarray,
    towards: np.ndarray,
    spread: float,
) -> np.ndarray:
    """Return 0..1, (rows, columns): how strongly each place mirrors the sun to the eye.

    ``towards`` (3,) is the direction of the sun, ``spread`` the standard deviation of the slopes
    of ripples too small for the grid. The normal that mirrors it is half-way between the
    sun and the line of sight; the intensity is a Gaussian of the difference between the slope and
    that normal's slope.
    """
    half_x = towards[0] - grid.ring[:, None] / grid.sight * grid.east
    half_z = towards[2] - grid.ring[:, None] / grid.sight * grid.south
    half_y = towards[1] + grid.height / grid.sight
    off = np.square(slope_x + half_x / half_y) + np.square(slope_z + half_z / half_y)
    return np.exp(off * np.float32(-0.5 / spread**2))


def bright_triangles(triangles: np.ndarray, intensity: np.ndarray) -> np.ndarray:
    """Return a grid's triangles (m, 3) in the smallest rectangle with all vertices over FAINT."""
    bright = intensity > FAINT
    rows, columns = (np.flatnonzero(bright.any(axis=axis)) for axis in (1, 0))
    if not len(rows):
        return triangles[:0]
    cells = triangles.reshape(intensity.shape[0] - 1, intensity.shape[1] - 1, 2, 3)
    first, left = max(rows[0] - 1, 0), max(columns[0] - 1, 0)
    kept = cells[first : rows[-1] + 1, left : columns[-1] + 1]
    return np.ascontiguousarray(kept.reshape(-1, 3))


class Glitter:
    """The sparks over the sea; Sea draws them with its own vertices."""

    def __init__(self) -> None:
        """Make and upload the tile of sparks."""
        self._texture = Texture(sparks())

    def draw(
        self,
        frame: Frame,
        settings: Settings,
        grid: EyeGrid,
        surface: tuple[np.ndarray, np.ndarray],
        slopes: tuple[np.ndarray, np.ndarray],
    ) -> None:
        """Add the glints to a surface of vertices (n, 3) at places x, z (n, 2).

        ``slopes`` are its slopes along x and z, (rows, columns) each.
        """
        vertices, places = surface
        towards, spread = sun.direction(settings.sun), settings.water.roughness
        intensity = sun_intensity(grid, *slopes, towards, spread)
        if settings.fog.enabled and settings.fog.mode == "exp2":
            intensity *= visibility(grid.sight, settings.fog.density).astype(np.float32)

        # The strip up to the horizon is so long that its texture coordinates are inexact.
        first = int(grid.ring[0] > LONG * grid.ring[1])
        strip = 2 * (intensity.shape[1] - 1)
        triangles = bright_triangles(grid.triangles[first * strip :], intensity[first:])
        if not len(triangles):
            return
        colors = np.empty((len(vertices), 4), np.float32)
        colors[:, :3] = BRIGHTNESS * settings.water.glitter * np.array(settings.sun.diffuse)
        colors[:, 3] = PEAK * intensity.ravel()
        groups = gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT
        with attrib(groups | gl.GL_DEPTH_BUFFER_BIT):
            for cap in (gl.GL_LIGHTING, gl.GL_FOG):
                gl.glDisable(cap)
            gl.glDepthMask(gl.GL_FALSE)
            gl.glDepthFunc(gl.GL_LEQUAL)
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE)
            self._set_unit(1, "ADD_SIGNED", 4.0)
            self._set_unit(0, "ADD", 1.0)
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

    def _set_unit(self, unit: int, mode: str, scale: float) -> None:
        gl.glActiveTexture(texture_unit(unit))
        gl.glEnable(gl.GL_TEXTURE_2D)
        self._texture.bind()
        combine({"COMBINE_RGB": "REPLACE", "SRC0_RGB": "PRIMARY_COLOR", "COMBINE_ALPHA": mode})
        combine({"SRC0_ALPHA": "PREVIOUS", "SRC1_ALPHA": "TEXTURE"})
        gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_ALPHA_SCALE, scale)

    def _move(self, layer: int, kt: float) -> None:
        """Give the active unit's matrix the layer's scale and its drift, reduced to one tile."""
        gl.glTranslatef(kt * DRIFT[layer] % 1.0, kt * DRIFT[1 - layer] % 1.0, 0.0)
        gl.glScalef(TILES[layer], TILES[layer], 1.0)

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        self._texture.release()
