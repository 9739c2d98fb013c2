"""The sea: relief, opacity, shallows, the mirror image in texture or framebuffer, new settings."""

from pathlib import Path

import numpy as np
import pytest
from seaside import BACKGROUND, CALM, LEVEL, POSE, beach, drawn, grid_at, mirrored_wall, red, sent
from stage import WHITE_LIGHT, Stage, close, live_names, pixel, project, quad, small, taken

from framelens.base.errors import InputError
from framelens.gl.seam import gl
from landscape.elements.best.sea import waves
from landscape.elements.best.sea.sea import Sea, fog_depths, reflected
from landscape.elements.best.sea.shallows import (
    COLOURS,
    FLOOR,
    SEEN,
    body_picture,
    cut_level,
    depth_picture,
)
from landscape.elements.reflection import inside_water
from landscape.elements.settings import Settings, preset
from landscape.elements.water_surface import WaterSurface
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.settings.declare import get

BETTER = ("reflection.rippled", "water.relief", "water.shallow", "water.fresnel")
DEEP = COLOURS[-1]
DOWN = Pose(20.0, 5.6, 21.5, 0.0, -89.9)


def test_the_sea_is_wanted_in_best_and_wherever_one_of_its_switches_is_on() -> None:
    assert not Sea.serves(Settings()) and Sea.serves(preset("best"))
    for key in BETTER:
        assert get(Settings(), key) is False and get(preset("best"), key) is True, key
        assert Sea.serves(small({key: True})), key
    assert Sea.serves(small({"water.glitter": 0.1}))
    assert Sea.serves(small({"water.foam": True})) and Sea.serves(small({"water.ripples": 0.1}))
    assert Sea.serves(small({"water.horizon_contrast": 0.1}))
    assert not Sea.serves(small({"water.horizon": 400.0, "water.query": True}))


def test_a_dragon_that_cannot_be_read_leaves_no_texture_behind(
    stage: Stage, plain: Assets, tmp_path: Path
) -> None:
    (tmp_path / "bad.ply").write_text("ply\n")
    mesh = {"dragon.mesh": str(tmp_path / "bad.ply")}
    settings = small({"water.foam": True, "water.shallow": True, **mesh})
    before = live_names()
    with pytest.raises(InputError, match="bad"):
        Sea(settings, plain, beach(), dragon=True)
    assert live_names() == before


# Relief and opacity.


def test_relief_moves_the_vertices_about_the_level_and_fades_out_at_the_beach(
    stage: Stage, plain: Assets
) -> None:
    pose = Pose(20.0, 1.4, 22.0, 180.0, -30.0)
    on = sent(drawn(stage, plain, {"water.relief": True}, pose)[1], "glVertexPointer")[0]
    off = sent(drawn(stage, plain, {"water.shallow": True}, pose)[1], "glVertexPointer")[0]
    assert np.allclose(off[:, 1], LEVEL)
    assert 0.003 < np.abs(on[:, 1] - LEVEL).max() < 0.03
    north = Pose(20.0, 1.4, 21.5, 0.0, -30.0)
    on = sent(drawn(stage, plain, {"water.relief": True}, north)[1], "glVertexPointer")[0]
    assert np.abs(on[on[:, 2] < 19.9][:, 1] - LEVEL).max() == 0.0


def test_moving_waves_change_the_picture(stage: Stage, plain: Assets) -> None:
    changes = {"water.relief": True, "water.textured": False, "water.fresnel": True}
    first, second = (drawn(stage, plain, changes, kt=kt)[0] for kt in (0.0, 30.0))
    assert (first != second).any()
    still = changes | {"water.animated": False}
    assert (drawn(stage, plain, still)[0] == drawn(stage, plain, still, kt=30.0)[0]).all()


