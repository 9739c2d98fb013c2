"""Run command lines as a user would; many of them share one child process, for speed.

They run in a separate process because PyOpenGL binds to one platform per process, and because a
context opened there cannot disturb the context of the tests.
"""

import contextlib
import ctypes
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from copies import copies, differ_late
from PIL import Image

from framelens.gl.libraries import load
from landscape.files.assets import shipped

TESTS = Path(__file__).resolve().parent
SECONDS = 300  # timeout of a command; the machine may be busy

_CHILD = """
import contextlib, gc, io, json, os, sys, traceback, warnings
from landscape.cli import main

# Show every warning: the user would see it on standard error.
for kind in (RuntimeWarning, UserWarning, FutureWarning):
    warnings.simplefilter("always", kind)
gc.freeze()  # what is imported is no garbage
replies = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)
for line in sys.stdin:
    asked = json.loads(line)
    os.chdir(asked["cwd"])
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            status = main(asked["args"])
        except SystemExit as end:
            status = end.code
        except BaseException:
            status = 1
            traceback.print_exc()
    answer = {"status": status, "out": out.getvalue(), "err": err.getvalue()}
    print(json.dumps(answer), file=replies, flush=True)
"""


def environment(**changes: str | None) -> dict[str, str]:
    """Return the environment of a shell without a display; a value of None removes a variable.

    On Windows there is always a display; Wine shows it on that of an X server.
    """
    # Pytest names the running test; a process started for one test serves others.
    left_out = ["PYOPENGL_PLATFORM", "LANDSCAPE_GL_CHECKS", "PYTEST_CURRENT_TEST"]
    if sys.platform != "win32":
        # By XDG_SESSION_TYPE GLFW decides which of two window systems it takes.
        left_out += ["DISPLAY", "WAYLAND_DISPLAY", "XDG_SESSION_TYPE"]
    kept = {name: value for name, value in os.environ.items() if name not in left_out}
    kept["PYTHONPATH"] = str(TESTS.parent)
    return kept | {name: value for name, value in changes.items() if value is not None}


@dataclass(frozen=True)
class Done:
    """Exit status and output of a command."""

    status: int
    out: str
    err: str

    def json(self) -> Any:
        """Return the command's standard output, parsed as JSON."""
        assert self.status == 0, self.err
        return json.loads(self.out)


def refused(done: Done, *words: str) -> None:
    """Assert that a command ended with one error line that contains the words."""
    assert done.status == 2, done
    assert done.out == ""
    assert re.fullmatch(r"landscape: [^\n]+\n", done.err), done.err
    for word in words:
        assert word.replace(os.sep, "/") in done.err.replace(os.sep, "/")


def small_textures(folder: Path) -> None:
    """Write small copies of the textures that are slowest to load."""
    for name in ("ground_large", "ground_detail", "animal", "water"):
        with Image.open(shipped() / f"{name}.png") as image:
            image.resize((64, 64)).save(folder / f"{name}.png")


class Shell:
    """Runs command lines one after another in one process, in the directory ``cwd``.

    ``small`` are options that make rendering fast.
    """

    def __init__(self, env: Mapping[str, str] | None = None) -> None:
        self._env = dict(env or environment())
        self._start()
        self.cwd = Path.cwd()
        self._assets = tempfile.TemporaryDirectory()
        small_textures(Path(self._assets.name))
        self.small = ("--assets", self._assets.name)

    def _start(self) -> None:
        self._process = subprocess.Popen(
            [sys.executable, "-c", _CHILD],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env=self._env,
        )

    def __call__(self, *args: str | Path) -> Done:
        """Run `landscape ARGS`. If the process dies of it, the next command gets another one."""
        asked = {"args": [str(arg) for arg in args], "cwd": str(self.cwd)}
        assert self._process.stdin is not None and self._process.stdout is not None
        line = ""
        with contextlib.suppress(BrokenPipeError):
            self._process.stdin.write(json.dumps(asked) + "\n")
            self._process.stdin.flush()
            line = self._process.stdout.readline()
        if not line:
            status = self._ended()
            self._start()
            pytest.fail(f"the process ended with status {status} while running {args}")
        return walked(" ".join(asked["args"]), Done(**json.loads(line)))

    def _ended(self) -> int:
        """End the process, which may have died, and return its status."""
        assert self._process.stdin is not None and self._process.stdout is not None
        with contextlib.suppress(BrokenPipeError):
            self._process.stdin.close()
        self._process.stdout.close()
        return self._process.wait(SECONDS)

    def close(self) -> None:
        """End the process."""
        self._ended()
        self._assets.cleanup()


