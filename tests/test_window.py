"""The window: scripted on GLFW's null platform, and with real key events under Xvfb.

GLFW's null platform runs the real window code with no screen. It has no key events: those come
from xdotool under Xvfb. Each window lives in a process of its own.
"""

import contextlib
import json
import math
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import glfw
import numpy as np
import pytest
from commands import SECONDS, TESTS, end, environment, landscape, need_library, python, running
from PIL import Image
from stage import SMALL_BEST
from sweeps import Todays

from landscape.elements.settings import preset
from landscape.files.assets import Assets
from landscape.files.images import read_heights
from landscape.frame import Pose
from landscape.geometry.height_field import height_field
from landscape.settings.declare import with_settings
from landscape.walk import recording
from landscape.walk.recording import Plan, Tick
from landscape.walk.walker import Intent, Walker, advance, start

pytestmark = pytest.mark.window

SET = [word for key, value in SMALL_BEST.items() for word in ("--set", f"{key}={value}")]
COARSE = [f"--set={key}={value}" for key, value in SMALL_BEST.items() if key.startswith("ground.")]
PRESS, RELEASE = glfw.PRESS, glfw.RELEASE


# GLFW's null platform, drawn by OSMesa.

SCRIPTED = """
import hashlib, json, sys, time
from pathlib import Path
import glfw
from landscape.walk.app import Walk
from landscape.walk.loop import run
from landscape.files.assets import Assets
from landscape.frame import Pose
from framelens.gl.seam import gl
from landscape.walk.recording import Plan, Writer, read
from landscape.elements.settings import preset
from landscape.settings.declare import with_settings
sys.path.insert(0, sys.argv[3])
from watching import colours

class Watched(Walk):
    script, seen, rested = {}, [], 0
    def resting(self):
        resting = super().resting()
        if resting:
            self.rested += 1
            if self.rested % 3 == 0:
                glfw.restore_window(self.window)
                glfw.set_window_size(self.window, 160, 120)
        return resting
    def listen(self):
        for event in self.script.pop(len(self.seen), ()):
            event(self)
        return super().listen()
    def present(self):
        pixels = self.pixels()
        self.seen.append({
            "size": self._size, "shape": pixels.shape, "hash": hashlib.sha256(pixels).hexdigest(),
            "colours": colours(pixels),
            "pose": [self.walker.x, self.walker.y, self.walker.z, self.walker.yaw],
            "stroke": self.walker.stroke, "kt": self.kt, "error": int(gl.glGetError()),
        })
        super().present()

def press(*keys): return lambda walk: [walk.hands.key(key, glfw.PRESS) for key in keys]
def release(*keys): return lambda walk: [walk.hands.key(key, glfw.RELEASE) for key in keys]
def size(w, h): return lambda walk: glfw.set_window_size(walk.window, w, h)
def focus(walk):
    glfw.focus_window(walk.window)
def focus_lost(walk):
    other = glfw.create_window(32, 32, "another", None, None)
    glfw.focus_window(other)
    glfw.destroy_window(other)
def capture(walk):
    walk.hands.button(glfw.MOUSE_BUTTON_LEFT, glfw.PRESS)
def move(x, y): return lambda walk: walk.hands.motion(x, y)

path, changes = Path(sys.argv[1]), json.loads(sys.argv[2])
values = with_settings(preset(sys.argv[4]), changes)
plan = Plan("island", values, "", Pose(20.0, None, 30.0, 190.0), (160, 120), 20.0, 2006)
live = Watched(plan, Assets(), "osmesa")
live.seen, live.script = [], {
    2: [press(glfw.KEY_W, glfw.KEY_E)], 4: [size(97, 61)], 6: [size(1, 1)], 7: [size(160, 120)],
    8: [press(glfw.KEY_G)], 9: [press(glfw.KEY_R, glfw.KEY_T)], 10: [press(glfw.KEY_H)],
    11: [press(glfw.KEY_X, glfw.KEY_M)], 12: [press(glfw.KEY_H)],
    13: [capture], 14: [move(500, 5)], 15: [move(540, 0)],
    16: [lambda walk: glfw.iconify_window(walk.window)], 18: [size(0, 0)],
    19: [focus, press(glfw.KEY_W), capture], 20: [focus_lost],
    22: [press(glfw.KEY_F, glfw.KEY_SPACE)], 24: [press(glfw.KEY_F11)], 25: [press(glfw.KEY_F11)],
    26: [press(glfw.KEY_F12)], 27: [press(glfw.KEY_L, glfw.KEY_DOWN, glfw.KEY_KP_ADD)],
    28: [press(glfw.KEY_DOWN, glfw.KEY_DOWN, glfw.KEY_ENTER)],
    29: [lambda walk: glfw.set_window_should_close(walk.window, True)],
}
writer = Writer(path, plan)
with live:
    drawn = run(live, writer=writer, frames=1000)
    mode = glfw.get_input_mode(live.window, glfw.CURSOR) == glfw.CURSOR_NORMAL
    # The window is closed inside the block, and once more on leaving it.
    live.close()
writer.finish()
plan, ticks = read(path)
again = Watched(plan, Assets(), "osmesa")
again.seen = []
with again:
    run(again, iter(ticks))
print(json.dumps({"live": live.seen, "again": again.seen, "drawn": drawn, "rested": live.rested,
                  "released": mode}))
"""


