"""The plants of the island in voxels, for two crossed quads each, in one strip."""

from collections.abc import Callable

import numpy as np

from landscape.studio.images import bleed, shrink, to_uint8
from landscape.studio.voxel.ground import GRASS
from landscape.studio.voxel.paint import OVER, SIDE, Canvas, blade_widths, curve, leaf_widths
from landscape.voxel.blocks import PLANT_TILES
from landscape.voxel.tiles import PLANTS_FILE
from landscape.voxel.tiles import SIDE as TEXELS

# All chosen: ramps of colour, dark to light.
FERN = ((30, 74, 48), (58, 112, 56), (94, 148, 66), (140, 186, 84), (190, 216, 118))
STEM = ((46, 92, 48), (92, 142, 64), (148, 186, 92))
RED = ((116, 16, 30), (186, 30, 34), (228, 62, 40), (250, 120, 74))
YELLOW = ((196, 124, 18), (238, 180, 24), (255, 218, 52), (255, 244, 150))
BLUE = ((38, 48, 132), (64, 86, 190), (98, 132, 228), (164, 190, 250))
PINK = ((112, 46, 106), (164, 78, 150), (206, 122, 186), (240, 178, 220))
DARK = ((30, 22, 32), (58, 42, 54), (96, 78, 84))
WHITE = ((176, 182, 200), (226, 228, 234), (250, 250, 246), (255, 255, 255))
BROWN = ((66, 42, 34), (104, 70, 50), (146, 104, 70))
NEEDLE = ((84, 94, 112), (136, 146, 154), (186, 194, 190), (240, 244, 226))
HEATH = ((48, 66, 48), (82, 102, 62), (122, 138, 82))
UP = -np.pi / 2
LEAST = 0.4  # chosen: a texel is drawn if this much of it is covered
FOOT = SIDE + 1.0  # stems begin below the lower edge


def grass_blades(
    canvas: Canvas, rng: np.random.Generator, count: int, low: float, high: float, half: float
) -> None:
    """Paint a tuft of blades, ``low`` to ``high`` texels high, the tallest in the back."""
    for length in np.sort(rng.uniform(low, high, count))[::-1]:
        place = SIDE / 2 + 6.0 * float(np.clip(rng.normal(), -1.8, 1.8))
        lean = (place - SIDE / 2) * 0.03 + rng.normal(0, 0.16)
        path = curve((place, FOOT), UP + 0.5 * lean, length, 1.6 * lean, 9)
        tone = 0.38 + 0.30 * (high - length) / (high - low) + rng.normal(0, 0.06)
        tones = tone + np.linspace(-0.24, 0.24, 9)
        canvas.stroke(path, blade_widths(half, 9), GRASS, tones, 0.06)


def tall_grass(canvas: Canvas, rng: np.random.Generator) -> None:
    """Paint a tuft of tall grass."""
    grass_blades(canvas, rng, 26, 24.0, 58.0, 2.0)


def fern(canvas: Canvas, rng: np.random.Generator) -> None:
    """Paint seven fronds that arch out of one foot."""
    for k in (0, 6, 1, 5, 2, 4, 3):
        lean = (k - 3) / 3
        length = 53.0 - 23.0 * abs(lean) + rng.normal(0, 1.5)
        path = curve((SIDE / 2 + 2.0 * lean, FOOT), UP + 0.50 * lean, length, 1.0 * lean + 0.1, 20)
        tone = 0.36 + 0.24 * (1 - abs(lean))
        for j in range(2, 19):
            along = np.arctan2(*(path[j + 1] - path[j])[::-1])
            size = 8.5 * np.sin(np.pi * (j / 19) ** 0.75) + 1.0
            for side in (-1, 1):
                leaf = curve(path[j], along + side * 1.05, size, -0.5 * side, 7)
                tones = (
                    tone
                    + 0.07 * side * -np.cos(along)
                    + (-0.14, 0.08)[j % 2]
                    + np.linspace(-0.08, 0.1, 7)
                )
                canvas.stroke(leaf, leaf_widths(1.15, 7), FERN, tones)

        canvas.stroke(path, np.linspace(0.9, 0.4, 20), FERN, np.full(20, tone + 0.18))


