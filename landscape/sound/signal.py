"""Signals made in the frequency domain: noise of any colour as a loop, room echoes, levels.

A loop that is made as a spectrum is periodic by construction: it has no seam. All is mono float64,
``RATE`` samples per second, unless a function says otherwise.
"""

import math

import numpy as np

RATE = 48_000  # samples per second, as sound cards and AAC take them
QUANTUM = 480  # samples that are mixed at a time: 10 ms


def frequencies(samples: int) -> np.ndarray:
    """Return the frequencies in Hz of the spectrum (samples // 2 + 1,) of a signal."""
    return np.fft.rfftfreq(samples, 1.0 / RATE)


def shaped_noise(weights: np.ndarray, samples: int, seed: int) -> np.ndarray:
    """Return a loop of noise (samples,) with the magnitudes ``weights``; its RMS is 1.

    ``weights`` (samples // 2 + 1,) are by :func:`frequencies`. Nothing is left at 0 Hz.
    """
    rng = np.random.default_rng(seed)
    count = samples // 2 + 1
    spectrum = weights * (rng.standard_normal(count) + 1j * rng.standard_normal(count))
    spectrum[0] = 0.0
    loop = np.fft.irfft(spectrum, samples)
    return loop / max(rms(loop), 1e-12)


def rms(signal: np.ndarray) -> float:
    """Return the root of the mean square of a signal of any shape."""
    return math.sqrt(float(np.mean(np.square(signal, dtype=np.float64))))


def band(frequency: np.ndarray, low: float, high: float, slope: float = 4.0) -> np.ndarray:
    """Return the magnitudes of a band from ``low`` to ``high`` Hz, 1 within it, (n,).

    Below and above it falls by ``slope`` powers of the frequency, as a Butterworth filter does.
    """
    ratio = np.maximum(frequency, 1e-3)
    rises = 1.0 / np.sqrt(1.0 + (low / ratio) ** (2 * slope))
    return np.asarray(rises / np.sqrt(1.0 + (ratio / high) ** (2 * slope)))


def resonance(frequency: np.ndarray, centre: float, width: float) -> np.ndarray:
    """Return the magnitudes of a resonance at ``centre`` Hz, (n,): a Cauchy peak of half-width."""
    return np.asarray(1.0 / (1.0 + np.square((frequency - centre) / width)))


def filtered(signal: np.ndarray, low: float, high: float, slope: float = 4.0) -> np.ndarray:
    """Return a signal (n,) with what lies outside a band removed; it ends as it began."""
    weights = band(frequencies(len(signal)), low, high, slope)
    return np.fft.irfft(np.fft.rfft(signal) * weights, len(signal))


def convolved(loop: np.ndarray, echo: np.ndarray) -> np.ndarray:
    """Return a loop (n,) heard by way of an ``echo`` (m,), m <= n: again a loop."""
    return np.fft.irfft(np.fft.rfft(loop) * np.fft.rfft(echo, len(loop)), len(loop))


def decibels(level: float) -> float:
    """Return a level, 1 for full scale, in dBFS."""
    return 20.0 * math.log10(max(level, 1e-12))


def amplitude(level_db: float) -> float:
    """Return the amplitude of a level in dBFS."""
    return float(10.0 ** (level_db / 20.0))
