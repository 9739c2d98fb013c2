"""Doors between scenes: where one goes through, what goes along, and the walk there and back."""

import dataclasses
import json
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from castles import BRICK, GATE, PLACED, at, drawn
from commands import environment, python
from stage import Stage, close, pixel, project

from framelens.base.errors import InputError
from landscape.elements.best.castle import ornate_castle, weathered_castle
from landscape.elements.best.castle.open_door import DARK, GLOW, HALF, glow, half_arch, turned
from landscape.elements.settings import preset
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.doors import BEFORE, REACH, Door
from landscape.geometry.obstacles import RADIUS
from landscape.hall import plan
from landscape.hall.entrance import door
from landscape.hall.hall import SCENE, Ground, obstacles
from landscape.island.island import Island
from landscape.scene.scene import SCENES
from landscape.settings.declare import with_settings
from landscape.walk import recording
from landscape.walk.place import Places, at_doors
from landscape.walk.recording import Plan, Tick
from landscape.walk.walker import Intent, Walker, advance, start

pytestmark = pytest.mark.window

EAST = Door("gate", 5.0, 5.0, 90.0, 0.1, 1.0, 1.4, "cellar", "stairs", "the door leads down")


def walker(front: float, right: float = 0.0, yaw: float = 90.0, y: float = 1.1) -> Walker:
    """Return one who stands in front of the door EAST, and to the right of its middle."""
    return Walker(5.0 - front, y, 5.0 + right, yaw)


def entered(who: Walker, door: Door = EAST, **intent: float) -> bool:
    return at_doors([door], who, Intent(**intent))[0] is door


def test_a_door_is_entered_by_walking_through_its_strip_in_its_direction() -> None:
    assert entered(walker(0.06), forward=1) and entered(walker(0.01, 0.09), forward=1)
    assert not entered(walker(REACH + 0.001), forward=1)
    assert not entered(walker(-0.01), forward=1), "from behind"
    assert not entered(walker(0.06, 0.11), forward=1), "beside it"
    assert not entered(walker(0.06)), "standing still"
    assert not entered(walker(0.06, yaw=160.0), forward=1), "along the wall"
    assert not entered(walker(0.06, yaw=270.0), forward=1), "on the way out"


def test_a_door_is_also_entered_backwards_sideways_and_flying_under_its_top() -> None:
    assert entered(walker(0.06, yaw=270.0), forward=-1)
    assert entered(walker(0.06, yaw=0.0), right=1) and entered(walker(0.06, yaw=180.0), right=-1)
    assert entered(walker(0.06, yaw=45.0), forward=1, right=1)
    assert entered(walker(0.06, y=1.39), forward=1)
    assert not entered(walker(0.06, y=1.41), forward=1), "over it"


def test_a_shut_door_is_not_entered_but_faced_and_one_comes_out_of_it_clear_of_its_strip() -> None:
    shut = dataclasses.replace(EAST, open=False)
    assert not entered(walker(0.06), shut, forward=1)
    assert at_doors([shut], walker(0.3), Intent())[1] is shut
    assert at_doors([shut], walker(0.3, yaw=270.0), Intent())[1] is None, "looks away"
    assert at_doors([shut], walker(0.9), Intent())[1] is None, "too far"
    pose = shut.way_out
    assert (pose.x, pose.y, pose.yaw) == (pytest.approx(5.0 - BEFORE), None, 270.0)
    assert pose.z == pytest.approx(5.0) and BEFORE > REACH > RADIUS


