"""The sky box: five walls that close, colours in given directions, what it follows."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from stage import Stage, close, kind_in, pixel, project, quad, small, taken, write_plain

from framelens.gl.seam import gl
from framelens.gl.texture import mip_levels
from landscape.elements.best.sky.seamless import seamless_levels
from landscape.elements.fog import visibility
from landscape.elements.sky_box import FACES, face_coordinates, face_corners, set_files
from landscape.elements.unfolded_sky import folded, unfolded
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.island.slots import SKY

LEVEL = 0.6
D = 8.0
H = 5.0
BACKGROUND = np.array([0.4, 0.6, 0.7]) * 255
BOX = {"water.level": LEVEL, "sky.half_width": D, "sky.height": H}
COLOURS = {
    "west": (200, 0, 0),
    "north": (0, 200, 0),
    "east": (0, 0, 200),
    "south": (200, 200, 0),
    "top": (0, 200, 200),
}
INFINITE = {"follow_y": True, "background": True, "unfogged": True}
YAWS = {"north": 0.0, "east": 90.0, "south": 180.0, "west": 270.0}


def test_a_picture_of_the_unfolded_box_is_cut_into_the_faces_again() -> None:
    rng = np.random.default_rng(4)
    coarse = [rng.integers(0, 255, (5, 16, 3), np.uint8) for _ in range(4)]
    coarse.append(rng.integers(0, 255, (16, 16, 3), np.uint8))
    faces = dict(zip(("north", "east", "south", "west", "top"), coarse, strict=True))
    sheet = unfolded(list(faces.values()), 16, 5)[..., :3]
    again = folded(np.ascontiguousarray(sheet), H / (2 * D))
    assert all((again[name] == faces[name]).all() for name in FACES)


def test_one_unfolded_picture_gives_the_sky_of_five_files(stage: Stage, tmp_path: Path) -> None:
    write_plain(tmp_path)
    colours = [COLOURS[name] for name in ("north", "east", "south", "west", "top")]
    plain = [np.full((40, 128, 3), each, np.uint8) for each in colours[:4]]
    plain.append(np.full((128, 128, 3), colours[4], np.uint8))
    Image.fromarray(unfolded(plain, 128, 40)).convert("RGB").save(tmp_path / "sheet.png")
    changes = {**BOX, "sky.unfolded": "sheet.png"}
    sky = kind_in(SKY, small(changes))(small(changes), Assets(tmp_path))
    assert not taken(sky, small(BOX))
    for name, yaw in YAWS.items():
        with stage.frame(small(changes), Pose(20.0, 2.0, 20.0, yaw, 0.0)) as frame:
            sky.draw(frame)
            assert close(stage.read()[60, 80], COLOURS[name], 2)
    with stage.frame(small(changes), Pose(20.0, 2.0, 20.0, 0.0, 89.0)) as frame:
        sky.draw(frame)
        assert close(stage.read()[60, 80], COLOURS["top"], 2)
    sky.release()


def test_the_walls_and_the_top_close_edge_to_edge() -> None:
    faces = face_corners(3.0, 2.0)
    assert tuple(faces) == FACES
    walls = ("west", "north", "east", "south")
    for left, right in zip(walls, walls[1:] + walls[:1], strict=True):
        # Seen from inside, a wall's right edge is the next wall's left edge.
        assert faces[left][[3, 2]].tolist() == faces[right][[0, 1]].tolist()
    rim = {tuple(corner) for wall in walls for corner in faces[wall][[0, 3]].tolist()}
    assert rim == {tuple(corner) for corner in faces["top"].tolist()}


def test_walls_are_counter_clockwise_seen_from_inside_and_the_top_from_above() -> None:
    for name, corners in face_corners(3.0, 2.0).items():
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
        inside = np.array([0.0, 1.0, 0.0]) - corners.mean(axis=0)
        assert (normal @ inside > 0) == (name != "top")


def test_the_box_spans_d_to_the_sides_and_0_to_h_upward() -> None:
    every = np.concatenate(list(face_corners(8.0, 5.0).values()))
    assert every.min(axis=0).tolist() == [-8.0, 0.0, -8.0]
    assert every.max(axis=0).tolist() == [8.0, 5.0, 8.0]


def test_coordinates_touch_the_centres_of_the_border_texels() -> None:
    assert face_coordinates(4, 8).tolist() == [
        [0.125, 0.0625],
        [0.125, 0.9375],
        [0.875, 0.9375],
        [0.875, 0.0625],
    ]


def drawn(
    stage: Stage, assets: Assets, pose: Pose, fog: bool = False, kt: float = 0.0, **changes: Any
) -> np.ndarray:
    settings = small({**BOX, **{f"sky.{k}": v for k, v in changes.items()}})
    sky = kind_in(SKY, settings)(settings, assets)
    with stage.frame(settings, pose, kt, fog=fog) as frame:
        sky.draw(frame)
        picture = stage.read()
    sky.release()
    return picture


@pytest.mark.parametrize("infinite", [False, True])
@pytest.mark.parametrize("face", YAWS)
def test_each_wall_stands_in_its_direction(
    stage: Stage, plain: Assets, face: str, infinite: bool
) -> None:
    pose = Pose(13.0, 1.0, 21.0, YAWS[face], 10.0)
    picture = drawn(stage, plain, pose, **(INFINITE if infinite else {}))
    assert close(picture[60, 80], COLOURS[face])


def test_straight_up_is_the_top(stage: Stage, plain: Assets) -> None:
    assert close(drawn(stage, plain, Pose(20, 1, 20, 40.0, 90.0))[60, 80], COLOURS["top"])


@pytest.mark.parametrize("y", [0.7, 1.5, 4.0])
def test_the_box_follows_the_eye_in_x_and_z_and_never_in_y(
    stage: Stage, plain: Assets, y: float
) -> None:
    pose = Pose(31.0, y, 7.0, 0.0, 0.0)
    picture = drawn(stage, plain, pose)
    foot = project(pose, (31.0, LEVEL, 7.0 - D))
    assert close(picture[int(foot[1] - 1.5), 80], COLOURS["north"])
    assert close(picture[int(foot[1] + 1.5), 80], BACKGROUND)
    up = Pose(31.0, y, 7.0, 0.0, 25.0)
    column, row = project(up, (31.0, LEVEL + H, 7.0 - D))
    picture = drawn(stage, plain, up)
    assert close(picture[int(row + 1.5), int(column)], COLOURS["north"])
    assert close(picture[int(row - 1.5), int(column)], COLOURS["top"])


@pytest.mark.parametrize("y", [0.7, 4.0])
def test_a_sky_that_follows_in_y_has_its_foot_at_the_eyes_own_height(
    stage: Stage, plain: Assets, y: float
) -> None:
    picture = drawn(stage, plain, Pose(31.0, y, 7.0, 0.0, 0.0), follow_y=True)
    assert close(picture[58, 80], COLOURS["north"])
    assert close(picture[61, 80], BACKGROUND)


@pytest.mark.parametrize("follow_y", [False, True])
def test_walls_that_reach_below_the_sea_are_lifted_with_the_eye(
    stage: Stage, plain: Assets, follow_y: bool
) -> None:
    pose = Pose(31.0, 4.0, 7.0, 0.0, -10.0)
    picture = drawn(stage, plain, pose, follow_y=follow_y, sunk=1.2)
    foot = project(pose, (31.0, (4.0 if follow_y else LEVEL) - 1.2, 7.0 - D))
    assert close(picture[int(foot[1] - 1.5), 80], COLOURS["north"])
    assert close(picture[int(foot[1] + 1.5), 80], BACKGROUND)


def test_the_fog_lies_on_the_walls_and_more_on_the_corners(stage: Stage, plain: Assets) -> None:
    pose = Pose(20.0, 2.0, 20.0, 45.0, 0.0)
    picture = drawn(stage, plain, pose, fog=True)
    # Eye-space depth of the corner between north and east, just left of it.
    point = (20.0 + D - 0.1, 2.4, 20.0 - D)
    depth = (2 * D - 0.1) / math.sqrt(2)
    part = float(visibility(np.array(depth), 0.12))
    wanted = part * np.array(COLOURS["north"]) + (1 - part) * BACKGROUND
    assert close(pixel(picture, project(pose, point)), wanted, 2)
    straight = drawn(stage, plain, Pose(20.0, 2.0, 20.0, 0.0, 0.0), fog=True)
    part_straight = math.exp(-((0.12 * D) ** 2))
    wanted = part_straight * np.array(COLOURS["north"]) + (1 - part_straight) * BACKGROUND
    assert close(straight[50, 80], wanted, 2)
    assert part < part_straight


def test_an_unfogged_sky_shows_its_own_colours_in_the_fog(stage: Stage, plain: Assets) -> None:
    pose = Pose(20.0, 1.0, 20.0, 0.0, 10.0)
    assert close(drawn(stage, plain, pose, fog=True, unfogged=True)[60, 80], COLOURS["north"])
    assert not close(drawn(stage, plain, pose, fog=True)[60, 80], COLOURS["north"], 9)


@pytest.mark.parametrize("background", [False, True])
def test_a_sky_in_the_background_hides_nothing_beyond_its_walls(
    stage: Stage, plain: Assets, background: bool
) -> None:
    settings = small({**BOX, "sky.background": background})
    sky = kind_in(SKY, settings)(settings, plain)
    pose = Pose(20.0, 1.0, 20.0, 0.0, 10.0)
    near, far = 2.0, 30.0
    with stage.frame(settings, pose) as frame:
        for distance, colour in ((far, (1.0, 1.0, 1.0, 1.0)), (near, (1.0, 0.0, 1.0, 1.0))):
            side = 0.2 * distance
            x = 20.0 + (side if distance == near else -side)
            corners = [(x - side, 0.5), (x + side, 0.5), (x + side, 30.0), (x - side, 30.0)]
            gl.glColor4f(*colour)
            quad(np.array([(a, b, 20.0 - distance) for a, b in corners]))
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)
        sky.draw(frame)
        picture = stage.read()

    sky.release()
    assert close(picture[60, 90], (255, 0, 255)), "what is near stands before any sky"
    assert close(picture[60, 70], 255 if background else COLOURS["north"])
    assert close(picture[60, 3], COLOURS["north"])


def test_pictures_are_seen_from_inside_the_right_way_round(stage: Stage, plain_folder) -> None:
    halves = np.zeros((8, 8, 3), np.uint8)
    halves[:, :4] = (250, 0, 0)  # left half red
    halves[:4, 4:] = (0, 250, 0)  # upper right green, lower right black
    assets = Assets(write_plain(plain_folder, {"sky_east.png": halves}))
    pose = Pose(20.0, LEVEL + H / 2, 20.0, 90.0, 0.0)
    picture = drawn(stage, assets, pose)
    assert close(picture[40, 40], (250, 0, 0)) and close(picture[80, 40], (250, 0, 0))
    assert close(picture[40, 120], (0, 250, 0)) and close(picture[80, 120], (0, 0, 0))


def test_the_sunset_is_another_set_of_faces(stage: Stage, plain_folder) -> None:
    reds = {f"sky_sunset_{face}.png": (220, 90, 30) for face in FACES}
    assets = Assets(write_plain(plain_folder, reds))
    picture = drawn(stage, assets, Pose(20.0, 1.0, 20.0, 0.0, 10.0), set="sunset")
    assert close(picture[60, 80], (220, 90, 30))


UP = Pose(20.0, 1.0, 20.0, 0.0, 10.0)
OWN, FINE = (220, 90, 30), (30, 90, 220)


@pytest.mark.seldom(10, first=9)
@pytest.mark.parametrize(
    ("name", "plain", "fine"), [("day", "", "fair_"), ("sunset", "sunset_", "dusk_")]
)
def test_own_pictures_of_plain_names_are_drawn_unless_refined_ones_are_beside_them(
    stage: Stage, tmp_path: Path, name: str, plain: str, fine: str
) -> None:
    shown = {"set": name, "refined": True}
    shipped = drawn(stage, Assets(), UP, **shown)
    assert (drawn(stage, Assets(tmp_path), UP, **shown) == shipped).all()
    assert (drawn(stage, Assets(), UP, set=name) != shipped).any()
    Image.new("RGB", (8, 8), OWN).save(tmp_path / f"sky_{plain}north.png")
    for refined in (False, True):
        assert close(drawn(stage, Assets(tmp_path), UP, set=name, refined=refined)[60, 80], OWN)
    Image.new("RGB", (8, 8), FINE).save(tmp_path / f"sky_{fine}north.jpg", "PNG")
    assert close(drawn(stage, Assets(tmp_path), UP, set=name)[60, 80], OWN)
    assert close(drawn(stage, Assets(tmp_path), UP, **shown)[60, 80], FINE)


def test_one_own_picture_of_a_plain_name_has_the_plain_set_beside_it(tmp_path: Path) -> None:
    (tmp_path / "sky_top.png").touch()
    found = set_files("day", True, Assets(tmp_path))
    assert [path.name for path in found] == [f"sky_{face}.png" for face in FACES]
    assert [path.parent == tmp_path for path in found] == [face == "top" for face in FACES]
    other = [path.name for path in set_files("sunset", True, Assets(tmp_path))]
    assert other == [f"sky_dusk_{face}.jpg" for face in FACES]


def test_r8_climbing_does_not_bring_the_clouds_nearer(stage: Stage) -> None:
    low, high = (Pose(20.0, y, 20.0, 40.0, 30.0) for y in (0.7, 4.5))
    plain, following = (
        [drawn(stage, Assets(), pose, follow_y=follow_y) for pose in (low, high)]
        for follow_y in (False, True)
    )
    assert np.abs(plain[0] - plain[1]).max() > 30
    assert (following[0] == following[1]).all()


@pytest.mark.parametrize("background", [False, True])
def test_r9_no_pixel_of_sky_hides_what_is_drawn(stage: Stage, background: bool) -> None:
    values = small({f"sky.{key}": True for key in INFINITE} | {"sky.background": background})
    box = kind_in(SKY, values)(values, Assets())
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
    stage: Stage, unfogged: bool, plain_folder
) -> None:
    same = {f"sky_{face}.png": (200, 120, 40) for face in FACES}
    values = small({"sky.unfogged": unfogged})
    box = kind_in(SKY, values)(values, Assets(write_plain(plain_folder, same)))
    seen = []
    for yaw in (0.0, 45.0):
        with stage.frame(values, Pose(20.0, 1.2, 20.0, yaw, 8.0), fog=True) as frame:
            box.draw(frame)
            seen.append(stage.read()[60, 80].astype(int))
    box.release()
    apart = np.abs(seen[0] - seen[1]).max()
    assert apart <= 2 if unfogged else apart > 20


@pytest.mark.parametrize("key", ["follow_y", "background", "unfogged", "anchored"])
def test_a_box_draws_applied_switches_as_if_built_from_them(
    stage: Stage, plain: Assets, key: str
) -> None:
    pose = Pose(27.0, 2.0, 12.0, 20.0, 10.0)
    box = kind_in(SKY, small(BOX))(small(BOX), plain)
    changed = small({**BOX, f"sky.{key}": True})
    assert taken(box, changed)
    with stage.frame(changed, pose, fog=True) as frame:
        box.draw(frame)
        picture = stage.read()
    box.release()
    assert (picture == drawn(stage, plain, pose, fog=True, **{key: True})).all()


@pytest.mark.parametrize(
    "change",
    [{"set": "sunset"}, {"refined": True}, {"half_width": 9.0}, {"height": 6.0}, {"moving": True}],
)
def test_a_box_refuses_settings_that_need_a_rebuild_and_stays_unchanged(
    stage: Stage, plain: Assets, change: dict
) -> None:
    pose = Pose(20.0, 2.0, 20.0, 20.0, 10.0)
    box = kind_in(SKY, small(BOX))(small(BOX), plain)
    new = {f"sky.{key}": value for key, value in change.items()}
    assert not taken(box, small({**BOX, **new, "sky.follow_y": True}))
    with stage.frame(small(BOX), pose) as frame:
        box.draw(frame)
        picture = stage.read()
    box.release()
    assert (picture == drawn(stage, plain, pose)).all()


def test_mip_levels_of_neighbouring_faces_match_along_the_edge() -> None:
    random = np.random.default_rng(5)
    left = random.integers(0, 256, (64, 256, 3), np.uint8)
    right = random.integers(0, 256, (64, 256, 3), np.uint8)
    right[:, 0] = left[:, -1]
    pairs = list(zip(seamless_levels(left), seamless_levels(right), strict=True))
    assert [one.shape[:2] for one, _ in pairs] == [(64 >> k, 256 >> k) for k in range(6)]
    for one, other in pairs:
        assert (one[:, -1] == other[:, 0]).all()
    plain = mip_levels(left)
    assert all(
        (one[1:-1, 1:-1] == levels[1:-1, 1:-1]).all()
        for (one, _), levels in zip(pairs, plain, strict=False)
    )
    odd = left[:63]
    assert len(seamless_levels(odd)) == 1 and seamless_levels(odd)[0] is odd
