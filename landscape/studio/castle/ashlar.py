"""The weathered castle's pictures: walls of uneven ashlar, slates, and what grows on the walls.

The wall is a height field of stones of many sizes, shaded as in
:mod:`landscape.studio.castle.masonry`. Courses differ in height, stones in length, colour,
roughness and depth; a stone may be two courses high, its corners are knocked off, and some joints
have lost their mortar. Lengths are in tile sides.
"""

from collections.abc import Callable

import numpy as np
from scipy import ndimage

from landscape.studio.castle.masonry import OVERSAMPLE, finish, light_relief, tile_axes
from landscape.studio.images import bleed, cut_out, shrink, smoothstep, spectral_noise

SIZE = 512
COURSES = 13  # chosen: per tile, which covers a third of a wall of 17 m
COURSE_HEIGHTS = (0.62, 1.45)  # chosen: of the mean height
STONE_LENGTHS = (0.9, 2.7)  # chosen: of their course's height
TWO_COURSES = 0.10  # chosen: fraction of the stones that are two courses high
JOINT = 0.0030  # chosen: half width of a joint
# Chosen: linear albedos, from cool grey over beige to ochre and a few that are rust or lead grey.
TONES = np.array(
    [
        [0.285, 0.272, 0.245],
        [0.330, 0.296, 0.236],
        [0.238, 0.232, 0.220],
        [0.372, 0.330, 0.258],
        [0.330, 0.262, 0.172],
        [0.270, 0.205, 0.150],
        [0.190, 0.188, 0.184],
        [0.410, 0.378, 0.315],
    ]
)
OFTEN = np.array([5.0, 5.0, 4.0, 3.0, 1.6, 0.7, 1.3, 1.5])
MORTAR = np.array([0.245, 0.222, 0.182])  # chosen

SLATE_ROWS, SLATE_COLUMNS = 9, 8  # chosen: slates per tile
LEAVES = 128  # texels per side of one of the four pictures of leaves


def stones(rng: np.random.Generator) -> np.ndarray:
    """Return the stones of a tile as boxes x0, y0, x1, y1 (n, 4); x1 and y1 may exceed 1."""
    heights = rng.uniform(*COURSE_HEIGHTS, COURSES)
    level = np.concatenate([[0.0], np.cumsum(heights) / heights.sum()])
    boxes: list[tuple[float, float, float, float]] = []
    taken: list[tuple[float, float]] = []
    for course in range(COURSES):
        low, high = level[course], level[course + 1]
        start = rng.uniform(0.0, 0.1) if not taken else taken[0][1]
        free, at = [], start
        for a, b in sorted(taken, key=lambda span: (span[0] - start) % 1.0):
            end = start + (a - start) % 1.0
            free.append((at, end))
            at = end + (b - a)
        free.append((at, start + 1.0))
        above: list[tuple[float, float]] = []
        for a, b in free:
            if b - a < 1e-6:
                continue
            cuts = [a]
            while cuts[-1] < b:
                cuts.append(cuts[-1] + (high - low) * rng.uniform(*STONE_LENGTHS))
            inner = np.array(cuts[:-1]) if b - cuts[-2] > 0.55 * (high - low) else cuts[:-2]
            ends = [*inner, b] if len(inner) else [a, b]
            for x0, x1 in zip(ends, ends[1:], strict=False):
                tall = course < COURSES - 1 and rng.random() < TWO_COURSES
                top = level[course + 2] if tall else high
                boxes.append((x0, low, x1, top))
                if tall:
                    above.append((x0 % 1.0, x0 % 1.0 + x1 - x0))
        taken = above

    return np.array(boxes)


