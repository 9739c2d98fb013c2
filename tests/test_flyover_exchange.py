"""The fly-over's exports, its profile, its ranking, and its memory."""

import gc
import json
import re
import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from framelens.base.errors import InputError
from landscape.cli import main
from landscape.flyover import exchange, frame
from landscape.flyover.app.ranking import ranking, read
from landscape.flyover.environment import open_environment
from landscape.flyover.settings import Settings

SMALL = ("--size", "64x48")


def test_an_exported_flight_is_flown_as_the_environment_that_it_was(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "alps"
    assert main(["flyover", "alps", "--export", str(folder), "--fps", "2"]) == 0
    written = capsys.readouterr().out.split()
    assert [Path(each).name for each in written] == [
        "heights.bmp",
        "heights.png",
        "path.json",
        "flight.csv",
    ]
    before, after = open_environment("alps"), exchange.read(folder)
    assert np.abs(before.image - after.image).max() < 1 / 257
    assert after.path.length == pytest.approx(before.path.length, abs=0.01)
    assert np.allclose(before.targets, after.targets, atol=1e-4)
    pictures = []
    for name in ("alps", str(folder)):
        file = tmp_path / "at.png"
        assert main(["flyover", name, "--at", "3", *SMALL, "--out", str(file), "-q"]) == 0
        with Image.open(file) as image:
            pictures.append(np.asarray(image).astype(int))

    assert (np.abs(pictures[0] - pictures[1]).max(axis=-1) > 0).mean() < 0.01


def test_the_data_of_a_flight_are_the_cameras_places_frame_by_frame(tmp_path: Path) -> None:
    environment, settings = open_environment("alps"), Settings().flyover
    exchange.write(environment, settings, tmp_path, 4.0)
    head, *lines = (tmp_path / "flight.csv").read_text().splitlines()
    assert head == exchange.HEAD
    flight = environment.flight(environment.field(settings), settings)
    assert len(lines) == round(flight.duration * 4.0)
    numbers = np.array([[float(each) for each in line.split(",")] for line in lines])
    camera = flight.camera(numbers[10, 0])
    angles = camera.theta_x, camera.theta_y, camera.theta_z
    assert numbers[10, 1:] == pytest.approx((camera.x, camera.y, camera.z, *angles), abs=1e-6)


def test_without_the_fine_heights_the_bmp_is_read(tmp_path: Path) -> None:
    environment = open_environment("alps")
    exchange.write(environment, Settings().flyover, tmp_path, 1.0)
    (tmp_path / "heights.png").unlink()
    assert np.abs(exchange.read(tmp_path).image - environment.image).max() <= 0.5


@pytest.mark.seldom(13, first=12)
@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("path.json", "{", "expected a path as"),
        ("path.json", '{"path": [], "targets": []}', "expected a path as"),
        ("path.json", '{"path": [[1, 2]], "targets": []}', "expected a path as"),
        ("heights.png", "", "heights.png"),
    ],
)
def test_a_damaged_folder_is_refused_by_one_line(
    name: str, content: str, said: str, tmp_path: Path
) -> None:
    exchange.write(open_environment("alps"), Settings().flyover, tmp_path, 1.0)
    (tmp_path / name).write_text(content)
    with pytest.raises(InputError) as caught:
        exchange.read(tmp_path)
    assert said in str(caught.value) and "\n" not in str(caught.value)


def test_an_empty_folder_is_no_environment(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"expected heights\.png or heights\.bmp in it"):
        exchange.read(tmp_path)


def test_a_profile_names_the_functions_that_take_the_time(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["flyover", "alps", "--profile", "--frames", "2", *SMALL, "-q"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("alps, 64x48, 2 frames along the path, one process\n")
    assert re.search(r"flyover/\w+\.py:\d+\(\w+\)", out)


def result(path: Path, fps: float, **changed: object) -> Path:
    found = {
        "environment": "alps",
        "hash": "ab" * 20,
        "version": "0.2.0",
        "size": [64, 48],
        "frames": 3,
        "machine": {"processor": "a fast one", "python": "3.11", "numpy": "2.0"},
        "rows": {"all": {"fps": fps, "ms": 1000 / fps}},
    }
    path.write_text(json.dumps(found | changed))
    return path


def test_results_are_ranked_for_each_environment_by_frames_a_second(tmp_path: Path) -> None:
    files = [
        result(tmp_path / "slow.json", 20.0),
        result(tmp_path / "fast.json", 90.0),
        result(tmp_path / "other.json", 50.0, environment="canyon"),
        result(tmp_path / "changed.json", 70.0, hash="cd" * 20),
    ]
    tables = ranking([read(file) for file in files]).split("\n\n")
    assert len(tables) == 3
    first = tables[0].splitlines()
    assert first[0].startswith("alps (abababab), 64x48, 3 frames")
    assert [line.rsplit(" ", 1)[1] for line in first[2:]] == ["fast.json", "slow.json"]


def test_numbers_that_are_texts_are_ranked_as_numbers(tmp_path: Path) -> None:
    path = result(tmp_path / "text.json", 20.0, rows={"all": {"fps": "20", "ms": "50"}}, frames="3")
    assert "20.0     50.0" in ranking([read(path)])


@pytest.mark.seldom(14, first=7)
def test_a_benchmark_s_result_can_be_ranked(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "mine.json"
    words = ["--bench", "--frames", "1", "--jobs", "1", "--set", "flyover.far=60", "-q"]
    assert main(["flyover", "alps", *SMALL, *words, "--json", str(file)]) == 0
    found = json.loads(file.read_text())
    assert found["hash"] == open_environment("alps").hash
    assert found["machine"]["processor"] and found["version"]
    assert main(["flyover", "--rank", str(file)]) == 0
    assert "mine.json" in capsys.readouterr().out


@pytest.mark.parametrize("content", ["", "[]", "{}", '{"rows": {"all": {}}}'])
def test_what_is_no_result_is_not_ranked(content: str, tmp_path: Path) -> None:
    file = tmp_path / "a.json"
    file.write_text(content)
    with pytest.raises(InputError, match=r"a\.json: expected a result of"):
        read(file)


@pytest.mark.parametrize("mode", ["lines", "filled"])
@pytest.mark.seldom(14, first=8)
def test_a_flight_keeps_no_memory_from_frame_to_frame(mode: str) -> None:
    from landscape.settings.declare import with_settings

    environment = open_environment("alps")
    settings = with_settings(Settings(), {"flyover.mode": mode})
    terrain = environment.field(settings.flyover)
    flight = environment.flight(terrain, settings.flyover)
    canvas = frame.Canvas(np.empty((48, 64), np.uint32))

    def fly(first: int, end: int) -> int:
        for number in range(first, end):
            camera = flight.camera(flight.duration * number / 40)
            frame.draw(terrain, camera, settings, (64, 48), None, canvas)
        gc.collect()
        return tracemalloc.get_traced_memory()[0]

    tracemalloc.start()
    try:
        after_one = fly(0, 40)  # once along all of the path: what is kept of it is kept then
        after_two = fly(0, 40)
    finally:
        tracemalloc.stop()
    assert after_two - after_one < 100_000  # bytes, for 40 frames
