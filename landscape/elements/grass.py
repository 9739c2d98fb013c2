"""Grass: hundreds of thousands of opaque blades (Grass, section 5.3).

Technique: a blade is a strip of five vertices, textured and bent by the wind. It is opaque, so
there is no blending and no sort: the depth buffer orders the blades. Only those in front of the
camera and within a radius are drawn. In 2006 a loop tested each blade of the island in each frame
and sent it vertex by vertex. Here the map is cut into square cells, a frame tests the cells around
the walker, and one glDrawElements sends the blades of those that are visible.

``grass.method`` = loop sends one blade after another, as in 2006: the picture is the same, and the
time is spent in the calls (R18). A flaw that remains: seen edge-on, a blade is a line (R7). Fixes,
tufts and colours are in ``elements/best/meadow/``. State used: GL_TEXTURE_2D. OpenGL 1.1.
"""

from functools import partial
from typing import NamedTuple, Self

import numpy as np

from framelens.base.errors import InputError
from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays
from framelens.gl.texture import Texture
from landscape.elements.element import Element, Site
from landscape.elements.grass_cells import (
    CELL,
    bears_grass,
    cell_centres,
    cells_around,
    cover,
    places_in,
    shared_out,
    visible_cells,
)
from landscape.elements.ground import Ground
from landscape.elements.settings import Settings
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.wind import sway

KEPT = 4  # chosen: cells kept in memory, times those in view, for when the walker turns around
LEAST = 400  # chosen: the number of cells that are kept in any case
COORDINATES = np.array([(0, 1), (1, 1), (0.2, 0.3), (0.8, 0.3), (0.5, 0)], np.float32)
# A strip of five vertices is three triangles; the winding of the second is reversed, as in a strip.
STRIP_TRIANGLES = np.array([0, 1, 2, 2, 1, 3, 2, 3, 4], np.uint32)
MOST_KEPT = 3_000_000  # chosen: most blades kept in memory, 200 MB
AT_ONCE = 1_000_000  # chosen: blades in memory at a time
MOST_LOOPED = 1_000_000  # chosen: one by one they take ten seconds
WIND = ((2, 0.5), (3, 0.5), (4, 1.0))  # section 5.3.2: vertex, and its fraction of the wind
TALLEST = 0.02  # section 5.3.2: height of the tip in units, before scaling


class Blades(NamedTuple):
    """Positions of blades, float32 (n, 3), and their vertices without wind, float32 (n, 5, 3)."""

    positions: np.ndarray
    vertices: np.ndarray


def blade_corners(angles: np.ndarray) -> np.ndarray:
    """Return blades (n, 5, 3) at the origin, unscaled: two feet, two shoulders, a tip.

    ``angles`` (n,) turn their wide side from x towards z.
    """
    c, s = np.cos(angles), np.sin(angles)
    zero = np.zeros_like(c)
    corners = [
        (-0.003 * c, zero, -0.003 * s),
        (0.003 * c, zero, 0.003 * s),
        (-0.0015 * c, zero + 0.015, -0.0015 * s),
        (0.0015 * c, zero + 0.015, 0.0015 * s),
        (0.004 * s, zero + TALLEST, 0.004 * c),
    ]
    return np.stack([np.stack(corner, axis=1) for corner in corners], axis=1)


def blade_vertices(
    positions: np.ndarray, corners: np.ndarray, scale: tuple[float, ...] = (1.0, 1.0)
) -> np.ndarray:
    """Return blades, float32 (n, 5, 3), of ``corners`` (n, 5, 3) at positions (n, 3).

    ``scale`` = (sx, sy) stretches x and z, and y, as glScalef(sx, sy, sx) does in section 5.3.2.
    """
    stretched = corners * np.array([scale[0], scale[1], scale[0]])
    return np.ascontiguousarray(stretched + positions[:, None, :], np.float32)


def blade_wind(kt: float, positions: np.ndarray, scale_x: float) -> np.ndarray:
    """Return dx, dz (n, 2) of the tips: a fifth of the plants' sway (section 5.3.2)."""
    return sway(kt, positions, scale_x / 5.0)


