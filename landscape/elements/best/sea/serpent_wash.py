"""Where the dragon meets the water: foam along its sides, and rings that run outwards.

A map of the distance from the line where its mesh crosses the water, as for the shore
(shoreline.py), but the swell runs away from it. No OpenGL here.
"""

import math
from typing import TypeAlias

import numpy as np

from landscape.elements.animal import read_animal
from landscape.elements.best.sea.shoreline import averaged, crossings, last_foam, nearest_pieces
from landscape.elements.settings import Settings
from landscape.files.assets import Assets
from landscape.files.cache import content, recall

TEXELS = 256  # chosen: per side of the map
REACH = 0.55  # chosen: units that rings run outwards
RINGS = 0.15  # chosen: units from one ring to the next
RING = 0.5  # chosen: density of foam in a ring, next to the dragon
FADING = 0.3  # chosen: units in which a ring fades to a third
EDGE = 1.0  # chosen: density of the foam at its sides
EDGE_WIDTH = 0.06  # chosen: units in which that falls to a third
CALM = -0.1  # chosen: density between the rings: below 0, so that they are narrow
Rings: TypeAlias = tuple[tuple[np.ndarray, ...], np.ndarray, tuple[float, float], float]
"""What rings_around returns."""


def outline(settings: Settings, assets: Assets) -> np.ndarray:
    """Return where the dragon's mesh crosses the water, (n, 2, 2), x and z in units from it."""
    dragon = settings.dragon
    mesh = read_animal(assets, dragon.mesh, "dragon.mesh")
    yaw, (x, y, z) = math.radians(dragon.yaw), mesh.vertices.astype(np.float64).T
    turned = [x * math.cos(yaw) + z * math.sin(yaw), z * math.cos(yaw) - x * math.sin(yaw)]
    places = dragon.scale * np.stack(turned, axis=1)
    return crossings(places, y - dragon.sink, mesh.triangles)[0]


def rings(distance: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the strength and phase of the rings and the density of the foam that stays.

    As :func:`wash` of foam.py does for the shore; the phase falls with the distance in units.
    """
    fade = np.clip((REACH - distance) / (0.4 * REACH), 0.0, 1.0)
    swell = RING * np.exp(-distance / FADING) * fade
    edge = EDGE * np.exp(-distance / EDGE_WIDTH) + CALM
    return swell, -2 * np.pi / RINGS * distance, edge * fade - (1.0 - fade)


def rings_around(settings: Settings, assets: Assets) -> Rings:
    """Return what :func:`rings` does for each texel of a map around the dragon, and its place.

    Before that, how far from foam each texel is. The place is x and z of the map's corner, and its
    side, in units.
    """
    dragon = settings.dragon
    size = 2.0 * (math.sqrt(2.0) * dragon.scale + REACH)
    corner = dragon.x - size / 2, dragon.z - size / 2

    def make() -> tuple[np.ndarray]:
        ends = outline(settings, assets) + size / 2
        return (averaged(nearest_pieces(ends, TEXELS, size / TEXELS, REACH)[0]),)

    what = repr((dragon.scale, dragon.yaw, dragon.sink))
    (distance,) = recall(["rings", what, content(assets.path(dragon.mesh))], make)
    along = np.linspace(0.0, REACH, 500)
    swell, _, edge = rings(along)
    apart = np.maximum(distance - last_foam(along, swell, edge), 0.0)
    # Beyond REACH the distance is not known; nor is it in the map's corners.
    return rings(distance), np.where(distance < 0.98 * REACH, apart, REACH), corner, size


def built_from(settings: Settings) -> tuple[object, ...]:
    """Return the settings that the map was made from."""
    dragon = settings.dragon
    return dragon.mesh, dragon.x, dragon.z, dragon.yaw, dragon.scale, dragon.sink
