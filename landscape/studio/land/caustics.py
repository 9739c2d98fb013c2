"""The caustics: the net of light on the bed of shallow water, as a film that never ends.

The water's surface is a sum of waves. Each has whole numbers of crests across the tile, along both
of its sides, and passes a whole number of them by in the time of the film: so the sum is periodic
in space and in time, and neither the tile nor the film shows a seam. Parallel light falls on it
from above, is refracted, and is gathered where it meets the bed: as many rays as four by four per
texel, each shared by the four texels around its place. Where the surface focuses the light, the
rays crowd along folds, which meet in cusps: that is the net. (A product of sines, often used in its
place, has no folds: it is a pattern of dots.)
"""

from collections.abc import Callable

import numpy as np
from scipy import ndimage

SIDE = 128  # texels of a frame; chosen
FRAMES = 32  # chosen
ACROSS = 8  # frames per row of the sheet; chosen
RAYS = 4  # per texel and axis; chosen
SEED = 26  # chosen: of the seeds tried, the most even net
CRESTS = (1.5, 6.5)  # chosen: least and greatest wave number, crests per tile
STEEPNESS = -1.6  # chosen: exponent of amplitude over wave number
FOCUS = 0.028  # chosen: root mean square of a ray's way sideways, in tiles: just past the focus
SOFT = 0.6  # chosen: texels of blur, for the breadth of the sun
MEAN = 0.45  # chosen: of all frames; a factor of 2 then makes lines bright, meshes a little dark
GAMMA = 0.55  # chosen: brings out the fainter lines
LEVELS = 32  # chosen: grey levels of the file; more would not be seen, and compress badly


def sea(seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return the waves: numbers along x and y, int (n,), passes per film, int (n,), and amplitudes.

    The last are complex: their angle is the phase. As in deep water, the frequency grows with the
    root of the wave number.
    """
    rng = np.random.default_rng(seed)
    most = int(CRESTS[1])
    k_x, k_y = (a.ravel() for a in np.meshgrid(*[np.arange(-most, most + 1)] * 2))
    number = np.hypot(k_x, k_y)
    kept = (number >= CRESTS[0]) & (number <= CRESTS[1])
    k_x = k_x[kept]
    k_y = k_y[kept]
    number = number[kept]
    passes = np.maximum(np.rint(0.8 * np.sqrt(number)), 1).astype(int)
    size = number**STEEPNESS * rng.rayleigh(size=len(number))
    return k_x, k_y, passes, size * np.exp(2j * np.pi * rng.random(len(number)))


def slopes(time: float, side: int, seed: int = SEED) -> np.ndarray:
    """Return the surface's slope along x and y, (2, side, side), at ``time`` in films."""
    k_x, k_y, passes, size = sea(seed)
    moved = size * np.exp(-2j * np.pi * passes * time)
    spectrum = np.zeros((2, side, side), complex)
    for axis, k in enumerate((k_x, k_y)):
        np.add.at(spectrum[axis], (k_y % side, k_x % side), 2j * np.pi * k * moved)
    return np.asarray(np.fft.ifft2(spectrum).real * side**2)


def gathered(places: np.ndarray, side: int) -> np.ndarray:
    """Return the light on a tile of ``side`` texels, mean 1, of rays at ``places`` (2, n).

    Places are in texels. A ray is shared by the four texels around it (bilinear).
    """
    low = np.floor(places)
    u, v = places - low
    x, y = low.astype(int)
    light = np.zeros(side * side)
    for dx, across in ((0, 1 - u), (1, u)):
        for dy, down in ((0, 1 - v), (1, v)):
            at = (y + dy) % side * side + (x + dx) % side
            light += np.bincount(at, across * down, side * side)
    return light.reshape(side, side) * side**2 / places.shape[1]


def light_on_bed(time: float, seed: int = SEED) -> np.ndarray:
    """Return the light on the bed (SIDE, SIDE), mean 1, at ``time`` in films."""
    fine = SIDE * RAYS
    # For small angles a ray goes sideways in proportion to the slope where it enters.
    first = slopes(0.0, fine, seed)
    sideways = slopes(time, fine, seed) * (FOCUS * SIDE / np.sqrt((first**2).sum(axis=0).mean()))
    start = (np.arange(fine) + 0.5) / RAYS - 0.5
    grid = np.stack(np.meshgrid(start, start))
    light = gathered((grid - sideways).reshape(2, -1), SIDE)
    return np.asarray(ndimage.gaussian_filter(light, SOFT, mode="wrap"))


def developed(light: np.ndarray) -> np.ndarray:
    """Return light as tones 0..1 of mean MEAN: what is brightest saturates, as on film."""
    low, high = 0.0, 20.0
    for _ in range(50):
        exposure = (low + high) / 2
        tones = 1.0 - np.exp(-((exposure * light) ** (2 * GAMMA)))
        low, high = (exposure, high) if tones.mean() < MEAN else (low, exposure)
    return np.asarray(tones)


def caustics() -> np.ndarray:
    """Return the film as a sheet, uint8 (512, 1024), in rows of ACROSS frames."""
    film = [developed(light_on_bed(k / FRAMES)) for k in range(FRAMES)]
    steps = np.rint(np.stack(film) * (LEVELS - 1)) * (255 / (LEVELS - 1))
    sheet = np.rint(steps).astype(np.uint8).reshape(-1, ACROSS, SIDE, SIDE)
    return np.ascontiguousarray(sheet.swapaxes(1, 2).reshape(-1, ACROSS * SIDE))


ASSETS: dict[str, Callable[[], np.ndarray]] = {"caustics.png": caustics}