def stems(
    canvas: Canvas, rng: np.random.Generator, tips: tuple[tuple[float, float], ...], half: float
) -> None:
    """Paint bent stems from the foot to their tips (x, y), with a leaf at each."""
    for x, y in tips:
        t = np.linspace(0.0, 1.0, 9)
        foot = SIDE / 2 + 0.3 * (x - SIDE / 2)
        path = np.stack([foot + (x - foot) * t**1.7, FOOT + (y - FOOT) * t], axis=-1)
        canvas.stroke(path, np.full(9, half), STEM, np.linspace(0.25, 0.7, 9), 0.15)
        side = 1 if x > SIDE / 2 else -1
        leaf = curve(path[3], UP + 0.9 * side, rng.uniform(10, 14), 0.6 * side, 9)
        canvas.stroke(leaf, leaf_widths(2.0), STEM, np.linspace(0.35, 0.75, 9), 0.1)


def poppy(canvas: Canvas, rng: np.random.Generator) -> None:
    """Paint three poppies: cups of four petals with a dark heart."""
    grass_blades(canvas, rng, 9, 12.0, 24.0, 1.7)
    tips = ((18.0, 26.0), (46.0, 30.0), (33.0, 13.0))
    stems(canvas, rng, tips, 0.85)
    for (x, y), size in zip(tips, (8.2, 7.4, 9.4), strict=True):
        at = np.array([x, y])
        canvas.blob(at + [0, -0.22 * size], (size, 0.72 * size), 0.0, RED, 0.30, 0.2, 0.06)
        for side in (-1, 1):
            petal = at + np.array([0.46 * side * size, 0.10 * size])
            canvas.blob(petal, (0.66 * size, 0.56 * size), 0.5 * side, RED, 0.56, 0.3, 0.06)
        canvas.blob(at + [0, 0.30 * size], (0.62 * size, 0.46 * size), 0.0, RED, 0.72, 0.3, 0.06)
        canvas.blob(at + [0, -0.12 * size], (0.34 * size, 0.22 * size), 0.0, DARK, 0.15, 0.3)
        canvas.blob(at + [0, -0.15 * size], (0.13 * size, 0.10 * size), 0.0, YELLOW, 0.4, 0.0)


def buttercup(canvas: Canvas, rng: np.random.Generator) -> None:
    """Paint five buttercups of five round petals."""
    grass_blades(canvas, rng, 10, 12.0, 26.0, 1.7)
    tips = ((14.0, 32.0), (50.0, 28.0), (25.0, 17.0), (40.0, 14.0), (33.0, 31.0))
    stems(canvas, rng, tips, 0.7)
    for x, y in tips:
        turn = rng.uniform(0, 2 * np.pi)
        for k in range(5):
            angle = turn + 2 * np.pi * k / 5
            petal = np.array([x + 3.3 * np.cos(angle), y + 2.7 * np.sin(angle)])
            canvas.blob(petal, (3.0, 2.5), angle, YELLOW, 0.62 - 0.12 * np.sin(angle), 0.3, 0.04)
        canvas.blob(np.array([x, y]), (1.7, 1.5), 0.0, YELLOW, 0.12, -0.25, 0.0)


