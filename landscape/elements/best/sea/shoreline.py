"""The shoreline: where the ground's triangles cross the water, and how far from it a place is.

Distances are computed on the texels of a map: each piece of the shoreline, which is straight within
a triangle, is compared with the texels around it. No OpenGL here.
"""

import numpy as np

from landscape.geometry.height_field import HeightField
from landscape.geometry.mesh import grid_triangles

TEXELS = 1024  # chosen: per side of the map
REACH = 0.8  # chosen: units from the shoreline within which distances are computed
ROUNDED = 2  # chosen: times a distance is averaged with its neighbours: no corners
PIECES = 512  # pieces of the shoreline compared at a time
FAINT = -0.02  # chosen: density of foam that is not seen; a byte of the map may err by 0.01


def crossings(
    places: np.ndarray, rise: np.ndarray, triangles: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return where triangles (m, 3) cross the water: (n, 2, 2), both ends' x and z; slopes (n,).

    Vertices are at x, z ``places`` (k, 2) and ``rise`` (k,) above the water, in units. A slope is
    the triangle's rise over run.
    """
    wet = rise[triangles] < 0
    triangles = triangles[wet.any(axis=1) & ~wet.all(axis=1)]

    # Turned so that the first corner lies alone on its side of the water's level.
    wet = rise[triangles] < 0
    alone = np.where(wet.sum(axis=1) == 1, wet.argmax(axis=1), (~wet).argmax(axis=1))
    first, *others = (triangles[np.arange(len(triangles)), (alone + k) % 3] for k in range(3))
    ends = []
    for other in others:
        share = rise[first] / (rise[first] - rise[other])
        ends.append(places[first] + share[:, None] * (places[other] - places[first]))
    sides = [
        np.column_stack([places[other] - places[first], rise[other] - rise[first]])
        for other in others
    ]
    normal = np.cross(sides[0], sides[1])
    slope = np.hypot(normal[:, 0], normal[:, 1]) / np.maximum(np.abs(normal[:, 2]), 1e-9)
    return np.stack(ends, axis=1), slope


def pieces(field: HeightField) -> tuple[np.ndarray, np.ndarray]:
    """Return the shoreline's pieces, (n, 2, 2): both ends' x and z in units; and slopes (n,).

    A slope is the rise over run of the ground there.
    """
    side = len(field.heights)
    rise = (field.heights.ravel() - field.water_level).astype(np.float64)
    row, column = np.divmod(np.arange(side * side), side)
    places = np.stack([column, row], axis=1) * (field.size / (side - 1))
    return crossings(places, rise, grid_triangles(side, side))


def distances(places: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """Return the distance of each place (n, m, 2) from a piece (n, 2, 2), (n, m)."""
    start, along = ends[:, None, 0], (ends[:, 1] - ends[:, 0])[:, None]
    length = np.maximum((along * along).sum(axis=2), 1e-12)
    share = np.clip(((places - start) * along).sum(axis=2) / length, 0.0, 1.0)
    apart = places - start - share[..., None] * along
    return np.asarray(np.sqrt((apart * apart).sum(axis=2)))


def nearest_pieces(
    ends: np.ndarray, texels: int, texel: float, reach: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return each texel's distance from the nearest piece (n, 2, 2), and which one that is.

    Both are (texels, texels), row along z; a texel is ``texel`` units wide, the first is at 0, 0.
    Beyond ``reach`` the distance is that, and the number -1.
    """
    longest = float(np.abs(ends[:, 1] - ends[:, 0]).max(initial=0.0))
    radius = int(np.ceil((reach + longest) / texel))
    offsets = np.stack(np.meshgrid(*[np.arange(-radius, radius + 1)] * 2), axis=2).reshape(-1, 2)

    # The least of (distance, number), as one whole number.
    far = int(np.iinfo(np.int64).max)
    nearest = np.full(texels * texels, far, np.int64)
    for begin in range(0, len(ends), PIECES):
        part = ends[begin : begin + PIECES]
        middle = (part.mean(axis=1) / texel).astype(np.int64)
        column, row = np.moveaxis(middle[:, None] + offsets, 2, 0)
        places = (np.stack([column, row], axis=2) + 0.5) * texel
        apart = distances(places, part)
        number = np.broadcast_to(np.arange(begin, begin + len(part))[:, None], apart.shape)
        kept = (apart < reach) & (np.minimum(column, row) >= 0)
        kept &= np.maximum(column, row) < texels
        key = (apart[kept] * 1e6).astype(np.int64) << 24 | number[kept]
        np.minimum.at(nearest, (row * texels + column)[kept], key)

    found = nearest < far
    away = np.where(found, (nearest >> 24) * 1e-6, reach).reshape(texels, texels)
    return away, np.where(found, nearest & (1 << 24) - 1, -1).reshape(texels, texels)


def shore_map(field: HeightField, texels: int = TEXELS) -> tuple[np.ndarray, np.ndarray]:
    """Return distances to the shoreline and the slope there, (texels, texels), row along z.

    Distances are in units, positive on the water, at most REACH on either side; slopes are those of
    the nearest piece, 0 where there is none.
    """
    ends, slope = pieces(field)
    texel = field.size / texels
    away, number = nearest_pieces(ends, texels, texel, REACH)
    steep = np.append(slope, 0.0)[number]
    at = (np.arange(texels) + 0.5) * texel
    wet = field.terrain_height(at[None, :], at[:, None]) < field.water_level
    signed = np.where(wet, away, -away)
    for _ in range(ROUNDED):
        signed = averaged(signed)
    return signed, steep


def averaged(values: np.ndarray) -> np.ndarray:
    """Return the mean of each value (n, n) and its neighbours, two to each side, by 1 4 6 4 1."""
    for _ in range(2):
        wide = np.pad(values, ((2, 2), (0, 0)), mode="edge")
        out = 6.0 * wide[2:-2] + 4.0 * (wide[1:-3] + wide[3:-1]) + wide[:-4] + wide[4:]
        values = (out / 16.0).T
    return values


def spread(values: np.ndarray, steps: int) -> np.ndarray:
    """Return the mean of the values (n, n) that are not 0 within ``steps`` texels, 0 elsewhere."""

    def summed(a: np.ndarray) -> np.ndarray:
        for _ in range(2):
            total = np.pad(a, ((steps + 1, steps), (0, 0))).cumsum(axis=0)
            a = (total[2 * steps + 1 :] - total[: -2 * steps - 1]).T
        return a

    weight = summed((values > 0).astype(np.float64))
    return np.where(weight > 0.5, summed(values) / np.maximum(weight, 0.5), 0.0)


def last_foam(along: np.ndarray, swell: np.ndarray, edge: np.ndarray) -> float:
    """Return the last of the places ``along`` (n,) where there is foam at the height of the swell.

    ``swell`` and ``edge`` (n,) are its strength and the foam that stays; what is below FAINT in all
    does not show.
    """
    return float(along[swell + edge > FAINT].max())
