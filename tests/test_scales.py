"""The dragon's scales: a tile that continues at its edges, with furrows darker than the scales."""

import numpy as np

from landscape.elements.best.animals.scales import (
    brightest,
    muted,
    nearest_points,
    scaled_skin,
    scales,
)
from landscape.geometry.mesh import Mesh


def test_a_tile_continues_at_its_opposite_edges() -> None:
    first, _, _ = nearest_points(128, 8)
    step = 8 / 128  # the distance to a point changes by no more than a texel's side
    assert np.abs(first[0] - first[-1]).max() <= step + 1e-9
    assert np.abs(first[:, 0] - first[:, -1]).max() <= step + 1e-9


def test_a_furrow_is_darker_than_the_middle_of_a_scale() -> None:
    first, second, number = nearest_points(128, 8)
    tile = scales(128, 8)[..., 0].astype(float)
    assert len(np.unique(number)) == 64
    assert tile[second - first < 0.05].mean() < 0.8 * tile[first < 0.15].mean()


def test_a_scale_is_a_dome_and_no_flat_tile_with_a_line_around_it() -> None:
    first, second, _ = nearest_points(512, 8)
    tile = scales(512, 8)[..., 0].astype(float)
    apart = second - first
    steps = [tile[(apart > low) & (apart <= low + 0.1)].mean() for low in (0.0, 0.15, 0.3, 0.5)]
    # It grows brighter all the way in, by no more at the rim than farther in altogether.
    assert all(one + 3.0 < other for one, other in zip(steps, steps[1:], strict=False))


def test_only_skin_that_is_bluer_than_red_has_scales() -> None:
    places = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], np.float32)
    triangles = np.array([(0, 1, 2), (1, 3, 2)], np.uint32)
    colours = np.array([[20, 90, 100, 255]] * 3 + [[200, 90, 40, 255]], np.uint8)
    mesh = Mesh(places, places, triangles, (places[:, :2].copy(),), colours)
    spot = brightest(scales(128, 8))
    found = scaled_skin(mesh, spot)
    corners = found.coordinates[0][found.triangles]
    assert np.allclose(corners[0], places[[0, 1, 2], :2]) and np.allclose(corners[1], spot)
    assert np.allclose(found.vertices[found.triangles], places[triangles])
    row, column = (scales(128, 8)[int(spot[1] * 128), int(spot[0] * 128)]).tolist()[:2]
    assert row == column == 255, "there the tile changes no colour"
    plain = Mesh(places, places, triangles, (places[:, :2].copy(),))
    assert scaled_skin(plain, spot) is plain


def test_skin_is_duller_and_darker_than_its_paint_and_keeps_its_hue() -> None:
    places = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0)], np.float32)
    triangles = np.array([(0, 1, 2)], np.uint32)
    paint = np.array([[20, 90, 100, 255], [225, 120, 60, 255], [90, 90, 90, 255]], np.uint8)
    mesh = Mesh(places, places, triangles, (places[:, :2].copy(),), paint)
    found = muted(mesh).colors
    assert found is not None and (found[:, 3] == 255).all()
    before, after = paint[:, :3].astype(float), found[:, :3].astype(float)
    assert (after.mean(axis=1) < 0.95 * before.mean(axis=1)).all()
    assert (np.ptp(after[:2], axis=1) < 0.6 * np.ptp(before[:2], axis=1)).all()
    assert (after[:2].argmax(axis=1) == before[:2].argmax(axis=1)).all()
    assert mesh.colors is not None and (mesh.colors == paint).all(), "the mesh given is unchanged"
    plain = Mesh(places, places, triangles, (places[:, :2].copy(),))
    assert muted(plain) is plain
