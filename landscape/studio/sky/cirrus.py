"""Cirrus: thin clouds on a plane high above the others, as streaks or as fibres.

Fibres lie along the wind; in perspective they converge towards two opposite points of the horizon.
Low in the sky the plane is seen almost edge on, and there a bend of 30 degrees would look like a V.
So fibres curve by a few degrees, and turn more only in the hooks at their windward ends.
"""

import functools

import numpy as np
from scipy import ndimage

from landscape.studio.images import smoothstep, spectral_noise
from landscape.studio.sky.air import Scene

HEIGHT = 9000.0  # metres, chosen
TURN_DEG = 28.0  # chosen: the wind up there
STREAK_PERIOD = 52e3  # metres, chosen: side of the tiles of noise

# Fibres: chosen. Lengths are in metres.
FIBRE_PERIOD, BEND_PERIOD = 88e3, 176e3  # sides of the tiles of noise
ASPECT = 14.0  # length of the veils' fibres over their width
BEND = 1500.0  # how far a fibre is from a straight line (standard deviation)
HALF, TEXELS = 84e3, 3072  # tufts lie in a square: half its side, and its texels
STREETS = 18
TUFTS = 16  # in each street
FIBRES = 130  # in each tuft
STEP = 100.0  # between the points of a fibre
LENGTH = 7e3  # of a fibre
HOOK, HOOKED = 1900.0, 1.5  # fibres start at about 0.1..HOOKED radians; e times less after HOOK
PATCH_SEED, TUFT_SEED = 57, 14  # chosen among a few: wide clear parts, tufts on several sides
SOFT = 1.6  # texels: blur of the fibres


