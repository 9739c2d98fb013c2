"""Killed programs: a file is the old one or the new one; the next start clears what they left."""

import os
import random
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from commands import environment

from framelens.base import output
from framelens.base.output import Output, write_whole
from landscape.files import cache

# Writes the file again and again, a dot for each time that it is complete.
WRITING = """
import sys
from pathlib import Path
from framelens.base.output import Output
path = Path(sys.argv[1])
for number in range(10**6):
    file = Output(path)
    for _ in range(8):
        file.write(b"%08d" % number * 5000)
    file.finish()
    print(".", end="", flush=True)
"""


@pytest.fixture(autouse=True)
def fresh() -> None:
    """Let the test's process begin anew: it looks into each folder once."""
    output._clear.cache_clear()


def names(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


@pytest.mark.seldom(13, first=2)
@pytest.mark.posix_only("a killed program's files are told by their age there")
@pytest.mark.parametrize("seed", range(4))
def test_a_program_killed_at_any_moment_leaves_a_whole_file_and_the_next_start_clears_up(
    tmp_path: Path, seed: int
) -> None:
    path = tmp_path / "a.png"
    words = [sys.executable, "-c", WRITING, str(path)]
    with subprocess.Popen(words, stdout=subprocess.PIPE, env=environment()) as process:
        assert process.stdout is not None
        process.stdout.read(random.Random(seed).randrange(1, 60))
        process.kill()
    data = path.read_bytes()
    assert data == data[:8] * 40_000
    write_whole(tmp_path / "b.png", b"another")
    assert names(tmp_path) == {"a.png", "b.png"}


def test_a_file_that_is_being_written_is_not_cleared(tmp_path: Path) -> None:
    first = Output(tmp_path / "a.png")
    output._clear.cache_clear()
    other = Output(tmp_path / "b.png")
    assert len(names(tmp_path)) == 2
    first.write(b"a")
    first.finish()
    other.finish()
    assert names(tmp_path) == {"a.png", "b.png"}


@pytest.mark.posix_only("no other process deletes a file that is open there")
def test_a_temporary_file_that_was_cleared_before_it_was_claimed_is_made_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    count = 0

    def claimed(number: int) -> bool:
        nonlocal count
        count += 1
        if count == 1:
            for path in tmp_path.iterdir():
                path.unlink()
        return os.fstat(number).st_nlink > 0

    monkeypatch.setattr(output, "claimed", claimed)
    write_whole(tmp_path / "a.png", b"a")
    assert count == 2 and names(tmp_path) == {"a.png"}


@pytest.mark.posix_only("there are no such files there")
def test_only_what_this_program_has_begun_is_cleared(tmp_path: Path) -> None:
    for name in (".landscape.x", "x.part", ".other.x.part"):
        (tmp_path / name).write_bytes(b"")
    (tmp_path / ".landscape.folder.part").mkdir()
    (tmp_path / ".landscape.link.part").symlink_to("x.part")
    os.mkfifo(tmp_path / ".landscape.pipe.part")
    before = names(tmp_path)
    write_whole(tmp_path / "a.png", b"a")
    assert names(tmp_path) == before - {".landscape.pipe.part"} | {"a.png"}


@pytest.mark.posix_only("there are no such files there")
@pytest.mark.parametrize("kind", ["pipe", "device", "link"])
def test_a_pipe_or_a_device_in_place_of_a_cache_entry_is_made_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kind: str
) -> None:
    monkeypatch.setenv("LANDSCAPE_CACHE", str(tmp_path))
    made = cache.recall(["parts"], _made)
    (entry,) = tmp_path.iterdir()
    entry.unlink()
    if kind == "pipe":
        os.mkfifo(entry)
    else:
        entry.symlink_to("/dev/zero" if kind == "device" else entry.name)
    again = cache.recall(["parts"], _made)
    assert (again[0] == made[0]).all()
    assert names(tmp_path) == {entry.name}
    assert entry.is_file() == (kind != "link")


def _made() -> cache.Arrays:
    return (np.arange(10),)
