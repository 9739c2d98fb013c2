"""Reading meshes: PLY by our own reader, other formats by trimesh. No OpenGL here.

The report's Mesh_tool has its own PLY reader, and so does this program. Besides, trimesh accepts
truncated ASCII files, refuses some files that Blender writes, and takes longer to import.
"""

import re
from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from framelens.base.errors import InputError, reason
from framelens.base.input import check_plain, read_bounded
from landscape.files.cache import content, recall
from landscape.files.other_meshes import MOST_TRIANGLES, MOST_VERTICES, read_by_trimesh

PLY_TYPES = {
    "char": "i1",
    "uchar": "u1",
    "short": "i2",
    "ushort": "u2",
    "int": "i4",
    "uint": "u4",
    "int8": "i1",
    "uint8": "u1",
    "int16": "i2",
    "uint16": "u2",
    "int32": "i4",
    "uint32": "u4",
    "float": "f4",
    "double": "f8",
    "float32": "f4",
    "float64": "f8",
}
BYTE_ORDERS = {"ascii": "=", "binary_little_endian": "<", "binary_big_endian": ">"}
COLOURS = ("red", "green", "blue")
MOST_BYTES = 128 << 20  # chosen: three times the largest dragon of Stanford, as text
LONGEST_HEADER = 1 << 16  # bytes, chosen
OTHER_FORMATS = (".obj", ".stl", ".off", ".glb")


