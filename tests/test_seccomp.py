"""The filter of system calls decides, on both kinds of processor, as the kernel would run it.

Some numbers stand here once more; all are compared with the kernel's headers, where they are.
"""

import errno
import re
import struct
import sys
from pathlib import Path

import pytest

from framelens.system import containment

if sys.platform != "linux":
    pytest.skip("only Linux has such filters", allow_module_level=True)

from framelens.system import seccomp

MACHINES = {"x86_64": 0xC000003E, "aarch64": 0xC00000B7}
ALLOW, KILL = 0x7FFF0000, 0x80000000
REFUSED, MISSING = 0x00050000 | errno.EPERM, 0x00050000 | errno.ENOSYS
THREAD = 0x3D0F00  # as pthread_create(3) asks clone(2)
ME = 4321


def run(code: bytes, machine: int, number: int, *given: int) -> int:
    """Run a filter as the kernel does; return what it answers."""
    data = struct.pack("=iIQ6Q", number, machine, 0, *given, *(0,) * (6 - len(given)))
    place = loaded = 0
    while True:
        kind, then, otherwise, value = struct.unpack_from("=HBBI", code, 8 * place)
        place += 1
        if kind == 0x06:
            return int(value)
        if kind == 0x20:
            (loaded,) = struct.unpack_from("=I", data, value)
        elif kind == 0x54:
            loaded &= value
        else:
            true = {0x15: loaded == value, 0x45: bool(loaded & value), 0x35: loaded >= value}
            place += then if true[kind] else otherwise


# The call, its numbers, its arguments, and the answer.
CASES = [
    ("read", (0, 63), (), ALLOW),
    ("openat", (257, 56), (), ALLOW),
    ("futex_waitv", (449, 449), (), ALLOW),
    ("what is newer", (450, 450), (), MISSING),
    ("the second set of x86_64", (0x40000000, 0x40000000), (), REFUSED),
    ("the same, and not", (0x3FFFFFFF, 0x3FFFFFFF), (), MISSING),
    ("execve", (59, 221), (), REFUSED),
    ("socket", (41, 198), (), REFUSED),
    ("ptrace", (101, 117), (), REFUSED),
    ("open_by_handle_at", (304, 265), (), REFUSED),
    ("setuid", (105, 146), (), REFUSED),
    ("capset", (126, 91), (), REFUSED),
    ("io_setup", (206, 0), (), REFUSED),
    ("landlock_restrict_self", (446, 446), (), REFUSED),
    ("clone3", (435, 435), (), MISSING),
    ("kill itself", (62, 129), (ME,), ALLOW),
    ("kill another", (62, 129), (ME + 1,), REFUSED),
    ("kill its group", (62, 129), (2**32 - ME,), REFUSED),
    ("tgkill itself", (234, 131), (ME,), ALLOW),
    ("tgkill another", (234, 131), (1,), REFUSED),
    ("clone of a thread", (56, 220), (THREAD,), ALLOW),
    ("clone of a process", (56, 220), (0x1200011,), REFUSED),
    *(
        (f"clone without {flag:x}", (56, 220), (THREAD - flag | signal,), REFUSED)
        for flag in (0x100, 0x200, 0x400, 0x800, 0x10000)
        for signal in (0, 1)
    ),
    *(
        (f"clone with {1 << bit:x}", (56, 220), (THREAD | 1 << bit,), REFUSED)
        for bit in (17, 25, 26, 27, 28, 29, 30)
    ),
    ("close_range", (436, 436), (3, 9, 4), ALLOW),
    ("close_range with what is not known", (436, 436), (3, 9, 1), ALLOW),
    ("close_range of its own", (436, 436), (3, 9, 6), REFUSED),
    ("a name for a thread", (157, 167), (15,), ALLOW),
    *((f"prctl {what:x}", (157, 167), (what,), REFUSED) for what in (1, 4, 35, 36, 0x59616D61)),
    ("the flags of a file", (72, 25), (0, 3), ALLOW),
    *((f"fcntl {what}", (72, 25), (0, what), REFUSED) for what in (8, 10, 15, 1024, 1026, 1031)),
    ("madvise", (28, 233), (0, 0, 4), ALLOW),
    ("madvise that poisons", (28, 233), (0, 0, 100), REFUSED),
    ("madvise that takes away", (28, 233), (0, 0, 101), REFUSED),
    *(
        (f"ioctl {what:x}", (16, 29), (0, what), ALLOW)
        for what in (0x5401, 0x540F, 0x5413, 0x541B, 0x5421, 0x5450, 0x5451)
    ),
    # Of graphics cards: Direct Rendering, NVIDIA (two), AMD, buffers, fences.
    *(
        (f"ioctl {what:x}", (16, 29), (0, what), ALLOW)
        for what in (0xC0406400, 0xC02046D2, 0x30000001, 0xC0384B02, 0x40086200, 0xC0303E03)
    ),
    # Into a terminal; a file's attributes; a file system frozen, shut down, grown; copies; sockets.
    *(
        (f"ioctl {what:x}", (16, 29), (0, what), REFUSED)
        for what in (0x5412, 0x541C, 0x40086602, 0x401C5820, 0xC0045877, 0x8004587D)
    ),
    *(
        (f"ioctl {what:x}", (16, 29), (0, what), REFUSED)
        for what in (0x40086610, 0x40049409, 0x8901, 0x8902, 0x5402)
    ),
    ("prlimit that asks", (302, 261), (0, 9, 0), ALLOW),
    ("prlimit that sets", (302, 261), (0, 9, 1), REFUSED),
    ("prlimit that sets, far up", (302, 261), (0, 9, 1 << 32), REFUSED),
]


