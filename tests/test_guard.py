"""Programs that end their process, or would never end it, still end the command in one line."""

import json
import os
import re
import signal
import subprocess
import sys
import textwrap
import time
from functools import partial
from pathlib import Path

import pytest
from commands import Done, environment, landscape, need_library, python, refused

from framelens.base.errors import UNEXPECTED

BEGIN = """
import os
import glfw
from OpenGL.GL import *
glfw.init()
window = glfw.create_window(64, 48, "test", None, None)
glfw.make_context_current(window)
"""
SHOW = """
glBegin(GL_TRIANGLES)
for x, y in ((-1, -1), (1, -1), (0, 1)):
    glVertex2f(x, y)
glEnd()
glfw.swap_buffers(window)
"""

# Runs command lines as from a shell, each in a process of its own, which comes back from main(),
# with limits in seconds for the program and for its end.
RUN = """
import sys
from framelens.base import guard
from framelens.program import program
from landscape.cli import main
from framelens.system import limits

program.LIMIT, guard.GRACE = float(sys.argv[1]), float(sys.argv[2])
limits.FORKS = limits.FORKS and sys.argv[3] == "copied"
sys.argv[1:] = sys.argv[4:]
sys.exit(main())
"""
# The program's process is a copy of the command's, or the command is started once more.
WAYS = ("copied", "started") if hasattr(os, "fork") else ("started",)
both_ways = pytest.mark.parametrize("way", WAYS)


def run(tmp_path: Path, rest: str, limits: tuple[str, str] = ("15", "5"), way="started") -> Done:
    path = tmp_path / "program.py"
    path.write_text(BEGIN + textwrap.dedent(rest))
    words = (*limits, way, "state", str(path), "--json")
    return python(RUN, *words)


# What systems call it, and say of it.
CRASH, KILL = "SIGSEGV", "was killed, as the system does where memory runs"
GAVE_UP = "was ended (SIGABRT) by a library of C that could not go on"
LIBRARY = "None"
if sys.platform == "win32":
    CRASH, KILL = "abort", "ended its own process (status 9)"
    GAVE_UP = "crashed (abort), as OpenGL does where"
    LIBRARY = "'msvcrt'"
ENDS = {
    "crashes": (
        "import faulthandler\nfaulthandler._sigsegv()",
        f"crashed ({CRASH}), as OpenGL does where",
    ),
    "gives up": ("os.abort()", GAVE_UP),
    "is killed": ("os.kill(os.getpid(), 9)", KILL),
    "is held up in C": ("sum(range(10**13))", "was ended within one call that nothing can inter"),
    "leaves by itself": (
        f"import ctypes\nctypes.CDLL({LIBRARY})._exit(0)",
        "ended its own process (status 0)",
    ),
    "keeps its objects": (
        "class Keeper:\n    def __del__(self):\n        while True: pass\nk = Keeper()" + SHOW,
        "was ended within one call",
    ),
    "never says what it raises": (
        "class E(Exception):\n    def __str__(self):\n        while True: pass\nraise E",
        "was ended within one call",
    ),
    "takes standard error away": ("import sys\nsys.stderr = None", "ended after no frames"),
}


@both_ways
@pytest.mark.parametrize("name", ENDS)
@pytest.mark.sweep(12, first=10)
def test_what_no_exception_can_end_ends_in_one_line(tmp_path: Path, name: str, way: str) -> None:
    rest, words = ENDS[name]
    limits = ("1", "0.3") if "was ended" in words else ("15", "5")
    refused(run(tmp_path, rest, limits, way), "program.py: ", words)


@both_ways
@pytest.mark.sweep(8, first=7)
def test_a_program_may_not_take_more_memory_than_a_machine_spares(tmp_path: Path, way: str) -> None:
    done = run(tmp_path, "glFlush()\nmuch = b'x' * (2 << 30)\n" + SHOW, way=way)
    assert done.status == 2
    first = done.err.splitlines()[0]
    line = "9" if sys.platform == "linux" else r"\d+"  # elsewhere a thread sees it afterwards
    said = rf"line {line}: the program raised MemoryError \(it may take 1024 MB\)"
    assert re.fullmatch(f"landscape: .*, {said}", first)


