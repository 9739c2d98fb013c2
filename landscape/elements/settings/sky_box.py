"""The settings of the sky."""

from dataclasses import dataclass
from typing import ClassVar

from landscape.elements.settings.units import UNITS
from landscape.settings.declare import setting


@dataclass(frozen=True)
class Sky:
    """The sky box (section 4)."""

    NEEDS: ClassVar[tuple[str, ...]] = ("sky",)

    set: str = setting("day", "chosen", "set of sky pictures", choices=("day", "sunset"))
    refined: bool = setting(
        False, "chosen", "pictures with wide, flat clouds and fibrous cirrus; off, the former ones"
    )
    unfolded: str = setting(
        "none",
        "figure 12",
        "one picture of all five faces, the box unfolded, instead of the five files of the set",
        unit="none, or image file",
    )
    half_width: float = setting(
        8.0, "chosen", "distance of the walls from the centre, D", 0.5, 10000, unit=UNITS
    )
    height: float = setting(5.0, "chosen", "height of the box, H", 0.1, 10000, unit=UNITS)
    sunk: float = setting(
        0.0,
        "section 11.2.3",
        "how far the walls reach below the sea, or below the eye if the box follows it in y",
        0,
        10000,
        unit=UNITS,
    )
    anchored: bool = setting(
        False, "figure 13", "stays at the centre of the map instead of following the viewer"
    )
    moving: bool = setting(False, "R1, section 4.1", "a cloud layer that drifts with kt")
    follow_y: bool = setting(False, "R8, section 11.2.3", "centred on the eye in y as well")
    background: bool = setting(
        False, "R9, section 11.2.3", "drawn at the greatest depth, so it hides no terrain"
    )
    unfogged: bool = setting(
        False,
        "R10, section 11.2.3",
        "drawn without fog; its pictures contain haze",
        needs=("fog.enabled", "fog"),
    )
