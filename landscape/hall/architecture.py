"""The hall's shell as surfaces: floor, pool, walls with their openings, and vault. No OpenGL.

Mouldings, tracery, pillars and what else stands against the shell are in ornaments.py.
"""

import numpy as np

from landscape.hall import plan
from landscape.hall.ornaments import ornaments
from landscape.hall.shapes import (
    STEPS,
    Place,
    across_x,
    across_z,
    arch,
    around,
    bay_arch,
    circle,
    flat,
    halves,
    level,
    outline,
    pointed,
    seen_from,
    upright,
)
from landscape.hall.surfaces import Surface

Opening = tuple[float, float, float, float]  # half width, sill, springing, top


def bay_columns(bay: tuple[float, float], low: float, high: float) -> np.ndarray:
    """Return the distances along a bay's wall from ``low`` to ``high`` where the vault bends."""
    inside = halves(*bay)
    inside = inside[(inside > low + 1e-6) & (inside < high - 1e-6)]
    return np.concatenate([[low], inside, [high]])


def wall_with_opening(bay: tuple[float, float], opening: Opening, to: Place) -> list[Surface]:
    """Return a bay's wall around a pointed opening in its middle.

    ``bay`` is where the bay begins and ends along the wall.
    """
    (low, high), (half, sill, springing, top) = bay, opening
    middle = (low + high) / 2
    vault = bay_arch(low, high)
    head = pointed(middle, half, springing, top)
    between = halves(middle - half, middle + half)
    both = np.union1d(between, bay_columns(bay, middle - half, middle + half))
    parts = [
        upright(bay_columns(bay, low, middle - half), level(0.0), vault, to),
        upright(bay_columns(bay, middle + half, high), level(0.0), vault, to),
        upright(both, head, vault, to),
    ]
    return parts + ([upright(between[[0, -1]], level(0.0), level(sill), to)] if sill > 0 else [])


def embrasure(
    middle: float, opening: Opening, to: Place, depth: np.ndarray, splay: float
) -> list[Surface]:
    """Return the sides of an opening, ``depth`` (3,) deep; outside it is narrower by ``splay``."""
    half, sill, springing, top = opening
    inner = outline(middle, opening, to)
    narrow = half - splay, sill + 2 * splay * (sill > 0), springing, top - splay
    outer = outline(middle, narrow, to) + depth
    centre = (inner.mean(axis=0) + outer.mean(axis=0)) / 2
    sides = [jambs(inner, outer)]
    if sill > 0:
        ends = np.stack([inner[[0, -1]], outer[[0, -1]]])
        sides.append(Surface(ends, "stone"))
    return [seen_from(side, centre) for side in sides]


def jambs(inner: np.ndarray, outer: np.ndarray) -> Surface:
    """Return the sides between an opening's two outlines (n, 3), their courses level."""
    along = np.linalg.norm(np.diff(inner, axis=0), axis=1)
    risen = np.concatenate([[0.0], np.cumsum(along)])
    deep = np.linalg.norm(outer - inner, axis=1)
    plain = np.stack([np.stack([0 * deep, deep]), np.stack([-risen, -risen])], axis=-1)
    return Surface(np.stack([inner, outer]), "wall", plain)


def vault_web(x: tuple[float, float], z: tuple[float, float], side: int) -> Surface:
    """Return one of the four webs of a groin vault over a bay: two pointed tunnels that cross.

    The web of ``side`` 0 to 3 lies between the bay's edge and the two groins; on it the ceiling is
    the tunnel that runs across that edge, straight from the edge to the groin.
    """
    half_x, half_z = (x[1] - x[0]) / 2, (z[1] - z[0]) / 2
    along = np.stack([STEPS, STEPS])
    outwards = np.stack([np.ones_like(STEPS), np.abs(STEPS)]) * (1 if side % 2 else -1)
    u, v = (outwards, along) if side < 2 else (along, outwards)
    height = plan.SPRINGING + (plan.CROWN - plan.SPRINGING) * arch(along)
    points = np.stack([sum(x) / 2 + half_x * u, height, sum(z) / 2 + half_z * v], axis=-1)
    bent = np.linalg.norm(np.diff(points[0], axis=0), axis=1)
    course = np.broadcast_to(np.concatenate([[0.0], np.cumsum(bent)]), along.shape)
    straight = outwards * (half_x if side < 2 else half_z)
    return Surface(points, "vault", np.stack([straight, course], axis=-1), 0.8)


