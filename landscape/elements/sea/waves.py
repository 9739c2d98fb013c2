"""The water's arrays: the report's texture coordinates, the mirror's share, the eye's grid, waves.

No OpenGL here: what WaterSurface and Sea send is computed by these functions.
"""

from functools import lru_cache

import numpy as np

from landscape.frame import Frame
from landscape.geometry.mesh import grid_triangles
from landscape.settings import Settings

TWO_PI = 2.0 * np.pi
FRESNEL_POWER = 3.0  # chosen: Schlick has 5, but a rough sea turns mirror sooner

SEEN = 0.45  # chosen: units of depth below which no bottom shows through shallow water

STEP = np.radians(2.0)  # chosen: angle between two lines of the grid, across
RISE = np.radians(0.6)  # chosen: and downwards
MOST = (160, 160)  # chosen: lines across and downwards; wider views take steps twice as large
SPARE = 0.06  # chosen: radians the grid goes on below the window, as waves sink
LOWEST = 0.02  # chosen: units, the least height above the water the grid is made for

# Chosen: waves as length in units, direction in radians (the wind blows to 0.5), and slope.
WAVES = np.array(
    [
        (2.30, 0.35, 0.012), (1.45, 0.90, 0.016), (0.95, 0.05, 0.022), (0.64, 1.35, 0.026),
        (0.43, -0.45, 0.030), (0.29, 0.75, 0.030), (0.20, 2.00, 0.028), (0.135, -0.15, 0.026),
        (0.092, 1.10, 0.024), (0.061, -1.00, 0.020),
    ]
)  # fmt: skip
LENGTHS, STEEP = (WAVES[:, column].astype(np.float32)[:, None] for column in (0, 2))
NUMBERS = 2 * np.pi / WAVES[:, 0]  # radians per unit
HEADINGS = np.stack([np.cos(WAVES[:, 1]), np.sin(WAVES[:, 1])]).astype(np.float32)  # x and z
ALONG_X, ALONG_Z = (NUMBERS * HEADINGS).astype(np.float32)[..., None, None]  # radians per unit
SPEED = 1.3  # chosen: waves in deep water run at a pace of SPEED * sqrt(wave number)
RELIEF_FROM = 0.4  # chosen: units, shorter waves tilt the surface but do not lift it
LIFTING = int((WAVES[:, 0] >= RELIEF_FROM).sum())  # the longest come first
DAMPED = 0.02  # chosen: a wave this weak is left out
MIRRORED = 0.6  # chosen: part of a ripple's tilt that moves the mirror image; 1 is a rough sea
CALM = 0.8  # chosen: part of the way up to the horizon that a ripple may look


def wave_coordinates(plane: np.ndarray, t: float, repeat: float) -> np.ndarray:
    """Return the texture coordinates, float32 (n, 2), at time ``t`` (section 3.2)."""
    px, py = plane
    s = px + 0.01 * np.cos(10 * t - px * TWO_PI * 3) + 0.1 * np.cos(2 * t - py * TWO_PI)
    r = py + 0.01 * np.cos(10 * t - py * TWO_PI * 3) + 0.05 * np.cos(8 * t - py * TWO_PI)
    return np.ascontiguousarray(repeat * np.stack([s, r], axis=1), np.float32)


def cut_level(settings: Settings) -> float:
    """Return the height under which nothing is drawn: the water's, or what it lets one see.

    A mirror image in the framebuffer needs the ground cut at the water; one in a texture does not.
    """
    straight = settings.reflection.enabled and not settings.reflection.rippled
    return settings.water.level - (SEEN if settings.water.shallow and not straight else 0.0)


def opacity(cosine: np.ndarray, alpha: float) -> np.ndarray:
    """Return the water's opacity over the mirror image, by the cosine of the angle of view.

    ``alpha`` straight down; at a grazing angle a third of it, so that the mirror image wins.
    """
    return alpha * (1.0 - 0.67 * (1.0 - cosine) ** FRESNEL_POWER)


