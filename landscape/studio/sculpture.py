"""Modelling tools: signed distances, swept curves, and meshes with an exact number of vertices.

A shape is a scalar field, negative inside, written as a numba function of (x, y, z, data). Parts
are joined with the polynomial smooth union of Inigo Quilez ("smooth minimum", 2013), the level
zero is triangulated by marching cubes (Lorensen and Cline 1987, in the version of Lewiner 2003),
reduced by quadric error (Garland and Heckbert 1997) to a little more than the wanted count, and
brought to the count itself by single edge collapses under the link condition (Dey et al. 1999),
which keeps the surface closed.
"""

import math
from collections.abc import Callable
from typing import Any

import fast_simplification
import numpy as np
from numba import njit
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from skimage import measure

Field = Callable[[float, float, float, Any], float]
Mesh = tuple[np.ndarray, np.ndarray]
PaintedMesh = tuple[np.ndarray, np.ndarray, np.ndarray]  # and a colour for each vertex

SPARE_FACES = 60  # chosen: faces the quadric pass leaves for the exact pass to remove
SETTLE_ROUNDS = 4  # chosen: enough for calm normals
SCHEDULES = (7.0, 6.0, 5.0, 4.0, 3.0)  # chosen: 7 is the library's own haste
RELAX_ROUNDS = 3  # chosen: smooths the slivers of marching cubes without losing the features


@njit
def mix(a: float, b: float, t: float) -> float:
    """Blend linearly from a (t = 0) to b (t = 1)."""
    return a + (b - a) * t


@njit
def clamp(x: float, low: float, high: float) -> float:
    """Limit x to low..high."""
    return min(max(x, low), high)


@njit
def step_smooth(low: float, high: float, x: float) -> float:
    """Cubic step from 0 at ``low`` to 1 at ``high``; ``low`` may be the greater of the two."""
    t = clamp((x - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


@njit
def union(a: float, b: float, k: float) -> float:
    """Join two distances with a fillet of width k."""
    h = clamp(0.5 + 0.5 * (b - a) / k, 0.0, 1.0)
    return b + (a - b) * h - k * h * (1.0 - h)


@njit
def carve(a: float, b: float, k: float) -> float:
    """Take shape b out of shape a, the edge rounded over a width k."""
    return -union(-a, b, k)


@njit
def ellipsoid(x: float, y: float, z: float, rx: float, ry: float, rz: float) -> float:
    """Distance (first order, exact at the surface) to an ellipsoid about the origin."""
    k0 = math.sqrt((x / rx) ** 2 + (y / ry) ** 2 + (z / rz) ** 2)
    k1 = math.sqrt((x / rx**2) ** 2 + (y / ry**2) ** 2 + (z / rz**2) ** 2)
    if k1 < 1e-9:
        return -min(rx, ry, rz)
    return k0 * (k0 - 1.0) / k1


@njit
def limb(
    x: float, y: float, z: float,
    ax: float, ay: float, az: float, ra: float,
    bx: float, by: float, bz: float, rb: float,
) -> float:  # fmt: skip
    """Distance to a limb: a segment from a to b with a radius that goes from ra to rb."""
    dx, dy, dz = bx - ax, by - ay, bz - az
    px, py, pz = x - ax, y - ay, z - az
    t = clamp((px * dx + py * dy + pz * dz) / (dx * dx + dy * dy + dz * dz), 0.0, 1.0)
    px, py, pz = px - t * dx, py - t * dy, pz - t * dz
    return math.sqrt(px * px + py * py + pz * pz) - mix(ra, rb, t)


@njit
def turn(a: float, b: float, angle: float) -> tuple[float, float]:
    """Rotate the pair (a, b) by ``angle`` radians from a towards b."""
    c, s = math.cos(angle), math.sin(angle)
    return c * a - s * b, s * a + c * b


@njit
def _lattice(i: int, j: int, k: int) -> float:
    """Hash three integers to -1..1."""
    h = (i * 73856093) ^ (j * 19349663) ^ (k * 83492791)
    h = ((h ^ (h >> 13)) * 1274126177) & 0x7FFFFFFF
    h = ((h ^ (h >> 15)) * 668265263) & 0x7FFFFFFF
    return ((h >> 7) & 0xFFFF) / 32767.5 - 1.0


@njit
def noise(x: float, y: float, z: float) -> float:
    """Value noise in about -1..1 with one feature per unit."""
    i, j, k = math.floor(x), math.floor(y), math.floor(z)
    u, v, w = x - i, y - j, z - k
    u, v, w = u * u * (3 - 2 * u), v * v * (3 - 2 * v), w * w * (3 - 2 * w)
    i, j, k = int(i), int(j), int(k)
    low = mix(
        mix(_lattice(i, j, k), _lattice(i + 1, j, k), u),
        mix(_lattice(i, j + 1, k), _lattice(i + 1, j + 1, k), u),
        v,
    )
    high = mix(
        mix(_lattice(i, j, k + 1), _lattice(i + 1, j, k + 1), u),
        mix(_lattice(i, j + 1, k + 1), _lattice(i + 1, j + 1, k + 1), u),
        v,
    )
    return mix(low, high, w)


def catmull_rom(points: np.ndarray, samples: int) -> np.ndarray:
    """Sample a Catmull-Rom curve through points (n, c); return (samples, c), about equally spaced.

    The first three columns are the position, any others (a radius) are interpolated with it.
    """
    points = np.asarray(points, dtype=float)
    ends = np.vstack([2 * points[0] - points[1], points, 2 * points[-1] - points[-2]])
    t = np.linspace(0, len(points) - 1, 40 * len(points))
    i = np.minimum(t.astype(int), len(points) - 2)
    f = (t - i)[:, None]
    p0, p1, p2, p3 = ends[i], ends[i + 1], ends[i + 2], ends[i + 3]
    fine = p1 + 0.5 * f * (
        p2 - p0 + f * (2 * p0 - 5 * p1 + 4 * p2 - p3 + f * (3 * (p1 - p2) + p3 - p0))
    )
    length = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(fine[:, :3], axis=0), axis=1)))
    wanted = np.linspace(0, length[-1], samples)
    return np.stack([np.interp(wanted, length, column) for column in fine.T], axis=1)


