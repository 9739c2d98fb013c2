"""The sky box: five faces of one sky, by day and at sunset, in the looks of 2006 and of best.

:mod:`landscape.studio.sky.air` gives the clear sky. The clouds of
:mod:`landscape.studio.sky.clouds` and the far land of :mod:`landscape.studio.land.islands` are
composited over it. Everything depends on the view direction only, so the faces match along their
edges.

The box spans x and z in -8..8 and y in 0..5, with the eye at the centre of its floor. The first
and last texel centres of a face are exactly on its edges.
"""

import functools
from collections.abc import Callable

import numpy as np

from landscape.elements.unfolded_sky import unfolded
from landscape.studio.images import smoothstep, to_linear, to_srgb, to_uint8
from landscape.studio.land.islands import add_islands
from landscape.studio.sky.air import DAY, DUSK, FAIR, SUNSET, Scene, clear_sky
from landscape.studio.sky.clouds import DOMES, TOWERS, Look, add_cirrus, add_cumulus

HALF, TALL = 8.0, 5.0  # half width and height of the box, as in the scene


def directions(face: str, width: int, height: int) -> np.ndarray:
    """Return unit vectors (height, width, 3) through the texel centres of a face."""
    across = np.linspace(-HALF, HALF, width)[None, :] + np.zeros((height, 1))
    if face == "top":
        down = np.linspace(-HALF, HALF, height)[:, None] + np.zeros((1, width))
        d = np.stack([across, np.full_like(across, TALL), down], axis=-1)
    else:
        up = np.linspace(TALL, 0.0, height)[:, None] + np.zeros((1, width))
        wall = np.full_like(across, HALF)
        x, z = {
            "north": (across, -wall),
            "east": (wall, across),
            "south": (-across, wall),
            "west": (-wall, -across),
        }[face]
        d = np.stack([x, up, z], axis=-1)
    # Rounded, so that a direction shared by two faces is bitwise identical on both.
    return np.round(d / np.linalg.norm(d, axis=-1, keepdims=True), 9)


def compose(scene: Scene, look: Look, d: np.ndarray) -> np.ndarray:
    """Return the linear colours (h, w, 3) of directions (h, w, 3), with all layers composited."""
    sky = clear_sky(scene, d)
    from_sun = np.degrees(np.arccos(np.clip(d @ scene.towards_sun(), -1.0, 1.0)))
    tint = np.array(scene.sun) / max(scene.sun)
    halo, core = 0.30 * np.exp(-from_sun / 5.0), 0.5 * np.exp(-from_sun / 1.4)
    disc = smoothstep(0.9, 0.6, from_sun)
    glow = halo + core + 3.0 * disc if look.veiled_sun else halo
    sky = 1.0 - (1.0 - sky) * np.exp(-glow[..., None] * tint)
    sky = add_cirrus(scene, look, d, sky)
    sky = add_cumulus(scene, look, d, sky)
    haze = to_linear(np.array(scene.horizon_srgb))
    elevation = np.degrees(np.arcsin(np.clip(d[..., 1:2], 0.0, 1.0)))
    sky = sky + np.exp(-elevation / scene.haze_deg) * (haze - sky)
    if not look.veiled_sun:
        # At the horizon itself the colour stays that of the fog.
        glow = core[..., None] * tint + 4.0 * disc[..., None] * np.sqrt(tint)
        sky = 1.0 - (1.0 - sky) * np.exp(-glow * smoothstep(0.3, 2.5, elevation))
    return add_islands(scene, d, sky, haze)


def paint(scene: Scene, look: Look, face: str) -> np.ndarray:
    """Return one face of the box, uint8 (h, w, 3)."""
    width, height = scene.wall_width, scene.wall_width // 4
    if face == "top":
        width = height = scene.wall_width // 2
    d = directions(face, width, height)
    sky = to_srgb(compose(scene, look, d))
    if face != "top":
        # The top face has half the texels along this edge. Take its colours, or cloud detail finer
        # than its texels would show as a seam.
        coarse = to_srgb(compose(scene, look, directions(face, width // 2, 2)[:1])[0])
        x, x_coarse = np.linspace(0, 1, width), np.linspace(0, 1, width // 2)
        sky[0] = np.stack([np.interp(x, x_coarse, channel) for channel in coarse.T], axis=-1)
    # Dither by less than one level to hide 8-bit banding, except at the horizon, which must have
    # the exact colour of the fog.
    dither = np.random.default_rng(71).random((height, width, 1)) - 0.5
    dither = dither * smoothstep(0.0, 0.007, d[..., 1:2])
    return to_uint8(sky + 0.7 * dither / 255.0)


FACES = ("north", "east", "south", "west", "top")
# Prefix of the files, their suffix, the light and the clouds of each set.
SETS = (
    ("sky_", "png", DAY, TOWERS),
    ("sky_sunset_", "png", SUNSET, TOWERS),
    ("sky_fair_", "jpg", FAIR, DOMES),
    ("sky_dusk_", "jpg", DUSK, DOMES),
)
UNFOLDED = (630, 197)  # chosen: texels of the top's side and of a wall's height; 1024 together


def unfolded_day() -> np.ndarray:
    """Return the five faces of the day's first set in one picture, (1024, 1024, 3)."""
    _, _, scene, look = SETS[0]
    return unfolded([paint(scene, look, face) for face in FACES], *UNFOLDED)[..., :3]


ASSETS: dict[str, Callable[[], np.ndarray]] = {
    f"{prefix}{face}.{suffix}": functools.partial(paint, scene, look, face)
    for prefix, suffix, scene, look in SETS
    for face in FACES
} | {"sky_unfolded.jpg": unfolded_day}
