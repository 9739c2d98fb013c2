"""Foam: a wash along the shore that comes and goes with the swell (``water.foam``).

Technique: a texture over the map holds what each place of the shore does during a swell: a wave as
cosine and sine (red and green) of the distance from the shoreline, and the foam that always stays
at the edge (blue). Each vertex sends the cosine and sine of the time as its colour. GL_DOT3_RGBA
(OpenGL 1.3) multiplies both, which is the cosine of the difference: a crest that runs ashore at
each pixel, whatever the grid. The next unit adds lace and increases the contrast (GL_ADD_SIGNED
with GL_ALPHA_SCALE 2), so that foam frays instead of fading. Drawn over those cells of the sea's
own grid that lie near the shore: it rises and falls with the waves.
State used: two texture units, a texture matrix, GL_BLEND, no lighting or depth writes.
"""

import numpy as np

from landscape.elements.best.sea.eye_grid import EyeGrid
from landscape.elements.best.sea.shoreline import averaged, shore_map, spread
from landscape.elements.sun import painted
from landscape.files.cache import recall
from landscape.frame import Frame
from landscape.geometry.height_field import HeightField
from landscape.gl.calls import gl
from landscape.gl.display_list import DisplayList
from landscape.gl.state import attrib, client_arrays, combine, matrix
from landscape.gl.texture import Texture
from landscape.settings import Settings

WIDEST = 0.42  # chosen: units that the wash is wide on a level beach
STEEP = 0.5  # chosen: slope, rise over run, at which it is half as wide
SMOOTH = 8  # chosen: texels along the shore over which its width is averaged
CRESTS = 1.15  # chosen: widths from one crest to the next
SWELL = 0.5  # chosen: density of foam in a crest
EDGE = 0.8  # chosen: density of the foam that stays at the edge
TROUGH = -0.2  # chosen: density between the crests: below 0, so that crests are narrow
PERIOD = 180.0  # chosen: kt between two crests
CONTRAST = 2.0  # of foam and lace; OpenGL allows 1, 2 and 4
LACE = 256  # chosen: texels per side of the lace
LACE_REPEAT = 1.9  # chosen: tiles of lace per unit
LACE_DRIFT = 900.0  # chosen: kt in which the lace moves by one tile
COLOUR = (0.95, 0.97, 0.97)  # chosen: RGB
FACING = 0.2  # chosen: cosine of the angle at which the sun shines on it, whatever its height
FARTHEST = 30.0  # chosen: units away beyond which there is none


def lace(size: int = LACE, seed: int = 2006) -> np.ndarray:
    """Return a tile of lace, (size, size) in 0..0.6: bright threads between round holes.

    The zero crossings of smooth noise, in three layers of about one wavelength each.
    """
    layers = ((9.0, 0.4), (21.0, 0.35), (45.0, 0.25))  # waves along a side, weight
    noise = np.random.default_rng(seed).standard_normal((len(layers), size, size))
    k = np.hypot(*np.meshgrid(*[np.fft.fftfreq(size) * size] * 2))
    threads = np.zeros((size, size))
    for layer, (scale, weight) in zip(noise, layers, strict=True):
        band = np.exp(-np.square((k - scale) / (0.35 * scale)))
        wave = np.fft.ifft2(np.fft.fft2(layer) * band).real
        threads += weight * np.exp(-np.abs(wave) / wave.std() * 1.3)
    threads -= threads.min()
    return 0.6 * threads / threads.max()


