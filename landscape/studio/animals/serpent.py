"""The sea dragon of the preset `best`: smooth flesh, and spines, teeth and horns of their own.

Body and head are a distance field, as in :mod:`landscape.studio.animals.dragon`, along the same
curve. But what is smaller than the triangles is not in it: scales are in the texture, which lies
along the body (:mod:`landscape.elements.best.animals.serpent_skin`), so that the normals are smooth
and what the wet skin mirrors has no facets. Teeth, horns and the spines of the fins are swept
cones; between two spines hangs a membrane, an open sheet (:mod:`.serpent_fins`).
"""

import math
from collections.abc import Callable

import numpy as np
from numba import njit

from landscape.elements.best.animals.serpent_skin import BODY_TILE, laid
from landscape.studio.animals.dragon import HEAD_PITCH_DEG, HORN, body_curve
from landscape.studio.animals.sculpture import point_normals, shaped
from landscape.studio.animals.serpent_fins import (
    HORN_COLOUR,
    TOOTH_COLOUR,
    Fin,
    Part,
    crest,
    ears,
    fluke,
    joined,
    swept,
)
from landscape.studio.animals.serpent_paint import (
    BODY_STRIP,
    EYE_STRIP,
    HEAD_STRIP,
    PLAIN_STRIP,
    flesh_colours,
)
from landscape.studio.shapes import (
    across,
    carve,
    catmull_rom,
    ellipsoid,
    limb,
    mix,
    nearest,
    noise,
    step_smooth,
    turn,
    union,
)

FLESH = 15400  # chosen: vertices of body and head; with all else as many triangles as in 2006
STEP = 0.0075  # chosen: as the dragon's
BOX = ((-1.16, -0.56, -0.26), (1.24, 0.90, 0.30))  # chosen: contains the curve and the head
STOUT = 1.10  # chosen: times the radii of the dragon of 2006
SHIELDS = 22  # chosen: shields of the belly along a tile of the skin
RIM = (22, 23, 21)  # chosen: colour of the eye's rim
HORN_RINGS = 16  # chosen: rings of vertices along a horn

# Chosen, in head space: x, y, z of the gum at the two ends of a row of teeth.
UPPER_GUM = ((0.150, -0.050, 0.057), (0.368, -0.030, 0.026))
LOWER_GUM = ((0.160, -0.062, 0.044), (0.318, -0.104, 0.019))
# Chosen: where along the gum a tooth stands, and its length.
UPPER_TEETH = (
    *((0.02, 0.026), (0.14, 0.034), (0.26, 0.028), (0.37, 0.040), (0.49, 0.030), (0.60, 0.044)),
    *((0.71, 0.034), (0.84, 0.072), (0.95, 0.036)),
)
LOWER_TEETH = (
    *((0.05, 0.024), (0.20, 0.032), (0.36, 0.028), (0.50, 0.038), (0.65, 0.030), (0.78, 0.058)),
    *((0.92, 0.034),),
)


@njit
def _fold(s: float, angle: float, radius: float) -> float:
    """Return how far the flesh stands out from the curve's radius: ridge, shields and folds.

    ``s`` is the body's texture coordinate, 1 per tile.
    """
    away = abs(angle)
    ridge = 0.13 * math.exp(-((away / 0.30) ** 2))
    groove = -0.035 * math.exp(-(((away - 1.52) / 0.10) ** 2))
    swell = 0.030 * math.exp(-(((away - 1.05) / 0.30) ** 2))
    f = s * SHIELDS
    f = f - math.floor(f)
    shield = (0.055 * f - 0.02) * step_smooth(2.30, 2.55, away)
    crease = 0.5 * SHIELDS * s + 0.35 * math.sin(2.2 * away)
    crease = 0.016 * math.sin(2 * math.pi * crease) * step_smooth(2.45, 1.7, away)
    lump = 0.05 * noise(7.0 * s, 2.2 * math.cos(angle), 2.2 * math.sin(angle) + 9.0)
    lump += 0.02 * noise(23.0 * s, 5.0 * math.cos(angle), 5.0 * math.sin(angle) - 3.0)
    return radius * (ridge + groove + swell + shield + crease + lump - 0.02)