@njit
def nearest(curve: np.ndarray, x: float, y: float, z: float) -> tuple[int, float, float]:
    """Return (segment, place in it 0..1, distance) of the point of a polyline nearest to (x, y, z).

    ``curve`` is (n, c >= 3), its first three columns the position, its points close together: the
    nearest point is looked for only on the two segments at the nearest corner.
    """
    best, corner = 1e30, 0
    for i in range(curve.shape[0]):
        d = (x - curve[i, 0]) ** 2 + (y - curve[i, 1]) ** 2 + (z - curve[i, 2]) ** 2
        if d < best:
            best, corner = d, i
    best, best_i, best_t = 1e30, 0, 0.0
    for i in range(max(corner - 1, 0), min(corner + 1, curve.shape[0] - 1)):
        ax, ay, az = curve[i, 0], curve[i, 1], curve[i, 2]
        dx, dy, dz = curve[i + 1, 0] - ax, curve[i + 1, 1] - ay, curve[i + 1, 2] - az
        px, py, pz = x - ax, y - ay, z - az
        t = clamp((px * dx + py * dy + pz * dz) / (dx * dx + dy * dy + dz * dz), 0.0, 1.0)
        d = (px - t * dx) ** 2 + (py - t * dy) ** 2 + (pz - t * dz) ** 2
        if d < best:
            best, best_i, best_t = d, i, t
    return best_i, best_t, math.sqrt(best)


@njit
def _fill(field, data, low, step, volume):  # type: ignore[no-untyped-def]
    for i in range(volume.shape[0]):
        for j in range(volume.shape[1]):
            for k in range(volume.shape[2]):
                volume[i, j, k] = field(
                    low[0] + i * step, low[1] + j * step, low[2] + k * step, data
                )


def triangulate(field: Field, data: Any, low: np.ndarray, high: np.ndarray, step: float) -> Mesh:
    """Return the largest closed piece of the level zero of ``field`` in the box low..high."""
    low = np.asarray(low, dtype=float)
    shape = np.ceil((np.asarray(high) - low) / step).astype(int) + 1
    volume = np.empty(shape, dtype=np.float32)
    _fill(field, data, low, step, volume)
    # The values rise outwards ("descent" towards the object): counter-clockwise from outside.
    vertices, faces, _, _ = measure.marching_cubes(volume, 0.0, gradient_direction="descent")
    vertices, faces = largest_piece(vertices * step + low, faces)
    if not is_closed(faces):
        raise ValueError("the shape leaves the box")
    return vertices, faces


def largest_piece(vertices: np.ndarray, faces: np.ndarray) -> Mesh:
    """Drop all but the connected piece with the most vertices, and the vertices no face uses."""
    n = len(vertices)
    edges = np.concatenate([faces[:, :2], faces[:, 1:]])
    graph = coo_matrix((np.ones(len(edges)), (edges[:, 0], edges[:, 1])), shape=(n, n))
    label = connected_components(graph, directed=False)[1]
    keep = label == np.bincount(label).argmax()
    number = np.cumsum(keep) - 1
    return vertices[keep], number[faces[keep[faces[:, 0]]]].astype(np.int32)


