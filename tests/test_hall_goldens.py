"""Golden pictures of the hall's views, each drawn at twice its size and reduced.

The mean of four pixels differs less between renderers than gold and stone do, which glitter.
"""

from collections.abc import Iterator

import numpy as np
import pictures
import pytest
from stage import Stage

from framelens.gl.framebuffer import Framebuffer, read_pixels
from framelens.gl.seam import gl
from landscape.files.assets import Assets
from landscape.hall.hall import SCENE, Hall
from landscape.offscreen import baked_alike
from landscape.scene.scene import Moment, placed
from landscape.settings.declare import with_settings

pytestmark = pytest.mark.golden

VIEWS = (
    "hall",
    "hall_mirror",
    "hall_shadow",
    "hall_caustics",
    "hall_contrast",
    "hall_sphere",
    "hall_mist",
    "hall_exhibits",
    "hall_one_floor",
    "hall_texture",
    "hall_ball",
    "hall_sky",
)
LARGE = (320, 240)


@pytest.fixture(scope="module")
def halls(the_stage: Stage) -> Iterator[list[Hall]]:
    """The hall that was opened last, in a list; one that cannot take settings is opened anew."""
    the_stage.enter()
    kept = [Hall(SCENE.settings, Assets(), 0, SCENE.elements)]
    yield kept
    the_stage.enter()
    kept[0].release()


@pytest.mark.sweep(12)
@pytest.mark.parametrize("name", VIEWS)
def test_a_view_of_the_hall_matches_its_golden_picture(
    stage: Stage, halls: list[Hall], request: pytest.FixtureRequest, name: str
) -> None:
    view = SCENE.views[name]
    settings = with_settings(SCENE.settings, view.settings)
    with stage.borrowed():
        if not baked_alike(SCENE, halls[0].settings, settings) or not halls[0].apply(settings):
            halls[0].release()
            halls[0] = Hall(settings, Assets(), 0, SCENE.elements)
        hall, target = halls[0], Framebuffer(LARGE)
        hall.shown = set(SCENE.shown(view))
        hall.draw(Moment(placed(view.pose, hall, settings.walk.eye), LARGE, view.kt))
        gl.glFinish()
        drawn = read_pixels(LARGE).astype(np.uint16)
        target.release()
        stage.target.bind()
    reduced = sum(drawn[row::2, column::2] for row in (0, 1) for column in (0, 1)) // 4
    update = request.config.getoption("--update-golden")
    pictures.check(name, reduced, update)  # type: ignore[arg-type]
