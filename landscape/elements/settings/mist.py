"""The settings of the mist over the bay."""

from dataclasses import dataclass
from typing import ClassVar

from landscape.settings.declare import setting


@dataclass(frozen=True)
class Mist:
    """Morning mist over the bay, in transparent sheets; in neither preset."""

    NEEDS: ClassVar[tuple[str, ...]] = ("mist", "mist.enabled")

    enabled: bool = setting(False, "glskel effects", "mist lies over the bay")
    sheets: int = setting(9, "chosen", "how many sheets it is made of", 1, 30, unit="sheets")
    density: float = setting(
        0.55, "chosen", "opacity of a sheet where it is densest", 0, 1, unit="of 1"
    )
