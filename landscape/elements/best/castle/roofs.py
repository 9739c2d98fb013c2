"""The ornate castle's roofs and masts, and the shadow it casts. No OpenGL here."""

import numpy as np

from landscape.elements.best.castle.ornate_masonry import KEEP, ROOFED
from landscape.geometry.masonry import TOWER_RADIUS, TOWER_TOP, on_edges, outlines
from landscape.geometry.mesh import Mesh, merged, moved, revolve, vertex_normals

# All chosen.
CONE = (TOWER_RADIUS + 0.05, TOWER_TOP + 0.36)  # radius of the eaves, height of the tip
KEEP_ROOF = 0.34  # height of its pyramid
MASTS = ((0.46, 0.72, 1.52 + KEEP_ROOF, 0.20), (0.0, 1.0, TOWER_TOP + 0.35, 0.14))
"""x, z, height of the foot, length of the pennant."""


def roofs(repeat: float) -> Mesh:
    """Return the slate roofs, two cones and the keep's pyramid, with the undersides of eaves."""
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


def ornate_outlines(step: float) -> list[tuple[np.ndarray, float, float]]:
    """Return what casts the ornate castle's shadow, as :func:`outlines` does for the plain one.

    A roof is a stack of outlines that shrink towards its tip.
    """
    angles = np.arange(0.0, 2 * np.pi, step / TOWER_RADIUS)
    circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    x0, z0, x1, z1, top = KEEP
    middle = np.array([x0 + x1, z0 + z1]) / 2
    square = np.array([(x0, z0), (x1, z0), (x1, z1), (x0, z1)]) - middle
    lines = [*outlines(step), (on_edges(square + middle, step), 0.0, top)]
    rise = CONE[1] - TOWER_TOP
    for left in np.arange(step, 1.0, 2 * step):
        peak = top + KEEP_ROOF * (1 - left)
        lines.append((on_edges(square * left + middle, step), peak, peak + 1.5 * step))
        for corner in ROOFED:
            tip = TOWER_TOP + rise * (1 - left)
            lines.append((CONE[0] * left * circle + corner, tip, tip + 2 * step))
    return lines
