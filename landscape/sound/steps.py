"""The walker's short sounds: a step, a stroke of the sword, a block dug or placed.

A step is no sample but a crowd of grains: P. Cook (Modeling Bill's Gait, 2002, by the statistics of
his PhISEM, 1997) made the sound of walking from many small collisions at random times, whose
density decays after heel and toe have come down. What the grains sound like says on what one walks:
sand hisses softly, grass higher, stone knocks low with a click, and water is bubbles, each a sine
whose pitch rises as it nears the surface (van den Doel, Physically Based Models for Liquid Sounds,
2005). No OpenGL here.
"""

import numpy as np

from landscape.sound.signal import RATE, band, filtered, frequencies, shaped_noise

SAND, GRASS, STONE, WATER = "sand", "grass", "stone", "water"
GROUNDS = (SAND, GRASS, STONE, WATER)
VARIANTS = 8  # chosen: of each sound; no two steps in a row are alike
LENGTH = 0.42  # chosen: seconds
TOE = 0.095  # chosen: seconds after the heel
PEAK = 0.19  # chosen: -14 dBFS, the loudest of a step, and of the others

# Chosen: the band in Hz of the grains of each ground, how many, their decay in seconds, how long
# the crowd lasts, and the peak in relation to PEAK.
GRAINS = {
    SAND: ((1000.0, 3000.0), 60, 0.009, 0.075, 0.42),
    GRASS: ((2000.0, 6000.0), 45, 0.005, 0.060, 0.3),
    STONE: ((200.0, 800.0), 22, 0.007, 0.018, 0.8),
}


def step(ground: str, seed: int) -> np.ndarray:
    """Return a step on one of GROUNDS, (LENGTH * RATE,)."""
    rng = np.random.default_rng(seed)
    samples = int(LENGTH * RATE)
    if ground == WATER:
        return levelled(bubbles(rng, samples, 26, 0.16) + wash(rng, samples), 0.75)

    ends, count, decay, lasts, peak = GRAINS[ground]
    heel = rng.uniform(0.95, 1.05), 0.005
    toe = rng.uniform(0.5, 0.7), TOE * rng.uniform(0.9, 1.12)
    signal = np.zeros(samples)
    for strength, at in (heel, toe):
        signal += strength * crowd(rng, samples, at, count, decay, lasts)
        if ground == STONE:
            signal += 2.6 * strength * click(samples, at, rng.uniform(900.0, 1300.0))
    return levelled(filtered(signal, *ends, 2.0), peak)


def crowd(
    rng: np.random.Generator, samples: int, at: float, count: int, decay: float, lasts: float
) -> np.ndarray:
    """Return ``count`` grains (samples,) after ``at`` seconds, ever fewer and fainter.

    A grain is noise that decays in ``decay`` seconds; in ``lasts`` the density falls to 1 / e.
    """
    signal = np.zeros(samples)
    length = int(5 * decay * RATE)
    envelope = np.exp(-np.arange(length) / (decay * RATE))
    for delay in np.minimum(rng.exponential(lasts, count), 0.2):
        begin = int((at + delay) * RATE)
        grain = rng.standard_normal(length) * envelope * rng.uniform(0.3, 1.0)
        end = min(begin + length, samples)
        signal[begin:end] += grain[: end - begin] * np.exp(-delay / (2 * lasts))
    return signal


def click(samples: int, at: float, pitch: float) -> np.ndarray:
    """Return the click of a heel on stone (samples,): a mode of ``pitch`` Hz, gone in 4 ms."""
    time = np.arange(samples) / RATE - at
    ringing = np.sin(2.0 * np.pi * pitch * time) * np.exp(-np.maximum(time, 0.0) / 0.004)
    return np.where(time >= 0.0, ringing, 0.0)


def bubble(samples: int, at: float, pitch: float, rise: float) -> np.ndarray:
    """Return a bubble (samples,) that begins at ``pitch`` Hz and rises, as van den Doel has it.

    Its radius is 3 m/s over the pitch (Minnaert); the damping is 0.13 / r + 0.0072 r^-1.5.
    """
    radius = 3.0 / pitch
    damping = 0.13 / radius + 0.0072 * radius**-1.5
    time = np.maximum(np.arange(samples) / RATE - at, 0.0)
    phase = 2.0 * np.pi * pitch * (time + 0.5 * rise * damping * np.square(time))
    return np.sin(phase) * np.exp(-damping * time)


