"""Named views from an arm's length of what they show, at eye height."""

from landscape.frame import Pose
from landscape.scene.scene import View

CLOSE_VIEWS = (
    View(
        "close_peak",
        "the peak from its foot, with ledges and gullies",
        Pose(16.0, None, 9.0, 250.0, 10.0),
        20.0,
        settings={"ground.ledges": 0.7},
    ),
    View(
        "close_boulder",
        "boulders among rock, a step away",
        Pose(29.6, None, 20.8, 330.0, -20.0),
        20.0,
        settings={"ground.ledges": 0.7},
    ),
)