@pytest.fixture(scope="module")
def scripted(tmp_path_factory: pytest.TempPathFactory, todays: Todays) -> dict[str, Any]:
    """Two walks on the null platform: a scripted one, and its replay.

    The preset best takes longer, and is walked on every fifth day.
    """
    name = todays(["best", *["2006"] * 4], 5)[0]
    folder = tmp_path_factory.mktemp("scripted")
    code = f"import os; os.chdir({str(folder)!r})\n{SCRIPTED}"
    changes = SMALL_BEST | {"walk.mouse_relative": True}
    words = (str(folder / "a.jsonl"), json.dumps(changes), str(TESTS), name)
    done = python(code, *words, env=environment(LANG="C"))
    assert done.status == 0, done.err
    plan, ticks = recording.read(folder / "a.jsonl")
    return json.loads(done.out) | {"folder": folder, "plan": plan, "ticks": ticks}


def test_a_scripted_walk_draws_frames_and_leaves_when_the_window_is_closed(scripted) -> None:
    live = scripted["live"]
    assert scripted["drawn"] == len(live) == 29
    assert all(frame["error"] == 0 for frame in live)
    assert all(frame["colours"] > 1000 for frame in live if frame["size"] == [160, 120])


def test_the_clock_follows_the_seconds_not_the_frames(scripted) -> None:
    seconds = np.cumsum([tick.seconds for tick in scripted["ticks"]])
    rate = scripted["plan"].settings.clock.kt_per_second
    kt = [frame["kt"] for frame in scripted["live"]]
    assert kt == pytest.approx((20.0 + rate * seconds).tolist())
    assert kt[-1] > kt[0] >= 20.0


def test_keys_walk_and_strike_on_the_null_platform(scripted) -> None:
    live = scripted["live"]
    assert math.dist(live[1]["pose"][:3:2], live[15]["pose"][:3:2]) > 0.005
    assert live[1]["stroke"] == 0
    assert live[2]["stroke"] == 1


def test_a_resize_to_odd_sizes_and_to_one_pixel_is_drawn_at_that_size(scripted) -> None:
    sizes = [frame["size"] for frame in scripted["live"]]
    assert sizes[4] == sizes[5] == [97, 61]
    assert sizes[6] == [1, 1]
    assert sizes[7] == [160, 120]
    assert all(frame["shape"] == [*frame["size"][::-1], 3] for frame in scripted["live"])
    assert scripted["live"][5]["colours"] > 500


def test_a_minimised_window_or_one_without_area_rests(scripted) -> None:
    assert scripted["rested"] == 6
    assert scripted["live"][19]["size"] == [160, 120]


def test_losing_the_focus_releases_keys_and_cursor_on_the_null_platform(scripted) -> None:
    forward = [tick.intent.forward for tick in scripted["ticks"]]
    # Once when it is minimised, once when another window is clicked.
    assert forward == [0.0] * 2 + [1.0] * 14 + [0.0] * 3 + [1.0] + [0.0] * 9
    assert scripted["released"]


def test_the_captured_mouse_turns_the_view_on_the_null_platform(scripted) -> None:
    looks = [tick.intent.look for tick in scripted["ticks"]]
    assert looks[13] == looks[14] == (0.0, 0.0)
    assert looks[15] == (40.0, -5.0)


def test_full_screen_can_be_entered_and_left(scripted) -> None:
    sizes = [frame["size"] for frame in scripted["live"]]
    assert sizes[24] != [160, 120]
    assert sizes[25] == sizes[28] == [160, 120]


def test_a_screenshot_is_the_frame_as_shown(scripted) -> None:
    import hashlib

    picture = np.asarray(Image.open(scripted["folder"] / "screenshot-0001.png"))
    assert hashlib.sha256(picture).hexdigest() == scripted["live"][26]["hash"]
    left = {path.name for path in scripted["folder"].iterdir()}
    assert left == {"a.jsonl", "screenshot-0001.png"}


