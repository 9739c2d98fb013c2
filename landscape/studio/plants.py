"""How leaves and limbs are lit and drawn; a fern for the crossed quads; one blade of grass.

Limbs are tapered cylinders with bark; leaves and needles are folded kites. All go into one depth
buffer at four times the final size. The light that reaches them is the sun and the sky, attenuated
exponentially by the leaf area met on the way (Beer and Lambert), which a coarse grid of densities
records. :mod:`landscape.studio.trees` uses the same functions.

The fern is a rosette of fronds: each midrib is a curve whose lean from the vertical grows with its
length, as a leaf's does that bends under its own weight, and carries two rows of pinnae, each a
row of overlapping lobes. The blade's axes are across and along it.

World frame of a sprite: x right in -1..1, y up in 0..2 (0 is the ground), z towards the viewer.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numba import njit
from scipy import ndimage

from landscape.studio.images import bleed, shrink, smoothstep, spectral_noise, to_srgb, to_uint8
from landscape.studio.light import GROUND_BOUNCE, SKY_COLOR, SPRITE_SUN, SUN_COLOR

SIZE = 512  # texels per side of a sprite
SUPERSAMPLING = 4  # per axis: sixteen samples a texel give the smooth edge of alpha
GRID = 96  # chosen: cells of the density grid per axis, about five texels each
GRID_LOW = np.array([-1.15, -0.15, -1.15])  # chosen: a little more than the sprite's frame
GRID_SPAN = 2.3
SUN_GAIN = 2.3  # chosen: exposure, full sun on a leaf comes out at about 60 % of white
SKY_GAIN = 1.15  # chosen: the shaded side stays readable against a bright sky
SUN_SCREEN = (float(SPRITE_SUN[0]), float(-SPRITE_SUN[1]), float(SPRITE_SUN[2]))  # rows grow down
SKY_DIRECTIONS = np.array(  # chosen: the sky seen through the crown, and the viewer's own direction
    [
        [0.0, 1.0, 0.0],
        [-0.77, 0.64, 0.0],
        [0.77, 0.64, 0.0],
        [0.0, 0.64, -0.77],
        [0.0, 0.64, 0.77],
        [0.0, 0.1, 1.0],
    ]
)
FRONDS = 26  # chosen: dense enough to hide the line where the quads cross
PITCH_RAD = 0.30  # chosen: the tuft is seen a little from above, as from a walker's height
EXTINCTION = 0.5  # chosen: the inside of the tuft is dark, the tips are not
STALK_ALBEDO = np.array([0.13, 0.14, 0.045])  # chosen: green-brown midribs
LOBES = np.array([0.20, 0.38, 0.56, 0.74])  # chosen: where along a pinna its four kites sit
BLADE_SIZE = 64


def sprite(premultiplied: np.ndarray) -> np.ndarray:
    """Turn linear premultiplied RGBA (h, w, 4) into a straight-alpha sRGB sprite whose border is
    clear, but for the last row, where it stands, and whose colours bleed outward."""
    alpha = premultiplied[..., 3:]
    straight = to_srgb(premultiplied[..., :3] / np.maximum(alpha, 1e-6))
    rgba = to_uint8(np.concatenate([straight, alpha], -1))
    rgba[0, :, 3] = rgba[:, 0, 3] = rgba[:, -1, 3] = 0
    return bleed(rgba)


@dataclass
class Canvas:
    """A supersampled picture: linear colour (h, w, 3) and depth (h, w), larger is nearer."""

    colour: np.ndarray
    depth: np.ndarray

    @classmethod
    def blank(cls, size: int = SIZE) -> "Canvas":
        side = size * SUPERSAMPLING
        return cls(np.zeros((side, side, 3), np.float32), np.full((side, side), -1e9, np.float32))

    def to_screen(self, points: np.ndarray) -> np.ndarray:
        """World points (..., 3) to sample coordinates: columns, rows, depth."""
        half = self.depth.shape[0] / 2
        return np.stack(
            [(points[..., 0] + 1) * half, (2 - points[..., 1]) * half, points[..., 2] * half], -1
        )

    def finish(self) -> np.ndarray:
        """Reduce to a sprite (size, size, 4)."""
        covered = (self.depth > -1e8)[..., None].astype(np.float32)
        small = shrink(np.concatenate([self.colour * covered, covered], -1), SUPERSAMPLING)
        return sprite(small)


@njit
def fill_triangles(colour, depth, corners, shades):  # type: ignore[no-untyped-def]
    """Draw (n, 3, 3) screen triangles with linear colours (n, 3, 3) at their corners."""
    h, w = depth.shape
    for i in range(corners.shape[0]):
        x0, y0, z0 = corners[i, 0]
        x1, y1, z1 = corners[i, 1]
        x2, y2, z2 = corners[i, 2]
        area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
        if abs(area) < 1e-9:
            continue
        for row in range(max(0, int(min(y0, y1, y2))), min(h, int(max(y0, y1, y2)) + 1)):
            y = row + 0.5
            for column in range(max(0, int(min(x0, x1, x2))), min(w, int(max(x0, x1, x2)) + 1)):
                x = column + 0.5
                b = ((x - x0) * (y2 - y0) - (x2 - x0) * (y - y0)) / area
                c = ((x1 - x0) * (y - y0) - (x - x0) * (y1 - y0)) / area
                a = 1.0 - b - c
                if a < 0.0 or b < 0.0 or c < 0.0:
                    continue
                z = a * z0 + b * z1 + c * z2
                if z > depth[row, column]:
                    depth[row, column] = z
                    for k in range(3):
                        colour[row, column, k] = (
                            a * shades[i, 0, k] + b * shades[i, 1, k] + c * shades[i, 2, k]
                        )


@njit
def fill_limbs(  # type: ignore[no-untyped-def]
    colour, depth, ends, radii, along, turns, lights, bark, twig, sun, sky, bounce
):
    """Draw tapered cylinders with bark.

    ends (n, 2, 3) in screen samples, radii (n, 2) in samples, along (n, 2) the distance from the
    ground in texels of ``bark`` (m, m, 4: colour, relief), turns (n,) the texel round the limb that
    faces the viewer, lights (n, 2, 2) the parts of the sun and of the sky that reach both ends.
    Limbs thinner than ten samples take the colour ``twig``. sun, sky and bounce are colours of
    light.
    """
    h, w = depth.shape
    m = bark.shape[0]
    texel = np.zeros(4)
    lx, ly, lz = SUN_SCREEN
    for i in range(ends.shape[0]):
        ax, ay, az = ends[i, 0]
        bx, by, bz = ends[i, 1]
        dx, dy, dz = bx - ax, by - ay, bz - az
        flat = np.sqrt(dx * dx + dy * dy)
        length = np.sqrt(flat * flat + dz * dz)
        if length < 1e-6:
            continue
        thick = max(radii[i, 0], radii[i, 1])
        if flat < 1e-4:
            px, py = 1.0, 0.0
        else:
            px, py = -dy / flat, dx / flat
        # The direction across the limb that looks at the viewer: axis x across.
        qx, qy, qz = -dz * py / length, dz * px / length, (dx * py - dy * px) / length
        if qz < 0:
            qx, qy, qz = -qx, -qy, -qz
        for row in range(max(0, int(min(ay, by) - thick)), min(h, int(max(ay, by) + thick) + 1)):
            for column in range(
                max(0, int(min(ax, bx) - thick)), min(w, int(max(ax, bx) + thick) + 1)
            ):
                x, y = column + 0.5 - ax, row + 0.5 - ay
                t = 0.0
                if flat > 1e-4:
                    t = min(1.0, max(0.0, (x * dx + y * dy) / (flat * flat)))
                r = radii[i, 0] + (radii[i, 1] - radii[i, 0]) * t
                ox, oy = x - t * dx, y - t * dy
                if ox * ox + oy * oy > r * r:
                    continue
                s = min(1.0, max(-1.0, (ox * px + oy * py) / r))
                up = np.sqrt(max(0.0, 1.0 - s * s))
                z = az + t * dz + r * up
                if z <= depth[row, column]:
                    continue
                # Neighbours' caps overlap: past its ends a limb's bark runs on, or it would smear.
                t = (x * dx + y * dy) / (flat * flat) if flat > 1e-4 else 0.0
                t = min(2.0, max(-1.0, t))
                fu = (np.arcsin(s) * r + turns[i]) % m
                fv = (along[i, 0] + (along[i, 1] - along[i, 0]) * t) % m
                u0, v0 = int(fu) % m, int(fv) % m
                u1, v1 = (u0 + 1) % m, (v0 + 1) % m
                wu, wv = fu - int(fu), fv - int(fv)
                for k in range(4):
                    above = bark[v0, u0, k] * (1 - wu) + bark[v0, u1, k] * wu
                    below = bark[v1, u0, k] * (1 - wu) + bark[v1, u1, k] * wu
                    texel[k] = above * (1 - wv) + below * wv
                s = min(0.99, max(-0.99, s + texel[3] * min(1.0, r / 12.0)))
                up = np.sqrt(1.0 - s * s)
                nx, ny, nz = px * s + qx * up, py * s + qy * up, qz * up
                t = min(1.0, max(0.0, t))
                sunlit = lights[i, 0, 0] + (lights[i, 1, 0] - lights[i, 0, 0]) * t
                open_sky = lights[i, 0, 1] + (lights[i, 1, 1] - lights[i, 0, 1]) * t
                lit = max(0.0, nx * lx + ny * ly + nz * lz) * sunlit
                fill = (0.55 - 0.45 * ny) * open_sky
                back = (0.5 + 0.5 * ny) * open_sky
                depth[row, column] = z
                for k in range(3):
                    tone = twig[k] + (texel[k] - twig[k]) * min(1.0, max(0.0, (r - 3.0) / 7.0))
                    colour[row, column, k] = tone * (
                        sun[k] * lit + sky[k] * fill + bounce[k] * back
                    )


@njit
def optical_depth(density, points, direction, step, reach):  # type: ignore[no-untyped-def]
    """Leaf area (n,) met from each of the points (n, 3), in cells, along a direction (3,)."""
    n = density.shape[0]
    total = np.zeros(points.shape[0])
    for i in range(points.shape[0]):
        for k in range(1, reach):
            x = int(points[i, 0] + direction[0] * step * k)
            y = int(points[i, 1] + direction[1] * step * k)
            z = int(points[i, 2] + direction[2] * step * k)
            if x < 0 or y < 0 or z < 0 or x >= n or y >= n or z >= n:
                break
            total[i] += density[x, y, z] * step
    return total


def unit(vectors: np.ndarray) -> np.ndarray:
    """Scale vectors (..., 3) to length 1."""
    return vectors / (np.linalg.norm(vectors, axis=-1, keepdims=True) + 1e-12)


@dataclass
class Leaves:
    """Kites: centres, axes, normals (n, 3), lengths and widths (n,), albedo (n, 3), linear."""

    centre: np.ndarray
    axis: np.ndarray
    normal: np.ndarray
    length: np.ndarray
    width: np.ndarray
    albedo: np.ndarray


def light_at(
    density: np.ndarray, points: np.ndarray, extinction: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return the parts (n,) of the sun and of the sky that reach world points (n, 3)."""
    cells = (points - GRID_LOW) / GRID_SPAN * GRID
    step, reach = 0.9, int(GRID * 0.8)
    sun = np.exp(-extinction * optical_depth(density, cells, SPRITE_SUN, step, reach))
    sky = np.zeros(len(points))
    for direction in SKY_DIRECTIONS:
        way = direction / np.linalg.norm(direction)
        sky += np.exp(-0.7 * extinction * optical_depth(density, cells, way, step, reach))
    return sun, sky / len(SKY_DIRECTIONS)