def test_the_alpha_follows_the_viewing_angle(
    stage: Stage, plain: Assets, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(waves, "STEEP", 0.0 * waves.STEEP)
    monkeypatch.setattr(waves, "ROUGH", 0.0)
    eye = Pose(20.0, 1.6, 20.0, 0.0, -30.0)
    picture = drawn(stage, plain, {**CALM, "water.fresnel": True}, eye)[0]
    for x, z in ((20.0, 18.0), (20.0, 17.0), (19.5, 14.0)):
        away = np.array([x - 20.0, -1.0, z - 20.0])
        alpha = 0.7 * (1 - waves.CLEARED * (1 - 1 / np.linalg.norm(away)) ** waves.FRESNEL_POWER)
        wanted_ = alpha * np.array([0.2, 0.2, 0.4]) * 255 + (1 - alpha) * BACKGROUND
        assert close(pixel(picture, project(eye, (x, LEVEL, z))), wanted_, 2), (x, z)


def test_a_calm_sea_has_the_patches_colour(
    stage: Stage, plain: Assets, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(waves, "STEEP", 0.0 * waves.STEEP)
    settings = small({**WHITE_LIGHT, "water.animated": False})
    pictures = []
    for water in (Sea(settings, plain, beach()), WaterSurface(settings, plain)):
        with stage.frame(settings, DOWN) as frame:
            water.draw(frame)
            pictures.append(stage.read())
        water.release()
    assert np.abs(pictures[0] - pictures[1]).max() <= 1


# The mirror image in the framebuffer, with and without the stencil; with no water at all.


@pytest.mark.parametrize("stencil", [False, True])
def test_a_mirror_image_in_the_framebuffer_shows_through_the_sea(
    stage: Stage, plain: Assets, stencil: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(waves, "ROUGH", 0.0)
    changes = {"water.fresnel": True, "reflection.stencil": stencil}
    picture = mirrored_wall(stage, plain, changes)
    inside = project(POSE, (20.0, LEVEL - 0.4, 18.0))
    alpha = 0.2 * (1 - waves.CLEARED * (1 - np.sin(np.arctan2(0.9, 6.0))) ** waves.FRESNEL_POWER)
    wanted_ = alpha * np.array([0, 0, 102]) + (1 - alpha) * np.array([255, 0, 0])
    assert red(picture).sum() > 500
    assert close(pixel(picture, inside), wanted_, 4)


def test_the_stencil_keeps_the_mirror_image_inside_the_sea(stage: Stage, plain: Assets) -> None:
    """A board mirrored far beyond the end of the sea shows only without the stencil."""
    pose = Pose(20.0, 12.0, 20.0, 0.0, -10.0)
    board = np.array([(0, LEVEL, -30), (40, LEVEL, -30), (40, 5.0, -30), (0, 5.0, -30)], float)
    shown = []
    for stencil in (False, True):
        settings = small({"water.fresnel": True, "reflection.stencil": stencil})
        sea = Sea(settings, plain, beach())
        with stage.frame(settings, pose) as frame:
            with reflected(frame, settings, sea):
                gl.glColor4f(1.0, 0.0, 0.0, 1.0)
                quad(board)
            gl.glColor4f(1.0, 1.0, 1.0, 1.0)
            shown.append((stage.read() == (255, 0, 0)).all(axis=2).sum())
        sea.release()
    assert shown[0] > 500 and shown[1] == 0


@pytest.mark.parametrize("rippled", [False, True])
def test_without_water_the_mirrored_scene_is_drawn_all_over(stage: Stage, rippled: bool) -> None:
    settings = small({"reflection.stencil": True, "reflection.rippled": rippled})
    with stage.frame(settings, POSE) as frame:
        with reflected(frame, settings, None) as given:
            assert given is frame
            gl.glColor4f(1.0, 0.0, 0.0, 1.0)
            quad(np.array([(-99, -99, -9), (99, -99, -9), (99, 99, -9), (-99, 99, -9)], float))
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)
        assert (stage.read() == (255, 0, 0)).all()


def test_the_seas_stencil_mark_reaches_as_far_as_its_water(stage: Stage, plain: Assets) -> None:
    settings = small({"water.horizon": 10.0})
    sea = Sea(settings, plain, beach())
    pose = Pose(15.0, 70.6, 15.0, 0.0, -90.0)
    with stage.frame(settings, pose):
        with inside_water(sea.mark):
            gl.glColor4f(1.0, 0.0, 0.0, 1.0)
            quad(np.array([(-90.0, 3, 90), (90, 3, 90), (90, 3, -90), (-90, 3, -90)]))
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)
        marked = (stage.read() == (255, 0, 0)).all(axis=2)
    sea.release()
    left, top = project(pose, (-20.0, LEVEL, -20.0))
    right, bottom = project(pose, (50.0, LEVEL, 50.0))
    assert marked.sum() == pytest.approx((right - left) * (bottom - top), rel=0.05)


# Shallow water.


def test_the_depth_texture_is_clear_at_the_edge_and_opaque_in_deep_water_and_at_the_border() -> (
    None
):
    depths = np.tile(np.array([0.5, -0.1, 0.0, 0.085, 5.0, 0.0]), (6, 1))
    picture = depth_picture(depths)
    row = picture[2]
    assert row[1, 3] == row[2, 3] == 0 and row[4, 3] == 255
    assert row[3, 3] == pytest.approx(255 * (1 - np.exp(-1)), abs=1)
    assert (picture[0, :, 3] == 255).all() and row[5, 3] == 255
    assert row[1, 1] > row[4, 1] == 128


def test_the_seas_colour_goes_from_sand_by_green_to_blue_with_its_depth() -> None:
    depths = np.tile(np.array([5.0, -0.1, 0.0, 0.06, 0.5, 0.0]), (6, 1))
    sand, edge, green, deep = body_picture(depths, np.array([0.2, 0.4, 0.5]))[2, 1:5] / 255
    assert (sand == edge).all() and edge[3] == 0 and deep[3] == 1
    assert edge[0] > green[0] > deep[0], "red goes first"
    assert green[1] > deep[1] and green[2] > deep[2]
    assert deep[:3] == pytest.approx(np.array([0.2, 0.4, 0.5]) * DEEP, abs=0.005)
    assert (body_picture(depths, np.ones(3))[0, :, 3] == 255).all(), "beyond is the open sea"


def test_shallow_water_shows_the_bottom_and_deep_water_does_not(
    stage: Stage, plain: Assets
) -> None:
    opaque = 0.6
    common = {"water.textured": False, "water.color": (0.0, 0.0, 0.4, opaque)}
    common |= {"reflection.rippled": True, "water.shallow": True, **WHITE_LIGHT}
    settings = small(common)
    sea = Sea(settings, plain, beach(0.2))
    with stage.frame(settings, DOWN) as frame:
        with reflected(frame, settings, sea):
            pass
        gl.glColor4f(0.4, 0.6, 0.7, 1.0)
        y = LEVEL - 0.2
        quad(np.array([(0, y, 0), (40, y, 0), (40, y, 40), (0, y, 40)], float))
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)
        sea.draw(frame)
        picture = stage.read()

    sea.release()
    shallow, deep = (pixel(picture, project(DOWN, (20.0, LEVEL, z))) for z in (20.02, 23.5))

    # The texture holds the background alone: mirror image and bottom are of one colour.
    assert close(deep, opaque * np.array([0, 0, 102]) + (1 - opaque) * BACKGROUND, 6)
    assert close(deep[0], 0.4 * BACKGROUND[0], 4) and close(shallow[0], 0.76 * BACKGROUND[0], 5)


