"""Runs programs that may hang, crash or do harm by mistake, each in a process of its own.

A :class:`Sandbox` has two ways to start such a process. Where a process may be copied, one that has
imported PyOpenGL waits, and forks for each program, which takes milliseconds (sandbox_forks.py);
elsewhere Python is started for each program, which takes most of a second. The program's part of
it is the same (sandboxed.py). What does not end by itself is ended. The limits:

- seconds of the clock, for the program's own work; and of the processor, for what cannot be
  interrupted;
- megabytes of memory beyond what Python and OpenGL take; no core file;
- megabytes of files, and of the evidence, which comes through a pipe (stream.py);
- threads, and files that are open at once;
- what the program prints is discarded, however much it is.

What else it may do is contained by the system where that can (confinement.py): it reads no homes,
solutions or programs of others, and writes into a folder of its own; it has no network, and starts
and ends no processes. In any case Python refuses it to (refusals.py), and the network is left where
the system allows that; but that stops mistakes, not attacks: ctypes gets around it.

Nothing contains what a program does in its own process, in which its evidence is written. A picture
that it has brought along is told by the trial (trial.py).
"""

import contextlib
import json
import os
import re
import subprocess
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO

from framelens.base.errors import InputError, NoOpenGLError, UnexpectedError, raised_at
from framelens.base.isolated import started
from framelens.system import containment, limits
from framelens.system.beside import beside
from landscape.course.grader import confinement
from landscape.course.grader.budget import MEGABYTES, SECONDS
from landscape.course.grader.confinement import AUTO, NONE
from landscape.course.grader.order import Order
from landscape.course.grader.stream import MOST_BYTES, PART, Answer, received, widen
from landscape.course.grader.workplace import Workplace, overfull

