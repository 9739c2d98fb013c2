"""The settings of the sun, and of materials in its light."""

from dataclasses import dataclass
from typing import ClassVar

from landscape.elements.settings.units import DEGREES
from landscape.settings.declare import setting

# Elements and settings that depend on the sun's position.
SUNLIT = (
    "water or castle or rabbit or dragon or ground.lit or ground.shadows"
    " or ground.height_image!=height.png or sun.relit",
)


@dataclass(frozen=True)
class Sun:
    """The one light, GL_LIGHT0, at infinity."""

    azimuth: float = setting(
        130.0,
        "chosen",
        "direction of the sun: 0 north, 90 east",
        -360,
        360,
        unit=DEGREES,
        needs=SUNLIT,
    )
    elevation: float = setting(
        38.0, "chosen", "height of the sun above the horizon", 0, 90, unit=DEGREES, needs=SUNLIT
    )
    diffuse: tuple[float, ...] = setting(
        (1.0, 0.95, 0.85),
        "chosen",
        "colour of the light on water, castle, rabbit and dragon",
        0,
        10,
        unit="RGB",
        needs=("water or castle or rabbit or dragon or ground.lit",),
    )
    ambient: tuple[float, ...] = setting(
        (0.50, 0.53, 0.60),
        "chosen",
        "colour of the ambient light on water, castle, rabbit and dragon",
        0,
        10,
        unit="RGB",
        needs=("water or castle or rabbit or dragon or ground.lit",),
    )
    fill: float = setting(
        0.0,
        "chosen",
        "strength of a second light, opposite the sun",
        0,
        10,
        unit="times the ambient colour",
        needs=("water or castle or rabbit or dragon or ground.lit",),
    )
    tint: tuple[float, ...] = setting(
        (1.0, 1.0, 1.0),
        "chosen",
        "factor on what has its light painted in: ground, sprites, grass, foam, clouds, sword",
        0,
        1,
        unit="RGB",
    )
    shade: tuple[float, ...] = setting(
        (0.50, 0.53, 0.58),
        "chosen",
        "the same factor where the sun does not reach",
        0,
        1,
        unit="RGB",
        needs=("ground.shadows or sun.relit",),
    )
    relit: bool = setting(
        False,
        "chosen",
        "sun.tint on the sunny side alone, sun.shade on the other; not in 2006's elements",
    )


@dataclass(frozen=True)
class Shading:
    """How OpenGL shades what the sun lights: to show what lighting does, and what it is made of."""

    NEEDS: ClassVar[tuple[str, ...]] = ("water or castle or rabbit or dragon or ground.lit",)

    lighting: bool = setting(
        True, "chosen", "light water, castle, rabbit and dragon; off, they have their plain colour"
    )
    smooth: bool = setting(
        True, "chosen", "blend the light of the vertices over a triangle; off, flat shading"
    )