def cornflower(canvas: Canvas, rng: np.random.Generator) -> None:
    """Paint four cornflowers: ragged florets around a violet heart, over a green cup."""
    grass_blades(canvas, rng, 9, 12.0, 26.0, 1.6)
    tips = ((16.0, 27.0), (48.0, 24.0), (31.0, 14.0), (38.0, 38.0))
    stems(canvas, rng, tips, 0.75)
    for x, y in tips:
        canvas.blob(np.array([x, y + 2.4]), (2.1, 3.0), 0.0, STEM, 0.45, 0.4, 0.0)
        for ring, long in ((0, 8.6), (1, 6.2)):
            for k in range(9):
                angle = 2 * np.pi * (k + 0.5 * ring) / 9 + rng.normal(0, 0.08)
                flat = np.array([np.cos(angle), 0.8 * np.sin(angle)])
                path = np.array([x, y]) + np.linspace(0.0, long, 5)[:, None] * flat
                tone = 0.34 + 0.24 * ring - 0.12 * np.sin(angle)
                widths = np.array([0.3, 0.7, 1.3, 1.6, 0.7])
                canvas.stroke(path, widths, BLUE, tone + np.linspace(-0.15, 0.2, 5), 0.08)
        canvas.blob(np.array([x, y]), (2.1, 1.8), 0.0, PINK, 0.25, 0.3, 0.1)


def heather(canvas: Canvas, rng: np.random.Generator) -> None:
    """Paint a cushion of heather: woody shoots with bells to their tips."""
    lean_of = rng.permutation(np.linspace(-1.0, 1.0, 19))
    for k, length in enumerate(np.linspace(46.0, 20.0, 19)):
        lean = lean_of[k]
        start = (SIDE / 2 + 11.0 * lean, FOOT)
        path = curve(start, UP + 0.3 * lean, length, 0.35 * lean, 11)
        canvas.stroke(path, np.linspace(1.0, 0.6, 11), HEATH, np.linspace(0.1, 0.6, 11), 0.1)
        for j in range(1, 7):
            for side in (-1, 1):
                leaf = curve(path[j], UP + 0.8 * side, 4.5, 0.0, 5)
                canvas.stroke(leaf, leaf_widths(0.9, 5), HEATH, np.full(5, rng.uniform(0.3, 0.9)))
        near = (46.0 - length) / 24.0
        for j in range(5, 11):
            for side in (-1, 1, 0):
                place = path[j] + [side * (2.5 - 0.15 * j), rng.normal(0.4, 0.5)]
                tone = 0.22 + 0.26 * near - 0.16 * side + 0.035 * (j - 5) + rng.normal(0, 0.08)
                canvas.blob(place, (1.3, 1.6), 0.0, PINK, tone, 0.35, 0.05)


def daisy(canvas: Canvas, rng: np.random.Generator) -> None:
    """Paint a clump of daisies, low over their leaves."""
    grass_blades(canvas, rng, 12, 8.0, 18.0, 1.8)
    tips = ((12.0, 44.0), (24.0, 36.0), (38.0, 40.0), (52.0, 46.0), (31.0, 50.0))
    stems(canvas, rng, tips, 0.7)
    for x, y in tips:
        for k in range(9):
            angle = 2 * np.pi * k / 9
            petal = np.array([x + 3.6 * np.cos(angle), y + 3.0 * np.sin(angle)])
            canvas.blob(petal, (2.4, 1.4), angle, WHITE, 0.7 - 0.2 * np.sin(angle), 0.2, 0.0)
        canvas.blob(np.array([x, y]), (2.0, 1.8), 0.0, YELLOW, 0.55, 0.3, 0.0)


def reed(canvas: Canvas, rng: np.random.Generator) -> None:
    """Paint reeds: high narrow leaves and brown heads."""
    for length in np.linspace(60.0, 34.0, 13):
        place = SIDE / 2 + 8.0 * float(np.clip(rng.normal(), -1.5, 1.5))
        lean = (place - SIDE / 2) * 0.008 + rng.normal(0, 0.04)
        path = curve((place, FOOT), UP + lean, length, lean, 9)
        tones = rng.uniform(0.3, 0.6) + np.linspace(-0.2, 0.2, 9)
        canvas.stroke(path, blade_widths(1.7, 9), FERN, tones, 0.06)
    for x, top in ((24.0, 12.0), (35.0, 6.0), (44.0, 18.0)):
        path = np.array([[0.6 * x + 13.0, FOOT], [x, top + 14.0], [x, top]])
        canvas.stroke(path[:2], np.full(2, 0.9), STEM, np.full(2, 0.5))
        canvas.stroke(path[1:], np.full(2, 2.2), BROWN, np.full(2, 0.6), 0.3)


