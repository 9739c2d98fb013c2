"""What the preset `best` adds to the ground."""

from landscape.elements.settings import Settings


def wanted(settings: Settings) -> bool:
    """Return whether the settings ask for more than the ground of 2006."""
    ground = settings.ground
    return ground.materials or ground.tiles > 1 or ground.low_stretch or ground.shadows
