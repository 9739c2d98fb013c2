"""Colours of the wireframe: one for each line, by its height and its distance.

The document draws black on white. Lines that fade into the background with distance say what is
near (depth cueing); a ramp of colours by height, as maps have them (hypsometric tints), says what
is high. Each palette is a background, its colour above the horizon, and the lines' colours from
low to high.
"""

import math
from dataclasses import dataclass
from functools import cache

import numpy as np

from landscape.flyover.camera import Camera, Frustum
from landscape.flyover.clipping import Lines
from landscape.flyover.height_field import HeightField

Colour = tuple[int, int, int]
STEPS = 256  # colours in a ramp, and in the sky
SHADES = 64  # how many distances are told apart, chosen
ENTRY_BITS = 14  # of a place among SHADES x STEPS colours
NEARER = 6000  # how finely distances are told apart: steps for each doubling, chosen
NOTHING = np.uint32(0xFFFFFFFF)  # no line
HIGHEST = 0.9  # rise of the rays where the sky has its own colour, chosen


@dataclass(frozen=True)
class Palette:
    """A wireframe's colours, sRGB 0..255: the background below the horizon and high above it.

    ``ramp`` are the colours of lines from the lowest to the highest ground, at equal distances.
    With ``fades`` lines far away have the colour of the background.
    """

    paper: Colour
    sky: Colour
    ramp: tuple[Colour, ...]
    fades: bool = True


PALETTES = {
    "plain": Palette((255, 255, 255), (255, 255, 255), ((0, 0, 0),), fades=False),
    "distance": Palette((247, 248, 250), (205, 220, 238), ((22, 30, 48),)),
    "height": Palette(
        (236, 240, 243),
        (150, 186, 226),
        (
            (13, 59, 102),
            (22, 115, 88),
            (64, 130, 46),
            (140, 128, 40),
            (158, 92, 40),
            (120, 66, 50),
            (92, 84, 98),
            (70, 78, 110),
        ),
    ),
    "phosphor": Palette((3, 10, 6), (1, 4, 3), ((24, 150, 66), (60, 235, 110), (200, 255, 205))),
}


def packed(colours: np.ndarray) -> np.ndarray:
    """Return colours (..., 3) of 0..255 as uint32 (...), opaque, red in the lowest byte."""
    rgba = np.full((*colours.shape[:-1], 4), 255, np.uint8)
    rgba[..., :3] = np.clip(colours, 0, 255) + 0.5
    return np.asarray(rgba.view(np.uint32)[..., 0])


def ramp(stops: tuple[Colour, ...]) -> np.ndarray:
    """Return colours that go evenly through all stops, (STEPS, 3) of 0..255."""
    at = np.linspace(0, len(stops) - 1, STEPS)
    channels = np.array(stops, np.float64).T
    return np.stack([np.interp(at, np.arange(len(stops)), each) for each in channels], axis=1)


def _rise(camera: Camera, near: float, right: np.ndarray, up: np.ndarray) -> np.ndarray:
    """Return how far the rays through places on the near plane rise, (rows, columns).

    ``right`` (columns,) and ``up`` (rows,) are in units. A picture that does not roll has one for
    each row.
    """
    sin, cos = math.sin(camera.theta_x), math.cos(camera.theta_x)
    ahead = -math.sin(camera.theta_y) * near
    steep = math.cos(camera.theta_y)
    rise = ahead + steep * cos * up[:, None]
    if sin:
        rise = rise + steep * sin * right
    return np.asarray(rise)


def background(
    picture: np.ndarray, palette: Palette, camera: Camera, volume: Frustum, columns: range
) -> None:
    """Draw a picture with no lines yet, uint32 (height, width), in some of its columns."""
    height, width = picture.shape
    part = picture[:, columns.start : columns.stop]
    if palette.sky == palette.paper:
        part[:] = packed(np.array(palette.paper))
        return
    table = packed(ramp((palette.paper, palette.sky)))
    right = (np.arange(columns.start, columns.stop) - 0.5) / width * (
        volume.right - volume.left
    ) + volume.left
    up = volume.top - (np.arange(height) - 0.5) / height * (volume.top - volume.bottom)
    rise = _rise(camera, volume.near, right, up)
    shade = np.clip(rise * (STEPS / HIGHEST / volume.near), 0, STEPS - 1).astype(np.int64)
    part[:] = table[shade]


@cache
def shades(palette: Palette) -> np.ndarray:
    """Return a palette's colours of lines, uint32 (SHADES, STEPS): by distance and by height."""
    colours = ramp(palette.ramp)
    if not palette.fades:
        return np.tile(packed(colours), (SHADES, 1))
    # Near lines fade first: a haze that is everywhere takes the same fraction of each step.
    left = np.exp(-3 * np.linspace(0, 1, SHADES)) - math.exp(-3)
    left = (left / left[0])[:, None, None]
    return packed(colours * left + np.array(palette.paper) * (1 - left))


class Ink:
    """The lines of a picture. Where some cross, the nearest is seen, in whatever order they come.

    Each pixel keeps one number, the least that was drawn there: the line's distance, and below that
    its place in the table of colours.
    """

    def __init__(
        self, palette: Palette, field: HeightField, visible: float, marks: np.ndarray
    ) -> None:
        """Prepare a picture without lines; at ``visible`` units all is haze.

        ``marks`` (n,) has NOTHING for each of its pixels, and is written to.
        """
        self.palette = palette
        self.visible = visible
        self.marks = marks
        self.lowest, self.relief = field.lowest, max(field.highest - field.lowest, 1e-6)
        self.drawn: list[np.ndarray] = []

    def of(self, lines: Lines, height: np.ndarray) -> np.ndarray:
        """Return the marks of lines, uint32 (n,); ``height`` (m,) are the heights of vertices."""
        up = (height[lines.a] + height[lines.b]) * 0.5
        up = np.clip((up - self.lowest) * ((STEPS - 1) / self.relief), 0, STEPS - 1)
        away = np.minimum(lines.depth0, lines.depth1)
        far = np.clip(away * (SHADES / self.visible), 0, SHADES - 1)
        rank = np.clip((np.log2(np.maximum(away, 1e-6)) + 20) * NEARER, 0, 0x3FFFE)
        entry = far.astype(np.uint32) * np.uint32(STEPS) + up.astype(np.uint32)
        return np.asarray(rank.astype(np.uint32) << np.uint32(ENTRY_BITS) | entry)

    def draw(self, at: np.ndarray, mark: np.ndarray) -> None:
        """Draw pixels (n,) of lines: their places in the picture, and the lines' marks."""
        np.minimum.at(self.marks, at, mark)
        self.drawn.append(at)

    def on(self, picture: np.ndarray) -> None:
        """Draw the lines on a picture, uint32 (n,)."""
        table = shades(self.palette).ravel()
        for at in self.drawn:
            entry = self.marks.take(at)
            entry &= np.uint32((1 << ENTRY_BITS) - 1)
            picture[at] = table.take(entry)
