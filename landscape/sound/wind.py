"""The wind: three resonances of noise that rise with the gusts which bend the grass.

Wind itself makes no sound; what it passes does. Behind a stalk or the rim of an ear vortices are
shed at a frequency in proportion to the wind's speed (Strouhal), so a stronger wind sounds higher.
Technique: white noise by way of three resonances at 300 to 900 Hz, as Farnell (Designing Sound,
2010) makes his wind; the higher ones grow with higher powers of the speed, and so the band seems to
drift upwards in a gust. A fourth band is the rustle of grass. The speed is that of the drawn gusts
(elements/best/meadow/gusts.py) and of the report's sway (geometry/wind.py) at either ear, so a gust
is heard to cross from one to the other. No OpenGL here.
"""

import math

import numpy as np

from landscape.elements.best.meadow.gusts import BEND, WAY, gusts
from landscape.geometry.wind import sway
from landscape.sound.signal import RATE, band, frequencies, resonance, shaped_noise

SECONDS = 11  # chosen: of the loop
# Chosen: centre and half-width in Hz of the resonances.
RESONANCES = ((300.0, 110.0), (520.0, 150.0), (860.0, 210.0))
RUSTLE = (2400.0, 6500.0)  # chosen: Hz
WEIGHTS = (1.0, 0.8, 0.6, 0.22)  # chosen: of the resonances and of the rustle, at full speed
POWERS = (1.5, 2.3, 3.4, 2.2)  # chosen: of the speed
APART = 0.3  # chosen: units from the head at which either ear meets the gusts
# Chosen: shares of the speed, 1 in the strongest gust.
CALM = 0.24
SWAYING = 0.16
GUSTING = 0.6

FROM = math.degrees(math.atan2(-WAY[0], WAY[1]))  # degrees, 0 north: where it blows from
LULL = 97.0  # chosen: kt; a slow swing of the whole wind, so that gusts are not all alike


def make_loops() -> np.ndarray:
    """Return the bands of the wind's noise, (4, SECONDS * RATE), each of its weight."""
    samples = SECONDS * RATE
    f = frequencies(samples)
    shapes = [resonance(f, *each) * band(f, 80.0, 3000.0) for each in RESONANCES]
    shapes.append(band(f, *RUSTLE, 3.0))
    loops = [
        weight * shaped_noise(shape, samples, 31 + k)
        for k, (shape, weight) in enumerate(zip(shapes, WEIGHTS, strict=True))
    ]
    return np.stack(loops)


def speed(kt: float, x: np.ndarray, z: np.ndarray, strength: float = 1.0) -> np.ndarray:
    """Return the wind's speed at places (n,), 0 to 1: as the grass bends at ``kt``.

    ``strength`` is the setting ``grass.gusts``; without gusts only the report's sway is left.
    """
    x, z = np.asarray(x, np.float64), np.asarray(z, np.float64)
    places = np.stack([x, np.zeros_like(x), z], axis=1)
    swaying = np.hypot(*sway(kt, places).T) / math.hypot(0.05, 0.03)
    bent = np.hypot(*gusts(kt, x.astype(np.float32), z.astype(np.float32), 1.0)) / BEND
    lull = 0.78 + 0.22 * np.sin(kt / LULL + 0.3 * x)
    share = GUSTING * min(strength, 1.5) * np.minimum(bent, 1.0)
    return np.asarray(np.minimum(lull * (CALM + SWAYING * swaying + share), 1.0))


def loudness(
    kt: float, x: float, z: float, yaw: float, strength: float, rustling: float
) -> np.ndarray:
    """Return the amplitudes (2, 4) of each band at the left and the right ear.

    ``yaw`` is in degrees; ``rustling`` is how much grass is around, 0 to 1.
    """
    right = math.cos(math.radians(yaw)), math.sin(math.radians(yaw))
    sides = np.array([-APART, APART])
    found = speed(kt, x + sides * right[0], z + sides * right[1], strength)
    heard = found[:, None] ** np.array(POWERS)
    heard[:, 3] *= rustling
    return np.asarray(heard)
