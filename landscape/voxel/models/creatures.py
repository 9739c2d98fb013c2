"""The giant rabbit and the sea dragon in blocks, made from the meshes that stand on the island.

Points all over the mesh's triangles are counted in the cells they lie in. A cell is a block where
the surface in it is large enough, or where there is surface on all six sides of it; so thin ears
and horns stay, and a surface that only grazes a cell does not make the creature fat. Each point
votes for the block whose colour is nearest to the mesh's there, small features with more weight.
Both look to the east, +x.
"""

from pathlib import Path

import numpy as np

from framelens.base.errors import InputError
from landscape.files.meshes import read_colours, read_mesh
from landscape.geometry.mesh import centred
from landscape.voxel.blocks import block

ENOUGH = 0.38  # square blocks of surface that make a cell a block, chosen
FINEST = 0.5  # blocks, chosen: the greatest distance between points on a triangle
MOST_POINTS = 12  # along an edge of a triangle, chosen

# Block, the colour in the mesh that it stands for (0..1), the weight of its votes. Chosen.
Palette = tuple[tuple[str, tuple[float, float, float], float], ...]
RABBIT: Palette = (
    ("fur", (0.62, 0.48, 0.35), 1.0),
    ("fur", (0.74, 0.62, 0.48), 1.0),
    ("light fur", (0.83, 0.74, 0.62), 1.0),
    ("light fur", (0.95, 0.88, 0.79), 1.1),
    ("pink", (0.85, 0.64, 0.57), 2.5),
)
DRAGON: Palette = (
    ("scales", (0.14, 0.42, 0.40), 1.0),
    ("light scales", (0.92, 0.83, 0.60), 1.6),
    ("horn", (0.93, 0.60, 0.28), 1.5),
    ("horn", (0.79, 0.72, 0.60), 1.5),
    ("horn", (1.0, 0.96, 0.86), 1.5),
    ("pink", (0.72, 0.36, 0.24), 1.5),
    ("pink", (0.55, 0.16, 0.16), 3.0),
    ("dark", (1.0, 0.72, 0.12), 6.0),
)
# Chosen, in the rabbit's mesh: where its head is and how far it is turned, and where ears begin.
HEAD_X = 0.62
NECK_Y = (-0.15, 0.05)
HEAD_YAW_RAD = 0.22
EARS_Y, SPREAD = (0.30, 0.55), 0.13
THINNEST = 20.0  # times its size along its measured axis: how long a mesh may be, chosen
BLACK = 0.16  # colours darker than this are the eyes, chosen
# Of the dragon's height, chosen: where the water is. It is lower than the island's: with that, the
# arches of a body of blocks would be closed, and discs with their mirror images.
SEA = 0.2


def _give_eyes(model: np.ndarray, places: np.ndarray) -> None:
    """Make the outermost blocks at the height of the eyes' vertices (n, 3) dark, in place.

    Half a block wide, an eye would have no block of its own, or two.
    """
    if len(places):
        x, _, y = (places.min(axis=0) + places.max(axis=0)).astype(int) // 2
        across = np.flatnonzero(model[x, :, y])
        model[x, [*across[:1], *across[-1:]], y] = block("dark")


