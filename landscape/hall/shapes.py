"""The forms that the hall is made of: arches, strips, sweeps and turned pieces. No OpenGL."""

from collections.abc import Callable, Sequence

import numpy as np

from landscape.hall import plan
from landscape.hall.surfaces import Surface

POINTED = 1.3  # chosen: radius of the arcs of a pointed arch, in half spans; 1 is a round arch
FINE = 8  # chosen: points along half an arch

Curve = Callable[[np.ndarray], np.ndarray]
Place = Callable[[np.ndarray, np.ndarray], np.ndarray]
Profile = Sequence[tuple[float, float]]

# Where an arch has its points, in half spans: closer where it is steep.
STEPS = np.sin(np.linspace(-np.pi / 2, np.pi / 2, 2 * FINE + 1))


def true_arch(fraction: np.ndarray) -> np.ndarray:
    """Return the height of a pointed arch, 0..1, at ``fraction`` of half its span, -1..1."""
    top = np.sqrt(POINTED**2 - (POINTED - 1) ** 2)
    from_centre = np.minimum(np.abs(fraction), 1.0) + POINTED - 1
    return np.asarray(np.sqrt(np.maximum(POINTED**2 - from_centre**2, 0.0)) / top)


def arch(fraction: np.ndarray) -> np.ndarray:
    """Return the height of a pointed arch as it is built: straight between its STEPS.

    Whatever follows the same arch with other points meets it without a gap.
    """
    return np.interp(fraction, STEPS, true_arch(STEPS))


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


def halves(low: float, high: float) -> np.ndarray:
    """Return numbers from ``low`` to ``high`` where an arch over them has its points."""
    return np.asarray((low + high) / 2 + (high - low) / 2 * STEPS)


def upright(
    along: np.ndarray, low: Curve, high: Curve, to: Place, material: str = "wall"
) -> Surface:
    """Return the part of a wall between two curves, at distances ``along`` (n,).

    ``to`` gives the points of distances along the wall and heights.
    """
    heights = np.stack([high(along), low(along)])
    both = np.broadcast_to(along, heights.shape)
    return Surface(to(both, heights), material, np.stack([both, -heights], axis=-1))


def outline(middle: float, opening: tuple[float, float, float, float], to: Place) -> np.ndarray:
    """Return the outline (n, 3) of a pointed opening: (half width, sill, springing, top).

    It runs from sill to sill over its head.
    """
    half, sill, springing, top = opening
    along = halves(middle - half, middle + half)
    heights = pointed(middle, half, springing, top)(along)
    along = np.concatenate([along[:1], along, along[-1:]])
    return to(along, np.concatenate([[sill], heights, [sill]]))


def circle(
    centre: np.ndarray, right: np.ndarray, up: np.ndarray, radius: float, turn: np.ndarray
) -> np.ndarray:
    """Return points (n, 3) of a circle about ``centre`` at angles ``turn`` in radians."""
    turn = turn[:, None]
    return np.asarray(centre + radius * (np.cos(turn) * right + np.sin(turn) * up))


def seen_from(surface: Surface, eye: np.ndarray) -> Surface:
    """Return a surface, reversed if it would turn its back to a point (3,), or to (r, c, 3)."""
    p = surface.points
    across, down = p[:-1, 1:] - p[:-1, :-1], p[1:, :-1] - p[:-1, :-1]
    if eye.ndim == 3:
        eye = eye[:-1, :-1]
    facing = np.cross(down, across) * (eye - p[:-1, :-1])
    return surface if facing.sum() > 0 else surface.reversed()


def sweep(
    path: np.ndarray,
    out: np.ndarray,
    profile: Profile,
    material: str = "stone",
    density: float = 1.0,
) -> Surface:
    """Return a profile of (aside, out) points moved along a path (n, 3).

    ``out`` (n, 3) or (3,) is the direction away from what the moulding sits on; aside is
    perpendicular to it and to the path. A path that ends where it begins is closed.
    """
    out = np.broadcast_to(out, path.shape)
    along = np.gradient(path, axis=0)
    if np.allclose(path[0], path[-1]):
        along[0] = along[-1] = path[1] - path[-2]
    aside = np.cross(along, out)
    aside = aside / np.linalg.norm(aside, axis=1, keepdims=True)
    offsets = np.array(profile)
    points = path + offsets[:, :1, None] * aside + offsets[:, 1:, None] * out
    away = points + (points - path - 0.0 * out) + 1e-4 * out
    return seen_from(Surface(points, material, None, density), away)


def turned(
    x: float, z: float, profile: Profile, material: str, sides: int = 12, ring: Curve | None = None
) -> Surface:
    """Return a surface of revolution of (radius, height) points, from the top downwards.

    ``ring`` gives a number by the angle that the radius is multiplied with: 1 for a circle.
    """
    turn = np.linspace(0.0, 2 * np.pi, sides + 1)[None, ::-1]
    radius, height = (np.array(each)[:, None] for each in zip(*profile, strict=True))
    scale = ring(turn) if ring else 1.0
    points = np.stack(
        [x + radius * scale * np.cos(turn), height + 0 * turn, z + radius * scale * np.sin(turn)],
        axis=-1,
    )
    return Surface(points, material)


def flat(
    area: plan.Rectangle, y: float, material: str, sheet: str = "hall", step: float = 10.0
) -> Surface:
    """Return a level rectangle, seen from above, its points at most ``step`` apart."""
    x, z = (
        np.linspace(low, high, int(np.ceil((high - low) / step)) + 1)
        for low, high in ((area.west, area.east), (area.north, area.south))
    )
    x, z = np.meshgrid(x, z)
    points = np.stack([x, np.full_like(x, y), z], axis=-1)
    # Slabs are laid out from the middle of the nave and of the statue.
    plain = np.stack([x - plan.STATUE[0], z - plan.STATUE[1]], axis=-1)
    return Surface(points, material, plain, 1.0, sheet)


def around(area: plan.Rectangle, profile: Profile, material: str = "stone") -> list[Surface]:
    """Return a moulding of (outwards, height) points around a rectangle, mitred at its corners."""
    corners = [
        (area.west, area.north),
        (area.east, area.north),
        (area.east, area.south),
        (area.west, area.south),
    ]
    outwards = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    out, height = (np.array(each)[:, None] for each in zip(*profile, strict=True))
    found = []
    for k in range(4):
        ends = np.array([corners[k], corners[(k + 1) % 4]])
        away = np.array([outwards[k], outwards[(k + 1) % 4]])
        x, z = (ends[None, :, i] + out * away[None, :, i] for i in (0, 1))
        points = np.stack([x, height + 0.0 * x, z], axis=-1)
        # The profile runs from the top outside to the bottom: right is the way round by the left.
        found.append(Surface(points[:, ::-1], material))
    return found
