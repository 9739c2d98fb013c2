"""The title's picture: what one can choose, over a picture of what is chosen."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from framelens.base.fonts import font, writable
from framelens.inspector.panel import KEYS, SMALLEST, TITLE, WORDS, text_size, wrapped
from landscape.walk.list_image import announce
from landscape.walk.opening import covering

PLATE = (12, 20, 28, 170)  # chosen: RGBA behind the words
CHOSEN = (88, 84, 58, 225)  # chosen: RGBA behind the chosen row
SPACING = 1.6  # chosen: line height, in font sizes
LARGE = 1.9  # chosen: size of the heading, in font sizes
WIDEST = 0.56  # chosen: of the window's width, for the words
TALLEST = 0.9  # chosen: of the window's height


@dataclass(frozen=True)
class Row:
    """A row of the title: its text, and a word beside it."""

    text: str
    beside: str = ""


@dataclass(frozen=True)
class Drawn:
    """The title's picture, uint8 (h, w, 4), and which rows of the window each entry fills.

    ``places`` are (first, end) in pixels from the top, by the entry's number; ``width`` is how far
    they reach from the left. ``first`` is the number of the first entry shown. Where entries
    are left out, a row says how many; it fills the place of the nearest of them.
    """

    image: np.ndarray
    places: dict[int, tuple[int, int]]
    width: int
    first: int = 0

    def at(self, x: float, y: float) -> int | None:
        """Return the number of the entry at a place in pixels from the top left, if any."""
        found = (k for k, (top, end) in self.places.items() if top <= y < end and x < self.width)
        return next(found, None)


def title_image(
    heading: str,
    rows: Sequence[Row],
    chosen: int,
    below: str,
    size: tuple[int, int],
    dpi: float = 1.0,
    behind: Path | None = None,
    first: int = 0,
) -> Drawn:
    """Render the title for a window of ``size`` pixels.

    ``below`` are paragraphs: how to choose, what went wrong, or a text to be read; ``behind`` is a
    picture of what is chosen. Where not all rows fit, ``first`` is the first one that was shown so
    far: they move only if the chosen one is not among them.
    """
    image = covering(behind, size)
    pixels, width = _fitting(rows, size, dpi)
    face = font(pixels)
    large = font(round(LARGE * pixels))
    line = round(SPACING * pixels)
    edge = 2 * pixels
    notes = _wrapped(below, face, width - 2 * edge)
    around = 4 * edge + len(notes) * line
    count = max(min(len(rows), (round(TALLEST * size[1]) - around) // line), 1)
    first = max(min(first, chosen, len(rows) - count), chosen - count + 1, 0)

    plate = Image.new("RGBA", size, (0, 0, 0, 0))
    draw = ImageDraw.Draw(plate)
    draw.rectangle((0, 0, width, size[1]), PLATE)
    y = max((size[1] - around - count * line) // 3, edge // 2)
    draw.text((edge, y), writable(heading, large), TITLE, large, "la")
    y += 2 * edge
    places = _draw_rows(draw, rows, range(first, first + count), chosen, y, (width, pixels))
    y += count * line + edge
    for note in notes:
        draw.text((edge, y), note, KEYS, face, "la")
        y += line
    return Drawn(np.asarray(Image.alpha_composite(image, plate)), places, width, first)


def _fitting(rows: Sequence[Row], size: tuple[int, int], dpi: float) -> tuple[int, int]:
    """Return the size of the letters in which all rows fit, and the width of the plate."""
    for pixels in range(text_size(size, dpi), SMALLEST - 1, -1):
        face = font(pixels)
        wide = max(face.getlength(f"{row.text}  {row.beside}") for row in rows) + 5 * pixels
        if wide <= max(WIDEST * size[0], 18 * pixels):
            break
    return pixels, min(max(round(wide), 18 * pixels), size[0])


def _wrapped(paragraphs: str, face: ImageFont.FreeTypeFont, width: int) -> list[str]:
    """Return the lines of paragraphs in a width in pixels."""
    return [
        line
        for paragraph in paragraphs.split("\n")
        for line in wrapped(writable(paragraph, face), face, width)
    ]


def _mark(draw: ImageDraw.ImageDraw, y: int, line: int, width: int, edge: int) -> None:
    """Draw the plate behind the chosen row, which begins at ``y``."""
    right = max(width - edge // 2, edge // 2)
    draw.rectangle((edge // 2, y, right, y + line - 1), CHOSEN)


def _draw_rows(
    draw: ImageDraw.ImageDraw,
    rows: Sequence[Row],
    shown: range,
    chosen: int,
    y: int,
    size: tuple[int, int],
) -> dict[int, tuple[int, int]]:
    """Draw the rows that are ``shown`` from ``y`` on, and how many there are above and below them.

    ``size`` is the width of the plate and the size of the font, in pixels. Return the upper and
    lower edge of each row by its number, and the edges of the next row above and below.
    """
    width, pixels = size
    face = font(pixels)
    line = round(SPACING * pixels)
    edge = 2 * pixels

    places = {}
    if shown.start > 0:
        places[shown.start - 1] = (y - line, y)
        announce(draw, shown.start, True, (width - edge, y - line // 2), face)
    for number in shown:
        places[number] = (y, y + line)
        if number == chosen:
            _mark(draw, y, line, width, edge)
        _draw_row(draw, rows[number], (edge, width - edge), y + line / 2, face)
        y += line
    if hidden := len(rows) - shown.stop:
        places[shown.stop] = (y, y + line)
        announce(draw, hidden, False, (width - edge, y + line // 2), face)
    return places


def _draw_row(
    draw: ImageDraw.ImageDraw,
    row: Row,
    ends: tuple[int, int],
    middle: float,
    face: ImageFont.FreeTypeFont,
) -> None:
    """Draw a row between two ends: its text at the left, what is beside it at the right."""
    left, right = ends
    draw.text((left, middle), writable(row.text, face), WORDS, face, "lm")
    draw.text((right, middle), writable(row.beside, face), KEYS, face, "rm")
