"""The window: keys, mouse, resizing, recordings and texts, on the null platform and under Xvfb.

GLFW's null platform runs the real window code with no screen. It cannot send key events: these come
from xdotool under Xvfb. Each window has a process of its own.
"""

import dataclasses
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
from commands import environment, landscape, python
from PIL import Image, ImageFont
from stage import Stage, changes, snapshot

from landscape.errors import InputError
from landscape.files.assets import Assets
from landscape.files.images import read_heights
from landscape.files.output import next_free
from landscape.frame import Pose
from landscape.geometry.height_field import height_field
from landscape.gl.calls import gl
from landscape.island import ELEMENTS
from landscape.keys import with_settings
from landscape.settings import preset
from landscape.window import recording, words
from landscape.window.bindings import BINDINGS, NAMED_KEYS, SETTINGS, SWITCHES
from landscape.window.hands import JUMP, Hands
from landscape.window.panel import Panel, font, keys_image, line_image, writable
from landscape.window.recording import Plan, Tick, Writer
from landscape.window.walker import Intent, Walker, advance, start

pytestmark = pytest.mark.window

SMALL = {"grass.count": 2000, "trees.count": 100, "plants.count": 100, "ground.resolution": 40}
SET = [word for key, value in SMALL.items() for word in ("--set", f"{key}={value}")]
PRESS, RELEASE, REPEAT = glfw.PRESS, glfw.RELEASE, glfw.REPEAT


# Hands: what GLFW reports, and what is made of it.


def test_keys_make_intents_by_their_positions() -> None:
    hands = Hands()
    for key, intent in (
        (glfw.KEY_W, Intent(forward=1)),
        (glfw.KEY_UP, Intent(forward=1)),
        (glfw.KEY_S, Intent(forward=-1)),
        (glfw.KEY_DOWN, Intent(forward=-1)),
        (glfw.KEY_A, Intent(right=-1)),
        (glfw.KEY_D, Intent(right=1)),
        (glfw.KEY_LEFT, Intent(turn=-1)),
        (glfw.KEY_RIGHT, Intent(turn=1)),
        (glfw.KEY_SPACE, Intent(up=1)),
        (glfw.KEY_PAGE_UP, Intent(up=1)),
        (glfw.KEY_C, Intent(up=-1)),
        (glfw.KEY_PAGE_DOWN, Intent(up=-1)),
        (glfw.KEY_LEFT_SHIFT, Intent(run=True)),
    ):
        hands.key(key, PRESS)
        assert hands.take() == hands.take() == (intent, ())
        hands.key(key, RELEASE)
        assert hands.take() == (Intent(), ())


def test_opposite_keys_cancel() -> None:
    hands = Hands()
    for key in (glfw.KEY_W, glfw.KEY_S, glfw.KEY_A):
        hands.key(key, PRESS)
    assert hands.take()[0] == Intent(forward=0, right=-1)


def test_a_key_tapped_between_two_frames_counts_for_one_frame() -> None:
    hands = Hands()
    hands.key(glfw.KEY_W, PRESS)
    hands.key(glfw.KEY_W, RELEASE)
    assert hands.take()[0] == Intent(forward=1)
    assert hands.take()[0] == Intent()


def test_key_repeats_do_not_trigger_a_switch_again() -> None:
    hands = Hands()
    for action in (PRESS, REPEAT, REPEAT, RELEASE):
        hands.key(glfw.KEY_G, action)
        hands.key(glfw.KEY_E, action)
    assert hands.take() == (Intent(strike=True), ("fog",))
    assert hands.take() == (Intent(), ())


def test_two_presses_of_the_fly_key_in_a_frame_cancel() -> None:
    hands = Hands()
    hands.key(glfw.KEY_F, PRESS)
    assert hands.take()[0].fly
    for _ in range(2):
        hands.key(glfw.KEY_F, PRESS)
    assert not hands.take()[0].fly


def test_the_first_click_captures_and_the_next_strikes() -> None:
    hands = Hands()
    hands.button(glfw.MOUSE_BUTTON_LEFT, PRESS)
    assert (hands.orders, hands.take()) == (["capture"], (Intent(), ()))
    hands.capture(True)
    hands.button(glfw.MOUSE_BUTTON_RIGHT, PRESS)
    assert not hands.take()[0].strike
    hands.button(glfw.MOUSE_BUTTON_LEFT, PRESS)
    assert hands.take()[0].strike


