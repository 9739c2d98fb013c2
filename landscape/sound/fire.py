"""Fire: crackles over a hiss over a rumble.

Farnell's three parts (Designing Sound, 2010): the flame itself is a rumble below 100 Hz, as the
burning gas expands and the air flows in; steam and sap leave the wood with a hiss above 1 kHz; and
fibres that break crackle. Cracks come by chance and independent of each other, which is a Poisson
process: the times between two of them are exponentially distributed. No OpenGL here.
"""

import math

import numpy as np

from landscape.sound.signal import RATE, band, filtered, frequencies, rms, shaped_noise

SECONDS = 17  # chosen: of the loop
CRACKS = 11.0  # chosen: a second, in the mean
WEIGHTS = (0.3, 0.1, 3.0)  # chosen: of rumble, hiss and crackle
NEAR = 0.08  # chosen: units away at which a torch is half as loud
CARRIES = (0.7, 0.45, 0.55)  # chosen: units in which air and walls take each band down to 1 / e
FLICKER = 7.2  # kt, section 6.1: the light on the gate moves by cos(kt / 7.2)


def make_loops() -> np.ndarray:
    """Return rumble, hiss and crackle, (3, SECONDS * RATE), each of its weight."""
    samples = SECONDS * RATE
    f = frequencies(samples)
    rumble = shaped_noise(band(f, 25.0, 95.0, 3.0), samples, 51)
    slow = shaped_noise(band(f, 0.05, 2.5, 2.0), samples, 52)
    rumble = rumble * np.exp(0.35 * slow)
    hiss = shaped_noise(band(f, 1200.0, 7000.0, 2.0), samples, 53) * np.exp(0.4 * slow)
    parts = rumble / rms(rumble), hiss / rms(hiss), crackles(samples, 54)
    return np.stack([weight * part for weight, part in zip(WEIGHTS, parts, strict=True)])


def crackles(samples: int, seed: int) -> np.ndarray:
    """Return a loop (samples,) of cracks: bursts of noise of a few milliseconds, by chance.

    The loudest has a peak of 1: most of the time there is none, so an RMS would say little.
    """
    rng = np.random.default_rng(seed)
    loop = np.zeros(samples)
    for _ in range(rng.poisson(CRACKS * samples / RATE)):
        length = int(RATE * rng.uniform(0.004, 0.024))
        at = int(rng.integers(samples))
        decay = np.exp(-np.linspace(0.0, 6.0, length))
        crack = rng.standard_normal(length) * decay * min(rng.pareto(1.6) + 0.3, 1.3)
        where = (at + np.arange(length)) % samples
        loop[where] += crack
    loop = filtered(loop, 700.0, 3500.0, 2.0)
    return loop / np.abs(loop).max()


def loudness(away: float, kt: float, number: int) -> np.ndarray:
    """Return the amplitudes (3,) of the bands of a fire ``away`` units from the ear.

    ``number`` tells fires apart, so that they do not flicker together.
    """
    flicker = 0.85 + 0.15 * math.cos(kt / FLICKER + 2.4 * number)
    spread = 1.0 / (1.0 + away / NEAR)
    carried = np.exp(-away / np.array(CARRIES))
    return np.asarray(spread * carried * np.array([flicker, 1.0, 1.0]))
