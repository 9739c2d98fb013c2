"""The sprites' fixes of section 11.2: each test fails when its fix is taken out."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from landscape.elements.sprites.sprite_quads import (
    box_corners,
    crossed_quads,
    edge_on,
    half_places,
    leaning,
    lying,
    slope_axes,
    smoothstep,
    steepness,
    within,
)
from landscape.elements.sprites.sprite_rules import clearness, radii, reach
from PIL import Image
from stage import PLAIN, WHITE_LIGHT, Stage, close, pixel, project, small, snapshot, write_plain
from test_transparent_elements import BACKGROUND, BLUE, PLANT_GREEN, RED, looking, put

from landscape.elements.castle import FLAME_Z, Castle, flame_across, halo
from landscape.elements.ground import Ground
from landscape.elements.ornate.castle_meshes import TORCHES
from landscape.elements.sprites.atlas import CELL, CELLS, from_above, outline, top_coordinates
from landscape.elements.sprites.planting import PLANT, plant_everything, slopes_under
from landscape.elements.sprites.sprites_in_view import turned
from landscape.elements.transparent_elements import TransparentElements, outlines
from landscape.files.assets import Assets
from landscape.frame import Frame, Pose
from landscape.geometry.camera import in_view
from landscape.geometry.height_field import HeightField
from landscape.keys import with_settings
from landscape.settings import Settings

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


# The sprites: R3, R4, R5, R6, and what comes with them


@pytest.fixture(scope="module")
def sprites(the_stage: Stage, tmp_path_factory) -> Iterator[TransparentElements]:
    """The element, its cells of one colour each: broadleaf red, conifer blue, plant green."""
    the_stage.enter()
    folder = tmp_path_factory.mktemp("fixes")
    colours = {name: (9, 9, 9, 255) for name in CELLS}
    colours |= {CELLS[0]: RED, CELLS[1]: BLUE, CELLS[PLANT]: PLANT_GREEN}
    write_plain(folder)
    for name, colour in colours.items():
        Image.new("RGBA", (CELL, CELL), colour).save(folder / name)
    settings = small({"transparent.radius": 50.0})
    ground = Ground(settings, Assets(folder), np.array([0, 1, 0], np.float32))
    element = TransparentElements(settings, Assets(folder), ground, 1, {"trees", "deer", "plants"})
    yield element
    the_stage.enter()
    element.release()
    ground.release()


NORTH = Pose(20.0, 3.5, 20.0, 0.0, 0.0)


def seen(
    stage: Stage, element: TransparentElements, pose: Pose = NORTH, **changes: Any
) -> np.ndarray:
    """Return the sprites' picture under some settings; the state must stay."""
    keys = {key.replace("__", "."): value for key, value in changes.items()}
    settings = small({"transparent.radius": 50.0, "plants.sway": 0.0, **keys})
    element._settings = settings
    with stage.frame(settings, pose) as frame:
        element.draw(frame)
        return stage.read()


def covered(picture: np.ndarray) -> np.ndarray:
    """Return which pixels show something, (h, w)."""
    return np.asarray(np.abs(picture - BACKGROUND).max(axis=2) > 12)


@pytest.mark.parametrize("fixed", [False, True])
def test_r3_the_near_half_of_a_quad_lies_before_a_billboard_that_crosses_it(
    stage: Stage, sprites: TransparentElements, fixed: bool
) -> None:
    # The plant's quad along z goes through the tree, which stands a little nearer than its middle.
    pose = Pose(19.0, 3.5, 20.0, 14.0, 0.0)
    put(sprites, [(20.0, 3.0, 16.0), (20.0, 3.0, 16.12)], [PLANT, 0], (1.0, 1.0))
    picture = seen(stage, sprites, pose, transparent__split=fixed)
    near = pixel(picture, project(pose, (20.0, 3.4, 16.4)))
    far = pixel(picture, project(pose, (20.0, 3.4, 15.75)))
    assert close(near, PLANT_GREEN[:3] if fixed else RED[:3], 12)
    assert close(far, RED[:3], 12)


def test_r3_halves_stand_where_their_feet_are() -> None:
    crossed = crossed_quads(np.array([[5.0, 1.0, 7.0]]), np.array([[0.8, 1.0]]), np.zeros((1, 2)))
    wanted = [(4.8, 1, 7), (5.2, 1, 7), (5, 1, 6.8), (5, 1, 7.2)]
    assert np.allclose(half_places(crossed)[0], wanted)


