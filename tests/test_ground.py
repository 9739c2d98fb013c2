"""The ground: heights and normals in closed form, two texture units, the clip plane."""

import numpy as np
import pytest
from PIL import Image
from stage import Stage, close, kind_in, pixel, project, small, taken

from framelens.gl.seam import gl, recording
from landscape.elements.ground import Ground, clipped
from landscape.elements.sun import direction
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.gl.draw import level_square
from landscape.island.slots import GROUND
from landscape.settings.declare import with_settings

SUN = np.array([0.0, 1.0, 0.0], np.float32)
DOWN = Pose(20.0, 9.0, 20.0, 0.0, -90.0)


LARGE, DETAIL = np.array([100, 150, 200]), np.array([96, 96, 96])


@pytest.mark.parametrize(
    ("units", "wanted"),
    [
        ("both", LARGE * DETAIL * 2 / 255),
        ("large", LARGE),
        ("detail", DETAIL),
        ("none", (255, 255, 255)),
    ],
)
def test_two_texture_units_give_large_times_detail_times_two(
    stage: Stage, plain: Assets, units: str, wanted
) -> None:
    settings = small({"ground.units": units})
    ground = Ground(settings, plain, SUN)
    with stage.frame(settings, DOWN) as frame:
        ground.draw(frame)
        picture = stage.read()
    ground.release()
    assert close(picture[20:100:20, 20:140:20], wanted)


@pytest.mark.parametrize("fogged", [False, True])
def test_a_second_pass_blended_over_gives_the_same_product(
    stage: Stage, plain: Assets, fogged: bool
) -> None:
    # Section 2.2.2: the alternative to multitexturing sends the geometry twice.
    pictures, sent = [], []
    for passes in ("one", "two"):
        settings = small({"ground.passes": passes, "fog.enabled": fogged, "fog.density": 0.05})
        ground = Ground(settings, plain, SUN)
        with stage.frame(settings, DOWN, fog=fogged) as frame:
            with recording() as recorder:
                ground.draw(frame)
            pictures.append(stage.read())
        (call,) = (each for each in recorder.calls if each.name == "glCallList")
        sent.append(sum(each.args[1] for each in call.listed if each.name == "glDrawElements"))
        ground.release()

    assert sent[1] == 2 * sent[0] > 0
    one, two = pictures
    if not fogged:
        assert np.abs(one - two).max() <= 2
        assert close(two[20:100:20, 20:140:20], LARGE * DETAIL * 2 / 255)
    else:
        # Each pass has its fog: the first f C + (1 - f) F, the second 2 (f D + (1 - f) / 2).
        middle = two[60, 80] / 255
        f = np.exp(-((0.05 * (9.0 - float(ground.height(20.0, 20.0)))) ** 2))
        first = f * LARGE / 255 + (1 - f) * np.array(settings.fog.color)
        assert np.abs(middle - first * 2 * (f * DETAIL / 255 + (1 - f) / 2)).max() < 0.02


def test_a_pass_leaves_what_is_in_front_of_the_ground(stage: Stage, plain: Assets) -> None:
    settings = small({"ground.passes": "two"})
    ground = Ground(settings, plain, SUN)
    with stage.frame(settings, DOWN) as frame:
        gl.glColor3f(1.0, 0.0, 0.0)
        level_square(10.0, 30.0, 8.0)
        gl.glColor3f(1.0, 1.0, 1.0)
        ground.draw(frame)
        assert close(stage.read()[60, 80], (255, 0, 0))
    ground.release()


def test_the_lit_ground_has_the_light_of_its_normals(stage: Stage, plain_folder) -> None:
    ramp = np.repeat(np.arange(256, dtype=np.uint8)[None, :], 256, axis=0)
    Image.fromarray(ramp).save(plain_folder / "height.png")
    light = {"sun.azimuth": 270.0, "sun.elevation": 45.0, "sun.diffuse": (0.8, 0.8, 0.8)}
    settings = small(
        {"ground.lit": True, "ground.units": "none", "sun.ambient": (0.1, 0.1, 0.1), **light}
    )
    ground = Ground(settings, Assets(plain_folder), SUN)
    with stage.frame(settings, DOWN) as frame:
        ground.draw(frame)
        picture = stage.read()
    facing = float(ground.field.normal(20.0, 20.0) @ direction(settings.sun))
    assert close(picture[60, 80], np.full(3, 255 * (0.1 + 0.8 * facing)), 3)
    ground.release()


