"""The hall's textures: ashlar, vault, dressed stone, marble floor with its medallion, and wood.

Light comes from the light map, so that only the relief of joints and grain is painted in. Lengths
are in tile sides. Each texture is quiet: it is repeated often and seen from afar as well as near.
"""

from collections.abc import Callable

import numpy as np
from scipy import ndimage

from landscape.studio.castle.masonry import OVERSAMPLE, finish, light_relief, tile_axes
from landscape.studio.images import smoothstep, spectral_noise

# Chosen: linear colours.
LIMESTONE = np.array(
    [[0.42, 0.375, 0.30], [0.46, 0.405, 0.315], [0.385, 0.355, 0.30], [0.49, 0.44, 0.35]]
)
PALE = np.array([[0.52, 0.48, 0.41], [0.56, 0.52, 0.44], [0.49, 0.46, 0.40]])
DRESSED = np.array([0.46, 0.42, 0.35])
MORTAR = np.array([0.36, 0.33, 0.27])
CREAM, CREAM_VEIN = np.array([0.52, 0.47, 0.39]), np.array([0.33, 0.27, 0.20])
RED, RED_VEIN = np.array([0.17, 0.065, 0.045]), np.array([0.42, 0.30, 0.24])
DARK, DARK_VEIN = np.array([0.045, 0.06, 0.055]), np.array([0.26, 0.28, 0.25])
GOLD = np.array([0.46, 0.30, 0.10])
OAK, OAK_DARK = np.array([0.17, 0.095, 0.045]), np.array([0.07, 0.036, 0.018])


def ashlar(
    seed: int, courses: int, per_course: int, colours: np.ndarray, joint: float, rough: float
) -> np.ndarray:
    """Return a wall tile, uint8 (512, 512, 3), of smooth stones in running bond.

    ``joint`` is half the width of a joint, ``rough`` how rough the faces are (1: plainly hewn).
    """
    size = 512 * OVERSAMPLE
    rng = np.random.default_rng(seed)
    x, y = tile_axes(size)
    fine = spectral_noise(size, 0.9, seed + 1, low_cut=30.0)
    grain = spectral_noise(size, 1.5, seed + 2, low_cut=9.0)
    soft = spectral_noise(size, 1.9, seed + 3, low_cut=3.0)

    # Courses, and in each the joints between its stones.
    warped = y + 0.0007 * grain
    course = np.floor(warped * courses).astype(int)
    up = warped * courses - course
    course %= courses
    places = (np.arange(per_course)[None, :] + 0.5 * (np.arange(courses) % 2)[:, None]) / per_course
    places = np.sort((places + rng.uniform(-0.05, 0.05, places.shape)) % 1.0, axis=1)
    padded = np.concatenate([places[:, -1:] - 1.0, places, places[:, :1] + 1.0], axis=1)
    number = np.zeros((size, size), int)
    across = x + 0.0007 * grain
    for k in range(1, per_course + 1):
        number += across >= padded[course, k]

    # How far inside its stone a texel is, and the relief that this and the stone's lean make.
    left, right = padded[course, number], padded[course, number + 1]
    stone = course * per_course + number % per_course
    to_side = np.minimum(across - left, right - across)
    inside = np.minimum(to_side, np.minimum(up, 1.0 - up) / courses) - joint
    face = smoothstep(-0.0005, 0.0035, inside)
    lean = rng.normal(0.0, 0.02, (courses * per_course, 2)) * rough
    height = 0.003 * face + face * rough * (
        lean[stone, 0] * (across - left)
        + lean[stone, 1] * up / courses
        + 0.00045 * grain
        + 0.0005 * soft
        + 0.00016 * fine
    )
    shade = light_relief(height, size, 0.012, tile=True)

    count = courses * per_course
    mixed = rng.dirichlet(np.full(len(colours), 0.7), count) @ colours
    mixed *= rng.normal(1.0, 0.055, (count, 1))
    albedo = mixed[stone] * (1.0 + 0.05 * soft + 0.035 * grain + 0.03 * fine)[..., None]
    stain = smoothstep(0.7, 2.6, spectral_noise(size, 1.8, seed + 4, low_cut=4.0))[..., None]
    albedo = albedo * (1.0 - 0.16 * stain * np.array([0.8, 1.0, 1.2]))
    filled = MORTAR * (1.0 + 0.08 * fine + 0.05 * soft)[..., None]
    return finish((albedo * face[..., None] + filled * (1.0 - face[..., None])) * shade[..., None])


def hall_wall() -> np.ndarray:
    """Return the wall's tile: eight courses."""
    return ashlar(410, 8, 4, LIMESTONE, 0.0022, 1.0)