@njit
def _head(x: float, y: float, z: float) -> float:
    """Return the distance to the head: origin at the nape, x to the muzzle, y up, mirrored in z."""
    a = abs(z)

    # Skull, and the upper jaw, which narrows and widens again at the nostrils.
    d = ellipsoid(x - 0.06, y - 0.010, a, 0.150, 0.092, 0.096)
    upper = limb(x, y * 1.25, a * 0.86, 0.10, 0.022, 0.0, 0.080, 0.345, 0.004, 0.0, 0.046)
    d = union(d, upper, 0.05)
    d = union(d, ellipsoid(x - 0.352, y - 0.030, a - 0.020, 0.042, 0.026, 0.026), 0.03)
    d = union(d, limb(x, y, a, 0.20, 0.052, 0.0, 0.022, 0.335, 0.040, 0.0, 0.012), 0.03)
    d = carve(d, ellipsoid(x - 0.376, y - 0.040, a - 0.034, 0.013, 0.008, 0.010), 0.008)
    d = union(d, limb(x, y, a, 0.145, -0.030, 0.056, 0.017, 0.368, -0.018, 0.026, 0.012), 0.014)

    # Lower jaw, cheeks and the pouch of the throat.
    lower = limb(x, y * 1.15, a * 0.80, 0.04, -0.078, 0.0, 0.058, 0.31, -0.142, 0.0, 0.028)
    d = union(d, lower, 0.02)
    d = union(d, ellipsoid(x - 0.035, y + 0.040, a - 0.070, 0.085, 0.060, 0.040), 0.03)
    d = union(d, ellipsoid(x - 0.02, y + 0.095, a, 0.13, 0.055, 0.055), 0.05)

    # Brow, eye socket and eye.
    d = union(d, limb(x, y, a, 0.00, 0.078, 0.062, 0.026, 0.190, 0.062, 0.066, 0.019), 0.025)
    d = union(d, limb(x, y, a, 0.06, 0.004, 0.092, 0.014, 0.200, 0.008, 0.072, 0.010), 0.025)
    d = carve(d, ellipsoid(x - 0.145, y - 0.034, a - 0.096, 0.034, 0.021, 0.022), 0.012)
    d = union(d, ellipsoid(x - 0.145, y - 0.034, a - 0.070, 0.024, 0.021, 0.022), 0.005)

    # Knobs of the skin on the skull, wrinkles behind the jaw.
    knobs = noise(38.0 * x, 38.0 * y, 38.0 * a)
    d -= 0.0045 * knobs * step_smooth(0.34, 0.18, x)
    return d - 0.004 * math.sin(120.0 * x + 30.0 * y) * step_smooth(0.02, -0.05, x)


@njit
def flesh_field(x: float, y: float, z: float, data: tuple[np.ndarray, float]) -> float:
    """Return the signed distance to body and head: x to the front, y up, z to its right."""
    curve, pitch = data
    i, t, distance = nearest(curve, x, y, z)
    radius = mix(curve[i, 3], curve[i + 1, 3], t)
    d = distance - radius
    if d < 0.16 and d > -0.5 * radius:
        u, v = across(curve, i, t, x, y, z)
        d -= _fold(mix(curve[i, 4], curve[i + 1, 4], t), math.atan2(v, u), radius)

    end = curve.shape[0] - 1
    hx, hy = turn(x - curve[end, 0], y - curve[end, 1], -pitch)
    if hx * hx + hy * hy < 0.36:
        d = union(d, _head(hx, hy, z - curve[end, 2]), 0.045)
    return d


def curve() -> np.ndarray:
    """Return the body as :func:`dragon.body_curve` does, stouter; column 4 is the skin's tile.

    It increases by 1 per tile of the skin, BODY_TILE circumferences, and faster at the neck, whose
    scales are small.
    """
    found = body_curve()
    ends = np.minimum(found[:, 11] / 0.35, 1.0) * np.minimum(0.45 + found[:, 12] / 0.5, 1.0)
    found[:, 3] *= 1.0 + (STOUT - 1.0) * np.clip(ends, 0.0, 1.0)
    small = 1.0 + 0.5 * np.clip(1.0 - found[:, 12] / 0.6, 0.0, 1.0)
    rate = small / (BODY_TILE * 2 * np.pi * found[:, 3])
    along = found[:, 11]
    steps = 0.5 * (rate[1:] + rate[:-1]) * np.diff(along)
    found[:, 4] = np.append(0.0, np.cumsum(steps))
    return found


def _placed(points: np.ndarray, curve: np.ndarray) -> np.ndarray:
    """Return points (..., 3) of head space in the animal's own frame."""
    pitch = math.radians(HEAD_PITCH_DEG)
    c, s = math.cos(pitch), math.sin(pitch)
    x, y, z = np.moveaxis(points, -1, 0)
    return np.stack([c * x - s * y, s * x + c * y, z], axis=-1) + curve[-1, :3]


def _teeth(curve: np.ndarray) -> list[Part]:
    """Return the teeth, cones that are bent backwards, as parts of bone."""
    parts = []
    for gum, teeth, up in ((UPPER_GUM, UPPER_TEETH, -1.0), (LOWER_GUM, LOWER_TEETH, 1.0)):
        first, last = np.array(gum[0]), np.array(gum[1])
        for share, length in teeth:
            t = np.linspace(0.0, 1.0, 4)[:, None]
            foot = first + share * (last - first)
            ahead = 0.25 - 0.55 * t
            path = foot + length * (
                t * np.array([0.0, up, 0.0])
                + np.concatenate([t * ahead, 0 * t, 0.10 * t * (1.0 - 0.6 * t)], axis=1)
            )
            thick = (0.0045 + 0.11 * length) * np.array([1.0, 0.80, 0.50, 0.06])
            for side in (1.0, -1.0):
                placed = _placed(path * (1.0, 1.0, side), curve)
                parts.append(swept(placed, thick, 6, (0.25, 0.12), TOOTH_COLOUR))
    return parts


