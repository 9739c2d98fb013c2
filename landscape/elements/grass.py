"""Grass: hundreds of thousands of opaque blades (Grass, section 5.3).

Technique: a blade is a strip of five vertices, no blending and no sorting: the z buffer does it. In
2006 a loop tested every blade each frame. Here the map is cut into cells: a frame tests those
round the walker, and sends the blades of the visible ones with one glDrawElements, their top
vertices moved by the wind. A cell's blades are drawn by lot when it first comes into view, from a
generator of its own: the lot is the same whichever way the walker came, and what is never seen
costs nothing. ``grass.method`` = loop sends blade after blade, as in 2006. With ``grass.fade`` the
lot is drawn in layers, each as large as all before it, and a far cell gets the first ones only. The
blades themselves are made in blades.py.
State used: GL_TEXTURE_2D; tinted, the combiner of unit 0 with GL_RGB_SCALE (OpenGL 1.3).
"""

import math

import numpy as np

from landscape.elements.ground import Ground
from landscape.elements.meadow.blades import (
    COORDINATES,
    LUSH,
    NEAR,
    NOTHING,
    STRIP_TRIANGLES,
    WIDENING,
    WIND,
    Patch,
    blade_tints,
    blade_vertices,
    blade_wind,
    drawn_at,
    facing,
    hues,
    joined,
    meadow,
    nearness,
    thinned_reach,
    within,
)
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.camera import REUSE_ANGLE, REUSE_DISTANCE, is_near
from landscape.geometry.height_field import greenness
from landscape.gl.calls import gl
from landscape.gl.state import attrib, client_arrays
from landscape.gl.texture import Texture
from landscape.settings import Settings

ELEMENT = "grass"

CELL = 0.5  # chosen: units per side of a cell; small against the radius, large against a blade
LAYER = 64  # chosen: blades in the first layer of a cell's lot
TUFT_RADIUS = 0.017  # chosen: units, how far apart the roots of a tuft's blades are
KEPT = 6  # chosen: times the blades in view are kept grown, for when the walker turns round
LEAST = 40_000  # chosen: so many blades are kept in any case, 4 MB


def cells_around(x: float, z: float, radius: float, across: int) -> np.ndarray:
    """Return column and row (n, 2) of the cells that reach within ``radius`` of x, z in units.

    ``across`` is the number of cells per side of the map. The work depends on the radius alone,
    not on how large the map is or how much grows on it.
    """
    low = np.floor((np.array([x, z]) - radius) / CELL).astype(int)
    high = np.floor((np.array([x, z]) + radius) / CELL).astype(int)
    low, high = np.maximum(low, 0), np.minimum(high, across - 1)
    columns, rows = (np.arange(a, b + 1) for a, b in zip(low, high, strict=True))
    return np.stack(np.meshgrid(columns, rows), axis=2).reshape(-1, 2)


def visible_cells(
    frame: Frame, centres: np.ndarray, radius: float, spare: float = 0.0, turn: float = 0.0
) -> np.ndarray:
    """Return a mask (n,) of the cells with centres (n, 3) that may show a blade of grass.

    Now, or after the eye has moved by ``spare`` units and turned by ``turn`` radians.
    """
    reach = CELL * 0.7072 + 0.1 + spare
    away = centres - frame.eye
    near = away[:, 0] ** 2 + away[:, 2] ** 2 < (radius + reach) ** 2
    width, height = frame.size
    side = math.tan(math.radians(frame.fov / 2)) * max(width / height, 1.0)
    # Beyond a right angle nothing is left out at the sides.
    half = math.tan(min(math.atan(side) + turn, 1.5))
    depth = -frame.depth(centres)
    inside = np.abs(away @ frame.right) <= depth * half + reach * math.hypot(1.0, half)
    return np.asarray(near & inside & (depth > -reach))


