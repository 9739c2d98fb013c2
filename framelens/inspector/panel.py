"""The panel: text over the picture, namely a list of keys, a line for messages and a picture
at the left edge (the list of settings).

Not in the report. Technique: Pillow draws the text into an image, which becomes a texture with
power-of-two sides. One blended quad shows it at one texel per pixel, under a glOrtho projection of
the window's size.
State used: both matrices, GL_BLEND, GL_TEXTURE_2D; depth test, fog and lighting off.
"""

import re
from collections.abc import Callable, Hashable, Iterator, Sequence
from contextlib import contextmanager

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from framelens.base.fonts import font, writable
from framelens.gl.seam import begin_pass, drawing, gl
from framelens.gl.state import attrib, flat_projection
from framelens.gl.texture import Texture

Made = tuple[Hashable, Callable[[], np.ndarray]]
"""A picture: what it depends on, and how to make it."""

SMALLEST = 8  # chosen: font size in pixels; smaller text is unreadable
READABLE = 14  # chosen: font size in pixels, times the scale of a display of high resolution
LINES = 34  # chosen: lines of text that fill the window's height
TINY = 6  # chosen: font size in pixels; where all keys do not fit otherwise, small text is better
SPACING, CLOSE = 1.45, 1.2  # chosen: line heights of the keys, in font sizes
MOST_LINES = 5  # chosen: of a message in a narrow window; a longer one is written smaller
ROOMY = 30  # chosen: lines of SMALLEST in a window where the message has a place below the keys
MARGIN = 24  # chosen: heights of the message's margin that fill the window's height
PLATE = (12, 20, 28, 190)  # chosen: RGBA, dark enough for white text over white clouds
# Chosen: RGB.
WORDS = (240, 240, 235)
KEYS = (255, 214, 120)
TITLE = (255, 255, 255)


