"""Shafts of light: the sun in the hall's dusty air.

Technique: from each window, sheets in the direction of the sun's rays, upright, one behind the
other; their light is added to the picture. It is strongest at the window, and none at a sheet's
edges. Each row of a sheet ends where its ray meets the floor. Drawn after what is opaque; depth is
tested and not written, so that a pillar hides the light behind it and stands in that before it.
State used: GL_BLEND, the depth mask.
What is wrong with it: the air is lit in sheets, not everywhere, so that from the side of the sun
one looks along them and sees none; and what stands in the light throws no shadow through the air.
"""

from typing import Self

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays
from landscape.elements.element import Element, Site
from landscape.elements.sun import direction
from landscape.frame import Frame
from landscape.geometry.mesh import grid_triangles
from landscape.hall import plan
from landscape.hall.settings import Settings

ACROSS = (-0.026, 0.026)  # chosen: where in a window's width the sheets begin: in its two lights
ROWS, COLUMNS = 7, 6  # chosen: of a sheet's grid
COLOUR = (1.0, 0.86, 0.62)  # chosen
LEFT = 0.35  # chosen: fraction of the light at a ray's end


def sheets(towards: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return vertices (n, 3), brightness (n,) 0..1 and triangles (m, 3) of all sheets.

    ``towards`` (3,) points to the sun. There are none if it shines from below or from the west.
    """
    if towards[1] <= 0.0 or towards[0] <= 0.0:
        return np.zeros((0, 3), np.float32), np.zeros(0), np.zeros((0, 3), np.uint32)
    rise, along = np.meshgrid(np.linspace(0, 1, ROWS), np.linspace(0, 1, COLUMNS), indexing="ij")
    low, high = plan.WINDOW_SILL + 0.01, plan.WINDOW_TOP - 0.03
    start = low + rise * (high - low)
    length = along * np.minimum(
        start / towards[1], (plan.INSIDE.east - plan.INSIDE.west) / towards[0]
    )
    bright = np.sin(np.pi * rise) ** 0.7 * (1 - (1 - LEFT) * along) * np.minimum(along / 0.15, 1)
    vertices: list[np.ndarray] = []
    triangles: list[np.ndarray] = []
    grid = grid_triangles(COLUMNS, ROWS)
    for middle in plan.ALCOVES:
        for aside in ACROSS:
            x = plan.INSIDE.east + plan.WALL / 2 - length * towards[0]
            z = middle + aside - length * towards[2]
            triangles.append(grid + len(vertices) * ROWS * COLUMNS)
            vertices.append(np.stack([x, start - length * towards[1], z], axis=-1).reshape(-1, 3))

    return (
        np.ascontiguousarray(np.concatenate(vertices), np.float32),
        np.tile(bright.ravel(), len(vertices)),
        np.ascontiguousarray(np.concatenate(triangles), np.uint32),
    )


class Shafts(Element[Settings]):
    """The shafts of light."""

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        """Build it; it needs no files."""
        return cls(site.settings)

    def __init__(self, settings: Settings) -> None:
        """Compute the sheets."""
        self._build(settings)

    def _build(self, settings: Settings) -> None:
        self.settings = settings
        self._vertices, bright, self._triangles = sheets(direction(settings.sun))
        light = settings.shafts.strength * bright[:, None] * np.array([*COLOUR, 0.0])
        self._colors = np.ascontiguousarray(light, np.float32)

    def take(self, settings: Settings) -> None:
        """Take other settings, with other sheets for another sun or strength."""
        if (settings.sun, settings.shafts) != (self.settings.sun, self.settings.shafts):
            self._build(settings)
        self.settings = settings

    def draw(self, frame: Frame) -> None:
        """Add the light of the sheets."""
        if not self.settings.shafts.enabled or frame.mirrored:
            return
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
        with attrib(groups | gl.GL_CURRENT_BIT):
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)
            gl.glDepthMask(gl.GL_FALSE)
            with client_arrays(self._vertices, None, self._colors):
                gl.glDrawElements(
                    gl.GL_TRIANGLES, self._triangles.size, gl.GL_UNSIGNED_INT, self._triangles
                )
