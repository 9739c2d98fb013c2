"""Try damaged, hostile and random inputs: none may end in anything but a result or a clear error.

    make fuzz                             # ten minutes: half for readers, half for commands
    python scripts/fuzz --seed 7 --count 200 --only mesh,image
    python scripts/fuzz --seed 7 --minutes 2 --only svg,world
    python scripts/fuzz --seed 7 --input mesh-31    # one of them again

The readers of files (readers.py) read what Hypothesis makes for each format; hunt.py, which looks
for findings and makes them small, says what one is. Before that they read what was once found
(corpus/). The rest is about commands.

Each input is made from the seed, its kind and its number (inputs.py), so it can be made again. It
runs in a process that runs many (worker.py), in a folder of its own. It is a finding if it

- ends in a traceback, a warning, an error that is no landscape.InputError or NoOpenGLError, an exit
  status other than 0 to 3, or more than one line on standard error;
- draws a picture that is not of the size that was asked for, or leaves an OpenGL error;
- leaves a half-written file, or changes a file that it was not to write;
- takes more than SECONDS of processor time or MEGABYTES of memory, or kills its process.

The folder of each finding is kept, with the input as it was before the run and a command that runs
it again. The exit status is 1 if there are findings.
"""

import argparse
import contextlib
import itertools
import json
import os
import random
import select
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Lock

HERE = Path(__file__).resolve().parent
REPOSITORY = HERE.parents[1]
sys.path[:0] = [str(HERE), str(REPOSITORY)]

# Found by the path above.
import inputs  # noqa: E402
from case import IMPORTS, Case, write_shared  # noqa: E402
from readers import READERS  # noqa: E402

SECONDS = 20.0  # processor time of one input
PATIENCE = 240.0  # seconds an input may take on a busy machine
MEGABYTES = 1536
INPUTS_PER_PROCESS = 60  # then a new one begins, so that leaks do not add up


