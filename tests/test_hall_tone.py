"""The hall's brightness and contrast: each pixel against scale * colour + bias."""

from collections.abc import Callable

import numpy as np
import pytest
from hall_pictures import HallPictures
from stage import Stage

from framelens.gl import extensions
from landscape.frame import Pose
from landscape.hall.tone import doublings
from landscape.offscreen import Offscreen

SHOWN = ("room", "floor", "statue", "tone")
Draw = Callable[..., np.ndarray]


@pytest.fixture
def picture(stage: Stage, hall_pictures: HallPictures) -> Draw:
    """Draws the hall with some settings of the group tone."""

    def draw(**tone: object) -> np.ndarray:
        settings = {f"tone.{name}": value for name, value in tone.items()}
        return hall_pictures("hall_mirror", only=SHOWN, settings=settings)

    return draw


@pytest.fixture
def plain(picture: Draw) -> np.ndarray:
    return picture()


def expected(plain: np.ndarray, brightness: float, contrast: float) -> np.ndarray:
    return np.clip(np.round(plain * contrast + 255 * brightness), 0, 255)


@pytest.mark.seldom(7, first=4)
@pytest.mark.parametrize("method", ["blend", "pixels"])
@pytest.mark.parametrize(
    ("brightness", "contrast"),
    [(0.3, 0.5), (-0.2, 0.8), (0.25, 1.0), (0.0, 1.6), (-0.3, 2.0), (0.2, 1.3), (1.0, 0.0)],
)
def test_each_pixel_is_scaled_and_biased(
    picture: Draw, plain: np.ndarray, method: str, brightness: float, contrast: float
) -> None:
    found = picture(method=method, brightness=brightness, contrast=contrast)
    assert np.abs(found - expected(plain, brightness, contrast)).max() <= 1.0
    assert np.abs(found - plain).max() > 20


@pytest.mark.seldom(3, first=2)
def test_above_a_contrast_of_2_the_bias_s_rounding_is_enlarged_by_the_contrast(
    picture: Draw, plain: np.ndarray
) -> None:
    error = np.abs(picture(brightness=-0.25, contrast=4.0) - expected(plain, -0.25, 4.0))
    assert error.max() <= 2.0


def test_without_doubling_contrast_stops_at_1(picture: Draw, plain: np.ndarray) -> None:
    np.testing.assert_array_equal(picture(contrast=1.8, doubling=False), plain)


@pytest.mark.parametrize("method", ["blend", "pixels"])
def test_a_part_of_the_picture_is_the_statue_or_all_else(
    picture: Draw, plain: np.ndarray, hall_pictures: HallPictures, method: str
) -> None:
    statue = (hall_pictures("hall_mirror", only=("room", "floor")) != plain).any(axis=2)
    assert 100 < statue.sum() < statue.size / 4
    for area, part in (("statue", statue), ("surroundings", ~statue)):
        found = picture(area=area, method=method, contrast=0.4)
        changed = np.abs(found - expected(plain, 0.0, 0.4)).max(axis=2) <= 1
        kept = (found == plain).all(axis=2)
        assert changed[part].all() and kept[~part].mean() > 0.98


def test_where_pixels_have_several_samples_they_are_blended_and_a_line_says_so(
    capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(extensions, "_told", set())
    changes = {"tone": {"method": "pixels", "contrast": 1.5}}
    for samples in (4, 0):
        with Offscreen(size=(64, 48), samples=samples, settings=changes, only=("tone",)) as view:
            view.look("hall_mirror")
            view.draw()
    told = capfd.readouterr().err.splitlines()
    assert len(told) == 1 and told[0].startswith("landscape: tone.method=pixels: blended, ")
    assert "--samples 0" in told[0]


def test_doublings_multiply_to_the_contrast_and_none_is_above_2() -> None:
    for scale in (1.0, 1.4, 2.0, 3.0, 4.0):
        assert np.prod(doublings(scale)) == pytest.approx(scale)
        assert max(doublings(scale)) <= 2.0


@pytest.mark.seldom(13)
def test_flames_shine_undimmed_before_dimmed_surroundings(
    stage: Stage, hall_pictures: HallPictures
) -> None:
    def drawn(*elements: str, **tone: object) -> np.ndarray:
        settings = {f"tone.{name}": value for name, value in tone.items()}
        settings["torches.glow"] = 1.0
        return hall_pictures("hall_mirror", 20.0, elements, settings)

    dark = drawn(*SHOWN, area="surroundings", contrast=0.0)
    lit = drawn(*SHOWN, "torches", area="surroundings", contrast=0.0)
    assert (lit - dark).max() > 200
    everything = drawn(*SHOWN, "torches", area="picture", contrast=0.0)
    assert everything.max() == 0


@pytest.mark.seldom(5, first=1)
def test_a_floor_seen_from_below_hides_the_statue_s_mark(hall_pictures: HallPictures) -> None:
    below = Pose(1.6, -0.3, 1.2, 0.0, 80.0)
    shown = (*SHOWN, "mirror")
    plain = hall_pictures(below, only=shown)
    dark = hall_pictures(
        below, only=shown, settings={"tone.area": "surroundings", "tone.contrast": 0.5}
    )
    assert np.abs(dark - expected(plain, 0.0, 0.5)).max() <= 1 and plain.max() > 20