def vault() -> list[Surface]:
    """Return the vault: four webs over each bay of nave and aisles."""
    edges = (plan.INSIDE.west, *plan.ROWS, plan.INSIDE.east)
    below = np.array([plan.AXIS, 0.0, 1.6])
    return [
        seen_from(vault_web(x, z, side), below)
        for x in zip(edges, edges[1:], strict=False)
        for z in zip(plan.BAYS, plan.BAYS[1:], strict=False)
        for side in range(4)
    ]


def floor() -> list[Surface]:
    """Return the floor: slabs, a dark band along each row of pillars, and the medallion."""
    inside, pool = plan.INSIDE, plan.POOL
    band, (x, z) = plan.FLOOR_BAND, plan.STATUE
    medallion = plan.Rectangle(
        x - plan.MEDALLION, x + plan.MEDALLION, z - plan.MEDALLION, z + plan.MEDALLION
    )
    west, east = plan.ROWS[0] + band, plan.ROWS[1] - band
    nave = inside._replace(west=west, east=east)
    slabs = [
        inside._replace(east=plan.ROWS[0] - band),
        inside._replace(west=plan.ROWS[1] + band),
        nave._replace(south=medallion.north),
        nave._replace(north=medallion.south, south=pool.north),
        plan.Rectangle(west, pool.west, pool.north, pool.south),
        plan.Rectangle(pool.east, east, pool.north, pool.south),
        nave._replace(north=pool.south),
    ]
    bands = [inside._replace(west=row - band, east=row + band) for row in plan.ROWS]
    found = [flat(part, 0.0, "floor", "floor", 0.1) for part in slabs]
    for part in bands:
        points = flat(part, 0.0, "band", "floor", 0.1).points
        # Its texture is as wide as the band, and stretched to slabs of 1.5 by 3 metres.
        plain = (points[..., [0, 2]] - (part.west, 0.0)) / (2 * band, 4 * band)
        found.append(Surface(points, "band", plain, 1.0, "floor"))

    picture = flat(medallion, 0.0, "medallion", "floor", 0.1)
    u = (picture.points[..., [0, 2]] - (medallion.west, medallion.north)) / (2 * plan.MEDALLION)
    return [*found, Surface(picture.points, "medallion", u, 1.0, "floor")]


def pool() -> list[Surface]:
    """Return the pool's bed and its sides, seen from within."""
    area, bed = plan.POOL, plan.POOL_BED
    sides = [side.reversed() for side in around(area, [(0.0, 0.0), (0.0, bed)], "pool")]
    return [*sides, flat(area, bed, "pool")]


def alcove(middle: float, to_wall: float) -> list[Surface]:
    """Return the sides, the back and the floor of the alcove whose middle is at z ``middle``."""
    depth = np.array([-plan.ALCOVE_DEPTH, 0.0, 0.0])
    found = embrasure(middle, plan.RECESS, across_x(to_wall), depth, 0.0)
    edges = middle - plan.ALCOVE_HALF, middle + plan.ALCOVE_HALF
    head = pointed(middle, plan.ALCOVE_HALF, plan.ALCOVE_SPRINGING, plan.ALCOVE_TOP)
    back = across_x(to_wall - plan.ALCOVE_DEPTH)
    seen = np.array([to_wall, 0.1, middle])
    found.append(seen_from(upright(halves(*edges), level(0.0), head, back), seen))
    area = plan.Rectangle(to_wall - plan.ALCOVE_DEPTH, to_wall, *edges)
    return [*found, flat(area, 0.0, "alcove")]


