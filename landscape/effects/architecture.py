"""The hall's stone as surfaces: floor, walls with their openings, pillars and vault. No OpenGL."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from landscape.effects import plan
from landscape.effects.surfaces import Surface

POINTED = 1.3  # chosen: radius of the arcs of a pointed arch, in half spans; 1 is a round arch
FINE = 12  # chosen: points along half an arch
SIDES = 12  # chosen: of a pillar

Curve = Callable[[np.ndarray], np.ndarray]
Place = Callable[[np.ndarray, np.ndarray], np.ndarray]


def arch(fraction: np.ndarray) -> np.ndarray:
    """Return the height of a pointed arch, 0..1, at ``fraction`` of half its span, -1..1."""
    top = np.sqrt(POINTED**2 - (POINTED - 1) ** 2)
    from_centre = np.minimum(np.abs(fraction), 1.0) + POINTED - 1
    return np.asarray(np.sqrt(np.maximum(POINTED**2 - from_centre**2, 0.0)) / top)


def level(height: float) -> Curve:
    """Return the curve of a constant height."""
    return lambda along: np.full_like(along, height)


def pointed(middle: float, half: float, springing: float, top: float) -> Curve:
    """Return a pointed arch over ``middle``, the head of an opening or a bay."""
    return lambda along: springing + (top - springing) * arch((along - middle) / half)


def bay_arch(low: float, high: float) -> Curve:
    """Return where the vault over a bay from ``low`` to ``high`` meets the wall."""
    return pointed((low + high) / 2, (high - low) / 2, plan.SPRINGING, plan.CROWN)


def across_x(x: float) -> Place:
    """Return the places of a wall at ``x`` that runs along z."""
    return lambda along, height: np.stack([np.full_like(along, x), height, along], axis=-1)


def across_z(z: float) -> Place:
    """Return the places of a wall at ``z`` that runs along x."""
    return lambda along, height: np.stack([along, height, np.full_like(along, z)], axis=-1)


def upright(
    along: np.ndarray,
    low: Curve,
    high: Curve,
    to: Place,
    rows: int = 5,
    material: str = "wall",
) -> Surface:
    """Return the part of a wall between two curves, at distances ``along`` (n,).

    ``to`` gives the points of distances along the wall and heights.
    """
    t = np.linspace(1.0, 0.0, rows)[:, None]
    heights = low(along) * (1 - t) + high(along) * t
    return Surface(to(np.broadcast_to(along, heights.shape), heights), material)


def reveal(outline: np.ndarray, depth: np.ndarray, material: str = "wall") -> Surface:
    """Return the sides of an opening: an outline (n, 3) in the wall's face, moved by ``depth``."""
    return Surface(np.stack([outline, outline + depth]), material)


def seen_from(surface: Surface, eye: np.ndarray) -> Surface:
    """Return a surface with its columns reversed if it would turn its back to a point (3,)."""
    p = surface.points
    across, down = p[:-1, 1:] - p[:-1, :-1], p[1:, :-1] - p[:-1, :-1]
    facing = np.cross(down, across) * (eye - p[:-1, :-1])
    return surface if facing.sum() > 0 else replace(surface, points=p[:, ::-1])


def spaced(low: float, high: float, step: float = 0.03) -> np.ndarray:
    """Return numbers from ``low`` to ``high``, at most ``step`` apart."""
    return np.linspace(low, high, max(int(np.ceil(abs(high - low) / step)), 1) + 1)


def halves(low: float, high: float) -> np.ndarray:
    """Return numbers from ``low`` to ``high``, closer where an arch over them is steep."""
    turn = np.linspace(-np.pi / 2, np.pi / 2, 2 * FINE + 1)
    return np.asarray((low + high) / 2 + (high - low) / 2 * np.sin(turn))


def wall_with_opening(
    bay: tuple[float, float], opening: tuple[float, float, float, float], to: Place
) -> list[Surface]:
    """Return a bay's wall around a pointed opening: (half width, sill, springing, top).

    ``bay`` is where the bay begins and ends along the wall; the opening is in its middle.
    """
    (low, high), (half, sill, springing, top) = bay, opening
    middle = (low + high) / 2
    vault = bay_arch(low, high)
    head = pointed(middle, half, springing, top)
    between = halves(middle - half, middle + half)
    parts = [
        upright(spaced(low, middle - half), level(0.0), vault, to, 9),
        upright(spaced(middle + half, high), level(0.0), vault, to, 9),
        upright(between, head, vault, to, 5),
    ]
    return parts + ([upright(between, level(0.0), level(sill), to, 5)] if sill > 0 else [])


