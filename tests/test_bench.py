"""The bench: the values it prints, the replay that equals the frame, four ways to draw the same
grass, and a long run whose memory does not grow. Nothing here fails because a machine is slow."""

import json
import subprocess
import sys
from dataclasses import replace
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from commands import SECONDS, TESTS, environment, landscape
from stage import SMALL, SMALL_BEST, Stage, live_names, small

from framelens.base.errors import InputError
from framelens.gl.replay import Replay
from framelens.gl.texture import Texture
from landscape.bench import bench
from landscape.bench.grass import WAYS, Blades, FromClientMemory, OneByOne, bent, sow, visible
from landscape.bench.timing import Layer, clear
from landscape.bench.tone import CASES
from landscape.cli import main
from landscape.elements.settings import preset
from landscape.files.assets import Assets
from landscape.frame import SEED, Pose
from landscape.geometry.height_field import HeightField
from landscape.scene.scene import Moment, OpenScene, find_view

LIGHT = {**SMALL, "deer.count": 4}
TINY: dict[str, Any] = {
    "views": ["fig35b", "fig35i", "fig34a"],
    "size": [96, 64],
    "settings": SMALL_BEST,
    "rounds": 3,
    "grass": [2_000, 400_000],
    "ways": 500,
    "starts": 1,
}


@pytest.fixture(scope="module")
def result() -> dict[str, Any]:
    """A bench of a light island, in a process of its own: it opens and closes a context."""
    code = (
        "import sys, json; from landscape.bench import bench;"
        "options = bench.Options(**json.loads(sys.argv[1])); heard = [];"
        "out = bench.measure(options, heard.append);"
        "print(json.dumps({'result': out, 'heard': heard}))"
    )
    command = [sys.executable, "-c", code, json.dumps(TINY)]
    done = subprocess.run(
        command, capture_output=True, text=True, timeout=SECONDS, env=environment(), check=False
    )
    assert done.returncode == 0, done.stderr
    answer: dict[str, Any] = json.loads(done.stdout)
    return answer


@pytest.mark.seldom(10, first=4)
def test_the_bench_returns_the_documented_values(result: dict[str, Any]) -> None:
    figures = result["result"]
    assert figures.keys() >= {"renderer", "size", "layer_ms", "views", "grass", "startup_ms"}
    assert figures["size"] == [96, 64]
    assert list(figures["views"]) == ["fig35b", "fig35i", "fig34a"]
    for view in figures["views"].values():
        assert view.keys() == {
            *("frame_ms", "layers", "python_ms", "replay_ms", "python_tax", "gl_calls")
        }
    rows = [row["count"] for row in figures["grass"]]
    assert rows == [2_000, 400_000]
    for row in figures["grass"]:
        assert row.keys() == {"count", "select_ms", "visible", "draw_ms", "static_ms"}
    assert [way["name"] for way in figures["ways"]] == [way.name for way in WAYS]


@pytest.mark.seldom(10, first=4)
def test_the_ratios_follow_from_the_times(result: dict[str, Any]) -> None:
    figures = result["result"]
    assert figures["layer_ms"] > 0
    for view in figures["views"].values():
        assert view["layers"] == pytest.approx(view["frame_ms"] / figures["layer_ms"])
        assert view["python_tax"] == pytest.approx(view["frame_ms"] / view["replay_ms"])
        assert view["python_ms"] == pytest.approx(view["frame_ms"] - view["replay_ms"])
        assert 50 < view["gl_calls"] < 5000
    assert figures["startup_ms"] > 100  # less than the interpreter with numpy: nothing was run


@pytest.mark.seldom(10, first=4)
def test_more_blades_on_more_land_have_the_same_density(result: dict[str, Any]) -> None:
    few, many = result["result"]["grass"]
    assert few["count"] < many["count"]
    assert few["visible"] > 0
    assert many["visible"] > 0


