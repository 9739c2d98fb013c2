"""The coat of a deer: colours and markings, fur, lighting, and the finished sprite.

The fur is a line integral convolution of white noise (Cabral and Leedom 1993) along the hair
direction, which follows the axes of the cones. :mod:`landscape.studio.cones` traces the body at
three times the final resolution.
"""

from dataclasses import dataclass

import numpy as np
from numba import njit
from scipy import ndimage

from landscape.studio.cones import CELL, Model, bake, trace
from landscape.studio.images import shrink, smoothstep
from landscape.studio.light import GROUND_BOUNCE, OVERHEAD, SKY_COLOR, SPRITE_SUN, SUN_COLOR
from landscape.studio.plants.foliage import sprite

SIZE = 512
SUPERSAMPLING = 3
SUN_GAIN = 2.2  # chosen: similar to the trees
SKY_GAIN = 0.95  # chosen

# Linear colours of the summer coat of Cervus elaphus, chosen by eye.
COAT = (0.140, 0.078, 0.042)
MANE = (0.060, 0.040, 0.028)
LEG = (0.096, 0.065, 0.044)
PALE = (0.33, 0.255, 0.178)
TAIL = (0.150, 0.094, 0.056)
RUMP = (0.45, 0.355, 0.235)
STRIPE = (0.092, 0.058, 0.036)
FACE = (0.126, 0.080, 0.050)
DARK = (0.018, 0.015, 0.013)
HOOF = (0.028, 0.024, 0.021)
HORN = (0.125, 0.085, 0.052)
IVORY = (0.50, 0.43, 0.32)
EYE = (0.010, 0.007, 0.005)


@dataclass
class Traced:
    """The output of :func:`trace`: one value per sample, (side, side) or (side, side, k)."""

    hit: np.ndarray
    x: np.ndarray
    y: np.ndarray
    normal: np.ndarray
    albedo: np.ndarray
    along: np.ndarray  # direction of the hair on the screen, a unit vector or 0
    hair: np.ndarray  # length of the hair, 0 to 1
    sun: np.ndarray  # fraction of the sun that is visible
    sky: np.ndarray  # fraction of the sky that is visible


def trace_model(model: Model, towards: np.ndarray = SPRITE_SUN) -> Traced:
    """Trace a model scaled to fill the square, with its hooves on the last row.

    ``towards`` (3,) is the direction of the sun.
    """
    cones = np.array(model.cones)
    ends = np.concatenate([cones[:, 0:4], cones[:, 4:8]])
    left, right = (ends[:, 0] - ends[:, 3]).min(), (ends[:, 0] + ends[:, 3]).max()
    height = (ends[:, 1] + ends[:, 3]).max()
    span = max(height / 0.965, (right - left) / 0.95)
    left = (left + right - span) / 2

    low = np.array([left, -0.1, -0.5])
    shape = tuple(int(np.ceil(s / CELL)) for s in (span, height + 0.2, 1.0))
    grid = bake(cones, low, shape, CELL)

    side = SIZE * SUPERSAMPLING
    colours = np.array(model.colours)
    out = trace(cones, colours, side, left, span, span / side, grid, low, CELL, towards)
    hit = out[..., 0] > 0
    along = np.stack([out[..., 10], 0.25 - out[..., 11]], -1)  # gravity pulls the hair down
    along *= hit[..., None] / (np.linalg.norm(along, axis=-1, keepdims=True) + 1e-9)
    return Traced(
        hit,
        out[..., 1],
        out[..., 2],
        out[..., 4:7],
        out[..., 7:10],
        along,
        out[..., 12],
        out[..., 13],
        out[..., 14],
    )


@njit
def convolve_along(noise, along, steps):  # type: ignore[no-untyped-def]
    """Return the line integral convolution of noise (h, w) along screen directions (h, w, 2)."""
    h, w = noise.shape
    out = np.zeros((h, w))
    for row in range(h):
        for column in range(w):
            if along[row, column, 0] == 0.0 and along[row, column, 1] == 0.0:
                continue
            total = 0.0
            for sign in (-1.0, 1.0):
                x, y = column + 0.5, row + 0.5
                for _ in range(steps):
                    i, j = int(y), int(x)
                    if i < 0 or j < 0 or i >= h or j >= w:
                        break
                    total += noise[i, j]
                    x += sign * along[i, j, 0]
                    y += sign * along[i, j, 1]
            out[row, column] = total / np.sqrt(2.0 * steps)

    return out


