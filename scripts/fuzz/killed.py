"""Kills what writes files, at random moments, and looks whether anything is lost or left.

    python scripts/fuzz/killed.py                    # each kind 200 times
    python scripts/fuzz/killed.py --times 20 world film

A copy of this process saves a world, a film, assets or a recording over an earlier file, and is
killed (SIGKILL). Then the file must be the earlier one or the new one, whole. Once another has
written it to the end, nothing may lie beside it; and no process may be left. A film in parts begins
with some of its parts; each must be whole, or not there. It needs POSIX.
"""

import argparse
import os
import random
import signal
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path

SIZE = (64, 48)
EARLIER = b"earlier" * 1000
PARTS = "parts"  # a folder of files of which some are deleted before each try
ASSETS = ("castle_light.png",)  # the one that is made soonest
OFTEN = 20  # chosen: kills until the file is written to the end again
PATIENCE = 5.0  # seconds, chosen: until processes that were left must have ended


class World:
    """The scene of a walk that saves its world, of some megabytes."""

    changes = slot = count = 0
    is_changed = True

    def use(self, *_: object) -> str:
        return ""

    choose = bar = covered = restore = merged = use

    def saved(self) -> bytes:
        self.count += 1
        return b"%08d" % self.count * 1_000_000


def world(folder: Path) -> None:
    """Save a world."""
    from landscape.walk.builder import WorldFile

    file, scene = WorldFile(folder / "my.world"), World()
    file.opened(scene)
    file.save(scene)  # type: ignore[arg-type]


def recording(folder: Path) -> None:
    """Record a walk."""
    from landscape.scene.scene import find_view
    from landscape.walk.recording import Plan, Tick, Writer
    from landscape.walk.walker import Intent

    kind, view = find_view("fig35a")
    writer = Writer(folder / "walk.jsonl", Plan("island", kind.settings, "fig35a", view.pose, SIZE))
    for _ in range(3000):
        writer.add(Tick(0.05, Intent(forward=1), (), SIZE))
    writer.finish()


def assets(folder: Path) -> None:
    """Build assets."""
    from landscape.studio.build import build

    build(list(ASSETS), folder, quiet=True)


def film(folder: Path, *words: str, jobs: int = 1, seconds: float = 0.4) -> None:
    """Draw a film."""
    from landscape.cli import main

    given = ["film", "fig2a", "--out", str(folder / "film.gif"), "--size", "64x48", "-q"]
    given += ["--seconds", str(seconds), "--fps", "10", "--preset", "2006", "--only", "sky"]
    assert main([*given, "--jobs", str(jobs), *words]) == 0


def film_by_two(folder: Path) -> None:
    """Draw a film by two processes more."""
    film(folder, jobs=2)


def film_in_parts(folder: Path, jobs: int = 1) -> None:
    """Draw a film in three parts, which stay in a folder."""
    film(folder, "--parts", str(folder / PARTS), jobs=jobs, seconds=9.0)


def film_in_parts_by_two(folder: Path) -> None:
    """Draw a film in parts by two processes more."""
    film_in_parts(folder, 2)


KINDS: dict[str, tuple[Callable[[Path], None], Sequence[str]]] = {
    "world": (world, ["my.world"]),
    "recording": (recording, ["walk.jsonl"]),
    "assets": (assets, ASSETS),
    "film": (film, ["film.gif"]),
    "film_by_two": (film_by_two, ["film.gif"]),
    "film_in_parts": (film_in_parts, ["film.gif"]),
    "film_in_parts_by_two": (film_in_parts_by_two, ["film.gif"]),
}


def begun(work: Callable[[Path], None], folder: Path) -> int:
    """Start a copy of this process that does the work, in a session of its own; return its id."""
    pid = os.fork()
    if pid:
        return pid
    status = 1
    try:
        os.setsid()
        silent = os.open(os.devnull, os.O_RDWR)
        for number in range(3):
            os.dup2(silent, number)
        work(folder)
        status = 0
    finally:
        os._exit(status)