@pytest.mark.parametrize("kind", [{}, {"ground.materials": True}])
def test_the_images_cover_the_part_of_the_map_that_is_asked_for(
    stage: Stage, plain_folder, kind: dict[str, object]
) -> None:
    # Section 2.1.2: set_scale takes x and z apart.
    high = np.full((64, 64), 200, np.uint8)
    Image.fromarray(high).save(plain_folder / "height.png")
    Image.fromarray(np.full((64, 64, 3), 90, np.uint8)).save(plain_folder / "ground_large.png")
    changes = {"ground.scale_x": 0.75, "ground.scale_z": 0.5, "ground.resolution": 81, **kind}
    settings = small(changes)
    ground = kind_in(GROUND, settings)(settings, Assets(plain_folder), SUN)
    x, z = np.array([2.0, 28.0, 32.0, 2.0]), np.array([2.0, 18.0, 2.0, 22.0])
    heights = ground.terrain_height(x, z)
    assert heights[:2] == pytest.approx(200 / 256 * settings.ground.scale_y)
    assert heights[2:] == pytest.approx(0.0)
    assert ground.large.shape == (64, 64, 3)
    assert ground.colour(x, z)[:2] == pytest.approx(90 / 255)
    assert not taken(ground, small({**changes, "ground.scale_z": 1.0}))
    ground.release()


def test_the_ground_is_drawn_where_its_heights_say(stage: Stage, plain_folder) -> None:
    ramp = np.repeat(np.arange(256, dtype=np.uint8)[None, :], 256, axis=0)
    Image.fromarray(ramp).save(plain_folder / "height.png")
    settings = small({"ground.resolution": 100})
    ground = Ground(settings, Assets(plain_folder), SUN)
    pose = Pose(20.0, 8.0, 60.0, 0.0, 0.0)
    with stage.frame(settings, pose) as frame:
        ground.draw(frame)
        picture = stage.read()
    ground.release()
    for x in (8.0, 20.0, 31.0):
        # The edge towards us stands at z = 40, at the height of its image column.
        height = x / 40 * 99 / 100 * 6
        column, row = project(pose, (x, height, 40.0))
        assert close(picture[int(row - 1.5), int(column)], LARGE * DETAIL * 2 / 255)
        assert close(picture[int(row + 1.5), int(column)], np.array([0.4, 0.6, 0.7]) * 255)


def test_the_clip_plane_removes_everything_below_the_water(stage: Stage, plain_folder) -> None:
    ramp = np.repeat(np.arange(256, dtype=np.uint8)[None, :], 256, axis=0)
    Image.fromarray(ramp).save(plain_folder / "height.png")
    settings = small({"ground.resolution": 100})
    ground = Ground(settings, Assets(plain_folder), SUN)
    level = 3.0
    pose = Pose(20.0, 30.0, 20.0, 0.0, -90.0)
    pictures = {}
    for enabled in (True, False):
        with stage.frame(settings, pose) as frame:
            with clipped(level, enabled):
                ground.draw(frame)
            pictures[enabled] = stage.read()

    ground.release()
    shore = level / 6 * 100 / 99 * 40
    column, row = project(pose, (shore, level, 20.0))
    sky, land = np.array([0.4, 0.6, 0.7]) * 255, LARGE * DETAIL * 2 / 255
    line = pictures[True][int(row)]
    assert close(line[int(column - 2)], sky) and close(line[int(column + 2)], land)
    assert close(pictures[False][int(row), int(column - 2)], land)


def test_the_clip_plane_is_disabled_when_the_block_ends_even_by_an_exception(stage: Stage) -> None:
    with stage.frame(small(), DOWN):  # the frame itself looks at what is enabled
        with pytest.raises(RuntimeError):
            with clipped(1.0):
                raise RuntimeError


