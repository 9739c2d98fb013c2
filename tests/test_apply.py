"""Settings changed in an open island: taken, and drawn as if it had been built so, or refused.

Each key in turn gets another value. Where ``apply`` says that it was taken, the picture must be
that of an island built with the value; where it says no, nothing may have changed. Elements that
cannot take a value are built again, alone; only the ground takes the whole island with it.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from stage import SIZE, Stage, small

from framelens.base.errors import InputError
from landscape.elements.settings import PRESETS, Settings
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.island.island import ELEMENTS, Island
from landscape.scene.scene import Moment
from landscape.settings.declare import Setting, fields, get, with_settings

FEW: dict[str, Any] = {
    "grass.count": 20_000,
    "trees.count": 60,
    "plants.count": 60,
    "deer.count": 10,
    "ground.resolution": 40,
    "ground.texture_size": 64,
    "ground.tiles": 2,
    "grass.radius": 3.0,
}
MOMENTS = (
    Moment(Pose(12.0, 1.1, 30.5, 330.0, -4.0), SIZE, 40.0, 3.0, 2),  # dragon, water, trees, overlay
    Moment(Pose(28.3, 2.6, 18.9, 336.0, 2.0), SIZE, 40.0),  # castle, grass, plants
    Moment(Pose(20.2, 1.4, 24.5, 40.0, -15.0), SIZE, 40.0),  # rabbit
)
FILES = {
    "transparent.places": "avenue.csv",
    "sky.unfolded": "sky_unfolded.jpg",
    "ground.height_image": "height16.png",
    "ground.large_texture": "ground_sand.png",
    "ground.detail_texture": "ground_rock.png",
    "ground.sand_texture": "ground_rock.png",
    "ground.rock_texture": "ground_sand.png",
    "rabbit.mesh": "dragon.ply",
    "dragon.mesh": "rabbit.ply",
}


def another(key: str, item: Setting, value: Any) -> Any:
    """Return a value for a key other than ``value``, within its limits."""
    low, high = item.low, item.high
    if isinstance(value, bool):
        return not value
    if item.choices:
        return next(choice for choice in item.choices if choice != value)
    if isinstance(value, str):
        return FILES[key] if FILES[key] != value else "height.png"
    if isinstance(value, tuple):
        return tuple(part * 0.8 if part * 0.8 >= low else part + 0.1 for part in value)
    if isinstance(value, int):
        return value + 1 if value + 1 <= high else value - 1
    changed = value * 0.8 if value else 0.3
    return changed if low <= changed <= high else min(max(value + 0.1, low), high)


def pictures(stage: Stage, island: Island) -> list[np.ndarray]:
    """Draw the island from each place, twice, as what is first seen may come a frame later."""
    found = []
    with stage.borrowed():
        for moment in MOMENTS:
            island.draw(moment)
            island.draw(moment)
            found.append(stage.read())
    return found


@pytest.fixture(scope="module", params=["2006", "best"])
def base(request: pytest.FixtureRequest) -> Settings:
    stones = {"ground.stones": 500} if request.param == "best" else {}
    return small({**PRESETS[request.param], **FEW, **stones})


@pytest.fixture(scope="module")
def opened(base: Settings, the_stage: Stage) -> Iterator[Island]:
    the_stage.enter()
    island = Island(base, Assets())
    yield island
    the_stage.enter()
    island.release()


# Changed together, and seen in the same pictures: no group of a line hides what another one shows.
TOGETHER = (
    ("camera", "clock", "walk", "time"),
    ("castle", "rabbit", "overlay"),
    ("sky", "dragon", "grass"),
    ("sun", "shading"),
    ("ground",),
    ("water", "reflection"),
    ("transparent",),
    ("trees", "deer", "plants"),
    ("fog",),
    ("mist",),
)


def test_every_group_of_settings_is_changed() -> None:
    assert sorted(sum(TOGETHER, ())) == sorted({key.split(".")[0] for key in fields(Settings)})


@pytest.mark.slow
@pytest.mark.parametrize("groups", TOGETHER, ids=", ".join)
@pytest.mark.sweep(10)
def test_what_is_taken_is_drawn_as_if_built_so_and_the_rest_is_refused(
    stage: Stage, base: Settings, opened: Island, groups: tuple[str, ...]
) -> None:
    taken: dict[str, Any] = {}
    settings = base
    for key, item in fields(Settings).items():
        if key.split(".")[0] in groups:
            value = another(key, item, get(base, key))
            # Each beside those taken before it: one picture then shows them all.
            changed = with_settings(settings, {key: value})
            assert changed != settings, key
            if opened.apply(changed):
                assert opened.settings == changed
                settings, taken[key] = changed, value
            else:
                assert opened.settings == settings, f"{key}: refused, and yet changed"

    if not taken:
        return
    drawn = pictures(stage, opened)
    assert opened.apply(base)
    built = Island(settings, Assets())
    wanted = pictures(stage, built)
    built.release()
    for number, (got, expected) in enumerate(zip(drawn, wanted, strict=True)):
        off = np.abs(got - expected).max()
        assert off == 0, f"{', '.join(taken)}: picture {number} is off by {off} levels"


def test_an_element_that_refuses_leaves_the_others_as_they_were(
    stage: Stage, base: Settings, opened: Island
) -> None:
    before = pictures(stage, opened)
    # The fog could be taken; the ground is compiled, and all else stands on it.
    assert not opened.apply(with_settings(base, {"fog.density": 0.4, "ground.resolution": 41}))
    assert opened.settings == base
    after = pictures(stage, opened)
    assert all((a == b).all() for a, b in zip(before, after, strict=True))


STANDING = ("water", "castle", "rabbit", "dragon", "sprites", "grass", "sword", "map", "ground")


def test_only_the_element_that_cannot_take_a_setting_is_built_again(
    base: Settings, opened: Island, stage: Stage
) -> None:
    before = {name: opened.elements.at(name) for name in (*STANDING, "sky")}
    assert opened.apply(with_settings(base, {"sky.moving": not base.sky.moving}))
    assert opened.elements.at("sky") is not before["sky"]
    assert all(opened.elements.at(name) is before[name] for name in STANDING)
    assert opened.apply(base)


def test_an_element_that_cannot_be_built_again_leaves_the_island_as_it_was(
    stage: Stage, base: Settings, opened: Island
) -> None:
    before = pictures(stage, opened)
    changes = {"fog.density": 0.4, "sky.half_width": 6.5, "dragon.mesh": "none.ply"}
    with pytest.raises(InputError, match=r"none\.ply"):
        opened.apply(with_settings(base, changes))
    assert opened.settings == base
    after = pictures(stage, opened)
    assert all((a == b).all() for a, b in zip(before, after, strict=True))


def test_fog_sun_and_overlay_are_taken_without_building_anything(
    base: Settings, opened: Island, stage: Stage
) -> None:
    live = {"fog.density": 0.2, "overlay.map": False, "camera.fov": 50.0}
    assert opened.apply(with_settings(base, live))
    assert opened.apply(base)
    assert set(ELEMENTS) == opened.shown
