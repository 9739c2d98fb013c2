"""Conversion of a signed distance field to a closed mesh with an exact number of vertices.

A field is a numba function of (x, y, z, data), negative inside (see
:mod:`landscape.studio.shapes`). Its zero level set is triangulated by marching cubes (Lorensen and
Cline 1987, in the version of Lewiner 2003) and simplified by quadric error (Garland and Heckbert
1997) to slightly more than the required vertex count. Single edge collapses under the link
condition (Dey et al. 1999), which keeps the surface closed, then bring it to the exact count.
"""

from collections.abc import Callable
from typing import TypeVar

import fast_simplification
import numpy as np
from numba import njit
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from skimage import measure

from landscape.studio.shapes import clamp

Paint = TypeVar("Paint")
Data = TypeVar("Data")  # what a field is made of: numbers, arrays, or tuples of them
Field = Callable[[float, float, float, Data], float]
Mesh = tuple[np.ndarray, np.ndarray]
PaintedMesh = tuple[np.ndarray, np.ndarray, np.ndarray]  # vertices, faces, vertex colours

FACE_MARGIN = 60  # chosen: extra faces that the quadric pass leaves for the exact pass
FAIR_ROUNDS = 4  # chosen: enough for smooth normals
AGGRESSIVENESS = (7.0, 6.0, 5.0, 4.0, 3.0)  # chosen: 7 is the library's default
RELAX_ROUNDS = 3  # chosen: removes marching cubes' sliver triangles without losing features


@njit
def _sample_field(field, data, low, step, volume):  # type: ignore[no-untyped-def]
    for i in range(volume.shape[0]):
        for j in range(volume.shape[1]):
            for k in range(volume.shape[2]):
                volume[i, j, k] = field(
                    low[0] + i * step, low[1] + j * step, low[2] + k * step, data
                )


def triangulate(
    field: Field[Data], data: Data, low: np.ndarray, high: np.ndarray, step: float
) -> Mesh:
    """Triangulate the zero level set of ``field`` in the box low..high; return its largest part.

    Raises ValueError if the surface is not closed.
    """
    low = np.asarray(low, dtype=float)
    shape = np.ceil((np.asarray(high) - low) / step).astype(int) + 1
    volume = np.empty(shape, dtype=np.float32)
    _sample_field(field, data, low, step, volume)
    # The field increases outward ("descent" means towards the object), so faces are
    # counter-clockwise seen from outside.
    vertices, faces, _, _ = measure.marching_cubes(volume, 0.0, gradient_direction="descent")
    vertices, faces = largest_piece(vertices * step + low, faces)
    if not is_closed(faces):
        raise ValueError("the shape extends beyond the box")
    return vertices, faces


def largest_piece(vertices: np.ndarray, faces: np.ndarray) -> Mesh:
    """Return only the connected component with the most vertices, without unused vertices."""
    n = len(vertices)
    edges = np.concatenate([faces[:, :2], faces[:, 1:]])
    graph = coo_matrix((np.ones(len(edges)), (edges[:, 0], edges[:, 1])), shape=(n, n))
    label = connected_components(graph, directed=False)[1]
    keep = label == np.bincount(label).argmax()
    number = np.cumsum(keep) - 1
    return vertices[keep], number[faces[keep[faces[:, 0]]]].astype(np.int32)


def relax(vertices: np.ndarray, faces: np.ndarray, rounds: int) -> np.ndarray:
    """Apply Taubin smoothing (1995), which removes the steps of the grid without shrinking."""
    i, j = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    weights = coo_matrix((np.ones(len(i)), (i, j)), shape=(len(vertices),) * 2).tocsr()
    degree = np.asarray(weights.sum(axis=1))
    for _ in range(rounds):
        for factor in (0.5, -0.53):
            vertices = vertices + factor * (weights @ vertices / degree - vertices)
    return vertices


@njit
def _project(field, data, vertices, reach):  # type: ignore[no-untyped-def]
    """Move vertices (n, 3) along the gradient of ``field`` onto its zero level set, in place."""
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


def fair(
    field: Field[Data], data: Data, vertices: np.ndarray, faces: np.ndarray, reach: float
) -> np.ndarray:
    """Fair the mesh for smooth normals: relax it and project the vertices back onto the surface.

    Vertices of faces that relaxing would rotate too far (teeth, edges of fins) keep their position.
    """
    for _ in range(FAIR_ROUNDS):
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
    """Return the unit normals (m, 3) of triangles, outward where they are counter-clockwise."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    n = np.cross(b - a, c - a)
    return n / np.maximum(np.linalg.norm(n, axis=1, keepdims=True), 1e-30)


def point_normals(vertices: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Return the unit normals (n, 3) of the vertices, all triangles weighted equally."""
    summed = np.zeros((len(vertices), 3))
    for corner in range(3):
        np.add.at(summed, faces[:, corner], face_normals(vertices, faces))
    return np.asarray(summed / np.maximum(np.linalg.norm(summed, axis=1, keepdims=True), 1e-12))


