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

import math

import numpy as np
from PIL import Image

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays, combine, matrix
from framelens.gl.texture import Texture
from landscape.elements.best.sea.eye_grid import EyeGrid
from landscape.elements.best.sea.serpent_wash import Rings
from landscape.elements.best.sea.shoreline import averaged, last_foam, shore_map, spread
from landscape.elements.settings import Settings
from landscape.elements.sun import painted
from landscape.files.cache import recall
from landscape.frame import Frame
from landscape.geometry.height_field import HeightField
from landscape.gl.display_list import DisplayList

WIDEST = 0.42  # chosen: units that the wash is wide on a level beach
STEEP = 0.5  # chosen: slope, rise over run, at which it is half as wide
SMOOTH = 8  # chosen: texels along the shore over which its width is averaged
CRESTS = 1.15  # chosen: widths from one crest to the next
SWELL = 0.5  # chosen: density of foam in a crest
EDGE = 0.66  # chosen: density of the foam that stays at the edge
NARROWEST = 0.035  # chosen: units in which that foam falls to 1/e at least
TROUGH = -0.2  # chosen: density between the crests: below 0, so that crests are narrow
PERIOD = 180.0  # chosen: kt between two crests
CONTRAST = 2.0  # chosen: of foam and lace; OpenGL allows 1, 2 and 4
LACE = 256  # chosen: texels per side of the lace
LACE_REPEAT = 1.9  # chosen: tiles of lace per unit
LACE_DRIFT = 900.0  # chosen: kt in which the lace moves by one tile
COLOUR = (0.95, 0.97, 0.97)  # chosen: RGB
FACING = 0.2  # chosen: cosine of the angle at which the sun shines on it, whatever its height
FADING, FARTHEST = 13.0, 18.0  # chosen: units away at which foam begins to fade, and is gone
ENDS = 1.7  # chosen: widths from the shoreline beyond which there is none
ASHORE = 0.06  # chosen: units of land that waves may cover
PATCH = 0.3  # chosen: units, size of the patches of foam at an edge that waves run over
LEFT = 0.55  # chosen: fraction of the foam at the edge that is left in such a patch
RUN_OVER = 0.3  # chosen: slope, rise over run, above which waves do not run up a shore
LAPPING = 1.35  # chosen: fraction of the foam that is left in such a patch on a steep shore
NEARBY = 0.5  # chosen: units within which distances from foam are known


def lace(size: int = LACE, seed: int = 2006) -> np.ndarray:
    """Return a tile of lace, (size, size) in 0..0.5: bright threads between round holes.

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
    return 0.5 * threads / threads.max()


def widths(slope: np.ndarray) -> np.ndarray:
    """Return how wide the wash is in units, by the slope of the shore; 0 is one not known."""
    return WIDEST / (1.0 + np.where(slope > 0, slope, 10.0) / STEEP)


def wash(distance: np.ndarray, slope: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the strength and phase of the swell and the density of the foam that stays.

    By the distance from the shoreline in units, positive on the water, and by the slope there.
    Phases in radians, 0 at the shoreline; foam is there where the sum is above 0.
    """
    along = distance / widths(slope)
    swell = SWELL * np.exp(-np.square((along - 0.5) / 0.62))
    edge = EDGE * np.exp(-np.abs(distance) / np.maximum(0.27 * widths(slope), NARROWEST)) + TROUGH
    outside = np.clip((np.abs(along) - 1.2) / (ENDS - 1.2), 0.0, 1.0)
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


def least_distances(apart: np.ndarray, texel: float) -> np.ndarray:
    """Return how far from foam each texel is at least, float32 (n, n) in units, 0 in foam.

    ``apart`` (n, n) are the distances, which need not be right where they are larger than NEARBY.
    There each halving of the texels tells by how many of its texels the foam is away.
    """
    masks = near_masks(apart <= 0.0)
    least = np.zeros(masks[-1].shape, np.float32)
    for k in reversed(range(len(masks))):
        if least.shape != masks[k].shape:
            least = least.repeat(2, axis=0).repeat(2, axis=1)
        np.maximum(least, np.float32(2**k * texel), out=least, where=~masks[k])
    return np.where(apart <= NEARBY, apart, np.maximum(least, NEARBY)).astype(np.float32)


