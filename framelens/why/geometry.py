"""The vertices of a draw, taken from its calls, and where the matrices put them: numpy alone.

First :func:`vertices` collects what the draw sends: positions, colours, texture coordinates,
normals. Then :func:`placed` transforms them as OpenGL does, and counts for each plane of the view
volume how many vertices, and how many whole primitives, lie beyond it. :func:`flaws` looks at the
shape itself: corners that cross, concave polygons, faces wound against their neighbours.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from framelens.gl.named import gl_constant
from framelens.gl.seam import Call, gl
from framelens.tape.primitives import Draw

MODES = (
    *("GL_POINTS", "GL_LINES", "GL_LINE_LOOP", "GL_LINE_STRIP", "GL_TRIANGLES"),
    *("GL_TRIANGLE_STRIP", "GL_TRIANGLE_FAN", "GL_QUADS", "GL_QUAD_STRIP", "GL_POLYGON"),
)
LEAST = {
    **{"GL_POINTS": 1, "GL_LINES": 2, "GL_LINE_LOOP": 2, "GL_LINE_STRIP": 2, "GL_TRIANGLES": 3},
    **{"GL_TRIANGLE_STRIP": 3, "GL_TRIANGLE_FAN": 3, "GL_QUADS": 4, "GL_QUAD_STRIP": 4},
    "GL_POLYGON": 3,
}
PLANES = ("left", "right", "below", "above", "near", "far")
TYPES = {
    0x1400: np.int8,
    0x1401: np.uint8,
    0x1402: np.int16,
    0x1403: np.uint16,
    0x1404: np.int32,
    0x1405: np.uint32,
    0x1406: np.float32,
    0x140A: np.float64,
}
UNIT0 = 0x84C0  # GL_TEXTURE0
MOST = 200_000  # vertices of a draw that are looked at; chosen


@dataclass
class Vertices:
    """The vertices of a draw: ``positions`` float64 (n, 4), and faces as lists of their indices.

    ``colors``, ``coords`` and ``normals`` are the calls' own numbers, of those vertices for which
    one was given inside the draw; ``places`` are the vertices' calls.
    """

    mode: str
    positions: np.ndarray
    faces: list[list[int]]
    colors: list[tuple[float, ...]] = field(default_factory=list)
    color_calls: list[tuple[str, Call]] = field(default_factory=list)
    coords: np.ndarray | None = None
    normals: np.ndarray | None = None
    places: list[str] = field(default_factory=list)


def components(call: Call) -> list[float]:
    """Return the numbers of a call such as glVertex3f or glVertex3fv."""
    found: list[float] = []
    for value in call.args:
        if isinstance(value, (int, float, np.generic)):
            found.append(float(value))
        else:
            found += [float(each) for each in np.ravel(np.asarray(value))]
    return found


def faces_of(mode: str, count: int) -> list[list[int]]:
    """Return the primitives of so many vertices, as lists of indices."""
    if mode == "GL_POINTS":
        return [[k] for k in range(count)]
    if mode in ("GL_LINES", "GL_TRIANGLES", "GL_QUADS"):
        size = LEAST[mode]
        return [list(range(k, k + size)) for k in range(0, count - size + 1, size)]
    if mode in ("GL_LINE_STRIP", "GL_LINE_LOOP"):
        found = [[k, k + 1] for k in range(count - 1)]
        return found + ([[count - 1, 0]] if mode == "GL_LINE_LOOP" and count > 2 else [])
    if mode == "GL_TRIANGLE_STRIP":
        return [[k + k % 2, k + 1 - k % 2, k + 2] for k in range(count - 2)]
    if mode == "GL_TRIANGLE_FAN":
        return [[0, k, k + 1] for k in range(1, count - 1)]
    if mode == "GL_QUAD_STRIP":
        return [[k, k + 1, k + 3, k + 2] for k in range(0, count - 3, 2)]
    return [list(range(count))] if count > 2 else []


def vertices(draw: Draw) -> Vertices | None:
    """Return what a draw sends, None where it cannot be told; OpenGL's arrays are read now."""
    call = draw.first.call
    try:
        if call.name == "glBegin":
            return _of_begin(draw)
        if call.name.startswith("glRect"):
            return _of_rect(call)
        if call.name in ("glDrawArrays", "glDrawElements", "glDrawRangeElements"):
            return _of_arrays(call)
        if call.name.startswith(("glutSolid", "glutWire")):
            return _of_shape(draw)
    except (ValueError, TypeError, IndexError, KeyError):
        return None
    return None


