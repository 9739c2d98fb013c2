"""Random real keys, mouse and sizes of the window, and then the replay of what was recorded.

    python scripts/fuzz/real_keys.py                       # two minutes in each scene
    python scripts/fuzz/real_keys.py --minutes 10 --seed 7 island hall

It needs Xvfb and xdotool; where openbox or another window manager is installed, it runs there, too.
Each scene is walked in a process of its own, which knows nothing of it, by keys that are held and
tapped, the mouse, its buttons and its wheel, a gamepad, windows of all shapes, a lost focus, and
lists that are opened and shut. The fly-over is flown the same way, without the gamepad: its states
are read from a file in the place of GLFW, which finds no gamepad in an Xvfb. It is a finding if the
process

- writes to standard error, or ends with another status than 0;
- shows no frame, and no progress of a scene that it opens, for STUCK seconds, or does not end
  within PATIENCE seconds of being asked to;
- takes GROWTH MB more at the end than in the first half of the time in the scenes it has come to;
- or, for a walk, if a frame is replayed with another pose or another pixel. Every OFTEN-th frame is
  drawn once more in all detail, as a replay draws it, and its checksum compared. The inspector
  changes calls, which a recording does not contain: it is opened only in the last sixth, and from
  then on nothing is compared. Neither is what depends on the user's own preferences: what a list
  hides (F2, B), the keys in the help, and texts while their language or size is another.
"""

import argparse
import contextlib
import faulthandler
import hashlib
import json
import math
import os
import random
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
REPOSITORY = HERE.parents[1]
SCENES = ("island", "hall", "voxel", "flyover")
SCREEN = 1920, 1080
MANAGERS = "openbox", "icewm", "xfwm4"  # Alt+F4 closes a window in each of them
PAD = "pad.json"  # what holds the buttons and axes of a gamepad that there is not
BUILT = "built"  # a file that is as old as the last part of a scene that was built
OFTEN = 10  # chosen: frames between two that are compared
STUCK, PATIENCE = 60.0, 20.0  # seconds, chosen for a busy machine
GROWTH = 150.0  # MB, chosen
PARTS = 20  # chosen: of the time of a walk, in each of which its memory is a median
HELD = ("w", "a", "s", "d", "Up", "Down", "Left", "Right", "space", "c", "shift", "e", "w", "Up")
TAPPED = (
    *"fmxgrtpnvjulhbe123456789kqzy",
    *("F1", "F2", "F5", "F11", "F12", "Tab", "Return", "BackSpace", "Delete", "Home", "End"),
    *("plus", "minus", "KP_Add", "Page_Up", "Page_Down", "shift+n", "ctrl+s", "alt+Return"),
)
SHAPES = ((1900, 200), (300, 900), (1280, 720), (640, 480), (200, 150), (64, 64), (1, 1))


