"""The mosaic on the bed of the hall's pool: small pale stones in mortar, with a wave of blue ones.

Each stone is a square of its own colour, a little turned and with rounded corners. The tile repeats
in both directions.
"""

from collections.abc import Callable

import numpy as np

from landscape.studio.images import to_uint8

SIDE = 256  # texels
STONES = 20  # chosen: per side
SEED = 11
PALE = np.array([(0.86, 0.82, 0.70), (0.78, 0.76, 0.66), (0.90, 0.88, 0.80)])  # chosen: RGB
BLUE = np.array([(0.20, 0.42, 0.50), (0.28, 0.55, 0.60), (0.16, 0.34, 0.46)])
MORTAR = np.array([0.50, 0.49, 0.44])
TURN = 0.10  # chosen: radians, most
GAP = 0.07  # chosen: stones are this much smaller than their squares, on each side
WAVE = (0.30, 0.07)  # chosen: reach and half breadth of the blue wave, in tiles


def mosaic() -> np.ndarray:
    """Return the tile, uint8 (256, 256, 3)."""
    rng = np.random.default_rng(SEED)
    at = (np.arange(SIDE) + 0.5) / SIDE * STONES
    x, y = np.meshgrid(at, at)
    column, row = x.astype(int), y.astype(int)
    number = row * STONES + column

    def random() -> np.ndarray:
        return np.asarray(rng.random(STONES * STONES))

    angle = (random() * 2 - 1)[number] * TURN
    u, v = x - column - 0.5, y - row - 0.5
    u, v = u * np.cos(angle) - v * np.sin(angle), u * np.sin(angle) + v * np.cos(angle)
    edge = (np.abs(u) ** 6 + np.abs(v) ** 6) ** (1 / 6)  # a square with round corners
    inside = np.clip((0.5 - GAP - edge) * SIDE / STONES + 0.5, 0.0, 1.0)[..., None]

    stone_x = (np.arange(STONES * STONES) % STONES + 0.5) / STONES
    stone_y = (np.arange(STONES * STONES) // STONES + 0.5) / STONES
    crest = 0.5 + WAVE[0] * 0.5 * np.sin(2 * np.pi * stone_x)
    is_blue = np.abs(stone_y - crest) < WAVE[1]
    pick = rng.integers(0, 3, STONES * STONES)
    colours = np.where(is_blue[:, None], BLUE[pick], PALE[pick]) * (0.9 + 0.16 * random()[:, None])
    grain = 1.0 + 0.05 * rng.standard_normal((SIDE, SIDE, 1))
    # Light from the upper left rounds the stones.
    relief = 1.0 - 0.10 * ((u + v) * (edge / 0.5) ** 4)[..., None]
    return to_uint8((MORTAR * (1 - inside) + colours[number] * relief * inside) * grain)


ASSETS: dict[str, Callable[[], np.ndarray]] = {"mosaic.png": mosaic}
