"""Several individuals of each species of tree, for woods in which no two neighbours are alike.

Each has its own age, lean and outline (:mod:`landscape.studio.plants.boughs`). The light comes from
above and only slightly from the left, since the program shades the side away from the sun
(``transparent.sunward``). :mod:`landscape.studio.plants.trees` has the trees of 2006.
"""

import functools
from collections.abc import Callable

import numpy as np

from landscape.studio.plants.boughs import (
    Bough,
    Form,
    drawn,
    fit,
    form,
    line,
    live,
    sprays,
    spread_boughs,
)
from landscape.studio.plants.foliage import SIZE
from landscape.studio.plants.growth import colonise, hang_twigs, in_lobes
from landscape.studio.plants.trees import bark_texture, birch_bark

SMALL = 256  # texels per side of the picture of a tree that is never large

# Linear albedos, chosen by eye: each tree mixes its own three.
OAK = np.array([[0.072, 0.118, 0.022], [0.118, 0.158, 0.032], [0.046, 0.086, 0.024]])
BIRCH = np.array([[0.132, 0.172, 0.036], [0.190, 0.200, 0.042], [0.086, 0.132, 0.032]])
NEEDLES = np.array([[0.040, 0.078, 0.034], [0.072, 0.108, 0.040], [0.028, 0.060, 0.034]])
PINE = np.array([[0.058, 0.088, 0.040], [0.088, 0.116, 0.046], [0.040, 0.066, 0.036]])
THORN = np.array([[0.060, 0.092, 0.032], [0.098, 0.122, 0.038], [0.042, 0.070, 0.032]])
HAZEL = np.array([[0.088, 0.134, 0.030], [0.134, 0.168, 0.038], [0.056, 0.096, 0.028]])


def oak(
    frame: Form,
    seed: int,
    trunk: float,
    fill: tuple[float, float, float],
    albedos: np.ndarray = OAK,
    thick: float = 1.0,
    size: int = SIZE,
) -> np.ndarray:
    """Return a broad-leaved tree that grew over ``frame``.

    ``fill`` is its width, height and lean in the sprite, ``thick`` scales its number of leaves.
    """
    rng = np.random.default_rng(seed)
    attractors = in_lobes(frame.centres, frame.radii, 70 * len(frame.centres), rng)
    skeleton = colonise(attractors, frame.start, 0.030, np.array([0.0, 0.06, 0.0]), seed)
    skeleton.smooth(2)
    r = skeleton.radii(0.0026, trunk)
    at = live(skeleton, np.flatnonzero(r < 0.0048), frame)
    leaves = sprays(
        skeleton, at, int(22 * thick), (0.055, 0.028), (0.0205, 0.0125), 0.15, albedos, rng
    )
    fit(skeleton, leaves, *fill)
    bark = bark_texture([0.030, 0.025, 0.019], [0.165, 0.140, 0.110], 9.0, seed + 1)
    return drawn(skeleton, r, leaves, bark, 0.85, 7, rng, size)


@functools.cache
def oak_old() -> np.ndarray:
    """Return an old oak in the open: wide, lopsided, with a dead bough among the live ones."""
    rng = np.random.default_rng(211)
    trunk = line((0, 0, 0), (0.03, 0.25, 0), (-0.02, 0.48, 0), (0.05, 0.8, 0.0), (0.0, 1.12, 0))
    boughs = spread_boughs(
        rng, 24, (0.26, 1.0), lambda t: 1.0 - 0.62 * t**1.5, (0.02, 1.1), (0.17, 0.26)
    )
    boughs[4] = boughs[4]._replace(around=np.pi, out=1.08, up=0.10)
    boughs[9] = Bough(0.56, 0.25, 0.98, 0.42, 0.14, True)
    return oak(form([trunk], [boughs], rng, 4), 212, 0.072, (0.97, 0.95, 0.5))


@functools.cache
def oak_leaning() -> np.ndarray:
    """Return an oak that the wind has pushed to the right, its crown in two storeys."""
    rng = np.random.default_rng(221)
    trunk = line((0, 0, 0), (0.04, 0.3, 0), (0.13, 0.62, 0), (0.17, 0.98, 0.0), (0.30, 1.42, 0))
    boughs = spread_boughs(
        rng, 11, (0.24, 0.60), lambda t: 0.66 - 0.1 * t, (0.02, 0.35), (0.15, 0.22)
    )
    boughs += spread_boughs(
        rng, 14, (0.66, 1.0), lambda t: 0.66 - 0.36 * t, (0.25, 1.1), (0.17, 0.24)
    )
    return oak(form([trunk], [boughs], rng, 3), 222, 0.060, (0.90, 0.97, 0.8))


