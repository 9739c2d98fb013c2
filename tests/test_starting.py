"""How a command begins: closed standard streams, and Ctrl-C while it is still being imported."""

import subprocess
import sys
from pathlib import Path

import pytest
from commands import SECONDS, environment

# Sends Ctrl-C to its own process when a module is looked for.
INTERRUPTED = """
import os, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored by what runs in the background
package, module = sys.argv[1:]
class Finder:
    def find_spec(self, name, path=None, target=None):
        if name == module:
            os.kill(os.getpid(), signal.SIGINT)
sys.meta_path.insert(0, Finder())
import importlib
main = importlib.import_module(f"{package}.__main__").main
sys.argv = [package, "views"]
sys.exit(main())
"""
# As when a shell command ends with <&- >&- 2>&-.
CLOSED = """
import os, sys
for number in (0, 1, 2):
    os.close(number)
os.execv(sys.executable, [sys.executable, "-m", *sys.argv[1:]])
"""
# A command that Ctrl-C has left, while a thread of it goes on.
LEFT = """
import atexit, sys, time
from argparse import Namespace
from concurrent.futures import ThreadPoolExecutor
from framelens.commands.reporting import run_command

def run(options):
    atexit.register(print, "tidied up")
    workers = ThreadPoolExecutor(1)
    workers.submit(time.sleep, 3600)
    workers.shutdown(wait=False)
    raise KeyboardInterrupt

sys.exit(run_command(None, lambda argv: Namespace(run=run)))
"""
PROGRAM = """
import glfw
from OpenGL.GL import *
glfw.init()
window = glfw.create_window(20, 20, "", None, None)
glfw.make_context_current(window)
glClear(GL_COLOR_BUFFER_BIT)
glfw.swap_buffers(window)
"""


@pytest.mark.posix_only("Ctrl-C is no signal there that a process sends to itself")
@pytest.mark.parametrize(
    ("package", "module"),
    [
        ("landscape", "argparse"),
        ("landscape", "framelens.commands.reporting"),
        ("landscape", "landscape.commands.views"),
        ("framelens", "framelens.cli"),
    ],
)
def test_ctrl_c_while_a_command_is_imported_ends_it_in_one_line(package: str, module: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", INTERRUPTED, package, module],
        env=environment(),
        capture_output=True,
        text=True,
    )
    assert (done.returncode, done.stdout, done.stderr) == (130, "", f"{package}: interrupted\n")


@pytest.mark.seldom(10, first=7)
@pytest.mark.posix_only("no shell there closes a stream")
def test_a_program_is_traced_with_all_standard_streams_closed(tmp_path: Path) -> None:
    (tmp_path / "program.py").write_text(PROGRAM)
    arguments = ["framelens", "strip", "program.py", "--out", "strip.png"]
    done = subprocess.run(
        [sys.executable, "-c", CLOSED, *arguments], env=environment(), cwd=tmp_path
    )
    assert done.returncode == 0
    assert {path.name for path in tmp_path.iterdir()} == {"program.py", "strip.png"}


def test_an_interrupted_command_waits_for_no_thread() -> None:
    done = subprocess.run(
        [sys.executable, "-c", LEFT],
        env=environment(),
        capture_output=True,
        text=True,
        timeout=SECONDS,
    )
    assert (done.returncode, done.stdout) == (130, "tidied up\n")
    assert done.stderr == "framelens: interrupted\n"
