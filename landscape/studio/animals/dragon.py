"""The sea dragon: a serpent that arches in and out of the water, as one closed mesh.

The body follows a Catmull-Rom curve with a radius. Every sample of the distance field finds its
nearest point on the curve and is expressed in the curve's local frame (along, towards the back, to
the side), where scales, belly plates and the crest are simple functions. The head and the tail fin
are modelled in the frames of the two ends; the operators are in :mod:`landscape.studio.shapes`.
The vertex count is that of the Stanford dragon at its third resolution, so the numbers of 2006
hold for this mesh too.
"""

import math
from collections.abc import Callable

import numpy as np
from numba import njit

from landscape.studio.animals.paint import dragon_colours
from landscape.studio.animals.sculpture import PaintedMesh, sculpt
from landscape.studio.shapes import (
    across,
    carve,
    catmull_rom,
    clamp,
    ellipsoid,
    limb,
    mix,
    nearest,
    step_smooth,
    turn,
    union,
)

VERTICES = 22998  # dragon_vrip_res3.ply of the 2006 report
STEP = 0.0075  # chosen: about two thirds of the final edge length
BOX = ((-1.35, -0.56, -0.30), (1.24, 1.06, 0.34))  # chosen: contains the curve and the head
HORN_SAMPLES = 30  # chosen
SAMPLES = 420  # chosen: points of the body curve, dense enough for a smooth crest

# The body from the tail to the nape: x, y, z, radius. The water level is at about y = 0.
# All chosen: two arches, a dive, and an S-shaped neck, swaying a little to both sides.
BODY = np.array(
    [
        (-1.02, 0.17, 0.10, 0.020),
        (-1.01, 0.02, 0.09, 0.030),
        (-0.95, -0.24, 0.05, 0.044),
        (-0.82, -0.36, 0.00, 0.058),
        (-0.69, -0.22, -0.06, 0.068),
        (-0.62, 0.02, -0.10, 0.076),
        (-0.57, 0.14, -0.12, 0.080),
        (-0.45, 0.19, -0.12, 0.084),
        (-0.33, 0.14, -0.11, 0.087),
        (-0.28, 0.02, -0.09, 0.090),
        (-0.22, -0.22, -0.03, 0.095),
        (-0.10, -0.36, 0.03, 0.099),
        (0.01, -0.22, 0.08, 0.103),
        (0.06, 0.04, 0.12, 0.106),
        (0.11, 0.21, 0.13, 0.107),
        (0.23, 0.27, 0.13, 0.108),
        (0.35, 0.21, 0.12, 0.109),
        (0.40, 0.04, 0.10, 0.110),
        (0.44, -0.22, 0.04, 0.111),
        (0.55, -0.36, -0.01, 0.111),
        (0.68, -0.20, -0.08, 0.107),
        (0.71, 0.05, -0.09, 0.098),
        (0.67, 0.27, -0.06, 0.086),
        (0.60, 0.46, -0.01, 0.076),
        (0.63, 0.62, 0.02, 0.071),
        (0.75, 0.68, 0.03, 0.070),
    ]
)
HEAD_PITCH_DEG = -12.0  # chosen: the muzzle points slightly down
# Chosen: one horn in head space, from the root to the tip: x, y, z, radius.
HORN = np.array(
    [
        (0.02, 0.06, 0.055, 0.038),
        (-0.06, 0.13, 0.085, 0.034),
        (-0.16, 0.165, 0.115, 0.026),
        (-0.26, 0.18, 0.135, 0.018),
        (-0.34, 0.225, 0.140, 0.008),
    ]
)
SPINE_GAP = 0.11  # chosen: distance between two spines of the crest
SCALES_AROUND = 12  # chosen: scales around the body


def body_curve() -> np.ndarray:
    """Return the body as (SAMPLES, 14), one row per point from the tail to the nape.

    Columns: 0..2 position, 3 radius, 4 phase (increases by 1 per row of scales), 5..7 unit vector
    towards the back, 8..10 unit vector to the side, 11 arc length from the tail, 12 arc length to
    the nape, 13 phase of the crest (increases by 1 per spine, measured along its rim).
    """
    curve = catmull_rom(BODY, SAMPLES)
    tangent = np.gradient(curve[:, :3], axis=0)
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    side = np.array([0.0, 0.0, 1.0]) - tangent * tangent[:, 2:3]
    side /= np.linalg.norm(side, axis=1)[:, None]
    back = np.cross(side, tangent)
    piece = np.linalg.norm(np.diff(curve[:, :3], axis=0), axis=1)
    length = np.append(0.0, np.cumsum(piece))
    row = 2 * np.pi * curve[:, 3] / SCALES_AROUND
    phase = np.append(0.0, np.cumsum(piece / row[1:]))
    rim = curve[:, :3] + 1.7 * curve[:, 3:4] * back
    spine = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(rim, axis=0), axis=1))) / SPINE_GAP
    return np.column_stack([curve, phase, back, side, length, length[-1] - length, spine])


