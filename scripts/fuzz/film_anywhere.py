"""Draws one film in several ways, and kills who draws it: the file must always be the same.

    python scripts/fuzz/film_anywhere.py fig35a --preset 2006
    python scripts/fuzz/film_anywhere.py fig2a --frames 240 --size 64x48 --kills 3

The film is drawn by one process, by two, by two workers of Dask on 127.0.0.1, and by two commands
that share a folder. Then a worker, the scheduler or the command is killed (SIGKILL) after a random
time, or a worker is stopped for a while (SIGSTOP), and what was cut off is repeated with the same
command, until the film is done. A frame may be drawn twice only if its part was not there yet when
somebody was killed. The last line is the verdict. It needs POSIX and the extra `cluster`.
"""

import argparse
import hashlib
import os
import random
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections import defaultdict
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

LOG = "FRAMES_LOG"  # names the file in which each process notes the frames that it draws
FPS = 30
PART = 120  # frames, four seconds
PATIENCE = 30.0  # seconds, chosen: until a scheduler has written its file
EARLY = 0.8  # chosen: how often those who still begin are spared
VICTIMS = ("worker", "scheduler", "stopped worker", "command")


def note_frames(log: str) -> None:
    """Let this process note each frame of a film that it draws: time in ns, process, number."""
    from landscape.film import frames

    opened = frames._Opened
    if opened.__name__ == "Noting":  # Dask preloads it twice
        return

    class Noting(opened):  # type: ignore[misc, valid-type]
        """A film that notes its frames."""

        def __init__(self, packed: bytes) -> None:
            super().__init__(packed)
            draw = self.picture

            def picture(number: int) -> object:
                with open(log, "a", encoding="ascii") as file:
                    file.write(f"{time.time_ns()} {os.getpid()} {number}\n")
                return draw(number)

            self.picture = picture

    frames._Opened = Noting  # type: ignore[misc]


# Workers, too, come here: a process that is spawned runs the file of its parent again, and a
# worker of Dask preloads it.
if LOG in os.environ and __name__ != "__main__":
    note_frames(os.environ[LOG])


@dataclass(frozen=True)
class Drawn:
    """A frame that was drawn: when, in ns, and by which process."""

    when: int
    pid: int
    number: int


def drawn(log: Path) -> list[Drawn]:
    """Return the frames in a log, in order of time."""
    lines = log.read_text("ascii").splitlines() if log.exists() else []
    return sorted((Drawn(*map(int, line.split())) for line in lines), key=lambda each: each.when)


class Farm:
    """Where the film is drawn: its command, its log, and the cluster beside it."""

    def __init__(self, folder: Path, words: Sequence[str]) -> None:
        """Start nothing yet."""
        self.folder, self.words = folder, words
        self.log = folder / "frames"

    def command(self, *words: str) -> "subprocess.Popen[bytes]":
        """Start the film's command, which notes its frames."""
        return self._start(str(Path(__file__).resolve()), "--noted", *self.words, *words)

    def _start(self, *words: str) -> "subprocess.Popen[bytes]":
        env = {**os.environ, LOG: str(self.log), "LP_NUM_THREADS": "0"}
        with open(self.folder / "output", "ab") as output:
            return subprocess.Popen(
                [sys.executable, *words],
                stdout=output,
                stderr=output,
                env=env,
                cwd=self.folder,
                start_new_session=True,
            )

    @contextmanager
    def cluster(self) -> "Iterator[dict[str, subprocess.Popen[bytes]]]":
        """Provide a scheduler with two workers, and end them."""
        file = self.folder / "scheduler.json"
        file.unlink(missing_ok=True)
        alike = ["--host", "127.0.0.1", "--dashboard-address", "127.0.0.1:0"]
        alike += ["--no-dashboard", "--scheduler-file", str(file)]
        found = {"scheduler": self._start("-m", "dask", "scheduler", "--port", "0", *alike)}
        end = time.monotonic() + PATIENCE
        while not file.is_file():
            if time.monotonic() > end:
                raise SystemExit((self.folder / "output").read_text())
            time.sleep(0.05)
        words = ["--nworkers", "2", "--nthreads", "1", "--memory-limit", "0"]
        words += ["--local-directory", str(self.folder / "scratch"), "--preload", __file__]
        found["workers"] = self._start("-m", "dask", "worker", *alike, *words)
        try:
            yield found
        finally:
            for process in reversed(found.values()):
                end_all(process)


