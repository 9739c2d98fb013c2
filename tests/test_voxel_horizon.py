"""What hills hide: no point that can be seen is left out, and much that cannot is."""

from dataclasses import replace

import numpy as np
import pytest

from landscape.frame import Pose
from landscape.offscreen import Offscreen
from landscape.voxel.blocks import AIR, block
from landscape.voxel.horizon import ALONG, ROWS, Horizon, solid_heights
from landscape.voxel.world import Changes

SIDE = 80
TALL = 30
REGION = 16
ROCK, LEAVES = block("rock"), block("oak leaves")


def hilly(rng: np.random.Generator) -> np.ndarray:
    """Return blocks [x, z, y] of hills and of some towers."""
    x, z = np.meshgrid(*(np.arange(SIDE) / 9.0 + rng.uniform(0, 6),) * 2, indexing="ij")
    heights = 6 + 4 * np.sin(x) * np.cos(z)
    for _ in range(12):
        a, b = rng.integers(0, SIDE - 9, 2)
        heights[a : a + 9, b : b + 7] = rng.integers(8, 26)
    return np.where(np.arange(TALL) < heights[..., None], ROCK, AIR).astype(np.uint8)


def blocked(heights: np.ndarray, eye: np.ndarray, point: np.ndarray) -> bool:
    """Return whether the way from eye to point [x, z, y] goes through the ground, by many steps."""
    at = eye + np.linspace(0, 1, 3000)[:-4, None] * (point - eye)
    x, z = at[:, :2].astype(int).T
    return bool((at[:, 2] < heights[x, z]).any())


def test_columns_are_solid_up_to_the_first_block_that_one_can_look_through() -> None:
    blocks = np.zeros((1, 5, 4), np.uint8)
    blocks[0, 0, :2] = ROCK
    blocks[0, 1, [0, 1, 3]] = ROCK  # a hole
    blocks[0, 2] = ROCK
    blocks[0, 3, :3] = ROCK, LEAVES, ROCK
    assert solid_heights(blocks).tolist() == [[2, 2, 4, 1, 0]]


def test_heights_take_a_byte_a_column_unless_the_world_is_higher() -> None:
    for tall, size in ((255, 1), (256, 2)):
        heights = solid_heights(np.full((2, 3, tall), ROCK, np.uint8))
        assert heights.itemsize == size and (heights == tall).all()


def test_each_point_of_a_line_has_heights_from_far_enough_around() -> None:
    assert ROWS[0].start == 0 and ROWS[-1].stop == len(ALONG)


def test_nothing_that_can_be_seen_is_called_hidden_and_a_quarter_of_what_cannot_is() -> None:
    rng = np.random.default_rng(1)
    hidden = missed = 0
    for _ in range(6):
        heights = solid_heights(hilly(rng))
        horizon = Horizon(heights, REGION)
        for _ in range(8):
            x, z = rng.uniform(1, SIDE - 1, 2)
            eye = np.array([x, z, heights[int(x), int(z)] + rng.uniform(0.3, 3)])
            up_to = horizon.hidden(*eye)
            for region in rng.integers(0, len(up_to), 12):
                i, k = divmod(int(region), SIDE // REGION)
                a, b = REGION * (np.array([i, k]) + rng.uniform(0, 1, 2))
                point = np.array([a, b, heights[int(a), int(b)] + 0.01])
                unseen = blocked(heights, eye, point)
                if point[2] < up_to[region]:
                    assert unseen, (eye, point)
                    hidden += 1
                else:
                    missed += unseen

    assert hidden > 100 and hidden > (hidden + missed) / 4


def test_a_changed_column_counts_as_it_is_now() -> None:
    rng = np.random.default_rng(2)
    blocks = hilly(rng)
    horizon = Horizon(solid_heights(blocks), REGION)
    eye = (40.5, 40.5, 26.5)
    horizon.hidden(*eye)
    for x, z in [(0, 0), (SIDE - 1, 3), *rng.integers(0, SIDE, (60, 2)).tolist()]:
        blocks[x, z, rng.integers(1, 12)] = AIR
        horizon.change(x, z, blocks[x, z])
    again = Horizon(solid_heights(blocks), REGION)
    np.testing.assert_array_equal(horizon.hidden(*eye), again.hidden(*eye))


@pytest.mark.seldom(10, first=3)
def test_one_sees_through_a_gap_that_was_dug_into_a_ridge() -> None:
    """The picture with what hills hide left out equals that with all of it, before and after."""
    small = {"voxel.regions": 5, "voxel.region_size": 20, "shadow.enabled": False}
    with Offscreen((160, 120), samples=0, place="voxel", settings=small, only=("land",)) as view:
        view.look((4.0, 2.0, 4.0))
        view.draw()
        island = view.scene
        assert island is not None
        ground = island.land.world.ground

        # From behind the highest column across to the other side of it.
        x, z = np.unravel_index(int(ground[20:80, 20:80].argmax()), (60, 60))
        x, z = int(x) + 20, int(z) + 20
        eye = (x - 12.5, z + 0.5)
        height = float(ground[int(eye[0]), int(eye[1])]) + 1.6
        pose = Pose(eye[0] * 0.08, height * 0.08, eye[1] * 0.08, 90.0, 2.0)
        for depth in (0, 8):
            gap = [
                island.land.world.place((x + i, z + k, y))
                for i in range(-10, 11)
                for k in range(-2, 3)
                for y in range(int(height) - 3, int(height) - 3 + depth)
            ]
            with view._current():
                island.land.restore(Changes(np.array(gap, np.intp), np.full(len(gap), AIR)))
            pictures = []
            for on in (True, False):
                values = island.settings
                assert island.apply(replace(values, voxel=replace(values.voxel, horizon=on)))
                view.moment = replace(view.moment, pose=pose)
                pictures.append(view.draw())
            assert (pictures[0] == pictures[1]).all()
