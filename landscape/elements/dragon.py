"""The sea dragon: a triangle mesh half in the water (Dragon, section 7).

Technique: as the rabbit, with the vertices' own (x, z) as texture coordinates, which gives vertical
streaks; the mirrored scene draws it a second time.
State used: as animal.py.
What is wrong with it: on its flanks, where x and z hardly change, the texture is stretched into
those streaks (switch ``dragon.mapping``, best/animals/axis_mapping.py). The dragon of the preset
``best`` is best/animals/fine_dragon.py.
"""

import math
from collections.abc import Hashable
from dataclasses import replace

import numpy as np

from landscape.elements.animal import Animal, read_animal
from landscape.elements.settings import Dragon as DragonSettings
from landscape.elements.settings import Settings
from landscape.files.assets import Assets
from landscape.geometry.obstacles import Obstacle, Wall

LONG = (0.85, 0.16)  # chosen, times its scale: half its length along x and half its thickness


def planar(vertices: np.ndarray) -> np.ndarray:
    """Return texture coordinates (s, t) = (x, z), float32 (n, 2) (section 7.2)."""
    return np.ascontiguousarray(vertices[:, [0, 2]], np.float32)


def swimming(dragon: DragonSettings, level: float) -> tuple[float, float, float]:
    """Return the position of the mesh's centre with its water line at the water's ``level``."""
    return dragon.x, level - dragon.sink * dragon.scale, dragon.z


def dragon_obstacles(dragon: DragonSettings, level: float) -> tuple[Obstacle, ...]:
    """Return what the walker cannot pass: a wall along the dragon's own x axis."""
    length, thickness = (share * dragon.scale for share in LONG)
    yaw = math.radians(dragon.yaw)
    return (Wall(dragon.x, dragon.z, length, thickness, yaw, level + dragon.scale),)


class Dragon(Animal):
    """The dragon, its water line at the water's level."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the mesh, map the texture onto it and lower it to its water line."""
        dragon, level = settings.dragon, settings.water.level
        mesh = read_animal(assets, dragon.mesh, "dragon.mesh")
        mesh = replace(mesh, coordinates=(planar(mesh.vertices),))
        place = swimming(dragon, level)
        super().__init__(settings, assets, mesh, place, dragon.yaw, dragon.scale)

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return the settings that the list was made from."""
        return settings.dragon, settings.camera.lod_pixels > 0.0, settings.water.level

    def obstacles(self) -> tuple[Obstacle, ...]:
        """Return what the walker cannot pass."""
        return dragon_obstacles(self.settings.dragon, self.settings.water.level)
