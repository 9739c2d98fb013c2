"""The water's fixes: ripples, relief, foam, depth, glints, culling; each shows when it is on."""

import numpy as np
import pytest
from stage import SIZE, WHITE_LIGHT, Stage, close, pixel, project, quad, small

from landscape.elements.reflection import MirrorImage, mirrored, reflected, widened
from landscape.elements.sea import foam, glitter, waves
from landscape.elements.sea.sea import BOTTOM, bed_picture
from landscape.elements.water_surface import WaterSurface
from landscape.files.assets import Assets
from landscape.frame import Frame, Pose
from landscape.geometry.height_field import HeightField
from landscape.gl.calls import gl, recording
from landscape.keys import get
from landscape.settings import Settings, preset

LEVEL = 0.6
POSE = Pose(20.0, 1.1, 24.0, 0.0, -12.0)
FIXES = ("reflection.rippled", "water.relief", "water.shallow", "water.foam", "water.cull")


def beach(slope: float = 0.1, edge: float = 20.0) -> HeightField:
    """A shore that runs along x: land north of z = ``edge``, deeper and deeper south of it."""
    z = np.arange(81) * 0.5
    rows = LEVEL + slope * (edge - z)
    return HeightField(np.repeat(rows[:, None], 81, axis=1).astype(np.float32), 40.0, LEVEL)


def frame_at(pose: Pose = POSE, fov: float = 60.0) -> Frame:
    return Frame(pose, SIZE, 0.0, np.eye(4).ravel(), fov)


def the_grid(pose: Pose = POSE) -> waves.EyeGrid:
    grid = waves.eye_grid(frame_at(pose), LEVEL, 60.0)
    assert grid is not None
    return grid


def test_the_cures_are_off_in_2006_and_on_in_best() -> None:
    for key in FIXES:
        assert get(Settings(), key) is False and get(preset("best"), key) is True, key


# The grid before the eye.


@pytest.mark.parametrize(
    "pose",
    [
        POSE,
        Pose(20, 0.7, 20, 77, 3),
        Pose(20, 9, 20, 200, -50),
        Pose(20, 5, 20, 0, -89),
        Pose(3, 1, 9, 340, -28),
    ],
)
def test_the_eyes_grid_reaches_every_window_corner_that_sees_water(pose: Pose) -> None:
    grid = the_grid(pose)
    # Rays through the window's border, from the definition of the perspective.
    yaw, pitch = np.radians(pose.yaw), np.radians(pose.pitch)
    right = np.array([np.cos(yaw), 0, np.sin(yaw)])
    ahead = np.array(pose.forward)
    up = np.array([-np.sin(pitch) * np.sin(yaw), np.cos(pitch), np.sin(pitch) * np.cos(yaw)])
    half = np.tan(np.radians(30))
    heading = np.unwrap(np.arctan2(grid.east, -grid.south))
    for a in np.linspace(-1, 1, 9):
        for b in np.linspace(-1, 1, 9):
            ray = ahead + a * half * SIZE[0] / SIZE[1] * right + b * half * up
            if ray[1] >= -1e-3:
                continue
            ring = (pose.y - LEVEL) / -ray[1] * np.hypot(ray[0], ray[2])
            assert grid.ring.min() <= max(ring, 0.02)
            assert ring <= grid.ring.max() or ring > 59
            turns = (np.arctan2(ray[0], -ray[2]) - heading[0]) % (2 * np.pi)
            assert ring < 0.02 or turns <= heading[-1] - heading[0] + 1e-5


def test_the_grid_is_nothing_where_only_sky_is_seen() -> None:
    assert waves.eye_grid(frame_at(Pose(20, 1, 20, 0, 45)), LEVEL, 60.0) is None


def test_the_grids_lines_stay_where_they_are_when_the_viewer_turns() -> None:
    first, second = the_grid(Pose(20, 1, 20, 10, -5)), the_grid(Pose(20, 1, 20, 14.3, -5))
    directions = np.stack([first.east, first.south], axis=1)
    turned = np.stack([second.east, second.south], axis=1)
    shared = [np.abs(turned - d).max(axis=1).min() < 1e-5 for d in directions[20:-5]]
    assert all(shared)


def test_the_grid_is_sent_far_to_near_and_kept_inside_the_water() -> None:
    grid = the_grid()
    assert (np.diff(grid.ring) <= 0).all()
    grid.keep_within(15.0, 30.0)
    assert grid.x.min() >= 15 and grid.x.max() <= 30 and grid.z.min() >= 15 and grid.z.max() <= 30


