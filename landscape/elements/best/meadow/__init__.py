"""What the preset best adds to the grass: see :class:`meadow.Meadow`.

The technique of 2006 is in ``elements/grass.py``.
"""

from landscape.elements.settings import Settings


def wanted(settings: Settings) -> bool:
    """Return whether the settings ask for more than the grass of 2006 can show."""
    grass = settings.grass
    return bool(
        grass.tinted
        or grass.fade
        or grass.facing
        or grass.tufts
        or grass.variety
        or grass.sward
        or grass.gusts
        or grass.arch != 1.0
    )
