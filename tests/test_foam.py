"""Foam: on the water along the shoreline, running ashore, without a jump, on few cells."""

import numpy as np
import pytest
from seaside import LEVEL, beach, drawn, grid_at
from stage import Stage, live_names, project, small, taken

from landscape.elements.best.sea import foam
from landscape.elements.best.sea.sea import Sea
from landscape.elements.best.sea.serpent_wash import REACH, outline, rings
from landscape.elements.best.sea.shoreline import REACH as NEAR
from landscape.elements.best.sea.shoreline import averaged, pieces, shore_map, spread
from landscape.files.assets import Assets
from landscape.frame import Pose

DOWN = Pose(20.0, 3.6, 20.5, 0.0, -89.9)
DARK = {"fog.color": (0.0, 0.0, 0.0), "water.color": (0.0, 0.0, 0.0, 1.0), "water.textured": False}


def foamy(stage: Stage, plain: Assets, kt: float, pose: Pose = DOWN) -> np.ndarray:
    """Return how white foam makes a black sea, 0..1."""
    picture = drawn(stage, plain, {**DARK, "water.foam": True}, pose, kt)[0]
    return np.asarray(picture.min(axis=2) / 255.0)


@pytest.mark.seldom(3, first=1)
def test_foam_lies_along_the_shoreline_and_moves_without_a_jump(
    stage: Stage, plain: Assets
) -> None:
    white = foamy(stage, plain, 0.0)
    rows = np.flatnonzero((white > 0.3).any(axis=1))
    north, south = (
        project(DOWN, (20, LEVEL, 20.0 + 2 * sign * foam.WIDEST))[1] for sign in (-1, 1)
    )
    assert (white > 0.3).sum() > 30
    assert north - 2 <= rows.min() and rows.max() <= south + 2
    assert (np.abs(foamy(stage, plain, 40.0) - white) > 0.2).sum() > 50
    loop = foam.LACE_DRIFT
    assert loop % foam.PERIOD == 0
    assert np.abs(foamy(stage, plain, loop) - white).max() < 0.02


def test_a_crest_of_foam_runs_towards_the_beach() -> None:
    distance = np.linspace(0.0, foam.WIDEST, 400)
    phase = foam.wash(distance, np.full(400, 0.02))[1]
    tops = []
    for kt in (0.3, 0.4, 0.5):  # periods
        turn = foam.turns(np.zeros(1), np.zeros(1), kt * foam.PERIOD)
        tops.append(distance[np.cos(phase - turn).argmax()])
    assert (np.diff(tops) < -0.02).all()


def test_the_dot_product_of_picture_and_colour_is_the_foam() -> None:
    distance = np.linspace(-0.2, 0.6, 50)[None, :]
    swell, phase, edge = foam.wash(distance, np.full((1, 50), 0.1))
    picture = foam.wash_picture(swell, phase, edge).astype(float) / 255
    for turn in (0.0, 1.0, 4.0):
        colour = 0.5 + 0.5 * np.array([np.cos(turn), np.sin(turn), 1.0])
        got = 4 * ((picture - 0.5) * (colour - 0.5)).sum(axis=2)
        assert np.abs(got - (swell * np.cos(phase - turn) + edge)).max() < 0.02


def test_the_wash_is_wider_on_a_beach_than_on_a_cliff_and_ends_on_both_sides() -> None:
    distance = np.linspace(-1.0, 1.0, 401)
    there = []
    for slope in (0.05, 1.5):
        swell, _, edge = foam.wash(distance, np.full(401, slope))
        there.append(swell + edge > 0)
        assert not there[-1][[0, -1]].any()
    assert there[0].sum() > 2 * there[1].sum() > 0


def test_a_shore_too_steep_to_run_up_keeps_more_foam_where_waves_lap_at_it() -> None:
    edge = np.full((64, 64), 0.3)
    beach, rock = (foam.broken(edge, np.full((64, 64), slope), 4.0) for slope in (0.1, 1.5))
    assert (rock >= beach).all() and rock.mean() > beach.mean() + 0.1
    assert rock.std() > 0.05, "in patches, no even line"


def test_distances_and_slopes_are_those_of_a_straight_shore() -> None:
    ends, slope = pieces(beach(0.1, edge=20.2))
    assert np.allclose(ends[..., 1], 20.2, atol=1e-5) and np.allclose(slope, 0.1, atol=1e-5)
    distance, steep = shore_map(beach(0.1, edge=20.2), 256)
    z = (np.arange(256) + 0.5) * 40.0 / 256
    inside = np.abs(z - 20.2) < NEAR - 0.4
    assert np.abs(distance[inside] - (z - 20.2)[inside, None])[:, 8:-8].max() < 0.03
    assert np.abs(distance).max() <= NEAR + 1e-9
    assert np.allclose(steep[inside], 0.1, atol=1e-5)


