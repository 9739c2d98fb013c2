"""The herbs of the preset `best`: lady fern, ox-eye daisies, rosebay willow-herb, marram, heather.

Each is a clump (:mod:`landscape.studio.plants.clumps`) that fills its sprite; its size in the scene
is set in `landscape/elements/best/sprites/refined_planting.py`.
"""

from collections.abc import Callable

import numpy as np

from landscape.studio.plants.clumps import UP, VIEWER, Stems, along, kites, sprite_of, stem, whorl
from landscape.studio.plants.foliage import Leaves, join, unit
from landscape.studio.plants.plants import tilt

# Linear colours, all chosen by eye.
FERN_OLD, FERN_YOUNG = np.array([0.050, 0.115, 0.022]), np.array([0.125, 0.205, 0.040])
STALK = np.array([0.12, 0.14, 0.045])
HERB_LEAF, HERB_STEM = np.array([0.052, 0.098, 0.028]), np.array([0.095, 0.130, 0.045])
PETAL, DISC = np.array([0.50, 0.50, 0.47]), np.array([0.52, 0.33, 0.030])
GRASS = np.array([0.115, 0.175, 0.045])
MAGENTA, BUD = np.array([0.33, 0.085, 0.25]), np.array([0.21, 0.050, 0.095])
REDDISH = np.array([0.150, 0.085, 0.050])
MARRAM = np.array(
    [[0.105, 0.150, 0.070], [0.135, 0.175, 0.085], [0.175, 0.195, 0.090], [0.290, 0.250, 0.125]]
)
SEED_HEAD = np.array([0.330, 0.265, 0.135])
HEATH_LEAF, HEATH_BELL = np.array([0.050, 0.072, 0.030]), np.array([0.290, 0.130, 0.245])
HEATH_WOOD = np.array([0.085, 0.055, 0.038])
# Chosen: lean (radians, negative to the left), turn towards the viewer, length; from back to front.
FERN_FRONDS = (
    (0.20, -0.6, 0.90),
    (-0.34, -0.7, 0.92),
    (0.50, -0.4, 1.16),
    (-0.60, -0.4, 1.18),
    (0.74, -0.1, 1.32),
    (-0.84, -0.1, 1.30),
    (0.08, 1.0, 0.84),
    (1.02, 0.1, 1.24),
    (-1.10, 0.1, 1.26),
    (-0.42, 0.8, 1.00),
    (0.56, 0.7, 1.02),
    (-0.80, 0.6, 1.06),
    (0.92, 0.6, 1.04),
    (-1.22, 0.5, 0.92),
    (1.20, 0.5, 0.94),
)


def pinnate(path: np.ndarray, roll: float, size: float, rng: np.random.Generator) -> Leaves:
    """Return the pinnules of a twice-divided frond, like a lady fern's, along its midrib (m, 3).

    ``roll`` (radians) rotates the plane of the frond about the midrib; ``size`` is the length of
    the longest pinna.
    """
    count, cut = 21, 5  # chosen: pinnae per side, pinnules per side of a pinna
    fractions = np.linspace(0.10, 0.99, count)
    root, tangent = along(path, fractions)
    flat = unit(np.cross(tangent, UP) + 1e-6)
    span = flat * np.cos(roll) + np.cross(flat, tangent) * np.sin(roll)
    face = np.cross(span, tangent)
    face *= np.where(face[:, 1:2] < 0, -1.0, 1.0)

    # Lanceolate outline: widest at a third of the length, with a long fine tip.
    reach = (
        size * np.minimum((fractions / 0.33) ** 0.75, 1.06 * (1.0 - fractions) ** 0.85 + 0.30)
        + 0.01
    )
    reach *= np.where(fractions > 0.33, np.minimum(1.0, (1.02 - fractions) / 0.42) ** 0.8, 1.0)
    tone = rng.uniform(0.80, 1.15)
    parts = []
    for side in (-1.0, 1.0):
        long = reach * rng.uniform(0.88, 1.06, count)
        way = unit(
            side * span
            + tangent * (0.30 + 0.5 * fractions[:, None])
            - 0.12 * face
            + 0.05 * rng.standard_normal((count, 3))
        )
        for k in range(cut):
            t = (k + 0.6) / cut
            # The tips of the pinnae hang down.
            at = root + way * (t * long)[:, None] - UP * (0.16 * t * t * long)[:, None]
            small = np.maximum(0.38 * long * (1.0 - 0.72 * t), 0.026)
            for edge in (-1.0, 1.0):
                axis = unit(way * 0.75 + edge * np.cross(face, way) - 0.15 * UP * t)
                normal = face + 0.22 * rng.standard_normal((count, 3))
                green = FERN_OLD + (FERN_YOUNG - FERN_OLD) * (0.75 * fractions + 0.25 * t)[:, None]
                green = green * tone * rng.uniform(0.82, 1.16, (count, 1))
                parts.append(kites(at, axis, normal, small, 0.52 * small + 0.004, green))

    return join(parts)


