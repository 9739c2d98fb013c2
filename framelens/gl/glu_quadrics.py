"""GLU's quadrics in Python: the vertices, normals and texture coordinates of GLU 1.3, in its order.

The shape is computed as rows and columns of points, and drawn by glBegin, glNormal3f, glTexCoord2f,
glVertex3f and glEnd. Angles are in degrees; slices go around the z axis, stacks along it.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from math import cos, hypot, pi, radians, sin

import OpenGL.GL as GL

# The enumerants of GLU.
SMOOTH = 100000
FLAT = 100001
NONE = 100002
POINT = 100010
LINE = 100011
FILL = 100012
SILHOUETTE = 100013
OUTSIDE, INSIDE = 100020, 100021
MOST = 239  # slices and stacks: GLU has no room for more

Normal = tuple[float, float, float] | None
Vertex = tuple[Normal, tuple[float, float], tuple[float, float, float]]
"""A normal, or None where the last one stays; a texture coordinate; a position."""


@dataclass
class Quadric:
    """How gluSphere and its like draw."""

    style: int = FILL
    normals: int = SMOOTH
    orientation: int = OUTSIDE
    texture: bool = False

    def draw(self, mode: int, vertices: Iterable[Vertex]) -> None:
        """Draw one primitive."""
        normal = GL.glNormal3f
        coordinate = GL.glTexCoord2f
        vertex = GL.glVertex3f
        GL.glBegin(mode)
        for at, place, position in vertices:
            if at is not None and self.normals != NONE:
                normal(*at)
            if self.texture:
                coordinate(*place)
            vertex(*position)
        GL.glEnd()

    @property
    def sign(self) -> float:
        """1 where normals point outwards, -1 where they point inwards."""
        return -1.0 if self.orientation == INSIDE else 1.0


def gluNewQuadric() -> Quadric:
    """Return a quadric that draws filled, smooth, with its outside out and without texture."""
    return Quadric()


def gluDeleteQuadric(quadric: Quadric) -> None:
    """Do nothing: Python frees it."""


def gluQuadricCallback(quadric: Quadric, which: int = 0, function: object = None) -> None:
    """Do nothing: no error is reported."""


def gluQuadricDrawStyle(quadric: Quadric, style: int) -> None:
    """Draw filled, as lines, as a silhouette or as points from now on."""
    quadric.style = int(style)


def gluQuadricNormals(quadric: Quadric, normals: int) -> None:
    """Give each vertex a normal, each face one, or none, from now on."""
    quadric.normals = int(normals)


def gluQuadricOrientation(quadric: Quadric, orientation: int) -> None:
    """Let normals and front faces point outwards or inwards from now on."""
    quadric.orientation = int(orientation)


def gluQuadricTexture(quadric: Quadric, texture: int) -> None:
    """Give each vertex a texture coordinate, or none, from now on."""
    quadric.texture = bool(texture)


def _circle(slices: int, shift: float = 0.0) -> list[tuple[float, float]]:
    """Return sine and cosine of the directions of all slices, the first one again at the end."""
    angles = [2.0 * pi * (i + shift) / slices for i in range(slices)]
    around = [(sin(angle), cos(angle)) for angle in angles]
    return [*around, around[0]]


def gluSphere(quadric: Quadric, radius: float, slices: int, stacks: int) -> None:
    """Draw a sphere about the origin; its texture's top is at +z."""
    slices, stacks = min(int(slices), MOST), min(int(stacks), MOST)
    if slices < 2 or stacks < 1 or radius < 0.0:
        return
    sign = quadric.sign
    around, middles = _circle(slices), _circle(slices, -0.5)
    down = [(sin(pi * j / stacks), cos(pi * j / stacks)) for j in range(stacks + 1)]
    between = [
        (sin(pi * (j - 0.5) / stacks), cos(pi * (j - 0.5) / stacks)) for j in range(stacks + 1)
    ]
    down[0], down[-1] = (0.0, 1.0), (0.0, -1.0)

    def direction(column: tuple[float, float], row: tuple[float, float]) -> Normal:
        return sign * column[0] * row[0], sign * column[1] * row[0], sign * row[1]

    def vertex(i: int, j: int, normal: Normal) -> Vertex:
        (x, y), (ring, z) = around[i], down[j]
        place = 1.0 - i / slices, 1.0 - j / stacks
        return normal, place, (radius * ring * x, radius * ring * y, radius * z)

    def smooth(i: int, j: int) -> Vertex:
        return vertex(i, j, direction(around[i], down[j]))

    flat = quadric.normals == FLAT
    if quadric.style == FILL:
        ends = not quadric.texture
        if ends:
            outwards = range(slices, -1, -1)
            for j, pole, row, order in (
                (1, 0, 1, outwards if sign > 0 else outwards[::-1]),
                (stacks - 1, stacks, stacks, outwards[::-1] if sign > 0 else outwards),
            ):
                if not flat and quadric.normals != NONE:
                    GL.glNormal3f(0.0, 0.0, sign * down[pole][1])
                fan: list[Vertex] = [(None, (0.0, 0.0), (0.0, 0.0, radius * down[pole][1]))]
                backwards = order.step < 0
                for i in order:
                    if not flat:
                        fan.append(smooth(i, j))
                    elif backwards and i == slices:
                        fan.append(vertex(i, j, None))
                    else:
                        middle = middles[i + 1] if backwards else middles[i]
                        fan.append(vertex(i, j, direction(middle, between[row])))
                quadric.draw(GL.GL_TRIANGLE_FAN, fan)
        for j in range(1, stacks - 1) if ends else range(stacks):
            first, second = (j + 1, j) if sign > 0 else (j, j + 1)
            strip: list[Vertex] = []
            for i in range(slices + 1):
                if flat:
                    face = direction(middles[i], between[j + 1])
                    strip += (vertex(i, first, None), vertex(i, second, face))
                else:
                    strip += (smooth(i, first), smooth(i, second))
            quadric.draw(GL.GL_QUAD_STRIP, strip)
    elif quadric.style == POINT:
        points = [smooth(i, j) for j in range(stacks + 1) for i in range(slices)]
        quadric.draw(GL.GL_POINTS, points)
    else:
        for j in range(1, stacks):
            columns = middles if flat else around
            ring = [vertex(i, j, direction(columns[i], down[j])) for i in range(slices + 1)]
            quadric.draw(GL.GL_LINE_STRIP, ring)
        for i in range(slices):
            rows = between if flat else down
            line = [vertex(i, j, direction(around[i], rows[j])) for j in range(stacks + 1)]
            quadric.draw(GL.GL_LINE_STRIP, line)


