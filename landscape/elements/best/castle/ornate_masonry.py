"""The ornate castle's masonry: walls on a plinth, bands, battlements, a keep. No OpenGL here.

Strips describe how each surface is laid out in the light map, see baked_light.py.
In the castle's own frame, as in geometry/masonry.py.
"""

import numpy as np

from landscape.geometry.masonry import (
    CORNERS,
    FOOT,
    MERLON,
    TOWER_RADIUS,
    TOWER_TOP,
    box_quads,
    quads_mesh,
    walls_mesh,
)
from landscape.geometry.mesh import Mesh, merged, moved, revolve

# Chosen: heights from and to, and how far it projects from the wall.
PLINTH, BAND = (-FOOT, 0.075, 0.022), (0.885, 0.925, 0.012)
KEEP = (0.30, 0.56, 0.62, 0.88, 1.52)  # x0, z0, x1, z1, top
ROOFED = ((0.0, 1.0), (1.0, 1.0))  # the rear towers have conical roofs
GATE = (0.375, 0.635)  # x from and to: the part of the gate wall that the plinth leaves free


def quad_strips(count: int, first: int = 0) -> list[np.ndarray]:
    """Return a strip for each of ``count`` quads of quads_mesh: its lower and upper row (2, 2)."""
    base = first + 4 * np.arange(count)[:, None, None]
    return list(base + np.array([[0, 1], [3, 2]]))


def revolved_strips(segments: int, sides: int, first: int = 0) -> list[np.ndarray]:
    """Return a strip for each segment of a revolved profile: its rows (2, sides + 1)."""
    upper = np.arange(sides + 1)
    one = np.stack([upper + sides + 1, upper])
    return [first + 2 * (sides + 1) * k + one for k in range(segments)]


def belt(low: float, high: float, out: float, gate: tuple[float, float]) -> np.ndarray:
    """Return a band around the walls as quads (n, 4, 3): its face, a sloping top, an underside.

    The gate wall has none between the two x of ``gate``.
    """
    ring = [(0.0, 0.0), (gate[0], 0.0), (gate[1], 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    wide = [(x + out * np.sign(x - 0.5), z + out * np.sign(z - 0.5)) for x, z in ring]
    wide[1:3] = [(x, -out) for x, _ in ring[1:3]]
    quads = []
    for k in (0, 2, 3, 4, 5):
        # Against the direction of the ring, so that the faces point outwards.
        after = (k + 1) % len(ring)
        (ax, az), (bx, bz), (cx, cz), (dx, dz) = wide[after], wide[k], ring[k], ring[after]
        quads.append([(ax, low, az), (bx, low, bz), (bx, high, bz), (ax, high, az)])
        slope = high + out
        quads.append([(ax, high, az), (bx, high, bz), (cx, slope, cz), (dx, slope, dz)])
        quads.append([(dx, low, dz), (cx, low, cz), (bx, low, bz), (ax, low, az)])
    return np.array(quads)


def ring_of_merlons(radius: float, base: float, count: int) -> np.ndarray:
    """Return battlements around a tower about the y axis, quads (n, 4, 3)."""
    quads = []
    inner = radius - 0.035
    top = base + 0.8 * MERLON
    half = 0.29 * 2 * np.pi / count
    for middle in 2 * np.pi * np.arange(count) / count:
        a, b = middle - half, middle + half
        p, q = ((radius * np.cos(v), radius * np.sin(v)) for v in (a, b))
        r, s = ((inner * np.cos(v), inner * np.sin(v)) for v in (b, a))
        for (ax, az), (bx, bz) in ((q, p), (r, q), (s, r), (p, s)):
            quads.append([(ax, base, az), (bx, base, bz), (bx, top, bz), (ax, top, az)])
        quads.append([(x, top, z) for x, z in (q, p, s, r)])
    return np.array(quads)


def ornate_tower(repeat: float, crowned: bool) -> tuple[Mesh, list[np.ndarray]]:
    """Return a tower about the y axis with plinth and band, and its strips for the light map.

    It has battlements if ``crowned``, otherwise none, as it gets a roof.
    """
    r = TOWER_RADIUS
    top = TOWER_TOP
    sides = 24
    low, high, out = PLINTH
    profile = [(r + out, low), (r + out, high), (r, high + out), (r, BAND[0])]
    profile += [(r + BAND[2], BAND[0]), (r + BAND[2], BAND[1]), (r, BAND[1] + BAND[2])]
    profile += [(r, top - 0.16), (r + 0.03, top - 0.10), (r + 0.03, top)]
    profile += [(r - 0.01, top), (r - 0.01, top - 0.06), (0.0, top - 0.06)]
    shaft = revolve(profile, sides, (max(1, round(2 * np.pi * r * repeat)), 1))

    # Texture coordinates by height, so that the courses of towers and walls line up.
    round_, _ = shaft.coordinates[0].T
    level = np.stack([round_, (1.0 - shaft.vertices[:, 1]) * repeat], axis=1).astype(np.float32)
    shaft = Mesh(shaft.vertices, shaft.normals, shaft.triangles, (level,))
    strips = revolved_strips(len(profile) - 1, sides)
    if not crowned:
        return shaft, strips
    crown = ring_of_merlons(r + 0.03, top, 9)
    strips += quad_strips(len(crown), len(shaft.vertices))
    return merged([shaft, quads_mesh(crown, repeat)]), strips


def ornate_masonry(repeat: float) -> tuple[Mesh, list[np.ndarray]]:
    """Return everything of the ornate castle that is made of bricks, and the light map's strips.

    The first quad is the gate wall's outer face above y = 0.
    """
    quads = _flat_quads(repeat)
    meshes, strips = [quads_mesh(quads, repeat)], quad_strips(len(quads))
    for x, z in CORNERS:
        tower, rows = ornate_tower(repeat, (x, z) not in ROOFED)
        first = sum(len(mesh.vertices) for mesh in meshes)
        strips += [row + first for row in rows]
        meshes.append(moved(tower, x, z))

    return merged(meshes), strips


def _flat_quads(repeat: float) -> np.ndarray:
    """Return the quads (n, 4, 3) of the walls, with their belts, and of the keep."""
    walls = walls_mesh(repeat).vertices.reshape(-1, 4, 3)
    under, over = walls[:1].copy(), walls[:1].copy()
    under[0, 2:, 1], over[0, :2, 1] = 0.0, 0.0
    rings = [belt(*BAND, (0.5, 0.5)), belt(*PLINTH, GATE)]
    x0, z0, x1, z1, top = KEEP
    out = 0.02
    keep = [box_quads(x0, -FOOT, z0, x1, top, z1)]
    keep.append(box_quads(x0 - out, top - 0.10, z0 - out, x1 + out, top, z1 + out))
    return np.concatenate([over, under, walls[1:], *rings, *keep])
