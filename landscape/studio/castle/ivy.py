"""Single leaves of ivy for the weathered castle, as seen from an arm's length.

A leaf's outline is a star of lobes around the place where its stalk ends. From there a pale vein
runs along each lobe, and thinner ones branch from the midrib. The blade is bent along the midrib
and between the veins, and is shaded as such a surface. Lengths are in sides of a cell.
"""

from collections.abc import Callable

import numpy as np

from landscape.studio.images import bleed, cut_out, shrink, smoothstep, spectral_noise

CELL = 128  # texels per side of one leaf
COLUMNS, ROWS = 4, 2  # leaves of the sheet
SCALE = 3  # texels drawn per texel of the sheet, along each side
STALK = np.array([0.5, 0.34])  # where the stalk ends, upwards from the cell's foot
# Chosen: the lobes of each leaf as angle from the tip in degrees, length and half width in degrees.
LOBES = (
    ((0, 0.60, 34), (58, 0.44, 30), (-60, 0.45, 30), (125, 0.28, 34), (-122, 0.29, 34)),
    ((0, 0.58, 40), (52, 0.42, 36), (-54, 0.40, 36), (128, 0.30, 40), (-126, 0.28, 40)),
    ((0, 0.62, 26), (50, 0.46, 22), (-52, 0.44, 22), (112, 0.33, 24), (-110, 0.32, 24)),
    ((0, 0.56, 44), (66, 0.36, 44), (-64, 0.38, 44), (130, 0.28, 40), (-130, 0.28, 40)),
    ((0, 0.60, 30), (60, 0.40, 26), (-56, 0.46, 28), (118, 0.27, 30), (-124, 0.31, 30)),
    ((0, 0.54, 50), (75, 0.36, 50), (-72, 0.36, 50), (140, 0.30, 46), (-140, 0.30, 46)),
    ((0, 0.61, 30), (62, 0.47, 28), (-58, 0.42, 26), (120, 0.32, 28), (-118, 0.28, 30)),
    ((0, 0.57, 38), (56, 0.43, 32), (-62, 0.44, 34), (132, 0.31, 36), (-120, 0.29, 34)),
)
CORE = 0.17  # chosen: how far the blade reaches at least, but for the notch at the stalk
# Chosen: linear albedos of an old leaf, of its veins, of a young leaf's, and of a withered edge.
GREEN = np.array([0.055, 0.118, 0.028])
VEIN = np.array([0.235, 0.300, 0.120])
FRESH = np.array([0.150, 0.240, 0.045])
WITHERED = np.array([0.240, 0.190, 0.060])
YOUTH = (0.0, 0.15, 0.05, 0.4, 0.1, 0.0, 0.75, 0.2)  # chosen: how young each leaf is
AGE = (0.0, 0.0, 0.45, 0.0, 0.1, 0.65, 0.0, 0.2)  # chosen: how far each has withered at its edge


def reach(turn: np.ndarray, lobes: tuple[tuple[float, float, float], ...]) -> np.ndarray:
    """Return how far a leaf reaches from its stalk at angles from its tip, radians."""
    out = np.full(turn.shape, CORE)
    for angle, length, half in lobes:
        off = np.abs((turn - np.radians(angle) + np.pi) % (2 * np.pi) - np.pi) / np.radians(half)
        out = np.maximum(out, length * np.exp(-np.log(1.0 + 0.62 * off * (1.0 + 0.8 * off))))
    notch = np.clip((np.abs(turn) - np.radians(150.0)) / np.radians(30.0), 0.0, 1.0)
    return np.asarray(out * (1.0 - 0.55 * notch))


def vein(
    u: np.ndarray, v: np.ndarray, angle: float, length: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return how far places u (to the tip), v lie along a lobe's vein, 0..1, and beside it."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    along = (u * c + v * s) / length
    return np.clip(along, 0.0, 1.0), np.where(along > 0, np.abs(v * c - u * s), 1.0)


def leaf(number: int) -> np.ndarray:
    """Return one leaf with its tip up, uint8 (CELL, CELL, 4)."""
    size = CELL * SCALE
    axis = (np.arange(size) + 0.5) / size
    x, y = np.meshgrid(axis, axis[::-1])
    grain = spectral_noise(size, 1.3, 900 + number, low_cut=4.0)
    v, u = x - STALK[0], y - STALK[1]
    v = v + 0.05 * (u - 0.1) ** 2 * (-1) ** number  # no leaf is quite symmetrical
    lobes = LOBES[number]
    turn, away = np.arctan2(v, u), np.hypot(u, v)
    inside = 0.92 * reach(turn, lobes) - away + 0.004 * grain
    cover = smoothstep(-1.2 / size, 1.2 / size, inside)

    # Veins thin out towards the tip; the blade bulges between them.
    line, bulge = np.zeros(x.shape), np.full(x.shape, 1.0)
    for k, (angle, length, _) in enumerate(lobes):
        along, beside = vein(u, v, angle, length)
        width = (0.011 if k == 0 else 0.008) * (1.0 - 0.75 * along)
        line = np.maximum(line, np.clip(1.4 - beside / width, 0.0, 1.0) * (1.0 - 0.5 * along))
        bulge = np.minimum(bulge, beside)
    along, beside = vein(u, v, 0.0, 0.6)
    fork = np.abs((along * 5.0 - 3.4 * beside) % 1.0 - 0.5)
    thin = np.clip(1.0 - (0.5 - fork) / 0.05, 0.0, 1.0) * np.clip(1.0 - beside / 0.2, 0.0, 1.0)
    line = np.maximum(line, 0.40 * thin * (along > 0.05))

    high = np.sqrt(np.clip(bulge / 0.10, 0.0, 1.0)) + 0.05 * grain
    slope_y, slope_x = np.gradient(high, 1.0 / size)
    light = 1.0 + np.clip(0.012 * (-slope_x - slope_y), -0.22, 0.28) + 0.10 * np.sign(v) * cover
    edge = np.clip(1.0 - inside / 0.05, 0.0, 1.0)
    young, old = YOUTH[number], AGE[number]
    colour = (1.0 - young) * GREEN + young * FRESH
    colour = colour * (1.0 + 0.05 * grain + 0.25 * (away / 0.6 - 0.4))[..., None]
    dry = np.clip(old * (1.6 * edge + 0.5 * grain - 0.2), 0.0, 0.9)[..., None]
    colour = colour + dry * (WITHERED - colour)
    colour = colour + (0.75 * line * (1.0 - 0.4 * young))[..., None] * (VEIN - colour)
    colour = colour * (light * (1.0 - 0.22 * edge))[..., None]

    return cut_out(shrink(np.dstack([np.maximum(colour, 0.0) * cover[..., None], cover]), SCALE))


def castle_ivy() -> np.ndarray:
    """Return the sheet, uint8 (256, 512, 4): two rows of four leaves, tips up."""
    rows = [[leaf(COLUMNS * row + column) for column in range(COLUMNS)] for row in range(ROWS)]
    return bleed(np.vstack([np.hstack(row) for row in rows]))


ASSETS: dict[str, Callable[[], np.ndarray]] = {"castle_ivy.png": castle_ivy}
