"""Triangle meshes as arrays (Mesh_tool in 2006): building, reading PLY files, drawing."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from landscape.errors import InputError
from landscape.gl.calls import gl
from landscape.gl.state import client_arrays


@dataclass(frozen=True)
class Mesh:
    """Vertices (n, 3) and normals (n, 3) float32, triangles (m, 3) uint32, one (n, 2) per unit."""

    vertices: np.ndarray
    normals: np.ndarray
    triangles: np.ndarray
    coordinates: tuple[np.ndarray, ...] = ()

    def draw(self) -> None:
        """Send the mesh with one glDrawElements."""
        with client_arrays(self.vertices, self.normals, coordinates=self.coordinates):
            gl.glDrawElements(
                gl.GL_TRIANGLES, self.triangles.size, gl.GL_UNSIGNED_INT, self.triangles
            )


def grid_triangles(columns: int, rows: int) -> np.ndarray:
    """Return the two triangles of each cell of a grid of vertices, uint32 (m, 3).

    Vertex number is column + row * columns; with columns along x and rows along z the triangles
    are counter-clockwise seen from above. The diagonal runs from (0, 0) to (1, 1) of each cell.
    """
    c, r = np.meshgrid(np.arange(columns - 1), np.arange(rows - 1))
    corner = (c + r * columns).ravel()
    right, below, across = corner + 1, corner + columns, corner + columns + 1
    two = np.stack([corner, below, across, corner, across, right], axis=1)
    return np.ascontiguousarray(two.reshape(-1, 3), np.uint32)


def vertex_normals(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Return unit normals, float32 (n, 3): each the sum of its triangles' area vectors.

    A vertex that no triangle uses gets (0, 1, 0).
    """
    a, b, c = (vertices[triangles[:, k]].astype(np.float64) for k in range(3))
    area = np.cross(b - a, c - a)
    corners = triangles.T.ravel()
    summed = [np.bincount(corners, np.tile(area[:, k], 3), len(vertices)) for k in range(3)]
    normals = np.stack(summed, axis=1)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    unit = np.where(length > 0, normals / np.where(length > 0, length, 1.0), (0.0, 1.0, 0.0))
    return np.ascontiguousarray(unit, np.float32)


def revolve(
    profile: Sequence[tuple[float, float]], sides: int, repeat: tuple[float, float]
) -> Mesh:
    """Return the surface a profile of (radius, height) points sweeps about the y axis.

    x = r cos v, y = h, z = r sin v, as the truncated cone of section 6; texture coordinates run
    ``repeat`` times round and along. Each segment of the profile has vertices of its own, so that
    edges between segments stay sharp.
    """
    angle = np.linspace(0.0, 2.0 * np.pi, sides + 1)
    points = np.array(profile, np.float64)
    lengths = np.hypot(*np.diff(points, axis=0).T)
    along = np.concatenate([[0.0], np.cumsum(lengths)]) / lengths.sum()
    vertices: list[np.ndarray] = []
    coordinates: list[np.ndarray] = []
    for k in range(len(points) - 1):
        for end in (k + 1, k):
            radius, y = points[end]
            ring = [radius * np.cos(angle), np.full_like(angle, y), radius * np.sin(angle)]
            vertices.append(np.stack(ring, axis=1))
            s = angle / (2 * np.pi) * repeat[0]
            t = np.full_like(s, (1 - along[end]) * repeat[1])
            coordinates.append(np.stack([s, t], axis=1))
    band = grid_triangles(sides + 1, 2)[:, ::-1]
    v = np.ascontiguousarray(np.concatenate(vertices), np.float32)
    starts = np.arange(len(points) - 1)[:, None, None] * 2 * (sides + 1)
    t = np.ascontiguousarray((band + starts).reshape(-1, 3), np.uint32)
    n = vertex_normals(v, t)
    for ring_start in range(0, len(v), sides + 1):
        # First and last vertex of a ring are one point: without this the seam shows in the light.
        last = ring_start + sides
        mean = n[ring_start] + n[last]
        n[ring_start] = n[last] = mean / np.linalg.norm(mean)
    return Mesh(v, n, t, (np.ascontiguousarray(np.concatenate(coordinates), np.float32),))


PLY_TYPES = {
    "char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4",
    "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4",
    "float": "f4", "double": "f8", "float32": "f4", "float64": "f8",
}  # fmt: skip
BYTE_ORDERS = {"ascii": "=", "binary_little_endian": "<", "binary_big_endian": ">"}


def read_ply(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Read a PLY file: vertices float32 (n, 3) in the file's order, and triangles uint32 (m, 3).

    ASCII or binary of either byte order; polygons are cut into triangles, properties other than
    places and corners left aside. InputError names a file that is missing, truncated, not a PLY, or
    has no faces, wrong indices or NaN.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror})") from None
    if not data.startswith(b"ply"):
        raise InputError(f"{path}: expected a PLY file, whose first line is 'ply'")
    try:
        with np.errstate(over="ignore", invalid="ignore"):
            vertices, triangles = _parse_ply(data)
    except (ValueError, OverflowError) as error:
        raise InputError(f"{path}: expected a whole PLY mesh ({error})") from None
    if len(triangles) == 0:
        raise InputError(f"{path}: expected a mesh with faces, found none")
    if not np.isfinite(vertices).all():
        raise InputError(f"{path}: expected finite coordinates, found NaN or infinity")
    if triangles.min() < 0 or triangles.max() >= len(vertices):
        raise InputError(f"{path}: a face names a vertex that does not exist")
    return vertices, np.ascontiguousarray(triangles, np.uint32)


@dataclass(frozen=True)
class _Element:
    """A PLY element: its number of rows; each property's name, type and, of a list, count's type.

    Types are numpy's, as in "<f4".
    """

    name: str
    rows: int
    properties: list[tuple[str, str, str | None]]