def gluCylinder(
    quadric: Quadric, base: float, top: float, height: float, slices: int, stacks: int
) -> None:
    """Draw the side of a cylinder or cone, from ``base`` at z = 0 to ``top`` at ``height``."""
    slices, stacks = min(int(slices), MOST), min(int(stacks), MOST)
    length = hypot(base - top, height)
    if slices < 2 or stacks < 1 or min(base, top, height) < 0.0 or length == 0.0:
        return
    slope, steep = (base - top) / length, height / length * quadric.sign
    flat = quadric.normals == FLAT
    around, middles = _circle(slices), _circle(slices, -0.5)
    sides = middles if flat and quadric.style != POINT else around
    facing = [(steep * x, steep * y, slope) for x, y in sides]

    def vertex(i: int, j: int, normal: Normal = None) -> Vertex:
        radius = base - (base - top) * (j / stacks)
        (x, y), place = around[i], (1.0 - i / slices, j / stacks)
        return normal, place, (radius * x, radius * y, j * height / stacks)

    if quadric.style == FILL:
        for j in range(stacks):
            low, high = (j, j + 1) if quadric.orientation == OUTSIDE else (j + 1, j)
            strip: list[Vertex] = []
            for i in range(slices + 1):
                strip += (vertex(i, low, facing[i]), vertex(i, high))
            quadric.draw(GL.GL_QUAD_STRIP, strip)
    elif quadric.style == POINT:
        points = [
            vertex(i, j, None if j else facing[i]) for i in range(slices) for j in range(stacks + 1)
        ]
        quadric.draw(GL.GL_POINTS, points)
    else:
        inner = range(1, stacks) if quadric.style == LINE else ()
        for j in (*inner, 0, stacks):
            ring = [vertex(i, j, facing[i]) for i in range(slices + 1)]
            quadric.draw(GL.GL_LINE_STRIP, ring)
        for i in range(slices):
            if quadric.normals != NONE:
                GL.glNormal3f(steep * around[i][0], steep * around[i][1], 0.0)
            quadric.draw(GL.GL_LINE_STRIP, [vertex(i, j) for j in range(stacks + 1)])


