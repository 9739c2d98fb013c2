"""The dragon's scales: a tile without seams, with furrows darker than the scales."""

import numpy as np

from landscape.elements.best.animals.scales import nearest_points, scales


def test_a_tile_continues_at_its_opposite_edges() -> None:
    tile = scales(128, 8)[..., 0].astype(float)
    within = np.abs(np.diff(tile, axis=0)).mean(), np.abs(np.diff(tile, axis=1)).mean()
    across = np.abs(tile[0] - tile[-1]).mean(), np.abs(tile[:, 0] - tile[:, -1]).mean()
    assert across[0] < 1.5 * within[0] and across[1] < 1.5 * within[1]


def test_a_furrow_is_darker_than_the_middle_of_a_scale() -> None:
    first, second, number = nearest_points(128, 8)
    tile = scales(128, 8)[..., 0].astype(float)
    assert len(np.unique(number)) == 64
    assert tile[second - first < 0.05].mean() < 0.8 * tile[first < 0.15].mean()
