"""Vertex colours of the rabbit and the dragon: coat, belly, eyes, horns and fins.

The colour of a vertex depends on its position relative to the curves and limbs that the animal is
sculpted from. Colours are in 0..1; the program multiplies them with the nearly white texture of
the animals.
"""

import math

import numpy as np
from numba import njit

from landscape.studio.shapes import (
    across,
    clamp,
    ellipsoid,
    limb,
    mix,
    nearest,
    noise,
    step_smooth,
    turn,
)

# All chosen.
COAT = (0.66, 0.53, 0.39)
BACK = (0.46, 0.35, 0.25)
CREAM = (0.97, 0.91, 0.82)
EAR_INSIDE = (0.86, 0.65, 0.58)
EAR_TIP = (0.30, 0.23, 0.18)
NOSE = (0.55, 0.36, 0.32)
RABBIT_EYE = (0.07, 0.05, 0.05)
FLANK = (0.26, 0.56, 0.50)
SPINE = (0.10, 0.31, 0.36)
PLATES = (0.93, 0.84, 0.60)
FIN = (0.72, 0.38, 0.26)
FIN_EDGE = (0.93, 0.66, 0.36)
HORN = (0.80, 0.73, 0.60)
TOOTH = (1.0, 0.96, 0.86)
DRAGON_EYE, MOUTH = (1.0, 0.72, 0.12), (0.55, 0.16, 0.16)


@njit
def _blend(colour, other, weight):  # type: ignore[no-untyped-def]
    """Blend a colour (3,) towards another by ``weight`` (clamped to 0..1), in place."""
    weight = clamp(weight, 0.0, 1.0)
    for k in range(3):
        colour[k] += (other[k] - colour[k]) * weight


@njit
def _rabbit_colours(positions, normals, head_yaw):  # type: ignore[no-untyped-def]
    """Return the colours (n, 3) of positions (n, 3) in the rabbit's own frame (see rabbit.py)."""
    out = np.empty_like(positions)
    for i in range(len(positions)):
        x = positions[i, 0]
        y = positions[i, 1]
        z = positions[i, 2]
        up = normals[i, 1]
        hair = noise(9 * x + 4 * y, 24 * y - 6 * x, 24 * z)
        colour = np.array(COAT)
        _blend(colour, BACK, 0.75 * step_smooth(-0.1, 0.9, up) * step_smooth(0.5, 0.9, y))
        _blend(colour, BACK, 0.30 * step_smooth(0.2, 1.0, hair))
        # Belly, chest, throat, tail and the undersides of the feet are pale.
        _blend(colour, CREAM, 0.85 * step_smooth(0.1, -0.7, up) * step_smooth(1.5, 1.1, y))
        chest = step_smooth(0.45, 0.62, x) * step_smooth(0.45, 0.65, y)
        _blend(colour, CREAM, 0.7 * chest * step_smooth(1.02, 0.85, y))
        _blend(colour, CREAM, 0.45 * step_smooth(0.22, 0.08, y))
        tail = ellipsoid(x + 0.98, y - 0.45, z, 0.19, 0.19, 0.18)
        _blend(colour, CREAM, step_smooth(0.06, 0.0, tail))
        # Head, in its own frame.
        hx, hz = turn(x - 0.62, z, head_yaw)
        hy, a = y - 1.18, abs(hz)
        if hx * hx + hy * hy + hz * hz < 1.6 and y > 0.9:
            ring = ellipsoid(hx - 0.11, hy - 0.075, a - 0.19, 0.11, 0.095, 0.09)
            _blend(colour, CREAM, 0.45 * step_smooth(0.02, -0.01, ring))
            snout = ellipsoid(hx - 0.31, hy + 0.09, a, 0.13, 0.12, 0.13)
            _blend(colour, CREAM, 0.65 * step_smooth(0.03, -0.02, snout))
            nose = ellipsoid(hx - 0.385, hy + 0.012, a, 0.045, 0.038, 0.05)
            _blend(colour, NOSE, step_smooth(0.015, 0.0, nose))
            # Vertex colours spread by half an edge, so the eye is painted slightly smaller.
            eye = ellipsoid(hx - 0.11, hy - 0.075, a - 0.162, 0.062, 0.052, 0.062)
            _blend(colour, RABBIT_EYE, step_smooth(0.006, 0.0, eye))
            u, w = turn(hx + 0.10, a - 0.098, 0.23)
            u, v = turn(u, hy - 0.19, 0.72 - math.pi)
            t = clamp(u / 0.86, 0.0, 1.0)
            v = -v - 0.10 * t * t + 0.9 * w * w
            if u > 0.12:
                half = 0.150 * (0.42 + 1.9 * t - 1.2 * t * t - 1.1 * t**6)
                hollow = math.sqrt(w * w + (1.7 * (v - 0.085)) ** 2) - half * 0.80
                _blend(colour, EAR_INSIDE, 0.9 * step_smooth(0.02, 0.0, hollow))
                _blend(colour, EAR_TIP, 0.7 * step_smooth(0.78, 0.98, t))
        for k in range(3):
            out[i, k] = colour[k]

    return out


