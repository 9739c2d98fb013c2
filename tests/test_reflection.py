"""The reflection: a mirror image where geometry puts it, lit alike, and only inside the water."""

import numpy as np
import pytest
from stage import Stage, close, pixel, project, quad, small

from framelens.gl.seam import gl
from framelens.gl.state import attrib
from landscape.elements.reflection import MIRROR, inside_water, mirrored
from landscape.elements.sun import lit
from landscape.elements.water_surface import WaterSurface
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.height_field import mirrored_height

LEVEL = 0.6
SETTINGS = small({"water.level": LEVEL})
POSE = Pose(0.0, 1.4, 0.0, 10.0, -8.0)
BACKGROUND = np.array([0.4, 0.6, 0.7]) * 255
RED = (255, 0, 0)


def board(x: float, y: float, z: float, half: float = 0.12) -> np.ndarray:
    """Return an upright square about a point, facing south."""
    corners = [(-half, -half), (half, -half), (half, half), (-half, half)]
    return np.array([(x + a, y + b, z) for a, b in corners])


def send(corners: np.ndarray, colour=(1.0, 0.0, 0.0)) -> None:
    with attrib(gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT):
        gl.glColor4f(*colour, 1.0)
        quad(corners)


def test_the_mirror_matrix_negates_y_and_applied_twice_is_the_identity() -> None:
    assert MIRROR.tolist() == np.diag([1.0, -1.0, 1.0, 1.0]).tolist()
    assert (np.eye(4) == MIRROR @ MIRROR).all()


def test_the_mirrored_height_is_as_far_below_the_water_as_the_height_is_above() -> None:
    assert mirrored_height(1.5, 0.6) == pytest.approx(-0.3)
    assert mirrored_height(np.array([0.6, 0.0]), 0.6) == pytest.approx([0.6, 1.2])
    assert mirrored_height(mirrored_height(3.0, 0.6), 0.6) == pytest.approx(3.0)


@pytest.mark.parametrize("place", [(0.3, 1.3, -3.0), (1.2, 0.9, -4.0), (-0.3, 1.4, -3.4)])
def test_an_object_and_its_mirror_image_are_where_projection_says(
    stage: Stage, place: tuple[float, float, float]
) -> None:
    x, y, z = place
    image = (x, 2 * LEVEL - y, z)
    with stage.frame(SETTINGS, POSE):
        with mirrored(SETTINGS):
            send(board(*place))
        alone = stage.read()
        send(board(*place), (0.0, 1.0, 0.0))
        both = stage.read()
    assert close(pixel(alone, project(POSE, image)), RED)
    assert close(pixel(alone, project(POSE, place)), BACKGROUND)
    assert close(pixel(both, project(POSE, place)), (0, 255, 0))
    for dx, dy in ((0.1, 0.1), (-0.1, 0.1), (0.1, -0.1), (-0.1, -0.1)):
        assert close(pixel(alone, project(POSE, (x + dx, image[1] + dy, z))), RED)
    for dx, dy in ((0.15, 0.0), (0.0, 0.15), (-0.15, 0.0), (0.0, -0.15)):
        assert close(pixel(alone, project(POSE, (x + dx, image[1] + dy, z))), BACKGROUND)


def test_what_is_under_water_is_not_mirrored_above_it(stage: Stage) -> None:
    with stage.frame(SETTINGS, POSE):
        with mirrored(SETTINGS):
            send(board(0.5, LEVEL, -3.0, 0.3))
        picture = stage.read()
    above = project(POSE, (0.5, LEVEL + 0.1, -3.0))
    below = project(POSE, (0.5, LEVEL - 0.1, -3.0))
    assert close(pixel(picture, above), BACKGROUND)
    assert close(pixel(picture, below), RED)


def test_front_faces_stay_front_faces_in_the_mirror(stage: Stage) -> None:
    for turned, shown in ((False, True), (True, False)):
        corners = board(0.3, 1.3, -3.0)[::-1] if turned else board(0.3, 1.3, -3.0)
        with stage.frame(SETTINGS, POSE):
            with mirrored(SETTINGS), attrib(gl.GL_ENABLE_BIT):
                gl.glEnable(gl.GL_CULL_FACE)
                send(corners)
            got = pixel(stage.read(), project(POSE, (0.3, 2 * LEVEL - 1.3, -3.0)))
        assert close(got, RED) == shown


