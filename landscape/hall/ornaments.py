"""What stands against the hall's shell: pillars, ribs, mouldings, tracery, door, torches.

No OpenGL. Each piece is a profile moved along a path, or turned about an upright axis.
"""

from dataclasses import replace

import numpy as np

from landscape.hall import plan
from landscape.hall.shapes import (
    STEPS,
    Curve,
    Profile,
    across_x,
    across_z,
    arch,
    around,
    circle,
    flat,
    outline,
    pointed,
    seen_from,
    sweep,
    turned,
)
from landscape.hall.surfaces import Edge, Surface

UP = np.array([0.0, 1.0, 0.0])

# Profiles of mouldings: aside, and away from what they sit on. All chosen.
TRANSVERSE: Profile = [
    (-0.017, -0.012),
    (-0.017, 0.012),
    (-0.012, 0.015),
    (-0.007, 0.024),
    (0.007, 0.024),
    (0.012, 0.015),
    (0.017, 0.012),
    (0.017, -0.012),
]
DIAGONAL: Profile = [
    (-0.010, -0.012),
    (-0.010, 0.006),
    (-0.005, 0.016),
    (0.005, 0.016),
    (0.010, 0.006),
    (0.010, -0.012),
]
HOOD: Profile = [
    (-0.002, 0.0),
    (-0.004, 0.006),
    (0.004, 0.012),
    (0.012, 0.009),
    (0.017, 0.010),
    (0.019, 0.0),
]
COURSE: Profile = [(-0.010, 0.0), (-0.006, 0.011), (0.002, 0.013), (0.006, 0.0)]
BAR: Profile = [
    (-0.0055, -0.006),
    (-0.0055, 0.004),
    (-0.002, 0.010),
    (0.002, 0.010),
    (0.0055, 0.004),
    (0.0055, -0.006),
]

STRAP: Profile = [(-0.006, 0.0), (-0.005, 0.002), (0.005, 0.002), (0.006, 0.0)]

WITHIN = 0.97  # chosen: a ring that closes a joint begins a little inside the other piece
SHAFT, CORE = 0.34, 0.78  # of a pillar's radius: its four shafts, and the core between them


def clustered(turn: np.ndarray) -> np.ndarray:
    """Return the outline of a clustered pillar at angles ``turn``: a core and four shafts."""
    from_shaft = (turn + np.pi / 4) % (np.pi / 2) - np.pi / 4
    centre = 1.0 - SHAFT
    aside = centre * np.abs(np.sin(from_shaft))
    shaft = centre * np.cos(from_shaft) + np.sqrt(np.maximum(SHAFT**2 - aside**2, 0.0))
    return np.where(aside < SHAFT, np.maximum(shaft, CORE), CORE)


def lobed(turn: np.ndarray) -> np.ndarray:
    """Return the outline of a capital at angles ``turn``: eight lobes."""
    return 1.0 + 0.09 * np.abs(np.cos(4 * turn)) - 0.04


def octagon(turn: np.ndarray) -> np.ndarray:
    """Return the outline of a regular octagon with corners at distance 1, at angles ``turn``."""
    return np.cos(np.pi / 8) / np.cos(turn % (np.pi / 4) - np.pi / 8)


def joint(x: float, z: float, edge: Edge, outline: Curve, radius: float, up: bool) -> Surface:
    """Return a level ring from an edge of a turned piece to another outline about x, z.

    It closes the hole between two pieces of different outline. ``outline`` times ``radius`` is the
    other side of the ring; ``up`` says whether it is seen from above, or from below.
    """
    rim = edge.surface.points[edge.row]
    east, south = rim[:, 0] - x, rim[:, 2] - z
    turn = np.arctan2(south, east)
    distance = radius * outline(turn)
    other = np.stack([x + distance * np.cos(turn), rim[:, 1], z + distance * np.sin(turn)], axis=-1)
    outwards = distance.mean() > np.hypot(east, south).mean()
    rows = [rim, other] if outwards == up else [other, rim]
    return Surface(np.stack(rows), "stone", edge=edge)


