"""The settings of what lies over the picture: the sword and the map."""

from dataclasses import dataclass

from landscape.settings.declare import setting


@dataclass(frozen=True)
class Overlay:
    """The sword (section 8) and the map (section 9)."""

    sword: bool = setting(True, "section 8", "show the sword", needs=("sword",))
    sheen: float = setting(
        0.0,
        "chosen",
        "how strongly the sword's steel mirrors the light around",
        0,
        1,
        unit="of 1",
        needs=("sword", "overlay.sword"),
    )
    blade: bool = setting(
        False,
        "chosen",
        "the blade at rest is geometry with smooth edges, whose steel is a mirror",
        needs=("sword", "overlay.sword"),
    )
    map: bool = setting(True, "section 9", "show the map", needs=("map",))
    map_alpha: float = setting(
        0.75, "chosen", "opacity of the map", 0, 1, unit="of 1", needs=("map", "overlay.map")
    )
