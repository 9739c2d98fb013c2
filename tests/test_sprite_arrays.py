"""The refined sprites' arrays: quads, boxes, pictures from above, and what is drawn."""

import math

import numpy as np
import pytest

from landscape.elements.best.sprites.refined_atlas import (
    box_corners,
    from_above,
    outline,
    top_coordinates,
)
from landscape.elements.best.sprites.refined_quads import (
    Quads,
    lying,
    points_of,
    smoothstep,
    still_quads,
    turned,
)
from landscape.elements.best.sprites.slope_billboards import upright_axes
from landscape.elements.transparent_elements import HALVES, QUAD, crossed_quads


def test_indices_name_each_quads_own_vertices_from_far_to_near() -> None:
    tree = Quads.of(
        np.zeros((2, 4, 3)), np.zeros((2, 4, 2)), np.zeros((2, 4)), QUAD, np.array([-1.0, -3.0])
    )
    plant = Quads.of(
        np.zeros((1, 6, 3)), np.zeros((1, 6, 2)), np.zeros((1, 4)), HALVES, np.array([-2.0])
    )
    both = Quads.join([tree, plant])
    first, second = QUAD[0].tolist(), (QUAD[0] + 4).tolist()
    halves = (HALVES.ravel() + 8).tolist()
    assert both.indices(sort=False).tolist() == first + second + halves
    assert both.indices(sort=True).tolist() == second + halves + first
    assert both.indices(sort=True).dtype == np.uint32
    assert len(both.vertices) == 14 == both.indices(sort=False).max() + 1
    nothing = Quads.of(
        np.zeros((0, 4, 3)), np.zeros((0, 4, 2)), np.zeros((0, 4)), QUAD, np.zeros(0)
    )
    assert nothing.indices(sort=True).shape == (0,)


def test_upright_billboards_keep_the_cameras_direction_and_stay_vertical() -> None:
    yaw = math.radians(40.0)
    right, up = upright_axes(np.array([math.cos(yaw), 0.0, math.sin(yaw)]))
    assert right == pytest.approx([math.cos(yaw), 0, math.sin(yaw)])
    assert up.tolist() == [0, 1, 0]


def test_r6_three_quads_stand_at_60_degrees_and_two_as_in_2006() -> None:
    place = np.array([[5.0, 1.0, 7.0]])
    turns = turned(place, 3)
    assert np.diff(turns[0]) == pytest.approx([math.pi / 3] * 2)
    quads = still_quads(place, np.array([[0.8, 0.5]]), turns)[0]
    ends = quads[[2, 8, 14]] - place
    assert np.allclose(np.hypot(ends[:, 0], ends[:, 2]), 0.4)
    assert np.allclose(np.arctan2(ends[:, 2], ends[:, 0]) % np.pi, turns[0] % np.pi)
    assert np.allclose(quads[3::6, 1], 1.5) and np.allclose(quads[::6, 1], 1.0)
    assert np.allclose(
        still_quads(place, np.ones((1, 2)), turned(place, 2)),
        crossed_quads(place, np.ones((1, 2)), np.zeros((1, 2))),
    )


def test_lying_quads_follow_the_ground() -> None:
    place, slopes = np.array([[1.0, 2.0, 3.0]]), np.array([[0.5, -0.25]])
    quad = lying(place, np.array([2.0]), slopes, np.array([0.3]))[0] - place[0]
    assert np.allclose(quad[:, 1], 0.5 * quad[:, 0] - 0.25 * quad[:, 2])
    assert np.allclose(np.hypot(quad[:, 0], quad[:, 2]), math.sqrt(2.0))
    assert smoothstep(1, 3, np.array([0, 1, 2, 3, 9.0])).tolist() == [0, 0, 0.5, 1, 1]


def test_corners_of_boxes_are_points_of_the_quad() -> None:
    quad = np.array([[(0, 0, 0), (2, 0, 0), (2, 4, 0), (0, 4, 0)]], float)
    points = points_of(quad, box_corners(np.array([[(0.25, 0.5, 0.75, 1.0)]])).reshape(1, 4, 2))
    assert np.allclose(points[0], [(0.5, 0, 0), (1.5, 0, 0), (1.5, 2, 0), (0.5, 2, 0)])


def test_a_picture_from_above_is_round_and_repeats_its_fan() -> None:
    image = np.zeros((64, 64, 4), np.uint8)
    image[...] = (10, 200, 30, 255)
    image[:, 32:] = (200, 20, 30, 255)
    top = from_above(image, (0.5, 0.95), (0.9, 0.9), 0.0, 40.0, 4, 32)
    assert top.shape == (32, 32, 4)
    at_ = np.hypot(*np.meshgrid(np.arange(32) - 15.5, np.arange(32) - 15.5))
    assert (top[at_ < 12, 3] == 255).all() and (top[at_ > 17, 3] == 0).all()
    moved = np.abs(top.astype(int) - top[::-1, ::-1]).max(axis=2) > 60
    assert moved[at_ < 12].mean() < 0.1  # two turns of two fans
    colours = {tuple(int(v) for v in c) for c in top[at_ < 12][:, :3] // 100}
    assert {(0, 2, 0), (2, 0, 0)} <= colours


def test_pictures_from_above_keep_clear_of_each_other() -> None:
    corners = top_coordinates(np.array([0, 1, 2, 6]))
    for k, one in enumerate(corners):
        for other in corners[k + 1 :]:
            apart = np.maximum(one.min(0) - other.max(0), other.min(0) - one.max(0))
            assert apart.max() > 0.01
    assert corners[..., 0].min() > 0.75 and corners[..., 1].min() > 0.5


def test_an_outline_contains_all_that_is_visible_in_less_area() -> None:
    alpha = np.zeros((128, 128), np.uint8)
    alpha[20:70, 10:110] = 255
    alpha[70:, 50:66] = 255
    boxes = outline(alpha)
    inside = np.zeros_like(alpha)
    for s0, t0, s1, t1 in (boxes * 128).round().astype(int):
        inside[t0:t1, s0:s1] = 1
    assert (inside[alpha > 0] == 1).all() and inside.mean() < 0.45
    assert boxes[0, 3] == boxes[1, 1]
