"""A strip as a picture that fills a screen, to be read from the back row of a lecture hall."""

from collections.abc import Iterable

from PIL import Image, ImageDraw

from framelens.base.fonts import font, writable
from framelens.report.strip_page import GREY, INK, PAPER, RULE, SPACING, Cell, Page, scaled, wrapped

TITLE, LARGE, SMALL = 30, 44, 54  # chosen: lines of each text that fill the screen's height
LINES = 3  # chosen: lines of text below a step's title


def as_image(page: Page, cells: Iterable[Cell], size: tuple[int, int]) -> Image.Image:
    """Return the steps with their first buffer, side by side in as many rows as suit a screen."""
    large, small = (max(size[1] // lines, 9) for lines in (LARGE, SMALL))
    margin = large
    caption = round(SPACING * (large + LINES * small)) + small // 2
    sheet = Image.new("RGB", size, PAPER)
    top = margin + _head(page, sheet, margin)
    room = size[0] - 2 * margin, size[1] - top - margin // 2
    columns, box = _layout(page, room, margin, caption)
    for index, cell in enumerate(cells):
        x = margin + index % columns * (box[0] + margin)
        y = top + index // columns * (box[1] + caption)
        _step(cell, sheet, (x, y), box, (large, small))
    return sheet


def _layout(
    page: Page, room: tuple[int, int], gap: int, caption: int
) -> tuple[int, tuple[int, int]]:
    """Return how many steps stand in a row, and the size of a picture: as large as possible."""
    best = (1, (1, 1))
    for columns in range(1, page.count + 1):
        rows = -(-page.count // columns)
        width = (room[0] - (columns - 1) * gap) // columns
        height = room[1] // rows - caption
        scale = min(width / page.size[0], height / page.size[1])
        box = round(page.size[0] * scale), round(page.size[1] * scale)
        if box[0] > best[1][0]:
            best = columns, box
    columns, box = best
    return columns, (max(box[0], 16), max(box[1], 12))


def _head(page: Page, sheet: Image.Image, margin: int) -> int:
    """Draw the title and what the strip shows; return their height."""
    pen, y = ImageDraw.Draw(sheet), margin // 2
    for words, lines, bold, ink in (
        (page.title, TITLE, True, INK),
        (page.intro, SMALL, False, GREY),
    ):
        pixels = max(sheet.height // lines, 9)
        face = font(pixels, bold)
        for line in wrapped(words, face, sheet.width - 2 * margin, 1):
            pen.text((margin, y), line, ink, face, "la")
            y += round(SPACING * pixels)
    return y - margin // 2


def _step(
    cell: Cell,
    sheet: Image.Image,
    corner: tuple[int, int],
    box: tuple[int, int],
    sizes: tuple[int, int],
) -> None:
    """Draw a step: its picture, and below it the title and a few lines."""
    pen = ImageDraw.Draw(sheet)
    x, y = corner
    large, small = sizes
    sheet.paste(scaled(cell.pictures[0], box, sharp=False), corner)
    pen.rectangle((x, y, x + box[0] - 1, y + box[1] - 1), outline=RULE)
    y += box[1] + small // 4
    title = font(large, True)
    label = writable(f"{cell.label}  ", title)
    indent = round(title.getlength(label))
    pen.text((x, y), label, GREY, title, "la")
    pen.text((x + indent, y), wrapped(cell.title, title, box[0] - indent, 1)[0], INK, title, "la")
    _draw_lines(cell, pen, (x, y + round(SPACING * large)), box[0], small)


def _draw_lines(
    cell: Cell, pen: ImageDraw.ImageDraw, corner: tuple[int, int], width: int, pixels: int
) -> None:
    """Draw the first lines below a step's title."""
    x, y = corner
    face = font(pixels)
    lines = [line for text in (*cell.lines, cell.calls) for line in wrapped(text, face, width)]
    for line in lines[:LINES]:
        pen.text((x, y), line, GREY, face, "la")
        y += round(SPACING * pixels)
