"""Named views from an arm's length of what they show, at eye height."""

from landscape.frame import Pose
from landscape.scene.scene import View

CLOSE_VIEWS = (
    View(
        "close_shore",
        "wet sand and stones at the water's edge",
        Pose(14.6, 0.72, 28.9, 215.0, -12.0),
        81.0,
        settings={
            "camera.fov": 26.0,
            "camera.lens": 0.004,
            "camera.focus": 0.42,
            "camera.lens_points": 96,
        },
    ),
    View(
        "close_water",
        "the sea, a few steps away",
        Pose(12.5, 0.75, 30.5, 20.0, -6.0),
        40.0,
        settings={
            "camera.fov": 24.0,
            "camera.lens": 0.003,
            "camera.focus": 0.8,
        },
    ),
    View(
        "close_grass",
        "the meadow, seen from the height of a knee",
        Pose(21.5, 1.12, 24.5, 105.0, -3.0),
        40.0,
        settings={
            "camera.fov": 20.0,
            "camera.lens": 0.005,
            "camera.focus": 0.22,
            "camera.lens_points": 192,
        },
    ),
    View(
        "close_oak",
        "an oak from beneath",
        Pose(20.0, None, 25.35, 8.0, 44.0),
        40.0,
        settings={
            "camera.fov": 28.0,
            "camera.lens": 0.0025,
            "camera.focus": 0.25,
        },
    ),
    View(
        "close_boulder",
        "a boulder in the meadow, a step away",
        Pose(23.0, 1.17, 24.3, 3.0, -6.5),
        40.0,
        settings={
            "camera.fov": 20.0,
            "camera.lens": 0.005,
            "camera.focus": 0.5,
            "camera.lens_points": 192,
        },
    ),
    View(
        "close_wall",
        "a tower of the castle, a step away",
        Pose(28.3, None, 17.8, 345.0, 1.0),
        40.0,
        settings={
            "camera.fov": 22.0,
            "camera.lens": 0.006,
            "camera.focus": 0.5,
        },
    ),
    View(
        "close_ivy",
        "ivy on the castle's tower, a step away",
        Pose(27.2, None, 17.72, 310.0, 16.0),
        40.0,
        settings={
            "camera.fov": 28.0,
            "camera.lens": 0.003,
            "camera.focus": 0.13,
        },
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
        Pose(22.92, 1.22, 25.3, 307.5, -4.0),
        40.0,
        settings={
            "camera.fov": 13.0,
            "camera.lens": 0.007,
            "camera.focus": 0.86,
            "camera.lens_points": 160,
        },
    ),
    View(
        "close_rabbit",
        "the rabbit among blades of grass",
        Pose(20.2, 1.11, 24.25, 50.0, -6.0),
        40.0,
        settings={
            "camera.fov": 17.0,
            "camera.lens": 0.005,
            "camera.focus": 0.36,
            "camera.lens_points": 160,
        },
    ),
    View(
        "close_dragon",
        "the dragon's body where it leaves the water",
        Pose(11.3, 0.8, 29.6, 329.0, 0.0),
        40.0,
        settings={
            "camera.fov": 42.0,
            "camera.lens": 0.003,
            "camera.focus": 0.35,
        },
    ),
    View(
        "close_peak",
        "the peak from its foot, with ledges and gullies",
        Pose(16.0, None, 9.0, 252.0, 14.0),
        20.0,
        settings={
            "ground.ledges": 0.7,
            "camera.fov": 26.0,
            "camera.lens": 0.004,
            "camera.focus": 0.8,
        },
    ),
)
