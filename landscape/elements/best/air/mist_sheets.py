"""Mist as transparent sheets, one above the other (glSkel, transparent textures).

Technique: level sheets with a texture of cloud, blended by its alpha; the texture matrix lets each
drift its own way. Blending is not commutative, so the sheets are drawn from far to near: those
below the eye upwards, those above it downwards. They test the depth but do not write it.
State used: GL_BLEND, GL_TEXTURE_2D, the texture matrix, no depth writes, a colour array.
What is wrong without its safeguards: blended in another order, low, dark sheets cover high, light
ones. A sheet that writes its depth and is drawn too early hides those behind it, and what is
transparent besides.
"""

from collections.abc import Sequence
from functools import partial

import numpy as np

from landscape.frame import Frame
from landscape.geometry.mesh import Mesh
from landscape.gl.calls import gl
from landscape.gl.display_list import DisplayList
from landscape.gl.state import attrib, client_arrays, matrix
from landscape.gl.texture import Texture

UNLIT = np.zeros((0, 3), np.float32)  # the normals of a mesh that is not lit
TURN, SHIFT = 67.0, 0.37  # chosen: degrees and textures by which each sheet differs from the next


def far_to_near(levels: np.ndarray, eye: float) -> np.ndarray:
    """Return the order in which sheets at these heights are drawn for an eye's height."""
    return np.argsort(-np.abs(levels - eye), kind="stable")


class MistSheets:
    """Sheets of mist at their heights."""

    def __init__(
        self,
        picture: np.ndarray,
        levels: np.ndarray,
        sheets: Sequence[Mesh],
        repeat: float,
        trilinear: bool = True,
    ) -> None:
        """Upload a picture of cloud and compile the sheets, the lowest first.

        ``levels`` are their heights, ``sheets`` their meshes at height 0 with colours, float32
        (n, 4); ``repeat`` is how many textures there are in a unit; see Texture for ``trilinear``.
        """
        self._texture, self._levels = Texture(picture, trilinear=trilinear), levels

        def send(sheet: Mesh) -> None:
            coordinates = np.ascontiguousarray(sheet.vertices[:, [0, 2]] * np.float32(repeat))
            with client_arrays(sheet.vertices, None, sheet.colors, [coordinates]):
                count = sheet.triangles.size
                gl.glDrawElements(gl.GL_TRIANGLES, count, gl.GL_UNSIGNED_INT, sheet.triangles)

        self._lists = [DisplayList(partial(send, sheet)) for sheet in sheets]

    def draw(self, frame: Frame, drift: float, ordered: bool = True, mask: bool = True) -> None:
        """Blend the sheets over what has been drawn; ``drift`` is in textures.

        Without ``ordered`` they are drawn from the highest to the lowest, without ``mask`` they
        write their depth.
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
            for number in order.tolist():
                self._draw_sheet(number, drift)
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)

    def _draw_sheet(self, number: int, drift: float) -> None:
        """Draw a sheet at its height, its texture turned and moved in its own way."""
        with matrix():
            gl.glTranslatef(0.0, float(self._levels[number]), 0.0)
            gl.glMatrixMode(gl.GL_TEXTURE)
            with matrix():
                gl.glRotatef(TURN * number, 0.0, 0.0, 1.0)
                gl.glTranslatef(drift, SHIFT * number, 0.0)
                self._lists[number].call()
                gl.glMatrixMode(gl.GL_TEXTURE)
            gl.glMatrixMode(gl.GL_MODELVIEW)

    def release(self) -> None:
        """Delete the sheets and the texture; may be called twice."""
        for each in self._lists:
            each.release()
        self._texture.release()
