"""Single stones on the weathered castle: frames of windows, corbels, quoins, copings, steps.

They are boxes with the light at each corner as their colour (weathering.py), and a patch of the
wall's texture each. No OpenGL here. Places are in the castle's own frame. All sizes are chosen.
"""

import math

import numpy as np

from landscape.elements.best.castle.loopholes import openings
from landscape.elements.best.castle.ornate_masonry import GATE, KEEP, ROOFED
from landscape.geometry.masonry import (
    CORNERS,
    MERLON,
    TOWER_RADIUS,
    TOWER_TOP,
    WALL,
    quads_mesh,
    wall_boxes,
)
from landscape.geometry.mesh import Mesh

SHARE = 0.45  # of the wall's texture coordinates: a block shows one or two of its stones
FRAME = 0.010  # units that a window's frame stands out from the wall
# Faces of a box by the corners' numbers, whose bits are across, up, out.
FRONT = (4, 5, 7, 6)
LEFT = (0, 4, 6, 2)
RIGHT = (5, 1, 3, 7)
TOP, BELOW = (6, 7, 3, 2), (0, 1, 5, 4)
ALL = (FRONT, LEFT, RIGHT, TOP, BELOW)

Span = tuple[float, float]


class Blocks:
    """Boxes that are collected, each placed on a wall by a foot and a direction."""

    def __init__(self, seed: int) -> None:
        self.rng = np.random.default_rng([2006, seed])
        self.quads: list[np.ndarray] = []
        self.tints: list[np.ndarray] = []

    def add(
        self,
        foot: tuple[float, float, float],
        facing: float,
        across: Span,
        up: Span,
        out: Span,
        faces: tuple[tuple[int, ...], ...] = ALL,
        uneven: float = 0.0012,
        slope: float = 0.0,
    ) -> None:
        """Add a box: spans to the right, upwards and outwards from ``foot``, in units.

        ``facing`` is the angle of the outward direction from x towards z. Corners are moved by up
        to ``uneven``; the top falls outwards by ``slope``.
        """
        c, s = math.cos(facing), math.sin(facing)
        box = np.array([(across[k & 1], up[k >> 1 & 1], out[k >> 2]) for k in range(8)], float)
        box[6:, 1] -= slope
        box += self.rng.uniform(-uneven, uneven, box.shape)
        corners = np.array(foot) + np.stack(
            [box[:, 0] * s + box[:, 2] * c, box[:, 1], -box[:, 0] * c + box[:, 2] * s], axis=1
        )
        self.quads += [corners[list(face)] for face in faces]
        tint = self.rng.normal(1.0, 0.09) * (1.0 + self.rng.normal(0.0, 0.03, 3))
        self.tints += [tint] * len(faces)

    def mesh(self, repeat: float) -> tuple[Mesh, np.ndarray]:
        """Return the boxes, and the tint (n, 3) of each vertex."""
        mesh = quads_mesh(np.array(self.quads), repeat)
        tints = np.repeat(self.tints, 4, axis=0)
        shift = np.repeat(self.rng.random((len(self.quads), 2)), 4, axis=0)
        coordinates = np.float32(SHARE) * mesh.coordinates[0] + shift.astype(np.float32)
        return Mesh(mesh.vertices, mesh.normals, mesh.triangles, (coordinates,)), tints


def add_frames(blocks: Blocks) -> None:
    """Add jambs, lintels and sills around all openings."""
    for x, y, z, facing, half, tall in openings():
        foot = (x - 0.002 * math.cos(facing), y, z - 0.002 * math.sin(facing))
        wide = half > 0.012
        rim, deep = (0.012, FRAME) if wide else (0.014, FRAME)
        levels = np.linspace(0.0, tall, 3)
        for low, high in zip(levels, levels[1:], strict=False):
            for side in (-1, 1):
                reach = half + rim + blocks.rng.uniform(-0.004, 0.007)
                span = (half, reach) if side > 0 else (-reach, -half)
                out = deep * blocks.rng.uniform(0.75, 1.15)
                blocks.add(foot, facing, span, (low, high), (-0.01, out), (FRONT, LEFT, RIGHT))

        over = half + rim + 0.005
        blocks.add(foot, facing, (-over, over), (tall, tall + 0.020), (-0.01, deep + 0.003))
        blocks.add(foot, facing, (-over, over), (-0.015, 0.0), (-0.01, deep + 0.006), slope=0.004)
        if wide:  # a cross of stone
            bar = (-0.0022, 0.0022), (0.0, tall), (-0.01, 0.004)
            blocks.add(foot, facing, *bar, (FRONT, LEFT, RIGHT), 0.0)
            bar = (-half, half), (0.6 * tall, 0.6 * tall + 0.004), (-0.01, 0.0035)
            blocks.add(foot, facing, *bar, (FRONT, TOP, BELOW), 0.0)


