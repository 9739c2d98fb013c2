"""Captions: a title or a line of text over a picture, which comes and goes.

Technique: Pillow draws the text, and a blurred copy of it as a shadow, into a layer of colour and
opacity; the layer is blended over the picture by array operations. No OpenGL: any picture can have
one.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from PIL import Image, ImageDraw, ImageFilter, ImageFont

from framelens.base.fonts import font, writable

INK, SHADE = (255, 252, 240), (8, 14, 20)  # chosen: RGB of text and shadow
COME, GO = 0.7, 0.7  # chosen: seconds in which a caption comes and goes
# Chosen: as fractions of the picture's height.
TITLE = 0.115
UNDER = 0.042
LINE = 0.052
SMALL = 0.034
EDGE = 0.075
SMALLEST = 7  # chosen: pixels, size of a font
SHADOW = 0.85  # chosen: opacity of the shadow


@dataclass(frozen=True)
class Caption:
    """Text from ``start`` to ``end``, seconds of its clip.

    A ``title`` stands in the middle; otherwise the text is at the left, above the lower edge, with
    ``below`` in small letters under it.
    """

    text: str
    below: str = ""
    start: float = 0.0
    end: float = 4.0
    title: bool = False

    def over(self, pixels: np.ndarray, seconds: float) -> np.ndarray:
        """Return a picture (h, w, 3) with the caption as it is at a time."""
        opacity = min((seconds - self.start) / COME, (self.end - seconds) / GO, 1.0)
        if opacity <= 0.0:
            return pixels
        height, width = pixels.shape[:2]
        top, layer = _layer(self.text, self.below, self.title, (width, height))
        band = slice(top, top + len(layer))
        alpha = (layer[..., 3:].astype(np.uint16) * round(256 * opacity)) >> 8
        under = pixels[band].astype(np.uint16)
        blended = (under * (255 - alpha) + layer[..., :3].astype(np.uint16) * alpha + 127) // 255
        shown = pixels.copy()
        shown[band] = blended
        return shown


@lru_cache(maxsize=8)
def _layer(text: str, below: str, title: bool, size: tuple[int, int]) -> tuple[int, np.ndarray]:
    """Return the first row of a caption's layer, and the layer, uint8 (rows, width, 4)."""
    layer = _with_shadow(_mask(text, below, title, size))
    rows = np.flatnonzero(layer[..., 3].any(axis=1))
    if not len(rows):
        return 0, layer[:1]
    return int(rows[0]), layer[rows[0] : rows[-1] + 1]


def _mask(text: str, below: str, title: bool, size: tuple[int, int]) -> Image.Image:
    """Return a caption white on black: a title in the middle, another one at the lower left."""
    width, height = size
    words, face = _fitting(text, TITLE if title else LINE, title, size)
    more, small = _fitting(below, UNDER if title else SMALL, False, size)
    mask = Image.new("L", size, 0)
    pen = ImageDraw.Draw(mask)
    if title:
        middle = height * (0.46 if more else 0.5)
        pen.text((width / 2, middle), words, 255, face, "mm")
        pen.text((width / 2, middle + 0.95 * face.size), more, 255, small, "mm")
    else:
        left, low = EDGE * width / 2 + EDGE * height / 2, height * (1 - EDGE)
        pen.text((left, low), more, 255, small, "ls")
        pen.text((left, low - (1.45 * small.size if more else 0)), words, 255, face, "ls")
    return mask


def _fitting(
    words: str, part: float, bold: bool, size: tuple[int, int]
) -> tuple[str, ImageFont.FreeTypeFont]:
    """Return words as a font can write them, and the font: ``part`` of the height, or smaller."""
    width, height = size
    pixels = max(round(part * height), SMALLEST)
    while pixels > SMALLEST and font(pixels, bold).getlength(words) > (1 - 2 * EDGE) * width:
        pixels -= 1
    return writable(words, font(pixels, bold)), font(pixels, bold)


def _with_shadow(mask: Image.Image) -> np.ndarray:
    """Return what is white in a mask in INK over a soft shadow, uint8 (h, w, 4)."""
    ink = np.asarray(mask, np.float32) / 255.0
    reach = max(0.006 * mask.height, 1.0)
    soft = np.asarray(mask.filter(ImageFilter.GaussianBlur(reach)), np.float32) / 255.0
    shadow = np.clip(2.2 * soft, 0.0, 1.0) * SHADOW
    alpha = ink + shadow * (1 - ink)
    weight = (ink / np.maximum(alpha, 1e-6))[..., None]
    colour = np.array(INK) * weight + np.array(SHADE) * (1 - weight)
    return np.concatenate([colour, 255 * alpha[..., None]], axis=2).round().astype(np.uint8)
