"""The hall's baked light, made into one picture: the sheets of landscape/effects/light.py.

The steps of the bake, from direct light over three bounces to the denoised parts, and how bright
and how coloured each light is in the end.
"""

from collections.abc import Callable
from functools import cache

import numpy as np
from scipy import ndimage

from landscape.effects import plan
from landscape.effects.light import (
    BASE_MOST,
    BASES,
    FILE,
    HALL,
    PARTS,
    PICTURE,
    SIZES,
    SUN_COLOUR,
    SUN_MOST,
    TORCH_COLOUR,
    TORCH_MOST,
    coded,
    packed,
)
from landscape.effects.settings import Settings
from landscape.elements.sun import direction
from landscape.studio.hall_light import (
    CANVAS,
    FLAME,
    LIGHTS,
    ORIGINS,
    SKY,
    SUN,
    TORCH,
    TORCHES,
    as_scene,
    direct,
    gather,
    parts,
    portals,
    statue_stand_in,
    texels,
    triangles,
)

# Chosen: colour and strength of each light, so that 1 shows a texture as it is painted.
COLOURS = {
    SUN: SUN_COLOUR, SKY: (2.6, 2.9, 3.4), TORCH: TORCH_COLOUR, TORCHES: TORCH_COLOUR,
}  # fmt: skip
AMBIENT = (0.018, 0.020, 0.026)  # chosen: what no ray finds, so that nothing is black
SPREAD = {SUN: 0.45, SKY: 1.3, TORCH: 0.7, TORCHES: 0.9}  # chosen: blur of direct light, in texels
SOFT = 2.2  # chosen: blur of reflected light, in texels
OPEN = 0.7  # chosen: a texel with fewer rays in the open lies inside a wall
RAYS = 96, 32, 32  # chosen: of each bounce, at every second texel
SEED = 2006


def smoothed(values: np.ndarray, weight: np.ndarray, parts: list[tuple[slice, slice]],
             spread: float) -> np.ndarray:  # fmt: skip
    """Return values (h, w, ...) blurred within each part, weighted by ``weight`` (h, w)."""
    out = values.copy()
    sigma = (spread, spread, *(0,) * (values.ndim - 2))
    for part in parts:
        some = weight[part]
        if not some.any():
            continue
        wide = some.reshape(some.shape + (1,) * (values.ndim - 2))
        total = ndimage.gaussian_filter(values[part] * wide, sigma, mode="nearest")
        share = ndimage.gaussian_filter(wide, sigma, mode="nearest")
        out[part] = total / np.maximum(share, 1e-4)
    return out


def filled(values: np.ndarray, known: np.ndarray) -> np.ndarray:
    """Return values (h, w, ...) with each unknown texel like the nearest known one."""
    rows, columns = ndimage.distance_transform_edt(
        ~known, return_distances=False, return_indices=True
    )
    return values[rows, columns]


@cache
def baked() -> np.ndarray:
    """Return direct and reflected light, float32 (2, h, w, 4, 3), on the canvas."""
    place, normal, at = texels()
    corners, uv, colour = triangles()
    plain, _ = as_scene(corners)
    sun = direction(Settings().sun).astype(float)
    flames = np.array([plan.TORCH, *plan.PILLAR_TORCHES]) + (0.0, FLAME[1], 0.0)
    canvas = np.zeros((CANVAS[1], CANVAS[0], len(LIGHTS), 3), np.float32)
    known = np.zeros(canvas.shape[:2], bool)
    column, row = at.T
    canvas[row, column] = direct(plain, place, normal, sun, portals(), flames, 0, SEED)
    known[row, column] = True

    # Where the statue stands, something blocks the reflected light.
    ball = statue_stand_in()
    scene, order = as_scene(np.concatenate([corners, ball]))
    uv = np.concatenate([uv, np.zeros((len(ball), 3, 2))])[order]
    colour = np.concatenate([colour, np.full((len(ball), 3), -1.0)])[order]
    some = (column % 2 == 0) & (row % 2 == 0)
    place, normal = np.ascontiguousarray(place[some]), np.ascontiguousarray(normal[some])
    column, row = column[some], row[some]
    charts = parts()
    glow, total = filled(canvas, known), np.zeros_like(canvas)
    for bounce, count in enumerate(RAYS):
        light, opened = gather(scene, uv, colour, glow, place, normal, count, SEED + bounce)
        glow, weight = np.zeros_like(canvas), np.zeros(known.shape, np.float32)
        glow[row, column], weight[row, column] = light, opened > OPEN
        if bounce == 0:
            buried = np.zeros(known.shape, bool)
            buried[row, column] = opened <= OPEN
            known &= ~ndimage.maximum_filter(buried, 2, origin=-1)
        glow = smoothed(glow, weight, charts, SOFT)
        reached = smoothed(weight, np.ones_like(weight), charts, SOFT) > 0.02
        glow = filled(glow, known & reached)
        total += glow
    for number, width in SPREAD.items():
        one = canvas[..., number, :]
        canvas[..., number, :] = smoothed(one, known.astype(np.float32), charts, width)
    return np.stack([filled(canvas, known), total])


def hall_light() -> np.ndarray:
    """Return the picture of all sheets and parts, uint8 (PICTURE, PICTURE, 3)."""
    straight, reflected = baked()
    light = {k: (straight[..., k, :] + reflected[..., k, :]) * c for k, c in COLOURS.items()}
    both = sum(light.values()) + np.array(AMBIENT)
    picture = np.zeros((PICTURE, PICTURE, 3), np.uint8)

    def put(place: tuple[int, int], sheet: str, image: np.ndarray) -> None:
        (x, y), (width, height), (u, v) = place, SIZES[sheet], ORIGINS[sheet]
        picture[y : y + height, x : x + width] = image[v : v + height, u : u + width]

    put(HALL, "hall", coded(both))
    sun, torch = straight[..., SUN, 0], straight[..., TORCH, 0]
    without = both - sun[..., None] * COLOURS[SUN] - torch[..., None] * COLOURS[TORCH]
    apart = np.stack([packed(sun, SUN_MOST), packed(torch, TORCH_MOST)], axis=-1)
    apart = np.concatenate([apart, np.zeros_like(apart[..., :1])], axis=-1)
    for sheet in BASES:
        put(BASES[sheet], sheet, packed(without, BASE_MOST))
        put(PARTS[sheet], sheet, apart)
    return picture


ASSETS: dict[str, Callable[[], np.ndarray]] = {FILE: hall_light}
