"""The fly-over's arithmetic: Bresenham's lines, the document's two formulas, clipping."""

import math

import numpy as np
import pytest

from framelens.base.errors import InputError
from landscape.flyover import bresenham
from landscape.flyover.camera import Camera, Frustum, camera_transform, frustum, project
from landscape.flyover.settings import Settings

SIZE = (64, 48)


def on_screen(pixels: list[tuple[int, int]], size: tuple[int, int]) -> list[int]:
    width, height = size
    return [y * width + x for x, y in pixels if 0 <= x < width and 0 <= y < height]


def differing(ends: np.ndarray, size: tuple[int, int]) -> list[list[int]]:
    """Return the lines (n, 4) whose pixels differ from those of the loop."""
    place, owner = bresenham.pixels(*ends.T, size)
    order = np.lexsort((place, owner))
    place = place[order]
    first = np.searchsorted(owner[order], np.arange(len(ends) + 1)).tolist()
    wrong = []
    for k, each in enumerate(ends.tolist()):
        if place[first[k] : first[k + 1]].tolist() != sorted(
            on_screen(bresenham.line(*each), size)
        ):
            wrong.append(each)
    return wrong


@pytest.mark.seldom(13)
def test_lines_are_those_of_the_loop_in_all_octants_clipped_and_degenerate() -> None:
    random = np.random.default_rng(5)
    ends = np.concatenate(
        [
            random.integers(-4, 12, (60_000, 4)),
            random.integers(0, 48, (20_000, 4)),
            random.integers(-60, 110, (19_000, 4)),
            np.repeat(random.integers(-2, 66, (1_000, 2)), 2, axis=0).reshape(-1, 4),
        ]
    )
    assert len(ends) == 100_000
    assert differing(ends[:60_000], (8, 8)) == []
    assert differing(ends[60_000:], SIZE) == []


def exact_pixels(x0: int, y0: int, x1: int, y1: int, size: tuple[int, int]) -> list[int]:
    """Return a long line's pixels on the screen, by Python's integers of any size."""
    steep = abs(y1 - y0) > abs(x1 - x0)
    if steep:
        x0, y0, x1, y1 = y0, x0, y1, x1
    n, m = abs(x1 - x0), abs(y1 - y0)
    found = []
    for x in range(size[1] if steep else size[0]):
        k = (x - x0) * (1 if x1 > x0 else -1)
        if 0 <= k <= n:
            y = y0 + (2 * k * m + n) // (2 * n) * (1 if y1 > y0 else -1)
            found.append((y, x) if steep else (x, y))
    return on_screen(found, size)


@pytest.mark.seldom(3)
@pytest.mark.parametrize("reach", (1 << 12, 1 << 20, 1 << 25, 1 << 30))
def test_lines_to_far_beyond_the_screen_keep_their_pixels_exactly(reach: int) -> None:
    random = np.random.default_rng(reach)
    # Through a point of the screen, so that most have pixels there.
    middle = random.integers(0, 48, (2000, 2))
    away = random.integers(-reach // 2, reach // 2, (2000, 2))
    scale = random.random((2000, 1))
    ends = np.clip(
        np.concatenate([middle + away, middle - np.rint(away * scale).astype(int)], axis=1),
        -reach,
        reach,
    )
    place, owner = bresenham.pixels(*ends.T, SIZE)
    assert len(np.unique(owner)) > 1000
    for k, each in enumerate(ends.tolist()):
        assert sorted(place[owner == k].tolist()) == sorted(exact_pixels(*each, SIZE)), each


def test_no_lines_have_no_pixels() -> None:
    none = np.zeros(0, np.int64)
    assert [len(each) for each in bresenham.pixels(none, none, none, none, SIZE)] == [0, 0]


def test_transform_and_projection_are_the_document_s_formulas() -> None:
    random = np.random.default_rng(7)
    volume, size = Frustum(), (1024, 768)
    for _ in range(300):
        xc, yc, zc = random.uniform(-500, 500, 3).tolist()
        tx, ty, tz = random.uniform(-math.pi, math.pi, 3).tolist()
        camera = Camera(xc, yc, zc, tx, ty, tz)
        points = random.uniform(-1000, 1000, (3, 20))
        away = points - np.array([[xc], [yc], [zc]])
        seen = np.stack(camera_transform(*away, camera))
        for (x, y, z), found in zip(points.T.tolist(), seen.T.tolist(), strict=True):
            ahead = math.sin(tz) * (y - yc) + math.cos(tz) * (x - xc)
            aside = math.cos(tz) * (y - yc) - math.sin(tz) * (x - xc)
            above = math.cos(ty) * (z - zc) + math.sin(ty) * ahead
            expected = (
                math.cos(ty) * ahead - math.sin(ty) * (z - zc),
                math.sin(tx) * above + math.cos(tx) * aside,
                math.cos(tx) * above - math.sin(tx) * aside,
            )
            assert found == pytest.approx(expected, abs=1e-9)
            if found[0] > volume.near:
                columns, rows = project(*(np.array([each]) for each in found), volume, size)
                across = 1024 * ((found[1] * 1.5 / found[0]) - -1) / (1 - -1)
                down = 768 * (1 - (((found[2] * 1.5 / found[0]) - -1) / (1 - -1)))
                assert (columns[0], rows[0]) == (math.ceil(across), math.ceil(down))


def test_the_middle_of_the_view_is_the_middle_of_the_picture_and_rows_go_down() -> None:
    x = np.full(3, 10.0)
    y = np.array([0.0, 1.0, 0.0])
    z = np.array([0.0, 0.0, 1.0])
    column, row = project(x, y, z, Frustum(), (1024, 768))
    assert (column.tolist(), row.tolist()) == ([512, 589, 512], [384, 384, 327])


def test_pixels_are_square_unless_the_document_s_near_rectangle_is_asked_for() -> None:
    settings = Settings().flyover
    assert frustum(settings, (1024, 768)).right == pytest.approx(4 / 3)
    assert frustum(settings.__class__(widen=False), (1024, 768)) == Frustum()


@pytest.mark.parametrize("value", (math.nan, math.inf, "2", None, True))
def test_a_camera_takes_finite_numbers_only(value: object) -> None:
    with pytest.raises(InputError, match=r"^camera's theta_y .*: expected a number$"):
        Camera(0, 0, 0, theta_y=value)  # type: ignore[arg-type]
