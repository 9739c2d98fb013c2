"""Mist over the floor: transparent layers, one above the other (glSkel, transparent textures).

Technique: a few level sheets with a texture of cloud, blended by its alpha; the texture matrix lets
each drift its own way. Blending is not commutative, so the sheets are drawn from far to near: those
below the eye upwards, those above it downwards. They test the depth but do not write it. Their
alpha falls to zero at the walls, so that no sheet ends in a line there.
State used: GL_BLEND, GL_TEXTURE_2D, the texture matrix, no depth writes, a colour array.
What is wrong without its safeguards: without ``mist.sorted`` the low, dark sheets are blended over
the high, light ones. Without ``mist.mask`` each sheet writes its depth, and one that is drawn too
early hides those behind it, and what is transparent besides. Where a sheet meets a pillar it ends
in a line; many thin sheets make that line faint.
"""

from functools import partial

import numpy as np

from landscape.effects import plan
from landscape.effects.settings import Settings
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.mesh import grid_triangles
from landscape.gl.calls import gl
from landscape.gl.display_list import DisplayList
from landscape.gl.state import attrib, client_arrays, matrix
from landscape.gl.texture import Texture

LOW, HIGH = 0.010, 0.085  # chosen: heights of the lowest and the highest sheet, units
DARK, LIGHT = (0.48, 0.55, 0.66), (0.95, 0.94, 0.90)  # chosen: RGB of the lowest and the highest
REPEAT = 1.1  # chosen: textures per unit
DRIFT = 0.0009  # chosen: textures per kt
FADE = 0.12  # chosen: units from the walls within which the mist thins out
STEP = 0.06  # chosen: units between the vertices of a sheet


def heights(count: int) -> np.ndarray:
    """Return the sheets' heights in units, from the lowest to the highest, (count,)."""
    return np.linspace(LOW, HIGH, count) if count > 1 else np.full(count, (LOW + HIGH) / 2)


def far_to_near(levels: np.ndarray, eye: float) -> np.ndarray:
    """Return the order in which sheets at these heights are drawn for an eye's height."""
    return np.argsort(-np.abs(levels - eye), kind="stable")


def sheet() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return a sheet at height 0: vertices (n, 3), opacity (n,) 0..1, triangles (m, 3)."""
    area = plan.INSIDE
    along_x = np.linspace(area.west, area.east, round((area.east - area.west) / STEP) + 1)
    along_z = np.linspace(area.north, area.south, round((area.south - area.north) / STEP) + 1)
    x, z = (grid.ravel() for grid in np.meshgrid(along_x, along_z))
    vertices = np.stack([x, np.zeros_like(x), z], axis=1).astype(np.float32)
    away = np.minimum.reduce([x - area.west, area.east - x, z - area.north, area.south - z])
    triangles = grid_triangles(len(along_x), len(along_z))
    return vertices, np.clip(away / FADE, 0.0, 1.0), triangles


class Mist:
    """The mist."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the clouds and compile the sheets, the lowest first."""
        self._settings = settings
        self._texture = Texture(read_image(assets.path("clouds.png")))
        vertices, opacity, triangles = sheet()
        coordinates = np.ascontiguousarray(vertices[:, [0, 2]] * REPEAT)
        mist = settings.mist
        self._levels = heights(mist.sheets)
        shares = np.linspace(0, 1, mist.sheets) if mist.sheets > 1 else [0.5]

        def send(share: float) -> None:
            colors = np.empty((len(vertices), 4), np.float32)
            colors[:, :3] = np.array(DARK) * (1 - share) + np.array(LIGHT) * share
            colors[:, 3] = opacity * mist.density
            with client_arrays(vertices, None, colors, [coordinates]):
                gl.glDrawElements(gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles)

        self._lists = [DisplayList(partial(send, float(share))) for share in shares]

    def apply(self, settings: Settings) -> bool:
        """Apply new settings; return False, changing nothing, if the sheets would differ."""
        built = self._settings.mist.sheets, self._settings.mist.density
        if built != (settings.mist.sheets, settings.mist.density):
            return False
        self._settings = settings
        return True

    def draw(self, frame: Frame) -> None:
        """Blend the sheets over what has been drawn."""
        mist = self._settings.mist
        if not mist.enabled:
            return
        order = far_to_near(self._levels, frame.eye_y)
        if not mist.sorted:
            order = np.arange(len(self._levels))[::-1]
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
        with attrib(groups | gl.GL_CURRENT_BIT | gl.GL_TEXTURE_BIT):
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            gl.glDepthMask(not mist.mask)
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._texture.bind()
            for number in order.tolist():
                self._draw_sheet(number, frame.kt)
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)

    def _draw_sheet(self, number: int, kt: float) -> None:
        """Draw a sheet at its height, its texture turned and moved in its own way."""
        with matrix():
            gl.glTranslatef(0.0, float(self._levels[number]), 0.0)
            gl.glMatrixMode(gl.GL_TEXTURE)
            with matrix():
                gl.glRotatef(67.0 * number, 0.0, 0.0, 1.0)
                gl.glTranslatef(DRIFT * kt, 0.37 * number, 0.0)
                self._lists[number].call()
                gl.glMatrixMode(gl.GL_TEXTURE)
            gl.glMatrixMode(gl.GL_MODELVIEW)

    def release(self) -> None:
        """Delete the sheets and the texture; may be called twice."""
        for each in self._lists:
            each.release()
        self._texture.release()
