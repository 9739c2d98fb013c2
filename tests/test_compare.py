"""Pictures of two renderers: single pixels may differ, but nothing may move, change or be lost."""

import numpy as np
import pytest

from landscape.gallery.compare import agree

SIZE = (120, 160)


def blot(picture: np.ndarray, side: int, levels: int) -> np.ndarray:
    """Return a copy that is brighter by ``levels`` in a square in the middle."""
    changed = picture.copy()
    rows, columns = (slice(length // 2, length // 2 + side) for length in SIZE)
    changed[rows, columns] += np.uint8(levels)
    return changed


@pytest.fixture
def picture() -> np.ndarray:
    """A bright square on a dark gradient, uint8 (h, w, 3)."""
    picture = np.zeros((*SIZE, 3), np.uint8)
    picture[..., 1] = np.linspace(20, 60, SIZE[1]).astype(np.uint8)
    picture[20:34, 30:44] = (200, 180, 90)
    return picture


def test_an_edge_may_not_move(picture: np.ndarray) -> None:
    assert not agree(picture, np.roll(picture, 1, axis=0), same_renderer=False)


def test_of_hard_edges_a_few_pixels_may_move_by_one_on_another_renderer(
    picture: np.ndarray,
) -> None:
    moved = picture.copy()
    moved[34, 30:44] = picture[33, 30:44]
    moved[20:34, 44] = picture[20:34, 43]
    assert agree(picture, moved, same_renderer=False, edges=True)
    assert not agree(picture, moved, same_renderer=False)
    assert not agree(picture, moved, same_renderer=True, edges=True)
    moved[36:37, 20:44] = picture[33, 33]
    assert not agree(picture, moved, same_renderer=False, edges=True), "this is no edge"


def test_many_hard_edges_may_not_move(picture: np.ndarray) -> None:
    picture[60:, ::8] = 250
    assert not agree(picture, np.roll(picture, 1, axis=1), same_renderer=False, edges=True)


def test_single_pixels_may_differ_on_another_renderer_alone(picture: np.ndarray) -> None:
    few = blot(picture, side=4, levels=30)
    assert agree(picture, few, same_renderer=False)
    assert not agree(picture, few, same_renderer=True)


@pytest.mark.parametrize("edges", [False, True])
def test_a_small_thing_may_not_appear_nor_be_lost(picture: np.ndarray, edges: bool) -> None:
    with_it = blot(picture, side=8, levels=30)
    assert not agree(picture, with_it, same_renderer=False, edges=edges)
    assert not agree(with_it, picture, same_renderer=False, edges=edges)


def test_roundings_are_no_differences(picture: np.ndarray) -> None:
    assert agree(picture, blot(picture, side=12, levels=1), same_renderer=True)
    assert not agree(picture, blot(picture, side=12, levels=2), same_renderer=True)
    assert agree(picture, picture + np.uint8(3), same_renderer=False)
    assert not agree(picture, picture + np.uint8(5), same_renderer=False)
