"""Curved surfaces as grids of points, and the chart that each has in the light map. No OpenGL.

A surface is a grid that a light map can cover: row and column of a point are its place in a
rectangle of texels, its chart. All charts together fill one texture.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from landscape.geometry.mesh import Mesh, grid_triangles, vertex_normals

BORDER = 1  # texels around a chart, so that filtering never reads its neighbours


@dataclass(frozen=True)
class Surface:
    """A grid of points (rows, columns, 3), counter-clockwise seen from where it shows.

    Columns run to the right and rows downwards, seen from there. ``material`` names its texture,
    ``repeats`` says how often that is repeated per unit. ``density`` multiplies the light map's
    texels per unit.
    """

    points: np.ndarray
    material: str
    repeats: float = 4.0
    density: float = 1.0

    @property
    def lengths(self) -> tuple[float, float]:
        """Its mean height and width in units, along the grid."""
        down = np.linalg.norm(np.diff(self.points, axis=0), axis=2).sum(axis=0).mean()
        across = np.linalg.norm(np.diff(self.points, axis=1), axis=2).sum(axis=1).mean()
        return float(down), float(across)


@dataclass(frozen=True)
class Chart:
    """Where a surface's light lies in the light map, in texels, without its border."""

    x: int
    y: int
    width: int
    height: int


def charts(surfaces: Sequence[Surface], side: int, texels: float) -> list[Chart]:
    """Return a chart for each surface in a square of ``side`` texels, ``texels`` per unit.

    The highest charts come first, in rows, as books stand on a shelf. ValueError if they do not
    fit.
    """
    sizes = []
    for surface in surfaces:
        sizes.append(
            [max(round(length * texels * surface.density), 2) for length in surface.lengths]
        )
    found: dict[int, Chart] = {}
    x = y = row = 0
    for index in sorted(range(len(sizes)), key=lambda k: (-sizes[k][0], -sizes[k][1], k)):
        height, width = (length + 2 * BORDER for length in sizes[index])
        if x + width > side:
            x, y, row = 0, y + row, 0
        if x + width > side or y + height > side:
            raise ValueError(f"the charts do not fit into {side} x {side} texels")
        found[index] = Chart(x + BORDER, y + BORDER, width - 2 * BORDER, height - 2 * BORDER)
        x, row = x + width, max(row, height)
    return [found[index] for index in range(len(sizes))]


def at(points: np.ndarray, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """Return points of a grid (r, c, 3) between its own, bilinearly, at fractions 0..1."""
    r = np.clip(rows, 0, 1) * (points.shape[0] - 1)
    c = np.clip(columns, 0, 1) * (points.shape[1] - 1)
    top = np.minimum(r.astype(int), points.shape[0] - 2)
    left = np.minimum(c.astype(int), points.shape[1] - 2)
    v, u = (r - top)[..., None], (c - left)[..., None]
    upper = points[top, left] * (1 - u) + points[top, left + 1] * u
    lower = points[top + 1, left] * (1 - u) + points[top + 1, left + 1] * u
    return np.asarray(upper * (1 - v) + lower * v)


def mesh(surface: Surface, chart: Chart, side: int) -> Mesh:
    """Return a surface as triangles: material coordinates in unit 0, the light map's in unit 1."""
    rows, columns = surface.points.shape[:2]
    vertices = np.ascontiguousarray(surface.points.reshape(-1, 3), np.float32)
    triangles = grid_triangles(columns, rows)
    v, u = np.meshgrid(np.linspace(0, 1, rows), np.linspace(0, 1, columns), indexing="ij")
    height, width = surface.lengths
    plain = np.stack([u * width, v * height], axis=-1) * surface.repeats
    # The first and last points are at the centres of the first and last texels.
    light = np.stack(
        [
            (chart.x + 0.5 + u * (chart.width - 1)) / side,
            (chart.y + 0.5 + v * (chart.height - 1)) / side,
        ],
        axis=-1,
    )
    coordinates = tuple(
        np.ascontiguousarray(each.reshape(-1, 2), np.float32) for each in (plain, light)
    )
    return Mesh(vertices, vertex_normals(vertices, triangles), triangles, coordinates)