# Waves.


def test_slopes_are_the_derivatives_of_the_height(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(waves, "LIFTING", len(waves.WAVES))
    step = 1e-3
    x, z = np.meshgrid(np.linspace(3, 4, 40), np.linspace(8, 9, 40))
    cell = np.zeros(40)

    def height(dx: float, dz: float) -> np.ndarray:
        return waves.waves((x + dx).astype(np.float32), (z + dz).astype(np.float32), cell, 1.7)[0]

    _, slope_x, slope_z = waves.waves(x.astype(np.float32), z.astype(np.float32), cell, 1.7)
    by_x = (height(step, 0) - height(-step, 0)) / (2 * step)
    by_z = (height(0, step) - height(0, -step)) / (2 * step)
    assert np.abs(by_x - slope_x).max() < 0.01 and np.abs(by_z - slope_z).max() < 0.01
    assert slope_x.std() > 0.01 and slope_z.std() > 0.01


def test_normals_stand_at_right_angles_to_the_slopes() -> None:
    slope_x, slope_z = np.array([[0.3, -0.1]], np.float32), np.array([[0.2, 0.0]], np.float32)
    normals = waves.surface_normals(slope_x, slope_z)
    assert np.allclose(np.linalg.norm(normals, axis=1), 1.0)
    assert normals[0] @ (1, 0.3, 0) == pytest.approx(0, abs=1e-6)
    assert normals[0] @ (0, 0.2, 1) == pytest.approx(0, abs=1e-6)


def test_far_water_is_calmer_and_a_wave_is_about_a_hundredth_high() -> None:
    grid = the_grid(Pose(20, 1.1, 30, 0, -12))
    lift, slope_x, slope_z = waves.waves(grid.x, grid.z, grid.cell, 0.4)
    steep = np.hypot(slope_x, slope_z)
    assert steep[grid.ring > 30].max() < 0.2 * steep[grid.ring < 2].max()
    assert 0.004 < np.abs(lift).max() < 0.03


def test_flat_water_looks_up_its_own_place_and_a_tilt_moves_it_by_twice_the_angle() -> None:
    grid = the_grid(Pose(20, 1.6, 30, 0, -20))
    flat, y = np.zeros(grid.x.shape, np.float32), np.full(grid.x.shape, LEVEL, np.float32)
    own = np.stack([grid.x.ravel(), y.ravel(), grid.z.ravel()], axis=1)
    assert np.allclose(waves.mirror_places(grid, y, flat, flat), own, atol=1e-5)
    # All facets lean to the viewer, who looks north: height grows with -z in the middle column.
    lean = waves.mirror_places(grid, y, flat, flat - 0.01).reshape(*grid.x.shape, 3)
    column = int(np.argmin(np.abs(grid.east)))
    near = grid.ring < 5
    away = np.hypot(grid.ring, grid.height)[near]
    sunk = lean[near, column, 1] - LEVEL
    assert np.allclose(sunk / away, -2 * waves.MIRRORED * 0.01, rtol=0.01)
    # Facets that lean to the west: the image moves west, as far as the height of the eye allows.
    lean = waves.mirror_places(grid, y, flat + 0.01, flat).reshape(*grid.x.shape, 3)
    aside = (lean[..., 0] - grid.x)[near, column]
    assert np.allclose(aside, -2 * waves.MIRRORED * 0.01 * grid.height, rtol=0.02)


def test_a_facet_that_leans_to_the_viewer_mirrors_less() -> None:
    grid = the_grid()
    flat = np.zeros(grid.x.shape, np.float32)
    away = np.hypot(grid.ring, grid.height)
    assert np.allclose(waves.facing(grid, flat, flat)[:, 3], grid.height / away, atol=1e-4)
    leaning = waves.facing(grid, 0.05 * np.broadcast_to(grid.east, flat.shape), 0.05 * grid.south)
    assert (leaning >= waves.facing(grid, flat, flat)).all()


# The mirror image as a texture.


def mirror_picture(stage: Stage, assets: Assets, changes, kt: float = 0.0) -> np.ndarray:
    """Return the picture of the water under a red wall's mirror image, the wall itself not."""
    common = {**WHITE_LIGHT, "water.textured": False, "water.color": (0.0, 0.0, 0.4, 0.2)}
    settings = small({**common, **changes})
    water = WaterSurface(settings, assets, beach(edge=-30.0))
    wall = np.array([(16, LEVEL, 18), (24, LEVEL, 18), (24, 1.4, 18), (16, 1.4, 18)], float)
    with stage.frame(settings, POSE, kt) as frame:
        with reflected(frame, settings, water), mirrored(settings):
            gl.glColor4f(1.0, 0.0, 0.0, 1.0)
            quad(wall)
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)
        water.draw(frame)
        picture = stage.read()
    water.release()
    water.release()
    return picture


