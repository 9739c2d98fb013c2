"""The vertices of a region: what OpenGL is sent, sorted by direction, and by where the water is.

Four vertices a quad, in the format GL_T2F_C4UB_V3F of glInterleavedArrays (OpenGL 1.1). A merged
quad repeats its tile: s counts blocks, t the rows of the column in which all tiles are. The colour
is the block's tint, times the light of the direction, times the darkness of the corner.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from landscape.voxel.blocks import BLOCKS, PLANT_TILES, TILES, block, looked_up
from landscape.voxel.faces import DIRECTIONS, EDGE, Faces, Shown, shown_in, visible_faces
from landscape.voxel.tile_column import PLACES, ROWS, WIDEST, first_row

VERTEX = np.dtype([("coordinate", "<f4", 2), ("colour", "u1", 4), ("position", "<f4", 3)])
TURNS = (*(each.name for each in DIRECTIONS), "plants")  # how faces are turned
PLANTS = len(DIRECTIONS)  # their index in TURNS
# Sets of faces: those wholly under water, those near its surface, and those above it in bands of
# height, from the highest on: so those that reach above some height, too, follow each other.
WET, SHORE, DRY = range(3)
BANDS = 40  # chosen
BAND = 2  # blocks, chosen: height of a band; all that is higher than the last belongs to it
SETS = DRY + BANDS
# Chosen: how much lighter or darker corners are with 0 to 3 blocks around them.
SHADES = np.array([1.0, 0.80, 0.64, 0.52], np.float32)
OVERLAP = 0.006  # blocks, chosen: of quads that are seen from nearby
# Blocks, measured: in views of 400 x 300 pixels from eye height half of it still left pinholes.
FIRM = 0.04
# Chosen: how far the noise changes the tint of natural blocks: red, green and blue. Grass goes from
# lush to dry.
TINT_STEP = np.array([0.22, 0.11, 0.07])
GRASS_STEP = np.array([0.34, 0.10, 0.10])
X_Z_Y = (0, 2, 1)  # where x, z and y are in a position
# Corners of a quad as fractions along and across, in the order of the shades.
CORNERS = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], np.float32)


def face_tiles() -> np.ndarray:
    """Return the index in TILES of each block's faces, (blocks, 6) in order of DIRECTIONS."""
    found = np.zeros((len(BLOCKS), len(DIRECTIONS)), np.uint8)
    for number, kind in enumerate(BLOCKS):
        if kind.plant:
            continue
        side, bottom = kind.side or kind.top, kind.bottom or kind.top
        for k, direction in enumerate(DIRECTIONS):
            name = {"up": kind.top, "down": bottom}.get(direction.name, side)
            found[number, k] = TILES.index(name)
    return found


TIP, TUFT = block("spruce tip"), block("tall grass")
# Chosen: tufts of grass have these shares of a plant's size, alike within CLUMP columns.
SMALLEST = 0.5
LARGEST = 1.05
CLUMP = 3
UP = [each.name for each in DIRECTIONS].index("up")
FACE_TILES = face_tiles()
TINTS = np.array([block.tint for block in BLOCKS], np.float32)
NATURAL = np.array([block.natural for block in BLOCKS])
GRASSY = np.array([block.top in ("grass_top", "tall_grass") for block in BLOCKS])
STEPS = (NATURAL[:, None] * np.where(GRASSY[:, None], GRASS_STEP, TINT_STEP)).astype(np.float32)
PLANT = np.array([block.plant for block in BLOCKS])
PLANT_COLUMN = np.array([PLANT_TILES.index(each.top) if each.plant else 0 for each in BLOCKS])


@dataclass(frozen=True)
class RegionMesh:
    """Vertices (4 m,) of VERTEX, sorted as in TURNS and then into sets.

    ``counts`` (7, SETS) says how many vertices there are of each.
    """

    vertices: np.ndarray
    counts: np.ndarray

    @property
    def size(self) -> int:
        """How many vertices it has."""
        return len(self.vertices)

    @property
    def box(self) -> tuple[np.ndarray, np.ndarray]:
        """The least and the greatest corner (3,) of its faces in blocks; x, y, z."""
        if not self.size:
            return np.zeros(3), np.zeros(3)
        position = self.vertices["position"]
        return position.min(axis=0).astype(np.float64), position.max(axis=0).astype(np.float64)


