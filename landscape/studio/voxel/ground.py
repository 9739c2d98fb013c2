"""The tiles of the ground: grass, earth, rock, sand, gravel and snow."""

import numpy as np

from landscape.studio.images import smoothstep
from landscape.studio.voxel.paint import (
    SIDE,
    TO_LIGHT,
    Canvas,
    axes,
    blade_widths,
    cells,
    curve,
    levelled,
    noise,
    ramp,
    spread,
    stepped,
)

# All chosen: ramps of colour, dark to light.
GRASS = ((52, 96, 44), (94, 136, 48), (132, 170, 56), (168, 196, 68), (208, 222, 100))
EARTH = ((90, 62, 50), (126, 89, 65), (158, 117, 82), (186, 147, 106), (214, 179, 136))
TRODDEN = ((120, 92, 70), (160, 128, 94), (190, 158, 118), (212, 184, 142), (230, 206, 166))
PEBBLE = ((104, 90, 88), (158, 142, 128), (206, 190, 166))
ROCK = ((82, 82, 90), (122, 120, 120), (158, 154, 146), (192, 185, 170), (224, 216, 196))
SAND = ((190, 152, 104), (216, 184, 130), (234, 208, 154), (246, 228, 180), (254, 244, 210))
SNOW = ((170, 190, 222), (206, 220, 240), (232, 239, 249), (248, 251, 254), (255, 255, 255))
STONES = (
    ((86, 94, 110), (148, 154, 160), (204, 206, 200)),
    ((104, 92, 86), (172, 156, 136), (222, 208, 182)),
    ((98, 90, 98), (158, 144, 144), (210, 198, 188)),
    ((116, 106, 96), (192, 180, 156), (236, 226, 202)),
)

STONE_SLOPE = 1.6  # chosen: how steep the stones of the gravel look


def grass_top() -> np.ndarray:
    """Return tufts of grass from above: three layers, and a few light blades on top."""
    rng = np.random.default_rng(11)
    canvas = Canvas(ramp(GRASS, 0.30 + 0.03 * noise(1.4, 12)))
    for count, tone, long in ((70, 0.34, 9.0), (60, 0.46, 8.5), (44, 0.58, 8.0)):
        for place in spread(count, int(rng.integers(1000))):
            middle = rng.uniform(0, 2 * np.pi)
            for aside in rng.uniform(-0.15, 0.15, 3) + (-0.7, 0.7, 0.0):
                path = curve(place, middle + aside, long * rng.uniform(0.7, 1.1), 0.5 * aside)
                tones = tone + rng.normal(0.0, 0.03) + np.linspace(-0.10, 0.10, 7)
                canvas.stroke(path, blade_widths(1.5), GRASS, tones, 0.035)
    for place in spread(22, 13):
        path = curve(place, rng.uniform(0, 2 * np.pi), rng.uniform(6, 9), rng.normal(0, 0.5))
        canvas.stroke(path, blade_widths(1.25), GRASS, np.linspace(0.6, 0.95, 7), 0.03)
    return levelled(canvas.colour, broad=1.7)


def earth() -> np.ndarray:
    """Return earth: soft lumps and a few pebbles."""
    rng = np.random.default_rng(21)
    canvas = Canvas(ramp(EARTH, 0.34 + 0.02 * noise(1.2, 22)))
    for count, size, tone in ((46, 6.2, 0.40), (40, 4.6, 0.50), (34, 2.8, 0.58)):
        for place in spread(count, int(rng.integers(1000))):
            radii = size * rng.uniform(0.75, 1.15), size * rng.uniform(0.55, 0.8)
            value = tone + rng.normal(0, 0.04)
            seed = int(rng.integers(1000))
            turn = rng.normal(0, 0.5)
            canvas.blob(place + 0.7, radii, turn, EARTH, value - 0.22, 0.0, seed=seed)
            canvas.blob(place, radii, turn, EARTH, value, 0.14, seed=seed)
    for place in spread(6, 23):
        radii = rng.uniform(2.0, 3.2), rng.uniform(1.6, 2.2)
        canvas.blob(place + 0.8, radii, 0.2, EARTH, 0.1, 0.0)
        canvas.blob(place, radii, 0.2, PEBBLE, 0.58, 0.3)
    return levelled(canvas.colour)