@pytest.mark.seldom(10, first=4)
def test_the_bench_reports_each_step(result: dict[str, Any]) -> None:
    assert len(result["heard"]) == bench.steps(bench.Options(**TINY))
    assert result["heard"][-1] == "start"


@pytest.mark.seldom(10, first=4)
def test_the_report_shows_every_view_and_value(result: dict[str, Any]) -> None:
    text = bench.report(result["result"])
    for word in ("fig35b", "fig35i", "400,000", "immediate mode", "first frame"):
        assert word in text


def test_the_default_views_and_counts_are_the_documented_ones() -> None:
    options = bench.Options()
    assert list(options.views) == [f"fig35{panel}" for panel in "abcdefghi"]
    assert list(options.grass) == [200_000, 1_500_000, 10_000_000]
    assert options.samples == 0
    settings = {name: options.values(*find_view(name)) for name in options.views}
    # Two have something of their own: fig35e the report's haze, fig35h a narrower angle.
    haze = settings["fig35e"].fog
    assert haze == replace(preset("best").fog, density=0.12)
    settings["fig35e"] = replace(settings["fig35e"], fog=preset("best").fog)
    assert settings["fig35h"].camera == replace(preset("best").camera, fov=40.0)
    settings["fig35h"] = replace(settings["fig35h"], camera=preset("best").camera)
    assert set(settings.values()) == {preset("best")}


@pytest.mark.seldom(10, first=4)
def test_the_command_writes_json_and_prints_the_tables(
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    result: dict[str, Any],
) -> None:
    asked: list[bench.Options] = []

    def measured(options: bench.Options, done: Any) -> dict[str, Any]:
        asked.append(options)
        figures: dict[str, Any] = result["result"]
        return figures

    monkeypatch.setattr(bench, "measure", measured)
    file = tmp_path / "figures.json"
    command = ["bench", "fig35a", "--size", "320x200", "--set", "grass.count=7", "fig35f"]
    assert main([*command, "--json", str(file), "--preset", "2006"]) == 0
    assert json.loads(file.read_text()) == result["result"]
    assert capsys.readouterr().out.strip() == bench.report(result["result"])
    assert asked[0].views == ["fig35a", "fig35f"]
    assert asked[0].size == (320, 200)
    assert asked[0].preset == "2006"
    assert asked[0].values(*find_view("fig35a")).grass.count == 7


def test_an_unknown_view_is_bad_input() -> None:
    done = landscape("bench", "fig99z")
    assert (done.status, done.out) == (2, "")
    assert done.err.startswith("landscape: view 'fig99z'")


def test_an_unknown_view_is_bad_input_from_python() -> None:
    with pytest.raises(InputError, match="fig99z"):
        bench.measure_views(bench.Options(views=("fig99z",)), lambda name: None)


@pytest.mark.parametrize("preset", ["best", "2006"])
@pytest.mark.parametrize("name", ["fig35a", "fig35f", "fig35i"])
@pytest.mark.sweep(14, first=9)
def test_the_replay_draws_the_same_picture_as_the_frame(
    stage: Stage, name: str, preset: str
) -> None:
    options = bench.Options(size=stage.size, preset=preset, settings=LIGHT)
    kind, view = find_view(name)
    with stage.borrowed():
        island = kind.open(options.values(kind, view), Assets(), SEED, kind.elements)
        draw = partial(bench.draw_view, view, island, set(kind.shown(view)), options)
        try:
            for _ in range(2):  # what is made at the first frame must not get into the list
                draw()
            direct = stage.read()
            replay = Replay(draw)
            # Another mirror image lies in its texture by now, and another picture in the window.
            draw(arriving=True)
            clear()
            replay.call()
            replayed = stage.read()
            replay.release()
        finally:
            island.release()

    assert direct.std() > 10
    assert np.abs(direct - replayed).max() <= 1