class Worker:
    """A process that runs one input after another."""

    def __init__(self, root: Path) -> None:
        self.done = 0
        kept = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        self._process = subprocess.Popen(
            [sys.executable, str(HERE / "worker.py")],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            start_new_session=True,
            env=kept
            | {
                "PYTHONPATH": str(REPOSITORY),
                "LANDSCAPE_CACHE": str(root / "cache"),
                "LANDSCAPE_GL_CHECKS": "1",
                "LP_NUM_THREADS": "0",
                "PYTHONWARNINGS": "default::RuntimeWarning,default::UserWarning",
            },
        )

    def run(self, case: Case, folder: Path) -> tuple[int | None, list[str]]:
        """Run an input; return its exit status, if it ended, and what is wrong with its outcome."""
        assert self._process.stdin is not None and self._process.stdout is not None
        self.done += 1
        asked = {"case": case.as_json(), "folder": str(folder)}
        self._process.stdin.write(json.dumps(asked).encode() + b"\n")
        self._process.stdin.flush()
        begun, used = time.monotonic(), self._seconds()
        reason = ""
        answer = b""
        while not answer.endswith(b"\n") and not reason:
            if select.select([self._process.stdout], [], [], 0.02)[0]:
                answer += os.read(self._process.stdout.fileno(), 1 << 16)
            if self._process.poll() is not None:
                reason = f"the process died with status {self._process.returncode}"
            elif self._seconds() - used > SECONDS:
                reason = f"took more than {SECONDS:g} seconds"
            elif time.monotonic() - begun > PATIENCE:
                reason = "hangs, without using the processor"
            elif self._megabytes() > MEGABYTES:
                reason = f"took more than {MEGABYTES} MB of memory"

        if reason and not answer.endswith(b"\n"):
            self.close()
            return None, [reason]
        status, wrong = json.loads(answer)
        return status, wrong

    @property
    def spent(self) -> bool:
        """Whether a new process should take over."""
        return self._process.poll() is not None or self.done >= INPUTS_PER_PROCESS

    def _seconds(self) -> float:
        """Return the processor time used so far."""
        try:
            fields = Path(f"/proc/{self._process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        except OSError:
            return 0.0
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def _megabytes(self) -> float:
        try:
            pages = Path(f"/proc/{self._process.pid}/statm").read_text().split()[1]
        except OSError:
            return 0.0
        return int(pages) * os.sysconf("SC_PAGE_SIZE") / 1e6

    def close(self) -> None:
        """End the process, and those it started."""
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()


def run_all(
    cases: Iterator[Case], root: Path, jobs: int
) -> tuple[dict[str, list[str]], Counter[int | None]]:
    """Run the inputs in ``jobs`` processes; return findings by input, and how many ended how."""
    found: dict[str, list[str]] = {}
    ended: Counter[int | None] = Counter()
    one_at_a_time = Lock()

    def work() -> None:
        worker = Worker(root)
        while True:
            with one_at_a_time:
                case = next(cases, None)
            if case is None:
                break
            folder = root / case.name
            case.prepare(folder)
            if worker.spent:
                worker.close()
                worker = Worker(root)
            status, wrong = worker.run(case, folder)
            remove(folder)
            ended[status] += 1
            if wrong:
                found[case.name] = wrong
                case.prepare(folder)
                report(case, folder, wrong)
            elif ended.total() % 100 == 0:
                print(f"{ended.total()} inputs of commands", flush=True)
        worker.close()

    with ThreadPoolExecutor(jobs) as pool:
        for future in [pool.submit(work) for _ in range(jobs)]:
            future.result()
    return found, ended


def hunt(names: list[str], seed: int, minutes: float, root: Path, jobs: int) -> list[str]:
    """Let each reader read files for its part of the time; return those with a finding."""
    seconds = 60 * minutes * jobs / max(len(names), 1)

    def status(name: str) -> int:
        command = [sys.executable, "-W", "ignore", str(HERE / "hunt.py"), name]
        command += ["--seed", str(seed), "--seconds", str(seconds), "--folder", str(root)]
        return subprocess.run(command, env=os.environ | {"LANDSCAPE_CACHE": ""}).returncode

    with ThreadPoolExecutor(jobs) as pool:
        return [name for name, code in zip(names, pool.map(status, names), strict=True) if code]


def remove(folder: Path) -> None:
    """Delete a case's folder, read-only ones included."""
    for path in [folder, *folder.rglob("*")]:
        if path.is_dir() and not path.is_symlink():
            path.chmod(0o700)
    shutil.rmtree(folder)


def report(case: Case, folder: Path, wrong: list[str]) -> None:
    """Print a finding and a command that shows it."""
    (folder / "wrong.txt").write_text("\n".join(wrong) + "\n")
    lines = [f"{case.name}: {wrong[0][:300]}", *(f"    {each[:300]}" for each in wrong[1:])]
    if case.expression:
        command = ["python", "-c", f"{IMPORTS}; {case.expression}"]
    else:
        command = ["python", "-m", "landscape", *case.args]
    print("\n".join(lines), f"\n    cd {folder} && {shlex.join(command)[:2000]}", flush=True)


def chosen(only: str | None) -> tuple[list[str], list[str]]:
    """Return the kinds of commands and the readers of a list such as "mesh,svg"; None means all.

    A name that is both a kind's and a reader's means both. None comes twice, since an input is
    named by its kind and a number. Raises ValueError for a name that is neither.
    """
    known = {**READERS, **inputs.KINDS}
    asked = dict.fromkeys(known if only is None else only.split(","))
    for name in asked:
        if name not in known:
            raise ValueError(f"{name}: expected some of {', '.join(known)}")
    return [name for name in asked if name in inputs.KINDS], [n for n in asked if n in READERS]


def main() -> int:
    """Make the inputs, run them, and print the findings and a summary; return the exit status."""
    parser = argparse.ArgumentParser(prog="fuzz", description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=random.randrange(10**6), help="default: random")
    parser.add_argument("--minutes", type=float, default=10.0, metavar="N", help="default: 10")
    parser.add_argument("--count", type=int, metavar="N", help="so many inputs of commands instead")
    parser.add_argument("--only", metavar="KIND,...", help=", ".join({**READERS, **inputs.KINDS}))
    parser.add_argument("--input", metavar="KIND-N", help="run only this input of the seed")
    parser.add_argument("--jobs", type=int, default=min(os.cpu_count() or 1, 4), metavar="N")
    parser.add_argument("--folder", type=Path, help="where findings are kept; default: temporary")
    options = parser.parse_args()

    try:
        kinds, readers = chosen(options.only)
    except ValueError as error:
        parser.error(str(error))
    if options.input:
        kind, _, number = options.input.rpartition("-")
        if kind not in inputs.KINDS or not number.isdigit():
            parser.error(f"{options.input}: expected one of {', '.join(inputs.KINDS)}")
        kinds = [kind]
    root = (options.folder or Path(tempfile.mkdtemp(prefix="landscape-fuzz-"))).resolve()
    (root / "cache").mkdir(parents=True, exist_ok=True)
    write_shared(root)

    print(f"seed {options.seed}, in {root}", flush=True)
    begun = time.monotonic()
    wrong: list[str] = []
    part = options.minutes / (2 if kinds and readers else 1)
    if readers and not (options.input or options.count):
        wrong = hunt(readers, options.seed, part, root, options.jobs)
    end = time.monotonic() + 60 * part

    def names() -> Iterator[str]:
        """Yield the names of inputs of all kinds in turn, for as many or as long as is asked."""
        if options.input:
            yield options.input
            return
        for number in itertools.count() if kinds else ():
            if number == options.count or (options.count is None and time.monotonic() > end):
                return
            yield f"{kinds[number % len(kinds)]}-{number // len(kinds)}"

    cases = (inputs.make(name, options.seed) for name in names())
    found, ended = run_all(cases, root, options.jobs)
    minutes = (time.monotonic() - begun) / 60
    each = Counter(name.rpartition("-")[0] for name in found)
    listed = ", ".join(f"{kind} {count}" for kind, count in sorted(each.items()))
    print(
        f"{ended.total()} inputs of commands, {minutes:.1f} minutes in all, {len(found)} findings: "
        f"{listed or 'none'}; readers with a finding: {', '.join(wrong) or 'none'}"
    )
    print("exit status", ", ".join(f"{status}: {ended[status]}" for status in (0, 1, 2, 3)))
    if found:
        print(f"Again: python scripts/fuzz --seed {options.seed} --input {next(iter(found))}")
    elif options.folder is None and not wrong:
        shutil.rmtree(root)
    return 1 if found or wrong else 0


if __name__ == "__main__":
    sys.exit(main())
