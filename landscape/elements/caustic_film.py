"""The film of caustics: frames of the net of light on the bed of shallow water, one texture each.

The frames are periodic, in space and in time (studio/land/caustics.py). Shown one after the other
they jump; so two of them are bound at a time, to two texture units, and a unit mixes them by the
alpha of its environment colour (GL_INTERPOLATE, OpenGL 1.3). Each texel is both colour and alpha
(GL_INTENSITY): an alpha can be computed beside the colour of the same unit, and so be carried past
it to the next. Drawn by hall/caustics.py in the hall, and by best/terrain/bed_light.py on the
island. State used: the 2D textures of two units.
"""

import math

import numpy as np

from framelens.base.errors import InputError
from framelens.gl.named import texture_unit
from framelens.gl.seam import gl
from framelens.gl.texture import Texture
from landscape.files.assets import Assets
from landscape.files.images import read_image

SIDE = 128  # texels of a frame
SHEET = "caustics.png"
LOD_BIAS = -0.5  # chosen: the net stays sharp where the bed is seen at a slant


def cut(sheet: np.ndarray) -> np.ndarray:
    """Cut a sheet, uint8 (h, w), into its frames (n, SIDE, SIDE), row by row."""
    rows, columns = sheet.shape[0] // SIDE, sheet.shape[1] // SIDE
    frames = sheet[: rows * SIDE, : columns * SIDE].reshape(rows, SIDE, columns, SIDE)
    return np.ascontiguousarray(frames.swapaxes(1, 2).reshape(-1, SIDE, SIDE))


def sines(count: int) -> np.ndarray:
    """Return a film of ``count`` frames that is a product of sines, uint8 (count, SIDE, SIDE).

    It is what is often drawn for caustics. It moves and is periodic, but shows dots: a product of
    sines has no lines.
    """
    time = np.arange(count)[:, None, None] / count
    at = (np.arange(SIDE) + 0.5) / SIDE
    across = 0.5 + 0.5 * np.sin(2 * np.pi * (4 * at[None, None, :] - time))
    down = 0.5 + 0.5 * np.sin(2 * np.pi * (4 * at[None, :, None] + time))
    return np.asarray(255 * across * down + 0.5, np.uint8)


def between(films: float, count: int, smooth: bool) -> tuple[int, int, float]:
    """Return the numbers of the frames before and after a time, and how far it is between them.

    ``films`` is the time in lengths of the film, which has ``count`` frames. Without ``smooth``
    only the frame before counts.
    """
    at = films % 1.0 * count
    first = int(at) % count
    return first, (first + 1) % count, at - math.floor(at) if smooth else 0.0


def shipped(assets: Assets) -> np.ndarray:
    """Return the frames (n, SIDE, SIDE) in the assets; InputError names an unusable file."""
    path = assets.path(SHEET)
    sheet = read_image(path, "L")
    if min(sheet.shape) < SIDE:
        raise InputError(
            "{file}: expected frames of {side}x{side} pixels, and it has {width}x{height}",
            file=path,
            side=SIDE,
            width=sheet.shape[1],
            height=sheet.shape[0],
        )
    return cut(sheet)


class CausticFilm:
    """Owner of the frames' textures."""

    def __init__(self, frames: np.ndarray, trilinear: bool = True) -> None:
        """Upload frames, uint8 (n, h, w); see :class:`Texture` for ``trilinear``."""
        self._textures = [
            Texture(np.ascontiguousarray(each[..., None]), trilinear=trilinear, lod_bias=LOD_BIAS)
            for each in frames
        ]

    @classmethod
    def shipped(cls, assets: Assets, trilinear: bool = True) -> "CausticFilm":
        """Return the film in the assets; InputError names a file that cannot be used."""
        return cls(shipped(assets), trilinear)

    def bind(self, films: float, smooth: bool = True, unit: int = 0) -> float:
        """Bind the frames before and after a time to ``unit`` and the next; return the mix, 0..1.

        Unit ``unit`` is active then. ``films`` is the time in lengths of the film.
        """
        first, second, mix = between(films, len(self._textures), smooth)
        for number, texture in ((unit + 1, second), (unit, first)):
            gl.glActiveTexture(texture_unit(number))
            self._textures[texture].bind()
        return mix

    def release(self) -> None:
        """Delete the textures; may be called twice."""
        for texture in self._textures:
            texture.release()


class MixedFilm:
    """Owner of one texture that holds the mix of two frames: it takes only one texture unit.

    The mix is computed outside of OpenGL, which is worth it where much is covered.
    """

    def __init__(self, frames: np.ndarray) -> None:
        """Take frames, uint8 (n, h, w)."""
        self._frames, self._held = frames, (-1, -1, 0.0)
        self._texture = Texture(frames[0][..., None], trilinear=False, lod_bias=LOD_BIAS)

    def bind(self, films: float, smooth: bool = True) -> None:
        """Bind the frame of a time, in lengths of the film, to the active unit."""
        wanted = first, second, mix = between(films, len(self._frames), smooth)
        if wanted != self._held:
            self._held, weight = wanted, np.uint16(256 * mix + 0.5)
            mixed = self._frames[first] * (256 - weight) + self._frames[second] * weight
            self._texture.replace((mixed >> 8).astype(np.uint8)[..., None])
        self._texture.bind()

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        self._texture.release()
