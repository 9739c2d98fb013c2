"""The castle's masonry textures: ashlar wall, torch light, and carved stone of the torches.

The stone textures are height fields with a colour per stone, with baked lighting from the upper
left (Lambert shading of the height's gradient, occlusion from its blur), drawn larger and
downsampled. Lengths are in tile sides, so the formulas do not depend on the resolution. The gate is
in :mod:`landscape.studio.castle.gate`.
"""

from collections.abc import Callable

import numpy as np
from scipy import ndimage

from landscape.studio.images import shrink, smoothstep, spectral_noise, to_srgb, to_uint8

OVERSAMPLE = 2  # supersampling factor
LIGHT = np.array([-0.52, 0.58, 0.63])  # chosen: from the upper left; x right, y up, z to the viewer
SKY_FILL = 0.52  # chosen: fraction of the light that is ambient

COURSES = 8  # chosen: courses per tile, 32 on a wall of 17 m
PER_COURSE = 4  # chosen: stones per course, so that a stone is twice as long as high
JOINT = 0.0055  # chosen: half width of a mortar joint, tile sides
# Chosen: linear albedos that are mixed at random for each stone, grey to beige.
STONES = np.array(
    [[0.300, 0.268, 0.215], [0.335, 0.285, 0.212], [0.262, 0.250, 0.220], [0.368, 0.322, 0.250]]
)
MORTAR = np.array([0.300, 0.272, 0.222])  # chosen

# The torches, in wall widths from the left and from the bottom, where the report has its fires.
TORCHES = ((0.27, 0.28), (0.75, 0.28))
AMBIENT = np.array([0.79, 0.80, 0.84])  # chosen: multiplier away from the torches, by day
HALO = np.array([1.00, 0.97, 0.85])  # chosen: multiplier at the flame


def slopes(height: np.ndarray, per_unit: float, mode: str) -> tuple[np.ndarray, np.ndarray]:
    """Return the slopes of a height field to the right and upward, each (h, w)."""
    d_x = ndimage.correlate1d(height, [-0.5, 0.0, 0.5], axis=1, mode=mode) * per_unit
    d_y = ndimage.correlate1d(height, [0.5, 0.0, -0.5], axis=0, mode=mode) * per_unit
    return d_x, d_y


def light_relief(height: np.ndarray, per_unit: float, radius: float, tile: bool) -> np.ndarray:
    """Return the light on a height field, (h, w), 1 on a flat surface.

    ``height`` and ``radius`` (of the occlusion) are in units of ``per_unit`` texels; row 0 is the
    top. ``tile`` says whether the texture wraps.
    """
    mode = "wrap" if tile else "nearest"
    d_x, d_y = slopes(height, per_unit, mode)
    normal_z = 1.0 / np.sqrt(1.0 + d_x**2 + d_y**2)
    light = LIGHT / np.linalg.norm(LIGHT)
    sun = np.clip((-d_x * light[0] - d_y * light[1] + light[2]) * normal_z, 0.0, None) / light[2]
    reach = radius * per_unit
    sunk = sum(ndimage.gaussian_filter(height, reach * s, mode=mode) - height for s in (0.35, 1.0))
    occlusion = np.exp(-np.clip(sunk, 0.0, None) / radius * 1.1)
    return ((1.0 - SKY_FILL) * sun * (0.5 + 0.5 * occlusion) + SKY_FILL * normal_z**0.5) * occlusion


def tile_axes(size: int) -> tuple[np.ndarray, np.ndarray]:
    """Return x (right) and y (up) at the texel centres, each (size, size), in 0..1."""
    axis = (np.arange(size) + 0.5) / size
    return np.broadcast_to(axis, (size, size)), np.broadcast_to(axis[::-1, None], (size, size))


def finish(linear: np.ndarray) -> np.ndarray:
    """Downsample a linear image by OVERSAMPLE and encode it as sRGB."""
    return to_uint8(to_srgb(shrink(linear, OVERSAMPLE)))