def fern() -> np.ndarray:
    """Return a lady fern: a loose funnel of low-arching, twice-divided fronds."""
    rng = np.random.default_rng(21)
    parts: list[Leaves] = []
    stems: Stems = []
    for lean, turn, length in FERN_FRONDS:
        azimuth = turn if lean > 0 else np.pi - turn
        bend = 1.20 + 0.25 * rng.uniform(-1, 1)
        path = tilt(stem(np.zeros(3), length, abs(lean), bend, azimuth, 40))
        roll = -np.sign(lean) * rng.uniform(0.45, 0.75)
        parts.append(pinnate(path, roll, 0.21 * length, rng))
        stems.append((path, 0.012, 0.003, STALK))
    return sprite_of(join(parts), stems, 0.40, 0.05)


def daisy_head(
    centre: np.ndarray, towards: np.ndarray, size: float, rng: np.random.Generator
) -> Leaves:
    """Return the kites of one ox-eye head at ``centre`` (3,) that faces along ``towards`` (3,)."""
    count = 17
    face = unit(towards)
    angles = np.arange(count) * 2 * np.pi / count + rng.uniform(0, 1)
    angles += rng.uniform(-0.08, 0.08, count)
    around = whorl(np.tile(face, (count, 1)), angles)
    shade = PETAL * rng.uniform(0.86, 1.06, (count, 1))
    rays = kites(
        centre + around * 0.25 * size,
        around - 0.16 * face + 0.05 * rng.standard_normal((count, 3)),
        np.tile(face, (count, 1)) + 0.10 * rng.standard_normal((count, 3)),
        size * rng.uniform(0.70, 0.84, count),
        0.34 * size,
        shade,
    )

    turns = np.arange(14) * 2.4
    spokes = whorl(np.tile(face, (14, 1)), turns)
    ring = spokes * (0.30 * size * np.sqrt((np.arange(14) + 0.5) / 14))[:, None]
    disc = kites(
        centre + ring + face * 0.06 * size - 0.09 * size * UP,
        np.tile(UP + 0.01, (14, 1)),
        np.tile(face, (14, 1)) + 0.5 * ring / size,
        0.18 * size,
        0.20 * size,
        DISC * rng.uniform(0.8, 1.15, (14, 1)),
    )
    return join([rays, disc])


def oxeye() -> np.ndarray:
    """Return a clump of ox-eye daisies on leafy stems, with grass between them."""
    rng = np.random.default_rng(8)
    parts: list[Leaves] = []
    stems: Stems = []
    for k in range(19):
        foot = np.array([(k * 7 % 19 - 9) * 0.062, 0.0, rng.normal(0, 0.14)])
        lean = 0.04 + 0.42 * abs(foot[0]) * rng.uniform(0.4, 1.2)
        azimuth = rng.uniform(-0.8, 0.8) + (0.0 if foot[0] > 0 else np.pi)
        path = stem(foot, 0.9 + 0.75 * (k * 4 % 19) / 18, lean, rng.uniform(0.0, 0.35), azimuth, 24)
        stems.append((path, 0.014, 0.010, HERB_STEM * rng.uniform(0.95, 1.35)))
        top, tangent = along(path, np.array([1.0]))
        if k % 6 == 5:
            bud = whorl(np.tile(tangent, (6, 1)), np.arange(6.0)) * 0.6 + tangent
            parts.append(kites(np.tile(top, (6, 1)), bud, bud, 0.075, 0.04, HERB_LEAF * 1.3))
        else:
            # Open flowers look up to the sun, so most are seen at a slant.
            face = tangent[0] * 0.5 + VIEWER * rng.uniform(0.5, 1.1) + 0.5 * UP
            parts.append(
                daisy_head(top[0], face + 0.25 * rng.normal(size=3), rng.uniform(0.066, 0.082), rng)
            )
        leaf_count = 12
        at, way = along(path, rng.uniform(0.05, 0.8, leaf_count))
        out = whorl(way, rng.uniform(0, 2 * np.pi, leaf_count)) + 0.6 * UP
        green = HERB_LEAF * rng.uniform(0.9, 1.5, (leaf_count, 1))
        small = rng.uniform(0.12, 0.2, leaf_count)
        parts.append(kites(at, out, np.cross(out, way) + UP, small, 0.26 * small, green))

    for _ in range(120):
        foot = np.array([rng.uniform(-0.72, 0.72), 0.0, rng.normal(0, 0.14)])
        azimuth = rng.uniform(0, 2 * np.pi)
        reach = rng.uniform(0.35, 1.15) * (1.0 - 0.5 * abs(foot[0]))
        path = stem(foot, reach, rng.uniform(0.03, 0.4), rng.uniform(0.1, 0.9), azimuth, 14)
        stems.append((path, 0.012, 0.003, GRASS * rng.uniform(0.6, 1.3)))

    return sprite_of(join(parts), stems, 0.30)


