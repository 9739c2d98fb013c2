"""Foam: between the beach and its greatest depth, periodic, moving, and over the water only."""

import numpy as np
from seaside import LEVEL, beach
from stage import Stage, live_names, project, small

from landscape.elements.best.sea import foam
from landscape.elements.best.sea.foam import Foam
from landscape.frame import Pose

DOWN = Pose(20.0, 3.6, 20.5, 0.0, -89.9)


def foamy(stage: Stage, kt: float) -> np.ndarray:
    """Return where foam whitens a black picture."""
    settings = small({"fog.color": (0.0, 0.0, 0.0)})
    element = Foam(settings, beach())
    with stage.frame(settings, DOWN, kt) as frame:
        assert stage.read().max() == 0
        element.draw(frame)
        white = stage.read().min(axis=2) > 100
    element.release()
    return np.asarray(white)


def test_foam_lies_between_the_beach_and_its_depth_and_moves(stage: Stage) -> None:
    white = foamy(stage, 0.0)
    rows = np.flatnonzero(white.any(axis=1))
    north = project(DOWN, (20, LEVEL, 20.0 - 10 * foam.LAND))[1]
    south = project(DOWN, (20, LEVEL, 20.0 + 10 * foam.DEEP))[1]
    assert white.sum() > 100
    assert north - 2 <= rows.min() and rows.max() <= south + 2
    assert (foamy(stage, 40.0) != white).sum() > 50
    assert (foamy(stage, foam.PERIOD) == white).all()


def test_foam_is_built_at_once_for_one_water_level_and_leaves_nothing(
    stage: Stage,
) -> None:
    before = live_names()
    element = Foam(small(), beach())
    made = live_names()
    assert element.apply(small({"fog.density": 0.3}))
    assert not element.apply(small({"water.level": LEVEL + 0.1}))
    with stage.frame(small(), DOWN) as frame:
        element.draw(frame)
    assert live_names() == made
    element.release()
    element.release()
    assert live_names() == before


def test_breakers_are_periodic_and_end_at_both_sides() -> None:
    picture = foam.breakers(64, 100)
    assert picture.min() >= 0 and picture.max() <= 1
    assert picture[0].max() == 0 and picture[-1].max() == 0
    steps = np.abs(np.diff(picture, axis=1)).max()
    assert np.abs(picture[:, 0] - picture[:, -1]).max() <= steps + 1e-9


def test_the_shore_is_the_grid_near_the_waters_edge_and_never_under_it() -> None:
    places, unit_0, _, triangles = foam.shore(beach())
    assert triangles.max() == len(places) - 1
    assert places[:, 1].min() >= LEVEL - 1e-6 and places[:, 1].max() <= LEVEL + foam.LAND + 1e-6
    assert places[:, 2].min() >= 19 and places[:, 2].max() <= 22
    at_edge = np.abs(places[:, 2] - 20.0) < 1e-6
    assert np.allclose(unit_0[at_edge, 1], foam.LAND / (foam.LAND + foam.DEEP), atol=1e-4)
