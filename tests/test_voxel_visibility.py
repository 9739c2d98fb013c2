"""Boxes against the view frustum: two ways that agree, and culling that loses no pixel."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from framelens.gl.seam import gl
from framelens.gl.state import attrib, matrix
from landscape.frame import Pose
from landscape.offscreen import Offscreen
from landscape.voxel.horizon import CLEAR
from landscape.voxel.land import DISTANT, Choice, Land
from landscape.voxel.mesh import PLANTS
from landscape.voxel.visibility import (
    TESTS,
    distances,
    facing,
    frustum_box,
    frustum_planes,
    meets_frustum_box,
    visible_both_ways,
    visible_in_world,
    visible_projected,
)
from landscape.voxel.voxel import LEAST_PIXELS, MOST_PIXELS, SCENE, Voxel

SIZE = (96, 72)


def perspective(rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Return the projection times modelview (4, 4) of a random camera, and its eye."""
    near, far = 0.1, 60.0
    top, side = near * rng.uniform(0.2, 1.2), near * rng.uniform(0.2, 1.6)
    projection = np.zeros((4, 4))
    projection[0, 0], projection[1, 1] = near / side, near / top
    projection[2, 2:] = -(far + near) / (far - near), -2 * far * near / (far - near)
    projection[3, 2] = -1.0
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    eye = rng.uniform(-10, 50, 3)
    view = np.eye(4)
    view[:3, :3], view[:3, 3] = turn, -turn @ eye
    return projection @ view, eye


def boxes(rng: np.random.Generator, count: int = 200) -> tuple[np.ndarray, np.ndarray]:
    low = rng.uniform(-10, 50, (count, 3))
    return low, low + rng.uniform(0.01, 6.0, (count, 3))


def test_both_ways_agree_on_random_boxes_and_cameras() -> None:
    rng = np.random.default_rng(1)
    seen = 0
    for _ in range(200):
        clip, _ = perspective(rng)
        low, high = boxes(rng)
        world, projected = visible_in_world(low, high, clip), visible_projected(low, high, clip)
        assert (world == projected).all()
        seen += int(world.sum())
    assert 1000 < seen < 39000


def test_a_box_with_a_point_in_the_frustum_is_visible() -> None:
    rng = np.random.default_rng(2)
    for _ in range(100):
        clip, _ = perspective(rng)
        low, high = boxes(rng)
        inside = rng.uniform(0, 1, low.shape) * (high - low) + low
        x, y, z, w = (np.c_[inside, np.ones(len(inside))] @ clip.T).T
        within = (np.abs([x, y, z]) <= w).all(axis=0)
        assert visible_in_world(low, high, clip)[within].all()


def test_each_direction_of_the_two_way_test_finds_hidden_boxes_that_the_other_misses() -> None:
    rng = np.random.default_rng(4)
    only_projected = only_boxes = 0
    for _ in range(200):
        clip, _ = perspective(rng)
        low, high = boxes(rng)
        high += rng.uniform(0, 30, (len(low), 1))
        projected, meets = visible_projected(low, high, clip), meets_frustum_box(low, high, clip)
        assert (visible_both_ways(low, high, clip) == projected & meets).all()
        only_projected += int((meets & ~projected).sum())
        only_boxes += int((projected & ~meets).sum())
    assert only_projected > only_boxes > 20


