"""What the pool's water mirrors: the box that stands for the hall, and the cube map it looks up."""

import numpy as np
import pytest
from hall_pictures import HallPictures
from stage import Stage

from framelens.gl import extensions
from landscape.frame import Pose
from landscape.hall import plan
from landscape.hall.pool import CEILING, CENTRE, WAVES, mirrored, surface, waves

ALONG = Pose(1.6, 0.12, 2.7, 0.0, -12.0)
SHOWN = ("room", "pool", "statue", "sky")


def test_a_calm_surface_mirrors_the_place_where_the_mirrored_line_meets_a_wall() -> None:
    vertices, _ = surface()
    eye = np.array([1.5, 0.2, 2.7])
    level = np.tile([0.0, 1.0, 0.0], (len(vertices), 1))
    places, _ = mirrored(vertices, level, eye)
    met = places + CENTRE
    below = eye * (1, -1, 1) + (0, 2 * plan.POOL_WATER, 0)  # the eye's own image
    across = np.cross(met - below, vertices - below)
    assert np.abs(across).max() < 1e-6
    inside = plan.INSIDE
    x, y, z = met.T
    faces = [x - inside.west, inside.east - x, z - inside.north, inside.south - z, CEILING - y]
    np.testing.assert_allclose(np.min(faces, axis=0), 0.0, atol=1e-9)


def test_water_mirrors_a_fiftieth_from_above_and_all_along_itself() -> None:
    vertices = np.array([[1.6, plan.POOL_WATER, 2.1]])
    level = np.array([[0.0, 1.0, 0.0]])
    _, above = mirrored(vertices, level, vertices[0] + (0.0, 1.0, 0.0))
    _, along = mirrored(vertices, level, vertices[0] + (0.0, 1e-6, 1.0))
    assert above[0] == pytest.approx(0.0204, abs=1e-4) and along[0] == pytest.approx(1.0, abs=1e-4)


def test_waves_tilt_the_normal_no_more_than_their_steepness_and_move() -> None:
    vertices, _ = surface()
    first, later = waves(vertices, 0.0), waves(vertices, 10.0)
    np.testing.assert_allclose(np.linalg.norm(first, axis=1), 1.0)
    tilt = np.hypot(first[:, 0], first[:, 2]) / first[:, 1]
    assert 0.01 < tilt.max() <= sum(steep for *_, steep in WAVES)
    assert np.abs(first - later).max() > 0.005


@pytest.mark.seldom(13, first=2)
def test_the_water_mirrors_the_golden_statue(stage: Stage, hall_pictures: HallPictures) -> None:
    without = tuple(name for name in SHOWN if name != "statue")
    shiny, dull = {"pool.mirrors": 2.0}, {"pool.mirrors": 0.0}
    golden, bare = (hall_pictures(ALONG, 20.0, shown, shiny) for shown in (SHOWN, without))
    water = (hall_pictures(ALONG, 20.0, without, dull) != bare).any(axis=2)
    assert water.sum() > 300
    assert (np.abs(golden - bare).max(axis=2)[water] > 20).sum() > 30


def test_without_cube_maps_the_water_mirrors_one_colour_and_one_line_says_why(
    stage: Stage, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(extensions, "version", lambda: (1, 2))
    monkeypatch.setattr(extensions, "_told", set())
    every = extensions.extensions
    monkeypatch.setattr(extensions, "extensions", lambda: every() - {"GL_ARB_texture_cube_map"})
    older = HallPictures(stage)
    plain = older(ALONG, 20.0, ("room", "pool"), {"pool.mirrors": 0.0})
    shiny = older(ALONG, 20.0, ("room", "pool"), {"pool.mirrors": 2.0})
    older.release()
    changed = (shiny != plain).any(axis=2)
    assert changed.sum() > 300
    told = [line for line in capsys.readouterr().err.splitlines() if "pool" in line]
    assert len(told) == 1
    assert told[0].startswith("landscape: pool.mirrors: off, for this OpenGL has no OpenGL")
