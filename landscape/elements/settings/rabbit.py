"""The settings of the rabbit."""

from dataclasses import dataclass

from landscape.elements.settings.units import DEGREES, MESH_FILE, UNITS
from landscape.settings.declare import setting


@dataclass(frozen=True)
class Rabbit:
    """A mesh on land, cylindrical mapping (section 7)."""

    mesh: str = setting(
        "rabbit.ply", "figure 27", "the rabbit's mesh", unit=MESH_FILE, needs=("rabbit",)
    )
    x: float = setting(20.5, "chosen", "place, eastwards", -1e4, 1e4, unit=UNITS)
    z: float = setting(24.0, "chosen", "place, southwards", -1e4, 1e4, unit=UNITS)
    yaw: float = setting(
        -112.0, "chosen", "turn about y", -360, 360, unit=DEGREES, needs=("rabbit",)
    )
    scale: float = setting(0.12, "chosen", "half the mesh's largest side", 0.001, 100, unit=UNITS)
    l1: float = setting(
        8.0,
        "chosen",
        "how often the texture is repeated around the axis, L1",
        0,
        1000,
        unit="repeats",
        needs=("rabbit", "rabbit.mapping=cylindrical"),
    )
    l2: float = setting(
        4.0,
        "chosen",
        "how often the texture is repeated along the axis, L2",
        0,
        1000,
        unit="repeats",
        needs=("rabbit",),
    )
    mapping: str = setting(
        "cylindrical",
        "R12, section 11.2.5",
        "cylindrical, or projected along the axis each face is most normal to",
        choices=("cylindrical", "axis"),
        needs=("rabbit",),
    )
    painted: bool = setting(
        False, "chosen", "vertex colours from the mesh file, if it has any", needs=("rabbit",)
    )
    fur: int = setting(
        0,
        "chosen",
        "layers of fur around the rabbit, and a glint in its eyes; 0 is neither",
        0,
        32,
        unit="layers",
        needs=("rabbit",),
    )