@njit
def draw_hairs(colour, covered, starts, directions, lengths, tints):  # type: ignore[no-untyped-def]
    """Draw single hairs into ``colour`` (h, w, 3) and ``covered`` (h, w), in place.

    Each hair starts at ``starts`` (n, 2: row, column) and follows ``directions`` (n, 2) for
    ``lengths`` (n,) samples, from the colour of its root to that times ``tints`` (n,).
    """
    h, w = covered.shape
    for i in range(starts.shape[0]):
        row, column = starts[i]
        y, x = row + 0.5, column + 0.5
        wx, wy = directions[i]
        for k in range(lengths[i]):
            fraction = k / lengths[i]
            for side in range(2 if fraction < 0.6 else 1):
                r, c = int(y - side * wx), int(x + side * wy)
                if r < 0 or c < 0 or r >= h or c >= w:
                    continue
                covered[r, c] = 1.0
                for j in range(3):
                    colour[r, c, j] = colour[row, column, j] * (1.0 + (tints[i] - 1.0) * fraction)
            wy += 0.02
            x += wx
            y += wy


def paint_coat(traced: Traced, mane: float) -> np.ndarray:
    """Paint the markings of a red deer onto the albedo, in place.

    ``mane`` (0 to 1) is the strength of the neck's colour. Returns the mask of the long hair,
    (side, side) in 0..1.
    """
    x = traced.x
    y = traced.y
    up = traced.normal[..., 1]

    def paint(colour: tuple[float, float, float], amount: np.ndarray) -> None:
        weight = (amount * (traced.hair > 0.5))[..., None]
        traced.albedo += (np.array(colour) - traced.albedo) * weight

    body = smoothstep(-0.52, -0.38, x) * smoothstep(0.50, 0.56, y)
    belly = smoothstep(0.25, 0.85, -up) * body
    back = smoothstep(0.75, 0.98, up) * body * smoothstep(0.9, 0.97, y)
    off_rump = np.hypot((x - 0.60) * 1.2, (y - 0.79) * 0.85)
    rump = smoothstep(0.19, 0.10, off_rump) * smoothstep(
        0.92, 0.98, traced.hair
    )  # excludes the tail
    thigh = smoothstep(0.57, 1.02, x) * smoothstep(0.68, 0.60, y) * smoothstep(0.45, 0.55, y)
    throat = smoothstep(0.05, 0.7, -up) * smoothstep(0.84, 0.92, y) * smoothstep(-0.40, -0.46, x)
    ruff = smoothstep(-0.20, -0.37, x) * smoothstep(0.62, 0.74, y) * smoothstep(1.36, 1.22, y)
    paint(PALE, 0.75 * belly)
    paint(STRIPE, 0.6 * back)
    paint(RUMP, rump)
    paint(PALE, 0.55 * thigh)
    paint(PALE, (0.6 - 0.36 * mane) * throat)
    paint(MANE, mane * ruff)
    return mane * ruff


def grow_fur(traced: Traced, long_hair: np.ndarray, rng: np.random.Generator) -> None:
    """Modulate albedo and normals by convolved noise at the scale of hairs, locks and patches."""

    def noise(blur: float) -> np.ndarray:
        return ndimage.gaussian_filter(rng.standard_normal(traced.hit.shape), blur)

    fine = convolve_along(noise(0.8), traced.along, 9)
    locks = convolve_along(noise(2.5), traced.along, 24)
    patches = noise(22)
    fur = fine / fine[traced.hit].std() + (0.4 + long_hair) * 0.8 * locks / locks[traced.hit].std()
    fur *= traced.hair
    gy, gx = np.gradient(ndimage.gaussian_filter(fur, 0.8))
    traced.normal += 0.30 * np.stack([-gx, gy, np.zeros_like(gx)], -1)
    traced.normal /= np.linalg.norm(traced.normal, axis=-1, keepdims=True) + 1e-9
    tone = 0.13 * fur + 0.07 * patches / patches.std() * traced.hair
    traced.albedo *= np.clip(1.0 + tone, 0.3, 2.0)[..., None]


