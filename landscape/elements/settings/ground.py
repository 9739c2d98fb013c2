"""The settings of the ground."""

from dataclasses import dataclass

from landscape.elements.settings.units import REPEATS, UNITS
from landscape.settings.declare import setting

# Readers of the colours of the ground's large texture, apart from the ground itself.
COLOURS_READ = "grass.tinted or trees.grouped or plants.species>1"


@dataclass(frozen=True)
class Ground:
    """The height field (section 2)."""

    height_image: str = setting(
        "height.png", "figure 1", "the heights: the image's red channel", unit="image file"
    )
    resolution: int = setting(
        50, "section 2.1.1", "vertices per side of the height field", 2, 1024, unit="vertices"
    )
    size: float = setting(40.0, "section 9.2", "side of the map", 1, 200, unit=UNITS)
    scale_y: float = setting(6.0, "chosen", "height where red is 256", 0.001, 1000, unit=UNITS)
    scale_x: float = setting(
        1.0,
        "section 2.1.2",
        "how much of the map the images cover from west to east; the rest is sea",
        0.05,
        1,
        unit="of ground.size",
    )
    scale_z: float = setting(
        1.0,
        "section 2.1.2",
        "how much of the map the images cover from north to south; the rest is sea",
        0.05,
        1,
        unit="of ground.size",
    )
    clip: bool = setting(
        True,
        "section 2.1.2",
        "clip ground, rabbit and dragon at the water level with GL_CLIP_PLANE0",
        # The plane that closes shallow water hides all that is below it.
        needs=(
            "not water or not water.shallow or reflection.enabled",
            "not water or not water.shallow or not reflection.rippled",
        ),
    )
    large_texture: str = setting(
        "ground_large.png",
        "figure 3",
        "the colours of the whole map, in texture unit 0",
        unit="image file",
        needs=(f"ground.units=both or ground.units=large or {COLOURS_READ}",),
    )
    detail_texture: str = setting(
        "ground_detail.png",
        "figure 3",
        "the detail that is repeated over the map, in texture unit 1",
        unit="image file",
        needs=("ground.units=both or ground.units=detail",),
    )
    detail_repeat: float = setting(
        160.0,
        "chosen",
        "how often the detail texture is repeated",
        0.1,
        10000,
        unit=REPEATS,
        needs=("ground.units=both or ground.units=detail",),
    )
    units: str = setting(
        "both", "figure 4", "texture units in use", choices=("both", "large", "detail", "none")
    )
    passes: str = setting(
        "one",
        "section 2.2.2",
        "both textures in one pass by two texture units, or a second pass blended over the first",
        choices=("one", "two"),
        needs=("ground", "ground.units=both"),
    )
    lit: bool = setting(
        False,
        "section 2.2.2",
        "light the ground by its normals, too; its colours have their light painted in",
        needs=("ground",),
    )
    mid_repeat: float = setting(
        0.0,
        "chosen",
        "how often the detail baked in with ground.materials is repeated; 0 is off",
        0,
        1000,
        unit=REPEATS,
        needs=("ground.materials", "ground.units=both"),
    )
    smooth: str = setting(
        "none",
        "R14, section 11.2.6",
        "spline of the bicubic patches between vertices",
        choices=("none", "catmull_rom", "b_spline"),
    )
    subdivide: int = setting(
        3,
        "R14",
        "subdivisions of a cell's side on a smooth ground",
        1,
        8,
        unit="subdivisions",
        needs=("ground.smooth!=none",),
    )
    exact_height: bool = setting(
        False, "R15, section 11.2.6", "heights on the drawn triangles, not on a bilinear surface"
    )
    materials: bool = setting(
        False,
        "chosen",
        "turf, sand and rock have their own detail textures, mixed in four units",
        needs=("ground.units=both",),
    )
    sand_texture: str = setting(
        "ground_sand.png",
        "chosen",
        "detail texture of bare ground",
        unit="image file",
        needs=("ground.materials", "ground.units=both"),
    )
    rock_texture: str = setting(
        "ground_rock.png",
        "chosen",
        "detail texture of steep ground",
        unit="image file",
        needs=("ground.materials", "ground.units=both"),
    )
    sand_repeat: float = setting(
        110.0,
        "chosen",
        "how often the sand is repeated",
        0.1,
        10000,
        unit=REPEATS,
        needs=("ground.materials", "ground.units=both"),
    )
    rock_repeat: float = setting(
        36.0,
        "chosen",
        "how often the rock is repeated",
        0.1,
        10000,
        unit=REPEATS,
        needs=("ground.materials", "ground.units=both"),
    )
    texture_size: int = setting(
        4096,
        "R19, introduction",
        "the largest side of a texture; larger images are reduced",
        1,
        4096,
        unit="texels",
        needs=(f"ground.units!=none or {COLOURS_READ}",),
    )
    tiles: int = setting(
        1,
        "chosen",
        "tiles per side, a display list each; tiles outside the frustum are skipped",
        1,
        64,
        unit="tiles",
    )
    low_stretch: bool = setting(
        False,
        "chosen",
        "low-stretch UVs: detail textures keep their scale on slopes",
        needs=("ground.units=both or ground.units=detail",),
    )
    shadows: bool = setting(
        False,
        "chosen",
        "bake shadows into the ground's large texture",
        needs=("ground.units=both or ground.units=large or plants.shaded or grass.tinted",),
    )
    weathered: bool = setting(
        False,
        "chosen",
        "paint ledges into rock, a tideline onto beaches, and ragged edges of turf",
        needs=("ground", "ground.materials", "ground.units=both"),
    )
    lod_bias: float = setting(
        0.0,
        "chosen",
        "added to the mip level that OpenGL chooses; below 0 the ground is sharper",
        -4,
        4,
        unit="mip levels",
        needs=("ground", "ground.materials", "ground.units=both"),
    )
    verdure: float = setting(
        0.0,
        "chosen",
        "how far turf has the colour of the sward on it, and its grain far away",
        0,
        1,
        unit="of 1",
        needs=("ground", "ground.materials", "ground.units=both"),
    )
    tone: float = setting(
        0.0,
        "chosen",
        "how far turf and rock have the darker, duller tones that a photograph gives them",
        0,
        1,
        unit="of 1",
        needs=("ground", "ground.materials", "ground.units=both"),
    )
    clouds: float = setting(
        0.0,
        "chosen",
        "how dark the shadows of clouds on the land are by day",
        0,
        1,
        unit="of 1",
        needs=("ground.shadows", "not sun.relit"),
    )
    stones: int = setting(
        0,
        "chosen",
        "how many crags, boulders, stones and pieces of driftwood lie on bare ground",
        0,
        40_000,
        unit="stones",
        needs=("ground", "ground.materials", "ground.units=both"),
    )
    ledges: float = setting(
        0.0,
        "chosen",
        "how far steep rock stands out in ledges, gullies and knobs finer than the height field",
        0,
        2,
        unit="of 1",
        needs=("ground.materials", "ground.units=both", "ground.tiles>1", "ground.exact_height"),
    )
    wet: bool = setting(
        False,
        "chosen",
        "sand and rock are darker where waves have wetted them",
        needs=("ground.materials", "ground.units=both"),
    )
