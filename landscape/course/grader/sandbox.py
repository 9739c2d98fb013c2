"""Runs programs that may hang, crash or do harm by mistake, each in a process of its own.

A :class:`Sandbox` has two ways to start such a process. Where a process may be copied, one that has
imported PyOpenGL waits, and forks for each program, which takes milliseconds (sandbox_forks.py);
elsewhere Python is started for each program, which takes most of a second. The program's part of
it is the same (sandboxed.py). What does not end by itself is ended. The limits:

- seconds of the clock, for the program's own work; and of the processor, for what cannot be
  interrupted;
- megabytes of memory beyond what Python and OpenGL take; no core file;
- what the program prints is discarded, however much it is;
- no network: a network namespace without any device where the system allows one, and in every case
  Python refuses to open sockets;
- no files are written outside a temporary folder, and no other programs started: Python refuses.

They stop mistakes, not attacks: a program that wants to get around Python's refusals, through
ctypes for instance, can. Whoever grades programs of strangers needs a container around the grader.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from framelens.base.errors import NoOpenGLError, UnexpectedError, raised_at
from framelens.system import limits
from landscape.course.grader.budget import MEGABYTES, SECONDS

GRACE = 1.5  # seconds, chosen: between asking a program to end and ending it
START = 120.0  # seconds, chosen: until a process has imported what programs need
PAUSE = 0.01  # seconds, chosen: between two looks at processes
FILE_BYTES = 64 << 20  # chosen: the largest file, the evidence included
# More threads would cost more time to start than they save. Without any, llvmpipe crashes when a
# window is resized (SIGFPE, in Mesa 22 and in every second process).
THREADS = {"LP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
# The files of a job's folder.
JOB = "job.json"
READY = "ready.json"  # written once all is imported; it says why there is no OpenGL, or ""
ANSWER = "evidence.json"
CRASH = "crash.txt"  # what faulthandler wrote
TROUBLE = "trouble.txt"  # a traceback of ours: what nobody has foreseen
ERRORS = "errors.txt"  # the standard error of our process, to where the program begins
# How a program ended.
LATE = "late"
STATUS = "status "


@dataclass(frozen=True)
class Job:
    """A program to run: which frames to look at, after which events (program_events.py).

    Without ``calls`` only the pictures of the frames are taken.
    """

    path: str
    frames: Sequence[int]
    events: Sequence[dict[str, Any]] = ()
    calls: bool = True
    seconds: float = SECONDS
    megabytes: int = MEGABYTES


@dataclass(frozen=True)
class Outcome:
    """How a job ended: what its process wrote, or what ended the process.

    ``ended`` says how, as :func:`ended` does.
    """

    path: str
    folder: Path
    answer: dict[str, Any] | None
    ended: str

    @property
    def crashed(self) -> bool:
        """Whether the system ended the process for what it did."""
        return self.ended not in ("", LATE) and not self.ended.startswith(STATUS)

    @property
    def line(self) -> int:
        """The line of the program at which its process crashed; 0 if that is not known."""
        try:
            text = (self.folder / CRASH).read_text(errors="replace")
        except OSError:
            return 0
        found = re.search(rf'File "{re.escape(self.path)}", line (\d+)', text)
        return int(found[1]) if found else 0


def ended(status: int, late: bool) -> str:
    """Return how a process ended: "" by itself, "late", "status 1", or a signal such as SIGSEGV."""
    crash = limits.crash(status)
    if late or crash == limits.OUT_OF_TIME:
        return LATE
    return crash or (f"{STATUS}{status}" if status else "")


@dataclass
class Sandbox:
    """What runs jobs; it deletes what their programs wrote when it is closed."""

    _server: "subprocess.Popen[bytes] | None" = field(default=None, init=False)
    _folder: "tempfile.TemporaryDirectory[str] | None" = field(default=None, init=False)
    _count: int = field(default=0, init=False)

    def __enter__(self) -> "Sandbox":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def run(self, jobs: Sequence[Job]) -> list[Outcome]:
        """Run jobs beside each other.

        NoOpenGLError without a usable OpenGL, UnexpectedError if a process of ours fails.
        """
        if self._folder is None:
            self._folder = tempfile.TemporaryDirectory(
                prefix="landscape-", ignore_cleanup_errors=True
            )

        places = []
        for _ in jobs:
            self._count += 1
            places.append(Path(self._folder.name) / str(self._count))
            places[-1].mkdir()

        asked = [
            {**asdict(job), "folder": str(place), "cwd": os.getcwd()}
            for job, place in zip(jobs, places, strict=True)
        ]
        try:
            reasons = self._forked(asked) if limits.FORKS else _spawned(asked)
            for trouble in (place / TROUBLE for place in places):
                if trouble.exists():
                    raise _unexpected(trouble)
        except BaseException:
            self.close()
            raise

        return [
            Outcome(job.path, place, _read(place / ANSWER), reason)
            for job, place, reason in zip(jobs, places, reasons, strict=True)
        ]

    def _forked(self, asked: list[dict[str, Any]]) -> list[str]:
        """Let the waiting process run jobs; return how each ended."""
        assert self._folder is not None
        errors = Path(self._folder.name) / ERRORS
        if self._server is None:
            self._server = _start("sandbox_forks", [], errors, subprocess.PIPE)
        assert self._server.stdin is not None and self._server.stdout is not None
        try:
            self._server.stdin.write(json.dumps(asked).encode() + b"\n")
            self._server.stdin.flush()
            line = self._server.stdout.readline()
        except BrokenPipeError:
            line = b""
        if not line:
            raise _unexpected(errors, ended(self._server.wait(), False))
        reply = json.loads(line)
        if "no_opengl" in reply:
            raise NoOpenGLError(reply["no_opengl"])
        return list(reply["ended"])

    def close(self) -> None:
        """End the waiting process, and delete what programs wrote; may be called twice."""
        if self._server is not None:
            self._server.kill()
            self._server.communicate()
        if self._folder is not None:
            self._folder.cleanup()
        self._server = self._folder = None


def _spawned(asked: list[dict[str, Any]]) -> list[str]:
    """Run jobs beside each other, each in a Python of its own; return how each ended."""
    running: list[_Spawned] = []
    try:
        running += map(_Spawned, asked)
        while any([process.runs() for process in running]):
            time.sleep(PAUSE)
    finally:
        for process in running:
            process.end()
    return [process.reason for process in running]


class _Spawned:
    """A Python that runs one job; ``reason`` says how it ended."""

    def __init__(self, job: dict[str, Any]) -> None:
        self._folder = Path(job["folder"])
        self._seconds = job["seconds"]
        self._ready = False
        self.reason = ""
        (self._folder / JOB).write_text(json.dumps(job))
        words = [job["folder"], str(os.getpid())]
        self._process = _start("sandboxed", words, self._folder / ERRORS, subprocess.DEVNULL)
        self._deadline = time.monotonic() + START

    def runs(self) -> bool:
        """Return whether the process still runs; end it if it is late."""
        status = self._process.poll()
        self._look_for_ready()
        late = status is None and time.monotonic() > self._deadline
        if status is None and not late:
            return True
        if not self._ready:
            how = f"not ready within {START:g} s" if late else ended(status or 0, False)
            raise _unexpected(self._folder / ERRORS, how)
        self.reason = self.reason or ended(status or 0, late)
        self.end()
        return False

    def _look_for_ready(self) -> None:
        """Begin the program's own time once all is imported."""
        if self._ready:
            return
        try:
            answer = (self._folder / READY).read_bytes()
        except OSError:  # not there yet; or, on Windows, not to be read yet
            return
        self._ready = True
        if no_opengl := json.loads(answer)["no_opengl"]:
            raise NoOpenGLError(no_opengl)
        self._deadline = time.monotonic() + self._seconds + GRACE

    def end(self) -> None:
        """End the process and its children; may be called twice."""
        limits.end_group(self._process.pid)
        self._process.wait()


