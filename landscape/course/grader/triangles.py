"""The triangles of which a draw consists, and the pixels that they cover."""

from collections.abc import Callable, Iterable, Iterator, Mapping

import numpy as np
from PIL import Image, ImageDraw

from landscape.course.grader.evidence import Draw

LEAST = 1e-6  # chosen: what lies nearer to the eye's plane has no place in the window


def _fan(count: int) -> Iterator[list[int]]:
    yield from ([0, i, i + 1] for i in range(1, count - 1))


def _strip(count: int) -> Iterator[list[int]]:
    yield from ([i + i % 2, i + 1 - i % 2, i + 2] for i in range(count - 2))


def _quads(count: int) -> Iterator[list[int]]:
    for first in range(0, count - 3, 4):
        yield from ([first, first + 1, first + 2], [first, first + 2, first + 3])


SPLIT: Mapping[str, Callable[[int], Iterator[list[int]]]] = {
    "GL_TRIANGLES": lambda count: ([i, i + 1, i + 2] for i in range(0, count - 2, 3)),
    "GL_TRIANGLE_STRIP": _strip,
    "GL_TRIANGLE_FAN": _fan,
    "GL_QUADS": _quads,
    "GL_QUAD_STRIP": _strip,
    "GL_POLYGON": _fan,
}


def triangles(draw: Draw) -> np.ndarray:
    """Return the triangles of a draw by the numbers of their vertices, (n, 3).

    Each goes round as OpenGL takes it. Points and lines have none.
    """
    split = SPLIT.get(draw.mode)
    found = list(split(len(draw.vertices))) if split is not None else []
    return np.array(found, int).reshape(-1, 3)


def covered(draws: Iterable[Draw], height: int, width: int) -> np.ndarray:
    """Return which pixels the triangles of some draws cover, hidden or not: bool (h, w), top first.

    Triangles that reach behind the eye are left out.
    """
    mask = Image.new("1", (width, height))
    paint = ImageDraw.Draw(mask)
    for draw in draws:
        clip = draw.vertices @ (draw.projection @ draw.modelview).T
        for each in triangles(draw):
            if clip[each, 3].min() > LEAST:
                paint.polygon([(x, height - y) for x, y in draw.window[each].tolist()], fill=1)
    return np.array(mask)