def _of_begin(draw: Draw) -> Vertices:
    mode = MODES[int(draw.first.call.args[0])]
    positions, places = [], []
    found = Vertices(mode, np.empty((0, 4)), [])
    coords: list[list[float]] = []
    normals: list[list[float]] = []
    coord: list[float] | None = None
    normal: list[float] | None = None
    for step in draw.steps[1:]:
        name = step.call.name
        if name.startswith("glVertex"):
            numbers = components(step.call)[:4]
            positions.append(numbers + [0.0, 0.0, 0.0, 1.0][len(numbers) :])
            places.append(step.place)
            if coord is not None:
                coords.append(coord)
            if normal is not None:
                normals.append(normal)
        elif name.startswith("glColor"):
            found.colors.append(tuple(components(step.call)))
            found.color_calls.append((step.place, step.call))
        elif name.startswith("glTexCoord"):
            coord = (components(step.call) + [0.0])[:2]
        elif name.startswith("glMultiTexCoord") and int(step.call.args[0]) == UNIT0:
            coord = (components(step.call)[1:] + [0.0])[:2]
        elif name.startswith("glNormal"):
            normal = components(step.call)[:3]

    found.positions = np.array(positions, np.float64).reshape(-1, 4)
    found.places = places
    found.faces = faces_of(mode, len(positions))
    found.coords = np.array(coords) if coords else None
    found.normals = np.array(normals) if normals else None
    return found


def _of_rect(call: Call) -> Vertices:
    x1, y1, x2, y2 = components(call)
    corners = [[x1, y1], [x2, y1], [x2, y2], [x1, y2]]
    positions = np.array([[x, y, 0.0, 1.0] for x, y in corners])
    return Vertices("GL_QUADS", positions, [[0, 1, 2, 3]])


def array_now(kind: str, call: Call, size: int) -> np.ndarray | None:
    """Return what a client array holds for a draw, float64 (n, size): from memory or a buffer."""
    if not gl.glIsEnabled(gl_constant(f"GL_{kind}_ARRAY")):
        return None
    pointer = next((args for name, args in call.arrays if name == POINTERS[kind]), None)
    components_ = int(gl.glGetIntegerv(gl_constant(f"GL_{kind}_ARRAY_SIZE"))) if size != 3 else 3
    if kind == "VERTEX":
        components_ = int(gl.glGetIntegerv(gl.GL_VERTEX_ARRAY_SIZE))
    if pointer is not None:
        array = np.asarray(pointer[-1], np.float64)
        return array.reshape(-1, array.shape[-1] if array.ndim > 1 else components_)
    buffer = int(gl.glGetIntegerv(gl_constant(f"GL_{kind}_ARRAY_BUFFER_BINDING")))
    if not buffer:
        return None
    kind_type = int(gl.glGetIntegerv(gl_constant(f"GL_{kind}_ARRAY_TYPE")))
    stride = int(gl.glGetIntegerv(gl_constant(f"GL_{kind}_ARRAY_STRIDE")))
    offset = int(gl.glGetPointerv(gl_constant(f"GL_{kind}_ARRAY_POINTER")) or 0)
    return _strided(buffer, TYPES[kind_type], components_, stride, offset)


POINTERS = {
    "VERTEX": "glVertexPointer",
    "NORMAL": "glNormalPointer",
    "COLOR": "glColorPointer",
    "TEXTURE_COORD": "glTexCoordPointer",
}


