"""The tree billboards, seen from the side: oak, spruce, birch and hawthorn.

:mod:`landscape.studio.plants.growth` grows the limbs; this module adds bark, leaves or needles, and
fits the tree into the sprite. :mod:`landscape.studio.plants.foliage` lights and draws it, in its
sprite space: x right in -1..1, y up in 0..2, z towards the viewer.
"""

import functools
from collections.abc import Callable

import numpy as np
from scipy import ndimage

from landscape.studio.images import smoothstep, spectral_noise
from landscape.studio.light import SPRITE_SUN
from landscape.studio.plants.foliage import (
    Canvas,
    Leaves,
    draw_leaves,
    draw_limbs,
    foliage_density,
    light_on_limbs,
    unit,
)
from landscape.studio.plants.growth import (
    Skeleton,
    colonise,
    crown_lobes,
    from_foot,
    hang_twigs,
    in_lobes,
    spruce_limbs,
    stem,
)

TWIG_ALBEDO = (0.085, 0.062, 0.048)  # chosen: young twigs are reddish brown on all four


def bark_texture(dark: list[float], light: list[float], stretch: float, seed: int) -> np.ndarray:
    """Return tileable bark (256, 256, 4): linear colour, and slope of the relief across the limb.

    The colour goes from ``dark`` (fissures) to ``light`` (ridges). Axis 0 runs along the limb.
    """
    ridges = 1.0 - np.abs(
        ndimage.gaussian_filter1d(spectral_noise(256, 0.75, seed), stretch, 0, mode="wrap")
    )
    ridges = (ridges - ridges.min()) / (ridges.max() - ridges.min())
    grain = spectral_noise(256, 0.6, seed + 1)
    height = np.clip(smoothstep(0.35, 0.95, ridges) + 0.12 * grain, 0.0, 1.0)[..., None]
    colour = np.array(dark) * (1 - height) + np.array(light) * height
    slope = ndimage.gaussian_filter(
        np.roll(height[..., 0], -1, 1) - np.roll(height[..., 0], 1, 1), 0.7, mode="wrap"
    )
    return np.concatenate([colour, -1.6 * slope[..., None]], -1)


def birch_bark(seed: int) -> np.ndarray:
    """Return white bark with dark horizontal dashes and black scars, like :func:`bark_texture`."""
    rng = np.random.default_rng(seed)
    dashes = ndimage.gaussian_filter(rng.standard_normal((256, 256)), (1.1, 9.0), mode="wrap")
    scars = ndimage.gaussian_filter(rng.standard_normal((256, 256)), (7.0, 10.0), mode="wrap")
    ink = np.clip((dashes / dashes.std() - 1.25) * 1.5, 0, 1) * 0.8
    ink = np.maximum(ink, np.clip((scars / scars.std() - 1.35) * 3.0, 0, 1) * 0.95)[..., None]
    warm = spectral_noise(256, 1.3, seed + 1)[..., None] * np.array([0.02, 0.03, 0.04])
    colour = (np.array([0.66, 0.63, 0.57]) + warm) * (1 - ink) + np.array([0.05, 0.045, 0.04]) * ink
    return np.concatenate([colour, np.zeros((256, 256, 1))], -1)


def add_leaves(
    skeleton: Skeleton,
    at: np.ndarray,
    per_node: int,
    spread: float,
    size: tuple[float, float],
    droop: float,
    albedos: np.ndarray,
    rng: np.random.Generator,
) -> Leaves:
    """Place ``per_node`` leaves of ``size`` (length, width) within ``spread`` of each node ``at``.

    ``albedos`` (k, 3) are the linear colours that are mixed at random.
    """
    node = np.repeat(at, per_node)
    n = len(node)
    offset = unit(rng.standard_normal((n, 3)))
    centre = skeleton.points[node] + offset * spread * rng.random((n, 1)) ** 0.5
    axis = unit(offset + 0.6 * rng.standard_normal((n, 3)) + np.array([0.0, -droop, 0.0]))
    normal = rng.standard_normal((n, 3)) + np.array([0.0, 0.7, 0.6])
    normal = unit(normal - axis * np.sum(normal * axis, 1, keepdims=True))
    scale = rng.uniform(0.7, 1.25, n)
    mix = rng.dirichlet(np.full(len(albedos), 0.7), len(skeleton.points))[node]
    albedo = mix @ albedos * rng.uniform(0.82, 1.18, (n, 1))
    return Leaves(centre, axis, normal, size[0] * scale, size[1] * scale, albedo)


