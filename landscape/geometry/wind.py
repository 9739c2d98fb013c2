"""The wind: how far it moves the tops of plants and blades of grass (section 5.2.2). No OpenGL."""

import numpy as np


def sway(kt: float, positions: np.ndarray, strength: float = 1.0) -> np.ndarray:
    """Return the wind's dx, dz (n, 2), in units, at positions (n, 3), section 5.2.2."""
    x, z = positions[:, 0], positions[:, 2]
    dx = 0.05 * np.cos(kt / 10 - 1.2 * x - 0.744 * z)
    dz = 0.03 * np.cos(kt / 9.6 - 1.44 * x)
    return np.stack([dx, dz], axis=1) * strength
