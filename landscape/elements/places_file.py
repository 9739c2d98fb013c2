"""Places of trees, deer and plants in a file, instead of random ones (section 5.1.2).

A CSV file with a line of names first: kind, x, z, width and height in units, and whether the
picture is mirrored. Each sprite stands on the ground at x, z. What only the preset best has may
follow: the individual's picture, and a tint in red, green and blue, 0 to 255. `landscape places`
writes such a file. No OpenGL here.
"""

import csv
import io
from pathlib import Path

import numpy as np

from framelens.base.errors import InputError, short
from framelens.base.input import read_bounded
from landscape.elements.planting import DEER, PLANT, Sprites
from landscape.elements.sprite_names import HERB, HERBS, MORE, MORE_FILES
from landscape.geometry.height_field import HeightField

RANDOM = "random"  # the value of transparent.places that names no file
KINDS = {
    name: cell
    for cell, name in enumerate(("broadleaf", "conifer", "birch", "shrub", "stag", "doe", "plant"))
} | {Path(file).stem: HERB + cell for cell, file in enumerate(HERBS)}
PICTURES = {Path(file).stem: MORE + number for number, file in enumerate(MORE_FILES)}
NEEDED, MORE_COLUMNS = (
    ("kind", "x", "z", "width", "height", "mirrored"),
    ("picture", "red", "green", "blue"),
)
TINT = ("red", "green", "blue")
MOST_BYTES = 32 << 20  # chosen: 200,000 sprites take half of it
MOST = 600_000  # sprites, as many as random ones may be
LARGEST = 1e4  # chosen: units; of coordinates and sizes


def group_of(cells: np.ndarray) -> np.ndarray:
    """Return "trees", "deer" or "plants" (n,) by atlas cells (n,)."""
    return np.asarray(np.where(cells >= PLANT, "plants", np.where(cells >= DEER, "deer", "trees")))


def read_places(
    path: Path, field: HeightField, kinds: set[str]
) -> tuple[Sprites, np.ndarray, np.ndarray]:
    """Return the sprites of a file that are of some ``kinds``, their pictures (n,) and tints.

    Pictures are atlas cells, tints (n, 3) in 0..255. InputError names the file and the line.
    """
    text = read_bounded(path, MOST_BYTES).decode("utf-8", "replace")
    rows = csv.DictReader(io.StringIO(text), restval="", restkey="more")
    names = tuple(rows.fieldnames or ())
    if not set(NEEDED) <= set(names) <= {*NEEDED, *MORE_COLUMNS}:
        raise InputError(
            "{path}: expected a first line with {columns} and perhaps {more}, not {line}",
            path=path,
            columns=", ".join(NEEDED),
            more=", ".join(MORE_COLUMNS),
            line=short(",".join(names)),
        )

    numbers: list[list[float]] = []
    cells, pictures = [], []
    try:
        for row in rows:
            if len(numbers) == MOST:
                raise InputError("{path}: expected at most {most} lines", path=path, most=MOST)
            where = f"{path}, line {rows.line_num}"
            if "more" in row or None in row.values():
                raise InputError(
                    "{where}: expected {count} values, separated by commas",
                    where=where,
                    count=len(names),
                )
            cells.append(_named(where, "kind", row["kind"], KINDS))
            picture = row.get("picture", "")
            pictures.append(_named(where, "picture", picture, PICTURES) if picture else cells[-1])
            flipped = _named(where, "mirrored", row["mirrored"], {"0": 0, "1": 1})
            place = [_number(where, name, row[name], -LARGEST) for name in ("x", "z")]
            size = [_number(where, name, row[name], 0.001) for name in ("width", "height")]
            tint = [_number(where, name, row.get(name) or "255", 0.0, 255.0) for name in TINT]
            numbers.append([*place, *size, flipped, *tint])
    except csv.Error as error:
        raise InputError(
            "{path}, line {line_num}: {error}", path=path, line_num=rows.line_num, error=error
        ) from None

    all_cells = np.array(cells, int)
    kept = np.isin(group_of(all_cells), sorted(kinds))
    table = np.array(numbers, float).reshape(-1, 8)[kept]
    x, z = table[:, :2].T
    positions = np.stack([x, field.terrain_height(x, z), z], axis=1)
    sprites = Sprites(positions, table[:, 2:4].copy(), all_cells[kept], table[:, 4] > 0)
    return sprites, np.array(pictures, int)[kept], table[:, 5:]


def _named(where: str, name: str, text: str, known: dict[str, int]) -> int:
    """Return what a word of a column means; InputError if it is none of the known ones."""
    if text not in known:
        raise InputError(
            "{where}: {name}: expected one of {names}, not {text}",
            where=where,
            name=name,
            names=", ".join(known),
            text=short(text),
        )
    return known[text]


def _number(where: str, name: str, text: str, low: float, high: float = LARGEST) -> float:
    """Return a number of a column; InputError if it is none, or out of bounds."""
    try:
        value = float(text)
    except ValueError:
        value = np.nan
    if not low <= value <= high:
        raise InputError(
            "{where}: {name}: expected a number from {low:g} to {high:g}, not {text}",
            where=where,
            name=name,
            low=low,
            high=high,
            text=short(text),
        )
    return value


def as_csv(sprites: Sprites) -> str:
    """Return sprites as the text of a file that :func:`read_places` reads."""
    kind_of = {cell: name for name, cell in KINDS.items()}
    picture_of = {cell: name for name, cell in PICTURES.items()}
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    pictures, tints = getattr(sprites, "pictures", None), getattr(sprites, "tints", None)
    writer.writerow((*NEEDED, *(MORE_COLUMNS if pictures is not None else ())))
    for n, cell in enumerate(sprites.cells.tolist()):
        x, _, z = sprites.positions[n].tolist()
        width, height = sprites.sizes[n].tolist()
        row: list[object] = [kind_of[cell], x, z, width, height, int(sprites.flipped[n])]
        if pictures is not None and tints is not None:
            row += [picture_of.get(int(pictures[n]), ""), *tints[n, :3].tolist()]
        writer.writerow(row)
    return out.getvalue()