def _start(module: str, words: list[str], errors: Path, pipes: int) -> "subprocess.Popen[bytes]":
    """Start a module of the course as a process whose standard error is a file."""
    package = str(Path(__file__).resolve().parents[3])
    paths = [package, *filter(None, [os.environ.get("PYTHONPATH")])]
    with errors.open("wb") as file:
        return subprocess.Popen(
            [sys.executable, "-P", "-m", f"landscape.course.grader.{module}", *words],
            stdin=pipes,
            stdout=pipes,
            stderr=file,
            env={**os.environ, **THREADS, "PYTHONPATH": os.pathsep.join(paths)},
            **limits.OWN_GROUP,
        )


def _unexpected(errors: Path, how: str = "") -> UnexpectedError:
    """Return the error for a process of ours that wrote errors, or ended as ``how`` says."""
    details = errors.read_text(encoding="utf-8", errors="replace")
    lines = details.strip().splitlines() or [how or "status 0"]
    reason = lines[-1] if lines[0].startswith("Traceback") else lines[0]
    reason += raised_at(details)
    return UnexpectedError(f"the process that runs programs ended ({reason})", details)


def _read(path: Path) -> dict[str, Any] | None:
    try:
        found = json.loads(path.read_bytes())
    except (OSError, RecursionError, ValueError):
        return None
    return found if isinstance(found, dict) else None
