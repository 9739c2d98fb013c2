"""The sound of the great hall: a stone room that rings, torches, drops in the pool."""

import numpy as np

from landscape.hall import plan
from landscape.hall.settings import Settings
from landscape.scene.scene import Terrain
from landscape.sound.room import Room
from landscape.sound.soundscape import Soundscape
from landscape.sound.steps import STONE

METRES = 17.0  # a unit: a walker's eye is 0.1 high
ABSORPTION = 0.14  # chosen: of stone with hangings, and with open alcoves; bare stone has 0.03


def hall_sounds(settings: Settings, terrain: Terrain) -> Soundscape:
    """Return what the hall sounds like; it is the same with all settings."""
    lights = np.array([plan.TORCH, *plan.PILLAR_TORCHES])
    lights[:, 1] += plan.TORCH_FLAME
    pool = plan.POOL
    drops = np.array([(pool.west + pool.east) / 2, 0.0, (pool.north + pool.south) / 2])
    return Soundscape(
        fires=lights,
        windy=0.0,
        ground=lambda x, y, z: STONE,
        grounds=(STONE,),
        room=room(),
        drops=drops,
    )


def room() -> Room:
    """Return the hall as a box up to halfway between the vault's springing and its crown."""
    wide = METRES * (plan.INSIDE.east - plan.INSIDE.west)
    long = METRES * (plan.INSIDE.south - plan.INSIDE.north)
    high = METRES * (plan.SPRINGING + plan.CROWN) / 2
    return Room(wide * long * high, 2 * (wide * long + (wide + long) * high), ABSORPTION)