def hall_vault() -> np.ndarray:
    """Return the vault's tile: twelve courses of smaller, paler stones."""
    return ashlar(430, 12, 5, PALE, 0.0018, 0.7)


def hall_stone() -> np.ndarray:
    """Return the tile of pillars, ribs and mouldings, uint8 (512, 512, 3): dressed limestone."""
    size = 512 * OVERSAMPLE
    fine = spectral_noise(size, 0.8, 451, low_cut=40.0)
    grain = spectral_noise(size, 1.4, 452, low_cut=10.0)
    soft = spectral_noise(size, 1.9, 453, low_cut=2.0)
    pits = smoothstep(1.7, 2.7, spectral_noise(size, 1.0, 454, low_cut=30.0))
    height = 0.0005 * grain + 0.0005 * soft + 0.0001 * fine - 0.0022 * pits
    shade = light_relief(height, size, 0.01, tile=True)
    tint = np.array([0.030, 0.0, -0.045])
    warm = spectral_noise(size, 2.0, 455, low_cut=1.0)[..., None] * tint
    albedo = DRESSED * (1.0 + 0.07 * soft + 0.05 * grain + 0.03 * fine)[..., None] * (1.0 + warm)
    return finish(albedo * shade[..., None])


def marble(
    size: int, seed: int, body: np.ndarray, vein: np.ndarray, cut: float = 2.0
) -> np.ndarray:
    """Return polished marble, linear (size, size, 3), tiling: clouds, and veins of three widths."""
    clouds = spectral_noise(size, 1.7, seed, low_cut=cut)
    fine = spectral_noise(size, 0.9, seed + 1, low_cut=30.0)
    found = body * (1.0 + 0.10 * clouds + 0.025 * fine)[..., None]
    for k, (width, strength) in enumerate(((0.08, 0.60), (0.05, 0.50), (0.22, 0.25))):
        field = spectral_noise(size, 1.75, seed + 2 + k, low_cut=cut * (1 + k))
        patchy = smoothstep(-0.6, 1.3, spectral_noise(size, 1.9, seed + 7 + k, low_cut=cut))
        line = strength * (patchy * np.exp(-((field / width) ** 2)))[..., None]
        found = found * (1.0 - line) + vein * line
    return np.asarray(found)


def jointed(linear: np.ndarray, inside: np.ndarray, half: float) -> np.ndarray:
    """Return marble with thin dark joints where ``inside`` (h, w), the way to one, is small."""
    seam = smoothstep(half * 0.4, half * 1.6, inside)[..., None]
    return linear * (0.35 + 0.65 * seam)


def hall_floor() -> np.ndarray:
    """Return the floor's tile, uint8 (1024, 1024, 3): 16 pale octagons and as many dark squares."""
    size, slabs = 1024, 4
    x, y = tile_axes(size)
    rng = np.random.default_rng(470)
    u, v = x * slabs, y * slabs

    # Each slab is cut from its own place in the block.
    pale = marble(size, 471, CREAM, CREAM_VEIN)
    dark = marble(size, 491, DARK, DARK_VEIN, 3.0)
    number = np.floor(u).astype(int) % slabs * slabs + np.floor(v).astype(int) % slabs
    moved = rng.integers(0, size, (slabs * slabs, 2))[number]
    turned = rng.random(slabs * slabs)[number] < 0.5
    rows, columns = np.mgrid[0:size, 0:size]
    r, c = np.where(turned, columns, rows), np.where(turned, rows, columns)
    body = pale[(r + moved[..., 0]) % size, (c + moved[..., 1]) % size]
    body = body * rng.normal(1.0, 0.055, (slabs * slabs, 1))[number]
    a, b = np.abs(u - np.round(u)), np.abs(v - np.round(v))
    corner = 0.17 - (a + b) / np.sqrt(2.0)  # inside a dark square, set diagonally
    inset = smoothstep(-0.002, 0.002, corner)[..., None]
    found = body * (1.0 - inset) + dark * inset
    seam = np.minimum(np.where(corner > 0, 1.0, np.minimum(a, b)), np.abs(corner))
    found = jointed(found, seam, 0.006)
    return finish(found.repeat(OVERSAMPLE, axis=0).repeat(OVERSAMPLE, axis=1))


