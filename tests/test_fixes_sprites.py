"""The castle's fixes of section 11.2: each test fails when its fix is taken out."""

import math
from typing import Any

import numpy as np
import pytest
from PIL import Image
from stage import PLAIN, WHITE_LIGHT, Stage, close, pixel, project, small, write_plain

from landscape.elements.castle import FLAME_Z, Castle, flame_across, halo
from landscape.elements.ornate.castle_meshes import TORCHES
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.height_field import HeightField

# The castle: R2 and R11

FLAT = HeightField(np.full((4, 4), 2.0, np.float32), 40.0, 0.6)
CASTLE = {**WHITE_LIGHT, "castle.x": 20.0, "castle.z": 20.0, "castle.yaw": 0.0}
GATE = Pose(20.0, 2.4, 17.9, 180.0, 0.0)
BRICK, DOOR = np.array(PLAIN["castle_brick.png"]), np.array(PLAIN["castle_door.png"][:3])


def castle(stage: Stage, assets: Assets, pose: Pose, **changes: Any) -> np.ndarray:
    """Draw the castle alone, its gate wall at z = 19.5 looking north; the state must stay."""
    keys = {key.replace("__", "."): value for key, value in changes.items()}
    settings = small({**CASTLE, **keys})
    element = Castle(settings, assets, FLAT)
    with stage.frame(settings, pose, fog="fog__density" in changes) as frame:
        element.draw(frame)
        picture = stage.read()
    element.release()
    element.release()
    return picture


def at(x: float, y: float, z: float = 0.0) -> tuple[float, float, float]:
    """Return a place of the castle's own frame in units."""
    return 19.5 + x, 2.0 + y, 19.5 + z


@pytest.mark.parametrize("fixed", [False, True])
def test_r11_door_wall_and_tower_are_equally_fogged(
    stage: Stage, plain_folder, fixed: bool
) -> None:
    clear_door = Assets(write_plain(plain_folder, {"castle_door.png": (90, 60, 30, 0)}))
    # At this density 1 part in 2,000 of the bricks is left at the gate.
    pose = Pose(20.5, 2.5, 17.7, 180.0, 0.0)
    picture = castle(stage, clear_door, pose, fog__density=1.5, castle__multitexture=fixed)
    wall = pixel(picture, project(pose, at(0.5, 0.5)))
    tower = pixel(picture, project(pose, at(1.0, 0.5, -0.13)))
    assert (np.abs(wall - tower).max() <= 2) == fixed


def test_r11_one_pass_mixes_the_door_in_by_its_alpha_and_lights_it(
    stage: Stage, plain_folder
) -> None:
    light = np.full((16, 16, 3), 100, np.uint8)
    light[:, 6:10] = 150  # half again as bright before the gate's middle
    changed = {"castle_door.png": (90, 60, 30, 102), "castle_light.png": light}
    assets = Assets(write_plain(plain_folder, changed))
    picture = castle(stage, assets, GATE, castle__multitexture=True)
    mixed = 0.4 * DOOR + 0.6 * BRICK
    got = pixel(picture, project(GATE, at(0.5, 0.8)))
    assert close(got, np.minimum(mixed * 1.5, 255), 3)
    assert close(pixel(picture, project(GATE, at(0.18, 0.8))), mixed, 3)
    # The wall above the gate's layers, and the part drawn below them, are bricks as before.
    assert close(pixel(picture, project(GATE, at(0.2, 1.03))), BRICK, 2)


def test_r11_the_lit_gate_is_shaded_as_the_sun_shades_the_walls(stage: Stage, plain_folder) -> None:
    assets = Assets(write_plain(plain_folder, {"castle_door.png": (90, 60, 30, 0)}))
    dim = {"sun__ambient": (0.5, 0.5, 0.5), "castle__multitexture": True}
    picture = castle(stage, assets, GATE, **dim)
    assert close(pixel(picture, project(GATE, at(0.5, 0.5))), 0.5 * BRICK, 2)


def test_the_halo_leaves_the_wall_as_it_is_where_no_torch_shines() -> None:
    light = np.array([[[100, 120, 140], [200, 180, 140]]], np.uint8)
    scaled = halo(light).astype(float) * 2 / 255
    assert np.allclose(scaled[0, 0], 1.0, atol=0.01)
    assert np.allclose(scaled[0, 1], (2.0, 1.5, 1.0), atol=0.01)


def test_r2_a_flame_turns_to_the_eye_and_stays_upright() -> None:
    assert flame_across((0.3, -5.0), 0.3, True) == pytest.approx((1.0, 0.0))
    assert flame_across((5.0, FLAME_Z), 0.3, True) == pytest.approx((0.0, 1.0))
    assert flame_across((5.0, FLAME_Z), 0.3, False) == (1.0, 0.0)
    for eye in ((3.0, -2.0), (-1.0, -0.5)):
        x, z = flame_across(eye, 0.75, True)
        assert math.hypot(x, z) == pytest.approx(1.0)
        assert x * (0.75 - eye[0]) + z * (FLAME_Z - eye[1]) == pytest.approx(0.0)


@pytest.mark.parametrize("fixed", [False, True])
def test_r2_from_the_side_a_flame_is_as_wide_as_from_the_front(
    stage: Stage, plain_folder, fixed: bool
) -> None:
    Image.new("RGBA", (64, 64), (255, 0, 255, 255)).save(plain_folder / "fire.png")
    side = Pose(20.0, 2.26, 19.5 + FLAME_Z, 90.0, 0.0)
    picture = castle(stage, Assets(plain_folder), side, castle__flame_faces=fixed)
    flame = (np.abs(picture - (255, 0, 255)).max(axis=2) < 9)[60]
    near = 19.5 + TORCHES[1] - 20.0
    wide = 0.06 / near * 60 / math.tan(math.radians(30))
    assert flame.sum() == (pytest.approx(wide, abs=2) if fixed else 0)