@pytest.mark.parametrize("machine", MACHINES)
def test_the_filter_answers_as_its_tables_say(
    machine: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(seccomp.platform, "machine", lambda: machine)
    column = list(MACHINES).index(machine)
    for truncates in (True, False):
        code = seccomp._program(ME, truncates)
        for name, numbers, given, answer in CASES:
            assert run(code, MACHINES[machine], numbers[column], *given) == answer, name
        truncate = run(code, MACHINES[machine], (76, 45)[column])
        assert truncate == (ALLOW if truncates else REFUSED)
        for other in ({*MACHINES.values()} - {MACHINES[machine]}) | {0x40000003}:
            assert run(code, other, 39) == KILL


# Where Linux has its numbers for C, and how a name looks there.
HEADERS = (
    (Path("/usr/include/x86_64-linux-gnu/asm/unistd_64.h"), r"#define __NR_(\w+)\s+(\d+)"),
    (Path("/usr/include/asm-generic/unistd.h"), r"#define __NR(?:3264)?_(\w+)\s+(\d+)"),
)


@pytest.mark.parametrize("column", range(2))
def test_the_numbers_are_those_of_the_kernels_headers(column: int) -> None:
    header, pattern = HEADERS[column]
    if not header.is_file():
        pytest.skip(f"{header} is not installed (linux-libc-dev)")
    known = {name: int(number) for name, number in re.findall(pattern, header.read_text())}
    tables = [*seccomp.REFUSED.values(), seccomp.NOT_THERE, seccomp.SIGNALS, seccomp.TRUNCATE]
    for table in tables:
        for name, numbers in table.items():
            if name in known or numbers[column] is not None:
                assert known[name] == numbers[column], name


def test_every_call_of_the_tables_is_refused_and_no_number_stands_there_twice() -> None:
    for column in range(2):
        tables = [*seccomp.REFUSED.values(), seccomp.NOT_THERE, seccomp.SIGNALS]
        numbers = [both[column] for table in tables for both in table.values()]
        numbers = [number for number in numbers if number is not None]
        assert len(numbers) == len(set(numbers))
        assert max(numbers) <= seccomp.NEWEST


def test_a_machine_that_the_tables_do_not_know_contains_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(seccomp.platform, "machine", lambda: "riscv64")
    assert not seccomp.known_machine() and not containment.possible()
