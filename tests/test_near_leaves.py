"""Sprays of leaves before the pictures of oaks: where they stand, in which colours, how drawn."""

from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from stage import Stage, small

from framelens.gl.seam import gl
from landscape.elements.atlas import GUTTER
from landscape.elements.best.sprites import near_leaves
from landscape.elements.best.sprites.near_leaves import (
    LEAFY,
    SPRAYS,
    NearLeaves,
    coordinates_of,
    corners_of,
    leafy,
    spray_colours,
    spray_sheet,
    sprays_of,
    standing,
)
from landscape.frame import Pose

GREEN, BROWN = (90, 130, 40, 255), (90, 70, 50, 255)


def tree() -> np.ndarray:
    """Return a picture of a green crown on a brown trunk, with a bough across the crown."""
    picture = np.zeros((64, 64, 4), np.uint8)
    picture[8:40, 12:52] = GREEN
    picture[40:, 28:36] = BROWN
    picture[16:28, 12:52] = BROWN
    return picture


def test_sprays_stand_where_the_picture_shows_leaves_and_leave_boughs_free() -> None:
    picture = tree()
    shown = leafy(picture)
    assert shown[34, 30] and not shown[22, 30] and not shown[60, 32] and not shown[0, 0]
    assert not shown[34, 13], "beside the sky"
    sprays = sprays_of(picture, 0)
    columns, rows = (sprays.places * 64).astype(int).T
    assert len(rows) == SPRAYS and shown[rows, columns].all()
    assert 110 < sprays.colours[:, 1].mean() < 1.08 * 130
    assert not len(sprays_of(np.zeros_like(picture), 0).depth)


def test_a_spray_is_at_its_texel_s_place_on_the_billboard_and_a_mirrored_one_beside() -> None:
    sprays = sprays_of(tree(), 0)
    foot, size, right = np.array([3.0, 1.0, 5.0]), np.array([0.4, 0.5]), np.array([0.0, 0.0, 1.0])
    plain, flipped = (corners_of(sprays, 50, foot, size, right, flip) for flip in (False, True))
    middles = plain.mean(axis=1)
    assert np.allclose(middles[:, 2] - 5.0, (sprays.places[:50, 0] - 0.5) * 0.4)
    assert np.allclose(middles[:, 1] - 1.0, (1.0 - sprays.places[:50, 1]) * 0.5)
    assert np.abs(middles[:, 0] - 3.0).max() <= near_leaves.DEEP * 0.4 + 1e-9
    assert np.allclose(flipped.mean(axis=1)[:, 2], 10.0 - middles[:, 2])
    sides = np.linalg.norm(plain[:, 1] - plain[:, 0], axis=1)
    assert 0.5 < np.median(sides) / (near_leaves.SIDE * 0.4) < 1.5


def test_leaves_against_the_light_are_brighter_and_yellower() -> None:
    sprays = sprays_of(tree(), 0)
    tint = np.full((1, 3), 0.6)
    level, beneath = (spray_colours(sprays, 400, tint, k).astype(float) for k in (0.0, 1.0))
    assert beneath[:, 1].mean() > level[:, 1].mean() + 3
    assert beneath[:, 0].mean() / beneath[:, 2].mean() > level[:, 0].mean() / level[:, 2].mean()


def test_all_sprays_stand_nearby_and_none_far_away() -> None:
    counts = standing(np.array([0.1, near_leaves.WHOLE, 0.4, near_leaves.REACH, 5.0]))
    assert counts[0] == counts[1] == SPRAYS > counts[2] > 0 == counts[3] == counts[4]


def test_the_sheet_has_four_sprays_with_clear_borders() -> None:
    sheet = spray_sheet()
    side = near_leaves.CELL
    corners = coordinates_of(np.arange(4)) * 2 * side
    for number in range(4):
        (x0, y0), (x1, y1) = corners[number].min(axis=0), corners[number].max(axis=0)
        cell = sheet[int(y0) : int(y1), int(x0) : int(x1)]
        assert cell.shape == (side, side, 4) and 0.12 < (cell[..., 3] > 127).mean() < 0.6
        assert not cell[[0, -1], :, 3].any() and not cell[:, [0, -1], 3].any()
        assert cell[..., :3][cell[..., 3] > 127].mean() > 150, "nearly white"


@dataclass
class One:
    """A choice of one tree."""

    positions: np.ndarray
    sizes: np.ndarray
    pictures: np.ndarray
    colours: np.ndarray


def test_an_oak_nearby_gets_leaves_and_another_tree_or_a_far_one_none(stage: Stage) -> None:
    cell = np.zeros((GUTTER + 64, 64, 4), np.uint8)
    cell[GUTTER:] = tree()
    leaves = NearLeaves(spray_sheet(), *[cell] * len(LEAFY))
    white = np.full((1, 4, 4), 255, np.uint8)

    def seen(away: float, picture: int) -> int:
        place = np.array([[20.0, 1.0, 20.0 - away]])
        trees = One(place, np.array([[0.4, 0.5]]), np.array([picture]), white)
        with stage.frame(small(), Pose(20.0, 1.25, 20.0, 0.0, 0.0)) as frame:
            gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
            before = stage.read()
            rights = np.array([[1.0, 0.0, 0.0]])
            leaves.draw(frame, cast(Any, trees), rights, np.array([False]), np.ones((1, 3)))
            return int((stage.read() != before).any(axis=2).sum())

    try:
        assert seen(0.3, LEAFY[0]) > 20
        assert seen(0.3, 2) == 0
        assert seen(3.0, LEAFY[0]) == 0
    finally:
        leaves.release()
        leaves.release()
