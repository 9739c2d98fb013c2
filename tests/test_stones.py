"""Crags, boulders, stones and driftwood: where they lie, how they are drawn, what they stop."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from stage import SIZE, Stage, close, small, write_ply

from framelens.base.errors import InputError
from landscape.elements.best.stones import wanted
from landscape.elements.best.stones.bodies import FOOT
from landscape.elements.best.stones.scattering import rules
from landscape.elements.best.stones.shapes import (
    CRAG,
    KINDS,
    LOG,
    PEBBLE,
    first_shape,
    kept_shapes,
    read_shapes,
)
from landscape.elements.best.stones.stones import Stones
from landscape.elements.best.terrain.shadows import ShadowMap
from landscape.elements.best.terrain.terrain import Terrain
from landscape.elements.settings import Settings, preset
from landscape.elements.sun import direction
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.mesh import is_closed
from landscape.geometry.obstacle_grid import ObstacleGrid
from landscape.island.island import Island
from landscape.scene.scene import Moment

STONY: dict[str, Any] = {
    "ground.materials": True,
    "ground.stones": 1500,
    "ground.height_image": "height16.png",
    "ground.resolution": 160,
    "ground.exact_height": True,
}
SHORE = Pose(33.8, 0.71, 21.2, 40.0, -2.0)


def before(stones: Stones) -> Pose:
    """Return a pose from which the largest stone of the shore is seen, above the water."""
    found = stones.bodies
    coast = np.flatnonzero(np.abs(found.tops - 0.8) < 0.1)
    x, y, z = found.middles[coast[found.radii[coast].argmax()]].tolist()
    return Pose(x, y + 0.5, z + 0.8, 0.0, -30.0)


def stony(**more: Any) -> Settings:
    return small(STONY | more)


@pytest.fixture(scope="module")
def ground(the_stage: Stage) -> Iterator[Terrain]:
    the_stage.enter()
    settings = stony()
    made = Terrain(settings, Assets(), direction(settings.sun))
    yield made
    the_stage.enter()
    made.release()


@pytest.fixture(scope="module")
def stones(the_stage: Stage, ground: Terrain) -> Iterator[Stones]:
    the_stage.enter()
    made = Stones(stony(), Assets(), ground, 2006)
    yield made
    the_stage.enter()
    made.release()


def kinds(stones: Stones) -> np.ndarray:
    firsts = [first_shape(kind) for kind in range(len(KINDS))]
    return np.searchsorted(firsts, stones.bodies.shapes, side="right") - 1


def corners(stones: Stones, level: int = 0) -> Iterator[tuple[int, np.ndarray]]:
    """Yield the number of each stone and its vertices (v, 3) as they lie, at a level."""
    found = stones.bodies
    for k, levels in enumerate(read_shapes(Assets().path("stones.ply"))):
        if level < len(levels):
            for n in np.flatnonzero(found.shapes == k):
                first, count = found.firsts[n, level], len(levels[level].vertices)
                yield int(n), found.vertices["point"][first : first + count]


def test_the_preset_best_has_stones_and_that_of_2006_has_none() -> None:
    assert wanted(preset("best")) and not wanted(preset("2006"))
    assert not wanted(small({"ground.stones": 9})), "they have the texture of the rock"


def test_each_shape_is_closed_and_its_coarser_levels_have_fewer_triangles() -> None:
    shapes = read_shapes(Assets().path("stones.ply"))
    assert len(shapes) == sum(KINDS)
    for levels in shapes:
        counts = [len(shape.triangles) for shape in levels]
        assert counts == sorted(counts, reverse=True) and len(set(counts)) == len(counts)
        for shape in levels:
            assert np.abs(shape.vertices).max() < 1.15
            assert np.allclose(np.linalg.norm(shape.normals, axis=1), 1.0, atol=1e-4)
            _, same = np.unique(shape.vertices.round(5), axis=0, return_inverse=True)
            assert is_closed(same[shape.triangles]), "edges have several vertices at one place"


def test_a_file_with_other_meshes_is_refused_by_its_name(tmp_path: Path) -> None:
    tetrahedron = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], float)
    faces = np.array([(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])
    write_ply(tmp_path / "stones.ply", tetrahedron, faces)
    with pytest.raises(InputError, match=r"stones\.ply: expected .* stones in a row"):
        read_shapes(tmp_path / "stones.ply")


def test_no_stone_floats_and_each_sticks_out(stones: Stones, ground: Terrain) -> None:
    seen, kind = 0, kinds(stones)
    for level in range(2):
        for number, points in corners(stones, level):
            x, y, z = points.astype(float).T
            over = y - ground.terrain_height(x, z)
            low, high = y.min(), y.max()
            # A coarser level is not quite the same, and is seen from far away.
            foot = y < low + FOOT[kind[number]] / (1 + level) * (high - low)
            assert (over[foot] < 0.25 * level * (high - low)).all(), f"stone {number} floats"
            assert level or over.max() > 0.0, f"stone {number} is buried"
            seen += 1
    assert seen > 1500


def test_crags_stand_in_slopes_and_pebbles_and_driftwood_lie_on_the_shore(
    stones: Stones, ground: Terrain
) -> None:
    kind, (x, _, z) = kinds(stones), stones.bodies.middles.T
    slope, above = ground.field.slope(x, z), ground.terrain_height(x, z) - 0.6
    assert np.median(slope[kind == CRAG]) > 0.5 > np.median(slope[kind == LOG])
    assert (np.abs(above[kind == LOG] - 0.07) < 0.07).all()
    assert above.min() > -0.2, "none lies on the floor of the sea"
    shore = above[kind == PEBBLE] < 0.12
    assert shore.mean() > 0.3


def test_stones_keep_clear_of_the_castle_and_of_the_rabbit(ground: Terrain) -> None:
    settings = stony()
    for rule in rules(settings, ground, 1).values():
        for thing in (settings.castle, settings.rabbit):
            assert rule(np.array([thing.x]), np.array([thing.z])) == [0.0]


@pytest.mark.seldom(10, first=8)
def test_the_same_seed_gives_the_same_stones(stage: Stage, ground: Terrain, stones: Stones) -> None:
    for seed, same in ((2006, True), (7, False)):
        other = Stones(stony(), Assets(), ground, seed)
        assert np.array_equal(other.bodies.middles, stones.bodies.middles) is same
        other.release()


@pytest.mark.parametrize("mirrored", [False, True])
def test_drawing_leaves_the_state_as_found(stage: Stage, stones: Stones, mirrored: bool) -> None:
    with stage.frame(stony(), before(stones), fog=True) as frame:
        blank = stage.read()
        stones.draw(replace(frame, mirrored=mirrored))
        assert mirrored or (stage.read() != blank).any()


@pytest.mark.seldom(10, first=8)
def test_the_number_drawn_falls_little_by_little_as_the_eye_goes_away(
    stage: Stage, stones: Stones
) -> None:
    last, largest = None, 0
    for away in np.arange(0.0, 6.0, 0.05):
        pose = replace(SHORE, x=SHORE.x - 0.64 * away, z=SHORE.z + 0.77 * away)
        with stage.frame(stony(), pose) as frame:
            count = len(stones.select(frame))
        largest = max(largest, count)
        assert last is None or abs(count - last) < 0.15 * largest + 600
        last = count
    assert last is not None and 0 < last < 0.7 * largest


def test_what_is_not_drawn_is_small_in_the_window(stage: Stage, stones: Stones) -> None:
    found = stones.bodies
    with stage.frame(stony(**{"camera.cull": False}), SHORE) as frame:
        sent = np.unique(stones.select(frame))
        away = np.linalg.norm(found.middles - frame.eye, axis=1)
    drawn = np.isin(found.firsts, sent) & (found.firsts > 0)
    assert (2.0 * found.radii * frame.pixels / away)[~drawn.any(axis=1)].max() < 16.0


def test_only_what_rises_above_the_water_is_mirrored(stage: Stage, stones: Stones) -> None:
    with stage.frame(stony(), before(stones)) as frame:
        sent = np.unique(stones.select(replace(frame, mirrored=True)))
    starts = np.isin(stones.bodies.firsts, sent).any(axis=1) & (stones.bodies.firsts[:, 0] > 0)
    assert starts.any() and (stones.bodies.tops[starts] > 0.6).all()


def test_a_stone_is_darkest_where_it_meets_the_ground(stones: Stones, ground: Terrain) -> None:
    colours = stones.bodies.vertices["colour"][:, :3].mean(axis=1)
    points = stones.bodies.vertices["point"].astype(float)
    over = points[:, 1] - ground.terrain_height(points[:, 0], points[:, 2])
    dry = points[:, 1] > 0.65
    touching, free = dry & (np.abs(over) < 0.002), dry & (over > 0.05)
    assert colours[touching].mean() < 0.75 * colours[free].mean()


def test_stones_in_a_shadow_of_the_ground_are_darker(
    stage: Stage, stones: Stones, ground: Terrain
) -> None:
    def picture() -> np.ndarray:
        stones.stand_in(ground)
        with stage.frame(stony(), SHORE):
            pass
        return stones._kept["colour"][:, :3].astype(int)

    lit = picture()
    ground.shade(np.full((len(ground.large),) * 2 + (3,), 128, np.uint8))
    shaded = picture()
    ground.shade(np.full((len(ground.large),) * 2 + (3,), 255, np.uint8))
    assert (shaded <= lit).all() and shaded.mean() < 0.9 * lit.mean()
    assert close(picture(), lit, 0)


def test_large_stones_darken_the_ground_around_them(stones: Stones, ground: Terrain) -> None:
    shadows = ShadowMap(ground.field, direction(stony().sun), 512)
    before = shadows.light()
    stones.cast(shadows)
    after = shadows.light()
    x, _, z = stones.bodies.middles[stones.bodies.radii > 0.1].T
    at = (z * 512 / 40).astype(int), (x * 512 / 40).astype(int)
    assert after[at].mean() < 0.8 * before[at].mean()
    assert (after == before).mean() > 0.5


def test_a_walker_goes_around_boulders_and_steps_over_pebbles(stage: Stage) -> None:
    island = Island(stony(**{"walk.solid": True}), Assets(), only=("ground",))
    assert isinstance(island.obstacles, ObstacleGrid)
    towers = island.stones.towers()
    kind, found = kinds(island.stones), island.stones.bodies
    places = {tuple(row) for row in towers[:, :2].tolist()}
    solid = np.array([(x, z) in places for x, _, z in found.middles.tolist()])
    x, _, z = found.middles.T
    high = found.tops - island.ground.terrain_height(x, z)
    assert solid[(high > 0.05) & (kind != LOG)].all() and not solid[high < 0.04].any()
    assert not solid[kind == PEBBLE].any() and not solid[kind == LOG].any()
    x, z, radius, _ = towers[0]
    near = island.obstacles.near(x, z, 0.1)
    assert any(each.gap(x, z)[0] == pytest.approx(-radius) for each in near)
    island.release()


def test_the_picture_shows_them_beside_the_ground(stage: Stage, stones: Stones) -> None:
    pictures = []
    for count in (0, 1500):
        island = Island(stony(**{"ground.stones": count}), Assets(), only=("ground",))
        with stage.borrowed():
            island.draw(Moment(before(stones), SIZE))
            pictures.append(stage.read().astype(int))
        island.release()
    assert 0.002 < (np.abs(pictures[0] - pictures[1]).max(axis=2) > 20).mean() < 0.5


@pytest.mark.parametrize("mirrored", [False, True])
def test_what_is_drawn_does_not_depend_on_the_frame_before(
    stage: Stage, stones: Stones, mirrored: bool
) -> None:
    """What those near the eye were chosen for may be seen in their number, their fineness, or not
    at all: some of the frames below have other stones than the one in which that was.
    """
    differ = 0
    for step in range(6):
        poses = (replace(SHORE, z=SHORE.z + 0.05 * (step + at), yaw=step + at) for at in (0.0, 0.9))
        chosen = []
        for pose in poses:
            with stage.frame(stony(), pose) as frame:
                frame = replace(frame, mirrored=mirrored)
                used = stones.choice(frame)
                stones._near.clear()
                assert np.array_equal(used, stones.select(frame))
                stones.choice(frame)
                chosen.append(used)
        differ += not np.array_equal(*chosen)
    assert differ or mirrored


def test_shapes_from_the_cache_are_those_of_the_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LANDSCAPE_CACHE", str(tmp_path))
    path = Assets().path("stones.ply")
    read = read_shapes(path)
    for _ in range(2):
        kept = kept_shapes(path)
        assert [len(levels) for levels in kept] == [len(levels) for levels in read]
        for ours, theirs in zip(chain(*kept), chain(*read), strict=True):
            for array, other in zip(vars(ours).values(), vars(theirs).values(), strict=True):
                assert array.dtype == other.dtype
                np.testing.assert_array_equal(array, other)
