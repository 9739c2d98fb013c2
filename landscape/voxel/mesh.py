"""The vertices of a region: what OpenGL is sent, sorted by tile and by direction.

Four vertices a quad, in the format GL_T2F_C4UB_V3F of glInterleavedArrays (OpenGL 1.1). A merged
quad repeats its tile, so texture coordinates count blocks. The colour is the block's tint, times
the light of the direction, times the darkness of the corner.
"""

from dataclasses import dataclass

import numpy as np

from landscape.voxel.blocks import BLOCKS, PLANT_TILES, TILES
from landscape.voxel.faces import DIRECTIONS, Faces, visible_faces

VERTEX = np.dtype([("coordinate", "<f4", 2), ("colour", "u1", 4), ("position", "<f4", 3)])
ALL_TILES = (*TILES, "plants")
# Chosen: how much lighter or darker corners are with 0 to 3 blocks around them.
SHADES = np.array([1.0, 0.80, 0.64, 0.52], np.float32)
OVERLAP = 0.006  # blocks, chosen: of quads that are seen from nearby
TINT_STEP = 0.22  # chosen: how far the noise changes the tint of natural blocks
# Corners of a quad as fractions along and across, in the order of the shades.
CORNERS = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], np.float32)


def face_tiles() -> np.ndarray:
    """Return the index in ALL_TILES of each block's faces, (blocks, 6) in order of DIRECTIONS."""
    found = np.zeros((len(BLOCKS), len(DIRECTIONS)), np.uint8)
    for number, block in enumerate(BLOCKS):
        if block.plant:
            found[number] = len(TILES)
            continue
        side, bottom = block.side or block.top, block.bottom or block.top
        for k, direction in enumerate(DIRECTIONS):
            name = {"up": block.top, "down": bottom}.get(direction.name, side)
            found[number, k] = TILES.index(name)
    return found


UP = [each.name for each in DIRECTIONS].index("up")
FACE_TILES = face_tiles()
TINTS = np.array([block.tint for block in BLOCKS], np.float32)
NATURAL = np.array([block.natural for block in BLOCKS])
PLANT = np.array([block.plant for block in BLOCKS])
PLANT_COLUMN = np.array([PLANT_TILES.index(each.top) if each.plant else 0 for each in BLOCKS])


@dataclass(frozen=True)
class RegionMesh:
    """Vertices (4 m,) of VERTEX, sorted by tile and then by direction.

    ``counts`` (tiles, 6) says how many vertices there are of each.
    """

    vertices: np.ndarray
    counts: np.ndarray


@dataclass(frozen=True)
class Look:
    """What colours depend on.

    ``light`` (6, 4) is the colour of the light on faces in each of DIRECTIONS, with the alpha that
    shadows need, and ``tint`` (n + 1, n + 1) a noise of -1..1 over the corners of the columns,
    [x, z]. Quads overlap their neighbours by ``overlap`` blocks, so that no background shows
    through where a corner of one meets the side of another (a T-junction).
    """

    light: np.ndarray
    tint: np.ndarray
    overlap: float = OVERLAP


def quads(faces: Faces, origin: tuple[int, int, int], look: Look) -> np.ndarray:
    """Return the vertices (m, 4) of faces; ``origin`` is the place [x, z, y] of the region."""
    direction = faces.direction
    corners = CORNERS[::-1] if direction.swapped else CORNERS
    shade = faces.shade[:, ::-1] if direction.swapped else faces.shade
    sides = np.stack([faces.long, faces.wide], axis=1).astype(np.float32)
    place = (faces.low + np.array(origin)).astype(np.float32)
    outwards = look.overlap * (2 * corners - 1)
    across = corners * sides[:, None, :] + outwards  # (m, 4, 2)
    at = np.repeat(place[:, None, :], 4, axis=1)
    at[..., direction.along] += across[..., 0]
    at[..., direction.across] += across[..., 1]
    at[..., direction.axis] += direction.sign > 0

    found = np.empty((len(faces), 4), VERTEX)
    found["position"] = at[..., [0, 2, 1]]  # [x, z, y] to x, y, z
    found["coordinate"] = at[..., [direction.along, direction.across]]
    if direction.across == 2:  # row 0 of a tile is its upper edge
        found["coordinate"][..., 1] *= -1
    found["colour"] = colours(faces, shade, at, look)
    return brighter_diagonal(found, shade)


