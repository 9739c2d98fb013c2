"""Curved surfaces as grids of points, and the chart that each has in the light map. No OpenGL.

A surface is a grid that a light map can cover: row and column of a point are its place in a
rectangle of texels, its chart. All charts together fill one texture.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from landscape.geometry.mesh import Mesh, grid_triangles

FLATTENED = 0.25  # chosen: the most that a grid may lose of its own width
BORDER = 1  # texels around a chart, so that filtering never reads its neighbours


@dataclass(frozen=True)
class Surface:
    """A grid of points (rows, columns, 3), counter-clockwise seen from where it shows.

    Columns run to the right and rows downwards, seen from there. ``material`` names its texture;
    ``plain`` (rows, columns, 2) is where each point lies in it, in units, by default the distances
    along the grid. ``sheet`` names the light map it is in, ``density`` multiplies that map's texels
    per unit. One with an ``edge`` has no texels of its own: it is as bright as that edge.
    """

    points: np.ndarray
    material: str
    plain: np.ndarray | None = None
    density: float = 1.0
    sheet: str = "hall"
    edge: "Edge | None" = None

    @property
    def lengths(self) -> tuple[float, float]:
        """Its mean height and width in units, along the grid."""
        down = np.linalg.norm(np.diff(self.points, axis=0), axis=2).sum(axis=0).mean()
        across = np.linalg.norm(np.diff(self.points, axis=1), axis=2).sum(axis=1).mean()
        return float(down), float(across)

    @property
    def on_material(self) -> np.ndarray:
        """Where each point lies in its material, (rows, columns, 2) in units."""
        if self.plain is not None:
            return self.plain
        height, width = self.lengths
        both = (fractions(self.points, axis) for axis in (0, 1))
        v, u = np.meshgrid(*both, indexing="ij")
        return np.stack([u * width, v * height], axis=-1)

    def reversed(self) -> "Surface":
        """Return it with its columns in the other order, so that it shows on the other side."""
        plain = None if self.plain is None else self.plain[:, ::-1]
        return replace(self, points=self.points[:, ::-1], plain=plain)


@dataclass(frozen=True)
class Edge:
    """A row of a surface, by its number, as long as the rows of what is joined to it."""

    surface: Surface
    row: int


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
            x = 0
            y = y + row
            row = 0
        if x + width > side or y + height > side:
            raise ValueError(f"the charts do not fit into {side} x {side} texels")
        found[index] = Chart(x + BORDER, y + BORDER, width - 2 * BORDER, height - 2 * BORDER)
        x, row = x + width, max(row, height)

    return [found[index] for index in range(len(sizes))]


def at(grid: np.ndarray, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """Return values of a grid (r, c, n) between its own, bilinearly, at fractions 0..1."""
    r = np.clip(rows, 0, 1) * (grid.shape[0] - 1)
    c = np.clip(columns, 0, 1) * (grid.shape[1] - 1)
    top = np.minimum(r.astype(int), grid.shape[0] - 2)
    left = np.minimum(c.astype(int), grid.shape[1] - 2)
    v, u = (r - top)[..., None], (c - left)[..., None]
    upper = grid[top, left] * (1 - u) + grid[top, left + 1] * u
    lower = grid[top + 1, left] * (1 - u) + grid[top + 1, left + 1] * u
    return np.asarray(upper * (1 - v) + lower * v)


def fractions(points: np.ndarray, axis: int) -> np.ndarray:
    """Return how far along a grid its rows (``axis`` 0) or columns (1) lie, from 0 to 1."""
    steps = np.linalg.norm(np.diff(points, axis=axis), axis=2).mean(axis=1 - axis)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    return np.asarray(along / along[-1])


def normals(points: np.ndarray) -> np.ndarray:
    """Return the unit normals (rows, columns, 3) of a grid; it may close upon itself."""
    down, across = np.gradient(points, axis=0), np.gradient(points, axis=1)
    if points.shape[1] > 3 and np.allclose(points[:, 0], points[:, -1]):
        across[:, 0] = across[:, -1] = points[:, 1] - points[:, -2]
    found = np.cross(down, across)
    length = np.linalg.norm(found, axis=2, keepdims=True)
    mean = found.sum(axis=(0, 1))
    # Where rows or columns meet in a point, the surface's mean normal stands in.
    return np.where(length > 1e-9, found / np.maximum(length, 1e-12), mean / np.linalg.norm(mean))


def cells(surface: Surface, chart: Chart) -> tuple[np.ndarray, np.ndarray]:
    """Return place and normal, (height, width, 3) each, at the centre of each texel of a chart.

    They are interpolated in the two triangles of each cell of the grid, as OpenGL does it.
    """
    points, facing = surface.points, normals(surface.points)
    found, corner = [], []
    for axis, count in ((0, chart.height), (1, chart.width)):
        at = fractions(points, axis)
        wanted = np.linspace(0.0, 1.0, count)
        first = np.clip(np.searchsorted(at, wanted, "right") - 1, 0, len(at) - 2)
        corner.append(first)
        found.append((wanted - at[first]) / np.maximum(at[first + 1] - at[first], 1e-12))
    b, a = found[0][:, None, None], found[1][None, :, None]
    r, c = corner[0][:, None], corner[1][None, :]

    def between(grid: np.ndarray) -> np.ndarray:
        here = grid[r, c]
        right = grid[r, c + 1]
        below = grid[r + 1, c]
        across = grid[r + 1, c + 1]
        lower = here + b * (below - here) + a * (across - below)
        upper = here + a * (right - here) + b * (across - right)
        return np.where(b >= a, lower, upper)

    place, normal = between(points), between(facing)
    return place, normal / np.maximum(np.linalg.norm(normal, axis=2, keepdims=True), 1e-9)


def needed(points: np.ndarray, axis: int, tolerance: float) -> list[int]:
    """Return which rows (``axis`` 0) or columns (1) of a grid keep its shape within ``tolerance``.

    All others lie as near as that to straight lines between those, in units; the first and the
    last are always kept. A closed grid, however small, never shrinks to a line.
    """
    lines, at = np.moveaxis(points, axis, 0), fractions(points, axis)
    tolerance = min(tolerance, FLATTENED * float(np.abs(lines - lines[0]).max()))
    kept = [0]
    while kept[-1] < len(lines) - 1:
        start = end = kept[-1]
        end += 1
        while end + 1 < len(lines):
            inner = slice(start + 1, end + 1)
            share = ((at[inner] - at[start]) / (at[end + 1] - at[start]))[:, None, None]
            straight = lines[start] + share * (lines[end + 1] - lines[start])
            if np.abs(straight - lines[inner]).max() > tolerance:
                break
            end += 1
        kept.append(end)

    return kept


def coarser(surface: Surface, light: np.ndarray, tolerance: float) -> tuple[Surface, np.ndarray]:
    """Return a surface and its place in the light map with fewer points; see :func:`needed`."""
    some = np.ix_(*(needed(surface.points, axis, tolerance) for axis in (0, 1)))
    plain = surface.on_material[some]
    return replace(surface, points=surface.points[some], plain=plain), light[some]


def in_chart(surface: Surface, chart: Chart) -> np.ndarray:
    """Return where each point of a surface lies in the light map, (rows, columns, 2) texels."""
    v, u = np.meshgrid(fractions(surface.points, 0), fractions(surface.points, 1), indexing="ij")
    # The first and last points are at the centres of the first and last texels.
    x = chart.x + 0.5 + u * (chart.width - 1)
    return np.stack([x, chart.y + 0.5 + v * (chart.height - 1)], axis=-1)


def mesh(surface: Surface, repeats: float, light: np.ndarray) -> Mesh:
    """Return a surface as triangles, with its material's coordinates and those of its light.

    The material's texture is repeated ``repeats`` times per unit (texture unit 0); ``light``
    (rows, columns, 2) is used as it is (unit 1).
    """
    rows, columns = surface.points.shape[:2]
    arrays = surface.points, normals(surface.points), surface.on_material * repeats, light
    vertices, facing, *coordinates = (
        np.ascontiguousarray(each.reshape(rows * columns, -1), np.float32) for each in arrays
    )
    return Mesh(vertices, facing, grid_triangles(columns, rows), tuple(coordinates))
