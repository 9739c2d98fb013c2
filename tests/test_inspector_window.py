"""The inspector in a window, with real keys and a real mouse under Xvfb.

The walk runs in a process of its own. It writes a line of JSON for each frame whose content is new:
what is chosen, the edits, where things are in the panel, and a hash of the picture without it.
"""

import json
import os
import selectors
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from commands import SECONDS, end, environment, landscape, python

from framelens.tape.edit_files import read, write
from framelens.tape.edits import Edit, Key, located_at
from landscape.offscreen import Offscreen

pytestmark = pytest.mark.window

WALK = """
import hashlib, json, sys
from framelens.tape.edits import as_code
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.settings.declare import with_settings
from landscape.elements.settings import preset
from landscape.walk.app import Walk
from landscape.walk.loop import run
from landscape.walk.recording import Plan

class Watched(Walk):
    told, pressed = "", 0
    def advance(self, tick):
        super().advance(tick)
        press = self.inspection.model.press
        if press.__name__ == "press":
            def counted(pick):
                self.pressed += 1
                press(pick)
            self.inspection.model.press = counted
    def draw(self, whole=False):
        inspection = self.inspection
        drawn = inspection.draw
        def noting(*args):
            drawn(*args)
            self.seen = self.pixels()
        inspection.draw = noting
        super().draw(whole)
        inspection.draw = drawn
    def present(self):
        super().present()
        model, shown = self.inspection.model, self.inspection.shown
        found = model.found
        margin = self._size[1] // 48
        top = (self._size[1] - shown.image.shape[0]) // 2 if shown else 0
        entry = {
            "pressed": self.pressed,
            "open": model.open, "stopped": model.stopped, "calls": model.tree.count,
            "node": model.node.name if model.node else "",
            "call": as_code(found.call) if found else "",
            "inside": bool(found and found.key.list), "off": bool(found and model.is_off(found)),
            "edits": [[e.key.name, e.value, e.skip] for e in model.edits],
            "history": [row.outcome for row in model.history or ()],
            "effects": len(model.effects), "said": model.said[0],
            "boxes": [[margin + (x + right) / 2, top + (y + below) / 2, list(target)]
                      for x, y, right, below, target in (shown.boxes if shown else ())],
            "hash": hashlib.sha256(self.seen).hexdigest(),
        }
        line = json.dumps(entry)
        if line != self.told:
            self.told = line
            print(line, flush=True)

pose = Pose(*json.loads(sys.argv[1]))
changes = {"ground.resolution": 40, "clock.kt_per_second": 0.0} | json.loads(sys.argv[2])
values = with_settings(preset("2006"), changes)
plan = Plan("island", values, "", pose, (640, 480), 20.0, 2006, ("ground", "water", "sky", "fog"))
with Watched(plan, Assets()) as walk:
    run(walk)
"""
POSE = (20.0, None, 30.0, 190.0, -8.0)


