"""What tests of rabbit and dragon share: small meshes, a flat ground, a place in the sun."""

import numpy as np
from stage import kind_in

from landscape.elements.best.animals.fine_dragon import FineDragon
from landscape.elements.best.animals.fine_rabbit import FineRabbit
from landscape.elements.dragon import Dragon
from landscape.elements.rabbit import Rabbit
from landscape.elements.settings import Settings
from landscape.files.assets import Assets
from landscape.geometry.height_field import HeightField
from landscape.island.slots import DRAGON, RABBIT

FLAT = HeightField(np.full((4, 4), 2.0, np.float32), 40.0, 0.6)

CUBE = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
CUBE_FACES = np.array(
    [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
)

# A plate that faces south and up: its normal has a height of sin 60 degrees.
PLATE = np.array([(-1, -0.5, 0.866), (1, -0.5, 0.866), (1, 0.5, -0.866), (-1, 0.5, -0.866)])

LIT = {
    "rabbit.x": 20.0,
    "rabbit.z": 20.0,
    "rabbit.yaw": 0.0,
    "rabbit.scale": 0.5,
    "dragon.x": 20.0,
    "dragon.z": 20.0,
    "dragon.yaw": 0.0,
    "dragon.scale": 0.5,
    "dragon.sink": 0.2,
    "water.level": 0.6,
    "sun.ambient": (0.3, 0.2, 0.1),
    "sun.diffuse": (0.5, 0.6, 0.7),
    "sun.azimuth": 180.0,
    "sun.elevation": 0.0,
}


def made(
    animal: str, settings: Settings, assets: Assets
) -> Rabbit | FineRabbit | Dragon | FineDragon:
    """Return the "rabbit" or "dragon" that the settings describe, on flat ground."""
    if animal == "rabbit":
        return kind_in(RABBIT, settings)(settings, assets, FLAT)
    return kind_in(DRAGON, settings)(settings, assets)


def ball() -> tuple[np.ndarray, np.ndarray]:
    """Return vertices and triangles of a ball fine enough for several levels of detail."""
    import trimesh  # which takes seconds: only in a process that needs it

    shape = trimesh.creation.icosphere(subdivisions=5)
    return np.asarray(shape.vertices), np.asarray(shape.faces)
