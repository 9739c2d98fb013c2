"""Trunks, deer, keep and gate: a walker goes around them, and can always get away."""

import math
from dataclasses import replace

import numpy as np
import pytest

from landscape.elements.planting import PLANT, THICK, Sprites, trunks
from landscape.elements.settings import Settings, preset
from landscape.frame import Pose
from landscape.geometry.height_field import HeightField
from landscape.geometry.obstacle_grid import ObstacleGrid
from landscape.geometry.obstacles import RADIUS, Gate, Tower, Wall, courtyard
from landscape.geometry.pockets import without_pockets
from landscape.walk.walker import Intent, Walker, advance, start

BEST = preset("best")
FLAT = HeightField(np.full((50, 50), 1.0, np.float32), 40.0, 0.6)
YARD = courtyard(20.0, 20.0, 30.0, 0.045, 2.0, (0.13, 2.2), (0.1, 1.36))


def wood(seed: int, count: int = 400, side: float = 6.0, size: float = 40.0) -> np.ndarray:
    """Return random trunks (n, 4) in a square of ``side`` units in the middle of the map."""
    rng = np.random.default_rng(seed)
    x, z = rng.uniform((size - side) / 2, (size + side) / 2, (2, count))
    return np.stack([x, z, rng.uniform(0.016, 0.078, count), np.full(count, 1.5)], axis=1)


def solid_wood(seed: int, count: int = 400) -> ObstacleGrid:
    """Return a wood without pockets."""
    towers = wood(seed, count)
    return ObstacleGrid((), towers[without_pockets(towers, 40.0)])


def clearance(walker: Walker, grid: ObstacleGrid) -> float:
    """Return the distance to the nearest trunk's surface."""
    x, z, radius, _ = grid.towers.T
    return float((np.hypot(x - walker.x, z - walker.z) - radius).min())


def walk(walker: Walker, obstacles, seconds: float = 0.5, frames: int = 15, **how) -> Walker:
    for _ in range(frames):
        walker = advance(walker, Intent(**how), seconds / frames, FLAT, obstacles, BEST)
    return walker


@pytest.mark.seldom(3, first=2)
@pytest.mark.parametrize("within", [0.05, 0.4, 3.0])
def test_a_grid_finds_the_obstacles_that_a_list_has_near_a_place(within: float) -> None:
    towers, wall = wood(1), Wall(20.0, 20.0, 1.0, 0.1, 0.3, 2.0)
    grid = ObstacleGrid((wall,), towers)
    every = [wall, *(Tower(*row) for row in towers.tolist())]
    for x, z in np.random.default_rng(2).uniform(-1.0, 41.0, (200, 2)):
        for at in ((x, z), (17.0 + x % 6, 17.0 + z % 6)):
            expected = {each for each in every if each.gap(*at)[0] < within}
            assert set(grid.near(*at, within)) == expected
    assert ObstacleGrid((), np.empty((0, 4))).near(3.0, 4.0, 9.0) == []


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.sweep(14, first=1)
def test_a_random_walk_enters_no_trunk_and_is_never_stuck(seed: int) -> None:
    grid, rng = solid_wood(seed), np.random.default_rng(seed)
    trunk = grid.towers[rng.integers(len(grid.towers))]
    walker = start(Pose(trunk[0], None, trunk[1], rng.uniform(0, 360)), FLAT, BEST)
    touched = 0
    for _ in range(40):
        homeward = math.degrees(math.atan2(20.0 - walker.x, walker.z - 20.0))
        walker = replace(walker, yaw=(homeward + rng.normal(0, 70)) % 360)
        walker = walk(walker, grid, 0.4, 12, forward=1.0, run=bool(rng.integers(2)))
        assert clearance(walker, grid) >= RADIUS - 1e-5
        touched += clearance(walker, grid) < RADIUS + 1e-3
        ways = [replace(walker, yaw=45.0 * k) for k in range(8)]
        ends = [walk(way, grid, 0.1, 3, forward=1.0) for way in ways]
        assert max(math.dist((w.x, w.z), (walker.x, walker.z)) for w in ends) > 0.05, "stuck"
    assert touched > 5, "the walk met too few trunks to prove anything"


@pytest.mark.seldom(10, first=3)
@pytest.mark.parametrize(("seed", "count"), [(0, 45), (1, 60), (2, 80)])
def test_from_every_free_place_in_a_wood_there_is_a_way_out(seed: int, count: int) -> None:
    towers = wood(seed, count, side=1.0)
    at = np.linspace(19.3, 20.7, 701)  # no gap that counts is narrower than two of its steps

    def open_to(some: np.ndarray) -> np.ndarray:
        free = np.ones((701, 701), bool)
        for x, z, radius, _ in some:
            free &= (at[None, :] - x) ** 2 + (at[:, None] - z) ** 2 > (radius + RADIUS) ** 2
        return free

    def closed_off(some: np.ndarray) -> int:
        """Return how many free places are not reached from the border."""
        free = open_to(some)
        reached, before = np.zeros_like(free), -1
        reached[0] = True
        while reached.sum() > before:
            before = reached.sum()
            for step, axis in ((1, 0), (-1, 0), (1, 1), (-1, 1)):
                reached = spread(reached, free, step, axis)
        return int((free & ~reached).sum())

    kept = without_pockets(towers, 40.0)
    assert closed_off(towers) > 100, "this wood has no pockets"
    # Between two discs that touch, a few places of the raster look enclosed.
    assert closed_off(towers[kept]) < 20
    assert kept.mean() > 0.6