@njit
def _dragon_colours(positions, normals, data):  # type: ignore[no-untyped-def]
    """Return the colours (n, 3) of positions (n, 3) in the dragon's own frame (see dragon.py)."""
    curve, pitch, horn = data
    out = np.empty_like(positions)
    end = curve.shape[0] - 1
    for n in range(len(positions)):
        x = positions[n, 0]
        y = positions[n, 1]
        z = positions[n, 2]
        i, t, distance = nearest(curve, x, y, z)
        radius = mix(curve[i, 3], curve[i + 1, 3], t)
        u, v = across(curve, i, t, x, y, z)
        angle = abs(math.atan2(v, u))
        colour = np.array(FLANK)
        _blend(colour, SPINE, step_smooth(1.7, 0.4, angle))
        _blend(colour, PLATES, step_smooth(2.0, 2.45, angle))
        spots = noise(13 * x, 13 * y, 13 * z)
        _blend(colour, SPINE, 0.5 * step_smooth(0.25, 0.8, spots) * step_smooth(2.3, 1.9, angle))
        # The gaps between the scales are darker.
        deep = step_smooth(0.19, 0.02, (distance - radius) / radius)
        for k in range(3):
            colour[k] *= 1.0 - 0.45 * deep
        over = (u - radius * 1.12) / radius
        if over > 0.0 and abs(v) < 0.06:
            _blend(colour, FIN, step_smooth(0.0, 0.15, over))
            _blend(colour, FIN_EDGE, step_smooth(0.25, 0.75, over))
        hx, hy = turn(x - curve[end, 0], y - curve[end, 1], -pitch)
        hz = z - curve[end, 2]
        a = abs(hz)
        if hx > -0.05 and hx * hx + hy * hy + hz * hz < 0.36:
            colour[:] = np.array(FLANK)
            _blend(colour, SPINE, step_smooth(-0.02, 0.08, hy))
            _blend(colour, PLATES, step_smooth(-0.12, -0.17, hy - 0.30 * max(0.2 - hx, 0.0)))
        if hx * hx + hy * hy + hz * hz < 0.36:
            between = limb(hx, hy, a * 0.9, 0.16, -0.065, 0.0, 0.045, 0.30, -0.09, 0.0, 0.035)
            _blend(colour, MOUTH, step_smooth(0.012, -0.01, between))
            eye = ellipsoid(hx - 0.145, hy - 0.045, a - 0.072, 0.032, 0.027, 0.024)
            _blend(colour, DRAGON_EYE, step_smooth(0.008, 0.002, eye))
            tooth = 1.0
            for k in range(4):
                tx = 0.16 + 0.05 * k
                one = limb(hx, hy, a, tx, -0.035, 0.052, 0.014, tx + 0.005, -0.075, 0.050, 0.005)
                tooth = min(tooth, one)
            one = limb(hx, hy, a, 0.345, -0.03, 0.035, 0.016, 0.35, -0.10, 0.035, 0.005)
            tooth = min(tooth, one)
            one = limb(hx, hy, a, 0.28, -0.12, 0.026, 0.014, 0.285, -0.085, 0.026, 0.005)
            _blend(colour, TOOTH, step_smooth(0.010, 0.003, min(tooth, one)))
            # Ear fin: away from the neck, behind the jaw.
            p, q = turn(hx, a - 0.075, 0.60)
            ear = step_smooth(0.015, 0.03, distance - radius) * step_smooth(0.05, 0.03, abs(q))
            _blend(colour, FIN, ear * step_smooth(0.0, -0.05, p) * step_smooth(0.13, 0.10, hy))
            j, s, gap = nearest(horn, hx, hy, a)
            gap -= mix(horn[j, 3], horn[j + 1, 3], s) * 1.1
            along = (j + s) / (horn.shape[0] - 1)
            _blend(colour, HORN, step_smooth(0.012, 0.002, gap) * step_smooth(0.05, 0.2, along))
        tx = x - curve[0, 0]
        ty = y - curve[0, 1]
        tz = z - curve[0, 2]
        far = math.sqrt(tx * tx + ty * ty + tz * tz)
        if i < 3:
            _blend(colour, FIN, step_smooth(0.05, 0.12, far))
            _blend(colour, FIN_EDGE, step_smooth(0.16, 0.28, far))
        for k in range(3):
            out[n, k] = colour[k]

    return out


def rabbit_colours(positions: np.ndarray, normals: np.ndarray, head_yaw: float) -> np.ndarray:
    """Return the colours, uint8 (n, 3), of points (n, 3) on the rabbit, in its own frame."""
    return _bytes(_rabbit_colours(positions, normals, head_yaw))


def dragon_colours(
    positions: np.ndarray, normals: np.ndarray, data: tuple[np.ndarray, float, np.ndarray]
) -> np.ndarray:
    """Return the colours, uint8 (n, 3), of points (n, 3) on the dragon, in its own frame."""
    return _bytes(_dragon_colours(positions, normals, data))


def _bytes(colours: np.ndarray) -> np.ndarray:
    return np.asarray(np.clip(colours * 255 + 0.5, 0, 255), np.uint8)