def colours(faces: Faces, shade: np.ndarray, at: np.ndarray, look: Look) -> np.ndarray:
    """Return the colours (m, 4, 4), uint8, of corners at (m, 4, 3) [x, z, y]."""
    k = DIRECTIONS.index(faces.direction)
    tint = np.repeat((TINTS[faces.block] * look.light[k, :3])[:, None, :], 4, axis=1)
    tint *= SHADES[shade][..., None]
    natural = NATURAL[faces.block]
    last = len(look.tint) - 1
    x, z = (np.clip(np.rint(at[natural][..., axis]), 0, last).astype(np.intp) for axis in (0, 1))
    noise = look.tint[x, z][..., None]
    tint[natural] *= 1.0 + TINT_STEP * noise * np.array([1.0, 0.50, 0.30], np.float32)
    found = np.full((len(faces), 4, 4), 255, np.uint8)
    found[..., :3] = np.clip(tint + 0.5, 0, 255)
    found[..., 3] = round(255 * look.light[k, 3])
    return found


def brighter_diagonal(vertices: np.ndarray, shade: np.ndarray) -> np.ndarray:
    """Return quads whose first corner is chosen so that OpenGL splits them along the lighter pair.

    Split along the darker pair, one dark corner would darken half the quad and look like a spike.
    """
    dark = shade.astype(np.int16)
    turned = dark[:, 0] + dark[:, 2] > dark[:, 1] + dark[:, 3]
    vertices[turned] = np.roll(vertices[turned], 1, axis=1)
    return vertices


def plant_quads(blocks: np.ndarray, origin: tuple[int, int, int], look: Look) -> np.ndarray:
    """Return two crossed quads (m, 4) for each plant in a region, blocks without an edge.

    Plants do not stand in rows: each is moved a little from the middle of its block.
    """
    place = np.argwhere(PLANT[blocks])
    kinds = blocks[tuple(place.T)]
    place = place + np.array(origin)
    # A number from the place, so that a plant stays where it is when its region is built again.
    jitter = (place @ np.array([73, 151, 37]))[:, None] * np.array([0.61803, 0.75488])
    middle = place[:, :2] + 0.5 + 0.5 * (jitter % 1.0 - 0.5)
    found = np.empty((len(place), 2, 4), VERTEX)
    column = PLANT_COLUMN[kinds]
    last = len(look.tint) - 1
    noise = look.tint[tuple(np.minimum(place[:, :2], last).T)][:, None]
    tint = TINTS[kinds] * look.light[UP, :3] * (1.0 + TINT_STEP * noise * NATURAL[kinds][:, None])
    for quad, (dx, dz) in enumerate(((0.36, 0.36), (0.36, -0.36))):
        for corner, (side, top) in enumerate(((-1, 0), (1, 0), (1, 1), (-1, 1))):
            vertex = found[:, quad, corner]
            vertex["position"][:, 0] = middle[:, 0] + side * dx
            vertex["position"][:, 1] = place[:, 2] + top * 0.9
            vertex["position"][:, 2] = middle[:, 1] + side * dz
            vertex["coordinate"][:, 0] = (column + 0.5 + 0.49 * side) / len(PLANT_TILES)
            vertex["coordinate"][:, 1] = 1.0 - top
            # Darker at the root.
            shaded = tint * (1.0 if top else 0.72)
            vertex["colour"][:, :3] = np.clip(shaded, 0, 255)
            vertex["colour"][:, 3] = 255
    return found.reshape(-1, 4)


def region_mesh(
    blocks: np.ndarray,
    origin: tuple[int, int, int],
    look: Look,
    merge: str = "rectangles",
    occlusion: bool = True,
    plants: bool = True,
) -> RegionMesh:
    """Return the mesh of blocks [x, z, y], uint8 with an edge all around.

    ``origin`` is the place [x, z, y] of the first block within the edge.
    """
    sets, keys = [], []
    for k, direction in enumerate(DIRECTIONS):
        faces = visible_faces(blocks, direction, merge, occlusion)
        sets.append(quads(faces, origin, look))
        keys.append(FACE_TILES[faces.block, k].astype(np.intp) * len(DIRECTIONS) + k)
    if plants:
        crossed = plant_quads(blocks[1:-1, 1:-1, 1:-1], origin, look)
        sets.append(crossed)
        keys.append(np.full(len(crossed), len(TILES) * len(DIRECTIONS) + UP))
    key = np.concatenate(keys)
    order = np.argsort(key, kind="stable")
    counts = 4 * np.bincount(key, minlength=len(ALL_TILES) * len(DIRECTIONS))
    vertices = np.concatenate(sets)[order].reshape(-1)
    return RegionMesh(vertices, counts.reshape(len(ALL_TILES), len(DIRECTIONS)).astype(np.int32))
