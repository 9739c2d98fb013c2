"""A function in a process of its own: its result, what it raises, and how it is ended."""

import os
import signal
import sys
import time

import numpy as np
import pytest

from framelens.base.errors import InputError
from framelens.base.isolated import Ended, isolated

SECONDS = 60.0  # enough on a busy machine


def double(values: np.ndarray) -> np.ndarray:
    print("what a library prints")
    return 2 * values


def refuse() -> None:
    raise InputError("no such file")


def take(megabytes: int) -> int:
    return len(bytes(megabytes << 20))


def work() -> None:
    while True:
        pass


def leave() -> None:
    print("the last line", file=sys.stderr, flush=True)
    os._exit(3)


def test_a_result_comes_back_and_what_is_printed_does_not_disturb_it() -> None:
    values = np.arange(9.0).reshape(3, 3)
    assert np.array_equal(isolated(double, values, seconds=SECONDS), 2 * values)


def test_what_the_function_raises_is_raised() -> None:
    with pytest.raises(InputError, match="no such file"):
        isolated(refuse, seconds=SECONDS)


@pytest.mark.posix_only("Windows is asked by a thread, which comes late for one allocation")
@pytest.mark.skipif(sys.platform == "darwin", reason="macOS limits no memory")
def test_memory_is_limited() -> None:
    assert isolated(take, 100, seconds=SECONDS, megabytes=500) == 100 << 20
    with pytest.raises(MemoryError):
        isolated(take, 1000, seconds=SECONDS, megabytes=500)


def test_a_process_that_ends_tells_its_status_and_its_last_line() -> None:
    with pytest.raises(Ended) as told:
        isolated(leave, seconds=SECONDS)
    assert told.value.status == 3 and told.value.message == "the last line"


def test_a_late_process_is_ended() -> None:
    with pytest.raises(Ended) as told:
        isolated(time.sleep, 600, seconds=1.0)
    assert told.value.status is None


@pytest.mark.seldom(13, first=5)
@pytest.mark.posix_only("no signal ends a process there")
def test_the_seconds_of_the_processor_are_limited() -> None:
    with pytest.raises(Ended) as told:
        isolated(work, seconds=SECONDS, worked=1)
    assert told.value.status == -signal.SIGXCPU
