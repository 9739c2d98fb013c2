"""Settings that have no effect beside the others: which, why, and how the user is told."""

import ast
import json
import logging
from pathlib import Path
from typing import Any

import chessboard_scene
import pytest
from commands import Shell
from folded import each
from test_rooms import ROOT, imports

import landscape
from landscape.elements.settings import Settings
from landscape.island.island import ELEMENTS
from landscape.island.slots import SLOTS
from landscape.scene.scene import SCENES, scene
from landscape.settings import declare
from landscape.settings.notices import WALK, conditions, ignored, in_words, notices, terms

ISLAND = scene("island")
KEYS = declare.fields(Settings)


def why(key: str, preset: str = "best", shown: tuple[str, ...] = ELEMENTS, **changes: Any) -> str:
    given = {name.replace("__", "."): value for name, value in changes.items()}
    return str(ignored(ISLAND.values(preset, given), key, shown, ELEMENTS, SLOTS) or "")


@each("key", KEYS)
def test_conditions_name_existing_settings_elements_or_the_walk(key: str) -> None:
    for condition in conditions(Settings, key, SLOTS):
        assert in_words(Settings, condition)
        for term in terms(condition):
            assert term.known(Settings(), ELEMENTS), condition
            if term.sign in ("=", "!="):
                declare.with_settings(Settings(), {term.name: term.value})


def test_each_of_the_reasons_is_named() -> None:
    assert why("reflection.stencil") == "ignored while reflection.rippled is on"
    sea = "water.shallow is on, reflection.rippled is on and water is shown"
    assert why("ground.clip") == f"ignored while {sea}"
    assert why("fog.start") == "ignored while fog.mode is exp2"
    assert why("fog.start", fog__mode="linear") == ""
    assert why("trees.species", trees__count=0) == "ignored while trees.count is 0"
    assert why("trees.count", trees__count=0) == ""
    assert why("walk.speed") == "ignored outside a walk"
    assert why("walk.speed", shown=(WALK,)) == ""
    assert why("camera.lens", shown=(WALK,)) == "ignored in a walk"
    assert why("camera.lens") == ""
    assert why("camera.focus") == "ignored while camera.lens is 0"
    assert why("grass.arch", shown=("ground",)) == "ignored while grass is not shown"
    lit = "ground.lit is off and water, castle, rabbit and dragon"
    assert why("sun.diffuse", shown=("ground",)) == f"ignored while {lit} are not shown"
    assert why("ground.clip", shown=("ground",)) == ""
    assert why("grass.method").count(" is ") == 8 and why("grass.method", "2006") == ""


def test_a_scene_without_what_a_condition_names_is_not_bound_by_it() -> None:
    # The sun lights the castle, among others: a scene without any of these has its own elements.
    board = chessboard_scene.Settings()
    assert ignored(board, "sun.fill", ("squares",), ("squares", "fog")) is None
    assert ignored(board, "sun.fill", ("squares",), ("squares", "castle")) is not None


def test_a_key_under_its_old_name_is_told_by_its_new_one() -> None:
    given = {"camera.detail": 2, "fog.density": 1}
    lines = notices(Settings(), given, ("ground", "fog"), ELEMENTS)
    assert list(lines) == ["camera.lod_pixels"]


# --- on the command line -----------------------------------------------------------------------

SMALL = ("--size", "32x24", "--samples", "0")
GROUND = ("--only", "ground")
TOLD = "landscape: setting reflection.stencil: ignored while reflection.rippled is on\n"


@pytest.fixture
def shell(the_shell: Shell, tmp_path: Any) -> Shell:
    the_shell.cwd = tmp_path
    return the_shell


@pytest.mark.seldom(7, first=4)
def test_render_says_in_one_line_what_changes_nothing(shell: Shell) -> None:
    stencil = ("--set", "reflection.stencil=true", "--set", "reflection.rippled=true")
    words = ("render", "fig11a", *SMALL, *shell.small, *stencil)
    assert shell(*words).err == TOLD
    assert shell(*words, "-q").err == ""
    assert shell(*words, "--set", "reflection.rippled=false").err == ""


def test_a_setting_from_a_file_is_told_too(shell: Shell) -> None:
    (shell.cwd / "a.toml").write_text("[fog]\nend = 9\n[ground]\nclip = false\n")
    done = shell("render", "fig4a", *SMALL, *GROUND, "--settings", "a.toml")
    why = "ignored while fog.enabled is off, fog.mode is exp2 and fog is not shown"
    assert (done.status, done.err) == (0, f"landscape: setting fog.end: {why}\n")


@pytest.mark.seldom(3)
def test_what_changes_one_of_several_views_is_not_told(shell: Shell) -> None:
    words = ("render", "fig4a", "fig4b", *SMALL, *GROUND, "--out", "out", "--set")
    assert shell(*words, "ground.detail_repeat=9").err == ""
    assert "sand_repeat" in shell(*words, "ground.sand_repeat=9").err


