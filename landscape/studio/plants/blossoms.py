"""The flower heads of the sward's pictures, as kites: daisies, buttercups, clover and others.

A head is made of petals around a face that looks up to the sun, and of balls of small florets.
``landscape/studio/plants/sward.py`` puts heads on stems; the same cell space is used.
"""

from collections.abc import Callable

import numpy as np

from landscape.studio.plants.clumps import UP, VIEWER, kites, whorl
from landscape.studio.plants.foliage import Leaves, unit

# Linear colours, all chosen by eye.
STEM, LEAF = np.array([0.105, 0.160, 0.040]), np.array([0.075, 0.135, 0.035])
WHITE, YOLK = np.array([0.62, 0.62, 0.58]), np.array([0.62, 0.36, 0.018])
BUTTER, CREAM = np.array([0.72, 0.50, 0.010]), np.array([0.56, 0.57, 0.47])
CLOVER, CORNFLOWER = np.array([0.43, 0.115, 0.27]), np.array([0.085, 0.125, 0.56])
LILAC = np.array([0.36, 0.16, 0.44])
TILT = 0.85  # chosen: how far an umbel faces up, over how far it faces the viewer


def rays(
    heart: np.ndarray,
    face: np.ndarray,
    count: int,
    size: float,
    wide: float,
    tone: np.ndarray,
    rng: np.random.Generator,
    rise: float = 0.0,
) -> Leaves:
    """Return ``count`` petals around ``heart`` (3,), ``size`` long, ``wide`` times as broad.

    They lie at right angles to ``face`` (3,), or rise from there into a cup.
    """
    faces = np.tile(unit(face), (count, 1))
    angles = np.arange(count) * 2 * np.pi / count + rng.uniform(0, 6) + rng.normal(0, 0.06, count)
    out = whorl(faces, angles)
    shade = tone * rng.uniform(0.84, 1.08, (count, 1))
    return kites(
        heart + out * 0.16 * size,
        out + rise * faces,
        faces,
        size * rng.uniform(0.86, 1.0, count),
        wide * size,
        shade,
    )


def dome(
    heart: np.ndarray, face: np.ndarray, size: float, tone: np.ndarray, rng: np.random.Generator
) -> Leaves:
    """Return the disc florets of a head: a small dome of 16 kites around ``heart`` (3,)."""
    faces = np.tile(unit(face), (16, 1))
    spokes = whorl(faces, np.arange(16) * 2.4)
    ring = spokes * (size * np.sqrt((np.arange(16) + 0.5) / 16))[:, None]
    at = heart + ring + faces * 0.45 * size - 0.35 * size * UP
    tones = tone * rng.uniform(0.75, 1.15, (16, 1))
    return kites(
        at, np.tile(UP + 0.01, (16, 1)), faces + ring / size, 0.7 * size, 0.7 * size, tones
    )


def ball(
    heart: np.ndarray,
    size: tuple[float, float],
    count: int,
    tone: np.ndarray,
    rng: np.random.Generator,
) -> Leaves:
    """Return a round head of ``count`` florets, ``size`` = (half width, half height)."""
    way = unit(rng.normal(size=(count, 3)))
    way[:, 1] = np.where(way[:, 1] < -0.5, -way[:, 1], way[:, 1])
    at = heart + way * np.array([size[0], size[1], size[0]])
    shade = tone * rng.uniform(0.7, 1.2, (count, 1)) * (1.0 - 0.25 * np.abs(way[:, 1:2]))
    return kites(at, way + 0.6 * UP, way + 0.3 * VIEWER, 0.055, 0.026, shade)


Head = Callable[[np.ndarray, np.ndarray, float, np.random.Generator], list[Leaves]]
"""A function of a place (3,), the way the flower faces (3,), its size and a generator."""


def oxeye(at: np.ndarray, face: np.ndarray, size: float, rng: np.random.Generator) -> list[Leaves]:
    """Return a daisy: white rays around a yellow disc."""
    return [rays(at, face, 18, size, 0.30, WHITE, rng), dome(at, face, 0.36 * size, YOLK, rng)]