def test_the_mirror_image_is_lit_as_the_object_is(stage: Stage) -> None:
    settings = small({"water.level": LEVEL, "sun.azimuth": 150.0, "sun.elevation": 50.0})
    # Seen from above and from below: a slanted board with a normal that has a height.
    place = (0.4, 1.2, -3.0)
    normal = np.array([0.0, 0.8, 0.6])

    def draw_board() -> None:
        with attrib(gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT):
            lit(settings.shading)
            gl.glNormal3f(*normal.tolist())
            gl.glColor4f(0.8, 0.8, 0.8, 1.0)
            quad(board(*place))

    with stage.frame(settings, POSE):
        draw_board()
        with mirrored(settings):
            draw_board()
        picture = stage.read()
    itself = pixel(picture, project(POSE, place))
    image = pixel(picture, project(POSE, (0.4, 2 * LEVEL - 1.2, -3.0)))
    assert itself[0] > 0.8 * 0.45 * 255 + 20, "the board should stand in the light"
    assert close(itself, image)


def reflect_a_wall(stage: Stage, mark, pose: Pose) -> np.ndarray:
    """Return the picture of the mirror image of a wide wall, wherever ``mark`` allows it."""
    with stage.frame(SETTINGS, pose):
        with inside_water(mark), mirrored(SETTINGS):
            send(board(0.0, 5.0 + LEVEL, -6.0, 5.0))
        return stage.read()


def test_no_reflected_pixel_falls_outside_the_water(stage: Stage) -> None:
    pond = np.array([(-1.0, LEVEL, -3), (0.5, LEVEL, -3), (0.5, LEVEL, -5), (-1.0, LEVEL, -5)])
    pose = Pose(0.0, 1.6, 0.0, 0.0, -15.0)

    def mark() -> None:
        quad(pond)

    with stage.frame(SETTINGS, pose):
        send(pond, (1.0, 1.0, 0.0))
        water = (stage.read() == (255, 255, 0)).all(axis=2)
    free = reflect_a_wall(stage, None, pose)
    kept = reflect_a_wall(stage, mark, pose)
    red = (kept == RED).all(axis=2)
    assert water.sum() > 500
    assert (red == water).all()
    assert ((free == RED).all(axis=2) & ~water).sum() > 500
    assert close(kept[~water], BACKGROUND), "marking must not paint"


def test_marking_the_water_writes_neither_colour_nor_depth(stage: Stage) -> None:
    pond = np.array([(-1.0, LEVEL, -3), (0.5, LEVEL, -3), (0.5, LEVEL, -5), (-1.0, LEVEL, -5)])
    pose = Pose(0.0, 1.6, 0.0, 0.0, -15.0)
    with stage.frame(SETTINGS, pose):
        with inside_water(lambda: quad(pond)):
            pass
        assert close(stage.read(), BACKGROUND)
        send(pond - (0.0, 0.1, 0.0))  # lower than the mark, so behind it
        assert ((stage.read() == RED).all(axis=2)).sum() > 500


def test_the_stencil_mark_of_the_water_covers_what_the_water_covers(
    stage: Stage, plain: Assets
) -> None:
    water = WaterSurface(SETTINGS, plain)
    pose = Pose(15.0, 70.6, 15.0, 0.0, -90.0)
    with stage.frame(SETTINGS, pose) as frame:
        with inside_water(water.mark):
            send(np.array([(-90.0, 3, 90), (90, 3, 90), (90, 3, -90), (-90, 3, -90)]))
        marked = (stage.read() == RED).all(axis=2)
    with stage.frame(SETTINGS, pose) as frame:
        water.draw(frame)
        drawn = (np.abs(stage.read() - BACKGROUND) > 1).any(axis=2)
    water.release()
    assert marked.sum() > 1000 and (marked != drawn).sum() <= 2


@pytest.mark.parametrize("block", [lambda: mirrored(SETTINGS), lambda: inside_water(lambda: None)])
def test_an_exception_inside_restores_the_state(stage: Stage, block) -> None:
    with stage.frame(SETTINGS, POSE):
        with pytest.raises(RuntimeError):
            with block():
                raise RuntimeError
