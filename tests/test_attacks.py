"""Programs that try to get out of the sandbox, where the system contains them.

Each of them goes around Python: by ctypes, or by functions that tell nothing. What it could read it
would raise as an exception, which the report shows; what it could write or start is looked for.
"""

import os
import socket
import tempfile
import time
import tracemalloc
import warnings
from collections.abc import Iterator
from functools import partialmethod
from pathlib import Path
from typing import Any

import pytest
from commands import python
from solved import solved
from sweeps import Todays

from framelens.base.errors import InputError, UnexpectedError
from framelens.system import containment, limits
from landscape.course.exercise import Grader, Report, _syntax
from landscape.course.grader import evidence_file, recorded, sandbox_forks, stream, workplace
from landscape.course.grader.confinement import LANDLOCK, NONE, PYTHON, REQUIRE
from landscape.course.grader.sandbox import Job
from landscape.course.grader.troubles import known
from landscape.course.roster.grades import Rules, grade_class
from landscape.course.roster.submissions import Submission
from landscape.course.shelf import FOLDER

pytestmark = [
    pytest.mark.posix_only("the system contains no programs"),
    pytest.mark.skipif(
        not containment.possible(), reason="the system has no Landlock, or another processor"
    ),
]
SECONDS = 60.0  # a program may take; the machine may be busy with other tests
SECRET = "the work of somebody else"
SOLUTION = solved("winding")
HEAD = """
import ctypes, os, sys
from pathlib import Path
C = ctypes.CDLL(None, use_errno=True)
C.opendir.restype = ctypes.c_void_p
HOME, OTHER, COURSE = Path({home!r}), Path({other!r}), Path({course!r})
PARENT, GRADER, PORT = os.getppid(), {grader}, {port}

def leak(what):
    raise RuntimeError(f"LEAK {{what}}")

def wait():
    while True:
        C.sleep(600)  # time.sleep does not wait: the clock of a program is held

def by_c(path):
    file = C.open(os.fsencode(path), 0)
    data = ctypes.create_string_buffer(1 << 16)
    if file >= 0 and C.read(file, data, len(data)) > 0:
        leak(data.value[:30])
"""


def sent(answer: dict[str, Any]) -> str:
    """Return a program that writes an answer into whatever leads to the grader, and ends."""
    return f"""
import json, stat, struct
text = json.dumps({answer!r}).encode()
for file in range(3, 64):
    try:
        if stat.S_ISFIFO(os.fstat(file).st_mode):
            os.write(file, struct.pack(">Q", len(text)) + text)
    except OSError:
        pass
C._exit(0)
"""


