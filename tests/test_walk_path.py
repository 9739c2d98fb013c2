"""A walk that begins with a flight along a drawn path."""

import json
from pathlib import Path

import numpy as np
import pytest
from commands import environment, landscape, python
from environments import ROUND, image, layer, path, svg, written

from landscape.elements.settings import Settings
from landscape.flyover.environment import Environment
from landscape.geometry.obstacles import Tower
from landscape.walk.course import Course
from landscape.walk.recording import Tick
from landscape.walk.walker import Intent, Walker

EAST = np.array([[(16, 32), (26, 32), (36, 32), (48, 32)]], np.float64)


class Meadow:
    """A flat map."""

    size = 40.0

    def height(self, x: float, z: float) -> float:
        """Return the height of the ground."""
        return 2.0


def tick(seconds: float = 0.5, **asked: object) -> Tick:
    return Tick(seconds, Intent(**asked), (), (64, 48))  # type: ignore[arg-type]


@pytest.fixture
def course() -> Course:
    drawn = Environment("test", np.zeros((64, 64), np.float32), (EAST,), np.zeros((0, 2)))
    return Course(drawn, Meadow(), Settings(), "en")


def test_the_walker_is_carried_along_the_path_at_eye_height(course: Course) -> None:
    walker = course.carried(Walker(1, 2, 3), 0.5)
    # 64 pixels are 40 units.
    assert (walker.x, walker.y, walker.z) == pytest.approx((10, 2 + Settings().walk.eye, 20))
    assert (walker.yaw, walker.flying) == (90, True)
    assert course.carried(walker, 0.5).x == pytest.approx(10 + 0.5 * 20 * 40 / 64)


def test_the_walker_flies_over_what_stands_on_his_way_and_not_through_it() -> None:
    wood = Meadow()
    wood.obstacles = (Tower(14.0, 20.0, 0.3, 4.5),)  # type: ignore[attr-defined]
    drawn = Environment("test", np.zeros((64, 64), np.float32), (EAST,), np.zeros((0, 2)))
    course = Course(drawn, wood, Settings(), "en")
    places = [course.carried(Walker(0, 0, 0), 0.02) for _ in range(60)]
    over = [walker.y for walker in places if abs(walker.x - 14.0) < 0.3]
    assert over and min(over) > 4.5


def test_what_the_mouse_and_the_turning_keys_ask_for_does_not_count_on_the_way(
    course: Course,
) -> None:
    taken = course.take(tick(turn=1.0, look=(30.0, 5.0), run=True))
    assert taken.intent == Intent() and "flying along the path" in taken.note
    assert course.take(tick()).note == ""


@pytest.mark.parametrize("asked", [{"forward": 1.0}, {"right": -1.0}, {"up": 1.0}, {"fly": True}])
def test_a_step_ends_the_flight_where_the_walker_is(course: Course, asked: dict) -> None:
    course.take(tick())
    walker = course.carried(Walker(0, 0, 0), 0.5)
    taken = course.take(tick(**asked))
    assert taken.note == "the path is left: flying" and not taken.intent.fly
    assert course.carried(walker, 0.5) == walker
    assert course.take(tick(turn=1.0)).intent.turn == 1.0


FLOWN = """
import json, sys
from pathlib import Path
from landscape.files.assets import Assets
from landscape.flyover.environment import open_environment
from landscape.scene.scene import find_view
from landscape.walk.app import Walk
from landscape.walk.course import Course
from landscape.walk.loop import run
from landscape.walk.recording import Plan, Tick
from landscape.walk.walker import Intent

kind, view = find_view("fig35a")
values = kind.values("2006", {"ground.resolution": 40})
plan = Plan("island", values, "", view.pose, (64, 48), only=("ground",))
seen = []

class Watched(Walk):
    def present(self):
        walker, scene = self.walker, self.place.scene
        over = walker.y - float(scene.height(walker.x, walker.z))
        seen.append([walker.x, walker.z, over, int(self.pixels().astype(int).sum())])
        super().present()

with Watched(plan, Assets(), "osmesa") as walk:
    ticks = [Tick(1.0, Intent(), (), (64, 48))] * 6 + [Tick(0.2, Intent(forward=1), (), (64, 48))]
    course = Course(open_environment(sys.argv[1]), walk.place.scene, values, "en")
    run(walk, iter(ticks), course=course)
print(json.dumps(seen))
"""


@pytest.mark.seldom(3, first=2)
def test_the_window_flies_along_the_path_and_walks_on_from_there(tmp_path: Path) -> None:
    file = written(tmp_path, svg(image(), layer(path(ROUND))))
    done = python(FLOWN, str(file), env=environment())
    assert done.status == 0, done.err
    x, z, over, shades = np.array(json.loads(done.out)).T
    # It starts at pixel (10, 32) of 64, on a map of 40 units, and goes 20 pixels a second.
    assert (x[0], z[0]) == pytest.approx((10 * 40 / 64, 20))
    steps = np.hypot(np.diff(x), np.diff(z))
    assert steps[:5].min() > 0.8 * 12.5 and steps[:5].max() <= 12.5 + 1e-6
    assert over.min() > 0.05
    assert len(set(shades)) == len(shades), "the picture changes with the place"
    assert 0.1 < steps[5] < 1, "the walker's own step begins where the flight was left"


@pytest.mark.sweep(2)
@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["--path", "gone.svg"], "gone.svg"),
        (["--path", "alps", "--record", "a.jsonl"], "--path"),
        (["--path", "alps", "--replay", "tour"], "--path"),
        (["--path", "alps", "--pose", "1,1,1,0,0"], "--pose"),
    ],
)
def test_a_path_that_cannot_be_flown_is_refused(
    words: list[str], reason: str, tmp_path: Path
) -> None:
    done = landscape("walk", "--backend", "osmesa", "--frames", "1", *words, cwd=tmp_path)
    assert done.status == 2 and done.err.count("\n") == 1
    assert done.err.startswith("landscape: ") and reason in done.err
    assert not list(tmp_path.iterdir())


@pytest.mark.seldom(13, first=1)
def test_the_command_flies_along_a_path() -> None:
    words = ["fig35a", "--path", "canyon", "--size", "64x48", "--only", "ground", "--frames", "2"]
    words += ["--set=ground.texture_size=256", "--set=ground.stones=500"]
    done = landscape("walk", "--backend", "osmesa", *words)
    assert (done.status, done.err) == (0, "")