def pillar(x: float, z: float) -> list[Surface]:
    """Return a pillar: an octagonal foot, a clustered shaft with rings, and a capital.

    Foot, shaft and capital have different outlines; rings close what is open between them.
    """
    r, top = plan.PILLAR, plan.SPRINGING

    foot = [(r + 0.010, 0.034), (r + 0.016, 0.032), (r + 0.020, 0.0)]
    base = [
        (r, 0.058),
        (r + 0.003, 0.052),
        (r + 0.008, 0.049),
        (r + 0.008, 0.044),
        (r + 0.003, 0.040),
        (r + 0.010, 0.034),
    ]
    bell = [
        (r + 0.024, top - 0.022),
        (r + 0.010, top - 0.036),
        (r + 0.002, top - 0.058),
        (r + 0.005, top - 0.062),
        (r + 0.005, top - 0.067),
        (r, top - 0.070),
    ]
    slab = [
        (r + 0.020, top + 0.012),
        (r + 0.030, top + 0.006),
        (r + 0.030, top - 0.012),
        (r + 0.024, top - 0.022),
    ]
    ring = turned(
        x,
        z,
        [(r, 0.256), (r + 0.005, 0.252), (r + 0.005, 0.246), (r, 0.242)],
        "stone",
        24,
        clustered,
    )
    under = turned(x, z, base, "stone", 24, clustered)
    capital = turned(x, z, bell, "stone", 32, lobed)
    return [
        turned(x, z, foot, "stone", 8, octagon),
        under,
        turned(x, z, [(r, top - 0.068), (r, 0.056)], "stone", 24, clustered),
        ring,
        capital,
        turned(x, z, slab, "stone", 8, octagon),
        turned(x, z, [(0.0, top + 0.013), (r + 0.020, top + 0.012)], "stone", 8, octagon),
        joint(x, z, Edge(under, -1), octagon, r + 0.010, up=True),
        joint(x, z, Edge(capital, -1), clustered, WITHIN * r, up=False),
        joint(x, z, Edge(capital, 0), octagon, WITHIN * (r + 0.024), up=True),
    ]


def corbel(x: float, z: float) -> list[Surface]:
    """Return the stone in a wall that ribs spring from."""
    top = plan.SPRINGING
    profile = [
        (0.0, top + 0.012),
        (0.034, top + 0.010),
        (0.034, top - 0.010),
        (0.026, top - 0.018),
        (0.016, top - 0.045),
        (0.018, top - 0.052),
        (0.010, top - 0.062),
        (0.0, top - 0.072),
    ]
    return [turned(x, z, profile, "stone", 12)]


def rib(start: tuple[float, float], end: tuple[float, float], profile: Profile) -> Surface:
    """Return a rib of the vault that follows its pointed arch from ``start`` to ``end`` (x, z)."""
    begin, finish = np.array(start), np.array(end)
    middle, half = (begin + finish) / 2, (finish - begin) / 2
    level = middle + STEPS[:, None] * half
    height = plan.SPRINGING + (plan.CROWN - plan.SPRINGING) * arch(STEPS)
    path = np.stack([level[:, 0], height, level[:, 1]], axis=-1)
    along = np.gradient(path, axis=0)
    aside = np.array([-half[1], 0.0, half[0]])
    out = np.cross(along, aside / np.linalg.norm(aside))
    out *= -np.sign((out * UP).sum()) / np.linalg.norm(out, axis=1, keepdims=True)
    return sweep(path, out, profile)