def _horns(curve: np.ndarray) -> list[Part]:
    """Return the two horns and the spikes behind the jaw, as parts of bone."""
    horn = catmull_rom(HORN, HORN_RINGS)
    rings = 1.0 + 0.05 * np.sin(np.arange(HORN_RINGS) * 1.9)
    spikes = [
        np.array([(0.00, -0.05, 0.085), (-0.06, -0.068, 0.115), (-0.115, -0.070, 0.130)]),
        np.array([(0.02, -0.09, 0.070), (-0.03, -0.120, 0.092), (-0.075, -0.135, 0.100)]),
        np.array([(0.05, 0.085, 0.058), (0.03, 0.118, 0.066), (0.000, 0.140, 0.070)]),
        np.array([(0.14, 0.080, 0.062), (0.125, 0.102, 0.068), (0.100, 0.116, 0.072)]),
    ]
    parts = []
    for side in (1.0, -1.0):
        mirrored = np.array([1.0, 1.0, side])
        thick = np.append(horn[:-1, 3] * rings[:-1], 0.002)
        parts.append(
            swept(_placed(horn[:, :3] * mirrored, curve), thick, 12, (0.0, 1.0), HORN_COLOUR)
        )
        for spike in spikes:
            path = _placed(catmull_rom(spike, 5) * mirrored, curve)
            thick = np.array([0.017, 0.014, 0.010, 0.006, 0.001])
            parts.append(swept(path, thick, 7, (0.3, 0.7), HORN_COLOUR))
    return parts


def _flesh(body: np.ndarray) -> Part:
    """Return body and head: vertices with colours and texture coordinates, cut at the charts."""
    data = (body, math.radians(HEAD_PITCH_DEG))
    low, high = np.array(BOX[0]), np.array(BOX[1])
    vertices, faces = shaped(flesh_field, data, low, high, STEP, FLESH)
    normals = point_normals(vertices, faces)
    colours, strips, places = flesh_colours(vertices, normals, data)
    # A face is in the chart in which most of its corners are; the eye's only with all three.
    corner = strips[faces]
    chart = np.where(corner[:, 0] == corner[:, 1], corner[:, 0], corner[:, 2])
    eye = (corner == EYE_STRIP).all(axis=1)
    chart = np.where((chart == EYE_STRIP) & ~eye, PLAIN_STRIP, chart)
    key = faces + chart[:, None] * len(vertices)
    used, triangles = np.unique(key, return_inverse=True)
    strip, own = np.divmod(used, len(vertices))
    order = [BODY_STRIP, HEAD_STRIP, EYE_STRIP, PLAIN_STRIP]
    at = np.array([order.index(k) for k in strip])
    coordinates = laid(strip, places[own, at])
    colours = colours[own]
    colours[(strips[own] == EYE_STRIP) & (strip != EYE_STRIP)] = RIM
    return Part(vertices[own], triangles.reshape(-1, 3), colours, coordinates)


def _ear(body: np.ndarray, fin: Fin) -> Fin:
    """Return a fin of the head in the animal's own frame."""
    return Fin(_placed(fin.rays, body), fin.thick, fin.tint)


def serpent() -> tuple[np.ndarray, ...]:
    """Return the dragon, facing +x: vertices, faces, colours and texture coordinates.

    float32 (n, 3) in -1..1, int32 (m, 3), uint8 (n, 3), float32 (n, 2). The flesh and each part of
    bone are closed but for the seams of their charts, where vertices are doubled; membranes are
    open sheets, and have their own strip of the texture.
    """
    body = curve()
    fins: list[Fin] = [*crest(body), fluke(body), *(_ear(body, one) for one in ears())]
    parts = [_flesh(body), *_horns(body), *_teeth(body)]
    for fin in fins:
        parts += fin.spines()
    parts += [fin.membrane() for fin in fins]

    whole = joined(parts)
    low, high = whole.vertices.min(axis=0), whole.vertices.max(axis=0)
    vertices = (whole.vertices - (low + high) / 2) / ((high - low).max() / 2)
    return (
        vertices.astype(np.float32),
        whole.faces.astype(np.int32),
        whole.colours,
        whole.coordinates.astype(np.float32),
    )


ASSETS: dict[str, Callable[[], tuple[np.ndarray, ...]]] = {"serpent.ply": serpent}