@njit
def _relief(phase: float, angle: float, radius: float) -> float:
    """Return the height of the scales (back and flanks) and plates (belly) above the body."""
    plates = step_smooth(2.25, 2.45, abs(angle))
    f = phase * 0.6 - math.floor(phase * 0.6)
    plate = f**0.7 * (1.0 - step_smooth(0.82, 1.0, f))
    best = 0.0
    row = math.floor(phase)
    for r in (row - 1, row, row + 1):
        across = angle / (2 * math.pi) * SCALES_AROUND + 0.5 * (r % 2)
        w = across - math.floor(across) - 0.5
        along = phase - r - 0.5
        e = 1.0 - (w / 0.56) ** 2 - (along / 0.85) ** 2
        if e > 0.0:
            best = max(best, math.sqrt(e) * (0.65 - 0.4 * along))
    return radius * (0.19 * best * (1.0 - plates) + (0.10 * plate + 0.02) * plates)


@njit
def _crest(
    spine: float, s: float, ahead: float, height: float, u: float, v: float, radius: float
) -> float:
    """Return the distance to the fin along the back.

    ``s`` and ``ahead`` are the arc lengths to the tail and to the nape. The fin is tall on the
    arches and low near the water (``height`` is y), where the coils come close to each other.
    """
    f = spine - math.floor(spine)
    tall = (0.045 + 0.75 * radius) * mix(0.30, 1.0, step_smooth(-0.10, 0.15, height))
    tall *= step_smooth(0.02, 0.25, s) * step_smooth(0.0, 0.15, ahead)
    saw = f / 0.2 if f < 0.2 else ((1.0 - f) / 0.8) ** 1.7
    edge = tall * (0.38 + 0.72 * saw)
    rib = math.exp(-(((f - 0.2) / 0.13) ** 2))
    t = clamp((u - radius) / max(tall, 1e-3), 0.0, 1.0)
    half = mix(0.021, 0.0075, t) + 0.008 * rib * (1.0 - 0.5 * t)
    return max(abs(v) - half, (u - radius - edge) * 0.8, -u)


@njit
def _tail_fin(x: float, y: float, z: float) -> float:
    """Return the distance to the fluke in the frame of the tail: x outward, y to the back."""
    x = x + 0.03
    rho, phi = math.sqrt(x * x + y * y), math.atan2(abs(y), x)
    ribs = phi / 0.36
    f = abs(ribs - math.floor(ribs + 0.5)) * 2.0
    reach = 0.17 + 0.14 * step_smooth(0.0, 1.0, phi) - 0.035 * f * f
    t = clamp(rho / reach, 0.0, 1.0)
    half = mix(0.024, 0.0075, t) + 0.007 * math.exp(-((f / 0.35) ** 2)) * (1.0 - 0.5 * t)
    return max(abs(z) - half, (rho - reach) * 0.8, rho * math.sin(clamp(phi - 1.12, -1.5, 1.5)))


