"""What the castle's open door shows: a hall with pillars, torches and windows (``castle.depth``).

Technique: a portal. The opening is marked in the stencil buffer, and its depth set to the farthest.
Then the hall is drawn where the mark is, as if the wall had a hole, and at last the opening's own
depth is put back and the mark removed. The hall reaches through the castle's yard: it is only seen
through the door. Its light is in its vertices' colours: torches, and the day that falls in.
Not in the report. Where there is no stencil buffer, the opening keeps its painted glow.
State used: stencil test and operations, depth range, depth function, colour mask; no lighting.
"""

import math

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib
from framelens.gl.texture import Texture
from landscape.elements.best.castle.open_door import half_arch
from landscape.frame import Frame
from landscape.geometry.mesh import Mesh, grid_triangles, merged, vertex_normals
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh

# All chosen. Units of the castle's own frame; the door is at z = 0, about x = 0.5.
WIDE, HIGH, LONG = 0.36, 0.50, 2.3  # half width, height and length of the hall
THICK = 0.10  # of the wall that the door leads through
AISLE = 0.185  # the pillars' distance from the middle
PILLARS = 0.30 + 0.40 * np.arange(5)  # their z
RADIUS = 0.030
CELL = 0.07  # side of the cells whose corners are lit
LAMPS = [(0.5 + side * (AISLE - 0.045), 0.20, z) for z in PILLARS for side in (-1, 1)]
LAMP, REACH = np.array([1.75, 1.02, 0.46]), 0.15  # a lamp's light, where it is half as strong
AMBIENT = np.array([0.055, 0.045, 0.042])
DAY = np.array([0.62, 0.62, 0.60])  # daylight on the floor behind the door
END = np.array([1.5, 1.35, 1.05])  # light of the windows at the end of the hall
STONE = np.array([0.95, 0.92, 0.86])
CARPET = (0.50, 0.085, 0.07)
BRAID = (0.62, 0.46, 0.16)
PANE = np.array([(0.92, 0.74, 0.46), (0.98, 0.93, 0.80)])  # windows, from their foot to their top
FLAME = np.array([1.0, 0.74, 0.32])


def sheet(corner: tuple[float, ...], along: tuple[float, ...], up: tuple[float, ...]) -> Mesh:
    """Return a rectangle of cells of about CELL, from ``corner`` along two edges; faces along x up.

    Texture coordinates are lengths in units.
    """
    a, b = np.array(along, float), np.array(up, float)
    long, tall = float(np.linalg.norm(a)), float(np.linalg.norm(b))
    columns, rows = (max(math.ceil(side / CELL), 1) + 1 for side in (long, tall))
    u, v = np.meshgrid(np.linspace(0, 1, columns), np.linspace(0, 1, rows))
    flat = np.array(corner) + u.ravel()[:, None] * a + v.ravel()[:, None] * b
    vertices = np.ascontiguousarray(flat, np.float32)
    triangles = np.ascontiguousarray(grid_triangles(columns, rows)[:, ::-1])
    coordinates = np.stack([u.ravel() * long, -v.ravel() * tall], axis=1)
    normal = np.cross(a, b) / (long * tall)
    normals = np.tile(normal.astype(np.float32), (len(vertices), 1))
    return Mesh(vertices, normals, triangles, (np.ascontiguousarray(coordinates, np.float32),))


def pillar(x: float, z: float) -> Mesh:
    """Return a pillar with base and capital, which widens into the arches above it."""
    profile = [(0.044, 0.0), (0.044, 0.02), (RADIUS, 0.035), (RADIUS, 0.16), (RADIUS, 0.28)]
    profile += [(0.046, 0.31), (0.046, 0.325), (0.075, 0.40), (0.15, HIGH)]
    turn = np.linspace(0.0, 2 * math.pi, 9)
    grid = np.stack(
        [
            np.stack([x + r * np.cos(turn), y + 0 * turn, z + r * np.sin(turn)], 1)
            for r, y in profile
        ]
    )
    vertices = np.ascontiguousarray(grid.reshape(-1, 3), np.float32)
    triangles = grid_triangles(9, len(profile))
    u, v = np.meshgrid(0.2 * turn / math.pi, [-y for _, y in profile])
    coordinates = np.stack([u.ravel(), v.ravel()], axis=1).astype(np.float32)
    return Mesh(vertices, vertex_normals(vertices, triangles), triangles, (coordinates,))


