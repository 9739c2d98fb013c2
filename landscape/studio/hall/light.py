"""The light in the hall, traced by rays against its own surfaces: direct, and reflected once.

Direct light of the sun, of the torches and of the sky through every opening is sampled at each
texel; light that surfaces reflect is gathered over the hemisphere. Sun, sky, the torch beside
the pool and the other torches are followed apart, so that hall_bake.py can choose their colours.
"""

import math
from functools import cache

import numpy as np
from numba import njit, prange

from landscape.geometry.clustering import clustered
from landscape.geometry.mesh import Mesh, centred, grid_triangles, vertex_normals
from landscape.hall import plan
from landscape.hall.architecture import hall
from landscape.hall.light import SIZES, of_plane, placed
from landscape.hall.surfaces import cells
from landscape.studio.animals.dragon import dragon
from landscape.studio.animals.sculpture import PaintedMesh
from landscape.studio.rays import FAR, hit, tree

ORIGINS = {"hall": (0, 0), "floor": (1024, 0), "north": (1536, 0)}  # of the sheets: x, y
CANVAS = 2048, 1024  # width and height of all sheets side by side
# Chosen: the materials' mean linear colours, as their textures have them.
ALBEDO = {
    "wall": (0.402, 0.361, 0.289),
    "vault": (0.478, 0.443, 0.378),
    "stone": (0.434, 0.397, 0.33),
    "plinth": (0.27, 0.25, 0.225),
    "floor": (0.443, 0.402, 0.334),
    "alcove": (0.35, 0.32, 0.265),
    "band": (0.084, 0.063, 0.054),
    "medallion": (0.30, 0.255, 0.197),
    "pool": (0.10, 0.15, 0.15),
    "hanging": (0.20, 0.25, 0.18),
    "wood": (0.124, 0.068, 0.033),
    "iron": (0.02, 0.02, 0.02),
}
LIGHTS = ("sun", "sky", "torch", "torches")
SUN, SKY, TORCH, TORCHES = range(4)
SUN_RADIUS = 0.012  # chosen: of its disc, in radians; four times the true one, for softer edges
FLAME = 0.012, 0.022  # chosen: radius of a flame that shines, and its height above the torch
# Chosen: in the pool, where the waves bend the rays; a small fraction of them, as the caustics show
# what the waves do.
SUN_IN_WATER = 0.10
# Chosen.
SUN_SAMPLES = 24
SKY_SAMPLES = 4
TORCH_SAMPLES = 4

NEAR = 0.03  # chosen: within this distance a flame's light hardly grows
STATUE_CELL = 0.03  # chosen: side of the cubes whose vertices are merged, of a mesh of 2
LIFT = 2e-4  # of a ray's start above its surface, in units


def texels() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return all texels that belong to a surface: places and normals (n, 3), at (n, 2).

    The last is their column and row on the canvas.
    """
    place = []
    normal = []
    at = []

    def add(points: np.ndarray, facing: np.ndarray, x: int, y: int) -> None:
        rows, columns = np.mgrid[y : y + points.shape[0], x : x + points.shape[1]]
        place.append(points.reshape(-1, 3))
        normal.append(np.broadcast_to(facing, points.shape).reshape(-1, 3))
        at.append(np.stack([columns, rows], axis=-1).reshape(-1, 2))

    for lit in placed(hall()):
        if lit.chart is not None:
            add(*cells(lit.surface, lit.chart), lit.chart.x, lit.chart.y)
    for sheet, facing in (("floor", (0.0, 1.0, 0.0)), ("north", (0.0, 0.0, 1.0))):
        add(of_plane(sheet), np.array(facing), *ORIGINS[sheet])
    joined = (np.ascontiguousarray(np.concatenate(each)) for each in (place, normal, at))
    return next(joined), next(joined), next(joined)


def parts() -> list[tuple[slice, slice]]:
    """Return the rows and columns of each chart and of the flat sheets on the canvas."""
    found = []
    for lit in placed(hall()):
        if lit.chart is not None:
            x = lit.chart.x
            y = lit.chart.y
            width = lit.chart.width
            height = lit.chart.height
            found.append((slice(y, y + height), slice(x, x + width)))
    for sheet in ("floor", "north"):
        (x, y), (width, height) = ORIGINS[sheet], SIZES[sheet]
        found.append((slice(y, y + height), slice(x, x + width)))
    return found


@cache
def sculpted() -> PaintedMesh:
    """Return the dragon, which takes seconds to make, and the same wherever it is placed."""
    return dragon()


def statue() -> np.ndarray:
    """Return the statue's triangles (n, 3, 3), of a coarser mesh."""
    vertices, triangles, _ = sculpted()
    points = centred(vertices)
    unit = clustered(Mesh(points, vertex_normals(points, triangles), triangles), STATUE_CELL)
    x, y, z = plan.STATUE_SCALE * unit.vertices.astype(float).T
    turn = math.radians(plan.STATUE_YAW)
    (east, south), (_, top) = plan.STATUE, plan.PLINTH
    lift = top - plan.STATUE_SUNK - plan.STATUE_SCALE * float(points[:, 1].min())
    placed = np.stack(
        [
            east + math.cos(turn) * x + math.sin(turn) * z,
            lift + y,
            south - math.sin(turn) * x + math.cos(turn) * z,
        ],
        axis=-1,
    )
    return placed[unit.triangles]