def draw_skeleton(
    canvas: Canvas,
    skeleton: Skeleton,
    radii: np.ndarray,
    bark: np.ndarray,
    density: np.ndarray,
    extinction: float,
    roots: int,
    rng: np.random.Generator,
    towards: np.ndarray = SPRITE_SUN,
) -> None:
    """Draw all limbs, and ``roots`` buttress roots that widen the foot of the trunk."""
    child = np.flatnonzero(skeleton.parents >= 0)
    parent = skeleton.parents[child]
    points = skeleton.points

    # Flare the foot: a trunk that meets the ground as a cylinder looks stuck into it.
    wide = radii * (1.0 + 0.55 * np.exp(-points[:, 1] / (1.6 * radii[0])))
    ends = np.stack([points[parent], points[child]], 1)
    thick = np.stack([np.minimum(wide[parent], 1.35 * wide[child]), wide[child]], 1)
    foot = radii[skeleton.parents == 0].max()
    for k in range(roots):
        angle = 2 * np.pi * (k + rng.uniform(-0.3, 0.3)) / roots
        out = np.array([np.cos(angle), 0.0, 0.6 * np.sin(angle)])
        spread = rng.uniform(0.85, 1.25)
        path = np.array([[0.25, 3.4], [0.5, 1.7], [0.85, 0.7], [1.3, 0.15], [2.1, -0.25]]) * foot
        curve = path[:, :1] * out * spread + path[:, 1:] * np.array([0.0, 1.0, 0.0])
        r = np.array([0.70, 0.66, 0.58, 0.42, 0.2]) * foot
        ends = np.concatenate([ends, np.stack([curve[:-1], curve[1:]], 1)])
        thick = np.concatenate([thick, np.stack([r[:-1], r[1:]], 1)])

    height = np.zeros(len(points))
    turn = np.zeros(len(points))
    for i, p in zip(child, parent, strict=True):
        height[i] = height[p] + np.linalg.norm(points[i] - points[p])
        turn[i] = turn[p] if radii[i] > 0.75 * radii[p] else rng.uniform(0, 256)
    along = np.stack([height[parent], height[child]], 1)
    extra = ends[len(child) :]
    along = np.concatenate([along, extra[..., 1] + 0.31])
    lights = light_on_limbs(density, ends, extinction, towards)
    lights[..., 1] *= 0.45 + 0.55 * np.clip(ends[..., 1] / (4 * foot), 0, 1)
    grass = foot_grass(3.2 * foot, 170, rng)
    draw_leaves(canvas, grass, density, 0.4 * extinction, towards=towards)
    turns = np.concatenate([turn[child], np.repeat(rng.uniform(0, 256, roots), 4)])
    draw_limbs(canvas, ends, thick, lights, bark, np.array(TWIG_ALBEDO), along, turns, towards)


def foot_grass(spread: float, count: int, rng: np.random.Generator) -> Leaves:
    """Return grass within ``spread`` of the foot; it hides the intersection of quad and ground."""
    x = np.clip(rng.standard_normal(count) * 0.45, -1, 1) * spread
    z = rng.uniform(-0.3, 1.0, count) * spread * 0.7
    length = rng.uniform(0.03, 0.085, count) * np.clip(1.25 - np.abs(x) / spread, 0.3, 1)
    axis = unit(
        np.stack(
            [0.4 * rng.standard_normal(count), np.ones(count), 0.3 * rng.standard_normal(count)], 1
        )
    )
    centre = np.stack([x, length * 0.32, z], 1)
    normal = unit(np.cross(axis, unit(rng.standard_normal((count, 3)))) + np.array([0.0, 0.2, 0.4]))
    albedo = np.array([0.095, 0.150, 0.035]) * rng.uniform(0.55, 1.15, (count, 1))
    return Leaves(centre, axis, normal, length, length * 0.14, albedo)


def bounds(skeleton: Skeleton, leaves: Leaves) -> tuple[np.ndarray, np.ndarray]:
    """Return the least and the greatest coordinates (3,) of a tree."""
    everything = np.concatenate([skeleton.points, leaves.centre])
    return everything.min(axis=0), everything.max(axis=0)


def fit(skeleton: Skeleton, leaves: Leaves, width: float, height: float) -> None:
    """Scale a tree about its foot so that its crown fills the given fraction of the sprite."""
    low, high = bounds(skeleton, leaves)
    margin = leaves.length.max() / 2
    # Centre the crown by shearing with height, which leaves the foot in place.
    shear = -(low[0] + high[0]) / 2 / (0.6 * high[1])
    sx = (width - margin) / ((high[0] - low[0]) / 2)
    sy = (2 * height - margin) / high[1]
    for points in (skeleton.points, leaves.centre):
        lean = np.clip(points[:, 1] / high[1] / 0.6, 0, 1) * 0.6 * high[1]
        points[:, 0] = (points[:, 0] + shear * lean) * sx
        points[:, 1] *= sy
        points[:, 2] *= sx


