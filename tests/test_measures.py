"""scripts/measures.py counts what it says; CONTRIBUTING and docs/reading.md name what there is."""

import re
import sys
from pathlib import Path

import pytest

from landscape.scene.scene import SCENES, Scene, scene
from landscape.settings.declare import fields, words
from landscape.walk.keys import SETTINGS

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


def over_their_targets(counts: dict[str, int]) -> dict[str, int]:
    return {name: count for name, count in counts.items() if count > measures.TARGETS[name]}


CODE = measures.files(ROOT, measures.PACKAGES)
HOUSE = measures.without_programs(CODE)


@pytest.mark.slow
@pytest.mark.seldom(10)
def test_types_and_assignments_stay_below_their_targets() -> None:
    counts = {
        "`Any`": len(measures.uses_of_any(ROOT, CODE)),
        "`# fmt: skip`": len(measures.unformatted(ROOT, CODE)),
        "tuple assignments of 3+ targets": len(measures.wide_assignments(ROOT, CODE)),
        "names declared global": len(measures.names_declared_global(ROOT, HOUSE)),
    }
    assert over_their_targets(counts) == {}, "python scripts/measures.py --places"


@pytest.mark.slow
@pytest.mark.seldom(10, first=1)
def test_what_else_has_met_its_target_stays_below_it() -> None:
    counts = {
        "functions of 20+ lines without a blank line": len(
            measures.functions(ROOT, CODE)["without a blank line"]
        ),
        "exact repeats of 40+ nodes": sum(nodes for nodes, _ in measures.repeats(ROOT, HOUSE)),
        "import cycles": len(measures.cycles(ROOT, CODE)),
        "classes with an `apply` of their own": len(measures.classes_with("apply", ROOT, HOUSE)),
    }
    assert over_their_targets(counts) == {}, "python scripts/measures.py --places"


MOST_UNCHANGED = 120  # the target of docs/measures.md


def unchanged(kind: Scene) -> set[str]:
    """Return the settings of a scene that nothing in it changes: no preset, view, fix or key."""
    changed: set[str] = {each.setting for each in (*kind.digits.values(), *kind.letters.values())}
    changed |= {*SETTINGS.values()}
    for table in (*kind.presets.values(), *(view.settings for view in kind.views.values())):
        changed |= {*table}
    for key, tables in words(type(kind.settings)).items():
        changed |= {key, *(name for table in tables.values() for name in table)}
    for fix in kind.fixes:
        changed |= {*fix.on, *fix.off, *fix.as_view().settings}
    return {*fields(type(kind.settings))} - changed


def test_most_settings_are_changed_somewhere() -> None:
    counts = {name: len(unchanged(scene(name))) for name in SCENES}
    assert sum(counts.values()) <= MOST_UNCHANGED, f"{counts}: give each a view that shows it"


def test_the_page_of_measures_names_the_targets_that_are_met() -> None:
    page = (ROOT / "docs" / "measures.md").read_text(encoding="utf-8")
    rows = [line.split(" | ") for line in page.splitlines() if line.startswith("| ")]
    targets = {row[0].removeprefix("| "): row[3] for row in rows}
    for measure, target in measures.TARGETS.items():
        assert re.match(r"\d+", targets[measure])[0] == str(target), measure


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
