"""Commands that start processes or are ended by a signal leave no process and no file behind."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from commands import SECONDS, environment, need_library, python

pytestmark = [
    pytest.mark.posix_only("processes are looked up in /proc"),
    pytest.mark.skipif(
        not Path("/proc/self/stat").exists(), reason="processes are looked up in /proc"
    ),
]
# Chosen: a mark by which the processes of one command are found, also when their parent is gone.
MARK = "LANDSCAPE_TEST_MARK"


def marked(value: str) -> dict[int, str]:
    """Return the command lines of the running processes that have a value of MARK, by process."""
    found = {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            if f"{MARK}={value}".encode() in (folder / "environ").read_bytes().split(b"\0"):
                found[int(folder.name)] = (folder / "cmdline").read_bytes().decode()
        except OSError:
            continue  # it has ended meanwhile, or belongs to somebody else
    return {number: line for number, line in found.items() if line}  # those that ended have none


def wait_until(done: Callable[[], bool], what: str) -> None:
    deadline = time.monotonic() + SECONDS
    while not done():
        assert time.monotonic() < deadline, what
        time.sleep(0.02)


@pytest.fixture
def mark(tmp_path: Path) -> Iterator[str]:
    yield str(tmp_path)
    for number in marked(str(tmp_path)):
        os.kill(number, signal.SIGKILL)


def start(mark: str, *args: object) -> "subprocess.Popen[bytes]":
    return subprocess.Popen(
        [sys.executable, *map(str, args)],
        stdout=subprocess.DEVNULL,
        env=environment(**{MARK: mark}),
    )


SCRIPT = """
import os

os.cpu_count = lambda: 2
from landscape.cli import main

if __name__ == "__main__":
    main({})
"""
RENDER = ["render", *["fig4a"] * 99, "--preset=2006", "--only=map", "--size=64x48", "-q", "--out"]
BUILD = ["assets", "build", "-q", "--assets"]


@pytest.mark.parametrize("ended_by", ["SIGKILL", "SIGTERM"])
@pytest.mark.parametrize(
    ("words", "made"), [(RENDER, 1), (BUILD, 0)], ids=["render", "assets build"]
)
@pytest.mark.sweep(14)
def test_workers_end_with_their_parent(
    words: list[str], made: int, ended_by: str, mark: str, tmp_path: Path
) -> None:
    if words is BUILD:
        pytest.importorskip("scipy", reason="the extra `studio` is not installed")
    (tmp_path / "out").mkdir()
    path = tmp_path / "script.py"
    path.write_text(SCRIPT.format([*words, str(tmp_path / "out")]))
    parent = start(mark, path)

    def workers() -> list[int]:
        return [number for number, line in marked(mark).items() if "spawn_main" in line]

    def at_work() -> bool:
        assert parent.poll() is None, "the command ended by itself"
        return len(workers()) == 2 and len(list((tmp_path / "out").iterdir())) >= made

    wait_until(at_work, "no two workers at work")
    parent.send_signal(getattr(signal, ended_by))
    parent.wait(SECONDS)
    wait_until(lambda: not marked(mark), f"still there: {marked(mark)}")
    if ended_by != "SIGKILL":
        assert not list((tmp_path / "out").glob(".*"))


@pytest.mark.seldom(14)
def test_kill_ends_a_walk_with_its_recording_complete(mark: str, tmp_path: Path) -> None:
    need_library("OSMesa")
    words = ["walk", "fig4a", "--backend", "osmesa", "--size", "64x48", "--frames", "100000"]
    words += ["--only", "map", "--preset", "2006", "--record", str(tmp_path / "a.jsonl")]
    walk = start(mark, "-m", "landscape", *words)
    wait_until(lambda: any(p.stat().st_size > 8000 for p in tmp_path.glob(".*")), "no recording")
    walk.terminate()
    assert walk.wait(SECONDS) == 128 + signal.SIGTERM
    assert [p.name for p in tmp_path.iterdir()] == ["a.jsonl"]
    assert (tmp_path / "a.jsonl").read_text().splitlines()[-1].startswith('{"frames": ')


def test_the_first_worker_that_starts_holds_back_ctrl_c_as_the_others_do() -> None:
    code = """
import multiprocessing, signal, time
from framelens.system import starting_workers
with starting_workers():
    worker = multiprocessing.get_context("spawn").Process(target=time.sleep, args=(0,))
    worker.start()
    print(signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, []))
worker.join()
print(signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, []))
"""
    assert python(code).out.split() == ["True", "False"]
