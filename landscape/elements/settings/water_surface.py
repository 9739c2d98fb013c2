"""The settings of the water."""

from dataclasses import dataclass

from landscape.elements.settings.units import UNITS
from landscape.settings.declare import setting


@dataclass(frozen=True)
class Water:
    """The water surface (section 3)."""

    level: float = setting(0.6, "chosen", "height of the water, WATER_LEVEL", 0, 1000, unit=UNITS)
    color: tuple[float, ...] = setting(
        (0.2, 0.2, 0.4, 0.7),
        "section 3.2",
        "colour of the water; alpha is its opacity",
        0,
        1,
        unit="RGBA",
        needs=("water",),
    )
    patch: float = setting(
        10.0, "section 3.2", "side of a patch", 0.1, 1000, unit=UNITS, needs=("water",)
    )
    points: int = setting(
        40,
        "section 3.2",
        "vertices per side of a patch",
        2,
        400,
        unit="vertices",
        needs=("water",),
    )
    repeat: float = setting(
        4.0,
        "chosen",
        "how often the texture is repeated, LAMBDA_WATER",
        0,
        1000,
        unit="textures per patch",
        needs=("water", "water.textured"),
    )
    lod_bias: float = setting(
        0.0,
        "chosen",
        "added to the mip level that OpenGL chooses; below 0 is sharper",
        -4,
        4,
        unit="mip levels",
        needs=("water", "water.textured"),
    )
    trilinear: bool = setting(
        True,
        "chosen",
        "trilinear filtering; off, the nearest mip level",
        needs=("water", "water.textured"),
    )
    textured: bool = setting(True, "figure 9", "texture the surface", needs=("water",))
    animated: bool = setting(
        True, "section 3.2", "move normals and texture coordinates", needs=("water",)
    )
    time_step: float = setting(
        0.02,
        "chosen",
        "how fast the waves move",
        0,
        10,
        unit="t per kt",
        needs=("water", "water.animated"),
    )
    fresnel: bool = setting(
        False,
        "chosen",
        "opacity by the angle of view: the mirror image is strongest far away",
        needs=("water",),
    )
    ripples: float = setting(
        0.0,
        "chosen",
        "how much each pixel's ripple changes what the water mirrors; finer ripples near the eye",
        0,
        1,
        unit="of 1",
        needs=("water", "water.textured"),
    )
    horizon: float = setting(
        0.0,
        "chosen",
        "how far the sea reaches beyond the patches",
        0,
        10000,
        unit=UNITS,
        needs=("water",),
    )
    horizon_contrast: float = setting(
        0.0,
        "chosen",
        "how much of the sea's colour the fog leaves at the horizon at least",
        0,
        0.99,
        unit="of 1",
        needs=("water", "fog", "fog.enabled", "fog.density", "fog.mode!=linear"),
    )
    glitter: float = setting(
        0.0,
        "chosen",
        "strength of the sun's glints on the waves",
        0,
        1,
        unit="of 1",
        needs=("water",),
    )
    roughness: float = setting(
        0.15,
        "chosen",
        "slope of ripples too small to draw: how wide the path of glints is",
        0.01,
        1,
        unit="standard deviation",
        needs=("water", "water.glitter"),
    )
    under: bool = setting(
        False,
        "glskel effects",
        "an eye below the surface sees water: fog, the surface from below, a net of light",
        needs=("water",),
    )
    relief: bool = setting(
        False, "R17, section 3.2", "waves displace the vertices", needs=("water",)
    )
    sheltered: bool = setting(
        False,
        "chosen",
        "waves are lower near land, and the mirror image is clearer",
        # The plain surface of 2006 has no such waves; each of these chooses another.
        needs=(
            "water",
            "reflection.rippled or water.relief or water.shallow or water.fresnel or water.glitter "
            "or water.foam or water.ripples or water.horizon_contrast",
        ),
    )
    shallow: bool = setting(False, "chosen", "shallow water is clear and greener", needs=("water",))
    caustics: bool = setting(
        False,
        "chosen",
        "light on the bed of shallow water, focused by its waves",
        needs=(
            *("ground", "water", "water.shallow", "reflection.rippled or not reflection.enabled"),
            *("ground.materials", "ground.units=both", "ground.tiles>1"),
        ),
    )
    foam: bool = setting(False, "chosen", "a wash of foam along the shore", needs=("water",))
    run_up: bool = setting(
        False,
        "chosen",
        "waves climb the sand and drain, and leave lace and wet sand",
        needs=("water", "water.foam"),
    )
    query: bool = setting(
        False,
        "chosen",
        "skip sea and mirror image while an occlusion query finds the sea hidden",
        needs=("water", "reflection.rippled"),
    )