def _link_condition_holds(
    around: dict[int, set[int]], fans: list[set[int]], a: int, b: int
) -> bool:
    """Return whether collapsing edge (a, b) keeps the surface closed and manifold.

    The two ends must share exactly two neighbours, and each must have more than three faces.
    """
    return len(around[a] & around[b]) == 2 and len(fans[a]) > 3 and len(fans[b]) > 3


def collapse_to(vertices: np.ndarray, faces: np.ndarray, count: int) -> Mesh:
    """Collapse the shortest valid edges until ``count`` vertices are left.

    The neighbourhood of a collapse is frozen, so that the sorted edge lengths stay valid.
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
        surviving = sorted(fans[a] ^ fans[b])
        if not _link_condition_holds(around, fans, a, b) or _would_flip(
            vertices, triangles, surviving, (a, b), middle
        ):
            continue
        for f in fans[a] & fans[b]:
            for v in triangles[f]:
                if v not in (a, b):
                    fans[v].discard(f)
            triangles[f] = ()
        for f in surviving:
            triangles[f] = tuple(a if v == b else v for v in triangles[f])
        fans[a], fans[b] = set(surviving), set()
        vertices[a] = middle
        frozen |= around[a] | around[b] | {a, b}
        left -= 1

    if left != count:
        raise ValueError(f"{left} vertices left instead of {count}: lower FACE_MARGIN")
    out = np.array([t for t in triangles if t], dtype=np.int64)
    used, index = np.unique(out, return_inverse=True)
    return vertices[used], index.reshape(out.shape).astype(np.int32)


def _would_flip(vertices, triangles, surviving, pair, middle):  # type: ignore[no-untyped-def]
    """Return whether moving both ends of an edge to its midpoint flips an adjacent face."""
    for f in surviving:
        old = np.array([vertices[v] for v in triangles[f]])
        new = np.array([middle if v in pair else vertices[v] for v in triangles[f]])
        n0 = np.cross(old[1] - old[0], old[2] - old[0])
        n1 = np.cross(new[1] - new[0], new[2] - new[0])
        if n0 @ n1 <= 0.2 * np.linalg.norm(n0) * np.linalg.norm(n1):
            return True
    return False


def _reduce(vertices: np.ndarray, faces: np.ndarray, count: int) -> Mesh:
    """Simplify to slightly more than ``count`` vertices, keeping the surface closed.

    A non-manifold spot that cannot be separated (see ``unpinch``) is rare and depends on the order
    of the collapses, so a lower aggressiveness is tried then.
    """
    holes = 2 - (len(vertices) - len(faces) // 2)  # Euler: V - F/2 = 2 - 2 genus
    vertices, faces = np.ascontiguousarray(vertices, np.float32), np.ascontiguousarray(faces)
    for aggressiveness in AGGRESSIVENESS:
        points, triangles = fast_simplification.simplify(
            vertices, faces, target_count=2 * (count - 2 + holes) + FACE_MARGIN, agg=aggressiveness
        )
        points, triangles = largest_piece(*unpinch(points.astype(float), triangles))
        if is_closed(triangles) and len(points) >= count:
            return points, triangles
    raise ValueError("simplification leaves the surface open or too coarse: thicken thin parts")


def unpinch(vertices: np.ndarray, faces: np.ndarray) -> Mesh:
    """Separate sheets of a surface that touch at a vertex or at an edge with four faces.

    The library does not test the link condition, so it sometimes pinches a thin part. Corners of
    two triangles are the same vertex only if an edge with exactly these two faces connects them.
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
    """Return whether every edge has two faces that traverse it in opposite directions."""
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).astype(np.int64)
    forward = edges @ np.array([1 << 32, 1])
    backward = edges @ np.array([1, 1 << 32])
    return len(np.unique(forward)) == len(forward) and np.array_equal(
        np.sort(forward), np.sort(backward)
    )


def shaped(
    field: Field[Data], data: Data, low: np.ndarray, high: np.ndarray, step: float, count: int
) -> Mesh:
    """Convert ``field`` to a closed mesh of exactly ``count`` vertices, in the field's frame."""
    vertices, faces = triangulate(field, data, low, high, step)
    vertices = relax(vertices, faces, RELAX_ROUNDS)
    vertices, faces = collapse_to(*_reduce(vertices, faces, count), count)
    return fair(field, data, vertices, faces, 0.5 * step), faces


def sculpt(
    field: Field[Data],
    data: Data,
    low: np.ndarray,
    high: np.ndarray,
    step: float,
    count: int,
    paint: Callable[[np.ndarray, np.ndarray, Paint], np.ndarray],
    paint_data: Paint,
) -> PaintedMesh:
    """Convert ``field`` to a closed mesh of exactly ``count`` vertices, its largest extent -1..1.

    ``paint`` returns the vertex colours from positions and normals (n, 3) in the field's frame.
    """
    vertices, faces = shaped(field, data, low, high, step, count)
    colours = paint(vertices, point_normals(vertices, faces), paint_data)
    lowest, highest = vertices.min(axis=0), vertices.max(axis=0)
    vertices = (vertices - (lowest + highest) / 2) / ((highest - lowest).max() / 2)
    return vertices.astype(np.float32), faces, colours
