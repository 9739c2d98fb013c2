"""The weathered castle's light map: stains, streaks and moss at several sizes. No OpenGL here.

As baked_light.py, but with twice as many texels along each side. The light is computed at every
second one and interpolated, as it changes slowly; what the weather has done to the stones is
computed at each. All numbers are chosen by eye. Switch ``castle.weathered``.
"""

from collections.abc import Sequence

import numpy as np

from landscape.elements.best.castle.baked_light import (
    arriving,
    box_sizes,
    empty_map,
    lay_strip,
    noise,
    sampled,
    shelves,
    turned_sun,
)
from landscape.elements.best.castle.loopholes import openings
from landscape.elements.best.castle.ornate_masonry import BAND, KEEP, PLINTH
from landscape.elements.settings import Sun
from landscape.geometry.masonry import TOWER_TOP
from landscape.geometry.mesh import Mesh

SIDE = 1024  # texels per side of the texture
RUN = 0.15  # units below a ledge within which its streaks fade to a third
LOW = 0.3  # share of a ledge's streaks that the plinth has below its edge
MOSS = np.array([0.66, 0.74, 0.50])  # what moss and algae leave of the stone's colour
OCHRE, LEAD = np.array([1.05, 1.0, 0.92]), np.array([0.93, 0.955, 0.98])
SUNNY, SHADY = np.array([1.08, 1.02, 0.95]), np.array([0.99, 1.01, 1.05])
CONTRAST = 1.15  # exponent of the light, which OpenGL's clamping has flattened


