"""The voxel island's named views. Poses are chosen."""

from dataclasses import replace

from landscape.frame import Pose
from landscape.scene import View

ELEMENTS = ("land", "sky", "water", "highlight", "crosshair", "sword", "map")
HELD = ("highlight", "crosshair", "sword", "map")  # only a walker has them: no view shows them
STANDING = tuple(name for name in ELEMENTS if name not in HELD)

VIEWS = {
    view.name: replace(view, shown=STANDING)
    for view in (
        View("voxel_bay", "the sea dragon in the bay", Pose(14.8, 1.05, 31.8, 327.0, 3.0), 20.0),
        View("voxel_castle", "the castle on its hill", Pose(23.2, 3.7, 20.6, 50.0, 3.0), 20.0),
        View("voxel_cliff", "the mountain and its beacon", Pose(16.0, 3.4, 15.0, 330.0, 2.0), 20.0),
        View("voxel_water", "through clear water one sees the ground, in it the shore",
             Pose(8.0, 1.0, 30.0, 20.0, -14.0), 20.0),
        View("voxel_forest", "in the forest below the castle",
             Pose(18.0, 1.62, 18.0, 88.0, 4.0), 20.0),
        View("voxel_regions", "the regions' boxes, culled ones red; the frustum from outside",
             Pose(21.0, 4.5, 29.0, 10.0, -16.0), 20.0, settings={"debug.regions": True}),
    )
}  # fmt: skip
MAIN = tuple(VIEWS)