def test_the_captured_mouse_turns_the_view_except_by_its_first_motion_or_jumps() -> None:
    hands = Hands()
    hands.motion(5.0, 5.0)
    assert hands.take()[0].look == (0, 0)
    hands.capture(True)
    hands.motion(900.0, -700.0)
    assert hands.take()[0].look == (0, 0)
    hands.motion(903.0, -702.0)
    hands.motion(904.0, -702.0)
    assert hands.take()[0].look == (4, -2)
    hands.motion(9000.0, -9000.0)
    assert hands.take()[0].look == (JUMP, -JUMP)
    hands.capture(True)
    hands.motion(0.0, 0.0)
    assert hands.take()[0].look == (0, 0)


def test_escape_first_releases_the_mouse_and_then_quits() -> None:
    hands = Hands()
    hands.capture(True)
    hands.key(glfw.KEY_ESCAPE, PRESS)
    hands.capture(False)
    hands.key(glfw.KEY_ESCAPE, PRESS)
    assert hands.orders == ["release", "quit"]


def test_losing_the_focus_releases_keys_and_mouse() -> None:
    hands = Hands()
    hands.capture(True)
    hands.key(glfw.KEY_W, PRESS)
    hands.motion(1.0, 1.0)
    hands.motion(7.0, 1.0)
    hands.focus(False)
    assert (hands.take(), hands.orders) == ((Intent(), ()), ["release"])


# Words.


def test_every_text_that_is_shown_exists() -> None:
    english = words.TEXTS["en"]
    shown = (
        {f"help.{binding.action}" for binding in BINDINGS}
        | set(NAMED_KEYS.values())
        | {"help.title", "hint"}
    )
    shown |= {f"{name}.{way}" for name in (*SETTINGS, "fly", "wireframe") for way in ("on", "off")}
    assert shown <= set(english)
    for table in words.TEXTS.values():
        assert set(table) <= set(english)
    for key, french in words.TEXTS["fr"].items():
        assert french.count("{") == english[key].count("{")


def test_every_switch_is_in_the_list_of_keys() -> None:
    listed = {key for binding in BINDINGS for key in binding.keys}
    assert set(SWITCHES) <= listed


@pytest.mark.parametrize(
    ("variables", "language"),
    [
        ({}, "en"),
        ({"LANG": "fr_FR.UTF-8"}, "fr"),
        ({"LANG": "fr"}, "fr"),
        ({"LANG": "fr_FR.UTF-8", "LC_ALL": "C"}, "en"),
        ({"LANG": "C", "LANGUAGE": "de:fr_CA:en"}, "fr"),
        ({"LANG": "de_DE.UTF-8"}, "en"),
        ({"LANG": "fr_FR.UTF-8", "LANGUAGE": "en"}, "en"),
    ],
)
def test_the_environment_chooses_the_language(variables: dict[str, str], language: str) -> None:
    assert words.language(variables) == language


ROWS = [("W A S D", "walk (arrows up and down as well)"), ("Page up", "fly, and so on")] * 8


@pytest.mark.parametrize("size", [(640, 480), (1920, 1080), (1600, 900), (320, 240)])
def test_the_list_of_keys_fits_and_its_font_grows_with_the_window(size: tuple[int, int]) -> None:
    image = keys_image("Keys", ROWS, size)
    assert image.shape[1] <= size[0]
    assert image.shape[0] <= size[1]
    if size[1] >= 480:
        assert image.shape[0] > 0.5 * size[1], "the letters are too small for the window"


def test_long_texts_shrink_the_font_until_the_list_fits() -> None:
    rows = [
        ("Left Right", "a text as long as some other language may well need to say the same")
    ] * 15
    assert keys_image("Keys", rows, (640, 900)).shape[1] <= 640
    assert (
        line_image("as long as a message in some other language may be", (320, 900)).shape[1] <= 320
    )


def test_no_window_is_too_small_for_text() -> None:
    for size in ((1, 1), (3, 200), (200, 3)):
        assert keys_image("Keys", ROWS, size).size
        assert line_image("screenshot-0001.png saved", size).size


def test_characters_that_the_font_lacks_are_replaced() -> None:
    own = ImageFont.load_default(16)
    assert writable("Échap, à pied: \uffff", own) == "Echap, a pied: ?"
    assert writable("Esc", font(16)) == "Esc"