def buffer_bytes(buffer: int) -> bytes:
    """Return what a buffer object holds."""
    former = int(gl.glGetIntegerv(gl.GL_ARRAY_BUFFER_BINDING))
    gl.glBindBuffer(gl.GL_ARRAY_BUFFER, buffer)
    try:
        size = int(gl.glGetBufferParameteriv(gl.GL_ARRAY_BUFFER, gl.GL_BUFFER_SIZE))
        data = gl.glGetBufferSubData(gl.GL_ARRAY_BUFFER, 0, size)
        return bytes(np.asarray(data, np.uint8))
    finally:
        gl.glBindBuffer(gl.GL_ARRAY_BUFFER, former)


def _strided(buffer: int, kind: Any, size: int, stride: int, offset: int) -> np.ndarray:
    data = buffer_bytes(buffer)
    item = np.dtype(kind).itemsize * size
    stride = stride or item
    count = max((len(data) - offset - item) // stride + 1, 0)
    rows = np.lib.stride_tricks.as_strided(
        np.frombuffer(data, np.uint8, offset=min(offset, len(data))), (count, item), (stride, 1)
    )
    return np.ascontiguousarray(rows).view(kind).astype(np.float64).reshape(count, size)


def _of_arrays(call: Call) -> Vertices | None:
    array = array_now("VERTEX", call, 0)
    mode = MODES[int(call.args[0])]
    if array is None:
        return Vertices(mode, np.empty((0, 4)), [])
    if call.name == "glDrawArrays":
        first, count = int(call.args[1]), int(call.args[2])
        order = np.arange(first, min(first + count, len(array)))
    else:
        kind, indices = int(call.args[-2]), call.args[-1]
        count = int(call.args[-3])
        if isinstance(indices, np.ndarray):
            order = np.ascontiguousarray(indices).reshape(-1).view(TYPES[kind])[:count]
        else:
            buffer = int(gl.glGetIntegerv(gl.GL_ELEMENT_ARRAY_BUFFER_BINDING))
            offset = int(getattr(indices, "value", indices) or 0)
            whole = np.frombuffer(buffer_bytes(buffer), TYPES[kind], offset=offset)
            order = whole[:count]
        order = order[order < len(array)].astype(np.int64)

    order = order[:MOST]
    positions = np.zeros((len(order), 4))
    positions[:, 3] = 1.0
    width = min(array.shape[1], 4)
    positions[:, :width] = array[order][:, :width]
    found = Vertices(mode, positions, faces_of(mode, len(positions)))
    coords = array_now("TEXTURE_COORD", call, 2)
    if coords is not None and len(coords) > (order.max() if len(order) else 0):
        found.coords = coords[order][:, :2]
    normals = array_now("NORMAL", call, 3)
    if normals is not None and len(normals) > (order.max() if len(order) else 0):
        found.normals = normals[order]
    return found


RADIUS = 64.0  # in which the shapes of GLUT are sought, in their own units; chosen


@contextmanager
def _all_in_view() -> Iterator[None]:
    """Have the view's volume reach to RADIUS on all sides of the object, within the block."""
    gl.glPushAttrib(gl.GL_ALL_ATTRIB_BITS & ~gl.GL_CURRENT_BIT)
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glPushMatrix()
    gl.glLoadIdentity()
    gl.glOrtho(-RADIUS, RADIUS, -RADIUS, RADIUS, -RADIUS, RADIUS)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glPushMatrix()
    gl.glLoadIdentity()

    gl.glViewport(0, 0, 1024, 1024)
    gl.glDepthRange(0.0, 1.0)
    for name in ("CULL_FACE", "LIGHTING", "FOG"):
        gl.glDisable(gl_constant(f"GL_{name}"))
    try:
        yield
    finally:
        gl.glMatrixMode(gl.GL_MODELVIEW)
        gl.glPopMatrix()
        gl.glMatrixMode(gl.GL_PROJECTION)
        gl.glPopMatrix()
        gl.glPopAttrib()


def _of_shape(draw: Draw) -> Vertices | None:
    """Return the vertices of a shape that a library draws, by OpenGL's feedback."""
    size = 400_000
    with _all_in_view():
        buffer = np.zeros(size, np.float32)
        gl.glFeedbackBuffer(size, gl.GL_3D, buffer)
        gl.glRenderMode(gl.GL_FEEDBACK)
        draw.issue()
        result = gl.glRenderMode(gl.GL_RENDER)

    points: list[tuple[float, ...]] = []
    faces: list[list[int]] = []
    for corners in _primitives(result):
        faces.append(list(range(len(points), len(points) + len(corners))))
        points += corners
    if not points:
        return None
    window = np.array(points, np.float64)
    positions = np.ones((len(window), 4))
    positions[:, :2] = (window[:, :2] / 1024.0 * 2.0 - 1.0) * RADIUS
    positions[:, 2] = -(window[:, 2] * 2.0 - 1.0) * RADIUS
    mode = "GL_LINES" if len(faces[0]) == 2 else "GL_POLYGON"
    return Vertices(mode, positions, faces)


def _primitives(result: Any) -> Iterator[list[tuple[float, ...]]]:
    """Yield the corners of each primitive that the feedback has."""
    for each in result:
        parts = each if isinstance(each, (tuple, list)) else (each,)
        corners = [tuple(part.vertex) for part in parts[1:] if hasattr(part, "vertex")]
        if corners:
            yield corners


@dataclass(frozen=True)
class Placed:
    """Where a draw's vertices are: ``eye`` and ``clip`` coordinates, float64 (n, 4).

    ``beyond`` counts for each plane the vertices outside it, ``whole`` the primitives that lie
    outside it altogether; ``behind`` are the vertices behind the plane of the eye.
    """

    eye: np.ndarray
    clip: np.ndarray
    beyond: dict[str, int]
    whole: dict[str, int]
    behind: int
    count: int
    faces: int
    finite: bool

    @property
    def distances(self) -> tuple[float, float]:
        """The least and the greatest distance in front of the eye's plane."""
        z = -self.eye[:, 2] / np.where(self.eye[:, 3] == 0.0, 1.0, self.eye[:, 3])
        return float(z.min()), float(z.max())

    @property
    def outside(self) -> list[str]:
        """The planes that all primitives lie beyond, each of them beyond the same."""
        return [name for name in PLANES if self.faces and self.whole[name] == self.faces]


def _outside(clip: np.ndarray) -> dict[str, np.ndarray]:
    """Return for each plane of the view's volume which points, (n, 4), are beyond it."""
    x, y, z, w = clip.T
    return {
        "left": x < -w,
        "right": x > w,
        "below": y < -w,
        "above": y > w,
        "near": z < -w,
        "far": z > w,
    }


def placed(found: Vertices, modelview: ArrayLike, projection: ArrayLike) -> Placed:
    """Return where the matrices, 16 numbers each in OpenGL's order, put the vertices."""
    model = np.array(modelview, np.float64).reshape(4, 4)
    project = np.array(projection, np.float64).reshape(4, 4)
    with np.errstate(all="ignore"):
        eye = found.positions @ model
        clip = eye @ project
        out = _outside(clip)

    groups = _by_size(found.faces[:MOST_FACES])
    whole = {
        name: sum(int(flags[faces].all(axis=1).sum()) for faces in groups)
        for name, flags in out.items()
    }
    return Placed(
        eye,
        clip,
        {name: int(flags.sum()) for name, flags in out.items()},
        whole,
        int((eye[:, 2] > 0).sum()),
        len(eye),
        min(len(found.faces), MOST_FACES),
        bool(np.isfinite(clip).all()),
    )


MOST_FACES = 5000  # primitives of a draw that are looked at; chosen


def _by_size(faces: list[list[int]]) -> list[np.ndarray]:
    """Return faces as arrays of indices, (n, corners): one for each number of corners."""
    sizes: dict[int, list[list[int]]] = {}
    for face in faces:
        sizes.setdefault(len(face), []).append(face)
    return [np.array(alike) for alike in sizes.values()]


def crossed_faces(found: Vertices) -> list[int]:
    """Return the quads whose outline crosses itself: corners in the order of a bow tie."""
    if found.mode != "GL_QUADS":
        return []
    bad = []
    for index, face in enumerate(found.faces[:2000]):
        a, b, c, d = found.positions[face][:, :3]
        if _crosses(a, b, c, d) or _crosses(b, c, d, a):
            bad.append(index)
    return bad


def _crosses(a: np.ndarray, b: np.ndarray, c: np.ndarray, d: np.ndarray) -> bool:
    """Return whether the sides ab and cd of a flat quad cross."""
    u = b - a
    v = d - c
    w = c - a
    normal = np.cross(u, v)
    length = float(normal @ normal)
    scale = float((u @ u) * (v @ v))
    if scale == 0.0 or length < 1e-9 * scale or abs(float(w @ normal)) > 1e-3 * scale**0.75:
        return False
    s = float(np.cross(w, v) @ normal) / length
    t = float(np.cross(w, u) @ normal) / length
    return 0.02 < s < 0.98 and 0.02 < t < 0.98


def concave(found: Vertices) -> list[int]:
    """Return the polygons and quads that are not convex."""
    if found.mode not in ("GL_POLYGON", "GL_QUADS"):
        return []
    bad = []
    for index, face in enumerate(found.faces[:2000]):
        if found.mode == "GL_POLYGON" and len(face) < 4:
            continue
        points = _distinct(found.positions[face][:, :3])
        if len(points) < 4:
            continue
        sides = np.roll(points, -1, axis=0) - points
        turns = np.cross(sides, np.roll(sides, -1, axis=0))
        total = turns.sum(axis=0)
        length = float(np.linalg.norm(total))
        if length == 0.0:
            continue
        signed = turns @ (total / length)
        scale = float(np.abs(signed).max())
        if scale > 0.0 and (signed < -0.05 * scale).any():
            bad.append(index)

    return bad


def _distinct(points: np.ndarray) -> np.ndarray:
    keep = [k for k in range(len(points)) if np.abs(points[k] - points[k - 1]).max() > 1e-9]
    return points[keep]


def against_neighbours(found: Vertices) -> list[int]:
    """Return the faces that run along their edges in the same direction as their neighbours.

    In a closed surface that is wound in one way, two faces run along a shared edge in opposite
    directions. Faces that most of their neighbours contradict are returned.
    """
    if found.mode not in ("GL_QUADS", "GL_TRIANGLES", "GL_POLYGON") or len(found.faces) < 4:
        return []
    edges = _faces_along_edges(found)
    wrong: dict[int, int] = {}
    right: dict[int, int] = {}
    for (a, b), along in edges.items():
        for face_index in along:
            if len(along) > 1:
                wrong[face_index] = wrong.get(face_index, 0) + 1
            if (b, a) in edges:
                right[face_index] = right.get(face_index, 0) + 1

    bad = [face for face, count in wrong.items() if count > right.get(face, 0)]
    return bad if len(bad) * 2 < len(found.faces) else []


def _faces_along_edges(found: Vertices) -> dict[tuple[int, int], list[int]]:
    """Return the faces that run along each edge from one place to another; none if too many.

    Vertices at the same place are one.
    """
    keys: dict[tuple[float, ...], int] = {}
    ids = [
        keys.setdefault(tuple(np.round(point, 4).tolist()), len(keys))
        for point in found.positions[:MOST_EDGES]
    ]
    edges: dict[tuple[int, int], list[int]] = {}
    for index, face in enumerate(found.faces):
        if max(face) >= len(ids):
            return {}
        for a, b in zip(face, face[1:] + face[:1], strict=True):
            edges.setdefault((ids[a], ids[b]), []).append(index)
    return edges


MOST_EDGES = 20_000  # vertices that are looked at for shared edges; chosen
