"""The ground's mesh cut into square tiles, each with its bounding box. No OpenGL here."""

from dataclasses import dataclass

import numpy as np

from landscape.geometry.height_field import mirrored_height
from landscape.geometry.mesh import Mesh, grid_triangles


@dataclass(frozen=True)
class Tile:
    """A square part of the ground's mesh, and the low and high corner (3,) of its bounding box.

    ``triangles`` (m, 3) are indices of the whole mesh's vertices, ``numbers`` (m,) those of the
    triangles in it.
    """

    triangles: np.ndarray
    low: np.ndarray
    high: np.ndarray
    numbers: np.ndarray

    def parts(self, labels: np.ndarray) -> dict[int, np.ndarray]:
        """Return the tile's triangles in parts, by the labels (n,) of the whole mesh's."""
        own = labels[self.numbers]
        return {label: self.triangles[own == label] for label in np.unique(own).tolist()}


def cut(mesh: Mesh, tiles: int) -> list[Tile]:
    """Cut a grid's mesh into ``tiles`` x ``tiles`` parts; each triangle goes to one of them."""
    side = round(len(mesh.vertices) ** 0.5) - 1
    cell = np.arange(side) * tiles // side
    number = np.repeat(np.add.outer(cell * tiles, cell).ravel(), 2)  # two triangles per cell
    parts = []
    for k in range(tiles * tiles):
        numbers = np.flatnonzero(number == k)
        if not len(numbers):
            continue
        triangles = mesh.triangles[numbers]
        vertices = mesh.vertices[triangles].reshape(-1, 3)
        parts.append(Tile(triangles, vertices.min(axis=0), vertices.max(axis=0), numbers))

    return parts


def boxes(tiles: list[Tile], level: float | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Return the centres and the half sides of the tiles' boxes, (n, 3) each.

    Mirrored in water at the height ``level``, if it is given.
    """
    low, high = (
        np.array([getattr(tile, end) for tile in tiles]).reshape(-1, 3) for end in ("low", "high")
    )
    middles = (low + high) / 2
    if level is not None:
        middles[:, 1] = mirrored_height(middles[:, 1], level)
    return middles, (high - low) / 2


def every_second(mesh: Mesh) -> Mesh:
    """Return a grid's mesh without every second row and column of vertices; borders are kept."""
    side = round(len(mesh.vertices) ** 0.5)
    lines = np.unique([*range(0, side, 2), side - 1])
    kept = np.arange(side * side).reshape(side, side)[np.ix_(lines, lines)].ravel()
    coordinates = tuple(np.ascontiguousarray(c[kept]) for c in mesh.coordinates)
    colours = None if mesh.colors is None else np.ascontiguousarray(mesh.colors[kept])
    triangles = grid_triangles(len(lines), len(lines))
    return Mesh(mesh.vertices[kept], mesh.normals[kept], triangles, coordinates, colours)
