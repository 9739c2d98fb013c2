"""Environments by file and by name."""

from pathlib import Path

import numpy as np
import pytest
from environments import embedded, image, layer, path, png, svg, written

from landscape.errors import InputError
from landscape.flyover.environment import open_environment
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
            "image whose side is a power of two, such as",
        ),
        (svg(image(embedded(png(64, 32))), layer(path())), "such as 64x64, not 64x32"),
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