def test_every_switch_changes_the_picture(scripted) -> None:
    done = [name for tick in scripted["ticks"] for name in tick.actions]
    assert done == ["fog", "reflection", "sorting", "help", "wireframe", "map", "help"]
    # The clock runs as well: what one switch alone does is seen in the test after this one.
    hashes = [frame["hash"] for frame in scripted["live"]]
    assert len(set(hashes[7:13])) == 6


def test_settings_changed_in_the_list_are_recorded_by_their_values(scripted) -> None:
    first, second = scripted["ticks"][27:29]
    assert (first.row, first.changes) == ("camera.fov", {"camera.fov": 62.0})
    cull = not scripted["plan"].settings.camera.cull
    assert (second.row, second.changes) == ("camera.cull", {"camera.cull": cull})
    hashes = [frame["hash"] for frame in scripted["live"]]
    assert len(set(hashes[26:29])) == 3


STILLS = """
import hashlib, json, sys
from landscape.walk.app import Walk
from landscape.walk.loop import run
from landscape.files.assets import Assets
from landscape.island.fixes import FIXES
from landscape.frame import Pose
from landscape.walk.recording import Plan, Tick
from landscape.elements.settings import preset
from landscape.settings.declare import with_settings
from landscape.walk.walker import Intent, start

values = with_settings(preset("best"), json.loads(sys.argv[1]))
plan = Plan("island", values, "", Pose(8.0, 1.0, 33.5, 25.0), (160, 120))
seen = {}
with Walk(plan, Assets(), "osmesa") as walk:
    def frame(*actions, seconds=0.0):
        walk.advance(Tick(seconds, Intent(), actions, (160, 120)))
        walk.draw()
        return hashlib.sha256(walk.pixels()).hexdigest()
    hint = frame()
    walk.place.settings = with_settings(walk.place.settings, {"clock.kt_per_second": 0})
    seen["plain"] = frame(seconds=1.0), frame(seconds=1.5)
    for name in ("fog", "reflection", "sorting", "map", "wireframe", "time", "help"):
        on = frame(name), frame(seconds=3.0)
        off = frame(name), frame(seconds=3.0)
        seen[name] = [*on, *off]
    frame("map")
    frame("map")
    assert frame("help") == frame(seconds=3.0), "the keys are shown with an earlier message"
    frame("help")
    names = [fix.name for fix in FIXES]
    frame("previous_fix")
    frame("go_to_fix")
    last = FIXES[-1].pose(False)
    moved = [walk.walker.x, walk.walker.y, walk.walker.z, walk.walker.yaw, walk.walker.pitch]
    assert moved == [last.x, last.y, last.z, last.yaw, last.pitch], moved
    for _ in range(names.index("R16") + 1):
        frame("next_fix")
    walk.walker = start(plan.pose, walk.place.scene, walk.place.settings)
    frame(seconds=3.0)
    seen["fix"] = frame("fix"), frame(seconds=3.0), frame("fix"), frame(seconds=3.0)
print(json.dumps([hint, seen]))
"""


@pytest.mark.seldom(14, first=1)
def test_each_switch_has_an_effect_reports_it_and_undoes_it() -> None:
    done = python(STILLS, json.dumps(SMALL_BEST), env=environment())
    assert done.status == 0, done.err
    hint, seen = json.loads(done.out)
    still, plain = seen.pop("plain")
    assert hint == still != plain, "the hint stays for two seconds and goes"
    for name, (said, done_, said_back, back) in seen.items():
        assert done_ != plain, f"{name} does nothing"
        assert back == plain, f"{name} twice is not as before"
        if name != "help":
            assert said != done_, f"{name} says nothing"
            assert said_back not in (back, said), f"{name} says nothing when taken back"


HEARD = """
import json
from landscape.walk.app import Walk
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.walk.recording import Plan, Tick
from landscape.elements.settings import Settings
from landscape.settings.declare import with_settings
from landscape.walk.walker import Intent

said = []
class Heard(Walk):
    def _say(self, message):
        said.append(message)
        super()._say(message)

values = with_settings(Settings(), {"walk.swim": True, "walk.run": 30.0})
for language in ("en", "fr"):
    plan = Plan("island", values, "", Pose(24.0, None, 31.0, 180.0), (40, 30), only=("ground",),
                language=language)
    with Heard(plan, Assets(), "osmesa") as walk:
        for _ in range(60):
            walk.advance(Tick(0.02, Intent(forward=1.0, run=True), (), (40, 30)))
        for _ in range(60):
            walk.advance(Tick(0.02, Intent(forward=-1.0, run=True), (), (40, 30)))

# One dives where water is more than a surface.
class Deep(Heard):
    def _open(self, plan):
        super()._open(plan)
        self.place.scene.bed = lambda x, z: -1.0

plan = Plan("island", values, "", Pose(24.0, None, 31.0, 180.0), (40, 30), only=("ground",))
with Deep(plan, Assets(), "osmesa") as walk:
    for _ in range(25):
        walk.advance(Tick(0.02, Intent(forward=1.0, run=True), (), (40, 30)))
print(json.dumps(said))
"""


