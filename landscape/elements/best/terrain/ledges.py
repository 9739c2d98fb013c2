"""Ledges, gullies and blocks in steep rock, finer than the height field (``ground.ledges``).

Not in the report. The height field has a vertex every quarter of a unit, so a peak seen from its
foot is a pyramid. Here steep, bare ground rises a little above it, on a grid with FINER times as
many vertices: beds of two thicknesses end in ledges, gullies run down the slope, knobs and small
cracks roughen it. Gullies are white noise averaged along the line of fall, steps of a path at a
time, as streams would run. Nothing rises near the water, on turf or on gentle ground, and nothing
falls below the height field, which is still drawn underneath and closes the edges.

The walker, plants, stones and shadows ask the same sum of both grids for their heights: each stands
on what is drawn. Rules that ask how steep a place is still mean the broad slope, so a plant that
grew there grows there still. No OpenGL here; rock_faces.py draws it.
"""

from dataclasses import dataclass

import numpy as np
from PIL import Image

from landscape.geometry.height_field import HeightField, greenness, lookup
from landscape.geometry.ramp import ramp

FINER = 8  # chosen: cells of the relief along the side of a cell of the height field
# All chosen, in units.
STEEP = (0.30, 0.62)  # rise over run between which ground turns to rock with ledges
ABOVE = (0.03, 0.20)  # above the water, between which ledges begin
TALL, LOW = (0.15, 0.9), 0.3  # above the water; how much of the large relief is on low rock
BEDS = ((0.42, 0.20), (0.13, 0.06))  # thickness of a bed, and how far its ledge stands out
GULLY = 0.20  # depth of a gully
RUN = 13  # steps down the slope over which a gully is one
ROUGH = ((1.1, 0.16), (0.36, 0.06), (0.13, 0.028))  # wavelength and height of knobs
DIP = (0.10, -0.06)  # of the beds along x and z: they do not lie level


@dataclass(frozen=True)
class LedgedField(HeightField):
    """A height field with a relief on it: heights (m, m) on FINER times as many cells, never < 0.

    ``heights`` stay those of the broad ground, ``strength`` and ``seed`` are what it was made with.
    """

    relief: HeightField | None = None
    strength: float = 0.0

    @property
    def made_from(self) -> tuple[str, bytes]:
        """All that a query depends on: the relief follows from the heights and its strength."""
        how, heights = super().made_from
        return f"{how} ledges {self.strength}", heights

    @property
    def broad(self) -> HeightField:
        """The height field without its relief."""
        return HeightField(self.heights, self.size, self.water_level, self.exact)

    def terrain_height(self, x: np.ndarray | float, z: np.ndarray | float) -> np.ndarray:
        """Return the height at x, z in units, relief included; clamped outside."""
        height = super().terrain_height(x, z)
        return height if self.relief is None else height + self.relief.terrain_height(x, z)

    def _rises(self, x: np.ndarray | float, z: np.ndarray | float) -> tuple[np.ndarray, np.ndarray]:
        """Return how far the broad ground rises over a cell around x, z."""
        return self.broad._rises(x, z)


def enlarged(values: np.ndarray, side: int) -> np.ndarray:
    """Return values (n, n) as float32 (side, side), smoothly interpolated."""
    image = Image.fromarray(np.ascontiguousarray(values, np.float32))
    return np.asarray(image.resize((side, side), Image.Resampling.BICUBIC))


def noise(rng: np.random.Generator, length: float, side: int, unit: float) -> np.ndarray:
    """Return smooth noise (side, side) of about -1..1, waves of ``length``, ``unit`` a texel."""
    cells = max(round(side * unit / length * 2.0), 2)
    return enlarged(rng.uniform(-1.0, 1.0, (cells, cells)), side)


def stairs(height: np.ndarray, thickness: float) -> np.ndarray:
    """Return how far beds of a thickness stand out at heights: 0..1, a sharp rise, a slow fall."""
    part = height / thickness
    part = part - np.floor(part)
    return np.asarray(np.minimum(ramp(0.0, 0.22, part), ramp(1.0, 0.3, part)))


