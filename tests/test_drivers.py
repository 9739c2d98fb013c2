"""The scenes drawn by other drivers: nothing is asked of OpenGL that they do not have.

The island, the hall and the blocks are drawn whole, stills as the commands draw them, by drivers
with fewer texture units and without each extension that anything uses, of a version in which no
core hides that it is missing.
"""

from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import numpy as np
import pytest
from drivers import KNOWN, Driver, emulated
from stage import SMALL_BEST

from framelens.base.errors import NoOpenGLError
from framelens.gl import extensions, features, state
from landscape.elements import support
from landscape.elements.settings import Settings
from landscape.gl.features import FEATURES, left_out, possible, reason
from landscape.offscreen import Offscreen
from landscape.settings.declare import fields

SIZE = (160, 120)
BLOCKS: dict[str, Any] = {"voxel.regions": 4, "voxel.region_size": 30, "shadow.size": 256}
PLACES: dict[str, tuple[dict[str, Any], tuple[str, ...]]] = {
    # The bay with castle and dragon, the castle's gate; hall and exhibits; water, land, a route.
    "island": (SMALL_BEST, ("fig35a", "fig35e")),
    "hall": ({"flight.path": True, "tone.brightness": -0.05}, ("hall", "hall_exhibit_volume")),
    "voxel": (BLOCKS | {"debug.regions": True}, ("voxel_bay",)),
}
OLD = (1, 1)
Pictures = dict[str, np.ndarray]


def pictures(driver: Driver, place: str) -> Pictures:
    """Return the views of a place as a driver draws them, int64 (h, w, 3)."""
    settings, views = PLACES[place]
    drawn = {}
    with emulated(driver), Offscreen(SIZE, settings=settings) as offscreen:
        for view in views:
            offscreen.look(view)
            drawn[view] = offscreen.draw().astype(np.int64)
    return drawn


class Whole(dict[str, Pictures]):
    """What a driver draws that has everything, by the place; each is drawn when it is needed."""

    def __missing__(self, place: str) -> Pictures:
        driver = Driver()
        self[place] = pictures(driver, place)
        assert driver.refused == []
        return self[place]


@pytest.fixture(scope="module")
def whole() -> Whole:
    return Whole()


def differing(one: Pictures, other: Pictures, levels: int = 40) -> float:
    """Return the greatest fraction of pixels that differ by more than so many levels."""
    return max(float((np.abs(one[v] - other[v]).max(axis=2) > levels).mean()) for v in one)


def is_sound(one: Pictures, other: Pictures) -> bool:
    """Return whether pictures are neither black nor white where the others are not."""
    dark = max(((one[v].max(axis=2) < 8) & (other[v].max(axis=2) > 40)).mean() for v in one)
    white = max(((one[v].min(axis=2) > 250) & (other[v].min(axis=2) < 200)).mean() for v in one)
    return bool(dark < 0.01 and white < 0.01)


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("units", [4, 3, 2, 1])
@pytest.mark.sweep(14, first=1)
def test_with_few_texture_units_no_more_are_used_and_the_place_is_the_same(
    place: str, units: int, whole: Whole, capsys: pytest.CaptureFixture[str]
) -> None:
    driver = Driver(units=units)
    drawn = pictures(driver, place)
    assert driver.refused == []
    assert is_sound(drawn, whole[place])
    assert differing(drawn, whole[place]) < {4: 0.02, 3: 0.12, 2: 0.12, 1: 0.6}[units]
    told = capsys.readouterr().err.splitlines()
    assert len(told) == len(set(told)) and (told or units == 4)
    for line in told:
        assert line.startswith("landscape: ") and line.endswith(f" texture units of {units}")


@pytest.mark.seldom(14, first=9)
def test_the_sea_is_drawn_in_four_texture_units_with_the_pixels_of_eight(
    whole: Whole,
) -> None:
    settings = {**SMALL_BEST, "water.caustics": False}
    drawn = []
    for units in (8, 4):
        with (
            emulated(Driver(units=units)) as driver,
            Offscreen(SIZE, settings=settings) as offscreen,
        ):
            offscreen.look("fig35a")
            drawn.append(offscreen.draw())
            assert driver.refused == []
    np.testing.assert_array_equal(*drawn)


@pytest.mark.sweep(24)
@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("name", sorted(KNOWN))
def test_without_an_extension_nothing_of_it_is_used_and_a_line_says_what_is_off(
    place: str, name: str, whole: Whole, capsys: pytest.CaptureFixture[str]
) -> None:
    driver = Driver(OLD, frozenset({name}))
    drawn = pictures(driver, place)
    assert driver.refused == []
    assert is_sound(drawn, whole[place])
    needs = [need for feature in FEATURES.values() for need in feature.needs]
    texts = {need.text for need in needs if name in need.extensions or not need.extensions}
    for line in capsys.readouterr().err.splitlines():
        assert line.endswith((*texts, " texture units of 1"))


@pytest.mark.seldom(14, first=9)
@pytest.mark.parametrize("place", PLACES)
def test_with_opengl_1_1_alone_everything_opens(place: str, whole: Whole) -> None:
    driver = Driver(OLD, KNOWN, units=1, widest=1.0)
    drawn = pictures(driver, place)
    assert driver.refused == [] and is_sound(drawn, whole[place])


@pytest.mark.seldom(13)
def test_where_lines_are_thin_none_wider_is_asked_for(whole: Whole) -> None:
    driver = Driver(widest=1.0)
    drawn = pictures(driver, "hall")
    assert driver.refused == [] and differing(drawn, whole["hall"]) < 0.05


