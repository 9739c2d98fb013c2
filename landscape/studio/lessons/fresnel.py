"""The picture of the lecture on reflections: how much water reflects, over the angle of the view.

    python -m landscape.studio.lessons.fresnel

writes landscape/course/lectures/fresnel.png anew. Its labels are numbers and names, so that it
serves every language.
"""

import sys
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from framelens.base.fonts import font
from framelens.base.output import write_whole
from landscape.studio.lessons.lesson_data import png

OUT = Path(__file__).resolve().parents[2] / "course" / "lectures" / "fresnel.png"
INDEX = 4 / 3  # of refraction, of water
SIZE = (960, 540)  # pixels
FINE = 3  # the picture is drawn so many times as large, and made smaller
BOX = (90, 30, 930, 470)  # chosen: pixels of the axes: left, top, right, bottom
COLORS = 64  # chosen: of its palette
# Chosen: as a lecture's plates.
PAPER = (15, 20, 27)
GRID = (52, 66, 82)
WORDS = (242, 242, 236)

EXACT, POWER = (110, 176, 214), (230, 126, 76)  # chosen


def fresnel(angles: np.ndarray, index: float = INDEX) -> np.ndarray:
    """Return the part of unpolarised light that is reflected at angles from the normal, in radians.

    Fresnel 1823: the mean of both polarisations.
    """
    into = np.sqrt(1 - (np.sin(angles) / index) ** 2)
    out = np.cos(angles)
    across = (out - index * into) / (out + index * into)
    along = (into - index * out) / (into + index * out)
    return (across**2 + along**2) / 2


def schlick(angles: np.ndarray, index: float = INDEX) -> np.ndarray:
    """Return what Schlick's formula of 1994 gives in its place."""
    least = ((index - 1) / (index + 1)) ** 2
    return least + (1 - least) * (1 - np.cos(angles)) ** 5


def picture() -> Image.Image:
    """Return both curves with their axes."""
    image = Image.new("RGB", (SIZE[0] * FINE, SIZE[1] * FINE), PAPER)
    pen = ImageDraw.Draw(image)
    letters = font(22 * FINE)
    left, top, right, bottom = (side * FINE for side in BOX)

    def place(degrees: float, part: float) -> tuple[float, float]:
        return left + degrees / 90 * (right - left), bottom - part * (bottom - top)

    for angle in range(0, 91, 15):
        pen.line((*place(angle, 0), *place(angle, 1)), GRID, FINE)
        pen.text(place(angle, -0.03), f"{angle}°", WORDS, letters, "ma")
    for part in (0, 0.25, 0.5, 0.75, 1):
        pen.line((*place(0, part), *place(90, part)), GRID, FINE)
        pen.text((left - 12 * FINE, place(0, part)[1]), f"{part:.0%}", WORDS, letters, "rm")

    degrees = np.linspace(0, 90, 361)
    for row, (name, curve, color) in enumerate(
        (("Fresnel", fresnel, EXACT), ("Schlick", schlick, POWER))
    ):
        parts = curve(np.radians(degrees)).tolist()
        points = [place(*at) for at in zip(degrees.tolist(), parts, strict=True)]
        pen.line(points, color, 4 * FINE)
        x, y = place(6, 0.9 - 0.1 * row)
        pen.line((x, y, x + 40 * FINE, y), color, 4 * FINE)
        pen.text((x + 52 * FINE, y), name, WORDS, letters, "lm")

    return image.resize(SIZE, Image.Resampling.LANCZOS).quantize(COLORS)


def main() -> int:
    """Write the picture; return the exit status."""
    write_whole(OUT, png(picture()))
    print(OUT)
    return 0


if __name__ == "__main__":
    sys.exit(main())
