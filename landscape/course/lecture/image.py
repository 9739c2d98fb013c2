"""The pictures of a lecture: the caption, the code with its lines, the list of the steps."""

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import product

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from framelens.base.fonts import font, monospaced, writable
from framelens.inspector.panel import wrapped
from landscape.course.lecture.plan import in_texts

# Of the window's height: the largest and the smallest letters of a caption, chosen so that the
# smallest can be read from the back row.
LARGEST = 24
SMALLEST = 42
LEAST = 9
SPACING = 1.3  # chosen: line height, in font sizes
# Chosen: of a band's width, the second where a long title would need more lines than the caption.
TITLE_PARTS = 0.27, 0.36
CODE_LETTERS = (44, 66)  # chosen: of the window's height, as above
LIST_LETTERS = (32, 62)  # chosen: likewise
LIST_SPACING = 1.45  # chosen: line height of the list
TEXT_LETTERS = (20, 48)  # chosen: likewise
ITEM = "- "
TAB = 4  # columns

# Chosen: RGB.
BAND = (24, 30, 39)
PAPER = (15, 20, 27)
RULE = (230, 126, 76)
MARK = (58, 52, 32)
TITLE = (255, 226, 178)
WORDS = (242, 242, 236)
DIM = (142, 152, 164)
NUMBER = (104, 114, 128)
CODE = (176, 184, 194)
COMMENT = (120, 140, 130)
STRONG = (255, 250, 236)
CHOSEN = (62, 82, 104)