def deepen(traced: Traced) -> None:
    """Darken back, legs and neck, and let less of the sky reach the folds, in place.

    Seen from afar, these contrasts make a body of what is otherwise one brown.
    """
    x = traced.x
    y = traced.y
    up = traced.normal[..., 1]
    furry = traced.hair > 0.5
    saddle = smoothstep(0.05, 0.80, up) * smoothstep(0.70, 0.92, y) * smoothstep(-0.75, -0.35, x)
    flank = smoothstep(0.88, 0.72, y) * smoothstep(0.52, 0.66, y) * (0.5 + 0.5 * np.abs(up))
    legs = smoothstep(0.56, 0.34, y)
    tone = (1.0 - 0.62 * saddle) * (1.0 + 0.35 * flank) * (1.0 - 0.50 * legs)
    traced.albedo *= np.where(furry, tone, 1.0)[..., None] * np.array([1.06, 1.0, 0.92])
    traced.sky = traced.sky**1.7
    # Skin that faces the ground gets less of the sky than the open lawn below it would give.
    traced.sky *= 1.0 - 0.5 * smoothstep(0.0, 0.8, -up)


def shade(
    traced: Traced,
    towards: np.ndarray = SPRITE_SUN,
    sun_gain: float = SUN_GAIN,
    sky_gain: float = SKY_GAIN,
) -> np.ndarray:
    """Shade the samples: sun, sky, ground bounce, and gloss of eyes, nose, hooves and antlers.

    ``towards`` (3,) is the direction of the sun.
    """
    up, front = traced.normal[..., 1], np.clip(traced.normal[..., 2], 0, 1)
    sun = np.clip((traced.normal @ towards + 0.12) / 1.12, 0, 1) * traced.sun
    sky = (0.55 + 0.45 * up) * traced.sky
    ground = (0.5 - 0.5 * up) * traced.sky
    half = towards + np.array([0.0, 0.0, 1.0])
    gloss = np.maximum(traced.normal @ (half / np.linalg.norm(half)), 0)
    bare = 1.0 - smoothstep(0.2, 0.6, traced.hair)
    shine = (0.05 * gloss**12 + 0.6 * bare * gloss**50) * traced.sun

    # Rim light: hair transmits light at the silhouette.
    shine += 0.10 * (1 - front) ** 3 * traced.hair * np.clip(0.3 + up, 0, 1) * traced.sky
    light = (
        sun_gain * SUN_COLOR * sun[..., None]
        + sky_gain * SKY_COLOR * sky[..., None]
        + 1.3 * GROUND_BOUNCE * ground[..., None]
    )
    return traced.albedo * light + SUN_COLOR * shine[..., None]


def render(model: Model, seed: int, mane: float, deep: bool = False) -> np.ndarray:
    """Trace, paint and shade a model; return the sprite, uint8 (512, 512, 4).

    With ``deep`` the coat has stronger contrasts, in the light of
    :mod:`landscape.studio.plants.individuals`.
    """
    rng = np.random.default_rng(seed)
    light = (OVERHEAD, 2.9, 0.72) if deep else (SPRITE_SUN, SUN_GAIN, SKY_GAIN)
    traced = trace_model(model, light[0])
    long_hair = paint_coat(traced, mane)
    if deep:
        deepen(traced)
    grow_fur(traced, long_hair, rng)
    colour, covered = shade(traced, *light), traced.hit.astype(float)

    # Single hairs over the silhouette and the mane, because fur has no sharp edge.
    edge = traced.hit & (ndimage.distance_transform_edt(traced.hit) < 5) & (traced.hair > 0.6)
    chance = np.maximum(0.25 * edge, 0.05 * long_hair)
    roots = np.nonzero(rng.random(chance.shape) < chance)
    directions = traced.along[roots] + 0.30 * traced.normal[roots][:, :2] * np.array([1.0, -1.0])
    directions += 0.15 * rng.standard_normal(directions.shape)
    directions /= np.linalg.norm(directions, axis=1, keepdims=True) + 1e-9
    shaggy = smoothstep(0.75, 1.0, traced.hair[roots]) * smoothstep(0.45, 0.7, traced.y[roots])
    reach = 2.0 + 4.0 * shaggy + 13.0 * long_hair[roots]
    lengths = (reach * rng.uniform(0.5, 1.2, len(reach))).astype(np.int64)
    tints = rng.uniform(0.75, 1.35, len(reach))
    draw_hairs(colour, covered, np.stack(roots, 1), directions, lengths, tints)
    premultiplied = np.concatenate([colour * covered[..., None], covered[..., None]], -1)
    return sprite(shrink(premultiplied, SUPERSAMPLING))
