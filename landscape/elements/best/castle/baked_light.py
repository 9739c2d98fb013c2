"""The castle's light map: sun, sky and weather on its stones, computed once. No OpenGL here.

OpenGL lights each vertex as if nothing stood between it and the sun. A light map adds the shadows:
every part of the surface gets a box of texels in one small texture, and for each texel rays are
sent to the sun and over the sky, which towers, walls and keep may block. The remaining light,
times stains from rain and damp, multiplies the bricks in a second texture unit. Places are in the
castle's own frame, see geometry/masonry.py. Not in the report; a technique of its time.
"""

import math
from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from landscape.elements.best.castle.ornate_masonry import BAND, KEEP, ROOFED
from landscape.elements.best.castle.roofs import CONE, KEEP_ROOF
from landscape.elements.castle_fire import FLAME_Z, TORCHES
from landscape.elements.settings import Sun
from landscape.elements.sun import direction
from landscape.geometry.masonry import CORNERS, FOOT, TOWER_RADIUS, TOWER_TOP, WALL, wall_boxes
from landscape.geometry.mesh import Mesh

Box = tuple[float, float, float, float, float, float]
Cylinder = tuple[float, float, float, float, float]
# All chosen.
TEXELS = 64  # texels per unit of the castle's own frame, where a wall is 1 long
SIDE = 512  # texels per side of the texture
OFF = 0.004  # units: distance from the surface at which a ray starts
PENUMBRA = 0.03  # radians that the rays to the sun spread over, so that its shadow has a soft edge
SUN_RAYS, SKY_RAYS = 7, 28
BLOCK = 16384  # rays that are followed together
BOUNCE = np.array([0.30, 0.29, 0.22])  # fraction of the sky's light the ground reflects, RGB
BETWEEN = 0.60  # fraction of the hidden sky's light that the yard's walls send to each other
CONTACT = 0.10  # units over which the ground darkens the foot of a wall
LATTICE = 32  # lattice points per side of the noise, which then repeats
RUNS = 0.24  # length in units of the streaks that rain leaves under a ledge
FLAME_Y = 0.26  # height of the flames' middle
FLAME = np.array([1.10, 0.55, 0.20])  # their light, RGB
NEAR = 0.24  # units from a flame at which its light is half as strong
EXPOSURE = 1.08  # times the light, as the weathering darkens the stones


def turned_sun(sun: Sun, yaw: float) -> np.ndarray:
    """Return the unit vector (3,) towards the sun in the castle's frame, turned by ``yaw`` degrees.

    The inverse of glRotatef about y, which turns the castle's frame into the island's.
    """
    x, y, z = direction(sun).tolist()
    c, s = math.cos(math.radians(yaw)), math.sin(math.radians(yaw))
    return np.array([x * c - z * s, y, x * s + z * c])


@lru_cache(maxsize=1)
def solids() -> tuple[list[Box], list[Cylinder]]:
    """Return what blocks light, as boxes and cylinders.

    A box is (x0, y0, z0, x1, y1, z1), a cylinder (x, z, radius, y0, y1).
    """
    boxes = [
        (0.0, -FOOT, 0.0, 1.0, 1.0, WALL),
        (0.0, -FOOT, 1.0 - WALL, 1.0, 1.0, 1.0),
        (0.0, -FOOT, 0.0, WALL, 1.0, 1.0),
        (1.0 - WALL, -FOOT, 0.0, 1.0, 1.0, 1.0),
        *wall_boxes(),
    ]
    x0, z0, x1, z1, top = KEEP
    boxes.append((x0, -FOOT, z0, x1, top, z1))
    for share in (0.0, 0.25, 0.5, 0.75):  # the pyramid, approximated by steps
        a = share * (x1 - x0) / 2 - 0.05 * (1 - share)
        y = top + share * KEEP_ROOF
        boxes.append((x0 + a, y, z0 + a, x1 - a, y + KEEP_ROOF / 4, z1 - a))
    return boxes, _towers()


def _towers() -> list[Cylinder]:
    """Return the towers as cylinders, with their battlements, and their roofs as steps."""
    round_ = [(x, z, TOWER_RADIUS, -FOOT, TOWER_TOP - 0.12) for x, z in CORNERS]
    round_ += [(x, z, TOWER_RADIUS + 0.03, TOWER_TOP - 0.11, TOWER_TOP) for x, z in CORNERS]
    radius, tip = CONE
    for share in (0.0, 0.25, 0.5, 0.75):
        low = TOWER_TOP + share * (tip - TOWER_TOP)
        high = low + (tip - TOWER_TOP) / 4
        round_ += [(x, z, radius * (1 - share), low, high) for x, z in ROOFED]
    return round_