@pytest.mark.parametrize("fixed", [False, True])
def test_r4_from_above_an_upright_billboard_is_foreshortened(
    stage: Stage, sprites: TransparentElements, fixed: bool
) -> None:
    pose = Pose(20.0, 6.0, 17.0, 0.0, -60.0)
    put(sprites, [(20.0, 3.0, 15.5)], [1])
    rows = np.flatnonzero(
        covered(seen(stage, sprites, pose, transparent__upright=fixed)).any(axis=1)
    )
    foot, top = (project(pose, (20.0, y, 15.5))[1] for y in (3.0, 4.0))
    lying_down = project(pose, (20.0, 3.0 + math.cos(math.pi / 3), 15.5 - math.sin(math.pi / 3)))[1]
    assert rows[-1] == pytest.approx(foot, abs=2)
    assert rows[0] == pytest.approx(top if fixed else lying_down, abs=2)


def test_r5_axes_lie_in_the_slope_and_stand_on_it() -> None:
    slopes = np.array([(0.0, 0.0), (0.5, 0.0), (0.3, -0.4), (30.0, 0.0)])
    across, up = slope_axes(np.array([1.0, 0.0, 0.0]), leaning(slopes))
    assert np.allclose(np.linalg.norm(across, axis=1), 1) and np.allclose((across * up).sum(1), 0)
    assert np.allclose(across[1], np.array([1, 0.5, 0]) / math.hypot(1, 0.5))
    assert np.allclose(up[2], np.array([-0.3, 1, 0.4]) / math.sqrt(1.25))
    assert up[0].tolist() == [0, 1, 0]
    assert up[3, 1] > math.cos(math.radians(36))  # never flat on its side


def test_r5_the_slope_is_that_between_the_ends_of_the_foot() -> None:
    along = np.linspace(0, 40, 401)
    hill = HeightField(np.tile(along * 0.25, (401, 1)).astype(np.float32), 40.0, 0.0)
    slopes = slopes_under(hill, np.array([[20.0, 5.0, 20.0]]), np.array([0.2]))
    assert slopes == pytest.approx(np.array([[0.25, 0.0]]), abs=1e-4)


@pytest.mark.parametrize("fixed", [False, True])
def test_r5_a_deer_has_both_ends_of_its_feet_on_the_slope(
    stage: Stage, sprites: TransparentElements, fixed: bool
) -> None:
    put(sprites, [(20.0, 3.0, 17.0)], [4])
    sprites.sprites.slopes[:] = (0.5, 0.0)
    picture = covered(seen(stage, sprites, deer__follow_slope=fixed))
    column, row = project(NORTH, (20.4, 3.2, 17.0))  # on the slope, under the body's right end
    assert picture[int(row) + 4, int(column)] != fixed  # inside the hill
    assert picture[int(row) - 4, int(column)]


def test_r6_three_quads_stand_at_60_degrees() -> None:
    place = np.array([[5.0, 1.0, 7.0]])
    turns = turned(place, 3)
    assert np.diff(turns[0]) == pytest.approx([math.pi / 3] * 2)
    quads = crossed_quads(place, np.array([[0.8, 0.5]]), np.zeros((1, 2)), turns)[0]
    ends = quads[[2, 8, 14]] - place
    assert np.allclose(np.hypot(ends[:, 0], ends[:, 2]), 0.4)
    assert np.allclose(np.arctan2(ends[:, 2], ends[:, 0]) % np.pi, turns[0] % np.pi)
    assert np.allclose(
        crossed_quads(place, np.ones((1, 2)), np.ones((1, 2)), turned(place, 2)),
        crossed_quads(place, np.ones((1, 2)), np.ones((1, 2))),
    )


def test_r6_all_three_quads_are_drawn_where_they_stand(
    stage: Stage, sprites: TransparentElements
) -> None:
    place = np.array([19.951, 3.0, 17.0])  # its own turn leaves none edge-on
    put(sprites, [place], [PLANT], (1.0, 0.3))
    pose = Pose(20.0, 5.0, 18.5, 0.0, -53.0)  # looks at the plant
    picture = covered(seen(stage, sprites, pose, plants__quads=3))
    for turn in turned(place[None], 3)[0]:
        for end in (-0.45, 0.45):
            foot = place + (end * math.cos(turn), 0.1, end * math.sin(turn))
            column, row = project(pose, tuple(foot))
            assert picture[int(row), int(column)]


