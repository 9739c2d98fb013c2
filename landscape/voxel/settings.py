"""The voxel island's constants as settings; see :mod:`landscape.keys`."""

from dataclasses import dataclass
from typing import ClassVar

from landscape.keys import Value, setting
from landscape.settings import UNITS, Camera, Clock, Fog, Sun, Walk

REGIONS = "Peurière, Terrain/Region"
BLOCKS = "blocks"
LAND = ("land",)


@dataclass(frozen=True)
class Voxel:
    """The terrain of cubes and its regions."""

    NEEDS: ClassVar[tuple[str, ...]] = LAND

    height_image: str = setting(
        "height16.png", "chosen", "the heights: the image's red channel", unit="image file"
    )
    regions: int = setting(10, REGIONS, "regions on each side of the map", 1, 500)
    region_size: int = setting(50, REGIONS, "columns on each side of a region", 1, 1000)
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
    facing: bool = setting(
        True, "ClassiCube", "faces that are turned away from the eye are not sent"
    )
    cull: bool = setting(
        True, "Peurière, Terrain/Region", "regions outside the view frustum are not sent"
    )
    distance: float = setting(
        26.0, "chosen", "how far regions are drawn", 0.1, 1e4, unit=UNITS, needs=("voxel.cull",)
    )
    trees: bool = setting(True, "chosen", "trees and flowers stand on the land")
    buildings: bool = setting(True, "chosen", "castle, creatures and other things to find")


@dataclass(frozen=True)
class Settings:
    """All groups, with the voxel island's own defaults of those it shares with the island."""

    camera: Camera = Camera(fov=66.0, near=0.015, far=90.0)
    clock: Clock = Clock()
    # Chosen: an eye at 1.6 blocks.
    walk: Walk = Walk(eye=0.13, speed=0.7, mouse_relative=True, bob=0.004, solid=True)
    sun: Sun = Sun(azimuth=128.0, elevation=42.0)
    fog: Fog = Fog(mode="exp2", density=0.045, color=(0.66, 0.79, 0.90), radial=True)
    voxel: Voxel = Voxel()


PRESETS: dict[str, dict[str, Value]] = {"best": {}}
