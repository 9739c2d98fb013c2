"""The vertices of all stones: seated in the ground, lit, mossy, and dark where they meet it.

A stone sinks until the lower part of it is under the ground all around, so that none floats. Its
light is painted into its vertices as that of the ground is into the ground's texture: the sun, the
sky as far as it is seen, and less of both where ground and stone meet. No OpenGL here.
"""

from dataclasses import dataclass

import numpy as np

from landscape.elements.best.stones.scattering import Stones, patches
from landscape.elements.best.stones.shapes import CRAG, LOG, PEBBLE, STONE, Shape
from landscape.elements.best.terrain.tone import STONES_DRAINED, bare_toned
from landscape.elements.ground import Ground
from landscape.elements.settings import Settings
from landscape.elements.sun import direction, painted
from landscape.geometry.height_field import greenness
from landscape.geometry.ramp import ramp

LEVELS = 3  # the most that a shape has
# All chosen.
# Lowest part of a stone, of its height, that is always under the ground; a crag stands in a slope.
FOOT = (0.2, 0.36, 0.36, 0.36, 0.36)
SUNK = 0.06  # of the radius, by which it is
LEAST = 0.1  # of the height: a stone that sticks out by less is left out
REPEATS = 4.0  # of the rock's texture per unit
SOFTER = 0.6  # exponent of how open a vertex is to the sky
DIRTY = 0.45  # of the radius: how far up earth and shadow cling to a stone
GAMMA = 2.2
# sRGB in full sun: two rocks, a warm and a pale pebble, bleached wood, moss, lichen.
SLATE = (116, 112, 108)
ROCK = (152, 145, 134)
WARM = (154, 136, 112)
PALE = (184, 178, 166)
WOOD = (158, 148, 133)
MOSS = (88, 97, 52)
LICHEN = (160, 160, 142)
# Linear light.
SUN = (0.66, 0.60, 0.52)
SKY = (0.42, 0.48, 0.60)
BOUNCE = (0.03, 0.03, 0.02)

ALIKE = 0.8  # how far a stone has the hue of bare ground around it
WET = 0.55  # of the colour is left on wet stone
TIDE = 0.012  # units above the water to which waves wet it

VERTEX = np.dtype([("place", "<f4", 2), ("colour", "u1", 4), ("point", "<f4", 3)])


@dataclass(frozen=True)
class Bodies:
    """Vertices of all stones, VERTEX (v,), and of each stone, in the same order, where they are.

    ``firsts`` (n, LEVELS) is the first vertex of each level of its shape, ``shapes`` (n,) that
    shape, ``middles`` (n, 3) and ``radii`` (n,) its bounding sphere; ``tops`` (n,) its highest
    point.
    A vertex's alpha is the fraction of its colour that is the sun's, gone in a shadow.
    """

    vertices: np.ndarray
    firsts: np.ndarray
    shapes: np.ndarray
    middles: np.ndarray
    radii: np.ndarray
    tops: np.ndarray


def seated(ground: Ground, shape: Shape, stones: Stones, mine: np.ndarray) -> np.ndarray:
    """Return the heights (m,) of the middles of stones ``mine`` (m,) of one shape."""
    radii = stones.radii[mine]
    at = np.einsum("mij,vj->mvi", stones.turns[mine] * radii[:, None, None], shape.vertices)
    low, high = at[..., 1].min(axis=1), at[..., 1].max(axis=1)
    foot = at[..., 1] < (low + np.array(FOOT)[stones.kinds[mine]] * (high - low))[:, None]
    x, z = (stones.places[mine, k, None] + at[..., 2 * k] for k in range(2))
    room = np.where(foot, ground.terrain_height(x, z) - at[..., 1], np.inf)
    return np.asarray(room.min(axis=1) - SUNK * radii)


def bodies(
    settings: Settings, ground: Ground, stones: Stones, shapes: list[list[Shape]], seed: int
) -> Bodies:
    """Return all stones as they lie on the ground; what hardly sticks out of it is left out."""
    parts = []
    rows = []
    total = 0
    for k, levels in enumerate(shapes):
        mine = np.flatnonzero(stones.shapes == k)
        middles = np.insert(stones.places[mine], 1, seated(ground, levels[0], stones, mine), axis=1)
        tops = np.zeros(len(mine))
        firsts = np.zeros((len(mine), LEVELS), np.int64)
        for level, shape in enumerate(levels):
            scale = stones.turns[mine] * stones.radii[mine][:, None, None]
            points = np.einsum("mij,vj->mvi", scale, shape.vertices) + middles[:, None]
            if not level:
                over = points[..., 1] - ground.terrain_height(points[..., 0], points[..., 2])
                high = np.ptp(shape.vertices[:, 1]) * stones.radii[mine]
                kept = over.max(axis=1) > LEAST * high
                mine = mine[kept]
                middles = middles[kept]
                points = points[kept]
                firsts = firsts[kept]
                tops = points[..., 1].max(axis=1)
            made = painted_vertices(settings, ground, stones, mine, shape, points, seed)
            parts.append(made.reshape(-1))
            firsts[:, level] = total + len(shape.vertices) * np.arange(len(mine))
            total += made.size
        rows.append((firsts, np.full(len(mine), k), middles, stones.radii[mine], tops))

    columns = [np.concatenate(column) for column in zip(*rows, strict=True)]
    return Bodies(np.concatenate(parts), *columns)


