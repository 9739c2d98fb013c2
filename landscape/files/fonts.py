"""Fonts for text in pictures: one of the system's."""

import unicodedata
from functools import lru_cache
from typing import Any

from PIL import ImageFont

FONTS = ("DejaVuSans.ttf", "LiberationSans-Regular.ttf", "NotoSans-Regular.ttf", "Arial.ttf")
BOLD = ("DejaVuSans-Bold.ttf", "LiberationSans-Bold.ttf", "NotoSans-Bold.ttf", "Arialbd.ttf")
MONOSPACED = (
    "DejaVuSansMono.ttf",
    "LiberationMono-Regular.ttf",
    "NotoSansMono-Regular.ttf",
    "cour.ttf",
)


@lru_cache(maxsize=16)
def font(size: int, bold: bool = False) -> Any:
    """Return a font of ``size`` pixels: one of the system's, else Pillow's own (ASCII only)."""
    for name in (*(BOLD if bold else ()), *FONTS):
        try:
            return ImageFont.truetype(name, size)
        except OSError:
            continue
    return ImageFont.load_default(size)


@lru_cache(maxsize=16)
def monospaced(size: int) -> Any:
    """Return a font of ``size`` pixels in which all letters are equally wide, if there is one."""
    for name in MONOSPACED:
        try:
            return ImageFont.truetype(name, size)
        except OSError:
            continue
    return font(size)


def writable(text: str, face: Any) -> str:
    """Return the text; characters that the font lacks lose their accents or become "?"."""
    return "".join(_known(character, face) for character in text)


@lru_cache(maxsize=2048)
def _known(character: str, face: Any) -> str:
    missing = bytes(face.getmask("\uffff"))
    for candidate in (character, unicodedata.normalize("NFKD", character)[0]):
        if candidate == " " or bytes(face.getmask(candidate)) != missing:
            return candidate
    return "?"