def fresnel_alpha(points: np.ndarray, eye: np.ndarray, alpha: float) -> np.ndarray:
    """Return the flat water's opacity (n,) at points (n, 3) seen from ``eye`` (3,)."""
    away = eye - points
    return opacity(np.abs(away[:, 1]) / np.maximum(np.linalg.norm(away, axis=1), 1e-9), alpha)


@lru_cache(maxsize=16)
def triangles_of(columns: int, rows: int) -> np.ndarray:
    """Return the triangles of a grid, uint32 (m, 3), row 0 first; kept, as sizes return."""
    return grid_triangles(columns, rows)


@lru_cache(maxsize=16)
def window_border(fov: float, aspect: float) -> tuple[np.ndarray, np.ndarray]:
    """Return points on the window's border, to the right and up, (68,) each, one unit ahead."""
    top = np.tan(np.radians(fov) / 2)
    along = np.linspace(-1.0, 1.0, 17)
    edge = np.ones_like(along)
    a = top * aspect * np.concatenate([along, along, edge, -edge])
    return a, top * np.concatenate([edge, -edge, along, along])


def view_angles(frame: Frame) -> tuple[float, float, float, float] | None:
    """Return azimuth from, to and depression from, to of what the window shows below the horizon.

    Radians; azimuth 0 is north and grows eastward. None where only sky is in view.
    """
    a, b = window_border(frame.fov, frame.size[0] / frame.size[1])
    yaw, pitch = np.radians(frame.pose.yaw), np.radians(frame.pose.pitch)
    ahead, up = np.cos(pitch) - b * np.sin(pitch), np.sin(pitch) + b * np.cos(pitch)
    low = np.arctan2(-up, np.hypot(ahead, a))
    below = low > 0
    if not below.any():
        return None
    if pitch - np.radians(frame.fov) / 2 <= -np.pi / 2:  # what lies straight under the eye
        return yaw - np.pi, yaw + np.pi, max(float(low.min()), 0.0), np.pi / 2
    away = np.arctan2(a, ahead)
    around = away[low > -0.05]
    first = max(float(low.min()), 0.0)
    return yaw + float(around.min()), yaw + float(around.max()), first, float(low.max())


def lattice(start: float, end: float, step: float, most: int) -> np.ndarray:
    """Return the multiples of ``step`` (doubled until ``most`` suffice) that enclose a range.

    Multiples, so that the grid's lines stay where they are when the viewer turns.
    """
    while (end - start) / step > most - 3:
        step *= 2
    return step * np.arange(np.floor(start / step), np.ceil(end / step) + 1)


def eye_grid(frame: Frame, level: float, reach: float) -> "EyeGrid | None":
    """Return the grid the window's view of the water needs; None where no water is in view."""
    angles = view_angles(frame)
    height = max(frame.eye_y - level, LOWEST)
    horizon = np.arctan(height / reach)
    if angles is None or angles[3] <= horizon:
        return None
    azimuth = lattice(angles[0], angles[1], STEP, MOST[0])
    low = lattice(angles[2], min(1.15 * angles[3] + SPARE, np.pi / 2), RISE, MOST[1])
    step = float(low[1] - low[0])
    low = np.clip(low, horizon, np.pi / 2 - 1e-3)
    return EyeGrid(frame, height, azimuth, low, step)


class EyeGrid:
    """A grid on the water about the eye: rows are rings, far to near, columns are directions.

    ``x``, ``z`` float32 (rows, columns) in units; ``ring`` (rows,) the rings' radii; ``cell`` their
    distance from each other; ``east``, ``south`` (columns,) the directions.
    """

    def __init__(
        self, frame: Frame, height: float, azimuth: np.ndarray, low: np.ndarray, step: float
    ) -> None:
        self.height = height
        self.east = np.sin(azimuth).astype(np.float32)
        self.south = -np.cos(azimuth).astype(np.float32)
        self.ring = (height / np.tan(low)).astype(np.float32)
        self.cell = (np.square(self.ring) + height**2) / height * step
        self.x = np.float32(frame.pose.x) + self.ring[:, None] * self.east
        self.z = np.float32(frame.pose.z) + self.ring[:, None] * self.south

    def keep_within(self, low: float, high: float) -> None:
        """Pull what lies outside the square ``low`` to ``high`` onto its border."""
        np.clip(self.x, low, high, out=self.x)
        np.clip(self.z, low, high, out=self.z)

    @property
    def triangles(self) -> np.ndarray:
        """The grid's triangles, the far ones first."""
        return triangles_of(len(self.east), len(self.ring))


