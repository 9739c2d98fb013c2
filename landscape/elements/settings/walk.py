"""The settings of the clock and of the walker."""

from dataclasses import dataclass
from typing import ClassVar

from landscape.elements.settings.units import PER_SECOND, UNITS
from landscape.settings.declare import setting

WALKING = ("walk",)


@dataclass(frozen=True)
class Clock:
    """kt, the counter all animation reads; in 2006 it grew by one per displayed frame."""

    NEEDS: ClassVar[tuple[str, ...]] = WALKING

    kt_per_second: float = setting(
        30.0, "chosen", "how fast animation runs", 0, 1000, unit="kt per second"
    )


@dataclass(frozen=True)
class Walk:
    """How the walker moves (Position in 2006)."""

    speed: float = setting(0.9, "chosen", "walking speed", 0, 100, unit=PER_SECOND, needs=WALKING)
    run: float = setting(
        3.0, "chosen", "running speed", 1, 100, unit="times the walking speed", needs=WALKING
    )
    turn: float = setting(
        75.0,
        "chosen",
        "how fast the arrow keys turn the view",
        0,
        1000,
        unit="degrees per second",
        needs=WALKING,
    )
    mouse: float = setting(
        0.12,
        "chosen",
        "how far the mouse turns the view",
        0,
        10,
        unit="degrees per pixel",
        needs=WALKING,
    )
    mouse_relative: bool = setting(
        False,
        "R13, section 11.2.6",
        "mouse motion turns the view; otherwise the pointer's position sets it",
        needs=WALKING,
    )
    eye: float = setting(
        0.1, "section 8.2", "height of the eye above the ground", 0.001, 10, unit=UNITS
    )
    bob: float = setting(
        0.006,
        "section 8.2",
        "amplitude of the head's bob at each step",
        0,
        1,
        unit=UNITS,
        needs=WALKING,
    )
    stroke_kt: float = setting(
        4.0,
        "chosen",
        "how long each picture of the sword's stroke is shown",
        0.01,
        1000,
        unit="kt",
        needs=(*WALKING, "sword"),
    )
    steps_per_unit: float = setting(
        30.0,
        "chosen",
        "how fast the steps (k_step) follow each other, for the bob of head and sword",
        0,
        1000,
        unit="steps per unit walked",
        needs=WALKING,
    )
    swim: bool = setting(
        False,
        "section 2.1.2",
        "the walker wades and swims; otherwise he walks on the water's surface, as in 2006",
        needs=WALKING,
    )
    solid: bool = setting(
        False,
        "chosen",
        "trees, deer, boulders and the castle's keep stop the walker, as walls and animals do",
        needs=WALKING,
    )
    jump: bool = setting(
        False, "chosen", "the key that flies up makes one who walks jump", needs=WALKING
    )
