"""A strip's contents, whatever its file's format: its cells, and how text and pictures are set."""

from collections.abc import Sequence
from dataclasses import dataclass

from PIL import Image, ImageDraw, ImageFont

from framelens.base.fonts import font, writable
from framelens.report.strip_pictures import Legend, Tones
from framelens.tape.strip import Group

# Chosen: RGB.
PAPER = (255, 255, 255)
INK = (28, 28, 30)
GREY = (104, 106, 110)
RULE = (190, 192, 196)
PLATE = (236, 238, 240)  # chosen: RGB behind a picture of another shape, and where there is none
SPACING = 1.35  # chosen: line height, in font sizes


@dataclass(frozen=True)
class Cell:
    """A step: its number, from 1, or the call's; title, lines of text, and how many calls it has.

    For each buffer there is a picture, or the text that says why not.
    """

    number: int
    label: str
    title: str
    lines: Sequence[str]
    calls: str
    pictures: Sequence[Image.Image | str]
    group: Group


@dataclass(frozen=True)
class Page:
    """The head of a strip; ``count`` is its number of steps, ``size`` the frame's in pixels."""

    title: str
    intro: str
    buffers: Sequence[str]
    language: str
    count: int
    size: tuple[int, int]
    tones: Tones

    def legends(self) -> list[Legend]:
        """Return the legends of the buffers that need one."""
        found = (self.tones.legend(name) for name in self.buffers)
        return [legend for legend in found if legend is not None]


def fitted(size: tuple[int, int], most: int) -> tuple[int, int]:
    """Return the size of a picture at most ``most`` wide and high; small ones grow whole times."""
    width, height = size
    if max(size) <= most // 2:
        times = most // max(size)
        return width * times, height * times
    scale = min(1.0, most / max(size))
    return max(1, round(width * scale)), max(1, round(height * scale))


def scaled(picture: Image.Image | str, box: tuple[int, int], sharp: bool) -> Image.Image:
    """Return a picture that fills a box, or a plate with the picture or the text in it.

    ``sharp`` keeps the colours as they are, by choosing pixels instead of averaging them.
    """
    if isinstance(picture, Image.Image):
        scale = min(box[0] / picture.width, box[1] / picture.height)
        size = max(1, round(picture.width * scale)), max(1, round(picture.height * scale))
        near = sharp or scale >= 1
        if size != picture.size:
            how = Image.Resampling.NEAREST if near else Image.Resampling.LANCZOS
            picture = picture.resize(size, how)
        if size == box:
            return picture

    plate = Image.new("RGB", box, PLATE)
    if isinstance(picture, Image.Image):
        plate.paste(picture, ((box[0] - picture.width) // 2, (box[1] - picture.height) // 2))
        return plate
    _draw_in_the_middle(plate, picture)
    return plate


def _draw_in_the_middle(plate: Image.Image, words: str) -> None:
    face = font(max(11, min(15, plate.width // 16)))
    place = (plate.width / 2, plate.height / 2)
    ImageDraw.Draw(plate).text(place, writable(words, face), GREY, face, "mm")


def wrapped(text: str, face: ImageFont.FreeTypeFont, width: int, most: int = 2) -> list[str]:
    """Break a text into at most ``most`` lines of ``width`` pixels; "…" ends one that is cut."""
    lines, words = [""], writable(text, face).split(" ")
    for word in words:
        longer = f"{lines[-1]} {word}" if lines[-1] else word
        if lines[-1] and face.getlength(longer) > width:
            lines.append(word)
        else:
            lines[-1] = longer
    if len(lines) > most:
        lines[most - 1 :] = [" ".join(lines[most - 1 :])]
    return [_cut(line, face, width) for line in lines]


def _cut(line: str, face: ImageFont.FreeTypeFont, width: int) -> str:
    if face.getlength(line) <= width:
        return line
    while line and face.getlength(line + "…") > width:
        line = line[:-1]
    return line.rstrip() + writable("…", face)


def draw_legend(
    pen: ImageDraw.ImageDraw, legend: Legend, corner: tuple[int, int], size: int, width: int
) -> int:
    """Draw a legend with text of ``size`` pixels; return its height in pixels."""
    face = font(size)
    x = corner[0]
    y = corner[1]
    line, side = round(1.6 * size), size
    heading = writable(legend.heading, face)
    pen.text((x, y + line / 2), heading, INK, face, "lm")
    length = round(face.getlength(heading)) + 2 * size
    entries = [(color, writable(text, face)) for color, text in legend.entries]
    needed = sum(round(face.getlength(text)) + side + 2 * size for _, text in entries)
    if length + needed > width:
        y, x = y + line, corner[0]
    else:
        x += length

    for color, text in entries:
        step = round(face.getlength(text)) + side + 2 * size
        if x + step > corner[0] + width + size and x > corner[0]:
            x, y = corner[0], y + line
        top = y + (line - side) // 2
        pen.rectangle((x, top, x + side, top + side), color, RULE)
        pen.text((x + side + size // 2, y + line / 2), text, INK, face, "lm")
        x += step

    return y + line - corner[1]
