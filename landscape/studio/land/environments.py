"""The environments of the software fly-over: terrains, paths over them, points to look at.

Each is an SVG file as Inkscape writes it, with the height image in it. Arrays are [y, x]; heights
are in pixels of the image until they are scaled to grey.
"""

from collections.abc import Callable
from functools import cache

import numpy as np
from scipy import ndimage
from scipy.interpolate import splev, splprep
from scipy.spatial import cKDTree

from landscape.files.svg_writing import environment_text, grey
from landscape.geometry.bezier import through
from landscape.studio.images import ridged, smoothstep, spectral_noise
from landscape.studio.land.erosion import rain, rivers, slide_once
from landscape.studio.land.terrain import line_distance

SIZE = 512  # pixels
RELIEF = 64.0  # pixels: the height of black, which is the default of flyover.relief


# Chosen: crests as (x, y, height). The first five meet at the horn; the others stand around it.
CRESTS: list[list[tuple[float, float, float]]] = [
    [(262, 236, 64), (296, 214, 47), (338, 196, 36), (372, 186, 22)],
    [(262, 236, 64), (240, 196, 45), (228, 158, 33), (206, 128, 18)],
    [(262, 236, 64), (222, 250, 48), (178, 258, 35), (140, 246, 17)],
    [(262, 236, 64), (254, 282, 46), (232, 324, 36), (222, 362, 18)],
    [(262, 236, 64), (302, 262, 42), (330, 300, 30), (344, 336, 15)],
    [(0, 150, 40), (52, 118, 46), (104, 84, 55), (150, 40, 44), (214, 16, 34), (290, 0, 40)],
    [(104, 84, 55), (118, 128, 36), (108, 168, 20)],
    [(330, 0, 34), (372, 48, 40), (424, 104, 54), (458, 168, 42), (512, 214, 46)],
    [(424, 104, 54), (384, 118, 36), (344, 112, 18)],
    [(512, 300, 38), (466, 336, 42), (432, 402, 57), (446, 458, 38), (420, 512, 44)],
    [(432, 402, 57), (388, 396, 37), (352, 410, 18)],
    [(360, 512, 30), (300, 476, 38), (236, 458, 44), (170, 478, 34), (130, 512, 40)],
    [(236, 458, 44), (244, 420, 26)],
    [(0, 250, 44), (44, 290, 40), (62, 346, 51), (40, 404, 40), (0, 440, 46)],
    [(62, 346, 51), (104, 350, 35), (140, 366, 17)],
]


@cache
def alps() -> np.ndarray:
    """Return the heights in pixels of a mountain range, a horn among valleys."""
    y, x = np.mgrid[:SIZE, :SIZE] + 0.5
    x, y = (g + 7.0 * spectral_noise(SIZE, 2.0, s, 4.0) for g, s in ((x, 52), (y, 53)))
    h = 3.0 + 1.2 * spectral_noise(SIZE, 2.2, 54, 3.0)
    for line in CRESTS:
        away, crest = line_distance(x, y, line)
        h = np.maximum(h, crest * np.exp(-away / (0.8 * crest + 5.0)))
    h = ndimage.gaussian_filter(h, 1.0)
    h += 0.28 * (ridged(SIZE, 55, 5, 9.0) - 0.4) * h
    low = ndimage.gaussian_filter(0.5 * h, 4.0)
    rivers(h, low, 0.010 * h, 0.004 * h, 1.0, 14)
    for _ in range(4):
        slide_once(h, 1.3)
    rain(h, 60_000, np.random.default_rng(56), 3, 1.0)
    return ndimage.gaussian_filter(h, 0.7)


# Chosen: the bed of the canyon's river, as (x, y).
RIVER = [
    (-20, 402),
    (40, 396),
    (96, 430),
    (160, 420),
    (176, 350),
    (126, 300),
    (98, 236),
    (146, 186),
    (214, 196),
    (252, 258),
    (268, 330),
    (330, 372),
    (392, 330),
    (386, 262),
    (336, 214),
    (322, 148),
    (372, 92),
    (440, 110),
    (476, 64),
    (480, -20),
]
# Chosen: buttes that stand in the canyon's wide places, as (x, y, radius).
BUTTES = [(138, 372, 9), (182, 238, 12), (300, 300, 10), (352, 300, 8), (362, 150, 9), (60, 440, 8)]
RIM, BED = 46.0, 2.0  # chosen: heights of the plateau and of the river's bed
STRATA = 6  # chosen: terraces of the walls


def terraced(level: np.ndarray) -> np.ndarray:
    """Return heights in 0..1 as terraces: STRATA steep walls with gentle benches between them."""
    step = level * STRATA
    return (np.floor(step) + smoothstep(0.35, 0.75, step % 1.0)) / STRATA


