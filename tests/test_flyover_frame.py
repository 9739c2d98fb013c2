"""Frames of the fly-over: what is drawn, and that OpenGL is not needed for it."""

import math
import subprocess
import sys

import numpy as np
import pytest

from framelens.base.errors import InputError
from landscape.flyover import bresenham, frame
from landscape.flyover.camera import Camera
from landscape.flyover.height_field import HeightField, height_field
from landscape.flyover.settings import Settings
from landscape.settings.declare import with_settings

SIZE = (160, 120)


def hills(side: int = 64, seed: int = 1) -> HeightField:
    """Return smooth hills of some 20 units' height."""
    at = np.arange(side) / side * 2 * np.pi
    random = np.random.default_rng(seed)
    image = np.zeros((side, side))
    for k in (1, 2, 3, 5):
        for m in (1, 2, 4):
            a, b = random.uniform(0, 6, 2)
            image += np.outer(np.sin(k * at + a), np.sin(m * at + b)) / (k + m)
    image = (image - image.min()) / np.ptp(image) * 255
    return height_field(image, Settings().flyover)


@pytest.mark.seldom(3)
def test_a_frame_is_drawn_where_opengl_and_glfw_cannot_be_imported() -> None:
    program = """
import sys
sys.modules["OpenGL"] = sys.modules["glfw"] = None
import numpy as np
from landscape.flyover import frame
from landscape.flyover.camera import Camera
from landscape.flyover.height_field import height_field
from landscape.flyover.settings import Settings
flat = height_field(np.zeros((16, 16), np.uint8))
drawn = frame.draw(flat, Camera(0, 0, 80, 0, 0.3, 0), Settings(), (80, 60))
assert (drawn.picture[:14] == 255).all() and (drawn.picture[40:] == 0).any(axis=2).sum() > 100
"""
    subprocess.run([sys.executable, "-c", program], check=True)


def test_a_picture_shares_the_memory_of_the_opaque_rgba_that_a_texture_takes() -> None:
    drawn = frame.draw(hills(), Camera(10, 10, 90, 0, 0.3, 0.5), Settings(), SIZE)
    assert drawn.picture.shape == (120, 160, 3) and drawn.picture.dtype == np.uint8
    assert drawn.rgba.flags.c_contiguous and (drawn.rgba[..., 3] == 255).all()
    assert np.shares_memory(drawn.picture, drawn.rgba)


@pytest.mark.parametrize(
    ("changes", "message"),
    (
        ({"left": 2.0}, "setting flyover.left: expected less than flyover.right (1), not 2"),
        ({"bottom": 1.0}, "setting flyover.bottom: expected less than flyover.top (1), not 1"),
        ({"far": 1.0}, "setting flyover.near: expected less than flyover.far (1), not 1.5"),
    ),
)
def test_settings_that_contradict_each_other_are_refused(
    changes: dict[str, float], message: str
) -> None:
    settings = with_settings(Settings(), {f"flyover.{k}": v for k, v in changes.items()})
    with pytest.raises(InputError) as caught:
        frame.draw(hills(), Camera(0, 0, 50), settings, SIZE)
    assert str(caught.value) == message


def test_settings_that_are_not_numbers_are_refused() -> None:
    with pytest.raises(InputError, match=r"^setting flyover.near: expected a number"):
        with_settings(Settings(), {"flyover.near": float("nan")})


@pytest.mark.parametrize("size", ((0, 10), (10, 1 << 20), (10,), "wide"))
def test_sizes_that_are_none_are_refused(size: object) -> None:
    with pytest.raises(InputError, match=r"^size .*: expected"):
        frame.draw(hills(), Camera(0, 0, 50), Settings(), size)  # type: ignore[arg-type]


def one_by_one(field: HeightField, camera: Camera, size: tuple[int, int]) -> np.ndarray:
    """Return where a straightforward program draws the edges of all triangles of the image.

    Bool (height, width): each vertex by the document's formulas, each line by Bresenham's loop.
    """
    sx, sy, sz = map(math.sin, (camera.theta_x, camera.theta_y, camera.theta_z))
    cx, cy, cz = map(math.cos, (camera.theta_x, camera.theta_y, camera.theta_z))
    width, height = size
    right = width / height
    n = field.side
    heights = field.levels[0].astype(float)

    def transformed(i: int, j: int) -> tuple[float, float, float]:
        x = i - camera.x
        y = j - camera.y
        z = heights[j, i] - camera.z
        up = cy * z + sy * (sz * y + cz * x)
        aside = cz * y - sz * x
        return cy * (sz * y + cz * x) - sy * z, sx * up + cx * aside, cx * up - sx * aside

    def pixel(x: float, y: float, z: float) -> tuple[int, int]:
        across = width * ((y * 1.5 / x) - -right) / (right - -right)
        return math.ceil(across), math.ceil(height * (1 - ((z * 1.5 / x) - -1) / (1 - -1)))

    def cut(inside: tuple[float, ...], outside: tuple[float, ...]) -> tuple[float, float, float]:
        part = (1.5 - inside[0]) / (outside[0] - inside[0])
        y, z = (a + part * (b - a) for a, b in zip(inside[1:], outside[1:], strict=True))
        return 1.5, y, z

    picture = np.zeros((height, width), bool)
    for j in range(n):
        for i in range(n):
            corner, across = transformed(i, j), transformed(i + 1, j + 1)
            for other in (transformed(i + 1, j), transformed(i, j + 1)):
                for a, b in ((corner, other), (corner, across), (other, across)):
                    if a[0] < 1.5 and b[0] < 1.5:
                        continue
                    ends = a if a[0] >= 1.5 else cut(b, a), b if b[0] >= 1.5 else cut(a, b)
                    for x, y in bresenham.line(*pixel(*ends[0]), *pixel(*ends[1])):
                        if 0 <= x < width and 0 <= y < height:
                            picture[y, x] = True
    return picture


@pytest.mark.seldom(3, first=2)
def test_frames_are_those_of_a_program_that_draws_triangle_by_triangle() -> None:
    field = hills(16)
    random = np.random.default_rng(1)
    plain = dict.fromkeys(("mirror", "detail", "back_faces", "hidden_lines"), False)
    settings = with_settings(Settings(), {f"flyover.{k}": v for k, v in plain.items()})
    for _ in range(12):
        x, y = random.uniform(-4, 20, 2)
        angles = random.uniform((-0.4, -0.2, -4), (0.4, 0.8, 4))
        camera = Camera(x, y, float(field.height(x, y)) + random.uniform(-3, 20), *angles)
        drawn = (frame.draw(field, camera, settings, (80, 60)).picture == 0).all(axis=2)
        assert np.array_equal(drawn, one_by_one(field, camera, (80, 60))), camera