def bush(canvas: Canvas, rng: np.random.Generator) -> None:
    """Paint a low bush: twigs with round leaves."""
    for lean in rng.permutation(np.linspace(-1.0, 1.0, 9)):
        length = 46.0 - 16.0 * abs(lean) + rng.normal(0, 2.0)
        path = curve((SIDE / 2 + 4.0 * lean, FOOT), UP + 0.5 * lean, length, 0.4 * lean, 11)
        canvas.stroke(path, np.linspace(1.2, 0.6, 11), BROWN, np.linspace(0.1, 0.4, 11))
        for j in range(3, 11):
            for side in (-1, 1):
                place = path[j] + [3.6 * side, rng.normal(0, 1.0)]
                tone = 0.25 + 0.05 * j - 0.1 * side + rng.normal(0, 0.08)
                canvas.blob(place, (3.4, 2.6), 0.6 * side, GRASS, tone, 0.3, 0.05)


def spruce_tip(canvas: Canvas, rng: np.random.Generator) -> None:
    """Paint the pointed top of a spruce, pale: blocks tint it."""
    for y in range(60, 8, -4):
        reach = 3.0 + 0.36 * y
        for side in (-1, 1):
            lean = np.pi / 2 + side * rng.uniform(0.8, 1.1)
            path = curve((SIDE / 2, y - 6.0), lean, reach, 0.3 * side, 7)
            tones = 0.35 - 0.1 * side + np.linspace(-0.1, 0.3, 7)
            canvas.stroke(path, blade_widths(3.0, 7, 0.5), NEEDLE, tones, 0.08)
    path = np.array([[SIDE / 2, FOOT], [SIDE / 2, 6.0]])
    canvas.stroke(path, np.array([2.0, 0.9]), NEEDLE, np.array([0.2, 0.8]), 0.1)


PAINTERS: dict[str, Callable[[Canvas, np.random.Generator], None]] = {
    "tall_grass": tall_grass,
    "fern": fern,
    "poppy": poppy,
    "buttercup": buttercup,
    "cornflower": cornflower,
    "heather": heather,
    "daisy": daisy,
    "reed": reed,
    "bush": bush,
    "spruce_tip": spruce_tip,
}


def picture(name: str) -> np.ndarray:
    """Return a plant, uint8 (TEXELS, TEXELS, 4), with colour in transparent texels, too."""
    canvas = Canvas(wrap_x=False, wrap_y=False)
    PAINTERS[name](canvas, np.random.default_rng(300 + PLANT_TILES.index(name)))
    alpha = canvas.alpha[..., None]
    small = shrink(np.concatenate([canvas.colour * alpha, alpha], axis=2), OVER * SIDE // TEXELS)
    colour = small[..., :3] / np.maximum(small[..., 3:], 1e-6)
    crisp = np.where(small[..., 3:] > LEAST, 1.0, 0.0)
    # Even steps of colour make a smaller file.
    colour = np.round(colour * 51.0) / 51.0
    return bleed(to_uint8(np.concatenate([colour, crisp], axis=2)))


def voxel_plants() -> np.ndarray:
    """Return the strip, uint8 (TEXELS, TEXELS * n, 4), in the order of the n PLANT_TILES."""
    return np.concatenate([picture(name) for name in PLANT_TILES], axis=1)


ASSETS: dict[str, Callable[[], np.ndarray]] = {PLANTS_FILE: voxel_plants}
