"""The five faces of the sky box in one picture, as the box unfolded (figure 12). No OpenGL here.

The top is in the middle, each wall next to its edge of the top, with its foot outwards. It is seen
from inside, from below: with north up, the top has east on its left.
"""

from collections.abc import Sequence

import numpy as np
from PIL import Image

# Where each wall is, counted in the picture's three columns and rows, and how far it is turned
# counter-clockwise, in degrees.
WALLS = {"north": (1, 0, 180), "east": (0, 1, 270), "south": (1, 2, 0), "west": (2, 1, 90)}


def unfolded(faces: Sequence[np.ndarray], side: int, deep: int) -> np.ndarray:
    """Lay out north, east, south, west and top, (h, w, 3 or 4), in one picture, (n, n, 4).

    The top is ``side`` texels wide, walls are ``deep`` texels high.
    """
    sheet = Image.new("RGBA", (side + 2 * deep, side + 2 * deep), (0, 0, 0, 0))
    starts = (0, deep, deep + side)
    for face, (column, row, turn) in zip(faces[:4], WALLS.values(), strict=True):
        wall = Image.fromarray(face).resize((side, deep))
        sheet.paste(wall.rotate(turn, expand=True), (starts[column], starts[row]))
    top = Image.fromarray(faces[4]).transpose(Image.Transpose.FLIP_LEFT_RIGHT)
    sheet.paste(top.resize((side, side)), (deep, deep))
    return np.asarray(sheet)


def folded(sheet: np.ndarray, share: float) -> dict[str, np.ndarray]:
    """Return the faces (h, w, 3) of a picture (n, n, 3) laid out so, by name.

    ``share`` is how high the box is, in parts of its width.
    """
    sheet = np.asarray(Image.fromarray(sheet).resize((len(sheet),) * 2))
    deep = max(round(len(sheet) * share / (1.0 + 2.0 * share)), 1)
    edges = (0, deep, max(len(sheet) - deep, deep + 1), len(sheet))
    picture = Image.fromarray(sheet)
    faces = {}
    for name, (column, row, turn) in WALLS.items():
        box = edges[column], edges[row], edges[column + 1], edges[row + 1]
        faces[name] = np.array(picture.crop(box).rotate(-turn, expand=True))
    box = edges[1], edges[1], edges[2], edges[2]
    top = picture.crop(box).transpose(Image.Transpose.FLIP_LEFT_RIGHT)
    return {**faces, "top": np.array(top)}
