"""What lies at the foot of the weathered castle: rubble, flagstones, a worn path. No OpenGL here.

Places are in the castle's own frame; ``ground`` gives the height of the ground there. All sizes
are chosen.
"""

import math
from collections.abc import Callable

import numpy as np

from landscape.elements.best.castle.ornate_masonry import GATE, PLINTH
from landscape.geometry.masonry import CORNERS, TOWER_RADIUS
from landscape.geometry.mesh import Mesh, grid_triangles, merged, vertex_normals

Ground = Callable[[np.ndarray], np.ndarray]
"""Heights (n,) of the ground at places x, z (n, 2)."""
BESIDE, FALLEN = 150, 46  # stones against the wall, and farther from it
FLAGS = 26
PATH = 1.0  # units that the path reaches from the gate
FOOT = 0.10  # units from the wall within which the ground is darkened


def ball() -> tuple[np.ndarray, np.ndarray]:
    """Return unit vectors (n, 3) on a sphere, and the triangles (m, 3) between them."""
    rings, sides = 4, 8
    polar = np.linspace(0.0, math.pi, rings + 1)[1:-1]
    turn = 2 * np.pi * np.arange(sides) / sides
    round_ = [
        np.stack(
            [math.sin(p) * np.cos(turn), np.full(sides, math.cos(p)), math.sin(p) * np.sin(turn)],
            axis=1,
        )
        for p in polar
    ]
    points = np.concatenate([[(0.0, 1.0, 0.0)], *round_, [(0.0, -1.0, 0.0)]])
    found = []
    last = len(points) - 1
    for k in range(sides):
        after = (k + 1) % sides
        found.append((0, 1 + after, 1 + k))
        for ring in range(rings - 2):
            a, b = 1 + ring * sides, 1 + (ring + 1) * sides
            found += [(a + k, a + after, b + k), (b + k, a + after, b + after)]
        found.append((last, last - sides + k, last - sides + after))

    return points, np.array(found, np.uint32)


def stone(rng: np.random.Generator, size: float, flat: float) -> Mesh:
    """Return an irregular stone about the origin, ``flat`` times as high as wide."""
    points, triangles = ball()
    cut = points.copy()
    for _ in range(10):  # split along planes, as broken stones are
        normal = rng.normal(size=3)
        normal /= np.linalg.norm(normal)
        over = np.maximum(cut @ normal - rng.uniform(0.35, 0.75), 0.0)
        cut -= over[:, None] * normal
    cut *= size * np.array([rng.uniform(0.8, 1.3), flat, rng.uniform(0.7, 1.1)])
    angle = rng.uniform(0, 2 * math.pi)
    c, s = math.cos(angle), math.sin(angle)
    cut = cut @ np.array([(c, 0, s), (0, 1, 0), (-s, 0, c)])
    vertices = np.ascontiguousarray(cut, np.float32)
    uv = vertices[:, [0, 2]] + 0.6 * vertices[:, 1:2]
    coordinates = np.ascontiguousarray(2.2 * uv + rng.random(2), np.float32)
    return Mesh(vertices, vertex_normals(vertices, triangles), triangles, (coordinates,))


def outside_of_walls(count: int, spread: float, rng: np.random.Generator) -> np.ndarray:
    """Return random places x, z (n, 2) up to ``spread`` units outside walls and towers."""
    out = PLINTH[2]
    places: list[np.ndarray] = []
    while len(places) < count:
        away = out + spread * rng.random() ** 2.2
        if rng.random() < 0.45:
            corner = np.array(CORNERS[rng.integers(4)])
            turn = rng.uniform(0, 2 * math.pi)
            at = corner + (TOWER_RADIUS + away) * np.array([math.cos(turn), math.sin(turn)])
        else:
            along = rng.random()
            side = [(along, -away), (along, 1 + away), (-away, along), (1 + away, along)]
            at = np.array(side[rng.integers(4)])
        inside = (np.abs(at - 0.5) < 0.5 + out * 0.5).all()
        in_tower = any(math.dist(at, c) < TOWER_RADIUS + out * 0.6 for c in CORNERS)
        before_gate = GATE[0] - 0.02 < at[0] < GATE[1] + 0.02 and at[1] < 0.5
        if not inside and not in_tower and not before_gate:
            places.append(at)

    return np.array(places)


