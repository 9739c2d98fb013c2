"""Run programs to a frame, as `landscape trace FILE.py` does, in processes of their own.

PyOpenGL binds to one platform per process, and a toolkit may crash. Programs of one toolkit share a
process, which also shows that each leaves nothing behind for the next.
"""

import hashlib
import json
import os
import shutil
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from commands import TESTS, end, environment

PROGRAMS = TESTS / "programs"

_CHILD = """
import json, os, sys
sys.path.insert(0, sys.argv[1])
from watching import answer, prepare
replies = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)
with prepare(bool(sys.argv[2:])):
    for line in sys.stdin:
        print(json.dumps(answer(json.loads(line))), file=replies, flush=True)
"""


def grid(picture: Any) -> Any:
    """Return the mean colours of 16 by 12 parts of a picture, uint8 (h, w, 3): a list of them."""
    height, width = picture.shape[:2]
    rows = picture[: height // 12 * 12, : width // 16 * 16]
    parts = rows.reshape(12, height // 12, 16, width // 16, 3)
    return parts.mean((1, 3)).round(1).reshape(-1, 3).tolist()


def colours(picture: Any) -> int:
    """Return how many colours there are in a picture, uint8 (h, w, 3)."""
    import numpy as np

    red, green, blue = (picture[..., k].ravel().astype(np.uint32) for k in range(3))
    colour, pixels = red << 16 | green << 8 | blue, np.arange(len(red), dtype=np.uint32)
    last = _every_colour()  # the last pixel of each: a fortieth of the time of sorting the pixels
    last[colour] = pixels
    return int(np.count_nonzero(last[colour] == pixels))


@cache
def _every_colour() -> Any:
    import numpy as np

    return np.empty(1 << 24, np.uint32)


class Watch:
    """An observer that counts each frame's calls, and reads the frame ``wanted``, or each.

    With ``each``, ``pictures`` are the checksums of the frames up to it, and no call is counted;
    ``grids`` are what ``grid`` makes of them, if that is asked for, too. The pixels of the frame
    ``wanted`` are written to ``file``, top row first.
    """

    def __init__(
        self, wanted: int | None = None, each: bool = False, grids: bool = False, file: str = ""
    ) -> None:
        self.each = each or grids
        self.wanted = wanted
        self._with_grids = grids
        self._file = file
        self.pictures: list[str] = []
        self.grids: list[Any] = []
        self.calls: list[tuple[str, tuple[Any, ...]]] = []
        self.log: list[Any] = []
        self.notices: list[str] = []
        self._inside = False

    def make(self, name: str, function: Any) -> Any:
        if self.each:
            return function

        def noted(*args: Any, **named: Any) -> Any:
            if self._inside:
                return function(*args, **named)
            self.calls.append((name, args))
            self._inside = True
            try:
                return function(*args, **named)
            finally:
                self._inside = False

        return noted

    def opened(self, window: Any) -> None:
        from framelens.gl.seam import gl

        self.window = window
        self.log.append(["opened", window.toolkit, window.backend, *window.size()])
        depth = gl.glIsEnabled(gl.GL_DEPTH_TEST)
        self.log.append(["default state", not depth and not self.calls])

    def frame_began(self, number: int) -> None:
        self.calls = []
        self.log.append(["began", number])

    def frame_ended(self, number: int) -> Any:
        import numpy as np

        from framelens.gl.seam import gl

        self.log.append(["ended", number])
        if self.wanted is not None and number != self.wanted and not self.each:
            return None
        width, height = self.window.size()
        gl.glPixelStorei(gl.GL_PACK_ALIGNMENT, 1)
        self.read = gl.glReadPixels(0, 0, width, height, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)
        picture = np.frombuffer(self.read, np.uint8).reshape(height, width, 3)[::-1]
        self.pictures.append(hashlib.sha256(picture.tobytes()).hexdigest())
        if self._with_grids:
            self.grids.append(grid(picture))
        if self.wanted is not None and number != self.wanted:
            return None
        if self._file:
            Path(self._file).write_bytes(picture.tobytes())
        return {
            "picture": self.pictures[-1],
            "size": [width, height],
            "colours": colours(picture),
            "calls": self.plain_calls(),
            "centre": picture[height // 2, width // 2].tolist(),
        }

    def plain_calls(self) -> list[list[str]]:
        """Return the frame's calls with those arguments that are numbers or texts."""
        return [
            [name, *(f"{value}" for value in args if isinstance(value, (int, float, str)))]
            for name, args in self.calls
        ]

    def notice(self, text: str) -> None:
        self.notices.append(text)


def _process() -> dict[str, Any]:
    """Return what a program may have changed and must find as it was."""
    import datetime
    import random
    import signal
    import threading
    import time

    finders = [finder for finder in sys.meta_path if "landscape" in type(finder).__module__]
    kept = {
        "argv": list(sys.argv),
        "path": list(sys.path),
        "folder": os.getcwd(),
        "environment": dict(os.environ),
        "main": sys.modules["__main__"],
        "input": sys.stdin,
        "time": (time.time, time.sleep, time.monotonic_ns, datetime.datetime, datetime.date),
        "random": random.getstate(),
        "exit": os._exit,
        "finders": finders,
        "daemon": threading.current_thread().daemon,
    }
    if sys.platform != "win32":
        kept["alarm"] = (signal.getsignal(signal.SIGALRM), signal.getitimer(signal.ITIMER_REAL))
    for name in ("OpenGL.GL", "OpenGL.GL.VERSION.GL_1_1", "OpenGL.GLUT", "glfw", "pygame.time"):
        if name in sys.modules:
            kept[name] = {
                key: id(value) for key, value in vars(sys.modules[name]).items() if callable(value)
            }
    return kept


def prepare(prepared: bool) -> ExitStack:
    """Replace OpenGL's functions once for all programs, if they are all to be ``prepared``."""
    stack = ExitStack()
    if prepared:
        from framelens.program import program
        from framelens.program.program_context import bind
        from framelens.program.program_source import Source

        bind(Source(Path(), compile("", "", "exec"), frozenset(), True), "auto")
        stack.enter_context(program.prepared(lambda name, function: function))
    return stack


def answer(asked: dict[str, Any]) -> dict[str, Any]:
    """Run one program, in the child process."""
    import contextlib
    import io

    before = _process()

    from framelens.base.errors import InputError, NoOpenGLError
    from framelens.program.program import run

    more = {name: asked.pop(name) for name in ("each", "grids", "file") if name in asked}
    observer = Watch(asked.get("frame"), **more)
    out, err = io.StringIO(), io.StringIO()
    reply: dict[str, Any] = {}
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            reply |= run(asked.pop("path"), **asked, observer=observer) or {}
        except (InputError, NoOpenGLError) as error:
            reply |= {"error": str(error), "details": getattr(error, "details", "")}
    after = _process()
    left = [name for name in before if before[name] != after[name]]
    log = {"log": observer.log, "notices": observer.notices, "left": left}
    log |= {"pictures": observer.pictures, "grids": observer.grids}
    return reply | log | {"out": out.getvalue(), "err": err.getvalue()}


@dataclass
class Seen:
    """What became of a program."""

    reply: dict[str, Any]

    def __getattr__(self, name: str) -> Any:
        return self.reply[name]

    @property
    def error(self) -> str:
        """The error, which must be one line; "" if there was none."""
        error = self.reply.get("error", "")
        assert "\n" not in error
        return error

    @property
    def names(self) -> Counter[str]:
        """How often each function was called in the frame."""
        assert not self.error, self.error + self.reply["details"]
        return Counter(call[0] for call in self.reply["calls"])


class Watcher:
    """A process that runs programs.

    With ``prepared`` their calls are not seen, and they start in a third of the time.
    """

    def __init__(
        self, cwd: Path, *before: str, prepared: bool = False, **changes: str | None
    ) -> None:
        command = [*before, sys.executable, "-c", _CHILD, str(TESTS), *["prepared"] * prepared]
        self._process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            cwd=cwd,
            env=environment(**changes),
        )

    def __call__(self, path: Path | str, frame: int | None = 0, **more: Any) -> Seen:
        """Run a program to a frame."""
        assert self._process.stdin and self._process.stdout
        asked = {"path": str(path), "frame": frame, **more}
        self._process.stdin.write(json.dumps(asked) + "\n")
        self._process.stdin.flush()
        line = self._process.stdout.readline()
        assert line, f"the process ended with status {self._process.wait()}"
        seen = Seen(json.loads(line))
        assert seen.left == [], seen.left
        return seen

    def ended(self, path: Path, frame: int, error: str) -> None:
        """Assert that a program that never comes to a frame is ended by ``error``.

        ``{}`` in it stands for the limit. On a machine so busy that the program does not come as
        far as it would within the limit, the limit is raised.
        """
        for limit in (0.4, 2.0, 10.0, 50.0):
            seen = self(path, frame, limit=limit)
            if error.format(f"within {limit:g} s") in seen.error:
                return
        raise AssertionError(seen.error)

    def close(self) -> None:
        """End the process."""
        with self._process:
            assert self._process.stdin
            self._process.stdin.close()


@contextmanager
def screen(size: str = "1024x768x24") -> Iterator[str]:
    """Run Xvfb beside the block; give its name for DISPLAY. The test is skipped without it."""
    if shutil.which("Xvfb") is None:
        pytest.skip("Xvfb, a screen for tests, is not installed")
    read, write = os.pipe()
    command = ["Xvfb", "-displayfd", str(write), "-screen", "0", size, "-noreset"]
    command += ["-nolisten", "tcp"]
    with subprocess.Popen(command, pass_fds=(write,), stderr=subprocess.DEVNULL) as process:
        os.close(write)
        try:
            with os.fdopen(read) as pipe:
                number = pipe.readline().strip()
            assert number, "Xvfb did not start"
            yield f":{number}"
        finally:
            end(process)
