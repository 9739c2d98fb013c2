"""Mist over the floor: transparent layers, one above the other (glSkel, transparent textures).

Technique: transparent sheets (elements/best/air/mist_sheets.py), blended from far to near. Their
alpha falls to zero at the walls, so that no sheet ends in a line there.
State used: as mist_sheets.py.
What is wrong without its safeguards: without ``mist.sorted`` the low, dark sheets are blended over
the high, light ones. Without ``mist.mask`` each sheet writes its depth, and one that is drawn too
early hides those behind it, and what is transparent besides. Where a sheet meets a pillar it ends
in a line; many thin sheets make that line faint.
"""

import numpy as np

from landscape.effects import plan
from landscape.effects.settings import Settings
from landscape.elements.best.air.mist_sheets import UNLIT, MistSheets
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.mesh import Mesh, grid_triangles

LOW, HIGH = 0.010, 0.085  # chosen: heights of the lowest and the highest sheet, units
DARK, LIGHT = (0.48, 0.55, 0.66), (0.95, 0.94, 0.90)  # chosen: RGB of the lowest and the highest
REPEAT = 1.1  # chosen: textures per unit
DRIFT = 0.0009  # chosen: textures per kt
FADE = 0.12  # chosen: units from the walls within which the mist thins out


def heights(count: int) -> np.ndarray:
    """Return the sheets' heights in units, from the lowest to the highest, (count,)."""
    return np.linspace(LOW, HIGH, count) if count > 1 else np.full(count, (LOW + HIGH) / 2)


def sheet() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return a sheet at height 0: vertices (n, 3), opacity (n,) 0..1, triangles (m, 3)."""
    area = plan.INSIDE
    along_x = [area.west, area.west + FADE, area.east - FADE, area.east]
    along_z = [area.north, area.north + FADE, area.south - FADE, area.south]
    x, z = (grid.ravel() for grid in np.meshgrid(along_x, along_z))
    vertices = np.stack([x, np.zeros_like(x), z], axis=1).astype(np.float32)
    away = np.minimum.reduce([x - area.west, area.east - x, z - area.north, area.south - z])
    return vertices, np.clip(away / FADE, 0.0, 1.0), grid_triangles(4, 4)


class Mist:
    """The mist."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the clouds and compile the sheets, the lowest first."""
        self._settings = settings
        vertices, opacity, triangles = sheet()
        mist = settings.mist
        shares = np.linspace(0, 1, mist.sheets) if mist.sheets > 1 else np.array([0.5])

        def coloured(share: float) -> Mesh:
            colors = np.empty((len(vertices), 4), np.float32)
            colors[:, :3] = np.array(DARK) * (1 - share) + np.array(LIGHT) * share
            colors[:, 3] = opacity * mist.density
            return Mesh(vertices, UNLIT, triangles, (), colors)

        sheets = [coloured(share) for share in shares.tolist()]
        picture = read_image(assets.path("clouds.png"))
        self._sheets = MistSheets(picture, heights(mist.sheets), sheets, REPEAT)

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
        if mist.enabled:
            self._sheets.draw(frame, DRIFT * frame.kt, mist.sorted, mist.mask)

    def release(self) -> None:
        """Delete the sheets and the texture; may be called twice."""
        self._sheets.release()
