"""The pictures of the sward: sheaves of fine blades, seed heads, dry stalks and single flowers.

One small cell for each; ``landscape/elements/best/meadow/sward.py`` says which grows where. Blades
and stems are ribbons folded along the midrib, petals and leaves are kites. Cell space: x right in
-0.5..0.5, y up in 0..2, z towards the viewer. The shape of a card leaves the upper corners of a
cell out, so blades stay inside :func:`reach`.
"""

from collections.abc import Callable

import numpy as np

from landscape.studio.images import bleed
from landscape.studio.plants.blossoms import (
    LEAF,
    STEM,
    Head,
    buttercup,
    clover,
    cornflower,
    hawkbit,
    knapweed,
    oxeye,
    umbel,
)
from landscape.studio.plants.clumps import UP, VIEWER, along, kites, quantised, whorl
from landscape.studio.plants.foliage import (
    SUPERSAMPLING,
    Canvas,
    Leaves,
    draw_leaves,
    fill_triangles,
    foliage_density,
    join,
    unit,
)
from landscape.studio.plants.plants import midrib

WIDTH, HEIGHT = 128, 256  # texels of a cell
HEADROOM = 0.93  # chosen: so much of a cell is used; the rest keeps coarse mip levels apart
SHOULDER, NECK = 1.24, 0.17  # chosen: where a card is widest, and half its width at the ground
# Linear colours, all chosen by eye. Green blades are tinted to the ground's colour when drawn.
ROOT, GREEN, TIP = np.array([(0.060, 0.075, 0.022), (0.120, 0.190, 0.040), (0.235, 0.285, 0.080)])
STRAW = np.array([0.420, 0.350, 0.180])
SEEDS, PURPLISH = np.array([0.360, 0.290, 0.165]), np.array([0.265, 0.190, 0.150])
FACE = unit(0.62 * UP + VIEWER)  # chosen: how an open flower faces, up to the sun and the eye


class Cell(Canvas):
    """A canvas of one cell, half as wide as high."""

    @classmethod
    def blank(cls, size: int = HEIGHT) -> "Cell":
        shape = size * SUPERSAMPLING, size * SUPERSAMPLING // 2
        return cls(np.zeros((*shape, 3), np.float32), np.full(shape, -1e9, np.float32))

    def to_screen(self, points: np.ndarray) -> np.ndarray:
        """Transform points (..., 3) from cell space to samples: column, row, depth."""
        return super().to_screen(points * (1.0, HEADROOM, 1.0) - np.array([0.5, 0.0, 0.0]))


def reach(y: np.ndarray) -> np.ndarray:
    """Return half the width of a card at heights y in 0..2."""
    low = NECK + (0.48 - NECK) * y / SHOULDER
    return np.where(y < SHOULDER, low, 0.48 * (2.0 - y) / (2.0 - SHOULDER))


def curve(x: float, length: float, lean: float, bend: float, azimuth: float = 0.0) -> np.ndarray:
    """Return points (24, 3) of a blade or stem from (x, 0, 0), kept inside the card.

    Angles in radians: ``lean`` at the foot, negative to the left, and ``bend`` to the tip.
    """
    path = midrib(length, lean, bend, azimuth, 24)
    path = np.concatenate([np.zeros((1, 3)), path[:-1]]) + np.array([x, 0.0, 0.0])
    path[:, 1] *= min(1.0, 1.9 / max(float(path[:, 1].max()), 1e-6))
    return path * np.array([min(1.0, 1.0 / (np.abs(path[:, 0]) / reach(path[:, 1])).max()), 1, 1])


def ribbon(
    canvas: Canvas, path: np.ndarray, width: np.ndarray, colours: np.ndarray, fold: float
) -> None:
    """Draw a ribbon along a path (m, 3), ``width`` (m,) wide, of linear colours (m, 3).

    ``fold`` is how much lighter its left half is than its right.
    """
    flat = unit(np.gradient(path, axis=0) * np.array([1.0, 1.0, 0.0]))
    side = np.stack([-flat[:, 1], flat[:, 0], 0 * width], 1) * width[:, None] / 2
    for way in (-1.0, 1.0):
        edge, shade = path - way * side, colours * (1.0 - way * fold)
        rib = shade * 0.86
        corners = [(path[:-1], edge[:-1], edge[1:]), (path[:-1], edge[1:], path[1:])]
        tones = [(rib[:-1], shade[:-1], shade[1:]), (rib[:-1], shade[1:], rib[1:])]
        for three, tone in zip(corners, tones, strict=True):
            screen = canvas.to_screen(np.stack(three, 1))
            fill_triangles(canvas.colour, canvas.depth, screen, np.stack(tone, 1))


