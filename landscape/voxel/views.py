"""The voxel island's named views. Poses are chosen."""

from dataclasses import replace

from landscape.frame import Pose
from landscape.scene.scene import View

ELEMENTS = ("land", "sky", "water", "highlight", "crosshair", "sword", "map")
HELD = ("highlight", "crosshair", "sword", "map")  # only a walker has them: no view shows them
STANDING = tuple(name for name in ELEMENTS if name not in HELD)

IN_BAY = Pose(13.8, 1.2, 31.4, 345.0, 3.0)
AT_CASTLE = Pose(26.9, 3.7, 20.6, 327.5, 5.0)
OVER_SHORE = Pose(16.7, 1.25, 32.9, 146.0, -15.0)
IN_GLADE = Pose(18.95, 1.7, 24.6, 3.0, 3.0)

# Each shows what settings do that no other view changes.
VARIANTS = (
    View(
        "voxel_large",
        "the island in blocks of twice the size",
        IN_BAY,
        20.0,
        settings={
            "voxel.block": 0.16,
            "voxel.regions": 5,
            "voxel.region_size": 50,
            "voxel.levels": 48,
            "voxel.sea": 5,
        },
    ),
    View(
        "voxel_smooth",
        "smoothed tiles, and leaves without holes",
        IN_GLADE,
        20.0,
        settings={"voxel.crisp": False, "voxel.holes": False},
    ),
    View(
        "voxel_haze",
        "haze that thickens evenly with the depth",
        AT_CASTLE,
        20.0,
        settings={
            "fog.mode": "linear",
            "fog.start": 1.0,
            "fog.end": 9.0,
            "fog.radial": False,
        },
    ),
    View(
        "voxel_texels",
        "shadows in coarse texels, fine ones near the eye alone",
        IN_GLADE,
        20.0,
        settings={"shadow.size": 256, "shadow.distance": 7.0},
    ),
    View(
        "voxel_pond",
        "water that mirrors more, by small pictures of a simpler land",
        OVER_SHORE,
        20.0,
        settings={"water.fresnel": 2.5, "water.resolution": 0.15, "water.far": 0.0},
    ),
    View(
        "voxel_murk",
        "under water the view ends after a few steps",
        Pose(13.0, 0.6, 34.0, 345.0, 0.0),
        20.0,
        settings={"water.sight": 20.0},
    ),
    View(
        "voxel_depths",
        "the depths of the picture, as a texture of its own",
        IN_BAY,
        20.0,
        settings={"debug.picture": "depth"},
    ),
)

PLACES = (
    View("voxel_bay", "the sea dragon in the bay", IN_BAY, 20.0),
    View("voxel_castle", "the castle on its hill", AT_CASTLE, 20.0),
    View("voxel_cliff", "the mountain and its beacon", Pose(9.0, 3.6, 16.5, 15.0, 5.0), 20.0),
    View(
        "voxel_water",
        "clear water shows the ground below and mirrors the shore",
        OVER_SHORE,
        20.0,
    ),
    View(
        "voxel_forest",
        "a glade in the forest below the mountain",
        IN_GLADE,
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
# Views of one setting or a few in another way are not measured.
MAIN = tuple(view.name for view in PLACES)
VIEWS = {view.name: replace(view, shown=STANDING) for view in (*PLACES, *VARIANTS)}
