"""How far away sprites are drawn, and how opaque they are: rules of the preset best. No OpenGL."""

import math

import numpy as np

from landscape.elements.best.sprites.refined_quads import smoothstep
from landscape.elements.planting import DEER, PLANT
from landscape.elements.settings import Settings
from landscape.frame import Frame

CROSSFADE = (0.80, 0.90, 1.0)  # chosen: times plants.crossed_within; see crossing
# Chosen, times its width: how near the eye a plant is invisible, and how far away opaque; and the
# same of trees and deer, for an eye in the trunk, and for one as near as a walker gets to it.
PLANT_CLEARS, TRUNK_CLEARS = (0.2, 0.5), (0.05, 0.12)
LEAST = 1e-6  # units: a shorter distance is none, and nothing is divided by it
HAZE = 512.0  # where the fog leaves less than 1/512 of a colour, no 8-bit value changes


def is_deer(cells: np.ndarray) -> np.ndarray:
    """Return which sprites (n,) are deer, by their atlas cells."""
    return np.asarray((cells >= DEER) & (cells < PLANT))


def farthest(settings: Settings) -> float:
    """Return how far sprites are drawn; sprites that fade stop where the fog hides them."""
    shared, fog = settings.transparent, settings.fog
    if shared.fade and fog.enabled and fog.mode == "exp2" and fog.density > 0:
        return min(shared.radius, math.sqrt(math.log(HAZE)) / fog.density)
    return shared.radius


def radii(settings: Settings, cells: np.ndarray, heights: np.ndarray, frame: Frame) -> np.ndarray:
    """Return how far sprites of these atlas cells and heights (n,) are drawn, float32 units.

    No farther than ``transparent.radius`` and ``plants.radius``, and only as far as they are at
    least ``transparent.min_pixels`` pixels high.
    """
    far, least = farthest(settings), settings.transparent.min_pixels
    plants = np.float32(min(far, settings.plants.radius or far))
    out = np.where(cells >= PLANT, plants, np.float32(far))
    return np.minimum(out, heights * np.float32(min(frame.pixels / least, 1e30))) if least else out


def clearness(
    settings: Settings,
    cells: np.ndarray,
    radius: np.ndarray,
    widths: np.ndarray,
    away: np.ndarray,
) -> np.ndarray:
    """Return the opacity 0..1 (n,) of sprites of these cells and widths, ``away`` (n,) units away.

    They fade towards their ``radius`` (``transparent.fade``), and before the eye passes through
    them (``transparent.clear_near``).
    """
    shared, out = settings.transparent, np.ones_like(away)
    if shared.fade:
        out *= np.clip((radius - away) / np.maximum(shared.fade * radius, LEAST), 0.0, 1.0)
    if shared.clear_near:
        near = np.flatnonzero(away < PLANT_CLEARS[1] * widths)
        plant = (cells[near] >= PLANT)[:, None]
        gone, whole = np.where(plant, PLANT_CLEARS, TRUNK_CLEARS).T
        out[near] *= np.clip((away[near] / widths[near] - gone) / (whole - gone), 0.0, 1.0)

    return out


def crossing(settings: Settings, away: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the alpha (n,) of plants as single and as crossed quads, ``away`` (n,) units away.

    One fades in before the other fades out, so that a walker does not see the change.
    """
    far = settings.plants.crossed_within
    if far < LEAST:
        return np.zeros_like(away), np.ones_like(away)
    start, both, end = (far * fraction for fraction in CROSSFADE)
    return smoothstep(start, both, away), 1.0 - smoothstep(both, end, away)


def has_top(settings: Settings, cells: np.ndarray) -> np.ndarray:
    """Return which sprites (n,) have a picture from above, by their atlas cells."""
    plants = settings.plants.rosette
    trees = settings.trees.crown
    deer = backs_fit(settings)
    return np.asarray(np.select([cells >= PLANT, cells >= DEER], [plants, deer], trees))


def backs_fit(settings: Settings) -> bool:
    """Return whether deer have pictures from above: only a large atlas has room for them."""
    return settings.deer.back and (settings.deer.variety or settings.plants.species > 1)
