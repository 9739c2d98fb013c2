"""What `bench --moving` measures: how far a walk's frames are from stills, and how they flicker."""

import json
from typing import Any

import numpy as np
import pytest
from commands import need_library, python
from stage import SMALL_BEST

from landscape.bench.moving import Picture, carried, flicker, means, off, report

TINY = {
    "views": ["fig35b", "fig35g"],
    "size": [96, 64],
    "settings": SMALL_BEST,
    "backend": "osmesa",
    "seconds": 0.6,
}


@pytest.fixture(scope="module")
def result() -> dict[str, Any]:
    """What is measured in a short walk on a light island."""
    need_library("OSMesa")
    code = (
        "import sys, json; from landscape.bench import moving as b;"
        f"print(json.dumps(b.measure(b.Options(**json.loads({json.dumps(json.dumps(TINY))})))))"
    )
    answer: dict[str, Any] = json.loads(python(code).out)
    return answer


@pytest.mark.seldom(12, first=1)
def test_each_view_has_its_figures(result: dict[str, Any]) -> None:
    assert list(result["moving"]) == TINY["views"]
    for view in result["moving"].values():
        assert set(view) == {"fps", "off", "rung", "fps_full", "flicker", "flicker_full"}
        assert view["fps"] > 0 and view["fps_full"] > 0
        assert 0 <= view["off"] < 0.5 and 0 <= view["rung"] <= 8
        assert 0 < view["flicker_full"] < 64
    assert "fig35g" in report(result) and "96x64" in report(result)


def test_what_differs_by_more_than_16_levels_in_the_mean_of_a_square_is_off() -> None:
    still = np.full((8, 16, 3), 100, np.uint8)
    walked = still.copy()
    walked[:4, :4, 1] += 16
    assert off(walked, still) == 0.0
    walked[:4, :4, 1] += 1
    assert off(walked, still) == 1 / 8
    walked[4:, 4:, 2] -= 17
    assert off(walked, still) == 4 / 8
    # One pixel alone, however far off, is no seventeenth of a square's mean.
    walked = still.copy()
    walked[0, 0] = 255
    assert off(walked, still) == 0.0


def test_means_are_those_of_whole_squares() -> None:
    pixels = np.arange(9 * 5 * 3, dtype=np.uint8).reshape(9, 5, 3)
    found = means(pixels)
    assert found.shape == (2, 1, 3)
    assert np.allclose(found[1, 0], pixels[4:8, :4].mean(axis=(0, 1)))


def picture(pixels: np.ndarray, shift: float) -> Picture:
    """Return what a camera that was moved to the right by ``shift`` sees of a wall at depth 0.5."""
    matrix = np.eye(4)
    matrix[0, 3] = -shift
    return Picture(pixels, np.full(pixels.shape[:2], 0.5, np.float32), matrix)


def test_a_picture_that_only_moves_does_not_flicker() -> None:
    rng = np.random.default_rng(3)
    wall = rng.integers(0, 255, (12, 40, 3), np.uint8)
    # 32 pixels are two units wide: four of them are a quarter.
    earlier, later = picture(wall[:, :32], 0.0), picture(wall[:, 4:36], 0.25)
    at = carried(earlier, later)
    assert np.isnan(at[:, -4:]).all() and not np.isnan(at[:, :-4]).any()
    assert np.allclose(at[3, 5], (3, 9))
    assert flicker(earlier.pixels, later.pixels, at) < 1e-3
    assert flicker(earlier.pixels, earlier.pixels, at) > 20


def test_what_was_hidden_in_the_frame_before_does_not_count() -> None:
    pixels = np.zeros((8, 8, 3), np.uint8)
    before = picture(pixels, 0.0)
    before.depths[2:4, 2:4] = 0.2
    assert np.isnan(carried(before, picture(pixels, 0.0))[..., 0]).sum() == 4
