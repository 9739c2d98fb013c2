"""Work side by side: results in order, few at a time; and how workers end."""

import multiprocessing
import os
import signal
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from multiprocessing.process import BaseProcess

import pytest
from commands import SECONDS
from executors import Backwards

from framelens.base.executor import Here, Kept, WorkerKilled, ahead, executor, in_order
from framelens.system.processes import ONE_CORE


def square(number: int) -> int:
    return number * number


def process(_: int) -> int:
    time.sleep(0.02)  # so that the others take some, too
    return os.getpid()


def environment(name: str) -> str | None:
    return os.environ.get(name)


def sleep(seconds: float) -> None:
    time.sleep(seconds)


def end(how: int) -> None:
    os.kill(os.getpid(), how)


def large(_: int) -> bytes:
    return bytes(20 << 20)


def refuse(number: int) -> int:
    if number == 3:
        raise ValueError("three")
    return number


@pytest.mark.parametrize("jobs", [1, 2])
@pytest.mark.sweep(4)
def test_results_come_in_order_and_a_result_depends_on_no_process(jobs: int) -> None:
    with executor(jobs) as workers:
        assert list(in_order(workers, square, range(50), ahead(jobs))) == [
            number * number for number in range(50)
        ]
        assert len(set(in_order(workers, process, range(8), ahead(jobs)))) == jobs
    assert not multiprocessing.active_children()


def test_any_executor_will_do() -> None:
    backwards = Backwards()
    assert list(in_order(backwards, square, range(5), 3)) == [0, 1, 4, 9, 16]
    assert backwards.order == [2, 1, 0, 4, 3]
    with ThreadPoolExecutor(2) as threads:
        assert list(in_order(threads, square, range(5), 3)) == [0, 1, 4, 9, 16]


def test_no_more_results_than_asked_for_exist_at_a_time() -> None:
    begun: list[int] = []
    results = in_order(Here(), begun.append, range(10), 3)
    next(results)
    assert begun == [0, 1, 2]
    next(results)
    assert begun == [0, 1, 2, 3]


def test_what_has_not_begun_is_cancelled_when_a_result_raises() -> None:
    backwards = Backwards()
    with pytest.raises(ValueError, match="three"):
        list(in_order(backwards, refuse, iter(range(100)), 4))
    backwards.work()
    assert len(backwards.order) == 4


@pytest.mark.seldom(5, first=2)
def test_each_process_works_on_one_core(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ONE_CORE:
        monkeypatch.delenv(name, raising=False)
    with executor(2) as workers:
        found = dict(zip(ONE_CORE, in_order(workers, environment, ONE_CORE, 9), strict=True))
    assert found == ONE_CORE
    assert not set(ONE_CORE) & set(os.environ)


@pytest.mark.posix_only("no signal ends a process there")
def test_a_killed_process_ends_in_one_line() -> None:
    before = set(multiprocessing.active_children())  # of other tests in this process
    with pytest.raises(WorkerKilled, match="was killed"), executor(2) as workers:
        list(in_order(workers, end, [signal.SIGKILL], 1))
    _wait_for_the_end_of_all_but(before)


@pytest.mark.seldom(3)
def test_an_exception_ends_the_processes_at_once() -> None:
    before = set(multiprocessing.active_children())  # of other tests in this process
    with pytest.raises(KeyboardInterrupt), executor(2) as workers:
        with closing(in_order(workers, sleep, [0.0, 999.0, 999.0, 999.0], 4)) as results:
            next(results)
            raise KeyboardInterrupt
    _wait_for_the_end_of_all_but(before)


@pytest.mark.seldom(13, first=1)
def test_a_process_that_sends_a_large_result_ends_as_well() -> None:
    for _ in range(3):
        with pytest.raises(KeyboardInterrupt), executor(2) as workers:
            with closing(in_order(workers, large, range(99), 8)) as results:
                next(results)
                raise KeyboardInterrupt
    assert not multiprocessing.active_children()


class Thing:
    opened: list["Thing"] = []

    def __init__(self) -> None:
        self.closed = False
        self.opened.append(self)

    def close(self) -> None:
        self.closed = True


@pytest.fixture
def kept() -> Iterator[Kept[Thing]]:
    Thing.opened.clear()
    yield Kept()


def test_one_thing_is_kept_and_the_former_is_closed(kept: Kept[Thing]) -> None:
    for key in (b"a", b"a", b"b", b"a"):
        with kept.opened(key, Thing):
            pass
    assert [thing.closed for thing in Thing.opened] == [True, True, False]
    kept.close()
    kept.close()
    assert [thing.closed for thing in Thing.opened] == [True, True, True]


def test_each_thread_keeps_its_own_thing(kept: Kept[Thing]) -> None:
    with kept.opened(b"a", Thing), ThreadPoolExecutor(1) as threads:
        threads.submit(kept.close).result()
        assert not Thing.opened[0].closed


def _wait_for_the_end_of_all_but(before: set[BaseProcess]) -> None:
    """Wait as long as a test may; the pool's own thread may hear of an end a moment later."""
    deadline = time.monotonic() + SECONDS
    while more := set(multiprocessing.active_children()) - before:
        assert time.monotonic() < deadline, f"still at work: {more}"
        time.sleep(0.01)
