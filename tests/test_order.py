"""A picture does not depend on what was drawn before it in the same context."""

import numpy as np
import pytest
from commands import small_textures
from gl_state import changes, snapshot
from stage import SMALL, SMALL_BEST, Stage

from framelens.gl.context import open_context
from framelens.gl.framebuffer import Framebuffer
from landscape.elements.settings import PRESETS, Settings, preset
from landscape.files.assets import Assets
from landscape.island.island import Island
from landscape.island.views import ALL, VIEWS
from landscape.scene.scene import Moment, begin_frame, placed
from landscape.settings.declare import with_settings

SIZE = (96, 72)
MANY = {"grass.count": 100_000, "trees.count": 400, "plants.count": 400, "deer.count": 60}
NAMES = ("fig35a", "fig35d", "fig35e", "fig35g", "fig29e", "fig32a", "fig35i")

Frame = tuple[str, tuple[str, ...]]
"""A view and the elements to draw."""
FRAMES: list[Frame] = [
    *((name, ALL) for name in NAMES),
    *(("fig35e", (element,)) for element in ALL),
    ("fig35e", ("castle", "water")),
]
"""Whole views, and each element alone: lit and unlit ones, each before and after each other."""


def configured(name: str) -> Settings:
    return with_settings(preset(name), {**(SMALL_BEST if name == "best" else SMALL), **MANY})


def moment(island: Island, view: str) -> Moment:
    values = VIEWS[view]
    pose = placed(values.pose, island, island.settings.walk.eye)
    return Moment(pose, SIZE, values.kt, stroke=values.stroke)


@pytest.fixture(scope="module")
def assets(tmp_path_factory: pytest.TempPathFactory) -> Assets:
    """The shipped assets with small textures."""
    folder = tmp_path_factory.mktemp("small")
    small_textures(folder)
    return Assets(folder)


def drawn(settings: Settings, assets: Assets, frames: list[Frame]) -> dict[Frame, np.ndarray]:
    """Draw frames one after another on a new island in a new context."""
    context = open_context("auto")
    target = Framebuffer(SIZE)
    island = Island(settings, assets)
    pictures = {}
    for view, shown in frames:
        island.shown = set(shown)
        island.draw(moment(island, view))
        pictures[view, shown] = target.read()
    for owner in (island, target, context):
        owner.release()
    return pictures


@pytest.mark.seldom(14, first=6)
@pytest.mark.parametrize("name", PRESETS)
def test_a_picture_is_the_same_whatever_was_drawn_before_it(
    stage: Stage, assets: Assets, name: str
) -> None:
    """Of any two frames each comes before the other once; the first of an order is drawn alone."""
    settings = configured(name)
    ahead = drawn(settings, assets, FRAMES)
    back = drawn(settings, assets, FRAMES[::-1])
    different = [frame for frame in FRAMES if (ahead[frame] != back[frame]).any()]
    assert not different


@pytest.mark.seldom(14)
@pytest.mark.parametrize("name", PRESETS)
def test_a_view_with_all_elements_leaves_the_state_as_its_beginning_set_it(
    stage: Stage, assets: Assets, name: str
) -> None:
    """Also what no later frame sets: matrices, materials, every texture unit's environment."""
    settings = configured(name)
    island = Island(settings, assets)
    for view in ("fig35e", "fig32a"):
        with stage.borrowed():
            given = moment(island, view)
            far = 1.5 * settings.water.horizon
            begin_frame(given, settings.camera, settings.sun, settings.fog, True, far)
            begun = snapshot()
            island.draw(given)
            assert not changes(begun, snapshot())
    island.release()
