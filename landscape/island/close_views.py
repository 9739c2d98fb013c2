"""Named views from an arm's length of what they show, at eye height."""

from landscape.frame import Pose
from landscape.scene.scene import View

CLOSE_VIEWS = (
    View(
        "close_shore",
        "waves run up the sand before one's feet",
        Pose(14.0, 0.9, 30.0, 165.0, -22.0),
        80.0,
        settings={"camera.lens": 0.0015, "camera.focus": 0.3},
    ),
    View(
        "close_water",
        "the sea two metres away, and the dragon beyond",
        Pose(9.0, 0.72, 32.0, 28.0, -12.0),
        40.0,
    ),
    View(
        "close_grass",
        "the meadow, seen from the height of a knee",
        Pose(21.5, 1.12, 24.5, 120.0, -6.0),
        40.0,
        settings={"camera.lens": 0.0015, "camera.focus": 0.13, "camera.lens_points": 96},
    ),
    View(
        "close_oak",
        "an oak from beneath",
        Pose(20.0, None, 25.35, 0.0, 55.0),
        40.0,
    ),
    View(
        "close_boulder",
        "a boulder in the meadow, a step away",
        Pose(23.0, None, 24.0, 0.0, -27.0),
        40.0,
        settings={"camera.lens": 0.002, "camera.focus": 0.2},
    ),
    View(
        "close_wall",
        "a tower of the castle, a step away",
        Pose(27.95, None, 17.5, 20.0, -4.0),
        40.0,
        settings={"camera.lens": 0.003, "camera.focus": 0.18},
    ),
    View(
        "close_ivy",
        "ivy on the castle's tower, a step away",
        Pose(27.2, None, 17.72, 320.0, 14.0),
        40.0,
        settings={"camera.lens": 0.004, "camera.focus": 0.13},
    ),
    View(
        "close_gate",
        "through the gate, into the hall",
        Pose(27.64, 2.45, 17.7, 340.0, 0.0),
        40.0,
    ),
    View(
        "close_deer",
        "a stag in the meadow",
        Pose(22.25, 1.2, 25.05, 345.0, -8.0),
        40.0,
        settings={"camera.lens": 0.001, "camera.focus": 0.42},
    ),
    View(
        "close_rabbit",
        "the rabbit among blades of grass",
        Pose(20.6, 1.12, 23.9, 218.0, -14.0),
        40.0,
        settings={"camera.lens": 0.0015, "camera.focus": 0.24},
    ),
    View(
        "close_dragon",
        "the dragon's body where it leaves the water",
        Pose(11.3, 0.75, 29.6, 330.0, 5.0),
        40.0,
    ),
    View(
        "close_peak",
        "the peak from its foot, with ledges and gullies",
        Pose(16.0, None, 9.0, 250.0, 10.0),
        20.0,
        settings={"ground.ledges": 0.7, "camera.lens": 0.003, "camera.focus": 0.4},
    ),
)