def ribs() -> list[Surface]:
    """Return arches between the bays, ribs along the groins, and a boss at each crown."""
    edges = (plan.INSIDE.west, *plan.ROWS, plan.INSIDE.east)
    bays = list(zip(plan.BAYS, plan.BAYS[1:], strict=False))
    found = []
    for west, east in zip(edges, edges[1:], strict=False):
        found += [rib((west, z), (east, z), TRANSVERSE) for z in plan.BAYS]
        for north, south in bays:
            found.append(rib((west, north), (east, south), DIAGONAL))
            found.append(rib((west, south), (east, north), DIAGONAL))
            boss = [
                (0.030, 0.002),
                (0.030, -0.010),
                (0.024, -0.016),
                (0.018, -0.016),
                (0.013, -0.022),
                (0.0, -0.025),
            ]
            place = [(radius, plan.CROWN + height) for radius, height in boss]
            found.append(turned((west + east) / 2, (north + south) / 2, place, "stone", 12))

    for x in edges:
        found += [rib((x, north), (x, south), TRANSVERSE) for north, south in bays]
    return found


def bars(paths: list[np.ndarray], out: np.ndarray) -> list[Surface]:
    """Return tracery along paths (n, 3): bars of stone that face ``out``."""
    return [sweep(path, out, BAR, density=0.8) for path in paths]


def window_tracery(middle: float) -> list[Surface]:
    """Return a window's tracery: a mullion, two pointed lights, and a circle above them."""
    to = across_x(plan.INSIDE.east + plan.WALL - 0.006)
    half = plan.WINDOW_HALF - plan.WINDOW_SPLAY
    top, sill = plan.WINDOW_TOP - plan.WINDOW_SPLAY, plan.WINDOW_SILL
    springing = plan.WINDOW_SPRINGING - 0.03
    rise = 0.05
    paths = [to(np.full(2, middle), np.array([springing, sill]))]
    for side in (-1, 1):
        light = middle + side * half / 2
        along = light + half / 2 * STEPS
        paths.append(to(along, pointed(light, half / 2, springing, springing + rise)(along)))
    turn = np.linspace(0.0, 2 * np.pi, 21)
    radius = 0.021
    centre = top - 0.048
    paths.append(to(middle + radius * np.cos(turn), centre + radius * np.sin(turn)))
    frame = half, sill, plan.WINDOW_SPRINGING, top
    paths.append(outline(middle, frame, to))
    return bars(paths, np.array([-1.0, 0.0, 0.0]))


def rose_tracery() -> list[Surface]:
    """Return the round window's tracery: an eye, spokes, and a ring of pointed petals."""
    height, radius = plan.ROSE
    radius -= plan.WINDOW_SPLAY
    centre = np.array([plan.AXIS, height, plan.INSIDE.north - plan.WALL + 0.006])
    right, up = np.array([1.0, 0.0, 0.0]), UP
    turn = np.linspace(0.0, 2 * np.pi, 49)
    eye, petal = 0.028, 0.082
    paths = [circle(centre, right, up, each, turn) for each in (eye, radius)]
    count = 12
    for k in range(count):
        angle = 2 * np.pi * k / count
        spoke = np.cos(angle) * right + np.sin(angle) * up
        paths.append(centre + np.array([[eye], [petal]]) * spoke)
        across = np.linspace(-1.0, 1.0, 13)
        turns = angle + np.pi / count * (1 + across)
        reach = petal + 0.030 * np.sqrt(np.maximum(1 - across**2, 0.0))
        ring = np.cos(turns)[:, None] * right + np.sin(turns)[:, None] * up
        paths.append(centre + reach[:, None] * ring)

    return bars(paths, np.array([0.0, 0.0, 1.0]))


