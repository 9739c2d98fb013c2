"""What tests of the castles share: a flat hill, the castle's own frame, a picture of it alone."""

from typing import Any

import numpy as np
from stage import PLAIN, WHITE_LIGHT, Stage, kind_in, small

from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.height_field import HeightField
from landscape.island.slots import CASTLE

FLAT = HeightField(np.full((4, 4), 2.0, np.float32), 40.0, 0.6)
PLACED: dict[str, Any] = {"castle.x": 20.0, "castle.z": 20.0, "castle.yaw": 0.0}
GATE = Pose(20.0, 2.4, 17.9, 180.0, 0.0)
"""North of the gate, looking at it."""
BRICK, DOOR = np.array(PLAIN["castle_brick.png"]), np.array(PLAIN["castle_door.png"][:3])


def at(x: float, y: float, z: float = 0.0) -> tuple[float, float, float]:
    """Return the island coordinates of a point in the castle's own frame."""
    return 19.5 + x, 2.0 + y, 19.5 + z


def drawn(
    stage: Stage, assets: Assets, pose: Pose = GATE, kt: float = 0.0, **changes: Any
) -> np.ndarray:
    """Return a picture of the castle alone, whose gate wall at z = 19.5 faces north.

    Settings are named with ``__`` for the dot. The state must be left as found, and release may be
    called twice.
    """
    keys = {key.replace("__", "."): value for key, value in changes.items()}
    settings = small({**WHITE_LIGHT, **PLACED, **keys})
    castle = kind_in(CASTLE, settings)(settings, assets, FLAT)
    with stage.frame(settings, pose, kt, fog="fog__density" in changes) as frame:
        castle.draw(frame)
        picture = stage.read()
    castle.release()
    castle.release()
    return picture
