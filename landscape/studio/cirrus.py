"""Cirrus: thin clouds on a plane high above the others, as streaks or as fibres."""

import functools

import numpy as np
from scipy import ndimage

from landscape.studio.air import Scene
from landscape.studio.images import smoothstep, spectral_noise

HEIGHT = 9000.0  # metres, chosen
TURN_DEG = 28.0  # chosen: the wind up there
STREAK_PERIOD, FIBRE_PERIOD = 52e3, 44e3  # metres, chosen: side of the tiles of noise
ASPECT = 7.0  # chosen: length of the fibres over their width


def _at(tile: np.ndarray, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Look up a tile of noise (n, n) at texels u, v, between texels linear."""
    n = len(tile)
    return ndimage.map_coordinates(tile, [u % n, v % n], order=1, mode="grid-wrap")


def _along_wind(d: np.ndarray, period: float, n: int) -> tuple[np.ndarray, np.ndarray]:
    """Return where directions (h, w, 3) meet the plane: texels along the wind and across it."""
    up = np.maximum(d[..., 1], 0.02)
    x, z = d[..., 0] / up * HEIGHT, d[..., 2] / up * HEIGHT
    turn = np.radians(TURN_DEG)
    along = (x * np.cos(turn) + z * np.sin(turn)) / period * n
    across = (-x * np.sin(turn) + z * np.cos(turn)) / period * n
    return along, across


def streaks(_scene: Scene, d: np.ndarray) -> np.ndarray:
    """Return the opacity (h, w) of wide soft streaks in directions (h, w, 3)."""
    fine, wide = _streak_tiles()
    along, across = _along_wind(d, STREAK_PERIOD, len(wide))
    bend = 26.0 * _at(wide, along * 0.7 + 300.0, across * 0.7)
    streak = _at(fine, along * 0.7 + bend, across * 1.7 + 1.4 * bend)
    clusters = _at(wide, along * 0.8, across * 0.8)
    amount = smoothstep(-0.3, 3.4, streak + 0.9 * clusters) * smoothstep(-0.2, 1.6, clusters)
    return 0.45 * amount * smoothstep(np.sin(0.07), np.sin(0.42), d[..., 1])


def fibres(scene: Scene, d: np.ndarray) -> np.ndarray:
    """Return the opacity (h, w) of patches of fine fibres in directions (h, w, 3)."""
    fine, wide = _fibre_tiles()
    n = len(wide)
    along, across = _along_wind(d, FIBRE_PERIOD, n)
    bend = 0.045 * n * _at(wide, 0.5 * along + 0.3 * n, 0.5 * across)  # fibres curve together
    patches = _at(wide, 0.6 * along, 1.1 * across + bend)
    fibre = _at(fine, along + 0.6 * bend, across + bend)
    amount = smoothstep(0.3, 2.4, patches) * smoothstep(-0.9, 2.8, fibre + 0.5 * patches)
    amount = 0.66 * amount * smoothstep(np.sin(0.07), np.sin(0.40), d[..., 1])
    from_sun = np.degrees(np.arccos(np.clip(d @ scene.towards_sun(), -1.0, 1.0)))
    return amount * (1.0 - 0.75 * np.exp(-((from_sun / 26.0) ** 2)))  # they would hide its glow


@functools.lru_cache(maxsize=1)
def _streak_tiles() -> tuple[np.ndarray, np.ndarray]:
    """Return tiling noise for the streaks, fine and coarse, each (1024, 1024)."""
    return spectral_noise(1024, 1.75, 51, low_cut=4.0), spectral_noise(1024, 2.4, 52, low_cut=1.0)


@functools.lru_cache(maxsize=1)
def _fibre_tiles() -> tuple[np.ndarray, np.ndarray]:
    """Return two tiles of noise, (2048, 2048): fibres along rows, and patches."""
    n = 2048
    k = np.fft.fftfreq(n) * n
    length = np.hypot(ASPECT * k[:, None], k[None, :])
    amplitude = np.where(length > 8.0, np.maximum(length, 1.0) ** -1.55, 0.0)
    spectrum = np.fft.fft2(np.random.default_rng(51).standard_normal((n, n))) * amplitude
    fine = np.fft.ifft2(spectrum).real
    return fine / fine.std(), spectral_noise(n, 2.3, 52, low_cut=1.0)