@functools.cache
def broadleaf() -> np.ndarray:
    """Return an old oak: short trunk, wide clumped crown, heavy limbs visible through the gaps."""
    rng = np.random.default_rng(11)
    skeleton = _oak_limbs(rng)
    skeleton.smooth(3)
    r = skeleton.radii(0.0033, 0.088)
    albedos = np.array([[0.080, 0.138, 0.030], [0.120, 0.172, 0.040], [0.055, 0.102, 0.032]])
    leaves = add_leaves(
        skeleton, np.flatnonzero(r < 0.0058), 12, 0.052, (0.036, 0.022), 0.2, albedos, rng
    )
    fit(skeleton, leaves, 0.97, 0.97)

    density = foliage_density(leaves)
    canvas = Canvas.blank()
    bark = bark_texture([0.035, 0.028, 0.020], [0.19, 0.158, 0.122], 9.0, 21)
    draw_skeleton(canvas, skeleton, r, bark, density, 0.55, 7, rng)
    draw_leaves(canvas, leaves, density, 0.55)
    return canvas.finish()


def _oak_limbs(rng: np.random.Generator) -> Skeleton:
    """Return a short trunk and heavy limbs that reach into a wide crown."""
    centres, radii = crown_lobes([0, 1.16, 0], [0.80, 0.68, 0.66], 30, (0.15, 0.29), -0.72, 3)
    attractors = in_lobes(centres, radii, 5200, rng)
    return colonise(
        attractors,
        from_foot(
            [
                stem(
                    (0, 0, 0),
                    (0.02, 0.2, 0),
                    (-0.01, 0.36, 0.0),
                    (-0.06, 0.6, 0.05),
                    (0.0, 0.9, 0.0),
                ),
                stem((0.01, 0.3, 0.0), (0.12, 0.5, 0.08), (0.3, 0.72, 0.05), (0.38, 0.9, 0.0)),
                stem((0.0, 0.38, 0.0), (-0.16, 0.55, -0.06), (-0.38, 0.68, 0.0)),
            ]
        ),
        0.033,
        np.array([0.0, 0.1, 0.0]),
        14,
    )


@functools.cache
def birch() -> np.ndarray:
    """Return a birch: two white stems, an open crown, thin hanging twigs."""
    rng = np.random.default_rng(31)
    skeleton = _birch_limbs(rng)
    skeleton.smooth(4)
    tips = np.flatnonzero(skeleton.child_counts() == 0)
    skeleton = hang_twigs(skeleton, tips, (4, 11), 0.028, rng)
    r = skeleton.radii(0.0018, 0.050)
    albedos = np.array([[0.165, 0.205, 0.045], [0.215, 0.225, 0.048], [0.115, 0.168, 0.040]])
    leaves = add_leaves(
        skeleton, np.flatnonzero(r < 0.0034), 4, 0.030, (0.026, 0.019), 0.9, albedos, rng
    )
    fit(skeleton, leaves, 0.92, 0.98)

    density = foliage_density(leaves)
    canvas = Canvas.blank()
    draw_skeleton(canvas, skeleton, r, birch_bark(41), density, 0.45, 5, rng)
    draw_leaves(canvas, leaves, density, 0.45)
    return canvas.finish()


def _birch_limbs(rng: np.random.Generator) -> Skeleton:
    """Return two stems, and limbs that reach into an open crown."""
    centres, radii = crown_lobes([0, 1.2, 0], [0.56, 0.74, 0.5], 28, (0.16, 0.26), -0.8, 5)
    attractors = in_lobes(centres, radii, 2800, rng)
    return colonise(
        attractors,
        from_foot(
            [
                stem(
                    (0.0, 0.1, 0.02),
                    (0.06, 0.35, 0.05),
                    (0.12, 0.7, 0.03),
                    (0.15, 1.05, 0.0),
                    (0.21, 1.6, 0.0),
                ),
                stem(
                    (-0.015, 0.12, 0),
                    (-0.08, 0.4, -0.05),
                    (-0.17, 0.85, 0.0),
                    (-0.17, 1.2, 0.0),
                    (-0.12, 1.55, 0),
                ),
            ]
        ),
        0.035,
        np.array([0.0, 0.45, 0.0]),
        32,
    )


