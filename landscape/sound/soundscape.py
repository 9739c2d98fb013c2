"""The sources of sound around a place: shores, fires, wind, the ground underfoot, a room.

A scene makes a :class:`Soundscape` of its settings and its terrain (``SceneOf.sounds``), and from
then on what is heard depends on the ear and on kt alone. It is a table of amplitudes: a row for
each band of each voice, a column for each ear. No OpenGL here.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from landscape.sound import bank as sounds
from landscape.sound import fire, sea, wind
from landscape.sound.room import Room
from landscape.sound.sea import Shore
from landscape.sound.signal import RATE
from landscape.sound.steps import GRASS, GROUNDS, STONE

SILENT = 1e-5  # chosen: an amplitude below it, -100 dB, is none
MUFFLED = (0.8, 0.12, 0.01)  # chosen: what is left of bands, from low to high, under water
DEEP = 0.05  # chosen: units below the surface at which that is reached
BEHIND = 0.25  # chosen: by how much the highest band is fainter from behind the ear
# Chosen: how loud each is, in relation to a shore at one's feet.
SEA_LEVEL = 1.9
WIND_LEVEL = 0.7
FIRE_LEVEL = 1.8
AIR_LEVEL = 0.07
ECHO_LEVEL = 0.11
DROPS_LEVEL = 0.9

HIGH = 4.0  # chosen: units above the sea at which nothing shelters from the wind
SHELTERED = 0.45  # chosen: the wind's share at the height of the sea
FLAPPING = 1.25  # chosen: the most that height adds
AROUND = 0.25  # chosen: below this share of its power on one side, the sea is all around


def _grass(x: float, y: float, z: float) -> str:
    return GRASS


@dataclass(frozen=True)
class Ear:
    """Where one hears from: x, y, z in units, yaw in degrees as of a pose; and kt."""

    x: float
    y: float
    z: float
    yaw: float
    kt: float


@dataclass(frozen=True)
class Voice:
    """A loop that is heard from one place: its name, where in it the voice begins, and its rows."""

    loop: str
    offset: int
    rows: slice


@dataclass(frozen=True)
class Source:
    """A sound by its name: how loud it is, and how many degrees to the right (None: all around)."""

    name: str
    loudness: float
    relative: float | None


@dataclass(frozen=True, eq=False)
class Soundscape:
    """The sources of sound in a scene; compared by identity.

    ``fires`` (n, 3) are x, y, z of flames in units; ``windy`` is the wind's strength, 0 for none,
    and ``gusts`` the setting of that name. ``ground`` returns which of steps.GROUNDS is under the
    feet, from x, z and the eye's y. ``room`` is the closed room that all of it is in.
    """

    shore: Shore | None = None
    fires: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))
    windy: float = 1.0
    gusts: float = 1.0
    level: float = 0.0
    ground: Callable[[float, float, float], str] = _grass
    grounds: tuple[str, ...] = GROUNDS
    blocks: bool = False
    room: Room | None = None
    drops: np.ndarray | None = None

    def loop(self, voice: Voice) -> np.ndarray:
        """Return the loop of a voice, float32 (rows, samples + QUANTUM)."""
        return sounds.loop(voice.loop, None if voice.loop in sounds.OPEN else self.room)

    def short(self, name: str) -> np.ndarray:
        """Return the variants of a short sound, float32 (k, samples, 2)."""
        return sounds.short(name, self.room)

    def prepare(self, stopped: Callable[[], bool] = lambda: False) -> None:
        """Make or read all that may be heard: the first time it takes a second or two.

        No more is made once it is ``stopped``.
        """
        for voice in self.voices:
            if stopped():
                return
            self.loop(voice)
        for name in (*self.grounds, sounds.STROKE, *((sounds.DIG, sounds.PLACE) * self.blocks)):
            if stopped():
                return
            self.short(name)

    @cached_property
    def voices(self) -> tuple[Voice, ...]:
        """The voices in the order of their rows."""
        wanted: list[tuple[str, int, int]] = []
        if self.shore is not None:
            # Far from each other in the loop: the same noise from all sides would sound near.
            step = sea.SECONDS * RATE // sea.DIRECTIONS
            wanted += [(sounds.SEA, k * step, 3) for k in range(sea.DIRECTIONS)]
        if self.windy > 0.0 and self.room is None:
            wanted += [(sounds.WIND, k * wind.SECONDS * RATE // 2, 4) for k in (0, 1)]
        apart = fire.SECONDS * RATE / max(len(self.fires), 1)
        wanted += [(sounds.FIRE, int(k * apart), 3) for k in range(len(self.fires))]
        if self.drops is not None:
            wanted.append((sounds.DROPS, 0, 1))
        if self.room is not None:
            wanted += [(sounds.AIR, k * fire.SECONDS * RATE // 2, 2) for k in (0, 1)]

        voices, row = [], 0
        for loop, offset, rows in wanted:
            voices.append(Voice(loop, offset, slice(row, row + rows)))
            row += rows
        return tuple(voices)

    @property
    def rows(self) -> int:
        """The number of rows of the table."""
        return self.voices[-1].rows.stop if self.voices else 0

    def heard(self, ear: Ear) -> np.ndarray:
        """Return the amplitudes, float32 (rows, 2), of each band of each voice at both ears."""
        parts: list[np.ndarray] = []
        if self.shore is not None:
            parts.append(self._sea(ear, self.shore))
        if self.windy > 0.0 and self.room is None:
            parts.append(self._wind(ear))
        parts += [self._fire(ear, k) for k in range(len(self.fires))]

        if self.drops is not None:
            away, relative = _seen_from(ear, self.drops)
            sides = pan(relative, spread=min(away / 0.2, 1.0))
            parts.append(DROPS_LEVEL / (1.0 + away / 0.6) * sides[None])

        if self.room is not None:
            parts.append(self._air())

        if not parts:
            return np.zeros((0, 2), np.float32)
        table = np.concatenate(parts)
        table[table < SILENT] = 0.0
        return table.astype(np.float32)

    def sources(self, ear: Ear) -> list[Source]:
        """Return what an ear hears by name, the loudest of each kind: see :class:`Source`."""
        table = self.heard(ear).astype(np.float64)
        found: dict[str, list[tuple[float, float | None]]] = {}
        number = 0
        for k, voice in enumerate(self.voices):
            loud = math.sqrt(float(np.square(table[voice.rows]).sum()))
            bearing: float | None = None
            if voice.loop == sounds.SEA:
                bearing = 360.0 * k / sea.DIRECTIONS
            elif voice.loop == sounds.WIND:
                bearing = wind.FROM
            elif voice.loop == sounds.FIRE:
                bearing = _bearing(ear, self.fires[number])
                number += 1
            elif self.drops is not None and voice.loop == sounds.DROPS:
                bearing = _bearing(ear, self.drops)
            if voice.loop != sounds.AIR:
                found.setdefault(voice.loop, []).append((loud, bearing))

        sources = []
        for name, parts in found.items():
            total = math.sqrt(sum(loud * loud for loud, _ in parts))
            _, bearing = max(parts, key=lambda part: part[0])
            if name == sounds.SEA:
                bearing = _mean_bearing(parts)
            relative = None if bearing is None else (bearing - ear.yaw) % 360.0
            sources.append(Source(name, total, relative))
        return sorted(sources, key=lambda source: -source.loudness)

    def _sea(self, ear: Ear, shore: Shore) -> np.ndarray:
        loud = SEA_LEVEL * shore.loudness(ear.x, ear.y, ear.z, ear.kt) * self._muffled(ear)
        sides = np.empty((sea.DIRECTIONS, 3, 2))
        for k in range(sea.DIRECTIONS):
            relative = 360.0 * k / sea.DIRECTIONS - ear.yaw
            sides[k] = pan(relative) * shaded(relative)[:, None]
        return np.asarray((loud[..., None] * sides).reshape(-1, 2))

    def _wind(self, ear: Ear) -> np.ndarray:
        over = max(ear.y - self.level, 0.0)
        exposed = min(SHELTERED + (1.0 - SHELTERED) * over / HIGH, FLAPPING)
        rustling = 1.0 if self.ground(ear.x, ear.y, ear.z) == GRASS else 0.15
        rustling /= 1.0 + over / HIGH
        loud = wind.loudness(ear.kt, ear.x, ear.z, ear.yaw, self.gusts, rustling)
        dry = self._muffled(ear)
        loud = WIND_LEVEL * self.windy * exposed * loud * dry[[0, 1, 2, 2]]
        table = np.zeros((2, 4, 2))
        table[0, :, 0], table[1, :, 1] = loud
        return table.reshape(8, 2)

    def _air(self) -> np.ndarray:
        """Return the amplitudes (4, 2) of a room's own sound, and of the echo of its fires."""
        air = np.zeros((2, 2, 2))
        air[[0, 1], 0, [0, 1]] = AIR_LEVEL
        air[[0, 1], 1, [0, 1]] = ECHO_LEVEL * min(len(self.fires), 8) / 8
        return air.reshape(4, 2)

    def _fire(self, ear: Ear, number: int) -> np.ndarray:
        away, relative = _seen_from(ear, self.fires[number])
        # A fire that one stands in has no direction.
        sides = pan(relative, spread=min(away / 0.05, 1.0))
        loud = FIRE_LEVEL * fire.loudness(away, ear.kt, number) * self._muffled(ear)
        return np.asarray((loud * shaded(relative))[:, None] * sides)

    def _muffled(self, ear: Ear) -> np.ndarray:
        """Return what is left (3,) of each band at an ear that may be under water."""
        if self.shore is None:
            return np.ones(3)
        under = min(max((self.level - ear.y) / DEEP, 0.0), 1.0)
        return 1.0 - under * (1.0 - np.array(MUFFLED))


