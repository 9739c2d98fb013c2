"""The atlas of the refined sprites: herbs, pictures from above, and what is opaque in a cell.

A cell that no sprite uses holds four small pictures of crowns and plants as seen from above, made
from the side views: a fix of section 11.2.2. With ``plants.species`` over 1 the atlas has twice the
rows, for the herbs and their pictures from above. No OpenGL here.
"""

import numpy as np
from PIL import Image

from landscape.elements.atlas import (
    CELL,
    CELLS,
    COLUMNS,
    GUTTER,
    LEVELS,
    ROWS,
    cell_coordinates,
    laid_out,
)
from landscape.elements.best.sprites.backs import back_from_above
from landscape.elements.planting import DEER
from landscape.files.images import bled, mip_chain

HERB_ROWS = 4
FLOWERING = (9, 10, 12)  # cells of herbs with their flowers on top

TOPS_CELLS = (7, 13, 14)  # cells no sprite uses: four quarters each, with a GUTTER all around
QUARTER = CELL // 2
TOP_SIDE = QUARTER - 2 * GUTTER
# Chosen, by looking at the pictures: cell; centre of the fan in s, t; its radius in s and t; the
# angle of its middle (0 up, 180 down); half its opening; how many fans make the full circle.
TOPS = (
    (0, (0.50, 0.44), (0.49, 0.41), 0.0, 84.0, 2),
    (1, (0.47, 0.10), (0.92, 0.92), 180.0, 24.0, 14),
    (2, (0.50, 0.38), (0.47, 0.37), 0.0, 88.0, 2),
    (6, (0.50, 1.00), (1.02, 1.02), 24.0, 17.0, 10),
    (8, (0.50, 1.00), (0.98, 0.98), 32.0, 26.0, 8),
    (9, (0.50, 0.42), (0.48, 0.40), 0.0, 88.0, 2),
    (10, (0.50, 0.40), (0.48, 0.38), 0.0, 88.0, 2),
    (11, (0.50, 1.00), (0.95, 0.95), 0.0, 45.0, 6),
    (12, (0.50, 0.44), (0.46, 0.40), 0.0, 88.0, 2),
)
BACKS = (DEER, DEER + 1)  # cells whose pictures from above are not fans, see backs.py
# Which picture from above each cell has, four to each of TOPS_CELLS.
TOP_OF_CELL = np.array([0, 1, 2, 0, 9, 10, 3, 0, 4, 5, 6, 7, 8])


def with_herbs(cells: list[np.ndarray]) -> list[np.ndarray]:
    """Return the cells of CELLS and HERBS in order, with the free cell between them."""
    if len(cells) <= len(CELLS):
        return cells
    return [*cells[: len(CELLS)], np.zeros_like(cells[0]), *cells[len(CELLS) :]]


def from_above(
    image: np.ndarray,
    centre: tuple[float, float],
    radius: tuple[float, float],
    middle_deg: float,
    half_deg: float,
    fans: int,
    side: int,
) -> np.ndarray:
    """Return a round picture (side, side, 4) of a plant from above, made from its side view.

    A fan cut out of the side view, from ``centre`` outwards, is laid around the axis ``fans`` times
    (an even number), every second one mirrored so that their edges join.
    """
    at = (np.arange(2 * side) + 0.5) / side - 1.0
    x, y = np.meshgrid(at, at)
    distance, angle = np.hypot(x, y), np.arctan2(y, x) % (2.0 * np.pi)
    turn = angle / (2.0 * np.pi) * fans % 2.0
    across = np.radians(middle_deg + half_deg * (2.0 * np.abs(turn - 1.0) - 1.0))
    h, w = image.shape[:2]
    column = ((centre[0] + radius[0] * distance * np.sin(across)) * w).astype(int)
    row = ((centre[1] - radius[1] * distance * np.cos(across)) * h).astype(int)
    inside = (distance < 1.0) & (column >= 0) & (column < w) & (row >= 0) & (row < h)
    picture = image[np.clip(row, 0, h - 1), np.clip(column, 0, w - 1)]
    picture[..., 3] = np.where(inside, picture[..., 3], 0)
    return mip_chain(picture, 2)[1]


def tops_cell(cells: list[np.ndarray], number: int = 0) -> np.ndarray:
    """Return the cell TOPS_CELLS[number]: four pictures from above, their surround transparent."""
    sheet = np.zeros((CELL, CELL, 4), np.uint8)
    for k in range(4):
        which = 4 * number + k
        if which < len(TOPS):
            cell, centre, radius, middle, half, fans = TOPS[which]
            top = from_above(cells[cell][GUTTER:], centre, radius, middle, half, fans, TOP_SIDE)
        elif which < len(TOPS) + len(BACKS):
            top = back_from_above(cells[BACKS[which - len(TOPS)]][GUTTER:], TOP_SIDE)
        else:
            break
        row, column = (QUARTER * q + GUTTER for q in divmod(k, 2))
        sheet[row : row + TOP_SIDE, column : column + TOP_SIDE] = top
    return sheet