def test_the_colour_asked_for_is_the_colour_drawn(stage: Stage, plain_folder) -> None:
    colours = np.zeros((64, 64, 3), np.uint8)
    colours[..., 0] = np.arange(64) * 4
    colours[..., 2] = 255 - np.arange(64)[:, None] * 4
    Image.fromarray(colours).save(plain_folder / "ground_large.png")
    settings = small({"ground.units": "large"})
    ground = Ground(settings, Assets(plain_folder), SUN)
    pose = Pose(20.0, 40.0, 20.0, 0.0, -90.0)
    with stage.frame(settings, pose) as frame:
        ground.draw(frame)
        picture = stage.read()
    asked = [(10.0, 12.0), (20.0, 30.0), (29.0, 7.0)]
    for x, z in asked:
        drawn = pixel(picture, project(pose, (x, 3.0, z)))
        assert close(drawn, ground.colour(np.array([x]), np.array([z]))[0] * 255, 4)
    ground.release()


# R19


def test_no_texture_is_larger_than_asked_for(stage: Stage, plain_folder) -> None:
    colours = np.zeros((64, 64, 3), np.uint8)
    Image.fromarray(colours).save(plain_folder / "ground_large.png")
    sizes = []
    for limit in (4096, 16):
        ground = Ground(small({"ground.texture_size": limit}), Assets(plain_folder), SUN)
        sizes.append(ground.large.shape)
        ground.release()
    assert sizes == [(64, 64, 3), (16, 16, 3)]


@pytest.mark.parametrize("changes", [{}, {"ground.materials": True, "ground.mid_repeat": 13.0}])
def test_colours_that_are_not_square_are_stretched_over_the_map(
    changes: dict[str, object], stage: Stage, plain_folder
) -> None:
    colours = np.zeros((20, 64, 3), np.uint8)
    colours[:10] = 200
    Image.fromarray(colours).save(plain_folder / "ground_large.png")
    ground = kind_in(GROUND, small(changes))(small(changes), Assets(plain_folder), SUN)
    assert ground.large.shape == (64, 64, 3)
    assert ground.large[:28].min() > 190 and ground.large[-28:].max() < 10
    ground.release()


# The ground's answers


def test_the_ground_gives_its_height_and_is_lit_everywhere(stage: Stage, plain_folder) -> None:
    ramp = np.repeat(np.arange(256, dtype=np.uint8)[None, :], 256, axis=0)
    Image.fromarray(ramp).save(plain_folder / "height.png")
    settings = small({"ground.resolution": 100, "water.level": 3.0})
    ground = Ground(settings, Assets(plain_folder), SUN)
    x, z = np.array([8.0, 31.0]), np.array([20.0, 20.0])
    wanted = x / 40 * 99 / 100 * 6
    assert ground.size == 40.0
    assert np.allclose(ground.terrain_height(x, z), wanted, atol=1e-3)
    assert np.allclose(ground.height(x, z), np.maximum(wanted, 3.0), atol=1e-3)
    assert ground.light(x, z).tolist() == [[1.0] * 3] * 2
    ground.release()


def test_the_ground_accepts_settings_that_it_does_not_use_and_refuses_the_rest(
    stage: Stage, plain: Assets
) -> None:
    settings = small()
    ground = Ground(settings, plain, SUN)
    for key, value in (
        ("ground.clip", False),
        ("ground.sand_repeat", 3.0),
        ("fog.density", 1.0),
        ("sun.azimuth", 5.0),
        ("camera.cull", True),
        ("ground.mid_repeat", 5.0),
    ):
        assert taken(ground, with_settings(settings, {key: value})), key

    for key, value in (
        ("ground.resolution", 41),
        ("ground.units", "large"),
        ("ground.detail_repeat", 3.0),
        ("ground.materials", True),
        ("ground.shadows", True),
        ("ground.smooth", "catmull_rom"),
        ("water.level", 1.0),
    ):
        assert not taken(ground, with_settings(settings, {key: value})), key

    ground.release()


def test_a_users_own_island_is_coloured_by_height_and_by_the_sun(
    stage: Stage, plain_folder
) -> None:
    ramp = np.repeat(np.arange(256, dtype=np.uint8)[None, :], 256, axis=0)
    Image.fromarray(ramp).save(plain_folder / "mine.png")
    settings = small({"ground.height_image": "mine.png"})
    ground = Ground(settings, Assets(plain_folder), SUN)
    assert ground.large.shape == (512, 512, 3) and ground.large.std() > 10
    assert not taken(ground, with_settings(settings, {"sun.azimuth": 5.0}))
    ground.release()