def mouldings() -> list[Surface]:
    """Return hood moulds over the openings, string courses, plinth course and the rose's ring."""
    inside = plan.INSIDE
    found = []
    west, east = np.array([1.0, 0.0, 0.0]), np.array([-1.0, 0.0, 0.0])
    north, south = np.array([0.0, 0.0, 1.0]), np.array([0.0, 0.0, -1.0])
    for middle in plan.ALCOVES:
        # From north to south seen from within, so that the profile's right side is outside.
        found.append(hood(outline(middle, plan.WINDOW, across_x(inside.east)), east))
        found.append(hood(outline(middle, plan.RECESS, across_x(inside.west)), west))

    found.append(hood(outline(plan.AXIS, plan.DOOR, across_z(inside.south)), south))
    height, radius = plan.ROSE
    ring = circle(
        np.array([plan.AXIS, height, inside.north]),
        np.array([1.0, 0.0, 0.0]),
        UP,
        radius,
        np.linspace(0.0, 2 * np.pi, 49),
    )
    found.append(hood(ring, north))
    long, wide = np.array([inside.north, inside.south]), np.array([inside.west, inside.east])
    for to, ends, out, y in (
        (across_x(inside.east), long, east, plan.WINDOW_SILL - 0.016),
        (across_x(inside.west), long, west, plan.ALCOVE_TOP + 0.040),
        (across_z(inside.north), wide, north, plan.ALCOVE_TOP + 0.040),
        (across_z(inside.south), wide, south, plan.ALCOVE_TOP + 0.040),
    ):
        found.append(sweep(to(ends, np.full(2, y)), out, COURSE))

    return found


def hood(path: np.ndarray, out: np.ndarray) -> Surface:
    """Return a hood mould just outside an opening's outline (n, 3)."""
    middle = path.mean(axis=0)
    along = np.gradient(path, axis=0)
    aside = np.cross(along, out)
    profile = HOOD
    if ((path - middle) * aside).sum() < 0:
        profile = [(-side, away) for side, away in HOOD]
    return sweep(path, out, profile)


def plinth() -> list[Surface]:
    """Return the plinth of the statue: two steps, a die with mouldings, and a top."""
    (x, z), (half, top) = plan.STATUE, plan.PLINTH
    die = half - 0.022
    inner = plan.Rectangle(x - die, x + die, z - die, z + die)

    profile = [
        (0.012, top - 0.003),
        (0.014, top - 0.008),
        (0.012, top - 0.013),
        (0.006, top - 0.016),
        (0.001, top - 0.024),
    ]
    lower = [(0.001, 0.034), (0.006, 0.028), (0.012, 0.024), (0.013, 0.020)]

    found = around(inner, profile, "plinth") + around(
        inner, [(0.001, top - 0.024), (0.001, 0.034)], "plinth"
    )
    found += around(inner, lower, "plinth") + around(
        inner, [(0.022, 0.020), (0.022, 0.0)], "plinth"
    )
    found += around(inner, [(0.013, 0.020), (0.022, 0.020)], "plinth")
    found += around(inner, [(0.0, top), (0.010, top), (0.012, top - 0.003)], "plinth")
    return [*found, replace(flat(inner, top, "plinth"), density=2.0)]


def hanging() -> list[Surface]:
    """Return the map of the island that hangs over the door, and the rod that it hangs from."""
    (half, low), z = plan.HANGING, plan.INSIDE.south - 0.006
    east = plan.AXIS + half
    west = plan.AXIS - half
    top = low + 2 * half
    # Whoever looks south has the east at the left.
    points = np.array([[[east, top, z], [west, top, z]], [[east, low, z], [west, low, z]]])
    cloth = Surface(points, "hanging", np.array([[[0.0, 0], [1, 0]], [[0, 1], [1, 1]]]), 1.5)
    rod = np.array([[east + 0.012, top + 0.003, z], [west - 0.012, top + 0.003, z]])
    square = [(-0.004, -0.004), (-0.004, 0.004), (0.004, 0.004), (0.004, -0.004), (-0.004, -0.004)]
    return [cloth, sweep(rod, np.array([0.0, 0.0, -1.0]), square, "wood")]


def pool_rim() -> list[Surface]:
    """Return the stone around the pool."""
    width, high = plan.RIM, 0.010
    outer = [(width - 0.002, high), (width, high - 0.003), (width, 0.0)]
    top = [(0.002, high), (width - 0.002, high)]
    found = around(plan.POOL, outer) + around(plan.POOL, top)
    within = around(plan.POOL, [(0.0, 0.0), (0.0, high - 0.003), (0.002, high)])
    # This part faces the pool; its rows run upwards, which turns it round.
    return found + within