def read_mesh(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Read a mesh file by its extension: vertices float32 (n, 3) and triangles uint32 (m, 3).

    .ply by :func:`read_ply`; .obj, .stl, .off and .glb by trimesh. InputError names the file.
    """
    if path.suffix.lower() not in OTHER_FORMATS:
        return read_ply(path)
    _check_file(path)
    # From the cache, because trimesh takes a second to start.
    ending = path.suffix.lower()
    vertices, triangles = recall(("mesh", content(path), ending), lambda: read_by_trimesh(path))
    return checked(path, vertices, triangles)


def _check_file(path: Path) -> None:
    """Raise InputError for what is no plain file, or too large."""
    try:
        check_plain(path, MOST_BYTES)
    except OSError as error:
        raise InputError(
            "{path}: cannot be read ({reason})", path=path, reason=reason(error)
        ) from None


def checked(
    path: Path, vertices: np.ndarray, triangles: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the mesh, triangles as uint32; InputError if it has no faces, NaN or wrong indices."""
    if len(triangles) == 0:
        raise InputError("{path}: expected a mesh with faces, found none", path=path)
    if not np.isfinite(vertices).all():
        raise InputError("{path}: expected finite coordinates, found NaN or infinity", path=path)
    if triangles.min() < 0 or triangles.max() >= len(vertices):
        raise InputError("{path}: a face names a vertex that does not exist", path=path)
    return vertices, np.ascontiguousarray(triangles, np.uint32)


def read_ply(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Read a PLY file: vertices float32 (n, 3) in the file's order, and triangles uint32 (m, 3).

    ASCII or binary of either byte order; polygons are cut into triangles, and properties other than
    positions and indices are ignored. InputError names a file that is missing, truncated, not a
    PLY, or has no faces, wrong indices or NaN.
    """
    found = _read_ply(path)
    return checked(path, found.vertices, found.triangles)


def read_colours(path: Path) -> np.ndarray | None:
    """Return the colours of a mesh's vertices, uint8 (n, 3), if it is a PLY that has any.

    InputError as :func:`read_ply`.
    """
    return None if path.suffix.lower() in OTHER_FORMATS else _read_ply(path).colours


class Ply(NamedTuple):
    """A PLY file: vertices float32 (n, 3), triangles int64 (m, 3), and if it has them colours.

    ``colours`` are uint8 (n, 3), ``coordinates`` are its s and t, float32 (n, 2).
    """

    vertices: np.ndarray
    triangles: np.ndarray
    colours: np.ndarray | None
    coordinates: np.ndarray | None


def read_textured(path: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return vertices and triangles of a PLY file, as :func:`read_ply`, and its vertices' looks.

    These are colours, uint8 (n, 3), and texture coordinates s and t, float32 (n, 2). InputError as
    :func:`read_ply`, and if the file has none.
    """
    found = read_looks(path)
    if found is None:
        raise InputError("{path}: expected a PLY mesh with red, green, blue, s and t", path=path)
    return found


def read_looks(path: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray] | None:
    """Return the same as :func:`read_textured`; None if the file has no such looks."""
    if path.suffix.lower() in OTHER_FORMATS:
        return None
    found = _read_ply(path)
    if found.colours is None or found.coordinates is None:
        return None
    return *checked(path, found.vertices, found.triangles), found.colours, found.coordinates


def _read_ply(path: Path) -> Ply:
    """Return a file's arrays; InputError where the file is not a complete PLY."""
    _check_file(path)
    data = read_bounded(path, MOST_BYTES)
    try:
        return parse_ply(data)
    except ValueError as error:
        raise InputError(
            "{path}: expected a whole PLY mesh ({error})", path=path, error=error
        ) from None


@dataclass(frozen=True)
class _Element:
    """A PLY element: its number of rows, and the name, type and count type of each property.

    Only a list has a count, with its own type. Types are numpy's, as in "<f4".
    """

    name: str
    rows: int
    properties: list[tuple[str, str, str | None]]


def parse_ply(data: bytes) -> Ply:
    """Return the arrays of a PLY file.

    ValueError says what is wrong; whether indices and coordinates make sense is not checked.
    """
    if not data.startswith(b"ply"):
        raise ValueError("its first line is not 'ply'")
    try:
        with np.errstate(over="ignore", invalid="ignore"):
            return _parse_ply(data)
    except OverflowError as error:
        raise ValueError(str(error)) from None


def _vertices(
    columns: Mapping[str, np.ndarray],
) -> tuple[np.ndarray, np.ndarray | None, np.ndarray | None]:
    """Return the places of vertices, and their colours and texture coordinates if they have any."""
    if not {"x", "y", "z"} <= columns.keys():
        raise ValueError("its vertices lack x, y or z")
    colours = coordinates = None
    if set(COLOURS) <= columns.keys():
        stacked = np.stack([columns[name] for name in COLOURS], axis=1)
        colours = np.clip(np.nan_to_num(stacked), 0, 255).astype(np.uint8)
    if {"s", "t"} <= columns.keys():
        stacked = np.stack([columns[name] for name in "st"], axis=1)
        coordinates = np.nan_to_num(stacked).astype(np.float32)
    return np.stack([columns[axis] for axis in "xyz"], axis=1), colours, coordinates


def _triangles(
    columns: Mapping[str, np.ndarray | list[np.ndarray]], element: _Element
) -> np.ndarray:
    """Return the triangles of the faces, which are a list of vertices each."""
    lists = [name for name, _, counter in element.properties if counter is not None]
    known = [name for name in lists if name in ("vertex_indices", "vertex_index")]
    if len(known or lists) != 1:
        raise ValueError("its faces have no list named vertex_indices")
    return _fans(columns[(known or lists)[0]])


def _parse_ply(data: bytes) -> Ply:
    end = re.search(rb"[\r\n]end_header[ \t]*(\r\n|\n|\r|$)", data[:LONGEST_HEADER])
    if end is None:
        raise ValueError("its header does not end")
    header = [line.split() for line in data[: end.start()].decode("latin-1").splitlines()]
    body = memoryview(data)[end.end() :]
    if ["format", "ascii", "1.0"] in header:
        # ASCII numbers become doubles, which are then read like those of a binary file.
        body = _doubles(data, end.end()).view(np.uint8).data
    vertices, triangles = np.empty((0, 3)), np.empty((0, 3))
    colours = coordinates = None
    at = 0
    for element in _elements(header):
        columns, at = _columns(body, at, element)
        if element.name == "vertex":
            vertices, colours, coordinates = _vertices(columns)
        elif element.name == "face":
            triangles = _triangles(columns, element)

    places = np.ascontiguousarray(vertices, np.float32)
    return Ply(places, triangles.astype(np.int64), colours, coordinates)


def _doubles(text: bytes, at: int) -> np.ndarray:
    """Return the numbers in a text from an offset on, float64 (n,), a megabyte of text at a time.

    As Python's objects all at once they would take several times the memory.
    """
    parts = [np.empty(0)]
    space = re.compile(rb"\s|$")
    while at < len(text):
        end = space.search(text, at + (1 << 20))
        last = end.start() if end else len(text)
        parts.append(np.fromiter(map(float, text[at:last].split()), np.float64))
        at = last + 1
    return np.concatenate(parts)


def _elements(header: list[list[str]]) -> list[_Element]:
    """Parse the words of a PLY header."""
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


def _columns(body: memoryview, at: int, element: _Element) -> tuple[dict[str, Any], int]:
    """Return an element's properties, arrays (rows,) or (rows, k), and the offset of its end.

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

    if element.rows > len(body):
        raise cut
    if element.rows > MOST_VERTICES:
        raise ValueError(f"{element.rows} rows of {element.name}, expected at most {MOST_VERTICES}")
    if element.rows == 0:
        return {name: np.empty((0,)) for name, _, _ in element.properties}, at
    # In most files all rows have the length of the first one.
    fields: list[object] = []
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
    if element.rows * len(element.properties) > 4 * MOST_VERTICES:
        raise ValueError(f"more than {4 * MOST_VERTICES} numbers and lists of {element.name}")
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
    """Cut polygons, (m, k) or m arrays of different lengths, into triangles (n, 3).

    ValueError if they are more than MOST_TRIANGLES.
    """
    if isinstance(polygons, list):
        alike = defaultdict(list)
        for polygon in polygons:
            alike[len(polygon)].append(polygon)
        groups = [np.stack(alike[length]) for length in sorted(alike)]
    else:
        groups = [polygons] if polygons.ndim == 2 else []

    total = sum(len(group) * max(group.shape[1] - 2, 0) for group in groups)
    if total > MOST_TRIANGLES:
        raise ValueError(f"its faces make {total} triangles, expected at most {MOST_TRIANGLES}")

    # The first triangle of every polygon of a group, then the second of every one, and so on.
    fans = [
        np.stack(np.broadcast_arrays(group[:, :1], group[:, 1:-1], group[:, 2:]), axis=2)
        for group in groups
        if group.shape[1] > 2
    ]
    rows = [fan.transpose(1, 0, 2).reshape(-1, 3) for fan in fans]
    return np.concatenate(rows) if rows else np.empty((0, 3))