def rubble(ground: Ground) -> tuple[Mesh, np.ndarray]:
    """Return the stones at the foot of the walls and the path's flagstones, and tints (n, 3)."""
    rng = np.random.default_rng([2006, 17])
    near = outside_of_walls(BESIDE, 0.035, rng)
    far = outside_of_walls(FALLEN, 0.30, rng)
    flags = np.stack(
        [
            0.5 + np.tile((-0.045, 0.045), FLAGS // 2) + rng.normal(0, 0.022, FLAGS),
            -0.17 - PATH * 0.8 * (np.arange(FLAGS) + rng.uniform(-0.4, 0.4, FLAGS)) / FLAGS,
        ],
        axis=1,
    )
    places = np.concatenate([near, far, flags])
    heights = ground(places)
    meshes, tints = [], []
    for k, ((x, z), y) in enumerate(zip(places, heights, strict=True)):
        flag = k >= len(near) + len(far)
        size = rng.uniform(0.026, 0.042) if flag else 0.007 + 0.026 * rng.random() ** 2
        one = stone(rng, float(size), 0.22 if flag else float(rng.uniform(0.45, 0.85)))
        low = 0.016 * size if flag else 0.25 * size
        one.vertices[:] += np.array([x, y + low - (0.10 * size if flag else 0.0), z], np.float32)
        meshes.append(one)
        tint = rng.normal(1.02, 0.13) * np.array([1.0, 0.97, 0.92])
        # What touches the ground is darker, and mossy.
        above = np.clip((one.vertices[:, 1] - y) / (0.6 * size), 0.0, 1.0)[:, None]
        tints.append(tint * (np.array([0.50, 0.50, 0.42]) + above * (0.50, 0.50, 0.58)))

    return merged(meshes), np.concatenate(tints)


def patch(grid: np.ndarray, ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Return vertices float32 (n, 3) on the ground of a grid of places (rows, columns, 2)."""
    rows, columns = grid.shape[:2]
    flat = grid.reshape(-1, 2)
    vertices = np.stack([flat[:, 0], ground(flat) + 0.0025, flat[:, 1]], axis=1)
    return vertices.astype(np.float32), grid_triangles(columns, rows)


def ring(away: float) -> np.ndarray:
    """Return places (n, 2) around walls and towers, ``away`` from them; the last is the first."""
    radius = TOWER_RADIUS + away
    start = math.asin(min((PLINTH[2] + away) / (TOWER_RADIUS + away), 1.0))
    lines = []
    for k, (x, z) in enumerate(CORNERS):
        # From the wall before the corner to the wall after it.
        first, last = math.pi / 2 * (k + 1) + start, math.pi / 2 * (k + 4) - start
        turn = np.linspace(first, last, 14)
        lines.append(np.stack([x + radius * np.cos(turn), z + radius * np.sin(turn)], axis=1))
        nx, nz = CORNERS[(k + 1) % 4]
        begin = lines[-1][-1]
        along = np.array([nx - x, nz - z])
        length = 1.0 - 2 * radius * math.cos(start)
        part = np.linspace(0.0, length, 22)[1:-1]
        lines.append(begin + part[:, None] * along)
    return np.concatenate([*lines, lines[0][:1]])


def ground_marks(ground: Ground) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return what darkens the ground: vertices (n, 3), colours float32 (n, 4), triangles (m, 3).

    Dirt and shade along the foot of the walls, and the path to the gate.
    """
    rng = np.random.default_rng([2006, 18])
    lines = [ring(away) for away in (-0.005, 0.02, 0.055, FOOT)]
    vertices, triangles = patch(np.stack(lines), ground)
    alpha = np.array([0.62, 0.46, 0.18, 0.0])[:, None] * rng.uniform(0.75, 1.2, len(lines[0]))
    colours = np.zeros((len(vertices), 4), np.float32)
    colours[:, :3], colours[:, 3] = (0.055, 0.048, 0.034), np.clip(alpha, 0, 1).ravel()

    # The path, which widens towards the viewer and is trodden bare in its middle.
    across, along = np.linspace(-1.0, 1.0, 9), np.linspace(0.0, 1.0, 30)
    u, v = np.meshgrid(across, along)
    wander = 0.05 * np.sin(5.0 * v) * v
    half = 0.10 + 0.05 * v + 0.03 * (1 - v) ** 4
    x = 0.5 + wander + u * half + rng.normal(0, 0.008, u.shape)
    z = -0.03 - PATH * v
    way, faces = patch(np.stack([x, z], axis=-1), ground)
    worn = np.clip(1.0 - u * u, 0.0, 1.0) * np.clip(4.0 * (1.0 - v), 0.0, 1.0)
    worn = worn * rng.uniform(0.6, 1.0, u.shape)
    earth = np.empty((len(way), 4), np.float32)
    earth[:, :3] = (0.40, 0.335, 0.245)
    earth[:, :3] *= rng.uniform(0.82, 1.12, (len(way), 1))
    earth[:, 3] = 0.72 * worn.ravel()

    return (
        np.concatenate([vertices, way]),
        np.concatenate([colours, earth]),
        np.concatenate([triangles, faces + np.uint32(len(vertices))]),
    )
