"""The castle's meshes as arrays: walls, battlements, towers, and what adorns them. No OpenGL here.

In 2006 the castle was four walls and four towers. With ``castle.ornate`` they stand on a plinth and
carry bands, loopholes and battlements; a keep rises in the court, and roofs on it and on the two
towers behind. Strips say how a surface may be laid into the light map: see castle_light.
Own frame: the unit square x, z in 0..1, the gate wall at z = 0, y up from the ground.
"""

import numpy as np

from landscape.elements.terrain.shadows import on_edges
from landscape.geometry.mesh import Mesh, revolve, vertex_normals

FOOT = 0.35  # chosen: units the walls reach into the ground, so that no slope shows under them
TOWER_RADIUS = 0.13  # chosen
TOWER_TOP = 1.22  # chosen
CORNERS = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
MERLON = 0.07  # chosen: height of the battlements
TORCHES = (0.27, 0.75)  # section 6.1: 0.27, and 0.48 farther
WALL = 0.045  # chosen: thickness of the walls
# Chosen, of the ornate castle: heights from and to, and how far it stands out of the wall.
PLINTH, BAND = (-FOOT, 0.075, 0.022), (0.885, 0.925, 0.012)
KEEP = (0.30, 0.56, 0.62, 0.88, 1.52)  # x0, z0, x1, z1, top
ROOFED = ((0.0, 1.0), (1.0, 1.0))  # the towers behind wear cones
GATE = (0.375, 0.635)  # x from and to of the gate wall that the plinth leaves free
CONE = (TOWER_RADIUS + 0.05, TOWER_TOP + 0.36)  # radius of the eaves, height of the tip
KEEP_ROOF = 0.34  # height of its pyramid
MASTS = ((0.46, 0.72, 1.52 + KEEP_ROOF, 0.20), (0.0, 1.0, TOWER_TOP + 0.35, 0.14))


def wall_boxes() -> list[tuple[float, float, float, float, float, float]]:
    """Return the battlements as boxes (x0, y0, z0, x1, y1, z1) standing on the four walls."""
    boxes = []
    depth, width = WALL, 0.075
    for k in range(5):
        a = 0.17 + k * (0.66 - width) / 4
        b = a + width
        boxes += [
            (a, 1.0, 0.0, b, 1.0 + MERLON, depth),
            (a, 1.0, 1.0 - depth, b, 1.0 + MERLON, 1.0),
            (0.0, 1.0, a, depth, 1.0 + MERLON, b),
            (1.0 - depth, 1.0, a, 1.0, 1.0 + MERLON, b),
        ]
    return boxes


def quads_mesh(quads: np.ndarray, repeat: float) -> Mesh:
    """Return flat-shaded quads (n, 4, 3) with the brick texture laid ``repeat`` times per unit.

    Corners counter-clockwise seen from outside. The texture runs along the horizontal edge and
    down the vertical one, so courses line up from quad to quad.
    """
    corners = quads.reshape(-1, 3)
    base = 4 * np.arange(len(quads))[:, None]
    triangles = (base + np.array([0, 1, 2, 0, 2, 3])).reshape(-1, 3).astype(np.uint32)
    normals = vertex_normals(corners, triangles)
    flat = np.abs(normals[:, 1]) > 0.5
    facing_x = np.abs(normals[:, 0]) > 0.5
    s = np.where(facing_x, corners[:, 2], corners[:, 0])
    t = np.where(flat, corners[:, 2], 1.0 - corners[:, 1])
    coordinates = np.ascontiguousarray(np.stack([s, t], axis=1) * repeat, np.float32)
    return Mesh(np.ascontiguousarray(corners, np.float32), normals, triangles, (coordinates,))


def box_quads(x0: float, y0: float, z0: float, x1: float, y1: float, z1: float) -> np.ndarray:
    """Return a box's five faces but the bottom one, (5, 4, 3)."""
    a, b, c, d = (x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)
    e, f, g, h = (x0, y1, z0), (x1, y1, z0), (x1, y1, z1), (x0, y1, z1)
    faces = [(b, a, e, f), (c, b, f, g), (d, c, g, h), (a, d, h, e), (h, g, f, e)]
    return np.array(faces, np.float64)


