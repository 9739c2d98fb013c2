"""The ornate castle's pennants: strips that wave with kt, shaded by their slope.

State used: none but client arrays; the colour of the last vertex becomes the current colour.
"""

import numpy as np

from framelens.gl.seam import gl
from landscape.elements.best.castle.roofs import MASTS

PENNANT = (0.75, 0.12, 0.10)  # chosen
# A strip has six pairs of vertices; its slope at a pair is measured between these two pairs.
BEFORE, AFTER = np.array([0, 0, 1, 2, 3, 4]), np.array([1, 2, 3, 4, 5, 5])
QUADS = (np.arange(0, 10, 2)[:, None] + (0, 1, 3, 2)).ravel()  # the vertices of its five quads
_X, _Z, _FOOT, LENGTH = np.array(MASTS).T
TOP = np.stack([_X, _FOOT + 1.15 * LENGTH, _Z], axis=1)  # where a pennant hangs, (m, 3)
PHASE = 11.0 * np.arange(len(MASTS))  # chosen: kt between the waves of one pennant and the next
SPAN = (AFTER - BEFORE) * LENGTH[:, None]  # from BEFORE to AFTER, in fifths of a unit, (m, 6)
VERTEX = [("colour", "u1", 4), ("place", "f4", 3)]  # GL_C4UB_V3F


def pennant(kt: np.ndarray | float, length: np.ndarray | float) -> np.ndarray:
    """Return a pennant from its mast at x = 0 along x, a strip (12, 3) of six pairs of vertices.

    It waves with kt. Arrays (m,) of kt and lengths give m pennants, (m, 12, 3).
    """
    kt, length = np.asarray(kt)[..., None], np.asarray(length)[..., None]
    s = np.linspace(0.0, 1.0, 6)
    out = np.empty((*length.shape[:-1], 6, 2, 3), np.float32)
    out[..., 0] = (length * s)[..., None]
    half, sag = 0.16 * length * (1.0 - s), 0.06 * length * s * s
    out[..., 0, 1], out[..., 1, 1] = half - sag, -half - sag
    out[..., 2] = (0.09 * length * s * np.sin(9.0 * s - 0.35 * kt))[..., None]
    return out.reshape(*length.shape[:-1], 12, 3)


def pennant_vertices(kt: float, light: np.ndarray | float = 1.0) -> tuple[np.ndarray, np.ndarray]:
    """Return all pennants as quads: colours uint8 (n, 4), places float32 (n, 3).

    ``light`` (3,) multiplies their colour.
    """
    strips = pennant(kt + PHASE, LENGTH)
    wave = strips[:, ::2, 2]
    lean = (wave[:, AFTER] - wave[:, BEFORE]) / SPAN
    shades = np.clip(0.85 + 4.0 * lean, 0.5, 1.0)[:, QUADS // 2]
    colours = np.full((*shades.shape, 4), 255, np.uint8)
    colours[..., :3] = shades[..., None] * (255.0 * np.array(PENNANT) * light)
    places = strips[:, QUADS]
    places += TOP[:, None]
    return colours.reshape(-1, 4), places.reshape(-1, 3)


def interleaved(colours: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Return the bytes of GL_C4UB_V3F: per vertex four bytes of colour, then three floats.

    The same as a loop of glColor4ub and glVertex3f, in one array: see :func:`packed_by_hand`.
    """
    packed = np.empty(len(places), VERTEX)
    packed["colour"], packed["place"] = colours, places
    return packed.view(np.uint8)


def packed_by_hand(colours: np.ndarray, places: np.ndarray) -> bytes:
    """Return what :func:`interleaved` returns, vertex by vertex: its plain form, for the reader."""
    return b"".join(
        colour.astype(np.uint8).tobytes() + place.astype(np.float32).tobytes()
        for colour, place in zip(colours, places, strict=True)
    )


def draw_pennants(kt: float, light: np.ndarray | float = 1.0) -> None:
    """Draw the pennants on their masts in a light (3,); both sides are visible."""
    colours, places = pennant_vertices(kt, light)
    gl.glPushClientAttrib(gl.GL_CLIENT_VERTEX_ARRAY_BIT)
    gl.glInterleavedArrays(gl.GL_C4UB_V3F, 0, interleaved(colours, places))
    gl.glDrawArrays(gl.GL_QUADS, 0, len(places))
    gl.glPopClientAttrib()