def red(picture: np.ndarray) -> np.ndarray:
    return picture[..., 0] > 150


def test_the_reflections_edge_moves_with_kt_only_when_rippled(stage: Stage, plain: Assets) -> None:
    straight, rippled = {"water.animated": True}, {"reflection.rippled": True}
    still = [red(mirror_picture(stage, plain, straight, kt)) for kt in (0, 40)]
    moving = [red(mirror_picture(stage, plain, rippled, kt)) for kt in (0, 40)]
    assert still[0].sum() > 500 and moving[0].sum() > 500
    assert (still[0] == still[1]).all()
    assert (moving[0] != moving[1]).sum() > 50


def test_without_waves_the_texture_lies_where_the_mirrored_scene_would(
    stage: Stage, plain: Assets, monkeypatch: pytest.MonkeyPatch
) -> None:
    flat = mirror_picture(stage, plain, {})
    monkeypatch.setattr(waves, "STEEP", 0.0 * waves.STEEP)
    textured = mirror_picture(stage, plain, {"reflection.rippled": True})
    assert (red(flat) != red(textured)).mean() < 0.01
    inside = project(POSE, (20.0, LEVEL - 0.4, 18.0))
    assert close(pixel(flat, inside), pixel(textured, inside), 3)


def test_the_ripples_leave_no_hole_at_the_windows_borders(stage: Stage, plain: Assets) -> None:
    changes = {"reflection.rippled": True, "water.color": (0.0, 0.0, 1.0, 0.5)}
    for kt in (0, 33):
        picture = mirror_picture(stage, plain, changes, kt)
        below = picture[int(project(POSE, (20, LEVEL, 8))[1]) + 2 :]
        assert (below[..., 2] >= 120).all(), "every pixel of water has half of the water's blue"


def test_the_mirror_texture_draws_beside_any_framebuffer_and_is_taken_once(stage: Stage) -> None:
    image = MirrorImage()
    settings = small({})
    with stage.frame(settings, POSE) as frame:
        assert image.take() is None
        with image.drawing(frame) as smaller:
            assert smaller.size == (80, 60) and smaller.fov > frame.fov
            gl.glColor4f(1.0, 0.0, 0.0, 1.0)
            quad(np.array([(-99, -99, -9), (99, -99, -9), (99, 99, -9), (-99, 99, -9)], float))
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)
        assert (stage.read() == stage.read()[0, 0]).all(), "nothing fell into the framebuffer"
        taken = image.take()
        assert taken is not None and image.take() is None
        taken[0].bind()
        for name in (gl.GL_TEXTURE_WRAP_S, gl.GL_TEXTURE_WRAP_T):
            wrap = gl.glGetTexParameteriv(gl.GL_TEXTURE_2D, name)
            assert int(np.ravel(wrap)[0]) == gl.GL_CLAMP_TO_EDGE
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
    image.release()
    image.release()


def test_the_mirror_reaches_beyond_the_window_by_its_margin() -> None:
    projection = np.array([(1.5, 0, 0, 0), (0, 2, 0, 0), (0, 0, -1, -0.04), (0, 0, -1, 0)])
    corner = np.array([2.0 / 1.5, 1.0, -2.0, 1.0])
    x, y, _, w = widened(projection, 1.25) @ corner
    assert (x / w, y / w) == pytest.approx((0.8, 0.8))


# Relief, depth, foam, glints.


def drawn(stage: Stage, assets: Assets, changes, pose: Pose = POSE, kt: float = 0.0, field=None):
    settings = small({**WHITE_LIGHT, **changes})
    water = WaterSurface(settings, assets, beach() if field is None else field)
    with stage.frame(settings, pose, kt) as frame:
        with recording() as recorder:
            water.draw(frame)
        picture = stage.read()
    water.release()
    return picture, recorder.calls


def sent(calls, name: str) -> list:
    return [call.args[-1] for call in calls if call.name == name]


