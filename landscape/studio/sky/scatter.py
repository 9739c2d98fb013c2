"""Where clouds are: random places that suit them, at a distance from each other."""

from collections.abc import Callable, Iterator

import numpy as np

from landscape.studio.images import spectral_noise
from landscape.studio.sky.cumulus import HALF

Place = tuple[float, float, float]  # x, z and width in metres
TRIES = 60  # chosen: a cloud for which so many places do not suit is left out


def coverage(seed: int) -> np.ndarray:
    """Return noise (256, 256) over the square in which clouds are: streets of them, and gaps."""
    return spectral_noise(256, 1.6, seed, low_cut=2.0)


def scattered(
    rng: np.random.Generator,
    cover: np.ndarray,
    widths: tuple[float, float],
    count: int,
    taken: list[Place],
    suits: Callable[[float, float, float, float], bool],
    room: Callable[[float], float],
) -> Iterator[Place]:
    """Yield up to ``count`` places of clouds, and add them to those that are ``taken``.

    ``widths`` are the least and the greatest, in metres. ``suits`` is asked with x, z, a width and
    what ``cover`` (256, 256) is there. Two clouds are farther apart than the sum of their widths,
    times what ``room`` returns for the width of the later one.
    """
    low, high = widths
    for _ in range(count):
        for _ in range(TRIES):
            x, z = rng.uniform(-HALF, HALF, 2)
            width = low * (high / low) ** rng.random()
            row, column = (int((at / HALF + 1) * 127.9) for at in (x, z))
            if not suits(x, z, width, cover[row, column]):
                continue
            apart = room(width)
            if all(np.hypot(x - a, z - b) > apart * (width + w) for a, b, w in taken):
                taken.append((x, z, width))
                yield x, z, width
                break
