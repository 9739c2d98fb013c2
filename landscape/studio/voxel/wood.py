"""The tiles of trees: barks, the end of a log, leaves and needles."""

import numpy as np

from landscape.studio.images import smoothstep
from landscape.studio.voxel.paint import (
    Canvas,
    axes,
    blade_widths,
    cells,
    curve,
    leaf_widths,
    levelled,
    noise,
    ramp,
    smeared,
    spread,
    stepped,
)

# All chosen: ramps of colour, dark to light. Blocks tint all of these but the birch's bark.
BARK = ((112, 92, 84), (166, 144, 126), (206, 188, 166), (232, 218, 196), (248, 240, 222))
BIRCH = ((64, 58, 62), (148, 138, 136), (222, 214, 204), (240, 235, 224), (252, 250, 242))
WOOD = ((126, 96, 78), (178, 142, 104), (214, 182, 136), (234, 208, 164), (248, 230, 194))
LEAF = ((84, 94, 112), (136, 146, 154), (186, 194, 190), (226, 230, 216), (252, 252, 236))


def bark() -> np.ndarray:
    """Return bark: upright plates with rounded edges and dark furrows."""
    rng = np.random.default_rng(111)
    points = spread(17, 112, 3.0)
    found = cells(points, 0.55, 113, 3.0)
    value = 0.62 + rng.normal(0, 0.06, len(points))[found.own] + 0.20 * found.light(3.6)
    value = stepped(value + 0.05 * smeared(noise(1.0, 114, 6.0), 49, 0), 11, 0.3)
    value = value - 0.44 * smoothstep(1.5, 0.3, found.inside(0.5))
    return levelled(ramp(BARK, value), 2.5, 0.15)


def birch_bark() -> np.ndarray:
    """Return birch bark: cream, with bands that peel and dark marks that lie across."""
    rng = np.random.default_rng(121)
    bands = smeared(noise(2.0, 122, 2.0), 87, 1)
    canvas = Canvas(ramp(BIRCH, stepped(0.76 + 0.06 * bands, 12, 0.3)))
    for place in spread(34, 123):
        long = rng.uniform(1.2, 7.5)
        path = np.array([place - [long, 0], place, place + [long, rng.normal(0, 0.4)]])
        dark = rng.choice([0.08, 0.3, 0.5], p=[0.4, 0.3, 0.3])
        canvas.stroke(path + [0.0, 0.9], np.array([0.1, 0.8, 0.1]), BIRCH, np.full(3, 0.98))
        canvas.stroke(path, np.array([0.15, rng.uniform(0.6, 1.1), 0.15]), BIRCH, np.full(3, dark))

    for place in spread(3, 127):
        size = rng.uniform(3.0, 6.0)
        for k in range(5):
            long = size * (1.0 - 0.18 * k)
            path = np.array(
                [
                    place + [-long, 1.3 * k - 1.2],
                    place + [0, 1.1 * k - 2.2],
                    place + [long * 0.9, 1.3 * k - 1.0],
                ]
            )
            canvas.stroke(path, np.array([0.2, 1.0, 0.2]), BIRCH, np.full(3, 0.02 + 0.03 * k))

    return levelled(canvas.colour, 2.5, 0.3)