def bubbles(rng: np.random.Generator, samples: int, count: int, lasts: float) -> np.ndarray:
    """Return ``count`` bubbles (samples,) of 500 to 1500 Hz, most of them at the beginning."""
    signal = np.zeros(samples)
    for _ in range(count):
        at = min(rng.exponential(lasts / 2), lasts * 1.6)
        pitch = 500.0 * 3.0 ** rng.uniform(0.0, 1.0)
        signal += rng.uniform(0.2, 1.0) * bubble(samples, at, pitch, rng.uniform(0.05, 0.25))
    return signal


def wash(rng: np.random.Generator, samples: int) -> np.ndarray:
    """Return the splash around the bubbles (samples,)."""
    noise = filtered(rng.standard_normal(samples), 400.0, 2200.0, 2.0)
    time = np.arange(samples) / RATE
    return 1.6 * noise * np.minimum(time / 0.02, 1.0) * np.exp(-time / 0.09)


def stroke(seed: int) -> np.ndarray:
    """Return a stroke of the sword, (LENGTH * RATE,): vortices behind the blade.

    Their frequency is 0.2 v / d (Strouhal), so the pitch rises and falls with the blade's speed.
    Technique: narrow noise around 0 Hz, moved to that pitch by two carriers.
    """
    samples = int(LENGTH * RATE)
    time = np.arange(samples) / RATE
    speed = np.exp(-np.square((time - 0.15) / 0.07))
    pitch = 260.0 + 900.0 * speed
    phase = 2.0 * np.pi * np.cumsum(pitch) / RATE
    weights = band(frequencies(samples), 5.0, 180.0, 2.0)
    one, other = (shaped_noise(weights, samples, seed + k) for k in (0, 77))
    return levelled((one * np.cos(phase) + other * np.sin(phase)) * speed**1.5, 0.55)


def dug(seed: int) -> np.ndarray:
    """Return a block that is dug, (LENGTH * RATE,): a thud, and what crumbles."""
    rng = np.random.default_rng(seed)
    samples = int(LENGTH * RATE)
    crumbs = crowd(rng, samples, 0.01, 50, 0.006, 0.09)
    thud = knock(samples, (95.0, 160.0), 0.05, rng)
    return levelled(filtered(crumbs, 300.0, 2400.0, 2.0) / 0.6 + 1.4 * thud, 0.9)


def placed(seed: int) -> np.ndarray:
    """Return a block that is placed, (LENGTH * RATE,): a knock of three modes, and a click."""
    rng = np.random.default_rng(seed)
    samples = int(LENGTH * RATE)
    body = knock(samples, (170.0, 310.0, 520.0), 0.035, rng)
    return levelled(body + 0.4 * click(samples, 0.004, 1100.0), 0.9)


def knock(
    samples: int, pitches: tuple[float, ...], decay: float, rng: np.random.Generator
) -> np.ndarray:
    """Return modes (samples,) that ring at ``pitches`` Hz and decay, the higher the sooner."""
    time = np.maximum(np.arange(samples) / RATE - 0.004, 0.0)
    signal = np.zeros(samples)
    for k, pitch in enumerate(pitches):
        tuned = pitch * rng.uniform(0.94, 1.06)
        signal += np.sin(2 * np.pi * tuned * time) * np.exp(-time * (1 + k) / decay) / (1 + k)
    return signal


def levelled(signal: np.ndarray, peak: float) -> np.ndarray:
    """Return a signal (n,) with its peak at ``peak`` times PEAK, without DC, faded at both ends."""
    signal = filtered(signal, 40.0, 12_000.0, 2.0)
    ramp = np.minimum(np.arange(len(signal)) / (0.002 * RATE), 1.0)
    end = np.minimum(np.arange(len(signal))[::-1] / (0.06 * RATE), 1.0)
    signal = signal * ramp * end * end
    return signal * (PEAK * peak / max(float(np.abs(signal).max()), 1e-12))
