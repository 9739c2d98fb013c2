"""The mixer: from a score to samples. Nothing is remembered from one block to the next.

Sound is made in quanta of 10 ms, each from the score alone: bands of loops times their amplitudes,
which go in a straight line from the quantum's beginning to its end, and the short sounds that are
running. A block is cut out of quanta, so blocks of any size make the same sound. The limiter is a
curve and not a control loop: it, too, needs no memory. No OpenGL here.
"""

import numpy as np

from landscape.sound.score import Key, Score
from landscape.sound.signal import QUANTUM, amplitude
from landscape.sound.soundscape import Soundscape

MOST = amplitude(-1.0)  # no sample is above it: converters and AAC overshoot a little
KNEE = amplitude(-6.0)  # chosen: up to here nothing is changed
RAMP = (np.arange(QUANTUM, dtype=np.float32) / np.float32(QUANTUM))[None]


def mix(score: Score, begin: int, samples: int) -> np.ndarray:
    """Return ``samples`` of a score from sample ``begin`` on, float32 (samples, 2), in -1..1."""
    first, last = begin // QUANTUM, (begin + samples - 1) // QUANTUM
    quanta = [mix_quantum(score, quantum) for quantum in range(first, last + 1)]
    whole = np.concatenate(quanta) if quanta else np.zeros((0, 2), np.float32)
    start = begin - first * QUANTUM
    return whole[start : start + samples]


def mix_quantum(score: Score, quantum: int) -> np.ndarray:
    """Return one quantum of a score, float32 (QUANTUM, 2)."""
    total = np.zeros((2, QUANTUM), np.float32)
    volumes = []
    for soundscape in dict.fromkeys(
        key.soundscape for at in (quantum, quantum + 1) for key in score.around(at) or ()
    ):
        one, other = (amplitudes(score, at, soundscape) for at in (quantum, quantum + 1))
        add_loops(total, soundscape, quantum, one, other)
    for at in (quantum, quantum + 1):
        volumes.append(volume(score, at))
    add_events(total, score, quantum)
    loud = np.float32(volumes[0]) + RAMP * np.float32(volumes[1] - volumes[0])
    return np.ascontiguousarray(limited(total * loud).T)


def _share(keys: tuple[Key, Key], quantum: int) -> float:
    before, after = (key.quantum for key in keys)
    return min(max((quantum - before) / (after - before), 0.0), 1.0) if after > before else 0.0


def amplitudes(score: Score, quantum: int, soundscape: Soundscape) -> np.ndarray:
    """Return the amplitudes (rows, 2) of a soundscape's voices at the beginning of a quantum."""
    total = np.zeros((soundscape.rows, 2), np.float32)
    keys = score.around(quantum)
    if keys is None:
        return total
    share = np.float32(_share(keys, quantum))
    for key, weight in zip(keys, (1 - share, share), strict=True):
        if key.soundscape is soundscape:
            total += weight * key.table
    return total


def volume(score: Score, quantum: int) -> float:
    """Return the volume at the beginning of a quantum."""
    keys = score.around(quantum)
    if keys is None:
        return 0.0
    share = _share(keys, quantum)
    return (1.0 - share) * keys[0].volume + share * keys[1].volume


def add_loops(
    total: np.ndarray, soundscape: Soundscape, quantum: int, one: np.ndarray, other: np.ndarray
) -> None:
    """Add the loops of a soundscape to a quantum (2, QUANTUM), from amplitudes to amplitudes."""
    change = other - one
    heard = (one != 0.0).any(axis=1) | (other != 0.0).any(axis=1)
    for voice in soundscape.voices:
        if not heard[voice.rows].any():
            continue
        loop = soundscape.loop(voice)
        at = (quantum * QUANTUM + voice.offset) % (loop.shape[1] - QUANTUM)
        piece = loop[:, at : at + QUANTUM]
        total += one[voice.rows].T @ piece
        total += RAMP * (change[voice.rows].T @ piece)


def add_events(total: np.ndarray, score: Score, quantum: int) -> None:
    """Add the short sounds of a score that are running to a quantum (2, QUANTUM)."""
    begin = quantum * QUANTUM
    for event in score.events:
        since = begin - event.sample
        sound = event.soundscape.short(event.name)[event.variant]
        if since <= -QUANTUM or since >= len(sound):
            continue
        piece = sound[max(since, 0) : since + QUANTUM]
        at = max(-since, 0)
        total[:, at : at + len(piece)] += piece.T * np.array(event.sides, np.float32)[:, None]


def limited(samples: np.ndarray) -> np.ndarray:
    """Return samples of any shape bent so that none is above MOST; what is below KNEE stays.

    Above the knee it is a hyperbolic tangent, which goes on in the direction of the straight line:
    a bend would be heard as a new overtone.
    """
    loud = np.abs(samples)
    if not (loud > KNEE).any():
        return samples
    room = np.float32(MOST - KNEE)
    bent = np.float32(KNEE) + room * np.tanh((loud - np.float32(KNEE)) / room)
    return np.where(loud > KNEE, np.copysign(bent, samples), samples).astype(np.float32)