def test_averages_keep_a_constant_and_leave_out_what_is_not_known() -> None:
    assert np.allclose(averaged(np.full((9, 9), 3.0)), 3.0)
    values = np.zeros((20, 20))
    values[10] = 2.0
    wide = spread(values, 2)
    assert np.allclose(wide[8:13], 2.0) and (wide[:8] == 0).all()


@pytest.mark.seldom(3, first=1)
@pytest.mark.parametrize(
    "pose", [Pose(20.0, 0.75, 21.0, 20.0, -3.0), Pose(18.0, 3.0, 26.0, 0, -20)]
)
def test_only_cells_near_the_shore_are_drawn_again_and_none_is_left_out(pose: Pose) -> None:
    grid = grid_at(pose)
    away = np.abs(shore_map(beach())[0])
    foam_cells = foam.Where(np.maximum(away - 0.3, 0.0), (0.0, 0.0), 40.0).cells(grid)
    corners = grid.z.ravel()[foam_cells.reshape(-1, 6)]
    z = grid.z.ravel()[grid.triangles.reshape(-1, 6)]
    ring = np.repeat(grid.ring[1:], len(grid.east) - 1)
    crossed = (z.min(axis=1) < 20.2) & (z.max(axis=1) > 19.8) & (ring < foam.FARTHEST)
    x = grid.x.ravel()[grid.triangles.reshape(-1, 6)]
    crossed &= (x.min(axis=1) > 0) & (x.max(axis=1) < 40)
    kept = {tuple(cell) for cell in foam_cells.reshape(-1, 6).tolist()}
    wanted = {tuple(cell) for cell in grid.triangles.reshape(-1, 6)[crossed].tolist()}
    assert wanted and wanted <= kept
    assert len(corners) < 0.7 * len(z)


def test_least_distances_are_exact_nearby_and_never_too_large_far_away() -> None:
    size, texel = 64, 0.1
    row, column = np.mgrid[:size, :size]
    away = texel * np.hypot(row - 20, column - 37)
    # What the maps hold is not right where it is large.
    found = foam.least_distances(np.minimum(away, 0.6), texel)
    near = away <= foam.NEARBY
    assert np.allclose(found[near], away[near], atol=1e-6)
    assert (found <= away + 1e-6).all() and (found[~near] >= foam.NEARBY).all()
    # 64 texels are halved three times.
    assert (found[away > 2.5] >= 8 * texel - 1e-6).all()


@pytest.mark.seldom(3, first=1)
def test_a_sea_with_foam_is_built_for_one_setting_and_leaves_nothing(
    stage: Stage, plain: Assets
) -> None:
    before = live_names()
    settings = small({"water.foam": True})
    sea = Sea(settings, plain, beach())
    made = live_names()
    assert taken(sea, small({"water.foam": True, "fog.density": 0.3}))
    assert not taken(sea, small({"water.foam": False}))
    with stage.frame(settings, DOWN) as frame:
        sea.draw(frame)
    assert live_names() == made
    sea.release()
    sea.release()
    assert live_names() == before


def test_rings_run_away_from_the_dragon_and_end() -> None:
    distance = np.linspace(0.0, REACH, 500)
    swell, phase, edge = rings(distance)
    assert (np.diff(swell) <= 0).all() and swell[-1] == 0 and edge[0] > 0.5 and edge[-1] == -1
    tops = []
    for kt in (0.3, 0.35, 0.4):  # periods
        turn = foam.turns(np.zeros(1), np.zeros(1), kt * foam.PERIOD)
        crests = np.cos(phase[:300] - turn)
        first = np.flatnonzero((crests[1:-1] > crests[:-2]) & (crests[1:-1] >= crests[2:]))[0]
        tops.append(distance[first])
    assert (np.diff(tops) > 0).all()


@pytest.mark.seldom(3)
def test_the_dragons_outline_is_where_its_mesh_crosses_the_water(stage: Stage) -> None:
    settings = small({"water.foam": True, "dragon.x": 20.0, "dragon.z": 24.0})
    ends = outline(settings, Assets())
    scale = settings.dragon.scale
    assert len(ends) > 100 and 0.3 * scale < np.abs(ends).max() < 1.5 * scale
    pose, pictures = Pose(20.0, 4.6, 24.0, 0.0, -89.9), []
    for dragon in (False, True):
        sea = Sea(settings, Assets(), beach(1.0), dragon)
        with stage.frame(settings, pose) as frame:
            sea.draw(frame)
            pictures.append(stage.read().astype(int))
        sea.release()
    rows, columns = np.nonzero(np.abs(pictures[1] - pictures[0]).max(axis=2) > 20)
    assert len(rows) > 100, "foam around it"
    reach = np.abs(ends).max() + REACH
    left, top = project(pose, (20.0 - reach, LEVEL, 24.0 - reach))
    right, bottom = project(pose, (20.0 + reach, LEVEL, 24.0 + reach))
    assert left - 2 <= columns.min() and columns.max() <= right + 2
    assert top - 2 <= rows.min() and rows.max() <= bottom + 2