def passage() -> Mesh:
    """Return the sides and the vault of the passage through the wall."""
    half = half_arch()
    line = np.concatenate([half * (1, 1), half[-2::-1] * (-1, 1)])
    depths = np.linspace(0.0, THICK, 3)
    grid = np.stack(
        [np.column_stack([0.5 + line[:, 0], line[:, 1], 0 * line[:, 0] + z]) for z in depths]
    )
    vertices = np.ascontiguousarray(grid.reshape(-1, 3), np.float32)
    triangles = np.ascontiguousarray(grid_triangles(len(line), 3))
    round_ = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    u, v = np.meshgrid(round_, depths)
    coordinates = np.stack([v.ravel(), -u.ravel()], axis=1).astype(np.float32)
    normals = vertex_normals(vertices, triangles)
    inwards = np.array([0.5, 0.15, THICK / 2]) - vertices
    if (normals * inwards).sum() < 0:
        normals = -normals
    return Mesh(vertices, normals, triangles, (coordinates,))


def light(places: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """Return the light (n, 3) of lamps, windows and day at places (n, 3) with normals (n, 3)."""
    total = np.tile(AMBIENT, (len(places), 1))
    for lamp, colour, reach in [
        *((lamp, LAMP, REACH) for lamp in LAMPS),
        ((0.5, 0.22, LONG - 0.12), END, 0.30),
    ]:
        line = np.array(lamp) - places
        far = np.linalg.norm(line, axis=1)
        facing = 0.25 + 0.75 * np.clip((normals * line).sum(axis=1) / far, 0.0, 1.0)
        total += (0.42 * facing / (1.0 + (far / reach) ** 2))[:, None] * colour
    inner = np.maximum(places[:, 2], 0.0)
    beside = np.exp(-(((places[:, 0] - 0.5) / (0.10 + 0.35 * inner)) ** 2))
    day = np.exp(-inner / 0.20) * beside * np.exp(-np.maximum(places[:, 1], 0.0) / 0.22)
    return np.asarray(total + day[:, None] * DAY)


def hall() -> tuple[Mesh, Mesh]:
    """Return the hall, textured with stones, and its carpet and flames, which are plain."""
    x0 = 0.5 - WIDE
    x1 = 0.5 + WIDE
    far = LONG - THICK
    parts = [
        sheet((x0, 0.0, LONG), (2 * WIDE, 0, 0), (0, 0, -LONG - 0.02)),  # floor
        sheet((x0, HIGH, THICK), (2 * WIDE, 0, 0), (0, 0, far)),
        sheet((x0, 0, LONG), (0, 0, -far), (0, HIGH, 0)),
        sheet((x1, 0, THICK), (0, 0, far), (0, HIGH, 0)),
        sheet((x1, 0, LONG), (-2 * WIDE, 0, 0), (0, HIGH, 0)),
        passage(),
    ]
    parts += [pillar(0.5 + side * AISLE, z) for z in PILLARS for side in (-1, 1)]
    stone = merged(parts)
    stone = _lit(stone, np.tile(STONE, (len(stone.vertices), 1)))
    plain = []
    for left, wide, colour in (
        (-0.052, 0.104, CARPET),
        (-0.052, 0.007, BRAID),
        (0.045, 0.007, BRAID),
    ):
        y = 0.002 if colour is CARPET else 0.003
        strip = sheet((0.5 + left, y, LONG - 0.2), (wide, 0, 0), (0, 0, -LONG + 0.205))
        plain.append(_lit(strip, np.tile(colour, (len(strip.vertices), 1))))

    plain += [_flame(x, y, z, 0.006, 0.026) for x, y, z in LAMPS]
    plain += [
        _lancet(0.5 + dx, low, tall)
        for dx, low, tall in ((-0.085, 0.13, 0.20), (0.0, 0.12, 0.28), (0.085, 0.13, 0.20))
    ]
    return stone, merged(plain)


def _lit(mesh: Mesh, tints: np.ndarray) -> Mesh:
    shades = light(mesh.vertices.astype(float), mesh.normals.astype(float)) * tints
    colours = np.ascontiguousarray(np.clip(shades, 0.0, 1.0), np.float32)
    return Mesh(mesh.vertices, mesh.normals, mesh.triangles, mesh.coordinates, colours)


def _flame(x: float, y: float, z: float, half: float, tall: float) -> Mesh:
    """Return a flame that faces the door: a rhomb, bright below and red at its tip."""
    places = [
        (x, y, z),
        (x + half, y + 0.35 * tall, z),
        (x, y + tall, z),
        (x - half, y + 0.35 * tall, z),
    ]
    colours = np.array([FLAME * 1.3, FLAME, FLAME * (1.0, 0.45, 0.2), FLAME])
    return Mesh(
        np.array(places, np.float32),
        np.tile(np.array([0, 0, -1], np.float32), (4, 1)),
        np.array([(0, 2, 1), (0, 3, 2)], np.uint32),
        (np.zeros((4, 2), np.float32),),
        np.clip(colours, 0, 1).astype(np.float32),
    )


def _lancet(x: float, low: float, tall: float) -> Mesh:
    """Return a narrow pointed window in the hall's far wall, the sky behind it."""
    half, z = 0.026, LONG - 0.002
    turn = np.linspace(0.0, math.pi / 3, 5)
    right = np.stack([2 * half * np.cos(turn) - half, 2 * half * np.sin(turn)], axis=1)
    spring = low + tall - 1.75 * half
    side = np.concatenate([[(half, low - spring)], right, right[-2::-1] * (-1, 1)])
    line = np.concatenate([side, [(-half, low - spring)]])
    places = np.column_stack([x + line[:, 0], spring + line[:, 1], np.full(len(line), z)])
    share = np.clip((places[:, 1:2] - low) / tall, 0.0, 1.0)
    colours = PANE[0] + share * (PANE[1] - PANE[0])
    count = len(places)
    fan = [(0, k + 1, k) for k in range(1, count - 1)]
    return Mesh(
        places.astype(np.float32),
        np.tile(np.array([0, 0, -1], np.float32), (count, 1)),
        np.array(fan, np.uint32),
        (np.zeros((count, 2), np.float32),),
        colours.astype(np.float32),
    )


class Doorway:
    """The hall behind the door, seen through the opening."""

    def __init__(self, stones: Texture, opening: DisplayList) -> None:
        """Compile the hall; ``opening`` is the list that fills the opening."""
        self._stones, self._opening = stones, opening
        self._hall = DisplayList(self._send)

    def _send(self) -> None:
        stone, plain = hall()
        gl.glEnable(gl.GL_TEXTURE_2D)
        self._stones.bind()
        gl.glMatrixMode(gl.GL_TEXTURE)
        gl.glPushMatrix()
        gl.glScalef(2.2, 2.2, 1.0)
        draw_mesh(stone)
        gl.glPopMatrix()
        gl.glMatrixMode(gl.GL_MODELVIEW)
        gl.glDisable(gl.GL_TEXTURE_2D)
        draw_mesh(plain)

    def draw(self, frame: Frame) -> None:
        """Draw what is seen through the opening; depth and stencil are left as if it were shut."""
        groups = gl.GL_STENCIL_BUFFER_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
        groups |= gl.GL_ENABLE_BIT | gl.GL_VIEWPORT_BIT | gl.GL_POLYGON_BIT | gl.GL_CURRENT_BIT
        with attrib(groups | gl.GL_TEXTURE_BIT):
            for off in (gl.GL_BLEND, gl.GL_LIGHTING, gl.GL_COLOR_MATERIAL):
                gl.glDisable(off)
            self._draw_opening(gl.GL_LESS, gl.GL_ALWAYS, gl.GL_REPLACE, depth=False)
            gl.glDepthRange(1.0, 1.0)
            self._draw_opening(gl.GL_ALWAYS, gl.GL_EQUAL, gl.GL_KEEP)
            gl.glDepthRange(0.0, 1.0)
            gl.glDepthFunc(gl.GL_LESS)
            gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
            self._hall.call()
            self._draw_opening(gl.GL_ALWAYS, gl.GL_EQUAL, gl.GL_ZERO)

    def _draw_opening(self, passes: int, stencil: int, does: int, depth: bool = True) -> None:
        """Draw the opening into depth, if wanted, and stencil buffer where its tests pass."""
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilFunc(stencil, 1, 1)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, does)
        gl.glDepthFunc(passes)
        gl.glDepthMask(gl.GL_TRUE if depth else gl.GL_FALSE)
        gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
        self._opening.call()
        if does == gl.GL_REPLACE:
            gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)

    def release(self) -> None:
        """Delete the list; may be called twice."""
        self._hall.release()