@cache
def canyon() -> np.ndarray:
    """Return the heights in pixels of a plateau, cut by a canyon with terraced walls."""
    y, x = np.mgrid[:SIZE, :SIZE] + 0.5
    warped = [g + 5.0 * spectral_noise(SIZE, 1.9, s, 6.0) for g, s in ((x, 62), (y, 63))]
    spline, _ = splprep(np.array(RIVER, float).T, s=0)
    bed = np.stack(splev(np.linspace(0, 1, 4000), spline), axis=1)
    away = cKDTree(bed).query(np.stack(warped, axis=-1))[0]
    width = 30.0 + 8.0 * spectral_noise(SIZE, 2.2, 64, 2.0)

    # Side canyons: branches where ridged noise is highest, wider towards the river.
    branch = smoothstep(0.62, 0.9, ridged(SIZE, 65, 3, 3.0)) * np.exp(-away / 70.0)
    level = np.clip((away - 9.0) / np.maximum(width, 14.0), 0.0, 1.0) - 0.9 * branch
    for bx, by, radius in BUTTES:
        r = np.hypot(warped[0] - bx, warped[1] - by)
        level = np.maximum(level, np.clip(1.15 - 0.55 * (r / radius - 0.4), 0.0, 1.0))
    level = np.clip(level + 0.03 * spectral_noise(SIZE, 1.8, 66, 8.0), 0.0, 1.0)
    h = BED + (RIM - BED) * terraced(level)
    mesas = smoothstep(1.2, 1.35, spectral_noise(SIZE, 2.6, 67, 2.0)) * smoothstep(60, 75, away)
    h += 14.0 * mesas + 0.7 * spectral_noise(SIZE, 1.8, 68, 8.0) * level
    for _ in range(3):
        slide_once(h, 2.6)
    rain(h, 10_000, np.random.default_rng(69), 3, 1.0)
    return ndimage.gaussian_filter(h, 0.6)


# Chosen: the camera's paths, as points that they go through, and points to look at. They keep to
# the middle of valleys; the first one goes around the horn and over one pass, which has a view.
HORN_PATH = [
    (187, 395),
    (176, 373),
    (176, 347),
    (172, 322),
    (160, 305),
    (144, 292),
    (127, 273),
    (124, 247),
    (138, 227),
    (150, 207),
    (152, 181),
    (166, 159),
    (176, 136),
    (185, 112),
    (208, 105),
    (232, 112),
    (255, 123),
    (273, 141),
    (290, 158),
    (312, 168),
    (332, 180),
    (352, 193),
    (374, 206),
    (392, 226),
    (400, 252),
    (400, 278),
    (400, 304),
    (399, 329),
    (377, 343),
    (357, 358),
    (335, 372),
    (312, 384),
    (287, 385),
    (262, 392),
    (238, 399),
    (212, 399),
]
CANYON_PATH = [
    (84, 422),
    (107, 434),
    (133, 435),
    (154, 419),
    (167, 397),
    (178, 373),
    (177, 348),
    (161, 328),
    (143, 309),
    (124, 291),
    (111, 268),
    (101, 244),
    (102, 218),
    (120, 200),
    (145, 192),
    (170, 185),
    (196, 187),
    (218, 200),
    (232, 222),
    (245, 244),
    (256, 267),
    (259, 293),
    (270, 317),
    (278, 341),
    (298, 358),
    (319, 373),
    (344, 369),
    (368, 359),
    (384, 339),
    (395, 315),
    (395, 290),
    (389, 265),
    (376, 243),
    (356, 226),
    (336, 210),
    (324, 187),
    (322, 161),
    (333, 138),
    (340, 113),
    (359, 96),
    (385, 94),
    (410, 102),
    (436, 106),
    (459, 96),
]
HORN_TARGETS = [(262, 236), (424, 104), (104, 84), (62, 346), (432, 402), (236, 458)]


def alps_svg() -> str:
    """Return the environment of the mountain range."""
    path = through(np.array(HORN_PATH, float), closed=True)
    return environment_text(grey(alps() / RELIEF), [path], np.array(HORN_TARGETS, float))


def canyon_svg() -> str:
    """Return the environment of the canyon, where the camera looks ahead."""
    path = through(np.array(CANYON_PATH, float), closed=False)
    return environment_text(grey(canyon() / RELIEF), [path], np.zeros((0, 2)))


ASSETS: dict[str, Callable[[], str]] = {
    "flyover_alps.svg": alps_svg,
    "flyover_canyon.svg": canyon_svg,
}