def blade(
    canvas: Canvas,
    rng: np.random.Generator,
    path: np.ndarray,
    width: float,
    dry: float = 0.0,
    root: float = 0.42,
) -> None:
    """Draw a blade, widest in its lower third, ``dry`` 0 green to 1 straw.

    At its ``root`` it is so many times as light as above.
    """
    s = np.linspace(0.0, 1.0, len(path))[:, None]
    colour = ROOT + (GREEN - ROOT) * np.clip(s / 0.45, 0, 1)
    colour = colour + (TIP - colour) * np.clip((s - 0.35) / 0.75, 0, 1) ** 1.3
    colour += (STRAW * (0.35 + 0.65 * np.clip(path[:, 1:2] / 0.7, 0, 1)) - colour) * dry

    # The lower part of a sward is in the shade of all around it.
    dark = root + (1.0 - root) * np.clip(path[:, 1:2] / 0.9, 0, 1) ** 0.8
    colour = colour * dark * rng.uniform(0.72, 1.25) * (1.0 + rng.uniform(-0.08, 0.08, 3))
    profile = np.minimum(1.0, 0.55 + 1.8 * s[:, 0]) * np.minimum(1.0, 1.55 * (1 - s[:, 0])) ** 0.8
    ribbon(canvas, path, width * profile, colour, rng.uniform(-0.22, 0.22))


def sheaf(
    seed: int, count: int, width: float, tall: tuple[float, float], dry: float, bend: float
) -> np.ndarray:
    """Return a cell of ``count`` blades of about this ``width`` that hardly share a direction.

    Low ones are many and a few stand out; what is dead is mostly low, and the foot has no one root.
    """
    rng, canvas = np.random.default_rng(seed), Cell.blank()
    low, high = tall
    for k in rng.permutation(count):
        x = (k + 0.5) / count * 2 - 1
        straw = rng.uniform(0.5, 1.0) if rng.random() < dry else rng.uniform(0.0, 0.2)
        length = low + (high - low) * rng.random() ** (1.3 + straw)
        path = curve(
            (NECK - 0.02) * np.clip(x + rng.normal(0, 0.25), -1, 1),
            length * (1.0 - 0.2 * abs(x)),
            0.22 * x + rng.normal(0, 0.17),
            rng.uniform(0.15, 1.0) ** 1.5 * bend * rng.choice([-1, 1, np.sign(x)]),
        )
        path[:, 2] = rng.uniform(-0.3, 0.3)
        blade(canvas, rng, path, width * rng.uniform(0.55, 1.35), straw)
    return canvas.finish()


def litter() -> np.ndarray:
    """Return a cell of the sward's floor: a wide fringe of short blades, many of them dead.

    Its foot is ragged: blades begin at different heights, so that no straight edge shows.
    """
    rng, canvas = np.random.default_rng(405), Cell.blank()
    for k in range(74):
        low = rng.uniform(-0.2, 0.5) * rng.uniform(0, 1)
        x = rng.uniform(-1, 1) * (NECK + (0.44 - NECK) * max(low, 0) / SHOULDER) * 1.15
        length = rng.uniform(0.45, 1.75) * (1.0 - 0.5 * abs(x) / 0.3)
        path = curve(0.0, length, rng.normal(1.2 * x, 0.35), rng.normal(0, 0.9))
        path = path * np.array([0.75, 1.0, 1.0]) + np.array([x, low, -0.5 + k / 74])
        path[:, 0] = np.clip(path[:, 0], -0.47, 0.47)
        blade(canvas, rng, path, rng.uniform(0.016, 0.030), rng.choice([0.0, 0.1, 0.3, 0.9]), 0.8)
    return canvas.finish()


def stalk(
    canvas: Canvas, path: np.ndarray, width: float, colour: np.ndarray, foot: float = 0.45
) -> None:
    """Draw a stem along a path (m, 3), ``foot`` times as light at the ground."""
    light = foot + (1.0 - foot) * np.clip(path[:, 1:2] / 0.9, 0, 1)
    taper = np.linspace(1.15, 0.75, len(path))
    ribbon(canvas, path, width * taper, colour * light, 0.18)


def lit_leaves(canvas: Canvas, parts: list[Leaves]) -> None:
    """Light and draw kites."""
    leaves = join(parts)
    draw_leaves(canvas, leaves, foliage_density(leaves), 0.25, 0.25)