def foliage_density(leaves: Leaves) -> np.ndarray:
    """Leaf area per cell (GRID, GRID, GRID), in areas of a cell's face."""
    cell = GRID_SPAN / GRID
    index = np.clip(((leaves.centre - GRID_LOW) / cell).astype(int), 0, GRID - 1)
    density = np.zeros((GRID, GRID, GRID))
    np.add.at(density, tuple(index.T), 0.5 * leaves.length * leaves.width / cell**2)
    return ndimage.gaussian_filter(density, 0.7)


def draw_leaves(canvas: Canvas, leaves: Leaves, density: np.ndarray, extinction: float) -> None:
    """Light the kites and draw them: four triangles each, folded along the midrib."""
    sun, sky = light_at(density, leaves.centre, extinction)
    # The crown's own normal, from the density's slope: without it a crown of leaves that point
    # everywhere is lit evenly and looks flat.
    soft = ndimage.gaussian_filter(density, 3.0)
    cells = ((leaves.centre - GRID_LOW) / GRID_SPAN * GRID).T
    crown = unit(
        -np.stack([ndimage.map_coordinates(g, cells, order=1) for g in np.gradient(soft)], -1)
    )
    across = unit(np.cross(leaves.axis, leaves.normal))
    half_length, half_width = leaves.length[:, None] / 2, leaves.width[:, None] / 2
    base = leaves.centre - leaves.axis * half_length
    tip = leaves.centre + leaves.axis * half_length
    corners, shades = [], []
    for side in (-1.0, 1.0):
        rise = leaves.normal * half_width * 0.35
        low = (
            leaves.centre
            - leaves.axis * half_length * 0.45
            + side * across * half_width * 0.92
            + rise
        )
        high = (
            leaves.centre
            + leaves.axis * half_length * 0.3
            + side * across * half_width * 0.8
            + rise
        )
        normal = unit(leaves.normal - 0.35 * side * across)
        normal *= np.where(normal[:, 2:] < 0, -1.0, 1.0)
        facing = normal @ SPRITE_SUN
        wrapped = np.clip(0.35 + 0.65 * (crown @ SPRITE_SUN), 0.0, 1.0)
        reflected = (0.45 * np.maximum(facing, 0.0) + 0.55 * wrapped) * sun
        through = np.maximum(-facing, 0.0) * sun
        up = 0.55 + 0.45 * crown[:, 1]
        lit = leaves.albedo * (
            SUN_GAIN * SUN_COLOR * reflected[:, None]
            + SKY_GAIN * SKY_COLOR * (sky * up)[:, None]
            + GROUND_BOUNCE * (sky * (1.0 - up))[:, None]
        )
        # Light that crosses a leaf loses its blue: the yellow glow of a crown against the sun.
        lit += leaves.albedo * np.array([1.25, 1.1, 0.4]) * SUN_COLOR * through[:, None] * 1.1
        gloss = np.maximum(normal @ unit(SPRITE_SUN + np.array([0.0, 0.0, 1.0])), 0.0) ** 24
        lit += (0.10 * gloss * sun)[:, None] * SUN_COLOR
        corners += [np.stack([base, low, high], 1), np.stack([base, high, tip], 1)]
        shades += [
            np.stack([lit * 0.7, lit, lit * 1.1], 1),
            np.stack([lit * 0.7, lit * 1.1, lit], 1),
        ]
    screen = canvas.to_screen(np.concatenate(corners))
    fill_triangles(canvas.colour, canvas.depth, screen, np.concatenate(shades).astype(np.float32))