@pytest.mark.seldom(7, first=2)
def test_deep_water_and_the_edge_of_the_map_are_said() -> None:
    done = python(HEARD, env=environment())
    assert done.status == 0, done.err
    said = [text for text in json.loads(done.out) if "H" not in text]
    assert said == [
        *("deep water: swimming", "the edge of the map", "back on foot"),
        *("eau profonde\u00a0: à la nage", "le bord de la carte", "de nouveau à pied"),
        "deep water: swimming  (F, then C: dive)",
    ]


def test_a_replay_gives_the_same_pixels_and_poses_in_every_frame(scripted) -> None:
    assert len(set(frame["hash"] for frame in scripted["live"])) > 20
    assert scripted["again"] == scripted["live"]


@pytest.mark.seldom(14, first=6)
def test_a_replay_from_the_command_line_records_itself_again(scripted, tmp_path: Path) -> None:
    first, second = scripted["folder"] / "a.jsonl", tmp_path / "b.jsonl"
    done = landscape("walk", "--backend", "osmesa", "--replay", first, "--record", second)
    assert (done.status, done.err) == (0, "")
    assert done.out.strip() == str(second)
    assert second.read_bytes() == first.read_bytes()


def short_walk(path: Path, ticks: list[Tick]) -> Path:
    """Write the recording of a walk under the sky alone, which opens quickly; return ``path``."""
    settings = with_settings(preset("2006"), SMALL_BEST)
    pose, size = Pose(20.0, None, 30.0, 190.0), (320, 240)
    writer = recording.Writer(path, Plan("island", settings, "", pose, size, only=("sky",)))
    for tick in ticks:
        writer.add(tick)
    writer.finish()
    return path


@pytest.mark.seldom(3)
def test_a_replay_keeps_to_the_size_that_is_asked_for(tmp_path: Path) -> None:
    intents = [Intent(forward=1.0), Intent(turn=1.0), Intent(run=True), Intent()] * 4
    first = short_walk(tmp_path / "a.jsonl", [Tick(0.2, each, (), (97, 61)) for each in intents])
    second = tmp_path / "b.jsonl"
    words = ["walk", "--backend", "osmesa", "--replay", first, "--size", "64x48", "--frames", "12"]
    done = landscape(*words, "--record", second)
    assert (done.status, done.err) == (0, "")
    plan, ticks = recording.read(second)
    assert {plan.size, *(tick.size for tick in ticks)} == {(64, 48)}
    assert [tick.intent for tick in ticks] == intents[:12]


@pytest.mark.seldom(13, first=7)
def test_the_language_of_the_window_can_be_asked_for(tmp_path: Path) -> None:
    path = tmp_path / "b.jsonl"
    english = short_walk(tmp_path / "a.jsonl", [Tick(0.2, Intent(), (), (320, 240))])
    assert recording.read(english)[0].language == "en"
    first = ["walk", "fig35a", "--frames", "1", "--only", "sky"]
    for begin in (first, ["walk", "--replay", english, "--frames", "1"]):
        words = ["--backend", "osmesa", "--size", "64x48", "--record", path, "--lang", "fr"]
        done = landscape(*begin, *words, env=environment(LANG="C"))
        assert (done.status, done.err) == (0, "")
        assert recording.read(path)[0].language == "fr"


@pytest.mark.seldom(13, first=8)
@pytest.mark.posix_only("nothing sends Ctrl-C to one process alone")
def test_ctrl_c_ends_the_walk_in_one_line_and_keeps_the_recording(tmp_path: Path) -> None:
    need_library("OSMesa")
    path = tmp_path / "a.jsonl"
    path.write_text("earlier")
    words = ["walk", "fig4a", "--backend", "osmesa", "--size", "64x48", "--frames", "100000"]
    with running(*words, "--record", path, stderr=subprocess.PIPE) as process:
        deadline = time.monotonic() + SECONDS
        while not any(p.stat().st_size > 10_000 for p in tmp_path.glob(".*.part")):
            assert process.poll() is None, process.stderr and process.stderr.read()
            assert time.monotonic() < deadline, "nothing was written"
            time.sleep(0.1)
        assert path.read_text() == "earlier"
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=SECONDS)
    assert (process.returncode, err) == (130, "landscape: interrupted\n")
    plan, ticks = recording.read(path)
    assert len(ticks) > 10
    assert plan.only == ("ground", "sword", "map"), "a walk from a figure shows what it shows"
    assert [p.name for p in tmp_path.iterdir()] == ["a.jsonl"]


