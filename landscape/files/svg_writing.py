"""Environment files as Inkscape writes them, for :mod:`.svg_environment` to read. No OpenGL.

The map, the camera's path, the points to look at and a note have a layer each.
"""

import base64
import html
import io
import textwrap
from collections.abc import Sequence

import numpy as np
from PIL import Image

from landscape.files.svg_environment import CAMERA, TARGETS

NOTE = (
    "The map: black is high, white is low. A pixel is one unit.",
    "Layer camera: the path that the camera flies along, 2 units above the ground.",
    "Layer targets: circles. The camera turns to the nearest one before it.",
    "Change them as you like, save as Inkscape SVG, and type: landscape flyover FILE.svg",
)
LINE = 14.0  # chosen: user units from one line of the note to the next, on a map of 512
RADIUS = 4.0  # chosen: of the circles, there


def grey(level: np.ndarray) -> np.ndarray:
    """Return heights (N, N) in 0..1 as uint16 greys, black at 1 and white at 0.

    They have 1024 shades, which take half the bytes of 65536 and are fine enough to fly over.
    """
    return np.round((1.0 - np.clip(level, 0.0, 1.0)) * 1023.0).astype(np.uint16) << 6


def environment_text(
    image: np.ndarray,
    subpaths: Sequence[np.ndarray],
    targets: np.ndarray,
    note: Sequence[str] = NOTE,
) -> str:
    """Return an SVG with a grey image (N, N), uint8 or uint16, embedded as PNG.

    ``subpaths``, each (n, 4, 2) cubics, and ``targets`` (m, 2) are in pixels; they are rounded to
    hundredths.
    """
    side = len(image)
    scale = side / 512
    buffer = io.BytesIO()
    Image.fromarray(image).save(buffer, "PNG", optimize=True)
    link = "\n".join(textwrap.wrap(base64.b64encode(buffer.getvalue()).decode(), 120))

    data = " ".join(_path_data(curves) for curves in subpaths)
    circles = "\n".join(
        f'    <circle cx="{_number(x)}" cy="{_number(y)}" r="{_number(RADIUS * scale)}" />'
        for x, y in targets
    )
    lines = "\n".join(
        f'    <tspan x="0" y="{_number(side + (k + 1) * LINE * scale)}">{line}</tspan>'
        for k, line in enumerate(html.escape(line, quote=False) for line in note)
    )
    height = _number(side + (len(note) + 0.5) * LINE * scale)

    return f"""<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"
  xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
  xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd"
  width="{side}" height="{height}" viewBox="0 0 {side} {height}">
  <g id="map" inkscape:groupmode="layer" inkscape:label="map" sodipodi:insensitive="true">
    <image width="{side}" height="{side}" preserveAspectRatio="none"
      xlink:href="data:image/png;base64,{link}" />
  </g>
  <g id="camera" inkscape:groupmode="layer" inkscape:label="{CAMERA}">
    <path style="fill:none;stroke:#e01b24;stroke-width:{_number(2 * scale)}"
      d="{data}" />
  </g>
  <g id="targets" inkscape:groupmode="layer" inkscape:label="{TARGETS}"
    style="fill:#1a5fb4;stroke:#ffffff;stroke-width:{_number(scale)}">
{circles}
  </g>
  <text id="note" xml:space="preserve"
    style="font-size:{_number(0.75 * LINE * scale)}px;font-family:sans-serif">
{lines}
  </text>
</svg>
"""


def _path_data(curves: np.ndarray) -> str:
    """Return cubics (n, 4, 2) as the data of a path, closed if they end where they start."""
    start = f"M {_point(curves[0, 0])}"
    steps = [f"C {' '.join(_point(point) for point in curve[1:])}" for curve in curves]
    return " ".join([start, *steps, *["Z"] * bool((curves[0, 0] == curves[-1, 3]).all())])


def _point(point: np.ndarray) -> str:
    return f"{_number(point[0])},{_number(point[1])}"


def _number(value: float) -> str:
    return f"{value:.2f}".rstrip("0").rstrip(".")
