"""The hall's baked light, made into one picture: the sheets of landscape/hall/light.py.

The steps of the bake, from direct light over three bounces to the denoised parts, and how bright
and how coloured each light is in the end.
"""

import hashlib
from collections.abc import Callable
from functools import cache

import numpy as np
from scipy import ndimage

from landscape.elements.sun import direction
from landscape.hall import plan
from landscape.hall.light import (
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
from landscape.hall.settings import Settings
from landscape.studio.hall.light import (
    ALBEDO,
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
    masonry,
    parts,
    portals,
    statue,
    texels,
    triangles,
)

# Chosen: colour and strength of each light, so that 1 shows a texture as it is painted.
COLOURS = {
    SUN: SUN_COLOUR,
    SKY: (2.3, 3.0, 4.3),
    TORCH: TORCH_COLOUR,
    TORCHES: (0.017, 0.0076, 0.0025),
}
# Chosen: fraction of each light's reflections that is kept; less leaves deeper shades.
BOUNCED = {SUN: 0.16, SKY: 0.8, TORCH: 0.4, TORCHES: 0.4}
AMBIENT = (0.018, 0.020, 0.026)  # chosen: what no ray finds, so that nothing is black
SPREAD = {SUN: 0.45, SKY: 1.3, TORCH: 0.7, TORCHES: 0.9}  # chosen: blur of direct light, in texels
SOFT = 2.2  # chosen: blur of reflected light, in texels
OPEN = 0.7  # chosen: a texel with fewer rays in the open lies inside a wall
RAYS = 96, 32, 32  # chosen: of each bounce, at every second texel
REACH = 0.25  # chosen: beyond it the torch's light falls with the distance, not with its square
SEED = 2006
PRECISE = 2000.0  # chosen: steps per unit by which geometry is told apart


def smoothed(
    values: np.ndarray, weight: np.ndarray, parts: list[tuple[slice, slice]], spread: float
) -> np.ndarray:
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
    # Blockers of light without a light map. The statue's shadows on floor and north wall are drawn
    # live, so that only the other surfaces, the plinth above all, get their direct light past it.
    outside, bronze = masonry(), statue()
    plain, _ = as_scene(np.concatenate([corners, outside]))
    more = np.concatenate([outside, bronze])
    scene, order = as_scene(np.concatenate([corners, more]))
    sun = direction(Settings().sun).astype(float)
    flames = np.array([plan.TORCH, *plan.PILLAR_TORCHES]) + (0.0, FLAME[1], 0.0)
    canvas = np.zeros((CANVAS[1], CANVAS[0], len(LIGHTS), 3), np.float32)
    known = np.zeros(canvas.shape[:2], bool)
    column, row = at.T
    found = np.zeros((len(place), len(LIGHTS), 3))
    shadowless = column >= ORIGINS["floor"][0]
    for past, those in ((scene, ~shadowless), (plain, shadowless)):
        here = np.ascontiguousarray(place[those]), np.ascontiguousarray(normal[those])
        found[those] = direct(past, *here, sun, portals(), flames, 0, SEED)
    # The shadow of the statue on the north wall is worth more than the inverse square.
    far = np.linalg.norm(place - flames[0], axis=1)
    found[:, TORCH] *= (np.maximum(far, REACH) / REACH)[:, None]
    canvas[row, column] = found
    known[row, column] = True

    uv = np.concatenate([uv, np.zeros((len(more), 3, 2))])[order]
    colour = np.concatenate([colour, np.full((len(more), 3), -1.0)])[order]
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
    # Rounded to 11 bits, so that another processor's last bits rarely change a byte.
    return np.stack([filled(canvas, known), total]).astype(np.float16).astype(np.float32)


def hall_light() -> np.ndarray:
    """Return the picture of all sheets and parts, uint8 (PICTURE, PICTURE, 3)."""
    straight, reflected = baked()
    both = np.zeros_like(straight[..., 0, :]) + np.array(AMBIENT)
    for light, colour in COLOURS.items():
        arrived = straight[..., light, :] + BOUNCED[light] * reflected[..., light, :]
        both = both + arrived * np.array(colour)
    picture = np.zeros((PICTURE, PICTURE, 3), np.uint8)

    def put(place: tuple[int, int], sheet: str, image: np.ndarray) -> None:
        x, y = place
        width, height = SIZES[sheet]
        u, v = ORIGINS[sheet]
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


def baked_from() -> str:
    """Return a digest of what light is baked from: surfaces and their charts, openings, lights.

    It is written into the picture, so that a picture that is older than the hall is found.
    """
    corners, uv, _ = triangles()
    sun = direction(Settings().sun).astype(float)
    lights = np.array([sun, plan.TORCH, *plan.PILLAR_TORCHES])
    digest = hashlib.sha256()
    for array in (corners, uv, masonry(), statue(), portals(), lights):
        # Not rounded at round numbers, where another processor's last bits would decide.
        digest.update(np.floor(np.asarray(array, float) * PRECISE + 0.1234).astype("<i4").tobytes())
    chosen = (COLOURS, BOUNCED, AMBIENT, SPREAD, SOFT, OPEN, RAYS, REACH, SEED, ALBEDO, SIZES)
    digest.update(repr(chosen).encode())
    return digest.hexdigest()[:16]


ASSETS: dict[str, Callable[[], np.ndarray]] = {FILE: hall_light}
TEXTS = {FILE: baked_from}  # what build.py writes into a PNG beside its pixels
