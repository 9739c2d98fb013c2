"""The frame: the camera in closed form, the order of drawing, what is shown, identical repeats."""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from stage import SIZE, Stage, close, project, small

from framelens.gl.seam import gl, recording
from landscape.elements.planting import PLANT
from landscape.files.assets import Assets
from landscape.frame import Frame, Pose
from landscape.geometry.obstacle_grid import ObstacleGrid
from landscape.geometry.obstacles import RADIUS
from landscape.island.island import ELEMENTS, Island
from landscape.scene.scene import Moment
from landscape.walk.walker import Intent, advance, start

POSE = Pose(21.0, 2.0, 24.0, 25.0, -5.0)
MOMENT = Moment(POSE, SIZE, 20.0, 5.0)


@pytest.fixture(scope="module")
def island(the_stage: Stage) -> Iterator[Island]:
    """The island of 2006, with few objects."""
    the_stage.enter()
    made = Island(small({"grass.count": 100_000}), Assets())
    yield made
    the_stage.enter()
    made.release()


def picture(stage: Stage, island: Island, *shown: str, moment: Moment = MOMENT) -> np.ndarray:
    """Draw with only some elements shown."""
    island.shown = set(shown)
    try:
        with stage.borrowed():
            island.draw(moment)
            return stage.read()
    finally:
        island.shown = set(ELEMENTS)


@pytest.mark.parametrize(
    ("yaw", "pitch", "forward"),
    [
        (0.0, 0.0, (0, 0, -1)),
        (90.0, 0.0, (1, 0, 0)),
        (180.0, 0.0, (0, 0, 1)),
        (0.0, 90.0, (0, 1, 0)),
        (90.0, -45.0, (math.sqrt(0.5), -math.sqrt(0.5), 0)),
    ],
)
def test_yaw_0_looks_north_90_east_and_pitch_looks_up(yaw, pitch, forward) -> None:
    assert Pose(0, 0, 0, yaw, pitch).forward == pytest.approx(forward, abs=1e-12)


@pytest.mark.parametrize("pose", [POSE, Pose(3.0, 9.0, -4.0, 200.0, 60.0)])
def test_the_cameras_matrices_put_a_point_where_the_perspective_does(
    stage: Stage, pose: Pose
) -> None:
    with stage.frame(small({"camera.fov": 50.0}), pose) as frame:
        modelview = np.array(gl.glGetDoublev(gl.GL_MODELVIEW_MATRIX)).T
        projection = np.array(gl.glGetDoublev(gl.GL_PROJECTION_MATRIX)).T
    point = np.array([pose.x, pose.y, pose.z]) + 3 * np.array(pose.forward) + (0.3, -0.2, 0.4)
    clip = projection @ modelview @ np.append(point, 1.0)
    x, y = clip[:2] / clip[3]
    wanted = project(pose, tuple(point), fov=50.0)
    assert ((x + 1) * 80, (1 - y) * 60) == pytest.approx(wanted, abs=1e-3)
    assert frame.depth(point[None])[0] == pytest.approx((modelview @ np.append(point, 1.0))[2])


def test_a_frame_knows_the_cameras_right_up_and_depth(stage: Stage) -> None:
    with stage.frame(small(), Pose(5.0, 2.0, 7.0, 30.0, 20.0)) as frame:
        pass
    yaw, pitch = math.radians(30), math.radians(20)
    assert frame.right == pytest.approx([math.cos(yaw), 0, math.sin(yaw)], abs=1e-6)
    assert np.cross(frame.right, frame.pose.forward) == pytest.approx(frame.up, abs=1e-6)
    assert frame.up[1] == pytest.approx(math.cos(pitch))
    ahead = frame.eye + 4 * np.array(frame.pose.forward)
    assert frame.depth(ahead[None])[0] == pytest.approx(-4.0, abs=1e-5)
    assert isinstance(frame, Frame) and frame.size == SIZE


def test_the_sky_beyond_everything_has_the_fogs_colour(stage: Stage, island: Island) -> None:
    assert close(picture(stage, island), np.array([0.4, 0.6, 0.7]) * 255)


def test_mirrored_scene_first_then_opaque_then_water_then_sprites_then_overlay(
    stage: Stage, island: Island
) -> None:
    with stage.borrowed(), recording() as recorder:
        island.draw(MOMENT)
    draws = [
        (call.pass_, call.element)
        for call in recorder.calls
        if call.name in ("glCallList", "glDrawElements", "glDrawArrays")
    ]
    order = [pair for k, pair in enumerate(draws) if k == 0 or pair != draws[k - 1]]
    passes = [pass_ for pass_, _ in order]
    assert passes == sorted(passes, key=("reflection", "main", "overlay").index)
    main = [element for pass_, element in order if pass_ == "main"]
    opaque = {"ground", "castle", "rabbit", "dragon", "grass", "sky"}
    assert set(main[:6]) == opaque
    assert main[6:] == ["water", "trees"]
    assert [element for pass_, element in order if pass_ == "overlay"] == ["sword", "map"]
    reflected = {element for pass_, element in order if pass_ == "reflection"}
    assert reflected == {"sky", "ground", "dragon", "trees"}


def test_the_same_moment_gives_the_same_picture(stage: Stage, island: Island) -> None:
    first = picture(stage, island, *ELEMENTS)
    other = Moment(Pose(10.0, 1.0, 30.0, 90.0), SIZE, 77.0, 9.0, 2)
    assert (picture(stage, island, *ELEMENTS, moment=other) != first).any()
    assert (picture(stage, island, *ELEMENTS) == first).all()