def watched(outcome: Path, words: list[str]) -> int:
    """Run the command line in this process; write what is shown to a file as JSON, line by line."""
    from framelens.gl.framebuffer import read_pixels
    from landscape.cli import main
    from landscape.flyover.app.window import Flying
    from landscape.walk.app import Walk
    from landscape.walk.pad import Pad, PadState
    from landscape.walk.waiting import Waiting

    faulthandler.register(signal.SIGUSR1)
    lines = outcome.open("w")
    drawn = {"frames": 0}
    walk_shows, flight_draws = Walk.present, Flying.draw

    def write(**what: object) -> None:
        lines.write(json.dumps({"frame": drawn["frames"], "at": time.monotonic(), **what}) + "\n")
        lines.flush()

    def present(walk: Any) -> None:
        number = drawn["frames"]
        drawn["frames"] += 1
        listed = bool(walk.hands.choosing)
        open_now = listed or walk.hands.captured or walk.hands.listing
        told: dict[str, object] = {"escapable": open_now, "inspecting": walk.inspection.open}
        told["scene"], told["size"] = walk.place.kind.name, walk._size
        if number % OFTEN == 0 and not walk.inspection.open:
            walk.draw(whole=True)
            own = walk.wishes.preferences
            shows_own = walk._help or own.language or own.text_size != 1.0
            if not (listed or shows_own):
                told["seen"] = hashlib.sha256(read_pixels(walk._size)).hexdigest()
            walker, place = walk.walker, walk.place.kind.name
            told["pose"] = [place, walker.x, walker.y, walker.z, walker.yaw, walker.pitch, walk.kt]
            if not own.language:
                told["said"] = walk._message
            if shots := os.environ.get("REAL_KEYS_PICTURES"):
                from PIL import Image

                name = f"{number:06d}.png"
                Image.fromarray(read_pixels(walk._size)).save(Path(shots) / name, compress_level=1)
        write(**told)
        walk_shows(walk)

    def draw(flight: Any) -> bool:
        shown = flight_draws(flight)
        drawn["frames"] += 1
        write(escapable=flight.hands.captured, inspecting=False)
        return shown

    def read_pad() -> PadState | None:
        try:
            buttons, axes = json.loads(outcome.with_name(PAD).read_text())
        except OSError:  # it is not connected yet
            return None
        return PadState(frozenset(buttons), tuple(axes))

    def begin(walk: Any, *given: Any, **more: Any) -> None:
        # A lesson would have the keys until it is closed.
        walk_begins(walk, *given, **more, run_command=lambda words: 0)
        if "--replay" not in words:
            walk._pad = Pad(read_pad)

    def step(waiting: Any, *given: Any) -> None:
        outcome.with_name(BUILT).touch()
        waiting_steps(waiting, *given)

    waiting_steps, walk_begins = Waiting.step, Walk.__init__
    Waiting.step = step  # type: ignore[method-assign]
    Walk.__init__, Walk.present = begin, present  # type: ignore[method-assign]
    Flying.draw = draw  # type: ignore[method-assign]
    return main(words)


def command(outcome: Path, words: list[str]) -> list[str]:
    """Return the command that runs a command line watched."""
    return [sys.executable, str(Path(__file__).resolve()), "--watched", str(outcome), *words]


class Screen:
    """An Xvfb, a window manager in it, and xdotool; use as a context manager."""

    def __init__(self, folder: Path, cache: Path) -> None:
        read, write = os.pipe()
        size = "x".join(map(str, (*SCREEN, 24)))
        started = ["Xvfb", "-displayfd", str(write), "-screen", "0", size, "-nolisten", "tcp"]
        self._processes = [
            subprocess.Popen([*started, "-noreset"], pass_fds=(write,), stderr=subprocess.DEVNULL)
        ]
        os.close(write)
        with os.fdopen(read) as pipe:
            self.env = os.environ | {"DISPLAY": f":{pipe.readline().strip()}"}
        self.env.pop("WAYLAND_DISPLAY", None)
        self.env |= {"HOME": str(folder), "LANDSCAPE_CONFIG": str(folder / "config")}
        self.env |= {"PYTHONPATH": str(REPOSITORY), "LANDSCAPE_CACHE": str(cache)}
        manager = next((name for name in MANAGERS if shutil.which(name)), "")
        self.manager = manager
        if manager:
            silent = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
            self._processes.append(subprocess.Popen([manager], env=self.env, **silent))  # type: ignore[call-overload]

    def do(self, *words: object) -> str:
        """Run xdotool; return what it prints. A window that is gone is no error."""
        done = subprocess.run(
            ["xdotool", *map(str, words)], env=self.env, capture_output=True, text=True, timeout=60
        )
        return done.stdout

    def __enter__(self) -> "Screen":
        return self

    def __exit__(self, *_: object) -> None:
        for process in reversed(self._processes):
            process.terminate()
        for process in self._processes:
            try:
                process.wait(5)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


def megabytes(pid: int) -> float:
    """Return how much memory a process has resident."""
    try:
        pages = Path(f"/proc/{pid}/statm").read_text().split()[1]
    except OSError:
        return 0.0
    return int(pages) * os.sysconf("SC_PAGE_SIZE") / 1e6


class Watcher:
    """Reads what a watched process writes, as far as it has got."""

    def __init__(self, path: Path) -> None:
        self._path, self._at, self._rest = path, 0, ""
        self.all: list[dict[str, Any]] = []

    def news(self) -> None:
        """Read on."""
        if not self._path.exists():
            return
        with self._path.open() as lines:
            lines.seek(self._at)
            text = self._rest + lines.read()
            self._at = lines.tell()
        *whole, self._rest = text.split("\n")
        self.all += [json.loads(line) for line in whole]

    @property
    def last(self) -> dict[str, Any]:
        """What was written last."""
        return self.all[-1] if self.all else {"frame": -1, "at": time.monotonic()}