def gluDisk(quadric: Quadric, inner: float, outer: float, slices: int, loops: int) -> None:
    """Draw a disk in the plane z = 0, with a hole unless ``inner`` is 0."""
    gluPartialDisk(quadric, inner, outer, slices, loops, 0.0, 360.0)


def gluPartialDisk(
    quadric: Quadric,
    inner: float,
    outer: float,
    slices: int,
    loops: int,
    start: float,
    sweep: float,
) -> None:
    """Draw a sector of a disk, from ``start`` on; 0 is +y, and angles grow clockwise from +z."""
    slices, loops = min(int(slices), MOST), min(int(loops), MOST)
    if slices < 2 or loops < 1 or outer <= 0.0 or inner < 0.0 or inner > outer:
        return
    sweep = 360.0 if abs(sweep) > 360.0 else sweep
    start, sweep = (start + sweep, -sweep) if sweep < 0.0 else (start, sweep)
    angles = [radians(start) + radians(sweep) * i / slices for i in range(slices + 1)]
    around = [(sin(angle), cos(angle)) for angle in angles]
    whole = sweep == 360.0
    if whole:
        around[-1] = around[0]
    spokes = range(slices) if whole else range(slices + 1)

    def vertex(i: int, j: int) -> Vertex:
        radius = outer - (outer - inner) * (j / loops)
        (x, y), half = around[i], radius / outer / 2.0
        return None, (half * x + 0.5, half * y + 0.5), (radius * x, radius * y, 0.0)

    if quadric.normals != NONE:
        GL.glNormal3f(0.0, 0.0, quadric.sign)
    if quadric.style == FILL:
        rings = loops
        if inner == 0.0:
            rings -= 1
            order = range(slices, -1, -1) if quadric.orientation == OUTSIDE else range(slices + 1)
            centre: Vertex = (None, (0.5, 0.5), (0.0, 0.0, 0.0))
            quadric.draw(GL.GL_TRIANGLE_FAN, [centre, *(vertex(i, rings) for i in order)])
        for j in range(rings):
            low, high = (j, j + 1) if quadric.orientation == OUTSIDE else (j + 1, j)
            strip = [vertex(i, row) for i in range(slices + 1) for row in (low, high)]
            quadric.draw(GL.GL_QUAD_STRIP, strip)
    elif quadric.style == POINT:
        quadric.draw(GL.GL_POINTS, [vertex(i, j) for i in spokes for j in range(loops + 1)])
    else:
        outline = quadric.style == SILHOUETTE
        circles = [
            [vertex(i, j) for i in range(slices + 1)]
            for j in ((0, loops) if outline else range(loops + 1))
        ]
        lines = [
            [vertex(i, j) for j in range(loops + 1)]
            for i in ((() if whole else (0, slices)) if outline else spokes)
        ]
        for strip in (*lines, *circles) if outline else (*circles, *lines):
            quadric.draw(GL.GL_LINE_STRIP, strip)


QUADRICS: dict[str, Callable[..., object]] = {
    function.__name__: function
    for function in (
        *(gluNewQuadric, gluDeleteQuadric, gluQuadricCallback, gluQuadricDrawStyle),
        *(gluQuadricNormals, gluQuadricOrientation, gluQuadricTexture),
        *(gluSphere, gluCylinder, gluDisk, gluPartialDisk),
    )
}
