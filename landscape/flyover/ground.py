"""The ground's colours with its light baked in: a picture of the whole field, seen from above.

Sea, sand, grass, forest, rock and snow by height, slope and hollows, with noise where they meet; or
an image that is laid over the field. The sun, its shadows and the light of the sky are multiplied
in, so that a frame only looks colours up. The picture covers the field and its three mirror images:
those are lit by the same sun, which a mirrored picture would not be. Smaller copies of it, each
half as wide, are for the distance: far ground that is looked up in the full picture glitters.
"""

from dataclasses import dataclass

import numpy as np

from landscape.files.images import half_size
from landscape.flyover.noise import noise
from landscape.flyover.sunlight import normals, sky_seen, smooth_step, sun_light


def colour(red: float, green: float, blue: float) -> np.ndarray:
    """Return a colour, sRGB 0..1, as float32 (3,)."""
    return np.array((red, green, blue), np.float32)


# Colours of surfaces and of light, all chosen.
SAND, WET_SAND = colour(0.80, 0.71, 0.52), colour(0.52, 0.44, 0.30)
LUSH = colour(0.29, 0.41, 0.13)
DRY = colour(0.53, 0.50, 0.24)
FOREST = colour(0.12, 0.22, 0.08)
ROCK = colour(0.58, 0.53, 0.48)
DARK_ROCK = colour(0.29, 0.27, 0.26)
SNOW = colour(0.93, 0.95, 0.99)
WARM_ROCK, RED_ROCK, PALE_ROCK = (
    colour(*each) for each in ((0.66, 0.54, 0.40), (0.58, 0.38, 0.27), (0.72, 0.70, 0.66))
)
SNOW_LINE, ALPINE_SNOW_LINE = 0.62, 0.33  # of the land's height; the latter of mountain ranges
SHALLOW = colour(0.16, 0.50, 0.50)
DEEP = colour(0.01, 0.11, 0.20)
FOAM = colour(0.90, 0.94, 0.95)
SUN = colour(1.30, 1.14, 0.90)
SKY = colour(0.34, 0.45, 0.64)
BOUNCE = colour(0.10, 0.085, 0.06)
GREEN, DARK_GREEN = colour(0.13, 0.23, 0.18), colour(0.01, 0.08, 0.075)  # of a plateau's river
WET = 128  # in the highest byte of a texel: there is water
CLEAR = 5.0  # depth at which a third of the bottom is still seen, % of the heights' range, chosen


@dataclass(frozen=True)
class Pyramid:
    """A square picture and its copies of half the size, down to one texel, in one array.

    ``texels`` are uint32, red in the lowest byte. The highest byte is WET plus how much of the
    texel is water, up to 127, or where there is none, how much of it is steep rock, up to 127.
    Level k begins at ``offsets[k]``; level 0 has ``2 ** bits`` texels a side, ``period`` units.
    """

    texels: np.ndarray
    offsets: np.ndarray
    bits: int
    period: float