def gullies(rng: np.random.Generator, broad: np.ndarray, unit: float) -> np.ndarray:
    """Return 0..1 (m, m), 0 in the beds of gullies, which run down the slopes of ``broad`` (m, m).

    Noise is averaged along the line of fall: at each step twice as far, so few steps reach far.
    """
    side = len(broad)
    fall_z, fall_x = np.gradient(broad)
    length = np.maximum(np.hypot(fall_x, fall_z), 1e-6)
    along_x, along_z = fall_x / length, fall_z / length
    z, x = np.mgrid[0:side, 0:side].astype(np.float32)
    found = noise(rng, 0.5, side, unit) + 0.5 * noise(rng, 0.2, side, unit)
    step = 1.0
    while step < RUN:
        ahead, behind = (
            lookup(found, (x + way * along_x) / side, (z + way * along_z) / side)
            for way in (step, -step)
        )
        found = (found + ahead + behind) / 3.0
        step *= 2.0
    found = found / max(float(found.std()), 1e-6)
    return np.asarray(1.0 - np.exp(-np.abs(found) * 1.6))


def widest(values: np.ndarray) -> np.ndarray:
    """Return the greatest of each value (n, n) and of its eight neighbours."""
    n = len(values)
    around = np.pad(values, 1, "edge")
    shifts = [around[r : r + n, c : c + n] for r in range(3) for c in range(3)]
    return np.asarray(np.max(shifts, axis=0))


def relief(field: HeightField, colours: np.ndarray, strength: float, seed: int = 5) -> np.ndarray:
    """Return heights over the field, float32 (m, m), >= 0; ``colours``, uint8 (n, n, 3), its map.

    Row along z and column along x, as the field's.
    """
    cells = len(field.heights) - 1
    side = cells * FINER + 1
    unit = field.size / (side - 1)
    rng = np.random.default_rng([seed, 81])
    at = np.arange(cells + 1) / cells
    rise_z, rise_x = np.gradient(field.heights.astype(np.float64), field.size / cells)
    small = np.array(Image.fromarray(colours).resize((cells + 1,) * 2, Image.Resampling.BOX))
    bare = 1.0 - greenness(small.reshape(-1, 3) / 255.0).reshape(small.shape[:2])
    # A summit and the floor of a notch are level, but among steep rock.
    steep = widest(ramp(*STEEP, np.hypot(rise_x, rise_z))) * ramp(0.4, 0.9, bare)
    rock = steep * ramp(*ABOVE, field.heights - field.water_level)
    border = np.minimum(at, 1.0 - at) > 2.0 / cells
    rock = np.where(border[:, None] & border[None, :], rock, 0.0)
    rough = noise(rng, 0.5, side, unit)
    share = ramp(0.12, 0.6, enlarged(rock, side) + 0.18 * rough)
    share *= enlarged(rock, side) > 0.02

    fine = np.arange(side) / (side - 1) * field.size
    broad = field.terrain_height(fine[None, :], fine[:, None]).astype(np.float32)
    bed = broad + DIP[0] * fine[None, :] + DIP[1] * fine[:, None]
    bed = bed + 0.22 * noise(rng, 2.5, side, unit) + 0.07 * rough
    found = np.zeros((side, side))
    # What is low has low relief: on a bank half a unit high a knob of a peak would be a hill.
    tall = ramp(*TALL, broad - field.water_level)
    low = LOW + (1.0 - LOW) * tall
    same = np.ones_like(low)
    for (thickness, out), patch, grows in zip(BEDS, (3.0, 0.9), (low, same), strict=True):
        here = ramp(-0.7, 0.3, noise(rng, patch, side, unit))
        found += out * grows * here * stairs(bed, thickness)
    for (length, height), grows in zip(ROUGH, (low, low, same), strict=True):
        found += height * grows * (1.0 - np.abs(noise(rng, length, side, unit)) * 1.3)
    # A gully is wider than two cells: half as many along each side are enough.
    half = (side + 1) // 2
    gully = enlarged(gullies(rng, enlarged(field.heights, half), 2.0 * unit), side)
    found += GULLY * low * gully
    return np.maximum(strength * share * found, 0.0).astype(np.float32)