def walls_mesh(repeat: float) -> Mesh:
    """Return the four walls, as thick as their battlements, with those."""
    walls = [
        (0.0, -FOOT, 0.0, 1.0, 1.0, WALL),
        (0.0, -FOOT, 1.0 - WALL, 1.0, 1.0, 1.0),
        (0.0, -FOOT, WALL, WALL, 1.0, 1.0 - WALL),
        (1.0 - WALL, -FOOT, WALL, 1.0, 1.0, 1.0 - WALL),
    ]
    return quads_mesh(np.concatenate([box_quads(*box) for box in walls + wall_boxes()]), repeat)


def without_gate(walls: Mesh, repeat: float) -> Mesh:
    """Return the walls with the outer face of the gate wall kept only below y = 0."""
    vertices, coordinates = walls.vertices.copy(), walls.coordinates[0].copy()
    top = np.flatnonzero((np.arange(len(vertices)) < 4) & (vertices[:, 1] > 0))
    vertices[top, 1], coordinates[top, 1] = 0.0, repeat
    return Mesh(vertices, walls.normals, walls.triangles, (coordinates,))


def tower_mesh(repeat: float) -> Mesh:
    """Return a tower about the y axis: a cylinder that widens to a parapet with a sunken floor."""
    r, top = TOWER_RADIUS, TOWER_TOP
    profile = [(r, -FOOT), (r, top - 0.16), (r + 0.025, top - 0.11), (r + 0.025, top)]
    profile += [(r - 0.01, top), (r - 0.01, top - 0.06), (0.0, top - 0.06)]
    height = sum(np.hypot(*np.subtract(b, a)) for a, b in zip(profile, profile[1:], strict=False))
    round_ = max(1, round(2 * np.pi * r * repeat))
    return revolve(profile, 24, (round_, float(height) * repeat))


def merged(meshes: list[Mesh]) -> Mesh:
    """Return meshes of one texture unit each as one mesh, colours included if all have them."""
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes[:-1])])
    parts = zip(meshes, starts, strict=True)
    colors = [mesh.colors for mesh in meshes if mesh.colors is not None]
    return Mesh(
        np.concatenate([mesh.vertices for mesh in meshes]),
        np.concatenate([mesh.normals for mesh in meshes]),
        np.concatenate([mesh.triangles + np.uint32(start) for mesh, start in parts]),
        (np.concatenate([mesh.coordinates[0] for mesh in meshes]),),
        np.concatenate(colors) if len(colors) == len(meshes) else None,
    )


def moved(mesh: Mesh, x: float, z: float) -> Mesh:
    """Return a mesh moved by x and z."""
    vertices = mesh.vertices + np.array([x, 0.0, z], np.float32)
    return Mesh(vertices, mesh.normals, mesh.triangles, mesh.coordinates, mesh.colors)


def quad_strips(count: int, first: int = 0) -> list[np.ndarray]:
    """Return the lower and upper rows (2, 2) of the vertices of ``count`` quads of quads_mesh."""
    base = first + 4 * np.arange(count)[:, None, None]
    return list(base + np.array([[0, 1], [3, 2]]))


def revolved_strips(segments: int, sides: int, first: int = 0) -> list[np.ndarray]:
    """Return the rows (2, sides + 1) of the vertices of each segment of a revolved profile."""
    upper = np.arange(sides + 1)
    one = np.stack([upper + sides + 1, upper])
    return [first + 2 * (sides + 1) * k + one for k in range(segments)]


