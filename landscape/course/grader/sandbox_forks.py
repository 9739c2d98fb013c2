"""The sandbox's waiting process, which forks for each program (see sandbox.py).

Each line of standard input, a list of jobs, is answered by a line that says how each of them ended,
and then by what each of them sent. A copy of the waiting process does it, and ends: so a program,
which is a copy, too, finds nothing in its memory of those before it.
"""

import contextlib
import json
import os
import select
import sys
import tempfile
import time
import traceback
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, NoReturn

from framelens.system import limits
from landscape.course.grader.confinement import LANDLOCK
from landscape.course.grader.order import Order
from landscape.course.grader.sandbox import (
    FILE_BYTES,
    FULL,
    GLANCE,
    GRACE,
    LOOK,
    MOST_THREADS,
    MUCH,
    NOT_OPENED,
    Job,
    ended,
    errors_in,
)
from landscape.course.grader.sandboxed import Prepared, prepare, run_program
from landscape.course.grader.stream import MOST_BYTES, PART, received, widen
from landscape.course.grader.workplace import deleted_bytes, overfull

if sys.platform != "win32":  # where no program is contained
    from framelens.system.copying import copy

assert sys.platform == "linux"  # as limits.FORKS says

SMALL = """
import glfw
from OpenGL.GL import *
glfw.init()
window = glfw.create_window(8, 8, "", None, None)
glfw.make_context_current(window)
while not glfw.window_should_close(window):
    glClear(GL_COLOR_BUFFER_BIT)
    glfw.swap_buffers(window)
    glfw.poll_events()
"""


def serve(contain: str) -> None:
    """Answer until standard input ends."""
    limits.end_with(os.getppid())
    limits.adopt_orphans()
    # Programs inherit the numbers 0 and 1, which must not lead to whoever asks.
    asked, replies = os.dup(0), os.dup(1)
    discard = os.open(os.devnull, os.O_RDWR)
    for number in range(2):
        os.dup2(discard, number)

    with contextlib.ExitStack() as stack:
        ours = prepare(stack, contain)
        # The driver of a graphics card may need what a contained program has not.
        if ours.contained == LANDLOCK and ours.backend != "osmesa" and not _opens(ours):
            ours.give_up(NOT_OPENED)

        line = select.poll()
        line.register(asked, select.POLLIN)
        while all(event & select.POLLIN for _, event in line.poll()):
            answering = copy()
            if answering is None:
                _answer_and_leave(asked, replies, ours)
            status = os.waitstatus_to_exitcode(os.waitpid(answering.pid, 0)[1])
            if status:
                sys.exit(f"the process that answers ended ({ended(status, False)})")


def _answer_and_leave(asked: int, replies: int, ours: Prepared) -> NoReturn:
    """Answer a line, in a process of its own, which ends."""
    status = 1
    try:
        limits.adopt_orphans()
        line = b""
        while not line.endswith(b"\n"):
            line += os.read(asked, PART)
        with os.fdopen(replies, "wb") as file:
            file.writelines(_answers(line, ours))
        status = 0
    except BaseException:
        traceback.print_exc()
    finally:
        os._exit(status)


def _answers(line: bytes, ours: Prepared) -> Iterator[bytes]:
    """Yield the parts of the answer to a line."""
    if ours.no_opengl or ours.uncontained:
        word = "no_opengl" if ours.no_opengl else "uncontained"
        yield json.dumps({word: ours.no_opengl or ours.uncontained}).encode() + b"\n"
        return
    found = _run(json.loads(line), ours)
    how = [(each.reason, len(each.data), each.said) for each in found]
    yield json.dumps({"contained": ours.contained, "ended": how}).encode() + b"\n"
    for each in found:
        yield bytes(each.data)


def _opens(ours: Prepared) -> bool:
    """Return whether a program that is contained can open OpenGL and draw."""
    with tempfile.TemporaryDirectory(prefix="landscape-") as folder:
        path = Path(folder).resolve() / "small.py"
        path.write_text(SMALL, encoding="utf-8")
        own = path.parent / "own"
        own.mkdir()
        job = Job(str(path), [0], calls=False)
        (found,) = _run([job.order(own)], ours)
    answer = received(bytes(found.data))
    return answer is not None and "frames" in answer[0]