def end_all(process: "subprocess.Popen[bytes]") -> None:
    """Kill a process and all that it has started; it may have ended."""
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def children(pid: int) -> list[int]:
    """Return the processes that a process has started, and theirs, the last ones first."""
    threads = Path(f"/proc/{pid}/task").glob("*/children")
    found = [each for thread in threads for each in thread.read_text("ascii").split()]
    return [each for child in map(int, found) for each in (*children(child), child)]


def workers_of(nanny: int) -> list[int]:
    """Return the processes that work for the command `dask worker`."""
    return [
        pid for pid in children(nanny) if b"spawn_main" in Path(f"/proc/{pid}/cmdline").read_bytes()
    ]


def in_ways(folder: Path, words: Sequence[str]) -> dict[str, Path]:
    """Draw the film in each way; return its files."""
    files: dict[str, Path] = {}

    def ended(way: str, *commands: "subprocess.Popen[bytes]") -> None:
        for command in commands:
            if command.wait():
                raise SystemExit((folder / "output").read_text())
        print(f"{way}: {time.monotonic() - begun:.0f} s", flush=True)

    for way, more in {"jobs_1": ["--jobs", "1"], "jobs_2": ["--jobs", "2"]}.items():
        begun = time.monotonic()
        files[way] = folder / f"{way}.mp4"
        ended(way, Farm(folder, words).command(*more, "--out", str(files[way])))
    farm = Farm(folder, words)
    with farm.cluster():
        begun = time.monotonic()
        files["engine"] = folder / "engine.mp4"
        more = ["--engine", "scheduler.json", "--out", str(files["engine"])]
        ended("engine", farm.command(*more))
    begun = time.monotonic()
    shared = ["--parts", "shared", "--share", "--jobs", "1", "--out"]
    for name in ("share_1", "share_2"):
        files[name] = folder / f"{name}.mp4"
    pair = [farm.command(*shared, str(files[name])) for name in ("share_1", "share_2")]
    ended("share", *pair)
    return files


def killed(
    folder: Path,
    words: Sequence[str],
    kills: int,
    longest: float,
    stop: float,
    chance: random.Random,
) -> tuple[Path, "Frames"]:
    """Draw the film while somebody is killed so many times; return its file, and what was drawn.

    ``longest`` is the most seconds between two kills, ``stop`` for how many a worker is stopped.
    """
    farm, out = Farm(folder, words), folder / "killed.mp4"
    farm.log.unlink(missing_ok=True)
    more = ["--engine", "scheduler.json", "--parts", "parts", "--out", str(out)]
    times: list[tuple[int, str]] = []
    ends: list[int] = []  # of clusters, whose workers are killed, too
    while not out.is_file():
        before = len(drawn(farm.log))
        with farm.cluster() as found:
            command = farm.command(*more)
            while command.poll() is None:
                try:
                    command.wait(chance.uniform(0.0, longest))
                except subprocess.TimeoutExpired:
                    if len(drawn(farm.log)) == before and chance.random() < EARLY:
                        continue
                    if len(times) < kills:
                        victim = kill(found, command, chance.choice(VICTIMS), stop, chance)
                        times.append((time.time_ns(), victim))
            end_all(command)
        ends.append(time.time_ns())
    there = len(list((folder / "parts").glob("part-*")))
    print(f"killed: {', '.join(victim for _, victim in times)}; {there} parts", flush=True)
    deaths = [when for when, victim in times if victim != "stopped worker"]
    return out, frames_of(farm.log, folder / "parts", [*deaths, *ends])