def belt(low: float, high: float, out: float, gate: tuple[float, float]) -> np.ndarray:
    """Return a band round the four walls, quads (n, 4, 3): its face, and a slope up to the wall.

    It leaves the gate wall free between the two x of ``gate``.
    """
    ring = [(0.0, 0.0), (gate[0], 0.0), (gate[1], 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    wide = [(x + out * np.sign(x - 0.5), z + out * np.sign(z - 0.5)) for x, z in ring]
    wide[1:3] = [(x, -out) for x, _ in ring[1:3]]
    quads = []
    for k in (0, 2, 3, 4, 5):
        # Against the ring's own turn, so that the faces look outwards.
        after = (k + 1) % len(ring)
        (ax, az), (bx, bz), (cx, cz), (dx, dz) = wide[after], wide[k], ring[k], ring[after]
        quads.append([(ax, low, az), (bx, low, bz), (bx, high, bz), (ax, high, az)])
        slope = high + out
        quads.append([(ax, high, az), (bx, high, bz), (cx, slope, cz), (dx, slope, dz)])
        quads.append([(dx, low, dz), (cx, low, cz), (bx, low, bz), (ax, low, az)])
    return np.array(quads)


def ring_of_merlons(radius: float, base: float, count: int) -> np.ndarray:
    """Return battlements round a tower about the y axis, quads (n, 4, 3)."""
    quads = []
    inner, top, half = radius - 0.035, base + 0.8 * MERLON, 0.29 * 2 * np.pi / count
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

    ``crowned`` with battlements, or bare for a roof.
    """
    r, top, sides = TOWER_RADIUS, TOWER_TOP, 24
    low, high, out = PLINTH
    profile = [(r + out, low), (r + out, high), (r, high + out), (r, BAND[0])]
    profile += [(r + BAND[2], BAND[0]), (r + BAND[2], BAND[1]), (r, BAND[1] + BAND[2])]
    profile += [(r, top - 0.16), (r + 0.03, top - 0.10), (r + 0.03, top)]
    profile += [(r - 0.01, top), (r - 0.01, top - 0.06), (0.0, top - 0.06)]
    shaft = revolve(profile, sides, (max(1, round(2 * np.pi * r * repeat)), 1))
    # Texture coordinates by height, so that the courses of towers and walls are level.
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
    """Return all of the ornate castle that is of bricks, and its strips for the light map.

    The first quad is the gate wall's outer face above y = 0.
    """
    walls = walls_mesh(repeat).vertices.reshape(-1, 4, 3)
    under, over = walls[:1].copy(), walls[:1].copy()
    under[0, 2:, 1], over[0, :2, 1] = 0.0, 0.0
    rings = [belt(*BAND, (0.5, 0.5)), belt(*PLINTH, GATE)]
    x0, z0, x1, z1, top = KEEP
    out = 0.02
    keep = [box_quads(x0, -FOOT, z0, x1, top, z1)]
    keep.append(box_quads(x0 - out, top - 0.10, z0 - out, x1 + out, top, z1 + out))
    quads = np.concatenate([over, under, walls[1:], *rings, *keep])
    meshes, strips = [quads_mesh(quads, repeat)], quad_strips(len(quads))
    for x, z in CORNERS:
        tower, rows = ornate_tower(repeat, (x, z) not in ROOFED)
        first = sum(len(mesh.vertices) for mesh in meshes)
        strips += [row + first for row in rows]
        meshes.append(moved(tower, x, z))
    return merged(meshes), strips


def loopholes() -> np.ndarray:
    """Return the dark openings of loopholes and windows, quads (n, 4, 3) just before the stones."""
    quads = []

    def open_at(x: float, y: float, z: float, facing: float, half: float, tall: float) -> None:
        """One opening about (x, z), from y on, facing an angle from x towards z."""
        ax, az = -half * np.sin(facing), half * np.cos(facing)
        p, q = (x + ax, z + az), (x - ax, z - az)
        corners = [(p[0], y, p[1]), (q[0], y, q[1])]
        corners += [(q[0], y + tall, q[1]), (p[0], y + tall, p[1])]
        quads.append(corners)

    east, south, west, north = 0.0, 0.5 * np.pi, np.pi, 1.5 * np.pi
    for x in (0.0, 1.0):
        for z in (0.0, 1.0):
            for turn, y in ((-0.62, 0.36), (0.62, 0.62), (0.0, 0.98)):
                v = np.arctan2(z - 0.5, x - 0.5) + turn
                reach = TOWER_RADIUS + 0.002
                open_at(x + reach * np.cos(v), y, z + reach * np.sin(v), v, 0.009, 0.10)
    off = 0.002
    for u in (0.30, 0.50, 0.70):
        open_at(u, 0.52, 1.0 + off, south, 0.009, 0.10)
        open_at(-off, 0.52, u, west, 0.009, 0.10)
        open_at(1.0 + off, 0.52, u, east, 0.009, 0.10)
    for u in (0.36, 0.64):
        open_at(u, 0.60, -off, north, 0.009, 0.10)
    x0, z0, x1, z1, _ = KEEP
    for share in (0.3, 0.7):
        x, z = x0 + share * (x1 - x0), z0 + share * (z1 - z0)
        for y in (1.10, 1.28):
            open_at(x, y, z0 - off, north, 0.016, 0.06)
            open_at(x, y, z1 + off, south, 0.016, 0.06)
            open_at(x0 - off, y, z, west, 0.016, 0.06)
            open_at(x1 + off, y, z, east, 0.016, 0.06)
    return np.array(quads)


def roofs(repeat: float) -> Mesh:
    """Return the slated roofs, two cones and the keep's pyramid, with the undersides of eaves."""
    radius, tip = CONE
    eaves_y = TOWER_TOP - 0.02
    cone = revolve([(TOWER_RADIUS, eaves_y + 0.01), (radius, eaves_y), (0.0, tip)], 20, (6, 2))
    cones = [moved(cone, x, z) for x, z in ROOFED]
    x0, z0, x1, z1, top = KEEP
    out = 0.05
    eaves = np.array(
        [(x0 - out, z0 - out), (x1 + out, z0 - out), (x1 + out, z1 + out), (x0 - out, z1 + out)]
    )
    peak = (0.5 * (x0 + x1), top + KEEP_ROOF, 0.5 * (z0 + z1))
    corners, uv = [], []
    for k in range(4):
        (ax, az), (bx, bz) = eaves[(k + 1) % 4], eaves[k]
        corners += [(ax, top, az), (bx, top, bz), peak]
        uv += [(0.0, 2.0), (2.0, 2.0), (1.0, 0.0)]
    below = [(x, top, z) for x, z in eaves]
    corners += [below[k] for k in (0, 1, 2, 0, 2, 3)]
    uv += [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    vertices = np.array(corners, np.float32)
    triangles = np.arange(len(corners), dtype=np.uint32).reshape(-1, 3)
    pyramid = Mesh(
        vertices, vertex_normals(vertices, triangles), triangles, (np.array(uv, np.float32),)
    )
    return merged([*cones, pyramid])


def pennant(kt: np.ndarray | float, length: np.ndarray | float) -> np.ndarray:
    """Return a pennant from its mast at x = 0 along x, a strip (12, 3) of pairs, waving with kt.

    With arrays (m,) of kt and lengths it returns as many pennants, (m, 12, 3).
    """
    kt, length = np.asarray(kt)[..., None], np.asarray(length)[..., None]
    s = np.linspace(0.0, 1.0, 6)
    out = np.empty((*length.shape[:-1], 6, 2, 3), np.float32)
    out[..., 0] = (length * s)[..., None]
    half, sag = 0.16 * length * (1.0 - s), 0.06 * length * s * s
    out[..., 0, 1], out[..., 1, 1] = half - sag, -half - sag
    out[..., 2] = (0.09 * length * s * np.sin(9.0 * s - 0.35 * kt))[..., None]
    return out.reshape(*length.shape[:-1], 12, 3)


def rings(step: float, ornate: bool) -> list[tuple[np.ndarray, float, float]]:
    """Return what casts the castle's shadow: lines of places x, z (n, 2), from height to height.

    The places lie ``step`` units apart.
    """
    angles = np.arange(0.0, 2 * np.pi, step / TOWER_RADIUS)
    round_ = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    made = [(on_edges(CORNERS, step), 0.0, 1.0 + MERLON)]
    made += [(TOWER_RADIUS * round_ + corner, 0.0, TOWER_TOP) for corner in CORNERS]
    if ornate:
        x0, z0, x1, z1, top = KEEP
        middle = np.array([x0 + x1, z0 + z1]) / 2
        square = np.array([(x0, z0), (x1, z0), (x1, z1), (x0, z1)]) - middle
        made.append((on_edges(square + middle, step), 0.0, top))
        rise = CONE[1] - TOWER_TOP
        for left in np.arange(step, 1.0, 2 * step):
            peak = top + KEEP_ROOF * (1 - left)
            made.append((on_edges(square * left + middle, step), peak, peak + 1.5 * step))
            for corner in ROOFED:
                tip = TOWER_TOP + rise * (1 - left)
                made.append((CONE[0] * left * round_ + corner, tip, tip + 2 * step))
    return made