def willowherb() -> np.ndarray:
    """Return rosebay willow-herb: straight stems with narrow leaves, each with a flower spike."""
    rng = np.random.default_rng(14)
    parts: list[Leaves] = []
    stems: Stems = []
    for k in range(7):
        x = (k - 3) * 0.11 + rng.uniform(-0.03, 0.03)
        foot = np.array([x, 0.0, rng.uniform(-0.15, 0.15)])
        length = (1.75 - 0.42 * (k * 3 % 7) / 6.0) * (1.0 - 0.3 * abs(x))
        azimuth = rng.uniform(-0.7, 0.7) + (0.0 if x > 0 else np.pi)
        path = stem(foot, length, abs(x) * 0.45, rng.uniform(-0.05, 0.25), azimuth, 40)
        stems.append((path, 0.013, 0.005, REDDISH * rng.uniform(0.85, 1.15)))
        # Leaves in a spiral, shorter towards the top. Two kites each, so that the tips arch down.
        n = 34
        fractions = np.linspace(0.06, 0.66, n)
        at, way = along(path, fractions)
        out = whorl(way, np.arange(n) * 2.4 + rng.uniform(0, 6))
        long = (0.32 - 0.22 * fractions) * rng.uniform(0.8, 1.15, n)
        green = HERB_LEAF * rng.uniform(0.85, 1.35, (n, 1)) * (0.8 + 0.6 * fractions[:, None])
        rise = out + 0.55 * UP
        parts.append(
            kites(at, rise, UP + 0.5 * VIEWER - 0 * out, 0.62 * long, 0.115 * long + 0.012, green)
        )
        tip_root = at + unit(rise) * (0.52 * long)[:, None]
        parts.append(
            kites(
                tip_root,
                out - 0.12 * UP,
                UP + 0.5 * VIEWER - 0 * out,
                0.52 * long,
                0.105 * long + 0.008,
                green * 1.08,
            )
        )
        # Flowers on short stalks all around: open at the bottom, buds at the top.
        n = 30
        fractions = np.linspace(0.62, 0.90, n)
        ripe = 1.0 - (fractions - 0.62) / 0.30
        at, way = along(path, fractions)
        out = whorl(way, np.arange(n) * 2.4 + rng.uniform(0, 6)) + 0.35 * UP
        heart = at + out * (0.020 + 0.055 * ripe)[:, None]
        face = unit(out + 0.6 * VIEWER)
        turn = rng.uniform(0, np.pi, n)
        for petal in range(4):
            wide = whorl(face, turn + petal * np.pi / 2)
            tone = MAGENTA * rng.uniform(0.8, 1.25, (n, 1))
            parts.append(
                kites(
                    heart,
                    wide + 0.25 * face,
                    face,
                    0.030 + 0.028 * ripe,
                    0.028 + 0.026 * ripe,
                    tone,
                )
            )
        n = 26
        fractions = np.linspace(0.86, 1.0, n)
        at, way = along(path, fractions)
        out = whorl(way, np.arange(n) * 2.4) + 0.75 * UP * (
            1 + 2 * (fractions[:, None] - 0.86) / 0.14
        )
        parts.append(
            kites(
                at,
                out,
                VIEWER + 0.4 * out,
                0.065 * (1.3 - 4.0 * (fractions - 0.86)),
                0.024,
                BUD * rng.uniform(0.8, 1.5, (n, 1)),
            )
        )

    return sprite_of(join(parts), stems, 0.40)