def test_relief_moves_the_vertices_about_the_level_and_dies_down_at_the_beach(
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


def test_the_relief_shows_as_it_moves(stage: Stage, plain: Assets) -> None:
    changes = {"water.relief": True, "water.textured": False, "water.fresnel": True}
    first, second = (drawn(stage, plain, changes, kt=kt)[0] for kt in (0.0, 30.0))
    assert (first != second).any()
    still = changes | {"water.animated": False}
    assert (drawn(stage, plain, still)[0] == drawn(stage, plain, still, kt=30.0)[0]).all()


def test_the_depths_picture_is_clear_at_the_edge_and_opaque_in_the_deep_and_at_the_border() -> None:
    depths = np.tile(np.array([0.5, -0.1, 0.0, 0.085, 5.0, 0.0]), (6, 1))
    picture = bed_picture(depths)
    row = picture[2]
    assert row[1, 3] == row[2, 3] == 0 and row[4, 3] == 255
    assert row[3, 3] == pytest.approx(255 * (1 - np.exp(-1)), abs=1)
    assert (picture[0, :, 3] == 255).all() and row[5, 3] == 255
    assert row[1, 1] > row[4, 1] == 128


def test_shallow_water_shows_the_bottom_and_deep_water_does_not(
    stage: Stage, plain: Assets
) -> None:
    opaque = 0.6
    common = {"water.textured": False, "water.color": (0.0, 0.0, 0.4, opaque)}
    common |= {"reflection.rippled": True, "water.shallow": True, **WHITE_LIGHT}
    settings = small(common)
    down = Pose(20.0, 5.6, 21.5, 0.0, -89.9)
    water = WaterSurface(settings, plain, beach(0.2))
    with stage.frame(settings, down) as frame:
        with reflected(frame, settings, water):
            pass
        gl.glColor4f(0.4, 0.6, 0.7, 1.0)
        y = LEVEL - 0.2
        quad(np.array([(0, y, 0), (40, y, 0), (40, y, 40), (0, y, 40)], float))
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)
        water.draw(frame)
        picture = stage.read()
    water.release()
    background = np.array([0.4, 0.6, 0.7]) * 255
    shallow, deep = (pixel(picture, project(down, (20.0, LEVEL, z))) for z in (20.02, 23.5))
    # The texture holds the background alone: mirror image and bottom are of one colour.
    assert close(deep, opaque * np.array([0, 0, 102]) + (1 - opaque) * background, 6)
    assert close(deep[0], 0.4 * background[0], 4) and close(shallow[0], 0.76 * background[0], 5)


def test_a_bottom_closes_the_sea_where_the_ground_is_cut(stage: Stage, plain: Assets) -> None:
    changes = {"reflection.rippled": True, "water.shallow": True}
    down = Pose(20.0, 5.6, 21.5, 0.0, -89.9)
    settings = small({**WHITE_LIGHT, **changes, "water.color": (1.0, 0.0, 0.0, 1.0)})
    water = WaterSurface(settings, plain, beach(0.2))
    with stage.frame(settings, down) as frame:
        with reflected(frame, settings, water):
            pass
        water.draw(frame)
        edge = pixel(stage.read(), project(down, (20.0, LEVEL, 20.01)))
    water.release()
    assert close(edge, np.array(BOTTOM) * 255, 20), "no background shows through clear water"


def test_the_ground_is_cut_deeper_only_where_the_water_lets_one_see_it() -> None:
    for shallow, rippled, cut in (
        (False, False, LEVEL),
        (False, True, LEVEL),
        (True, False, LEVEL),
        (True, True, LEVEL - waves.SEEN),
    ):
        changes = {"water.shallow": shallow, "reflection.rippled": rippled}
        assert waves.cut_level(small(changes)) == cut
    hidden = bed_picture(np.full((8, 8), waves.SEEN))[4, 4, 3]
    assert hidden >= 253, "what is cut must not show"


def test_foam_lies_between_the_beach_and_its_depth_and_moves(stage: Stage, plain: Assets) -> None:
    changes = {"water.textured": False, "water.color": (0.0, 0.0, 0.0, 1.0), "water.foam": True}
    down = Pose(20.0, 3.6, 20.5, 0.0, -89.9)
    first, second = (drawn(stage, plain, changes, down, kt)[0] for kt in (0.0, 40.0))
    without = drawn(stage, plain, changes | {"water.foam": False}, down)[0]
    white = first.min(axis=2) > 100
    rows = np.flatnonzero(white.any(axis=1))
    north = project(down, (20, LEVEL, 20.0 - 10 * foam.LAND))[1]
    south = project(down, (20, LEVEL, 20.0 + 10 * foam.DEEP))[1]
    assert white.sum() > 100 and without.max() < 60
    assert north - 2 <= rows.min() and rows.max() <= south + 2
    assert ((second.min(axis=2) > 100) != white).sum() > 50