def relax(vertices: np.ndarray, faces: np.ndarray, rounds: int) -> np.ndarray:
    """Smooth by Taubin's pair of steps (1995): rounds off the steps of the grid, keeps the size."""

    i, j = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    weights = coo_matrix((np.ones(len(i)), (i, j)), shape=(len(vertices),) * 2).tocsr()
    degree = np.asarray(weights.sum(axis=1))
    for _ in range(rounds):
        for factor in (0.5, -0.53):
            vertices = vertices + factor * (weights @ vertices / degree - vertices)
    return vertices


@njit
def _project(field, data, vertices, reach):  # type: ignore[no-untyped-def]
    """Move vertices (n, 3) along the gradient of ``field`` onto its level zero, in place."""
    e = 0.25 * reach
    for i in range(vertices.shape[0]):
        x, y, z = vertices[i]
        d = field(x, y, z, data)
        gx = (field(x + e, y, z, data) - field(x - e, y, z, data)) / (2 * e)
        gy = (field(x, y + e, z, data) - field(x, y - e, z, data)) / (2 * e)
        gz = (field(x, y, z + e, data) - field(x, y, z - e, data)) / (2 * e)
        square = gx * gx + gy * gy + gz * gz
        if square > 0.1:
            s = clamp(d / square, -reach, reach)
            vertices[i, 0] -= s * gx
            vertices[i, 1] -= s * gy
            vertices[i, 2] -= s * gz


def settle(
    field: Field, data: Any, vertices: np.ndarray, faces: np.ndarray, reach: float
) -> np.ndarray:
    """Even out the triangles and put the vertices back on the surface, so that normals are calm.

    Vertices whose neighbours bend sharply (teeth, the edge of a fin) stay where they are.
    """
    for _ in range(SETTLE_ROUNDS):
        moved = relax(vertices, faces, 1)
        before, after = face_normals(vertices, faces), face_normals(moved, faces)
        risky = (before * after).sum(axis=1) < 0.9
        still = np.zeros(len(vertices), dtype=bool)
        still[faces[risky].ravel()] = True
        moved[still] = vertices[still]
        vertices = moved
        _project(field, data, vertices, reach)
    return vertices


