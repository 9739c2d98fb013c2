"""Fonts for text in pictures: DejaVu, which comes with the program.

The text is laid out by Pillow alone. Pillow's other way needs a library that some systems lack, and
spaces letters differently. So a text is the same pixels on every system.
"""

import unicodedata
from functools import lru_cache

from PIL import ImageFont
from PIL.ImageFont import FreeTypeFont

from framelens.base.packages import FRAMELENS

REGULAR = "DejaVuSans.ttf"
BOLD = "DejaVuSans-Bold.ttf"
MONOSPACED = "DejaVuSansMono.ttf"


def font(size: int, bold: bool = False) -> FreeTypeFont:
    """Return a font of ``size`` pixels."""
    return _opened(BOLD if bold else REGULAR, size)


def monospaced(size: int) -> FreeTypeFont:
    """Return a font of ``size`` pixels in which all letters are equally wide."""
    return _opened(MONOSPACED, size)


@lru_cache(maxsize=32)
def _opened(name: str, size: int) -> FreeTypeFont:
    path = FRAMELENS.folder / "fonts" / name
    return ImageFont.truetype(path, size, layout_engine=ImageFont.Layout.BASIC)


def writable(text: str, face: FreeTypeFont) -> str:
    """Return the text; characters that the font lacks lose their accents or become "?"."""
    return "".join(_known(character, face) for character in text)


@lru_cache(maxsize=2048)
def _known(character: str, face: FreeTypeFont) -> str:
    missing = bytes(face.getmask("\uffff"))
    for candidate in (character, unicodedata.normalize("NFKD", character)[0]):
        if candidate == " " or bytes(face.getmask(candidate)) != missing:
            return candidate
    return "?"
