"""Grass: hundreds of thousands of opaque blades (Grass, section 5.3).

Technique: a blade is a strip of five vertices, no blending and no sorting: the z buffer does it. In
2006 a loop tested every blade each frame. Here the map is cut into cells: a frame tests those
round the walker, and sends the blades of the visible ones with one glDrawElements, their top
vertices moved by the wind. A cell's blades are drawn by lot when it first comes into view, from a
generator of its own: the lot is the same whichever way the walker came, and what is never seen
costs nothing.
State used: GL_TEXTURE_2D.
"""

from dataclasses import dataclass

import numpy as np

from landscape.assets import Assets
from landscape.elements.ground import Ground
from landscape.elements.transparent_elements import sway
from landscape.frame import Frame
from landscape.gl.calls import gl
from landscape.gl.state import attrib, client_arrays
from landscape.gl.texture import Texture, read_image
from landscape.settings import Settings

ELEMENT = "grass"

CELL = 0.5  # chosen: units per side of a cell; small against the radius, large against a blade
WIDENING = 0.3  # chosen: with grass.fade, blades that reach k times NEAR are k**WIDENING as wide
NEAR = 0.75  # chosen: units within which, with grass.fade, every blade is drawn
TALLEST = 0.02  # section 5.3.2: height of the tip in units, before scaling
# A strip of five vertices is three triangles; the winding of the second is turned as in a strip.
STRIP_TRIANGLES = np.array([0, 1, 2, 2, 1, 3, 2, 3, 4], np.uint32)
COORDINATES = np.array([(0, 1), (1, 1), (0.2, 0.3), (0.8, 0.3), (0.5, 0)], np.float32)


def blade_vertices(
    positions: np.ndarray,
    angles: np.ndarray,
    scale: tuple[float, ...] = (1.0, 1.0),
    arch: float = 1.0,
) -> np.ndarray:
    """Return still blades, float32 (n, 5, 3), standing at positions (n, 3), turned by angles (n,).

    ``scale`` = (sx, sy) stretches (x and z, y), as glScalef(sx, sy, sx) in section 5.3.2. The
    report bends the tip alone; an ``arch`` above 1 bends it so many times as far, and the middle
    a third of what is added.
    """
    c, s = np.cos(angles), np.sin(angles)
    zero = np.zeros_like(c)
    middle = 0.004 * (arch - 1.0) / 3.0
    corners = [
        (-0.003 * c, zero, -0.003 * s),
        (0.003 * c, zero, 0.003 * s),
        (-0.0015 * c + middle * s, zero + 0.015, -0.0015 * s + middle * c),
        (0.0015 * c + middle * s, zero + 0.015, 0.0015 * s + middle * c),
        (0.004 * arch * s, zero + TALLEST, 0.004 * arch * c),
    ]
    blades = np.stack([np.stack(corner, axis=1) for corner in corners], axis=1)
    blades *= np.array([scale[0], scale[1], scale[0]])
    return np.ascontiguousarray(blades + positions[:, None, :], np.float32)


def blade_wind(kt: float, positions: np.ndarray, scale_x: float) -> np.ndarray:
    """Return dx, dz (n, 2) of the tips: a fifth of the plants' sway (section 5.3.2)."""
    return sway(kt, positions, scale_x / 5.0)


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


def thinned_reach(count: int, radius: float) -> np.ndarray:
    """Return how far each of a cell's blades is drawn, (count,) in 0..1 times ``radius``, falling.

    All up to NEAR units; beyond, as many as keep the number per pixel the same: the part left at
    distance d is (NEAR / d) squared.
    """
    part = (np.arange(count) + 1.0) / max(count, 1)
    return np.asarray(np.minimum(NEAR / np.sqrt(part) / radius, 1.0))


