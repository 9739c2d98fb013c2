"""The tiles of blocks and the pictures of plants, in plain colours."""

import numpy as np

from landscape.files.assets import Assets
from landscape.voxel.blocks import PLANT_TILES, TILES

SIDE = 64
COLOURS = {
    "grass_top": (110, 165, 70),
    "grass_side": (120, 110, 70),
    "earth": (125, 88, 58),
    "rock": (130, 128, 124),
    "sand": (226, 208, 156),
    "gravel": (120, 120, 118),
    "brick": (176, 168, 156),
    "slate": (90, 100, 116),
    "planks": (176, 136, 86),
    "log_top": (190, 160, 110),
    "bark": (150, 130, 110),
}


def tiles(assets: Assets) -> dict[str, np.ndarray]:
    """Return the picture of each tile, uint8 (64, 64, 3), by name."""
    return {
        name: np.full((SIDE, SIDE, 3), COLOURS.get(name, (225, 225, 225)), np.uint8)
        for name in TILES
    }


def plants(assets: Assets) -> np.ndarray:
    """Return the pictures of plants side by side, uint8 (64, 64 n, 4)."""
    return np.zeros((SIDE, SIDE * len(PLANT_TILES), 4), np.uint8)


def ripples(assets: Assets) -> np.ndarray:
    """Return the ripples' normals as colours, uint8 (n, n, 3), z up."""
    rng = np.random.default_rng(3)
    n = 128
    f = np.fft.fftfreq(n) * n
    k = np.hypot(f[:, None], f[None])
    size = np.where((k > 2) & (k < 20), 1 / np.maximum(k, 1) ** 1.6, 0)
    spectrum = size * np.exp(2j * np.pi * rng.random((n, n)))
    h = np.real(np.fft.ifft2(spectrum))
    h /= h.std()
    dx, dz = (np.roll(h, -1, a) - np.roll(h, 1, a) for a in (1, 0))
    v = np.stack([-dx * 0.35, -dz * 0.35, np.ones_like(h)], -1)
    v /= np.linalg.norm(v, axis=-1, keepdims=True)
    return (v * 127.5 + 128).astype(np.uint8)