def bent(blades: Blades, kt: float, scale_x: float) -> np.ndarray:
    """Return the vertices, float32 (n, 5, 3), of blades in the wind: shoulders move half as far."""
    dx, dz = blade_wind(kt, blades.positions, scale_x).T
    vertices = blades.vertices.copy()
    for vertex, fraction in WIND:
        vertices[:, vertex, 0] += fraction * dx
        vertices[:, vertex, 2] += fraction * dz
    return vertices


def send_one_by_one(positions: np.ndarray, vertices: np.ndarray, scale: tuple[float, ...]) -> None:
    """Send blades (n, 5, 3) in a loop, a strip each, vertex by vertex, as in section 5.3.2.

    Sixteen calls per blade: a matrix moves each to its position (n, 3), and scales it.
    """
    stretch = np.array([scale[0], scale[1], scale[0]])
    unscaled = (vertices - positions[:, None, :]) / stretch
    for place, corners in zip(positions.tolist(), unscaled.tolist(), strict=True):
        gl.glPushMatrix()
        gl.glTranslatef(*place)
        gl.glScalef(*stretch.tolist())
        gl.glBegin(gl.GL_TRIANGLE_STRIP)
        for corner, (s, t) in zip(corners, COORDINATES.tolist(), strict=True):
            gl.glTexCoord2f(s, t)
            gl.glVertex3f(*corner)
        gl.glEnd()
        gl.glPopMatrix()


def in_groups(cells: list[int], counts: np.ndarray) -> list[list[int]]:
    """Return cells in groups of at most AT_ONCE blades, or of one cell; ``counts`` by cell."""
    groups: list[list[int]] = []
    total = 0
    for cell in cells:
        total += int(counts[cell])
        if not groups or total > AT_ONCE:
            groups.append([])
            total = int(counts[cell])
        groups[-1].append(cell)
    return groups


def check_loop(count: int) -> None:
    """Raise InputError if sending ``count`` blades one by one would take too long."""
    if count > MOST_LOOPED:
        raise InputError(
            "setting grass.method: expected at most {most_looped} blades in view to be "
            "sent one by one, not {count}; grass.count or grass.radius may be smaller",
            most_looped=MOST_LOOPED,
            count=count,
        )


def strip_indices(count: int) -> np.ndarray:
    """Return the indices of the triangles of blades, uint32 (9 * count,), five vertices each."""
    first = 5 * np.arange(count, dtype=np.uint32)[:, None]
    return np.ascontiguousarray((first + STRIP_TRIANGLES).ravel())


