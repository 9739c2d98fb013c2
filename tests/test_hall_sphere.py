"""What the gilded statue mirrors: generated coordinates, maps, what sticks to the eye."""

from typing import Any

import numpy as np
import pytest
from hall_pictures import HallPictures
from stage import Stage

from framelens.gl import extensions
from framelens.gl.extensions import Need, first_missing
from framelens.gl.seam import gl
from framelens.gl.texture import Texture
from landscape.frame import Pose
from landscape.gl.features import possible
from landscape.hall.environment import BALL, ball_directions, disc, sphere_coordinates
from landscape.offscreen import Offscreen
from landscape.walk.stretch import _biased


def unit(rng: np.random.Generator, count: int) -> np.ndarray:
    vectors = rng.normal(size=(count, 3))
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def generated(normals: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Return the s and t (n, 2) that OpenGL generates by GL_SPHERE_MAP, by feedback.

    The context is its own, as a feedback buffer cannot be taken back.
    """
    with Offscreen((8, 8), samples=0) as view, view._current():
        from OpenGL import GL  # after the context has chosen its platform

        Texture(np.zeros((2, 2, 3), np.uint8)).bind()
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glMatrixMode(gl.GL_PROJECTION)
        gl.glOrtho(-10, 10, -10, 10, -20, 20)
        for name in "ST":
            mode = gl.GL_SPHERE_MAP
            gl.glTexGeni(getattr(gl, f"GL_{name}"), gl.GL_TEXTURE_GEN_MODE, mode)
            gl.glEnable(getattr(gl, f"GL_TEXTURE_GEN_{name}"))
        GL.glFeedbackBuffer(20 * len(normals), GL.GL_4D_COLOR_TEXTURE)
        GL.glRenderMode(GL.GL_FEEDBACK)
        gl.glBegin(gl.GL_POINTS)
        for normal, place in zip(normals.tolist(), places.tolist(), strict=True):
            gl.glNormal3f(*normal)
            gl.glVertex3f(*place)
        gl.glEnd()
        points = GL.glRenderMode(GL.GL_RENDER)
    return np.array([point[1].texture[:2] for point in points])


def test_opengl_generates_the_specification_s_sphere_coordinates() -> None:
    rng = np.random.default_rng(6)
    normals, places = unit(rng, 60), rng.uniform(-8, 8, (60, 3))
    sight = places / np.linalg.norm(places, axis=1, keepdims=True)
    wanted = sphere_coordinates(normals, sight)
    np.testing.assert_allclose(generated(normals, places), wanted, atol=1e-5)


def test_a_mirror_ball_s_picture_is_the_inverse_of_the_sphere_coordinates() -> None:
    rng = np.random.default_rng(7)
    normals = unit(rng, 200)
    normals[:, 2] = np.abs(normals[:, 2])
    ahead = np.broadcast_to((0.0, 0.0, -1.0), normals.shape)
    places = 2 * sphere_coordinates(normals, ahead) - 1
    mirrored = ahead - 2 * normals * (normals * ahead).sum(axis=1, keepdims=True)
    np.testing.assert_allclose(ball_directions(places), mirrored, atol=1e-9)


def test_the_disc_faces_the_viewer_and_covers_the_sphere_map() -> None:
    places, triangles = disc()
    a, b, c = (places[triangles[:, k]] for k in range(3))
    (ax, ay), (bx, by) = (b - a).T, (c - a).T
    areas = (ax * by - ay * bx) / 2
    assert (areas >= -1e-12).all() and areas.sum() == pytest.approx(np.pi * 1.5**2, rel=0.01)


AROUND = [
    Pose(1.6, 0.2, 1.6),
    Pose(1.3, 0.25, 1.36, 62, 0),
    Pose(1.62, 0.3, 0.8, 183, -4),
]
SHOWN = ("room", "floor", "statue")


def pictures(draw: HallPictures, **statue: Any) -> list[np.ndarray]:
    settings = {f"statue.{name}": value for name, value in statue.items()}
    return [draw(pose, 20.0, SHOWN, settings) for pose in AROUND]


@pytest.mark.seldom(10)
def test_sphere_and_cube_map_mirror_the_same_hall_from_all_sides(
    stage: Stage, hall_pictures: HallPictures
) -> None:
    kinds = [pictures(hall_pictures, environment=kind) for kind in ("cube", "sphere")]
    for cube, sphere in zip(*kinds, strict=True):
        assert np.abs(cube - sphere).mean() < 3.0


@pytest.mark.seldom(12, first=7)
def test_a_sphere_map_that_is_not_made_anew_turns_with_the_viewer(
    stage: Stage, hall_pictures: HallPictures
) -> None:
    right, stuck = pictures(hall_pictures), pictures(hall_pictures, fresh=False)
    changes = [np.abs(a - b).mean() for a, b in zip(right, stuck, strict=True)]
    assert changes[0] == 0.0 and min(changes[1:]) > 0.5


@pytest.mark.seldom(5, first=2)
@pytest.mark.parametrize("first", ["a wireframe", "an interlaced frame"])
def test_the_kept_map_does_not_depend_on_the_frame_that_needs_it_first(
    first: str, hall_pictures: HallPictures
) -> None:
    pose, other = AROUND[2], AROUND[0]
    usual = hall_pictures(pose, 20.0, SHOWN)
    hall_pictures(other, 20.0, SHOWN)  # the map is another one now
    if first == "a wireframe":
        hall_pictures(pose, 20.0, SHOWN, wireframe=True)
    else:
        hall_pictures.stage.enter()
        with _biased(-2.0):
            hall_pictures(pose, 20.0, SHOWN)
    np.testing.assert_array_equal(hall_pictures(pose, 20.0, SHOWN), usual)


@pytest.mark.seldom(13, first=5)
def test_without_cube_maps_the_statue_stays_bronze_and_one_line_says_why(
    stage: Stage,
    hall_pictures: HallPictures,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    bronze = pictures(hall_pictures, environment="none")[0]
    monkeypatch.setattr(extensions, "version", lambda: (1, 2))
    monkeypatch.setattr(extensions, "_told", set())
    every = extensions.extensions
    monkeypatch.setattr(extensions, "extensions", lambda: every() - {"GL_ARB_texture_cube_map"})
    for _ in range(2):
        older = HallPictures(stage)
        np.testing.assert_array_equal(older(AROUND[0], 20.0, SHOWN), bronze)
        older.release()
    told = [line for line in capsys.readouterr().err.splitlines() if "statue" in line]
    assert len(told) == 1
    assert told[0].startswith("landscape: statue.environment: off, for this OpenGL has no OpenGL")


def test_what_is_missing_is_what_neither_version_nor_extension_has(
    monkeypatch: pytest.MonkeyPatch, stage: Stage
) -> None:
    stage.enter()
    assert possible("statue.environment") and BALL >= 2
    monkeypatch.setattr(extensions, "version", lambda: (1, 4))
    monkeypatch.setattr(extensions, "extensions", lambda: frozenset({"GL_EXT_fog_coord"}))
    assert extensions.has(Need((1, 4))) and extensions.has(Need((1, 5), ("GL_EXT_fog_coord",)))
    assert first_missing([Need((1, 3)), Need((3, 0), ("GL_x",))]) == Need((3, 0), ("GL_x",))
