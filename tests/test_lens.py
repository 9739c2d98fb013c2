"""The camera's lens: what is out of focus is blurred, as the mean of pictures from its points."""

import itertools
import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from stage import SIZE, SMALL, Stage, live_names, project

from framelens.base.errors import InputError
from framelens.gl import features
from framelens.gl.seam import gl
from landscape.elements.best.sprites.slope_billboards import place_axes
from landscape.elements.settings import Camera, Fog, Settings, Sun
from landscape.frame import Frame, Pose, Tile
from landscape.offscreen import Offscreen
from landscape.scene.lens import Lens, axes, blur, points, through
from landscape.scene.scene import Moment, begin_frame, find_view

POSE = Pose(1.0, 2.0, 3.0, 40.0, -10.0)
FOCUS, FAR = 0.5, 4.0
CAMERA = Camera(lens=0.02, focus=FOCUS)


def place(distance: float, across: float = 0.0, rise: float = 0.0) -> np.ndarray:
    """Return the point at a distance in front of the eye, and to its right and above, (3,)."""
    right, up = axes(POSE)
    eye = np.array([POSE.x, POSE.y, POSE.z])
    return eye + distance * np.array(POSE.forward) + across * right + rise * up


def dots(*places: np.ndarray) -> Callable[[Moment], None]:
    """Return a function that draws a moment of a black world with white points of 3 pixels."""

    def draw(moment: Moment) -> None:
        begin_frame(moment, CAMERA, Sun(), Fog(color=(0.0, 0.0, 0.0)), fogged=False)
        gl.glDisable(gl.GL_LIGHTING)
        gl.glPointSize(3.0)
        gl.glBegin(gl.GL_POINTS)
        for each in places:
            gl.glVertex3f(*each.tolist())
        gl.glEnd()
        gl.glPointSize(1.0)

    return draw


def seen(stage: Stage, camera: Camera, draw: Callable[[Moment], None]) -> np.ndarray:
    """Return how much light each pixel has that a lens shows, (h, w), 0 to 1, top row first."""
    lens = Lens(SIZE)
    with stage.borrowed():
        lens.draw(Moment(POSE, SIZE), camera, draw)
        lens.release()
        return (stage.read()[..., 0] / 255) ** 2


def spread(picture: np.ndarray) -> float:
    """Return the root mean square distance in pixels of the light from its middle."""
    y, x = np.indices(picture.shape)
    whole = picture.sum()
    middle = (picture * x).sum() / whole, (picture * y).sum() / whole
    squares = (x - middle[0]) ** 2 + (y - middle[1]) ** 2
    return math.sqrt(float((picture * squares).sum() / whole))


@pytest.mark.parametrize("turn", [0.0, 30.0])
def test_right_and_up_are_those_of_the_modelview(stage: Stage, turn: float) -> None:
    pose = replace(POSE, roll=turn)
    with stage.borrowed():
        frame = begin_frame(Moment(pose, SIZE), CAMERA, Sun(), Fog())
    right, up = axes(pose)
    assert np.allclose(right, frame.right, atol=1e-6)
    assert np.allclose(up, frame.up, atol=1e-6)


def test_a_point_in_focus_stays_sharp_and_where_it_is(stage: Stage) -> None:
    point = place(FOCUS, 0.1, 0.05)
    picture = seen(stage, CAMERA, dots(point))
    column, row = project(POSE, tuple(point))
    y, x = np.unravel_index(picture.argmax(), picture.shape)
    assert abs(x + 0.5 - column) <= 1 and abs(y + 0.5 - row) <= 1
    assert picture.max() > 0.9 and spread(picture) < 1.5


@pytest.mark.parametrize("distance", [0.2, FAR])
def test_a_point_out_of_focus_becomes_a_disc_of_the_lens_times_the_difference(
    stage: Stage, distance: float
) -> None:
    picture = seen(stage, replace(CAMERA, lens_points=256), dots(place(distance)))
    radius = blur(CAMERA, SIZE[1], distance)
    expected = CAMERA.lens * abs(1 / FOCUS - 1 / distance) * SIZE[1] / 2 / math.tan(math.pi / 6)
    assert radius == pytest.approx(expected)
    # A full disc's mean square distance is half of its radius's square.
    assert spread(picture) == pytest.approx(radius / math.sqrt(2), rel=0.25)
    # No light is lost: the steps of 8 bits would have swallowed some of it.
    sharp = seen(stage, Camera(), dots(place(distance)))
    assert picture.sum() == pytest.approx(sharp.sum(), rel=0.2)


def test_without_a_lens_the_frame_is_drawn_once_as_it_is(stage: Stage) -> None:
    moments: list[Moment] = []
    seen(stage, Camera(), lambda moment: moments.append(moment))
    assert moments == [Moment(POSE, SIZE)]


def test_a_small_picture_takes_fewer_points(stage: Stage) -> None:
    small = replace(CAMERA, lens=0.012)
    assert points(small, 40) < points(small, 120) < CAMERA.lens_points
    assert points(CAMERA, 4000) == CAMERA.lens_points
    assert points(replace(CAMERA, lens_points=3), 4000) == 3
    assert len(list(through(Moment(POSE, SIZE), CAMERA))) == points(CAMERA, SIZE[1])


def test_the_frustum_of_a_shifted_picture_is_what_it_shows(stage: Stage) -> None:
    for moment in through(Moment(POSE, SIZE), CAMERA):
        with stage.borrowed():
            frame = begin_frame(moment, CAMERA, Sun(), Fog())
            matrix = np.array(gl.glGetDoublev(gl.GL_PROJECTION_MATRIX)).reshape(4, 4).T
        assert_bounds(frame, matrix)


