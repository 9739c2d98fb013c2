"""docs/documents.md: its counts, the places it names, and its commands."""

import argparse
import shlex
from pathlib import Path
from typing import Any

import pytest
from commands import Shell
from folded import each
from register import PAGE, ROOT, STATES, Row, distinct_commands, quick, rows

from framelens.base.errors import InputError
from landscape.cli import parse
from landscape.commands import flyover as flyover_command
from landscape.commands.settings_list import rows as settings_rows
from landscape.course import ladder
from landscape.course.pages import by_cell, cells, has_words
from landscape.course.shelf import NAMES as EXERCISES
from landscape.flyover.environment import NAMES as ENVIRONMENTS
from landscape.gallery.panels import named_panels
from landscape.scene.scene import SCENES, find_view, scene

COUNTS = {1: 152, 2: 70, 3: 59, 4: 122, 5: 71}
MOST_NOT_BUILT = 12
RECORDED = ("tour",)
ALL = rows()


def shown(row: Row) -> str:
    return f"{row.document}-{row.number}"


every_row = each("row", ALL, ids=shown)


def test_every_item_of_the_documents_has_a_row() -> None:
    for document, count in COUNTS.items():
        numbers = [int(row.number) for row in ALL if row.document == document]
        assert numbers == [*range(1, count + 1)]


@every_row
def test_a_row_says_where_the_item_is_or_why_it_is_not_there(row: Row) -> None:
    assert row.state in STATES
    assert row.section and row.stated
    for path, name in row.places:
        assert (ROOT / path).exists(), path
        if name:
            text = (ROOT / path).read_text(encoding="utf-8")
            assert all(part in text for part in name.split(".")), f"{path} has no {name}"
    assert row.places and row.words
    if row.state != "whole":
        assert row.reason


def test_the_first_table_counts_the_rows_by_state_and_few_are_not_built() -> None:
    counted = [row for row in map(cells, PAGE.read_text("utf-8").splitlines()) if len(row) == 6]
    counted = counted[2 : 2 + len(COUNTS) + 1]  # after the heading and the line below it
    for document, (_, items, *states, _) in enumerate(counted, 1):
        own = [row for row in ALL if row.document == document or document > len(COUNTS)]
        assert [int(items), *map(int, states)] == [
            len(own),
            *(sum(row.state == state for row in own) for state in STATES),
        ]
    assert sum(row.state == "not built" for row in ALL) <= MOST_NOT_BUILT


def check_names(options: argparse.Namespace, command: str) -> None:
    """Raise InputError, or fail, for a view, lesson, exercise or setting that does not exist."""
    check = CHECKS.get(command.split()[0])
    if check is not None:
        check(options)
    assert check is not None or command.split()[0] in ("views", "doctor", "assets")


def _views(options: argparse.Namespace) -> None:
    named = getattr(options, "views", None) or [
        getattr(options, "view", "")
        or getattr(options, "target", "")
        or getattr(options, "scene", "")
        or next(iter(SCENES))
    ]
    kinds = []
    for name in named:
        if name.endswith((".py", ".svg")):
            assert (ROOT / name).exists(), name
        elif name not in RECORDED:
            kinds.append(find_view(name))

    kinds = kinds or [(scene(options.scene if "scene" in options else ""), None)]
    changed = [*options.changes, *getattr(options, "diff_set", [])]
    for kind, view in kinds:
        preset = options.preset or (kind.preset_of(view) if view else None)
        kind.values(preset, view.settings if view else {}, dict(changed))
        kind.only(options.only)
        element = getattr(options, "element", None)
        assert element is None or element in (*kind.elements, "frame")

    other = options.diff if "diff_set" in options else None  # of a trace: another view
    if other and not other.endswith(".py"):
        find_view(other)


def _lesson(options: argparse.Namespace) -> None:
    if options.name:
        ladder.lesson(options.name)


def _exercise(options: argparse.Namespace) -> None:
    if "name" in options:
        assert options.name in EXERCISES
    if "file" in options:
        assert options.file.stem in EXERCISES


def _settings(options: argparse.Namespace) -> None:
    assert settings_rows(options.preset, dict(options.changes), options.word)


def _flyover(options: argparse.Namespace) -> None:
    flyover_command.settings_of(options)
    assert options.file in ENVIRONMENTS or options.file == "export"


def _figures(options: argparse.Namespace) -> None:
    for name in options.names:
        assert name in (*SCENES, "flyover") or named_panels([name])


def _nothing(options: argparse.Namespace) -> None:
    """Check nothing: the command names none of these."""


CHECKS = {
    **dict.fromkeys(
        ("walk", "render", "trace", "pixel", "state", "strip", "bench", "film"), _views
    ),
    "lesson": _lesson,
    "exercise": _exercise,
    "settings": _settings,
    "flyover": _flyover,
    "figures": _figures,
    "lecture": _nothing,
    "inspect": _nothing,
}


@pytest.mark.seldom(13, first=8)
@every_row
def test_a_command_parses_and_names_only_what_exists(row: Row) -> None:
    if not row.words:
        assert row.command == "-", f"expected one `landscape ...` or -, not {row.command}"
        return
    assert row.command.startswith("`landscape ")
    check_names(parse(row.words), row.words[0])


def test_a_wrong_name_in_a_command_is_found() -> None:
    wrong = (
        "render fig99z",
        "render fig35a --set fog.densty=1",
        "render voxel_bay --only meadow",
        "lesson windows",
        "settings nosuchword",
        "flyover alps --set flyover.no=1",
        "trace voxel_bay --set voxel.no=1",
    )
    for command in wrong:
        words = command.split()
        with pytest.raises((InputError, AssertionError)):
            check_names(parse(words), words[0])


@pytest.mark.sweep(70)
@pytest.mark.parametrize("command", distinct_commands())
def test_a_command_runs(command: str, the_shell: Shell, tmp_path: Path) -> None:
    words = shlex.split(command)
    options: Any = parse(words)
    the_shell.cwd = tmp_path
    if words[:2] == ["exercise", "check"]:
        assert the_shell("exercise", "start", Path(words[2]).stem, "--out", words[2]).status == 0
    target = getattr(options, "target", "")
    if target.endswith(".py"):
        words = [str(ROOT / word) if word == target else word for word in words]
    named = [*getattr(options, "views", []), getattr(options, "view", ""), target]
    drawn = [name for name in named if name and not name.endswith((".py", ".svg"))]
    island = any(name not in RECORDED and find_view(name)[0].name == "island" for name in drawn)
    island = island or (words[0] == "walk" and not drawn)
    run = quick(words, island, tmp_path)
    if not run:
        pytest.skip("it needs a screen")
    done = the_shell(*run)
    unsolved = words[:2] == ["exercise", "check"]
    assert done.status == (1 if unsolved else 0), done.err
    assert "Traceback" not in done.err


def test_cells_of_code_are_not_translated() -> None:
    row = r"| 1 | 2.3 | a \| b | whole | `a/b.py:c`, `d.py` | `landscape views` |"
    assert cells(row)[2:4] == [r"a \| b", "whole"]
    assert [has_words(cell) for cell in cells(row)] == [False, False, True, True, False, False]
    assert by_cell(str.upper)(row) == row.replace(r"a \| b", r"A \| B").replace("whole", "WHOLE")
    assert by_cell(str.upper)("some text") == "SOME TEXT"
