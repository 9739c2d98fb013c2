"""The view under water: the bed as far as the water lets it be seen, and the surface from beneath.

Technique: the water is linear fog, whose end bounds what is seen, so that no land beyond is sent.
The surface is the same plane as from above, with the same two pictures (water_images.py) in other
parts: it mirrors the bed, and through it one sees the land above and the sky, raised by the ratio
of the refractive indices, as they look straight overhead. From this side Fresnel's term has an
edge: all that comes in at less than the critical angle is mirrored, so that the sky is a round
window (Snell's window).
What is wrong: the window shows the land as a plane would refract it near its middle; towards its
edge all that is above the horizon should be squeezed in. Switch: ``water.below`` (off, an eye under
water sees the surface as from above).
State used: that of the fog, the clip plane and the water.
"""

from landscape.elements.settings import Fog
from landscape.voxel.settings import Settings

LIGHTER = 0.3  # chosen: how far lit water has the colour of the sea at the horizon


def murk(values: Settings) -> Fog:
    """Return the fog of the water, as seen from within: its end is the bound of sight."""
    pairs = zip(values.water.color, values.water.horizon, strict=True)
    colour = tuple(deep + LIGHTER * (bright - deep) for deep, bright in pairs)
    return Fog(
        enabled=True,
        mode="linear",
        color=colour,
        radial=values.fog.radial,
        start=0.0,
        end=sight(values),
    )


def sight(values: Settings) -> float:
    """Return how far one sees under water, in units."""
    return values.water.sight * values.voxel.block
