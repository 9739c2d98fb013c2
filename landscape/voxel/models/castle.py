"""The castle of cubes: curtain walls with a wall-walk, four towers, a gatehouse, a keep, a court.

x runs east, z south; the gate faces south. Everything is drawn from the plan below. A walker, 1.8
blocks high, comes in by the gate, up the stairs along the west wall to the wall-walk, all around it
through the towers and the gatehouse, and inside the keep up to its top. Sizes are chosen, in
blocks.
"""

import numpy as np

from landscape.voxel.blocks import block
from landscape.voxel.models.castle_court import court, yard
from landscape.voxel.models.castle_keep import flag, hall, keep
from landscape.voxel.models.shapes import disc, octagon

FLOOR = 12  # the level of the court's first free block; below it are foundations
PLAN = (37, 45)  # columns along x and z, the flight of steps in front of the gate included
WALK = FLOOR + 8  # the first free level above the wall-walk
WEST, EAST, NORTH, SOUTH = 4, 32, 8, 34  # the middle of each curtain wall
GATE = 15  # x of the western of the gate passage's three columns
STEPS = 7  # steps down in front of the gate
# From the middle of the plan to where the steps in front of the gate end, x and z.
DOORSTEP = (GATE + 1 - PLAN[0] // 2, SOUTH + 4 + STEPS - PLAN[1] // 2)
TALL = 56  # levels of room to build in

# x, z, radius of the room with its wall, blocks of wall above the wall-walk, height of the cone.
TOWERS = (
    (WEST, NORTH, 4, 5, 9),
    (EAST, NORTH, 3, 7, 7),
    (WEST, SOUTH, 3, 4, 7),
    (EAST, SOUTH, 4, 8, 10),
)


def castle() -> np.ndarray:
    """Return the castle, uint8 [x, z, y]; its court is at level FLOOR, in the middle of the plan.

    Put it with ``floor=FLOOR`` where the ground begins, after ``hollow`` has been emptied.
    """
    model = np.zeros((*PLAN, TALL), np.uint8)
    ground = _outline()
    model[..., :FLOOR][ground] = block("rock")
    yard(model, ground, FLOOR, GATE + 1, SOUTH)
    _walls(model)
    keep(model, FLOOR)
    hall(model, FLOOR)
    court(model, FLOOR)
    for tower in TOWERS:
        _tower(model, *tower)
    _gatehouse(model)
    _stairs(model)
    _steps(model)
    _ivy(model)
    return np.ascontiguousarray(model[..., : np.nonzero(model)[2].max() + 1])


def hollow(model: np.ndarray) -> np.ndarray:
    """Return which cells of the castle are to be air, bool [x, z, y]: within the walls, no block.

    Where the hill is higher than the court, they have to be emptied.
    """
    inside = np.zeros(model.shape, bool)
    inside[..., FLOOR:] = (_outline() | _front())[..., None]
    return inside & (model == 0)


def _outline() -> np.ndarray:
    """Return the columns that the castle stands on, bool PLAN."""
    x, z = np.ogrid[: PLAN[0], : PLAN[1]]
    found = (x >= WEST - 1) & (x <= EAST + 1) & (z >= NORTH - 1) & (z <= SOUTH + 1)
    for cx, cz, radius, _, _ in TOWERS:
        found |= disc(PLAN, (cx, cz), radius + 0.4)
    found |= (x >= GATE - 4) & (x <= GATE + 6) & (z >= SOUTH - 2) & (z <= SOUTH + 3)
    return np.asarray(found)


def _front() -> np.ndarray:
    """Return the columns of the steps in front of the gate."""
    found = np.zeros(PLAN, bool)
    found[GATE - 1 : GATE + 4, SOUTH + 4 : SOUTH + 4 + STEPS] = True
    return found


def _stone(model: np.ndarray, place: tuple[slice, slice, slice], dark: bool = False) -> None:
    model[place] = block("dark brick" if dark else "brick")


def _walls(model: np.ndarray) -> None:
    """Three blocks thick, dark at the foot, with merlons outside and the walk behind them."""
    for middle, along_x in ((WEST, False), (EAST, False), (NORTH, True), (SOUTH, True)):
        outer = middle - 1 if middle in (WEST, NORTH) else middle + 1
        start, end = (WEST, EAST) if along_x else (NORTH, SOUTH)
        band, run = slice(middle - 1, middle + 2), slice(start, end + 1)
        for across, along, levels, dark in (
            (band, run, slice(0, FLOOR + 2), True),
            (band, run, slice(FLOOR + 2, WALK), False),
            (slice(outer, outer + 1), run, slice(WALK, WALK + 1), False),
            (slice(outer, outer + 1), slice(start, end + 1, 2), slice(WALK + 1, WALK + 2), False),
        ):
            plan = (along, across) if along_x else (across, along)
            _stone(model, (*plan, levels), dark)

        # A dark course below the walk, and slits between.
        plan = (run, slice(outer, outer + 1)) if along_x else (slice(outer, outer + 1), run)
        _stone(model, (*plan, slice(WALK - 1, WALK)), dark=True)
        for slit in range(start + 7, end - 5, 7):
            where = (slit, outer) if along_x else (outer, slit)
            model[(*where, slice(FLOOR + 4, FLOOR + 6))] = block("pane")


def _tower(model: np.ndarray, x: int, z: int, radius: int, above: int, cone: int) -> None:
    """A round tower: solid below the walk, a room with doors to both walls, a cone of slate."""
    shell, room = disc(PLAN, (x, z), radius + 0.4), disc(PLAN, (x, z), radius - 0.6)
    top = WALK + above
    model[..., :WALK][shell] = block("brick")
    model[..., : FLOOR + 2][shell] = block("dark brick")
    model[..., WALK:top][shell] = block("brick")
    model[..., WALK : top - 1][room] = 0
    model[..., WALK - 1][room] = block("planks")
    ring = shell & ~room
    model[..., WALK - 1][ring] = block("dark brick")
    inward = (1 if x == WEST else -1, 1 if z == NORTH else -1)
    _tower_doors(model, x, z, radius, inward)
    _tower_windows(model, x, z, radius, inward)
    model[x, z, top - 2] = block("lamp")  # hangs from the ceiling
    _tower_roof(model, x, z, radius, top, cone)


def _tower_windows(model: np.ndarray, x: int, z: int, radius: int, inward: tuple[int, int]) -> None:
    """Windows of a tower look outward, the lower ones with panes."""
    for dx, dz in ((-inward[0], 0), (0, -inward[1])):
        at = (x + dx * radius, z + dz * radius)
        model[(*at, slice(WALK + 1, WALK + 3))] = 0
        model[(*at, slice(FLOOR + 3, FLOOR + 5))] = block("pane")
        model[(*at, slice(FLOOR + 2, FLOOR + 6, 3))] = block("dark brick")


def _tower_doors(model: np.ndarray, x: int, z: int, radius: int, inward: tuple[int, int]) -> None:
    """Doors where the walk meets a tower, two blocks wide and three high."""
    sides = slice(*sorted((x, x + inward[0] * 1))), slice(*sorted((z, z + inward[1] * 1)))
    near_x = slice(sides[0].start, sides[0].start + 2)
    near_z = slice(sides[1].start, sides[1].start + 2)
    far_x = slice(x + 1, x + radius + 1) if inward[0] > 0 else slice(x - radius, x)
    far_z = slice(z + 1, z + radius + 1) if inward[1] > 0 else slice(z - radius, z)
    model[far_x, near_z, WALK : WALK + 3] = 0
    model[near_x, far_z, WALK : WALK + 3] = 0


def _tower_roof(model: np.ndarray, x: int, z: int, radius: int, top: int, cone: int) -> None:
    """A jutting course under the eaves, then the cone."""
    model[..., top - 1][disc(PLAN, (x, z), radius + 0.4)] = block("dark brick")
    for level in range(cone):
        wide = (radius + 1.2) * (1 - level / cone) + 0.15
        model[..., top + level][disc(PLAN, (x, z), wide)] = block("slate")
    flag(model, x, z, top + cone)


def _gatehouse(model: np.ndarray) -> None:
    """Two octagonal turrets beside an open passage, a guardroom over it, red banners."""
    turrets = (GATE - 3, GATE + 5)
    top = WALK + 5
    body = (slice(GATE - 3, GATE + 6), slice(SOUTH - 2, SOUTH + 3))
    _stone(model, (*body, slice(0, FLOOR + 2)), dark=True)
    _stone(model, (*body, slice(FLOOR + 2, top)))
    _turrets(model, dict(zip(turrets, (top + 2, top + 3), strict=True)))
    _passage(model)
    _guardroom(model)
    _stone(model, (*body, slice(top - 1, top)), dark=True)
    for x in range(GATE - 3, GATE + 6, 2):
        model[x, SOUTH - 2 : SOUTH + 3 : 4, top] = block("brick")
    _banners(model, turrets)


def _turrets(model: np.ndarray, heights: dict[int, int]) -> None:
    """Octagonal turrets under cones of slate, each with a lamp, by their x."""
    for x, tall in heights.items():
        turret = octagon(PLAN, (x, SOUTH + 2), 2.4)
        model[..., :tall][turret] = block("brick")
        model[..., : FLOOR + 2][turret] = block("dark brick")
        model[..., tall - 1][turret] = block("dark brick")
        for level, wide in enumerate((3.4, 2.9, 2.3, 2.0, 1.5, 1.0, 0.5, 0.2)):
            model[..., tall + level][disc(PLAN, (x, SOUTH + 2), wide)] = block("slate")
        model[x, SOUTH + 4, WALK + 3 : WALK + 5] = block("lamp")


def _passage(model: np.ndarray) -> None:
    """The passage, an arch six blocks high, the raised grille in it."""
    passage = slice(SOUTH - 3, SOUTH + 5)
    model[GATE : GATE + 3, passage, FLOOR : FLOOR + 5] = 0
    model[GATE + 1, passage, FLOOR + 5] = 0
    model[GATE : GATE + 3, passage, FLOOR - 1] = block("gravel")
    model[GATE : GATE + 3 : 2, SOUTH + 1, FLOOR + 4] = block("dark")
    model[GATE + 1, SOUTH + 1, FLOOR + 5] = block("dark")
    model[GATE : GATE + 3, SOUTH - 2, FLOOR + 5] = block("planks")
    model[GATE - 1 : GATE + 4 : 4, SOUTH + 3, FLOOR + 3] = block("lamp")


def _guardroom(model: np.ndarray) -> None:
    """The guardroom, through which the wall-walk goes."""
    room = (slice(GATE - 5, GATE + 8), slice(SOUTH - 1, SOUTH + 1))
    model[(*room, slice(WALK, WALK + 3))] = 0
    model[(*room, slice(WALK - 1, WALK))] = block("planks")
    model[GATE + 1, SOUTH - 1 : SOUTH + 1, WALK + 3] = block("lamp")
    model[GATE : GATE + 3 : 2, SOUTH - 2, WALK + 1 : WALK + 3] = 0
    model[GATE : GATE + 3 : 2, SOUTH + 1 : SOUTH + 3, WALK + 1 : WALK + 3] = 0


def _banners(model: np.ndarray, turrets: tuple[int, int]) -> None:
    """A banner over the arch, and one on each turret that ends in a point."""
    model[GATE + 1, SOUTH + 3, FLOOR + 7 : WALK + 3] = block("red cloth")
    model[GATE : GATE + 3, SOUTH + 3, WALK + 3] = block("oak log")
    for x in turrets:
        model[x - 1 : x + 2, SOUTH + 5, FLOOR + 5 : WALK + 1] = block("red cloth")
        model[x, SOUTH + 5, FLOOR + 4] = block("red cloth")
        model[x, SOUTH + 5, FLOOR + 7 : WALK] = block("light fur")
        model[x - 1 : x + 2, SOUTH + 5, WALK + 1] = block("oak log")


def _stairs(model: np.ndarray) -> None:
    """Two blocks wide along the west wall, eight steps from the court to the wall-walk."""
    for step in range(WALK - FLOOR):
        z = NORTH + 10 + step
        _stone(model, (slice(WEST + 2, WEST + 4), slice(z, z + 1), slice(FLOOR, FLOOR + step + 1)))
    end = NORTH + 10 + WALK - FLOOR
    _stone(model, (slice(WEST + 2, WEST + 4), slice(end, end + 2), slice(FLOOR, WALK)))
    # A room under the landing.
    model[WEST + 2 : WEST + 4, end - 2 : end + 1, FLOOR : FLOOR + 3] = block("dark brick")
    model[WEST + 3, end, FLOOR : FLOOR + 2] = block("planks")


def _steps(model: np.ndarray) -> None:
    """A flight of steps from the gate down the hill, between two low walls with lamps."""
    for step in range(STEPS):
        z = SOUTH + 4 + step
        level = FLOOR - max(step - 1, 0)
        model[GATE - 1 : GATE + 4, z, :level] = block("dark brick")
        model[GATE : GATE + 3, z, level - 1] = block("gravel")
    for x in (GATE - 1, GATE + 3):
        end = SOUTH + 3 + STEPS
        level = FLOOR - STEPS + 2
        model[x, end, level : level + 2] = block("brick")
        model[x, end, level + 2] = block("lamp")


def _ivy(model: np.ndarray) -> None:
    """Ivy climbs the southern wall beside the great tower, and the tower of the north-west."""
    for x, low, high in ((23, 3, 6), (24, 0, 7), (25, 2, 8), (26, 1, 5), (27, 0, 6)):
        model[x, SOUTH + 2, FLOOR + low : FLOOR + high] = block("oak leaves")
    for x, low, high in ((WEST - 1, 1, 5), (WEST, 0, 9), (WEST + 1, 3, 8)):
        model[x, NORTH - 5, FLOOR + low : FLOOR + high] = block("oak leaves")