class Driven:
    """A walk that is driven by keys and the mouse, and tells what it shows."""

    def __init__(self, screen: dict[str, str], folder: Path, **settings: float) -> None:
        self._screen, self._now = screen, {}
        self._process = subprocess.Popen(
            [sys.executable, "-c", WALK, json.dumps(POSE), json.dumps(settings)],
            env=screen,
            cwd=folder,
            stdout=subprocess.PIPE,
        )
        self._lines = self._process.stdout
        assert self._lines is not None
        os.set_blocking(self._lines.fileno(), False)
        self._selector = selectors.DefaultSelector()
        self._selector.register(self._lines, selectors.EVENT_READ)
        self._rest = b""
        self.window = self.tool("search", "--sync", "--onlyvisible", "--name", "^landscape")
        self.tool("windowfocus", "--sync", self.window)

    def tool(self, *words: str) -> str:
        done = subprocess.run(
            ["xdotool", *words], env=self._screen, capture_output=True, text=True, timeout=SECONDS
        )
        assert done.returncode == 0, done.stderr
        return done.stdout.strip()

    def until(self, condition: Callable[[dict[str, Any]], Any], what: str) -> dict[str, Any]:
        """Return the first frame from now on of which the condition is true."""
        deadline = time.monotonic() + SECONDS
        while not (self._now and condition(self._now)):
            assert time.monotonic() < deadline, f"waited in vain for {what}: {self._now}"
            assert self._process.poll() is None, f"the walk ended while waiting for {what}"
            self._selector.select(0.2)
            self._rest += self._lines.read() or b""
            *lines, self._rest = self._rest.split(b"\n")
            for line in lines:
                self._now = json.loads(line)
                if condition(self._now):
                    break
            else:
                continue
            self._rest = b"\n".join([*lines[lines.index(line) + 1 :], self._rest])
        return self._now

    def key(self, key: str) -> None:
        """Press a key and wait until the inspector has taken it."""
        pressed = self._now["pressed"] + 1
        self.tool("key", key)
        self.until(lambda now: now["pressed"] == pressed, f"the key {key}")

    def open(self) -> dict[str, Any]:
        """Open the inspector; return what it shows when it has looked into the frame."""
        self.tool("key", "i")
        return self.until(lambda now: now["effects"], "the effects of the calls")

    def go(self, key: str, condition: Callable[[dict[str, Any]], Any], what: str) -> dict[str, Any]:
        """Press a key until the condition is true, at most 60 times."""
        for _ in range(60):
            if condition(self._now):
                return self._now
            self.key(key)
        raise AssertionError(f"{what} was not reached: {self._now}")

    def place(self, *target: Any) -> tuple[int, int]:
        """Return where a target of the panel is."""
        wanted = json.loads(json.dumps(target))
        return next((int(x), int(y)) for x, y, what in self._now["boxes"] if what == wanted)

    def end(self) -> None:
        self._process.kill()
        self._process.wait()
        self._selector.close()
        self._lines.close()


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
        yield environment(DISPLAY=f":{number}", LANG="C")
    finally:
        end(server)


@pytest.fixture
def driven(screen: dict[str, str], tmp_path: Path) -> Iterator[Driven]:
    walk = Driven(screen, tmp_path)
    try:
        walk.until(lambda now: now["hash"], "the first frame")
        yield walk
    finally:
        walk.end()


@pytest.mark.seldom(14)
def test_keys_open_it_change_the_fog_and_undo_it(
    driven: Driven, screen: dict[str, str], tmp_path: Path
) -> None:
    plain = driven.until(lambda now: now["hash"], "a frame")["hash"]
    opened = driven.open()
    assert opened["stopped"] and opened["calls"] > 50 and opened["said"] == "inspector.under"
    assert opened["call"], "the call under the cross-hair is chosen"
    assert opened["hash"] == plain, "looking changes nothing"
    driven.key("Home")
    driven.go("Down", lambda now: now["node"] == "fog", "the fog")
    driven.key("Right")
    driven.go("Down", lambda now: now["call"].startswith("glFogf(GL_FOG_DENSITY"), "glFogf")
    driven.go("equal", lambda now: now["edits"] and now["edits"][0][1] > 0.13, "a denser fog")
    dense = driven.until(lambda now: now["hash"] != plain, "another picture")
    other = Driven(screen, tmp_path, **{"fog.density": dense["edits"][0][1]})
    try:
        assert other.until(lambda now: now["hash"], "its picture")["hash"] == dense["hash"]
    finally:
        other.end()

    driven.key("ctrl+s")
    driven.until(lambda now: now["said"] == "saved", "the file of edits")
    (edit,) = read(tmp_path / "edits-0001.json")
    assert (edit.key.name, edit.value) == ("glFogf", dense["edits"][0][1])
    driven.key("BackSpace")
    driven.until(lambda now: not now["edits"] and now["hash"] == plain, "the former picture")
    driven.key("Delete")
    driven.until(lambda now: now["off"] and now["hash"] != plain, "no density")
    driven.key("ctrl+z")
    driven.until(lambda now: not now["off"] and now["hash"] == plain, "the former picture")
    driven.key("Escape")
    driven.until(lambda now: not now["open"], "the walk")


