"""The voxel island's water: Fresnel's mix, what is mirrored, and how it darkens with depth."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from framelens.gl.seam import gl
from landscape.frame import Frame, Pose
from landscape.offscreen import Offscreen
from landscape.voxel.fresnel import fresnel_faces, reflectance
from landscape.voxel.water import steepened
from landscape.voxel.water_grid import (
    COLUMNS,
    ROWS,
    calmed,
    disturbed,
    half_vectors,
    refracted,
    water_grid,
)

SIZE = (128, 96)
SMALL = {"voxel.regions": 6, "voxel.region_size": 20, "shadow.enabled": False}
PLAIN = {"water.ripples": 0.0, "water.sparkle": 0.0, "fog.enabled": False, "water.resolution": 1.0}
SEA_POSE = (0.4, 1.3, 0.4, 135.0, -25.0)  # the corner of the map is sea


@contextmanager
def opened(**given: Any) -> Iterator[Offscreen]:
    settings = SMALL | PLAIN | {key.replace("__", "."): value for key, value in given.items()}
    only = ("land", "sky", "water")
    with Offscreen(SIZE, samples=0, place="voxel", settings=settings, only=only) as view:
        view.look(SEA_POSE)
        yield view


def rays(view: Offscreen) -> np.ndarray:
    """Return the line of sight (h, w, 3) through each pixel of the picture, top row first."""
    pose, (width, height) = view.moment.pose, SIZE
    assert pose.y is not None
    top = np.tan(np.radians(view.scene.settings.camera.fov) / 2)
    x = ((np.arange(width) + 0.5) / width * 2 - 1) * top * width / height
    y = (1 - (np.arange(height) + 0.5) / height * 2) * top
    yaw, pitch = np.radians(pose.yaw), np.radians(pose.pitch)
    ahead = np.array([np.sin(yaw) * np.cos(pitch), np.sin(pitch), -np.cos(yaw) * np.cos(pitch)])
    right = np.array([np.cos(yaw), 0.0, np.sin(yaw)])
    up = np.cross(right, ahead)
    return ahead + x[None, :, None] * right + y[:, None, None] * up


def test_water_mirrors_little_from_above_and_all_at_a_grazing_angle() -> None:
    assert reflectance(np.array([1.0, 0.5, 0.0])) == pytest.approx([0.02, 0.050625, 1.0])
    faces = fresnel_faces(1.0)
    down = faces[3]  # negative y, where one looks straight down
    assert down[64, 64, 0] == 5 and faces[0][64, 64, 0] > 230  # 0.02 of 255


def fill(images: Any, name: str, colour: tuple[float, float, float]) -> Any:
    """Return what draws one of the pictures as a plain colour."""

    def drawn(viewport: tuple[int, int], *_: Any) -> None:
        target = images._target(getattr(images, name), viewport)
        setattr(images, name, target)
        gl.glClearColor(*colour, 1.0)
        with target.drawing():
            pass

    return drawn


@pytest.mark.seldom(5, first=3)
def test_reflection_and_refraction_are_mixed_by_fresnels_term_at_every_pixel() -> None:
    mirrored, under = (0.9, 0.3, 0.1), (0.05, 0.4, 0.8)
    with opened() as view:
        images = view.scene.water.images
        images.draw_reflection = fill(images, "reflection", mirrored)
        images.draw_refraction = fill(images, "refraction", under)
        view.scene.shown = {"water"}
        picture = view.draw().astype(float)
        sight = rays(view)
    down = -sight[..., 1] / np.linalg.norm(sight, axis=-1)
    water = down > 0.08  # well below the horizon
    assert water.mean() > 0.6
    part = reflectance(down)[..., None]
    expected = 255 * (part * np.array(mirrored) + (1 - part) * np.array(under))
    assert np.abs(picture - expected)[water].max() <= 2.0


@pytest.mark.seldom(3)
def test_the_water_mirrors_what_a_mirrored_camera_sees() -> None:
    with opened() as view:
        view.look((4.8, 0.95, 9.3, 0.0, -2.0))
        water = view.scene.water
        water._fresnel.release()
        water._fresnel = cube_of(255)  # all of it mirrors
        picture = view.draw().astype(float)
        with view._current():
            image = read_target(water.images.reflection)
        water.images.draw_reflection = fill(water.images, "reflection", (1.0, 0.0, 1.0))
        surface = (view.draw() == (255, 0, 255)).all(axis=-1)
    assert 0.2 < surface.mean() < 0.8
    assert len(np.unique(image[surface], axis=0)) > 50  # land, not only sky
    near = np.abs(picture - image).max(axis=-1) <= 2.0
    assert near[surface].mean() > 0.99


def cube_of(value: int) -> Any:
    from landscape.gl.cube_map import CubeMap

    return CubeMap(np.full((6, 4, 4, 1), value, np.uint8), mipmaps=False)


def read_target(target: Any) -> np.ndarray:
    """Return the colours of a texture target (h, w, 3), top row first."""
    width, height = target.size
    with target.drawing(clear=False):
        data = gl.glReadPixels(0, 0, width, height, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)
    return np.frombuffer(data, np.uint8).reshape(height, width, 3)[::-1].astype(float)


@pytest.mark.seldom(5, first=3)
def test_the_ground_darkens_with_its_depth_as_the_linear_fog_says() -> None:
    colours = {}
    for clear in (1e3, 6.0):
        with opened(water__clear=clear, water__color=(0.0, 0.0, 0.0)) as view:
            view.look((4.8, 2.5, 9.3, 0.0, -80.0))
            view.draw()
            with view._current():
                colours[clear] = read_target(view.scene.water.images.refraction)
            world, level = view.scene.land.world, view.scene.water.level
    bright, dark = colours[1e3], colours[6.0]
    lit = bright.min(axis=-1) > 60
    ratio = (dark / np.maximum(bright, 1.0))[lit].mean(axis=-1)
    depths = level / world.block - np.unique(world.ground[world.ground < world.sea])
    expected = np.clip(1 - depths / 6.0, 0.0, 1.0) / (1 - depths / 1e3)
    # Tops of the ground lie at whole blocks: their brightness takes one of a few values.
    nearest = np.abs(ratio[:, None] - np.array([*expected, 1.0])).min(axis=1)
    assert (nearest < 0.02).mean() > 0.6
    assert ratio.min() < 0.5 < 0.9 < ratio.max()


def test_walters_model_bends_lines_of_sight_by_snells_law() -> None:
    rng = np.random.default_rng(2)
    count = ROWS * COLUMNS
    points = np.zeros((count, 3), np.float32)
    ways = rng.uniform(-1, 1, (count, 3)).astype(np.float32)
    ways[:, 1] = -np.abs(ways[:, 1]) - 0.3
    away = np.linalg.norm(ways, axis=1)
    depth = np.full(count, 0.5, np.float32)
    met = refracted(points, ways, away, depth, 0.0, strength=0.0)
    assert met[:, 1] == pytest.approx(-0.5, abs=1e-5)
    sine_above = np.hypot(ways[:, 0], ways[:, 2]) / away
    sine_below = np.hypot(met[:, 0], met[:, 2]) / np.linalg.norm(met, axis=1)
    assert sine_above == pytest.approx(1.33 * sine_below, abs=1e-5)
    rippled = refracted(points, ways, away, depth, 0.0, strength=3.0)
    assert np.abs(rippled - met).max() > 0.01
    assert (refracted(points, ways, away, -depth, 0.0, 1.0) == points).all()  # on land


@pytest.mark.seldom(10, first=1)
def test_from_straight_above_both_refractions_show_the_same() -> None:
    pictures = []
    for bending in ("flat", "walter"):
        with opened(water__bending=bending, water__fresnel=0.0) as view:
            view.look((4.8, 2.2, 9.0, 0.0, -88.0))
            pictures.append(view.draw()[36:60, 48:80].astype(float))
    assert np.abs(pictures[0] - pictures[1]).mean() < 12.0


def some_frame(pose: Pose) -> Frame:
    yaw, pitch = np.radians(pose.yaw), np.radians(pose.pitch)
    turn_y = np.array([[np.cos(yaw), 0, np.sin(yaw)], [0, 1, 0], [-np.sin(yaw), 0, np.cos(yaw)]])
    turn_x = np.array(
        [[1, 0, 0], [0, np.cos(pitch), np.sin(pitch)], [0, -np.sin(pitch), np.cos(pitch)]]
    )
    view = np.eye(4)
    view[:3, :3] = turn_x @ turn_y
    view[:3, 3] = -view[:3, :3] @ (pose.x, pose.y, pose.z)
    return Frame(pose, SIZE, 0.0, view.T.ravel(), 60.0)


def test_the_grid_covers_the_water_on_the_screen_and_lies_in_its_plane() -> None:
    for pitch in (0.0, -12.0, -40.0, -89.0):
        frame = some_frame(Pose(3.0, 1.5, 4.0, 33.0, pitch))
        points = water_grid(frame, 0.7, 80.0)
        assert points is not None
        assert points[:, 1] == pytest.approx(0.7)
        away = points.reshape(ROWS, COLUMNS, 3) - frame.eye
        depth = -away @ frame.back
        assert (depth > 0).all()
        top = np.tan(np.radians(30.0))
        rise = (away @ frame.up) / depth / top
        assert rise[-1].max() < -1.0  # the nearest row is below the screen
        horizon = -frame.back[1] / frame.up[1] / top if pitch else 0.0
        assert rise[0].max() == pytest.approx(min(max(-horizon, -1), 1.04), abs=0.05) or pitch < -30


def test_there_is_no_water_where_one_looks_up() -> None:
    assert water_grid(some_frame(Pose(3.0, 1.5, 4.0, 33.0, 50.0)), 0.7, 80.0) is None


def test_ripples_move_points_within_the_plane_and_not_at_all_without_strength() -> None:
    points, away, deep = some_water()
    assert disturbed(points, away, deep, 12.0, 0.0) == pytest.approx(points)
    moved = disturbed(points, away, deep, 12.0, 1.0)
    assert moved[:, 1] == pytest.approx(0.7) and not np.allclose(moved, points)


def test_ripples_move_less_what_is_near_or_shallow_and_nothing_at_the_screens_edges() -> None:
    points, away, deep = some_water()

    def way(away: np.ndarray, depth: np.ndarray) -> np.ndarray:
        return np.linalg.norm(disturbed(points, away, depth, 12.0, 1.0) - points, axis=-1)

    far, shallow = way(away, deep), way(away, deep / 50)
    assert (shallow <= far + 1e-6).all() and shallow.max() < 0.2 * far.max()
    assert way(away, -deep) == pytest.approx(0.0)  # on land
    assert way(away / 40, deep).max() < 0.5 * far.max()
    far = far.reshape(ROWS, COLUMNS)
    assert far[-1] == pytest.approx(0.0) and far[:, [0, -1]] == pytest.approx(0.0)


def test_glints_are_dimmer_in_shallow_water_and_close_by() -> None:
    points, away, deep = some_water()
    half = np.tile((0.0, 1.0, 0.0), (len(points), 1))
    assert calmed(half, away, deep)[:, 1].max() == pytest.approx(1.0)
    assert (calmed(half, away, 0.0 * deep)[:, 1] < 0.96).all()
    assert (calmed(half, 0.01 * away, deep)[:, 1] < 0.97).all()


def test_normals_made_steeper_are_of_unit_length_and_of_steeper_slopes() -> None:
    slope = np.array([0.3, -0.2, 1.0]) / np.linalg.norm((0.3, -0.2, 1.0))
    coded = np.rint((slope[None, None] + 1.0) * 127.5).astype(np.uint8)
    steep = steepened(coded, 2.0)[0, 0] / 127.5 - 1.0
    assert np.linalg.norm(steep) == pytest.approx(1.0, abs=0.01)
    assert steep[:2] / steep[2] == pytest.approx((0.6, -0.4), abs=0.03)


def some_water() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    points = np.random.default_rng(0).uniform(0, 40, (ROWS * COLUMNS, 3)).astype(np.float32)
    points[:, 1] = 0.7
    away = np.linalg.norm(points - (20.0, 3.0, 20.0), axis=-1).astype(np.float32)
    return points, away, np.full(len(points), 2.0, np.float32)


def test_a_half_vector_is_the_normal_where_the_water_mirrors_the_sun() -> None:
    sun = np.array([0.6, 0.8, 0.0])
    eye = np.array([-3.0, 4.0, 0.0])  # the sun's image in level water at the origin
    found = half_vectors(-eye[None], np.array([5.0]), sun)
    assert found == pytest.approx(np.array([[0.0, 1.0, 0.0]]))


def test_no_picture_of_the_water_is_drawn_where_none_is_in_view() -> None:
    with opened() as view:
        view.look((4.8, 1.5, 4.8, 0.0, 60.0))
        calls: list[str] = []
        images = view.scene.water.images
        images.draw_reflection = lambda *_: calls.append("reflection")
        view.draw()
        assert calls == []


@pytest.mark.seldom(3)
def test_a_window_of_another_size_gets_pictures_of_another_size() -> None:
    with opened(water__resolution=0.5) as view:
        view.draw()
        images = view.scene.water.images
        assert images.reflection.size == (64, 48)
        view.moment = replace(view.moment, size=(64, 64))
        view.draw()
        assert images.reflection.size == (32, 32)