def test_r6_a_quad_shows_face_on_and_not_edge_on() -> None:
    east = np.array([[1.0, -0.2, 0.0]])
    assert edge_on(east, np.array([[math.pi / 2, 0.0]])).tolist() == [[1.0, 0.0]]
    for view in np.linspace(0, math.pi, 60):
        away = np.array([[math.cos(view), 0.0, math.sin(view)]])
        for quads in (2, 3):
            shown = edge_on(away, np.arange(quads)[None] * math.pi / quads)
            assert shown.max() == 1.0 and (quads == 2 or (shown > 0.6).sum() >= 2)


@pytest.mark.parametrize("fixed", [False, True])
def test_r6_no_line_is_seen_along_a_quad(
    stage: Stage, sprites: TransparentElements, fixed: bool
) -> None:
    # From a little beside the quad along z: it is a thin strip, taller than the other's top.
    pose = Pose(20.0, 3.2, 18.0, 0.0, 0.0)
    put(sprites, [(20.02, 3.0, 17.0)], [PLANT], (1.0, 0.4))
    picture = covered(seen(stage, sprites, pose, plants__fade_edge_on=fixed))
    top = project(pose, (20.02, 3.4, 17.0))[1]
    assert picture[: int(top) - 2].any() != fixed
    assert picture[int(top) + 4 :].any()


@pytest.mark.parametrize("fixed", [False, True])
def test_r6_from_above_a_plant_is_a_disc_and_no_cross(
    stage: Stage, sprites: TransparentElements, fixed: bool
) -> None:
    above = Pose(20.0, 6.0, 16.0, 0.0, -90.0)
    put(sprites, [(20.0, 3.0, 16.0)], [PLANT], (1.0, 0.6))
    picture = covered(seen(stage, sprites, above, plants__rosette=fixed, plants__fade_edge_on=True))
    between = [
        project(above, (20 + 0.2 * dx, 3.2, 16 + 0.2 * dz)) for dx in (-1, 1) for dz in (-1, 1)
    ]
    assert all(picture[int(row), int(column)] == fixed for column, row in between)


@pytest.mark.parametrize("fixed", [False, True])
def test_from_above_a_tree_is_a_crown_and_no_line(
    stage: Stage, sprites: TransparentElements, fixed: bool
) -> None:
    above = Pose(20.0, 7.0, 16.0, 0.0, -90.0)
    put(sprites, [(20.0, 3.0, 16.0)], [1])
    changes = {"trees__crown": fixed, "transparent__upright": True}
    picture = covered(seen(stage, sprites, above, **changes))
    for dx, dz in ((0.25, 0.1), (-0.1, -0.25), (0.2, -0.2)):
        column, row = project(above, (20.0 + dx, 3.62, 16.0 + dz))
        assert picture[int(row), int(column)] == fixed


