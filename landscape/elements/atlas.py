"""The atlas: the pictures of all trees, deer and plants in one texture (section 5.1).

With one texture for all, one glDrawElements can draw them in any order, which sorted sprites need.
Each picture has a square cell. Where cells meet, filtering and mip levels would mix neighbours; so
each cell is downsampled separately, texture coordinates stay half a texel inside the cell's border,
and transparent texels are left above each picture. No OpenGL here; an image's row 0 is t = 0.
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image

from landscape.files.images import has_alpha, mip_chain, read_image

CELL = 512  # chosen: texels per side of a cell
CELLS = (
    "tree_broadleaf.png",
    "tree_conifer.png",
    "tree_birch.png",
    "tree_shrub.png",
    "deer_stag.png",
    "deer_doe.png",
    "plant.png",
)
COLUMNS, ROWS = 4, 2  # the sides of a texture are powers of two
# Chosen: transparent texels above each picture. At mip level 5 they are still one texel, so the
# foot of the tree in the row above does not show over a plant's top.
GUTTER = 32
NEARLY_WHITE = 96  # chosen: levels of the darkest channel below white from which all is opaque
LEVELS = 6  # chosen: at the last mip level a cell is 16 texels wide


def padded(image: np.ndarray) -> np.ndarray:
    """Return a picture (h, w, 4) as a cell: its top row, made transparent, fills the GUTTER."""
    resized = Image.fromarray(image).resize((CELL, CELL - GUTTER), Image.Resampling.LANCZOS)
    cell = np.pad(np.asarray(resized), ((GUTTER, 0), (0, 0), (0, 0)), mode="edge")
    cell[:GUTTER, :, 3] = 0
    return cell


def on_white(image: np.ndarray) -> np.ndarray:
    """Return a picture (h, w, 4) with its transparent surround painted white, opaque."""
    alpha = image[..., 3:] / 255.0
    colours = image[..., :3] * alpha + 255.0 * (1.0 - alpha)
    return np.concatenate([np.rint(colours), np.full_like(alpha, 255)], axis=2).astype(np.uint8)


def white_to_alpha(image: np.ndarray) -> np.ndarray:
    """Return an opaque picture (h, w, 4) with its white replaced by transparency (section 5.1.1).

    A texel that is nearly white, as along an outline, is the picture's colour mixed with white: it
    keeps the colour, and as much alpha as there is of it.
    """
    colours = image[..., :3].astype(np.float64)
    alpha = np.clip((255.0 - colours.min(axis=2, keepdims=True)) / NEARLY_WHITE, 0.0, 1.0)
    unmixed = (colours - 255.0 * (1.0 - alpha)) / np.maximum(alpha, 1e-6)
    keyed = np.concatenate([np.where(alpha > 0.0, unmixed, 255.0), 255.0 * alpha], axis=2)
    return np.rint(keyed.clip(0.0, 255.0)).astype(np.uint8)


def read_picture(path: Path, surround: str) -> np.ndarray:
    """Read a picture (h, w, 4) with what is around it: its alpha, "white", or white "keyed" out.

    A file without an alpha channel is keyed as well, as the report's were.
    """
    image = read_image(path)
    if surround == "alpha":
        return image if has_alpha(path) else white_to_alpha(image)
    white = on_white(image)
    return white_to_alpha(white) if surround == "keyed" else white


def read_cells(paths: Sequence[Path], surround: str = "alpha") -> list[np.ndarray]:
    """Read pictures, one per cell; ``surround`` is that of :func:`read_picture`."""
    return [padded(read_picture(path, surround)) for path in paths]


def laid_out(cells: Sequence[np.ndarray]) -> np.ndarray:
    """Lay equal cells (side, side, 4) out in rows of COLUMNS."""
    side, rows = cells[0].shape[0], -(-len(cells) // COLUMNS)
    sheet = np.zeros((rows * side, COLUMNS * side, 4), np.uint8)
    for k, cell in enumerate(cells):
        row, column = divmod(k, COLUMNS)
        sheet[row * side : (row + 1) * side, column * side : (column + 1) * side] = cell
    return sheet


def mip_levels(cells: Sequence[np.ndarray]) -> tuple[np.ndarray, ...]:
    """Return the mip levels of the atlas of these cells, each cell downsampled separately."""
    chains = [mip_chain(cell, LEVELS) for cell in cells]
    return tuple(laid_out([chain[level] for chain in chains]) for level in range(LEVELS))


def cell_coordinates(
    cells: np.ndarray, flipped: np.ndarray, s: np.ndarray, t: np.ndarray, rows: int = ROWS
) -> np.ndarray:
    """Return atlas coordinates (n, k, 2) of the points s, t (k,), 0..1 within each of cells (n,).

    ``flipped`` (n,) mirrors s. ``rows`` is how many the atlas has.
    """
    s = 0.5 / CELL + s * (1.0 - 1.0 / CELL)
    t = GUTTER / CELL + t * (1.0 - (GUTTER + 0.5) / CELL)
    mirrored = np.where(flipped[:, None], 1.0 - s, s)
    u = (cells[:, None] % COLUMNS + mirrored) / COLUMNS
    v = (cells[:, None] // COLUMNS + t) / rows
    return np.ascontiguousarray(np.stack([u, v + 0 * u], axis=2), np.float32)
