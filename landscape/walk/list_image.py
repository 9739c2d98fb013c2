"""The picture of the list of settings: the rows around the chosen one, and what that one is."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from framelens.base.fonts import font, writable
from framelens.inspector.panel import KEYS, PLATE, SMALLEST, TITLE, WORDS, text_size, wrapped
from landscape.walk.settings_list import Line, Page

SIZE = 0.8  # chosen: of the panel's text, so that the list leaves most of the picture free
SPACING = 1.35  # chosen: line height, in font sizes
WIDEST = 0.48  # chosen: of the window's width, with text of the usual size
WHOLE = 0.8  # chosen: of the window's width, with larger text
WIDE = 40  # chosen: of a text to be read, in font sizes
LEAST = 12  # chosen: pixels, the list's font size unless the window's text is smaller still
CHOSEN = (88, 84, 58, 225)  # chosen: RGBA behind the chosen row
DEFAULT = (165, 175, 180)  # chosen: RGB of the preset's value, and of rows without effect


def visible(lines: tuple[Line, ...], count: int) -> tuple[int, int]:
    """Return the first and the end of ``count`` lines with the chosen one in their middle."""
    chosen = next((k for k, line in enumerate(lines) if line.chosen), 0)
    first = max(min(chosen - count // 2, len(lines) - count), 0)
    return first, min(first + count, len(lines))


def widest(size: tuple[int, int], dpi: float) -> float:
    """Return how many pixels wide a list may be in a window of ``size`` pixels.

    Whoever wants larger text gives it more of the window: within the usual width long rows would
    not let it grow.
    """
    times = text_size(size, dpi) / text_size(size)
    return min(WIDEST * max(times, 1.0), WHOLE) * size[0]


@lru_cache(maxsize=8)
def _columns(rows: tuple[tuple[str, str], ...], pixels: int) -> tuple[float, float]:
    """Return the widths in pixels of the names and of the values."""
    face = font(pixels)
    names, values = zip(*rows, strict=True)
    return max(map(face.getlength, names)), max(map(face.getlength, values))


@dataclass(frozen=True)
class Layout:
    """How a page is laid out on its plate: sizes in pixels, and which lines it has room for.

    ``pixels`` is the font's size, ``names`` the width of the lines' names.
    """

    pixels: int
    names: float
    width: int
    height: int
    first: int
    end: int
    below: tuple[str, ...]

    @property
    def line_height(self) -> int:
        """The height of a line."""
        return round(SPACING * self.pixels)

    @property
    def top(self) -> int:
        """Where the first line begins, from the plate's top."""
        return round(1.5 * self.pixels) + self.line_height


@lru_cache(maxsize=4)
def _fitting(page: Page, size: tuple[int, int], dpi: float) -> tuple[int, float, int]:
    """Return the size of letters in which a page's rows fit, and the widths of names and rows."""
    known = tuple((line.name, f"{line.value}  {line.default or line.value}") for line in page.lines)
    largest = text_size(size, dpi)
    for pixels in range(max(round(SIZE * largest), min(LEAST, largest)), SMALLEST - 1, -1):
        names, values = _columns(known, pixels)
        width = int(names + values + 4 * pixels)
        if width <= widest(size, dpi):
            break
    return pixels, names, width