class Grass(Element[Settings]):
    """All blades, cell by cell."""

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        """Sow it on the ground, by the seed."""
        return cls(site.settings, site.assets, site.elements[Ground], site.seed)

    @classmethod
    def built_from(cls, settings: Settings) -> tuple[object, ...]:
        """Return the settings that the blades' number, places and shapes depend on."""
        ground = settings.ground
        grass = settings.grass
        castle = settings.castle
        return (
            *(ground.scale_x, ground.scale_z),
            *(ground.height_image, ground.resolution, ground.size, ground.scale_y, ground.smooth),
            *(
                ground.subdivide,
                ground.exact_height,
                ground.ledges,
                settings.water.level,
                castle.x,
                castle.z,
            ),
            *(grass.count, grass.scale),
        )

    def __init__(self, settings: Settings, assets: Assets, ground: Ground, seed: int) -> None:
        """Distribute the blades over the cells at random, by ``seed``."""
        self.settings = settings
        self._seed = seed
        self._field = ground.field
        self._suits = partial(bears_grass, ground.field, settings.castle)
        self._across = int(np.ceil(ground.field.size / CELL))
        self._counts = shared_out(settings.grass.count, cover(self._suits, self._across), seed)
        self._grown: dict[int, Blades] = {}  # by cell, the most recently used last
        self._held = 0  # their blades
        self._cells: list[list[int]] = []  # those in view, in groups that are drawn together
        self._selected: Blades | None = None
        self._selected_for: tuple[object, ...] = ()
        self._texture = Texture(read_image(assets.path("blade.png"), "RGB"), repeat=False)
        self._indices = np.empty(0, np.uint32)
        self._coordinates = np.empty((0, 2), np.float32)

    def cell(self, number: int) -> Blades:
        """Return the blades of a cell, created when it first comes into view.

        Each cell has its own random generator, so it has the same blades whichever way the walker
        came, and a cell that is never seen costs nothing.
        """
        blades = self._grown.pop(number, None)
        if blades is None:
            rng = np.random.default_rng([self._seed, 7, number])
            xz = places_in(number, self._across, int(self._counts[number]), rng, self._suits)
            heights = self._field.terrain_height(xz[:, 0], xz[:, 1])
            places = np.insert(xz, 1, heights, axis=1)
            corners = blade_corners(rng.random(len(xz)) * 2 * np.pi)
            vertices = blade_vertices(places, corners, self.settings.grass.scale)
            blades = Blades(places.astype(np.float32), vertices)
            self._held += len(xz)
        self._grown[number] = blades
        return blades

    def select(self, frame: Frame) -> Blades:
        """Return the blades of the visible cells, including all that :func:`visible` would find.

        That function, which selects the sprites, is the plain form: it would test every blade.
        """
        return self._blades(self._in_view(frame))

    def _in_view(self, frame: Frame) -> list[int]:
        """Return the numbers of the visible cells that have blades."""
        radius = self.settings.grass.radius
        cells = cells_around(frame.pose.x, frame.pose.z, radius, self._across)
        seen = visible_cells(frame, cell_centres(cells, self._field), radius)
        numbers = cells[:, 1] * self._across + cells[:, 0]
        return list[int](numbers[seen & (self._counts[numbers] > 0)].tolist())

    def _blades(self, numbers: list[int]) -> Blades:
        """Return the blades of some cells."""
        found = [self.cell(number) for number in numbers]
        most = max(KEPT * len(found), LEAST)
        while len(self._grown) > most or (self._held > MOST_KEPT and len(self._grown) > 1):
            self._held -= len(self._grown.pop(next(iter(self._grown))).positions)
        if not found:
            return Blades(np.empty((0, 3), np.float32), np.empty((0, 5, 3), np.float32))
        return Blades(*(np.concatenate(arrays) for arrays in zip(*found, strict=True)))

    def draw(self, frame: Frame) -> None:
        """Select, bend and send the visible blades."""
        view = frame.pose, frame.size, frame.fov
        if not self._cells or self._selected_for != view:
            self._cells = in_groups(self._in_view(frame), self._counts)
            self._selected, self._selected_for = None, view
        if self.settings.grass.method == "loop":
            check_loop(sum(int(self._counts[group].sum()) for group in self._cells))
        for group in self._cells:
            # While the eye does not move, the selection is reused: only the wind changes. More
            # blades than fit into memory together are selected again in each frame.
            blades = self._blades(group) if self._selected is None else self._selected
            self._selected = blades if len(self._cells) == 1 else None
            scale = self.settings.grass.scale
            self._send(blades.positions, bent(blades, frame.kt, scale[0]))

    def _send(self, positions: np.ndarray, vertices: np.ndarray) -> None:
        """Send blades (n, 5, 3) that stand at positions (n, 3)."""
        count = len(vertices)
        if not count:
            return
        if len(self._indices) < 9 * count:
            self._indices = strip_indices(2 * count)
            self._coordinates = np.tile(COORDINATES, (2 * count, 1))
        with attrib(gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT):
            gl.glColor3f(*self.settings.sun.tint)
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._texture.bind()
            if self.settings.grass.method == "loop":
                send_one_by_one(positions, vertices, self.settings.grass.scale)
            else:
                with client_arrays(vertices.reshape(-1, 3), coordinates=[self._coordinates]):
                    gl.glDrawElements(gl.GL_TRIANGLES, 9 * count, gl.GL_UNSIGNED_INT, self._indices)
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def take(self, settings: Settings) -> None:
        """Take other settings, by which other blades may be in view."""
        self.settings = settings
        self._selected = None
        self._cells = []

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        self._texture.release()