def any_pad(chance: random.Random) -> tuple[list[int], list[float]]:
    """Return the buttons of a gamepad that are down, and where its axes are: at rest, or random."""
    buttons = chance.sample(range(15), chance.choice((0, 0, 0, 1, 1, 2)))
    if chance.random() < 0.3:
        return buttons, [0.0, 0.0, 0.0, 0.0, -1.0, -1.0]
    return buttons, [chance.choice((-1.0, 0.0, 1.0, chance.uniform(-1.0, 1.0))) for _ in range(6)]


def any_size(chance: random.Random) -> tuple[int, int]:
    """Return a random size of a window, in pixels: narrow ones are as frequent as wide ones."""
    width, height = (round(math.exp(chance.uniform(math.log(40), math.log(n)))) for n in SCREEN)
    return width, height


class Player:
    """Whoever presses random keys."""

    def __init__(self, screen: Screen, window: str, chance: random.Random, pad: Path) -> None:
        self._screen, self._window, self._chance, self._pad = screen, window, chance, pad
        self._down: set[str] = set()
        self.log: list[str] = []

    def _do(self, *words: object) -> None:
        self.log.append(f"{time.monotonic():.2f} {' '.join(map(str, words))}")
        self._screen.do(*words)

    def act(self, watcher: Watcher, inspecting: bool) -> None:
        """Do one random thing."""
        chance = self._chance
        what = chance.choices(
            (
                "hold",
                "leave",
                "tap",
                "several",
                "move",
                "click",
                "wheel",
                "size",
                "focus",
                "escape",
                "pad",
            ),
            (20, 14, 22, 6, 14, 8, 3, 4, 1, 8, 10),
        )[0]

        if what == "hold":
            key = chance.choice(HELD)
            self._down.add(key)
            self._do("keydown", key)
        elif what == "leave":
            for key in sorted(self._down):
                self._do("keyup", key)
            self._down.clear()
        elif what == "tap":
            self._do("key", chance.choice([*TAPPED, *"i" * inspecting]))
        elif what == "several":
            self._do("key", "--delay", 0, *chance.choices(TAPPED, k=chance.randint(2, 5)))

        elif what == "move":
            steps = [chance.randint(-200, 200), chance.randint(-120, 120)]
            self._do("mousemove_relative", "--", *steps)
        elif what == "click":
            self._do("mousemove", "--window", self._window, 100, 60)
            self._do("click", chance.choice((1, 1, 1, 2, 3)))
        elif what == "wheel":
            self._do("click", "--repeat", chance.randint(1, 4), chance.choice((4, 5)))

        elif what == "size":
            shape = chance.choice((*SHAPES, *(any_size(chance) for _ in SHAPES)))
            self._do("windowsize", self._window, *shape)
            if shape == (1, 1):  # where nothing is to be seen, a moment is enough
                time.sleep(0.5)
                self._do("windowsize", self._window, *SHAPES[3])
        elif what == "focus" and self._screen.manager:
            self._do("windowminimize", self._window)
            time.sleep(0.3)
            self._do("windowactivate", self._window)
        elif what == "escape":
            self._escape(watcher)
        elif what == "pad":
            self._turn_pad(any_pad(chance))

    def _turn_pad(self, state: tuple[list[int], list[float]]) -> None:
        """Let the walk find the gamepad in a state."""
        self.log.append(f"{time.monotonic():.2f} pad {state}")
        self._pad.with_suffix(".new").write_text(json.dumps(state))
        self._pad.with_suffix(".new").replace(self._pad)

    def _escape(self, watcher: Watcher) -> None:
        """Press Escape where something is open, which it closes.

        Where nothing is it would end the walk: what was done before must have shown.
        """
        begun, end = len(watcher.all), time.monotonic() + STUCK / 4
        while len(watcher.all) < begun + 2 and time.monotonic() < end:
            time.sleep(0.1)
            watcher.news()

        if len(watcher.all) >= begun + 2 and watcher.last.get("escapable"):
            self._do("key", "Escape")
            watcher.all[-1] |= {"escapable": False}

    def end(self) -> None:
        """Let all keys go, and ask the window to close as a user does."""
        for key in sorted(self._down):
            self._do("keyup", key)
        if self._screen.manager:
            self._do("windowactivate", self._window)
            self._do("key", "alt+F4")
        else:
            self._do("key", "Escape")