def panicles() -> np.ndarray:
    """Return a cell of meadow-grass: stems with loose, purplish panicles, and a few blades."""
    rng, canvas = np.random.default_rng(406), Cell.blank()
    parts = []
    for x, length, lean, bend in ((0.03, 1.86, 0.03, 0.35), (-0.10, 1.60, -0.10, -0.30)):
        path = curve(x, length, lean, bend)
        stalk(canvas, path, 0.021, STRAW * 0.75)
        top = np.linspace(0.66, 0.99, 26)
        at, way = along(path, top)
        out = whorl(way, np.arange(26) * 2.4 + rng.uniform(0, 6))
        out[:, 2] *= 0.4
        spread = 0.17 * np.sin(np.pi * np.clip((1.03 - top) / 0.42, 0, 1))
        for one, direction, far in zip(at, unit(out + 0.9 * way), spread, strict=True):
            twig = one + direction * np.linspace(0, far, 6)[:, None]
            twig[:, 0] = np.clip(twig[:, 0], -reach(twig[:, 1]), reach(twig[:, 1]))
            ribbon(canvas, twig, np.full(6, 0.011), np.tile(SEEDS * 0.8, (6, 1)), 0.0)
            seeds = twig[[2, 3, 4, 5, 5]] + rng.normal(0, 0.012, (5, 3))
            tone = (SEEDS + (PURPLISH - SEEDS) * rng.random((5, 1))) * rng.uniform(0.8, 1.2)
            tip = np.tile(direction, (5, 1)) + rng.normal(0, 0.3, (5, 3))
            parts.append(kites(seeds, tip, np.tile(VIEWER, (5, 1)), 0.055, 0.024, tone))

    for x, lean, bend in ((-0.16, -0.12, -0.9), (0.12, 0.15, 0.9), (0.02, -0.1, 0.5)):
        blade(canvas, rng, curve(x, rng.uniform(0.8, 1.2), lean, bend), 0.04, 0.1)
    lit_leaves(canvas, parts)
    return canvas.finish()


def spikes() -> np.ndarray:
    """Return a cell of foxtail and timothy: stems with dense, cylindrical heads."""
    rng, canvas = np.random.default_rng(407), Cell.blank()
    parts = []
    for x, length, bend in ((0.06, 1.82, 0.30), (-0.08, 1.62, -0.22), (0.14, 1.42, 0.42)):
        path = curve(x, length, 0.4 * x, bend)
        stalk(canvas, path, 0.020, (STEM + STRAW) * 0.55)
        n = 90
        s = rng.uniform(0.82, 1.0, n)
        at, way = along(path, s)
        out = whorl(way, rng.uniform(0, 6.3, n))
        at = at + out * 0.012
        thick = np.sqrt(np.sin(np.pi * np.clip((s - 0.80) / 0.22, 0, 1)))
        tone = (SEEDS + (STEM * 1.3 - SEEDS) * rng.uniform(0, 0.7)) * rng.uniform(0.75, 1.2, (n, 1))
        kernels = kites(at, way + 0.5 * out, VIEWER + 0.4 * out, 0.05 * thick + 0.01, 0.024, tone)
        parts.append(kernels)

    for x, lean, bend in ((-0.15, -0.2, -0.7), (0.17, 0.1, 1.0)):
        blade(canvas, rng, curve(x, rng.uniform(0.7, 1.1), lean, bend), 0.045, 0.2)
    lit_leaves(canvas, parts)
    return canvas.finish()


def straws() -> np.ndarray:
    """Return a cell of last year's stalks: bleached, leaning, some of them broken."""
    rng, canvas = np.random.default_rng(408), Cell.blank()
    for x, length, lean, bend, broken in (
        (-0.12, 1.70, -0.12, -0.30, 0.72),
        (0.04, 1.85, 0.06, 0.25, 0.0),
        (0.15, 1.30, 0.22, 0.15, 0.60),
        (-0.04, 1.20, -0.30, 0.25, 0.0),
        (0.10, 0.90, -0.35, -0.20, 0.0),
        (-0.18, 0.80, 0.35, 0.3, 0.5),
    ):
        path = curve(x, length, lean, bend)
        if broken:
            bent = int(broken * len(path))
            fall = np.linspace(0.0, 1.0, len(path) - bent)[:, None]
            way = np.array([np.sign(lean) * 0.30, -0.28, 0.0])
            path[bent:] = path[bent] + way * fall * length * (1.0 - broken) * 2.2
            limit = reach(path[:, 1])
            path[:, 0] = np.clip(path[:, 0], -limit, limit)
        stalk(canvas, path, rng.uniform(0.024, 0.034), STRAW * rng.uniform(0.8, 1.15), 0.40)

    return canvas.finish()