def test_a_layer_covers_every_pixel_and_leaves_the_state(stage: Stage) -> None:
    layer = Layer(stage.size)
    with stage.frame(small(), Pose(0, 0, 0)):
        clear()
        layer.draw()
        picture = stage.read()
        cleared = np.round(np.array(small().fog.color) * 255)
        assert (np.abs(picture - cleared).sum(axis=2) > 0).mean() > 0.99
    layer.release()
    layer.release()


def flat_blades(count: int = 400) -> Blades:
    field = HeightField(np.full((5, 5), 1.0, np.float32), 4.0, 0.5)
    return sow(field, count, 3, 1.5, (2.0, 3.0))


def test_as_many_blades_stand_on_land_as_asked_for() -> None:
    heights = np.ones((5, 5), np.float32)
    heights[:, :3] = 0.0
    blades = sow(HeightField(heights, 4.0, 0.5), 300, 1, 1.0)
    assert len(blades.positions) == 300
    assert (blades.positions[:, 0] > 2.0).all()


def test_visible_blades_are_near_and_in_front_of_the_eye(stage: Stage) -> None:
    blades = flat_blades()
    with stage.frame(small(), Pose(2.0, 1.1, 2.0, 90.0)) as frame:
        chosen = visible(blades, frame)
    x, z = blades.positions[:, 0], blades.positions[:, 2]
    wanted = (np.hypot(x - 2.0, z - 2.0) < 1.5) & (x > 2.0)
    assert set(chosen.tolist()) == set(np.flatnonzero(wanted).tolist())


def test_the_four_ways_draw_the_same_picture(stage: Stage) -> None:
    blades = flat_blades()
    green = np.tile(np.array([[[40, 220, 60]], [[90, 40, 10]]], np.uint8), (2, 4, 1))
    texture = Texture(green, repeat=False)
    pictures = []
    with stage.frame(small(), Pose(2.0, 1.05, 3.0, 0.0), kt=13.0, fog=True) as frame:
        for way in WAYS:
            drawn = way(blades, texture)
            for _ in range(2):
                clear()
                drawn.draw(frame)
            pictures.append(stage.read())
            drawn.release()
            drawn.release()
    texture.release()
    bare = np.abs(pictures[0] - pictures[0][0, 0]).sum(axis=2) > 30
    assert bare.mean() > 0.02, "no grass in the picture"
    for picture in pictures[1:]:
        assert np.array_equal(picture, pictures[0])


def test_the_loop_of_2006_makes_a_call_for_every_vertex_and_the_arrays_one(stage: Stage) -> None:
    from framelens.gl.seam import recording

    blades = flat_blades(50)
    texture = Texture(np.full((4, 4, 3), 200, np.uint8))
    with stage.frame(small(), Pose(2.0, 1.05, 2.0, 0.0)) as frame:
        count = len(visible(blades, frame))
        for way, name, wanted in (
            (OneByOne, "glVertex3f", 5 * count),
            (FromClientMemory, "glDrawElements", 1),
        ):
            with recording() as recorder:
                way(blades, texture).draw(frame)
            assert sum(call.name == name for call in recorder.calls) == wanted
    texture.release()


def test_the_wind_moves_the_three_top_vertices() -> None:
    blades = flat_blades(10)
    moved = bent(blades, np.arange(10), 5.0) - blades.vertices
    assert (moved[:, :2] == 0).all()
    assert (moved[:, :, 1] == 0).all()
    assert np.allclose(moved[:, 2], moved[:, 4] / 2, atol=1e-6)
    assert (np.abs(moved[:, 4, [0, 2]]).max(axis=1) > 0).all()


