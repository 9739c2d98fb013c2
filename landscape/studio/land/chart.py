"""The map: shaded relief with coastal water lines and ink drawings, like an engraved chart."""

import math
from collections.abc import Callable

import numpy as np
from PIL import Image, ImageDraw
from scipy import ndimage

from landscape.studio.images import shrink, smoothstep, spectral_noise, to_uint8
from landscape.studio.land import terrain
from landscape.studio.land.ground import COURT, normals, path_points

MAP = 512  # chosen

# Chosen: ink and fill colours, sRGB; land tints by height.
INK = (62, 46, 34)
LAND_TINTS = [
    (0.60, (232, 214, 168)),
    (0.85, (202, 198, 138)),
    (1.20, (170, 180, 112)),
    (1.80, (180, 174, 110)),
    (2.60, (190, 160, 108)),
    (3.60, (176, 142, 112)),
    (4.40, (214, 200, 186)),
    (5.00, (250, 246, 238)),
]
SHALLOW_TINT = (188, 208, 196)
DEEP_TINT = (112, 152, 164)
SEA_INK = (52, 88, 104)
CONTOURS = (1.2, 1.8, 2.4, 3.0, 3.6, 4.2)
SUPERSAMPLING = 4  # supersampling factor of the ink drawings


def contour(field: np.ndarray, level: float, width: float) -> np.ndarray:
    """Return the coverage (0..1) of a contour line of ``field`` at ``level``, ``width`` texels."""
    gz, gx = np.gradient(field)
    distance = np.abs(field - level) / np.maximum(np.hypot(gx, gz), 1e-4)
    return np.clip(width / 2.0 + 0.5 - distance, 0.0, 1.0)


def base_layer() -> np.ndarray:
    """Return the map without its drawings: tinted relief and sea, (MAP, MAP, 3) in 0..255."""
    h = ndimage.gaussian_filter(terrain.build()[0], 0.8)
    land = h > terrain.WATER_LEVEL
    levels = [level for level, _ in LAND_TINTS]
    tints = np.array([tint for _, tint in LAND_TINTS], float)
    ground = np.stack([np.interp(h, levels, tints[:, c]) for c in range(3)], axis=-1)
    lamp = np.array([-0.55, 0.62, -0.55]) / math.hypot(
        0.55, 0.62, 0.55
    )  # by convention maps are lit from the upper left
    shade = normals(h, terrain.CELL) @ lamp / lamp[1]
    ground *= np.clip(0.42 + 0.58 * shade, 0.40, 1.22)[..., None]

    pen = np.array(INK, float)
    for level in CONTOURS:
        ground += (pen - ground) * 0.30 * contour(h, level, 1.0)[..., None]
    to_coast = ndimage.distance_transform_edt(~land)
    deep = np.clip(to_coast / 46.0, 0.0, 1.0)[..., None] ** 0.7
    sea = np.array(SHALLOW_TINT) * (1.0 - deep) + np.array(DEEP_TINT) * deep
    smooth = ndimage.gaussian_filter(to_coast, 1.5)
    for k, distance in enumerate((4.5, 9.0, 14.5, 21.0)):
        cover = (0.55 - 0.12 * k) * np.clip(1.1 - np.abs(smooth - distance), 0.0, 1.0)
        sea += (np.array(SEA_INK) - sea) * cover[..., None]
    rgb = np.where(land[..., None], ground, sea)
    signed = ndimage.gaussian_filter(to_coast - ndimage.distance_transform_edt(land), 0.7)
    rgb += (pen - rgb) * 0.9 * np.clip(1.6 - np.abs(signed), 0.0, 1.0)[..., None]
    paper = 1.0 + 0.022 * spectral_noise(MAP, 0.9, 51, 4.0) + 0.02 * spectral_noise(MAP, 2.0, 52)
    x = np.linspace(-1.0, 1.0, MAP)
    worn = 1.0 - 0.16 * smoothstep(0.80, 1.30, np.hypot(*np.meshgrid(x, x)))
    return rgb * (paper * worn)[..., None] * np.array([1.0, 0.985, 0.95])


def draw_compass(pen: ImageDraw.ImageDraw, x: float, y: float, r: float) -> None:
    """Draw an eight-point compass rose of radius ``r`` at (x, y) with an N above it."""
    pen.ellipse((x - 0.62 * r, y - 0.62 * r, x + 0.62 * r, y + 0.62 * r), outline=INK, width=6)
    for long, first in ((0.62, 45), (1.0, 0)):
        for angle in range(first, first + 360, 90):
            a = math.radians(angle)
            tip = (x + long * r * math.sin(a), y - long * r * math.cos(a))
            for side, fill in ((-1, (238, 226, 196)), (1, INK)):
                b = a + side * math.pi / 4
                waist = (x + 0.20 * r * math.sin(b), y - 0.20 * r * math.cos(b))
                pen.polygon([(x, y), tip, waist], fill=fill, outline=INK)
    left = x - 0.16 * r
    right = x + 0.16 * r
    low = y - 1.10 * r
    high = y - 1.52 * r
    pen.line([(left, low), (left, high), (right, low), (right, high)], fill=INK, width=13)


