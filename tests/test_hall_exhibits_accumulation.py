"""The accumulated exhibits: means of samples, motion blur, depth of field and soft shadows."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from framelens.gl import extensions
from framelens.gl.seam import gl, recording
from landscape.frame import Pose
from landscape.geometry.planar import shadows_of
from landscape.gl.accumulating import disc, shifts
from landscape.hall import plan
from landscape.hall.exhibits import accumulation
from landscape.hall.exhibits.accumulation import Accumulation
from landscape.hall.exhibits.cabinet import Cabinet
from landscape.hall.exhibits.depth_of_field import lens
from landscape.hall.exhibits.niche import SOFT, lamp
from landscape.hall.exhibits.picture import part
from landscape.hall.exhibits.soft_shadow import receivers
from landscape.offscreen import Offscreen

SIZE = (160, 120)
RABBITS = (1.08, 0.14, 1.40, 270.0, -9.0)
MILL = (1.12, 0.15, 1.80, 270.0, -4.0)
RINGS = (1.10, 0.15, 2.20, 270.0, -5.0)
ONLY = ("room", "exhibits")


@pytest.fixture(scope="module")
def view() -> Iterator[Offscreen]:
    with Offscreen(SIZE, samples=0, place="hall", only=ONLY) as opened:
        yield opened


def picture(
    view: Offscreen,
    place: tuple[float, ...],
    kt: float = 20.0,
    wireframe: bool = False,
    **changed: Any,
) -> np.ndarray:
    """Return a picture with other settings of the exhibits, int16."""
    view.look(Pose(*place), kt, wireframe)
    values = view.scene.settings
    exhibits = type(values.exhibits)(**changed)
    view.scene.elements[Cabinet].take(type(values)(exhibits=exhibits))
    try:
        return view.draw().astype(np.int16)
    finally:
        view.scene.elements[Cabinet].take(values)


def colours(count: int) -> np.ndarray:
    """Return a colour for each sample, bytes (count, 4), opaque."""
    found = np.random.default_rng(5).integers(0, 256, (count, 4))
    found[:, 3] = 255
    return found


def mean_of(view: Offscreen, samples: np.ndarray, deep: bool) -> np.ndarray:
    """Return the mean (4,) that OpenGL makes of samples of one colour each (n, 4), in 0..255."""
    given, count = samples / 255, len(samples)

    def draw(number: int) -> None:
        gl.glColor4f(*given[number].tolist())
        gl.glRectf(-1.0, -1.0, 1.0, 1.0)

    with view.targeted():
        gl.glPushAttrib(gl.GL_ALL_ATTRIB_BITS)
        gl.glPushMatrix()
        gl.glLoadIdentity()
        sums = Accumulation(deep)
        sums.gather((200, 150), [np.eye(4)] * count, draw)
        with sums.mean.drawing(clear=False):
            read = gl.glReadPixels(100, 70, 1, 1, gl.GL_RGBA, gl.GL_FLOAT)
        sums.release()
        gl.glPopMatrix()
        gl.glPopAttrib()
    return np.asarray(read, float).ravel() * 255


@pytest.mark.parametrize("count", [1, 7, 64])
def test_the_sum_is_the_mean_of_its_samples(view: Offscreen, count: int) -> None:
    wanted = colours(count).mean(axis=0)
    assert np.abs(mean_of(view, colours(count), True) - wanted).max() < 0.1


def test_in_8_bits_the_roundings_of_the_samples_add_up(view: Offscreen) -> None:
    grey = np.full((64, 4), 90)
    assert np.abs(mean_of(view, grey, True) - 90).max() < 0.1
    # 90 / 64 = 1.4 is rounded to 1, 64 times.
    assert np.abs(mean_of(view, grey, False) - 64).max() < 0.1


@pytest.mark.seldom(10, first=7)
def test_a_mean_of_equal_samples_is_the_picture_itself(view: Offscreen) -> None:
    sharp = picture(view, MILL, blur_samples=1)
    still = picture(view, MILL, blur_samples=16, blur_shutter=0.0)
    # Its edges are smoother: the samples are moved by parts of a pixel.
    far = np.abs(still - sharp).max(axis=2) > 24
    assert far.mean() < 0.02


@pytest.mark.seldom(5)
def test_a_turning_sail_covers_a_pixel_for_its_part_of_the_time(
    view: Offscreen, monkeypatch: pytest.MonkeyPatch
) -> None:
    count, shutter = 8, 4.0
    # Without the movement within a pixel, the blurred picture is exactly the mean of pictures.
    monkeypatch.setattr(accumulation, "shifts", lambda n: np.zeros((n, 2)))
    blurred = picture(view, MILL, blur_samples=count, blur_shutter=shutter)
    times = 20.0 + shutter * ((np.arange(count) + 0.5) / count - 0.5)
    sharp = [picture(view, MILL, float(t), blur_samples=2, blur_shutter=0.0) for t in times]
    wanted = np.mean(sharp, axis=0)
    assert np.abs(sharp[0] - sharp[-1]).max() > 60
    assert np.abs(blurred - wanted).max() <= 2.0


def test_the_lens_leaves_the_plane_of_focus_where_it_is() -> None:
    focus = 0.37
    view_ = np.array([[1.2, 0, 0, 0], [0, 1.6, 0, 0], [0, 0, -1.01, -0.04], [0, 0, -1, 0]])
    rng = np.random.default_rng(1)
    points = np.column_stack([rng.uniform(-1, 1, (50, 2)), -rng.uniform(0.1, 2, 50), np.ones(50)])

    def seen(matrix: np.ndarray, of: np.ndarray) -> np.ndarray:
        clip = of @ (view_ @ matrix).T
        return clip[:, :2] / clip[:, 3:]

    offset = (0.013, -0.007)
    focused = points.copy()
    focused[:, 2] = -focus
    moved = seen(lens(offset, focus), focused) - seen(np.eye(4), focused)
    assert np.abs(moved).max() < 1e-6
    # The circle of confusion: offset * (1 / focus - 1 / distance), at distance 1.
    moved = seen(lens(offset, focus), points) - seen(np.eye(4), points)
    spread = (1 / focus + 1 / points[:, 2])[:, None] * np.array(offset) * (1.2, 1.6)
    np.testing.assert_allclose(moved, spread, atol=1e-9)
    unsheared = seen(lens(offset, focus, shear=False), focused) - seen(np.eye(4), focused)
    assert np.abs(unsheared).min() > 0.01


def detail(image: np.ndarray, columns: slice) -> float:
    """Return how strongly neighbouring pixels differ, in columns of the rows of the rabbits."""
    return float(np.abs(np.diff(image[42:78, columns].astype(float), axis=1)).mean())


@pytest.mark.seldom(3, first=2)
def test_only_the_middle_rabbit_is_sharp_and_without_the_shear_none(view: Offscreen) -> None:
    sharp = picture(view, RABBITS, focus_samples=32, focus_lens=0.0)
    right = picture(view, RABBITS, focus_samples=32)
    wrong = picture(view, RABBITS, focus_samples=32, focus_shear=False)
    near, middle = slice(44, 68), slice(72, 92)
    assert detail(right, near) < 0.75 * detail(sharp, near)
    assert detail(right, middle) > 0.8 * detail(sharp, middle)
    assert detail(wrong, middle) < 0.85 * detail(right, middle)


def test_points_of_disc_and_pixel_are_spread_evenly() -> None:
    for count in (1, 16, 64):
        radius = np.linalg.norm(disc(count), axis=1)
        assert radius.max() <= 1.0
        inner = (radius < np.sqrt(0.5)).mean()
        assert abs(inner - 0.5) <= 0.5 / count + 1e-9
    np.testing.assert_allclose(shifts(64).mean(axis=0), 0.0, atol=0.03)
    assert np.abs(shifts(64)).max() <= 0.5


def test_a_part_of_a_picture_holds_the_box_and_is_cut_out_exactly() -> None:
    clip = np.array([[1.0, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, -0.2], [0, 0, -1, 0]])
    found = part(clip, (-0.1, -0.2, -1.2), (0.3, 0.09, -1.0), (200, 100))
    assert found is not None
    assert found[:4] == (90, 40, 40, 15)
    enlarged = accumulation.cut(found, (200, 100))
    low = enlarged @ (-0.1, -0.2, 0.0, 1.0)
    high = enlarged @ (0.3, 0.1, 0.0, 1.0)
    assert np.allclose(low[:2], -1.0) and np.allclose(high[:2], 1.0)
    assert part(clip, (5.0, 0.0, -1.2), (6.0, 0.1, -1.0), (200, 100)) is None
    behind = part(clip, (-0.1, -0.2, -1.0), (0.3, 0.1, 1.0), (200, 100))
    assert behind is not None and behind[:4] == (0, 0, 200, 100)


def test_a_shadow_lies_in_its_texture_where_rays_meet_the_wall() -> None:
    points = np.array([[0.895, 0.15, plan.ALCOVES[SOFT]], [0.9, 0.12, plan.ALCOVES[SOFT] + 0.02]])
    light = np.array(lamp(SOFT))
    for receiver in receivers():
        clip = np.column_stack([points, np.ones(2)]) @ receiver.flattened(light).T
        assert (clip[:, 3] > 0).all()
        places = (clip[:, :2] / clip[:, 3:] + 1) / 2
        found = receiver.corner + places[:, :1] * receiver.along + places[:, 1:] * receiver.up
        plane = receiver.plane
        np.testing.assert_allclose(
            found, shadows_of(points, plane, np.array([*light, 1.0])), atol=1e-6
        )


def shade(view: Offscreen, **settings: Any) -> np.ndarray:
    """Return what the textures darken, 0..1, of the back wall."""
    picture(view, RINGS, **settings)
    with view.targeted():
        view.scene.elements[Cabinet]._exhibits[SOFT][1].textures[1].bind()
        read = gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RED, gl.GL_UNSIGNED_BYTE)
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
    return np.frombuffer(bytes(read), np.uint8) / 255


def test_one_point_throws_a_hard_shadow_and_many_a_soft_one_of_the_same_light(
    view: Offscreen,
) -> None:
    hard, soft = shade(view, soft_samples=1), shade(view, soft_samples=48)
    assert set(np.unique(hard)) == {0.0, 1.0}
    between = (soft > 0.05) & (soft < 0.95)
    assert between.mean() > 0.05 and (hard == 0.0).mean() > 0.01
    assert soft.min() < 0.8
    assert abs((1 - soft).mean() - (1 - hard).mean()) < 0.2 * (1 - hard).mean()


def test_a_wireframe_shows_the_wires_of_an_accumulated_model(view: Offscreen) -> None:
    without = picture(view, RABBITS, wireframe=True, focus=False)
    shown = np.abs(picture(view, RABBITS, wireframe=True) - without).max(2) > 20
    # Not only the outline of the rectangle that shows the mean.
    assert shown[40:80].mean() > 0.05


def test_a_shadow_that_was_made_in_a_wireframe_is_the_same(view: Offscreen) -> None:
    filled, other = shade(view, soft_samples=5), shade(view, soft_samples=4)
    assert np.abs(filled - other).max() > 0.01
    np.testing.assert_array_equal(shade(view, soft_samples=5, wireframe=True), filled)


def test_exhibits_out_of_view_or_far_away_are_not_accumulated(view: Offscreen) -> None:
    def uses(place: tuple[float, ...]) -> int:
        view.look(Pose(*place), 20.0)
        view.draw()
        with recording() as seen:
            view.draw()
        return sum(
            call.name == "glBindFramebuffer" and call.element == "exhibits" for call in seen.calls
        )

    assert uses(MILL) == 4
    assert uses((1.2, 0.15, 1.8, 90.0, 0.0)) == 0
    assert uses((2.15, 0.15, 2.7, 318.0, 0.0)) == 0


@pytest.mark.seldom(3, first=1)
def test_without_framebuffer_objects_the_exhibits_are_drawn_sharp(
    view: Offscreen, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    sharp = picture(view, MILL, blur_samples=1)
    monkeypatch.setattr(extensions, "version", lambda: (2, 1))
    monkeypatch.setattr(extensions, "extensions", frozenset)
    monkeypatch.setattr(extensions, "_told", set())
    with Offscreen(SIZE, samples=0, place="hall", only=ONLY) as older:
        older.look(Pose(*MILL), 20.0)
        drawn = older.draw()
    # The default framebuffer has other pixels at some edges.
    assert (np.abs(drawn.astype(int) - sharp).max(axis=2) > 8).mean() < 0.03
    assert "exhibits.blur" in capfd.readouterr().err
