"""The plan of the hall: where everything stands. No OpenGL.

Units are the island's: a walker's eye is 0.1 high, so that a unit is some 17 metres. x points east,
z south, y up; the floor is y = 0. All measures are chosen.

The nave runs from the door in the south to the rose window in the north, between two rows of
pillars; beyond them are the aisles. The east wall has a window in each bay, the west wall an
alcove. The dragon's statue stands in the nave, and between it and the door lies the pool.
"""

from typing import NamedTuple


class Rectangle(NamedTuple):
    """A rectangle on the floor, in units."""

    west: float
    east: float
    north: float
    south: float


SIZE = 3.2  # the side of the square that holds the hall
INSIDE = Rectangle(1.0, 2.2, 0.4, 2.8)
AXIS = 1.6  # x of the middle of the nave

ROWS = (1.3, 1.9)  # x of the rows of pillars
BAYS = (0.4, 0.8, 1.2, 1.6, 2.0, 2.4, 2.8)  # z of the boundaries of the bays
PILLAR = 0.028  # radius
SPRINGING, CROWN = 0.44, 0.74  # heights where the vault begins, and of its top

# East wall: a lancet window in the middle of each bay.
WINDOW_HALF = 0.07
WINDOW_SILL = 0.17
WINDOW_SPRINGING = 0.46
WINDOW_TOP = 0.58
WINDOW_SPLAY = 0.012  # how much narrower windows are outside than inside, on each side
# North wall: a round window.
ROSE = (0.52, 0.13)  # height of its centre, and radius
# South wall: the door.
DOOR_HALF = 0.075
DOOR_SPRINGING, DOOR_TOP = 0.15, 0.22
DOOR_OPEN = 74.0  # degrees
WALL = 0.05  # thickness
# South wall, over the door: half the side of a hanging, and the height of its lower edge.
HANGING = (0.13, 0.375)

# West wall: an alcove in the middle of each bay.
ALCOVE_HALF, ALCOVE_DEPTH = 0.12, 0.20
ALCOVE_SPRINGING, ALCOVE_TOP = 0.20, 0.30
ALCOVES = tuple((north + south) / 2 for north, south in zip(BAYS, BAYS[1:], strict=False))

# Of the openings in the walls: half the width, and the heights of sill, springing and top.
WINDOW = WINDOW_HALF, WINDOW_SILL, WINDOW_SPRINGING, WINDOW_TOP
DOOR = DOOR_HALF, 0.0, DOOR_SPRINGING, DOOR_TOP
RECESS = ALCOVE_HALF, 0.0, ALCOVE_SPRINGING, ALCOVE_TOP

POOL = Rectangle(1.44, 1.76, 1.86, 2.34)
POOL_BED, POOL_WATER = -0.05, -0.008
RIM = 0.02  # width of the stone around the pool

FLOOR_BAND = 0.045  # half the width of the dark band along a row of pillars
MEDALLION = 0.255  # half the side of the medallion in the floor that the statue stands on

STATUE = (AXIS, 1.2)  # x, z of the plinth's centre
PLINTH = (0.185, 0.08)  # half its side, and height
STATUE_SCALE = 0.26  # of the mesh, which is 2 units long
BALL = 0.62  # radius of the ball that may stand there instead, in the same mesh
STATUE_SUNK = 0.010  # how deep it is let into the plinth
# Degrees: in profile from the door, so that its shadow shows the open jaws.
STATUE_YAW = -165.0

# The torch whose light casts the statue's shadow stands beside the pool, so far away that all the
# shadow of its head is on the nave's north wall; the others hang on pillars.
TORCH = (1.375, 0.26, 2.2)
TORCH_FLAME = 0.022  # height of the flame's brightest part above the torch
PILLAR_TORCHES = tuple(
    (x + side * 0.05, 0.2, z) for x, side in ((1.3, 1), (1.9, -1)) for z in (0.8, 1.6, 2.4)
)
