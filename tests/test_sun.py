"""The sun: its direction, and the light it gives a flat quad."""

import math

import numpy as np
import pytest
from stage import Stage, close, quad, small

from framelens.gl.seam import gl
from landscape.elements.settings import Shading, Sun
from landscape.elements.sun import direction, lit
from landscape.frame import Pose


@pytest.mark.parametrize(
    ("azimuth", "elevation", "towards"),
    [
        (0.0, 0.0, (0, 0, -1)),
        (90.0, 0.0, (1, 0, 0)),
        (180.0, 0.0, (0, 0, 1)),
        (270.0, 0.0, (-1, 0, 0)),
        (12.0, 90.0, (0, 1, 0)),
        (135.0, 45.0, (0.5, math.sqrt(0.5), 0.5)),
    ],
)
def test_the_suns_direction_is_that_of_the_compass(azimuth, elevation, towards) -> None:
    sun = Sun(azimuth=azimuth, elevation=elevation)
    assert direction(sun) == pytest.approx(towards, abs=1e-6)


def test_the_suns_direction_has_length_one() -> None:
    for azimuth in range(0, 360, 35):
        vector = direction(Sun(azimuth=azimuth, elevation=azimuth / 4))
        assert np.linalg.norm(vector) == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("yaw", [0.0, 70.0, 200.0])
@pytest.mark.parametrize("elevation", [90.0, 30.0, 5.0])
def test_a_lit_floor_shows_ambient_plus_diffuse_times_the_cosine(
    stage: Stage, elevation: float, yaw: float
) -> None:
    changes = {"sun.elevation": elevation, "sun.azimuth": 40.0}
    settings = small({**changes, "sun.ambient": (0.2, 0.3, 0.1), "sun.diffuse": (0.5, 0.6, 0.8)})
    corners = np.array([(-2.0, 0, 2), (2, 0, 2), (2, 0, -2), (-2, 0, -2)])
    with stage.frame(settings, Pose(0.0, 2.0, 0.0, yaw, -90.0)):
        gl.glPushAttrib(gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT)
        lit(Shading())
        gl.glColor4f(0.9, 0.8, 0.7, 1.0)
        gl.glNormal3f(0.0, 1.0, 0.0)
        quad(corners)
        gl.glPopAttrib()
        got = stage.read()[60, 80]
    cosine = math.sin(math.radians(elevation))
    light = np.array([0.2, 0.3, 0.1]) + np.array([0.5, 0.6, 0.8]) * cosine
    assert close(got, np.array([0.9, 0.8, 0.7]) * light * 255, 1.5)


@pytest.mark.parametrize("fill", [0.0, 0.5])
def test_a_wall_facing_away_from_the_sun_gets_ambient_and_fill_light(
    stage: Stage, fill: float
) -> None:
    """A wall that faces north, the sun in the south at the horizon."""
    ambient = (0.4, 0.3, 0.2)
    settings = small(
        {
            "sun.azimuth": 180.0,
            "sun.elevation": 0.0,
            "sun.fill": fill,
            "sun.ambient": ambient,
            "sun.diffuse": (0.5, 0.5, 0.5),
        }
    )
    with stage.frame(settings, Pose(20.0, 1.0, 17.0, 180.0, 0.0)), stage.borrowed():
        lit(Shading())
        gl.glNormal3f(0.0, 0.0, -1.0)
        gl.glColor3f(1.0, 1.0, 1.0)
        quad(np.array([(22.0, 0.0, 20.0), (18.0, 0.0, 20.0), (18.0, 2.0, 20.0), (22.0, 2.0, 20.0)]))
        got = stage.read()[60, 80]

    # The fill comes from the north, half as high as far.
    cosine = 1.0 / math.hypot(1.0, 0.5)
    assert close(got, np.array(ambient) * (1.0 + fill * cosine) * 255, 2)


FLOOR = np.array([(-2.0, 0, 2), (2, 0, 2), (2, 0, -2), (-2, 0, -2)])


def floor(stage: Stage, normals: list[tuple[float, float, float]], **shading: bool) -> np.ndarray:
    """Draw a grey floor as two lit triangles, seen from above; return its picture."""
    settings = small({"sun.elevation": 90.0, "sun.ambient": (0, 0, 0), "sun.diffuse": (1, 1, 1)})
    with stage.frame(settings, Pose(0.0, 2.0, 0.0, 0.0, -90.0)):
        gl.glPushAttrib(gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT)
        lit(Shading(**shading))
        gl.glColor4f(0.8, 0.8, 0.8, 1.0)
        gl.glBegin(gl.GL_TRIANGLES)
        for corner in (0, 1, 2, 0, 2, 3):
            gl.glNormal3f(*normals[corner])
            gl.glVertex3f(*FLOOR[corner].tolist())
        gl.glEnd()
        gl.glPopAttrib()
        return stage.read()[40:80, 60:100]


TILTED = [(0.0, 1.0, 0.0), (0.6, 0.8, 0.0), (0.96, 0.28, 0.0), (0.8, 0.6, 0.0)]


def test_without_lighting_a_lit_element_has_its_plain_colour(stage: Stage) -> None:
    assert close(floor(stage, TILTED, lighting=False), np.array([0.8] * 3) * 255, 1)


def test_flat_shading_gives_each_triangle_the_light_of_its_last_vertex(stage: Stage) -> None:
    shades = {int(v) for v in np.unique(floor(stage, TILTED, smooth=False)[..., 0])}
    assert {round(v / 255, 2) for v in shades} == {round(0.8 * 0.28, 2), round(0.8 * 0.6, 2)}
    assert len(np.unique(floor(stage, TILTED)[..., 0])) > 10