LONG_RUN = """
import json, sys
import numpy as np
sys.path.insert(0, sys.argv[1])
from stage import live_names
from landscape.frame import Pose
from framelens.gl.seam import gl
from landscape.offscreen import Offscreen

def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * 4096

def names():
    buffers = [n for n in range(1, 200) if gl.glIsBuffer(n)]
    queries = [n for n in range(1, 200) if gl.glIsQuery(n)]
    return [sorted(s) for s in live_names()] + [buffers, queries]

with Offscreen((96, 64), "best", json.loads(sys.argv[2]), samples=0) as offscreen:
    offscreen.look("fig35i")
    rng = np.random.default_rng(1)
    size = offscreen.scene.settings.ground.size
    def walk(frames):
        for kt in range(frames):
            x, z = rng.random(2) * size
            y = float(offscreen.scene.height(x, z)) + 0.1
            yaw, pitch = rng.uniform(0, 360), rng.uniform(-30, 20)
            offscreen.moment = type(offscreen.moment)(
                Pose(float(x), y, float(z), yaw, pitch), (96, 64), float(kt), stroke=kt % 5)
            offscreen.draw()
    walk(50)
    before, sizes = names(), [resident()]
    for _ in range(5):
        walk(50)
        sizes.append(resident())
    print(json.dumps({"names": [before, names()], "sizes": sizes}))
"""

GROWTH = 1 << 19  # chosen: bytes per 50 frames; what the grass of all views takes is far less


@pytest.mark.slow
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads /proc")
@pytest.mark.seldom(14, first=12)
def test_300_frames_of_changing_views_leak_neither_memory_nor_objects() -> None:
    settings = SMALL_BEST
    command = [sys.executable, "-c", LONG_RUN, str(TESTS), json.dumps(settings)]
    done = subprocess.run(
        command, capture_output=True, text=True, timeout=SECONDS, env=environment(), check=False
    )
    assert done.returncode == 0, done.stderr
    answer = json.loads(done.stdout)
    assert answer["names"][0] == answer["names"][1]
    # A texture made when first looked at is a step; a leak grows in every fifty frames.
    assert np.median(np.diff(answer["sizes"])) < GROWTH


@pytest.mark.seldom(13, first=11)
def test_names_of_gl_objects_are_all_released(stage: Stage) -> None:
    before = live_names()
    with stage.borrowed():
        options = bench.Options(settings=LIGHT, size=stage.size)
        kind, view = find_view("fig35i")
        island = kind.open(options.values(kind, view), Assets(), SEED, kind.elements)
        bench.draw_view(view, island, set(kind.elements), options)
        island.release()
    assert live_names() == before


def test_a_view_below_the_ground_of_another_island_is_measured_above_it() -> None:
    drawn: list[Moment] = []
    hill = SimpleNamespace(settings=preset("2006"), height=lambda x, z: 9.0, draw=drawn.append)
    bench.draw_view(find_view("fig35a")[1], cast(OpenScene, hill), set(), bench.Options())
    assert drawn[0].pose.y == 9.0 + preset("2006").walk.eye


def test_frames_are_those_of_a_walk() -> None:
    drawn: list[Moment] = []
    flat = SimpleNamespace(settings=preset("2006"), height=lambda x, z: 0.0, draw=drawn.append)
    for arriving in (False, True):
        given = find_view("fig35a")[1], cast(OpenScene, flat), set[str](), bench.Options()
        bench.draw_view(*given, arriving=arriving)
    assert [moment.walking for moment in drawn] == [True, True]


@pytest.mark.seldom(14, first=4)
def test_brightness_and_contrast_are_timed_both_ways_in_the_hall_alone() -> None:
    options = bench.Options(("hall_contrast",), (64, 48), rounds=1, starts=0)
    names: list[str] = []
    result = bench.measure(options, names.append)
    assert len(names) == bench.steps(options)
    rows = result["tone"]
    assert [(row["brightness"], row["contrast"], row["area"]) for row in rows] == [*CASES]
    for row in rows:
        assert row["blend_ms"] > 0 and row["pixels_ms"] > 0
        assert row["ratio"] == row["pixels_ms"] / row["blend_ms"]
    assert "times as long" in bench.report(result) and result["grass"] == []