@njit
def _head(x: float, y: float, z: float, horn_curve: np.ndarray) -> float:
    """Return the distance to the head: origin at the nape, x to the muzzle, y up, mirrored in z."""
    a = abs(z)

    # Skull and upper jaw, with knobs at the back, then the nostrils.
    d = ellipsoid(x - 0.07, y - 0.02, a, 0.145, 0.098, 0.098)
    upper = limb(x, y * 1.15, a * 0.85, 0.10, 0.015, 0.0, 0.080, 0.34, 0.0, 0.0, 0.052)
    d = union(d, upper, 0.05)
    knobs = math.cos(75.0 * (x + y)) * math.cos(75.0 * (x - y))
    d -= 0.0035 * knobs * step_smooth(0.30, 0.12, x)
    d = union(d, ellipsoid(x - 0.355, y - 0.045, a - 0.028, 0.035, 0.026, 0.024), 0.025)
    d = union(d, limb(x, y, a, 0.20, 0.075, 0.0, 0.02, 0.33, 0.05, 0.0, 0.012), 0.03)
    d = carve(d, ellipsoid(x - 0.378, y - 0.052, a - 0.034, 0.014, 0.012, 0.010), 0.01)

    # Lower jaw and cheeks.
    lower = limb(x, y * 1.1, a * 0.8, 0.05, -0.07, 0.0, 0.060, 0.30, -0.165, 0.0, 0.034)
    d = union(d, lower, 0.03)
    d = union(d, ellipsoid(x - 0.03, y + 0.045, a - 0.07, 0.08, 0.06, 0.04), 0.03)

    # Brow, eye socket and eye.
    d = union(d, limb(x, y, a, 0.03, 0.085, 0.055, 0.026, 0.195, 0.078, 0.078, 0.020), 0.02)
    d = carve(d, ellipsoid(x - 0.145, y - 0.045, a - 0.095, 0.044, 0.030, 0.025), 0.015)
    d = union(d, ellipsoid(x - 0.145, y - 0.045, a - 0.072, 0.032, 0.027, 0.024), 0.006)

    # Horn with its growth rings.
    i, t, distance = nearest(horn_curve, x, y, a)
    ring = math.sin(((i + t) / (HORN_SAMPLES - 1)) ** 1.3 * 60.0)
    thick = mix(horn_curve[i, 3], horn_curve[i + 1, 3], t)
    horn = distance - thick * (1.0 + 0.07 * ring)
    d = union(d, horn, 0.02)

    # Ear fin: three spines with skin between them.
    p, q = turn(x, a - 0.075, 0.60)
    fan = 1e9
    for k in range(3):
        tilt = 0.55 - 0.55 * k
        fan = union(
            fan,
            limb(
                p,
                y,
                q * 2.0,
                0.04,
                -0.02,
                0.0,
                0.03,
                -0.19 * math.cos(tilt),
                -0.02 + 0.19 * math.sin(tilt),
                0.0,
                0.013,
            ),
            0.10,
        )

    d = union(d, fan * 0.7, 0.015)

    # Teeth, fangs above and below, and the beard.
    for k in range(4):
        tx = 0.16 + 0.05 * k
        d = union(
            d, limb(x, y, a, tx, -0.02, 0.052, 0.014, tx + 0.005, -0.075, 0.050, 0.005), 0.006
        )

    d = union(d, limb(x, y, a, 0.345, -0.02, 0.035, 0.016, 0.35, -0.10, 0.035, 0.005), 0.006)
    d = union(d, limb(x, y, a, 0.28, -0.13, 0.026, 0.014, 0.285, -0.085, 0.026, 0.005), 0.006)
    return union(d, limb(x, y, a, 0.28, -0.18, 0.0, 0.022, 0.22, -0.27, 0.0, 0.006), 0.02)


@njit
def dragon_field(x: float, y: float, z: float, data: tuple[np.ndarray, float, np.ndarray]) -> float:
    """Return the signed distance to the dragon: x to the front, y up, z to its right."""
    curve, pitch, horn = data
    i, t, distance = nearest(curve, x, y, z)
    radius = mix(curve[i, 3], curve[i + 1, 3], t)
    d = distance - radius
    if d < 0.16 and d > -0.5 * radius:
        u, v = across(curve, i, t, x, y, z)
        s = mix(curve[i, 11], curve[i + 1, 11], t)
        ahead = mix(curve[i, 12], curve[i + 1, 12], t)
        spine = mix(curve[i, 13], curve[i + 1, 13], t)
        d -= _relief(mix(curve[i, 4], curve[i + 1, 4], t), math.atan2(v, u), radius)
        if s > 0.0 and ahead > 0.0:  # beyond the ends of the curve the frame is undefined
            d = union(d, _crest(spine, s, ahead, y, u, v, radius), 0.012)

    end = curve.shape[0] - 1
    hx, hy = turn(x - curve[end, 0], y - curve[end, 1], -pitch)
    if hx * hx + hy * hy < 0.36:
        d = union(d, _head(hx, hy, z - curve[end, 2], horn), 0.03)
    tx = x - curve[0, 0]
    ty = y - curve[0, 1]
    tz = z - curve[0, 2]
    if tx * tx + ty * ty + tz * tz < 0.16:
        bx = curve[0, 5]
        by = curve[0, 6]
        bz = curve[0, 7]
        sx = curve[0, 8]
        sy = curve[0, 9]
        sz = curve[0, 10]
        # back x side is the tangent, which points to the head; the fin points the other way.
        out = -(tx * (by * sz - bz * sy) + ty * (bz * sx - bx * sz) + tz * (bx * sy - by * sx))
        up, side = tx * bx + ty * by + tz * bz, tx * sx + ty * sy + tz * sz
        d = union(d, _tail_fin(out, up, side), 0.02)

    return d


def dragon() -> PaintedMesh:
    """Return the dragon, facing +x.

    Vertices float32 (22998, 3) in -1..1, faces int32 (m, 3), vertex colours uint8 (22998, 3).
    """
    data = (body_curve(), math.radians(HEAD_PITCH_DEG), catmull_rom(HORN, HORN_SAMPLES))
    low, high = np.array(BOX[0]), np.array(BOX[1])
    return sculpt(dragon_field, data, low, high, STEP, VERTICES, dragon_colours, data)


ASSETS: dict[str, Callable[[], PaintedMesh]] = {"dragon.ply": dragon}