DEFECT = "says that the grader has a defect"
ATTACKS = {
    "makes files that nobody can delete": """
for path in (Path(os.environ["TMPDIR"]) / "mine", Path(os.environ["TMPDIR"])):
    file = os.open(path, os.O_RDONLY if path.is_dir() else os.O_RDWR | os.O_CREAT)
    for request, flag in ((0x40086602, 0x10), (0x401C5820, 0x8)):
        flags = (ctypes.c_uint32 * 7)(flag)
        if C.ioctl(file, ctypes.c_ulong(request), flags) == 0:
            leak("immutable")
""",
    "watches a folder that it must not read": """
watch = C.inotify_init1(0)
for folder in (OTHER.parent, HOME, COURSE):
    if C.inotify_add_watch(watch, bytes(folder), 0xFFF) > 0:
        leak(folder)
""",
    "keeps others from files, and hides files and itself": """
file = os.open("/proc/self/exe", os.O_RDONLY)
if C.fcntl(file, 1024, 0) == 0:
    leak("lease")
if C.fcntl(os.pipe()[1], 1031, 1 << 20) > 0:
    leak("pipe")
if C.socketpair(1, 1, 0, (ctypes.c_int * 2)()) == 0:
    leak("pair of sockets")
if C.prctl(4, 0, 0, 0, 0) == 0:
    leak("not to be looked into")
""",
    "holds files that nobody counts": """
import threading
def work():
    if C.syscall(436, 5000, 5001, 2) == 0:
        leak("a table of files of its own")
thread = threading.Thread(target=work)
thread.start(), thread.join()
# The kernel would look at the last pointer first, and find it wrong.
for missing in (0x100, 0x200, 0x400, 0x800):
    if C.syscall(56, 0x11F00 - missing, 0, 0, 0, 0) == 0 or ctypes.get_errno() != 1:
        leak(f"clone {missing:x}")
for space in (0x20000, 0x2000000, 0x4000000, 0x8000000, 0x10000000, 0x20000000, 0x40000000):
    if C.syscall(56, 0x11F00 | space, 0, 0, 0, 0) == 0 or ctypes.get_errno() != 1:
        leak(f"namespace {space:x}")
""",
    "freezes, grows and shuts down a file system": """
file = os.open(Path(os.environ["TMPDIR"]) / "mine", os.O_RDWR | os.O_CREAT)
# With arguments that the kernel refuses for themselves: EPERM is the filter's.
for request in (0x8004587D, 0xC0185879, 0xC0045878, 0x40086610, 0x40049409, 0x40087602):
    if C.ioctl(file, ctypes.c_ulong(request), None) == 0 or ctypes.get_errno() != 1:
        leak(f"ioctl {request:x}")
for advice in (100, 101):
    if C.madvise(ctypes.c_void_p(0x10000), 4096, advice) == 0 or ctypes.get_errno() != 1:
        leak(f"madvise {advice}")
for number in (162, 306, 206, 154, 444, 446):
    if C.syscall(number, -1, 0, 0, 0, 0) >= 0 or ctypes.get_errno() != 1:
        leak(f"call {number}")
""",
    "becomes another user, or uses what root may": """
for name, number in (("setuid", 105), ("setgid", 106), ("setfsuid", 122), ("setgroups", 116)):
    if C.syscall(number, 0, 0) >= 0:
        leak(name)
for line in Path("/proc/self/status").read_text().splitlines():
    if line.startswith(("CapEff", "CapPrm", "CapInh")) and int(line.split()[1], 16) & ~6:
        leak(line)
""",
    "opens more than the system has": """
ends = []
try:
    while len(ends) < 2000:
        ends += os.pipe()
    leak("pipes")
except OSError:
    for end in ends:
        os.close(end)
""",
    "says that it crashed in a line of too many digits": """
import stat
for file in range(3, 64):
    try:
        if stat.S_ISREG(os.fstat(file).st_mode):
            os.write(file, f'  File "{__file__}", line {"9" * 6000}\\n'.encode())
    except OSError:
        pass
C.abort()
""",
    "replaces a file of the home": """
try:
    mine = Path(os.environ["TMPDIR"]) / "mine"
    mine.write_text("lost")
    C.rename(bytes(mine), bytes(HOME / "precious.txt"))
    C.renameat2(-100, bytes(mine), -100, bytes(HOME / "precious.txt"), 0)
    C.link(bytes(mine), bytes(HOME / "new.txt"))
    C.symlink(bytes(mine), bytes(HOME / "newer.txt"))
except OSError:
    pass
""",
    "writes, empties and deletes by C": """
path = bytes(HOME / "precious.txt")
for flags in (1, 2, 0o1001, 0o101, 0o2001):
    C.write(C.open(path, flags, 0o600), b"lost", 4)
C.truncate(path, 0)
C.unlink(path)
C.rmdir(bytes(HOME))
C.mkdir(bytes(HOME / "new"), 0o700)
C.mkfifo(bytes(HOME / "fifo"), 0o600)
C.chmod(path, 0)
C.chown(path, 12345, 12345)
C.setxattr(path, b"user.lost", b"1", 1, 0)
C.utimes(path, None)
""",
    "reads the work of others": """
by_c(OTHER)
by_c(HOME / "precious.txt")
for entry in ("self", str(PARENT), str(GRADER), "1"):
    for way in ("root", "cwd"):
        by_c(f"/proc/{entry}/{way}" + str(OTHER))
link = os.environ["TMPDIR"] + "/link"
C.link(bytes(OTHER), link.encode()), C.symlink(bytes(OTHER), link.encode())
by_c(link)
for folder in (OTHER.parent, HOME):
    if C.opendir(bytes(folder)) and os.listdir(folder):
        leak(folder)
""",
    "reads the solution and the grader": """
for path in (*COURSE.glob("exercises/winding/*.py"), *COURSE.glob("grader/*.py")):
    by_c(path)
for name in ("solution.py", "grading.py", "mutants.py", "__pycache__/solution.cpython-311.pyc"):
    by_c(COURSE / "exercises/winding" / name)
by_c(COURSE.parents[1] / ".git/HEAD")
for name in ("landscape.course.exercises.winding.solution", "landscape.course.exercise"):
    try:
        __import__(name)
        leak(name)
    except (ImportError, OSError):
        pass
""",
    "reads the solution that was put together": """
kept = Path(os.environ["TMPDIR"]).parent / "kept"
by_c(kept / "winding-solution.py")
if C.opendir(bytes(kept)) and os.listdir(kept):
    leak(kept)
""",
    "looks into other processes": """
class Part(ctypes.Structure):
    _fields_ = [("base", ctypes.c_void_p), ("size", ctypes.c_size_t)]
data = ctypes.create_string_buffer(64)
mine, there = Part(ctypes.addressof(data), 64), Part(id(None), 64)
for other in (PARENT, GRADER):
    if C.process_vm_readv(other, ctypes.byref(mine), 1, ctypes.byref(there), 1, 0) > 0:
        leak("memory")
    if C.ptrace(16, other, None, None) == 0 or C.ptrace(0x4206, other, None, None) == 0:
        leak("ptrace")
    for name in ("environ", "mem", "maps", "fd", "cmdline"):
        by_c(f"/proc/{other}/{name}")
""",
    "reads the secrets of the environment": """
if "hidden" in str(os.environ) or "hidden" in Path("/proc/self/environ").read_text():
    leak("environment")
""",
    "starts processes that outlive it": """
for number in (57, 58, 56, 435):
    if C.syscall(number, 17, 0, 0, 0, 0) == 0:
        C.setsid()
        wait()
words = (ctypes.c_char_p * 3)(b"sleep", b"600", None)
C.posix_spawn(None, b"/bin/sleep", None, None, words, None)
C.system(b"sleep 600 &")
C.popen(b"sleep 600", b"r")
C.execv(b"/bin/sleep", words)
""",
    "ends other processes": """
for other in (PARENT, GRADER, 0, -1, -PARENT, -GRADER):
    C.kill(other, 9)
for other in (PARENT, GRADER):
    C.syscall(234, other, other, 9), C.tkill(other, 9) if hasattr(C, "tkill") else 0
    C.pidfd_send_signal(C.pidfd_open(other, 0), 9, None, 0)
    ends = (ctypes.c_int * 2)()
    C.pipe2(ends, 0o20000)
    C.fcntl(ends[0], 10, 9), C.fcntl(ends[0], 8, other), C.write(ends[1], b"x", 1)
""",
    "reaches a server": """
address = b"\\x02\\x00" + PORT.to_bytes(2, "big") + bytes([127, 0, 0, 1]) + bytes(8)
if C.connect(C.socket(2, 1, 0), address, 16) == 0:
    leak("network")
if C.syscall(425, 8, ctypes.create_string_buffer(256)) >= 0:
    leak("io_uring")
""",
    "writes into all that is open": """
for file in range(3, 256):
    for text in (b'{"ended": [["", 0, ""]], "contained": "landlock"}\\n', bytes(8) + b"{}"):
        if C.fcntl(file, 3) & 3:
            C.write(file, text, len(text))
""",
    "sends without end": """
import stat
for file in range(3, 64):
    try:
        while stat.S_ISFIFO(os.fstat(file).st_mode):
            os.write(file, bytes(1 << 20))
    except OSError:
        pass
""",
    "fills the disk": """
place = Path(os.environ["TMPDIR"])
for number in range(40):
    with open(place / str(number), "wb") as file:
        file.truncate(60 << 20)
wait()
""",
    "leaves what is hard to delete": """
place = Path(os.environ["TMPDIR"])
os.chdir(place)
for _ in range(1500):
    os.mkdir("deeper")
    os.chdir("deeper")
(place / "deeper" / "file").write_text("x")
""",
    "lifts its limits": """
import resource
for kind in (resource.RLIMIT_CPU, resource.RLIMIT_DATA, resource.RLIMIT_FSIZE, resource.RLIMIT_AS):
    no_limit = (ctypes.c_uint64 * 2)(2**64 - 1, 2**64 - 1)
    if C.setrlimit(kind, no_limit) == 0 or C.prlimit(0, kind, no_limit, None) == 0:
        leak("limits")
if C.prctl(1, 0, 0, 0, 0) == 0:
    leak("outlives its parent")
""",
    "takes memory that no limit counts": """
import mmap
try:
    shared = mmap.mmap(-1, 8 << 30)
    leak("shared memory")
except (OSError, ValueError):
    pass
if C.memfd_create(b"mine", 0) >= 0 or C.shmget(0, 1 << 20, 0o1600) >= 0:
    leak("memory of the kernel")
""",
    "puts code into the cache of shaders": """
for file in Path(os.environ["MESA_SHADER_CACHE_DIR"]).rglob("*"):
    target = os.path.realpath(file)
    if not target.startswith(os.environ["TMPDIR"]) and C.open(target.encode(), 2) >= 0:
        leak(target)
""",
    "says that nothing contains it": sent(
        {"uncontained": "no system", "no_opengl": "none", "blobs": []}
    ),
    "looks for all other processes": """
for entry in range(1, os.getpid() + 100):
    for name in ("environ", "mem", "maps", "cmdline", "stat", "task", "fd", "root/etc", "exe"):
        if entry != os.getpid() and C.open(f"/proc/{entry}/{name}".encode(), 0) >= 0:
            leak(name)
    if entry != os.getpid() and C.readlink(f"/proc/{entry}/cwd".encode(), bytes(99), 99) > 0:
        leak("cwd")
if C.opendir(b"/proc"):
    leak("the list of processes")
""",
    "writes on the grader's terminal": """
for path in ("/dev/tty", "/dev/console", "/dev/ptmx", *(f"/dev/pts/{k}" for k in range(10))):
    if C.open(path.encode(), 1) >= 0:
        leak(path)
print("\\x1b[2J6 of 6", file=sys.stderr)
""",
    "opens its files once more, with other rights": """
import stat
for file in range(3, 64):
    try:
        kind, again = os.fstat(file), C.open(f"/proc/self/fd/{file}".encode(), 2)
    except OSError:
        continue
    if stat.S_ISDIR(kind.st_mode) or stat.S_ISREG(kind.st_mode) and kind.st_nlink:
        leak("a file with a name")
    if again >= 0 and stat.S_ISFIFO(kind.st_mode):
        C.fcntl(again, 4, 2048)
        if C.read(again, ctypes.create_string_buffer(99), 99) > 0:
            leak("the answer of another")
""",
    "uses the calls of 32 bits": """
import mmap
code = mmap.mmap(-1, 4096, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS | 0x40, prot=7)
begin = ctypes.addressof(ctypes.c_char.from_buffer(code))
path = bytes(HOME / "precious.txt") + b"\\0"
code[256 : 256 + len(path)] = path
if os.uname().machine == "x86_64":  # mov eax, 5; mov ebx, path; xor ecx, ecx; int 0x80; ret
    instructions = b"\\xb8\\x05\\0\\0\\0\\xbb" + (begin + 256).to_bytes(4, "little")
    code[: len(instructions) + 5] = instructions + b"\\x31\\xc9\\xcd\\x80\\xc3"
    if ctypes.CFUNCTYPE(ctypes.c_int)(begin)() >= 0:
        leak("open of 32 bits")
""",
    DEFECT: sent({"trouble": "Traceback", "blobs": []}),
}


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A home with a file that must stay as it is, and with the work of two students."""
    place = tmp_path_factory.mktemp("home")
    (place / "precious.txt").write_text(SECRET)
    (place / "work").mkdir()
    (place / "work" / "other.py").write_text(SOLUTION + f"\n# {SECRET}\n")
    return place


@pytest.fixture(scope="module")
def port() -> Iterator[int]:
    """The port of a server."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        yield server.getsockname()[1]