def rock() -> np.ndarray:
    """Return rock: large blocks cut by cracks, each with a few plane facets."""
    rng = np.random.default_rng(31)
    facets = spread(30, 32, 0.8)
    blocks = spread(7, 33, 0.7)
    apart = facets[:, None] - blocks[None]
    apart -= np.round(apart / SIDE) * SIDE
    block = np.hypot(apart[..., 0], 1.3 * apart[..., 1]).argmin(axis=1)
    found = cells(facets, 0.9, 34)
    lean = rng.normal(0.0, 0.014, (len(facets), 2))
    tone = rng.normal(0.0, 0.075, len(facets)) + rng.normal(0.0, 0.05, len(blocks))[block]
    value = 0.56 + tone[found.own] + (lean[found.own] * found.offset).sum(axis=-1)

    # Ridges between facets of one block catch the light; between blocks there are cracks.
    value = value + 0.10 * found.light(2.2)
    cracked = found._replace(
        gap=np.where(block[found.others] == block[found.own][..., None], 99.0, found.gap)
    )
    value = stepped(value, 14) + 0.17 * cracked.light(3.4)
    value = value - 0.42 * smoothstep(1.15, 0.35, cracked.inside())
    value = value + 0.012 * noise(0.8, 35, 8.0)
    return levelled(ramp(ROCK, value), 2.5, 0.25, broad=1.1)


def sand() -> np.ndarray:
    """Return sand with ripples that fork, and a few coarse grains."""
    rng = np.random.default_rng(41)
    x, y = axes()
    phase = 2 * np.pi * (4 * y + x) / SIDE + 0.85 * noise(2.2, 42, 1.0)
    wave = np.sin(phase + 0.55 * np.sin(phase))
    strength = smoothstep(-1.4, 0.6, noise(2.0, 43, 1.5))
    canvas = Canvas(
        ramp(
            SAND,
            stepped(0.54 + 0.15 * wave * (0.45 + 0.55 * strength), 16, 0.4)
            + 0.008 * noise(0.7, 44, 10.0),
        )
    )
    for place in spread(34, 45):
        canvas.blob(place, (0.75, 0.65), 0.0, SAND, rng.choice([0.16, 0.92]), 0.0)
    return levelled(canvas.colour, 2.5, 0.2)


def gravel() -> np.ndarray:
    """Return rounded stones of four tints with dark gaps between."""
    rng = np.random.default_rng(51)
    found = cells(spread(27, 52, 0.85), 0.5, 53)
    inside = found.inside(1.3) - 0.35
    dome = np.sqrt(np.clip(1.0 - (1.0 - np.clip(inside / 5.0, 0.0, 1.0)) ** 2, 0.0, 1.0))
    down, right = (np.roll(dome, -1, axis) - np.roll(dome, 1, axis) for axis in (0, 1))
    light = -(right * TO_LIGHT[0] + down * TO_LIGHT[1]) * STONE_SLOPE
    value = 0.52 + rng.normal(0, 0.06, 27)[found.own] + np.clip(light, -0.3, 0.3) + 0.06 * dome
    kind = rng.permutation(np.arange(27) % len(STONES))[found.own]
    colour = np.zeros((*inside.shape, 3))
    for number, colours in enumerate(STONES):
        colour += (kind == number)[..., None] * ramp(colours, stepped(value, 11, 0.3))
    gap = smoothstep(0.35, -0.25, inside)[..., None]
    return levelled(colour * (1.0 - gap) + gap * np.array([88, 86, 94]) / 255.0, 2.5, 0.2)


def snow() -> np.ndarray:
    """Return snow: soft hollows in pale blue, and a few glints."""
    drift = noise(2.4, 61, 2.5)
    down, right = (np.roll(drift, -2, axis) - np.roll(drift, 2, axis) for axis in (0, 1))
    slope = right * TO_LIGHT[0] + down * TO_LIGHT[1]
    canvas = Canvas(ramp(SNOW, stepped(0.66 - 0.10 * slope / slope.std(), 9, 0.45)))
    for place in spread(12, 62):
        canvas.blob(place, (0.8, 0.8), 0.0, SNOW, 1.0, 0.0)
    return levelled(canvas.colour, 3.5, 0.2)


def grass_side() -> np.ndarray:
    """Return earth with grass hanging over it: rows of blades, the upper over the lower."""
    rng = np.random.default_rng(76)
    canvas = Canvas(shaded(earth(), 17.0, 9.0, noise(1.8, 72, 2.0)[0]), wrap_y=False)
    for row, (top, long, tone) in enumerate(
        ((11, 12, 0.20), (7, 12, 0.34), (3, 11, 0.46), (-1, 10, 0.58), (-5, 9, 0.72))
    ):
        count = 15
        for k in rng.permutation(count):
            x = (k + 0.5 * (row % 2) + rng.uniform(-0.3, 0.3)) * SIDE / count
            length = long * (0.72 + 0.5 * rng.random())
            path = curve((x, top), np.pi / 2 + rng.normal(0, 0.16), length, rng.normal(0, 0.3))
            tones = tone + rng.normal(0, 0.035) + np.linspace(-0.06, 0.07, 7)
            canvas.stroke(path, blade_widths(3.0, belly=0.45), GRASS, tones, 0.04)
    return canvas.colour