def outline(middle: float, opening: tuple[float, float, float, float], to: Place) -> np.ndarray:
    """Return the outline (n, 3) of a pointed opening, from sill to sill over its head."""
    half, sill, springing, top = opening
    along = halves(middle - half, middle + half)
    heights = pointed(middle, half, springing, top)(along)
    along = np.concatenate([along[:1], along, along[-1:]])
    return to(along, np.concatenate([[sill], heights, [sill]]))


def vault_web(x: tuple[float, float], z: tuple[float, float], side: int) -> Surface:
    """Return one of the four webs of a groin vault over a bay: two pointed tunnels that cross.

    The web of ``side`` 0 to 3 begins at the bay's edge and ends in a point under the crown; on it
    the ceiling is the tunnel that runs across that edge.
    """
    from_edge = np.linspace(0.0, 1.0, FINE + 1)[:, None]
    along = np.sin(np.linspace(-np.pi / 2, np.pi / 2, 2 * FINE + 1))[None, :] * (1 - from_edge)
    outwards = np.broadcast_to(1 - from_edge, along.shape) * (1 if side % 2 else -1)
    u, v = (outwards, along) if side < 2 else (along, outwards)
    height = plan.SPRINGING + (plan.CROWN - plan.SPRINGING) * arch(along)
    px, pz = sum(x) / 2 + (x[1] - x[0]) / 2 * u, sum(z) / 2 + (z[1] - z[0]) / 2 * v
    return Surface(np.stack([px, height, pz], axis=-1), "vault")


def pillar(x: float, z: float) -> list[Surface]:
    """Return a pillar as surfaces of revolution: base, shaft and capital."""
    r, top = plan.PILLAR, plan.SPRINGING
    parts = [
        [(r + 0.022, 0.03), (r + 0.022, 0.0)],
        [(r, 0.055), (r + 0.006, 0.045), (r + 0.022, 0.03)],
        [(r, top - 0.05), (r, top / 2), (r, 0.055)],
        [(r + 0.028, top + 0.02), (r + 0.028, top), (r + 0.012, top - 0.03), (r, top - 0.05)],
    ]
    turn = np.linspace(0.0, 2 * np.pi, SIDES + 1)[None, ::-1]
    surfaces = []
    for profile in parts:
        radius, height = (np.array(each)[:, None] for each in zip(*profile, strict=True))
        ring = [x + radius * np.cos(turn), height + 0 * turn, z + radius * np.sin(turn)]
        surfaces.append(Surface(np.stack(ring, axis=-1), "pillar"))
    return surfaces


def box(west: float, east: float, north: float, south: float, low: float, high: float,
        material: str) -> list[Surface]:  # fmt: skip
    """Return the four sides and the top of a box."""
    middle = np.array([(west + east) / 2, (low + high) / 2, (north + south) / 2])
    sides = [(west, north, east, north), (east, north, east, south), (east, south, west, south),
             (west, south, west, north)]  # fmt: skip
    found = []
    for x0, z0, x1, z1 in sides:
        side = np.array([[(x0, high, z0), (x1, high, z1)], [(x0, low, z0), (x1, low, z1)]])
        away = 2 * side.reshape(-1, 3).mean(axis=0) - middle
        found.append(seen_from(Surface(side, material), away))
    return [*found, flat(plan.Rectangle(west, east, north, south), high, material)]


def flat(area: plan.Rectangle, y: float, material: str) -> Surface:
    """Return a level rectangle, seen from above."""
    x, z = np.meshgrid(spaced(area.west, area.east, 0.1), spaced(area.north, area.south, 0.1))
    return Surface(np.stack([x, np.full_like(x, y), z], axis=-1), material)


def floor() -> list[Surface]:
    """Return the floor around the pool, in four parts."""
    inside, pool = plan.INSIDE, plan.POOL
    parts = [
        inside._replace(south=pool.north),
        plan.Rectangle(inside.west, pool.west, pool.north, pool.south),
        plan.Rectangle(pool.east, inside.east, pool.north, pool.south),
        inside._replace(north=pool.south),
    ]
    return [flat(part, 0.0, "floor") for part in parts]