def wash(distance: np.ndarray, slope: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the strength and phase of the swell and the density of the foam that stays.

    By the distance from the shoreline in units, positive on the water, and by the slope there.
    Phases in radians, 0 at the shoreline; foam is there where the sum is above 0.
    """
    width = WIDEST / (1.0 + np.where(slope > 0, slope, 10.0) / STEEP)
    along = distance / width
    swell = SWELL * np.exp(-np.square((along - 0.5) / 0.62))
    edge = EDGE * np.exp(-np.abs(along) / 0.27) + TROUGH
    outside = np.clip((np.abs(along) - 1.3) / 0.7, 0.0, 1.0)
    return swell * (1.0 - outside), 2 * np.pi / CRESTS * along, edge - (1.0 + edge) * outside


def wash_picture(swell: np.ndarray, phase: np.ndarray, edge: np.ndarray) -> np.ndarray:
    """Return what the dot product reads, uint8 (n, n, 3): numbers of -1..1 as 0..255."""
    parts = np.stack([swell * np.cos(phase), swell * np.sin(phase), edge], axis=2)
    return np.rint((np.clip(parts, -1, 1) + 1) * 127.5).astype(np.uint8)


def near_masks(foamy: np.ndarray) -> list[np.ndarray]:
    """Return where foam may be, or next to it, at each halving of the texels, bool (n, n) each."""
    masks = []
    while True:
        wide = np.pad(foamy, 1)
        rows = wide[:-2] | wide[1:-1] | wide[2:]
        masks.append(rows[:, :-2] | rows[:, 1:-1] | rows[:, 2:])
        if len(foamy) <= 8:
            return masks
        foamy = foamy[::2] | foamy[1::2]
        foamy = foamy[:, ::2] | foamy[:, 1::2]


def near_cells(grid: EyeGrid, masks: list[np.ndarray], size: float) -> np.ndarray:
    """Return the triangles, uint32 (m,) corners, of those cells of a grid that foam may touch.

    ``masks`` are those of a map of ``size`` units. Where the cells are larger, larger texels are
    looked at.
    """
    rows, columns = grid.x.shape
    near = np.zeros((rows, columns), bool)
    texel = size / len(masks[0])
    across = grid.ring * np.float32(np.hypot(*np.diff(np.stack([grid.east, grid.south]))[:, 0]))
    span = np.maximum(grid.cell, across)
    level = np.ceil(np.log2(np.maximum(span / texel, 1.0))).astype(int)
    level = np.minimum(level, len(masks) - 1)
    seen = grid.ring < FARTHEST
    for k in np.unique(level[seen]).tolist():
        mask, mine = masks[k], seen & (level == k)
        scale = np.float32(len(mask) / size)
        row, column = ((a[mine] * scale).astype(np.int32) for a in (grid.z, grid.x))
        inside = (np.minimum(row, column) >= 0) & (np.maximum(row, column) < len(mask))
        row, column = (np.clip(a, 0, len(mask) - 1) for a in (row, column))
        near[mine] = mask[row, column] & inside
    cell = near[:-1] | near[1:]
    cell = cell[:, :-1] | cell[:, 1:]
    return np.ascontiguousarray(grid.triangles.reshape(-1, 6)[cell.ravel()].ravel())


def turns(x: np.ndarray, z: np.ndarray, kt: float) -> np.ndarray:
    """Return the angle of the swell at places x, z (n,) in radians.

    Breakers do not reach all beaches at the same time.
    """
    delay = 1.9 * np.sin(1.1 * x + 0.5 * z) + 1.5 * np.sin(1.9 * z - 0.8 * x)
    # Reduced to one period: float32 has too few digits for a large kt.
    return np.asarray(delay - np.float32(2 * np.pi * (kt / PERIOD % 1.0)))


class Foam:
    """The foam along all shores; Sea draws it with its own vertices."""

    def __init__(self, field: HeightField) -> None:
        """Make the textures."""

        def make() -> tuple[np.ndarray, np.ndarray]:
            distance, slope = shore_map(field)
            swell, phase, edge = wash(distance, averaged(spread(slope, SMOOTH)))
            return wash_picture(swell, phase, edge), swell + edge > 0

        what = repr((field.size, field.water_level, field.heights.shape, field.exact))
        picture, foamy = recall(["foam", what, field.heights.tobytes()], make)
        self._size = field.size
        self._masks = near_masks(foamy)
        self._texture = Texture(picture, repeat=False)
        white = np.full((LACE, LACE, 4), 255, np.uint8)
        white[..., 3] = np.rint(lace() * 255)
        self._lace = Texture(white)
        self._list = DisplayList(self._set_units)

    def draw(
        self, frame: Frame, settings: Settings, grid: EyeGrid, vertices: np.ndarray,
        places: np.ndarray,
    ) -> None:  # fmt: skip
        """Blend the foam of the frame's kt over vertices (n, 3) at places x, z (n, 2)."""
        triangles = near_cells(grid, self._masks, self._size)
        if not len(triangles):
            return
        turn = turns(places[:, 0], places[:, 1], frame.kt)
        colors = np.empty((len(places), 4), np.float32)
        colors[:, 0], colors[:, 1] = 0.5 + 0.5 * np.cos(turn), 0.5 + 0.5 * np.sin(turn)
        colors[:, 2:] = 1.0
        groups = gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT
        groups |= gl.GL_DEPTH_BUFFER_BIT | gl.GL_CURRENT_BIT
        with attrib(groups):
            gl.glDisable(gl.GL_LIGHTING)
            gl.glDepthMask(gl.GL_FALSE)
            gl.glDepthFunc(gl.GL_LEQUAL)
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            # Spray is as bright from all sides, as it scatters light.
            colour = np.array([*(painted(settings.sun, FACING) * COLOUR), 1.0], np.float32)
            self._list.call()
            gl.glActiveTexture(gl.GL_TEXTURE1)
            gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, colour)
            gl.glActiveTexture(gl.GL_TEXTURE0)
            drift = frame.kt / LACE_DRIFT % 1.0
            with client_arrays(vertices, None, colors, [places, places]):
                gl.glMatrixMode(gl.GL_TEXTURE)
                with matrix():
                    gl.glScalef(1 / self._size, 1 / self._size, 1.0)
                    gl.glActiveTexture(gl.GL_TEXTURE1)
                    with matrix():
                        gl.glTranslatef(drift, -drift, 0.0)
                        gl.glScalef(LACE_REPEAT, LACE_REPEAT, 1.0)
                        gl.glDrawElements(
                            gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles
                        )
                    gl.glActiveTexture(gl.GL_TEXTURE0)
                gl.glMatrixMode(gl.GL_MODELVIEW)

    def _set_units(self) -> None:
        """Set alpha to CONTRAST x (foam + lace - 0.5)."""
        gl.glActiveTexture(gl.GL_TEXTURE1)
        gl.glEnable(gl.GL_TEXTURE_2D)
        self._lace.bind()
        combine({"COMBINE_RGB": "REPLACE", "SRC0_RGB": "CONSTANT", "COMBINE_ALPHA": "ADD_SIGNED"})
        combine({"SRC0_ALPHA": "PREVIOUS", "SRC1_ALPHA": "TEXTURE"})
        gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_ALPHA_SCALE, CONTRAST)
        gl.glActiveTexture(gl.GL_TEXTURE0)
        gl.glEnable(gl.GL_TEXTURE_2D)
        self._texture.bind()
        combine({"COMBINE_RGB": "DOT3_RGBA", "SRC0_RGB": "PRIMARY_COLOR", "SRC1_RGB": "TEXTURE"})

    def release(self) -> None:
        """Delete list and textures; may be called twice."""
        self._list.release()
        self._texture.release()
        self._lace.release()
