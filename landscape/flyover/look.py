"""A terrain's look in filled mode: the data that is made once for it and kept on disk."""

import math
import weakref
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from landscape.files.cache import recall
from landscape.files.images import read_image
from landscape.flyover.dome import dome
from landscape.flyover.ground import Pyramid, bake, character
from landscape.flyover.height_field import HeightField
from landscape.flyover.noise import noise
from landscape.flyover.rock import Rock, rock
from landscape.flyover.settings import Settings

GRAIN = 512  # texels a side of the grain's pattern, chosen
SEED = 9  # of the grain


@dataclass(frozen=True)
class Look:
    """The ground's colours, the sky's, the grain of the ground close by, rock, the water's height.

    ``sky`` are uint32 (rows, columns), see :mod:`.dome`; ``grain`` uint8 (n, n) is how much darker
    the ground is, or how the water is inclined. ``sea`` is below all ground if there is no water.
    """

    ground: Pyramid
    sky: np.ndarray
    grain: np.ndarray
    rock: Rock
    sea: float


_last: list[tuple[weakref.ref[np.ndarray], Settings, Look]] = []


def look(field: HeightField, settings: Settings) -> Look:
    """Return what a terrain looks like; the last answer is kept.

    InputError if the image of the ground cannot be read.
    """
    heights = field.levels[0]
    for kept, with_, found in _last:
        if kept() is heights and with_ == settings:
            return found
    made = _made(field, settings)
    _last[:] = [(weakref.ref(heights), settings, made)]
    return made


def _made(field: HeightField, settings: Settings) -> Look:
    ours = settings.filled
    towards = sun_direction(ours.sun_azimuth, ours.sun_elevation)
    heights = np.ascontiguousarray(field.levels[0][:-1, :-1] / np.float32(field.unit))
    sea = ours.sea * settings.flyover.relief if ours.sea else -math.inf
    texels = 1 << (ours.texels.bit_length() - 1)
    image = None if ours.image == "none" else read_image(Path(ours.image), "RGB")
    parts = (
        "ground, stone, snow and rivers",
        f"{texels} {sea} {field.unit} {towards.tolist()} {ours.shadows} {ours.occlusion}",
        b"" if image is None else f"{image.shape}".encode() + image.tobytes(),
        f"{heights.shape}",
        heights.tobytes(),
    )

    above = max(sea, float(field.lowest) - 1) / field.unit

    def ground() -> tuple[np.ndarray, ...]:
        made = bake(heights, texels, above, towards, image, ours.shadows, ours.occlusion)
        return made.texels, made.offsets

    picture, offsets = recall(parts, ground)
    rows = max(min(texels // 2, 1024), 16)
    (sky,) = recall(
        ("sky and clouds", f"{towards.tolist()} {ours.clouds} {rows}"),
        lambda: (dome(towards, ours.clouds, rows),),
    )
    folded = bool(character(heights, above)[0] < 0.5)

    def layers() -> tuple[np.ndarray, ...]:
        made = rock(folded)
        return made.texels, made.offsets

    walls = Rock(*recall(("rock", f"{folded}"), layers))
    grain = np.clip(noise(GRAIN, SEED, 1.0, 6) * 50 + 128, 0, 255).astype(np.uint8)
    bits = texels.bit_length() - 1
    return Look(Pyramid(picture, offsets, bits, 2 * field.size), sky, grain, walls, sea)


def sun_direction(azimuth: float, elevation: float) -> np.ndarray:
    """Return the direction to the sun, (3,), from its angles in degrees."""
    turn, up = math.radians(azimuth), math.radians(elevation)
    flat = math.cos(up)
    return np.array((math.cos(turn) * flat, math.sin(turn) * flat, math.sin(up)), np.float32)
