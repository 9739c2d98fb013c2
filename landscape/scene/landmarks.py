"""The landmarks of the scenes: what a walker may find, and the lesson that tells how it is made.

They are the nine views of figure 35, the dragon, the rabbit, the castle's gate, the hall's exhibits
and the far shore. No scene is imported for them.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Landmark:
    """A landmark: the name of a view, or of what stands there; its scene and its lesson.

    ``near`` is how near a walker has to come, in units.
    """

    name: str
    scene: str
    lesson: str
    near: float


def _outdoors(name: str, lesson: str) -> Landmark:
    return Landmark(name, "island", lesson, near=1.2)


def _exhibit(name: str, lesson: str) -> Landmark:
    return Landmark(f"hall_exhibit_{name}", "hall", lesson, near=0.35)


FAR_SHORE = _outdoors("far_shore", "water")  # it is reached by crossing the water
LANDMARKS = (
    _outdoors("fig35a", "mirror"),
    _outdoors("fig35b", "grass"),
    _outdoors("fig35c", "crossed_quads"),
    _outdoors("fig35d", "billboard"),
    _outdoors("fig35e", "fog"),
    _outdoors("fig35f", "sprite_sheet"),
    _outdoors("fig35g", "sky_box"),
    _outdoors("fig35h", "clip_plane"),
    _outdoors("fig35i", "overlay"),
    _outdoors("dragon", "display_list"),
    _outdoors("rabbit", "ply_mesh"),
    _outdoors("gate", "light_map"),
    FAR_SHORE,
    _exhibit("volume", "shadow_volume"),
    _exhibit("soft", "accumulation"),
    _exhibit("blur", "accumulation"),
    _exhibit("focus", "accumulation"),
    _exhibit("lines", "polygon_modes"),
    _exhibit("solids", "stencil_mirror"),
)
NAMES = tuple(each.name for each in LANDMARKS)