def _bearing(ear: Ear, place: np.ndarray) -> float:
    """Return the direction of a place (3,) from an ear in degrees, 0 north, 90 east."""
    return math.degrees(math.atan2(place[0] - ear.x, ear.z - place[2]))


def _mean_bearing(parts: Sequence[tuple[float, float | None]]) -> float | None:
    """Return the mean direction of parts (loudness, bearing); None where they are all around."""
    east = sum(loud**2 * math.sin(math.radians(bearing or 0.0)) for loud, bearing in parts)
    north = sum(loud**2 * math.cos(math.radians(bearing or 0.0)) for loud, bearing in parts)
    total = sum(loud**2 for loud, _ in parts)
    if math.hypot(east, north) < AROUND * total:
        return None
    return math.degrees(math.atan2(east, north))


def pan(relative: float, spread: float = 1.0) -> np.ndarray:
    """Return the amplitudes (2,) at both ears of what is ``relative`` degrees to the right.

    Equal power: their squares add up to 1 wherever it is. ``spread`` 0 is in the middle.
    """
    right = spread * math.sin(math.radians(relative))
    angle = (right + 1.0) * math.pi / 4.0
    return np.array([math.cos(angle), math.sin(angle)])


def shaded(relative: float) -> np.ndarray:
    """Return what is left (3,) of each band of a source ``relative`` degrees to the right."""
    behind = 0.5 - 0.5 * math.cos(math.radians(relative))
    return np.array([1.0, 1.0 - 0.4 * BEHIND * behind, 1.0 - BEHIND * behind])


def _seen_from(ear: Ear, place: Iterable[float]) -> tuple[float, float]:
    """Return how far away a place is, and where, in degrees to the right of straight ahead."""
    x, y, z = place
    east, up, south = x - ear.x, y - ear.y, z - ear.z
    away = math.sqrt(east * east + up * up + south * south)
    return away, math.degrees(math.atan2(east, -south)) - ear.yaw


STONY = Soundscape(windy=0.0, ground=lambda x, y, z: STONE, grounds=(STONE,))
"""Nothing but steps, on stone: a scene that does not say what it sounds like."""
