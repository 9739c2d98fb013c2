"""The cirrus of the preset best: how much of the sky, how strong, along which lines."""

from typing import Any

import numpy as np
import pytest

pytest.importorskip("scipy", reason="the extra `studio` is not installed")
from scipy import ndimage

from landscape.studio.sky import cirrus
from landscape.studio.sky.air import DUSK, FAIR


def opacity(x: np.ndarray, z: np.ndarray, scene: Any = FAIR) -> np.ndarray:
    """Return the opacity above points of the ground, in metres."""
    d = np.stack([x, np.full_like(x, cirrus.HEIGHT), z], axis=-1)
    return cirrus.fibres(scene, d / np.linalg.norm(d, axis=-1, keepdims=True))


def sky(scene: Any) -> np.ndarray:
    """Return the opacity in directions that are even over the sky, (90, 360)."""
    up = (np.arange(90) + 0.5)[:, None] / 90 + np.zeros((1, 360))
    turn = np.radians(np.arange(360.0))[None, :]
    flat = np.sqrt(1.0 - up * up)
    d = np.stack([flat * np.sin(turn), up, -flat * np.cos(turn)], axis=-1)
    return cirrus.fibres(scene, d)


@pytest.mark.parametrize("scene", [FAIR, DUSK])
@pytest.mark.seldom(14, first=5)
def test_cirrus_are_thin_and_most_of_the_sky_is_clear(scene: Any) -> None:
    seen = sky(scene)
    assert 0.02 < (seen > 0.05).mean() < 1 / 3
    assert 0.2 < seen.max() < 0.6


@pytest.mark.seldom(5)
def test_fibres_lie_along_the_wind_without_bends() -> None:
    """The structure tensor: in each part of the plane, fibres go where brightness changes least."""
    side = np.arange(-45e3, 45e3, 150.0)
    z, x = np.meshgrid(side, side, indexing="ij")
    seen = opacity(x, z)
    dz, dx = np.gradient(seen)
    xx, xz, zz = (ndimage.gaussian_filter(product, 15.0) for product in (dx * dx, dx * dz, dz * dz))
    along = 0.5 * np.arctan2(2.0 * xz, xx - zz) + np.pi / 2
    away = np.degrees(along) - cirrus.TURN_DEG
    away = np.abs((away + 90.0) % 180.0 - 90.0)
    weight = xx + zz
    assert weight[away > 15.0].sum() < 0.05 * weight.sum()