def test_breakers_are_periodic_and_end_at_both_sides() -> None:
    picture = foam.breakers(64, 100)
    assert picture.min() >= 0 and picture.max() <= 1
    assert picture[0].max() == 0 and picture[-1].max() == 0
    steps = np.abs(np.diff(picture, axis=1)).max()
    assert np.abs(picture[:, 0] - picture[:, -1]).max() <= steps + 1e-9


def test_the_shore_is_the_grid_near_the_waters_edge_and_never_under_it() -> None:
    places, moments, _, triangles = foam.shore(beach())
    assert triangles.max() == len(places) - 1
    assert places[:, 1].min() >= LEVEL - 1e-6 and places[:, 1].max() <= LEVEL + foam.LAND + 1e-6
    assert places[:, 2].min() >= 19 and places[:, 2].max() <= 22
    at_edge = np.abs(places[:, 2] - 20.0) < 1e-6
    assert np.allclose(moments[at_edge, 1], foam.LAND / (foam.LAND + foam.DEEP), atol=1e-4)


def test_the_glints_stand_where_the_sun_is_mirrored() -> None:
    pose = Pose(20.0, 1.6, 30.0, 0.0, -38.0)
    grid = the_grid(pose)
    low = np.radians(40.0)
    towards = np.array([0.0, np.sin(low), -np.cos(low)])
    flat = np.zeros(grid.x.shape, np.float32)
    share = glitter.sun_share(grid, flat, flat, towards)
    row, column = np.unravel_index(int(share.argmax()), share.shape)
    assert share.max() == pytest.approx(1.0, abs=0.01)
    assert grid.x[row, column] == pytest.approx(20.0, abs=0.03)
    assert 30.0 - grid.z[row, column] == pytest.approx(1.0 / np.tan(low), abs=0.03)


def test_only_the_cells_that_may_glint_are_sent() -> None:
    share = np.zeros((6, 5))
    share[3, 2] = 1.0
    part = glitter.bright_part(waves.triangles_of(5, 6), share)
    assert part.shape == (8, 3) and 17 in part
    assert len(glitter.bright_part(waves.triangles_of(5, 6), 0 * share)) == 0
    assert len(glitter.bright_part(waves.triangles_of(5, 6), 0 * share + 1)) == 40


def test_glints_on_the_sea_add_light_and_never_take_any(stage: Stage, plain: Assets) -> None:
    changes = {"water.relief": True, "sun.elevation": 45.0, "sun.azimuth": 0.0}
    changes |= {"water.textured": False, "sun.diffuse": (1.0, 0.9, 0.8)}
    towards = Pose(20.0, 1.6, 30.0, 0.0, -45.0)
    deep = beach(edge=-30.0)
    dull = drawn(stage, plain, changes | {"water.glitter": 0.0}, towards, field=deep)[0]
    bright = drawn(stage, plain, changes | {"water.glitter": 0.5}, towards, field=deep)[0]
    more = bright - dull
    assert more.min() >= 0 and more.max() > 20
    changes |= {"water.color": (1.0, 1.0, 1.0, 1.0), "water.glitter": 0.5}
    assert drawn(stage, plain, changes, towards, field=deep)[0].min() == 255


@pytest.mark.parametrize("fresnel", [False, True])
@pytest.mark.parametrize("pose", [POSE, Pose(20, 3, 20, 130, -60), Pose(-5, 1, -5, 45, 0)])
def test_culled_patches_change_no_pixel_and_are_not_sent(
    stage: Stage, plain: Assets, pose: Pose, fresnel: bool
) -> None:
    changes = {"water.fresnel": fresnel}
    every, calls = drawn(stage, plain, changes, pose)
    some, fewer = drawn(stage, plain, changes | {"water.cull": True}, pose)
    assert (every == some).all()
    assert len(sent(calls, "glDrawElements")) == 25
    assert 0 < len(sent(fewer, "glDrawElements")) < 25


def test_everything_at_once_leaves_the_state_as_it_was(stage: Stage, plain: Assets) -> None:
    settings = small(dict.fromkeys(FIXES, True) | {"water.glitter": 0.4, "water.fresnel": True})
    water = WaterSurface(settings, plain, beach())
    for pose in (POSE, Pose(20, 4, 20, 10, -90), Pose(20, 1, 20, 0, 60)):
        with stage.frame(settings, pose, 12.0, fog=True) as frame:
            with reflected(frame, settings, water):
                pass
            water.draw(frame)
    water.release()
    water.release()
