"""The atlas of the sprites: every tree, deer and plant in one texture (section 5.1).

One texture for all lets one glDrawElements draw them in any order. A cell holds four small pictures
of crowns and of a plant as seen from above, turned out of the side views: a fix of section 11.2.2.
With ``plants.species`` over 1 the atlas has twice the rows, for the herbs and their views from
above. No OpenGL here; an image's row 0 is t = 0.
"""

import numpy as np
from PIL import Image

from landscape.files.images import mip_chain

CELL = 512  # chosen: texels per side of a sprite in the atlas
CELLS = (
    "tree_broadleaf.png",
    "tree_conifer.png",
    "tree_birch.png",
    "tree_shrub.png",
    "deer_stag.png",
    "deer_doe.png",
    "plant.png",
)
HERBS = ("fern.png", "oxeye.png", "willowherb.png", "marram.png", "heather.png")
HERB = 8  # the first herb's cell; the views from above take the one before it
FLOWERING = (9, 10, 12)  # cells of herbs with their flowers on top
COLUMNS, ROWS, HERB_ROWS = 4, 2, 4
# Chosen: transparent texels left above each sprite. At mip level 5 they are still one texel, and
# the foot of the tree in the row above does not show over a fern's head.
GUTTER = 32
LEVELS = 6  # chosen: at the last mip level a cell is 16 texels wide

TOPS_CELLS = (7, 13, 14)  # cells no sprite takes: four quarters each, with a GUTTER all round
QUARTER = CELL // 2
TOP_SIDE = QUARTER - 2 * GUTTER
# Chosen, by looking at the pictures: cell; centre of the fan in s, t; its reach in s and t; the
# angle of its middle (0 up, 180 down); half its opening; how many fans make the round.
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
# Quarter of each cell's top, four to each of TOPS_CELLS; deer have none.
TOP_OF_CELL = np.array([0, 1, 2, 0, 0, 0, 3, 0, 4, 5, 6, 7, 8])


def padded(image: np.ndarray) -> np.ndarray:
    """Return a sprite (h, w, 4) as a cell, with its own top colours, clear, in the GUTTER."""
    resized = Image.fromarray(image).resize((CELL, CELL - GUTTER), Image.Resampling.LANCZOS)
    cell = np.pad(np.asarray(resized), ((GUTTER, 0), (0, 0), (0, 0)), mode="edge")
    cell[:GUTTER, :, 3] = 0
    return cell


def from_above(
    image: np.ndarray,
    centre: tuple[float, float],
    reach: tuple[float, float],
    middle_deg: float,
    half_deg: float,
    fans: int,
    side: int,
) -> np.ndarray:
    """Return a round picture (side, side, 4) of a plant from above, out of its side view.

    A fan of the side view, from ``centre`` on, is laid round the axis ``fans`` times (even), every
    second one mirrored so that they join.
    """
    at = (np.arange(2 * side) + 0.5) / side - 1.0
    x, y = np.meshgrid(at, at)
    radius, angle = np.hypot(x, y), np.arctan2(y, x) % (2.0 * np.pi)
    turn = angle / (2.0 * np.pi) * fans % 2.0
    across = np.radians(middle_deg + half_deg * (2.0 * np.abs(turn - 1.0) - 1.0))
    h, w = image.shape[:2]
    column = ((centre[0] + reach[0] * radius * np.sin(across)) * w).astype(int)
    row = ((centre[1] - reach[1] * radius * np.cos(across)) * h).astype(int)
    inside = (radius < 1.0) & (column >= 0) & (column < w) & (row >= 0) & (row < h)
    picture = image[np.clip(row, 0, h - 1), np.clip(column, 0, w - 1)]
    picture[..., 3] = np.where(inside, picture[..., 3], 0)
    return mip_chain(picture, 2)[1]


def tops_cell(cells: list[np.ndarray], number: int = 0) -> np.ndarray:
    """Return the cell TOPS_CELLS[number] of four views from above; borders are clear and black."""
    sheet = np.zeros((CELL, CELL, 4), np.uint8)
    for k, (cell, centre, reach, middle, half, fans) in enumerate(
        TOPS[4 * number : 4 * number + 4]
    ):
        top = from_above(cells[cell][GUTTER:], centre, reach, middle, half, fans, TOP_SIDE)
        row, column = (QUARTER * q + GUTTER for q in divmod(k, 2))
        sheet[row : row + TOP_SIDE, column : column + TOP_SIDE] = top
    return sheet


