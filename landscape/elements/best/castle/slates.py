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
    out = 0.05
    middle = np.array([(x0 + x1) / 2, (z0 + z1) / 2])
    half = (x1 - x0) / 2 + out
    slant = math.hypot(half, KEEP_ROOF)
    meshes = []
    rows, columns = 7, 9
    share, across = np.meshgrid(np.linspace(0, 1, rows), np.linspace(-1, 1, columns), indexing="ij")
    for turn in range(4):
        c, s = round(math.cos(turn * math.pi / 2)), round(math.sin(turn * math.pi / 2))
        flare = 0.018 * np.clip(0.25 - share, 0.0, 1.0) / 0.25
        reach = half * (1.0 - share) + flare
        side = across * reach
        y = top + share * KEEP_ROOF - 0.3 * flare
        sag = rng.uniform(-UNEVEN, UNEVEN, y.shape) * (np.abs(across) < 1) * (share < 1)
        reach, y = reach + sag * (share > 0), y + sag
        x, z = middle[0] + c * reach - s * side, middle[1] + s * reach + c * side
        grid = np.stack([x, y, z], axis=-1)
        uv = np.stack([side / TILE + 0.37 * turn, -share * slant / TILE], axis=-1)
        meshes.append(surface(grid, uv))
        inner = np.stack(
            [
                middle[0] + (half - out) * (c - s * across[0]),
                np.full(columns, top),
                middle[1] + (half - out) * (s + c * across[0]),
            ],
            axis=-1,
        )
        meshes.append(surface(np.stack([inner, grid[0]]), np.broadcast_to(BARE, (2, columns, 2))))
        # The hip between this slope and the next, a row of tiles that overlap.
        low = grid[0, 0]
        peak = np.array([middle[0], top + KEEP_ROOF, middle[1]])
        along = (peak - low) / RIDGE_TILES
        flat = np.array([along[2], 0.0, -along[0]]) / math.hypot(along[0], along[2])
        for k in range(RIDGE_TILES):
            begin, end = low + along * (k - 0.08), low + along * (k + 1)
            wide, lift = 0.011 + rng.uniform(-0.001, 0.001), np.array([0.0, 0.008, 0.0])
            edge = np.array([0.0, -0.008, 0.0])
            ends = [
                np.array([at + wide * flat + edge, at + up, at - wide * flat + edge])
                for at, up in ((begin, 1.35 * lift), (end, lift))
            ]
            grid_ = np.array(ends)[:, ::-1]
            patch = np.array(BARE) + np.array(
                [[(0.03 * k, 0.0), (0.03 * k + 0.02, 0.0), (0.03 * k + 0.04, 0.0)]] * 2
            )
            meshes.append(surface(grid_, patch))

    return meshes


def slate_roofs() -> Mesh:
    """Return the roofs of the two rear towers and of the keep."""
    rng = np.random.default_rng([2006, 21])
    meshes = [mesh for corner in ROOFED for mesh in cone_roof(*corner, rng)]
    return merged(meshes + hip_roof(rng))
