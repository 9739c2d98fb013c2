"""The hall's baked light: which part of which light map each surface has, and how maps are coded.

There are three maps, named sheets: ``floor`` and ``north`` (the north wall) lie flat over their
plane, everything else has charts in ``hall``. Two lights are kept apart on floor and north wall,
because shadows that are drawn live must be able to take them away: the sun (``sun``) and the torch
beside the pool (``torch``). No OpenGL.

A map holds the square root of the light, as the textures hold that of their colour, so that their
product in texture unit 1 is the square root of the light that is reflected. With GL_RGB_SCALE 2 the
brightest texel multiplies a texture's linear colour by about 4.6.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from landscape.hall import plan
from landscape.hall.surfaces import Chart, Surface, charts, in_chart

SIDE, TEXELS = 1024, 200.0  # chosen: of the sheet ``hall``: texels, and texels per unit
SIZES = {"hall": (SIDE, SIDE), "floor": (512, 1024), "north": (512, 256)}  # chosen: width, height
SCALE = 2.0  # GL_RGB_SCALE of texture unit 1
GAMMA = 2.2  # of the textures' coding

FILE = "hall_light.png"
# Where the picture in FILE holds what: x and y. In the parts red is the sun, green the torch.
PICTURE = 2048
HALL = (0, 0)
FLOOR = (1024, 0)
NORTH = (1024, 1024)
PARTS = {"floor": (1536, 0), "north": (1536, 1024)}
BASES = {"floor": FLOOR, "north": NORTH}
# What the byte 255 stands for.
BASE_MOST = 4.0
SUN_MOST = 1.0
TORCH_MOST = 64.0

# Chosen: colour and strength of the lights that are kept apart.
SUN_COLOUR = (6.4, 5.5, 4.2)
TORCH_COLOUR = (0.022, 0.0098, 0.0032)
SHADE = 0.3  # chosen: linear light, the most that others than the sun throw into the pool
# Chosen: how much brighter the torch shines at the statue than all around, as its bowl is polished.
GLARE = {"north": 22.0, "floor": 14.0}


@dataclass(frozen=True)
class Lit:
    """A surface and its place in its sheet: (rows, columns, 2) in texels, and the chart if any."""

    surface: Surface
    light: np.ndarray
    chart: Chart | None


def on_plane(sheet: str, points: np.ndarray) -> np.ndarray:
    """Return where points (..., 3) lie in the sheet ``floor`` or ``north``, (..., 2) in texels."""
    (width, height), inside = SIZES[sheet], plan.INSIDE
    s = (points[..., 0] - inside.west) / (inside.east - inside.west)
    if sheet == "floor":
        t = (points[..., 2] - inside.north) / (inside.south - inside.north)
    else:
        t = 1.0 - points[..., 1] / plan.CROWN
    return np.stack([s * width, t * height], axis=-1)


def of_plane(sheet: str) -> np.ndarray:
    """Return the place (height, width, 3) at the centre of each texel of ``floor`` or ``north``."""
    (width, height), inside = SIZES[sheet], plan.INSIDE
    s, t = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    x = inside.west + s * (inside.east - inside.west)
    if sheet == "floor":
        return np.stack([x, 0 * x, inside.north + t * (inside.south - inside.north)], axis=-1)
    return np.stack([x, (1.0 - t) * plan.CROWN, 0 * x + inside.north], axis=-1)


def placed(surfaces: Sequence[Surface]) -> list[Lit]:
    """Return each surface with its place in its sheet.

    One that is joined to an edge takes the texels along that edge, in all its rows.
    """
    charted = [each for each in surfaces if each.sheet == "hall" and each.edge is None]
    by_surface = dict(zip(map(id, charted), charts(charted, SIDE, TEXELS), strict=True))

    def lit(surface: Surface) -> Lit:
        if surface.edge is not None:
            neighbour = surface.edge.surface
            row = in_chart(neighbour, by_surface[id(neighbour)])[surface.edge.row]
            return Lit(surface, np.broadcast_to(row, (*surface.points.shape[:2], 2)), None)

        chart = by_surface.get(id(surface))
        if chart is None:
            return Lit(surface, on_plane(surface.sheet, surface.points), None)
        return Lit(surface, in_chart(surface, chart), chart)

    return [lit(surface) for surface in surfaces]


def coded(light: np.ndarray) -> np.ndarray:
    """Return linear light (h, w, 3) as the bytes of a light map; 1 leaves a texture as it is."""
    half = np.maximum(light, 0.0) ** (1 / GAMMA) / SCALE
    # The brightest are compressed, so that patches of sun keep their shape.
    soft = np.where(half < 0.75, half, 0.75 + 0.25 * (1.0 - np.exp(-(half - 0.75) / 0.25)))
    return np.asarray(soft * 255.0 + 0.5, np.uint8)


def packed(light: np.ndarray, most: float) -> np.ndarray:
    """Return linear light of up to ``most`` as bytes, finest where it is dark."""
    return np.asarray(np.sqrt(np.clip(light / most, 0.0, 1.0)) * 255.0 + 0.5, np.uint8)


def unpacked(image: np.ndarray, most: float) -> np.ndarray:
    """Return the linear light of bytes from :func:`packed`, float32."""
    return np.asarray((image.astype(np.float32) / 255.0) ** 2 * most)


def glare(sheet: str) -> np.ndarray:
    """Return how much brighter the torch is (h, w, 1) on ``floor`` or ``north``.

    Its bowl throws most of the light level and northwards, past the statue onto the north wall.
    """
    east, up, south = np.moveaxis(of_plane(sheet) - plan.TORCH, -1, 0)
    level = np.hypot(east, south)
    northwards = np.maximum(-south, 0.0) / level
    beam = northwards * (level / np.hypot(level, up)) ** 4
    return np.asarray(1.0 + (GLARE[sheet] - 1.0) * beam, np.float32)[..., None]


def with_sun_as_alpha(coded_light: np.ndarray) -> np.ndarray:
    """Return a light map (h, w, 3) with how much of its light is the sun's as alpha, (h, w, 4).

    In the pool no other light is as strong as SHADE: what exceeds it is the sun's.
    """
    light = (SCALE * coded_light.astype(np.float32).mean(axis=2) / 255.0) ** GAMMA
    share = np.clip(1.0 - SHADE / np.maximum(light, SHADE), 0.0, 1.0)
    # The mean of 3 x 3 texels, without the grain of the traced rays.
    for axis in (0, 1):
        share = (np.roll(share, 1, axis) + share + np.roll(share, -1, axis)) / 3.0
    alpha = np.rint(255.0 * share)[..., None].astype(np.uint8)
    return np.ascontiguousarray(np.concatenate([coded_light, alpha], axis=2))


def light_map(picture: np.ndarray, sheet: str, sun: float = 1.0, torch: float = 1.0) -> np.ndarray:
    """Return the light map of a sheet, uint8 (h, w, 3), from the picture in FILE.

    That of ``hall`` has a fourth channel: :func:`with_sun_as_alpha`.
    On ``floor`` and ``north``, ``sun`` and ``torch`` (the one beside the pool) multiply
    the direct light of these two, so that 0 gives what a shadow leaves.
    """
    width, height = SIZES[sheet]

    def part(place: tuple[int, int]) -> np.ndarray:
        x, y = place
        return picture[y : y + height, x : x + width]

    if sheet == "hall":
        return with_sun_as_alpha(part(HALL))
    light = unpacked(part(BASES[sheet]), BASE_MOST)
    apart = part(PARTS[sheet])
    light += sun * unpacked(apart[..., :1], SUN_MOST) * np.array(SUN_COLOUR, np.float32)
    flame = torch * glare(sheet) * unpacked(apart[..., 1:2], TORCH_MOST)
    light += flame * np.array(TORCH_COLOUR, np.float32)
    return coded(light)
