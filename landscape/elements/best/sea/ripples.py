"""Ripples at each pixel: they choose between the mirror image and the water (``water.ripples``).

The sea's grid is too coarse for waves of less than a few cells; those are only in the water's
texture, which lightens and darkens the water. A real ripple does more: its far side leans away and
mirrors, its near side lets one look into the water. Technique: the lightness of the texture is its
alpha as well, and is subtracted from the opacity at each pixel (GL_ADD_SIGNED with
GL_ONE_MINUS_SRC_ALPHA, OpenGL 1.3), before the mirror image is mixed in by what is left. Near the
eye a second, finer layer of the same ripples runs across the first.
State used: texture units 0 and 1 with GL_COMBINE.
"""

import numpy as np

from landscape.elements.best.sea.eye_grid import EyeGrid
from landscape.gl.calls import gl
from landscape.gl.display_list import DisplayList
from landscape.gl.state import combine
from landscape.gl.texture import Texture, mip_levels

LEAN = 1.5  # chosen: alpha of the water's texture per lightness, times water.ripples
FINE_TONE = 1.3  # chosen: contrast of the fine layer, of the texture's
FINE = 4.7  # chosen: tiles of the fine layer per unit
FINE_TURN = np.radians(34.0)  # chosen: angle between the two layers
FINE_DRIFT = (0.31, 0.23)  # chosen: tiles per t
FINE_SWAY = 0.05  # chosen: tiles by which a slope of 1 moves the fine layer, times FINE
FINE_LEVELS = (1.0, 1.0, 0.9, 0.5, 0.15, 0.0)  # chosen: its contrast in each mip level
FINE_CELLS = 0.1  # chosen: units, in larger cells of the grid the fine layer is flat


def lightness(picture: np.ndarray) -> np.ndarray:
    """Return how much lighter than its mean each texel is, (h, w), of a picture (h, w, 3)."""
    light = picture.astype(np.float32).mean(axis=2) / 255.0
    return np.asarray(light - light.mean())


def leaning(picture: np.ndarray, strength: float) -> np.ndarray:
    """Return a picture of the water, uint8 (h, w, 3), with the ripples' lean as alpha."""
    alpha = 0.5 + LEAN * strength * lightness(picture)
    return np.dstack([picture, np.rint(np.clip(alpha, 0, 1) * 255).astype(np.uint8)])


def fine_ripples(picture: np.ndarray) -> list[np.ndarray]:
    """Return the fine layer's mip levels, uint8 (h, w, 1), of mean 1/2, from the water's picture.

    Far away it fades to its mean sooner than by its mip levels alone.
    """
    layer = 0.5 + FINE_TONE * lightness(picture)
    levels = mip_levels(np.rint(np.clip(layer, 0, 1) * 255).astype(np.uint8)[..., None])
    for k, level in enumerate(levels):
        contrast = FINE_LEVELS[min(k, len(FINE_LEVELS) - 1)]
        levels[k] = np.rint(127.5 + contrast * (level - 127.5)).astype(np.uint8)
    return levels


def fine_coordinates(
    grid: EyeGrid, slope_x: np.ndarray, slope_z: np.ndarray, t: float
) -> np.ndarray:
    """Return the fine layer's texture coordinates, float32 (n, 2): waves push it to and fro."""
    east, south = np.cos(FINE_TURN), np.sin(FINE_TURN)
    x = FINE * (grid.x + np.float32(FINE_SWAY) * slope_x)
    z = FINE * (grid.z + np.float32(FINE_SWAY) * slope_z)
    out = np.empty((grid.x.size, 2), np.float32)
    for axis, (a, b) in enumerate(((east, south), (-south, east))):
        # Reduced to one tile: float32 has too few digits for a large t.
        drift = FINE_DRIFT[axis] * t % 1.0
        out[:, axis] = (np.float32(a) * x + np.float32(b) * z + np.float32(drift)).ravel()
    return out


def near_rows(grid: EyeGrid) -> int:
    """Return how many of the grid's strips, from the far end, do without the fine layer."""
    return min(int((grid.cell > FINE_CELLS).sum()), len(grid.ring) - 1)


class Ripples:
    """Owner of the fine layer, and of the list that sets the units of both layers."""

    def __init__(self, picture: np.ndarray, filters: tuple[bool, bool, float]) -> None:
        """Make the layer from a picture of the water, uint8 (h, w, 3), filtered as its texture."""
        self._texture = Texture(fine_ripples(picture), *filters)
        self._list = DisplayList(self._set_units)

    def _set_units(self) -> None:
        lean = {"COMBINE_ALPHA": "ADD_SIGNED", "SRC0_ALPHA": "PREVIOUS", "SRC1_ALPHA": "TEXTURE"}
        tone = {"COMBINE_RGB": "MODULATE", "SRC0_RGB": "PREVIOUS", "SRC1_RGB": "TEXTURE"}
        both = {**tone, **lean, "OPERAND1_ALPHA": "ONE_MINUS_SRC_ALPHA"}
        combine(both)
        gl.glActiveTexture(gl.GL_TEXTURE1)
        gl.glEnable(gl.GL_TEXTURE_2D)
        self._texture.bind()
        combine(both)
        gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, 2.0)

    def set_units(self) -> None:
        """Let unit 0 subtract the lean from the opacity, and unit 1 do so with the fine layer."""
        self._list.call()

    def switch(self, on: bool, active: int) -> None:
        """Turn the fine layer on or off; ``active`` is the unit that is active, and stays so.

        It is not asked for: a frame that is compiled into a list would get that of another moment.
        """
        gl.glActiveTexture(gl.GL_TEXTURE1)
        (gl.glEnable if on else gl.glDisable)(gl.GL_TEXTURE_2D)
        gl.glActiveTexture(getattr(gl, f"GL_TEXTURE{active}"))

    def release(self) -> None:
        """Delete list and texture; may be called twice."""
        self._list.release()
        self._texture.release()
