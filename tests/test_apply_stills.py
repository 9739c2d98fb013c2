"""Views with other settings are drawn in the scene that is open, and look as if it were opened so.

The settings are those of the views and fixes of the hall and of the voxel island; test_apply.py
does the same for every setting of the island.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from stage import SIZE, Stage

from landscape.files.assets import Assets
from landscape.offscreen import Offscreen, baked_alike
from landscape.scene.scene import Moment, OpenScene, Scene, View, placed, scene
from landscape.settings.declare import get, with_settings

# The same voxel island in larger blocks, which is built in a quarter of the time.
COARSE: dict[str, Any] = {
    "voxel.regions": 5,
    "voxel.region_size": 50,
    "voxel.block": 0.16,
    "voxel.levels": 48,
    "voxel.sea": 5,
}
STARTS: dict[str, dict[str, Any]] = {"hall": {}, "voxel": COARSE}
# Settings that are changed together, by scene: no group of a line hides what another one shows.
TOGETHER = {
    "hall": (
        ("mirror", "exhibits"),
        ("caustics", "tone"),
        ("shadow", "flight"),
        ("mist", "camera"),
    ),
    "voxel": (("debug", "water"), ("shadow", "voxel"), ("fog", "camera")),
}
BAKED = {
    "hall": {"room", "sky", "torches", "statue", "sun"},
    "voxel": {"sun", "time"},
}  # groups that are not applied


def changes(kind: Scene) -> Iterator[tuple[View, dict[str, Any]]]:
    """Yield each view and each half of a fix: where to look from, and the settings."""
    for view in kind.views.values():
        yield view, dict(view.settings)
    for fix in kind.fixes:
        for after in (False, True):
            pose = fix.pose(after)
            yield replace(fix.as_view(), pose=pose), dict(fix.on if after else fix.off)


def picture(stage: Stage, opened: OpenScene, view: View) -> np.ndarray:
    """Return the picture of a view, int64 (h, w, 3)."""
    with stage.borrowed():
        pose = placed(view.pose, opened, opened.settings.walk.eye)
        opened.draw(Moment(pose, SIZE, view.kt))
        return stage.read()


@pytest.fixture(scope="module", params=list(STARTS))
def kind(request: pytest.FixtureRequest) -> Scene:
    return scene(request.param)


@pytest.fixture(scope="module")
def opened(kind: Scene, the_stage: Stage) -> Iterator[OpenScene]:
    the_stage.enter()
    found = kind.open(kind.values(None, STARTS[kind.name]), Assets(), 0, shown(kind))
    yield found
    the_stage.enter()
    found.release()


def shown(kind: Scene) -> tuple[str, ...]:
    return kind.views[kind.start].shown


@pytest.mark.parametrize(
    ("kind", "groups"),
    [(place, groups) for place, lines in TOGETHER.items() for groups in lines],
    indirect=["kind"],
)
@pytest.mark.sweep(6)
def test_what_is_applied_looks_as_if_opened_so(
    stage: Stage, kind: Scene, opened: OpenScene, groups: tuple[str, ...]
) -> None:
    base = opened.settings
    settings, views = base, {}
    for view, given in changes(kind):
        for key, value in given.items():
            if key.split(".")[0] in groups and get(settings, key) == get(base, key) != value:
                changed = with_settings(settings, {key: value})
                if baked_alike(kind, base, changed) and opened.apply(changed):
                    settings = changed
                    views[view.pose] = view

    assert settings != base, groups
    drawn = [picture(stage, opened, view) for view in views.values()]
    assert opened.apply(base)
    fresh = kind.open(settings, Assets(), 0, shown(kind))
    for view, got in zip(views.values(), drawn, strict=True):
        off = np.abs(got - picture(stage, fresh, view)).max()
        assert off == 0, f"{groups}: {view.name} is off by {off} levels"
    fresh.release()


def test_every_group_of_settings_of_a_view_or_a_fix_is_changed_or_baked(kind: Scene) -> None:
    groups = {key.split(".")[0] for _, given in changes(kind) for key in given}
    assert groups == set(sum(TOGETHER[kind.name], ())) | BAKED[kind.name]
    assert BAKED[kind.name] <= set(kind.baked)


@pytest.mark.parametrize(
    ("place", "applied", "baked"),
    [
        ("hall", ("hall_sphere", "hall_mist", "hall_shadow"), "hall_contrast"),
        ("voxel", ("voxel_bay", "voxel_fog"), "voxel_sparkle"),
    ],
)
def test_views_share_a_scene_unless_something_else_is_baked_into_it(
    place: str, applied: tuple[str, ...], baked: str
) -> None:
    with Offscreen((40, 30), None, STARTS[place], samples=0) as view:
        scenes = []
        for name in (*applied, baked):
            view.look(name)
            scenes.append(view.scene)
        assert all(each is scenes[0] for each in scenes[:-1])
        assert scenes[-1] is not scenes[0]
