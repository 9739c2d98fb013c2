"""scripts/measures.py counts what it says; CONTRIBUTING and docs/reading.md name what there is."""

import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "scripts"))

import measures  # noqa: E402

MODULE = '''
from typing import Any

import {other}

LONG = """
import os
print(1)
"""


def wide(a: Any) -> None:
    global state
    a, b, c = 1, 2, 3
    print([a, b, c, a + b, b + c, c + a, (a, b), (b, c), (c, a), {{a: b, b: c, c: a}}])
    state = isinstance(a, int)


def long() -> None:
    """A docstring.

    With a blank line.
    """
{lines}
'''


def written(folder: Path, name: str, other: str) -> Path:
    path = folder / "framelens" / name
    path.parent.mkdir(exist_ok=True)
    lines = "\n".join(f"    print({number})" for number in range(20))
    path.write_text(MODULE.format(other=other, lines=lines))
    return path


def test_two_modules_that_are_alike_and_import_each_other(tmp_path: Path) -> None:
    paths = [
        written(tmp_path, "one.py", "framelens.two"),
        written(tmp_path, "two.py", "framelens.one"),
    ]
    assert measures.cycles(tmp_path, paths) == [["framelens.one", "framelens.two"]]
    assert measures.wide_assignments(tmp_path, paths) == [
        "framelens/one.py:14",
        "framelens/two.py:14",
    ]
    assert len(measures.uses_of_any(tmp_path, paths)) == 2
    assert measures.names_declared_global(tmp_path, paths)[0] == "framelens/one.py:13 state"
    assert len(measures.questions_of_type(tmp_path, paths)) == 2

    counted = measures.functions(tmp_path, paths)
    assert counted["long"] == counted["without a blank line"]
    assert counted["long"] == ["framelens/one.py:19", "framelens/two.py:19"]

    (repeat, *others) = measures.repeats(tmp_path, paths)
    assert not others and repeat[1] == ["framelens/one.py:6-43", "framelens/two.py:6-43"]


def test_a_program_in_a_string_counts_as_code(tmp_path: Path) -> None:
    path = tmp_path / "shell.py"
    path.write_text('TEXT = "plain"\n')
    plain = measures.size(path)
    other = tmp_path / "program.py"
    other.write_text('TEXT = """\nimport os\n\nprint(os)\n"""\n')
    assert measures.size(other) == plain + 9


def test_the_map_in_contributing_names_every_room_and_no_other() -> None:
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    lines = text.partition("## The map")[2].partition("\nTo find a technique")[0].splitlines()
    named = set()
    package = ""
    for line in lines:
        if top := re.match(r" {4}(\w+)/", line):
            package = top[1]
        elif inner := re.match(r" {6}(\S+?/?)(?:, \S+)* ", line):
            named.add(f"{package}/{inner[1].rstrip('/')}")
    rooms = {
        f"{package}/{path.name}"
        for package in ("framelens", "landscape")
        for path in (ROOT / package).iterdir()
        if path.is_dir() and not path.name.startswith("__")
    }
    missing = rooms - named - {"framelens/fonts"}
    assert missing == set(), 'not in "The map" of CONTRIBUTING.md'
    assert [name for name in named if not (ROOT / name).exists()] == []


@pytest.mark.parametrize("name", ["CONTRIBUTING.md", "docs/reading.md", "README.md"])
def test_every_file_that_a_document_names_is_there(name: str) -> None:
    text = (ROOT / name).read_text(encoding="utf-8")
    tops = "framelens|landscape|scripts|tests|docs|shaders_none"
    paths = re.findall(rf"`((?:{tops})/[\w/]+(?:\.\w+|/))`", text)
    paths += [f"landscape/{each}" for each in re.findall(r"`(elements/[\w/]+\.py)`", text)]
    assert paths
    real = [path for path in paths if "NAME" not in path]
    assert [path for path in real if not (ROOT / path).exists()] == []


def test_the_reading_order_has_twelve_files_of_1500_lines() -> None:
    text = (ROOT / "docs" / "reading.md").read_text(encoding="utf-8")
    parts = re.split(r"^## \d+\. .*$", text.partition("## From here")[0], flags=re.MULTILINE)[1:]
    assert len(parts) == 12
    lines = 0
    for part in parts:
        (path,) = re.findall(r"^`(landscape/[\w/]+\.py)`", part, re.MULTILINE)
        lines += (ROOT / path).read_text(encoding="utf-8").count("\n")
        assert "\nQuestion: " in part and "\n    landscape " in part
    assert 1350 <= lines <= 1650