def send_one_by_one(blades: np.ndarray, tints: np.ndarray | None) -> None:
    """Send blades (n, 5, 3) in a loop, a strip each, vertex by vertex, as section 5.3 does (R18).

    The picture is that of one glDrawElements; the time is spent in the calls, 16 for each blade.
    """
    colours = np.full((*blades.shape[:2], 4), 255, np.uint8) if tints is None else tints
    for corners, shades in zip(blades.tolist(), colours.tolist(), strict=True):
        gl.glBegin(gl.GL_TRIANGLE_STRIP)
        for corner, shade, (s, t) in zip(corners, shades, COORDINATES.tolist(), strict=True):
            gl.glColor4ub(*shade)
            gl.glTexCoord2f(s, t)
            gl.glVertex3f(*corner)
        gl.glEnd()


class Grass:
    """All blades, cell by cell."""

    def __init__(self, settings: Settings, assets: Assets, ground: Ground, seed: int) -> None:
        """Share the blades out over the cells by lot (``seed``)."""
        self._settings, self._ground, self._seed = settings, ground, seed
        self._across = int(np.ceil(ground.field.size / CELL))
        self._near = NEAR
        self.counts = self._share()
        self._shared = self.counts.copy()
        self._patches: dict[int, Patch] = {}  # the last used last
        self._grown = self._in_view = 0
        self._chosen: Patch | None = None
        self._chosen_for: tuple[Frame, Settings] | None = None
        image = read_image(assets.path("blade.png"), "RGB")
        self._texture = Texture(image, repeat=False)
        half, last = max(len(image) // 2, 1), len(image) * 7 // 8
        rows = image[:half], image[last:]
        self._ends = tuple(part.mean(axis=(0, 1)) / 255.0 for part in rows)
        self._indices = np.empty(0, np.uint32)
        self._coordinates = np.empty((0, 2), np.float32)

    def _suits(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Return 0..1: land, outside the castle; tinted grass keeps off what is not green."""
        field, castle = self._ground.field, self._settings.castle
        land = (field.terrain_height(x, z) > field.water_level + 0.004).astype(float)
        land *= np.hypot(x - castle.x, z - castle.z) > 0.75
        land *= (x < field.size) & (z < field.size)
        if self._settings.grass.tinted:
            land *= greenness(self._ground.colour(x, z))
        return land

    def _share(self) -> np.ndarray:
        """Return how many blades each cell bears, (cells,), ``grass.count`` in all."""
        rng = np.random.default_rng([self._seed, 7])
        probes = (np.arange(4 * self._across) + 0.5) * CELL / 4
        x, z = np.meshgrid(probes, probes)
        suits = self._suits(x.ravel(), z.ravel()).reshape(self._across, 4, self._across, 4)
        share = suits.mean(axis=(1, 3)).ravel()
        if not share.any():
            return np.zeros(len(share), int)
        self._near = nearness(self._settings.grass.count / (share.sum() * CELL**2))
        return rng.multinomial(self._settings.grass.count, share / share.sum())

    def _patch(self, cell: int, wanted: int | None = None) -> Patch:
        """Return at least the first ``wanted`` blades of a cell, or all; drawn by lot once."""
        total = int(self.counts[cell])
        wanted = total if wanted is None else wanted
        patch = self._patches.pop(cell, None)
        while patch is None or len(patch.positions) < min(wanted, total):
            have = 0 if patch is None else len(patch.positions)
            end = self._layer(total, have)
            more = self._grow(cell, have, end)
            patch = more if patch is None else joined([patch, more])
            self._grown += len(more.positions)
            if len(patch.positions) < end:
                # Hardly anything grows here: the cell bears what was found.
                self.counts[cell] = total = len(patch.positions)
        self._patches[cell] = patch
        return patch

    def _forget(self) -> None:
        """Let go of the cells that were not used for longest while too many blades are grown.

        Their lot is the same when they come into view again.
        """
        most = max(KEPT * self._in_view, LEAST)
        while self._grown > most:
            cell = next(iter(self._patches))
            self._grown -= len(self._patches.pop(cell).positions)
            self.counts[cell] = self._shared[cell]

    def _layer(self, total: int, have: int) -> int:
        """Return where the layer that begins at blade ``have`` ends: each doubles the lot."""
        return min(max(LAYER, 2 * have), total) if self._settings.grass.fade else total

    def _roots(self, cell: int, count: int, rng: np.random.Generator) -> np.ndarray:
        """Return ``count`` places x, z (count, 2) in a cell, fewer where hardly anything grows."""
        row, column = divmod(cell, self._across)
        kept: list[np.ndarray] = []
        for _ in range(12):
            xz = (rng.random((4 * count + 8, 2)) + (column, row)) * CELL
            kept.append(xz[rng.random(len(xz)) < self._suits(xz[:, 0], xz[:, 1])])
            if sum(map(len, kept)) >= count:
                break
        return np.concatenate(kept)[:count]

    def _grow(self, cell: int, first: int, last: int) -> Patch:
        """Draw the blades ``first`` to ``last`` of a cell's lot."""
        grass = self._settings.grass
        rng = np.random.default_rng([self._seed, 7, cell, *([first] if first else [])])
        each = max(grass.tufts, 1)
        roots = self._roots(cell, -(-(last - first) // each), rng)
        tuft = np.repeat(np.arange(len(roots)), each)[: last - first]
        angles = rng.random(len(tuft)) * 2 * np.pi
        xz = roots[tuft]
        if grass.tufts:
            # Outwards, the way a blade leans: its tip bends to (sin, cos) of its angle.
            away = TUFT_RADIUS * np.sqrt(rng.random(len(tuft)))
            xz = xz + away[:, None] * np.stack([np.sin(angles), np.cos(angles)], axis=1)
        positions = np.insert(xz, 1, self._ground.field.terrain_height(xz[:, 0], xz[:, 1]), axis=1)
        blades = blade_vertices(positions, angles, grass.scale, grass.arch)
        reach = np.ones(len(xz))
        if grass.fade:
            reach = thinned_reach(int(self.counts[cell]), self._near, grass.radius)
            reach = reach[first : first + len(xz)]
            grown = np.empty((len(xz), 1, 3))
            wider = np.maximum(reach * grass.radius / self._near, 1.0) ** WIDENING
            grown[..., 0] = grown[..., 2] = wider[:, None]
            grown[..., 1] = rng.uniform(0.6, 1.25, (len(xz), 1))
            grown[:, 0, 1] *= 1.0 + grass.variety * self._tallness(roots, rng)[tuft]
            blades = ((blades - positions[:, None]) * grown + positions[:, None]).astype(np.float32)
        tints = np.full((len(xz), 5, 4), 255, np.uint8)
        if grass.tinted:
            colour = self._ground.colour(roots[:, 0], roots[:, 1])
            colour *= 1.0 + grass.variety * (hues(len(roots), rng) - 1.0)
            colour *= 1.0 + grass.variety * meadow(roots[:, 0], roots[:, 1])[:, None] * LUSH
            colour *= self._ground.light(roots[:, 0], roots[:, 1])[:, None]
            tints[..., :3] = blade_tints(colour[tuft], rng, *self._ends)
        return Patch(positions.astype(np.float32), blades, tints, reach.astype(np.float32))

    def _tallness(self, roots: np.ndarray, rng: np.random.Generator) -> np.ndarray:
        """Return how much taller than the mean (0) tufts with these roots (n, 2) are, over -1."""
        own = rng.uniform(-0.35, 0.45, len(roots))
        return np.asarray(own + 0.45 * meadow(roots[:, 0], roots[:, 1]))

    def select(self, frame: Frame, spare: float = 0.0, turn: float = 0.0) -> Patch:
        """Return what to draw: the visible cells' blades, the far cells' thinned out.

        With ``spare`` units and ``turn`` radians, all that is to be drawn until the eye has moved
        and turned by so much.
        """
        self._forget()
        grass, radius = self._settings.grass, self._settings.grass.radius
        cells = cells_around(frame.pose.x, frame.pose.z, radius + spare, self._across)
        middle = (cells + 0.5) * CELL
        y = self._ground.field.terrain_height(middle[:, 0], middle[:, 1])
        centres = np.stack([middle[:, 0], y, middle[:, 1]], axis=1)
        numbers = cells[:, 1] * self._across + cells[:, 0]
        seen = visible_cells(frame, centres, radius, spare, turn) & (self.counts[numbers] > 0)
        nearest = np.hypot(middle[:, 0] - frame.pose.x, middle[:, 1] - frame.pose.z)
        nearest -= CELL * 0.7072 + TUFT_RADIUS + spare
        chosen = []
        for number, distance in zip(numbers[seen].tolist(), nearest[seen].tolist(), strict=True):
            last = int(self.counts[number])
            if grass.fade:
                last = drawn_at(last, self._near, distance)
            patch = self._patch(number, last)
            parts = (patch.positions, patch.blades, patch.tints, patch.reach)
            chosen.append(Patch(*(part[:last] for part in parts)))
        whole = joined(chosen) if chosen else NOTHING
        if grass.fade:
            whole = within(frame, whole, radius, spare)
        self._in_view = len(whole.positions)
        return whole

    def chosen(self, frame: Frame) -> Patch:
        """Return all that is to be drawn in a frame, and a little more.

        The last choice, as long as the eye has not left the room it was made for. What it holds too
        much does not show: it lies outside the window, or its blades have sunk into the ground.
        """
        # Without grass.fade no blade sinks at the end of its reach: each place has its own choice.
        spare, turn = (REUSE_DISTANCE, REUSE_ANGLE) if self._settings.grass.fade else (0.0, 0.0)
        if self._chosen is None or not self._still_holds(frame, spare, turn):
            self._chosen = self.select(frame, spare, turn)
            self._chosen_for = frame, self._settings
        return self._chosen

    def _still_holds(self, frame: Frame, spare: float, turn: float) -> bool:
        assert self._chosen_for is not None
        then, settings = self._chosen_for
        return settings is self._settings and is_near(then, frame, spare, turn)

    def bend(self, frame: Frame, patch: Patch) -> np.ndarray:
        """Return a patch's blades, float32 (n, 5, 3), bent by the wind.

        With ``grass.fade`` a blade sinks into the ground towards the end of its reach.
        """
        grass, places, columns = self._settings.grass, patch.places, patch.columns.copy()
        wind = blade_wind(frame.kt, places.T, grass.scale[0]).astype(np.float32).T
        for vertex, part in WIND:
            columns[vertex, ::2] += part * wind
        away = places[::2] - np.array([[frame.pose.x], [frame.pose.z]], np.float32)
        if grass.facing > 0:
            facing(columns, away, grass.facing)
        if grass.fade:
            reach = np.float32(grass.radius) * patch.reach
            far = np.sqrt(away[0] * away[0] + away[1] * away[1])
            left = np.clip(4.0 * (1.0 - far / reach), 0.0, 1.0)
            columns[2:, 1] = places[1] + (columns[2:, 1] - places[1]) * left
            gone = np.flatnonzero(left <= 0.0)
            columns[..., gone] = places[:, gone]
        return np.ascontiguousarray(columns.transpose(2, 0, 1))

    def draw(self, frame: Frame) -> None:
        """Choose, bend and send the visible blades."""
        patch = self.chosen(frame)
        count = len(patch.positions)
        if not count:
            return
        blades, tints = self.bend(frame, patch), patch.tints
        if len(self._indices) < 9 * count:
            base = 5 * np.arange(2 * count, dtype=np.uint32)[:, None]
            self._indices = np.ascontiguousarray((base + STRIP_TRIANGLES).ravel())
            self._coordinates = np.tile(COORDINATES, (2 * count, 1))
        tinted = tints.reshape(-1, 4) if self._settings.grass.tinted else None
        with attrib(gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT):
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._texture.bind()
            if tinted is not None:
                # Twice texture times tint: a tint can make a blade lighter than its texture.
                gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_COMBINE)
                gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, 2.0)
            if self._settings.grass.method == "loop":
                send_one_by_one(blades, tints if tinted is not None else None)
            else:
                with client_arrays(blades.reshape(-1, 3), None, tinted, [self._coordinates]):
                    gl.glDrawElements(gl.GL_TRIANGLES, 9 * count, gl.GL_UNSIGNED_INT, self._indices)
            if tinted is not None:
                gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, 1.0)
                gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        self._texture.release()