def buttercup(
    at: np.ndarray, face: np.ndarray, size: float, rng: np.random.Generator
) -> list[Leaves]:
    """Return a buttercup: five broad, glossy petals that form a cup."""
    petals = rays(at, face + 0.5 * UP, 5, 0.8 * size, 0.95, BUTTER, rng, 0.45)
    return [petals, dome(at, face, 0.20 * size, YOLK * 0.8, rng)]


def clover(at: np.ndarray, face: np.ndarray, size: float, rng: np.random.Generator) -> list[Leaves]:
    """Return a red clover: a ball of narrow florets, paler at its foot."""
    low = at - np.array([0.0, 0.35 * size, 0.0])
    return [
        ball(low, (0.55 * size, 0.4 * size), 30, CLOVER * 1.25, rng),
        ball(at, (0.75 * size, 0.8 * size), 70, CLOVER, rng),
    ]


def cornflower(
    at: np.ndarray, face: np.ndarray, size: float, rng: np.random.Generator
) -> list[Leaves]:
    """Return a cornflower: blue funnels around a violet middle, above a scaly base."""
    base = ball(at - 0.28 * size * UP, (0.2 * size, 0.36 * size), 26, LEAF * 0.9, rng)
    outer = rays(at, face + 0.6 * UP, 10, size, 0.5, CORNFLOWER, rng, 0.35)
    inner = rays(at, face + 0.6 * UP, 9, 0.5 * size, 0.35, LILAC * 0.7, rng, 0.9)
    return [base, outer, inner]


def knapweed(
    at: np.ndarray, face: np.ndarray, size: float, rng: np.random.Generator
) -> list[Leaves]:
    """Return a knapweed: a lilac brush on a dark, scaly base."""
    base = ball(at - 0.3 * size * UP, (0.26 * size, 0.36 * size), 26, LEAF * 0.55, rng)
    brush = [rays(at, UP + 0.2 * face, 16, size, 0.16, LILAC, rng, r) for r in (0.35, 0.9, 2.2)]
    return [base, *brush]


def hawkbit(
    at: np.ndarray, face: np.ndarray, size: float, rng: np.random.Generator
) -> list[Leaves]:
    """Return a hawkbit: many narrow yellow rays, in two rows."""
    rows = [(20, 0.95, 0.0), (14, 0.6, 0.45)]
    return [rays(at, face, n, s * size, 0.24, BUTTER * 0.95, rng, r) for n, s, r in rows]


def umbel(at: np.ndarray, face: np.ndarray, size: float, rng: np.random.Generator) -> list[Leaves]:
    """Return a wild carrot: a shallow umbel of small white clusters on green spokes.

    It is tilted towards the viewer, who looks down on it: edge-on it would be a white dash.
    """
    n, sideways = 22, np.array([face[0], 0.0, 0.0])
    middle = unit(TILT * UP + VIEWER + 0.5 * sideways)[None]
    far = size * np.sqrt((np.arange(n) + 0.5) / n)
    way = whorl(np.repeat(middle, n, axis=0), np.arange(n) * 2.4 + rng.uniform(0, 6))
    tops = at + way * far[:, None] + middle * (0.20 * size - 0.20 * far * far / size)[:, None]

    foot = at - 0.55 * size * UP
    spokes = kites(
        np.tile(foot, (n, 1)),
        tops - foot,
        np.tile(VIEWER, (n, 1)),
        np.linalg.norm(tops - foot, axis=1),
        0.012,
        STEM,
    )

    each = 9
    around = whorl(np.repeat(middle, each * n, axis=0), rng.uniform(0, 6.3, each * n))
    florets = np.repeat(tops, each, axis=0)
    florets = florets + around * (0.12 * size * np.sqrt(rng.random(each * n)))[:, None]
    light = np.repeat(rng.uniform(0.72, 1.05, n), each) * rng.uniform(0.85, 1.1, each * n)
    shade = CREAM * (light * (0.9 + 0.25 * np.repeat(way[:, 1], each)))[:, None]
    return [spokes, kites(florets, around, middle + 0 * around, 0.21 * size, 0.21 * size, shade)]