def played(
    scene: str, minutes: float, seed: int, folder: Path, screen: Screen
) -> tuple[list[str], dict[str, Any]]:
    """Walk a scene; return what is wrong, and what was counted."""
    chance = random.Random(f"{scene} {seed}")
    recorded, outcome = folder / "walk.jsonl", folder / "live.jsonl"
    flies = scene == "flyover"
    words = ["flyover", "canyon"] if flies else ["walk", scene, "--record", str(recorded)]
    if scene == "voxel":
        words += ["--world", str(folder / "my.world")]

    wrong: list[str] = []
    counted: dict[str, Any] = {}
    with (folder / "stderr.txt").open("w") as errors:
        process = subprocess.Popen(
            command(outcome, words),
            env=screen.env,
            cwd=folder,
            stdout=subprocess.DEVNULL,
            stderr=errors,
            start_new_session=True,
        )

    watcher = Watcher(outcome)
    memory: list[tuple[float, float]] = []
    scenes: set[str] = set()
    known = 0
    try:
        window = ""
        while process.poll() is None and not watcher.all:
            time.sleep(0.1)
            watcher.news()

        window = screen.do("search", "--onlyvisible", "--name", "^landscape").split("\n")[0]
        player = Player(screen, window, chance, folder / PAD)
        screen.do("windowactivate" if screen.manager else "windowfocus", window)

        begun = time.monotonic()
        while process.poll() is None and (spent := time.monotonic() - begun) < 60 * minutes:
            player.act(watcher, spent > 50 * minutes)
            time.sleep(chance.choice((0.02, 0.1, 0.3, 0.8)))
            watcher.news()

            memory.append((spent / 60 / minutes, megabytes(process.pid)))
            scenes |= {line["scene"] for line in watcher.all[-20:] if "scene" in line}
            if len(scenes) > known:  # a scene that is entered first takes its memory
                known, memory = len(scenes), memory[-1:]

            quiet = time.monotonic() - watcher.last["at"]
            if (folder / BUILT).exists():
                quiet = min(quiet, time.time() - (folder / BUILT).stat().st_mtime)
            if quiet > STUCK / 6:  # a full-screen window that lost the focus has gone by itself
                screen.do("windowactivate" if screen.manager else "windowfocus", window)
            if quiet > STUCK:
                wrong.append(f"no frame for {quiet:.0f} s after frame {watcher.last['frame']}")
                process.send_signal(signal.SIGUSR1)  # it writes where it is
                break

        if process.poll() is not None:
            wrong.append(f"ended by itself, with status {process.returncode}")

        asked = time.monotonic()
        player.end()
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(PATIENCE)

        counted["ended_in"] = round(time.monotonic() - asked, 2)
        if process.poll() is None:
            wrong.append(f"did not end within {PATIENCE:g} s")
            process.send_signal(signal.SIGUSR1)
            time.sleep(1.0)
        elif process.returncode:
            wrong.append(f"ended with status {process.returncode}")
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()

    watcher.news()
    (folder / "did.txt").write_text("\n".join(player.log) + "\n")
    (folder / "memory.txt").write_text("".join(f"{p:.3f} {mb:.0f}\n" for p, mb in memory))
    if used := halves(memory):
        early, late = used
        counted["megabytes"] = [round(early), round(late)]
        if late - early > GROWTH:
            wrong.append(f"grew from {early:.0f} to {late:.0f} MB")

    counted |= {"frames": len(watcher.all), "events": len(player.log)}
    if said := (folder / "stderr.txt").read_text():
        wrong.append(f"standard error: {said[:2000]}")

    if not flies and not any("did not end" in each for each in wrong):
        found, compared = replayed(recorded, watcher.all, folder, screen)
        wrong += found
        counted["compared"] = compared
    return wrong, counted


