"""What a walker can do in the island in voxels: move his body among its blocks."""

import math

from landscape.geometry.bodies import Body, Wish
from landscape.geometry.obstacles import MARGIN
from landscape.voxel import body as bodies
from landscape.voxel.land import Land
from landscape.voxel.settings import Settings


class Played:
    """The part of the scene that a walker plays with."""

    settings: Settings
    land: Land

    def moved(self, body: Body, wish: Wish, seconds: float) -> Body:
        """Return a walker's body ``seconds`` later, in units."""
        world, block = self.land.world, self.land.scale
        swims = self.settings.walk.swim
        place = bodies.Place(
            world.blocks,
            water=world.water if swims else -math.inf,
            margin=MARGIN / block,
            floor=-math.inf if swims else world.water,
        )
        inside = body.scaled(1 / block), wish.scaled(1 / block)
        return bodies.moved(place, *inside, seconds).scaled(block)