def test_a_floor_closes_the_sea_where_the_ground_is_cut(stage: Stage, plain: Assets) -> None:
    changes = {"reflection.rippled": True, "water.shallow": True}
    settings = small({**WHITE_LIGHT, **changes, "water.color": (1.0, 0.0, 0.0, 1.0)})
    sea = Sea(settings, plain, beach(0.2))
    with stage.frame(settings, DOWN) as frame:
        with reflected(frame, settings, sea):
            pass
        sea.draw(frame)
        edge = pixel(stage.read(), project(DOWN, (20.0, LEVEL, 20.01)))
    sea.release()
    assert close(edge, np.array(FLOOR) * 255, 20), "no background shows through clear water"


def test_the_ground_is_cut_deeper_only_if_the_water_is_clear_enough_to_show_it() -> None:
    for shallow, rippled, cut in (
        (False, False, LEVEL),
        (False, True, LEVEL),
        (True, False, LEVEL),
        (True, True, LEVEL - SEEN),
    ):
        changes = {"water.shallow": shallow, "reflection.rippled": rippled}
        assert cut_level(small(changes)) == cut
    at = np.full((8, 8), SEEN)
    for hidden in (depth_picture(at)[4, 4, 3], body_picture(at, np.ones(3))[4, 4, 3]):
        assert hidden >= 253, "what is cut must not show"