def rows_of(cells: list[np.ndarray]) -> int:
    """Return how many rows the atlas of these cells has; a texture's sides are powers of two."""
    return HERB_ROWS if len(cells) > HERB else ROWS


def atlas(cells: list[np.ndarray]) -> np.ndarray:
    """Lay equal cells (side, side, 4) out in rows of COLUMNS."""
    side = cells[0].shape[0]
    sheet = np.zeros((rows_of(cells) * side, COLUMNS * side, 4), np.uint8)
    for k, cell in enumerate(cells):
        row, column = divmod(k, COLUMNS)
        sheet[row * side : (row + 1) * side, column * side : (column + 1) * side] = cell
    return sheet


def cell_coordinates(
    cells: np.ndarray, flipped: np.ndarray, s: np.ndarray, t: np.ndarray, rows: int = ROWS
) -> np.ndarray:
    """Return texture coordinates (n, k, 2) in the atlas of points s, t (k,) in 0..1 of cells (n,).

    ``flipped`` (n,) mirrors s; half a texel is kept clear of the neighbouring cells, and
    the GUTTER above. ``rows`` is how many the atlas has.
    """
    s = 0.5 / CELL + s * (1.0 - 1.0 / CELL)
    t = GUTTER / CELL + t * (1.0 - (GUTTER + 0.5) / CELL)
    turned = np.where(flipped[:, None], 1.0 - s, s)
    u = (cells[:, None] % COLUMNS + turned) / COLUMNS
    v = (cells[:, None] // COLUMNS + t) / rows
    return np.ascontiguousarray(np.stack([u, v + 0 * u], axis=2), np.float32)


def top_coordinates(cells: np.ndarray, rows: int = ROWS) -> np.ndarray:
    """Return texture coordinates (n, 4, 2) of the views from above that belong to cells (n,)."""
    number, quarter = (part[:, None] for part in np.divmod(TOP_OF_CELL[cells], 4))
    cell = np.array(TOPS_CELLS)[number]
    low, wide = GUTTER / CELL, TOP_SIDE / CELL
    s = low + wide * np.array([0.0, 1.0, 1.0, 0.0]) + 0.5 * (quarter % 2)
    t = low + wide * np.array([1.0, 1.0, 0.0, 0.0]) + 0.5 * (quarter // 2)
    u = (cell % COLUMNS + s) / COLUMNS
    v = (cell // COLUMNS + t) / rows
    return np.ascontiguousarray(np.stack([u, v], axis=2), np.float32)


def outline(alpha: np.ndarray) -> np.ndarray:
    """Return the two boxes (s0, t0, s1, t1) of least area that hold a sprite, float (2, 4).

    ``alpha`` (h, w) uint8. The boxes lie one above the other, from the first row that shows
    something to the last: the crown, and the trunk.
    """
    # Twice the finest detail: the coarse mip levels spread a sprite by some texels.
    solid = np.asarray(Image.fromarray(alpha).resize((64, 64), Image.Resampling.BOX)) > 0
    rows = np.flatnonzero(solid.any(axis=1))
    if not len(rows):
        return np.array([[0.0, 0.0, 1.0, 0.5], [0.0, 0.5, 1.0, 1.0]])

    def box(first: int, last: int) -> list[float]:
        columns = np.flatnonzero(solid[first:last].any(axis=0))
        if not len(columns):
            return [0.5, first / 64, 0.5, last / 64]
        left, right = max(columns[0] - 1, 0), min(columns[-1] + 2, 64)
        return [left / 64, first / 64, right / 64, last / 64]

    top, bottom = max(int(rows[0]) - 1, 0), 64
    best, least = np.empty((0, 4)), 2.0
    for cut in range(top + 1, bottom):
        boxes = np.array([box(top, cut), box(cut, bottom)])
        area = float(((boxes[:, 2] - boxes[:, 0]) * (boxes[:, 3] - boxes[:, 1])).sum())
        if area < least:
            best, least = boxes, area
    return best