def draw_limbs(
    canvas: Canvas,
    ends: np.ndarray,
    radii: np.ndarray,
    lights: np.ndarray,
    bark: np.ndarray,
    twig: np.ndarray,
    along: np.ndarray,
    turns: np.ndarray,
) -> None:
    """Draw limbs with ends (n, 2, 3) and radii (n, 2) in world units; the rest as for
    :func:`fill_limbs`, along (n, 2) in world units."""
    half = canvas.depth.shape[0] / 2
    fill_limbs(
        canvas.colour,
        canvas.depth,
        canvas.to_screen(ends),
        radii * half,
        along * half,
        turns,
        lights,
        bark,
        twig,
        SUN_GAIN * SUN_COLOR,
        SKY_GAIN * SKY_COLOR,
        GROUND_BOUNCE,
    )


def light_on_limbs(density: np.ndarray, ends: np.ndarray, extinction: float) -> np.ndarray:
    """Return the parts of the sun and of the sky (n, 2, 2) that reach the ends (n, 2, 3)."""
    return np.stack(light_at(density, ends.reshape(-1, 3), extinction), -1).reshape(-1, 2, 2)


def midrib(length: float, lean: float, bend: float, azimuth: float, count: int) -> np.ndarray:
    """Points (count, 3) along a midrib: its angle from the vertical is lean + bend s**1.4."""
    s = np.linspace(0.0, 1.0, count)
    theta = lean + bend * s**1.4
    out = np.cumsum(np.sin(theta)) * length / count
    up = np.cumsum(np.cos(theta)) * length / count
    return np.stack([out * np.cos(azimuth), up, out * np.sin(azimuth)], 1)