def assert_bounds(frame: Frame, projection: np.ndarray) -> None:
    """Assert that points at the picture's edges lie in the planes that bound the view."""
    for plane, (x, y) in enumerate([(1, 0), (-1, 0), (0, 1), (0, -1)]):
        clip = np.linalg.inv(projection) @ [x, y, 0.5, 1.0]
        away = frame.to_world @ (clip[:3] / clip[3])
        assert abs(away @ frame.frustum_planes[:, plane]) < 1e-4 * np.linalg.norm(away)


def test_tiles_put_together_are_the_picture(stage: Stage) -> None:
    draw = dots(*(place(FAR, x, y) for x in (-1.0, 0.0, 1.0) for y in (-0.5, 0.5)))
    whole = seen(stage, CAMERA, draw)
    lens, half = Lens((SIZE[0] // 2, SIZE[1])), SIZE[0] // 2
    parts = []
    with stage.borrowed():
        for x in (0, half):
            moment = Moment(POSE, SIZE, tile=Tile(x, 0, (0, 0, *SIZE)))
            lens.draw(moment, CAMERA, draw)
            parts.append((stage.read()[..., :half, 0] / 255) ** 2)
        lens.release()
    assert np.abs(np.hstack(parts) - whole).max() <= 4 / 255


def test_no_state_is_left_and_nothing_kept(stage: Stage) -> None:
    before = live_names()
    with stage.frame(Settings(), POSE):
        lens = Lens(SIZE)
        lens.draw(Moment(POSE, SIZE), CAMERA, lambda moment: None)
        lens.release()
        lens.release()
    assert live_names() == before


def test_without_textures_of_floating_point_all_is_sharp_and_said(
    stage: Stage, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(features, "reason", lambda name: "this OpenGL lacks it")
    point = dots(place(FAR))
    assert (seen(stage, CAMERA, point) == seen(stage, Camera(), point)).all()
    assert "camera.lens: off, for this OpenGL lacks it" in capsys.readouterr().err


def test_an_even_grey_stays_as_it_is(stage: Stage) -> None:
    # In 8 bits each of the pictures would be rounded after its division.
    def draw(moment: Moment) -> None:
        begin_frame(moment, CAMERA, Sun(), Fog(color=(0.4, 0.4, 0.4)), fogged=False)

    assert np.abs(np.sqrt(seen(stage, CAMERA, draw)) - 0.4).max() <= 1 / 255


def test_a_mean_is_of_light_so_that_half_white_is_brighter_than_half_the_colour(
    stage: Stage,
) -> None:
    def draw(moment: Moment) -> None:
        # White from every second point of the lens, black from the others.
        bright = float(next(turns) % 2)
        begin_frame(moment, CAMERA, Sun(), Fog(color=(bright,) * 3), fogged=False)

    turns = itertools.count()
    camera = replace(CAMERA, lens_points=8)
    assert np.abs(np.sqrt(seen(stage, camera, draw)) - math.sqrt(0.5)).max() <= 1 / 255


def test_billboards_face_the_middle_of_the_lens_from_each_of_its_points(stage: Stage) -> None:
    for moment in through(Moment(POSE, SIZE), CAMERA):
        with stage.borrowed():
            frame = begin_frame(moment, CAMERA, Sun(), Fog())
        points = np.array([place(0.5), place(2.0, 0.3)])
        right, _ = place_axes(frame, points, upright=True)
        line = points - (POSE.x, POSE.y, POSE.z)
        assert np.abs((right * line).sum(axis=1)).max() < 1e-6


def test_a_walk_begins_with_its_own_angle_of_view() -> None:
    island, view = find_view("close_grass")
    assert view.settings["camera.fov"] == 20.0
    assert "camera.fov" not in island.as_walked(view, None).settings


def test_a_photograph_has_neither_sword_nor_map() -> None:
    island, view = find_view("close_peak")
    values = island.values(None, view.settings)
    assert values.camera.lens > 0
    assert set(island.shown(view)) - set(island.shown(view, None, values)) == {"sword", "map"}
    given = {"overlay.map_alpha": 0.5}
    assert list(island.notices(view, None, given)) == ["overlay.map_alpha"]
    assert island.notices(view, None, given, walking=True) == {}


def test_a_picture_too_large_for_the_mean_is_refused() -> None:
    lens = Lens((8192, 4096))
    with pytest.raises(InputError, match=r"size 8192x4096: .* 16777216 pixels .*--poster"):
        lens.draw(Moment(POSE, (8192, 4096)), CAMERA, lambda moment: None)
    lens.draw(Moment(POSE, (8192, 4096)), Camera(), lambda moment: None)


def test_a_recording_is_seen_from_the_middle_of_the_lens() -> None:
    ground = {**SMALL, "camera.lens": 0.05, "camera.focus": 0.1}
    with Offscreen(SIZE, "2006", ground, samples=0, only="ground") as view:
        with view.taped("fig4c") as tape:
            assert [call.name for call in tape.frame].count("glClear") == 1
        recorded, blurred = view.picture(tape.replay), view.draw()
    with Offscreen(SIZE, "2006", SMALL, samples=0, only="ground") as view:
        view.look("fig4c")
        sharp = view.draw()
    assert (recorded == sharp).all()
    assert np.abs(sharp.astype(int) - blurred).max() > 8