def stopped(places: np.ndarray, ray: np.ndarray) -> np.ndarray:
    """Return which rays (n,) from places (n, 3) along a rising ``ray`` (3,) hit a solid."""
    hit = np.zeros(len(places), bool)
    for first in range(0, len(places), BLOCK):  # what fits into the processor's cache is faster
        block = slice(first, first + BLOCK)
        hit[block] = _stopped(places[block], ray)
    return hit


def _stopped(places: np.ndarray, ray: np.ndarray) -> np.ndarray:
    dx, dy, dz = np.where(np.abs(ray) < 1e-9, 1e-9, ray).tolist()
    x, y, z = np.ascontiguousarray(places.T)
    hit = np.zeros(len(places), bool)
    boxes, round_ = solids()
    for x0, y0, z0, x1, y1, z1 in boxes:
        enter, leave = np.zeros(len(places)), np.full(len(places), np.inf)
        for p, d, low, high in ((x, dx, x0, x1), (y, dy, y0, y1), (z, dz, z0, z1)):
            first, last = (low, high) if d > 0.0 else (high, low)
            np.maximum(enter, (first - p) / d, out=enter)
            np.minimum(leave, (last - p) / d, out=leave)
        hit |= enter < leave

    across = dx * dx + dz * dz
    for cx, cz, radius, y0, y1 in round_:
        nearest = -((x - cx) * dx + (z - cz) * dz) / across
        off = np.square(x + nearest * dx - cx) + np.square(z + nearest * dz - cz)
        near = np.flatnonzero(off < radius * radius)
        nearest = nearest[near]
        off = off[near]
        height = y[near]
        half = np.sqrt((radius * radius - off) / across)
        enter = np.maximum(np.maximum(nearest - half, (y0 - height) / dy), 0.0)
        hit[near] |= enter < np.minimum(nearest + half, (y1 - height) / dy)

    return hit


def around(ray: np.ndarray, count: int, angle: float) -> list[np.ndarray]:
    """Return ``count`` unit vectors (3,): ``ray``, and others within ``angle`` radians of it."""
    aside = np.cross(ray, (0.0, 1.0, 0.0))
    aside /= max(float(np.linalg.norm(aside)), 1e-9)
    over = np.cross(aside, ray)
    rays = []
    for k in range(count):
        turn, off = 2.4 * k, angle * math.sqrt(k / count)  # the golden angle spreads them evenly
        one = ray + off * (math.cos(turn) * aside + math.sin(turn) * over)
        rays.append(one / np.linalg.norm(one))
    return rays


def sky_rays(count: int) -> list[np.ndarray]:
    """Return unit vectors (3,) spread evenly over the upper half of the sphere."""
    heights = (np.arange(count) + 0.5) / count
    turns = 2.399963 * np.arange(count)
    level = np.sqrt(1.0 - heights * heights)
    return list(np.stack([level * np.cos(turns), heights, level * np.sin(turns)], axis=1))


def open_to(places: np.ndarray, normals: np.ndarray, rays: Sequence[np.ndarray]) -> np.ndarray:
    """Return 0..1 (n,), the fraction of the light along ``rays`` that reaches the surface.

    Each ray is weighted by the cosine of its angle of incidence; 0 if none is in front.
    """
    start = places + OFF * normals
    got, all_ = np.zeros(len(places)), np.full(len(places), 1e-9)
    for ray in rays:
        weight = np.maximum(normals @ ray, 0.0)
        towards = np.flatnonzero(weight > 0.0)
        all_ += weight
        got[towards] += weight[towards] * ~stopped(start[towards], ray)
    return np.asarray(got / all_)


def noise(places: np.ndarray, frequency: tuple[float, float, float], seed: int) -> np.ndarray:
    """Return smooth noise 0..1 (n,) at places (n, 3); ``frequency`` is in bumps per unit."""
    lattice = np.random.default_rng([2006, seed]).random((LATTICE,) * 3)
    at = places * np.array(frequency) + 7.3
    low = np.floor(at).astype(int)
    part = at - low
    part = part * part * (3.0 - 2.0 * part)
    total = np.zeros(len(places))
    for corner in np.ndindex(2, 2, 2):
        weight = np.prod(np.where(np.array(corner) > 0, part, 1.0 - part), axis=1)
        total += weight * lattice[tuple(((low + corner) % LATTICE).T)]
    return total


