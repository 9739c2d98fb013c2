"""The inspector's picture: the rows, what is said about the chosen one, and where a click goes."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np
from PIL import Image, ImageDraw

from framelens.inspector.inspector import Inspector
from framelens.inspector.inspector_page import (
    Block,
    Line,
    Span,
    Target,
    details,
    foot,
    head,
    visible,
)
from framelens.inspector.panel import SMALLEST, font, text_size, writable

SIZE = 0.62  # chosen: of the panel's text: the inspector has much to say
LEAST = 11  # chosen: pixels, the font size unless the window's text is smaller still
SPACING = 1.36  # chosen: line height, in font sizes
WIDTH, HEIGHT = 0.46, 0.95  # chosen: of the window, so that its middle stays free
MOST_DETAILS = 0.56  # chosen: of the lines, for what is below the list
MOST_KEYS = 4  # chosen: lines; where the keys need more, only a few of them are named
FEWEST = 7  # chosen: rows of the list, where the window has few lines
NUMBER = 3.4  # chosen: font sizes, the column of the calls' numbers
STEP = 0.9  # chosen: font sizes, by which each depth of the tree is moved to the right
LABEL = 6.4  # chosen: font sizes, the column of the arguments' names

PLATE = (13, 19, 26, 226)  # chosen: RGBA, like all colours below
CHOSEN = (52, 78, 104, 255)
CHOSEN_CELL = (104, 88, 40, 255)
RULE = (70, 84, 98, 255)
COLOURS = {
    "text": (226, 228, 224),
    "title": (255, 255, 255),
    "dim": (140, 152, 164),
    "name": (226, 228, 224),
    "enum": (134, 190, 250),
    "number": (244, 200, 118),
    "pass": (255, 255, 255),
    "element": (152, 216, 164),
    "edited": (255, 142, 92),
    "off": (104, 112, 120),
    "source": (190, 180, 214),
    "meaning": (196, 208, 214),
    "redundant": (206, 160, 214),
    "choice": (116, 150, 190),
    "drawn": (152, 216, 164),
    "failed": (216, 136, 128),
    "keys": (150, 160, 170),
    "message": (255, 214, 120),
}


@dataclass
class Picture:
    """The picture and the places in it: boxes x, y, right, bottom in pixels with their target.

    ``first`` is the first row of the list that is shown.
    """

    image: np.ndarray
    boxes: list[tuple[float, float, float, float, Target]] = field(default_factory=list)
    first: int = 0

    def at(self, x: float, y: float) -> Target | None:
        """Return what is at a place; of several, what was drawn last."""
        for left, top, right, bottom, target in reversed(self.boxes):
            if left <= x < right and top <= y < bottom:
                return target
        return None


def picture(
    model: Inspector,
    size: tuple[int, int],
    dpi: float,
    language: str,
    letters: dict[str, str],
) -> Picture:
    """Draw the inspector on a plate for a window of ``size`` pixels, uint8 (h, w, 4).

    ``letters`` are the labels of keys that the text at the bottom names.
    """
    largest = text_size(size, dpi)
    pixels = max(round(SIZE * largest), min(LEAST, largest), SMALLEST)
    width, height = max(round(WIDTH * size[0]), 8), max(round(HEIGHT * size[1]), 8)
    draw = _Draw(width, height, pixels)
    inner = width - 2 * pixels
    keys = _keys(draw, foot(model, language, letters), inner)
    if len(keys[-1]) > MOST_KEYS:
        keys = _keys(draw, foot(model, language, letters, few=True), inner)
    below = sum(map(len, keys))
    total = max((height - 3 * pixels) // draw.line - 1, 1)
    room = max(total - below, 0)
    blocks = [(block, draw.block(block, inner)) for block in details(model, language)]
    most = max(int(room * MOST_DETAILS), room - FEWEST)
    lines = sum(len(each) for _, each in blocks)
    rows = max(room - min(lines, most), 1)
    first, shown = visible(model, rows, language)

    y: float = pixels // 2 + 2
    draw.spans(pixels, y, head(model, language), inner)
    y += draw.line + pixels // 4
    for line in shown:
        draw.row(y, line)
        y += draw.line
    bottom = height - pixels // 2 - below * draw.line
    y = bottom - min(lines, most) * draw.line - pixels // 2
    if blocks and most:
        draw.rule(y - pixels // 4)
        for block, flowed in blocks:
            y = draw.placed(y, block, flowed, bottom - draw.line + 1)
    y = bottom
    draw.rule(y - pixels // 4)
    for flowed in keys:
        for each in flowed:
            draw.run(each, pixels, y)
            y += draw.line
    return Picture(np.asarray(draw.image), draw.boxes, first)


Flowed = list[list[tuple[float, Span]]]
"""Lines of spans, each with its distance from the left edge of the text."""


class _Draw:
    """The plate while it is drawn."""

    def __init__(self, width: int, height: int, pixels: int) -> None:
        self.image = Image.new("RGBA", (width, height), PLATE)
        self.pixels, self.width = pixels, width
        self.line = round(SPACING * pixels)
        self.boxes: list[tuple[float, float, float, float, Target]] = []
        self._face = font(pixels)
        self._draw = ImageDraw.Draw(self.image)

    def rule(self, y: float) -> None:
        """Draw a line across the plate."""
        edge = self.pixels // 2
        self._draw.line((edge, y, self.width - edge, y), RULE)

    def _length(self, text: str) -> float:
        return float(self._face.getlength(text))

    def flow(self, spans: Iterable[Span], width: float) -> Flowed:
        """Put spans into lines of at most ``width`` pixels, broken at spaces."""
        lines: Flowed = [[]]
        x = 0.0
        for span in spans:
            words = [span.text] if span.target else _pieces(span.text)
            for word in words:
                word = writable(word, self._face)
                length = self._length(word)
                if x and x + self._length(word.rstrip()) > width:
                    lines.append([])
                    x = 0.0
                    word = word.lstrip()
                    length = self._length(word)
                if word:
                    piece = Span(word, span.style, span.target)
                    lines[-1].append((x, piece))
                    x += length
        return [line for line in lines if line]

    def block(self, block: Block, width: float) -> Flowed:
        """Return a block's lines, beside its label if it has one."""
        return self.flow(block.spans, width - (LABEL * self.pixels if block.label else 0))

    def placed(self, y: float, block: Block, flowed: Flowed, last: float) -> float:
        """Draw a block from y on, as far as there is room; return where the next one begins."""
        left = float(self.pixels)
        if block.label and y <= last:
            label = self._cut(block.label, (LABEL - 0.6) * self.pixels)
            self._text(left, y, label, "dim")
            left += LABEL * self.pixels
        for line in flowed:
            if y > last:
                break
            self.run(line, left, y)
            y += self.line
        return y

    def run(self, line: Sequence[tuple[float, Span]], left: float, y: float) -> None:
        """Draw one line of spans."""
        for x, span in line:
            self._span(left + x, y, span)

    def _span(self, x: float, y: float, span: Span) -> float:
        """Draw a span; return where the next one begins."""
        if span.swatch is not None:
            side = self.pixels
            top = y + (self.line - side) / 2 - 1
            self._draw.rectangle((x, top, x + side, top + side), (*span.swatch, 255), RULE)
            x += 1.5 * side
        length = self._length(span.text)
        style, _, chosen = span.style.partition("+")
        if chosen:
            self._draw.rectangle((x - 2, y - 1, x + length + 1, y + self.line - 3), CHOSEN_CELL)
        self._text(x, y, span.text, style)
        if span.target is not None:
            self.boxes.append((x - 2, y, x + length + 2, y + self.line, span.target))
        return x + length

    def _text(self, x: float, y: float, text: str, style: str) -> None:
        colour = COLOURS.get(style, COLOURS["text"])
        self._draw.text((x, y), text, colour, self._face)
        if style == "off":
            middle = y + 0.62 * self.pixels
            self._draw.line((x, middle, x + self._length(text), middle), colour)

    def _cut(self, text: str, width: float) -> str:
        """Return a text shortened to a width."""
        if self._length(text) <= width:
            return text
        while text and self._length(f"{text}…") > width:
            text = text[:-1]
        return f"{text}…" if text else ""

    def spans(self, x: float, y: float, spans: Iterable[Span], right: float) -> None:
        """Draw spans in one line up to ``right``, and shorten the last."""
        for span in spans:
            text = self._cut(writable(span.text, self._face), right - x)
            if not text and span.swatch is None:
                break
            end = self._span(x, y, Span(text, span.style, span.target, span.swatch))
            x = max(end, x + span.column * self.pixels)
            if text.endswith("…") and text != span.text:
                break

    def _end(self, y: float, line: Line) -> float:
        """Draw what stands at the right end of a row; return where it begins."""
        right = float(self.width - self.pixels)
        for span in reversed(line.end):
            right -= self._length(span.text)
            self._text(right, y, span.text, span.style)
            right -= self.pixels / 2
        return right

    def row(self, y: float, line: Line) -> None:
        """Draw a row of the list."""
        pixels, edge = self.pixels, self.pixels // 2
        if line.chosen:
            self._draw.rectangle((edge, y - 1, self.width - edge, y + self.line - 3), CHOSEN)
        if line.target is not None:
            self.boxes.append((0, y, self.width, y + self.line, line.target))
        right = self._end(y, line)

        # Passes and elements stand at the left edge, as calls have a number there.
        left = pixels + line.depth * STEP * pixels
        if line.number:
            left += max(NUMBER * pixels, self._length(line.number) - (line.depth - 1) * pixels)
            number = line.number
            self._text(left - 1.1 * pixels - self._length(number), y, number, "dim")

        if line.sign:
            self._sign(left - 0.2 * pixels, y + 0.3 * pixels, line.sign, line.target, y)
        if line.sign or not line.number:
            left += 0.8 * pixels
        self.spans(left, y, line.spans, right)

    def _sign(self, x: float, y: float, sign: str, target: Target | None, top: float) -> None:
        """Draw the triangle that opens or closes a row."""
        side = 0.55 * self.pixels
        if sign == "+":
            corners = [(x, y), (x, y + side), (x + 0.8 * side, y + side / 2)]
        else:
            corners = [(x - 1, y), (x + side, y), (x + side / 2, y + 0.8 * side)]
        self._draw.polygon(corners, COLOURS["dim"])
        if target is not None:
            box = (x - self.pixels / 2, top, x + self.pixels, top + self.line)
            self.boxes.append((*box, (*target, "sign")))


def _keys(draw: _Draw, said: Sequence[str], width: float) -> list[Flowed]:
    """Put the message, if there is one, and the keys into lines."""
    styles = ["message"] * (len(said) - 1) + ["keys"]
    return [draw.flow([Span(text, style)], width) for text, style in zip(said, styles, strict=True)]


def _pieces(text: str) -> list[str]:
    """Return the words of a text, each with the spaces after it."""
    pieces: list[str] = []
    for part in text.split(" "):
        pieces.append(f"{part} ")
    pieces[-1] = pieces[-1][:-1]
    return pieces


def cross_image(pixels: int) -> np.ndarray:
    """Return a cross-hair whose middle is free, with arms of ``pixels``, uint8 (h, w, 4)."""
    side = 2 * pixels + 1
    image = Image.new("RGBA", (side, side), (0, 0, 0, 0))
    draw = ImageDraw.Draw(image)
    gap = max(pixels // 4, 2)
    for colour, wide in (((0, 0, 0, 190), 3), ((255, 255, 255, 255), 1)):
        for a, b in ((0, pixels - gap), (pixels + gap, side - 1)):
            draw.line((a, pixels, b, pixels), colour, wide)
            draw.line((pixels, a, pixels, b), colour, wide)
    return np.asarray(image)
