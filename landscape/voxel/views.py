"""The voxel island's named views. Poses are chosen."""

from dataclasses import replace

from landscape.frame import Pose
from landscape.scene import View

ELEMENTS = ("land", "sky", "water", "sword", "map")
HELD = ("sword", "map")  # only a walker has them: no view shows them
STANDING = tuple(name for name in ELEMENTS if name not in HELD)

VIEWS = {
    view.name: replace(view, shown=STANDING)
    for view in (
        View("voxel_bay", "the bay from its beach", Pose(8.2, 1.05, 29.5, 20.0, -4.0), 20.0),
        View("voxel_cliff", "the mountain's cliffs", Pose(16.0, 3.4, 15.0, 330.0, 2.0), 20.0),
        View("voxel_forest", "in the forest", Pose(20.0, None, 20.0, 40.0, 4.0), 20.0),
    )
}  # fmt: skip
MAIN = tuple(VIEWS)
