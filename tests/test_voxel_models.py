"""Models of blocks: trees that are whole, a castle that can be walked through."""

from collections import deque

import numpy as np
import pytest

from landscape.voxel.blocks import BLOCKS, SOLID, block
from landscape.voxel.models import castle as castles
from landscape.voxel.models.castle_keep import HEIGHT, KEEP
from landscape.voxel.models.shapes import joined, put
from landscape.voxel.models.trees import KINDS, tree

SEEDS = range(12)


def trees(kind: str) -> list[np.ndarray]:
    return [tree(kind, np.random.default_rng(seed)) for seed in SEEDS]


@pytest.mark.parametrize("kind", KINDS)
def test_a_tree_stands_on_its_trunk_and_holds_all_its_leaves(kind):
    for model in trees(kind):
        logs = model == block(f"{kind} log")
        middle = logs[model.shape[0] // 2, model.shape[1] // 2]
        assert middle[:2].all()
        assert joined(model > 0, logs).sum() == (model > 0).sum()
        assert joined(logs, logs & (np.arange(model.shape[2]) == 0)).sum() == logs.sum()
        assert logs.sum() < (model > 0).sum() / 2


@pytest.mark.parametrize("kind", KINDS)
def test_a_seed_gives_one_tree_and_other_seeds_give_others(kind):
    assert all(np.array_equal(a, b) for a, b in zip(trees(kind), trees(kind), strict=True))
    assert len({model.tobytes() for model in trees(kind)}) > 9


def test_an_unknown_kind_of_tree_is_named():
    with pytest.raises(ValueError, match="'palm'"):
        tree("palm", np.random.default_rng(1))


def test_models_are_bytes_of_blocks_that_exist():
    for model in (castles.castle(), *(tree(kind, np.random.default_rng(0)) for kind in KINDS)):
        assert model.dtype == np.uint8
        assert model.max() < len(BLOCKS)
        assert model[..., -1].any() and model[..., 0].any()


def test_a_model_is_put_with_its_middle_at_the_place_and_is_cut_at_the_border():
    model = np.zeros((3, 5, 4), np.uint8)
    model[1, 2, 1] = 7
    model[0, 0, 3] = 8
    world = np.ones((6, 6, 6), np.uint8)
    put(world, model, (1, 2, 3), floor=1)
    assert world[1, 2, 3] == 7 and world[0, 0, 5] == 8 and (world == 1).sum() == 6**3 - 2
    put(world, model, (0, 0, 5))
    assert (world != 1).sum() == 2
    put(world, model, (-9, 0, 0))
    assert (world != 1).sum() == 2


def test_the_castle_is_reached_by_its_steps_and_its_walk_and_keep_by_stairs():
    model = castles.castle()
    reached = walked(model, (castles.GATE + 1, castles.PLAN[1] - 1, castles.FLOOR - 5))
    assert reached[castles.GATE + 1, castles.SOUTH, castles.FLOOR]  # in the gate
    walk = reached[..., castles.WALK]
    assert walk[castles.WEST, castles.NORTH + 6 : castles.SOUTH - 5].all()
    assert walk[castles.EAST, castles.NORTH + 6 : castles.SOUTH - 5].all()
    assert walk[castles.WEST + 6 : castles.EAST - 5, castles.NORTH].all()
    assert walk[castles.WEST + 6 : castles.EAST - 5, castles.SOUTH].all()
    for x, z, *_ in castles.TOWERS:
        assert walk[x, z]
    assert reached[KEEP[0] + 4, KEEP[1] + 8, castles.FLOOR + HEIGHT]


def test_the_gate_is_three_blocks_wide_and_high_enough():
    passage = castles.castle()[
        castles.GATE : castles.GATE + 3, castles.SOUTH - 3 : castles.SOUTH + 7, castles.FLOOR :
    ]
    assert not SOLID[passage[..., :3]].any()


def test_the_castle_has_foundations_under_all_of_it():
    model = castles.castle()
    stands = (model[..., castles.FLOOR + 1] == block("brick")).nonzero()
    assert SOLID[model[..., : castles.FLOOR][stands]].all()
    empty = castles.hollow(model)
    assert not empty[..., : castles.FLOOR].any() and not (empty & (model > 0)).any()
    assert empty[18, 22, castles.FLOOR + 1]


def walked(model: np.ndarray, start: tuple[int, int, int]) -> np.ndarray:
    """Return where a walker, two blocks high, comes from ``start`` by steps of one block."""
    solid = SOLID[np.pad(model, ((1, 1), (1, 1), (0, 4)))]
    free = ~solid
    stands = free.copy()
    stands[..., 1:] &= solid[..., :-1]
    stands[..., :-1] &= free[..., 1:]
    found = np.zeros_like(stands)
    first = (start[0] + 1, start[1] + 1, start[2])
    assert stands[first]
    found[first] = True
    waiting = deque([first])
    while waiting:
        x, z, y = waiting.popleft()
        for dx, dz in ((1, 0), (-1, 0), (0, 1), (0, -1)):
            for level in (y - 1, y, y + 1):
                there = (x + dx, z + dz, level)
                high = max(y, level) + 2
                if stands[there] and not found[there]:
                    room = free[x, z, y:high].all() and free[x + dx, z + dz, level:high].all()
                    if room:
                        found[there] = True
                        waiting.append(there)
    return found[1:-1, 1:-1]
