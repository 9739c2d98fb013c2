"""The weathered castle's roofs: slates of one size, uneven eaves, hips covered by ridge tiles.

No OpenGL here. Places are in the castle's own frame; all sizes are chosen.
"""

import math

import numpy as np

from landscape.elements.best.castle.ornate_masonry import KEEP, ROOFED
from landscape.elements.best.castle.roofs import CONE, KEEP_ROOF
from landscape.geometry.masonry import TOWER_RADIUS, TOWER_TOP
from landscape.geometry.mesh import Mesh, grid_triangles, merged, vertex_normals

TILE = 0.17  # units that the picture of slates covers, along the slope and across
SIDES = 24
UNEVEN = 0.0035  # units by which the rim of the eaves and the slope are out of true
BARE = 0.5, 0.03  # texture coordinates within one slate
RIDGE_TILES = 9
OVERHANG = 0.05  # of the keep's eaves, beyond its walls
KEEP_HALF = (KEEP[2] - KEEP[0]) / 2
ROWS, COLUMNS = 7, 9  # of the grid of a slope of the keep's roof


def surface(grid: np.ndarray, coordinates: np.ndarray) -> Mesh:
    """Return a grid of places (rows, columns, 3), rows upwards, facing away from its left side."""
    rows, columns = grid.shape[:2]
    vertices = np.ascontiguousarray(grid.reshape(-1, 3), np.float32)
    triangles = grid_triangles(columns, rows)
    flat = np.ascontiguousarray(coordinates.reshape(-1, 2), np.float32)
    return Mesh(vertices, vertex_normals(vertices, triangles), triangles, (flat,))


def cone_roof(x: float, z: float, rng: np.random.Generator) -> list[Mesh]:
    """Return the roof of a tower about (x, z): bands of slates, the eaves' underside, a knob."""
    radius, tip = CONE
    low = TOWER_TOP - 0.02
    slant = math.hypot(radius, tip - low)
    turn = np.linspace(0.0, 2 * np.pi, SIDES + 1)
    rim = rng.uniform(-UNEVEN, UNEVEN, SIDES + 1)
    rim[-1] = rim[0]
    meshes = []
    for first, last in ((0.0, 0.12), (0.12, 0.45), (0.45, 0.72), (0.72, 1.0)):
        share = np.linspace(first, last, 3)[:, None]
        # A roof bends outwards above the eaves, so that the rain falls clear of the wall.
        flare = 1.0 + 0.10 * np.clip(0.22 - share, 0.0, 1.0) / 0.22
        out = radius * (1.0 - share) * flare + rim * (1.0 - share)
        out[share[:, 0] == 1.0] = 0.002
        y = low + share * (tip - low) + 1.2 * rim * (1 - share) ** 6
        grid = np.stack([x + out * np.cos(turn), y + 0 * turn, z + out * np.sin(turn)], axis=-1)
        count = max(round(2 * math.pi * radius * (1.0 - (first + last) / 2) / TILE), 1)
        s, t = np.meshgrid(np.linspace(0, count, SIDES + 1), -share[:, 0] * slant / TILE)
        mesh = surface(grid, np.stack([s, t], axis=-1))
        normals = mesh.normals.reshape(3, SIDES + 1, 3)
        normals[:, 0] = normals[:, -1] = (normals[:, 0] + normals[:, -1]) / 2
        meshes.append(mesh)
        if first == 0.0:
            inner = TOWER_RADIUS * np.stack([np.cos(turn), 0.0 * turn, np.sin(turn)], axis=-1)
            under = inner + (x, low + 0.012, z)
            below = np.stack([under, grid[0]])
            meshes.append(surface(below, np.broadcast_to(BARE, (2, SIDES + 1, 2))))

    return meshes