def bled_levels(cells: list[np.ndarray]) -> tuple[np.ndarray, ...]:
    """Return the mip levels of the atlas of these cells, without dark seams around the pictures."""
    chains = [[bled(level) for level in mip_chain(cell, LEVELS)] for cell in cells]
    return tuple(laid_out([chain[level] for chain in chains]) for level in range(LEVELS))


def tops_levels(cells: list[np.ndarray]) -> tuple[np.ndarray, ...]:
    """Return the mip levels of all TOPS_CELLS that go with these cells, (k, side, side, 4) each."""
    count = len(TOPS_CELLS) if len(cells) > len(CELLS) else 1
    chains = [mip_chain(tops_cell(cells, number), LEVELS) for number in range(count)]
    return tuple(np.stack(level) for level in zip(*chains, strict=True))


def tops_place(number: int, level: int) -> tuple[int, int, int, int]:
    """Return x, y, width and height in texels of TOPS_CELLS[number] at a mip level."""
    side = CELL >> level
    row, column = divmod(TOPS_CELLS[number], COLUMNS)
    return side * column, side * row, side, side


def top_coordinates(cells: np.ndarray, rows: int = ROWS) -> np.ndarray:
    """Return texture coordinates (n, 4, 2) of the pictures from above that belong to cells (n,)."""
    number, quarter = (part[:, None] for part in np.divmod(TOP_OF_CELL[cells], 4))
    cell = np.array(TOPS_CELLS)[number]
    low, wide = GUTTER / CELL, TOP_SIDE / CELL
    s = low + wide * np.array([0.0, 1.0, 1.0, 0.0]) + 0.5 * (quarter % 2)
    t = low + wide * np.array([1.0, 1.0, 0.0, 0.0]) + 0.5 * (quarter // 2)
    u = (cell % COLUMNS + s) / COLUMNS
    v = (cell // COLUMNS + t) / rows
    return np.ascontiguousarray(np.stack([u, v], axis=2), np.float32)


def _box(solid: np.ndarray, first: int, last: int) -> list[float]:
    """Return the box (s0, t0, s1, t1) around some rows of a picture (64, 64) that shows something.

    It reaches a texel further to both sides.
    """
    columns = np.flatnonzero(solid[first:last].any(axis=0))
    if not len(columns):
        return [0.5, first / 64, 0.5, last / 64]
    left, right = max(columns[0] - 1, 0), min(columns[-1] + 2, 64)
    return [left / 64, first / 64, right / 64, last / 64]


def outline(alpha: np.ndarray) -> np.ndarray:
    """Return the two boxes (s0, t0, s1, t1) of least area that contain a picture, float (2, 4).

    ``alpha`` (h, w) uint8. The boxes are one above the other, from the first row that shows
    something to the last: the crown, and the trunk.
    """
    # Twice the finest detail: the coarse mip levels spread a picture by some texels.
    solid = np.asarray(Image.fromarray(alpha).resize((64, 64), Image.Resampling.BOX)) > 0
    rows = np.flatnonzero(solid.any(axis=1))
    if not len(rows):
        return np.array([[0.0, 0.0, 1.0, 0.5], [0.0, 0.5, 1.0, 1.0]])

    top, bottom = max(int(rows[0]) - 1, 0), 64
    best, least = np.empty((0, 4)), 2.0
    for cut in range(top + 1, bottom):
        boxes = np.array([_box(solid, top, cut), _box(solid, cut, bottom)])
        area = float(((boxes[:, 2] - boxes[:, 0]) * (boxes[:, 3] - boxes[:, 1])).sum())
        if area < least:
            best, least = boxes, area
    return best


def box_corners(boxes: np.ndarray) -> np.ndarray:
    """Return the corners (..., 4, 2) of boxes (..., 4) = s0, t0, s1, t1, in a billboard's order.

    s runs from left to right and t from top to bottom, 0..1.
    """
    return np.stack([boxes[..., [0, 2, 2, 0]], boxes[..., [3, 3, 1, 1]]], axis=-1)


def outlines(cells: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Return where the two boxes of each picture are on its quad, and in the atlas.

    Both are (2, cells, 8, 2): not mirrored and mirrored, then 4 corners of each box.
    """
    boxes = np.array([outline(cell[GUTTER:, :, 3]) for cell in cells])
    rows = -(-len(cells) // COLUMNS)
    mirrored = np.stack([1 - boxes[..., 2], boxes[..., 1], 1 - boxes[..., 0], boxes[..., 3]], 2)
    corners = box_corners(np.stack([boxes, mirrored])).reshape(2, len(cells), 8, 2)
    coordinates = np.array(
        [
            [
                cell_coordinates(np.array([cell]), np.array([bool(flip)]), s, t, rows)[0]
                for cell, (s, t) in enumerate(corners[flip].transpose(0, 2, 1))
            ]
            for flip in (0, 1)
        ]
    )
    return corners.astype(np.float32), coordinates
