"""What the systems do differently: each form does what the others do."""

import ctypes
import mmap
import os
import signal
import threading
import time
from collections.abc import Iterator
from multiprocessing.connection import Listener
from pathlib import Path

import pytest

from framelens import system
from framelens.base import input as module
from framelens.base.errors import InputError
from framelens.base.input import read_bounded
from framelens.base.output import write_whole


@pytest.fixture
def heeds_ctrl_c() -> Iterator[None]:
    """Let Ctrl-C interrupt the test, as it does not where the shell has started pytest with `&`."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("heeds_ctrl_c")
def test_ctrl_c_that_is_held_back_comes_after_the_block() -> None:
    steps = []
    with pytest.raises(KeyboardInterrupt):
        with system.interrupts_held():
            signal.raise_signal(signal.SIGINT)
            steps.append("done")
        steps.append("not done")
    assert steps == ["done"]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


@pytest.mark.usefixtures("heeds_ctrl_c")
def test_a_block_without_ctrl_c_ends_as_any_other() -> None:
    with system.interrupts_held(), system.starting_workers():
        pass
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)


def test_the_machine_has_processors_and_memory() -> None:
    assert 1 <= system.processors() <= (os.cpu_count() or 1)
    memory = system.memory()
    assert memory is None or memory > 1 << 28


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="nothing says what is resident")
def test_memory_that_was_freed_goes_back_to_the_system() -> None:
    def resident() -> int:
        return int(Path("/proc/self/statm").read_text().split()[1]) * mmap.PAGESIZE

    libc = ctypes.CDLL(None)
    if not hasattr(libc, "malloc_trim"):
        pytest.skip("not glibc")
    libc.malloc.restype = ctypes.c_void_p
    libc.memset.argtypes = ctypes.c_void_p, ctypes.c_int, ctypes.c_size_t
    libc.free.argtypes = (ctypes.c_void_p,)
    pieces = [libc.malloc(100_000) for _ in range(400)]
    for piece in pieces:
        libc.memset(piece, 1, 100_000)
    for piece in pieces[:-1]:  # the last one holds the end of the heap
        libc.free(piece)
    before = resident()
    system.give_back()
    assert before - resident() > 30_000_000
    libc.free(pieces[-1])


def test_the_null_device_is_an_empty_file() -> None:
    assert read_bounded(Path(os.devnull), 100) == b""


@pytest.mark.windows_only
def test_a_pipe_of_windows_is_not_waited_for_long(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "WAIT_S", 0.05)
    with Listener(family="AF_PIPE") as listener:
        with pytest.raises(InputError, match=r"expected all of it within 0\.05 seconds"):
            read_bounded(Path(str(listener.address)), 100)


@pytest.mark.windows_only
def test_a_file_that_somebody_reads_is_replaced_once_it_is_closed(tmp_path: Path) -> None:
    path = tmp_path / "a.bin"
    path.write_bytes(b"old")
    reader = path.open("rb")

    def close_soon() -> None:
        time.sleep(0.2)
        reader.close()

    closer = threading.Thread(target=close_soon)
    closer.start()
    write_whole(path, b"new")
    closer.join()
    assert path.read_bytes() == b"new"


@pytest.mark.windows_only
def test_a_file_that_somebody_keeps_open_is_named_and_kept(tmp_path: Path) -> None:
    path = tmp_path / "a.bin"
    path.write_bytes(b"old")
    with path.open("rb"), pytest.raises(InputError, match=r"a\.bin: cannot be written \("):
        write_whole(path, b"new")
    assert path.read_bytes() == b"old" and list(tmp_path.iterdir()) == [path]
