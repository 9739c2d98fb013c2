"""Run-up: waves climb fast and drain slowly, sand dries more slowly than it wets."""

import numpy as np
import pytest
from seaside import LEVEL, beach, drawn
from stage import Stage

from landscape.elements.best.sea import run_up
from landscape.files.assets import Assets
from landscape.frame import Pose

DOWN = Pose(20.0, 1.6, 19.9, 0.0, -89.9)
WASH = {"water.textured": False, "water.foam": True}


def test_a_wave_rises_in_less_time_than_it_drains() -> None:
    time = np.linspace(0.0, 1.0, 200)
    reach = run_up.front(time)
    assert reach[0] < 0.01 and reach[-1] < 0.01 and reach.max() > 0.99
    assert time[reach.argmax()] < 0.4


def test_sand_dries_more_slowly_than_it_wets() -> None:
    wet = run_up.diagram().wet
    column = round((0.5 - run_up.FIRST) / (run_up.LAST - run_up.FIRST) * run_up.ACROSS)
    change = np.diff(wet[:, column], append=wet[0, column])
    assert change.max() > 5 * -change.min() > 0.0
    assert abs(wet[-1] - wet[0]).max() < 0.1  # the last row continues in the first


def test_lace_is_left_above_the_water_that_has_drained() -> None:
    place = np.linspace(0.0, 1.0, 101)
    rising, draining = run_up.foam_at(place, 0.1, 1.0), run_up.foam_at(place, 0.6, 1.0)
    edge = run_up.front(np.array([0.1, 0.6]))
    assert not rising[place > edge[0]].any()
    assert draining[(place > edge[1] + 0.02) & (place < 1.0)].min() > 0.0


def test_no_foam_appears_at_once_and_its_edge_is_frayed_by_lace() -> None:
    place = np.linspace(-0.5, 1.2, 200)
    for height in run_up.WAVES:
        before, after = (
            run_up.foam_at(place, run_up.RISING + step, height) for step in (-1e-3, 1e-3)
        )
        assert np.abs(after - before).max() < 0.03
    # Of lace, 0..0.5, some is added; where the sum is above one half there is foam.
    foam = run_up.diagram().foam
    assert 0.3 < foam.max() < 0.5
    # Foam grows by less than its least visible density in a step, but where a wave's edge is.
    grown = np.diff(foam, axis=0)
    assert (grown > 0.1).mean() < 0.01


def test_foam_that_a_wave_has_left_thins_out_until_the_next_one_takes_it() -> None:
    foam = run_up.diagram().foam
    place = run_up.FIRST + (np.arange(run_up.ACROSS) + 0.5) / run_up.ACROSS * (
        run_up.LAST - run_up.FIRST
    )
    rows = run_up.STEPS // len(run_up.WAVES)
    here = np.argmin(np.abs(place - 0.5))
    ending, begun = foam[rows - 1, here], foam[rows + 2, here]
    assert 0.0 < begun <= ending


@pytest.mark.seldom(3, first=2)
def test_waves_reach_farther_on_a_level_beach_and_leave_cliffs_alone() -> None:
    x, z = np.zeros(1), np.zeros(1)
    assert run_up.reaches(np.array([0.1]), x, z) > 2 * run_up.reaches(np.array([0.4]), x, z)
    assert len(run_up.tiles(beach(slope=0.15))) > 5
    assert not run_up.tiles(beach(slope=2.0))


def test_the_strip_is_the_same_from_the_cache() -> None:
    field = beach(slope=0.15)
    made = run_up.tiles(field)
    for _ in range(2):
        found = run_up.remembered_tiles(field)
        assert len(found) == len(made) > 5
        for one, other in zip(found, made, strict=True):
            assert (one.vertices == other.vertices).all() and (one.places == other.places).all()
            assert (one.triangles == other.triangles).all() and (one.alpha == other.alpha).all()
    assert run_up.remembered_tiles(beach(slope=2.0)) == []


def test_the_strip_lies_on_the_sand_and_on_the_water() -> None:
    field = beach()
    for tile in run_up.tiles(field):
        x, y, z = tile.vertices.T
        ground = np.maximum(field.terrain_height(x, z), LEVEL)
        assert (y > ground).all() and (y < ground + 0.01).all()


@pytest.mark.seldom(3, first=2)
def test_the_strip_goes_on_to_where_no_wave_wets_the_sand() -> None:
    # Cells of this beach are up to half as wide as waves reach.
    strip = run_up.joined(run_up.tiles(beach(slope=0.2)))
    x, _, z = strip.vertices.T
    wet = run_up.diagram().wet.max(axis=0)
    shown = wet[np.minimum((strip.places[:, 0] * run_up.ACROSS).astype(int), run_up.ACROSS - 1)]
    for line in np.unique(x):
        along = np.flatnonzero(x == line)
        assert shown[along[z[along].argmin()]] < 0.02
        assert shown[along[z[along].argmax()]] < 0.02
        assert shown[along].max() > 0.9


@pytest.mark.seldom(3, first=2)
def test_foam_climbs_the_land_and_moves(stage: Stage, plain: Assets) -> None:
    def shown(kt: float, climbing: bool) -> np.ndarray:
        changes = {**WASH, "water.run_up": climbing}
        return drawn(stage, plain, changes, DOWN, kt)[0].astype(float)

    first, later, without = shown(30.0, True), shown(90.0, True), shown(30.0, False)
    assert (np.abs(first - without).max(axis=2) > 12).sum() > 200
    assert (np.abs(first - later).max(axis=2) > 12).sum() > 200