def frond(path: np.ndarray, roll: float, size: float, rng: np.random.Generator) -> Leaves:
    """The small leaves of one frond along its midrib ``path`` (n, 3); ``size`` is the length of the
    longest pinna; ``roll`` (radians) turns the frond's plane about the midrib."""
    n = len(path)
    tangent = unit(np.gradient(path, axis=0))
    flat = unit(np.cross(tangent, np.array([0.0, 1.0, 0.0])) + 1e-6)
    over = np.cross(flat, tangent)
    span = flat * np.cos(roll) + over * np.sin(roll)
    face = np.cross(span, tangent)
    face *= np.where(face[:, 1:2] < 0, -1.0, 1.0)
    parts: list[Leaves] = []
    tone = rng.uniform(0.82, 1.15)
    gap = float(np.linalg.norm(path[-1] - path[-2]))
    for i in range(int(0.09 * n), n):
        s = i / (n - 1)
        reach = size * (np.sin(np.pi * min(1.0, s * 0.84 + 0.15)) ** 0.9) * (1.1 - 0.35 * s) + 0.012
        reach *= rng.uniform(0.9, 1.06)
        for side in (-1.0, 1.0):
            way = unit(side * span[i] + tangent[i] * (0.22 + 0.75 * s * s) - 0.10 * face[i])
            # A pinna is a row of kites that overlap: it bends, and its edge is toothed.
            t = LOBES
            k = len(t)
            root = path[i] + tangent[i] * (0.25 * side * gap)
            sag = np.outer(t, [0.0, 1.0, 0.0])
            spine = root + np.outer(t * reach, way) - 0.20 * reach * t[:, None] * sag
            axis = unit(way - 0.40 * sag + 0.05 * rng.standard_normal((k, 3)))
            normal = unit(
                face[i] + 0.16 * rng.standard_normal(3) + 0.05 * rng.standard_normal((k, 3))
            )
            length = np.full(k, 0.52 * reach)
            width = 1.15 * gap * np.minimum(1.0, 0.25 + reach / size) * (1.05 - 0.62 * t)
            green = np.array([0.058, 0.122, 0.028]) * (1 - s) + np.array([0.125, 0.190, 0.042]) * s
            albedo = green * tone * rng.uniform(0.84, 1.14) * (0.85 + 0.3 * t)[:, None]
            parts.append(Leaves(spine, axis, normal, length, width, albedo))
    return join(parts)


