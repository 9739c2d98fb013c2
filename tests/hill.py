"""A round green hill in the sea, for tests of where sprites grow."""

from types import SimpleNamespace
from typing import Any, cast

import numpy as np

from landscape.elements.best.sprites.refined_planting import TintedSprites, plant_refined
from landscape.elements.ground import Ground
from landscape.elements.planting import plant
from landscape.elements.settings import Settings
from landscape.geometry.height_field import HeightField
from landscape.settings.declare import with_settings

ALL = {"trees", "deer", "plants"}


def hill(level: float = 1.0) -> HeightField:
    """A round hill of 4 units in a sea of the given level."""
    at = np.linspace(-1.0, 1.0, 61)
    heights = 4.0 * np.exp(-3 * (at[None, :] ** 2 + at[:, None] ** 2))
    return HeightField(heights.astype(np.float32), 40.0, level)


def green_in_the_west(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """A ground of grass where x is under 20, of sand elsewhere."""
    grass, sand = np.array([0.2, 0.4, 0.1]), np.array([0.7, 0.6, 0.5])
    return np.where((x < 20.0)[:, None], grass, sand)


def hill_settings(field: HeightField, changes: dict[str, Any]) -> Settings:
    """Return settings for a field; keys are written with two underscores for the dot."""
    keys = {key.replace("__", "."): value for key, value in changes.items()}
    return with_settings(Settings(), {"water.level": field.water_level, **keys})


def grow(kinds: set[str] = ALL, seed: int = 5, field: HeightField | None = None, **changes: Any):
    """Plant a hill as in 2006; castle and rabbit stand where the settings put them."""
    field = field or hill()
    settings = hill_settings(field, changes)
    return settings, plant(settings, field, seed, kinds)


def refine(kinds: set[str] = ALL, seed: int = 5, **changes: Any) -> TintedSprites:
    """Plant a hill with refined sprites, its ground green in the west."""
    settings = hill_settings(hill(), changes)
    ground = cast(Ground, SimpleNamespace(field=hill(), colour=green_in_the_west))
    return plant_refined(settings, ground, seed, kinds)
