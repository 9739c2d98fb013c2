"""Scenes: one defined in a file of its own is walked, rendered, traced, measured and listed.

Nothing else is edited: it is one line in the list of scenes. It runs in a process of its own.
"""

import json
import os
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from commands import TESTS, Done, environment, python
from PIL import Image

from framelens.base.errors import InputError
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.island.fixes import FIXES
from landscape.offscreen import Offscreen
from landscape.scene.scene import (
    SCENES,
    check_options,
    find_view,
    listed_views,
    placed,
    raised,
    scene,
)

COMMAND = """
import sys
from landscape.cli import main
from landscape.scene.scene import SCENES
SCENES["chessboard"] = "chessboard_scene"
if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
"""


@pytest.fixture
def plugged(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Plug the chessboard into this process."""
    monkeypatch.setitem(SCENES, "chessboard", "chessboard_scene")
    yield


def landscape(*arguments: str | Path) -> Done:
    """Run a command line with the chessboard plugged in."""
    path = f"{TESTS.parent}{os.pathsep}{TESTS}"
    return python(COMMAND, *map(str, arguments), env=environment(PYTHONPATH=path))


@pytest.mark.seldom(10, first=1)
def test_a_scene_in_a_file_of_its_own_is_rendered(tmp_path: Path) -> None:
    for name, options in (
        ("a", ()),
        ("b", ("--set", "board.squares=2")),
        ("c", ("--preset=2006",)),
    ):
        out = tmp_path / f"{name}.png"
        done = landscape("render", "board", "--size", "64x48", "--out", out, *options)
        assert (done.status, done.err) == (0, "")
    pictures = [np.asarray(Image.open(tmp_path / f"{name}.png")) for name in "abc"]
    light, dark = (pictures[0] > 200).all(axis=2).sum(), (pictures[0] < 100).all(axis=2).sum()
    assert light > 50 and dark > 50
    assert (pictures[1] != pictures[0]).any() and (pictures[2] != pictures[0]).any()


@pytest.mark.seldom(13)
def test_many_views_of_the_scene_are_rendered_by_several_processes(tmp_path: Path) -> None:
    done = landscape("render", *["board"] * 16, *["fig6a"], "--size", "16x12", "--out", tmp_path)
    assert (done.status, done.err) == (0, "")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["board.png", "fig6a.png"]


@pytest.mark.seldom(10, first=1)
def test_the_scene_is_walked_on_the_null_platform(tmp_path: Path) -> None:
    record = tmp_path / "walk.jsonl"
    arguments = ("walk", "chessboard", "--backend", "osmesa", "--size", "64x48", "--frames", "3")
    done = landscape(*arguments, "--record", record)
    assert (done.status, done.err) == (0, "")
    plan, *ticks, last = (json.loads(line) for line in record.read_text().splitlines())
    assert (plan["scene"], plan["view"], plan["pose"][1]) == ("chessboard", "board", None)
    assert last == {"frames": 3} and len(ticks) == 3
    done = landscape("walk", "--backend", "osmesa", "--replay", record, "--record", tmp_path / "b")
    assert (done.status, done.err) == (0, "")
    assert (tmp_path / "b").read_text() == record.read_text()


@pytest.mark.seldom(10, first=4)
def test_the_scene_is_traced(tmp_path: Path) -> None:
    calls = landscape("trace", "board", "--json").json()
    vertices = [call for call in calls if call["name"] == "glVertex3f"]
    assert len(vertices) == 4 * 64
    assert {call["element"] for call in vertices} == {"squares"}
    assert landscape("trace", "board", "--element", "squares", "--only", "fog").out.count("\n") == 2
    done = landscape("trace", "board", "--element", "grass")
    assert done.status == 2 and "squares" in done.err


@pytest.mark.seldom(13, first=12)
def test_the_scene_is_measured_and_has_no_grass(tmp_path: Path) -> None:
    out = tmp_path / "bench.json"
    done = landscape("bench", "board", "--size", "32x24", "--json", out, "--quiet")
    assert (done.status, done.err) == (0, "")
    figures = json.loads(out.read_text())
    assert list(figures["views"]) == ["board"] and figures["grass"] == []
    assert figures["views"]["board"]["gl_calls"] > 300 and figures["startup_ms"] > 0


@pytest.mark.seldom(3, first=1)
def test_the_scene_is_listed_with_its_views_settings_and_elements() -> None:
    views = {view["name"]: view for view in landscape("views", "--json").json()}
    assert views["board"]["pose"] == [4.0, 1.1, 7.0, 0.0, -20.0]
    assert (views["board"]["scene"], views["board"]["preset"]) == ("chessboard", "best")
    assert views["fig35a"]["scene"] == "island"
    rows = landscape("settings", "--json", "--set", "board.squares=3").json()
    own = {row["key"]: row["value"] for row in rows if row["scene"] == "chessboard"}
    assert own["board.squares"] == 3 and "grass.count" not in own
    assert landscape("render", "board", "--only", "squares,fog,moat").status == 2


def test_what_no_scene_has_is_bad_input(plugged: None) -> None:
    check_options("best", {"board.squares": 4}, ("squares",))
    check_options("2006", {"grass.count": 4}, ("grass",))
    for preset, settings, only in (
        ("best", {"board.squares": 4, "grass.count": 4}, None),
        ("best", {}, ("squares", "grass")),
        ("1996", {}, None),
    ):
        with pytest.raises(InputError):
            check_options(preset, settings, only)
    for wrong in (lambda: scene("moon"), lambda: find_view("fig99z")):
        with pytest.raises(InputError, match=r"moon|fig99z"):
            wrong()


def test_a_view_knows_its_scene_and_a_scenes_name_means_its_start(plugged: None) -> None:
    assert [find_view(name)[0].name for name in ("fig35a", "board")] == ["island", "chessboard"]
    assert find_view("chessboard")[1].name == "board"
    assert find_view("island")[1].name == scene("island").start == scene().start


def test_a_fix_is_a_view_that_shows_it_fixed() -> None:
    for fix in FIXES:
        kind, view = find_view(fix.name)
        assert (kind.name, view.name, kind.preset_of(view)) == ("island", fix.name, "2006")
        values = kind.values("2006", view.settings)
        assert values == kind.values("2006", fix.common, fix.on)
        assert view.pose == fix.pose(True) and view.shown == fix.only


@pytest.mark.seldom(3, first=1)
def test_a_fix_is_drawn_by_its_name_as_in_its_second_picture() -> None:
    fix = next(fix for fix in FIXES if fix.name == "R14")
    pictures = []
    for view, settings in (
        ("R14", {}),
        (fix.pose(True), fix.settings(True)),
        (fix.pose(False), fix.settings(False)),
    ):
        preset = "2006" if settings else None
        with Offscreen((80, 60), preset, settings, only=fix.only, samples=0) as offscreen:
            offscreen.look(view, fix.kt)
            pictures.append(offscreen.draw())
    by_name, after, before = pictures
    assert (by_name == after).all() and (by_name != before).any()


@pytest.mark.parametrize(("wrong", "meant"), [("R6", "R6a and R6b"), ("FIG8", "fig8a"), ("", "")])
def test_a_wrong_name_is_refused_with_those_that_begin_like_it(wrong: str, meant: str) -> None:
    with pytest.raises(InputError, match=f"view '{wrong}': no such view.*{meant}"):
        find_view(wrong)


def test_a_walk_begins_in_a_technique_s_view_as_it_is_drawn() -> None:
    island = scene("island")
    for preset in (None, "2006"):
        begin = island.as_walked(island.views["fig2a"], preset)
        assert begin.wireframe and begin.settings == island.views["fig2a"].settings
        assert begin.shown == ("ground", "sword", "map") and island.preset_of(begin) == "2006"


def test_a_walk_begins_in_a_place_with_all_elements_and_the_place_s_settings() -> None:
    island = scene("island")
    begin = island.as_walked(island.views["fig25c"], None)
    assert (begin.shown, island.preset_of(begin)) == ((), "best")
    assert begin.settings == {}
    haze = island.as_walked(island.views["fig35e"], None)
    assert haze.settings == {"fog.density": 0.12}


def test_a_walk_with_another_preset_takes_the_place_and_the_fix() -> None:
    island = scene("island")
    begin = island.as_walked(island.views["fig2a"], "best")
    assert not begin.wireframe and (begin.settings, begin.shown) == ({}, ())
    assert begin.pose == island.views["fig2a"].pose and island.preset_of(begin) == "best"
    _, fixed = find_view("R12")
    assert island.as_walked(fixed, "best").settings == {"rabbit.mapping": "axis"}


@pytest.mark.seldom(3, first=2)
def test_view_names_are_unique_and_presets_and_elements_are_those_of_the_scene() -> None:
    names = [view["name"] for view in listed_views()]
    assert len(names) == len(set(names))
    for name in set(names) & set(SCENES):
        assert scene(name).start == name
    for kind in map(scene, SCENES):
        assert {kind.start, *kind.main} <= set(kind.views)
        for view in kind.views.values():
            assert kind.preset_of(view) in kind.presets
            assert set(view.shown) <= set(kind.elements)
            kind.values(kind.preset_of(view), view.settings)


def test_a_pose_without_height_stands_at_eye_height() -> None:
    class Hill:
        size = 10.0

        def height(self, x: float, z: float) -> float:
            return x + z

    assert placed(Pose(1.0, None, 2.0, 30.0), Hill(), 0.25) == Pose(1.0, 3.25, 2.0, 30.0)
    assert placed(Pose(1.0, 9.0, 2.0), Hill(), 0.25) == Pose(1.0, 9.0, 2.0)


PACKAGE = TESTS.parent / "landscape"
GENERIC = (
    "offscreen.py",
    "cli.py",
    "commands/common.py",
    "commands/walk.py",
    "scene/*.py",
    "walk/*.py",
)
GENERIC += ("bench/bench.py", "commands/target.py", "commands/render_many.py", "bench/timing.py")
GENERIC += ("../tests/stage.py",)


def test_no_generic_module_names_the_island() -> None:
    paths = [path for pattern in GENERIC for path in PACKAGE.glob(pattern)]
    assert len(paths) > 12
    for path in paths:
        code = path.read_text(encoding="utf-8")
        assert not re.search(r"import.*\bisland\b|\bIsland\b|landscape\.island\.views", code), path
        assert path.name == "scene.py" or "landscape.island.island" not in code, path


def test_a_view_below_the_ground_of_another_island_is_raised_above_it() -> None:
    class Hill:
        size = 40.0

        def height(self, x: float, z: float) -> float:
            return 3.0

    assert raised(Pose(1.0, 2.0, 3.0, 4.0, 5.0), Hill(), 0.1) == Pose(1.0, 3.1, 3.0, 4.0, 5.0)
    for pose in (Pose(1.0, 3.05, 3.0), Pose(1.0, 9.0, 3.0)):
        assert raised(pose, Hill(), 0.1) == pose


@pytest.mark.seldom(10, first=1)
def test_no_named_view_of_ours_is_below_the_ground() -> None:
    kind = scene("island")
    for view in kind.views.values():
        ground = kind.terrain(kind.values(kind.preset_of(view), view.settings), Assets())
        pose = placed(view.pose, ground, 0.1)
        under_water = view.name == "under_water" and pose.y > ground.terrain_height(pose.x, pose.z)
        assert raised(pose, ground, 0.1) == pose or under_water, view.name


def test_where_one_can_dive_only_a_view_below_the_bed_is_raised() -> None:
    class Bay:
        size = 40.0

        def height(self, x: float, z: float) -> float:
            return 3.0

        def bed(self, x: float, z: float) -> float:
            return 2.0

    assert raised(Pose(1.0, 2.5, 3.0), Bay(), 0.1) == Pose(1.0, 2.5, 3.0)
    assert raised(Pose(1.0, 1.5, 3.0), Bay(), 0.1) == Pose(1.0, 3.1, 3.0)