def left_of(session: int) -> list[int]:
    """Return the processes of a session that live."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            state, _parent, _group, its = (
                (entry / "stat").read_text().rpartition(") ")[2].split()[:4]
            )
        except OSError:
            continue
        if int(its) == session and state != "Z":
            found.append(int(entry.name))
    return found


def outlived(session: int) -> list[int]:
    """Return the processes of a session that have not ended after a while."""
    end = time.monotonic() + PATIENCE
    while (found := left_of(session)) and time.monotonic() < end:
        time.sleep(0.05)
    return found


def complete(work: Callable[[Path], None], folder: Path) -> float:
    """Do the work to its end; return how long it took."""
    start = time.monotonic()
    _pid, status = os.waitpid(begun(work, folder), 0)
    assert status == 0, f"ended with {status}"
    return time.monotonic() - start


def files_in(folder: Path) -> set[str]:
    """Return the names of all files in a folder and those in it."""
    return {str(each.relative_to(folder)) for each in folder.rglob("*") if not each.is_dir()}


def tried(kind: str, times: int, chance: random.Random) -> list[str]:
    """Kill one kind of work so many times; return what was wrong, and print what happened."""
    work, names = KINDS[kind]
    wrong: list[str] = []
    counts = {"earlier": 0, "new": 0}
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place).resolve()
        complete(work, folder)  # the first time it may import
        parts = [f"{PARTS}/{name}" for name in sorted(files_in(folder / PARTS))]
        new = {name: (folder / name).read_bytes() for name in (*names, *parts)}
        for part in parts:
            (folder / part).unlink()

        longest = complete(work, folder)
        for number in range(times):
            for name in names:
                (folder / name).write_bytes(EARLIER)
            for part in parts:
                if chance.random() < 0.5:
                    (folder / part).unlink(missing_ok=True)

            pid = begun(work, folder)
            time.sleep(chance.uniform(0, longest * 1.1))
            os.kill(pid, signal.SIGKILL)
            os.waitpid(pid, 0)
            if processes := outlived(pid):
                wrong.append(f"{kind} {number}: processes are left: {processes}")

            for name in names:
                data = (folder / name).read_bytes() if (folder / name).exists() else b""
                if data not in (EARLIER, new[name]):
                    wrong.append(f"{kind} {number}: {name} has {len(data)} other bytes")
                counts["new" if data == new[name] else "earlier"] += 1
            for part in filter(lambda part: (folder / part).exists(), parts):
                if (folder / part).read_bytes() != new[part]:
                    wrong.append(f"{kind} {number}: {part} is not whole")

            if number % OFTEN == OFTEN - 1 or number == times - 1:
                complete(work, folder)
                rubbish = sorted(files_in(folder) - set(new))
                if rubbish:
                    wrong.append(f"{kind} {number}: left behind: {', '.join(rubbish)}")

    print(f"{kind}: {times} kills within {longest:.2f} s: {counts}, {len(wrong)} wrong", flush=True)
    return wrong


def main() -> int:
    """Return 0 if nothing was lost or left, else 1."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("kinds", nargs="*", metavar="KIND", help=", ".join(KINDS))
    parser.add_argument("--times", type=int, default=200, help="kills of each kind")
    parser.add_argument("--seed", type=int, default=random.randrange(1 << 32))
    options = parser.parse_args()
    print(f"seed {options.seed}")
    chance = random.Random(options.seed)
    wrong = [each for kind in options.kinds or KINDS for each in tried(kind, options.times, chance)]
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    # What the work imports, so that its copies need not.
    import landscape.cli
    import landscape.commands.film
    import landscape.film.making
    import landscape.island.island
    import landscape.studio.build
    import landscape.walk.builder
    import landscape.walk.recording  # noqa: F401

    sys.exit(main())
