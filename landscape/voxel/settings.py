"""The voxel island's constants as settings; see :mod:`landscape.settings.declare`."""

from dataclasses import dataclass
from typing import ClassVar

from landscape.elements.settings import Camera, Clock, Fog, Sound, Sun, Walk
from landscape.elements.settings.units import UNITS
from landscape.settings.declare import Value, setting, word

REGIONS = "Peurière, Terrain/Region"
BLOCKS = "blocks"
LAND = ("land",)
# The passes' textures, in the order in which they are shown.
PICTURES = ("reflection", "refraction", "shadow", "depth")
PASSES = "Peurière, Affichage"
# Times of day: what differs from a preset, which shows noon. All values are chosen.
TIMES: dict[str, dict[str, Value]] = {
    "noon": {},
    "sunset": {
        "sky.set": "sunset",
        "sun.azimuth": 250.0,  # where the sun is in the sunset's pictures (studio/sky/air.py)
        "sun.elevation": 9.0,
        "sun.diffuse": (1.0, 0.72, 0.42),
        "shadow.color": (0.58, 0.51, 0.62),
        "fog.color": (0.84, 0.61, 0.52),
        "water.color": (0.10, 0.13, 0.16),
        "water.horizon": (0.46, 0.37, 0.44),
    },
}


@dataclass(frozen=True)
class Voxel:
    """The terrain of cubes and its regions."""

    NEEDS: ClassVar[tuple[str, ...]] = LAND

    height_image: str = setting(
        "height16.png", "chosen", "the heights: the image's red channel", unit="image file"
    )
    regions: int = setting(25, REGIONS, "regions on each side of the map", 1, 64)
    region_size: int = setting(20, REGIONS, "columns on each side of a region", 1, 1000)
    block: float = setting(0.08, "chosen", "side of a cube", 0.001, 100, unit=UNITS)
    levels: int = setting(
        96, "chosen", "height of the relief from red 0 to red 256", 1, 400, unit=BLOCKS
    )
    sea: int = setting(10, "chosen", "the lowest level of dry land", 0, 400, unit=BLOCKS)
    merge: str = setting(
        "rectangles",
        "chosen",
        "how equal faces side by side become one quad",
        choices=("rectangles", "runs", "none"),
    )
    occlusion: bool = setting(True, "chosen", "corners between blocks are darker")
    slope: float = setting(
        1.0, "Peurière, Shaders", "how much the light on the ground follows the land's slope", 0, 1
    )
    highlights: float = setting(
        0.0, "Peurière, Shaders", "the sun's highlights nearby, by material; they cost a pass", 0, 4
    )
    mipmaps: bool = setting(True, "chosen", "tiles have mip levels; off, far land is noisy")
    crisp: bool = setting(
        True, "Minecraft", "texels of tiles show one by one from nearby; off, they are smoothed"
    )
    holes: bool = setting(
        True, "Minecraft", "one looks through between leaves; off, they are closed"
    )
    facing: bool = setting(
        True, "ClassiCube", "faces that are turned away from the eye are not sent"
    )
    cull: bool = setting(
        True, "Peurière, Terrain/Region", "regions outside the view frustum are not sent"
    )
    visibility: str = setting(
        "planes",
        "Peurière, Terrain/Region",
        "what a region's box is compared with: the frustum's planes, the frustum in projected "
        "space, the box around the frustum, or the last two",
        choices=("planes", "projected", "boxes", "two-way"),
        needs=("voxel.cull",),
    )
    buffers: str = setting(
        "one",
        "Peurière, Implémentation",
        "one vertex buffer for all regions, or one for each region",
        choices=("one", "regions"),
    )
    vertex_arrays: bool = setting(
        False,
        "Peurière, Implémentation",
        "vertex array objects keep where the parts of a vertex lie",
    )
    horizon: bool = setting(True, "chosen", "faces that lie behind hills are not sent")
    distance: float = setting(
        28.0, "chosen", "how far regions are drawn", 0.1, 1e4, unit=UNITS, needs=("voxel.cull",)
    )
    near: float = setting(
        6.5,
        "chosen",
        "how far corners are dark and plants are drawn; less in windows under 900 pixels high",
        0,
        1e4,
        unit=UNITS,
    )
    far: float = setting(
        11.5,
        "Luanti",
        "how far blocks are drawn one by one; beyond, eight make a larger one; less in windows "
        "under 900 pixels high",
        0,
        1e4,
        unit=UNITS,
    )
    sea_haze: bool = setting(
        True,
        "chosen",
        "from high above, far land fades into the sea's haze, not into the sky's",
        needs=("fog.enabled",),
    )
    trees: bool = setting(True, "chosen", "trees and flowers stand on the land")
    buildings: bool = setting(True, "chosen", "castle, creatures and other things to find")


@dataclass(frozen=True)
class Sky:
    """The sky, a cube map."""

    NEEDS: ClassVar[tuple[str, ...]] = ("sky",)

    set: str = setting("day", "chosen", "set of sky pictures", choices=("day", "sunset"))


