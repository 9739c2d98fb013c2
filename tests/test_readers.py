"""Every reader of files: what was once found, and a few new files of each format.

`make fuzz` reads many more.
"""

import os
import sys
from pathlib import Path

import pytest
from commands import TESTS

FUZZ = TESTS.parent / "scripts" / "fuzz"
FILES = 12  # new ones for each reader: a few seconds in all

pytest.importorskip("hypothesis", reason="`make test` installs it")
sys.path.insert(0, str(FUZZ))
import hunt  # noqa: E402
from readers import READERS, Reader  # noqa: E402


@pytest.mark.parametrize("path", sorted(hunt.CORPUS.iterdir()), ids=lambda path: path.name)
def test_what_was_once_found_is_read_or_refused_in_one_line(path: Path, tmp_path: Path) -> None:
    hunt.attempt(READERS[path.name.partition("-")[0]], path.read_bytes(), tmp_path)


@pytest.mark.seldom(14, first=5)
@pytest.mark.parametrize("name", READERS)
def test_a_file_of_each_format_with_odd_values_is_read_or_refused(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LANDSCAPE_CACHE", "")
    day = int(os.environ["LANDSCAPE_TESTS_DAY"])
    assert hunt.look(name, day, FILES, tmp_path) is None


def test_a_reader_that_stumbles_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    reader = Reader("a.png", READERS["image"].content, lambda path: path.read_bytes()[10**6])
    monkeypatch.setitem(READERS, "stumbling", reader)
    found = hunt.look("stumbling", 1, 20, tmp_path)
    assert found is not None and "IndexError" in found[1]