@pytest.mark.seldom(13, first=7)
@pytest.mark.parametrize(
    ("words", "wanted"),
    [
        (["fig2a"], ((20.0, 29.5, 43.5, 0.0, -51.0), 0.0, True, "none")),
        (
            ["fig2a", "--preset", "best", *COARSE],
            ((20.0, 29.5, 43.5, 0.0, -51.0), 0.0, False, "both"),
        ),
        (["fig4a", "--kt", "7"], ((13.4, 1.75, 27.6, 345.0, -14.0), 7.0, False, "large")),
        (
            ["fig4a", "--pose=-1,ground,20,90,5"],
            ((-1.0, None, 20.0, 90.0, 5.0), 0.0, False, "large"),
        ),
    ],
)
def test_a_walk_begins_where_and_as_the_command_line_says(
    words: list[str], wanted: tuple[Any, ...], tmp_path: Path
) -> None:
    path = tmp_path / "a.jsonl"
    window = ("--backend", "osmesa", "--size", "64x48", "--frames", "1", "--only", "ground")
    done = landscape("walk", *words, *window, "--record", path)
    assert (done.status, done.err) == (0, "")
    plan, _ = recording.read(path)
    pose = plan.pose.x, plan.pose.y, plan.pose.z, plan.pose.yaw, plan.pose.pitch
    assert (pose, plan.kt, plan.wireframe, plan.settings.ground.units) == wanted


FIXED = """
from landscape.files.assets import Assets
from landscape.scene.scene import find_view
from landscape.walk.app import Walk
from landscape.walk.recording import Plan, Tick
from landscape.walk.walker import Intent

kind, view = find_view("R14")
values = kind.values("2006", view.settings)
with Walk(Plan("island", values, "R14", view.pose, (64, 48), only=("ground",)), Assets(),
          "osmesa") as walk:
    said = [walk.place.settings.ground.smooth]
    for _ in range(2):
        walk.advance(Tick(0.1, Intent(), ("fix",), (64, 48)))
        said.append(walk.place.settings.ground.smooth)
print(*said)
"""


@pytest.mark.seldom(10, first=3)
def test_in_a_walk_from_a_fix_the_key_switches_that_fix() -> None:
    done = python(FIXED, env=environment())
    assert (done.status, done.out.split()) == (0, ["catmull_rom", "none", "catmull_rom"]), done.err


@pytest.mark.sweep(3)
@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["--pose=2e6,1,1,0,0", "--backend", "osmesa", "--frames", "1"], "--pose"),
        (["--backend", "egl"], "--frames"),
        (["--backend", "osmesa"], "--frames"),
        (["--backend", "osmesa", "--replay", "none.jsonl"], "none.jsonl"),
        (["--backend", "osmesa", "--frames", "1", "--record", f"{__file__}/a.jsonl"], "--record"),
        (
            ["--backend=osmesa", "--frames=1", "--only=rabbit", "--set=rabbit.mesh=none.ply"],
            "none.ply",
        ),
    ],
)
def test_bad_input_ends_in_one_line(words: list[str], reason: str, tmp_path: Path) -> None:
    done = landscape("walk", *words, cwd=tmp_path)
    assert done.status == 2
    assert done.err.startswith("landscape: ")
    assert reason in done.err
    assert done.err.count("\n") == 1
    assert not list(tmp_path.iterdir())


# Real key events: Xvfb and xdotool.


@pytest.fixture(scope="module")
def screen() -> Iterator[dict[str, str]]:
    """An environment with a screen of its own."""
    for tool in ("Xvfb", "xdotool"):
        if shutil.which(tool) is None:
            pytest.skip(f"{tool} is not installed (see system-packages.txt)")
    read_end, write_end = os.pipe()
    words = ["Xvfb", "-displayfd", str(write_end), "-screen", "0", "800x600x24", "-nolisten", "tcp"]
    server = subprocess.Popen(words, pass_fds=[write_end], stderr=subprocess.DEVNULL)
    os.close(write_end)
    try:
        with os.fdopen(read_end) as numbers:
            number = numbers.readline().strip()
        assert number, "Xvfb did not start"
        yield environment(DISPLAY=f":{number}", LANG="C")
    finally:
        end(server)