def hip_roof(rng: np.random.Generator) -> list[Mesh]:
    """Return the keep's roof: four slopes, the undersides of their eaves, tiles on the hips."""
    x0, z0, x1, z1, top = KEEP
    peak = np.array([(x0 + x1) / 2, top + KEEP_ROOF, (z0 + z1) / 2])
    meshes = []
    for turn in range(4):
        grid, coordinates = roof_slope(turn, rng)
        meshes.append(surface(grid, coordinates))
        meshes.append(eaves(turn, grid[0]))
        # The hip between this slope and the next.
        meshes += ridge_tiles(grid[0, 0], peak, rng)

    return meshes


def turned(turn: int, out: np.ndarray, side: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return x, z of points ``out`` from the keep's middle and to a ``side``, after some turns."""
    x0, z0, x1, z1, _ = KEEP
    c, s = round(math.cos(turn * math.pi / 2)), round(math.sin(turn * math.pi / 2))
    return (x0 + x1) / 2 + c * out - s * side, (z0 + z1) / 2 + s * out + c * side


def roof_slope(turn: int, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Return a slope of the keep's roof: its places (rows, columns, 3) and their coordinates."""
    top = KEEP[4]
    half = KEEP_HALF + OVERHANG
    slant = math.hypot(half, KEEP_ROOF)
    share, across = np.meshgrid(np.linspace(0, 1, ROWS), np.linspace(-1, 1, COLUMNS), indexing="ij")
    flare = 0.018 * np.clip(0.25 - share, 0.0, 1.0) / 0.25
    reach = half * (1.0 - share) + flare
    side = across * reach
    y = top + share * KEEP_ROOF - 0.3 * flare

    sag = rng.uniform(-UNEVEN, UNEVEN, y.shape) * (np.abs(across) < 1) * (share < 1)
    reach, y = reach + sag * (share > 0), y + sag
    x, z = turned(turn, reach, side)
    coordinates = np.stack([side / TILE + 0.37 * turn, -share * slant / TILE], axis=-1)
    return np.stack([x, y, z], axis=-1), coordinates


def eaves(turn: int, rim: np.ndarray) -> Mesh:
    """Return the underside of a slope's eaves, from the wall to the rim (columns, 3)."""
    across = np.linspace(-1, 1, COLUMNS)
    x, z = turned(turn, np.full(COLUMNS, KEEP_HALF), KEEP_HALF * across)
    inner = np.stack([x, np.full(COLUMNS, KEEP[4]), z], axis=-1)
    return surface(np.stack([inner, rim]), np.broadcast_to(BARE, (2, COLUMNS, 2)))


def ridge_tiles(low: np.ndarray, peak: np.ndarray, rng: np.random.Generator) -> list[Mesh]:
    """Return the tiles that cover a hip from its foot to its peak, (3,) both; they overlap."""
    along = (peak - low) / RIDGE_TILES
    flat = np.array([along[2], 0.0, -along[0]]) / math.hypot(along[0], along[2])
    lift, edge = np.array([0.0, 0.008, 0.0]), np.array([0.0, -0.008, 0.0])
    meshes = []
    for k in range(RIDGE_TILES):
        begin, end = low + along * (k - 0.08), low + along * (k + 1)
        wide = 0.011 + rng.uniform(-0.001, 0.001)
        ends = [
            np.array([at + wide * flat + edge, at + up, at - wide * flat + edge])
            for at, up in ((begin, 1.35 * lift), (end, lift))
        ]
        patch = np.array(BARE) + np.array(
            [[(0.03 * k, 0.0), (0.03 * k + 0.02, 0.0), (0.03 * k + 0.04, 0.0)]] * 2
        )
        meshes.append(surface(np.array(ends)[:, ::-1], patch))

    return meshes


def slate_roofs() -> Mesh:
    """Return the roofs of the two rear towers and of the keep."""
    rng = np.random.default_rng([2006, 21])
    meshes = [mesh for corner in ROOFED for mesh in cone_roof(*corner, rng)]
    return merged(meshes + hip_roof(rng))