def stone_fields(size: int, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return, (size, size) each: number of the stone, depth within it, place within it (.., 2)."""
    x, y = tile_axes(size)
    rough = spectral_noise(size, 1.5, 62, low_cut=14.0)
    x = x + 0.0018 * spectral_noise(size, 1.7, 60, low_cut=8.0) + 0.0007 * rough
    y = y + 0.0018 * spectral_noise(size, 1.7, 61, low_cut=8.0)
    y = y + 0.004 * np.sin(2 * np.pi * (x + 0.3)) * np.sin(4 * np.pi * y)
    number = np.zeros((size, size), int)
    within = np.full((size, size), -1.0)
    place = np.zeros((size, size, 2))
    chip = spectral_noise(size, 1.4, 63, low_cut=16.0)
    for k, (x0, y0, x1, y1) in enumerate(stones(rng)):
        half = np.array([x1 - x0, y1 - y0]) / 2
        dx = (x - (x0 + x1) / 2 + 0.5) % 1.0 - 0.5
        dy = (y - (y0 + y1) / 2 + 0.5) % 1.0 - 0.5
        near = (np.abs(dx) < half[0] + 0.006) & (np.abs(dy) < half[1] + 0.006)
        a, b = dx[near], dy[near]
        p, q = np.abs(a) - half[0], np.abs(b) - half[1]
        radius = rng.uniform(0.004, 0.012)
        distance = -(
            np.hypot(np.maximum(p + radius, 0), np.maximum(q + radius, 0))
            + np.minimum(np.maximum(p, q) + radius, 0)
            - radius
        )
        # Corners knocked off, each by another amount, along an irregular break.
        for sx, sy in ((-1, -1), (-1, 1), (1, -1), (1, 1)):
            lost = rng.gamma(1.1, 0.0075) if rng.random() < 0.55 else 0.0
            corner = (half[0] - sx * a + half[1] - sy * b) * 0.71
            distance = np.minimum(distance, corner - lost * (1.0 + 0.35 * chip[near]))
        better = distance > within[near]
        index = tuple(axis[better] for axis in np.nonzero(near))
        within[index], number[index] = distance[better], k
        place[index] = np.stack([a[better], b[better]], axis=1)

    return number, within, place


def castle_ashlar() -> np.ndarray:
    """Return the wall tile, uint8 (512, 512, 3)."""
    size = SIZE * OVERSAMPLE
    rng = np.random.default_rng(1190)
    number, within, place = stone_fields(size, rng)
    count = int(number.max()) + 1
    fine = spectral_noise(size, 0.9, 64, low_cut=40.0)
    rough = spectral_noise(size, 1.5, 65, low_cut=14.0)
    soft = spectral_noise(size, 1.9, 66, low_cut=4.0)
    edges = 0.0032 * smoothstep(0.8, 2.3, spectral_noise(size, 1.2, 67, low_cut=20.0))
    inside = within - JOINT * (0.75 + 0.5 * smoothstep(-1.5, 1.5, soft)) - edges
    face = smoothstep(0.0, 0.006, inside)
    coarse = rng.uniform(0.3, 1.7, count)[number]  # how roughly a stone is dressed
    lean = rng.normal(0.0, 0.05, (count, 2))[number]
    height = 0.0062 * (1.0 - np.exp(-np.clip(inside, 0.0, None) / 0.0042))
    height += face * (
        (lean * place).sum(axis=2)
        + rng.normal(0.0, 0.0014, count)[number]
        + coarse * (0.00062 * rough + 0.00028 * fine)
        - 0.0017 * smoothstep(1.7, 2.7, spectral_noise(size, 0.9, 68, low_cut=30.0))
    )
    lost = smoothstep(0.7, 1.9, spectral_noise(size, 1.6, 69, low_cut=6.0))  # mortar washed out
    height -= (1.0 - face) * (0.0022 * lost - 0.0005 * rough)
    shade = light_relief(height, size, 0.008, tile=True)

    which = rng.choice(len(TONES), count, p=OFTEN / OFTEN.sum())
    mix = 0.7 * TONES[which] + 0.3 * (rng.dirichlet(np.ones(len(TONES)), count) @ TONES)
    mix *= rng.normal(1.0, 0.10, (count, 1))
    albedo = mix[number] * (1.0 + 0.07 * soft + coarse * (0.05 * fine + 0.06 * rough))[..., None]
    # Iron in some stones, lichen on others.
    rust = smoothstep(0.8, 2.4, soft + 0.6 * rough) * (rng.random(count) < 0.35)[number]
    albedo = albedo * (1.0 - 0.22 * rust[..., None] * np.array([0.2, 0.7, 1.3]))
    pale = smoothstep(1.2, 2.4, spectral_noise(size, 1.3, 70, low_cut=9.0)) * face
    albedo = albedo + 0.30 * pale[..., None] * (np.array([0.43, 0.43, 0.36]) - albedo)
    cover = smoothstep(-0.0010, 0.0010, inside)[..., None]
    mortar = MORTAR * (1.0 + 0.10 * fine + 0.10 * soft)[..., None] * (1.0 - 0.35 * lost[..., None])
    albedo = albedo * cover + (1.0 - cover) * mortar
    moss = smoothstep(1.0, 2.2, soft + 0.6 * rough)[..., None] * (1.0 - 0.8 * cover)
    albedo = albedo * (1.0 - 0.6 * moss) + 0.6 * moss * np.array([0.10, 0.13, 0.05])
    return finish(albedo * shade[..., None])


def castle_slate() -> np.ndarray:
    """Return the roof tile, uint8 (256, 256, 3): slates in uneven rows."""
    size = 256 * OVERSAMPLE
    rng = np.random.default_rng(1191)
    x, y = tile_axes(size)
    fine = spectral_noise(size, 0.9, 71, low_cut=24.0)
    soft = spectral_noise(size, 1.8, 72, low_cut=3.0)
    height = np.zeros((size, size))
    number = np.zeros((size, size), int)
    for row in range(-1, SLATE_ROWS):
        cuts = (np.arange(SLATE_COLUMNS) + 0.5 * (row % 2)) / SLATE_COLUMNS
        cuts = cuts + rng.uniform(-0.03, 0.03, SLATE_COLUMNS)
        for column in range(SLATE_COLUMNS):
            x0 = cuts[column]
            wide = (cuts[(column + 1) % SLATE_COLUMNS] - x0) % 1.0
            foot = (row + rng.uniform(-0.16, 0.10)) / SLATE_ROWS
            skew = rng.normal(0.0, 0.05)
            across = (x - x0) % 1.0
            up = (y - foot - skew * (across - wide / 2) - 0.0022 * soft + 0.5) % 1.0 - 0.5
            gap = np.minimum(across, wide - across)
            mine = (gap > 0.002) & (up > 0.0) & (up < 1.3 / SLATE_ROWS)
            top = 0.016 - 0.13 * up + rng.uniform(-0.0015, 0.0015)
            top -= 0.004 * np.exp(-np.clip(gap, 0, None) / 0.004)
            better = mine & (top > height)
            height = np.where(better, top, height)
            number = np.where(better, 1 + (row % SLATE_ROWS) * SLATE_COLUMNS + column, number)

    height = ndimage.gaussian_filter(height, 0.8, mode="wrap") + 0.0005 * fine + 0.0006 * soft
    shade = light_relief(height, size, 0.016, tile=True)
    count = 1 + SLATE_ROWS * SLATE_COLUMNS
    tone = np.clip(rng.normal(1.0, 0.16, count), 0.6, 1.45)
    hue = rng.normal(0.0, 0.055, count)[number][..., None] * np.array([1.0, 0.1, -0.8])
    albedo = (
        np.array([0.265, 0.278, 0.310])
        * (tone[number] * (1 + 0.10 * fine + 0.10 * soft))[..., None]
    )
    albedo = albedo * (1.0 + hue)
    lichen = smoothstep(1.0, 2.2, spectral_noise(size, 1.4, 73, low_cut=5.0))[..., None]
    albedo = albedo + 0.42 * lichen * (np.array([0.36, 0.36, 0.24]) - albedo)
    return finish(albedo * shade[..., None])


def leaf(angle: float, length: float, lobes: int, at: np.ndarray) -> np.ndarray:
    """Return the signed distance, positive inside, of places (h, w, 2) to a leaf's outline."""
    c, s = np.cos(angle), np.sin(angle)
    u, v = at[..., 0] * c + at[..., 1] * s, at[..., 1] * c - at[..., 0] * s
    turn = np.arctan2(v, u - 0.35 * length)
    if lobes:
        reach = length * (0.42 + 0.15 * np.cos(lobes * turn) + 0.10 * np.cos(turn))
        return np.asarray(reach - np.hypot(u - 0.35 * length, v))
    half = 0.016 * np.sqrt(np.clip(1.0 - u / length, 0.0, 1.0))
    return np.asarray(np.where((u > 0) & (u < length), half - np.abs(v), -1.0))


def leaves(seed: int, ivy: bool) -> np.ndarray:
    """Return a picture of leaves, uint8 (128, 128, 4): ivy hung on a wall, or a tuft of weeds."""
    scale = 4
    size = LEAVES * scale
    rng = np.random.default_rng(seed)
    axis = (np.arange(size) + 0.5) / size
    x, y = np.meshgrid(axis, axis[::-1])
    picture = np.zeros((size, size, 4))
    count = 85 if ivy else 74
    for k in range(count):
        depth = k / count  # the last ones lie in front
        if ivy:
            away, turn = 0.36 * np.sqrt(rng.random()), rng.uniform(0, 2 * np.pi)
            px, py = 0.5 + away * np.cos(turn), 0.5 + away * np.sin(turn)
            angle = rng.normal(-1.57, 0.7)
            length = rng.uniform(0.10, 0.17)
            lobes = 5
        else:
            px, py = 0.5 + rng.normal(0, 0.09), rng.uniform(0.01, 0.05)
            angle = rng.normal(1.57, 0.28)
            length = 0.22 + 0.70 * rng.random() ** 1.5
            lobes = 0
            bend = rng.normal(0.0, 0.30)
        dx, dy = x - px, y - py
        if not ivy:
            dx = dx - bend * (dy**2)
        inside = leaf(angle, length, lobes, np.stack([dx, dy], axis=-1))
        cover = smoothstep(-0.7 / size, 0.7 / size, inside)
        green = np.array([0.060, 0.115, 0.030]) if ivy else np.array([0.105, 0.130, 0.045])
        green = green * (0.45 + 0.85 * depth) * rng.normal(1.0, 0.16)
        green = green * (1.0 + np.array([0.5, 0.1, -0.2]) * max(0.0, rng.normal(0.0, 0.5)))
        along = np.clip(inside / (0.25 * length if ivy else 0.02), 0.0, 1.0)
        light = 0.75 + 0.35 * along + (0.25 * (dx * -0.5 + dy * 0.6) / length if ivy else 0.3 * y)
        colour = green * light[..., None]
        picture[..., :3] = picture[..., :3] * (1 - cover[..., None]) + colour * cover[..., None]
        picture[..., 3] = np.maximum(picture[..., 3], cover)
        # A leaf darkens what is just below it.
        if ivy:
            under = np.roll(cover, (int(0.010 * size), int(0.006 * size)), (0, 1))
            under = 0.30 * under * (1.0 - cover)
            picture[..., :3] *= 1.0 - under[..., None]

    if not ivy:
        picture[..., :3] *= (0.35 + 0.65 * smoothstep(0.0, 0.45, y))[..., None]  # roots are shaded
    return cut_out(shrink(np.dstack([picture[..., :3] * picture[..., 3:], picture[..., 3]]), scale))


def castle_leaves() -> np.ndarray:
    """Return the sheet, uint8 (256, 256, 4): two pictures of ivy above two tufts of weeds."""
    rows = [[leaves(10 * row + column, row == 0) for column in (1, 2)] for row in (0, 1)]
    return bleed(np.vstack([np.hstack(row) for row in rows]))


ASSETS: dict[str, Callable[[], np.ndarray]] = {
    "castle_ashlar.png": castle_ashlar,
    "castle_slate.png": castle_slate,
    "castle_leaves.png": castle_leaves,
}