@functools.cache
def oak_tall() -> np.ndarray:
    """Return a forest tree, drawn up by its neighbours: high, narrow, ragged."""
    rng = np.random.default_rng(231)
    trunk = line((0, 0, 0), (-0.02, 0.5, 0), (0.03, 0.9, 0), (-0.03, 1.3, 0.0), (0.02, 1.72, 0))
    boughs = spread_boughs(
        rng,
        27,
        (0.20, 1.0),
        lambda t: 0.30 + 0.32 * np.sin(np.pi * min(1.0, 0.25 + 0.8 * t)),
        (0.15, 0.9),
        (0.14, 0.22),
    )
    boughs[1] = boughs[1]._replace(dead=True)
    return oak(form([trunk], [boughs], rng, 3), 232, 0.050, (0.74, 0.98, 0.4))


@functools.cache
def oak_young() -> np.ndarray:
    """Return a sapling: a thin stem, few boughs, leaves almost down to the grass."""
    rng = np.random.default_rng(241)
    trunk = line((0, 0, 0), (0.03, 0.4, 0), (-0.02, 0.9, 0), (0.04, 1.45, 0.0), (0.02, 1.8, 0))
    boughs = spread_boughs(
        rng, 24, (0.07, 1.0), lambda t: 0.54 - 0.36 * t, (0.35, 1.3), (0.13, 0.20)
    )
    frame = form([trunk], [boughs], rng, 3)
    return oak(frame, 242, 0.026, (0.78, 0.96, 0.6), HAZEL, 1.0, SMALL)


@functools.cache
def hazel() -> np.ndarray:
    """Return a bush of many stems, wider than high, its foliage down to the ground."""
    rng = np.random.default_rng(251)
    stems, boughs = [], []
    for k in range(7):
        lean = -0.62 + 0.2 * k + rng.uniform(-0.08, 0.08)
        top = rng.uniform(0.55, 1.0) * (1.15 - 0.5 * abs(lean))
        z = rng.uniform(-0.25, 0.35)
        stems.append(line((0.2 * lean, 0, 0), (0.6 * lean, 0.5 * top, z), (lean, top, 1.4 * z)))
        boughs.append(
            spread_boughs(rng, 8, (0.10, 1.0), lambda t: 0.34 - 0.14 * t, (-0.3, 0.8), (0.13, 0.20))
        )
    frame = form(stems, boughs, rng, 2)
    return oak(frame, 252, 0.024, (0.96, 0.66, 0.6), HAZEL, 0.75)


def birch(
    trunks: list[np.ndarray],
    boughs: list[list[Bough]],
    seed: int,
    trunk: float,
    fill: tuple[float, float, float],
    size: int = SIZE,
) -> np.ndarray:
    """Return a birch: white stems, open boughs and thin hanging twigs."""
    rng = np.random.default_rng(seed)
    frame = form(trunks, boughs, rng, 3)
    attractors = in_lobes(frame.centres, frame.radii, 42 * len(frame.centres), rng)
    skeleton = colonise(attractors, frame.start, 0.033, np.array([0.0, 0.30, 0.0]), seed)
    skeleton.smooth(3)
    tips = np.flatnonzero(skeleton.child_counts() == 0)
    skeleton = hang_twigs(skeleton, tips, (4, 13), 0.026, rng)
    r = skeleton.radii(0.0016, trunk)
    leaves = sprays(
        skeleton, np.flatnonzero(r < 0.0030), 8, (0.028, 0.026), (0.0175, 0.0125), 0.9, BIRCH, rng
    )
    fit(skeleton, leaves, *fill)
    return drawn(skeleton, r, leaves, birch_bark(seed + 1), 0.62, 5, rng, size)


@functools.cache
def birch_tall() -> np.ndarray:
    """Return a slender birch, its single stem visible to the top."""
    rng = np.random.default_rng(311)
    trunk = line((0, 0, 0), (0.03, 0.5, 0), (-0.02, 1.0, 0), (0.03, 1.5, 0.0), (0.08, 1.9, 0))
    boughs = spread_boughs(
        rng, 22, (0.22, 1.0), lambda t: 0.46 - 0.34 * t, (0.6, 1.3), (0.11, 0.17)
    )
    return birch([trunk], [boughs], 312, 0.042, (0.62, 0.98, 0.6))


