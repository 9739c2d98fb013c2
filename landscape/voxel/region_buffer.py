"""One vertex buffer for all regions, and each region's share of it.

The document weighs one buffer for the whole scene against one a region, and takes the first: what
costs is the number of OpenGL calls, not of vertices. Here, too, a region is a share of the one
buffer, in which the vertices of a direction follow each other, and one glMultiDrawArrays
(OpenGL 1.4) sends those of all visible regions. The other choice is in region_buffers.py.
The document keeps the places of the vertices' parts in a vertex array object. That is no shader
(GL_ARB_vertex_array_object), and ``voxel.vertex_arrays`` asks for it: one call then takes the place
of the pointers.
Without buffers the vertices stay in the program's memory (vertex arrays, OpenGL 1.1), and without
glMultiDrawArrays there is a call for each region and direction; neither changes the picture.
State used: GL_ARRAY_BUFFER (OpenGL 1.5), the vertex arrays.
"""

import ctypes
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from framelens.gl.seam import gl
from landscape.gl.features import possible
from landscape.voxel.memory import give_back
from landscape.voxel.mesh import PLANTS, SETS, SHORE, TURNS, UP, VERTEX, WET, RegionMesh, at_corner
from landscape.voxel.packed_mesh import LARGE, PackedMesh, packed, unpacked

MARGIN = 1.25  # chosen: a share is this much larger than its mesh, for blocks to be placed
Y_OFFSET = 16  # bytes, of y within a vertex: two coordinates, a colour and x come before it
SPARE = 512  # vertices, chosen: and by at least this
# Vertices, chosen: in a LARGE buffer the share is larger only by this; a block takes up to 24.
LITTLE_SPARE = 128
RESERVE = 1 << 17  # vertices, chosen: room behind all shares, for those that become too small
AT_ONCE = 1 << 18  # vertices, chosen: so many are lit anew at a time
FINISHED = 64  # chosen: so many shares of a large world are uploaded at a time
MOST_SENT = 1 << 19  # vertices, chosen: so many of a large world are drawn at a time

# The sets of faces that are drawn, from one to another: all of them, those that are not wholly
# under water, and those that are not wholly above it.
Part = tuple[int, int]
ALL = (WET, SETS - 1)
ABOVE = (SHORE, SETS - 1)
UNDER = (WET, SHORE)


class Light(NamedTuple):
    """Another light than that in which meshes are made: of each direction, and of plants.

    Colours are multiplied by ``times`` (7, 3); ``alpha`` (7,), uint8, takes the place of theirs.
    Those of plants, and of faces that look up, are also multiplied by ``slope``, float32
    (n + 1, n + 1), at the corner of a column where they are.
    """

    times: np.ndarray
    alpha: np.ndarray
    slope: np.ndarray

    def on(self, colours: np.ndarray, turns: np.ndarray, position: np.ndarray) -> np.ndarray:
        """Return colours (n, 4), uint8, in this light; ``turns`` (n,) are as in TURNS.

        ``position`` (n, 3) is where they are, in blocks.
        """
        found = np.empty_like(colours)
        times = self.times[turns]
        level = np.flatnonzero((turns == UP) | (turns == PLANTS))
        x, z = np.rint(position[level][:, [0, 2]]).astype(np.intp).T
        times[level] *= at_corner(self.slope, x, z)[:, None]
        found[:, :3] = np.minimum(colours[:, :3] * times + np.float32(0.5), 255)
        found[:, 3] = self.alpha[turns]
        return found


