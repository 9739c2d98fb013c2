"""Models of blocks: whole trees, a castle to walk through, creatures, groves and meadows."""

from collections import deque

import numpy as np
import pytest

from framelens.base.errors import InputError
from landscape.files.assets import shipped
from landscape.voxel.blocks import BLOCKS, SOLID, block
from landscape.voxel.landmarks import grow
from landscape.voxel.models import castle as castles
from landscape.voxel.models import finds
from landscape.voxel.models.castle_keep import HEIGHT, KEEP
from landscape.voxel.models.creatures import SEA, dragon, rabbit
from landscape.voxel.models.meadow import HIGH, SPACING, forest, plants
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


@pytest.mark.parametrize("kind", ["oak", "birch", "hawthorn"])
def test_beside_its_trunk_a_tree_shows_no_log(kind):
    for model in trees(kind):
        logs = np.pad(model == block(f"{kind} log"), 1)
        full = np.pad(model > 0, 1)
        logs[logs.shape[0] // 2, logs.shape[1] // 2] = False
        for axis in range(3):
            for step in (-1, 1):
                assert np.roll(full, step, axis)[logs].all()


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
    assert not SOLID[passage[..., :4]].any()


def test_the_castle_has_foundations_under_all_of_it():
    model = castles.castle()
    stands = (model[..., castles.FLOOR + 1] == block("brick")).nonzero()
    assert SOLID[model[..., : castles.FLOOR][stands]].all()
    empty = castles.hollow(model)
    assert not empty[..., : castles.FLOOR].any() and not (empty & (model > 0)).any()
    assert empty[castles.GATE + 1, 27, castles.FLOOR + 1]


@pytest.mark.parametrize("height", [7, 14, 20])
def test_the_rabbit_is_as_high_as_asked_and_alike_on_both_sides(height):
    model = rabbit(shipped() / "rabbit.ply", height)
    assert model.dtype == np.uint8 and model.shape[2] == height and model.shape[1] % 2 == 1
    assert np.array_equal(model, model[:, ::-1])
    assert model[..., 0].any() and model[..., -1].any()


def test_the_rabbit_has_two_eyes_a_nose_two_ears_and_a_light_tail():
    model = rabbit(shipped() / "rabbit.ply", 14)
    eyes = np.argwhere(model == block("dark"))
    assert len(eyes) == 2 and eyes[0, 1] < model.shape[1] // 2 < eyes[1, 1]
    assert eyes[0, 0] > model.shape[0] / 2  # it looks to the east
    ears = (model[..., -3:] > 0).any(axis=(0, 2))
    assert ears[: len(ears) // 2].any() and not ears[len(ears) // 2]
    assert (model[..., -5:] == block("pink")).any()
    assert model[0, model.shape[1] // 2].max() == block("light fur")
    inner = model[8, model.shape[1] // 2, :6]
    assert (inner > 0).all()  # it is solid


def test_the_dragon_is_as_long_as_asked_and_in_one_piece():
    model = dragon(shipped() / "dragon.ply", 60)
    assert model.shape[0] == 60 and model[0].any() and model[-1].any()
    one = np.zeros(model.shape, bool)
    one[tuple(np.argwhere(model == block("scales"))[0])] = True
    assert joined(model > 0, one).sum() > 0.99 * (model > 0).sum()
    names = ("scales", "bright scales", "deep scales", "light scales", "horn", "dark", "pink")
    assert {block(name) for name in names} == set(np.unique(model)) - {0}
    eyes = np.argwhere(model == block("dark"))
    assert eyes[:, 0].min() > 45 and eyes[:, 2].min() > SEA * model.shape[2]


def test_a_mesh_that_is_flat_or_without_colours_is_told_or_taken(tmp_path):
    head = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    head += "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
    faces = "3 0 1 2\n3 0 1 3\n3 1 2 3\n3 0 2 3\n"
    solid = tmp_path / "solid.ply"
    solid.write_text(f"{head}0 0 0\n3e38 0 0\n0 3e38 0\n0 0 3e38\n{faces}")
    assert rabbit(solid, 9).any() and dragon(solid, 9).any()
    flat = tmp_path / "flat.ply"
    flat.write_text(f"{head}0 0 0\n0 0 1\n0 0 0\n0 0 2\n{faces}")
    for make in (rabbit, dragon):
        with pytest.raises(InputError, match=r"flat\.ply: expected a mesh that is not flat"):
            make(flat)


def test_what_is_found_on_the_way_has_foundations_and_a_lamp():
    rng = np.random.default_rng(6)
    for model in (finds.ruin(rng), finds.stone_circle(rng), finds.beacon(), finds.well()):
        assert model.dtype == np.uint8 and model.max() < len(BLOCKS)
        assert (model == block("lamp")).any()
        above = SOLID[model[..., finds.FLOOR]] & (model[..., finds.FLOOR] != block("planks"))
        leaves = model[..., finds.FLOOR] == block("oak leaves")
        assert SOLID[model[..., finds.FLOOR - 1]][above & ~leaves].all()
    assert np.array_equal(
        finds.ruin(np.random.default_rng(8)), finds.ruin(np.random.default_rng(8))
    )


@pytest.mark.parametrize("length", [9, 13, 20])
def test_a_jetty_reaches_from_its_middle_over_the_sea_beside_a_boat(length):
    model = finds.jetty(length)
    start = model.shape[0] // 2
    deck = model[start : start + length, 6:8, finds.DECK]
    assert (deck == block("planks")).all()
    assert not SOLID[model[start : start + length, 6:8, finds.DECK + 1 : finds.DECK + 3]].any()
    assert (model[..., 0] == block("oak log")).any()
    assert (model == block("light fur")).any()  # the boat's sail


def hill(side: int = 160) -> np.ndarray:
    x, z = np.ogrid[:side, :side]
    return 40.0 - 0.3 * np.hypot(x - side / 2, z - side / 2)


def test_trees_keep_their_distance_and_stay_where_they_may():
    places = np.ones((160, 160), bool)
    places[60:100] = False
    found = forest(places, hill(), np.random.default_rng(4))
    assert len(found) > 60
    assert all(places[x, z] for _, x, z in found)
    at = np.array([(x, z) for _, x, z in found])
    apart = np.hypot(*(at[:, None] - at).transpose(2, 0, 1)) + 1e9 * np.eye(len(at))
    assert apart.min() >= min(SPACING.values())
    assert found == forest(places, hill(), np.random.default_rng(4))
    assert forest(np.zeros((160, 160), bool), hill(), np.random.default_rng(4)) == []


def test_trees_stand_in_groves_with_spruces_on_high_ground():
    places = np.ones((240, 240), bool)
    ground = hill(240)
    found = forest(places, ground, np.random.default_rng(2))
    heights = {kind: [ground[x, z] for k, x, z in found if k == kind] for kind in KINDS}
    assert all(heights.values())
    assert np.mean(heights["spruce"]) > max(np.mean(heights[k]) for k in KINDS if k != "spruce")
    assert 0 < HIGH < 1
    counts = np.zeros((8, 8), int)
    for _, x, z in found:
        counts[x // 30, z // 30] += 1
    assert counts.var() > 2 * counts.mean()  # of evenly random places they would be equal


def test_plants_grow_in_patches_of_their_kind_only_where_they_may():
    places = np.ones((200, 200), bool)
    places[:, :50] = False
    found = plants(places, np.random.default_rng(1))
    assert not found[~places].any()
    kinds = [number for number in np.unique(found) if number]
    assert len(kinds) == 8 and all(BLOCKS[number].plant for number in kinds)
    assert 0.03 < (found[places] > 0).mean() < 0.2
    for name in ("poppy", "cornflower", "heather"):
        here = (found == block(name))[:, 50:]
        counts = here.reshape(20, 10, 15, 10).sum(axis=(1, 3))
        assert counts.var() > 3 * counts.mean()


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


def test_flowers_grow_where_trees_may_not_but_only_on_grass():
    tops, kinds = np.full((60, 60), 3, np.int16), np.full((60, 60), block("grass"), np.uint8)
    blocks = np.zeros((60, 60, 40), np.uint8)
    blocks[..., :3] = block("grass")
    blocks[20:40, 20:40, 2] = block("gravel")  # a court
    nowhere = np.zeros((60, 60), bool)
    grow(blocks, tops, kinds, nowhere, nowhere, np.random.default_rng(0))
    plants = np.array([each.plant for each in BLOCKS])[blocks[..., 3]]
    assert plants.sum() > 50 and not plants[20:40, 20:40].any()
    assert not blocks[..., 4:].any()  # no tree
