"""All loops and short sounds, made once and kept in the cache of files. No OpenGL here.

A loop is a table of bands, (rows, samples). Each has QUANTUM more samples at its end, which are its
first ones again, so that a piece is one slice wherever it begins.
"""

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from landscape.files.cache import recall
from landscape.sound import fire, sea, steps, wind
from landscape.sound.room import Room, make_air, make_drops
from landscape.sound.signal import QUANTUM

SEA = "sea"
WIND = "wind"
FIRE = "fire"
DROPS = "drops"
AIR = "air"
STROKE = "stroke"
DIG = "dig"
PLACE = "place"

SHORT = (*steps.GROUNDS, STROKE, DIG, PLACE)
LOUDNESS = 0.055  # chosen: RMS of a loop of weight 1, so that most peaks stay below -14 dBFS
OPEN: dict[str, Callable[[], np.ndarray]] = {
    SEA: sea.make_loops,
    WIND: wind.make_loops,
    FIRE: fire.make_loops,
}
"""The loops that are the same in any place."""
OTHERS: dict[str, Callable[[int], np.ndarray]] = {
    STROKE: steps.stroke,
    DIG: steps.dug,
    PLACE: steps.placed,
}
"""The short sounds besides steps."""


@lru_cache(maxsize=16)
def loop(name: str, room: Room | None) -> np.ndarray:
    """Return a loop, float32 (rows, samples + QUANTUM)."""

    def make() -> tuple[np.ndarray]:
        if name in OPEN:
            bands = OPEN[name]()
        else:
            assert room is not None
            bands = make_drops(room) if name == DROPS else make_air(room, fire.make_loops())
        table = np.concatenate([bands, bands[:, :QUANTUM]], axis=1)
        return ((LOUDNESS * table).astype(np.float32),)

    return recall(("sound", name, repr(None if name in OPEN else room)), make)[0]


@lru_cache(maxsize=32)
def short(name: str, room: Room | None) -> np.ndarray:
    """Return the variants of a short sound, float32 (steps.VARIANTS, samples, 2)."""

    def make() -> tuple[np.ndarray]:
        made = []
        for k in range(steps.VARIANTS):
            seed = 1000 * SHORT.index(name) + k
            dry = OTHERS[name](seed) if name in OTHERS else steps.step(name, seed)
            made.append(np.stack([dry, dry], axis=1) if room is None else room.ringing(dry, seed))
        return (np.stack(made).astype(np.float32),)

    return recall(("sound", name, repr(room)), make)[0]
