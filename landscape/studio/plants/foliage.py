"""A software rasterizer that lights and draws the leaves and limbs of a plant sprite.

Limbs are tapered cylinders with bark; leaves and needles are folded kites. All share one depth
buffer at four times the final resolution. Light from the sun and the sky is attenuated
exponentially (Beer-Lambert) by the leaf area along its path, looked up in a coarse density grid.

Sprite space: x right in -1..1, y up in 0..2 (0 is the ground), z towards the viewer.
"""

from dataclasses import dataclass

import numpy as np
from numba import njit
from scipy import ndimage

from landscape.studio.images import bleed, shrink, to_srgb, to_uint8
from landscape.studio.light import GROUND_BOUNCE, SKY_COLOR, SPRITE_SUN, SUN_COLOR

SIZE = 512  # texels per side of a sprite
SUPERSAMPLING = 4  # per axis: sixteen samples per texel antialias the alpha channel
GRID = 96  # chosen: cells of the density grid per axis, about five texels each
GRID_LOW = np.array([-1.15, -0.15, -1.15])  # chosen: slightly larger than the sprite
GRID_SPAN = 2.3
SUN_GAIN = 2.3  # chosen: exposure; a leaf in full sun is at about 60 % of white
SKY_GAIN = 1.15  # chosen: the shaded side stays readable against a bright sky
TRANSMITTED = np.array([1.25, 1.1, 0.4])  # chosen: light that passes a leaf loses its blue
# Chosen: for the glow of thin foliage, a second beam that comes from behind the tree.
FROM_BEHIND = np.array([-0.10, 0.62, -0.78])
SKY_DIRECTIONS = np.array(  # chosen: the upper hemisphere, and towards the viewer
    [
        [0.0, 1.0, 0.0],
        [-0.77, 0.64, 0.0],
        [0.77, 0.64, 0.0],
        [0.0, 0.64, -0.77],
        [0.0, 0.64, 0.77],
        [0.0, 0.1, 1.0],
    ]
)


def sprite(premultiplied: np.ndarray) -> np.ndarray:
    """Convert linear premultiplied RGBA (h, w, 4) to an sRGB sprite with straight alpha.

    The border is made transparent, except for the last row, where the sprite meets the ground.
    Colours are bled into the transparent texels.
    """
    alpha = premultiplied[..., 3:]
    straight = to_srgb(premultiplied[..., :3] / np.maximum(alpha, 1e-6))
    rgba = to_uint8(np.concatenate([straight, alpha], -1))
    rgba[0, :, 3] = rgba[:, 0, 3] = rgba[:, -1, 3] = 0
    return bleed(rgba)


@dataclass
class Canvas:
    """A supersampled image: linear colour (h, w, 3) and depth (h, w), where larger is nearer."""

    colour: np.ndarray
    depth: np.ndarray

    @classmethod
    def blank(cls, size: int = SIZE) -> "Canvas":
        side = size * SUPERSAMPLING
        return cls(np.zeros((side, side, 3), np.float32), np.full((side, side), -1e9, np.float32))

    def to_screen(self, points: np.ndarray) -> np.ndarray:
        """Transform points (..., 3) from sprite space to samples: column, row, depth."""
        half = self.depth.shape[0] / 2
        return np.stack(
            [(points[..., 0] + 1) * half, (2 - points[..., 1]) * half, points[..., 2] * half], -1
        )

    def finish(self) -> np.ndarray:
        """Downsample to a sprite, uint8 (size, size, 4)."""
        covered = (self.depth > -1e8)[..., None].astype(np.float32)
        downsampled = shrink(np.concatenate([self.colour * covered, covered], -1), SUPERSAMPLING)
        return sprite(downsampled)


@njit
def fill_triangles(colour, depth, corners, shades):  # type: ignore[no-untyped-def]
    """Rasterize screen triangles (n, 3, 3) with linear colours (n, 3, 3) at their corners."""
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
    colour, depth, ends, radii, along, turns, lights, bark, twig, sun, sky, bounce, towards
):
    """Rasterize tapered cylinders with bark.

    ends (n, 2, 3): end points in screen samples. radii (n, 2): in samples. along (n, 2): distance
    from the ground along the limb, in texels of ``bark`` (m, m, 4: colour, relief). turns (n,): the
    texel around the limb that faces the viewer. lights (n, 2, 2): fractions of the sun and of the
    sky that reach both ends. twig: colour of thin limbs; it blends to bark between radii of 3 and
    10 samples. sun, sky, bounce: colours of the lights. towards (3,): the sun, on the screen.
    """
    h, w = depth.shape
    m = bark.shape[0]
    texel = np.zeros(4)
    lx = towards[0]
    ly = towards[1]
    lz = towards[2]
    for i in range(ends.shape[0]):
        ax, ay, az = ends[i, 0]
        bx, by, bz = ends[i, 1]
        dx = bx - ax
        dy = by - ay
        dz = bz - az
        flat = np.sqrt(dx * dx + dy * dy)
        length = np.sqrt(flat * flat + dz * dz)
        if length < 1e-6:
            continue
        thick = max(radii[i, 0], radii[i, 1])
        if flat < 1e-4:
            px, py = 1.0, 0.0
        else:
            px, py = -dy / flat, dx / flat

        # The direction perpendicular to the limb that faces the viewer: axis x across.
        qx = -dz * py / length
        qy = dz * px / length
        qz = (dx * py - dy * px) / length
        if qz < 0:
            qx = -qx
            qy = -qy
            qz = -qz

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
                # The round caps of neighbouring limbs overlap. Extrapolate the bark's texture
                # coordinate past the ends: clamped, the bark would smear there.
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
                nx = px * s + qx * up
                ny = py * s + qy * up
                nz = qz * up
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
    """Return the leaf area (n,) along a direction (3,) from points (n, 3), both in grid cells."""
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
    """Return vectors (..., 3) scaled to length 1."""
    return vectors / (np.linalg.norm(vectors, axis=-1, keepdims=True) + 1e-12)


