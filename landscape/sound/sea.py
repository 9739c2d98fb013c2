"""The sea at its shores: noise whose loudness follows the waves that are drawn.

A breaking wave is a cloud of bubbles, each ringing at its own pitch, and so many that their sum is
noise that falls with frequency (Farnell, Designing Sound, 2010, chapter on water). Three bands of
one such noise are the thud of the breaker, its roar, and the hiss of the foam that runs up the
beach. Each piece of the shore sounds by itself: loud when the drawn swell is there
(elements/best/sea: :func:`foam.turns` says when), the hiss a little later than the thud. What is
heard is the sum over all pieces, in eight directions. No OpenGL here.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from landscape.elements.best.sea.foam import turns
from landscape.sound.signal import RATE, band, frequencies, shaped_noise

SECONDS = 13  # chosen: of the loop
BANDS = ((45.0, 260.0), (260.0, 1300.0), (1300.0, 7500.0))  # chosen: Hz of thud, roar and hiss
# Chosen: in relation to the roar. The thud is loud in watts and faint to the ear.
WEIGHTS = (0.75, 1.0, 0.42)
DIRECTIONS = 8  # in which shores are heard apart
NEAR = 0.35  # chosen: units away at which a shore is half as loud as at one's feet
CARRIES = (4.5, 2.6, 1.3)  # chosen: units in which the air takes each band down to 1 / e
LATE = (0.0, 0.35, 1.0)  # chosen: radians of the swell by which a band follows the crest
PEAKED = (2.6, 1.8, 1.1)  # chosen: how much a crest stands out; exp(PEAKED (cos - 1))
MURMUR = (0.02, 0.05, 0.06)  # chosen: what is always heard of each band, in relation to a crest
CELL = 0.3  # chosen: units; pieces of the shore are put together in squares of this side

Swell = Callable[[np.ndarray, np.ndarray, float], np.ndarray]
"""From places x, z (n,) and kt to the swell's angle there in radians, 0 where a crest is ashore."""


def make_loops() -> np.ndarray:
    """Return the three bands of the sea's noise, (3, SECONDS * RATE), each of its weight."""
    samples = SECONDS * RATE
    f = frequencies(samples)
    pink = 1.0 / np.sqrt(np.maximum(f, 20.0))
    loops = [
        weight * shaped_noise(pink * band(f, *ends, 3.0), samples, 11 + k)
        for k, (ends, weight) in enumerate(zip(BANDS, WEIGHTS, strict=True))
    ]
    return np.stack(loops)


@dataclass(frozen=True)
class Shore:
    """Pieces of a shore: where they are, x and z (n, 2), and their lengths (n,), in units.

    ``level`` is the water's height; ``swell`` says when a wave runs ashore where; ``strength`` is
    how loud its waves are.
    """

    places: np.ndarray
    lengths: np.ndarray
    level: float
    swell: Swell
    strength: float = 1.0

    @cached_property
    def _x(self) -> np.ndarray:
        return np.ascontiguousarray(self.places[:, 0])

    @cached_property
    def _z(self) -> np.ndarray:
        return np.ascontiguousarray(self.places[:, 1])

    def loudness(self, x: float, y: float, z: float, kt: float) -> np.ndarray:
        """Return the amplitudes (DIRECTIONS, 3) of each band from each direction, at an ear.

        Direction 0 is north (-z), and on by the right. Intensities add up, not amplitudes: two
        breakers have nothing to do with each other.
        """
        east, south = self._x - x, self._z - z
        away = np.sqrt(east * east + south * south + (y - self.level) ** 2)
        angle = self.swell(self._x, self._z, kt)
        bearing = np.arctan2(east, -south)
        centres = 2.0 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
        # A partition of unity: what leaves one direction enters the next, without a step.
        apart = np.abs((bearing - centres[:, None] + np.pi) % (2.0 * np.pi) - np.pi)
        share = np.maximum(1.0 - apart * DIRECTIONS / (2.0 * np.pi), 0.0)
        share = share / np.maximum(share.sum(axis=0), 1e-9)

        spread = self.lengths / np.square(1.0 + away / NEAR)
        heard = np.empty((DIRECTIONS, len(BANDS)))
        for k in range(len(BANDS)):
            crest = np.exp(PEAKED[k] * (np.cos(angle - LATE[k]) - 1.0))
            wave = MURMUR[k] + (1.0 - MURMUR[k]) * crest
            heard[:, k] = share @ (spread * np.exp(-2.0 * away / CARRIES[k]) * np.square(wave))
        return self.strength * np.sqrt(heard)


def drawn_swell(x: np.ndarray, z: np.ndarray, kt: float) -> np.ndarray:
    """Return the angle of the swell that the foam of ``best`` draws."""
    return np.asarray(-turns(x, z, kt))


def gathered(
    places: np.ndarray, lengths: np.ndarray, level: float, swell: Swell, strength: float
) -> Shore:
    """Return a shore whose pieces (n, 2) with ``lengths`` (n,) are put together in squares."""
    if not len(places):
        return Shore(np.zeros((0, 2)), np.zeros(0), level, swell, strength)
    cells = np.floor(places / CELL).astype(np.int64)
    _, number = np.unique(cells, axis=0, return_inverse=True)
    number = number.ravel()
    total = np.bincount(number, lengths)
    middle = np.stack([np.bincount(number, lengths * side) for side in places.T], axis=1)
    return Shore(middle / np.maximum(total, 1e-12)[:, None], total, level, swell, strength)
