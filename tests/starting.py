"""Start GLFW programs one after another, each in a copy of one process that has imported OpenGL.

Each is the main program of a process of its own, and ends as Python ends. Only the time to import
PyOpenGL, GLFW, numpy and Pillow is spent once. After each frame but the first a program waits, as
it would for a screen: Xvfb takes as many frames as the processor can draw.
"""

import contextlib
import json
import os
import select
import signal
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

from commands import SECONDS

# The copy leaves the loop: its end is that of the interpreter, with all that Python does there.
_SERVER = """
import gc, json, os, runpy, sys, time
import glfw, numpy, OpenGL.GL, PIL.Image
gc.collect()
gc.freeze()  # a copy need not look through all of this when it ends
with os.fdopen(os.dup(0)) as asked:
    replies = os.dup(1)
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    for line in asked:
        file, output = json.loads(line)
        pid = os.fork()
        if pid == 0:
            break
        status = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
        os.write(replies, b"ended %d\\n" % status)
    else:
        sys.exit()
written = os.open(output, os.O_WRONLY | os.O_CREAT)
os.dup2(written, 1)
os.dup2(written, 2)
os.close(written)

show = glfw.swap_buffers
def show_first(window):
    glfw.swap_buffers = show_next
    show(window)
    os.write(replies, b"shown %d\\n" % os.getpid())
    os.close(replies)
def show_next(window):
    show(window)
    time.sleep(0.012)
glfw.swap_buffers = show_first

sys.argv, sys.path[0] = [file], os.path.dirname(file)
runpy.run_path(file, run_name="__main__")
"""


class Starter:
    """The process that is copied; warnings are errors in it, and in the programs."""

    def __init__(self, env: Mapping[str, str]) -> None:
        self._process = subprocess.Popen(
            [sys.executable, "-W", "error", "-c", _SERVER],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=dict(env),
            bufsize=0,
            start_new_session=True,
        )
        self.alive = True

    def start(self, file: Path, output: Path) -> int:
        """Start a program; return its number when it has shown a frame.

        What it prints goes into the file ``output``.
        """
        assert self._process.stdin is not None
        self._process.stdin.write(json.dumps([str(file), str(output)]).encode() + b"\n")
        what, number = self._heard()
        assert what == "shown", f"ended with {number}: {output.read_text()}"
        return number

    def end(self) -> int:
        """Wait until the program has ended; return its status, minus the signal that ended it."""
        what, number = self._heard()
        assert what == "ended"
        return number

    def _heard(self) -> tuple[str, int]:
        """Return the next news of the program."""
        assert self._process.stdout is not None
        if not select.select([self._process.stdout], [], [], SECONDS)[0]:
            self.close()
            raise AssertionError(f"the program did not go on within {SECONDS} s")
        what, number = self._process.stdout.readline().split()
        return what.decode(), int(number)

    def close(self) -> None:
        """End the process, and the program if it still runs."""
        self.alive = False
        with self._process, contextlib.suppress(ProcessLookupError):
            os.killpg(self._process.pid, signal.SIGKILL)