def join(parts: list[Leaves]) -> Leaves:
    """Gather the leaves of several parts into one."""
    return Leaves(*(np.concatenate([getattr(p, f) for p in parts]) for f in vars(parts[0])))


def tilt(points: np.ndarray) -> np.ndarray:
    """Turn (n, 3) about the x axis so that the tuft shows some of its upper side."""
    c, s = np.cos(PITCH_RAD), np.sin(PITCH_RAD)
    x, y, z = points.T
    return np.stack([x, c * y - s * z, s * y + c * z], 1)


def plant() -> np.ndarray:
    """A tuft of fern fronds arching outward on all sides."""
    rng = np.random.default_rng(5)
    fronds, paths = [], []
    for k in range(FRONDS):
        azimuth = 2 * np.pi * (k * 0.381966 + rng.uniform(-0.03, 0.03))
        layer = k / (FRONDS - 1)
        if layer < 0.5 and abs(np.cos(azimuth)) < 0.45:
            azimuth += 0.7  # an upright frond in the middle would show where the quads cross
        sideways = abs(np.cos(azimuth))
        length = (1.75 - 0.55 * layer) * rng.uniform(0.88, 1.08) * (0.7 + 0.3 * sideways)
        lean = 0.10 + 0.74 * layer + rng.uniform(-0.08, 0.08)
        path = midrib(length, lean, rng.uniform(1.45, 2.0) - 0.75 * layer, azimuth, 44)
        # Fronds that come at the viewer are foreshortened to blobs: keep them few and short.
        path[:, 2] *= 0.6
        # Fronds that lean left or right would be seen edge on: roll them towards the viewer.
        roll = -np.sign(np.cos(azimuth)) * sideways * rng.uniform(0.35, 0.8)
        leaves = frond(path, roll, rng.uniform(0.20, 0.26), rng)
        fronds.append(leaves)
        paths.append(path)
    leaves = join(fronds)
    leaves.centre, leaves.axis, leaves.normal = map(
        tilt, (leaves.centre, leaves.axis, leaves.normal)
    )
    # The crown of the root lies under the ground, so the tuft spreads from the picture's last row.
    leaves.centre[:, 1] -= 0.05
    paths = [tilt(p) - np.array([0.0, 0.05, 0.0]) for p in paths]
    low, high = leaves.centre.min(0), leaves.centre.max(0)
    sx = 0.95 / max(-low[0], high[0])
    sy = 1.9 / high[1]
    for points in (leaves.centre, *paths):
        points *= np.array([sx, sy, sx])
    density = foliage_density(leaves)
    canvas = Canvas.blank()
    ends = np.concatenate([np.stack([p[:-1], p[1:]], 1) for p in paths])
    taper = np.linspace(0.014, 0.003, len(paths[0]))
    radii = np.tile(np.stack([taper[:-1], taper[1:]], 1), (len(paths), 1))
    lights = light_on_limbs(density, ends, EXTINCTION)
    stalk = np.broadcast_to([*STALK_ALBEDO, 0.0], (4, 4, 4)).copy()
    flat = np.zeros_like(radii)
    draw_limbs(canvas, ends, radii, lights, stalk, STALK_ALBEDO, flat, flat[:, 0])
    draw_leaves(canvas, leaves, density, EXTINCTION)
    return canvas.finish()


