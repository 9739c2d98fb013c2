"""Fewer pixels than the window has, stretched over it, and interlaced frames, which add up."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from stage import SIZE, SMALL, SMALL_BEST, Stage

from framelens.gl.seam import gl
from landscape.elements.settings import preset
from landscape.files.assets import Assets
from landscape.frame import Detail, scaled
from landscape.island.island import Island
from landscape.scene.scene import Moment, find_view, placed
from landscape.settings.declare import with_settings
from landscape.walk.pace import STANDING, WALKING
from landscape.walk.stretch import Stretch, phase_shift, phases, stipple


@pytest.fixture
def stretch(stage: Stage) -> Iterator[Stretch]:
    made = Stretch()
    yield made
    made.release()
    made.release()


@pytest.fixture(scope="module")
def islands(the_stage: Stage, shipped: Assets) -> Iterator[dict[str, Island]]:
    the_stage.enter()
    opened = {
        name: Island(with_settings(preset(name), few), shipped)
        for name, few in (("2006", SMALL), ("best", SMALL_BEST))
    }
    yield opened
    for island in opened.values():
        island.release()


def moment(island: Island, view: str, size: tuple[int, int] = SIZE) -> Moment:
    named = find_view(view)[1]
    return Moment(placed(named.pose, island, island.settings.walk.eye), size, named.kt)


def drawn(
    stage: Stage, stretch: Stretch, island: Island, at: Moment, interlaced: bool = False
) -> np.ndarray:
    with stage.borrowed():
        stretch.draw(at, island.draw, interlaced)
        return stage.read()[-at.size[1] :, : at.size[0]]


@pytest.mark.parametrize("side", [2, 4])
def test_each_pixel_of_a_block_is_drawn_in_one_frame(side: int) -> None:
    order = phases(side)
    bits = [np.unpackbits(stipple(pixel, side)).reshape(32, 32) for pixel in order]
    assert len(order) == side * side and (np.sum(bits, axis=0) == 1).all()
    for (x, y), pattern in zip(order, bits, strict=True):
        assert pattern[y, x] == 1 and pattern.sum() == 1024 / side**2


@pytest.mark.parametrize("side", [2, 4])
def test_a_frame_moves_its_pixel_to_the_middle_of_the_block(side: int) -> None:
    for x, y in phases(side):
        right, up = phase_shift((x, y), side)
        assert (x + 0.5 + right, y + 0.5 + up) == (side / 2, side / 2)


@pytest.mark.seldom(10, first=4)
@pytest.mark.parametrize(("size", "side"), [(SIZE, 2), ((97, 61), 2), ((128, 96), 4)])
def test_interlaced_frames_add_up_to_the_picture_of_full_size(
    stage: Stage, stretch: Stretch, islands: dict[str, Island], size: tuple[int, int], side: int
) -> None:
    island = islands["2006"]
    at = moment(island, "fig35e", size)
    whole = drawn(stage, stretch, island, at)
    small = replace(at, detail=Detail(scale=1 / side))
    once = drawn(stage, stretch, island, small)
    for _ in phases(side):
        again = drawn(stage, stretch, island, small, interlaced=True)
    far, near = (np.abs(picture - whole).mean() for picture in (once, again))
    # Edges are not the same to the last bit; a picture that is only stretched is blurred.
    assert near < side / 2 and far > 3 * near
    assert (np.abs(again - whole).max(axis=2) > 16).mean() < 0.015


@pytest.mark.parametrize("name", ["2006", "best"])
@pytest.mark.parametrize("detail", [WALKING[-1].detail, Detail(scale=0.6), STANDING[3].detail])
@pytest.mark.sweep(3)
def test_a_stretched_picture_shows_the_same_place(
    stage: Stage, stretch: Stretch, islands: dict[str, Island], name: str, detail: Detail
) -> None:
    at = moment(islands[name], "fig35e")
    whole = drawn(stage, stretch, islands[name], at)
    small = drawn(stage, stretch, islands[name], replace(at, detail=detail))

    def blocks(picture: np.ndarray) -> np.ndarray:
        return picture.reshape(6, 20, 8, 20, 3).mean(axis=(1, 3))

    assert np.abs(blocks(whole) - blocks(small)).mean() < 3.0
    assert (whole != small).any()


def test_all_detail_is_drawn_into_the_window_itself(
    stage: Stage, stretch: Stretch, islands: dict[str, Island]
) -> None:
    at = moment(islands["best"], "fig35g")
    with stage.borrowed():
        islands["best"].draw(at)
        plain = stage.read()
    assert (drawn(stage, stretch, islands["best"], at) == plain).all()


def test_fewer_pixels_are_drawn(stage: Stage, stretch: Stretch, islands: dict[str, Island]) -> None:
    viewports = []

    def draw(at: Moment) -> None:
        islands["2006"].draw(at)
        viewports.append(gl.glGetIntegerv(gl.GL_VIEWPORT)[2:].tolist())

    at = moment(islands["2006"], "fig35e")
    with stage.borrowed():
        for scale in (1.0, 0.5, 0.3):
            stretch.draw(replace(at, detail=Detail(scale=scale)), draw, False)
        after = gl.glGetIntegerv(gl.GL_VIEWPORT)[2:].tolist()
    assert viewports == [[160, 120], [80, 60], [48, 36]] and after == [160, 120]


def test_a_scaled_side_is_rounded_up_and_never_zero() -> None:
    assert [scaled(n, s) for n, s in ((160, 0.5), (97, 0.5), (1, 0.31), (10, 0.7))] == [
        80,
        49,
        1,
        7,
    ]