def kill(
    found: "dict[str, subprocess.Popen[bytes]]",
    command: "subprocess.Popen[bytes]",
    victim: str,
    stop: float,
    chance: random.Random,
) -> str:
    """Kill somebody, or stop a worker for so many seconds; return who it was."""
    with suppress(ProcessLookupError, FileNotFoundError):
        pids = workers_of(found["workers"].pid) if victim.endswith("worker") else []
        if victim.endswith("worker") and not pids:
            victim = "scheduler"  # the workers have not begun yet
        if victim == "stopped worker":
            pid = chance.choice(pids)
            os.kill(pid, signal.SIGSTOP)
            timer = threading.Timer(stop, go_on, [pid])
            timer.daemon = True
            timer.start()
        elif pids:
            os.kill(chance.choice(pids), signal.SIGKILL)
        else:
            os.kill(command.pid if victim == "command" else found["scheduler"].pid, signal.SIGKILL)
    return victim


def go_on(pid: int) -> None:
    """Let a process that was stopped go on; it may have been killed."""
    with suppress(ProcessLookupError):
        os.kill(pid, signal.SIGCONT)


@dataclass(frozen=True)
class Frames:
    """What was drawn of a film: how many frames, how many of them again, and what was wrong."""

    different: int
    again: int
    wrong: list[str]


def frames_of(log: Path, parts: Path, kills: Sequence[int]) -> Frames:
    """Return what was drawn while somebody was killed at these times, in ns."""
    runs: dict[int, dict[int, list[Drawn]]] = defaultdict(lambda: defaultdict(list))
    every = drawn(log)
    for each in every:
        runs[each.number // PART][each.pid].append(each)
    wrong: list[str] = []
    for path in parts.glob("part-*"):
        number, there = int(path.name.split("-")[1]), path.stat().st_mtime_ns
        begun = sorted(run[0].when for run in runs[number].values())
        if any(each.when > there for run in runs[number].values() for each in run):
            wrong.append(f"part {number}: drawn after it was there")
        for first, again in zip(begun, begun[1:], strict=False):
            if not any(first < kill < again for kill in kills):
                wrong.append(f"part {number}: drawn twice, though nobody was killed")
    different = len({each.number for each in every})
    return Frames(different, len(every) - different, wrong)


def main() -> int:
    """Return 0 if all files are the same and nothing was drawn twice in vain, else 1."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("view")
    parser.add_argument("--frames", type=int, default=1200)
    parser.add_argument("--size", default="640x360")
    parser.add_argument("--preset", default="2006")
    parser.add_argument("--kills", type=int, default=8)
    parser.add_argument("--longest", type=float, default=20.0, help="seconds between two kills")
    parser.add_argument("--stop", type=float, default=30.0, help="seconds of a stopped worker")
    parser.add_argument("--seed", type=int, default=random.randrange(1 << 32))
    options = parser.parse_args()
    print(f"seed {options.seed}", flush=True)
    words = ["film", options.view, "--preset", options.preset, "--size", options.size]
    words += ["--fps", str(FPS), "--seconds", f"{options.frames / FPS:g}", "--samples", "0", "-q"]
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place).resolve()
        files = in_ways(folder, words)
        files["killed"], found = killed(
            folder,
            words,
            options.kills,
            options.longest,
            options.stop,
            random.Random(options.seed),
        )
        sums = {way: hashlib.sha256(path.read_bytes()).hexdigest() for way, path in files.items()}
    for way, each in sums.items():
        print(f"{each[:16]}  {way}")
    wrong = list(found.wrong)
    if len(set(sums.values())) > 1:
        wrong.append("the files differ")
    if found.different != options.frames:
        wrong.append(f"{found.different} of {options.frames} frames were noted")
    if wrong:
        print(*wrong, sep="\n")
        return 1
    print(
        f"the same file in {len(sums)} ways; {found.different} frames, {found.again} of them drawn "
        "again, all of parts that were open at a kill"
    )
    return 0


if __name__ == "__main__":
    if sys.argv[1:2] == ["--noted"]:
        from landscape.cli import main as command

        note_frames(os.environ[LOG])
        sys.exit(command(sys.argv[2:]))
    sys.exit(main())