def walls() -> list[Surface]:
    """Return the four walls, their openings' sides, and the alcoves."""
    inside, centre = plan.INSIDE, np.array([plan.AXIS, 0.3, (plan.INSIDE.north + 2.8) / 2])
    found: list[Surface] = []
    openings: list[Surface] = []
    outside = np.array([plan.WALL, 0.0, 0.0])
    for bay in zip(plan.BAYS, plan.BAYS[1:], strict=False):
        middle = sum(bay) / 2
        to = across_x(inside.east)
        found += wall_with_opening(bay, plan.WINDOW, to)
        openings += embrasure(middle, plan.WINDOW, to, outside, plan.WINDOW_SPLAY)
        found += wall_with_opening(bay, plan.RECESS, across_x(inside.west))
        openings += alcove(middle, inside.west)

    spans = [(inside.west, plan.ROWS[0]), plan.ROWS, (plan.ROWS[1], inside.east)]
    for z, sheet in ((inside.north, "north"), (inside.south, "hall")):
        for span in (spans[0], spans[2]):
            part = upright(halves(*span), level(0.0), bay_arch(*span), across_z(z))
            found.append(Surface(part.points, part.material, part.plain, 1.0, sheet))

    to = across_z(inside.south)
    found += wall_with_opening(spans[1], plan.DOOR, to)
    outside = np.array([0.0, 0.0, plan.WALL])
    openings += embrasure(plan.AXIS, plan.DOOR, to, outside, 0.0)
    step = plan.Rectangle(
        plan.AXIS - plan.DOOR_HALF,
        plan.AXIS + plan.DOOR_HALF,
        inside.south,
        inside.south + plan.WALL,
    )
    openings.append(flat(step, 0.0, "stone"))
    found += rose_wall(*spans[1])
    return [seen_from(each, centre) for each in found] + openings + rose_sides()


def rose_turn() -> np.ndarray:
    """Return the angles, in radians, of the points of the round window's outline."""
    return np.linspace(0.0, 2 * np.pi, 49)


def rose_wall(low: float, high: float) -> list[Surface]:
    """Return the nave's north wall around its round window."""
    (height, radius), to = plan.ROSE, across_z(plan.INSIDE.north)
    bay, vault = (low, high), bay_arch(low, high)
    turn = rose_turn()
    round_x = np.sort(plan.AXIS + radius * np.cos(turn[:25]))
    round_y = radius * np.abs(np.sin(np.arccos((round_x - plan.AXIS) / radius)))

    def half_height(along: np.ndarray) -> np.ndarray:
        return np.interp(along, round_x, round_y)

    west, east = plan.AXIS - radius, plan.AXIS + radius
    over = np.union1d(round_x, bay_columns(bay, west, east))
    parts = [
        upright(bay_columns(bay, low, west), level(0.0), vault, to),
        upright(bay_columns(bay, east, high), level(0.0), vault, to),
        upright(round_x, level(0.0), lambda s: height - half_height(s), to),
        upright(over, lambda s: height + half_height(s), vault, to),
    ]
    return [Surface(each.points, each.material, each.plain, 1.0, "north") for each in parts]


def rose_sides() -> list[Surface]:
    """Return the sides of the round window, splayed outwards."""
    height, radius = plan.ROSE
    centre = np.array([plan.AXIS, height, plan.INSIDE.north])
    right, up = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])
    inner = circle(centre, right, up, radius, rose_turn())
    back = np.array([0.0, 0.0, -plan.WALL])
    outer = circle(centre + back, right, up, radius - plan.WINDOW_SPLAY, rose_turn())
    middle = centre + back / 2
    return [seen_from(jambs(inner, outer), middle)]


def shell() -> list[Surface]:
    """Return what closes the hall: floor, pool, walls and vault."""
    return [*floor(), *pool(), *walls(), *vault()]


def hall() -> list[Surface]:
    """Return all surfaces of the hall that stand still, the floor's first."""
    return [*shell(), *ornaments()]