def _parse_ply(data: bytes) -> tuple[np.ndarray, np.ndarray]:
    """Return vertices float32 (n, 3) and triangles int64 (m, 3); ValueError says what is wrong."""
    end = re.search(rb"[\r\n]end_header[ \t]*(\r\n|\n|\r|$)", data)
    if end is None:
        raise ValueError("its header does not end")
    header = [line.split() for line in data[: end.start()].decode("latin-1").splitlines()]
    body = data[end.end() :]
    if ["format", "ascii", "1.0"] in header:
        # The numbers of a text become doubles, and are then read as those of a binary file.
        body = np.fromiter(map(float, body.split()), np.float64).tobytes()
    vertices, triangles = np.empty((0, 3)), np.empty((0, 3))
    at = 0
    for element in _elements(header):
        columns, at = _columns(body, at, element)
        if element.name == "vertex":
            if not {"x", "y", "z"} <= columns.keys():
                raise ValueError("its vertices lack x, y or z")
            vertices = np.stack([columns[axis] for axis in "xyz"], axis=1)
        elif element.name == "face":
            lists = [name for name, _, counter in element.properties if counter is not None]
            known = [name for name in lists if name in ("vertex_indices", "vertex_index")]
            if len(known or lists) != 1:
                raise ValueError("its faces have no list named vertex_indices")
            triangles = _fans(columns[(known or lists)[0]])
    return np.ascontiguousarray(vertices, np.float32), triangles.astype(np.int64)


def _elements(header: list[list[str]]) -> list[_Element]:
    """Read the words of a PLY header."""
    form = next((words[1:] for words in header if words[:1] == ["format"]), [])
    if form not in ([name, "1.0"] for name in BYTE_ORDERS):
        raise ValueError(f"its format is {' '.join(form)[:60]!r}")
    text, order = form[0] == "ascii", BYTE_ORDERS[form[0]]
    types = {name: "=f8" if text else order + kind for name, kind in PLY_TYPES.items()}
    elements: list[_Element] = []
    for words in header:
        match words:
            case ["element", name, rows] if rows.isascii() and rows.isdigit() and len(rows) < 19:
                elements.append(_Element(name, int(rows), []))
            case ["property", "list", a, b, name] if elements and {a, b} <= types.keys():
                elements[-1].properties.append((name, types[b], types[a]))
            case ["property", kind, name] if elements and kind in types:
                elements[-1].properties.append((name, types[kind], None))
            case ["element" | "property", *_]:
                raise ValueError(f"its header has {' '.join(words)[:60]!r}")
    return elements


def _columns(body: bytes, at: int, element: _Element) -> tuple[dict[str, Any], int]:
    """Return an element's properties, arrays (rows,) or (rows, k), and where its rows end.

    A list property whose rows differ in length gives a list of arrays.
    """
    cut = ValueError(f"truncated: the header promises {element.rows} rows of {element.name}")

    def number(counter: str, at: int) -> int:
        if at + int(counter[-1]) > len(body):
            raise cut
        count = int(np.frombuffer(body, counter, 1, at)[0])
        if not 0 <= count <= len(body):
            raise ValueError(f"a list of {count} numbers among the rows of {element.name}")
        return count

    if element.rows == 0:
        return {name: np.empty((0,)) for name, _, _ in element.properties}, at
    # Most files have rows all of one length: the first one's.
    fields: list[Any] = []
    end = at
    for name, kind, counter in element.properties:
        shape: tuple[int, ...] = ()
        if counter is not None:
            shape = (number(counter, end),)
            fields.append((f"{name}#", counter))
        fields.append((name, kind, shape))
        end = at + np.dtype(fields).itemsize
    row = np.dtype(fields)
    end = at + element.rows * row.itemsize
    counted = [(name, row[name].shape[0]) for name, _, c in element.properties if c is not None]
    if end <= len(body):
        rows = np.frombuffer(body, row, element.rows, at)
        if all((rows[f"{name}#"] == length).all() for name, length in counted):
            return {name: rows[name] for name, _, _ in element.properties}, end
    if not counted:
        raise cut
    columns: dict[str, Any] = {name: [] for name, _, _ in element.properties}
    for _ in range(element.rows):
        for name, kind, counter in element.properties:
            length = 1
            if counter is not None:
                length = number(counter, at)
                at += int(counter[-1])
            end = at + length * int(kind[-1])
            if end > len(body):
                raise cut
            columns[name].append(np.frombuffer(body[at:end], kind))
            at = end
    scalars = {name for name, _, counter in element.properties if counter is None}
    return {k: np.concatenate(v) if k in scalars else v for k, v in columns.items()}, at


def _fans(polygons: np.ndarray | list[np.ndarray]) -> np.ndarray:
    """Cut polygons, (m, k) or m arrays of their own lengths, into triangles (n, 3)."""
    groups = [polygons]
    if isinstance(polygons, list):
        lengths = sorted({len(polygon) for polygon in polygons})
        groups = [np.stack([p for p in polygons if len(p) == n]) for n in lengths]
    fans = [
        group[:, [0, k, k + 1]]
        for group in groups
        if isinstance(group, np.ndarray) and group.ndim == 2
        for k in range(1, group.shape[1] - 1)
    ]
    return np.concatenate(fans) if fans else np.empty((0, 3))


def centred(vertices: np.ndarray) -> np.ndarray:
    """Move and scale vertices (n, 3) so that they fill -1..1 along their largest side."""
    low, high = (end(axis=0).astype(np.float64) for end in (vertices.min, vertices.max))
    half = float((high - low).max()) / 2 or 1.0
    return np.ascontiguousarray((vertices - (low + high) / 2) / half, np.float32)
