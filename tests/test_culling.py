"""Back faces and far detail are skipped to save time, and no picture shows it."""

from collections.abc import Iterator

import numpy as np
import pytest

from landscape.offscreen import Offscreen

SIZE = (320, 240)
ALL_DRAWN = {"camera.cull": False, "camera.lod_pixels": 0.0, "water.query": False}
FEW = {
    "grass.count": 50_000,
    "trees.count": 700,
    "plants.count": 500,
    "reflection.lod_scale": 1.0,
    "ground.texture_size": 256,
    "ground.stones": 2000,
}


@pytest.fixture(scope="module")
def both() -> Iterator[tuple[Offscreen, Offscreen]]:
    """The island in best twice: with all that may be skipped left out, and drawn in full."""
    with (
        Offscreen(SIZE, "best", FEW, samples=0) as some,
        Offscreen(SIZE, "best", {**FEW, **ALL_DRAWN}, samples=0) as everything,
    ):
        yield some, everything


@pytest.mark.slow
@pytest.mark.parametrize("view", ["fig35a", "fig35c", "fig35f", "fig35g", "fig35i"])
@pytest.mark.sweep(12, first=3)
def test_the_picture_is_the_same_as_with_everything_drawn(both, view: str) -> None:
    pictures = []
    for offscreen in both:
        offscreen.look(view)
        offscreen.draw()  # the second frame knows what the first found out about the sea
        pictures.append(offscreen.draw().astype(int))
    off = np.abs(pictures[0] - pictures[1]).max(axis=2)
    # The simplified serpent's mirror image, which the waves break up, differs in a few pixels.
    assert (off > 4).mean() < 0.0015
    assert off.mean() < 0.03


@pytest.mark.slow
@pytest.mark.seldom(7, first=4)
def test_a_coarser_mirror_image_changes_only_the_water_and_only_a_little(both) -> None:
    fine, _ = both
    with Offscreen(SIZE, "best", {**FEW, "reflection.lod_scale": 8.0}, samples=0) as coarse:
        for view, horizon in (("fig35a", 115), ("fig35i", 115)):
            pictures = []
            for offscreen in (fine, coarse):
                offscreen.look(view)
                offscreen.draw()
                pictures.append(offscreen.draw().astype(int))
            off = np.abs(pictures[0] - pictures[1]).max(axis=2)
            assert (off[:horizon] == 0).all()
            assert 0.0 < off.mean() < 0.6
            assert (off > 4).mean() < 0.03