def visible_cells(frame: Frame, centres: np.ndarray, radius: float) -> np.ndarray:
    """Return a mask (n,) of the cells with centres (n, 3) that may show a blade of grass."""
    reach = CELL * 0.7072 + 0.1
    away = centres - frame.eye
    near = away[:, 0] ** 2 + away[:, 2] ** 2 < (radius + reach) ** 2
    width, height = frame.size
    half = np.tan(np.radians(frame.fov / 2)) * max(width / height, 1.0)
    depth = -frame.depth(centres)
    inside = np.abs(away @ frame.right) <= depth * half + reach * np.hypot(1.0, half)
    return np.asarray(near & inside & (depth > -reach))


@dataclass(frozen=True)
class Patch:
    """The blades of one cell: places (n, 3), still blades (n, 5, 3), tints (n, 5, 4), reach (n,).

    A blade is drawn up to ``reach`` times the radius; the farthest-reaching come first.
    """

    positions: np.ndarray
    blades: np.ndarray
    tints: np.ndarray
    reach: np.ndarray


class Grass:
    """All blades, cell by cell."""

    def __init__(self, settings: Settings, assets: Assets, ground: Ground, seed: int) -> None:
        """Share the blades out over the cells by lot (``seed``)."""
        self._settings, self._ground, self._seed = settings, ground, seed
        self._across = int(np.ceil(ground.field.size / CELL))
        self.counts = self._share()
        self._patches: dict[int, Patch] = {}
        self._texture = Texture(read_image(assets.path("blade.png"), "RGB"), repeat=False)
        self._indices = np.empty(0, np.uint32)
        self._coordinates = np.empty((0, 2), np.float32)

    def _suits(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Return 0..1: land, outside the castle; tinted grass keeps off what is not green."""
        field, castle = self._ground.field, self._settings.castle
        land = (field.bed(x, z) > field.water_level + 0.004).astype(float)
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
        return rng.multinomial(self._settings.grass.count, share / share.sum())

    def _patch(self, cell: int) -> Patch:
        """Return a cell's blades, drawn by lot when first asked for."""
        if cell not in self._patches:
            self._patches[cell] = self._grow(cell)
        return self._patches[cell]

    def _grow(self, cell: int) -> Patch:
        rng = np.random.default_rng([self._seed, 7, cell])
        row, column = divmod(cell, self._across)
        wanted = int(self.counts[cell])
        kept: list[np.ndarray] = []
        for _ in range(12):
            xz = (rng.random((4 * wanted + 8, 2)) + (column, row)) * CELL
            kept.append(xz[rng.random(len(xz)) < self._suits(xz[:, 0], xz[:, 1])])
            if sum(map(len, kept)) >= wanted:
                break
        xz = np.concatenate(kept)[:wanted]
        angles = rng.random(len(xz)) * 2 * np.pi
        positions = np.insert(xz, 1, self._ground.field.bed(xz[:, 0], xz[:, 1]), axis=1)
        grass = self._settings.grass
        blades = blade_vertices(positions, angles, grass.scale, grass.arch)
        reach = np.ones(len(xz))
        if grass.fade:
            reach = thinned_reach(len(xz), grass.radius)
            grown = np.empty((len(xz), 1, 3))
            wider = np.maximum(reach * grass.radius / NEAR, 1.0) ** WIDENING
            grown[..., 0] = grown[..., 2] = wider[:, None]
            grown[..., 1] = rng.uniform(0.6, 1.25, (len(xz), 1))
            blades = ((blades - positions[:, None]) * grown + positions[:, None]).astype(np.float32)
        tints = np.full((len(xz), 5, 4), 255, np.uint8)
        if grass.tinted:
            tints[..., :3] = blade_tints(self._ground.colour(xz[:, 0], xz[:, 1]), rng)
        return Patch(positions.astype(np.float32), blades, tints, reach.astype(np.float32))

    def select(self, frame: Frame) -> list[Patch]:
        """Return what to draw: the visible cells' blades, the far cells' thinned out."""
        radius = self._settings.grass.radius
        cells = cells_around(frame.pose.x, frame.pose.z, radius, self._across)
        middle = (cells + 0.5) * CELL
        y = self._ground.field.bed(middle[:, 0], middle[:, 1])
        centres = np.stack([middle[:, 0], y, middle[:, 1]], axis=1)
        numbers = cells[:, 1] * self._across + cells[:, 0]
        seen = visible_cells(frame, centres, radius) & (self.counts[numbers] > 0)
        nearest = np.hypot(middle[:, 0] - frame.pose.x, middle[:, 1] - frame.pose.z) - CELL
        chosen = []
        for number, distance in zip(numbers[seen].tolist(), nearest[seen].tolist(), strict=True):
            patch = self._patch(number)
            last = int(np.searchsorted(-patch.reach, -distance / radius, side="right"))
            parts = (patch.positions, patch.blades, patch.tints, patch.reach)
            if last:
                chosen.append(Patch(*(part[:last] for part in parts)))
        return chosen

    def bend(self, frame: Frame, patches: list[Patch]) -> tuple[np.ndarray, np.ndarray]:
        """Return the blades, float32 (n, 5, 3), bent by the wind, and their tints (n, 5, 4).

        With ``grass.fade`` a blade sinks into the ground towards the end of its reach.
        """
        grass = self._settings.grass
        positions = np.concatenate([patch.positions for patch in patches])
        blades = np.concatenate([patch.blades for patch in patches])
        wind = blade_wind(frame.kt, positions, grass.scale[0]).astype(np.float32)
        for vertex, part in ((2, 0.5), (3, 0.5), (4, 1.0)):
            blades[:, vertex, ::2] += np.float32(part) * wind
        if grass.fade:
            reach = grass.radius * np.concatenate([patch.reach for patch in patches])
            away = np.hypot(positions[:, 0] - frame.pose.x, positions[:, 2] - frame.pose.z)
            height = np.clip((reach - away) / (0.25 * reach), 0.0, 1.0).astype(np.float32)
            base = positions[:, None, 1]
            blades[:, 2:, 1] = base + (blades[:, 2:, 1] - base) * height[:, None]
        return blades, np.concatenate([patch.tints for patch in patches])

    def draw(self, frame: Frame) -> None:
        """Choose, bend and send the visible blades."""
        patches = self.select(frame)
        if not patches:
            return
        blades, tints = self.bend(frame, patches)
        count = len(blades)
        if len(self._indices) < 9 * count:
            base = 5 * np.arange(2 * count, dtype=np.uint32)[:, None]
            self._indices = np.ascontiguousarray((base + STRIP_TRIANGLES).ravel())
            self._coordinates = np.tile(COORDINATES, (2 * count, 1))
        with attrib(gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT):
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._texture.bind()
            tinted = tints.reshape(-1, 4) if self._settings.grass.tinted else None
            with client_arrays(blades.reshape(-1, 3), None, tinted, [self._coordinates]):
                gl.glDrawElements(gl.GL_TRIANGLES, 9 * count, gl.GL_UNSIGNED_INT, self._indices)
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        self._texture.release()


def greenness(colour: np.ndarray) -> np.ndarray:
    """Return 0..1, how much grass a ground of colours (n, 3) in 0..1 would bear."""
    red, green, blue = np.asarray(colour).T
    excess = green - 0.5 * (red + blue)
    return np.asarray(np.clip((excess - 0.01) / 0.05, 0.0, 1.0))


def blade_tints(colour: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Return tints, uint8 (n, 5, 3): the ground's colours (n, 3), lighter, darker at the foot.

    The foot takes about the ground's own colour, so that no blade seems stuck on.
    """
    light = np.clip(colour * rng.uniform(1.5, 2.3, (len(colour), 1)), 0, 1)
    tints = np.repeat((light * 255)[:, None, :], 5, axis=1)
    tints[:, :2] *= 0.75
    return tints.astype(np.uint8)