class Where:
    """Where foam may be on a square of ``size`` units, with its corner (2,) at x and z."""

    def __init__(self, apart: np.ndarray, corner: tuple[float, float], size: float) -> None:
        """Take the distance of each texel from the nearest foam, (n, n) in units, 0 in foam.

        It need not be right where it is larger than NEARBY.
        """
        self._corner, self._size = np.array(corner, np.float32), size
        self._texel = size / len(apart)
        self._least = least_distances(apart, self._texel)

    def cells(self, grid: EyeGrid) -> np.ndarray:
        """Return the corners, uint32 (m, 6), of the grid's m cells that foam may touch.

        No point of a cell is farther from the nearest corner than half the diagonal.
        """
        none = grid.triangles[:0].reshape(-1, 6)
        apart = np.maximum(np.abs(self._corner + self._size / 2 - grid.eye) - self._size / 2, 0.0)

        # The rings become smaller from row to row.
        first = int((grid.ring >= FARTHEST).sum())
        if np.hypot(*apart) > FARTHEST or first == len(grid.ring):
            return none
        scale, side = np.float32(1.0 / self._texel), len(self._least)
        column = (grid.x[first:] - self._corner[0]) * scale
        row = (grid.z[first:] - self._corner[1]) * scale
        inside = (column >= 0) & (column < side) & (row >= 0) & (row < side)
        if not inside.any():
            return none
        ring, cell = grid.ring[first:], grid.cell[first:]
        step = math.hypot(grid.east[1] - grid.east[0], grid.south[1] - grid.south[0])
        half = (0.5 * np.hypot(cell, ring * step) + self._texel).astype(np.float32)

        # What is outside looks up any texel.
        place = row.astype(np.int32) * side + column.astype(np.int32)
        near = self._least.take(place, mode="clip") <= half[:, None]
        near &= inside
        if first:  # the row before the first one has no vertex near foam
            near = np.concatenate([np.zeros_like(near[:1]), near])
            first -= 1
        touched = near[:-1] | near[1:]
        touched = touched[:, :-1] | touched[:, 1:]
        strips = grid.triangles.reshape(-1, 6)[first * (near.shape[1] - 1) :]
        return strips[touched.ravel()]


def turns(x: np.ndarray, z: np.ndarray, kt: float) -> np.ndarray:
    """Return the angle of the swell at places x, z (n,) in radians.

    Breakers do not reach all beaches at the same time.
    """
    delay = 1.9 * np.sin(1.1 * x + 0.5 * z) + 1.5 * np.sin(1.9 * z - 0.8 * x)
    # Reduced to one period: float32 has too few digits for a large kt.
    return np.asarray(delay - np.float32(2 * np.pi * (kt / PERIOD % 1.0)))


class Wash:
    """Foam on a square of the sea, a map of what each place does during a swell."""

    def __init__(
        self,
        parts: tuple[np.ndarray, ...],
        apart: np.ndarray,
        corner: tuple[float, float] = (0.0, 0.0),
        size: float = 1.0,
    ) -> None:
        """Upload the map, (n, n) each of what ``wash`` returns; its corner is x, z, in units.

        ``apart`` (n, n) is how far from the nearest foam each texel is.
        """
        self._corner, self._size = corner, size
        self._where = Where(apart, corner, size)
        self._texture = Texture(wash_picture(*parts), repeat=False, trilinear=False)

    def cells(self, grid: EyeGrid) -> np.ndarray:
        """Return the corners, uint32 (m, 6), of the grid's m cells that foam may touch."""
        return self._where.cells(grid)

    def draw(self, triangles: np.ndarray) -> None:
        """Draw triangles of the grid; the coordinates of unit 0 are x and z."""
        self._texture.bind()
        gl.glMatrixMode(gl.GL_TEXTURE)
        with matrix():
            gl.glScalef(1 / self._size, 1 / self._size, 1.0)
            gl.glTranslatef(-self._corner[0], -self._corner[1], 0.0)
            gl.glDrawElements(gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles)
        gl.glMatrixMode(gl.GL_MODELVIEW)

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        self._texture.release()


def shore_shape(field: HeightField) -> tuple[np.ndarray, np.ndarray]:
    """Return each texel's distance from the shoreline, positive on the water, and its slope.

    Both float32 (TEXELS, TEXELS). The slope is taken at the nearest piece of the shoreline, and
    averaged along it; 0 where there is none.
    """

    def make() -> tuple[np.ndarray, ...]:
        distance, slope = shore_map(field)
        return distance.astype(np.float32), averaged(spread(slope, SMOOTH)).astype(np.float32)

    distance, slope = recall(("foam", *field.made_from), make)
    return distance, slope


def broken(edge: np.ndarray, slope: np.ndarray, size: float) -> np.ndarray:
    """Return the foam that stays, (n, n), in patches: what the last wave has not left is gone.

    Waves do not run up a steep shore, of ``slope`` (n, n): there they lap at the rock, and more
    foam stays. ``size`` is the map's side in units.
    """
    knots = max(int(size / PATCH), 2)
    coarse = np.random.default_rng(1912).uniform(0.0, 1.0, (knots, knots)).astype(np.float32)
    fine = Image.fromarray(coarse).resize(edge.shape, Image.Resampling.BICUBIC)
    lapping = np.clip((slope - RUN_OVER) / RUN_OVER, 0.0, 1.0)
    left = LEFT + (LAPPING - LEFT) * lapping
    kept = left * np.clip(1.6 * np.asarray(fine) - 0.4 + 0.25 * lapping, 0.0, 1.0)
    return np.asarray(TROUGH + (edge - TROUGH) * np.where(edge > TROUGH, kept, 1.0))