def test_a_view_from_above_is_round_and_repeats_its_fan() -> None:
    image = np.zeros((64, 64, 4), np.uint8)
    image[...] = (10, 200, 30, 255)
    image[:, 32:] = (200, 20, 30, 255)
    top = from_above(image, (0.5, 0.95), (0.9, 0.9), 0.0, 40.0, 4, 32)
    assert top.shape == (32, 32, 4)
    at_ = np.hypot(*np.meshgrid(np.arange(32) - 15.5, np.arange(32) - 15.5))
    assert (top[at_ < 12, 3] == 255).all() and (top[at_ > 17, 3] == 0).all()
    moved = np.abs(top.astype(int) - top[::-1, ::-1]).max(axis=2) > 60
    assert moved[at_ < 12].mean() < 0.1  # two turns of two fans
    colours = {tuple(int(v) for v in c) for c in top[at_ < 12][:, :3] // 100}
    assert {(0, 2, 0), (2, 0, 0)} <= colours


def test_views_from_above_keep_clear_of_each_other() -> None:
    corners = top_coordinates(np.array([0, 1, 2, 6]))
    for k, one in enumerate(corners):
        for other in corners[k + 1 :]:
            apart = np.maximum(one.min(0) - other.max(0), other.min(0) - one.max(0))
            assert apart.max() > 0.01
    assert corners[..., 0].min() > 0.75 and corners[..., 1].min() > 0.5


def test_lying_quads_follow_the_ground() -> None:
    place, slopes = np.array([[1.0, 2.0, 3.0]]), np.array([[0.5, -0.25]])
    quad = lying(place, np.array([2.0]), slopes, np.array([0.3]))[0] - place[0]
    assert np.allclose(quad[:, 1], 0.5 * quad[:, 0] - 0.25 * quad[:, 2])
    assert np.allclose(np.hypot(quad[:, 0], quad[:, 2]), math.sqrt(2.0))
    assert steepness(np.array([[0.0, -2.0, 0.0], [3.0, -4.0, 0.0]])) == pytest.approx([1.0, 0.8])
    assert smoothstep(1, 3, np.array([0, 1, 2, 3, 9.0])).tolist() == [0, 0, 0.5, 1, 1]


@pytest.mark.parametrize("fade", [0.0, 0.5])
def test_sprites_come_out_of_nothing_towards_the_radius(
    stage: Stage, sprites: TransparentElements, fade: float
) -> None:
    place = (20.0, 3.0, 17.0)
    put(sprites, [place], [1])
    changes = {"transparent__radius": 4.0, "transparent__fade": fade}
    got = pixel(seen(stage, sprites, **changes), project(NORTH, (20.0, 3.5, 17.0)))
    part = 0.5 if fade else 1.0  # 3 units away, a quarter of the radius before the end
    assert close(got, part * np.array(BLUE[:3]) + (1 - part) * BACKGROUND, 3)


def test_faded_sprites_stop_where_the_fog_hides_all() -> None:
    keys = {"transparent.radius": 50.0, "transparent.fade": 0.1, "fog.density": 0.5}
    far = reach(with_settings(Settings(), keys))
    assert math.exp(-((0.5 * far) ** 2)) == pytest.approx(1 / 512)
    assert reach(with_settings(Settings(), {**keys, "transparent.fade": 0.0})) == 50.0


def test_what_is_less_high_than_so_many_pixels_is_not_drawn() -> None:
    frame = looking(NORTH)
    cells, heights = np.array([0, PLANT, 0]), np.array([0.5, 0.05, 0.01], np.float32)
    keys = {"transparent.radius": 8.0, "plants.radius": 4.0}
    far = radii(with_settings(Settings(), keys), cells, heights, frame)
    assert far.tolist() == [8.0, 4.0, 8.0]
    least = with_settings(Settings(), {**keys, "transparent.min_pixels": 2.0})
    far = radii(least, cells, heights, frame)
    assert far[0] == 8.0
    # So far off the others are just two pixels high.
    pixels = heights[1:] / far[1:] * frame.size[1] / (2 * math.tan(math.radians(frame.fov / 2)))
    assert pixels == pytest.approx([2.0, 2.0])


def test_a_sprite_clears_away_before_the_eye_meets_it() -> None:
    keys = {"transparent.clear_near": True, "transparent.fade": 0.0}
    radius, widths, away = np.full(4, 8.0), np.ones(4), np.array([0.2, 0.35, 0.5, 5.0])
    clear = clearness(with_settings(Settings(), keys), radius, widths, away)
    assert clear == pytest.approx([0.0, 0.5, 1.0, 1.0])
    settings = with_settings(Settings(), {**keys, "transparent.clear_near": False})
    assert (clearness(settings, radius, widths, away) == 1.0).all()


@pytest.mark.parametrize("rooted", [False, True])
def test_feet_of_trees_sink_where_the_ground_slopes(
    stage: Stage, sprites: TransparentElements, rooted: bool
) -> None:
    put(sprites, [(20.0, 3.0, 17.0)], [1])
    sprites.sprites.slopes[:] = (0.6, 0.8)
    picture = covered(seen(stage, sprites, transparent__rooted=rooted))
    bottom = np.flatnonzero(picture.any(axis=1))[-1]
    foot = 3.0 - (0.07 if rooted else 0.0)
    assert bottom == pytest.approx(project(NORTH, (20.0, foot, 17.0))[1] - 1, abs=1)


def test_an_outline_holds_all_that_shows_in_less_area() -> None:
    alpha = np.zeros((128, 128), np.uint8)
    alpha[20:70, 10:110] = 255
    alpha[70:, 50:66] = 255
    boxes = outline(alpha)
    inside = np.zeros_like(alpha)
    for s0, t0, s1, t1 in (boxes * 128).round().astype(int):
        inside[t0:t1, s0:s1] = 1
    assert (inside[alpha > 0] == 1).all() and inside.mean() < 0.45
    assert boxes[0, 3] == boxes[1, 1]


def test_a_trimmed_quad_shows_the_same_picture(
    stage: Stage, sprites: TransparentElements, monkeypatch: pytest.MonkeyPatch
) -> None:
    cell = np.zeros((CELL, CELL, 4), np.uint8)
    cell[100:300, 60:420] = (0, 0, 250, 255)
    cell[300:, 200:260] = (0, 0, 250, 255)
    tables = outlines([cell] * len(CELLS))
    monkeypatch.setattr(sprites, "_outlines", tables[0])
    monkeypatch.setattr(sprites, "_outline_coordinates", tables[1])
    put(sprites, [(20.0, 3.0, 17.0)], [1])
    sprites.sprites.flipped[:] = True
    picture = covered(seen(stage, sprites, transparent__trimmed=True))
    whole = covered(seen(stage, sprites))
    assert (whole | ~picture).all() and 0.3 < picture.sum() / whole.sum() < 0.7
    # Mirrored, the trunk stands right of the middle by as much as it stood left.
    columns = np.flatnonzero(picture[int(project(NORTH, (20.0, 3.1, 17.0))[1])])
    middle = project(NORTH, (20.0 + 0.5 - 230 / CELL, 3.1, 17.0))[0]
    assert (columns[0] + columns[-1] + 1) / 2 == pytest.approx(middle, abs=2)


def test_corners_of_boxes_are_points_of_the_quad() -> None:
    quad = np.array([[(0, 0, 0), (2, 0, 0), (2, 4, 0), (0, 4, 0)]], float)
    points = within(quad, box_corners(np.array([[(0.25, 0.5, 0.75, 1.0)]])).reshape(1, 4, 2))
    assert np.allclose(points[0], [(0.5, 0, 0), (1.5, 0, 0), (1.5, 2, 0), (0.5, 2, 0)])


@pytest.mark.parametrize("pose", [Pose(20, 3, 20, 33, -12), Pose(20, 6, 20, 200, -70)])
def test_nothing_in_the_picture_is_left_out(pose: Pose) -> None:
    frame: Frame = looking(pose)
    rng = np.random.default_rng(8)
    places, reach = rng.random((4000, 3)) * (40, 6, 40), rng.random(4000)
    kept = in_view(frame, places, reach)
    for place in places[~kept][::9]:
        offsets = rng.normal(size=(40, 3))
        around = (
            place
            + offsets
            / np.linalg.norm(offsets, axis=1)[:, None]
            * reach[np.flatnonzero((places == place).all(axis=1))[0]]
        )
        for point in around[np.array([p for p in frame.depth(around)]) < -0.01]:
            column, row = project(pose, tuple(point))
            assert not (0 <= column < 160 and 0 <= row < 120)
    assert 0.01 < kept.mean() < 0.6


def test_far_plants_are_single_quads(stage: Stage, sprites: TransparentElements) -> None:
    put(sprites, [(20.0, 3.0, 17.0), (20.0, 3.0, 12.0)], [PLANT, PLANT])
    counts = []
    for within_ in (0.0, 5.0):
        seen(stage, sprites, plants__crossed_within=within_)
        with stage.frame(sprites._settings, NORTH) as frame:
            counts.append(len(sprites.prepare(frame)[3]) // 6)
    assert counts == [8, 5]


def test_switching_everything_on_and_off_again_changes_nothing(
    stage: Stage, sprites: TransparentElements
) -> None:
    rng = np.random.default_rng(1)
    places = np.stack([rng.uniform(18, 22, 30), np.full(30, 3.0), rng.uniform(14, 19, 30)], axis=1)
    put(sprites, places, rng.integers(0, 7, 30), (0.6, 0.6))
    before, state = seen(stage, sprites), snapshot()
    every = {
        "transparent__split": True, "transparent__fade": 0.2, "transparent__rooted": True,
        "transparent__trimmed": True, "trees__crown": True, "deer__follow_slope": True,
        "plants__quads": 3, "plants__fade_edge_on": True, "plants__rosette": True,
        "plants__crossed_within": 3.0,
    }  # fmt: skip
    assert (seen(stage, sprites, **every) != before).any()
    assert (seen(stage, sprites) == before).all()
    assert snapshot() == state


def test_woods_keep_off_the_beach_and_shrubs_stand_at_their_edges(shipped: Assets, stage) -> None:
    from landscape.elements.sprites.planting import SHRUB, woodland
    from landscape.settings import preset

    settings = preset("best")
    ground = Ground(settings, shipped, np.array([0, 1, 0], np.float32))
    sprites = plant_everything(settings, ground, 2006, {"trees"})
    ground.release()
    x, y, z = sprites.positions.T
    assert (y > settings.water.level + 0.12).all()
    assert ground.field.slope(x, z).max() < 0.91
    thick = woodland(2006)(x, z)
    shrubs = sprites.cells == SHRUB
    assert thick[shrubs].mean() < thick[~shrubs].mean()