def log_top() -> np.ndarray:
    """Return the end of a log: rings, cracks, and the bark around."""
    x, y = axes()
    u, v = x - 31.0, y - 33.0
    square = (np.abs(u) ** 4 + np.abs(v) ** 4) ** 0.25  # rings that fill a square block
    radius = 0.45 * np.hypot(u, v) + 0.55 * square + 0.5 * noise(2.2, 132, 1.0)
    ring = 0.5 + 0.5 * np.cos(2 * np.pi * radius / 4.6)
    value = 0.70 - 0.20 * ring**2.5 + 0.03 * np.sin(radius * 0.43 + 1.0)
    value = value - 0.25 * smoothstep(3.5, 1.5, radius)
    angle = np.arctan2(v, u) + 0.05 * noise(2.0, 133, 1.0)
    for place, start, end in ((0.4, 5.0, 24.0), (2.3, 8.0, 26.0), (4.1, 3.0, 18.0), (5.3, 14, 27)):
        off = np.abs((angle - place + np.pi) % (2 * np.pi) - np.pi) * radius
        long = smoothstep(start, start + 4, radius) * smoothstep(end, end - 3, radius)
        value = value - 0.35 * long * smoothstep(1.0, 0.3, off)

    wood = ramp(WOOD, stepped(value, 14, 0.35))
    rim = np.maximum(np.abs(x - 32), np.abs(y - 32)) + 0.5 * noise(1.6, 134, 2.0)
    plates = np.cos(np.arctan2(y - 32, x - 32) * 26 + 0.8 * noise(1.8, 135, 2.0))
    skin = ramp(BARK, stepped(0.42 + 0.10 * plates - 0.10 * (x + y - 64) / 64, 10, 0.3))
    on = smoothstep(27.3, 27.8, rim)[..., None]
    dark = 1.0 - 0.35 * smoothstep(1.6, 0.2, np.abs(rim - 27.3))[..., None]
    return np.asarray((wood * (1.0 - on) + skin * on) * dark)


def leaves() -> np.ndarray:
    """Return rosettes of leaves, in three layers, with holes between them."""
    rng = np.random.default_rng(141)
    canvas = Canvas()
    for count, tone, long in ((5, 0.34, 12.0), (8, 0.58, 11.5), (8, 0.84, 10.5)):
        for place in spread(count, int(rng.integers(1000))):
            turn, lift = rng.uniform(0, 2 * np.pi), rng.normal(0, 0.03)
            for k in rng.permutation(5):
                angle = turn + 2 * np.pi * k / 5 + rng.normal(0, 0.18)
                start = place + 0.8 * np.array([np.cos(angle), np.sin(angle)])
                path = curve(start, angle, long * rng.uniform(0.75, 1.0), rng.normal(0, 0.3), 9)
                half = rng.uniform(2.7, 3.4)
                under = np.full(9, tone - 0.26)
                canvas.stroke(path + [0.5, 0.9], leaf_widths(half), LEAF, under)
                tones = tone + lift + np.linspace(-0.13, 0.10, 9) + rng.normal(0, 0.025)
                canvas.stroke(path, leaf_widths(half), LEAF, tones, 0.07)
    return with_holes(canvas, 142)


def needles() -> np.ndarray:
    """Return sprays of needles that hang and spread like brushes, in three layers, with holes."""
    rng = np.random.default_rng(151)
    canvas = Canvas()
    for count, tone in ((26, 0.34), (24, 0.58), (19, 0.84)):
        for place in spread(count, int(rng.integers(1000))):
            down = np.pi / 2 + rng.normal(0, 0.3)
            for aside in (-1.15, 1.15, -0.75, 0.75, -0.38, 0.38, 0.0):
                long = rng.uniform(9.0, 11.5) * (1.0 - 0.18 * abs(aside))
                path = curve(place - [0, 4], down + aside, long, -0.45 * aside, 6)
                lit = tone + 0.06 * np.sign(aside) + np.linspace(-0.20, 0.14, 6)
                canvas.stroke(path, blade_widths(1.25, 6, 0.5), LEAF, lit, 0.04)
    return with_holes(canvas, 152)


def with_holes(canvas: Canvas, seed: int) -> np.ndarray:
    """Return a tile of leaves (h, w, 4): where none is painted, dark leaves farther inside.

    From nearby these are holes that one looks through; from afar they are drawn.
    """
    alpha = canvas.alpha[..., None]
    inside = ramp(LEAF, 0.14 + 0.02 * noise(1.6, seed))
    colour = levelled(canvas.colour * alpha + inside * (1.0 - alpha), broad=1.2)
    return np.concatenate([colour, alpha], axis=2)