@dataclass
class Leaves:
    """Kites: centres, axes, normals (n, 3), lengths and widths (n,), linear albedos (n, 3)."""

    centre: np.ndarray
    axis: np.ndarray
    normal: np.ndarray
    length: np.ndarray
    width: np.ndarray
    albedo: np.ndarray


def join(parts: list[Leaves]) -> Leaves:
    """Concatenate the leaves of several parts."""
    return Leaves(*(np.concatenate([getattr(p, f) for p in parts]) for f in vars(parts[0])))


def light_at(
    density: np.ndarray, points: np.ndarray, extinction: float, towards: np.ndarray = SPRITE_SUN
) -> tuple[np.ndarray, np.ndarray]:
    """Return the fractions (n,) of the sun, ``towards`` (3,), and of the sky at points (n, 3)."""
    cells = (points - GRID_LOW) / GRID_SPAN * GRID
    step, reach = 0.9, int(GRID * 0.8)
    sun = np.exp(-extinction * optical_depth(density, cells, towards, step, reach))
    sky = np.zeros(len(points))
    for direction in SKY_DIRECTIONS:
        toward_sky = direction / np.linalg.norm(direction)
        sky += np.exp(-0.7 * extinction * optical_depth(density, cells, toward_sky, step, reach))
    return sun, sky / len(SKY_DIRECTIONS)


def foliage_density(leaves: Leaves) -> np.ndarray:
    """Return the leaf area per cell, (GRID, GRID, GRID), in units of the area of a cell face."""
    cell = GRID_SPAN / GRID
    index = np.clip(((leaves.centre - GRID_LOW) / cell).astype(int), 0, GRID - 1)
    density = np.zeros((GRID, GRID, GRID))
    np.add.at(density, tuple(index.T), 0.5 * leaves.length * leaves.width / cell**2)
    return ndimage.gaussian_filter(density, 0.7)


def draw_leaves(
    canvas: Canvas,
    leaves: Leaves,
    density: np.ndarray,
    extinction: float,
    min_sky: float = 0.0,
    towards: np.ndarray = SPRITE_SUN,
    glow: float = 0.0,
) -> None:
    """Shade and rasterize the kites: four triangles each, folded along the midrib.

    ``min_sky`` is a lower bound on the visible fraction of the sky. It stands for light that is
    scattered from leaf to leaf into the interior. ``towards`` (3,) is the sun's direction, and
    ``glow`` how bright foliage is where it is so thin that light from behind passes it.
    """
    sun, sky = light_at(density, leaves.centre, extinction, towards)
    sky = min_sky + (1.0 - min_sky) * sky

    # The normal of the crown, from the gradient of the density. Leaves point in all directions, so
    # shaded by their own normals alone a crown looks flat.
    soft = ndimage.gaussian_filter(density, 3.0)
    cells = ((leaves.centre - GRID_LOW) / GRID_SPAN * GRID).T
    crown = unit(
        -np.stack([ndimage.map_coordinates(g, cells, order=1) for g in np.gradient(soft)], -1)
    )
    behind = np.zeros(len(sun))
    if glow:
        cells = (leaves.centre - GRID_LOW) / GRID_SPAN * GRID
        passed = optical_depth(density, cells, FROM_BEHIND, 0.9, GRID)
        behind = glow * np.exp(-1.6 * extinction * passed)

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
        facing = normal @ towards
        wrapped = np.clip(0.35 + 0.65 * (crown @ towards), 0.0, 1.0)
        reflected = (0.45 * np.maximum(facing, 0.0) + 0.55 * wrapped) * sun
        through = np.maximum(-facing, 0.0) * sun
        up = 0.55 + 0.45 * crown[:, 1]
        lit = leaves.albedo * (
            SUN_GAIN * SUN_COLOR * reflected[:, None]
            + SKY_GAIN * SKY_COLOR * (sky * up)[:, None]
            + GROUND_BOUNCE * (sky * (1.0 - up))[:, None]
        )
        # The yellow glow of a crown against the sun.
        lit += leaves.albedo * TRANSMITTED * SUN_COLOR * through[:, None] * 1.1
        lit += leaves.albedo * TRANSMITTED * SUN_COLOR * behind[:, None]
        gloss = np.maximum(normal @ unit(towards + np.array([0.0, 0.0, 1.0])), 0.0) ** 24
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
    towards: np.ndarray = SPRITE_SUN,
) -> None:
    """Draw limbs; the arguments are those of :func:`fill_limbs`, but ``ends``, ``radii``,
    ``along`` and ``towards`` are in units of sprite space."""
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
        towards * np.array([1.0, -1.0, 1.0]),  # rows run downward
    )


def light_on_limbs(
    density: np.ndarray, ends: np.ndarray, extinction: float, towards: np.ndarray = SPRITE_SUN
) -> np.ndarray:
    """Return the fractions of the sun and of the sky (n, 2, 2) at limb ends (n, 2, 3)."""
    lights = light_at(density, ends.reshape(-1, 3), extinction, towards)
    return np.stack(lights, -1).reshape(-1, 2, 2)