class RegionBuffer:
    """Owner of the buffer.

    ``at`` (shares, 7, SETS + 1) says where the vertices of each set of each direction begin, and
    where those of the last set end.
    """

    def __init__(
        self, meshes: Sequence[RegionMesh | PackedMesh], vertex_arrays: bool = False
    ) -> None:
        """Upload meshes, each of which has a share of its own; :meth:`mesh` gives them back.

        ``vertex_arrays``: keep where a vertex's parts lie in vertex array objects, if OpenGL has
        them.
        """
        sizes = np.array([mesh.size for mesh in meshes])
        self._large = bool(sizes.sum() >= LARGE)
        margin, spare = (1.0, LITTLE_SPARE) if self._large else (MARGIN, SPARE)
        self.room = (np.maximum(sizes * margin, sizes + spare) // 4 * 4).astype(np.int64)
        self.start = np.cumsum(self.room) - self.room
        self.at = np.zeros((len(meshes), len(TURNS), SETS + 1), np.int32)
        self._free = int(self.room.sum())
        self._end = self._free + RESERVE
        self._multi_draw = possible("glMultiDrawArrays")

        # Their colours in the light that they were made in, once they are shown in another.
        self._made: np.ndarray | None = None
        self._light: Light | None = None
        self._arrays: dict[tuple[int, bool], int] | None = None  # names of vertex array objects

        # The vertices, where OpenGL does not keep them.
        self._kept = None if possible("vertex buffers") else np.zeros(self._end, VERTEX)
        if self._kept is None and vertex_arrays and possible("voxel.vertex_arrays"):
            self._arrays = {}
        self.name = 0
        self._make_buffers()
        for share, mesh in enumerate(meshes):
            self.replace(share, unpacked(mesh))
            if self._large and share % FINISHED == 0:
                gl.glFinish()  # Mesa keeps copies of what is still to be uploaded
                give_back()

    def _make_buffers(self) -> None:
        """Make the buffer, as large as all shares and the reserve."""
        if self._kept is None:
            self.name = new_buffer(self._end)

    def _enter(self, share: int, mesh: RegionMesh) -> None:
        """Note where the vertices of a share lie."""
        ends = self.start[share] + np.cumsum(mesh.counts).reshape(mesh.counts.shape)
        self.at[share, :, 0] = ends[:, 0] - mesh.counts[:, 0]
        self.at[share, :, 1:] = ends

    def mesh(self, share: int) -> RegionMesh:
        """Return a copy of a share's mesh."""
        counts = np.diff(self.at[share])
        begin, size = int(self.start[share]), int(counts.sum())
        vertices = self._read(begin, size)
        if self._made is not None:
            vertices["colour"] = self._made[begin:][:size]
        return RegionMesh(vertices, counts)

    def meshes(self) -> list[RegionMesh | PackedMesh]:
        """Return copies of all meshes, packed if they are those of a large world."""
        every = map(self.mesh, range(len(self.start)))
        return [packed(mesh) if self._large else mesh for mesh in every]

    def replace(self, share: int, mesh: RegionMesh) -> bool:
        """Replace a share's vertices; return False, changing nothing, if there is no room.

        Then the caller makes the whole buffer again. If only the share is too small, a
        larger one in the reserve takes its place.
        """
        size = len(mesh.vertices)
        if size > self.room[share]:
            room = 2 * size // 4 * 4
            if self._free + room > self._end:
                return False
            self.start[share], self.room[share] = self._free, room
            self._free += room
            self._moved(share)

        begin, vertices = int(self.start[share]), mesh.vertices
        if self._made is not None and self._light:
            self._made[begin:][:size] = vertices["colour"]
            turns = np.repeat(np.arange(len(TURNS)), mesh.counts.sum(axis=1))
            vertices = vertices.copy()
            vertices["colour"] = self._light.on(vertices["colour"], turns, vertices["position"])

        self._write(begin, vertices)
        self._enter(share, mesh)
        return True

    def _moved(self, share: int) -> None:
        """Do what is to be done when a share has another place, and more room: nothing."""

    def relight(self, light: Light) -> None:
        """Show all meshes in another light than they were made in, those that come later as well.

        What is read from the buffer, or replaced in it, is still in the light it was made in.
        """
        self._light = light
        first = self._made is None
        if self._made is None:
            self._made = np.zeros((self._end, 4), np.uint8)

        # Where each direction of each share begins, and so, up to the next, which one it is.
        starts = self.at[:, :, 0].ravel()
        order = np.argsort(starts, kind="stable")
        starts = starts[order]
        for begin in range(0, self._free, AT_ONCE):
            end = min(begin + AT_ONCE, self._free)
            one, last = np.searchsorted(starts, (begin, end), "right")
            edges = np.clip(starts[max(one - 1, 0) : last], begin, end)
            turns = np.repeat(
                order[max(one - 1, 0) : last] % len(TURNS), np.diff(edges, append=end)
            )
            vertices = self._read(begin, end - begin)
            made = self._made[begin:end]
            if first:
                made[:] = vertices["colour"]
            vertices["colour"] = light.on(made, turns, vertices["position"])
            self._write(begin, vertices)

    def _read(self, begin: int, size: int) -> np.ndarray:
        """Return a copy of vertices as they are shown."""
        if self._kept is not None:
            return self._kept[begin:][:size].copy()
        vertices = np.empty(size, VERTEX)
        if size:
            gl.glBindBuffer(gl.GL_ARRAY_BUFFER, self.name)
            data, place = as_bytes(vertices), begin * VERTEX.itemsize
            gl.glGetBufferSubData(gl.GL_ARRAY_BUFFER, place, data.nbytes, data)
            gl.glBindBuffer(gl.GL_ARRAY_BUFFER, 0)
        return vertices

    def _write(self, begin: int, vertices: np.ndarray) -> None:
        """Put vertices into the buffer."""
        if self._kept is not None:
            self._kept[begin:][: len(vertices)] = vertices
        elif len(vertices):
            gl.glBindBuffer(gl.GL_ARRAY_BUFFER, self.name)
            data, place = as_bytes(vertices), begin * VERTEX.itemsize
            gl.glBufferSubData(gl.GL_ARRAY_BUFFER, place, data.nbytes, data)
            gl.glBindBuffer(gl.GL_ARRAY_BUFFER, 0)

    @contextmanager
    def bound(self, fog_by_height: bool = False) -> Iterator[None]:
        """Let the block draw from the buffer; fog coordinates are heights in blocks if asked."""
        with self._arrays_restored():
            self._take(self.name, fog_by_height)
            yield

    @contextmanager
    def _arrays_restored(self) -> Iterator[None]:
        """Put the vertex arrays back after the block."""
        if self._arrays is not None:
            try:
                yield
            finally:
                gl.glBindVertexArray(0)
            return
        gl.glPushClientAttrib(gl.GL_CLIENT_VERTEX_ARRAY_BIT)
        try:
            yield
        finally:
            if self._kept is None:
                gl.glBindBuffer(gl.GL_ARRAY_BUFFER, 0)
            gl.glPopClientAttrib()

    def _take(self, name: int, fog_by_height: bool) -> None:
        """Let OpenGL take vertices from a buffer, by its vertex array object if there are such."""
        if self._arrays is None:
            self._point(name, fog_by_height)
            return
        key = name, fog_by_height
        if key in self._arrays:
            gl.glBindVertexArray(self._arrays[key])
            return
        self._arrays[key] = int(np.ravel(gl.glGenVertexArrays(1))[0])
        gl.glBindVertexArray(self._arrays[key])
        self._point(name, fog_by_height)
        gl.glBindBuffer(gl.GL_ARRAY_BUFFER, 0)

    def _point(self, name: int, fog_by_height: bool) -> None:
        """Say where the parts of a vertex lie in a buffer."""
        whole = 0 if self._kept is None else self._kept.ctypes.data
        if name:
            gl.glBindBuffer(gl.GL_ARRAY_BUFFER, name)
        gl.glInterleavedArrays(gl.GL_T2F_C4UB_V3F, 0, ctypes.c_void_p(whole))
        if fog_by_height:
            # The same vertices once more: a vertex's y as its fog coordinate.
            gl.glEnableClientState(gl.GL_FOG_COORD_ARRAY)
            place = ctypes.c_void_p(whole + Y_OFFSET)
            gl.glFogCoordPointer(gl.GL_FLOAT, VERTEX.itemsize, place)

    def draw(
        self,
        shares: np.ndarray,
        facing: np.ndarray,
        part: Part = ALL,
        last: np.ndarray | None = None,
    ) -> None:
        """Draw the faces of some shares, in their order, in the directions of ``facing``.

        ``facing`` (shares, 6) says for each of ``shares`` which directions may be seen. ``last``
        (shares,) is the last set of each that may be seen; -1 for none.
        """
        first, count = self._found(shares, slice(0, PLANTS), part, last)
        self._send(first, count, (count > 0) & facing)

    def plants(
        self, shares: np.ndarray, part: Part = ALL, last: np.ndarray | None = None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return where plants of these shares begin, and how many vertices they have."""
        first, count = self._found(shares, slice(PLANTS, PLANTS + 1), part, last)
        there = count > 0
        return first[there], count[there]

    def draw_plants(self, found: tuple[np.ndarray, np.ndarray]) -> None:
        """Draw what :meth:`plants` has found."""
        self._send(*found)

    def _found(
        self, shares: np.ndarray, turns: slice, part: Part, last: np.ndarray | None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return where the vertices begin that belong to a part, and how many they are.

        Both (shares, turns); there may be less than none.
        """
        first = self.at[:, turns, part[0]][shares]
        if last is None:
            return first, self.at[:, turns, part[1] + 1][shares] - first
        # A hill that hides dry land hides everything under water, too.
        first = np.where((last < part[1])[:, None], self.at[:, turns, SHORE][shares], first)
        each = np.arange(len(TURNS))[turns]
        return first, self.at[shares[:, None], each, (last + 1)[:, None]] - first

    def _send(self, first: np.ndarray, count: np.ndarray, wanted: np.ndarray | None = None) -> None:
        """Draw so many vertices from each of ``first`` on, those that are ``wanted``."""
        if wanted is not None:
            first, count = first[wanted], count[wanted]
        if not len(first):
            return
        ends = [0, len(first)]
        if self._large:
            ends[1:1] = (1 + np.flatnonzero(np.diff(np.cumsum(count) // MOST_SENT))).tolist()
        for one, end in pairwise(ends):
            if one:
                gl.glFinish()  # Mesa keeps up to 0.1 GB of what is still to be drawn
            self._send_at_once(first[one:end], count[one:end])

    def _send_at_once(self, first: np.ndarray, count: np.ndarray) -> None:
        """Draw so many vertices from each of ``first`` on."""
        if self._multi_draw:
            gl.glMultiDrawArrays(gl.GL_QUADS, first, count, len(first))
            return
        for begin, many in zip(first.tolist(), count.tolist(), strict=True):
            gl.glDrawArrays(gl.GL_QUADS, begin, many)

    def release(self) -> None:
        """Delete the buffer; may be called twice."""
        self._forget_arrays()
        if self.name:
            gl.glDeleteBuffers(1, np.array([self.name], np.uint32))
            self.name = 0

    def _forget_arrays(self) -> None:
        """Delete the vertex array objects, if there are any."""
        if self._arrays:
            gl.glDeleteVertexArrays(
                len(self._arrays), np.array([*self._arrays.values()], np.uint32)
            )
            self._arrays = {}


def new_buffer(size: int) -> int:
    """Return the name of a new buffer for so many vertices."""
    name = int(gl.glGenBuffers(1))
    gl.glBindBuffer(gl.GL_ARRAY_BUFFER, name)
    gl.glBufferData(gl.GL_ARRAY_BUFFER, size * VERTEX.itemsize, None, gl.GL_STATIC_DRAW)
    gl.glBindBuffer(gl.GL_ARRAY_BUFFER, 0)
    return name


def as_bytes(vertices: np.ndarray) -> np.ndarray:
    """Return vertices as the bytes they are: a trace cannot show an array of records."""
    return vertices.view(np.uint8)
