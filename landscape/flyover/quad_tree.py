"""Bounding volumes in a quad-tree: which squares of the terrain are drawn, at which level.

The plane is divided into square tiles of the same number of quads. A tile of level l has every
2^l-th vertex, so four tiles of one level cover one of the next: a tree in which each node has four
children. From the root down, a tile whose box is off the screen is dropped with all that is below
it; a tile that is near the camera is replaced by its children; any other is drawn. It is a loop
over the levels; the tiles of a level are arrays.

Without ``flyover.quad_tree`` the box of each tile is tested alone, with the same result; without
``flyover.bounding_volumes`` the tiles all around the camera are drawn, and it is left to clipping
to drop their lines.
"""

import dataclasses
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from landscape.flyover.bounds import Bounds
from landscape.flyover.camera import Camera, Frustum, camera_transform
from landscape.flyover.clipping import NO_WALLS, planes
from landscape.flyover.height_field import HeightField
from landscape.flyover.levels import Levels
from landscape.flyover.settings import Flyover

ROUNDING = 1e-9  # of the reach, chosen: far above float64's, far below what can be seen


@dataclass(frozen=True)
class Tiles:
    """Tiles of the plane, (n,) int64: their level of detail, and their place among its tiles."""

    level: np.ndarray
    column: np.ndarray
    row: np.ndarray

    def __len__(self) -> int:
        return len(self.level)

    def __getitem__(self, which: slice | np.ndarray) -> "Tiles":
        """Return some of the tiles."""
        return Tiles(self.level[which], self.column[which], self.row[which])


def children(tiles: Tiles) -> Tiles:
    """Return the four children of each tile."""
    level = np.repeat(tiles.level - 1, 4)
    column = (2 * tiles.column[:, None] + (0, 1, 0, 1)).ravel()
    return Tiles(level, column, (2 * tiles.row[:, None] + (0, 0, 1, 1)).ravel())


@dataclass(frozen=True)
class View:
    """The input for the choice of tiles: the terrain and its boxes, the camera, the volume.

    ``beside`` are more planes that bound what is seen, see :func:`.clipping.codes`.
    """

    field: HeightField
    bounds: Bounds
    camera: Camera
    volume: Frustum
    size: tuple[int, int]
    settings: Flyover
    levels: Levels
    beside: np.ndarray = dataclasses.field(default_factory=lambda: NO_WALLS)

    @cached_property
    def walls(self) -> tuple[np.ndarray, np.ndarray]:
        """All planes in the terrain's directions: normals and their absolute values, (n, 6).

        Together they say how far a box reaches along them. The second result are distances, (n, 1).
        """
        along_x, along_y, along_z = np.eye(3)
        axes = np.stack(camera_transform(along_x, along_y, along_z, self.camera))
        walls = np.concatenate(
            [planes(self.volume, self.size), np.pad(self.beside, ((0, 0), (0, 1)))]
        )
        normals = walls[:, :3] @ axes
        return np.concatenate([normals, np.abs(normals)], axis=1), walls[:, 3:]

    def origin(self, tiles: Tiles) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return x and y of tiles' corners relative to the camera, and their sides' length."""
        side = self.levels.patch * self.field.unit * (1 << tiles.level).astype(np.float64)
        return tiles.column * side - self.camera.x, tiles.row * side - self.camera.y, side


def select(view: View) -> tuple[Tiles, int]:
    """Return the tiles to draw, coarse levels first, and how many boxes were tested."""
    ours = view.settings
    descending = ours.bounding_volumes and ours.quad_tree
    nodes, tested = roots(view), 0
    chosen = []
    for level in range(int(nodes.level[0]) if len(nodes) else 0, -1, -1):
        if not ours.mirror:
            nodes = nodes[on_the_map(nodes, view)]
        if descending:
            tested += len(nodes)
            nodes = nodes[in_view(nodes, view)]
        near = view.levels.splits(level, *view.origin(nodes))
        chosen.append(nodes[~near])
        nodes = children(nodes[near])

    columns = zip(*((each.level, each.column, each.row) for each in chosen), strict=True)
    found = Tiles(*(np.concatenate(each) for each in columns))
    if ours.bounding_volumes and not descending:
        tested += len(found)
        found = found[in_view(found, view)]
    return found, tested


def roots(view: View) -> Tiles:
    """Return the tiles of the coarsest level around the camera, as far as one can see."""
    level = view.levels.coarsest
    side = view.levels.patch * view.field.unit * float(1 << level)
    spans = [
        np.arange((at - view.levels.reach) // side, (at + view.levels.reach) // side + 1)
        for at in (view.camera.x, view.camera.y)
    ]
    column, row = (each.ravel().astype(np.int64) for each in np.meshgrid(*spans))
    return Tiles(np.full(len(column), level), column, row)


def on_the_map(tiles: Tiles, view: View) -> np.ndarray:
    """Return whether tiles begin on the image, bool (n,).

    Those that begin on its last row or column have no area, but the image's border as an edge.
    """
    side = view.levels.patch << tiles.level
    column, row = tiles.column * side, tiles.row * side
    return (np.minimum(column, row) >= 0) & (np.maximum(column, row) <= view.field.side)


def in_view(tiles: Tiles, view: View) -> np.ndarray:
    """Return whether a part of the tiles' boxes may be on the screen, bool (n,).

    A box is off the screen if it is outside one of the view volume's planes, which it is if that
    one of its corners is which lies farthest along the plane's normal.
    """
    x, y, side = view.origin(tiles)
    low, high = view.bounds.at(tiles.level, tiles.row, tiles.column).T
    boxes = np.empty((6, len(tiles)))  # boxes' middles, then half of their sides
    boxes[3:5] = side / 2
    np.add(x, boxes[3], out=boxes[0])
    np.add(y, boxes[3], out=boxes[1])
    np.subtract((low + high) / 2.0, view.camera.z, out=boxes[2])
    np.divide(high - low, 2.0, out=boxes[5])
    normals, distances = view.walls
    farthest = normals @ boxes + distances
    return np.asarray((farthest >= -ROUNDING * (1 + view.levels.reach)).all(axis=0))