def add_corbels(blocks: Blocks) -> None:
    """Add the stones that carry the parapets of the towers and of the keep."""
    for x, z in CORNERS:
        for angle in 2 * np.pi * (np.arange(16) + 0.5) / 16:
            foot = (x + TOWER_RADIUS * math.cos(angle), TOWER_TOP - 0.165, z)
            foot = (foot[0], foot[1], z + TOWER_RADIUS * math.sin(angle))
            blocks.add(foot, angle, (-0.011, 0.011), (0.012, 0.062), (-0.02, 0.032))
    x0, z0, x1, z1, top = KEEP
    middle, half = ((x0 + x1) / 2, (z0 + z1) / 2), (x1 - x0) / 2
    for turn in range(4):
        facing = turn * math.pi / 2
        foot = (
            middle[0] + half * math.cos(facing),
            top - 0.125,
            middle[1] + half * math.sin(facing),
        )
        for off in np.linspace(-half + 0.015, half - 0.015, 8):
            span = (float(off) - 0.008, float(off) + 0.008)
            blocks.add(foot, facing, span, (0.0, 0.030), (-0.01, 0.018))


def add_quoins(blocks: Blocks) -> None:
    """Add long and short stones by turns at the keep's corners, above the walls."""
    x0, z0, x1, z1, top = KEEP
    rows = 14
    rise = (top - 0.13 - 1.0) / rows
    for turn, (x, z) in enumerate(((x1, z1), (x0, z1), (x0, z0), (x1, z0))):
        facing = turn * math.pi / 2
        for row in range(rows):
            low = 1.0 + row * rise
            long, short = (0.050, 0.026) if row % 2 else (0.026, 0.050)
            out = 0.004 * blocks.rng.uniform(0.7, 1.4)
            up = (low + 0.0008, low + rise - 0.0008)
            # The corner is at the left end of one face, and at the right of the next.
            blocks.add((x, 0.0, z), facing, (-out, long), up, (-0.004, out))
            blocks.add((x, 0.0, z), facing + math.pi / 2, (-short, out), up, (-0.004, out * 0.98))


def add_copings(blocks: Blocks) -> None:
    """Add a cover stone to each merlon of the walls and of the towers with battlements."""
    for x0, _, z0, x1, y1, z1 in wall_boxes():
        foot = ((x0 + x1) / 2, y1, (z0 + z1) / 2)
        half, deep = (x1 - x0) / 2 + 0.006, (z1 - z0) / 2 + 0.006
        high = blocks.rng.uniform(0.009, 0.014)
        blocks.add(foot, math.pi / 2, (-half, half), (0.0, high), (-deep, deep))
        back = (-half, half), (0.0, high), (-deep, deep)
        blocks.add(foot, -math.pi / 2, *back, (FRONT,))

    radius = TOWER_RADIUS + 0.03
    for x, z in CORNERS:
        if (x, z) in ROOFED:
            continue
        for angle in 2 * np.pi * np.arange(9) / 9:
            foot = (
                x + radius * math.cos(angle),
                TOWER_TOP + 0.8 * MERLON,
                z + radius * math.sin(angle),
            )
            half = 0.29 * 2 * math.pi / 9 * radius + 0.005
            blocks.add(foot, float(angle), (-half, half), (0.0, 0.011), (-0.040, 0.006))
            back = (-half, half), (0.0, 0.011), (-0.006, 0.040)
            blocks.add(foot, float(angle) + math.pi, *back, (FRONT,))


def add_steps(blocks: Blocks, ground: float) -> None:
    """Add the threshold and two steps before the gate, for a ground at this height there."""
    middle, wide = (GATE[0] + GATE[1]) / 2, (GATE[1] - GATE[0]) / 2
    for depth, share, rise in ((0.055, 0.86, 0.013), (0.095, 0.98, 0.007), (0.135, 1.12, 0.002)):
        at = -share * wide
        while at < share * wide - 0.01:
            end = min(at + blocks.rng.uniform(0.045, 0.085), share * wide)
            if share * wide - end < 0.02:
                end = share * wide
            top = ground + rise + blocks.rng.uniform(-0.0012, 0.0012)
            out = depth + blocks.rng.uniform(-0.006, 0.006)
            foot = (middle, 0.0, 0.0)
            span = (at + 0.0012, end - 0.0012)
            blocks.add(foot, -math.pi / 2, span, (-0.05, top), (-WALL, out), uneven=0.0018)
            at = end
