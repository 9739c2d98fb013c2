"""The contact sheet: all image assets on one page, with a checkerboard behind transparency."""

from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from landscape.files.assets import Assets, shipped
from landscape.files.images import read_image

CELL = 256  # chosen: side of a thumbnail in pixels
COLUMNS = 7  # chosen


def _checks() -> Image.Image:
    """Return the grey chequers that are seen through transparent images."""
    board = (np.indices((CELL, CELL)) // 16).sum(axis=0) % 2 * 40 + 100
    return Image.fromarray(np.repeat(board[..., None], 3, axis=2).astype(np.uint8))


def contact_sheet(folder: Path | None = None) -> np.ndarray:
    """Return the sheet, uint8 (h, w, 3), of all images; files in ``folder`` take precedence."""
    assets = Assets(folder)
    places = [shipped(), *([folder] if folder else [])]
    found = {p.name for place in places for kind in ("png", "jpg") for p in place.glob(f"*.{kind}")}
    rows = -(-len(found) // COLUMNS)
    sheet = Image.new("RGB", (COLUMNS * CELL, rows * (CELL + 16)), (32, 32, 32))
    pen = ImageDraw.Draw(sheet)
    checks = _checks()
    for number, name in enumerate(sorted(found)):
        row, column = divmod(number, COLUMNS)
        corner = (column * CELL, row * (CELL + 16))
        picture = Image.fromarray(read_image(assets.path(name)))
        picture.thumbnail((CELL, CELL))
        sheet.paste(checks.crop((0, 0, *picture.size)), corner)
        sheet.paste(picture, corner, picture)
        pen.text((corner[0] + 4, corner[1] + CELL + 2), name, fill=(230, 230, 230))

    return np.asarray(sheet)
