"""Each setting of the hall has a view in which it shows: changed there, it changes the picture."""

from collections.abc import Iterator
from dataclasses import replace

import pytest
from setting_shots import LEAST, Shot, Studio, change, drawn, in_order

from landscape.hall.hall import SCENE
from landscape.settings.declare import fields
from landscape.settings.notices import WALK, conditions

KEYS = fields(type(SCENE.settings))

IN_FOG = {"fog.enabled": True}
LINEAR = {**IN_FOG, "fog.mode": "linear", "fog.end": 8.0}
BRIGHT = {"tone.contrast": 1.8}
FLYING = {"flight.enabled": True}
BY_SLERP = {**FLYING, "flight.interpolation": "slerp"}
# What a walker holds is in no view; facing away from the sun, it is in shade.
HELD = replace(SCENE.views["hall"].pose, yaw=103.0)
SWORD = ("sword",)
TINTED = {"sun.tint": (0.5, 0.6, 0.7)}
SHOTS = {
    "camera.focus": Shot("hall", {"camera.lens": 0.02}, 4.0),
    "camera.lens_points": Shot("hall", {"camera.lens": 0.02}, 2),
    "walk.eye": Shot("hall_contrast"),
    "sun.tint": Shot(HELD, only=SWORD),
    "sun.relit": Shot(HELD, TINTED, only=SWORD),
    "sun.shade": Shot(HELD, TINTED | {"sun.relit": True}, only=SWORD),
    "fog.mode": Shot("hall", IN_FOG, "linear"),
    "fog.density": Shot("hall", IN_FOG, 0.5),
    "fog.radial": Shot("hall", IN_FOG),
    "fog.start": Shot("hall", LINEAR, 4.0),
    "fog.end": Shot("hall", LINEAR, 6.0),
    "tone.doubling": Shot("hall_contrast", BRIGHT),
    "tone.area": Shot("hall_contrast"),
    "flight.interpolation": Shot("hall", FLYING, "slerp", 130.0),
    "flight.short": Shot("hall", BY_SLERP, False, 330.0),
    "flight.kt_per_key": Shot("hall", FLYING, 90.0, 130.0),
    "caustics.planes": Shot("hall_caustics", value="eye_before_camera"),
    "caustics.reflected": Shot("hall_caustics", value=0.2),
    "exhibits.volume_caps": Shot("hall_exhibit_volume", {"exhibits.volume_count": "zfail"}),
    "mirror.normals": Shot("hall_mist"),
    "mirror.lights": Shot("hall_mist"),
    "mirror.underside": Shot("mirror_underside"),
    "shadow.behind": Shot("shadow_stencil"),
    "shadow.flicker": Shot("hall_sphere"),
    "exhibits.lines": Shot("hall_sphere"),
    "exhibits.focus": Shot("hall_mist"),
}
BY_VIEW = {
    "hall_mist": "mist.sheets mist.density mist.sorted mist.clear",
    "hall_one_floor": "shadow.light shadow.strength shadow.shine shadow.lamp",
    "hall_texture": "tone.texture tone.texture_contrast tone.texture_brightness exhibits.deep "
    "exhibits.blur_samples exhibits.blur_shutter",
    "hall_exhibits": "exhibits.volume exhibits.volume_shown exhibits.soft exhibits.soft_lamp",
    "hall_exhibit_soft": "exhibits.soft_samples",
    "hall_exhibit_focus": "exhibits.focus_samples exhibits.focus_lens exhibits.focus_shear",
    "hall_exhibit_lines": "exhibits.lines_offset",
    "hall_exhibit_solids": "exhibits.solids exhibits.solids_operation exhibits.solids_stencil",
}
SHOTS |= {key: Shot(view) for view, keys in BY_VIEW.items() for key in keys.split()}
# These ways of drawing make the same picture by other calls.
ONLY_CALLS = {
    "tone.method": Shot("hall_contrast", BRIGHT),
    "caustics.passes": Shot("hall_caustics"),
    "exhibits.volume_count": Shot("hall_exhibit_volume"),
    "mist.mask": Shot("hall_mist"),
}
WALKING = {key for key in KEYS if WALK in conditions(type(SCENE.settings), key)}
OTHERS = {*SCENE.unread, *WALKING}
UNREAD = [key for key in SCENE.unread if key not in WALKING]
SHOWN = [key for key in KEYS if key not in OTHERS and key not in ONLY_CALLS]


@pytest.fixture(scope="module")
def studio() -> Iterator[Studio]:
    opened = Studio(SCENE, {})
    yield opened
    opened.close()


@pytest.mark.parametrize("key", in_order(SHOWN, SHOTS))
@pytest.mark.sweep(14, neighbours=True)
def test_a_setting_changes_the_picture_of_the_view_that_shows_it(studio: Studio, key: str) -> None:
    difference = change(studio.both(key, SHOTS.get(key, Shot("hall"))))
    assert difference >= LEAST, f"{key} changes nothing in its view"


@pytest.mark.parametrize("key", ONLY_CALLS)
@pytest.mark.sweep(10)
def test_another_way_to_draw_makes_the_same_picture_by_other_calls(
    studio: Studio, key: str
) -> None:
    shot = ONLY_CALLS[key]
    before, after = studio.both(key, shot)
    assert before[1] == drawn(studio.opened(shot), shot.kt)[1]
    assert before[1] != after[1] and change((before, after)) < LEAST


@pytest.mark.parametrize("key", UNREAD)
@pytest.mark.sweep(10)
def test_what_has_no_effect_in_the_hall_is_said_and_changes_nothing(
    studio: Studio, key: str
) -> None:
    before, after = studio.both(key, Shot("hall"))
    assert change((before, after)) == 0
