"""The picture of the captions of sounds: a line for each, with an arrow. No OpenGL."""

from collections.abc import Sequence

import numpy as np
from PIL import Image, ImageDraw

from framelens.base.fonts import font, writable
from framelens.inspector.panel import KEYS, PLATE, WORDS, text_size

SPACING = 1.45  # chosen: line heights, in font sizes


def caption_image(
    lines: Sequence[tuple[str, str, float]], size: tuple[int, int], dpi: float = 1.0
) -> np.ndarray:
    """Render lines of (text, arrow, opacity 0..1), one under the other, uint8 (h, w, 4).

    The font suits a window of ``size`` pixels. Each line has a plate of its own, which fades with
    it; all are as wide as the widest, so that the arrows stand in a column.
    """
    pixels = text_size(size, dpi)
    face = font(pixels)
    texts = [writable(text, face) for text, _, _ in lines]
    arrow_wide = round(1.4 * pixels)
    text_wide = max(int(face.getlength(text)) for text in texts)
    width = min(arrow_wide + text_wide + 2 * pixels, size[0])
    line = round(SPACING * pixels)
    image = Image.new("RGBA", (width, line * len(lines)), (0, 0, 0, 0))
    for k, (text, (_, arrow, opacity)) in enumerate(zip(texts, lines, strict=True)):
        strip = _strip(text, writable(arrow, face), (width, line), pixels, arrow_wide)
        strip.putalpha(strip.getchannel("A").point(lambda a, left=opacity: round(a * left)))
        image.paste(strip, (0, k * line))
    return np.asarray(image)


def _strip(
    text: str, arrow: str, size: tuple[int, int], pixels: int, arrow_wide: int
) -> Image.Image:
    """Return a line on its plate, with an arrow in front of it if there is one."""
    face = font(pixels)
    middle = size[1] / 2
    strip = Image.new("RGBA", size, PLATE)
    pen = ImageDraw.Draw(strip)
    if arrow:
        pen.text((pixels / 2, middle), arrow, KEYS, face, "lm")
    pen.text((pixels / 2 + arrow_wide, middle), text, WORDS, face, "lm")
    return strip