def flowers(
    seed: int,
    head: Head,
    size: float,
    stems: tuple[tuple[float, float, float], ...],
    leaf: tuple[float, float, int],
) -> np.ndarray:
    """Return a cell of one plant: ``stems`` of foot x, length and lean, each with a ``head``.

    ``leaf`` is the length of its leaves, their width over length, and how many a stem has.
    """
    rng, canvas = np.random.default_rng(seed), Cell.blank()
    parts: list[Leaves] = []
    for x, length, lean in stems:
        path = curve(x, length, lean, rng.uniform(-0.15, 0.25) * (1 if lean > 0 else -1))
        stalk(canvas, path, 0.026, STEM * rng.uniform(0.85, 1.15))
        face = FACE + rng.normal(0, 0.22, 3) + np.array([lean, 0.0, 0.0])
        parts += head(path[-1], face, size * rng.uniform(0.88, 1.1), rng)
        long, narrow, n = leaf
        at, way = along(path, 0.04 + 0.72 * rng.random(n) ** 1.6)
        out = whorl(way, rng.uniform(0, 6.3, n)) * np.array([1.0, 1.0, 0.4]) + 0.6 * UP
        lengths = long * rng.uniform(0.6, 1.2, n) * np.linspace(1.15, 0.7, n)
        green = LEAF * rng.uniform(0.8, 1.4, (n, 1))
        parts.append(
            kites(at, out, np.cross(out, way) + 0.6 * VIEWER, lengths, narrow * lengths, green)
        )

    for k in range(7):
        x = (k - 3) / 3
        foot = curve(0.10 * x, rng.uniform(0.35, 0.75), 0.35 * x, 0.8 * x + 0.1)
        blade(canvas, rng, foot, 0.05, rng.choice([0.0, 0.0, 0.6]))

    lit_leaves(canvas, parts)
    return canvas.finish()


def cells() -> list[np.ndarray]:
    """Return the pictures (HEIGHT, WIDTH, 4) in order: eight of the grass, eight of flowers."""
    long = (0.22, 0.16, 9)
    fern = (0.20, 0.30, 12)
    broad = (0.17, 0.55, 7)
    return [
        sheaf(401, 40, 0.034, (0.6, 2.4), 0.10, 1.3),
        sheaf(402, 34, 0.032, (0.5, 2.4), 0.26, 1.9),
        sheaf(403, 46, 0.026, (0.5, 2.3), 0.14, 1.5),
        sheaf(404, 18, 0.060, (0.7, 2.2), 0.08, 1.7),
        litter(),
        panicles(),
        spikes(),
        straws(),
        flowers(411, oxeye, 0.115, ((0.02, 1.80, 0.03), (-0.07, 1.40, -0.16)), long),
        flowers(
            412, oxeye, 0.110, ((0.05, 1.72, 0.09), (-0.05, 1.55, -0.13), (0.1, 1.1, 0.3)), long
        ),
        flowers(
            413,
            buttercup,
            0.095,
            ((0.0, 1.78, 0.05), (-0.06, 1.50, -0.18), (0.07, 1.3, 0.26)),
            fern,
        ),
        flowers(414, clover, 0.095, ((0.03, 1.66, 0.10), (-0.06, 1.30, -0.22)), broad),
        flowers(415, cornflower, 0.120, ((0.0, 1.74, 0.06), (-0.04, 1.42, -0.17)), long),
        flowers(416, umbel, 0.165, ((0.02, 1.62, 0.04), (-0.06, 1.16, -0.20)), fern),
        flowers(417, knapweed, 0.115, ((0.02, 1.68, 0.08), (-0.05, 1.35, -0.20)), long),
        flowers(418, hawkbit, 0.100, ((0.0, 1.74, -0.05), (0.05, 1.35, 0.22)), (0.2, 0.25, 3)),
    ]


def sward() -> np.ndarray:
    """Return all pictures, uint8 (2 HEIGHT, 8 WIDTH, 4), in two rows of eight."""
    rows = np.array(cells()).reshape(2, 8, HEIGHT, WIDTH, 4)
    sheet = rows.transpose(0, 2, 1, 3, 4).reshape(2 * HEIGHT, 8 * WIDTH, 4)
    return bleed(quantised(sheet))


ASSETS: dict[str, Callable[[], np.ndarray]] = {"sward.png": sward}