@pytest.fixture(scope="module")
def grader(home: Path) -> Iterator[Grader]:
    """A grader whose programs must be contained; it has graded one."""
    with pytest.MonkeyPatch.context() as patch, Grader(SECONDS, REQUIRE) as made:
        patch.setenv("HOME", str(home))
        patch.setenv("API_TOKEN", "hidden")
        patch.chdir(home)
        assert made.check(home / "work" / "other.py").passed
        yield made


def attack(grader: Grader, home: Path, port: int, code: str) -> Report:
    """Check a correct program that attacks first."""
    names = {
        **{"home": str(home), "other": str(home / "work" / "other.py"), "port": port},
        **{"course": str(FOLDER.parent), "grader": os.getpid()},
    }
    path = home / "work" / "mine.py"
    first = "import sys\n"
    assert SOLUTION.count(first) == 1
    head = HEAD.format(**names) + code
    path.write_text(SOLUTION.replace(first, first + head), encoding="utf-8")
    try:
        return grader.check(path)
    finally:
        path.unlink()


def files(home: Path) -> dict[str, tuple[int, int, int, bytes]]:
    return {
        str(each): (stat.st_mode, stat.st_uid, stat.st_mtime_ns, each.read_bytes())
        for each in home.rglob("*")
        if each.is_file() or not each.is_dir()
        for stat in [each.lstat()]
    }


