"""A picture of the fly-over drawn in parts, some columns each: the same bytes."""

import numpy as np
import pytest

from landscape.flyover import frame
from landscape.flyover.camera import Camera
from landscape.flyover.height_field import HeightField, height_field
from landscape.flyover.noise import noise
from landscape.flyover.settings import Flyover, Settings
from landscape.settings.declare import Value, with_settings

SIZE = (160, 120)
HIDDEN: dict[str, Value] = {"flyover.colours": "height"}
FILLED: dict[str, Value] = {"flyover.mode": "filled", "filled.texels": 128, "filled.sea": 0.4}
ANGLES = {
    "level": (0.0, 0.0),
    "down": (0.0, 0.4),
    "up": (0.0, -0.3),
    "rolled": (0.6, 0.2),
    "to the ground": (0.0, 1.3),
}


def hills() -> HeightField:
    image = noise(64, 4, 1.9)
    image = (image - image.min()) / np.ptp(image) * 255
    return height_field(image, Flyover(relief=24.0))


@pytest.mark.sweep(12, first=6)
@pytest.mark.parametrize("changes", (HIDDEN, HIDDEN | {"flyover.hidden_lines": False}, FILLED))
@pytest.mark.parametrize("name", ANGLES)
def test_columns_drawn_alone_are_those_of_the_whole_picture(
    name: str, changes: dict[str, Value]
) -> None:
    settings = with_settings(Settings(), {"flyover.relief": 24.0} | changes)
    field, random = hills(), np.random.default_rng(len(name))
    for _ in range(2):
        x, y, yaw = random.uniform((0, 0, -3), (64, 64, 3))
        camera = Camera(x, y, float(field.height(x, y)) + 4, *ANGLES[name], yaw)
        whole = frame.draw(field, camera, settings, SIZE).rgba
        places = np.arange(frame.CUT, SIZE[0], frame.CUT)
        cuts = sorted(random.choice(places, 3, replace=False).tolist())
        canvas = frame.Canvas(np.zeros(SIZE[::-1], np.uint32))
        for first, end in zip([0, *cuts], [*cuts, SIZE[0]], strict=True):
            drawn = frame.draw(field, camera, settings, SIZE, range(first, end), canvas).rgba
        assert np.array_equal(drawn, whole), (camera, cuts)


def test_a_narrow_part_of_the_picture_takes_a_narrow_part_of_the_terrain() -> None:
    settings = with_settings(Settings(), HIDDEN)
    field, camera = hills(), Camera(20, 30, 34, 0, 0.2, 0.8)
    whole = frame.draw(field, camera, settings, SIZE).counts
    half = frame.draw(field, camera, settings, SIZE, range(81)).counts
    for what in ("tiles", "on screen", "pixels"):
        assert 0.35 * whole[what] < half[what] < 0.7 * whole[what], what