@functools.cache
def birch_twin() -> np.ndarray:
    """Return an old birch with two stems that part near the ground."""
    rng = np.random.default_rng(321)
    trunks = [
        line((0, 0, 0), (0.05, 0.3, 0), (0.19, 0.8, 0), (0.26, 1.3, 0.0), (0.40, 1.75, 0)),
        line((0, 0, 0), (-0.07, 0.35, 0), (-0.12, 0.7, 0), (-0.27, 1.1, 0.0), (-0.26, 1.42, 0)),
    ]
    boughs = [
        spread_boughs(rng, 11, (0.34, 1.0), lambda t: 0.46 - 0.26 * t, (0.6, 1.2), (0.13, 0.19)),
        spread_boughs(rng, 8, (0.40, 1.0), lambda t: 0.44 - 0.22 * t, (0.5, 1.1), (0.12, 0.18)),
    ]
    return birch(trunks, boughs, 322, 0.046, (0.88, 0.98, 0.6))


@functools.cache
def birch_young() -> np.ndarray:
    """Return a young birch: a whip of a stem with short boughs."""
    rng = np.random.default_rng(331)
    trunk = line((0, 0, 0), (-0.03, 0.5, 0), (0.02, 1.0, 0), (-0.02, 1.5, 0.0), (-0.06, 1.85, 0))
    boughs = spread_boughs(
        rng, 13, (0.16, 1.0), lambda t: 0.36 - 0.28 * t, (0.7, 1.2), (0.09, 0.13)
    )
    return birch([trunk], [boughs], 332, 0.022, (0.52, 0.97, 0.8), SMALL)


def needled(
    frame: Form,
    seed: int,
    trunk: float,
    fill: tuple[float, float, float],
    albedos: np.ndarray,
    bark: np.ndarray,
    size: int = SIZE,
) -> np.ndarray:
    """Return a conifer with tufts of needles that grew over ``frame``."""
    rng = np.random.default_rng(seed)
    attractors = in_lobes(frame.centres, frame.radii, 46 * len(frame.centres), rng)
    skeleton = colonise(attractors, frame.start, 0.027, np.array([0.0, 0.04, 0.0]), seed)
    skeleton.smooth(1)
    r = skeleton.radii(0.0022, trunk)
    at = live(skeleton, np.flatnonzero(r < 0.0050), frame)
    tufts = sprays(skeleton, at, 20, (0.030, 0.020), (0.026, 0.0046), -0.25, albedos, rng)
    fit(skeleton, tufts, *fill)
    return drawn(skeleton, r, tufts, bark, 1.0, 5, rng, size)


def tiers(
    rng: np.random.Generator, count: int, low: float, widest: float, gaps: float
) -> list[Bough]:
    """Return the boughs of a spruce: whorls of uneven length, some missing, drooping below."""
    boughs = []
    for k in range(count):
        t = k / (count - 1)
        reach = widest * (1.0 - t) ** 0.85 * min(1.0, 0.7 + 1.8 * t) + 0.03
        turn = rng.uniform(0, 2 * np.pi)
        each = 6 if t < 0.7 else 4
        for j in range(each):
            if rng.random() < gaps * (1.0 - t):
                continue
            out = reach * rng.uniform(0.60, 1.15)
            up = out * (-0.38 + 1.0 * t**1.5 + rng.uniform(-0.1, 0.1))
            around = turn + 2 * np.pi * (j + rng.uniform(-0.3, 0.3)) / each
            at = low + (0.985 - low) * t
            boughs.append(Bough(at, around, out, up, 0.045 + 0.16 * out))
    return boughs


SPRUCE_BARK = ([0.026, 0.020, 0.016], [0.125, 0.092, 0.072], 3.0)
PINE_BARK = ([0.055, 0.032, 0.020], [0.260, 0.140, 0.075], 6.0)


@functools.cache
def spruce_old() -> np.ndarray:
    """Return an old spruce: uneven tiers with sky between them, a thin leader."""
    rng = np.random.default_rng(411)
    trunk = line((0, 0, 0), (0.01, 0.7, 0), (-0.01, 1.4, 0), (0.02, 2.0, 0))
    frame = form([trunk], [tiers(rng, 21, 0.10, 0.70, 0.26)], rng, 3)
    bark = bark_texture(*SPRUCE_BARK, 412)
    return needled(frame, 413, 0.045, (0.74, 0.985, 0.7), NEEDLES, bark)


@functools.cache
def pine() -> np.ndarray:
    """Return a Scots pine: a bare red trunk, dead snags, and dark clouds of needles on top."""
    rng = np.random.default_rng(421)
    trunk = line((0, 0, 0), (0.05, 0.4, 0), (0.0, 0.85, 0), (0.08, 1.3, 0.0), (0.20, 1.72, 0))
    boughs = [
        Bough(0.38, 3.0, 0.30, 0.04, 0.07, True),
        Bough(0.50, 0.3, 0.24, 0.02, 0.06, True),
    ]
    boughs += spread_boughs(
        rng, 12, (0.56, 1.0), lambda t: 0.62 - 0.42 * t, (0.12, 0.75), (0.12, 0.19)
    )
    frame = form([trunk], [boughs], rng, 3)
    bark = bark_texture(*PINE_BARK, 422)
    return needled(frame, 423, 0.050, (0.74, 0.97, 0.8), PINE, bark)


