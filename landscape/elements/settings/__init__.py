"""The island's constants as settings: key, value, what it does, unit, source.

Each group is in a file named after its element. The defaults are the preset ``2006``: the report's
numbers where it gives them, "chosen" where it does not. See :mod:`landscape.settings.declare`, and
:mod:`landscape.settings.notices` for ``needs`` and ``NEEDS``.
"""

from dataclasses import dataclass
from typing import ClassVar

from landscape.elements.settings.camera import Camera
from landscape.elements.settings.castle import Castle
from landscape.elements.settings.dragon import Dragon
from landscape.elements.settings.fog import Fog
from landscape.elements.settings.grass import Grass
from landscape.elements.settings.ground import Ground
from landscape.elements.settings.mist import Mist
from landscape.elements.settings.overlay import Overlay
from landscape.elements.settings.presets import BEST, PRESETS, TIMES
from landscape.elements.settings.rabbit import Rabbit
from landscape.elements.settings.reflection import Reflection
from landscape.elements.settings.sky_box import Sky
from landscape.elements.settings.sound import Sound
from landscape.elements.settings.sun import Shading, Sun
from landscape.elements.settings.transparent_elements import Deer, Plants, Transparent, Trees
from landscape.elements.settings.walk import Clock, Walk
from landscape.elements.settings.water_surface import Water
from landscape.settings import declare
from landscape.settings.declare import Renamed, word

__all__ = [
    "BEST",
    "PRESETS",
    "TIMES",
    "Camera",
    "Castle",
    "Clock",
    "Deer",
    "Dragon",
    "Fog",
    "Grass",
    "Ground",
    "Mist",
    "Overlay",
    "Plants",
    "Rabbit",
    "Reflection",
    "Settings",
    "Shading",
    "Sky",
    "Sound",
    "Sun",
    "Transparent",
    "Trees",
    "Walk",
    "Water",
    "preset",
]


@dataclass(frozen=True)
class Settings:
    """All groups, and the time of day; ``Settings()`` is the preset 2006 at noon."""

    RENAMED: ClassVar[dict[str, Renamed]] = {
        "camera.detail": Renamed("camera.lod_pixels"),
        "overlay.stroke_kt": Renamed("walk.stroke_kt"),
        "ground.unstretched": Renamed("ground.low_stretch"),
        "reflection.coarse": Renamed("reflection.lod_scale"),
        "transparent.least": Renamed("transparent.min_pixels"),
        "water.cull": Renamed(),
        "water.rippled": Renamed(),
        "water.sharp": Renamed("water.lod_bias", negated=True),
    }

    time: str = word("noon", TIMES, "chosen", "time of day: sun, sky, fog and torches at once")
    camera: Camera = Camera()
    clock: Clock = Clock()
    walk: Walk = Walk()
    sound: Sound = Sound()
    sun: Sun = Sun()
    shading: Shading = Shading()
    ground: Ground = Ground()
    reflection: Reflection = Reflection()
    water: Water = Water()
    sky: Sky = Sky()
    transparent: Transparent = Transparent()
    trees: Trees = Trees()
    deer: Deer = Deer()
    plants: Plants = Plants()
    grass: Grass = Grass()
    castle: Castle = Castle()
    rabbit: Rabbit = Rabbit()
    dragon: Dragon = Dragon()
    overlay: Overlay = Overlay()
    fog: Fog = Fog()
    mist: Mist = Mist()


def preset(name: str) -> Settings:
    """Return the island's settings of a preset; InputError if there is none of that name."""
    return declare.preset(Settings(), PRESETS, name)
