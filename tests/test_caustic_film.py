"""The film of caustics: periodic in space and in time, of constant mean, a net and not dots."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from framelens.base.errors import InputError
from landscape.elements import caustic_film
from landscape.elements.caustic_film import SHEET, between, cut, sines
from landscape.files.assets import Assets, shipped
from landscape.files.images import read_image
from landscape.studio.asset_measures import seams


@pytest.fixture(scope="module")
def studio() -> Any:
    """The studio's module, if its extra is installed."""
    pytest.importorskip("scipy", reason="the extra `studio` is not installed")
    from landscape.studio.land import caustics

    return caustics


@pytest.fixture(scope="module")
def film() -> np.ndarray:
    return cut(read_image(shipped() / SHEET, "L"))


def brightest_part(frame: np.ndarray) -> float:
    """Return how much of the brighter third of a tile hangs together, 0..1, across its edges."""
    ndimage = pytest.importorskip("scipy.ndimage", reason="the extra `studio` is not installed")
    wide = np.tile(frame > np.quantile(frame, 0.67), (2, 2))
    parts, count = ndimage.label(wide, np.ones((3, 3)))
    sizes = np.bincount(parts.ravel())[1:]
    assert count == len(sizes) > 0
    return float(sizes.max() / sizes.sum())


def test_the_sheet_holds_32_frames_of_one_mean(film: np.ndarray) -> None:
    assert film.shape == (32, 128, 128)
    means = film.mean(axis=(1, 2))
    assert np.ptp(means) < 0.5
    assert 100 < means.mean() < 130, "twice the net keeps the mean light within a fifth"


def test_a_frame_has_no_seam(film: np.ndarray) -> None:
    for frame in film[::5]:
        assert all(seam.ok for seam in seams(frame[..., None]))


def test_the_last_frame_leads_to_the_first(film: np.ndarray) -> None:
    following = np.roll(film, -1, axis=0).astype(int)
    steps = np.abs(following - film).mean(axis=(1, 2))
    assert steps[-1] <= steps[:-1].max()


def test_the_light_is_periodic_in_time_and_never_stands_still(studio: Any) -> None:
    first = studio.light_on_bed(0.3)
    assert np.allclose(studio.light_on_bed(1.3), first, atol=1e-6)
    assert np.abs(studio.light_on_bed(0.8) - first).mean() > 0.2


def test_the_slopes_of_a_tile_are_those_of_its_waves_everywhere(studio: Any) -> None:
    k_x, k_y, passes, size = studio.sea(7)
    slope = studio.slopes(0.2, 64, 7)
    for x, y in ((3, 50), (3 - 64, 50), (3, 50 + 64)):
        phase = 2j * np.pi * (k_x * x / 64 + k_y * y / 64 - passes * 0.2)
        expected = (2j * np.pi * k_x * size * np.exp(phase)).sum().real
        assert slope[0, y % 64, x % 64] == pytest.approx(expected)


def test_a_ray_is_shared_by_the_four_texels_around_it(studio: Any) -> None:
    light = studio.gathered(np.array([[3.25], [7.5]]), 8)
    assert light.sum() == pytest.approx(64)
    shares = {(7, 3): 0.375, (7, 4): 0.125, (0, 3): 0.375, (0, 4): 0.125}
    for place, share in shares.items():
        assert light[place] == pytest.approx(64 * share)


def test_calm_water_lights_its_bed_evenly(studio: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(studio, "FOCUS", 0.0)
    assert np.allclose(studio.light_on_bed(0.0), 1.0)


def test_the_net_hangs_together_and_a_product_of_sines_does_not(film: np.ndarray) -> None:
    assert min(brightest_part(frame) for frame in film[::8]) > 0.5
    assert brightest_part(sines(32)[3]) < 0.1


def test_a_time_lies_between_two_frames() -> None:
    assert between(0.0, 32, True) == (0, 1, 0.0)
    first, second, mix = between(2.984375, 32, True)
    assert (first, second) == (31, 0) and mix == pytest.approx(0.5)
    assert between(2.984375, 32, False) == (31, 0, 0.0)
    assert between(-1e-20, 32, True)[0] in (0, 31)


def test_a_sheet_smaller_than_a_frame_is_refused_by_name(tmp_path: Path) -> None:
    Image.new("L", (40, 300)).save(tmp_path / SHEET)
    with pytest.raises(InputError, match=r"caustics\.png: .* 40x300"):
        caustic_film.shipped(Assets(tmp_path))
