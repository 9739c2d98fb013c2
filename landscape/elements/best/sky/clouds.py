"""Clouds that move: a half-transparent layer over the sky box (R1, section 4.1; ``sky.moving``).

Technique: a disc above the eye, in a display list, blended over the box. Its vertex alpha falls to
zero at the rim; otherwise the disc would visibly end above the horizon. glTranslatef on the
texture matrix lets it drift with kt: no vertex is sent again.
State used: GL_TEXTURE_2D, GL_BLEND, no depth writes, texture matrix. FineSky restores the state.
"""

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import client_arrays, matrix
from framelens.gl.texture import Texture
from landscape.elements.settings import Settings, Sun
from landscape.elements.sun import direction, painted
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.mesh import grid_triangles
from landscape.gl.display_list import DisplayList

RINGS = (0.0, 0.5, 1.2, 2.2, 3.8, 6.0)  # chosen: radii of the disc, its height being 1
SIDES = 24  # chosen: sectors of the disc
ALPHA = 0.6  # chosen: opacity overhead
TURN_DEG = (
    28.0  # the wind's direction, south of east: that of the painted cirrus (studio/sky/clouds.py)
)
REPEAT = (0.11, 0.42)  # chosen: textures per unit of the disc along the wind and across it
PINK = np.array([0.95, 0.86, 1.18])  # chosen: times a low sun's colour, as redder light gets there
GLARE, GLARE_DEG = 0.7, 28.0  # chosen: opacity lost at the sun, and the width of that gap
EVEN = 0.45  # chosen: how alike a low sun lights the layer on all sides; it is above the shadows
DRIFT = (0.00005, -0.00002)  # chosen: textures per kt along the wind and across it


def cloud_disc() -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return a disc one unit above the eye: vertices (n, 3), colours (n, 4), coordinates (n, 2).

    The last array is the triangles (m, 3), counter-clockwise from below. Opacity falls to zero
    at the rim, which is RINGS[-1] units away, about 9 degrees above the horizon.
    """
    angle = np.arange(SIDES + 1) * 2 * np.pi / SIDES
    radius, turn = (grid.ravel() for grid in np.meshgrid(RINGS, angle, indexing="ij"))
    x, z = radius * np.cos(turn), radius * np.sin(turn)
    vertices = np.stack([x, np.ones_like(x), z], axis=1).astype(np.float32)
    fade = 1.0 - radius / RINGS[-1]
    colors = np.ones((len(x), 4), np.float32)
    colors[:, 3] = ALPHA * np.clip(2.0 * fade, 0.0, 1.0)
    c, s = np.cos(np.radians(TURN_DEG)), np.sin(np.radians(TURN_DEG))
    coordinates = np.stack([x * c + z * s, z * c - x * s], axis=1) * REPEAT
    coordinates = coordinates.astype(np.float32)
    return vertices, colors, coordinates, grid_triangles(SIDES + 1, len(RINGS))


def cloud_light(vertices: np.ndarray, sun: Sun) -> np.ndarray:
    """Return the colours (n, 3) of a disc's vertices (n, 3): warm in the direction of the sun."""
    out = vertices[:, [0, 2]] / np.maximum(np.hypot(vertices[:, 0], vertices[:, 2]), 1.0)[:, None]
    light = painted(sun, EVEN + (1.0 - EVEN) * (out @ direction(sun)[[0, 2]]))
    return light * PINK if sun.relit else light


def cloud_opacity(vertices: np.ndarray, sun: Sun) -> np.ndarray:
    """Return what the opacity of a disc's vertices (n, 3) is multiplied by, (n,): less at the sun.

    Dense streaks in front of the sun would look like rays.
    """
    towards = vertices @ direction(sun) / np.linalg.norm(vertices, axis=1)
    apart_deg = np.degrees(np.arccos(np.clip(towards, -1.0, 1.0)))
    return np.asarray(1.0 - GLARE * np.exp(-((apart_deg / GLARE_DEG) ** 2)))


class Clouds:
    """The cloud layer; FineSky draws it around the eye, and restores the state."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Load the picture and compile the disc in the light of the settings."""
        self._texture = Texture(read_image(assets.path("clouds.png")), trilinear=False)
        vertices, colors, coordinates, triangles = cloud_disc()
        colors[:, :3] = cloud_light(vertices, settings.sun)
        colors[:, 3] *= cloud_opacity(vertices, settings.sun)

        def send() -> None:
            gl.glEnable(gl.GL_TEXTURE_2D)
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            gl.glDepthMask(gl.GL_FALSE)
            self._texture.bind()
            with client_arrays(vertices, None, colors, [coordinates]):
                gl.glDrawElements(gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles)
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

        self._list = DisplayList(send)

    def draw(self, frame: Frame) -> None:
        """Blend the layer of the frame's kt over the box."""
        gl.glMatrixMode(gl.GL_TEXTURE)
        with matrix():
            gl.glTranslatef(-DRIFT[0] * frame.kt, -DRIFT[1] * frame.kt, 0.0)
            self._list.call()
        gl.glMatrixMode(gl.GL_MODELVIEW)

    def release(self) -> None:
        """Delete the list and the texture; may be called twice."""
        self._list.release()
        self._texture.release()
