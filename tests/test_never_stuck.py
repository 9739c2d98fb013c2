"""Nobody is ever stuck: out of cracks, pits and doors one comes by walking on."""

import math
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace

import numpy as np
import pytest
from sweeps import Todays

from landscape.elements.settings import preset
from landscape.frame import Pose
from landscape.geometry.bodies import Body, Wish
from landscape.geometry.doors import Door
from landscape.geometry.height_field import HeightField
from landscape.geometry.obstacle_grid import ObstacleGrid, Obstacles
from landscape.geometry.obstacles import Tower, Wall, courtyard
from landscape.geometry.pockets import without_pockets
from landscape.hall.entrance import door
from landscape.hall.hall import SCENE, Ground, obstacles
from landscape.island.island import SCENE as ISLAND
from landscape.offscreen import Offscreen
from landscape.scene.scene import SceneSettings
from landscape.voxel import body as bodies
from landscape.voxel.blocks import AIR, block
from landscape.voxel.voxel import SCENE as VOXEL
from landscape.walk.escape import PATIENCE, moved
from landscape.walk.place import Place, at_doors
from landscape.walk.walker import Intent, Walker, start

BEST = preset("best")
FLAT = HeightField(np.full((50, 50), 1.3, np.float32), 40.0, 0.6)
# The boulders on the way from the default start straight ahead to the castle: x, z, radius, top.
BOULDERS = np.array(
    [
        (23.898, 12.161, 0.0725, 1.420),
        (23.860, 12.249, 0.1153, 1.460),
        (23.611, 12.410, 0.0955, 1.427),
        (23.602, 12.472, 0.1317, 1.469),
        (23.930, 12.372, 0.0693, 1.560),
    ]
)
AHEAD = Intent(forward=1.0)
FOUR_WAYS = (AHEAD, Intent(forward=-1.0), Intent(right=1.0), Intent(right=-1.0))


@dataclass
class Land:
    """What a walker moves in: a ground, obstacles, settings and perhaps doors."""

    ground: object
    obstacles: Obstacles = ()
    settings: SceneSettings = BEST

    def begin(self, *pose: float) -> Walker:
        x, z, yaw = pose
        return start(Pose(x, None, z, yaw), self.ground, self.settings)

    def go(self, walker: Walker, intent: Intent, seconds: float, frames: int = 15) -> Walker:
        for _ in range(frames):
            walker = moved(
                walker, intent, seconds / frames, self.ground, self.obstacles, self.settings
            )
        return walker

    def dead_ends(self, starts: Iterable[int], steps: int) -> list[Walker]:
        """Return where random walks end in places that none of the four ways leads out of."""
        found = []
        for seed in starts:
            rng = np.random.default_rng(seed)
            x, z = rng.uniform(0.2, self.ground.size - 0.2, 2)
            walker = self.begin(x, z, rng.uniform(0, 360))
            for _ in range(steps):
                walker = replace(walker, yaw=rng.uniform(0, 360))
                hurries = Intent(forward=1.0, run=bool(rng.integers(2)))
                walker = self.go(walker, hurries, rng.uniform(0.3, 2.5), 8)
                ways = (self.go(walker, way, 0.4, 4) for way in FOUR_WAYS)
                if not any(distance(way, walker) > 0.05 for way in ways):
                    late = self.go(walker, AHEAD, PATIENCE + 1.0, 12)
                    if distance(late, walker) < 0.1:
                        found.append(walker)
        return found


def distance(a: Walker, b: Walker) -> float:
    return math.dist((a.x, a.z), (b.x, b.z))


def test_from_the_default_start_straight_on_one_is_let_out_of_the_boulders() -> None:
    land = Land(FLAT, ObstacleGrid((), BOULDERS))
    pose = ISLAND.views[ISLAND.start].pose
    before = land.go(land.begin(pose.x, pose.z, pose.yaw), AHEAD, 5.0, 75)
    assert before.escapes == 0 and distance(before, land.go(before, AHEAD, 0.2)) < 0.01
    after = land.go(before, AHEAD, 3.0, 45)
    assert after.escapes == 1
    assert 0.5 < distance(after, before) < 3.0
    x, z, radius, _ = BOULDERS.T
    assert (np.hypot(x - after.x, z - after.z) > radius).all()


def test_before_a_wall_in_a_corner_and_at_a_trunk_one_stays() -> None:
    walls = (Wall(20.0, 19.0, 2.0, 0.1, 0.0, 9.0), Wall(21.0, 20.0, 0.1, 2.0, 0.0, 9.0))
    corner = Wall(20.0, 19.0, 2.0, 0.1, 0.0, 9.0), Tower(20.6, 19.1, 0.5, 9.0)
    trunk = (Tower(20.0, 19.5, 0.05, 9.0),)
    for around, yaw in ((walls[:1], 0.0), (walls, 45.0), (corner, 15.0), (trunk, 0.0)):
        land = Land(FLAT, around)
        there = land.go(land.begin(20.0, 20.0, yaw), AHEAD, 4.0, 60)
        assert land.go(there, AHEAD, 6.0, 60).escapes == 0, around


def test_straight_on_in_the_hall_one_is_let_out_from_between_column_and_plinth() -> None:
    land = Land(Ground(), obstacles(), SCENE.settings)
    pose = SCENE.views[SCENE.start].pose
    runs = Intent(forward=1.0, run=True)
    before = land.go(land.begin(pose.x, pose.z, pose.yaw), runs, 4.0, 60)
    assert before.escapes == 0 and distance(before, land.go(before, runs, 0.5)) < 0.02
    after = land.go(before, runs, 4.0, 60)
    assert after.escapes == 1
    assert distance(after, before) > 0.2