def mix(one: np.ndarray, other: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Return colours (n, n, 3) blended towards another by weights (n, n)."""
    return np.asarray(one + (other - one) * weight[..., None])


def on_torus(heights: np.ndarray) -> np.ndarray:
    """Return a field (n, n) with its three mirror images, (2n, 2n), as the terrain goes on."""
    n = len(heights)
    index = np.minimum(np.abs((np.arange(2 * n) + n) % (2 * n) - n), n - 1)
    return np.asarray(heights[np.ix_(index, index)])


def resampled(field: np.ndarray, size: int) -> np.ndarray:
    """Return a field on a torus at the centres of (size, size) texels.

    Finer texels are smoothed by a cubic B-spline: the terraces of images of 256 greys are gone.
    """
    n = len(field)
    for _ in range(2):
        if size < n:
            field = field.reshape(size, n // size, -1).mean(1)
        else:
            at = (np.arange(size) + 0.5) * n / size
            knot = np.floor(at).astype(int)
            t = (at - knot).astype(np.float32)[:, None]
            weights = (
                (1 - t) ** 3 / 6,
                (3 * t**3 - 6 * t**2 + 4) / 6,
                (3 * (1 - t) ** 3 - 6 * (1 - t) ** 2 + 4) / 6,
                t**3 / 6,
            )
            field = sum(w * field[(knot + k - 1) % n] for k, w in enumerate(weights))
        field = np.ascontiguousarray(field.T, np.float32)

    return field


def character(heights: np.ndarray, sea: float) -> tuple[float, float]:
    """Return how much a field of heights is a plateau, and how much a mountain range, 0..1 each.

    Most of a plateau is high. Most of a mountain range is low, but little of it is water.
    """
    dry = heights > sea
    if not dry.any():
        return 0.0, 0.0
    high = (heights[dry].mean() - sea) / max(float(heights.max()) - sea, 1e-3)
    plateau = smooth_step(0.35, 0.50, high)
    return float(plateau), float((1 - plateau) * smooth_step(0.5, 0.8, dry.mean()))


def cliffs(heights: np.ndarray, sea: float, steep: np.ndarray) -> np.ndarray:
    """Return how much of the land is bare rock because it is ``steep``, 0..1 (n, n)."""
    up = (heights - np.float32(sea)) / np.float32(max(float(heights.max()) - sea, 1e-3))
    rough = np.float32(0.02) * noise(len(heights), 2, 0.9, 24)
    return smooth_step(0.12, 0.26, steep + rough + 0.1 * smooth_step(0.4, 0.8, up))


def surface(
    heights: np.ndarray, sea: float, steep: np.ndarray, open_sky: np.ndarray, cliff: np.ndarray
) -> np.ndarray:
    """Return the colours of dry land, sRGB 0..1 (n, n, 3), by height, slope, hollows, cliffs.

    Where there is snow there is less ``cliff``, which is changed in place.
    """
    n = len(heights)
    top = max(float(heights.max()) - sea, 1e-3)
    patches, grain = noise(n, 1, 1.5, 6), noise(n, 2, 0.9, 24)
    up = (heights - np.float32(sea)) / np.float32(top)
    level = up + 0.025 * patches + 0.012 * grain
    found = np.empty((n, n, 3), np.float32)
    found[:] = LUSH
    plateau, range_ = character(heights, sea)
    dry = smooth_step(-0.6, 1.4, patches + 2.5 * (up - 0.2) - 0.6 * range_)
    found = mix(found, DRY, dry)
    hollow = smooth_step(0.02, 0.16, 1 - open_sky)
    woods = smooth_step(0.1, 0.5, patches * 0.6 + grain * 0.45 + hollow - 0.5)
    woods *= smooth_step(0.03, 0.07, level) * (1 - smooth_step(0.42, 0.55, level))
    found = mix(found, FOREST, woods * 0.9)
    found = mix(found, DARK_ROCK, smooth_step(0.55, 0.75, level) * 0.5)

    # A cliff's own detail is drawn in each frame, see :mod:`.rock`: here it would become bars.
    found += (stone(n, up, plateau, range_) - found) * cliff[..., None]
    line = SNOW_LINE + (ALPINE_SNOW_LINE - SNOW_LINE) * range_ + plateau
    snow = smooth_step(line, line + 0.12, level + 0.03 * grain - 0.25 * (steep - 0.1))
    holds = 0.16 * range_ + 0.04 * grain
    snow *= 1 - smooth_step(0.30, 0.48, steep - holds)
    found = mix(found, SNOW, snow)
    cliff *= 1 - 0.8 * snow
    beach = (1 - smooth_step(0.018, 0.045, level)) * (1 - smooth_step(0.10, 0.20, steep))
    found = mix(found, SAND, beach)
    found = mix(found, WET_SAND, 0.8 * (1 - smooth_step(0.0, 0.012, up)) * (1 - cliff))
    return np.asarray(found * (1 + 0.05 * grain * (1 - cliff))[..., None])


def stone(size: int, up: np.ndarray, plateau: float, range_: float) -> np.ndarray:
    """Return the colours of bare rock, sRGB 0..1 (n, n, 3): by place, and by height ``up`` (n, n).

    That of a plateau is warm, in wide bands; that of a mountain range (``range_``) is grey.
    """
    places, others = noise(size, 5, 1.4, 3), noise(size, 6, 1.2, 5)
    warm = smooth_step(-1.2, 1.2, places + 1.2 * plateau - 2.2 * range_)
    found = mix(np.broadcast_to(ROCK, (size, size, 3)), WARM_ROCK, warm)
    red = smooth_step(0.2, 1.6, others + np.sin(9 * up + places) - 0.4)
    found = mix(found, RED_ROCK, red * (0.35 + 0.4 * plateau) * (1 - range_))
    pale = smooth_step(0.2, 1.8, np.sin(7 * up + 0.7 * others + 2) - 0.5 * others + 0.6 * range_)
    found = mix(found, PALE_ROCK, 0.7 * pale)
    return mix(found, DARK_ROCK, 0.45 * smooth_step(0.6, 1.8, -others))


def bake(
    heights: np.ndarray,
    size: int,
    sea: float,
    towards: np.ndarray,
    image: np.ndarray | None = None,
    shadows: bool = True,
    occlusion: bool = True,
) -> Pyramid:
    """Return the picture of a field of heights (n, n), ``size`` texels a side for 2 n units.

    ``sea`` is the water's height, ``towards`` (3,) points to the sun; ``image`` (h, w, 3) uint8
    covers the field instead of the colours by height.
    """
    period = 2 * len(heights)
    rough = resampled(on_torus(np.asarray(heights, np.float32)), size)
    range_ = max(float(np.ptp(rough)), 1e-3)
    scale = size / period
    wet = smooth_step(0.0, 0.006 * range_, np.float32(sea) - rough)
    land = np.maximum(rough, np.float32(sea))

    # Of the ground below the water, too: a wall is one down to its foot.
    plain = normals(rough * np.float32(scale))[2]
    cliff = cliffs(rough, sea, 1 - plain) * (1 - wet)
    bumps = noise(size, 3, 1.2, size / 24) * (0.12 + 1.6 * (1 - plain)) * (1 - cliff)
    x, y, z = normals((land + np.float32(0.35) * bumps) * np.float32(scale))
    seen = sky_seen(land * np.float32(scale)) if occlusion else np.ones_like(land)
    lit = np.clip(x * towards[0] + y * towards[1] + z * towards[2], 0, 1)
    if shadows:
        lit *= sun_light(land * np.float32(scale), towards)
    if image is None:
        base = surface(rough, sea, 1 - plain, seen, cliff)
    else:
        base = laid_over(image, size)
        cliff[:] = 0

    depth = np.clip(np.float32(sea) - rough, 0, None) / np.float32(CLEAR / 100 * range_)
    river = np.float32(character(heights, sea)[0])
    shallow, deep = SHALLOW + (GREEN - SHALLOW) * river, DEEP + (DARK_GREEN - DEEP) * river
    water = mix(mix(base, shallow, 1 - np.exp(-4 * depth)), deep, 1 - np.exp(-0.8 * depth))
    foam = smooth_step(0.5, 1.6, noise(size, 4, 0.6, 40)) * np.exp(-((depth * 22 - 1) ** 2))
    water = mix(water, FOAM, 0.7 * foam)
    base = base + (water - base) * wet[..., None]
    light = SUN * lit[..., None] + SKY * (seen * (0.5 + 0.5 * z))[..., None]
    light += BOUNCE * (1 - 0.5 * z)[..., None]
    bright = np.clip(base, 0, 1) ** 2.2 * light
    shown = (bright * (1 + bright / 6) / (1 + bright)) ** np.float32(1 / 2.2) * np.float32(1.10)
    return pyramid(np.clip(shown, 0, 1), wet, cliff, period)


def laid_over(image: np.ndarray, size: int) -> np.ndarray:
    """Return an image (h, w, 3) uint8 of the field and its mirror images, 0..1 (size, size, 3)."""
    h, w = image.shape[:2]
    at = np.abs((np.arange(size) + 0.5) / size * 2 - 1)
    at = 1 - at  # 0 to 1 and back to 0
    rows, columns = (np.minimum((at * k).astype(int), k - 1) for k in (h, w))
    return np.asarray(image[np.ix_(rows, columns)][..., :3] / np.float32(255))


def pyramid(colour: np.ndarray, wet: np.ndarray, cliff: np.ndarray, period: float) -> Pyramid:
    """Return colours (n, n, 3), water and cliffs (n, n), all 0..1, as a pyramid.

    n is a power of two.
    """
    level: np.ndarray = np.concatenate([colour, wet[..., None], cliff[..., None]], 2)
    level = level.astype(np.float32)
    parts = []
    offsets = []
    at = 0
    bits = len(level).bit_length() - 1

    while True:
        packed = (level[..., :4] * (255, 255, 255, 127) + 0.5).astype(np.uint8)
        dry = (level[..., 4] * 127 + 0.5).astype(np.uint8)
        packed[..., 3] = np.where(packed[..., 3] > 0, packed[..., 3] + WET, dry)
        parts.append(packed.view(np.uint32).ravel())
        offsets.append(at)
        at += parts[-1].size
        if len(level) == 1:
            return Pyramid(np.concatenate(parts), np.array(offsets), bits, period)
        level = half_size(level)
