"""The picture that shows where a student's picture differs."""

from pathlib import Path

import numpy as np

from landscape.course.grader.evidence import Evidence, Frame
from landscape.course.grader.grading import LEVELS
from landscape.course.grader.heat_map import GAP, HEAT, heat_map

GROUND = 40, 90, 200
SIZE = 20, 30  # rows and columns


def evidence(picture: np.ndarray) -> Evidence:
    return Evidence(Path("program.py"), [], {0: Frame(0, picture, [], [])})


def heat(levels: float) -> np.ndarray:
    """Return the colour for a difference of so many levels, uint8 (3,)."""
    places = np.linspace(0, 255, len(HEAT))
    return np.array([np.interp(levels, places, HEAT[:, each]) for each in range(3)]) * 255


def test_a_pixel_is_the_brighter_the_more_it_differs_and_others_show_the_solution_faintly() -> None:
    solution = np.full((*SIZE, 3), GROUND, np.uint8)
    work = solution.copy()
    work[2:6, 2:6, 1] += 100
    work[10:14, 10:14, 0] += 215
    work[16:18, 20:24] += LEVELS  # rounding
    row = heat_map(evidence(work), evidence(solution))
    height, width = SIZE
    assert row.shape == (height, 3 * width + 2 * GAP, 3) and row.dtype == np.uint8
    mine, middle, wanted = (row[:, each * (width + GAP) :][:, :width] for each in range(3))
    assert (mine == work).all() and (wanted == solution).all()
    assert np.abs(middle[3:5, 3:5] - heat(100)).max() < 1.01
    assert np.abs(middle[11:13, 11:13] - heat(215)).max() < 1.01
    faint = HEAT[0] * 255 * 0.6 + np.mean(GROUND) * 0.18
    assert np.abs(middle[16:18, 20:24] - faint).max() < 1.01
    assert np.abs(middle[0, :] - faint).max() < 1.01


def test_equal_pictures_have_nothing_bright_and_other_sizes_are_white() -> None:
    picture = np.random.default_rng(3).integers(0, 256, (*SIZE, 3), np.uint8)
    width = SIZE[1]
    middle = heat_map(evidence(picture), evidence(picture))[:, width + GAP :][:, :width]
    faint = HEAT[0] * 255 * 0.6 + picture.mean(axis=2, keepdims=True) * 0.18
    assert np.abs(middle - faint).max() < 1.01
    row = heat_map(evidence(picture[:10]), evidence(picture))
    assert (row[:10, width + GAP :][:, :width] == 255).all()
