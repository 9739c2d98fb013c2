"""The hall's named views. Poses are chosen."""

from dataclasses import replace

from landscape.frame import Pose
from landscape.scene import View

ELEMENTS = (
    *("room", "floor", "mirror", "door", "statue", "shadow", "sky", "caustics", "pool", "mist"),
    *("tone", "flight", "sword"),
)
HELD = ("sword",)  # only a walker has it: no view shows it
STANDING = tuple(name for name in ELEMENTS if name not in HELD)

VIEWS = {
    view.name: replace(view, shown=STANDING)
    for view in (
        View("hall", "the great hall from its door", Pose(1.6, None, 2.62, 0.0, 4.0), 20.0),
        View("hall_sphere", "the gilded statue mirrors the hall",
             Pose(1.80, 0.20, 1.50, 325.0, 4.0), 20.0),
        View("hall_mist", "mist over the floor, and clouds beyond the windows",
             Pose(1.40, 0.17, 2.30, 28.0, 2.0), 20.0, settings={"mist.enabled": True}),
        View("hall_mirror", "the statue and its image in the polished floor",
             Pose(1.60, 0.13, 2.0, 3.0, -6.0), 20.0),
        View("hall_shadow", "the torch throws the dragon's shadow on the north wall",
             Pose(1.80, 0.1, 1.02, 322.0, 13.0), 20.0),
        View("hall_contrast", "the statue in full contrast, all else dimmed",
             Pose(1.78, None, 1.62, 337.0, 6.0), 20.0,
             settings={"tone.area": "surroundings", "tone.contrast": 0.5}),
        View("hall_caustics", "light in the pool, and thrown on the stone around it",
             Pose(1.72, 0.13, 2.44, 336.0, -19.0), 20.0),
    )
}  # fmt: skip
MAIN = tuple(VIEWS)