def pool() -> list[Surface]:
    """Return the pool's bed and its sides, seen from within."""
    area, bed = plan.POOL, plan.POOL_BED
    middle = np.array([(area.west + area.east) / 2, bed / 2, (area.north + area.south) / 2])
    sides = box(*area, bed, 0.0, "pool")[:4]
    return [seen_from(side, middle) for side in sides] + [flat(area, bed, "pool")]


def walls() -> list[Surface]:
    """Return the four walls, their openings' sides, and the alcoves."""
    inside, centre = plan.INSIDE, np.array([plan.AXIS, 0.3, (plan.INSIDE.north + 2.8) / 2])
    window = plan.WINDOW_HALF, plan.WINDOW_SILL, plan.WINDOW_SPRINGING, plan.WINDOW_TOP
    alcove = plan.ALCOVE_HALF, 0.0, plan.ALCOVE_SPRINGING, plan.ALCOVE_TOP
    door = plan.DOOR_HALF, 0.0, plan.DOOR_SPRINGING, plan.DOOR_TOP
    found: list[Surface] = []
    openings: list[Surface] = []
    for bay in zip(plan.BAYS, plan.BAYS[1:], strict=False):
        middle = sum(bay) / 2
        for x, opening, outside in (
            (inside.east, window, plan.WALL),
            (inside.west, alcove, -plan.ALCOVE_DEPTH),
        ):
            to = across_x(x)
            found += wall_with_opening(bay, opening, to)
            sides = reveal(outline(middle, opening, to), np.array([outside, 0.0, 0.0]))
            openings.append(seen_from(sides, np.array([x + outside / 2, 0.25, middle])))
        back = across_x(inside.west - plan.ALCOVE_DEPTH)
        between = halves(middle - plan.ALCOVE_HALF, middle + plan.ALCOVE_HALF)
        head = pointed(middle, plan.ALCOVE_HALF, plan.ALCOVE_SPRINGING, plan.ALCOVE_TOP)
        found.append(upright(between, level(0.0), head, back))
        area = (inside.west - plan.ALCOVE_DEPTH, inside.west)
        edges = middle - plan.ALCOVE_HALF, middle + plan.ALCOVE_HALF
        openings.append(flat(plan.Rectangle(*area, *edges), 0.0, "alcove"))
    spans = [(inside.west, plan.ROWS[0]), plan.ROWS, (plan.ROWS[1], inside.east)]
    for z in (inside.north, inside.south):
        to = across_z(z)
        for low, high in (spans[0], spans[2]):
            found.append(upright(halves(low, high), level(0.0), bay_arch(low, high), to, 9))
    found += wall_with_opening(spans[1], door, across_z(inside.south))
    found += rose_wall(*spans[1])
    return [seen_from(each, centre) for each in found] + openings


def rose_wall(low: float, high: float) -> list[Surface]:
    """Return the nave's north wall around its round window, without the window's sides."""
    (height, radius), to = plan.ROSE, across_z(plan.INSIDE.north)
    vault = bay_arch(low, high)
    between = halves(plan.AXIS - radius, plan.AXIS + radius)

    def half_height(along: np.ndarray) -> np.ndarray:
        return np.asarray(np.sqrt(np.maximum(radius**2 - (along - plan.AXIS) ** 2, 0.0)))

    return [
        upright(spaced(low, plan.AXIS - radius), level(0.0), vault, to, 9),
        upright(spaced(plan.AXIS + radius, high), level(0.0), vault, to, 9),
        upright(between, level(0.0), lambda s: height - half_height(s), to),
        upright(between, lambda s: height + half_height(s), vault, to),
    ]


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


def plinth() -> list[Surface]:
    """Return the plinth of the statue."""
    (x, z), (half, top) = plan.STATUE, plan.PLINTH
    return box(x - half, x + half, z - half, z + half, 0.0, top, "plinth")


def hall() -> list[Surface]:
    """Return all surfaces of the hall that stand still, the floor's first."""
    pillars = [part for x in plan.ROWS for z in plan.BAYS[1:-1] for part in pillar(x, z)]
    return [*floor(), *pool(), *walls(), *pillars, *vault(), *plinth()]
