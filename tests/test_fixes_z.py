"""The grass: blades that face the viewer, tufts, and the loop of 2006."""

from typing import Any

import numpy as np
from stage import PLAIN, Stage, small
from test_grass import frame_at, sow

from landscape.elements.grass import Grass, send_one_by_one
from landscape.elements.ground import Ground
from landscape.elements.meadow.blades import blade_vertices, facing
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.gl.calls import recording
from landscape.keys import with_settings
from landscape.settings import Settings

SUN = np.array([0.0, 1.0, 0.0], np.float32)
LARGE = np.array(PLAIN["ground_large.png"])


# R7


def seen_widths(blades: np.ndarray, eye: np.ndarray) -> np.ndarray:
    """Return the feet's width at right angles to the line of sight, in parts of the whole."""
    across = (blades[:, 1] - blades[:, 0])[:, ::2]
    away = blades[:, 0, ::2] / 2 + blades[:, 1, ::2] / 2 - eye
    sight = np.stack([-away[:, 1], away[:, 0]], axis=1)
    seen = (across * sight).sum(axis=1) / np.linalg.norm(sight, axis=1)
    return np.abs(seen) / np.linalg.norm(across, axis=1)


def test_no_blade_is_a_line_seen_edge_on() -> None:
    angles = np.linspace(0, 2 * np.pi, 721)
    spots = np.random.default_rng(5).random((721, 3)) * 6
    eye = np.array([3.0, 9.0])
    plain = blade_vertices(spots, angles)
    columns = np.ascontiguousarray(plain.transpose(1, 2, 0))
    facing(columns, (spots[:, ::2] - eye).astype(np.float32).T, 0.6)
    turned = columns.transpose(2, 0, 1)
    assert seen_widths(plain, eye).min() < 0.05
    # sqrt(1 - (0.4 / 0.6)^2)
    assert seen_widths(turned, eye).min() > 0.74
    width = np.linalg.norm(turned[:, 1] - turned[:, 0], axis=1)
    assert np.allclose(width, 0.006, rtol=1e-3)
    assert (turned[:, 4] == plain[:, 4]).all()
    middle = (turned[:, 0] + turned[:, 1]) / 2
    assert np.allclose(middle, spots, atol=1e-5)


def test_blades_turn_smoothly_as_the_walker_passes() -> None:
    columns = blade_vertices(np.zeros((400, 3)), np.full(400, 0.3)).transpose(1, 2, 0).copy()
    around = np.linspace(0, 2 * np.pi, 400)
    facing(columns, np.stack([np.cos(around), np.sin(around)]).astype(np.float32), 0.6)
    side = (columns[1] - columns[0])[::2].T / 0.006
    assert np.linalg.norm(np.diff(side, axis=0), axis=1).max() < 0.1


def test_the_setting_turns_the_blades_that_are_drawn() -> None:
    frame = frame_at(Pose(20.0, 3.1, 20.0))
    eye = np.array([20.0, 20.0])
    widths = []
    for part in (0.0, 0.6):
        grass = sow(facing=part)
        blades = grass.bend(frame, grass.select(frame))
        widths.append(seen_widths(blades, eye).min())
    assert widths[0] < 0.05 and widths[1] > 0.7


# Tufts, layers


LUSH: dict[str, Any] = {"fade": True, "tufts": 7, "variety": 1.0, "count": 200_000}


def test_blades_grow_in_tufts_that_lean_apart() -> None:
    patch = sow(**LUSH)._patch(3210)
    spread = patch.positions[:7, ::2] - patch.positions[:7, ::2].mean(axis=0)
    assert np.abs(spread).max() < 0.02
    tips = patch.blades[:, 4, ::2] - patch.positions[:, ::2]
    loose = sow(**{**LUSH, "tufts": 0})._patch(3210)
    spread = loose.positions[:7, ::2] - loose.positions[:7, ::2].mean(axis=0)
    assert np.abs(spread).max() > 0.05
    assert np.linalg.norm(tips, axis=1).min() > 0.003


def test_a_far_cell_grows_the_same_blades_as_when_one_stands_in_it() -> None:
    far, near = sow(**{**LUSH, "count": 2_000_000}), sow(**{**LUSH, "count": 2_000_000})
    whole = near._patch(3210)
    first = far._patch(3210, 40)
    assert 40 <= len(first.blades) < len(whole.blades) == near.counts[3210]
    assert (first.blades == whole.blades[: len(first.blades)]).all()
    assert (far._patch(3210).blades == whole.blades).all()


def test_where_hardly_anything_grows_the_lot_ends() -> None:
    grass = sow(**LUSH)
    grass._roots = lambda cell, count, rng: np.full((3, 2), 20.1)  # type: ignore[method-assign]
    assert len(grass._patch(3240).blades) == grass.counts[3240] == 21


def test_variety_makes_heights_and_colours_differ() -> None:
    def spread(variety: float) -> tuple[float, float]:
        patch = sow(tinted=True, **{**LUSH, "variety": variety})._patch(3210)
        heights = patch.blades[:, 4, 1] - patch.positions[:, 1]
        return float(heights.std()), float((patch.tints[:, 4, 0] / patch.tints[:, 4, 1]).std())

    plain, varied = spread(0.0), spread(1.0)
    assert varied[0] > 1.3 * plain[0] and varied[1] > 5 * plain[1]


# R18


def test_the_loop_over_blades_draws_the_picture_of_one_call(stage: Stage, plain: Assets) -> None:
    pictures = []
    for method in ("cells", "loop"):
        settings = small({"grass.method": method, "grass.count": 40_000, "grass.tinted": True})
        settings = with_settings(settings, {"grass.scale": (3.0, 3.0)})
        ground = Ground(settings, plain, SUN)
        ground.large = np.full((4, 4, 3), (60, 120, 40), np.uint8)
        grass = Grass(settings, plain, ground, 7)
        with stage.frame(settings, Pose(20.0, 3.1, 20.0), kt=9.0) as frame:
            grass.draw(frame)
            pictures.append(stage.read())
        grass.release()
        ground.release()
    assert (pictures[0] == pictures[1]).all()
    assert (np.abs(pictures[0] - np.array([102, 153, 178])) > 20).any(axis=2).sum() > 500


def test_one_blade_takes_sixteen_calls_and_more(stage: Stage) -> None:

    blades = blade_vertices(np.zeros((3, 3)), np.zeros(3))
    with stage.frame(small(), Pose(0.0, 0.0, 5.0)), recording() as recorder:
        send_one_by_one(blades, None)
    names = [call.name for call in recorder.calls]
    assert names.count("glVertex3f") == 15 and names.count("glBegin") == 3


# 2006 is as it was


def test_all_the_cures_are_off_in_2006() -> None:
    ground, grass = Settings().ground, Settings().grass
    assert (ground.smooth, ground.exact_height, ground.materials, ground.tiles) == (
        *("none", False, False),
        1,
    )
    assert (grass.facing, grass.tufts, grass.variety, grass.method) == (0.0, 0, 0.0, "cells")
    assert Settings().rabbit.mapping == "cylindrical"
