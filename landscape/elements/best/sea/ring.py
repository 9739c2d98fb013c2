"""The horizon ring: flat sea around the patches of 2006, out to the horizon (``water.horizon``).

Technique: a grid whose lines are farther apart outwards, without the cell that the patches fill, in
a display list. It does not move: waves would not show at that distance. Drawn before the patches,
in the same colour. (Sea needs no ring: its own grid reaches the horizon.)
State used: GL_BLEND, GL_LIGHTING, GL_TEXTURE_2D, GL_COLOR_MATERIAL.
"""

from collections.abc import Hashable

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays
from landscape.elements.best.sea.sea import Sea
from landscape.elements.element import Element
from landscape.elements.settings import Settings
from landscape.elements.sun import lit
from landscape.elements.water_surface import PATCHES, water_texture
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.geometry.mesh import grid_triangles
from landscape.gl.display_list import DisplayList

STEPS = np.array([0.02, 0.05, 0.12, 0.3, 1.0])  # chosen: lines outside, as fractions of the reach


def ring_grid(inner: tuple[float, float], reach: float) -> tuple[np.ndarray, np.ndarray]:
    """Return points x, z (n, 2) and triangles (m, 3) of a square ring.

    It reaches from the square ``inner`` = (low, high), in x and z, ``reach`` units outward.
    """
    low, high = inner
    steps = reach * STEPS
    lines = np.concatenate([low - steps[::-1], np.linspace(low, high, 6), high + steps])
    x, z = np.meshgrid(lines, lines)
    points = np.stack([x.ravel(), z.ravel()], axis=1)
    triangles = grid_triangles(len(lines), len(lines))
    centre = points[triangles].mean(axis=1)
    outside = ((centre < low) | (centre > high)).any(axis=1)
    return points, np.ascontiguousarray(triangles[outside])


class HorizonRing(Element[Settings]):
    """The sea beyond the patches."""

    @classmethod
    def serves(cls, settings: Settings) -> bool:
        """Return whether the water of 2006 is to reach farther: the other sea does so itself."""
        return settings.water.horizon > 0 and not Sea.serves(settings)

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return the values that the constructor uses."""
        water = settings.water
        shape = water.level, water.patch, water.repeat, water.horizon
        return *shape, water.trilinear, water.lod_bias

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Load the texture and compile the ring."""
        self.settings = settings
        water = settings.water
        inner = (PATCHES[0] * water.patch, (PATCHES[-1] + 1) * water.patch)
        points, triangles = ring_grid(inner, water.horizon)
        vertices = np.insert(points, 1, water.level, axis=1).astype(np.float32)
        coordinates = (points / water.patch * water.repeat).astype(np.float32)
        self._texture = water_texture(settings, assets)

        def send() -> None:
            gl.glNormal3f(0.0, 1.0, 0.0)
            with client_arrays(vertices, coordinates=[coordinates]):
                gl.glDrawElements(gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles)

        self._list = DisplayList(send)

    def draw(self, frame: Frame) -> None:
        """Blend the ring over the mirrored scene; it is the same in each frame."""
        water = self.settings.water
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT
        with attrib(groups):
            gl.glColor4f(*water.color)
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            lit(self.settings.shading)
            if water.textured:
                gl.glEnable(gl.GL_TEXTURE_2D)
                self._texture.bind()
            self._list.call()
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def release(self) -> None:
        """Delete the list and the texture; may be called twice."""
        self._list.release()
        self._texture.release()
