"""Pictures read without the blocks of their coding: gradients become even, detail stays."""

import io
from pathlib import Path

import numpy as np
from PIL import Image

from landscape.files.images import read_image
from landscape.files.smooth import read_smooth, smoothed

HEIGHT, WIDTH = 96, 256


def gradient() -> np.ndarray:
    """Return a slow gradient (HEIGHT, WIDTH, 3), not rounded."""
    at = np.linspace(0.0, 1.0, WIDTH)[None, :, None] + np.linspace(0.0, 1.0, HEIGHT)[:, None, None]
    return np.array([90.0, 130.0, 190.0]) + at * np.array([6.0, 4.5, 3.0])


def coded(picture: np.ndarray) -> np.ndarray:
    buffer = io.BytesIO()
    image = Image.fromarray(np.rint(picture).astype(np.uint8))
    image.save(buffer, "JPEG", quality=85, subsampling=0)
    return np.asarray(Image.open(io.BytesIO(buffer.getvalue())))


def over_blocks(difference: np.ndarray) -> np.ndarray:
    """Return the means over squares of 4 x 4 texels, which the eye sees as an area."""
    return difference.reshape(HEIGHT // 4, 4, WIDTH // 4, 4, 3).mean(axis=(1, 3))


def test_a_gradient_has_smaller_steps_than_its_coding_left() -> None:
    steps = [
        np.abs(np.diff(over_blocks(picture - gradient()), axis=1)).max()
        for picture in (coded(gradient()), smoothed(coded(gradient())))
    ]
    assert steps[0] > 0.9 and steps[1] < 0.7 * steps[0]


def test_a_gradient_keeps_its_colours_at_the_edges() -> None:
    plain = np.rint(gradient()).astype(np.uint8)
    off = smoothed(plain) - gradient()
    for edge in (off[0], off[-1], off[:, 0], off[:, -1]):
        assert np.abs(edge).max() < 1.5 and np.abs(edge.mean(axis=0)).max() < 0.3


def test_what_has_contrast_stays_as_it_is() -> None:
    noise = np.random.default_rng(3).integers(60, 200, (32, 64, 3)).astype(np.uint8)
    assert (smoothed(noise) == noise).mean() > 0.98
    step = np.full((32, 64, 3), 100, np.uint8)
    step[:, 32:] = 140
    assert np.abs(smoothed(step).astype(int) - step).max() <= 1


def test_only_jpegs_are_smoothed(tmp_path: Path) -> None:
    Image.fromarray(coded(gradient())).save(tmp_path / "a.png")
    Image.fromarray(np.rint(gradient()).astype(np.uint8)).save(tmp_path / "a.jpg", quality=85)
    lossless, lossy = tmp_path / "a.png", tmp_path / "a.jpg"
    assert (read_smooth(lossless) == read_image(lossless, "RGB")).all()
    assert (read_smooth(lossy) != read_image(lossy, "RGB")).any()
