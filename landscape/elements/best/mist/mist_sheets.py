"""Mist as transparent sheets, one above the other (glSkel, transparent textures).

Technique: level sheets with a texture of cloud, blended by its alpha; the texture matrix lets each
drift its own way. Blending is not commutative, so the sheets are drawn from far to near: those
below the eye upwards, those above it downwards. They test the depth but do not write it. A mask on
a second texture unit may thin them out around what stands in them, so that they meet it in no line,
and a sheet may fade as the eye comes near its plane, where it would be streaks.
State used: GL_BLEND, GL_TEXTURE_2D of one or two units, generated coordinates, the texture matrix,
no depth writes, a colour array.
What is wrong without its safeguards: blended in another order, low, dark sheets cover high, light
ones. A sheet that writes its depth and is drawn too early hides those behind it, and what is
transparent besides.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays, matrix
from framelens.gl.texture import Texture
from landscape.frame import Frame
from landscape.geometry.mesh import Mesh
from landscape.gl.display_list import DisplayList
from landscape.gl.features import possible
from landscape.gl.generated import generate_by_planes

UNLIT = np.zeros((0, 3), np.float32)  # the normals of a mesh that is not lit
TURN, SHIFT = 67.0, 0.37  # chosen: degrees and textures by which each sheet differs from the next


class Mask(NamedTuple):
    """How opaque the mist may be over an area: uint8 (h, w), and its edges x0, z0, x1, z1."""

    picture: np.ndarray
    edges: tuple[float, float, float, float]


def far_to_near(levels: np.ndarray, eye: float) -> np.ndarray:
    """Return the order in which sheets at these heights are drawn for an eye's height."""
    return np.argsort(-np.abs(levels - eye), kind="stable")


def thinned(sheet: Mesh, opacity: float) -> Mesh:
    """Return a sheet whose colours' alpha is multiplied by ``opacity``."""
    assert sheet.colors is not None
    return replace(sheet, colors=sheet.colors * np.array([1.0, 1.0, 1.0, opacity], np.float32))


class MistSheets:
    """Sheets of mist at their heights."""

    def __init__(
        self,
        picture: np.ndarray,
        levels: np.ndarray,
        sheets: Sequence[Mesh],
        repeat: float,
        trilinear: bool = True,
        mask: Mask | None = None,
        thin: float = 0.0,
    ) -> None:
        """Upload a picture of cloud and compile the sheets, the lowest first.

        ``levels`` are their heights, ``sheets`` their meshes at height 0 with colours, float32
        (n, 4); ``repeat`` is how many textures there are in a unit; see Texture for ``trilinear``.
        Without a second texture unit no ``mask`` is laid. Within ``thin`` units of its height an
        eye sees a sheet fade.
        """
        self._texture, self._levels = Texture(picture, trilinear=trilinear), levels
        self._mask = None
        self._edges = (0.0, 0.0, 1.0, 1.0)
        self._thin = thin
        if mask is not None and possible("mist.clear"):
            white = np.full((*mask.picture.shape, 4), 255, np.uint8)
            white[..., 3] = mask.picture
            self._mask, self._edges = Texture(white, repeat=False, trilinear=False), mask.edges

        self._sheets, self._repeat = list(sheets), np.float32(repeat)
        self._lists = [DisplayList(partial(self._send, sheet)) for sheet in sheets]

    def _send(self, sheet: Mesh) -> None:
        """Send a sheet at height 0."""
        coordinates = np.ascontiguousarray(sheet.vertices[:, [0, 2]] * self._repeat)
        with client_arrays(sheet.vertices, None, sheet.colors, [coordinates]):
            count = sheet.triangles.size
            gl.glDrawElements(gl.GL_TRIANGLES, count, gl.GL_UNSIGNED_INT, sheet.triangles)

    def draw(
        self,
        frame: Frame,
        drift: float,
        ordered: bool = True,
        mask: bool = True,
        clear: bool = True,
    ) -> None:
        """Blend the sheets over what has been drawn; ``drift`` is in textures.

        Without ``ordered`` they are drawn from the highest to the lowest, without ``mask`` they
        write their depth, without ``clear`` they do not thin out.
        """
        order = np.arange(len(self._levels))[::-1]
        if ordered:
            order = far_to_near(self._levels, frame.eye_y)
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
        with attrib(groups | gl.GL_CURRENT_BIT | gl.GL_TEXTURE_BIT):
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            gl.glDepthMask(not mask)
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._texture.bind()
            if clear and self._mask is not None:
                self._lay_mask(self._mask)
            for number in order.tolist():
                away = abs(float(self._levels[number]) - frame.eye_y)
                near = clear and away < self._thin
                self._draw_sheet(number, drift, away / self._thin if near else 1.0)

        gl.glColor4f(1.0, 1.0, 1.0, 1.0)

    def _lay_mask(self, mask: Texture) -> None:
        """Let unit 1 multiply the alpha of what unit 0 samples by the mask."""
        gl.glActiveTexture(gl.GL_TEXTURE1)
        gl.glEnable(gl.GL_TEXTURE_2D)
        mask.bind()
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
        x0, z0, x1, z1 = self._edges
        generate_by_planes(
            (1 / (x1 - x0), 0.0, 0.0, -x0 / (x1 - x0)),
            (0.0, 0.0, 1 / (z1 - z0), -z0 / (z1 - z0)),
        )
        gl.glActiveTexture(gl.GL_TEXTURE0)

    def _draw_sheet(self, number: int, drift: float, opacity: float) -> None:
        """Draw a sheet at its height, its texture turned and moved in its own way."""
        with matrix():
            gl.glTranslatef(0.0, float(self._levels[number]), 0.0)
            gl.glMatrixMode(gl.GL_TEXTURE)
            with matrix():
                gl.glRotatef(TURN * number, 0.0, 0.0, 1.0)
                gl.glTranslatef(drift, SHIFT * number, 0.0)
                if opacity == 1.0:
                    self._lists[number].call()
                else:
                    self._send(thinned(self._sheets[number], opacity))
                gl.glMatrixMode(gl.GL_TEXTURE)
            gl.glMatrixMode(gl.GL_MODELVIEW)

    def release(self) -> None:
        """Delete the sheets and the texture; may be called twice."""
        for each in self._lists:
            each.release()
        self._texture.release()
        if self._mask is not None:
            self._mask.release()