def caption_image(
    size: tuple[int, int], height: int, place: str, title: str, text: str
) -> np.ndarray:
    """Render a step's place in the lecture, its title and its caption in a box of ``size``.

    ``height`` is the window's. Letters are as large as fits; what does not fit in the smallest
    ends in "…".
    """
    image = Image.new("RGBA", size, (*BAND, 255))
    pen = ImageDraw.Draw(image)
    title, text = writable(title, font(LEAST, True)), writable(text, font(LEAST))
    pixels, parts = _set(size, _sizes(height // LARGEST, _least(height)), title, text)
    room = max(int((size[1] - pixels // 2) / (SPACING * pixels)), 1)
    for left, lines in parts:
        lines = _cut_to(lines, room)
        y = (size[1] - _tall(lines, pixels)) / 2 if _beside(size) else pixels / 2
        for words, colour, bold in lines:
            pen.text((left, y), words, colour, font(pixels, bold), "la")
            y += SPACING * pixels

    _draw_place(pen, size, height, place, pixels)
    return np.asarray(image)


def _draw_place(
    pen: ImageDraw.ImageDraw, size: tuple[int, int], height: int, place: str, pixels: int
) -> None:
    """Draw the place in the lecture into the lower right corner, and the rule below it."""
    width, low = size
    small = font(max(height // 60, LEAST))
    pen.text((width - pixels // 2, low - pixels // 3), place, DIM, small, "rd")
    pen.line((0, low - 1, width, low - 1), RULE, max(height // 400, 1))


def _sizes(largest: int, smallest: int) -> Iterator[int]:
    """Yield font sizes, each a little smaller than the one before."""
    pixels = largest
    while pixels > smallest:
        yield pixels
        pixels -= max(pixels // 14, 1)
    yield smallest


def _least(height: int) -> int:
    """Return the size of a caption's smallest letters in a window of this height, in pixels."""
    return max(height // SMALLEST, LEAST)


def caption_fits(size: tuple[int, int], height: int, title: str, text: str) -> bool:
    """Return whether a caption fits into a box in the smallest letters."""
    title, text = writable(title, font(LEAST, True)), writable(text, font(LEAST))
    pixels, parts = _set(size, [_least(height)], title, text)
    return _fits(size, pixels, parts)


Written = list[tuple[str, tuple[int, int, int], bool]]
Columns = list[tuple[int, Written]]
"""The columns of a caption: where each begins, and its lines."""


def _set(size: tuple[int, int], sizes: Iterable[int], title: str, text: str) -> tuple[int, Columns]:
    """Return the first of these font sizes in which a caption fits, or the last; its columns."""
    for part, pixels in product(TITLE_PARTS, sizes):
        parts = _caption(size, pixels, title, text, part)
        if _fits(size, pixels, parts):
            return pixels, parts
    return pixels, _caption(size, pixels, title, text, TITLE_PARTS[0])


def _fits(size: tuple[int, int], pixels: int, parts: Columns) -> bool:
    return all(_tall(lines, pixels) <= size[1] - pixels // 2 for _, lines in parts)


def _beside(size: tuple[int, int]) -> bool:
    """Return whether a box is so wide that its caption stands beside its title."""
    return size[0] > 4 * size[1]


def _caption(size: tuple[int, int], pixels: int, title: str, text: str, part: float) -> Columns:
    """Return the columns; a title beside its caption has this part of the width."""
    bold, face = font(pixels, True), font(pixels)
    edge = pixels
    if not text or not _beside(size):
        inner = size[0] - 2 * edge
        titles = wrapped(title, bold, inner)
        lines = wrapped(text, face, inner) if text else []
        return [
            (
                edge,
                [(line, TITLE, True) for line in titles] + [(line, WORDS, False) for line in lines],
            )
        ]

    left = round(part * size[0])
    titles = wrapped(title, bold, left - 2 * edge)
    lines = wrapped(text, face, size[0] - left - 4 * edge)
    return [
        (edge, [(line, TITLE, True) for line in titles]),
        (left, [(line, WORDS, False) for line in lines]),
    ]


def _tall(lines: Sequence[object], pixels: int) -> float:
    return len(lines) * SPACING * pixels


def _cut_to(lines: Written, room: int) -> Written:
    """Return at most ``room`` lines; where there are more, the last ends in "…"."""
    if len(lines) <= room:
        return lines
    words, colour, bold = lines[room - 1]
    return [*lines[: room - 1], (f"{words}…", colour, bold)]


def code_image(
    size: tuple[int, int],
    name: str,
    source: Sequence[str],
    marked: Collection[int],
    first: int | None = None,
) -> np.ndarray:
    """Render a program's lines in a box of ``size`` pixels, those that matter on a plate.

    Shown are the lines that matter and as many around them as there is room for; or, with
    ``first``, all from that line on. Where no line matters more, the first function comes first.
    """
    height = size[1]
    source = [line.expandtabs(TAB) for line in source]
    if not marked and first is None:
        first = next((n for n, line in enumerate(source, 1) if line.startswith("def ")), 1)
    digits = len(str(len(source)))
    pixels = _code_pixels(size, [source[number - 1] for number in marked], digits)
    face = monospaced(pixels)
    letter = face.getlength("0")
    left = (digits + 2) * letter
    step = round(SPACING * pixels)
    image = Image.new("RGBA", size, (*PAPER, 255))
    pen = ImageDraw.Draw(image)
    room = max((height - 2 * pixels) // step - 1, 1)
    columns = max(int((size[0] - left) / letter) - 1, 1)
    pen.text((letter, pixels / 2), writable(name, font(pixels, True)), TITLE, font(pixels, True))
    y = pixels // 2 + round(1.4 * step)
    rows = shown_rows(len(source), marked, room, first)
    quoted = in_texts(source)
    for number in rows:
        if not number:
            pen.text((left, y), "⋯", NUMBER, face)
            y += step
            continue
        if number in marked:
            pen.rectangle((0, y - step // 8, size[0], y + step - step // 8 - 1), MARK)
            pen.rectangle((0, y - step // 8, letter / 2, y + step - step // 8 - 1), RULE)
        colour = STRONG if number in marked else COMMENT if number in quoted else CODE
        pen.text((letter, y), f"{number:{digits}}", NUMBER, face)
        line = _shortened(source[number - 1], columns)
        pen.text((left, y), writable(line, face), colour, face)
        y += step

    pen.line((0, 0, 0, height), RULE, max(height // 400, 1))
    return np.asarray(image)


def _code_pixels(size: tuple[int, int], strong: Sequence[str], digits: int) -> int:
    """Return the size of letters in which the ``strong`` lines fit beside numbers of ``digits``."""
    height = size[1]
    for pixels in _sizes(height // CODE_LETTERS[0], max(height // CODE_LETTERS[1], LEAST)):
        letter = monospaced(pixels).getlength("0")
        left = (digits + 2) * letter
        if all(left + (len(line) + 1) * letter <= size[0] for line in strong):
            break
    return pixels


def _shortened(line: str, columns: int) -> str:
    """Return a line of at most ``columns`` letters."""
    return f"{line[: columns - 1]}…" if len(line) > columns else line


def shown_rows(count: int, marked: Collection[int], room: int, first: int | None) -> list[int]:
    """Return the numbers of the lines to show; 0 stands for those left out between two others."""
    if first is not None or not marked or count <= room:
        begin = max(min((first or 1) - 1, count - room), 0)
        return list(range(begin + 1, min(begin + room, count) + 1))
    best: list[int] = []
    for around in range(count):
        near = sorted(
            {n for m in marked for n in range(m - around, m + around + 1) if 1 <= n <= count}
        )
        rows: list[int] = []
        for number in near:
            if rows and number != rows[-1] + 1:
                rows.append(0)
            rows.append(number)
        if best and len(rows) > room:
            break
        best = rows
    return best[:room]


@dataclass
class Listed:
    """The picture of the list, and the box of each step: left, top, right, bottom, its index."""

    image: np.ndarray
    boxes: list[tuple[int, int, int, int, int]] = field(default_factory=list)

    def at(self, x: float, y: float) -> int | None:
        """Return the index of the step at a place of the picture, in pixels from its top left."""
        for left, top, right, bottom, index in self.boxes:
            if left <= x < right and top <= y < bottom:
                return index
        return None


def _grid(size: tuple[int, int], count: int) -> tuple[int, int, int]:
    """Return the size of the letters of a list of ``count`` steps, its rows and its columns."""
    width, height = size
    for pixels in _sizes(height // LIST_LETTERS[0], max(height // LIST_LETTERS[1], LEAST)):
        line = round(LIST_SPACING * pixels)
        rows = max((height - 6 * pixels) // line, 1)
        columns = min(-(-count // rows), max(width // (36 * pixels), 1))
        if rows * columns >= count:
            return pixels, min(rows, -(-count // columns)), columns
    return pixels, rows, columns


def _draw_step(
    pen: ImageDraw.ImageDraw,
    step: tuple[str, str, str],
    corner: tuple[int, int],
    across: int,
    pixels: int,
    shown: bool,
) -> None:
    """Draw a step's number, title and name in a column that is ``across`` wide."""
    number, what, name = step
    x, y = corner
    face, mono = font(pixels), monospaced(round(0.8 * pixels))
    left = x + round(face.getlength(number)) + pixels
    right = x + across - 2 * pixels - mono.getlength(name)
    what = _cut(writable(what, face), face, right - left - pixels)
    pen.text((x + pixels // 2, y + pixels // 6), number, RULE if shown else DIM, face)
    pen.text((left, y + pixels // 6), what, TITLE if shown else WORDS, face)
    pen.text((right, y + pixels // 3), name, DIM, mono)


def steps_image(
    size: tuple[int, int],
    title: str,
    steps: Sequence[tuple[str, str, str]],
    chosen: int,
    now: int,
    foot: str,
) -> Listed:
    """Render the list of (number, title, name) on all of the window.

    In letters as large as fits; where even the smallest do not, it is the page with the chosen one.
    """
    width, height = size
    pixels, rows, columns = _grid(size, len(steps))
    line = round(LIST_SPACING * pixels)
    image = Image.new("RGBA", size, (*BAND, 252))
    pen = ImageDraw.Draw(image)
    bold, face = font(round(1.2 * pixels), True), font(pixels)
    pen.text((pixels, pixels), writable(title, bold), TITLE, bold)
    pen.line((pixels, 3 * pixels, width - pixels, 3 * pixels), RULE)
    found = Listed(np.asarray(image))
    begin = chosen // (rows * columns) * rows * columns
    across = (width - pixels) // columns
    for index in range(begin, min(begin + rows * columns, len(steps))):
        at = index - begin
        x = pixels // 2 + at // rows * across
        y = round(3.5 * pixels) + at % rows * line
        if index == chosen:
            pen.rectangle((x, y, x + across - pixels, y + line - 2), CHOSEN)
        _draw_step(pen, steps[index], (x, y), across, pixels, index == now)
        found.boxes.append((x, y, x + across, y + line, index))

    for line_ in wrapped(writable(foot, face), face, width - 2 * pixels)[:1]:
        pen.text((pixels, height - pixels // 2), line_, DIM, face, "ld")
    found.image = np.asarray(image)
    return found


def _cut(text: str, face: ImageFont.FreeTypeFont, width: float) -> str:
    if face.getlength(text) <= width:
        return text
    while text and face.getlength(f"{text}…") > width:
        text = text[:-1]
    return f"{text.rstrip()}…"


def still_image(size: tuple[int, int], height: int, pixels: np.ndarray) -> np.ndarray:
    """Render a picture, uint8 (h, w, 4), as large as fits into a box of ``size``, in its middle."""
    picture = Image.fromarray(pixels)
    scale = min(size[0] / picture.width, size[1] / picture.height)
    sides = (max(round(scale * picture.width), 1), max(round(scale * picture.height), 1))
    image = Image.new("RGBA", size, (*PAPER, 255))
    place = ((size[0] - sides[0]) // 2, (size[1] - sides[1]) // 2)
    image.alpha_composite(picture.resize(sides, Image.Resampling.LANCZOS), place)
    return np.asarray(image)


def _text_pixels(size: tuple[int, int], height: int, lines: Sequence[str]) -> int:
    """Return the size of the largest letters in which lines of text fit in a box."""
    for pixels in _sizes(height // TEXT_LETTERS[0], max(height // TEXT_LETTERS[1], LEAST)):
        face = font(pixels)
        inner = size[0] - 4 * pixels
        rows = [row for line in lines for row in _rows_of(line, face, inner)]
        spaces = 0.5 * pixels * (len(lines) - 1)
        if _tall(rows, pixels) + spaces <= size[1] - 3 * pixels:
            break
    return pixels


def text_image(size: tuple[int, int], height: int, lines: Sequence[str]) -> np.ndarray:
    """Render lines of text in a box of ``size``, in letters as large as fits.

    A line that begins with "- " is an item of a list. ``height`` is the window's.
    """
    image = Image.new("RGBA", size, (*PAPER, 255))
    pen = ImageDraw.Draw(image)
    pixels = _text_pixels(size, height, lines)
    face = font(pixels)
    inner = size[0] - 4 * pixels
    y = 1.5 * pixels
    for line in lines:
        for indent, words in _rows_of(line, face, inner):
            pen.text((2 * pixels + indent, y), words, WORDS, face)
            y += SPACING * pixels
        if line.startswith(ITEM):
            top = y - len(_rows_of(line, face, inner)) * SPACING * pixels
            pen.text((2 * pixels, top), "•", RULE, face)
        y += 0.5 * pixels
    return np.asarray(image)


def _rows_of(line: str, face: ImageFont.FreeTypeFont, width: float) -> list[tuple[float, str]]:
    """Return a line of text in rows: how far each is indented, and its words."""
    indent = 1.2 * face.size if line.startswith(ITEM) else 0.0
    words = writable(line.removeprefix(ITEM), face)
    return [(indent, row) for row in wrapped(words, face, width - indent)]


def message_image(size: tuple[int, int], height: int, text: str) -> np.ndarray:
    """Render a sentence in the middle of a box of ``size``; ``height`` is the window's."""
    image = Image.new("RGBA", size, (*PAPER, 255))
    pixels = max(height // 36, LEAST)
    face = font(pixels)
    lines = wrapped(writable(text, face), face, size[0] - 4 * pixels)
    y = (size[1] - _tall(lines, pixels)) / 2
    for line in lines:
        ImageDraw.Draw(image).text((size[0] / 2, y), line, WORDS, face, "ma")
        y += SPACING * pixels
    return np.asarray(image)
