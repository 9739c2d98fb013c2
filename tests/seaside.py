"""What the tests of the sea share: a beach, a grid around the eye, a mirrored wall, sent data."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from stage import SIZE, WHITE_LIGHT, Stage, quad, small

from framelens.gl.seam import Call, gl, recording
from landscape.elements.best.sea.eye_grid import EyeGrid, eye_grid
from landscape.elements.best.sea.sea import Sea, reflected
from landscape.elements.reflection import mirrored
from landscape.files.assets import Assets
from landscape.frame import Frame, Pose
from landscape.geometry.height_field import HeightField

LEVEL = 0.6
POSE = Pose(20.0, 1.1, 24.0, 0.0, -12.0)
BACKGROUND = np.array([0.4, 0.6, 0.7]) * 255
CALM = {"water.animated": False, "water.textured": False}


def beach(slope: float = 0.1, edge: float = 20.0) -> HeightField:
    """A shore that runs along x: land north of z = ``edge``, deeper and deeper south of it."""
    z = np.arange(81) * 0.5
    rows = LEVEL + slope * (edge - z)
    return HeightField(np.repeat(rows[:, None], 81, axis=1).astype(np.float32), 40.0, LEVEL)


def frame_at(pose: Pose = POSE, fov: float = 60.0) -> Frame:
    """A frame made without OpenGL."""
    return Frame(pose, SIZE, 0.0, np.eye(4).ravel(), fov)


def grid_at(pose: Pose = POSE) -> EyeGrid:
    """The grid around an eye that sees water."""
    grid = eye_grid(frame_at(pose), LEVEL, 60.0)
    assert grid is not None
    return grid


def drawn(
    stage: Stage,
    assets: Assets,
    changes: Mapping[str, Any],
    pose: Pose = POSE,
    kt: float = 0.0,
    field: HeightField | None = None,
) -> tuple[np.ndarray, list[Call]]:
    """Return the picture of the sea over nothing, in white light, and the calls that drew it."""
    settings = small({**WHITE_LIGHT, **changes})
    sea = Sea(settings, assets, beach() if field is None else field)
    with stage.frame(settings, pose, kt) as frame:
        with recording() as recorder:
            sea.draw(frame)
        picture = stage.read()
    sea.release()
    return picture, recorder.calls


def mirrored_wall(
    stage: Stage, assets: Assets, changes: Mapping[str, Any], kt: float = 0.0
) -> np.ndarray:
    """Return a picture of the sea and a red wall's mirror image in it, without the wall itself."""
    common = {**WHITE_LIGHT, "water.textured": False, "water.color": (0.0, 0.0, 0.4, 0.2)}
    settings = small({**common, **changes})
    sea = Sea(settings, assets, beach(edge=-30.0))
    wall = np.array([(16, LEVEL, 18), (24, LEVEL, 18), (24, 1.4, 18), (16, 1.4, 18)], float)
    with stage.frame(settings, POSE, kt) as frame:
        with reflected(frame, settings, sea), mirrored(settings):
            gl.glColor4f(1.0, 0.0, 0.0, 1.0)
            quad(wall)
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)
        sea.draw(frame)
        picture = stage.read()
    sea.release()
    return picture


def red(picture: np.ndarray) -> np.ndarray:
    """Return which pixels of a picture show the wall."""
    return np.asarray(picture[..., 0] > 150)


def sent(calls: list[Call], name: str) -> list[Any]:
    """Return the last argument of each call of a name."""
    return [call.args[-1] for call in calls if call.name == name]
