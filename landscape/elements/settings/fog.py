"""The settings of the fog."""

from dataclasses import dataclass
from typing import ClassVar

from landscape.elements.settings.units import UNITS
from landscape.settings.declare import setting


@dataclass(frozen=True)
class Fog:
    """GL_FOG (section 10)."""

    # The sun's glints and the sprites that fade out read it even where nothing is drawn in fog.
    READ: ClassVar[str] = "fog or water.glitter or transparent.fade"

    enabled: bool = setting(True, "section 10.2", "fog on or off", needs=(READ,))
    mode: str = setting(
        "exp2",
        "section 10.2",
        "how it thickens with distance",
        choices=("exp2", "exp", "linear"),
        needs=(READ, "fog.enabled"),
    )
    density: float = setting(
        0.12,
        "section 10.2",
        "how dense it is in the modes exp2 and exp",
        0,
        1000,
        unit="per unit",
        needs=(READ, "fog.enabled", "fog.mode!=linear"),
    )
    color: tuple[float, ...] = setting(
        (0.4, 0.6, 0.7), "section 10.2", "colour of the fog and of the background", 0, 1, unit="RGB"
    )
    radial: bool = setting(
        False,
        "chosen",
        "it thickens with the distance from the eye; off, with the depth, less towards the sides",
        needs=("fog", "fog.enabled"),
    )
    start: float = setting(
        1.0,
        "chosen",
        "where it begins in the mode linear",
        0,
        1e5,
        unit=UNITS,
        needs=("fog", "fog.enabled", "fog.mode=linear"),
    )
    end: float = setting(
        20.0,
        "chosen",
        "where it hides everything in the mode linear",
        0,
        1e5,
        unit=UNITS,
        needs=("fog", "fog.enabled", "fog.mode=linear"),
    )
