"""The castle's walls and towers as meshes: boxes, and surfaces of revolution. No OpenGL.

The castle's own frame: the unit square x, z in 0..1, the gate wall at z = 0, y up from the ground.
"""

from collections.abc import Iterable

import numpy as np

from landscape.geometry.mesh import Mesh, faceted, revolve, vertex_normals

FOOT = 0.35  # chosen: units the walls reach into the ground, so that no slope shows under them
TOWER_RADIUS = 0.13  # chosen
TOWER_TOP = 1.22  # chosen
ROUND = 24  # chosen: sides of a tower that looks round
CORNERS = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
MERLON = 0.07  # chosen: height of the battlements
WALL = 0.045  # chosen: thickness of the walls


def box_quads(x0: float, y0: float, z0: float, x1: float, y1: float, z1: float) -> np.ndarray:
    """Return a box's five faces without the bottom one, quads (5, 4, 3)."""
    a = (x0, y0, z0)
    b = (x1, y0, z0)
    c = (x1, y0, z1)
    d = (x0, y0, z1)
    e = (x0, y1, z0)
    f = (x1, y1, z0)
    g = (x1, y1, z1)
    h = (x0, y1, z1)
    faces = [(b, a, e, f), (c, b, f, g), (d, c, g, h), (a, d, h, e), (h, g, f, e)]
    return np.array(faces, np.float64)


def quads_mesh(quads: np.ndarray, repeat: float) -> Mesh:
    """Return flat-shaded quads (n, 4, 3) with a texture repeated ``repeat`` times per unit.

    Corners are counter-clockwise seen from outside. The texture runs along the horizontal edge and
    down the vertical one, so that courses of bricks line up from quad to quad.
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


def wall_boxes() -> list[tuple[float, float, float, float, float, float]]:
    """Return the battlements as boxes (x0, y0, z0, x1, y1, z1) standing on the four walls."""
    boxes, width = [], 0.075
    for k in range(5):
        a = 0.17 + k * (0.66 - width) / 4
        b = a + width
        boxes += [
            (a, 1.0, 0.0, b, 1.0 + MERLON, WALL),
            (a, 1.0, 1.0 - WALL, b, 1.0 + MERLON, 1.0),
            (0.0, 1.0, a, WALL, 1.0 + MERLON, b),
            (1.0 - WALL, 1.0, a, 1.0, 1.0 + MERLON, b),
        ]
    return boxes


def walls_mesh(repeat: float, battlements: bool = True) -> Mesh:
    """Return the four walls, with battlements or bare; the first quad is the gate's outer face.

    Bricks repeat ``repeat`` times per unit.
    """
    walls = [
        (0.0, -FOOT, 0.0, 1.0, 1.0, WALL),
        (0.0, -FOOT, 1.0 - WALL, 1.0, 1.0, 1.0),
        (0.0, -FOOT, WALL, WALL, 1.0, 1.0 - WALL),
        (1.0 - WALL, -FOOT, WALL, 1.0, 1.0, 1.0 - WALL),
    ]
    boxes = walls + (wall_boxes() if battlements else [])
    return quads_mesh(np.concatenate([box_quads(*box) for box in boxes]), repeat)


def tower_mesh(repeat: float, sides: int = ROUND, battlements: bool = True) -> Mesh:
    """Return a tower around the y axis: a cylinder of ``sides`` sides with a flat top.

    With fewer sides than look round each side is flat. With ``battlements`` the tower widens to a
    parapet with a sunken floor.
    """
    r, top = TOWER_RADIUS, TOWER_TOP
    profile = [(r, -FOOT), (r, top), (0.0, top)]
    if battlements:
        profile = [(r, -FOOT), (r, top - 0.16), (r + 0.025, top - 0.11), (r + 0.025, top)]
        profile += [(r - 0.01, top), (r - 0.01, top - 0.06), (0.0, top - 0.06)]
    height = sum(np.hypot(*np.subtract(b, a)) for a, b in zip(profile, profile[1:], strict=False))
    round_ = max(1, round(2 * np.pi * r * repeat))
    tower = revolve(profile, sides, (round_, float(height) * repeat))
    return tower if sides >= ROUND else faceted(tower)


def on_edges(corners: Iterable[tuple[float, float]], spacing: float) -> np.ndarray:
    """Return points x, z (n, 2) along a closed line through ``corners``, every ``spacing``."""
    ring = np.array([*corners])
    out = []
    for a, b in zip(ring, np.roll(ring, -1, axis=0), strict=True):
        count = max(int(np.ceil(np.hypot(*(b - a)) / spacing)), 1)
        out.append(a + (b - a) * (np.arange(count) / count)[:, None])
    return np.concatenate(out)


def outlines(step: float) -> list[tuple[np.ndarray, float, float]]:
    """Return the outlines that cast the shadow: places x, z (n, 2), and heights from and to.

    The places of an outline are ``step`` units apart.
    """
    angles = np.arange(0.0, 2 * np.pi, step / TOWER_RADIUS)
    circle = TOWER_RADIUS * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    lines = [(on_edges(CORNERS, step), 0.0, 1.0 + MERLON)]
    return lines + [(circle + corner, 0.0, TOWER_TOP) for corner in CORNERS]
