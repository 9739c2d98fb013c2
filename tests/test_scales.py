"""The dragon's scales: a tile that continues at its edges, with furrows darker than the scales."""

import numpy as np

from landscape.elements.best.animals.scales import nearest_points, scales


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