@pytest.mark.seldom(13, first=7)
def test_a_full_screen_replay_is_drawn_at_the_size_of_the_screen(
    screen: dict[str, str], tmp_path: Path
) -> None:
    path = short_walk(tmp_path / "a.jsonl", [Tick(0.2, Intent(), (), (320, 240))] * 12)
    again = tmp_path / "b.jsonl"
    words = ["walk", "--replay", path, "--record", again, "--fullscreen", "--quiet"]
    done = landscape(*words, env=screen)
    assert (done.status, done.err) == (0, "")
    assert {tick.size for tick in recording.read(again)[1]} == {(800, 600)}


def xdotool(screen: dict[str, str], *words: str) -> str:
    """Run xdotool; return what it prints. A window may end while all are searched: try again."""
    for _ in range(100):
        done = subprocess.run(
            ["xdotool", *words], env=screen, capture_output=True, text=True, timeout=SECONDS
        )
        if "search" not in words or "BadWindow" not in done.stderr:
            break
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def walked(plan: Plan, ticks: list[Tick]) -> list[Walker]:
    """Walk a recorded walk without a window; return the walker of every frame."""
    image = read_heights(Assets().path(plan.settings.ground.height_image))
    field = height_field(image, plan.settings.ground, plan.settings.water.level)
    walkers = [start(plan.pose, field, plan.settings)]
    for tick in ticks:
        args = (tick.intent, tick.seconds, field, (), plan.settings)
        walkers.append(advance(walkers[-1], *args))
    return walkers


@pytest.mark.seldom(14, first=1)
def test_f11_in_a_walk_that_began_full_screen_comes_back_to_its_size(
    screen: dict[str, str], tmp_path: Path
) -> None:
    path = tmp_path / "walk.jsonl"
    words = ["walk", "fig35b", "--size", "320x240", "--fullscreen", "--record", str(path)]
    process = subprocess.Popen(
        [sys.executable, "-m", "landscape", *words, *SET, "--only", "sky"], env=screen
    )

    try:
        window = xdotool(screen, "search", "--sync", "--onlyvisible", "--name", "^landscape")
        xdotool(screen, "windowfocus", "--sync", window)
        _wait_for(lambda: '"size": [800, 600]' in _text(tmp_path), process, "the full screen")
        xdotool(screen, "key", "F11")
        size = '"size": [320, 240]'
        _wait_for(lambda: _text(tmp_path).count(size) == 2, process, "the size asked for")
        xdotool(screen, "key", "Escape")
        assert process.wait(SECONDS) == 0
    finally:
        process.kill()
        process.wait()


@pytest.mark.seldom(14, first=1)
def test_real_key_events_walk_turn_and_strike(screen: dict[str, str], tmp_path: Path) -> None:
    path = tmp_path / "walk.jsonl"
    words = ["walk", "fig35b", "--size", "320x240", "--frames", "5000", "--record", str(path)]
    (tmp_path / "screenshot-0001.png").write_text("mine")
    process = subprocess.Popen(
        [sys.executable, "-m", "landscape", *words, *SET], env=screen, cwd=tmp_path
    )
    try:
        window = xdotool(screen, "search", "--sync", "--onlyvisible", "--name", "^landscape")
        xdotool(screen, "windowfocus", "--sync", window)
        _wait_for(lambda: _recorded(tmp_path) > 4000, process, "the first frames")

        def hold(key: str, until) -> None:
            xdotool(screen, "keydown", key)
            try:
                _wait_for(lambda: until(_text(tmp_path)), process, f"the key {key}")
            finally:
                xdotool(screen, "keyup", key)

        hold("w", lambda text: text.count('"forward": 1.0') > 5)
        hold("d", lambda text: text.count('"right": 1.0') > 2)
        hold("Right", lambda text: text.count('"turn": 1.0') > 5)
        xdotool(screen, "key", "e")
        _wait_for(lambda: '"strike": true' in _text(tmp_path), process, "the sword")
        # A mouse captured by the first click turns the head.
        xdotool(screen, "mousemove", "--window", window, "100", "100", "click", "1")
        time.sleep(0.3)

        def look() -> bool:
            xdotool(screen, "mousemove_relative", "--", "9", "4")
            return '"look"' in _text(tmp_path)

        _wait_for(look, process, "the mouse")
        xdotool(screen, "key", "F12")
        _wait_for(lambda: "screenshot-0002.png" in _text(tmp_path), process, "the picture")
        # A French keyboard prints M where a US one prints a semicolon.
        subprocess.run(["setxkbmap", "fr"], env=screen, check=True)
        try:
            xdotool(screen, "key", "m")
            _wait_for(lambda: '"do": ["map"]' in _text(tmp_path), process, "the letter M")
        finally:
            subprocess.run(["setxkbmap", "us"], env=screen, check=True)
        xdotool(screen, "windowsize", window, "300", "200")
        _wait_for(lambda: '"size": [300, 200]' in _text(tmp_path), process, "the new size")
        xdotool(screen, "key", "Escape")
        time.sleep(0.3)
        assert process.poll() is None, "Escape lets the mouse go before it leaves"
        xdotool(screen, "key", "Escape")
        assert process.wait(SECONDS) == 0
    finally:
        process.kill()
        process.wait()
    plan, ticks = recording.read(path)
    walkers = walked(plan, ticks)
    first, last = walkers[0], walkers[-1]
    assert math.dist((first.x, first.z), (last.x, last.z)) > 0.02
    assert last.step > first.step
    strokes = {walker.stroke for walker in walkers}  # a slow machine skips some
    assert {0} < strokes <= {0, 1, 2, 3, 4}
    turns = [t for t, tick in enumerate(ticks) if tick.intent.turn]
    assert (walkers[turns[-1] + 1].yaw - walkers[turns[0]].yaw) % 360 > 3
    assert sum(tick.intent.strike for tick in ticks) == 1
    with Image.open(tmp_path / "screenshot-0002.png") as picture:
        assert picture.size == (320, 240)
        assert len(picture.getcolors(320 * 240) or []) > 1000
    assert (tmp_path / "screenshot-0001.png").read_text() == "mine"