@dataclass(frozen=True)
class Look:
    """The light and the switches that colours depend on.

    ``light`` (6, 4) is the colour of the light on faces in each of DIRECTIONS, with the alpha that
    shadows need, and ``tint`` (n + 1, n + 1), float32, a noise of -1..1 over the corners of the
    columns, [x, z]; ``slope``, of the same shape or a single 1, is how much lighter faces that look
    up are for the slope of the land.

    Quads overlap their neighbours by ``overlap`` blocks, so that no background shows through where
    a corner of one meets the side of another (a T-junction). OpenGL rounds corners to fractions of
    a pixel, and of level ground that is seen at a grazing angle so small an overlap is less than
    that. So the faces that look up overlap by ``firm`` blocks at their firm
    sides, where it makes no ledge: it lies in a wall, or on ground that is as high. ``shore`` are
    two heights: faces are WET up to the first, and dry from the second on. ``band`` is the height
    of a band of dry faces.
    """

    light: np.ndarray
    tint: np.ndarray
    slope: np.ndarray = field(default_factory=lambda: np.ones((1, 1), np.float32))
    overlap: float = OVERLAP
    firm: float = FIRM
    shore: tuple[float, float] = (-np.inf, np.inf)
    band: float = BAND


def quads(faces: Faces, origin: tuple[int, int, int], look: Look) -> np.ndarray:
    """Return the vertices (m, 4) of faces; ``origin`` is the place [x, z, y] of the region."""
    direction = faces.direction
    corners = CORNERS[::-1] if direction.swapped else CORNERS
    shade = faces.shade[:, ::-1] if direction.swapped else faces.shade
    # Along each axis, the least and the greatest place of a face.
    low = faces.low.T + np.array(origin)[:, None]
    high = low.copy()
    high[direction.along] += faces.long
    high[direction.across] += faces.wide
    if direction.sign > 0:
        low[direction.axis] += faces.thick
        high[direction.axis] += faces.thick

    found = np.empty((len(faces), 4), VERTEX)
    position, coordinate = found["position"], found["coordinate"]
    tile = first_row(FACE_TILES[faces.block, DIRECTIONS.index(direction)])
    # Row 0 of a tile is its upper edge.
    top = tile + (faces.wide if direction.across == 2 else 0)
    turned = -1 if direction.across == 2 else 1
    position[..., X_Z_Y[direction.axis]] = low[direction.axis][:, None]
    for s, axis in enumerate((direction.along, direction.across)):
        out = np.full((2, len(faces)), look.overlap)
        if faces.firm is not None:
            out[faces.firm[:, 2 * s : 2 * s + 2].T] = look.firm
        ends = (low[axis] - out[0]).astype(np.float32), (high[axis] + out[1]).astype(np.float32)
        # Beyond the edge of a tile is its opposite side, which only those of level faces may show:
        # the tile goes on like that in the next face.
        ends_of_tile = (low[axis], high[axis]) if faces.firm is None else ends
        for corner in range(4):
            end = ends[int(corners[corner, s])]
            position[:, corner, X_Z_Y[axis]] = end
            at = ends_of_tile[int(corners[corner, s])]
            if s:
                row = top + (at - low[axis]) * turned
                coordinate[:, corner, s] = row * np.float32(1 / ROWS)
            else:
                coordinate[:, corner, s] = at
    # Which corners lie at the far end along x and z.
    far = {direction.along: corners[:, 0] > 0, direction.across: corners[:, 1] > 0}
    x, z = (
        np.stack([(high if end else low)[axis] for end in far.get(axis, 4 * [False])])
        for axis in (0, 1)
    )
    found["colour"] = colours(faces, shade, x, z, look)
    return brighter_diagonal(found, shade)


def sets(faces: Faces, bottom: int, look: Look) -> np.ndarray:
    """Return the set of each face, (m,); ``bottom`` is the region's lowest level."""
    direction = faces.direction
    raised = faces.thick if direction.axis == 2 and direction.sign > 0 else 0
    low = faces.low[:, 2] + (bottom + raised)
    return sets_between(low, low + faces.wide if direction.across == 2 else low, look)


def sets_between(low: np.ndarray, high: np.ndarray, look: Look) -> np.ndarray:
    """Return the sets (m,) of what reaches from heights ``low`` to ``high``."""
    wet, dry = look.shore
    if not math.isfinite(dry):  # a world without water
        return np.full(len(low), SHORE)
    band = np.ceil((high - dry) * (1 / look.band)).astype(np.intp) - 1
    dried = DRY + BANDS - 1 - np.clip(band, 0, BANDS - 1)
    return np.where(low >= dry, dried, np.where(high <= wet, WET, SHORE))


