"""The rabbit: a triangle mesh on land (Rabit, section 7).

Technique: a PLY mesh in a display list (animal.py), textured by the cylindrical coordinates of its
own vertices. The absolute value of the angle gives both ends of its range the same texture
coordinate: without it the whole texture would run backwards through one narrow strip.
State used: as animal.py.
What is wrong with it: near the axis the angle changes fast, and the texture is pinched (switch
``rabbit.mapping``, R12, best/animals/axis_mapping.py). The rabbit of the preset ``best`` is
best/animals/fine_rabbit.py.
"""

from collections.abc import Hashable
from dataclasses import replace
from typing import Self

import numpy as np

from landscape.elements.animal import Animal, read_animal
from landscape.elements.element import Site
from landscape.elements.ground import Ground
from landscape.elements.settings import Rabbit as RabbitSettings
from landscape.elements.settings import Settings
from landscape.files.assets import Assets
from landscape.geometry.height_field import HeightField
from landscape.geometry.mesh import Mesh
from landscape.geometry.obstacles import Obstacle, Tower

SUNK = 0.02  # chosen, times its scale: how far it is sunk, so that no gap shows under it
ROUND = 0.6  # chosen, times its scale: radius of a circle around haunches and chest


def cylindrical(vertices: np.ndarray, l1: float, l2: float) -> np.ndarray:
    """Return texture coordinates, float32 (n, 2), of vertices (n, 3) in -1..1 (section 7.2)."""
    x, y, z = vertices.T
    s = l1 * np.abs(np.arctan2(z, x)) / (2 * np.pi)
    return np.ascontiguousarray(np.stack([s, l2 * (y + 1) / 2], axis=1), np.float32)


def standing(rabbit: RabbitSettings, mesh: Mesh, field: HeightField) -> tuple[float, float, float]:
    """Return the position of the mesh's centre that puts its lowest vertex on the ground."""
    low = float(mesh.vertices[:, 1].min()) * rabbit.scale
    y = float(field.height(rabbit.x, rabbit.z)) - low - SUNK * rabbit.scale
    return rabbit.x, y, rabbit.z


def rabbit_obstacles(rabbit: RabbitSettings, field: HeightField) -> tuple[Obstacle, ...]:
    """Return what the walker cannot pass: a round tower as high as the rabbit."""
    top = float(field.height(rabbit.x, rabbit.z)) + 2 * rabbit.scale
    return (Tower(rabbit.x, rabbit.z, ROUND * rabbit.scale, top),)


class Rabbit(Animal):
    """The rabbit, on the ground."""

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        """Place it on the ground."""
        return cls(site.settings, site.assets, site.elements[Ground].field)

    def __init__(self, settings: Settings, assets: Assets, field: HeightField) -> None:
        """Read the mesh, map the texture around it and place it on the ground."""
        rabbit = settings.rabbit
        mesh = read_animal(assets, rabbit.mesh, "rabbit.mesh")
        place = standing(rabbit, mesh, field)
        mesh = replace(mesh, coordinates=(cylindrical(mesh.vertices, rabbit.l1, rabbit.l2),))
        super().__init__(settings, assets, mesh, place, rabbit.yaw, rabbit.scale)
        self._obstacles = rabbit_obstacles(rabbit, field)

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return the settings that the list was made from."""
        return settings.rabbit, settings.camera.lod_pixels > 0.0

    def obstacles(self) -> tuple[Obstacle, ...]:
        """Return what the walker cannot pass."""
        return self._obstacles