def layout(page: Page, size: tuple[int, int], dpi: float = 1.0) -> Layout:
    """Lay a page out for a window of ``size`` pixels.

    It is as high as the window allows; the rows scroll so that the chosen one can be seen.
    """
    pixels, names, width = _fitting(page, size, dpi)
    face = font(pixels)
    edge, line_height = pixels, round(SPACING * pixels)
    below = tuple(
        part
        for text in page.below
        for part in wrapped(writable(text, face), face, width - 2 * edge)
    )

    # In a very small window the rows come first.
    below = below[: max(int(0.94 * size[1] - 3 * edge) // line_height - 5, 0)]

    around = 3 * edge + (1 + len(below)) * line_height
    height = max(int(0.94 * size[1]), around + line_height)
    count = (height - around) // line_height
    if count < len(page.lines):
        count = max(count - 1, 1)  # the last line says how many there are below
    first, end = visible(page.lines, count)
    return Layout(pixels, names, width, height, first, end, below)


def line_at(page: Page, size: tuple[int, int], dpi: float, x: float, y: float) -> int | None:
    """Return the number of the page's line at a place in pixels from the window's top left."""
    laid = layout(page, size, dpi)
    right = x - size[1] // 48
    down = y - (size[1] - laid.height) / 2 - laid.top
    number = laid.first + math.floor(down / laid.line_height)
    return number if 0 <= right < laid.width and laid.first <= number < laid.end else None


def _mark(draw: ImageDraw.ImageDraw, laid: Layout, y: int) -> None:
    """Draw the plate of the chosen row, whose text begins at y."""
    edge = laid.pixels
    box = (edge // 2, y - edge // 8, laid.width - edge // 2, y + laid.line_height - edge // 4)
    draw.rectangle(box, CHOSEN)


def _texts(line: Line, laid: Layout) -> Iterator[tuple[float, str, tuple[int, ...]]]:
    """Yield the texts of a row, each with where it begins and its colour."""
    if not line.value:
        yield laid.pixels, line.name, KEYS
        return
    face = font(laid.pixels)
    left = laid.names + 3 * laid.pixels
    yield 2 * laid.pixels, line.name, DEFAULT if line.idle else WORDS
    yield left, line.value, DEFAULT if line.idle else TITLE
    yield left + face.getlength(writable(f"{line.value}  ", face)), line.default, DEFAULT


def list_image(page: Page, size: tuple[int, int], dpi: float = 1.0) -> np.ndarray:
    """Render the list on a plate for a window of ``size`` pixels, uint8 (h, w, 4)."""
    laid = layout(page, size, dpi)
    face = font(laid.pixels)
    edge = laid.pixels
    line_height = laid.line_height
    image = Image.new("RGBA", (laid.width, laid.height), PLATE)
    draw = ImageDraw.Draw(image)

    def write(x: float, y: float, text: str, colour: tuple[int, ...]) -> None:
        draw.text((x, y), writable(text, face), colour, face, "la")

    write(edge, edge, page.title, TITLE)
    y = laid.top
    for line in page.lines[laid.first : laid.end]:
        if line.chosen:
            _mark(draw, laid, y)
        for x, text, colour in _texts(line, laid):
            write(x, y, text, colour)
        y += line_height
    _announce_hidden(draw, laid, len(page.lines))
    y = laid.height - edge - len(laid.below) * line_height
    for text in laid.below:
        write(edge, y, text, WORDS)
        y += line_height
    return np.asarray(image)


def _announce_hidden(draw: ImageDraw.ImageDraw, laid: Layout, count: int) -> None:
    """Draw how many of ``count`` rows there are above and below those that are shown."""
    face = font(laid.pixels)
    right, half = laid.width - laid.pixels, laid.line_height // 2
    if laid.first:
        announce(draw, laid.first, True, (right, laid.pixels + half), face)
    if hidden := count - laid.end:
        below = laid.top + (laid.end - laid.first) * laid.line_height
        announce(draw, hidden, False, (right, below + half), face)


def announce(
    draw: ImageDraw.ImageDraw,
    count: int,
    above: bool,
    right: tuple[int, int],
    face: ImageFont.FreeTypeFont,
) -> None:
    """Draw how many rows there are beyond an end of a list: a number and an arrow.

    ``right`` is the middle of their right edge in pixels.
    """
    half = max(round(face.size / 3), 1)
    x, y = right[0] - half, right[1]
    tip, foot = (y - half, y + half) if above else (y + half, y - half)
    draw.polygon(((x - half, foot), (x + half, foot), (x, tip)), KEYS)
    draw.text((x - 2 * half, y), str(count), KEYS, face, "rm")


def _set(
    texts: Sequence[str], size: tuple[int, int], dpi: float
) -> tuple[int, int, list[list[str]]]:
    """Return the largest size of letters in which paragraphs fit, their width, and their lines."""
    for pixels in range(text_size(size, dpi), SMALLEST - 1, -1):
        face = font(pixels)
        width = round(min(widest(size, dpi), WIDE * pixels))
        paragraphs = [wrapped(writable(text, face), face, width - 2 * pixels) for text in texts]
        if _height(paragraphs, pixels) <= 0.94 * size[1]:
            break
    return pixels, width, paragraphs


def _height(paragraphs: Sequence[Sequence[str]], pixels: int) -> float:
    """Return how high paragraphs are with their margins, in pixels."""
    line_height = round(SPACING * pixels)
    return 2 * pixels + sum((len(each) + 0.5) * line_height for each in paragraphs)


def text_image(texts: Sequence[str], size: tuple[int, int], dpi: float = 1.0) -> np.ndarray:
    """Render a title and paragraphs on a plate for a window of ``size`` pixels, uint8 (h, w, 4)."""
    pixels, width, paragraphs = _set(texts, size, dpi)
    face = font(pixels)
    line_height = round(SPACING * pixels)
    height = _height(paragraphs, pixels)
    image = Image.new("RGBA", (max(width, 1), max(round(height), 1)), PLATE)
    draw = ImageDraw.Draw(image)
    y = float(pixels)
    for number, lines in enumerate(paragraphs):
        colour = TITLE if number == 0 else KEYS if number == len(paragraphs) - 1 else WORDS
        for line in lines:
            draw.text((pixels, y), line, colour, face, "la")
            y += line_height
        y += 0.5 * line_height
    return np.asarray(image)