def halves(memory: list[tuple[float, float]]) -> tuple[float, float] | None:
    """Return the most megabytes in the first half of a walk, and the least at its end.

    ``memory`` has the part of the time that had passed, 0..1, and megabytes. They are medians of
    twentieths of the time: what a frame takes for a moment is no growth. None if too little of the
    walk was measured.
    """
    first = memory[0][0] if memory else 0.0
    parts: dict[int, list[float]] = {}
    for part, mb in memory:
        if part > first:
            parts.setdefault(int(PARTS * (part - first) / (1.0 - first)), []).append(mb)
    usual = {number: statistics.median(each) for number, each in parts.items()}
    early = [mb for number, mb in usual.items() if number < PARTS / 2]
    late = [mb for number, mb in usual.items() if number >= 0.85 * PARTS]
    return (max(early), min(late)) if early and late and first < 0.6 else None


def replayed(
    recorded: Path, live: list[dict[str, Any]], folder: Path, screen: Screen
) -> tuple[list[str], int]:
    """Replay a recording without a screen; return what differs, and how many were compared."""
    if not recorded.exists():
        return ["nothing was recorded"], 0

    outcome = folder / "replay.jsonl"
    words = ["walk", "--replay", str(recorded), "--backend", "osmesa"]
    env = {name: value for name, value in screen.env.items() if name != "DISPLAY"}
    env["LANDSCAPE_CONFIG"] = str(folder / "none")
    done = subprocess.run(command(outcome, words), env=env, cwd=folder, capture_output=True)
    wrong = [f"replay: {done.stderr.decode()[:500]}"] if done.stderr or done.returncode else []

    again = Watcher(outcome)
    again.news()
    compared = different = 0
    for now, then, following in zip(live, again.all, [*live[1:], {}], strict=False):
        if now["inspecting"]:
            break
        if "pose" not in now:
            continue

        compared += 1
        # The window may have got its new size while the frame was drawn.
        resized = following.get("size") != now["size"]
        other = [
            key
            for key in ("size", "pose", "said", *(() if resized else ("seen",)))
            if key in now and now[key] != then.get(key)
        ]
        if other:
            different += 1
            if different == 1:
                first = {key: (now[key], then.get(key)) for key in other}
                wrong.append(f"frame {now['frame']} is replayed otherwise: {first}")

    if different:
        wrong.append(f"{different} of {compared} frames are replayed otherwise")
    elif not 0 <= len(again.all) - len(live) <= 1:  # the last one may have been left half-way
        wrong.append(f"{len(live)} frames were drawn, {len(again.all)} replayed")
    return wrong, compared


def folders(root: Path | None) -> Iterator[Path]:
    """Yield new folders."""
    while True:
        yield Path(tempfile.mkdtemp(prefix="real-keys-", dir=root))


def main() -> int:
    """Play each scene; return 1 if anything was found."""
    if sys.argv[1:2] == ["--watched"]:
        sys.path.insert(0, str(REPOSITORY))
        return watched(Path(sys.argv[2]), sys.argv[3:])

    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help=", ".join(SCENES))
    parser.add_argument("--minutes", type=float, default=2.0, help="in each scene")
    parser.add_argument("--seed", type=int, default=random.randrange(10**6))
    parser.add_argument("--folder", type=Path, help="where what was recorded and seen is kept")
    parser.add_argument("--cache", type=Path, help="the program's cache; default: an empty one")
    options = parser.parse_args()

    for scene in options.scenes:
        if scene not in SCENES:
            parser.error(f"{scene}: expected some of {', '.join(SCENES)}")

    print(f"seed {options.seed}", flush=True)
    if options.folder:
        options.folder.mkdir(parents=True, exist_ok=True)

    found = False
    cache = options.cache or Path(tempfile.mkdtemp(prefix="real-keys-cache-", dir=options.folder))
    for scene, folder in zip(options.scenes or SCENES, folders(options.folder), strict=False):
        with Screen(folder, cache) as screen:
            wrong, counted = played(scene, options.minutes, options.seed, folder, screen)
        told = ", ".join(f"{key} {value}" for key, value in counted.items())
        print(f"{scene}: {told}; {folder}", *wrong or ["nothing found"], sep="\n    ", flush=True)
        found = found or bool(wrong)
    return int(found)


if __name__ == "__main__":
    sys.exit(main())
