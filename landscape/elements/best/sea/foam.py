"""Foam: small breakers that run out on the beaches, pale along the water's edge (``water.foam``).

Technique: the triangles of the ground's grid along the coast, lifted to the water's level, in a
display list: no vertex is sent again. Unit 0 holds a picture of the breakers, time along s and
depth along t; its texture matrix moves s with kt. Unit 1 holds lace in map coordinates. The
combiner adds both and increases the contrast (GL_ADD_SIGNED with GL_ALPHA_SCALE 4, OpenGL 1.3), so
that a line of foam frays instead of fading. Drawn after the water.
State used: two texture units, texture matrices, GL_BLEND, polygon offset, no depth writes.
"""

import numpy as np

from landscape.elements.sun import painted
from landscape.frame import Frame
from landscape.geometry.height_field import HeightField
from landscape.geometry.mesh import grid_triangles
from landscape.gl.calls import gl
from landscape.gl.display_list import DisplayList
from landscape.gl.state import attrib, client_arrays, combine, matrix
from landscape.gl.texture import Texture
from landscape.settings import Settings

DEEP = 0.11  # chosen: units of depth where a breaker begins
LAND = 0.012  # chosen: height it runs up to, in units above the water
BREAKERS = 2  # chosen: breakers under way at any moment
PERIOD = 150.0  # chosen: kt that one breaker takes
PROFILE = (256, 128)  # chosen: texels of the breakers' texture, times and depths
LACE = 256  # chosen: texels per side of the lace
LACE_REPEAT = 0.9  # chosen: tiles of lace per unit
COLOUR = (0.95, 0.97, 0.97)  # chosen: RGB
FACING = 0.2  # chosen: cosine of the angle at which the sun shines on it, whatever its height


def breakers(times: int, depths: int) -> np.ndarray:
    """Return the density of foam, 0..1, (depths, times): periodic in time, 0 at both ends.

    Row 0 is LAND above the water's edge, the last row DEEP below it. A breaker comes in from the
    deep, its front steep and its back thinning out, and grows until it reaches the edge.
    """
    depth = np.linspace(-LAND, DEEP, depths)[:, None] / DEEP
    time = np.arange(times)[None, :] / times
    foam = 0.34 * np.exp(-np.abs(depth) / 0.07)
    for number in range(BREAKERS):
        gone = (time + number / BREAKERS) % 1.0
        crest = 0.95 - 1.12 * gone
        behind = depth - crest
        line = np.where(behind > 0, np.exp(-behind / 0.17), np.exp(behind / 0.025))
        swell = np.clip(gone / 0.25, 0, 1) * np.clip((1.0 - gone) / 0.12, 0, 1)
        foam = np.maximum(foam, 0.70 * line * swell * (0.45 + 0.55 * gone))
    ends = np.clip((depth + LAND / DEEP) / 0.06, 0, 1) * np.clip((1.0 - depth) / 0.2, 0, 1)
    return foam * ends


def lace(size: int = LACE, seed: int = 2006) -> np.ndarray:
    """Return a tile of lace, (size, size) in 0..0.5: bright threads between round holes.

    The zero crossings of smooth noise, in two layers of about one wavelength each.
    """
    noise = np.random.default_rng(seed).standard_normal((2, size, size))
    k = np.hypot(*np.meshgrid(*[np.fft.fftfreq(size) * size] * 2))
    threads = np.zeros((size, size))
    for layer, scale, weight in ((noise[0], 14.0, 0.6), (noise[1], 34.0, 0.4)):
        band = np.exp(-np.square((k - scale) / (0.35 * scale)))
        wave = np.fft.ifft2(np.fft.fft2(layer) * band).real
        threads += weight * np.exp(-np.abs(wave) / wave.std() * 1.3)
    threads -= threads.min()
    return 0.5 * threads / threads.max()