def door_leaves() -> list[Surface]:
    """Return the door's two leaves of wood with bands of iron, open to the inside."""
    half, top = plan.DOOR_HALF, plan.DOOR_TOP
    found = []
    for side in (-1, 1):
        hinge = np.array([plan.AXIS + side * half, 0.0, plan.INSIDE.south])
        turn = np.radians(plan.DOOR_OPEN)
        along = np.array([-side * np.cos(turn), 0.0, -np.sin(turn)])
        thick = 0.008 * np.array([-side * np.sin(turn), 0.0, np.cos(turn)])
        s = half * (1 + STEPS[: len(STEPS) // 2 + 1])
        head = plan.DOOR_SPRINGING + (top - plan.DOOR_SPRINGING) * arch(s / half - 1)
        low = hinge + s[:, None] * along
        high = low + head[:, None] * UP
        plain = np.stack([np.stack([s, s]), np.stack([-head, 0 * head])], axis=-1)
        face = Surface(np.stack([high, low]), "wood", plain)
        back = Surface(np.stack([high, low]) + thick, "wood", plain)
        centre = face.points.mean(axis=(0, 1)) + thick / 2
        found.append(seen_from(face, centre - 10 * thick))
        found.append(seen_from(back, centre + 10 * thick))
        rim = np.concatenate([high, low[::-1]])
        found.append(
            seen_from(
                Surface(np.stack([rim, rim + thick]), "wood"), 2 * np.stack([rim, rim]) - centre
            )
        )
        for y in (0.035, 0.125):
            for out, start in ((-thick, low), (thick, low + thick)):
                strip = start[[0, -2]] + y * UP
                found.append(sweep(strip, out / 0.008, STRAP, "iron"))

    return found


def torch(x: float, y: float, z: float) -> list[Surface]:
    """Return the iron bowl of a torch whose flame begins at ``y``."""
    bowl = [
        (0.0, y - 0.006),
        (0.015, y - 0.002),
        (0.0180, y + 0.002),
        (0.0195, y + 0.002),
        (0.0195, y - 0.001),
        (0.0175, y - 0.002),
        (0.0170, y - 0.008),
        (0.0145, y - 0.015),
        (0.0090, y - 0.022),
        (0.0050, y - 0.025),
        (0.0065, y - 0.028),
        (0.0040, y - 0.031),
        (0.0, y - 0.040),
    ]
    return [turned(x, z, bowl, "iron", 20)]


def torches() -> list[Surface]:
    """Return the torches: one that stands, and those on the pillars' brackets."""
    x, y, z = plan.TORCH
    found = torch(x, y, z)
    stem = [
        (0.004, y - 0.02),
        (0.004, 0.105),
        (0.008, 0.100),
        (0.004, 0.095),
        (0.004, 0.02),
        (0.010, 0.016),
        (0.028, 0.006),
        (0.030, 0.0),
    ]
    found.append(turned(x, z, stem, "iron", 16))
    for x, y, z in plan.PILLAR_TORCHES:
        found += torch(x, y, z)
        row = min(plan.ROWS, key=lambda each: abs(each - x))
        arm = np.array([[row, y - 0.055, z], [x, y - 0.030, z]])
        found.append(
            sweep(
                arm,
                UP,
                [
                    (-0.003, -0.003),
                    (-0.003, 0.003),
                    (0.003, 0.003),
                    (0.003, -0.003),
                    (-0.003, -0.003),
                ],
                "iron",
            )
        )

    return found


def ornaments() -> list[Surface]:
    """Return all of it."""
    inside = plan.INSIDE
    found = [part for x in plan.ROWS for z in plan.BAYS[1:-1] for part in pillar(x, z)]
    for x in (inside.west, inside.east):
        found += [part for z in plan.BAYS for part in corbel(x, z)]
    for z in (inside.north, inside.south):
        found += [part for x in plan.ROWS for part in corbel(x, z)]
    found += ribs() + mouldings() + plinth() + pool_rim() + door_leaves() + hanging() + torches()
    for middle in plan.ALCOVES:
        found += window_tracery(middle)
    return found + rose_tracery()
