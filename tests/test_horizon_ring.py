"""The horizon ring: it fills everything but the patches, in the patches' colour."""

import numpy as np
import pytest
from stage import WHITE_LIGHT, Stage, close, live_names, pixel, project, small, taken

from landscape.elements.best.sea.ring import HorizonRing, ring_grid
from landscape.elements.water_surface import WaterSurface
from landscape.files.assets import Assets
from landscape.frame import Pose

BACKGROUND = np.array([0.4, 0.6, 0.7]) * 255
FAR = {**WHITE_LIGHT, "water.textured": False, "water.horizon": 400.0}
COLOUR = 0.7 * np.array([0.2, 0.2, 0.4]) * 255 + 0.3 * BACKGROUND


def test_the_ring_fills_everything_but_the_patches() -> None:
    points, triangles = ring_grid((-10.0, 40.0), 300.0)
    a, b, c = (points[triangles[:, k]] for k in range(3))
    # x to the right and z down: counter-clockwise from above is negative in these axes.
    (ux, uz), (vx, vz) = (b - a).T, (c - a).T
    area = -(ux * vz - uz * vx) / 2
    assert (area > 0).all()
    assert area.sum() == pytest.approx(650.0**2 - 50.0**2)
    middle = (a + b + c) / 3
    assert not ((middle > -10) & (middle < 40)).all(axis=1).any()


def test_the_sea_extends_to_the_horizon_in_the_patches_colour(stage: Stage, plain: Assets) -> None:
    settings = small(FAR)
    ring = HorizonRing(settings, plain)
    high = Pose(20.0, 12.0, 20.0, 0.0, -10.0)
    row, column = 52, 80  # under the horizon, well beyond the patches
    with stage.frame(settings, high) as frame:
        ring.draw(frame)
        picture = stage.read()
    ring.release()
    assert close(picture[row, column], COLOUR)
    assert close(picture[40, column], BACKGROUND), "above the horizon there is no sea"


def test_ring_and_patches_leave_no_gap_and_overlap_nowhere(stage: Stage, plain: Assets) -> None:
    settings = small(FAR)
    ring, patches = HorizonRing(settings, plain), WaterSurface(settings, plain)
    above = Pose(40.0, 12.0, 20.0, 0.0, -90.0)  # over the border, at x = 40
    with stage.frame(settings, above) as frame:
        ring.draw(frame)
        alone = stage.read()
        patches.draw(frame)
        both = stage.read()
    ring.release()
    patches.release()
    assert close(pixel(alone, project(above, (38.0, 0.6, 20.0))), BACKGROUND)
    assert close(pixel(alone, project(above, (42.0, 0.6, 20.0))), COLOUR)
    assert close(both, COLOUR)


def test_a_ring_accepts_a_new_colour_and_refuses_a_new_shape(stage: Stage, plain: Assets) -> None:
    before = live_names()
    ring = HorizonRing(small(FAR), plain)
    changed = small({**FAR, "water.color": (1.0, 0.0, 0.0, 1.0)})
    assert not taken(ring, small({**FAR, "water.horizon": 300.0}))
    assert not taken(ring, small({**FAR, "water.level": 0.7}))
    assert taken(ring, changed)
    with stage.frame(changed, Pose(20.0, 12.0, 20.0, 0.0, -10.0)) as frame:
        ring.draw(frame)
        assert close(stage.read()[52, 80], (255, 0, 0))
    ring.release()
    ring.release()
    assert live_names() == before