def marram() -> np.ndarray:
    """Return a tussock of marram: rolled blades that arch outward, some dry, and seed heads."""
    rng = np.random.default_rng(3)
    stems: Stems = []
    for _ in range(230):
        spread = rng.normal(0, 0.13)
        foot = np.array([spread, 0.0, rng.normal(0, 0.09)])
        azimuth = rng.uniform(-1.0, 1.0) + (0.0 if spread + rng.normal(0, 0.12) > 0 else np.pi)
        dry = rng.random() < 0.22
        lean = rng.uniform(0.02, 0.5) + 0.8 * abs(spread) + 0.25 * dry
        bend = rng.uniform(0.25, 1.1) + 0.5 * dry
        path = stem(foot, rng.uniform(0.75, 1.65) * (0.85 if dry else 1.0), lean, bend, azimuth, 26)
        colour = MARRAM[3] if dry else MARRAM[rng.integers(3)]
        stems.append((path, 0.0105, 0.0028, colour * rng.uniform(0.82, 1.18)))

    parts = []
    for k in range(6):
        x = (k - 2.5) * 0.06 + rng.uniform(-0.02, 0.02)
        azimuth = rng.uniform(-0.8, 0.8) + (0.0 if x > 0 else np.pi)
        path = stem(
            np.array([x, 0.0, 0.05]), rng.uniform(1.45, 1.8), 0.12 + abs(x), 0.35, azimuth, 40
        )
        stems.append((path, 0.009, 0.006, MARRAM[3]))
        n = 90
        fractions = rng.uniform(0.84, 1.0, n)
        at, way = along(path, fractions)
        out = way + 0.28 * whorl(way, rng.uniform(0, 6.3, n))
        thick = np.sin(np.pi * (fractions - 0.83) / 0.18) * 0.5 + 0.5
        tone = SEED_HEAD * rng.uniform(0.75, 1.2, (n, 1))
        parts.append(kites(at, out, VIEWER + 0 * out, 0.07 * thick + 0.01, 0.026, tone))

    return sprite_of(join(parts), stems, 0.30, 0.05)


def heather() -> np.ndarray:
    """Return a cushion of heather: wiry twigs, dark scale leaves below and mauve bells above."""
    rng = np.random.default_rng(9)
    parts: list[Leaves] = []
    stems: Stems = []
    for k in range(190):
        out = (k * 0.618034 % 1.0) * 2.0 - 1.0
        azimuth = rng.uniform(-1.2, 1.2) + (0.0 if out > 0 else np.pi)
        foot = np.array([0.62 * out, 0.0, rng.normal(0, 0.2)])
        length = rng.uniform(0.55, 1.0) * (1.0 - 0.42 * out**2)
        lean = 0.05 + 0.6 * abs(out) ** 1.5
        path = stem(foot, length, lean, rng.uniform(-0.7, 0.5), azimuth, 18)
        stems.append((path, 0.009, 0.004, HEATH_WOOD * rng.uniform(0.8, 1.2)))
        n = 46
        fractions = rng.uniform(0.02, 0.75, n)
        at, way = along(path, fractions)
        side = way + 0.9 * whorl(way, rng.uniform(0, 6.3, n))
        tone = HEATH_LEAF * rng.uniform(0.7, 1.45, (n, 1))
        parts.append(kites(at, side, side + VIEWER, rng.uniform(0.045, 0.075, n), 0.026, tone))
        n = 44 if rng.random() < 0.85 else 6
        fractions = rng.uniform(0.60, 1.0, n)
        at, way = along(path, fractions)
        side = 0.5 * way + whorl(way, rng.uniform(0, 6.3, n))
        tone = HEATH_BELL * rng.uniform(0.65, 1.35, (n, 1)) * rng.uniform(0.85, 1.1)
        parts.append(kites(at, side, side + VIEWER, rng.uniform(0.035, 0.05, n), 0.030, tone))

    return sprite_of(join(parts), stems, 0.55, 0.05)


ASSETS: dict[str, Callable[[], np.ndarray]] = {
    "fern.png": fern,
    "oxeye.png": oxeye,
    "willowherb.png": willowherb,
    "marram.png": marram,
    "heather.png": heather,
}
