"""What is seen through openings: models in alcoves, and part of a picture that a polygon is in."""

import numpy as np
import pytest

from landscape.frame import Frame, Pose
from landscape.hall import plan
from landscape.hall.exhibits.cabinet import HOLDS, through_opening
from landscape.hall.exhibits.niche import MIDDLE
from landscape.hall.exhibits.picture import polygon_part


@pytest.mark.parametrize("number", range(len(plan.ALCOVES)))
def test_a_model_is_skipped_only_if_no_line_of_sight_through_the_opening_meets_it(
    number: int,
) -> None:
    middle, random = plan.ALCOVES[number], np.random.default_rng(number)
    turn = np.linspace(0, 2 * np.pi, 200)
    rim_x = MIDDLE + HOLDS[number] * np.cos(turn)
    rim_z = middle + HOLDS[number] * np.sin(turn)
    inside = rim_x < plan.INSIDE.west
    for x, z in random.uniform((1.02, 0.42), (2.18, 2.78), (60, 2)).tolist():
        frame = Frame(Pose(x, 0.1, z), (80, 60), 0.0, np.eye(4).ravel(), 60.0)
        share = (plan.INSIDE.west - rim_x) / (x - rim_x)
        crossed = np.abs(rim_z + share * (z - rim_z) - middle) < plan.ALCOVE_HALF
        if not through_opening(frame, number):
            assert not (crossed & inside).any()


def test_the_northernmost_model_is_skipped_from_the_south_end_of_the_west_wall() -> None:
    frame = Frame(Pose(1.05, 0.12, 2.6), (80, 60), 0.0, np.eye(4).ravel(), 60.0)
    assert not through_opening(frame, 0) and through_opening(frame, 5)


def test_a_polygon_is_found_in_the_picture_and_cut_off_behind_the_eye() -> None:
    clip = np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, -0.2], [0, 0, -1, 0]], float)
    square = np.array([(-0.5, -0.5, -1), (0.5, -0.5, -1), (0.5, 0.5, -1), (-0.5, 0.5, -1)], float)
    found = polygon_part(clip, square, (80, 60))
    assert found is not None and found[:4] == (20, 15, 40, 30)
    assert polygon_part(clip, square * (1, 1, -1), (80, 60)) is None
    below = np.array([(-1, -1, 5), (1, -1, 5), (1, -1, -4), (-1, -1, -4)], float)
    under = polygon_part(clip, below, (80, 60))
    assert under is not None and under[:4] == (0, 0, 80, 23)