# Fog.


def test_the_fog_leaves_a_part_of_the_seas_colour_at_the_horizon() -> None:
    grid = grid_at(Pose(20.0, 2.0, 20.0, 0.0, -5.0))
    for power in (1, 2):
        depths = fog_depths(grid, 0.3, 0.25, power).reshape(grid.x.shape)
        clear = np.exp(-((0.3 * depths) ** power))
        assert clear.min() == pytest.approx(0.25, abs=0.02)
        near = grid.sight[:, 0] < 0.5
        assert np.allclose(depths[near], grid.sight[near], rtol=0.02)
        assert (np.diff(depths[:, 0]) <= 0).all()


def test_the_horizon_stands_out_from_the_fog_and_other_elements_keep_theirs(
    stage: Stage, plain: Assets
) -> None:
    common = {**CALM, "fog.density": 0.5, "water.color": (0.0, 0.0, 0.0, 1.0), "water.horizon": 60}
    at = project(POSE, (20.0, LEVEL, -20.0))
    shades = []
    for least in (0.0, 0.4):
        settings = small({**WHITE_LIGHT, **common, "water.horizon_contrast": least})
        sea = Sea(settings, plain, beach())
        with stage.frame(settings, POSE, fog=True) as frame:
            sea.draw(frame)
            shades.append(pixel(stage.read(), at))
            assert gl.glGetIntegerv(gl.GL_FOG_COORD_SRC) == gl.GL_FRAGMENT_DEPTH
        sea.release()
    assert close(shades[0], BACKGROUND, 2)
    assert close(shades[1], 0.6 * BACKGROUND, 8)


# State and settings.


def test_all_switches_at_once_leave_the_state_as_found_and_no_object(
    stage: Stage, plain: Assets
) -> None:
    settings = small(
        dict.fromkeys(BETTER, True)
        | {"water.glitter": 0.4, "water.ripples": 0.5}
        | {"water.horizon_contrast": 0.3, "water.foam": True}
    )
    before = live_names()
    sea = Sea(settings, plain, beach())
    for pose in (POSE, Pose(20, 4, 20, 10, -90), Pose(20, 1, 20, 0, 60)):
        with stage.frame(settings, pose, 12.0, fog=True) as frame:
            with reflected(frame, settings, sea):
                pass
            sea.draw(frame)
    sea.release()
    sea.release()
    assert live_names() == before


def test_a_sea_draws_applied_settings_as_if_built_from_them(stage: Stage, plain: Assets) -> None:
    old = {**WHITE_LIGHT, "water.glitter": 0.2}
    new = old | {"water.color": (1.0, 0.3, 0.0, 0.9), "water.relief": True, "water.fresnel": True}
    new |= {"water.repeat": 2.0, "water.glitter": 0.4, "water.horizon": 50.0}
    assert not (drawn(stage, plain, old)[0] == drawn(stage, plain, new)[0]).all()
    sea = Sea(small(old), plain, beach())
    assert taken(sea, small(new))
    with stage.frame(small(new), POSE) as frame:
        sea.draw(frame)
        picture = stage.read()
    sea.release()
    assert (picture == drawn(stage, plain, new)[0]).all()


@pytest.mark.parametrize(
    "change",
    [
        {"water.level": 0.7},
        {"water.shallow": True},
        {"water.glitter": 0.3},
        {"water.ripples": 0.5},
        {"water.foam": True},
        {"water.trilinear": False},
        {"water.lod_bias": -1.0},
    ],
    ids=lambda change: next(iter(change)),
)
@pytest.mark.sweep(3)
def test_a_sea_refuses_settings_that_need_a_rebuild_and_stays_unchanged(
    stage: Stage, plain: Assets, change: dict
) -> None:
    settings = small({**WHITE_LIGHT, "water.fresnel": True})
    sea = Sea(settings, plain, beach())
    refused = small({**WHITE_LIGHT, **change, "water.color": (1.0, 0.0, 0.0, 1.0)})
    assert not taken(sea, refused)
    with stage.frame(settings, POSE) as frame:
        sea.draw(frame)
        picture = stage.read()
    sea.release()
    assert (picture == drawn(stage, plain, {"water.fresnel": True})[0]).all()