def turf_side() -> np.ndarray:
    """Return the side of a low step, overgrown to its foot: grass that hangs down in layers."""
    rng = np.random.default_rng(73)
    canvas = Canvas(ramp(GRASS, 0.10 + 0.02 * noise(1.4, 74)), wrap_y=False)
    for top, long, tone in (
        (48, 22, 0.20),
        (38, 22, 0.26),
        (28, 21, 0.33),
        (19, 19, 0.38),
        (11, 17, 0.46),
        (4, 15, 0.58),
        (-5, 13, 0.76),
    ):
        count = 13
        for k in rng.permutation(count):
            x = (k + rng.uniform(-0.4, 0.4)) * SIDE / count
            length = long * (0.65 + 0.6 * rng.random())
            path = curve((x, top), np.pi / 2 + rng.normal(0, 0.2), length, rng.normal(0, 0.35))
            tones = tone + rng.normal(0, 0.05) + np.linspace(-0.04, 0.08, 7)
            canvas.stroke(path, blade_widths(3.0, belly=0.45), GRASS, tones, 0.05)

    return canvas.colour


def path() -> np.ndarray:
    """Return trodden earth: fine and pale, with small stones and a few blades of grass."""
    rng = np.random.default_rng(91)
    canvas = Canvas(ramp(TRODDEN, 0.52 + 0.05 * noise(1.0, 92, 4.0)))
    for count, size, tone in ((44, 4.0, 0.46), (40, 3.0, 0.60)):
        for place in spread(count, int(rng.integers(1000))):
            radii = size * rng.uniform(0.7, 1.2), size * rng.uniform(0.5, 0.8)
            value, turn = tone + rng.normal(0, 0.05), rng.normal(0, 0.6)
            canvas.blob(place, radii, turn, TRODDEN, value, 0.08, seed=int(rng.integers(1000)))
    for place in spread(9, 93):
        radii = rng.uniform(1.8, 3.2), rng.uniform(1.5, 2.2)
        canvas.blob(place + 0.9, radii, 0.2, TRODDEN, 0.05, 0.0)
        canvas.blob(place, radii, 0.2, PEBBLE, 0.62, 0.3)
    for place in spread(4, 94):
        for turn in rng.uniform(0, 2 * np.pi, 3):
            blade = curve(place, turn, rng.uniform(4.0, 7.0))
            canvas.stroke(blade, blade_widths(1.2), GRASS, np.linspace(0.3, 0.6, 7), 0.03)
    return levelled(canvas.colour)


def shaded(colour: np.ndarray, edge: float, over: float, uneven: np.ndarray) -> np.ndarray:
    """Return a tile (h, w, 3) in shadow above the height ``edge`` (units), less over ``over``.

    ``uneven`` (w,) moves the edge by a unit or two.
    """
    _, y = axes()
    dark = smoothstep(edge + over, edge, y + 1.5 * uneven[None, :])[..., None]
    return np.asarray(colour * (1.0 - dark * np.array([0.42, 0.42, 0.32])))


def snow_side() -> np.ndarray:
    """Return earth with snow hanging over it in rounded lobes."""
    x, y = axes()
    edge = _hanging_snow(x)
    ground = shaded(earth(), 15.0, 7.0, (14.0 - edge[0]) / 1.5)
    depth = edge - y
    tone = 0.78 - 0.5 * smoothstep(5.0, 0.0, depth) - 0.08 * smoothstep(10.0, 4.0, depth)
    tone = tone + 0.14 * smoothstep(4.0, 0.0, y) + 0.03 * noise(2.2, 82, 3.0)
    cover = np.clip(depth * 2.0 + 0.5, 0.0, 1.0)[..., None]
    return np.asarray(ground * (1.0 - cover) + ramp(SNOW, stepped(tone, 10, 0.35)) * cover)


def _hanging_snow(x: np.ndarray) -> np.ndarray:
    """Return how far down the snow hangs, (1, n), at the columns of x."""
    rng = np.random.default_rng(81)
    lobes = 7
    middle = (np.arange(lobes) + rng.uniform(-0.2, 0.2, lobes)) * SIDE / lobes
    half = SIDE / lobes * rng.uniform(0.62, 0.95, lobes)
    drop = rng.permutation(np.linspace(11.0, 22.0, lobes))
    aside = x[0][:, None] - middle
    aside = (aside - np.round(aside / SIDE) * SIDE) / half
    hang = drop * np.sqrt(np.clip(1.0 - aside**2, 0.0, 1.0)) ** 0.6
    return np.maximum(hang.max(axis=1), 10.0)[None, :]
