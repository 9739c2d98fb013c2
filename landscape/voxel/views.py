"""The voxel island's named views. Poses are chosen."""

from dataclasses import replace

from landscape.frame import Pose
from landscape.scene.scene import View

ELEMENTS = ("land", "sky", "water", "highlight", "crosshair", "sword", "map")
HELD = ("highlight", "crosshair", "sword", "map")  # only a walker has them: no view shows them
STANDING = tuple(name for name in ELEMENTS if name not in HELD)

VIEWS = {
    view.name: replace(view, shown=STANDING)
    for view in (
        View("voxel_bay", "the sea dragon in the bay", Pose(13.8, 1.2, 31.4, 345.0, 3.0), 20.0),
        View("voxel_castle", "the castle on its hill", Pose(26.9, 3.7, 20.6, 327.5, 5.0), 20.0),
        View("voxel_cliff", "the mountain and its beacon", Pose(9.0, 3.6, 16.5, 15.0, 5.0), 20.0),
        View(
            "voxel_water",
            "through clear water one sees the ground, in it the shore",
            Pose(16.7, 1.25, 32.9, 146.0, -15.0),
            20.0,
        ),
        View(
            "voxel_forest",
            "a glade in the forest below the mountain",
            Pose(18.95, 1.7, 24.6, 3.0, 3.0),
            20.0,
        ),
        View(
            "voxel_regions",
            "the regions' boxes, culled ones red; the frustum from outside",
            Pose(13.8, 3.0, 34.0, 15.0, -7.0),
            20.0,
            settings={"debug.regions": True, "voxel.distance": 13.0},
        ),
    )
}
MAIN = tuple(VIEWS)
