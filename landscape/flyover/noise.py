"""Seamless noise: random waves with a spectrum that falls off, the sum of all sizes of grain."""

import numpy as np


def noise(
    size: int, seed: int, slope: float, coarsest: float = 1.0, finest: float = 1e9
) -> np.ndarray:
    """Return noise that repeats without a seam, (size, size) float32, mean 0 and deviation 1.

    The amplitude of waves of k periods falls as k to the power of -``slope``; there are none below
    ``coarsest`` or above ``finest`` periods.
    """
    generator = np.random.default_rng(seed)
    rows, columns = np.fft.fftfreq(size)[:, None] * size, np.fft.rfftfreq(size)[None] * size
    periods = np.hypot(rows, columns)
    weight = np.where((periods >= coarsest) & (periods <= finest), periods, np.inf) ** -slope
    phases = generator.random(weight.shape) * 2j * np.pi
    waves = np.fft.irfft2(weight * np.exp(phases), (size, size))
    # Where the picture is too small for any of the waves, there is none.
    return np.asarray(waves / (waves.std() or 1), np.float32)