GRACE = 1.5  # seconds, chosen: between asking a program to end and ending it
START = 120.0  # seconds, chosen: until a process has imported what programs need
PAUSE = 0.01  # seconds, chosen: between two looks at processes
GLANCE = 0.02  # seconds, chosen: in a quarter of a second threads may take all numbers of processes
LOOK = 0.25  # seconds, chosen: between two looks at the files that a program writes
FILE_BYTES = 64 << 20  # chosen: the largest file
MOST_THREADS = 256  # chosen: of one program; drivers have some dozens
MOST_OPEN = 256  # chosen: open files of one program
CRASH_BYTES = 64 << 10  # chosen: of what faulthandler writes
KEPT = "kept"  # a folder in the workplace
# More threads would cost more time to start than they save. Without any, llvmpipe crashes when a
# window is resized (SIGFPE, in Mesa 22 and in every second process).
THREADS = {"LP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
# How a program ended.
LATE = "late"
FULL = "full"  # it wrote more than it may
MUCH = "much"  # it took more threads, or shared memory, than it may
TOO_MUCH = (FULL, MUCH)
STATUS = "status "
# Why the system contains no programs.
NO_SYSTEM = "no system"
NEEDS_SCREEN = "needs a screen"
NOT_OPENED = "not opened"


@dataclass(frozen=True)
class Job:
    """A program to run: which frames to look at, after which events (program_events.py).

    Without ``calls`` only the pictures of the frames are taken. One that is ``trusted`` is the
    course's own. With a language, the cause is asked for why its last frame looks as it does
    (framelens/why), instead of evidence. ``private`` are files and folders of which it must read
    nothing. With ``again`` what is needed to draw the frames again is sent, too. With ``recorded``,
    a file, the program plays one of its takes (recorded.py).
    """

    path: str
    frames: Sequence[int]
    events: Sequence[dict[str, object]] = ()
    calls: bool = True
    seconds: float = SECONDS
    megabytes: int = MEGABYTES
    trusted: bool = False
    why: str = ""
    private: Sequence[str] = ()
    again: bool = False
    recorded: str = ""
    take: int = 0

    def order(self, folder: Path, hidden: Sequence[str] = ()) -> Order:
        """Return it as a process gets it, which may write into a folder."""
        return Order(
            path=self.path,
            frames=self.frames,
            events=self.events,
            calls=self.calls,
            seconds=self.seconds,
            megabytes=self.megabytes,
            trusted=self.trusted,
            why=self.why,
            private=self.private,
            again=self.again,
            recorded=self.recorded,
            take=self.take,
            folder=str(folder),
            cwd=os.getcwd(),
            hidden=[*self.private, *hidden],
        )


@dataclass(frozen=True)
class Outcome:
    """How a job ended: what its process sent, and what ended the process.

    ``ended`` says how, as :func:`ended` does, or is one of TOO_MUCH. ``errors`` is what
    faulthandler wrote.
    """

    path: str
    answer: Answer | None
    ended: str
    errors: str

    @property
    def crashed(self) -> bool:
        """Whether the system ended the process for what it did."""
        return self.ended not in ("", LATE, *TOO_MUCH) and not self.ended.startswith(STATUS)

    @property
    def line(self) -> int:
        """The line of the program at which its process crashed; 0 if that is not known."""
        # The program may write there, too: no more digits than a file has lines.
        found = re.search(rf'File "{re.escape(self.path)}", line (\d{{1,7}})\b', self.errors)
        return int(found[1]) if found else 0


def ended(status: int, late: bool) -> str:
    """Return how a process ended: "" by itself, "late", "status 1", or a signal such as SIGSEGV."""
    crash = limits.crash(status)
    if late or crash == limits.OUT_OF_TIME:
        return LATE
    return crash or (f"{STATUS}{status}" if status else "")


@dataclass
class Sandbox:
    """What runs jobs; it deletes what their programs wrote.

    ``contain`` is one of confinement.CHOICES. ``contained`` says what contains the programs, once
    one has run.
    """

    contain: str = AUTO
    contained: str = field(default="", init=False)
    _server: "_Server | None" = field(default=None, init=False)
    _place: Workplace | None = field(default=None, init=False)

    def __enter__(self) -> "Sandbox":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def run(self, jobs: Sequence[Job]) -> list[Outcome]:
        """Run jobs beside each other.

        NoOpenGLError without a usable OpenGL, InputError if programs are to be contained and cannot
        be, UnexpectedError if a process of ours fails.
        """
        place = self._workplace()
        try:
            with place.parts(len(jobs)) as places:
                # Programs get a home of their own; other graders' lie in the temporary folder.
                hidden = os.path.expanduser("~"), tempfile.gettempdir(), str(place.folder)
                orders = [job.order(own, hidden) for job, own in zip(jobs, places, strict=True)]
                ends = self._forked(orders) if limits.FORKS else _spawned(orders, self.contain)
            outcomes = []
            for job, end in zip(jobs, ends, strict=True):
                answer = received(end.data)
                if answer is not None and "trouble" in answer[0]:
                    raise _unexpected(str(answer[0]["trouble"]))
                outcomes.append(Outcome(job.path, answer, end.reason, end.errors))
        except BaseException:
            self.close()
            raise

        self.contained = ends[0].contained
        return outcomes

    def _workplace(self) -> Workplace:
        if self._place is None:
            self._place = Workplace()
        return self._place

    @property
    def kept(self) -> Path | None:
        """The folder of what it keeps, which no program must read; None if that is nothing."""
        folder = self._place.folder / KEPT if self._place is not None else None
        return folder if folder is not None and folder.is_dir() else None

    def keep(self, name: str, data: bytes) -> Path:
        """Keep a file with some bytes until it is closed, where programs cannot write."""
        path = self._workplace().folder / KEPT / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(data)
        return path

    @contextlib.contextmanager
    def file(self, data: bytes) -> Iterator[Path]:
        """Have a file with some bytes for the block, where programs cannot write."""
        assert self._place is not None, "no program has run"
        path = self._place.folder / "file"
        try:
            path.write_bytes(data)
            yield path
        finally:
            path.unlink(missing_ok=True)

    def _forked(self, orders: list[Order]) -> list["End"]:
        """Let the waiting process run jobs; return how each ended."""
        if self._server is None:
            self._server = _Server(self.contain)
        return self._server.run(orders)

    def close(self) -> None:
        """End the waiting process, and delete what programs wrote; may be called twice."""
        if self._server is not None:
            self._server.close()
        if self._place is not None:
            self._place.close()
        self._server = self._place = None


@dataclass(frozen=True)
class End:
    """How a program's process ended, what it sent, what was written on its standard error."""

    reason: str
    data: bytes
    errors: str
    contained: str


class _Server:
    """The process that waits, and forks for each program (sandbox_forks.py)."""

    def __init__(self, contain: str) -> None:
        # Without a name, so that no program can put another file in its place.
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115
        self._process = _start("sandbox_forks", [contain], self._errors, contain)
        assert self._process.stdout is not None
        widen(self._process.stdout.fileno())
        self.pid = self._process.pid

    def run(self, orders: list[Order]) -> list[End]:
        """Let it run jobs; return how each ended."""
        assert self._process.stdin is not None and self._process.stdout is not None
        try:
            self._process.stdin.write(json.dumps(orders).encode() + b"\n")
            self._process.stdin.flush()
            line = self._process.stdout.readline()
        except BrokenPipeError:
            line = b""
        if not line:
            raise _unexpected(errors_in(self._errors), ended(self._process.wait(), False))
        reply = json.loads(line)
        if "no_opengl" in reply:
            raise NoOpenGLError(reply["no_opengl"])
        if "uncontained" in reply:
            raise _uncontained(reply["uncontained"])
        return [
            End(reason, self._process.stdout.read(size), errors, reply["contained"])
            for reason, size, errors in reply["ended"]
        ]

    def close(self) -> None:
        """End it."""
        self._process.kill()
        self._process.communicate()
        self._errors.close()


def _spawned(orders: list[Order], contain: str) -> list[End]:
    """Run jobs beside each other, each in a Python of its own; return how each ended."""
    running: list[_Spawned] = []
    try:
        for order in orders:
            running.append(_Spawned(order, contain))
        while any([process.runs() for process in running]):
            time.sleep(PAUSE)
        return [process.ended() for process in running]
    finally:
        for process in running:
            process.close()


class _Spawned:
    """A Python that runs one job."""

    def __init__(self, order: Order, contain: str) -> None:
        self._folder = Path(order["folder"])
        self._seconds = order["seconds"]
        self._ready: dict[str, str] = {}
        self._reason = ""
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115
        self._process = _start("sandboxed", [str(os.getpid()), contain], self._errors, contain)
        assert self._process.stdin is not None and self._process.stdout is not None
        with contextlib.suppress(BrokenPipeError), self._process.stdin as jobs:
            jobs.write(json.dumps(order).encode())
        self._pipe = self._process.stdout
        self._lines: list[bytes] = []  # the first line, which says whether it is ready
        self._data = bytearray()
        self._reader = beside(self._read)
        self._deadline = time.monotonic() + START
        self._looked = time.monotonic()

    def _read(self) -> None:
        """Take what the process sends, as much as it may."""
        with contextlib.suppress(OSError, ValueError):  # the pipe is closed
            self._lines.append(self._pipe.readline(PART))
            while part := os.read(self._pipe.fileno(), PART):
                if len(self._data) + len(part) > MOST_BYTES:
                    self._reason = FULL
                    return
                self._data += part

    def runs(self) -> bool:
        """Return whether the process still runs; end it if it is late, or has written too much."""
        status = self._process.poll()
        if self._lines and not self._ready:
            self._begin()
        late = status is None and time.monotonic() > self._deadline
        if status is None and time.monotonic() - self._looked > LOOK:
            self._looked = time.monotonic()
            if overfull(self._folder):
                self._reason = FULL
        if status is None and not late and not self._reason:
            return True
        if not self._ready:
            how = f"not ready within {START:g} s" if late else ended(status or 0, False)
            raise _unexpected(errors_in(self._errors), how)
        self._reason = self._reason or ended(status or 0, late)
        self._end()
        return False

    def _begin(self) -> None:
        """Begin the program's own time: all is imported."""
        if not self._lines[0].endswith(b"\n"):
            return  # it ended before
        self._ready = json.loads(self._lines[0])
        if reason := self._ready["no_opengl"]:
            raise NoOpenGLError(reason)
        if reason := self._ready["uncontained"]:
            raise _uncontained(reason)
        self._deadline = time.monotonic() + self._seconds + GRACE

    def _end(self) -> None:
        """End the process and its children; may be called twice."""
        limits.end_group(self._process.pid)
        self._process.wait()

    def ended(self) -> End:
        """Return how it ended; what it sent has come by then, or a process holds the pipe open."""
        self._reader.join(GRACE)
        contained = self._ready["contained"]
        return End(self._reason, bytes(self._data), errors_in(self._errors), contained)

    def close(self) -> None:
        """End the process, and let go of its files."""
        self._end()
        self._errors.close()
        self._reader.join(GRACE)
        if not self._reader.is_alive():
            self._pipe.close()


def _start(
    module: str, words: list[str], errors: IO[bytes], contain: str
) -> "subprocess.Popen[bytes]":
    """Start a module of the course as a process whose standard error is a file."""
    package = str(Path(__file__).resolve().parents[3])
    paths = [package, *filter(None, [os.environ.get("PYTHONPATH")])]
    contained = contain != NONE and containment.possible()
    return started(
        ["-P", "-m", f"landscape.course.grader.{module}", *words],
        {**THREADS, "PYTHONPATH": os.pathsep.join(paths)},
        confinement.environment() if contained else os.environ,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=errors,
        bufsize=0 if module == "sandboxed" else -1,  # whose standard output two readers share
        **limits.OWN_GROUP,
    )


def _uncontained(reason: str) -> InputError:
    """Return the error where programs must be contained and cannot be (Prepared.reason)."""
    if reason == NO_SYSTEM:
        return InputError("--contain require: expected Linux with Landlock (5.13 or later)")
    if reason == NEEDS_SCREEN:
        return InputError(
            "--contain require: expected an OpenGL that needs no screen: OSMesa or EGL"
        )
    return InputError("--contain require: expected an OpenGL that a contained program can open")


def errors_in(file: IO[bytes]) -> str:
    """Return what was written into the standard error of a process, as far as it is needed."""
    file.seek(0)
    return file.read(CRASH_BYTES).decode(errors="replace")


def _unexpected(details: str, how: str = "") -> UnexpectedError:
    """Return the error for a process of ours that wrote errors, or ended as ``how`` says."""
    lines = details.strip().splitlines() or [how or "status 0"]
    reason = lines[-1] if lines[0].startswith("Traceback") else lines[0]
    reason += raised_at(details)
    return UnexpectedError(f"the process that runs programs ended ({reason})", details)
