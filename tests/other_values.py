"""For each setting another value than it has, and an island small enough to try them all."""

from typing import Any

from landscape.settings.declare import Setting

FEW: dict[str, Any] = {
    "grass.count": 20_000,
    "trees.count": 60,
    "plants.count": 60,
    "deer.count": 10,
    "ground.resolution": 40,
    "ground.texture_size": 64,
    "ground.tiles": 2,
    "grass.radius": 3.0,
}
FILES = {
    "transparent.places": "avenue.csv",
    "sky.unfolded": "sky_unfolded.jpg",
    "ground.height_image": "height16.png",
    "ground.large_texture": "ground_sand.png",
    "ground.detail_texture": "ground_rock.png",
    "ground.sand_texture": "ground_rock.png",
    "ground.rock_texture": "ground_sand.png",
    "rabbit.mesh": "dragon.ply",
    "dragon.mesh": "rabbit.ply",
}


def another(key: str, item: Setting, value: Any) -> Any:
    """Return a value for a key other than ``value``, within its limits."""
    low, high = item.low, item.high
    if isinstance(value, bool):
        return not value
    if item.choices:
        return next(choice for choice in item.choices if choice != value)
    if isinstance(value, str):
        return FILES[key] if FILES[key] != value else "height.png"
    if isinstance(value, tuple):
        return tuple(part * 0.8 if part * 0.8 >= low else part + 0.1 for part in value)
    if isinstance(value, int):
        return value + 1 if value + 1 <= high else value - 1
    changed = value * 0.8 if value else 0.3
    return changed if low <= changed <= high else min(max(value + 0.1, low), high)