def _text(folder: Path) -> str:
    """Return what the recorder has written so far."""
    found = []
    for path in folder.glob(".*.part"):
        # A screenshot is such a file as well until it is complete, perhaps by now.
        with contextlib.suppress(FileNotFoundError):
            found.append(path.read_text(errors="replace"))
    return "".join(found)


def _recorded(folder: Path) -> int:
    return len(_text(folder))


def _wait_for(condition, process: subprocess.Popen, what: str) -> None:
    deadline = time.monotonic() + SECONDS
    while not condition():
        assert process.poll() is None, f"the walk ended while waiting for {what}"
        assert time.monotonic() < deadline, f"waited in vain for {what}"
        time.sleep(0.05)


REBUILT = """
import gc
import json
import weakref
from landscape.elements.settings import preset
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.settings.declare import with_settings
from landscape.walk import app
from landscape.walk.recording import Plan, Tick
from landscape.walk.walker import Intent

given, seen = [], []
app.give_back = lambda: given.append(len(seen))
values = with_settings(preset("2006"), {"ground.resolution": 20})
plan = Plan("island", values, "", Pose(24.0, None, 31.0), (40, 30), only=("ground",))
gc.disable()  # a scene that was left must not wait for it
with app.Walk(plan, Assets(), "osmesa") as walk:
    first = weakref.ref(walk.place.scene)
    changes = {0: {"ground.resolution": 21}, 2: {"ground.resolution": 22}}
    for number in range(12):
        seen.append(first() is not None)
        walk.advance(Tick(0.1, Intent(), (), (40, 30), changes=changes.get(number, {})))
        walk.draw()
        walk.present()
print(json.dumps([seen, given]))
"""


@pytest.mark.seldom(5)
def test_a_scene_that_is_opened_anew_gives_its_memory_back() -> None:
    done = python(REBUILT, env=environment())
    assert done.status == 0, done.err
    alive, given = json.loads(done.out)
    assert alive == [True] + 11 * [False]
    # Half a second after the last change, once, and at the end.
    assert given == [9, 12] or given == [8, 12], given


OVERLAYS = """
import json
import glfw
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.scene.scene import scene
from landscape.walk.app import Walk
from landscape.walk.recording import Plan

hall = scene("hall")
plan = Plan("hall", hall.settings, "", Pose(1.6, None, 2.6), (160, 120), only=("floor",))
seen = []
with Walk(plan, Assets(), "osmesa") as walk:
    drawn = walk._panel.draw
    def noted(size, keys=False, message="", opacity=1.0, left=None, *rest, **more):
        seen.append([keys, left is not None, message])
        drawn(size, keys, message, opacity, left, *rest, **more)
    walk._panel.draw = noted
    for key in (glfw.KEY_H, glfw.KEY_I, glfw.KEY_I, glfw.KEY_H, glfw.KEY_L, glfw.KEY_H,
                glfw.KEY_L, glfw.KEY_H, glfw.KEY_F5):
        walk.hands.key(key, glfw.PRESS)
        walk.hands.key(key, glfw.RELEASE)
        walk.advance(walk.listen())
        walk.draw()
print(json.dumps(seen))
"""


