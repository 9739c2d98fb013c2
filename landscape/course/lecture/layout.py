"""Where a lecture's window has what: the area of the step, the caption, and the code.

The area is at the lower left, where a program's viewport begins, so that nothing covers it. Without
code the caption is a band above it; with code the caption is larger, and the code is at the right.
Sizes and boxes are in pixels.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from landscape.course.lecture.image import caption_fits

# Chosen: how many bands fill the window's height; the first in which the caption fits. With 9 of
# 1080 pixels the area has 960, twice the 480 of the lessons.
BANDS = (9.0, 7.5, 6.0, 5.0)
CODE = 0.46  # chosen: of the window's width
SHAPE = 4 / 3  # width to height, for which programs are usually made


@dataclass(frozen=True)
class Layout:
    """``area``: the size of the step's area. ``caption`` is the size of the box above it.

    ``code`` is the size of the box at the right, with the window's height; None without one.
    """

    area: tuple[int, int]
    caption: tuple[int, int]
    code: tuple[int, int] | None = None


def layout(
    size: tuple[int, int], code: bool, scale: float = 1.0, bands: float = BANDS[0]
) -> Layout:
    """Divide a window of ``size`` pixels; ``scale`` is that of its coordinates, in pixels.

    ``bands`` of the caption would fill its height. The area's sides are whole coordinates.
    """
    width, height = size
    band = math.ceil(height / bands)
    if not code:
        area = width, _whole(height - band, scale)
        return Layout(area, (width, height - area[1]))
    across = _whole(width - round(CODE * width), scale)
    area = across, _whole(min(height - band, round(across / SHAPE)), scale)
    return Layout(area, (across, height - area[1]), (width - across, height))


def arranged(
    size: tuple[int, int], code: bool, scale: float, title: str, captions: Sequence[str]
) -> tuple[Layout, str]:
    """Return the layout for a step, and the first of its captions that fits.

    The band grows only where even the last caption, the shortest, does not fit.
    """
    tried = [(BANDS[0], text) for text in captions]
    tried += [(bands, captions[-1]) for bands in BANDS[1:]]
    for bands, text in tried:
        found = layout(size, code, scale, bands)
        if caption_fits(found.caption, size[1], title, text):
            break
    return found, text


def _whole(pixels: int, scale: float) -> int:
    return max(round(int(pixels / scale) * scale), 1)