def test_the_box_around_a_frustum_holds_it_and_no_smaller_one_does() -> None:
    rng = np.random.default_rng(5)
    clip, _ = perspective(rng)
    least, greatest = frustum_box(clip)
    ends = np.array([(x, y, z, 1.0) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    corners = ends @ np.linalg.inv(clip).T
    corners = corners[:, :3] / corners[:, 3:]
    assert np.allclose(corners.min(axis=0), least) and np.allclose(corners.max(axis=0), greatest)


def test_points_of_the_frustum_are_on_the_inner_side_of_its_planes() -> None:
    clip, _ = perspective(np.random.default_rng(3))
    corner = np.linalg.inv(clip) @ (0.3, -0.2, 0.5, 1.0)
    assert (frustum_planes(clip) @ (corner / corner[3]) > 0).all()


def test_faces_turned_away_cannot_be_seen_from_any_point_of_the_region() -> None:
    low, high = np.zeros((1, 3)), np.full((1, 3), 4.0)
    # East, west, up, down, south, north.
    assert facing(low, high, np.array([9.0, 2.0, 2.0])).tolist() == [[1, 0, 1, 1, 1, 1]]
    assert facing(low, high, np.array([2.0, -1.0, 9.0])).tolist() == [[1, 1, 0, 1, 1, 0]]


def test_distances_are_those_to_the_nearest_point_of_a_box() -> None:
    low, high = np.array([[3.0, 0.0, 4.0]]), np.array([[5.0, 1.0, 6.0]])
    assert distances(low, high, np.array([0.0, 0.5, 0.0])) == pytest.approx([5.0])
    assert distances(low, high, np.array([4.0, 50.0, 5.0])) == pytest.approx([49.0])
    assert distances(low, high, np.array([4.0, 0.5, 5.0])) == pytest.approx([0.0])


@pytest.mark.seldom(14, first=10)
def test_no_visible_region_and_no_visible_direction_is_culled() -> None:
    """Drawn with culling and without, random views are equal: what hills hide, too."""
    rng = np.random.default_rng(4)
    small = {"voxel.regions": 8, "voxel.region_size": 25, "shadow.enabled": False}
    small |= {"voxel.distance": 1000.0, "fog.enabled": False}
    poses = [
        (
            *rng.uniform(1, 15, 1),
            rng.uniform(0.3, 7.0),
            *rng.uniform(1, 15, 1),
            rng.uniform(0, 360),
            rng.uniform(-70, 30),
        )
        for _ in range(40)
    ]
    shown = []
    for culled, visibility in ((False, "planes"), *((True, each) for each in TESTS)):
        given = {**small, "voxel.visibility": visibility}
        given |= dict.fromkeys(("voxel.cull", "voxel.facing", "voxel.horizon"), culled)
        with Offscreen(SIZE, samples=0, place="voxel", settings=given, only=("land",)) as view:
            pictures = []
            for pose in poses:
                view.look(pose)
                pictures.append(view.draw())
            shown.append(pictures)

    for k, (whole, *culled_ones) in enumerate(zip(*shown, strict=True)):
        for picture in culled_ones:
            assert (picture == whole).all(), poses[k]
    assert len({picture.tobytes() for picture in shown[0]}) > 30


def samples_in_front(land: Land, sent: Choice) -> int:
    """Return how many samples of faces that were not sent lie in front of what has been drawn."""
    buffer, turns = land.buffer, slice(0, PLANTS)
    count = len(land.low)
    shares = np.arange(count) + DISTANT * count
    shares[sent.regions] = sent.shares
    begin, end = (buffer.at[shares, turns, at].astype(np.int64) for at in (0, -1))
    first, many = begin.copy(), np.zeros_like(begin)
    drawn = buffer._found(sent.shares, turns, sent.part, sent.last)
    first[sent.regions] = drawn[0]
    many[sent.regions] = np.where(sent.facing, np.maximum(drawn[1], 0), 0)
    first[many == 0] = begin[many == 0]
    starts = np.concatenate([begin.ravel(), (first + many).ravel()])
    counts = np.concatenate([(first - begin).ravel(), (end - first - many).ravel()])
    some = counts > 0
    query = int(np.ravel(gl.glGenQueries(1))[0])
    with attrib(gl.GL_ENABLE_BIT | gl.GL_DEPTH_BUFFER_BIT), matrix(), buffer.bound():
        gl.glScalef(land.scale, land.scale, land.scale)
        gl.glEnable(gl.GL_CULL_FACE)
        gl.glDepthMask(gl.GL_FALSE)
        gl.glBeginQuery(gl.GL_SAMPLES_PASSED, query)
        buffer._send(starts[some].astype(np.int32), counts[some].astype(np.int32))
        gl.glEndQuery(gl.GL_SAMPLES_PASSED)

    found = int(np.ravel(gl.glGetQueryObjectuiv(query, gl.GL_QUERY_RESULT))[0])
    gl.glDeleteQueries(1, np.array([query], np.uint32))
    return found


@pytest.mark.sweep(14, first=13)
@pytest.mark.parametrize("seed", range(10))
def test_not_one_sample_of_what_is_not_sent_lies_in_front_of_what_is(
    monkeypatch: pytest.MonkeyPatch, seed: int
) -> None:
    """A hundred random views for each seed: regions, directions, and what hills hide.

    Pictures drawn with culling and without cannot be compared at every pixel of so many views:
    faces that are clipped may come out a little different when others are sent with them.
    """
    rng = np.random.default_rng(seed)
    given = {"shadow.enabled": False, "voxel.distance": 1000.0, "fog.enabled": False}
    sent: list[Choice] = []
    draw = Land.draw

    def noted(land: Land, choice: Choice, fog_by_height: bool = False) -> None:
        sent.append(choice)
        draw(land, choice, fog_by_height)

    monkeypatch.setattr(Land, "draw", noted)
    regions = views = 0
    with Offscreen((400, 300), samples=0, place="voxel", settings=given, only=("land",)) as view:
        view.look((20.0, 9.0, 20.0))
        view.draw()
        scene: Any = view.scene
        while views < 100:
            x, z = rng.uniform(0.5, 39.5, 2)
            eye = 0.13 if rng.random() < 0.6 else rng.uniform(0.13, 6.0)
            y = (scene.roof if rng.random() < 0.3 else scene.height)(x, z) + eye
            if not scene.land.world.is_air(x / 0.08, z / 0.08, y / 0.08, CLEAR):
                continue
            pose = (x, y, z, rng.uniform(0, 360), rng.uniform(-60, 30))
            view.look(pose)
            view.draw()
            with view.targeted():
                assert samples_in_front(scene.land, sent[-1]) == 0, pose
            regions += len(sent[-1].regions)
            views += 1
    assert 50 < regions / views < 200  # of 625


@pytest.mark.sweep(14, first=12)
def test_no_background_shows_between_merged_quads() -> None:
    """From above, looking steeply down, every pixel is land: there are no pinholes."""
    rng = np.random.default_rng(6)
    given = {"shadow.enabled": False, "fog.enabled": False, "fog.color": (1.0, 0.0, 1.0)}
    given |= {"voxel.distance": 1000.0, "voxel.near": 1.0, "voxel.far": 5.0}  # all three meshes
    with Offscreen((320, 240), samples=0, place="voxel", settings=given, only=("land",)) as view:
        view.look((20.0, 9.0, 20.0))
        for _ in range(25):
            pose = Pose(
                *rng.uniform(15, 25, 1),
                rng.uniform(5, 8),
                *rng.uniform(15, 25, 1),
                rng.uniform(0, 360),
                rng.uniform(-88, -62),
            )
            view.moment = replace(view.moment, pose=pose)
            magenta = (view.draw() == (255, 0, 255)).all(axis=-1)
            assert not magenta.any(), pose


BARE: dict[str, Any] = {
    "shadow.enabled": False,
    "fog.enabled": False,
    "fog.color": (1.0, 0.0, 1.0),
    "voxel.holes": False,
    "voxel.distance": 1000.0,
}
UNMERGED = BARE | {"voxel.merge": "none", "voxel.horizon": False}
FINER = 4  # times as many pixels along each side, where sky shows between trees


@pytest.fixture(scope="module")
def merged_and_not() -> Iterator[tuple[Offscreen, Offscreen]]:
    """The land with merged faces, and with a quad for each face: there are no T-junctions."""
    with (
        Offscreen((400, 300), samples=0, place="voxel", settings=BARE, only=("land",)) as one,
        Offscreen((400, 300), samples=0, place="voxel", settings=UNMERGED, only=("land",)) as other,
    ):
        for view in (one, other):
            view.look((20.0, 9.0, 20.0))
        yield one, other


def any_sky(pose: Pose) -> np.ndarray:
    """Return which of 400 x 300 pixels show any sky without merging, however little, bool."""
    smallest, values = LEAST_PIXELS / MOST_PIXELS, SCENE.settings.voxel
    given = {"voxel.near": smallest * values.near, "voxel.far": smallest * values.far}
    size = (400 * FINER, 300 * FINER)
    with Offscreen(
        size, samples=0, place="voxel", settings=UNMERGED | given, only=("land",)
    ) as view:
        view.look((20.0, 9.0, 20.0))
        view.moment = replace(view.moment, pose=pose)
        sky = (view.draw() == (255, 0, 255)).all(axis=-1)
    return np.asarray(sky.reshape(300, FINER, 400, FINER).any(axis=(1, 3)))


@pytest.mark.sweep(14, first=13)
@pytest.mark.parametrize("seed", range(25))
def test_no_background_shows_through_level_ground_at_a_grazing_angle(
    merged_and_not: tuple[Offscreen, Offscreen], seed: int
) -> None:
    """From eye height, sky shows only where it does without merging, or a pixel beside."""
    rng = np.random.default_rng(seed)
    scene = merged_and_not[0].scene
    assert isinstance(scene, Voxel)
    for _ in range(40):
        x, z = rng.uniform(2, 38, 2)
        y = scene.roof(x, z) + 0.13
        pose = Pose(x, y, z, rng.uniform(0, 360), rng.uniform(-30, 15))
        block = scene.land.scale
        if not scene.land.world.is_air(x / block, z / block, y / block, CLEAR):
            continue  # the near plane would cut a wall open
        sky = []
        for view in merged_and_not:
            view.moment = replace(view.moment, pose=pose)
            sky.append((view.draw() == (255, 0, 255)).all(axis=-1))
        around = np.pad(sky[1], 1, mode="edge")
        beside = [around[i:, k:][:300, :400] for i in range(3) for k in range(3)]
        holes = sky[0] & ~np.any(beside, axis=0)

        # A gap between trees may be too narrow for the other picture's pixels.
        assert not holes.any() or not (holes & ~any_sky(pose)).any(), pose