# --- what a missing guard looks like -------------------------------------------------------------


@pytest.fixture
def unasked(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Lets the program believe that everything is possible, whatever the driver says."""
    monkeypatch.setattr(features, "reason", lambda name: "")
    yield


@pytest.mark.seldom(14, first=3)
@pytest.mark.usefixtures("unasked")
@pytest.mark.parametrize(
    "driver",
    [Driver(units=3), Driver((1, 2), frozenset({"GL_ARB_texture_env_dot3"}))],
    ids=["units", "extension"],
)
def test_a_program_that_does_not_ask_is_refused(stage: Any, driver: Driver) -> None:
    from OpenGL.error import GLError  # only now: it binds PyOpenGL to a platform

    with suppress(GLError):  # PyOpenGL's own check may notice what comes of it
        pictures(driver, "island")
    assert driver.refused


def test_a_driver_refuses_what_it_lacks_and_nothing_else(stage: Any) -> None:
    combine = 0x8571
    dot3 = 0x86AF
    source = 0x8580
    last = 0x84C3
    unit = ("glTexEnvi", (0x2300, combine, dot3))
    other = ("glTexEnvi", (0x2300, source, last))
    assert not Driver().objection(*unit) and not Driver().objection(*other)
    assert Driver((1, 2), frozenset({"GL_ARB_texture_env_dot3"})).objection(*unit)
    assert not Driver((1, 3), frozenset({"GL_ARB_texture_env_dot3"})).objection(*unit)
    assert Driver((1, 3), frozenset({"GL_ARB_texture_env_crossbar"})).objection(*other)
    assert Driver(units=3).objection(*other) == "no such texture unit"
    assert Driver(units=3).objection("glActiveTexture", (last,))
    assert Driver(widest=1.0).objection("glLineWidth", (2.0,))
    hidden = frozenset({"GL_ARB_framebuffer_object"})
    assert Driver((2, 1), hidden).objection("glGenFramebuffers", (1,)) == "unknown function"
    assert not Driver((2, 1)).objection("glGenFramebuffers", (1,))
    sides = ("glTexImage2D", (0x0DE1, 0, 0x1907, 100, 64, 0, 0x1907, 0x1401, None))
    assert Driver((1, 5), frozenset({"GL_ARB_texture_non_power_of_two"})).objection(*sides)


@pytest.mark.seldom(13)
def test_the_gate_is_open_with_few_texture_units_too() -> None:
    drawn = {}
    for units in (8, 3):
        driver = Driver(units=units)
        castle: dict[str, Any] = {"settings": SMALL_BEST, "only": ("castle",)}
        with emulated(driver), Offscreen(SIZE, **castle) as offscreen:
            offscreen.look("fig25f")
            drawn[units] = offscreen.draw().astype(np.int64)[45:90, 65:95]
        assert driver.refused == []
    assert differing({"door": drawn[8]}, {"door": drawn[3]}, 20) < 0.1


# --- the table -----------------------------------------------------------------------------------


def test_a_feature_that_is_not_possible_is_told_once_and_listed(
    stage: Any, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(features.extensions, "texture_units", lambda: 6)
    monkeypatch.setattr(features.extensions, "_told", set())
    assert not possible("water.caustics") and not possible("water.caustics")
    why = "it needs 7 texture units of 6"
    assert capsys.readouterr().err == f"landscape: water.caustics: off, for {why}\n"
    assert reason("water.caustics") == why and left_out() == {why: ["water.caustics"]}
    assert possible("water.foam") and reason("water.foam") == ""


def test_what_changes_no_picture_is_not_told(
    stage: Any, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(features.extensions, "version", lambda: (1, 1))
    monkeypatch.setattr(features.extensions, "extensions", frozenset)
    assert not possible("vertex buffers") and capsys.readouterr().err == ""


def test_a_command_that_cannot_do_without_says_so_in_one_line(
    stage: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    features.require("a pixel's history")
    monkeypatch.setattr(features.extensions, "version", lambda: (2, 1))
    monkeypatch.setattr(features.extensions, "extensions", frozenset)
    with pytest.raises(NoOpenGLError, match="this OpenGL has no OpenGL 3"):
        features.require("a pixel's history")


@pytest.mark.parametrize("text", [b"OpenGL ES 3.2 Other", None])
def test_a_driver_whose_version_is_not_of_opengl_is_refused_in_one_line(
    stage: Any, monkeypatch: pytest.MonkeyPatch, text: bytes | None
) -> None:
    driver = Driver()
    answers = {0x1F02: text, 0x1F03: None}
    with emulated(driver), stage.borrowed():
        monkeypatch.setattr(extensions.gl, "glGetString", answers.__getitem__)
        with pytest.raises(NoOpenGLError, match=r"^this driver's version is .*: expected OpenGL"):
            possible("water.foam")


def test_settings_that_are_turned_off_exist_and_are_features() -> None:
    for key, value in support.OFF.items():
        assert key in FEATURES and type(value) is type(fields(Settings)[key].default or value)


@pytest.mark.parametrize("scale", [1.0, 2.0])
def test_without_combiners_a_texture_is_multiplied_once(stage: Any, scale: float) -> None:
    driver = Driver(OLD, frozenset({"GL_ARB_texture_env_combine"}))
    with emulated(driver), stage.borrowed():
        state.multiply(scale)
    assert driver.refused == []
