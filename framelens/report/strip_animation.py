"""A strip as an animation: a picture for each step, the caption below it."""

import io
from collections.abc import Iterable, Sequence

from PIL import Image, ImageDraw

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
from framelens.report.strip_pictures import RGB, Legend

# How large a picture is at most, by how many stand in a frame, and how many in a row: chosen.
LAYOUTS = {1: (640, 1), 2: (480, 2), 3: (400, 3), 4: (480, 2)}
FEW = 40  # chosen: steps that are shown slowly
SLOW, FAST = 1400, 350  # chosen: milliseconds a step
LAST = 4000  # chosen: milliseconds that the finished frame stays
COLORS = 256  # of a GIF
EDGE = 16  # chosen: pixels around the caption
# Chosen: font sizes in pixels.
LARGE, SMALL = 18, 15
LEGEND = 13


def as_gif(page: Page, cells: Iterable[Cell]) -> bytes:
    """Return the animation, without end, as a GIF; each frame has the 256 colours it needs."""
    frames = [_with_palette(_frame(page, cell), _exact(page)) for cell in cells]
    pause = SLOW if page.count <= FEW else FAST
    buffer = io.BytesIO()
    frames[0].save(
        buffer,
        "GIF",
        save_all=True,
        append_images=frames[1:],
        duration=[*[pause] * (len(frames) - 1), LAST],
        loop=0,
        optimize=False,
    )
    return buffer.getvalue()


def _exact(page: Page) -> list[RGB]:
    """Return the colours that must stay what they are: those of paper, text and legends."""
    legends = (color for legend in page.legends() for color, _ in legend.entries)
    return list(dict.fromkeys((PAPER, INK, GREY, RULE, *legends)))


def _with_palette(frame: Image.Image, exact: Sequence[RGB]) -> Image.Image:
    """Reduce a frame to 256 colours, ``exact`` among them."""
    chosen = frame.quantize(COLORS - len(exact), Image.Quantize.MEDIANCUT).getpalette() or []
    palette = Image.new("P", (1, 1))
    palette.putpalette([*chosen, *(part for color in exact for part in color)][: 3 * COLORS])
    return frame.quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG)


def _frame(page: Page, cell: Cell) -> Image.Image:
    """Draw a step; all have the same size."""
    count = len(cell.pictures)
    side, columns = LAYOUTS[count]
    box = fitted(page.size, side)
    rows = -(-count // columns)
    across = max(columns * box[0], 320)
    legends = page.legends()
    caption = round(SPACING * (2 * LARGE + 4 * SMALL)) + 2 * EDGE
    legend = sum(_height(each, across) for each in legends)
    frame = Image.new("RGB", (across, rows * box[1] + caption + legend), PAPER)
    pen = ImageDraw.Draw(frame)
    for index, (name, picture) in enumerate(zip(page.buffers, cell.pictures, strict=True)):
        row, column = divmod(index, columns)
        frame.paste(scaled(picture, box, name == "stencil"), (column * box[0], row * box[1]))
    y = rows * box[1]

    # How far the frame has grown.
    pen.rectangle((0, y, across, y + 3), RULE)
    pen.rectangle((0, y, across * cell.number // page.count, y + 3), INK)
    y += EDGE
    title, words = font(LARGE, True), font(SMALL)
    label = f"{cell.number}/{page.count}  "
    if cell.label != str(cell.number):
        label += f"{cell.label}  "
    indent = round(title.getlength(label))
    pen.text((EDGE, y), writable(label, title), GREY, title, "la")
    for line in wrapped(cell.title, title, across - 2 * EDGE - indent):
        pen.text((EDGE + indent, y), line, INK, title, "la")
        y += round(SPACING * LARGE)
    for each in (*cell.lines, cell.calls):
        for line in wrapped(each, words, across - 2 * EDGE):
            pen.text((EDGE, y), line, GREY, words, "la")
            y += round(SPACING * SMALL)

    y = frame.height - legend - EDGE // 2
    for each_legend in legends:
        y += draw_legend(pen, each_legend, (EDGE, y), LEGEND, across - 2 * EDGE)
    return frame


def _height(legend: Legend, across: int) -> int:
    """Return how high a legend is, in pixels."""
    pen = ImageDraw.Draw(Image.new("RGB", (1, 1)))
    return draw_legend(pen, legend, (EDGE, 0), LEGEND, across - 2 * EDGE)
