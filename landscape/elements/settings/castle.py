"""The settings of the castle."""

from dataclasses import dataclass

from landscape.elements.settings.units import DEGREES, UNITS
from landscape.settings.declare import setting


@dataclass(frozen=True)
class Castle:
    """Walls, towers, gate and torches (section 6)."""

    x: float = setting(27.3, "chosen", "place of the centre, eastwards", -1e4, 1e4, unit=UNITS)
    z: float = setting(16.9, "chosen", "place of the centre, southwards", -1e4, 1e4, unit=UNITS)
    yaw: float = setting(
        -160.0,
        "chosen",
        "turn about y; at 0 the gate faces north",
        -360,
        360,
        unit=DEGREES,
        needs=("castle",),
    )
    brick_repeat: float = setting(
        4.0,
        "chosen",
        "how often the bricks are repeated",
        0.1,
        100,
        unit="textures per wall",
        needs=("castle",),
    )
    sides: int = setting(
        8,
        "section 6",
        "how many sides a tower has: few, so that it looks angular",
        3,
        64,
        unit="sides",
        needs=("castle",),
    )
    battlements: bool = setting(
        False,
        "chosen",
        "merlons on the walls, and parapets around the towers' tops",
        needs=("castle",),
    )
    flame_faces: bool = setting(
        False, "R2, section 6.1", "flames turn about y to face the viewer", needs=("castle",)
    )
    multitexture: bool = setting(
        False,
        "R11, section 11.2.4",
        "bricks, door and light in one pass with three texture units",
        needs=("castle",),
    )
    ornate: bool = setting(
        False, "chosen", "a keep, roofs, bands, loopholes and pennants", needs=("castle",)
    )
    open: bool = setting(
        False,
        "chosen",
        "the door is open, and leads into the great hall",
        needs=("castle", "castle.ornate"),
    )
    torches: float = setting(
        0.0,
        "chosen",
        "how much the torches light the walls: at 0 as by day, at 1 as in the dark",
        0,
        1,
        unit="fraction",
        needs=("castle", "castle.ornate"),
    )
    depth: bool = setting(
        False,
        "chosen",
        "the open door shows the hall behind it, not a wall painted dark",
        needs=("castle", "castle.ornate", "castle.open"),
    )
    glow: float = setting(
        0.0,
        "chosen",
        "how strongly the flames glow and light the ground; above 0 they are larger, too",
        0,
        1,
        unit="of 1",
        needs=("castle", "castle.ornate"),
    )
    weathered: bool = setting(
        False,
        "chosen",
        "uneven stones with stains and moss, framed windows, slates, rubble and ivy",
        needs=("castle", "castle.ornate"),
    )
