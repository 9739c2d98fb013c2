"""The settings of the grass."""

from dataclasses import dataclass
from typing import ClassVar

from landscape.elements.settings.units import UNITS
from landscape.settings.declare import setting


@dataclass(frozen=True)
class Grass:
    """Blades (section 5.3)."""

    NEEDS: ClassVar[tuple[str, ...]] = ("grass", "grass.count")

    count: int = setting(
        200_000, "section 5.3.1", "how many blades the map has", 0, 40_000_000, unit="blades"
    )
    scale: tuple[float, ...] = setting(
        (1.0, 1.0),
        "section 5.3.2",
        "width and height of a blade (sx, sy)",
        0.01,
        100,
        unit="times the report's blade",
    )
    arch: float = setting(
        1.0, "section 5.3.2", "how far the tip bends", 0, 20, unit="times the report's bend"
    )
    radius: float = setting(4.0, "chosen", "blades farther away are not drawn", 0, 1000, unit=UNITS)
    tinted: bool = setting(False, "chosen", "blades take the colour of the ground below them")
    fade: bool = setting(
        False, "chosen", "blades shrink towards the radius instead of ending abruptly there"
    )
    facing: float = setting(
        0.0,
        "R7, section 11.2.2",
        "how far blades turn to the viewer; above 0.5 none is edge-on",
        0,
        1,
        unit="of 1",
    )
    method: str = setting(
        "cells",
        "R18, section 5.3",
        "submit blades in one call, or one by one as in 2006",
        choices=("cells", "loop"),
    )
    tufts: int = setting(
        0, "chosen", "blades per tuft, leaning apart; 0 is off", 0, 100, unit="blades"
    )
    variety: float = setting(
        0.0,
        "chosen",
        "variation of tufts in height and colour",
        0,
        1,
        unit="of 1",
        needs=("grass.fade or grass.tinted or grass.sward",),
    )
    sward: bool = setting(
        False, "chosen", "sheaves of fine blades, seed heads and straw instead of single blades"
    )
    flowers: float = setting(
        0.0,
        "chosen",
        "cards of the sward that are flowers, in the middle of a drift",
        0,
        1,
        unit="of 1",
        needs=("grass.sward",),
    )
    gusts: float = setting(
        0.0,
        "chosen",
        "how far gusts bend the blades as they travel over the meadow",
        0,
        10,
        unit="times a normal gust",
    )
