"""Blades that turn to the viewer, so that none is seen edge-on (``grass.facing``, R7, 11.2.2).

The direction d of a blade's wide side on the map becomes (1 - f) d + f r, where r is perpendicular
to the line from the eye to the blade, both of length 1. For f over 0.5 that sum never points along
the line of sight, whatever d is, and it changes smoothly as one walks: no blade flips over. Both
the plain form and the fast one are here; a test compares them. No OpenGL.
"""

import numpy as np

SIDES = np.array([-1.0, 1.0, -0.5, 0.5], np.float32)  # sideways, of a blade's feet and shoulders


def facing_plain(vertices: np.ndarray, away: np.ndarray, fraction: float) -> np.ndarray:
    """Return blades (n, 5, 3) with their wide side turned to the viewer by ``fraction``.

    ``away`` (n, 2) is x, z from the eye to each blade. Width and tip stay. :func:`facing` does the
    same in a tenth of the time.
    """
    half = (vertices[:, 1, ::2] - vertices[:, 0, ::2]) / 2
    width = np.linalg.norm(half, axis=1, keepdims=True)
    sideways = np.stack([-away[:, 1], away[:, 0]], axis=1)  # perpendicular to the line of sight
    sideways = sideways / np.linalg.norm(sideways, axis=1, keepdims=True)
    turned = (1.0 - fraction) * half / width + fraction * sideways
    turned *= width / np.linalg.norm(turned, axis=1, keepdims=True)
    out = vertices.copy()
    out[:, :4, ::2] += SIDES[:, None] * (turned - half)[:, None]
    return out


def facing(
    columns: np.ndarray,
    away: np.ndarray,
    fraction: float,
    sides: np.ndarray = SIDES,
    wider: np.ndarray | float = 1.0,
) -> None:
    """Turn blades in place as :func:`facing_plain` does: a row of all blades at a time.

    ``columns``, float32 (5, 3, n), holds each coordinate of each vertex in its own row;
    ``away`` (2, n) is x, z from the eye to each blade; ``sides`` (4,) is how far from the middle
    feet and shoulders are, times half the foot. Blades become ``wider`` (n,) times as wide.
    """
    # Directions on the map as complex numbers, x + i z: one operation for both coordinates.
    half = complexes(*(columns[1, ::2] - columns[0, ::2]) / 2)
    sight = complexes(*away)
    width = np.abs(half)
    across = sight * np.complex64(1j * fraction)
    turned = half * np.float32(1.0 - fraction) + across * (width / np.maximum(np.abs(sight), 1e-6))
    moved = turned * (wider * width / np.maximum(np.abs(turned), 1e-9)) - half
    for vertex, side in enumerate(sides):
        columns[vertex, 0] += side * moved.real
        columns[vertex, 2] += side * moved.imag


def complexes(real: np.ndarray, imaginary: np.ndarray) -> np.ndarray:
    """Return complex64 (n,) with these real and imaginary parts."""
    out = np.empty(len(real), np.complex64)
    out.real, out.imag = real, imaginary
    return out