@both_ways
@pytest.mark.sweep(5, first=1)
def test_what_a_program_prints_by_any_means_stays_out_of_the_output(
    tmp_path: Path, way: str
) -> None:
    done = run(
        tmp_path,
        """
        import sys
        print("by print")
        os.write(1, b"by the descriptor\\n")
        os.system("echo by a command")
        print("by the original", file=sys.__stdout__, flush=True)
        for _ in range(3): print("x" * 1000000)
        """
        + textwrap.indent(SHOW, " " * 8),
        way=way,
    )
    assert "GL_FOG" in json.loads(done.out)
    for words in ("by print", "by the descriptor", "by a command", "by the original"):
        assert words in done.err
    assert 1_000_000 < len(done.err) < 1_100_000 and "(the program prints more)" in done.err


ASKING = "n = int(input('how many? '))\nimport sys\nprint(sys.argv[1:], *sys.stdin)\n"


@pytest.mark.seldom(14, first=13)
@both_ways
def test_a_program_reads_the_commands_input_and_has_arguments_of_its_own(
    tmp_path: Path, way: str
) -> None:
    path = tmp_path / "program.py"
    path.write_text(ASKING + BEGIN + "for _ in range(n): glPushMatrix()" + SHOW)
    done = subprocess.run(
        [sys.executable, "-c", RUN, "15", "5", way, "trace", path, "--", "--frame", "9"],
        input="3\nmore\n",
        capture_output=True,
        text=True,
        env=environment(),
    )
    assert done.stdout.count("glPushMatrix()") == 3
    assert done.stderr.splitlines()[0] == "how many? ['--frame', '9'] more"


@pytest.mark.seldom(3, first=1)
def test_a_program_that_asks_in_vain_is_told_how_to_answer(tmp_path: Path) -> None:
    path = tmp_path / "program.py"
    path.write_text(ASKING + BEGIN)
    done = landscape("trace", path)
    line = next(line for line in done.err.splitlines() if line.startswith("landscape: "))
    assert "line 1: the program raised EOFError: EOF when reading a line (it asks for" in line


WAITING = "import threading\nthreading.Event().wait(3)" + SHOW


@pytest.mark.seldom(14, first=4)
@pytest.mark.skipif(sys.platform != "linux", reason="the time that a thread has spent is not known")
@both_ways
def test_a_limit_counts_the_processors_time(tmp_path: Path, way: str) -> None:
    assert run(tmp_path, WAITING, ("2", "0.5"), way).status == 0
    refused(run(tmp_path, WAITING.replace("3", ""), ("0.3", "0.5"), way), "no frame within 0.3 s")


@pytest.mark.seldom(10, first=3)
def test_the_command_line_sets_the_limit(tmp_path: Path) -> None:
    path = tmp_path / "program.py"
    path.write_text(BEGIN + "while True: pass")
    refused(landscape("trace", path, "--limit", "0.3"), "completed no frame within 0.3 s: it nev")
    refused(landscape("trace", path, "--limit", "0"), "'0': expected a number of seconds above 0")
    refused(landscape("trace", "fig35a", "--limit", "3"), "--limit: it is for programs")
    refused(landscape("trace", "fig35a", "--", "3"), "--: it is for programs; 'fig35a' is a view")


@pytest.mark.seldom(5, first=1)
def test_a_program_may_choose_the_encoding_of_what_it_prints(tmp_path: Path) -> None:
    program = """
        import sys
        sys.stdout.reconfigure(encoding="utf-8")
        print("after the choice")
        """
    done = run(tmp_path, program + textwrap.indent(SHOW, " " * 8))
    assert "GL_FOG" in json.loads(done.out) and "after the choice" in done.err


@pytest.mark.seldom(10, first=3)
@pytest.mark.skipif(not hasattr(os, "fork"), reason="no program can copy itself on this system")
def test_a_copy_that_a_program_makes_of_itself_prints_nothing(tmp_path: Path) -> None:
    # Since 3.12 Python warns of every copy of a process with threads, as OpenGL has.
    quiet = "import warnings\nwarnings.simplefilter('ignore', DeprecationWarning)\n"
    done = run(tmp_path, quiet + "child = os.fork()\nif child: os.waitpid(child, 0)\n" + SHOW)
    assert done.status == 0 and done.err == "" and "GL_FOG" in json.loads(done.out)