def walked(given: str, done: Done) -> Done:
    """Return what a walk with no screen did; skip the test if nothing can draw that here."""
    failed = done.status != 0 and "osmesa" in done.err.lower()
    if failed and "osmesa" in given and "walk" in given.lower():
        need_library("OSMesa")
    return done


def landscape(
    *args: str | Path, env: Mapping[str, str] | None = None, cwd: Path | None = None
) -> Done:
    """Run `landscape ARGS` in a process of its own, as from a shell."""
    return _run("", args, env, cwd)


def python(code: str, *args: str, env: Mapping[str, str] | None = None) -> Done:
    """Run Python code in a process of its own."""
    return _run(code, args, env, None)


def _run(
    code: str, args: Sequence[str | Path], env: Mapping[str, str] | None, cwd: Path | None
) -> Done:
    """Run code, or `landscape ARGS`, in a copy of a process that has imported the program.

    Python is started anew if its start depends on the environment, and where nothing is copied.
    """
    words = list(map(str, args))
    usual = environment()
    cwd = cwd or Path.cwd()
    env = usual if env is None else env
    if hasattr(os, "fork") and differ_late(usual, env):
        done = Done(*copies(code, words, cwd, env, SECONDS))
    else:
        command = [sys.executable, *(("-c", code) if code else ("-m", "landscape")), *words]
        ended = subprocess.run(
            command, capture_output=True, text=True, timeout=SECONDS, env=dict(env), cwd=cwd
        )
        done = Done(ended.returncode, ended.stdout, ended.stderr)

    return walked(" ".join((code, *words)), done)


@contextlib.contextmanager
def running(*words: str | Path, **options: Any) -> Iterator["subprocess.Popen[str]"]:
    """Run `landscape WORDS` beside the block; at its end nothing of it is left, no pipe either.

    It can be interrupted: a test run in the background ignores SIGINT, which a child inherits.
    """
    if sys.platform != "win32":
        options["start_new_session"] = True
        options["preexec_fn"] = partial(signal.signal, signal.SIGINT, signal.default_int_handler)
    with subprocess.Popen(
        [sys.executable, "-m", "landscape", *map(str, words)],
        env=environment(),
        text=True,
        **options,
    ) as process:
        try:
            yield process
        finally:
            if process.poll() is None:
                kill_all(process)


def kill_all(process: "subprocess.Popen[Any]") -> None:
    """End a process that leads a session, with those that it has started.

    On Windows they end by themselves when their parent has ended.
    """
    if sys.platform == "win32":
        process.kill()
    else:
        os.killpg(process.pid, signal.SIGKILL)


def is_running(pid: int) -> bool:
    """Return whether a process runs; one that has ended but is not waited for does not."""
    if sys.platform == "win32":
        kernel, asks, still_active = ctypes.windll.kernel32, 0x1000, 259  # as winbase.h has them
        process, status = kernel.OpenProcess(asks, False, pid), ctypes.c_uint32()
        kernel.GetExitCodeProcess(process, ctypes.byref(status))
        kernel.CloseHandle(process)
        return bool(process) and status.value == still_active
    try:
        with open(f"/proc/{pid}/stat", encoding="ascii") as file:
            return file.read().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


REMOVED = {"OSMesa": ": Mesa removed it in version 25.1"}


def need_library(*names: str) -> None:
    """Skip the test if a system library is not installed."""
    for name in names:
        if not has_library(name):
            pytest.skip(f"lib{name} is not installed{REMOVED.get(name, '')}")


def has_library(name: str) -> bool:
    """Return whether a system library is installed."""
    try:
        load(name)
    except OSError:
        return False
    return True


def bound_by_rights() -> list[str]:
    """Return a command under which files without rights cannot be opened, not even by root."""
    if os.geteuid() != 0:
        return ["env"]
    kept_out = "-dac_override,-dac_read_search"
    return ["setpriv", f"--bounding-set={kept_out}", f"--inh-caps={kept_out}"]


def end(server: "subprocess.Popen[Any]") -> None:
    """End an Xvfb. A SIGTERM that comes just before it waits for clients again is lost there."""
    server.terminate()
    try:
        server.wait(5)
    except subprocess.TimeoutExpired:
        server.kill()
        server.wait()
