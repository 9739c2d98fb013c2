"""Land in the tones that a photograph gives it (``ground.tone``).

A camera exposes for the sky as well, so land is darker and duller than the colours that one would
name: grass in the sun is olive rather than green, and rock is almost grey. The ground's large
colours, those of the sward on it and those of stones are darkened here and drained of colour; grass
that is pale is darkened most. It is done once, when the colours are made. No OpenGL here.
"""

import numpy as np

# All chosen, by comparing medians of meadows and of rock with those of photographs.
OLIVE = 0.45  # of what the green of grass has above its red
DARKER = 0.88  # how light grass is left
DRAINED = 0.30  # of the colour of bare ground and rock
STONES_DRAINED = 0.55  # of that of stones, which have the sun's yellow in their paint
DIMMED = 0.88  # how light bare ground and rock are left
PALE, SHOULDER = 0.44, 0.45  # grass lighter than this is darkened by this power of the ratio
LUMINANCE = np.array([0.30, 0.59, 0.11], np.float32)


def turf_toned(colours: np.ndarray, strength: float) -> np.ndarray:
    """Return colours of grass, float (..., 3) in 0..1, toned by ``strength``, 0..1."""
    olive = np.array(colours)  # in the order in which they lie in memory
    olive[..., 1] -= OLIVE * np.maximum(colours[..., 1] - colours[..., 0], 0.0)
    light = (colours @ LUMINANCE)[..., None]
    left = DARKER * (PALE / np.maximum(light, PALE)) ** np.float32(SHOULDER)
    return np.asarray(colours + strength * (left * olive - colours))


def bare_toned(colours: np.ndarray, strength: float, drained: float = DRAINED) -> np.ndarray:
    """Return colours of bare ground, rock or stones, float (..., 3) in 0..1, toned."""
    light = (colours @ LUMINANCE)[..., None]
    grey = DIMMED * (colours + drained * (light - colours))
    return np.asarray(colours + strength * (grey - colours))


def toned(colours: np.ndarray, turf: np.ndarray, strength: float) -> np.ndarray:
    """Return the ground's colours, uint8 (n, n, 3), toned; ``turf``, uint8 (n, n, 1), is grass."""
    out = np.empty_like(colours)
    rows = max((1 << 20) // max(colours.shape[1], 1), 1)  # a few megabytes in memory at a time
    for first in range(0, len(colours), rows):
        part = slice(first, first + rows)
        colour = colours[part] / np.float32(255.0)
        share = turf[part] / np.float32(255.0)
        bare = bare_toned(colour, strength)
        mixed = bare + share * (turf_toned(colour, strength) - bare)
        out[part] = np.clip(255.0 * mixed + 0.5, 0, 255)
    return out
