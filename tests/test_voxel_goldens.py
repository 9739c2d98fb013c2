"""Golden pictures of the voxel island's views, each drawn at twice its size and reduced."""

from collections.abc import Iterator

import numpy as np
import pictures
import pytest
from stage import Stage

from framelens.gl.framebuffer import Framebuffer, read_pixels
from framelens.gl.seam import gl
from landscape.files.assets import Assets
from landscape.gallery.compare import agree
from landscape.scene.scene import Moment, raised
from landscape.settings.declare import with_settings
from landscape.voxel.voxel import SCENE, Voxel

pytestmark = pytest.mark.golden

LARGE = (320, 240)


@pytest.fixture(scope="module")
def island(the_stage: Stage) -> Iterator[Voxel]:
    the_stage.enter()
    opened = Voxel(SCENE.settings, Assets())
    yield opened
    the_stage.enter()
    opened.release()


def draw(
    stage: Stage, island: Voxel, name: str, without: frozenset[str] = frozenset()
) -> np.ndarray:
    """Return the picture of a view, uint8 (h, w, 3), without some of its elements."""
    view = SCENE.views[name]
    settings = with_settings(SCENE.settings, view.settings)
    with stage.borrowed():
        target = Framebuffer(LARGE)
        assert island.apply(settings)
        island.shown = set(SCENE.shown(view)) - without
        island.draw(Moment(raised(view.pose, island, settings.walk.eye), LARGE, view.kt))
        gl.glFinish()
        drawn = read_pixels(LARGE).astype(np.uint16)
        target.release()
        stage.target.bind()
    reduced = sum(drawn[row::2, column::2] for row in (0, 1) for column in (0, 1)) // 4
    return np.asarray(reduced, np.uint8)


@pytest.mark.sweep(12, first=5)
@pytest.mark.parametrize("name", SCENE.main)
def test_a_view_of_the_voxel_island_matches_its_golden_picture(
    stage: Stage, island: Voxel, request: pytest.FixtureRequest, name: str
) -> None:
    drawn = draw(stage, island, name)
    pictures.check(name, drawn, request.config.getoption("--update-golden"), edges=True)


@pytest.mark.parametrize("name", SCENE.main)
def test_on_another_renderer_the_comparison_fails_on_a_picture_shifted_by_one_pixel(
    name: str,
) -> None:
    golden = pictures.golden(name)
    for axis in (0, 1):
        assert not agree(golden, np.roll(golden, 1, axis), same_renderer=False, edges=True)


@pytest.mark.parametrize(
    ("name", "missing"),
    [("voxel_bay", "land"), ("voxel_castle", "sky"), ("voxel_cliff", "water")],
)
@pytest.mark.sweep(3)
def test_on_another_renderer_the_comparison_fails_when_one_element_is_missing(
    stage: Stage, island: Voxel, name: str, missing: str
) -> None:
    """Of the cliff's view the water is less than one in a hundred of the pixels."""
    drawn = draw(stage, island, name, frozenset({missing}))
    assert not agree(pictures.golden(name), drawn, same_renderer=False, edges=True)
