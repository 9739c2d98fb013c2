"""The sky's fixes: R1 clouds that move, R8 not nearer, R9 hides no terrain, R10 equal haze."""

import numpy as np
import pytest
from stage import Stage, small

from landscape.elements.sky_box import SkyBox, cloud_disc
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.gl.calls import gl

BACK = {"sky.follow_y": True, "sky.background": True, "sky.unfogged": True}


def sky(stage: Stage, pose: Pose, kt: float = 0.0, fog: bool = False, **changes) -> np.ndarray:
    values = small({f"sky.{key}": value for key, value in changes.items()})
    box = SkyBox(values, Assets())
    with stage.frame(values, pose, kt=kt, fog=fog) as frame:
        box.draw(frame)
        picture = stage.read()
    box.release()
    return picture.astype(int)


def test_r1_clouds_move_with_kt_and_only_where_asked(stage: Stage) -> None:
    up = Pose(20.0, 1.0, 20.0, 40.0, 40.0)
    still = [sky(stage, up, kt) for kt in (0, 900)]
    assert (still[0] == still[1]).all()
    moved = [sky(stage, up, kt, moving=True) for kt in (0, 900)]
    assert (np.abs(moved[0] - moved[1]).max(axis=2) > 8).mean() > 0.05


def test_r1_the_cloud_layer_ends_in_nothing_and_faces_down() -> None:
    vertices, colors, _, triangles = cloud_disc()
    rim = np.hypot(vertices[:, 0], vertices[:, 2]) > 5.9
    assert rim.any() and (colors[rim, 3] == 0).all() and (colors[~rim, 3] > 0).all()
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    area = np.cross(b - a, c - a)[:, 1]
    assert (area <= 1e-6).all() and (area < 0).any()


def test_r8_the_clouds_stay_as_far_however_high_one_climbs(stage: Stage) -> None:
    low, high = (Pose(20.0, y, 20.0, 40.0, 30.0) for y in (0.7, 4.5))
    assert np.abs(sky(stage, low) - sky(stage, high)).max() > 30
    assert (sky(stage, low, follow_y=True) == sky(stage, high, follow_y=True)).all()


@pytest.mark.parametrize("background", [False, True])
def test_r9_no_pixel_of_sky_stands_before_what_is_drawn(stage: Stage, background: bool) -> None:
    values = small({**BACK, "sky.background": background})
    box = SkyBox(values, Assets())
    pose = Pose(20.0, 1.0, 20.0, 0.0, 0.0)
    with stage.frame(values, pose) as frame:
        # A red hill 12 units off, beyond the box's wall at 8.
        gl.glColor3f(1.0, 0.0, 0.0)
        gl.glBegin(gl.GL_QUADS)
        for x, y in ((-3, 1), (3, 1), (3, 4), (-3, 4)):
            gl.glVertex3f(20.0 + x, float(y), 8.0)
        gl.glEnd()
        hill = (stage.read() == (255, 0, 0)).all(axis=2)
        gl.glColor3f(1.0, 1.0, 1.0)
        box.draw(frame)
        left = (stage.read() == (255, 0, 0)).all(axis=2)
    box.release()
    assert hill.sum() > 500
    assert left.sum() == (hill.sum() if background else 0)


@pytest.mark.parametrize("unfogged", [False, True])
def test_r10_corner_and_middle_of_a_wall_are_equally_hazed(
    stage: Stage, unfogged: bool, tmp_path
) -> None:
    from PIL import Image

    for face in ("north", "east", "south", "west", "top"):
        Image.new("RGB", (8, 8), (200, 120, 40)).save(tmp_path / f"sky_{face}.png")
    values = small({"sky.unfogged": unfogged})
    box = SkyBox(values, Assets(tmp_path))
    seen = []
    for yaw in (0.0, 45.0):
        with stage.frame(values, Pose(20.0, 1.2, 20.0, yaw, 8.0), fog=True) as frame:
            box.draw(frame)
            seen.append(stage.read()[60, 80].astype(int))
    box.release()
    apart = np.abs(seen[0] - seen[1]).max()
    assert apart <= 2 if unfogged else apart > 20