def stains(places: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """Return the factors (n, 3) of large patches, damp and moss on places (n, 3)."""
    y = places[:, 1]
    large = noise(places, (2.1, 2.6, 2.1), 11)
    middle = noise(places, (6.5, 8.0, 6.5), 12)
    low = noise(places, (7.0, 2.0, 7.0), 13)
    tone = 1.0 - 0.26 * np.clip(1.9 * (0.55 * large + 0.45 * middle) - 0.62, 0.0, 1.0)
    hue = np.clip(2.4 * (0.6 * middle + 0.4 * low) - 0.7, 0.0, 1.0)[:, None]
    colour = tone[:, None] * (LEAD + hue * (OCHRE - LEAD))
    # Damp rises unevenly from the ground; ledges keep water, too.
    damp = np.exp(-np.maximum(y - 0.02, 0.0) / (0.015 + 0.17 * low * low))
    ledge = np.maximum(normals[:, 1], 0.0) * (0.15 + 0.85 * middle) * (y > 0.02)
    green = np.clip(np.maximum(0.72 * damp * (0.35 + 0.9 * middle), 0.6 * ledge), 0.0, 1.0)
    return np.asarray(colour * (1.0 - green[:, None] * (1.0 - MOSS)))


def streaks(places: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """Return the factors (n, 1) of what rain has washed down at places (n, 3)."""
    y = places[:, 1]
    narrow = noise(places, (58.0, 2.3, 58.0), 14)
    wide = noise(places, (17.0, 0.9, 17.0), 15)
    thread = np.clip(2.6 * narrow - 0.75, 0.0, 1.0) * np.clip(2.4 * wide - 0.45, 0.0, 1.0)
    wet = np.zeros(len(places))
    for ledge in (1.0, BAND[0], PLINTH[1], TOWER_TOP - 0.16, TOWER_TOP, KEEP[4] - 0.10):
        below = ledge - y
        reach = RUN * (0.45 + 1.3 * wide)
        run = np.where(below > -0.003, np.exp(-np.abs(below) / reach), 0.0)
        # All of the plinth is near its edge: as wet as below other ledges it would be a dark band.
        wet = np.maximum(wet, run * (LOW if ledge == PLINTH[1] else 1.0))

    dark = 0.42 * thread * (0.10 + 0.90 * wet) + 0.10 * wet * wet

    # Below each opening, dirt runs down from the two ends of the sill.
    for x, foot, z, _, half, _ in openings():
        near = (np.abs(places[:, 0] - x) < 0.05) & (np.abs(places[:, 2] - z) < 0.05)
        near &= (y < foot) & (y > foot - 0.30)
        if not near.any():
            continue
        away = np.hypot(places[near, 0] - x, places[near, 2] - z)
        line = np.exp(-(((away - half - 0.004) / 0.007) ** 2)) + 0.5 * np.exp(-((away / half) ** 2))
        run = np.exp(-(foot - y[near]) / (0.05 + 0.10 * wide[near]))
        dark[near] += 0.42 * line * run * (0.4 + 0.8 * narrow[near])

    upright = np.clip(1.0 - np.abs(normals[:, 1]) * 1.3, 0.0, 1.0)
    return np.asarray(1.0 - np.clip(dark * upright, 0.0, 0.72))[:, None]


def warmed(left: np.ndarray, normals: np.ndarray, sun: Sun, yaw: float) -> np.ndarray:
    """Return the light (n, 3), warmer on the sunny side and cooler in the shade."""
    facing = np.clip(2.5 * (normals @ turned_sun(sun, yaw)), 0.0, 1.0)
    level = left.mean(axis=1)
    part = (facing * np.clip(2.0 * level - 0.8, 0.0, 1.0))[:, None]
    return np.asarray(left * level[:, None] ** (CONTRAST - 1.0) * (SHADY + part * (SUNNY - SHADY)))


def worn_light(
    places: np.ndarray, normals: np.ndarray, sun: Sun, yaw: float, torches: float
) -> np.ndarray:
    """Return the colours (n, 3) that multiply OpenGL's light at single places (n, 3)."""
    left = warmed(arriving(places, normals, sun, yaw, torches), normals, sun, yaw)
    return np.asarray(left * stains(places, normals) * streaks(places, normals))


def between(coarse: np.ndarray) -> np.ndarray:
    """Return an image (h, w, 3) with a mean put between each two texels: (2h - 1, 2w - 1, 3)."""
    height, width = coarse.shape[:2]
    fine = np.empty((2 * height - 1, 2 * width - 1, 3))
    fine[::2, ::2] = coarse
    fine[::2, 1::2] = (coarse[:, 1:] + coarse[:, :-1]) / 2
    fine[1::2] = (fine[2::2] + fine[:-1:2]) / 2
    return fine


def worn_light_map(
    mesh: Mesh, strips: Sequence[np.ndarray], sun: Sun, yaw: float, torches: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return what :func:`baked_light.light_map` does, uint8 (SIDE, SIDE, 3), with more texels."""
    sizes = box_sizes(mesh, strips)
    ends = np.cumsum([0, *(wide * high for wide, high in sizes)])
    points, facing = np.empty((ends[-1], 3)), np.empty((ends[-1], 3))
    for k, (strip, (wide, high)) in enumerate(zip(strips, sizes, strict=True)):
        part = slice(ends[k], ends[k + 1])
        points[part], facing[part] = sampled(mesh, strip, wide, high)

    facing /= np.maximum(np.linalg.norm(facing, axis=1, keepdims=True), 1e-9)
    coarse = warmed(arriving(points, facing, sun, yaw, torches), facing, sun, yaw)
    coarse *= stains(points, facing)
    fine_sizes = [(2 * wide - 1, 2 * high - 1) for wide, high in sizes]
    picture, coordinates = empty_map(mesh, SIDE)
    corners = shelves(fine_sizes, SIDE)
    for k, (strip, (wide, high), (x, y)) in enumerate(
        zip(strips, fine_sizes, corners, strict=True)
    ):
        lay_strip(coordinates, strip, (x, y), (wide, high), SIDE)
        at, turned = sampled(mesh, strip, wide, high)
        flat = coarse[ends[k] : ends[k + 1]].reshape(*sizes[k][::-1], 3)
        shades = between(flat) * streaks(at, turned).reshape(high, wide, 1)
        picture[y : y + high, x : x + wide] = np.minimum(shades / 2.0, 1.0) * 255 + 0.5

    return picture, coordinates