def waves(
    x: np.ndarray, z: np.ndarray, cell: np.ndarray, t: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return height and slopes along x and z, float32 (rows, columns), of the sea at time ``t``.

    ``x`` and ``z`` are places in units; ``cell`` (rows,) is the distance to the next row: a wave
    that a row's cells cannot show is damped there. Rows must come far to near. Only waves longer
    than RELIEF_FROM have height.
    """
    fade = STEEP / (1.0 + np.square(np.square(2.0 / LENGTHS * cell)))
    fade[fade < DAMPED * STEEP] = 0.0
    fade = fade[..., None]
    # Whole turns are taken off before the sum, as 32 bits count them badly.
    turns = (1.7 * np.arange(len(WAVES)) - SPEED * np.sqrt(NUMBERS) * t) % (2 * np.pi)
    # All waves at once: arrays this small cost what it costs to ask for them.
    phase = x * ALONG_X + (z * ALONG_Z + turns.astype(np.float32)[:, None, None])
    slopes = HEADINGS @ (np.cos(phase) * fade).reshape(len(WAVES), -1)
    slope_x, slope_z = slopes.reshape(2, *x.shape)
    high = (np.float32(1.0) / NUMBERS[:LIFTING]).astype(np.float32)
    lift = high @ (np.sin(phase[:LIFTING]) * fade[:LIFTING]).reshape(LIFTING, -1)
    return lift.reshape(x.shape), slope_x, slope_z


def surface_normals(slope_x: np.ndarray, slope_z: np.ndarray) -> np.ndarray:
    """Return the unit normals, float32 (n, 3), of a surface with these slopes, any shape."""
    length = 1.0 / np.sqrt(1.0 + np.square(slope_x) + np.square(slope_z))
    out = np.empty((slope_x.size, 3), np.float32)
    out[:, 0] = -(slope_x * length).ravel()
    out[:, 1] = length.ravel()
    out[:, 2] = -(slope_z * length).ravel()
    return out


def mirror_places(
    grid: EyeGrid, y: np.ndarray, slope_x: np.ndarray, slope_z: np.ndarray
) -> np.ndarray:
    """Return where each vertex looks up the mirror image, float32 (n, 3) in units.

    A mirror tilted by a slope turns the ray by twice that angle. Along the line of sight this
    moves the image up or down by that angle; across it, by the part that the low view leaves.
    """
    along = slope_x * grid.east + slope_z * grid.south
    across = slope_x * -grid.south + slope_z * grid.east
    away = np.hypot(grid.ring, grid.height)[:, None]
    lift = np.minimum(-2.0 * MIRRORED * along * away, CALM * grid.height)
    aside = -2.0 * MIRRORED * across * np.float32(grid.height)
    out = np.empty((grid.x.size, 3), np.float32)
    out[:, 0] = (grid.x - aside * grid.south).ravel()
    out[:, 1] = (y + lift).ravel()
    out[:, 2] = (grid.z + aside * grid.east).ravel()
    return out


def facing(grid: EyeGrid, slope_x: np.ndarray, slope_z: np.ndarray) -> np.ndarray:
    """Return the cosine between each facet's normal and the line of sight, (rows, columns)."""
    along = slope_x * grid.east + slope_z * grid.south
    away = np.hypot(grid.ring, grid.height)[:, None]
    return np.clip((grid.height + along * grid.ring[:, None]) / away, 0.0, 1.0)