def face_normals(vertices: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Unit normals (m, 3) of triangles, outward for counter-clockwise ones."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    n = np.cross(b - a, c - a)
    return n / np.maximum(np.linalg.norm(n, axis=1, keepdims=True), 1e-30)


def point_normals(vertices: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Return unit normals (n, 3) of the vertices, each triangle counting alike."""
    summed = np.zeros((len(vertices), 3))
    for corner in range(3):
        np.add.at(summed, faces[:, corner], face_normals(vertices, faces))
    return np.asarray(summed / np.maximum(np.linalg.norm(summed, axis=1, keepdims=True), 1e-12))


def _link_is_clean(around: dict[int, set[int]], fans: list[set[int]], a: int, b: int) -> bool:
    """Tell whether merging a and b keeps the surface closed: they share exactly two neighbours."""
    return len(around[a] & around[b]) == 2 and len(fans[a]) > 3 and len(fans[b]) > 3


def collapse_to(vertices: np.ndarray, faces: np.ndarray, count: int) -> Mesh:
    """Collapse the shortest edges that may go until ``count`` vertices are left.

    The fans of touched vertices are not touched again, so that the lengths stay true.
    """
    vertices, triangles = vertices.copy(), [tuple(map(int, f)) for f in faces]
    fans: list[set[int]] = [set() for _ in range(len(vertices))]
    for number, triangle in enumerate(triangles):
        for v in triangle:
            fans[v].add(number)
    edges = np.concatenate([faces[:, :2], faces[:, 1:], faces[:, ::2]])
    edges = np.unique(np.sort(edges, axis=1), axis=0)
    length = np.linalg.norm(vertices[edges[:, 0]] - vertices[edges[:, 1]], axis=1)
    left, frozen = len(vertices), set[int]()
    for a, b in edges[np.argsort(length, kind="stable")].tolist():
        if left == count:
            break
        if a in frozen or b in frozen:
            continue
        around = {v: {w for f in fans[v] for w in triangles[f]} - {v} for v in (a, b)}
        middle = (vertices[a] + vertices[b]) / 2
        stay = sorted(fans[a] ^ fans[b])
        if not _link_is_clean(around, fans, a, b) or _would_flip(
            vertices, triangles, stay, (a, b), middle
        ):
            continue
        for f in fans[a] & fans[b]:
            for v in triangles[f]:
                if v not in (a, b):
                    fans[v].discard(f)
            triangles[f] = ()
        for f in stay:
            triangles[f] = tuple(a if v == b else v for v in triangles[f])
        fans[a], fans[b] = set(stay), set()
        vertices[a] = middle
        frozen |= around[a] | around[b] | {a, b}
        left -= 1
    if left != count:
        raise ValueError(f"{left} vertices, {count} wanted: leave fewer spare faces")
    out = np.array([t for t in triangles if t], dtype=np.int64)
    used, index = np.unique(out, return_inverse=True)
    return vertices[used], index.reshape(out.shape).astype(np.int32)


def _would_flip(vertices, triangles, stay, pair, middle):  # type: ignore[no-untyped-def]
    """Tell whether moving both ends of an edge to its middle turns a neighbouring face over."""
    for f in stay:
        old = np.array([vertices[v] for v in triangles[f]])
        new = np.array([middle if v in pair else vertices[v] for v in triangles[f]])
        n0 = np.cross(old[1] - old[0], old[2] - old[0])
        n1 = np.cross(new[1] - new[0], new[2] - new[0])
        if n0 @ n1 <= 0.2 * np.linalg.norm(n0) * np.linalg.norm(n1):
            return True
    return False


def _reduce(vertices: np.ndarray, faces: np.ndarray, count: int) -> Mesh:
    """Reduce to a little over ``count`` vertices, still closed.

    A pinch that cannot be parted (see ``unpinch``) is rare and depends on the order of the
    collapses: then a more patient order is taken.
    """
    holes = 2 - (len(vertices) - len(faces) // 2)  # Euler: V - F/2 = 2 - 2 genus
    vertices, faces = np.ascontiguousarray(vertices, np.float32), np.ascontiguousarray(faces)
    for haste in SCHEDULES:
        points, triangles = fast_simplification.simplify(
            vertices, faces, target_count=2 * (count - 2 + holes) + SPARE_FACES, agg=haste
        )
        points, triangles = largest_piece(*unpinch(points.astype(float), triangles))
        if is_closed(triangles) and len(points) >= count:
            return points, triangles
    raise ValueError("no order of collapses keeps the surface closed: thicken the thin parts")


def unpinch(vertices: np.ndarray, faces: np.ndarray) -> Mesh:
    """Part the sheets of a surface that touch in a vertex or in an edge of four faces.

    The library does not test the link condition, so it pinches a thin place now and then. Corners
    of two triangles are one vertex only if an edge with exactly these two faces joins them.
    """
    m = len(faces)
    start, end = faces.T.ravel(), np.roll(faces, -1, axis=1).T.ravel()
    corner = np.arange(3 * m)
    follow = (corner + m) % (3 * m)
    low, high = np.minimum(start, end).astype(np.int64), np.maximum(start, end)
    _, edge, uses = np.unique(low << 32 | high, return_inverse=True, return_counts=True)
    order = np.argsort(edge, kind="stable")
    order = order[uses[edge[order]] == 2].reshape(-1, 2)
    one, other = order[:, 0], order[:, 1]
    links = np.concatenate([corner[one], follow[one]]), np.concatenate([follow[other], other])
    graph = coo_matrix((np.ones(len(links[0])), links), shape=(3 * m,) * 2)
    number, label = connected_components(graph, directed=False)
    points = np.empty((number, 3))
    points[label] = vertices[start]
    return points, label.reshape(3, m).T.astype(np.int32)


def is_closed(faces: np.ndarray) -> bool:
    """Tell whether every edge has two faces, which run along it in opposite directions."""
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).astype(np.int64)
    ways = edges @ np.array([1 << 32, 1])
    back = edges @ np.array([1, 1 << 32])
    return len(np.unique(ways)) == len(ways) and np.array_equal(np.sort(ways), np.sort(back))


def carry_out(
    field: Field,
    data: Any,
    low: np.ndarray,
    high: np.ndarray,
    step: float,
    count: int,
    paint: Callable[[np.ndarray, np.ndarray, Any], np.ndarray],
    paint_data: Any,
) -> PaintedMesh:
    """Sculpt ``field``: a closed mesh of exactly ``count`` vertices, its largest extent -1..1.

    ``paint`` gives the vertices their colours, from places and normals (n, 3) in the field's frame.
    """
    vertices, faces = triangulate(field, data, low, high, step)
    vertices = relax(vertices, faces, RELAX_ROUNDS)
    vertices, faces = collapse_to(*_reduce(vertices, faces, count), count)
    vertices = settle(field, data, vertices, faces, 0.5 * step)
    colours = paint(vertices, point_normals(vertices, faces), paint_data)
    lowest, highest = vertices.min(axis=0), vertices.max(axis=0)
    vertices = (vertices - (lowest + highest) / 2) / ((highest - lowest).max() / 2)
    return vertices.astype(np.float32), faces, colours
