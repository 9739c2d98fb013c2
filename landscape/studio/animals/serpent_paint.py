"""Colours of the dragon of the preset `best`, and in which strip of its texture its parts lie.

Colours depend on the place: dark along the back, pale shields below, algae where the sea washes it
and where light falls, scars on the flanks. The texture has what is smaller than a triangle.
"""

import math

import numpy as np
from numba import njit

from landscape.elements.best.animals.serpent_skin import Strip
from landscape.studio.animals.paint import _blend
from landscape.studio.shapes import (
    across,
    ellipsoid,
    limb,
    mix,
    nearest,
    noise,
    step_smooth,
    turn,
)

BODY_STRIP, HEAD_STRIP, FIN_STRIP, BONE_STRIP, EYE_STRIP, PLAIN_STRIP = map(int, Strip)

# All chosen.
BACK = (0.165, 0.198, 0.190)
FLANK = (0.385, 0.430, 0.390)
BELLY = (0.640, 0.605, 0.500)
BLOTCH = (0.115, 0.140, 0.125)
ALGAE = (0.200, 0.235, 0.085)
SCAR = (0.560, 0.530, 0.490)
MOUTH = (0.300, 0.120, 0.115)
GUM = (0.235, 0.165, 0.150)
IRIS = (0.95, 0.95, 0.95)
LID = (0.10, 0.11, 0.10)
HEAD_MIDDLE = -0.035  # height in head space about which the head's skin lies


@njit
def _flesh_colours(positions, normals, data):  # type: ignore[no-untyped-def]
    """Return colours (n, 3), strips (n,) and places in the strips (n, 4, 2) of positions (n, 3)."""
    curve, pitch = data
    out = np.empty_like(positions)
    strips = np.empty(len(positions), np.int64)
    places = np.empty((len(positions), 4, 2))
    end = curve.shape[0] - 1
    for n in range(len(positions)):
        x = positions[n, 0]
        y = positions[n, 1]
        z = positions[n, 2]
        i, t, _ = nearest(curve, x, y, z)
        u, v = across(curve, i, t, x, y, z)
        angle = abs(math.atan2(v, u))
        s = mix(curve[i, 4], curve[i + 1, 4], t)
        hx, hy = turn(x - curve[end, 0], y - curve[end, 1], -pitch)
        hz = z - curve[end, 2]
        a = abs(hz)
        near = hx * hx + hy * hy + hz * hz < 0.36
        head = near and hx > 0.0
        around = math.atan2(a, hy - HEAD_MIDDLE)
        places[n, 0] = s, angle / math.pi
        places[n, 1] = 1.30 * hx, around / math.pi
        places[n, 2] = (hx - 0.145) / 0.052, (hy - 0.034) / 0.052
        places[n, 3] = 0.5, 0.5
        strips[n] = HEAD_STRIP if head else BODY_STRIP

        # Head and body in the same colours, by how far round from the back.
        turned = angle
        if near:
            turned = mix(angle, around, step_smooth(-0.06, 0.06, hx))
        colour = np.array(FLANK)
        _blend(colour, BACK, step_smooth(1.55, 0.55, turned + 0.25 * noise(9 * x, 9 * y, 9 * z)))
        _blend(colour, BELLY, step_smooth(1.95, 2.55, turned + 0.16 * noise(6 * x, 6 * y, 6 * z)))
        blotch = noise(11 * x, 11 * y, 11 * z) + 0.5 * noise(27 * x, 27 * y, 27 * z)
        bars = math.sin(2 * math.pi * (2.0 * s + 0.22 * noise(5 * x, 5 * y, 5 * z)))
        dark = step_smooth(0.15, 0.75, blotch + 0.45 * bars) * step_smooth(2.35, 1.9, turned)
        _blend(colour, BLOTCH, 0.75 * dark)

        # Algae grow where the sea washes over it and on what faces the light.
        grows = noise(8 * x + 3, 8 * y, 8 * z) + 0.6 * noise(31 * x, 31 * y, 31 * z + 5)
        washed = step_smooth(0.24, 0.06, y) * step_smooth(2.6, 2.1, turned)
        lit = step_smooth(0.35, 0.9, normals[n, 1])
        _blend(colour, ALGAE, 0.70 * washed * step_smooth(-0.35, 0.45, grows))
        _blend(colour, ALGAE, 0.38 * lit * step_smooth(0.10, 0.75, grows))

        # Scars: thin slanting lines, in a few places.
        line = 9.0 * s + 1.9 * angle + 0.8 * noise(4 * x, 4 * y, 4 * z)
        line = abs(line - math.floor(line + 0.5))
        scarred = step_smooth(0.42, 0.70, noise(2.6 * x + 7, 2.6 * y, 2.6 * z))
        _blend(colour, SCAR, 0.6 * scarred * step_smooth(0.10, 0.03, line))

        if near:
            inside = limb(hx, hy, a * 0.9, 0.15, -0.060, 0.0, 0.030, 0.30, -0.076, 0.0, 0.026)
            wet = step_smooth(0.012, -0.006, inside)
            _blend(colour, MOUTH, wet)
            gum = limb(hx, hy, a, 0.145, -0.042, 0.056, 0.010, 0.368, -0.030, 0.026, 0.008)
            _blend(colour, GUM, 0.8 * step_smooth(0.008, 0.0, gum))
            if wet > 0.5:
                strips[n] = PLAIN_STRIP
            socket = ellipsoid(hx - 0.145, hy - 0.034, a - 0.076, 0.036, 0.027, 0.026)
            _blend(colour, LID, 0.8 * step_smooth(0.010, -0.004, socket))
            eye = ellipsoid(hx - 0.145, hy - 0.034, a - 0.070, 0.0245, 0.0215, 0.0225)
            if eye < 0.0025 and a > 0.07:
                strips[n] = EYE_STRIP
                colour[:] = np.array(IRIS)
        for k in range(3):
            out[n, k] = colour[k]

    return out, strips, places


def flesh_colours(
    positions: np.ndarray, normals: np.ndarray, data: tuple[np.ndarray, float]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the looks of points (n, 3) of the flesh, in its own frame.

    Colours uint8 (n, 3); the strip of the texture (n,) that each is in; and where it would be in
    the strips of body, head, eye and plain (n, 4, 2), each in 0..1 across, and along in tiles.
    """
    colours, strips, places = _flesh_colours(positions, normals, data)
    return np.asarray(np.clip(colours * 255 + 0.5, 0, 255), np.uint8), strips, places
