"""A vertex buffer for each region and level of detail: what the document weighs and does not take.

Where a share's vertices lie is counted as in the one buffer of region_buffer.py, from 0 to the end
of the last share; here each share is a buffer of its own, so that OpenGL is told from which one to
take vertices for each region that is drawn. What that costs is in docs/voxels.md.
State used: GL_ARRAY_BUFFER (OpenGL 1.5), the vertex arrays.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise

import numpy as np

from framelens.gl.seam import gl
from landscape.voxel.mesh import VERTEX
from landscape.voxel.region_buffer import RegionBuffer, as_bytes, new_buffer


class RegionBuffers(RegionBuffer):
    """Owner of the buffers; without OpenGL's buffers it is like a :class:`RegionBuffer`."""

    def _make_buffers(self) -> None:
        """Make a buffer for each share, with room for blocks to be placed."""
        self._fog_by_height = False
        self.names: list[int] = []
        if self._kept is None:
            self.names = [new_buffer(max(int(room), 1)) for room in self.room]

    def _moved(self, share: int) -> None:
        """Make a larger buffer for a share."""
        if self.names:
            self._forget_arrays()  # they refer to the former one
            self._delete([self.names[share]])
            self.names[share] = new_buffer(int(self.room[share]))

    def _shares(self, begin: int, size: int) -> Iterator[tuple[int, int, int]]:
        """Yield the shares in which vertices lie, with the first and the end of those in each."""
        ends = self.start + self.room
        for share in np.flatnonzero((self.start < begin + size) & (ends > begin)).tolist():
            yield share, max(begin, int(self.start[share])), min(begin + size, int(ends[share]))

    def _read(self, begin: int, size: int) -> np.ndarray:
        """Return a copy of vertices as they are shown."""
        if not self.names:
            return super()._read(begin, size)
        vertices = np.zeros(size, VERTEX)
        for share, first, end in self._shares(begin, size):
            part = vertices[first - begin : end - begin]
            gl.glBindBuffer(gl.GL_ARRAY_BUFFER, self.names[share])
            data, place = as_bytes(part), (first - int(self.start[share])) * VERTEX.itemsize
            gl.glGetBufferSubData(gl.GL_ARRAY_BUFFER, place, data.nbytes, data)
        gl.glBindBuffer(gl.GL_ARRAY_BUFFER, 0)
        return vertices

    def _write(self, begin: int, vertices: np.ndarray) -> None:
        """Put vertices into the buffers."""
        if not self.names:
            super()._write(begin, vertices)
            return
        for share, first, end in self._shares(begin, len(vertices)):
            data = as_bytes(vertices[first - begin : end - begin])
            gl.glBindBuffer(gl.GL_ARRAY_BUFFER, self.names[share])
            place = (first - int(self.start[share])) * VERTEX.itemsize
            gl.glBufferSubData(gl.GL_ARRAY_BUFFER, place, data.nbytes, data)
        gl.glBindBuffer(gl.GL_ARRAY_BUFFER, 0)

    @contextmanager
    def bound(self, fog_by_height: bool = False) -> Iterator[None]:
        """Let the block draw from the buffers; fog coordinates are heights in blocks if asked."""
        if not self.names:
            with super().bound(fog_by_height):
                yield
            return
        with self._arrays_restored():
            self._fog_by_height = fog_by_height
            yield

    def _send_at_once(self, first: np.ndarray, count: np.ndarray) -> None:
        """Draw so many vertices from each of ``first`` on, buffer by buffer."""
        if not self.names:
            super()._send_at_once(first, count)
            return
        order = np.argsort(self.start, kind="stable")
        shares = order[np.searchsorted(self.start[order], first, "right") - 1]
        within = (first - self.start[shares]).astype(np.int32)
        ends = [0, *(1 + np.flatnonzero(np.diff(shares))).tolist(), len(first)]
        for one, end in pairwise(ends):
            self._take(self.names[int(shares[one])], self._fog_by_height)
            super()._send_at_once(within[one:end], count[one:end])

    def release(self) -> None:
        """Delete the buffers; may be called twice."""
        super().release()
        self._delete(self.names)
        self.names = []

    def _delete(self, names: list[int]) -> None:
        if names:
            gl.glDeleteBuffers(len(names), np.array(names, np.uint32))