ESCAPED = """
import json
import glfw
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.scene.scene import scene
from landscape.walk.app import Walk
from landscape.walk.recording import Plan

hall = scene("hall")
plan = Plan("hall", hall.settings, "", Pose(1.6, None, 2.6), (160, 120), only=("floor",))
seen = []
with Walk(plan, Assets(), "osmesa") as walk:
    # In the third case both within one frame, as while a scene is built again.
    h, escape = glfw.KEY_H, glfw.KEY_ESCAPE
    for keys in [h], [escape], [h, escape], [escape]:
        for key in keys:
            walk.hands.key(key, glfw.PRESS)
        tick = walk.listen()
        seen.append(None if tick is None else list(tick.actions))
        if tick is not None:
            walk.advance(tick)
            seen.append(walk._help)
print(json.dumps(seen))
"""


@pytest.mark.seldom(13, first=9)
def test_escape_shuts_the_list_of_keys_before_it_ends_the_walk() -> None:
    done = python(ESCAPED, env=environment(LANG="C"))
    assert done.status == 0, done.err
    assert json.loads(done.out) == [["help"], True, ["help"], False, ["help", "help"], False, None]


@pytest.mark.seldom(10, first=9)
def test_the_help_and_what_is_opened_beside_it_never_lie_over_each_other() -> None:
    done = python(OVERLAYS, env=environment(LANG="C"))
    assert done.status == 0, done.err
    seen = json.loads(done.out)
    shown = [(keys, left) for keys, left, _ in seen]
    assert (True, True) not in shown
    keys, left = (True, False), (False, True)
    assert shown[:6] == [keys, left, (False, False), keys, left, keys]
    assert seen[-1][2] == "nothing to save here"


HURRIED = """
import json
import glfw
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.scene.scene import scene
from landscape.walk.app import Walk
from landscape.walk.recording import Plan

hall = scene("hall")
plan = Plan("hall", hall.settings, "", Pose(1.6, None, 2.6), (160, 120), only=("floor",))
seen = []
with Walk(plan, Assets(), "osmesa") as walk:
    # Both keys of a pair within one frame, as where a frame takes a second.
    for keys in [glfw.KEY_H], [glfw.KEY_H, glfw.KEY_B], [glfw.KEY_B], [glfw.KEY_H, glfw.KEY_B]:
        for key in keys:
            walk.hands.key(key, glfw.PRESS)
        walk.advance(walk.listen())
        seen.append([walk._help, walk.hands.choosing])
print(json.dumps(seen))
"""


@pytest.mark.seldom(3)
def test_the_help_does_not_hide_a_list_that_is_opened_within_the_same_frame() -> None:
    done = python(HURRIED, env=environment(LANG="C"))
    assert done.status == 0, done.err
    listed = [False, "landmarks"]
    assert json.loads(done.out) == [[True, ""], listed, [False, ""], listed]


FLOWN_TO = """
import json
from landscape.elements.settings import preset
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.walk.app import Walk
from landscape.walk.recording import Plan, Tick
from landscape.walk.walker import Intent

plan = Plan("island", preset("2006"), "", Pose(8.0, None, 33.5, 25.0), (160, 120), only=("fog",))
seen = []
with Walk(plan, Assets(), "osmesa") as walk:
    # R1 is looked at on foot, R2 from the air.
    for names in ["go_to_fix"], ["next_fix", "go_to_fix"], ["go_to_fix"]:
        for name in names:
            walk.advance(Tick(0.1, Intent(), (name,), (160, 120)))
        seen.append([walk.walker.flying, walk._message])
print(json.dumps(seen))
"""


@pytest.mark.seldom(3, first=1)
def test_whoever_goes_to_a_fix_and_flies_there_is_told_so() -> None:
    done = python(FLOWN_TO, env=environment(LANG="C"))
    assert done.status == 0, done.err
    seen = json.loads(done.out)
    assert [flying for flying, _ in seen] == [False, True, True]
    assert ["(in flight; F: walk)" in message for _, message in seen] == [False, True, False]
    assert seen[1][1].startswith("R2  ")


@pytest.mark.seldom(13, first=8)
def test_the_title_is_met_in_a_window_and_one_key_leaves_it(
    screen: dict[str, str], tmp_path: Path
) -> None:
    folders = {"LANDSCAPE_CACHE": str(tmp_path), "LANDSCAPE_CONFIG": str(tmp_path)}
    words = [sys.executable, "-m", "landscape", "walk", "--fresh", "--mute"]
    process = subprocess.Popen(words, env={**screen, **folders}, stderr=subprocess.PIPE)
    try:
        window = xdotool(screen, "search", "--sync", "--onlyvisible", "--name", "^landscape$")
        xdotool(screen, "windowfocus", "--sync", window)
        xdotool(screen, "key", "End", "Up", "Escape")
        _, err = process.communicate(timeout=SECONDS)
        assert (process.returncode, err) == (0, b"")
    finally:
        process.kill()
        process.wait()
    assert not list(tmp_path.iterdir()), "nothing was walked, so nothing is kept"
