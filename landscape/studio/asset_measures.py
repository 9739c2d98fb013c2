"""Measures of images and meshes, as plain numpy functions.

:mod:`landscape.studio.asset_check` applies them to the assets.
"""

from dataclasses import dataclass

import numpy as np

from landscape.elements.atlas import padded
from landscape.files.images import mip_chain

SKY_FACES = ("north", "east", "south", "west", "top")
MIP = 4  # the mip level whose coverage is compared with level 0

# ---- images -----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Seam:
    """Differences across the seam of a tile, in levels, and the largest ones inside it.

    ``change`` is the mean absolute difference, ``step`` the absolute mean difference. A step from
    light to dark is lost in the grain of the former but visible in the latter.
    """

    axis: str
    change: float
    change_inside: float
    step: float
    step_inside: float

    @property
    def ok(self) -> bool:
        """Whether the seam is no more visible than any other row or column."""
        return self.change <= self.change_inside and self.step <= self.step_inside


def seams(picture: np.ndarray) -> list[Seam]:
    """Measure the seams of a tile (h, w, 3 or 4): last to first column, last to first row."""
    found = []
    values = picture.astype(np.int16)
    if values.shape[2] == 4:
        # Weight by alpha: the colour of transparent texels is not visible.
        values = (values[..., :3].astype(np.int32) * values[..., 3:] // 255).astype(np.int16)
    for axis, name in ((1, "columns"), (0, "rows")):
        along = np.moveaxis(values, axis, 0)
        differences = np.diff(along, axis=0, append=along[:1])
        change = np.abs(differences).mean(axis=(1, 2))
        step = np.abs(differences.mean(axis=1)).max(axis=1)
        figures = (change[-1], change[:-1].max(), step[-1], step[:-1].max())
        found.append(Seam(name, *map(float, figures)))
    return found


def resampled_row(line: np.ndarray, count: int) -> np.ndarray:
    """Resample a row of colours (n, 3) to ``count`` texels, with the end texels aligned."""
    at, places = np.linspace(0, 1, count), np.linspace(0, 1, len(line))
    return np.stack([np.interp(at, places, channel) for channel in line.T.astype(float)], axis=-1)


def largest_step(difference: np.ndarray, run: int = 1) -> float:
    """Return the greatest absolute mean of a difference (n, 3) over ``run`` texels in a row."""
    total = np.cumsum(np.pad(difference.astype(float), ((1, 0), (0, 0))), axis=0)
    return float(np.abs(total[run:] - total[:-run]).max() / run)


def sky_edges(faces: dict[str, np.ndarray], run: int = 1) -> dict[str, float]:
    """Return the largest step, in levels, along each of the eight shared edges."""
    walls = SKY_FACES[:4]
    found = {}
    for one, other in zip(walls, (*walls[1:], walls[0]), strict=True):
        right, remaining = faces[one][:, -1].astype(int), faces[other][:, 0].astype(int)
        found[f"{one}-{other}"] = largest_step(right - remaining, run)
    top = faces["top"]
    edges = {"north": top[0], "east": top[:, -1], "south": top[-1, ::-1], "west": top[::-1, 0]}
    for wall, edge in edges.items():
        row = faces[wall][0].astype(float)
        found[f"{wall}-top"] = largest_step(resampled_row(edge, len(row)) - row, run)
    return found


def count_unbled(rgba: np.ndarray) -> int:
    """Count the transparent texels whose colour is not that of the nearest visible texel.

    ``rgba`` is uint8 (h, w, 4). Among equally near texels, the colour of any one is accepted.
    """
    height, width = rgba.shape[:2]
    empty = rgba[..., 3] == 0
    if empty.all() or not empty.any():
        return 0
    colour = rgba[..., :3].astype(np.int64) @ np.array([65536, 256, 1])

    # In each column, the nearest visible texel above and the nearest below.
    far = 4 * (height + width)
    rows = np.arange(height)[:, None]
    above = np.maximum.accumulate(np.where(empty, -far, rows), axis=0)
    below = np.minimum.accumulate(np.where(empty, far, rows)[::-1], axis=0)[::-1]
    columns = np.arange(width)
    apart = ((columns[:, None] - columns[None, :]) ** 2).astype(np.float32)
    wrong = 0
    for row in np.flatnonzero(empty.any(axis=1)):
        holes = np.flatnonzero(empty[row])
        up, down = row - above[row], below[row] - row
        near = np.minimum(up, down).astype(np.float32) ** 2
        distance = apart[holes] + near
        nearest = distance.argmin(axis=1)
        sides = [
            (up <= down, colour[np.clip(above[row], 0, None), columns]),
            (down <= up, colour[np.clip(below[row], None, height - 1), columns]),
        ]
        own = colour[row, holes]
        fits = np.zeros(len(holes), bool)
        for counts, source in sides:
            fits |= counts[nearest] & (source[nearest] == own)
        # The few that remain may have the colour of another texel at the same distance.
        remaining = np.flatnonzero(~fits)
        ties = distance[remaining] == distance[remaining, nearest[remaining]][:, None]
        for counts, source in sides:
            same = ties & counts & (source == own[remaining][:, None])
            fits[remaining] |= same.any(axis=1)
        wrong += int((~fits).sum())

    return wrong


def coverage(rgba: np.ndarray) -> tuple[float, float]:
    """Return the fraction of a sprite with an alpha above one half, at mip levels 0 and MIP.

    The sprite is padded to its atlas cell and downsampled exactly as in the program.
    """
    chain = mip_chain(padded(rgba), MIP + 1)
    first, last = (float((level[..., 3] > 127).mean()) for level in (chain[0], chain[MIP]))
    return first, last


def frames(sheet: np.ndarray, side: int) -> np.ndarray:
    """Cut a sprite sheet (h, w, c) into frames (side * side, h / side, w / side, c), by row."""
    h, w, channels = sheet.shape
    cut = sheet.reshape(side, h // side, side, w // side, channels)
    return cut.transpose(0, 2, 1, 3, 4).reshape(side * side, h // side, w // side, channels)


def loop_steps(pictures: np.ndarray) -> np.ndarray:
    """Return the mean difference (n,) from each frame (n, h, w, 4) to the next, cyclically."""
    shown = pictures[..., :3] * (pictures[..., 3:] / 255.0)
    return np.abs(np.roll(shown, -1, axis=0) - shown).mean(axis=(1, 2, 3))


# ---- heights and meshes -----------------------------------------------------------------------


def height_at(heights: np.ndarray, x: float, z: float, size: float) -> float:
    """Return the height at (x, z) in an image (n, n) that covers ``size`` x ``size`` units."""
    n = heights.shape[0]
    return float(heights[int(z / size * n), int(x / size * n)])


def open_edges(triangles: np.ndarray) -> int:
    """Count the edges not used once in each direction; 0 means closed and consistently wound."""
    t = triangles.astype(np.int64)
    pairs = np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]])
    n = int(t.max()) + 1
    once, count = np.unique(pairs[:, 0] * n + pairs[:, 1], return_counts=True)
    back = (once % n) * n + once // n
    return int((count != 1).sum() + (~np.isin(back, once)).sum())


def volume(vertices: np.ndarray, triangles: np.ndarray) -> float:
    """Return the signed volume of a closed mesh: positive if its faces point outward."""
    a, b, c = (vertices[triangles[:, k]].astype(float) for k in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0)


def flipped_normals(vertices: np.ndarray, triangles: np.ndarray, normals: np.ndarray) -> float:
    """Return the fraction of face corners whose normal points away from the face's own normal."""
    a, b, c = (vertices[triangles[:, k]].astype(float) for k in range(3))
    face = np.cross(b - a, c - a)
    agree = np.einsum("ikj,ij->ik", normals[triangles].astype(float), face)
    return float((agree <= 0).mean())