@dataclass(frozen=True)
class Shadow:
    """The sun's shadows."""

    NEEDS: ClassVar[tuple[str, ...]] = LAND

    enabled: bool = setting(True, PASSES, "the land is in shadow where the sun does not see it")
    size: int = setting(
        2048, "chosen", "side of the picture that the sun sees", 16, 8192, unit="texels"
    )
    distance: float = setting(
        14.0, "chosen", "how far around the eye shadows are fine", 0.5, 1000, unit=UNITS
    )
    far: bool = setting(
        True, "chosen", "land farther away is in shadow, too, by a coarser picture of all of it"
    )
    color: tuple[float, ...] = setting(
        (0.55, 0.61, 0.74), "chosen", "light that remains in shadow", 0, 1, unit="RGB"
    )
    offset: bool = setting(
        True, "chosen", "depths are offset; off, faces shade themselves in stripes"
    )
    snapped: bool = setting(
        True, "chosen", "the picture moves in whole texels; off, the edges of shadows crawl"
    )


@dataclass(frozen=True)
class Water:
    """The sea: what it mirrors, what lies under it, and how the two are mixed."""

    NEEDS: ClassVar[tuple[str, ...]] = ("water",)

    reflection: bool = setting(True, PASSES, "the water mirrors the land; off, only the sky")
    refraction: bool = setting(True, PASSES, "one sees what lies under the water")
    bending: str = setting(
        "flat",
        "Peurière, NB",
        "how water refracts: all below is drawn flatter, or lines of sight are bent at the "
        "vertices of its grid by Walter's model",
        choices=("flat", "walter"),
        needs=("water.refraction",),
    )
    resolution: float = setting(
        0.5, "chosen", "size of the two pictures", 0.05, 1, unit="times the window's"
    )
    fresnel: float = setting(1.0, PASSES, "how much it mirrors; 1 is as much as water does", 0, 4)
    by_angle: bool = setting(
        True, PASSES, "it mirrors more at grazing angles; off, as much at all angles"
    )
    far: float = setting(
        7.0,
        "Luanti",
        "how far blocks are mirrored one by one; beyond, eight make a larger one",
        0,
        1e4,
        unit=UNITS,
        needs=("water.reflection",),
    )
    ripples: float = setting(
        1.0, PASSES, "how far ripples displace what is seen in and under the water", 0, 10
    )
    sparkle: float = setting(1.0, PASSES, "how wide the sun's glints are", 0, 4)
    color: tuple[float, ...] = setting(
        (0.03, 0.20, 0.27), "chosen", "colour of deep water", 0, 1, unit="RGB"
    )
    horizon: tuple[float, ...] = setting(
        (0.36, 0.55, 0.72),
        "chosen",
        "colour of the sea at the horizon, under haze",
        0,
        1,
        unit="RGB",
    )
    below: bool = setting(
        True, "chosen", "from under water one sees the bed, and the surface from beneath"
    )
    sight: float = setting(
        45.0,
        "chosen",
        "how far one sees under water",
        1,
        1000,
        unit=BLOCKS,
        needs=("water.below",),
    )
    clear: float = setting(
        9.0, "chosen", "depth from which nothing is seen any more", 0.1, 1000, unit=BLOCKS
    )


@dataclass(frozen=True)
class Overlay:
    """The overlay before the walker's eyes."""

    map: bool = setting(True, "section 9", "show the map", needs=("map",))


@dataclass(frozen=True)
class Debug:
    """Diagnostic pictures to show while walking, beside or in place of the usual one."""

    NEEDS: ClassVar[tuple[str, ...]] = LAND

    regions: bool = setting(
        False, "Peurière, Commandes", "show the regions' boxes, and the frustum from outside"
    )
    textures: bool = setting(
        False, "Peurière, Commandes", "show the textures of reflection, refraction and depths"
    )
    picture: str = setting(
        "none",
        "chosen",
        "show one of these textures instead of the picture",
        choices=("none", *PICTURES),
    )
    edges: bool = setting(False, "chosen", "show the edges of the quads that are drawn")


@dataclass(frozen=True)
class Settings:
    """All groups, and the time of day; the shared groups have the voxel island's own defaults."""

    time: str = word("noon", TIMES, "chosen", "time of day: sun, sky and fog at once")
    camera: Camera = Camera(fov=66.0, near=0.009, far=90.0)
    clock: Clock = Clock()
    # Chosen: an eye at 1.6 blocks; 6 blocks a second.
    walk: Walk = Walk(
        eye=0.13, speed=0.48, run=2.0, mouse_relative=True, bob=0.004, swim=True, solid=True
    )
    sound: Sound = Sound()
    sun: Sun = Sun(azimuth=128.0, elevation=42.0)
    fog: Fog = Fog(mode="exp2", density=0.037, color=(0.62, 0.76, 0.90), radial=True)
    voxel: Voxel = Voxel()
    shadow: Shadow = Shadow()
    sky: Sky = Sky()
    water: Water = Water()
    overlay: Overlay = Overlay()
    debug: Debug = Debug()


PRESETS: dict[str, dict[str, Value]] = {"best": {}}
