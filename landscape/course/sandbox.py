"""Runs programs that may hang, crash or do harm by mistake, each in a process of its own.

A :class:`Sandbox` is a process that has imported PyOpenGL and waits. For each program it forks,
which takes milliseconds where starting Python takes most of a second, and it ends what does not end
by itself. The limits:

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

import contextlib
import ctypes
import faulthandler
import json
import os
import re
import resource
import select
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from importlib import import_module
from pathlib import Path
from typing import Any

from landscape.course.budget import MEGABYTES, SECONDS
from landscape.errors import InputError

GRACE = 1.5  # seconds, chosen: between asking a program to end and ending it
FILE_BYTES = 64 << 20  # chosen: the largest file, the evidence included
NAMESPACES = (0x40000000, 0x50000000)  # CLONE_NEWNET; for users other than root with CLONE_NEWUSER
DEATH_SIGNAL = 1  # PR_SET_PDEATHSIG of prctl(2)
# More threads would cost more time to start than they save. Without any, llvmpipe crashes when a
# window is resized (SIGFPE, in Mesa 22 and in every second process).
THREADS = {"LP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
# What each program needs, imported once.
PRELOADED = (
    *("OpenGL.GL", "OpenGL.GLU", "OpenGL.arrays.ctypespointers", "OpenGL.arrays.numpymodule"),
    *("OpenGL.arrays.nones", "OpenGL.arrays.lists", "OpenGL.arrays.strings"),
    "OpenGL.arrays.ctypesarrays",
    *("PIL.Image", "numpy.random", "landscape.course.witness", "landscape.gl.glfw_library"),
)
ANSWER = "evidence.json"
CRASH = "crash.txt"  # what faulthandler wrote


@dataclass(frozen=True)
class Job:
    """A program to run: which frames to look at, after which events (capture/program_events.py)."""

    path: str
    frames: Sequence[int]
    events: Sequence[dict[str, Any]] = ()
    seconds: float = SECONDS
    megabytes: int = MEGABYTES


@dataclass(frozen=True)
class Outcome:
    """How a job ended: what its process wrote, or what ended the process.

    ``ended`` is "" if it ended by itself, else "late", or the name of a signal such as SIGSEGV.
    """

    path: str
    folder: Path
    answer: dict[str, Any] | None
    ended: str

    @property
    def line(self) -> int:
        """The line of the program at which its process crashed; 0 if that is not known."""
        try:
            text = (self.folder / CRASH).read_text(errors="replace")
        except OSError:
            return 0
        found = re.search(rf'File "{re.escape(self.path)}", line (\d+)', text)
        return int(found[1]) if found else 0


@dataclass
class Sandbox:
    """The waiting process; it is started by the first job, and ended by :meth:`close`."""

    _process: "subprocess.Popen[bytes] | None" = field(default=None, init=False)
    _folder: "tempfile.TemporaryDirectory[str] | None" = field(default=None, init=False)
    _count: int = field(default=0, init=False)

    def __enter__(self) -> "Sandbox":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def run(self, jobs: Sequence[Job]) -> list[Outcome]:
        """Run jobs beside each other; NoOpenGLError without a usable OpenGL."""
        if self._process is None:
            self._start()
        assert self._process is not None and self._folder is not None
        folders = []
        for _ in jobs:
            self._count += 1
            folders.append(Path(self._folder.name) / str(self._count))
            folders[-1].mkdir()
        asked = [
            {**asdict(job), "folder": str(place), "cwd": os.getcwd()}
            for job, place in zip(jobs, folders, strict=True)
        ]
        assert self._process.stdin is not None and self._process.stdout is not None
        try:
            self._process.stdin.write(json.dumps(asked).encode() + b"\n")
            self._process.stdin.flush()
            line = self._process.stdout.readline()
        except BrokenPipeError:
            line = b""
        if not line:
            self.close()
            raise InputError("exercise check: the process that runs programs ended unexpectedly")
        reply = json.loads(line)
        if "no_opengl" in reply:
            from landscape.errors import NoOpenGLError

            self.close()
            raise NoOpenGLError(reply["no_opengl"])
        return [
            Outcome(job.path, place, _read(place / ANSWER), ended)
            for job, place, ended in zip(jobs, folders, reply["ended"], strict=True)
        ]

    def _start(self) -> None:
        package = str(Path(__file__).resolve().parents[2])
        paths = [package, *filter(None, [os.environ.get("PYTHONPATH")])]
        self._folder = tempfile.TemporaryDirectory(prefix="landscape-", ignore_cleanup_errors=True)
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-m", "landscape.course.sandbox"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env={**os.environ, **THREADS, "PYTHONPATH": os.pathsep.join(paths)},
            start_new_session=True,  # so that Ctrl-C reaches only the command itself
        )

    def close(self) -> None:
        """End the process, and delete what its programs wrote; may be called twice."""
        if self._process is not None:
            self._process.kill()
            self._process.communicate()
        if self._folder is not None:
            self._folder.cleanup()
        self._process = self._folder = None


def _read(path: Path) -> dict[str, Any] | None:
    try:
        found = json.loads(path.read_bytes())
    except (OSError, RecursionError, ValueError):
        return None
    return found if isinstance(found, dict) else None


# What follows runs in the sandbox's own process.


def serve() -> None:
    """Answer each line of standard input, a list of jobs, by how each of them ended."""
    # Programs inherit the numbers 0 to 2, which must not lead to whoever asks.
    asked, replies = os.fdopen(os.dup(0)), os.fdopen(os.dup(1), "w")
    discard = os.open(os.devnull, os.O_RDWR)
    for number in range(3):
        os.dup2(discard, number)
    with contextlib.ExitStack() as stack:
        trouble = _prepare(stack)
        for line in asked:
            answer = {"no_opengl": trouble} if trouble else {"ended": _run(json.loads(line))}
            print(json.dumps(answer), file=replies, flush=True)


def _prepare(stack: contextlib.ExitStack) -> str:
    """Import what programs need, replace OpenGL's functions, and leave the network.

    Returns why there is no OpenGL, or "".
    """
    import gc

    from landscape.capture.program_context import bind
    from landscape.capture.program_source import Source
    from landscape.errors import NoOpenGLError

    libc = ctypes.CDLL(None)
    # Without either, Python's refusal of sockets remains.
    any(libc.unshare(flags) == 0 for flags in NAMESPACES)
    try:
        backend = bind(Source(Path(), compile("", "", "exec"), frozenset(), True), "auto")
    except NoOpenGLError as error:
        return str(error)
    for name in (*PRELOADED, *(["OpenGL.osmesa"] if backend == "osmesa" else [])):
        import_module(name)
    from landscape.capture import state_reading
    from landscape.capture.program import prepared
    from landscape.course.witness import make

    state_reading.prepare()
    stack.enter_context(prepared(make))
    sys.dont_write_bytecode = True
    gc.collect()
    gc.freeze()
    gc.set_threshold(50_000, 20, 100)  # calls are kept to the end: looking for garbage is in vain
    return ""


def _run(jobs: list[dict[str, Any]]) -> list[str]:
    """Run jobs beside each other; return how each ended."""
    running: dict[int, tuple[int, int, float]] = {}
    for index, job in enumerate(jobs):
        ends, held = os.pipe()  # the program holds one end as long as it lives
        pid = os.fork()
        if pid == 0:
            os.close(ends)
            _child(job)
        os.close(held)
        running[ends] = index, pid, time.monotonic() + job["seconds"] + GRACE
    ended = [""] * len(jobs)
    while running:
        left = min(end for _, _, end in running.values()) - time.monotonic()
        ready = select.select(list(running), [], [], max(left, 0))[0]
        for ends, (index, pid, deadline) in list(running.items()):
            late = time.monotonic() >= deadline
            if ends not in ready and not late:
                continue
            with contextlib.suppress(ProcessLookupError):
                os.killpg(pid, signal.SIGKILL)
            status = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
            if ends not in ready or status == -signal.SIGXCPU:
                ended[index] = "late"
            elif status < 0:
                ended[index] = signal.Signals(-status).name
            elif status > 0:
                ended[index] = f"status {status}"
            os.close(ends)
            del running[ends]
    return ended


def _child(job: dict[str, Any]) -> None:
    """Run one program within its limits, and end the process."""
    leave = os._exit  # a program is given another one
    try:
        os.setsid()
        _end_with_parent()
        os.chdir(job["cwd"])
        os.environ["TMPDIR"] = tempfile.tempdir = job["folder"]
        seconds = int(job["seconds"] + GRACE) + 1
        used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
        for limit, value in (
            (resource.RLIMIT_CORE, 0),
            (resource.RLIMIT_CPU, seconds),
            (resource.RLIMIT_FSIZE, FILE_BYTES),
            (resource.RLIMIT_AS, used + (job["megabytes"] << 20)),
        ):
            resource.setrlimit(limit, (value, resource.getrlimit(limit)[1]))
        from landscape.course.witness import run

        # Where the program is when it crashes, for the grader.
        crash = os.open(Path(job["folder"]) / CRASH, os.O_WRONLY | os.O_CREAT)
        faulthandler.enable(crash, all_threads=False)
        run(job, Path(job["folder"]) / ANSWER, leave)
        leave(0)
    except BaseException:
        leave(1)


def _end_with_parent() -> None:
    """Let the system end this process when its parent ends, however that comes about."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(DEATH_SIGNAL, int(signal.SIGKILL), 0, 0, 0)


if __name__ == "__main__":
    serve()
