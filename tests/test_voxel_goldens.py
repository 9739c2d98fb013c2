"""Golden pictures of the voxel island's views, each drawn at twice its size and reduced."""

from collections.abc import Iterator

import numpy as np
import pictures
import pytest
from stage import Stage

from landscape.files.assets import Assets
from landscape.gl.calls import gl
from landscape.gl.framebuffer import Framebuffer, read_pixels
from landscape.keys import with_settings
from landscape.scene import Moment, raised
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


@pytest.mark.parametrize("name", list(SCENE.views))
def test_a_view_of_the_voxel_island_matches_its_golden_picture(
    stage: Stage, island: Voxel, request: pytest.FixtureRequest, name: str
) -> None:
    view = SCENE.views[name]
    settings = with_settings(SCENE.settings, view.settings)
    with stage.borrowed():
        target = Framebuffer(LARGE)
        assert island.apply(settings)
        island.shown = set(SCENE.shown(view))
        island.draw(Moment(raised(view.pose, island, settings.walk.eye), LARGE, view.kt))
        gl.glFinish()
        drawn = read_pixels(LARGE).astype(np.uint16)
        target.release()
        stage.target.bind()
    reduced = sum(drawn[row::2, column::2] for row in (0, 1) for column in (0, 1)) // 4
    update = request.config.getoption("--update-golden")
    pictures.check(name, reduced, update)  # type: ignore[arg-type]
