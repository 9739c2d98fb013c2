"""What the preset `best` adds to bare ground: crags, boulders, stones and driftwood."""

from landscape.elements.settings import Settings

FILE = "stones.ply"


def wanted(settings: Settings) -> bool:
    """Return whether there are stones; they have the texture of the ground's rock."""
    ground = settings.ground
    return ground.stones > 0 and ground.materials and ground.units == "both"