def weather(places: np.ndarray) -> np.ndarray:
    """Return the weathering of the stones at places (n, 3), factors (n, 3) up to 1.

    Paler and darker patches, streaks of rain under ledges, damp and green at the foot. All numbers
    are chosen by eye.
    """
    y = places[:, 1]
    patches = 0.6 * noise(places, (3.1, 3.7, 3.1), 1) + 0.4 * noise(places, (9.0, 11.0, 9.0), 2)
    streaks = np.clip(2.2 * noise(places, (31.0, 1.3, 31.0), 3) - 0.7, 0.0, 1.0)
    wet = np.zeros(len(places))
    for ledge in (BAND[0], TOWER_TOP - 0.16, KEEP[4] - 0.10):
        below = ledge - y
        wet = np.maximum(wet, np.where(below > 0, np.exp(-below / RUNS), 0.0))
    damp = np.exp(-np.maximum(y, 0.0) / (0.02 + 0.22 * noise(places, (5.0, 0.0, 5.0), 4)))
    grey = 1.0 - 0.19 * np.clip(1.5 * patches - 0.35, 0.0, 1.0)
    grey *= (1.0 - 0.38 * streaks * (0.15 + 0.85 * wet)) * (1.0 - 0.26 * damp)
    warm = np.array([0.05, 0.0, -0.06]) * (patches - 0.5)[:, None]
    green = np.array([0.15, 0.01, 0.21]) * damp[:, None]
    return np.asarray(np.clip(grey[:, None] * (1.0 + warm - green), 0.0, 1.0))