@pytest.mark.parametrize("yaw", [-160.0, 0.0, 35.0])
@pytest.mark.sweep(12, first=8)
def test_the_castles_door_is_where_its_gate_is_drawn(
    stage: Stage, yaw: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Its light, which takes a second, has no part in this.
    dark = np.zeros((8, 8, 3), np.uint8)
    monkeypatch.setattr(ornate_castle, "recall", lambda parts, make: make())
    for module, name in ((ornate_castle, "light_map"), (weathered_castle, "worn_light_map")):
        monkeypatch.setattr(
            module, name, lambda mesh, *_: (dark, np.zeros((len(mesh.vertices), 2), np.float32))
        )

    values = with_settings(preset("best"), {**PLACED, "castle.yaw": yaw})
    island = Island(values, Assets(), only=("castle",))
    (gate,) = island.doors
    x, y, z = island.castle.base
    turn = math.radians(yaw)

    # The gate's place in the castle's own frame, about its middle, is (0, -0.5).
    assert (gate.x, gate.z) == pytest.approx((x - 0.5 * math.sin(turn), z - 0.5 * math.cos(turn)))
    assert math.cos(math.radians(gate.yaw - (180.0 - yaw))) == pytest.approx(1.0)
    assert gate.bottom == y and gate.open and (gate.scene, gate.to) == ("hall", "door")
    assert island.apply(with_settings(values, {"castle.open": False}))
    assert not island.doors[0].open
    island.release()


def test_in_2006_the_castles_door_is_shut_and_without_a_castle_there_is_none(stage: Stage) -> None:
    for only, found in ((("castle",), [False]), (("ground",), [])):
        island = Island(preset("2006"), Assets(), only=only)
        assert [each.open for each in island.doors] == found
        island.release()


@pytest.mark.seldom(7, first=4)
def test_behind_the_open_door_the_glow_fades_upwards_between_two_leaves(
    stage: Stage, plain_folder
) -> None:
    keys: dict[str, Any] = {"castle__ornate": True, "castle__multitexture": True}
    shut, wide = (
        drawn(stage, Assets(plain_folder), castle__open=flag, **keys) for flag in (False, True)
    )
    for height in (0.1, 0.2, 0.3):  # a pixel is 0.01 high
        got = pixel(wide, project(GATE, at(0.5, height)))
        assert close(got, 255 * glow(np.array([height]))[0], 6)
        assert not close(pixel(shut, project(GATE, at(0.5, height))), got, 10)
    wall = project(GATE, at(0.5, 0.6))
    assert close(pixel(wide, wall), pixel(shut, wall), 0) and pixel(wide, wall).max() < BRICK.max()
    assert np.allclose(glow(np.array([0.0]))[0], GLOW)
    assert np.allclose(glow(np.array([9.0]))[0], DARK)


def test_the_leaves_hang_at_the_sides_of_the_opening_and_open_outwards() -> None:
    outline = half_arch()
    assert outline[0].tolist() == [HALF, 0.0]
    assert outline[-1] == pytest.approx((0.0, 0.364), abs=0.001)
    for side in (1, -1):
        leaf = turned(outline, side)
        assert leaf[0] == pytest.approx((0.5 + side * HALF, 0.0, -0.002))
        assert (leaf[:, 2] <= -0.002).all()
        # Nothing of it is left in the passage, and it is as wide as it was.
        assert (side * (leaf[:, 0] - 0.5) >= HALF - 1e-9).all()
        across = np.hypot(leaf[-1, 0] - leaf[0, 0], leaf[-1, 2] - leaf[0, 2])
        assert across == pytest.approx(HALF)


def test_what_the_user_has_set_goes_along_where_the_other_scene_has_it() -> None:
    given = {"walk.speed": 0.5, "grass.count": 7, "camera.fov": 80.0}
    places = Places(Plan("island", preset("best"), "", Pose(1, 1, 1), (8, 8), given=given))
    place = places.behind(door_to("hall"))
    assert place.settings == SCENE.settings
    place.kind = dataclasses.replace(place.kind, open=lambda *_: Ground())
    places.give({"camera.fov": 70.0, "fog.enabled": True})
    places.enter(place, Assets(), 0)
    values = place.settings
    assert (values.walk.speed, values.camera.fov, values.fog.enabled) == (0.5, 70.0, True)
    assert values.sun == SCENE.settings.sun


def door_to(scene: str) -> Door:
    return dataclasses.replace(EAST, scene=scene)


def test_the_other_scene_has_the_same_preset_if_it_has_one_of_that_name() -> None:
    for name, wanted in (("best", "best"), ("2006", "2006")):
        places = Places(Plan("hall", SCENE.settings, "", Pose(1, 1, 1), (8, 8), preset=name))
        assert places.behind(door_to("island")).settings == preset(wanted)
    places = Places(Plan("island", preset("2006"), "", Pose(1, 1, 1), (8, 8), preset="2006"))
    assert places.behind(door_to("hall")).settings == SCENE.settings


def test_nothing_of_the_window_names_a_scene() -> None:
    names = "|".join(SCENES)
    for path in (Path(recording.__file__).parent).glob("*.py"):
        code = path.read_text(encoding="utf-8")
        assert not re.search(rf"[\"']({names})[\"']|landscape\.(island|effects|views)", code), path


# The hall, walked in without OpenGL.


@pytest.mark.sweep(5, first=4)
@pytest.mark.parametrize("seed", range(4))
def test_no_random_walk_in_the_hall_crosses_wall_pillar_plinth_or_pool(seed: int) -> None:
    rng, around = np.random.default_rng(seed), obstacles()
    who = start(door().way_out, Ground(), SCENE.settings)
    inside = plan.INSIDE
    pool = plan.POOL
    half = plan.PLINTH[0]
    reached = []
    for _ in range(400):
        intent = Intent(*rng.uniform(-1, 1, 2), turn=rng.uniform(-1, 1), run=rng.random() < 0.3)
        who = advance(who, intent, rng.uniform(0.01, 0.8), Ground(), around, SCENE.settings)
        x, z = who.x, who.z
        assert inside.west < x < inside.east and inside.north < z < inside.south
        for row in plan.ROWS:
            for bay in plan.BAYS[1:-1]:
                assert math.dist((x, z), (row, bay)) > plan.PILLAR
        assert max(abs(x - plan.STATUE[0]), abs(z - plan.STATUE[1])) > half
        assert not (pool.west < x < pool.east and pool.north < z < pool.south)
        assert who.y == pytest.approx(SCENE.settings.walk.eye, abs=0.004)
        reached.append((x, z))

    assert np.ptp(np.array(reached), axis=0).min() > 0.6, "he hardly moves"


def test_one_walks_from_the_door_around_the_pool_to_the_statue_and_out_again() -> None:
    who = start(door().way_out, Ground(), SCENE.settings)
    for x, z in ((1.36, 2.5), (1.36, 1.7), (1.6, 1.42), (1.36, 1.7), (1.36, 2.5), (1.6, 2.79)):
        for _ in range(60):
            yaw = math.degrees(math.atan2(x - who.x, who.z - z))
            who = dataclasses.replace(who, yaw=yaw)
            if math.dist((who.x, who.z), (x, z)) < 0.06:
                break
            who = advance(who, Intent(forward=1), 0.05, Ground(), obstacles(), SCENE.settings)
    assert at_doors([door()], who, Intent(forward=1))[0] == door()


# Through the door in a window: GLFW's null platform, drawn by OSMesa.

THROUGH = """
import hashlib, json, sys
from pathlib import Path
import glfw
from framelens.base.errors import InputError
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.doors import Doored
from landscape.scene.scene import scene
from landscape.walk.app import Walk
from landscape.walk.loop import run
from landscape.walk.recording import Plan, Tick, Writer, read
from landscape.walk.walker import Intent

island = scene("island")
given = {"walk.speed": 0.6, "ground.resolution": 30, "ground.texture_size": 64,
         "ground.stones": 500}
values = island.values(None, given)
plan = Plan("island", values, "", Pose(27.56, None, 17.6, 340.0), (64, 48), 20.0, 2006,
            only=("ground", "castle", "sword"), preset="best", given=given)

def frames(count, note="", changes={}, **intent):
    first = [Tick(0.05, Intent(**intent), (), (64, 48), note, "", changes)]
    return first + [Tick(0.05, Intent(**intent), (), (64, 48)) for _ in range(count - 1)]

TICKS = (frames(14, forward=1) + frames(6, "a note", {"mirror.fresnel": False}, forward=1)
         + frames(4, "", {"fog.enabled": False, "camera.fov": 50.0}) + frames(48, turn=1)
         + frames(20, forward=1) + frames(4, turn=1))

class Watched(Walk):
    def __init__(self, *arguments, **more):
        self.seen, self.said, self.waits, self.together = [], [], [], []
        super().__init__(*arguments, **more)
    def _say(self, message):
        self.said.append(message)
        super()._say(message)
    def _wait(self, text, **more):
        self.waits.append([text, *more.values()])
        draw, shown = self._panel.draw, []
        def noted(size, keys=False, message="", *rest, **more):
            shown.append(message)
            draw(size, keys, message, *rest, **more)
        self._panel.draw = noted
        super()._wait(text, **more)
        self._panel.draw = draw
        self.together.append(sum(map(bool, shown)))
    def present(self):
        place, walker = self.place, self.walker
        self.seen.append([hashlib.sha256(self.pixels()).hexdigest(), place.kind.name, walker.x,
                          walker.z, walker.yaw, place.settings.walk.speed,
                          place.settings.fog.enabled, place.settings.camera.fov, self.kt])
        super().present()

path = Path(sys.argv[1])
writer, first = Writer(path, plan), None
with Watched(plan, Assets(), "osmesa") as walk:
    first = id(walk.place.scene)
    run(walk, iter(TICKS), writer)
    back = id(walk.place.scene) == first
writer.finish()
again_plan, ticks = read(path)
with Watched(again_plan, Assets(), "osmesa") as again:
    run(again, iter(ticks))
print(json.dumps({"seen": walk.seen, "again": again.seen, "said": walk.said, "waits": walk.waits,
                  "together": walk.together, "back": back,
                  "same": [again_plan == plan, ticks == TICKS]}))
"""


@pytest.fixture(scope="module")
def through(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """A walk through the castle's door, in the hall, and back; and its replay."""
    path = tmp_path_factory.mktemp("through") / "a.jsonl"
    done = python(THROUGH, str(path), env=environment(LANG="C"))
    assert done.status == 0, done.err
    found: dict[str, Any] = json.loads(done.out)
    return found


@pytest.mark.seldom(12, first=3)
def test_one_walks_through_the_door_into_the_hall_and_back(through) -> None:
    scenes = [frame[1] for frame in through["seen"]]
    changes = [k for k in range(1, len(scenes)) if scenes[k] != scenes[k - 1]]
    assert [scenes[0], *(scenes[k] for k in changes)] == ["island", "hall", "island"]

    # He comes out of the door of each, with his back to it, and goes on walking.
    into, out = (through["seen"][k] for k in changes)
    assert into[2:5] == pytest.approx([1.6, 2.8 - BEFORE, 0.0])
    assert out[4] == pytest.approx(160.0)
    assert through["seen"][changes[0] + 3][3] < into[3]
    assert through["back"], "the island was opened again"
    assert through["waits"] == [
        ["loading"],
        ["opening", "the great hall"],
        ["opening", "the island"],
    ]
    assert through["together"] == [1, 1, 1], "messages over each other"
    for text in (
        "the door leads into the great hall",
        "the great hall",
        "a note",
        "the island",
        "the door leads out to the island",
    ):
        assert text in through["said"]


@pytest.mark.seldom(12, first=3)
def test_settings_of_both_scenes_go_along_and_the_clock_goes_on(through) -> None:
    speeds = {(frame[1], frame[5]) for frame in through["seen"]}
    assert speeds == {("island", 0.6), ("hall", 0.6)}
    assert through["seen"][0][6:8] == [True, pytest.approx(preset("best").camera.fov)]
    assert through["seen"][-1][6:8] == [False, 50.0]
    kt = [frame[8] for frame in through["seen"]]
    assert np.diff(kt) == pytest.approx(np.full(len(kt) - 1, kt[1] - kt[0]))


@pytest.mark.seldom(12, first=3)
def test_a_replay_goes_through_the_door_pixel_for_pixel(through) -> None:
    assert through["same"] == [True, True]
    assert through["again"] == through["seen"]
    assert len({frame[0] for frame in through["seen"]}) > 30


def test_a_recording_may_change_settings_of_another_scene_but_of_one_only(tmp_path: Path) -> None:
    island = Plan("island", preset("best"), "", Pose(1.0, 1.0, 1.0), (8, 8))

    def read(**changes: Any) -> dict[str, Any]:
        writer = recording.Writer(tmp_path / "a.jsonl", island)
        writer.add(Tick(0.1, Intent(), (), (8, 8), "", "mirror.strength", changes))
        writer.finish()
        return dict(recording.read(tmp_path / "a.jsonl")[1][0].changes)

    assert read(**{"mirror.strength": 0.5}) == {"mirror.strength": 0.5}
    for wrong in ({"mirror.strength": 2.0}, {"mirror.strength": 0.5, "grass.count": 5}):
        with pytest.raises(InputError, match=r"a\.jsonl:2"):
            read(**wrong)


def test_a_recording_from_before_there_were_doors_is_read(tmp_path: Path) -> None:
    writer = recording.Writer(
        tmp_path / "a.jsonl", Plan("island", preset("best"), "", Pose(1.0, 1.0, 1.0), (8, 8))
    )
    writer.add(Tick(0.1, Intent(), (), (8, 8)))
    writer.finish()
    first, *rest = (tmp_path / "a.jsonl").read_text().splitlines()
    head = {key: value for key, value in json.loads(first).items() if key != "given"}
    (tmp_path / "a.jsonl").write_text("\n".join([json.dumps(head), *rest]))
    assert recording.read(tmp_path / "a.jsonl")[0].given == {}
