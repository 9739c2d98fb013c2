"""Four ways to draw the same blades of grass, from the report's to today's: for lectures.

All four show the same picture; what differs is who does the work, and how often.

- :class:`OneByOne`, as in 2006: a loop tests every blade of the land and sends what it keeps
  vertex by vertex (glBegin, glEnd). In C each call cost 12 ns; from Python it costs 400.
- :class:`FromClientMemory`: numpy tests all blades and bends the visible ones; one glDrawElements
  sends them.
- :class:`VertexBuffer`: the same, but the driver gets the blades in a buffer object of OpenGL 1.5,
  orphaned first, so that it need not wait for the previous frame.
- :class:`CompiledList`: a display list of the blades that one frame shows. It is the fastest, as
  nothing is selected or bent again, but it fits only one pose and one instant of wind: it gives the
  lower bound.

The island itself draws its grass cell by cell (elements/grass.py). State used: GL_TEXTURE_2D.
"""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays
from framelens.gl.texture import Texture
from landscape.elements import grass, transparent_elements
from landscape.elements.grass import COORDINATES, STRIP_TRIANGLES, blade_corners, blade_vertices
from landscape.elements.planting import scatter
from landscape.frame import Frame
from landscape.geometry.height_field import HeightField
from landscape.gl.display_list import DisplayList


@dataclass(frozen=True)
class Blades:
    """Positions (n, 3) and vertices without wind (n, 5, 3), float32 in units; ``radius`` shown."""

    positions: np.ndarray
    vertices: np.ndarray
    radius: float
    scale_x: float = 1.0


def sow(
    field: HeightField, count: int, seed: int, radius: float, scale: tuple[float, ...] = (1.0, 1.0)
) -> Blades:
    """Return ``count`` blades at random places, spread evenly over the land."""
    rng = np.random.default_rng([seed, 53])

    def on_land(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        return (field.terrain_height(x, z) > field.water_level).astype(float)

    positions = scatter(field, count, rng, on_land)
    angles = rng.random(len(positions)) * 2 * np.pi
    vertices = blade_vertices(positions, blade_corners(angles), scale)
    return Blades(positions.astype(np.float32), vertices, radius, scale[0])


def visible(blades: Blades, frame: Frame) -> np.ndarray:
    """Return the indices of the blades in front of the camera, within the radius (section 5.3)."""
    return transparent_elements.visible(frame, blades.positions, blades.radius)


def bent(blades: Blades, chosen: np.ndarray, kt: float) -> np.ndarray:
    """Return the vertices, float32 (n, 5, 3), of the ``chosen`` blades in the wind of ``kt``."""
    part = grass.Blades(blades.positions[chosen], blades.vertices[chosen])
    return grass.bent(part, kt, blades.scale_x)


def strip_indices(count: int) -> np.ndarray:
    """Return the triangles of ``count`` blades of five vertices, uint32 (9 * count,)."""
    first = 5 * np.arange(count, dtype=np.uint32)[:, None]
    return np.ascontiguousarray((first + STRIP_TRIANGLES).ravel(), np.uint32)


@contextmanager
def textured(texture: Texture) -> Iterator[None]:
    """Draw the blades of the block with the texture."""
    with attrib(gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT):
        gl.glEnable(gl.GL_TEXTURE_2D)
        texture.bind()
        yield
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)


class OneByOne:
    """2006: look at every blade of the land, send the visible ones vertex by vertex."""

    name = "loop, immediate mode (2006)"

    def __init__(self, blades: Blades, texture: Texture) -> None:
        """Keep the blades as plain numbers, as an array in C would."""
        self._texture = texture
        self._radius = blades.radius
        self._scale_x = blades.scale_x
        self._positions = blades.positions.tolist()
        self._vertices = blades.vertices.tolist()

    def draw(self, frame: Frame) -> None:
        """Test, bend and send each blade."""
        ex = frame.pose.x
        ez = frame.pose.z
        kt = frame.kt
        ax, ay, az = frame.modelview[[2, 6, 10]].tolist()
        offset, square = float(frame.modelview[14]), self._radius**2
        coordinates = COORDINATES.tolist()
        texture_coordinate, vertex = gl.glTexCoord2f, gl.glVertex3f

        with textured(self._texture):
            for (x, y, z), corners in zip(self._positions, self._vertices, strict=True):
                if (x - ex) ** 2 + (z - ez) ** 2 >= square or ax * x + ay * y + az * z >= -offset:
                    continue
                # A fifth of the plants' sway, as in blade_wind.
                dx = 0.05 * math.cos(kt / 10 - 1.2 * x - 0.744 * z) * self._scale_x / 5
                dz = 0.03 * math.cos(kt / 9.6 - 1.44 * x) * self._scale_x / 5
                gl.glBegin(gl.GL_TRIANGLE_STRIP)
                for (s, t), (vx, vy, vz), part in zip(
                    coordinates, corners, (0.0, 0.0, 0.5, 0.5, 1.0), strict=True
                ):
                    texture_coordinate(s, t)
                    vertex(vx + part * dx, vy, vz + part * dz)
                gl.glEnd()

    def release(self) -> None:
        """Nothing is owned."""