def shore(field: HeightField) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return vertices (n, 3), coordinates of units 0 and 1 (n, 2) and triangles (m, 3).

    The triangles of the ground's grid where the water is at most DEEP. Unit 0's t is 0 at LAND
    above the water and 1 at DEEP; its s varies along the coast, so that breakers do not reach all
    beaches at the same time.
    """
    n = len(field.heights)
    along = np.arange(n) / (n - 1) * field.size
    x, z = (a.ravel() for a in np.meshgrid(along, along))
    rise = field.heights.ravel() - field.water_level
    triangles = grid_triangles(n, n)
    corners = rise[triangles]
    triangles = triangles[(corners.max(axis=1) > -DEEP) & (corners.min(axis=1) < LAND)]
    y = field.water_level + np.clip(rise, 0.0, LAND)
    delay = 0.35 * np.sin(0.9 * x + 0.4 * z) + 0.25 * np.sin(1.7 * z - 0.6 * x)
    unit_0 = np.stack([delay, (LAND - rise) / (DEEP + LAND)], axis=1)
    used, triangles = np.unique(triangles, return_inverse=True)
    place = np.stack([x, y, z], axis=1)[used].astype(np.float32)
    return (
        place,
        np.ascontiguousarray(unit_0[used], np.float32),
        np.ascontiguousarray(place[:, ::2] * LACE_REPEAT, np.float32),
        np.ascontiguousarray(triangles.reshape(-1, 3), np.uint32),
    )


def alpha_only(alpha: np.ndarray) -> np.ndarray:
    """Return a white picture, uint8 (h, w, 4), with this alpha (h, w) of 0..1."""
    picture = np.full((*alpha.shape, 4), 255, np.uint8)
    picture[..., 3] = np.clip(alpha, 0, 1) * 255 + 0.5
    return picture


class Foam:
    """The foam along all coasts."""

    def __init__(self, settings: Settings, field: HeightField) -> None:
        """Make the textures and compile the list."""
        self._level = field.water_level
        self.apply(settings)
        self._profile = Texture(alpha_only(breakers(*PROFILE)))
        self._profile.bind()
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_WRAP_T, gl.GL_CLAMP_TO_EDGE)
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
        self._lace = Texture(alpha_only(lace()))
        vertices, unit_0, unit_1, triangles = shore(field)

        def send() -> None:
            self._set_units()
            with client_arrays(vertices, coordinates=[unit_0, unit_1]):
                gl.glDrawElements(gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles)

        self._list = DisplayList(send)

    def apply(self, settings: Settings) -> bool:
        """Apply new settings; return False, changing nothing, at another water level."""
        if settings.water.level != self._level:
            return False
        # Spray is as bright from all sides, as it scatters light.
        self._light = painted(settings.sun, FACING)
        return True

    def draw(self, frame: Frame) -> None:
        """Blend the foam of the frame's kt over the water."""
        groups = gl.GL_ENABLE_BIT | gl.GL_TEXTURE_BIT | gl.GL_CURRENT_BIT | gl.GL_COLOR_BUFFER_BIT
        groups |= gl.GL_DEPTH_BUFFER_BIT | gl.GL_POLYGON_BIT
        with attrib(groups):
            gl.glDisable(gl.GL_LIGHTING)
            gl.glDepthMask(gl.GL_FALSE)
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
            gl.glPolygonOffset(-1.0, -2.0)
            gl.glColor3f(*(self._light * COLOUR))
            gl.glMatrixMode(gl.GL_TEXTURE)
            with matrix():
                # Reduced to one period: float32 has too few digits for a large kt.
                gl.glTranslatef(frame.kt / PERIOD % 1.0, 0.0, 0.0)
                self._list.call()
            gl.glMatrixMode(gl.GL_MODELVIEW)

    def _set_units(self) -> None:
        """Set alpha to 4 x (breakers + lace - 0.5); unit 0 is active again at the end."""
        gl.glActiveTexture(gl.GL_TEXTURE1)
        gl.glEnable(gl.GL_TEXTURE_2D)
        self._lace.bind()
        combine({"COMBINE_RGB": "REPLACE", "SRC0_RGB": "PREVIOUS"})
        combine({"COMBINE_ALPHA": "ADD_SIGNED"})
        combine({"SRC0_ALPHA": "PREVIOUS", "SRC1_ALPHA": "TEXTURE"})
        gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_ALPHA_SCALE, 4.0)
        gl.glActiveTexture(gl.GL_TEXTURE0)
        gl.glEnable(gl.GL_TEXTURE_2D)
        self._profile.bind()
        combine({"COMBINE_RGB": "REPLACE", "SRC0_RGB": "PRIMARY_COLOR"})
        combine({"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": "TEXTURE"})

    def release(self) -> None:
        """Delete the list and the textures; may be called twice."""
        self._list.release()
        self._profile.release()
        self._lace.release()