def castle_brick() -> np.ndarray:
    """Return the wall tile, uint8 (512, 512, 3): eight courses in running bond."""
    size = 512 * OVERSAMPLE
    rng = np.random.default_rng(1066)
    x, y = tile_axes(size)
    fine = spectral_noise(size, 1.1, 11, low_cut=24.0)
    rough = spectral_noise(size, 1.6, 12, low_cut=10.0)
    soft = spectral_noise(size, 1.9, 13, low_cut=3.0)
    # Hand-cut stones have no straight edges: warp the plane before dividing it into courses.
    x_warped = x + 0.0013 * rough + 0.0010 * soft
    y_warped = y + 0.0013 * spectral_noise(size, 1.6, 14, low_cut=10.0)
    course = np.floor(y_warped * COURSES).astype(int)
    up = y_warped * COURSES - course
    course %= COURSES
    # Joints in running bond, each shifted a little, because the stones vary in length.
    joints = (np.arange(PER_COURSE)[None, :] + 0.5 * (np.arange(COURSES) % 2)[:, None]) / PER_COURSE
    joints = joints + rng.uniform(-0.030, 0.030, joints.shape)
    joints = np.sort(joints % 1.0, axis=1)
    padded = np.concatenate([joints[:, -1:] - 1.0, joints, joints[:, :1] + 1.0], axis=1)
    number = np.zeros((size, size), dtype=int)
    for j in range(1, PER_COURSE + 1):
        number += x_warped >= padded[course, j]
    left, right = padded[course, number], padded[course, number + 1]
    stone = course * PER_COURSE + number % PER_COURSE
    half_w, half_h = (right - left) / 2, 0.5 / COURSES
    p_x = np.abs(x_warped - (left + right) / 2) - half_w
    p_y = np.abs(up / COURSES - half_h) - half_h
    corner = 0.012
    inside = -(
        np.hypot(np.maximum(p_x + corner, 0.0), np.maximum(p_y + corner, 0.0))
        + np.minimum(np.maximum(p_x, p_y) + corner, 0.0)
        - corner
    )
    # Chips in the edges, where a noise is high.
    chip = 0.0042 * smoothstep(0.9, 2.2, spectral_noise(size, 1.3, 15, low_cut=12.0))
    inside = inside - JOINT - chip
    count = COURSES * PER_COURSE
    lean = rng.normal(0.0, 0.045, (count, 2))
    height = 0.0075 * (1.0 - np.exp(-np.clip(inside, 0.0, None) / 0.0055))
    face = smoothstep(0.0, 0.008, inside)
    height += face * (
        lean[stone, 0] * (x_warped - (left + right) / 2) * 0.5
        + lean[stone, 1] * (up / COURSES - half_h)
        + rng.uniform(-0.0012, 0.0012, count)[stone]
        + 0.00075 * rough
        + 0.0011 * soft
        - 0.0022 * smoothstep(1.5, 2.6, spectral_noise(size, 0.9, 16, low_cut=20.0))
    )
    height += 0.00028 * fine + (1.0 - face) * 0.0006 * rough
    shade = light_relief(height, size, 0.012, tile=True)

    mix = rng.dirichlet(np.full(len(STONES), 0.8), count) @ STONES
    mix *= rng.normal(1.0, 0.075, (count, 1))
    albedo = mix[stone] * (1.0 + 0.07 * soft + 0.05 * fine + 0.04 * rough)[..., None]
    pale = smoothstep(0.6, 2.2, spectral_noise(size, 1.4, 17, low_cut=6.0))[..., None]
    albedo = albedo * (1.0 - 0.25 * pale) + 0.25 * pale * np.array([0.40, 0.38, 0.32])
    cover = smoothstep(-0.0012, 0.0012, inside)[..., None]
    albedo = albedo * cover + (1.0 - cover) * MORTAR * (1.0 + 0.10 * fine + 0.06 * soft)[..., None]
    # Rain streaks: noise stretched along the columns.
    streak = ndimage.gaussian_filter(
        spectral_noise(size, 0.9, 18, low_cut=8.0), (70.0, 3.0), mode="wrap"
    )
    streak = smoothstep(0.2, 2.4, streak / streak.std())[..., None]
    albedo = albedo * (1.0 - 0.30 * streak * np.array([0.8, 0.95, 1.0]))
    moss = smoothstep(1.1, 2.4, soft + 0.5 * rough)[..., None] * (1.0 - 0.7 * cover)
    albedo = albedo * (1.0 - 0.5 * moss) + 0.5 * moss * np.array([0.13, 0.15, 0.07])
    return finish(albedo * shade[..., None])


