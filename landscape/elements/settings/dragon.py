"""The settings of the dragon."""

from dataclasses import dataclass
from typing import ClassVar

from landscape.elements.settings.units import DEGREES, MESH_FILE, UNITS
from landscape.settings.declare import setting


@dataclass(frozen=True)
class Dragon:
    """A mesh half in the water, mapped by (x, z) (section 7)."""

    NEEDS: ClassVar[tuple[str, ...]] = ("dragon",)

    mesh: str = setting("dragon.ply", "figure 27", "the dragon's mesh", unit=MESH_FILE)
    x: float = setting(11.0, "chosen", "place, eastwards", -1e4, 1e4, unit=UNITS)
    z: float = setting(29.0, "chosen", "place, southwards", -1e4, 1e4, unit=UNITS)
    yaw: float = setting(-30.0, "chosen", "turn about y", -360, 360, unit=DEGREES)
    scale: float = setting(0.9, "chosen", "half the mesh's largest side", 0.001, 100, unit=UNITS)
    mapping: str = setting(
        "planar",
        "R12, section 7.2",
        "by (x, z), or projected along the axis each face is most normal to",
        choices=("planar", "axis"),
    )
    repeat: float = setting(
        6.0,
        "chosen",
        "how often the texture is repeated along an axis",
        0,
        1000,
        unit="repeats",
        needs=("dragon.mapping=axis",),
    )
    painted: bool = setting(False, "chosen", "vertex colours from the mesh file, if it has any")
    scaly: bool = setting(
        False,
        "chosen",
        "its skin is a texture of scales instead of the one that the rabbit has, too",
    )
    gloss: float = setting(0.0, "chosen", "strength of the specular highlight", 0, 1, unit="of 1")
    sheen: float = setting(
        0.0,
        "chosen",
        "how strongly its wet scales mirror the sky and the sea around it",
        0,
        1,
        unit="of 1",
    )
    wet: float = setting(
        0.0,
        "chosen",
        "how wet it is: the sun mirrored in its scales, and a dark band above the water",
        0,
        1,
        unit="of 1",
        needs=("dragon", "dragon.sheen>0"),
    )
    sink: float = setting(
        -0.15, "chosen", "height of the water line on the mesh", -2, 2, unit="of the mesh's -1 to 1"
    )
