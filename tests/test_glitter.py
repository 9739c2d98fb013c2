"""The sun's glints: where the sun is mirrored, in few triangles, and only ever brighter."""

import numpy as np
import pytest
from seaside import beach, drawn, grid_at
from stage import Stage

from landscape.elements.best.sea.eye_grid import triangles_of
from landscape.elements.best.sea.glitter import bright_triangles, sun_intensity
from landscape.files.assets import Assets
from landscape.frame import Pose


def test_the_glints_stand_where_the_sun_is_mirrored() -> None:
    grid = grid_at(Pose(20.0, 1.6, 30.0, 0.0, -38.0))
    low = np.radians(40.0)
    towards = np.array([0.0, np.sin(low), -np.cos(low)])
    flat = np.zeros(grid.x.shape, np.float32)
    intensity = sun_intensity(grid, flat, flat, towards, 0.15)
    row, column = np.unravel_index(int(intensity.argmax()), intensity.shape)
    assert intensity.max() == pytest.approx(1.0, abs=0.01)
    assert grid.x[row, column] == pytest.approx(20.0, abs=0.03)
    assert 30.0 - grid.z[row, column] == pytest.approx(1.0 / np.tan(low), abs=0.03)


def test_only_the_cells_that_may_glint_are_sent() -> None:
    intensity = np.zeros((6, 5))
    intensity[3, 2] = 1.0
    kept = bright_triangles(triangles_of(5, 6), intensity)
    assert kept.shape == (8, 3) and 17 in kept
    assert len(bright_triangles(triangles_of(5, 6), 0 * intensity)) == 0
    assert len(bright_triangles(triangles_of(5, 6), 0 * intensity + 1)) == 40


def test_glints_add_light_and_never_remove_any(stage: Stage, plain: Assets) -> None:
    changes = {"sun.elevation": 45.0, "sun.azimuth": 0.0, "water.textured": False}
    changes |= {"sun.diffuse": (1.0, 0.9, 0.8)}
    towards = Pose(20.0, 1.6, 30.0, 0.0, -45.0)
    deep = beach(edge=-30.0)
    dull = drawn(stage, plain, changes | {"water.glitter": 0.0}, towards, field=deep)[0]
    bright = drawn(stage, plain, changes | {"water.glitter": 0.5}, towards, field=deep)[0]
    more = bright - dull
    assert more.min() >= 0 and more.max() > 20
    changes |= {"water.color": (1.0, 1.0, 1.0, 1.0), "water.glitter": 0.5}
    assert drawn(stage, plain, changes, towards, field=deep)[0].min() == 255
