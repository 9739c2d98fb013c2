"""A room: how long it rings, its echo, and the hall's own sounds.

Sabine (1898) found by ear and organ pipe that a room's reverberation time is 0.161 V / A: seconds
by cubic metres and square metres of perfect absorption. Late echoes are so many that they are
noise, which decays exponentially, higher frequencies sooner, as air and cloth swallow them. The
echo of a loop is a circular convolution, and so a loop again. No OpenGL here.
"""

from dataclasses import dataclass

import numpy as np

from landscape.sound.signal import (
    RATE,
    band,
    convolved,
    filtered,
    frequencies,
    rms,
    shaped_noise,
)
from landscape.sound.steps import bubble

LN_1000 = 6.9078  # of an amplitude: 60 dB
OCTAVES = (
    (60.0, 400.0, 1.0),
    (400.0, 2000.0, 0.8),
    (2000.0, 8000.0, 0.45),
)  # Hz; share of seconds
WET = 0.5  # chosen: energy of the echo in relation to what comes straight from a step nearby
TAIL = 2.4  # chosen: seconds of an echo that are kept
DROPS_SECONDS, DROPS = 23, 9  # chosen: of the loop of drops, and how many fall


@dataclass(frozen=True)
class Room:
    """A closed room by its volume in cubic metres, its walls in square metres, their absorption."""

    volume: float
    walls: float
    absorption: float

    @property
    def seconds(self) -> float:
        """The reverberation time: until an echo is down by 60 dB (Sabine)."""
        return 0.161 * self.volume / (self.walls * self.absorption)

    def echo(self, seed: int, seconds: float = TAIL) -> np.ndarray:
        """Return what is heard after a click, (seconds * RATE,), without what comes straight.

        Its energy is 1.
        """
        samples = int(seconds * RATE)
        time = np.arange(samples) / RATE
        rng = np.random.default_rng(seed)
        total = np.zeros(samples)
        for low, high, share in OCTAVES:
            noise = filtered(rng.standard_normal(samples), low, high, 2.0)
            total += noise * np.exp(-LN_1000 * time / (share * self.seconds))
        # The first echoes come from the walls nearby, and the last ones are not cut off.
        total *= np.minimum(time / 0.03, 1.0) * np.minimum((seconds - time) / 0.3, 1.0)
        return total / np.sqrt(np.square(total).sum())

    def ringing(self, dry: np.ndarray, seed: int) -> np.ndarray:
        """Return a short sound (n,) with its echo, (m, 2): the echo differs from ear to ear."""
        long = len(dry) + int(TAIL * RATE)
        padded = np.pad(dry, (0, long - len(dry)))
        sides = [padded + WET * convolved(padded, self.echo(seed + k)) for k in (0, 1)]
        return np.stack(sides, axis=1)


def make_drops(room: Room) -> np.ndarray:
    """Return a loop of drops that fall into a pool, with their echo, (1, n); its peak is 1."""
    rng = np.random.default_rng(71)
    samples = DROPS_SECONDS * RATE
    total = np.zeros(samples)
    times = (np.arange(DROPS) + rng.uniform(0.1, 0.9, DROPS)) / DROPS * DROPS_SECONDS
    for at in times:
        one = bubble(RATE // 4, 0.002, rng.uniform(900.0, 1500.0), rng.uniform(0.1, 0.3))
        two = bubble(RATE // 4, 0.05, rng.uniform(600.0, 900.0), 0.1)
        begin = int(at * RATE)
        where = (begin + np.arange(RATE // 4)) % samples
        total[where] += rng.uniform(0.4, 1.0) * (one + 0.4 * two)
    total = total + WET * convolved(total, room.echo(72))
    total = filtered(total, 200.0, 6000.0, 2.0)
    return (total / np.abs(total).max())[None]


def make_air(room: Room, fires: np.ndarray) -> np.ndarray:
    """Return the hall's air and the echo of its torches, (2, n): loops as long as ``fires``.

    The RMS of either is 1.

    ``fires`` (3, n) are the bands of a fire.
    """
    samples = fires.shape[1]
    f = frequencies(samples)
    air = shaped_noise(band(f, 35.0, 220.0, 2.0) / np.maximum(f, 30.0), samples, 73)
    # Many torches at once: the echoes of their crackles are a murmur.
    dry = fires[1:].sum(axis=0)
    shifts = np.random.default_rng(75).integers(samples, size=4)
    many = np.sum([np.roll(dry, shift) for shift in shifts], axis=0)
    crackling = convolved(many, room.echo(74))
    return np.stack([air, crackling / rms(crackling)])