def processes(home: Path) -> set[int]:
    """Return the processes that work in the home, as programs that are checked do."""
    found = set()
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            if (entry / "cwd").resolve() == home and " Z " not in (entry / "stat").read_text():
                found.add(int(entry.name))
        except OSError:
            pass
    return found


def assert_nothing_runs_but(grader: Grader, running: set[int], home: Path) -> None:
    """Only the process that waits remains; the one that answered may be about to end."""
    last = time.monotonic() + SECONDS
    while processes(home) - running > {getattr(grader._sandbox._server, "pid", 0)}:
        assert time.monotonic() < last, processes(home) - running
        time.sleep(0.02)


@pytest.mark.parametrize("name", ATTACKS)
@pytest.mark.sweep(3)
def test_an_attack_reaches_nothing(
    name: str, grader: Grader, home: Path, port: int, todays: Todays
) -> None:
    before, running = files(home), processes(home)
    try:
        report = attack(grader, home, port, ATTACKS[name])
        assert "LEAK" not in str(report.error) and report.contained == LANDLOCK
    except UnexpectedError:
        assert name == DEFECT
    assert files(home) == before
    assert_nothing_runs_but(grader, running, home)
    # What an attack has spoilt for the next program would show in the next attack, too.
    if name == DEFECT or name in todays(list(ATTACKS), 4):
        after = grader.check(home / "work" / "other.py")
        assert after.passed and after.contained == LANDLOCK
    assert not list(grader._sandbox._place.folder.glob("[0-9]*"))  # type: ignore[union-attr]


