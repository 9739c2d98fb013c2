"""A strip as one sheet: rows of pictures with captions below them, legends at the head."""

import io
from collections.abc import Iterable

from PIL import Image, ImageDraw
from PIL.ImageFont import FreeTypeFont as Face

from framelens.base.fonts import font, writable
from framelens.report.strip_page import (
    GREY,
    INK,
    PAPER,
    RULE,
    SPACING,
    Cell,
    Page,
    draw_legend,
    fitted,
    scaled,
    wrapped,
)
from framelens.report.strip_words import text

# How large a picture is at most, and how wide a row, in pixels: chosen. The first layout that makes
# no more than TALLEST is taken, or the last one.
LAYOUTS = ((400, 1700), (320, 2080), (240, 2140))
TALLEST = 3200  # chosen: pixels
# Chosen: pixels around the sheet, between steps, and within one.
MARGIN = 48
GAP = 28
INSIDE = 8
CAPTION = 100  # chosen: pixels, about what a caption takes
WIDE = 900  # chosen: pixels, from which on a step's texts stand in one line
NARROWEST = 200  # chosen: pixels, so that a caption has room


def as_png(page: Page, cells: Iterable[Cell]) -> bytes:
    """Return the sheet as a PNG."""
    side, columns = _layout(page)
    box = fitted(page.size, side)
    blocks = [_block(page, cell, box, side) for cell in cells]
    width = blocks[0].width
    inner = columns * width + (columns - 1) * GAP
    head = _head(page, max(inner, 2 * side))
    rows = [blocks[k : k + columns] for k in range(0, len(blocks), columns)]
    heights = [max(block.height for block in row) for row in rows]
    across = max(inner, head.width) + 2 * MARGIN
    down = head.height + sum(heights) + GAP * (len(rows) - 1) + 2 * MARGIN
    sheet = Image.new("RGB", (across, down), PAPER)
    sheet.paste(head, (MARGIN, MARGIN))
    y = MARGIN + head.height
    for row, height in zip(rows, heights, strict=True):
        for index, block in enumerate(row):
            sheet.paste(block, (MARGIN + index * (width + GAP), y))
        y += height + GAP
    return _png(sheet)


def _png(sheet: Image.Image) -> bytes:
    buffer = io.BytesIO()
    sheet.save(buffer, "PNG", compress_level=1)
    return buffer.getvalue()


def _width(page: Page, box: tuple[int, int]) -> int:
    """Return how wide a step is, in pixels."""
    count = len(page.buffers)
    return max(count * box[0] + (count - 1) * INSIDE, NARROWEST)


def _layout(page: Page) -> tuple[int, int]:
    """Return how large a picture is at most, and how many steps stand in a row."""
    for side, row in LAYOUTS:
        box = fitted(page.size, side)
        columns = max(1, (row + GAP) // (_width(page, box) + GAP))
        rows = -(-page.count // columns)
        if rows * (box[1] + CAPTION + GAP) <= TALLEST:
            break
    # As many rows as needed, equally full.
    return side, -(-page.count // rows)


def _head(page: Page, width: int) -> Image.Image:
    """Draw the title, what the sheet shows, and the legends."""
    head = Image.new("RGB", (width, 1000), PAPER)
    pen, y = ImageDraw.Draw(head), 0
    for words, size, bold, ink in ((page.title, 30, True, INK), (page.intro, 17, False, GREY)):
        face = font(size, bold)
        for line in wrapped(words, face, width, 3):
            pen.text((0, y), line, ink, face, "la")
            y += round(SPACING * size)
    y += 10
    for legend in page.legends():
        y += draw_legend(pen, legend, (0, y), 15, width) + 4
    return head.crop((0, 0, width, y + 22))


def _paste_pictures(
    block: Image.Image, page: Page, cell: Cell, box: tuple[int, int], face: Face | None
) -> None:
    """Draw a step's pictures side by side, with their names in a font if it is given."""
    pen = ImageDraw.Draw(block)
    for index, (name, picture) in enumerate(zip(page.buffers, cell.pictures, strict=True)):
        x = index * (box[0] + INSIDE)
        block.paste(scaled(picture, box, name == "stencil"), (x, 0))
        pen.rectangle((x, 0, x + box[0] - 1, box[1] - 1), outline=RULE)
        if face is not None:
            what = writable(text(page.language, name), face)
            pen.text((x, box[1] + 3), what, GREY, face, "la")


TextLine = tuple[int, str, Face, tuple[int, int, int], int]
"""A line of a caption: where it begins, its text, font and colour, and its height in pixels."""


def _write(block: Image.Image, lines: Iterable[TextLine], y: int) -> None:
    """Write lines below each other, the first at ``y``."""
    pen = ImageDraw.Draw(block)
    for x, line, face, ink, step in lines:
        pen.text((x, y), line, ink, face, "la")
        y += step


def _lines(
    page: Page, cell: Cell, across: int, indent: int, faces: tuple[Face, Face]
) -> list[TextLine]:
    """Return the lines of a step's caption; the first ones leave room for its number."""
    title, words = faces
    texts = [*cell.lines, cell.calls]
    if across >= WIDE:
        texts = [text(page.language, "between").join(texts)]
    lines = [
        (indent, line, title, INK, round(SPACING * title.size))
        for line in wrapped(cell.title, title, across - indent)
    ]
    return lines + [
        (0, line, words, GREY, round(SPACING * words.size))
        for each in texts
        for line in wrapped(each, words, across)
    ]


def _block(page: Page, cell: Cell, box: tuple[int, int], side: int) -> Image.Image:
    """Draw a step: its pictures side by side, and the caption."""
    across = _width(page, box)
    large, small = (17, 14) if side >= 320 else (14, 12)
    title, words = font(large, True), font(small)
    label = f"{cell.label}  "
    indent = round(title.getlength(label))
    lines = _lines(page, cell, across, indent, (title, words))
    names = round(SPACING * small) if len(cell.pictures) > 1 else 0
    height = box[1] + INSIDE + names + sum(line[-1] for line in lines)
    block = Image.new("RGB", (across, height), PAPER)
    _paste_pictures(block, page, cell, box, words if names else None)
    y = box[1] + INSIDE + names
    ImageDraw.Draw(block).text((0, y), writable(label, title), GREY, title, "la")
    _write(block, lines, y)
    return block
