"""Gusts: waves of wind that travel over the meadow and bend what they pass (``grass.gusts``).

The report's sway moves all blades in view nearly alike: its waves are four units long. A gust is a
crest a few tenths of a unit wide, bent and broken across its way, that comes along every unit or
so; within it each blade trembles on its own. No OpenGL here.
"""

import numpy as np

WAY = np.array([0.85, 0.53], np.float32)  # chosen: x, z of the wind's direction, as the sway's
LENGTH = 1.25  # chosen: units from gust to gust
SPEED = 0.012  # chosen: units per kt
BEND, TREMBLE = 0.0070, 0.0011  # chosen: units that a crest moves a tip along its way, and across


def gusts(kt: float, x: np.ndarray, z: np.ndarray, strength: float) -> np.ndarray:
    """Return dx, dz (2, n) of tips at x, z: up to ``strength`` times BEND, in units."""
    along, across = x * WAY[0] + z * WAY[1], z * WAY[0] - x * WAY[1]
    k = np.float32(2.0 * np.pi / LENGTH)
    # Crests are curved, and stronger here than there: plane waves would look like a machine.
    phase = k * (along - np.float32(SPEED * kt)) + 1.3 * np.sin(2.1 * across + 0.7 * along)
    crest = 0.5 + 0.5 * np.sin(phase)
    crest *= crest * (0.65 + 0.35 * np.sin(1.7 * across - np.float32(kt / 47.0)))
    tremble = np.sin(np.float32(kt / 1.9) + 41.0 * x + 67.0 * z) * (0.25 + crest)
    bend, side = np.float32(strength * BEND) * crest, np.float32(strength * TREMBLE) * tremble
    return np.stack([bend * WAY[0] - side * WAY[1], bend * WAY[1] + side * WAY[0]])