def painted_vertices(
    settings: Settings,
    ground: Ground,
    stones: Stones,
    mine: np.ndarray,
    shape: Shape,
    points: np.ndarray,
    seed: int,
) -> np.ndarray:
    """Return the vertices VERTEX (m, v) of stones ``mine`` of one shape at ``points`` (m, v, 3)."""
    normals = np.einsum("mij,vj->mvi", stones.turns[mine], shape.normals)
    normals /= np.maximum(np.linalg.norm(normals, axis=2, keepdims=True), 1e-9)
    x, y, z = np.moveaxis(points, 2, 0)
    radii = stones.radii[mine][:, None]
    over = y - ground.terrain_height(x, z)
    light, sunny = daylight(settings, normals, shape.openness**SOFTER * np.ones_like(x))
    colour = albedo(settings, ground, stones, mine, points, normals, seed) * light
    if settings.ground.tone:
        colour = bare_toned(colour, settings.ground.tone, STONES_DRAINED)

    # Earth and shadow where it meets the ground, whose colour there is the stone's, too.
    earth = ground.drawn_colour(x.ravel(), z.ravel()).reshape(*x.shape, 3)
    if settings.sun.relit:
        earth = earth * painted(settings.sun, normals @ direction(settings.sun))
    clean = ramp(0.0, 1.0, over / (DIRTY * radii))[..., None]
    shadow = 0.5 + 0.5 * clean**0.7
    colour = (earth + (colour - earth) * (0.25 + 0.75 * clean)) * shadow
    wet = ramp(TIDE, 0.3 * TIDE, y - settings.water.level)[..., None]
    colour = colour * (1.0 - (1.0 - WET) * wet)
    made = np.zeros(x.shape, VERTEX)
    made["point"] = points
    made["colour"][..., :3] = np.clip(colour * 255.0 + 0.5, 0, 255)
    made["colour"][..., 3] = sunny * 255.0
    own = np.random.default_rng([seed, 73]).random((len(stones.radii), 2))[mine]
    made["place"] = shape.coordinates * (REPEATS * radii[..., None]) + own[:, None]
    return made


def albedo(
    settings: Settings,
    ground: Ground,
    stones: Stones,
    mine: np.ndarray,
    points: np.ndarray,
    normals: np.ndarray,
    seed: int,
) -> np.ndarray:
    """Return the colours without light, sRGB (m, v, 3) in 0..1: rock, wood, lichen and moss."""
    tone, kind = stones.tones[mine][:, None, None], stones.kinds[mine][:, None, None]
    slate, rock, warm, pale = (np.array(each) / 255.0 for each in (SLATE, ROCK, WARM, PALE))
    found = slate + (rock - slate) * np.clip(1.6 * tone, 0, 1)
    found = found + (warm - found) * np.clip(2.0 * tone - 1.1, 0, 0.8)
    found = np.where(kind == PEBBLE, warm + (pale - warm) * tone, found)
    found = np.where(kind == LOG, np.array(WOOD) / 255.0 * (0.8 + 0.4 * tone), found)
    x, y, z = np.moveaxis(points, 2, 0)
    rng = np.random.default_rng([seed, 72])
    found = found * (1.0 + 0.16 * (rng.random((len(mine), 1, 1)) - 0.5))
    fine = patches(seed + 4, 600, settings.ground.size)(x + 0.7 * y, z - 0.6 * y)
    found = found * (1.0 + 0.3 * (fine - 0.5)[..., None])

    # Rock has the hue of the rock around it.
    earth = ground.drawn_colour(*stones.places[mine].T)
    hue = (earth / np.maximum(earth.mean(axis=1, keepdims=True), 0.05))[:, None]
    local = hue * found.mean(axis=2, keepdims=True)
    alike = ALIKE * (1.0 - greenness(earth))[:, None, None] * (kind <= STONE)
    found = found + (local - found) * alike
    near = greenness(earth)[:, None]
    dry = ramp(0.06, 0.2, y - settings.water.level) * (stones.kinds[mine] <= CRAG + 1)[:, None]
    moss = ramp(0.45, 0.85, normals[..., 1] + 0.5 * (fine - 0.5)) * dry * (0.25 + 0.6 * near)
    pale_patch = ramp(0.62, 0.8, fine) * dry * 0.5 * (1.0 - near)
    found = found + (np.array(LICHEN) / 255.0 - found) * pale_patch[..., None]
    return np.asarray(found + (np.array(MOSS) / 255.0 - found) * moss[..., None])


def daylight(
    settings: Settings, normals: np.ndarray, openness: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the factor (..., 3) on sRGB colours, and how much of it is the sun's, (...)."""
    sun, towards = settings.sun, direction(settings.sun)
    facing = normals @ towards
    if sun.relit:
        light = painted(sun, facing)
        share = 1.0 - (np.array(sun.shade) / light).mean(axis=-1)
        return light * (0.45 + 0.55 * openness[..., None]), np.clip(share, 0.0, 1.0)
    direct = np.maximum(facing, 0.0) / max(float(towards[1]), 0.3)
    direct = 1.35 * direct / (1.0 + 0.35 * direct) * (0.4 + 0.6 * openness)
    sky = openness * (0.6 + 0.4 * normals[..., 1])
    rest = np.array(SKY) * sky[..., None] + np.array(BOUNCE)
    whole = rest + np.array(SUN) * direct[..., None]
    share = 1.0 - ((rest / whole) ** (1.0 / GAMMA)).mean(axis=-1)
    return whole ** (1.0 / GAMMA) * sun.tint, share