def text_size(size: tuple[int, int], dpi: float = 1.0) -> int:
    """Return the font size in pixels for a window of ``size``.

    ``dpi`` is the display's resolution in relation to the usual one, 96 dots per inch.
    """
    readable = round(READABLE * dpi) if dpi > 1.0 else 0
    return max(SMALLEST, min(max(size[1] // LINES, readable), size[0] // 40))


def enlarged(size: tuple[int, int], dpi: float, times: float) -> float:
    """Return the ``dpi`` with which :func:`text_size` is ``times`` as large, if it fits."""
    return dpi if times == 1.0 else times * text_size(size, dpi) / READABLE


def keys_image(
    title: str, rows: Sequence[tuple[str, str]], size: tuple[int, int], dpi: float = 1.0
) -> np.ndarray:
    """Render a title and rows of (keys, what they do) on a plate, uint8 (h, w, 4).

    The font suits a window of ``size`` pixels; it shrinks until the plate fits, and the lines of
    the smallest come closer.
    """
    sizes = [(pixels, SPACING) for pixels in range(text_size(size, dpi), SMALLEST - 1, -1)]
    for pixels, spacing in [*sizes, *((pixels, CLOSE) for pixels in range(SMALLEST, TINY - 1, -1))]:
        face = font(pixels)
        title, rows = (
            writable(title, face),
            [(writable(k, face), writable(v, face)) for k, v in rows],
        )
        line, edge = round(spacing * pixels), pixels if spacing == SPACING else pixels // 2
        left = max(face.getlength(keys) for keys, _ in rows)
        right = max(face.getlength(what) for _, what in rows)
        width = int(left + right + 3.5 * edge)
        height = line * (len(rows) + 1) + 2 * edge + edge // 2
        if width <= size[0] and height <= size[1]:
            break

    image = Image.new("RGBA", (width, height), PLATE)
    draw = ImageDraw.Draw(image)
    draw.text((edge, edge), title, TITLE, face, "la")
    y = edge + line + edge // 2
    for keys, what in rows:
        draw.text((edge + left, y), keys, KEYS, face, "ra")
        draw.text((2.5 * edge + left, y), what, WORDS, face, "la")
        y += line

    return np.asarray(image)


def line_image(text: str, size: tuple[int, int], dpi: float = 1.0) -> np.ndarray:
    """Render a text on a plate for a window of ``size`` pixels, uint8 (h, w, 4).

    It is one line, or as many as a narrow window needs.
    """
    readable = max(text_size(size, dpi), min(READABLE, size[1] // LINES))
    lines = wrapped(writable(text, font(readable)), font(readable), size[0] - 1.6 * readable)
    if 1 < len(lines) <= MOST_LINES:
        return _lines_image(lines, readable)
    for pixels in range(text_size(size, dpi), SMALLEST - 1, -1):
        face = font(pixels)
        text = writable(text, face)
        width = int(face.getlength(text) + 1.6 * pixels)
        if width <= size[0]:
            break
    image = Image.new("RGBA", (width, round(1.8 * pixels)), PLATE)
    ImageDraw.Draw(image).text((width / 2, image.height / 2), text, WORDS, face, "mm")
    return np.asarray(image)


def _lines_image(lines: Sequence[str], pixels: int) -> np.ndarray:
    """Render centred lines on a plate, uint8 (h, w, 4)."""
    face = font(pixels)
    width = int(max(map(face.getlength, lines)) + 1.6 * pixels)
    line = round(SPACING * pixels)
    image = Image.new("RGBA", (width, line * len(lines) + round(0.4 * pixels)), PLATE)
    draw = ImageDraw.Draw(image)
    for k, text in enumerate(lines):
        draw.text((width / 2, line * (k + 0.5) + 0.2 * pixels), text, WORDS, face, "mm")
    return np.asarray(image)


def wrapped(text: str, face: ImageFont.FreeTypeFont, width: float) -> list[str]:
    """Return a text in lines of at most ``width`` pixels, broken at spaces.

    A path that is longer is broken behind its slashes.
    """
    lines = [""]
    for word in text.split(" "):
        fits = face.getlength(word) <= width
        for number, part in enumerate([word] if fits else re.split(r"(?<=[/\\])", word)):
            gap = "" if number else " "
            longer = f"{lines[-1]}{gap}{part}".strip()
            if lines[-1] and face.getlength(longer) > width:
                lines.append(part)
            else:
                lines[-1] = longer
    return lines


def below_keys(size: tuple[int, int], dpi: float = 1.0) -> int:
    """Return the height in pixels left free for the message below the keys; 0 in a small window."""
    if size[1] < ROOMY * SMALLEST:
        return 0
    return size[1] // MARGIN + round(2.2 * text_size(size, dpi))


def solid(image: np.ndarray) -> np.ndarray:
    """Return an image, uint8 (h, w, 4), whose plate lets nothing show through."""
    opaque = image.copy()
    opaque[image[..., 3] > 0, 3] = 255
    return opaque


def padded(image: np.ndarray) -> np.ndarray:
    """Return the image (h, w, 4) padded at the right and bottom to power-of-two sides."""
    h, w = (1 << (side - 1).bit_length() for side in image.shape[:2])
    canvas = np.zeros((h, w, 4), np.uint8)
    canvas[: image.shape[0], : image.shape[1]] = image
    return canvas


class Plate:
    """One image as a texture, drawn one texel per pixel."""

    def __init__(self, image: np.ndarray) -> None:
        """Upload an image, uint8 (h, w, 4)."""
        canvas = padded(image)
        self.height, self.width = image.shape[:2]
        self._s, self._t = self.width / canvas.shape[1], self.height / canvas.shape[0]
        self._texture = Texture(canvas, repeat=False)

    def draw(self, x: int, y: int, opacity: float) -> None:
        """Draw with the lower left corner at x, y in pixels."""
        right, top = x + self.width, y + self.height
        self._texture.bind()
        gl.glColor4f(1.0, 1.0, 1.0, opacity)
        gl.glBegin(gl.GL_QUADS)
        for s, t, px, py in (
            (0.0, self._t, x, y),
            (self._s, self._t, right, y),
            (self._s, 0.0, right, top),
            (0.0, 0.0, x, top),
        ):
            gl.glTexCoord2f(s, t)
            gl.glVertex2f(float(px), float(py))
        gl.glEnd()
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        self._texture.release()


@contextmanager
def _blended(size: tuple[int, int]) -> Iterator[None]:
    """Blend textures over a window of ``size`` pixels, a unit each, within the block."""
    groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT
    with attrib(groups), flat_projection(0, size[0], 0, size[1], -1, 1):
        for off in (gl.GL_DEPTH_TEST, gl.GL_FOG, gl.GL_LIGHTING):
            gl.glDisable(off)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        yield


class Panel:
    """The list of keys in the middle of the window, the message at its lower edge, and a picture
    at its left edge.
    """

    def __init__(self, title: str, rows: Sequence[tuple[str, str]], dpi: float = 1.0) -> None:
        """Keep the text; textures are made when first shown, and again when they must change.

        ``dpi`` is as in :func:`text_size`.
        """
        self.dpi = dpi
        self._title, self._rows = title, tuple(rows)
        self._plates: dict[str, tuple[Hashable, Plate]] = {}

    def set_rows(self, rows: Sequence[tuple[str, str]], title: str = "") -> None:
        """Change the list of keys, and its title if there is one."""
        self._title, self._rows = title or self._title, tuple(rows)

    @drawing("panel")
    def draw(
        self,
        size: tuple[int, int],
        keys: bool = False,
        message: str = "",
        opacity: float = 1.0,
        left: Made | None = None,
        cross: tuple[int, int, Callable[[], np.ndarray]] | None = None,
        bar: Made | None = None,
        opaque: bool = False,
        covered: int = 0,
        right: Made | None = None,
    ) -> None:
        """Draw the keys and the message in a window of ``size`` pixels; ``opacity`` is 0 to 1.

        ``left`` is a picture at the left edge: what it depends on, and how to make it. ``cross`` is
        one of odd size with its middle at a pixel, counted from the top left. ``bar`` is one in the
        middle of the lower edge, given as ``left`` is; the message is then above it. ``opaque``
        lets nothing show through the picture at the left. The message stays above the lowest
        ``covered`` rows. ``right`` is a picture at the right
        edge, above the lowest fifth of the window.
        """
        if not keys and not message and left is None and bar is None and right is None:
            return
        begin_pass("overlay")
        with _blended(size):
            if cross is not None:
                self._draw_cross(size, *cross)
            below_message = self._draw_bar(size, bar) if bar is not None and not keys else 0
            beside = self._draw_left(size, left, opaque) if left is not None else 0
            if right is not None and not keys:
                self._draw_right(size, right)
            if keys:
                self._draw_keys(size)
            if message:
                self._draw_message(size, message, opacity, beside, max(below_message, covered))

    def _draw_cross(
        self, size: tuple[int, int], x: int, y: int, make: Callable[[], np.ndarray]
    ) -> None:
        """Draw a picture with its middle at a pixel, counted from the top left."""
        plate = self._plate("cross", size, make)
        plate.draw(x - plate.width // 2, size[1] - 1 - y - plate.height // 2, 1.0)

    def _draw_bar(self, size: tuple[int, int], bar: Made) -> int:
        """Draw a picture in the middle of the lower edge; return its height."""
        plate = self._plate("bar", *bar)
        plate.draw((size[0] - plate.width) // 2, size[1] // (3 * MARGIN), 1.0)
        return plate.height

    def _draw_left(self, size: tuple[int, int], left: Made, opaque: bool) -> int:
        """Draw a picture at the left edge; return the first column that it leaves free."""
        key, make = left
        plate = self._plate(
            "left", (key, size, opaque), lambda: solid(make()) if opaque else make()
        )
        edge = size[1] // 48
        plate.draw(edge, (size[1] - plate.height) // 2, 1.0)
        return edge + plate.width

    def _draw_right(self, size: tuple[int, int], right: Made) -> None:
        """Draw a picture at the right edge, above the lowest fifth of the window."""
        plate = self._plate("right", *right)
        plate.draw(size[0] - plate.width - size[1] // 48, size[1] // 5, 1.0)

    def _draw_keys(self, size: tuple[int, int]) -> None:
        """Draw the table of keys above what is reserved for the message."""
        below = below_keys(size, self.dpi)
        shown = self._title, self._rows, (size[0], size[1] - below), self.dpi
        plate = self._plate("keys", shown, lambda: keys_image(*shown))
        lower = below + (size[1] - below - plate.height) // 2
        plate.draw((size[0] - plate.width) // 2, lower, 1.0)

    def _draw_message(
        self, size: tuple[int, int], message: str, opacity: float, beside: int, above: int
    ) -> None:
        """Draw the message, above the lowest ``above`` rows.

        It is in the middle of what the picture at the left leaves free from the column ``beside``
        on, if it fits there.
        """
        line = message, size, self.dpi
        plate = self._plate("line", line, lambda: line_image(*line))
        middle = (size[0] + beside - plate.width) // 2
        x = max(min(middle, size[0] - plate.width), 0)
        lower = size[1] // MARGIN + above
        plate.draw(x, max(min(lower, size[1] - plate.height), 0), opacity)

    def _plate(self, name: str, shows: Hashable, make: Callable[[], np.ndarray]) -> Plate:
        """Return the plate of a name; it is made again if it is to show something else."""
        if name not in self._plates or self._plates[name][0] != shows:
            if name in self._plates:
                self._plates.pop(name)[1].release()
            self._plates[name] = shows, Plate(make())
        return self._plates[name][1]

    def release(self) -> None:
        """Delete the textures; may be called twice."""
        while self._plates:
            self._plates.popitem()[1][1].release()