@pytest.mark.seldom(3, first=1)
def test_the_last_thing_drawn_may_be_waiting_when_the_window_closes(tmp_path: Path) -> None:
    need_library("OSMesa")
    path = tmp_path / "triangle.py"
    path.write_text(BEGIN + SHOW)
    done = landscape("trace", path, "--backend", "osmesa")
    assert done.status == 0 and "glVertex2f(0, 1)" in done.out, done.err


# Looks into a frame where the tool itself has a defect.
DEFECT = """
import sys
from landscape.cli import main
from framelens.system import limits
from framelens.commands import trace

def defect(target, options, other=None):
    return 1 // len("")

limits.FORKS = limits.FORKS and sys.argv[1] == "copied"
trace.show = defect
sys.argv[1:] = sys.argv[2:]
sys.exit(main())
"""


@both_ways
@pytest.mark.parametrize("target", ["program.py", "fig35e"])
@pytest.mark.sweep(2)
def test_a_defect_of_a_tool_says_what_and_where_and_prints_no_half_json(
    tmp_path: Path, target: str, way: str
) -> None:
    (tmp_path / "program.py").write_text(BEGIN + SHOW)
    path = tmp_path / target if target.endswith(".py") else target
    done = python(DEFECT, way, "trace", str(path), "--json")
    first, *details = done.err.splitlines()
    assert (done.status, done.out) == (UNEXPECTED, "")
    assert re.fullmatch(r"landscape: a defect .*: ZeroDivisionError: .* in .*, line \d+", first)
    assert details[0].startswith("Traceback") and details[-1].startswith("ZeroDivisionError")
    assert any(line.endswith("in defect") for line in details)


def test_work_that_raises_in_a_process_of_its_own_is_told() -> None:
    code = "from framelens.base.guard import guarded\nimport sys\n"
    done = python(code + "sys.exit(guarded('a program', lambda: {}['key']))")
    assert done.status == UNEXPECTED and done.out == ""
    assert done.err.startswith("landscape: a defect of this program: KeyError: 'key', in ")
    assert "Traceback" in done.err


@pytest.mark.posix_only("Windows ends what a program has started with its group")
@pytest.mark.skipif(not Path("/proc/self").exists(), reason="the system does not tell children")
@pytest.mark.seldom(3, first=2)
def test_what_a_program_has_started_ends_with_it(tmp_path: Path) -> None:
    place = tmp_path / "children"
    begin = f"""
    import subprocess
    for session in (False, True):
        child = subprocess.Popen(["sleep", "600"], start_new_session=session)
        with open({str(place)!r}, "a") as file:
            print(child.pid, file=file)
    """
    path = tmp_path / "program.py"
    path.write_text(textwrap.dedent(begin) + BEGIN + SHOW)
    done = python(RUN, "60", "5", "copied", "state", str(path), "--json")
    assert done.status == 0, done.err
    for number in place.read_text().split():
        assert not Path(f"/proc/{number}").exists()


@pytest.mark.seldom(13, first=6)
@pytest.mark.posix_only("there is no such signal")
def test_a_signal_to_the_command_alone_interrupts_the_program(tmp_path: Path) -> None:
    path = tmp_path / "program.py"
    path.write_text(BEGIN + 'open("begun", "w").close()\nwhile True:\n    pass\n')
    words = (sys.executable, "-c", RUN, "60", "60", "copied", "trace", str(path))
    # A test run in the background ignores SIGINT, which a child inherits.
    heeded = partial(signal.signal, signal.SIGINT, signal.default_int_handler)
    command = subprocess.Popen(
        words,
        stderr=subprocess.PIPE,
        text=True,
        env=environment(),
        cwd=tmp_path,
        preexec_fn=heeded,
    )
    while not (tmp_path / "begun").exists() and command.poll() is None:
        time.sleep(0.01)
    command.send_signal(signal.SIGINT)
    _, told = command.communicate(timeout=100)
    assert (command.returncode, told) == (130, "landscape: interrupted\n")


@pytest.mark.seldom(5, first=1)
def test_control_characters_of_an_exception_are_shown(tmp_path: Path) -> None:
    done = run(tmp_path, r'raise ValueError("first\nsecond \x1b[31m\x00")')
    assert done.status == 2 and "ValueError: first\n" in done.err
    assert "\x1b" not in done.err and "\x00" not in done.err and r"second \x1b[31m\x00" in done.err