def hall_band() -> np.ndarray:
    """Return the band's tile, uint8 (256, 256, 3): two slabs of dark marble, edged with red."""
    size = 256 * OVERSAMPLE
    x, y = tile_axes(size)
    found = marble(size, 510, DARK, DARK_VEIN)
    edge = np.minimum(x, 1.0 - x)
    red = smoothstep(0.153, 0.149, edge)[..., None]
    found = found * (1.0 - red) + marble(size, 530, RED, RED_VEIN) * red
    seam = np.minimum(np.abs(edge - 0.151), np.abs(y * 2 - np.round(y * 2)) / 2)
    return finish(jointed(found, np.minimum(seam, edge + 0.004), 0.004))


def hall_medallion() -> np.ndarray:
    """Return the medallion, uint8 (512, 512, 3): a star of sixteen rays in rings of marble."""
    size = 512 * OVERSAMPLE
    x, y = tile_axes(size)
    u, v = 2 * x - 1, 2 * y - 1
    radius, turn = np.hypot(u, v), np.arctan2(u, v)
    pale = marble(size, 551, CREAM, CREAM_VEIN, 3.0)
    red = marble(size, 571, RED, RED_VEIN, 3.0)
    dark = marble(size, 591, DARK, DARK_VEIN, 3.0)
    found, seam = pale.copy(), np.full((size, size), 1.0)

    def inlay(inside: np.ndarray, stone: np.ndarray) -> None:
        """Set a stone into the floor where ``inside`` is positive."""
        nonlocal found, seam
        cover = smoothstep(-0.002, 0.002, inside)[..., None]
        found = found * (1.0 - cover) + stone * cover
        seam = np.where(inside > 0, np.minimum(inside, 1.0), np.minimum(seam, -inside))

    def ring(low: float, high: float) -> np.ndarray:
        return np.minimum(radius - low, high - radius)

    def rays(count: int, shift: float, inner: float, outer: float) -> np.ndarray:
        """Return how far inside a star of ``count`` rays each texel lies."""
        step = 2 * np.pi / count
        own = np.abs((turn - shift * step + step / 2) % step - step / 2)
        along, aside = radius * np.cos(own), radius * np.sin(own)
        foot = inner * np.cos(step / 2), inner * np.sin(step / 2)
        normal = np.array([foot[1], outer - foot[0]]) / np.hypot(foot[1], outer - foot[0])
        return np.asarray((outer - along) * normal[0] - aside * normal[1])

    inlay(np.minimum(1.0 - np.abs(u), 1.0 - np.abs(v)) * -1.0 + 0.035, dark)
    inlay(ring(0.84, 0.97), red)
    inlay(ring(0.865, 0.945), dark)
    dots = 0.026 - np.hypot(
        radius - 0.905, radius * np.sin(((turn * 24 / np.pi + 1) % 2 - 1) * np.pi / 48)
    )
    inlay(dots, pale * (GOLD / CREAM))
    inlay(rays(16, 0.5, 0.36, 0.74), red)
    inlay(rays(8, 0.5, 0.28, 0.80), pale * (GOLD / CREAM))
    inlay(rays(8, 0.0, 0.26, 0.82), dark)
    inlay(ring(-1.0, 0.22), pale)
    inlay(ring(-1.0, 0.17), dark)
    return finish(jointed(found, np.abs(seam), 0.004))


def hall_wood() -> np.ndarray:
    """Return the door's tile, uint8 (256, 256, 3): four upright planks of oak."""
    size = 256 * OVERSAMPLE
    rng = np.random.default_rng(610)
    x, _ = tile_axes(size)
    plank = np.floor(x * 4).astype(int)
    own = x * 4 - plank
    flow = ndimage.gaussian_filter(
        spectral_noise(size, 1.2, 611, low_cut=6.0), (120.0, 1.2), mode="wrap"
    )
    flow /= flow.std()
    fine = ndimage.gaussian_filter(
        spectral_noise(size, 0.6, 612, low_cut=20.0), (50.0, 0.6), mode="wrap"
    )
    fine /= fine.std()
    share = smoothstep(-1.4, 1.6, flow + 0.5 * fine + rng.normal(0.0, 0.8, 4)[plank])[..., None]
    albedo = OAK_DARK * (1.0 - share) + OAK * share
    height = (
        0.012 * smoothstep(0.0, 0.06, np.minimum(own, 1.0 - own)) + 0.0004 * fine + 0.0003 * flow
    )
    return finish(albedo * light_relief(height, size, 0.02, tile=True)[..., None])


ASSETS: dict[str, Callable[[], np.ndarray]] = {
    "hall_wall.png": hall_wall,
    "hall_vault.png": hall_vault,
    "hall_stone.png": hall_stone,
    "hall_floor.png": hall_floor,
    "hall_band.png": hall_band,
    "hall_medallion.png": hall_medallion,
    "hall_wood.png": hall_wood,
}