def test_the_panel_shows_its_texels_one_to_one(stage: Stage) -> None:
    panel = Panel("Keys", [("A", "b")])
    image = line_image("fog off", stage.size).astype(float)
    height, width = image.shape[:2]
    left, bottom = (stage.size[0] - width) // 2, stage.size[1] - stage.size[1] // 24
    with stage.borrowed():
        gl.glViewport(0, 0, *stage.size)
        gl.glClearColor(1.0, 1.0, 1.0, 1.0)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glEnable(gl.GL_FOG)
        # A fog that would swallow all words.
        gl.glFogi(gl.GL_FOG_MODE, gl.GL_LINEAR)
        gl.glFogf(gl.GL_FOG_START, -2.0)
        gl.glFogf(gl.GL_FOG_END, -1.0)
        before = snapshot()
        for opacity in (1.0, 0.5):
            gl.glClear(gl.GL_COLOR_BUFFER_BIT)
            panel.draw(stage.size, message="fog off", opacity=opacity)
            picture = stage.read()
            alpha = image[..., 3:] / 255 * opacity
            expected = image[..., :3] * alpha + 255 * (1 - alpha)
            shown = picture[bottom - height : bottom, left : left + width]
            assert np.abs(shown - expected).max() <= 2
            assert (picture[: bottom - height] == 255).all()
        panel.draw(stage.size, keys=True)
        assert (stage.read()[stage.size[1] // 2, stage.size[0] // 2] < 255).any()
        assert not changes(before, snapshot())
    panel.release()
    panel.release()


# Recordings.


def plan(**changes: Any) -> Plan:
    values = with_settings(preset("best"), {"fog.density": 0.1 + 0.2, "water.color": (0, 1, 0, 1)})
    settled = Plan(
        "island", values, "fig35e", Pose(21.1, None, 20.5, 62.0, 3.0), (320, 240), 50.0, 7
    )
    return dataclasses.replace(settled, **changes)


TICKS = [
    Tick(0.0, Intent(), (), (320, 240)),
    Tick(1 / 3, Intent(forward=1, look=(0.1, -2.5), run=True), ("fog", "map"), (320, 240)),
    Tick(0.1, Intent(strike=True, fly=True, turn=-1), (), (97, 61), "saved"),
    Tick(0.1, Intent(), ("help",), (97, 61)),
]


def write(path: Path, plan: Plan, ticks: list[Tick]) -> Path:
    writer = Writer(path, plan)
    for tick in ticks:
        writer.add(tick)
    assert writer.finish()
    return path


def test_a_recording_is_read_back_exactly(tmp_path: Path) -> None:
    wanted = plan(pose=Pose(0.1, 1 / 3, 2.0))
    got, ticks = recording.read(write(tmp_path / "a.jsonl", wanted, TICKS))
    assert (got, ticks) == (wanted, TICKS)
    got, _ = recording.read(write(tmp_path / "a.jsonl", plan(), TICKS))
    assert got.pose.y is None
    assert [path.name for path in tmp_path.iterdir()] == ["a.jsonl"]


def test_an_empty_or_unfinished_recording_does_not_replace_an_earlier_file(tmp_path: Path) -> None:
    path = tmp_path / "a.jsonl"
    path.write_text("earlier")
    empty, broken = Writer(path, plan()), None
    assert not empty.finish()
    broken = Writer(path, plan())
    broken.add(TICKS[1])
    assert path.read_text() == "earlier"
    broken.discard()
    assert [p.name for p in tmp_path.iterdir()] == ["a.jsonl"]
    assert path.read_text() == "earlier"


@pytest.mark.parametrize("name", ["missing/a.jsonl", "."])
def test_a_path_that_cannot_be_written_is_bad_input(tmp_path: Path, name: str) -> None:
    with pytest.raises(InputError, match="--record"):
        Writer(tmp_path / name, plan())


def _with(line: int, **changes: Any):
    def damage(lines: list[str]) -> list[str]:
        lines[line] = json.dumps(json.loads(lines[line]) | changes)
        return lines

    return damage


DAMAGES = {
    "empty": (1, lambda lines: []),
    "no recording": (1, lambda lines: ["{}"] + lines[1:]),
    "cut in a line": (3, lambda lines: lines[:2] + [lines[2][:9]]),
    "cut between lines": (4, lambda lines: lines[:-2]),
    "a line lost": (5, lambda lines: lines[:2] + lines[3:]),
    "another version": (1, _with(0, **{"landscape walk": 99})),
    "no such setting": (1, _with(0, settings={"fog.colour": 1})),
    "setting of the wrong type": (1, _with(0, settings={"fog.density": "thick"})),
    "size of nothing": (1, _with(0, size=[0, 5])),
    "pose of four": (1, _with(0, pose=[1, 2, 3, 4])),
    "seed below 0": (1, _with(0, seed=-1)),
    "no such element": (1, _with(0, only=["moon"])),
    "time that runs back": (3, _with(2, dt=-0.1)),
    "time of an hour": (3, _with(2, dt=3600)),
    "time that is no number": (3, _with(2, dt=None)),
    "infinite time": (3, lambda lines: lines[:2] + ['{"dt": NaN}'] + lines[3:]),
    "no time": (4, lambda lines: lines[:3] + ['{"run": true}'] + lines[4:]),
    "too fast": (2, _with(1, forward=2)),
    "no such switch": (2, _with(1, do=["sleep"])),
    "no such intent": (2, _with(1, swim=1)),
    "strike of a number": (2, _with(1, strike=1)),
    "no object": (2, lambda lines: [lines[0], "[1]", *lines[2:]]),
}


@pytest.mark.parametrize("name", DAMAGES)
def test_a_damaged_recording_is_bad_input_and_the_line_is_named(tmp_path: Path, name: str) -> None:
    line, damage = DAMAGES[name]
    path = write(tmp_path / "a.jsonl", plan(), TICKS)
    lines = damage(path.read_text().splitlines())
    path.write_text("\n".join(lines))
    with pytest.raises(InputError) as error:
        recording.read(path)
    assert str(error.value).startswith(f"{path}:{line}: ")
    assert "\n" not in str(error.value)


def test_a_binary_or_missing_file_is_bad_input(tmp_path: Path) -> None:
    path = tmp_path / "a.jsonl"
    path.write_bytes(b"\x89PNG\r\n\x1a\n\xff\x00")
    for bad in (path, tmp_path, tmp_path / "none"):
        with pytest.raises(InputError, match=str(bad)):
            recording.read(bad)


def test_screenshots_take_the_next_free_name(tmp_path: Path) -> None:
    (tmp_path / "shot-0001.png").write_text("mine")
    assert next_free("shot", ".png", tmp_path).name == "shot-0002.png"
    assert next_free("shot", ".png", tmp_path).name == "shot-0003.png"
    assert (tmp_path / "shot-0001.png").read_text() == "mine"


# GLFW's null platform, drawn by OSMesa.

SCRIPTED = """
import hashlib, json, sys, time
from pathlib import Path
import glfw
from landscape.window.app import Walk, run
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.gl.calls import gl
from landscape.window.recording import Plan, Writer, read
from landscape.settings import preset
from landscape.keys import with_settings

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
            "colours": len(set(map(tuple, pixels.reshape(-1, 3).tolist()))),
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
plan = Plan("island", with_settings(preset("best"), changes), "", Pose(20.0, None, 30.0, 190.0),
            (160, 120), 20.0, 2006)
live = Watched(plan, Assets(), "osmesa")
live.seen, live.script = [], {
    2: [press(glfw.KEY_W, glfw.KEY_E)], 4: [size(97, 61)], 6: [size(1, 1)], 7: [size(160, 120)],
    8: [press(glfw.KEY_G)], 9: [press(glfw.KEY_R, glfw.KEY_T)], 10: [press(glfw.KEY_H)],
    11: [press(glfw.KEY_X, glfw.KEY_M)], 12: [press(glfw.KEY_H)],
    13: [capture], 14: [move(500, 5)], 15: [move(540, 0)],
    16: [lambda walk: glfw.iconify_window(walk.window)], 18: [size(0, 0)],
    19: [focus, press(glfw.KEY_W), capture], 20: [focus_lost],
    22: [press(glfw.KEY_F, glfw.KEY_SPACE)], 24: [press(glfw.KEY_F11)], 25: [press(glfw.KEY_F11)],
    26: [press(glfw.KEY_F12)],
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
def scripted(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """Two walks on the null platform: a scripted one, and its replay."""
    folder = tmp_path_factory.mktemp("scripted")
    code = f"import os; os.chdir({str(folder)!r})\n{SCRIPTED}"
    done = python(code, str(folder / "a.jsonl"), json.dumps(SMALL), env=environment(LANG="C"))
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


STILLS = """
import hashlib, json, sys
from landscape.window.app import Walk, run
from landscape.files.assets import Assets
from landscape.fixes import FIXES
from landscape.frame import Pose
from landscape.window.recording import Plan, Tick
from landscape.settings import preset
from landscape.keys import with_settings
from landscape.window.walker import Intent

values = with_settings(preset("best"), json.loads(sys.argv[1]))
plan = Plan("island", values, "", Pose(8.0, 1.0, 33.5, 25.0), (160, 120))
seen = {}
with Walk(plan, Assets(), "osmesa") as walk:
    def frame(*actions, seconds=0.0):
        walk.advance(Tick(seconds, Intent(), actions, (160, 120)))
        walk.draw()
        return hashlib.sha256(walk.pixels()).hexdigest()
    hint = frame()
    walk.settings = with_settings(walk.settings, {"clock.kt_per_second": 0})
    seen["plain"] = frame(seconds=1.0), frame(seconds=1.5)
    for name in ("fog", "reflection", "sorting", "map", "wireframe", "help"):
        on = frame(name), frame(seconds=3.0)
        off = frame(name), frame(seconds=3.0)
        seen[name] = [*on, *off]
    while FIXES[walk._fix].name != "R16":
        frame("next_fix")
    frame(seconds=3.0)
    seen["fix"] = frame("fix"), frame(seconds=3.0), frame("fix"), frame(seconds=3.0)
print(json.dumps([hint, seen]))
"""


def test_each_switch_has_an_effect_reports_it_and_undoes_it() -> None:
    done = python(STILLS, json.dumps(SMALL | {"trees.count": 3000}), env=environment())
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


def test_a_replay_gives_the_same_pixels_and_poses_in_every_frame(scripted) -> None:
    assert len(set(frame["hash"] for frame in scripted["live"])) > 20
    assert scripted["again"] == scripted["live"]


def test_a_replay_from_the_command_line_records_itself_again(scripted, tmp_path: Path) -> None:
    first, second = scripted["folder"] / "a.jsonl", tmp_path / "b.jsonl"
    done = landscape("walk", "--backend", "osmesa", "--replay", first, "--record", second)
    assert (done.status, done.err) == (0, "")
    assert done.out.strip() == str(second)
    assert second.read_bytes() == first.read_bytes()


def test_ctrl_c_ends_the_walk_in_one_line_and_keeps_the_recording(tmp_path: Path) -> None:
    path = tmp_path / "a.jsonl"
    path.write_text("earlier")
    words = ["walk", "fig4a", "--backend", "osmesa", "--size", "64x48", "--frames", "100000"]
    process = subprocess.Popen(
        [sys.executable, "-m", "landscape", *words, "--record", str(path), *SET],
        env=environment(),
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        deadline = time.monotonic() + 60
        while not any(p.stat().st_size > 10_000 for p in tmp_path.glob(".*.part")):
            assert process.poll() is None, process.stderr and process.stderr.read()
            assert time.monotonic() < deadline, "nothing was written"
            time.sleep(0.1)
        assert path.read_text() == "earlier"
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=30)
    finally:
        process.kill()
        process.wait()
    assert (process.returncode, err) == (130, "landscape: interrupted\n")
    plan, ticks = recording.read(path)
    assert len(ticks) > 10
    assert plan.only == ELEMENTS, "a view is where a walk starts, its switches are for stills"
    assert [p.name for p in tmp_path.iterdir()] == ["a.jsonl"]


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["--backend", "egl", "--frames", "1"], "--backend egl"),
        (["--backend", "osmesa"], "--frames"),
        (["--backend", "osmesa", "--replay", "none.jsonl"], "none.jsonl"),
        (["--backend", "osmesa", "--frames", "1", "--record", "none/a.jsonl"], "--record"),
        (["--backend", "osmesa", "--frames", "1", "--set", "rabbit.mesh=none.ply"], "none.ply"),
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
        server.terminate()
        server.wait()


def xdotool(screen: dict[str, str], *words: str) -> str:
    """Run xdotool; return what it prints."""
    done = subprocess.run(
        ["xdotool", *words], env=screen, capture_output=True, text=True, timeout=30
    )
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
        xdotool(screen, "windowsize", window, "300", "200")
        _wait_for(lambda: '"size": [300, 200]' in _text(tmp_path), process, "the new size")
        xdotool(screen, "key", "Escape")
        time.sleep(0.3)
        assert process.poll() is None, "Escape lets the mouse go before it leaves"
        xdotool(screen, "key", "Escape")
        assert process.wait(30) == 0
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
    return "".join(path.read_text() for path in folder.glob(".*.part"))


def _recorded(folder: Path) -> int:
    return len(_text(folder))


def _wait_for(condition, process: subprocess.Popen, what: str) -> None:
    deadline = time.monotonic() + 60
    while not condition():
        assert process.poll() is None, f"the walk ended while waiting for {what}"
        assert time.monotonic() < deadline, f"waited in vain for {what}"
        time.sleep(0.05)
