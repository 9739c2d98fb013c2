"""Ledges in rock, a tideline on the beach, ragged edges of turf: painted into the large texture.

The large texture colours rock by slope and height, and the detail texture repeats; between the two
there is nothing a few strides wide (``ground.weathered``). Here rock gets the pattern of its detail
texture once more, ten times as large, laid upright from two sides by the slope, and ledges along
lines of equal height. It is done once, not in each frame. No OpenGL here.
"""

import numpy as np
from PIL import Image

from landscape.geometry.height_field import HeightField
from landscape.geometry.ramp import ramp

# All chosen.
COARSE = 256  # side of the reduced rock pattern
PERIOD = 3.1  # units per repeat of it
STEEP = (0.28, 0.55)  # slopes between which ground turns to rock
PATTERN = 0.8  # strength of the pattern
LAYERS = 7.5  # ledges per unit of height
UNDERCUT, RIM = 0.42, 0.22  # how dark the foot of a ledge is, and how light its edge
DARKEST, LIGHTEST = 0.5, 1.18
TIDES = ((0.060, 0.010, 1.0), (0.024, 0.005, 0.6))  # units above the water, half width, strength
GREY = np.array((0.355, 0.337, 0.308), np.float32)  # hue of rock
SOFTER = 10  # texels over which the colours of steep ground are blurred
PALEST = 0.46  # lighter rock, in 0..1, is halfway to this
WEED = (0.66, 0.60, 0.51)  # factor on sand under dry weed
NARROW = 0.1  # units, half the width of a line of weed at most: flat sand would be brown all over
# Sand on the bed of shallow water: its colour, which wet.py will darken, and the units above the
# water between which the painted bed turns to sand, and sand to the colour of the sea floor that
# shallows.py draws below. Where it is steep, rock stays.
BED, FLOOR = (235.0, 218.0, 178.0), (82.0, 112.0, 106.0)
BEDDED = (0.004, -0.012)
DEEP_BED = (-0.08, -0.34)
LOWEST = -0.5
RAGGED = 1.6  # how far noise moves the edges of turf


def noise(seed: int, cells: int, side: int) -> np.ndarray:
    """Return smooth noise, float32 (side, side), of mean about 0 and deviation about 1.

    It is 0 everywhere if there is one cell or one texel alone.
    """
    cells = max(cells, 1)
    values = np.random.default_rng([seed, cells]).standard_normal((cells, cells))
    image = Image.fromarray(values.astype(np.float32))
    found = np.asarray(image.resize((side, side), Image.Resampling.BICUBIC))
    deviation = found.std()
    return np.asarray(found / deviation) if deviation > 1e-3 else np.zeros_like(found)


def enlarged(values: np.ndarray, side: int) -> np.ndarray:
    """Return values at the vertices, (n, n), at the middles of side x side texels."""
    n = len(values)
    image, box = Image.fromarray(values.astype(np.float32)), (0.5, 0.5, n - 0.5, n - 0.5)
    return np.asarray(image.resize((side, side), Image.Resampling.BICUBIC, box))