def masonry() -> np.ndarray:
    """Return triangles (n, 3, 3) on the outside of walls and vault: what is in them gets no light.

    Each wall is a rectangle with a rectangle left out around each opening.
    """
    inside = plan.INSIDE
    wall = plan.WALL
    top = plan.CROWN + 0.05
    quads = []

    def upright(axis: int, at: float, edges: list[float], holes: list[tuple[float, float]]) -> None:
        """Add a wall at ``at``; every second stretch between ``edges`` has a hole (low, high)."""
        for k, (low, high) in enumerate(zip(edges, edges[1:], strict=False)):
            spans = (
                [(0.0, top)] if k % 2 == 0 else [(-0.01, holes[k // 2][0]), (holes[k // 2][1], top)]
            )
            for bottom, head in spans:
                corners = [(low, bottom), (high, bottom), (high, head), (low, head)]
                quads.append([(at, y, s) if axis == 0 else (s, y, at) for s, y in corners])

    half = plan.WINDOW_HALF
    windows = [each for middle in plan.ALCOVES for each in (middle - half, middle + half)]
    lower, upper = inside.north - wall, inside.south + wall
    upright(
        0,
        inside.east + wall,
        [lower, *windows, upper],
        [(plan.WINDOW_SILL, plan.WINDOW_TOP)] * len(plan.ALCOVES),
    )
    west, east = inside.west - wall, inside.east + wall
    height, radius = plan.ROSE
    for z, wide, hole in (
        (lower, radius, (height - radius, height + radius)),
        (upper, plan.DOOR_HALF, (0.0, plan.DOOR_TOP)),
    ):
        upright(2, z, [west, plan.AXIS - wide, plan.AXIS + wide, east], [hole])
    west -= plan.ALCOVE_DEPTH
    quads.append([(west, top, lower), (east, top, lower), (east, top, upper), (west, top, upper)])
    quads.append([(west, 0.0, lower), (west, 0.0, upper), (west, top, upper), (west, top, lower)])
    found = np.array(quads)
    return np.concatenate([found[:, [0, 1, 2]], found[:, [0, 2, 3]]])


def triangles() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return corners (n, 3, 3), their places on the canvas (n, 3, 2) and linear colours (n, 3).

    Faces that only close a joint are left out: they are narrower than the distance of two texels.
    """
    corners = []
    where = []
    colours = []
    for lit in placed([each for each in hall() if each.edge is None]):
        rows, columns = lit.surface.points.shape[:2]
        index = grid_triangles(columns, rows)
        corners.append(lit.surface.points.reshape(-1, 3)[index])
        where.append((lit.light + ORIGINS[lit.surface.sheet]).reshape(-1, 2)[index])
        colours.append(np.tile(ALBEDO[lit.surface.material], (len(index), 1)))
    joined = tuple(np.concatenate(each) for each in (corners, where, colours))
    area = np.linalg.norm(
        np.cross(joined[0][:, 1] - joined[0][:, 0], joined[0][:, 2] - joined[0][:, 0]), axis=1
    )
    real = area > 1e-10
    return joined[0][real], joined[1][real], joined[2][real]


def as_scene(corners: np.ndarray) -> tuple[tuple[np.ndarray, ...], np.ndarray]:
    """Return what :func:`rays.hit` takes, and the order its triangles are in."""
    boxes, nodes, order = tree(corners)
    sorted_corners = corners[order]
    v0 = np.ascontiguousarray(sorted_corners[:, 0])
    e1, e2 = (np.ascontiguousarray(sorted_corners[:, k] - v0) for k in (1, 2))
    return (boxes, nodes, v0, e1, e2), order


def portals() -> np.ndarray:
    """Return the openings' outer sides as parallelograms (n, 3, 3): a corner and two edges."""
    inside, wall = plan.INSIDE, plan.WALL
    found = []
    half = plan.WINDOW_HALF
    low = plan.WINDOW_SILL
    top = plan.WINDOW_TOP
    for middle in plan.ALCOVES:
        found.append(
            [(inside.east + wall, low, middle - half), (0, top - low, 0), (0, 0, 2 * half)]
        )

    height, radius = plan.ROSE
    found.append(
        [
            (plan.AXIS - radius, height - radius, inside.north - wall),
            (2 * radius, 0, 0),
            (0, 2 * radius, 0),
        ]
    )
    found.append(
        [
            (plan.AXIS - plan.DOOR_HALF, 0, inside.south + wall),
            (2 * plan.DOOR_HALF, 0, 0),
            (0, plan.DOOR_TOP, 0),
        ]
    )
    return np.array(found, float)


@njit
def _random(state):  # type: ignore[no-untyped-def]
    """Return the next state of a generator (xorshift) and a number in 0..1."""
    state ^= (state << np.uint64(13)) & np.uint64(0xFFFFFFFFFFFFFFFF)
    state ^= state >> np.uint64(7)
    state ^= (state << np.uint64(17)) & np.uint64(0xFFFFFFFFFFFFFFFF)
    return state, np.float64(state >> np.uint64(11)) / 9007199254740992.0


@njit
def _start(seed, number):  # type: ignore[no-untyped-def]
    """Return the state a texel's random numbers begin with."""
    state = np.uint64(number + 1) * np.uint64(0x9E3779B97F4A7C15) ^ np.uint64(seed)
    for _ in range(3):
        state, _unused = _random(state)
    return state


@njit
def _frame(n):  # type: ignore[no-untyped-def]
    """Return two unit vectors perpendicular to a unit vector (3,) and to each other."""
    if abs(n[1]) < 0.9:
        a = np.array([n[2], 0.0, -n[0]])
    else:
        a = np.array([0.0, -n[2], n[1]])
    a /= math.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])
    b = np.array([n[1] * a[2] - n[2] * a[1], n[2] * a[0] - n[0] * a[2], n[0] * a[1] - n[1] * a[0]])
    return a, b


@njit
def _sky(d, out):  # type: ignore[no-untyped-def]
    """Write the sky's light (3,) from direction d: blue, pale at the horizon, or the ground."""
    up = d[1]
    if up < 0.0:
        out[0], out[1], out[2] = 0.22, 0.25, 0.20
    else:
        t = min(up * 1.6, 1.0)
        out[0], out[1], out[2] = 0.80 - 0.42 * t, 0.92 - 0.34 * t, 1.05 - 0.12 * t


@njit(parallel=True)
def direct(scene, place, normal, sun, doors, flames, front, seed):  # type: ignore[no-untyped-def]
    """Return the direct light (n, 4, 3) of each of LIGHTS at texels with place and normal (n, 3).

    ``flames`` (m, 3) are the torches; number ``front`` is the one beside the pool.
    """
    out = np.zeros((len(place), 4, 3))
    sun_a, sun_b = _frame(sun)
    for i in prange(len(place)):
        n = normal[i]
        o = place[i] + LIFT * n
        state = _start(seed, i)
        d = np.empty(3)
        cosine = n[0] * sun[0] + n[1] * sun[1] + n[2] * sun[2]
        if cosine > 0.0:
            disc = SUN_RADIUS if o[1] > -0.001 else SUN_IN_WATER
            seen = 0
            cast = 0
            total = 8
            while cast < total:
                state, p = _random(state)
                state, q = _random(state)
                radius = disc * math.sqrt((cast + p) / total if cast < 8 else p)
                turn = 2 * math.pi * ((0.618034 * cast) % 1.0 + 0.1 * q)
                for k in range(3):
                    d[k] = sun[k] + radius * (math.cos(turn) * sun_a[k] + math.sin(turn) * sun_b[k])
                cast += 1
                if hit(scene, o, d, FAR, False)[0] < 0:
                    seen += 1
                if cast == 8 and 0 < seen < 8:
                    total = SUN_SAMPLES if o[1] > -0.001 else 4 * SUN_SAMPLES
            out[i, SUN, :] = cosine * seen / total
        for m in range(len(flames)):
            for k in range(3):
                d[k] = flames[m, k] - o[k]
            far = math.sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2])
            facing = (n[0] * d[0] + n[1] * d[1] + n[2] * d[2]) / far
            if facing < -0.2 or facing / (far * far) < 0.02:
                continue
            arrived = 0.0
            count = TORCH_SAMPLES if facing / (far * far) > 1.0 or m == front else 2
            for _ in range(count):
                for k in range(3):
                    state, p = _random(state)
                    stretch = 1.6 if k == 1 else 1.0
                    d[k] = flames[m, k] + stretch * FLAME[0] * (2 * p - 1) - o[k]
                gap = math.sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2])
                cosine = (n[0] * d[0] + n[1] * d[1] + n[2] * d[2]) / gap
                if cosine > 0.0 and hit(scene, o, d, 1.0, False)[0] < 0:
                    arrived += cosine / (gap * gap + NEAR * NEAR)
            out[i, TORCH if m == front else TORCHES, :] += arrived / count
        light = np.empty(3)
        for m in range(len(doors)):
            edge, other = doors[m, 1], doors[m, 2]
            ax = edge[1] * other[2] - edge[2] * other[1]
            ay = edge[2] * other[0] - edge[0] * other[2]
            az = edge[0] * other[1] - edge[1] * other[0]
            for s in range(SKY_SAMPLES):
                state, p = _random(state)
                state, q = _random(state)
                p = (s % 2 + p) / 2
                q = (s // 2 + q) * 2 / SKY_SAMPLES
                for k in range(3):
                    d[k] = doors[m, 0, k] + p * edge[k] + q * other[k] - o[k]
                gap = math.sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2])
                d /= gap
                facing = n[0] * d[0] + n[1] * d[1] + n[2] * d[2]
                area = abs(ax * d[0] + ay * d[1] + az * d[2])
                if facing <= 0.0 or facing * area / (gap * gap) < 1e-4:
                    continue
                if hit(scene, o, d, FAR, False)[0] < 0:
                    _sky(d, light)
                    for k in range(3):
                        weight = facing * min(area / (gap * gap), 2.0) / math.pi / SKY_SAMPLES
                        out[i, SKY, k] += light[k] * weight

    return out