STOPS = """
import signal
for number in set(range(1, 65)) - {9, 19, 32, 33}:
    signal.signal(number, signal.SIG_IGN)
C.kill(os.getpid(), 19)
wait()
"""


@pytest.mark.seldom(2)
def test_a_program_that_stops_itself_and_is_deaf_to_all_signals_is_ended(
    grader: Grader, home: Path, port: int
) -> None:
    running = processes(home)
    with Grader(2.0, REQUIRE) as other:
        report = attack(other, home, port, STOPS)
        assert report.error is not None and report.error["word"] == "late"
        assert_nothing_runs_but(other, running, home)


HOLDS = """
import mmap
C.mmap.argtypes = [ctypes.c_void_p, ctypes.c_size_t, *[ctypes.c_int] * 3, ctypes.c_long]
for k in range(6):
    path = os.environ["TMPDIR"] + f"/{k}"
    file = os.open(path, os.O_RDWR | os.O_CREAT)
    os.truncate(file, 60 << 20)
    os.unlink(path)
    if MAPPED:
        C.mmap(None, 4096, mmap.PROT_READ, mmap.MAP_SHARED, file, 0)
        os.close(file)
wait()
"""


@pytest.mark.parametrize("mapped", [False, True])
def test_deleted_files_that_a_program_holds_count(
    mapped: bool, grader: Grader, home: Path, port: int
) -> None:
    report = attack(grader, home, port, f"MAPPED = {mapped}\n{HOLDS}")
    assert report.error is not None and report.error["word"] == "full"


# Machine code: it starts threads that wait, as fast as the kernel can.
STORM = """
import mmap
memory = mmap.mmap(-1, 4096, prot=7)
memory.write(bytes.fromhex(
    "b838000000bf000f010031f631d24d31d24d31c00f0585c075e6b8220000000f05ebf7"
))
ctypes.CFUNCTYPE(None)(ctypes.addressof(ctypes.c_char.from_buffer(memory)))()
"""


