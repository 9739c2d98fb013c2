"""Colours by height, for an island without pictures: large-scale texture (figure 3) and map."""

import numpy as np

from landscape.geometry.height_field import HeightField

DEPTHS = np.array([(150, 186, 186), (112, 156, 170), (84, 126, 150)])  # chosen: shallow to deep


def colour_by_height(field: HeightField, sun: np.ndarray, size: int = 512) -> np.ndarray:
    """Return a large-scale texture, uint8 (size, size, 3).

    Sand at the shore, green low, brown and grey high, shaded by the sun. ``sun`` (3,) is the unit
    vector towards it.
    """
    at = (np.arange(size) + 0.5) / size * field.size
    x, z = np.meshgrid(at, at)
    h = field.terrain_height(x, z)
    above = np.clip((h - field.water_level) / max(float(h.max()) - field.water_level, 1e-6), 0, 1)

    stops = [0.0, 0.03, 0.10, 0.40, 0.65, 1.0]
    colours = np.array(
        [
            (196, 180, 140),
            (186, 172, 128),
            (104, 122, 62),
            (116, 112, 68),
            (124, 110, 92),
            (150, 148, 144),
        ]
    )
    rgb = np.stack([np.interp(above, stops, colours[:, c]) for c in range(3)], axis=2)

    step = field.size / size
    gz, gx = np.gradient(h, step)
    light = (sun[1] - gx * sun[0] - gz * sun[2]) / np.sqrt(1 + gx**2 + gz**2)
    shade = 0.55 + 0.6 * np.clip(light, 0, 1)
    return np.ascontiguousarray(np.clip(rgb * shade[..., None], 0, 255), np.uint8)


def chart(field: HeightField, sun: np.ndarray, size: int = 256) -> np.ndarray:
    """Return a map of the island, uint8 (size, size, 3): land by height, sea by depth.

    ``sun`` (3,) is the unit vector towards it.
    """
    at = (np.arange(size) + 0.5) / size * field.size
    depth = field.depth(*np.meshgrid(at, at))
    deepest = max(float(depth.max()), 1e-6)
    sea = [np.interp(depth / deepest, [0.0, 0.3, 1.0], DEPTHS[:, c]) for c in range(3)]
    water = (depth > 0.0)[..., None]
    return np.where(water, np.stack(sea, axis=2), colour_by_height(field, sun, size)).astype(
        np.uint8
    )
