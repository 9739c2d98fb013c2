"""Morning mist over the bay, off in both presets (``mist.enabled``).

Technique: transparent sheets above the sea (mist_sheets.py). The opacity of a sheet is set at its
vertices: it falls to zero where the ground comes near the sheet, so that no line shows where they
meet, farther inland, and towards the map's edge. Lit by the sun's colour, and fogged.
Not in the report.
State used: as mist_sheets.py.
What is wrong with it: sprites do not write their depth, so they are drawn over all the mist, even
where it lies before them. Where it is thickest there are none.
"""

from collections.abc import Hashable
from typing import Self

import numpy as np

from landscape.elements.best.mist.mist_sheets import UNLIT, MistSheets
from landscape.elements.element import Element, Site
from landscape.elements.ground import Ground
from landscape.elements.settings import Settings, Sun
from landscape.elements.sun import painted
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.height_field import HeightField
from landscape.geometry.mesh import Mesh, grid_triangles

LOW, HIGH = 0.03, 0.42  # chosen: heights of the lowest and the highest sheet above the sea, units
DARK, LIGHT = (0.74, 0.81, 0.88), (1.0, 0.99, 0.96)  # chosen: RGB of the lowest and the highest
SHADED, SUNNY = 0.1, 0.5  # chosen: how far these face the sun, as a cosine
THIN = 0.45  # chosen: opacity of the highest sheet, of the lowest's
GAPS = 0.08  # chosen: opacity of a sheet between the clouds
REPEAT = 0.13  # chosen: textures per unit
DRIFT = 0.00025  # chosen: textures per kt
CELLS = 80  # chosen: of a sheet's side
CLEAR = 0.16  # chosen: units of height above the ground within which a sheet thins out
INLAND = 0.7  # chosen: height of the ground above the sea, units, at which there is no mist
EDGE = 4.0  # chosen: units from the map's edge within which a sheet thins out


def opacity(field: HeightField, x: np.ndarray, y: float, z: np.ndarray) -> np.ndarray:
    """Return the opacity (n,), 0..1, of a sheet at height y at places x, z (n,)."""
    ground = field.terrain_height(x, z)
    over = np.clip((y - np.maximum(ground, field.water_level - CLEAR)) / CLEAR, 0.0, 1.0)
    inland = np.clip(1.0 - (ground - field.water_level) / INLAND, 0.0, 1.0)
    away = np.minimum.reduce([x, z, field.size - x, field.size - z]) / EDGE
    t = np.clip(away, 0.0, 1.0)
    return np.asarray(over * inland * t * t * (3 - 2 * t))


def sheet(field: HeightField, sun: Sun, density: float, height: float) -> Mesh:
    """Return a sheet ``height`` units above the sea, as a mesh at height 0 with colours.

    It has the triangles that show.
    """
    line = np.linspace(0.0, field.size, CELLS + 1)
    x, z = (grid.ravel() for grid in np.meshgrid(line, line))
    vertices = np.stack([x, np.zeros_like(x), z], axis=1).astype(np.float32)
    part = opacity(field, x, field.water_level + height, z)
    share = (height - LOW) / (HIGH - LOW)
    colors = np.empty((len(x), 4), np.float32)
    light = painted(sun, SHADED + (SUNNY - SHADED) * share)
    colors[:, :3] = (np.array(DARK) * (1 - share) + np.array(LIGHT) * share) * light
    colors[:, 3] = part * density * (1 - (1 - THIN) * share)
    triangles = grid_triangles(CELLS + 1, CELLS + 1)
    shown = (part[triangles] > 0).any(axis=1)
    kept, corners = np.unique(triangles[shown], return_inverse=True)
    return Mesh(
        np.ascontiguousarray(vertices[kept]),
        UNLIT,
        np.ascontiguousarray(corners.reshape(-1, 3), np.uint32),
        (),
        np.ascontiguousarray(colors[kept]),
    )


class BayMist(Element[Settings]):
    """The mist."""

    asked_by = ("mist.enabled",)

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        """Build it over the ground."""
        return cls(site.settings, site.assets, site.elements[Ground].field)

    def __init__(self, settings: Settings, assets: Assets, field: HeightField) -> None:
        """Read the clouds and compile the sheets over the ground of ``field``."""
        self.settings, mist = settings, settings.mist
        heights = np.linspace(LOW, HIGH, mist.sheets) if mist.sheets > 1 else np.array([LOW])
        sheets = [sheet(field, settings.sun, mist.density, each) for each in heights.tolist()]
        picture = read_image(assets.path("clouds.png"))
        gaps = np.rint(GAPS * 255 + (1 - GAPS) * picture[..., 3]).astype(np.uint8)
        picture = np.dstack([picture[..., :3], gaps])
        self._sheets = MistSheets(picture, field.water_level + heights, sheets, REPEAT)

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return the settings that the sheets were made from, beside the ground."""
        return settings.mist, settings.sun, settings.water.level

    def draw(self, frame: Frame) -> None:
        """Blend the sheets over what has been drawn."""
        self._sheets.draw(frame, DRIFT * frame.kt)

    def release(self) -> None:
        """Delete the sheets; may be called twice."""
        self._sheets.release()