def rabbit(path: Path, height: int = 14) -> np.ndarray:
    """Return the rabbit, ``height`` blocks high, uint8 [x, z, y]; it sits on its lowest level.

    ``path`` is its mesh; InputError if that cannot be read.
    """
    vertices, triangles = read_mesh(path)
    colours = read_colours(path)
    places, shape = _grid(path, _straight(centred(vertices)), height, 1, odd=True)
    model = _voxels(places, shape, triangles, colours, RABBIT)
    model = np.maximum(model, model[:, ::-1])  # where the sides differ, the lighter block

    if colours is not None:
        _give_eyes(model, places[colours.max(axis=1) < 255 * BLACK])

    # Only its ears and its nose are pink; elsewhere that is the border between brown and white.
    low = model[..., : round(0.7 * model.shape[2])]
    low[low == block("pink")] = block("light fur")

    # The nose is the foremost block of the face.
    middle = model[:, model.shape[1] // 2, model.shape[2] // 2 :]
    for x, y in sorted(np.argwhere(middle).tolist())[-1:]:
        middle[x, y] = block("pink")
    return model


def _straight(vertices: np.ndarray) -> np.ndarray:
    """Return the rabbit's vertices with its head to the front and its ears apart.

    In blocks, ears that nearly touch would be one, and a head a little askew looks broken.
    """
    x, y, z = vertices.T.astype(float)
    turned = np.clip((y - NECK_Y[0]) / (NECK_Y[1] - NECK_Y[0]), 0, 1) * (x > 0)
    cos, sin = np.cos(HEAD_YAW_RAD * turned), np.sin(HEAD_YAW_RAD * turned)
    ahead, across = x - HEAD_X, z
    x = HEAD_X + cos * ahead - sin * across
    z = sin * ahead + cos * across
    apart = np.clip((y - EARS_Y[0]) / (EARS_Y[1] - EARS_Y[0]), 0, 1)
    return np.stack([x, y, z + SPREAD * apart * np.sign(z)], axis=1)


def dragon(path: Path, length: int = 60) -> np.ndarray:
    """Return the sea dragon, ``length`` blocks long, uint8 [x, z, y].

    The sea is at ``SEA`` of its height: put it with that level as its floor.
    """
    vertices, triangles = read_mesh(path)
    places, shape = _grid(path, centred(vertices), length, 0)
    model = _voxels(places, shape, triangles, read_colours(path), DRAGON)
    # One colour would look like plastic; a few blocks differ, and it is darker along its back.
    chance = np.random.default_rng(0).random(shape) + 0.2 * np.linspace(-0.5, 0.5, shape[2])
    for name, some in (("bright scales", chance < 0.16), ("deep scales", chance > 0.70)):
        model[some & (model == block("scales"))] = block(name)
    return model


def _grid(
    path: Path, vertices: np.ndarray, size: int, axis: int, odd: bool = False
) -> tuple[np.ndarray, tuple[int, int, int]]:
    """Return vertices x, y, z as places x, z, y in blocks, in the middle of a grid of this shape.

    The mesh becomes ``size`` blocks long along an axis; if ``odd``, the number of blocks across is
    odd, so that there is one in the middle. InputError names a mesh too thin along the axis.
    """
    extent = np.ptp(vertices, axis=0)
    if extent[axis] * THINNEST < extent.max():
        raise InputError(
            "{path}: expected a mesh that is not flat, to make blocks of it", path=path
        )
    places = ((vertices - vertices.min(axis=0)) * (size / extent[axis]))[:, [0, 2, 1]]
    long, wide, tall = (max(int(np.ceil(v - 1e-4)), 1) for v in places.max(axis=0))
    wide += odd and wide % 2 == 0
    return places + ((long, wide, tall) - places.max(axis=0)) / 2, (long, wide, tall)


def _nearest(triangles: np.ndarray, colours: np.ndarray | None, palette: Palette) -> np.ndarray:
    """Return which of a palette's colours is nearest to that of each triangle, (n,)."""
    if colours is None:
        return np.zeros(len(triangles), int)
    mean = colours[triangles].mean(axis=1) / 255.0
    named = np.array([colour for _, colour, _ in palette])
    return np.asarray(((mean[:, None] - named) ** 2).sum(axis=2).argmin(axis=1))


def _elected(votes: np.ndarray, weights: np.ndarray, cells: np.ndarray, count: int) -> np.ndarray:
    """Return the block that the points (n,) of each of ``count`` cells elect by their weights."""
    kinds = np.unique(votes)
    sums = [np.bincount(cells, weights * (votes == kind), count) for kind in kinds]
    return np.asarray(kinds[np.argmax(sums, axis=0)])


def _voxels(
    places: np.ndarray,
    shape: tuple[int, int, int],
    triangles: np.ndarray,
    colours: np.ndarray | None,
    palette: Palette,
) -> np.ndarray:
    """Return a mesh, whose vertices are places in a grid of this shape, as blocks."""
    points, areas, whose = _points(places, triangles)
    cells = np.clip(points.astype(int), 0, np.array(shape) - 1)
    flat = np.ravel_multi_index(tuple(cells.T), shape)
    count = int(np.prod(shape))
    area = np.bincount(flat, areas, count).reshape(shape)
    numbers = np.array([block(name) for name, _, _ in palette], np.uint8)
    nearest = _nearest(triangles, colours, palette)
    weights = areas * np.array([weight for _, _, weight in palette])[nearest][whose]
    chosen = _elected(numbers[nearest][whose], weights, flat, count).reshape(shape)

    # Blocks hidden inside are of the first kind.
    chosen[area == 0] = numbers[0]
    solid = (area >= ENOUGH) | (_enclosed(area > 0) & (area == 0))
    return np.where(solid, chosen, 0).astype(np.uint8)


def _points(places: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return points (n, 3) spread over triangles, the area of each, its triangle's index."""
    corners = places[triangles]
    sides = corners[:, [1, 2]] - corners[:, [0]]
    areas = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1) / 2
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    count = int(np.clip(np.ceil(np.quantile(longest, 0.99) / FINEST), 2, MOST_POINTS))
    i, j = np.nonzero(np.add.outer(np.arange(count), np.arange(count)) < count)
    weights = np.stack([i + 1 / 3, j + 1 / 3, count - i - j - 2 / 3], axis=1) / count
    points = np.einsum("pc,tcd->tpd", weights, corners).reshape(-1, 3)
    shares = np.repeat(areas / len(weights), len(weights))
    return points, shares, np.repeat(np.arange(len(triangles)), len(weights))


def _enclosed(surface: np.ndarray) -> np.ndarray:
    """Return the cells that have surface on all six sides of them, or are surface, bool."""
    found = np.ones_like(surface)
    for axis in range(3):
        found &= np.logical_or.accumulate(surface, axis=axis)
        back = np.flip(np.logical_or.accumulate(np.flip(surface, axis), axis=axis), axis)
        found &= back
    return found
