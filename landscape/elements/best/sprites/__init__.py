"""What the preset best adds to trees, deer and plants: see :class:`refined_sprites.RefinedSprites`.

The technique of 2006 is in ``elements/transparent_elements.py``.
"""

from landscape.elements.settings import Settings


def wanted(settings: Settings) -> bool:
    """Return whether the settings ask for more than the sprites of 2006 can show."""
    shared = settings.transparent
    trees = settings.trees
    plants = settings.plants
    return bool(
        (shared.sunward or shared.contact)
        or (shared.faces != "plane" or shared.follow_slope)
        or (shared.upright or shared.split or shared.fade or shared.clear_near or shared.rooted)
        or (shared.trimmed or shared.min_pixels or not shared.trilinear)
        or (trees.grouped or trees.crown or trees.variety or settings.ground.shadows)
        or (settings.deer.follow_slope or settings.deer.variety)
        or (plants.species > 1 or plants.radius or plants.shaded or plants.rosette)
        or (plants.quads > 2 or plants.fade_edge_on or plants.crossed_within)
    )