def spread(reached: np.ndarray, free: np.ndarray, step: int, axis: int) -> np.ndarray:
    """Return what is reached in straight lines along an axis through free places."""
    one, open_ = (np.moveaxis(a, axis, 0)[::step] for a in (reached.copy(), free))
    for before, after, passable in zip(one, one[1:], open_[1:], strict=False):
        after |= before & passable
    return np.moveaxis(one[::step], 0, axis)


def test_a_ring_of_trunks_opens_and_a_clump_or_a_row_stays_solid() -> None:
    angle = np.arange(12) * (2 * np.pi / 12)
    ring = np.stack([20 + 0.3 * np.cos(angle), 20 + 0.3 * np.sin(angle)], axis=1)
    row = np.stack([np.linspace(18, 22, 40), np.full(40, 25.0)], axis=1)
    clump = np.array([(10.0, 10.0), (10.08, 10.0), (10.04, 10.07)])
    for places, expected in ((ring, 11), (row, 40), (clump, 3)):
        towers = np.insert(np.insert(places, 2, 0.04, axis=1), 3, 2.0, axis=1)
        assert without_pockets(towers, 40.0).sum() == expected
    # Nothing closes a gap to a wall or to the border either.
    towers = np.array([(20.15, 20.0, 0.04, 2.0), (0.15, 9.0, 0.04, 2.0), (30.0, 9.0, 0.04, 2.0)])
    assert without_pockets(towers, 40.0, [Tower(20.0, 20.0, 0.06, 2.0)]).tolist() == [0, 0, 1]


def test_a_walker_slides_around_a_trunk() -> None:
    grid = ObstacleGrid((), np.array([(20.0, 18.5, 0.04, 1.5)]))
    walker = start(Pose(20.02, None, 20.0), FLAT, BEST)
    walker = walk(walker, grid, 4.0, 120, forward=1.0)
    assert walker.z < 17.5
    assert abs(walker.x - 20.0) == pytest.approx(0.09, abs=0.01)


def test_trees_block_by_their_trunks_and_deer_by_their_bodies() -> None:
    cells = np.array([0, 1, 4, PLANT])
    sizes = np.array([(0.5, 0.6), (0.4, 0.5), (0.12, 0.14), (0.05, 0.06)])
    places = np.array([(1.0, 2.0, 3.0)] * 4)
    found = trunks(Sprites(places, sizes, cells, np.zeros(4, bool)))
    expected = [(1, 3, THICK[c] * w, 2 + h) for c, (w, h) in zip(cells[:3], sizes[:3], strict=True)]
    assert found == pytest.approx(np.array(expected))


def in_yard(x: float, z: float) -> tuple[float, float]:
    """Return a position relative to the castle of YARD: across, and outwards through the gate."""
    a = math.radians(30.0)
    dx, dz = x - 20.0, z - 20.0
    return math.cos(a) * dx - math.sin(a) * dz, -(math.sin(a) * dx + math.cos(a) * dz)


def facing_gate(outward: float, across: float = 0.0, yaw: float = 0.0) -> Walker:
    """Return a walker on the axis of the gate, looking out of it, turned by ``yaw``."""
    a = math.radians(30.0)
    x = 20.0 + math.cos(a) * across - math.sin(a) * outward
    z = 20.0 - math.sin(a) * across - math.cos(a) * outward
    return start(Pose(x, None, z, yaw - 30.0), FLAT, BEST)


def test_the_gate_is_shut_from_outside_and_opens_from_within() -> None:
    assert any(isinstance(each, Gate) for each in YARD)
    outside = walk(facing_gate(1.0, yaw=180.0), YARD, 3.0, 90, forward=1.0)
    assert in_yard(outside.x, outside.z)[1] == pytest.approx(0.5 + RADIUS, abs=1e-3)
    left = walk(facing_gate(0.0), YARD, 3.0, 90, forward=1.0)
    assert in_yard(left.x, left.z)[1] > 1.0
    back = walk(replace(left, yaw=(left.yaw + 180.0) % 360), YARD, 6.0, 180, forward=1.0)
    assert in_yard(back.x, back.z)[1] == pytest.approx(0.5 + RADIUS, abs=1e-3)
    beside = walk(facing_gate(0.2, across=0.25), YARD, 3.0, 90, forward=1.0)
    assert in_yard(beside.x, beside.z)[1] < 0.5
    over = replace(facing_gate(0.2), y=1.6, flying=True)
    for _ in range(60):
        over = advance(over, Intent(forward=1.0), 1 / 30, FLAT, YARD, BEST)
    assert in_yard(over.x, over.z)[1] < 0.5, "the wall above the gate is solid"


@pytest.mark.seldom(13, first=10)
@pytest.mark.parametrize("seed", range(6))
def test_whoever_lands_in_the_yard_can_walk_out(seed: int) -> None:
    rng = np.random.default_rng(seed)
    walker = facing_gate(*rng.uniform(-0.3, 0.3, 2))
    for _ in range(400):
        walker = replace(walker, yaw=rng.uniform(0, 360))
        walker = walk(walker, YARD, 0.5, 5, forward=1.0)
        if in_yard(walker.x, walker.z)[1] > 0.5:
            return
    raise AssertionError("still in the yard")


def test_without_the_setting_the_walls_are_those_of_before() -> None:
    assert not Settings().walk.solid and BEST.walk.solid
    plain = courtyard(20.0, 20.0, 30.0, 0.045, 2.0, (0.13, 2.2))
    assert len(plain) == 8 and not any(isinstance(each, Gate) for each in plain)