@functools.cache
def spruce_young() -> np.ndarray:
    """Return a young spruce, its boughs down to the ground."""
    rng = np.random.default_rng(431)
    trunk = line((0, 0, 0), (0.0, 1.0, 0), (0.015, 1.95, 0))
    frame = form([trunk], [tiers(rng, 15, 0.05, 0.80, 0.08)], rng, 3)
    bark = bark_texture(*SPRUCE_BARK, 432)
    return needled(frame, 433, 0.030, (0.80, 0.97, 0.8), NEEDLES, bark, SMALL)


def _thorn_form(rng: np.random.Generator) -> Form:
    """Return two bent trunks with their boughs, those to windward dead."""
    trunks = [
        line((0, 0, 0), (0.05, 0.14, 0), (0.0, 0.3, 0), (0.16, 0.6, 0), (0.34, 0.86, 0)),
        line((0, 0, 0), (-0.09, 0.15, 0), (-0.08, 0.32, 0), (-0.24, 0.55, 0), (-0.2, 0.78, 0)),
    ]
    boughs = [
        spread_boughs(rng, 10, (0.35, 1.0), lambda t: 0.58 - 0.2 * t, (0.15, 0.7), (0.13, 0.19)),
        spread_boughs(rng, 6, (0.50, 1.0), lambda t: 0.40 - 0.1 * t, (0.10, 0.6), (0.12, 0.16)),
    ]
    boughs[1] = [b._replace(dead=np.cos(b.around) < -0.3) for b in boughs[1]]
    return form(trunks, boughs, rng, 3)


@functools.cache
def thorn() -> np.ndarray:
    """Return a hawthorn bent by the wind: gnarled stems, dead twigs to windward, some blossom."""
    rng = np.random.default_rng(511)
    frame = _thorn_form(rng)
    attractors = in_lobes(frame.centres, frame.radii, 2600, rng)
    skeleton = colonise(attractors, frame.start, 0.033, np.array([0.16, 0.03, 0.0]), 512)
    r = skeleton.radii(0.0028, 0.062)
    at = live(skeleton, np.flatnonzero(r < 0.0056), frame)
    leaves = sprays(skeleton, at, 20, (0.046, 0.026), (0.0185, 0.0125), 0.0, THORN, rng)

    flowering = rng.random(len(skeleton.points)) < 0.12
    blossom = np.repeat(flowering[at], 20) & (rng.random(len(leaves.centre)) < 0.4)
    leaves.albedo[blossom] = np.array([0.46, 0.43, 0.36])

    fit(skeleton, leaves, 0.94, 0.90, 0.7)
    bark = bark_texture([0.03, 0.028, 0.025], [0.165, 0.150, 0.132], 7.0, 513)
    return drawn(skeleton, r, leaves, bark, 0.75, 5, rng)


@functools.cache
def bramble() -> np.ndarray:
    """Return a low thicket of arching canes and fern-like leaves, without a trunk."""
    rng = np.random.default_rng(521)
    stems, boughs = [], []
    for k in range(9):
        x = -0.6 + 0.15 * k + rng.uniform(-0.05, 0.05)
        top, z = rng.uniform(0.28, 0.62) * (1.0 - 0.5 * abs(x)), rng.uniform(-0.3, 0.4)
        bow = x + np.sign(x + 0.01) * rng.uniform(0.08, 0.22)
        stems.append(line((0.6 * x, 0, 0), (x, top, z), (bow, 0.8 * top, 1.3 * z)))
        boughs.append(
            spread_boughs(rng, 7, (0.1, 1.0), lambda t: 0.26 - 0.06 * t, (-0.3, 0.5), (0.10, 0.16))
        )
    frame = form(stems, boughs, rng, 2)
    return oak(frame, 522, 0.012, (0.97, 0.46, 0.5), THORN, 0.8, SMALL)


ASSETS: dict[str, Callable[[], np.ndarray]] = {
    "oak_old.png": oak_old,
    "oak_leaning.png": oak_leaning,
    "oak_tall.png": oak_tall,
    "oak_young.png": oak_young,
    "hazel.png": hazel,
    "birch_tall.png": birch_tall,
    "birch_twin.png": birch_twin,
    "birch_young.png": birch_young,
    "spruce_old.png": spruce_old,
    "pine.png": pine,
    "spruce_young.png": spruce_young,
    "thorn.png": thorn,
    "bramble.png": bramble,
}
