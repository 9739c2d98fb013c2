"""Times of day: one word for many settings, and every element in the light of the sunset."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from commands import landscape
from stage import SIZE, Stage, small

from framelens.base.errors import InputError
from landscape.elements.best.castle.baked_light import light
from landscape.elements.best.sky.clouds import cloud_light
from landscape.elements.best.sprites.relighting import corner_light
from landscape.elements.best.terrain.relief import relief_light
from landscape.elements.castle_fire import TORCHES
from landscape.elements.settings import PRESETS, TIMES, Settings, preset
from landscape.elements.sun import direction
from landscape.files.assets import Assets
from landscape.frame import Frame, Pose
from landscape.geometry.height_field import HeightField
from landscape.geometry.masonry import WALL
from landscape.island.island import SCENE, Island
from landscape.offscreen import Offscreen
from landscape.scene.scene import Moment
from landscape.settings.declare import get, passing, read_toml, with_settings

SUNSET = TIMES["sunset"]


# One word for many settings


@pytest.mark.parametrize("name", PRESETS)
def test_noon_is_the_preset_as_it_is(name: str) -> None:
    assert SCENE.values(name, {"time": "noon"}) == preset(name)


@pytest.mark.parametrize("name", PRESETS)
def test_a_time_of_day_changes_its_own_settings_of_a_preset_and_no_others(name: str) -> None:
    noon, sunset = preset(name), SCENE.values(name, {"time": "sunset"})
    assert sunset.time == "sunset"
    assert all(get(sunset, key) == value for key, value in SUNSET.items())
    assert with_settings(sunset, {"time": "noon", **{k: get(noon, k) for k in SUNSET}}) == noon


def test_a_time_of_day_changes_light_sky_fog_and_torches_alone() -> None:
    groups = {key.partition(".")[0] for table in TIMES.values() for key in table}
    assert groups == {"sun", "sky", "fog", "water", "castle"}
    others = {key for key in SUNSET if key.startswith(("water.", "castle."))}
    assert others == {"water.roughness", "castle.torches"}


def test_other_changes_override_the_time_of_day_in_any_order() -> None:
    for changes in (
        [{"time": "sunset", "fog.color": "0,0,1"}],
        [{"fog.color": "0,0,1", "time": "sunset"}],
        [{"fog.color": "0,0,1"}, {"time": "sunset"}],
    ):
        values = SCENE.values("best", *changes)
        assert values.fog.color == (0.0, 0.0, 1.0)
        assert values.sky.set == "sunset"


def test_a_time_of_day_is_read_from_toml_python_and_the_command_line(tmp_path: Path) -> None:
    path = tmp_path / "dusk.toml"
    path.write_text('time = "sunset"\n[fog]\ndensity = 0.1\n')
    values = SCENE.values("2006", read_toml(path))
    assert (values.time, values.fog.density, values.sky.set) == ("sunset", 0.1, "sunset")
    with Offscreen((8, 8), "2006", {"time": "sunset"}, only=("sky",)) as view:
        view.look("fig35a")
        assert view.scene and view.scene.settings.sky.set == "sunset"
    listed = landscape("settings", "sky.set", "--settings", path)
    assert "sunset" in listed.out.splitlines()[1]


def test_an_unknown_time_of_day_is_refused_in_one_line(tmp_path: Path) -> None:
    reason = "setting time: expected one of noon, sunset, not 'midnight'"
    with pytest.raises(InputError, match=reason):
        with_settings(Settings(), {"time": "midnight"})
    path = tmp_path / "dusk.toml"
    path.write_text('time = "midnight"\n')
    for words in (["--set", "time=midnight"], ["--settings", path]):
        done = landscape("render", "fig35a", "--out", tmp_path / "a.png", *words)
        assert (done.status, done.err) == (2, f"landscape: {reason}\n")


def test_another_time_changes_what_the_user_has_not_set() -> None:
    own = SCENE.values("best", {"sun.elevation": 20.0, "time": "sunset"})
    back = passing(own, preset("best"), {"time": "noon"})
    assert back == with_settings(preset("best"), {"sun.elevation": 20.0})
    assert passing(back, preset("best"), {"time": "sunset"}) == own


# The light, as arrays


def seen(yaw: float) -> Frame:
    """Return a frame that looks in a direction, without OpenGL."""
    c, s = np.cos(np.radians(yaw)), np.sin(np.radians(yaw))
    rows = np.array([(c, 0, s, 0), (0, 1, 0, 0), (-s, 0, c, 0), (0, 0, 0, 1.0)])
    return Frame(Pose(0.0, 1.0, 0.0, yaw), (100, 100), 0.0, rows.T.ravel(), 60.0)


def test_a_sprite_is_warm_on_its_sunny_side_and_has_the_sky_s_colour_on_the_other() -> None:
    sun = SCENE.values("best", {"time": "sunset"}).sun
    left, right = corner_light(sun, seen(sun.azimuth + 90.0))[[3, 2]]
    assert np.allclose(left, sun.tint) and left[0] / left[2] > 1.5
    assert right[0] < right[2] and np.abs(right - sun.shade).max() < 0.02
    away, towards = (corner_light(sun, seen(sun.azimuth + turn)).mean() for turn in (180.0, 0.0))
    assert away > 1.3 * towards


def test_slopes_that_face_the_sun_are_warm_and_the_land_behind_a_hill_is_in_shadow() -> None:
    sun = SCENE.values("best", {"time": "sunset", "sun.azimuth": 270.0}).sun
    x = np.linspace(0.0, 40.0, 81)
    ridge = np.maximum(3.0 - np.abs(x - 20.0), 0.0)
    field = HeightField(np.tile(ridge, (81, 1)).astype(np.float32), 40.0, 0.0)
    light = relief_light(field, sun, 81)[40]
    facing, behind = light[np.abs(x - 18.5).argmin()], light[np.abs(x - 24.0).argmin()]
    assert np.allclose(facing, sun.tint, atol=0.02)
    assert np.allclose(behind, sun.shade, atol=0.02)


def test_clouds_are_warm_towards_the_sun_and_dim_away_from_it() -> None:
    sun = SCENE.values("best", {"time": "sunset"}).sun
    towards, away = (
        cloud_light(
            np.array([(5.0 * way * direction(sun)[0], 1.0, 5.0 * way * direction(sun)[2])]), sun
        )[0]
        for way in (1, -1)
    )
    assert towards[0] > 1.2 * towards[2] and away[0] / away[2] < 0.9 * towards[0] / towards[2]
    assert 0.6 * towards.mean() < away.mean() < 0.95 * towards.mean()
    noon = SCENE.values("best", {}).sun
    assert (cloud_light(np.array([(5.0, 1.0, 0.0)]), noon) == 1.0).all()


def test_torches_light_the_gate_wall_and_nothing_behind_it() -> None:
    values = SCENE.values("best", {"time": "sunset"})
    places = np.array([(TORCHES[0], 0.3, 0.0), (0.5, 0.9, 0.0), (0.5, 0.3, WALL)])
    normals = np.array([(0.0, 0.0, -1.0), (0.0, 0.0, -1.0), (0.0, 0.0, 1.0)])
    dark, lit = (light(places, normals, values.sun, values.castle.yaw, t) for t in (0.0, 1.0))
    close, far, within = lit - dark
    assert close.min() > 0.05 and close[0] > 3.0 * close[2]
    assert far.mean() < 0.4 * close.mean()
    assert (within == 0.0).all()


# The pictures

FEW = {
    "grass.count": 400_000,
    "trees.count": 300,
    "plants.count": 400,
    "ground.texture_size": 256,
    "ground.resolution": 60,
    "fog.enabled": False,
    "overlay.map": False,
    "ground.stones": 500,
}
# Places with the sun behind the viewer, or beside him.
COAST = Pose(12.0, 1.1, 32.5, 10.0, -4.0)
CASTLE = Pose(25.6, 2.8, 17.5, 80.0, 2.0)
RABBIT = Pose(20.2, 1.4, 24.5, 40.0, -15.0)
ISLANDS = Pose(19.0, 2.4, 27.0, 60.0, -12.0)
BEACH = Pose(14.0, 0.9, 30.0, 200.0, -20.0)
LIT = {
    "ground": (ISLANDS, ("ground",)),
    "trees": (ISLANDS, ("trees",)),
    "plants": (RABBIT, ("plants",)),
    "grass": (RABBIT, ("grass",)),
    "castle": (CASTLE, ("castle",)),
    "rabbit": (RABBIT, ("rabbit",)),
    "dragon": (COAST, ("dragon",)),
    "sky": (COAST, ("sky",)),
    "water": (COAST, ("water", "sky", "reflection")),
    "sword": (ISLANDS, ("sword",)),
}


@pytest.fixture(scope="module", params=["2006", "best"])
def islands(request: pytest.FixtureRequest, the_stage: Stage) -> Iterator[list[Island]]:
    the_stage.enter()
    base: dict[str, Any] = {**PRESETS[request.param], **FEW}
    made = [
        Island(small({**base, "time": time, "fog.color": (0.0, 0.0, 0.0)}), Assets())
        for time in ("noon", "sunset")
    ]
    yield made
    the_stage.enter()
    for island in made:
        island.release()


@pytest.mark.parametrize("element", LIT)
@pytest.mark.seldom(14, first=2)
def test_every_element_is_warmer_at_sunset(
    stage: Stage, islands: list[Island], element: str
) -> None:
    pose, shown = LIT[element]
    warmth = []
    for island in islands:
        island.shown = set(shown)
        with stage.borrowed():
            island.draw(Moment(pose, SIZE, 40.0))
        picture = stage.read()
        there = picture[picture.sum(axis=2) > 0]
        assert len(there) > 60, "nothing to be seen"
        red, _, blue = there.mean(axis=0)
        warmth.append(red / blue)
    assert warmth[1] > 1.1 * warmth[0]


@pytest.mark.seldom(14, first=2)
@pytest.mark.parametrize("islands", ["best"], indirect=True)
def test_foam_is_warmer_at_sunset(stage: Stage, islands: list[Island]) -> None:
    warmth = []
    for island in islands:
        island.shown = {"water"}
        pictures = []
        for foam in (True, False):
            with stage.borrowed():
                assert island.apply(with_settings(island.settings, {"water.foam": foam}))
                island.draw(Moment(BEACH, SIZE, 80.0))  # the wash is wide
            pictures.append(stage.read())
        foam = (pictures[0] - pictures[1])[(pictures[0] - pictures[1]).sum(axis=2) > 40]
        assert len(foam) > 30, "no foam to be seen"
        red, _, blue = foam.mean(axis=0)
        warmth.append(red / blue)
    assert warmth[1] > 1.1 * warmth[0]
