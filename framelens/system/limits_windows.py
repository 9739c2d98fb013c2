"""Limits on Windows: a job object of its own for the process that sets them."""

import contextlib
import ctypes
import math
import os
import signal
import subprocess
import sys
from collections.abc import Collection
from functools import cache
from typing import Any

from framelens.system.beside import beside

assert sys.platform == "win32"

# The job object limits memory, but not in each form of Windows: Wine accepts the limit without it.
KEEPS_MEMORY = False
OUT_OF_TIME = "out of processor time"  # what ends a process that has used up its processor time
KILLED = "out of memory"  # what ends a process where the system runs out of memory
KNOWS_THREAD_TIME = False  # whether thread_time() knows more than that
GAVE_UP: str | None = None  # abort() ends a process as some crashes do
# For Popen: Ctrl-C does not reach the process.
OWN_GROUP: dict[str, Any] = {"creationflags": subprocess.CREATE_NEW_PROCESS_GROUP}
# Exit statuses of processes that did not end by themselves; most are NTSTATUS values.
CRASHES = {
    3: "abort",
    0xC0000005: "access violation",
    0xC0000017: KILLED,
    0xC000001D: "illegal instruction",
    0xC0000044: OUT_OF_TIME,
    0xC0000094: "integer division by zero",
    0xC00000FD: "stack overflow",
    0xC0000374: "heap corruption",
    0xC0000409: "abort",
}
FIRST_ERROR = 0xC0000000  # NTSTATUS values from here on are errors
NO_DIALOGS = 0x0003  # SEM_FAILCRITICALERRORS and SEM_NOGPFAULTERRORBOX
# Flags and classes of the functions for job objects, from winnt.h.
PROCESS_TIME = 0x0002
PROCESS_MEMORY = 0x0100
KILL_ON_CLOSE = 0x2000
EXTENDED_LIMITS = 9
SYNCHRONIZE, INFINITE = 0x00100000, 0xFFFFFFFF


class _Limits(ctypes.Structure):
    """JOBOBJECT_EXTENDED_LIMIT_INFORMATION."""

    _fields_ = [
        ("process_time", ctypes.c_int64),  # in 100 ns
        ("job_time", ctypes.c_int64),
        ("flags", ctypes.c_uint32),
        ("least_working_set", ctypes.c_size_t),
        ("most_working_set", ctypes.c_size_t),
        ("processes", ctypes.c_uint32),
        ("affinity", ctypes.c_size_t),
        ("priority", ctypes.c_uint32),
        ("scheduling", ctypes.c_uint32),
        ("transfers", ctypes.c_uint64 * 6),
        ("process_memory", ctypes.c_size_t),  # bytes
        ("job_memory", ctypes.c_size_t),
        ("peak_process_memory", ctypes.c_size_t),
        ("peak_job_memory", ctypes.c_size_t),
    ]


class _Memory(ctypes.Structure):
    """PROCESS_MEMORY_COUNTERS; the last two are what Windows calls commit charge."""

    _fields_ = [
        ("size", ctypes.c_uint32),
        ("page_faults", ctypes.c_uint32),
        ("peak_working_set", ctypes.c_size_t),
        ("working_set", ctypes.c_size_t),
        ("peak_paged_pool", ctypes.c_size_t),
        ("paged_pool", ctypes.c_size_t),
        ("peak_other_pool", ctypes.c_size_t),
        ("other_pool", ctypes.c_size_t),
        ("committed", ctypes.c_size_t),
        ("peak_committed", ctypes.c_size_t),
    ]


@cache
def _kernel() -> ctypes.WinDLL:
    kernel = ctypes.WinDLL("kernel32")
    for name in ("CreateJobObjectW", "GetCurrentProcess", "OpenProcess"):
        getattr(kernel, name).restype = ctypes.c_void_p  # a handle, which has 64 bits
    return kernel


@cache
def _job() -> ctypes.c_void_p:
    """Return a job object that this process is in; its children end when it does."""
    kernel = _kernel()
    job = ctypes.c_void_p(kernel.CreateJobObjectW(None, None))
    _limits.flags |= KILL_ON_CLOSE
    kernel.AssignProcessToJobObject(job, ctypes.c_void_p(kernel.GetCurrentProcess()))
    return job


_limits = _Limits()


def _limit() -> None:
    job = _job()
    size = ctypes.sizeof(_limits)
    _kernel().SetInformationJobObject(job, EXTENDED_LIMITS, ctypes.byref(_limits), size)


def limit_work(seconds: int, file_bytes: int | None = None) -> None:
    """Limit the processor's seconds; a crash opens no dialog. Windows limits no size of files."""
    _kernel().SetErrorMode(NO_DIALOGS)
    _limits.flags |= PROCESS_TIME
    _limits.process_time = seconds * 10**7
    _limit()


def limit_memory(most: int | None) -> None:
    """Limit the bytes that ``used`` counts; None: no limit."""
    _limits.flags &= ~PROCESS_MEMORY
    if most is not None:
        _limits.flags |= PROCESS_MEMORY
        _limits.process_memory = most
    _limit()


def used() -> int:
    """Return the bytes of memory that the process has been promised."""
    kernel = _kernel()
    memory = _Memory(size=ctypes.sizeof(_Memory))
    process = ctypes.c_void_p(kernel.GetCurrentProcess())
    kernel.K32GetProcessMemoryInfo(process, ctypes.byref(memory), memory.size)
    return int(memory.committed)


def thread_time(process: int) -> float:
    """Return a number without end: how long a process's main thread has worked is not known."""
    return math.inf


def end_with(parent: int) -> None:
    """Let this process end when its parent, the process of that number, has ended."""
    leave = os._exit  # a program may be given another one
    process = ctypes.c_void_p(_kernel().OpenProcess(SYNCHRONIZE, False, parent))

    def wait() -> None:
        _kernel().WaitForSingleObject(process, INFINITE)
        leave(1)

    beside(wait)


def end_group(process: int) -> None:
    """End a process; if it has set limits, its own children end with it."""
    with contextlib.suppress(OSError):
        os.kill(process, signal.SIGTERM)


def crash(status: int) -> str:
    """Return what ended a process, in words; "" if it ended by itself."""
    if status in CRASHES:
        return CRASHES[status]
    return f"exception 0x{status:08X}" if status >= FIRST_ERROR else ""


def leave_network() -> None:
    """Do nothing: a process of Windows cannot leave the network by itself."""


def limit_open_files(most: int) -> None:
    """Do nothing: there is no such limit here."""


def limit_addresses(more: int) -> None:
    """Do nothing: there is no such limit here."""


def adopt_orphans() -> None:
    """Do nothing: a process of Windows has no children that it could be given."""


def children() -> set[int]:
    """Return no children: Windows ends those of a program with its group."""
    return set()


def end_orphans(own: Collection[int]) -> None:
    """Do nothing: Windows ends what a program has started with its group."""


def close_all_but(*files: int) -> None:
    """Do nothing: a process of Windows is given only files that it is to have."""