def _at(tile: np.ndarray, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Look up a tile of noise (n, n) at texels u, v, between texels linear."""
    n = len(tile)
    return ndimage.map_coordinates(tile, [u % n, v % n], order=1, mode="grid-wrap")


def _along_wind(d: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return where directions (h, w, 3) meet the plane: metres along the wind and across it."""
    up = np.maximum(d[..., 1], 0.02)
    x, z = d[..., 0] / up * HEIGHT, d[..., 2] / up * HEIGHT
    turn = np.radians(TURN_DEG)
    return x * np.cos(turn) + z * np.sin(turn), -x * np.sin(turn) + z * np.cos(turn)


def streaks(_scene: Scene, d: np.ndarray) -> np.ndarray:
    """Return the opacity (h, w) of wide soft streaks in directions (h, w, 3)."""
    fine, wide = _streak_tiles()
    along, across = (metres / STREAK_PERIOD * len(wide) for metres in _along_wind(d))
    bend = 26.0 * _at(wide, along * 0.7 + 300.0, across * 0.7)
    streak = _at(fine, along * 0.7 + bend, across * 1.7 + 1.4 * bend)
    clusters = _at(wide, along * 0.8, across * 0.8)
    amount = smoothstep(-0.3, 3.4, streak + 0.9 * clusters) * smoothstep(-0.2, 1.6, clusters)
    return 0.45 * amount * smoothstep(np.sin(0.07), np.sin(0.42), d[..., 1])


def fibres(scene: Scene, d: np.ndarray) -> np.ndarray:
    """Return the opacity (h, w) of veils of fine fibres, and of tufts, in directions (h, w, 3)."""
    fine, wide, bends = _fibre_tiles()
    along, across = _along_wind(d)
    turn = len(bends) / BEND_PERIOD
    across = across + BEND * _at(bends, turn * along, turn * across)  # fibres curve together
    u, v = along / FIBRE_PERIOD * len(fine), across / FIBRE_PERIOD * len(fine)
    patches, fibre = _at(wide, 0.5 * u, 1.1 * v), _at(fine, u, v)
    veils = smoothstep(0.8, 2.8, patches) * smoothstep(-1.2, 2.6, fibre + 0.6 * patches)
    where = [(metres + HALF) / (2 * HALF) * TEXELS - 0.5 for metres in (across, along)]
    tufts = ndimage.map_coordinates(_tufts(), where, order=1, mode="constant")
    depth = 1.2 * veils + tufts * np.clip(0.62 + 0.38 * fibre, 0.05, 2.0)
    amount = 0.6 * (1.0 - np.exp(-depth)) * smoothstep(np.sin(0.07), np.sin(0.40), d[..., 1])
    from_sun = np.degrees(np.arccos(np.clip(d @ scene.towards_sun(), -1.0, 1.0)))
    return amount * (1.0 - 0.75 * np.exp(-((from_sun / 26.0) ** 2)))  # they would hide its glow


@functools.lru_cache(maxsize=1)
def _streak_tiles() -> tuple[np.ndarray, np.ndarray]:
    """Return tiling noise for the streaks, fine and coarse, each (1024, 1024)."""
    return spectral_noise(1024, 1.75, 51, low_cut=4.0), spectral_noise(1024, 2.4, 52, low_cut=1.0)


@functools.lru_cache(maxsize=1)
def _fibre_tiles() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return tiles of noise: fibres along rows, patches, each (2048, 2048); bends, (256, 256)."""
    n = 2048
    k = np.fft.fftfreq(n) * n
    length = np.hypot(ASPECT * k[:, None], k[None, :])
    amplitude = np.where(length > 8.0, np.maximum(length, 1.0) ** -1.55, 0.0)
    spectrum = np.fft.fft2(np.random.default_rng(51).standard_normal((n, n))) * amplitude
    fine = np.fft.ifft2(spectrum).real
    patches, bends = spectral_noise(n, 2.2, PATCH_SEED), spectral_noise(256, 3.0, 53)
    return fine / fine.std(), patches, bends


@functools.lru_cache(maxsize=1)
def _tufts() -> np.ndarray:
    """Return the optical depth of the tufts of fibres, (TEXELS, TEXELS); rows go along the wind.

    Ice falls from the head of a tuft into a wind that differs from the wind at the head: it is
    drawn out into fibres that are hooked at first, and then lie along the wind.
    """
    rng = np.random.default_rng(TUFT_SEED)
    street = (STREETS, 1, 1)
    tuft = (STREETS, TUFTS, 1)
    each = (STREETS, TUFTS, FIBRES)

    def vary(spread: float, shape: tuple[int, ...]) -> np.ndarray:
        return spread * rng.standard_normal(shape)

    # Of the heads of all fibres: places in the plane; lengths; the angle at which they start.
    size, spread = np.exp(vary(0.25, street)), np.exp(vary(0.4, tuft))
    along, across = rng.uniform(-0.75 * HALF, 0.75 * HALF, (2, *street))
    along = along + 10e3 * size * vary(1.0, tuft) + vary(700.0, each)
    across = across + 3.4e3 * size * vary(1.0, tuft) + 480.0 * spread * vary(1.0, each)
    length = LENGTH * size * np.exp(vary(0.3, tuft) + vary(0.45, each))
    hook = rng.uniform(0.1, HOOKED, street) * np.exp(vary(0.25, tuft) + vary(0.3, each))
    hook_length = HOOK * size * np.exp(vary(0.25, tuft))
    lean = vary(0.025, tuft) + vary(0.02, each)  # radians
    weight = 0.25 / spread * np.exp(vary(0.3, street) + vary(0.5, tuft) + vary(0.7, each))

    depth = np.zeros((TEXELS, TEXELS))
    for s in np.arange(0.0, length.max(), STEP):
        done = np.minimum(s / length, 1.0)
        row, column = (
            np.floor((metres + HALF) / (2 * HALF) * TEXELS).astype(int)
            for metres in (across, along)
        )
        inside = (done < 1.0) & (np.minimum(row, column) >= 0) & (np.maximum(row, column) < TEXELS)
        amount = weight * smoothstep(0.0, 0.3, done) * (1.0 - done) ** 1.6
        np.add.at(depth, (row[inside], column[inside]), amount[inside])
        heading = lean + hook * np.exp(-s / hook_length)
        along, across = along + STEP * np.cos(heading), across + STEP * np.sin(heading)
    return ndimage.gaussian_filter(depth, SOFT, mode="constant")
