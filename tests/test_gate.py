"""The gate in one pass (R11): fogged once, the door mixed in by its alpha, the halo, the light."""

import numpy as np
import pytest
from castles import BRICK, DOOR, GATE, at, drawn
from stage import Stage, close, pixel, project, write_plain

from landscape.elements.best.castle.gate import GATE_CORNERS, halo, without_gate
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.masonry import FOOT, walls_mesh


@pytest.mark.parametrize("fixed", [False, True])
def test_r11_door_wall_and_tower_are_equally_fogged(
    stage: Stage, plain_folder, fixed: bool
) -> None:
    clear_door = Assets(write_plain(plain_folder, {"castle_door.png": (90, 60, 30, 0)}))
    # At this density 1 part in 2,000 of the bricks is left at the gate.
    pose = Pose(20.5, 2.5, 17.7, 180.0, 0.0)
    picture = drawn(stage, clear_door, pose, fog__density=1.5, castle__multitexture=fixed)
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
    merlons = {"castle__battlements": True}
    picture = drawn(stage, assets, GATE, castle__multitexture=True, **merlons)
    mixed = 0.4 * DOOR + 0.6 * BRICK
    got = pixel(picture, project(GATE, at(0.5, 0.8)))
    assert close(got, np.minimum(mixed * 1.5, 255), 3)
    assert close(pixel(picture, project(GATE, at(0.18, 0.8))), mixed, 3)
    # The wall above the gate's layers, and the part drawn below them, are bricks as before.
    assert close(pixel(picture, project(GATE, at(0.2, 1.03))), BRICK, 2)


def test_r11_the_lit_gate_is_shaded_as_the_sun_shades_the_walls(stage: Stage, plain_folder) -> None:
    assets = Assets(write_plain(plain_folder, {"castle_door.png": (90, 60, 30, 0)}))
    dim = {"sun__ambient": (0.5, 0.5, 0.5), "castle__multitexture": True}
    picture = drawn(stage, assets, GATE, **dim)
    assert close(pixel(picture, project(GATE, at(0.5, 0.5))), 0.5 * BRICK, 2)


def test_the_halo_leaves_the_wall_as_it_is_where_no_torch_shines() -> None:
    light = np.array([[[100, 120, 140], [200, 180, 140]]], np.uint8)
    scaled = halo(light).astype(float) * 2 / 255
    assert np.allclose(scaled[0, 0], 1.0, atol=0.01)
    assert np.allclose(scaled[0, 1], (2.0, 1.5, 1.0), atol=0.01)


def test_the_walls_leave_out_the_gate_walls_face_above_the_ground() -> None:
    walls = walls_mesh(4.0)
    left = without_gate(walls, 4.0)
    assert np.array_equal(left.vertices[4:], walls.vertices[4:])
    assert np.allclose(walls.vertices[:4, 1], [-FOOT, -FOOT, 1.0, 1.0])
    assert np.allclose(left.vertices[:4, 1], [-FOOT, -FOOT, 0.0, 0.0])
    # At y = 0 the bricks are cut, not squeezed: t grows downwards, 4 per unit.
    assert np.allclose(left.coordinates[0][2:4, 1], 4.0)
    assert left.vertices[:2, 0].tolist() == [x for x, y in GATE_CORNERS if y == 0]
