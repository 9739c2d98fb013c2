"""Named views of what some settings do that no other view changes. Poses and values are chosen."""

from landscape.frame import Pose
from landscape.scene.scene import View

SETTING_VIEWS = (
    View(
        "light_off",
        "the dragon in its plain colour, without OpenGL's lighting",
        Pose(12.0, 1.1, 30.5, 330.0, -4.0),
        40.0,
        preset="2006",
        settings={"shading.lighting": False},
    ),
    View(
        "light_flat",
        "the rabbit with one light for each triangle",
        Pose(20.2, 1.4, 24.5, 40.0, -15.0),
        40.0,
        preset="2006",
        settings={"shading.smooth": False},
    ),
    View(
        "fog_even",
        "fog that thickens evenly with the distance",
        Pose(8.0, 1.05, 35.0, 18.0, -4.0),
        40.0,
        preset="2006",
        settings={"fog.mode": "linear", "fog.start": 2.0, "fog.end": 9.0},
    ),
    View(
        "mist_thick",
        "thick mist over the bay, in twelve sheets",
        Pose(8.0, 1.05, 35.0, 18.0, -4.0),
        40.0,
        settings={"mist.enabled": True, "mist.sheets": 12, "mist.density": 0.8},
    ),
)