def test_the_same_seed_builds_the_same_island_and_another_a_different_one(stage: Stage) -> None:
    only = ("ground", "trees", "plants", "deer")
    settings = small({"trees.count": 400, "plants.count": 400, "ground.units": "none"})
    pictures = []
    for seed in (4, 4, 5):
        island = Island(settings, Assets(), seed, only)
        pictures.append(picture(stage, island, *only))
        island.release()
    assert (pictures[0] == pictures[1]).all()
    assert (pictures[0] != pictures[2]).any()


@pytest.mark.seldom(3)
@pytest.mark.parametrize("element", ["ground", "sky", "water", "grass", "sword", "map", "castle"])
def test_an_element_not_shown_is_not_drawn(stage: Stage, island: Island, element: str) -> None:
    moment = MOMENT
    if element == "castle":
        moment = Moment(Pose(island.castle.base[0], 4.0, 19.5, 0.0, -20.0), SIZE)  # type: ignore[union-attr]
    if element == "water":
        moment = Moment(Pose(5.0, 2.0, 36.0, 25.0, -30.0), SIZE)
    nothing = picture(stage, island, moment=moment)
    alone = picture(stage, island, element, moment=moment)
    assert (alone != nothing).any()
    every = picture(stage, island, *ELEMENTS, moment=moment)
    rest = picture(stage, island, *(e for e in ELEMENTS if e != element), moment=moment)
    assert (every != rest).any()


def test_an_element_never_built_cannot_be_shown(stage: Stage) -> None:
    island = Island(small(), Assets(), only=("ground",))
    island.shown = set(ELEMENTS) - {"fog"}
    with stage.borrowed():
        island.draw(MOMENT)
    assert island.elements.at("sky") is None and island.sprites is None
    island.release()


def test_kt_moves_plants_and_grass_and_leaves_the_ground_alone(
    stage: Stage, island: Island
) -> None:
    later = replace(MOMENT, kt=47.0)
    for element in ("grass", "plants"):
        moved = picture(stage, island, element) != picture(stage, island, element, moment=later)
        assert moved.any(), element
    for element in ("ground", "sky", "sword", "map"):
        same = picture(stage, island, element) == picture(stage, island, element, moment=later)
        assert same.all(), element


def test_in_wireframe_the_ground_is_lines_and_the_overlay_stays_whole(
    stage: Stage, island: Island
) -> None:
    high = Moment(Pose(20.0, 25.0, 20.0, 0.0, -90.0), SIZE, wireframe=True)
    background = np.array([0.4, 0.6, 0.7]) * 255
    lines = picture(stage, island, "ground", moment=high)
    drawn = (np.abs(lines - background) > 1).any(axis=2).mean()
    whole = picture(stage, island, "ground", moment=replace(high, wireframe=False))
    assert 0.02 < drawn < 0.9 * (np.abs(whole - background) > 1).any(axis=2).mean()
    map_ = picture(stage, island, "map", moment=high)[:30, :40]
    assert (np.abs(map_ - background) > 1).any(axis=2).mean() > 0.9


def test_the_ground_hides_what_stands_behind_it(stage: Stage, island: Island) -> None:
    castle = island.castle
    assert castle is not None
    under = Moment(Pose(castle.base[0], castle.base[1] - 0.5, 23.0, 0.0, 0.0), SIZE)
    ground_alone = picture(stage, island, "ground", moment=under)
    both = picture(stage, island, "ground", "rabbit", "castle", moment=under)
    alone = picture(stage, island, "castle", moment=under)
    background = np.array([0.4, 0.6, 0.7]) * 255
    solid = (np.abs(ground_alone - background) > 3).any(axis=2)
    hidden = solid & (np.abs(alone - background) > 3).any(axis=2)
    assert hidden.sum() > 20
    # Where the hill stands before the castle, the hill is seen.
    assert (both[hidden] == ground_alone[hidden]).all(axis=-1).mean() > 0.2


def test_settings_read_at_each_frame_may_change_between_frames(
    stage: Stage, island: Island
) -> None:
    before = island.settings
    clear = picture(stage, island, "ground", "fog")
    island.apply(small({"grass.count": 100_000, "fog.density": 0.9}))
    thick = picture(stage, island, "ground", "fog")
    island.apply(before)
    fog = np.array([0.4, 0.6, 0.7]) * 255
    assert np.abs(thick - fog).mean() < np.abs(clear - fog).mean()
    assert (picture(stage, island, "ground", "fog") == clear).all()


@pytest.mark.seldom(7, first=3)
@pytest.mark.parametrize("ornate", [False, True])
def test_with_walk_solid_trunks_deer_and_keep_stop_a_walker(stage: Stage, ornate: bool) -> None:
    stage.enter()
    values = {"castle.ornate": ornate, "grass.count": 0, "trees.count": 300}
    kinds = ("ground", "trees", "deer", "plants", "castle")
    island = Island(small(values), Assets(), 5, kinds)
    before = island.obstacles
    assert island.apply(small({**values, "walk.solid": True}))
    grid = island.obstacles
    assert isinstance(before, tuple) and isinstance(grid, ObstacleGrid)
    sprites = island.sprites.sprites
    standing = int((sprites.cells < PLANT).sum())
    assert 0.95 * standing < len(grid.towers) <= standing
    keep = [each for each in grid.few if each.top > before[0].top + 0.3]
    assert len(keep) == ornate
    x, _, z = sprites.positions[0]
    walker = start(Pose(x, None, z), island, island.settings)
    walker = advance(walker, Intent(), 0.0, island, grid, island.settings)
    assert min(each.gap(walker.x, walker.z)[0] for each in grid.near(x, z, 0.3)) > RADIUS - 1e-5
    assert island.apply(small(values))
    assert island.obstacles == before
    island.release()
