"""The hall's materials: texture, scale and tint of each. No OpenGL."""

from typing import NamedTuple


class Material(NamedTuple):
    """The file of a texture, how often it is repeated per unit, and a colour that multiplies it."""

    texture: str
    repeats: float
    tint: tuple[float, float, float] = (1.0, 1.0, 1.0)


SLAB = 0.06375  # chosen: side of a slab of the floor in units, an eighth of the nave's floor

# All chosen: a course of the walls is 0.025 units high, 0.4 m.
MATERIALS = {
    "stone": Material("hall_stone.png", 6.0),
    "wall": Material("hall_wall.png", 5.0),
    "vault": Material("hall_vault.png", 5.0),
    "plinth": Material("hall_stone.png", 8.0, (0.80, 0.80, 0.84)),
    "pool": Material("mosaic.png", 4.0),
    "wood": Material("hall_wood.png", 14.0),
    "iron": Material("hall_stone.png", 12.0, (0.36, 0.34, 0.33)),
    "alcove": Material("hall_floor.png", 1 / (4 * SLAB), (0.9, 0.9, 0.9)),
    "floor": Material("hall_floor.png", 1 / (4 * SLAB)),
    "band": Material("hall_band.png", 1.0),
    "hanging": Material("map.png", 1.0, (0.92, 0.88, 0.80)),
    "medallion": Material("hall_medallion.png", 1.0),
}