def castle_light() -> np.ndarray:
    """Return the light of the torches on the gate wall, uint8 (256, 256, 3), a multiplier."""
    x, y = tile_axes(256)
    glow = np.zeros((256, 256))
    for x0, y0 in TORCHES:
        # The halo extends farther upward than downward, like the flame.
        rise = np.where(y > y0, 1.25, 0.95)
        distance = np.hypot(x - x0, (y - y0) / rise) / 0.2
        glow = np.maximum(glow, 0) + np.exp(-1.9 * distance**2) * smoothstep(1.7, 0.6, distance)
    border = np.minimum(np.minimum(x, 1.0 - x), np.minimum(y, 1.0 - y))
    glow = np.clip(glow, 0.0, 1.0) * smoothstep(0.004, 0.06, border)
    return to_uint8(AMBIENT + (HALO - AMBIENT) * glow[..., None])


def torch_stone() -> np.ndarray:
    """Return the tile of the torches, uint8 (256, 256, 3): dark stone carved with a braid."""
    size = 256 * OVERSAMPLE
    x, y = tile_axes(size)
    rough = spectral_noise(size, 1.5, 51, low_cut=8.0)
    fine = spectral_noise(size, 0.9, 52, low_cut=30.0)
    soft = spectral_noise(size, 1.9, 53, low_cut=3.0)
    band = (y * 2.0) % 1.0  # two bands per tile
    middle = band - 0.5
    height = np.full((size, size), -0.012)
    turns = 3
    over = np.cos(2 * np.pi * turns * x)
    for sign in (1.0, -1.0):
        centre = sign * 0.21 * np.sin(2 * np.pi * turns * x)
        slope = sign * 0.21 * turns * 2 * np.pi * np.cos(2 * np.pi * turns * x) * 0.5
        distance = np.abs(middle - centre) / np.sqrt(1.0 + slope**2) / 0.085
        strand = 0.020 * np.sqrt(np.clip(1.0 - distance**2, 0.0, 1.0)) + 0.006 * sign * over
        strand = strand - 0.007 * np.exp(-((distance / 0.22) ** 2))  # a groove along the strand
        height = np.where((distance < 1.0) & (strand > height), strand, height)

    edge = 0.5 - np.abs(middle)
    roll = 0.016 * np.sqrt(np.clip(1.0 - ((edge - 0.035) / 0.055) ** 2, 0.0, 1.0))
    height = np.where(edge < 0.09, roll, height)
    height = ndimage.gaussian_filter(height, 1.2, mode="wrap")
    height = height + 0.0010 * rough + 0.0004 * fine + 0.0008 * soft
    shade = light_relief(height, size, 0.02, tile=True)
    albedo = np.array([0.118, 0.112, 0.106]) * (1.0 + 0.14 * soft + 0.10 * fine)[..., None]
    worn = smoothstep(0.004, 0.016, height)[..., None]
    albedo = albedo * (0.85 + 0.45 * worn)
    return finish(albedo * shade[..., None])


ASSETS: dict[str, Callable[[], np.ndarray]] = {
    "castle_brick.png": castle_brick,
    "castle_light.png": castle_light,
    "torch_stone.png": torch_stone,
}
