"""Each setting of the hall has a view in which it shows: changed there, it changes the picture."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest
from other_values import another

from framelens.gl.seam import recording
from landscape.hall.hall import SCENE
from landscape.offscreen import Offscreen
from landscape.settings.declare import fields, get, with_settings
from landscape.settings.notices import WALK, conditions

KEYS = fields(type(SCENE.settings))
SIZE = (160, 120)
LEAST = 3  # levels of 255: less may be the rounding of colours


@dataclass(frozen=True)
class Shot:
    """Where a setting shows: the view, its animation time, settings beside it, its other value."""

    view: str
    settings: dict[str, Any] = field(default_factory=dict)
    value: Any = None
    kt: float | None = None


IN_FOG = {"fog.enabled": True}
LINEAR = {**IN_FOG, "fog.mode": "linear", "fog.end": 8.0}
BRIGHT = {"tone.contrast": 1.8}
FLYING = {"flight.enabled": True}
BY_SLERP = {**FLYING, "flight.interpolation": "slerp"}
SHOTS = {
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
OTHERS = {"walk.eye", *SCENE.unread, *WALKING}
SHOWN = [key for key in KEYS if key not in OTHERS and key not in ONLY_CALLS]


@pytest.fixture(scope="module")
def halls() -> Iterator[dict[Any, Offscreen]]:
    """The last hall opened, by its view and settings: neighbours in the list share it."""
    kept: dict[Any, Offscreen] = {}
    yield kept
    for hall in kept.values():
        hall.close()


def opened(halls: dict[Any, Offscreen], shot: Shot) -> Offscreen:
    wanted = shot.view, tuple(shot.settings.items())
    if wanted not in halls:
        while halls:
            halls.popitem()[1].close()
        halls[wanted] = hall = Offscreen(SIZE, samples=0, settings=shot.settings)
        hall.look(shot.view)
    return halls[wanted]


def changed(hall: Offscreen, key: str, shot: Shot) -> Any:
    """Return the hall's settings with another value of a key."""
    assert hall.scene is not None
    settings = hall.scene.settings
    value = shot.value
    if value is None or value == get(settings, key):
        value = another(key, KEYS[key], get(settings, key))
    return with_settings(settings, {key: value})


def drawn(hall: Offscreen, kt: float | None) -> tuple[np.ndarray, list[str]]:
    """Return the second of two pictures, and its calls: names and arguments."""
    hall.draw(kt)
    with recording() as recorder:
        picture = hall.draw(kt)
    return picture.astype(int), [f"{call.name}{call.args}" for call in recorder.calls]


def both(hall: Offscreen, key: str, shot: Shot) -> list[tuple[np.ndarray, list[str]]]:
    """Return what :func:`drawn` does, without and with another value of a key."""
    before = drawn(hall, shot.kt)
    after = changed(hall, key, shot)
    assert hall.scene is not None
    former = hall.scene.settings
    if hall.scene.apply(after):
        pictures = [before, drawn(hall, shot.kt)]
        assert hall.scene.apply(former)
        return pictures
    with Offscreen(SIZE, samples=0, settings={**shot.settings, key: get(after, key)}) as other:
        other.look(shot.view)
        return [before, drawn(other, shot.kt)]


@pytest.mark.parametrize("key", sorted(SHOWN, key=lambda key: SHOTS.get(key, Shot("")).view))
@pytest.mark.sweep(20)
def test_a_setting_changes_the_picture_of_the_view_that_shows_it(
    halls: dict[Any, Offscreen], key: str
) -> None:
    shot = SHOTS.get(key, Shot("hall"))
    (before, _), (after, _) = both(opened(halls, shot), key, shot)
    assert np.abs(before - after).max() >= LEAST, f"{key} changes nothing in its view"


@pytest.mark.parametrize("key", ONLY_CALLS)
@pytest.mark.sweep(4)
def test_another_way_to_draw_makes_the_same_picture_by_other_calls(
    halls: dict[Any, Offscreen], key: str
) -> None:
    shot = ONLY_CALLS[key]
    hall = opened(halls, shot)
    (before, calls), (after, others) = both(hall, key, shot)
    assert calls == drawn(hall, shot.kt)[1]
    assert calls != others and np.abs(before - after).max() < LEAST


@pytest.mark.parametrize("key", ["sun.tint", "sun.relit", "sun.shade"])
@pytest.mark.sweep(3)
def test_what_has_no_effect_in_the_hall_is_said_and_changes_nothing(
    halls: dict[Any, Offscreen], key: str
) -> None:
    assert key in SCENE.unread
    shot = Shot("hall", {"sun.tint": (0.5, 0.6, 0.7)} if key == "sun.relit" else {})
    (before, _), (after, _) = both(opened(halls, shot), key, shot)
    assert (before == after).all()