@pytest.mark.skipif(os.uname().machine != "x86_64", reason="the code is of another processor")
@pytest.mark.seldom(3, first=2)
def test_threads_are_counted_often(
    grader: Grader, home: Path, port: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    # For the process that runs programs: what only the files are looked at for takes minutes.
    place = home / "start"
    place.mkdir(exist_ok=True)
    code = """
import sys
if any("sandbox_forks" in word for word in sys.orig_argv):
    from landscape.course.grader import sandbox
    sandbox.LOOK = 1000.0
"""
    (place / "sitecustomize.py").write_text(code)
    monkeypatch.setenv("PYTHONPATH", f"{place}{os.pathsep}{os.environ.get('PYTHONPATH', '')}")
    with Grader(SECONDS, REQUIRE) as other:
        report = attack(other, home, port, STORM)
    assert report.error is not None and report.error["word"] == "much"


@pytest.mark.parametrize("what", ["threads", "memory"])
def test_a_program_with_too_many_threads_or_too_much_shared_memory_is_ended(
    what: str, grader: Grader, home: Path, port: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    code = """
import mmap, threading
if WHAT == "threads":
    threading.stack_size(65536)
    for _ in range(600):
        threading.Thread(target=C.sleep, args=(600,), daemon=True).start()
else:
    shared = mmap.mmap(-1, 400 << 20)
    for place in range(0, 400 << 20, 4096):
        shared[place] = 1
wait()
"""
    if what == "memory":  # what the system counts would end it sooner with OSMesa
        monkeypatch.setattr(Job, "__init__", partialmethod(Job.__init__, megabytes=200))
    report = attack(grader, home, port, f"WHAT = {what!r}\n{code}")
    assert report.error is not None and report.error["word"] == "much"


@pytest.mark.seldom(5, first=1)
def test_the_process_of_which_programs_are_copies_has_nothing_of_those_before(
    grader: Grader, home: Path
) -> None:
    path = home / "work" / "the_one_of_ada.py"
    path.write_text(SOLUTION)
    assert grader.check(path).passed
    path.unlink()
    assert grader._sandbox._server is not None
    place = Path("/proc", str(grader._sandbox._server.pid))
    found = b""
    with open(place / "mem", "rb", buffering=0) as memory:
        for line in (place / "maps").read_text().splitlines():
            begin, end = (int(word, 16) for word in line.split()[0].split("-"))
            if "rw" in line.split()[1]:
                memory.seek(begin)
                found += memory.read(end - begin)
    assert b"landscape-check" in found and b"the_one_of_ada" not in found


def test_what_a_program_sent_last_is_read_after_its_end() -> None:
    pipe, answers = os.pipe()
    pid = os.fork()
    if pid == 0:
        os.setsid()
        os.write(answers, b"whole")
        os._exit(0)
    os.close(answers)
    os.waitid(os.P_PID, pid, os.WEXITED | os.WNOWAIT)
    running = sandbox_forks._Running(pid, pipe, tempfile.TemporaryFile(), Path(), 1, 0)  # noqa: SIM115
    running.end(late=False)
    assert (bytes(running.data), running.reason) == (b"whole", "")


@pytest.mark.seldom(3, first=2)
def test_where_landlock_does_not_see_truncate_the_filter_refuses_it(tmp_path: Path) -> None:
    path = tmp_path / "kept"
    path.write_text("kept")
    code = """
import os, sys
from framelens.system import containment, landlock
if sys.argv[2] == "old":
    landlock.version = lambda: 2
containment.confine(["/"], [], [sys.argv[1]] if sys.argv[2] == "new" else [])
try:
    os.truncate(sys.argv[1], 0)
except PermissionError:
    print("refused")
"""
    for version, said in (("old", "refused\n"), ("new", "")):
        done = python(code, str(path), version)
        assert (done.status, done.out, done.err) == (0, said, "")
        assert (path.read_text() == "kept") == (version == "old")


@pytest.mark.parametrize(
    "error",
    [
        {"word": "died", "signal": "x", "line": "x"},
        {"word": "died", "signal": "x", "line": -1},
        {"word": "died", "signal": "x", "line": 10**30},
        {"word": "died", "signal": "x", "line": float("inf")},
        {"word": "died", "signal": ["x"]},
        {"word": "died", "signal": "x", "line": True},
        ["died"],
    ],
)
def test_an_error_that_a_program_has_made_up_is_none(error: object) -> None:
    assert known({"word": "died", "signal": "x", "line": 1})
    assert not known(error)


@pytest.mark.seldom(3, first=1)
def test_without_the_system_python_says_that_it_contains_the_program(home: Path) -> None:
    with Grader(SECONDS, NONE) as grader:
        assert grader.check(home / "work" / "other.py").contained == PYTHON


@pytest.mark.parametrize("forks", [True, False])
@pytest.mark.sweep(4)
def test_where_the_system_cannot_contain_programs_require_refuses(
    forks: bool, home: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(limits, "FORKS", forks)
    # For the process that runs programs: a module that Python imports at its start.
    place = home / "start"
    place.mkdir(exist_ok=True)
    code = "from framelens.system import containment\ncontainment.possible = lambda: False\n"
    (place / "sitecustomize.py").write_text(code)
    monkeypatch.setenv("PYTHONPATH", f"{place}{os.pathsep}{os.environ.get('PYTHONPATH', '')}")
    with Grader(SECONDS, REQUIRE) as grader, pytest.raises(InputError, match="--contain require"):
        grader.check(home / "work" / "other.py")


def test_a_folder_that_is_deeper_than_any_path_is_deleted(tmp_path: Path) -> None:
    place = tmp_path / "deep"
    place.mkdir()
    here = os.open(place, os.O_RDONLY)
    for _ in range(300):
        os.mkdir("a folder of this depth", dir_fd=here)
        inner = os.open("a folder of this depth", os.O_RDONLY, dir_fd=here)
        os.close(here)
        here = inner
    os.close(os.open("file", os.O_CREAT | os.O_WRONLY, dir_fd=here))
    os.close(here)
    (place / "closed").mkdir(mode=0)
    os.mkfifo(place / "pipe")
    workplace.delete(place)
    assert not place.exists()


def test_what_a_killed_grader_left_is_deleted_by_the_next(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    first = workplace.Workplace()
    killed = tmp_path / f"{workplace.PREFIX}killed"
    (killed / "1").mkdir(parents=True)
    (killed / workplace.LOCK).touch()
    other = tmp_path / "landscape-other"
    other.mkdir()
    second = workplace.Workplace()
    assert not killed.exists() and other.exists()
    assert first.folder.exists(), "one that still grades keeps its folder"
    for each in (first, second):
        each.close()
        assert not each.folder.exists()


PYTHONS = {
    "replaces": "h, n = tempfile.mkstemp()\nos.replace(n, HOME + '/new')",
    "moves": "h, n = tempfile.mkstemp()\nimport shutil\nshutil.move(n, HOME + '/new')",
    "links": "h, n = tempfile.mkstemp()\nos.link(n, HOME + '/new')",
    "links softly": "os.symlink('/', HOME + '/new')",
    "takes a file": "os.rename(HOME + '/precious.txt', tempfile.gettempdir() + '/mine')",
    "makes a pipe": "os.mkfifo(HOME + '/new')",
    "makes a file": "os.mknod(HOME + '/new')",
    "deletes in an open folder": "os.unlink('precious.txt', dir_fd=os.open(HOME, os.O_RDONLY))",
    "writes in an open folder": (
        "os.open('precious.txt', os.O_TRUNC | os.O_WRONLY, dir_fd=os.open(HOME, os.O_RDONLY))"
    ),
    "closes an open folder": "os.chmod(os.open(HOME, os.O_RDONLY), 0)",
    "writes a history": "import readline\nreadline.write_history_file(HOME + '/precious.txt')",
    "starts": (
        "import multiprocessing\nmultiprocessing.get_context('spawn').Process(target=print).start()"
    ),
    "ends": "import signal\nsignal.pidfd_send_signal(os.pidfd_open(os.getppid()), 9)",
    "imports the solution": (
        "import importlib\nimportlib.import_module('landscape.course.exercises.winding.solution')"
    ),
    "reads the solution": (
        "open(os.path.dirname(os.environ['TMPDIR']) + '/kept/winding-solution.py').read()"
    ),
}
WORDS = {"starts": "start", "ends": "start"}
WORDS |= {"imports the solution": "read", "reads the solution": "read"}


@pytest.fixture(scope="module")
def python_grader() -> Iterator[Grader]:
    """A grader whose programs are refused what Python refuses, and no more."""
    with Grader(SECONDS, NONE) as made:
        yield made


@pytest.mark.parametrize("name", PYTHONS)
def test_python_refuses_it_by_itself(name: str, python_grader: Grader, home: Path) -> None:
    before = files(home)
    path = home / "work" / "mine.py"
    head = f"# exercise: winding\nimport os, tempfile\nimport glfw\nHOME = {str(home)!r}\n"
    path.write_text(head + PYTHONS[name] + "\n")
    error = python_grader.check(path).error
    path.unlink()
    assert error is not None and error["word"] == WORDS.get(name, "write"), error
    assert files(home) == before


@pytest.mark.seldom(10, first=2)
def test_temporary_files_are_allowed_to_every_program(grader: Grader, home: Path) -> None:
    code = """
import tempfile
for kind in (tempfile.NamedTemporaryFile, tempfile.TemporaryFile, tempfile.SpooledTemporaryFile):
    with kind() as file:
        file.write(b"x")
with tempfile.TemporaryDirectory() as folder:
    (Path(folder) / "one").write_text("x")
    os.rename(folder + "/one", folder + "/two")
"""
    for each in (grader, Grader(SECONDS, NONE)):
        report = attack(each, home, 0, code)
        assert report.passed, report.error
        if each is not grader:
            each._sandbox.close()


@pytest.mark.seldom(3, first=1)
def test_what_outlives_a_program_is_ended(home: Path, python_grader: Grader) -> None:
    code = """
if C.fork() == 0:
    C.setsid()
    C.fork()
    wait()
"""
    before = processes(home)
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(home)
        assert attack(python_grader, home, 0, code).passed
    assert_nothing_runs_but(python_grader, before, home)


def forged(**changes: Any) -> stream.Answer:
    answer = {
        **{"states": [{}], "lists": [], "pointers": [], "sites": [["glEnd", 1, "f", True, 0]]},
        **{"numbers": {"of": 0, "values": 0}, "setup": [0], "frames": {}},
    }
    return answer | changes, [memoryview(b"")]


@pytest.mark.seldom(3)
def test_lists_that_double_again_and_again_are_no_evidence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(evidence_file, "MOST_CALLS", 100_000)
    monkeypatch.setattr(evidence_file, "MOST_OBJECTS", 20_000)
    lists = [[0, [0, []]]] + [[0, [0, [], {"inside": [n, n]}]] for n in range(60)]
    answer = forged(lists=lists, setup=[0, [0, [], {"inside": [60]}]])
    tracemalloc.start()
    try:
        with pytest.raises(ValueError, match="more calls"):
            evidence_file.load(tmp_path, answer, [])
        assert tracemalloc.get_traced_memory()[1] < 15 << 20
    finally:
        tracemalloc.stop()


def test_calls_that_are_made_again_and_again_are_not_read(tmp_path: Path) -> None:
    take = {"size": [9, 9], "frames": [0], "events": [], "presses": {}, "made": [0] * 300}
    blob = bytes(4 << 20)
    answer = {"source": "", "calls": [["glFlush"]], "takes": [take]}
    assert recorded.parsed(b"".join(stream.parts(answer, [blob]))) is None
    take["made"] = [0]
    assert recorded.parsed(b"".join(stream.parts(answer, [blob]))) is not None
    # Bytes that many calls have are there once.
    answer["calls"] = [["glBufferData", {"bytes": 0}]] * 1000
    tracemalloc.start()
    try:
        assert recorded.parsed(b"".join(stream.parts(answer, [blob]))) is not None
        assert tracemalloc.get_traced_memory()[1] < 100 << 20
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("part", [b'{"a":0},', b"[],", b"0,"])
def test_small_bytes_that_become_large_objects_are_not_read(
    part: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(stream, "MOST_READ", 1 << 20)
    for count in (1, 1 << 16):
        text = b'{"blobs":[],"x":[' + part * count + b"0]}"
        tracemalloc.start()
        try:
            found = stream.received(stream.LENGTH.pack(len(text)) + text)
            assert tracemalloc.get_traced_memory()[1] < 3 << 20
        finally:
            tracemalloc.stop()
        assert (found is None) == (count > 1)


def test_a_picture_of_one_line_of_millions_of_pixels_is_not_compared(
    grader: Grader, home: Path, port: int
) -> None:
    code = """
import numpy
witness = sys.modules["landscape.course.grader.witness"]
witness.read_pixels = lambda size: numpy.zeros((1, 5000, 3), numpy.uint8)
def evidence(self, of=witness.Witness.evidence):
    self._again = None
    found = of(self)
    for frame in found["frames"].values():
        frame["size"] = [5000, 1]
    return found
witness.Witness.evidence = evidence
"""
    report = attack(grader, home, port, code)
    assert report.error is not None and report.error["word"] == "full"


def test_many_states_beside_a_large_one_take_no_more_memory_than_were_sent(tmp_path: Path) -> None:
    large = {f"GL_{number}": number for number in range(100_000)}
    tracemalloc.start()
    try:
        reader = evidence_file._Reader(*forged(states=[large, *({} for _ in range(1000))]))
        assert tracemalloc.get_traced_memory()[1] < 10 << 20
    finally:
        tracemalloc.stop()
    assert reader._states[1000]["GL_99"] == 99


def test_a_program_that_resizes_its_window_is_not_said_to_forge(
    grader: Grader, home: Path, port: int
) -> None:
    code = """
import glfw
def shown(window, show=glfw.swap_buffers):
    show(window)
    glfw.set_window_size(window, 320, 240)
glfw.swap_buffers = shown
"""
    report = attack(grader, home, port, code)
    assert report.error is None and report.results


def test_what_python_warns_of_in_a_program_is_not_told(tmp_path: Path) -> None:
    path = tmp_path / "mine.py"
    path.write_text('x = "\\d"\n')
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert _syntax(path) is None


@pytest.mark.seldom(3)
def test_a_class_is_graded_to_its_end_whatever_one_program_does(
    home: Path, port: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LANDSCAPE_CACHE", str(tmp_path / "cache"))
    head = HEAD.format(home="", other="", course="", grader=0, port=port)
    bad = SOLUTION.replace("import sys\n", f"import sys\n{head}{ATTACKS[DEFECT]}", 1)
    odd = f"# coding: rot13\n{SOLUTION}"  # a codec, but of no text
    slow = f"# coding: punycode\n{SOLUTION}{'a' * 400_000}-{'a' * 400_000}"
    found = [
        Submission(name, file=f"{name}.py", data=code.encode())
        for name, code in (("bad", bad), ("odd", odd), ("slow", slow), ("good", SOLUTION))
    ]
    rows = [each.row for each in grade_class(found, Rules(contain=REQUIRE), jobs=1)]
    passed = [(row.student, row.passed) for row in rows]
    assert passed == [("bad", False), ("odd", False), ("slow", False), ("good", True)]
    assert rows[0].error and rows[3].contained == LANDLOCK
    assert rows[1].error == rows[2].error == "is not text, expected a Python program"


def test_a_class_is_graded_to_its_end_whatever_is_wrong_in_the_grader(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LANDSCAPE_CACHE", str(tmp_path / "cache"))

    def check(*_: object) -> Report:
        raise ValueError("of a\nprogram")

    monkeypatch.setattr(Grader, "check", check)
    found = [Submission(name, file=f"{name}.py", data=name.encode()) for name in ("a", "b")]
    rows = [each.row for each in grade_class(found, Rules(), jobs=1)]
    assert [row.error for row in rows] == ["ValueError: of a program"] * 2
