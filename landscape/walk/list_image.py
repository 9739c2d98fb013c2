"""The picture of the list of settings: the rows around the chosen one, and what that one is."""

from functools import lru_cache

import numpy as np
from PIL import Image, ImageDraw

from framelens.base.fonts import font, writable
from framelens.inspector.panel import KEYS, PLATE, SMALLEST, TITLE, WORDS, text_size, wrapped
from landscape.walk.settings_list import Line, Page

SIZE = 0.8  # chosen: of the panel's text, so that the list leaves most of the picture free
SPACING = 1.35  # chosen: line height, in font sizes
WIDEST = 0.48  # chosen: of the window's width
LEAST = 12  # chosen: pixels, the list's font size unless the window's text is smaller still
CHOSEN = (88, 84, 58, 225)  # chosen: RGBA behind the chosen row
DEFAULT = (165, 175, 180)  # chosen: RGB of the preset's value, and of rows without effect


def visible(lines: tuple[Line, ...], count: int) -> tuple[int, int]:
    """Return the first and the end of ``count`` lines with the chosen one in their middle."""
    chosen = next((k for k, line in enumerate(lines) if line.chosen), 0)
    first = max(min(chosen - count // 2, len(lines) - count), 0)
    return first, min(first + count, len(lines))


@lru_cache(maxsize=8)
def _columns(rows: tuple[tuple[str, str], ...], pixels: int) -> tuple[float, float]:
    """Return the widths in pixels of the names and of the values."""
    face = font(pixels)
    names, values = zip(*rows, strict=True)
    return max(map(face.getlength, names)), max(map(face.getlength, values))


def list_image(page: Page, size: tuple[int, int], dpi: float = 1.0) -> np.ndarray:
    """Render the list on a plate for a window of ``size`` pixels, uint8 (h, w, 4).

    It is as high as the window allows; the rows scroll so that the chosen one can be seen.
    """
    largest = text_size(size, dpi)
    for pixels in range(max(round(SIZE * largest), min(LEAST, largest)), SMALLEST - 1, -1):
        face = font(pixels)
        known = tuple(
            (line.name, f"{line.value}  {line.default or line.value}") for line in page.lines
        )
        names, values = _columns(known, pixels)
        width = int(names + values + 4 * pixels)
        if width <= WIDEST * size[0]:
            break
    edge, line_height = pixels, round(SPACING * pixels)
    below = [
        part
        for text in page.below
        for part in wrapped(writable(text, face), face, width - 2 * edge)
    ]
    # In a very small window the rows come first.
    below = below[: max(int(0.94 * size[1] - 3 * edge) // line_height - 5, 0)]
    around = 3 * edge + (1 + len(below)) * line_height
    height = max(int(0.94 * size[1]), around + line_height)
    first, end = visible(page.lines, (height - around) // line_height)
    image = Image.new("RGBA", (width, height), PLATE)
    draw = ImageDraw.Draw(image)

    def write(x: float, y: float, text: str, colour: tuple[int, ...], anchor: str = "la") -> None:
        draw.text((x, y), writable(text, face), colour, face, anchor)

    write(edge, edge, page.title, TITLE)
    y = round(1.5 * edge) + line_height
    for line in page.lines[first:end]:
        if line.chosen:
            box = (edge // 2, y - edge // 8, width - edge // 2, y + line_height - edge // 4)
            draw.rectangle(box, CHOSEN)
        if not line.value:
            write(edge, y, line.name, KEYS)
        else:
            write(2 * edge, y, line.name, DEFAULT if line.idle else WORDS)
            write(names + 3 * edge, y, line.value, DEFAULT if line.idle else TITLE)
            after = face.getlength(writable(f"{line.value}  ", face))
            write(names + 3 * edge + after, y, line.default, DEFAULT)
        y += line_height
    y = height - edge - len(below) * line_height
    for text in below:
        write(edge, y, text, WORDS)
        y += line_height
    return np.asarray(image)
