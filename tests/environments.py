"""Environment files for tests: a height image, a path and targets, as Inkscape writes them."""

import base64
import io
from pathlib import Path

import numpy as np
from PIL import Image

NAMESPACES = (
    'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
    ' xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
    ' xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd"'
)
ROUND = "M 10,32 C 10,10 54,10 54,32 S 10,54 10,32 Z"


def png(side: int = 64, height: int | None = None) -> bytes:
    """Return a PNG of grey that grows darker from the left to the right."""
    row = np.linspace(250, 5, side).astype(np.uint8)
    buffer = io.BytesIO()
    Image.fromarray(np.tile(row, (height or side, 1))).save(buffer, "PNG")
    return buffer.getvalue()


def embedded(data: bytes) -> str:
    return "data:image/png;base64," + base64.b64encode(data).decode()


def image(link: str | None = None, more: str = 'width="64" height="64"') -> str:
    return f'<image xlink:href="{link or embedded(png())}" {more} preserveAspectRatio="none"/>'


def layer(inside: str, label: str = "camera", more: str = "") -> str:
    return f'<g inkscape:groupmode="layer" inkscape:label="{label}" {more}>{inside}</g>'


def path(data: str = ROUND, more: str = "") -> str:
    return f'<path d="{data}" {more}/>'


def svg(*inside: str, more: str = 'width="64" height="64" viewBox="0 0 64 64"') -> str:
    return f'<?xml version="1.0"?><svg {NAMESPACES} {more}>{"".join(inside)}</svg>'


def written(folder: Path, text: str, name: str = "map.svg") -> Path:
    file = folder / name
    file.write_text(text, encoding="utf-8")
    return file
