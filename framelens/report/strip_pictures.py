"""The buffers of a strip as pictures, with a legend of their tones.

Colour is shown as it is. Depth becomes the distance from the eye, by the projection in force, on a
logarithmic scale from the nearest to the farthest that any of the pictures shows, near dark and far
light; pixels still empty are white. Stencil values and layers have a colour each.
"""

import colorsys
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PIL import Image

from framelens.report.strip_words import number, text
from framelens.tape.strip import SharedValues, Shot

RGB = tuple[int, int, int]

NEAR, FAR, EMPTY = 20, 225, 255  # chosen: greys of the nearest, the farthest, and of no depth
# Values 0 to 8 of the stencil buffer: white, then colours that colour-blind readers can tell apart
# (Okabe and Ito, "Color universal design", 2008).
STENCIL: tuple[RGB, ...] = (
    (255, 255, 255),
    (0, 114, 178),
    (230, 159, 0),
    (0, 158, 115),
    (204, 121, 167),
    (86, 180, 233),
    (213, 94, 0),
    (240, 228, 66),
    (0, 0, 0),
)
GOLDEN = 0.618034  # turns of the colour circle from one value above 8 to the next
# The first of so many layers, and their colours: white, then from yellow to dark red (ColorBrewer,
# YlOrRd).
LAYERS: tuple[tuple[int, RGB], ...] = (
    (0, (255, 255, 255)),
    (1, (255, 237, 160)),
    (2, (254, 217, 118)),
    (3, (254, 178, 76)),
    (4, (253, 141, 60)),
    (5, (252, 78, 42)),
    (6, (227, 26, 28)),
    (8, (189, 0, 38)),
    (12, (128, 0, 38)),
    (20, (64, 0, 24)),
)
TICKS = 6  # chosen: about so many distances in the legend
VALUES = 10  # chosen: stencil values in the legend


@dataclass(frozen=True)
class Legend:
    """The legend of a buffer's tones: a heading, and colours with their meaning."""

    heading: str
    entries: Sequence[tuple[RGB, str]]


class Tones:
    """Turns buffers into pictures; the same tone means the same in all pictures of a strip."""

    def __init__(self, found: SharedValues, language: str) -> None:
        self._lens, self._language = found.lens, language
        self._stencil: set[int] = set()
        values = found.depths or (0.0, 1.0)
        self._logarithmic = found.lens.perspective
        ends = sorted(float(each) for each in self._measured(np.array(values)))
        self._near, self._far = ends[0], max(ends[1], ends[0] * (1 + 1e-6), ends[0] + 1e-9)

    def picture(self, name: str, buffer: np.ndarray) -> Image.Image:
        """Return a buffer of a Shot as an RGB image."""
        if name == "depth":
            return Image.fromarray(self._depth(buffer)).convert("RGB")
        if name == "stencil":
            self._stencil |= set(np.unique(buffer).tolist())
            table = np.array([stencil_color(value) for value in range(256)], np.uint8)
            return Image.fromarray(table[buffer])
        if name == "overdraw":
            starts = [first for first, _ in LAYERS[1:]]
            table = np.array([color for _, color in LAYERS], np.uint8)
            return Image.fromarray(table[np.digitize(buffer, starts)])
        return Image.fromarray(buffer)

    def _measured(self, depth: np.ndarray) -> np.ndarray:
        """Return distances from the eye, or depths where the projection has none."""
        return np.asarray(self._lens.distance(depth) if self._logarithmic else depth, np.float64)

    def _grey(self, values: np.ndarray) -> np.ndarray:
        near, far = self._near, self._far
        if self._logarithmic:
            values, near, far = (
                np.log(np.maximum(each, 1e-12)) for each in (values, np.array(near), np.array(far))
            )
        share = np.clip((values - near) / (far - near), 0.0, 1.0)
        return np.asarray(np.rint(NEAR + share * (FAR - NEAR)), np.uint8)

    def _depth(self, depth: np.ndarray) -> np.ndarray:
        with np.errstate(all="ignore"):
            grey = self._grey(np.nan_to_num(self._measured(depth), nan=self._far))
        return np.where(depth < 1.0, grey, np.uint8(EMPTY))

    def legend(self, name: str) -> Legend | None:
        """Return the legend of a buffer, after its pictures were made; None where it has none."""
        if name == "depth":
            return self._depth_legend()
        if name == "stencil":
            return self._stencil_legend() if self._stencil else None
        if name == "overdraw":
            return self._overdraw_legend()
        return None

    def _depth_legend(self) -> Legend:
        language = self._language
        values = ticks(self._near, self._far) if self._logarithmic else self._even()
        greys = self._grey(np.array(values)).tolist()
        entries = [
            ((grey, grey, grey), _short(language, value))
            for grey, value in zip(greys, values, strict=True)
        ]
        heading = "legend.depth" if self._logarithmic else "legend.window_depth"
        empty = (EMPTY, EMPTY, EMPTY), text(language, "nothing")
        return Legend(text(language, heading), [*entries, empty])

    def _stencil_legend(self) -> Legend:
        language = self._language
        present = sorted(self._stencil)
        entries = [(stencil_color(value), str(value)) for value in present[:VALUES]]
        if len(present) > VALUES:
            left = text(language, "more", n=len(present) - VALUES)
            entries.append(((128, 128, 128), left))
        return Legend(text(language, "legend.stencil"), entries)

    def _overdraw_legend(self) -> Legend:
        ends = [first for first, _ in LAYERS[1:]]
        entries = [
            (color, str(first) if end == first + 1 else f"{first}–{end - 1}")
            for (first, color), end in zip(LAYERS, ends, strict=False)
        ]
        first, color = LAYERS[-1]
        entries.append((color, text(self._language, "or_more", n=first)))
        return Legend(text(self._language, "legend.overdraw"), entries)

    def _even(self) -> list[float]:
        return [float(value) for value in np.linspace(self._near, self._far, TICKS)]

    def layers(self, shot: Shot) -> str:
        """Return the mean and the greatest number of layers, as text; "" where there is none."""
        layers = shot.buffers.get("overdraw")
        if layers is None or not layers.any():
            return ""
        mean = number(self._language, float(layers.mean()), 2)
        return text(self._language, "layers", mean=mean, most=int(layers.max()))


def stencil_color(value: int) -> RGB:
    """Return the colour of a stencil value, 0 to 255."""
    if value < len(STENCIL):
        return STENCIL[value]
    red, green, blue = colorsys.hsv_to_rgb(value * GOLDEN % 1.0, 0.65, 0.7)
    return round(255 * red), round(255 * green), round(255 * blue)


def ticks(near: float, far: float) -> list[float]:
    """Return round distances between two, about TICKS of them, spread over a logarithmic scale."""
    near = max(near, 1e-9)
    first, last = int(np.floor(np.log10(near))), int(np.ceil(np.log10(far)))
    for steps in ((1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9), (1, 2, 5), (1, 3), (1,)):
        found = [step * 10.0**k for k in range(first, last + 1) for step in steps]
        inside = [value for value in found if 0.999 * near <= value <= 1.001 * far]
        if len(inside) <= TICKS + 2:
            break
    inside = inside[:: -(-len(inside) // (TICKS + 2)) or 1]
    return inside if len(inside) > 1 else [near, far]


def _short(language: str, value: float) -> str:
    written = f"{value:.3g}"
    return written.replace(".", ",") if language == "fr" else written