@dataclass
class _Running:
    """A program's process: its pipe's end, and what has come through it."""

    pid: int
    pipe: int
    errors: IO[bytes]
    folder: Path
    megabytes: int
    deadline: float
    glanced: float = field(default_factory=time.monotonic)
    looked: float = field(default_factory=time.monotonic)
    data: bytearray = field(default_factory=bytearray)
    reason: str = ""
    said: str = ""

    def read(self) -> bool:
        """Take a part of what is sent; return whether there may be more."""
        part = os.read(self.pipe, PART)
        if len(self.data) + len(part) > MOST_BYTES:
            self.reason = FULL
            return False
        self.data += part
        return bool(part)

    def lives(self) -> bool:
        """Return whether the process has not ended: one that it has started may hold the pipe."""
        return os.waitid(os.P_PID, self.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is None

    def takes_too_much(self) -> bool:
        """Look whether the program takes more than it may of what has no limit.

        That are its threads, memory that is shared, and, more rarely, its files together.
        """
        now = time.monotonic()
        if now - self.glanced < GLANCE:  # it sends: parts come far more often
            return False
        self.glanced = now
        threads, shared = _holds(self.pid)
        if threads > MOST_THREADS or shared > self.megabytes << 20:
            self.reason = MUCH
            return True
        if now - self.looked < LOOK:
            return False
        if overfull(self.folder, deleted_bytes(self.pid, self.folder, FILE_BYTES)):
            self.reason = FULL
        self.looked = time.monotonic()
        return self.reason != ""

    def end(self, late: bool) -> None:
        """End the process, if it has not ended, and note how it did."""
        limits.end_group(self.pid)
        status = os.waitstatus_to_exitcode(os.waitpid(self.pid, 0)[1])
        # What it sent between the last look at the pipe and its end; others may hold the pipe open.
        os.set_blocking(self.pipe, False)
        with contextlib.suppress(BlockingIOError):
            while not self.reason and self.read():
                pass
        self.reason = self.reason or ended(status, late)
        os.close(self.pipe)
        with self.errors:
            self.said = errors_in(self.errors)


def _run(orders: list[Order], ours: Prepared) -> list[_Running]:
    """Run jobs beside each other; return their processes, which have ended."""
    started = [_begin(order, ours) for order in orders]
    running = list(started)
    while running:
        due = min(each.deadline for each in running) - time.monotonic()
        pipes = [each.pipe for each in running]
        ready = select.select(pipes, [], [], min(max(due, 0), GLANCE))[0]
        for each in list(running):
            late = time.monotonic() >= each.deadline
            goes_on = each.read() if each.pipe in ready else each.lives()
            if goes_on and not late and not each.takes_too_much():
                continue
            each.end(late and goes_on)
            running.remove(each)
            limits.end_orphans({other.pid for other in running})

    return started


def _begin(order: Order, ours: Prepared) -> _Running:
    """Start the process of a job."""
    pipe, answers = os.pipe()
    widen(pipe)
    # Without a name, so that no program can put another file in its place.
    errors = tempfile.TemporaryFile()  # noqa: SIM115
    us = os.getpid()
    program = copy()
    if program is None:
        os.setsid()
        limits.close_all_but(answers, errors.fileno())
        run_program(order, us, ours, answers, errors.fileno())
        os._exit(1)  # not reached: it ends the process
    os.close(answers)
    deadline = time.monotonic() + order["seconds"] + GRACE
    return _Running(program.pid, pipe, errors, Path(order["folder"]), order["megabytes"], deadline)


def _holds(pid: int) -> tuple[int, int]:
    """Return how many threads a process has, and the bytes of memory that it shares.

    Files that it maps are not among them.
    """
    found = {"Threads": 0, "RssShmem": 0}
    with contextlib.suppress(OSError):
        for line in Path(f"/proc/{pid}/status").read_text(errors="replace").splitlines():
            name, _, value = line.partition(":")
            if name in found:
                found[name] = int(value.split()[0])
    return found["Threads"], found["RssShmem"] << 10


if __name__ == "__main__":
    serve(sys.argv[1])
