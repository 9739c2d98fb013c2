"""A flat ground without OpenGL, for tests of grass: green in the west, in shadow in the south."""

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
from stage import small

from landscape.elements.ground import Ground
from landscape.elements.settings import Settings
from landscape.geometry.height_field import HeightField


def flat(height: float = 3.0, size: float = 40.0) -> Ground:
    """A ground of one height and one green, ``size`` units wide, without OpenGL."""
    field = HeightField(np.full((5, 5), height, np.float32), size, 0.6)

    def colour(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        green = np.where(np.asarray(x) < 20, 0.5, 0.2)  # green in the west, grey in the east
        return np.stack([np.full_like(green, 0.2), green, np.full_like(green, 0.2)], axis=1)

    def light(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        part = np.where(np.asarray(z) < 20, 1.0, 0.5)  # shadow in the south
        return np.repeat(part[:, None], 3, axis=1)

    return cast(
        Ground, SimpleNamespace(field=field, colour=colour, drawn_colour=colour, light=light)
    )


def grass_settings(**changes: Any) -> Settings:
    """Return settings for grass on it, with some of the group ``grass`` changed."""
    keys = {f"grass.{key}": value for key, value in changes.items()}
    return small({"grass.count": 50_000, "castle.x": -900, **keys})
