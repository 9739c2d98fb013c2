"""What the digit keys change in the hall: one effect each, so that one sees what it does.

A key stands for a setting that is on or off, or has choices, or takes the values given here in
turn; its name is shown in the help and when it changes.
"""

import math

from landscape.hall import plan
from landscape.hall.settings import Settings
from landscape.settings.declare import Toggle, Value

KEYS: dict[str, Toggle] = {
    "1": Toggle("mirror.enabled", "mirror image in the floor"),
    "2": Toggle("shadow.enabled", "the statue's shadows"),
    "3": Toggle("caustics.enabled", "light that the pool's water focuses"),
    "4": Toggle("statue.environment", "what the statue mirrors"),
    "5": Toggle("mist.enabled", "mist over the floor"),
    "6": Toggle("sky.layers", "layers of cloud in the sky", (0, 1, 2)),
    "7": Toggle("tone.contrast", "contrast", (1.0, 1.6, 0.5)),
    "8": Toggle("tone.area", "where the contrast changes"),
    "9": Toggle("flight.enabled", "flight around the statue"),
}

# Chosen: what a drag of 100 pixels does to the light that it carries: degrees around the statue,
# and units up; the lamp's distance from the statue's middle, its lowest and its highest place.
TURN, LIFT = 40.0, 0.12
AWAY = 0.48
LOW = 0.16
HIGH = 0.56


def carried(settings: Settings, right: float, down: float) -> dict[str, Value]:
    """Return the settings after a drag carried the torch's light, by pixels right and down.

    It goes around the statue, up and down. Its shadows then are those that darken, as the light map
    knows only the torch's own place, and all that stands casts one.
    """
    x, y, z = settings.shadow.flame
    east, south = plan.STATUE
    angle = math.atan2(z - south, x - east) - math.radians(TURN * right / 100.0)
    height = min(max(y - LIFT * down / 100.0, LOW), HIGH)
    flame = east + AWAY * math.cos(angle), height, south + AWAY * math.sin(angle)
    return {
        "shadow.flame": flame,
        "shadow.method": "darken",
        "shadow.casters": "all",
        "shadow.shine": 1.0,
    }
