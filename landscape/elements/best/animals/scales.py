"""The skin of a reptile as a tile: rounded scales with furrows between them (``dragon.scaly``).

Technique: cellular texture. Points are scattered, one in each square of a lattice that is closed
into a ring; each texel belongs to its nearest point. How much nearer that point is than the next
one tells how far the texel lies from the furrow. The tile is grey, and multiplies the colours of
the vertices. Scales have no direction: where two charts of axis_mapping.py meet, nothing shows.
Horns, teeth, eyes, fins and the plates of the belly have none (:func:`scaled_skin`). All of it is
duller than its paint (:func:`muted`).
Source: Worley, A cellular texture basis function, SIGGRAPH 1996. No OpenGL.
"""

from dataclasses import replace

import numpy as np

from landscape.geometry.mesh import Mesh

SIDE = 512  # texels
SCALES = 32  # chosen: scales along a side of the tile
SCATTER = 0.68  # chosen: part of its square of the lattice in which a scale's point may lie
FURROW = 0.45  # chosen: width of a furrow and its flanks, in squares of the lattice
DARKEST = 0.56  # chosen: brightness at the bottom of a furrow
DOMED = 0.42  # chosen: brightness that a scale loses from its middle, by the square of the way out
UNLIKE = 0.16  # chosen: how much scales differ in brightness
PATCHES, PATCH = 0.10, 3  # chosen: how much larger parts of the skin do, and cycles of these a side
GRAINS, GRAIN = 5, 0.10  # chosen: grains along a scale, and how much they differ in brightness
VIVID, DIMMED = 0.52, 0.86  # chosen: how much colour and how much light skin has of its paint
SEED = 2006


def nearest_points(side: int, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the distances to the nearest point and the next, and the nearest one's number.

    Each is (side, side). Distances are in squares of a lattice of ``count`` by ``count``.
    """
    generator = np.random.default_rng(SEED)
    points = generator.uniform(0.5 - 0.5 * SCATTER, 0.5 + 0.5 * SCATTER, (count, count, 2))
    at = (np.arange(side) + 0.5) * count / side
    square = at.astype(int)

    first = np.full((side, side), np.inf)
    second = np.full((side, side), np.inf)
    number = np.zeros((side, side), int)
    for down in (-1, 0, 1):
        for across in (-1, 0, 1):
            row, column = (square + down) % count, (square + across) % count
            there = points[np.ix_(row, column)]
            y = there[..., 0] + (square + down)[:, None] - at[:, None]
            x = there[..., 1] + (square + across)[None, :] - at[None, :]
            away = np.hypot(x, y)
            nearer = away < first
            second = np.where(nearer, first, np.minimum(second, away))
            number = np.where(nearer, row[:, None] * count + column[None, :], number)
            first = np.where(nearer, away, first)
    return first, second, number


def scales(side: int = SIDE, count: int = SCALES) -> np.ndarray:
    """Return the tile, uint8 (side, side, 3), whose opposite edges continue each other."""
    first, second, number = nearest_points(side, count)
    generator = np.random.default_rng(SEED + 1)
    tone = generator.uniform(1.0 - UNLIKE, 1.0 + UNLIKE, count * count)[number]

    # A scale is a dome that goes over into the furrow: with flat scales and lines between them the
    # skin would be tiled.
    rim = np.clip((second - first) / FURROW, 0.0, 1.0)
    rim = np.sin(0.5 * np.pi * rim) ** 0.7
    dome = 1.0 - DOMED * np.square(first / 0.7)
    turn = 2.0 * np.pi * PATCH * np.arange(side) / side
    patches = np.sin(turn)[:, None] * np.sin(turn + 1.0)[None, :]
    patches = 1.0 + PATCHES * np.sin(turn[:, None] + 1.7 * patches) * np.sin(turn + 1.7 * patches)
    grains = nearest_points(side, count * GRAINS)[0] if count * GRAINS < side else 0.5
    grey = (DARKEST + (1.0 - DARKEST) * rim) * dome * tone * patches
    grey *= 1.0 + GRAIN * (1.0 - 2.0 * grains)
    grey *= 1.04 / np.quantile(grey, 0.98)
    return np.repeat(np.rint(np.clip(grey, 0.0, 1.0) * 255)[..., None], 3, axis=2).astype(np.uint8)


def brightest(tile: np.ndarray) -> np.ndarray:
    """Return the texture coordinates (2,) of the middle of the tile's brightest scale."""
    row, column = np.unravel_index(tile[..., 0].argmax(), tile.shape[:2])
    return np.array([column + 0.5, row + 0.5]) / tile.shape[0]


def scaled_skin(mesh: Mesh, spot: np.ndarray) -> Mesh:
    """Return a mesh whose faces show scales only where its colours are bluer than red.

    That is the painted skin. All corners of the other faces look up ``spot`` (2,), where the tile
    changes no colour. A mesh without colours is scaled all over.
    """
    if mesh.colors is None:
        return mesh
    skin = mesh.colors[:, 2].astype(int) > mesh.colors[:, 0]
    bare = ~skin[mesh.triangles].all(axis=1)
    corners, number = np.unique(mesh.triangles[bare], return_inverse=True)
    triangles = mesh.triangles.copy()
    triangles[bare] = (len(mesh.vertices) + number.reshape(-1, 3)).astype(np.uint32)
    plain = np.tile(spot.astype(np.float32), (len(corners), 1))
    return replace(
        mesh,
        vertices=np.concatenate([mesh.vertices, mesh.vertices[corners]]),
        normals=np.concatenate([mesh.normals, mesh.normals[corners]]),
        triangles=triangles,
        coordinates=(np.concatenate([mesh.coordinates[0], plain]),),
        colors=np.concatenate([mesh.colors, mesh.colors[corners]]),
    )


def muted(mesh: Mesh) -> Mesh:
    """Return a mesh whose colours, if it has any, are those of wet skin rather than of paint."""
    if mesh.colors is None:
        return mesh
    colour = mesh.colors[:, :3].astype(np.float32)
    light = (colour @ np.array([0.30, 0.59, 0.11], np.float32))[:, None]
    duller = DIMMED * (light + VIVID * (colour - light))
    colours = mesh.colors.copy()
    colours[:, :3] = np.clip(duller + 0.5, 0, 255)
    return replace(mesh, colors=colours)
