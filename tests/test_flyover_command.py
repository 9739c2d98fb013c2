"""`landscape flyover`: pictures and tables without a screen, and without OpenGL."""

import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from landscape.cli import main
from landscape.film.along import Software
from landscape.film.cut import Film
from landscape.flyover import frame
from landscape.flyover.app.bench import SWITCHES, TECHNIQUES, rows
from landscape.flyover.environment import open_environment
from landscape.flyover.settings import PRESETS, Settings
from landscape.settings.declare import with_settings

SMALL = ("--size", "64x48")
WITHOUT_OPENGL = """
import sys


class Absent:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in ("OpenGL", "OpenGL_accelerate", "glfw"):
            raise ImportError(name)


sys.meta_path.insert(0, Absent())
from landscape.cli import main

sys.exit(main(sys.argv[1:]))
"""


@pytest.mark.seldom(13)
def test_it_draws_where_neither_opengl_nor_glfw_can_be_imported(tmp_path: Path) -> None:
    words = ["flyover", *SMALL, "--frames", "2", "--out", str(tmp_path)]
    done = subprocess.run(
        [sys.executable, "-c", WITHOUT_OPENGL, *words], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.split() == [str(tmp_path / f"frame-0000{n}.png") for n in (0, 1)]


@pytest.mark.seldom(3)
def test_each_frame_is_drawn_from_its_own_time(tmp_path: Path) -> None:
    file = tmp_path / "a.png"
    words = ["flyover", *SMALL, "--fps", "0.5", "--frames", "3", "--out", str(tmp_path), "-q"]
    assert main(words) == 0 and main(["flyover", *SMALL, "--out", str(file), "-q"]) == 0
    values = with_settings(Settings(), PRESETS["best"])
    environment = open_environment("island")
    terrain = environment.field(values.flyover)
    flight = environment.flight(terrain, values.flyover)
    for name, seconds in (("frame-00000.png", 0), ("frame-00002.png", 4), ("a.png", 0)):
        with Image.open(tmp_path / name) as image:
            wanted = frame.draw(terrain, flight.camera(seconds), values, (64, 48)).picture
            assert np.array_equal(np.asarray(image), wanted), name


@pytest.mark.seldom(3, first=1)
def test_a_flight_to_files_begins_at_its_second_and_ends_with_the_flight(tmp_path: Path) -> None:
    environment = open_environment("island")
    last = math.floor(environment.duration(Settings().flyover)) - 1
    for words in (["--at", str(last), "--fps", "1"], ["--at", "4.5"]):
        out = tmp_path / ("a.png" if words[1] == "4.5" else "rest")
        assert main(["flyover", *SMALL, *words, "--out", str(out), "-q"]) == 0
    values = with_settings(Settings(), PRESETS["best"])
    terrain = environment.field(values.flyover)
    flight = environment.flight(terrain, values.flyover)
    count = round(flight.duration - last)
    assert len(list((tmp_path / "rest").iterdir())) == count <= 2
    for name, seconds in (("a.png", 4.5), (f"rest/frame-0000{count - 1}.png", last + count - 1)):
        with Image.open(tmp_path / name) as image:
            wanted = frame.draw(terrain, flight.camera(seconds), values, (64, 48)).picture
            assert np.array_equal(np.asarray(image), wanted), name


@pytest.mark.parametrize(("begin", "frames"), [("4.5", 60), ("41.57", 1)])
def test_a_film_begins_at_its_second(
    begin: str, frames: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    films: list[Film] = []

    def write(film: Film, *_: object) -> int:
        films.append(film)
        return film.frames

    monkeypatch.setattr("landscape.flyover.app.film.write", write)
    count = ["--frames", "60"] if frames == 60 else []
    words = ["--at", begin, *count, "--out", str(tmp_path / "a.mp4"), "-q"]
    assert main(["flyover", *SMALL, *words]) == 0
    clip = films[0].parts[0].clip
    assert isinstance(clip, Software) and clip.begin == float(begin)
    assert films[0].frames == frames


@pytest.mark.seldom(13, first=9)
def test_settings_come_from_the_preset_a_file_and_the_command_line(tmp_path: Path) -> None:
    table = tmp_path / "a.toml"
    table.write_text(
        "[flyover]\nmode = 'filled'\ncolours = 'phosphor'\n[filled]\ntexels = 256\n",
        encoding="utf-8",
    )
    pictures = []
    for words in (
        ("--preset", "document"),
        ("--settings", str(table)),
        ("--settings", str(table), "--set", "flyover.mode=lines"),
    ):
        assert main(["flyover", *SMALL, *words, "--out", str(tmp_path / "a.png"), "-q"]) == 0
        with Image.open(tmp_path / "a.png") as image:
            pictures.append(np.asarray(image).astype(int))
    plain, filled, phosphor = pictures
    assert set(np.unique(plain)) <= {0, 255}  # the document's black on white
    assert len(np.unique(filled.reshape(-1, 3), axis=0)) > 500
    assert (phosphor[..., 1] >= phosphor[..., 0]).all() and phosphor.max() > 80


def test_every_technique_is_measured_alone_left_out_and_together() -> None:
    found = rows(Settings())
    on = {
        name: {switch for switch in SWITCHES if getattr(values.flyover, switch.split(".")[1])}
        for name, values in found.items()
    }
    assert on["none"] == set() and on["all"] == set(SWITCHES)
    for name, (switch, *needed) in TECHNIQUES.items():
        assert on[f"only {name}"] == {switch, *needed}
        assert on[f"all but {name}"] >= set(SWITCHES) - {switch, "flyover.quad_tree"}
        assert switch not in on[f"all but {name}"]


@pytest.mark.seldom(14, first=10)
def test_the_bench_prints_and_writes_how_many_lines_each_technique_leaves(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "bench.json"
    words = ["--bench", "--frames", "1", "--jobs", "1", "--json", str(file)]
    assert main(["flyover", *SMALL, *words, "--set", "filled.texels=256"]) == 0
    measured = json.loads(file.read_text())
    by = measured["rows"]
    assert (measured["environment"], measured["size"], measured["side"]) == (
        "island",
        [64, 48],
        512,
    )
    assert by["only strips"]["considered"] * 2 == by["none"]["considered"]
    assert by["only back faces"]["lines"] < by["none"]["lines"]
    assert by["only quad-tree"]["boxes"] < by["only bounding volumes"]["boxes"]
    assert by["all"]["considered"] * 20 < by["none"]["considered"]
    assert by["all, hidden lines removed"]["pixels"] < by["all"]["pixels"]
    assert all(row["ms"] > 0 and row["alone_ms"] > 0 for row in by.values())
    printed = capsys.readouterr().out.splitlines()
    assert len(printed) == 2 + len(by) and f"{by['none']['considered']:,}" in printed[2]
    assert measured["processes"] == 1 and printed[0].endswith("processes: 1")


@pytest.mark.seldom(3, first=1)
def test_the_island_is_written_as_an_environment_and_flown(tmp_path: Path) -> None:
    file = tmp_path / "mine.svg"
    assert main(["flyover", "export", str(file), "-q"]) == 0
    for name in ("island", str(file)):
        assert main(["flyover", name, *SMALL, "--out", str(tmp_path / "a.png"), "-q"]) == 0


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("none.svg",), "none.svg: cannot be read (No such file or directory)"),
        (("mountains",), "mountains: expected a file that ends in .svg, or one of island"),
        (("island", "alps"), "flyover island alps: expected one environment"),
        (("export",), "flyover export: expected the name of the file to write"),
        (("export", "a.png"), "a.png: expected a name that ends in .svg"),
        (("export", "a.svg", "--bench"), "flyover export: expected neither --bench"),
        (("export", "a.svg", "--export", "b"), "flyover export: writes the island"),
        (("--fps", "0"), "--fps 0: expected a number above 0"),
        (("--fps", "nan"), "--fps: 'nan'"),
        (("--frames", "0", "--bench"), "--frames 0: expected a number from 1"),
        (("--frames", "-1", "--bench"), "--frames: '-1'"),
        (("--jobs", "0"), "--jobs: '0': expected a whole number from 1 to 256"),
        (("--at", "-1"), "--at -1: expected seconds from 0"),
        (("--at", "nan"), "--at: 'nan'"),
        (("--at", "noon"), "--at: 'noon'"),
        (("--at", "44", "--out", "a.png"), "--at 44: expected less than the 41.6 seconds"),
        (("--at", "3", "--bench"), "--at: not with --bench"),
        (("--json", "a.json"), "--json: expected --bench"),
        (("--bench", "--out", "a"), "--out: not with --bench"),
        (("--bench", "--json", "."), "--json .: expected a file, found a folder"),
        (("--out", "a.txt"), "--out a.txt: expected"),
        (("--frames", "2", "--out", "a.png"), "--out a.png: expected a folder"),
        (("--set", "flyover.far=nan"), "setting flyover.far: expected a number"),
        (("--set", "flyover.near=5000"), "setting flyover.near: expected"),
        (("--set", "fog.density=1"), "setting 'fog.density': no such key"),
        (("--preset", "mine"), "preset 'mine': expected one of document, best"),
        (("--size", "0x5"), "--size: '0x5'"),
        (("--out", "a.png", "--size", "99999x9"), "--size: '99999x9'"),
    ],
)
def test_bad_input_ends_in_one_line(
    words: tuple[str, ...],
    said: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["flyover", *words]) == 2
    told = capsys.readouterr()
    assert told.out == "" and told.err.count("\n") == 1 and said in told.err, told.err
    assert list(tmp_path.iterdir()) == []
