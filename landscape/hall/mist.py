"""Mist over the floor: transparent layers, one above the other (glSkel, transparent textures).

Technique: transparent sheets (elements/best/mist/mist_sheets.py), blended from far to near. Their
alpha falls to zero at the walls, so that no sheet ends in a line there. Around pillars, plinth and
the torch beside the pool a mask does the same (``mist.clear``): the distance from them, a texture.
State used: as mist_sheets.py.
What is wrong without its safeguards: without ``mist.sorted`` the low, dark sheets are blended over
the high, light ones. Without ``mist.mask`` each sheet writes its depth, and one that is drawn too
early hides those behind it, and what is transparent besides. Without ``mist.clear`` each sheet cuts
through the pillars in a line, and near its own height is streaks like stretched cloth.
"""

from collections.abc import Hashable

import numpy as np

from landscape.elements.best.mist.mist_sheets import UNLIT, Mask, MistSheets
from landscape.elements.element import Element
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.mesh import Mesh, grid_triangles
from landscape.hall import plan
from landscape.hall.settings import Settings

LOW, HIGH = 0.010, 0.085  # chosen: heights of the lowest and the highest sheet, units
DARK, LIGHT = (0.48, 0.55, 0.66), (0.95, 0.94, 0.90)  # chosen: RGB of the lowest and the highest
REPEAT = 1.1  # chosen: textures per unit
DRIFT = 0.0009  # chosen: textures per kt
FADE = 0.12  # chosen: units from the walls within which the mist thins out
DRY, DAMP = 0.5, 0.3  # chosen: opacity far from the pool; units from it where that is reached
AROUND = 0.075  # chosen: units from pillars and plinth within which the mist thins out
THIN = 0.03  # chosen: units above and below a sheet within which an eye sees it fade
BASES = 0.016, 0.022  # chosen: how much wider pillars are at their feet; radius of the torch's
TEXELS = 160.0  # chosen: of the mask, per unit
# Chosen: see :func:`softened`.
COARSE = 16
BASE = 0.16
GAIN = 1.5


def heights(count: int) -> np.ndarray:
    """Return the sheets' heights in units, from the lowest to the highest, (count,)."""
    return np.linspace(LOW, HIGH, count) if count > 1 else np.full(count, (LOW + HIGH) / 2)


def sheet() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return a sheet at height 0: vertices (n, 3), opacity (n,) 0..1, triangles (m, 3)."""
    area, pool = plan.INSIDE, plan.POOL
    along_x = sorted(
        [
            area.west,
            area.west + FADE,
            pool.west - DAMP,
            pool.west,
            pool.east,
            pool.east + DAMP,
            area.east - FADE,
            area.east,
        ]
    )
    along_z = sorted(
        [
            area.north,
            area.north + FADE,
            pool.north - DAMP,
            pool.north,
            pool.south,
            pool.south + DAMP,
            area.south - FADE,
            area.south,
        ]
    )

    x, z = (grid.ravel() for grid in np.meshgrid(along_x, along_z))
    vertices = np.stack([x, np.zeros_like(x), z], axis=1).astype(np.float32)

    inwards = np.minimum.reduce([x - area.west, area.east - x, z - area.north, area.south - z])
    aside = np.maximum.reduce([pool.west - x, x - pool.east, pool.north - z, z - pool.south])
    damp = 1.0 - np.clip(aside / DAMP, 0.0, 1.0)
    opacity = np.clip(inwards / FADE, 0.0, 1.0) * (DRY + (1.0 - DRY) * damp)
    return vertices, opacity, grid_triangles(len(along_x), len(along_z))


def clearance(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return the distance in units of places from the nearest thing that stands in the mist."""
    wider, torch = BASES
    round_things = [
        (row, along, plan.PILLAR + wider) for row in plan.ROWS for along in plan.BAYS[1:-1]
    ]
    round_things.append((plan.TORCH[0], plan.TORCH[2], torch))
    found = [np.hypot(x - east, z - south) - radius for east, south, radius in round_things]
    half = plan.PLINTH[0]
    beside = [
        np.maximum(np.abs(at - middle) - half, 0.0)
        for at, middle in zip((x, z), plan.STATUE, strict=True)
    ]
    found.append(np.hypot(*beside))
    return np.maximum(np.minimum.reduce(found), 0.0)


def around_things() -> Mask:
    """Return the mask that thins the mist out around what stands in it."""
    area = plan.INSIDE
    columns, rows = (
        round(TEXELS * side) for side in (area.east - area.west, area.south - area.north)
    )
    x = area.west + (np.arange(columns) + 0.5) / columns * (area.east - area.west)
    z = area.north + (np.arange(rows) + 0.5) / rows * (area.south - area.north)
    t = np.clip(clearance(x[None, :], z[:, None]) / AROUND, 0.0, 1.0)
    picture = np.rint(255.0 * t * t * (3.0 - 2.0 * t)).astype(np.uint8)
    return Mask(picture, (area.west, area.north, area.east, area.south))


def softened(clouds: np.ndarray) -> np.ndarray:
    """Return a picture of mist, uint8 (h, w, 4), from one of clouds.

    Seen at a grazing angle, clouds with clear sky between them would be streaks: means of COARSE
    by COARSE texels have no small gaps, and BASE opacity closes the large ones.
    """
    height, width = (side // COARSE for side in clouds.shape[:2])
    parts = clouds.reshape(height, COARSE, width, COARSE, 4).astype(np.float64)
    mean = parts.mean(axis=(1, 3))
    opaque = np.clip(BASE + GAIN * mean[..., 3] / 255, 0.0, 1.0)
    mean[..., :3], mean[..., 3] = 255.0, 255.0 * opaque
    return np.ascontiguousarray(np.rint(mean), np.uint8)


class Mist(Element[Settings]):
    """The mist."""

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return what the constructor uses of the settings."""
        return settings.mist.sheets, settings.mist.density

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the clouds and compile the sheets, the lowest first."""
        self.settings = settings
        vertices, opacity, triangles = sheet()
        mist = settings.mist
        shares = np.linspace(0, 1, mist.sheets) if mist.sheets > 1 else np.array([0.5])

        def coloured(share: float) -> Mesh:
            colors = np.empty((len(vertices), 4), np.float32)
            colors[:, :3] = np.array(DARK) * (1 - share) + np.array(LIGHT) * share
            colors[:, 3] = opacity * mist.density
            return Mesh(vertices, UNLIT, triangles, (), colors)

        sheets = [coloured(share) for share in shares.tolist()]
        picture = softened(read_image(assets.path("clouds.png")))
        # Between two mip levels of so soft a picture no edge shows.
        levels = heights(mist.sheets)
        self._sheets = MistSheets(picture, levels, sheets, REPEAT, False, around_things(), THIN)

    def draw(self, frame: Frame) -> None:
        """Blend the sheets over what has been drawn."""
        mist = self.settings.mist
        if mist.enabled:
            self._sheets.draw(frame, DRIFT * frame.kt, mist.sorted, mist.mask, mist.clear)

    def release(self) -> None:
        """Delete the sheets and the texture; may be called twice."""
        self._sheets.release()