def blade() -> np.ndarray:
    """The texture (64, 64, 3) of a blade: base at the bottom rows, tip at the top ones."""
    v, u = (np.mgrid[0:BLADE_SIZE, 0:BLADE_SIZE] + 0.5) / BLADE_SIZE
    tip = (1.0 - v)[..., None]
    base_colour = np.array([0.030, 0.060, 0.012])
    middle_colour = np.array([0.105, 0.185, 0.030])
    tip_colour = np.array([0.300, 0.320, 0.070])
    colour = base_colour + (middle_colour - base_colour) * smoothstep(0.0, 0.55, tip)
    colour = colour + (tip_colour - colour) * smoothstep(0.45, 1.05, tip)
    # The strip's middle is at u = 0.5 all along: the midrib is straight.
    across = u - 0.5
    rib = np.exp(-((across / 0.035) ** 2)) - 0.45 * np.exp(
        -(((np.abs(across) - 0.085) / 0.04) ** 2)
    )
    veins = 0.06 * np.cos(2 * np.pi * across * 13)
    fold = np.where(across < 0, 1.10, 0.88)
    streak = spectral_noise(BLADE_SIZE, 0.8, 7).mean(axis=0)[None, :] * 0.25
    grain = 0.05 * spectral_noise(BLADE_SIZE, 0.7, 8)
    shade = fold * (1.0 + 0.32 * rib + veins + streak + grain)
    return to_uint8(to_srgb(colour * shade[..., None]))


ASSETS: dict[str, Callable[[], np.ndarray]] = {"plant.png": plant, "blade.png": blade}
