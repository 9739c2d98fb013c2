"""Each setting of the voxel island has a view in which it shows: changed there, it changes it."""

from collections.abc import Iterator
from dataclasses import replace

import pytest
from setting_shots import LEAST, Shot, Studio, change, drawn, in_order
from test_voxel_fixes import COARSE

from landscape.settings.declare import fields
from landscape.settings.notices import WALK, conditions
from landscape.voxel.voxel import SCENE

KEYS = fields(type(SCENE.settings))
IN_LINE = {"fog.mode": "linear", "fog.end": 12.0}
TINTED = {"sun.tint": (0.5, 0.6, 0.7)}
# What a walker holds is in no view; facing away from the sun, it is in shade.
HELD = replace(SCENE.views["voxel_bay"].pose, yaw=128.0)
SWORD = ("sword",)
SHOTS = {
    "time": Shot("voxel_bay", value="sunset"),
    "camera.near": Shot("voxel_castle", value=5.0),
    "camera.far": Shot("voxel_castle", value=5.0),
    "camera.focus": Shot("voxel_castle", {"camera.lens": 0.05}, 4.0),
    "camera.lens_points": Shot("voxel_castle", {"camera.lens": 0.05}, 2),
    "walk.eye": Shot("voxel_shadow", value=0.5),
    "sun.tint": Shot(HELD, only=SWORD),
    "sun.shade": Shot(HELD, TINTED | {"sun.relit": True}, only=SWORD),
    "sun.relit": Shot(HELD, TINTED, only=SWORD),
    "fog.mode": Shot("voxel_castle", value="linear"),
    "fog.start": Shot("voxel_castle", IN_LINE, 6.0),
    "fog.end": Shot("voxel_castle", IN_LINE, 20.0),
    "voxel.height_image": Shot("voxel_castle", value="ground_rock.png"),
    "voxel.merge": Shot("voxel_merge"),
    "voxel.slope": Shot("voxel_slope"),
    "voxel.highlights": Shot("voxel_highlights"),
    "voxel.mipmaps": Shot("voxel_mipmaps"),
    "voxel.holes": Shot("voxel_castle"),
    "voxel.cull": Shot("voxel_cull"),
    "voxel.distance": Shot("voxel_regions"),
    "voxel.near": Shot("voxel_near", value=1.0),
    "voxel.far": Shot("voxel_sea_haze", {"voxel.near": 0.0}, 0.0),
    "voxel.sea_haze": Shot("voxel_sea_haze"),
    "voxel.trees": Shot("voxel_forest"),
    "shadow.size": Shot("voxel_shadow", value=128),
    "shadow.distance": Shot("voxel_shadow", value=1.0),
    "shadow.far": Shot("voxel_shadow_far"),
    "shadow.color": Shot("voxel_shadow_sky"),
    "shadow.offset": Shot("voxel_shadow_offset"),
    "water.bending": Shot("voxel_bending"),
    "water.reflection": Shot("voxel_reflection"),
    "water.refraction": Shot("voxel_refraction"),
    "water.resolution": Shot("voxel_reflection", value=0.1),
    "water.fresnel": Shot("voxel_fresnel"),
    "water.by_angle": Shot("voxel_fresnel"),
    "water.far": Shot("voxel_water", value=0.0),
    "water.ripples": Shot("voxel_ripples"),
    "water.sparkle": Shot("voxel_sparkle"),
    "water.color": Shot("voxel_refraction"),
    "water.horizon": Shot("voxel_water"),
    "water.below": Shot("voxel_below"),
    "water.sight": Shot("voxel_below", value=10.0),
    "water.clear": Shot("voxel_depth", value=4.0),
    "overlay.map": Shot(HELD, only=("land", "map")),
    "debug.picture": Shot("voxel_bay", value="reflection"),
}
# These ways of drawing make the same picture by other calls.
ONLY_CALLS = {
    "voxel.facing": Shot("voxel_castle"),
    "voxel.visibility": Shot("voxel_castle", value="boxes"),
    "voxel.buffers": Shot("voxel_castle"),
    "voxel.vertex_arrays": Shot("voxel_castle"),
    "voxel.horizon": Shot("voxel_castle"),
}
WALKING = {key for key in KEYS if WALK in conditions(type(SCENE.settings), key)}
OTHERS = {*SCENE.unread, *WALKING, *ONLY_CALLS}
SHOWN = [key for key in KEYS if key not in OTHERS]
UNREAD = [key for key in SCENE.unread if key not in WALKING]
BAY = Shot("voxel_bay")


@pytest.fixture(scope="module")
def studio() -> Iterator[Studio]:
    opened = Studio(SCENE, COARSE)
    yield opened
    opened.close()


@pytest.mark.parametrize("key", in_order(SHOWN, SHOTS))
@pytest.mark.sweep(14, neighbours=True)
def test_a_setting_changes_the_picture_of_the_view_that_shows_it(studio: Studio, key: str) -> None:
    difference = change(studio.both(key, SHOTS.get(key, BAY)))
    assert difference >= LEAST, f"{key} changes nothing in its view"


@pytest.mark.parametrize("key", ONLY_CALLS)
@pytest.mark.sweep(5)
def test_another_way_to_draw_makes_the_same_picture_by_other_calls(
    studio: Studio, key: str
) -> None:
    shot = ONLY_CALLS[key]
    before, after = studio.both(key, shot)
    assert before[1] == drawn(studio.opened(shot), shot.kt)[1]
    assert before[1] != after[1] and change((before, after)) < LEAST


@pytest.mark.parametrize("key", UNREAD)
@pytest.mark.sweep(10)
def test_what_has_no_effect_among_voxels_is_said_and_changes_nothing(
    studio: Studio, key: str
) -> None:
    before, after = studio.both(key, BAY)
    assert change((before, after)) == 0
