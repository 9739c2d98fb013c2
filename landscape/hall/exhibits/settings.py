"""The settings of the exhibits: one to show each, and their safeguards."""

from dataclasses import dataclass
from typing import ClassVar

from landscape.elements.settings.units import UNITS
from landscape.settings.declare import setting

COURSE = "SIGGRAPH 1997 course"


@dataclass(frozen=True)
class Exhibits:
    """The exhibits in the alcoves of the west wall."""

    NEEDS: ClassVar[tuple[str, ...]] = ("exhibits",)

    volume: bool = setting(True, f"{COURSE}, shadow volumes", "show the shadow volume")
    volume_count: str = setting(
        "zpass",
        f"{COURSE}, shadow volumes",
        "count the volume's faces in front of each surface, or those behind it",
        choices=("zpass", "zfail"),
        needs=("exhibits.volume",),
    )
    volume_caps: bool = setting(
        True,
        "Carmack 2000",
        "close the volume at both ends, to count behind surfaces",
        needs=("exhibits.volume", "exhibits.volume_count=zfail"),
    )
    volume_shown: bool = setting(
        False, "chosen", "draw the volume itself", needs=("exhibits.volume",)
    )
    soft: bool = setting(True, f"{COURSE}, soft shadows", "show the soft shadow")
    soft_samples: int = setting(
        32, "chosen", "how many points of the lamp throw a shadow", 1, 256, needs=("exhibits.soft",)
    )
    soft_lamp: float = setting(
        0.011, "chosen", "radius of the lamp", 0.0001, 1, unit=UNITS, needs=("exhibits.soft",)
    )
    deep: bool = setting(
        True,
        f"{COURSE}, accumulation buffer",
        "samples are added in floating point; off, in 8 bits, they are rounded each",
        needs=("exhibits.soft or exhibits.blur or exhibits.focus",),
    )
    blur: bool = setting(True, f"{COURSE}, motion blur", "show the motion blur")
    blur_samples: int = setting(
        10, "chosen", "how many times the sails are drawn", 1, 64, needs=("exhibits.blur",)
    )
    blur_shutter: float = setting(
        2.0,
        "chosen",
        "how long the shutter is open",
        0,
        1000,
        unit="kt",
        needs=("exhibits.blur", "exhibits.blur_samples>1"),
    )
    focus: bool = setting(True, f"{COURSE}, depth of field", "show the depth of field")
    focus_samples: int = setting(
        12, "chosen", "how many points of the lens are used", 1, 64, needs=("exhibits.focus",)
    )
    focus_lens: float = setting(
        0.018,
        "chosen",
        "radius of the lens",
        0,
        1,
        unit=UNITS,
        needs=("exhibits.focus", "exhibits.focus_samples>1"),
    )
    focus_shear: bool = setting(
        True,
        f"{COURSE}, depth of field",
        "the frustum is sheared, so that the plane of focus does not move",
        needs=("exhibits.focus", "exhibits.focus_samples>1"),
    )
    lines: bool = setting(True, f"{COURSE}, hidden lines", "show the engraved dragon")
    lines_offset: bool = setting(
        True,
        f"{COURSE}, hidden lines",
        "the fill is pushed back behind the lines",
        needs=("exhibits.lines",),
    )
    solids: bool = setting(True, f"{COURSE}, solid geometry", "show the solids")
    solids_operation: str = setting(
        "difference",
        "chosen",
        "how sphere and beam are combined",
        choices=("union", "intersection", "difference"),
        needs=("exhibits.solids",),
    )
    solids_stencil: bool = setting(
        True,
        f"{COURSE}, solid geometry",
        "surfaces are drawn only inside or outside the other solid",
        needs=("exhibits.solids", "exhibits.solids_operation!=union"),
    )