def draw_castle(pen: ImageDraw.ImageDraw, x: float, y: float, s: float) -> None:
    """Draw a castle with two towers and a gate, ``s`` wide, bottom centre at (x, y)."""
    stone, roof = (240, 228, 204), (168, 62, 44)
    pen.rectangle((x - 0.30 * s, y - 0.55 * s, x + 0.30 * s, y), fill=stone, outline=INK, width=8)
    for k in (-0.2, 0.0, 0.2):
        merlon = (x + (k - 0.06) * s, y - 0.66 * s, x + (k + 0.06) * s, y - 0.52 * s)
        pen.rectangle(merlon, fill=stone, outline=INK, width=6)
    for side in (-0.38, 0.38):
        cx = x + side * s
        pen.rectangle(
            (cx - 0.15 * s, y - 0.8 * s, cx + 0.15 * s, y), fill=stone, outline=INK, width=8
        )
        cone = [(cx - 0.21 * s, y - 0.8 * s), (cx, y - 1.25 * s), (cx + 0.21 * s, y - 0.8 * s)]
        pen.polygon(cone, fill=roof)
        pen.line([*cone, cone[0]], fill=INK, width=8, joint="curve")
    pen.pieslice((x - 0.12 * s, y - 0.32 * s, x + 0.12 * s, y - 0.08 * s), 180, 360, fill=INK)
    pen.rectangle((x - 0.12 * s, y - 0.20 * s, x + 0.12 * s, y), fill=INK)


def draw_serpent(pen: ImageDraw.ImageDraw, x: float, y: float, s: float) -> None:
    """Draw a sea serpent ``s`` wide whose water line starts at (x, y) and runs east."""
    t = np.linspace(0.0, 1.0, 260)
    body_x = x + s * (0.02 + 0.66 * t + 0.03 * np.sin(4.0 * math.pi * t))
    body_y = y - s * (0.13 + 0.05 * t) * np.sin(6.0 * math.pi * t - 0.6)
    neck_x = x + s * (0.71 + 0.10 * t - 0.13 * np.sin(math.pi * t) + 0.06 * t**3)
    neck_y = y + s * (0.12 - 0.52 * t)
    thick = s * np.r_[0.012 + 0.040 * t, 0.052 - 0.010 * t]
    beads = [*zip(np.r_[body_x, neck_x], np.r_[body_y, neck_y], thick, strict=True)]
    head_x, head_y = neck_x[-1], neck_y[-1]
    snout = [(head_x - 0.05 * s, head_y - 0.07 * s), (head_x + 0.09 * s, head_y - 0.055 * s)]
    snout += [(head_x + 0.19 * s, head_y - 0.005 * s), (head_x + 0.08 * s, head_y + 0.01 * s)]
    snout += [(head_x + 0.15 * s, head_y + 0.05 * s), (head_x - 0.02 * s, head_y + 0.06 * s)]
    for grow, fill in ((9.0, INK), (0.0, (122, 142, 92))):
        for bx, by, br in beads:
            if by < y:
                pen.ellipse((bx - br - grow, by - br - grow, bx + br + grow, by + br + grow), fill)
        pen.polygon(snout, fill=fill, outline=INK, width=9)

    pen.ellipse((head_x, head_y - 0.04 * s, head_x + 0.03 * s, head_y - 0.01 * s), fill=INK)
    for k in range(4):
        wave = x + (0.27 * k - 0.08) * s
        pen.arc((wave, y - 0.02 * s, wave + 0.25 * s, y + 0.11 * s), 15, 165, SEA_INK, 9)


def drawings() -> np.ndarray:
    """Return the ink drawings and the frame as premultiplied RGBA (MAP, MAP, 4)."""
    size = MAP * SUPERSAMPLING
    sheet = Image.new("RGBA", (size, size), (0, 0, 0, 0))
    pen = ImageDraw.Draw(sheet)
    scale = size / terrain.WORLD
    x, z = path_points()
    for k in range(0, len(x) - 110, 200):
        dash = [(x[i] * scale, z[i] * scale) for i in range(k, k + 111, 10)]
        pen.line(dash, fill=(120, 66, 42), width=10, joint="curve")
    draw_castle(pen, COURT[0] * scale, (COURT[1] + 0.6) * scale, 2.3 * scale)
    draw_compass(pen, 34.4 * scale, 33.6 * scale, 2.9 * scale)
    draw_serpent(pen, 3.4 * scale, 34.8 * scale, 5.2 * scale)
    inner = 0.62 * scale
    outer = 0.12 * scale
    marks = 20
    paper = (232, 214, 172)
    pen.rectangle((0, 0, size - 1, size - 1), outline=paper, width=round(inner))
    step = size / marks
    for k in range(0, marks, 2):  # chequered frame, two units per field
        a, b = k * step, (k + 1) * step
        pen.rectangle((a, outer, b, inner), fill=INK)
        pen.rectangle((a + step, size - inner, b + step, size - outer), fill=INK)
        pen.rectangle((outer, a + step, inner, b + step), fill=INK)
        pen.rectangle((size - inner, a, size - outer, b), fill=INK)

    pen.rectangle((0, 0, size - 1, size - 1), outline=INK, width=round(outer))
    pen.rectangle((inner, inner, size - inner, size - inner), outline=INK, width=8)
    rgba = np.asarray(sheet, float) / 255.0
    rgba[..., :3] *= rgba[..., 3:]
    return shrink(rgba, SUPERSAMPLING)


def island_map() -> np.ndarray:
    """Return the map, uint8 (MAP, MAP, 3): north up, covering the 40 x 40 units exactly."""
    ink = drawings()
    return to_uint8(base_layer() / 255.0 * (1.0 - ink[..., 3:]) + ink[..., :3])


ASSETS: dict[str, Callable[[], np.ndarray]] = {"map.png": island_map}
