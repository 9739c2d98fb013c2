"""Films by a cluster of Dask: the same bytes, whatever is killed; strangers are refused."""

import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError, Future
from contextlib import contextmanager, nullcontext
from functools import partial
from itertools import chain, repeat
from pathlib import Path

import pytest
from commands import SECONDS, Shell, need_library, refused

from framelens.base.engine import Engine, engine, trusted
from framelens.base.errors import InputError
from framelens.base.executor import in_order, lent_or_own
from landscape.film.folder import Parts
from landscape.film.making import write
from landscape.film.parted import LOST, Parting, draw, join
from landscape.film.sources import Wanted, film_of
from landscape.film.stage import Drawing
from landscape.maker import maker

FILM = film_of(["fig2a"], Wanted(Drawing((48, 32), samples=0), fps=10.0, seconds=24.0))
PARTS = 6


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """The film, drawn by one process."""
    need_library("OSMesa")
    out = tmp_path_factory.mktemp("whole") / "film.mp4"
    assert write(FILM, out, 1) == FILM.frames == 240
    return out.read_bytes()


def drawn(folder: Path, pool: Callable | None = None, jobs: int = 1) -> Parting:
    return draw(FILM, folder, ".mp4", pool or partial(lent_or_own, None, 1), jobs)


def bytes_of(parts: Parts) -> bytes:
    out = parts.folder / "film.mp4"
    join(parts, out)
    return out.read_bytes()


@contextmanager
def after_the_first_part(folder: Path, act: Callable[[], object]) -> Iterator[None]:
    """Do something beside the block, once a part is there."""

    def wait() -> None:
        deadline = time.monotonic() + SECONDS
        while not list(folder.glob("part-*.mp4")) and time.monotonic() < deadline:
            time.sleep(0.01)
        act()

    thread = threading.Thread(target=wait)
    thread.start()
    yield
    thread.join()


@pytest.mark.seldom(4, first=1)
@pytest.mark.posix_only("no signal ends a process there")
def test_a_film_of_a_cluster_is_the_same_file_whatever_is_killed(
    tmp_path: Path, whole: bytes
) -> None:
    pytest.importorskip("distributed", reason="needs the extra `cluster`")
    from cluster import cluster

    stranger = tmp_path / "stranger"
    stranger.mkdir()
    (stranger / "sitecustomize.py").write_text("import numpy; numpy.__version__ = '0.1'\n")
    told: list[str] = []
    with cluster(tmp_path / "cluster", 2) as found:
        with engine(str(found.file), maker, lambda line: told.append(str(line))) as workers:
            pool = partial(nullcontext, workers)
            killed = tmp_path / "a_worker_killed"
            with after_the_first_part(killed, lambda: os.kill(found.pids()[0], signal.SIGKILL)):
                parts = drawn(killed, pool, 2).parts
            assert bytes_of(parts) == whole

            # A worker with another numpy joins, and is told apart in its first task.
            found.workers(1, PYTHONPATH=os.pathsep.join([str(stranger), *sys.path]))
            while workers.workers < 3:
                time.sleep(0.02)
            # A film so short may be drawn before it is given a task.
            for number in range(10):
                parts = drawn(tmp_path / f"a_stranger_{number}", pool, 3).parts
                assert bytes_of(parts) == whole
                if told:
                    break
            assert len(told) == 1 and "numpy 0.1 (expected " in told[0], told
            assert told[0].startswith("worker tcp://127.0.0.1:")

            lost = tmp_path / "the_scheduler_killed"
            with (
                after_the_first_part(lost, found.scheduler.kill),
                pytest.raises(InputError, match=LOST.split(":")[0]),
            ):
                drawn(lost, pool, 2)

    there = {path: path.stat().st_mtime_ns for path in lost.glob("part-*.mp4")}
    assert 0 < len(there) < PARTS and not list(lost.glob("*.claim"))
    parts = drawn(lost).parts
    assert bytes_of(parts) == whole
    assert all(path.stat().st_mtime_ns == time for path, time in there.items()), "drawn twice"


class Lost:
    """A client of a cluster whose workers, or whose scheduler, are killed after the first task."""

    def __init__(self, error: Exception) -> None:
        self._errors = chain([None], repeat(error))

    def get_executor(self, pure: bool) -> "Lost":
        return self

    def submit(self, function: Callable, *arguments: object) -> Future:
        future: Future = Future()
        error = next(self._errors)
        if error is None:
            future.set_result(function(*arguments))
        elif isinstance(error, CancelledError):
            future.cancel()
            future.set_running_or_notify_cancel()
        else:
            future.set_exception(error)
        return future

    def shutdown(self, wait: bool) -> None:
        pass


@pytest.mark.parametrize(
    ("how", "line"), [("scheduler", "the engine is gone"), ("workers", "a process was killed")]
)
@pytest.mark.sweep(4)
def test_without_parts_the_loss_of_a_cluster_is_told_in_a_line(how: str, line: str) -> None:
    distributed = pytest.importorskip("distributed", reason="needs the extra `cluster`")
    killed = distributed.KilledWorker("task", None, 3)
    error = CancelledError() if how == "scheduler" else killed
    with Engine(Lost(error), maker, print) as workers:
        with pytest.raises(InputError, match=line):
            list(in_order(workers, str, [1, 2], 2))


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ("tcp://10.0.0.7:8786", "tls://"),
        ("tcp://render.example:8786", "tls://"),
        ("127.0.0.1:8786", "tcp://127.0.0.1:PORT"),
        ("http://127.0.0.1:8786", "tcp://127.0.0.1:PORT"),
        ("tcp://127.0.0.1", "tcp://127.0.0.1:PORT"),
        ("nowhere.json", "nowhere.json: cannot be read"),
        ("odd.json", "scheduler file"),
        ("far.json", "tls://"),
    ],
)
def test_an_engine_that_cannot_be_trusted_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, given: str, expected: str
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("odd.json").write_text("[1]")
    Path("far.json").write_text('{"address": "tcp://192.168.1.5:8786"}')
    with pytest.raises(InputError, match=r"^--engine ") as error:
        trusted(given)
    assert expected in str(error.value)


def test_tls_and_this_machine_are_trusted() -> None:
    for address in ("tcp://127.0.0.1:1", "tcp://[::1]:1", "tcp://localhost:1", "tls://a.b:8786"):
        assert trusted(address) == address


def test_without_dask_a_line_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with (
        pytest.raises(InputError, match=r"pip install .*\[cluster\]"),
        engine("tcp://127.0.0.1:1", maker, print),
    ):
        pass


@pytest.mark.seldom(3, first=2)
def test_jobs_and_an_engine_exclude_each_other(shell: Shell, tmp_path: Path) -> None:
    words = ["film", "fig2a", "--out", tmp_path / "a.gif", "--engine", "tcp://127.0.0.1:1"]
    refused(shell(*words, "--jobs", "2"), "--engine: not with --jobs")


def test_tls_without_a_certificate_ends_in_one_line() -> None:
    pytest.importorskip("distributed", reason="needs the extra `cluster`")
    with (
        pytest.raises(InputError, match=r"127\.0\.0\.1:9: no scheduler answers"),
        engine("tls://127.0.0.1:9", maker, print),
    ):
        pass