class FromClientMemory:
    """Blades tested and bent by numpy, sent from client memory each frame."""

    name = "client arrays"

    def __init__(self, blades: Blades, texture: Texture) -> None:
        """Make the arrays that do not change."""
        self._blades, self._texture = blades, texture
        self._indices = strip_indices(len(blades.positions))
        self._coordinates = np.tile(COORDINATES, (len(blades.positions), 1))

    def draw(self, frame: Frame) -> None:
        """Choose, bend, and send with one glDrawElements."""
        chosen = visible(self._blades, frame)
        vertices = bent(self._blades, chosen, frame.kt).reshape(-1, 3)
        with textured(self._texture), client_arrays(vertices, coordinates=[self._coordinates]):
            count = 9 * len(chosen)
            gl.glDrawElements(gl.GL_TRIANGLES, count, gl.GL_UNSIGNED_INT, self._indices[:count])

    def release(self) -> None:
        """Nothing is owned."""


class VertexBuffer:
    """The same, handed over in buffer objects (OpenGL 1.5)."""

    name = "vertex buffer"

    def __init__(self, blades: Blades, texture: Texture) -> None:
        """Put what does not change into buffers: texture coordinates and indices."""
        self._blades, self._texture = blades, texture
        self._names = [int(name) for name in np.ravel(gl.glGenBuffers(3))]
        constant = (
            (gl.GL_ARRAY_BUFFER, self._names[1], np.tile(COORDINATES, (len(blades.positions), 1))),
            (gl.GL_ELEMENT_ARRAY_BUFFER, self._names[2], strip_indices(len(blades.positions))),
        )
        for target, name, data in constant:
            gl.glBindBuffer(target, name)
            gl.glBufferData(target, data.nbytes, data, gl.GL_STATIC_DRAW)
            gl.glBindBuffer(target, 0)

    def draw(self, frame: Frame) -> None:
        """Choose, bend, hand over, and draw."""
        chosen = visible(self._blades, frame)
        vertices = bent(self._blades, chosen, frame.kt)
        with textured(self._texture):
            gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
            gl.glEnableClientState(gl.GL_TEXTURE_COORD_ARRAY)
            gl.glBindBuffer(gl.GL_ARRAY_BUFFER, self._names[0])
            # New storage for the same name: the driver keeps the old one until its frame is done.
            gl.glBufferData(gl.GL_ARRAY_BUFFER, vertices.nbytes, vertices, gl.GL_STREAM_DRAW)
            gl.glVertexPointer(3, gl.GL_FLOAT, 0, None)
            gl.glBindBuffer(gl.GL_ARRAY_BUFFER, self._names[1])
            gl.glTexCoordPointer(2, gl.GL_FLOAT, 0, None)
            gl.glBindBuffer(gl.GL_ELEMENT_ARRAY_BUFFER, self._names[2])
            gl.glDrawElements(gl.GL_TRIANGLES, 9 * len(chosen), gl.GL_UNSIGNED_INT, None)
            gl.glBindBuffer(gl.GL_ELEMENT_ARRAY_BUFFER, 0)
            gl.glBindBuffer(gl.GL_ARRAY_BUFFER, 0)
            gl.glDisableClientState(gl.GL_TEXTURE_COORD_ARRAY)
            gl.glDisableClientState(gl.GL_VERTEX_ARRAY)

    def release(self) -> None:
        """Delete the buffers; may be called twice."""
        if self._names:
            gl.glDeleteBuffers(len(self._names), np.array(self._names, np.uint32))
            self._names = []


class CompiledList:
    """A display list, compiled at the first frame: what OpenGL alone needs for these blades."""

    name = "display list, no wind"

    def __init__(self, blades: Blades, texture: Texture) -> None:
        """Keep the blades until they are compiled."""
        self._arrays = FromClientMemory(blades, texture)
        self._list: DisplayList | None = None

    def draw(self, frame: Frame) -> None:
        """Call the list; the first call compiles it for this frame's place and wind."""
        if self._list is None:
            self._list = DisplayList(lambda: self._arrays.draw(frame))
        self._list.call()

    def release(self) -> None:
        """Delete the list; may be called twice."""
        if self._list is not None:
            self._list.release()


WAYS = (OneByOne, FromClientMemory, VertexBuffer, CompiledList)