def test_trace_tells_it_on_standard_error(shell: Shell) -> None:
    done = shell("trace", "fig4a", *GROUND, "--json", "--set", "walk.speed=2")
    assert done.err == "landscape: setting walk.speed: ignored outside a walk\n"
    assert json.loads(done.out)


def test_a_walk_tells_it_but_takes_the_settings_of_the_walker(shell: Shell) -> None:
    words = ("walk", "fig4a", "--backend", "osmesa", "--frames", "1", *SMALL[:2], *GROUND)
    done = shell(*words, "--set", "walk.speed=2", "--set", "grass.count=9")
    assert done.err == "landscape: setting grass.count: ignored while grass is not shown\n"


@pytest.mark.seldom(13, first=6)
@pytest.mark.parametrize(
    "words",
    [
        ("render", "fig4a", "fig6a", *SMALL, *GROUND, "--out", "out"),
        ("trace", "fig4a", *GROUND),
        ("settings", "camera"),
        ("walk", "fig4a", "--backend", "osmesa", "--frames", "1", *SMALL[:2], *GROUND),
    ],
    ids=lambda words: words[0],
)
def test_a_renamed_key_is_told_once(words: tuple[str, ...], shell: Shell) -> None:
    (shell.cwd / "old.toml").write_text("[camera]\ndetail = 2\n")
    old = ("--settings", "old.toml", "--set", "camera.detail=3")
    told = shell(*words, *old).err
    assert told.count("camera.detail: now called camera.lod_pixels") == 1
    assert shell(*words, *old, "-q").err == ""


# --- from Python -------------------------------------------------------------------------------


def test_an_offscreen_lists_what_changes_nothing_in_its_view() -> None:
    given = {"fog.density": 0.3, "camera.detail": 0.0}
    with landscape.Offscreen((32, 24), settings=given, only=["ground", "fog"]) as view:
        assert view.notices == []
        view.look("fig34a")
        told = ["setting camera.detail: now called camera.lod_pixels"]
        told.append("setting camera.lod_pixels: ignored while rabbit and dragon are not shown")
        assert view.notices == told
        view.look("fig4a")
        assert view.notices[1].startswith("setting fog.density: ignored while ")
        assert "fog.enabled is off" in view.notices[1]


def test_render_logs_it(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.WARNING, "landscape"):
        landscape.render("fig4a", (32, 24), only=["ground"], settings={"water.level": 0.7})
        assert not caplog.records
        landscape.render("fig4a", (32, 24), only=["ground"], settings={"water.points": 9})
    assert [r.getMessage() for r in caplog.records] == [
        "setting water.points: ignored while water is not shown"
    ]


def reached(start: str) -> set[Path]:
    """Return the files of landscape that a module imports, itself or by way of others."""
    files: set[Path] = set()
    left = [start]
    while left:
        path = ROOT / (left.pop().replace(".", "/") + ".py")
        if path.is_file() and path not in files:
            files.add(path)
            left += [name for _, name in imports(path)]
            left += [name.rpartition(".")[0] for _, name in imports(path)]
    return files


@pytest.mark.seldom(14)
@each("name", SCENES)
def test_a_scene_offers_no_setting_that_nothing_in_it_reads(name: str) -> None:
    kind = scene(name)
    files = reached(SCENES[name]) | {*(ROOT / "landscape" / "walk").glob("*.py")}
    read: set[str] = set()
    for path in files:
        if "settings" in path.as_posix() or path.name == "views.py":
            continue
        code = ast.parse(path.read_text("utf-8"))
        named = [node for node in ast.walk(code) if isinstance(node, ast.keyword)]
        lists = [each.value for each in named if each.arg == "unread"]
        listed = {id(node) for each in lists for node in ast.walk(each)}
        for node in ast.walk(code):
            if isinstance(node, ast.Attribute):
                read.add(node.attr)
            elif isinstance(node, ast.Constant) and id(node) not in listed:
                read.add(str(node.value))

    kinds = declare.fields(type(kind.settings))
    words = declare.words(type(kind.settings))
    unread = [
        key
        for key in kinds.keys() - words.keys()
        if key not in read and not {*key.split(".")} <= read
    ]
    assert {*unread} <= {*kind.unread} <= {*kinds}


def test_a_setting_of_a_shared_group_that_a_scene_does_not_read_is_told() -> None:
    hall = scene("hall")
    lines = hall.notices(hall.views["hall"], None, {"camera.cull": False, "fog.density": 0.1})
    assert lines["camera.cull"] == "setting camera.cull: has no effect in this scene"
    assert "has no effect" not in lines.get("fog.density", "")
