"""The score: what was heard when, from which the mixer makes sound.

A walk or a film adds what the ear meets at each of its frames. Between two frames amplitudes go
over into each other in a straight line, so there is no jump however far apart they are; what
happens between them (a foot comes down, a stroke begins, a block is dug) becomes an event at its
own sample. A score is plain data: the same frames make the same sound, to the bit. No OpenGL here.
"""

import math
from bisect import bisect_right
from dataclasses import dataclass, replace

import numpy as np

from landscape.sound.bank import DIG, PLACE, STROKE
from landscape.sound.signal import QUANTUM, RATE
from landscape.sound.soundscape import Ear, Soundscape

BOB = 6.0 * math.pi  # section 8.2: the head bobs by cos(step / 3)
LOW = 3.0 * math.pi  # step of the first low point: there a foot comes down
UNEVEN = 0.06  # chosen: strides by which a foot may come down earlier or later
MOST_AT_ONCE = 3  # chosen: of one sound between two frames; more would be noise
DUG_AHEAD = 0.9  # chosen: amplitude of a block within reach
SIDE = 25.0  # chosen: degrees to the left and to the right at which the feet are heard
LIGHTER = 0.75  # chosen: how loud every other thing is, in relation: nothing sounds twice the same


@dataclass(frozen=True)
class Heard:
    """The audible world at a moment: the listener's place and ears, and the walker's deeds.

    ``step`` and ``stroke`` are the walker's; ``dug`` and ``placed`` count blocks. ``volume`` is 0
    for silence, 1 for normal.
    """

    soundscape: Soundscape
    ear: Ear
    step: float = 0.0
    stroke: int = 0
    dug: int = 0
    placed: int = 0
    volume: float = 1.0


@dataclass(frozen=True)
class Key:
    """Amplitudes at the beginning of a quantum: the table of a soundscape, and the volume."""

    quantum: int
    soundscape: Soundscape
    table: np.ndarray
    volume: float


@dataclass(frozen=True)
class Event:
    """A short sound that begins at a sample: its name, variant, and amplitude at each ear."""

    sample: int
    name: str
    variant: int
    sides: tuple[float, float]
    soundscape: Soundscape


class Score:
    """Keys and events in the order of time; what is over may be forgotten."""

    def __init__(self) -> None:
        """Nothing has been heard yet."""
        self.keys: list[Key] = []
        self.events: list[Event] = []
        self.last: Heard | None = None

    def add(self, seconds: float, heard: Heard) -> None:
        """Add what is heard ``seconds`` after the beginning; later than what was added last."""
        quantum = round(seconds * RATE / QUANTUM)
        if self.keys and quantum <= self.keys[-1].quantum:
            if self.last is None or quantum < self.keys[-1].quantum:
                return
            self.keys.pop()
        table = heard.soundscape.heard(heard.ear)
        before = self.keys[-1].quantum if self.keys else quantum
        self.keys.append(Key(quantum, heard.soundscape, table, heard.volume))
        if self.last is not None and self.last.soundscape is heard.soundscape:
            self._happened(self.last, heard, before * QUANTUM, quantum * QUANTUM)
        self.last = heard

    def _happened(self, then: Heard, now: Heard, begin: int, end: int) -> None:
        """Add the events of the time between two moments, samples ``begin`` to ``end``."""
        for number in footfalls(then.step, now.step):
            share = (foot_down(number) - then.step) / (now.step - then.step)
            place = now.ear
            ground = now.soundscape.ground(place.x, place.y, place.z)
            side = math.radians(SIDE * (1 if number % 2 else -1))
            at = begin + round(min(max(share, 0.0), 1.0) * (end - begin))
            self._event(at, ground, number, now, side)
        if now.stroke == 1 and then.stroke != 1:
            self._event(end, STROKE, round(now.ear.kt), now, math.radians(20.0))
        for name, done in ((DIG, now.dug - then.dug), (PLACE, now.placed - then.placed)):
            for k in range(min(done, MOST_AT_ONCE)):
                at = end - (end - begin) * k // MOST_AT_ONCE
                self._event(at, name, now.dug + now.placed - k, now, 0.0)

    def _event(self, sample: int, name: str, number: int, heard: Heard, side: float) -> None:
        """Add an event; ``number`` chooses among the variants."""
        variants = len(heard.soundscape.short(name))
        # A large prime mixes the numbers: neighbours take variants that are not neighbours.
        mixed = (number * 7919 + 3) % 104_729
        loud = LIGHTER + (1.0 - LIGHTER) * (mixed % 97) / 96.0
        loud *= DUG_AHEAD if name in (DIG, PLACE) else 1.0
        angle = (math.sin(side) + 1.0) * math.pi / 4.0
        sides = math.sqrt(2.0) * loud * math.cos(angle), math.sqrt(2.0) * loud * math.sin(angle)
        self.events.append(Event(sample, name, mixed % variants, sides, heard.soundscape))

    def around(self, quantum: int) -> tuple[Key, Key] | None:
        """Return the keys before and after a quantum begins; the same twice at the ends."""
        if not self.keys:
            return None
        at = bisect_right(self.keys, quantum, key=lambda key: key.quantum)
        return self.keys[max(at - 1, 0)], self.keys[min(at, len(self.keys) - 1)]

    def forget(self, quantum: int) -> None:
        """Forget what is over before a quantum begins."""
        while len(self.keys) > 2 and self.keys[1].quantum < quantum:
            del self.keys[0]
        first = quantum * QUANTUM
        self.events = [
            each
            for each in self.events
            if each.sample + each.soundscape.short(each.name).shape[1] > first
        ]


def foot_down(number: int) -> float:
    """Return the step at which a foot comes down: near a low point, as nobody walks like a clock.

    Without it, steps on a level floor would be exactly as far apart as those of a machine.
    """
    # Squares of numbers, less multiples of a prime, are as irregular as this needs.
    uneven = number * number * 37 % 101 / 50.0 - 1.0
    return LOW + BOB * (number + UNEVEN * uneven)


def footfalls(before: float, after: float) -> list[int]:
    """Return the numbers of the feet that come down between two steps.

    None where the walker has not walked from one to the other but was put there.
    """
    if not 0.0 < after - before <= BOB * MOST_AT_ONCE:
        return []
    first, last = (math.floor((step - LOW) / BOB) for step in (before, after))
    near = range(first - 1, last + 3)
    return [number for number in near if before < foot_down(number) <= after]


KEYS_PER_SECOND = 25  # chosen: of one who stands still; waves and gusts are slower


def standing(
    soundscape: Soundscape, ear: Ear, seconds: float, kt_per_second: float, volume: float = 1.0
) -> Score:
    """Return the score of one who stands and listens for so many seconds, from the ear's kt on."""
    score = Score()
    for k in range(math.ceil(seconds * KEYS_PER_SECOND) + 1):
        since = k / KEYS_PER_SECOND
        now = replace(ear, kt=ear.kt + since * kt_per_second)
        score.add(since, Heard(soundscape, now, volume=volume))
    return score