@pytest.mark.seldom(14, first=10)
def test_the_mouse_drags_a_number_inside_a_display_list(driven: Driven) -> None:
    plain = driven.until(lambda now: now["hash"], "a frame")["hash"]
    driven.open()

    # A click into the sky finds its quad, in a display list, and every draw there.
    driven.tool("mousemove", "--window", driven.window, "600", "12", "click", "1")
    found = driven.until(lambda now: now["history"], "the pixel's history")
    assert "drawn" in found["history"]
    driven.key("Return")
    driven.until(lambda now: not now["history"], "the tree")
    driven.go("Up", lambda now: now["call"].startswith("glColor4f"), "the sky's colour")
    assert driven.until(lambda now: True, "the row")["inside"]
    x, y = driven.place("cell", (1, None, ""))
    driven.tool("mousemove", "--window", driven.window, str(x), str(y), "mousedown", "1")
    for step in range(1, 5):
        driven.tool("mousemove", "--window", driven.window, str(x - 10 * step), str(y))
    driven.tool("mouseup", "1")
    edited = driven.until(lambda now: now["hash"] != plain and now["edits"], "another sky")
    name, value, skip = edited["edits"][0]
    assert (name, skip) == ("glColor4f", False) and 0.0 < value < 1.0
    driven.key("ctrl+z")
    driven.until(lambda now: not now["edits"] and now["hash"] == plain, "the former sky")

    # An enumerant by a click on its name, among the legal ones.
    driven.go("Down", lambda now: now["call"].startswith("glBegin"), "the quad")
    driven.tool(
        "mousemove", "--window", driven.window, *map(str, driven.place("choice", "GL_LINES"))
    )
    driven.tool("click", "1")
    driven.until(lambda now: now["edits"] == [["glBegin", "GL_LINES", False]], "lines")
    driven.until(lambda now: now["hash"] != plain, "lines")
    driven.key("ctrl+BackSpace")
    driven.until(lambda now: not now["edits"] and now["hash"] == plain, "the former sky")


SETUP = """
import hashlib, json, sys
from pathlib import Path
from framelens.tape.edit_files import read
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.scene.scene import scene
from landscape.walk import waiting
from landscape.walk.app import Walk
from landscape.walk.recording import Plan, Tick
from landscape.walk.walker import Intent

waiting.OFTEN = -1.0  # the progress is shown before each element, as on a slow computer
kind = scene()
values = kind.values("2006", {"ground.resolution": 40})
plan = Plan("island", values, "", Pose(20.0, None, 30.0, 190.0), (64, 48), only=("sky",))
hashes = []

def frames(walk, count=1):
    for _ in range(count):
        walk.listen()
        walk.advance(Tick(0.0, Intent(), (), (64, 48)))
        walk.draw()
    hashes.append(hashlib.sha256(walk.pixels()).hexdigest())

with Walk(plan, Assets(), "osmesa") as walk:
    frames(walk)
with Walk(plan, Assets(), "osmesa", edits=read(Path(sys.argv[1]))) as walk:
    frames(walk)
    walk.inspection.model.press("undo_all")
    frames(walk, 2)
    walk.inspection.model.press("undo")
    frames(walk, 2)
    missed = walk.inspection.missed()
print(json.dumps([hashes, missed]))
"""


@pytest.mark.seldom(10, first=2)
def test_an_edit_of_what_is_built_is_undone_by_building_the_scene_again(tmp_path: Path) -> None:
    path = tmp_path / "edits.json"
    with Offscreen((64, 48), "2006", only="sky", samples=0) as view, view.taped("fig35a") as tape:
        filters = [
            located_at(tape.calls, tape.begin, str(call.number)).edit(2, "GL_NEAREST")
            for call in tape.calls
            if call.element == "sky" and "GL_TEXTURE_MIN_FILTER" in call.shown
        ]
    write(filters, path)
    done = python(SETUP, str(path), env=environment())
    assert done.status == 0, done.err
    (plain, edited, undone, again), missed = json.loads(done.out)
    assert missed == [] and plain == undone != edited == again


@pytest.mark.seldom(13, first=1)
def test_a_walk_tells_of_edits_without_a_call_and_that_a_recording_has_none(tmp_path: Path) -> None:
    key = Key("glFogf", "nowhere", "main", "landscape/elements/fog.py", "enable", "", ())
    write([Edit(key, 0, 1, 0.3)], tmp_path / "e.json")
    words = ("--backend", "osmesa", "--size", "64x48", "--frames", "2", "--only", "sky")
    files = ("--edits", tmp_path / "e.json", "--record", tmp_path / "a.jsonl")
    done = landscape("walk", "fig35a", *words, *files, "--lang", "en")
    assert done.status == 0 and done.err.count("\n") == 2
    assert "e.json: edit 1: no call glFogf of nowhere" in done.err
    assert "a recording does not contain edits" in done.err
