"""The shadows of castle and animals on the ground, added to its shadow map (see shadows.py).

Sprites and stones, which are classes of the preset ``best`` themselves, cast their own.
"""

import numpy as np

from landscape.elements.animal import Animal
from landscape.elements.best.terrain.shadows import (
    SKY_HIDDEN,
    ShadowMap,
    cast_outlines,
    cast_points,
    shade_foot,
)
from landscape.elements.castle import Castle
from landscape.geometry.masonry import CORNERS, on_edges

FOOT_SHADE = 0.22  # chosen: units from the walls within which they block part of the sky


def cast_castle(castle: Castle, shadows: ShadowMap) -> None:
    """Cast the shadow of walls and towers, and darken the ground along their base."""
    step = 0.7 * shadows.texel
    for line, low, high in castle.outlines(step):
        cast_outlines(shadows, castle.outside(line), low, high, step)
    shade_foot(shadows, castle.outside(on_edges(CORNERS, FOOT_SHADE / 2)), FOOT_SHADE)


def cast_animal(animal: Animal, shadows: ShadowMap) -> None:
    """Cast an animal's shadow, a point per vertex, and darken the ground under it."""
    cast_points(shadows, animal.vertices())
    shadows.hide_sky(np.array([animal.place]), np.array([animal.reach]), SKY_HIDDEN)
