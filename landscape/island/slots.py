"""The places of the island's elements, in the order in which they are built.

In each the finest class comes first: a technique of 2006 is built where nothing asks for more.
"""

from landscape.elements.best.animals.fine_dragon import FineDragon
from landscape.elements.best.animals.fine_rabbit import FineRabbit
from landscape.elements.best.castle.gate import CastleInOnePass
from landscape.elements.best.castle.ornate_castle import OrnateCastle
from landscape.elements.best.castle.weathered_castle import WeatheredCastle
from landscape.elements.best.meadow.meadow import Meadow
from landscape.elements.best.mist.bay_mist import BayMist
from landscape.elements.best.sea.occlusion_query import SeaQuery
from landscape.elements.best.sea.ring import HorizonRing
from landscape.elements.best.sea.sea import Sea
from landscape.elements.best.sea.under_water import UnderWater
from landscape.elements.best.sky.fine_sky import FineSky
from landscape.elements.best.sprites.refined_sprites import RefinedSprites
from landscape.elements.best.stones.stones import Stones
from landscape.elements.best.sword.shining_sword import ShiningSword
from landscape.elements.best.sword.steel_blade import SteelBlade
from landscape.elements.best.terrain.terrain import Terrain
from landscape.elements.castle import Castle
from landscape.elements.dragon import Dragon
from landscape.elements.element import Slot
from landscape.elements.grass import Grass
from landscape.elements.ground import Ground
from landscape.elements.map import Map
from landscape.elements.rabbit import Rabbit
from landscape.elements.sky_box import SkyBox
from landscape.elements.sword import Sword
from landscape.elements.transparent_elements import SPRITES, TransparentElements
from landscape.elements.water_surface import WaterSurface

GROUND = Slot("ground", (Terrain, Ground), always=True, base=True)  # everything stands on it
CASTLE = Slot("castle", (WeatheredCastle, OrnateCastle, CastleInOnePass, Castle))
RABBIT = Slot("rabbit", (FineRabbit, Rabbit))
SKY = Slot("sky", (FineSky, SkyBox))
DRAGON = Slot("dragon", (FineDragon, Dragon))
PLANTED = Slot("sprites", (RefinedSprites, TransparentElements), shown_by=SPRITES)
GRASS = Slot("grass", (Meadow, Grass))
SWORD = Slot("sword", (SteelBlade, ShiningSword, Sword))

# Elements that cast shadows are built before the ground is lit, which darkens the grass as well.
CASTING = (
    GROUND,
    Slot("stones", (Stones,), shown_by=("ground",)),
    Slot("water", (Sea, WaterSurface)),
    Slot("ring", (HorizonRing,), shown_by=("water",)),
    Slot("query", (SeaQuery,), shown_by=("water",)),
    Slot("under", (UnderWater,), shown_by=("water",)),
    SKY,
    CASTLE,
    RABBIT,
    DRAGON,
    PLANTED,
)
OTHERS = (
    GRASS,
    Slot("mist", (BayMist,)),
    SWORD,
    Slot("map", (Map,)),
)
SLOTS = (*CASTING, *OTHERS)