def torchlight(places: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """Return the light (n, 3) that the two flames cast on places with normals (n, 3)."""
    total = np.zeros((len(places), 1))
    for x in TORCHES:
        line = np.array([x, FLAME_Y, FLAME_Z]) - places
        far = np.linalg.norm(line, axis=1)
        facing = np.maximum((normals * line).sum(axis=1) / np.maximum(far, 1e-6), 0.0)
        total[:, 0] += (0.25 + 0.75 * facing) * (normals[:, 2] < 0.5) / (1.0 + (far / NEAR) ** 2)
    before = np.clip(1.0 - places[:, 2:] / 0.1, 0.0, 1.0)  # the walls hide what is behind them
    return np.asarray(total * before * FLAME)


def in_yard(places: np.ndarray) -> np.ndarray:
    """Return 0..1 (n,), how deep places (n, 3) are in the yard: 0 outside and at the walls' top."""
    inside = np.abs(places[:, [0, 2]] - 0.5).max(axis=1) < 0.5 - WALL + 2 * OFF
    return np.asarray(inside * np.clip(3.0 * (1.0 - places[:, 1]), 0.0, 1.0))


def light(
    places: np.ndarray, normals: np.ndarray, sun: Sun, yaw: float, torches: float = 0.0
) -> np.ndarray:
    """Return the colours (n, 3) that multiply OpenGL's light at places with normals (n, 3).

    They combine the unblocked light of sun and sky with the weathering. OpenGL clamps its lighting
    at 1, where the sun adds little to the sky's light, so these may exceed 1. ``yaw`` in degrees;
    ``torches`` (0..1) is the strength of the flames' light.
    """
    return np.asarray(arriving(places, normals, sun, yaw, torches) * weather(places))


def arriving(
    places: np.ndarray, normals: np.ndarray, sun: Sun, yaw: float, torches: float = 0.0
) -> np.ndarray:
    """Return what :func:`light` does, without the weathering."""
    towards = turned_sun(sun, yaw)
    across = np.array([-towards[0], 0.5, -towards[2]]) / math.hypot(towards[0], towards[2], 0.5)
    ambient, diffuse = np.array(sun.ambient), np.array(sun.diffuse)
    direct = np.maximum(normals @ towards, 0.0)[:, None] * diffuse
    fill = sun.fill * np.maximum(normals @ across, 0.0)[:, None] * ambient
    sky = open_to(places, normals, sky_rays(SKY_RAYS))[:, None]
    sky += BETWEEN * in_yard(places)[:, None] * (1.0 - sky)
    ground = 1.0 - 0.6 * np.exp(-np.maximum(places[:, 1:2], 0.0) / CONTACT)
    up = (1.0 + normals[:, 1:2]) / 2  # the fraction of a face's hemisphere that is sky
    seen = (up * sky + (1.0 - up) * BOUNCE * ground) / (up + (1.0 - up) * BOUNCE)
    sunny = open_to(places, normals, around(towards, SUN_RAYS, PENUMBRA))[:, None]
    left = EXPOSURE * ((ambient + fill) * seen + direct * sunny)
    left += torches * torchlight(places, normals)

    # Where no light comes from anywhere, there is none to block.
    lit = np.clip(ambient + fill + direct, 1e-6, 1.0)
    return np.asarray(left / lit)


def shelves(sizes: list[tuple[int, int]], side: int = SIDE) -> list[tuple[int, int]]:
    """Return the low corners of boxes of these sizes, packed into a square of ``side`` texels.

    The tallest come first, side by side on shelves. ValueError if they do not fit.
    """
    corners = [(0, 0)] * len(sizes)
    x = y = shelf = 0
    for k in sorted(range(len(sizes)), key=lambda k: -sizes[k][1]):
        wide, high = sizes[k]
        if x + wide > side:
            x = 0
            y = y + shelf
            shelf = 0
        if wide > side or y + high > side:
            raise ValueError(f"the light map needs more than {side} texels a side")
        corners[k] = x, y
        x, shelf = x + wide, max(shelf, high)
    return corners


def spread(rows: np.ndarray, wide: int, high: int) -> np.ndarray:
    """Interpolate two rows of vertices' values (2, c, 3) to (high, wide, 3) texels between them."""
    at = np.linspace(0.0, rows.shape[1] - 1.0, wide)
    left = np.minimum(at.astype(int), rows.shape[1] - 2)
    part = (at - left)[:, None]
    lines = rows[:, left] * (1.0 - part) + rows[:, left + 1] * part
    up = np.linspace(0.0, 1.0, high)[:, None, None]
    return np.asarray(lines[0] * (1.0 - up) + lines[1] * up)


def box_sizes(mesh: Mesh, strips: Sequence[np.ndarray]) -> list[tuple[int, int]]:
    """Return the width and height in texels of the box of each strip."""
    sizes = []
    for strip in strips:
        rows = mesh.vertices[strip]
        around_ = np.linalg.norm(np.diff(rows, axis=1), axis=2).sum(axis=1).max()
        up = np.linalg.norm(rows[1] - rows[0], axis=1).max()
        wide, high = (max(math.ceil(TEXELS * float(side)), 1) + 1 for side in (around_, up))
        sizes.append((wide, high))
    return sizes


def sampled(mesh: Mesh, strip: np.ndarray, wide: int, high: int) -> tuple[np.ndarray, np.ndarray]:
    """Return places and normals (wide * high, 3) of the texels of a strip of a mesh, by rows."""
    places = spread(mesh.vertices[strip].astype(float), wide, high)
    normals = spread(mesh.normals[strip].astype(float), wide, high)
    return places.reshape(-1, 3), normals.reshape(-1, 3)


def lay_strip(
    coordinates: np.ndarray,
    strip: np.ndarray,
    corner: tuple[int, int],
    size: tuple[int, int],
    side: int,
) -> None:
    """Set the texture coordinates of a strip's vertices to a box of a picture, in texels.

    The texels at its borders have their centres on them; the picture has ``side`` texels square.
    """
    (x, y), (wide, high) = corner, size
    along = x + 0.5 + np.linspace(0.0, wide - 1.0, strip.shape[1])
    coordinates[strip, 0] = along / side
    coordinates[strip, 1] = np.array([[y + 0.5], [y + high - 0.5]]) / side


def empty_map(mesh: Mesh, side: int) -> tuple[np.ndarray, np.ndarray]:
    """Return a white light map, uint8 (side, side, 3), and coordinates 0, float32 (n, 2)."""
    return np.full((side, side, 3), 255, np.uint8), np.zeros((len(mesh.vertices), 2), np.float32)


def light_map(
    mesh: Mesh, strips: Sequence[np.ndarray], sun: Sun, yaw: float, torches: float = 0.0
) -> tuple[np.ndarray, np.ndarray]:
    """Return the light map, uint8 (SIDE, SIDE, 3), and texture coordinates in it, float32 (n, 2).

    It holds half the factor; GL_RGB_SCALE doubles it. ``strips`` are indices of the mesh's
    vertices, (2, c) each: a lower and an upper row with the surface between them. The texels at a
    strip's borders have their centres on them, so that neighbouring strips do not bleed in.
    """
    sizes = box_sizes(mesh, strips)
    picture, coordinates = empty_map(mesh, SIDE)
    places = []
    normals = []
    boxes = []
    for strip, (wide, high), (x, y) in zip(strips, sizes, shelves(sizes), strict=True):
        lay_strip(coordinates, strip, (x, y), (wide, high), SIDE)
        strip_places, strip_normals = sampled(mesh, strip, wide, high)
        places.append(strip_places)
        normals.append(strip_normals)
        boxes.append((slice(y, y + high), slice(x, x + wide)))

    facing = np.concatenate(normals)
    facing /= np.maximum(np.linalg.norm(facing, axis=1, keepdims=True), 1e-9)
    shades = np.minimum(light(np.concatenate(places), facing, sun, yaw, torches) / 2.0, 1.0)
    colours = np.asarray(shades * 255 + 0.5, np.uint8)
    first = 0
    for box, points in zip(boxes, places, strict=True):
        shape = box[0].stop - box[0].start, box[1].stop - box[1].start, 3
        picture[box] = colours[first : first + len(points)].reshape(shape)
        first += len(points)

    return picture, coordinates
