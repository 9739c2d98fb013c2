"""Environments by file and by name."""

import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from environments import embedded, image, layer, path, png, svg, written

from framelens.base.errors import InputError
from landscape.flyover.environment import NAMES, export_island, open_environment
from landscape.flyover.settings import Flyover


def test_an_environment_has_a_terrain_and_a_flight_over_it(tmp_path: Path) -> None:
    file = written(tmp_path, svg(image(), layer(path("M 10,32 H 50"))))
    environment = open_environment(file)
    settings = Flyover(unit=2.0, smooth=0.0)
    field = environment.field(settings)
    assert environment.side == 64 and field.size == 128
    # The image is darker, so the land is higher, to the right.
    assert np.diff(field.height(np.array([5.0, 60, 120]), np.array([9.0, 9, 9]))).min() > 10
    flight = environment.flight(field, settings)
    start = flight.camera(0.0)
    assert (start.x, start.y) == (20, 64) and flight.duration == pytest.approx(80 / 20)
    assert start.z == pytest.approx(field.height(20.0, 64.0) + 2)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            svg(image(embedded(png(48))), layer(path())),
            "image whose sides are powers of two, such as",
        ),
        (svg(image(embedded(png(64, 48))), layer(path())), "such as 64x64, not 64x48"),
        (svg(image(), layer(path("M 10,10 H 65"))), "the path is outside the map"),
        (svg(image(), layer(path("M 1,1 C 1,-9 60,-9 60,1"))), "the path is outside the map"),
        (
            svg(image(), layer(path() + '<circle cx="-1" cy="4" r="1"/>')),
            "a point to look at is outside the map: expected x and y from 0 to 64",
        ),
        (svg(image(), layer(path("M 10,10 h 0.5"))), "expected a path of at least 1 pixel"),
    ],
)
def test_a_map_that_cannot_be_flown_over_is_refused(
    tmp_path: Path, text: str, expected: str
) -> None:
    file = written(tmp_path, text)
    with pytest.raises(InputError) as caught:
        open_environment(file)
    assert str(caught.value).startswith(f"{file}: ") and expected in str(caught.value)


def test_control_points_may_lie_outside_the_map(tmp_path: Path) -> None:
    text = svg(image(), layer(path("M 1,10 C 1,-3 60,-3 60,10")))
    assert open_environment(written(tmp_path, text)).path.length > 50


@pytest.mark.parametrize("name", ["no such", "picture.png", ""])
def test_what_is_no_environment_is_refused(name: str) -> None:
    with pytest.raises(InputError, match=r"expected a file that ends in \.svg, or one of island"):
        open_environment(name)


@pytest.mark.parametrize("name", NAMES)
def test_each_environment_that_comes_with_the_program_is_a_flight_near_the_ground(
    name: str,
) -> None:
    environment, settings = open_environment(name), Flyover()
    assert environment.side == 512 and environment.name == name
    field = environment.field(settings)
    assert field.highest - field.lowest > 50
    flight = environment.flight(field, settings)
    assert 30 < flight.duration < 90
    seen = [flight.camera(t) for t in np.linspace(0, flight.duration, 300)]
    above = [camera.z - field.height(camera.x, camera.y) for camera in seen]
    assert min(above) > 1.9 and np.mean(above) < 8
    # There is something to see: the land rises and falls along the way.
    assert np.ptp([camera.z for camera in seen]) > 1


@pytest.mark.seldom(3, first=1)
def test_the_island_is_exported_as_a_file_that_reads_back_equal(tmp_path: Path) -> None:
    export_island(tmp_path / "my island.svg")
    written, own = open_environment(tmp_path / "my island.svg"), open_environment("island")
    np.testing.assert_array_equal(written.image, own.image)
    np.testing.assert_array_equal(written.subpaths, own.subpaths)
    np.testing.assert_array_equal(written.targets, own.targets)
    # Inkscape shows its layers, and a note that says what they are.
    tree = ElementTree.parse(tmp_path / "my island.svg")
    label = "{http://www.inkscape.org/namespaces/inkscape}label"
    labels = [element.get(label) for element in tree.iter() if element.get(label)]
    assert labels == ["map", "camera", "targets"]
    assert any("camera" in (element.text or "") for element in tree.iter())


@pytest.mark.seldom(13, first=8)
def test_an_export_that_is_impossible_leaves_nothing(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("x")
    (tmp_path / "folder.svg").mkdir()
    for name in ("island.png", "file/island.svg", "folder.svg"):
        with pytest.raises(InputError, match=re.escape(str(Path(name)))):
            export_island(tmp_path / name)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "folder.svg"]


@pytest.mark.seldom(13, first=1)
def test_the_island_is_not_written_over_a_drawing(tmp_path: Path) -> None:
    path = tmp_path / "mine.svg"
    path.write_text("<svg/>")
    with pytest.raises(InputError, match=r"mine\.svg: is there already"):
        export_island(path)
    assert path.read_text() == "<svg/>"
    path.unlink()
    export_island(path)
    export_island(path)  # of its own it may be written again


def test_the_sea_of_the_island_is_white_and_the_summit_is_dark() -> None:
    image = open_environment("island").image
    assert (image[0] == image[0, 0]).all() and image[0, 0] == image.max() > 250
    row, column = np.unravel_index(image.argmin(), image.shape)
    assert abs(row - 128) < 12 and abs(column - 166) < 12