def weathered(
    colours: np.ndarray, turf: np.ndarray, field: HeightField, rock: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return colours, uint8 (n, n, 3), and the fraction of turf, uint8 (n, n, 1), weathered.

    ``rock``, uint8 (m, m, 3), is the detail texture of rock.
    """
    land = Land(field, len(colours))
    bare = 1.0 - turf[..., 0] / np.float32(255.0)
    stony = ramp(*STEEP, land.slope) * (0.25 + 0.75 * bare) * ramp(-0.15, -0.02, land.above)
    rows, columns = np.nonzero(stony > 0.02)
    at = rows, columns

    factor = np.ones((*stony.shape, 3), np.float32)
    relief = land.relief(rock, rows, columns)
    factor[at] = np.clip(1.0 + stony[at] * relief, DARKEST, LIGHTEST)[:, None]
    flat = bare * ramp(0.3, 0.15, land.slope)
    for tide in TIDES:
        factor *= 1.0 - land.weed(flat, *tide)[..., None] * (1.0 - np.array(WEED, np.float32))
    # Sand is blown into low dunes, which the sun lights from one side.
    dune = flat * ramp(0.03, 0.1, land.above)
    factor *= (1.0 + 0.03 * dune * (land.broad + 1.2 * land.fine))[..., None]

    # No sand lies on steep ground: it is rock, whatever its colour was.
    steep = stony[at] * ramp(0.35, 0.6, land.slope[at])
    painted = colours.copy()
    painted[at] = rocky(colours, at, steep[:, None]) + 0.5
    painted = on_sand(painted, land.above, land.slope, land.broad + land.fine)
    shaded = np.clip(painted * factor + 0.5, 0, 255).astype(np.uint8)
    return shaded, ragged(turf, land.fine)


class Land:
    """Heights and slopes at the texels of a picture, and noise over it, (side, side) each."""

    def __init__(self, field: HeightField, side: int) -> None:
        """Compute them for ``side`` texels along the land's side."""
        cell = np.float32(field.size / (len(field.heights) - 1))
        rise_z, rise_x = (np.asarray(each) for each in np.gradient(field.heights, cell))
        self._side, self._unit = side, field.size / side
        self._heights = enlarged(field.heights, side)
        self._rise_x, self._rise_z = enlarged(rise_x, side), enlarged(rise_z, side)
        self.above = self._heights - field.water_level
        self.slope = np.hypot(self._rise_x, self._rise_z)
        self.fine = 0.6 * noise(1, side // 3, side) + 0.5 * noise(2, side // 9, side)
        self.broad = noise(3, side // 60, side)

    def relief(self, rock: np.ndarray, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
        """Return the shade (k,) of rock at texels, a factor less 1: its pattern, and ledges."""
        at = rows, columns
        x, z = (columns + 0.5) * self._unit, (rows + 0.5) * self._unit
        shade = upright(rock, x, z, self._heights[at], self._rise_x[at], self._rise_z[at])

        layer = LAYERS * self._heights[at] + 0.3 * self.broad[at] + 0.12 * self.fine[at]
        layer -= np.floor(layer)
        ledge = RIM * ramp(0.7, 0.95, layer) - UNDERCUT * ramp(0.30, 0.05, layer)
        ledge *= ramp(-0.6, 0.6, noise(4, self._side // 22, self._side)[at])
        return shade + ledge

    def weed(self, flat: np.ndarray, height: float, half: float, strength: float) -> np.ndarray:
        """Return how much dry weed a tide has left on ``flat`` ground, 0..1."""
        half = np.minimum(half, NARROW * np.maximum(self.slope, 0.02))
        line = (self.above - height - 0.014 * self.broad - 0.004 * self.fine) / half
        return np.asarray(strength * flat * np.exp(-line * line) * ramp(-0.6, 0.5, self.fine))


def rocky(colours: np.ndarray, at: tuple[np.ndarray, np.ndarray], steep: np.ndarray) -> np.ndarray:
    """Return the colours of some texels, float32 (k, 3), as those of rock where it is ``steep``.

    Their fine shades were painted from above and would be streaks on it, so they are blurred.
    """
    side = len(colours)
    small = max(side // SOFTER, 1)
    reduced = Image.fromarray(colours).resize((small, small), Image.Resampling.BOX)
    soft = np.asarray(reduced.resize((side, side), Image.Resampling.BICUBIC))
    own = colours[at].astype(np.float32)
    own += steep * (soft[at] - own)

    light = own @ np.full(3, 1 / 3, np.float32)
    grey = np.minimum(light, 0.5 * light + 0.5 * 255 * PALEST)[:, None] * 3.0 * GREY
    return np.asarray(own + steep * (grey - own))


def ragged(turf: np.ndarray, fine: np.ndarray) -> np.ndarray:
    """Return the fraction of turf, uint8 (n, n, 1), its edges moved by noise."""
    edge = turf[..., 0] / np.float32(255.0)
    edge = edge + RAGGED * fine * edge * (1.0 - edge)
    sharp = np.clip((edge - 0.5) * 1.5 + 0.5, 0.0, 1.0)
    return (255.0 * sharp + 0.5).astype(np.uint8)[..., None]


def on_sand(
    colours: np.ndarray, above: np.ndarray, slope: np.ndarray, shade: np.ndarray
) -> np.ndarray:
    """Return colours, (n, n, 3), with sand on the bed of shallow water, paler than the deep bed.

    ``above`` (n, n) is the height above the water in units, ``shade`` noise of deviation about 1.
    """
    bed = (above < BEDDED[0]) & (above > LOWEST)
    height = above[bed]
    deep = ramp(*DEEP_BED, height)[:, None]
    share = np.maximum(ramp(0.6, 0.3, slope[bed]), deep[:, 0]) * ramp(*BEDDED, height)
    sand = np.array(BED, np.float32) * (1.0 + 0.05 * shade[bed][:, None])
    sand += deep * (np.array(FLOOR, np.float32) - sand)
    found = colours.astype(np.float32)
    found[bed] += share[:, None] * (sand - found[bed])
    return found


def upright(
    rock: np.ndarray,
    x: np.ndarray,
    z: np.ndarray,
    y: np.ndarray,
    rise_x: np.ndarray,
    rise_z: np.ndarray,
) -> np.ndarray:
    """Return the shade of rock (k,) at x, y, z: a factor less 1; ``rise_x`` = dy/dx, and in z.

    It is seen from the side along x and along z, as much as the ground faces each.
    """
    image = Image.fromarray(rock).convert("L").resize((COARSE,) * 2, Image.Resampling.BOX)
    pattern = np.asarray(image, np.float32) / np.float32(127.5)
    pattern = PATTERN * (pattern - pattern.mean())
    texels = COARSE / PERIOD

    def look(along: np.ndarray) -> np.ndarray:
        s, t = (np.floor(each * texels).astype(int) % COARSE for each in (along, -y))
        return pattern[t, s]

    across, along = rise_x * rise_x, rise_z * rise_z
    share = across / np.maximum(across + along, 1e-6)
    share = ramp(0.3, 0.7, share)
    return np.asarray(share * look(z) + (1.0 - share) * look(x))
