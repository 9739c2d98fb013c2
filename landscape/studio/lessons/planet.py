"""The map of a planet that has never been: sea, land, ice and clouds, for the textured sphere.

It is computed on the sphere, in three dimensions, so it has neither a seam nor pinched poles.
"""

import numpy as np


def waves(
    points: np.ndarray,
    seed: int,
    count: int,
    low: float = 1.2,
    high: float = 40.0,
    falloff: float = 1.25,
) -> np.ndarray:
    """Return noise at points (..., 3), mean 0 and standard deviation 1: a sum of plane waves.

    ``low`` and ``high`` are the wave numbers, in radians for each unit; the amplitude is the wave
    number to the power of ``-falloff``.
    """
    rng = np.random.default_rng(seed)
    numbers = np.exp(rng.uniform(np.log(low), np.log(high), count))
    ways = rng.normal(size=(count, 3))
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    phases = rng.uniform(0, 2 * np.pi, count)
    found = np.zeros(points.shape[:-1])
    for number, way, phase in zip(numbers, ways, phases, strict=True):
        found += number**-falloff * np.cos(number * (points @ way) + phase)
    return np.asarray((found - found.mean()) / found.std())


def mix(
    first: np.ndarray | tuple[int, ...], second: tuple[int, ...], part: np.ndarray
) -> np.ndarray:
    """Blend colours (..., 3): ``part`` of the second, from 0 to 1."""
    part = np.clip(part, 0, 1)[..., None]
    return np.asarray(np.array(first) * (1 - part) + np.array(second) * part)


def planet(height: int = 512) -> np.ndarray:
    """Return the map, uint8 (height, 2 * height, 3): longitude to the right, north at the top.

    The default height is twice that of the lesson's picture.
    """
    width = 2 * height
    latitude = (0.5 - (np.arange(height) + 0.5) / height) * np.pi
    longitude = (np.arange(width) + 0.5) / width * 2 * np.pi
    north, east = np.meshgrid(latitude, longitude, indexing="ij")
    points = np.stack(
        [np.cos(north) * np.cos(east), np.sin(north), np.cos(north) * np.sin(east)], -1
    )
    bent = np.stack([waves(points, seed, 120) for seed in (1, 2, 3)], -1)
    land = waves(points + 0.09 * bent, 7, 320, low=1.6, high=60) - 0.15
    fine = waves(points, 9, 200, low=20, high=120, falloff=0.6)
    cold = np.abs(north) / (np.pi / 2) + 0.05 * waves(points, 12, 120, low=3, high=30)
    cover = waves(points * [1, 1.7, 1] + 0.12 * bent, 21, 300, low=2.5, high=60, falloff=1.15)

    sea = mix((22, 52, 92), (64, 142, 158), (land + 1.1) / 1.05)
    sea = mix(sea, (96, 176, 172), (land + 0.12) / 0.12)
    earth = mix((214, 190, 132), (92, 138, 74), land / 0.25)
    desert = np.clip(0.42 - np.abs(cold - 0.27) * 3.2, 0, 1) * 1.6 * (land < 0.9)
    earth = mix(earth, (170, 128, 84), desert)
    earth = mix(earth, (60, 104, 62), np.clip(1 - np.abs(cold - 0.06) * 8, 0, 1) * 0.8)
    earth = mix(earth, (128, 112, 98), (land - 0.8) / 0.6)
    earth = mix(earth, (240, 240, 240), (land - 1.5) / 0.4)
    colours = np.where((land > 0)[..., None], earth * (1 + 0.07 * fine[..., None]), sea)
    colours = mix(colours, (236, 243, 247), (cold - 0.8) / 0.05)
    colours = mix(colours, (250, 250, 250), np.clip((cover - 0.75) / 1.2, 0, 0.85))
    return np.clip(colours, 0, 255).astype(np.uint8)