def colours(
    faces: Faces, shade: np.ndarray, x: np.ndarray, z: np.ndarray, look: Look
) -> np.ndarray:
    """Return the colours (m, 4, 4), uint8, of corners over the corners of columns x, z (4, m)."""
    k = DIRECTIONS.index(faces.direction)
    tint = (TINTS * look.light[k, :3]).astype(np.float32)[faces.block]
    last_x, last_z = look.tint.shape[0] - 1, look.tint.shape[1] - 1
    noise = look.tint[np.minimum(x, last_x), np.minimum(z, last_z)]
    steps = STEPS[faces.block]
    dark = SHADES[shade.T]
    if k == UP:
        dark = dark * at_corner(look.slope, x, z)
    found = np.empty((len(faces), 4, 4), np.uint8)
    for channel in range(3):
        value = tint[:, channel] * dark * (1 + steps[:, channel] * noise)
        found[..., channel] = np.minimum(value + np.float32(0.5), 255).T
    found[..., 3] = round(255 * look.light[k, 3])
    return found


def at_corner(values: np.ndarray, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return the values (n + 1, n + 1) of corners of columns x, z; beyond the border as there."""
    last = len(values) - 1
    return np.asarray(values[np.clip(x, 0, last), np.clip(z, 0, last)])


def brighter_diagonal(vertices: np.ndarray, shade: np.ndarray) -> np.ndarray:
    """Return quads whose first corner is chosen so that OpenGL splits them along the lighter pair.

    Split along the darker pair, one dark corner would darken half the quad and look like a spike.
    """
    if not shade.any():
        return vertices
    dark = shade.astype(np.int16)
    turned = dark[:, 0] + dark[:, 2] > dark[:, 1] + dark[:, 3]
    numbers = vertices.view(np.float32)  # of four vertices a row: they are copied faster so
    numbers[turned] = np.roll(numbers[turned], numbers.shape[1] // 4, axis=1)
    return vertices


def shown_tiles(mesh: RegionMesh) -> np.ndarray:
    """Return the index in TILES of each vertex of a mesh without plants, (m,)."""
    return np.asarray(mesh.vertices["coordinate"][:, 1] * (ROWS / PLACES)).astype(np.intp)


def plant_places(blocks: np.ndarray) -> np.ndarray:
    """Return where in blocks [x, z, y] plants are, (m, 3)."""
    flat = np.flatnonzero(looked_up(PLANT, blocks))
    return np.stack(np.unravel_index(flat, blocks.shape), axis=1)


def plant_quads(
    blocks: np.ndarray, place: np.ndarray, origin: tuple[int, int, int], look: Look
) -> np.ndarray:
    """Return two crossed quads (2 m, 4) for each plant; ``place`` (m, 3) are those in ``blocks``.

    Plants do not stand in rows: each is moved a little from the middle of its block, except the tip
    of a tree.
    """
    kinds = blocks[tuple(place.T)]
    place = place + np.array(origin)

    # A number from the place, so that a plant stays where it is when its region is built again.
    jitter = (place @ np.array([73, 151, 37]))[:, None] * np.array([0.61803, 0.75488])
    moved = np.where(kinds == TIP, 0.0, 0.5)[:, None] * (jitter % 1.0 - 0.5)
    middle = place[:, :2] + 0.5 + moved
    size = np.where(kinds == TUFT, tuft_sizes(place), 1.0)
    found = np.empty((len(place), 2, 4), VERTEX)
    column = PLANT_COLUMN[kinds]
    last = len(look.tint) - 1
    noise = look.tint[tuple(np.minimum(place[:, :2], last).T)][:, None]
    slope = at_corner(look.slope, place[:, 0], place[:, 1])[:, None]
    tint = TINTS[kinds] * look.light[UP, :3] * slope * (1.0 + STEPS[kinds] * noise)
    for quad, (dx, dz) in enumerate(((0.36, 0.36), (0.36, -0.36))):
        for corner, (side, top) in enumerate(((-1, 0), (1, 0), (1, 1), (-1, 1))):
            vertex = found[:, quad, corner]
            vertex["position"][:, 0] = middle[:, 0] + side * dx * size
            vertex["position"][:, 1] = place[:, 2] + top * 0.9 * size
            vertex["position"][:, 2] = middle[:, 1] + side * dz * size
            vertex["coordinate"][:, 0] = (column + 0.5 + 0.49 * side) / len(PLANT_TILES)
            vertex["coordinate"][:, 1] = 1.0 - top
            # Darker at the root.
            shaded = tint * (1.0 if top else 0.72)
            vertex["colour"][:, :3] = np.clip(shaded, 0, 255)
            vertex["colour"][:, 3] = 255

    return found.reshape(-1, 4)


def tuft_sizes(place: np.ndarray) -> np.ndarray:
    """Return how large tufts of grass at places (m, 3) are, as shares of a plant's size, (m,)."""
    clump = (place[:, :2] // CLUMP @ np.array([73, 151])) * 0.61803 % 1.0
    own = (place @ np.array([37, 91, 53])) * 0.75488 % 1.0
    return np.asarray(SMALLEST + (LARGEST - SMALLEST) * (0.7 * clump + 0.3 * own))


def plant_sets(vertices: np.ndarray, look: Look) -> np.ndarray:
    """Return the sets (m,) of plants, from their vertices (m, 4)."""
    height = vertices["position"][..., 1]
    return sets_between(
        height.min(axis=1, initial=np.inf), height.max(axis=1, initial=-np.inf), look
    )


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
    return region_meshes(blocks, 0, origin, look, merge, occlusion, plants)[0]


def region_meshes(
    blocks: np.ndarray,
    size: int,
    origin: tuple[int, int, int],
    look: Look,
    merge: str = "rectangles",
    occlusion: bool = True,
    plants: bool = True,
    shown: Shown | None = None,
) -> list[RegionMesh]:
    """Return the meshes of regions that lie side by side, in rows along z.

    They are the same as :func:`region_mesh` makes of each, but numpy is called once for all.
    ``size`` columns are a region; 0 means that there is only one. ``shown`` is what
    :func:`shown_in` returns, if that is known.
    """
    rows, number = ((side - 2 * EDGE) // size if size else 1 for side in blocks.shape[:2])

    def regions(low: np.ndarray) -> np.ndarray:
        """Return the regions (m,) in which faces or plants at ``low`` (m, 3) are."""
        if not size:
            return np.zeros(len(low), np.intp)
        return np.asarray(low[:, 0] // size * number + low[:, 1] // size)

    shown = shown or shown_in(blocks)
    parts = []
    for direction in DIRECTIONS:
        faces = visible_faces(blocks, direction, merge, occlusion, shown, size, WIDEST)
        parts.append(part_of(faces, regions(faces.low), origin, look))
    if plants:
        inner = blocks[EDGE:-EDGE, EDGE:-EDGE, EDGE:-EDGE]
        place = plant_places(inner)
        crossed = plant_quads(inner, place, origin, look)
        parts.append(part_of_plants(crossed, np.repeat(regions(place), 2), look))
    return assembled(parts, rows * number)


class Part(NamedTuple):
    """Quads (m, 4) of VERTEX, and of each the region, the index in TURNS and the set: ``key`` (m,).

    They are one number: the sets of the first direction of the first region come first.
    """

    quads: np.ndarray
    key: np.ndarray


def part_of(
    faces: Faces, regions: np.ndarray | int, origin: tuple[int, int, int], look: Look
) -> Part:
    """Return the quads of faces, of which ``regions`` (m,) says where they are."""
    turn = DIRECTIONS.index(faces.direction)
    key = (regions * len(TURNS) + turn) * SETS + sets(faces, origin[2], look)
    return Part(quads(faces, origin, look), key)


def part_of_plants(crossed: np.ndarray, regions: np.ndarray | int, look: Look) -> Part:
    """Return the quads (m, 4) of plants as a part."""
    return Part(crossed, (regions * len(TURNS) + PLANTS) * SETS + plant_sets(crossed, look))


def assembled(parts: Sequence[Part], regions: int) -> list[RegionMesh]:
    """Return the meshes of so many regions, of all their quads."""
    key = np.concatenate([part.key for part in parts])
    counts = 4 * np.bincount(key, minlength=regions * len(TURNS) * SETS)
    counts = counts.reshape(regions, len(TURNS), SETS)
    # Numbers of 16 bits are sorted in two steps of 8 bits.
    order = np.argsort(key.astype(np.min_scalar_type(counts.size)), kind="stable")
    # As plain numbers, four vertices a row, whole quads are copied at once.
    rows = np.concatenate([part.quads.view(np.float32) for part in parts])
    vertices = rows[order].reshape(-1).view(VERTEX)
    ends = np.cumsum(counts.sum(axis=(1, 2)))
    return [
        RegionMesh(vertices[end - count.sum() : end], count.astype(np.int32))
        for end, count in zip(ends, counts, strict=True)
    ]
