"""Commands and code run in copies of one process that has imported the program.

Each copy is a process of its own, with its own status, streams and end, and ends as Python ends.
It knows the command line by which it could be started anew.
Only the time to import the program, numpy and Pillow is spent once; OpenGL is not imported before
the copy does so itself, as its platform must be chosen first.
"""

import contextlib
import json
import os
import select
import signal
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path

# Read by the program or by libraries, and not by Python at its start: a copy may have its own. It
# adds the folders of PYTHONPATH itself.
LATER = {
    "PYTHONPATH",
    "DISPLAY",
    "XDG_RUNTIME_DIR",
    "XDG_SESSION_TYPE",
    "WAYLAND_DISPLAY",
    "COLUMNS",
    "LANG",
    "LANGUAGE",
    "LANDSCAPE_CACHE",
    "LIBGL_ALWAYS_SOFTWARE",
    "MESA_GL_VERSION_OVERRIDE",
    "PYOPENGL_USE_ACCELERATE",
    "XDG_DATA_DIRS",
    "XDG_DATA_HOME",
    "GALLIVM_PERF",
}

# The copy leaves the loop: its end is that of the interpreter, with all that Python does there.
_SERVER = """
import gc, json, os, runpy, sys
import landscape.cli, landscape.offscreen, landscape.commands.render_many, platformdirs, PIL.Image
from landscape.files import cache
from landscape.scene.scene import SCENES, scene
for name in SCENES:
    scene(name)
PIL.Image.preinit()
cache.code()
assert not [name for name in sys.modules if name.startswith("OpenGL")]
gc.collect()
gc.freeze()  # a copy need not look through all of this when it ends
with os.fdopen(os.dup(0)) as asked:
    replies = os.dup(1)
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    for line in asked:
        code, words, cwd, env, *streams = json.loads(line)
        pid = os.fork()
        if pid == 0:
            break
        status = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
        os.write(replies, b"%d\\n" % status)
    else:
        sys.exit()
os.close(replies)
for number, path in enumerate(streams, 1):
    written = os.open(path, os.O_WRONLY | os.O_CREAT)
    os.dup2(written, number)
    os.close(written)
os.chdir(cwd)
os.environ.clear()
os.environ.update(env)
sys.path[1:1] = [path for path in env["PYTHONPATH"].split(":") if path not in sys.path]
sys.argv = ["-c" if code else "landscape", *words]
sys.orig_argv = [sys.executable, *(("-c", code) if code else ("-m", "landscape")), *words]
if code:
    exec(compile(code, "<string>", "exec"), {"__name__": "__main__"})
else:
    runpy.run_module("landscape", run_name="__main__", alter_sys=True)
"""


def differ_late(one: Mapping[str, str], other: Mapping[str, str]) -> bool:
    """Return whether environments differ at most in what Python does not read at its start."""
    return {name for name, _ in set(one.items()) ^ set(other.items())} <= LATER


class Copies:
    """The process that is copied, started when it is first needed."""

    def __init__(self) -> None:
        self._env: Mapping[str, str] = {}
        self._process: subprocess.Popen[bytes] | None = None

    def __call__(
        self, code: str, words: list[str], cwd: Path, env: Mapping[str, str], seconds: float
    ) -> tuple[int, str, str]:
        """Run code, or `landscape WORDS` if there is none; return status, output and errors.

        TimeoutExpired if it takes longer than ``seconds``; all of it is ended then.
        """
        if self._process is None or not differ_late(self._env, env):
            self.end()
            self._start(env)
        assert self._process is not None
        assert self._process.stdin is not None and self._process.stdout is not None

        with tempfile.TemporaryDirectory() as folder:
            streams = [Path(folder, name) for name in ("out", "err")]
            asked = [code, words, str(cwd), dict(env), *map(str, streams)]
            self._process.stdin.write(json.dumps(asked).encode() + b"\n")
            if not select.select([self._process.stdout], [], [], seconds)[0]:
                self.end()
                raise subprocess.TimeoutExpired([code or "landscape", *words], seconds)
            status = int(self._process.stdout.readline())
            return status, *(stream.read_text() for stream in streams)

    def _start(self, env: Mapping[str, str]) -> None:
        self._env = dict(env)
        self._process = subprocess.Popen(
            [sys.executable, "-c", _SERVER],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=self._env,
            bufsize=0,
            start_new_session=True,
        )

    def end(self) -> None:
        """End the process, and a copy if one still runs."""
        if self._process is not None:
            with self._process, contextlib.suppress(ProcessLookupError):
                os.killpg(self._process.pid, signal.SIGKILL)
        self._process = None


copies = Copies()