def test_nobody_is_let_out_through_a_wall() -> None:
    yard = courtyard(20.0, 20.0, 0.0, 0.045, 9.0, (0.13, 9.0))
    inside = [(20.0 + x, 20.0 + z, 0.11, 9.0) for x, z in ((0.1, -0.2), (-0.1, -0.2))]
    land = Land(FLAT, (*yard, *(Tower(*each) for each in inside)))
    walker = land.go(land.begin(20.0, 20.1, 0.0), AHEAD, 6.0, 90)
    assert walker.escapes > 0
    assert max(abs(walker.x - 20.0), abs(walker.z - 20.0)) < 0.5


class Pit:
    """Blocks with a shaft that is one block wide and three deep."""

    scale = 0.08
    size = 24 * scale

    def __init__(self) -> None:
        self.blocks = np.full((24, 24, 20), AIR, np.uint8)
        self.blocks[:, :, :6] = block("rock")
        self.blocks[12, 12, 3:] = AIR

    def height(self, x: float, z: float) -> float:
        return self.scale * (3 if (int(x / self.scale), int(z / self.scale)) == (12, 12) else 6)

    def moved(self, body: Body, wish: Wish, seconds: float) -> Body:
        inside = body.scaled(1 / self.scale), wish.scaled(1 / self.scale)
        return bodies.moved(bodies.Place(self.blocks), *inside, seconds).scaled(self.scale)


def test_out_of_a_pit_one_is_let_out_but_not_while_one_digs() -> None:
    land = Land(Pit(), (), VOXEL.settings)

    def level(walker: Walker) -> float:
        assert walker.body is not None
        return walker.body.y / Pit.scale

    down = land.begin(1.0, 1.0, 0.0)
    assert level(land.go(down, AHEAD, 1.9)) == pytest.approx(3, abs=0.01)
    assert level(land.go(down, replace(AHEAD, digging=True), 5.0)) == pytest.approx(3, abs=0.01)
    out = land.go(down, AHEAD, 3.0, 45)
    assert (out.escapes, level(out)) == (1, pytest.approx(6, abs=0.01))


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.sweep(12)
def test_no_random_walk_ends_in_a_place_without_a_way_out(seed: int) -> None:
    rng = np.random.default_rng(seed)
    x, z = rng.uniform(17.0, 23.0, (2, 400))
    towers = np.stack([x, z, rng.uniform(0.016, 0.15, 400), np.full(400, 2.0)], axis=1)
    wood = Land(FLAT, ObstacleGrid((), towers[without_pockets(towers, 40.0)]))
    hall = Land(Ground(), obstacles(), SCENE.settings)
    for land in (wood, hall):
        assert not land.dead_ends(range(20 * seed, 20 * seed + 20), 6)


@pytest.mark.seldom(14, first=10)
@pytest.mark.parametrize("view", ["fig35e", "voxel_bay"])
def test_no_random_walk_on_the_whole_island_ends_without_a_way_out(
    view: str, todays: Todays
) -> None:
    with opened(view) as land:
        assert not land.dead_ends(todays(range(200), 4, 14), 10)


@contextmanager
def opened(view: str) -> Iterator[Land]:
    """Open the scene of a view with all that stands in it."""
    with Offscreen(size=(64, 48)) as offscreen:
        offscreen.look(view)
        offscreen.draw()
        yield Land(offscreen.scene, offscreen.scene.obstacles, offscreen.scene.settings)


# Doors.

GATE = Door("gate", 20.0, 20.0, 0.0, 0.1, 1.0, 1.66, "hall", "door", "")
# The wall with its gate, whose passage is filled.
FRONT = (
    Wall(20.0, 19.97, 0.5, 0.0225, 0.0, 9.0),
    *(Tower(x, 20.0, 0.13, 9.0) for x in (19.5, 20.5)),
)


class Yard(HeightField):
    """Flat land with a gate."""

    obstacles = FRONT
    doors = (GATE,)


@pytest.mark.parametrize("frame", [1 / 60, 1 / 8, 0.5])
def test_who_walks_at_the_wall_beside_a_gate_is_led_to_it(frame: float) -> None:
    place = Place(ISLAND, BEST, None)
    place._scene = Yard(np.full((50, 50), 1.3, np.float32), 40.0, 0.6)
    for aside in (-0.3, -0.12, 0.12, 0.3):
        for yaw in (-12.0, 0.0, 12.0):
            walker = start(Pose(20.0 + aside, None, 20.3, yaw), place.scene, BEST)
            for _ in range(int(4.0 / frame)):
                walker = place.moved(walker, AHEAD, frame)
                if at_doors(place.doors, walker, AHEAD)[0]:
                    break
            assert at_doors(place.doors, walker, AHEAD)[0] is GATE, (aside, yaw)
    beside = start(Pose(20.3, None, 20.3, 80.0), place.scene, BEST)
    assert place.moved(beside, Intent(), frame).x == pytest.approx(20.3)


@pytest.mark.parametrize(
    "intent", [AHEAD, Intent(forward=-1.0), Intent(right=1.0), Intent(forward=-1.0, right=-1.0)]
)
def test_who_goes_on_behind_a_door_comes_away_from_it(intent: Intent) -> None:
    inside = Place(SCENE, SCENE.settings, None)
    inside._scene = land = Ground()
    land.obstacles, land.doors = obstacles(), (door(),)
    walker = start(inside.way_in(GATE, intent), land, SCENE.settings)
    for _ in range(6):
        before = walker
        walker = inside.moved(walker, intent, 0.05)
        assert at_doors(inside.doors, walker, intent)[0] is None
        assert walker.z < before.z, "towards the door"