@functools.cache
def shrub() -> np.ndarray:
    """Return a wind-bent hawthorn: gnarled grey stems, a ragged crown in blossom, dead twigs."""
    rng = np.random.default_rng(51)
    centres, radii = crown_lobes([0.16, 0.88, 0], [0.82, 0.58, 0.6], 30, (0.15, 0.26), -0.6, 8)
    attractors = in_lobes(centres, radii, 3000, rng)
    extra = np.array([[-0.62, 0.75, 0.0], [-0.2, 0.32, 0.1], [0.3, 0.3, 0.12], [0.05, 0.34, -0.2]])
    sizes = np.array([[0.24, 0.30, 0.20], [0.2, 0.16, 0.16], [0.22, 0.16, 0.16], [0.2, 0.16, 0.16]])
    attractors = np.concatenate([attractors, in_lobes(extra, sizes, 260, rng)])
    skeleton = colonise(
        attractors,
        from_foot(
            [
                stem(
                    (0, 0, 0),
                    (0.05, 0.10, 0.03),
                    (0.01, 0.2, 0.05),
                    (0.10, 0.32, 0.06),
                    (0.08, 0.45, 0.0),
                    (0.2, 0.6, 0),
                ),
                stem(
                    (-0.03, 0.06, 0),
                    (-0.10, 0.14, -0.03),
                    (-0.09, 0.25, 0.03),
                    (-0.22, 0.36, 0.02),
                    (-0.25, 0.5, 0),
                ),
                stem(
                    (0.05, 0.08, 0),
                    (0.15, 0.13, -0.05),
                    (0.2, 0.24, -0.04),
                    (0.36, 0.30, 0.0),
                    (0.44, 0.42, 0),
                ),
            ]
        ),
        0.038,
        np.array([0.22, 0.05, 0.0]),
        52,
    )
    skeleton.smooth(1)
    r = skeleton.radii(0.0030, 0.072)
    albedos = np.array([[0.062, 0.094, 0.040], [0.098, 0.122, 0.046], [0.046, 0.074, 0.040]])
    at = np.flatnonzero(r < 0.0062)

    # The windward side is bare; its dead twigs make this tree recognisable from afar.
    bare = smoothstep(-0.58, -0.22, skeleton.points[at, 0] + 0.25 * (skeleton.points[at, 1] - 0.9))
    at = at[rng.random(len(at)) < 0.04 + 0.96 * bare]
    leaves = add_leaves(skeleton, at, 12, 0.050, (0.029, 0.021), 0.0, albedos, rng)
    flowering = rng.random(len(skeleton.points)) < 0.15
    blossom = np.repeat(flowering[at], 12) & (rng.random(len(leaves.centre)) < 0.55)
    leaves.albedo[blossom] = np.array([0.50, 0.46, 0.38])
    leaves.length[blossom] *= 0.62
    fit(skeleton, leaves, 0.97, 0.93)
    density = foliage_density(leaves)
    canvas = Canvas.blank()
    bark = bark_texture([0.03, 0.028, 0.025], [0.18, 0.165, 0.145], 7.0, 61)
    draw_skeleton(canvas, skeleton, r, bark, density, 0.5, 5, rng)
    draw_leaves(canvas, leaves, density, 0.5)
    return canvas.finish()


@functools.cache
def conifer() -> np.ndarray:
    """Return a spruce: dark tiers of needles with upturned tips and sky between the tiers."""
    rng = np.random.default_rng(71)
    skeleton, green = spruce_limbs(rng)
    r = skeleton.radii(0.0025, 0.05)
    run = unit(skeleton.points[green] - skeleton.points[skeleton.parents[green]])
    albedos = np.array([[0.052, 0.098, 0.042], [0.088, 0.130, 0.050], [0.038, 0.078, 0.042]])
    needles = add_leaves(skeleton, green, 7, 0.02, (0.036, 0.0072), 0.1, albedos, rng)
    needles.axis = unit(needles.axis + 1.1 * np.repeat(run, 7, axis=0))
    needles.normal = unit(
        needles.normal - needles.axis * np.sum(needles.normal * needles.axis, 1, keepdims=True)
    )
    fit(skeleton, needles, 0.9, 0.985)
    density = foliage_density(needles)
    canvas = Canvas.blank()
    bark = bark_texture([0.03, 0.022, 0.017], [0.15, 0.105, 0.08], 3.0, 81)
    draw_skeleton(canvas, skeleton, r, bark, density, 0.6, 5, rng)
    draw_leaves(canvas, needles, density, 0.85, 0.3)
    return canvas.finish()


ASSETS: dict[str, Callable[[], np.ndarray]] = {
    "tree_broadleaf.png": broadleaf,
    "tree_conifer.png": conifer,
    "tree_birch.png": birch,
    "tree_shrub.png": shrub,
}