def shore_wash(
    field: HeightField, run_up: bool = False
) -> tuple[tuple[np.ndarray, ...], np.ndarray]:
    """Return what :func:`wash` does for each texel of the map, and how far from foam it is.

    The foam that stays at the edge is broken; more so with ``run_up``, as waves climb the sand
    (run_up.py).
    """
    distance, slope = shore_shape(field)
    along, some = np.linspace(0.0, ENDS, 500), np.array(STEEP)
    swell, _, edge = wash(along * widths(some), some)
    ends = np.maximum(last_foam(along, swell, edge) * widths(slope), 2.0 * NARROWEST)
    apart = np.maximum(distance - ends, -ASHORE - distance)
    swell, phase, edge = wash(distance, slope)
    lapped = slope if run_up else np.full_like(slope, 2.0 * RUN_OVER)
    return (swell, phase, broken(edge, lapped, field.size)), apart


class Foam:
    """The foam along all shores, and around the dragon; Sea draws it with its own vertices."""

    def __init__(
        self, field: HeightField, rings: Rings | None = None, run_up: bool = False
    ) -> None:
        """Make the textures; with ``rings``, also those around the dragon.

        With ``run_up`` there is less foam at the shoreline of beaches.
        """
        self._washes = [Wash(*shore_wash(field, run_up), size=field.size)]
        if rings is not None:
            self._washes.append(Wash(*rings))
        white = np.full((LACE, LACE, 4), 255, np.uint8)
        white[..., 3] = np.rint(lace() * 255)
        self._lace = Texture(white, trilinear=False)
        self._list = DisplayList(self._set_units)

    def draw(
        self,
        frame: Frame,
        settings: Settings,
        grid: EyeGrid,
        vertices: np.ndarray,
        places: np.ndarray,
    ) -> None:
        """Blend the foam of the frame's kt over vertices (n, 3) at places x, z (n, 2)."""
        found = [(each, each.cells(grid)) for each in self._washes]
        found = [(each, triangles) for each, triangles in found if len(triangles)]
        if not found:
            return
        first = min(int(triangles.min()) for _, triangles in found)
        last = max(int(triangles.max()) for _, triangles in found)
        used = slice(first, last + 1)
        turn = turns(places[used, 0], places[used, 1], frame.kt)
        left = np.clip((FARTHEST - grid.ring) / (FARTHEST - FADING), 0.0, 1.0)
        strength = 0.5 * np.repeat(left.astype(np.float32), grid.x.shape[1])[used]
        colors = np.ones((len(places), 4), np.float32)
        colors[used, 0] = 0.5 + strength * np.cos(turn)
        colors[used, 1] = 0.5 + strength * np.sin(turn)
        colors[used, 2] = 0.5 + strength
        groups = gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT
        groups |= gl.GL_DEPTH_BUFFER_BIT | gl.GL_CURRENT_BIT
        with attrib(groups):
            gl.glDisable(gl.GL_LIGHTING)
            gl.glDepthMask(gl.GL_FALSE)
            gl.glDepthFunc(gl.GL_LEQUAL)
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            self._list.call()

            # Spray is as bright from all sides, as it scatters light.
            colour = np.array([*(painted(settings.sun, FACING) * COLOUR), 1.0], np.float32)
            drift = frame.kt / LACE_DRIFT % 1.0
            with client_arrays(vertices, None, colors, [places, places]):
                gl.glActiveTexture(gl.GL_TEXTURE1)
                gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, colour)
                gl.glMatrixMode(gl.GL_TEXTURE)
                gl.glPushMatrix()
                gl.glTranslatef(drift, -drift, 0.0)
                gl.glScalef(LACE_REPEAT, LACE_REPEAT, 1.0)
                gl.glActiveTexture(gl.GL_TEXTURE0)
                for each, triangles in found:
                    each.draw(triangles)
                gl.glMatrixMode(gl.GL_TEXTURE)
                gl.glActiveTexture(gl.GL_TEXTURE1)
                gl.glPopMatrix()
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
        combine({"COMBINE_RGB": "DOT3_RGBA", "SRC0_RGB": "PRIMARY_COLOR", "SRC1_RGB": "TEXTURE"})

    def release(self) -> None:
        """Delete list and textures; may be called twice."""
        self._list.release()
        self._lace.release()
        for each in self._washes:
            each.release()