@njit(parallel=True)
def gather(scene, uv, colour, glow, place, normal, count, seed):  # type: ignore[no-untyped-def]
    """Return the light (n, 4, 3) that reaches texels from surfaces, and how open each is, (n,).

    ``uv`` (t, 3, 2) and ``colour`` (t, 3) belong to the scene's triangles, -1 for one without a
    chart; ``glow`` (h, w, 4, 3) is the light that arrives at each texel of the canvas. A texel is
    open (1) if none of its ``count`` rays meets the back of a surface.
    """
    out = np.zeros((len(place), 4, 3))
    opened = np.zeros(len(place))
    _, _, _, e1, e2 = scene
    for i in prange(len(place)):
        n = normal[i]
        a, b = _frame(n)
        o = place[i] + LIFT * n
        state = _start(seed, i)
        d = np.empty(3)
        backs = 0
        for s in range(count):
            state, p = _random(state)
            state, q = _random(state)
            p = (s + p) / count
            turn = 2 * math.pi * ((0.618034 * s) % 1.0 + q / 16)
            level, up = math.sqrt(p), math.sqrt(1 - p)
            for k in range(3):
                d[k] = level * (math.cos(turn) * a[k] + math.sin(turn) * b[k]) + up * n[k]
            t, _far, u, v = hit(scene, o, d, FAR, True)
            if t < 0:
                continue
            gx = e1[t, 1] * e2[t, 2] - e1[t, 2] * e2[t, 1]
            gy = e1[t, 2] * e2[t, 0] - e1[t, 0] * e2[t, 2]
            gz = e1[t, 0] * e2[t, 1] - e1[t, 1] * e2[t, 0]
            if gx * d[0] + gy * d[1] + gz * d[2] > 0.0:
                backs += 1
                continue
            if colour[t, 0] < 0.0:
                continue
            x = uv[t, 0, 0] * (1 - u - v) + uv[t, 1, 0] * u + uv[t, 2, 0] * v
            y = uv[t, 0, 1] * (1 - u - v) + uv[t, 1, 1] * u + uv[t, 2, 1] * v
            column = min(max(int(x), 0), glow.shape[1] - 1)
            row = min(max(int(y), 0), glow.shape[0] - 1)
            for light in range(4):
                for k in range(3):
                    out[i, light, k] += glow[row, column, light, k] * colour[t, k] / count
        opened[i] = 1.0 - backs / count

    return out, opened
